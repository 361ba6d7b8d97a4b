//! A search on several cores.
//!
//! A search asks for one place after another: where it looks next hangs on what it has heard. To have more than one place to compute,
//! it is led on by guesses of the answers that are not there yet, and all that it asks for so are computed side by side. Then it begins
//! anew with what is known by now. An answer that is known is never guessed: what a search finds, and what it has asked for on its
//! way, is the same for any number of cores. Where guesses mislead it something was computed in vain, on cores that had nothing to do.

use crate::each::each;

/// What a search asks: for a place, and how much of its way is behind it, 0 to 1. None where it is to go no further for now.
pub(super) type Ask<'a, A, E> = dyn FnMut(f64, f64) -> Result<A, Option<E>> + 'a;

/// What a search has come to.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Found<T, A, E> {
    /// What it finds, or the first answer that was none.
    pub(super) outcome: Result<T, E>,
    /// The places that it asked for, with the answers.
    pub(super) asked: Vec<(f64, Result<A, E>)>,
}

/// Leads a search to its end on so many cores. `guess` makes an answer for a place from those that are known; `of` computes it; `told`
/// hears how much of the way is behind.
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
                // What comes after a guess may never be asked for.
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

/// A guess: the line through the two points nearest to a place, there; none of fewer.
pub(super) fn line(points: impl Iterator<Item = (f64, f64)>, at: f64) -> Option<f64> {
    let [(x, y), (other, higher)] = nearest(points, at).get(..2)?.try_into().ok()?;
    Some(y + (higher - y) * (at - x) / (other - x))
}

/// A guess: the parabola through the three points nearest to a place, there; not a number where there are fewer.
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

/// Points by their distance from a place, each place once.
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

    /// What is found, how often all cores were busy with something, and what was computed.
    type Cost<T, A> = (Found<T, A, ()>, u32, usize);

    /// The peak of a curve between 0.5 and 1, the answers guessed by another.
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

    /// Golden section asks for one place after another: guesses that are nearly right have as many as there are cores computed at a
    /// time, and nothing in vain but near the top, where they take the wrong side.
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

    /// Guesses that are always wrong cost no round and change nothing.
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

    /// The first answer that is none ends the search; one that only guesses led to does not.
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
