//! Energy balance of a run.

use crate::warning::Warning;
use schemars::JsonSchema;
use serde::Serialize;
use stickslip_drive::{Accuracy, Channel, Stepper};
use stickslip_quantity::Real;
use stickslip_quantity::quantity;

/// Largest error of the energy balance that causes no warning, relative to the throughput.
const OPEN: f64 = 1e-2;
/// Largest error of the energy balance that causes no warning, relative to the product of tolerance and throughput.
const TOLERANCES: f64 = 100.0;
/// Rounding error of the energy balance, relative to the largest energy in it.
const ROUNDING: f64 = 1e-12;

/// Energies at the end of a run, J, and the largest error of the energy balance.
#[derive(Debug, Clone, PartialEq)]
pub struct Books {
    places: [Option<usize>; 6],
    end: [f64; 6],
    /// Friction work of each contact: channel index, and value at the end of the run, J.
    friction: Vec<(usize, f64)>,
    /// Elastic energy at the start of the run, J, above 0 if a contact is pressed.
    elastic_before: Option<f64>,
    throughput: f64,
    /// Largest energy in the balance, J.
    largest: f64,
    worst: f64,
    /// Largest magnitude of the error at events, J. Other rows may have a larger error, because without dense output they are interpolated
    /// linearly.
    worst_at_events: f64,
}

/// Energy balance in the summary.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct Balance {
    /// work done on the model by prescribed motions and strokes, loads, preloads and gravity, at the end of the run
    #[serde(rename = "input_J")]
    input: Real,
    /// kinetic energy of the free bodies at the end of the run
    #[serde(rename = "kinetic_J")]
    kinetic: Real,
    /// energy stored in contacts, springs and stacks at the end of the run
    #[serde(rename = "elastic_J")]
    elastic: Real,
    /// friction work of all contacts during the run
    #[serde(rename = "friction_J")]
    friction: Real,
    /// energy dissipated by dampers and contact damping during the run
    #[serde(rename = "damping_J")]
    damping: Real,
    /// error of the energy balance at the end of the run
    #[serde(rename = "error_J")]
    error: Real,
    /// largest magnitude of the error of the energy balance at any row or event
    #[serde(rename = "largest_error_J")]
    largest_error: Real,
    /// throughput, the reference for the error: largest value during the run of |input|, kinetic energy, |change of
    /// elastic energy| and dissipated energy
    #[serde(rename = "throughput_J")]
    throughput: Real,
    /// largest_error_J divided by throughput_J. Absent if the throughput is only rounding.
    #[serde(skip_serializing_if = "Option::is_none")]
    largest_error_relative: Option<Real>,
}

impl Books {
    /// Creates the energy balance for the channels of a model.
    pub fn new(channels: &[Channel]) -> Self {
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
            largest: 0.0,
            worst: 0.0,
            worst_at_events: 0.0,
        }
    }

    /// Updates the energy balance from a row of all channels.
    pub fn read(&mut self, row: &[f64]) {
        self.end = self.places.map(|place| place.and_then(|p| row.get(p)).copied().unwrap_or(f64::NAN));
        for (place, work) in &mut self.friction {
            *work = row.get(*place).copied().unwrap_or(f64::NAN);
        }
        let [input, kinetic, elastic, friction, damping, error] = self.end;
        let before = *self.elastic_before.get_or_insert(elastic);
        let flows = [input.abs(), kinetic, (elastic - before).abs(), friction + damping];
        self.throughput = flows.into_iter().fold(self.throughput, f64::max);
        self.largest = self.largest.max(elastic.abs()).max(self.throughput);
        // An error that is NaN counts as the largest error.
        if error.is_nan() || error.abs() > self.worst {
            self.worst = error.abs();
        }
    }

    /// Updates the energy balance from the row of an event.
    pub fn read_event(&mut self, row: &[f64]) {
        self.read(row);
        let error = self.end[5].abs();
        if error.is_nan() || error > self.worst_at_events {
            self.worst_at_events = error;
        }
    }

    /// Returns the largest magnitude of the error at events and at the end of the run, J.
    fn worst_at_steps(&self) -> f64 {
        let end = self.end[5].abs();
        if end.is_nan() || end > self.worst_at_events { end } else { self.worst_at_events }
    }

    /// Returns the friction work of contact `c`, J.
    pub fn friction_of(&self, c: usize) -> f64 {
        self.friction.get(c).map_or(0.0, |(_, work)| *work)
    }

    /// Returns the energy balance for the summary.
    pub fn balance(&self) -> Balance {
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
            // The relative error is absent if the throughput is below the rounding error of the stored energy.
            largest_error_relative: (self.throughput > ROUNDING * self.largest)
                .then(|| Real(self.worst / self.throughput)),
        }
    }
}

/// Returns a warning if the error of the energy balance, relative to the throughput, exceeds `OPEN`, or `TOLERANCES` times a tolerance that
/// the user chose.
///
/// Each energy is computed separately: the input from the work of prescribed motions and loads, the others from positions, velocities,
/// memories and integrals. The balance is therefore satisfied only if the time steps are accurate. `finest` is the rounding error of the
/// initial positions, relative to the natural displacement; no smaller tolerance can be met.
pub fn warning(books: &Books, stepper: Stepper, is_asked: bool, finest: f64) -> Option<Warning> {
    let has_dense_output = matches!(stepper, Stepper::Event { .. });
    let missing = if has_dense_output { books.worst } else { books.worst_at_steps() };
    let (through, rounding) = (books.throughput, ROUNDING * books.largest);
    let is_open = |limit: f64| missing.is_nan() || missing > limit.max(rounding);
    let (missed, of) = (quantity(Real(missing), "J"), quantity(Real(through), "J"));
    let warning = |share: String, more: String| {
        let said = format!(
            "the energy balance has an error of {share} of the energy throughput, {missed} of {of}{more}"
        );
        Some(Warning::new("energy_balance", said).help(advice(stepper)))
    };
    let share = missing / through;
    if is_open(OPEN * through) && !share.is_finite() {
        let said = format!("the energy balance does not close: the error is {missed}");
        return Some(Warning::new("energy_balance", said).help(advice(stepper)));
    }
    if is_open(OPEN * through) {
        let share =
            if share < 10.0 { format!("{:.2} %", 100.0 * share) } else { format!("{share:.0e} times") };
        return warning(share, String::new());
    }
    let tolerance = match stepper.accuracy() {
        Accuracy::Tolerance(tolerance) if is_asked => tolerance,
        // If the integrator differs from the requested stepper, the user did not choose the tolerance.
        Accuracy::Tolerance(_) | Accuracy::Step(_) | Accuracy::Frame { .. } => return None,
    };
    let unit = tolerance * through;
    // Without a relative error, the energies are rounding errors.
    if missing <= TOLERANCES * unit || through <= rounding {
        return None;
    }
    let said = warning(
        format!("{share:.1e}"),
        format!(": {:.0} times the tolerance of {tolerance:e}", missing / unit),
    );
    if missing <= rounding {
        let help = format!(
            "rounding of the stored energy, {}, limits the energy balance: a smaller tolerance has no effect",
            quantity(Real(books.largest), "J")
        );
        return said.map(|warning| warning.help(help));
    }
    if finest <= tolerance {
        return said;
    }
    let help = format!(
        "positions of bodies that start far from 0 are rounded to {finest:.0e} u_c, more than the tolerance: \
         a smaller tolerance has no effect; start nearer to 0"
    );
    said.map(|warning| warning.help(help))
}

/// Returns advice for a large error of the energy balance.
fn advice(stepper: Stepper) -> &'static str {
    match stepper {
        Stepper::Event { .. } => "use a smaller tolerance, and compare the results",
        Stepper::Dopri5 { .. } => {
            "its error estimate covers neither kinks nor growth of contacts: use the stepper \"event\""
        }
        Stepper::Frames { .. } => {
            "use a smaller accuracy, which takes more time steps per frame, or the stepper \"event\""
        }
        Stepper::Verlet { .. } | Stepper::Rk4 { .. } => {
            "use a shorter time step, or the stepper \"event\", which controls its error"
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
        assert!(warning(&books, Stepper::Verlet { step: 1e-6 }, true, 0.0).is_some());
    }

    /// Returns the warning for a throughput of 1 J, an elastic energy `stored`, and errors in a row, at an event and at
    /// the end.
    fn said(stepper: Stepper, stored: f64, errors: [f64; 3]) -> Option<String> {
        let names = ["input", "kinetic", "elastic", "friction", "damping", "error"];
        let channels = names.map(|n| Channel { name: format!("energy.{n}_J"), is_state: false });
        let mut books = Books::new(&channels);
        let [row, event, end] = errors.map(|error| [1.0, 0.0, stored, 1.0, 0.0, error]);
        books.read(&row);
        books.read_event(&event);
        books.read(&end);
        warning(&books, stepper, true, 0.0).map(|warning| warning.message)
    }

    #[test]
    fn books_are_open_by_their_throughput_or_by_the_tolerance() {
        let (verlet, event) = (Stepper::Verlet { step: 1e-6 }, Stepper::Event { tolerance: 1e-8 });
        let open = |stepper, error| said(stepper, 0.0, [0.0, 0.0, error]).is_some();
        assert_eq!(
            [0.99e-2, -0.99e-2, 1.01e-2, -1.01e-2].map(|e| open(verlet, e)),
            [false, false, true, true]
        );
        assert_eq!([0.99e-6, 1.01e-6, 2e-2].map(|e| open(event, e)), [false, true, true]);
        let reference = Stepper::Dopri5 { tolerance: 1e-8 };
        assert_eq!([0.99e-6, -1.01e-6].map(|e| open(reference, e)), [false, true]);
        let message = said(event, 0.0, [0.0, 0.0, 2e-5]).unwrap();
        assert!(
            message.ends_with(
                "2.0e-5 of the energy throughput, 20.00 µJ of 1.000 J: 2000 times the tolerance of 1e-8"
            ),
            "{message}"
        );
        // Rounding relative to the stored energy gives no warning without a tolerance, and another advice with one.
        assert!(said(verlet, 1e11, [0.0, 0.0, 0.05]).is_none());
        assert!(
            said(event, 1e11, [0.0, 0.0, 2e-6]).is_some() && said(event, 1e13, [0.0, 0.0, 2e-6]).is_none()
        );
    }

    /// At 1 m from 0, positions have a rounding error of 2.2e-16 m.
    #[test]
    fn a_smaller_tolerance_is_not_advised_where_places_are_rounded() {
        let books = Books { throughput: 1.0, worst: 1e-4, ..Books::new(&[]) };
        let help = |tolerance, finest| {
            warning(&books, Stepper::Event { tolerance }, true, finest).and_then(|said| said.help).unwrap()
        };
        assert!(help(1e-9, 1e-8).contains("rounded to 1e-8 u_c"));
        assert_eq!(help(1e-9, 1e-9), advice(Stepper::Event { tolerance: 1e-9 }));
    }

    #[test]
    fn without_dense_output_only_ends_of_steps_count() {
        let event = Stepper::Event { tolerance: 1e-8 };
        for stepper in
            [Stepper::Verlet { step: 1e-6 }, Stepper::Rk4 { step: 1e-6 }, Stepper::Dopri5 { tolerance: 1e-8 }]
        {
            let open = |errors| said(stepper, 0.0, errors).is_some();
            assert_eq!([[0.1, 0.0, 0.0], [0.0, 0.1, 0.0], [0.0, 0.0, 0.1]].map(open), [false, true, true]);
        }
        assert!(said(event, 0.0, [0.1, 0.0, 0.0]).is_some());
    }
}
