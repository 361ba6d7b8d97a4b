//! Where a contact is to go: corners of a path in straight lines.

use super::TheoryError;
use std::path::Path;
use stickslip_scenario::{Pairs, pairs, quantity};

/// Most corners of a history: each leaves a field and its springs.
const MOST: usize = 1000;

/// A path in straight lines of the (d, u) plane.
///
/// Where the first of several corners says what presses the contact and where it is, the path begins there, with springs that
/// nothing has stretched; else at u = 0, at the normal that the first corner gives or else the one asked for.
#[derive(Debug, Clone, PartialEq)]
pub struct History {
    /// Its corners.
    pub corners: Vec<Corner>,
}

/// A corner of a history.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Corner {
    /// What presses the contact there; as before where there is none.
    pub normal: Option<Normal>,
    /// Where it is pushed to.
    pub tangential: Tangential,
}

/// What presses a contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Normal {
    /// Indentation d, m.
    Indentation(f64),
    /// Normal force, N.
    Force(f64),
}

/// What pushes it sideways.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Tangential {
    /// Displacement u, m.
    Displacement(f64),
    /// Tangential force, N: of all displacements that give it the first on the way.
    Force(f64),
}

impl History {
    /// Reads corners such as `10 nm, -10 nm, 5 nm`, or `2 um : 1 um, 1 um : 1 um`: what presses before the colon, each a length
    /// or a force.
    ///
    /// # Errors
    /// A text that is none.
    pub fn parse(text: &str) -> Result<Self, TheoryError> {
        let corners: Result<Vec<Corner>, String> = text.split(',').map(corner).collect();
        Self::checked(corners.map_err(TheoryError::History)?)
    }

    /// Reads a CSV file with a column `u` or `fx` and, where the load changes, one `d` or `fn`, their units in their heads.
    ///
    /// # Errors
    /// A file that is no such table.
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

/// A corner as it is written.
fn corner(text: &str) -> Result<Corner, String> {
    let (normal, tangential) = match text.split_once(':') {
        Some((normal, tangential)) => (Some(normal), tangential),
        None => (None, text),
    };
    let normal = normal.map(|text| either(text, Normal::Indentation, Normal::Force)).transpose()?;
    Ok(Corner { normal, tangential: either(tangential, Tangential::Displacement, Tangential::Force)? })
}

/// Largest length or force that is taken, in SI, and least that is not 0: contacts of atoms and of mountains lie between.
// Powers of what lies beyond are infinite or nothing, and quadratures of those do not end.
const SIZES: [f64; 2] = [1e-24, 1e12];

/// A quantity of people's: its value in SI, of a size that a contact may have.
///
/// # Errors
/// No quantity of that unit, or one of no such size.
pub fn asked(text: &str, unit: &str) -> Result<f64, String> {
    let value = quantity(text, unit)?;
    let [least, most] = SIZES;
    if value == 0.0 || (least..=most).contains(&value.abs()) {
        return Ok(value);
    }
    Err(format!("expected 0 or a size from {least:e} to {most:e} {unit}, got \"{}\"", text.escape_debug()))
}

/// A length or a force, which its unit tells; a number without is a length.
fn either<T>(text: &str, length: fn(f64) -> T, force: fn(f64) -> T) -> Result<T, String> {
    let text = text.trim();
    if text.is_empty() {
        return Err("expected a length or a force, got nothing\n   help: such as --history \"1 um, -1 um\""
            .to_owned());
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
