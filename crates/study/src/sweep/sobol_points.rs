//! Sobol sequence with 32 bits per coordinate and direct access to every point.

use super::sobol_directions::INITIAL;

/// Bits per coordinate.
const BITS: usize = 32;

/// Number of points of the sequence.
pub(crate) const MOST_POINTS: u64 = 1 << BITS;

/// Maximum number of dimensions.
pub(crate) const MOST_DIMENSIONS: usize = INITIAL.len() + 1;

/// Sobol sequence: direction numbers and digital shift of each dimension.
///
/// Source: Sobol', "On the distribution of points in a cube and the approximate evaluation of integrals", USSR Computational Mathematics
/// and Mathematical Physics 7 (1967), 86-112.
#[derive(Debug, Clone)]
pub(crate) struct Sobol {
    dimensions: Vec<([u32; BITS], u32)>,
}

impl Sobol {
    /// Creates the sequence with one digital shift per dimension, a 32-bit number that is combined with all coordinates by exclusive or.
    /// Shifts of 0 give the original sequence. Shifts beyond [`MOST_DIMENSIONS`] are ignored.
    pub(crate) fn new(shifts: impl IntoIterator<Item = u32>) -> Self {
        let directions =
            std::iter::once(first()).chain(INITIAL.iter().map(|&(polynomial, m)| later(polynomial, m)));
        Self { dimensions: directions.zip(shifts).collect() }
    }

    /// Writes the coordinates of point `index`, below 2^32. No coordinate is 0 or 1.
    ///
    /// The order of the points is that of Antonov and Saleev (USSR Computational Mathematics and Mathematical Physics 19, 1979, 252-256),
    /// as in SciPy. The bits of a point are the exclusive or of the direction numbers for which the Gray code index ^ (index / 2) has a 1.
    /// A coordinate with bits b is (b + 1/2) / 2^32.
    pub(crate) fn write(&self, index: u64, point: &mut [f64]) {
        let gray = index ^ (index >> 1);
        for ((directions, shift), coordinate) in self.dimensions.iter().zip(point) {
            let (mut left, mut bits) = (gray as u32, *shift);
            while left != 0 {
                bits ^= directions[left.trailing_zeros() as usize];
                left &= left - 1;
            }
            *coordinate = (f64::from(bits) + 0.5) / MOST_POINTS as f64;
        }
    }
}

/// Returns the direction numbers of dimension 1: one half, one quarter, one eighth, …, in units of 2^-32.
fn first() -> [u32; BITS] {
    std::array::from_fn(|k| 1 << (BITS - 1 - k))
}

/// Returns the direction numbers v_k of a dimension after the first, in units of 2^-32. The initial direction numbers are v_k = m_k / 2^k.
///
/// The further direction numbers follow from the polynomial x^s + a_1 x^(s-1) + ... + a_(s-1) x + 1. With ^ for the exclusive or, v_k = a_1
/// v_(k-1) ^ ... ^ a_(s-1) v_(k-s+1) ^ v_(k-s) ^ v_(k-s) / 2^s.
fn later(polynomial: u32, m: &[u32]) -> [u32; BITS] {
    let degree = m.len();
    let mut v = [0; BITS];
    for k in 0..BITS {
        v[k] = match m.get(k) {
            Some(m) => m << (BITS - 1 - k),
            None => (1..degree)
                .filter(|j| polynomial >> (degree - j) & 1 == 1)
                .fold(v[k - degree] ^ (v[k - degree] >> degree), |sum, j| sum ^ v[k - j]),
        };
    }
    v
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns point `index` in 64 dimensions without shift, in units of 2^-32.
    fn bits(index: u64) -> Vec<u32> {
        let mut point = vec![0.0; MOST_DIMENSIONS];
        Sobol::new(vec![0; MOST_DIMENSIONS]).write(index, &mut point);
        point.iter().map(|x| (x * MOST_POINTS as f64 - 0.5) as u32).collect()
    }

    /// Reference: `scipy.stats.qmc.Sobol(6, scramble=False, bits=32).random(8)` times 2^32, SciPy 1.17.1.
    #[test]
    fn the_first_points_are_scipys() {
        let first = [
            [0, 0, 0, 0, 0, 0],
            [2147483648, 2147483648, 2147483648, 2147483648, 2147483648, 2147483648],
            [3221225472, 1073741824, 1073741824, 1073741824, 3221225472, 3221225472],
            [1073741824, 3221225472, 3221225472, 3221225472, 1073741824, 1073741824],
            [1610612736, 1610612736, 2684354560, 3758096384, 1610612736, 536870912],
            [3758096384, 3758096384, 536870912, 1610612736, 3758096384, 2684354560],
            [2684354560, 536870912, 3758096384, 2684354560, 2684354560, 3758096384],
            [536870912, 2684354560, 1610612736, 536870912, 536870912, 1610612736],
        ];
        for (index, point) in (0..).zip(first) {
            assert_eq!(bits(index)[..6], point);
        }
    }

    /// Reference: `Sobol(64, scramble=False, bits=32)` after `fast_forward(1_000_003)`, times 2^32, SciPy 1.17.1.
    #[test]
    fn a_late_point_is_scipys() {
        let point = bits(1_000_003);
        assert_eq!(point[..6], [1187450880, 2413424640, 334991360, 1796354048, 3773812736, 2341023744]);
        assert_eq!((point[36], point[63]), (796602368, 1323372544));
    }

    /// Reference: checksum of all 64 times 32 direction numbers in the array `_sv` of `Sobol(64, bits=32)`, SciPy
    /// 1.17.1.
    #[test]
    fn all_direction_numbers_are_scipys() {
        let sobol = Sobol::new(vec![0; MOST_DIMENSIONS]);
        let numbers = sobol.dimensions.iter().flat_map(|(directions, _)| directions);
        let sum = numbers.fold(0_u64, |sum, v| (sum ^ u64::from(*v)).wrapping_mul(0x100_0000_01b3));
        assert_eq!((sobol.dimensions.len(), sum), (64, 0xbe9718dcea6e2c3a));
    }

    #[test]
    fn a_shift_changes_bits_and_no_coordinate_reaches_an_end() {
        let mut point = [0.0; 2];
        Sobol::new([u32::MAX, 1 << 31]).write(0, &mut point);
        assert_eq!(point, [1.0 - 0.5f64.powi(33), 0.5 + 0.5f64.powi(33)]);
    }
}
