//! What `stickslip steady --continue` writes and `--json` says of a branch of steady motions.

use super::Definition;

const fn column(name: &'static str, text: &'static str) -> Definition {
    Definition { file: "branch.csv", name, text }
}

const fn key(name: &'static str, text: &'static str) -> Definition {
    Definition { file: "branch.json", name, text }
}

const PIECE: &str =
    "which smooth piece of the branch: another one begins where an event of the period appears or vanishes";
const STEP: &str = "step along x of the figures' body in a period; none where no body is free along x";
const ERROR: &str = "how far the step may be off, an estimate of first order, doubled";
const SPEED: &str = "mean speed along x: step over period";
const PERIOD: &str = "period common to all waveforms";
const STABLE: &str = "whether a run that is disturbed a little comes back: no |λ| > 1";
const UNKNOWNS: &str = "how many numbers the map of a period has";

pub(super) const BRANCH: &[Definition] = &[
    column("piece", PIECE),
    column("step_m", STEP),
    column("step_error_m", ERROR),
    column("speed_m_s", SPEED),
    column("period_s", PERIOD),
    column("stable", "1 where a run that is disturbed a little comes back, else 0"),
    column("multiplier", "|λ|, modulus of the largest Floquet multiplier"),
    column("beat_periods", "periods in which that disturbance turns once; none where it does not"),
    column("unknowns", UNKNOWNS),
    key("scenario", "name of the scenario"),
    key("scenario_sha256", "SHA-256 of the resolved scenario, as it is where the branch starts"),
    key("program", "name and version of the program"),
    key("status", "`done`, or `interrupted`: then the file is `branch-partial.json`"),
    key("varied", "key path of what is varied; it heads the first column of `branch.csv`, with its unit"),
    key("unit", "its SI unit; empty of a plain number"),
    key("present", "what it is in the scenario: where the branch starts"),
    key("from", "where the range begins"),
    key("to", "where the range ends"),
    key("tolerance", "local error per step of the runs"),
    key("accuracy", "how exactly places are told, as a share of the range"),
    key("start", "place of the start among the points, counted from 0"),
    key("points.value", "what is varied, at this motion; motions stand in their order along the branch"),
    key("points.piece", PIECE),
    key("points.step_m", STEP),
    key("points.step_error_m", ERROR),
    key("points.speed_m_s", SPEED),
    key("points.period_s", PERIOD),
    key("points.stable", STABLE),
    key(
        "points.multipliers",
        "Floquet multipliers, real and imaginary part, the largest first; of a pair the one above",
    ),
    key("points.unknowns", UNKNOWNS),
    key(
        "marks.kind",
        "`fold` (the branch turns back), `period doubling` (λ = -1), `Neimark-Sacker` (a pair with |λ| = 1), `branching` (another branch \
         crosses), `break` (multipliers jump) or `event` (something appears in a period or vanishes)",
    ),
    key("marks.value", "what is varied, there"),
    key("marks.half_width", "how far that may be off: half of the bracket in which it lies"),
    key("marks.step_m", "step there"),
    key(
        "marks.stable",
        "whether motions are stable on the side of smaller and on that of larger values; of a fold before it and after it along the branch",
    ),
    key("marks.beat_periods", "periods of the beat that neither fades nor grows; of Neimark-Sacker only"),
    key("marks.changes.source", "contact or block whose event it is"),
    key("marks.changes.event", "the event"),
    key("marks.changes.below", "how often it happens in a period below the place"),
    key("marks.changes.above", "how often above it"),
    key("marks.words", "what happens, in words"),
    key("ends.value", "what is varied, at the first and at the last motion"),
    key(
        "ends.kind",
        "`range` (its end), `shakedown` (beyond, a contact never slips grossly: a whole family of motions), `slides away` (what pulls a \
         body is as much as friction holds: any speed does), `rounded` (rounding leaves nothing of what friction does in a period), `lost` (no motion was found beyond), `refused` (the scenario allows no value beyond), `points` (as many as were allowed) or `interrupted`",
    ),
    key("ends.words", "the same in words"),
    key("files", "names of all files that were written together"),
    key("table_sha256", "SHA-256 of `branch.csv`"),
];
