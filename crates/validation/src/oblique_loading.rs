//! Normal and tangential load that vary together: the rate equations of Mindlin and Deresiewicz.

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

/// Steel spheres of Porter and Brake: E, Pa; ν; effective radius, m; μ; indentation at the start, m.
const MODULUS: f64 = 192.85e9;
const NU: f64 = 0.29;
const RADIUS: f64 = 4.174_432_305_996_625e-3;
const FRICTION: f64 = 0.2;
const DEPTH: f64 = 10e-6;
/// Steps of the rate equations and chords of the memory curve.
// Twice as many change no digit that is told; a tenth would do for 1e-7 N.
const STEPS: u32 = 2000;

/// A path from a first loading on, and what is known of it.
struct Path {
    name: &'static str,
    /// What is given of the start, as share of `u_c` or force.
    start: TangentialGiven,
    /// `F_N` at the end over that at the start.
    to: f64,
    /// `dF_x/dF_N` over μ.
    slope: f64,
    /// `F_x`, N, and u, µm, at the start; `F_x`, N, d and u, µm, at the end; no number where nothing is known.
    known: [f64; 5],
    /// How far `F_x` may be off its straight line, N.
    asked: f64,
}

/// A path as it was walked.
struct Walked {
    /// As [`Path::known`].
    found: [f64; 5],
    /// `F_N` and `F_x`, N.
    forces: Vec<(f64, f64)>,
    /// Largest distance of `F_x` from its straight line, N.
    off: f64,
    /// `F_x` where the path ends by what is known, N.
    at_known_end: f64,
    /// Friction work on the way, parts of `μF_N u_c`.
    friction: f64,
}

/// Half a unit of the last digit of the forces that are known, N.
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
        checks.push(check("F_x off its straight line over F_N", walked.off, path.asked));
        checks.push(check("F_x at the end (d, u) of the others", walked.at_known_end - end, 1e-6));
        tables.push(table(path, walked));
    }
    Ok(Page {
        name: NAME,
        title: "Load and force that vary together",
        setup: SETUP.to_owned(),
        command: "The memory curve is moved along the path in 2 000 straight pieces; the path u(F_N) comes from the rate equations, \
                  the force from the curve."
            .to_owned(),
        reference: REFERENCE.to_owned(),
        kind: vec![Kind::ClosedForm, Kind::OtherCode],
        checks,
        figure: figure(&paths, &walked),
        shows: "The curves are the program's forces along u(F_N); the points lie on the straight lines that the rate equations were \
                integrated for."
            .to_owned(),
        tables,
        limits: LIMITS.to_owned(),
    })
}

const SETUP: &str = "Two equal spheres (E 192.85 GPa, ν 0.29, effective radius 4.174 mm, μ 0.2) are pressed together by 10 µm (286.80 N) and \
pulled sideways. Then both loads vary: the normal load falls to 0.6 while F_x rises by μ/10 of what it loses, or it grows to 1.2 while \
F_x rises by μ of what it gains. The paths are those of Porter and Brake, Mech. Syst. Signal Process. 192 (2023) 110210.";
const REFERENCE: &str = "Mindlin and Deresiewicz (J. Appl. Mech. 20, 1953) give the tangential compliance where both loads vary:\n\n\
dF_x = μ(1-θ) dF_N + 2G\\*aθ du, θ³ = 1 - F_x/(μF_N),\n\nθ the share of the radius that sticks. It was integrated along the paths \
for prescribed straight lines F_x(F_N), elsewhere to the digits of the table and here anew by Runge and Kutta's method; what comes \
out is u. The memory curve, which knows no rate equation, is moved along these u and the d of Hertz: its force must be the straight \
line.";
const LIMITS: &str = "Both are paths on which the slip ring grows or stays. Histories in which it is cut, by unloading and reloading \
with both loads, are held by [tests](../../crates/contact/tests/contacts/histories.rs) against histories that were solved independently, not \
here. The theory is the same on both sides, as are Hertz' numbers: this page says that the memory curve integrates it, not that steel \
obeys it.\n\nThe end u of the others is, while the load \
falls, 1.5e-14 m from the one integrated here, which is worth 2e-7 N: so far their integration goes.";

/// d of Hertz' contact, m.
fn depth(law: &Interface, force: f64) -> f64 {
    math::cbrt(9.0 * force * force / (16.0 * RADIUS * law.normal_modulus().powi(2)))
}

/// `du/dF_N` by Mindlin and Deresiewicz while `F_x` follows its straight line, m/N.
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
    // Straight there: on these paths the force hangs on the end alone.
    let given = |known: f64, own: f64| if known.is_nan() { own } else { 1e-6 * known };
    let end = Apex { d: given(path.known[3], d), u: given(path.known[4], u) };
    other.commit(law, Segment::Straight(end))?;
    let friction = friction / (law.friction() * start.normal_force * law.gross_slip_displacement(DEPTH));
    Ok(Walked { found, forces, off, at_known_end: other.force(law), friction })
}

fn table(path: &Path, walked: &Walked) -> Table {
    let work = if walked.friction < 1e-12 {
        "nothing".to_owned()
    } else {
        format!("{} μF_N u_c of the start", significant(walked.friction, 4))
    };
    let caption = format!("The {}; friction works {work} on the way:", path.name);
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

    /// What is asked of this page, by numbers of its own: digits, 1e-6 N while the load falls, 1e-10 N while it grows.
    #[test]
    fn forces_follow_mindlin_and_deresiewicz() {
        let page = page().unwrap();
        let found: Vec<f64> = page.checks.iter().map(|check| check.found).collect();
        let [falls, off_falling, _, grows, off_growing, _] = found[..] else { panic!("{found:?}") };
        assert!(falls <= 5e-8 && grows <= 5e-8 && off_falling <= 1e-6 && off_growing <= 1e-10, "{found:?}");
        assert!(page.holds(), "{found:?}");
    }
}
