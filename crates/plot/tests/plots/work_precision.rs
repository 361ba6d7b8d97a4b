//! Work-precision diagrams of methods whose order is known: where their points stand is measured.

use crate::drawn::{draw_everywhere, hex, polylines, texts, value};
use stickslip_plot::{Figure, Theme, WorkCurve, draw_svg, work_precision_figure};

/// Errors work^-order down to a floor, for work 1, 10, 100 …
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
    fn curve<'a>(&'a self, group: &'a str, name: &'a str, place: usize) -> WorkCurve<'a> {
        WorkCurve { name, group, error: &self.error, seconds: &self.seconds, evaluations: &self.work, place }
    }
}

/// Places of the numbers of the left panel's y axis, px from the top.
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
    let curves = [second.curve("", "second", 0), fourth.curve("", "fourth", 1)];
    let figure = work_precision_figure("Two methods", "error", &curves, None);
    draw_everywhere("work-precision", &figure);
    let ticks = ticks(&figure);
    let drawing = draw_svg(&figure).unwrap();
    for (colour, method) in Theme::light().palette.iter().zip([&second, &fourth]) {
        let lines = polylines(&drawing, &hex(*colour));
        // The legend's sample is short; one curve in each panel.
        let curves: Vec<_> = lines.into_iter().filter(|line| line.len() == method.error.len()).collect();
        assert_eq!(curves.len(), 2, "{colour:?}");
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
    // Names and slopes stand right at the curves, in both panels, and the names in one legend.
    let said = said(&figure);
    let count = |name: &str| said.matches(name).count();
    // Both axes are per simulated second as well.
    assert_eq!((count("second, −2.0"), count("fourth, −4.0"), count("second")), (2, 2, 5), "{said}");
}

/// All texts in the order in which they are drawn; a name that is broken into lines is whole again.
fn said(figure: &Figure<'_>) -> String {
    let texts = texts(&draw_svg(figure).unwrap());
    texts.iter().map(|text| text.text.as_str()).collect::<Vec<_>>().join(" ")
}

fn superscript(exponent: i32) -> String {
    let digits = "⁰¹²³⁴⁵⁶⁷⁸⁹".chars().collect::<Vec<_>>();
    exponent.to_string().chars().map(|c| c.to_digit(10).map_or('⁻', |d| digits[d as usize])).collect()
}

#[test]
fn five_curves_at_most_are_in_a_panel() {
    let (good, row) = (method(3, 5, 0.0), method(2, 8, 1e-5));
    let zero = Method { error: vec![0.0; 5], ..method(1, 5, 0.0) };
    let names = ["event", "dopri5", "rk4", "verlet", "loop", "ode\u{5f}solvers"];
    let curves: Vec<WorkCurve<'_>> = std::iter::once(good.curve("exact", "event", 0))
        .chain((0..6).map(|place| row.curve("rows of 64 springs", names[place], place)))
        .chain([zero.curve("exact", "without error", 1)])
        .collect();
    let figure = work_precision_figure("Rows", "error", &curves, Some(1e-13));
    let counts: Vec<usize> = figure.panels.iter().map(|panel| panel.series.len()).collect();
    assert_eq!(counts, [1, 1, 5, 5, 1, 1]);
    draw_everywhere("work-precision-rows", &figure);
    let said = said(&figure);
    let count = |name: &str| said.matches(name).count();
    assert_eq!((count("rows of 64 springs"), count("event, −3.0")), (2, 2), "{said}");
    // What lies on the floor has no part in the slope: 1, 0.01 and 1e-4, then 1e-5 all along.
    assert_eq!((count("rk4, −2.0"), count("without error")), (2, 0), "{said}");
    // No legend names all that the others do: each panel has its own.
    assert_eq!(count("doubt of the reference"), 6);
    let nothing = work_precision_figure("Nothing", "error", &curves[7..], None);
    assert_eq!(nothing.panels.len(), 1);
}

#[test]
fn every_run_is_marked() {
    let method = method(2, 5, 0.0);
    let curves = [method.curve("", "order 2", 2)];
    let drawing = draw_svg(&work_precision_figure("", "error", &curves, None)).unwrap();
    let colour = hex(Theme::light().palette[2]);
    let discs = drawing.split("<circle ").skip(1).filter(|tag| value(tag, "fill") == colour);
    assert_eq!(discs.count(), 10);
}
