//! Plausibility of strokes, time scales of contacts, resonances, tolerances and frames.

use super::{ASKED, Implausible, told};
use crate::Setting;
use std::f64::consts::TAU;
use stickslip_drive::facts::{ExpectedEvents, fixed_steps, zero_step_stroke};
use stickslip_drive::scene::{Freedom, Normal, Side, Varying};
use stickslip_drive::{Accuracy, Shape, Stepper, Waveform};
use stickslip_scenario::{Hysteresis, substance};

/// Range of plausible strokes of piezo drives, m: from the noise of amplifiers to the largest flexure drives.
const STROKES: (f64, f64) = (1e-12, 1e-3);
/// Largest plausible damping time of a contact, in flanks, and largest lead βu̇ in gross slip displacements.
// Springs with and without damping during slip differ by 1 % of what damping changes.
const FLANK: f64 = 0.15;
/// Minimum duration of a flank, in passages of a shear wave through the contact.
///
/// The contact is modelled as a spring without inertia, which holds for ωa/c ≪ 1 (Johnson, *Contact Mechanics*, section 11.2, after Miller
/// and Pursey). At ten passages of the diameter 2a, T = 20 a/c and ωa/c = 0.3.
const PASSAGES: f64 = 10.0;
/// Number of harmonics of the drive frequency that are compared with resonances. A higher harmonic is near every resonance.
const HARMONICS: u32 = 5;
/// Relative distance of a harmonic from a resonance frequency below which the harmonic excites the resonance.
// The resonance of P1 is at 2.12 times the drive frequency, 6 % from the second harmonic, and is not excited.
const NEAR: f64 = 0.02;
/// Smallest amplitude of a harmonic that is reported, relative to the largest harmonic.
const NOTICEABLE: f64 = 0.05;
/// Number of samples per period for the computation of harmonics.
const MOMENTS: u32 = 4096;
/// Maximum number of free coordinates for the resonance check. Of more modes, one is almost always near a harmonic.
const COORDINATES: usize = 8;
/// Smallest displacement of a contact in a mode, relative to the largest, for which the mode is attributed to the contact.
const MOVED: f64 = 0.05;

/// Relative difference below which two times are equal.
const ROUNDED: f64 = 1e-9;
/// Damping time of a contact times its velocity jump, relative to its natural displacement, above which the error of frames is unbounded.
const STRUCK: f64 = 0.1;
/// Requested accuracy of the stepper `frames` above which a late detection of driver limits is not reported.
const LIMITS: f64 = 1e-3;
/// The same threshold for a voltage window that limits a voltage without delay.
const HARD_LIMITS: f64 = 1e-2;
/// Lift of a foot, relative to the initial indentation, above which the contact may open.
const LIFTED: f64 = 0.5;
/// Maximum number of waveform pieces that are examined.
const PIECES: usize = 100_000;
/// Number of events or time steps that corresponds to some days of computing time.
const MANY: f64 = 1e12;
/// Maximum number of bodies for which the number of events is estimated. The estimate needs all normal modes.
const BODIES: usize = 32;
/// Highest computing rate of events or time steps, 1/s.
const RATE: f64 = 1e6;

impl Implausible<'_> {
    /// Checks the strokes for a missing unit.
    pub(super) fn strokes(&mut self) {
        for (w, _) in lengths(self.setting) {
            let (low, high) = self.setting.scenario.scene.waveforms[w].part.range();
            let (stroke, path) = (high - low, self.setting.scenario.waveform_path(w).unwrap_or_default());
            let said = told(stroke, "m");
            let help = "a number without a unit is in m; the header of a table column may give its unit, as in \"disp (µm)\"";
            if stroke > STROKES.1 {
                self.find(
                    "stroke",
                    &path,
                    format!("a stroke of {said} is larger than that of any piezo drive"),
                    help,
                );
            } else if stroke > 0.0 && stroke < STROKES.0 {
                self.find(
                    "stroke",
                    &path,
                    format!("a stroke of {said} is less than a hundredth of an atom's diameter"),
                    help,
                );
            }
        }
    }

    /// Warns about contact damping times that are long compared with the flanks of the waveforms.
    pub(super) fn damping_times(&mut self) {
        let setting = self.setting;
        for (c, contact) in setting.scenario.scene.contacts.iter().enumerate().take(ASKED) {
            let shares = damping_shares(setting, c);
            let Some([share, _]) = shares.filter(|[share, lead]| *share > FLANK && *lead > FLANK) else {
                continue;
            };
            let said = told(contact.part.interface.damping(), "s");
            let message = format!(
                "a damping time of {said} is {share:.2} of the shortest flank, above {FLANK}: springs that slip have no damping, and \
                 Kelvin–Voigt springs would give another motion"
            );
            let path = format!("contacts.{}.damping", contact.name);
            self.find("damping_time", &path, message, "typical values are 0.1 us to 10 us; check the unit");
        }
    }

    /// Warns about flanks that are short compared with the passage of a shear wave through the contact.
    pub(super) fn flanks(&mut self) {
        let (setting, scene) = (self.setting, &self.setting.scenario.scene);
        for (w, sides) in lengths(self.setting) {
            let flank = shortest_flank(&scene.waveforms[w].part);
            let touches = |c: &usize| scene.contacts[*c].part.between.iter().any(|side| sides.contains(side));
            let touched = (0..scene.contacts.len().min(ASKED)).filter(touches);
            let crossed = touched.filter_map(|c| Some((c, self.passage(c)?)));
            let slowest = crossed.max_by(|a, b| a.1.total_cmp(&b.1));
            let Some((c, passage)) = slowest.filter(|(_, passage)| flank < PASSAGES * passage) else {
                continue;
            };
            let name = &scene.contacts[c].name;
            let [said, least, passage] = [flank, PASSAGES * passage, passage].map(|time| told(time, "s"));
            let message = format!(
                "a flank of {said} is shorter than {least}, {PASSAGES} passages of a shear wave through the contact {name} \
                 ({passage} each): the contact is modelled as a spring without inertia"
            );
            let path = setting.scenario.waveform_path(w).unwrap_or_default();
            self.find("flank", &path, message, "check the unit of the time");
        }
    }

    /// Returns the time in which a shear wave crosses contact `c`, s: the contact diameter divided by √(G/ρ) of the slower material.
    ///
    /// Returns `None` if the materials are unknown or the contact is open.
    fn passage(&self, c: usize) -> Option<f64> {
        let scenario = &self.setting.scenario;
        let (_, law) = self.setting.model.contacts().nth(c)?;
        let radius = law.profile().radius(self.depth(c));
        // Materials whose modulus does not fit their name have a separate warning.
        let known = scenario.materials_of(c)?.into_iter().filter(|name| !self.misnamed.contains(name));
        let speed = |name: &str| {
            let (modulus, ratio) = scenario.elasticity(name)?;
            Some((modulus / (2.0 * (1.0 + ratio)) / substance(name)?.density).sqrt())
        };
        let slowest = known.filter_map(speed).reduce(f64::min)?;
        Some(2.0 * radius / slowest).filter(|time| *time > 0.0)
    }

    /// Warns about low harmonics of a drive that excite a resonance of a contact under constant load.
    pub(super) fn resonances(&mut self) {
        let setting = self.setting;
        let scene = &setting.scenario.scene;
        let free: usize = scene
            .bodies
            .iter()
            .map(|body| body.part.coordinates().iter().filter(|(_, c)| c.freedom == Freedom::Free).count())
            .sum();
        if free == 0 || free > COORDINATES || scene.contacts.len() > ASKED {
            return;
        }
        let modes = setting.model.linearised(&setting.start, |d| d.start).modes();
        for (w, sides) in lengths(self.setting) {
            let waveform = &scene.waveforms[w].part;
            let Some(period) = waveform.period() else { continue };
            for mode in &modes {
                let frequency = mode.frequency / TAU;
                let order = (frequency * period).round();
                let near = (frequency * period / order - 1.0).abs() <= NEAR;
                if !(1.0..=f64::from(HARMONICS)).contains(&order) || !near {
                    continue;
                }
                let largest = mode.contacts.iter().fold(0.0, |most: f64, u| most.max(u.abs()));
                let rings = |c: &usize| {
                    let touches = scene.contacts[*c].part.between.iter().any(|side| sides.contains(side));
                    touches && setting.has_constant_load(*c) && mode.contacts[*c].abs() > MOVED * largest
                };
                let Some(c) = (0..scene.contacts.len()).find(rings) else { continue };
                let share = share(waveform, period, order as u32);
                if share < NOTICEABLE {
                    continue;
                }
                let (name, at) = (&scene.contacts[c].name, told(frequency, "Hz"));
                let message = format!(
                    "harmonic {order} of this drive, {share:.2} of its largest, excites the resonance of {name} at {at}"
                );
                let path = setting.scenario.waveform_path(w).unwrap_or_default();
                self.find(
                    "resonance",
                    &path,
                    message,
                    "the result depends strongly on the period: vary it by a few per cent",
                );
                break;
            }
        }
    }

    /// Warns about tolerances that exceed the expected step length.
    pub(super) fn tolerance(&mut self) {
        let setting = self.setting;
        let stepper = setting.model.effective(setting.scenario.plan.stepper);
        let Accuracy::Tolerance(tolerance) = stepper.accuracy() else { return };
        let lengths = lengths(self.setting);
        for (c, (name, law)) in setting.model.contacts().enumerate().take(ASKED) {
            let d = self.depth(c);
            let between = setting.scenario.scene.contacts[c].part.between;
            let unit = law.natural_displacement(d);
            if unit <= 0.0 || !between.iter().any(|side| self.is_free(*side)) {
                continue;
            }
            let strokes = lengths.iter().filter(|(_, sides)| between.iter().any(|side| sides.contains(side)));
            let widest = strokes
                .map(|(w, _)| setting.scenario.scene.waveforms[*w].part.range())
                .fold(0.0, |most: f64, (low, high)| most.max(high - low));
            let idle = zero_step_stroke(law, d, 0.0).unwrap_or(0.0);
            // Below the zero-step stroke, the expected length is the stroke itself.
            let expected = if widest > idle { widest - idle } else { widest };
            if expected > 0.0 && tolerance * unit > expected {
                let [expected, unit] = [expected, unit].map(|length| told(length, "m"));
                let message = format!(
                    "{tolerance:e} of u_c, {unit} at {name}, is larger than the expected step length, {expected}"
                );
                let path = format!("run.stepper.{}.tolerance", stepper.name());
                return self.find("tolerance", &path, message, "use a smaller tolerance");
            }
        }
    }

    /// Warns about fixed time steps that are longer than a piece of a waveform.
    ///
    /// Such steps do not resolve the motion, although the energy balance may be satisfied.
    pub(super) fn steps(&mut self) {
        let setting = self.setting;
        let stepper = setting.model.effective(setting.scenario.plan.stepper);
        let Accuracy::Step(step) = stepper.accuracy() else { return };
        let plan = &setting.scenario.plan;
        for waveform in &setting.scenario.scene.waveforms {
            let ((low, high), quickest) = (waveform.part.range(), quickest(&waveform.part, plan.duration));
            // A difference within rounding is allowed.
            if high > low && step > quickest * (1.0 + ROUNDED) {
                let path = format!("run.stepper.{}.step", stepper.name());
                let [step, quickest] = [step, quickest].map(|time| told(time, "s"));
                let message = format!(
                    "{} reverses within {quickest}: a time step of {step} does not resolve this",
                    waveform.name
                );
                let help = "use time steps of at most a fifth of this time, or run.stepper.event";
                return self.find("step", &path, message, help);
            }
        }
    }

    /// Warns about runs that would take days.
    pub(super) fn endless(&mut self) {
        let (setting, plan) = (self.setting, &self.setting.scenario.plan);
        if setting.scenario.scene.bodies.len() > BODIES {
            return;
        }
        let (what, count) = match fixed_steps(&setting.model, plan) {
            Some(steps) => ("steps", steps),
            None => ("events", ExpectedEvents::of(setting.setup(), plan).total()),
        };
        if count > MANY {
            let days = count / (RATE * 86_400.0);
            let message =
                format!("about {count:.0e} {what} are expected, {days:.0e} days at a million per second");
            let help = "check the units of masses, lengths and times, or simulate a shorter time";
            self.find("endless", "run", message, help);
        }
    }

    /// Warns about cases in which the error of the stepper `frames` is unbounded, such as a normal load set by an input.
    pub(super) fn frames(&mut self, stepper: Stepper) {
        let setting = self.setting;
        let Stepper::Frames { accuracy, .. } = stepper else { return };
        let waveforms = &setting.scenario.scene.waveforms;
        let is_fed = |varying: Varying| match varying {
            Varying::Follows(w) => {
                waveforms.get(w).is_some_and(|w| matches!(w.part.shape(), Shape::Input { .. }))
            }
            Varying::Constant(_) => false,
        };
        for contact in &setting.scenario.scene.contacts {
            let (key, varying) = match contact.part.normal {
                Normal::Force(varying) => ("force", varying),
                Normal::Indentation(varying) => ("indentation", varying),
                Normal::Radius(varying) => ("radius", varying),
                Normal::Coupled => continue,
            };
            if is_fed(varying) {
                let path = format!("contacts.{}.normal.{key}", contact.name);
                let message = format!(
                    "an input sets the normal load of this contact: the error of frames is not bounded and may exceed {accuracy:e} of a stroke"
                );
                let help = "compare with shorter frames, or use the stepper `event`";
                self.find("frames_under_input", &path, message, help);
            }
        }
        self.lifted_frames(accuracy);
        self.damped_frames(accuracy);
        self.limited_frames(accuracy);
    }

    /// Warns about contacts that a moving foot may open. Each impact amplifies the error.
    fn lifted_frames(&mut self, accuracy: f64) {
        let setting = self.setting;
        let scene = &setting.scenario.scene;
        for (c, contact) in scene.contacts.iter().enumerate().filter(|(c, _)| setting.is_pressed_freely(*c)) {
            let bodies = contact.part.between.iter().filter_map(|side| match side {
                Side::Body(body) => scene.bodies.get(*body),
                Side::Ground => None,
            });
            let range = bodies.filter_map(|body| match body.part.z.freedom {
                Freedom::Follows(w) => scene.waveforms.get(w).map(|w| w.part.range()),
                _ => None,
            });
            let (lift, depth) = (range.map(|(low, high)| high - low).sum::<f64>(), self.depth(c).max(0.0));
            if lift > 0.0 && lift >= LIFTED * depth {
                let path = format!("contacts.{}.normal", contact.name);
                let (lift, depth) = (told(lift, "m"), told(depth, "m"));
                let message = format!(
                    "a foot lifts by {lift}, but the initial indentation of this contact is {depth}: {}",
                    multiplied(accuracy)
                );
                let help = "compare with a smaller accuracy, or use the stepper `event`";
                self.find("frames_under_impacts", &path, message, help);
            }
        }
    }

    /// Warns about frames with stacks that reach a driver limit or have hysteresis, because no time step ends at the limit or reversal.
    fn limited_frames(&mut self, accuracy: f64) {
        let setting = self.setting;
        for piezo in &setting.scenario.stacks {
            let spec = piezo.driver.as_ref();
            let follows = spec.is_none_or(|spec| spec.resistance.is_none() && spec.low.is_none());
            let plays =
                matches!(piezo.ceramic.hysteresis, Some(Hysteresis::Plays(..))) && !piezo.ceramic.idle;
            let (key, what) = if spec.is_some_and(|spec| spec.current.is_some()) && accuracy < LIMITS {
                ("driver.current", "reach this limit")
            } else if follows && accuracy < HARD_LIMITS && piezo.cut(&setting.scenario.scene).is_some() {
                ("driver.window", "reach an end of this window")
            } else if plays && accuracy < LIMITS {
                ("hysteresis", "follow reversals of this hysteresis")
            } else {
                continue;
            };
            let path = format!("actuators.{}.{key}", piezo.name);
            let message = format!(
                "frames {what} up to one time step late: the error may then exceed {accuracy:e} of a stroke"
            );
            let help = "compare with shorter frames, or use the stepper `event`";
            self.find("frames_under_limits", &path, message, help);
        }
    }

    /// Warns about frames with damped contacts: under a varying normal load with a flank, or with a stiffness that jumps.
    ///
    /// Time steps do not end where the last spring slips or where the stiffness jumps.
    fn damped_frames(&mut self, accuracy: f64) {
        let setting = self.setting;
        let flanks: Vec<(f64, Vec<Side>)> = lengths(setting)
            .into_iter()
            .filter_map(|(w, sides)| Some((flank(&setting.scenario.scene.waveforms.get(w)?.part), sides)))
            .collect();
        for (c, contact) in setting.scenario.scene.contacts.iter().enumerate() {
            let is_still = matches!(
                contact.part.normal,
                Normal::Force(Varying::Constant(_))
                    | Normal::Indentation(Varying::Constant(_))
                    | Normal::Radius(Varying::Constant(_))
            );
            let jumps = contact.part.interface.profile().has_kinks();
            let Some(natural) = setting.model.contact_natural(c).filter(|_| setting.is_damped(c)) else {
                continue;
            };
            let meets = |sides: &[Side]| contact.part.between.iter().any(|side| sides.contains(side));
            let own = flanks.iter().filter(|(_, sides)| meets(sides)).map(|(flank, _)| *flank);
            let way = contact.part.interface.damping() * own.fold(0.0, f64::max);
            let what = if !is_still && way > STRUCK * natural.displacement {
                "damped, under a varying normal load, and excited by a flank"
            } else if jumps {
                "damped, and their stiffness jumps with the indentation"
            } else {
                continue;
            };
            let path = format!("contacts.{}.damping", contact.name);
            let message = format!(
                "springs of this contact are {what}: the error of frames may exceed the requested {accuracy:e} of a stroke"
            );
            let help = "use the stepper `event`, or compare with it";
            self.find("frames_under_damping", &path, message, help);
        }
    }
}

/// Returns the waveforms that prescribe lengths, with the bodies that they move.
fn lengths(setting: &Setting) -> Vec<(usize, Vec<Side>)> {
    let scene = &setting.scenario.scene;
    let mut driven: Vec<Vec<Side>> = vec![Vec::new(); scene.waveforms.len()];
    for (i, body) in scene.bodies.iter().enumerate() {
        for coordinate in [body.part.x, body.part.z] {
            if let Freedom::Follows(w) = coordinate.freedom
                && let Some(sides) = driven.get_mut(w)
            {
                sides.push(Side::Body(i));
            }
        }
    }
    for actuator in &scene.actuators {
        if let Varying::Follows(signal) = actuator.part.stroke
            && let Some(w) = scene.waveform_of(signal)
            && let Some(sides) = driven.get_mut(w)
        {
            sides.extend(actuator.part.between);
        }
    }
    driven.into_iter().enumerate().filter(|(_, sides)| !sides.is_empty()).collect()
}

/// Returns the damping time β of contact `c` divided by the shortest flank of the waveforms that move it, and βu̇/u_c at their largest speed.
///
/// Returns `None` for a contact without tangential damping or without such a waveform.
pub fn damping_shares(setting: &Setting, c: usize) -> Option<[f64; 2]> {
    let scene = &setting.scenario.scene;
    let part = &scene.contacts.get(c)?.part;
    let (time, natural) = (part.interface.damping(), setting.model.contact_natural(c)?);
    let moving =
        lengths(setting).into_iter().filter(|(_, sides)| part.between.iter().any(|s| sides.contains(s)));
    let waves = moving.filter_map(|(w, _)| Some(&scene.waveforms.get(w)?.part));
    let of = |wave: &Waveform| {
        let (low, high) = wave.range();
        let flank = shortest_flank(wave);
        [flank, (high - low) / flank]
    };
    let [flank, speed] =
        waves.map(of).fold([f64::INFINITY, 0.0], |all, one| [all[0].min(one[0]), all[1].max(one[1])]);
    (time > 0.0 && flank < f64::INFINITY).then(|| [time / flank, time * speed / natural.displacement])
}

/// Returns the text about the error of frames with impacts.
pub fn multiplied(accuracy: f64) -> String {
    format!("each impact multiplies errors: they may exceed the requested {accuracy:e} of a stroke")
}

/// Returns the amplitude of a harmonic relative to the largest of the first five.
fn share(waveform: &Waveform, period: f64, order: u32) -> f64 {
    let delay = waveform.timing().delay;
    let values: Vec<f64> = (0..MOMENTS)
        .map(|k| {
            let t = delay + period * f64::from(k) / f64::from(MOMENTS);
            waveform.sample(&waveform.piece_at(t), t).value
        })
        .collect();
    let amplitude = |order: u32| {
        let sums = values.iter().zip(0_u32..).fold((0.0, 0.0), |(a, b), (value, k)| {
            let angle = TAU * f64::from(order) * f64::from(k) / f64::from(MOMENTS);
            (a + value * math::cos(angle), b + value * math::sin(angle))
        });
        math::hypot(sums.0, sums.1)
    };
    let largest = (1..=HARMONICS).map(amplitude).fold(0.0, f64::max);
    if largest > 0.0 { amplitude(order) / largest } else { 0.0 }
}

/// Returns the largest jump of a waveform's rate in its first period, m/s; 0 for a smooth waveform.
fn flank(waveform: &Waveform) -> f64 {
    let until = waveform.period().map_or(f64::INFINITY, |period| waveform.timing().delay + 1.5 * period);
    let mut pieces = waveform.pieces_from(0.0).take(PIECES).take_while(|piece| piece.start <= until);
    let Some(mut last) = pieces.next() else { return 0.0 };
    let mut most = 0.0_f64;
    for piece in pieces {
        let rates =
            [(&last, last.end), (&piece, piece.start)].map(|(piece, t)| waveform.sample(piece, t).rate);
        most = most.max((rates[1] - rates[0]).abs());
        last = piece;
    }
    most
}

/// Returns the shortest time in which a waveform crosses its range at the mean rate of one of its pieces, s.
///
/// For a sawtooth this is the flyback, for a sine half a period. For a constant waveform the result is infinite.
fn shortest_flank(waveform: &Waveform) -> f64 {
    let (low, high) = waveform.range();
    let until = waveform.timing().delay + waveform.period().map_or(f64::INFINITY, |period| 1.5 * period);
    let pieces = waveform.pieces_from(0.0).take(PIECES).take_while(|piece| piece.start <= until);
    let flanks = pieces.filter(|piece| piece.end.is_finite()).map(|piece| {
        let [before, after] = [piece.start, piece.end].map(|t| waveform.sample(&piece, t).value);
        (high - low) * (piece.end - piece.start) / (after - before).abs()
    });
    flanks.filter(|flank| *flank > 0.0).fold(2.0 * waveform.resolution(), f64::min)
}

/// Returns the shortest time between two turning points of a waveform, s, before `until`: its shortest piece or half of its shortest wave.
fn quickest(waveform: &Waveform, until: f64) -> f64 {
    let inside = waveform.pieces_from(0.0).take(PIECES).take_while(|piece| piece.end <= until);
    inside.map(|piece| piece.end - piece.start).fold(2.0 * waveform.resolution(), f64::min)
}
