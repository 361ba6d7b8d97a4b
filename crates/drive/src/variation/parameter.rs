//! What of a drive moves with a number of its scene.
//!
//! A number moves constants: moduli, masses, stiffnesses, indentations, what waveforms are and when their corners come. How fast is
//! read off models on both sides of its value, by differences over five points: whatever path a number takes into a model, none needs
//! a law of its own here. No run of these models is asked for, so that a small distance costs no more than rounding.

mod contact;
mod levers;

use super::works::Works;
use super::{Anchors, Variation, VariationError};
use crate::model::Stroke;
use crate::{Model, Piece, Plan, Sample, State};
use contact::ContactRates;
pub(super) use contact::{Shift, edge};
use levers::Levers;
use stickslip_contact::Memory;

/// A number of the scene, told by models on both sides of its value.
#[derive(Debug, Clone)]
pub struct Parameter {
    beside: Beside,
    /// Of each free coordinate its constant force, N or N m, and its mobility, as a share of it.
    coordinates: Vec<[f64; 2]>,
    links: Vec<LinkRates>,
    arms: Vec<f64>,
    contacts: Vec<ContactRates>,
    /// Waveforms that it moves.
    waveforms: Vec<bool>,
}

/// Models at -2, -1, 1 and 2 distances from a value.
#[derive(Debug, Clone)]
struct Beside {
    models: [Model; 4],
    distance: f64,
}

/// How the constants of a link move.
#[derive(Debug, Clone)]
pub(super) struct LinkRates {
    /// Where it is held.
    pub(super) levers: Levers,
    pub(super) stiffness: f64,
    pub(super) damping: f64,
    pub(super) preload: f64,
    length: f64,
    stroke: f64,
}

/// How a link is moved.
#[derive(Debug, Clone, Copy)]
pub(super) struct Stretched {
    /// Its stretch s - e and its length e, m.
    pub(super) stretch: f64,
    pub(super) length: f64,
    /// The rates of its stroke and of its length, and what of that followers make, m/s.
    pub(super) stroke_rate: f64,
    pub(super) rate: f64,
    pub(super) driven: f64,
}

/// How a starting state moves: its components, of each memory the anchors, a line [a, b] of each piece, and where the books of energies
/// begin, what is stored and what has been put in, J.
struct Start {
    column: Vec<f64>,
    anchors: Vec<Vec<[f64; 2]>>,
    books: [f64; 2],
}

/// Waveforms on their pieces at a time, s, and the components of a run then.
#[derive(Clone, Copy)]
pub(super) struct Moment<'a> {
    pub(super) model: &'a Model,
    pub(super) pieces: &'a [Piece],
    pub(super) t: f64,
    pub(super) y: &'a [f64],
    /// How far from their origins positions are counted, m.
    pub(super) shifts: &'a [f64],
    /// How numbers move waveforms there, one number after the other, or the one in question; empty where that is not laid out.
    pub(super) moving: &'a [Moving],
}

/// How a number moves a waveform on one piece.
#[derive(Debug, Clone)]
pub(super) enum Moving {
    /// Not at all.
    Not,
    /// By what goes straight: the time it is counted from, s, what it is then, and its rate.
    Straight([f64; 3]),
    /// As it does on these pieces of the models beside.
    Curved(Box<[Piece; 4]>),
    /// By what has to be asked for.
    Unknown,
}

impl<'a> Moment<'a> {
    /// Where a run stands.
    pub(super) fn of(model: &'a Model, state: &'a State) -> Self {
        let State { pieces, y, shifts, .. } = state;
        Self { model, pieces, t: state.t, y, shifts, moving: &[] }
    }

    /// As the number at this place finds it.
    pub(super) fn by(self, place: usize) -> Self {
        let count = self.pieces.len();
        Self { moving: self.moving.get(place * count..(place + 1) * count).unwrap_or_default(), ..self }
    }

    /// A free coordinate from its origin, and its rate: m and m/s, or rad and rad/s.
    fn coordinate(&self, i: usize) -> [f64; 2] {
        [self.shifts[i] + self.y[i], self.y[self.model.layout().velocity(i)]]
    }

    /// The waveform itself.
    fn own(&self, w: usize) -> Sample {
        self.model.waveforms[w].sample(&self.pieces[w], self.t)
    }
}

impl Beside {
    /// The derivative of what a model has at the value.
    fn rate(&self, of: impl Fn(&Model) -> f64) -> f64 {
        self.rate_between(self.models.each_ref().map(of))
    }

    /// How a waveform on these pieces of theirs moves at a time, s.
    fn sample(&self, w: usize, pieces: &[Piece; 4], t: f64) -> Sample {
        let at = |k: usize| self.models[k].waveforms[w].sample(&pieces[k], t);
        self.sample_between(&[0, 1, 2, 3].map(at))
    }

    fn sample_between(&self, beside: &[Sample; 4]) -> Sample {
        let of = |read: fn(&Sample) -> f64| self.rate_between(beside.each_ref().map(read));
        Sample { value: of(|it| it.value), rate: of(|it| it.rate), acceleration: 0.0 }
    }

    /// The same of what all four have.
    fn rate_between(&self, values: [f64; 4]) -> f64 {
        Parameter::rate(values, self.distance)
    }
}

impl Parameter {
    /// The derivative of what has these values at -2, -1, 1 and 2 distances: f(-2h) - 8f(-h) + 8f(h) - f(2h) over 12h, exact but for the
    /// fifth derivative.
    #[must_use]
    pub fn rate([far_below, below, above, far_above]: [f64; 4], distance: f64) -> f64 {
        (far_below - far_above + 8.0 * (above - below)) / (12.0 * distance)
    }

    /// A number by which a model moves to those `beside` it, at -2, -1, 1 and 2 distances from its value. Derivatives are by the unit in
    /// which the distance is told, and as exact as a change by that unit asks for: a share of the value, and not metres of a stroke, or steps
    /// are needlessly short.
    ///
    /// # Errors
    ///
    /// Models of another form, in which other parts act.
    pub fn new(model: &Model, beside: [Model; 4], distance: f64) -> Result<Self, VariationError> {
        let is_alike = |other: &Model| other.is_alike(model) && strokes(other).eq(strokes(model));
        if !beside.iter().all(is_alike) {
            return Err(VariationError::Form);
        }
        let beside = Beside { models: beside, distance };
        let coordinate = |i: usize| {
            let mobility = beside.rate(|other| other.free[i].mobility);
            [beside.rate(|other| other.free[i].force), mobility / model.free[i].mobility]
        };
        let link = |l: usize| LinkRates {
            levers: Levers::of(&beside, |other| Some(&other.links[l].elongation)),
            stiffness: beside.rate(|other| other.links[l].stiffness),
            damping: beside.rate(|other| other.links[l].damping),
            preload: beside.rate(|other| other.links[l].preload),
            length: beside.rate(|other| other.links[l].elongation.constant),
            stroke: beside.rate(|other| match other.links[l].stroke {
                Stroke::Constant(stroke) => stroke,
                Stroke::Driven(_) => 0.0,
            }),
        };
        let waveform = |w: usize| beside.models.iter().any(|other| other.waveforms[w] != model.waveforms[w]);
        let waveforms: Vec<bool> = (0..model.waveforms.len()).map(waveform).collect();
        Ok(Self {
            coordinates: (0..model.free.len()).map(coordinate).collect(),
            links: (0..model.links.len()).map(link).collect(),
            arms: (0..model.loads.len()).map(|l| beside.rate(|other| other.loads[l].arm)).collect(),
            contacts: model.contacts.iter().map(|c| ContactRates::of(c, &beside, &waveforms)).collect(),
            waveforms,
            beside,
        })
    }

    /// How a run's starting state moves.
    fn start(&self, model: &Model, plan: &Plan, state: &State) -> Result<Start, VariationError> {
        // An equilibrium is dear: none is looked for that is the same.
        if self.beside.models.iter().all(|other| other.rests_as(model)) {
            let still = |memory: &Memory| vec![[0.0; 2]; lines(memory).len()];
            let anchors = state.memories.iter().map(still).collect();
            return Ok(Start { column: vec![0.0; state.y.len()], anchors, books: [0.0; 2] });
        }
        let states = self.beside.models.each_ref().map(|model| model.start(plan).ok());
        let [Some(a), Some(b), Some(c), Some(d)] = states else { return Err(VariationError::Form) };
        let states = [a, b, c, d];
        let rate = |of: [f64; 4]| self.beside.rate_between(of);
        let column = (0..state.y.len()).map(|i| rate(states.each_ref().map(|state| state.y[i]))).collect();
        let of_contact = |c: usize| {
            let count = lines(&state.memories[c]).len();
            let beside = states.each_ref().map(|state| lines(&state.memories[c]));
            if beside.iter().any(|lines| lines.len() != count) {
                return Err(VariationError::Form);
            }
            let line = |k: usize| [0, 1].map(|i| rate(beside.each_ref().map(|lines| lines[k][i])));
            Ok((0..count).map(line).collect())
        };
        let anchors = (0..state.memories.len()).map(of_contact).collect::<Result<_, _>>()?;
        let books: [fn(&State) -> f64; 2] = [|state| state.origin, |state| state.jumps];
        let books = books.map(|of| rate(states.each_ref().map(of)));
        Ok(Start { column, anchors, books })
    }

    /// How each waveform moves on these pieces, from a time on, s.
    pub(super) fn moving(&self, pieces: &[Piece], from: f64) -> impl Iterator<Item = Moving> {
        (0..self.waveforms.len()).map(move |w| {
            if !self.waveforms[w] {
                return Moving::Not;
            }
            let beside = self.beside.models.each_ref().map(|other| other.waveforms[w].piece(pieces[w].index));
            let [Some(a), Some(b), Some(c), Some(d)] = beside else { return Moving::Unknown };
            let beside = [a, b, c, d];
            if beside.iter().any(|piece| piece.line().is_none()) {
                return Moving::Curved(Box::new(beside));
            }
            let Sample { value, rate, .. } = self.beside.sample(w, &beside, from);
            Moving::Straight([from, value, rate])
        })
    }

    /// How a waveform moves at a moment.
    pub(super) fn sample(&self, w: usize, at: Moment<'_>) -> Sample {
        let still = Sample { value: 0.0, rate: 0.0, acceleration: 0.0 };
        if !self.waveforms.get(w).copied().unwrap_or(false) {
            return still;
        }
        match at.moving.get(w) {
            Some(Moving::Not) => still,
            Some(Moving::Straight([from, value, rate])) => {
                Sample { value: value + rate * (at.t - from), rate: *rate, ..still }
            }
            Some(Moving::Curved(pieces)) => self.beside.sample(w, pieces, at.t),
            Some(Moving::Unknown) | None => {
                let beside = self.beside.models.each_ref().map(|other| sampled(other, w, at));
                self.beside.sample_between(&beside)
            }
        }
    }

    /// How the end of a waveform's piece moves, s.
    pub(super) fn corner(&self, w: usize, piece: &Piece) -> f64 {
        if !self.waveforms.get(w).copied().unwrap_or(false) {
            return 0.0;
        }
        let end = |other: &Model| other.waveforms[w].piece(piece.index).map_or(f64::NAN, |piece| piece.end);
        self.beside.rate(end)
    }

    /// Constant force on a free coordinate, N or N m, and how its mobility moves, as a share of it.
    pub(super) fn coordinate(&self, i: usize) -> [f64; 2] {
        self.coordinates[i]
    }

    /// Whether a mass moves.
    pub(super) fn weighs(&self) -> bool {
        self.coordinates.iter().any(|[_, mobility]| *mobility != 0.0)
    }

    /// How the force along a link moves, N, its stretch s - e and the rate of that at hand.
    pub(super) fn link(&self, model: &Model, l: usize, [stretch, speed]: [f64; 2], at: Moment<'_>) -> f64 {
        let (link, rates, moved) = (&model.links[l], &self.links[l], self.stretched(model, l, at));
        let held = link.stiffness * moved.stretch + link.damping * (moved.stroke_rate - moved.rate);
        rates.stiffness * stretch + rates.damping * speed + rates.preload + held
    }

    /// How the constants of a link move.
    pub(super) fn link_rates(&self, l: usize) -> &LinkRates {
        &self.links[l]
    }

    /// How a link is stretched where its bodies stand as they do.
    pub(super) fn stretched(&self, model: &Model, l: usize, at: Moment<'_>) -> Stretched {
        let (link, rates) = (&model.links[l], &self.links[l]);
        let stroke = match link.stroke {
            Stroke::Constant(_) => [rates.stroke, 0.0],
            Stroke::Driven(w) => {
                let sample = self.sample(w, at);
                [sample.value, sample.rate]
            }
        };
        let moved = self.moved((&link.elongation, &rates.levers), at);
        let length = rates.length + moved.value;
        let [stroke, stroke_rate] = stroke;
        Stretched { stretch: stroke - length, length, stroke_rate, rate: moved.rate, driven: moved.driven }
    }

    /// How the mass of a free coordinate moves, kg or kg m².
    pub(super) fn mass(&self, i: usize) -> f64 {
        self.beside.rate(|other| other.free[i].mass)
    }

    /// How a load moves, N or N m, its waveform's value at hand.
    pub(super) fn load(&self, model: &Model, l: usize, value: f64, at: Moment<'_>) -> f64 {
        self.arms[l] * value + model.loads[l].arm * self.sample(model.loads[l].waveform, at).value
    }
}

/// A waveform of a model where that of the run is on a piece; not a number where it has none like it.
fn sampled(model: &Model, w: usize, at: Moment<'_>) -> Sample {
    let waveform = &model.waveforms[w];
    let nothing = Sample { value: f64::NAN, rate: f64::NAN, acceleration: f64::NAN };
    waveform.piece(at.pieces[w].index).map_or(nothing, |piece| waveform.sample(&piece, at.t))
}

/// What each link and each load follows, what presses each contact, and how many there are.
fn strokes(model: &Model) -> impl Iterator<Item = Option<usize>> {
    let of_links = model.links.iter().map(|link| match link.stroke {
        Stroke::Constant(_) => None,
        Stroke::Driven(w) => Some(w),
    });
    let of_loads = model.loads.iter().map(|load| Some(load.free));
    let of_contacts =
        model.contacts.iter().map(|contact| contact.press.waveform().filter(|_| !contact.inert));
    of_links.chain(of_loads).chain(of_contacts)
}

/// The lines α + βh of a memory's pieces, [α, β].
pub(super) fn lines(memory: &Memory) -> Vec<[f64; 2]> {
    let Memory::Curve(curve) = memory else { return Vec::new() };
    let slopes = curve.legs().slopes;
    curve.knots().zip(slopes).map(|((h, p), slope)| [p - slope * h, slope]).collect()
}

impl Model {
    /// The variation of a run from its start by numbers of the scene, each in the unit in which its distance is told.
    ///
    /// # Errors
    ///
    /// A scene with a part whose variation is not known; numbers with which it starts otherwise.
    pub fn variation<'m>(
        &'m self,
        (plan, start): (&Plan, &State),
        parameters: &'m [Parameter],
    ) -> Result<Variation<'m>, VariationError> {
        let (dimension, count) = (self.layout().dimension(), parameters.len());
        let starts = parameters.iter().map(|parameter| parameter.start(self, plan, start));
        let starts = starts.collect::<Result<Vec<_>, _>>()?;
        let columns = starts.iter().flat_map(|start| &start.column[..dimension]).copied().collect();
        let of_contact = |c: usize| {
            let pieces = starts.first().map_or(0, |start| start.anchors[c].len());
            let lines = (0..pieces).flat_map(|k| starts.iter().map(move |start| start.anchors[c][k]));
            Anchors::new(count, lines.collect())
        };
        let anchors = (0..self.contacts.len()).map(of_contact).collect();
        let books = starts.iter().map(|start| start.books).collect();
        let variation = Variation::new((self, parameters), (columns, anchors), self.tolerance(plan.stepper))?;
        Ok(variation.beginning(Works::new(books, start)))
    }
}
