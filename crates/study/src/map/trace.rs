//! Tracing of borders between regimes. Border points are located on the edges of a coarse grid, then further points are added between them.

use super::regime::{Looks, Regime, Seen, Unseen};
use super::squares::{self, Edge};
use super::{Border, Field, Map, MapError, count};
use crate::each::each;
use stickslip_stepper::{Bracket, Point, narrow};

/// Minimum number of points of a border: for prescribed motions and for runs.
const POINTS: [usize; 2] = [40, 12];
/// Accuracy of a border point, as a fraction of the axes: for prescribed motions and for runs.
const NEAR: [f64; 2] = [1e-13, 8e-5];
/// Distances from a chord within which a border is searched for, as fractions of the chord, from the smallest to the largest.
const ASIDE: [f64; 3] = [0.05, 0.25, 1.0];
/// Shortest step beyond the end of a border, as a fraction of the axes, and maximum number of steps.
const SHORTEST: f64 = 5e-4;
const MOST_STEPS: usize = 40;
/// Maximum number of refinements of a line.
const ROUNDS: usize = 8;

/// Point of a border, as fractions of the axes, with the regimes on both sides of the border.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Crossing {
    place: [f64; 2],
    between: [Regime; 2],
}

/// Two points of the map, as fractions of the axes, with the regimes at these points.
type Ends = [([f64; 2], Seen); 2];

/// Computes the regimes of a grid and the borders between them.
pub(super) fn trace(map: &Map, looks: &Looks<'_>, threads: usize) -> Result<Field, MapError> {
    let [columns, rows] = map.points;
    let share = |k: usize, count: usize| k as f64 / (count - 1) as f64;
    let node = |i: usize, j: usize| [share(i, columns), share(j, rows)];
    let sights = each(columns * rows, threads, |k| looks.look(node(k / rows, k % rows)));
    let mut faults = Vec::new();
    for sight in &sights {
        match sight {
            Err(Unseen::Interrupted) => return Err(MapError::Interrupted),
            Err(Unseen::Failed(why)) => count(&mut faults, why.clone()),
            Ok(_) => {}
        }
    }
    let exact = usize::from(looks.runs() > 0);
    let seen = |i: usize, j: usize| sights.get(i * rows + j).and_then(|sight| sight.as_ref().ok()).copied();
    let mut borders = Vec::new();
    for least in [Regime::Stick, Regime::Partial, Regime::Gross] {
        let inside = |i: usize, j: usize| seen(i, j).map(|seen| seen.regime >= least);
        for line in squares::lines(map.points, &inside) {
            let ends = |&(i, j, way): &Edge| {
                let (k, l) = if way == 0 { (i + 1, j) } else { (i, j + 1) };
                Some([(node(i, j), seen(i, j)?), (node(k, l), seen(k, l)?)])
            };
            let line: Vec<Ends> = line.iter().filter_map(ends).collect();
            for piece in crossings(looks, &line, (least, exact, threads))? {
                let between = piece[0].between;
                let piece = if exact == 0 { extended(looks, piece, least)? } else { piece };
                let points = dense(looks, piece, (least, exact, threads))?;
                borders.push(border(map, (between, &points)));
            }
        }
    }
    let values =
        sights.iter().map(|sight| sight.as_ref().map_or(f64::NAN, |seen| f64::from(seen.regime as u8)));
    let [xs, ys] = [0, 1].map(|axis| map.axes[axis].values(map.points[axis]));
    let words = Regime::ALL.map(|regime| regime.word().to_owned()).to_vec();
    faults.sort_by_key(|(_, count)| std::cmp::Reverse(*count));
    Ok(Field {
        xs,
        ys,
        values: values.collect(),
        words: Some(words),
        borders,
        contours: Vec::new(),
        runs: looks.runs(),
        faults,
    })
}

/// Locates the border of a regime on the edges crossed by a line. Returns pieces of the border, each with the same regimes on both sides.
///
/// If the regime on the upper side exceeds `least`, the border belongs to the higher regime and is skipped here. Borders that coincide with
/// the rim of the map are skipped, too.
fn crossings(
    looks: &Looks<'_>,
    line: &[Ends],
    (least, exact, threads): (Regime, usize, usize),
) -> Result<Vec<Vec<Crossing>>, MapError> {
    let found = each(line.len(), threads, |k| match is_at_rim(looks, line[k], (least, NEAR[exact])) {
        true => Ok(None),
        false => cross(looks, line[k], least, NEAR[exact]).map(Some),
    });
    let found = found.into_iter().collect::<Result<Vec<_>, Unseen>>().map_err(|_| MapError::Interrupted)?;
    let found: Vec<_> = found.into_iter().map(|one| one.filter(|one| one.between[1] == least)).collect();
    let pieces = found.chunk_by(|a, b| a.map(|a| a.between) == b.map(|b| b.between));
    Ok(pieces
        .map(|piece| piece.iter().copied().flatten().collect::<Vec<_>>())
        .filter(|piece| piece.len() > 1)
        .collect())
}

/// Locates a border between two points, exactly one of which has at least the regime `least`.
fn cross(looks: &Looks<'_>, [from, to]: Ends, least: Regime, near: f64) -> Result<Crossing, Unseen> {
    let margin = |seen: &Seen| seen.margins[least as usize - 1];
    let at = |part: f64| [0, 1].map(|axis| from.0[axis] + part * (to.0[axis] - from.0[axis]));
    let length = distance(from.0, to.0);
    // Regimes at the last evaluated points on both sides of the border.
    let mut between = [from.1, to.1].map(|seen| seen.regime);
    between.sort_unstable();
    let mut fault = None;
    let value = |part: f64| match looks.look(at(part)) {
        Ok(seen) => {
            between[usize::from(seen.regime >= least)] = seen.regime;
            margin(&seen)
        }
        Err(why) => {
            fault = Some(why);
            f64::NAN
        }
    };
    let [start, end] = [(0.0, &from.1), (1.0, &to.1)].map(|(x, seen)| Point { x, y: margin(seen) });
    let (left, right) = narrow(value, Bracket { from: start, to: end }, near / length.max(near));
    match fault {
        Some(Unseen::Interrupted) => Err(Unseen::Interrupted),
        // If a case fails, the border of the computable region is returned.
        _ => Ok(Crossing { place: at(0.5 * (left + right)), between }),
    }
}

/// Returns the distance of two points whose coordinates are fractions of the axes.
fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    ((a[0] - b[0]).powi(2) + (a[1] - b[1]).powi(2)).sqrt()
}

/// Extends a line at both ends to the rim of the map or to another border.
///
/// Each new point is searched for near the extrapolated last chord. The step is halved if the search finds no point.
fn extended(looks: &Looks<'_>, mut line: Vec<Crossing>, least: Regime) -> Result<Vec<Crossing>, MapError> {
    if line[0].place == line[line.len() - 1].place {
        return Ok(line);
    }
    for _ in 0..2 {
        line.reverse();
        let mut part = 1.0;
        for _ in 0..MOST_STEPS {
            let [before, last] = [line[line.len() - 2], line[line.len() - 1]];
            let step = [0, 1].map(|axis| part * (last.place[axis] - before.place[axis]));
            let reach = distance(step, [0.0; 2]);
            let room = |axis: usize| match step[axis] {
                step if step > 0.0 => (1.0 - last.place[axis]) / step,
                step if step < 0.0 => -last.place[axis] / step,
                _ => 1.0,
            };
            let within = room(0).min(room(1)).clamp(0.0, 1.0);
            if reach * within < SHORTEST {
                break;
            }
            let beyond = [0, 1].map(|axis| last.place[axis] + 2.0 * within * step[axis]);
            let found =
                beside(looks, [last.place, beyond], least, NEAR[0]).map_err(|_| MapError::Interrupted)?;
            match found
                .filter(|one| one.between == last.between && distance(one.place, last.place) < 2.0 * reach)
            {
                Some(next) => line.push(next),
                _ => part *= 0.5,
            }
        }
    }
    Ok(line)
}

/// Adds points in the middle of the longest chords until a border has enough points.
fn dense(
    looks: &Looks<'_>,
    mut line: Vec<Crossing>,
    (least, exact, threads): (Regime, usize, usize),
) -> Result<Vec<Crossing>, MapError> {
    for _ in 0..ROUNDS {
        let missing = POINTS[exact].saturating_sub(line.len());
        let mut chords: Vec<usize> = (0..line.len() - 1).collect();
        let length = |k: &usize| distance(line[*k].place, line[k + 1].place);
        chords.sort_by(|a, b| length(b).total_cmp(&length(a)).then(a.cmp(b)));
        chords.truncate(missing);
        if chords.is_empty() {
            break;
        }
        let found = each(chords.len(), threads, |k| {
            let chord = chords[k];
            let ends = [line[chord].place, line[chord + 1].place];
            Ok((chord, beside(looks, ends, least, NEAR[exact])?))
        });
        let mut found =
            found.into_iter().collect::<Result<Vec<_>, Unseen>>().map_err(|_| MapError::Interrupted)?;
        found.sort_by_key(|(chord, _)| std::cmp::Reverse(*chord));
        for (chord, crossing) in found {
            line.splice(chord + 1..chord + 1, crossing);
        }
    }
    Ok(line)
}

/// Returns the point of a border on the perpendicular bisector of a chord, if the border is close to the chord.
fn beside(
    looks: &Looks<'_>,
    [a, b]: [[f64; 2]; 2],
    least: Regime,
    near: f64,
) -> Result<Option<Crossing>, Unseen> {
    let across = [a[1] - b[1], b[0] - a[0]];
    let at = |part: f64| [0, 1].map(|axis| (0.5 * (a[axis] + b[axis]) + part * across[axis]).clamp(0.0, 1.0));
    for aside in ASIDE {
        let [from, to] = [at(-aside), at(aside)];
        let (Ok(low), Ok(high)) = (looks.look(from), looks.look(to)) else { return Ok(None) };
        if (low.regime >= least) != (high.regime >= least) {
            let crossing = cross(looks, [(from, low), (to, high)], least, near)?;
            return Ok(Some(crossing).filter(|crossing| crossing.between[1] == least));
        }
    }
    Ok(None)
}

/// Returns whether a regime begins at the rim of the map itself, such as slip at an amplitude of 0.
fn is_at_rim(looks: &Looks<'_>, [a, b]: Ends, (least, near): (Regime, f64)) -> bool {
    let axis = usize::from(a.0[0] == b.0[0]);
    let Some((outer, inner)) =
        [(a, b), (b, a)].into_iter().find(|(outer, _)| [0.0, 1.0].contains(&outer.0[axis]))
    else {
        return false;
    };
    let mut place = outer.0;
    place[axis] = (place[axis] - 10.0 * near).abs();
    looks.look(place).is_ok_and(|seen| (seen.regime >= least) == (inner.1.regime >= least))
}

/// Converts a line to SI values.
fn border(map: &Map, (between, line): ([Regime; 2], &[Crossing])) -> Border {
    let points = line.iter().map(|one| [0, 1].map(|axis| map.axes[axis].at(one.place[axis])));
    Border { between, points: points.collect() }
}
