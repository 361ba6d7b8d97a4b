//! Scale of an axis: unit prefix, offset and ticks.

use crate::panel::Axis;
use crate::{Label, PlotError};
use stickslip_quantity::{Prefix, takes_prefix};

/// Scale of an axis.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Scale {
    /// Offset subtracted from the values, in the unit of the axis; not 0 if the values differ only in their last digits.
    offset: f64,
    /// Ends of the axis, from which the offset is subtracted.
    low: f64,
    high: f64,
    /// Whether the axis has ticks.
    numbered: bool,
    /// Ends in the displayed unit; `None` for an empty axis.
    shown: Option<(f64, f64)>,
    /// Whether the axis is logarithmic; the ends are then exponents of ten.
    decades: bool,
    /// Whether all values are 0; the ends are then arbitrary.
    is_nothing: bool,
    /// Positions (0 to 1) and numbers of the ticks.
    pub(crate) ticks: Vec<(f64, String)>,
    /// Name of the quantity.
    pub(crate) label: Label,
    /// Offset and unit, which follow the label.
    pub(crate) unit: Label,
}

/// Room for tick labels along an axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Along {
    /// Horizontal axis, labels side by side: its width, px.
    Width(f64),
    /// Vertical axis, labels below each other: its height, px.
    Height(f64),
}

/// Maximum number of ticks.
const MOST_TICKS: usize = 9;
/// Ranges narrower than this fraction of their distance from zero get an offset.
const OFFSET_BELOW: f64 = 5e-4;

impl Scale {
    /// Creates the scale of a range, without ticks; `None` gives an empty axis.
    pub(crate) fn new(axis: &Axis, range: Option<(f64, f64)>) -> Self {
        let (label, numbered) = (axis.label.clone(), !axis.unnumbered);
        let Some((from, to)) = range else {
            let unit = unit_text(&label, "", &axis.unit);
            let (offset, low, high, ticks) = (0.0, 0.0, 1.0, Vec::new());
            return Self {
                offset,
                low,
                high,
                numbered,
                shown: None,
                decades: false,
                is_nothing: false,
                ticks,
                label,
                unit,
            };
        };
        if axis.logarithmic {
            let unit = unit_text(&label, "", &axis.unit);
            let (low, high, ticks) = (from, to, Vec::new());
            return Self {
                offset: 0.0,
                low,
                high,
                numbered,
                shown: range,
                decades: true,
                is_nothing: false,
                ticks,
                label,
                unit,
            };
        }
        let offset = offset(from, to);
        let (low, high) = (from - offset, to - offset);
        let multiple = Multiple::of(low.abs().max(high.abs()), &axis.unit);
        let less = match offset {
            0.0 => String::new(),
            _ if offset < 0.0 => format!(" + {}", offset_text(-offset, high - low, &axis.unit)),
            _ => format!(" − {}", offset_text(offset, high - low, &axis.unit)),
        };
        let unit = unit_text(&label, &less, &multiple.unit);
        let shown = Some((multiple.apply(low), multiple.apply(high)));
        let (decades, is_nothing, ticks) = (false, false, Vec::new());
        Self { offset, low, high, numbered, shown, decades, is_nothing, ticks, label, unit }
    }

    /// Marks the scale as a scale of values that are all 0, whose only tick is 0.
    pub(crate) fn of_nothing(self, is_nothing: bool) -> Self {
        Self { is_nothing, ..self }
    }

    /// Returns whether all values are 0, so that the ends are arbitrary.
    pub(crate) fn is_of_nothing(&self) -> bool {
        self.is_nothing
    }

    /// Sets as many ticks as fit at a font size of `em` px.
    pub(crate) fn set_ticks(&mut self, along: Along, em: f64) -> Result<(), PlotError> {
        let ticks = if self.decades { decades } else { ticks };
        let shown = self.shown.filter(|_| self.numbered);
        self.ticks = match shown {
            Some(_) if self.is_nothing => vec![(self.place(0.0), "0".to_owned())],
            shown => shown.map_or(Ok(Vec::new()), |shown| ticks(shown, along, em))?,
        };
        Ok(())
    }

    /// Returns the position of an axis coordinate along the axis, 0 to 1.
    pub(crate) fn place(&self, value: f64) -> f64 {
        (value - self.offset - self.low) / (self.high - self.low)
    }

    /// Returns the axis coordinates of both ends; `None` for an empty axis.
    pub(crate) fn range(&self) -> Option<(f64, f64)> {
        self.shown.map(|_| (self.offset + self.low, self.offset + self.high))
    }

    /// Returns the axis coordinate of the upper end.
    pub(crate) fn end(&self) -> f64 {
        self.offset + self.high
    }

    /// Returns the width of the widest tick label, px.
    pub(crate) fn label_width(&self, em: f64) -> Result<f64, PlotError> {
        self.ticks.iter().try_fold(0.0, |most: f64, (_, text)| Ok(most.max(Label::plain(text).width(em)?)))
    }

    /// Returns the lengths by which the tick labels extend beyond the start and the end of a horizontal axis, px.
    pub(crate) fn overhang(&self, width: f64, em: f64) -> Result<(f64, f64), PlotError> {
        self.ticks.iter().try_fold((0.0_f64, 0.0_f64), |(left, right), (place, text)| {
            let half = Label::plain(text).width(em)? / 2.0;
            Ok((left.max(half - place * width), right.max(half - (1.0 - place) * width)))
        })
    }
}

/// Unit with its prefix or power of ten.
struct Multiple {
    exponent: i32,
    unit: String,
}

impl Multiple {
    fn of(magnitude: f64, unit: &str) -> Self {
        let prefix = Prefix::of_quantity(magnitude, unit);
        if prefix != Prefix::NONE || (0.0099..10_000.0).contains(&magnitude) || magnitude <= 0.0 {
            return Self { exponent: prefix.exponent, unit: format!("{}{}", prefix.symbol, unit) };
        }
        if takes_prefix(unit) && (1.0..1000.0).contains(&magnitude) {
            return Self { exponent: 0, unit: unit.to_owned() };
        }
        let exponent = 3 * (math::log10(magnitude) / 3.0).floor() as i32;
        let gap = if unit.is_empty() { "" } else { " " };
        Self { exponent, unit: format!("10{}{gap}{unit}", superscript(exponent)) }
    }

    fn apply(&self, value: f64) -> f64 {
        // In two steps, as 10³⁰⁶ would exceed the range of the result.
        let half = self.exponent / 2;
        value / 10_f64.powi(half) / 10_f64.powi(self.exponent - half)
    }
}

/// Returns a round number near a range that is far from zero; 0 for other ranges.
fn offset(from: f64, to: f64) -> f64 {
    let span = to - from;
    if span >= OFFSET_BELOW * from.abs().max(to.abs()) {
        return 0.0;
    }
    let grain = 10_f64.powi(math::log10(span).ceil() as i32);
    let offset = ((from + span / 2.0) / grain).round() * grain;
    if offset.is_finite() { offset } else { 0.0 }
}

/// Formats the offset in its own prefix, with the digits that the span requires.
fn offset_text(offset: f64, span: f64, unit: &str) -> String {
    let multiple = Multiple::of(offset, unit);
    let grain = math::log10(span).ceil() as i32;
    let decimals = usize::try_from(multiple.exponent - grain).unwrap_or(0).min(17);
    let text = format!("{:.decimals$}", multiple.apply(offset));
    let text = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    if multiple.unit.is_empty() { text.to_owned() } else { format!("{text} {}", multiple.unit) }
}

/// Formats a value with its own prefix and a number of significant digits, such as "12.5 ms".
pub(crate) fn quantity(value: f64, unit: &str, digits: usize) -> String {
    if !value.is_finite() {
        return format!("{value} {unit}");
    }
    let multiple = Multiple::of(value.abs(), unit);
    let shown = multiple.apply(value);
    let whole = if shown == 0.0 { 1 } else { math::log10(shown.abs()).floor() as i32 + 1 };
    let decimals = usize::try_from(digits as i32 - whole).unwrap_or(0).min(17);
    let text = number(shown, decimals);
    let text = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    if multiple.unit.is_empty() { text.to_owned() } else { format!("{text} {}", multiple.unit) }
}

/// Returns the text after a label: offset, and unit in brackets.
fn unit_text(label: &Label, offset: &str, unit: &str) -> Label {
    let bare = label.is_empty() && offset.is_empty();
    let unit = if unit.is_empty() || bare { unit.to_owned() } else { format!(" ({unit})") };
    // Not a plain label, which would drop the leading blank.
    Label::default().followed_by(offset).followed_by(&unit)
}

/// Returns the finest ticks at 1, 2 or 5 times a power of ten whose labels do not overlap.
fn ticks((low, high): (f64, f64), along: Along, em: f64) -> Result<Vec<(f64, String)>, PlotError> {
    let span = high - low;
    if !(span > 0.0 && span.is_finite()) {
        return Ok(Vec::new());
    }
    let decade = math::log10(span).floor() as i32 - 1;
    let steps = (decade..decade + 3).flat_map(|k| [(1.0, k), (2.0, k), (5.0, k)]);
    let mut best = Vec::new();
    for (digit, exponent) in steps {
        let step = digit * 10_f64.powi(exponent);
        if span / step > MOST_TICKS as f64 {
            continue;
        }
        let decimals = usize::try_from(-exponent).unwrap_or(0);
        let (first, last) = ((low / step - 1e-9).ceil(), (high / step + 1e-9).floor());
        let count = (last - first + 1.0).max(0.0) as usize;
        let candidate: Vec<(f64, String)> = (0..count.min(MOST_TICKS + 1))
            .map(|i| (first + i as f64) * step)
            .map(|value| (((value - low) / span).clamp(0.0, 1.0), number(value, decimals)))
            .collect();
        if best.is_empty() || candidate.len() >= 2 {
            best = candidate;
        }
        if keep_apart(&best, along, em)? {
            break;
        }
    }
    Ok(best)
}

/// Returns ticks at powers of ten whose labels do not overlap. A range with fewer than two powers also has ticks at their 2- and 5-fold.
fn decades((low, high): (f64, f64), along: Along, em: f64) -> Result<Vec<(f64, String)>, PlotError> {
    let span = high - low;
    if !(span > 0.0 && span.is_finite()) {
        return Ok(Vec::new());
    }
    let at = |value: f64| ((value - low) / span).clamp(0.0, 1.0);
    let (first, last) = ((low - 1e-9).ceil() as i32, (high + 1e-9).floor() as i32);
    if last <= first {
        let one = |k: i32| [1, 2, 5].map(|digit| (math::log10(f64::from(digit)) + f64::from(k), digit, k));
        let all = (first - 1..=last).flat_map(one).filter(|(value, ..)| (low..=high).contains(value));
        let text = |digit: i32, k: i32| match digit {
            1 => format!("10{}", superscript(k)),
            _ => format!("{digit}·10{}", superscript(k)),
        };
        return Ok(all.map(|(value, digit, k)| (at(value), text(digit, k))).collect());
    }
    for stride in [1, 2, 3, 5, 10, 20, 50, 100] {
        let powers = (first..=last).filter(|k| k.rem_euclid(stride) == 0);
        let ticks: Vec<(f64, String)> =
            powers.map(|k| (at(f64::from(k)), format!("10{}", superscript(k)))).collect();
        if ticks.len() <= 2 * MOST_TICKS && keep_apart(&ticks, along, em)? {
            return Ok(ticks);
        }
    }
    Ok(Vec::new())
}

fn keep_apart(ticks: &[(f64, String)], along: Along, em: f64) -> Result<bool, PlotError> {
    for pair in ticks.windows(2) {
        let way = pair[1].0 - pair[0].0;
        let apart = match along {
            Along::Height(height) => way * height >= 2.0 * em,
            Along::Width(width) => {
                let widths = Label::plain(&pair[0].1).width(em)? + Label::plain(&pair[1].1).width(em)?;
                way * width >= widths / 2.0 + 0.9 * em
            }
        };
        if !apart {
            return Ok(false);
        }
    }
    Ok(true)
}

/// Formats a number with a minus sign instead of a hyphen.
fn number(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    let zero = text.chars().all(|c| matches!(c, '-' | '0' | '.'));
    text.replace('-', if zero { "" } else { "−" })
}

fn superscript(exponent: i32) -> String {
    const DIGITS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let digit = |c: char| c.to_digit(10).map_or('⁻', |d| DIGITS[d as usize]);
    exponent.to_string().chars().map(digit).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scale(unit: &str, low: f64, high: f64) -> (Vec<String>, String) {
        let axis = Axis::new(Label::plain("u"), unit);
        let mut scale = Scale::new(&axis, Some((low, high)));
        scale.set_ticks(Along::Width(600.0), 30.0).unwrap();
        (scale.ticks.into_iter().map(|(_, text)| text).collect(), scale.label.joined(&scale.unit).text())
    }

    #[test]
    fn ticks_are_round_numbers_in_readable_units() {
        assert_eq!(
            scale("m", -4.2e-8, 4.2e-8),
            (["−40", "−20", "0", "20", "40"].map(String::from).to_vec(), "u (nm)".into())
        );
        let (ticks, label) = scale("m", 0.0, 1.3e-6);
        assert_eq!((ticks[0].as_str(), ticks[1].as_str(), label.as_str()), ("0.0", "0.2", "u (µm)"));
        assert_eq!(scale("", -1.1, 1.1).0, ["−1.0", "−0.5", "0.0", "0.5", "1.0"]);
        assert_eq!(scale("", 0.0, 3e7).1, "u (10⁶)");
        assert_eq!(scale("1/m²", 0.0, 2e-8).1, "u (10⁻⁹ 1/m²)");
    }

    #[test]
    fn a_far_range_shows_what_differs() {
        let (ticks, label) = scale("m", 0.001_234_500_0, 0.001_234_500_9);
        assert_eq!(label, "u − 1.2345 mm (pm)");
        assert_eq!(ticks.first().map(String::as_str), Some("0"));
        let (_, label) = scale("m", -1.0 - 1e-9, -1.0 + 1e-9);
        assert_eq!(label, "u + 1 m (nm)");
    }

    #[test]
    fn decades_are_told_by_their_powers() {
        let decades = |low: f64, high: f64, width: f64| {
            let axis = Axis { logarithmic: true, ..Axis::new(Label::plain("error"), "m") };
            let mut scale = Scale::new(&axis, Some((low, high)));
            scale.set_ticks(Along::Width(width), 30.0).unwrap();
            (scale.ticks.into_iter().map(|(_, text)| text).collect::<Vec<_>>(), scale.unit.text())
        };
        assert_eq!(
            decades(-3.2, 0.1, 600.0),
            (["10⁻³", "10⁻²", "10⁻¹", "10⁰"].map(String::from).to_vec(), " (m)".into())
        );
        assert_eq!(decades(-12.5, 2.5, 600.0).0, ["10⁻¹²", "10⁻⁹", "10⁻⁶", "10⁻³", "10⁰"]);
        assert_eq!(decades(-0.2, 0.4, 600.0).0, ["10⁰", "2·10⁰"]);
        let axis = Axis { logarithmic: true, ..Axis::default() };
        let scale = Scale::new(&axis, Some((-2.0, 2.0)));
        assert_eq!(scale.place(axis.measure(10.0)), 0.75);
    }

    #[test]
    fn extreme_ranges_have_ticks() {
        for (low, high) in [(-1e150, 1e150), (1e-149, 1e-148), (0.0, 1e-140), (1e149, 1e150), (-1.0, 1.0)] {
            let (ticks, label) = scale("m", low, high);
            assert!((2..=10).contains(&ticks.len()), "{low:e}..{high:e}: {ticks:?} {label}");
            assert!(ticks.iter().all(|t| t.chars().count() < 8), "{ticks:?}");
        }
    }
}
