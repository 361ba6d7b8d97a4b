//! Serialisation of generators. Reading returns none for values that a generator of this model cannot have.

use super::write::Page;
use crate::state::Generating;
use crate::state::generated::Span;
use crate::waveform::{Command, Generator, Heading, Steps};
use stickslip_contact::Words;

impl Page<'_> {
    pub(super) fn generating(&mut self, generating: &Generating) {
        self.command(&generating.command);
        self.option(generating.asked.as_ref(), |page, (since, command)| {
            page.reals([*since]);
            page.command(command);
        });
        self.option(generating.span.as_ref(), |page, Span { origin, period, top, stroke }| {
            page.reals([*origin, *period, *top, *stroke]);
        });
        self.words([generating.count, u64::from(generating.turned), generating.begun]);
    }

    fn command(&mut self, command: &Command) {
        self.reals([command.stroke, command.frequency]);
        let (is_counted, steps) = match command.steps {
            Steps::Endless => (0, 0),
            Steps::Left(steps) => (1, steps),
        };
        self.words([u64::from(command.heading == Heading::Backward), is_counted, steps]);
    }
}

pub(super) fn generating(of: &Generator, words: &mut Words<'_>) -> Option<Generating> {
    Some(Generating {
        cycle: of.cycle,
        command: command(of, words)?,
        asked: if words.flag()? { Some((words.finite()?, command(of, words)?)) } else { None },
        span: if words.flag()? { Some(span(of, words)?) } else { None },
        count: words.word()?,
        turned: words.flag()?,
        begun: words.word()?,
    })
}

fn command(of: &Generator, words: &mut Words<'_>) -> Option<Command> {
    let [stroke, frequency] = [words.finite()?, words.finite()?];
    let heading = if words.flag()? { Heading::Backward } else { Heading::Forward };
    let steps = match (words.flag()?, words.word()?) {
        (true, steps) => Steps::Left(steps),
        (false, 0) => Steps::Endless,
        (false, _) => return None,
    };
    let command = Command { stroke, frequency, heading, steps };
    of.takes(&command).then_some(command)
}

/// Reads a cycle of a generator. None unless it turns within its period and has an allowed stroke and frequency.
fn span(of: &Generator, words: &mut Words<'_>) -> Option<Span> {
    let [origin, period, top, stroke] = [words.finite()?, words.finite()?, words.finite()?, words.finite()?];
    let (low, high) = of.strokes;
    let is_short = period < of.frequencies.1.recip();
    let fits = origin >= 0.0 && 0.0 < top && top < period && !is_short && (low..=high).contains(&stroke);
    fits.then_some(Span { origin, period, top, stroke })
}
