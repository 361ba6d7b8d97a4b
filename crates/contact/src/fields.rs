//! Stresses and displacements at the contact surface: pressure p(r), shear stress τ(r), displacement u(r) and slip.
//!
//! A frictionless contact that is pressed to the height h, with radius x = g⁻¹(h), has
//!
//! * the pressure p = E\*P, P(r; h) = (1/π) ∫ᵣˣ g'(ξ)/√(ξ²-r²) dξ (4.34),
//! * the surface displacement w(r; h) = h - f(r) inside x and (2/π) ∫₀ˣ arcsin(ξ/r) dg outside.
//!
//! A piece of the slip memory from h₁ to h₂ with slope k contributes k times the difference of two such contacts. The superposition
//! (4.32, 4.35) is τ = G\* Σ k [P(r; h₂) - P(r; h₁)] and u = Σ k [w(r; h₂) - w(r; h₁)]. No numerical differentiation occurs, so the
//! result is stable at the border of stick and slip. Numerical transforms of q(x) need care there (Li, Forsbach, Benad, Facta
//! Universitatis 17(1), 2019).
//!
//! Power laws and the flat punch have closed forms. Other profiles use quadrature with an error estimate.

mod dissipation;
mod kernel;
mod pieces;
mod power;
mod smooth;
mod zone;

pub use dissipation::FrictionMap;
pub use zone::{Zone, ZoneKind};

use crate::{Apex, ContactState, Interface, Memory, Outcome, SpringState};
use kernel::{Kernel, Rim};
use pieces::Piece;

/// Stresses and displacements of a contact, for profiles with a shape in three dimensions.
///
/// A row of springs is treated as a curve that is linear between its rest positions.
#[derive(Debug, Clone)]
pub struct Fields<'a> {
    law: &'a Interface,
    kernel: Kernel<'a>,
    /// Pieces of the slip memory from the centre to the edge; empty for an open contact.
    pieces: Vec<Piece>,
    apex: Apex,
    /// Contact radius, m.
    radius: f64,
    /// Stick radius, m.
    stick_radius: f64,
    state: ContactState,
}

/// Stresses and displacements at one distance from the axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Field {
    /// Distance r from the axis, m.
    pub r: f64,
    /// Pressure p, Pa. The pressure is infinite at a sharp tip and at the border of a truncated flat. The pressure is unbounded towards the
    /// edge of a flat punch.
    pub pressure: f64,
    /// Shear stress τ on the second body in sliding direction, Pa.
    pub shear: f64,
    /// Relative tangential displacement u of the two surfaces, m.
    pub displacement: f64,
    /// Local slip relative to the slip of the centre, m; 0 in the centre.
    ///
    /// Inside the contact, slip is the relative sliding distance of the two surfaces. Outside the contact, slip is their relative
    /// displacement.
    pub slip: f64,
    /// Relative normal displacement of the two surfaces, m.
    pub deflection: f64,
    /// State at this radius: open, stick or slip.
    pub state: SpringState,
    /// Error estimates: of `pressure` and `shear`, Pa, and of `displacement` and `slip`, m; 0 for closed forms.
    pub error: [f64; 2],
}

impl<'a> Fields<'a> {
    /// Creates the fields of a contact. Returns `None` for a list of springs and a normal law, which define no shape in three dimensions.
    ///
    /// The fields of an open contact are 0.
    pub fn of(law: &'a Interface, memory: &Memory) -> Option<Self> {
        let kernel = Kernel::of(law.profile())?;
        let apex = memory.apex();
        let (pieces, _) = pieces::of(law, memory);
        let Outcome { state, stick_radius, .. } = memory.preview(law, apex);
        let radius = law.profile().radius(apex.d);
        Some(Self { law, kernel, pieces, apex, radius, stick_radius, state })
    }

    /// Returns the contact radius a, m; 0 for an open contact.
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// Returns the stick radius c, m; all springs inside this radius stick.
    pub fn stick_radius(&self) -> f64 {
        self.stick_radius
    }

    /// Returns the state of the whole contact.
    pub fn state(&self) -> ContactState {
        self.state
    }

    /// Returns the current indentation and displacement.
    pub fn apex(&self) -> Apex {
        self.apex
    }

    /// Returns the fields at a distance r ≥ 0 from the axis, m.
    pub fn at(&self, r: f64) -> Field {
        let (pressure, pressure_error) = self.pressure(r);
        let (shear, shear_error) = self.shear(r, pressure);
        let ([displacement, slip], error) = self.displacement(r);
        let deflection = self.kernel.deflection(self.law.profile(), self.edge(), r).0;
        Field {
            r,
            pressure,
            shear,
            displacement,
            slip,
            deflection,
            state: self.state_at(r),
            error: [pressure_error.max(shear_error), error],
        }
    }

    /// Returns the pressure at r, Pa, and its error.
    fn pressure(&self, r: f64) -> (f64, f64) {
        let (p, error) = self.kernel.pressure(self.edge(), r);
        (self.law.normal_modulus() * p, self.law.normal_modulus() * error)
    }

    /// Returns the shear stress at r, Pa, and its error, for a given `pressure`.
    ///
    /// In the slip ring the result is exactly ±μp.
    fn shear(&self, r: f64, pressure: f64) -> (f64, f64) {
        let limit = self.law.friction() * self.law.normal_modulus();
        let (mut sum, mut error) = (0.0, 0.0);
        // The outer rim of a piece is the inner rim of the next one, so that its pressure is reused.
        let mut outer = None;
        for piece in self.pieces.iter().rev() {
            if piece.to.x <= r {
                break;
            }
            // A piece without slope carries no shear, even where the pressure is infinite.
            if piece.share == 0.0 || limit == 0.0 {
                outer = None;
                continue;
            }
            let outermost = piece.to.h == self.apex.d;
            if outermost && piece.from.x <= r {
                return (self.law.friction() * piece.share * pressure, 0.0);
            }
            let upper = outer.unwrap_or_else(|| self.kernel.pressure(piece.to, r));
            let lower = self.kernel.pressure(piece.from, r);
            let (p, off) = if upper.0 < f64::INFINITY {
                (upper.0 - lower.0, upper.1 + lower.1)
            } else {
                self.kernel.pressure_between(piece.from, piece.to, r)
            };
            sum += piece.share * p;
            error += (piece.share * off).abs();
            outer = Some(lower);
        }
        (limit * sum, limit * error)
    }

    /// Returns displacement and slip at r, m, and their error.
    fn displacement(&self, r: f64) -> ([f64; 2], f64) {
        let profile = self.law.profile();
        let (mut sum, mut slip, mut error) = (0.0, 0.0, 0.0);
        let mut inner = None;
        for piece in &self.pieces {
            if piece.slope == 0.0 {
                inner = None;
                continue;
            }
            // Inside both rims the difference does not contain the gap.
            let (step, off) = if r <= piece.from.x {
                (piece.to.h - piece.from.h, 0.0)
            } else {
                let to = self.kernel.deflection(profile, piece.to, r);
                let from = inner.unwrap_or_else(|| self.kernel.deflection(profile, piece.from, r));
                inner = Some(to);
                (to.0 - from.0, to.1 + from.1)
            };
            sum += piece.slope * step;
            // Computed separately from u, so that the slip is exactly 0 where nothing has slipped.
            slip += piece.slope * (piece.to.h - piece.from.h - step);
            error += (piece.slope * off).abs();
        }
        ([sum, slip], error)
    }

    /// Returns whether the contact is open, sticks or slips at r.
    fn state_at(&self, r: f64) -> SpringState {
        if r >= self.radius || self.state == ContactState::Open {
            return SpringState::Open;
        }
        match self.pieces.last() {
            Some(top) if r >= self.stick_radius && self.state != ContactState::Stick => {
                if top.slope < 0.0 {
                    SpringState::SlipBackward
                } else {
                    SpringState::SlipForward
                }
            }
            _ => SpringState::Stick,
        }
    }

    /// Returns the edge of the contact.
    fn edge(&self) -> Rim {
        Rim { h: self.apex.d.max(0.0), x: self.radius }
    }
}
