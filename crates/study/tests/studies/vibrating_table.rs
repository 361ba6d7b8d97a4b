//! A ball with a flat end on a vibrating table, damped against the ground. The flat end is a spring that only pushes.
//! Bounces once per period and their period doubling are compared with separate equations.
//!
//! In the air m z̈ = -m g - c ż. On the table m z̈ = -m g - c ż + k (A sin ωt - z). The stiffness is k = 2 E* a (4.13 and the flat punch
//! of the Handbook of Contact Mechanics). Both have closed-form solutions; touch and lift-off are their roots.

use std::error::Error;
use std::f64::consts::TAU;
use std::path::PathBuf;
use stickslip_drive::scene::Axis;
use stickslip_drive::{Entry, EventKind, Plan, Record, Run, Stepper};
use stickslip_run::Job;
use stickslip_scenario::Scenario;
use stickslip_study::steady::continuation::{Bifurcation, Branch, Continuation, Course};
use stickslip_study::steady::{self, Ending, Multiplier, Options, Steady};

const MASS: f64 = 4e-3;
const DAMPING: f64 = 0.8;
const GRAVITY: f64 = 9.81;
const PERIOD: f64 = 5e-3;
/// Contact stiffness of a punch with a radius of 1 µm, steel on steel, N/m.
const STIFFNESS: f64 = 2.0 * 210e9 / (2.0 * (1.0 - 0.3 * 0.3)) * 1e-6;

/// Amplitude of the table, m.
#[derive(Clone, Copy)]
struct Table {
    amplitude: f64,
}

/// Time, position and velocity of the ball.
#[derive(Clone, Copy)]
struct Place {
    t: f64,
    z: f64,
    v: f64,
}

impl Table {
    fn height(self, t: f64) -> f64 {
        self.amplitude * (TAU * t / PERIOD).sin()
    }

    /// Returns the state after a time `s` in the air.
    fn flown(from: Place, s: f64) -> Place {
        let tau = MASS / DAMPING;
        let (falls, left) = (-GRAVITY * tau, (-s / tau).exp());
        let beyond = from.v - falls;
        let z = from.z + falls * s - beyond * tau * (-s / tau).exp_m1();
        Place { t: from.t + s, z, v: falls + beyond * left }
    }

    /// Returns the state after a time `s` on the table.
    fn pressed(self, from: Place, s: f64) -> Place {
        let omega = TAU / PERIOD;
        let (stiff, damped) = (STIFFNESS - MASS * omega * omega, DAMPING * omega);
        let scale = STIFFNESS * self.amplitude / (stiff * stiff + damped * damped);
        let (p, q) = (scale * stiff, -scale * damped);
        let led = |t: f64| {
            let (sin, cos) = (omega * t).sin_cos();
            (p * sin + q * cos - MASS * GRAVITY / STIFFNESS, omega * (p * cos - q * sin))
        };
        let gamma = DAMPING / (2.0 * MASS);
        let own = (STIFFNESS / MASS - gamma * gamma).sqrt();
        let (z0, v0) = led(from.t);
        let a = from.z - z0;
        let b = (from.v - v0 + gamma * a) / own;
        let (sin, cos) = (own * s).sin_cos();
        let left = (-gamma * s).exp();
        let (z1, v1) = led(from.t + s);
        let swings = left * (a * cos + b * sin);
        let rate = left * own * (b * cos - a * sin) - gamma * swings;
        Place { t: from.t + s, z: z1 + swings, v: v1 + rate }
    }

    /// Returns the next time at which ball and table meet.
    fn meets(self, way: impl Fn(f64) -> Place) -> Option<Place> {
        let apart = |s: f64| {
            let place = way(s);
            place.z - self.height(place.t)
        };
        let step = 1e-6;
        let sense = apart(step).signum();
        let after = (2..20_000_u32).map(|k| f64::from(k) * step).find(|s| apart(*s) * sense < 0.0)?;
        let (mut low, mut high) = (after - step, after);
        for _ in 0..80 {
            let middle = 0.5 * (low + high);
            if apart(middle) * sense < 0.0 {
                high = middle;
            } else {
                low = middle;
            }
        }
        Some(way(0.5 * (low + high)))
    }

    /// Map from touch to touch: time minus a period, and velocity.
    fn map(self, [t, v]: [f64; 2]) -> Option<[f64; 2]> {
        let touch = Place { t, z: self.height(t), v };
        let lifts = self.meets(|s| self.pressed(touch, s))?;
        let lifts = Place { z: self.height(lifts.t), ..lifts };
        let again = self.meets(|s| Self::flown(lifts, s))?;
        Some([again.t - PERIOD, again.v])
    }

    /// Jacobian of the map by central differences.
    fn gradient(self, at: [f64; 2]) -> Option<[[f64; 2]; 2]> {
        let steps = [1e-5 * PERIOD, 1e-5 * at[1].abs()];
        let mut gradient = [[0.0; 2]; 2];
        for (j, step) in steps.into_iter().enumerate() {
            let moved = |by: f64| {
                let mut moved = at;
                moved[j] += by;
                self.map(moved)
            };
            // Fourth order: only rounding errors remain.
            let [a, b, c, d] = [moved(step)?, moved(-step)?, moved(2.0 * step)?, moved(-2.0 * step)?];
            for i in 0..2 {
                gradient[i][j] = (8.0 * (a[i] - b[i]) - (c[i] - d[i])) / (12.0 * step);
            }
        }
        Some(gradient)
    }

    /// Returns the periodic bounce near a guess.
    fn fixed(self, mut at: [f64; 2]) -> Option<[f64; 2]> {
        for _ in 0..30 {
            let (image, [[a, b], [c, d]]) = (self.map(at)?, self.gradient(at)?);
            let (r, s) = (image[0] - at[0], image[1] - at[1]);
            let (a, d) = (1.0 - a, 1.0 - d);
            let determinant = a * d - b * c;
            let by = [(r * d + b * s) / determinant, (a * s + c * r) / determinant];
            at = [at[0] + by[0], at[1] + by[1]];
            if by[0].abs() < 1e-15 * PERIOD && by[1].abs() < 1e-15 {
                break;
            }
        }
        Some(at)
    }

    /// Returns velocity and amplitude of the periodic bounce that touches at a given time, near a guess.
    fn at_time(t: f64, [mut v, mut amplitude]: [f64; 2]) -> Option<[f64; 2]> {
        let missed = |v: f64, amplitude: f64| {
            let [again, speed] = Self { amplitude }.map([t, v])?;
            Some([(again - t) / PERIOD, (speed - v) / v])
        };
        let steps = [1e-6 * v.abs(), 1e-6 * amplitude];
        for _ in 0..30 {
            let [r, s] = missed(v, amplitude)?;
            let slope = |by: [f64; 2]| -> Option<[f64; 2]> {
                let ahead = missed(v + by[0], amplitude + by[1])?;
                let behind = missed(v - by[0], amplitude - by[1])?;
                let length = 2.0 * (by[0] + by[1]);
                Some([(ahead[0] - behind[0]) / length, (ahead[1] - behind[1]) / length])
            };
            let ([a, c], [b, d]) = (slope([steps[0], 0.0])?, slope([0.0, steps[1]])?);
            let determinant = a * d - b * c;
            let by = [(d * r - b * s) / determinant, (a * s - c * r) / determinant];
            (v, amplitude) = (v - by[0], amplitude - by[1]);
            if by[0].abs() < 1e-13 * v.abs() && by[1].abs() < 1e-13 * amplitude {
                break;
            }
        }
        Some([v, amplitude])
    }

    /// det(A + 1), which is 0 if a multiplier is -1.
    fn doubles(self, at: [f64; 2]) -> Option<f64> {
        let [[a, b], [c, d]] = self.gradient(at)?;
        Some((a + 1.0) * (d + 1.0) - b * c)
    }
}

fn job(table: Table) -> Result<Job, Box<dyn Error>> {
    job_from(table, [1e-6, 0.0])
}

/// With initial position and velocity of the ball.
fn job_from(table: Table, [z, v]: [f64; 2]) -> Result<Job, Box<dyn Error>> {
    let text = format!(
        r#"{{ "stickslip": 1,
          "materials": {{ "steel": {{ "youngs_modulus": "210 GPa", "poisson_ratio": 0.3 }} }},
          "waveforms": {{ "shake": {{ "sine": {{ "amplitude": {amplitude:e}, "period": {PERIOD:e} }} }} }},
          "bodies": {{ "table": {{ "z": {{ "follows": "shake" }} }},
                       "ball": {{ "mass": {MASS:e}, "z": "free", "start": {{ "z": {z:e}, "vz": {v:e} }} }} }},
          "contacts": {{ "end": {{ "between": ["table", "ball"], "materials": ["steel", "steel"],
              "profile": {{ "flat": {{ "radius": "1 um" }} }}, "friction": 0, "normal": "coupled" }} }},
          "springs": {{ "air": {{ "between": ["ground", "ball"], "direction": "z", "stiffness": 0, "damping": {DAMPING:e} }} }},
          "gravity": {{ "acceleration": {GRAVITY:e} }},
          "run": {{ "duration": "1 s" }} }}"#,
        amplitude = table.amplitude,
    );
    Ok(Job::new(Scenario::from_str_alone(&text, "table")?, "table".to_owned(), PathBuf::new())?)
}

/// Recorder of touch and lift-off times.
#[derive(Default)]
struct Meetings {
    touch: Vec<f64>,
    lift: Vec<f64>,
}

impl Record for Meetings {
    fn take(&mut self, entry: Entry<'_>) {
        if let Entry::Event(event, _) = entry {
            match event.kind {
                EventKind::Touch => self.touch.push(event.t),
                EventKind::LiftOff => self.lift.push(event.t),
                _ => {}
            };
        }
    }
}

/// Returns the touch of a periodic orbit with one bounce per period: time in the period and velocity.
fn touch(job: &Job, found: &Steady) -> Result<[f64; 2], Box<dyn Error>> {
    let stepper = Stepper::Event { tolerance: 1e-13 };
    let plan = Plan { duration: f64::MAX, stepper, every: None, ..job.scenario.plan };
    let (start, mut meetings) = (found.state.time(), Meetings::default());
    let mut run = Run::new(&found.model, &plan, found.state.clone())?;
    run.advance(start + found.period, &mut meetings)?;
    assert_eq!((meetings.touch.len(), meetings.lift.len()), (1, 1), "one bounce a period");
    let t = meetings.touch[0];
    let mut run = Run::new(&found.model, &plan, found.state.clone())?;
    run.advance(t, &mut ())?;
    let (_, v) = run.state().coordinate(&found.model, 1, Axis::Z).ok_or("the ball")?;
    Ok([t % PERIOD, v])
}

/// Returns the branch over the amplitude of the table.
fn branch(at: Table, range: [f64; 2]) -> Result<Branch, Box<dyn Error>> {
    let of = Continuation::new(job(at)?, "waveforms.shake.sine.amplitude", range)?;
    Ok(of.follow(&Course::default())?)
}

/// Returns the parameter value of the only special point of a kind.
fn only(branch: &Branch, kind: &Bifurcation) -> Result<f64, Box<dyn Error>> {
    let mut found = branch.marks.iter().filter(|mark| mark.kind == *kind);
    match (found.next(), found.next()) {
        (Some(mark), None) => Ok(mark.value),
        _ => Err(format!("one {}: {:?}", kind.name(), branch.marks).into()),
    }
}

/// Stable, with one bounce per period.
const QUIET: Table = Table { amplitude: 7e-6 };

/// Returns (1 + λ₁)(1 + λ₂) of a periodic orbit.
fn doubles(found: &Steady) -> f64 {
    let of = |multiplier: &Multiplier| match multiplier.im {
        0.0 => 1.0 + multiplier.re,
        im => (1.0 + multiplier.re).powi(2) + im * im,
    };
    found.multipliers.iter().map(of).product()
}

/// A ball that stays on the table oscillates on its spring; the multipliers are those of this oscillation.
#[test]
fn a_ball_that_never_lifts_has_the_multipliers_of_its_spring() -> Result<(), Box<dyn Error>> {
    let found = steady::find(&job(Table { amplitude: 3e-6 })?, &Options::default())?;
    let gamma = DAMPING / (2.0 * MASS);
    let angle = (STIFFNESS / MASS - gamma * gamma).sqrt() * PERIOD;
    let modulus = (-gamma * PERIOD).exp();
    let [largest] = found.multipliers[..] else { return Err("one pair".into()) };
    let off = [largest.re - modulus * angle.cos(), largest.im - (modulus * angle.sin()).abs()];
    assert!(off.iter().all(|off| off.abs() < 1e-8), "{off:?}");
    Ok(())
}

/// Returns the amplitude of period doubling by bisection of the equations above.
fn own_doubling() -> Result<f64, Box<dyn Error>> {
    let first = touch(&job(QUIET)?, &steady::find(&job(QUIET)?, &Options::default())?)?;
    let (mut low, mut high, mut at) = (7.25e-6, 7.5e-6, first);
    for _ in 0..50 {
        let table = Table { amplitude: 0.5 * (low + high) };
        at = table.fixed(at).ok_or("a bounce")?;
        if table.doubles(at).ok_or("a gradient")? > 0.0 {
            low = table.amplitude;
        } else {
            high = table.amplitude;
        }
    }
    Ok(0.5 * (low + high))
}

/// Quadratic interpolation between orbits at three amplitudes.
#[test]
fn the_bounce_doubles_its_period_where_its_own_equations_say() -> Result<(), Box<dyn Error>> {
    let own = own_doubling()?;
    // Newton's interpolation through three points, solved for its root.
    let apart = 1e-3;
    let at = |share: f64| -> Result<f64, Box<dyn Error>> {
        Ok(doubles(&steady::find(&job(Table { amplitude: own * (1.0 + share) })?, &Options::default())?))
    };
    let [before, there, after] = [at(-apart)?, at(0.0)?, at(apart)?];
    let (slope, bend) = ((after - before) / (2.0 * apart), (after - 2.0 * there + before) / (apart * apart));
    let off = -there / (slope - 0.5 * bend * there / slope);
    assert!(before > 0.0 && after < 0.0 && off.abs() < 1e-8, "{off:e} of {own:e} m");
    Ok(())
}

/// Beyond period doubling, the equations converge to two alternating bounces, and so does a run.
#[test]
fn beyond_it_a_run_ends_on_two_bounces() -> Result<(), Box<dyn Error>> {
    let table = Table { amplitude: 7.6e-6 };
    let job = job(table)?;
    let found = steady::find(&job, &Options::default())?;
    let mut at = touch(&job, &found)?;
    let own = table.fixed(at).ok_or("a bounce")?;
    at[1] *= 1.01;
    for _ in 0..1000 {
        at = table.map(at).ok_or("a bounce")?;
    }
    let [once, twice] = [table.map(at).ok_or("one")?, table.map(table.map(at).ok_or("one")?).ok_or("two")?];
    assert!((once[1] - at[1]).abs() > 0.01 * own[1].abs() && (twice[1] - at[1]).abs() < 1e-9 * own[1].abs());
    assert!(!found.is_stable());
    let aftermath = found.aftermath(&job, &Options::default())?.ok_or("an end")?;
    assert_eq!(aftermath.ending, Ending::Repeats(2));
    Ok(())
}

#[test]
fn a_ball_bounces_once_a_period_as_its_own_equations_say() -> Result<(), Box<dyn Error>> {
    let job = job(QUIET)?;
    let found = steady::find(&job, &Options::default())?;
    let told = touch(&job, &found)?;
    let own = QUIET.fixed(told).ok_or("a bounce")?;
    let off = [(told[0] - own[0]) / PERIOD, (told[1] - own[1]) / own[1]];
    assert!(off.iter().all(|off| off.abs() < 1e-8), "{off:?}");
    // Trace and determinant of the Jacobian do not depend on the section.
    let [[a, b], [c, d]] = QUIET.gradient(own).ok_or("a gradient")?;
    let (mut trace, mut product) = (0.0, 1.0);
    for multiplier in &found.multipliers {
        let pair = multiplier.im != 0.0;
        trace += if pair { 2.0 * multiplier.re } else { multiplier.re };
        product *= if pair { multiplier.modulus().powi(2) } else { multiplier.re };
    }
    let off = [trace - (a + d), product - (a * d - b * c)];
    assert!(off.iter().all(|off| off.abs() < 1e-6), "{off:?}");
    Ok(())
}

/// Returns the touch time of the periodic bounce with the smallest amplitude, with velocity and amplitude, by golden section search.
fn own_fold() -> Result<(f64, [f64; 2]), Box<dyn Error>> {
    let told = touch(&job(QUIET)?, &steady::find(&job(QUIET)?, &Options::default())?)?;
    let [t, v] = QUIET.fixed(told).ok_or("a bounce")?;
    let at = |t: f64, near: [f64; 2]| Table::at_time(t, near).ok_or(format!("a bounce at {t:e} s"));
    // In the direction of decreasing amplitude, until it increases again.
    let step = 2e-3 * PERIOD;
    let first = [v, QUIET.amplitude];
    let by = if at(t + step, first)?[1] < first[1] { step } else { -step };
    let mut ways = vec![(t, first)];
    while ways.len() < 3 || ways[ways.len() - 1].1[1] < ways[ways.len() - 2].1[1] {
        let (t, near) = ways[ways.len() - 1];
        ways.push((t + by, at(t + by, near)?));
    }
    let (middle, near) = ways[ways.len() - 2];
    let (mut low, mut high) = (middle - step, middle + step);
    let share = 0.5 * (5.0_f64.sqrt() - 1.0);
    for _ in 0..40 {
        let [one, other] = [high - share * (high - low), low + share * (high - low)];
        if at(one, near)?[1] < at(other, near)?[1] {
            high = other;
        } else {
            low = one;
        }
    }
    let t = 0.5 * (low + high);
    Ok((t, at(t, near)?))
}

/// The branch of the periodic bounce starts in a fold, at the smallest amplitude, and has a period doubling at a larger one.
#[test]
fn a_branch_of_the_bounce_folds_and_doubles_where_its_own_equations_say() -> Result<(), Box<dyn Error>> {
    let branch = branch(QUIET, [1e-6, 8e-6])?;
    let doubled = only(&branch, &Bifurcation::PeriodDoubling)? / own_doubling()? - 1.0;
    assert!(doubled.abs() < 1e-8, "{doubled:e}");
    let own = own_fold()?.1[1];
    let off = only(&branch, &Bifurcation::Fold)? / own - 1.0;
    assert!(off.abs() < 1e-8, "{off:e} of {own:e} m");
    // Above the fold there are two bounces, one stable and one unstable.
    let above = branch.points.iter().filter(|point| (own * 1.001..own * 1.5).contains(&point.value));
    let stable: Vec<bool> = above.map(|point| point.is_stable()).collect();
    assert!(stable.contains(&true) && stable.contains(&false));
    Ok(())
}

/// Both orbits that meet in the fold are found from initial states by the equations above. One is stable, the other is
/// not, and their branches end in the same fold.
#[test]
fn both_sides_of_the_fold_are_found_from_their_own_starts() -> Result<(), Box<dyn Error>> {
    let (fold, at) = own_fold()?;
    let (mut folds, mut stable) = (Vec::new(), Vec::new());
    for by in [-0.01, 0.01] {
        let t = fold + by * PERIOD;
        let [v, amplitude] = Table::at_time(t, at).ok_or("a bounce")?;
        let table = Table { amplitude };
        let touches = Place { t, z: table.height(t), v };
        let lifts = table.meets(|s| table.pressed(touches, s)).ok_or("a lift-off")?;
        let lifts = Place { z: table.height(lifts.t), ..lifts };
        let begins = (t / PERIOD).floor() * PERIOD + PERIOD;
        let start = match lifts.t > begins {
            true => table.pressed(touches, begins - t),
            false => Table::flown(lifts, begins - lifts.t),
        };
        let job = job_from(table, [start.z, start.v])?;
        let found = steady::find(&job, &Options::default())?;
        stable.push(found.is_stable());
        let off = touch(&job, &found)?[1] / v - 1.0;
        assert!(off.abs() < 1e-8, "{by}: {off:e}");
        let of = Continuation::new(job, "waveforms.shake.sine.amplitude", [0.9 * at[1], 1.01 * amplitude])?;
        folds.push(only(&of.follow(&Course::default())?, &Bifurcation::Fold)?);
    }
    assert!(
        (folds[0] / folds[1] - 1.0).abs() < 1e-10 && (folds[0] / at[1] - 1.0).abs() < 1e-8,
        "{folds:?} {at:?}"
    );
    Ok(())
}

/// A ball on the table begins to lift off when the amplitude of its force equals its weight. With z = H A e^{iωt} -
/// mg/k and H = k/(k - mω² + icω), the amplitude is mg/(k|1 - H|).
#[test]
fn a_ball_begins_to_lift_off_where_its_force_vanishes() -> Result<(), Box<dyn Error>> {
    let omega = TAU / PERIOD;
    let (inert, damped) = (MASS * omega * omega, DAMPING * omega);
    let share = inert.hypot(damped) / (STIFFNESS - inert).hypot(damped);
    let own = MASS * GRAVITY / (STIFFNESS * share);
    let branch = branch(Table { amplitude: 3e-6 }, [2.9e-6, 6.1e-6])?;
    let events: Vec<_> =
        branch.marks.iter().filter(|mark| matches!(mark.kind, Bifurcation::Event(_))).collect();
    let [mark] = events[..] else { return Err(format!("{:?}", branch.marks).into()) };
    let Bifurcation::Event(changes) = &mark.kind else { return Err("an event".into()) };
    let told: Vec<_> =
        changes.iter().map(|change| (change.kind.as_str(), change.below, change.above)).collect();
    assert_eq!(told, [("lift-off", 0, 1), ("touch", 0, 1)]);
    let off = mark.value / own - 1.0;
    assert!(off.abs() < 1e-8 && mark.half_width < 1e-8 * own, "{off:e} of {own:e} m");
    Ok(())
}
