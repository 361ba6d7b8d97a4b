//! Branches of periodic orbits of the examples, compared with single orbits and simulations.

use std::error::Error;
use std::path::{Path, PathBuf};
use stickslip_drive::{Entry, EventKind, Plan, Record, Run, Stepper};
use stickslip_run::Job;
use stickslip_scenario::Scenario;
use stickslip_study::steady::continuation::{
    Bifurcation, Branch, Continuation, ContinuationError, Course, End,
};
use stickslip_study::steady::{self, Options};

type Checked = Result<(), Box<dyn Error>>;

fn job(name: &str, set: &[(&str, &str)]) -> Result<Job, Box<dyn Error>> {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios").join(name);
    let set: Vec<(String, String)> =
        set.iter().map(|(path, value)| ((*path).into(), (*value).into())).collect();
    Ok(Job::prepare(&file, &set, Path::new(""))?)
}

const STROKE: &str = "waveforms.drive.sawtooth.stroke";

fn p1(range: [f64; 2]) -> Result<Branch, Box<dyn Error>> {
    Ok(Continuation::new(job("p1.json", &[])?, STROKE, range)?.follow(&Course::default())?)
}

/// 20 strokes drawn by a linear congruential generator: each orbit is found from the initial state of its own scenario.
#[test]
fn the_branch_of_p1_is_what_is_found_at_each_stroke() -> Checked {
    let branch = p1([60e-9, 2e-6])?;
    assert_eq!((branch.ends.clone(), branch.points.len() > 40), ([End::Range, End::Range], true));
    let mut drawn = 1_u64;
    for _ in 0..20 {
        drawn = drawn.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        let point = &branch.points[(drawn >> 33) as usize % branch.points.len()];
        let own = job("p1.json", &[(STROKE, &format!("{:e}", point.value))])?;
        let found = steady::find(&own, &Options::default())?;
        let off = (point.step.ok_or("a step")? - found.step.ok_or("a step")?).abs();
        assert!(off <= 1e-9 * own.contact_scale(0).0, "{:e}: {off:e} m", point.value);
        let apart = (point.radius() - found.radius()).abs();
        assert!(apart < 1e-6, "{:e}: {apart:e}", point.value);
    }
    Ok(())
}

/// Counter of gross slip events.
#[derive(Default)]
struct Slips(u32);

impl Record for Slips {
    fn take(&mut self, entry: Entry<'_>) {
        if let Entry::Event(event, _) = entry {
            self.0 += u32::from(event.kind == EventKind::GrossSlip);
        }
    }
}

/// Returns the number of gross slip events in the last 10 of 400 simulated periods.
fn slips(stroke: f64) -> Result<u32, Box<dyn Error>> {
    let job =
        job("p1.json", &[(STROKE, &format!("{stroke:e}")), ("waveforms.drive.sawtooth.cycles", "1e9")])?;
    let stepper = Stepper::Event { tolerance: 1e-12 };
    let plan = Plan { duration: f64::MAX, stepper, every: None, until_steady: None, ..job.scenario.plan };
    let mut run = Run::new(&job.model, &plan, job.model.start(&plan)?)?;
    run.advance(390e-3, &mut ())?;
    let mut slips = Slips::default();
    run.advance(400e-3, &mut slips)?;
    Ok(slips.0)
}

/// At S₀, simulations with a stroke larger or smaller by one millionth have one or no gross slip per period.
#[test]
fn the_branch_of_p1_ends_where_gross_slip_ceases() -> Checked {
    let branch = p1([10e-9, 0.6e-6])?;
    assert_eq!(branch.ends, [End::Shakedown(vec!["ball".to_owned()]), End::Range]);
    let mark = branch.marks.first().ok_or("the end of gross slip")?;
    let Bifurcation::Event(changes) = &mark.kind else { return Err(format!("{mark:?}").into()) };
    let slip = changes.iter().find(|change| change.kind == "gross slip").ok_or("gross slip")?;
    assert_eq!((slip.source.as_str(), slip.below, slip.above), ("ball", 0, 1));
    assert!(mark.half_width < 1e-6 * mark.value, "{mark:?}");
    assert_eq!((slips(mark.value * (1.0 + 1e-6))?, slips(mark.value * (1.0 - 1e-6))?), (10, 0));
    Ok(())
}

/// At any small friction, the slider moves with the ramp, 0.5 µm in 0.9 ms. The flyback of 0.1 ms slows it by μ F_N
/// τ²/m per period. The branch ends where this is below rounding.
#[test]
fn the_branch_of_p1_goes_on_to_next_to_no_friction() -> Checked {
    let friction = "contacts.ball.friction";
    let of = Continuation::new(job("p1.json", &[(friction, "0.001")])?, friction, [0.0, 0.0011])?;
    let branch = of.follow(&Course::default())?;
    assert!(matches!(branch.ends, [End::Rounded(_), End::Range]), "{:?}", branch.ends);
    let low: Vec<_> = branch.points.iter().filter(|point| point.value < 1e-6).collect();
    assert!(low.len() > 2 && low[0].value < 1e-7, "{low:?}");
    let ramp = 0.5e-6 / 0.9;
    for point in low {
        let off = (point.step.ok_or("a step")? - ramp).abs();
        assert!(off < 2.0 * point.value * 1e-8 / 20e-3 && point.is_stable(), "{point:?}");
    }
    Ok(())
}

#[test]
fn what_cannot_be_followed_is_told() -> Checked {
    let refused =
        |name: &str, set: &[(&str, &str)], path: &str, range: [f64; 2]| -> Result<_, Box<dyn Error>> {
            let made = Continuation::new(job(name, set)?, path, range);
            Ok(match made.and_then(|of| of.follow(&Course::default()).map(|_| ())) {
                Err(error) => error,
                Ok(()) => return Err("it was followed".into()),
            })
        };
    assert!(matches!(refused("p1.json", &[], STROKE, [1e-6, 1e-7])?, ContinuationError::Range { .. }));
    assert!(matches!(refused("p1.json", &[], STROKE, [1e-6, 1e-6])?, ContinuationError::Range { .. }));
    assert!(matches!(refused("p1.json", &[], STROKE, [0.0, f64::NAN])?, ContinuationError::Range { .. }));
    assert!(matches!(refused("p1.json", &[], STROKE, [1e-6, 2e-6])?, ContinuationError::Outside { .. }));
    for path in ["contacts.ball.count", "contacts.bal.friction", "run.cycles", "bodies.foot"] {
        assert!(matches!(refused("p1.json", &[], path, [0.0, 1.0])?, ContinuationError::Path(_)), "{path}");
    }
    let still = [(STROKE, "20 nm")];
    let family = refused("p1.json", &still, STROKE, [10e-9, 30e-9])?;
    assert!(
        matches!(family, ContinuationError::Shakedown { .. } | ContinuationError::NoStart { .. }),
        "{family}"
    );
    let none = refused("bouncing_ball.json", &[], "gravity.acceleration", [5.0, 15.0])?;
    assert!(matches!(none, ContinuationError::NoStart { .. }), "{none}");
    Ok(())
}

/// An interrupted branch keeps its orbits.
#[test]
fn an_interrupted_branch_keeps_what_was_found() -> Checked {
    let asked = std::cell::Cell::new(0_u32);
    let goes_on = || {
        asked.set(asked.get() + 1);
        asked.get() < 400
    };
    let steady = Options { goes_on: &goes_on, ..Options::default() };
    let of = Continuation::new(job("p1.json", &[])?, STROKE, [60e-9, 2e-6])?;
    let branch = of.follow(&Course { steady, ..Course::default() })?;
    assert!(branch.is_cut() && branch.points.len() > 2, "{:?}", branch.ends);
    Ok(())
}

/// Undamped mass on a spring: |λ| = 1 along the whole branch except for rounding, and nothing is crossed. The
/// multipliers are e^{±i2πν}, with ν the number of natural oscillations per period.
#[test]
fn what_nothing_damps_crosses_the_unit_circle_nowhere() -> Checked {
    let scene = r#"{ "stickslip": 1, "waveforms": { "drive": { "sine": { "amplitude": "100 nm", "frequency": "1 kHz" } } },
        "bodies": { "foot": { "x": { "follows": "drive" } }, "slider": { "mass": "20 g", "x": "free" } },
        "springs": { "k": { "between": ["foot", "slider"], "stiffness": "2 N/um" } },
        "run": { "cycles": 30, "stepper": { "event": { "tolerance": 1e-12 } } } }"#;
    let job = Job::new(Scenario::from_str_alone(scene, "swing")?, "swing".to_owned(), PathBuf::new())?;
    let branch = Continuation::new(job, "springs.k.stiffness", [1.9e6, 2.4e6])?.follow(&Course::default())?;
    assert_eq!(branch.ends, [End::Range, End::Range]);
    assert!(branch.marks.is_empty(), "{:?}", branch.marks);
    for point in &branch.points {
        let angle = (point.value / 0.02).sqrt() * 1e-3;
        let off = (point.multipliers[0].re - angle.cos()).abs();
        assert!(off < 1e-6 && (point.multipliers[0].modulus() - 1.0).abs() < 1e-6, "{point:?}");
    }
    Ok(())
}
