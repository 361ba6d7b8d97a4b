//! The piezo side of a drive: what stands between the voltage that a designer commands and the free stroke that a stack
//! follows. Each part is a block on the contract of [`stickslip_drive::component`]; a scene without them pays nothing.
//!
//! ```text
//! command e(t), V ──► driver ──► voltage V ──► hysteresis ──► creep ──► free stroke s, m
//! ```
//!
//! In reading order: [`data_sheet`], what a stack is; [`driver`], what makes a voltage of a command, and
//! [`forecast`], what it will make of one; [`hysteresis`] and [`creep`],
//! what a stack makes of a voltage.

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
