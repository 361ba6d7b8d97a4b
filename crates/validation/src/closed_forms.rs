//! Comparison with closed forms of loading, unloading and hysteresis loops at constant indentation.

use crate::check::{Check, worst};
use crate::page::{Kind, Page};
use crate::picture::{axis, curve, points};
use crate::subject::ValidationError;
use crate::table::{Table, places, significant};
use stickslip_contact::{Apex, Curve, Interface, Pair, Profile, Segment};
use stickslip_plot::{Arrangement, Axis, Figure, Ink, Label, Panel};

pub(crate) const NAME: &str = "closed_forms";

/// Indentation of all contacts, m.
const DEPTH: f64 = 1e-7;
/// Reversal points of the loops, relative to `u_c`.
const TURN: f64 = 0.8;
/// Amplitudes in the table, relative to `u_c`.
const AMPLITUDES: [f64; 7] = [0.01, 0.1, 0.3, 0.5, 0.8, 1.0, 1.5];

/// Contact with a profile r^n, with `μF_N` and `u_c`.
struct Contact {
    n: f64,
    name: &'static str,
    law: Interface,
    limit: f64,
    gross: f64,
}

/// Point of a path: u/u_c, and `F_x/(μF_N)` of the program and of the formula.
type Place = (f64, f64, f64);

impl Contact {
    fn new(n: f64, name: &'static str, profile: Profile) -> Result<Self, ValidationError> {
        let law = Interface::new(Pair::from_moduli(110e9, 90e9)?, profile, 0.3)?;
        let (limit, gross) = (law.friction() * law.normal_force(DEPTH), law.gross_slip_displacement(DEPTH));
        Ok(Self { n, name, law, limit, gross })
    }

    fn pressed(&self) -> Result<Curve, ValidationError> {
        let mut contact = Curve::new(&self.law, Apex::default());
        contact.commit(&self.law, Segment::Straight(Apex { d: DEPTH, u: 0.0 }))?;
        Ok(contact)
    }

    /// Moves the contact to a displacement relative to `u_c`. Returns the friction work, J.
    fn slide(&self, contact: &mut Curve, share: f64) -> Result<f64, ValidationError> {
        Ok(contact.commit(&self.law, Segment::Straight(Apex { d: DEPTH, u: share * self.gross }))?)
    }

    /// Follows first loading to [`TURN`], unloading to -[`TURN`] and reloading. Returns the points and the largest
    /// deviation of the stick radius in first loading, relative to a.
    fn path(&self) -> Result<(Vec<Place>, f64), ValidationError> {
        let p = (self.n + 1.0) / self.n;
        let first = |share: f64| 1.0 - math::powf(1.0 - share, p);
        let branch = |way: f64| 2.0 * (1.0 - math::powf(1.0 - 0.5 * way, p));
        let mut contact = self.pressed()?;
        let (mut places, mut radius) = (Vec::new(), 0.0);
        let mut go = |share: f64, known: f64, is_first: bool| -> Result<(), ValidationError> {
            self.slide(&mut contact, share)?;
            places.push((share, contact.force(&self.law) / self.limit, known));
            if is_first {
                let whole = self.law.profile().radius(DEPTH);
                radius = worst([
                    radius,
                    contact.stick_radius(&self.law) / whole - math::powf(1.0 - share, 1.0 / self.n),
                ]);
            }
            Ok(())
        };
        let share = |k: u32| TURN * f64::from(k) / 40.0;
        for k in 1..=40 {
            go(share(k), first(share(k)), true)?;
        }
        for k in 1..=80 {
            go(TURN - share(k), first(TURN) - branch(share(k)), false)?;
        }
        for k in 1..=80 {
            go(share(k) - TURN, branch(share(k)) - first(TURN), false)?;
        }
        Ok((places, radius))
    }

    /// Returns the friction work of a loop with an amplitude relative to `u_c`, J: of the program and of the formula.
    fn work(&self, amplitude: f64) -> Result<(f64, f64), ValidationError> {
        let mut contact = self.pressed()?;
        self.slide(&mut contact, amplitude)?;
        let work = self.slide(&mut contact, -amplitude)? + self.slide(&mut contact, amplitude)?;
        Ok((work, 4.0 * self.limit * self.gross * loop_work(self.n, amplitude)))
    }
}

/// Returns the friction work of a loop divided by `4μF_N u_c`.
fn loop_work(n: f64, amplitude: f64) -> f64 {
    let p = (n + 1.0) / n;
    if amplitude > 1.0 {
        return amplitude - 2.0 / (p + 1.0);
    }
    // U + U(1-U)^p - 2/(p+1) [1-(1-U)^{p+1}] loses its digits at small U; its power series from U³ on is used there.
    let mut term = p;
    let mut sum = 0.0;
    for k in 2..400 {
        // Coefficient of (-U)^k in (1-U)^p, and the contribution of both brackets to U^{k+1}.
        term *= (p - f64::from(k - 1)) / f64::from(k);
        let sign = if k % 2 == 0 { 1.0 } else { -1.0 };
        let part = sign * term * (1.0 - 2.0 / f64::from(k + 1)) * amplitude.powi(k + 1);
        sum += part;
    }
    if amplitude < 0.5 {
        return sum;
    }
    let left = 1.0 - amplitude;
    amplitude + amplitude * math::powf(left, p) - 2.0 / (p + 1.0) * (1.0 - math::powf(left, p + 1.0))
}

pub(crate) fn page() -> Result<Page, ValidationError> {
    let contacts = [
        Contact::new(1.0, "cone, n = 1", Profile::cone(0.02)?)?,
        Contact::new(2.0, "paraboloid, n = 2", Profile::paraboloid(1e-3)?)?,
        Contact::new(4.0, "fourth power, n = 4", Profile::power(5e9, 4.0)?)?,
    ];
    let mut paths = Vec::new();
    let mut radii = Vec::new();
    for contact in &contacts {
        let (path, radius) = contact.path()?;
        paths.push(path);
        radii.push(radius);
    }
    let mut loops = Table::new(
        "Friction work of a loop, divided by 4μF_N u_c:",
        &["amplitude/u_c", "cone", "formula", "paraboloid", "formula", "fourth power", "formula"],
    );
    let mut off = Vec::new();
    for amplitude in AMPLITUDES {
        let mut row = vec![amplitude.to_string()];
        for contact in &contacts {
            let (found, known) = contact.work(amplitude)?;
            off.push(found / known - 1.0);
            let whole = 4.0 * contact.limit * contact.gross;
            row.extend([significant(found / whole, 9), significant(known / whole, 9)]);
        }
        loops.row(row);
    }
    let forces = worst(paths.iter().flatten().map(|(_, found, known)| found - known));
    let checks = vec![
        Check::new("F_x of first loading, unloading, reloading, relative to μF_N", "", forces, 1e-12),
        Check::new("stick radius of the first loading, relative to a", "", worst(radii), 1e-12),
        Check::new("friction work of loops, relative", "", worst(off), 1e-12),
    ];
    Ok(Page {
        name: NAME,
        title: "Loading and hysteresis loops: closed forms",
        setup: SETUP.to_owned(),
        command: "The slip memory moves in steps of u_c/50. Each loop has two steps.".to_owned(),
        reference: REFERENCE.to_owned(),
        kind: vec![Kind::ClosedForm],
        checks,
        figure: figure(&contacts, &paths)?,
        shows: "Left: F_x of the program (curves) and of the formulas (points). Right: friction work of loops, from cubic to linear in \
                the amplitude."
            .to_owned(),
        tables: vec![forces_table(&paths), loops],
        limits: LIMITS.to_owned(),
    })
}

const SETUP: &str = "Contacts with the profiles r, r² and r⁴ are pressed to one indentation. They are displaced to 0.8 u_c, to -0.8 u_c and \
again to 0.8 u_c. Hysteresis loops follow, with amplitudes from 0.01 to 1.5 u_c.";
const REFERENCE: &str = "For the profile rⁿ, with p = (n+1)/n:\n\n\
* First loading: F_x = μF_N[1-(1-u/u_c)^p], stick radius c/a = (1-u/u_c)^{1/n}.\n\n\
* Unloading from (u₁, F₁): F_x = F₁-2μF_N[1-(1-(u₁-u)/(2u_c))^p]. Reloading is the mirror image.\n\n\
* Friction work of a loop of amplitude U = Ũu_c: 4μF_N u_c {Ũ+Ũ(1-Ũ)^p-(2/(p+1))[1-(1-Ũ)^{p+1}]} up to u_c, 4μF_N[U-2u_c/(p+1)] \
beyond.\n\nThe source is the handbook, section 4.4 (4.26–4.28, 4.33), with Masing's rule for the branches. The work is the integral.";
const LIMITS: &str = "The page covers constant indentation only, where every history consists of such branches. The formulas belong to the \
theory that the program uses. The page shows that the program reproduces them to rounding, not how well they describe a real contact.";

fn forces_table(paths: &[Vec<Place>]) -> Table {
    let mut table = Table::new(
        "F_x/(μF_N) along the path:",
        &["u/u_c", "cone", "formula", "paraboloid", "formula", "fourth power", "formula"],
    );
    for place in [9, 24, 39, 59, 79, 99, 119, 139, 159, 179, 199] {
        let at: Vec<Place> = paths.iter().filter_map(|path| path.get(place).copied()).collect();
        let share = at.first().map_or(f64::NAN, |(share, ..)| *share);
        let cells = at.iter().flat_map(|(_, found, known)| [places(*found, 9), places(*known, 9)]);
        table.row(std::iter::once(places(share, 2)).chain(cells));
    }
    table
}

fn figure(contacts: &[Contact; 3], paths: &[Vec<Place>]) -> Result<Figure<'static>, ValidationError> {
    let mut forces = Vec::new();
    let mut works = Vec::new();
    for (i, (contact, path)) in contacts.iter().zip(paths).enumerate() {
        let own = std::iter::once((0.0, 0.0)).chain(path.iter().map(|(share, found, _)| (*share, *found)));
        forces.push(curve(contact.name, own, Ink::Palette(i)));
        forces.push(points(
            "",
            path.iter().skip(7).step_by(8).map(|(share, _, known)| (*share, *known)),
            Ink::Palette(i),
        ));
        let whole = 4.0 * contact.limit * contact.gross;
        let mut work = Vec::new();
        for k in 0..=60 {
            let amplitude = 0.01 * math::powf(300.0, f64::from(k) / 60.0);
            work.push((amplitude, contact.work(amplitude)?));
        }
        works.push(curve(
            contact.name,
            work.iter().map(|(at, (found, _))| (*at, found / whole)),
            Ink::Palette(i),
        ));
        let known = work.iter().step_by(6).map(|(at, (_, known))| (*at, known / whole));
        works.push(points("", known, Ink::Palette(i)));
    }
    let panels = vec![
        Panel { x: axis("u/u_c", ""), y: axis("force F_x/(μF_N)", ""), series: forces, ..Panel::default() },
        Panel {
            x: Axis { logarithmic: true, ..axis("amplitude U/u_c", "") },
            y: Axis { logarithmic: true, ..axis("work of a loop/(4μF_N u_c)", "") },
            series: works,
            ..Panel::default()
        },
    ];
    Ok(Figure {
        title: Label::plain("Loading, unloading, loops: curves of the program, points of the formulas"),
        panels,
        arrangement: Arrangement::Row,
        size: (1600, 850),
        ..Figure::default()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Limits of this page, independent of the page itself.
    #[test]
    fn closed_forms_are_met() {
        let page = page().unwrap();
        let found: Vec<f64> = page.checks.iter().map(|check| check.found).collect();
        let [forces, radii, works] = found[..] else { panic!("{found:?}") };
        assert!(forces <= 1e-12 && radii <= 1e-12 && works <= 1e-12, "{found:?}");
    }

    /// (2/3)p(p-1)U³ / 4 at small U.
    #[test]
    fn small_loops_are_cubic() {
        for n in [1.0, 2.0, 4.0] {
            let p = (n + 1.0) / n;
            let cubic = p * (p - 1.0) / 6.0 * 1e-9;
            assert!((loop_work(n, 1e-3) / cubic - 1.0).abs() < 2e-3, "{n}");
            // Series and formula agree where they meet.
            assert!((loop_work(n, 0.5 - 1e-9) / loop_work(n, 0.5) - 1.0).abs() < 1e-8, "{n}");
        }
    }
}
