//! Functions of real numbers whose bits are the same on every machine.
//!
//! The standard library hands `exp`, `powf`, `atan2` … to the C library of the machine, whose versions differ in the last place. These
//! are the crate `libm`'s, compiled into the program: the same operations in the same order wherever IEEE 754 holds. Names and
//! arguments are those of the methods of `f64`; a lint (`clippy.toml`) keeps those methods out of the rest of the program.

mod root;

pub use libm::{
    acos, acosh, asin, asinh, atan, atan2, atanh, cos, cosh, erfc, exp, exp2, expm1 as exp_m1,
    fma as mul_add, hypot, log as ln, log1p as ln_1p, log2, log10, pow as powf, sin, sincos as sin_cos, sinh,
    tan, tanh,
};
pub use root::cbrt;
