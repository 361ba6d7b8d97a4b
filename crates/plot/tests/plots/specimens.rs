//! Complete figures: closed-form loops, a staircase motion, and unusual input of users.

use crate::drawn::{assert_clear_border, decode, draw};
use proptest::prelude::*;
use stickslip_plot::{
    Arrangement, Axis, Band, Coordinate, Figure, HysteresisLoop, Ink, Label, Mosaic, Motion, Panel,
    PlotError, Reference, Series, Track, Trajectory, draw_png, draw_svg, loop_figure, read_text,
    trajectory_figure,
};

/// First loading to amplitude U and two cycles of the closed-form loop of a sphere (p = 3/2), u in m, F_x in N.
fn sphere_loop(ratio: f64, u_c: f64, limit: f64) -> (Vec<f64>, Vec<f64>) {
    let law = |way: f64, folds: f64| folds * limit * (1.0 - (1.0 - way / (folds * u_c)).max(0.0).powf(1.5));
    let amplitude = ratio * u_c;
    let top = law(amplitude, 1.0);
    let steps = 400;
    let share = |i: usize| i as f64 / steps as f64;
    let mut points: Vec<(f64, f64)> =
        (0..steps).map(|i| share(i) * amplitude).map(|u| (u, law(u, 1.0))).collect();
    for _ in 0..2 {
        points.extend(
            (0..steps).map(|i| 2.0 * amplitude * share(i)).map(|w| (amplitude - w, top - law(w, 2.0))),
        );
        points.extend(
            (0..=steps).map(|i| 2.0 * amplitude * share(i)).map(|w| (w - amplitude, law(w, 2.0) - top)),
        );
    }
    points.into_iter().unzip()
}

/// Sawtooth foot (slow rise, flyback of 2 %) and a slider that follows the rise after a backlash of 0.3 strokes. The
/// slider stays behind in the flyback and rings.
fn staircase(count: usize, backlash: f64) -> (Vec<f64>, Vec<f64>, Vec<f64>) {
    let (stroke, period) = (1e-6, 1e-3);
    let n = 500;
    let (mut t, mut foot, mut slider) = (vec![], vec![], vec![]);
    for i in 0..=count * n {
        let (k, phase) = ((i / n) as f64, (i % n) as f64 / n as f64);
        let rise = (phase / 0.98).min(1.0);
        let ring = 0.08 * (-phase * 12.0).exp() * (phase * 80.0).sin() * f64::from(k > 0.0);
        t.push((k + phase) * period);
        foot.push(stroke * (rise - ((phase - 0.98) / 0.02).max(0.0)));
        slider.push(stroke * ((1.0 - backlash) * k + (rise - backlash).max(0.0) - ring));
    }
    (t, foot, slider)
}

#[test]
fn loops_of_several_amplitudes() {
    let (u_c, limit) = (39.695e-9, 0.06);
    let ratios = [0.4, 0.7, 1.0, 1.4];
    let data: Vec<_> = ratios.iter().map(|&ratio| sphere_loop(ratio, u_c, limit)).collect();
    let names: Vec<String> = ratios.iter().map(|ratio| format!("U = {ratio:.1} u_c")).collect();
    let loops: Vec<_> = data
        .iter()
        .zip(&names)
        .map(|((u, force), name)| HysteresisLoop {
            name,
            u,
            force,
            gross_slip: Some(u_c),
            limit: Some(limit),
        })
        .collect();
    let mut figure = loop_figure("Hysteresis of a sphere on a plane, constant normal force", &loops);
    figure.provenance = vec![
        ("Software".into(), "stickslip 0.1.0".into()),
        ("Scenario hash".into(), "1f2e3d".into()),
        ("Comment".into(), "tolerance 1e-8, μ = 0.2, größer\nsecond line".into()),
        ("Stepper".into(), "event ∂".into()),
    ];
    let bytes = draw("loops", &figure);
    let texts = read_text(&bytes).unwrap();
    for pair in &figure.provenance {
        assert!(texts.contains(pair), "{pair:?} in {texts:?}");
    }
    assert!(texts.iter().any(|(key, text)| key == "Title" && text.starts_with("Hysteresis")));
    let drawing = draw_svg(&figure).unwrap();
    assert!(drawing.contains("tolerance 1e-8") && drawing.contains("width=\"1600\""));
    assert_eq!(read_text(drawing.as_bytes()).unwrap()[1..], figure.provenance);
}

#[test]
fn long_texts_are_packed_and_come_back_whole() {
    let latin: String = (0..4000).map(|i| format!("größe {i}\n")).collect();
    let wide: String = (0..6000).map(|i| format!("{{\"µ\": \"κ = μE*/G* № {i} 摩擦 🙂\"}}\r\n")).collect();
    let panel = panel("", vec![0.0, 1.0], vec![0.0, 1.0]);
    let entries = [
        ("Short", "plain"),
        ("Trace", latin.as_str()),
        ("Scenario", wide.as_str()),
        ("Sign", "μ"),
        ("None", ""),
    ];
    let provenance: Vec<_> = entries.map(|(key, text)| (key.to_owned(), text.to_owned())).to_vec();
    let figure = Figure { panels: vec![panel], provenance: provenance.clone(), ..Figure::default() };
    let bytes = draw_png(&figure).unwrap();
    let mut texts = read_text(&bytes).unwrap();
    assert!(wide.len() > 200_000 && bytes.len() < 100_000, "{} bytes for {}", bytes.len(), wide.len());
    for kind in ["tEXt", "zTXt", "iTXt"] {
        assert!(bytes.windows(4).any(|window| window == kind.as_bytes()), "{kind}");
    }
    let mut expected = provenance;
    texts.sort();
    expected.sort();
    assert_eq!(texts, expected);
    assert!(draw_svg(&figure).unwrap().contains("№ 5999 摩擦 🙂"));
}

#[test]
fn a_damaged_text_is_an_error_and_not_a_missing_one() {
    let provenance = [("\"Latin\"", "größer 1e-9\n"), ("Unicode", "μ <1e-9> & so on\n")];
    let provenance = provenance.map(|(key, text)| (key.to_owned(), text.repeat(500))).to_vec();
    let bytes = draw_png(&Figure { provenance: provenance.clone(), ..loop_figure("", &[]) }).unwrap();
    assert_eq!(read_text(&bytes).unwrap(), provenance);
    let drawing = draw_svg(&Figure { provenance: provenance.clone(), ..loop_figure("", &[]) }).unwrap();
    assert_eq!(read_text(drawing.as_bytes()).unwrap(), provenance);
    assert!(drawing.contains("<desc></desc>"));
    for key in ["zTXt", "iTXt"] {
        let place = bytes.windows(4).position(|w| w == key.as_bytes()).unwrap();
        for offset in [4, 60] {
            let mut bytes = bytes.clone();
            bytes[place + offset] ^= 1;
            assert_eq!(read_text(&bytes).unwrap_err().to_string(), "PNG: damaged");
        }
        assert!(read_text(&bytes[..place + 60]).is_err());
    }
}

#[test]
fn one_loop_without_limits() {
    let (u, force) = sphere_loop(0.9, 3e-6, 12.0);
    draw(
        "loop-plain",
        &loop_figure(
            "",
            &[HysteresisLoop { name: "ball_1", u: &u, force: &force, gross_slip: None, limit: None }],
        ),
    );
}

#[test]
fn staircase_over_a_sawtooth() {
    let ((t, foot, slider), (_, _, loaded)) = (staircase(6, 0.3), staircase(6, 0.65));
    let relative =
        |slider: &[f64]| -> Vec<f64> { foot.iter().zip(slider).map(|(foot, x)| foot - x).collect() };
    let (u, u_loaded) = (relative(&slider), relative(&loaded));
    let trajectory = Trajectory {
        time: &t,
        feet: vec![Track { name: "foot", values: &foot }],
        sliders: vec![
            Track { name: "slider, no load", values: &slider },
            Track { name: "slider, λ = 0.5", values: &loaded },
        ],
        relative: vec![
            Track { name: "slider, no load", values: &u },
            Track { name: "slider, λ = 0.5", values: &u_loaded },
        ],
        ..Trajectory::default()
    };
    let figure = trajectory_figure("Inertia drive, stroke 1 µm, period 1 ms", &trajectory);
    draw("staircase", &figure);
    let alone = Trajectory { relative: vec![], ..trajectory };
    draw("staircase-alone", &trajectory_figure("Staircase", &alone));
}

#[test]
fn a_rocking_slider_on_a_foot_that_lifts() {
    let ((t, foot, slider), (_, _, other)) = (staircase(6, 0.3), staircase(6, 0.65));
    let wave = |size: f64, speed: f64| -> Vec<f64> { t.iter().map(|t| size * (speed * t).sin()).collect() };
    let (lift, bounce, rock) = (wave(20e-9, 1e4), wave(35e-9, 2.3e4), wave(4e-6, 1.1e4));
    let slider = Track { name: "slider", values: &slider };
    let trajectory = Trajectory {
        time: &t,
        feet: vec![Track { name: "foot", values: &foot }],
        sliders: vec![slider, Track { name: "counter-mass", values: &other }],
        beside: vec![
            Motion {
                coordinate: Coordinate::Height,
                feet: vec![Track { name: "foot", values: &lift }],
                sliders: vec![Track { name: "counter-mass", values: &bounce }],
            },
            Motion {
                coordinate: Coordinate::Pitch,
                feet: vec![],
                sliders: vec![Track { values: &rock, ..slider }],
            },
        ],
        relative: vec![Track { name: "ball", values: slider.values }],
        is_upright: false,
        gross_slip: None,
    };
    let figure = trajectory_figure("Rocking slider", &trajectory);
    let colours: Vec<_> = figure.panels.iter().map(|panel| panel.series.last().unwrap().style.ink).collect();
    let palette = |place| Some(Ink::Palette(place));
    assert_eq!(colours, [palette(1), palette(1), palette(0), palette(0)], "one body, one colour");
    draw("rocking", &figure);
    let still = Trajectory { feet: vec![], sliders: vec![], relative: vec![], ..trajectory };
    assert_eq!(trajectory_figure("", &still).panels.len(), 2, "nothing moves along x");
}

#[test]
fn a_million_points() {
    let n = 1_000_000;
    let t: Vec<f64> = (0..n).map(|i| f64::from(i) * 1e-6).collect();
    // Modulated oscillation, pseudo-random noise, and one spike.
    let mut seed = 1_u32;
    let mut noise = || {
        seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        f64::from(seed) / f64::from(u32::MAX) - 0.5
    };
    let mut x: Vec<f64> =
        t.iter().map(|t| 1e-6 * ((40.0 * t).sin() * (9000.0 * t).sin() + 0.2 * noise())).collect();
    x[700_123] = 3e-6;
    let trajectory =
        Trajectory { time: &t, sliders: vec![Track { name: "slider", values: &x }], ..Trajectory::default() };
    let figure = trajectory_figure("One million points", &trajectory);
    let picture = decode(&draw("million", &figure));
    // The spike reaches the top of the frame, where nothing else is blue.
    let blue = |p: &[u8]| p[2] > 150 && p[0] < 100;
    let upper = &picture.rgb[..picture.width * picture.height];
    assert!(upper.chunks_exact(3).filter(|p| blue(p)).count() > 100);
}

#[test]
fn many_cycles_of_one_loop() {
    let (u, force) = sphere_loop(0.8, 40e-9, 0.06);
    let cycles = |v: &[f64]| -> Vec<f64> { v[400..1202].iter().copied().cycle().take(802 * 600).collect() };
    let (u, force) = (cycles(&u), cycles(&force));
    let one = HysteresisLoop {
        name: "600 cycles",
        u: &u,
        force: &force,
        gross_slip: Some(40e-9),
        limit: Some(0.06),
    };
    draw("cycles", &loop_figure("A limit cycle, six hundred times", &[one]));
}

fn panel(label: &str, xs: Vec<f64>, ys: Vec<f64>) -> Panel<'static> {
    Panel {
        x: Axis::new(Label::plain("time t"), "s"),
        y: Axis::new(Label::plain("displacement u"), "m"),
        series: vec![Series::new(label, xs, ys)],
        ..Panel::default()
    }
}

#[test]
fn degenerate_series() {
    let ramp: Vec<f64> = (0..10).map(f64::from).collect();
    let panels = [
        panel("empty", vec![], vec![]),
        panel("not a number", ramp.clone(), vec![f64::NAN; 10]),
        panel("one point", vec![1.0], vec![2e-6]),
        panel("constant", ramp.clone(), vec![5e-6; 10]),
        panel(
            "with gaps",
            ramp.clone(),
            ramp.iter().map(|x| if *x == 5.0 { f64::INFINITY } else { 1e-9 * x }).collect(),
        ),
        panel("far away", ramp.clone(), ramp.iter().map(|x| 0.001_234_5 + 1e-10 * x).collect()),
    ];
    for (place, rows) in panels.chunks(3).enumerate() {
        let figure = Figure {
            title: "Degenerate series".into(),
            panels: rows.to_vec(),
            size: (2400, 900),
            ..Figure::default()
        };
        draw(&format!("degenerate-{place}"), &figure);
    }
    let huge = panel("huge", vec![-1e150, 1e150, 1e300, 3.0], vec![1e-320, 1e150, 0.0, f64::MIN]);
    draw("huge", &Figure { panels: vec![huge], ..Figure::default() });
}

#[test]
fn crowded_legends_and_long_words() {
    let ramp: Vec<f64> = (0..50).map(f64::from).collect();
    let series = (0..40)
        .map(|k| {
            let ys: Vec<f64> = ramp.iter().map(|x| (x / 8.0 + f64::from(k) / 6.0).sin()).collect();
            Series::new(format!("sweep {k}: normal force {} mN", 10 * k), ramp.clone(), ys)
        })
        .collect();
    let long =
        "An unreasonably long title that goes on about the drive, its preload, its stroke, and its period "
            .repeat(4);
    let crowded = Panel {
        x: Axis::new(Label::plain(&"a label far longer than its axis ".repeat(5)), "s"),
        y: Axis::new(Label::plain(&"another label longer than its axis ".repeat(3)), "1"),
        series,
        references: vec![Reference::Vertical { x: 20.0, label: "start".into() }],
        aspect: Some(1.0),
        ..Panel::default()
    };
    draw("crowded", &Figure { title: long.as_str().into(), panels: vec![crowded], ..Figure::default() });
}

#[test]
fn all_line_styles() {
    let ramp: Vec<f64> = (0..200).map(|i| f64::from(i) / 20.0).collect();
    let series = (0..8)
        .map(|k| {
            let ys: Vec<f64> = ramp.iter().map(|x| (x - 0.3 * f64::from(k)).sin() + f64::from(k)).collect();
            Series::new(format!("curve {k}"), ramp.clone(), ys)
        })
        .collect();
    let panel =
        Panel { x: Axis::new("x".into(), "m"), y: Axis::new("y".into(), ""), series, ..Panel::default() };
    draw(
        "styles",
        &Figure { title: "Line styles".into(), panels: vec![panel], size: (800, 500), ..Figure::default() },
    );
}

#[test]
fn what_cannot_be_drawn_is_refused() {
    let fine = || panel("fine", vec![0.0, 1.0], vec![0.0, 1.0]);
    let refused = |figure: &Figure<'_>| (draw_png(figure).unwrap_err(), draw_svg(figure).unwrap_err()).0;
    assert_eq!(refused(&Figure::default()), PlotError::NoPanels);
    let size = Figure { panels: vec![fine()], size: (100, 100_000), ..Figure::default() };
    assert_eq!(refused(&size), PlotError::Size { width: 100, height: 100_000 });
    let lengths = Figure { panels: vec![fine(), panel("", vec![1.0], vec![])], ..Figure::default() };
    assert_eq!(refused(&lengths), PlotError::Lengths { panel: 1, series: 0, xs: 1, ys: 0 });
    let mosaic = |xs: Vec<f64>, cells: Vec<u8>| {
        let classes = vec![("open".into(), Ink::Shade(0))];
        let mosaic = Mosaic { xs: xs.into(), ys: vec![0.0, 1.0].into(), cells: cells.into(), classes };
        refused(&Figure {
            panels: vec![Panel { mosaic: Some(mosaic), ..Panel::default() }],
            ..Figure::default()
        })
    };
    for error in [
        mosaic(vec![0.0, 1.0], vec![0; 3]),
        mosaic(vec![0.0, 1.0], vec![1; 4]),
        mosaic(vec![1.0, 0.0], vec![0; 4]),
        mosaic(vec![0.0, f64::NAN], vec![0; 4]),
    ] {
        assert_eq!(error, PlotError::Mosaic { panel: 0 });
    }
    let edges = |low: Vec<f64>| {
        let (xs, high) = (vec![0.0, 1.0].into(), vec![1.0, 1.0].into());
        let band = Band { label: "".into(), xs, low: low.into(), high, ink: Ink::Muted };
        refused(&Figure {
            panels: vec![Panel { bands: vec![band], ..Panel::default() }],
            ..Figure::default()
        })
    };
    assert_eq!(edges(vec![0.0]), PlotError::Edges { panel: 0, band: 0, xs: 2, low: 1, high: 2 });
    let crowd = Figure { panels: vec![fine(); 20], ..Figure::default() };
    assert!(matches!(refused(&crowd), PlotError::NoRoom { .. }));
    let key = Figure {
        panels: vec![fine()],
        provenance: vec![(" key".into(), String::new())],
        ..Figure::default()
    };
    assert_eq!(draw_png(&key).unwrap_err(), PlotError::Key(" key".into()));
    for (bytes, message) in [("no picture", "neither"), ("<html/>", "neither"), ("<svg>", "SVG: ")] {
        assert!(read_text(bytes.as_bytes()).unwrap_err().to_string().starts_with(message));
    }
}

fn any_value() -> impl Strategy<Value = f64> {
    prop_oneof![4 => -1e-6..1e-6_f64, 1 => proptest::num::f64::ANY, 1 => Just(f64::NAN), 1 => Just(f64::INFINITY), 1 => Just(0.0)]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]
    #[test]
    fn no_series_makes_it_panic(
        points in proptest::collection::vec((any_value(), any_value()), 0..60),
        references in proptest::collection::vec(any_value(), 0..3),
        (column, share_x) in (any::<bool>(), any::<bool>()),
        (title, unit) in (any::<String>(), "[a-zµ²%]{0,4}"),
    ) {
        let (xs, ys): (Vec<f64>, Vec<f64>) = points.into_iter().unzip();
        let mut first = panel(&title, xs.clone(), ys.clone());
        first.y.unit = unit;
        first.aspect = references.first().copied();
        first.share = references.last().copied().unwrap_or(1.0);
        first.references = references.iter().map(|&y| Reference::Horizontal { y, label: Label::markup(&title) }).collect();
        let arrangement = if column { Arrangement::Column { share_x } } else { Arrangement::Row };
        let panels = vec![first, panel("b", ys, xs)];
        let figure = Figure { title: Label::markup(&title), panels, arrangement, size: (800, 600), ..Figure::default() };
        match draw_png(&figure) {
            Ok(bytes) => {
                assert_clear_border(&decode(&bytes));
            }
            Err(error) => prop_assert!(matches!(error, PlotError::NoRoom { .. }), "{}", error),
        }
        prop_assert_eq!(draw_svg(&figure).is_ok(), draw_png(&figure).is_ok());
    }
}
