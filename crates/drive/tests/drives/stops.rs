//! End stops against an event integration of their own.

use crate::parts::{channel, event, free, named, plan, trace};
use stickslip_drive::scene::{Body, Direction, Load, Named, Scene, Stop, Varying};
use stickslip_drive::{EventKind, Stepper};

const MASS: f64 = 0.01;
const STIFFNESS: f64 = 1e6;
const PUSH: f64 = 2.0;

/// A mass pushed by a constant force towards a stop at 1 mm.
fn scene(damping: f64) -> Scene {
    let mut body: Named<Body> = named("slider", free(MASS));
    body.part.x.velocity = 0.2;
    let stop = Stop {
        on: 0,
        direction: Direction::X,
        ends: [Some(-2e-4), Some(1e-3)],
        stiffness: STIFFNESS,
        damping,
    };
    let load = Load { on: 0, x: Varying::Constant(PUSH), ..Load::default() };
    Scene { bodies: vec![body], loads: vec![load], stops: vec![named("travel", stop)], ..Scene::default() }
}

/// Closed forms between events: a parabola before the stop, a damped oscillation about F/k on it, until kp + cṗ = 0.
///
/// Returns the times of touch and leave of the first `count` contacts with the stop, and the position and velocity at the end.
fn own(damping: f64, until: f64, count: usize) -> (Vec<f64>, [f64; 2]) {
    let (w2, beta) = (STIFFNESS / MASS, damping / STIFFNESS);
    let decay = 0.5 * damping / MASS;
    let w = (w2 - decay * decay).sqrt();
    let rest = PUSH / STIFFNESS;
    let (mut t, mut x, mut v, mut on) = (0.0, 0.0, 0.2, false);
    let mut times = Vec::new();
    while times.len() < count {
        if on {
            // p = rest + e^{-δt}(A cos ωt + B sin ωt)
            let (a, b) = (x - 1e-3 - rest, (v + decay * (x - 1e-3 - rest)) / w);
            let at = |s: f64| {
                let (sin, cos) = (w * s).sin_cos();
                let fade = (-decay * s).exp();
                let p = rest + fade * (a * cos + b * sin);
                let rate = fade * ((b * w - decay * a) * cos - (a * w + decay * b) * sin);
                [p, rate]
            };
            let force = |s: f64| at(s)[0] + beta * at(s)[1];
            let step = 1e-4 / w;
            let mut s = step;
            while force(s) > 0.0 && t + s < until {
                s += step;
            }
            let (mut low, mut high) = (s - step, s);
            for _ in 0..80 {
                let middle = 0.5 * (low + high);
                *(if force(middle) > 0.0 { &mut low } else { &mut high }) = middle;
            }
            if t + high > until {
                let [p, rate] = at(until - t);
                return (times, [1e-3 + p, rate]);
            }
            let [p, rate] = at(high);
            (t, x, v, on) = (t + high, 1e-3 + p, rate, false);
        } else {
            // A flight from p ≥ 0 with a negative velocity, or from below, up to p = 0.
            let (pull, gap) = (PUSH / MASS, 1e-3 - x);
            let s = (-v + (v * v + 2.0 * pull * gap).sqrt()) / pull;
            if t + s > until {
                let s = until - t;
                return (times, [x + v * s + 0.5 * pull * s * s, v + pull * s]);
            }
            (t, x, v, on) = (t + s, 1e-3, v + pull * s, true);
        }
        times.push(t);
    }
    (times, [x, v])
}

#[test]
fn a_mass_bounces_on_a_stop_as_in_closed_form() {
    for damping in [0.0, 20.0] {
        let until = 0.05;
        let (own_times, _) = own(damping, until, 8);
        let (_, _, rows) = trace(&scene(damping), &event(1e-12, until), until);
        let found: Vec<f64> = rows
            .events()
            .filter(|(event, _)| matches!(event.kind, EventKind::Touch | EventKind::LiftOff))
            .map(|(event, _)| event.t)
            .collect();
        println!("{damping}: {own_times:?} {found:?}");
        for (own, found) in own_times.iter().zip(&found) {
            assert!((own - found).abs() < 1e-9 * until, "{own} {found}");
        }
        assert!(own_times.len().min(found.len()) >= 6);
    }
}

/// The energy balance closes, and fixed steps converge to located events.
#[test]
fn a_damped_stop_stops() {
    let until = 0.2;
    let (model, _, rows) = trace(&scene(20.0), &event(1e-9, until), 1e-3);
    let last = rows.rows().last().unwrap().to_vec();
    let at = |name: &str| last[channel(&model, name)];
    // At rest kp = F.
    assert!((at("slider.x_m") - (1e-3 + PUSH / STIFFNESS)).abs() < 1e-11, "{}", at("slider.x_m"));
    assert!((at("travel_high.fn_N") / PUSH - 1.0).abs() < 1e-5);
    assert!(at("travel_low.fn_N") == 0.0 && at("travel_low.d_m") < 0.0);
    assert!(at("energy.error_J").abs() < 1e-9 * at("energy.input_J").abs().max(1e-3));
    let (model, _, rows) = trace(&scene(20.0), &plan(Stepper::Rk4 { step: 1e-6 }, until), 1e-3);
    let fixed = rows.rows().last().unwrap()[channel(&model, "slider.x_m")];
    assert!((fixed - at("slider.x_m")).abs() < 1e-10);
}
