//! Mechanical properties of a piezo stack from its data sheet.
//!
//! A stack is modelled as a rod of stiffness k = EA/L with a mass m that is uniform over its length. The first resonance of the rod is ω =
//! (π/2)√(k/m) with one end held and ω = π√(k/m) with both ends free (Rayleigh, *The Theory of Sound*, §§ 150-152). The drive model has
//! massless springs. The mass of the rod is lumped at its ends, so that a massless spring has the resonances of the rod. The lumped mass is
//! 4m/π² at the free end of a held rod and 2m/π² at each of two free ends.

use std::f64::consts::PI;
use std::fmt;

/// Largest relative difference of two values of the same quantity. Data sheets round to two or three digits.
pub const AGREEMENT: f64 = 0.01;

/// Default mechanical quality factor of a stack.
///
/// The quality factor is 65 (PZT-5H) to 75 (PZT-5A) for soft ceramics in the bulk and at low fields (Morgan Technical Publication TP-226,
/// table of properties). Electrodes, bonds and high fields reduce the quality factor.
pub const QUALITY: f64 = 50.0;

/// Values of a data sheet in SI units. Every value that is given must be above 0.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct DataSheet {
    /// Nominal free stroke at the voltage `voltage`, m.
    pub stroke: Option<f64>,
    /// Voltage of the nominal stroke, V.
    pub voltage: Option<f64>,
    /// Stiffness, N/m.
    pub stiffness: Option<f64>,
    /// Blocking force at the nominal voltage, N: the force at which the stroke is 0.
    pub blocking_force: Option<f64>,
    /// Capacitance, F.
    pub capacitance: Option<f64>,
    /// First resonance without a load and with both ends free, Hz.
    pub free_resonance: Option<f64>,
    /// First resonance without a load and with one end held, Hz.
    pub held_resonance: Option<f64>,
}

/// Values of a stack that the scenario gives outside the data sheet.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Own {
    /// Stiffness, N/m.
    pub stiffness: Option<f64>,
    /// Free stroke per volt, m/V.
    pub stroke_per_volt: Option<f64>,
    /// Capacitance, F.
    pub capacitance: Option<f64>,
    /// Mass of the stack, kg.
    pub mass: Option<f64>,
}

/// Properties of a stack.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stack {
    /// Stiffness, N/m.
    pub stiffness: f64,
    /// Free stroke per volt, m/V, if known.
    pub stroke_per_volt: Option<f64>,
    /// Capacitance, F, if known.
    pub capacitance: Option<f64>,
    /// Mass of the stack, kg; 0 if unknown.
    pub mass: f64,
}

/// Contradiction between a value of a stack and other values.
#[derive(Debug, Clone, PartialEq)]
pub struct Contradiction {
    /// Path of the contradicting key, relative to the actuator.
    pub key: &'static [&'static str],
    /// Paths of the other keys with which the value was compared.
    pub against: Vec<&'static [&'static str]>,
    /// Message with the values that do not agree.
    pub message: String,
}

/// Reason why the given values do not define a stack.
#[derive(Debug, Clone, PartialEq)]
pub enum SheetError {
    /// Two values contradict each other.
    Contradiction(Contradiction),
    /// Neither the stiffness nor blocking force and stroke are given.
    NoStiffness,
}

/// Paths of the keys in the scenario file, relative to the actuator.
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
    /// Computes the properties of a stack from its data sheet and the scenario's own values. Values of the scenario take precedence.
    ///
    /// # Errors
    /// Fails if values of the same quantity differ by more than [`AGREEMENT`], or the stiffness is unknown.
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
                    "stiffness times stroke is {} N/um × {} um = {} N, but the blocking force is {} N",
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
                    "{} nm/V × {} V is {} um, but the data sheet has {} um",
                    Short(own * 1e9),
                    Short(voltage),
                    Short(own * voltage * 1e6),
                    Short(stroke * 1e6)
                )
            })?;
        }
        Ok(own.stroke_per_volt.or(sheet.map(|(stroke, voltage)| stroke / voltage)))
    }

    /// Returns the mass of the stack, kg: m = k(π/2ω)² from a resonance with one end held, m = k(π/ω)² with both ends free.
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
                    "the {} gives a mass of {} g, the {} gives {} g: a lumped stack has one mass",
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
    /// Returns the coupling kα²/C with the free capacitance C, if stroke per volt and capacitance are known.
    #[must_use]
    pub fn coupling(&self) -> Option<f64> {
        let gain = self.stroke_per_volt?;
        self.capacitance.map(|capacitance| self.stiffness * gain * gain / capacitance)
    }

    /// Returns the lumped mass at each end, kg; 0 at a held end.
    #[must_use]
    pub fn ends(&self, is_free: [bool; 2]) -> [f64; 2] {
        let share = match is_free {
            [true, true] => 2.0 / (PI * PI),
            _ => 4.0 / (PI * PI),
        };
        is_free.map(|free| if free { share * self.mass } else { 0.0 })
    }

    /// Returns the damping c = √(k m)/Q of a stack between two masses, N s/m, where m = m₁m₂/(m₁ + m₂) is the reduced mass.
    ///
    /// The resonance of the masses on the stack then has the quality factor Q. An infinite mass stands for a held end. The damping is
    /// 0 if both masses are infinite.
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

/// Checks that two values of the same quantity agree.
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

/// Number for a message, rounded to four digits.
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

    /// Example stack: 4.6 µm at 120 V, 100 N/µm, 7.2 µF.
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
            "stiffness times stroke is 90 N/um × 4.6 um = 414 N, but the blocking force is 460 N"
        );
        let own = Own { stroke_per_volt: Some(40e-9), ..Own::default() };
        let Err(SheetError::Contradiction(of)) = sheet().stack(&own) else { panic!("agrees") };
        assert_eq!(of.message, "40 nm/V × 120 V is 4.8 um, but the data sheet has 4.6 um");
        // Values within 1 % agree, and the value of the scenario is used.
        let own = Own { stiffness: Some(1.009e8), ..Own::default() };
        assert_eq!(sheet().stack(&own).unwrap().stiffness, 1.009e8);
        let none = DataSheet { stroke: Some(1e-6), ..DataSheet::default() };
        assert_eq!(none.stack(&Own::default()), Err(SheetError::NoStiffness));
    }

    /// A spring with lumped masses has the resonance of the rod in both cases: ω² = k/m and ω² = 2k/m.
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
        // The rod is the same, held or free.
        assert!((held.mass / free.mass - 1.0).abs() < 1e-14);
        assert!((held.damping([f64::INFINITY, end], 50.0) - (1e8 * end).sqrt() / 50.0).abs() < 1e-12);
        assert_eq!(held.damping([f64::INFINITY; 2], 50.0), 0.0);
    }
}
