//! Branch of periodic orbits over a parameter: step length and Floquet multipliers.

use crate::Label;
use crate::figure::{Arrangement, Figure};
use crate::panel::{Axis, Panel, Reference, Series};
use crate::theme::{Dash, Ink, Style};

/// Branch of periodic orbits over a continuation parameter.
#[derive(Debug, Clone, PartialEq)]
pub struct BranchCourse<'a> {
    /// Name and unit of the parameter.
    pub axis: (&'a str, &'a str),
    /// Value of the parameter in the scenario.
    pub present: f64,
    /// Sections of equal stability along the branch. Each begins where the previous one ends.
    pub stretches: Vec<Stretch>,
    /// Special points such as bifurcations: name, and for each point the parameter and the step length (NaN if none).
    pub marks: Vec<(String, Vec<[f64; 2]>)>,
}

/// Section of a branch with constant stability.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Stretch {
    /// Whether the periodic orbits are stable.
    pub stable: bool,
    /// Values of the parameter.
    pub values: Vec<f64>,
    /// Step lengths, m; NaN without a step length.
    pub steps: Vec<f64>,
    /// Moduli |λ| of the largest Floquet multipliers in descending order, each along the section.
    pub moduli: Vec<Vec<f64>>,
}

/// Draws step lengths over the parameter, and below |λ| of the largest Floquet multipliers. Stable sections are
/// solid, unstable ones dashed, special points are dots.
pub fn branch_figure<'a>(title: &str, branch: &BranchCourse<'a>) -> Figure<'a> {
    if branch.stretches.iter().all(|stretch| stretch.values.is_empty()) {
        return Figure::without_data(title, "the branch has no orbits");
    }
    let has_steps = branch.stretches.iter().any(|stretch| stretch.steps.iter().any(|step| step.is_finite()));
    let panels: Vec<Panel<'a>> =
        has_steps.then(|| steps(branch)).into_iter().chain([moduli(branch, !has_steps)]).collect();
    Figure {
        title: Label::plain(title),
        size: Figure::size_for(360, 640, panels.len()),
        panels,
        arrangement: Arrangement::Column { share_x: true },
        ..Figure::default()
    }
    .with_room_for_legends()
}

fn steps<'a>(branch: &BranchCourse<'a>) -> Panel<'a> {
    let mut lines = Lines::default();
    for stretch in &branch.stretches {
        lines.add(stretch, 0, stretch.steps.clone());
    }
    panel(branch, Axis::new(Label::plain("step"), "m"), (lines.series, dots(branch, |mark| mark[1])), 0.0)
}

/// Returns the panel of the moduli. Special points are drawn here at |λ| = 1 if there are no step lengths.
fn moduli<'a>(branch: &BranchCourse<'a>, with_marks: bool) -> Panel<'a> {
    let mut lines = Lines::default();
    for stretch in &branch.stretches {
        for (place, moduli) in stretch.moduli.iter().enumerate() {
            lines.add(stretch, place, moduli.clone());
        }
    }
    let marks = if with_marks { dots(branch, |_| 1.0) } else { Vec::new() };
    panel(branch, Axis::new(Label::plain("|\u{3bb}|"), ""), (lines.series, marks), 1.0)
}

fn panel<'a>(
    branch: &BranchCourse<'a>,
    y: Axis,
    (lines, marks): (Vec<Series<'a>>, Vec<Series<'a>>),
    level: f64,
) -> Panel<'a> {
    let (name, unit) = branch.axis;
    Panel {
        x: Axis::new(Label::plain(name), unit),
        y,
        series: lines.into_iter().chain(marks).collect(),
        references: vec![
            Reference::Horizontal { y: level, label: Label::default() },
            Reference::Vertical { x: branch.present, label: Label::plain("value in the scenario") },
        ],
        ..Panel::default()
    }
}

/// Curves of a panel. Only the first stable and the first unstable curve have a legend entry.
#[derive(Default)]
struct Lines<'a> {
    series: Vec<Series<'a>>,
    named: [bool; 2],
}

impl Lines<'_> {
    fn add(&mut self, stretch: &Stretch, place: usize, ys: Vec<f64>) {
        let (dash, name) = if stretch.stable { (Dash::Solid, "stable") } else { (Dash::Dashed, "unstable") };
        let named = &mut self.named[usize::from(stretch.stable)];
        let label = if *named || place > 0 { Label::default() } else { Label::plain(name) };
        *named |= place == 0;
        let width = if place == 0 { 1.5 } else { 0.8 };
        let ink = if place == 0 { Ink::Palette(0) } else { Ink::Muted };
        let style = Style { ink: Some(ink), dash: Some(dash), width };
        self.series.push(Series { style, ..Series::new(label, stretch.values.clone(), ys) });
    }
}

/// Returns the dots of the special points, one series per kind.
fn dots<'a>(branch: &BranchCourse<'a>, height: impl Fn(&[f64; 2]) -> f64) -> Vec<Series<'a>> {
    let of = |(kind, (name, places)): (usize, &(String, Vec<[f64; 2]>))| {
        // Points separated by gaps are drawn as dots.
        let xs: Vec<f64> = places.iter().flat_map(|place| [place[0], f64::NAN]).collect();
        let ys: Vec<f64> = places.iter().flat_map(|place| [height(place), f64::NAN]).collect();
        let style = Style { ink: Some(Ink::Palette(1 + kind)), dash: Some(Dash::Solid), width: 1.0 };
        Series { style, ..Series::new(Label::plain(name), xs, ys) }
    };
    branch.marks.iter().enumerate().map(of).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn stretch(stable: bool, values: [f64; 2]) -> Stretch {
        let moduli = if stable { vec![vec![0.9, 1.0]] } else { vec![vec![1.0, 1.2]] };
        Stretch { stable, values: values.to_vec(), steps: vec![1e-9, 2e-9], moduli }
    }

    #[test]
    fn what_a_run_leaves_is_dashed_and_places_are_dots() {
        let branch = BranchCourse {
            axis: ("load", "N"),
            present: 1.0,
            stretches: vec![stretch(true, [1.0, 2.0]), stretch(false, [2.0, 1.5])],
            marks: vec![("fold".to_owned(), vec![[2.0, 2e-9]])],
        };
        let figure = branch_figure("Title", &branch);
        let [steps, moduli] = &figure.panels[..] else { panic!("{}", figure.panels.len()) };
        let dashes: Vec<_> = steps.series.iter().map(|series| series.style.dash).collect();
        assert_eq!(dashes, [Dash::Solid, Dash::Dashed, Dash::Solid].map(Some));
        assert!(steps.series[2].is_scattered() && steps.series[2].xs[0] == 2.0);
        assert_eq!(moduli.series.len(), 2);
        assert!(crate::draw_svg(&figure).is_ok());
    }
}
