//! Work–precision diagrams of methods of known order: positions of the points are measured.

use crate::drawn::{draw_everywhere, hex, polylines, texts, value};
use stickslip_plot::{Figure, Theme, WorkCurve, draw_svg, work_precision_figure};

/// Errors work^(-order), at least a floor, for work 1, 10, 100 …
struct Method {
    work: Vec<f64>,
    seconds: Vec<f64>,
    error: Vec<f64>,
}

fn method(order: i32, points: i32, floor: f64) -> Method {
    let work: Vec<f64> = (0..points).map(|i| 10_f64.powi(i)).collect();
    let error = work.iter().map(|work| work.powi(-order).max(floor)).collect();
    Method { seconds: work.iter().map(|work| 2e-7 * work).collect(), work, error }
}

impl Method {
    fn curve<'a>(&'a self, name: &'a str, place: usize) -> WorkCurve<'a> {
        WorkCurve { name, error: &self.error, seconds: &self.seconds, evaluations: &self.work, place }
    }
}

/// Numbers of the left panel's y axis with their positions, px from the top.
fn ticks(figure: &Figure<'_>) -> Vec<(String, f64)> {
    let texts = texts(&draw_svg(figure).unwrap());
    let bottom = texts.iter().map(|text| text.area[3]).fold(0.0, f64::max);
    let left = texts.iter().filter(|text| text.text.starts_with("10") && text.area[0] < 200.0);
    left.filter(|text| text.area[3] < bottom - 80.0)
        .map(|text| (text.text.clone(), (text.area[1] + text.area[3]) / 2.0))
        .collect()
}

#[test]
fn points_stand_at_their_powers_of_ten() {
    let (second, fourth) = (method(2, 5, 0.0), method(4, 4, 0.0));
    let curves = [second.curve("second", 0), fourth.curve("fourth", 1)];
    let figure = work_precision_figure("Two methods", "error", &curves);
    draw_everywhere("work-precision", &figure);
    let ticks = ticks(&figure);
    let drawing = draw_svg(&figure).unwrap();
    for (colour, method) in Theme::light().palette.iter().zip([&second, &fourth]) {
        let lines = polylines(&drawing, &hex(*colour));
        // One curve per panel; lines of the slopes have two points.
        let (curves, slopes): (Vec<_>, Vec<_>) =
            lines.into_iter().partition(|line| line.len() == method.error.len());
        assert!(curves.len() == 2 && !slopes.is_empty(), "{colour:?}");
        for curve in &curves {
            let steps: Vec<f64> = curve.windows(2).map(|pair| pair[1].0 - pair[0].0).collect();
            assert!(steps.iter().all(|step| (step / steps[0] - 1.0).abs() < 0.02), "{steps:?}");
        }
        for ((_, y), error) in curves[0].iter().zip(&method.error) {
            let name = format!("10{}", superscript(error.log10().round() as i32));
            if let Some((_, at)) = ticks.iter().find(|(text, _)| *text == name) {
                assert!((y - at).abs() < 3.0, "{name}: {y} and {at}");
            }
        }
    }
    assert!(ticks.iter().any(|(text, _)| text == "10⁻⁸"), "{ticks:?}");
    // Names and slopes are at the curves in both panels, without a legend.
    let said = said(&figure);
    let count = |name: &str| said.matches(name).count();
    // Both axes are per simulated second as well.
    assert_eq!((count("second, −2.0"), count("fourth, −4.0"), count("second")), (2, 2, 4), "{said}");
}

/// Texts in drawing order; wrapped names are joined.
fn said(figure: &Figure<'_>) -> String {
    let texts = texts(&draw_svg(figure).unwrap());
    texts.iter().map(|text| text.text.as_str()).collect::<Vec<_>>().join(" ")
}

fn superscript(exponent: i32) -> String {
    let digits = "⁰¹²³⁴⁵⁶⁷⁸⁹".chars().collect::<Vec<_>>();
    exponent.to_string().chars().map(|c| c.to_digit(10).map_or('⁻', |d| digits[d as usize])).collect()
}

#[test]
fn runs_that_others_beat_and_methods_without_errors_are_left_out() {
    let mut row = method(2, 8, 1e-5);
    // More work for a larger error.
    (row.work[1], row.error[1]) = (row.work[2], 1.0);
    let zero = Method { error: vec![0.0; 5], ..method(1, 5, 0.0) };
    let curves = [method(3, 5, 0.0), row, zero];
    let curves: Vec<WorkCurve<'_>> =
        curves.iter().zip(["event", "rk4", "verlet"]).map(|(method, name)| method.curve(name, 0)).collect();
    let figure = work_precision_figure("Rows", "error", &curves);
    draw_everywhere("work-precision-rows", &figure);
    // Of the row, the first run and the first run at the floor remain: too few for a slope.
    let lengths: Vec<usize> = figure.panels[1].series.iter().map(|series| series.xs.len()).collect();
    assert_eq!(lengths, [5, 2, 3]);
    let said = said(&figure);
    assert!(
        said.contains("event, −3.0")
            && said.contains("rk4")
            && !said.contains("rk4,")
            && !said.contains("verlet"),
        "{said}"
    );
    assert_eq!(work_precision_figure("Nothing", "error", &curves[2..]).panels.len(), 1);
}

#[test]
fn every_run_is_marked() {
    let method = method(2, 5, 0.0);
    let curves = [method.curve("order 2", 2)];
    let drawing = draw_svg(&work_precision_figure("", "error", &curves)).unwrap();
    let colour = hex(Theme::light().palette[2]);
    let discs = drawing.split("<circle ").skip(1).filter(|tag| value(tag, "fill") == colour);
    assert_eq!(discs.count(), 10);
}
