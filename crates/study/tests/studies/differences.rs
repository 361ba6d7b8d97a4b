//! Sensitivities at random parameter values of ten scenarios, compared with five-point differences of separate runs with other distances
//! and another tolerance. Integrators without event location are not accurate enough for the comparison.

use crate::five_points::{Drawn, chosen, example, moved, slopes};
use crate::prepared;
use std::error::Error;
use stickslip_study::sensitivity::{Asked, Derivative, Sensitivity};

type Checked = Result<(), Box<dyn Error>>;

/// Scenarios with the number of periods or the duration of their runs.
const SCENES: [(&str, &str, &str); 10] = [
    ("p1", "run.cycles", "3"),
    ("quickstart", "run.duration", "30 ms"),
    ("ruby_drive", "run.cycles", "3"),
    ("sine_drive", "run.cycles", "3"),
    ("piezo_stack", "run.cycles", "3"),
    ("driven_stage", "run.cycles", "2"),
    ("three_ball_stage", "run.cycles", "2"),
    ("walking_drive", "run.cycles", "3"),
    ("vibrated_slider", "run.cycles", "3"),
    ("fretting_force", "run.duration", "1 s"),
];
/// Number of random points per scenario, of parameters changed at each point, and of parameters examined.
const POINTS: usize = 2;
const MOVED: usize = 2;
const QUANTITIES: usize = 3;
/// Results of the comparison.
#[derive(Default)]
struct Compared {
    all: usize,
    /// Deviations beyond the reported error plus that of the differences.
    beyond: Vec<String>,
    /// Number of derivatives with two sides.
    split: usize,
    /// Histogram of deviations relative to the reported error: below 0.1, below 1, more.
    shares: [usize; 3],
    /// Reported errors relative to result / parameter.
    errors: Vec<f64>,
}

impl Compared {
    fn take(&mut self, what: &str, found: (f64, f64), wanted: (f64, f64), scale: f64) {
        self.all += 1;
        let off = (found.0 - wanted.0).abs();
        let share = off / (found.1 + wanted.1);
        self.shares[usize::from(share > 0.1) + usize::from(share > 1.0)] += 1;
        self.errors.push(found.1 / scale);
        if share > 1.0 {
            self.beyond.push(format!("{what}: {found:?} instead of {wanted:?}"));
        }
    }

    fn told(&mut self) -> String {
        self.errors.sort_by(f64::total_cmp);
        let at = |share: f64| self.errors[((self.errors.len() - 1) as f64 * share) as usize];
        format!(
            "{} compared, {} split, {:?} below a tenth of both errors, below both, beyond; errors told: middle {:.1e}, nine of ten below {:.1e}, largest {:.1e}",
            self.all,
            self.split,
            self.shares,
            at(0.5),
            at(0.9),
            at(1.0)
        )
    }
}

fn compare() -> Result<Compared, Box<dyn Error>> {
    let mut compared = Compared::default();
    for (seed, (name, key, end)) in SCENES.iter().enumerate() {
        let mut drawn = Drawn(20_261_123 + seed as u64);
        for _ in 0..POINTS {
            let (file, any) = (example(name), Asked::default());
            let set = moved((&file, &any), (key, end), MOVED, &mut drawn)?;
            let to = chosen((&file, &set), &any, QUANTITIES, &mut drawn)?;
            let asked = Sensitivity::new(prepared(&file, &set)?, &Asked { to, ..any }, &())?;
            let taken = asked.take(2, &());
            let names: Vec<String> = asked.figures.iter().map(|figure| figure.name.clone()).collect();
            for (q, quantity) in asked.quantities.iter().enumerate() {
                let known = |f: usize| matches!(taken.derivatives[f][q], Derivative::Known(_));
                compared.split += (0..names.len()).filter(|f| !known(*f)).count();
                if !(0..names.len()).any(known) {
                    continue;
                }
                let wanted = slopes(&file, &set, (&quantity.path, quantity.value), &names)?;
                for (f, wanted) in wanted.into_iter().enumerate() {
                    let Derivative::Known(found) = &taken.derivatives[f][q] else { continue };
                    let what = format!("{name}: {} by {} of {set:?}", names[f], quantity.path);
                    let scale = (asked.figures[f].value / quantity.value).abs();
                    compared.take(&what, (found.value, found.error), wanted, scale);
                }
            }
        }
    }
    Ok(compared)
}

/// At least 200 derivatives, of which 95 % must agree within the reported error and that of the differences.
#[test]
#[ignore = "takes long: .ci/full"]
fn drawn_derivatives_are_those_of_other_differences_within_their_errors() -> Checked {
    let mut compared = compare()?;
    let told = compared.told();
    assert!(compared.all >= 200, "{told}");
    assert!(compared.beyond.len() * 20 <= compared.all, "{told}\n{}", compared.beyond.join("\n"));
    Ok(())
}
