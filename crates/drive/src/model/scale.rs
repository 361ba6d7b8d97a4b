//! Natural scales of contacts and coordinates; tolerances are relative to these scales.

use super::{Free, Link, Measure};
use crate::Waveform;
use crate::contact::{Contact, Natural};
use crate::scene::{Axis, Normal, Scene, Varying};

/// Length scale if no other scale is known, m.
const LENGTH: f64 = 1e-6;

/// Scratch memory for natural scales.
#[derive(Debug, Default)]
pub(super) struct Room {
    springs: Vec<(f64, f64)>,
    frequency: Vec<f64>,
    /// Whether each waveform is a force or a moment instead of a length.
    forces: Vec<bool>,
}

impl Room {
    /// Marks the waveforms of loads and of normal forces as forces.
    pub(super) fn find_forces(&mut self, scene: &Scene) {
        self.forces.clear();
        self.forces.resize(scene.waveforms.len(), false);
        let loads = scene.loads.iter().flat_map(|load| [load.x, load.z, load.pitch]);
        let pressed = scene.contacts.iter().filter_map(|contact| match contact.part.normal {
            Normal::Force(force) => Some(force),
            Normal::Indentation(_) | Normal::Radius(_) | Normal::Coupled => None,
        });
        for force in loads.chain(pressed) {
            if let Varying::Follows(w) = force
                && let Some(is_force) = self.forces.get_mut(w)
            {
                *is_force = true;
            }
        }
    }
}

/// Sets the natural scales of contacts and free coordinates: lengths u_c along the slide and d along the normal, and velocities.
///
/// `deepest` is the largest indentation of each contact, `pushes` the largest force on each free coordinate.
///
/// The length scale l of a free coordinate is the smallest u_c or d of its contacts divided by their arms; the velocity scale is lω with
/// ω² = k/m in full stick. Without contacts l is the smallest stroke, or the displacement by `pushes`. Without stiffness ω is the largest
/// angular frequency of the waveforms. A contact has the largest ω of the coordinates that move it.
pub(super) fn assign(
    contacts: &mut [Contact],
    free: &mut [Free],
    links: &[Link],
    waveforms: &[Waveform],
    (deepest, pushes): (&[f64], &[f64]),
    Room { springs, frequency, forces }: &mut Room,
) {
    find_springs(contacts, links, deepest, (free.len(), springs));
    let lengths = waveforms.iter().zip(forces).filter(|(_, is_force)| !**is_force);
    let spans = lengths.map(|(w, _)| w.range().1 - w.range().0).filter(|span| *span > 0.0);
    let (stroke, widest) =
        spans.fold((f64::INFINITY, 0.0_f64), |(least, most), span| (least.min(span), most.max(span)));
    let quickest = highest_frequency(waveforms);
    let slow = quickest.unwrap_or(1.0);
    // With high friction u_c may exceed all motions.
    let reach = if widest > 0.0 { widest } else { f64::INFINITY };
    frequency.clear();
    frequency.resize(free.len(), slow);
    for (i, f) in free.iter_mut().enumerate() {
        let (stiffness, length) = springs[i];
        // Along x the largest waveform limits the length; a depth has no such limit.
        if stiffness > 0.0 {
            frequency[i] = (stiffness / f.mass).sqrt();
        }
        // Loads and initial velocities may exceed the stroke.
        let pushed = (pushes[i] / stiffness).max(f.start.1.abs() / frequency[i]);
        f.scale = match (length.is_finite(), f.axis) {
            (true, Axis::X) => {
                let length = length.min(if pushed > reach { pushed } else { reach });
                (length, length * frequency[i])
            }
            (true, _) => (length, length * frequency[i]),
            (false, _) if stroke.is_finite() => (stroke, stroke * frequency[i]),
            (false, _) => untouched(f, (pushes[i], stiffness), quickest),
        };
    }
    for (c, &d) in contacts.iter_mut().zip(deepest) {
        let normal = c.coupling().map_or(&[][..], |measure| &measure.free[..]);
        let moved = c.u.free.iter().chain(normal);
        let fastest = moved.map(|(i, _)| frequency[*i]).fold(0.0, f64::max);
        let displacement = c.interface.natural_displacement(d);
        let [along, normal] = [driven(&c.u, waveforms), c.coupling().map_or(0.0, |d| driven(d, waveforms))];
        let is_small = c.is_walked() && along > 0.0 && along < displacement;
        let force = c.interface.normal_force(d.max(0.0));
        let limit = c.interface.friction() * force;
        c.natural = Natural {
            depth: d.max(0.0),
            displacement,
            sweep: if is_small { along / displacement } else { 1.0 },
            input: c.count
                * [limit * along, force * normal].into_iter().filter(|work| work.is_finite()).sum::<f64>(),
            force: limit,
            frequency: match c.coupling() {
                Some(d) if c.stop => {
                    let mobility = d.mobility(|i| free[i].mobility);
                    (c.interface.normal_stiffness(c.natural.depth.max(1.0)) * mobility).sqrt()
                }
                _ if fastest > 0.0 => fastest,
                _ => slow,
            },
        };
    }
}

/// Returns the range of a displacement by waveforms, m; infinite if other signals contribute.
fn driven(measure: &Measure, waveforms: &[Waveform]) -> f64 {
    let range = |w: usize| waveforms.get(w).map_or(f64::INFINITY, |w| w.range().1 - w.range().0);
    measure.driven.iter().map(|(w, a)| a.abs() * range(*w)).sum()
}

/// Computes the stiffness on each free coordinate with all contacts stuck (N/m or N m/rad), and the coordinate's length scale (m or rad;
/// infinite without contacts).
///
/// The stiffness is Σ arm²·k over links, and contacts at their largest indentation; links have no length scale.
fn find_springs(
    contacts: &[Contact],
    links: &[Link],
    deepest: &[f64],
    (free, springs): (usize, &mut Vec<(f64, f64)>),
) {
    springs.clear();
    springs.resize(free, (0.0, f64::INFINITY));
    let mut add = |(i, arm): (usize, f64), stiffness: f64, length: f64| {
        springs[i].0 += arm * arm * stiffness;
        springs[i].1 = springs[i].1.min(if length > 0.0 { length / arm.abs() } else { f64::INFINITY });
    };
    for (c, &d) in contacts.iter().zip(deepest) {
        for term in &c.u.free {
            add(*term, c.count * c.interface.stick_stiffness(d), c.interface.natural_displacement(d));
        }
        // A stop is seldom met and has a scale of its own.
        for term in c.coupling().iter().filter(|_| !c.stop).flat_map(|measure| &measure.free) {
            add(*term, c.count * c.interface.normal_stiffness(d), d);
        }
    }
    for link in links {
        for term in &link.elongation.free {
            add(*term, link.stiffness, 0.0);
        }
    }
}

/// Returns the length and velocity scale of a coordinate without contacts, where no waveform is a length. The length is the larger
/// displacement by initial velocity, or by a load against springs or against inertia at the largest frequency of the waveforms.
fn untouched(free: &Free, (push, stiffness): (f64, f64), quickest: Option<f64>) -> (f64, f64) {
    let own = (stiffness / free.mass).sqrt();
    let frequency = own.max(quickest.unwrap_or(0.0));
    if frequency == 0.0 {
        return (LENGTH, LENGTH);
    }
    let way = (push * free.mobility / frequency.powi(2)).max(free.start.1.abs() / frequency);
    // Loads at rest count, too, because they may balance each other.
    let length = if way > 0.0 { way.min(LENGTH) } else { LENGTH };
    (length, length * frequency)
}

/// Returns the largest angular frequency of the waveforms, rad/s; `None` without waveforms.
fn highest_frequency(waveforms: &[Waveform]) -> Option<f64> {
    let period = waveforms.iter().filter_map(Waveform::shortest_period).fold(f64::INFINITY, f64::min);
    period.is_finite().then(|| std::f64::consts::TAU / period)
}
