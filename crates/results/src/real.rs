//! Numbers in JSON.

use serde::{Serialize, Serializer};

/// A number that stays visible in JSON where it is not finite: as the string "NaN", "inf" or "-inf", which JSON's own
/// numbers cannot say and serialisers quietly turn into null.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Real(pub f64);

impl Serialize for Real {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        if self.0.is_finite() { serializer.serialize_f64(self.0) } else { serializer.collect_str(&self.0) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_not_finite_is_a_string() {
        let json = serde_json::to_string(&[1.5e-9, f64::NAN, f64::NEG_INFINITY].map(Real)).unwrap();
        assert_eq!(json, r#"[1.5e-9,"NaN","-inf"]"#);
    }
}
