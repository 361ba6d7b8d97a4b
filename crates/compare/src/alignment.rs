//! Alignment of two sequences of event times. A missing event counts as one difference and does not shift the later events.

/// Maximum number of cells of the alignment table.
const MOST_CELLS: usize = 20_000_000;

/// Alignment of two sequences of times, as indices into both sequences.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub(super) struct Alignment {
    /// Matched times in ascending order. The two times of a pair may differ by more than the tolerance.
    pub pairs: Vec<(usize, usize)>,
    /// Indices of unmatched times of the first sequence.
    pub missing: Vec<usize>,
    /// Indices of unmatched times of the second sequence.
    pub extra: Vec<usize>,
}

/// Cost of an alignment: number of differences, then sum of the distances of all pairs, s, for alignments with equal numbers.
type Cost = (u32, f64);

/// Last step of the alignment of the beginnings of two sequences.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Last {
    Pair,
    Missing,
    Extra,
}

impl Alignment {
    /// Aligns two ascending sequences of times with the minimum number of differences.
    ///
    /// A pair of times farther apart than `tolerance`, a missing time and an extra time count as one difference each. Among alignments with
    /// the same number of differences, the minimum sum of distances decides. The cost, Levenshtein's edit distance, is computed in a band
    /// around the diagonal of the table (Ukkonen 1985). The band is doubled until the minimum is certain or the table is too large.
    pub(super) fn new(a: &[f64], b: &[f64], tolerance: f64) -> Self {
        let is_near = |(s, t): &(&f64, &f64)| (*s - *t).abs() <= tolerance;
        let start = a.iter().zip(b).take_while(is_near).count();
        let (rest_a, rest_b) = (&a[start..], &b[start..]);
        let end = rest_a.iter().rev().zip(rest_b.iter().rev()).take_while(is_near).count();
        let (middle_a, middle_b) = (&rest_a[..rest_a.len() - end], &rest_b[..rest_b.len() - end]);
        let mut alignment = Self { pairs: (0..start).map(|i| (i, i)).collect(), ..Self::default() };
        alignment.fill(start, &path(middle_a, middle_b, tolerance));
        let (i, j) = (a.len() - end, b.len() - end);
        alignment.pairs.extend((0..end).map(|k| (i + k, j + k)));
        alignment
    }

    fn fill(&mut self, start: usize, path: &[Last]) {
        let (mut i, mut j) = (start, start);
        for last in path {
            match last {
                Last::Pair => self.pairs.push((i, j)),
                Last::Missing => self.missing.push(i),
                Last::Extra => self.extra.push(j),
            }
            i += usize::from(*last != Last::Extra);
            j += usize::from(*last != Last::Missing);
        }
    }
}

/// Returns the optimal sequence of alignment steps for both sequences.
///
/// If even the narrowest band exceeds [`MOST_CELLS`], times with equal indices are paired; the rest of the longer sequence is unmatched.
fn path(a: &[f64], b: &[f64], tolerance: f64) -> Vec<Last> {
    let (shorter, longer) = (a.len().min(b.len()), a.len().max(b.len()));
    let cells = |half: usize| (2 * half + 1).saturating_mul(a.len() + 1);
    let mut half = longer - shorter + 4;
    if shorter == 0 || cells(half) > MOST_CELLS {
        let surplus = if a.len() > b.len() { Last::Missing } else { Last::Extra };
        return (0..longer).map(|k| if k < shorter { Last::Pair } else { surplus }).collect();
    }
    loop {
        let table = Table::new(a, b, half, tolerance);
        if table.cost.0 as usize <= half || half >= longer || cells(2 * half) > MOST_CELLS {
            return table.path(a.len(), b.len());
        }
        half *= 2;
    }
}

/// Table of the last alignment steps for all pairs of prefix lengths (i, j) with |i - j| ≤ half.
struct Table {
    last: Vec<Last>,
    half: usize,
    /// Cost of the complete alignment.
    cost: Cost,
}

impl Table {
    fn new(a: &[f64], b: &[f64], half: usize, tolerance: f64) -> Self {
        let width = 2 * half + 1;
        let mut last = Vec::with_capacity((a.len() + 1) * width);
        let (mut before, mut row) = (vec![(u32::MAX, 0.0); width], vec![(u32::MAX, 0.0); width]);
        for i in 0..=a.len() {
            for place in 0..width {
                let j = (i + place).checked_sub(half).filter(|j| *j <= b.len());
                let (cost, step) = match j {
                    None => ((u32::MAX, 0.0), Last::Pair),
                    Some(0) if i == 0 => ((0, 0.0), Last::Pair),
                    Some(j) => {
                        let pair =
                            (i > 0 && j > 0).then(|| pair(before[place], a[i - 1], b[j - 1], tolerance));
                        let missing =
                            before.get(place + 1).filter(|_| i > 0).map(|cost| (lone(*cost), Last::Missing));
                        let extra = (j > 0 && place > 0).then(|| (lone(row[place - 1]), Last::Extra));
                        best([pair, missing, extra])
                    }
                };
                row[place] = cost;
                last.push(step);
            }
            std::mem::swap(&mut before, &mut row);
        }
        let cost = before.get(b.len() + half - a.len()).copied().unwrap_or((u32::MAX, 0.0));
        Self { last, half, cost }
    }

    fn path(&self, mut i: usize, mut j: usize) -> Vec<Last> {
        let mut path = Vec::new();
        while i > 0 || j > 0 {
            let step = self.last[i * (2 * self.half + 1) + (j + self.half - i)];
            i -= usize::from(step != Last::Extra);
            j -= usize::from(step != Last::Missing);
            path.push(step);
        }
        path.reverse();
        path
    }
}

fn pair((count, sum): Cost, s: f64, t: f64, tolerance: f64) -> (Cost, Last) {
    let distance = (s - t).abs();
    ((count.saturating_add(u32::from(distance > tolerance)), sum + distance), Last::Pair)
}

fn lone((count, sum): Cost) -> Cost {
    (count.saturating_add(1), sum)
}

fn best(steps: [Option<(Cost, Last)>; 3]) -> (Cost, Last) {
    let by_cost = |(p, _): &(Cost, Last), (q, _): &(Cost, Last)| p.0.cmp(&q.0).then(p.1.total_cmp(&q.1));
    steps.into_iter().flatten().min_by(by_cost).unwrap_or(((u32::MAX, 0.0), Last::Pair))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn one_event_too_few_is_one_and_shifts_no_other() {
        let a = [1.0, 2.0, 3.0, 4.0];
        let exact = Alignment::new(&a, &[1.0, 3.0, 4.0], 1e-9);
        assert_eq!((exact.missing, exact.extra.len(), exact.pairs.len()), (vec![1], 0, 3));
        // All times differ slightly, and one is missing.
        let moved = Alignment::new(&a, &[1.01, 3.01, 4.01], 1e-9);
        assert_eq!((moved.pairs, moved.missing), (vec![(0, 0), (2, 1), (3, 2)], vec![1]));
        let back = Alignment::new(&[1.01, 3.01, 4.01], &a, 1e-9);
        assert_eq!((back.pairs, back.extra), (vec![(0, 0), (1, 2), (2, 3)], vec![1]));
    }

    #[test]
    fn one_moved_event_is_one_pair() {
        let alignment = Alignment::new(&[1.0, 2.0, 3.0], &[1.0, 2.1, 3.0], 1e-9);
        assert_eq!(alignment.pairs, [(0, 0), (1, 1), (2, 2)]);
        assert!(alignment.missing.is_empty() && alignment.extra.is_empty());
    }

    /// A shift by the distance of two times must not split the list.
    #[test]
    fn a_chance_meeting_is_no_match() {
        let a: Vec<f64> = (0..40).map(f64::from).map(|k| k + 0.01 * k * k).collect();
        let b: Vec<f64> = a.iter().map(|t| t + a[20] - a[19]).collect();
        let alignment = Alignment::new(&a, &b[..39], 1e-9);
        assert_eq!((alignment.missing.len(), alignment.extra.len()), (1, 0));
    }

    #[test]
    fn long_lists_are_told_apart_in_time() {
        let a: Vec<f64> = (0..200_000).map(f64::from).collect();
        let mut b: Vec<f64> = a.iter().map(|t| t + 0.1).collect();
        b.remove(77_777);
        let alignment = Alignment::new(&a, &b, 1e-9);
        assert_eq!((alignment.missing, alignment.extra), (vec![77_777], vec![]));
        let none = Alignment::new(&a, &[], 1e-9);
        assert_eq!((none.missing.len(), none.pairs.len()), (200_000, 0));
    }

    /// Returns the minimum cost of all alignments, by exhaustive search.
    fn least(a: &[f64], b: &[f64], tolerance: f64) -> Cost {
        let ([s, rest_a @ ..], [t, rest_b @ ..]) = (a, b) else { return (a.len().max(b.len()) as u32, 0.0) };
        let (pair, _) = pair(least(rest_a, rest_b, tolerance), *s, *t, tolerance);
        let ways = [pair, lone(least(rest_a, b, tolerance)), lone(least(a, rest_b, tolerance))];
        ways.into_iter().min_by(|p, q| p.partial_cmp(q).unwrap()).unwrap()
    }

    fn times(most: usize) -> impl Strategy<Value = Vec<f64>> {
        // With whole numbers, several alignments are equally good.
        prop::collection::vec((0..12_u8).prop_map(f64::from), 0..most).prop_map(|mut times| {
            times.sort_by(f64::total_cmp);
            times
        })
    }

    proptest! {
        #[test]
        fn no_way_is_better(a in times(7), b in times(7), tolerance in 0.0..2.0) {
            let alignment = Alignment::new(&a, &b, tolerance);
            let distances = alignment.pairs.iter().map(|&(i, j)| (a[i] - b[j]).abs());
            let moved = distances.filter(|distance| *distance > tolerance).count();
            let count = moved + alignment.missing.len() + alignment.extra.len();
            prop_assert_eq!(count, least(&a, &b, tolerance).0 as usize);
        }

        #[test]
        fn every_time_is_accounted_for_once(a in times(40), b in times(40), tolerance in 0.0..2.0) {
            let alignment = Alignment::new(&a, &b, tolerance);
            let side = |pairs: Vec<usize>, rest: &[usize]| {
                let mut all = [pairs, rest.to_vec()].concat();
                all.sort_unstable();
                all
            };
            let pairs = &alignment.pairs;
            let (first, second) = (pairs.iter().map(|p| p.0).collect(), pairs.iter().map(|p| p.1).collect());
            prop_assert_eq!(side(first, &alignment.missing), (0..a.len()).collect::<Vec<_>>());
            prop_assert_eq!(side(second, &alignment.extra), (0..b.len()).collect::<Vec<_>>());
            prop_assert!(pairs.is_sorted_by(|p, q| p.0 < q.0 && p.1 < q.1));
        }
    }
}
