//! Drives with closed-form or published solutions.
//!
//! Power law n, p = (n+1)/n, u_c = κd; contact theory by Popov, Heß, Willert, *Handbook of Contact Mechanics* (2019), section
//! 4.4.

use crate::parts::{
    FOOT_SLIDER, column, contact, damper, end, event, follower, foot_and_slider, free, named, of_pair,
    of_profile, piezo, plan, push, sine, trace, wave,
};
use std::f64::consts::{PI, TAU};
use stickslip_contact::{Pair, Profile};
use stickslip_drive::scene::{
    Actuator, Contact, ContactStart, Gravity, Load, Scene, Side, Spring, Start, Varying,
};
use stickslip_drive::{EventKind, Field, Harmonic, Model, Part, Shape, Source, Stepper, Timing, Waveform};

const GROUND_SLIDER: [Side; 2] = [Side::Ground, Side::Body(0)];
const MU: f64 = 0.2;
const FORCE: f64 = 1.0;
/// Effective moduli, Pa.
const E: f64 = 1.15e11;
const G: f64 = 0.95e11;

/// Contact with the moduli above, and its u_c (m) and stick stiffness 2G\*a (N/m) in closed form.
struct Known {
    contact: Contact,
    u_c: f64,
    stiffness: f64,
}

impl Known {
    /// Indentation and contact radius of the profile under [`FORCE`].
    fn new(between: [Side; 2], profile: Profile, (d, a): (f64, f64)) -> Self {
        let pair = Pair::from_moduli(E, G).unwrap();
        let contact = of_pair(pair, &contact(between, profile, MU, FORCE));
        Self { contact, u_c: MU * E / G * d, stiffness: 2.0 * G * a }
    }

    /// F_N = (4/3)E\*√R d^{3/2}, a² = Rd.
    fn paraboloid(between: [Side; 2], radius: f64) -> Self {
        let d = (0.75 * FORCE / (E * radius.sqrt())).powf(2.0 / 3.0);
        Self::new(between, Profile::paraboloid(radius).unwrap(), (d, (radius * d).sqrt()))
    }

    /// F_N = E\*ad, d = (π/2)a tanθ.
    fn cone(between: [Side; 2], slope: f64) -> Self {
        let a = (FORCE / (E * 0.5 * PI * slope)).sqrt();
        Self::new(between, Profile::cone(slope).unwrap(), (0.5 * PI * slope * a, a))
    }
}

/// Rigid bodies: the slider sticks to the foot, or slips with a_c = μF_N/m; step = S T/(T-t_f) - a_c t_f²(1+λ)/(1-λ).
///
/// A compliant contact agrees within about u_c, under load (1+λ)/(1-λ) times that. Free oscillations leave hundreds of loops in
/// the memory, which the flyback closes quickly; these events are no accumulation.
#[test]
fn rigid_coulomb_sawtooth() {
    for (load, step) in [(0.0, 940.4082e-9), (0.6, 700.4082e-9)] {
        for u_c in [1e-10_f64, 1e-11] {
            let known = Known::paraboloid(FOOT_SLIDER, 1e-3);
            // u_c = μE*/G* d, and d is proportional to E* to the power -2/3.
            let stiffer = (known.u_c / u_c).powf(1.5);
            let pair = Pair::from_moduli(stiffer * E, stiffer * G).unwrap();
            let contact = of_pair(pair, &known.contact);
            let drive = wave("drive", Shape::Sawtooth { stroke: 1e-6, flyback: 20e-6 }, 1e-3);
            let mut scene = foot_and_slider(drive, MU * FORCE / 200.0, contact);
            scene.loads.push(push(1, -load * MU * FORCE));
            assert!((Model::new(&scene).unwrap().contact_scale(0).unwrap().0 / u_c - 1.0).abs() < 1e-9);
            let (model, state, rows) = trace(&scene, &event(1e-6, 7e-3), 1e-3);
            let x = column(&model, &rows, "slider.x_m");
            let off = (x[7] - x[2]) / 5.0 - step;
            println!("λ = {load}: off by {:.2} of u_c = {u_c:e}, {:?}", off / u_c, state.counts());
            assert!(off.abs() < 1.1 * u_c * (1.0 + load) / (1.0 - load), "{off:e}");
        }
    }
}

/// Zero-step stroke of the ideal inertia drive: S₀ = 2u_c[1-((1-λ)/2)^{n/(n+1)}].
fn zero_step_stroke(n: f64, load: f64) -> f64 {
    2.0 * (1.0 - (0.5 * (1.0 - load)).powf(n / (n + 1.0)))
}

/// Instantaneous flyback, quasi-static slow phase: a slider critically damped to ground and a period of 1 s.
#[test]
fn ideal_inertia_drive_advances_by_the_stroke_less_the_zero_step_stroke() {
    let stroke = 1.6;
    let known = [(1.0, Known::cone(FOOT_SLIDER, 0.01)), (2.0, Known::paraboloid(FOOT_SLIDER, 1e-3))];
    for (n, Known { contact, u_c, stiffness }) in known {
        for load in [0.0, 0.5, -0.5] {
            let drive = wave("drive", Shape::Sawtooth { stroke: stroke * u_c, flyback: 0.0 }, 1.0);
            let mass = 0.02;
            let mut scene = foot_and_slider(drive, mass, contact.clone());
            let damping = 2.0 * (stiffness * mass).sqrt();
            scene.springs.push(named("drag", damper([Side::Ground, Side::Body(1)], damping)));
            scene.loads.push(push(1, -load * MU * FORCE));
            // The slow phase ends just before the jump.
            let (model, state) = end(&scene, &event(1e-8, 9.999));
            let earlier = end(&scene, &event(1e-8, 8.999)).1;
            let step = (state.body(&model, 1).unwrap().0 - earlier.body(&model, 1).unwrap().0) / u_c;
            let ideal = (stroke - zero_step_stroke(n, load)).max(0.0);
            println!("n = {n}, λ = {load}: {step:.5} u_c, ideal {ideal:.5}, {:?}", state.counts());
            assert!((step - ideal).abs() < 1e-3);
        }
    }
}

/// Body without contacts under a sinusoidal force, alone and on a spring: x = A(t - sin ωt/ω)/mω and, with ω₀² = k/m, x = A(sin
/// ωt - (ω/ω₀) sin ω₀t)/m(ω₀² - ω²).
#[test]
fn what_nothing_touches_obeys_the_tolerance() {
    let (mass, period, amplitude) = (0.0353, 1.6e-3, 0.165);
    let omega = TAU / period;
    for own in [0.0, 0.03, 0.3, 3.0, 30.0].map(|ratio| ratio * omega) {
        let mut scene = Scene { bodies: vec![named("mass", free(mass))], ..Scene::default() };
        scene.waveforms.push(wave("pull", sine(amplitude), period));
        scene.loads.push(Load { x: Varying::Follows(0), ..push(0, 0.0) });
        if own > 0.0 {
            let stiffness = mass * own * own;
            scene.springs.push(named("spring", Spring { stiffness, ..damper(GROUND_SLIDER, 0.0) }));
        }
        let exact = |t: f64| {
            if own == 0.0 {
                amplitude / (mass * omega) * (t - (omega * t).sin() / omega)
            } else {
                let swing = (omega * t).sin() - omega / own * (own * t).sin();
                amplitude / (mass * (own * own - omega * omega)) * swing
            }
        };
        // One tolerance per oscillation: there is no damping.
        let swings = 10.0 * (own / omega).max(1.0);
        for tolerance in [1e-4, 1e-6, 1e-9, 1e-12] {
            let (model, state, rows) = trace(&scene, &event(tolerance, 10.0 * period), 0.125 * period);
            let x = column(&model, &rows, "mass.x_m");
            let times = column(&model, &rows, "time_s");
            let most = times.iter().map(|t| exact(*t).abs()).fold(0.0, f64::max);
            let errors = times.iter().zip(&x).map(|(t, x)| (x - exact(*t)).abs());
            let off = errors.fold(0.0, f64::max) / most;
            println!("{own:.0}/s at {tolerance:e}: {off:.1e}, {:?}", state.counts());
            assert!(off < swings * tolerance, "{own}/s at {tolerance:e}: {off:e}");
        }
    }
}

/// Step load on a free mass over 15 m, and on a damper: x = Ft²/2m and F/c [t - m/c (1 - e^{-ct/m})].
#[test]
fn a_step_of_load_over_metres_takes_few_steps() {
    let (mass, force) = (1e-3, 0.03);
    for (drag, lasts) in [(0.0, 1.0), (0.1, 0.1), (1.0, 1.0)] {
        for tolerance in [1e-6, 1e-9, 1e-12] {
            let mut scene = Scene { bodies: vec![named("mass", free(mass))], ..Scene::default() };
            let step = Waveform::new(Shape::Step { height: force, at: 0.0 }, Timing::every(1.0)).unwrap();
            scene.waveforms.push(named("push", step));
            scene.loads.push(Load { x: Varying::Follows(0), ..push(0, 0.0) });
            if drag > 0.0 {
                scene.springs.push(named("drag", damper(GROUND_SLIDER, drag)));
            }
            let (model, state) = end(&scene, &event(tolerance, lasts));
            let x = state.body(&model, 0).unwrap().0;
            let fade = drag / mass * lasts;
            let exact = if drag == 0.0 {
                0.5 * force / mass * lasts * lasts
            } else {
                force / drag * (lasts + mass / drag * (-fade).exp_m1())
            };
            println!("{drag} N s/m at {tolerance:e}: {:e}, {:?}", x / exact - 1.0, state.counts());
            assert!((x / exact - 1.0).abs() < 10.0 * tolerance.max(1e-14), "{drag} N s/m: {x} m");
            assert!(state.counts().steps < 5000, "{drag} N s/m at {tolerance:e}: {:?}", state.counts());
        }
    }
}

/// Slider under 0.9 μF_N from equilibrium: u = u_c[1-(1-0.9)^{1/p}] remains constant.
#[test]
fn hold_at_nine_tenths_of_the_limit() {
    for (p, known) in [(2.0, Known::cone(GROUND_SLIDER, 0.01)), (1.5, Known::paraboloid(GROUND_SLIDER, 1e-3))]
    {
        let mass = 0.02;
        let mut scene = Scene { bodies: vec![named("slider", free(mass))], ..Scene::default() };
        scene.contacts.push(named("ball", known.contact));
        scene.loads.push(push(0, 0.9 * MU * FORCE));
        scene.start = Start::Equilibrium;
        let period = TAU * (mass / known.stiffness).sqrt();
        let duration = 1e5 * period;
        let (model, state, rows) = trace(&scene, &event(1e-8, duration), duration / 200.0);
        let held = known.u_c * (1.0 - 0.1_f64.powf(1.0 / p));
        let (x, v) = (column(&model, &rows, "slider.x_m"), column(&model, &rows, "slider.vx_m_s"));
        // The force is exact to rounding; the tangent stiffness is 0.1^{1-1/p} of the initial one.
        assert!((x[0] / held - 1.0).abs() < 1e-13, "{:e}", x[0] / held - 1.0);
        let ulps = f64::EPSILON * known.u_c;
        let (spread, speed) = (
            x.iter().map(|now| (now - x[0]).abs()).fold(0.0, f64::max) / ulps,
            v.iter().map(|v| v.abs()).fold(0.0, f64::max) * period / TAU / ulps,
        );
        println!("p = {p}: moved by {spread:.1} ulps of u_c, speed {speed:.1}, {:?}", state.counts());
        assert!(spread <= 16.0 && speed <= 16.0);
    }
}

/// Maxima of a mass released at 0.3 u_c on a sphere: 0.26603, 0.18644, 0.13775, 0.09176, 0.05576 of u_c after 1, 5, 10, 20, 40 periods.
#[test]
fn free_decay() {
    let published = [(1, 0.26603), (5, 0.18644), (10, 0.13775), (20, 0.09176), (40, 0.05576)];
    // a/R = 1e-3: sphere and paraboloid differ by 1e-6.
    for profile in [Profile::paraboloid(0.1), Profile::sphere(0.1)] {
        let mut known = Known::paraboloid(GROUND_SLIDER, 0.1);
        known.contact = of_profile(profile.unwrap(), &known.contact);
        known.contact.start = ContactStart::Displacement(0.3 * known.u_c);
        let mass = 0.02;
        let mut scene = Scene { bodies: vec![named("slider", free(mass))], ..Scene::default() };
        scene.contacts.push(named("ball", known.contact));
        let period = TAU * (mass / known.stiffness).sqrt();
        let (model, _, rows) = trace(&scene, &event(1e-10, 45.0 * period), period);
        let u = crate::parts::channel(&model, "ball.u_m");
        let turns: Vec<f64> = rows
            .events()
            .filter(|(e, _)| e.kind == EventKind::Reversal && e.source == Source::Contact(0))
            .map(|(_, row)| row[u] / known.u_c)
            .collect();
        for (periods, maximum) in published {
            let turn = turns[2 * periods - 1];
            println!("after {periods}: {turn:.6}, published {maximum}");
            assert!((turn - maximum).abs() < 1e-5);
        }
    }
}

/// Heavy slider on x = A(sin ωt + b sin 2ωt), b ≤ 1/4: it drifts at -2bAω, the median of the foot's velocity.
#[test]
fn heavy_slider_on_two_harmonics() {
    let (amplitude, omega, b) = (50e-6, TAU * 1e3, 0.2);
    let known = Known::paraboloid(FOOT_SLIDER, 1e-3);
    let terms = [(1.0, 1.0), (b, 2.0)].map(|(part, order)| Harmonic {
        amplitude: part * amplitude,
        order,
        phase: 0.0,
    });
    let drive = wave("drive", Shape::Harmonics { terms: terms.to_vec() }, 1e-3);
    // μF_N/m is 1/100 of the foot's acceleration; u_c some 1/600 of its amplitude.
    let mass = MU * FORCE / (0.01 * amplitude * omega * omega);
    let scene = foot_and_slider(drive, mass, known.contact);
    let (model, _, rows) = trace(&scene, &event(1e-8, 0.4), 0.01);
    let x = column(&model, &rows, "slider.x_m");
    let speed = (x[40] - x[35]) / 0.05;
    println!("{:.5} of -2bAω, u_c/A = {:.4}", speed / (-2.0 * b * amplitude * omega), known.u_c / amplitude);
    assert!((speed / (-2.0 * b * amplitude * omega) - 1.0).abs() < 1e-3);
}

/// Mean friction of a rigid contact sliding at v₀ on a foot that vibrates along the motion: (2/π)asin(v₀/v₁) μF_N.
#[test]
fn friction_under_tangential_vibration() {
    let (amplitude, period) = (50e-6, 1e-3);
    let fastest = amplitude * TAU / period;
    for ratio in [0.2, 0.5, 0.8] {
        let known = Known::paraboloid(FOOT_SLIDER, 1e-3);
        let mut scene =
            Scene { waveforms: vec![wave("shaking", sine(amplitude), period)], ..Scene::default() };
        let points = vec![(0.0, 0.0), (1.0, -ratio * fastest)];
        let sliding = Waveform::new(Shape::Table { points }, Timing::every(1.0)).unwrap();
        scene.waveforms.push(named("sliding", sliding));
        scene.bodies = vec![named("foot", follower(0)), named("slider", follower(1))];
        scene.contacts.push(named("ball", known.contact));
        let rows_per_period = 20_000;
        let (model, _, rows) = trace(&scene, &event(1e-8, 2.0 * period), period / f64::from(rows_per_period));
        let force = column(&model, &rows, "ball.fx_N");
        let second = &force[rows_per_period as usize..2 * rows_per_period as usize];
        let mean = second.iter().sum::<f64>() / f64::from(rows_per_period) / (MU * FORCE);
        let rigid = 2.0 / PI * ratio.asin();
        println!("v₀/v₁ = {ratio}: {mean:.5}, rigid {rigid:.5}, u_c/A = {:.5}", known.u_c / amplitude);
        // Limit: u_c small against the amplitude.
        assert!((mean - rigid).abs() < 1e-3);
    }
}

/// m ẍ + c ẋ + k x = F₀ + preload from rest: x = X[1 - e^{-δt}(cos ω_d t + (δ/ω_d) sin ω_d t)].
#[test]
fn damped_oscillator_under_a_step_load() {
    let (mass, stiffness, damping, force, preload) = (0.5, 2e4, 12.0, 3.0, 0.7);
    let mut scene = Scene { bodies: vec![named("mass", free(mass))], ..Scene::default() };
    scene.springs.push(named("spring", Spring { stiffness, preload, ..damper(GROUND_SLIDER, damping) }));
    scene.loads.push(push(0, force));
    // A tenth of the force comes from the slope: -m g sin(incline).
    let incline = (-0.1 * force / (mass * 9.81)).asin();
    scene.gravity = Gravity { acceleration: 9.81, incline };
    let (delta, rest) = (0.5 * damping / mass, (1.1 * force + preload) / stiffness);
    let omega = (stiffness / mass - delta * delta).sqrt();
    let exact =
        |t: f64| rest * (1.0 - (-delta * t).exp() * ((omega * t).cos() + delta / omega * (omega * t).sin()));
    for (stepper, allowed) in [
        (Stepper::Event { tolerance: 1e-11 }, 1e-10),
        (Stepper::Dopri5 { tolerance: 1e-11 }, 1e-8),
        (Stepper::Rk4 { step: 1e-5 }, 1e-9),
        (Stepper::Verlet { step: 1e-5 }, 1e-5),
    ] {
        let (model, _, rows) = trace(&scene, &plan(stepper, 0.2), 0.02);
        let x = column(&model, &rows, "mass.x_m");
        let t = column(&model, &rows, "time_s");
        let ends = [0, t.len() - 1];
        let worst =
            |places: &[usize]| places.iter().map(|i| (x[*i] - exact(t[*i])).abs()).fold(0.0, f64::max) / rest;
        let (all, last) = (worst(&(0..t.len()).collect::<Vec<_>>()), worst(&ends));
        println!("{stepper:?}: off by {all:.1e} in any row, {last:.1e} at the end");
        assert!(last < allowed && all < allowed, "{stepper:?}: {all:e} {last:e}");
    }
}

/// A mass on a stack whose stroke is a sine: X/S = |k + icω|/|k - mω² + icω|, below, at and above resonance.
#[test]
fn piezo_stack_follows_its_resonance_curve() {
    let (mass, stiffness, ratio, stroke) = (0.02_f64, 20e6_f64, 0.05, 1e-7);
    let natural = (stiffness / mass).sqrt();
    let damping = 2.0 * ratio * natural * mass;
    for part in [0.3, 1.0, 2.5] {
        let omega = part * natural;
        let mut scene = Scene { bodies: vec![named("end", free(mass))], ..Scene::default() };
        scene.waveforms.push(wave("voltage", sine(stroke), TAU / omega));
        let stroke_of = Varying::Follows(0);
        scene
            .actuators
            .push(named("stack", Actuator { damping, ..piezo(GROUND_SLIDER, stiffness, stroke_of) }));
        // e^{-0.05 ω₀ t} is below 1e-13.
        let settled = (100.0 * part).ceil() * TAU / omega;
        let (model, _, rows) = trace(&scene, &event(1e-11, settled + TAU / omega), TAU / omega / 64.0);
        let x = column(&model, &rows, "end.x_m");
        let last = &x[x.len() - 65..x.len() - 1];
        // First harmonic over one period.
        let sum = |f: fn(f64) -> f64| {
            last.iter().enumerate().map(|(i, x)| x * f(TAU * i as f64 / 64.0)).sum::<f64>() / 32.0
        };
        let amplitude = sum(f64::cos).hypot(sum(f64::sin)) / stroke;
        let loss = damping * omega;
        let exact = stiffness.hypot(loss) / (stiffness - mass * omega * omega).hypot(loss);
        println!("ω = {part} ω₀: {amplitude:.10}, exact {exact:.10}");
        assert!((amplitude / exact - 1.0).abs() < 1e-8);
    }
}

/// Spring and contact share a load: F = k x + μF_N[1-(1-x/u_c)^p].
#[test]
fn equilibrium_of_a_spring_beside_a_contact() {
    let known = Known::paraboloid(GROUND_SLIDER, 1e-3);
    let (x, stiffness) = (0.4 * known.u_c, 0.3 * known.stiffness);
    let load = stiffness * x + MU * FORCE * (1.0 - 0.6_f64.powf(1.5));
    let mut scene = Scene { bodies: vec![named("slider", free(0.02))], ..Scene::default() };
    scene.contacts.push(named("ball", known.contact));
    scene.springs.push(named("tie", Spring { stiffness, ..damper(GROUND_SLIDER, 0.0) }));
    scene.loads.push(push(0, load));
    scene.start = Start::Equilibrium;
    let model = Model::new(&scene).unwrap();
    let state = model.start(&event(1e-8, 1.0)).unwrap();
    let (found, v) = state.body(&model, 0).unwrap();
    assert!((found / x - 1.0).abs() < 1e-12, "{:e}", found / x - 1.0);
    assert_eq!(v, 0.0);
}

/// Two sliders in series carry one load: gross slip begins in each contact as if alone.
#[test]
fn equilibrium_of_two_sliders_in_series() {
    let (lower, upper) = (Known::paraboloid(GROUND_SLIDER, 1e-3), Known::cone(FOOT_SLIDER, 0.01));
    let mut scene =
        Scene { bodies: vec![named("lower", free(0.02)), named("upper", free(0.01))], ..Scene::default() };
    scene.contacts = vec![named("a", lower.contact), named("b", upper.contact)];
    scene.loads.push(push(1, 0.7 * MU * FORCE));
    scene.start = Start::Equilibrium;
    let model = Model::new(&scene).unwrap();
    let state = model.start(&event(1e-8, 1.0)).unwrap();
    let first = lower.u_c * (1.0 - 0.3_f64.powf(1.0 / 1.5));
    let second = first + upper.u_c * (1.0 - 0.3_f64.powf(0.5));
    for (body, x) in [(0, first), (1, second)] {
        let found = state.body(&model, body).unwrap().0;
        assert!((found / x - 1.0).abs() < 1e-9, "{body}: {:e}", found / x - 1.0);
    }
}

#[test]
fn no_equilibrium_beyond_the_limit_of_friction() {
    let known = Known::paraboloid(GROUND_SLIDER, 1e-3);
    let mut scene = Scene { bodies: vec![named("slider", free(0.02))], ..Scene::default() };
    scene.contacts.push(named("ball", known.contact));
    scene.loads.push(push(0, 1.1 * MU * FORCE));
    scene.start = Start::Equilibrium;
    let error = Model::new(&scene).unwrap().start(&event(1e-8, 1.0)).unwrap_err();
    assert_eq!((error.part, error.field), (Part::Run, Field::Start));
    let message = error.fault.to_string();
    assert!(message.contains("slider") && error.fault.advice().is_some(), "{error}");
    // A tenth of the limit remains unbalanced.
    assert!(message.contains("e-2 N"), "{error}");
}
