//! The start of a run: given, or the static equilibrium under what acts at t = 0.

use crate::equations::Equations;
use crate::model::{Contact, Model, Place, Stroke};
use crate::record;
use crate::state::State;
use crate::{Plan, SceneError, Stepper};
use nalgebra::{DMatrix, DVector};
use stickslip_contact::{Apex, Move, Segment};

/// Parts in which the loads are put on where several coordinates share them: the order in which contacts slip
/// matters then.
const PARTS: u32 = 64;
/// Most free coordinates whose equilibrium is sought: the work grows with the cube of their number, seconds for these.
const MOST: usize = 200;
/// Most iterations of Newton's method for one part of the loads.
const ITERATIONS: u32 = 200;

impl Model {
    /// The state at t = 0 of a plan's run.
    ///
    /// Fails where a number of the plan is out of its range, where an equilibrium is asked for and there is none, where the
    /// plan's stepper cannot follow the model's waveforms, and where its fixed step is unstable.
    pub fn start(&self, plan: &Plan) -> Result<State, SceneError> {
        plan.check()?;
        let fixed =
            matches!(plan.stepper, Stepper::Verlet { .. } | Stepper::Rk4 { .. } | Stepper::Dopri5 { .. });
        if fixed && !self.free.is_empty() && self.waveforms.iter().any(crate::Waveform::has_jumps) {
            return Err(SceneError::new(
                "run.stepper",
                "only the stepper \"event\" follows waveforms that jump",
            )
            .help("take the event stepper, or give the waveform a flyback above 0"));
        }
        self.check_step(plan.stepper)?;
        let mut state = self.rest();
        if self.equilibrium && !self.free.is_empty() {
            self.settle(&mut state)?;
        }
        let varying = self.contacts.iter().filter(|c| !c.is_constant());
        state.jumps = -varying.map(|c| c.count * c.law.normal_energy(self.indentation(c, 0.0))).sum::<f64>();
        let mut row = Vec::new();
        record::fill(&self.equations(&state), &state, 0.0, &|i| state.y[i], &mut row);
        // The books' error at t = 0 is minus what is stored: that is where they start.
        state.origin = -row.last().copied().unwrap_or(0.0);
        Ok(state)
    }

    /// Refuses a fixed step with which the stiffest motion grows.
    fn check_step(&self, stepper: Stepper) -> Result<(), SceneError> {
        let (Stepper::Verlet { step } | Stepper::Rk4 { step }) = stepper else { return Ok(()) };
        let name = if matches!(stepper, Stepper::Verlet { .. }) { "verlet" } else { "rk4" };
        let limit = self.longest_step(stepper).unwrap_or(f64::INFINITY);
        if step < limit {
            return Ok(());
        }
        let message = format!(
            "expected less than {limit:.3e} s, from where on the stiffest motion grows, got {step:e} s"
        );
        Err(SceneError::new(format!("run.stepper.{name}.step"), message)
            .help("take a twentieth of that for accuracy, or the event stepper, which needs no step"))
    }

    fn equations<'s>(&'s self, state: &'s State) -> Equations<'s> {
        Equations::on(self, state, self.layout(), false)
    }

    /// Puts the loads on in proportion and follows the equilibrium.
    fn settle(&self, state: &mut State) -> Result<(), SceneError> {
        let n = self.free.len();
        if n > MOST {
            let message = format!("expected at most {MOST} free bodies for an equilibrium, got {n}");
            return Err(SceneError::new("run.start", message).help("give the bodies where they start"));
        }
        for i in 0..n {
            state.y[self.layout().velocity(i)] = 0.0;
        }
        let initial = self.forces(state, &state.y).0;
        let parts = if n == 1 { 1 } else { PARTS };
        for part in 1..=parts {
            let missing = &initial * (1.0 - f64::from(part) / f64::from(parts));
            self.balance(state, &missing)?;
            let apexes: Vec<Apex> = self.apexes(state, &state.y);
            for ((contact, memory), to) in self.contacts.iter().zip(&mut state.memories).zip(apexes) {
                // Finite: the solution has been checked.
                let _ = memory.commit(&contact.law, Segment::Straight(to));
            }
        }
        Ok(())
    }

    /// Newton's method with halved steps for forces = missing.
    fn balance(&self, state: &mut State, missing: &DVector<f64>) -> Result<(), SceneError> {
        let n = self.free.len();
        let mut y = state.y.clone();
        let (forces, mut stiffness) = self.forces(state, &y);
        let mut residual = forces - missing;
        for _ in 0..ITERATIONS {
            let Some(step) =
                stiffness.clone().lu().solve(&residual).filter(|s| s.iter().all(|x| x.is_finite()))
            else {
                return if residual.amax() == 0.0 { Ok(()) } else { Err(self.no_equilibrium(&residual)) };
            };
            let mut share = 1.0;
            let (norm, mut better) = (self.size(&residual), false);
            while share > 1e-10 && !better {
                let trial: Vec<f64> =
                    y.iter().enumerate().map(|(i, x)| if i < n { x + share * step[i] } else { *x }).collect();
                let (forces, tangent) = self.forces(state, &trial);
                let rest = forces - missing;
                better = self.size(&rest) < norm;
                if better {
                    (y, residual, stiffness) = (trial, rest, tangent);
                }
                share *= 0.5;
            }
            if !better || residual.amax() == 0.0 {
                break;
            }
        }
        if self.size(&residual) > 1e-9 {
            return Err(self.no_equilibrium(&residual));
        }
        state.y = y;
        Ok(())
    }

    /// Largest residual in units of what contacts and springs can hold and what presses on each body.
    fn size(&self, residual: &DVector<f64>) -> f64 {
        let unit = |i: usize| {
            let here = Place::Free(i);
            let on = self.contacts.iter().filter(|c| c.first == here || c.second == here);
            let limit = |d: f64, c: &Contact| c.count * c.law.friction() * c.law.normal_force(d);
            let contacts: f64 = on.map(|c| limit(self.indentation(c, 0.0), c)).sum();
            let at = self.links.iter().filter(|l| l.first == here || l.second == here);
            let links: f64 = at.map(|l| l.stiffness * self.free[i].scale.0 + l.preload.abs()).sum();
            (contacts + links + self.free[i].force.abs()).max(f64::MIN_POSITIVE)
        };
        residual.iter().enumerate().map(|(i, r)| r.abs() / unit(i)).fold(0.0, f64::max)
    }

    fn no_equilibrium(&self, residual: &DVector<f64>) -> SceneError {
        let (worst, force) =
            residual.iter().enumerate().fold(
                (0, 0.0),
                |worst: (usize, f64), (i, r)| {
                    if r.abs() > worst.1.abs() { (i, *r) } else { worst }
                },
            );
        let name = &self.bodies[self.free[worst].body].name;
        let message = format!("`{name}` has no static equilibrium along x: {force:.3e} N stay unbalanced");
        SceneError::new("run.start", message).help("lower the load, press harder, or start from rest instead")
    }

    fn apexes(&self, state: &State, y: &[f64]) -> Vec<Apex> {
        let eq = self.equations(state);
        self.contacts.iter().map(|c| eq.motion(c, 0.0, |i| y[i]).apex()).collect()
    }

    /// Static forces on the free coordinates, N, and the stiffness matrix -∂F/∂x, N/m.
    fn forces(&self, state: &State, y: &[f64]) -> (DVector<f64>, DMatrix<f64>) {
        let n = self.free.len();
        let eq = self.equations(state);
        let mut forces = DVector::from_iterator(n, self.free.iter().map(|f| f.force));
        let mut stiffness = DMatrix::zeros(n, n);
        let mut add = |first: Place, second: Place, force: f64, k: f64| {
            let ends = [(first, -1.0), (second, 1.0)];
            for (place, sign) in ends {
                let Place::Free(i) = place else { continue };
                forces[i] += sign * force;
                for (other, partner) in ends {
                    if let Place::Free(j) = other {
                        stiffness[(i, j)] += sign * partner * k;
                    }
                }
            }
        };
        for ((contact, memory), to) in self.contacts.iter().zip(&state.memories).zip(self.apexes(state, y)) {
            let response = memory.trial(&contact.law, Move::Chord(to));
            add(
                contact.first,
                contact.second,
                contact.count * response.force,
                contact.count * response.stiffness,
            );
        }
        for link in &self.links {
            let stroke = match link.stroke {
                Stroke::Constant(s) => s,
                Stroke::Driven(w) => eq.sample(w, 0.0).value,
            };
            let length = eq.place(link.second, 0.0, |i| y[i]).0 - eq.place(link.first, 0.0, |i| y[i]).0;
            add(link.first, link.second, link.stiffness * (stroke - length) + link.preload, link.stiffness);
        }
        for load in &self.loads {
            forces[load.free] += eq.sample(load.waveform, 0.0).value;
        }
        (forces, stiffness)
    }
}
