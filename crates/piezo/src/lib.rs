//! Models of a piezo actuator: driver electronics, hysteresis and creep.
//!
//! Each model is a block, an implementation of [`stickslip_drive::component::Block`]. The chain of blocks converts the commanded
//! voltage into the free stroke of a stack. All blocks are optional.
//!
//! ```text
//! command e(t), V ──► driver ──► voltage V ──► hysteresis ──► creep ──► free stroke s, m
//! ```
//!
//! * [`data_sheet`] computes the mechanical properties of a stack from its data sheet.
//! * [`driver`] models the driver electronics: voltage window, bandwidth, resistance and current limits.
//! * [`forecast`] predicts the effect of the driver on a periodic command, without a simulation of the drive.
//! * [`hysteresis`] contains the models of Prandtl–Ishlinskii and of Bouc–Wen.
//! * [`creep`] models logarithmic creep.
//!
//! In every block a `law` is a discrete mode, numbered from 0. A `guard` is an event function: it is positive while its mode holds. The
//! zero crossing of an event function is an event that changes the mode.

pub mod creep;
pub mod data_sheet;
pub mod driver;
mod figures;
pub mod forecast;
pub mod hysteresis;
mod pace;
mod reading;

pub use figures::Figures;
pub use reading::Reading;
