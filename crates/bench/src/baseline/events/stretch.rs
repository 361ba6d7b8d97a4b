//! Right-hand side and event functions between two events.

use crate::baseline::{Free, Tie, Track};
use nalgebra::SVector;
use ode_solvers::System;
use ode_solvers::continuous_output_model::ContinuousOutputModel;
use std::cell::Cell;
use stickslip_contact::{Branch, Curve};
use stickslip_drive::Piece;

/// Maximum number of iterations of event location.
const ITERATIONS: usize = 60;

/// Contact on a branch.
pub(super) struct Held<'a> {
    pub(super) tie: &'a Tie,
    pub(super) curve: Curve,
    pub(super) branch: Branch,
    pub(super) d: f64,
    /// Reduced normal force M(d), m².
    pub(super) area: f64,
    /// Displacement u of the contact memory minus the displacement of the bodies, m.
    pub(super) origin: f64,
    /// Velocity below which no reversal is detected, m/s.
    pub(super) rest: f64,
}

/// System of equations between two events, with the interface of the solver.
pub(super) struct Stretch<'s, const D: usize> {
    pub(super) free: &'s [Free],
    pub(super) scales: &'s [(f64, f64)],
    pub(super) held: &'s [Held<'s>],
    pub(super) tracks: &'s [Track],
    pub(super) pieces: &'s [Piece],
    /// Times of the last two accepted steps, s.
    pub(super) times: &'s Cell<(f64, f64)>,
    /// Whether an event lies between the last two accepted steps.
    pub(super) fired: &'s Cell<bool>,
}

impl<const D: usize> Stretch<'_, D> {
    /// Returns the displacement u (m, relative to the origin of the memory) and the velocity u̇ (m/s) of a contact.
    pub(super) fn motion(&self, held: &Held<'_>, t: f64, y: &SVector<f64, D>) -> (f64, f64) {
        let form = &held.tie.slide;
        let (mut u, mut du) = (form.constant + held.origin, 0.0);
        for (i, (length, speed)) in self.scales.iter().enumerate() {
            u += form.free[i] * length * y[i];
            du += form.free[i] * speed * y[D / 2 + i];
        }
        for (w, factor) in &form.driven {
            let sample = self.tracks[*w].waveform.sample(&self.pieces[*w], t);
            u += factor * sample.value;
            du += factor * sample.rate;
        }
        (u, du)
    }

    /// Returns two event functions: one is negative after a reversal, the other beyond the end of the piece of memory.
    fn guards(&self, held: &Held<'_>, t: f64, y: &SVector<f64, D>) -> [f64; 2] {
        let (u, du) = self.motion(held, t, y);
        [held.branch.sense() * du + held.rest, held.branch.margin(held.d, u)]
    }

    /// Returns the time of the first event in (from, to], with its contact and event function.
    pub(super) fn first(
        &self,
        (from, to): (f64, f64),
        end: &SVector<f64, D>,
        dense: &ContinuousOutputModel<f64, SVector<f64, D>>,
    ) -> Option<(f64, usize, usize)> {
        let mut first: Option<(f64, usize, usize)> = None;
        for (c, held) in self.held.iter().enumerate() {
            for (g, fallen) in self.guards(held, to, end).into_iter().enumerate() {
                if fallen < 0.0 {
                    let value = |t| dense.evaluate(t).map_or(fallen, |y| self.guards(held, t, &y)[g]);
                    let t = root(&value, (from, to), fallen);
                    if first.is_none_or(|(earliest, ..)| t < earliest) {
                        first = Some((t, c, g));
                    }
                }
            }
        }
        first
    }
}

/// Returns the zero of a function that is negative at the end of an interval (regula falsi, Illinois variant). Returns the start if the
/// function is negative there.
fn root(value: &impl Fn(f64) -> f64, (from, to): (f64, f64), at_end: f64) -> f64 {
    let (mut a, mut fa, mut b, mut fb) = (from, value(from), to, at_end);
    if fa <= 0.0 {
        return from;
    }
    let (mut side, least) = (0, 2.0 * f64::EPSILON * to);
    for _ in 0..ITERATIONS {
        if b - a <= 2.0 * least {
            break;
        }
        // Stays away from both ends: one of them may be the root, and the other far away.
        let t = ((a * fb - b * fa) / (fb - fa)).clamp(a + least, b - least);
        let f = value(t);
        if f < 0.0 {
            (b, fb) = (t, f);
            fa *= if side == -1 { 0.5 } else { 1.0 };
            side = -1;
        } else {
            (a, fa) = (t, f);
            fb *= if side == 1 { 0.5 } else { 1.0 };
            side = 1;
        }
    }
    b
}

impl<const D: usize> System<f64, SVector<f64, D>> for Stretch<'_, D> {
    fn system(&self, t: f64, y: &SVector<f64, D>, dy: &mut SVector<f64, D>) {
        let n = D / 2;
        for (i, free) in self.free.iter().enumerate() {
            dy[n + i] = free.force;
        }
        for held in self.held {
            let (u, _) = self.motion(held, t, y);
            let force = held.tie.count * held.branch.force(&held.tie.law, held.d, u, held.area);
            for (i, factor) in held.tie.slide.free.iter().enumerate() {
                dy[n + i] -= factor * force;
            }
        }
        for (i, ((length, speed), free)) in self.scales.iter().zip(self.free).enumerate() {
            dy[i] = y[n + i] * speed / length;
            dy[n + i] /= free.mass * speed;
        }
    }

    fn solout(&mut self, t: f64, y: &SVector<f64, D>, _: &SVector<f64, D>) -> bool {
        self.times.set((self.times.get().1, t));
        let fallen = self.held.iter().any(|held| self.guards(held, t, y).into_iter().any(|g| g < 0.0));
        self.fired.set(fallen);
        fallen
    }
}

#[cfg(test)]
mod tests {
    use super::root;

    #[test]
    fn a_root_is_found_wherever_it_lies() {
        for place in [1.0 + 1e-12, 1.1, 1.5, 2.0 - 1e-12] {
            let found = root(&|t: f64| place - t, (1.0, 2.0), place - 2.0);
            assert!((found - place).abs() < 4e-15, "{found} {place}");
            let steep = root(&|t: f64| place.powi(9) - t.powi(9), (1.0, 2.0), place.powi(9) - 512.0);
            assert!((steep - place).abs() < 4e-15, "{steep} {place}");
        }
        assert_eq!(root(&|_| -1.0, (1.0, 2.0), -1.0), 1.0);
    }
}
