//! Tests of the piezo blocks in simulations, against independent evaluations of their laws.

mod bouc_wen;
mod creep;
mod inverse;
mod parts;
mod plays;
