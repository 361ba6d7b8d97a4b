//! Frictional contact by the method of dimensionality reduction (MDR), quasi-static: the models contain neither time nor mass.
//!
//! The MDR replaces a contact by a row of independent springs. A spring touches when the indentation d exceeds its height h = g(x).
//! The spring sticks while its stretch u - p is below the friction limit κ(d-h). The rest position p is the displacement at which the
//! spring carries no tangential force. The function p(h) is the slip memory of the contact.
//!
//! A contact consists of constant data, the [`Interface`] (moduli, profile, friction coefficient), and a [`Memory`]. Two engines
//! implement the memory: [`Curve`] stores p(h) exactly, and [`Row`] stores one rest position per spring. Both engines implement
//! [`Tangential`]. Trial methods do not change the memory. Only `commit` does, once per accepted [`Segment`]. The trait [`Branching`]
//! gives access to smooth branches of the hysteresis.
//!
//! Reading order: [`Material`] and [`Pair`]; [`Profile`]; [`Interface`]; [`Move`] and [`Segment`]; [`Curve`] and [`Branch`]; [`Row`];
//! [`Engine`]; [`Law`]; [`FirstLoading`]; [`Fields`]; [`Words`] for serialization.
//!
//! Assumptions: half-spaces in contact over a small round area, no adhesion, Coulomb friction at every point. The theory is exact for
//! elastically similar bodies; [`Similarity`] estimates the error for others.
//!
//! Theory: Popov, Heß, Willert, *Handbook of Contact Mechanics* (2019), section 4.4 and chapter 11. Equation numbers are those of the
//! handbook. All quantities are in SI units.

mod breaking;
mod curve;
mod engine;
mod fields;
mod first_loading;
mod interface;
mod law;
mod material;
mod motion;
mod pressure;
mod profile;
mod quadrature;
mod restitution;
mod row;
mod similarity;
mod words;

pub use curve::{Branch, Course, Curve, Dragged, FixedDepthBranch, Lead, Legs, Merged, Since};
pub use engine::{Branching, Engine, Memory, Spring, SpringRow, Tangential};
pub use fields::{Field, Fields, FrictionMap, Zone, ZoneKind};
pub use first_loading::{FirstLoading, FirstLoadingError, NormalGiven, TangentialGiven};
pub use interface::{FrictionError, Growth, Interface};
pub use law::{GrowthRates, Guard, Law, Load, NEARNESS, Scale, Site, bands};
pub use material::{Material, MaterialError, Pair};
pub use motion::{Apex, ContactError, ContactState, Motion, Move, Outcome, Response, Segment, SpringState};
pub use profile::{Heights, Profile, ProfileError, RootSeries, RoughnessError, SelfAffine};
pub use quadrature::gauss;
pub use row::{Change, Lull, Row, Slack, Springs, SpringsError};
pub use similarity::Similarity;
pub use words::Words;
