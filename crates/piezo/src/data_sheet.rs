//! What a maker says of a stack, and what follows from it.
//!
//! A stack is a rod of stiffness k = EA/L whose mass m is spread over its length. Held at one end it rings first at
//! ω = (π/2)√(k/m), with both ends free at ω = π√(k/m) (Rayleigh, *The Theory of Sound*, §§ 150-152). The drive knows springs without
//! a mass, so that of the rod goes to its ends, as much as makes a spring of stiffness k ring at those frequencies: 4m/π² to
//! the free end of a rod that is held, 2m/π² to each of two free ends.

use std::f64::consts::PI;
use std::fmt;

/// How far two numbers that say the same may be apart: data sheets round to two or three digits.
pub const AGREEMENT: f64 = 0.01;

/// Mechanical quality factor of a stack of which nothing is known.
///
/// Soft ceramics have 65 (PZT-5H) to 75 (PZT-5A) in the bulk and at low fields (Morgan Technical Publication TP-226, table of
/// properties); electrodes, bonds and high fields take a part of it.
pub const QUALITY: f64 = 50.0;

/// Numbers of a data sheet, and those that the scenario gives itself: SI, all above 0 where given.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct DataSheet {
    /// Nominal free stroke, m, …
    pub stroke: Option<f64>,
    /// … at this voltage, V.
    pub voltage: Option<f64>,
    /// Stiffness, N/m.
    pub stiffness: Option<f64>,
    /// Force at the nominal voltage that leaves no stroke, N.
    pub blocking_force: Option<f64>,
    /// Capacitance, F.
    pub capacitance: Option<f64>,
    /// First resonance without a load, Hz, both ends free.
    pub free_resonance: Option<f64>,
    /// First resonance without a load, Hz, one end held.
    pub held_resonance: Option<f64>,
}

/// What the scenario says itself.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Own {
    /// N/m.
    pub stiffness: Option<f64>,
    /// m/V.
    pub stroke_per_volt: Option<f64>,
    /// F.
    pub capacitance: Option<f64>,
    /// kg.
    pub mass: Option<f64>,
}

/// What is known of a stack.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stack {
    /// N/m.
    pub stiffness: f64,
    /// Free stroke per voltage, m/V, where anything tells.
    pub stroke_per_volt: Option<f64>,
    /// F, where anything tells.
    pub capacitance: Option<f64>,
    /// Its own mass, kg; 0 where nothing tells.
    pub mass: f64,
}

/// A number that others contradict, by its key.
#[derive(Debug, Clone, PartialEq)]
pub struct Contradiction {
    /// The key that is in the wrong, from the actuator on.
    pub key: &'static [&'static str],
    /// The other keys of which it is judged.
    pub against: Vec<&'static [&'static str]>,
    /// What does not fit, with its numbers.
    pub message: String,
}

/// Why numbers make no stack.
#[derive(Debug, Clone, PartialEq)]
pub enum SheetError {
    /// Two numbers do not fit.
    Contradiction(Contradiction),
    /// Nothing tells the stiffness.
    NoStiffness,
}

/// Keys of the form, from the actuator on.
mod keys {
    pub(super) const STROKE: &[&str] = &["data_sheet", "stroke"];
    pub(super) const VOLTAGE: &[&str] = &["data_sheet", "voltage"];
    pub(super) const STIFFNESS: &[&str] = &["data_sheet", "stiffness"];
    pub(super) const BLOCKING: &[&str] = &["data_sheet", "blocking_force"];
    pub(super) const CAPACITANCE: &[&str] = &["data_sheet", "capacitance"];
    pub(super) const FREE: &[&str] = &["data_sheet", "free_resonance"];
    pub(super) const HELD: &[&str] = &["data_sheet", "held_resonance"];
    pub(super) const OWN_STIFFNESS: &[&str] = &["stiffness"];
    pub(super) const OWN_PER_VOLT: &[&str] = &["stroke_per_volt"];
    pub(super) const OWN_CAPACITANCE: &[&str] = &["capacitance"];
    pub(super) const OWN_MASS: &[&str] = &["mass"];
}

impl DataSheet {
    /// What follows from the numbers.
    ///
    /// # Errors
    /// Numbers that miss each other by more than [`AGREEMENT`], and a stack whose stiffness nothing tells.
    pub fn stack(&self, own: &Own) -> Result<Stack, SheetError> {
        let force = self.blocking_force.zip(self.stroke).map(|(force, stroke)| force / stroke);
        let stiffness = own.stiffness.or(self.stiffness).or(force).ok_or(SheetError::NoStiffness)?;
        if let (Some(own), Some(sheet)) = (own.stiffness, self.stiffness) {
            let numbers = (own, sheet);
            agree(numbers, (keys::OWN_STIFFNESS, &[keys::STIFFNESS]), || {
                format!("{} N/um here, but {} N/um in the data sheet", Short(own / 1e6), Short(sheet / 1e6))
            })?;
        }
        if let (Some(force), Some(stroke)) = (self.blocking_force, self.stroke) {
            let key = if self.stiffness.is_some() { keys::STIFFNESS } else { keys::OWN_STIFFNESS };
            agree((force, stiffness * stroke), (keys::BLOCKING, &[key, keys::STROKE]), || {
                let made = stiffness * stroke;
                format!(
                    "stiffness times stroke is {} N/um times {} um = {} N, but the blocking force is {} N",
                    Short(stiffness / 1e6),
                    Short(stroke * 1e6),
                    Short(made),
                    Short(force)
                )
            })?;
        }
        if let (Some(own), Some(sheet)) = (own.capacitance, self.capacitance) {
            agree((own, sheet), (keys::OWN_CAPACITANCE, &[keys::CAPACITANCE]), || {
                format!("{} uF here, but {} uF in the data sheet", Short(own * 1e6), Short(sheet * 1e6))
            })?;
        }
        Ok(Stack {
            stiffness,
            stroke_per_volt: self.stroke_per_volt(own)?,
            capacitance: own.capacitance.or(self.capacitance),
            mass: self.mass(stiffness, own)?,
        })
    }

    fn stroke_per_volt(&self, own: &Own) -> Result<Option<f64>, SheetError> {
        let sheet = self.stroke.zip(self.voltage);
        if let (Some(own), Some((stroke, voltage))) = (own.stroke_per_volt, sheet) {
            let others = &[keys::STROKE, keys::VOLTAGE];
            agree((own * voltage, stroke), (keys::OWN_PER_VOLT, others), || {
                format!(
                    "{} nm/V times {} V is {} um, but the data sheet has {} um there",
                    Short(own * 1e9),
                    Short(voltage),
                    Short(own * voltage * 1e6),
                    Short(stroke * 1e6)
                )
            })?;
        }
        Ok(own.stroke_per_volt.or(sheet.map(|(stroke, voltage)| stroke / voltage)))
    }

    /// m = k(π/2ω)² of a rod that is held at one end, m = k(π/ω)² of one with both ends free.
    fn mass(&self, stiffness: f64, own: &Own) -> Result<f64, SheetError> {
        let of = |quarter_waves: f64, frequency: f64| stiffness * (quarter_waves / (4.0 * frequency)).powi(2);
        let told = [
            own.mass.map(|mass| (keys::OWN_MASS, mass)),
            self.held_resonance.map(|f| (keys::HELD, of(1.0, f))),
            self.free_resonance.map(|f| (keys::FREE, of(2.0, f))),
        ];
        let mut told = told.into_iter().flatten();
        match (told.next(), told.next()) {
            (None, _) => Ok(0.0),
            (Some((_, mass)), None) => Ok(mass),
            (Some((first, mass)), Some((key, other))) => {
                let said = |key: &[&str]| key.last().copied().unwrap_or_default().replace('_', " ");
                let message = format!(
                    "the {} makes a mass of {} g, the {} one of {} g: a lumped stack has one",
                    said(first),
                    Short(mass * 1e3),
                    said(key),
                    Short(other * 1e3)
                );
                agree((other, mass), (key, &[first]), || message)?;
                Ok(mass)
            }
        }
    }
}

impl Stack {
    /// kα²/C, the part of the electrical energy that goes to and fro with the strain where C is the free capacitance.
    #[must_use]
    pub fn coupling(&self) -> Option<f64> {
        let gain = self.stroke_per_volt?;
        self.capacitance.map(|capacitance| self.stiffness * gain * gain / capacitance)
    }

    /// What of its mass goes to each end, kg: nothing to one that is held.
    #[must_use]
    pub fn ends(&self, is_free: [bool; 2]) -> [f64; 2] {
        let share = match is_free {
            [true, true] => 2.0 / (PI * PI),
            _ => 4.0 / (PI * PI),
        };
        is_free.map(|free| if free { share * self.mass } else { 0.0 })
    }

    /// Damping c = √(k m)/Q of a stack between two masses, N s/m: then the resonance of what it moves, m = m₁m₂/(m₁ + m₂), has the
    /// quality factor Q, as of a material whose loss per cycle does not depend on the frequency. Infinite masses are those
    /// of ends that are held; nothing rings between two of them.
    #[must_use]
    pub fn damping(&self, masses: [f64; 2], quality: f64) -> f64 {
        let mobility: f64 = masses.iter().map(|mass| mass.recip()).sum();
        if mobility > 0.0 && mobility.is_finite() {
            (self.stiffness / mobility).sqrt() / quality
        } else {
            0.0
        }
    }
}

/// Refuses two numbers that ought to be the same and are not.
fn agree(
    (value, other): (f64, f64),
    (key, against): (&'static [&'static str], &[&'static [&'static str]]),
    message: impl FnOnce() -> String,
) -> Result<(), SheetError> {
    if (value - other).abs() <= AGREEMENT * value.abs().max(other.abs()) {
        return Ok(());
    }
    Err(SheetError::Contradiction(Contradiction { key, against: against.to_vec(), message: message() }))
}

/// A number in a sentence: four digits.
struct Short(f64);

impl fmt::Display for Short {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let rounded: f64 = format!("{:.3e}", self.0).parse().unwrap_or(self.0);
        write!(f, "{rounded}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The stage of a designer: 4.6 µm at 120 V, 100 N/µm, 7.2 µF.
    fn sheet() -> DataSheet {
        DataSheet {
            stroke: Some(4.6e-6),
            voltage: Some(120.0),
            blocking_force: Some(460.0),
            capacitance: Some(7.2e-6),
            ..DataSheet::default()
        }
    }

    #[test]
    fn stiffness_and_stroke_per_volt_follow() {
        let stack = sheet().stack(&Own::default()).unwrap();
        assert!((stack.stiffness / 1e8 - 1.0).abs() < 1e-15);
        assert_eq!(stack.stroke_per_volt, Some(4.6e-6 / 120.0));
        assert_eq!((stack.capacitance, stack.mass), (Some(7.2e-6), 0.0));
    }

    #[test]
    fn contradictions_are_refused_with_their_numbers() {
        let own = Own { stiffness: Some(9e7), ..Own::default() };
        let Err(SheetError::Contradiction(of)) = sheet().stack(&own) else { panic!("agrees") };
        assert_eq!(
            of.message,
            "stiffness times stroke is 90 N/um times 4.6 um = 414 N, but the blocking force is 460 N"
        );
        let own = Own { stroke_per_volt: Some(40e-9), ..Own::default() };
        let Err(SheetError::Contradiction(of)) = sheet().stack(&own) else { panic!("agrees") };
        assert_eq!(of.message, "40 nm/V times 120 V is 4.8 um, but the data sheet has 4.6 um there");
        // Rounded within a hundredth they agree, and what the scenario says itself holds.
        let own = Own { stiffness: Some(1.009e8), ..Own::default() };
        assert_eq!(sheet().stack(&own).unwrap().stiffness, 1.009e8);
        let none = DataSheet { stroke: Some(1e-6), ..DataSheet::default() };
        assert_eq!(none.stack(&Own::default()), Err(SheetError::NoStiffness));
    }

    /// A spring between lumped masses rings where the rod does, by either way of holding it: ω² = k/m and ω² = 2k/m.
    #[test]
    fn lumped_masses_ring_at_the_resonance_of_the_data_sheet() {
        let frequency = 40e3;
        let own = Own { stiffness: Some(1e8), ..Own::default() };
        let held = DataSheet { held_resonance: Some(frequency), ..DataSheet::default() };
        let held = held.stack(&own).unwrap();
        let [none, end] = held.ends([false, true]);
        assert!(((1e8 / end).sqrt() / (2.0 * PI) / frequency - 1.0).abs() < 1e-14 && none == 0.0);
        let free = DataSheet { free_resonance: Some(2.0 * frequency), ..DataSheet::default() };
        let free = free.stack(&own).unwrap();
        let [one, other] = free.ends([true, true]);
        assert!(((2.0 * 1e8 / one).sqrt() / (4.0 * PI) / frequency - 1.0).abs() < 1e-14 && one == other);
        // One rod, held or free.
        assert!((held.mass / free.mass - 1.0).abs() < 1e-14);
        assert!((held.damping([f64::INFINITY, end], 50.0) - (1e8 * end).sqrt() / 50.0).abs() < 1e-12);
        assert_eq!(held.damping([f64::INFINITY; 2], 50.0), 0.0);
    }
}
