//! Natural scales of a model, read from the summaries of its runs.

use serde_json::Value;
use stickslip_quantity::names::{owner, unit};

/// Natural scales of each contact and of the whole model.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Scales {
    contacts: Vec<(String, Scale)>,
    /// Smallest natural scales of all contacts.
    scene: Scale,
    /// Larger energy throughput of the two runs, J.
    throughput: f64,
    /// Largest step length of the two runs, m.
    step: f64,
}

/// Natural scales of displacement u_c, force μF_N, velocity u_c ω and work μF_N u_c, in SI units.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
struct Scale {
    displacement: f64,
    force: f64,
    velocity: f64,
    work: f64,
}

impl Scales {
    /// Returns the larger throughput and step length of two runs. The natural scales of contacts are taken from run `a`.
    pub(super) fn new(a: &Value, b: &Value) -> Self {
        let mut scales = Self::default();
        for summary in [a, b] {
            let throughput = summary.pointer("/energy/throughput_J").and_then(Value::as_f64);
            let steps = summary.pointer("/steps/lengths_m").and_then(Value::as_array).into_iter().flatten();
            scales.throughput = scales.throughput.max(throughput.unwrap_or(0.0));
            let longest = summary.pointer("/steps/longest_m").into_iter();
            let steps = steps.chain(longest).filter_map(Value::as_f64);
            scales.step = steps.fold(scales.step, |most, step| most.max(step.abs()));
            for (name, contact) in summary.get("contacts").and_then(Value::as_object).into_iter().flatten() {
                let scale = Scale::of(contact);
                if !scales.contacts.iter().any(|(known, _)| known == name) {
                    scales.contacts.push((name.clone(), scale));
                }
            }
        }
        // A contact without friction has no natural scale.
        let least = |x: f64, y: f64| if x > 0.0 && y > 0.0 { x.min(y) } else { x.max(y) };
        let all = scales.contacts.iter().map(|(_, scale)| *scale);
        scales.scene = all.fold(Scale::default(), |smallest, scale| smallest.with(scale, least));
        scales
    }

    /// Returns the natural scale of a channel or summary value, in its unit. Returns 0 without a natural scale.
    pub(super) fn natural(&self, name: &str) -> f64 {
        let own = self.contacts.iter().find(|(contact, _)| contact == owner(name));
        let scale = own.map_or(self.scene, |(_, scale)| *scale);
        match unit(name) {
            "m" => scale.displacement,
            "N" => scale.force,
            "m/s" => scale.velocity,
            "J" => scale.work,
            _ => 0.0,
        }
    }

    /// Returns the reference value for the relative tolerance of a channel or summary value.
    ///
    /// The reference value is the `largest` magnitude. For small differences of larger numbers, such as energy errors, the reference value
    /// is the scale of the larger numbers.
    pub(super) fn nominal(&self, name: &str, largest: f64) -> f64 {
        match (owner(name), unit(name)) {
            ("energy", "J") if name.ends_with("error_J") => self.throughput,
            ("steps", "m") => largest.max(self.step),
            (_, "") => largest.max(1.0),
            _ => largest,
        }
    }
}

impl Scale {
    fn of(contact: &Value) -> Self {
        let number = |key| contact.pointer(key).and_then(Value::as_f64).unwrap_or(0.0);
        let (displacement, force) = (number("/scales/displacement_m"), number("/scales/force_N"));
        Self { displacement, force, velocity: number("/scales/velocity_m_s"), work: displacement * force }
    }

    fn with(self, other: Self, of: impl Fn(f64, f64) -> f64) -> Self {
        Self {
            displacement: of(self.displacement, other.displacement),
            force: of(self.force, other.force),
            velocity: of(self.velocity, other.velocity),
            work: of(self.work, other.work),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn every_name_finds_its_scale() {
        let contact =
            |u: f64, f: f64| json!({ "scales": { "displacement_m": u, "force_N": f, "velocity_m_s": 1e-3 } });
        let a = json!({
            "contacts": { "ball": contact(2e-8, 0.5), "pin": contact(4e-8, 0.0) },
            "steps": { "lengths_m": [1e-7, -3e-7] }, "energy": { "throughput_J": 5e-6 },
        });
        let scales = Scales::new(&a, &json!({}));
        assert_eq!((scales.natural("ball.u_m"), scales.natural("pin.u_m")), (2e-8, 4e-8));
        assert_eq!((scales.natural("slider.x_m"), scales.natural("energy.input_J")), (2e-8, 1e-8));
        assert_eq!((scales.natural("slider.vx_m_s"), scales.natural("pin.fx_N")), (1e-3, 0.0));
        assert_eq!(scales.natural("contacts.ball.peak_fx_N"), 0.5);
        assert_eq!(scales.nominal("energy.error_J", 1e-20), 5e-6);
        assert_eq!(scales.nominal("steps.steady.repeatability_m", 1e-20), 3e-7);
        assert_eq!(scales.nominal("steps.steady.back_step", 0.02), 1.0);
        assert_eq!(scales.nominal("ball.fx_N", 0.3), 0.3);
    }
}
