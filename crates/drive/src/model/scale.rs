//! Natural scales: one tolerance suits every scene because errors are measured against these.

use super::{Free, Link, Measure};
use crate::Waveform;
use crate::contact::{Contact, Natural};
use crate::scene::{Axis, Normal, Scene, Varying};

/// Length where nothing tells one, m.
const LENGTH: f64 = 1e-6;

/// Room that scales are found in.
#[derive(Debug, Default)]
pub(super) struct Room {
    springs: Vec<(f64, f64)>,
    frequency: Vec<f64>,
    /// Whether a waveform is a force, or a moment, and no length.
    forces: Vec<bool>,
}

impl Room {
    /// Finds the waveforms that loads and pressed contacts follow.
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

/// Sets the scales of contacts and free coordinates: u_c along the slide, d along the normal, and the velocities they
/// make with the stuck stiffness.
///
/// `deepest` is the largest indentation of each contact, `pushes` the largest force on each free coordinate.
///
/// A free coordinate has a length l, the smallest u_c or d of its contacts by their arms, and the speed lω
/// with ω² = k/m of all that is stuck to it. Without contacts it has the smallest stroke or, where nothing has one, what
/// `pushes` make of it; without stiffness the highest frequency of the waveforms. A contact's frequency is the highest
/// of the coordinates that move it.
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
    // With high friction u_c lies far above anything that moves.
    let reach = if widest > 0.0 { widest } else { f64::INFINITY };
    frequency.clear();
    frequency.resize(free.len(), slow);
    for (i, f) in free.iter_mut().enumerate() {
        let (stiffness, length) = springs[i];
        // Along x no motion wider than the widest waveform matters; a depth is its own measure.
        if stiffness > 0.0 {
            frequency[i] = (stiffness / f.mass).sqrt();
        }
        // A push or a velocity at the start moves it, too, however small the stroke.
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
        let displacement = c.interface.gross_slip_displacement(d);
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
            frequency: if fastest > 0.0 { fastest } else { slow },
        };
    }
}

/// How far waveforms move a measure, m; infinite where something else drives it.
fn driven(measure: &Measure, waveforms: &[Waveform]) -> f64 {
    let range = |w: usize| waveforms.get(w).map_or(f64::INFINITY, |w| w.range().1 - w.range().0);
    measure.driven.iter().map(|(w, a)| a.abs() * range(*w)).sum()
}

/// Stiffness that acts on each free coordinate with all contacts stuck, N/m or N m/rad, and the smallest displacement
/// of it that matters to a contact, m or rad; infinite without any.
///
/// Σ arm²·k over contacts at their deepest and links; links set no length.
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
            add(*term, c.count * c.interface.stick_stiffness(d), c.interface.gross_slip_displacement(d));
        }
        for term in c.coupling().iter().flat_map(|measure| &measure.free) {
            add(*term, c.count * c.interface.normal_stiffness(d), d);
        }
    }
    for link in links {
        for term in &link.elongation.free {
            add(*term, link.stiffness, 0.0);
        }
    }
}

/// Length and speed of a coordinate that no contact touches, where nothing has a stroke: as far as a push, N or N m, goes
/// against springs or, at the highest frequency of the waveforms, against the mass, and as a start makes of it.
fn untouched(free: &Free, (push, stiffness): (f64, f64), quickest: Option<f64>) -> (f64, f64) {
    let own = (stiffness / free.mass).sqrt();
    let frequency = own.max(quickest.unwrap_or(0.0));
    if frequency == 0.0 {
        return (LENGTH, LENGTH);
    }
    let way = (push * free.mobility / frequency.powi(2)).max(free.start.1.abs() / frequency);
    // What rests is pushed, too: loads that balance each other must not hide how little moves.
    let length = if way > 0.0 { way.min(LENGTH) } else { LENGTH };
    (length, length * frequency)
}

/// Highest angular frequency of the waveforms, rad/s; none without any.
fn highest_frequency(waveforms: &[Waveform]) -> Option<f64> {
    let period = waveforms.iter().filter_map(Waveform::shortest_period).fold(f64::INFINITY, f64::min);
    period.is_finite().then(|| std::f64::consts::TAU / period)
}
