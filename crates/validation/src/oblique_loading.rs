//! Comparison with the rate equations of Mindlin and Deresiewicz for normal and tangential load that vary together.

use crate::check::{Check, worst};
use crate::page::{Kind, Page};
use crate::picture::{axis, curve, points};
use crate::subject::ValidationError;
use crate::table::{Table, significant};
use stickslip_contact::{
    Apex, Curve, FirstLoading, Interface, Material, NormalGiven, Pair, Profile, Segment, TangentialGiven,
};
use stickslip_plot::{Arrangement, Figure, Ink, Label, Panel};

pub(crate) const NAME: &str = "oblique_loading";

/// Steel spheres of Porter and Brake: E, Pa; ν; effective radius, m; μ; initial indentation, m.
const MODULUS: f64 = 192.85e9;
const NU: f64 = 0.29;
const RADIUS: f64 = 4.174_432_305_996_625e-3;
const FRICTION: f64 = 0.2;
const DEPTH: f64 = 10e-6;
/// Number of steps of the rate equations and of sections of the path.
// Twice as many steps do not change the printed digits.
const STEPS: u32 = 2000;

/// Path after a first loading, with its known results.
struct Path {
    name: &'static str,
    /// Initial tangential displacement or force.
    start: TangentialGiven,
    /// `F_N` at the end divided by that at the start.
    to: f64,
    /// `dF_x/dF_N` divided by μ.
    slope: f64,
    /// `F_x`, N, and u, µm, at the start; `F_x`, N, d and u, µm, at the end. NaN if unknown.
    known: [f64; 5],
    /// Allowed deviation of `F_x` from its straight line, N.
    asked: f64,
}

/// Simulated path.
struct Walked {
    /// Results in the order of [`Path::known`].
    found: [f64; 5],
    /// `F_N` and `F_x`, N.
    forces: Vec<(f64, f64)>,
    /// Largest deviation of `F_x` from its straight line, N.
    off: f64,
    /// `F_x` at the end point (d, u) of the reference, N.
    at_known_end: f64,
    /// Friction work on the path, relative to `μF_N u_c`.
    friction: f64,
}

/// Half a unit of the last digit of the known forces, N.
const HALF: f64 = 5e-8;

pub(crate) fn page() -> Result<Page, ValidationError> {
    let material = Material::new(MODULUS, NU)?;
    let law = Interface::new(Pair::new(material, material), Profile::paraboloid(RADIUS)?, FRICTION)?;
    let limit = law.gross_slip_displacement(DEPTH);
    let paths = [
        Path {
            name: "load falls",
            start: TangentialGiven::Force(27.694_462_1),
            to: 0.6,
            slope: -0.1,
            known: [27.694_462_1, 0.856_660_22, 29.988_861_5, 7.113_786_609, 1.276_724_268],
            asked: 1e-6,
        },
        Path {
            name: "load grows",
            start: TangentialGiven::Displacement(0.6 * limit),
            to: 1.2,
            slope: 1.0,
            known: [42.848_929_4, f64::NAN, 54.320_926_5, f64::NAN, 1.756_346_382],
            asked: 1e-10,
        },
    ];
    let walked = [walk(&law, &paths[0])?, walk(&law, &paths[1])?];
    let mut checks = Vec::new();
    let mut tables = Vec::new();
    for (path, walked) in paths.iter().zip(&walked) {
        let [start, _, end, ..] = path.known;
        let digits = worst([walked.found[0] - start, walked.found[2] - end]);
        let check = |what: &str, found: f64, allowed: f64| {
            Check::new(&format!("{}: {what}", path.name), "N", found, allowed)
        };
        checks.push(check("F_x at both ends, to the last digit", digits, HALF));
        checks.push(check("F_x from its straight line in F_N", walked.off, path.asked));
        checks.push(check("F_x at the end (d, u) of the reference", walked.at_known_end - end, 1e-6));
        tables.push(table(path, walked));
    }
    Ok(Page {
        name: NAME,
        title: "Oblique loading: Mindlin and Deresiewicz",
        setup: SETUP.to_owned(),
        command: "The slip memory follows the path in 2 000 linear sections. The rate equations give u(F_N), the slip memory gives F_x."
            .to_owned(),
        reference: REFERENCE.to_owned(),
        kind: vec![Kind::ClosedForm, Kind::OtherCode],
        checks,
        figure: figure(&paths, &walked),
        shows: "The curves are the forces of the program along u(F_N). The points lie on the prescribed straight lines."
            .to_owned(),
        tables,
        limits: LIMITS.to_owned(),
    })
}

const SETUP: &str = "Two equal spheres (E 192.85 GPa, ν 0.29, effective radius 4.174 mm, μ 0.2) are pressed together by 10 µm (286.80 N) and \
displaced tangentially. Then normal and tangential force vary together. Load falls: F_N falls to 0.6 of its value, and F_x rises by μ/10 \
of the decrease. Load grows: F_N grows to 1.2 of its value, and F_x rises by μ times the increase. The paths are those of Porter and \
Brake, Mech. Syst. Signal Process. 192 (2023) 110210.";
const REFERENCE: &str = "Mindlin and Deresiewicz (J. Appl. Mech. 20, 1953) give the tangential compliance under oblique loading:\n\n\
dF_x = μ(1-θ) dF_N + 2G\\*aθ du, θ³ = 1 - F_x/(μF_N),\n\nwhere θ is the stick radius relative to the contact radius. Integration \
along prescribed straight lines F_x(F_N) gives u. Another program integrated to the digits of the table; this page integrates again by \
the Runge–Kutta method. The slip memory, which contains no rate equation, follows this u and the d of Hertz. Its force must be the \
straight line.";
const LIMITS: &str = "On both paths the slip ring grows or is constant. Tests of the project, not this page, compare unloading and \
reloading of both loads with independent solutions. Reference and program use the same theory. The page shows that the slip memory \
integrates it correctly, not that steel obeys it.\n\nFor the falling load, the end u of the reference differs by 1.5e-14 m from the \
value integrated here. This difference corresponds to 2e-7 N.";

/// Returns the indentation d of a Hertzian contact, m.
fn depth(law: &Interface, force: f64) -> f64 {
    math::cbrt(9.0 * force * force / (16.0 * RADIUS * law.normal_modulus().powi(2)))
}

/// Returns `du/dF_N` by Mindlin and Deresiewicz for `F_x` on its straight line, m/N.
fn rate(law: &Interface, slope: f64, normal: f64, tangential: f64) -> f64 {
    let theta = math::cbrt(1.0 - tangential / (FRICTION * normal));
    let radius = (RADIUS * depth(law, normal)).sqrt();
    (slope - FRICTION * (1.0 - theta)) / (2.0 * law.tangential_modulus() * radius * theta)
}

fn walk(law: &Interface, path: &Path) -> Result<Walked, ValidationError> {
    let start = FirstLoading::solve(law, NormalGiven::Indentation(DEPTH), path.start)?;
    let mut contact = Curve::new(law, Apex::default());
    contact.commit(law, Segment::Straight(Apex { d: start.d, u: 0.0 }))?;
    contact.commit(law, Segment::Straight(Apex { d: start.d, u: start.u }))?;
    let (slope, step) = (path.slope * FRICTION, (path.to - 1.0) * start.normal_force / f64::from(STEPS));
    let line = |normal: f64| start.tangential_force + slope * (normal - start.normal_force);
    let (mut u, mut off, mut friction) = (start.u, 0.0_f64, 0.0);
    let mut forces = vec![(start.normal_force, contact.force(law))];
    let mut other = contact.clone();
    for i in 0..STEPS {
        let normal = start.normal_force + f64::from(i) * step;
        let at = |share: f64| rate(law, slope, normal + share * step, line(normal + share * step));
        u += step / 6.0 * (at(0.0) + 4.0 * at(0.5) + at(1.0));
        let normal = start.normal_force + f64::from(i + 1) * step;
        friction += contact.commit(law, Segment::Straight(Apex { d: depth(law, normal), u }))?;
        let force = contact.force(law);
        off = worst([off, force - line(normal)]);
        forces.push((normal, force));
    }
    let Apex { d, u } = contact.apex();
    let found = [start.tangential_force, 1e6 * start.u, contact.force(law), 1e6 * d, 1e6 * u];
    // In one straight section: on these paths the force depends only on the end point.
    let given = |known: f64, own: f64| if known.is_nan() { own } else { 1e-6 * known };
    let end = Apex { d: given(path.known[3], d), u: given(path.known[4], u) };
    other.commit(law, Segment::Straight(end))?;
    let friction = friction / (law.friction() * start.normal_force * law.gross_slip_displacement(DEPTH));
    Ok(Walked { found, forces, off, at_known_end: other.force(law), friction })
}

fn table(path: &Path, walked: &Walked) -> Table {
    let work = if walked.friction < 1e-12 {
        "0".to_owned()
    } else {
        format!("{} μF_N u_c (F_N and u_c at the start)", significant(walked.friction, 4))
    };
    let caption = format!("Case “{}”, friction work {work}:", path.name);
    let mut table = Table::new(&caption, &["quantity", "program", "known"]);
    let names = [
        "F_x at the start, N",
        "u at the start, µm",
        "F_x at the end, N",
        "d at the end, µm",
        "u at the end, µm",
    ];
    for ((name, found), known) in names.iter().zip(walked.found).zip(path.known) {
        let known = if known.is_nan() { "–".to_owned() } else { known.to_string() };
        table.row([(*name).to_owned(), significant(found, 10), known]);
    }
    table
}

fn figure(paths: &[Path], walked: &[Walked]) -> Figure<'static> {
    let panel = |(path, walked): (&Path, &Walked)| {
        let &(normal, force) = walked.forces.first().unwrap_or(&(f64::NAN, f64::NAN));
        let on_line = (0..=8).map(|k| {
            let gone = f64::from(k) / 8.0 * (path.to - 1.0) * normal;
            (normal + gone, force + path.slope * FRICTION * gone)
        });
        Panel {
            heading: Label::plain(path.name),
            x: axis("normal force F_N", "N"),
            y: axis("tangential force F_x", "N"),
            series: vec![
                curve("stickslip", walked.forces.clone(), Ink::Palette(0)),
                points("Mindlin and Deresiewicz", on_line, Ink::Palette(1)),
            ],
            ..Panel::default()
        }
    };
    Figure {
        title: Label::plain("Normal load and tangential force vary together"),
        panels: paths.iter().zip(walked).map(panel).collect(),
        arrangement: Arrangement::Row,
        size: (1600, 800),
        ..Figure::default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Limits of this page, independent of the page itself: last digits, 1e-6 N for the falling load, 1e-10 N for the growing load.
    #[test]
    fn forces_follow_mindlin_and_deresiewicz() {
        let page = page().unwrap();
        let found: Vec<f64> = page.checks.iter().map(|check| check.found).collect();
        let [falls, off_falling, _, grows, off_growing, _] = found[..] else { panic!("{found:?}") };
        assert!(falls <= 5e-8 && grows <= 5e-8 && off_falling <= 1e-6 && off_growing <= 1e-10, "{found:?}");
        assert!(page.holds(), "{found:?}");
    }
}
