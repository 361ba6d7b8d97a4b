//! Values of the points of a curve.

use super::CurveError;

/// Maximum number of points. Each point may need hundreds of periods.
const MOST: usize = 10_000;

/// Closed range of values.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Range {
    /// Start of the range, SI.
    pub from: f64,
    /// End of the range, SI, greater than the start.
    pub to: f64,
    /// Number of points, 2 to 10 000.
    pub points: usize,
    /// Spacing of the points: logarithmic if true, otherwise linear.
    pub decades: bool,
}

impl Range {
    /// Reads the two ends of a range such as `0.1..0.6` or `10 Hz..5 kHz`, and returns them in SI units. Numbers
    /// without a unit are in `unit`.
    ///
    /// A unit at only one end is an error unless the other end is 0.
    ///
    /// # Errors
    /// Returns a message with the expected form.
    pub fn ends(text: &str, unit: &str) -> Result<[f64; 2], String> {
        let expected = || format!("expected FROM..TO, such as 0.1..0.6, got \"{text}\"");
        let (from, to) = text.split_once("..").ok_or_else(expected)?;
        let ends = [stickslip_scenario::quantity(from, unit)?, stickslip_scenario::quantity(to, unit)?];
        let bare = [from, to].map(|end| end.trim().parse::<f64>().is_ok());
        match bare[0] == bare[1] || bare.iter().zip(ends).any(|(bare, end)| *bare && end == 0.0) {
            true => Ok(ends),
            false => Err(format!(
                "expected a unit at both ends or at none, which is {}, got \"{text}\"",
                if unit.is_empty() { "a plain number" } else { unit }
            )),
        }
    }

    /// Returns the values in ascending order. The first and last value are exactly the ends.
    ///
    /// # Errors
    /// Fails if the range is empty or not finite, the number of points is invalid, or a logarithmic range does not
    /// start above 0.
    pub fn values(&self) -> Result<Vec<f64>, CurveError> {
        let Self { from, to, points, decades } = *self;
        let is_usable = from.is_finite() && to.is_finite() && from < to && (to - from).is_finite();
        if !is_usable {
            return Err(CurveError::Range { from, to });
        }
        if !(2..=MOST).contains(&points) {
            return Err(CurveError::Points { most: MOST, got: points });
        }
        if decades && from <= 0.0 {
            return Err(CurveError::Decades { from, to });
        }
        let last = points - 1;
        let value = |k: usize| match k as f64 / last as f64 {
            _ if k == 0 => from,
            _ if k == last => to,
            share if decades => from * math::powf(to / from, share),
            share => from + share * (to - from),
        };
        Ok((0..points).map(value).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn range(from: f64, to: f64, points: usize, decades: bool) -> Result<Vec<f64>, CurveError> {
        Range { from, to, points, decades }.values()
    }

    #[test]
    fn ends_are_kept_and_parts_are_equal() {
        assert_eq!(range(0.0, 1.0, 5, false), Ok(vec![0.0, 0.25, 0.5, 0.75, 1.0]));
        let decades = range(0.1, 1e3, 5, true).unwrap_or_default();
        let wanted = [0.1, 1.0, 10.0, 100.0, 1e3];
        assert!(decades.iter().zip(wanted).all(|(found, wanted)| (found / wanted - 1.0).abs() < 1e-14));
        assert_eq!((decades[0], decades[4]), (0.1, 1e3));
    }

    /// "1 g..2" must not mean 1 g to 2 kg.
    #[test]
    fn a_unit_at_one_end_only_is_refused() {
        let ends = |text, unit| Range::ends(text, unit);
        assert_eq!(ends("1 g..2 g", "kg"), Ok([1e-3, 2e-3]));
        assert_eq!(ends("0.001..2e-3", "kg"), Ok([1e-3, 2e-3]));
        assert_eq!(ends("0..2 g", "kg"), Ok([0.0, 2e-3]));
        assert_eq!(ends("-2 mN..0", "N"), Ok([-2e-3, 0.0]));
        for text in ["1 g..2", "1..2 g", "1e-3 ..2 kg"] {
            let refused = ends(text, "kg").unwrap_err();
            assert!(refused.starts_with("expected a unit at both ends or at none, which is kg"), "{refused}");
        }
        assert!(ends("1", "kg").unwrap_err().contains("expected FROM..TO"));
        assert!(ends("1..2..3", "").is_err());
    }

    #[test]
    fn ranges_that_hold_nothing_are_refused() {
        let refused = CurveError::Range { from: 2.0, to: 1.0 };
        assert_eq!(range(2.0, 1.0, 5, false), Err(refused));
        for (from, to) in [(1.0, 1.0), (f64::NAN, 1.0), (0.0, f64::INFINITY), (-f64::MAX, f64::MAX)] {
            assert!(matches!(range(from, to, 5, false), Err(CurveError::Range { .. })), "{from} {to}");
        }
        assert_eq!(range(0.0, 1.0, 1, false), Err(CurveError::Points { most: MOST, got: 1 }));
        assert_eq!(range(0.0, 1.0, 5, true), Err(CurveError::Decades { from: 0.0, to: 1.0 }));
    }
}
