//! Reading of a state, in the order of [`write`](super::write). Functions return none for words that no state of the model has.

use super::FIXED;
use super::generated::generating;
use crate::interval::PhasePoint;
use crate::method::Tally;
use crate::model::{BlockState, Model, Wired};
use crate::state::{Ahead, Books, Grip, Layout, Whereabouts};
use crate::state::{Allowed, Booked, Counts, Crawl, Detour, FixedWay, Gait, Grid, LocatedWay};
use crate::state::{Generating, State, Stepped, Takeoff, Underway, Window};
use crate::{Piece, Waveform};
use stickslip_contact::{Law, Memory, Words};
use stickslip_stepper::{Hand, Rejection, StepHistory};

/// Largest number of memory values of a block.
const MOST_OF_A_MEMORY: usize = 1 << 24;

pub(super) fn state(model: &Model, words: &mut Words<'_>) -> Option<State> {
    let mut layout = model.layout();
    layout.growing = if words.flag()? { layout.growing } else { 0 };
    let [t, jumps, lost, origin, step, stuck_step] = numbers(words)?;
    let y = reals(words, layout.total())?;
    let shifts = reals(words, layout.free)?;
    let friction = reals(words, model.contacts.len())?;
    let (mut grew, mut memories, mut modes) = (Vec::new(), Vec::new(), Vec::new());
    for contact in &model.contacts {
        grew.push(words.flag()?);
        memories.push(Memory::read(&contact.interface, &contact.engine, words)?);
        modes.push(Law::read(&contact.interface, words)?);
    }
    let blocks = model.blocks.iter().map(|wired| block(model, wired, words)).collect::<Option<_>>()?;
    let (pieces, supplied, generators) = pieces(model, words)?;
    if !((0.0..f64::INFINITY).contains(&t) && step >= 0.0) {
        return None;
    }
    let mut generating = generators.iter().zip(&pieces);
    if !generating.all(|(generating, piece)| generating.is_none_or(|it| it.is_on(piece, t))) {
        return None;
    }
    Some(State {
        t,
        y,
        shifts,
        memories,
        modes,
        grew,
        blocks,
        pieces,
        friction,
        jumps,
        lost,
        origin,
        step,
        stuck_step,
        supplied,
        generators,
        counts: counts(words)?,
        tally: Tally::read(model.contacts.len(), words)?,
        underway: option(words, |words| underway(model, layout, t, words))?,
    })
}

/// Reads numbers, which may be infinite.
fn numbers<const N: usize>(words: &mut Words<'_>) -> Option<[f64; N]> {
    let mut numbers = [0.0; N];
    for number in &mut numbers {
        *number = words.number()?;
    }
    Some(numbers)
}

fn reals(words: &mut Words<'_>, count: usize) -> Option<Vec<f64>> {
    if count > words.left() {
        return None;
    }
    (0..count).map(|_| words.number()).collect()
}

fn option<T>(words: &mut Words<'_>, read: impl FnOnce(&mut Words<'_>) -> Option<T>) -> Option<Option<T>> {
    if words.flag()? { read(words).map(Some) } else { Some(None) }
}

/// Reads a block; its memory must have its initial length, as the block indexes it.
fn block(model: &Model, wired: &Wired, words: &mut Words<'_>) -> Option<BlockState> {
    let law = usize::try_from(words.word()?).ok().filter(|law| *law < wired.block().laws())?;
    let (_, start) = wired.block().start(&model.signals().first_inputs(wired));
    let count = words.count(MOST_OF_A_MEMORY).filter(|count| *count == start.len())?;
    Some(BlockState { law, memory: reals(words, count)? })
}

/// Present pieces, supplied pieces and states of generators.
type Pieces = (Vec<Piece>, Vec<Option<Piece>>, Vec<Option<Generating>>);

fn pieces(model: &Model, words: &mut Words<'_>) -> Option<Pieces> {
    let (mut pieces, mut supplied, mut generators) = (Vec::new(), Vec::new(), Vec::new());
    let feeds = model.waveforms.iter().any(|waveform| waveform.interpolation().is_some());
    let generates = model.waveforms.iter().any(|waveform| waveform.generator().is_some());
    for waveform in &model.waveforms {
        pieces.push(piece(waveform, words)?);
        if feeds {
            supplied.push(option(words, |words| piece(waveform, words))?);
        }
        if generates {
            let of = waveform.generator().map(|generator| generating(generator, words));
            generators.push(match of {
                Some(generating) => Some(generating?),
                None => None,
            });
        }
    }
    Some((pieces, supplied, generators))
}

fn piece(waveform: &Waveform, words: &mut Words<'_>) -> Option<Piece> {
    match (waveform.interpolation(), waveform.generator()) {
        (None, None) => waveform.piece(words.word()?),
        _ => Piece::of_supplied(numbers(words)?),
    }
}

fn counts(words: &mut Words<'_>) -> Option<Counts> {
    let mut next = || words.tally();
    Some(Counts {
        steps: next()?,
        rejected: next()?,
        evaluations: next()?,
        events: next()?,
        detours: next()?,
        missed: next()?,
    })
}

fn history(words: &mut Words<'_>) -> Option<StepHistory> {
    let log_error = words.number()?;
    let rejected = option(words, |words| {
        let [step, log_error] = numbers(words)?;
        Some(Rejection { step, log_error })
    })?;
    Some(StepHistory { log_error, rejected })
}

fn underway(model: &Model, layout: Layout, t: f64, words: &mut Words<'_>) -> Option<Underway> {
    match words.word()? {
        0 => located(model, layout, words).map(|way| Underway::Located(Box::new(way))),
        1 => fixed(model, layout, t, words).map(|way| Underway::Fixed(Box::new(way))),
        _ => None,
    }
}

fn located(model: &Model, layout: Layout, words: &mut Words<'_>) -> Option<LocatedWay> {
    Some(LocatedWay {
        tolerance: words.finite()?,
        whereabouts: if words.flag()? { Whereabouts::Here } else { Whereabouts::Behind },
        hand: Hand { graded: words.flag()?, both: words.flag()? },
        slopes: {
            let count = words.count(layout.total())?;
            reals(words, count)?
        },
        history: history(words)?,
        gait: Gait {
            proven: words.number()?,
            ahead: if words.flag()? { Ahead::Shortens } else { Ahead::Clear },
            grip: match words.word()? {
                0 => Grip::Slips,
                1 => Grip::Sticks,
                2 => Grip::Rests,
                _ => return None,
            },
        },
        allowed: Allowed { scale: reals(words, layout.total())?, power: words.number()? },
        booked: booked(words)?,
        asked: words.flag()?,
        leap: option(words, |words| {
            let [t, x, v, input] = numbers(words)?;
            Some(Takeoff { from: PhasePoint { t, x, v }, input })
        })?,
        detour: option(words, detour)?.filter(|detour| detour.step > 0.0),
        last_detour: detour(words)?,
        windows: windows(model, words)?,
        crawl: Crawl { since: words.number()?, attempts: words.tally()? },
        steps: option(words, stepped)?,
    })
}

fn detour(words: &mut Words<'_>) -> Option<Detour> {
    let [end, length, step] = numbers(words)?;
    (0.0 <= step && step <= length && length < f64::INFINITY).then_some(Detour { end, length, step })
}

fn fixed(model: &Model, layout: Layout, t: f64, words: &mut Words<'_>) -> Option<FixedWay> {
    let stepper = *FIXED.get(usize::try_from(words.word()?).ok()?)?;
    let [start, step, count] = numbers(words)?;
    let grid = Grid { start, step, count };
    if !is_on(grid, t) {
        return None;
    }
    let keeps = words.flag()?;
    Some(FixedWay {
        stepper,
        grid,
        slopes: reals(words, if keeps { layout.total() } else { 0 })?,
        senses: reals(words, model.contacts.len())?,
        booked: booked(words)?,
        windows: windows(model, words)?,
        steps: option(words, stepped)?,
    })
}

/// Whether a fixed-step run can be at time t, between two adjacent times of the grid. Otherwise a step would be negative or infinite.
fn is_on(Grid { start, step, count }: Grid, t: f64) -> bool {
    let [last, next] = [count, count + 1.0].map(|count| start + count * step);
    let whole = count >= 0.0 && count.fract() == 0.0 && step > 0.0;
    // Allows for rounding of times.
    let slack = 1e-6 * step + 8.0 * f64::EPSILON * t;
    whole && next.is_finite() && last <= t + slack && next >= t - slack
}

fn booked(words: &mut Words<'_>) -> Option<Booked> {
    Some(Booked {
        blocks: words.number()?,
        books: if words.flag()? { Books::Behind } else { Books::Current },
    })
}

fn windows(model: &Model, words: &mut Words<'_>) -> Option<Vec<Window>> {
    let window = |_| {
        Some(Window { start: words.number()?, count: u32::try_from(words.word()?).ok()?.min(u32::MAX / 2) })
    };
    (0..Window::count(model)).map(window).collect()
}

fn stepped(words: &mut Words<'_>) -> Option<Stepped> {
    Some(Stepped {
        next: words.finite()?,
        place: option(words, numbers)?.map(|[origin, place]| (origin, place)),
        step: option(words, |words| words.number())?,
        agreed: u32::try_from(words.word()?).ok()?.min(u32::MAX / 2),
    })
}
