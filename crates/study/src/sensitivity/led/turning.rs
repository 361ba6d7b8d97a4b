//! What is seen where the slides of contacts turn.
//!
//! A run that is told to go as far as to a turn stands there with a velocity of which rounding leaves a root, and its variation goes on
//! from that: turns are looked at where the run passes them. Where what presses a contact varies its slide turns without a law that ends,
//! and the run is told to stand there.

use super::told::Told;
use stickslip_drive::{Event, Record, State, Stride, Variation};
use stickslip_run::Extreme;

/// Moments that differ by less than this, as a part of them, are one: the run with the variation passes the turns of the run without.
const SAME: f64 = 1e-12;

/// A turn of a contact: the force there, and how this and the limit of friction, N, change by each quantity.
pub(super) struct Turn {
    contact: usize,
    /// Whether what presses the contact varies.
    pub(super) varies: bool,
    pub(super) extreme: Extreme,
    pub(super) moved: Vec<Option<[f64; 2]>>,
}

/// Both turns of the last swing of each figure that is one.
pub(super) struct Turns {
    swings: Vec<Option<[Turn; 2]>>,
    count: usize,
}

impl Turns {
    pub(super) fn of(told: &[Told], swings: &[Option<[Extreme; 2]>], count: usize) -> Self {
        let swing = |(told, swing): (&Told, &Option<[Extreme; 2]>)| match (told, swing) {
            (Told::Ringing { contact, varies }, Some(swing)) => {
                let turn = |extreme| Turn { contact: *contact, varies: *varies, extreme, moved: Vec::new() };
                Some(swing.map(turn))
            }
            _ => None,
        };
        Self { swings: told.iter().zip(swings).map(swing).collect(), count }
    }

    /// The swing of figure `f`.
    pub(super) fn swing(&self, f: usize) -> Option<&[Turn; 2]> {
        self.swings.get(f)?.as_ref()
    }

    /// Moments at which the run is to stand, s, ascending.
    pub(super) fn stands(&self) -> Vec<f64> {
        let turns = self.swings.iter().flatten().flatten();
        let mut moments: Vec<f64> = turns.filter(|turn| turn.varies).map(|turn| turn.extreme.t).collect();
        moments.sort_by(f64::total_cmp);
        moments
    }

    /// Looks at turns where the run is: at those of contacts that are pressed by what varies where it stands, at others where it passes
    /// them.
    pub(super) fn look(&mut self, variation: &Variation<'_>, state: &State, stands: bool) {
        let t = state.time();
        for turn in self.swings.iter_mut().flatten().flatten() {
            if turn.varies == stands && (turn.extreme.t - t).abs() <= SAME * t {
                turn.moved = (0..self.count).map(|j| variation.turn(state, turn.contact, j)).collect();
            }
        }
    }
}

/// A variation that is looked at where its run passes turns.
pub(super) struct Turning<'a, 'm> {
    pub(super) variation: &'a mut Variation<'m>,
    pub(super) turns: &'a mut Turns,
}

impl Record for Turning<'_, '_> {
    fn row(&mut self, values: &[f64]) {
        self.variation.row(values);
    }
    fn event(&mut self, event: &Event, values: &[f64]) {
        self.variation.event(event, values);
    }
    fn wants_events(&self) -> bool {
        self.variation.wants_events()
    }
    fn leaves(&mut self, state: &State) {
        self.variation.leaves(state);
        self.turns.look(self.variation, state, false);
    }
    fn enters(&mut self, state: &State) {
        self.variation.enters(state);
    }
    fn strides(&self) -> bool {
        self.variation.strides()
    }
    fn stride(&mut self, stride: &mut dyn Stride) {
        self.variation.stride(stride);
    }
}
