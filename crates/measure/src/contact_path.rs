//! The way of a contact through (u, F_x), fine enough to be drawn and measured.

mod motion;

use crate::Setting;
use crate::simulated::Series;
use crate::trail::Trail;
use motion::Motion;
use stickslip_contact::{Apex, Interface, Memory, Segment};

/// Samples between the limit forces of one sign and the other.
const FINENESS: f64 = 128.0;
/// Most parts of the way between two samples, where it is walked along the motion.
const PARTS: f64 = 64.0;
/// Parts of a bent way: so many times the root of its bend. A chord then leaves it by 1/110² of the stroke, a tenth of a pixel.
const BENDS: f64 = 110.0;
/// Parts of any way along which the force changes by more than [`STILL`] of its range.
const LEAST: f64 = 8.0;
const STILL: f64 = 1e-3;
/// Where the force found at a sample is off by more of the range of forces, the motion is not known between samples that far
/// apart; what it is off by less is shared out along the way.
const OFF: f64 = 0.05;
/// Samples from which on there are enough of them.
const MANY: usize = 50_000;

/// The way of contact `c`, all identical contacts together. Without damping the law has no time in it: between two samples on one
/// branch the force follows from the way alone, and all turning points are events. So the contact is walked once more through the
/// samples, and asked in between: under a constant load along the straight way, for the force depends on u alone; where the load
/// varies, along the motion of its bodies, on the cubics through their places and velocities. Elsewhere the samples stand alone.
pub fn contact_path(setting: &Setting, c: usize, series: &Series) -> Trail {
    let Some((name, law)) = setting.model.contacts().nth(c) else { return Trail::default() };
    let [u, d, force] = ["u_m", "d_m", "fx_N"].map(|quantity| series.column(name, quantity));
    let samples = Trail { t: series.time().to_vec(), x: u.to_vec(), y: force.to_vec() };
    let Some(memory) = setting.start.memories().get(c) else { return samples };
    let count = f64::from(setting.count(c));
    // Where events are left out of a series, turning points may be missing in it.
    // The moment before a jump may be none of the series.
    if is_walked(setting, c) && !setting.has_jumps() && setting.scenario.written.has_all_events() {
        let d = d.first().copied().unwrap_or(0.0);
        return refined(&samples, law, memory.clone(), (d, count));
    }
    let knows = knows_turns(setting) && setting.scenario.written.has_all_events();
    let motion = Motion::new(setting, c, series).filter(|_| knows && samples.t.len() < MANY);
    match motion.filter(|_| law.damping() == 0.0) {
        Some(motion) => moved(&samples, (law, d, count), memory.clone(), &motion).unwrap_or(samples),
        None => samples,
    }
}

/// Whether the force of contact `c` between two moments of a run follows from the contact's own law: that has no time in it, and
/// all turning points are events, or marks where something jumps: a straight way. What never rubs has no events.
pub fn is_walked(setting: &Setting, c: usize) -> bool {
    let rubs = setting.model.contact_natural(c).is_some_and(|natural| natural.force > 0.0);
    rubs && locates(setting) && setting.has_law_without_time(c)
}

/// Whether all turning points of a run are events, and nothing jumps.
fn knows_turns(setting: &Setting) -> bool {
    !setting.has_jumps() && locates(setting)
}

fn locates(setting: &Setting) -> bool {
    setting.model.effective(setting.scenario.plan.stepper).locates_events()
}

/// The way with points between its samples where the load varies: the contact is walked along the motion of its bodies. None
/// where it cannot be.
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

/// The way with points between its samples; at indentation d, of `count` contacts.
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

/// Points between samples i-1 and i, as many as the force changes.
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
