//! Evaluation of runs and of measured records: steps, settling, fretting loops, energies, plausibility.
//!
//! Every quantity is defined in the comment of its field. Modules for plain series, simulated or measured:
//!
//! * [`series`] – requirements on a series, and the errors;
//! * [`cycles`] – splitting of a long record into cycles;
//! * [`fretting`] – results of one cycle: amplitudes, loop area, ratios, stiffness;
//! * [`regime`] – slip regime of a cycle and its thresholds;
//! * [`mod@steady_loop`] – mean loop of many noisy cycles, with confidence intervals;
//! * [`sequence`] – a sequence of values in memory or on disk;
//! * [`settling`] – convergence of a sequence and its limit;
//! * [`mean`] – mean of a stationary sequence with its error;
//! * [`steps`] – step length, back-step, mean speed and repeatability of a drive.
//!
//! Modules that evaluate a [`Setting`] (a scenario, its model and its initial state) during a run:
//!
//! * [`Periods`], [`marks`] – period ends and other sampling times;
//! * [`tally`] – all evaluations together; [`account`] (one drive period), [`contact_cycles`] (hysteresis loops), [`strides`]
//!   (step lengths), [`excursions`] (limits of the kinematics), [`books`] (energy balance), [`foot`];
//! * [`Series`], [`Trail`], [`Tracks`] – recorded time histories; [`contact_path()`] – path of a contact in the (u, F_x) plane;
//! * [`plausibility`], [`Warning`] – implausible scenarios and results.

pub mod account;
pub mod books;
pub mod contact_cycles;
pub mod contact_path;
pub mod cycles;
pub mod excursions;
pub mod foot;
pub mod fretting;
pub mod marks;
pub mod mean;
pub mod periods;
pub mod plausibility;
pub mod pulses;
pub mod regime;
pub mod sequence;
pub mod series;
mod setting;
pub mod settling;
mod simulated;
pub mod steady_loop;
pub mod steps;
pub mod strides;
pub mod tally;
mod tracks;
mod trail;
mod warning;

pub use account::Extreme;
pub use contact_path::contact_path;
pub use cycles::{Cut, noise, returning_cycles, reversals, split_cycles};
pub use fretting::{Cycle, reversal_stiffness};
pub use mean::{Mean, Moved};
pub use periods::Periods;
pub use regime::{Regime, Thresholds};
pub use sequence::Sequence;
pub use series::SeriesError;
pub use setting::Setting;
pub use settling::{Bounds, Settled, Settling};
pub use simulated::{ENERGY, Series};
pub use steady_loop::{Interval, MeanLoop, SteadyLoop, mean_loop, steady_loop};
pub use steps::{Steady, Steps, Stride, Strides};
pub use tracks::{Track, Tracks};
pub use trail::Trail;
pub use warning::Warning;
