//! Paths between rows: a drawn path agrees with one from a hundred times as many rows.

use std::path::Path;
use stickslip_run::{Job, Periods, Trail, contact_path};

/// Size of the plot and half the line width, in pixels.
const FRAME: (f64, f64) = (1400.0, 760.0);
const HALF_WIDTH: f64 = 1.8;

/// Returns the last period of every contact of an example, as drawn and as rows only. `every` is the row interval.
fn loops(name: &str, every: &str) -> Vec<[Trail; 2]> {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios").join(format!("{name}.json"));
    let set = [("run.cycles", "3"), ("output.every", every)].map(|(k, v)| (k.to_owned(), v.to_owned()));
    let job = Job::prepare(&file, &set, Path::new("")).unwrap();
    let kept = job.run(&()).kept;
    let of = |c| {
        let (contact, _) = job.model.contacts().nth(c).unwrap();
        let [x, y] = ["u_m", "fx_N"].map(|quantity| kept.series.column(contact, quantity).to_vec());
        let rows = Trail { t: kept.series.time().to_vec(), x, y };
        let periods = Periods::of_contact(&job, c, kept.end()).unwrap();
        [contact_path(&job, c, &kept.series), rows].map(|trail| trail.part(periods.last()))
    };
    (0..job.model.contacts().count()).map(of).collect()
}

/// Returns the points of a path in pixels of the plot.
fn pixels(trail: &Trail, frame: &Trail) -> Vec<(f64, f64)> {
    let ends = |values: &[f64]| values.iter().fold((f64::MAX, f64::MIN), |(l, h), &v| (l.min(v), h.max(v)));
    let (x, y) = (ends(&frame.x), ends(&frame.y));
    let points = trail.x.iter().zip(&trail.y);
    points.map(|(u, f)| (FRAME.0 * (u - x.0) / (x.1 - x.0), FRAME.1 * (f - y.0) / (y.1 - y.0))).collect()
}

/// Returns the largest distance of the points of a path from another path at the same time, in pixels.
fn farthest(of: (&Trail, &[(f64, f64)]), from: (&Trail, &[(f64, f64)]), near: f64) -> f64 {
    let from_piece = |(x, y): (f64, f64), pair: &[(f64, f64)]| {
        let ((x0, y0), (x1, y1)) = (pair[0], pair[1]);
        let (dx, dy) = (x1 - x0, y1 - y0);
        let square = dx * dx + dy * dy;
        let share =
            if square > 0.0 { (((x - x0) * dx + (y - y0) * dy) / square).clamp(0.0, 1.0) } else { 0.0 };
        (x - x0 - share * dx).hypot(y - y0 - share * dy)
    };
    let from_line = |(&t, &point): (&f64, &(f64, f64))| {
        let first = from.0.t.partition_point(|other| *other < t - near).saturating_sub(1);
        let last = (from.0.t.partition_point(|other| *other <= t + near) + 1).min(from.1.len());
        from.1[first..last].windows(2).map(|pair| from_piece(point, pair)).fold(f64::MAX, f64::min)
    };
    of.0.t.iter().zip(of.1).map(from_line).fold(0.0, f64::max)
}

#[test]
fn loops_have_no_corners_that_more_rows_would_not_show() {
    let mut corners = 0;
    for (name, every, fine) in [
        ("vertical_climber", 4e-6, "40 ns"),
        ("impact_drive", 4e-6, "40 ns"),
        ("rocking_slider", 1e-5, "100 ns"),
        ("sine_drive", 5e-6, "50 ns"),
    ] {
        let coarse = loops(name, &every.to_string());
        for (c, ([drawn, rows], [_, dense])) in coarse.iter().zip(&loops(name, fine)).enumerate() {
            let [line, chords, points] = [drawn, rows, dense].map(|trail| pixels(trail, dense));
            assert!(points.len() > 20_000, "{}", points.len());
            // In both directions: no part is missing and none is invented.
            let missed = farthest((dense, &points), (drawn, &line), every / 2.0);
            let made_up = farthest((drawn, &line), (dense, &points), every / 2.0);
            let by_rows = farthest((dense, &points), (rows, &chords), every / 2.0);
            println!(
                "{name} {c}: {missed:.2} px missed, {made_up:.2} px made up, {by_rows:.2} px by rows alone"
            );
            assert!(missed < HALF_WIDTH && made_up < HALF_WIDTH, "{name} {c}: {missed} {made_up}");
            corners += usize::from(by_rows > HALF_WIDTH);
        }
    }
    assert!(corners >= 4, "of {corners} loops alone rows make corners");
}
