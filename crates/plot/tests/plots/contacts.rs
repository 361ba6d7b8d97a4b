//! Figures of contacts, including unbounded pressure, open contacts and missing data.

use stickslip_plot::{
    AnchorMoment, FieldsMoment, FieldsZone, Figure, FrictionWork, HysteresisLoop, ProfilePair,
    SpringCondition, SubstituteMoment, Theme, anchors_figure, draw_png, draw_svg, fields_figure,
    friction_figure, marked_loop_figure, profile_figure, substitute_figure,
};

/// Texts of a figure, which is drawn in both themes and formats.
fn texts(mut figure: Figure<'_>) -> String {
    draw_png(&figure).unwrap();
    figure.theme = Theme::dark();
    draw_svg(&figure).unwrap()
}

const ZONES: [FieldsZone; 2] = [
    FieldsZone { radii: [0.0, 0.5e-6], condition: SpringCondition::Stick, frozen: true },
    FieldsZone { radii: [0.5e-6, 1e-6], condition: SpringCondition::SlipBackward, frozen: false },
];

#[test]
fn tips_are_gaps_and_rings_are_named_once() {
    let r: Vec<f64> = (0..40).map(|k| 0.03e-6 * f64::from(k)).collect();
    // Like a cone: pressure unbounded at the tip.
    let pressure: Vec<f64> = r.iter().map(|r| (1.0 - r / 1e-6).max(0.0) * 1e9 / r).collect();
    assert!(pressure[0].is_infinite());
    let moment = |heading| FieldsMoment {
        heading,
        r: &r,
        pressure: &pressure,
        shear: &pressure,
        displacement: &r,
        slip: &r,
        friction: 0.3,
        zones: &ZONES,
    };
    let drawn = texts(fields_figure("cone", &[moment("first"), moment("second")]));
    for (word, times) in [("slips −", 1), ("locked-in earlier slip", 1), ("first", 2), ("second", 2)] {
        assert_eq!(drawn.matches(word).count(), times, "{word}");
    }
}

#[test]
fn springs_show_their_widths_and_forces() {
    let x: Vec<f64> = (-30..=30).map(|k| 0.05e-6 * f64::from(k)).collect();
    let g: Vec<f64> = x.iter().map(|x| x * x / 1e-3).collect();
    let stretch: Vec<f64> = g.iter().map(|g| 0.2 * (1e-9 - g).max(0.0)).collect();
    let state = |g: &f64| if *g < 1e-9 { SpringCondition::SlipForward } else { SpringCondition::Open };
    let conditions: Vec<SpringCondition> = g.iter().map(state).collect();
    let moment = SubstituteMoment {
        heading: "now",
        d: 1e-9,
        radii: (1e-6, 0.4e-6),
        scale: 1e-6,
        deepest: 1e-9,
        largest_stretch: 2e-10,
        forces: (0.3, -0.02),
        limit: 0.06,
        x: &x,
        g: &g,
        stretch: &stretch,
        conditions: &conditions,
    };
    let drawn = texts(substitute_figure("springs", std::slice::from_ref(&moment)));
    for word in ["2a = 2 µm", "2c = 800 nm", "= 300 mN", "= −20 mN", "slips +", "open"] {
        assert!(drawn.contains(word), "{word}");
    }
    assert!(!drawn.contains("slips −") && !drawn.contains("\nsticks\n"));
    // In gross slip there is no width 2c; open contacts have no width 2a either.
    let open = SubstituteMoment { radii: (0.0, 0.0), d: -1e-9, forces: (0.0, 0.0), ..moment };
    let drawn = texts(substitute_figure("springs", &[open]));
    assert!(!drawn.contains("2c") && !drawn.contains("2a"));
}

#[test]
fn what_is_not_there_is_said() {
    assert!(texts(fields_figure("f", &[])).contains("no fields"));
    assert!(texts(substitute_figure("s", &[])).contains("the contact is always open"));
    assert!(texts(anchors_figure("a", &[])).contains("no memory"));
    let springs = FrictionWork { axis: ("time t", "s"), moments: &[], r: &[], work: &[], marks: &[] };
    assert!(texts(friction_figure("w", &springs)).contains("no friction work per area"));
    let work = FrictionWork { moments: &[0.0], r: &[0.0, 1e-6], work: &[0.0, 0.0], ..springs };
    assert!(texts(friction_figure("w", &work)).contains("no slip"));
    let pair = ProfilePair { x: &[], f: None, g: &[], d: 0.0, a: 0.0 };
    assert!(texts(profile_figure("p", &pair)).contains("no data"));
}

#[test]
fn moments_are_marked_and_anchors_lie_in_their_wedge() {
    let (u, force) = ([0.0, 1e-8, -1e-8], [0.0, 0.05, -0.05]);
    let course =
        HysteresisLoop { name: "path", u: &u, force: &force, gross_slip: Some(4e-8), limit: Some(0.06) };
    let marks = [(1e-8, 0.05, "corner one".to_owned()), (-1e-8, -0.05, "corner two".to_owned())];
    let drawn = texts(marked_loop_figure("loop", course, &marks));
    assert!(drawn.contains("corner one") && drawn.contains("corner two"));
    let corners = [(0.0, 0.0), (5e-8, 0.0), (1e-7, 1e-8)];
    let moment = AnchorMoment {
        heading: "then",
        apex: (1e-7, 1e-8),
        slope: 0.2,
        corners: &corners,
        x: &[-1e-6, 0.0, 1e-6],
        g: &[1e-7, 0.0, 1e-7],
        p: &[1e-8, 0.0, 1e-8],
    };
    assert!(texts(anchors_figure("memory", &[moment])).contains("apex (d, u)"));
    let marks = [(1.0, "end".to_owned())];
    let work = FrictionWork {
        axis: ("corner", ""),
        moments: &[0.5, 1.0],
        r: &[0.0, 1e-6],
        work: &[0.0, 1.0, f64::INFINITY, 2.0],
        marks: &marks,
    };
    assert!(texts(friction_figure("work", &work)).contains("≤ 2 J/m²"));
}
