//! Blocks of the piezo side in runs, against evaluations of their laws that share no code with them.

mod bouc_wen;
mod creep;
mod inverse;
mod parts;
mod plays;
