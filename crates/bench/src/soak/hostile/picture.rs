//! Plot of the matrix: a panel for each family, a cell for each scenario and stepper.

use super::cell::{COLUMNS, Cells};
use crate::soak::finding::{Finding, Verdict};
use std::collections::HashMap;
use stickslip_plot::{
    Arrangement, Axis, Colour, Figure, Ink, Label, Mosaic, Panel, PlotError, Theme, draw_png, draw_svg,
};
use stickslip_run::program::this_program;
use stickslip_run::provenance;

/// Name of the plot files without extension.
pub(super) const NAME: &str = "matrix";
/// Number of panels per row.
const PANELS: usize = 4;
/// Height of a row of panels, and of title and legend, px.
const HEIGHT: (u32, u32) = (500, 240);

/// Groups of verdicts with their colours, from pale for right to dark for faults. The colours suit colour-blind readers and grey prints.
const GROUPS: [(&str, Colour); 5] = [
    ("right", Colour(0xBF, 0xDD, 0xEE)),
    ("warned", Colour(0x56, 0xB4, 0xE9)),
    ("refused, limited, stopped: a typed error", Colour(0xE6, 0x9F, 0x00)),
    ("undecided or grazing", Colour(0x99, 0x99, 0x99)),
    ("wrong, unbalanced, hung, panicked", Colour(0x8B, 0x00, 0x00)),
];

/// Returns the index of the group of a verdict.
pub(super) fn group(verdict: Verdict) -> u8 {
    match verdict {
        Verdict::Right => 0,
        Verdict::Warned => 1,
        Verdict::Refused | Verdict::Left | Verdict::Limited | Verdict::Stopped => 2,
        Verdict::Undecided | Verdict::Grazing => 3,
        Verdict::Unbalanced | Verdict::Wrong | Verdict::Hung | Verdict::Panicked => 4,
    }
}

/// Draws the plot as light and dark PNG and as SVG, from the findings of all cells.
pub(super) fn draw(findings: &[Finding]) -> Result<Vec<(String, Vec<u8>)>, PlotError> {
    let cells = Cells::new();
    let verdicts: HashMap<u64, Verdict> = findings.iter().map(|found| (found.seed, found.verdict)).collect();
    let mut number = 0;
    let mut panels = Vec::new();
    for family in cells.families() {
        let count = family.values.len() * COLUMNS.len();
        let groups = (number..number + count as u64).map(|cell| verdicts.get(&cell).map_or(4, |v| group(*v)));
        let mosaic = Mosaic {
            xs: family.values.iter().map(|value| family.place(*value)).collect::<Vec<f64>>().into(),
            ys: COLUMNS.iter().map(|column| column.place()).collect::<Vec<f64>>().into(),
            cells: groups.collect::<Vec<u8>>().into(),
            classes: GROUPS.map(|(name, colour)| (Label::plain(name), Ink::Colour(colour))).to_vec(),
        };
        panels.push(Panel {
            heading: Label::plain(family.axis),
            x: Axis { tight: true, ..Axis::new(Label::plain(family.label()), "") },
            y: Axis { tight: true, ..Axis::new(Label::plain("digits"), "") },
            mosaic: Some(mosaic),
            ..Panel::default()
        });
        number += count as u64;
    }
    let rows = panels.len().div_ceil(PANELS) as u32;
    let mut figure = Figure {
        title: Label::plain("Stepper event at 2 to 14 digits; dopri5 at 0, rk4 at −2, verlet at −4"),
        panels,
        arrangement: Arrangement::Grid { columns: PANELS, share: false },
        size: (2400, HEIGHT.1 + rows * HEIGHT.0),
        ..Figure::default()
    };
    figure.provenance = vec![(provenance::PROGRAM.to_owned(), this_program())];
    let dark = Figure { theme: Theme::dark(), ..figure.clone() };
    Ok(vec![
        (format!("{NAME}.png"), draw_png(&figure)?),
        (format!("{NAME}-dark.png"), draw_png(&dark)?),
        (format!("{NAME}.svg"), draw_svg(&figure)?.into_bytes()),
    ])
}
