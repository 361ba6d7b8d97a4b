//! Maps: a result over two parameters of a scenario.
//!
//! In reading order:
//! * [`Axis`]: parameter and range; [`Map`]: settings; [`Field`]: result.
//! * `regime`: slip regime of one case; `trace`: borders between regimes; `squares`: contour lines by marching squares.
//! * [`Overlay`]: measured points; `table`: output files.

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

/// Default numbers of points on an axis: for results, and for regimes from runs.
const POINTS: usize = 33;
const POINTS_OF_RUNS: usize = 5;
/// Point of the map, as fractions of both axes, at which the program checks whether runs are needed.
const PROBE: [f64; 2] = [0.37, 0.61];
/// Approximate number of contour levels.
const CONTOURS: f64 = 7.0;

/// Number of hash digits in the name of the folder that contains finished parts of a grid.
const HASH: usize = 12;

/// Settings of a map.
pub struct Map {
    /// The scenario.
    pub job: Job,
    /// Parameters of the x and y axis.
    pub axes: [Axis; 2],
    /// Name of the result.
    pub of: String,
    /// SI unit of the result; empty for words and plain numbers.
    pub unit: &'static str,
    /// Numbers of points on both axes.
    pub points: [usize; 2],
    /// Journal of the runs that trace borders of regimes.
    pub journal: Journal,
    kind: Kind,
}

/// Type of a map.
enum Kind {
    /// A result of a study with a grid of runs.
    Result(Box<Study>),
    /// Slip regime of the contact with this index; true if every regime is computed by a run.
    Regime(usize, bool),
}

/// Settings of a map as text.
#[derive(Debug, Clone, Default)]
pub struct Asked {
    /// Key path and range of the x axis; the range has a form such as `0.1..0.6`.
    pub x: (String, String),
    /// Key path and range of the y axis.
    pub y: (String, String),
    /// Whether the axes are logarithmic.
    pub logarithmic: [bool; 2],
    /// Name of the result.
    pub of: String,
    /// Numbers of points on both axes, 2 to 1000.
    pub points: Option<[usize; 2]>,
    /// Whether regimes are computed by runs even if waveforms alone prescribe the motion.
    pub by_runs: bool,
}

/// Border between two regimes.
#[derive(Debug, Clone, PartialEq)]
pub struct Border {
    /// Regimes on both sides of the border, beginning with the regime of less slip.
    pub between: [Regime; 2],
    /// Points along the border, SI. The last point of a closed border equals the first.
    pub points: Vec<[f64; 2]>,
}

/// Result of a map.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Field {
    /// Grid values of the x axis, SI.
    pub xs: Vec<f64>,
    /// Grid values of the y axis, SI.
    pub ys: Vec<f64>,
    /// Result at each grid point, column by column: a number or the index of a word. NaN if there is no result.
    pub values: Vec<f64>,
    /// Words of the result; `None` for numbers.
    pub words: Option<Vec<String>>,
    /// Borders between regimes.
    pub borders: Vec<Border>,
    /// Contours: levels with their lines.
    pub contours: Vec<(f64, Vec<Vec<[f64; 2]>>)>,
    /// Number of runs; for a map of a result, the number of grid points.
    pub runs: usize,
    /// Reasons of missing results with the number of points for each, the most frequent first.
    pub faults: Vec<(String, usize)>,
}

impl Map {
    /// Creates a map and checks its settings. `set` contains the overrides that are already part of the scenario.
    ///
    /// # Errors
    /// Fails if a path, range or result does not exist in the scenario.
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

    /// Returns whether the map shows a regime that needs runs, because waveforms alone do not prescribe the motion.
    fn needs_runs(&self) -> bool {
        match self.kind {
            Kind::Result(_) => false,
            Kind::Regime(c, by_runs) => by_runs || !Looks::new(self, c, by_runs, &()).is_prescribed(PROBE),
        }
    }

    /// Returns whether the map shows a regime with traced borders.
    #[must_use]
    pub fn is_of_regime(&self) -> bool {
        matches!(self.kind, Kind::Regime(..))
    }

    /// Returns the number of grid points.
    #[must_use]
    pub fn cases(&self) -> usize {
        self.points[0] * self.points[1]
    }

    /// Deletes the results of earlier runs of the grid.
    ///
    /// # Errors
    /// Fails if files cannot be deleted.
    pub fn remove(&self, parts: &Path) -> Result<(), MapError> {
        match &self.kind {
            Kind::Result(study) => Ok(study.remove(&parts.join(&study.hash[..HASH]))?),
            Kind::Regime(..) => Ok(()),
        }
    }

    /// Computes the map on `threads` threads. The watcher receives the number of finished cases. Finished parts of a
    /// grid are kept in the folder `parts` and are not computed again.
    ///
    /// # Errors
    /// Fails if parts cannot be written or read, the watcher interrupts, or no point has a result.
    pub fn compute(
        &self,
        parts: &Path,
        threads: usize,
        watcher: &(dyn Watcher + Sync),
    ) -> Result<Field, MapError> {
        let field = match &self.kind {
            // Each map has its own folder of parts.
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

    /// Computes the grid of a result and its contours.
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

    /// Returns contours at round levels.
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

/// Counts a reason.
fn count(faults: &mut Vec<(String, usize)>, why: String) {
    match faults.iter_mut().find(|(known, _)| *known == why) {
        Some((_, count)) => *count += 1,
        None => faults.push((why, 1)),
    }
}

/// Returns the index of a contact by its name.
fn contact(job: &Job, name: &str) -> Result<usize, MapError> {
    let names: Vec<&str> = job.model.contacts().map(|(name, _)| name).collect();
    names.iter().position(|known| *known == name).ok_or_else(|| MapError::Of {
        of: format!("contacts.{name}.regime"),
        message: format!("there is no contact \"{name}\""),
        help: help(suggestion(name, names.iter().copied())),
    })
}

/// Returns the study of the grid. The y parameter changes fastest.
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
    // Overrides keep their order, because an override may belong to a part that an earlier override creates. The last override of a path
    // counts; overrides of the axes' parameters are dropped.
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

/// Formats a help line, if there is one.
fn help(text: Option<String>) -> String {
    text.map_or_else(String::new, |text| format!("\n   help: {text}"))
}
