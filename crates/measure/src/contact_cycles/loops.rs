//! Detection of the cycles of a contact during a run.

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

/// Maximum numbers of stored samples: per cycle, and per run if cycles are evaluated at the end of the run.
const MOST: [usize; 2] = [1 << 18, 1 << 21];
/// Number of pending samples at which the contact is replayed along them. A later replay saves time if no cycle needs it.
const PENDING: usize = 1 << 14;
/// Channels of a contact that are sampled, in the order of the sampled values.
const QUANTITIES: [&str; 5] = ["u_m", "d_m", "fx_N", "fn_N", "friction_J"];

/// Detects and evaluates the cycles of one contact.
pub struct Loops {
    /// Channel indices in the order of [`QUANTITIES`].
    places: [usize; 5],
    /// Channel index of the damping losses of the whole model, if only this contact has damping.
    damping: Option<usize>,
    knows_damping: bool,
    load: Option<Load>,
    /// Whether the contact is sampled several times per period.
    is_dense: bool,
    /// Whether the tangential force is continuous: no input jumps and the contact has no damping.
    is_continuous: bool,
    cut: Cutting,
    track: Track,
    walk: Option<Walk>,
    /// Number of identical contacts.
    count: f64,
    /// Range of u below which the contact is at rest, m.
    still: f64,
    /// Maximum number of stored samples.
    most: usize,
    /// Number of samples that were dropped because of this limit.
    pub left_out: u64,
    /// Whether samples of the current cycle were dropped.
    is_torn: bool,
}

/// Rule for the ends of cycles.
enum Cutting {
    /// Cycles end at period ends.
    Periods(Tracker),
    /// Cycles end at reversals, which are determined at the end of the run.
    Reversals,
    /// There are no further cycles.
    Over,
}

impl Loops {
    /// Creates the detection for contact `c`. `places` are the channel indices by name.
    ///
    /// Returns `None` if neither a periodic waveform nor a table drives the contact.
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

    /// Adds a sample: the row `values` of all channels. `bends` is true at an event, where the time history may have a kink.
    ///
    /// Returns the evaluated cycle if a cycle ends at this sample and u has returned to its initial value.
    pub fn take(&mut self, law: &Interface, values: &[f64], bends: bool) -> Option<CycleFigures> {
        if matches!(self.cut, Cutting::Over) {
            return None;
        }
        let t = values.first().copied()?;
        let at = |place: usize| values.get(place).copied().unwrap_or(f64::NAN);
        let [u, d, force, normal, friction] = self.places.map(at);
        // The start of a run counts as a kink.
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

    /// Returns the memory used, in bytes.
    pub fn bytes(&self) -> usize {
        let pending = self.walk.as_ref().map_or(0, |walk| walk.pending.capacity());
        size_of::<f64>() * (7 * self.track.t.capacity() + pending) + self.track.bends.capacity()
    }

    /// Returns the cycles that can only be evaluated at the end of the run.
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
            // A cycle with dropped samples is not evaluated, but later cycles are evaluated.
            self.is_torn = true;
            self.left_out += self.track.t.len() as u64 - 1;
            self.forget(law);
        }
        if let Some(walk) = &mut self.walk {
            walk.begin(moment.d);
        }
        self.track.push(t, moment);
    }

    /// Adds a sample before the first cycle: only the replay of the contact needs it.
    fn wait(&mut self, law: &Interface, moment: Moment) {
        let Some(walk) = &mut self.walk else { return };
        walk.begin(moment.d);
        walk.pending.push(moment.u);
        if walk.pending.len() >= PENDING {
            walk.catch_up(law);
        }
    }

    /// Evaluates the cycle that ends with the last sample. Returns `None` if u does not return to its initial value.
    fn end_cycle(&mut self, law: &Interface) -> Option<CycleFigures> {
        let span = 0..self.track.t.len().checked_sub(1)?;
        let is_whole = !self.is_torn;
        let (track, setup, walk) = self.parts(law);
        let comes_back = is_whole && returns(&track.u[span.start..=span.end], setup.still, CLOSED);
        comes_back.then(|| track.figures(&span, &setup, walk.as_mut()))
    }

    /// Returns the samples, the other data for the evaluation of a cycle, and the replayed contact.
    fn parts<'a>(&'a mut self, law: &'a Interface) -> (&'a Track, Setup<'a>, &'a mut Option<Walk>) {
        let Self { track, walk, load, count, still, .. } = self;
        let (is_dense, is_continuous) = (self.is_dense, self.is_continuous);
        let (load, knows_damping) = (load.as_ref(), self.knows_damping);
        let setup = Setup { law, count: *count, still: *still, load, is_dense, is_continuous, knows_damping };
        (track, setup, walk)
    }

    /// Starts a new cycle with the last sample of the previous cycle.
    fn begin_cycle(&mut self, law: &Interface) {
        self.is_torn = false;
        self.forget(law);
    }

    /// Removes all samples except the last and adds their displacements to the pending path of the replayed contact.
    fn forget(&mut self, law: &Interface) {
        if let Some(walk) = &mut self.walk {
            // If a cycle was not evaluated, the replayed contact is at an earlier sample, always at the start of a cycle.
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
                    // The values differ between the cycles, so that the results depend on the whole path.
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
