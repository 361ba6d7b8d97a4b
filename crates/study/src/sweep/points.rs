//! Sample points in the unit cube. A point is computed from its index alone, so it depends neither on other points nor on their order nor
//! on the machine.

use super::latin::{Permutation, ROUNDS};
use super::sobol_points::{MOST_DIMENSIONS, MOST_POINTS, Sobol};
use chacha20::ChaCha8Rng;
use chacha20::rand_core::{Rng, SeedableRng};

/// Sampling method.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Sampling {
    /// Independent and uniform points (Monte Carlo).
    Random,
    /// Low-discrepancy Sobol sequence with a random digital shift.
    Sobol,
    /// Latin hypercube: in each dimension, each of `count` equal strata contains one point.
    LatinHypercube,
}

/// Points of one sampling.
#[derive(Debug, Clone)]
pub(crate) struct Points {
    seed: u64,
    layout: Layout,
}

#[derive(Debug, Clone)]
enum Layout {
    Random,
    Sobol(Sobol),
    Latin { strata: Vec<Permutation>, count: u64 },
}

/// Purpose of random numbers; each purpose has its own stream of the same seed.
#[derive(Debug, Clone, Copy)]
enum Purpose {
    Point = 1,
    Shift = 2,
    Strata = 3,
    Place = 4,
}

impl Points {
    /// Creates the points 0..count in `dimensions` dimensions. The seed selects the random numbers, the digital shift or the order of the
    /// strata.
    ///
    /// # Errors
    /// Fails if the number of points or dimensions is 0 or more than the sampling supports.
    pub(crate) fn new(sampling: Sampling, dimensions: usize, seed: u64, count: u64) -> Result<Self, String> {
        check(sampling, dimensions, count)?;
        let layout = match sampling {
            Sampling::Random => Layout::Random,
            Sampling::Sobol => {
                let mut shifts = generator(seed, Purpose::Shift, 0);
                Layout::Sobol(Sobol::new((0..dimensions).map(|_| shifts.next_u32())))
            }
            Sampling::LatinHypercube => {
                let strata = (0..dimensions as u64).map(|dimension| {
                    let mut keys = generator(seed, Purpose::Strata, dimension);
                    Permutation::new(count, std::array::from_fn::<_, ROUNDS, _>(|_| keys.next_u64()))
                });
                Layout::Latin { strata: strata.collect(), count }
            }
        };
        Ok(Self { seed, layout })
    }

    /// Creates the Sobol sequence without digital shift, for comparison with other programs.
    ///
    /// # Errors
    /// Fails if the number of points or dimensions is 0 or more than the sequence supports.
    #[cfg(test)]
    pub(crate) fn unshifted(dimensions: usize, count: u64) -> Result<Self, String> {
        check(Sampling::Sobol, dimensions, count)?;
        Ok(Self { seed: 0, layout: Layout::Sobol(Sobol::new(vec![0; dimensions])) })
    }

    /// Writes the coordinates of point `index`, below `count`. All coordinates are above 0 and below 1.
    pub(crate) fn write(&self, index: u64, point: &mut [f64]) {
        match &self.layout {
            Layout::Random => {
                let mut random = generator(self.seed, Purpose::Point, index);
                point.fill_with(|| centred(random.next_u64(), 52));
            }
            Layout::Sobol(sobol) => sobol.write(index, point),
            Layout::Latin { strata, count } => {
                let mut random = generator(self.seed, Purpose::Place, index);
                for (permutation, coordinate) in strata.iter().zip(point) {
                    *coordinate = inside(permutation.place(index), *count, random.next_u64());
                }
            }
        }
    }
}

/// Returns a random number inside one of `count` equal strata of 0..1. Stratum number and position in the stratum have 48 bits together, so
/// rounding does not move the number into the next stratum.
fn inside(stratum: u64, count: u64, random: u64) -> f64 {
    let bits = 48 - (count - 1).checked_ilog2().map_or(0, |log| log + 1);
    (stratum as f64 + centred(random, bits)) / count as f64
}

/// Returns a random number that is the exact centre of one of 2^bits equal parts of 0..1; at most 52 bits.
fn centred(random: u64, bits: u32) -> f64 {
    ((random >> (64 - bits)) as f64 + 0.5) / (1_u64 << bits) as f64
}

/// Returns the random numbers of a seed, purpose and stream. The generator, ChaCha with 8 rounds, is counter-based and gives the same bits
/// on every machine.
fn generator(seed: u64, purpose: Purpose, stream: u64) -> ChaCha8Rng {
    let mut key = [0; 32];
    key[..8].copy_from_slice(&seed.to_le_bytes());
    key[8] = purpose as u8;
    let mut generator = ChaCha8Rng::from_seed(key);
    generator.set_stream(stream);
    generator
}

fn check(sampling: Sampling, dimensions: usize, count: u64) -> Result<(), String> {
    let sobol = sampling == Sampling::Sobol;
    if dimensions == 0 || count == 0 {
        return Err(format!(
            "a sampling needs at least one dimension and one point, got {dimensions} and {count}"
        ));
    }
    if sobol && dimensions > MOST_DIMENSIONS {
        let instead = "use a Latin hypercube or random points for more";
        return Err(format!(
            "the Sobol sequence has at most {MOST_DIMENSIONS} dimensions, got {dimensions}: {instead}"
        ));
    }
    if sampling != Sampling::Random && count > MOST_POINTS {
        let name = if sobol { "Sobol sequence" } else { "Latin hypercube" };
        return Err(format!("a {name} has at most {MOST_POINTS} points, got {count}"));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    const ALL: [Sampling; 3] = [Sampling::Random, Sampling::Sobol, Sampling::LatinHypercube];

    fn point(points: &Points, index: u64, dimensions: usize) -> Vec<f64> {
        let mut point = vec![0.0; dimensions];
        points.write(index, &mut point);
        point
    }

    fn points(sampling: Sampling, dimensions: usize, seed: u64, count: u64) -> Vec<Vec<f64>> {
        let points = Points::new(sampling, dimensions, seed, count).unwrap();
        (0..count).map(|index| point(&points, index, dimensions)).collect()
    }

    /// Returns the correlation coefficient of two dimensions.
    fn correlation(points: &[Vec<f64>], first: usize, second: usize) -> f64 {
        let covariance = |i: usize, j: usize| points.iter().map(|p| (p[i] - 0.5) * (p[j] - 0.5)).sum::<f64>();
        covariance(first, second) / (covariance(first, first) * covariance(second, second)).sqrt()
    }

    /// Reference: independent implementation of ChaCha with 8 rounds in Python. Key: 1 (8 bytes), 1 (a byte), zeros;
    /// the stream is the index.
    #[test]
    fn random_points_are_the_same_everywhere() {
        let random = Points::new(Sampling::Random, 9, 1, 10_000_000_000).unwrap();
        let table = [
            (0, [0.23552759232624065, 0.8297170553216705, 0.6513001527848187]),
            (5_000_000_000, [0.44197852802722337, 0.5199416170001349, 0.510002824564591]),
        ];
        for (index, expected) in table {
            let found = point(&random, index, 9);
            assert_eq!([found[0], found[1], found[8]], expected);
        }
    }

    #[test]
    fn seeds_and_indices_choose_the_point_and_dimensions_do_not_go_together() {
        for sampling in ALL {
            let (first, second) = (points(sampling, 4, 1, 4096), points(sampling, 4, 2, 4096));
            assert!(first.iter().flatten().all(|x| *x > 0.0 && *x < 1.0));
            assert!(first.iter().zip(&second).all(|(a, b)| a != b), "{sampling:?}");
            let again = Points::new(sampling, 4, 1, 4096).unwrap();
            assert_eq!(
                [point(&again, 4000, 4), point(&again, 17, 4)],
                [first[4000].clone(), first[17].clone()]
            );
            for (i, j) in [(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)] {
                let found = correlation(&first, i, j);
                assert!(found.abs() < 4.0 / 64.0, "{sampling:?} {i} {j}: {found}");
            }
        }
    }

    #[test]
    fn each_stratum_of_a_latin_hypercube_has_one_point() {
        for count in [1, 2, 7, 1000, 65_537] {
            let found = points(Sampling::LatinHypercube, 3, 5, count);
            for dimension in 0..3 {
                let mut hit = vec![false; count as usize];
                for point in &found {
                    hit[(point[dimension] * count as f64).floor() as usize] = true;
                }
                assert!(hit.iter().all(|hit| *hit), "{count}");
            }
        }
    }

    /// The order of the points is not correlated with their strata, nor are neighbouring points.
    #[test]
    fn strata_come_in_no_order() {
        let found = points(Sampling::LatinHypercube, 2, 3, 10_000);
        let placed =
            |i: usize| [i as f64 / 1e4, found[i][0], found[(i + 1) % 10_000][0], found[i][1]].to_vec();
        let placed: Vec<Vec<f64>> = (0..10_000).map(placed).collect();
        for (i, j) in [(0, 1), (0, 3), (1, 2), (1, 3)] {
            assert!(correlation(&placed, i, j).abs() < 0.04, "{i} {j}");
        }
    }

    /// Positions within the strata are uniform (mean 1/2, variance 1/12), and not correlated with each other or with the strata.
    #[test]
    fn places_in_the_strata_are_random() {
        let found = points(Sampling::LatinHypercube, 2, 3, 10_000);
        let places: Vec<Vec<f64>> =
            found.iter().map(|p| vec![(p[0] * 1e4).fract(), (p[1] * 1e4).fract(), p[0], p[1]]).collect();
        for i in 0..2 {
            let mean = places.iter().map(|p| p[i]).sum::<f64>() / 1e4;
            let variance = places.iter().map(|p| (p[i] - mean) * (p[i] - mean)).sum::<f64>() / 1e4;
            assert!((mean - 0.5).abs() < 0.012 && (variance - 1.0 / 12.0).abs() < 0.003, "{mean} {variance}");
        }
        assert!([(0, 1), (0, 2), (1, 3)].iter().all(|(i, j)| correlation(&places, *i, *j).abs() < 0.04));
    }

    #[test]
    fn no_rounding_moves_a_place_into_another_stratum() {
        for count in [1, 2, 3, 7, 1000, 65_537, 99_999_999, (1 << 32) - 1, 1 << 32] {
            for stratum in [0, count / 3, count / 2, count - 1] {
                for random in [0, u64::MAX] {
                    let x = inside(stratum, count, random);
                    assert!(
                        x > 0.0 && x < 1.0 && (x * count as f64).floor() == stratum as f64,
                        "{stratum} {count}"
                    );
                }
            }
        }
    }

    /// The mean of x^2 y^2 over the square is 1/9; the standard deviation is sqrt(1/25 - 1/81) = 0.166 per point.
    #[test]
    fn means_converge_as_each_sampling_should() {
        for (sampling, most) in ALL.into_iter().zip([4.0 * 0.166 / 128.0, 2e-4, 4.0 * 0.166 / 128.0]) {
            let found = points(sampling, 2, 11, 16_384);
            let mean = found.iter().map(|p| p[0] * p[0] * p[1] * p[1]).sum::<f64>() / 16_384.0;
            assert!((mean - 1.0 / 9.0).abs() < most, "{sampling:?}: {mean}");
        }
    }

    #[test]
    fn what_a_sampling_has_not_is_refused() {
        let fault = |sampling, dimensions, count| Points::new(sampling, dimensions, 1, count).err();
        let sobol = "the Sobol sequence has at most 64 dimensions, got 65: use a Latin hypercube or random \
                     points for more";
        let latin = "a Latin hypercube has at most 4294967296 points, got 4294967297";
        assert_eq!(fault(Sampling::Sobol, 65, 1).as_deref(), Some(sobol));
        assert_eq!(fault(Sampling::LatinHypercube, 65, (1 << 32) + 1).as_deref(), Some(latin));
        assert!(fault(Sampling::Random, 0, 1).is_some() && fault(Sampling::Random, 1, 0).is_some());
        assert!(ALL.iter().all(|sampling| fault(*sampling, 64, 1 << 32).is_none()));
    }

    #[test]
    fn the_ends_of_the_random_numbers_stay_inside() {
        assert_eq!(centred(0, 52), 0.5f64.powi(53));
        assert_eq!(centred(u64::MAX, 52), 1.0 - 0.5f64.powi(53));
    }
}
