//! Maps: a result over two numbers of a scenario.
//!
//! In reading order: [`Axis`] (a number and its range), [`Map`] (what is asked for), [`Field`] (what was found), `regime` (stick, partial
//! and gross slip of one case), `trace` (borders between regimes), `squares` (lines through a grid, contours as well), [`Overlay`]
//! (measured points), `table` (the files).

mod axis;
mod error;
mod overlay;
mod regime;
mod squares;
mod table;
mod trace;

pub use axis::Axis;
pub use error::MapError;
pub use overlay::Overlay;
pub use regime::Regime;
pub use table::{FieldReport, all_files, json, write};

pub(crate) use table::definitions;

use crate::journal::Journal;
use crate::sweep::{Shard, Study};
use regime::Looks;
use serde_json::json;
use std::path::Path;
use stickslip_run::{Job, Watcher};
use stickslip_scenario::suggestion;

/// Points of an axis where nobody says: of numbers, and of regimes that need runs.
const POINTS: usize = 33;
const POINTS_OF_RUNS: usize = 5;
/// Where it is asked whether runs are needed: at no end and in no middle.
const PROBE: [f64; 2] = [0.37, 0.61];
/// Contours of a map, about.
const CONTOURS: f64 = 7.0;

/// Digits of a study's hash that name the folder of its parts.
const HASH: usize = 12;

/// A map that is asked for.
pub struct Map {
    /// The scenario.
    pub job: Job,
    /// The number to the right and that upwards.
    pub axes: [Axis; 2],
    /// The result.
    pub of: String,
    /// Its SI unit; empty of words and plain numbers.
    pub unit: &'static str,
    /// Points of either axis.
    pub points: [usize; 2],
    /// Where runs that look for borders of regimes are looked up and written down.
    pub journal: Journal,
    kind: Kind,
}

/// What is mapped.
enum Kind {
    /// A result as studies have them: a grid of runs.
    Result(Box<Study>),
    /// The regime of the contact at this place, and whether every look at it is a run.
    Regime(usize, bool),
}

/// What is asked for, as somebody writes it.
#[derive(Debug, Clone, Default)]
pub struct Asked {
    /// Path and range of the number to the right, such as `0.1..0.6`.
    pub x: (String, String),
    /// Path and range of the number upwards.
    pub y: (String, String),
    /// Whether either axis has as many points in every decade.
    pub logarithmic: [bool; 2],
    /// The result.
    pub of: String,
    /// Points of either axis, 2 to 1000.
    pub points: Option<[usize; 2]>,
    /// Whether regimes are taken from runs although waveforms alone prescribe the motion.
    pub by_runs: bool,
}

/// A border between two regimes.
#[derive(Debug, Clone, PartialEq)]
pub struct Border {
    /// What lies on its two sides, the lesser slip first.
    pub between: [Regime; 2],
    /// Points along it, SI; a closed one ends where it begins.
    pub points: Vec<[f64; 2]>,
}

/// What was found.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Field {
    /// Values of the grid to the right, SI.
    pub xs: Vec<f64>,
    /// Values of the grid upwards, SI.
    pub ys: Vec<f64>,
    /// The result at each point, column by column: a number, the place of a word, NaN where there is none.
    pub values: Vec<f64>,
    /// The words; none of numbers.
    pub words: Option<Vec<String>>,
    /// Borders between regimes.
    pub borders: Vec<Border>,
    /// Contours of numbers: a level, and its lines.
    pub contours: Vec<(f64, Vec<Vec<[f64; 2]>>)>,
    /// Number of runs that were made, of results those of the whole grid.
    pub runs: usize,
    /// Why points have no result, with their number, the most frequent first.
    pub faults: Vec<(String, usize)>,
}

impl Map {
    /// Checks what is asked for; the scenario's values in `set` are those of its job.
    ///
    /// # Errors
    /// A path, a range or a result that the scenario does not have.
    pub fn new(job: Job, (file, set): (&Path, &[(String, String)]), asked: &Asked) -> Result<Self, MapError> {
        let [x, y] = [("--x", &asked.x, 0), ("--y", &asked.y, 1)]
            .map(|(option, one, place)| Axis::new(&job, option, one, asked.logarithmic[place]));
        let axes = [x?, y?];
        if axes[0].path == axes[1].path {
            return Err(MapError::SamePath(axes[0].path.clone()));
        }
        let regime = asked.of.strip_prefix("contacts.").and_then(|rest| rest.strip_suffix(".regime"));
        let of = asked.of.clone();
        let mut map = match regime.filter(|name| !name.ends_with(".fretting")) {
            Some(name) => {
                let c = contact(&job, name)?;
                let kind = Kind::Regime(c, asked.by_runs);
                Self { job, axes, of, unit: "", points: [POINTS; 2], journal: Journal::default(), kind }
            }
            None => {
                let points = asked.points.unwrap_or([POINTS; 2]);
                let study = Box::new(study(file, set, (&axes, points), &asked.of)?);
                let unit = stickslip_quantity::names::unit(&asked.of);
                let journal = Journal::default();
                Self { job, axes, of, unit, points, journal, kind: Kind::Result(study) }
            }
        };
        if map.needs_runs() {
            map.points = [POINTS_OF_RUNS; 2];
        }
        map.points = asked.points.unwrap_or(map.points);
        Ok(map)
    }

    /// Whether a regime is asked for, and waveforms alone do not tell it.
    fn needs_runs(&self) -> bool {
        match self.kind {
            Kind::Result(_) => false,
            Kind::Regime(c, by_runs) => by_runs || !Looks::new(self, c, by_runs, &()).is_prescribed(PROBE),
        }
    }

    /// Whether the result is a regime whose borders are traced.
    #[must_use]
    pub fn is_of_regime(&self) -> bool {
        matches!(self.kind, Kind::Regime(..))
    }

    /// Number of cases of the grid.
    #[must_use]
    pub fn cases(&self) -> usize {
        self.points[0] * self.points[1]
    }

    /// Removes what an earlier command has computed of a grid of runs.
    ///
    /// # Errors
    /// What cannot be removed.
    pub fn remove(&self, parts: &Path) -> Result<(), MapError> {
        match &self.kind {
            Kind::Result(study) => Ok(study.remove(&parts.join(&study.hash[..HASH]))?),
            Kind::Regime(..) => Ok(()),
        }
    }

    /// Computes the map on so many threads; the watcher is told how many cases are done. Finished parts of a grid of runs stay in the
    /// folder `parts`, and are not computed again.
    ///
    /// # Errors
    /// Parts that cannot be written or read; an interruption; a map without any result.
    pub fn compute(
        &self,
        parts: &Path,
        threads: usize,
        watcher: &(dyn Watcher + Sync),
    ) -> Result<Field, MapError> {
        let field = match &self.kind {
            // Maps of other results or ranges have parts of their own.
            Kind::Result(study) => self.grid(study, &parts.join(&study.hash[..HASH]), (threads, watcher))?,
            Kind::Regime(c, by_runs) => {
                trace::trace(self, &Looks::new(self, *c, *by_runs, watcher), threads)?
            }
        };
        if field.values.iter().all(|value| value.is_nan()) {
            let why = field.faults.first().map_or_else(String::new, |(why, _)| why.clone());
            return Err(MapError::Nothing { of: self.of.clone(), why });
        }
        Ok(field)
    }

    /// The grid of a result, and its contours.
    fn grid(
        &self,
        study: &Study,
        parts: &Path,
        (threads, watcher): (usize, &(dyn Watcher + Sync)),
    ) -> Result<Field, MapError> {
        if study.run(parts, (Shard::WHOLE, threads), watcher)?.interrupted {
            return Err(MapError::Interrupted);
        }
        let (values, errors) = (study.column(parts, 0)?, study.errors(parts)?);
        let mut faults: Vec<(String, usize)> = Vec::new();
        for why in errors.into_iter().flatten() {
            count(&mut faults, why);
        }
        faults.sort_by_key(|(_, count)| std::cmp::Reverse(*count));
        let [xs, ys] = [0, 1].map(|axis| self.axes[axis].values(self.points[axis]));
        let words = study.codes(0).map(<[String]>::to_vec);
        let contours = if words.is_some() { Vec::new() } else { self.contours(&values) };
        Ok(Field { xs, ys, values, words, contours, runs: self.cases(), faults, ..Field::default() })
    }

    /// Contours at round levels.
    fn contours(&self, values: &[f64]) -> Vec<(f64, Vec<Vec<[f64; 2]>>)> {
        let levels = squares::levels(values, CONTOURS);
        let at = |share: [f64; 2]| [0, 1].map(|axis| self.axes[axis].at(share[axis]));
        let lines = |level: f64| {
            let lines = squares::contour(values, self.points, level);
            let lines = lines.into_iter().map(|line| line.into_iter().map(at).collect());
            (level, lines.collect::<Vec<Vec<_>>>())
        };
        levels.into_iter().map(lines).filter(|(_, lines)| !lines.is_empty()).collect()
    }
}

/// One more of a kind of reason.
fn count(faults: &mut Vec<(String, usize)>, why: String) {
    match faults.iter_mut().find(|(known, _)| *known == why) {
        Some((_, count)) => *count += 1,
        None => faults.push((why, 1)),
    }
}

/// The place of a contact by its name.
fn contact(job: &Job, name: &str) -> Result<usize, MapError> {
    let names: Vec<&str> = job.model.contacts().map(|(name, _)| name).collect();
    names.iter().position(|known| *known == name).ok_or_else(|| MapError::Of {
        of: format!("contacts.{name}.regime"),
        message: format!("there is no contact \"{name}\""),
        help: help(suggestion(name, names.iter().copied())),
    })
}

/// The study of a grid: its last number changes fastest.
fn study(
    file: &Path,
    set: &[(String, String)],
    (axes, points): (&[Axis; 2], [usize; 2]),
    of: &str,
) -> Result<Study, MapError> {
    let vary = axes.iter().zip(points).map(|(axis, count)| {
        let kind = if axis.is_logarithmic { "log" } else { "grid" };
        format!("{}:{}", json!(axis.path), json!({ kind: [axis.range[0], axis.range[1], count] }))
    });
    let vary = vary.collect::<Vec<_>>().join(",");
    // In the order in which they were given: a later value may belong to what an earlier one has set. The last of a path counts, and none
    // of what varies.
    let counts = |(place, (path, _)): &(usize, &(String, String))| {
        set[place + 1..].iter().all(|(later, _)| later != path) && axes.iter().all(|axis| axis.path != *path)
    };
    let set = set
        .iter()
        .enumerate()
        .filter(counts)
        .map(|(_, one)| one)
        .map(|(path, value)| format!("{}:{}", json!(path), json!(value)));
    let text = format!(
        "{{\"stickslip_study\":1,\"scenario\":{},\"set\":{{{}}},\"vary\":{{{vary}}},\"results\":[{}],\"chunk\":{}}}",
        json!(file),
        set.collect::<Vec<_>>().join(","),
        json!(of),
        points[1]
    );
    let stem = file.file_stem().unwrap_or_default().to_string_lossy();
    Study::from_str(&text, (&format!("--of {of}"), &stem), Path::new("")).map_err(|error| MapError::Of {
        of: of.to_owned(),
        message: error.message.clone(),
        help: help(error.help.clone()),
    })
}

/// A line of help where there is any.
fn help(text: Option<String>) -> String {
    text.map_or_else(String::new, |text| format!("\n   help: {text}"))
}
