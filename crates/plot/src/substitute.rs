//! Contact as the MDR substitute: the profile g(x) pressed into a row of springs (Handbook of Contact Mechanics, figure 4.2).

use crate::figure::{Arrangement, Figure};
use crate::panel::{Axis, Note, Panel, Series, Shape};
use crate::scale::quantity;
use crate::scene::symbols::{Lines, arrow, hatched};
use crate::theme::{Dash, Ink, Style};
use crate::thin::Point;
use crate::{Label, SpringCondition};

/// Row of springs of a contact at one time.
#[derive(Debug, Clone, PartialEq)]
pub struct SubstituteMoment<'a> {
    /// Heading of the panel, such as the time.
    pub heading: &'a str,
    /// Indentation d, m.
    pub d: f64,
    /// Contact radius a and stick radius c, m.
    pub radii: (f64, f64),
    /// Radius by which positions are scaled, m: the largest contact radius of all times.
    pub scale: f64,
    /// Indentation by which depths are scaled, m: the largest of all times.
    pub deepest: f64,
    /// Stretch by which stretches are scaled, m: the gross slip displacement at the largest indentation, or a larger stretch.
    pub largest_stretch: f64,
    /// Normal and tangential force, N.
    pub forces: (f64, f64),
    /// Friction limit μ`F_N`, N.
    pub limit: f64,
    /// Positions of the springs, m, ascending.
    pub x: &'a [f64],
    /// Heights g(x) of the springs, m.
    pub g: &'a [f64],
    /// Tangential stretches of the springs, m.
    pub stretch: &'a [f64],
    /// States of the springs.
    pub conditions: &'a [SpringCondition],
}

/// Lengths in the drawing: contact radius, indentation, largest stretch, rest length of a spring.
const RADIUS: f64 = 100.0;
const DEPTH: f64 = 36.0;
const SHEAR: f64 = 17.0;
const SPRING: f64 = 86.0;
/// Height at which the profile is cut, and height of the indenter's top.
const CUT: f64 = 52.0;
const TOP: f64 = 78.0;
/// Heights of the dimension lines, and the frame.
const DIMENSIONS: [f64; 2] = [-112.0, -158.0];
const FRAME: [(f64, f64); 2] = [(-215.0, 215.0), (-208.0, 142.0)];
/// Number of turns of a spring, and half its width.
const TURNS: usize = 5;
const COIL: f64 = 3.2;
/// Maximum number of springs in the drawing.
const SHOWN: usize = 25;
/// Scale of arrowheads and hatches.
const UNIT: f64 = 0.5;
const DIGITS: usize = 3;

/// Draws one sketch per time. The springs are sheared by their stretch and coloured by their state. Dimension lines show the widths 2a of
/// the contact and 2c of the stick zone, arrows the forces. Depths and stretches are not to scale.
pub fn substitute_figure(title: &str, moments: &[SubstituteMoment<'_>]) -> Figure<'static> {
    if moments.iter().all(|moment| moment.x.is_empty() || moment.scale <= 0.0) {
        return Figure::without_data(title, "the contact is always open");
    }
    let columns = moments.len().min(2);
    let rows = moments.len().div_ceil(columns);
    let mut panels: Vec<Panel<'static>> = moments.iter().map(panel).collect();
    // One legend for all panels.
    let shown =
        |condition: &SpringCondition| moments.iter().any(|moment| moment.conditions.contains(condition));
    for panel in &mut panels {
        panel.series.extend(ALL.iter().filter(|condition| shown(condition)).map(|condition| {
            let (label, ink) = look(*condition);
            Series { style: style(ink), ..Series::new(label, vec![], vec![]) }
        }));
    }
    Figure {
        title: Label::plain(title),
        panels,
        arrangement: Arrangement::Grid { columns, share: false },
        size: Figure::size_for(190, if columns == 1 { 1220 } else { 700 }, rows),
        ..Figure::default()
    }
}

/// Sketch of one time.
struct Sketch<'m, 'a> {
    moment: &'m SubstituteMoment<'a>,
    /// Tangential displacement of the indenter in the drawing: the stretch of its innermost spring.
    shift: f64,
}

fn panel(moment: &SubstituteMoment<'_>) -> Panel<'static> {
    let sketch = Sketch { moment, shift: 0.0 };
    let innermost = (0..moment.x.len()).min_by(|i, j| moment.g[*i].total_cmp(&moment.g[*j]));
    let sketch = Sketch { shift: innermost.map_or(0.0, |i| sketch.shear(moment.stretch[i])), ..sketch };
    let (mut series, mut notes) = (sketch.springs(), Vec::new());
    let ground = hatched((FRAME[0].1, -SPRING), (FRAME[0].0, -SPRING), UNIT);
    series.extend(drawn(ground, Ink::Foreground, 0.45));
    let indenter = sketch.indenter();
    let mut rim = indenter.clone();
    rim.extend(indenter.first());
    series.extend(drawn(vec![rim], Ink::Foreground, 0.7));
    sketch.dimensions(&mut series, &mut notes);
    sketch.forces(&mut series, &mut notes);
    let axis =
        |(low, high)| Axis { unnumbered: true, tight: true, covers: Some((low, high)), ..Axis::default() };
    let [wide, high] = FRAME;
    Panel {
        heading: Label::plain(moment.heading),
        x: axis(wide),
        y: axis(high),
        shapes: vec![Shape { label: Label::default(), corners: indenter, ink: Ink::Shade(1) }],
        series,
        notes,
        aspect: Some((wide.1 - wide.0) / (high.1 - high.0)),
        ..Panel::default()
    }
}

fn drawn(lines: Lines, ink: Ink, width: f64) -> impl Iterator<Item = Series<'static>> {
    lines.into_iter().map(move |line| {
        let (xs, ys): (Vec<f64>, Vec<f64>) = line.into_iter().unzip();
        let style = Style { ink: Some(ink), dash: Some(Dash::Solid), width };
        Series { style, ..Series::new("", xs, ys) }
    })
}

/// States in the order of the legend.
const ALL: [SpringCondition; 4] = [
    SpringCondition::Stick,
    SpringCondition::SlipForward,
    SpringCondition::SlipBackward,
    SpringCondition::Open,
];

/// Returns the style of a spring.
fn style(ink: Ink) -> Style {
    Style { ink: Some(ink), dash: Some(Dash::Solid), width: 0.75 }
}

/// Returns the legend entry and colour of a spring.
fn look(condition: SpringCondition) -> (&'static str, Ink) {
    match condition {
        SpringCondition::Open => ("open", Ink::Muted),
        SpringCondition::Stick => ("sticks", Ink::Palette(0)),
        SpringCondition::SlipForward => ("slips +", Ink::Palette(1)),
        SpringCondition::SlipBackward => ("slips −", Ink::Palette(2)),
    }
}

impl Sketch<'_, '_> {
    /// Converts a stretch to the drawing.
    fn shear(&self, stretch: f64) -> f64 {
        if self.moment.largest_stretch > 0.0 { SHEAR * stretch / self.moment.largest_stretch } else { 0.0 }
    }

    /// Converts a position to the drawing.
    fn place(&self, x: f64) -> f64 {
        RADIUS * x / self.moment.scale
    }

    /// Returns the height of the profile in the drawing above the undeformed surface.
    fn height(&self, g: f64) -> f64 {
        DEPTH * (g - self.moment.d) / self.moment.deepest
    }

    /// Returns the corners of the indenter.
    fn indenter(&self) -> Vec<Point> {
        let points = self.moment.x.iter().zip(self.moment.g);
        let points = points.map(|(x, g)| (self.place(*x) + self.shift, self.height(*g)));
        let mut profile: Vec<Point> = points.filter(|(_, y)| *y <= CUT).collect();
        if let (Some(first), Some(last)) = (profile.first().copied(), profile.last().copied()) {
            profile.extend([(last.0, TOP), (first.0, TOP)]);
        }
        profile
    }

    /// Returns the height of the indenter over a position in the drawing.
    fn surface(&self, at: f64) -> f64 {
        let (x, g) = (self.moment.x, self.moment.g);
        let place = (at - self.shift) * self.moment.scale / RADIUS;
        let above = x.partition_point(|x| *x < place);
        let g = match (above.checked_sub(1), x.get(above)) {
            (Some(below), Some(next)) => {
                g[below] + (g[above] - g[below]) * (place - x[below]) / (next - x[below])
            }
            (Some(below), None) => g[below],
            (None, _) => g.first().copied().unwrap_or(0.0),
        };
        self.height(g)
    }

    /// Returns the springs from the ground to the indenter, or to their rest length if open.
    fn springs(&self) -> Vec<Series<'static>> {
        let moment = self.moment;
        let stride = moment.x.len().div_ceil(SHOWN).max(1);
        // Symmetric about the middle.
        let first = (moment.x.len() / 2) % stride;
        let springs = (first..moment.x.len()).step_by(stride).map(|i| {
            let (_, ink) = look(moment.conditions[i]);
            let foot = (self.place(moment.x[i]), -SPRING);
            let tip = match moment.conditions[i] {
                SpringCondition::Open => (foot.0, 0.0),
                _ => {
                    let at = foot.0 + self.shear(moment.stretch[i]);
                    // A tip that is drawn beyond the edge of the indenter stays at the surface.
                    (at, self.surface(at).min(0.0))
                }
            };
            let (xs, ys): (Vec<f64>, Vec<f64>) = zigzag(foot, tip).into_iter().unzip();
            Series { style: style(ink), ..Series::new("", xs, ys) }
        });
        springs.filter(|series| series.xs.iter().all(|x| (FRAME[0].0..FRAME[0].1).contains(x))).collect()
    }

    /// Draws the widths of contact and stick zone.
    fn dimensions(&self, series: &mut Vec<Series<'static>>, notes: &mut Vec<Note>) {
        let (a, c) = self.moment.radii;
        for (symbol, radius, y) in [("2c", c, DIMENSIONS[0]), ("2a", a, DIMENSIONS[1])] {
            let half = self.place(radius);
            if half <= 0.0 {
                continue;
            }
            series.extend(drawn(arrow((-half, y), (half, y), true, UNIT), Ink::Foreground, 0.5));
            let ends = [-half, half].map(|x| vec![(x, y - 4.0), (x, -SPRING - 10.0)]);
            series.extend(drawn(ends.to_vec(), Ink::Muted, 0.35));
            let words = format!("{symbol} = {}", quantity(2.0 * radius, "m", DIGITS));
            notes.push(Note {
                lines: vec![Label::plain(&words)],
                about: [(-half, y), (half, y)],
                on: None,
                ink: None,
            });
        }
    }

    /// Draws the forces on the indenter.
    fn forces(&self, series: &mut Vec<Series<'static>>, notes: &mut Vec<Note>) {
        let (normal, tangential) = self.moment.forces;
        let mut push = |from: Point, to: Point, symbol: &str, force: f64| {
            series.extend(drawn(arrow(from, to, false, 0.8), Ink::Palette(3), 1.1));
            let words = Label::markup(symbol).followed_by(&format!(" = {}", quantity(force, "N", DIGITS)));
            notes.push(Note { lines: vec![words], about: [from, to], on: None, ink: None });
        };
        if normal > 0.0 {
            push((self.shift, TOP + 44.0), (self.shift, TOP + 3.0), "F_N", normal);
        }
        let corners = self.indenter();
        let edge = if tangential > 0.0 {
            corners.iter().map(|point| point.0).fold(f64::NEG_INFINITY, f64::max)
        } else {
            corners.iter().map(|point| point.0).fold(f64::INFINITY, f64::min)
        };
        if tangential != 0.0 && self.moment.limit > 0.0 && edge.is_finite() {
            // At the face in the direction of the force; the length of the arrow is proportional to F_x/(μF_N).
            let way = tangential.signum() * (14.0 + 36.0 * (tangential / self.moment.limit).abs().min(1.0));
            push((edge, 0.5 * (CUT + TOP)), (edge + way, 0.5 * (CUT + TOP)), "F_x", tangential);
        }
    }
}

/// Returns the zigzag of a spring from foot to tip, with horizontal turns.
fn zigzag(foot: Point, tip: Point) -> Vec<Point> {
    let at = |share: f64, aside: f64| {
        (foot.0 + (tip.0 - foot.0) * share + aside, foot.1 + (tip.1 - foot.1) * share)
    };
    let (low, high) = (0.1, 0.9);
    let turns = (0..TURNS).flat_map(|k| {
        let step = (high - low) / TURNS as f64;
        let from = low + k as f64 * step;
        [at(from + 0.25 * step, COIL), at(from + 0.75 * step, -COIL)]
    });
    let start = [at(0.0, 0.0), at(low, 0.0)].into_iter();
    start.chain(turns).chain([at(high, 0.0), at(1.0, 0.0)]).collect()
}
