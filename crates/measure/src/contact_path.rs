//! Path of a contact in the (u, F_x) plane, with points inserted between the samples for drawing and evaluation.

mod motion;

use crate::Setting;
use crate::simulated::Series;
use crate::trail::Trail;
use motion::Motion;
use stickslip_contact::{Apex, Interface, Memory, Segment};

/// Number of points for a force change from one friction limit to the opposite limit.
const FINENESS: f64 = 128.0;
/// Maximum number of points between two samples if the contact is replayed along the motion.
const PARTS: f64 = 64.0;
/// Number of points of a curved path, relative to the square root of its curvature measure. A chord between two points then deviates from
/// the path by 1/110² of the stroke, a tenth of a pixel.
const BENDS: f64 = 110.0;
/// Minimum number of points if the force changes by more than [`STILL`] of its range.
const LEAST: f64 = 8.0;
const STILL: f64 = 1e-3;
/// Maximum deviation of the replayed force from the sampled one, relative to the force range. With larger deviations no points are
/// inserted; smaller deviations are distributed along the path.
const OFF: f64 = 0.05;
/// Number of samples above which no points are inserted.
const MANY: usize = 50_000;

/// Returns the path of contact `c`, all identical contacts together, with points inserted between the samples.
///
/// Without damping the contact law does not depend on time, and all reversals are events. Therefore the contact is replayed along the
/// samples and evaluated between them. Under a constant load, u is interpolated linearly. Under a varying load, the motion of the bodies is
/// interpolated by cubic polynomials through positions and velocities. Otherwise the samples are returned unchanged.
pub fn contact_path(setting: &Setting, c: usize, series: &Series) -> Trail {
    let Some((name, law)) = setting.model.contacts().nth(c) else { return Trail::default() };
    let [u, d, force] = ["u_m", "d_m", "fx_N"].map(|quantity| series.column(name, quantity));
    let samples = Trail { t: series.time().to_vec(), x: u.to_vec(), y: force.to_vec() };
    let Some(memory) = setting.start.memories().get(c) else { return samples };
    let count = f64::from(setting.count(c));
    // If events are not recorded, samples at reversals may be missing. If an input jumps, the sample before the jump may be missing.
    if is_walked(setting, c) && !setting.has_jumps() && setting.scenario.written.has_all_events() {
        let d = d.first().copied().unwrap_or(0.0);
        return refined(&samples, law, memory.clone(), (d, count));
    }
    let knows = knows_turns(setting) && setting.scenario.written.has_all_events();
    let motion = Motion::new(setting, c, series).filter(|_| knows && samples.t.len() < MANY);
    match motion.filter(|_| !setting.depends_on_time(c)) {
        Some(motion) => moved(&samples, (law, d, count), memory.clone(), &motion).unwrap_or(samples),
        None => samples,
    }
}

/// Returns whether the tangential force of contact `c` between two samples follows from its law and the linearly interpolated u.
///
/// This requires friction, a contact law without time dependence, and events at all reversals. Jumps are allowed, because they are sampled.
pub fn is_walked(setting: &Setting, c: usize) -> bool {
    let rubs = setting.model.contact_natural(c).is_some_and(|natural| natural.force > 0.0);
    rubs && locates(setting) && setting.has_law_without_time(c)
}

/// Returns whether all reversals of u in a run are events and no input jumps.
fn knows_turns(setting: &Setting) -> bool {
    !setting.has_jumps() && locates(setting)
}

fn locates(setting: &Setting) -> bool {
    setting.model.effective(setting.scenario.plan.stepper).locates_events()
}

/// Replays the contact along the motion of its bodies under a varying load and inserts points between the samples.
///
/// Returns `None` if the contact law rejects the motion.
fn moved(
    samples: &Trail,
    (law, d, count): (&Interface, &[f64], f64),
    mut memory: Memory,
    motion: &Motion<'_>,
) -> Option<Trail> {
    let range = samples.y.iter().fold((0.0_f64, 0.0_f64), |(low, high), &y| (low.min(y), high.max(y)));
    let (range, stroke) = (range.1 - range.0, samples.stroke());
    let mut path = Trail::default();
    for (i, (&t, &d)) in samples.t.iter().zip(d).enumerate() {
        let end = Apex { d, u: samples.x[i] };
        if i > 0 && t > samples.t[i - 1] && range > 0.0 {
            let leg = motion.leg(i);
            let change = (samples.y[i] - samples.y[i - 1]).abs() / range;
            let parts = (FINENESS * change).max(BENDS * leg.bend(stroke).sqrt());
            let parts = parts.max(if change > STILL { LEAST } else { 1.0 }).ceil().min(PARTS);
            let first = path.t.len();
            for k in 1..parts as u32 {
                let share = f64::from(k) / parts;
                let at = leg.at(share);
                memory.commit(law, Segment::Straight(at)).ok()?;
                let force = count * memory.force(law, at);
                path.push(samples.t[i - 1] + share * (t - samples.t[i - 1]), at.u, force);
            }
            let off = samples.y[i] - count * memory.force(law, end);
            if off.abs() > OFF * range {
                path.cut(first);
            }
            let shares = (1..).map(|k| f64::from(k) / parts);
            path.y[first..].iter_mut().zip(shares).for_each(|(force, share)| *force += share * off);
        }
        memory.commit(law, Segment::Straight(end)).ok()?;
        path.push(t, samples.x[i], samples.y[i]);
    }
    Some(path)
}

/// Inserts points between the samples at constant indentation d, for `count` identical contacts.
fn refined(samples: &Trail, law: &Interface, mut memory: Memory, (d, count): (f64, f64)) -> Trail {
    let mut path = Trail::default();
    for i in 0..samples.t.len() {
        if i > 0 {
            between(samples, i, (law, &memory, d, count), &mut path);
        }
        path.push(samples.t[i], samples.x[i], samples.y[i]);
        if memory.commit(law, Segment::Straight(Apex { d, u: samples.x[i] })).is_err() {
            return samples.clone();
        }
    }
    path
}

/// Inserts points between samples i-1 and i. The number of points is proportional to the force change.
fn between(samples: &Trail, i: usize, of: (&Interface, &Memory, f64, f64), path: &mut Trail) {
    let (law, memory, d, count) = of;
    let change = (samples.y[i] - samples.y[i - 1]).abs();
    if change == 0.0 {
        return;
    }
    let limit = count * law.friction() * law.normal_force(d);
    let parts = (0.5 * FINENESS * change / limit).ceil().min(FINENESS);
    for k in 1..parts as u32 {
        let share = f64::from(k) / parts;
        let at = |values: &[f64]| values[i - 1] + share * (values[i] - values[i - 1]);
        let u = at(&samples.x);
        path.push(at(&samples.t), u, count * memory.force(law, Apex { d, u }));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use stickslip_contact::{Engine, Pair, Profile};

    fn law() -> Interface {
        let profile = Profile::paraboloid(1.0).unwrap();
        Interface::new(Pair::from_moduli(1.0, 0.8).unwrap(), profile, 0.3).unwrap()
    }

    #[test]
    fn a_coarse_path_is_refined_along_the_closed_form() {
        // Loading of a paraboloid, F = μF_N (1 - (1 - u/u_c)^{3/2}), sampled at its ends alone.
        let law = law();
        let (u_c, limit) = (law.gross_slip_displacement(1.0), 0.3 * law.normal_force(1.0));
        let memory = Engine::Curve.memory(&law, Apex { d: 1.0, u: 0.0 });
        let form = |u: f64| 2.0 * limit * (1.0 - (1.0 - u / u_c).powf(1.5));
        let end = 0.9 * u_c;
        let coarse = Trail { t: vec![0.0, 1.0], x: vec![0.0, end], y: vec![0.0, form(end)] };
        let path = refined(&coarse, &law, memory, (1.0, 2.0));
        assert!(path.t.len() > 60, "{}", path.t.len());
        for (u, force) in path.x.iter().zip(&path.y) {
            assert!((force - form(*u)).abs() < 1e-13 * limit, "{u}: {force}");
        }
    }
}
