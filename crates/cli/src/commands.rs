//! Implementation of the commands, one module each: they call the libraries and print the results.

pub(crate) mod branch;
pub(crate) mod check;
pub(crate) mod compare;
pub(crate) mod completions;
pub(crate) mod contact;
pub(crate) mod curve;
pub(crate) mod explain;
pub(crate) mod export;
pub(crate) mod fit;
pub(crate) mod golden;
pub(crate) mod import;
pub(crate) mod info;
pub(crate) mod map;
pub(crate) mod materials;
pub(crate) mod measure;
pub(crate) mod new;
mod output;
pub(crate) mod plot;
pub(crate) mod realtime;
pub(crate) mod repro;
pub(crate) mod run;
pub(crate) mod schema;
pub(crate) mod sensitivity;
pub(crate) mod steady;
pub(crate) mod study;
pub(crate) mod view;
