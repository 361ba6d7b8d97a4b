//! Fretting regimes: thresholds between partial and gross slip of a profile in its rig.

use crate::Cycle;
use crate::series::{SeriesError, check_positive};

/// The values of A, B and D at the limit between partial and gross slip.
///
/// For a profile f ~ rⁿ on a rigid rig A = 1/(2n+1), D = 2^{1/(n+1)} - 1, B = A/D; sphere (n = 2) 0.2, 0.2599,
/// 0.7695. A compliance in series stretches δ\* alone: A and D fall by 1 + `C/(u_c/μF_N)`, B stays.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Thresholds {
    /// A = `E_d/E_t` at the limit; none with an unknown rig.
    pub energy_ratio: Option<f64>,
    /// B = `E_d/(4Q*δ₀)` at the limit; none for a flat punch, which has no loop there.
    pub system_free_ratio: Option<f64>,
    /// D = δ₀/δ\* at the limit; none with an unknown rig.
    pub slip_ratio: Option<f64>,
}

/// How a contact slips over its cycles.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Regime {
    /// No loss above the resolution: every point sticks, or the cycle does not move at all.
    Stick,
    /// The rim slips, the centre sticks.
    Partial,
    /// The criteria do not agree (the loop lies at the limit), or partial and gross cycles follow each other.
    Mixed,
    /// The whole contact slides in every cycle.
    Gross,
}

impl Regime {
    /// Its word.
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
    /// Energy ratio A below which a loop counts as closed: above the noise of a good rig and of a simulation's
    /// tolerance, below the loop of a sphere at a hundredth of its gross-slip amplitude.
    pub const RESOLUTION: f64 = 5e-4;

    /// Thresholds of the profile exponent n (f ~ rⁿ, above 0; infinite: flat punch) on a rigid rig.
    ///
    /// # Errors
    /// An exponent that is not above 0.
    pub fn of_profile(n: f64) -> Result<Self, SeriesError> {
        Self::with_rig(n, 0.0)
    }

    /// Thresholds on a rig whose compliance is `compliance` times the contact's secant `u_c/μF_N`, at least 0.
    ///
    /// # Errors
    /// An exponent that is not above 0, a compliance that is negative or not finite.
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

    /// Thresholds on a rig of unknown compliance: B alone remains.
    ///
    /// # Errors
    /// An exponent that is not above 0.
    pub fn with_unknown_rig(n: f64) -> Result<Self, SeriesError> {
        let (energy, slip) = rigid(n)?;
        Ok(Self { energy_ratio: None, system_free_ratio: ratio(energy, slip), slip_ratio: None })
    }

    /// The regime of one cycle: gross where every defined criterion reaches its threshold, partial where none
    /// does, mixed in between; stick below [`Self::RESOLUTION`]. A loop of the wrong sign counts as stick.
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
            // Nothing to compare (a loop that never crosses Q = 0 on an unknown rig) decides nothing.
            _ if all == 0 => Regime::Mixed,
            0 => Regime::Partial,
            _ if gross == all => Regime::Gross,
            _ => Regime::Mixed,
        }
    }

    /// The regime of a run: that of its cycles where they agree (sticking cycles aside), else mixed. None for no
    /// cycles.
    pub fn regime_of_run(&self, cycles: &[Cycle]) -> Option<Regime> {
        cycles.iter().map(|cycle| self.regime(cycle)).reduce(|a, b| match (a, b) {
            (Regime::Stick, other) | (other, Regime::Stick) => other,
            (a, b) if a == b => a,
            _ => Regime::Mixed,
        })
    }
}

/// A and D of a rigid rig.
fn rigid(n: f64) -> Result<(f64, f64), SeriesError> {
    if n == f64::INFINITY {
        return Ok((0.0, 0.0));
    }
    check_positive("n", n)?;
    // 2^{1/(n+1)} - 1 without cancellation for large n.
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
