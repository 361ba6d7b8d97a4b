//! Contacts as components of a drive: constants, laws, event functions and forces.
//!
//! A contact has a law ([`Law`]), event functions ([`Guard`]), a memory and an energy, as every [component](crate::component).
//! The crate `stickslip_contact` computes its mechanics. This module connects it with bodies: measures of u and d, the normal
//! load, the number of contacts and the natural scales of tolerances.

mod component;

use crate::model::Measure;
use crate::{EventKind, Piece, Sample};
pub(crate) use stickslip_contact::Motion;
use stickslip_contact::{Course, Engine, Guard, Interface, Law, Load, Lull, Memory, Scale, Site};

/// Largest number of springs of a discretised contact whose slip and touch events end steps. The cost grows with its square.
const MOST_SPRINGS: usize = 8192;

/// Relative rounding error of a few units in the last place.
pub(crate) const PLACES: f64 = 8.0 * f64::EPSILON;

/// Constants of a contact.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Contact {
    /// Name of the contact.
    pub(crate) name: String,
    /// Index among the contacts.
    pub(crate) place: usize,
    /// Relative displacement u = x(first) - x(second) at the contact point since the start, m, as a linear form of the coordinates.
    pub(crate) u: Measure,
    pub(crate) interface: Interface,
    /// Solver of the tangential problem: exact slip-memory curve, or a row of springs.
    pub(crate) engine: Engine,
    /// Source of the indentation d.
    pub(crate) press: Press,
    /// Damping time β along the normal, s: the contact is pressed by d + βḋ.
    pub(crate) normal_damping: f64,
    /// Whether it is an end stop of a body. Stops come after all contacts.
    pub(crate) stop: bool,
    /// Number of identical contacts.
    pub(crate) count: f64,
    /// Relative displacement u at t = 0, m.
    pub(crate) start: f64,
    /// Time for which the contact has rested at t = 0, s.
    pub(crate) rest: f64,
    /// Whether the contact can never carry a tangential force, because it has no friction or is never pressed.
    pub(crate) inert: bool,
    /// Whether the contact never ends a step, because it is never pressed, or is frictionless with a prescribed normal load.
    pub(crate) unguarded: bool,
    /// Whether a balance of forces determines the position of one of the contact's bodies (quasi-static coordinate).
    pub(crate) balanced: bool,
    /// Index among the contacts whose area may grow in full stick, so that their tangential force is a state.
    pub(crate) slot: Option<usize>,
    pub(crate) natural: Natural,
}

/// Natural scales of a contact at its largest indentation.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Natural {
    /// Largest indentation, m.
    pub(crate) depth: f64,
    /// Gross slip displacement u_c, m.
    pub(crate) displacement: f64,
    /// Friction limit μF_N, N.
    pub(crate) force: f64,
    /// Largest natural angular frequency of the coordinates that move the contact, rad/s; without stiffness, that of the waveforms.
    pub(crate) frequency: f64,
    /// Stroke of the prescribed motion relative to u_c, at most 1. The value is 1 if a free body moves the contact.
    pub(crate) sweep: f64,
    /// Largest work of one stroke of the waveforms against friction and normal force, J.
    pub(crate) input: f64,
}

/// Source of the contact's indentation.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Press {
    /// Constant indentation d (m), with the precomputed reduced normal force M(d) = F_N/E\* (m²).
    Constant { d: f64, reduced_force: f64 },
    /// Normal force (N) prescribed by a waveform, given by its index.
    Force(usize),
    /// Indentation (m) prescribed by a waveform, given by its index.
    Indentation(usize),
    /// Contact radius (m) prescribed by a waveform, given by its index.
    Radius(usize),
    /// Indentation from the motion of the bodies: d = z(first) - z(second) - gap at the contact point.
    Coupled(Measure),
}

impl Press {
    /// Returns the index of the waveform that prescribes the normal load, if any.
    pub(crate) fn waveform(&self) -> Option<usize> {
        match self {
            Self::Constant { .. } | Self::Coupled(_) => None,
            Self::Force(w) | Self::Indentation(w) | Self::Radius(w) => Some(*w),
        }
    }
}

impl Contact {
    /// Returns the natural velocity u_c ω, m/s.
    pub(crate) fn natural_velocity(&self) -> f64 {
        self.natural.displacement * self.natural.frequency
    }

    /// Returns the indentation d (m) and its rate (m/s) for a sample of the waveform of the normal load. A row of springs under a
    /// prescribed force needs its present linear law `lull`.
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
            // ḋ = Ḟ_N/(E*m(d)) is infinite at first contact; the rate is 0 there.
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

    /// Returns the indentation that presses the contact, m, from the distance d (m) of the bodies and its rate (m/s): d + βḋ.
    ///
    /// A contact closes where d = 0, and opens and closes again where d + βḋ = 0. For an open contact the result is the smaller of both.
    /// Under the full force law the contact is open where d < 0, unless its memory shows that it has closed: rounding may put the touch there.
    #[inline]
    pub(crate) fn damped(&self, [d, rate]: [f64; 2], (memory, law): (&Memory, &Law)) -> f64 {
        if self.normal_damping == 0.0 {
            return d;
        }
        let depth = d + self.normal_damping * rate;
        let open = law.is_open() || law.is_whole() && d < 0.0 && memory.apex().d <= 0.0;
        if open { d.min(depth) } else { depth }
    }

    /// Whether a waveform moves it along the normal against a damping force.
    pub(crate) fn is_driven_normally(&self) -> bool {
        let driven = self.press.waveform().is_some() || self.coupling().is_some_and(|d| !d.driven.is_empty());
        self.normal_damping > 0.0 && driven
    }

    /// Returns whether only waveforms move the contact, so that its path (u, d) is prescribed.
    pub(crate) fn is_walked(&self) -> bool {
        self.u.free.is_empty() && self.coupling().is_none_or(|d| d.free.is_empty())
    }

    /// Returns the natural scale of the contact's work, J: μF_N u_c for large strokes. For a small stroke U the scale is proportional to
    /// (U/u_c)³, like the loss of a hysteresis loop.
    pub(crate) fn natural_work(&self) -> f64 {
        self.natural.force * self.natural.displacement * self.natural.sweep.powi(3)
    }

    /// Returns the rounding error of the work during one stroke of the waveforms, J.
    pub(crate) fn rounding(&self) -> f64 {
        f64::EPSILON * self.natural.input
    }

    /// Returns the friction limit μF_N at the natural indentation, N.
    pub(crate) fn friction_limit(&self) -> f64 {
        self.natural.force
    }

    /// Returns whether the contact's path in the (d, u) plane is straight and prescribed on the present pieces of the waveforms. Either all
    /// prescribed motions have constant rates, or u is constant.
    ///
    /// On a straight path the slip memory gives force, energy and friction work in closed form. A normal force or contact radius that is
    /// linear in time gives a straight path only at constant u.
    #[inline]
    pub(crate) fn goes_straight(&self, pieces: &[Piece]) -> bool {
        if !self.u.free.is_empty() {
            return false;
        }
        // Signals after the waveforms belong to blocks and are not linear in time.
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

    /// Whether the indentation is constant.
    pub(crate) fn is_constant(&self) -> bool {
        matches!(self.press, Press::Constant { .. })
    }

    /// Returns whether the normal force begins with a power of d between 1 and 2. The derivative of the stiffness is then infinite at first
    /// contact, and an ordinary integration step across first contact loses order.
    pub(crate) fn is_steep(&self) -> bool {
        let power = self.interface.profile().first_power();
        power > 1.0 && power < 2.0
    }

    /// Returns whether an ordinary step to lift-off is as accurate as a graded one: for F_N ∝ dᵖ with p ≥ 2, or p ≥ 3 with damping.
    pub(crate) fn fades_evenly(&self) -> bool {
        let damped = if self.is_damped() { 1.0 } else { 0.0 };
        self.interface.profile().first_power() - damped >= 2.0
    }

    /// Returns the error of a graded step to lift-off, in units of the tolerance. `told` is the error estimate of the step. The function
    /// `left` returns the indentation at the start of the step in natural lengths, and the tolerance of a velocity in natural velocities.
    ///
    /// The damping force is proportional to d to the power p - 1 if the normal force has the power p. Stages placed in the square root of
    /// time resolve this force only for multiples of 1/2. Otherwise the error is about βω·leftᵖ, even if the estimate is small.
    // The factors 1 to 30 and 2e-4 were fitted to measured errors of steps of 0.05 to 0.8 rad.
    pub(crate) fn missed(&self, told: f64, left: impl FnOnce() -> (f64, f64)) -> f64 {
        let (power, fading) = (self.interface.profile().first_power(), self.fading());
        let crowded = told * (100.0 * fading).clamp(1.0, 30.0);
        if fading == 0.0 || (2.0 * power).fract() == 0.0 {
            return crowded;
        }
        let (left, allowed) = left();
        crowded.max(2e-4 * fading * math::powf(left, power) / allowed)
    }

    /// Returns βω: the damping force at the natural velocity, relative to the natural force; 0 without damping.
    pub(crate) fn fading(&self) -> f64 {
        self.interface.damping() * self.natural.frequency
    }

    /// Returns the kinds of events at which gross slip begins and ends.
    pub(crate) fn gross_slip(&self) -> [EventKind; 2] {
        match self.interface.kinetic() {
            Some(_) => [EventKind::BreaksLoose, EventKind::SticksAgain],
            None => [EventKind::GrossSlip, EventKind::GrossSlipEnds],
        }
    }

    /// Whether it has two friction coefficients and slides at the kinetic one.
    pub(crate) fn is_loose(&self, law: &Law) -> bool {
        self.interface.kinetic().is_some() && law.is_gross()
    }

    /// Whether its sticking springs are damped.
    pub(crate) fn is_damped(&self) -> bool {
        self.interface.damping() > 0.0
    }

    /// Returns whether the contact is never pressed.
    pub(crate) fn is_never_pressed(&self) -> bool {
        self.natural.depth == 0.0
    }

    /// Returns the indentation d as a linear form of the coordinates, if the motion of the bodies determines it.
    pub(crate) fn coupling(&self) -> Option<&Measure> {
        match &self.press {
            Press::Coupled(measure) => Some(measure),
            _ => None,
        }
    }
}

impl Site for Contact {
    #[inline]
    fn interface(&self) -> &Interface {
        &self.interface
    }
    #[inline]
    fn load(&self) -> Load {
        match self.press {
            Press::Constant { reduced_force, .. } => Load::Constant(reduced_force),
            Press::Force(_) => Load::Force,
            Press::Indentation(_) | Press::Radius(_) => Load::Indentation,
            Press::Coupled(_) => Load::Coupled,
        }
    }
    #[inline]
    fn is_inert(&self) -> bool {
        self.inert
    }
    #[inline]
    fn is_unguarded(&self) -> bool {
        self.unguarded
    }
    /// A row with a varying normal load and at most [`MOST_SPRINGS`] springs.
    // Under constant load, the error estimate detects the kinks; to end steps there would be too expensive for long paths.
    // Balanced contacts move on straight paths only, so their rows end steps under any load. A row that breaks loose has a
    // jump, and in a damped row the kinks of the damping force are large.
    fn has_lulls(&self) -> bool {
        let rough = self.interface.kinetic().is_some() || self.is_damped();
        (self.balanced || rough || !self.is_constant()) && (1..=MOST_SPRINGS).contains(&self.engine.springs())
    }
    #[inline]
    fn scale(&self) -> Scale {
        let Natural { depth, displacement, frequency, .. } = self.natural;
        Scale { depth, displacement, frequency }
    }
}

/// Returns the event at a zero crossing of an event function and the motion of the contact after it.
///
/// When a slipping edge stops, a deepening contact changes to full stick; any other contact slips in the opposite sense.
pub(crate) fn fired(contact: &Contact, guard: Guard, law: &Law, at: &Motion) -> (EventKind, Course) {
    let slope = contact.interface.stick_slope();
    let [same, turned] = match law.sense() > 0.0 {
        true => [Course::Forward, Course::Backward],
        false => [Course::Backward, Course::Forward],
    };
    match guard {
        Guard::Drag if at.dd > 0.0 && contact.is_loose(law) => (EventKind::SticksAgain, Course::Grow),
        Guard::Drag if at.dd > 0.0 && law.branch().is_some() => (EventKind::FullStick, Course::Grow),
        Guard::Drag if law.is_gross() => (contact.gross_slip()[1], turned),
        Guard::Drag | Guard::Side => (EventKind::Reversal, turned),
        // Changes of single springs are not recorded; the kind is a placeholder.
        Guard::Piece
        | Guard::Ahead
        | Guard::Behind
        | Guard::Turn
        | Guard::Edge
        | Guard::Forward
        | Guard::Backward
        | Guard::Rise
        | Guard::Sink => (EventKind::LoopClosed, same),
        Guard::Lower => (EventKind::SlipBegins, Course::Forward),
        Guard::Upper => (EventKind::SlipBegins, Course::Backward),
        Guard::Contact => (EventKind::LiftOff, Course::Open),
        // Contact at an angle within the friction cone: all springs stick, without friction work.
        Guard::Gap if at.du.abs() <= slope * at.dd => (EventKind::Touch, Course::Grow),
        Guard::Gap => (EventKind::Touch, if at.du > 0.0 { Course::Forward } else { Course::Backward }),
    }
}
