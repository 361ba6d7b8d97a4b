//! The picture of a branch of steady motions.

use crate::look::{Look, Pen, Picture};
use crate::pictures::FigureError;
use stickslip_plot::{BranchCourse, Stretch, branch_figure};
use stickslip_results::provenance::{HASH, PROGRAM, SCENARIO, TITLE};
use stickslip_results::{Real, quantity};
use stickslip_study::steady::continuation::{Branch, Continuation, Point};

/// Name of the picture.
const NAME: &str = "branch";
/// Multipliers that are drawn.
const MOST: usize = 4;

/// Names of all files that any look gives to it.
pub fn all_files() -> Vec<String> {
    Look::all_files_of(&[NAME])
}

/// Draws it: steps over what is varied, and |λ| of the largest multipliers.
///
/// # Errors
/// What cannot be drawn.
pub fn draw(of: &Continuation, branch: &Branch, look: &Look) -> Result<Vec<Picture>, FigureError> {
    let entries = [
        (TITLE, of.job.title().to_owned()),
        (PROGRAM, of.job.program.clone()),
        ("Branch", of.path.clone()),
        (HASH, of.job.hash.clone()),
        (SCENARIO, of.job.resolved.clone()),
    ];
    let provenance = entries.map(|(key, text)| (key.to_owned(), text)).to_vec();
    let course = BranchCourse {
        axis: (&of.path, of.unit),
        present: of.present,
        stretches: stretches(&branch.points),
        marks: marks(of, branch),
    };
    let title = format!("{}: steady motions", of.job.title());
    let pen = Pen { look, provenance, kept: None };
    pen.draw_as(NAME, branch_figure(&title, &course))
        .map_err(|source| FigureError::Plot { plot: NAME, source })
}

/// Motions of one kind along the branch; each stretch begins where the one before ended.
fn stretches(points: &[Point]) -> Vec<Stretch> {
    let mut stretches: Vec<Stretch> = Vec::new();
    let mut before: Option<&Point> = None;
    for point in points {
        let is_same = before.is_some_and(|before| before.is_stable() == point.is_stable());
        if !is_same {
            stretches.push(Stretch { stable: point.is_stable(), ..Stretch::default() });
            // The line goes on from the last motion of the other kind.
            if let (Some(before), Some(stretch)) = (before, stretches.last_mut()) {
                add(stretch, before);
            }
        }
        if let Some(stretch) = stretches.last_mut() {
            add(stretch, point);
        }
        before = Some(point);
    }
    stretches
}

fn add(stretch: &mut Stretch, point: &Point) {
    stretch.values.push(point.value);
    stretch.steps.push(point.step.unwrap_or(f64::NAN));
    stretch.moduli.resize(MOST, Vec::new());
    for (place, moduli) in stretch.moduli.iter_mut().enumerate() {
        moduli.push(point.multipliers.get(place).map_or(f64::NAN, |multiplier| multiplier.modulus()));
    }
}

/// Places by what happens there, with where that is if there is only one.
fn marks(of: &Continuation, branch: &Branch) -> Vec<(String, Vec<[f64; 2]>)> {
    let mut marks: Vec<(String, Vec<[f64; 2]>)> = Vec::new();
    for mark in &branch.marks {
        let at = [mark.value, mark.step.unwrap_or(f64::NAN)];
        match marks.iter_mut().find(|(name, _)| name == mark.kind.name()) {
            Some((_, places)) => places.push(at),
            None => marks.push((mark.kind.name().to_owned(), vec![at])),
        }
    }
    for (name, places) in &mut marks {
        *name = match &places[..] {
            [[at, _]] if of.unit.is_empty() => format!("{name}: {at:.4}"),
            [[at, _]] => format!("{name}: {}", quantity(Real(*at), of.unit)),
            all => format!("{name}, {} places", all.len()),
        };
    }
    marks
}
