//! How the bodies of a contact move between two samples: on the cubics through their places and velocities.

use crate::Setting;
use crate::simulated::Series;
use stickslip_contact::{Apex, Interface};
use stickslip_drive::scene::{Axis, Contact, Freedom, Normal, Side, Varying};
use stickslip_drive::{Piece, Waveform};

/// The motion of a contact through its samples.
pub(super) struct Motion<'a> {
    time: &'a [f64],
    u: &'a [f64],
    d: &'a [f64],
    contact: &'a Contact,
    law: &'a Interface,
    waveforms: Vec<&'a Waveform>,
    along: Vec<Part<'a>>,
    /// Empty where no motion presses the contact.
    across: Vec<Part<'a>>,
}

/// What a coordinate of a body adds to a rate: a multiple of its own.
struct Part<'a> {
    factor: f64,
    rate: Rate<'a>,
}

/// The rate of a coordinate.
#[derive(Clone, Copy)]
enum Rate<'a> {
    /// As recorded, in every sample.
    Recorded(&'a [f64]),
    /// That of a waveform, which breaks where its pieces end.
    Driven(&'a Waveform),
}

/// The motion between two samples; `s` goes from 0 to 1.
pub(super) struct Leg<'a> {
    u: Cubic,
    depth: Depth<'a>,
}

/// A cubic by its ends: value and rise, and what the rates at both ends exceed the mean one by, times the duration.
#[derive(Clone, Copy)]
struct Cubic {
    from: f64,
    rise: f64,
    excess: [f64; 2],
}

/// How the indentation goes.
enum Depth<'a> {
    Cubic(Cubic),
    /// With a waveform: the normal force, the indentation or the radius that it is.
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
    /// The motion of contact `c`; none where a rate that it needs was not recorded, or is not that of a coordinate.
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
            // A point at (X, Z) moves by x - Zθ along the slide and by z + Xθ across it.
            motion.along.extend(part(setting, series, (body, Axis::X), sign)?);
            motion.along.extend(part(setting, series, (body, Axis::Pitch), -sign * point.z)?);
            if contact.normal == Normal::Coupled {
                motion.across.extend(part(setting, series, (body, Axis::Z), sign)?);
                motion.across.extend(part(setting, series, (body, Axis::Pitch), sign * point.x)?);
            }
        }
        Some(motion)
    }

    /// The motion from sample i-1 to sample i, which are some time apart.
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

/// A coordinate's part in a rate; nothing of one that stays where it is.
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
        // What has no mass may go on at another rate at any moment.
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
    /// At a sample, as it is between samples i-1 and i.
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
    /// Where the contact is.
    pub(super) fn at(&self, s: f64) -> Apex {
        Apex { d: self.depth.at(s), u: self.u.at(s) }
    }

    /// How far the way bends off the straight one, as shares of a stroke and of the indentation.
    pub(super) fn bend(&self, stroke: f64) -> f64 {
        let [start, end] = [0.0, 1.0].map(|s| self.at(s));
        let off = |s: f64| {
            let at = self.at(s);
            let straight = |from: f64, to: f64| from + s * (to - from);
            let along = (at.u - straight(start.u, end.u)).abs() / stroke;
            let across = (at.d - straight(start.d, end.d)).abs() / start.d.max(end.d);
            along + if start.d.max(end.d) > 0.0 { across } else { 0.0 }
        };
        // A cubic that turns twice is straight in its middle.
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
