//! The table of examples in the documentation of periodic orbits agrees with the search.

use std::error::Error;
use std::fmt::Write;
use std::fs;
use std::path::Path;
use stickslip_run::{Job, Real, quantity};
use stickslip_study::steady::{self, Options};

/// Examples with a periodic orbit.
const EXAMPLES: [&str; 12] = [
    "p1",
    "quickstart",
    "ruby_drive",
    "sine_drive",
    "piezo_stack",
    "driven_stage",
    "three_ball_stage",
    "vibrated_slider",
    "walking_drive",
    "rocking_slider",
    "vertical_climber",
    "impact_drive",
];

fn root() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))
}

fn table() -> Result<String, Box<dyn Error>> {
    let mut table = "| scenario | step | unknowns | work | largest multiplier: a disturbance … |\n| --- | --- | ---: | ---: | --- |\n".to_owned();
    for name in EXAMPLES {
        let job = Job::prepare(&root().join(format!("scenarios/{name}.json")), &[], Path::new(""))?;
        let found = steady::find(&job, &Options::default())?;
        let step = quantity(Real(found.step.ok_or("a step")?), "m");
        let doubt = || found.doubt().map(|doubt| format!("is not known: {doubt}")).unwrap_or_default();
        let words = found.multipliers.first().map_or_else(doubt, steady::Multiplier::words);
        let shaken = if found.shaken_down.is_empty() { "" } else { "; a shakedown" };
        let (unknowns, work) = (found.unknowns.len(), found.work);
        writeln!(table, "| `{name}.json` | {step} | {unknowns} | {work} | {words}{shaken} |")?;
    }
    Ok(table)
}

#[test]
fn the_page_has_the_table() -> Result<(), Box<dyn Error>> {
    let path = root().join("docs/theory/periodic_orbits.md");
    let page = fs::read_to_string(&path)?;
    let (before, rest) = page.split_once("--test studies page -->\n").ok_or("a mark before the table")?;
    let (shown, after) = rest.split_once("<!-- end -->").ok_or("a mark behind it")?;
    let table = table()?;
    if std::env::var_os("STICKSLIP_WRITE").is_some() {
        fs::write(&path, format!("{before}--test studies page -->\n{table}<!-- end -->{after}"))?;
        return Ok(());
    }
    assert_eq!(shown, table);
    Ok(())
}
