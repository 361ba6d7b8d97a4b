//! Contacts whose path (u, d) is prescribed by waveforms: fretting regime (stick, partial slip, gross slip) without a run.
//!
//! A spring at height h of the profile slips when its stretch reaches κ(d-h), with κ = μE\*/G\*. The last spring to slip is at the centre,
//! h = 0. The centre sticks at a constant position p if max(u-κd) ≤ p ≤ min(u+κd) over a period. Otherwise there is gross slip.

use crate::contact::{Contact, Press};
use crate::{Model, Piece, Waveform};
use stickslip_stepper::{Bracket, Point, root};

/// Largest allowed ratio of a common period to the longest period of a waveform.
const MULTIPLES: u32 = 1000;
/// Relative tolerance of a common period, in units of a period.
const COMMENSURATE: f64 = 1e-9;
/// Number of search intervals for extremes, per quarter of the shortest wave or per smooth piece.
const PARTS: f64 = 16.0;
/// Largest number of smooth pieces of waveforms, and of search intervals, in one period.
const MOST_PARTS: usize = 1 << 16;
/// Relative tolerance within which a path returns on the same line, in units of the largest u and κd.
const SAME_LINE: f64 = 1e-9;

/// Returns the smallest common multiple of periods, s, with a relative tolerance of 1e-9. `None` for an empty list, or if the multiple
/// exceeds a thousand times the longest period.
#[must_use]
pub fn common_period(periods: &[f64]) -> Option<f64> {
    let longest = periods.iter().copied().fold(0.0, f64::max);
    let fits = |whole: f64| {
        periods.iter().all(|period| (whole / period - (whole / period).round()).abs() <= COMMENSURATE)
    };
    (longest > 0.0)
        .then(|| (1..=MULTIPLES).map(|n| f64::from(n) * longest).find(|whole| fits(*whole)))
        .flatten()
}

/// Path of a contact over one period, prescribed by waveforms.
#[derive(Debug)]
pub struct Prescribed<'m> {
    contact: &'m Contact,
    waveforms: Vec<(usize, &'m Waveform)>,
    /// Boundaries of the smooth sections of the period, s, ascending.
    corners: Vec<f64>,
}

/// Displacement u and indentation d (m) with their rates (m/s) at one time; d = 0 for an open contact.
type Moment = [f64; 4];

impl<'m> Prescribed<'m> {
    /// Returns the prescribed path of contact `c` of a model.
    ///
    /// `None` if other motions than waveforms move the contact, if it is a row of springs, or if the waveforms have no common period.
    #[must_use]
    pub fn of(model: &'m Model, c: usize) -> Option<Self> {
        let contact = model.contacts.get(c)?;
        if !contact.is_walked() || contact.engine.springs() > 0 {
            return None;
        }
        let driven = contact.u.driven.iter().map(|(w, _)| *w);
        let pressed = contact.coupling().into_iter().flat_map(|d| d.driven.iter().map(|(w, _)| *w));
        let mut places: Vec<usize> = driven.chain(pressed).chain(contact.press.waveform()).collect();
        places.sort_unstable();
        places.dedup();
        let waveforms: Vec<_> =
            places.into_iter().map(|w| Some((w, model.waveforms.get(w)?))).collect::<Option<_>>()?;
        let periods = waveforms.iter().map(|(_, waveform)| waveform.period()).collect::<Option<Vec<_>>>()?;
        let period = if periods.is_empty() { 1.0 } else { common_period(&periods)? };
        let window = |(_, waveform): &(usize, &Waveform)| waveform.window();
        let started = waveforms.iter().map(|one| window(one).0).fold(0.0, f64::max);
        let stopped = waveforms.iter().map(|one| window(one).1).fold(f64::INFINITY, f64::min);
        let start = if stopped.is_finite() { stopped - period } else { started };
        if start < started {
            return None;
        }
        let corners = corners(&waveforms, [start, start + period])?;
        Some(Self { contact, waveforms, corners })
    }

    /// Returns max(u-κd) and min(u+κd) over the period, m. The contact has gross slip if the first value exceeds the second.
    #[must_use]
    pub fn gross(&self) -> [f64; 2] {
        let slope = self.contact.interface.stick_slope();
        let [low, high] = [-1.0, 1.0].map(|sign| {
            // The maxima of u-κd and of -(u+κd).
            self.largest(|[u, d, du, dd]| (-sign * u - slope * d, -sign * du - slope * dd))
        });
        [low, -high]
    }

    /// Returns the largest indentation of the contact over the period, m; 0 for a contact that never closes.
    #[must_use]
    pub fn deepest(&self) -> f64 {
        self.largest(|[_, d, _, dd]| (d, dd))
    }

    /// Returns the margin of gross slip, max(u-κd) - min(u+κd), relative to the largest u and κd; at least 0 in gross slip.
    #[must_use]
    pub fn gross_margin(&self) -> f64 {
        let [low, high] = self.gross();
        let scale = self.contact.interface.stick_slope() * self.deepest() + low.abs().max(high.abs());
        if scale > 0.0 { (low - high) / scale } else { 0.0 }
    }

    /// Returns the margin of slip: the maximum of (|u̇|-κ|ḋ|)/(|u̇|+κ|ḋ|) for a path that returns on the same line. The margin is negative
    /// if every spring sticks, and 1 for a path that encloses an area.
    #[must_use]
    pub fn slip_margin(&self) -> f64 {
        let slope = self.contact.interface.stick_slope();
        let mut path = Vec::new();
        let mut most = -1.0_f64;
        self.each_stretch(|moments, _| {
            path.extend(moments.iter().map(|(_, [u, d, ..])| (*d, *u)));
            for (_, [_, d, du, dd]) in moments {
                let (along, down) = (du.abs(), slope * dd.abs());
                if *d > 0.0 && along + down > 0.0 {
                    most = most.max((along - down) / (along + down));
                }
            }
        });
        path.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
        let largest = path.iter().fold(0.0, |most: f64, (d, u)| most.max(u.abs()).max(slope * d));
        let steps = path.windows(2).map(|pair| (pair[1].0 - pair[0].0, (pair[1].1 - pair[0].1).abs()));
        let opens = steps.into_iter().any(|(down, along)| along > slope * down + SAME_LINE * largest);
        if opens && most < 0.0 { 1.0 } else { most }
    }

    fn moment(&self, pieces: &[Piece], t: f64) -> Moment {
        let sample = |w: usize| {
            let at = self.waveforms.iter().position(|(known, _)| *known == w);
            at.map(|at| self.waveforms[at].1.sample(&pieces[at], t))
        };
        let value = |w: usize| sample(w).map_or(0.0, |sample| sample.value);
        let rate = |w: usize| sample(w).map_or(0.0, |sample| sample.rate);
        let none = |_: usize| 0.0;
        let rate_of =
            |measure: &crate::model::Measure| measure.driven.iter().map(|(w, a)| a * rate(*w)).sum::<f64>();
        let (d, dd) = match &self.contact.press {
            Press::Coupled(measure) => (measure.value(none, value), rate_of(measure)),
            Press::Constant { d, .. } => (*d, 0.0),
            Press::Force(w) | Press::Indentation(w) | Press::Radius(w) => {
                sample(*w).map_or((0.0, 0.0), |sample| self.contact.pressed(sample, None))
            }
        };
        let u = self.contact.u.value(none, value);
        let (d, dd) = if d > 0.0 { (d, dd) } else { (0.0, 0.0) };
        [u, d, rate_of(&self.contact.u), dd]
    }

    /// Calls the function `take` for every smooth section in order, with sampled times and a function for any other time of the section.
    fn each_stretch(&self, mut take: impl FnMut(&[(f64, Moment)], &dyn Fn(f64) -> Moment)) {
        let wave =
            self.waveforms.iter().map(|(_, waveform)| waveform.resolution()).fold(f64::INFINITY, f64::min);
        for pair in self.corners.windows(2) {
            let [from, to] = [pair[0], pair[1]];
            let middle = from + 0.5 * (to - from);
            let pieces: Vec<Piece> =
                self.waveforms.iter().map(|(_, waveform)| waveform.piece_at(middle)).collect();
            let parts = (PARTS * ((to - from) / wave).max(1.0)).ceil().min(MOST_PARTS as f64);
            let at = |t: f64| self.moment(&pieces, t);
            let times = (0..=parts as usize).map(|k| from + (to - from) * (k as f64 / parts));
            let moments: Vec<(f64, Moment)> = times.map(|t| (t, at(t))).collect();
            take(&moments, &at);
        }
    }

    /// Returns the maximum over the path of a function `of` that returns a value and its rate.
    fn largest(&self, of: impl Fn(Moment) -> (f64, f64)) -> f64 {
        let mut largest = f64::NEG_INFINITY;
        self.each_stretch(|moments, at| {
            for pair in moments.windows(2) {
                let [from, to] = [pair[0], pair[1]].map(|(t, moment)| (t, of(moment)));
                largest = largest.max(from.1.0).max(to.1.0);
                // A maximum lies in between.
                if from.1.1 > 0.0 && to.1.1 < 0.0 {
                    let ends = [from, to].map(|(t, (_, rate))| Point { x: t, y: rate });
                    let turn = root(|t| of(at(t)).1, Bracket { from: ends[0], to: ends[1] }, 0.0);
                    largest = largest.max(of(at(turn)).0);
                }
            }
        });
        largest
    }
}

/// Returns the sorted boundaries of all smooth pieces of the waveforms in a time span; `None` if there are too many.
fn corners(waveforms: &[(usize, &Waveform)], [start, end]: [f64; 2]) -> Option<Vec<f64>> {
    let mut all = vec![start, end];
    for (_, waveform) in waveforms {
        let pieces = waveform.pieces_from(start).take(MOST_PARTS);
        all.extend(pieces.map(|piece| piece.end).take_while(|at| *at < end));
    }
    all.sort_by(f64::total_cmp);
    all.dedup();
    (all.len() <= MOST_PARTS).then_some(all)
}
