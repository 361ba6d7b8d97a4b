//! Mathematical functions of `f64` whose results are bit-identical on every machine.
//!
//! The standard library calls the C library of the machine for `exp`, `powf`, `atan2` and others. C libraries differ in the last
//! digit. This crate uses the functions of the crate `libm`, which are compiled into the program. Their results depend only on IEEE
//! 754 arithmetic. Names and arguments are those of the methods of `f64`. A lint in `clippy.toml` forbids those methods elsewhere in
//! the program.

mod root;

pub use libm::{
    acos, acosh, asin, asinh, atan, atan2, atanh, cos, cosh, erfc, exp, exp2, expm1 as exp_m1,
    fma as mul_add, hypot, log as ln, log1p as ln_1p, log2, log10, pow as powf, sin, sincos as sin_cos, sinh,
    tan, tanh, tgamma as gamma,
};
pub use root::cbrt;
