//! Time history of a real-time loop, reduced to a limited number of points.

use crate::room::room;

/// Maximum number of points.
const MOST: u64 = 4000;

/// Reduced time history of a loop. The points are equally spaced over the planned number of frames.
#[derive(Debug, Clone, PartialEq)]
pub struct Film {
    every: u64,
    /// Simulated times of the points, s.
    pub times: Vec<f64>,
    /// Values of the outputs at the points, one series per output.
    pub outputs: Vec<Vec<f64>>,
    /// Values of the inputs at the points, one series per input.
    pub inputs: Vec<Vec<f64>>,
    /// Maximum execution time since the previous point, ns.
    pub execution: Vec<f64>,
    /// Maximum wake-up latency since the previous point, ns.
    pub latency: Vec<f64>,
    worst: (u64, u64),
    /// Number of points of a complete loop.
    points: usize,
}

impl Film {
    /// Creates an empty time history for a number of frames.
    pub fn new(frames: u64, inputs: usize, outputs: usize) -> Self {
        let every = frames.div_ceil(MOST).max(1);
        let points = (frames / every) as usize;
        let series = || room(points);
        Self {
            every,
            times: series(),
            outputs: (0..outputs).map(|_| series()).collect(),
            inputs: (0..inputs).map(|_| series()).collect(),
            execution: series(),
            latency: series(),
            worst: (0, 0),
            points,
        }
    }

    /// Adds the frame with the index `frame`, from 0, that ends at `time`, s. `taken` contains its latency and execution time, ns.
    pub(crate) fn look(
        &mut self,
        frame: u64,
        time: f64,
        taken: (u64, u64),
        (inputs, outputs): (&[f64], &[f64]),
    ) {
        self.worst = (self.worst.0.max(taken.0), self.worst.1.max(taken.1));
        if !(frame + 1).is_multiple_of(self.every) || self.times.len() == self.points {
            return;
        }
        self.times.push(time);
        self.latency.push(self.worst.0 as f64);
        self.execution.push(self.worst.1 as f64);
        self.worst = (0, 0);
        self.inputs.iter_mut().zip(inputs).for_each(|(series, value)| series.push(*value));
        self.outputs.iter_mut().zip(outputs).for_each(|(series, value)| series.push(*value));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_are_even_and_the_longest_time_of_each_stretch_stays() {
        let mut film = Film::new(10_001, 0, 1);
        (0..10_001_u64).for_each(|k| film.look(k, k as f64, (k, 10_001 - k), (&[], &[-(k as f64)])));
        assert_eq!((film.times.len(), film.times[0], film.times[1]), (3333, 2.0, 5.0));
        assert_eq!((film.latency[1], film.execution[1], film.outputs[0][1]), (5.0, 9_998.0, -5.0));
    }
}
