//! Frictional contact by the method of dimensionality reduction (MDR): knows no time and no mass.
//!
//! A contact is constant data, an [`Interface`] (effective moduli, profile, friction), and a memory of where
//! it has been. Two engines keep that memory: the exact [`Curve`] and the handbook's [`Row`] of springs. Both
//! obey one contract: `trial` borrows shared and leaves no trace, memory moves only in `commit`, once per
//! accepted [`Segment`]. [`Memory`] is either of them, chosen when a model is built; that contract is [`Tangential`], and an
//! engine whose hysteresis has smooth branches says so by [`Branching`].
//!
//! In reading order: [`Material`] and [`Pair`]; [`Profile`]; [`Interface`]; [`Move`], [`Segment`] and what
//! comes back; [`Curve`] with its [`Branch`]es; [`Row`]; [`Engine`]; [`FirstLoading`] for a designer's
//! questions; [`Fields`] of a moment; [`Words`] of those who keep memories.
//!
//! Forces are those of half-spaces in contact over a small round area, without adhesion, under Coulomb's law at every point;
//! between elastically similar bodies they are exact, between others as good as the similarity ([`Similarity`]).
//!
//! Theory: Popov, Heß, Willert, *Handbook of Contact Mechanics* (2019), section 4.4 and chapter 11; equation
//! numbers are the handbook's. SI units throughout.

mod curve;
mod engine;
mod fields;
mod first_loading;
mod interface;
mod material;
mod motion;
mod pressure;
mod profile;
mod quadrature;
mod row;
mod similarity;
mod words;

pub use curve::{Branch, Course, Curve, Dragged, FixedDepthBranch, Legs, Merged};
pub use engine::{Branching, Engine, Memory, Spring, SpringRow, Tangential};
pub use fields::{Field, Fields, FrictionMap, Zone, ZoneKind};
pub use first_loading::{FirstLoading, FirstLoadingError, NormalGiven, TangentialGiven};
pub use interface::{FrictionError, Interface};
pub use material::{Material, MaterialError, Pair};
pub use motion::{
    Apex, ContactError, ContactState, Motion, Move, Outcome, Response, Segment, SpringState, Timed,
};
pub use profile::{Profile, ProfileError, RootSeries, RoughnessError, SelfAffine};
pub use row::{Change, Lull, Row, Slack, Springs, SpringsError};
pub use similarity::Similarity;
pub use words::Words;
