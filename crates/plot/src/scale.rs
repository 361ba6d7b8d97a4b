//! What an axis shows: prefix, offset, ticks.

use crate::panel::Axis;
use crate::{Label, PlotError};
use stickslip_quantity::{Prefix, takes_prefix};

/// An axis ready to be drawn.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Scale {
    /// Subtracted from the values, in the axis' unit, where they differ only in late digits.
    offset: f64,
    /// Ends of the axis, less the offset.
    low: f64,
    high: f64,
    /// Whether there are ticks.
    numbered: bool,
    /// The same ends in the unit shown; none of an empty axis.
    shown: Option<(f64, f64)>,
    /// Whether the ends are powers of ten.
    decades: bool,
    /// Whether all that is there is 0: then the ends say nothing.
    is_nothing: bool,
    /// Places (0 to 1) and numbers of the ticks.
    pub(crate) ticks: Vec<(f64, String)>,
    /// What it measures.
    pub(crate) label: Label,
    /// Offset and unit, to follow the label.
    pub(crate) unit: Label,
}

/// Room for the tick labels along an axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Along {
    /// Labels side by side: width of the axis, px.
    Width(f64),
    /// Labels one above the other: height of the axis, px.
    Height(f64),
}

/// More ticks than this make a ruler of an axis.
const MOST_TICKS: usize = 9;
/// Ranges narrower than this share of their distance from zero get an offset.
const OFFSET_BELOW: f64 = 5e-4;

impl Scale {
    /// The scale of a range (none: an empty axis), without ticks yet.
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

    /// The scale of what is 0 throughout, whose ends are arbitrary: its only number is 0.
    pub(crate) fn of_nothing(self, is_nothing: bool) -> Self {
        Self { is_nothing, ..self }
    }

    /// Whether its ends are arbitrary.
    pub(crate) fn is_of_nothing(&self) -> bool {
        self.is_nothing
    }

    /// Gives the axis as many ticks as fit at a size of `em` px.
    pub(crate) fn set_ticks(&mut self, along: Along, em: f64) -> Result<(), PlotError> {
        let ticks = if self.decades { decades } else { ticks };
        let shown = self.shown.filter(|_| self.numbered);
        self.ticks = match shown {
            Some(_) if self.is_nothing => vec![(self.place(0.0), "0".to_owned())],
            shown => shown.map_or(Ok(Vec::new()), |shown| ticks(shown, along, em))?,
        };
        Ok(())
    }

    /// Place along the axis of a value, or of its power of ten on a logarithmic one, 0 to 1.
    pub(crate) fn place(&self, value: f64) -> f64 {
        (value - self.offset - self.low) / (self.high - self.low)
    }

    /// The values at both ends; none of an empty axis.
    pub(crate) fn range(&self) -> Option<(f64, f64)> {
        self.shown.map(|_| (self.offset + self.low, self.offset + self.high))
    }

    /// The value at the end of the axis.
    pub(crate) fn end(&self) -> f64 {
        self.offset + self.high
    }

    /// Width of the widest tick label, px.
    pub(crate) fn label_width(&self, em: f64) -> Result<f64, PlotError> {
        self.ticks.iter().try_fold(0.0, |most: f64, (_, text)| Ok(most.max(Label::plain(text).width(em)?)))
    }

    /// How far the tick labels stand out beyond the start and the end of a horizontal axis, px.
    pub(crate) fn overhang(&self, width: f64, em: f64) -> Result<(f64, f64), PlotError> {
        self.ticks.iter().try_fold((0.0_f64, 0.0_f64), |(left, right), (place, text)| {
            let half = Label::plain(text).width(em)? / 2.0;
            Ok((left.max(half - place * width), right.max(half - (1.0 - place) * width)))
        })
    }
}

/// The unit with its prefix or power of ten.
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
        // In two steps: 10¹⁵³ times a value is in range where 10³⁰⁶ is not.
        let half = self.exponent / 2;
        value / 10_f64.powi(half) / 10_f64.powi(self.exponent - half)
    }
}

/// A round number near a range that lies far from zero; 0 for all others.
fn offset(from: f64, to: f64) -> f64 {
    let span = to - from;
    if span >= OFFSET_BELOW * from.abs().max(to.abs()) {
        return 0.0;
    }
    let grain = 10_f64.powi(math::log10(span).ceil() as i32);
    let offset = ((from + span / 2.0) / grain).round() * grain;
    if offset.is_finite() { offset } else { 0.0 }
}

/// The offset in its own prefix, to the digit that the span needs.
fn offset_text(offset: f64, span: f64, unit: &str) -> String {
    let multiple = Multiple::of(offset, unit);
    let grain = math::log10(span).ceil() as i32;
    let decimals = usize::try_from(multiple.exponent - grain).unwrap_or(0).min(17);
    let text = format!("{:.decimals$}", multiple.apply(offset));
    let text = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    if multiple.unit.is_empty() { text.to_owned() } else { format!("{text} {}", multiple.unit) }
}

/// A value in its own prefix to a number of significant digits, such as "12.5 ms".
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

/// What follows a label: the offset that the numbers lack, and their unit in brackets.
fn unit_text(label: &Label, offset: &str, unit: &str) -> Label {
    let bare = label.is_empty() && offset.is_empty();
    let unit = if unit.is_empty() || bare { unit.to_owned() } else { format!(" ({unit})") };
    // Not a plain label: the blank in front counts.
    Label::default().followed_by(offset).followed_by(&unit)
}

/// The finest ticks on 1, 2 or 5 times a power of ten whose labels keep apart.
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

/// Ticks at powers of ten whose labels keep apart; at 1, 2 and 5 times them where the range holds less than two.
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

/// A number with a true minus sign.
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
