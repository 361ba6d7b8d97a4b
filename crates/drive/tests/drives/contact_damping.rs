//! Contact damping β: every spring carries G\*(s + βu̇), limited to its friction limit, so that the force leads by βu̇.

use crate::parts::{
    FOOT_SLIDER, column, contact, damped, damper, end, event, follower, foot_and_slider, free, named,
    of_pair, p1, plan, push, sine, trace, wave,
};
use std::f64::consts::TAU;
use stickslip_contact::{Pair, Profile};
use stickslip_drive::scene::{
    Body, Contact, Coordinate, Direction, Gravity, Normal, Scene, Side, Spring, Start, Varying,
};
use stickslip_drive::{Method, Plan, Shape, Stepper, Timing, Treatment, Waveform};

const MU: f64 = 0.2;
const FORCE: f64 = 1.0;
/// Effective moduli, Pa.
const E: f64 = 1.15e11;
const G: f64 = 0.95e11;

fn known(between: [Side; 2], profile: Profile, damping: f64) -> Contact {
    let pair = Pair::from_moduli(E, G).unwrap();
    damped(&of_pair(pair, &contact(between, profile, MU, FORCE)), damping)
}

/// Flat punch of radius b in full stick, k = 2G\*b: under a step load F the slider satisfies m ẍ + βk ẋ + k x = F, x = X[1 -
/// e^{-δt}(cos ω_d t + (δ/ω_d) sin ω_d t)], δ = βω²/2.
#[test]
fn a_stuck_slider_is_a_damped_oscillator() {
    let (radius, mass, force) = (1e-4, 0.02_f64, 0.3 * MU * FORCE);
    let stiffness = 2.0 * G * radius;
    let omega = (stiffness / mass).sqrt();
    for ratio in [0.02, 0.3, 0.9] {
        let punch = known([Side::Ground, Side::Body(0)], Profile::flat(radius).unwrap(), 2.0 * ratio / omega);
        let mut scene = Scene { bodies: vec![named("slider", free(mass))], ..Scene::default() };
        scene.contacts.push(named("ball", punch));
        scene.loads.push(push(0, force));
        let period = TAU / omega;
        let (model, _, rows) = trace(&scene, &event(1e-12, 5.0 * period), period / 32.0);
        let column = |name: &str| column(&model, &rows, name);
        let (t, x, v) = (column("time_s"), column("slider.x_m"), column("slider.vx_m_s"));
        let (damped, friction) = (column("energy.damping_J"), column("energy.friction_J"));
        let (rest, delta) = (force / stiffness, ratio * omega);
        let fast = (omega * omega - delta * delta).sqrt();
        for i in 0..t.len() {
            let (decay, phase) = ((-delta * t[i]).exp(), fast * t[i]);
            let place = rest * (1.0 - decay * (phase.cos() + delta / fast * phase.sin()));
            let speed = rest * decay * omega * omega / fast * phase.sin();
            assert!((x[i] - place).abs() < 1e-9 * rest && (v[i] - speed).abs() < 1e-9 * rest * omega);
            // Work of the load that is not stored.
            let lost = force * place - 0.5 * stiffness * place.powi(2) - 0.5 * mass * speed.powi(2);
            assert!((damped[i] - lost).abs() < 1e-9 * force * rest, "{:e} {lost:e}", damped[i]);
            assert!(friction[i].abs() < 1e-12 * force * rest);
        }
    }
}

/// Paraboloid under a piecewise linear motion of constant speed.
struct Path {
    u_c: f64,
    u: Vec<f64>,
    force: Vec<f64>,
    damping: Vec<f64>,
}

impl Path {
    /// Through the `corners`, in u_c, with the lead βu̇ in u_c; 200 rows per u_c.
    fn along(corners: &[f64], lead: f64) -> Self {
        let radius = 1e-3;
        let d = (0.75 * FORCE / (E * f64::sqrt(radius))).powf(2.0 / 3.0);
        let u_c = MU * E / G * d;
        let speed = u_c / 1e-3;
        let mut points = vec![(0.0, 0.0)];
        for corner in corners {
            let (t, u) = points[points.len() - 1];
            points.push((t + (corner * u_c - u).abs() / speed, corner * u_c));
        }
        let end = points[points.len() - 1].0;
        let mut scene = Scene::default();
        let path = Waveform::new(Shape::Table { points }, Timing::every(end)).unwrap();
        scene.waveforms.push(named("path", path));
        scene.bodies = vec![named("foot", follower(0)), named("wall", Body::default())];
        let ball = known(FOOT_SLIDER, Profile::paraboloid(radius).unwrap(), lead * u_c / speed);
        scene.contacts.push(named("ball", ball));
        // Rows near the corners, where the force jumps.
        let (model, _, rows) = trace(&scene, &event(1e-10, end), 1e-3 / 199.7);
        let [u, force, damping] =
            ["ball.u_m", "ball.fx_N", "energy.damping_J"].map(|name| column(&model, &rows, name));
        Self { u_c, u, force, damping }
    }
}

/// First loading in units of u_c and μF_N (4.30).
fn virgin(u: f64) -> f64 {
    1.0 - f64::max(0.0, 1.0 - u).powf(1.5)
}

/// Forward to 0.6 u_c, back to 0.4, forward into gross slip, with a lead of 0.15 u_c. The force is the undamped one at u ± lead: it
/// jumps at corners, is continuous where the small loop closes and at the beginning of gross slip, and keeps to Coulomb's law.
#[test]
fn the_force_leads_by_the_damping_time() {
    let lead = 0.15;
    let path = Path::along(&[0.6, 0.4, 1.4], lead);
    let back = virgin(0.6) - 2.0 * virgin(0.1);
    let mut travelled = 0.0;
    for (i, (u, force)) in path.u.iter().zip(&path.force).enumerate().skip(1).take(path.u.len() - 2) {
        let u = u / path.u_c;
        travelled = i as f64 / 199.7;
        let exact = match travelled {
            s if s < 0.6 => virgin(u + lead),
            s if s < 0.8 => virgin(0.6) - 2.0 * virgin(0.5 * (0.6 - u + lead)),
            _ if u + lead < 0.6 => back + 2.0 * virgin(0.5 * (u - 0.4 + lead)),
            _ => virgin(u + lead),
        };
        let found = force / (MU * FORCE);
        assert!((found - exact).abs() < 1e-9, "{travelled} {u}: {found} {exact}");
        assert!(found.abs() <= 1.0 + 1e-12);
    }
    assert!(travelled > 1.7, "{travelled}");
}

/// Work of the damping force in a cycle of amplitude U by Masing's rule: the loop at u + lead minus that at u, by Simpson's rule.
#[test]
fn work_of_damped_springs_in_a_cycle() {
    let lead = 0.1;
    for amplitude in [0.3, 0.8, 1.5] {
        let corners = [amplitude, -amplitude, amplitude, -amplitude, amplitude];
        let path = Path::along(&corners, lead);
        let whole = |path: &Path| path.damping[path.damping.len() - 1];
        let work = whole(&path) - whole(&Path::along(&corners[..3], lead));
        // Forward from -U; beyond U the loop has closed. In gross slip the reversal is at the limit.
        let forward = |u: f64| match u > amplitude {
            true => virgin(u),
            false => -virgin(amplitude) + 2.0 * virgin(0.5 * (u + amplitude)),
        };
        let damping = |u: f64| forward(u + lead) - forward(u);
        // The kinks lie at the ends of the pieces.
        let kinks = [-amplitude, amplitude - lead, 2.0 - amplitude - lead, 2.0 - amplitude, amplitude];
        let mut kinks: Vec<f64> = kinks.into_iter().filter(|u| u.abs() <= amplitude).collect();
        kinks.sort_by(f64::total_cmp);
        let piece = |low: f64, high: f64| {
            // Powers of 3/2 at the end of a piece: nodes crowd towards it.
            let at = |s: f64| high - (high - low) * (1.0 - s) * (1.0 - s);
            let f = |s: f64| damping(at(s)) * 2.0 * (high - low) * (1.0 - s);
            let n = 2000;
            let h = 1.0 / f64::from(n);
            (0..n)
                .map(|k| {
                    let s = f64::from(k) * h;
                    h / 6.0 * (f(s) + 4.0 * f(s + 0.5 * h) + f(s + h))
                })
                .sum::<f64>()
        };
        let exact: f64 =
            2.0 * kinks.windows(2).map(|w| piece(w[0], w[1])).sum::<f64>() * MU * FORCE * path.u_c;
        assert!((work / exact - 1.0).abs() < 1e-6, "{amplitude}: {}", work / exact - 1.0);
    }
}

/// In gross slip no spring sticks, so damped P1 moves along parabolas with |v̇| = μF_N/m without evaluations. Compared with the
/// classical Runge–Kutta method with fixed steps on the full force law.
#[test]
fn a_damped_contact_slides_along_parabolas() {
    let (mut scene, every, stroke) = (p1(), 1e-6, 0.5e-6);
    scene.contacts[0].part = damped(&scene.contacts[0].part, 1e-6);
    let (model, state, rows) = trace(&scene, &event(1e-8, 3e-3), every);
    let (speed, law) = (column(&model, &rows, "slider.vx_m_s"), column(&model, &rows, "ball.state"));
    let lost = column(&model, &rows, "energy.damping_J");
    let change = 0.15 / 0.02 * every;
    let mut slides = 0;
    for i in 1..law.len() {
        if law[i - 1] == 3.0 && law[i] == 3.0 {
            let rise = (speed[i] - speed[i - 1]).abs();
            assert!((rise / change - 1.0).abs() < 1e-9, "{i}: {rise:e} {change:e}");
            assert_eq!(lost[i].to_bits(), lost[i - 1].to_bits(), "{i}");
            slides += 1;
        }
    }
    assert!(slides > 100 && lost[lost.len() - 1] > 0.0, "{slides}");
    let tally = state.tally();
    let told = (tally.steps(Method::Parabola), tally.intervals(0, Treatment::Closed));
    assert!(told.0 >= 3 && told.1 >= 3 && tally.intervals(0, Treatment::General) > told.1, "{told:?}");
    // Steps that divide rise and fall. The undamped slider ends at a distance of 1e-2 strokes.
    let (_, fixed) = end(&scene, &plan(Stepper::Rk4 { step: 1e-4 / 2048.0 }, 3e-3));
    let place = |state: &stickslip_drive::State| state.body(&model, 1).unwrap().0;
    let apart = (place(&state) - place(&fixed)).abs() / stroke;
    println!("{slides} rows of slides, {told:?}, {apart:e} of the stroke apart");
    assert!(apart < 2e-5, "{apart:e}");
}

/// Sphere under a sinusoidal normal load on a foot with a cycloid of twice its period. Gross slip erases the memory once a
/// period, so all steps are equal, up to the kinks of the damping force, which are not located.
#[test]
fn steps_of_a_shrinking_damped_contact_repeat_themselves() {
    let (period, from, tolerance) = (1.913268e-3, 60, 1e-12);
    let ball = contact(FOOT_SLIDER, Profile::sphere(1.139461e-3).unwrap(), 0.402872, 6.332);
    let mut ball = damped(&ball, 1.946487e-6);
    let law = ball.interface.clone();
    let reach = law.stick_slope() * law.indentation(6.332);
    ball.normal = Normal::Force(Varying::Follows(1));
    let drive = Shape::Cycloid { stroke: 4.127795e-6, flyback: 0.1783855e-3 };
    let mut scene = foot_and_slider(wave("drive", drive, period), 6.470415e-3, ball);
    let press = Shape::Sine { amplitude: 2.47516, phase: 6.000572, offset: 6.332111 };
    scene.waveforms.push(wave("press", press, 0.5 * period));
    scene.loads.push(push(1, 0.669446));
    let (model, state, rows) = trace(&scene, &event(tolerance, 140.0 * period), period);
    let place = column(&model, &rows, "slider.x_m");
    let steps: Vec<f64> = place.windows(2).skip(from).map(|w| (w[1] - w[0]) / reach).collect();
    let (least, most) = steps.iter().fold((f64::INFINITY, 0.0), |(a, b), &s| (s.min(a), s.max(b)));
    println!("steps of {least} u_c, {:e} apart, {:?}", most - least, state.counts());
    assert!(steps.len() > 70 && least > 1.0 && most - least < 3e-7, "{:e}", most - least);
}

/// Damped flat punch at the beginning of gross slip, where all springs slip at once: no accumulation of events.
#[test]
fn where_a_damped_flat_punch_gives_way_no_events_accumulate() {
    let (period, from, tolerance) = (1e-3, 60, 1e-12);
    let slope = |profile, friction, force| contact(FOOT_SLIDER, profile, friction, force);
    let paraboloid = slope(Profile::paraboloid(1e-3).unwrap(), 0.15, 2.088);
    let reach = paraboloid.interface.stick_slope() * paraboloid.interface.indentation(2.088);
    let shape = Shape::Trapezoid { stroke: 1e-6, rise: 0.5e-3, hold: 0.1e-3, fall: 0.1e-3 };
    let cone = damped(&slope(Profile::cone(0.05).unwrap(), 0.1, 1.112), 5e-6);
    let mut scene = foot_and_slider(wave("drive", shape, period), 0.02, cone);
    let flat = damped(&slope(Profile::flat(5e-5).unwrap(), 0.1, 2.084), 5e-6);
    scene.contacts.extend([named("flat", flat), named("paraboloid", paraboloid)]);
    scene.loads.push(push(1, -0.0533));
    let (model, state, rows) = trace(&scene, &event(tolerance, 260.0 * period), period);
    let place = column(&model, &rows, "slider.x_m");
    let steps: Vec<f64> = place.windows(2).skip(from).map(|w| (w[1] - w[0]) / reach).collect();
    let (least, most) = steps.iter().fold((f64::INFINITY, 0.0), |(a, b), &s| (s.min(a), s.max(b)));
    println!("steps of {least} u_c, {:e} apart, {:?}", most - least, state.counts());
    assert_eq!(state.counts().detours, 0);
    assert!(least > 1.0 && most - least < 1e-8, "{:e}", most - least);
}

/// Strongly damped contact whose motion before a corner is rounding. A reversal at the time of the corner must not change the
/// direction of slip after it.
#[test]
fn a_contact_that_turns_at_a_corner_goes_where_the_corner_sends_it() {
    let period = 2.978_508_455_376_926e-3;
    let shape = Shape::Trapezoid { stroke: 2.56e-6, rise: 1.787e-3, hold: 0.19e-3, fall: 6.5e-6 };
    let profile = Profile::truncated_paraboloid(5.4e-6, 2.147e-3).unwrap();
    let ball = damped(&contact(FOOT_SLIDER, profile, 0.1737, 1.404e-3), 4e-6);
    let ball = Contact { count: 3, ..ball };
    let scene = foot_and_slider(wave("drive", shape, period), 4.94e-5, ball);
    for tolerance in [1e-6, 1e-8, 1e-9, 1e-10] {
        let (model, state, rows) = trace(&scene, &event(tolerance, 150.0 * period), period);
        let place = column(&model, &rows, "slider.x_m");
        let steps: Vec<f64> = place.windows(2).skip(2).map(|w| w[1] - w[0]).collect();
        let (least, most) = steps.iter().fold((f64::INFINITY, 0.0), |(a, b), &s| (s.min(a), s.max(b)));
        println!("{tolerance:e}: steps of {least} m, {:e} apart, {:?}", most - least, state.counts());
        assert!(least > 2.5e-6 && most - least < 1e-14, "{tolerance:e}: {:e}", most - least);
    }
}

/// Slider on a sine, pressed by a damped spring on three damped balls with different profiles: gross slip begins in one after the
/// other.
#[test]
fn damped_contacts_give_way_one_after_the_other() {
    let period = 1e-3;
    let ball = |profile: Profile, friction, damping| {
        let coupled = Contact { normal: Normal::Coupled, ..contact(FOOT_SLIDER, profile, friction, 0.0) };
        damped(&coupled, damping)
    };
    let sphere = ball(Profile::sphere(3e-3).unwrap(), 0.1, 5e-6);
    let law = sphere.interface.clone();
    let mut scene = foot_and_slider(wave("drive", sine(0.25e-6), period), 0.02, sphere);
    scene.contacts.push(named("paraboloid", ball(Profile::paraboloid(3e-3).unwrap(), 0.1, 1e-6)));
    let power = Profile::power(1.1180339887498947, 1.5).unwrap();
    scene.contacts.push(named("power", ball(power, 0.25, 5e-6)));
    scene.bodies[1].part.z = Coordinate::FREE;
    let between = [Side::Ground, Side::Body(1)];
    let clamp = Spring { direction: Direction::Z, stiffness: 1e3, preload: -1.0, ..damper(between, 20.0) };
    scene.springs.push(named("clamp", clamp));
    scene.gravity = Gravity { acceleration: 9.81, incline: 0.0 };
    scene.loads.push(push(1, 0.024));
    scene.start = Start::Equilibrium;
    let steps = |tolerance: f64| {
        let (model, state, rows) = trace(&scene, &event(tolerance, 150.0 * period), period);
        let reach = law.stick_slope() * column(&model, &rows, "ball.d_m")[0];
        let place = column(&model, &rows, "slider.x_m");
        let steps: Vec<f64> = place.windows(2).skip(60).map(|w| (w[1] - w[0]) / reach).collect();
        let (least, most) = steps.iter().fold((f64::INFINITY, 0.0), |(a, b), &s| (s.min(a), s.max(b)));
        println!("{tolerance:e}: steps of {least} u_c, {:e} apart, {:?}", most - least, state.counts());
        (least, most)
    };
    let (least, most) = steps(1e-12);
    assert!(least > 1.0 && most - least < 3e-7, "{:e}", most - least);
    for tolerance in [1e-4, 1e-6, 1e-8] {
        let (shortest, longest) = steps(tolerance);
        let off = (longest - most).abs().max((shortest - least).abs());
        // The kinks of the damping force are not located; the error estimate notices them.
        assert!(off < 0.5 * tolerance.sqrt(), "{tolerance:e}: {off:e}");
    }
}

/// Damped cone under a growing normal load on a moving foot: full stick, then slip through the path of growth. The damping
/// depends on the pieces of that path. Compared with the classical Runge–Kutta method with fixed steps.
#[test]
fn slip_that_cuts_back_through_a_path_of_growth_is_damped_by_what_sticks() {
    let duration = 6e-6;
    let line = |to: (f64, f64)| {
        let points = vec![(0.0, 0.0), to];
        Waveform::new(Shape::Table { points }, Timing::every(1.0)).unwrap()
    };
    let ball = contact(FOOT_SLIDER, Profile::cone(0.01).unwrap(), 0.2, 0.0);
    let mut ball = damped(&ball, 3e-5);
    ball.normal = Normal::Force(Varying::Follows(1));
    let reach = ball.interface.stick_slope() * ball.interface.indentation(1.44);
    let mut scene = foot_and_slider(named("drive", line((1e-4, 4.75e-7))), 1e-3, ball);
    scene.waveforms.push(named("press", line((4.5e-5, 1.44))));
    scene.loads.push(push(1, -0.4));
    let ended = |plan: &Plan| {
        let (model, state) = end(&scene, plan);
        (state.body(&model, 1).unwrap().0 / reach, state.counts())
    };
    let fixed = |step: f64| ended(&plan(Stepper::Rk4 { step }, duration)).0;
    let (coarse, fine) = (fixed(1e-9), fixed(0.5e-9));
    println!("rk4: {fine}, {:e} apart", fine - coarse);
    assert!((fine - coarse).abs() < 1e-8);
    for tolerance in [1e-4, 1e-6, 1e-8] {
        let (place, counts) = ended(&event(tolerance, duration));
        let off = (place - fine).abs();
        println!("{tolerance:e}: {off:e} off, {counts:?}");
        // Fixed steps find sticking springs by a trial of 1e-6 rad.
        assert!(off < 2.0 * f64::max(tolerance, 1e-7), "{tolerance:e}: {off:e}");
        assert!(counts.evaluations < 400, "{counts:?}");
    }
}
