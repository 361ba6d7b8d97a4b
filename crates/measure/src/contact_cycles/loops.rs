//! The cycles of a contact as its run goes on.

use super::load::Load;
use super::walk::Walk;
use super::{CLOSED, CycleFigures, Moment, Setup, Track, still, table_of};
use crate::Setting;
use crate::contact_path::is_walked;
use crate::cycles::returns;
use crate::marks;
use crate::periods::{Periods, Tracker};
use crate::returning_cycles;
use std::collections::HashMap;
use stickslip_contact::Interface;

/// Most moments of a cycle that are kept, and of a whole run whose cycles are told at its end.
const MOST: [usize; 2] = [1 << 18, 1 << 21];
/// Moments that a walk may be behind: of contacts that never come back no cycle asks for it, and short runs go without.
const PENDING: usize = 1 << 14;
/// Quantities of a contact, in the order of its track.
const QUANTITIES: [&str; 5] = ["u_m", "d_m", "fx_N", "fn_N", "friction_J"];

/// A contact whose cycles are looked for.
pub struct Loops {
    /// Its columns among all channels, in the order of [`QUANTITIES`].
    places: [usize; 5],
    /// The column of what dampers have taken, where that is what its own damping has; none where it has no damping.
    damping: Option<usize>,
    knows_damping: bool,
    load: Option<Load>,
    /// Whether it is looked at in parts of a period.
    is_dense: bool,
    /// Whether its force never jumps: nothing that drives the scene does, and no springs of it are damped.
    is_continuous: bool,
    cut: Cutting,
    track: Track,
    walk: Option<Walk>,
    /// Number of identical contacts.
    count: f64,
    /// Range of u up to which it stands still, m.
    still: f64,
    /// Most moments of its track.
    most: usize,
    /// Moments for which there was no room.
    pub left_out: u64,
    /// Whether some of the cycle under way are among them.
    is_torn: bool,
}

/// Where cycles begin and end.
enum Cutting {
    /// At the ends of periods.
    Periods(Tracker),
    /// At reversals, which are known when all moments are.
    Reversals,
    /// There are none any more.
    Over,
}

impl Loops {
    /// Those of contact `c`; none where nothing that drives it has periods or is a table. `places` are those of all channels.
    pub fn of(setting: &Setting, c: usize, places: &HashMap<&str, usize>) -> Option<Self> {
        let cut = match (Periods::of_contact(setting, c, f64::INFINITY), table_of(setting, c)) {
            (Some(periods), _) => Cutting::Periods(Tracker::new(periods)),
            (None, Some(_)) => Cutting::Reversals,
            (None, None) => return None,
        };
        let most = MOST[usize::from(matches!(cut, Cutting::Reversals))];
        let (name, _) = setting.model.contacts().nth(c)?;
        let place = |quantity| places.get(format!("{name}.{quantity}").as_str()).copied();
        let [Some(u), Some(d), Some(force), Some(normal), Some(friction)] = QUANTITIES.map(place) else {
            return None;
        };
        let is_damped = setting.is_damped(c);
        let damps_alone = is_damped && setting.loses_nothing_beside(c);
        let damping = places.get("energy.damping_J").copied().filter(|_| damps_alone);
        let memory = setting.start.memories().get(c).filter(|_| is_walked(setting, c));
        Some(Self {
            places: [u, d, force, normal, friction],
            damping,
            knows_damping: damps_alone || !is_damped,
            load: Load::of(setting, c),
            is_dense: marks::are_dense(setting, c),
            is_continuous: !is_damped && !setting.has_jumps(),
            cut,
            track: Track::default(),
            walk: memory.map(|memory| Walk::new(memory.clone())),
            count: f64::from(setting.count(c)),
            still: still(setting, c),
            most,
            left_out: 0,
            is_torn: false,
        })
    }

    /// Takes the next moment, a row of all channels, and whether something `bends` there; returns the cycle that it ends, where that
    /// comes back.
    pub fn take(&mut self, law: &Interface, values: &[f64], bends: bool) -> Option<CycleFigures> {
        if matches!(self.cut, Cutting::Over) {
            return None;
        }
        let t = values.first().copied()?;
        let at = |place: usize| values.get(place).copied().unwrap_or(f64::NAN);
        let [u, d, force, normal, friction] = self.places.map(at);
        // Nothing goes on smoothly to where a run starts.
        let bends = bends || t == 0.0;
        let moment = Moment { u, d, force, normal, friction, damping: self.damping.map_or(0.0, at), bends };
        let ended = match &mut self.cut {
            Cutting::Periods(tracker) => tracker.pass(t),
            _ => None,
        };
        let begins = matches!(self.cut, Cutting::Reversals) || ended == Some(0);
        if begins || !self.track.t.is_empty() {
            self.push(law, t, moment);
        } else {
            self.wait(law, moment);
        }
        let figures = ended.filter(|k| *k > 0).and_then(|_| self.end_cycle(law));
        if let Cutting::Periods(tracker) = &self.cut
            && tracker.is_over()
        {
            (self.cut, self.track) = (Cutting::Over, Track::default());
        }
        if ended.is_some() && !self.track.t.is_empty() {
            self.begin_cycle(law);
        }
        figures
    }

    /// What it takes, B.
    pub fn bytes(&self) -> usize {
        let pending = self.walk.as_ref().map_or(0, |walk| walk.pending.capacity());
        size_of::<f64>() * (7 * self.track.t.capacity() + pending) + self.track.bends.capacity()
    }

    /// The cycles that are known only when the run has ended.
    pub fn finish(&mut self, law: &Interface) -> Vec<CycleFigures> {
        if !matches!(self.cut, Cutting::Reversals) || self.track.t.is_empty() {
            return Vec::new();
        }
        let cycles = returning_cycles(&self.track.t, &self.track.u, self.still);
        let (track, setup, walk) = self.parts(law);
        let mut walk = walk.as_mut();
        let spans = cycles.into_iter().map(|cycle| cycle.start..cycle.end - 1);
        spans.map(|span| track.figures(&span, &setup, walk.as_deref_mut())).collect()
    }

    fn push(&mut self, law: &Interface, t: f64, moment: Moment) {
        let is_full = self.track.t.len() >= self.most;
        if is_full && matches!(self.cut, Cutting::Reversals) {
            self.left_out += 1;
            return;
        }
        if is_full {
            // A cycle without some of its moments is none; those after it are, so that their contact goes on.
            self.is_torn = true;
            self.left_out += self.track.t.len() as u64 - 1;
            self.forget(law);
        }
        if let Some(walk) = &mut self.walk {
            walk.begin(moment.d);
        }
        self.track.push(t, moment);
    }

    /// A moment before the first cycle.
    fn wait(&mut self, law: &Interface, moment: Moment) {
        let Some(walk) = &mut self.walk else { return };
        walk.begin(moment.d);
        walk.pending.push(moment.u);
        if walk.pending.len() >= PENDING {
            walk.catch_up(law);
        }
    }

    /// The cycle that ends with the last moment of the track.
    fn end_cycle(&mut self, law: &Interface) -> Option<CycleFigures> {
        let span = 0..self.track.t.len().checked_sub(1)?;
        let is_whole = !self.is_torn;
        let (track, setup, walk) = self.parts(law);
        let comes_back = is_whole && returns(&track.u[span.start..=span.end], setup.still, CLOSED);
        comes_back.then(|| track.figures(&span, &setup, walk.as_mut()))
    }

    /// Moments, what figures are taken with, and the contact led along them.
    fn parts<'a>(&'a mut self, law: &'a Interface) -> (&'a Track, Setup<'a>, &'a mut Option<Walk>) {
        let Self { track, walk, load, count, still, .. } = self;
        let (is_dense, is_continuous) = (self.is_dense, self.is_continuous);
        let (load, knows_damping) = (load.as_ref(), self.knows_damping);
        let setup = Setup { law, count: *count, still: *still, load, is_dense, is_continuous, knows_damping };
        (track, setup, walk)
    }

    /// Begins a cycle where the one before has ended, with the last moment of the track.
    fn begin_cycle(&mut self, law: &Interface) {
        self.is_torn = false;
        self.forget(law);
    }

    /// Forgets all moments but the last, along which its contact still has to be led.
    fn forget(&mut self, law: &Interface) {
        if let Some(walk) = &mut self.walk {
            // Where no figures were asked for it has been left behind; it never stands inside of a cycle.
            let behind = walk.at.map_or(0, |at| at + 1);
            walk.pending.extend(self.track.u.iter().skip(behind));
            walk.at = Some(0);
            if walk.pending.len() >= PENDING {
                walk.catch_up(law);
            }
        }
        self.track.keep_last();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sphere() -> Setting {
        let text = include_str!("../../../../scenarios/fretting_sphere.json");
        let scenario = stickslip_scenario::Scenario::from_str(text, "fretting_sphere", "").unwrap();
        let model = stickslip_drive::Model::new(&scenario.scene).unwrap();
        let start = model.start(&scenario.plan).unwrap();
        Setting { scenario, model, start }
    }

    fn loops(setting: &Setting) -> Loops {
        let channels = setting.model.channels();
        let places = channels.iter().enumerate().map(|(place, channel)| (channel.name.as_str(), place));
        Loops::of(setting, 0, &places.collect()).unwrap()
    }

    /// One cycle with more moments than there is room for once silenced all that came after it.
    #[test]
    fn a_cycle_without_room_is_lost_and_no_other() {
        let setting = sphere();
        let law = setting.model.contacts().next().unwrap().1;
        let period = Periods::of_contact(&setting, 0, f64::INFINITY).unwrap().length;
        let told = |most: usize| {
            let mut loops = Loops { most, ..loops(&setting) };
            let (mut row, mut told) = (vec![0.0; setting.model.channels().len()], Vec::new());
            for cycle in 0..6 {
                let count = if cycle == 2 { 100 } else { 8 };
                for k in 0..count {
                    let share = f64::from(k) / f64::from(count);
                    row[0] = period * (f64::from(cycle) + share);
                    // Not the same in each, so that figures hang on the way until then.
                    let turn = 2.0 * std::f64::consts::PI * share;
                    row[loops.places[0]] = 1e-7 * (turn.sin() + 0.1 * f64::from(cycle) * (3.0 * turn).sin());
                    row[loops.places[1]] = setting.start.memories()[0].apex().d;
                    row[loops.places[2]] = turn.cos();
                    told.extend(loops.take(law, &row, true));
                }
            }
            assert!(loops.track.t.capacity() < 2 * most.min(128), "{}", loops.track.t.capacity());
            (told, loops.left_out)
        };
        let ((all, none), (some, left_out)) = (told(MOST[0]), told(20));
        assert_eq!((all.len(), none, left_out > 0), (5, 0, true));
        assert_eq!(some, [&all[..2], &all[3..]].concat());
    }

    /// What is kept does not grow with the run.
    #[test]
    fn no_more_is_kept_than_a_cycle() {
        let setting = sphere();
        let mut loops = loops(&setting);
        let law = setting.model.contacts().next().unwrap().1;
        let period = Periods::of_contact(&setting, 0, f64::INFINITY).unwrap().length;
        let (mut row, mut cycles) = (vec![0.0; setting.model.channels().len()], 0);
        for k in 0..100_000 {
            let share = f64::from(k % 4) / 4.0;
            row[0] = period * (f64::from(k / 4) + share);
            row[loops.places[0]] = 1e-7 * if k % 2 == 0 { 0.0 } else { 1.0 - share };
            row[loops.places[1]] = setting.start.memories()[0].apex().d;
            cycles += usize::from(loops.take(law, &row, true).is_some());
            assert!(loops.track.t.len() <= 5 && loops.walk.as_ref().unwrap().pending.len() <= PENDING);
        }
        assert_eq!(cycles, 24_999);
    }
}
