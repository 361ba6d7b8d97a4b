//! Mean normal force of a contact over a cycle, for a load that follows a waveform.

use crate::Setting;
use stickslip_contact::Interface;
use stickslip_drive::Waveform;
use stickslip_drive::scene::{Normal, Varying};

/// Tolerance of the mean normal force, relative to its maximum.
const WANTED: f64 = 1e-11;
/// Number of initial integration intervals per shortest wave or piece of the waveform.
const PARTS: f64 = 4.0;
/// Maximum number of bisections of an integration interval. Many are needed where the contact opens, because the force has a kink there.
const HALVINGS: u32 = 40;

/// A waveform that prescribes the normal force, the indentation or the contact radius of a contact.
#[derive(Debug, Clone)]
pub(super) struct Load {
    waveform: Waveform,
    quantity: Quantity,
    /// Number of identical contacts.
    count: f64,
}

#[derive(Debug, Clone, Copy)]
enum Quantity {
    Force,
    Indentation,
    Radius,
}

impl Load {
    /// Returns the waveform of the normal load of contact `c`.
    ///
    /// Returns `None` if the load is constant, depends on the motion of bodies, or is computed or set during the run.
    pub(super) fn of(setting: &Setting, c: usize) -> Option<Self> {
        let (varying, quantity) = match setting.scenario.scene.contacts.get(c)?.part.normal {
            Normal::Force(load) => (load, Quantity::Force),
            Normal::Indentation(load) => (load, Quantity::Indentation),
            Normal::Radius(load) => (load, Quantity::Radius),
            Normal::Coupled => return None,
        };
        let Varying::Follows(signal) = varying else { return None };
        let waveform = &setting.scenario.scene.waveforms.get(signal)?.part;
        let is_known = waveform.generator().is_none() && waveform.interpolation().is_none();
        is_known.then(|| Self { waveform: waveform.clone(), quantity, count: f64::from(setting.count(c)) })
    }

    /// Returns the mean normal force of all identical contacts between two times, s, in N, by adaptive Simpson integration.
    pub(super) fn mean(&self, law: &Interface, [from, to]: [f64; 2]) -> f64 {
        let longest = self.waveform.quickest() / PARTS;
        // The tolerance is relative to the largest force, because small forces are dominated by rounding errors.
        let wanted = WANTED * self.force(law, self.waveform.range().1);
        let (mut sum, mut piece) = (0.0, self.waveform.piece_at(from));
        loop {
            let [start, end] = [piece.start.max(from), piece.end.min(to)];
            let force = |t: f64| self.force(law, self.waveform.sample(&piece, t).value);
            let parts = ((end - start) / longest).ceil().max(1.0);
            for k in 0..parts as u64 {
                let at = |k: u64| start + (end - start) * (k as f64 / parts);
                sum += Part::new([at(k), at(k + 1)], &force).integral((wanted, HALVINGS), &force);
            }
            if piece.end >= to {
                return self.count * sum / (to - from);
            }
            piece = self.waveform.after(&piece);
        }
    }

    /// Returns the normal force of one contact for a value of the waveform, N.
    fn force(&self, law: &Interface, value: f64) -> f64 {
        match self.quantity {
            Quantity::Force => value.max(0.0),
            Quantity::Indentation => law.normal_force(value),
            Quantity::Radius => law.normal_force(law.profile().depth(value.max(0.0))),
        }
    }
}

/// An integration interval with the forces at both ends and at the middle.
#[derive(Clone, Copy)]
struct Part {
    ends: [f64; 2],
    forces: [f64; 3],
}

impl Part {
    fn new([start, end]: [f64; 2], force: &impl Fn(f64) -> f64) -> Self {
        Self { ends: [start, end], forces: [force(start), force(0.5 * (start + end)), force(end)] }
    }

    fn simpson(&self) -> f64 {
        let ([start, end], [a, b, c]) = (self.ends, self.forces);
        (end - start) * (a + 4.0 * b + c) / 6.0
    }

    /// Returns ∫ F dt, N s, by recursive bisection. With enough `halvings`, the error is below `wanted` (N) times the length.
    fn integral(&self, (wanted, halvings): (f64, u32), force: &impl Fn(f64) -> f64) -> f64 {
        let ([start, end], [a, b, c]) = (self.ends, self.forces);
        let middle = 0.5 * (start + end);
        let half = |ends: [f64; 2], [first, last]: [f64; 2]| Self {
            ends,
            forces: [first, force(0.5 * (ends[0] + ends[1])), last],
        };
        let halves = [half([start, middle], [a, b]), half([middle, end], [b, c])];
        let fine: f64 = halves.iter().map(Self::simpson).sum();
        let change = fine - self.simpson();
        // Richardson extrapolation: the error after the bisection is 1/15 of the change.
        if halvings == 0 || change.abs() <= wanted * (end - start) {
            return fine + change / 15.0;
        }
        halves.iter().map(|half| half.integral((wanted, halvings - 1), force)).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use stickslip_contact::{Pair, Profile};
    use stickslip_drive::{Shape, Timing};

    fn load(amplitude: f64, offset: f64, frequency: f64, quantity: Quantity) -> Load {
        let shape = Shape::Sine { amplitude, phase: 0.0, offset };
        let waveform = Waveform::new(shape, Timing::every(frequency.recip())).unwrap();
        Load { waveform, quantity, count: 2.0 }
    }

    /// Means from closed forms. Sine: its offset. Sine with lift-off for half of the time: A/π. Paraboloid at the depth d₀ + A sin ωt, F =
    /// c d^{3/2}: the binomial series c d₀^{3/2}(1 + 3/16 ε² + 9/1024 ε⁴ + …) with ε = A/d₀.
    #[test]
    fn means_are_those_of_closed_forms() {
        let law =
            Interface::new(Pair::from_moduli(1.0, 0.8).unwrap(), Profile::paraboloid(1.0).unwrap(), 0.3);
        let law = law.unwrap();
        let near = |got: f64, want: f64| assert!((got / want - 1.0).abs() < 1e-10, "{got}, not {want}");
        for frequency in [16.0, 50.0, 128.0, 256.0] {
            near(load(6.0, 10.0, frequency, Quantity::Force).mean(&law, [3.0, 4.0]), 20.0);
        }
        // A load that reaches 0 exactly: only rounding is left there, which bisection cannot reduce.
        near(load(10.0, 10.0, 50.0, Quantity::Force).mean(&law, [1.0, 2.0]), 20.0);
        near(load(6.0, 0.0, 7.0, Quantity::Force).mean(&law, [0.0, 1.0]), 2.0 * 6.0 / std::f64::consts::PI);
        let swelling = 1.0 + 3.0 / 16.0 * 1e-4 + 9.0 / 1024.0 * 1e-8;
        let mean = load(0.01, 1.0, 40.0, Quantity::Indentation).mean(&law, [0.0, 1.0]);
        near(mean, 2.0 * law.normal_force(1.0) * swelling);
    }
}
