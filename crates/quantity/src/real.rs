//! Numbers in JSON.

use serde::{Serialize, Serializer};

/// A number in JSON. Where it is not finite it is null, which every reader of JSON takes: JSON has no such numbers, and a
/// string in the place of one breaks who expects it. A summary notes where that happens.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Real(pub f64);

impl Serialize for Real {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        if self.0.is_finite() { serializer.serialize_f64(self.0) } else { serializer.serialize_none() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_not_finite_is_null() {
        let json = serde_json::to_string(&[1.5e-9, f64::NAN, f64::NEG_INFINITY].map(Real)).unwrap();
        assert_eq!(json, "[1.5e-9,null,null]");
    }
}
