//! First loadings with closed-form values from other sources.

use crate::check::worst;
use crate::contact_bem::{Loaded, interface, load};
use crate::subject::ValidationError;
use crate::table::{Table, significant};
use stickslip_contact::FirstLoading;

/// Two cases with their published digits, in N, mm and MPa.
// The limit is one unit of the last digit: half a unit for rounding of the result, the rest for rounded inputs.
const DIGITS: [Worked; 2] = [
    Worked {
        law: (200e6, 0.42, 50e-3, 0.4),
        force: 9.195_402_3,
        share: 0.875,
        digits: [
            ("approach d, mm", "0.0200000"),
            ("contact radius a, mm", "1.00000"),
            ("largest pressure, MPa", "4.39048"),
            ("shift u, mm", "8.17241e-3"),
            ("elastic energy, J", "8.53365e-5"),
            ("friction work, J", "2.75545e-6"),
            ("stick radius c, mm", "0.500000"),
        ],
    },
    Worked {
        law: (1e6, 0.28, 168.747_9e-3, 0.4013),
        force: 0.4705,
        share: 0.657,
        digits: [
            ("approach d, mm", "7.259212e-2"),
            ("contact radius a, mm", "3.499967"),
            ("largest pressure, MPa", "1.833890e-2"),
            ("shift u, mm", "1.774577e-2"),
            ("elastic energy, J", ""),
            ("friction work, J", "1.27362e-7"),
            ("stick radius c, mm", ""),
        ],
    },
];

/// A first loading with known results.
struct Worked {
    /// Shear modulus, Pa; ν; effective radius, m; μ.
    law: (f64, f64, f64, f64),
    force: f64,
    share: f64,
    /// Name and digits; no digits if unknown.
    digits: [(&'static str, &'static str); 7],
}

/// Returns the table of closed-form values, and the largest deviation in units of the last digit.
pub(crate) fn worked() -> Result<(Table, f64), ValidationError> {
    let mut table = Table::new(
        "Closed-form values from other sources (F_x/(μF_N) = 0.875 and 0.657):",
        &["quantity", "program", "known", "program", "known"],
    );
    let mut units = Vec::new();
    let mut cells: Vec<Vec<String>> =
        DIGITS[0].digits.iter().map(|(name, _)| vec![(*name).to_owned()]).collect();
    for case in &DIGITS {
        let Loaded { state, peak, elastic, friction } = load(&interface(case.law)?, case.force, case.share)?;
        let FirstLoading { d, a, u, c, .. } = state;
        let values = [1e3 * d, 1e3 * a, peak / 1e6, 1e3 * u, elastic, friction, 1e3 * c];
        for (((_, digits), value), row) in case.digits.iter().zip(values).zip(&mut cells) {
            if let Ok(known) = digits.parse::<f64>() {
                units.push((value - known) / last_digit(digits));
            }
            let known = if digits.is_empty() { "–" } else { digits };
            row.extend([significant(value, 8), known.to_owned()]);
        }
    }
    cells.into_iter().for_each(|row| table.row(row));
    Ok((table, worst(units)))
}

/// Returns the unit of the last digit of a number in text form.
fn last_digit(text: &str) -> f64 {
    let (mantissa, exponent) = text.split_once('e').unwrap_or((text, "0"));
    let after = mantissa.split_once('.').map_or(0, |(_, digits)| digits.len());
    10.0_f64.powi(exponent.parse::<i32>().unwrap_or(0) - after as i32)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_digit_of_a_number_is_found() {
        for (text, unit) in [("0.0200000", 1e-7), ("8.17241e-3", 1e-8), ("3.499967", 1e-6), ("7", 1.0)] {
            assert!((last_digit(text) / unit - 1.0).abs() < 1e-12, "{text}");
        }
    }
}
