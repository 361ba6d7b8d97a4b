//! What `stickslip sensitivity` writes and `--json` says of derivatives.

use super::Definition;

const fn column(name: &'static str, text: &'static str) -> Definition {
    Definition { file: "sensitivity.csv", name, text }
}

const fn key(name: &'static str, text: &'static str) -> Definition {
    Definition { file: "sensitivity.json", name, text }
}

const FIGURE: &str =
    "name of the figure: a number of summary.json, a channel at the end of the run, or one of steady motion";
const FIGURE_UNIT: &str = "its SI unit; empty of a plain number";
const FIGURE_VALUE: &str = "what it is in the scenario as it stands, by the tolerance of the derivatives";
const QUANTITY: &str = "key path of the number that the derivative is with respect to";
const QUANTITY_UNIT: &str = "its SI unit; empty of a plain number";
const QUANTITY_VALUE: &str = "what it is in the scenario";
const SIDE: &str = "`below` or `above` of slopes that hold on one side of the quantity's value; none of those that hold on both";
const DERIVATIVE: &str = "change of the figure per change of the quantity";
const DERIVATIVE_ERROR: &str = "how far that may be off: by what a coarser variation differs, or by bends that the extrapolation misses and by measured noise";
const UNIT: &str = "unit of both";
const ELASTICITY: &str =
    "by how many per cent the figure changes with one per cent of the quantity; none of figures that are 0";
const ELASTICITY_ERROR: &str = "how far that may be off";
const SOURCE: &str =
    "where the derivative comes from: `variation` of the scenario's own run, or `differences` between runs";
const NOTE: &str = "why there is none, or why both sides have their own";

pub(super) const SENSITIVITY: &[Definition] = &[
    column("figure", FIGURE),
    column("figure_unit", FIGURE_UNIT),
    column("figure_value", FIGURE_VALUE),
    column("quantity", QUANTITY),
    column("quantity_unit", QUANTITY_UNIT),
    column("quantity_value", QUANTITY_VALUE),
    column("side", SIDE),
    column("derivative", DERIVATIVE),
    column("derivative_error", DERIVATIVE_ERROR),
    column("unit", UNIT),
    column("elasticity", ELASTICITY),
    column("elasticity_error", ELASTICITY_ERROR),
    column("source", SOURCE),
    column("note", NOTE),
    key("scenario", "name of the scenario"),
    key("scenario_sha256", "SHA-256 of the resolved scenario"),
    key("program", "name and version of the program"),
    key("status", "`done`, or `interrupted`: then the file is `sensitivity-partial.json`"),
    key("tolerance", "local error per step of the runs, in natural scales"),
    key("runs", "runs that were done beside that of the scenario as it stands"),
    key("figures.name", FIGURE),
    key("figures.unit", FIGURE_UNIT),
    key("figures.value", FIGURE_VALUE),
    key(
        "figures.noise",
        "standard deviation of what is no smooth change in it between neighbouring runs; none where it could not be measured",
    ),
    key("figures.derivatives.quantity", QUANTITY),
    key("figures.derivatives.quantity_unit", QUANTITY_UNIT),
    key("figures.derivatives.quantity_value", QUANTITY_VALUE),
    key("figures.derivatives.side", SIDE),
    key("figures.derivatives.derivative", DERIVATIVE),
    key("figures.derivatives.derivative_error", DERIVATIVE_ERROR),
    key("figures.derivatives.unit", UNIT),
    key("figures.derivatives.elasticity", ELASTICITY),
    key("figures.derivatives.elasticity_error", ELASTICITY_ERROR),
    key("figures.derivatives.source", SOURCE),
    key(
        "figures.derivatives.reach",
        "how far from its value the quantity was in the farthest run that counts, in its unit; none of a variation",
    ),
    key(
        "figures.derivatives.split",
        "what differs between the sides: `kink` (the slopes), `jump` (the figure itself), `events` (one appears or vanishes), \
         `one_sided` (the other is refused, stops or has no such figure)",
    ),
    key("figures.derivatives.note", NOTE),
    key("files", "names of all files that were written together"),
    key("table_sha256", "SHA-256 of `sensitivity.csv`"),
];
