//! Comparison with the boundary-element program CONTACT: Cattaneo's problem.

use crate::check::{Check, worst};
use crate::data::{self, BoundaryElements, Cattaneo, Spence};
use crate::page::{Kind, Page};
use crate::picture::{axis, curve, points};
use crate::subject::ValidationError;
use crate::table::{Table, places, significant};
use crate::worked::worked;
use stickslip_contact::{
    Apex, Curve, FirstLoading, Interface, Material, NormalGiven, Pair, Profile, Segment, TangentialGiven,
};
use stickslip_plot::{Arrangement, Figure, Ink, Label, Panel, Reference};

pub(crate) const NAME: &str = "contact";

/// Allowed deviation due to the grids of CONTACT, %.
const ASKED: f64 = 0.2;

/// First loading with maximum pressure, Pa, and energies, J.
pub(crate) struct Loaded {
    pub(crate) state: FirstLoading,
    pub(crate) peak: f64,
    pub(crate) elastic: f64,
    pub(crate) friction: f64,
}

/// Case of CONTACT with the deviations of the program, %.
struct Compared {
    place: (f64, f64),
    approach: f64,
    share: f64,
    shift: f64,
    cells: Vec<String>,
}

pub(crate) fn page() -> Result<Page, ValidationError> {
    let known: BoundaryElements = data::read(data::BOUNDARY_ELEMENTS)?;
    let cases = known.cases.iter().map(compare).collect::<Result<Vec<_>, _>>()?;
    let [case, ..] = &known.cases;
    let first = load(&case.interface()?, case.force_n, case.share)?;
    let printed = [
        ("largest pressure, MPa", first.peak / 1e6, known.printed.peak_mpa),
        ("elastic energy, normal and tangential, J", first.elastic, known.printed.energy_j),
        ("friction work, J", first.friction, known.printed.friction_work_j),
    ];
    let off = |(_, program, contact): &(&str, f64, f64)| 100.0 * (program / contact - 1.0);
    let (worked, units) = worked()?;
    let (dissimilar, neglected) = dissimilar(&known.spence)?;
    let checks = vec![
        Check::new("approach of four cases", "%", worst(cases.iter().map(|case| case.approach)), ASKED),
        Check::new(
            "F_x at the shift of CONTACT, four cases",
            "%",
            worst(cases.iter().map(|case| case.share)),
            ASKED,
        ),
        Check::new("pressure, elastic energy, friction work", "%", worst(printed.iter().map(off)), ASKED),
        Check::new("difference from the closed forms, in units of their last printed digit", "", units, 1.0),
    ];
    let mut prints = Table::new(
        "Other results of CONTACT for the first case:",
        &["quantity", "program", "CONTACT", "off by"],
    );
    for row in &printed {
        let (name, program, contact) = *row;
        prints.row([name.to_owned(), significant(program, 6), significant(contact, 4), percent(off(row))]);
    }
    let tables = vec![four(&cases), prints, worked, dissimilar];
    Ok(Page {
        name: NAME,
        title: "Cattaneo–Mindlin contact: boundary elements",
        setup: SETUP.to_owned(),
        command: COMMAND.to_owned(),
        reference: format!("{REFERENCE}\n\nSource: {}.", known.source),
        kind: vec![Kind::OtherCode, Kind::ClosedForm],
        checks,
        figure: figure(&cases),
        shows: "Left: force versus shift (tangential displacement), scaled by μF_N and u_c. The curve is the program's and is the same \
                for all four cases; the points are CONTACT's. Right: deviation of the program, with the limit for approach and force."
            .to_owned(),
        tables,
        limits: limits(neglected, &known.spence_source),
    })
}

const SETUP: &str = "Two equal bodies touch like a paraboloid and a plane. A tangential force below μF_N causes partial slip: a ring at \
the edge slips, the centre sticks (Cattaneo 1938, Mindlin 1949).";
const COMMAND: &str = "The program's values are those of its first loading, which `stickslip info` and the start of a run also use. \
The energies come from the slip memory after one normal and one tangential section.";
const REFERENCE: &str = "CONTACT solves the half-space problem on a square grid by variational methods. It shares no method with \
stickslip. The page compares the approach at CONTACT's normal force and F_x at CONTACT's shift. The grids have 17 to 34 cells across \
the contact; they deviate by 0.1 to 0.2 % from the closed forms. Closed-form values from other sources must agree within one unit of \
their last digit, as their input is rounded, too.";

pub(crate) fn interface((shear, nu, radius, mu): (f64, f64, f64, f64)) -> Result<Interface, ValidationError> {
    let material = Material::new(2.0 * shear * (1.0 + nu), nu)?;
    Ok(Interface::new(Pair::new(material, material), Profile::paraboloid(radius)?, mu)?)
}

impl Cattaneo {
    fn interface(&self) -> Result<Interface, ValidationError> {
        interface((self.shear_modulus_pa, self.nu, 1e-3 * self.radius_mm, self.mu))
    }
}

pub(crate) fn load(law: &Interface, force: f64, share: f64) -> Result<Loaded, ValidationError> {
    let pulled = TangentialGiven::Force(share * law.friction() * force);
    let state = FirstLoading::solve(law, NormalGiven::Force(force), pulled)?;
    let mut curve = Curve::new(law, Apex::default());
    curve.commit(law, Segment::Straight(Apex { d: state.d, u: 0.0 }))?;
    let friction = curve.commit(law, Segment::Straight(Apex { d: state.d, u: state.u }))?;
    let elastic = law.normal_energy(state.d) + curve.elastic(law);
    Ok(Loaded { state, peak: law.peak_pressure(state.d).unwrap_or(f64::NAN), elastic, friction })
}

fn compare(case: &Cattaneo) -> Result<Compared, ValidationError> {
    let law = case.interface()?;
    let normal = NormalGiven::Force(case.force_n);
    let moved = FirstLoading::solve(&law, normal, TangentialGiven::Displacement(1e-6 * case.shift_um))?;
    let limit = law.friction() * case.force_n;
    let pulled = FirstLoading::solve(&law, normal, TangentialGiven::Force(case.share * limit))?;
    let share = moved.tangential_force / limit;
    let off = |program: f64, contact: f64| 100.0 * (program / contact - 1.0);
    let (approach, force) = (off(1e6 * moved.d, case.approach_um), off(share, case.share));
    let shift = off(1e6 * pulled.u, case.shift_um);
    let cells = vec![
        format!(
            "G {} Pa, ν {}, R {} mm, μ {}, F_N {} N, grid {}",
            significant(case.shear_modulus_pa, 2),
            case.nu,
            case.radius_mm,
            case.mu,
            case.force_n,
            case.grid
        ),
        significant(1e6 * moved.d, 5),
        significant(case.approach_um, 4),
        percent(approach),
        places(share, 5),
        case.share.to_string(),
        percent(force),
        significant(1e6 * pulled.u, 5),
        case.shift_um.to_string(),
        percent(shift),
    ];
    let place = (1e-6 * case.shift_um / law.gross_slip_displacement(moved.d), case.share);
    Ok(Compared { place, approach, share: force, shift, cells })
}

fn percent(value: f64) -> String {
    format!("{} %", places(value, 2))
}

fn four(cases: &[Compared]) -> Table {
    let heads = [
        "case",
        "d, µm",
        "CONTACT",
        "off by",
        "F_x/(μF_N)",
        "CONTACT",
        "off by",
        "u at its F_x, µm",
        "CONTACT",
        "off by",
    ];
    let mut table =
        Table::new("Approach at equal normal force, force at equal shift, shift at equal force:", &heads);
    cases.iter().for_each(|case| table.row(case.cells.clone()));
    table
}

/// Returns the table for bodies that are not elastically similar, and the deviation of the theory, %.
fn dissimilar(known: &Spence) -> Result<(Table, f64), ValidationError> {
    let material =
        |i: usize| Material::new(2e6 * known.shear_modulus_mpa[i] * (1.0 + known.nu[i]), known.nu[i]);
    let pair = Pair::new(material(0)?, material(1)?);
    let profile = Profile::paraboloid(0.5e-3 / known.gap_per_mm)?;
    let law = Interface::new(pair, profile, known.mu)?;
    let mut table = Table::new(
        &format!(
            "Normal contact of bodies that are *not* elastically similar, β = {}:",
            places(pair.dundurs_beta(), 3)
        ),
        &["F_N, N", "d, mm", "CONTACT", "deviation of CONTACT"],
    );
    let mut off = Vec::new();
    for &(force, approach) in &known.rows {
        let d = 1e3 * law.indentation(force);
        off.push(100.0 * (approach / d - 1.0));
        table.row([
            force.to_string(),
            significant(d, 5),
            approach.to_string(),
            percent(100.0 * (approach / d - 1.0)),
        ]);
    }
    Ok((table, worst(off)))
}

fn figure(cases: &[Compared]) -> Figure<'static> {
    // F_x/(μF_N) versus u/u_c, the same for every paraboloid, computed by the program.
    let universal = || -> Result<Vec<(f64, f64)>, ValidationError> {
        let law = interface((1e9, 0.3, 1.0, 0.3))?;
        let at = |step: u32| {
            let part = f64::from(step) / 60.0;
            let u = part * law.gross_slip_displacement(1e-3);
            let (normal, moved) = (NormalGiven::Indentation(1e-3), TangentialGiven::Displacement(u));
            let state = FirstLoading::solve(&law, normal, moved)?;
            Ok((part, state.tangential_force / (law.friction() * state.normal_force)))
        };
        (0..=66).map(at).collect()
    };
    let law = curve("stickslip", universal().unwrap_or_default(), Ink::Palette(0));
    let numbered = |value: fn(&Compared) -> f64| {
        cases.iter().enumerate().map(|(i, case)| (i as f64 + 1.0, value(case))).collect::<Vec<_>>()
    };
    let force = Panel {
        x: axis("shift u/u_c", ""),
        y: axis("force F_x/(μF_N)", ""),
        series: vec![law, points("CONTACT", cases.iter().map(|case| case.place), Ink::Palette(1))],
        ..Panel::default()
    };
    let allowed = [ASKED, -ASKED]
        .map(|y| Reference::Horizontal { y, label: Label::plain("asked of approach and force") });
    let deviation = Panel {
        x: stickslip_plot::Axis { covers: Some((0.5, 4.5)), ..axis("case", "") },
        y: axis("program − CONTACT, %", ""),
        series: vec![
            points("approach", numbered(|case| case.approach), Ink::Palette(0)),
            points("force at its shift", numbered(|case| case.share), Ink::Palette(1)),
            points("shift at its force", numbered(|case| case.shift), Ink::Muted),
        ],
        references: allowed.to_vec(),
        ..Panel::default()
    };
    Figure {
        title: Label::plain("Cattaneo's problem: this program and CONTACT"),
        panels: vec![force, deviation],
        arrangement: Arrangement::Row,
        size: (1600, 800),
        ..Figure::default()
    }
}

fn limits(neglected: f64, source: &str) -> String {
    format!(
        "The four cases are first loadings of equal bodies. They test moduli and stick zone, not the slip memory. The shift at \
         CONTACT's force deviates by up to 0.21 % (first case), as near gross slip the shift changes more than the force.\n\nThe last \
         table shows what elastic similarity neglects: pressure displaces the two surfaces by different amounts, and friction resists. The \
         approach of CONTACT is {} % smaller at μ = 0.2986 and β = 0.5, the maximum for ν ≥ 0. Source: {source}.",
        places(neglected, 1),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Limits of this page, independent of the page itself.
    #[test]
    fn contact_is_met_to_a_fifth_of_a_per_cent_and_closed_forms_to_their_last_digit() {
        let page = page().unwrap();
        let found: Vec<f64> = page.checks.iter().map(|check| check.found).collect();
        assert_eq!(found.len(), 4);
        assert!(found[..3].iter().all(|percent| *percent <= 0.2), "{found:?}");
        assert!(found[3] <= 1.0, "{found:?}");
    }
}
