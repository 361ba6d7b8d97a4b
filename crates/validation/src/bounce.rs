//! Oblique impacts of a ball, run as a user runs them: an example and values to put into it.

use crate::subject::ValidationError;
use crate::table::significant;
use stickslip_drive::scene::Axis;
use stickslip_run::{Job, Watcher};
use stickslip_scenario::Scenario;

/// The example.
const SCENARIO: &str = include_str!("../../../scenarios/measured_impact.json");
/// Radius of its ball, m.
pub(crate) const RADIUS: f64 = 2.5e-3;
/// Its coefficient of friction.
pub(crate) const FRICTION: f64 = 0.092;
/// Speed of approach of impacts that are told in ψ, which does not depend on it, m/s.
const APPROACH: f64 = 3.9;
/// Poisson's ratio of the two equal bodies of these.
pub(crate) const NU: f64 = 0.3;

/// A ball before it touches, not turning.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Shot {
    /// Speed along the surface, m/s.
    pub(crate) along: f64,
    /// Speed towards it, m/s.
    pub(crate) approach: f64,
    /// Whether both bodies are of one material of Poisson's ratio [`NU`].
    pub(crate) alike: bool,
}

/// How it comes back.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Rebound {
    shot: Shot,
    /// Of its centre, m/s.
    pub(crate) along: f64,
    pub(crate) away: f64,
    /// Angular velocity, rad/s.
    pub(crate) spin: f64,
}

/// G\*/E\* of two bodies of one material: 2(1-ν)/(2-ν).
pub(crate) fn ratio() -> f64 {
    2.0 * (1.0 - NU) / (2.0 - NU)
}

impl Shot {
    /// At a speed, m/s, and an angle to the normal, degrees; alumina on glass.
    pub(crate) fn at_angle(speed: f64, degrees: f64) -> Self {
        let (sine, cosine) = math::sin_cos(degrees.to_radians());
        Self { along: speed * sine, approach: speed * cosine, alike: false }
    }

    /// With ψ₁ = (G\*/(E\*μ)) V_x/V_z, two bodies of one material.
    pub(crate) fn at_psi(psi: f64) -> Self {
        Self { along: psi * FRICTION / ratio() * APPROACH, approach: APPROACH, alike: true }
    }

    /// With V_x/(μV_z), two bodies of one material: ψ₁ without its ratio of moduli.
    pub(crate) fn at_slope(slope: f64) -> Self {
        Self::at_psi(slope * ratio())
    }

    /// What is put into the example.
    pub(crate) fn values(self) -> Vec<(String, String)> {
        let start = |axis: &str, speed: f64| (format!("bodies.ball.start.{axis}"), format!("{speed:?} m/s"));
        let mut values = vec![start("vx", self.along), start("vz", -self.approach)];
        if self.alike {
            values.push(("contacts.foot.materials".to_owned(), "[\"alumina\", \"alumina\"]".to_owned()));
            values.push(("materials.alumina.poisson_ratio".to_owned(), NU.to_string()));
        }
        values
    }

    /// The command of a user for the same run.
    pub(crate) fn command(self) -> String {
        let short = Self { along: rounded(self.along), approach: rounded(self.approach), ..self };
        let mut command = "stickslip run scenarios/measured_impact.json".to_owned();
        for (path, value) in short.values() {
            command += &format!(" \\\n    --set '{path}={value}'");
        }
        command
    }

    /// Runs it.
    pub(crate) fn rebound(self, watcher: &dyn Watcher) -> Result<Rebound, ValidationError> {
        let mut values = self.values();
        // No rows but the first and the last: none is looked at.
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

/// To the digits of a command line.
fn rounded(speed: f64) -> f64 {
    significant(speed, 7).parse().unwrap_or(speed)
}

impl Rebound {
    /// Tangential restitution: the speed of the centre along the surface, after over before.
    pub(crate) fn restitution(&self) -> f64 {
        self.along / self.shot.along
    }

    /// Angle of the way of the centre to the normal, degrees.
    pub(crate) fn angle(&self) -> f64 {
        math::atan2(self.along, self.away).to_degrees()
    }

    /// ψ₂ = (G\*/(E\*μ)) V_x/V_z at the point of contact, V_z that of the approach.
    pub(crate) fn psi(&self) -> f64 {
        ratio() / FRICTION * (self.along + RADIUS * self.spin) / self.shot.approach
    }

    /// V_x/(μV_z) at the point of contact, V_z that of the approach.
    pub(crate) fn slope(&self) -> f64 {
        self.psi() / ratio()
    }

    /// ωR/(μV_z).
    pub(crate) fn scaled_spin(&self) -> f64 {
        RADIUS * self.spin / (FRICTION * self.shot.approach)
    }
}

/// A watcher whose progress is that of pages, not of runs.
struct Still<'a>(&'a dyn Watcher);

impl Watcher for Still<'_> {
    fn reached(&self, _: f64) {}

    fn goes_on(&self) -> bool {
        self.0.goes_on()
    }
}
