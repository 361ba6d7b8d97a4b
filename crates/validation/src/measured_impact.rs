//! Comparison with a measurement: oblique impacts.

use crate::bounce::{RADIUS, Shot};
use crate::check::{Check, rms};
use crate::data::{self, Impacts};
use crate::page::{Kind, Page};
use crate::picture::{axis, curve, line, points};
use crate::subject::ValidationError;
use crate::table::{Table, places};
use stickslip_plot::{Arrangement, Dash, Figure, Ink, Label, Panel};
use stickslip_run::Watcher;

pub(crate) const NAME: &str = "measured_impact";

/// Velocity of all impacts, m/s.
const SPEED: f64 = 3.9;

/// Angle of incidence, degrees; measured value; value of the program; value of the one-spring law.
type Row = (f64, f64, f64, f64);

pub(crate) fn page(watcher: &dyn Watcher) -> Result<Page, ValidationError> {
    let known: Impacts = data::read(data::IMPACTS)?;
    let at = |degrees: f64| Shot::at_angle(SPEED, degrees).rebound(watcher);
    let mut restitution: Vec<Row> = Vec::new();
    for &(angle, measured) in &known.restitution {
        restitution.push((angle, measured, at(angle)?.restitution(), interpolated(&known.one_spring, angle)));
    }
    let mut rebound: Vec<Row> = Vec::new();
    for &(angle, measured) in &known.rebound_deg {
        // With full normal restitution, tan(rebound angle) is the tangential restitution times tan(angle of incidence).
        let spring = interpolated(&known.one_spring, angle) * math::tan(angle.to_radians());
        rebound.push((angle, measured, at(angle)?.angle(), math::atan(spring).to_degrees()));
    }
    let mut smooth = Vec::new();
    for step in 1..=62 {
        let angle = f64::from(step);
        smooth.push((angle, at(angle)?));
    }
    let deviation = |rows: &[Row], of: fn(&Row) -> f64| rms(rows.iter().map(|row| of(row) - row.1));
    let (own, spring) = ((|row: &Row| row.2) as fn(&Row) -> f64, (|row: &Row| row.3) as fn(&Row) -> f64);
    let checks = vec![
        Check::new("rms of the tangential restitution, 8 points", "", deviation(&restitution, own), 0.014),
        Check::new("rms of the rebound angle, 9 points", "°", deviation(&rebound, own), 0.20),
    ];
    let springs = [deviation(&restitution, spring), deviation(&rebound, spring)];
    let tables = vec![
        table("Tangential restitution:", "incidence, °", &restitution, 4),
        table("Rebound angle, °:", "incidence, °", &rebound, 3),
        spins(&known, watcher)?,
    ];
    Ok(Page {
        name: NAME,
        title: "Oblique impact: measurement",
        setup: SETUP.to_owned(),
        command: format!("Command for {}° to the normal:\n\n```sh\n{}\n```", 30.22, Shot::at_angle(SPEED, 30.22).command()),
        reference: format!("{REFERENCE}\n\nSource: {}. One-spring law: {}.", known.source, known.one_spring_source),
        kind: vec![Kind::Measurement],
        checks,
        figure: figure(&known, &smooth.iter().map(|(angle, r)| (*angle, r.restitution(), r.angle())).collect::<Vec<_>>()),
        shows: "At small angles the contact sticks for part of the impact, and its tangential springs reverse the motion. Above 28° it \
                slips throughout, and all laws with the same μ agree. The one-spring law approaches 1 at small angles, where it neither \
                slips nor dissipates energy."
            .to_owned(),
        tables,
        limits: format!(
            "{LIMITS}\n\nThe one-spring law of granular codes has a single tangential spring with a slider. Its rms deviation on the \
             same points is {} in the restitution and {}° in the rebound angle. It is interpolated linearly between its computed \
             angles; below 2.5° its first value applies.",
            places(springs[0], 3),
            places(springs[1], 2)
        ),
    })
}

const SETUP: &str = "A sphere without spin hits a thick plate at 3.9 m/s, at angles between 0 and 62° to the normal. The sphere is \
aluminium oxide (diameter 5 mm, 4000 kg/m³, E 380 GPa, ν 0.23), the plate soda-lime glass (E 70 GPa, ν 0.25). The friction \
coefficient 0.092 was published with the measurement. No parameter is fitted. The scenario \
[measured_impact](../examples/measured_impact.md) has a free body with mass and inertia and a coupled contact. The tolerance of the \
event stepper is 1e-9.";
const REFERENCE: &str = "The velocities of the sphere were measured before and after the impact. The tangential restitution is the \
tangential velocity of the centre after the impact, divided by that before.";
const LIMITS: &str = "The deviations include the error of reading the points from published plots. The normal restitution is 1, as \
published. Alumina on glass is not elastically similar (Dundurs' β = 0.23). The normal stiffness may be [up to 1.8 % \
higher](../theory/contact_mechanics.md#elastic-similarity) than in this theory.\n\nThe measured spin is not checked. It contradicts \
the measured restitution by up to 18 %: angular momentum about the contact point requires ω = 5(1-e_t)v_t/(2R) for every friction \
law. The last table shows both.";

/// Returns linear interpolation between points, and the end values outside.
fn interpolated(points: &[(f64, f64)], x: f64) -> f64 {
    for pair in points.windows(2) {
        if let [(x1, y1), (x2, y2)] = *pair
            && (x1..=x2).contains(&x)
        {
            return y1 + (y2 - y1) * (x - x1) / (x2 - x1);
        }
    }
    let below = points.first().filter(|(first, _)| x < *first);
    below.or(points.last()).map_or(f64::NAN, |(_, y)| *y)
}

fn table(caption: &str, first: &'static str, rows: &[Row], digits: usize) -> Table {
    let mut table =
        Table::new(caption, &[first, "measured", "program", "off by", "one-spring law", "off by"]);
    for &(angle, measured, own, spring) in rows {
        let cells =
            [measured, own, own - measured, spring, spring - measured].map(|value| places(value, digits));
        table.row(std::iter::once(places(angle, 2)).chain(cells));
    }
    table
}

/// Returns the table of measured spins, those of the program, and those implied by the program's restitution.
fn spins(known: &Impacts, watcher: &dyn Watcher) -> Result<Table, ValidationError> {
    let mut table = Table::new(
        "Spin after the impact, rad/s (not checked):",
        &["incidence, °", "measured", "program", "5(1-e_t)v_t/(2R), e_t of the program"],
    );
    for &(angle, measured) in &known.spin_rad_s {
        let shot = Shot::at_angle(SPEED, angle);
        let rebound = shot.rebound(watcher)?;
        let implied = 2.5 * (1.0 - rebound.restitution()) * shot.along / RADIUS;
        let cells = [measured, rebound.spin.abs(), implied].map(|value| places(value, 1));
        table.row(std::iter::once(places(angle, 2)).chain(cells));
    }
    Ok(table)
}

fn figure(known: &Impacts, own: &[(f64, f64, f64)]) -> Figure<'static> {
    let restitution = Panel {
        x: axis("angle of incidence, °", ""),
        y: axis("tangential restitution", ""),
        series: vec![
            line("one-spring law", known.one_spring.clone(), Ink::Muted, Dash::Dashed),
            curve("stickslip", own.iter().map(|(angle, e, _)| (*angle, *e)), Ink::Palette(0)),
            points("measured", known.restitution.clone(), Ink::Palette(1)),
        ],
        ..Panel::default()
    };
    let spring = known
        .one_spring
        .iter()
        .map(|(angle, e)| (*angle, math::atan(e * math::tan(angle.to_radians())).to_degrees()));
    let rebound = Panel {
        x: axis("angle of incidence, °", ""),
        y: axis("angle of the rebound, °", ""),
        series: vec![
            line("one-spring law", spring, Ink::Muted, Dash::Dashed),
            curve("stickslip", own.iter().map(|(angle, _, out)| (*angle, *out)), Ink::Palette(0)),
            points("measured", known.rebound_deg.clone(), Ink::Palette(1)),
        ],
        ..Panel::default()
    };
    Figure {
        title: Label::plain("Alumina on glass at 3.9 m/s, μ = 0.092: nothing fitted"),
        panels: vec![restitution, rebound],
        arrangement: Arrangement::Row,
        size: (1600, 800),
        ..Figure::default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Limits of this page, independent of the page itself.
    #[test]
    fn the_measured_impact_is_met() {
        let page = page(&()).unwrap();
        let [restitution, angle] = &page.checks[..] else { panic!("{:?}", page.checks) };
        assert!(restitution.found <= 0.014 && angle.found <= 0.20, "{restitution:?} {angle:?}");
    }

    #[test]
    fn points_are_joined_by_straight_lines() {
        let points = [(1.0, 10.0), (3.0, 20.0), (4.0, 0.0)];
        for (x, y) in [(0.0, 10.0), (1.0, 10.0), (2.0, 15.0), (3.0, 20.0), (3.5, 10.0), (9.0, 0.0)] {
            assert_eq!(interpolated(&points, x), y);
        }
    }
}
