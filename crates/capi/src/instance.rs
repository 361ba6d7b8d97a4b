//! A simulation as a host sees it: variables by number, parameters before the start, steps, and a state that can be saved.

use std::collections::HashMap;
use std::sync::Arc;
use stickslip_drive::inputs::Input;
use stickslip_drive::{Entry, EventKind, Record, Wants};
use stickslip_run::interface::{Role, Variable, variables};
use stickslip_run::{Job, Simulation, SimulationError};
use stickslip_scenario::{Parameter, Scenario};

/// First bytes of a saved state.
const MARK: &[u8; 8] = b"stksl\x01\0\0";
/// Largest distance of the start of a step from the time reached: a part of the time, and a part of the step.
const NEAR: [f64; 2] = [1e-9, 1e-6];

/// A simulation from its creation to its end.
pub(crate) struct Instance {
    /// Job with the parameters and initial inputs of the scenario.
    given: Arc<Job>,
    pub(crate) variables: Vec<Variable>,
    /// Indices of the variables by their references.
    places: HashMap<u32, usize>,
    /// Values of the parameters.
    parameters: Vec<f64>,
    /// Values of inputs that have been set, by the index of the input, and whether the run does not know them yet.
    inputs: Vec<Option<(f64, bool)>>,
    /// The run; `None` before the start.
    simulation: Option<Simulation>,
    /// Values of all channels where the run stands; empty if not computed.
    row: Vec<f64>,
}

/// Outcome of a step.
pub(crate) struct Step {
    /// Time reached, s.
    pub(crate) time: f64,
    /// Whether the step ended early, at an event.
    pub(crate) is_early: bool,
}

impl Instance {
    /// Creates an instance from the text of a scenario, which may not name files.
    pub(crate) fn new(text: &str) -> Result<Self, String> {
        let scenario = Scenario::from_str_alone(text, "scenario.json").map_err(|error| error.to_string())?;
        let job = Job::new(scenario, "scenario".to_owned(), "".into()).map_err(|error| error.to_string())?;
        let variables = variables(&job);
        let parameters = variables.iter().filter_map(|variable| match variable.role {
            Role::Parameter(_, value) => Some(value),
            _ => None,
        });
        let inputs = variables.iter().filter_map(|variable| match variable.role {
            Role::Input(index, ..) => Some(index + 1),
            _ => None,
        });
        let inputs = vec![None; inputs.max().unwrap_or(0)];
        Ok(Self {
            parameters: parameters.collect(),
            places: variables.iter().enumerate().map(|(place, it)| (it.reference, place)).collect(),
            variables,
            inputs,
            given: Arc::new(job),
            simulation: None,
            row: Vec::new(),
        })
    }

    pub(crate) fn has_started(&self) -> bool {
        self.simulation.is_some()
    }

    /// Returns the simulated time, s; 0 before the start.
    pub(crate) fn time(&self) -> f64 {
        self.simulation.as_ref().map_or(0.0, |simulation| simulation.held().time())
    }

    /// Returns the variable with a reference.
    pub(crate) fn variable(&self, reference: u32) -> Result<&Variable, String> {
        let found = self.places.get(&reference).and_then(|place| self.variables.get(*place));
        found.ok_or_else(|| format!("there is no variable with the reference {reference}"))
    }

    /// Returns the value of a variable. Outputs before the start are those of the start with the present parameters.
    pub(crate) fn get(&mut self, reference: u32) -> Result<f64, String> {
        if reference == 0 {
            return Ok(self.time());
        }
        match self.variable(reference)?.role {
            Role::Output(place, _) => {
                if self.row.is_empty() {
                    let begun = if self.has_started() { None } else { Some(self.begun()?) };
                    let run = begun.as_ref().or(self.simulation.as_ref());
                    self.row = run.map(|simulation| simulation.held().row()).unwrap_or_default();
                }
                self.row.get(place).copied().ok_or_else(|| format!("there is no column {place}"))
            }
            Role::Input(index, initial, _) => {
                let known = self.simulation.as_ref().map_or(initial, |run| run.input(index));
                Ok(self.inputs[index].map_or(known, |(value, _)| value))
            }
            Role::Parameter(index, _) => Ok(self.parameters[index]),
        }
    }

    /// Sets an input, or before the start a parameter.
    pub(crate) fn set(&mut self, reference: u32, value: f64) -> Result<(), String> {
        let Variable { name, role, unit, .. } = self.variable(reference)?;
        match role {
            Role::Output(..) => Err(format!("{name} is an output and cannot be set")),
            Role::Input(index, _, takes) if takes.has(value) => {
                let index = *index;
                self.inputs[index] = Some((value, true));
                if !self.has_started() {
                    self.row.clear();
                }
                Ok(())
            }
            Role::Input(_, _, takes) => {
                Err(format!("{name}: expected {takes} {unit}, got {value}").replace(" , got", ", got"))
            }
            Role::Parameter(..) if self.has_started() => {
                Err(format!("{name} is a parameter: it can be set before the start only"))
            }
            Role::Parameter(..) if !value.is_finite() => {
                Err(format!("{name}: expected a number, got {value}"))
            }
            Role::Parameter(index, _) => {
                let index = *index;
                self.parameters[index] = value;
                self.row.clear();
                Ok(())
            }
        }
    }

    /// Starts the run with the parameters and inputs set so far.
    pub(crate) fn start(&mut self) -> Result<(), String> {
        if self.simulation.is_none() {
            self.simulation = Some(self.begun()?);
            self.row.clear();
        }
        Ok(())
    }

    /// Ends the run; parameters and inputs have their initial values again.
    pub(crate) fn reset(&mut self) -> Result<(), String> {
        self.simulation = None;
        self.row.clear();
        self.inputs.iter_mut().for_each(|input| *input = None);
        for variable in &self.variables {
            if let Role::Parameter(index, value) = variable.role {
                self.parameters[index] = value;
            }
        }
        Ok(())
    }

    fn begun(&self) -> Result<Simulation, String> {
        let job = self.job(&self.parameters, |index| self.inputs[index].map(|(value, _)| value))?;
        Simulation::new(job).map_err(|error| error.to_string())
    }

    /// Returns the job with parameters and with initial values of inputs, by their indices.
    fn job(&self, parameters: &[f64], starts: impl Fn(usize) -> Option<f64>) -> Result<Arc<Job>, String> {
        let mut set = Vec::new();
        for variable in &self.variables {
            match variable.role {
                Role::Parameter(index, value) if parameters[index].to_bits() != value.to_bits() => {
                    let path = self.given.interface.parameters[index].path.clone();
                    set.push((path, format!("{:e}", parameters[index])));
                }
                Role::Input(index, initial, _) => match starts(index) {
                    Some(value) if value != initial => {
                        set.extend(self.initial_path(index).map(|path| (path, format!("{value:e}"))));
                    }
                    _ => {}
                },
                _ => {}
            }
        }
        if set.is_empty() {
            return Ok(Arc::clone(&self.given));
        }
        self.given.with(&set).map(Arc::new).map_err(|error| error.to_string())
    }

    /// Returns the key path of the initial value of an input; `None` for commands of generators, which act from the first step on.
    fn initial_path(&self, index: usize) -> Option<String> {
        let scene = &self.given.scenario.scene;
        let inputs = stickslip_drive::inputs::inputs(scene);
        let input = inputs.get(index).filter(|input| !input.is_command())?;
        Some(format!("waveforms.{}.input.initial", input.name))
    }

    /// Advances from a time by a step, s. With `stops`, the step ends early where gross slip begins or ends.
    pub(crate) fn step(&mut self, t: f64, step: f64, stops: bool) -> Result<Step, String> {
        if !(t.is_finite() && step.is_finite() && step >= 0.0) {
            return Err(format!(
                "expected a step of at least 0 s from a finite time, got {step} s from {t} s"
            ));
        }
        let now = self.time();
        if (t - now).abs() > NEAR[0] * t.abs() + NEAR[1] * step {
            return Err(format!("expected a step from {now} s, where the run stands, got one from {t} s"));
        }
        self.advance(t + step, stops)
    }

    /// Advances to a time, s.
    pub(crate) fn advance(&mut self, until: f64, stops: bool) -> Result<Step, String> {
        let Some(simulation) = &mut self.simulation else {
            return Err("the simulation has not been started".to_owned());
        };
        // A time that is before the present one by rounding only is the present one.
        let now = simulation.held().time();
        let until = if until < now && now - until <= NEAR[0] * now { now } else { until };
        let inputs = self.inputs.iter().enumerate();
        let values: Vec<(usize, f64)> = inputs
            .filter_map(|(index, input)| input.filter(|(_, is_new)| *is_new).map(|(value, _)| (index, value)))
            .filter(|(index, _)| until > now || !simulation.inputs()[*index].is_led())
            .collect();
        self.row.clear();
        let mut first = First { after: now, at: None };
        let before = stops.then(|| simulation.to_bytes());
        let moved = match &before {
            Some(_) => simulation.advance(until, &values, &mut first),
            None => simulation.advance(until, &values, &mut ()),
        };
        let words = |error: SimulationError| error.to_string();
        let event = first.at.filter(|at| *at < until);
        if let (Some(event), Some(before)) = (event, before) {
            // The same way again, up to the event. A linear input is there on its way.
            *simulation = simulation.restored(&before).map_err(|error| error.to_string())?;
            let share = (event - now) / (until - now);
            let on_the_way = |(index, value): (usize, f64)| {
                let from = simulation.input(index);
                let is_led = simulation.inputs()[index].is_led();
                (index, if is_led { from + share * (value - from) } else { value })
            };
            let values: Vec<_> = values.into_iter().map(on_the_way).collect();
            simulation.advance(event, &values, &mut ()).map_err(words)?;
            return Ok(Step { time: event, is_early: true });
        }
        moved.map_err(words)?;
        for (index, _) in values {
            self.inputs[index] = self.inputs[index].map(|(value, _)| (value, false));
        }
        Ok(Step { time: until, is_early: false })
    }

    /// Returns the values of all channels.
    pub(crate) fn row(&mut self) -> Result<&[f64], String> {
        if self.row.is_empty() {
            let simulation = self.simulation.as_ref().ok_or("the simulation has not been started")?;
            self.row = simulation.held().row();
        }
        Ok(&self.row)
    }

    pub(crate) fn channels(&self) -> usize {
        self.given.model.channels().len()
    }

    /// Returns all that the future depends on, as bytes.
    pub(crate) fn save(&self) -> Vec<u8> {
        let mut bytes = MARK.to_vec();
        let mut put = |number: f64| bytes.extend(number.to_le_bytes());
        self.parameters.iter().for_each(|value| put(*value));
        for input in &self.inputs {
            let (value, is_new) = input.unwrap_or((f64::NAN, false));
            put(value);
            put(f64::from(u8::from(is_new)));
        }
        // Initial values of inputs are numbers of the job that the run was started with.
        if let Some(simulation) = &self.simulation {
            let starts = simulation.inputs().iter().map(|input| input.initial);
            starts.take(self.inputs.len()).for_each(&mut put);
            bytes.extend(simulation.to_bytes());
        }
        bytes.extend(crc32fast::hash(&bytes).to_le_bytes());
        bytes
    }

    /// Continues from the bytes of [`Self::save`], also in another process. After an error nothing has changed.
    pub(crate) fn restore(&mut self, bytes: &[u8]) -> Result<(), String> {
        let damaged = || "the state is damaged, or that of another version of the program".to_owned();
        let (rest, sum) = bytes.split_last_chunk::<4>().ok_or_else(damaged)?;
        let rest = rest.strip_prefix(MARK).ok_or_else(damaged)?;
        if crc32fast::hash(&bytes[..bytes.len() - 4]) != u32::from_le_bytes(*sum) {
            return Err(damaged());
        }
        let count = self.parameters.len() + 2 * self.inputs.len();
        let other = || "the state is that of another scenario".to_owned();
        let (head, rest) = rest.split_at_checked(8 * count).ok_or_else(other)?;
        let head: Vec<f64> = numbers(head).collect();
        let (parameters, inputs) = head.split_at(self.parameters.len());
        let inputs = inputs.chunks(2).map(|pair| match pair {
            [value, is_new] if value.is_finite() => Some((*value, *is_new != 0.0)),
            _ => None,
        });
        let inputs: Vec<Option<(f64, bool)>> = inputs.collect();
        let simulation = if rest.is_empty() {
            None
        } else {
            let (starts, run) = rest.split_at_checked(8 * self.inputs.len()).ok_or_else(other)?;
            let starts: Vec<f64> = numbers(starts).collect();
            // The job of the run is the right one, unless parameters or initial inputs differ.
            let running = self.simulation.as_ref();
            let running = running.filter(|running| is_of(running.held().job(), parameters, &starts));
            let restored = match running {
                Some(running) => running.restored(run),
                None => Simulation::from_bytes(self.job(parameters, |index| Some(starts[index]))?, run),
            };
            Some(restored.map_err(|error| error.to_string())?)
        };
        (self.parameters, self.inputs, self.simulation) = (parameters.to_vec(), inputs, simulation);
        self.row.clear();
        Ok(())
    }
}

/// Returns whether a job has these parameters and initial values of inputs.
fn is_of(job: &Job, parameters: &[f64], starts: &[f64]) -> bool {
    let inputs = stickslip_drive::inputs::inputs(&job.scenario.scene);
    let is_start = |(start, input): (&f64, &Input)| start.to_bits() == input.initial.to_bits();
    let is_value = |(value, known): (&f64, &Parameter)| known.value.is_some_and(|known| known == *value);
    starts.iter().zip(&inputs).all(is_start) && parameters.iter().zip(&job.interface.parameters).all(is_value)
}

/// Returns the numbers in little-endian bytes.
fn numbers(bytes: &[u8]) -> impl Iterator<Item = f64> {
    bytes.chunks_exact(8).map(|bytes| bytes.try_into().map_or(f64::NAN, f64::from_le_bytes))
}

/// Notes the first event after a time at which gross slip begins or ends.
struct First {
    after: f64,
    at: Option<f64>,
}

impl Record for First {
    fn take(&mut self, entry: Entry<'_>) {
        if let Entry::Event(event, _) = entry {
            use EventKind::{BreaksLoose, GrossSlip, GrossSlipEnds, SticksAgain};
            let slips = matches!(event.kind, BreaksLoose | GrossSlip | GrossSlipEnds | SticksAgain);
            // An event at which the last step ended may come again within rounding.
            if self.at.is_none() && slips && event.t > self.after * (1.0 + 4.0 * f64::EPSILON) {
                self.at = Some(event.t);
            }
        }
    }

    fn wants(&self) -> Wants {
        Wants::bare_events()
    }
}
