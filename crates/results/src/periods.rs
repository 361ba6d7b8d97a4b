//! The periods of a waveform within a run, and a body's motion with a sample at each of their ends.

use crate::job::Job;
use stickslip_drive::Waveform;
use stickslip_drive::scene::{Freedom, Side};

/// A sample this near to the end of a period, in periods, is the end.
const SAME: f64 = 1e-9;

/// The whole periods that a waveform has run through.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Periods {
    /// Start of the first, s.
    pub start: f64,
    /// Length, s.
    pub length: f64,
    /// How many are whole; at least one.
    pub count: usize,
}

/// A body's motion over whole periods.
#[derive(Debug, Clone, PartialEq)]
pub struct Motion {
    /// Times, s, with the ends of all periods.
    pub t: Vec<f64>,
    /// Positions, m.
    pub x: Vec<f64>,
    /// How many ends had no row or event and were interpolated by the cubic of positions and velocities.
    pub interpolated: usize,
}

impl Periods {
    /// The periods of a waveform until time `end`, s; none without period, or before the first is over.
    pub fn until(waveform: &Waveform, end: f64) -> Option<Self> {
        let (length, timing) = (waveform.period()?, waveform.timing());
        let cycles = timing.cycles.unwrap_or(f64::INFINITY);
        let count = ((end - timing.delay) / length).min(cycles) + SAME;
        // What has more periods than samples has no use for them either.
        let count = count.floor().min(1e9);
        (count >= 1.0).then_some(Self { start: timing.delay, length, count: count as usize })
    }

    /// The periods of whatever drives contact `c`: the one waveform that its bodies follow, or else the waveform of the
    /// scenario's `figures`; until time `end`, s.
    pub fn of_contact(job: &Job, c: usize, end: f64) -> Option<Self> {
        let scene = &job.scenario.scene;
        let followed = scene.contacts.get(c)?.part.between.iter().filter_map(|side| match side {
            Side::Body(body) => match scene.bodies.get(*body)?.part.x.freedom {
                Freedom::Follows(waveform) => Some(waveform),
                Freedom::Fixed | Freedom::Free => None,
            },
            Side::Ground => None,
        });
        let followed: Vec<usize> = followed.collect();
        let waveform = match followed.as_slice() {
            [only] => *only,
            _ => job.scenario.figures.waveform?,
        };
        Self::until(&scene.waveforms.get(waveform)?.part, end)
    }

    /// End of period k, and start of the next, s; 0: start of the first.
    pub fn end_of(&self, k: usize) -> f64 {
        self.start + k as f64 * self.length
    }

    /// Start and end of the first period, s.
    pub fn first(&self) -> (f64, f64) {
        (self.start, self.end_of(1))
    }

    /// Start and end of the last period, s.
    pub fn last(&self) -> (f64, f64) {
        (self.end_of(self.count - 1), self.end_of(self.count))
    }

    /// A motion (t, x, v) cut to the periods, with a sample at each end of a period.
    pub fn motion(&self, t: &[f64], x: &[f64], v: &[f64]) -> Motion {
        let mut motion = Motion { t: Vec::new(), x: Vec::new(), interpolated: 0 };
        let samples = t.len().min(x.len()).min(v.len());
        if samples == 0 {
            return motion;
        }
        let hair = SAME * self.length;
        let mut next = 0;
        for k in 0..=self.count {
            let end = self.end_of(k);
            while next < samples && t[next] < end - hair {
                if k > 0 {
                    motion.t.push(t[next]);
                    motion.x.push(x[next]);
                }
                next += 1;
            }
            let here = next.min(samples - 1);
            motion.t.push(end);
            if (t[here] - end).abs() <= hair || here == 0 {
                motion.x.push(x[here]);
            } else {
                motion.x.push(cubic((t, x, v), here, end));
                motion.interpolated += 1;
            }
            while next < samples && t[next] <= end + hair {
                next += 1;
            }
        }
        motion
    }
}

/// The cubic through positions and velocities of samples `after - 1` and `after`, at time `at`.
fn cubic((t, x, v): (&[f64], &[f64], &[f64]), after: usize, at: f64) -> f64 {
    let before = after - 1;
    let h = t[after] - t[before];
    let s = (at - t[before]) / h;
    let (rise, r) = (x[after] - x[before], 1.0 - s);
    x[before] + s * rise + s * r * (r * (h * v[before] - rise) - s * (h * v[after] - rise))
}

#[cfg(test)]
mod tests {
    use super::*;
    use stickslip_drive::{Shape, Timing};

    fn triangle(delay: f64, cycles: Option<f64>) -> Waveform {
        let timing = Timing { period: 2.0, delay, phase: 0.0, cycles };
        Waveform::new(Shape::Triangle { stroke: 1.0 }, timing).unwrap()
    }

    #[test]
    fn only_whole_periods_count() {
        let until = |end| Periods::until(&triangle(1.0, Some(3.0)), end).map(|p| (p.start, p.count));
        assert_eq!(until(2.9), None);
        assert_eq!(until(5.0 - 1e-12), Some((1.0, 2)));
        assert_eq!(until(99.0), Some((1.0, 3)));
    }

    #[test]
    fn a_cubic_motion_is_interpolated_exactly_and_samples_are_taken_as_they_are() {
        // x = t³ - 2t has no error in the cubic of positions and velocities.
        let (x, v) = (|t: f64| t.powi(3) - 2.0 * t, |t: f64| 3.0 * t * t - 2.0);
        let t = [0.0, 0.5, 1.0, 1.7, 2.0, 3.5, 4.5, 6.0];
        let periods = Periods { start: 0.0, length: 2.0, count: 3 };
        let motion = periods.motion(&t, &t.map(x), &t.map(v));
        assert_eq!(motion.t, [0.0, 0.5, 1.0, 1.7, 2.0, 3.5, 4.0, 4.5, 6.0]);
        assert_eq!(motion.interpolated, 1);
        for (t, got) in motion.t.iter().zip(&motion.x) {
            assert!((got - x(*t)).abs() < 1e-13, "{t}: {got}");
        }
    }

    #[test]
    fn rounded_ends_are_the_samples_there() {
        let t: Vec<f64> = (0..=30).map(|i| f64::from(i) * 0.1).collect();
        let periods = Periods { start: 0.0, length: 0.3, count: 10 };
        let motion = periods.motion(&t, &t, &vec![f64::NAN; 31]);
        assert_eq!((motion.interpolated, motion.t.len()), (0, 31));
        assert_eq!(motion.x, t);
    }
}
