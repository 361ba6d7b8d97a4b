//! Figures in the width of a printed column, and overlays.

use crate::drawn::texts;
use stickslip_plot::{
    Arrangement, Axis, EventTrack, Figure, Label, MemoryMoment, Note, Panel, Series, draw_svg, events_figure,
    memory_figure, overlaid,
};

/// Six curves of a contact with a long name.
fn memories<'a>(times: &'a [String], (h, p): (&'a [f64], &'a [f64])) -> Figure<'a> {
    let moment =
        |time: &'a String| MemoryMoment { contact: "trunc cone", time, d: 1e-7, u: 0.0, slope: 0.2, h, p };
    let other = MemoryMoment { contact: "worn", ..moment(&times[0]) };
    memory_figure("Memory", &times[1..].iter().map(moment).chain([other]).collect::<Vec<_>>())
}

/// The number of columns decreases until headings are complete.
#[test]
fn narrow_figures_have_fewer_columns_and_whole_headings() {
    let times: Vec<String> = (0..6).map(|k| format!("{}.125 ms", 91 + k)).collect();
    let (h, p) = ([0.0, 1e-7], [0.0, 0.0]);
    let columns = |width: f64| {
        let figure = memories(&times, (&h, &p)).printed(width);
        let said = texts(&draw_svg(&figure).unwrap());
        let all = said.iter().map(|text| text.text.as_str()).collect::<Vec<_>>().join(" ");
        assert!(times.iter().all(|time| all.contains(time.as_str())) && !all.contains('…'), "{width}: {all}");
        assert!(figure.size.1 <= Figure::MOST);
        match figure.arrangement {
            Arrangement::Grid { columns, .. } => columns,
            _ => 0,
        }
    };
    assert_eq!([60.0, 85.0, 160.0].map(columns), [1, 2, 3]);
}

/// Lane names keep nearly the size of the axis numbers.
#[test]
fn a_figure_grows_for_the_names_of_its_lanes() {
    let kinds = ["gross slip", "gross slip ends", "reversal", "loop closed", "current in limits"];
    let track = |kind| EventTrack { source: "stack on the left", kind, times: vec![0.5] };
    let figure = events_figure("Events", (0.0, 1.0), &kinds.map(track));
    let share = |figure: &Figure<'_>| {
        let said = texts(&draw_svg(figure).unwrap());
        let size = |of: &dyn Fn(&str) -> bool| {
            let [_, top, _, bottom] = said.iter().find(|text| of(&text.text))?.area;
            Some(bottom - top)
        };
        size(&|text| text.contains("reversal")).unwrap()
            / size(&|text| text.len() == 3 && text.parse::<f64>().is_ok()).unwrap()
    };
    let [wide, narrow] = [share(&figure), share(&figure.printed(85.0))];
    // At the original height the ratio was 0.4.
    assert!(narrow > 0.89 * wide, "{wide} {narrow}");
}

/// Panel with one curve.
fn panel(unit: &str) -> Panel<'static> {
    Panel {
        x: Axis::new(Label::plain("u"), unit),
        y: Axis::new(Label::plain("F"), "N"),
        series: vec![Series::new("loop", vec![0.0, 1.0], vec![0.0, 1.0])],
        ..Panel::default()
    }
}

/// Five names along a line, which need more than half the height.
#[test]
fn a_figure_grows_for_the_names_in_its_frames_and_says_which_are_left_out() {
    let name = |k: usize| Note {
        lines: vec![Label::plain(&format!("name {k}"))],
        about: [(k as f64 / 5.0, 0.5); 2],
        on: None,
        ink: None,
    };
    let noted = Panel { notes: (0..5).map(name).collect(), ..panel("m") };
    let figure = Figure { panels: vec![noted], size: (1600, 500), ..Figure::default() };
    let named = |figure: &Figure<'_>| {
        let said = texts(&draw_svg(figure).unwrap());
        said.iter().filter(|text| text.text.starts_with("name ")).count()
    };
    assert_eq!(named(&figure), 5);
    let printed = figure.clone().printed(85.0);
    assert_eq!(named(&printed), 5);
    // At a lower height some are left out, and their number is given.
    let low = Figure { size: (printed.size.0, printed.size.0 * 34 / 100), ..printed };
    let said = texts(&draw_svg(&low).unwrap());
    let left_out = 5 - named(&low);
    assert!(left_out > 0);
    let is_told = |text: &str| {
        text.contains(&format!("and {left_out} more")) || text.contains(&format!("{left_out} left out"))
    };
    assert!(said.iter().any(|text| is_told(&text.text)), "{said:?}");
}

#[test]
fn what_figures_have_in_common_is_laid_over_each_other() {
    let of = |units: &[&str]| Figure {
        panels: units.iter().map(|unit| panel(unit)).collect(),
        ..Figure::default()
    };
    let over = |a: &[&str], b: &[&str]| {
        overlaid("", &[("a".to_owned(), of(a)), ("b".to_owned(), of(b))]).map(|figure| figure.panels.len())
    };
    assert_eq!(over(&["m", ""], &["m", ""]), Some(2));
    assert_eq!(over(&["m"], &["m", ""]), Some(1));
    assert_eq!(over(&["m", "s"], &["m", ""]), Some(1));
    assert_eq!(over(&["s"], &["m", ""]), None);
    // A panel that only one figure has is left out.
    assert_eq!(over(&["m", "s", ""], &["m", ""]), Some(2));
}

/// Panels are matched by their quantities, not by their index.
#[test]
fn panels_are_laid_over_those_that_show_the_same() {
    let of = |name: &str, shows: &[(&str, bool)]| {
        let panels = shows.iter().map(|(shows, is_part)| {
            let covers = is_part.then_some((1.0, 2.0));
            let x = Axis { covers, ..Axis::new(Label::plain("time t"), "s") };
            Panel { x, y: Axis::new(Label::plain(shows), "m"), ..panel("m") }
        });
        (name.to_owned(), Figure { panels: panels.collect(), ..Figure::default() })
    };
    let shown = |figures: &[(String, Figure<'_>)]| {
        let figure = overlaid("", figures).unwrap();
        let told = figure
            .panels
            .iter()
            .map(|panel| (panel.y.label.text(), panel.x.covers.is_some(), panel.series.len()));
        told.collect::<Vec<_>>()
    };
    let whole = of("whole", &[("place", false), ("way", false)]);
    let parts = of("parts", &[("place", false), ("place", true), ("way", false), ("way", true)]);
    let common = [("place".to_owned(), false, 2), ("way".to_owned(), false, 2)];
    assert_eq!(shown(&[whole.clone(), parts.clone()]), common);
    assert_eq!(shown(&[parts.clone(), whole]), common);
    assert_eq!(shown(&[parts.clone(), parts]).len(), 4);
}
