//! Plot of a branch of periodic orbits.

use crate::look::{Look, Pen, Picture};
use crate::pictures::FigureError;
use stickslip_plot::{BranchCourse, Stretch, branch_figure};
use stickslip_run::provenance::{HASH, PROGRAM, SCENARIO, TITLE};
use stickslip_run::{Real, quantity};
use stickslip_study::steady::Multiplier;
use stickslip_study::steady::continuation::{Branch, Continuation, Mark, Point};

/// Names of the plot of a complete and of an interrupted branch.
const NAMES: [&str; 2] = ["branch", "branch-partial"];
/// Number of multipliers that are drawn.
const MOST: usize = 4;

/// Returns all possible file names of the plot; existing files are deleted when the plot is written. A complete branch also replaces an
/// interrupted one.
pub fn all_files(is_cut: bool) -> Vec<String> {
    Look::all_files_of(&NAMES[usize::from(is_cut)..])
}

/// Draws a branch: step lengths and |λ| of the largest Floquet multipliers over the parameter.
///
/// # Errors
/// If the figure cannot be drawn.
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
        stretches: stretches(branch),
        marks: marks(of, branch),
    };
    let cut = if branch.is_cut() { " (interrupted)" } else { "" };
    let title = format!("{}: periodic orbits{cut}", of.job.title());
    let pen = Pen { look, provenance, kept: None };
    let plot = NAMES[usize::from(branch.is_cut())];
    pen.draw_as(plot, branch_figure(&title, &course)).map_err(|source| FigureError::Plot { plot, source })
}

/// Returns the sections of equal stability along the branch. Where the stability changes, one section ends and the next begins at the
/// bifurcation point, or else at the last orbit before it.
fn stretches(branch: &Branch) -> Vec<Stretch> {
    let mut stretches: Vec<Stretch> = Vec::new();
    let mut before: Option<&Point> = None;
    for point in &branch.points {
        let change = before.filter(|before| before.is_stable() != point.is_stable());
        let place = change.map(|before| Place::between([before, point], &branch.marks));
        if let (Some(place), Some(ended)) = (&place, stretches.last_mut()) {
            place.add_to(ended);
        }
        if before.is_none() || change.is_some() {
            stretches.push(Stretch { stable: point.is_stable(), ..Stretch::default() });
        }
        if let Some(stretch) = stretches.last_mut() {
            place.iter().for_each(|place| place.add_to(stretch));
            Place::of(point).add_to(stretch);
        }
        before = Some(point);
    }
    stretches
}

/// Point of the curves: parameter, step length and |λ|.
struct Place {
    value: f64,
    step: f64,
    moduli: [f64; MOST],
}

impl Place {
    fn of(point: &Point) -> Self {
        // A complex pair counts twice, so that curves continue where two real multipliers become a pair.
        let each = |multiplier: &Multiplier| {
            let count = if multiplier.im == 0.0 { 1 } else { 2 };
            std::iter::repeat_n(multiplier.modulus(), count)
        };
        let mut moduli = point.multipliers.iter().flat_map(each);
        Self {
            value: point.value,
            step: point.step.unwrap_or(f64::NAN),
            moduli: std::array::from_fn(|_| moduli.next().unwrap_or(f64::NAN)),
        }
    }

    /// Returns the point between two orbits of different stability: the nearest bifurcation with a change of stability, with |λ|
    /// interpolated. Without a bifurcation nearby, returns the first orbit.
    fn between([before, after]: [&Point; 2], marks: &[Mark]) -> Self {
        let [low, high] = [before.value.min(after.value), before.value.max(after.value)];
        let apart = |mark: &&Mark| (low - mark.value).max(mark.value - high).max(0.0);
        let nearest = marks
            .iter()
            .filter(|mark| mark.stable[0] != mark.stable[1])
            .min_by(|one, other| apart(one).total_cmp(&apart(other)))
            .filter(|mark| apart(mark) <= high - low);
        let [before, after] = [before, after].map(Self::of);
        let Some(mark) = nearest else { return before };
        let apart = after.value - before.value;
        let part = if apart == 0.0 { 0.5 } else { ((mark.value - before.value) / apart).clamp(0.0, 1.0) };
        let moduli = std::array::from_fn(|k| (1.0 - part) * before.moduli[k] + part * after.moduli[k]);
        Self { value: mark.value, step: mark.step.unwrap_or(f64::NAN), moduli }
    }

    fn add_to(&self, stretch: &mut Stretch) {
        stretch.values.push(self.value);
        stretch.steps.push(self.step);
        stretch.moduli.resize(MOST, Vec::new());
        stretch.moduli.iter_mut().zip(self.moduli).for_each(|(moduli, modulus)| moduli.push(modulus));
    }
}

/// Returns the special points grouped by kind. The name of a kind contains the parameter value if there is only one point.
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

#[cfg(test)]
mod tests {
    use super::*;
    use stickslip_study::steady::continuation::{Bifurcation, End};

    /// A period doubling at 2.5 between orbits at 2 and 4: both sections meet there, and |λ| is interpolated to 1.
    #[test]
    fn stretches_meet_where_the_kind_changes() {
        let point = |value: f64, modulus: f64| Point {
            value,
            step: Some(value),
            bound: 0.0,
            period: 1.0,
            multipliers: vec![Multiplier { re: -modulus, im: 0.0, error: 0.0 }],
            unknowns: 2,
            piece: 0,
        };
        let mark = |value, stable| Mark {
            kind: Bifurcation::PeriodDoubling,
            value,
            half_width: 0.0,
            step: Some(value),
            stable,
        };
        let marks = vec![mark(2.2, [true, true]), mark(2.5, [true, false])];
        let points = vec![point(1.0, 0.5), point(2.0, 0.9), point(4.0, 1.3)];
        let branch = Branch { points, marks, start: 0, ends: [End::Range, End::Range] };
        let [solid, dashed] = &stretches(&branch)[..] else { panic!("not two") };
        assert!(solid.stable && !dashed.stable);
        assert_eq!((&solid.values[..], &dashed.values[..]), (&[1.0, 2.0, 2.5][..], &[2.5, 4.0][..]));
        assert!((solid.moduli[0][2] - 1.0).abs() < 1e-15 && (dashed.moduli[0][0] - 1.0).abs() < 1e-15);
    }
}
