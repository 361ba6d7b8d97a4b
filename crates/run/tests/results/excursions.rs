//! Warnings about large angles, rolling and falling, compared with closed forms.

use std::path::Path;
use stickslip_run::{Job, Summary, Warning};

/// Returns the warnings about the results of a run.
fn warnings(file: &str, set: &[(&str, &str)]) -> Vec<Warning> {
    let set: Vec<_> = set.iter().map(|(path, value)| ((*path).to_owned(), (*value).to_owned())).collect();
    let job = Job::prepare(Path::new(file), &set, Path::new("")).unwrap_or_else(|error| panic!("{error}"));
    let mut said = Summary::new(&job, &job.run(&())).warnings;
    said.retain(Warning::is_of_results);
    said
}

fn kinds(said: &[Warning]) -> Vec<&str> {
    said.iter().map(|warning| warning.kind).collect()
}

/// A ball of radius 5 mm that rolls at 0.1 m/s rotates at 20 rad/s. Its deepest indentation is d = (15 mg/(8 E*√R))^⅔ = 43.31 nm (Hertz).
///
/// There a = √(Rd) = 14.72 µm, which it rolls in 147 µs. The first row of the touch is at 1 µs.
#[test]
fn rolling_is_warned_of_beyond_the_contact_radius_and_turning_beyond_a_tenth_of_a_radian() {
    let file = "tests/data/rolls_on_one_patch.json";
    let said = |duration: &str| warnings(file, &[("run.duration", duration), ("output.every", "1 us")]);
    let (both, rolls, before) = (said("5.05 ms"), said("0.16 ms"), said("0.145 ms"));
    assert_eq!(kinds(&both), ["angle", "rolling"]);
    assert!(
        both[0]
            .message
            .starts_with("ball rotates by 101.0 mrad, beyond the limit of small angles, 100.0 mrad"),
        "{both:?}"
    );
    assert_eq!(kinds(&said("4.95 ms")), ["rolling"]);
    assert_eq!(kinds(&rolls), ["rolling"]);
    assert!(
        rolls[0].message.starts_with("c rolls by 15.90 µm, more than its contact radius of 14.72 µm"),
        "{rolls:?}"
    );
    assert_eq!(before, []);
}

/// The contact is 5 mm beside the centre of mass and 1 mm below it. It moves up faster than the body falls: g/2·t² is 1 mm after 14.28 ms.
///
/// A bouncing ball and a body that starts 2 mm above the ground fall onto their contacts.
#[test]
fn a_fall_through_the_ground_is_warned_of_and_one_onto_it_is_not() {
    let file = "tests/data/spins_30_rad.json";
    let said = |set: &[(&str, &str)]| warnings(file, set);
    let through = said(&[]);
    assert_eq!(kinds(&through), ["angle", "through_ground"]);
    let words = "it was 12.26 mm below the position at which its contacts close, more than its height of 1.000 mm above them";
    assert!(through[1].message.contains(words), "{through:?}");
    assert!(through[0].message.starts_with("b rotates by 30.00 rad"), "{through:?}");
    assert_eq!(kinds(&said(&[("run.duration", "14.4 ms")])), ["angle", "through_ground"]);
    assert_eq!(kinds(&said(&[("run.duration", "14.2 ms")])), ["angle"]);
    let drop =
        [("bodies.b.start", r#"{"z": "2 mm"}"#), ("contacts.c.at.b.x", "0"), ("run.duration", "60 ms")];
    assert_eq!(said(&drop), []);
    assert_eq!(warnings("../../scenarios/bouncing_ball.json", &[]), []);
}
