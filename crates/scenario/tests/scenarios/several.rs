//! Several errors in one scenario: all of them must be reported, without follow-on errors.
//!
//! The errors come from the invalid scenarios, each of which is a valid one with an edit. Independent edits are combined, and the reports
//! must be those of each edit by itself. The usual test run checks some cases; `STICKSLIP_CASES=100000` checks that many.

use serde_json::Value;
use std::collections::BTreeSet;
use std::fs;
use stickslip_drive::Model;
use stickslip_scenario::{Scenario, ScenarioError};

/// Returns the error of a text before its run starts.
fn refusal(text: &str) -> Option<ScenarioError> {
    let scenario = match Scenario::from_str(text, "several.json", "tests/bad") {
        Ok(scenario) => scenario,
        Err(error) => return Some(error),
    };
    let started = Model::new(&scenario.scene).and_then(|model| model.start(&scenario.plan));
    started.err().map(|error| scenario.refusal(&error))
}

/// Returns the reported errors without positions.
fn told(text: &str) -> BTreeSet<String> {
    let error = refusal(text);
    let reports = error.iter().flat_map(|error| error.reports());
    reports.map(|report| format!("{}: {}", report.path, report.message)).collect()
}

/// Cases whose check depends on other paths. An error there may suppress theirs.
const JUDGED_BY: &[(&[&str], &[&str])] = &[
    // The whole model.
    (&["no_equilibrium"], &[""]),
    // Contacts.
    (&["row_too_narrow", "sphere_beyond_equator"], &["contacts.ball", "materials", "bodies", "waveforms"]),
    (&["start_force_slips", "radius_falls"], &["contacts.ball"]),
    (&["memory_of_row", "memory_plot_of_row"], &["contacts"]),
    (&["fields_at_beyond", "fields_extent", "fields_every", "fields_radii"], &["contacts.ball.profile"]),
    // The waveform of a stack.
    (&["hysteresis_without_stroke"], &["waveforms"]),
    // Moving bodies and what acts on them.
    (&["nothing_acts_on_body"], &["bodies.slider", "actuators", "contacts", "gravity", "loads", "springs"]),
    (&["loop_without_contact", "state_without_contact"], &["bodies", "plots", "loads"]),
    (&["mass_missing", "inertia_missing", "position_in_equilibrium"], &["bodies.slider", "contacts"]),
    (&["contact_named_like_body"], &["bodies"]),
    (&["start_of_follower", "velocity_of_follower"], &["bodies.foot", "waveforms"]),
    (&["figures_", "until_steady"], &["bodies", "waveforms", "figures"]),
    (&["unknown_material"], &["materials"]),
    (&["unknown_body", "load_on_ground", "contact_with_itself", "point_on_another_body"], &["bodies"]),
    // A waveform and the parts that follow it.
    (
        &["waveform_of_wrong_dimension", "input_of_wrong", "table_unit_of_a_force"],
        &["waveforms", "bodies.foot"],
    ),
    (
        &["jump_through_damper"],
        &["waveforms", "bodies", "actuators", "contacts.ball.between", "figures", "loads"],
    ),
    (&["too_steep", "flyback_too_long"], &["waveforms"]),
    // The duration of the run.
    (
        &["fields_at", "memory_at", "springs_every", "step_longer", "frame_longer", "own_plot_after"],
        &["run.duration", "run.cycles"],
    ),
];

/// Pairs of cases whose combination is another error, such as an output of contacts without contacts.
const MEDDLING: &[(&[&str], &[&str])] = &[
    (&["loop_without_contact", "state_without_contact"], &["contacts", "output", "plots"]),
    (&["row_too_narrow", "row_springs", "springs_count", "engine"], &["output.memory", "plots"]),
    (&["memory_of_row", "memory_plot_of_row"], &["output.memory", "plots"]),
    (&["duration_and_cycles", "duration_missing"], &["run.duration", "run.cycles"]),
    (&["body_is_ground"], &["springs", "loads", "actuators"]),
    // Another dimension of a waveform, or a key that another edit adds.
    (&["input_of_wrong", "table_unit_of_a_force"], &["actuators"]),
    (&["period_missing", "period_and_frequency"], &["waveforms.drive"]),
    (&["friction_missing", "friction_in_material"], &["contacts.ball.friction", "materials"]),
];

/// Value at a path, or its removal.
type Edit = (Vec<String>, Option<Value>);

/// Invalid scenario as edits of a valid one.
struct Case {
    name: String,
    edits: Vec<Edit>,
    told: BTreeSet<String>,
}

/// Collects the differences of two trees.
fn difference(good: &Value, bad: &Value, here: &[String], found: &mut Vec<Edit>) {
    if good == bad {
        return;
    }
    let (Some(good), Some(entries)) = (good.as_object(), bad.as_object()) else {
        found.push((here.to_vec(), Some(bad.clone())));
        return;
    };
    let inside = |key: &String| [here, std::slice::from_ref(key)].concat();
    for (key, value) in entries {
        match good.get(key) {
            Some(before) => difference(before, value, &inside(key), found),
            None => found.push((inside(key), Some(value.clone()))),
        }
    }
    found.extend(good.keys().filter(|key| !entries.contains_key(*key)).map(|key| (inside(key), None)));
}

fn apply(root: &mut Value, (path, value): &Edit) {
    let (key, parent) = path.split_last().unwrap();
    let entries = parent.iter().fold(root, |here, key| &mut here[key.as_str()]).as_object_mut().unwrap();
    match value {
        Some(value) => drop(entries.insert(key.clone(), value.clone())),
        None => drop(entries.shift_remove(key)),
    }
}

fn edited<'a>(good: &Value, cases: impl IntoIterator<Item = &'a Case>) -> String {
    let mut root = good.clone();
    cases.into_iter().flat_map(|case| &case.edits).for_each(|edit| apply(&mut root, edit));
    serde_json::to_string_pretty(&root).unwrap()
}

fn lies_in(a: &[String], b: &[String]) -> bool {
    a.len() >= b.len() && a[..b.len()] == *b
}

/// Returns whether no edit of one case contains one of the other. Two variants of one value also count as related.
fn apart(a: &Case, b: &Case) -> bool {
    let kind = |path: &[String]| {
        let parent = &path[..path.len() - 1];
        let holder = parent
            .last()
            .is_some_and(|key| ["profile", "normal", "stepper", "engine"].contains(&key.as_str()));
        let is_waveform = parent.len() == 2 && parent[0] == "waveforms";
        (holder || is_waveform).then(|| parent.to_vec())
    };
    a.edits.iter().all(|(p, _)| {
        b.edits.iter().all(|(q, _)| {
            let one_place = kind(p).is_some_and(|place| kind(q) == Some(place));
            !lies_in(p, q) && !lies_in(q, p) && !one_place
        })
    })
}

/// Returns whether a case depends on the edits of another one, according to a table.
fn meets(table: &[(&[&str], &[&str])], case: &Case, other: &Case) -> bool {
    let places = table.iter().filter(|(names, _)| names.iter().any(|name| case.name.starts_with(name)));
    let mut places = places.flat_map(|(_, places)| places.iter());
    places.any(|place| {
        let place: Vec<String> = place.split_terminator('.').map(str::to_owned).collect();
        other.edits.iter().any(|(path, _)| lies_in(path, &place) || lies_in(&place, path))
    })
}

fn cases(good: &Value) -> Vec<Case> {
    let mut paths: Vec<_> = fs::read_dir("tests/bad").unwrap().map(|entry| entry.unwrap().path()).collect();
    paths.retain(|path| path.extension().is_some_and(|extension| extension == "json"));
    paths.sort();
    let mut cases = Vec::new();
    for path in paths {
        let Ok(text) = fs::read_to_string(&path) else { continue };
        let Ok(bad) = serde_json::from_str::<Value>(&text) else { continue };
        let mut edits = Vec::new();
        difference(good, &bad, &[], &mut edits);
        let name = path.file_stem().unwrap().to_string_lossy().into_owned();
        let case = Case { name, edits, told: BTreeSet::new() };
        let is_edit = bad.is_object() && (1..=2).contains(&case.edits.len());
        if is_edit && case.edits.iter().all(|(path, _)| path[0] != "title" && path[0] != "stickslip") {
            let told = told(&edited(good, [&case]));
            // Duplicate keys do not exist in the tree and give no case.
            if !told.is_empty() {
                cases.push(Case { told, ..case });
            }
        }
    }
    cases
}

#[test]
fn what_is_wrong_apart_is_told_together() {
    let good = serde_json::from_str(&fs::read_to_string("tests/good/several.json").unwrap()).unwrap();
    let cases = cases(&good);
    assert!(cases.len() > 150, "only {} cases", cases.len());
    let count = std::env::var("STICKSLIP_CASES").map_or(1500, |count| count.parse().unwrap());
    // Knuth's multiplicative generator, MMIX; the seed selects the combinations.
    let mut seed = 17_u64;
    let mut next = |below: usize| {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((seed >> 33) as usize) % below
    };
    let mut wrong = Vec::new();
    let mut met = 0;
    while met < count {
        let mut chosen: Vec<&Case> = Vec::new();
        for _ in 0..2 + next(2) {
            let case = &cases[next(cases.len())];
            let meddles = |other: &&&Case| meets(MEDDLING, case, other) || meets(MEDDLING, other, case);
            if chosen.iter().all(|other| apart(other, case)) && !chosen.iter().any(|other| meddles(&other)) {
                chosen.push(case);
            }
        }
        if chosen.len() < 2 {
            continue;
        }
        met += 1;
        let expected: BTreeSet<String> = chosen.iter().flat_map(|case| case.told.clone()).collect();
        let told = told(&edited(&good, chosen.iter().copied()));
        let may_wait = |case: &&&Case| {
            chosen.iter().any(|other| other.name != case.name && meets(JUDGED_BY, case, other))
        };
        let waiting: BTreeSet<&String> = chosen.iter().filter(may_wait).flat_map(|case| &case.told).collect();
        let invented: Vec<_> = told.difference(&expected).collect();
        let withheld: Vec<_> = expected.difference(&told).filter(|told| !waiting.contains(told)).collect();
        if !invented.is_empty() || !withheld.is_empty() {
            let names: Vec<&str> = chosen.iter().map(|case| case.name.as_str()).collect();
            wrong.push(format!("{names:?}\n  invented {invented:#?}\n  withheld {withheld:#?}"));
        }
    }
    assert!(wrong.is_empty(), "{} of {met}\n{}", wrong.len(), wrong.join("\n"));
}

/// Twelve common errors, one on each of twelve lines.
#[test]
fn twelve_mistakes_are_told_as_twelve() {
    let good = fs::read_to_string("tests/good/several.json").unwrap();
    let mistakes = [
        (
            "\"youngs_modulus\": \"400 GPa\"",
            "\"youngs_modulus\": \"400 GN\"",
            "materials.ruby.youngs_modulus",
        ),
        ("\"poisson_ratio\": 0.30", "\"poisson_ratio\": 0.8", "materials.steel.poisson_ratio"),
        ("\"stroke\": \"200 nm\"", "\"stroke\": \"200 nn\"", "waveforms.drive.sawtooth.stroke"),
        ("\"flyback\": \"10 us\"", "\"flyback\": \"20 ms\"", "waveforms.drive.sawtooth.flyback"),
        ("\"x\": { \"follows\": \"drive\" }", "\"x\": { \"follows\": \"dirve\" }", "bodies.foot.x.follows"),
        ("\"mass\": \"10 g\"", "\"mass\": \"-10 g\"", "bodies.slider.mass"),
        ("\"ruby\", \"steel\"]", "\"rubin\", \"steel\"]", "contacts.ball.materials[0]"),
        ("\"radius\": \"0.5 mm\"", "\"radius\": \"0 mm\"", "contacts.ball.profile.paraboloid.radius"),
        ("\"friction\": 0.2", "\"fricton\": 0.2", "contacts.ball.fricton"),
        ("\"on\": \"slider\"", "\"on\": \"slidr\"", "loads[0].on"),
        ("\"tolerance\": 1e-8", "\"tolerance\": 1", "run.stepper.event.tolerance"),
        ("\"trajectory\"", "\"trajektory\"", "plots[1]"),
    ];
    let mut text = good;
    for (right, wrong, _) in mistakes {
        assert!(text.contains(right), "{right}");
        text = text.replacen(right, wrong, 1);
    }
    let error = refusal(&text).unwrap();
    let paths: Vec<&str> = error.reports().map(|report| report.path.as_str()).collect();
    assert_eq!(paths, mistakes.map(|(_, _, path)| path), "{error}");
    assert!(!error.has_more());
    assert_eq!(error.to_string().matches("\n\n").count(), 11);
}

#[test]
fn of_thirty_mistakes_the_first_twenty_are_told_and_that_there_are_more() {
    let good = fs::read_to_string("tests/good/several.json").unwrap();
    let load = "{ \"on\": \"slider\", \"x\": \"-0.02 N\" }";
    let loads = vec!["{ \"on\": \"slider\", \"x\": \"1 m\" }"; 30].join(",\n");
    let text = good.replacen(load, &loads, 1);
    let error = refusal(&text).unwrap();
    let paths: Vec<&str> = error.reports().map(|report| report.path.as_str()).collect();
    let first: Vec<String> = (0..20).map(|i| format!("loads[{i}].x")).collect();
    assert_eq!(paths, first, "{error}");
    assert!(
        error.has_more() && error.to_string().ends_with("\n\nand more faults: the first are 20"),
        "{error}"
    );
}

/// One error is reported once, without follow-on errors.
#[test]
fn consequences_are_not_told() {
    let good = fs::read_to_string("tests/good/several.json").unwrap();
    for (right, wrong, paths) in [
        // The missing slider is not reported.
        ("\"mass\": \"10 g\", \"x\": \"free\"", "\"x\": \"fre\"", &["bodies.slider.x"][..]),
        // The material is used by a contact.
        ("\"ruby\":  {", "\"ruby \":  {", &["materials.ruby "]),
        ("\"bodies\": {", "\"boddies\": {", &["boddies"]),
        ("\"contacts\": {", "\"contact\": {", &["contact"]),
        ("\"drive\": { \"sawtooth\": {", "\"drive\": { \"sawtoth\": {", &["waveforms.drive.sawtoth"]),
        ("\"friction\": 0.2", "\"haftung\": 0.2", &["contacts.ball.haftung"]),
        ("\"friction\": 0.2", "\"colour\": \"red\"", &["contacts.ball", "contacts.ball.colour"]),
        ("\"duration\": \"100 ms\"", "\"duration\": \"100 m\"", &["run.duration"]),
        ("\"run\":    {", "\"runs\":    {", &["runs"]),
        // The output depends on the run, and on the waveform in `figures`.
        (
            "\"duration\": \"100 ms\", \"stepper\": { \"event\": { \"tolerance\": 1e-8 } } },\n  \"output\": {",
            "\"duration\": \"0.1 m\" },\n  \"output\": { \"window\": { \"from\": \"90 s\" },",
            &["run.duration"],
        ),
    ] {
        assert!(good.contains(right), "{right}");
        let error = refusal(&good.replacen(right, wrong, 1)).unwrap();
        let told: Vec<&str> = error.reports().map(|report| report.path.as_str()).collect();
        assert_eq!(told, paths, "{error}");
    }
}

/// The search is limited by bytes, not by time. A file of three and a half megabytes is read three more times on every machine.
#[test]
fn where_not_everything_is_judged_it_is_said() {
    let good = fs::read_to_string("tests/good/several.json").unwrap();
    let load = "{ \"on\": \"slider\", \"x\": \"-0.02 N\" }";
    let loads = vec!["{ \"on\": \"slider\", \"x\": \"1 m\" }"; 30].join(",\n");
    let long = format!("{}{}", good.replacen(load, &loads, 1), " ".repeat(7 << 19));
    let error = refusal(&long).unwrap();
    assert_eq!(error.reports().count(), 4, "{error}");
    assert!(!error.has_more() && error.may_have_more());
    assert!(error.to_string().ends_with("\n\nand possibly more: the rest was not checked"));
    // A single error is known to be the only one.
    let one = format!("{}{}", good.replacen("\"10 g\"", "\"-10 g\"", 1), " ".repeat(7 << 19));
    let error = refusal(&one).unwrap();
    assert!(error.reports().count() == 1 && !error.has_more() && !error.may_have_more(), "{error}");
}
