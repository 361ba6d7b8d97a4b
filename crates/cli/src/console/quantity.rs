//! Numbers with their units, as people read them.

pub(crate) use stickslip_results::quantity;
