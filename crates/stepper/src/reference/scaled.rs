//! A system as the crate `ode_solvers` wants it.
//!
//! It knows one tolerance for all components and a norm over all of them: so it integrates z = y/weight, and components
//! that must not steer it get a weight beside which their error is nothing.

use super::Accepting;
use nalgebra::allocator::Allocator;
use nalgebra::{DefaultAllocator, Dim, OVector};

/// Weight of a component whose error is not controlled, 2³⁰⁰.
pub(super) const UNCONTROLLED: f64 = f64::from_bits((1023 + 300) << 52);

/// Where the solver is.
pub(super) struct Progress {
    /// End of the last accepted step, s.
    pub(super) time: f64,
    /// End of the stretch, s.
    pub(super) end: f64,
    /// Lengths of the last two accepted steps, s, the last one second.
    pub(super) steps: [f64; 2],
    /// State at `time`.
    pub(super) y: Vec<f64>,
}

/// The system as the crate `ode_solvers` wants it: in units of the tolerances, padded with zeros.
pub(super) struct Scaled<'a, S, D: Dim>
where
    DefaultAllocator: Allocator<D>,
{
    /// Told of each accepted step.
    pub(super) system: &'a mut S,
    /// y = weight · z.
    pub(super) weight: OVector<f64, D>,
    /// Coupled components.
    pub(super) dimension: usize,
    /// Coupled components and quadratures; what comes after them is padding.
    pub(super) total: usize,
    /// The crate owns the system while it runs and hands nothing back: what is to be known afterwards is kept here.
    pub(super) progress: &'a mut Progress,
}

impl<S: Accepting, D: Dim> ode_solvers::System<f64, OVector<f64, D>> for Scaled<'_, S, D>
where
    DefaultAllocator: Allocator<D>,
{
    fn system(&self, t: f64, z: &OVector<f64, D>, dz: &mut OVector<f64, D>) {
        let y = z.component_mul(&self.weight);
        let out = dz.as_mut_slice();
        self.system.slopes(t, &y.as_slice()[..self.dimension], &mut out[..self.total]);
        for (slope, weight) in out.iter_mut().zip(self.weight.as_slice()).take(self.total) {
            *slope /= weight;
        }
        out[self.total..].fill(0.0);
    }

    fn solout(&mut self, t: f64, z: &OVector<f64, D>, _: &OVector<f64, D>) -> bool {
        let Progress { time, end, steps, y } = &mut *self.progress;
        // The last step's sum t + (end - t) may miss the end, a corner, by a bit.
        let t = if (t - *end).abs() <= 2.0 * f64::EPSILON * end.abs() { *end } else { t };
        for ((y, z), weight) in y.iter_mut().zip(z.as_slice()).zip(self.weight.as_slice()) {
            *y = z * weight;
        }
        *steps = [steps[1], t - *time];
        *time = t;
        // The crate asks whether to stop.
        !self.system.accept(t, y)
    }
}
