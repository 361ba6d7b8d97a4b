//! The way of a contact through (u, F_x), fine enough to be drawn and measured.

use crate::job::Job;
use crate::series::Series;
use stickslip_contact::{Apex, Interface, Memory, Segment};
use stickslip_drive::{Stepper, Waveform};

/// Samples between the limit forces of one sign and the other.
const FINENESS: f64 = 128.0;
/// Net displacement of a cycle, as a share of its stroke, below which it counts as closed.
const CLOSED: f64 = 0.01;

/// Displacement and tangential force over time, all identical contacts together.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct ContactPath {
    pub(crate) t: Vec<f64>,
    /// Displacement u, m.
    pub(crate) u: Vec<f64>,
    /// Tangential force F_x, N.
    pub(crate) force: Vec<f64>,
}

impl ContactPath {
    /// The path of contact `c`. The law has no time in it: between two samples on one branch the force follows from
    /// the way alone, and all turning points are events. So under a constant load the contact is walked once more
    /// through the samples, and asked in between. Elsewhere the samples stand alone.
    pub(crate) fn of(job: &Job, c: usize, series: &Series) -> Self {
        let Some((name, law)) = job.model.contacts().nth(c) else { return Self::default() };
        let [u, d, force] = ["u_m", "d_m", "fx_N"].map(|quantity| series.column(name, quantity));
        let jumps = job.scenario.scene.waveforms.iter().any(|w| Waveform::has_jumps(&w.part));
        let turns_known = matches!(job.model.effective(job.scenario.plan.stepper), Stepper::Event { .. });
        let samples = Self { t: series.time().to_vec(), u: u.to_vec(), force: force.to_vec() };
        match job.start.memories().get(c) {
            Some(memory) if turns_known && !jumps && job.has_constant_load(c) => {
                let d = d.first().copied().unwrap_or(0.0);
                samples.refined(law, memory.clone(), d, f64::from(job.count(c)))
            }
            _ => samples,
        }
    }

    /// The path with points between its samples.
    fn refined(&self, law: &Interface, mut memory: Memory, d: f64, count: f64) -> Self {
        let limit = count * law.friction() * law.normal_force(d);
        let mut path = Self::default();
        for i in 0..self.t.len() {
            if i > 0 {
                self.between(i, (law, &memory, d, count), limit, &mut path);
            }
            path.push(self.t[i], self.u[i], self.force[i]);
            if memory.commit(law, Segment::Straight(Apex { d, u: self.u[i] })).is_err() {
                return self.clone();
            }
        }
        path
    }

    /// Points between samples i-1 and i, as many as the force changes.
    fn between(&self, i: usize, of: (&Interface, &Memory, f64, f64), limit: f64, path: &mut Self) {
        let (law, memory, d, count) = of;
        let change = (self.force[i] - self.force[i - 1]).abs();
        if change == 0.0 {
            return;
        }
        let parts = (0.5 * FINENESS * change / limit).ceil().min(FINENESS);
        for k in 1..parts as u32 {
            let share = f64::from(k) / parts;
            let at = |values: &[f64]| values[i - 1] + share * (values[i] - values[i - 1]);
            let u = at(&self.u);
            path.push(at(&self.t), u, count * memory.force(law, Apex { d, u }));
        }
    }

    fn push(&mut self, t: f64, u: f64, force: f64) {
        self.t.push(t);
        self.u.push(u);
        self.force.push(force);
    }

    /// The part from one time to another, both ends interpolated.
    pub(crate) fn part(&self, (from, to): (f64, f64)) -> Self {
        let mut part = Self::default();
        let end = |time: f64, after: usize, part: &mut Self| {
            let Some(before) = after.checked_sub(1) else { return };
            if after < self.t.len() && self.t[after] > time && self.t[before] < time {
                let share = (time - self.t[before]) / (self.t[after] - self.t[before]);
                let at = |values: &[f64]| values[before] + share * (values[after] - values[before]);
                part.push(time, at(&self.u), at(&self.force));
            }
        };
        let first = self.t.partition_point(|&t| t < from);
        let last = self.t.partition_point(|&t| t <= to);
        end(from, first, &mut part);
        for i in first..last {
            part.push(self.t[i], self.u[i], self.force[i]);
        }
        end(to, last, &mut part);
        part
    }

    /// Whether the contact comes back to where this part began.
    pub(crate) fn is_closed(&self) -> bool {
        let (low, high) = self.u.iter().fold((f64::MAX, f64::MIN), |(l, h), &u| (l.min(u), h.max(u)));
        match (self.u.first(), self.u.last()) {
            (Some(first), Some(last)) => (last - first).abs() <= CLOSED * (high - low),
            _ => false,
        }
    }

    /// The same with u counted from the start.
    pub(crate) fn counted_from_start(mut self) -> Self {
        let start = self.u.first().copied().unwrap_or(0.0);
        self.u.iter_mut().for_each(|u| *u -= start);
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use stickslip_contact::{Engine, Pair, Profile};

    fn law() -> Interface {
        let profile = Profile::paraboloid(1.0).unwrap();
        Interface::new(Pair::from_moduli(1.0, 0.8).unwrap(), profile, 0.3).unwrap()
    }

    #[test]
    fn a_coarse_path_is_refined_along_the_closed_form() {
        // Loading of a paraboloid, F = μF_N (1 - (1 - u/u_c)^{3/2}), sampled at its ends alone.
        let law = law();
        let (u_c, limit) = (law.gross_slip_displacement(1.0), 0.3 * law.normal_force(1.0));
        let memory = Engine::Curve.memory(&law, Apex { d: 1.0, u: 0.0 });
        let form = |u: f64| 2.0 * limit * (1.0 - (1.0 - u / u_c).powf(1.5));
        let end = 0.9 * u_c;
        let coarse = ContactPath { t: vec![0.0, 1.0], u: vec![0.0, end], force: vec![0.0, form(end)] };
        let path = coarse.refined(&law, memory, 1.0, 2.0);
        assert!(path.t.len() > 60, "{}", path.t.len());
        for (u, force) in path.u.iter().zip(&path.force) {
            assert!((force - form(*u)).abs() < 1e-13 * limit, "{u}: {force}");
        }
    }

    #[test]
    fn a_part_has_both_its_ends() {
        let line: Vec<f64> = (0..=10).map(f64::from).collect();
        let path = ContactPath { t: line.clone(), u: line.clone(), force: line };
        assert_eq!(path.part((2.5, 4.0)).u, [2.5, 3.0, 4.0]);
        assert_eq!(path.part((3.0, 4.25)).force, [3.0, 4.0, 4.25]);
        assert_eq!(path.part((-1.0, 20.0)).t.len(), 11);
        assert!(!path.is_closed());
        assert_eq!(path.part((2.0, 4.0)).counted_from_start().u, [0.0, 1.0, 2.0]);
    }
}
