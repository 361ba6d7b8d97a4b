//! Next laws of blocks at an event, and rates that may jump there.

use super::Located;
use super::watch::Fallen;
use crate::RunError;
use crate::equations::Equations;
use crate::event::Source;
use crate::model::Wire;
use crate::record::Record;
use crate::state::State;
use stickslip_stepper::Attempt;

impl<A: for<'e> Attempt<Equations<'e>>> Located<'_, A> {
    /// Changes the law of a block after a zero crossing.
    ///
    /// Does nothing if a jump at the same time has set a law to which that event function does not belong.
    pub(super) fn handle_block(
        &mut self,
        state: &mut State,
        (k, guard): (usize, usize),
        record: &mut dyn Record,
    ) -> Result<(), RunError> {
        let block = self.setting.model.blocks[k].block();
        if !block.guards(&state.blocks[k].law).contains(&guard) {
            return Ok(());
        }
        let (kind, law) = self.setting.plain(state).block_next(k, guard, state);
        state.blocks[k].law = law;
        self.note(state, Source::Block(k), kind, record);
        self.bounds.event(self.setting.model, state, (Source::Block(k), kind))
    }

    /// Lets blocks choose their laws again where the rates of their inputs may have jumped.
    ///
    /// Blocks are handled in order, because each reads only earlier ones. A block with a zero crossing keeps its new law, because its rate
    /// is zero within rounding. At a corner, or if an input has a new law, the rate has changed, and the block chooses again.
    pub(super) fn turn_blocks(
        &mut self,
        state: &mut State,
        corner: bool,
        record: &mut dyn Record,
    ) -> Result<(), RunError> {
        let mut bent = std::mem::take(&mut self.turning.bent);
        bent.clear();
        let (model, waveforms) = (self.setting.model, self.setting.model.waveforms.len());
        for (k, wired) in model.blocks.iter().enumerate() {
            let fell =
                self.watch.fired.iter().any(|fallen| matches!(fallen, Fallen::Block(own, _) if *own == k));
            let is_bent = |wire: &Wire| match wire {
                Wire::Signal(signal) => signal.checked_sub(waveforms).is_some_and(|before| bent[before]),
                Wire::Length(_) => false,
            };
            let reads_bent = wired.wires.iter().any(is_bent);
            let mut changes = fell || reads_bent;
            if (corner || !fell || reads_bent)
                && let Some((kind, law)) = self.setting.plain(state).block_turn(k, state)
            {
                state.blocks[k].law = law;
                self.note(state, Source::Block(k), kind, record);
                self.bounds.event(model, state, (Source::Block(k), kind))?;
                changes = true;
            }
            bent.push(changes);
        }
        self.turning.bent = bent;
        Ok(())
    }
}
