//! Drawing of bodies, contacts and ground.

use super::arrange::Arrangement;
use super::attach::Attacher;
use super::outline::{Draft, Rect};
use super::sheet::{FINE, OUTLINE, Sheet, around, line};
use super::symbols::{arrow, ellipse, hatched, turn};
use super::{Amount, Mobility, Press, SceneBody, SceneContact};
use crate::scale::quantity;
use crate::theme::Ink;
use crate::thin::Point;

/// Half length of the arrows of free translations, and radius of the arrow of free rotation.
const MOVES: f64 = 46.0;
const TURNS: f64 = 42.0;
/// Radius of the mark of a reference point.
const REFERENCE: f64 = 7.0;
/// Length of the gravity arrow, and its distance from the drawing.
const GRAVITY: f64 = 100.0;
const ASIDE: f64 = 70.0;
/// Length by which the ground extends beyond the bodies on it.
const GROUND: f64 = 30.0;
/// Significant digits of quantities.
pub(super) const DIGITS: usize = 4;

/// Draws a model in its arrangement.
pub(super) fn sheet(draft: &Draft<'_, '_>, plan: &Arrangement) -> Sheet {
    let mut sheet = Sheet::default();
    ground(draft, plan, &mut sheet);
    for (place, body) in draft.scene.bodies.iter().enumerate() {
        let on = outline(draft, plan, place, &mut sheet);
        motion(body, plan.references[place], draft.unit, &mut sheet);
        sheet.note(&words(body), plan.outlines[place], Some(on));
    }
    for (place, contact) in draft.scene.contacts.iter().enumerate() {
        let dot = sheet_dot(&mut sheet, plan.contacts[place]);
        sheet.note(&contact_words(contact), dot, None);
    }
    let mut attacher = Attacher::new(draft, plan, &mut sheet);
    draft.scene.links.iter().for_each(|link| attacher.link(link));
    draft.scene.contacts.iter().zip(&plan.contacts).for_each(|(contact, at)| attacher.press(contact, *at));
    draft.scene.loads.iter().for_each(|load| attacher.load(load));
    gravity(draft, &mut sheet);
    sheet
}

/// Returns the line colour, area colour and legend entry for a mobility; `None` if fixed.
fn inks(mobility: Mobility<'_>) -> Option<(Ink, Ink, &'static str)> {
    match mobility {
        Mobility::Fixed => None,
        Mobility::Free => Some((Ink::Palette(0), Ink::Pale(0), "free along ↔")),
        Mobility::Balanced => Some((Ink::Palette(0), Ink::Pale(0), "balanced along ↔")),
        Mobility::Follows(_) => Some((Ink::Palette(1), Ink::Pale(1), "follows a waveform along ↔")),
    }
}

/// Draws the area of a body with its feet. Returns the index of the shape.
fn outline(draft: &Draft<'_, '_>, plan: &Arrangement, body: usize, sheet: &mut Sheet) -> usize {
    let SceneBody { x, z, pitch, .. } = draft.scene.bodies[body];
    let free = [x, z, pitch].into_iter().find(|it| matches!(it, Mobility::Free | Mobility::Balanced));
    let moving = free.or([x, z, pitch].into_iter().find(|mobility| *mobility != Mobility::Fixed));
    let (ink, label) = moving.and_then(inks).map_or((Ink::Shade(1), "fixed"), |(_, ink, label)| (ink, label));
    let rect = plan.outlines[body];
    let is_ball = draft.ball(body).is_some();
    if !is_ball {
        for (place, side) in draft.contacts_of(body) {
            foot(draft, plan.contacts[place], (place, side), rect, ink, sheet);
        }
    }
    let corners = if is_ball {
        ellipse(rect.centre(), ((rect.right - rect.left) / 2.0, (rect.top - rect.bottom) / 2.0))
    } else {
        rect.corners().to_vec()
    };
    let mut rim = corners.clone();
    rim.extend(corners.first());
    let on = sheet.fill(label, corners, ink);
    sheet.draw(vec![rim], OUTLINE);
    on
}

/// Draws the profile of a contact on the body it belongs to, up to the face of the body.
fn foot(
    draft: &Draft<'_, '_>,
    at: Point,
    (place, side): (usize, usize),
    rect: Rect,
    ink: Ink,
    sheet: &mut Sheet,
) {
    let tip = draft.tip(place);
    if tip.side != side {
        return;
    }
    let (up, face) = if side == 1 { (1.0, rect.bottom) } else { (-1.0, rect.top) };
    let stands = up * (face - at.1);
    if stands <= 0.0 {
        return;
    }
    let mut right = tip.below(stands);
    right.extend(right.last().map(|end| (end.0, stands)));
    let point = |sign: f64| move |&(r, height): &Point| (at.0 + sign * r, at.1 + up * height);
    let left = right.iter().rev().map(point(-1.0));
    let half: Vec<Point> = left.chain(right.iter().skip(1).map(point(1.0))).collect();
    sheet.fill("", half.clone(), ink);
    sheet.draw(vec![half], OUTLINE);
}

/// Draws the reference point, and arrows of the coordinates that are not fixed.
fn motion(body: &SceneBody<'_>, at: Point, unit: f64, sheet: &mut Sheet) {
    let way = MOVES * unit;
    let (left, right) = ((at.0 - way, at.1), (at.0 + way, at.1));
    let (low, high) = ((at.0, at.1 - way), (at.0, at.1 + way));
    for (mobility, lines) in [
        (body.x, arrow(left, right, true, unit)),
        (body.z, arrow(low, high, true, unit)),
        (body.pitch, turn(at, TURNS * unit, (0.3, 1.27), true, unit)),
    ] {
        if let Some((ink, ..)) = inks(mobility) {
            sheet.draw(lines, line(ink, 0.8));
        }
    }
    let radius = REFERENCE * unit;
    sheet.draw(vec![ellipse(at, (radius, radius)), vec![at]], line(Ink::Foreground, 0.5));
}

fn sheet_dot(sheet: &mut Sheet, at: Point) -> Rect {
    sheet.draw(vec![vec![at]], line(Ink::Foreground, 1.1));
    Rect::of(at)
}

/// Returns the name and mass of a body, and the waveforms it follows.
fn words(body: &SceneBody<'_>) -> Vec<String> {
    let mass = body.mass.map(|mass| quantity(1e3 * mass, "g", DIGITS));
    let follows = [("x", body.x), ("z", body.z), ("θ", body.pitch)].into_iter();
    let follows = follows.filter_map(|(axis, mobility)| match mobility {
        Mobility::Follows(waveform) => Some(format!("{axis}: {waveform}")),
        _ => None,
    });
    std::iter::once(body.name.to_owned()).chain(mass).chain(follows).collect()
}

/// Returns the name and number of a contact, and its indentation or radius if constant.
fn contact_words(contact: &SceneContact<'_>) -> Vec<String> {
    let name = match contact.count {
        1 => contact.name.to_owned(),
        count => format!("{} × {count}", contact.name),
    };
    let fixed = match contact.press {
        Press::Indentation(Amount::Constant(depth)) => format!("d = {}", quantity(depth, "m", DIGITS)),
        Press::Radius(Amount::Constant(radius)) => format!("a = {}", quantity(radius, "m", DIGITS)),
        _ => String::new(),
    };
    vec![name, fixed]
}

/// Draws the ground below or above its contacts.
fn ground(draft: &Draft<'_, '_>, plan: &Arrangement, sheet: &mut Sheet) {
    let mut strips: Vec<(usize, usize, f64, Rect)> = Vec::new();
    for (contact, at) in draft.scene.contacts.iter().zip(&plan.contacts) {
        for side in [0, 1] {
            let [own, other] = [contact.between[side], contact.between[1 - side]];
            let (None, Some(body)) = (own.body, other.body) else { continue };
            let (group, rect) = (plan.groups[body], plan.outlines[body]);
            let same = strips
                .iter_mut()
                .find(|(of, lies, level, _)| (*of, *lies) == (group, side) && (level - at.1).abs() < 1.0);
            match same {
                Some((.., whole)) => *whole = whole.union(rect),
                None => strips.push((group, side, at.1, rect)),
            }
        }
    }
    for (_, side, level, rect) in strips {
        let beyond = GROUND * draft.unit;
        let (left, right) = ((rect.left - beyond, level), (rect.right + beyond, level));
        // Hatches are left of the direction of the line.
        let (from, to) = if side == 0 { (right, left) } else { (left, right) };
        let mut lines = hatched(from, to, draft.unit);
        let surface = vec![lines.remove(0)];
        sheet.draw(lines, FINE);
        sheet.draw(surface, OUTLINE);
    }
}

/// Draws gravity, left of the drawing.
fn gravity(draft: &Draft<'_, '_>, sheet: &mut Sheet) {
    let (Some(gravity), Some(bounds)) = (draft.scene.gravity, sheet.bounds()) else { return };
    let (half, aside) = (GRAVITY * draft.unit / 2.0, ASIDE * draft.unit);
    let (sin, cos) = math::sin_cos(gravity.incline);
    // Above the drawing if it is turned upright.
    let middle = if gravity.is_upright() {
        (bounds.right - half, bounds.top + aside + half)
    } else {
        (bounds.left - aside - half, bounds.top - half)
    };
    let from = (middle.0 + half * sin, middle.1 + half * cos);
    let to = (middle.0 - half * sin, middle.1 - half * cos);
    let lines = arrow(from, to, false, draft.unit);
    let about = around(&lines);
    sheet.draw(lines, line(Ink::Foreground, 1.1));
    let incline = gravity.incline.to_degrees();
    let slope =
        if incline == 0.0 { String::new() } else { format!("incline {}°", quantity(incline, "", DIGITS)) };
    let strength = format!("g = {}", quantity(gravity.acceleration, "m/s²", DIGITS));
    sheet.note(&[strength, slope], about, None);
}
