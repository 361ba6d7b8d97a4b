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
    assert_eq!(stderr(&output), "rig.csv: note: the force opposes the motion; its sign is reversed\n");
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
    let lost = said.lines().find(|line| line.contains("dissipated energy")).unwrap();
    assert!(lost.contains("5.975 µJ") && lost.trim_end().ends_with("5.975 µJ"), "{said}");
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
        ("t,u\n0,0\n", &[], "rig.csv: no column is the force by its name or unit"),
        ("t,u,f\n0,0,nan\n1,1,nan\n", &[], "rig.csv: no column is the force by its name or unit"),
        ("t,u,f\n0,0,0\n1,1,1\n", &["--force", "4"], "rig.csv: there is no column 4 for the force"),
        ("t,u,f\n0,0,0\n1,1,1\n", &["--force", "3:um"], "rig.csv: \"um\" is not a unit of a force"),
        (
            "t,u,f\n0,0,0\n1,1,1\n",
            &["--force", "u", "--displacement", "2"],
            "rig.csv: column 2 is selected for the displacement and for the force",
        ),
        ("t,u,f\n0,0,0\n1,1,1\n", &["--recipe", "rig.csv"], "rig.csv: not a recipe: "),
        ("t,u,f\n0,0,0\n2,1,1\n1,0,0\n", &[], "rig.csv: t[2] = 1 s follows 2 s"),
        ("t,u,f\n0,0,0\n1,1,1\n2,2,2\n", &[], "rig.csv: no cycle closes within a tenth of its range"),
        (
            "u,f\n0,0\n1,1\n0,0\n",
            &["--period", "1 s"],
            "rig.csv: --period, --from and --to need a column of times",
        ),
        ("t,u,f\n0,0,0\n1,1,1\n", &["--time", "clock"], "rig.csv: there is no column \"clock\" for the time"),
        ("t (um),u,f\n0,0,0\n1,1,1\n", &["--time", "t"], "rig.csv: \"um\" is not a unit of a time"),
    ] {
        let output = measure(folder.path(), text, arguments);
        assert_eq!((code(&output), stdout(&output)), (2, String::new()), "{text}");
        assert!(stderr(&output).starts_with(said), "{text}: {}", stderr(&output));
        assert!(!folder.path().join("out").exists());
    }
}

/// Ten cycles of an elastic-plastic element of 2 N/µm and 5 N, led by 10 µm: E_d = 4·5 N·(10 - 2.5) µm = 150 µJ, half opening 7.5 µm. The force comes five of
/// 200 rows late, and noise of 0.1 % is on both.
fn late_and_noisy() -> String {
    let mut seed = 7_u32;
    let mut draw = || {
        seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (f64::from(seed) / f64::from(u32::MAX) - 0.5) * 12_f64.sqrt()
    };
    let mut text = "t (s),disp (um),force (N)\n".to_owned();
    let (mut forces, mut slip) = (vec![0.0; 5], 0.0);
    let u = |row: usize| 10.0 * (std::f64::consts::TAU * row as f64 / 200.0).sin();
    for row in 0..=2000 {
        slip = f64::clamp(slip, u(row) - 2.5, u(row) + 2.5);
        forces.push(2.0 * (u(row) - slip));
        let force = forces[row];
        writeln!(text, "{},{},{}", row as f64 * 5e-3, u(row) + 0.01 * draw(), force + 0.005 * draw())
            .unwrap();
    }
    text
}

/// The closed forms lie in the intervals of 95 % as the record is, and within narrower ones once the lag is taken out.
#[test]
fn a_lag_is_in_the_intervals_or_taken_out() {
    let folder = tempdir().unwrap();
    let exact = [
        ("displacement_amplitude_m", 10e-6),
        ("force_amplitude_N", 5.0),
        ("dissipated_J", 150e-6),
        ("half_opening_m", 7.5e-6),
        ("half_opening_at_zero_force_m", 7.5e-6),
        ("stiffness_N_m", 2e6),
    ];
    let told = |arguments: &[&str]| -> serde_json::Value {
        let output = measure(folder.path(), &late_and_noisy(), &[&["--json"], arguments].concat());
        assert_eq!(code(&output), 0, "{}", stderr(&output));
        serde_json::from_slice(&output.stdout).unwrap()
    };
    let [raw, corrected] = [told(&[]), told(&["--correct", "lag,drift"])];
    let number =
        |told: &serde_json::Value, name: &str, key: &str| told["results"][name][key].as_f64().unwrap();
    for (name, exact) in exact {
        for told in [&raw, &corrected] {
            let [low, high] = ["low", "high"].map(|key| number(told, name, key));
            assert!(low <= exact && exact <= high, "{name}: {exact:e} is not in {low:e} .. {high:e}");
        }
        assert!((number(&corrected, name, "value") / exact - 1.0).abs() < 5e-3, "{name}: {corrected}");
    }
    let lag = raw["signals"]["lag_s"]["value"].as_f64().unwrap();
    assert!((lag - 25e-3).abs() < 0.5e-3, "{lag}");
    assert!(raw["notes"].to_string().contains("(--correct lag)"), "{raw}");
    assert!((number(&raw, "dissipated_J", "value") / 150e-6 - 1.0) < -0.1);
}

/// A ball under 10 N behind a rig of 20 N/µm, the rig led by 1.2 µm: 8.375 µJ, as a code of the Masing loop of its own has it, and 0.9 µm at the contact. The rig's
/// stiffness is found beside the run to 1 %, and its share of the displacement taken out.
#[test]
fn a_rig_is_taken_out() {
    let folder = tempdir().unwrap();
    let text = r#"{"stickslip": 1, "waveforms": {"motor": {"sine": {"amplitude": "1.2 um", "period": "1 s"}}},
        "bodies": {"rig": {"x": {"follows": "motor"}}, "holder": {"x": "balanced"}},
        "springs": {"arm": {"between": ["rig", "holder"], "direction": "x", "stiffness": "20 N/um"}},
        "contacts": {"ball": {"between": ["holder", "ground"], "materials": ["hardened steel", "hardened steel"],
            "profile": {"sphere": {"radius": "5 mm"}}, "friction": 0.6, "normal": {"force": "10 N"}}},
        "run": {"cycles": 3}, "output": {"every": "5 ms"}}"#;
    fs::write(folder.path().join("rig.json"), text).unwrap();
    assert_eq!(code(&run(&folder.path().join("rig.json"), folder.path(), &[])), 0);
    let told = |arguments: &[&str]| -> Output {
        stickslip()
            .args([
                "measure",
                "rig/trace.csv",
                "--time",
                "time_s",
                "--displacement",
                "rig.x_m",
                "--force",
                "ball.fx_N",
            ])
            .args(["--out", "out", "--json"])
            .args(arguments)
            .current_dir(folder.path())
            .output()
            .unwrap()
    };
    let output = told(&["--rig-stiffness", "fit", "--beside", "rig"]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let told_of: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    for (pointer, exact, within) in [
        ("/with_rig/rig_stiffness_N_m/value", 20e6, 0.01),
        ("/with_rig/results/displacement_amplitude_m/value", 1.2e-6, 1e-3),
        ("/results/displacement_amplitude_m/value", 0.9e-6, 2e-3),
        ("/results/dissipated_J/value", 8.375e-6, 1e-3),
        ("/results/force_amplitude_N/value", 6.0, 2e-3),
    ] {
        let found = told_of.pointer(pointer).and_then(serde_json::Value::as_f64).unwrap();
        assert!((found / exact - 1.0).abs() < within, "{pointer}: {found:e}");
    }
    for (arguments, said) in [
        (&["--rig-stiffness", "fit"][..], "expected --beside with a simulated contact"),
        (&["--rig-stiffness", "0 N/m"], "expected more than 0 N/m"),
        (&["--beside", "rig", "--beside-displacement", "arm.x"], "has no closed cycle along arm.x"),
    ] {
        let output = told(arguments);
        assert_eq!(code(&output), 2);
        assert!(stderr(&output).contains(said), "{}", stderr(&output));
    }
}

/// Of ten cycles those from the third to the fifth, and those between two times.
#[test]
fn cycles_and_times_are_chosen() {
    let folder = tempdir().unwrap();
    for (arguments, cycles) in [(["--cycles", "3..5"], 3), (["--from", "2 s"], 7), (["--cycles", "9.."], 1)] {
        let output = measure(folder.path(), &late_and_noisy(), &arguments);
        assert_eq!(code(&output), 0, "{}", stderr(&output));
        assert_eq!(Table::read(&folder.path().join("out/cycles.csv")).rows.len(), cycles, "{arguments:?}");
    }
    for (arguments, said) in [
        (["--cycles", "0.."], "expected numbers of cycles from 1"),
        (["--cycles", "30.."], "no cycle closes"),
        (["--from", "99 s"], "no rows between --from and --to"),
        (["--correct", "noise"], "[possible values: lag, drift]"),
    ] {
        let output = measure(folder.path(), &late_and_noisy(), &arguments);
        assert_eq!(code(&output), 2, "{}", stdout(&output));
        assert!(stderr(&output).contains(said), "{}", stderr(&output));
    }
}

/// A normal force of 10 N that falls to 8 N: μ_e of each cycle is that of its own mean load, 5 N/(4·P̄) · 4·δ₀/δ₀ = 5/P̄ for an element; the regime follows from its B = 1 and the
/// threshold of a ball, 0.7695. Of many cycles the course is drawn.
#[test]
fn the_load_is_a_channel_and_the_regime_follows_from_the_profile() {
    let folder = tempdir().unwrap();
    let (mut text, mut slip) = ("t (s),disp (um),force (N),Fz (N)\n".to_owned(), 0.0);
    for row in 0..=2000 {
        let u = 10.0 * (std::f64::consts::TAU * row as f64 / 200.0).sin();
        slip = f64::clamp(slip, u - 2.5, u + 2.5);
        writeln!(text, "{},{u},{},{}", row as f64 * 5e-3, 2.0 * (u - slip), 10.0 - 1e-3 * row as f64)
            .unwrap();
    }
    let output = measure(folder.path(), &text, &["--profile", "sphere", "--json"]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let told: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(told["stages"][0]["regime"], "gross", "{told}");
    let table = Table::read(&folder.path().join("out/cycles.csv"));
    for (k, friction) in table.column("energy_coefficient_of_friction").iter().enumerate() {
        let load = 10.0 - 0.001 * (50.0 + 200.0 * (k as f64 + 0.5));
        let exact = 5.0 / load;
        assert!(
            (friction.parse::<f64>().unwrap() / exact - 1.0).abs() < 2e-3,
            "{k}: {friction}, not {exact}"
        );
    }
    assert!(table.column("regime").iter().all(|regime| *regime == "gross"));
    let files = ["cycles.csv", "evolution.png", "log.png", "loop.png"];
    assert_eq!(listing(&folder.path().join("out")), files);
    let refused = measure(folder.path(), &text, &["--profile", "brick"]);
    assert!(stderr(&refused).contains("expected sphere, cone, flat, or a power above 0"));
}

/// A force that is constant, or the displacement itself, encloses nothing; three spikes are left out and counted.
#[test]
fn odd_channels_are_flagged() {
    let folder = tempdir().unwrap();
    let record = |force: &dyn Fn(usize, f64) -> f64| {
        let row = |row: usize| {
            let u = (std::f64::consts::TAU * row as f64 / 100.0).sin();
            format!("{},{u},{}\n", row as f64, force(row, u))
        };
        "t,u,f\n".to_owned() + &(0..=500).map(row).collect::<String>()
    };
    let told = |text: &str| {
        let output = measure(folder.path(), text, &["--json"]);
        assert_eq!(code(&output), 0, "{}", stderr(&output));
        String::from_utf8(output.stdout).unwrap()
    };
    assert!(told(&record(&|_, _| 3.0)).contains("the dissipated energy is not significantly above 0"));
    assert!(told(&record(&|_, u| u)).contains("the dissipated energy is not significantly above 0"));
    let spiked = told(&record(&|row, u| if row % 150 == 70 { 9.0 } else { u }));
    assert!(spiked.contains("spikes left out: 0 of the displacement, 3 of the force"), "{spiked}");
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
