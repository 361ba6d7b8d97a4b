//! What `stickslip characterise` writes and `--json` says of a curve of a machine.

use super::Definition;

const fn column(name: &'static str, text: &'static str) -> Definition {
    Definition { file: "curve.csv", name, text }
}

const fn key(name: &'static str, text: &'static str) -> Definition {
    Definition { file: "curve.json", name, text }
}

const STEP: &str = "step along x of the figures' body in a period of the figures' waveform, in steady motion; the mean of steps that swing";
const ERROR: &str = "how far the step may be off, an estimate: of what was left of the way to it, and of the run's tolerance; of steps that \
     swing how far the mean of endlessly many may lie from it, by 95 %";
const SPREAD: &str = "by how much steps swing about their mean from period to period; 0 of steady ones";
const SPEED: &str = "mean speed along x: step over period";
const POWER: &str = "load times mean speed, above 0 where the drive moves against the load, 0 where there is no step; of loads only";
const PERIOD: &str = "period of the figures' waveform";
const MOTION: &str = "`steady`, `no step` (steady, and the step is no longer than it may be off, or than a hundred-thousandth of u_c), `beats` (steps swing about a mean) or `irregular`";
const MULTIPLIER: &str = "|λ|, modulus of the largest Floquet multiplier: by how much a disturbance is smaller after a period; none of \
     motions that were waited for";
const BEAT: &str = "periods in which that disturbance turns once; none where it does not";
const WORK: &str = "periods that were computed";

const SENSE: &str =
    "of both senses (`--both`): `forward`, as the scenario is, or `backward`, its waveforms reversed in time";
const HELD: &str =
    "of `holding-force`: the largest load along +x on the figures' body that the drive holds at rest";
const HELD_BACK: &str = "of `holding-force`: the same of loads along -x";
const HELD_OFF: &str =
    "how far that may be off: half of the bracket in which it lies, and how far a balance is known";
const BEYOND: &str =
    "what gives way beyond: a body that slides away, comes loose or, free to pitch, slides or tips over";
const UNHELD: &str = "why there is no such force: the drive does not even hold what acts without the load, or something else than friction holds any";

pub(super) const CURVE: &[Definition] = &[
    column("stroke_m", "of `step-amplitude`: stroke of the figures' waveform"),
    column("amplitude_m", "the same of a sine or a sum of harmonics: its amplitude"),
    column("frequency_Hz", "of `speed-frequency`: one over the period of the figures' waveform"),
    column("load_N", "of `force-speed` and `step-load`: load on the figures' body, against its steps"),
    column(
        "preload_N",
        "of `preload` and `holding-force`: normal force of the body's contacts, all together",
    ),
    column("sense", SENSE),
    column("step_m", STEP),
    column("step_error_m", ERROR),
    column("step_spread_m", SPREAD),
    column("speed_m_s", SPEED),
    column("power_W", POWER),
    column("period_s", PERIOD),
    column("motion", MOTION),
    column("multiplier", MULTIPLIER),
    column("beat_periods", BEAT),
    column("work_periods", WORK),
    column("fault", "why there is no motion at this value"),
    column("along_x_N", HELD),
    column("along_x_half_width_N", HELD_OFF),
    column("along_x_gives_way", BEYOND),
    column("along_x_fault", UNHELD),
    column("against_x_N", HELD_BACK),
    column("against_x_half_width_N", HELD_OFF),
    column("against_x_gives_way", BEYOND),
    column("against_x_fault", UNHELD),
    key("scenario", "name of the scenario"),
    key("scenario_sha256", "SHA-256 of the resolved scenario, as it is without what the curve varies"),
    key("program", "name and version of the program"),
    key("status", "`done`, or `interrupted`: then the file is `curve-partial.json`"),
    key("curve", "name of the curve; `vary` of a number by its path"),
    key("varied", "what is varied; it heads the first column of `curve.csv`, with its unit"),
    key("unit", "its SI unit; empty of a plain number"),
    key("present", "what it is in the scenario"),
    key("against", "along which sense of x the drive steps without load, against which loads act"),
    key("against_backward", "the same of the backward sense"),
    key("on", "body that is loaded; of `holding-force`"),
    key("points.value", "what is varied, at this point"),
    key("points.sense", SENSE),
    key("points.set", "what `--set` takes to make a scenario of this point"),
    key(
        "points.warnings.kind",
        "what a warning is about, as one word; the warnings of `check` with the point's `set`",
    ),
    key("points.warnings.path", "key path in the scenario of what is implausible"),
    key("points.warnings.message", "what there is to say, with its number"),
    key("points.step_m", STEP),
    key("points.step_error_m", ERROR),
    key("points.step_spread_m", SPREAD),
    key("points.speed_m_s", SPEED),
    key("points.power_W", POWER),
    key("points.period_s", PERIOD),
    key("points.motion", MOTION),
    key("points.multiplier", MULTIPLIER),
    key("points.beat_periods", BEAT),
    key("points.work_periods", WORK),
    key("points.fault", "why there is no motion at this value"),
    key("points.along_x.force_N", HELD),
    key("points.along_x.half_width_N", HELD_OFF),
    key("points.along_x.gives_way", BEYOND),
    key("points.along_x.runs", "equilibria that were looked for"),
    key("points.along_x.fault", UNHELD),
    key("points.against_x.force_N", HELD_BACK),
    key("points.against_x.half_width_N", HELD_OFF),
    key("points.against_x.gives_way", BEYOND),
    key("points.against_x.runs", "equilibria that were looked for"),
    key("points.against_x.fault", UNHELD),
    key(
        "landmarks.name",
        "`zero_step` (S₀, largest amplitude without a step; with `beyond_by` largest amplitude with one), `stall` (least load against which there is none), `best_speed`, \
         `best_power` or `best_step`",
    ),
    key("landmarks.sense", SENSE),
    key("landmarks.at", "what is varied, there"),
    key(
        "landmarks.half_width",
        "how far that may be off: half of the bracket in which it lies, and what the errors of the steps there add",
    ),
    key("landmarks.value", "speed in m/s, power in W or step in m there; of best points only"),
    key("landmarks.runs", "points that were computed for it, beside those of the curve"),
    key(
        "landmarks.turns",
        "true of S₀ where the drive steps back at smaller amplitudes, so that its step changes its sign there",
    ),
    key("landmarks.below", "of S₀ where all points of the curve step: the smallest amplitude of them"),
    key(
        "landmarks.beyond_by",
        "of the largest amplitude with a step: `window` where the driver's window cuts the command beyond it, `current` where a driver has a \
         largest current, `other`",
    ),
    key("landmarks.fault", "why it is not known"),
    key("files", "names of all files that were written together"),
    key("table_sha256", "SHA-256 of the table"),
];
