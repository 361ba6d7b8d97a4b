//! What a contact asks of a kind of profile.

use super::Foundation;

/// One kind of profile, each in a file of its own. Heights h and radii a are above 0 here: [`super::Profile`] answers for
/// the rest, once for all kinds.
pub(super) trait Kind {
    /// m(h), m.
    fn reduced_stiffness(&self, h: f64) -> f64;

    /// M(h), m².
    fn reduced_force(&self, h: f64) -> f64;

    /// N(h), m³.
    fn reduced_energy(&self, h: f64) -> f64;

    /// Height at which M > 0 (m²) is reached, m.
    fn height_of_reduced_force(&self, force: f64) -> f64;

    /// Height of first touch, m.
    fn lowest(&self) -> f64 {
        0.0
    }

    /// g(a), m; the lowest of several, infinite where none reaches a.
    fn depth(&self, a: f64) -> f64;

    /// dg/da; 0 where it is not defined.
    fn depth_slope(&self, a: f64) -> f64;

    /// f(r), m, r ≥ 0; none where there is no gap.
    fn gap(&self, r: f64) -> Option<f64>;

    /// Places x > 0, m, ascending, at which g or a derivative of g is not smooth.
    fn borders(&self) -> &[f64] {
        &[]
    }

    /// Where its pressure is largest; none without a shape in three dimensions.
    fn peak(&self) -> Option<Peak>;

    /// ∫₀ᵃ g'/x dx, where there is a closed form.
    fn middle_slope_integral(&self, _a: f64) -> Option<f64> {
        None
    }

    /// Whether each contact radius belongs to one indentation only.
    fn is_strictly_convex(&self) -> bool;

    /// Whether m jumps as the indentation grows.
    fn has_kinks(&self) -> bool {
        false
    }

    /// Whether m bends, or its slope has a root, at a height above 0.
    fn has_bends(&self) -> bool {
        false
    }

    /// Power p of h with which M begins: 1 where a width touches at once.
    fn first_power(&self) -> f64 {
        1.0
    }

    /// Exponent n, of a power law.
    fn exponent(&self) -> Option<f64> {
        None
    }

    /// Largest height for which it stands, m, if there is a limit.
    fn reach(&self) -> Option<f64> {
        None
    }

    /// Radius of a flat punch, m.
    fn punch(&self) -> Option<f64> {
        None
    }

    /// Its springs, where it is given by them.
    fn as_foundation(&self) -> Option<&Foundation> {
        None
    }
}

/// Where the normal pressure of a contact is largest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Peak {
    /// At a tip or an edge, without bound.
    Unbounded,
    /// In the middle: the power law with this exponent n, 1 < n ≤ 2.
    Middle(f64),
    /// Somewhere between middle and edge.
    Between,
}
