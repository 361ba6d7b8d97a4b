//! What variations tell of figures.

use super::course::{BEGINNING, END, FIRST, LAST};
use super::turning::Turn;
use super::{Known, Led, Look, Pass};
use crate::sensitivity::figure::{Figure, Reading};
use crate::steady::Steady;
use stickslip_drive::EnergyRates;
use stickslip_drive::scene::{Axis, Freedom, Normal, Varying};
use stickslip_run::Job;
use stickslip_run::summary::load;

/// What a variation tells of a figure.
#[derive(Debug, Clone, Copy)]
pub(super) enum Told {
    /// A coordinate of a body at the end of the run, or its rate.
    End {
        body: usize,
        axis: Axis,
        is_rate: bool,
    },
    /// How far the figures' body comes in the last whole period.
    Last,
    /// The same in the mean of all whole periods, over their time.
    MeanSpeed,
    /// The same in the whole run.
    Travel,
    /// An energy at the end of the run.
    Energy(Energy),
    /// What becomes of one in the last whole period.
    Work(Energy),
    /// What the drive puts in then, what of it goes into the load on the body, and that as a share of it.
    Drive,
    Load,
    Efficiency,
    /// The last swing of the force of a contact then, as a share of the limit of friction, between two turns.
    Ringing {
        contact: usize,
        /// Whether what presses the contact varies.
        varies: bool,
    },
    /// Step of steady motion.
    SteadyStep,
    /// Its speed.
    SteadySpeed,
}

/// One of the energies.
type Energy = fn(&EnergyRates) -> f64;

/// Energies by their names.
const ENERGIES: [(&str, Energy); 5] = [
    ("input_J", |it| it.input),
    ("kinetic_J", |it| it.kinetic),
    ("elastic_J", |it| it.elastic),
    ("friction_J", |it| it.friction),
    ("damping_J", |it| it.damping),
];
/// Forces nearer to the limit of friction than this, as a share of it, are at it.
const AT_THE_LIMIT: f64 = 1e-9;

impl Told {
    /// Of a figure; none of one that no variation tells.
    pub(super) fn of(job: &Job, figure: &Figure) -> Option<Self> {
        let of_steps = |told: Self| {
            let scene = &job.scenario.scene;
            let body = scene.bodies.get(job.scenario.figures.body?)?;
            (body.part.x.freedom == Freedom::Free).then_some(told)
        };
        let told = match (figure.reading, figure.name.as_str()) {
            (Reading::SteadyStep, _) => of_steps(Self::SteadyStep),
            (Reading::SteadySpeed, _) => of_steps(Self::SteadySpeed),
            (Reading::Summary, "steps.last_m") => of_steps(Self::Last),
            (Reading::Summary, "steps.mean_speed_m_s") => of_steps(Self::MeanSpeed),
            (Reading::Summary, "steps.net_travel_m") => of_steps(Self::Travel),
            (Reading::Summary, name) => match name.strip_prefix("steps.last_period.") {
                Some(name) => Self::period(job, name),
                None => energy(name.strip_prefix("energy.")?).map(Self::Energy),
            },
            (Reading::End, name) => match name.strip_prefix("energy.") {
                Some(name) => energy(name).map(Self::Energy),
                None => Self::channel(job, name),
            },
        };
        // What jumps put in is not led along.
        told.filter(|told| !told.is_energy() || !job.model.jumps())
    }

    /// What is told of the last whole period.
    fn period(job: &Job, name: &str) -> Option<Self> {
        if let Some(work) = name.strip_prefix("work.") {
            return match work {
                "drive_J" => Some(Self::Drive),
                "load_J" => Some(Self::Load),
                "efficiency" => Some(Self::Efficiency),
                "stored_J" => Some(Self::Work(|it| it.kinetic + it.elastic)),
                "friction_J" | "damping_J" => energy(work).map(Self::Work),
                _ => None,
            };
        }
        let named = name.strip_prefix("contacts.")?.strip_suffix(".ringing_left")?;
        let contact = job.model.contacts().position(|(name, _)| name == named)?;
        let part = &job.scenario.scene.contacts.get(contact)?.part;
        let varies = match part.normal {
            Normal::Force(by) | Normal::Indentation(by) | Normal::Radius(by) => {
                matches!(by, Varying::Follows(_))
            }
            Normal::Coupled => true,
        };
        Some(Self::Ringing { contact, varies })
    }

    /// A free coordinate at the end, or its rate, by the name of its channel.
    fn channel(job: &Job, name: &str) -> Option<Self> {
        let bodies = job.scenario.scene.bodies.iter().enumerate();
        bodies
            .filter_map(|(body, named)| {
                let channel = name.strip_prefix(named.name.as_str())?.strip_prefix('.')?;
                let mut coordinates =
                    named.part.coordinates().into_iter().filter(|(_, it)| it.freedom == Freedom::Free);
                coordinates.find_map(|(axis, _)| {
                    let (unit, key) = (if axis == Axis::Pitch { "rad" } else { "m" }, axis.key());
                    let is_rate = channel == format!("v{key}_{unit}_s");
                    (is_rate || channel == format!("{key}_{unit}")).then_some(Self::End {
                        body,
                        axis,
                        is_rate,
                    })
                })
            })
            .next()
    }

    /// What figure `f` changes by with a share of quantity `j`; not a number where it is not told.
    pub(super) fn slope(self, f: usize, (run, known, j): (&Led, &Known, usize), pass: &Pass<'_>) -> f64 {
        let Led { course, looks, .. } = run;
        let moves = &known.moves;
        let place = |moment: usize| {
            let place = looks[moment].places[f].as_ref();
            place.map_or(f64::NAN, |place| place.moved[j].0 + place.rate * moves[moment])
        };
        let [from, to] = LAST;
        // Where the moment moves, a place goes on by its rate, a rate by an acceleration, and an energy by a power.
        let energy = |moment: usize, of: Energy| {
            let look = &looks[moment];
            look.energies[j].as_ref().map_or(f64::NAN, |rates| of(rates) + of(&look.powers) * moves[moment])
        };
        let work = |of: Energy| energy(to, of) - energy(from, of);
        match self {
            Self::End { is_rate: true, .. } => {
                let place = looks[END].places[f].as_ref();
                place.map_or(f64::NAN, |place| place.moved[j].1 + place.acceleration * moves[END])
            }
            Self::End { is_rate: false, .. } => place(END),
            Self::Last => place(to) - place(from),
            Self::MeanSpeed => {
                let (time, longer) = (course.moments[to] - course.moments[FIRST], moves[to] - moves[FIRST]);
                (place(to) - place(FIRST) - pass.values[f] * longer) / time
            }
            Self::Travel => place(END) - place(BEGINNING),
            Self::Energy(of) => energy(END, of),
            Self::Work(of) => work(of),
            Self::Drive | Self::Load | Self::Efficiency => {
                let step = |look: &Look| look.places[f].as_ref().map_or(f64::NAN, |place| place.value);
                let step = step(&looks[to]) - step(&looks[from]);
                let (Some(force), Some(more)) = (load(&pass.job), known.load) else { return f64::NAN };
                let (load, moved) = (-force * step, -more * step - force * (place(to) - place(from)));
                let (input, value) = (work(|it| it.input), pass.values[f]);
                match self {
                    Self::Load => moved,
                    Self::Drive => input + moved,
                    // e = L/(I + L)
                    _ => value / load * ((1.0 - value) * moved - value * input),
                }
            }
            Self::Ringing { .. } => run.turns.swing(f).map_or(f64::NAN, |swing| ringing(swing, j)),
            Self::SteadyStep | Self::SteadySpeed => f64::NAN,
        }
    }

    pub(super) fn is_energy(self) -> bool {
        matches!(self, Self::Energy(_) | Self::Work(_) | Self::Drive | Self::Efficiency)
    }

    pub(super) fn is_steady(self) -> bool {
        matches!(self, Self::SteadyStep | Self::SteadySpeed)
    }

    /// The coordinate that a figure of a run is made of.
    pub(super) fn coordinate(self, job: &Job) -> Option<(usize, Axis)> {
        match self {
            Self::End { body, axis, .. } => Some((body, axis)),
            Self::Last | Self::MeanSpeed | Self::Travel | Self::Drive | Self::Load | Self::Efficiency => {
                Some((job.scenario.figures.body?, Axis::X))
            }
            Self::Energy(_) | Self::Work(_) | Self::Ringing { .. } => None,
            Self::SteadyStep | Self::SteadySpeed => None,
        }
    }

    /// Slope of a figure of steady motion, from that of its step.
    pub(super) fn of_step(self, steady: &Steady, slope: f64) -> f64 {
        match self {
            Self::SteadyStep => slope,
            // The period is the same.
            Self::SteadySpeed => slope / steady.period,
            _ => f64::NAN,
        }
    }
}

/// An energy by its name.
fn energy(name: &str) -> Option<Energy> {
    ENERGIES.into_iter().find(|(known, _)| *known == name).map(|(_, energy)| energy)
}

/// What a swing of the force, half of peak to peak, as a share of the limit of friction, changes by: the force stands still where it
/// turns, and is at the limit where that is so because the contact slips: when, nobody has asked where the limit varies.
fn ringing(swing: &[Turn; 2], j: usize) -> f64 {
    let turn = |turn: &Turn| {
        let (extreme, [force, limit]) = (&turn.extreme, turn.moved.get(j).copied().flatten()?);
        let is_at_it = (extreme.force.abs() - extreme.limit).abs() <= AT_THE_LIMIT * extreme.limit;
        if is_at_it && turn.varies {
            return None;
        }
        Some([if is_at_it { extreme.force.signum() * limit } else { force }, limit])
    };
    let [Some(from), Some(to)] = swing.each_ref().map(turn) else { return f64::NAN };
    let [before, now] = swing.each_ref().map(|turn| turn.extreme);
    let (apart, limit) = (now.force - before.force, 0.5 * (before.limit + now.limit));
    let share = 0.5 * apart.abs() / limit;
    0.5 * apart.signum() * (to[0] - from[0]) / limit - share * 0.5 * (from[1] + to[1]) / limit
}
