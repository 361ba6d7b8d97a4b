//! The account of a period of the drive: where the body went while the waveform went forth and back, how the contacts slipped and
//! rang meanwhile, what became of the work. Of a run of any length that of the last whole period is kept, and of the one under way.
//!
//! What it is taken from are ends of periods and turns of the waveform, which are marks or corners, and events.

mod phases;

pub use phases::{Phases, Sense};

use crate::Setting;
use crate::periods::{Periods, Tracker};
use std::collections::HashMap;
use stickslip_drive::scene::{Freedom, Side};
use stickslip_drive::{EventKind, Source};

/// A swing of the force below this share of the limit of friction is no ringing any more.
pub const RINGING: f64 = 0.05;
/// Codes of an open contact and of gross slip in a row.
const OPEN: f64 = 0.0;
const SLIP: f64 = 3.0;

/// Keeps the accounts of a run.
#[derive(Debug)]
pub struct Accounts {
    phases: Phases,
    tracker: Tracker,
    /// Place of the body's x, and of the first of the energies, among all channels.
    places: [usize; 2],
    contacts: Vec<Watched>,
    /// The last moment: time, s, x, m, and which way the waveform went after it.
    last: Option<(f64, f64, Sense)>,
    /// When the waveform last took the way that it goes, and until when it is sure to go that way, s.
    turned: f64,
    sure_until: f64,
    now: Option<Account>,
    whole: Option<Account>,
}

/// A contact of the body.
#[derive(Debug)]
struct Watched {
    /// Its place in the scene, and those of its force, normal force and state among all channels.
    c: usize,
    places: [usize; 3],
    friction: f64,
    /// The word of the events at which its u turns.
    turn: &'static str,
    slips: bool,
    /// Its force at its last turn.
    extreme: Option<Extreme>,
}

/// Where the force of a contact turns.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Extreme {
    /// Time, s.
    pub t: f64,
    /// The force, N.
    pub force: f64,
    /// The limit of friction then, N.
    pub limit: f64,
}

/// What happened in a period. Of two values the first is of the rising waveform, the second of the falling one.
#[derive(Debug, Clone, PartialEq)]
pub struct Account {
    /// From when until when, s.
    pub span: [f64; 2],
    /// How long, s.
    pub time: [f64; 2],
    /// The way of the body, m; that while the waveform rests last.
    pub travel: [f64; 3],
    /// Input, kinetic, elastic, friction, damping: at its start, and by how much they have grown in it, J.
    pub energies: [f64; 5],
    /// Of each contact.
    pub contacts: Vec<ContactAccount>,
}

/// What a contact of the body did in a period; of two values the first is of the rising waveform.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ContactAccount {
    /// Its place in the scene.
    pub c: usize,
    /// Time in gross slip, s.
    pub slip: [f64; 2],
    /// Turns of u, but for those out of gross slip.
    pub reversals: [u32; 2],
    /// From when the waveform turned, until the last swing of the force beyond [`RINGING`], s; none without such a swing.
    pub rings: [Option<f64>; 2],
    /// The last swing, half of peak to peak, as a share of the limit of friction: the mean of that at both turns.
    pub swing: [f64; 2],
    /// Both turns of that.
    pub turns: [Option<[Extreme; 2]>; 2],
}

/// Which of two values a way has.
fn side(sense: Sense) -> Option<usize> {
    match sense {
        Sense::Rising => Some(0),
        Sense::Falling => Some(1),
        Sense::Resting => None,
    }
}

impl Accounts {
    /// Those of the body and the waveform of a setting's figures; none where no free body is driven by a periodic waveform.
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

    /// Takes a moment: an event, or a mark.
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
                // Of one that slides all the way no event tells.
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

    /// Which way the waveform goes after a moment, s, moments ascending: most events lie between two turns.
    fn sense_after(&mut self, t: f64) -> Sense {
        if let Some((_, _, sense)) = self.last.filter(|_| t < self.sure_until) {
            return sense;
        }
        let (sense, until) = self.phases.sense_after(t);
        self.sure_until = until;
        sense
    }

    /// Goes on in time, s, and place, m.
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
        let [begins, ends, opens] = [EventKind::GrossSlip, EventKind::GrossSlipEnds, EventKind::LiftOff]
            .map(|other| kind == other.name());
        // In the air its way is nobody's; out of gross slip the turn is the end of that, where the normal varies a little before.
        let has_turned = kind == contact.turn && state != OPEN;
        let turns = has_turned && !contact.slips;
        // Where gross slip begins or ends the row is of either side, and a force that comes back to its limit as it turns is as good as
        // at it: the events tell. Of one that slides as it touches no other one does.
        contact.slips = match () {
            () if begins => true,
            () if ends || opens || kind == EventKind::FullStick.name() => false,
            () if kind == EventKind::Touch.name() => state == SLIP,
            () => contact.slips,
        };
        if !(begins || ends || opens || has_turned) {
            return;
        }
        // The force turns where slip begins or ends, too.
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

    /// That of the last whole period.
    pub fn last(&self) -> Option<&Account> {
        self.whole.as_ref()
    }

    /// Which way the waveform goes when.
    pub fn phases(&self) -> &Phases {
        &self.phases
    }
}

/// Half of what lies between two forces, as a share of the limit of friction: the mean of both moments, above which no swing of
/// springs comes, however little presses at either of them.
fn swing(from: &Extreme, to: &Extreme) -> f64 {
    let limit = 0.5 * (from.limit + to.limit);
    if limit > 0.0 { 0.5 * (to.force - from.force).abs() / limit } else { 0.0 }
}
