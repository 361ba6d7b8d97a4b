//! Drawings of models: true to scale, no text cut or overlapping texts and lines. They are drawn in both themes and at several sizes.

use crate::drawn::{Text, assert_texts_apart, draw_everywhere, texts, value};
use proptest::prelude::*;
use stickslip_plot::{
    Amount, Figure, Fixture, LinkKind, Mobility, Press, Scene, SceneBody, SceneContact, SceneGravity,
    SceneLink, SceneLoad, Theme, draw_png, draw_svg, layout_figure,
};

const NOTHING: Amount<'static> = Amount::Constant(0.0);

fn body<'a>(name: &'a str, moves: [Mobility<'a>; 3]) -> SceneBody<'a> {
    let mass = moves.contains(&Mobility::Free).then_some(0.05);
    SceneBody { name, mass, x: moves[0], z: moves[1], pitch: moves[2] }
}

/// `FREE` moves in all coordinates, `DRIVEN` follows a waveform along x, `SLIDER` is free along x only.
const FREE: [Mobility<'static>; 3] = [Mobility::Free; 3];
const DRIVEN: [Mobility<'static>; 3] = [Mobility::Follows("drive"), Mobility::Fixed, Mobility::Fixed];
const SLIDER: [Mobility<'static>; 3] = [Mobility::Free, Mobility::Fixed, Mobility::Fixed];

fn at(body: usize, x: f64, z: f64) -> Fixture {
    Fixture { body: Some(body), at: (x, z) }
}

const GROUND: Fixture = Fixture { body: None, at: (0.0, 0.0) };

/// Paraboloid r²/2R up to r = R.
fn paraboloid(radius: f64) -> Vec<(f64, f64)> {
    (0..=24).map(|k| radius * f64::from(k) / 24.0).map(|r| (r, r * r / (2.0 * radius))).collect()
}

fn contact(name: &str, between: [Fixture; 2], radius: f64) -> SceneContact<'_> {
    SceneContact { name, between, profile: paraboloid(radius), press: Press::Coupled, count: 1 }
}

fn spring(name: &str, between: [Fixture; 2], is_upright: bool, preload: f64) -> SceneLink<'_> {
    let kind = LinkKind::Spring { is_stiff: true, is_damped: false };
    SceneLink { name, between, is_upright, kind, preload }
}

fn load<'a>(body: usize, at: (f64, f64), forces: [Amount<'a>; 3]) -> SceneLoad<'a> {
    SceneLoad { body, at, x: forces[0], z: forces[1], pitch: forces[2] }
}

/// Stage on balls, with all kinds of links and loads.
fn stage(reach: f64, height: f64) -> Scene<'static> {
    Scene {
        bodies: vec![body("foot", DRIVEN), body("stage", FREE), body("counter-mass", SLIDER)],
        contacts: vec![
            contact("front", [at(0, 0.0, 0.0), at(1, reach, -height)], 0.1 * reach),
            SceneContact {
                count: 2,
                ..contact("rear", [at(0, 0.0, 0.0), at(1, -reach, -height)], 0.1 * reach)
            },
        ],
        links: vec![
            spring("clamp", [GROUND, at(1, 0.0, 0.0)], true, -1.5),
            SceneLink {
                name: "piezo",
                between: [at(1, 0.0, 0.0), at(2, 0.0, 0.0)],
                is_upright: false,
                kind: LinkKind::Stack(Amount::Follows("drive")),
                preload: 0.0,
            },
            SceneLink {
                kind: LinkKind::Spring { is_stiff: true, is_damped: true },
                ..spring("suspension", [GROUND, at(1, -0.5 * reach, 0.0)], false, 2.0)
            },
        ],
        loads: vec![
            load(1, (0.6 * reach, 0.2 * height), [NOTHING, Amount::Constant(-0.3), NOTHING]),
            load(1, (0.0, 0.5 * height), [Amount::Follows("shaker"), NOTHING, NOTHING]),
            load(2, (0.0, 0.0), [NOTHING, NOTHING, Amount::Constant(-2e-3)]),
        ],
        gravity: Some(SceneGravity { acceleration: 9.81, incline: 0.5 }),
    }
}

/// Bodies without given points.
fn plain() -> Scene<'static> {
    let force = |newtons: f64| Press::Force(Amount::Constant(newtons));
    let between = [at(0, 0.0, 0.0), at(1, 0.0, 0.0)];
    Scene {
        bodies: vec![body("foot", DRIVEN), body("slider", SLIDER)],
        contacts: vec![SceneContact { press: force(0.3), count: 3, ..contact("ball", between, 5e-4) }],
        loads: vec![load(1, (0.0, 0.0), [Amount::Constant(-0.02), NOTHING, NOTHING])],
        ..Scene::default()
    }
}

/// Rod on two feet, with a lid above it and a spring between the feet.
fn walker() -> Scene<'static> {
    let foot = [Mobility::Follows("stride"), Mobility::Follows("lift"), Mobility::Fixed];
    let point = |body: usize| at(body, 0.0, 0.0);
    Scene {
        bodies: vec![
            body("left foot", foot),
            body("right foot", foot),
            body("rod", FREE),
            body("lid", DRIVEN),
        ],
        contacts: vec![
            contact("left", [point(0), point(2)], 2e-3),
            contact("right", [point(1), point(2)], 2e-3),
            SceneContact {
                press: Press::Indentation(Amount::Follows("depth")),
                ..contact("above", [point(2), point(3)], 1e-3)
            },
        ],
        links: vec![
            spring("bridge", [point(0), point(1)], false, 0.0),
            spring("loop", [point(2), point(3)], false, 0.0),
        ],
        ..Scene::default()
    }
}

/// Figures of several models, by name.
fn specimens() -> Vec<(&'static str, Figure<'static>)> {
    let ball = Scene {
        bodies: vec![body("ball", FREE)],
        contacts: vec![contact("foot", [GROUND, at(0, 0.0, -5e-3)], 5e-3)],
        gravity: Some(SceneGravity { acceleration: 9.81, incline: 0.0 }),
        ..Scene::default()
    };
    let ceiling = Scene {
        bodies: vec![body("rig", DRIVEN)],
        contacts: vec![SceneContact {
            profile: Vec::new(),
            ..contact("cone", [at(0, 0.0, 0.0), GROUND], 1.0)
        }],
        ..Scene::default()
    };
    let fixed = Scene { bodies: vec![body("block", [Mobility::Fixed; 3])], ..Scene::default() };
    vec![
        ("stage", layout_figure("A stage with everything", &stage(12e-3, 6e-3))),
        ("stage-small", layout_figure("The same, a thousand times smaller", &stage(12e-6, 6e-6))),
        ("plain", layout_figure("Bodies without points", &plain())),
        ("walker", layout_figure("Feet below and a lid above", &walker())),
        ("ball", layout_figure("A ball", &ball)),
        ("ceiling", layout_figure("Nothing has a length", &ceiling)),
        ("fixed", layout_figure("A single block", &fixed)),
        ("flat", layout_figure("A sliver along the slide", &stage(50e-3, 1e-3))),
        ("tall", layout_figure("A sliver normal to the slide", &stage(1e-3, 50e-3))),
    ]
}

/// Polylines of a drawing, px.
fn lines(drawing: &str) -> Vec<Vec<(f64, f64)>> {
    let number = |text: &str| text.parse::<f64>().unwrap() / 8.0;
    let point = |pair: &str| pair.split_once(',').map(|(x, y)| (number(x), number(y))).unwrap();
    let tags = drawing.split("<polyline ").skip(1);
    tags.map(|tag| value(tag, "points").split_whitespace().map(point).collect()).collect()
}

/// Whether a line segment intersects the inside of a rectangle (clipping by Liang and Barsky).
fn meets([(x, y), (to_x, to_y)]: [(f64, f64); 2], [left, top, right, bottom]: [f64; 4]) -> bool {
    let (mut from, mut to) = (0.0_f64, 1.0_f64);
    for (way, start, low, high) in [(to_x - x, x, left, right), (to_y - y, y, top, bottom)] {
        if way == 0.0 {
            if start <= low || start >= high {
                return false;
            }
            continue;
        }
        let (a, b) = ((low - start) / way, (high - start) / way);
        from = from.max(a.min(b));
        to = to.min(a.max(b));
    }
    from < to
}

#[test]
fn texts_are_whole_and_cover_neither_texts_nor_lines() {
    for (name, figure) in specimens() {
        draw_everywhere(&format!("scene-{name}"), &figure);
        let drawing = draw_svg(&figure).unwrap();
        let lines = lines(&drawing);
        assert!(lines.len() > 2, "{name}");
        for text in texts(&drawing) {
            for line in &lines {
                let meets = line.windows(2).any(|pair| meets([pair[0], pair[1]], text.area));
                assert!(!meets, "{name}: {text:?} {line:?}");
            }
        }
    }
}

/// Px per unit of an axis and px of its zero, from its numbers.
fn axis(texts: &[Text], is_number_of: impl Fn(&Text) -> bool, middle: impl Fn(&Text) -> f64) -> (f64, f64) {
    let numbers = texts.iter().filter(|text| is_number_of(text));
    let numbers: Vec<(f64, f64)> = numbers
        .filter_map(|text| Some((text.text.replace('−', "-").parse::<f64>().ok()?, middle(text))))
        .collect();
    let (first, last) = (numbers[0], numbers[numbers.len() - 1]);
    let scale = (last.1 - first.1) / (last.0 - first.0);
    (scale, first.1 - scale * first.0)
}

/// Scales and zeros of both axes of a figure, and its texts.
fn axes(drawing: &str) -> ([(f64, f64); 2], Vec<Text>) {
    let texts = texts(drawing);
    let lowest = texts.iter().map(|text| text.area[3]).fold(0.0, f64::max);
    let is_below = |text: &Text| text.area[3] > lowest - 75.0;
    let is_left = |text: &Text| text.area[2] < 180.0 && !is_below(text);
    let x = axis(&texts, is_below, |text| f64::midpoint(text.area[0], text.area[2]));
    let z = axis(&texts, is_left, |text| f64::midpoint(text.area[1], text.area[3]));
    ([x, z], texts)
}

/// Points drawn as discs of a radius, px.
fn discs(drawing: &str, theme: &Theme, width: f64) -> Vec<(f64, f64)> {
    // 1.6 line widths.
    let radius = (1.6 * width * theme.line * 8.0).round();
    let number = |tag: &str, key: &str| value(tag, key).parse::<f64>().unwrap();
    let tags = drawing.split("<circle ").skip(1).filter(|tag| number(tag, " r") == radius);
    tags.map(|tag| (number(tag, "cx") / 8.0, number(tag, "cy") / 8.0)).collect()
}

#[test]
fn points_and_profiles_are_to_scale() {
    let figure = layout_figure("", &stage(12e-3, 6e-3));
    let drawing = draw_svg(&figure).unwrap();
    let ([(px_x, x_0), (px_z, z_0)], _) = axes(&drawing);
    // Positions of numbers are rounded to whole pixels.
    assert!((px_x / -px_z - 1.0).abs() < 0.01, "{px_x} {px_z}");
    let mm = |(x, y): (f64, f64)| ((x - x_0) / px_x, (y - z_0) / px_z);
    let contacts: Vec<(f64, f64)> = discs(&drawing, &figure.theme, 1.1).into_iter().map(mm).collect();
    let near = |a: (f64, f64), b: (f64, f64)| (a.0 - b.0).abs() < 0.08 && (a.1 - b.1).abs() < 0.08;
    assert!(near(contacts[0], (12.0, 0.0)) && near(contacts[1], (-12.0, 0.0)), "{contacts:?}");
    // The reference point of the stage is 6 mm above the contacts; loads act there and higher.
    let points: Vec<(f64, f64)> = discs(&drawing, &figure.theme, 0.9).into_iter().map(mm).collect();
    for wanted in [(0.0, 6.0), (7.2, 7.2), (0.0, 9.0), (-6.0, 6.0)] {
        assert!(points.iter().any(|point| near(*point, wanted)), "{wanted:?} of {points:?}");
    }
    // R = 1.2 mm.
    let feet: Vec<Vec<(f64, f64)>> = lines(&drawing).into_iter().filter(|line| line.len() == 51).collect();
    assert_eq!(feet.len(), 2);
    for point in feet[0][1..50].iter().map(|&point| mm(point)) {
        let want = (point.0 - 12.0).powi(2) / 2.4;
        assert!((point.1 - want).abs() < 0.08, "{point:?}");
    }
    assert!(near(mm(feet[0][1]), (10.8, 0.6)) && near(mm(feet[0][49]), (13.2, 0.6)));
}

#[test]
fn a_sliver_is_stretched_and_says_so() {
    for (scene, places, says, stretch) in [
        (stage(50e-3, 1e-3), [0, 1], "height z, enlarged 10 times (mm)", 10.0),
        (stage(1e-3, 50e-3), [1, 0], "x along the slide, enlarged 10 times (mm)", 10.0),
    ] {
        let drawing = draw_svg(&layout_figure("", &scene)).unwrap();
        let (axes, texts) = axes(&drawing);
        let ratio = axes[places[1]].0.abs() / axes[places[0]].0.abs();
        assert!((ratio / stretch - 1.0).abs() < 0.02, "{ratio}");
        assert!(texts.iter().any(|text| text.text == says), "{says}");
    }
}

#[test]
fn what_has_no_length_has_no_numbers() {
    let specimens = specimens();
    let (_, figure) = specimens.iter().find(|(name, _)| *name == "ceiling").unwrap();
    let texts = texts(&draw_svg(figure).unwrap());
    let said: Vec<&str> = texts.iter().map(|text| text.text.as_str()).collect();
    assert!(said.contains(&"x along the slide, not to scale") && said.contains(&"height z, not to scale"));
    assert!(said.iter().all(|text| text.parse::<f64>().is_err()), "{said:?}");
}

#[test]
fn a_picture_says_what_it_shows() {
    let drawing = draw_svg(&layout_figure("", &stage(12e-3, 6e-3))).unwrap();
    let said: Vec<String> = texts(&drawing).into_iter().map(|text| text.text).collect();
    for text in [
        "front",
        "rear × 2",
        "stage",
        "50 g",
        "foot",
        "x: drive",
        "clamp",
        "1.5 N",
        "piezo",
        "s: drive",
        "300 mN",
        "F: shaker",
        "2 mN m",
        "g = 9.81 m/s²",
        "incline 28.65°",
        "free along ↔",
        "follows a waveform along ↔",
        "2 N",
    ] {
        assert!(said.iter().any(|said| said == text), "{text} in {said:?}");
    }
    let plain: Vec<String> =
        texts(&draw_svg(&layout_figure("", &plain())).unwrap()).into_iter().map(|text| text.text).collect();
    assert!(plain.contains(&"3 × 300 mN".to_owned()) && plain.contains(&"20 mN".to_owned()), "{plain:?}");
}

#[test]
fn a_crowd_is_drawn_as_far_as_it_goes() {
    let names: Vec<String> = (0..60).map(|i| format!("slider number {i}")).collect();
    let crowd = |count: usize| Scene {
        bodies: names[..count].iter().map(|name| body(name, SLIDER)).collect(),
        contacts: (0..count).map(|i| contact("contact", [GROUND, at(i, 0.0, 0.0)], 1e-3)).collect(),
        ..Scene::default()
    };
    let figure = layout_figure("Sixty sliders", &crowd(60));
    draw_everywhere("scene-crowd", &figure);
    let said = texts(&draw_svg(&figure).unwrap());
    assert!(said.iter().any(|text| text.text.starts_with("and ") && text.text.ends_with(" more")));
    draw_everywhere("scene-seven", &layout_figure("Seven sliders", &crowd(7)));
    let many = Scene { loads: vec![load(0, (0.0, 0.0), [NOTHING; 3]); 300], ..crowd(1) };
    for (scene, words) in [(many, "302 parts: too many to be drawn"), (Scene::default(), "no bodies")] {
        let drawing = draw_svg(&layout_figure("", &scene)).unwrap();
        assert!(texts(&drawing).iter().any(|text| text.text == words));
    }
}

/// Points at 1 mm and at 1 nm: the drawing is wider than the maximum frame.
#[test]
fn a_drawing_that_is_far_too_wide_is_framed() {
    let scene = Scene {
        bodies: vec![
            body("nine letters or more", FREE),
            body("", DRIVEN),
            body("b", SLIDER),
            body("c", [Mobility::Fixed; 3]),
        ],
        contacts: vec![contact("contact", [at(1, 0.0, 1e-3), GROUND], 1e-3)],
        links: vec![spring("0", [GROUND, at(0, 1e-9, 0.0)], true, 0.0)],
        loads: Vec::new(),
        gravity: None,
    };
    let figure = layout_figure("Far apart", &scene);
    draw_png(&figure).unwrap();
    assert_texts_apart(&figure);
}

prop_compose! {
    fn any_fixture(bodies: usize)(
        body in prop_oneof![1 => Just(None), 4 => (0..bodies).prop_map(Some)],
        at in (-4_i32..5, -4_i32..5),
        size in prop_oneof![3 => Just(0.0), 3 => Just(1e-3), 1 => Just(1e-9), 1 => Just(1e200)],
    ) -> Fixture {
        Fixture { body, at: (f64::from(at.0) * size, f64::from(at.1) * size) }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, ..ProptestConfig::default() })]

    /// Even arbitrary models are drawn without overlapping texts.
    #[test]
    fn any_scene_is_drawn(
        between in proptest::collection::vec([any_fixture(4), any_fixture(4)], 0..8),
        radius in prop_oneof![Just(1e-3), Just(1e-12), Just(1e9)],
        force in prop_oneof![Just(0.0), Just(-1.0), Just(f64::MAX)],
    ) {
        let (contacts, links) = between.split_at(between.len() / 2);
        let name = "nine letters or more";
        let scene = Scene {
            bodies: vec![body(name, FREE), body("", DRIVEN), body("b", SLIDER), body("c", [Mobility::Fixed; 3])],
            contacts: contacts.iter().map(|between| contact("contact", *between, radius)).collect(),
            links: links.iter().enumerate().map(|(i, between)| spring(name, *between, i % 2 == 0, force)).collect(),
            loads: links.iter().filter_map(|[side, _]| {
                Some(load(side.body?, side.at, [Amount::Constant(force); 3]))
            }).collect(),
            gravity: None,
        };
        let figure = layout_figure("Any scene", &scene);
        draw_png(&figure).unwrap();
        assert_texts_apart(&figure);
    }
}
