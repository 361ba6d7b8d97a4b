//! Loops, regimes and steps: plain series in, numbers out, whether they were simulated or measured.
//!
//! Every quantity has one definition, written at its field. In reading order:
//!
//! * [`series`] – what a series must fulfil, and the error that says where it does not;
//! * [`cycles`] – cuts a long record into cycles;
//! * [`fretting`] – the quantities of one cycle: amplitudes, loop area, ratios, stiffness;
//! * [`regime`] – thresholds between partial and gross slip, and on which side a cycle lies;
//! * [`sequence`] – values in order, in memory or on a disk;
//! * [`settling`] – whether a sequence has settled, and where it goes;
//! * [`mean`] – the mean of values that go on changing, and how far it may be off;
//! * [`steps`] – the quantities of a drive: step length, back-step, mean speed, repeatability.

pub mod cycles;
pub mod fretting;
pub mod mean;
pub mod regime;
pub mod sequence;
pub mod series;
pub mod settling;
pub mod steps;

pub use cycles::{Cut, returning_cycles, split_cycles};
pub use fretting::Cycle;
pub use mean::{Mean, Moved};
pub use regime::{Regime, Thresholds};
pub use sequence::Sequence;
pub use series::SeriesError;
pub use settling::{Bounds, Settled, Settling};
pub use steps::{Steady, Steps, Stride, Strides};
