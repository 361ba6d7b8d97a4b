//! Steps of the run on one page: where these are short a step of the variation goes over several of them.

use crate::record::Stride;
use std::sync::LazyLock;

/// Places at which a step of the run is read, and how many: dense outputs are polynomials of degree 8 at most.
const SAMPLES: usize = 9;

/// Most steps: memory is bounded where a step of the variation would go over thousands.
const MOST: usize = 64;

/// Chebyshev's extreme points over [0, 1], and the weights of the polynomial through values there.
///
/// Source: J.-P. Berrut, L. N. Trefethen, *SIAM Review* 46 (2004) 501, equations (4.2) and (5.4).
static POINTS: LazyLock<[[f64; 2]; SAMPLES]> = LazyLock::new(|| {
    let last = SAMPLES - 1;
    std::array::from_fn(|k| {
        let angle = std::f64::consts::PI * k as f64 / last as f64;
        let sign = if k % 2 == 0 { 1.0 } else { -1.0 };
        [0.5 * (1.0 - angle.cos()), if k == 0 || k == last { 0.5 * sign } else { sign }]
    })
});

/// Steps of the run in which time goes evenly, one after the other.
#[derive(Debug, Default)]
pub(super) struct Trail {
    /// How many components are known of each.
    width: usize,
    /// When each begins, and when the last one ends, s.
    times: Vec<f64>,
    /// Components at all places, step by step.
    samples: Vec<f64>,
    /// Ends of growing pieces, with their contacts: when, s, until it is read as a whole, and then in which part of it.
    knots: Vec<(usize, f64)>,
}

impl Trail {
    /// Adds a step of which so many components are known; false where time does not go evenly in it.
    pub(super) fn add(&mut self, stride: &mut dyn Stride, width: usize) -> bool {
        if self.is_empty() {
            self.width = width;
        }
        let from = self.samples.len();
        self.samples.resize(from + SAMPLES * width, 0.0);
        let (mut even, mut ends) = (None, [0.0; 2]);
        for (k, ([part, _], y)) in POINTS.iter().zip(self.samples[from..].chunks_exact_mut(width)).enumerate()
        {
            let [t, pace] = stride.at(*part, y);
            if *even.get_or_insert(pace) != pace {
                self.samples.truncate(from);
                return false;
            }
            ends[usize::from(k > 0)] = t;
        }
        let [begin, end] = ends;
        if end <= begin {
            // Nothing happens in no time.
            self.samples.truncate(from);
            return true;
        }
        if self.times.is_empty() {
            self.times.push(begin);
        }
        self.times.push(end);
        self.knots.extend(stride.knots().iter().map(|(c, part)| (*c, begin + part * (end - begin))));
        true
    }

    /// Whether there is no step.
    pub(super) fn is_empty(&self) -> bool {
        self.times.is_empty()
    }

    /// Whether there is room for no more steps.
    pub(super) fn is_full(&self) -> bool {
        self.times.len() > MOST
    }

    /// How long it is, s.
    pub(super) fn length(&self) -> f64 {
        let [begin, end] = self.ends();
        end - begin
    }

    /// Its shortest step, as a part of it.
    pub(super) fn shortest(&self) -> f64 {
        let steps = self.times.windows(2).map(|ends| ends[1] - ends[0]);
        steps.fold(f64::INFINITY, f64::min) / self.length()
    }

    /// Readies it to be read as a whole.
    pub(super) fn close(&mut self) {
        let ([begin, _], length) = (self.ends(), self.length());
        self.knots.iter_mut().for_each(|knot| knot.1 = ((knot.1 - begin) / length).clamp(0.0, 1.0));
    }

    /// Forgets all steps.
    pub(super) fn clear(&mut self) {
        self.times.clear();
        self.samples.clear();
        self.knots.clear();
    }

    fn ends(&self) -> [f64; 2] {
        [self.times.first(), self.times.last()].map(|t| t.copied().unwrap_or(0.0))
    }
}

impl Stride for Trail {
    fn at(&mut self, part: f64, y: &mut [f64]) -> [f64; 2] {
        let ([begin, end], length) = (self.ends(), self.length());
        // The ends are hit to the last bit.
        let t = if part < 1.0 { begin + part * length } else { end };
        let last = self.times.len().saturating_sub(2);
        let step = self.times.partition_point(|from| *from <= t).saturating_sub(1).min(last);
        let place = (t - self.times[step]) / (self.times[step + 1] - self.times[step]);
        let samples = &self.samples[step * SAMPLES * self.width..(step + 1) * SAMPLES * self.width];
        interpolate(samples, self.width, place, y);
        [t, length]
    }

    fn knots(&self) -> &[(usize, f64)] {
        &self.knots
    }
}

/// What polynomials through samples are at a place of [0, 1], as many as are asked for.
fn interpolate(samples: &[f64], width: usize, place: f64, y: &mut [f64]) {
    let mut sum = 0.0;
    y.fill(0.0);
    for ([point, weight], row) in POINTS.iter().zip(samples.chunks_exact(width)) {
        if place == *point {
            return y.iter_mut().zip(row).for_each(|(y, sample)| *y = *sample);
        }
        let share = weight / (place - point);
        sum += share;
        y.iter_mut().zip(row).for_each(|(y, sample)| *y += share * sample);
    }
    let share = 1.0 / sum;
    y.iter_mut().for_each(|y| *y *= share);
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two polynomials of degree 8 over [1, 3] and then [3, 3.5], on one page.
    struct Eighth([f64; 2]);

    impl Stride for Eighth {
        fn at(&mut self, part: f64, y: &mut [f64]) -> [f64; 2] {
            let Self([begin, end]) = *self;
            let t = if part < 1.0 { begin + part * (end - begin) } else { end };
            (y[0], y[1]) = (t.powi(8), 1.0 - 2.0 * t);
            [t, end - begin]
        }

        fn knots(&self) -> &[(usize, f64)] {
            &[(3, 0.5)]
        }
    }

    #[test]
    fn what_is_read_is_what_the_steps_were() {
        let mut trail = Trail::default();
        assert!(trail.add(&mut Eighth([1.0, 3.0]), 2) && trail.add(&mut Eighth([3.0, 3.5]), 2));
        trail.close();
        assert_eq!((trail.knots(), trail.shortest()), (&[(3, 0.4), (3, 0.9)][..], 0.2));
        let mut y = [0.0; 2];
        for part in [0.0, 0.1, 0.35, 0.8, 0.93, 1.0] {
            let [t, pace] = trail.at(part, &mut y);
            assert!((t - 1.0 - 2.5 * part).abs() < 1e-15 && pace == 2.5);
            assert!((y[0] / t.powi(8) - 1.0).abs() < 1e-12, "{part}: {:e}", y[0] / t.powi(8) - 1.0);
            assert!((y[1] - 1.0 + 2.0 * t).abs() < 1e-13);
        }
    }

    /// Where time does not go evenly nothing is added.
    #[test]
    fn an_uneven_step_is_none() {
        struct Uneven;
        impl Stride for Uneven {
            fn at(&mut self, part: f64, y: &mut [f64]) -> [f64; 2] {
                y.fill(0.0);
                [part * part, 2.0 * part]
            }
            fn knots(&self) -> &[(usize, f64)] {
                &[]
            }
        }
        let mut trail = Trail::default();
        assert!(!trail.add(&mut Uneven, 2) && trail.is_empty());
    }

    #[test]
    fn a_step_that_takes_no_time_is_left_out_and_there_is_an_end_to_them() {
        let mut trail = Trail::default();
        assert!(trail.add(&mut Eighth([1.0, 1.0]), 2) && trail.is_empty());
        for k in 0..MOST {
            assert!(!trail.is_full());
            let t = k as f64;
            trail.add(&mut Eighth([t, t + 1.0]), 2);
            trail.add(&mut Eighth([t + 1.0, t + 1.0]), 2);
        }
        assert!(trail.is_full());
        trail.close();
        let mut y = [0.0; 2];
        trail.at(0.5, &mut y);
        assert!((y[1] - 1.0 + MOST as f64).abs() < 1e-12, "{y:?}");
    }
}
