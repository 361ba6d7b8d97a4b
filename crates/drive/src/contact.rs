//! Contacts as components of a drive: constants, what they are doing, their guards and forces.
//!
//! A contact is what has a law ([`Mode`]), guards ([`Guard`]), a memory and an energy; the runner knows it by
//! that contract ([`component`](crate::component)). Its mechanics are those of the crate `stickslip_contact`;
//! here is what joins them to bodies: the rows of u and d, what presses, how many there are, and the natural
//! scales that tolerances are relative to.

mod component;
mod force;
mod guard;
mod mode;

pub(crate) use guard::{Guard, NEARNESS, bands};
pub(crate) use mode::Mode;

use crate::model::Measure;
use crate::{Piece, Sample};
pub(crate) use stickslip_contact::Motion;
use stickslip_contact::{Engine, Interface, Lull};

/// Most springs of a row whose changes end steps. Each moves the whole row: the cost goes with the square of their number.
// 20 periods of P1 at 1e-6 take 4.3 s on a row of 8 192 springs, and 1.1 s on 16 384 by the whole law.
const MOST_SPRINGS: usize = 8192;

/// What a few last places of a number are of it.
pub(crate) const PLACES: f64 = 8.0 * f64::EPSILON;

/// A contact's constants.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Contact {
    /// As the scene names it.
    pub(crate) name: String,
    /// Place among the contacts.
    pub(crate) place: usize,
    /// u = x(first) - x(second) at the contact point, counted from the start.
    pub(crate) u: Measure,
    pub(crate) interface: Interface,
    /// The exact memory curve, or a row of springs.
    pub(crate) engine: Engine,
    /// What sets d.
    pub(crate) press: Press,
    /// Number of identical contacts.
    pub(crate) count: f64,
    /// Displacement reached before the start, m.
    pub(crate) start: f64,
    /// Whether the contact can never carry a tangential force: no friction, or never pressed.
    pub(crate) inert: bool,
    /// Whether nothing that it does ends a step: never pressed, or neither friction nor bodies that press it.
    pub(crate) unguarded: bool,
    /// Whether its bodies' places are solved for from its force.
    pub(crate) balanced: bool,
    /// Place among the growing contacts.
    pub(crate) slot: Option<usize>,
    pub(crate) natural: Natural,
}

/// Natural scales of a contact at its largest indentation.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Natural {
    /// That indentation, m.
    pub(crate) depth: f64,
    /// u_c, m.
    pub(crate) displacement: f64,
    /// μF_N, N.
    pub(crate) force: f64,
    /// Angular frequency of what the contact holds, rad/s.
    pub(crate) frequency: f64,
    /// Share of u_c by which waveforms move a contact that nothing else moves; 1 where bodies do, and at most.
    pub(crate) sweep: f64,
    /// What waveforms can put in by one stroke against friction and normal force, J.
    pub(crate) input: f64,
}

/// What sets the indentation.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Press {
    /// Constant d (m) with M(d) (m²) at hand.
    Constant { d: f64, reduced_force: f64 },
    /// A waveform of the normal force, N.
    Force(usize),
    /// A waveform of the indentation, m.
    Indentation(usize),
    /// A waveform of the contact radius, m.
    Radius(usize),
    /// The bodies' motion: d = z(first) - z(second) - gap at the contact point.
    Coupled(Measure),
}

impl Press {
    /// The waveform that presses, if any.
    pub(crate) fn waveform(&self) -> Option<usize> {
        match self {
            Self::Constant { .. } | Self::Coupled(_) => None,
            Self::Force(w) | Self::Indentation(w) | Self::Radius(w) => Some(*w),
        }
    }
}

impl Contact {
    /// Natural velocity u_c ω, m/s.
    pub(crate) fn natural_velocity(&self) -> f64 {
        self.natural.displacement * self.natural.frequency
    }

    /// Indentation d (m) and its rate (m/s) from a sample of the waveform that presses; of a row in a lull as if no other
    /// spring touched.
    #[inline(never)]
    pub(crate) fn pressed(&self, sample: Sample, lull: Option<&Lull>) -> (f64, f64) {
        if let (Press::Force(_), Some(lull)) = (&self.press, lull) {
            let modulus = self.interface.normal_modulus();
            let (d, slope) = lull.depth(sample.value.max(0.0) / modulus);
            return (d, sample.rate / modulus * slope);
        }
        match self.press {
            Press::Constant { d, .. } => (d, 0.0),
            Press::Indentation(_) | Press::Coupled(_) => (sample.value, sample.rate),
            // ḋ = Ḟ_N/(E*m(d)) is infinite where the contact is just touched: no rate is given there.
            Press::Force(_) => {
                let d = self.interface.indentation(sample.value.max(0.0));
                let stiffness = self.interface.normal_stiffness(d);
                (d, if stiffness > 0.0 { sample.rate / stiffness } else { 0.0 })
            }
            Press::Radius(_) => {
                let (radius, profile) = (sample.value.max(0.0), self.interface.profile());
                (profile.depth(radius), sample.rate * profile.depth_slope(radius))
            }
        }
    }

    /// Whether nothing but waveforms moves it: its path is known beforehand.
    pub(crate) fn is_walked(&self) -> bool {
        self.u.free.is_empty() && self.coupling().is_none_or(|d| d.free.is_empty())
    }

    /// Natural scale of its work, J: μF_N u_c, and of a small stroke U that which its loop loses, which goes with (U/u_c)³.
    // By μF_N u_c alone a ball that is shaken by 0.4 % of u_c had the work put in 0.6 % off at any tolerance.
    pub(crate) fn natural_work(&self) -> f64 {
        self.natural.force * self.natural.displacement * self.natural.sweep.powi(3)
    }

    /// What rounding makes of the work that waveforms put in by a stroke, J.
    pub(crate) fn rounding(&self) -> f64 {
        f64::EPSILON * self.natural.input
    }

    /// μF_N at the natural indentation, N.
    pub(crate) fn friction_limit(&self) -> f64 {
        self.natural.force
    }

    /// Whether its path in the plane of (d, u) is straight while waveforms are on these pieces, by no more than what is
    /// prescribed: nothing free moves it, and either all that does goes at constant rates or u stands still.
    ///
    /// Then its memory has force, energy and friction work at every moment by one chord, in closed form. A normal force or a
    /// contact radius that goes straight in time bends d, other than under a constant u.
    // Integrated all the same, "d up at u = κd/2, u at constant d, both up in stick" was 1.4e-7 of μF_N off at a tolerance of 1e-2.
    #[inline]
    pub(crate) fn goes_straight(&self, pieces: &[Piece]) -> bool {
        if !self.u.free.is_empty() {
            return false;
        }
        // Signals beyond the waveforms are blocks', which are no lines.
        let rate = |w: &usize| pieces.get(*w).and_then(Piece::line).map(|line| line.rate);
        let straight = |measure: &Measure| measure.driven.iter().all(|(w, _)| rate(w).is_some());
        let rests = || self.u.driven.iter().all(|(w, _)| rate(w) == Some(0.0));
        match &self.press {
            Press::Constant { .. } => straight(&self.u),
            Press::Indentation(w) => rate(w).is_some() && straight(&self.u) || rests(),
            Press::Force(_) | Press::Radius(_) => rests(),
            Press::Coupled(d) => d.free.is_empty() && (straight(d) && straight(&self.u) || rests()),
        }
    }

    /// Whether it is a row under a normal that moves, and its springs are few enough to end a step at each of their changes.
    // Under a constant load estimates see the kinks, which shrink with the springs. To end steps there, too, costs a slider that
    // travels far a hundred times as much: rounding of u lets springs change in turn at one moment.
    // A place without mass is found on straight lines only: there a row ends a step at each of its springs whatever its load.
    pub(crate) fn has_lulls(&self) -> bool {
        (self.balanced || !self.is_constant()) && (1..=MOST_SPRINGS).contains(&self.engine.springs())
    }

    /// Whether the indentation never changes.
    pub(crate) fn is_constant(&self) -> bool {
        matches!(self.press, Press::Constant { .. })
    }

    /// Whether its force begins with a power of d between 1 and 2: its stiffness then has an infinite slope at a touch, and steps
    /// across it lose their order. Of a higher power steps see little, whole or not.
    pub(crate) fn is_steep(&self) -> bool {
        let power = self.interface.profile().first_power();
        power > 1.0 && power < 2.0
    }

    /// Whether an even step to its end is as good as a graded one, which it is for a power of d of 2 and more; of damping, for one
    /// more. Stages beyond the end feel no force: of a graded step they weigh nothing, of an even one as much as the law would
    /// have there.
    pub(crate) fn fades_evenly(&self) -> bool {
        let damped = if self.is_damped() { 1.0 } else { 0.0 };
        self.interface.profile().first_power() - damped >= 2.0
    }

    /// The error of a graded step to its end, in units of what is allowed, of which the step tells `told`: what is `left` of the law at
    /// its start, in natural lengths, and what is allowed of a velocity, in natural speeds.
    ///
    /// Damping goes with the power of d that is one less than that of the force. Where that is a root, stages crowd for it, and their
    /// estimate tells a part of what is missed; where it is any other power p - 1 they are not smooth in it, and miss a part of
    /// βω·leftᵖ, however little they tell.
    // Steps of 0.05 to 0.8 rad: without damping the error is hardly ever more than the estimate, of a paraboloid up to 4 times as much with
    // βω = 0.02, most often 17 with 0.2 (70 at worst), up to 40 with 1. For r^{1.2}, r^{1.5}, r³ and r⁴ it is 9e-6, 1.6e-5, 8e-5 and 1.9e-4
    // of βω·leftᵖ as long as that is more.
    pub(crate) fn missed(&self, told: f64, left: impl FnOnce() -> (f64, f64)) -> f64 {
        let (power, fading) = (self.interface.profile().first_power(), self.fading());
        let crowded = told * (100.0 * fading).clamp(1.0, 30.0);
        if fading == 0.0 || (2.0 * power).fract() == 0.0 {
            return crowded;
        }
        let (left, allowed) = left();
        crowded.max(2e-4 * fading * math::powf(left, power) / allowed)
    }

    /// βω: what damping makes of a natural speed, in parts of the natural force. 0 without damping.
    pub(crate) fn fading(&self) -> f64 {
        self.interface.damping() * self.natural.frequency
    }

    /// Whether its springs that stick are damped.
    pub(crate) fn is_damped(&self) -> bool {
        self.interface.damping() > 0.0
    }

    /// Whether nothing will ever press it.
    pub(crate) fn is_never_pressed(&self) -> bool {
        self.natural.depth == 0.0
    }

    /// How the bodies' motion sets the indentation, if it does.
    pub(crate) fn coupling(&self) -> Option<&Measure> {
        match &self.press {
            Press::Coupled(measure) => Some(measure),
            _ => None,
        }
    }
}
