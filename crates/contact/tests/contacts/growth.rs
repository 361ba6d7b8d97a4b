//! Tests of the friction work when curved growth paths are erased: the memory stores chords, and the energy balance must hold.

use super::thinning::{DEPTH, Path, grown, paraboloid};
use stickslip_contact::{Apex, Curve, Interface, Segment};

/// Number of intervals of a path in the force integral.
const STEPS: u32 = 20_000;
/// Nodes and weights of Simpson's rule.
const SIMPSON: [(f64, f64); 3] = [(0.0, 1.0 / 6.0), (0.5, 4.0 / 6.0), (1.0, 1.0 / 6.0)];

/// Friction work of a straight path and its expected value, ∫F_x du minus the gain of elastic energy.
fn lost(law: &Interface, curve: &Curve, to: Apex) -> [f64; 2] {
    let (from, stored) = (curve.apex(), curve.elastic(law));
    let place = |x: f64| Apex { d: from.d + x * (to.d - from.d), u: from.u + x * (to.u - from.u) };
    let force = |x: f64| curve.preview(law, place(x)).force;
    let mean = |k: u32| -> f64 {
        SIMPSON.iter().map(|(x, weight)| weight * force((f64::from(k) + x) / f64::from(STEPS))).sum()
    };
    let work = (0..STEPS).map(mean).sum::<f64>() / f64::from(STEPS) * (to.u - from.u);
    let mut after = curve.clone();
    let friction = after.commit(law, Segment::Straight(to)).unwrap();
    [friction, work - (after.elastic(law) - stored)]
}

/// Tests both directions, partly and completely through the growth path, at constant and at decreasing indentation.
#[test]
fn books_of_a_bent_path_close() {
    let law = paraboloid();
    let u_c = law.gross_slip_displacement(DEPTH);
    for bend in [0.8, -0.8] {
        let path = Path { beta: 0.4 * law.stick_slope(), bend };
        for pieces in [5, 20, 80] {
            let (curve, _) = grown(&law, &path, pieces, 1024);
            for (share, depth) in
                [(-2.0, 1.0), (-0.7, 1.0), (0.3, 1.0), (0.9, 1.0), (2.0, 1.0), (0.5, 0.7), (-0.5, 0.7)]
            {
                let to = Apex { d: depth * DEPTH, u: path.u(1.0) + share * u_c };
                let [friction, balance] = lost(&law, &curve, to);
                let off = (friction / balance - 1.0).abs();
                let allowed = 0.02 / f64::from(pieces).powi(3);
                println!("{bend}, {pieces} pieces, {share} u_c to {depth}: {friction:e} J, {off:.1e} off");
                assert!(off < allowed, "{bend}, {pieces} pieces, {share} u_c: {friction:e} for {balance:e}");
            }
        }
    }
}
