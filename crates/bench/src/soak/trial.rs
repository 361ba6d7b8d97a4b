//! Model of a random scenario, and its runs.

use std::time::Instant;
use stickslip_drive::scene::{Axis, Freedom, Side};
use stickslip_drive::{
    Channel, Counts, Entry, Limits, Model, Plan, Record, RunError, Scene, SceneError, State, Stepper, Wants,
};

/// Wall time after which a run counts as hung, s.
pub(crate) const PATIENCE: f64 = 20.0;

/// Model with the evaluated columns of its runs.
pub(crate) struct Trial {
    pub(crate) scene: Scene,
    pub(crate) model: Model,
    pub(crate) plan: Plan,
    /// Evaluated columns, and the natural unit of each.
    looks: Vec<(usize, f64)>,
    names: Vec<String>,
    /// Columns of input, kinetic, elastic and friction energy, damping and error.
    energies: [usize; 6],
    width: usize,
}

/// Result of a run.
#[derive(Clone)]
pub(crate) struct Ran {
    pub(crate) error: Option<RunError>,
    /// Values of the evaluated columns in natural units, row by row.
    pub(crate) rows: Vec<f64>,
    /// Largest error of the energy balance, J, and the energy throughput. The throughput is the largest of input, kinetic energy, change
    /// of elastic energy and heat, but at least the work of gross slip.
    pub(crate) books: (f64, f64),
    pub(crate) counts: Counts,
    /// Wall time, s.
    pub(crate) wall: f64,
}

impl Trial {
    pub(crate) fn new(scene: Scene, plan: Plan) -> Result<Self, SceneError> {
        let model = Model::new(&scene)?;
        // Detects all errors of the model before a run.
        model.start(&plan)?;
        let channels = model.channels();
        let place = |name: &str| channels.iter().position(|channel| channel.name == name).unwrap_or(0);
        let energies = ["input", "kinetic", "elastic", "friction", "damping", "error"]
            .map(|name| place(&format!("energy.{name}_J")));
        let looked = looks(&scene, &model, &channels);
        let names = looked.iter().map(|(place, _)| channels[*place].name.clone()).collect();
        let limits = Limits { wall: Some(PATIENCE), ..plan.limits };
        let plan = Plan { limits, ..plan };
        Ok(Self { scene, model, plan, looks: looked, names, energies, width: channels.len() })
    }

    /// Runs the model with a stepper.
    pub(crate) fn run(&self, stepper: Stepper) -> Result<Ran, SceneError> {
        let plan = Plan { stepper, ..self.plan };
        let mut state = self.model.start(&plan)?;
        Ok(self.run_from(&plan, &mut state))
    }

    fn run_from(&self, plan: &Plan, state: &mut State) -> Ran {
        let mut looked = Looked { trial: self, rows: Vec::new(), before: None, worst: 0.0, throughput: 0.0 };
        let begun = Instant::now();
        let result = stickslip_drive::run(&self.model, plan, state, &mut looked);
        let wall = begun.elapsed().as_secs_f64();
        let books = (looked.worst, looked.throughput.max(self.work()));
        Ran { error: result.err(), books, rows: looked.rows, counts: state.counts(), wall }
    }

    /// Returns the natural scale of work, J: μF_N u_c of the smallest contact, or 0 without friction.
    fn work(&self) -> f64 {
        let scales = (0..self.scene.contacts.len()).filter_map(|c| self.model.contact_natural(c));
        let works = scales.map(|scale| scale.force * scale.displacement).filter(|work| *work > 0.0);
        works.reduce(f64::min).unwrap_or(0.0)
    }

    /// Returns the largest difference of two runs in natural units.
    pub(crate) fn apart(&self, a: &Ran, b: &Ran) -> Apart<'_> {
        let mut most = Apart { by: 0.0, name: "", share: 0.0 };
        if a.rows.len() != b.rows.len() {
            return Apart { by: f64::INFINITY, name: "rows", share: 0.0 };
        }
        let width = self.looks.len().max(1);
        for (i, (x, y)) in a.rows.iter().zip(&b.rows).enumerate() {
            let by = (x - y).abs();
            // A NaN must not count as a small difference.
            if by.is_nan() || by > most.by {
                let by = if by.is_nan() { f64::INFINITY } else { by };
                let share = (i / width) as f64 / (a.rows.len() / width).max(1) as f64;
                most = Apart { by, name: self.names.get(i % width).map_or("", |name| name), share };
            }
        }
        most
    }

    /// Returns the model with a perturbed start: positions and velocities change by a fraction of natural lengths and velocities. If the
    /// run starts from an equilibrium, loads change by this fraction of the friction limit.
    pub(crate) fn nudged(&self, part: f64) -> Result<Self, SceneError> {
        let mut scene = self.scene.clone();
        let settled = scene.start == stickslip_drive::scene::Start::Equilibrium;
        for body in 0..scene.bodies.len() {
            let Some(scale) = self.scale(body) else { continue };
            if settled {
                if scene.bodies[body].part.x.freedom == Freedom::Free {
                    let x = stickslip_drive::scene::Varying::Constant(part * scale.force);
                    scene.loads.push(stickslip_drive::scene::Load { on: body, x, ..Default::default() });
                }
                continue;
            }
            let part_of = &mut scene.bodies[body].part;
            for (coordinate, length) in [(&mut part_of.x, scale.along), (&mut part_of.z, scale.deep)] {
                if coordinate.freedom == Freedom::Free {
                    coordinate.position += part * length;
                    coordinate.velocity += part * length * scale.frequency;
                }
            }
        }
        Self::new(scene, self.plan)
    }

    /// Returns the rounding error of the largest stroke, relative to the smallest natural length along the slide. This error limits the
    /// attainable accuracy.
    pub(crate) fn rounding(&self) -> f64 {
        let stroke = |freedom: Freedom| match freedom {
            Freedom::Follows(w) => self.scene.waveforms.get(w).map(|w| w.part.range().1 - w.part.range().0),
            _ => None,
        };
        let coordinates = self.scene.bodies.iter().flat_map(|body| body.part.coordinates());
        let widest = coordinates.filter_map(|(_, c)| stroke(c.freedom)).fold(0.0, f64::max);
        let lengths =
            (0..self.scene.bodies.len()).filter_map(|body| self.scale(body)).map(|scale| scale.along);
        f64::EPSILON * widest / lengths.fold(f64::INFINITY, f64::min)
    }

    /// Returns the natural scales of a body: the scales of its most sensitive contact.
    fn scale(&self, body: usize) -> Option<Scale> {
        scale(&self.scene, &self.model, body)
    }
}

/// Difference of two runs.
pub(crate) struct Apart<'a> {
    /// Difference in natural units.
    pub(crate) by: f64,
    /// Name of the channel.
    pub(crate) name: &'a str,
    /// Time of the difference relative to the duration.
    pub(crate) share: f64,
}

/// Natural scales of a body.
#[derive(Debug, Clone, Copy)]
struct Scale {
    /// Natural length along x, m.
    along: f64,
    /// Natural length along z, m.
    deep: f64,
    /// Friction limit, N; without friction the normal force.
    force: f64,
    /// Angular frequency, rad/s.
    frequency: f64,
    /// Distance of the farthest contact point, m.
    arm: f64,
}

/// Returns the natural scales of a body. Along the slide the scale is u_c, but at most the larger of stroke and indentation. Without
/// friction the scale is the indentation.
fn scale(scene: &Scene, model: &Model, body: usize) -> Option<Scale> {
    let widest = scene.waveforms.iter().map(|w| w.part.range().1 - w.part.range().0).fold(0.0, f64::max);
    let mut least: Option<Scale> = None;
    for (c, named) in scene.contacts.iter().enumerate() {
        let contact = &named.part;
        let Some(side) = contact.between.iter().position(|side| *side == Side::Body(body)) else { continue };
        let (Some(natural), Some(frequency)) = (model.contact_natural(c), model.contact_frequency(c)) else {
            continue;
        };
        let (law, slope) = (&contact.interface, contact.interface.stick_slope());
        let deep = if slope > 0.0 {
            natural.displacement / slope
        } else {
            law.profile().depth(0.5 * model.contact_width(c).unwrap_or(0.0))
        };
        if deep.is_nan() || deep <= 0.0 {
            continue;
        }
        let slip = if slope > 0.0 { natural.displacement } else { deep };
        let along = if widest > 0.0 && slope > 0.0 { slip.min(widest.max(deep)) } else { slip };
        let force = if natural.force > 0.0 { natural.force } else { law.normal_force(deep) };
        let arm = math::hypot(contact.at[side].x, contact.at[side].z);
        let this = Scale { along, deep, force, frequency, arm };
        least = Some(least.map_or(this, |known| Scale {
            along: known.along.min(along),
            deep: known.deep.min(deep),
            force: known.force.min(force),
            frequency: known.frequency.max(frequency),
            arm: known.arm.max(arm),
        }));
    }
    least
}

/// Returns the columns of free coordinates with their natural units; without free coordinates, the columns of tangential forces.
fn looks(scene: &Scene, model: &Model, channels: &[Channel]) -> Vec<(usize, f64)> {
    let place = |name: String| channels.iter().position(|channel| channel.name == name);
    let mut looks = Vec::new();
    for (body, named) in scene.bodies.iter().enumerate() {
        let unit = scale(scene, model, body);
        let all = unit.map_or(1e-6, |unit| unit.along);
        for (axis, coordinate) in named.part.coordinates() {
            let (quantity, unit) = match (axis, unit) {
                (Axis::X, _) => ("x_m", all),
                (Axis::Z, unit) => ("z_m", unit.map_or(all, |unit| unit.deep)),
                (Axis::Pitch, unit) => {
                    ("pitch_rad", unit.map_or(1e-6, |unit| unit.deep.min(unit.along) / unit.arm.max(1e-6)))
                }
            };
            if coordinate.freedom == Freedom::Free {
                looks.extend(place(format!("{}.{quantity}", named.name)).map(|place| (place, unit)));
            }
        }
    }
    if looks.is_empty() {
        for (c, named) in scene.contacts.iter().enumerate() {
            let limit = model.contact_natural(c).map_or(0.0, |natural| natural.force);
            let unit = if limit > 0.0 { limit * f64::from(named.part.count) } else { 1.0 };
            looks.extend(place(format!("{}.fx_N", named.name)).map(|place| (place, unit)));
        }
    }
    looks
}

/// Recorder of the evaluated columns.
struct Looked<'a> {
    trial: &'a Trial,
    rows: Vec<f64>,
    /// Initial elastic energy, J.
    before: Option<f64>,
    worst: f64,
    throughput: f64,
}

impl Record for Looked<'_> {
    fn take(&mut self, entry: Entry<'_>) {
        if let Entry::Row(values) = entry {
            if values.len() < self.trial.width {
                return;
            }
            self.rows.extend(self.trial.looks.iter().map(|(place, unit)| values[*place] / unit));
            let [input, kinetic, elastic, friction, damping, error] =
                self.trial.energies.map(|place| values[place]);
            let before = *self.before.get_or_insert(elastic);
            let flows = [input.abs(), kinetic, (elastic - before).abs(), friction + damping];
            self.throughput = flows.into_iter().fold(self.throughput, f64::max);
            // Rounding errors of the elastic energy do not count, because for a body at rest all other energies are 0.
            let rounding = 4.0 * f64::EPSILON * elastic.abs();
            if error.is_nan() || error.abs() > self.worst.max(rounding) {
                self.worst = error.abs();
            }
        }
    }

    fn wants(&self) -> Wants {
        Wants::no_events()
    }
}
