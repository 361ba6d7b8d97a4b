//! What is measured of a run, or of a record of anything: plain series in, numbers out.
//!
//! Every quantity has one definition, written at its field. Of plain series, simulated or measured alike:
//!
//! * [`series`] – what a series must fulfil, and the error that says where it does not;
//! * [`cycles`] – cuts a long record into cycles;
//! * [`fretting`] – the quantities of one cycle: amplitudes, loop area, ratios, stiffness;
//! * [`regime`] – thresholds between partial and gross slip, and on which side a cycle lies;
//! * [`sequence`] – values in order, in memory or on a disk;
//! * [`settling`] – whether a sequence has settled, and where it goes;
//! * [`mean`] – the mean of values that go on changing, and how far it may be off;
//! * [`steps`] – the quantities of a drive: step length, back-step, mean speed, repeatability.
//!
//! Of a [`Setting`] – a scenario, its model and its start – while it runs:
//!
//! * [`Periods`], [`marks`] – when something is looked at;
//! * [`tally`] – all of it together, fed mark by mark; [`account`] (energies of a period), [`contact_cycles`] (loops of contacts),
//!   [`strides`] (lengths of steps), [`excursions`] (beyond the model), [`books`] (whether energies balance), [`foot`];
//! * [`Series`], [`Trail`], [`Tracks`] – what is kept of it; [`contact_path()`] – the way of a contact;
//! * [`plausibility`], [`Warning`] – what is odd about a scenario or a run.

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
