//! An input that is fed what a waveform does is the waveform: rows and events to the bit, whether each piece comes when the
//! run stands at its beginning or one piece ahead.
//!
//! The quick start with its sawtooth, and with a triangle: their waveforms know all their pieces, the input is told of one, or
//! two, at a time.

use crate::shared::{Stage, example, frames, rk4, verlet};
use stickslip_drive::{Event, EventKind, Plan, Run, Stepper, Trace};

const STROKE: f64 = 200e-9;
const PERIOD: f64 = 10e-3;
const PERIODS: u32 = 6;
/// An input in place of the waveform.
const INPUT: &str = r#"{"input":{"initial":"0 nm","range":["-1 um","1 um"],"interpolation":"linear"}}"#;

/// When a caller supplies a piece.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Supply {
    /// When the run stands where it begins.
    Late,
    /// When the run stands where the one before it begins.
    Ahead,
}

/// The quick start with another drive.
fn driven_by(waveform: &str) -> Stage {
    let overrides = [("waveforms.drive", waveform), ("output", r#"{"every":"0.13 ms"}"#), ("plots", "[]")];
    let overrides = overrides.map(|(key, value)| (key.to_owned(), value.to_owned()));
    Stage::of(&example("quickstart.json"), &overrides).unwrap()
}

/// The plan, to a moment shortly after the last corner.
fn plan(stage: &Stage, stepper: Stepper) -> Plan {
    let duration = f64::from(PERIODS) * PERIOD + 1e-9;
    Plan { every: stage.job.scenario.plan.every, ..stage.plan(stepper, duration) }
}

/// Ends and values of the pieces: those of the corners that a run of the waveform tells of, beyond its end as well.
fn pieces(stage: &Stage) -> Vec<(f64, f64)> {
    let duration = f64::from(PERIODS + 1) * PERIOD + 1e-9;
    let plan = stage.plan(Stepper::Event { tolerance: 1e-4 }, duration);
    let mut run = Run::new(&stage.job.model, &plan, stage.start(&plan).unwrap()).unwrap();
    let mut trace = Trace::new(&stage.job.model);
    run.finish(&mut trace).unwrap();
    let corners = trace.events().filter(|(event, _)| event.kind == EventKind::Corner);
    corners.zip([STROKE, 0.0].iter().cycle()).map(|((event, _), value)| (event.t, *value)).collect()
}

/// The run of the waveform; steps that see no corners are cut at them, as an input cuts them.
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

/// The run of the input, fed.
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

/// Events with what they leave.
fn events(trace: &Trace) -> Vec<(Event, Vec<f64>)> {
    trace.events().map(|(event, after)| (*event, after.to_vec())).collect()
}

/// Compares a waveform of the quick start with an input that is fed its pieces.
fn compare(waveform: &str) {
    let (stage, input) = (driven_by(waveform), driven_by(INPUT));
    let pieces = pieces(&stage);
    let fixed = [verlet, rk4].map(|make| stage.step(0.5, make).unwrap());
    let located = [1e-4, 1e-8, 1e-12].map(|tolerance| Stepper::Event { tolerance });
    let in_frames = [37e-6, 1e-3].map(frames);
    for stepper in located.into_iter().chain(in_frames).chain(fixed) {
        let plan = plan(&stage, stepper);
        let whole = known(&stage, &plan, &pieces);
        // Steps that see no corners turn to the next piece with the step into it: where the run stands at one, the piece ahead is
        // still there, and no other is taken.
        let supplies: &[_] =
            if stepper.ends_at_corners() { &[Supply::Late, Supply::Ahead] } else { &[Supply::Late] };
        for &supply in supplies {
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
