//! Enlarged time range next to or below the whole.

use crate::drawn::{draw_everywhere, polylines, rectangles, texts};
use stickslip_plot::{
    EnergyBook, EventTrack, Figure, Track, Trajectory, draw_svg, energy_figure, enlarged_below,
    enlarged_beside, events_figure, trajectory_figure,
};

/// Times in a range, ms, and a slider that drifts and oscillates, µm.
fn motion((from, to): (f64, f64)) -> (Vec<f64>, Vec<f64>) {
    let time: Vec<f64> = (0..=2000).map(|k| from + (to - from) * f64::from(k) / 2000.0).collect();
    let x = time.iter().map(|t| 1e-6 * (t + (60.0 * t).sin())).collect();
    (time.iter().map(|t| 1e-3 * t).collect(), x)
}

fn figure<'a>(title: &str, (time, x): &'a (Vec<f64>, Vec<f64>)) -> Figure<'a> {
    let tracks = || vec![Track { name: "slider", values: x }];
    let trajectory = Trajectory {
        time,
        sliders: tracks(),
        relative: tracks(),
        gross_slip: Some(2e-6),
        ..Trajectory::default()
    };
    trajectory_figure(title, &trajectory)
}

#[test]
fn one_period_beside_the_whole() {
    let (whole, part) = (motion((0.0, 40.0)), motion((38.0, 40.0)));
    let both =
        enlarged_beside(figure("Forty periods", &whole), figure("", &part), (38e-3, 40e-3), "period 40");
    draw_everywhere("zoom", &both);
    let drawing = draw_svg(&both).unwrap();
    // Frames are black. The shaded range is the last twentieth of the left frames.
    let frames: Vec<_> = polylines(&drawing, "#1A1A1A").into_iter().filter(|line| line.len() == 5).collect();
    assert_eq!(frames.len(), 4);
    let ends = |frame: usize| (frames[frame][0].0, frames[frame][1].0);
    assert!(ends(0) == ends(2) && ends(1) == ends(3) && ends(0).1 < ends(1).0, "{frames:?}");
    let shades = rectangles(&drawing, "#E1E1E1");
    assert_eq!(shades.len(), 2);
    let (left, right) = ends(0);
    for [x, _, width, _] in &shades {
        let from = right - (right - left) / 20.0;
        assert!((x - from).abs() < 1.0 && (x + width - right).abs() < 1.0, "{shades:?} {from} {right}");
    }
    // 60 rad/ms: 20 turning points in the 2 ms of the part. The curve fills its frame from end to end.
    let curves: Vec<_> = polylines(&drawing, "#0072B2").into_iter().filter(|line| line.len() > 2).collect();
    assert_eq!(curves.len(), 4);
    let (first, last) = (curves[1][0].0, curves[1].last().unwrap().0);
    assert!((first - ends(1).0).abs() < 1.0 && (last - ends(1).1).abs() < 1.0, "{first} {last}");
    // Names appear once for all panels, time labels once per column.
    let count = |word: &str| texts(&drawing).iter().filter(|text| text.text == word).count();
    assert_eq!((count("slider"), count("period 40"), count("±u"), count("time t (ms)")), (1, 1, 1, 2));
    assert_eq!(count("38.5"), 1, "{:?}", texts(&drawing));
}

/// Released energy occurs in the part only, so its legend entry is there.
#[test]
fn what_is_in_the_part_alone_is_named_there() {
    let time = [0.0, 1.0, 2.0];
    let book = |elastic: &'static [f64], friction: &'static [f64]| EnergyBook {
        time: &[0.0, 1.0, 2.0],
        input: &[0.0; 3],
        kinetic: &[0.0; 3],
        elastic,
        friction,
        damping: &[0.0; 3],
        error: &[0.0; 3],
    };
    let whole = energy_figure("", &book(&[1.0, 2.0, 3.0], &[0.0, 1.0, 2.0]));
    let part = energy_figure("", &book(&[3.0, 2.0, 1.0], &[0.0, 1.0, 2.0]));
    let both = enlarged_beside(whole, part, (time[1], time[2]), "the last second");
    let drawing = draw_svg(&both).unwrap();
    let count = |word: &str| texts(&drawing).iter().filter(|text| text.text == word).count();
    assert_eq!((count("friction"), count("released")), (1, 1));
}

#[test]
fn what_is_no_column_of_as_many_panels_stays_as_it_is() {
    let (whole, part) = (motion((0.0, 40.0)), motion((38.0, 40.0)));
    let one = Figure { panels: figure("", &part).panels[..1].to_vec(), ..figure("", &part) };
    let alone = enlarged_beside(figure("", &whole), one, (38e-3, 40e-3), "period");
    assert_eq!(alone, figure("", &whole));
}

#[test]
fn the_shade_of_a_thousandth_is_seen() {
    let times: Vec<f64> = (0..5000).map(|k| f64::from(k) * 2e-4).collect();
    let track = || EventTrack { source: "ball", kind: "reversal", times: times.clone() };
    let span = (0.999, 1.0);
    let part = events_figure("", span, &[track()]);
    let both = enlarged_below(events_figure("", (0.0, 1.0), &[track()]), part, span, "period 1000");
    draw_everywhere("zoom-events", &both);
    let shades = rectangles(&draw_svg(&both).unwrap(), "#E1E1E1");
    assert!(shades.len() == 1 && (shades[0][2] - 5.0).abs() < 0.2, "{shades:?}");
    assert_eq!(both.panels[1].lanes[0].marks.len(), 5);
}
