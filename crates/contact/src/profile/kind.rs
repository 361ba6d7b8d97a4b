//! Common interface of all kinds of profiles.

/// Interface of one kind of profile. Heights h and radii a are above 0 here; [`super::Profile`] handles other arguments for all kinds.
pub(super) trait Kind {
    /// Returns the reduced stiffness m(h), m.
    fn reduced_stiffness(&self, h: f64) -> f64;

    /// Returns the reduced force M(h), m².
    fn reduced_force(&self, h: f64) -> f64;

    /// Returns the reduced energy N(h), m³.
    fn reduced_energy(&self, h: f64) -> f64;

    /// Returns the height at which M > 0 (m²) is reached, m.
    fn height_of_reduced_force(&self, force: f64) -> f64;

    /// Returns g(a), m: the lowest height with the contact radius a; infinite if no height has this radius.
    fn depth(&self, a: f64) -> f64;

    /// Returns dg/da; 0 where it is not defined.
    fn depth_slope(&self, a: f64) -> f64;

    /// Returns the gap f(r), m, r ≥ 0; `None` where there is no gap.
    fn gap(&self, _r: f64) -> Option<f64> {
        None
    }

    /// Returns the positions x > 0, m, ascending, at which g or a derivative of g is not smooth.
    fn borders(&self) -> &[f64] {
        &[]
    }

    /// Returns where the pressure is largest; `None` without a shape in three dimensions.
    fn peak(&self) -> Option<Peak> {
        None
    }

    /// Returns ∫₀ᵃ g'/x dx, if there is a closed form.
    fn middle_slope_integral(&self, _a: f64) -> Option<f64> {
        None
    }

    /// Returns whether each contact radius belongs to exactly one indentation.
    fn is_strictly_convex(&self) -> bool;

    /// Returns whether m jumps while the indentation grows.
    fn has_kinks(&self) -> bool {
        false
    }

    /// Returns whether m has a kink, or its derivative a square-root singularity, at a height above 0.
    fn has_bends(&self) -> bool {
        false
    }

    /// Returns the exponent p of M ∝ hᵖ at small h; 1 if a finite width touches at h = 0.
    fn first_power(&self) -> f64 {
        1.0
    }

    /// Returns the exponent n of a power law.
    fn exponent(&self) -> Option<f64> {
        None
    }

    /// Returns the largest height, m, if there is a limit.
    fn reach(&self) -> Option<f64> {
        None
    }

    /// Returns the radius of a flat punch, m.
    fn punch(&self) -> Option<f64> {
        None
    }
}

/// Location of the largest normal pressure.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Peak {
    /// At a tip or an edge, where the pressure is unbounded.
    Unbounded,
    /// In the centre, for a power law with this exponent n, 1 < n ≤ 2.
    Middle(f64),
    /// Between centre and edge.
    Between,
}
