//! Alternative spellings in files and on the command line.

use serde_json::Value;
use std::fs;
use stickslip_scenario::{MATERIALS, Scenario, ScenarioError, explained};

fn good() -> String {
    fs::read_to_string("tests/good/several.json").unwrap()
}

fn with(set: &[(&str, &str)]) -> Result<Value, ScenarioError> {
    let scenario = Scenario::from_str_with(&good(), "good.json", "tests/good", set)?;
    Ok(serde_json::from_str(&scenario.resolved()).unwrap())
}

fn refused(set: &[(&str, &str)]) -> String {
    with(set).unwrap_err().to_string()
}

#[test]
fn overrides_add_entries_to_lists() {
    let load = r#"{"on": "slider", "x": "5 mN"}"#;
    for path in ["loads[+]", "loads[1]"] {
        let loads = with(&[(path, load)]).unwrap()["loads"].clone();
        assert_eq!((loads.as_array().unwrap().len(), &loads[1]["x"]), (2, &0.005.into()), "{path}");
    }
    let loads = with(&[("loads[+].on", "slider"), ("loads[1].x", "5 mN")]).map(|root| root["loads"].clone());
    assert_eq!(loads.unwrap()[1]["x"], 0.005);
    assert_eq!(with(&[("plots[+]", "energy")]).unwrap()["plots"][2], "energy");
    // A missing list is created.
    let channels =
        with(&[("output.channels[+]", "slider.x_m"), ("output.channels[+]", "ball.fx_N")]).unwrap();
    assert_eq!(channels["output"]["channels"], serde_json::json!(["slider.x_m", "ball.fx_N"]));
    let far = refused(&[("loads[2]", load)]);
    assert!(far.contains("the list has one entry, [0]"), "{far}");
    // Errors of an added entry are reported at its path.
    let wrong = refused(&[("loads[+]", r#"{"on": "slidr", "x": "5 mN"}"#)]);
    assert!(
        wrong.starts_with("--set loads[+]={\"on\": \"slidr\"")
            && wrong.contains("loads[1].on: there is no body")
    );
}

#[test]
fn overrides_switch_between_alternatives() {
    let run = with(&[("run.cycles", "3")]).unwrap()["run"].clone();
    assert_eq!((run.get("duration"), &run["cycles"]), (None, &3.0.into()));
    let run = with(&[("run.stepper.verlet.step", "1 us")]).unwrap()["run"].clone();
    assert_eq!(run["stepper"], serde_json::json!({ "verlet": { "step": 1e-6 } }));
    let normal = with(&[("contacts.ball.normal.indentation", "50 nm")]).unwrap();
    assert_eq!(normal["contacts"]["ball"]["normal"].as_object().unwrap().len(), 1);
    let sphere = with(&[("contacts.ball.profile.sphere.radius", "1 mm")]).unwrap();
    assert_eq!(sphere["contacts"]["ball"]["profile"], serde_json::json!({ "sphere": { "radius": 1e-3 } }));
    let frequency = with(&[("waveforms.drive.sawtooth.frequency", "50 Hz")]).unwrap();
    let saw = &frequency["waveforms"]["drive"]["sawtooth"];
    assert_eq!((saw.get("period"), &saw["frequency"]), (None, &50.0.into()));
    let follows = with(&[("bodies.slider.x.follows", "drive"), ("loads", "[]")]).unwrap();
    assert_eq!(follows["bodies"]["slider"]["x"], serde_json::json!({ "follows": "drive" }));
    let coupled =
        with(&[("contacts.ball.normal", "coupled"), ("contacts.ball.normal.force", "1 N")]).unwrap();
    assert_eq!(coupled["contacts"]["ball"]["normal"], serde_json::json!({ "force": 1.0 }));
    for word in ["off", "all"] {
        let root = with(&[("output.events", word), ("output.events.most", "1000")]).unwrap();
        assert_eq!(root["output"]["events"], serde_json::json!({ "most": 1000 }), "{word}");
    }
    // A word stays if no object is allowed in its place.
    let told = refused(&[("title.short", "a drive")]);
    assert!(told.contains("this value has no keys"), "{told}");
    let sine = r#"{"amplitude": "100 nm", "period": "10 ms"}"#;
    let sine = with(&[("waveforms.drive.sine", sine)]).unwrap();
    assert_eq!(sine["waveforms"]["drive"].as_object().unwrap().keys().collect::<Vec<_>>(), ["sine"]);
}

#[test]
fn no_name_is_listed_twice() {
    let told = refused(&[("runn.duration", "1 s")]);
    let help = told.lines().last().unwrap();
    assert!(help.contains("did you mean \"run\"?"), "{told}");
    let told = refused(&[("nothing.at.all", "1 s")]);
    let listed = told.lines().last().unwrap().split_once("known here: ").unwrap().1;
    let names: Vec<&str> = listed.split(", ").collect();
    assert!(names.contains(&"run") && names.contains(&"gravity"), "{told}");
    assert!(names.iter().all(|name| names.iter().filter(|other| *other == name).count() == 1), "{told}");
}

#[test]
fn comments_are_blanks() {
    let plain = fs::read_to_string("tests/good/comment.json").unwrap();
    assert!(plain.contains("/* ruby */"));
    let commented = format!("// a drive\n{}// the end", plain.replace("\"count\"", "// three\n\"count\""));
    let read = |text: &str| Scenario::from_str(text, "a.json", "tests/good").unwrap().resolved();
    assert_eq!(read(&commented), read(&plain));
    assert!(!read(&commented).contains("//"));
    // Positions do not change.
    let wrong = commented.replace("0.2,", "-0.2, // slippery\n");
    let error = Scenario::from_str(&wrong, "a.json", "").unwrap_err();
    let excerpt = error.excerpt.as_ref().unwrap();
    assert_eq!(excerpt.text.get(excerpt.marker.clone()), Some("-0.2"), "{error}");
    assert!(error.to_string().contains("// slippery"));
    let open = Scenario::from_str("{ /* \"stickslip\": 1 }", "a.json", "").unwrap_err().to_string();
    assert!(open.contains("a.json:1:3  not JSON: this comment does not end"), "{open}");
    let comma = Scenario::from_str("{ \"stickslip\": 1, // no\n }", "a.json", "").unwrap_err().to_string();
    assert!(comma.contains("a comma before a closing bracket"), "{comma}");
}

#[test]
fn a_diameter_is_twice_a_radius() {
    let ball = |inside: &str| {
        let text = good().replace("\"radius\": \"0.5 mm\"", inside);
        Scenario::from_str(&text, "a.json", "").map(|scenario| scenario.resolved())
    };
    assert_eq!(ball("\"diameter\": \"1 mm\"").unwrap(), ball("\"radius\": \"0.5 mm\"").unwrap());
    assert!(!ball("\"diameter\": \"1 mm\"").unwrap().contains("diameter"));
    let both = ball("\"diameter\": \"1 mm\", \"radius\": \"0.5 mm\"").unwrap_err().to_string();
    assert!(
        both.contains("the radius and the diameter are given") && both.contains("help: keep one of them")
    );
    let zero = ball("\"diameter\": \"0 mm\"").unwrap_err().to_string();
    let told = "contacts.ball.profile.paraboloid.diameter: expected a length above 0 m, got 0 mm";
    assert!(zero.contains(told), "{zero}");
    assert!(ball("").unwrap_err().to_string().contains("missing key \"radius\""));
}

#[test]
fn common_materials_need_no_description() {
    let text = good();
    let described = "  \"materials\": {\n    \"ruby\":  { \"youngs_modulus\": \"400 GPa\", \"poisson_ratio\": 0.27 },\n    \"steel\": { \"youngs_modulus\": \"210 GPa\", \"poisson_ratio\": 0.30 }\n  },\n";
    assert!(text.contains(described));
    let bare = text.replace(described, "");
    let scenario = Scenario::from_str(&bare, "a.json", "").unwrap();
    let moduli: Vec<(&str, f64)> = scenario.materials().collect();
    assert_eq!(moduli, [("ruby", 400e9), ("steel", 210e9)]);
    // Results contain the numbers.
    let resolved: Value = serde_json::from_str(&scenario.resolved()).unwrap();
    assert_eq!(resolved["materials"]["ruby"]["poisson_ratio"], 0.23);
    assert!(scenario.warnings.is_empty(), "{:?}", scenario.warnings);
    for material in MATERIALS {
        let text = bare.replace("\"ruby\", \"steel\"", &format!("\"{0}\", \"{0}\"", material.name));
        assert!(Scenario::from_str(&text, "a.json", "").is_ok(), "{}", material.name);
    }
    // A material described in the file takes precedence; a similar name is reported as misspelt.
    let own = Scenario::from_str(&text, "a.json", "").unwrap();
    assert_eq!(
        serde_json::from_str::<Value>(&own.resolved()).unwrap()["materials"]["ruby"]["poisson_ratio"],
        0.27
    );
    let slip = text.replace("\"ruby\":  {", "\"Ruby\":  {");
    let told = Scenario::from_str(&slip, "a.json", "").unwrap_err().to_string();
    assert!(
        told.contains("there is no material \"ruby\"") && told.contains("did you mean \"Ruby\"?"),
        "{told}"
    );
    let near = bare.replace("\"ruby\"", "\"rubi\"");
    let told = Scenario::from_str(&near, "a.json", "").unwrap_err().to_string();
    assert!(told.contains("did you mean \"ruby\"?"), "{told}");
}

/// A name of the table is accepted, whatever other materials are described or used.
#[test]
fn a_name_of_the_table_is_no_slip_for_a_neighbour() {
    let with_pair = |pair: &str, ruby: &str| {
        let text = good().replace("[\"ruby\", \"steel\"]", pair).replace("\"ruby\":  {", ruby);
        assert!(text.contains(pair) && text.contains(ruby));
        Scenario::from_str(&text, "a.json", "")
    };
    let named =
        |scenario: &Scenario| scenario.materials().map(|(name, _)| name.to_owned()).collect::<Vec<_>>();
    let both = with_pair("[\"alumina\", \"aluminium\"]", "\"ruby\":  {").unwrap();
    assert!(named(&both).iter().filter(|name| name.starts_with("alumin")).count() == 2, "{:?}", named(&both));
    let beside = with_pair("[\"ruby\", \"steel\"]", "\"rubys\":  {").unwrap();
    assert!(named(&beside).contains(&"ruby".to_owned()));
    let told = with_pair("[\"wolfram\", \"steel\"]", "\"ruby\":  {").unwrap_err().to_string();
    assert!(told.contains("known here: ruby, steel, alumina, aluminium"), "{told}");
}

#[test]
fn keys_that_stand_beside_each_other_are_not_switched() {
    let some = r#"{"kinds": ["gross slip"], "contacts": ["ball"]}"#;
    let root = with(&[("output.events", some), ("output.events.most", "1000")]).unwrap();
    let events = serde_json::json!({ "kinds": ["gross slip"], "contacts": ["ball"], "most": 1000 });
    assert_eq!(root["output"]["events"], events);
    let root = with(&[("output.last", "2"), ("output.window.from", "50 ms")]).unwrap();
    assert_eq!(root["output"].get("last"), None);
    assert_eq!(root["output"]["window"]["from"], 0.05);
}

/// An override with an invalid path does not suppress other errors.
#[test]
fn a_bad_override_hides_nothing() {
    let told = |set: &[(&str, &str)]| {
        let error = with(set).unwrap_err();
        error.reports().map(|report| report.path.clone()).collect::<Vec<_>>()
    };
    let wrong = ("bodies.slider.mass", "-1 g");
    assert_eq!(told(&[("a[", "1"), wrong]), ["", "bodies.slider.mass"]);
    assert_eq!(told(&[wrong, ("a[", "1"), ("b[", "1")]), ["bodies.slider.mass", "", ""]);
    let far = told(&[("loads[0].x", "1 m"), ("loads[7].x", "1 N"), ("loads[9].x", "1 N")]);
    assert_eq!(far, ["loads[0].x", "loads", "loads"]);
}

#[test]
fn the_end_of_a_path_is_explained() {
    let places = |asked: &str| explained(asked).into_iter().map(|(path, _)| path).collect::<Vec<_>>();
    assert_eq!(places("sawtooth.flyback"), ["waveforms.NAME.sawtooth.flyback"]);
    assert_eq!(places("event.tolerance"), ["run.stepper.event.tolerance"]);
    assert!(places("sawtooth.nothing").is_empty() && places("nothing.flyback").is_empty());
}
