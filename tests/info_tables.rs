//! `stickslip info`: its tables, and what it says of things that are skipped.

use crate::info::{info, tables};
use crate::program::{code, listing, number, scenario, stderr, stdout, stickslip};
use serde_json::Value;
use tempfile::tempdir;

/// Something of everything that can be left out.
const ODD: &str = r#"{ "stickslip": 1,
  "materials": {
    "steel": { "youngs_modulus": "210 GPa", "poisson_ratio": 0.3 },
    "brass": { "youngs_modulus": "100 GPa", "poisson_ratio": 0.35 }, "gold": { "youngs_modulus": 1, "poisson_ratio": 0 }
  },
  "waveforms": {
    "press": { "sine": { "amplitude": "0.5 N", "offset": "0.5 N", "period": "1 ms" } },
    "saw": { "sawtooth": { "stroke": "1 um", "period": "1 ms", "flyback": 0 } },
    "idle": { "triangle": { "stroke": 1, "period": 1 } }
  },
  "bodies": {
    "foot": { "x": { "follows": "saw" }, "mass": 1 },
    "slider whose name goes on and on to the very last of its 64 sign": { "mass": "20 g", "x": "free" }, "frame": {}
  },
  "contacts": {
    "pressed": {
      "between": ["foot", "slider whose name goes on and on to the very last of its 64 sign"],
      "materials": ["steel", "brass"], "profile": { "cone": { "slope": 0.01 } }, "friction": 0.2,
      "normal": { "force": { "follows": "press" } }
    },
    "row": {
      "between": ["ground", "slider whose name goes on and on to the very last of its 64 sign"],
      "materials": ["steel", "steel"], "profile": { "foundation": { "heights": [0, "1 um"], "length": "1 um" } },
      "friction": 0.2, "normal": { "force": "1 mN" }, "engine": { "springs": { "count": 64 } }
    },
    "apart": {
      "between": ["frame", "foot"], "materials": ["steel", "steel"], "profile": { "flat": { "radius": "1 um" } },
      "friction": 0.2, "normal": { "indentation": "-1 um" }
    },
    "slick": {
      "between": ["frame", "foot"], "materials": ["steel", "steel"], "friction": 0, "normal": { "force": "1 N" },
      "profile": { "power": { "coefficient": 1e12, "exponent": 4 } }
    }
  },
  "springs": { "idle spring": { "between": ["frame", "ground"], "stiffness": 1, "damping": 1 } },
  "gravity": { "acceleration": 9.81 }, "loads": [{ "on": "foot", "x": 1 }],
  "run": { "duration": "10 ms" }, "output": { "channels": ["row.u_m"] }, "plots": [] }"#;

#[test]
fn what_is_skipped_is_told_with_its_reason() {
    let folder = tempdir().unwrap();
    let file = folder.path().join("odd.json");
    std::fs::write(&file, ODD).unwrap();
    let info = info(&file, &[]);
    let items = |key: &str| -> Vec<String> {
        let items = info["usage"][key].as_array().unwrap().iter();
        let of = |item: &Value| {
            item.get("parts").map(|of| {
                of.as_array().unwrap().iter().map(|n| format!(" {}", n.as_str().unwrap())).collect::<String>()
            })
        };
        items
            .map(|item| format!("{}{}", item["what"].as_str().unwrap(), of(item).unwrap_or_default()))
            .collect()
    };
    let skipped = [
        "normal motion row",
        "contact apart",
        "tangential force slick",
        "spring idle spring",
        "load loads[0]",
        "gravity",
        "material gold",
        "waveform idle",
        "mass foot",
        "rows",
        "channels",
        "pictures",
    ];
    assert_eq!(items("skipped"), skipped);
    let slider = "slider whose name goes on and on to the very last of its 64 sign.x";
    let used = [
        &format!("motion {slider}"),
        // Together with the row, which nothing free touches: its loops are read too often to step it apart.
        "method",
        "method",
        &format!("position {slider}"),
        "memory pressed",
        "indentation pressed",
        "tangential force pressed",
        "memory row",
    ];
    assert_eq!(items("used"), used);
    assert!(info["contacts"]["pressed"]["start"]["peak_pressure_Pa"].is_null(), "no string for infinity");
    assert!(info["contacts"]["row"]["start"].get("peak_pressure_Pa").is_none());
    assert_eq!(number(&info, "/contacts/slick/start/tangential_stiffness_N_m"), 0.0);
    // In a walk there are no equations.
    let walk = tables(&scenario("fretting_sphere"));
    assert!(walk.contains("no coordinate is free") && !walk.contains("MODES"), "{walk}");
}

const SWING: &str = "closed form from event to event";
const PARABOLA: &str = "parabola";
const NYSTROM: &str = "Runge–Kutta–Nyström 8(6)";
const DORMAND_PRINCE: &str = "Dormand–Prince 8(5,3)";
const CROWDED: &str = "graded Dormand–Prince 8(5,3)";
const MEMORY: &str = "memory between events";

#[test]
fn what_the_event_stepper_spares_is_told_where_it_does() {
    let told = |name: &str, set: &[&str]| -> Vec<String> {
        let set: Vec<&str> = set.iter().flat_map(|set| ["--set", set]).collect();
        let usage = info(&scenario(name), &set)["usage"].clone();
        let items = ["used", "skipped"].into_iter().flat_map(|key| usage[key].as_array().unwrap().clone());
        // Of a method its name, which stands before the reason.
        let what = items.map(|item| match item["what"].as_str().unwrap() {
            "method" => item["why"].as_str().unwrap().split(": ").next().unwrap().to_owned(),
            what => what.to_owned(),
        });
        let of_stepper = [
            SWING,
            PARABOLA,
            NYSTROM,
            DORMAND_PRINCE,
            CROWDED,
            "position",
            "stages for velocities",
            "steps between events",
            "memory between events",
            "evaluations",
            "forces",
        ];
        what.filter(|what| of_stepper.contains(&what.as_str())).collect()
    };
    let power = r#"contacts.ball.profile={"power":{"exponent":2.5,"coefficient":1e4}}"#;
    let stepped = [NYSTROM, PARABOLA, CROWDED, "position", "stages for velocities", "evaluations", MEMORY];
    assert_eq!(told("p1", &[power]), stepped);
    // A paraboloid needs no steps between events, nor does a sphere.
    let swung =
        [SWING, PARABOLA, NYSTROM, CROWDED, "position", "steps between events", "evaluations", MEMORY];
    assert_eq!(told("p1", &[]), swung);
    assert_eq!(told("p1", &[r#"contacts.ball.profile={"sphere":{"radius":"1 mm"}}"#]), swung);
    // A stepper without events knows none of it.
    assert!(told("p1", &["run.stepper={\"verlet\":{\"step\":\"1 us\"}}"]).is_empty());
    // A sine drags the edge along no line, so partial slip is stepped; in gross slip the slider does not feel it.
    let curved = r#"waveforms.drive={"sine":{"amplitude":"1 um","period":"1 ms"}}"#;
    assert_eq!(told("p1", &[curved]), stepped);
    // A damper makes a force depend on a velocity, and a position count from where it is.
    let oil = r#"springs={"oil":{"between":["ground","slider"],"direction":"x","stiffness":1,"damping":1}}"#;
    assert_eq!(told("p1", &[oil]), [DORMAND_PRINCE, CROWDED, MEMORY]);
    let ball = [DORMAND_PRINCE, PARABOLA, CROWDED, "position", "evaluations", "forces"];
    assert_eq!(told("bouncing_ball", &[]), ball);
    // Between bodies at rest a spring is skipped; one that a follower moves has its energy computed.
    let spring = r#"springs={"idle":{"between":["ground","foot"],"direction":"x","stiffness":1}}"#;
    let item = |set: &[&str], key: &str| -> bool {
        let items = info(&scenario("p1"), set)["usage"][key].clone();
        items.as_array().unwrap().iter().any(|item| item["what"] == "spring")
    };
    assert!(item(&["--set", spring], "used") && !item(&["--set", spring], "skipped"));
    let still = ["--set", spring, "--set", "bodies.foot={\"x\":\"fixed\"}"];
    assert!(item(&still, "skipped") && !item(&still, "used"));
}

#[test]
fn tables_fit_a_hundred_columns() {
    let folder = tempdir().unwrap();
    let odd = folder.path().join("odd.json");
    std::fs::write(&odd, ODD).unwrap();
    let names = listing(scenario("p1").parent().unwrap());
    let examples = names.iter().filter_map(|name| name.strip_suffix(".json")).map(scenario);
    for file in examples.chain([odd]) {
        for line in tables(&file).lines() {
            assert!(line.chars().count() <= 100 && line.trim_end() == line, "{}: {line:?}", file.display());
        }
    }
    let text = tables(&scenario("quickstart"));
    for line in [
        "quickstart: Sawtooth drive on three ruby balls",
        "slider   10.00 g   x free",
        "S₀, zero-step stroke                 29.38 nm",
        "contact resonance                    4.151 kHz",
        "warning: ruby and hardened steel are not elastically similar (β = -0.0764): the theory neglects the",
        "contact radius the normal stiffness is up to 0.20 % too low (without slip; less with friction).",
        "Contact: ball",
        "stable fixed step, verlet   below 76.69 µs",
    ] {
        assert!(text.lines().any(|known| known == line), "{line:?} in\n{text}");
    }
    // Two contacts of one pair are warned of together.
    let stage = tables(&scenario("three_ball_stage"));
    assert_eq!(stage.matches("warning: ").count(), 1, "{stage}");
    assert!(stage.contains("\nContacts: front, rear\n"), "{stage}");
}

#[test]
fn a_bad_file_is_refused_as_a_run_refuses_it() {
    let output =
        stickslip().arg("info").arg(scenario("p1")).args(["--set", "contacts.ball.friction=-1"]).output();
    let output = output.unwrap();
    assert_eq!((code(&output), stdout(&output)), (2, String::new()));
    assert!(stderr(&output).contains("contacts.ball.friction: expected a number between 0 and 1000"));
}
