//! `stickslip contact` against the closed forms of the handbook (Popov, Heß, Willert, 2019), section 4.4, written out here.

use crate::program::{Table, code, listing, number, scenario, stderr, stdout, stickslip};
use serde_json::Value;
use std::f64::consts::PI;
use std::path::Path;
use tempfile::tempdir;

/// The quickstart's contact: a paraboloid of 0.5 mm, ruby (400 GPa, .27) on steel (210 GPa, .30), μ = 0.2, 0.3 N.
const RADIUS: f64 = 0.5e-3;
const FRICTION: f64 = 0.2;

/// E\* and G\* (4.13).
fn moduli() -> (f64, f64) {
    let bodies: [(f64, f64); 2] = [(400e9, 0.27), (210e9, 0.30)];
    let normal: f64 = bodies.iter().map(|(e, nu)| (1.0 - nu * nu) / e).sum();
    let tangential: f64 = bodies.iter().map(|(e, nu)| (2.0 - nu) * 2.0 * (1.0 + nu) / (4.0 * e)).sum();
    (1.0 / normal, 1.0 / tangential)
}

/// A first loading of that contact from its indentation and the share c/a of its radius that sticks.
struct Loaded {
    d: f64,
    a: f64,
    normal: f64,
    u: f64,
    c: f64,
    tangential: f64,
    work: f64,
}

impl Loaded {
    fn new(d: f64, share: f64) -> Self {
        let (e, g) = moduli();
        let (a, normal) = ((RADIUS * d).sqrt(), 4.0 / 3.0 * e * RADIUS.sqrt() * d.powf(1.5));
        let kappa = FRICTION * e / g;
        // (4.42) with g = x²/R: 2G*κ²d²a ∫ₛ¹ (1-t²)(t²-s²) dt.
        let s = share;
        let integral = 2.0 / 15.0 - 2.0 / 3.0 * s.powi(2) + 2.0 / 3.0 * s.powi(3) - 2.0 / 15.0 * s.powi(5);
        Self {
            d,
            a,
            normal,
            u: kappa * d * (1.0 - share * share),
            c: share * a,
            tangential: FRICTION * normal * (1.0 - share.powi(3)),
            work: 2.0 * g * (kappa * d).powi(2) * a * integral,
        }
    }
}

fn contact(file: &Path, arguments: &[&str]) -> Value {
    let output = stickslip().arg("contact").arg(file).args(arguments).arg("--json").output().unwrap();
    // A tip yields, which is a warning.
    let warned = stderr(&output);
    assert!(
        code(&output) == 0 && (warned.is_empty() || warned.contains("begins to yield")),
        "{arguments:?}: {warned}"
    );
    serde_json::from_str(&stdout(&output)).unwrap()
}

fn close(found: &Value, pointer: &str, want: f64, within: f64) {
    let got = number(found, pointer);
    assert!((got - want).abs() <= within * want.abs(), "{pointer}: {got:e}, expected {want:e}");
}

/// Writes the files of a contact; returns what was said.
fn written(file: &Path, arguments: &[&str], out: &Path) -> String {
    let output = stickslip().arg("contact").arg(file).args(arguments).arg("--out").arg(out).output().unwrap();
    assert_eq!((code(&output), stderr(&output).as_str()), (0, ""), "{arguments:?}");
    stdout(&output)
}

/// Rows of a table of one corner: the columns asked for.
fn rows<const N: usize>(folder: &Path, name: &str, corner: f64, columns: [&str; N]) -> Vec<[f64; N]> {
    let table = Table::read(&folder.join(name));
    let numbers =
        |name: &str| -> Vec<f64> { table.column(name).iter().map(|cell| cell.parse().unwrap()).collect() };
    let corners = numbers("corner");
    let columns = columns.map(numbers);
    let at = |row: usize| columns.each_ref().map(|column| column[row]);
    (0..corners.len()).filter(|row| corners[*row] == corner).map(at).collect()
}

#[test]
fn constants_and_curves_are_those_of_the_handbook() {
    let found = contact(&scenario("quickstart"), &[]);
    let (e, g) = moduli();
    close(&found, "/constants/normal_modulus_Pa", e, 1e-14);
    close(&found, "/constants/tangential_modulus_Pa", g, 1e-14);
    let d = (0.3 * 3.0 / (4.0 * e * RADIUS.sqrt())).powf(2.0 / 3.0);
    close(&found, "/pressed/indentation_m", d, 1e-14);
    close(&found, "/pressed/gross_slip_displacement_m", FRICTION * e / g * d, 1e-14);
    close(&found, "/pressed/peak_pressure_Pa", 1.5 * 0.3 / (PI * RADIUS * d), 1e-13);
    close(&found, "/pressed/tangential_stiffness_N_m", 2.0 * g * (RADIUS * d).sqrt(), 1e-14);
    assert_eq!(found["normal"].as_array().unwrap().len(), 11);
    for row in found["normal"].as_array().unwrap() {
        let d = number(row, "/indentation_m");
        close(row, "/normal_force_N", 4.0 / 3.0 * e * RADIUS.sqrt() * d.powf(1.5), 1e-14);
    }
    for row in found["universal"].as_array().unwrap() {
        let share = number(row, "/stick_share");
        close(row, "/force_share", 1.0 - share.powi(3), 1e-14);
        let [first, second] =
            ["/tangential_force_N", "/tangential_force_by_integral_N"].map(|p| number(row, p));
        assert!((first - second).abs() <= 1e-13 * 0.06, "{first:e} {second:e}");
    }
}

#[test]
fn nine_queries_have_one_answer() {
    let want = Loaded::new(2e-7, 0.6);
    let text = |value: f64| format!("{value:e}");
    let normal = [("--indentation", want.d), ("--radius", want.a), ("--force", want.normal)];
    let tangential =
        [("--displacement", want.u), ("--stick-radius", want.c), ("--tangential", want.tangential)];
    for (pressed, p) in normal {
        for (pushed, q) in tangential {
            let found = contact(&scenario("quickstart"), &[pressed, &text(p), pushed, &text(q)]);
            for (pointer, value) in [
                ("/loading/indentation_m", want.d),
                ("/loading/contact_radius_m", want.a),
                ("/loading/normal_force_N", want.normal),
                ("/loading/displacement_m", want.u),
                ("/loading/stick_radius_m", want.c),
                ("/loading/tangential_force_N", want.tangential),
                ("/loading/tangential_force_by_integral_N", want.tangential),
                ("/loading/friction_work_J", want.work),
            ] {
                close(&found, pointer, value, 1e-12);
            }
        }
    }
    // With units, and pushed the other way.
    let found = contact(&scenario("quickstart"), &["--indentation", "200 nm", "--tangential", "-10 mN"]);
    assert!(number(&found, "/loading/displacement_m") < 0.0);
}

#[test]
fn a_cone_and_a_flat_punch_have_their_universal_curves() {
    let cone = "contacts.ball.profile={\"cone\":{\"slope\":0.05}}";
    for row in contact(&scenario("quickstart"), &["--set", cone])["universal"].as_array().unwrap() {
        close(row, "/force_share", 1.0 - number(row, "/stick_share").powi(2), 1e-13);
    }
    let flat = "contacts.ball.profile={\"flat\":{\"radius\":\"10 um\"}}";
    let found = contact(&scenario("quickstart"), &["--set", flat]);
    assert!(found["pressed"]["peak_pressure_Pa"].is_null());
    for row in found["universal"].as_array().unwrap() {
        close(row, "/force_share", number(row, "/displacement_share"), 1e-13);
    }
}

#[test]
fn a_page_has_formulas_of_worn_profiles_and_what_their_pair_neglects() {
    let profiles = [
        (r#"{"truncated_cone":{"flat":"1 um","slope":0.05}}"#, "x tanθ arccos(b/x)"),
        (r#"{"truncated_paraboloid":{"flat":"1 um","radius":"0.5 mm"}}"#, "(x/R) √(x²-b²)"),
        (r#"{"rounded_flat":{"flat":"1 um","radius":"0.5 mm"}}"#, "(r-b)²/2R"),
        (r#"{"tipped_paraboloid":{"radius":"0.5 mm","tip":"1 um"}}"#, "arcsin(b/x)"),
        (r#"{"powers":{"terms":[{"coefficient":1000,"exponent":2}]}}"#, "Σ κₙ A xⁿ"),
    ];
    for (profile, formula) in profiles {
        let set = format!("contacts.ball.profile={profile}");
        let output =
            stickslip().arg("contact").arg(scenario("quickstart")).args(["--set", &set]).output().unwrap();
        assert!(stdout(&output).contains(formula), "{profile}: {}{}", stdout(&output), stderr(&output));
        assert!(!stdout(&output).contains("numerical"), "{profile}");
    }
    let found = contact(&scenario("quickstart"), &[]);
    let beta = number(&found, "/constants/dundurs_beta");
    close(&found, "/constants/neglected_stiffness", beta.atanh() / beta - 1.0, 1e-10);
    assert!(found["constants"]["similarity"].as_str().unwrap().contains("order β²"));
}

#[test]
fn a_history_has_its_loop_its_fields_and_its_springs() {
    let folder = tempdir().unwrap();
    let want = Loaded::new(2e-7, 0.6);
    let history = format!("{:e}, {:e}, {:e}", want.u, -want.u, want.u);
    let said =
        written(&scenario("quickstart"), &["--indentation", "200 nm", "--history", &history], folder.path());
    assert!(said.contains("CORNER") && said.contains("contact.json"), "{said}");
    let names = [
        "contact.json",
        "fields.csv",
        "fields.png",
        "friction.csv",
        "friction.png",
        "history.csv",
        "line.csv",
        "loop.png",
        "memory.png",
        "normal.csv",
        "profile.png",
        "substitute.png",
        "universal.csv",
    ];
    assert_eq!(listing(folder.path()), names);
    let json: Value =
        serde_json::from_slice(&std::fs::read(folder.path().join("contact.json")).unwrap()).unwrap();
    for (corner, sense, legs) in [(1, 1.0, 1.0), (2, -1.0, 3.0), (3, 1.0, 5.0)] {
        let at = |name: &str| format!("/corners/{corner}/{name}");
        close(&json, &at("tangential_force_N"), sense * want.tangential, 1e-12);
        close(&json, &at("stick_radius_m"), want.c, 1e-12);
        // A cycle costs four times the first loading, each way twice.
        close(&json, &at("friction_work_J"), legs * want.work, 1e-12);
    }
    let fields = rows(folder.path(), "fields.csv", 1.0, ["r_m", "pressure_Pa", "shear_Pa", "displacement_m"]);
    // τ(0)/p₀ = μ(1-c/a); the centre moves with the indenter.
    let [_, pressure, shear, displacement] = fields[0];
    assert!((shear / pressure - FRICTION * 0.4).abs() < 1e-14);
    assert!((displacement - want.u).abs() < 1e-12 * want.u);
    let step = fields[1][0];
    let integral = |k: usize| fields.iter().map(|row| 2.0 * PI * row[0] * row[k] * step).sum::<f64>();
    assert!(
        (integral(1) / want.normal - 1.0).abs() < 2e-3 && (integral(2) / want.tangential - 1.0).abs() < 2e-3
    );
    let springs = rows(folder.path(), "line.csv", 2.0, ["fz_N", "fx_N", "qx_N_m", "limit_N_m", "kz_N_m"]);
    let sum = |k: usize| springs.iter().map(|row| row[k]).sum::<f64>();
    assert!((sum(0) / want.normal - 1.0).abs() < 1e-3 && (sum(1) / -want.tangential - 1.0).abs() < 1e-3);
    assert!(springs.iter().all(|row| row[2].abs() <= row[3] * (1.0 + 1e-12)));
    let (e, _) = moduli();
    assert!((sum(4) / (e * 3.0 * want.a) - 1.0).abs() < 1e-12);
    // The map of the last step adds up to the work, by rings.
    let map = rows(folder.path(), "friction.csv", 3.0, ["share", "r_m", "work_J_m2"]);
    let last: Vec<&[f64; 3]> = map.iter().filter(|row| row[0] == 1.0).collect();
    let ring = last[1][1] - last[0][1];
    let work: f64 = last.iter().map(|row| 2.0 * PI * row[1] * row[2] * ring).sum();
    // Eighty-one rings miss 2e-3 of it, by the root with which it ends at the edge.
    assert!((work / (5.0 * want.work) - 1.0).abs() < 4e-3, "{work:e}");
}

#[test]
fn a_history_of_forces_reaches_them_and_comes_from_a_table_as_well() {
    let (folder, again) = (tempdir().unwrap(), tempdir().unwrap());
    let quickstart = scenario("quickstart");
    let table = folder.path().join("path.csv");
    std::fs::write(&table, "n,FX (mN),fn [mN]\n1,0,100\n2,12,200\n3,-20,300\n").unwrap();
    let text = "100 mN : 0 N, 200 mN : 12 mN, 300 mN : -20 mN";
    let by_text = contact(&quickstart, &["--history", text, "--out", again.path().to_str().unwrap()]);
    let by_table = contact(
        &quickstart,
        &["--history", table.to_str().unwrap(), "--out", again.path().to_str().unwrap(), "--format", "svg"],
    );
    assert_eq!(by_text["corners"], by_table["corners"]);
    for (corner, normal, tangential) in [(0, 0.1, 0.0), (1, 0.2, 0.012), (2, 0.3, -0.02)] {
        close(&by_text, &format!("/corners/{corner}/normal_force_N"), normal, 1e-12);
        let force = number(&by_text, &format!("/corners/{corner}/tangential_force_N"));
        assert!((force - tangential).abs() < 1e-14, "{force:e}");
    }
    // The later files take the place of the earlier ones.
    let names = listing(again.path());
    assert!(names.contains(&"loop.svg".to_owned()) && !names.contains(&"loop.png".to_owned()), "{names:?}");
}

/// Twenty micrometres without their unit are 20 m; a is 9.079 µm.
#[test]
fn a_history_beyond_a_hundred_contact_radii_is_warned_of() {
    let out = tempdir().unwrap();
    let said = |history: &str| {
        let mut command = stickslip();
        command.arg("contact").arg(scenario("quickstart")).args(["--quiet", "--history", history]);
        let output = command.arg("--out").arg(out.path()).output().unwrap();
        assert_eq!(code(&output), 0, "{}", stderr(&output));
        stderr(&output)
    };
    let words = "warning: corner 1 of the history is at a displacement of 20.00 m, 2203003 contact radii of 9.079 µm: the limit";
    assert!(
        said("20, -20").starts_with(words)
            && said("0, -909 um").starts_with("warning: corner 2 of the history")
    );
    assert_eq!([said("907 um, -907 um"), said("20 um, -20 um")], ["", ""]);
}

#[test]
fn an_animation_has_a_frame_for_every_step_of_its_legs() {
    let folder = tempdir().unwrap();
    let arguments = ["--history", "20 nm, -20 nm", "--animate"];
    written(&scenario("quickstart"), &arguments, folder.path());
    let bytes = std::fs::read(folder.path().join("cycle.png")).unwrap();
    // The chunk acTL has the number of frames, and fcTL stands before each.
    let count = |name: &[u8]| bytes.windows(4).filter(|four| *four == name).count();
    let control = bytes.windows(4).position(|four| four == b"acTL").unwrap();
    assert_eq!((&bytes[control + 4..control + 8], count(b"fcTL")), (&[0, 0, 0, 24][..], 24));
}

#[test]
fn an_open_contact_is_an_answer_and_a_list_of_springs_has_no_fields() {
    let open = contact(&scenario("quickstart"), &["--indentation", "-1 um", "--tangential", "0 N"]);
    assert_eq!(open["loading"]["state"], "open");
    assert_eq!(number(&open, "/loading/contact_radius_m"), 0.0);
    let text =
        stickslip().arg("contact").arg(scenario("quickstart")).args(["--force", "0 N"]).output().unwrap();
    assert_eq!(code(&text), 0);
    assert!(stdout(&text).contains("the contact is open"), "{}", stdout(&text));
    // Of a folder with fields nothing is left that the list does not have.
    let folder = tempdir().unwrap();
    written(&scenario("quickstart"), &["--displacement", "10 nm"], folder.path());
    assert!(folder.path().join("fields.csv").exists());
    let list = r#"contacts.ball.profile={"foundation":{"heights":["0 nm","10 nm","30 nm"],"length":"5 um"}}"#;
    written(&scenario("quickstart"), &["--set", list, "--displacement", "10 nm"], folder.path());
    let names = listing(folder.path());
    assert!(!names.contains(&"fields.csv".to_owned()) && names.contains(&"line.csv".to_owned()), "{names:?}");
    let json: Value =
        serde_json::from_slice(&std::fs::read(folder.path().join("contact.json")).unwrap()).unwrap();
    assert!(
        json["notes"][0].as_str().unwrap().contains("fields and friction work per area are not computed")
    );
    let springs = rows(folder.path(), "line.csv", 1.0, ["fz_N", "length_m"]);
    assert!((springs.iter().map(|row| row[0]).sum::<f64>() / 0.3 - 1.0).abs() < 1e-12);
    assert!(springs.iter().all(|row| (row[1] / 5e-6 - 1.0).abs() < 1e-12));
}

#[test]
fn what_cannot_be_answered_is_refused_and_leaves_nothing() {
    let folder = tempdir().unwrap();
    let out = folder.path().join("out");
    let table = folder.path().join("h.csv");
    let cases: [(&str, &[&str], &str, &str); 14] = [
        (
            "quickstart",
            &["--tangential", "1 N"],
            "",
            "--tangential  expected a tangential force within the limit",
        ),
        ("quickstart", &["--force", "-1 N"], "", "--force  expected a normal force of at least 0 N"),
        ("quickstart", &["--radius", "-1 um"], "", "--radius  expected a contact radius"),
        ("quickstart", &["--radius", "9 um", "--stick-radius", "10 um"], "", "--stick-radius  expected"),
        ("quickstart", &["--displacement", "1 s"], "", "s is a unit of a time"),
        ("quickstart", &["--force", "1 N", "--radius", "1 um"], "", "cannot be used with"),
        ("quickstart", &["--contact", "bal"], "", "did you mean \"ball\"?"),
        ("fretting_sphere", &[], "", "expected --contact, because the scenario has 5"),
        ("fretting_sphere", &["--contact", "200 nm", "--indentation", "1 m"], "", "the range of the profile"),
        ("quickstart", &["--history", "1 um, , 2 um"], "", "expected a length or a force, got an empty text"),
        ("quickstart", &["--history", "1 um, 3 s"], "", "--history  expected a length"),
        ("quickstart", &["--history", "10 mN, 70 mN"], "", "corner 2 of the history: expected a tangential"),
        ("quickstart", &["--history", "TABLE"], "u (s)\n1\n", "h.csv:1:1  expected the unit of a length"),
        ("quickstart", &["--history", "TABLE"], "x,d (nm)\n1,2\n", "h.csv:1:1  expected a column u or fx"),
    ];
    for (name, arguments, text, words) in cases {
        std::fs::write(&table, text).unwrap();
        let arguments: Vec<&str> = arguments
            .iter()
            .map(|argument| if *argument == "TABLE" { table.to_str().unwrap() } else { argument })
            .collect();
        let output =
            stickslip().arg("contact").arg(scenario(name)).args(&arguments).arg("--out").arg(&out).output();
        let output = output.unwrap();
        assert_eq!((code(&output), stdout(&output).as_str()), (2, ""), "{arguments:?}");
        assert!(stderr(&output).contains(words), "{arguments:?}: {}", stderr(&output));
        assert!(!out.exists(), "{arguments:?}");
    }
}

/// The table of docs/theory/contact_mechanics.md: item, command, and what of it answers.
#[test]
fn the_handbooks_list_is_answered_by_the_commands_that_the_page_names() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let page = std::fs::read_to_string(root.join("docs/theory/contact_mechanics.md")).unwrap();
    let folder = tempdir().unwrap();
    let rows: Vec<Vec<&str>> = page
        .lines()
        .filter(|line| line.starts_with("| ") && line.contains("`stickslip "))
        .map(|line| line.trim_matches('|').split(" | ").map(str::trim).collect())
        .collect();
    let mut numbers: Vec<u32> = rows.iter().map(|row| row[0].parse().unwrap()).collect();
    numbers.sort_unstable();
    // An item may have several commands.
    numbers.dedup();
    assert_eq!(numbers, (1..=29).collect::<Vec<u32>>());
    let mut known: Vec<(String, String)> = Vec::new();
    for row in &rows {
        let spans = |cell: &str| cell.split('`').skip(1).step_by(2).map(str::to_owned).collect::<Vec<_>>();
        let command = spans(row[2]).remove(0);
        let said =
            known.iter().find(|(of, _)| *of == command).map(|(_, said)| said.clone()).unwrap_or_else(|| {
                let said = obeyed(&command, &root, folder.path());
                known.push((command.clone(), said.clone()));
                said
            });
        for answer in spans(row[3]) {
            match answer.split_once(": ") {
                Some((file, column)) => {
                    let place = [folder.path().join("results"), folder.path().join("here")]
                        .iter()
                        .flat_map(|at| {
                            [at.clone(), at.join("oblique_loading"), at.join("quickstart-contact")]
                        })
                        .map(|at| at.join(file))
                        .find(|at| at.exists());
                    let table = Table::read(&place.unwrap_or_else(|| panic!("{answer} of {command}")));
                    assert!(!table.column(column).is_empty(), "{answer} of {command}");
                }
                None if answer.ends_with(".png") => {
                    let at = folder.path().join("results").join(&answer);
                    assert!(at.exists(), "{answer} of {command}");
                }
                None => assert!(said.contains(&answer), "{answer} of {command}: {said}"),
            }
        }
    }
}

/// What a command of the page says; words in quotes are one argument.
fn obeyed(command: &str, root: &Path, folder: &Path) -> String {
    let mut arguments: Vec<String> = Vec::new();
    let quote = if command.contains('\'') { '\'' } else { '"' };
    for (i, part) in command.split(quote).enumerate() {
        if i % 2 == 1 {
            arguments.push(part.to_owned());
        } else {
            arguments.extend(part.split_whitespace().map(str::to_owned));
        }
    }
    let arguments = arguments.iter().skip(1).map(|argument| {
        if argument.starts_with("scenarios/") {
            root.join(argument).display().to_string()
        } else {
            argument.clone()
        }
    });
    let output = stickslip().args(arguments).current_dir(folder).output().unwrap();
    assert_eq!(code(&output), 0, "{command}: {}", stderr(&output));
    stdout(&output)
}

/// A ball of structural steel yields under 2 kN: `contact` prints the warning of `check`, for this contact only.
#[test]
fn a_contact_that_yields_is_warned_of() {
    let set = ["contacts.800 nm.materials=[\"steel\",\"steel\"]", "contacts.800 nm.normal.force=2 kN"];
    let said = |contact: &str| {
        let mut command = stickslip();
        command.arg("contact").arg(scenario("fretting_sphere")).args(["--contact", contact]);
        command.args(set.iter().flat_map(|set| ["--set", set]));
        let output = command.output().unwrap();
        assert_eq!(code(&output), 0, "{}", stderr(&output));
        stderr(&output)
    };
    assert!(said("800 nm").contains("begins to yield"), "{}", said("800 nm"));
    assert_eq!(said("200 nm"), "");
}
