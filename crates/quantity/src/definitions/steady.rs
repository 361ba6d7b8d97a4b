//! What `stickslip steady` writes and `--json` says of a steady motion.

use super::Definition;

const fn key(name: &'static str, text: &'static str) -> Definition {
    Definition { file: "steady.json", name, text }
}

pub(super) const STEADY: &[Definition] = &[
    key("scenario", "name of the scenario"),
    key("scenario_sha256", "SHA-256 of the resolved scenario"),
    key("program", "name and version of the program"),
    key("tolerance", "local error per step, in natural scales"),
    key("period_s", "period, common to all waveforms"),
    key("step_m", "way of the body of the figures along x in a period"),
    key("step_error_m", "how far the step may be off: an estimate, [doubled](steady.md#bound)"),
    key("speed_m_s", "step over period"),
    key(
        "stable",
        "whether a run that is disturbed a little comes back; left out where a disturbance neither fades nor grows, of a shakedown unless it grows, as a run may end in another of its family, and where the memory of a contact that never slips grossly is `carried`: of that no multipliers are told",
    ),
    key(
        "radius",
        "ρ, largest magnitude of a multiplier; 0 where there is none, null where they are not known",
    ),
    key(
        "multipliers.re",
        "real part of a Floquet multiplier, the largest first; of a pair one stands for both",
    ),
    key("multipliers.im", "its imaginary part, at least 0"),
    key("multipliers.modulus", "|λ|, by which a disturbance has become larger after a period"),
    key("multipliers.error", "how far both parts, and |λ|, may be off: one as near to 1 as that `stays`"),
    key(
        "multipliers.kind",
        "what becomes of a disturbance: `forgotten` after a period, `fades`, `stays`, or `grows`",
    ),
    key("multipliers.beat_periods", "2π/|arg λ|, periods of a beat; none where it does not turn"),
    key("multipliers.fold_periods", "1/|ln |λ||, periods in which it becomes e times smaller, or larger"),
    key("multipliers.words", "the same in words"),
    key(
        "aftermath.ending",
        "what a run ends on that leaves an unstable motion, every number of it disturbed by a hundredth of a natural scale: it `repeats` itself, `beats`, is `irregular`, is `underway` still, or `stops`",
    ),
    key("aftermath.periods", "periods until then"),
    key("aftermath.repeats_periods", "after how many periods it repeats itself; 1: another steady motion"),
    key("aftermath.beat_periods", "periods of its beat"),
    key("aftermath.step_m", "mean step of what repeats itself, else of the last half"),
    key("aftermath.least_m", "the shortest of these steps"),
    key("aftermath.most_m", "the longest of these steps"),
    key("aftermath.words", "the same in words"),
    key("unknowns", "the numbers that the map of a period is of"),
    key(
        "untold",
        "those of which no multiplier is told: memories come back with other knots when one of them is disturbed",
    ),
    key("drifts", "number of ways along which nothing changes but the place"),
    key(
        "carried",
        "contacts whose memories are no numbers of the map: they are led along, and multipliers do not know of them",
    ),
    key(
        "shaken_down",
        "contacts that never slip grossly: what they hold near the centre they hold for ever, and this motion is the nearest of a whole family",
    ),
    key("work_periods", "periods that were computed"),
    key("defects.size", "largest change of a number in a period on the way, in natural scales"),
    key(
        "defects.way",
        "how the state of that period was found: `plain`, where the one before got to, or `newton`",
    ),
    key("files", "names of the files beside it"),
    key("notes", "what is to be known of the rest"),
];
