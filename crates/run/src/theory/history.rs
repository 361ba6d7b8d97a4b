//! Load history of a contact: corners of a piecewise straight path.

use super::TheoryError;
use std::path::Path;
use stickslip_scenario::{Pairs, pairs, quantity};

/// Largest number of corners of a history.
const MOST: usize = 1000;

/// Piecewise straight path in the (d, u) plane.
///
/// If there are several corners and the first corner has a normal value and no tangential force, the path begins there with unstretched
/// springs. Otherwise the path begins at u = 0, with the normal value of the first corner, or with the default value if it has none.
#[derive(Debug, Clone, PartialEq)]
pub struct History {
    /// Corners of the path.
    pub corners: Vec<Corner>,
}

/// A corner of a history.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Corner {
    /// Normal value at the corner. `None` keeps the value of the previous corner.
    pub normal: Option<Normal>,
    /// Tangential value at the corner.
    pub tangential: Tangential,
}

/// Normal value.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Normal {
    /// Indentation d, m.
    Indentation(f64),
    /// Normal force, N.
    Force(f64),
}

/// Tangential value.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Tangential {
    /// Displacement u, m.
    Displacement(f64),
    /// Tangential force, N. If several displacements give this force, the first displacement on the path is used.
    Force(f64),
}

impl History {
    /// Reads corners such as `10 nm, -10 nm, 5 nm`, or `2 um : 1 um, 1 um : 1 um` with the normal value before the
    /// colon. Each value is a length or a force.
    ///
    /// # Errors
    /// The text is not a list of corners.
    pub fn parse(text: &str) -> Result<Self, TheoryError> {
        let corners: Result<Vec<Corner>, String> = text.split(',').map(corner).collect();
        Self::checked(corners.map_err(TheoryError::History)?)
    }

    /// Reads a CSV file with a column `u` or `fx` and an optional column `d` or `fn`, with units in the header.
    ///
    /// # Errors
    /// The file cannot be read or does not have these columns.
    pub fn read(path: &Path) -> Result<Self, TheoryError> {
        let Pairs { first, second, values } =
            pairs(path, &[("d", "m"), ("fn", "N")], &[("u", "m"), ("fx", "N")])?;
        let corner = |[normal, tangential]: [f64; 2]| Corner {
            normal: first.map(|k| if k == 0 { Normal::Indentation(normal) } else { Normal::Force(normal) }),
            tangential: match second {
                0 => Tangential::Displacement(tangential),
                _ => Tangential::Force(tangential),
            },
        };
        Self::checked(values.into_iter().map(corner).collect())
    }

    fn checked(corners: Vec<Corner>) -> Result<Self, TheoryError> {
        match corners.len() {
            0 => Err(TheoryError::History("expected at least one corner".to_owned())),
            count if count > MOST => {
                Err(TheoryError::History(format!("expected at most {MOST} corners, got {count}")))
            }
            _ => Ok(Self { corners }),
        }
    }
}

/// Reads one corner.
fn corner(text: &str) -> Result<Corner, String> {
    let (normal, tangential) = match text.split_once(':') {
        Some((normal, tangential)) => (Some(normal), tangential),
        None => (None, text),
    };
    let normal = normal.map(|text| either(text, Normal::Indentation, Normal::Force)).transpose()?;
    Ok(Corner { normal, tangential: either(tangential, Tangential::Displacement, Tangential::Force)? })
}

/// Smallest non-zero and largest accepted magnitude of a value, in SI units.
// Outside of this range, powers overflow or underflow, and quadrature does not converge.
const SIZES: [f64; 2] = [1e-24, 1e12];

/// Reads a quantity with unit and returns its value in SI.
///
/// # Errors
/// The text is not a quantity with this unit, or its value is outside of the range of magnitudes.
pub fn asked(text: &str, unit: &str) -> Result<f64, String> {
    let value = quantity(text, unit)?;
    let [least, most] = SIZES;
    if value == 0.0 || (least..=most).contains(&value.abs()) {
        return Ok(value);
    }
    Err(format!("expected 0 or a size from {least:e} to {most:e} {unit}, got \"{}\"", text.escape_debug()))
}

/// Reads a length or a force, distinguished by the unit. A number without unit is a length.
fn either<T>(text: &str, length: fn(f64) -> T, force: fn(f64) -> T) -> Result<T, String> {
    let text = text.trim();
    if text.is_empty() {
        return Err(
            "expected a length or a force, got an empty text\n   help: such as --history \"1 um, -1 um\""
                .to_owned(),
        );
    }
    match (asked(text, "m"), asked(text, "N")) {
        (Ok(value), _) => Ok(length(value)),
        (_, Ok(value)) => Ok(force(value)),
        (Err(message), _) => Err(message),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_tell_lengths_from_forces() {
        let read = |text: &str| History::parse(text).unwrap().corners;
        let u = |u| Corner { normal: None, tangential: Tangential::Displacement(u) };
        assert_eq!(read("10 nm, -10 nm,0"), [u(1e-8), u(-1e-8), u(0.0)]);
        let corner = Corner { normal: Some(Normal::Force(2.0)), tangential: Tangential::Force(-0.5) };
        assert_eq!(read("2 N : -500 mN"), [corner]);
        for text in ["", "1 um,", "1 s", "1 um : ", "1 : 2 : 3", "nan"] {
            assert!(History::parse(text).is_err(), "{text}");
        }
        assert!(History::parse(&vec!["1 um"; MOST + 1].join(",")).is_err());
    }
}
