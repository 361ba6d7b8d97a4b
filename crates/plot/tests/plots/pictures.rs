//! Figures of a drive from closed forms and small mechanical models. They are drawn in both themes and at several
//! sizes; their contents are counted and measured.

use crate::drawn::{Picture, decode, draw_everywhere, hex, polygons, polylines, rectangles, texts, value};
use data_encoding::BASE64;
use proptest::prelude::*;
use stickslip_plot::{
    Colour, ComparedChannel, Coordinate, EnergyBook, EventTrack, Figure, HysteresisLoop, MemoryMoment,
    PhasePath, SpringCondition, SpringMap, Theme, compare_figure, draw_png, draw_svg, energy_figure,
    events_figure, loop_figure, memory_figure, phase_figure, state_figure,
};

/// Row of springs as in the handbook: n springs over ±1.2 a under a paraboloid, heights in units of d₀.
struct Row {
    time: Vec<f64>,
    x: Vec<f64>,
    conditions: Vec<SpringCondition>,
}

/// Simulates u = 0.7 sin 2πt and d = 1 + m sin 4πt in units of u_c and d₀.
fn row(springs: usize, moments: usize, cycles: f64, m: f64) -> Row {
    let x: Vec<f64> = (0..springs).map(|i| ((i as f64 + 0.5) / springs as f64 * 2.0 - 1.0) * 1.2).collect();
    let mut stretch = vec![0.0; springs];
    let mut conditions = Vec::new();
    let time: Vec<f64> = (0..moments).map(|i| cycles * i as f64 / (moments - 1) as f64).collect();
    let mut before = 0.0;
    for t in &time {
        let u = 0.7 * (std::f64::consts::TAU * t).sin();
        let d = 1.0 + m * (2.0 * std::f64::consts::TAU * t).sin();
        for (s, x) in stretch.iter_mut().zip(&x) {
            let limit = d - x * x;
            let trial = *s + u - before;
            *s = if limit <= 0.0 { 0.0 } else { trial.clamp(-limit, limit) };
            conditions.push(match trial {
                _ if limit <= 0.0 => SpringCondition::Open,
                trial if trial >= limit => SpringCondition::SlipForward,
                trial if trial <= -limit => SpringCondition::SlipBackward,
                _ => SpringCondition::Stick,
            });
        }
        before = u;
    }
    let x = x.iter().map(|x| 20e-6 * x).collect();
    Row { time: time.iter().map(|t| t * 1e-3).collect(), x, conditions }
}

impl Row {
    fn map<'a>(&'a self, name: &'a str) -> SpringMap<'a> {
        SpringMap { name, time: &self.time, x: &self.x, conditions: &self.conditions }
    }
}

#[test]
fn states_of_springs() {
    let (few, many) = (row(48, 400, 2.0, 0.3), row(200, 30_000, 300.0, 0.3));
    draw_everywhere("state", &state_figure("Springs of a sphere under a swinging load", &[few.map("ball")]));
    draw_everywhere("state-long", &state_figure("Three hundred cycles", &[many.map("ball")]));
    let two = [few.map("left ball"), few.map("right ball")];
    draw_everywhere("state-two", &state_figure("Two contacts", &two));
}

/// Too many contacts for one column: they are arranged in columns, and the title gives the number shown.
#[test]
fn states_of_a_hundred_contacts_are_those_that_have_room() {
    let few = row(48, 400, 2.0, 0.3);
    let named: Vec<String> = (1..=100).map(|k| format!("ball {k}")).collect();
    let maps: Vec<_> = named.iter().map(|name| few.map(name)).collect();
    for (count, last, title) in
        [(17, "ball 17", "Many"), (51, "ball 51", "Many"), (100, "ball 51", "Many: 51 of 100 contacts")]
    {
        let figure = state_figure("Many", &maps[..count]);
        let drawing = draw_svg(&figure).unwrap();
        let all = texts(&drawing);
        assert!(
            all.iter().any(|text| text.text.contains(title))
                && all.iter().any(|text| text.text.contains(last)),
            "{count}"
        );
        assert!(!all.iter().any(|text| text.text.contains("ball 52")), "{count}");
    }
}

/// Number of pixels of each shade of the light theme: open, stick, slip +, slip -.
fn shaded(picture: &Picture) -> [f64; 4] {
    Theme::light().shades.map(|Colour(r, g, b)| picture.count([r, g, b]) as f64)
}

#[test]
fn the_picture_shows_every_state_in_its_share() {
    let row = row(48, 400, 2.0, 0.3);
    let figure = state_figure("", &[row.map("ball")]);
    // The first and the last time have half a column.
    let mut shares = [0.0; 4];
    for (i, condition) in row.conditions.iter().enumerate() {
        let is_outer = !(48..399 * 48).contains(&i);
        shares[*condition as usize] += if is_outer { 0.5 } else { 1.0 } / (48.0 * 399.0);
    }
    let drawing = draw_svg(&figure).unwrap();
    let image = drawing.split_once("<image ").unwrap().1;
    let data = value(image, "xlink:href").strip_prefix("data:image/png;base64,").unwrap();
    let embedded = decode(&BASE64.decode(data.as_bytes()).unwrap());
    assert!(drawing.len() < 60_000, "{} bytes of 19 200 cells", drawing.len());
    for picture in [decode(&draw_png(&figure).unwrap()), embedded] {
        let counts = shaded(&picture);
        let sum: f64 = counts.iter().sum();
        for (count, share) in counts.iter().zip(shares) {
            // Pixels on the border of two states have mixed colours.
            assert!((count / sum - share).abs() < 0.01, "{counts:?} for {shares:?}");
        }
    }
}

#[test]
fn energies() {
    let n = 4000;
    let time: Vec<f64> = (0..n).map(|i| 20e-3 * i as f64 / n as f64).collect();
    let of = |f: &dyn Fn(f64) -> f64| -> Vec<f64> { time.iter().map(|t| f(t * 1e3)).collect() };
    let friction = of(&|t| 80e-9 * (t.floor() + ((t.fract() - 0.9) * 10.0).max(0.0)));
    let damping = of(&|t| 9e-9 * t);
    let kinetic = of(&|t| 60e-9 * (-(t.fract() - 0.95).powi(2) * 400.0).exp());
    let elastic = of(&|t| 140e-9 + 20e-9 * (std::f64::consts::TAU * t).sin());
    let start = kinetic[0] + elastic[0];
    let input: Vec<f64> =
        (0..n).map(|i| friction[i] + damping[i] + kinetic[i] + elastic[i] - start).collect();
    let error = of(&|t| 3e-20 * (t * 7.0).sin());
    let book = EnergyBook {
        time: &time,
        input: &input,
        kinetic: &kinetic,
        elastic: &elastic,
        friction: &friction,
        damping: &damping,
        error: &error,
    };
    let figure = energy_figure("Where the energy went", &book);
    draw_everywhere("energy", &figure);
    // The areas end at the curve of the input.
    let drawing = draw_svg(&figure).unwrap();
    let [_, friction, stored, damping] = Theme::light().shades.map(hex);
    let fills = drawing.split("<polygon ").skip(1).map(|tag| value(tag, "fill"));
    let used =
        fills.into_iter().find(|fill| ![&friction, &stored, &damping].map(|it| it.as_str()).contains(fill));
    // Released energy has its own colour, below the curve of the losses.
    let used = polygons(&drawing, used.unwrap());
    let stored: Vec<_> = polygons(&drawing, &stored).into_iter().chain(used).collect();
    let line = polylines(&drawing, &hex(Theme::light().foreground))
        .into_iter()
        .find(|line| line.len() > 50)
        .unwrap();
    for (x, y) in line {
        let near = stored.iter().flatten().any(|p| (p.0 - x).abs() < 0.2 && (p.1 - y).abs() < 0.2);
        assert!(near, "the area ends elsewhere than at {x}, {y}");
    }
}

#[test]
fn phases() {
    // Approach to a limit cycle from inside, and a drive that travels.
    let cycle = |i: usize| {
        let angle = i as f64 * 0.02;
        let radius = 1e-6 * (1.0 - (-angle / 30.0).exp());
        (radius * angle.cos() * (1.0 + 0.1 * angle.sin()), -2e-3 * radius / 1e-6 * angle.sin())
    };
    let (x, v): (Vec<f64>, Vec<f64>) = (0..15_000).map(cycle).unzip();
    let other: Vec<f64> = x.iter().map(|x| 0.6 * x + 0.3e-6).collect();
    let paths = [
        PhasePath { name: "slider", coordinate: None, displacement: &x, velocity: &v },
        PhasePath { name: "stage", coordinate: None, displacement: &other, velocity: &v },
    ];
    let figure = phase_figure("Running into a limit cycle", &paths);
    draw_everywhere("phase", &figure);
    // Only the last cycle has the full colour: it is as wide as the whole, with far fewer points.
    let drawing = draw_svg(&figure).unwrap();
    let last: Vec<_> = polylines(&drawing, &hex(Theme::light().palette[0])).concat();
    let all = figure.panels[0].series.iter().map(|series| series.xs.len()).sum::<usize>();
    assert!(all > 29_000 && last.len() < 3000, "{} of {all} points", last.len());
    let ends = |points: &[(f64, f64)]| {
        let xs = points.iter().map(|point| point.0);
        xs.clone().fold(0.0, f64::max) - xs.fold(f64::INFINITY, f64::min)
    };
    assert!(ends(&last) > 1200.0, "{}", ends(&last));
    let walk: Vec<f64> = (0..15_000).map(|i| 2e-9 * i as f64).collect();
    let paths = [PhasePath { name: "walker", coordinate: None, displacement: &walk, velocity: &v }, paths[0]];
    draw_everywhere("phase-walk", &phase_figure("Two bodies of different reach", &paths));
    // The same motion in three coordinates: each has a panel and its own units.
    let coordinates = [None, Some(Coordinate::Height), Some(Coordinate::Pitch)];
    let paths = coordinates.map(|coordinate| PhasePath { coordinate, ..paths[1] });
    let figure = phase_figure("Three coordinates", &paths);
    draw_everywhere("phase-plane", &figure);
    let axes = figure.panels.iter().map(|panel| (panel.x.unit.as_str(), panel.y.unit.as_str()));
    assert_eq!(axes.collect::<Vec<_>>(), [("m", "m/s"), ("m", "m/s"), ("rad", "rad/s")]);
}

/// The curve p(h) of a contact at constant d after a history of u: play operators of half-width κ(d - h).
fn memory(history: &[f64], d: f64, slope: f64) -> (Vec<f64>, Vec<f64>) {
    let heights: Vec<f64> = (0..=300).map(|i| d * f64::from(i) / 300.0).collect();
    let anchor = |h: &f64| {
        let play = slope * (d - h);
        history.iter().fold(0.0_f64, |p, u| p.clamp(u - play, u + play))
    };
    let anchors = heights.iter().map(anchor).collect();
    (heights, anchors)
}

#[test]
fn memories() {
    let (d, slope) = (100e-9, 0.25);
    let turns = [0.8, -0.6, 0.5, -0.4, 0.3, -0.2, 0.9, -0.1, 0.05, 0.6, -0.7, 0.2].map(|u| u * slope * d);
    let curves: Vec<_> = (1..=turns.len()).map(|n| memory(&turns[..n], d, slope)).collect();
    let times: Vec<String> = (0..turns.len()).map(|n| format!("{} ms", 1.25 * n as f64)).collect();
    let moment = |n: usize, drift: f64| MemoryMoment {
        contact: "ball",
        time: &times[n],
        d,
        u: turns[n] + drift * n as f64,
        slope,
        h: &curves[n].0,
        p: &curves[n].1,
    };
    for count in [1, 2, 6, 12] {
        let moments: Vec<_> = (0..count).map(|n| moment(n, 0.0)).collect();
        draw_everywhere(&format!("memory-{count}"), &memory_figure("Memory of a contact", &moments));
    }
    // A drive: the same curves, shifted with its displacement.
    let carried: Vec<Vec<f64>> =
        (0..4).map(|n| curves[n].1.iter().map(|p| p + 1e-6 * n as f64).collect()).collect();
    let moments: Vec<_> = (0..4).map(|n| MemoryMoment { p: &carried[n], ..moment(n, 1e-6) }).collect();
    draw_everywhere("memory-drive", &memory_figure("Memory of a drive", &moments));
}

#[test]
fn memory_stays_in_its_wedge() {
    let (d, slope, u) = (100e-9, 0.25, -15e-9);
    let (h, p) = memory(&[20e-9, u], d, slope);
    let moment = MemoryMoment { contact: "ball", time: "1 s", d, u, slope, h: &h, p: &p };
    let figure = memory_figure("", &[moment]);
    let drawing = draw_svg(&figure).unwrap();
    let wedges = polygons(&drawing, &hex(Theme::light().shades[1]));
    let [wedge] = wedges.as_slice() else { panic!("{} wedges", wedges.len()) };
    let lines = polylines(&drawing, &hex(Theme::light().palette[0]));
    let curve = lines.iter().max_by_key(|line| line.len()).unwrap();
    // The wedge is a triangle whose apex is the end of the curve.
    let apex = wedge.iter().copied().fold((0.0, 0.0), |a, b| if b.0 > a.0 { b } else { a });
    let (left, top, bottom) = wedge
        .iter()
        .fold((f64::INFINITY, f64::INFINITY, 0.0_f64), |(l, t, b), p| (l.min(p.0), t.min(p.1), b.max(p.1)));
    let end = curve[curve.len() - 1];
    assert!((end.0 - apex.0).abs() < 0.3 && (end.1 - apex.1).abs() < 0.3, "{end:?} {apex:?}");
    for (x, y) in curve {
        let share = (apex.0 - x) / (apex.0 - left);
        let (high, low) = (apex.1 + share * (top - apex.1), apex.1 + share * (bottom - apex.1));
        assert!(*y > high - 0.5 && *y < low + 0.5, "{x}, {y} beyond {high}, {low}");
    }
    // p is plotted upwards: at h = 0 the curve, p = 0, lies above the apex at u < 0.
    assert!(curve[0].1 < apex.1);
}

#[test]
fn events() {
    let every = |period: f64, start: f64| -> Vec<f64> {
        (0..).map(|i| start + period * f64::from(i)).take_while(|t| *t <= 0.1).collect()
    };
    // Bursts of decreasing density, 90 000 events in all.
    let bursts = (0..90_000).map(|i| f64::from(i % 9) * 11e-3 + 5e-3 * (f64::from(i) / 90_000.0).powi(2));
    let track = |source, kind, times| EventTrack { source, kind, times };
    let tracks = [
        track("left ball", "reversal", every(1.3e-5, 0.0)),
        track("left ball", "gross slip begins again", every(1e-2, 9e-3)),
        track("right ball", "loop closed", bursts.collect()),
        track("right ball", "lift-off", vec![0.0333]),
        track("right ball", "touch", vec![]),
        track("drive", "corner", every(5e-3, 0.0)),
    ];
    draw_everywhere("events", &events_figure("A hundred thousand events", (0.0, 0.1), &tracks));
    assert_ticks_at_their_times(&events_figure("", (0.0, 0.1), &tracks));
    draw_everywhere("events-none", &events_figure("Nothing happened", (0.0, 0.1), &[]));
    let name = "a contact with a name far longer than anyone would write it";
    let many: Vec<_> = (0..40).map(|_| track(name, "gross slip ends", every(3e-3, 1e-3))).collect();
    draw_everywhere("events-many", &events_figure("Long names", (0.0, 0.1), &many));
}

/// The corners of the drive, every 5 ms from 0 to 100 ms, are marked from end to end of the frame. Dense events need few strokes.
fn assert_ticks_at_their_times(figure: &Figure<'_>) {
    let drawing = draw_svg(figure).unwrap();
    assert!(drawing.matches('<').count() < 1500 && drawing.len() < 200_000, "{} bytes", drawing.len());
    let corners = rectangles(&drawing, &hex(Theme::light().palette[2]));
    assert_eq!(corners.len(), 21);
    let middle = |r: &[f64; 4]| r[0] + r[2] / 2.0;
    let (start, end) = (middle(&corners[0]), middle(&corners[20]));
    for (i, corner) in corners.iter().enumerate() {
        assert!((middle(corner) - (start + (end - start) * i as f64 / 20.0)).abs() < 0.2, "{corner:?}");
    }
    // Reversals at a constant rate are one block over the full width; the bursts are nine blocks.
    let blocks = polygons(&drawing, &hex(Theme::light().palette[0]));
    let [block] = blocks.as_slice() else { panic!("{} blocks", blocks.len()) };
    let width = block.iter().map(|p| p.0).fold(0.0, f64::max) - block[0].0;
    assert!((width - (end - start)).abs() < 0.3, "{width}");
    assert_eq!(polygons(&drawing, &hex(Theme::light().palette[1])).len(), 9);
}

#[test]
fn comparisons() {
    let n = 5000;
    let time: Vec<f64> = (0..n).map(|i| 0.1 * f64::from(i) / f64::from(n)).collect();
    let ring = |decay: f64, scale: f64| -> Vec<f64> {
        time.iter().map(|t| scale * (-t * decay).exp() * (t * 600.0).sin()).collect()
    };
    let names = ["slider.x", "slider.vx", "ball.u", "ball.fx", "ball.fn", "energy.friction"];
    let units = ["m", "m/s", "m", "N", "N", "J"];
    let (a, b) = (ring(20.0, 1e-6), ring(20.4, 1e-6));
    let difference: Vec<f64> = a.iter().zip(&b).map(|(a, b)| b - a).collect();
    let channels: Vec<_> = names
        .iter()
        .zip(units)
        .map(|(name, unit)| ComparedChannel {
            name,
            unit,
            a: (&time, &a),
            b: (&time, &b),
            is_excerpt: false,
            difference: (&time, &difference),
        })
        .collect();
    for count in [1, 6] {
        let figure = compare_figure("Two runs", ("results/p1", "golden/p1"), &channels[..count]);
        draw_everywhere(&format!("compare-{count}"), &figure);
        let texts = texts(&draw_svg(&figure).unwrap());
        let is_named = |name: &str| texts.iter().any(|text| text.text == name);
        assert!(names[..count].iter().all(|name| is_named(name) && is_named(&format!("{name}, B − A"))));
        assert!(is_named("A: results/p1") && is_named("B: golden/p1"));
    }
}

#[test]
fn a_crowd_of_contacts_is_named_one_by_one() {
    let names: Vec<String> = (0..20).map(|i| format!("contact number {i}")).collect();
    let turn = |i: usize| (0..200).map(move |k| f64::from(k) * 0.0315 + i as f64 * 0.1);
    let data: Vec<(Vec<f64>, Vec<f64>)> =
        (0..20).map(|i| turn(i).map(|a| (1e-7 * a.cos(), 0.02 * (a + 0.4).sin())).unzip()).collect();
    let loops: Vec<_> = names
        .iter()
        .zip(&data)
        .map(|(name, (u, force))| HysteresisLoop {
            name,
            u,
            force,
            gross_slip: Some(5e-8),
            limit: Some(0.02),
        })
        .collect();
    let figure = loop_figure("Twenty contacts", &loops);
    draw_everywhere("loops-20", &figure);
    let texts = texts(&draw_svg(&figure).unwrap());
    assert!(names.iter().all(|name| texts.iter().any(|text| text.text == *name)));
    assert!(texts.iter().all(|text| !text.text.contains('…')));
    draw_everywhere("loops-none", &loop_figure("No contacts", &[]));
}

#[test]
fn where_there_is_nothing_the_picture_says_so() {
    let figures = [
        (loop_figure("", &[]), "no contacts"),
        (state_figure("", &[]), "no springs recorded"),
        (memory_figure("", &[]), "no memory recorded: the run did not reach any of the requested times"),
        (phase_figure("", &[]), "nothing moves"),
        (events_figure("", (0.0, 1.0), &[]), "no events"),
        (compare_figure("", ("a", "b"), &[]), "no channels to compare"),
    ];
    for (figure, words) in figures {
        let texts = texts(&draw_svg(&figure).unwrap());
        assert_eq!(texts.iter().map(|text| text.text.as_str()).collect::<Vec<_>>(), [words]);
    }
}

fn any_values() -> impl Strategy<Value = Vec<f64>> {
    let value = prop_oneof![6 => -1e-6..1e-6_f64, 1 => proptest::num::f64::ANY, 1 => Just(0.0)];
    proptest::collection::vec(value, 0..30)
}

/// Drawing succeeds or returns an error, equally for both formats.
fn assert_no_panic(figure: &Figure<'_>) {
    let small = Figure { size: (figure.size.0 / 4, figure.size.1 / 4), ..figure.clone() };
    assert_eq!(draw_png(&small).is_ok(), draw_svg(&small).is_ok());
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]
    #[test]
    fn no_data_make_a_builder_panic(a in any_values(), b in any_values(), c in any_values(), name in any::<String>()) {
        let at = |i: usize| a.get(i).copied().unwrap_or(0.0);
        let conditions = vec![SpringCondition::SlipForward; a.len() * c.len()];
        let map = SpringMap { name: &name, time: &a, x: &c, conditions: &conditions };
        assert_no_panic(&state_figure(&name, &[map]));
        let book = EnergyBook { time: &a, input: &b, kinetic: &a, elastic: &c, friction: &a, damping: &b, error: &a };
        assert_no_panic(&energy_figure(&name, &book));
        let path = |displacement, velocity| PhasePath { name: &name, coordinate: None, displacement, velocity };
        assert_no_panic(&phase_figure(&name, &[path(&a, &b), path(&a, &a), path(&c, &c)]));
        let moment = |i: usize| MemoryMoment { contact: &name, time: &name, d: at(i + 1), u: at(i + 2), slope: at(i + 3), h: &a, p: &a };
        assert_no_panic(&memory_figure(&name, &[moment(0), moment(3), moment(5)]));
        let track = |times: &[f64]| EventTrack { source: &name, kind: "touch", times: times.to_vec() };
        assert_no_panic(&events_figure(&name, (at(0), at(1)), &[track(&a), track(&b)]));
        let channel = ComparedChannel { name: &name, unit: "m", a: (&a, &a), b: (&b, &b), is_excerpt: false, difference: (&c, &c) };
        assert_no_panic(&compare_figure(&name, (&name, "b"), &[channel]));
    }
}
