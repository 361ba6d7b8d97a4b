//! Numbers of a study file: in SI, or texts with a unit.

use super::Variation;
use super::form::{Amount, Normal, VariationForm};
use crate::fault::Fault;
use crate::form::Count;
use crate::path::{KeyPath, Step};
use crate::quantity::quantity;

/// Maximum number of values of a grid or a list.
const MOST_VALUES: u64 = 1 << 20;

/// Reader of the numbers of a variation: path of the variation, and SI unit of the numbers.
pub(super) struct Numbers {
    pub(super) place: KeyPath,
    pub(super) unit: &'static str,
}

impl Numbers {
    /// Returns a variation with its numbers in SI.
    pub(super) fn variation(&self, form: &VariationForm) -> Result<Variation, Fault> {
        let [mut a, mut b, mut c] = [0.0; 3];
        let mut read = |kind: &str, amounts: &[&Amount]| -> Result<(), Fault> {
            for (place, (number, amount)) in [&mut a, &mut b, &mut c].into_iter().zip(amounts).enumerate() {
                *number = self.si(kind, place, amount)?;
            }
            Ok(())
        };
        Ok(match form {
            VariationForm::Grid((low, high, count)) => {
                read("grid", &[low, high])?;
                self.spaced("grid", [a, b], count, |low, high, share| low + (high - low) * share)?
            }
            VariationForm::Log((low, high, count)) => {
                read("log", &[low, high])?;
                if !(a > 0.0 && b > 0.0) {
                    let message = "equal ratios need a first and a last value above 0";
                    return Err(Fault::new(self.inside("log", usize::from(a > 0.0)), message));
                }
                let of = |low, high, share| low * math::exp(math::ln(high / low) * share);
                self.spaced("log", [a, b], count, of)?
            }
            VariationForm::List(values) if values.is_empty() => {
                return Err(Fault::new(self.place.clone(), "expected at least one value"));
            }
            VariationForm::List(values) => {
                let values = values.iter().enumerate().map(|(place, value)| self.si("list", place, value));
                Variation::Values(values.collect::<Result<_, _>>()?)
            }
            VariationForm::Uniform([low, high]) => {
                read("uniform", &[low, high])?;
                Variation::Uniform([a, b])
            }
            VariationForm::Normal(Normal(all)) => {
                read("normal", &all.iter().take(2).collect::<Vec<_>>())?;
                let bound =
                    |place: usize| all.get(place).map(|bound| self.si("normal", place, bound)).transpose();
                Variation::Normal([a, b], bound(2)?.zip(bound(3)?).map(|(low, high)| [low, high]))
            }
            VariationForm::Lognormal((median, deviation)) => {
                read("lognormal", &[median])?;
                Variation::Lognormal([a, *deviation])
            }
            VariationForm::Triangular([low, mode, high]) => {
                read("triangular", &[low, mode, high])?;
                Variation::Triangular([a, b, c])
            }
        })
    }

    /// Returns the path of an entry in the list of a variation.
    pub(super) fn inside(&self, kind: &str, place: usize) -> KeyPath {
        let mut path = self.place.clone();
        path.0.extend([Step::Key(kind.to_owned()), Step::Index(place)]);
        path
    }

    /// Returns a number in SI.
    pub(super) fn si(&self, kind: &str, place: usize, amount: &Amount) -> Result<f64, Fault> {
        let text = match amount {
            Amount::Number(number) => return Ok(*number),
            Amount::Text(text) => text,
        };
        quantity(text, self.unit).map_err(|message| {
            let mut lines = message.splitn(2, "\n   help: ").map(str::to_owned);
            Fault::new(self.inside(kind, place), lines.next().unwrap_or_default()).maybe_help(lines.next())
        })
    }

    /// Returns `count` values from the first to the last; both ends are exact.
    fn spaced(
        &self,
        kind: &str,
        [low, high]: [f64; 2],
        Count(count): &Count,
        of: impl Fn(f64, f64, f64) -> f64,
    ) -> Result<Variation, Fault> {
        if !(1..=MOST_VALUES).contains(count) {
            let wanted = format!("a number of values from 1 to {MOST_VALUES}");
            return Err(Fault::expected(self.inside(kind, 2), wanted));
        }
        if *count > 1 && low >= high {
            let message = format!("the first value must be below the last, got {low} and {high}");
            return Err(Fault::new(self.inside(kind, 1), message));
        }
        let last = count - 1;
        let value = |k: u64| match k {
            0 => low,
            k if k == last => high,
            k => of(low, high, k as f64 / last as f64),
        };
        Ok(Variation::Values((0..*count).map(value).collect()))
    }
}
