//! Law of a contact: smooth relation between motion and forces between two events.
//!
//! A law is not a state of slip: under constant indentation partial slip and gross slip are the same branch. It changes at events
//! only, follows from the committed memory, and stays smooth beyond the event that ends it. A [`Law`] answers force and tangents
//! ([`response`]) and event functions ([`guard`]).

mod guard;
mod response;

pub use guard::{Guard, NEARNESS, bands};
pub use response::GrowthRates;

use crate::words::{Words, push};
use crate::{Branch, Change, Course, Interface, Lead, Lull, Memory, Motion, Slack, SpringRow};

/// Constants of a contact that its laws need besides the memory.
pub trait Site {
    /// Returns moduli, profile and friction.
    fn interface(&self) -> &Interface;
    /// Returns how the indentation is given.
    fn load(&self) -> Load;
    /// Returns whether the contact can never carry a tangential force: without friction, or never pressed.
    fn is_inert(&self) -> bool;
    /// Returns whether the contact never ends a step: never pressed, or frictionless with a prescribed normal load.
    fn is_unguarded(&self) -> bool;
    /// Returns whether changes of single springs of a row end steps.
    fn has_lulls(&self) -> bool;
    /// Returns the natural scales.
    fn scale(&self) -> Scale;
}

/// How the indentation of a contact is given.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Load {
    /// Constant indentation with this M(d), m².
    Constant(f64),
    /// Prescribed normal force.
    Force,
    /// Prescribed indentation or contact radius.
    Indentation,
    /// Motion of the bodies.
    Coupled,
}

/// Natural scales of a contact at its largest indentation.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Scale {
    /// Largest indentation, m.
    pub depth: f64,
    /// Gross slip displacement u_c, m.
    pub displacement: f64,
    /// Largest natural angular frequency of the coordinates that move the contact, rad/s.
    pub frequency: f64,
}

impl Load {
    /// Returns whether the indentation is constant.
    #[inline]
    pub fn is_constant(self) -> bool {
        matches!(self, Self::Constant(_))
    }

    /// Returns M(d), m², which is precomputed at constant indentation.
    #[inline]
    pub fn reduced_force(self, law: &Interface, d: f64) -> f64 {
        match self {
            Self::Constant(reduced_force) => reduced_force,
            _ => law.reduced_force(d),
        }
    }
}

/// Law of a contact between two events.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Law(Form);

/// Kinds of laws.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Form {
    /// No contact.
    Open,
    /// Growth in full stick; the force is a state.
    Grow,
    /// Slip that spreads along one branch of the memory curve.
    Slip(Branch, Lead),
    /// Linear law of a row of springs until the next spring touches, separates, slips or sticks.
    Lull {
        /// Coefficients of the law.
        lull: Lull,
        /// Sense of sliding.
        sense: f64,
    },
    /// Full force law of the committed memory with its kinks, in one sense of sliding. Used without event location, and without friction.
    Whole {
        /// Sense of sliding.
        sense: f64,
    },
}

impl Law {
    /// No contact.
    pub const OPEN: Self = Self(Form::Open);

    /// Returns the full force law of the memory for a sliding direction: +1, -1, or 0 if it is unknown.
    pub fn whole(sense: f64) -> Self {
        Self(Form::Whole { sense })
    }

    /// Returns the law along a branch of the memory curve.
    pub fn slip(branch: Branch) -> Self {
        Self(Form::Slip(branch, Lead::NONE))
    }

    /// Returns whether the contact is open.
    #[inline]
    pub fn is_open(&self) -> bool {
        matches!(self.0, Form::Open)
    }

    /// Returns whether the contact grows in full stick; its force is then a state.
    #[inline]
    pub fn grows(&self) -> bool {
        matches!(self.0, Form::Grow)
    }

    /// Returns whether the full force law of the memory applies.
    #[inline]
    pub fn is_whole(&self) -> bool {
        matches!(self.0, Form::Whole { .. })
    }

    /// Returns the branch along which slip spreads, if it does.
    #[inline]
    pub fn branch(&self) -> Option<&Branch> {
        match &self.0 {
            Form::Slip(branch, _) => Some(branch),
            _ => None,
        }
    }

    /// Returns the linear law of a row of springs, if it applies.
    #[inline]
    pub fn lull(&self) -> Option<&Lull> {
        match &self.0 {
            Form::Lull { lull, .. } => Some(lull),
            _ => None,
        }
    }

    /// Returns the event functions that are velocities of a slip edge.
    pub fn edges(&self) -> &'static [Guard] {
        match &self.0 {
            Form::Slip(..) => &[Guard::Drag],
            Form::Grow => &[Guard::Lower, Guard::Upper],
            _ => &[],
        }
    }

    /// Returns +1 for forward, -1 for backward sliding, 0 otherwise.
    pub fn sense(&self) -> f64 {
        match &self.0 {
            Form::Open | Form::Grow => 0.0,
            Form::Slip(branch, _) => branch.sense(),
            Form::Whole { sense } | Form::Lull { sense, .. } => *sense,
        }
    }

    /// Shifts the origin of displacements back by `by` (m).
    pub fn shift(&mut self, by: f64) {
        match &mut self.0 {
            Form::Slip(branch, lead) => {
                branch.shift(by);
                lead.shift(branch.sense() * by);
            }
            Form::Lull { lull, .. } => lull.shift(by),
            Form::Open | Form::Grow | Form::Whole { .. } => {}
        }
    }

    /// Whether all springs slip.
    pub fn is_gross(&self) -> bool {
        matches!(&self.0, Form::Slip(branch, _) if branch.is_gross())
    }

    /// Returns the direction in which all springs slip, +1 or -1; 0 if one sticks.
    pub fn gross(&self) -> f64 {
        match &self.0 {
            Form::Slip(branch, _) if branch.is_gross() => branch.sense(),
            Form::Lull { lull, .. } => lull.gross(),
            _ => 0.0,
        }
    }

    /// Whether the contact has no tangential stiffness left: open, or in gross slip.
    pub fn has_given_way(&self, site: &impl Site) -> bool {
        match &self.0 {
            Form::Open => true,
            Form::Slip(branch, _) => branch.is_gross(),
            Form::Lull { lull, .. } => lull.stiffness(site.interface()) == 0.0,
            Form::Grow | Form::Whole { .. } => false,
        }
    }

    /// Whether some springs stick.
    pub fn holds(&self) -> bool {
        !self.is_gross() && !self.is_open()
    }

    /// Returns the law for a motion ("course") of the contact, from the committed memory.
    ///
    /// `slack` (m): a piece of memory with less left counts as used up; see [`Curve::branch`](crate::Curve::branch).
    pub fn of(
        site: &impl Site,
        memory: &Memory,
        (course, at): (Course, &Motion),
        slack: f64,
        tolerance: f64,
    ) -> Self {
        match (memory.branching(), course) {
            // Without load and tangential force it counts as open.
            _ if site.is_inert() && site.load() != Load::Coupled => Self::OPEN,
            // The springs of an open contact are unstretched.
            (_, Course::Open) => Self::OPEN,
            // A row of springs has linear laws instead of branches.
            (None, course) => {
                Self::whole(course.sense()).relinearised(site, memory, (at, Change::Any, 0.0), tolerance)
            }
            // Without friction there is no memory, but the bodies still press.
            _ if site.is_inert() => Self::whole(0.0),
            (Some(_), Course::Grow) => Self(Form::Grow),
            (Some(branching), Course::Forward | Course::Backward) => {
                let interface = site.interface();
                let mut law = Self::slip(branching.branch(memory.law(interface), course.sense(), slack));
                if interface.damping() > 0.0 {
                    law.aim_lead(site, memory, (at, None), tolerance);
                }
                law
            }
        }
    }

    /// Sets the branch that the damping of a slipping contact reaches at a motion.
    ///
    /// `fired` is the event function of the lead that has crossed zero, with the length left by rounding (m).
    #[inline(never)]
    pub fn aim_lead(
        &mut self,
        site: &impl Site,
        memory: &Memory,
        (at, fired): (&Motion, Option<(Guard, f64)>),
        tolerance: f64,
    ) {
        let law = site.interface();
        let (Form::Slip(branch, lead), Some(branching)) = (&mut self.0, memory.branching()) else { return };
        // The force of a contact that has broken loose lies on other branches.
        if law.kinetic().is_some() {
            return;
        }
        let near = 2.0 * Guard::Ahead.bands(site, tolerance, at.u).1;
        let (slack, turned) = match fired {
            Some((Guard::Ahead, left)) => (near + left, false),
            Some((Guard::Behind, left)) => (-near - left, false),
            Some((Guard::Turn, _)) => (0.0, !lead.is_turned()),
            // At constant depth the lead never turns before the slip.
            _ => (0.0, !site.load().is_constant() && branch.sense() * at.du < 0.0),
        };
        let reach = branch.sense() * (branch.sense() * law.damping() * at.du).max(0.0);
        let lengths = (reach, slack, near + slack.abs());
        *lead = branching.lead(memory.law(law), branch, at, lengths, turned);
    }

    /// Returns the law of a row with the motion `at` after a change of its springs. Rounding may stop the motion short of the
    /// change; a distance `left` (m) then counts as covered.
    pub fn relinearised(
        &self,
        site: &impl Site,
        memory: &Memory,
        (at, change, left): (&Motion, Change, f64),
        tolerance: f64,
    ) -> Self {
        let sense = self.sense();
        let Memory::Row(SpringRow { row, springs }) = memory else { return Self::whole(sense) };
        if !site.has_lulls() {
            return Self::whole(sense);
        }
        let near = |guard: Guard| guard.bands(site, tolerance, at.u).1;
        let mut slack = Slack { d: near(Guard::Rise), u: near(Guard::Forward) };
        match change {
            Change::Touches | Change::Parts => slack.d += left,
            Change::Slips(_) => slack.u += left,
            Change::Sticks | Change::Any => {}
        }
        let touched = self.lull().map_or(0.0, Lull::touch);
        let force = (site.load() == Load::Force).then_some(touched);
        // A row that has broken loose slides at its kinetic limit.
        let interface = site.interface();
        let interface =
            interface.kinetic().filter(|_| row.slides() != 0.0).unwrap_or_else(|| memory.law(interface));
        let lull = row.lull(springs, interface, (at, change), slack, force);
        Self(Form::Lull { lull, sense })
    }

    /// Writes the law as words.
    pub fn write(&self, words: &mut Vec<u64>) {
        match &self.0 {
            Form::Open => words.push(0),
            Form::Grow => words.push(1),
            Form::Slip(branch, lead) => {
                words.push(if lead.is_some() { 5 } else { 2 });
                branch.write(words);
                if lead.is_some() {
                    lead.write(words);
                }
            }
            Form::Whole { sense } => {
                words.push(3);
                push(words, [*sense]);
            }
            Form::Lull { lull, sense } => {
                words.push(4);
                lull.write(words);
                push(words, [*sense]);
            }
        }
    }

    /// Reads a law that [`Self::write`] wrote, for a contact with this interface. Returns `None` for invalid words.
    pub fn read(interface: &Interface, words: &mut Words<'_>) -> Option<Self> {
        Some(Self(match words.word()? {
            0 => Form::Open,
            1 => Form::Grow,
            2 => Form::Slip(Branch::read(interface, words)?, Lead::NONE),
            5 => Form::Slip(Branch::read(interface, words)?, Lead::read(words)?),
            3 => Form::Whole { sense: words.finite()? },
            4 => Form::Lull { lull: Lull::read(interface, words)?, sense: words.finite()? },
            _ => return None,
        }))
    }
}
