//! Figures of a variant: the few numbers that are kept of its run.

use stickslip_drive::{Event, Model, Plan, Record, Scene};
use stickslip_run::Watcher;
use thiserror::Error;

/// A number that is told of every variant.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum Figure {
    /// Value of a channel at the end, such as `slider.x_m`.
    End(String),
    /// What a channel gains in the last whole period of a waveform: of `slider.x_m` the step of a drive. NaN where no period is
    /// over.
    Step {
        /// Name of the channel.
        channel: String,
        /// Place of the waveform in [`Scene::waveforms`].
        waveform: usize,
    },
}

/// A figure that a scene does not have.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub(crate) enum FigureError {
    /// No channel of that name.
    #[error("\"{0}\": expected the name of a channel, such as {1}")]
    Channel(String, String),
    /// No waveform at that place.
    #[error("expected the place of a waveform with a period, got {0}")]
    Waveform(usize),
}

/// A figure by the place of its channel in a row.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Placed {
    channel: usize,
    kind: Kind,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    End,
    Step(usize),
}

impl Figure {
    /// Where it stands in a row.
    pub(crate) fn place(&self, scene: &Scene, model: &Model) -> Result<Placed, FigureError> {
        let (name, kind) = match self {
            Self::End(name) => (name, Kind::End),
            Self::Step { channel, waveform } => {
                let period = scene.waveforms.get(*waveform).and_then(|named| named.part.period());
                period.ok_or(FigureError::Waveform(*waveform))?;
                (channel, Kind::Step(*waveform))
            }
        };
        let channels = model.channels();
        let channel = channels.iter().position(|channel| channel.name == *name).ok_or_else(|| {
            let known: Vec<&str> = channels.iter().skip(1).map(|channel| channel.name.as_str()).collect();
            FigureError::Channel(name.clone(), known.join(", "))
        })?;
        Ok(Placed { channel, kind })
    }
}

/// Reads figures off a run: its first and its last row, and those where the last whole period begins and ends.
pub(crate) struct Reading<'a> {
    figures: &'a [Placed],
    watcher: &'a dyn Watcher,
    /// The figures as they are known so far: before the last row what their channels were at the start, or where the period began.
    pub(crate) values: Vec<f64>,
    /// Moments to read at, s, ascending, and which of them is next.
    moments: Vec<f64>,
    next: usize,
    /// Of each figure from when to when it counts, s.
    spans: Vec<[f64; 2]>,
    is_first: bool,
    end: f64,
}

/// Times within this share of each other are one: rounding of multiples of a period.
const SAME: f64 = 4.0 * f64::EPSILON;

impl<'a> Reading<'a> {
    pub(crate) fn new(figures: &'a [Placed], watcher: &'a dyn Watcher) -> Self {
        let count = figures.len();
        Self {
            figures,
            watcher,
            values: vec![f64::NAN; count],
            moments: Vec::with_capacity(2 * count),
            next: 0,
            spans: Vec::with_capacity(count),
            is_first: true,
            end: 0.0,
        }
    }

    /// Before a run.
    pub(crate) fn begin(&mut self, scene: &Scene, plan: &Plan) {
        (self.next, self.is_first, self.end) = (0, true, plan.duration);
        self.values.fill(f64::NAN);
        self.moments.clear();
        self.spans.clear();
        for figure in self.figures {
            let span = match figure.kind {
                Kind::End => [0.0, self.end],
                Kind::Step(waveform) => last_period(scene, waveform, self.end),
            };
            let last = self.end * (1.0 - SAME);
            self.moments.extend(span.into_iter().filter(|t| *t > 0.0 && *t < last));
            self.spans.push(span);
        }
        self.moments.sort_unstable_by(f64::total_cmp);
        self.moments.dedup();
    }

    fn is_end(&self, t: f64) -> bool {
        t >= self.end * (1.0 - SAME)
    }

    /// Takes what begins or ends at t, s.
    fn take(&mut self, t: f64, row: &[f64]) {
        let is_now = |moment: f64| (t - moment).abs() <= SAME * t;
        let is_last = !self.is_first && self.is_end(t);
        for ((figure, span), value) in self.figures.iter().zip(&self.spans).zip(&mut self.values) {
            let channel = row.get(figure.channel).copied().unwrap_or(f64::NAN);
            let ends = is_now(span[1]) || is_last && self.end * (1.0 - SAME) <= span[1];
            if is_now(span[0]) && !ends {
                *value = channel;
            } else if ends {
                *value = if figure.kind == Kind::End { channel } else { channel - *value };
            }
        }
    }
}

/// Beginning and end of the last whole period before an end, s; never, where none is.
fn last_period(scene: &Scene, waveform: usize, end: f64) -> [f64; 2] {
    let never = [f64::INFINITY; 2];
    let Some(waveform) = scene.waveforms.get(waveform).map(|named| &named.part) else { return never };
    let Some(period) = waveform.period() else { return never };
    let delay = waveform.timing().delay;
    let whole = ((end - delay) / period * (1.0 + SAME)).floor();
    let whole = waveform.timing().cycles.map_or(whole, |cycles| whole.min(cycles.floor()));
    if whole < 1.0 {
        return never;
    }
    [delay + (whole - 1.0) * period, delay + whole * period]
}

impl Record for Reading<'_> {
    fn row(&mut self, values: &[f64]) {
        self.take(values.first().copied().unwrap_or(0.0), values);
        self.is_first = false;
    }

    fn event(&mut self, _: &Event, _: &[f64]) {}

    fn wants_events(&self) -> bool {
        false
    }

    fn next_mark(&mut self) -> Option<f64> {
        let next = self.moments.get(self.next).copied();
        self.next += 1;
        next
    }

    fn mark(&mut self, values: &[f64]) {
        self.take(values.first().copied().unwrap_or(0.0), values);
    }

    fn goes_on(&mut self, _: f64) -> bool {
        self.watcher.goes_on()
    }
}
