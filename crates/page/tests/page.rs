//! The engine of the page against whole runs and against the theory of Hertz, Cattaneo and Mindlin.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use stickslip_page::Page;

fn scenario(name: &str) -> String {
    let path = format!("{}/../../scenarios/{name}.json", env!("CARGO_MANIFEST_DIR"));
    std::fs::read_to_string(path).unwrap()
}

/// A run with a pause at every look has the bits of an uninterrupted one, whatever its stepper; snapshots change nothing.
#[test]
fn a_run_in_parts_has_the_bits_of_a_whole_run() {
    let with = |name: &str, stepper: serde_json::Value| {
        let mut text: serde_json::Value = serde_json::from_str(&scenario(name)).unwrap();
        text["run"].as_object_mut().unwrap().remove("cycles");
        text["run"]["stepper"] = stepper;
        text["run"]["duration"] = "200 ms".into();
        text.to_string()
    };
    let event = serde_json::json!({ "event": { "tolerance": 1e-8 } });
    let rk4 = serde_json::json!({ "rk4": { "step": "2 us" } });
    let dopri5 = serde_json::json!({ "dopri5": { "tolerance": 1e-6 } });
    for text in
        [with("walking_drive", event.clone()), with("p1", rk4), with("p1", dopri5), with("bounce", event)]
    {
        let run = |snapshots, looks| {
            let mut page = Page::default();
            page.load(&text).unwrap();
            page.begin(snapshots).unwrap();
            let mut parts = 0;
            while page.go(looks) < 1.0 {
                parts += 1;
            }
            (page, parts)
        };
        let ((whole, once), (parted, parts)) = (run(0, u64::MAX), run(40, 1));
        assert_eq!(once, 0);
        assert!(parts > 1 || text.contains("dopri5") || text.contains("restitution"), "{parts}");
        assert_eq!(whole.hash(), parted.hash());
        assert_eq!(whole.events(), parted.events());
        assert_eq!(without_time(&whole.summary()), without_time(&parted.summary()));
        if !text.contains("dopri5") {
            let (rows, events) = (whole.rows(), whole.events().lines().count());
            assert_eq!(parted.rows(), rows + events);
            assert!(parted.column(0).unwrap().is_sorted());
            assert!(parted.inside(0, 39).len() > 15 && parted.inside(0, 40).is_empty());
        }
    }
}

fn without_time(summary: &str) -> serde_json::Value {
    let mut summary: serde_json::Value = serde_json::from_str(summary).unwrap();
    summary.as_object_mut().unwrap().remove("timing");
    summary
}

/// First loading and reversal of a paraboloid: c/a = √(1 - u/u_c), F_x = μF_N[1 - (1 - u/u_c)^1.5], and Masing's rule after it.
#[test]
fn a_contact_in_the_hand_follows_cattaneo_and_mindlin() {
    let mut page = Page::default();
    page.load(&scenario("quickstart")).unwrap();
    let sheet: serde_json::Value = serde_json::from_str(&page.hold(0, 1e-7).unwrap()).unwrap();
    let slip = sheet["pressed"]["gross_slip_displacement_m"].as_f64().unwrap();
    page.press(1e-7, 0.0).unwrap();
    let first = |share: f64| 1.0 - (1.0 - share).powf(1.5);
    let near = |value: f64, known: f64| assert!((value / known - 1.0).abs() < 1e-12, "{value} {known}");
    page.press(1e-7, 0.4 * slip).unwrap();
    let inside = page.inside(0, -2);
    near(inside[6] / inside[5], 0.6_f64.sqrt());
    near(inside[4], 0.2 * inside[3] * first(0.4));
    page.press(1e-7, 0.2 * slip).unwrap();
    let inside = page.inside(0, -2);
    near(inside[4], 0.2 * inside[3] * (first(0.4) - 2.0 * first(0.1)));
    assert!(page.press(f64::NAN, 0.0).is_err());
}

/// The inside that is shown while a body is pushed is that of the row: force, indentation and displacement agree.
#[test]
fn a_motion_by_hand_shows_the_inside_of_its_contact() {
    let mut page = Page::default();
    let names = page.load(&scenario("controlled")).unwrap();
    let input = page.live().unwrap().lines().position(|name| name == "drive").unwrap();
    let place = |name: &str| names.lines().position(|one| one == name).unwrap();
    for k in 1..40 {
        let t = 5e-5 * f64::from(k);
        let row = page.step(t, input, 8e-7 * (3e3 * t).sin()).unwrap();
        let inside = page.inside(0, -1);
        let agree = |index: usize, name: &str, count: f64| {
            let value = row[place(name)];
            assert!(
                (count * inside[index] - value).abs() < 1e-9 * value.abs() + 1e-18,
                "{k} {name}: {inside:?}"
            );
        };
        assert!(inside[0] == t && inside[12] > 50.0);
        agree(1, "ball.d_m", 1.0);
        agree(2, "ball.u_m", 1.0);
        agree(4, "ball.fx_N", 3.0);
    }
}

#[test]
fn errors_are_those_of_check_and_leave_the_last_scenario() {
    let mut page = Page::default();
    assert!(page.begin(0).is_err() && page.steady().is_err() && page.live().is_err());
    assert!(page.inside(0, 0).is_empty() && page.summary().is_empty());
    page.load(&scenario("quickstart")).unwrap();
    let error = page.load("{ \"stickslip\": 1, \"bodis\": {} }").unwrap_err();
    assert!(error.contains("scenario.json:1:19") && error.contains("bodies"), "{error}");
    assert!(page.about().contains("Sawtooth drive on three ruby balls"));
    assert!(page.hold(5, 1e-7).is_err());
    assert!(page.step(1.0, 0, 0.0).is_err());
}
