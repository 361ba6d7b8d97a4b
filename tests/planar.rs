//! Bodies in the plane, from the file to the results.

use crate::program::{Table, number, run_example, summary};
use tempfile::tempdir;

/// Values of a column of numbers.
fn numbers(table: &Table, name: &str) -> Vec<f64> {
    table.column(name).iter().map(|value| value.parse().unwrap()).collect()
}

#[test]
fn a_ball_slides_from_bounce_to_bounce_until_it_rolls() {
    let (mass, inertia, radius, friction, gravity) = (4.08e-3, 4.08e-8, 5e-3, 0.15, 9.80665);
    let (height, speed) = (0.5e-6, 12e-3);
    let out = tempdir().unwrap();
    let folder = run_example("bouncing_ball", out.path(), &[]);
    let trace = Table::read(&folder.join("trace.csv"));
    let [vx, turn] = ["ball.vx_m_s", "ball.vpitch_rad_s"].map(|name| numbers(&trace, name));
    // Friction at the rim brakes and turns at once: m R vx - I θ̇ never changes.
    for (vx, turn) in vx.iter().zip(&turn) {
        let momentum = vx - inertia / (mass * radius) * turn;
        assert!((momentum / speed - 1.0).abs() < 1e-9, "{momentum}");
    }
    // An impact in gross slip all the way takes μ of the normal momentum, 2 m v and the weight meanwhile.
    let events = Table::read(&folder.join("events.csv"));
    let times = |kind: &str| -> Vec<f64> {
        let rows = events.rows.iter().filter(|row| row[1] == "foot" && row[2] == kind);
        rows.map(|row| row[0].parse().unwrap()).collect()
    };
    let (touches, leaves) = (times("touch"), times("lift-off"));
    assert_eq!((touches.len(), leaves.len()), (7, 7));
    let fall = f64::sqrt(2.0 * height / gravity);
    assert!((touches[0] / fall - 1.0).abs() < 1e-9, "free fall");
    for (leave, touch) in leaves.iter().zip(&touches[1..]) {
        // Nothing is lost along the normal.
        assert!(((touch - leave) / (2.0 * fall) - 1.0).abs() < 1e-7, "{leave} to {touch}");
    }
    let after = |t: f64| {
        let place = numbers(&trace, "time_s").iter().position(|time| *time > t).unwrap();
        vx[place]
    };
    for bounce in 0..2 {
        let lost = friction * gravity * (2.0 * fall + leaves[bounce] - touches[bounce]);
        let before = if bounce == 0 { speed } else { after(leaves[bounce - 1]) };
        let left = after(leaves[bounce]);
        assert!(((before - left) / lost - 1.0).abs() < 1e-7, "bounce {bounce}: {left}");
    }
    // In the end it rolls: vx = -R θ̇ = v₀/(1 + I/(m R²)) = 5/7 v₀, but for a little ringing along the slide.
    let (last, rolling) = (vx.len() - 1, 5.0 / 7.0 * speed);
    assert!((vx[last] / rolling - 1.0).abs() < 1e-3, "{}", vx[last]);
    assert!((-radius * turn[last] / rolling - 1.0).abs() < 1e-3, "{}", turn[last]);
    let normal = &summary(&folder)["contacts"]["foot"]["normal"];
    let open = 5e-3 - leaves.iter().zip(&touches).map(|(leave, touch)| leave - touch).sum::<f64>();
    assert!((number(normal, "/open_share") / (open / 5e-3) - 1.0).abs() < 1e-9);
    assert!((number(normal, "/d_m/0") + height).abs() < 1e-15);
}
