//! What `info` and `run` tell of the steady motion beforehand: the same keys in both files.

use super::Definition;

const KEYS: [(&str, &str); 12] = [
    (
        "steady_motion.step_m",
        "way of the body of the figures along x in a period of the steady motion, [found directly](steady.md), as if waveforms never ended",
    ),
    ("steady_motion.step_error_m", "how far that step may be off: an estimate, [doubled](steady.md#bound)"),
    ("steady_motion.speed_m_s", "step over period"),
    (
        "steady_motion.stable",
        "whether a run that is disturbed a little comes back to it; left out where a disturbance neither fades nor grows, of a shakedown unless it grows, and where that is not known",
    ),
    (
        "steady_motion.periods",
        "periods of the figures' waveform in a period of the motion, which is the common one of all waveforms; left out where it is 1",
    ),
    (
        "steady_motion.radius",
        "largest magnitude of a Floquet multiplier: what is left of a disturbance after a period",
    ),
    (
        "steady_motion.beat_periods",
        "periods of the drive to a beat of the disturbance that stays longest; left out where it does not turn",
    ),
    ("steady_motion.fold_periods", "periods in which that disturbance falls, or grows, by e"),
    ("steady_motion.words", "what becomes of that disturbance, in words"),
    (
        "steady_motion.carried",
        "contacts whose memories were led along: disturbances of what they remember may stay longer",
    ),
    (
        "steady_motion.shaken_down",
        "contacts that never slip grossly: the motion is one of a whole family, and what they slide in a period counts as its error",
    ),
    (
        "steady_motion.fault",
        "why it was not found at little cost, beside a run a fifth of its steps; the others are left out then",
    ),
];

pub(super) const SUMMARY: &[Definition] = &of("summary.json");
pub(super) const INFO: &[Definition] = &of("info --json");

const fn of(file: &'static str) -> [Definition; KEYS.len()] {
    let mut keys = [Definition { file, name: "", text: "" }; KEYS.len()];
    let mut at = 0;
    while at < keys.len() {
        keys[at].name = KEYS[at].0;
        keys[at].text = KEYS[at].1;
        at += 1;
    }
    keys
}
