//! Hysteresis of a stack between the stroke that its voltage asks for and the one it makes.
//!
//! Two laws, both independent of the rate: [`Plays`] of Prandtl and Ishlinskii, a sum of play operators with an exact inverse,
//! and [`BoucWen`], one state with loops of another shape. Either stands in a scene as a block: [`PlayBlock`],
//! [`BoucWenBlock`]. They are one-way: what they make of a voltage does not come back to the driver, and they make no
//! claim about energy. The heat of a loop, tan δ times the energy that goes to and fro, is not in the books of a scene, and no
//! stack warms itself.

mod block;
mod bouc_wen;
mod bouc_wen_block;
mod heading;
mod plays;

pub use block::PlayBlock;
pub use bouc_wen::{BoucWen, BoucWenError};
pub use bouc_wen_block::BoucWenBlock;
pub use plays::{Plays, PlaysError};
