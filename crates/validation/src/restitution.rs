//! Restitution of an impact on a contact with damping along the normal: known coefficients of three profiles.

use crate::check::{Check, worst};
use crate::page::{Kind, Page};
use crate::picture::{axis, curve, points};
use crate::subject::ValidationError;
use crate::table::{Table, places, significant};
use stickslip_contact::{Interface, Pair, Profile};
use stickslip_plot::{Figure, Ink, Label, Panel};
use stickslip_run::Job;
use stickslip_scenario::Scenario;

pub(crate) const NAME: &str = "restitution";

const SCENARIO: &str = include_str!("../../../scenarios/bounce.json");
/// Dimensionless damping b and e of paraboloid, cone and flat punch.
const KNOWN: [[f64; 4]; 4] = [
    [0.05, 0.91797, 0.90906, 0.92560],
    [0.1, 0.84437, 0.82875, 0.85876],
    [0.2, 0.71885, 0.69410, 0.74408],
    [0.4, 0.53350, 0.50006, 0.57174],
];
/// Mass, kg, and speed of the impacts, m/s.
const MASS: f64 = 4.08e-3;
const SPEED: f64 = 20e-3;

/// Profiles with the exponent p of F_N = Kd^p and their keys in a scenario.
fn profiles() -> Result<[(Profile, f64, &'static str); 3], ValidationError> {
    Ok([
        (Profile::paraboloid(5e-3)?, 1.5, r#"{"paraboloid": {"radius": "5 mm"}}"#),
        (Profile::cone(0.1)?, 2.0, r#"{"cone": {"slope": 0.1}}"#),
        (Profile::flat(50e-6)?, 1.0, r#"{"flat": {"radius": "50 um"}}"#),
    ])
}

/// Returns the coefficient of restitution of a simulated impact.
fn rebound(profile: &str, damping: f64) -> Result<f64, ValidationError> {
    let set = [
        ("contacts.plate.profile", profile.to_owned()),
        ("contacts.plate.damping", format!(r#"{{"normal": {damping:.15e}}}"#)),
        ("bodies.ball.start", format!(r#"{{"z": 0, "vz": {:e}}}"#, -SPEED)),
        ("gravity.acceleration", "0".to_owned()),
        ("run.duration", "5 ms".to_owned()),
        ("run.stepper", r#"{"event": {"tolerance": 1e-10}}"#.to_owned()),
        ("plots", "[]".to_owned()),
    ];
    let values: Vec<(&str, &str)> = set.iter().map(|(path, value)| (*path, value.as_str())).collect();
    let job = Job::new(Scenario::from_str_with(SCENARIO, NAME, "", &values)?, NAME.to_owned(), "".into())?;
    let outcome = job.run(&());
    if let Some(error) = outcome.error {
        return Err(error.into());
    }
    let rate = outcome.state.coordinate(&job.model, 0, stickslip_drive::scene::Axis::Z);
    rate.map(|(_, rate)| rate / SPEED).ok_or(ValidationError::NoBall)
}

pub(crate) fn page() -> Result<Page, ValidationError> {
    let steel = stickslip_contact::Material::new(210e9, 0.3)?;
    let heads = &["b", "profile", "β_n, µs", "e, reference", "e, program", "off by"];
    let mut table = Table::new("Coefficients of restitution:", heads);
    let (mut off, mut curves, mut dots) = (Vec::new(), Vec::new(), Vec::new());
    for (place, (profile, power, key)) in profiles()?.into_iter().enumerate() {
        let word = ["paraboloid", "cone", "flat"][place];
        let law = Interface::new(Pair::new(steel, steel), profile, 0.0)?;
        let stiffness = law.normal_force(1e-6) / math::powf(1e-6, power);
        let time = math::powf(MASS / (stiffness * math::powf(SPEED, power - 1.0)), 1.0 / (power + 1.0));
        for row in KNOWN {
            let (b, e) = (row[0], row[place + 1]);
            let found = rebound(key, b * time)?;
            off.push(found - e);
            let cells = [places(b, 2), word.to_owned(), significant(1e6 * b * time, 3)];
            table.row(cells.into_iter().chain([places(e, 5), places(found, 5), significant(found - e, 1)]));
            dots.push((b, e));
        }
        let own = (0..=50).map(|k| {
            let b = 0.01 * f64::from(k);
            (b, law.restitution((MASS, SPEED), b * time))
        });
        curves.push(curve(word, own, Ink::Palette(place)));
    }
    curves.push(points("reference", dots, Ink::Muted));
    Ok(Page {
        name: NAME,
        title: "Restitution: damping along the normal",
        setup: "A body of 4.08 g hits a plate at 20 mm/s without other forces. The contact is damped along the normal with the time β_n: it is \
                that of the elastic contact pressed by d + β_nḋ. The profile is a paraboloid, a cone or a flat punch."
            .to_owned(),
        command: "Command for impacts under gravity with a given coefficient:\n\n```sh\nstickslip run scenarios/bounce.json\n```".to_owned(),
        reference: "mz̈ = -K(d + β_nḋ)^p from d = 0 to d + β_nḋ = 0, integrated by another program with an error of 1e-11. The \
                    coefficient of restitution e depends only on p and b = β_n(Kv^(p-1)/m)^(1/(p+1))."
            .to_owned(),
        kind: vec![Kind::OtherCode],
        checks: vec![Check::new("coefficient of restitution, 12 impacts", "", worst(off), 1e-5)],
        figure: Figure {
            title: Label::plain("Restitution by damping along the normal"),
            panels: vec![Panel {
                x: axis("b", ""),
                y: axis("coefficient of restitution", ""),
                series: curves,
                ..Panel::default()
            }],
            size: (1200, 800),
            ..Figure::default()
        },
        shows: "e falls from 1 with a slope of about 1.7 in b for all three profiles.".to_owned(),
        tables: vec![table],
        limits: "Plastic impacts have another dependence on the speed: here 1 - e is proportional to v^(1/5) for a paraboloid.".to_owned(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_restitution_keeps_its_limit() {
        let page = page().unwrap();
        assert!(page.checks.iter().all(Check::holds), "{:?}", page.checks);
    }
}
