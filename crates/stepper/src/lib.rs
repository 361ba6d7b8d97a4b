//! Time integrators for systems with memory, such as the slip memory of frictional contacts.
//!
//! A stepper attempts a step; the caller decides whether to accept it. Every stepper evaluates a [`System`] through a shared reference, so
//! a rejected step does not change the system. The owner of the system updates its memory after an accepted step, and restarts the stepper
//! after a discontinuity.
//!
//! Contents:
//!
//! * [`System`]: system of ordinary differential equations with quadratures.
//! * [`Attempt`]: adaptive one-step method. Its supertraits [`Method`] and [`Step`] do not depend on the system.
//! * [`DormandPrince`]: DOP853, order 8(5,3) with dense output.
//! * [`Nystrom`]: Runge–Kutta–Nyström, order 8(6), for [`Conservative`] systems, whose forces do not depend on velocities.
//! * [`Paired`]: [`Nystrom`] with [`DormandPrince`] for conservative systems with singular moments.
//! * [`Radau`]: implicit, order 9, for stiff systems.
//! * [`Gauss`]: Gauss's method of order 10, for linear equations along a known motion.
//! * [`StepControl`]: step-size control.
//! * [`root()`], [`narrow`], [`Cubic`]: zero crossings of event functions within a step.
//! * [`FixedStep`], [`Rk4`], [`Verlet`]: methods with a fixed step.
//! * [`reference`](mod@reference): Dormand–Prince 5(4) without events.
//!
//! ```
//! use stickslip_stepper::{Attempt, Completion, DormandPrince, Step, StepControl, StepLimits, System, Target};
//!
//! /// Oscillator ẍ = -x with the quadrature ∫ẋ² dt, the work of a damper of unit strength.
//! struct Oscillator;
//!
//! impl System for Oscillator {
//!     fn dimension(&self) -> usize { 2 }
//!     fn positions(&self) -> usize { 1 }
//!     fn total(&self) -> usize { 3 }
//!     fn slopes(&self, _t: f64, y: &[f64], dy: &mut [f64]) {
//!         dy.copy_from_slice(&[y[1], -y[0], y[1] * y[1]]);
//!     }
//! }
//!
//! let (mut stepper, mut control) = (DormandPrince::new(2, 3), StepControl::new(8, StepLimits::default()));
//! stepper.start(&Oscillator, 0.0, &[1.0, 0.0, 0.0]);
//! let mut h: f64 = 0.1;
//! while stepper.span().time < 1.0 {
//!     let time = stepper.span().time;
//!     let end = (time + h).min(1.0);
//!     let error = stepper.attempt(&Oscillator, Target::even(end), &[1e-9, 1e-9]);
//!     let verdict = control.propose(error, end - time);
//!     if verdict.accepted {
//!         stepper.complete(&Oscillator, Completion::EndSlopes);
//!         stepper.accept();
//!     }
//!     h = verdict.next;
//! }
//! assert!((stepper.span().begin[0] - 1.0_f64.cos()).abs() < 1e-8);
//! ```

mod system;
pub use system::System;
mod attempt;
pub use attempt::{Attempt, Completion, End, Hand, Method, Span, Step, Target};
mod dormand_prince;
pub use dormand_prince::{DormandPrince, Grade, ORDER as DOP853_ORDER};
mod nystrom;
pub use nystrom::{Conservative, Many, Nystrom, ORDER as NYSTROM_ORDER, One, Storage, Track, Values};
mod paired;
pub use paired::Paired;
mod gauss;
pub use gauss::{Coefficients, Components, Each, Gauss, NODES};
mod radau;
pub use radau::{ORDER as RADAU_ORDER, Radau};
mod control;
pub use control::{Rejection, StepControl, StepHistory, StepLimits, Verdict};
mod root;
pub use root::{Bracket, Point, narrow, root, root_near};
mod cubic;
pub use cubic::Cubic;
mod fixed_step;
pub use fixed_step::{FixedStep, Stepping};
mod nystrom4;
pub use nystrom4::Nystrom4;
mod rk4;
pub use rk4::Rk4;
mod verlet;
pub use verlet::Verlet;
pub mod reference;
