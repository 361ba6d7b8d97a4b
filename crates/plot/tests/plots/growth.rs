//! Figures of cost over size: proportional costs lie on the dashed line, others do not.

use crate::drawn::{draw_everywhere, hex, polylines, texts};
use stickslip_plot::{GrowthCurve, Theme, draw_svg, growth_figure};

#[test]
fn what_is_in_proportion_lies_on_its_line() {
    let sizes: Vec<f64> = (0..5).map(|i| 4_f64.powi(i)).collect();
    let [linear, flat, square] =
        [1, 0, 2].map(|power| sizes.iter().map(|size| 1e-3 * size.powi(power)).collect::<Vec<f64>>());
    let names = ["springs of a row", "simulated time", "contacts"];
    let curves: Vec<GrowthCurve<'_>> = [&linear, &flat, &square]
        .into_iter()
        .zip(names)
        .map(|(costs, name)| GrowthCurve {
            name,
            unit: if name == "simulated time" { "s" } else { "" },
            sizes: &sizes,
            costs,
            per_size: name == "simulated time",
        })
        .collect();
    let figure = growth_figure("What more costs", "time per simulated second", &curves);
    draw_everywhere("growth", &figure);
    let drawing = draw_svg(&figure).unwrap();
    let theme = Theme::light();
    let measured: Vec<_> =
        polylines(&drawing, &hex(theme.palette[0])).into_iter().filter(|line| line.len() == 5).collect();
    assert_eq!(measured.len(), 3);
    // Power laws are straight lines.
    for line in &measured {
        let slopes: Vec<f64> =
            line.windows(2).map(|pair| (pair[1].1 - pair[0].1) / (pair[1].0 - pair[0].0)).collect();
        assert!(slopes.iter().all(|slope| (slope - slopes[0]).abs() < 0.02), "{slopes:?}");
    }
    let rise = |line: &[(f64, f64)]| line[0].1 - line[4].1;
    assert!(rise(&measured[1]).abs() < 1.0 && rise(&measured[0]) > 100.0 && rise(&measured[2]) > 100.0);
    // The dashed line starts at the first point; for costs per size it is horizontal.
    let dashes = polylines(&drawing, &hex(theme.muted));
    let near = |(x, y): (f64, f64)| dashes.iter().flatten().any(|p| (p.0 - x).hypot(p.1 - y) < 12.0);
    let on_line = |line: &[(f64, f64)]| line.iter().filter(|&&point| near(point)).count();
    assert_eq!([&measured[0], &measured[1], &measured[2]].map(|line| on_line(line)), [5, 5, 1]);
    let texts = texts(&drawing);
    let count = |name: &str| texts.iter().filter(|text| text.text == name).count();
    assert_eq!((count("measured"), count("in proportion")), (1, 1));
    assert!(names.iter().all(|name| texts.iter().any(|text| text.text.starts_with(name))));
    assert_eq!(growth_figure("", "", &[]).panels.len(), 1);
}
