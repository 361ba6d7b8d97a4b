//! Formats the solution of a contact as tables.

use crate::commands::info::columns::broken;
use crate::commands::info::digits::digits;
use crate::commands::info::tables::grid;
use stickslip_run::theory::{Loading, Sheet, Stop, Walk, contact_word};
use stickslip_run::{Real, quantity};

/// Message for a contact without normal load.
const OPEN: &str = "\
the contact is open: there is no force, no stress and no slip
give --indentation, --radius or --force to press it";

/// Returns all tables.
pub(super) fn text(sheet: &Sheet) -> String {
    let mut sections = vec![constants(sheet)];
    match &sheet.loading {
        Some(found) => sections.push(loading(found)),
        None if !sheet.normal.is_empty() => sections.extend([normal(sheet), universal(sheet)]),
        None => {}
    }
    if !sheet.touches() {
        sections.push(OPEN.to_owned());
    }
    if !sheet.constants.elastically_similar {
        let [first, second] = &sheet.constants.materials;
        sections.push(broken(&format!("note: {first} and {second} are {}.", sheet.constants.similarity)));
    }
    sections.retain(|section| !section.is_empty());
    sections.join("\n\n")
}

fn constants(sheet: &Sheet) -> String {
    let (constants, pressed) = (&sheet.constants, &sheet.pressed);
    let formula = |formula: Option<&'static str>| formula.unwrap_or("numerical").to_owned();
    let mut rows = vec![
        ("materials", constants.materials.join(", ")),
        ("profile", constants.profile.clone()),
        ("f(r)", formula(constants.f)),
        ("g(x), (4.20)", formula(constants.g)),
        ("E*, effective modulus (4.13)", quantity(constants.normal_modulus, "Pa")),
        ("G*, effective shear modulus (4.13)", quantity(constants.tangential_modulus, "Pa")),
        ("Dundurs' β, 0 for similar pairs", digits(constants.dundurs_beta.0)),
        ("μ, coefficient of friction", constants.friction.0.to_string()),
        ("κ = μE*/G*", digits(constants.stick_slope.0)),
        ("d, indentation", quantity(pressed.d, "m")),
    ];
    if sheet.touches() {
        rows.extend([
            ("a, contact radius", quantity(pressed.a, "m")),
            ("F_N, normal force (4.26)", quantity(pressed.normal_force, "N")),
            ("μF_N, maximum tangential force", quantity(pressed.limit_force, "N")),
            ("u_c = κd, gross slip begins (4.28)", quantity(pressed.gross_slip, "m")),
            (
                "p_max, maximum pressure",
                pressed.peak_pressure.map_or("none: no 3D shape".to_owned(), bounded),
            ),
            ("2G*a, tangential stiffness, stuck", quantity(pressed.tangential_stiffness, "N/m")),
            ("2E*a, normal stiffness", quantity(pressed.normal_stiffness, "N/m")),
            ("normal elastic energy", quantity(pressed.normal_energy, "J")),
        ]);
    }
    table([&format!("CONTACT {}", sheet.contact), &sheet.scenario], rows)
}

fn bounded(pressure: Real) -> String {
    if pressure.0.is_infinite() { "unbounded".to_owned() } else { quantity(pressure, "Pa") }
}

fn loading(found: &Loading) -> String {
    let rows = vec![
        ("d, indentation", quantity(found.d, "m")),
        ("a, contact radius", quantity(found.a, "m")),
        ("F_N, normal force (4.26)", quantity(found.normal_force, "N")),
        ("u, displacement", quantity(found.u, "m")),
        ("c, stick radius (4.27)", quantity(found.c, "m")),
        ("F_x by superposition (4.38)", quantity(found.tangential_force, "N")),
        ("F_x by the integral (4.39)", quantity(found.by_integral, "N")),
        ("friction work (4.42)", quantity(found.friction_work, "J")),
        ("tangential elastic energy", quantity(found.tangential_energy, "J")),
        ("normal elastic energy", quantity(found.normal_energy, "J")),
        ("state", found.state.to_owned()),
    ];
    table(["FIRST LOADING", ""], rows)
}

fn table(head: [&str; 2], rows: Vec<(&str, String)>) -> String {
    grid(head, rows.into_iter().map(|(label, cell)| vec![label.to_owned(), cell]))
}

fn normal(sheet: &Sheet) -> String {
    let row = |row: &stickslip_run::theory::NormalRow| {
        vec![
            quantity(row.d, "m"),
            quantity(row.a, "m"),
            quantity(row.normal_force, "N"),
            quantity(row.normal_stiffness, "N/m"),
            quantity(row.gross_slip, "m"),
        ]
    };
    let head = ["PRESSED: d", "a", "F_N", "stiffness", "u_c"];
    grid(head, sheet.normal.iter().map(row))
}

fn universal(sheet: &Sheet) -> String {
    let row = |row: &stickslip_run::theory::UniversalRow| {
        let loading = &row.loading;
        vec![
            format!("{:.3}", row.stick_share.0),
            format!("{:.4}", row.displacement_share.0),
            format!("{:.6}", row.force_share.0),
            quantity(loading.u, "m"),
            quantity(loading.tangential_force, "N"),
            quantity(loading.by_integral, "N"),
            quantity(loading.friction_work, "J"),
        ]
    };
    let head = ["FIRST LOADING: c/a", "u/u_c", "F_x/(μF_N)", "u", "F_x (4.38)", "F_x (4.39)", "work (4.42)"];
    grid(head, sheet.universal.iter().map(row))
}

/// Returns the table of the corners of a history.
pub(super) fn corners(walk: &Walk) -> String {
    let row = |moment: &stickslip_run::theory::Moment| {
        let stop = &moment.stop;
        let told = |of: fn(&Stop) -> f64, unit: &str| quantity(Real(walk.told(stop, of)), unit);
        vec![
            if stop.corner == 0 { "start".to_owned() } else { stop.corner.to_string() },
            told(|stop| stop.apex.d, "m"),
            told(|stop| stop.apex.u, "m"),
            told(|stop| stop.normal_force, "N"),
            told(|stop| stop.force, "N"),
            told(|stop| stop.a, "m"),
            told(|stop| stop.c, "m"),
            contact_word(stop.state).to_owned(),
            told(|stop| stop.friction, "J"),
        ]
    };
    let head = ["CORNER", "d", "u", "F_N", "F_x", "a", "c", "state", "work"];
    grid(head, walk.moments.iter().map(row))
}
