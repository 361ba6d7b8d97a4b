//! Motion of a contact between two samples, by cubic interpolation of the positions and velocities of its bodies.

use crate::Setting;
use crate::simulated::Series;
use stickslip_contact::{Apex, Interface};
use stickslip_drive::scene::{Axis, Contact, Freedom, Normal, Side, Varying};
use stickslip_drive::{Piece, Waveform};

/// Sampled motion of a contact.
pub(super) struct Motion<'a> {
    time: &'a [f64],
    u: &'a [f64],
    d: &'a [f64],
    contact: &'a Contact,
    law: &'a Interface,
    waveforms: Vec<&'a Waveform>,
    along: Vec<Part<'a>>,
    /// Velocities normal to the contact plane. Empty if the indentation does not depend on the motion of the bodies.
    across: Vec<Part<'a>>,
}

/// Contribution of one coordinate of a body to a relative velocity: its velocity times a factor.
struct Part<'a> {
    factor: f64,
    rate: Rate<'a>,
}

/// Velocity of a coordinate.
#[derive(Clone, Copy)]
enum Rate<'a> {
    /// Velocity recorded in every sample.
    Recorded(&'a [f64]),
    /// Rate of a waveform, which may jump at piece ends.
    Driven(&'a Waveform),
}

/// Motion between two samples, as a function of s from 0 to 1.
pub(super) struct Leg<'a> {
    u: Cubic,
    depth: Depth<'a>,
}

/// Cubic polynomial, defined by its start value, its rise, and the excess of the end slopes over the mean slope.
#[derive(Clone, Copy)]
struct Cubic {
    from: f64,
    rise: f64,
    excess: [f64; 2],
}

/// Time history of the indentation.
enum Depth<'a> {
    Cubic(Cubic),
    /// A waveform prescribes the normal force or the indentation.
    Driven {
        waveform: &'a Waveform,
        piece: Piece,
        start: f64,
        duration: f64,
        law: &'a Interface,
        kind: Kind,
    },
}

#[derive(Clone, Copy)]
enum Kind {
    Force,
    Indentation,
}

impl<'a> Motion<'a> {
    /// Creates the motion of contact `c`. Returns `None` if a required velocity was not recorded or a type of motion is not supported.
    pub(super) fn new(setting: &'a Setting, c: usize, series: &'a Series) -> Option<Self> {
        let (name, law) = setting.model.contacts().nth(c)?;
        let contact = &setting.scenario.scene.contacts.get(c)?.part;
        let mut motion = Self {
            time: series.time(),
            u: series.column(name, "u_m"),
            d: series.column(name, "d_m"),
            contact,
            law,
            waveforms: setting.scenario.scene.waveforms.iter().map(|waveform| &waveform.part).collect(),
            along: Vec::new(),
            across: Vec::new(),
        };
        let fed = |waveform: &&Waveform| waveform.interpolation().is_some() || waveform.generator().is_some();
        if motion.waveforms.iter().any(fed) || matches!(contact.normal, Normal::Radius(Varying::Follows(_))) {
            return None;
        }
        for ((side, point), sign) in contact.between.into_iter().zip(contact.at).zip([1.0, -1.0]) {
            let Side::Body(body) = side else { continue };
            // A point (X, Z) of a body moves by x - Zθ along the contact plane and by z + Xθ across it.
            motion.along.extend(part(setting, series, (body, Axis::X), sign)?);
            motion.along.extend(part(setting, series, (body, Axis::Pitch), -sign * point.z)?);
            if contact.normal == Normal::Coupled {
                motion.across.extend(part(setting, series, (body, Axis::Z), sign)?);
                motion.across.extend(part(setting, series, (body, Axis::Pitch), sign * point.x)?);
            }
        }
        Some(motion)
    }

    /// Returns the motion between samples i-1 and i. The times of both samples must differ.
    pub(super) fn leg(&self, i: usize) -> Leg<'a> {
        let (start, end) = (self.time[i - 1], self.time[i]);
        let cubic = |values: &[f64], parts: &[Part<'_>]| {
            let rate = |at: usize| -> f64 {
                parts.iter().map(|part| part.factor * part.rate.at(at, (i, self.time))).sum()
            };
            let (from, rise) = (values[i - 1], values[i] - values[i - 1]);
            Cubic { from, rise, excess: [i - 1, i].map(|at| (end - start) * rate(at) - rise) }
        };
        let driven = |w: usize, kind: Kind| {
            let waveform = *self.waveforms.get(w)?;
            let piece = waveform.piece_at(start / 2.0 + end / 2.0);
            Some(Depth::Driven { waveform, piece, start, duration: end - start, law: self.law, kind })
        };
        let depth = match self.contact.normal {
            Normal::Coupled => None,
            Normal::Force(Varying::Follows(w)) => driven(w, Kind::Force),
            Normal::Indentation(Varying::Follows(w)) => driven(w, Kind::Indentation),
            _ => Some(Depth::Cubic(Cubic { from: self.d[i], rise: 0.0, excess: [0.0; 2] })),
        };
        let depth = depth.unwrap_or_else(|| Depth::Cubic(cubic(self.d, &self.across)));
        Leg { u: cubic(self.u, &self.along), depth }
    }
}

/// Returns the contribution of a coordinate to the relative velocity: `None` if its velocity is unknown, `Some(None)` if it has none.
fn part<'a>(
    setting: &'a Setting,
    series: &'a Series,
    (body, axis): (usize, Axis),
    factor: f64,
) -> Option<Option<Part<'a>>> {
    let scene = &setting.scenario.scene;
    let body = scene.bodies.get(body)?;
    let rate = match body.part.coordinates()[axis as usize].1.freedom {
        _ if factor == 0.0 => return Some(None),
        Freedom::Fixed => return Some(None),
        // The velocity of a massless coordinate may jump at any time.
        Freedom::Balanced => return None,
        Freedom::Follows(w) if w < scene.waveforms.len() => Rate::Driven(&scene.waveforms[w].part),
        Freedom::Follows(_) | Freedom::Free => {
            let quantity = match axis {
                Axis::X => "vx_m_s",
                Axis::Z => "vz_m_s",
                Axis::Pitch => "vpitch_rad_s",
            };
            let recorded = series.column(&body.name, quantity);
            if recorded.is_empty() {
                return None;
            }
            Rate::Recorded(recorded)
        }
    };
    Some(Some(Part { factor, rate }))
}

impl Rate<'_> {
    /// Returns the velocity at a sample, as the one-sided limit from the interval between samples i-1 and i.
    fn at(self, sample: usize, (i, time): (usize, &[f64])) -> f64 {
        match self {
            Self::Recorded(rates) => rates[sample],
            Self::Driven(waveform) => {
                let piece = waveform.piece_at(time[i - 1] / 2.0 + time[i] / 2.0);
                waveform.sample(&piece, time[sample]).rate
            }
        }
    }
}

impl Leg<'_> {
    /// Returns the indentation d and the displacement u at the relative time s from 0 to 1.
    pub(super) fn at(&self, s: f64) -> Apex {
        Apex { d: self.depth.at(s), u: self.u.at(s) }
    }

    /// Returns the deviation of the motion from a straight line, as fractions of the stroke and of the indentation.
    pub(super) fn bend(&self, stroke: f64) -> f64 {
        let [start, end] = [0.0, 1.0].map(|s| self.at(s));
        let off = |s: f64| {
            let at = self.at(s);
            let straight = |from: f64, to: f64| from + s * (to - from);
            let along = (at.u - straight(start.u, end.u)).abs() / stroke;
            let across = (at.d - straight(start.d, end.d)).abs() / start.d.max(end.d);
            along + if start.d.max(end.d) > 0.0 { across } else { 0.0 }
        };
        // A cubic with an inflection point may cross the straight line at the middle, so three points are compared.
        off(0.25).max(off(0.5)).max(off(0.75))
    }
}

impl Cubic {
    fn at(&self, s: f64) -> f64 {
        let r = 1.0 - s;
        self.from + s * self.rise + s * r * (r * self.excess[0] - s * self.excess[1])
    }
}

impl Depth<'_> {
    fn at(&self, s: f64) -> f64 {
        match self {
            Self::Cubic(cubic) => cubic.at(s),
            Self::Driven { waveform, piece, start, duration, law, kind } => {
                let value = waveform.sample(piece, start + s * duration).value;
                match kind {
                    Kind::Force => law.indentation(value.max(0.0)),
                    Kind::Indentation => value,
                }
            }
        }
    }
}
