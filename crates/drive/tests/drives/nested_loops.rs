//! Many nested loops that one stroke closes.

use crate::parts::{contact, event, follower, named, trace, wave};
use stickslip_contact::Profile;
use stickslip_drive::scene::{Scene, Side};
use stickslip_drive::{EventKind, Shape};

/// Decreasing strokes leave one loop each; a larger stroke closes all of them before gross slip begins, in both directions.
#[test]
fn thousands_of_loops_close_one_by_one() {
    let loops = 6000;
    let reach = |k: usize| 2e-7 * (1.0 - k as f64 / (loops + 1) as f64);
    let turn = |k: usize| if k.is_multiple_of(2) { reach(k) } else { -reach(k) };
    let dt = 1e-3;
    let mut ways: Vec<f64> = (0..2 * loops).map(turn).collect();
    ways.extend([2e-6, -2e-6, 2e-6]);
    let points: Vec<(f64, f64)> =
        std::iter::once(0.0).chain(ways).enumerate().map(|(k, u)| (k as f64 * dt, u)).collect();
    let duration = points.last().map_or(0.0, |(t, _)| *t);
    let between = [Side::Body(0), Side::Ground];
    let scene = Scene {
        waveforms: vec![wave("way", Shape::Table { points }, duration)],
        bodies: vec![named("pin", follower(0))],
        contacts: vec![named("contact", contact(between, Profile::paraboloid(1e-3).unwrap(), 0.3, 10.0))],
        ..Scene::default()
    };
    let (_, _, trace) = trace(&scene, &event(1e-9, duration), duration);
    let count = |kind: EventKind| trace.events().filter(|(event, _)| event.kind == kind).count();
    println!("{} {}", count(EventKind::LoopClosed), count(EventKind::GrossSlip));
    assert_eq!([count(EventKind::GrossSlip), count(EventKind::GrossSlipEnds)], [3, 2]);
}
