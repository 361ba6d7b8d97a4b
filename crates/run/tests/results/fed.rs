//! An input that receives the pieces of a waveform gives identical rows and events as the waveform itself.
//!
//! The quickstart runs with a sawtooth and with a triangle. The input receives one or two pieces in advance.

use crate::shared::{Stage, example, frames, rk4, verlet};
use stickslip_drive::{Event, EventKind, Plan, Run, Stepper, Trace};

const STROKE: f64 = 200e-9;
const PERIOD: f64 = 10e-3;
const PERIODS: u32 = 6;
/// Input that replaces the waveform.
const INPUT: &str = r#"{"input":{"initial":"0 nm","range":["-1 um","1 um"],"interpolation":"linear"}}"#;

/// Time at which the caller supplies a piece.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Supply {
    /// At the start of the piece.
    Late,
    /// At the start of the previous piece.
    Ahead,
}

/// Returns the quickstart with another drive.
fn driven_by(waveform: &str) -> Stage {
    let overrides = [("waveforms.drive", waveform), ("output", r#"{"every":"0.13 ms"}"#), ("plots", "[]")];
    let overrides = overrides.map(|(key, value)| (key.to_owned(), value.to_owned()));
    Stage::of(&example("quickstart.json"), &overrides).unwrap()
}

/// Returns a plan that ends shortly after the last corner.
fn plan(stage: &Stage, stepper: Stepper) -> Plan {
    let duration = f64::from(PERIODS) * PERIOD + 1e-9;
    Plan { every: stage.job.scenario.plan.every, ..stage.plan(stepper, duration) }
}

/// Returns the ends and values of the pieces from the corner events of the waveform, including one piece beyond the end.
fn pieces(stage: &Stage) -> Vec<(f64, f64)> {
    let duration = f64::from(PERIODS + 1) * PERIOD + 1e-9;
    let plan = stage.plan(Stepper::Event { tolerance: 1e-4 }, duration);
    let mut run = Run::new(&stage.job.model, &plan, stage.start(&plan).unwrap()).unwrap();
    let mut trace = Trace::new(&stage.job.model);
    run.finish(&mut trace).unwrap();
    let corners = trace.events().filter(|(event, _)| event.kind == EventKind::Corner);
    corners.zip([STROKE, 0.0].iter().cycle()).map(|((event, _), value)| (event.t, *value)).collect()
}

/// Runs the waveform. Fixed time steps are cut at corners, as an input cuts them.
fn known(stage: &Stage, plan: &Plan, pieces: &[(f64, f64)]) -> Trace {
    let model = &stage.job.model;
    let (mut run, mut trace) =
        (Run::new(model, plan, stage.start(plan).unwrap()).unwrap(), Trace::new(model));
    if !plan.stepper.locates_events() {
        let before = pieces.iter().take_while(|(end, _)| *end < plan.duration);
        before.for_each(|(end, _)| run.advance(*end, &mut trace).unwrap());
    }
    run.advance(plan.duration, &mut trace).unwrap();
    trace
}

/// Runs the input with supplied pieces.
fn fed(stage: &Stage, plan: &Plan, pieces: &[(f64, f64)], supply: Supply) -> Trace {
    let model = &stage.job.model;
    let (mut run, mut trace) =
        (Run::new(model, plan, stage.start(plan).unwrap()).unwrap(), Trace::new(model));
    let mut coming = pieces.iter();
    let mut lead = |run: &mut Run<'_>| {
        if let Some((until, value)) = coming.next() {
            run.lead(0, *until, *value).unwrap();
        }
    };
    if supply == Supply::Ahead {
        lead(&mut run);
    }
    for (end, _) in pieces {
        lead(&mut run);
        run.advance(end.min(plan.duration), &mut trace).unwrap();
        if *end >= plan.duration {
            break;
        }
    }
    assert_eq!(run.state().time(), plan.duration);
    trace
}

/// Returns the events with the states after them.
fn events(trace: &Trace) -> Vec<(Event, Vec<f64>)> {
    trace.events().map(|(event, after)| (*event, after.to_vec())).collect()
}

/// Compares a waveform of the quickstart with an input that receives its pieces.
fn compare(waveform: &str) {
    let (stage, input) = (driven_by(waveform), driven_by(INPUT));
    let pieces = pieces(&stage);
    let fixed = [verlet, rk4].map(|make| stage.step(0.5, make).unwrap());
    let located = [1e-4, 1e-8, 1e-12].map(|tolerance| Stepper::Event { tolerance });
    let in_frames = [37e-6, 1e-3].map(frames);
    for stepper in located.into_iter().chain(in_frames).chain(fixed) {
        let plan = plan(&stage, stepper);
        let whole = known(&stage, &plan, &pieces);
        for supply in [Supply::Late, Supply::Ahead] {
            let trace = fed(&input, &plan, &pieces, supply);
            let told = format!("{waveform} {stepper:?} {supply:?}");
            assert_eq!(trace.rows().len(), whole.rows().len(), "{told}");
            for (k, (fed, known)) in trace.rows().zip(whole.rows()).enumerate() {
                assert_eq!(fed, known, "{told}: row {k}");
            }
            let (fed, known) = (events(&trace), events(&whole));
            assert_eq!(fed.len(), known.len(), "{told}");
            for (fed, known) in fed.iter().zip(&known) {
                assert!(fed == known, "{told}: {fed:?} is not {known:?}");
            }
            let corners = fed.iter().filter(|(event, _)| event.kind == EventKind::Corner).count();
            println!("{told}: {} rows, {} events, {corners} corners", trace.rows().len(), fed.len());
            assert!(corners >= 11 || !stepper.locates_events(), "{told}: {corners}");
        }
    }
}

#[test]
fn a_sawtooth_fed_is_the_sawtooth() {
    compare(r#"{"sawtooth":{"stroke":"200 nm","period":"10 ms","flyback":"10 us"}}"#);
}

#[test]
fn a_triangle_fed_is_the_triangle() {
    compare(r#"{"triangle":{"stroke":"200 nm","period":"10 ms"}}"#);
}
