//! Numerically generated rough lines: self-affine between two cut-off wavelengths.
//!
//! z(x) = ΣAₖcos(2πkx/L + φₖ) over the wavelengths L/k between the cut-offs, with Aₖ ~ k^{-(H+1/2)}. The power spectrum is C(q) ~
//! q^{-(1+2H)} (Persson et al., J. Phys.: Condens. Matter 17, 2005, R1). The seed determines the phases φₖ. The line is scaled to the
//! given rms height.
//!
//! All operations round alike on every machine, so the generated line is the same on all platforms.

use thiserror::Error;

/// Self-affine rough line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SelfAffine {
    /// Root-mean-square height relative to the mean, m, above 0.
    pub rms: f64,
    /// Hurst exponent, between 0 and 1.
    pub hurst: f64,
    /// Longest wavelength, m, at most the length.
    pub longest: f64,
    /// Shortest wavelength, m, at most the longest one and at least twice the distance of the points.
    pub shortest: f64,
    /// Length L of the line, m; the line is periodic with this length.
    pub length: f64,
    /// Number of points, a power of two from 4 to [`Self::MAX_POINTS`].
    pub points: usize,
    /// Seed of the random phases.
    pub seed: u64,
}

/// Reason why a rough line cannot be generated.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum RoughnessError {
    /// The rms height is not above 0 or not finite, m.
    #[error("expected an rms height above 0 m, got {0}")]
    Rms(f64),
    /// The Hurst exponent is not between 0 and 1.
    #[error("expected a Hurst exponent between 0 and 1, got {0}")]
    Hurst(f64),
    /// The length is not above 0 or not finite, m.
    #[error("expected a length above 0 m, got {0}")]
    Length(f64),
    /// The number of points is not a power of two, or is out of its range.
    #[error("expected a power of two between 4 and {max} points, got {0}", max = SelfAffine::MAX_POINTS)]
    Points(usize),
    /// The longest wavelength exceeds the length, m.
    #[error("expected a longest wavelength of at most the length {length} m, got {longest} m")]
    Longest {
        /// Wavelength given, m.
        longest: f64,
        /// Length of the line, m.
        length: f64,
    },
    /// The shortest wavelength exceeds the longest one, m.
    #[error("expected a shortest wavelength of at most the longest of {longest} m, got {shortest} m")]
    Swapped {
        /// Wavelength given, m.
        shortest: f64,
        /// Longest wavelength, m.
        longest: f64,
    },
    /// The shortest wavelength is below twice the distance of the points, m.
    #[error(
        "expected a shortest wavelength of at least two distances of points, {least} m, got {shortest} m"
    )]
    Shortest {
        /// Wavelength given, m.
        shortest: f64,
        /// Twice the distance of the points, m.
        least: f64,
    },
    /// No wavelength L/k with integer k lies between the cut-offs.
    #[error("no integer fraction of the length lies between the longest and the shortest wavelength")]
    NoWave,
}

impl SelfAffine {
    /// Largest number of points.
    pub const MAX_POINTS: usize = 1 << 20;

    /// Returns heights at equal distances, m, with mean 0.
    ///
    /// # Errors
    ///
    /// Returns the first parameter that is out of its range.
    pub fn heights(&self) -> Result<Vec<f64>, RoughnessError> {
        let [first, last] = self.waves()?;
        let mut random = Random(self.seed);
        let mut spectrum = vec![[0.0; 2]; self.points];
        for (k, wave) in spectrum.iter_mut().enumerate().take(last + 1).skip(first) {
            let amplitude = math::powf(k as f64, -(self.hurst + 0.5));
            let [cosine, sine] = random.direction();
            *wave = [amplitude * cosine, amplitude * sine];
        }
        transform(&mut spectrum);
        let count = self.points as f64;
        let square: f64 = spectrum.iter().map(|z| z[0] * z[0]).sum();
        let scale = self.rms / (square / count).sqrt();
        Ok(spectrum.iter().map(|z| scale * z[0]).collect())
    }

    /// Returns the smallest and largest number of waves along the length.
    fn waves(&self) -> Result<[usize; 2], RoughnessError> {
        let Self { rms, hurst, longest, shortest, length, points, .. } = *self;
        let positive = |value: f64| value > 0.0 && value.is_finite();
        if !positive(rms) {
            return Err(RoughnessError::Rms(rms));
        }
        if !(0.0..=1.0).contains(&hurst) {
            return Err(RoughnessError::Hurst(hurst));
        }
        if !positive(length) {
            return Err(RoughnessError::Length(length));
        }
        if !points.is_power_of_two() || !(4..=Self::MAX_POINTS).contains(&points) {
            return Err(RoughnessError::Points(points));
        }
        // Tolerance for the rounding of quotients.
        let slack = 1e-9;
        if !(longest > 0.0 && longest <= length * (1.0 + slack)) {
            return Err(RoughnessError::Longest { longest, length });
        }
        if !(shortest > 0.0 && shortest <= longest) {
            return Err(RoughnessError::Swapped { shortest, longest });
        }
        let least = 2.0 * length / points as f64;
        if shortest < least * (1.0 - slack) {
            return Err(RoughnessError::Shortest { shortest, least });
        }
        let first = (length / longest * (1.0 - slack)).ceil() as usize;
        let last = ((length / shortest * (1.0 + slack)).floor() as usize).min(points / 2);
        if first == 0 || first > last {
            return Err(RoughnessError::NoWave);
        }
        Ok([first, last])
    }
}

/// Random integers: SplitMix64 (Steele, Lea and Flood, OOPSLA 2014).
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Returns a uniform random number between -1 and 1.
    fn even(&mut self) -> f64 {
        (self.next() >> 11) as f64 * (1.0 / (1_u64 << 52) as f64) - 1.0
    }

    /// Returns cosine and sine of a uniformly distributed angle, from a random point in the unit circle (rejection method).
    fn direction(&mut self) -> [f64; 2] {
        loop {
            let (x, y) = (self.even(), self.even());
            let square = x * x + y * y;
            if square > 1e-6 && square < 1.0 {
                let length = square.sqrt();
                return [x / length, y / length];
            }
        }
    }
}

/// Returns cosines and sines of the first half of n equal parts of a circle, n a power of two from 4.
///
/// The angles are obtained by repeated halving with square roots.
fn directions(n: usize) -> Vec<[f64; 2]> {
    let half = n / 2;
    let mut table = vec![[0.0_f64; 2]; half + 1];
    (table[0], table[half / 2], table[half]) = ([1.0, 0.0], [0.0, 1.0], [-1.0, 0.0]);
    let mut step = half / 2;
    while step > 1 {
        for from in (0..half).step_by(step) {
            let (a, b) = (table[from], table[from + step]);
            let sum = [a[0] + b[0], a[1] + b[1]];
            let length = (sum[0] * sum[0] + sum[1] * sum[1]).sqrt();
            table[from + step / 2] = [sum[0] / length, sum[1] / length];
        }
        step /= 2;
    }
    table
}

/// Fast Fourier transform Σ cₖe^{2πijk/n} in place (Cooley and Tukey, Math. Comp. 19, 1965).
fn transform(c: &mut [[f64; 2]]) {
    let n = c.len();
    let shift = usize::BITS - n.trailing_zeros();
    for i in 0..n {
        let mirror = i.reverse_bits() >> shift;
        if i < mirror {
            c.swap(i, mirror);
        }
    }
    let table = directions(n);
    let mut half = 1;
    while half < n {
        for first in (0..n).step_by(2 * half) {
            for k in 0..half {
                let [cosine, sine] = table[k * (n / 2 / half)];
                let [x, y] = c[first + half + k];
                let turned = [x * cosine - y * sine, x * sine + y * cosine];
                let [x, y] = c[first + k];
                c[first + k] = [x + turned[0], y + turned[1]];
                c[first + half + k] = [x - turned[0], y - turned[1]];
            }
        }
        half *= 2;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn directions_agree_with_sines_of_the_library() {
        let n = 1024;
        for (k, [cosine, sine]) in directions(n).iter().enumerate() {
            let angle = 2.0 * std::f64::consts::PI * k as f64 / n as f64;
            approx::assert_abs_diff_eq!(*cosine, angle.cos(), epsilon = 2e-15);
            approx::assert_abs_diff_eq!(*sine, angle.sin(), epsilon = 2e-15);
        }
    }

    #[test]
    fn its_transform_is_the_sum_written_out() {
        let mut random = Random(3);
        let c: Vec<[f64; 2]> = (0..16).map(|_| [random.even(), random.even()]).collect();
        let mut fast = c.clone();
        transform(&mut fast);
        for (j, z) in fast.iter().enumerate() {
            let mut sum = [0.0; 2];
            for (k, [x, y]) in c.iter().enumerate() {
                let (sine, cosine) = (2.0 * std::f64::consts::PI * (j * k % 16) as f64 / 16.0).sin_cos();
                sum = [sum[0] + x * cosine - y * sine, sum[1] + x * sine + y * cosine];
            }
            approx::assert_abs_diff_eq!(z[0], sum[0], epsilon = 1e-14);
            approx::assert_abs_diff_eq!(z[1], sum[1], epsilon = 1e-14);
        }
    }
}
