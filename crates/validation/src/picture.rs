//! Elements of the plots.

use stickslip_plot::{Axis, Dash, Ink, Label, Series, Style};

/// Returns a solid curve for results of the program.
pub(crate) fn curve(label: &str, points: impl IntoIterator<Item = (f64, f64)>, ink: Ink) -> Series<'static> {
    line(label, points, ink, Dash::Solid)
}

/// Returns a line with a dash pattern.
pub(crate) fn line(
    label: &str,
    points: impl IntoIterator<Item = (f64, f64)>,
    ink: Ink,
    dash: Dash,
) -> Series<'static> {
    let (xs, ys): (Vec<f64>, Vec<f64>) = points.into_iter().unzip();
    let style = Style { ink: Some(ink), dash: Some(dash), width: 1.0 };
    Series { style, ..Series::new(Label::markup(label), xs, ys) }
}

/// Returns points that are not connected.
pub(crate) fn points(label: &str, points: impl IntoIterator<Item = (f64, f64)>, ink: Ink) -> Series<'static> {
    // NaN after each point separates it from the next.
    let apart = points.into_iter().flat_map(|point| [point, (f64::NAN, f64::NAN)]);
    let series = line(label, apart, ink, Dash::Solid);
    Series { marked: true, style: Style { width: 1.3, ..series.style }, ..series }
}

/// Returns an axis with subscripts in its label.
pub(crate) fn axis(label: &str, unit: &str) -> Axis {
    Axis::new(Label::markup(label), unit)
}
