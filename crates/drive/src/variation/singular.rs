//! Where an interval is singular, and how steps of the variation lie in it.

use crate::Model;
use crate::contact::Mode;
use crate::state::State;
use stickslip_stepper::Grade;

/// Which ends of an interval are singular: there forces go with a power 3/2 of the time.
pub(super) struct Singular {
    starts: bool,
    ends: bool,
}

/// A height, as a part of the natural depth, at which as good as nothing is in contact.
pub(super) const NOTHING: f64 = 1e-6;

impl Singular {
    /// An interval that starts where a contact has just touched, or ends where one parts or its last springs slip.
    pub(super) fn of(model: &Model, from: &State, to: &State) -> Self {
        let mut singular = Self { starts: false, ends: false };
        for (c, contact) in
            model.contacts.iter().enumerate().filter(|(_, contact)| !contact.is_never_pressed())
        {
            let least = NOTHING * contact.natural.depth;
            let (begin, end) = (from.memories[c].apex(), to.memories[c].apex());
            let slipped = matches!(&from.modes[c], Mode::Slip(branch) if branch.ends_in_the_centre() && branch.front(end.d, end.u) <= least);
            let pressed = from.modes[c] != Mode::Open;
            singular.starts |= pressed && begin.d <= least;
            singular.ends |= slipped || pressed && end.d <= least;
        }
        singular
    }

    /// Where a step from t ends that may be as long as `wish`, s, and how its stages lie. Where the last one was refused the end
    /// of the interval is come to by halves, which an even step bears as long as it is not singular.
    pub(super) fn aim(&self, (begin, t, end): (f64, f64, f64), wish: f64, refused: bool) -> (f64, Grade) {
        let left = end - t;
        let half = t + wish.min(0.5 * left);
        if self.starts && t == begin {
            return (
                if self.ends {
                    half
                } else if wish < left {
                    t + wish
                } else {
                    end
                },
                Grade::Start,
            );
        }
        match (self.ends, wish >= 0.5 * left) {
            (true, true) if !refused => (end, Grade::End),
            (true, _) => (half, Grade::Even),
            // No stub is left for the last step.
            (false, true) if wish >= left => (end, Grade::Even),
            (false, true) => (half, Grade::Even),
            (false, false) => (t + wish, Grade::Even),
        }
    }
}
