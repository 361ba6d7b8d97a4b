//! Scale and frame of the drawing of a model.

use super::Scene;
use super::arrange::arrange;
use super::draw::sheet;
use super::outline::{Draft, Rect};
use super::sheet::Sheet;
use crate::figure::Figure;
use crate::panel::{Axis, Panel};
use crate::thin::Point;
use crate::{Arrangement, Label};

/// Width and minimum height of the frame, px of a figure of the default width.
const WIDTH: f64 = 1400.0;
const LEAST_HEIGHT: f64 = 360.0;
/// Maximum width and height of the drawing; the rest is for names.
const DRAWN: Point = (1100.0, 740.0);
/// Maximum extent along x and z of the drawing of an upright slide, and the margin for names.
const DRAWN_UPRIGHT: Point = (860.0, 1100.0);
const NAMES: f64 = 75.0;
/// Height of title, legend and axis outside the frame.
const AROUND: f64 = 255.0;
/// Maximum distance of a point from its body's reference point along x and z. Without such points, maximum radius of a profile.
const REACH: Point = (420.0, 230.0);
const PROFILE: f64 = 70.0;
/// Ratio of sides above which a drawing is stretched, approximate ratio after stretching, and maximum factor of stretching.
const SLIVER: f64 = 12.0;
const STOUT: f64 = 4.0;
const MOST_STRETCH: f64 = 1e3;
/// Maximum distance that is drawn, m.
const FARTHEST: f64 = 1e9;
/// Factor by which symbols shrink per step, and minimum size of symbols.
const SHRINK: f64 = 0.85;
const LEAST_UNIT: f64 = 0.01;
/// Minimum scale relative to the largest; symbols shrink before the scale becomes smaller.
const SMALLEST: f64 = 0.2;
/// Number of bisections of the scale.
const HALVINGS: usize = 16;

/// Draws a model with the largest scale that fits the frame.
pub(super) fn figure(title: &str, scene: &Scene<'_>) -> Figure<'static> {
    let reach = reach(scene);
    if reach.0.max(reach.1) > FARTHEST {
        return Figure::without_data(title, "the points are too far apart to be drawn");
    }
    let stretch = stretch(reach);
    let is_upright = scene.gravity.is_some_and(|gravity| gravity.is_upright());
    let room = if is_upright { DRAWN_UPRIGHT } else { DRAWN };
    let most = most(scene, reach, stretch);
    let scaled = |scale: f64, unit: f64| {
        let draft = Draft { scene, scale: (scale * stretch.0, scale * stretch.1), unit };
        (draft.scale, drawn(&draft))
    };
    let fits = |scale: f64, unit: f64| {
        let bounds = bounds(&scaled(scale, unit).1);
        bounds.right - bounds.left <= room.0 && bounds.top - bounds.bottom <= room.1
    };
    let largest = most.unwrap_or(1.0);
    let has_points = reach.0 > 0.0 || reach.1 > 0.0;
    let least = |unit: f64| largest * if has_points { SMALLEST } else { unit };
    let mut unit = 1.0;
    while unit > LEAST_UNIT && !fits(least(unit), unit) {
        unit *= SHRINK;
    }
    let (mut low, mut high) = (least(unit), largest);
    if fits(high, unit) {
        low = high;
    }
    // Without points only symbols have a size, and profiles keep their scale.
    for _ in 0..if has_points { HALVINGS } else { 0 } {
        let middle = f64::midpoint(low, high);
        if fits(middle, unit) { low = middle } else { high = middle }
    }
    let (scale, sheet) = scaled(low, unit);
    let names = if is_upright {
        ["z normal to the slide", "x up the slide"]
    } else {
        ["x along the slide", "height z"]
    };
    let turned = |(x, z): Point| if is_upright { (z, x) } else { (x, z) };
    let sheet = if is_upright { sheet.upright() } else { sheet };
    framed((title, names), sheet, turned(scale), (turned(stretch), most.is_some()))
}

fn drawn(draft: &Draft<'_, '_>) -> Sheet {
    sheet(draft, &arrange(draft))
}

fn bounds(sheet: &Sheet) -> Rect {
    sheet.bounds().unwrap_or(Rect::of((0.0, 0.0)))
}

/// Returns the largest distances of points from their reference points, m.
fn reach(scene: &Scene<'_>) -> Point {
    let contacts = scene.contacts.iter().flat_map(|contact| contact.between);
    let links = scene.links.iter().flat_map(|link| link.between);
    let fixtures = contacts.chain(links).filter(|fixture| fixture.body.is_some()).map(|fixture| fixture.at);
    let points = fixtures.chain(scene.loads.iter().map(|load| load.at));
    points.fold((0.0, 0.0), |(x, z): Point, at| (x.max(at.0.abs()), z.max(at.1.abs())))
}

/// Returns the factors by which x and z are stretched.
fn stretch((x, z): Point) -> Point {
    let factor =
        |ratio: f64| if ratio > SLIVER { round_down((ratio / STOUT).min(MOST_STRETCH)) } else { 1.0 };
    if x > 0.0 && z > 0.0 { (factor(z / x), factor(x / z)) } else { (1.0, 1.0) }
}

/// Returns the largest number of the series 1, 2, 5, 10, 20, … that is not above a number.
fn round_down(number: f64) -> f64 {
    let decade = math::powf(10.0, math::log10(number).floor());
    [5.0, 2.0].into_iter().map(|digit| digit * decade).find(|round| *round <= number).unwrap_or(decade)
}

/// Returns the largest scale, px per metre; `None` without lengths.
fn most(scene: &Scene<'_>, reach: Point, stretch: Point) -> Option<f64> {
    let limit = |px: f64, length: f64| (length > 0.0).then(|| px / length);
    let points = [limit(REACH.0, reach.0 * stretch.0), limit(REACH.1, reach.1 * stretch.1)];
    let ends = scene.contacts.iter().filter_map(|contact| contact.profile.last());
    let profile = limit(PROFILE, ends.map(|end| end.0).fold(0.0, f64::max));
    points.into_iter().flatten().reduce(f64::min).or(profile).filter(|scale| scale.is_finite())
}

/// Puts the drawing into a frame.
fn framed(
    (title, names): (&str, [&str; 2]),
    sheet: Sheet,
    scale: Point,
    (stretch, is_to_scale): (Point, bool),
) -> Figure<'static> {
    let bounds = bounds(&sheet);
    let (middle, centre) = bounds.centre();
    // A drawing that is still too wide determines the width.
    let width = (bounds.right - bounds.left + 2.0 * NAMES).max(WIDTH);
    let height = (bounds.top - bounds.bottom + 2.0 * NAMES).max(LEAST_HEIGHT).max(width / SLIVER);
    let axis = |name: &str, stretch: f64, (centre, length, scale): (f64, f64, f64)| {
        let label = if is_to_scale && stretch > 1.0 {
            format!("{name}, enlarged {stretch} times")
        } else if is_to_scale {
            name.to_owned()
        } else {
            format!("{name}, not to scale")
        };
        Axis {
            tight: true,
            covers: Some(((centre - length / 2.0) / scale, (centre + length / 2.0) / scale)),
            unnumbered: !is_to_scale,
            ..Axis::new(Label::plain(&label), if is_to_scale { "m" } else { "" })
        }
    };
    let (x, y) = (
        axis(names[0], stretch.0, (middle, width, scale.0)),
        axis(names[1], stretch.1, (centre, height, scale.1)),
    );
    let (shapes, series, notes) = sheet.unrolled(scale);
    let aspect = Some(width / height);
    let panel = Panel { x, y, shapes, series, notes, aspect, ..Panel::default() };
    Figure {
        title: Label::plain(title),
        panels: vec![panel],
        arrangement: Arrangement::Row,
        size: (Figure::DEFAULT_SIZE.0, (height * WIDTH / width + AROUND) as u32),
        ..Figure::default()
    }
}
