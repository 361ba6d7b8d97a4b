//! Comparison with the theory of oblique impact of a solid sphere.

use crate::bounce::{Shot, ratio};
use crate::check::{Check, worst};
use crate::page::{Kind, Page};
use crate::picture::{axis, curve, points};
use crate::subject::ValidationError;
use crate::table::{Table, places};
use stickslip_plot::{Arrangement, Dash, Figure, Ink, Label, Panel};
use stickslip_run::Watcher;

pub(crate) const NAME: &str = "impact_theory";

/// ψ₁ and ψ₂ at ν = 0.3, integrated in extended precision with all changes of stick and slip located.
const KNOWN: [(f64, f64); 6] = [
    (0.5, 0.047_831),
    (1.0, -0.059_697),
    (1.5, -0.428_017),
    (2.0, -0.837_210),
    (3.0, -1.379_683),
    (4.0, -1.436_512),
];
/// ψ₁ for the closed form of slip throughout.
const GROSS: [f64; 6] = [4.8, 5.0, 6.0, 8.0, 12.0, 20.0];

/// Returns χ = (7/4)G\*/E\* of a solid sphere.
fn chi() -> f64 {
    1.75 * ratio()
}

pub(crate) fn page(watcher: &dyn Watcher) -> Result<Page, ValidationError> {
    let psi = |psi: f64| Ok::<f64, ValidationError>(Shot::at_psi(psi).rebound(watcher)?.psi());
    let mut known = Table::new("Cases with stick:", &["ψ₁", "program", "known", "off by"]);
    let mut integrated = Vec::new();
    for (before, after) in KNOWN {
        let found = psi(before)?;
        integrated.push(found - after);
        known.row([before.to_string(), places(found, 7), places(after, 6), places(found - after, 7)]);
    }
    let mut closed = Table::new("Slip throughout:", &["ψ₁", "program", "ψ₁ - 4χ"]);
    let mut slipping = Vec::new();
    for before in GROSS {
        let found = psi(before)?;
        slipping.push(found - (before - 4.0 * chi()));
        closed.row([before.to_string(), places(found, 8), places(before - 4.0 * chi(), 8)]);
    }
    let mut smooth = Vec::new();
    for step in 0..=64 {
        let before = 0.125 * f64::from(step);
        smooth.push((before, psi(before)?));
    }
    Ok(Page {
        name: NAME,
        title: "Oblique impact: theory",
        setup: SETUP.to_owned(),
        command: format!("Command for ψ₁ = 2:\n\n```sh\n{}\n```", Shot::at_psi(2.0).command()),
        reference: REFERENCE.to_owned(),
        kind: vec![Kind::ClosedForm, Kind::OtherCode],
        checks: vec![
            Check::new("ψ₂ with slip throughout", "", worst(slipping), 1e-8),
            Check::new(
                "ψ₂ with stick, half a unit of the last digit",
                "",
                worst(integrated),
                5e-7,
            ),
        ],
        figure: figure(smooth),
        shows:
            "At small ψ₁ the contact sticks, and its springs reverse the motion. At large ψ₁ it slips throughout."
                .to_owned(),
        tables: vec![known, closed],
        limits: LIMITS.to_owned(),
    })
}

const SETUP: &str = "A solid sphere without spin hits a plane of its own material (ν = 0.3) with full normal restitution (Maw, Barber, \
Fawcett, Wear 38, 1976). The scaled tangential velocity of the contact point is ψ = (G\\*/(E\\*μ)) V_x/V_z, where V_z is the velocity \
of approach. ψ₂ after the impact depends only on ψ₁ before it and on χ = (7/4)G\\*/E\\*.";
const REFERENCE: &str = "For ψ₁ ≥ 4χ-1 the contact slips throughout, and momentum gives ψ₂ = ψ₁-4χ exactly. For smaller ψ₁ it sticks for \
part of the impact. An independent program integrated these cases in long double precision and located every change of stick and slip. \
Rows of up to 32 000 springs confirm its values.";
const LIMITS: &str = "For the cases with stick, the reference uses the same contact theory. The page shows that motion and contact are \
integrated correctly together. The [measurement](measured_impact.md) and the [finite elements](finite_elements.md) check the theory. \
Curves of other authors (Maw, Barber and Fawcett 1976, Jäger 1994) are not compared, as their numbers were not available.";

fn figure(smooth: Vec<(f64, f64)>) -> Figure<'static> {
    let from = 4.0 * chi() - 1.0;
    let straight = [(from, from - 4.0 * chi()), (8.0, 8.0 - 4.0 * chi())];
    let straight = crate::picture::line("ψ_1 - 4χ", straight, Ink::Muted, Dash::Dashed);
    let panel = Panel {
        x: axis("before the impact ψ_1", ""),
        y: axis("after it ψ_2", ""),
        series: vec![
            curve("stickslip", smooth, Ink::Palette(0)),
            straight,
            points("integrated elsewhere", KNOWN, Ink::Palette(1)),
        ],
        ..Panel::default()
    };
    Figure {
        title: Label::plain("Oblique impact of a solid sphere, ν = 0.3"),
        panels: vec![panel],
        arrangement: Arrangement::Row,
        size: (1600, 900),
        ..Figure::default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Limits of this page, independent of the page itself.
    #[test]
    fn the_theory_of_oblique_impact_is_met() {
        let page = page(&()).unwrap();
        let found: Vec<f64> = page.checks.iter().map(|check| check.found).collect();
        let [slipping, integrated] = found[..] else { panic!("{found:?}") };
        assert!(slipping <= 1e-8 && integrated <= 5e-7, "{found:?}");
    }
}
