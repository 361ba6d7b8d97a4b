//! Stress and displacement under a contact as it stands: p(r), τ(r), u(r), the slip ring and the springs' line loads.
//!
//! A contact pressed without friction from a height h₁ to h₂ adds to the pressure and to the surface's displacement
//!
//! * p = E\*P, P(r; h) = (1/π) ∫ᵣˣ g'(ξ)/√(ξ²-r²) dξ, g(x) = h (4.34),
//! * w(r; h) = h - f(r) inside x, (2/π) ∫₀ˣ arcsin(ξ/r) dg outside.
//!
//! A piece of the memory curve from h₁ to h₂ of slope k is k times that, in tangential direction: so
//! τ = G\* Σ k [P(r; h₂) - P(r; h₁)] and u = Σ k [w(r; h₂) - w(r; h₁)], which is superposition (4.32, 4.35) of as many normal
//! contacts as the history has left corners. Nothing is differentiated, so that nothing is unstable where stick and slip meet:
//! the repeated numerical transforms of q(x) are, and need care there (Li, Forsbach, Benad, Facta Universitatis 17(1), 2019).
//!
//! Closed forms for power laws and the flat punch, quadrature with an estimate of its error for every other profile.

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

/// The fields of a contact at a moment. Of a profile that has a shape in three dimensions.
///
/// A row of springs is taken as the curve through its anchors, straight between them: what its cells lack is in F_x.
#[derive(Debug, Clone)]
pub struct Fields<'a> {
    law: &'a Interface,
    kernel: Kernel<'a>,
    /// From the centre to the edge; none while the contact is open.
    pieces: Vec<Piece>,
    apex: Apex,
    /// Radius of the contact, m.
    radius: f64,
    /// Of the zone inside which no spring is at its limit, m.
    stick_radius: f64,
    state: ContactState,
}

/// The fields at one distance from the axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Field {
    /// Distance r from the axis, m.
    pub r: f64,
    /// Pressure p, Pa; infinite at a tip and at a worn edge, without bound towards the edge of a flat punch, from which on it
    /// is 0.
    pub pressure: f64,
    /// Shear stress τ on the second body, Pa, along the slide.
    pub shear: f64,
    /// Displacement u of the surface along the slide, that of both bodies against each other, m.
    pub displacement: f64,
    /// Local slip: how far the indenter's surface has slid over the other body's, m, counted from what the centre has slid; 0 in
    /// the centre, also in gross slip. Outside the contact the way between the surfaces.
    pub slip: f64,
    /// Displacement of the surface along the normal, that of both bodies together, m.
    pub deflection: f64,
    /// Whether the place is open, sticks or slips.
    pub state: SpringState,
    /// Estimated error of `pressure` and `shear`, Pa, of `displacement` and `slip`, m; 0 of closed forms.
    pub error: [f64; 2],
}

impl<'a> Fields<'a> {
    /// The fields of a contact; none of a list of springs and of a normal law, which have no shape in three dimensions.
    ///
    /// An open contact has fields, which are 0.
    pub fn of(law: &'a Interface, memory: &Memory) -> Option<Self> {
        let kernel = Kernel::of(law.profile())?;
        let apex = memory.apex();
        let (pieces, _) = pieces::of(law, memory);
        let Outcome { state, stick_radius, .. } = memory.preview(law, apex);
        let radius = law.profile().radius(apex.d);
        Some(Self { law, kernel, pieces, apex, radius, stick_radius, state })
    }

    /// Contact radius a, m; 0 while open.
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// Radius c inside which no spring is at its limit, m.
    pub fn stick_radius(&self) -> f64 {
        self.stick_radius
    }

    /// State of the whole contact.
    pub fn state(&self) -> ContactState {
        self.state
    }

    /// Where the contact stands.
    pub fn apex(&self) -> Apex {
        self.apex
    }

    /// The fields at a distance r ≥ 0 from the axis, m.
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

    /// Pressure at r, Pa, and its error.
    fn pressure(&self, r: f64) -> (f64, f64) {
        let (p, error) = self.kernel.pressure(self.edge(), r);
        (self.law.normal_modulus() * p, self.law.normal_modulus() * error)
    }

    /// Shear stress at r, Pa, and its error, `pressure` at hand.
    ///
    /// In the slip ring it is ±μp to the last bit: what is at its limit is one piece, from which nothing is taken.
    fn shear(&self, r: f64, pressure: f64) -> (f64, f64) {
        let limit = self.law.friction() * self.law.normal_modulus();
        let (mut sum, mut error) = (0.0, 0.0);
        // Of the rim last asked for: every other one is the outer rim of one piece and the inner one of the next.
        let mut outer = None;
        for piece in self.pieces.iter().rev() {
            if piece.to.x <= r {
                break;
            }
            // Nothing times an infinite pressure is nothing: springs that were never moved carry nothing.
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

    /// Displacement of the surface at r and slip there, m, and their error.
    fn displacement(&self, r: f64) -> ([f64; 2], f64) {
        let profile = self.law.profile();
        let (mut sum, mut slip, mut error) = (0.0, 0.0, 0.0);
        let mut inner = None;
        for piece in &self.pieces {
            if piece.slope == 0.0 {
                inner = None;
                continue;
            }
            // Inside both rims the gap drops out.
            let (step, off) = if r <= piece.from.x {
                (piece.to.h - piece.from.h, 0.0)
            } else {
                let to = self.kernel.deflection(profile, piece.to, r);
                let from = inner.unwrap_or_else(|| self.kernel.deflection(profile, piece.from, r));
                inner = Some(to);
                (to.0 - from.0, to.1 + from.1)
            };
            sum += piece.slope * step;
            // Not as the rest of u: where nothing has slipped it is nothing to the last bit.
            slip += piece.slope * (piece.to.h - piece.from.h - step);
            error += (piece.slope * off).abs();
        }
        ([sum, slip], error)
    }

    /// Whether the place at r is open, sticks or slips.
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

    /// The edge of the contact.
    fn edge(&self) -> Rim {
        Rim { h: self.apex.d.max(0.0), x: self.radius }
    }
}
