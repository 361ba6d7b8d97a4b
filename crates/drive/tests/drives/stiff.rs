//! Dampers and damped contacts that settle within nanoseconds, compared with closed forms of the slow motion.
//!
//! P1, whose slider the foot drags by w = s - x. After corners of s there are layers of m/c (2e-10 s) or m/(βk) (2e-8 s); rows
//! avoid them. Each closed form contains its next term, which shows its accuracy.

use crate::parts::{FOOT_SLIDER, column, damped, damper, event, named, p1, trace};
use stickslip_drive::scene::{Scene, Side};
use stickslip_drive::{Method, Model, Plan, Run, State};

const STROKE: f64 = 0.5e-6;
const PERIOD: f64 = 1e-3;
const FLYBACK: f64 = 0.1e-3;
const MASS: f64 = 0.02;
/// Friction limit, N.
const LIMIT: f64 = 0.15;
const PERIODS: i32 = 5;
/// Damping coefficient, N s/m.
const DAMPING: f64 = 1e8;
/// Velocities of the foot, m/s.
const RISE: f64 = STROKE / (PERIOD - FLYBACK);
const FALL: f64 = -STROKE / FLYBACK;

const GROUND_SLIDER: [Side; 2] = [Side::Ground, Side::Body(1)];

/// P1 with a contact damping β = 1 s.
fn damped_contact() -> Scene {
    let mut scene = p1();
    scene.contacts[0].part = damped(&scene.contacts[0].part, 1.0);
    scene
}

/// P1 with a damper.
fn syrup(between: [Side; 2]) -> Scene {
    let mut scene = p1();
    scene.springs.push(named("syrup", damper(between, DAMPING)));
    scene
}

/// Gross slip displacement, m, and initial tangential stiffness, N/m: Hertz, Cattaneo and Mindlin.
fn mindlin() -> (f64, f64) {
    let (young, nu, radius, normal) = (210e9_f64, 0.3, 1e-3_f64, 1.0);
    let e = young / (2.0 * (1.0 - nu * nu));
    let g = young / ((1.0 + nu) * (2.0 - nu));
    let d = (0.75 * normal / (e * radius.sqrt())).powf(2.0 / 3.0);
    (LIMIT / normal * e / g * d, 2.0 * g * (radius * d).sqrt())
}

/// Position and velocity of the foot.
fn foot(t: f64) -> (f64, f64) {
    let s = t % PERIOD;
    if s < PERIOD - FLYBACK { (RISE * s, RISE) } else { (STROKE + FALL * (s - (PERIOD - FLYBACK)), FALL) }
}

/// Times of the corners, and jumps of the foot's velocity there.
fn corners() -> impl Iterator<Item = (f64, f64)> {
    let of = |n| {
        let start = f64::from(n) * PERIOD;
        [(start, if n == 0 { RISE } else { RISE - FALL }), (start + PERIOD - FLYBACK, FALL - RISE)]
    };
    (0..PERIODS).flat_map(of)
}

/// Compares the slider with `exact(t)` in rows near the corners, within the tolerance of the stroke. The number of evaluations
/// must be below a hundredth of that of an explicit method.
fn compare(name: &str, scene: &Scene, exact: impl Fn(&[f64]) -> Vec<f64>) {
    for tolerance in [1e-3, 1e-5, 1e-7, 1e-9, 1e-11] {
        // The end is near a corner, too.
        let plan = event(tolerance, (f64::from(PERIODS) - 0.03) * PERIOD);
        let (model, state, rows): (_, State, _) = trace(scene, &plan, PERIOD / 7.3);
        let (t, x) = (column(&model, &rows, "time_s"), column(&model, &rows, "slider.x_m"));
        let off = x.iter().zip(exact(&t)).map(|(x, exact)| (x - exact).abs()).fold(0.0, f64::max) / STROKE;
        let evaluations = state.counts().evaluations;
        println!("{name} at {tolerance:e}: {evaluations} evaluations, {off:.1e} of the stroke");
        assert!(off < tolerance, "{name} at {tolerance:e}: {off:e}");
        assert!(evaluations < 50_000, "{name} at {tolerance:e}: {evaluations}");
        let taken = |method| state.tally().steps(method);
        assert!(taken(Method::Radau) > 0 && taken(Method::DormandPrince) == 0, "{name}: {:?}", state.tally());
    }
}

/// 10⁸ N s/m between foot and slider: cw + ∫F dt = m(ẋ - ẋ₀), w = mṡ/c up to the contact force of some µN. With F = kw and ∫w dt
/// = ms/c: x = s - mṡ/c + kms/c².
#[test]
fn a_slider_in_syrup_on_its_foot_goes_with_it() {
    compare("damper to the foot", &syrup(FOOT_SLIDER), |times| {
        let place = |t: &f64| {
            let (place, speed) = foot(*t);
            let held = mindlin().1 * place / DAMPING;
            if *t == 0.0 { 0.0 } else { place - MASS * (speed - held) / DAMPING }
        };
        times.iter().map(place).collect()
    });
}

/// 10⁸ N s/m between ground and slider: cx + mẋ = ∫F dt, x = (∫F dt - mF/c)/c, with F along the prescribed path w = s. x is 7e-12
/// m and changes the loops by 1e-12 of the stroke.
#[test]
fn a_slider_in_syrup_on_the_ground_creeps() {
    let limit = mindlin().0;
    // Force and its integral over the displacement since the last reversal; every half cycle ends in gross slip.
    let branch = |scale: f64, way: f64| {
        let stuck = (1.0 - way / (scale * limit)).max(0.0);
        let force = scale * (1.0 - stuck.powf(1.5));
        let integral = scale * (way - 0.4 * scale * limit * (1.0 - stuck.powf(2.5)));
        (LIMIT * force, LIMIT * integral)
    };
    assert!(STROKE > 2.0 * limit);
    compare("damper to the ground", &syrup(GROUND_SLIDER), |times| {
        let (mut done, mut last, mut start, mut scale) = (0.0, 0.0, 0.0, 1.0);
        let mut speed = RISE;
        let mut next = corners().skip(1).peekable();
        let place = |t: &f64| {
            let after = |time: f64, speed: f64, scale: f64, start: f64| {
                let (force, integral) = branch(scale, time * speed.abs());
                let sense = speed.signum();
                (start + sense * force, start * time + sense * integral / speed.abs())
            };
            while let Some((corner, _)) = next.next_if(|(corner, _)| corner <= t) {
                let (force, integral) = after(corner - last, speed, scale, start);
                (done, start, last, scale) = (done + integral, force, corner, 2.0);
                speed = if speed == RISE { FALL } else { RISE };
            }
            let (force, integral) = after(t - last, speed, scale, start);
            (done + integral - MASS * force / DAMPING) / DAMPING
        };
        times.iter().map(place).collect()
    });
}

/// Saved before and after a corner, within its layer and outside, a run continues with the same bits.
#[test]
fn a_run_put_down_and_taken_up_is_the_run() {
    for scene in [damped_contact(), syrup(FOOT_SLIDER), syrup(GROUND_SLIDER)] {
        let model = Model::new(&scene).unwrap();
        let whole = event(1e-8, 2.5 * PERIOD);
        let mut undisturbed = Run::new(&model, &whole, model.start(&whole).unwrap()).unwrap();
        undisturbed.finish(&mut ()).unwrap();
        for k in 0..20 {
            let after = if k < 10 { 1e-9 * 3.0_f64.powi(k) } else { 47e-6 * f64::from(k - 10) };
            let half = Plan { duration: PERIOD - FLYBACK + after, ..whole };
            let mut first = Run::new(&model, &half, model.start(&half).unwrap()).unwrap();
            first.approach(&mut ()).unwrap();
            let bytes = first.state().to_bytes(&model, &[7; 32]);
            let state = State::from_bytes(&model, &[7; 32], &bytes).unwrap();
            let mut second = Run::resume(&model, &whole, state).unwrap();
            second.finish(&mut ()).unwrap();
            assert!(second.state() == undisturbed.state(), "taken up at {:e} s", first.state().time());
        }
    }
}
