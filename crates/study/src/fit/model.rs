//! Simulation that a fit compares with the measured data.

use super::Asked;
use super::data::Data;
use super::error::FitError;
use serde_json::{Value, json};
use stickslip_contact::{Apex, Segment};
use stickslip_measure::series::extent;
use stickslip_run::measured::{How, Measured, MeasuredError};
use stickslip_run::{Job, Watcher};
use stickslip_scenario::{PlotName, Scenario};

/// Number of periods for which a body is moved along the loop; the last one is compared.
const PERIODS: f64 = 3.0;
/// Relative change below which a channel is constant.
const ROUNDING: f64 = 1e-9;
/// Number of rows per simulated period.
const ROWS: f64 = 1024.0;

/// A free parameter.
pub(super) struct Free {
    pub(super) path: String,
    pub(super) unit: &'static str,
    pub(super) start: f64,
}

impl Free {
    /// Returns the parameter value at a coordinate of the search. The coordinate is the logarithm of value over initial value, so that the
    /// sign is preserved, or the value itself if the initial value is 0.
    pub(super) fn at(&self, place: f64) -> f64 {
        if self.start == 0.0 { place } else { self.start * math::exp(place) }
    }

    /// Returns the derivative of the value with respect to the coordinate.
    pub(super) fn slope(&self, place: f64) -> f64 {
        if self.start == 0.0 { 1.0 } else { self.at(place) }
    }
}

/// Method of comparing the scenario with the data.
enum Way {
    /// A contact at constant load is moved along the measured displacements.
    Contact(usize),
    /// A body is moved along the measured displacements, and a force channel is compared.
    Led { body: String, force: String },
    /// The scenario runs unchanged, and its displacement and force channels are compared.
    Run { displacement: String, force: String },
}

impl Way {
    fn of(job: &Job, asked: &Asked) -> Result<Self, FitError> {
        let names: Vec<String> = job.model.contacts().map(|(name, _)| name.to_owned()).collect();
        let contact = || {
            let place = match &asked.contact {
                Some(name) => names.iter().position(|own| own == name),
                None => Some(0).filter(|_| names.len() == 1),
            };
            place.ok_or_else(|| FitError::Contact(names.join(", ")))
        };
        let channels: Vec<String> = job.model.channels().into_iter().map(|channel| channel.name).collect();
        let channel = |wanted: &Option<String>, otherwise: &str| {
            let wanted = match wanted {
                Some(wanted) => wanted.clone(),
                None => format!("{}.{otherwise}", names[contact()?]),
            };
            let ends = ["", "_m", "_N"].map(|end| format!("{wanted}{end}"));
            let found = channels.iter().find(|own| ends.contains(own)).cloned();
            found.ok_or_else(|| FitError::Channel { wanted, known: channels[1..].join(", ") })
        };
        let displacement = channel(&asked.displacement, "u_m")?;
        let force = channel(&asked.force, "fx_N")?;
        let of = |place: usize, quantity: &str| format!("{}.{quantity}", names[place]);
        let led = (0..names.len()).find(|c| displacement == of(*c, "u_m") && force == of(*c, "fx_N"));
        match (led, displacement.strip_suffix(".x_m")) {
            (Some(contact), _) if job.has_constant_load(contact) => Ok(Self::Contact(contact)),
            (Some(contact), _) => Err(FitError::Load(names[contact].clone())),
            (None, Some(body)) if is_led(job, body) => Ok(Self::Led { body: body.to_owned(), force }),
            _ => Ok(Self::Run { displacement, force }),
        }
    }
}

/// A scenario with free parameters.
pub(super) struct Model<'a> {
    job: &'a Job,
    /// Called before each variant.
    pub(super) watcher: &'a (dyn Watcher + Sync),
    pub(super) free: Vec<Free>,
    way: Way,
}

impl<'a> Model<'a> {
    pub(super) fn new(
        job: &'a Job,
        asked: &Asked,
        watcher: &'a (dyn Watcher + Sync),
    ) -> Result<Self, FitError> {
        if asked.free.is_empty() {
            return Err(FitError::Nothing);
        }
        let free = |path: &String| {
            let found = job.scenario.parameter(path)?;
            let start = found.value.ok_or_else(|| FitError::LeftOut(path.clone()))?;
            Ok(Free { path: found.path, unit: found.unit, start })
        };
        let free: Vec<Free> = asked.free.iter().map(free).collect::<Result<_, FitError>>()?;
        let way = Way::of(job, asked)?;
        if let Way::Contact(contact) = way
            && let Some((name, _)) = job.model.contacts().nth(contact)
        {
            // The loop of a contact at constant load depends on μF_N and the stiffness. The load also affects the
            // stiffness, but too weakly to determine the load.
            let of = |part: &str| {
                let start = format!("contacts.{name}.{part}");
                free.iter().map(|free| &free.path).find(|path| path.starts_with(&start)).cloned()
            };
            if let (Some(friction), Some(normal)) = (of("friction"), of("normal")) {
                return Err(FitError::Undetermined(vec![vec![friction, normal]]));
            }
        }
        Ok(Self { job, watcher, free, way })
    }

    /// Returns the measured data as a loop or as a trajectory, whichever this model is compared with.
    pub(super) fn data(&self, measured: &mut Measured, how: &How) -> Result<Data, FitError> {
        let data = match self.way {
            Way::Run { .. } => Data::trajectory(measured),
            _ => {
                let evaluated = match measured.evaluate(how) {
                    Ok(evaluated) => Some(evaluated),
                    Err(MeasuredError::NoCycle(_)) => None,
                    Err(error) => return Err(error.into()),
                };
                let found = Data::of_loop(measured, evaluated.as_ref());
                found.ok_or_else(|| MeasuredError::NoCycle(measured.file.clone()))?
            }
        };
        let is_constant = |(low, high): (f64, f64)| high - low <= ROUNDING * high.abs().max(low.abs());
        for (values, what) in [(&data.force, "forces"), (&data.u, "displacements")] {
            if is_constant(extent(values)) {
                return Err(FitError::Constant(measured.file.clone(), what));
            }
        }
        let (rows, numbers) = (data.force.len(), self.free.len());
        if rows < numbers + 3 { Err(FitError::Few(rows, numbers)) } else { Ok(data) }
    }

    /// Returns the simulated forces in the rows of the data; for a trajectory, followed by the scaled displacements.
    pub(super) fn force(&self, place: &[f64], data: &Data) -> Result<Vec<f64>, FitError> {
        if !self.watcher.goes_on() {
            return Err(FitError::Interrupted);
        }
        match &self.way {
            Way::Contact(contact) => along(&self.variant(place, &[])?, *contact, data),
            Way::Led { body, force } => self.led(place, (body, force), data),
            Way::Run { displacement, force } => self.run(place, [displacement, force], data),
        }
    }

    /// Returns the scenario with free parameters at a point and with further overrides.
    fn variant(&self, place: &[f64], further: &[(String, String)]) -> Result<Job, FitError> {
        let numbers = self
            .free
            .iter()
            .zip(place)
            .map(|(free, place)| (free.path.clone(), format!("{:e}", free.at(*place))));
        // Overrides of the body's motion come first, because a free parameter may belong to this motion.
        let all: Vec<(String, String)> = further.iter().cloned().chain(numbers).collect();
        let all: Vec<(&str, &str)> =
            all.iter().map(|(path, value)| (path.as_str(), value.as_str())).collect();
        let mut scenario = Scenario::from_str_with(&self.job.resolved, &self.job.name, "", &all)?;
        scenario.plan.limits.wall = None;
        (scenario.springs, scenario.memory, scenario.fields) = (None, None, None);
        scenario.plots = vec![PlotName::Loop];
        scenario.own_plots.clear();
        scenario.written.digits = None;
        scenario.written.window = [0.0, f64::INFINITY];
        Ok(Job::new(scenario, self.job.name.clone(), std::path::PathBuf::new())?)
    }

    /// Returns the forces in the last period of a run in which a body is moved along the measured loop.
    fn led(&self, place: &[f64], (body, force): (&str, &str), data: &Data) -> Result<Vec<f64>, FitError> {
        let mut points: Vec<[f64; 2]> = data.t.iter().zip(&data.u).map(|(t, u)| [*t, *u]).collect();
        let first = points[0];
        points.push([first[0] + data.period, first[1]]);
        points.iter_mut().for_each(|point| point[0] -= first[0]);
        let table = json!({ "table": { "points": points, "repeat": true } });
        let duration = PERIODS * data.period;
        let further = [
            (format!("bodies.{body}.x"), json!({ "follows": table }).to_string()),
            ("run".to_owned(), json!({ "duration": duration }).to_string()),
            ("output".to_owned(), json!({ "every": data.period / ROWS }).to_string()),
        ];
        let rows = self.rows(place, &further, &[force])?;
        let start = (PERIODS - 1.0) * data.period - first[0];
        Ok(data.t.iter().map(|t| at(&rows[0], &rows[1], t + start)).collect())
    }

    /// Returns the forces and scaled displacements of a run without prescribed displacements.
    fn run(&self, place: &[f64], channels: [&str; 2], data: &Data) -> Result<Vec<f64>, FitError> {
        let rows = self.rows(place, &[], &channels)?;
        let forces = data.t.iter().map(|t| at(&rows[0], &rows[2], *t));
        Ok(forces.chain(data.t.iter().map(|t| data.scale * at(&rows[0], &rows[1], *t))).collect())
    }

    /// Returns time and channels of a run.
    fn rows(
        &self,
        place: &[f64],
        further: &[(String, String)],
        channels: &[&str],
    ) -> Result<Vec<Vec<f64>>, FitError> {
        let job = self.variant(place, further)?;
        let outcome = job.run(&());
        if let Some(error) = &outcome.error {
            return Err(FitError::Variant(error.to_string()));
        }
        let series = &outcome.kept.series;
        let columns = channels.iter().map(|name| series.named(name).to_vec());
        Ok([series.time().to_vec()].into_iter().chain(columns).collect())
    }
}

/// Returns the forces of a contact moved along the loop around its initial position, in the second cycle.
fn along(job: &Job, contact: usize, data: &Data) -> Result<Vec<f64>, FitError> {
    let stopped = |error: &dyn ToString| FitError::Variant(error.to_string());
    let (_, law) = job.model.contacts().nth(contact).ok_or_else(|| stopped(&"the contact does not exist"))?;
    let memory = job.start.memories().get(contact).cloned();
    let mut memory = memory.ok_or_else(|| stopped(&"the contact has no memory"))?;
    let count = f64::from(job.count(contact));
    let start = memory.apex();
    let (low, high) = extent(&data.u);
    let middle = 0.5 * (low + high);
    let mut forces = Vec::with_capacity(data.u.len());
    for round in 0..2 {
        for u in &data.u {
            let at = Apex { d: start.d, u: start.u + u - middle };
            if round == 1 {
                forces.push(count * memory.force(law, at));
            }
            memory.commit(law, Segment::Straight(at)).map_err(|error| stopped(&error))?;
        }
    }
    Ok(forces)
}

/// Returns whether a body follows a waveform.
fn is_led(job: &Job, body: &str) -> bool {
    let tree: Value = serde_json::from_str(&job.resolved).unwrap_or_default();
    tree["bodies"][body]["x"].get("follows").is_some()
}

/// Returns a linearly interpolated value.
fn at(t: &[f64], values: &[f64], time: f64) -> f64 {
    let Some(last) = t.len().checked_sub(1) else { return f64::NAN };
    let after = t.partition_point(|t| *t < time).clamp(1.min(last), last);
    let before = after.saturating_sub(1);
    let width = t[after] - t[before];
    let share = if width > 0.0 { ((time - t[before]) / width).clamp(0.0, 1.0) } else { 1.0 };
    values[before] + share * (values[after] - values[before])
}
