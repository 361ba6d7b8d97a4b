//! The piezo side of a drive: what stands between the voltage that a designer commands and the free stroke that a stack
//! follows. Each part is a block on the contract of [`stickslip_drive::component`]; a scene without them pays nothing.
//!
//! ```text
//! command e(t), V ──► driver ──► voltage V ──► hysteresis ──► creep ──► free stroke s, m
//! ```

pub mod creep;
pub mod hysteresis;
mod reading;

pub use reading::Reading;
