//! Output of the inner state of contacts, and default output.

use stickslip_drive::Moments;
use stickslip_scenario::Scenario;

const QUICKSTART: &str = "../../scenarios/quickstart.json";
const FRETTING: &str = "../../scenarios/fretting_sphere.json";

fn with(file: &str, overrides: &[(&str, &str)]) -> Scenario {
    let scenario = Scenario::load_with(file, overrides).unwrap_or_else(|error| panic!("{error}"));
    // The resolved scenario has the same output.
    let again = Scenario::from_str(&scenario.resolved(), "resolved", "").unwrap();
    assert_eq!((&again.springs, &again.memory), (&scenario.springs, &scenario.memory));
    scenario
}

fn times(scenario: &Scenario) -> Vec<f64> {
    match &scenario.memory.as_ref().unwrap().moments {
        Moments::At(times) => times.clone(),
        Moments::Every(every) => panic!("every {every} s"),
    }
}

#[test]
fn who_does_not_ask_gets_nothing() {
    let scenario = with(QUICKSTART, &[]);
    assert_eq!((&scenario.springs, &scenario.memory), (&None, &None));
}

#[test]
fn springs_are_written_as_often_as_rows_by_default() {
    let springs = |overrides: &[(&str, &str)]| {
        let springs = with(QUICKSTART, overrides).springs.unwrap();
        (springs.count, springs.moments, springs.asked_by)
    };
    let plot = ("plots", "[\"loop\", \"state\"]");
    let asked = |every: f64, by: &str| (101, Moments::Every(every), by.to_owned());
    assert_eq!(springs(&[("output.springs", "{}")]), asked(1e-5, "output.springs"));
    assert_eq!(springs(&[plot]), asked(1e-5, "plots[1]"));
    assert_eq!(springs(&[plot, ("output", "{\"springs\": {}}")]), asked(0.1 / 400.0, "output.springs"));
    assert_eq!(springs(&[plot, ("output", "{}")]), asked(0.1 / 400.0, "plots[1]"));
    let given = r#"{"count": 7, "every": "2 ms"}"#;
    assert_eq!(springs(&[("output.springs", given)]), (7, Moments::Every(2e-3), "output.springs".to_owned()));
}

#[test]
fn curves_are_written_over_the_last_period_by_default() {
    // Ten periods of 10 ms: sixths of the last one.
    let plot = ("plots", "[\"memory\"]");
    for (overrides, by) in [(plot, "plots[0]"), (("output.memory", "{}"), "output.memory")] {
        let scenario = with(QUICKSTART, &[overrides]);
        assert_eq!(scenario.memory.as_ref().unwrap().asked_by, by);
        let known = [550.0, 560.0, 570.0, 580.0, 590.0, 600.0].map(|sixth| sixth / 6.0 * 1e-3);
        for (time, known) in times(&scenario).into_iter().zip(known) {
            assert!((time - known).abs() < 1e-16, "{time} {known}");
        }
        assert_eq!(times(&scenario).last(), Some(&0.1), "the end is the end");
    }
    // Five waveforms with periods, none of them named: the slowest counts.
    let unasked = ("output", "{}");
    assert!((times(&with(FRETTING, &[unasked, plot]))[0] - (2.0 + 1.0 / 6.0)).abs() < 1e-15);
    let slower = ("waveforms.sine 200.sine.period", "2 s");
    assert!((times(&with(FRETTING, &[unasked, plot, slower]))[0] - 4.0 / 3.0).abs() < 1e-15);
    // In a run shorter than a period, the samples cover the run.
    assert!((times(&with(QUICKSTART, &[plot, ("run.duration", "6 ms")]))[0] - 1e-3).abs() < 1e-18);
}

#[test]
fn moments_of_the_curves_are_those_given() {
    let moments = |value: &str| with(QUICKSTART, &[("output.memory", value)]).memory.unwrap().moments;
    assert_eq!(moments(r#"{"every": "25 ms"}"#), Moments::Every(25e-3));
    assert_eq!(moments(r#"{"at": [0, "1 ms", "100 ms"]}"#), Moments::At(vec![0.0, 1e-3, 0.1]));
}
