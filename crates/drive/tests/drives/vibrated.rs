//! Slider on a vibrating foot, with stick and gross slip twice a period. Alone it uses Nyström's method, with DOP853 before gross
//! slip; next to a body under a varying force it uses DOP853 only.

use crate::parts::{FOOT_SLIDER, contact, end, event, foot_and_slider, free, named, push, sine, wave};
use stickslip_contact::Profile;
use stickslip_drive::Scene;
use stickslip_drive::scene::{Load, Varying};

const PERIOD: f64 = 1e-3;
const AMPLITUDE: f64 = 1e-6;
const DURATION: f64 = 10.0 * PERIOD;

/// The slider's load moves it a little in each period.
fn vibrated() -> Scene {
    let ball = contact(FOOT_SLIDER, Profile::paraboloid(1e-3).unwrap(), 0.15, 1.0);
    let mut scene = foot_and_slider(wave("vibration", sine(AMPLITUDE), PERIOD), 0.1, ball);
    scene.loads.push(push(1, 0.03));
    scene
}

/// The same next to a body under another varying force.
fn beside() -> Scene {
    let mut scene = vibrated();
    scene.waveforms.push(wave("shaking", sine(1e-3), PERIOD));
    scene.bodies.push(named("shaken", free(1.0)));
    scene.loads.push(Load { on: 2, x: Varying::Follows(1), ..Load::default() });
    scene
}

/// Final position of the slider, in amplitudes, and evaluations.
fn ends(scene: &Scene, tolerance: f64) -> (f64, u64) {
    let (model, state) = end(scene, &event(tolerance, DURATION));
    (state.body(&model, 1).unwrap().0 / AMPLITUDE, state.counts().evaluations)
}

/// Both methods agree, and the errors are within each tolerance from 1e-3 to 1e-11.
#[test]
fn every_tolerance_is_kept() {
    let (known, _) = ends(&beside(), 1e-13);
    for exponent in 3..=11 {
        let tolerance = 10_f64.powi(-exponent);
        let [(alone, asked), (other, more)] = [vibrated(), beside()].map(|scene| ends(&scene, tolerance));
        let [own, others] = [alone, other].map(|x| (x - known).abs());
        println!("{tolerance:e}: {own:.1e} with {asked}, {others:.1e} with {more}");
        assert!(own < 10.0 * tolerance && others < 10.0 * tolerance, "{tolerance:e}: {own:e} {others:e}");
    }
}
