//! Statistics of a study: quantiles, failures, extremes. The memory does not depend on the number of cases.

use super::{Study, StudyError};
use schemars::JsonSchema;
use serde::Serialize;
use std::collections::BTreeMap;
use std::path::Path;
use stickslip_quantity::Real;

/// Probabilities of the quantiles.
const PROBABILITIES: [f64; 7] = [0.0, 0.05, 0.25, 0.5, 0.75, 0.95, 1.0];
/// Number of extreme cases reported at each end.
const FAR: usize = 5;
/// Maximum number of reasons of failures that are counted separately.
const REASONS: usize = 20;
/// Number of bits that one pass of the radix selection determines, and number of passes.
const BITS: u32 = 16;
const READINGS: u32 = 4;

/// Statistics of a study.
#[derive(Debug, Serialize, JsonSchema)]
pub struct Statistics {
    /// number of cases
    pub cases: u64,
    /// number of cases without results
    pub failed: u64,
    /// number of failed cases by reason. Values that differ from case to case are omitted from the reasons.
    pub reasons: Vec<(String, u64)>,
    /// Quantiles of each result, in the order of the study file.
    pub quantiles: Vec<Quantiles>,
    /// Cases with the smallest and largest values of the first numerical result.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub extremes: Option<Extremes>,
}

/// Quantiles of one result, or frequencies of its words.
#[derive(Debug, Serialize, JsonSchema)]
pub struct Quantiles {
    /// name of the result
    pub result: String,
    /// number of cases that have this result
    pub count: u64,
    /// arithmetic mean of the result
    pub mean: Real,
    /// sample standard deviation of the result
    pub standard_deviation: Real,
    /// minimum, quantiles of 5, 25, 50, 75 and 95 %, and maximum. Quantile p is interpolated linearly between the
    /// sorted values at rank p (n - 1), counted from 0.
    pub quantiles: [Real; 7],
    /// frequency of each word, if the result is a word. Absent for numbers.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub words: Vec<(String, u64)>,
}

/// Extreme cases of a result.
#[derive(Debug, Serialize, JsonSchema)]
pub struct Extremes {
    /// name of the first numerical result
    pub result: String,
    /// case numbers and values of the smallest results, the smallest first
    pub lowest: Vec<(u64, Real)>,
    /// case numbers and values of the largest results, the largest first
    pub highest: Vec<(u64, Real)>,
}

impl Study {
    /// Computes the statistics from all parts in a folder.
    ///
    /// # Errors
    /// Parts are missing or cannot be read.
    pub fn statistics(&self, folder: &Path) -> Result<Statistics, StudyError> {
        self.check_complete(folder)?;
        let (mut failed, mut reasons) = (0, BTreeMap::new());
        let first = self.wanted.iter().position(|wanted| wanted.codes.is_none());
        let mut ends = Ends::default();
        self.each_part(folder, |part, open| {
            for error in open.errors(self)?.into_iter().flatten() {
                failed += 1;
                let reason = without_values(&error);
                let is_known = reasons.len() < REASONS || reasons.contains_key(&reason);
                *reasons
                    .entry(if is_known { reason } else { "other reasons".to_owned() })
                    .or_insert(0_u64) += 1;
            }
            if let Some(result) = first {
                let from = self.part(part).start;
                let values = open.result(self, result)?;
                (from..).zip(values).filter(|(_, value)| value.is_finite()).for_each(|case| ends.take(case));
            }
            Ok(())
        })?;
        let quantiles =
            (0..self.wanted.len()).map(|result| self.quantiles(folder, result)).collect::<Result<_, _>>()?;
        let mut reasons: Vec<(String, u64)> = reasons.into_iter().collect();
        reasons.sort_by(|a, b| b.1.cmp(&a.1).then_with(|| a.0.cmp(&b.0)));
        let told = |all: Vec<(u64, f64)>| all.into_iter().map(|(case, value)| (case, Real(value))).collect();
        let extremes = first.map(|result| Extremes {
            result: self.wanted[result].name.clone(),
            lowest: told(ends.lowest),
            highest: told(ends.highest),
        });
        Ok(Statistics { cases: self.cases(), failed, reasons, quantiles, extremes })
    }

    fn quantiles(&self, folder: &Path, result: usize) -> Result<Quantiles, StudyError> {
        let wanted = &self.wanted[result];
        let (mut count, mut sum, mut squares) = (0_u64, Sum::default(), Sum::default());
        let mut words = vec![0_u64; wanted.codes.as_ref().map_or(0, Vec::len)];
        // Search for the two ranks next to each probability.
        let mut search = [Search::default(); 2 * PROBABILITIES.len()];
        // Radix selection: each pass finds the next digit of all values with a histogram per prefix.
        for reading in 0..if wanted.codes.is_some() { 1 } else { READINGS } {
            let mut prefixes: Vec<u64> = search.iter().map(|search| search.prefix).collect();
            prefixes.dedup();
            let mean = sum.total() / count.max(1) as f64;
            let mut histograms = vec![vec![0_u64; 1 << BITS]; prefixes.len()];
            self.each_part(folder, |_, open| {
                for value in open.result(self, result)?.into_iter().filter(|value| value.is_finite()) {
                    if reading == 0 {
                        (count, _) = (count + 1, sum.add(value));
                        words.get_mut(value as usize).into_iter().for_each(|word| *word += 1);
                    } else if reading == 1 {
                        squares.add((value - mean) * (value - mean));
                    }
                    let (prefix, digit) = split(ordered(value), reading);
                    if let Ok(place) = prefixes.binary_search(&prefix) {
                        histograms[place][digit] += 1;
                    }
                }
                Ok(())
            })?;
            for (place, search) in search.iter_mut().enumerate() {
                if reading == 0 {
                    let rank = PROBABILITIES[place / 2] * count.saturating_sub(1) as f64;
                    search.rank = if place % 2 == 0 { rank.floor() } else { rank.ceil() } as u64;
                }
                if let Ok(place) = prefixes.binary_search(&search.prefix) {
                    search.descend(&histograms[place]);
                }
            }
        }
        let found = |place: usize| {
            let [low, high] = [2 * place, 2 * place + 1].map(|place| value(search[place].prefix));
            let part = (PROBABILITIES[place] * count.saturating_sub(1) as f64).fract();
            Real(if count == 0 { f64::NAN } else { low + (high - low) * part })
        };
        let is_number = wanted.codes.is_none() && count > 0;
        let deviation =
            if is_number && count > 1 { (squares.total() / (count - 1) as f64).sqrt() } else { f64::NAN };
        let names = wanted.codes.iter().flatten().cloned().zip(words).filter(|(_, count)| *count > 0);
        Ok(Quantiles {
            result: wanted.name.clone(),
            count,
            mean: Real(if is_number { sum.total() / count as f64 } else { f64::NAN }),
            standard_deviation: Real(deviation),
            quantiles: if is_number { std::array::from_fn(found) } else { [Real(f64::NAN); 7] },
            words: names.collect(),
        })
    }
}

/// Search for the value with a given rank, digit by digit.
#[derive(Debug, Clone, Copy, Default)]
struct Search {
    prefix: u64,
    rank: u64,
}

impl Search {
    fn descend(&mut self, histogram: &[u64]) {
        for (digit, count) in histogram.iter().enumerate() {
            if self.rank < *count {
                self.prefix = (self.prefix << BITS) | digit as u64;
                return;
            }
            self.rank -= count;
        }
    }
}

/// Returns bits whose order as integers equals the order of the numbers.
fn ordered(value: f64) -> u64 {
    let bits = value.to_bits();
    if bits >> 63 == 1 { !bits } else { bits | (1 << 63) }
}

fn value(ordered: u64) -> f64 {
    f64::from_bits(if ordered >> 63 == 1 { ordered & !(1 << 63) } else { !ordered })
}

/// Returns the digits before the digit of a pass, and the digit of this pass.
fn split(ordered: u64, reading: u32) -> (u64, usize) {
    let below = BITS * (READINGS - reading);
    let prefix = ordered.checked_shr(below).unwrap_or(0);
    (prefix, ((ordered >> (below - BITS)) & ((1 << BITS) - 1)) as usize)
}

/// Compensated sum (Neumaier).
#[derive(Debug, Default)]
struct Sum {
    sum: f64,
    lost: f64,
}

impl Sum {
    fn add(&mut self, value: f64) {
        let sum = self.sum + value;
        self.lost +=
            if self.sum.abs() >= value.abs() { (self.sum - sum) + value } else { (value - sum) + self.sum };
        self.sum = sum;
    }

    fn total(&self) -> f64 {
        self.sum + self.lost
    }
}

/// Extreme cases found so far.
#[derive(Debug, Default)]
struct Ends {
    lowest: Vec<(u64, f64)>,
    highest: Vec<(u64, f64)>,
}

impl Ends {
    fn take(&mut self, case: (u64, f64)) {
        keep(&mut self.lowest, case, |a, b| a < b);
        keep(&mut self.highest, case, |a, b| a > b);
    }
}

fn keep(ends: &mut Vec<(u64, f64)>, case: (u64, f64), is_before: impl Fn(f64, f64) -> bool) {
    if ends.len() < FAR || ends.last().is_some_and(|last| is_before(case.1, last.1)) {
        let place = ends.iter().position(|known| is_before(case.1, known.1)).unwrap_or(ends.len());
        ends.insert(place, case);
        ends.truncate(FAR);
    }
}

/// Returns an error message without the given value: `bodies.slider.mass: expected a mass above 0`.
fn without_values(error: &str) -> String {
    error.split(", got ").next().unwrap_or(error).to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Comparison with sorting.
    #[test]
    fn ranks_are_found_digit_by_digit() {
        let values: Vec<f64> =
            (0..1000).map(|i| math::sin(f64::from(i) * 1.7) * math::exp(f64::from(i % 37) - 20.0)).collect();
        let mut sorted = values.clone();
        sorted.sort_by(f64::total_cmp);
        for rank in [0, 1, 17, 500, 998, 999] {
            let mut search = Search { prefix: 0, rank };
            for reading in 0..READINGS {
                let mut histogram = vec![0; 1 << BITS];
                for value in &values {
                    let (prefix, digit) = split(ordered(*value), reading);
                    histogram[digit] += u64::from(prefix == search.prefix);
                }
                search.descend(&histogram);
            }
            assert_eq!(value(search.prefix).to_bits(), sorted[rank as usize].to_bits());
        }
    }

    #[test]
    fn sums_keep_what_rounding_would_lose() {
        let mut sum = Sum::default();
        [1e16, 1.0, -1e16, 1.0].into_iter().for_each(|value| sum.add(value));
        assert_eq!(sum.total(), 2.0);
    }
}
