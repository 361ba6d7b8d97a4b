//! Speculative parallel search.
//!
//! A sequential search evaluates one point after another; each point depends on the earlier results. To use several cores, unknown results
//! are replaced by guesses, and all points that the search then requests are computed in parallel. After this computation the search starts
//! again with the new results.
//!
//! Known results are never replaced by guesses, so the search evaluates the same points for any number of cores. Wrong guesses only waste
//! the time of idle cores.

use crate::each::each;

/// Evaluation function of a search, called with a point and the progress of the search, 0 to 1. `Err(None)` suspends the search.
pub(super) type Ask<'a, A, E> = dyn FnMut(f64, f64) -> Result<A, Option<E>> + 'a;

/// Result of a search.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Found<T, A, E> {
    /// Result of the search, or its first error.
    pub(super) outcome: Result<T, E>,
    /// Points that the search evaluated, with the results at these points.
    pub(super) asked: Vec<(f64, Result<A, E>)>,
}

/// Runs a search on `cores` threads.
///
/// `guess` predicts the result at a point from the known results, `of` computes the result, and `told` receives the progress of the search.
pub(super) fn search<T, A: Clone + Send, E: Clone + Send>(
    cores: usize,
    mut search: impl FnMut(&mut Ask<'_, A, E>) -> Result<T, Option<E>>,
    guess: impl Fn(&[(f64, A)], f64) -> A,
    of: impl Fn(f64) -> Result<A, E> + Sync,
    told: impl Fn(f64),
) -> Found<T, A, E> {
    let mut known: Vec<(f64, Result<A, E>)> = Vec::new();
    loop {
        let (mut asked, mut wanted) = (Vec::new(), Vec::new());
        let answers: Vec<(f64, A)> =
            known.iter().filter_map(|(at, answer)| Some((*at, answer.clone().ok()?))).collect();
        let outcome = search(&mut |at, behind| {
            if let Some((_, answer)) = known.iter().find(|(place, _)| *place == at) {
                // The search with computed results may never request points that depend on a guess.
                if wanted.is_empty() {
                    asked.push((at, answer.clone()));
                    return answer.clone().map_err(Some);
                }
                return answer.clone().map_err(|_| None);
            }
            if wanted.is_empty() {
                told(behind);
            } else if wanted.len() >= cores {
                return Err(None);
            }
            if !wanted.contains(&at) {
                wanted.push(at);
            }
            Ok(guess(&answers, at))
        });
        match outcome {
            Ok(found) if wanted.is_empty() => return Found { outcome: Ok(found), asked },
            Err(Some(fault)) if wanted.is_empty() => return Found { outcome: Err(fault), asked },
            _ => {}
        }
        let computed = each(wanted.len(), cores, |place| of(wanted[place]));
        known.extend(wanted.into_iter().zip(computed));
    }
}

/// Returns linear interpolation at a point by its two nearest neighbours. Returns `None` for fewer than two points.
pub(super) fn line(points: impl Iterator<Item = (f64, f64)>, at: f64) -> Option<f64> {
    let [(x, y), (other, higher)] = nearest(points, at).get(..2)?.try_into().ok()?;
    Some(y + (higher - y) * (at - x) / (other - x))
}

/// Returns quadratic interpolation at a point by its three nearest neighbours. Returns NaN for fewer than three points.
pub(super) fn parabola(points: impl Iterator<Item = (f64, f64)>, at: f64) -> f64 {
    let near = nearest(points, at);
    let Some([a, b, c]) = near.get(..3).and_then(|near| <[(f64, f64); 3]>::try_from(near).ok()) else {
        return f64::NAN;
    };
    let share = |of: (f64, f64), one: (f64, f64), two: (f64, f64)| {
        of.1 * (at - one.0) * (at - two.0) / ((of.0 - one.0) * (of.0 - two.0))
    };
    share(a, b, c) + share(b, c, a) + share(c, a, b)
}

/// Sorts points by their distance from `at` and removes duplicates.
fn nearest(points: impl Iterator<Item = (f64, f64)>, at: f64) -> Vec<(f64, f64)> {
    let mut near: Vec<(f64, f64)> = points.collect();
    near.sort_by(|a, b| (a.0 - at).abs().total_cmp(&(b.0 - at).abs()).then(a.0.total_cmp(&b.0)));
    near.dedup_by(|a, b| a.0 == b.0);
    near
}

#[cfg(test)]
mod tests {
    use super::super::{Bracket, Peak, Seen};
    use super::*;
    use std::cell::Cell;
    use std::sync::atomic::{AtomicUsize, Ordering};

    /// Result of a search, number of parallel rounds and number of computed points.
    type Cost<T, A> = (Found<T, A, ()>, u32, usize);

    /// Searches for the maximum of `of` between 0.5 and 1, with guesses from `guess`.
    fn peak(cores: usize, of: fn(f64) -> f64, guess: fn(f64) -> f64) -> Cost<Peak, Seen> {
        let (rounds, computed) = (Cell::new(0), AtomicUsize::new(0));
        let seen = |at, value| Seen { at, value, error: 0.0 };
        let found = search(
            cores,
            |ask| Peak::narrow(seen(0.75, of(0.75)), [0.5, 1.0], 1e-4, ask),
            |_, at| seen(at, guess(at)),
            |at| {
                computed.fetch_add(1, Ordering::Relaxed);
                Ok(seen(at, of(at)))
            },
            |_| rounds.set(rounds.get() + 1),
        );
        (found, rounds.get(), computed.into_inner())
    }

    fn bent(at: f64) -> f64 {
        2.0 - (at - 0.7).powi(2) - 0.5 * (at - 0.7).powi(3)
    }

    fn parabola(at: f64) -> f64 {
        2.0 - (at - 0.7).powi(2)
    }

    /// With nearly correct guesses, golden section search computes as many points at a time as there are cores. Only
    /// near the maximum are points wasted.
    #[test]
    fn good_guesses_divide_the_rounds_by_the_cores_and_change_nothing() {
        let (alone, rounds, computed) = peak(1, bent, parabola);
        assert_eq!((rounds as usize, alone.asked.len()), (computed, computed));
        for cores in [2, 3, 4] {
            let (found, fewer, computed) = peak(cores, bent, parabola);
            assert_eq!(found, alone);
            assert!(fewer as usize * cores <= rounds as usize + 3 * cores, "{cores}: {fewer} of {rounds}");
            assert!(computed <= alone.asked.len() + 3 * cores, "{cores}: {computed}");
        }
    }

    /// Wrong guesses need no additional rounds and do not change the result.
    #[test]
    fn bad_guesses_change_nothing() {
        let (alone, rounds, _) = peak(1, bent, bent);
        for cores in [2, 4] {
            let (found, as_many, _) = peak(cores, bent, |at| -bent(at));
            assert!(found == alone && as_many <= rounds, "{cores}: {as_many} of {rounds}");
        }
    }

    #[test]
    fn an_edge_is_the_same_for_any_number_of_cores() {
        let step = |at: f64| (at > 0.74).then(|| (at - 0.74).powi(3));
        let found = [1, 2, 3, 4].map(|cores| {
            search(
                cores,
                |ask| Bracket::narrow(vec![(1.0, 0.26_f64.powi(3))], 0.5, 1e-6, ask),
                |_, _| None,
                |at| Ok::<_, ()>(step(at)),
                |behind| assert!((0.0..=1.0).contains(&behind), "{behind}"),
            )
        });
        assert!(found.iter().all(|other| *other == found[0]), "{found:?}");
        let bracket = found[0].outcome.unwrap().unwrap();
        assert!(bracket.still <= 0.74 && bracket.steps > 0.74 && bracket.half_width() <= 0.4e-6);
    }

    /// An error ends the search if the search requested its point, but not if only guesses led to the point.
    #[test]
    fn a_fault_ends_it_only_where_it_is_asked_for() {
        let of = |at: f64| if at > 0.8 { Err(()) } else { Ok(Seen { at, value: bent(at), error: 0.0 }) };
        let known = Seen { at: 0.75, value: bent(0.75), error: 0.0 };
        let found = [1, 3].map(|cores| {
            search(
                cores,
                |ask| Peak::narrow(known, [0.5, 1.0], 1e-3, ask),
                |_, at| Seen { at, value: at, error: 0.0 },
                of,
                |_| (),
            )
        });
        assert!(found[0] == found[1] && found[0].outcome.is_err() && found[0].asked.len() == 2, "{found:?}");
    }
}
