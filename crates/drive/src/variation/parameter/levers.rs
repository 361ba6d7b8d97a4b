//! Lever arms that move with a number of a scene: how a measure counts its coordinates.

use super::{Beside, Moment, Parameter};
use crate::Model;
use crate::model::{Measure, Terms};

/// How the coefficients of a measure move, of free coordinates and of the waveforms that others follow.
#[derive(Debug, Clone, Default)]
pub(in crate::variation) struct Levers {
    pub(in crate::variation) free: Vec<(usize, f64)>,
    driven: Vec<(usize, f64)>,
}

/// How a measure is moved where the bodies stand as they do, m and m/s.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Moved {
    pub(super) value: f64,
    pub(super) rate: f64,
    /// What of the rate followers make.
    pub(super) driven: f64,
}

impl Levers {
    pub(super) fn of(beside: &Beside, measure: impl Fn(&Model) -> Option<&Measure>) -> Self {
        let rates = |terms: fn(&Measure) -> &Terms| {
            let each = beside.models.iter().filter_map(&measure);
            let mut places: Vec<usize> = each.flat_map(terms).map(|(place, _)| *place).collect();
            places.sort_unstable();
            places.dedup();
            let coefficient = |other: &Model, place: usize| {
                let known = measure(other).and_then(|it| terms(it).iter().find(|(known, _)| *known == place));
                known.map_or(0.0, |(_, coefficient)| *coefficient)
            };
            let rate = |place: usize| (place, beside.rate(|other| coefficient(other, place)));
            places.into_iter().map(rate).filter(|(_, rate)| *rate != 0.0).collect()
        };
        Self { free: rates(|measure| &measure.free), driven: rates(|measure| &measure.driven) }
    }

    /// Whether any moves.
    pub(super) fn any(&self) -> bool {
        !(self.free.is_empty() && self.driven.is_empty())
    }
}

impl Parameter {
    /// Whether it lengthens a lever by which a motion of the free coordinates counts.
    pub(crate) fn lengthens(&self, shape: &[f64]) -> bool {
        let of_contacts = (0..self.contacts.len()).flat_map(|c| self.levers(c));
        let mut all = self.links.iter().map(|link| &link.levers.free[..]).chain(of_contacts);
        all.any(|levers| levers.iter().any(|(i, _)| shape[*i] != 0.0))
    }

    /// How a measure and its rate move, but by its constant: by what is followed, and by levers.
    pub(super) fn moved(&self, (measure, levers): (&Measure, &Levers), at: Moment<'_>) -> Moved {
        let mut moved = Moved::default();
        for (w, a) in &measure.driven {
            let sample = self.sample(*w, at);
            moved.value += a * sample.value;
            moved.driven += a * sample.rate;
        }
        for (w, longer) in &levers.driven {
            let sample = at.own(*w);
            moved.value += longer * sample.value;
            moved.driven += longer * sample.rate;
        }
        moved.rate = moved.driven;
        for (i, longer) in &levers.free {
            let [value, rate] = at.coordinate(*i);
            moved.value += longer * value;
            moved.rate += longer * rate;
        }
        moved
    }
}
