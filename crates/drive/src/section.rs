//! Poincaré section: a fixed time in every drive period, and the coordinates of a state at that time.
//!
//! The Poincaré map leads from a state at a [`Section`] to the state one period later. Coordinates of a section are positions, velocities,
//! states of blocks, and slip memories of contacts that are not in gross slip. Coordinates of a slip memory are the heights of its
//! breakpoints, and the slopes of pieces formed in full stick. Positions are relative to the drift: the distance travelled is not a
//! coordinate. Memories of blocks and of spring rows are carried over without being coordinates.

mod adoption;
mod drift;
mod legs;

use crate::equations::Equations;
use crate::model::Binding;
use crate::scene::Axis;
use crate::state::Counts;
use crate::{Model, State};
use drift::Drift;
use stickslip_contact::Memory;

/// Largest number of coordinates from slip memories. If more are needed, none is used, and the memories are carried over.
const MOST_OF_MEMORIES: usize = 24;

impl Model {
    /// Whether no coordinate is free, so that contacts follow a prescribed path.
    #[must_use]
    pub fn is_walk(&self) -> bool {
        self.free.is_empty()
    }
}

impl State {
    /// Whether the slip memory of a contact has no effect, because the contact is open, in gross slip or frictionless.
    #[must_use]
    pub fn has_given_way(&self, model: &Model, index: usize) -> bool {
        let contact = model.contacts.get(index).zip(self.modes.get(index));
        contact.is_none_or(|(contact, mode)| contact.inert || mode.has_given_way(contact))
    }
}

/// Coordinate of a state at a section.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Unknown {
    /// Position of a free coordinate, m or rad.
    Place(usize),
    /// Velocity of a free coordinate, m/s or rad/s.
    Speed(usize),
    /// State of a block by its index among the states of all blocks, in its unit.
    Own(usize),
    /// Height of a breakpoint of a slip memory, m; by index of the contact and of the breakpoint from the centre.
    Height(usize, usize),
    /// Slope of a memory piece formed in full stick; by index of the contact and of the piece from the centre.
    Slope(usize, usize),
}

/// Poincaré section of a periodic drive at a time in the period.
#[derive(Debug, Clone)]
pub struct Section<'m> {
    model: &'m Model,
    /// Reference state at the section.
    base: State,
    drifts: Vec<Drift>,
    unknowns: Vec<Unknown>,
    carried: Vec<usize>,
}

impl<'m> Section<'m> {
    /// Returns the section at the time of a state whose slip memories are up to date ([`Run::stop`](crate::Run::stop)).
    #[must_use]
    pub fn new(model: &'m Model, mut base: State) -> Self {
        base.come_back(model);
        base.carry_over(model, model.layout());
        base.underway = None;
        let drifts = drift::drifts(model);
        let mut section = Self { model, base, drifts, unknowns: Vec::new(), carried: Vec::new() };
        section.count_unknowns();
        section
    }

    fn count_unknowns(&mut self) {
        let (model, layout) = (self.model, self.model.layout());
        let places = (0..layout.free).filter(|i| self.drifts.iter().all(|drift| drift.pivot != *i));
        let places = places.map(Unknown::Place);
        let speeds = (0..layout.free).map(Unknown::Speed);
        let own = model.blocks.iter().zip(&self.base.blocks).flat_map(|(block, standing)| {
            let depends = |k: &usize| block.block().depends(standing.law, *k);
            (0..block.count()).filter(depends).map(|k| Unknown::Own(block.first + k))
        });
        self.unknowns = places.chain(speeds).chain(own).collect();
        let mut of_memories = Vec::new();
        for (c, contact) in model.contacts.iter().enumerate() {
            if contact.inert {
                continue;
            }
            match &self.base.memories[c] {
                Memory::Curve(curve) if !contact.balanced => {
                    of_memories.extend(legs::unknowns(contact, c, &curve.legs()));
                }
                Memory::Curve(_) => self.carried.push(c),
                Memory::Row(_) if self.base.modes[c].has_given_way(contact) => {}
                Memory::Row(_) => self.carried.push(c),
            }
        }
        if of_memories.len() <= MOST_OF_MEMORIES {
            self.unknowns.extend(of_memories);
        } else {
            let all = of_memories.iter().map(|unknown| match unknown {
                Unknown::Height(c, _) | Unknown::Slope(c, _) => *c,
                Unknown::Place(_) | Unknown::Speed(_) | Unknown::Own(_) => 0,
            });
            self.carried.extend(all);
            self.carried.sort_unstable();
            self.carried.dedup();
        }
    }

    /// Returns the reference state.
    #[must_use]
    pub fn base(&self) -> &State {
        &self.base
    }

    /// Returns the coordinates of the section.
    #[must_use]
    pub fn unknowns(&self) -> &[Unknown] {
        &self.unknowns
    }

    /// Returns the indices of contacts whose slip memories are carried over and are not coordinates of the section.
    #[must_use]
    pub fn carried(&self) -> &[usize] {
        &self.carried
    }

    /// Returns the natural scale of each coordinate, in its unit.
    #[must_use]
    pub fn scales(&self) -> Vec<f64> {
        let own: Vec<f64> = self.model.blocks.iter().flat_map(|block| block.states.scales.clone()).collect();
        let scale = |unknown: &Unknown| match *unknown {
            Unknown::Place(i) => self.model.free[i].scale.0,
            Unknown::Speed(i) => self.model.free[i].scale.1,
            Unknown::Own(k) => own[k],
            Unknown::Height(c, _) => self.model.contacts[c].natural.depth,
            Unknown::Slope(c, _) => self.model.contacts[c].interface.stick_slope(),
        };
        self.unknowns.iter().map(scale).collect()
    }

    /// Returns the natural length of each free coordinate, m or rad.
    #[must_use]
    pub fn lengths(&self) -> Vec<f64> {
        self.model.free.iter().map(|free| free.scale.0).collect()
    }

    /// Returns the number of drift directions. Motion along a drift direction changes positions only.
    #[must_use]
    pub fn drifts(&self) -> usize {
        self.drifts.len()
    }

    /// Returns the name of a body that may drift along z or in pitch, and the axis. None if bodies drift along x only.
    #[must_use]
    pub fn drifts_away(&self) -> Option<(String, &'static str)> {
        let free = self.model.free.iter().enumerate().filter(|(_, free)| free.axis != Axis::X);
        let mut away = free.filter(|(i, _)| self.drifts.iter().any(|drift| drift.shape[*i] != 0.0));
        away.next().map(|(_, free)| {
            let axis = if free.axis == Axis::Z { "z" } else { "pitch" };
            (self.model.bodies[free.body].name.clone(), axis)
        })
    }

    /// Returns the displacement of body `index` along `axis`, m or rad, from the displacements `way` of all free coordinates. None if this
    /// coordinate of the body is not free.
    #[must_use]
    pub fn of_body(&self, way: &[f64], index: usize, axis: Axis) -> Option<f64> {
        match self.model.bodies.get(index)?.bindings[axis as usize] {
            Binding::Free(i) => way.get(i).copied(),
            Binding::Held(_) | Binding::Driven(_) => None,
        }
    }

    /// Returns the slip of contact `c` along x for the displacements `way` of all free coordinates, m. Under a constant normal load, net
    /// slip over many periods requires gross slip. Under a varying normal load, partial slip may cause a drift, and the function returns 0.
    #[must_use]
    pub fn slides(&self, way: &[f64], c: usize) -> f64 {
        let is_even = |contact: &&crate::contact::Contact| {
            contact.coupling().is_none() && contact.press.waveform().is_none()
        };
        let contact = self.model.contacts.get(c).filter(is_even);
        contact.map_or(0.0, |contact| contact.u.free.iter().map(|(i, a)| a * way[*i]).sum())
    }

    /// Returns the name of a coordinate, formed from the name of its body, block or contact.
    #[must_use]
    pub fn name(&self, unknown: Unknown) -> String {
        let free = |i: usize| {
            let free = &self.model.free[i];
            let axis = match free.axis {
                Axis::X => "x",
                Axis::Z => "z",
                Axis::Pitch => "pitch",
            };
            format!("{}.{axis}", self.model.bodies[free.body].name)
        };
        let of_contact = |c: usize| self.model.contacts[c].name.clone();
        match unknown {
            Unknown::Place(i) => free(i),
            Unknown::Speed(i) => format!("{} speed", free(i)),
            Unknown::Own(k) => {
                let owner = self.model.blocks.iter().rfind(|block| block.first <= k && block.count() > 0);
                owner.map_or_else(String::new, |block| format!("{} {}", block.name, k - block.first))
            }
            Unknown::Height(c, k) => format!("{} knot {k}", of_contact(c)),
            Unknown::Slope(c, k) => format!("{} slope {k}", of_contact(c)),
        }
    }

    /// Moves a state one period later back to the section. Returns the moved state and the drift of each free coordinate, m or rad. The
    /// slip memories are shifted by the drift.
    #[must_use]
    pub fn back(&self, mut end: State) -> (State, Vec<f64>) {
        end.come_back(self.model);
        end.carry_over(self.model, self.model.layout());
        let mut way = vec![0.0; self.model.free.len()];
        for drift in &self.drifts {
            let gone = end.y[drift.pivot] - self.base.y[drift.pivot];
            way.iter_mut().zip(&drift.shape).for_each(|(way, share)| *way += gone * share);
        }
        end.y.iter_mut().zip(&way).for_each(|(x, way)| *x -= way);
        for contact in &self.model.contacts {
            let moved: f64 = contact.u.free.iter().map(|(i, a)| a * way[*i]).sum();
            end.shift_law(contact.place, -moved);
        }
        let Self { base, .. } = self;
        (end.t, end.step, end.stuck_step, end.underway) = (base.t, base.step, base.stuck_step, None);
        end.pieces.clone_from(&base.pieces);
        end.generators.clone_from(&base.generators);
        (end, way)
    }

    /// Returns a copy of a state at the section as the start of a run. Energy balance and counts start anew.
    #[must_use]
    pub fn begun(&self, state: &State) -> State {
        let (model, mut begun) = (self.model, state.clone());
        (begun.step, begun.stuck_step, begun.underway) = (0.0, f64::INFINITY, None);
        begun.counts = Counts::default();
        begun.tally.clear(model.contacts.len());
        let (layout, t) = (model.layout(), begun.t);
        for (block, standing) in model.blocks.iter().zip(&mut begun.blocks) {
            let from = layout.block(block.first);
            let states = &mut begun.y[from..from + block.count()];
            block.block().count_from(t, states, &mut standing.memory);
        }
        model.open_books(&mut begun, &mut Vec::new());
        begun
    }

    /// Whether a slip memory of a state has breakpoints that are not coordinates of the section.
    fn holds_more(&self, state: &State) -> bool {
        let is_of = |c: usize, unknown: &Unknown| matches!(unknown, Unknown::Height(own, _) | Unknown::Slope(own, _) if *own == c);
        let has_none =
            |c: usize| !self.carried.contains(&c) && !self.unknowns.iter().any(|unknown| is_of(c, unknown));
        self.model.contacts.iter().filter(|contact| !contact.inert && !contact.balanced).any(|contact| {
            let c = contact.place;
            match &state.memories[c] {
                Memory::Curve(curve) if has_none(c) => legs::holds(&curve.legs(), state.memories[c].apex().d),
                _ => false,
            }
        })
    }

    /// Returns the difference of the states `of` and `less` in the coordinates of the section, in their units. None if their slip memories
    /// have different breakpoints.
    #[must_use]
    pub fn difference(&self, of: &State, less: &State) -> Option<Vec<f64>> {
        if self.holds_more(of) || self.holds_more(less) {
            return None;
        }
        let layout = self.model.layout();
        let at = |place: usize| of.y[place] - less.y[place];
        let number = |unknown: &Unknown| match *unknown {
            Unknown::Place(i) => Some(at(i)),
            Unknown::Speed(i) => Some(at(layout.velocity(i))),
            Unknown::Own(k) => Some(at(layout.block(k))),
            Unknown::Height(c, _) | Unknown::Slope(c, _) => {
                legs::difference(*unknown, [&of.memories[c], &less.memories[c]], &self.model.contacts[c])
            }
        };
        self.unknowns.iter().map(number).collect()
    }

    /// Returns a state with section coordinates changed by the amounts `by`, in their units. None if no slip memory has these coordinates.
    #[must_use]
    pub fn moved(&self, state: &State, by: &[f64]) -> Option<State> {
        let (model, layout) = (self.model, self.model.layout());
        let mut moved = state.clone();
        for (unknown, by) in self.unknowns.iter().zip(by) {
            match *unknown {
                Unknown::Place(i) => moved.y[i] += by,
                Unknown::Speed(i) => moved.y[layout.velocity(i)] += by,
                Unknown::Own(k) => moved.y[layout.block(k)] += by,
                Unknown::Height(..) | Unknown::Slope(..) => {}
            }
        }
        for (c, contact) in model.contacts.iter().enumerate() {
            let before = Equations::on(model, state, layout).motion(contact, state.t, |i| state.y[i]);
            let after = Equations::on(model, &moved, layout).motion(contact, state.t, |i| moved.y[i]);
            let numbers = self.unknowns.iter().zip(by).map(|(unknown, by)| (*unknown, *by));
            let gone = (after.d - before.d, after.u - before.u);
            moved.memories[c] = legs::moved(contact, &state.memories[c], gone, numbers)?;
            moved.renew_law(model, c, gone.1);
        }
        Some(moved)
    }
}
