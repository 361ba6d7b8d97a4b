//! Simulated oblique impacts of a ball, from an example scenario with overrides.

use crate::subject::ValidationError;
use crate::table::significant;
use stickslip_drive::scene::Axis;
use stickslip_run::{Job, Watcher};
use stickslip_scenario::Scenario;

/// Example scenario.
const SCENARIO: &str = include_str!("../../../scenarios/measured_impact.json");
/// Radius of the ball, m.
pub(crate) const RADIUS: f64 = 2.5e-3;
/// Coefficient of friction.
pub(crate) const FRICTION: f64 = 0.092;
/// Velocity of approach, m/s, of impacts given by ψ, which does not depend on it.
const APPROACH: f64 = 3.9;
/// Poisson's ratio of both bodies in these impacts.
pub(crate) const NU: f64 = 0.3;

/// Initial state of a ball without spin.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Shot {
    /// Tangential velocity, m/s.
    pub(crate) along: f64,
    /// Velocity of approach, m/s.
    pub(crate) approach: f64,
    /// Whether both bodies have the same material, with Poisson's ratio [`NU`].
    pub(crate) alike: bool,
}

/// State of the ball after the impact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Rebound {
    shot: Shot,
    /// Tangential and normal velocity of its centre, m/s.
    pub(crate) along: f64,
    pub(crate) away: f64,
    /// Angular velocity, rad/s.
    pub(crate) spin: f64,
}

/// Returns G\*/E\* of two bodies of the same material: 2(1-ν)/(2-ν).
pub(crate) fn ratio() -> f64 {
    2.0 * (1.0 - NU) / (2.0 - NU)
}

impl Shot {
    /// Creates an impact of alumina on glass with a velocity, m/s, at an angle to the normal, degrees.
    pub(crate) fn at_angle(speed: f64, degrees: f64) -> Self {
        let (sine, cosine) = math::sin_cos(degrees.to_radians());
        Self { along: speed * sine, approach: speed * cosine, alike: false }
    }

    /// Creates an impact with ψ₁ = (G\*/(E\*μ)) V_x/V_z for two bodies of the same material.
    pub(crate) fn at_psi(psi: f64) -> Self {
        Self { along: psi * FRICTION / ratio() * APPROACH, approach: APPROACH, alike: true }
    }

    /// Creates an impact with V_x/(μV_z) for two bodies of the same material: ψ₁ without the ratio of moduli.
    pub(crate) fn at_slope(slope: f64) -> Self {
        Self::at_psi(slope * ratio())
    }

    /// Returns the overrides of the example.
    pub(crate) fn values(self) -> Vec<(String, String)> {
        let start = |axis: &str, speed: f64| (format!("bodies.ball.start.{axis}"), format!("{speed:?} m/s"));
        let mut values = vec![start("vx", self.along), start("vz", -self.approach)];
        if self.alike {
            values.push(("contacts.foot.materials".to_owned(), "[\"alumina\", \"alumina\"]".to_owned()));
            values.push(("materials.alumina.poisson_ratio".to_owned(), NU.to_string()));
        }
        values
    }

    /// Returns the command line for the same run.
    pub(crate) fn command(self) -> String {
        let short = Self { along: rounded(self.along), approach: rounded(self.approach), ..self };
        let mut command = "stickslip run scenarios/measured_impact.json".to_owned();
        for (path, value) in short.values() {
            command += &format!(" \\\n    --set '{path}={value}'");
        }
        command
    }

    /// Runs the impact.
    ///
    /// # Errors
    /// Fails if the scenario is invalid or the run stops early.
    pub(crate) fn rebound(self, watcher: &dyn Watcher) -> Result<Rebound, ValidationError> {
        let mut values = self.values();
        // Only the first and last row are written.
        values.push(("output.every".to_owned(), "30 us".to_owned()));
        values.push(("plots".to_owned(), "[]".to_owned()));
        let values: Vec<(&str, &str)> =
            values.iter().map(|(path, value)| (path.as_str(), value.as_str())).collect();
        let scenario = Scenario::from_str_with(SCENARIO, "measured_impact.json", "", &values)?;
        let job = Job::new(scenario, "measured_impact".to_owned(), "".into())?;
        let outcome = job.run(&Still(watcher));
        if let Some(error) = outcome.error {
            return Err(error.into());
        }
        let rate = |axis| outcome.state.coordinate(&job.model, 0, axis).map(|(_, rate)| rate);
        match (rate(Axis::X), rate(Axis::Z), rate(Axis::Pitch)) {
            (Some(along), Some(away), Some(spin)) => Ok(Rebound { shot: self, along, away, spin }),
            _ => Err(ValidationError::NoBall),
        }
    }
}

/// Rounds to the digits of a command line.
fn rounded(speed: f64) -> f64 {
    significant(speed, 7).parse().unwrap_or(speed)
}

impl Rebound {
    /// Returns the tangential restitution: the tangential velocity of the centre after the impact divided by that before.
    pub(crate) fn restitution(&self) -> f64 {
        self.along / self.shot.along
    }

    /// Returns the rebound angle of the centre to the normal, degrees.
    pub(crate) fn angle(&self) -> f64 {
        math::atan2(self.along, self.away).to_degrees()
    }

    /// Returns ψ₂ = (G\*/(E\*μ)) V_x/V_z at the point of contact, with V_z before the impact.
    pub(crate) fn psi(&self) -> f64 {
        ratio() / FRICTION * (self.along + RADIUS * self.spin) / self.shot.approach
    }

    /// Returns V_x/(μV_z) at the point of contact, with V_z before the impact.
    pub(crate) fn slope(&self) -> f64 {
        self.psi() / ratio()
    }

    /// Returns the scaled spin ωR/(μV_z).
    pub(crate) fn scaled_spin(&self) -> f64 {
        RADIUS * self.spin / (FRICTION * self.shot.approach)
    }
}

/// Watcher without progress, because the progress bar counts pages.
struct Still<'a>(&'a dyn Watcher);

impl Watcher for Still<'_> {
    fn reached(&self, _: f64) {}

    fn goes_on(&self) -> bool {
        self.0.goes_on()
    }
}
