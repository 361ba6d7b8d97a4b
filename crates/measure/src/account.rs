//! Evaluation of one drive period: travel of the body in the forward and return strokes, slip and ringing of the contacts, energies.
//!
//! The results of the last whole period and of the current period are kept. Inputs are events, and states at period ends and turning points
//! of the waveform.

mod phases;

pub use phases::{Phases, Sense};

use crate::Setting;
use crate::periods::{Periods, Tracker};
use std::collections::HashMap;
use stickslip_drive::scene::{Freedom, Side};
use stickslip_drive::{EventKind, Source};

/// Amplitude of a force oscillation, relative to the friction limit, above which it counts as ringing.
pub const RINGING: f64 = 0.05;
/// Numbers in the column `state` for an open contact and for gross slip.
const OPEN: f64 = 0.0;
pub(crate) const SLIP: f64 = 3.0;

/// Evaluates the periods of a run.
#[derive(Debug)]
pub struct Accounts {
    phases: Phases,
    tracker: Tracker,
    /// Indices of the channels of the body's x and of the first energy.
    places: [usize; 2],
    contacts: Vec<Watched>,
    /// Last sample: time, s, position x of the body, m, and direction of the waveform after this time.
    last: Option<(f64, f64, Sense)>,
    /// Time of the last turning point of the waveform, and time until which its direction is known, s.
    turned: f64,
    sure_until: f64,
    now: Option<Account>,
    whole: Option<Account>,
}

/// A contact of the body, with the state of its evaluation.
#[derive(Debug)]
struct Watched {
    /// Index of the contact in the model, and channel indices of its tangential force, normal force and state.
    c: usize,
    places: [usize; 3],
    friction: f64,
    /// Kind of the events that report reversals of u.
    turn: &'static str,
    slips: bool,
    /// Tangential force at the last reversal of u or at the last onset or end of gross slip.
    extreme: Option<Extreme>,
}

/// Extreme of the tangential force of a contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Extreme {
    /// Time, s.
    pub t: f64,
    /// Tangential force, N.
    pub force: f64,
    /// Friction limit at this time, N.
    pub limit: f64,
}

/// Results of one period. In pairs, the first value is for the rising and the second for the falling waveform.
#[derive(Debug, Clone, PartialEq)]
pub struct Account {
    /// Start and end of the period, s.
    pub span: [f64; 2],
    /// Durations, s.
    pub time: [f64; 2],
    /// Displacement of the body, m. The third value is for intervals with a constant waveform.
    pub travel: [f64; 3],
    /// Changes of input, kinetic, elastic, friction and damping energy, J. In the current period: their values at its start.
    pub energies: [f64; 5],
    /// Results of each contact.
    pub contacts: Vec<ContactAccount>,
}

/// Results of one contact in a period. In pairs, the first value is for the rising and the second for the falling waveform.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ContactAccount {
    /// Index of the contact in the model.
    pub c: usize,
    /// Time in gross slip, s.
    pub slip: [f64; 2],
    /// Number of reversals of the displacement u, without reversals that end gross slip.
    pub reversals: [u32; 2],
    /// Time from the turning point of the waveform to the last force oscillation above [`RINGING`], s. `None` without such an oscillation.
    pub rings: [Option<f64>; 2],
    /// Amplitude of the last oscillation of the tangential force, relative to the mean friction limit at its two extremes.
    pub swing: [f64; 2],
    /// The two extremes of the last force oscillation.
    pub turns: [Option<[Extreme; 2]>; 2],
}

/// Returns the index of a direction in the pairs of results. Returns `None` for a constant waveform.
fn side(sense: Sense) -> Option<usize> {
    match sense {
        Sense::Rising => Some(0),
        Sense::Falling => Some(1),
        Sense::Resting => None,
    }
}

impl Accounts {
    /// Creates the evaluation for the body and the waveform of the scenario's `figures`.
    ///
    /// Returns `None` if the body is not free or the waveform is not periodic. `places` contains the channel indices by name.
    pub fn of(setting: &Setting, places: &HashMap<&str, usize>) -> Option<Self> {
        let (scene, figures) = (&setting.scenario.scene, setting.scenario.figures);
        let b = figures.body?;
        let body = scene.bodies.get(b).filter(|body| body.part.x.freedom == Freedom::Free)?;
        let waveform = &scene.waveforms.get(figures.waveform?)?.part;
        let place = |name: String| places.get(name.as_str()).copied();
        let touching = scene.contacts.iter().zip(setting.model.contacts()).enumerate();
        let touching = touching.filter(|(_, (it, _))| it.part.between.contains(&Side::Body(b)));
        let contacts = touching.filter_map(|(c, (_, (name, law)))| {
            let [force, normal, state] =
                ["fx_N", "fn_N", "state"].map(|column| place(format!("{name}.{column}")));
            let places = [force?, normal?, state?];
            let turn = if setting.model.tells_turns(setting.scenario.plan.stepper, c) {
                EventKind::Turn
            } else {
                EventKind::Reversal
            };
            let (friction, turn) = (law.friction(), turn.name());
            Some(Watched { c, places, friction, turn, slips: false, extreme: None })
        });
        Some(Self {
            phases: Phases::of(waveform)?,
            tracker: Tracker::new(Periods::until(waveform, f64::INFINITY)?),
            places: [place(format!("{}.x_m", body.name))?, place("energy.input_J".to_owned())?],
            contacts: contacts.collect(),
            last: None,
            turned: 0.0,
            sure_until: f64::NEG_INFINITY,
            now: None,
            whole: None,
        })
    }

    /// Adds a sample: the channel values at an event or at a sampling time.
    pub fn moment(&mut self, event: Option<(Source, &str)>, values: &[f64]) {
        let [place, energies] = self.places;
        let (Some(&t), Some(&x), Some(books)) =
            (values.first(), values.get(place), values.get(energies..).and_then(<[f64]>::first_chunk::<5>))
        else {
            return;
        };
        let sense = self.sense_after(t);
        match self.last {
            Some((before, x_before, way)) => {
                self.pass(t - before, x - x_before, way);
                if way != sense {
                    self.turned = t;
                }
            }
            None => {
                self.turned = t;
                // A contact that slips from the start of the run has no event at the onset of slip.
                for contact in &mut self.contacts {
                    contact.slips = values.get(contact.places[2]) == Some(&SLIP);
                }
            }
        }
        self.last = Some((t, x, sense));
        match self.tracker.pass(t) {
            Some(0) => self.begin(t, books),
            Some(_) => self.end(t, books),
            None => {}
        }
        if let Some((Source::Contact(c), kind)) = event {
            self.event((c, kind), (t, sense), values);
        }
    }

    /// Returns the direction of the waveform after time t, s. Times must ascend, because the result is cached until the next turning point.
    fn sense_after(&mut self, t: f64) -> Sense {
        if let Some((_, _, sense)) = self.last.filter(|_| t < self.sure_until) {
            return sense;
        }
        let (sense, until) = self.phases.sense_after(t);
        self.sure_until = until;
        sense
    }

    /// Adds a time interval of length `time`, s, in which the body moved by `way`, m.
    fn pass(&mut self, time: f64, way: f64, sense: Sense) {
        let Some(now) = &mut self.now else { return };
        let side = side(sense);
        now.travel[side.unwrap_or(2)] += way;
        let Some(side) = side else { return };
        now.time[side] += time;
        for (account, contact) in now.contacts.iter_mut().zip(&self.contacts) {
            account.slip[side] += if contact.slips { time } else { 0.0 };
        }
    }

    fn begin(&mut self, t: f64, books: &[f64; 5]) {
        let contacts = self.contacts.iter().map(|it| ContactAccount { c: it.c, ..Default::default() });
        self.now = Some(Account {
            span: [t; 2],
            time: [0.0; 2],
            travel: [0.0; 3],
            energies: *books,
            contacts: contacts.collect(),
        });
    }

    fn end(&mut self, t: f64, books: &[f64; 5]) {
        if let Some(mut account) = self.now.take() {
            account.span[1] = t;
            for (energy, now) in account.energies.iter_mut().zip(books) {
                *energy = now - *energy;
            }
            self.whole = Some(account);
        }
        self.begin(t, books);
    }

    fn event(&mut self, (c, kind): (usize, &str), (t, sense): (f64, Sense), values: &[f64]) {
        let Some(k) = self.contacts.iter().position(|it| it.c == c) else { return };
        let contact = &mut self.contacts[k];
        let [force, normal, state] = contact.places.map(|place| values.get(place).copied().unwrap_or(0.0));
        let is = |others: &[EventKind]| others.iter().any(|other| kind == other.name());
        let begins = is(&[EventKind::GrossSlip, EventKind::BreaksLoose]);
        let ends = is(&[EventKind::GrossSlipEnds, EventKind::SticksAgain]);
        let opens = is(&[EventKind::LiftOff]);
        // An open contact has no reversals. A reversal that ends gross slip is not counted.
        let has_turned = kind == contact.turn && state != OPEN;
        let turns = has_turned && !contact.slips;
        // The kind of an event decides on gross slip, because the state in its row may be that before or after the event. Only a contact
        // that slips from its touch on has no other event.
        contact.slips = match () {
            () if begins => true,
            () if ends || opens || kind == EventKind::FullStick.name() => false,
            () if kind == EventKind::Touch.name() => state == SLIP,
            () => contact.slips,
        };
        if !(begins || ends || opens || has_turned) {
            return;
        }
        // The force also has an extreme where gross slip begins or ends.
        let now = Extreme { t, force, limit: contact.friction * normal };
        let before = contact.extreme.replace(now);
        let (Some(account), Some(side)) =
            (self.now.as_mut().and_then(|it| it.contacts.get_mut(k)), side(sense))
        else {
            return;
        };
        if turns {
            account.reversals[side] += 1;
            account.swing[side] = before.map_or(0.0, |before| swing(&before, &now));
            account.turns[side] = before.map(|before| [before, now]);
            if account.swing[side] > RINGING {
                account.rings[side] = Some(t - self.turned);
            }
        }
    }

    /// Returns the results of the last whole period.
    pub fn last(&self) -> Option<&Account> {
        self.whole.as_ref()
    }

    /// Returns the directions of the waveform over its period.
    pub fn phases(&self) -> &Phases {
        &self.phases
    }
}

/// Returns half the difference of two forces, relative to the mean of the friction limits at both times.
fn swing(from: &Extreme, to: &Extreme) -> f64 {
    let limit = 0.5 * (from.limit + to.limit);
    if limit > 0.0 { 0.5 * (to.force - from.force).abs() / limit } else { 0.0 }
}
