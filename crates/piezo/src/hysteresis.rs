//! Rate-independent hysteresis of a piezo stack: models of Prandtl–Ishlinskii and Bouc–Wen.
//!
//! * [`Plays`] is the Prandtl–Ishlinskii model, a weighted sum of play operators with an exact inverse; [`PlayBlock`] is its block.
//! * [`BoucWen`] is the Bouc–Wen model with one state; [`BoucWenBlock`] is its block.
//!
//! Input and output of the blocks are strokes. The blocks do not act back on the driver. The energy loss of a hysteresis loop is not part
//! of the model's energy balance.

mod block;
mod bouc_wen;
mod bouc_wen_block;
mod heading;
mod plays;

pub use block::PlayBlock;
pub use bouc_wen::{BoucWen, BoucWenError};
pub use bouc_wen_block::BoucWenBlock;
pub use plays::{Plays, PlaysError};
