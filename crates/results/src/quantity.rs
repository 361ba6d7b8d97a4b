//! Numbers with their units, as people read them.

use crate::real::Real;
use stickslip_analysis::Prefix;

/// Four digits with an SI prefix, of which a kilogram has one already.
pub fn quantity(value: Real, unit: &str) -> String {
    let (base, scaled) =
        unit.strip_prefix('k').filter(|unit| unit.starts_with('g')).map_or((unit, 1.0), |grams| (grams, 1e3));
    let prefix = Prefix::of_magnitude(scaled * value.0);
    let shown = prefix.apply(scaled * value.0);
    let digits = match shown.abs() {
        // 9.9996 is shown as 10.00 and not as 10.000.
        x if x >= 99.995 => 1,
        x if x >= 9.9995 => 2,
        _ => 3,
    };
    // Smaller than any prefix makes readable.
    if shown != 0.0 && shown.abs() < 0.9995 {
        return format!("{:.3e} {unit}", value.0);
    }
    if shown == 0.0 { format!("0 {unit}") } else { format!("{shown:.digits$} {}{base}", prefix.symbol) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn four_digits_are_shown() {
        assert_eq!(quantity(Real(161.847e-9), "m"), "161.8 nm");
        assert_eq!(quantity(Real(-1.5e-5), "m/s"), "-15.00 µm/s");
        assert_eq!(quantity(Real(0.0), "J"), "0 J");
        assert_eq!([0.5, 2.0].map(|mass| quantity(Real(mass), "kg")), ["500.0 g", "2.000 kg"]);
        assert_eq!(quantity(Real(9.999999999996e-6), "s"), "10.00 µs");
        assert_eq!(quantity(Real(0.0999999999), "s"), "100.0 ms");
        assert_eq!(quantity(Real(9.999e-6), "s"), "9.999 µs");
        assert_eq!(quantity(Real(2.0), "s"), "2.000 s");
        assert_eq!(quantity(Real(-1.2347e-30), "kg"), "-1.235e-30 kg");
    }
}
