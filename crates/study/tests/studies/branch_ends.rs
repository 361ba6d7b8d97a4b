//! Ends of branches for randomly drawn sliders, compared with closed forms.

use std::collections::BTreeMap;
use std::error::Error;
use std::path::PathBuf;
use stickslip_run::Job;
use stickslip_scenario::Scenario;
use stickslip_study::steady::Options;
use stickslip_study::steady::continuation::{
    Bifurcation, Branch, Continuation, ContinuationError, Course, End,
};

type Checked = Result<(), Box<dyn Error>>;

/// A slider on a foot that follows a waveform.
struct Slider {
    /// The waveform "drive", and others.
    waveforms: &'static str,
    /// kg.
    mass: f64,
    /// Radius of the ball, m.
    radius: f64,
    friction: f64,
    /// Normal force, N, or the waveform that it follows.
    normal: &'static str,
    /// Load along x, N.
    load: f64,
    /// Other keys of the scenario.
    more: &'static str,
}

impl Slider {
    fn job(&self) -> Result<Job, Box<dyn Error>> {
        let Self { waveforms, mass, radius, friction, normal, load, more } = self;
        let text = format!(
            r#"{{
                "stickslip": 1,
                "materials": {{"steel": {{"youngs_modulus": 210e9, "poisson_ratio": 0.3}}}},
                "waveforms": {{{waveforms}}},
                "bodies": {{"foot": {{"x": {{"follows": "drive"}}}}, "slider": {{"mass": {mass:e}, "x": "free"}}}},
                "contacts": {{"ball": {{
                    "between": ["foot", "slider"], "materials": ["steel", "steel"],
                    "profile": {{"paraboloid": {{"radius": {radius:e}}}}},
                    "friction": {friction:e}, "normal": {{"force": {normal}}}
                }}}},
                "loads": [{{"on": "slider", "x": {load:e}}}],
                {more}
                "figures": {{"waveform": "drive", "body": "slider"}},
                "run": {{"cycles": 20, "stepper": {{"event": {{"tolerance": 1e-10}}}}}}
            }}"#
        );
        let scenario = Scenario::from_str_alone(&text, "slider")?;
        Ok(Job::new(scenario, "slider".to_owned(), PathBuf::new())?)
    }

    fn branch(&self, path: &str, range: [f64; 2]) -> Result<Branch, Box<dyn Error>> {
        Ok(Continuation::new(self.job()?, path, range)?.follow(&Course::default())?)
    }
}

const LOAD: &str = "loads[0].x";
const FORCE: &str = "contacts.ball.normal.force";

/// Also held by a spring. The structure of its slip memory on the orbit differs from that at the start of the search.
const HELD: Slider = Slider {
    waveforms: r#""drive": {"trapezoid": {"stroke": 9.117e-9, "rise": 0.0113663, "hold": 9.47195e-4, "fall": 0.00568317, "period": 0.0189439}}"#,
    mass: 12.6089,
    radius: 3.787802e-4,
    friction: 0.08,
    normal: "0.05675978",
    load: 1.816313e-3,
    more: r#""springs": {"d": {"between": ["ground", "slider"], "direction": "x", "stiffness": 9862.1319, "damping": 0.35263}},"#,
};

/// The normal force oscillates with the period of the foot.
const PRESSED: Slider = Slider {
    waveforms: r#""drive": {"sine": {"amplitude": 6.418283206544569e-7, "period": 0.0010730889986615324}},
        "press": {"sine": {"amplitude": 0.15957865331120755, "period": 0.0010730889986615324, "phase": 4.002211407804633, "offset": 0.26596442218534594}}"#,
    mass: 0.22496449009726718,
    radius: 7.038772377274853e-4,
    friction: 0.3,
    normal: r#"{"follows": "press"}"#,
    load: -0.06383146132448303,
    more: "",
};

/// Trapezoid; the load is 40 % of the friction limit.
const PULLED: Slider = Slider {
    waveforms: r#""drive": {"trapezoid": {"stroke": 4.032803299487651e-7, "rise": 9.895906405260225e-4, "hold": 8.246588671050188e-5, "fall": 9.895906405260224e-5, "period": 0.0016493177342100374}}"#,
    mass: 0.17507211550774796,
    radius: 0.0027931303493771327,
    friction: 0.15,
    normal: "1.134640595015338",
    load: 0.06807843570092027,
    more: "",
};

/// Sine; the load is 80 % of the friction limit.
const DRAGGED: Slider = Slider {
    waveforms: r#""drive": {"sine": {"amplitude": 2.3413614487428988e-7, "period": 0.0017359235839901955}}"#,
    mass: 0.22159392240291798,
    radius: 0.0023497579180757357,
    friction: 0.9,
    normal: "0.14624297013372406",
    load: 0.10529493849628134,
    more: "",
};

/// Cycloid; the load is 80 % of the friction limit.
const SWEPT: Slider = Slider {
    waveforms: r#""drive": {"cycloid": {"stroke": 2.74478793716773e-8, "flyback": 0.00256132511688786, "period": 0.0256132511688786}}"#,
    mass: 0.13890905692718117,
    radius: 3.616350858754622e-4,
    friction: 0.15,
    normal: "0.18103361483236785",
    load: 0.02172403377988414,
    more: "",
};

/// Trapezoid; the load is -80 % of the friction limit. Near the limit, gross slip events appear and vanish frequently.
const HELD_BACK: Slider = Slider {
    waveforms: r#""drive": {"trapezoid": {"stroke": 9.442806301183679e-8, "rise": 6.352485154329077e-5, "hold": 5.293737628607564e-6, "fall": 1.905745546298723e-5, "period": 1.0587475257215128e-4}}"#,
    mass: 1.4786533858320991e-5,
    radius: 6.632489651944627e-4,
    friction: 0.08,
    normal: "4.869762656393218",
    load: -0.31166481000916596,
    more: "",
};

/// The normal force oscillates with the period of the foot; the load is -80 % of the mean friction limit.
const SQUEEZED: Slider = Slider {
    waveforms: r#""drive": {"sine": {"amplitude": 4.971388967257197e-8, "period": 0.001329620376180839}},
        "press": {"sine": {"amplitude": 0.1104989948770782, "period": 0.001329620376180839, "phase": 2.7177771864437354, "offset": 0.18416499146179702}}"#,
    mass: 0.0017246456948788915,
    radius: 4.5839206686720753e-4,
    friction: 0.08,
    normal: r#"{"follows": "press"}"#,
    load: -0.01178655945355501,
    more: "",
};

/// Trapezoid; the load is -40 % of the friction limit.
const LOADED: Slider = Slider {
    waveforms: r#""drive": {"trapezoid": {"stroke": 6.634095312135536e-7, "rise": 6e-4, "hold": 5e-5, "fall": 1e-4, "period": 1e-3}}"#,
    mass: 0.016733347499236488,
    radius: 0.0010219344200093619,
    friction: 0.08,
    normal: "7.850537662031753",
    load: -0.2512172051850161,
    more: "",
};

/// A ball thrown up by a vibrating table that also moves horizontally.
const BOUNCING: &str = r#"{
    "stickslip": 1,
    "materials": {"steel": {"youngs_modulus": "210 GPa", "poisson_ratio": 0.3}},
    "waveforms": {
        "table": {"sine": {"amplitude": 7.5e-6, "frequency": "200 Hz"}},
        "stride": {"sine": {"amplitude": "3 um", "frequency": "200 Hz", "phase": "60 deg"}}
    },
    "bodies": {
        "table": {"x": {"follows": "stride"}, "z": {"follows": "table"}},
        "ball": {"mass": "10 g", "x": "free", "z": "free"}
    },
    "contacts": {"foot": {
        "between": ["table", "ball"], "materials": ["steel", "steel"], "profile": {"paraboloid": {"radius": "5 mm"}},
        "friction": 0.2, "normal": "coupled", "damping": "100 us"
    }},
    "gravity": {},
    "figures": {"waveform": "table", "body": "ball"},
    "run": {"cycles": 300, "start": "equilibrium", "stepper": {"event": {"tolerance": 1e-10}}}
}"#;

/// A slider between its foot and a guide with friction.
const GUIDED: &str = r#"{
    "stickslip": 1,
    "materials": {"steel": {"youngs_modulus": 210e9, "poisson_ratio": 0.3}},
    "waveforms": {"drive": {"trapezoid": {
        "stroke": 1.1153847354713443e-6, "rise": 5.135838905745581e-3, "hold": 4.279865754787985e-4, "fall": 2.5679194528727906e-3,
        "period": 8.55973150957597e-3
    }}},
    "bodies": {"foot": {"x": {"follows": "drive"}}, "slider": {"mass": 3.0590896813594735, "x": "free"}},
    "contacts": {
        "ball": {
            "between": ["foot", "slider"], "materials": ["steel", "steel"], "profile": {"paraboloid": {"radius": 4.253200135519673e-3}},
            "friction": 0.15, "normal": {"force": 13.492378889166558}
        },
        "guide": {
            "between": ["ground", "slider"], "materials": ["steel", "steel"], "profile": {"paraboloid": {"radius": 4.253200135519673e-3}},
            "friction": 0.07366877452602237, "normal": {"force": 6.6555017474344345}
        }
    },
    "loads": [{"on": "slider", "x": 1.6190854666999868}],
    "figures": {"waveform": "drive", "body": "slider"},
    "run": {"cycles": 20, "stepper": {"event": {"tolerance": 1e-10}}}
}"#;

/// Checks the consistency of a branch: multipliers at special points, and changes at events. If the parameter increases
/// along the branch, event counts of successive special points must match.
fn is_sound(branch: &Branch) -> Checked {
    let mut counts = BTreeMap::new();
    let rises = branch.points.windows(2).all(|pair| pair[0].value <= pair[1].value);
    for mark in branch.marks.iter().filter(|_| rises) {
        let Bifurcation::Event(changes) = &mark.kind else { continue };
        for change in changes {
            let before = counts.insert((change.source.as_str(), change.kind.as_str()), change.above);
            if before.is_some_and(|count| count != change.below) {
                return Err(format!("{before:?} above the one before, and then {mark:?}").into());
            }
        }
    }
    for mark in &branch.marks {
        let there = |at: f64| {
            let near = branch.points.iter().filter(|point| point.value == mark.value);
            near.flat_map(|point| &point.multipliers).any(|m| (m.re - at).hypot(m.im) < 0.01)
        };
        let sound = match &mark.kind {
            Bifurcation::Fold | Bifurcation::Branching => there(1.0),
            Bifurcation::PeriodDoubling => there(-1.0),
            Bifurcation::Event(changes) => {
                !changes.is_empty() && changes.iter().all(|change| change.below != change.above)
            }
            Bifurcation::NeimarkSacker { .. } | Bifurcation::Break(_) => true,
        };
        if !sound {
            return Err(format!("{mark:?}").into());
        }
    }
    Ok(())
}

/// A branch with memory at its start is followed, or an error gives the reason.
#[test]
fn memories_of_another_form_are_met() -> Checked {
    for (slider, range) in [(HELD, [0.0, 5.4489e-3]), (PRESSED, [-0.1915, 0.0])] {
        let followed = Continuation::new(slider.job()?, LOAD, range)?.follow(&Course::default());
        match followed {
            Ok(branch) => is_sound(&branch)?,
            Err(ContinuationError::NoBranch { .. } | ContinuationError::Shakedown { .. }) => {}
            Err(error) => return Err(error.into()),
        }
    }
    Ok(())
}

/// At a load of μ F_N any velocity is possible, and the branch ends.
#[test]
fn a_branch_ends_where_the_load_is_what_friction_holds() -> Checked {
    let away = End::SlidesAway("slider".to_owned());
    let branch = PULLED.branch(FORCE, [0.378, 3.404])?;
    is_sound(&branch)?;
    let (end, least) = (branch.points.first().ok_or("a motion")?, PULLED.load / PULLED.friction);
    assert_eq!(branch.ends, [away.clone(), End::Range]);
    assert!((end.value - least).abs() < 1e-5 * least, "{:e} {least:e}", end.value);

    let branch = DRAGGED.branch(LOAD, [0.0, 0.3159])?;
    is_sound(&branch)?;
    let (end, most) = (branch.points.last().ok_or("a motion")?, DRAGGED.friction * 0.14624297013372406);
    assert_eq!(branch.ends[1], away);
    assert!((end.value - most).abs() < 1e-8 * most, "{:e} {most:e}", end.value);
    assert!(branch.points.len() < 200, "{}", branch.points.len());
    Ok(())
}

/// Many events occur near the friction limit, but the branch continues to this load.
#[test]
#[ignore = "takes long: .ci/full"]
fn a_branch_does_not_turn_back_where_multipliers_are_small() -> Checked {
    let range = 0.06517;
    let branch = SWEPT.branch(LOAD, [0.0, range])?;
    is_sound(&branch)?;
    assert_eq!(branch.ends[1], End::SlidesAway("slider".to_owned()));
    let (end, most) = (branch.points.last().ok_or("a motion")?, SWEPT.friction * 0.18103361483236785);
    // Lengths along a branch are relative to the range.
    assert!((end.value - most).abs() < 1e-8 * range, "{:e} {most:e}", end.value);
    let rises = branch.points.windows(2).all(|pair| pair[0].value < pair[1].value);
    assert!(rises && branch.marks.iter().all(|mark| mark.kind.name() == "event"));
    Ok(())
}

/// The friction of the foot decreases. The branch does not turn back at an event without a multiplier beyond 1 on
/// either side. It continues until the friction of foot and guide equals the load.
#[test]
fn a_branch_does_not_turn_back_at_an_event() -> Checked {
    let job = Job::new(Scenario::from_str_alone(GUIDED, "guided")?, "guided".to_owned(), PathBuf::new())?;
    let of = Continuation::new(job, "contacts.ball.friction", [0.05, 0.3])?;
    let branch = of.follow(&Course::default())?;
    is_sound(&branch)?;
    assert_eq!(branch.ends[0], End::SlidesAway("slider".to_owned()));
    let least = (1.6190854666999868 - 0.07366877452602237 * 6.6555017474344345) / 13.492378889166558;
    let end = branch.points.first().ok_or("a motion")?;
    assert!((end.value - least).abs() < 1e-8 * least, "{:e} {least:e}", end.value);
    Ok(())
}

/// The branch continues although many events appear and vanish, and reports each of them once.
#[test]
fn branches_go_on_where_events_come_and_go() -> Checked {
    let branch = HELD_BACK.branch(LOAD, [-0.935, 0.0])?;
    is_sound(&branch)?;
    let (end, most) = (branch.points.first().ok_or("a motion")?, HELD_BACK.friction * 4.869762656393218);
    assert_eq!(branch.ends, [End::SlidesAway("slider".to_owned()), End::Shakedown(vec!["ball".to_owned()])]);
    assert!((end.value + most).abs() < 1e-5 * most, "{:e} {most:e}", end.value);

    let branch = SQUEEZED.branch("waveforms.drive.sine.amplitude", [1.49e-8, 1.49e-7])?;
    is_sound(&branch)?;
    assert_eq!(branch.ends[1], End::Range);

    let branch = LOADED.branch("bodies.slider.mass", [0.00335, 0.0837])?;
    is_sound(&branch)?;
    assert_eq!(branch.ends, [End::Range, End::Range]);
    Ok(())
}

/// A slightly lower throw would touch the table once more. Finite differences must not extend across this touch: they would give a wrong
/// multiplier. The branch has no period doubling, branching or break. It ends at the touch or continues beyond it, depending on rounding.
#[test]
#[ignore = "takes long: .ci/full"]
fn a_touch_beside_the_motion_is_none_of_its_own() -> Checked {
    let path = "waveforms.table.sine.amplitude";
    let (mut places, mut touches) = (Vec::new(), Vec::new());
    for tolerance in [1e-10, 1e-11, 1e-12] {
        let job = Job::new(Scenario::from_str_alone(BOUNCING, "ball")?, "ball".to_owned(), PathBuf::new())?;
        let steady = Options { tolerance, ..Options::default() };
        let of = Continuation::new(job, path, [3e-6, 1.6e-5])?;
        let branch = of.follow(&Course { steady, ..Course::default() })?;
        is_sound(&branch)?;
        let mut end = branch.points.iter().fold(0.0, |end: f64, point| end.max(point.value));
        for mark in &branch.marks {
            let Bifurcation::Event(changes) = &mark.kind else {
                return Err(format!("{:?}", branch.marks).into());
            };
            let touch = changes.iter().find(|change| change.kind == "touch").ok_or("a touch")?;
            touches.push([touch.below, touch.above]);
            end = end.min(mark.value);
        }
        places.push(end);
        let before: Vec<_> = branch.points.iter().filter(|point| point.value < end).collect();
        let mut radii = before.windows(2).map(|pair| pair[1].radius() / pair[0].radius());
        assert!(before.len() > 50 && radii.all(|ratio| (0.9..1.1).contains(&ratio)), "{}", before.len());
    }
    assert!(places.iter().all(|place| (place / places[0] - 1.0).abs() < 1e-6), "{places:?}");
    assert!(touches.iter().all(|touch| [[1, 2], [2, 1]].contains(touch)), "{touches:?}");
    Ok(())
}

/// Two waveforms have the same period, but only one of them is varied.
#[test]
fn a_period_that_is_not_varied_alone_is_told() -> Checked {
    let of = Continuation::new(PRESSED.job()?, "waveforms.drive.sine.period", [1e-3, 1.2e-3])?;
    let told = of.follow(&Course::default());
    assert!(matches!(&told, Err(ContinuationError::Apart { .. })), "{told:?}");
    Ok(())
}
