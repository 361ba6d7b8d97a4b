//! Slip regimes of fretting cycles: thresholds between partial and gross slip for a profile and a test rig.

use crate::Cycle;
use crate::series::{SeriesError, check_positive};

/// Values of the ratios A, B and D at the onset of gross slip.
///
/// For a profile f ~ rⁿ on a rigid rig, A = 1/(2n+1), D = 2^{1/(n+1)} - 1 and B = A/D. A sphere (n = 2) has 0.2, 0.2599 and 0.7695. A
/// compliance C in series increases only δ\*: A and D are divided by 1 + `C/(u_c/μF_N)`, and B is unchanged.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Thresholds {
    /// Threshold of A = `E_d/E_t`. `None` if the compliance of the rig is unknown.
    pub energy_ratio: Option<f64>,
    /// Threshold of B = `E_d/(4Q*δ₀)`. `None` for a flat punch, which has no loop at the onset of gross slip.
    pub system_free_ratio: Option<f64>,
    /// Threshold of D = δ₀/δ\*. `None` if the compliance of the rig is unknown.
    pub slip_ratio: Option<f64>,
}

/// Slip regime of a contact.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Regime {
    /// Full stick: the energy loss is below the resolution, or the contact does not move.
    Stick,
    /// Partial slip: the rim slips, the centre sticks.
    Partial,
    /// Mixed regime: the criteria disagree, as at the onset of gross slip, or the cycles have different regimes.
    Mixed,
    /// Gross slip: the whole contact slips in every cycle.
    Gross,
}

impl Regime {
    /// Returns the name of the regime.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Stick => "stick",
            Self::Partial => "partial",
            Self::Mixed => "mixed",
            Self::Gross => "gross",
        }
    }
}

impl Thresholds {
    /// Energy ratio A below which a loop counts as full stick.
    ///
    /// The value exceeds the noise of a good rig and the error of a simulation. A sphere at 1 % of the amplitude at gross slip has a larger
    /// ratio A.
    pub const RESOLUTION: f64 = 5e-4;

    /// Returns the thresholds for the profile exponent n (f ~ rⁿ, above 0; infinite for a flat punch) on a rigid rig.
    ///
    /// # Errors
    /// The exponent is not above 0.
    pub fn of_profile(n: f64) -> Result<Self, SeriesError> {
        Self::with_rig(n, 0.0)
    }

    /// Returns the thresholds for a rig with the given compliance, at least 0, relative to the secant compliance `u_c/μF_N` of the contact.
    ///
    /// # Errors
    /// The exponent is not above 0, or the compliance is negative or not finite.
    pub fn with_rig(n: f64, compliance: f64) -> Result<Self, SeriesError> {
        if !(compliance >= 0.0 && compliance.is_finite()) {
            return Err(SeriesError::Parameter {
                name: "compliance",
                range: "of at least 0",
                value: compliance,
            });
        }
        let (energy, slip) = rigid(n)?;
        Ok(Self {
            energy_ratio: Some(energy / (1.0 + compliance)),
            system_free_ratio: ratio(energy, slip),
            slip_ratio: Some(slip / (1.0 + compliance)),
        })
    }

    /// Returns the thresholds for a rig of unknown compliance: only the ratio B has a threshold.
    ///
    /// # Errors
    /// The exponent is not above 0.
    pub fn with_unknown_rig(n: f64) -> Result<Self, SeriesError> {
        let (energy, slip) = rigid(n)?;
        Ok(Self { energy_ratio: None, system_free_ratio: ratio(energy, slip), slip_ratio: None })
    }

    /// Returns the regime of a cycle: gross if all ratios reach their thresholds, partial if no ratio does, and mixed otherwise.
    ///
    /// The regime is stick if A is below [`Self::RESOLUTION`], also for loops with negative `E_d`.
    pub fn regime(&self, cycle: &Cycle) -> Regime {
        if cycle.energy_ratio().is_none_or(|a| a < Self::RESOLUTION) {
            return Regime::Stick;
        }
        let pairs = [
            (cycle.energy_ratio(), self.energy_ratio),
            (cycle.system_free_ratio(), self.system_free_ratio),
            (cycle.slip_ratio(), self.slip_ratio),
        ];
        let reached = pairs.iter().filter_map(|(value, limit)| Some((*value)? >= (*limit)?));
        let (gross, all) = reached.fold((0, 0), |(gross, all), yes| (gross + usize::from(yes), all + 1));
        match gross {
            // Without any ratio to compare, the regime is undecided.
            _ if all == 0 => Regime::Mixed,
            0 => Regime::Partial,
            _ if gross == all => Regime::Gross,
            _ => Regime::Mixed,
        }
    }

    /// Returns the common regime of all cycles, or mixed if they differ. Cycles in full stick count only if there are no others.
    ///
    /// Returns `None` without cycles.
    pub fn regime_of_run(&self, cycles: &[Cycle]) -> Option<Regime> {
        cycles.iter().map(|cycle| self.regime(cycle)).reduce(|a, b| match (a, b) {
            (Regime::Stick, other) | (other, Regime::Stick) => other,
            (a, b) if a == b => a,
            _ => Regime::Mixed,
        })
    }
}

/// Returns the thresholds of A and D for a rigid rig.
fn rigid(n: f64) -> Result<(f64, f64), SeriesError> {
    if n == f64::INFINITY {
        return Ok((0.0, 0.0));
    }
    check_positive("n", n)?;
    // This form of 2^{1/(n+1)} - 1 has no cancellation for large n.
    Ok((1.0 / (2.0 * n + 1.0), math::exp_m1(std::f64::consts::LN_2 / (n + 1.0))))
}

fn ratio(a: f64, d: f64) -> Option<f64> {
    (d > 0.0).then(|| a / d)
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_abs_diff_eq;

    #[test]
    fn the_sphere_has_the_published_thresholds() {
        // Handbook of Contact Mechanics, section 4.4: 0.2, 0.2599, 0.7695; 0.1333 and 0.0667 with a compliance of
        // 0.5 and 2 times the contact's secant.
        let sphere = Thresholds::of_profile(2.0).unwrap();
        assert_abs_diff_eq!(sphere.energy_ratio.unwrap(), 0.2, epsilon = 1e-15);
        assert_abs_diff_eq!(sphere.slip_ratio.unwrap(), 0.2599, epsilon = 5e-5);
        assert_abs_diff_eq!(sphere.system_free_ratio.unwrap(), 0.7695, epsilon = 5e-5);
        for (compliance, a) in [(0.5, 0.1333), (2.0, 0.0667)] {
            let rig = Thresholds::with_rig(2.0, compliance).unwrap();
            assert_abs_diff_eq!(rig.energy_ratio.unwrap(), a, epsilon = 5e-5);
            assert_eq!(rig.system_free_ratio, sphere.system_free_ratio);
        }
    }

    #[test]
    fn a_flat_punch_slips_as_soon_as_it_loses() {
        let flat = Thresholds::of_profile(f64::INFINITY).unwrap();
        assert_eq!((flat.energy_ratio, flat.slip_ratio), (Some(0.0), Some(0.0)));
        assert_eq!(flat.system_free_ratio, None);
        let sliding = Cycle::of_loop(&[1.0, 0.8, -1.0, -0.8], &[1.0, -1.0, -1.0, 1.0]).unwrap();
        assert_eq!(flat.regime(&sliding), Regime::Gross);
    }

    #[test]
    fn what_is_out_of_range_is_refused() {
        assert!(Thresholds::of_profile(0.0).is_err() && Thresholds::of_profile(f64::NAN).is_err());
        assert!(Thresholds::with_rig(2.0, -1.0).is_err() && Thresholds::with_rig(2.0, f64::NAN).is_err());
    }
}
