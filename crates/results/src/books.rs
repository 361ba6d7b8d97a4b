//! The energy books of a run.

use crate::real::Real;
use serde::Serialize;
use stickslip_drive::Channel;

/// Energies at the end, J, and how well they balanced all the way.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Books {
    places: [Option<usize>; 6],
    end: [f64; 6],
    /// Places of the contacts' friction work, and the work at the end, J.
    friction: Vec<(usize, f64)>,
    /// Elastic energy at the start, J: a pressed contact has it before anything moves.
    elastic_before: Option<f64>,
    throughput: f64,
    worst: f64,
}

/// The books as the summary shows them.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(crate) struct Balance {
    /// Work of followers, loads and gravity since the start.
    #[serde(rename = "input_J")]
    input: Real,
    #[serde(rename = "kinetic_J")]
    kinetic: Real,
    #[serde(rename = "elastic_J")]
    elastic: Real,
    #[serde(rename = "friction_J")]
    friction: Real,
    #[serde(rename = "damping_J")]
    damping: Real,
    #[serde(rename = "error_J")]
    error: Real,
    /// Largest magnitude of the error.
    #[serde(rename = "largest_error_J")]
    largest_error: Real,
    /// Largest of |input|, kinetic energy, change of elastic energy and heat at any time.
    #[serde(rename = "throughput_J")]
    throughput: Real,
    /// Largest error over throughput; none where nothing moved.
    #[serde(skip_serializing_if = "Option::is_none")]
    largest_error_relative: Option<Real>,
}

impl Books {
    /// Books of a model's channels.
    pub(crate) fn new(channels: &[Channel]) -> Self {
        let names = ["input", "kinetic", "elastic", "friction", "damping", "error"];
        let place = |name| channels.iter().position(|c| c.name == format!("energy.{name}_J"));
        let friction = channels.iter().enumerate().filter(|(_, c)| c.name.ends_with(".friction_J"));
        let friction = friction.filter(|(_, c)| c.name != "energy.friction_J").map(|(place, _)| (place, 0.0));
        Self {
            places: names.map(place),
            end: [0.0; 6],
            friction: friction.collect(),
            elastic_before: None,
            throughput: 0.0,
            worst: 0.0,
        }
    }

    /// Reads a row of all channels.
    pub(crate) fn read(&mut self, row: &[f64]) {
        self.end = self.places.map(|place| place.and_then(|p| row.get(p)).copied().unwrap_or(f64::NAN));
        for (place, work) in &mut self.friction {
            *work = row.get(*place).copied().unwrap_or(f64::NAN);
        }
        let [input, kinetic, elastic, friction, damping, error] = self.end;
        let before = *self.elastic_before.get_or_insert(elastic);
        let flows = [input.abs(), kinetic, (elastic - before).abs(), friction + damping];
        self.throughput = flows.into_iter().fold(self.throughput, f64::max);
        // A NaN must not pass for a small error.
        if error.is_nan() || error.abs() > self.worst {
            self.worst = error.abs();
        }
    }

    /// Friction work of contact `c`, J.
    pub(crate) fn friction_of(&self, c: usize) -> f64 {
        self.friction.get(c).map_or(0.0, |(_, work)| *work)
    }

    /// As the summary shows them.
    pub(crate) fn balance(&self) -> Balance {
        let [input, kinetic, elastic, friction, damping, error] = self.end.map(Real);
        Balance {
            input,
            kinetic,
            elastic,
            friction,
            damping,
            error,
            largest_error: Real(self.worst),
            throughput: Real(self.throughput),
            largest_error_relative: (self.throughput > 0.0).then(|| Real(self.worst / self.throughput)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_largest_error_is_measured_by_the_throughput() {
        let names = ["input", "kinetic", "elastic", "friction", "damping", "error"];
        let channels = names.map(|n| Channel { name: format!("energy.{n}_J"), is_state: false });
        let mut books = Books::new(&channels);
        books.read(&[0.0, 0.0, 7.0, 0.0, 0.0, 0.0]);
        books.read(&[4.0, 1.0, 8.0, 2.0, 0.0, -2e-9]);
        books.read(&[1.0, 0.0, 7.0, 1.0, 0.0, 0.0]);
        let balance = books.balance();
        assert_eq!((balance.throughput, balance.largest_error), (Real(4.0), Real(2e-9)));
        assert_eq!(balance.largest_error_relative, Some(Real(5e-10)));
        books.read(&[f64::NAN; 6]);
        assert!(books.balance().largest_error.0.is_nan());
    }
}
