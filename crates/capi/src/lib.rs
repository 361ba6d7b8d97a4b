//! C library and functional mock-up interface (FMI 2.0 and 3.0, co-simulation) of stickslip.
//!
//! One binary serves all scenarios. It opens no files but the scenario of an FMU, starts no threads and prints nothing. Modules in reading
//! order: `instance` (a simulation with variables and phases), `pointers` (pointers of callers), `c` (the functions of `stickslip.h`),
//! `fmu` (what both versions of FMI share), `fmi2`, `fmi3`.

pub mod c;
mod fmi2;
mod fmi3;
mod fmu;
mod instance;
mod pointers;
