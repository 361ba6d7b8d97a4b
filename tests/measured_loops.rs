//! Loops of tables: what is measured of them, and what is refused.

use crate::program::{Table, code, listing, run, scenario, stderr, stdout, stickslip};
use std::fmt::Write;
use std::fs;
use std::path::Path;
use std::process::Output;
use tempfile::tempdir;

/// Of the loop: δ, u_c (m) and μF_N (N).
const AMPLITUDE: f64 = 300e-9;
const GROSS_SLIP: f64 = 500e-9;
const LIMIT: f64 = 5.0;

/// F/μF_N of a first loading of a paraboloid (Cattaneo 1938, Mindlin 1949).
fn loaded(u: f64) -> f64 {
    1.0 - (1.0 - u / GROSS_SLIP).powf(1.5)
}

/// Cycles of a Masing loop about 3 µm and 0.2 N, by `change` of both in µm and mN, as `head`ed lines.
fn table(head: &str, cycles: usize, change: impl Fn(usize, f64, f64) -> [f64; 2]) -> String {
    let (mut text, points) = (format!("{head}\n"), 1000);
    for k in 0..=cycles * points {
        let phase = std::f64::consts::TAU * k as f64 / points as f64;
        let u = AMPLITUDE * phase.cos();
        let way = if phase.sin() > 0.0 { AMPLITUDE - u } else { u + AMPLITUDE };
        let force = loaded(AMPLITUDE) - 2.0 * loaded(0.5 * way);
        let force = LIMIT * if phase.sin() > 0.0 { force } else { -force };
        let [u, force] = change(k, 1e6 * u + 3.0, 1e3 * force + 200.0);
        writeln!(text, "{},{u},{force}", k as f64 / points as f64 * 1e3).unwrap();
    }
    text
}

fn measure(folder: &Path, text: &str, arguments: &[&str]) -> Output {
    fs::write(folder.join("rig.csv"), text).unwrap();
    stickslip()
        .args(["measure", "rig.csv", "--out", "out"])
        .args(arguments)
        .current_dir(folder)
        .output()
        .unwrap()
}

/// Amplitudes, opening and lost work of the last cycle against the closed forms of a paraboloid: E_d from the mean of F over the way,
/// ∫₀^δ F dv = μF_N(δ - ⅖u_c(1 - (1 - δ/u_c)^{5/2})).
fn check(folder: &Path, cycles: usize, within: f64) {
    let top = LIMIT * loaded(AMPLITUDE);
    let under = LIMIT * (AMPLITUDE - 0.4 * GROSS_SLIP * (1.0 - (1.0 - AMPLITUDE / GROSS_SLIP).powf(2.5)));
    let half = GROSS_SLIP * (1.0 - (1.0 - 0.5 * top / LIMIT).powf(2.0 / 3.0));
    let table = Table::read(&folder.join("out/cycles.csv"));
    assert_eq!(table.rows.len(), cycles);
    for (name, exact) in [
        ("displacement_amplitude_m", AMPLITUDE),
        ("force_amplitude_N", top),
        ("dissipated_J", 8.0 * under - 4.0 * AMPLITUDE * top),
        ("half_opening_m", AMPLITUDE - 2.0 * half),
    ] {
        let found: f64 = table.column(name).last().unwrap().parse().unwrap();
        assert!((found / exact - 1.0).abs() < within, "{name}: {found:e}, not {exact:e}");
    }
}

#[test]
fn a_loop_of_a_table_has_its_closed_forms() {
    let folder = tempdir().unwrap();
    let as_it_is = |_, u, force| [u, force];
    let output = measure(folder.path(), &table("t [ms],u (um),f (mN)", 3, as_it_is), &["--period", "1 s"]);
    assert_eq!((code(&output), stderr(&output)), (0, String::new()));
    assert!(stdout(&output).contains("measured, 3 cycles"), "{}", stdout(&output));
    check(folder.path(), 3, 1e-4);
    assert_eq!(listing(&folder.path().join("out")), ["cycles.csv", "loop.png"]);
}

/// Noise of 1 %, a load cell that tells what resists, and names of one's own.
#[test]
fn a_noisy_loop_of_the_other_sign_has_them_too() {
    let folder = tempdir().unwrap();
    let mut seed = 1_u32;
    let mut draw = || {
        seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        f64::from(seed) / f64::from(u32::MAX) - 0.5
    };
    let noise: Vec<[f64; 2]> = (0..=5000).map(|_| [0.006 * draw(), 80.0 * draw()]).collect();
    let noisy = |k: usize, u, force: f64| [u + noise[k][0], noise[k][1] - force];
    let text = table("clock [ms],LVDT (um),load_mN", 5, noisy);
    let names = ["--time", "clock", "--displacement", "LVDT", "--force", "load"];
    let output = measure(folder.path(), &text, &names);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    assert_eq!(stderr(&output), "rig.csv: note: the force resists the motion; its sign is turned\n");
    check(folder.path(), 4, 0.03);
}

/// The rows of a run beside the run itself.
#[test]
fn a_simulated_loop_stands_beside() {
    let folder = tempdir().unwrap();
    assert_eq!(code(&run(&scenario("fretting_sphere"), folder.path(), &[])), 0);
    let columns = ["--time", "time_s", "--displacement", "800 nm.u_m", "--force", "800 nm.fx_N"];
    let beside = ["--beside", "fretting_sphere", "--out", "out"];
    let command = |contact: &str| {
        stickslip()
            .args(["measure", "fretting_sphere/trace.csv"])
            .args(columns.iter().chain(&beside))
            .args(["--contact", contact])
            .current_dir(folder.path())
            .output()
            .unwrap()
    };
    let said = stdout(&command("800 nm"));
    let lost = said.lines().find(|line| line.contains("lost per cycle")).unwrap();
    assert!(lost.contains("5.974 µJ") && lost.trim_end().ends_with("5.975 µJ"), "{said}");
    assert!(said.contains("simulated, 800 nm"), "{said}");
    let refused = command("900 nm");
    assert_eq!(code(&refused), 2);
    assert!(stderr(&refused).contains("expected the name of one of its contacts: 200 nm, 400 nm"));
}

#[test]
fn what_is_no_loop_is_refused_and_leaves_nothing() {
    let folder = tempdir().unwrap();
    for (text, arguments, said) in [
        ("", &[][..], "rig.csv: no rows of numbers were found: it is empty"),
        ("a story\nof words\n", &[], "rig.csv: no rows of numbers were found; it begins with \"a story\""),
        ("t,u\n0,0\n", &[], "rig.csv: no column is a force by its name or unit"),
        ("t,u,f\n0,0,nan\n1,1,nan\n", &[], "rig.csv: no column is a force by its name or unit"),
        ("t,u,f\n0,0,0\n1,1,1\n", &["--force", "4"], "rig.csv: there is no column 4 for the force"),
        ("t,u,f\n0,0,0\n1,1,1\n", &["--force", "3:um"], "rig.csv: \"um\" is no unit of a force"),
        (
            "t,u,f\n0,0,0\n1,1,1\n",
            &["--force", "u", "--displacement", "2"],
            "rig.csv: column 2 stands for the displacement and for the force",
        ),
        ("t,u,f\n0,0,0\n1,1,1\n", &["--recipe", "rig.csv"], "rig.csv: not a recipe: "),
        ("t,u,f\n0,0,0\n2,1,1\n1,0,0\n", &[], "rig.csv: t[2] = 1 s comes after 2 s"),
        ("t,u,f\n0,0,0\n1,1,1\n2,2,2\n", &[], "rig.csv: no cycle comes back to within a tenth of its range"),
        ("u,f\n0,0\n1,1\n0,0\n", &["--period", "1 s"], "rig.csv: a period needs a column of times"),
        ("t,u,f\n0,0,0\n1,1,1\n", &["--time", "clock"], "rig.csv: there is no column \"clock\" for the time"),
        ("t (um),u,f\n0,0,0\n1,1,1\n", &["--time", "t"], "rig.csv: \"um\" is no unit of a time"),
    ] {
        let output = measure(folder.path(), text, arguments);
        assert_eq!((code(&output), stdout(&output)), (2, String::new()), "{text}");
        assert!(stderr(&output).starts_with(said), "{text}: {}", stderr(&output));
        assert!(!folder.path().join("out").exists());
    }
}

/// Rows and works of cycles and of what lies outside add up to the record, to rounding. Growing cycles are cycles, and open; those that the
/// record cuts off are none. Amplitudes of 1, 1.6, 2.5, 4, 6.3 and 10 µm, then three at 10 µm: cycles from minimum to minimum have the
/// mean of an amplitude and the next.
#[test]
fn nothing_is_dropped_without_a_word() {
    let folder = tempdir().unwrap();
    let mut text = "t (s),disp (um),force (N)\n".to_owned();
    let amplitudes = [1.0, 1.6, 2.5, 4.0, 6.3, 10.0, 10.0, 10.0, 10.0];
    for row in 0..=200 * amplitudes.len() {
        let phase = std::f64::consts::TAU * row as f64 / 200.0;
        let amplitude = amplitudes[(row / 200).min(amplitudes.len() - 1)];
        let (u, force) = (amplitude * phase.sin(), 3.0 * (8.0 * phase.cos()).tanh());
        writeln!(text, "{},{u:.4},{force:.4}", row as f64 / 200.0).unwrap();
    }
    let output = measure(folder.path(), &text, &["--json"]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let told: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let record = &told["record"];
    let number = |key: &str| record[key].as_f64().unwrap();
    assert_eq!(number("rows_in_cycles") + number("rows_outside"), 1801.0);
    let off = number("work_in_cycles_J") + number("work_outside_J") - number("work_J");
    assert!(off.abs() < 1e-12 * number("work_J"), "{off:e}");
    let stages = told["stages"].as_array().unwrap();
    assert_eq!(stages.last().unwrap()["cycles"], 3, "{told}");
    let table = Table::read(&folder.path().join("out/cycles.csv"));
    let open = table.column("flags").iter().filter(|flags| **flags == "open").count();
    assert_eq!((open, table.rows.len()), (5, 8));
    for (k, amplitude) in table.column("displacement_amplitude_m").iter().take(5).enumerate() {
        let wanted = 0.5e-6 * (amplitudes[k] + amplitudes[k + 1]);
        assert!((amplitude.parse::<f64>().unwrap() / wanted - 1.0).abs() < 1e-4, "{k}: {amplitude}");
    }
}
