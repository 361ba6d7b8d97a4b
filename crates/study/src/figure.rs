//! Results of a variant: the few numbers that a sweep keeps of each run.

use stickslip_drive::{Due, Entry, Model, Plan, Record, Scene, Wants};
use stickslip_run::Watcher;
use thiserror::Error;

/// A result that is evaluated for every variant.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum Figure {
    /// Value of a channel at the end of the run, such as `slider.x_m`.
    End(String),
    /// Change of a channel over the last whole period of a waveform; for `slider.x_m`, the step length of a drive. The change is NaN
    /// without a whole period.
    Step {
        /// Name of the channel.
        channel: String,
        /// Index of the waveform in [`Scene::waveforms`].
        waveform: usize,
    },
}

/// Error: a result that the scenario does not have.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub(crate) enum FigureError {
    /// There is no channel of this name.
    #[error("\"{0}\": expected the name of a channel, such as {1}")]
    Channel(String, String),
    /// There is no periodic waveform with this index.
    #[error("expected the index of a waveform with a period, got {0}")]
    Waveform(usize),
}

/// A result with the index of its channel in a row of samples.
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
    /// Returns this result with the index of its channel in a row of samples.
    ///
    /// # Errors
    /// Fails if the channel does not exist, or the waveform does not exist or has no period.
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

/// Receiver of run output that evaluates results from the first and last row and the rows at both ends of the last whole period.
pub(crate) struct Reading<'a> {
    figures: &'a [Placed],
    watcher: &'a dyn Watcher,
    /// Results so far. Before the end of the run, an entry is the channel's value at the start of the run or of the last whole period.
    pub(crate) values: Vec<f64>,
    /// Times at which rows are needed, s, in ascending order; and the index of the next of these times.
    moments: Vec<f64>,
    next: usize,
    /// Start and end time of each result, s.
    spans: Vec<[f64; 2]>,
    is_first: bool,
    end: f64,
}

/// Relative difference below which two times are equal, because multiples of a period have rounding errors.
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

    /// Prepares for a run.
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

    /// Evaluates results whose time span starts or ends at time t, s.
    fn read(&mut self, t: f64, row: &[f64]) {
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

/// Returns start and end of the last whole period of a waveform before `end`, s, or infinite times without a whole period.
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
    fn take(&mut self, entry: Entry<'_>) {
        match entry {
            Entry::Row(values) => {
                self.read(values.first().copied().unwrap_or(0.0), values);
                self.is_first = false;
            }
            Entry::Mark(values) => self.read(values.first().copied().unwrap_or(0.0), values),
            _ => {}
        }
    }

    fn wants(&self) -> Wants {
        Wants::no_events()
    }

    fn next(&mut self, due: Due) -> Option<f64> {
        match due {
            Due::Look => None,
            Due::Mark => {
                let next = self.moments.get(self.next).copied();
                self.next += 1;
                next
            }
        }
    }

    fn goes_on(&mut self, _: f64) -> bool {
        self.watcher.goes_on()
    }
}
