//! Serialization of the memory curve.

use super::front::Front;
use super::knot::Knot;
use super::stack::SlopeRange;
use super::{Curve, Merged};
use crate::breaking::Rest;
use crate::words::{Words, push};
use crate::{Apex, Interface};

/// Number of words of a breakpoint.
const KNOT: usize = 7;

impl Curve {
    /// Writes the state of the curve.
    // The capacity belongs to the state, because it determines later merges.
    pub(crate) fn write(&self, words: &mut Vec<u64>) {
        words.reserve(13 + KNOT * self.knots.len());
        words.push(self.capacity as u64);
        push(words, [self.apex.d, self.apex.u, self.front.sense, self.front.height, self.slides]);
        self.rest.write(words);
        push(words, [self.range.low, self.range.high]);
        words.push(self.merged.knots);
        push(words, [self.merged.force, self.merged.energy]);
        words.push(self.knots.len() as u64);
        self.knots.iter().for_each(|knot| knot.write(words));
    }

    /// Reads a state that [`Self::write`] wrote.
    pub(crate) fn read(law: &Interface, words: &mut Words<'_>) -> Option<Self> {
        let capacity = usize::try_from(words.word()?).ok()?;
        let apex = words.apex()?;
        let front = Front { sense: words.finite()?, height: words.number()? };
        let slides = words.sense()?;
        let rest = Rest::read(law, words)?;
        let range = SlopeRange { low: words.number()?, high: words.number()? };
        let merged = Merged { knots: words.tally()?, force: words.finite()?, energy: words.finite()? };
        let count = words.count(capacity)?;
        let knots = (0..count).map(|_| Knot::read(law, words)).collect::<Option<Vec<_>>>()?;
        // A smaller capacity would leave too few breakpoints for a merge.
        let roomy = capacity >= Self::LEAST_CAPACITY;
        let sense = [-1.0, 0.0, 1.0].contains(&front.sense);
        (roomy && sense && is_curve(&knots, apex)).then_some(Self {
            knots,
            apex,
            front,
            slides,
            rest,
            range,
            capacity,
            merged,
        })
    }
}

/// Returns whether the breakpoints form a valid curve at an apex.
///
/// An open contact has no breakpoints. Otherwise the heights ascend from 0, and the last breakpoint is the apex.
fn is_curve(knots: &[Knot], apex: Apex) -> bool {
    let [first, .., last] = knots else { return knots.is_empty() && apex.d <= 0.0 };
    apex.d > 0.0
        && first.h == 0.0
        && last.apex() == apex
        && knots.windows(2).all(|pair| pair[0].h < pair[1].h)
}

impl Knot {
    fn write(&self, words: &mut Vec<u64>) {
        push(words, [self.h, self.p, self.slope, self.gain, self.shear, self.square]);
        words.push(u64::from(self.joined));
    }

    /// Reads a breakpoint. M and N are recomputed from the profile.
    fn read(law: &Interface, words: &mut Words<'_>) -> Option<Self> {
        let [h, p, slope, gain, shear, square] = [(); 6].map(|()| words.finite());
        let h = h?;
        let profile = law.profile();
        Some(Self {
            h,
            p: p?,
            slope: slope?,
            gain: gain?,
            reduced_force: profile.reduced_force(h),
            reduced_energy: profile.reduced_energy(h),
            shear: shear?,
            square: square?,
            joined: words.flag()?,
        })
    }
}
