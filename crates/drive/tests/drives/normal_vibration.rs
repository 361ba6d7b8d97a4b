//! Contacts that vibrate along the normal and along the slide: end of slip, continued slip, and mean friction.

use crate::parts::{
    FOOT_SLIDER, channel, column, contact, damper, end, event, follower, foot_and_slider, free, named,
    of_pair, of_profile, plan, push, sine, trace, wave,
};
use std::f64::consts::{PI, TAU};
use stickslip_contact::{Pair, Profile};
use stickslip_drive::scene::{Body, Contact, ContactStart, Normal, Scene, Side, Start, Varying};
use stickslip_drive::{EventKind, Shape, Stepper, Timing, Waveform};

const GROUND_SLIDER: [Side; 2] = [Side::Ground, Side::Body(0)];
const MU: f64 = 0.2;
/// Effective moduli, Pa.
const E: f64 = 1.15e11;
const G: f64 = 0.95e11;
const KAPPA: f64 = MU * E / G;
const RADIUS: f64 = 1e-3;

/// Indentation of the paraboloid under a force: F_N = (4/3)E\*√R d^{3/2}.
fn depth(force: f64) -> f64 {
    (0.75 * force / (E * RADIUS.sqrt())).powf(2.0 / 3.0)
}

fn ball(between: [Side; 2], force: f64) -> Contact {
    let pair = Pair::from_moduli(E, G).unwrap();
    of_pair(pair, &contact(between, Profile::paraboloid(RADIUS).unwrap(), MU, force))
}

/// Mean and amplitude of the normal force, N; its period (s) is long compared with that of the slider, at most 0.05 ms.
const MEAN: f64 = 1.0;
const SWING: f64 = 0.4;
const PERIOD: f64 = 20e-3;

/// Light slider with a damper to ground (c, N s/m), under a fraction `part` of μF_N,min, with oscillating normal force.
fn pushed(part: f64, (mass, damping): (f64, f64)) -> Scene {
    let mut pressed = ball(GROUND_SLIDER, MEAN);
    pressed.normal = Normal::Force(Varying::Follows(0));
    let pressing = Shape::Sine { amplitude: SWING, phase: 0.0, offset: MEAN };
    Scene {
        waveforms: vec![wave("pressing", pressing, PERIOD)],
        bodies: vec![named("slider", free(mass))],
        contacts: vec![named("ball", pressed)],
        springs: vec![named("drag", damper(GROUND_SLIDER, damping))],
        loads: vec![push(0, part * MU * (MEAN - SWING))],
        start: Start::Equilibrium,
        ..Scene::default()
    }
}

/// Positions at the start and after each period, m.
fn places(part: f64, slider: (f64, f64)) -> Vec<f64> {
    let (model, _, rows) = trace(&pushed(part, slider), &event(1e-9, 5.0 * PERIOD), PERIOD);
    column(&model, &rows, "slider.x_m")
}

/// For F_x below μF_N,min slip ends with the first period. While F_N decreases, springs slip forward only. At the minimum the
/// contact is in the state of first loading, u = κd_min[1-(1-F_x/(μF_N,min))^{2/3}], and remains there. Limit: periods long
/// compared with that of the slider.
#[test]
fn slip_shakes_down_below_the_least_limit_of_friction() {
    for part in [0.3, 0.7, 0.95] {
        let x = places(part, (1e-3, 50.0));
        let known = KAPPA * depth(MEAN - SWING) * (1.0 - (1.0_f64 - part).powf(2.0 / 3.0));
        let first = KAPPA * depth(MEAN) * (1.0 - (1.0 - part * (MEAN - SWING) / MEAN).powf(2.0 / 3.0));
        println!("F_x = {part} μF_N,min: {x:?}, from {first:e} to {known:e}");
        assert!((x[0] / first - 1.0).abs() < 1e-9);
        assert!(x[1..].iter().all(|x| (x / known - 1.0).abs() < 1e-3));
        // The lag by the damper decays.
        assert!((x[5] - x[4]).abs() < 1e-5 * known && (x[5] - known).abs() < 1e-4 * known);
    }
}

/// Above that limit each period adds ∫(F_x-μF_N)dt/c over the time in which F_x exceeds it. Limit: drift large compared with u_c,
/// periods long compared with m/c.
#[test]
fn slip_ratchets_above_the_least_limit_of_friction() {
    for part in [1.05, 1.1, 1.3] {
        let (mass, damping) = (1e-5, 0.3);
        let x = places(part, (mass, damping));
        // Integral of μ(q + A sin) where negative: q = F_N - F_x/μ at the mean.
        let above = (MEAN - part * (MEAN - SWING)) / SWING;
        let half = above.acos();
        let known = MU * SWING * PERIOD / TAU * 2.0 * (half.sin() - above * half) / damping;
        let drift: Vec<f64> = x.windows(2).map(|w| w[1] - w[0]).collect();
        println!("F_x = {part} μF_N,min: {drift:?}, rigid {known:e}");
        assert!(drift[1..].iter().all(|d| (d / known - 1.0).abs() < 1e-3), "{drift:?} {known:e}");
    }
}

/// u = β(d-d₀) with |β| < κ, d oscillating about d₀: the contact grows in stick and shrinks along the same line. Slip occurs only
/// at the first shrinking below d₀.
#[test]
fn oscillation_in_phase_dissipates_in_its_first_cycle_only() {
    let d = depth(1.0);
    for part in [-0.9, 0.2, 0.6, 0.95] {
        let swing = 0.4 * d;
        let mut pressed = ball(FOOT_SLIDER, 0.0);
        pressed.normal = Normal::Indentation(Varying::Follows(1));
        let pressing = Shape::Sine { amplitude: swing, phase: 0.0, offset: d };
        let scene = Scene {
            waveforms: vec![
                wave("along", sine(part * KAPPA * swing), PERIOD),
                wave("pressing", pressing, PERIOD),
            ],
            bodies: vec![named("foot", follower(0)), named("wall", Body::default())],
            contacts: vec![named("ball", pressed)],
            ..Scene::default()
        };
        let (model, _, rows) = trace(&scene, &event(1e-10, 6.0 * PERIOD), PERIOD);
        let friction = column(&model, &rows, "energy.friction_J");
        let unit = MU * KAPPA * d;
        println!("β = {part} κ: {:?}", friction.iter().map(|f| f / unit).collect::<Vec<_>>());
        assert!(friction[1] > 1e-6 * unit);
        assert!(friction[2..].iter().all(|f| (f - friction[1]).abs() < 1e-9 * unit));
    }
}

/// Mean force on a foot that creeps while it vibrates with U < u_c: μF_N(1-U/u_c)^p, the centre of a loop that just reaches gross
/// slip. Limit: creep per period small compared with u_c; its relative size is the error.
#[test]
fn static_friction_under_tangential_vibration() {
    let cone = (E * 0.5 * PI * 0.01, 0.5 * PI * 0.01);
    let cone_depth = cone.1 / cone.0.sqrt();
    for (p, profile, d) in
        [(1.5, Profile::paraboloid(RADIUS), depth(1.0)), (2.0, Profile::cone(0.01), cone_depth)]
    {
        let profile = profile.unwrap();
        for part in [0.1, 0.3, 0.6, 0.9] {
            let u_c = KAPPA * d;
            let mut pressed = of_profile(profile.clone(), &ball(FOOT_SLIDER, 1.0));
            pressed.start = ContactStart::Displacement((1.0 - part) * u_c);
            let points = vec![(0.0, 0.0), (3.0 * PERIOD, -3e-4 * u_c)];
            let creep = Waveform::new(Shape::Table { points }, Timing::every(3.0 * PERIOD)).unwrap();
            let scene = Scene {
                waveforms: vec![wave("shaking", sine(part * u_c), PERIOD), named("creep", creep)],
                bodies: vec![named("foot", follower(0)), named("slider", follower(1))],
                contacts: vec![named("ball", pressed)],
                ..Scene::default()
            };
            let (model, _, rows) = trace(&scene, &event(1e-9, 3.0 * PERIOD), PERIOD / 4000.0);
            let force = column(&model, &rows, "ball.fx_N");
            let mean = force[8000..12_000].iter().sum::<f64>() / 4000.0 / MU;
            let known = (1.0 - part).powf(p);
            println!("p = {p}, U = {part} u_c: {mean:.6}, known {known:.6}");
            assert!((mean - known).abs() < 1e-3);
        }
    }
}

/// A contact shrinks along the line of its growth at almost constant u. Rounding around that line must not cause many events.
#[test]
fn a_contact_that_shrinks_along_its_line_of_growth_does_not_chatter() {
    let plan = event(1e-9, 4.75 * PERIOD);
    let (model, state, rows) = trace(&pushed(1.05, (1e-5, 0.3)), &plan, PERIOD / 800.0);
    let [u, d] = ["ball.u_m", "ball.d_m"].map(|name| column(&model, &rows, name));
    let u_c = model.contact_natural(0).unwrap().displacement;
    // From the last maximum but one to the mean: it grows and shrinks along u, within two units in the last place.
    let (top, mean) = (2600, 2800);
    assert!(d[top..mean].windows(2).all(|w| w[1] < w[0]) && d[2500..top].windows(2).all(|w| w[1] > w[0]));
    let beside = (2500..mean).map(|k| (u[k] - u[top]).abs()).fold(0.0, f64::max);
    let retraced = rows.events().filter(|(e, _)| (top..mean).contains(&((e.t / PERIOD * 800.0) as usize)));
    let retraced = retraced.count();
    println!(
        "u = {:.1} u_c, {:e} u_c beside, {retraced} events there, {:?}",
        u[top] / u_c,
        beside / u_c,
        state.counts()
    );
    assert!(u[top].abs() > 500.0 * u_c && beside < 1e-9 * u_c);
    assert!(retraced < 10 && state.counts().events < 2000);
}

/// The same far from the start: u is known to 1e-12 u_c, and each loop closes once.
#[test]
fn loops_close_after_a_travel_of_ten_thousand_gross_slips() {
    let (model, state, rows) = trace(&pushed(1.6, (1e-5, 0.1)), &event(1e-9, 4.0 * PERIOD), PERIOD);
    let u_c = model.contact_natural(0).unwrap().displacement;
    let u = channel(&model, "ball.u_m");
    let far = rows.events().filter(|(e, row)| e.kind == EventKind::LoopClosed && row[u].abs() > 1e4 * u_c);
    let far = far.count();
    println!("{far} loops closed beyond 1e4 u_c, {:?}", state.counts());
    assert!(far > 100 && state.counts().events < 10_000);
}

/// Slider on a foot that vibrates along the slide, mostly in gross slip. A stepper without events must not miss whole waves,
/// although the force is constant.
#[test]
fn a_stepper_without_events_leaps_over_no_wave() {
    let drive = wave("vibration", sine(1e-6), 1e-3);
    let ball = contact(FOOT_SLIDER, Profile::paraboloid(1e-3).unwrap(), 0.15, 1.0);
    let mut scene = foot_and_slider(drive, 0.1, ball);
    scene.loads.push(push(1, 0.03));
    let place = |plan| {
        let (model, state) = end(&scene, &plan);
        state.body(&model, 1).unwrap().0
    };
    let exact = place(event(1e-9, 20e-3));
    for tolerance in [1e-4, 1e-6, 1e-8] {
        let off = place(plan(Stepper::Dopri5 { tolerance }, 20e-3)) / exact - 1.0;
        println!("{tolerance:e}: {off:.1e} of {exact:.2e} m");
        assert!(off.abs() < 1e-2, "{tolerance:e}: {off:e}");
    }
}
