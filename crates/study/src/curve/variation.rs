//! The varied parameter of a curve, with the arguments of `--set` for each point, so that every point can be run separately.

use super::{CurveError, Kind};
use serde_json::Value;
use std::f64::consts::TAU;
use stickslip_drive::Waveform;
use stickslip_drive::facts::Pressed;
use stickslip_drive::scene::{Axis, Freedom, Named, Normal, Scene, Side, Varying};
use stickslip_run::Job;

/// Pairs of key path and value.
pub(super) type Overrides = Vec<(String, String)>;

/// Relative difference below which two periods are equal.
const SAME: f64 = 1e-9;

/// Varied parameter of a curve.
#[derive(Debug, Clone, PartialEq)]
pub struct Variation {
    /// Name: "stroke", "frequency", "load", "preload" or the key path.
    pub name: String,
    /// SI unit; empty for a plain number.
    pub unit: &'static str,
    /// Value in the scenario, SI. `None` if the scenario omits it.
    pub present: Option<f64>,
    /// Default range, SI. `None` if unknown.
    pub range: Option<[f64; 2]>,
    setting: Setting,
}

#[derive(Debug, Clone, PartialEq)]
enum Setting {
    /// Key paths with factors: the parameter at each path is set to the curve's value times its factor.
    Paths(Vec<(String, f64)>),
    /// An additional load on the body of this name.
    Load(String),
}

/// A waveform with its path in the scenario.
struct Place<'a> {
    /// Key path such as `waveforms.drive.sawtooth`.
    path: String,
    /// Kind, such as `sawtooth`.
    word: String,
    form: &'a Value,
}

impl Variation {
    /// Creates the varied parameter of a curve.
    ///
    /// # Errors
    /// Fails if the scenario does not have this curve, or the key path does not name a number.
    pub(super) fn of(kind: &Kind, job: &Job) -> Result<Self, CurveError> {
        let (waveform, body) = (waveform(job)?, body(job, "no body of the model makes steps")?);
        let tree = serde_json::from_str(&job.resolved).unwrap_or_default();
        match kind {
            Kind::StepAmplitude => Self::amplitude(job, &tree, waveform),
            Kind::SpeedFrequency => Self::frequency(job, &tree, waveform),
            Kind::ForceSpeed | Kind::StepLoad => Ok(Self::load(job, body)),
            Kind::Preload => Self::preload(job, body).map_err(|why| {
                let help = "vary the normal load by its path, such as loads[0].z";
                not_here(job, kind.name(), why, help)
            }),
            Kind::Vary(path) => Self::at(job, path),
        }
    }

    /// Creates the parameter at a key path.
    pub(super) fn at(job: &Job, path: &str) -> Result<Self, CurveError> {
        let found = job.scenario.parameter(path)?;
        let setting = Setting::Paths(vec![(path.to_owned(), 1.0)]);
        Ok(Self { name: path.to_owned(), unit: found.unit, present: found.value, range: None, setting })
    }

    /// Returns the column name with unit: `stroke_m`.
    #[must_use]
    pub fn head(&self) -> String {
        stickslip_quantity::names::with_unit(&self.name, self.unit)
    }

    /// Returns the error that there is no default range.
    pub(super) fn no_range(&self, job: &Job) -> CurveError {
        let why = if self.present == Some(0.0) { "it is 0" } else { "no contact holds the body" };
        CurveError::NoRange { file: job.name.clone(), varied: self.name.clone(), why }
    }

    /// Returns the overrides that time-reverse all waveforms with the period of the steps, so that the drive steps backward.
    pub(super) fn reversal(job: &Job, kind: &Kind) -> Result<Overrides, CurveError> {
        let tree = serde_json::from_str(&job.resolved).unwrap_or_default();
        let scene = &job.scenario.scene;
        let reversed = |w: usize| {
            let name = &scene.waveforms[w].name;
            let place = place(&tree, name).filter(|place| {
                let keys = ["sequence", "burst"];
                keys.iter().all(|key| place.form.get(key).is_none_or(Value::is_null))
            });
            let Some(place) = place else {
                let why = format!("\"{name}\" has a burst or a sequence, which cannot be reversed");
                let help = "compute one direction without --both, and reverse the runs of the sequence for the other direction";
                return Err(not_here(job, kind.name(), why, help));
            };
            if place.word == "table" {
                let why = format!("\"{name}\" is a table, which cannot be reversed");
                let help = "compute one direction without --both, and give the points in reverse order for the other direction";
                return Err(not_here(job, kind.name(), why, help));
            }
            let back = r#"[{"cycles": 1, "reversed": true}]"#;
            let pattern = (format!("{}.sequence", place.path), back.to_owned());
            let number = |key: &str| place.form.get(key).and_then(Value::as_f64).unwrap_or(0.0);
            let phase = number("phase");
            let advance = mirrored(phase, number("delay") / scene.waveforms[w].part.timing().period);
            let turned = (format!("{}.phase", place.path), format!("{advance:e}"));
            Ok(if advance == phase { vec![pattern] } else { vec![pattern, turned] })
        };
        let all: Result<Vec<Overrides>, _> =
            companions(scene, waveform(job)?).into_iter().map(reversed).collect();
        Ok(all?.concat())
    }

    /// Returns the overrides for a parameter value. A load acts against `direction`, the direction of the steps, 1 or -1.
    pub(super) fn overrides(&self, value: f64, direction: f64) -> Overrides {
        match &self.setting {
            Setting::Paths(paths) => {
                paths.iter().map(|(path, share)| (path.clone(), format!("{:e}", share * value))).collect()
            }
            Setting::Load(on) => {
                let entry = serde_json::json!({ "on": on, "x": -direction * value });
                vec![("loads[+]".to_owned(), entry.to_string())]
            }
        }
    }

    fn amplitude(job: &Job, tree: &Value, waveform: usize) -> Result<Self, CurveError> {
        let scene = &job.scenario.scene;
        let Some((path, key, value)) = size(tree, scene, waveform) else {
            let place = place(tree, &scene.waveforms[waveform].name);
            let word = place.as_ref().map_or("", |place| place.word.as_str());
            let why = format!("a waveform of the kind \"{word}\" has no single stroke or amplitude");
            let help = match &place {
                Some(Place { path, word, .. }) if word == "table" => {
                    format!("vary {path}.gain, the factor of all its values")
                }
                _ => "vary a number of the waveform by its path".to_owned(),
            };
            return Err(not_here(job, Kind::StepAmplitude.name(), why, &help));
        };
        // Waveforms of other feet in the same gait have the same period and size and are followed along the same axes.
        let alike = |w: usize| {
            let found = size(tree, scene, w);
            found.filter(|(_, other, size)| {
                *other == key && *size == value && followed(scene, w) == followed(scene, waveform)
            })
        };
        let others = companions(scene, waveform).into_iter().filter(|w| *w != waveform).filter_map(alike);
        let unit = job.scenario.parameter(&path)?.unit;
        let paths = [(path, 1.0)].into_iter().chain(others.map(|(path, ..)| (path, 1.0))).collect();
        let mut range = [value / 20.0, 2.0 * value];
        range.sort_by(f64::total_cmp);
        let range = (value != 0.0).then_some(range);
        Ok(Self { name: key.to_owned(), unit, present: Some(value), range, setting: Setting::Paths(paths) })
    }

    fn frequency(job: &Job, tree: &Value, waveform: usize) -> Result<Self, CurveError> {
        let scene = &job.scenario.scene;
        let path = |w: usize| {
            let path = format!("{}.frequency", place(tree, &scene.waveforms[w].name)?.path);
            job.scenario.parameter(&path).ok().map(|_| (path, 1.0))
        };
        let paths = companions(scene, waveform).into_iter().map(path).collect::<Option<Vec<_>>>();
        let Some(paths) = paths else {
            let why = "a waveform has no frequency, such as a table".to_owned();
            return Err(not_here(job, Kind::SpeedFrequency.name(), why, "change the times in the table"));
        };
        let present = scene.waveforms[waveform].part.period().map(f64::recip);
        let range = present.map(|frequency| [frequency / 10.0, 2.0 * frequency]);
        let setting = Setting::Paths(paths);
        Ok(Self { name: "frequency".to_owned(), unit: "Hz", present, range, setting })
    }

    fn load(job: &Job, body: usize) -> Self {
        let most = held(job, body);
        Self {
            name: "load".to_owned(),
            unit: "N",
            present: Some(0.0),
            range: (most > 0.0).then_some([0.0, most]),
            setting: Setting::Load(job.scenario.scene.bodies[body].name.clone()),
        }
    }

    /// Varies the constant normal forces of all contacts of the body in proportion. The parameter value is the sum of these forces.
    ///
    /// # Errors
    /// Returns a message if no contact of the body has a constant normal force.
    pub(super) fn preload(job: &Job, body: usize) -> Result<Self, String> {
        let scene = &job.scenario.scene;
        let own = scene.contacts.iter().filter(|c| c.part.between.contains(&Side::Body(body)));
        let pressed = own.filter_map(|contact| match contact.part.normal {
            Normal::Force(Varying::Constant(force)) if force > 0.0 => {
                Some((contact.name.as_str(), force, f64::from(contact.part.count)))
            }
            _ => None,
        });
        let forces: Vec<(&str, f64, f64)> = pressed.collect();
        let sum: f64 = forces.iter().map(|(_, force, count)| force * count).sum();
        if forces.is_empty() {
            let name = &scene.bodies[body].name;
            return Err(format!("no contact of \"{name}\" has a constant normal force"));
        }
        let share =
            |(name, force, _): &(&str, f64, f64)| (format!("contacts.{name}.normal.force"), force / sum);
        let setting = Setting::Paths(forces.iter().map(share).collect());
        let range = Some([sum / 10.0, 3.0 * sum]);
        Ok(Self { name: "preload".to_owned(), unit: "N", present: Some(sum), range, setting })
    }
}

pub(super) fn not_here(job: &Job, kind: &'static str, why: String, help: &str) -> CurveError {
    CurveError::NotHere { file: job.name.clone(), kind, why, help: help.to_owned() }
}

/// Returns the sum of the friction limits μF_N of a body's contacts at t = 0, N. This sum is an upper bound of the holding force.
fn held(job: &Job, body: usize) -> f64 {
    let contacts = job.scenario.scene.contacts.iter().enumerate();
    let own = contacts.filter(|(_, contact)| contact.part.between.contains(&Side::Body(body)));
    let limit = |(c, _)| {
        let depth = job.model.indentations(&job.start, c)?.start;
        Pressed::of(job.setup(), c, depth).map(|pressed| pressed.limit_force)
    };
    own.filter_map(limit).sum()
}

/// Returns the index of the waveform whose period is the period of the steps.
fn waveform(job: &Job) -> Result<usize, CurveError> {
    let scene = &job.scenario.scene;
    let is_periodic = |named: &&Named<Waveform>| named.part.period().is_some();
    let place = job.scenario.figures.waveform.filter(|w| scene.waveforms.get(*w).is_some());
    if let Some(w) = place
        && is_periodic(&&scene.waveforms[w])
    {
        return Ok(w);
    }
    let names: Vec<&str> = scene.waveforms.iter().filter(is_periodic).map(|w| w.name.as_str()).collect();
    let why = match place {
        Some(w) => format!("\"{}\" has no period", scene.waveforms[w].name),
        None if names.is_empty() => "no waveform has a period".to_owned(),
        None => "there are several".to_owned(),
    };
    let help = match names.is_empty() {
        true => "let a body follow a waveform with a period".to_owned(),
        false => format!("name one, \"figures\": {{\"waveform\": …}}: {}", names.join(", ")),
    };
    Err(CurveError::NoPeriod { file: job.name.clone(), why, help })
}

/// Returns the index of the body whose steps are evaluated. `lacking` is the error message if the model has no such body.
pub(super) fn body(job: &Job, lacking: &'static str) -> Result<usize, CurveError> {
    let bodies = &job.scenario.scene.bodies;
    let is_free = |b: &usize| bodies.get(*b).is_some_and(|body| body.part.x.freedom == Freedom::Free);
    let names: Vec<&str> = (0..bodies.len()).filter(is_free).map(|b| bodies[b].name.as_str()).collect();
    let help = match names.is_empty() {
        true => "make x of a body \"free\"".to_owned(),
        false => format!("name one, \"figures\": {{\"body\": …}}: {}", names.join(", ")),
    };
    let none = CurveError::NoBody { file: job.name.clone(), lacking, help };
    job.scenario.figures.body.filter(is_free).ok_or(none)
}

/// Returns the phase of a time-reversed cycle, rad, from its phase and its delay in periods.
///
/// The reversed cycle runs through the values before the time origin. The reversed cycle also starts after the delay of the waveform and
/// keeps its phase relative to other waveforms.
fn mirrored(phase: f64, delay: f64) -> f64 {
    (TAU * (2.0 * delay).fract() - phase).rem_euclid(TAU)
}

/// Returns the indices of all waveforms with the same period as the given waveform, including this waveform.
fn companions(scene: &Scene, waveform: usize) -> Vec<usize> {
    let own = scene.waveforms[waveform].part.period().unwrap_or(f64::NAN);
    let is_alike = |w: &usize| {
        scene.waveforms[*w].part.period().is_some_and(|period| (period / own - 1.0).abs() <= SAME)
    };
    (0..scene.waveforms.len()).filter(is_alike).collect()
}

/// Finds a waveform in the scenario file: under its name, or at the body that follows the waveform.
fn place<'a>(tree: &'a Value, name: &str) -> Option<Place<'a>> {
    let named = tree.get("waveforms").and_then(|all| all.get(name));
    let (path, found) = match named {
        Some(found) => (format!("waveforms.{name}"), found),
        // A waveform without a name is identified by its path.
        None => (name.to_owned(), tree.pointer(&pointer(name))?),
    };
    let (word, form) = found.as_object()?.iter().next()?;
    Some(Place { path: format!("{path}.{word}"), word: word.clone(), form })
}

/// Converts a key path to a JSON pointer.
fn pointer(path: &str) -> String {
    format!("/{}", path.replace('[', ".").replace(']', "").replace('.', "/"))
}

/// Returns path, key and value of a waveform's stroke or amplitude.
fn size(tree: &Value, scene: &Scene, waveform: usize) -> Option<(String, &'static str, f64)> {
    let Place { path, form, .. } = place(tree, &scene.waveforms.get(waveform)?.name)?;
    ["stroke", "amplitude"].into_iter().find_map(|key| {
        let value = form.get(key)?.as_f64()?;
        Some((format!("{path}.{key}"), key, value))
    })
}

/// Returns the axes along which bodies follow a waveform.
fn followed(scene: &Scene, waveform: usize) -> Vec<Axis> {
    let axes = scene.bodies.iter().flat_map(|body| body.part.coordinates());
    let follows = |freedom| match freedom {
        Freedom::Follows(signal) => scene.waveform_of(signal) == Some(waveform),
        Freedom::Fixed | Freedom::Free | Freedom::Balanced => false,
    };
    let mut axes: Vec<Axis> = axes.filter(|(_, c)| follows(c.freedom)).map(|(axis, _)| axis).collect();
    axes.sort_by_key(|axis| *axis as u8);
    axes.dedup();
    axes
}
