//! Results of fretting loops, compared with closed forms and with denser rows.

use std::path::Path;
use stickslip_drive::Entry;
use stickslip_measure::Cycle;
use stickslip_measure::contact_cycles::CycleFigures;
use stickslip_run::{Job, Summary};

fn example(name: &str, set: &[(&str, &str)]) -> Job {
    let file =
        Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios").join(name).with_extension("json");
    prepare(&file, set)
}

fn prepare(file: &Path, set: &[(&str, &str)]) -> Job {
    let set: Vec<_> = set.iter().map(|(key, value)| ((*key).to_owned(), (*value).to_owned())).collect();
    Job::prepare(file, &set, Path::new("")).unwrap()
}

fn last_cycle(job: &Job, c: usize) -> CycleFigures {
    let outcome = job.run(&());
    assert!(outcome.error.is_none());
    outcome.cycles(c).last().unwrap().figures
}

fn near(got: f64, want: f64, within: f64, what: &str) {
    assert!(
        (got - want).abs() <= within * want.abs(),
        "{what}: {got:e}, not {want:e}: {:e}",
        got / want - 1.0
    );
}

/// A paraboloid under a constant load: F = μF_N(1 - (1 - u/u_c)^{3/2}) on first loading (Cattaneo 1938, Mindlin 1949).
///
/// The branches of its loop follow from Masing's rule.
#[test]
fn a_loop_of_a_paraboloid_has_its_closed_forms() {
    let profile = r#"{"paraboloid": {"radius": "10 mm"}}"#;
    let names = ["200 nm", "400 nm"];
    let set: Vec<(String, String)> =
        names.iter().map(|name| (format!("contacts.{name}.profile"), profile.to_owned())).collect();
    let set: Vec<(&str, &str)> = set.iter().map(|(k, v)| (k.as_str(), v.as_str())).collect();
    let job = example("fretting_sphere", &set);
    for (c, amplitude) in [(0, 200e-9), (1, 400e-9)] {
        check_paraboloid(&job, c, amplitude, &last_cycle(&job, c));
    }
}

/// The same for a table of points, with a cycle from each reversal to the next one of its kind.
#[test]
fn the_loops_of_a_table_have_theirs() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/table_loop.json");
    let job = prepare(&file, &[]);
    let outcome = job.run(&());
    let found: Vec<CycleFigures> = outcome.cycles(0).iter().map(|cycle| cycle.figures).collect();
    let times: Vec<[f64; 2]> = found.iter().map(|cycle| cycle.time).collect();
    assert_eq!(times, [[1.0, 5.0], [5.0, 9.0]]);
    found.iter().for_each(|cycle| check_paraboloid(&job, 0, 300e-9, cycle));
}

/// A triangle from 0 to its stroke gives the same loop about another middle.
#[test]
fn a_loop_about_another_middle_is_the_same_loop() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/table_loop.json");
    let triangle = r#"{"triangle": {"stroke": "600 nm", "period": "2 s"}}"#;
    let job = prepare(&file, &[("waveforms.t", triangle)]);
    check_paraboloid(&job, 0, 300e-9, &last_cycle(&job, 0));
    let summary = Summary::new(&job, &job.run(&()));
    let contact = &summary.contacts.0[0].1;
    assert_eq!(contact.fretting.as_ref().and_then(|fretting| fretting.regime), Some("partial"));
}

/// 100 000 time steps of a prescribed motion must run through.
#[test]
fn a_walk_of_many_periods_comes_to_its_end() {
    let job =
        example("fretting_sphere", &[("run.duration", "\"5000 s\""), ("output", "{}"), ("plots", "[]")]);
    let outcome = job.run(&());
    assert!(outcome.error.is_none(), "{:?}", outcome.error);
    assert_eq!(outcome.cycles(0).len(), 5000);
}

fn check_paraboloid(job: &Job, c: usize, amplitude: f64, found: &CycleFigures) {
    let CycleFigures { cycle, is_closed, secants, .. } = found;
    let (u_c, normal) = job.contact_scale(c);
    assert!(amplitude < u_c);
    let limit = f64::from(job.count(c)) * job.model.contacts().nth(c).unwrap().1.friction() * normal;
    let force = |u: f64| limit * (1.0 - (1.0 - u / u_c).powf(1.5));
    // Unloading branch: F = F(δ) - 2F((δ - u)/2). It is zero where F(v) = F(δ)/2, v = u_c(1 - (1 - F/2μF_N)^{2/3}).
    let top = force(amplitude);
    let half = u_c * (1.0 - (1.0 - 0.5 * top / limit).powf(2.0 / 3.0));
    let opening = amplitude - 2.0 * half;
    // Area: from the mean of F over the displacement, ∫₀^δ F dv = μF_N(δ - ⅖u_c(1 - (1 - δ/u_c)^{5/2})).
    let under = limit * (amplitude - 0.4 * u_c * (1.0 - (1.0 - amplitude / u_c).powf(2.5)));
    let lost = 8.0 * under - 4.0 * amplitude * top;
    let window = 0.2 * amplitude;
    let secant = 2.0 * force(0.5 * window) / window;
    assert!(is_closed);
    near(cycle.displacement_amplitude, amplitude, 1e-12, "amplitude");
    near(cycle.force_amplitude, top, 1e-12, "force");
    // Both are small differences of forces. Their rounding error is relative to height and width of the loop.
    near(cycle.dissipated, lost, 1e-11, "friction work");
    near(cycle.half_opening.unwrap(), opening, 1e-11, "opening");
    for found in [cycle.stiffness_after_maximum, cycle.stiffness_after_minimum] {
        near(found.unwrap(), 1.5 * limit / u_c, 1e-12, "tangent");
    }
    for found in secants {
        near(found.unwrap(), secant, 1e-10, "secant");
    }
}

/// Gross slip is determined from the states in the rows, not from A, B and D: worn profiles, rows of few springs, no friction.
#[test]
fn a_loop_is_gross_where_its_contact_slides() {
    let worn = [
        r#"{"truncated_cone": {"flat": "30 um", "slope": 0.02}}"#,
        r#"{"truncated_paraboloid": {"flat": "60 um", "radius": "5 mm"}}"#,
    ];
    let sphere = r#"{"sphere": {"radius": "5 mm"}}"#;
    let rows = [1, 2, 3, 4, 16].map(|count| format!(r#"{{"springs": {{"count": {count}}}}}"#));
    let curve = |profile| [("profile", profile), ("engine", "\"curve\""), ("friction", "0.6")];
    let row = |engine| [("profile", sphere), ("engine", engine), ("friction", "0.6")];
    let slippery = [("profile", sphere), ("engine", "\"curve\""), ("friction", "0")];
    let cases = worn.map(curve).into_iter().chain(rows.each_ref().map(|engine| row(engine.as_str())));
    let mut found = Vec::new();
    for case in cases.chain([slippery]) {
        for amplitude in ["60 nm", "100 nm", "250 nm", "400 nm", "550 nm", "700 nm", "1500 nm"] {
            let set = case.map(|(key, value)| (format!("contacts.200 nm.{key}"), value));
            let mut set: Vec<(&str, &str)> = set.iter().map(|(key, value)| (key.as_str(), *value)).collect();
            set.extend([("waveforms.sine 200.sine.amplitude", amplitude), ("plots", "[]")]);
            set.push(("output", r#"{"every": "1 ms"}"#));
            let job = example("fretting_sphere", &set);
            let regime = job.run(&()).cycles(0).last().unwrap().regime;
            let states = last_period(&job, "200 nm.state");
            let most = states.iter().copied().fold(0.0, f64::max);
            let slides = stickslip_drive::state_name(most) == "slip" || case[2].1 == "0";
            assert_eq!(regime == Some("gross"), slides, "{case:?} {amplitude}: {regime:?}, state {most}");
            found.extend(regime);
        }
    }
    ["partial", "gross"].into_iter().for_each(|regime| assert!(found.contains(&regime), "{regime}"));
    assert!(!found.contains(&"mixed"));
}

/// The dissipated energy of a damped contact is the area of its loop, including the damping losses.
#[test]
fn a_damped_contact_loses_the_area_of_its_loop() {
    let mut set = vec![
        ("contacts.600 nm.damping", "\"20 ms\""),
        ("output.every", "\"0.1 ms\""),
        ("run.stepper", r#"{"event": {"tolerance": 1e-9}}"#),
        ("plots", "[]"),
    ];
    let job = example("fretting_sphere", &set);
    let [u, force] = ["600 nm.u_m", "600 nm.fx_N"].map(|name| last_period(&job, name));
    // Straight lines between 10 000 rows: an error of the order of N⁻².
    let area = Cycle::of_loop(&u, &force).unwrap().dissipated;
    let found = last_cycle(&job, 2);
    near(found.dissipated().unwrap(), area, 1e-6, "E_d");
    let friction = last_period(&job, "600 nm.friction_J");
    near(found.friction(), friction[friction.len() - 1] - friction[0], 1e-12, "friction");
    assert!(found.damping.unwrap() > 0.1 * area, "{found:?}");
    near(found.cycle.energy_ratio().unwrap(), area / found.cycle.enclosing_energy(), 1e-6, "A");
    let undamped = last_cycle(&job, 0);
    assert_eq!((undamped.damping, undamped.dissipated()), (Some(0.0), Some(undamped.friction())));
    // Two damped contacts: the total damping losses cannot be assigned, so E_d is omitted.
    set.push(("contacts.400 nm.damping", "\"20 ms\""));
    let found = last_cycle(&example("fretting_sphere", &set), 2);
    assert!(found.damping.is_none() && found.dissipated().is_none() && found.friction() > 0.0);
}

/// Under a load of 10 N ± 6 N the mean is 10 N at any frequency. A contact that slips at the largest load has force peaks of μ · 16 N.
///
/// Elsewhere the peaks are at least those of dense rows.
#[test]
fn loops_under_a_load_that_varies_have_their_peaks_and_means() {
    let of = |frequency: &str, amplitude: &str, every: &str| {
        let sine = format!(r#"{{"amplitude": "6 N", "offset": "10 N", "frequency": "{frequency} Hz"}}"#);
        let normal = format!(r#"{{"force": {{"follows": {{"sine": {sine}}}}}}}"#);
        let set = [
            ("contacts.200 nm.normal", normal.as_str()),
            ("waveforms.sine 200.sine.amplitude", amplitude),
            ("output.every", every),
            ("plots", "[]"),
        ];
        example("fretting_sphere", &set)
    };
    let sliding = last_cycle(&of("16", "\"5 um\"", "\"1 s\""), 0);
    near(sliding.cycle.force_amplitude, 0.6 * 16.0, 1e-9, "Q*");
    for (frequency, amplitude, every) in [
        ("16", "\"150 nm\"", "\"0.05 ms\""),
        ("50", "\"5 um\"", "\"0.02 ms\""),
        ("128", "\"5 um\"", "\"0.01 ms\""),
    ] {
        let found = last_cycle(&of(frequency, amplitude, "\"1 s\""), 0);
        let job = of(frequency, amplitude, every);
        let [u, force] = ["200 nm.u_m", "200 nm.fx_N"].map(|name| {
            let values = last_period(&job, name);
            let range = values.iter().fold((0.0_f64, 0.0_f64), |(low, high), v| (low.min(*v), high.max(*v)));
            0.5 * (range.1 - range.0)
        });
        near(found.normal, 10.0, 1e-10, "P");
        near(found.cycle.force_amplitude, force, 1e-5, frequency);
        near(found.cycle.displacement_amplitude, u, 1e-9, "δ*");
    }
}

/// A contact that dissipates 8e-13 J per cycle in a model with one that dissipates 8e-3 J.
///
/// An independent spring row program, extrapolated, gives 7.833389e-13 J in the second cycle. The contact alone gives the same value.
#[test]
fn a_loop_beside_a_larger_one_is_what_it_is_alone() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/small_beside_large.json");
    for (tolerance, within) in [("1e-8", 5e-4), ("1e-10", 1e-4), ("1e-12", 1e-5)] {
        let job = prepare(&file, &[("run.stepper.event.tolerance", tolerance)]);
        let outcome = job.run(&());
        near(outcome.cycles(0)[1].figures.dissipated().unwrap(), 7.833389e-13, within, tolerance);
    }
}

/// The energy input of a spring row equals its stored and dissipated energy within 100 tolerances of μF_N u_c, in spite of its kinks.
#[test]
fn the_books_of_a_row_of_springs_close() {
    for (count, tolerance) in [(5, 1e-4), (16, 1e-6), (16, 1e-8), (16, 1e-10), (300, 1e-8)] {
        let engine = format!(r#"{{"springs": {{"count": {count}}}}}"#);
        let stepper = format!(r#"{{"event": {{"tolerance": {tolerance:e}}}}}"#);
        let set = [
            ("contacts.600 nm.engine", engine.as_str()),
            ("run.stepper", stepper.as_str()),
            ("output", r#"{"every": "5 ms"}"#),
            ("plots", "[]"),
        ];
        let job = example("fretting_sphere", &set);
        let missed = last_period(&job, "energy.error_J").iter().fold(0.0_f64, |most, e| most.max(e.abs()));
        let (u_c, normal) = job.contact_scale(2);
        let unit = tolerance * 0.6 * normal * u_c;
        assert!(missed < 100.0 * unit, "{count} springs at {tolerance:e}: {} tolerances", missed / unit);
    }
}

/// Returns a column of the rows and events in the third second of a run.
fn last_period(job: &Job, name: &str) -> Vec<f64> {
    struct Column(usize, Vec<f64>);
    impl stickslip_drive::Record for Column {
        fn take(&mut self, entry: Entry<'_>) {
            if let Entry::Row(values) | Entry::Event(_, values) = entry
                && values[0] >= 2.0
            {
                self.1.push(values[self.0]);
            }
        }
    }
    let place = job.model.channels().iter().position(|channel| channel.name == name).unwrap();
    let mut column = Column(place, Vec::new());
    stickslip_drive::run(&job.model, &job.scenario.plan, &mut job.start.clone(), &mut column).unwrap();
    column.1
}

/// E_d in the table equals the difference of the friction work in rows at both ends of the cycle.
#[test]
fn friction_work_of_a_cycle_is_the_difference_of_the_runs_own() {
    let job = example("fretting_sphere", &[("output.every", "\"1 s\"")]);
    let outcome = job.run(&());
    let channels = job.model.channels();
    let place = |name: &str| channels.iter().position(|channel| channel.name == name).unwrap();
    struct Rows(Vec<Vec<f64>>);
    impl stickslip_drive::Record for Rows {
        fn take(&mut self, entry: Entry<'_>) {
            if let Entry::Row(values) = entry {
                self.0.push(values.to_vec());
            }
        }
    }
    let mut rows = Rows(Vec::new());
    stickslip_drive::run(&job.model, &job.scenario.plan, &mut job.start.clone(), &mut rows).unwrap();
    for (c, (name, _)) in job.model.contacts().enumerate() {
        let at = |k: usize| rows.0[k][place(&format!("{name}.friction_J"))];
        let found = outcome.cycles(c);
        assert_eq!(found.len(), 3, "{name}");
        for (k, cycle) in found.iter().enumerate() {
            near(cycle.figures.cycle.dissipated, at(k + 1) - at(k), 1e-12, name);
        }
    }
}

/// Steps and loops are bit-identical for every integrator.
#[test]
fn figures_do_not_depend_on_the_rows() {
    let figures = |name: &str, stepper: &str, every: &str| {
        let job = example(name, &[("run.stepper", stepper), ("output.every", every), ("plots", "[]")]);
        let outcome = job.run(&());
        assert!(outcome.error.is_none(), "{name} {stepper}");
        let summary: serde_json::Value =
            serde_json::from_str(&Summary::new(&job, &outcome).pretty().unwrap()).unwrap();
        let loops = summary["contacts"].as_object().unwrap().values();
        let loops: Vec<_> = loops.map(|contact| contact["fretting"].clone()).collect();
        (summary["steps"].clone(), loops)
    };
    let steppers = [
        r#"{"event": {"tolerance": 1e-6}}"#,
        r#"{"verlet": {"step": "2 us"}}"#,
        r#"{"rk4": {"step": "2 us"}}"#,
        r#"{"dopri5": {"tolerance": 1e-6}}"#,
    ];
    for stepper in steppers {
        for name in ["quickstart", "three_ball_stage", "oblique_loading"] {
            let wanted = figures(name, stepper, "1e3");
            for every in ["\"31.3 us\"", "\"0.2 ms\""] {
                assert_eq!(figures(name, stepper, every), wanted, "{name}, {stepper}, {every}");
            }
        }
    }
    let sphere = |every| figures("fretting_sphere", r#"{"event": {"tolerance": 1e-8}}"#, every);
    assert_eq!(sphere("\"7 ms\""), sphere("1e3"));
}

/// The contact that holds the vibrated slider is at rest: its amplitude of 8e-25 m is rounding.
#[test]
fn a_contact_at_rest_has_no_loop() {
    let told = |tolerance: &str| {
        let set = [("run.stepper.event.tolerance", tolerance), ("plots", "[]"), ("run.cycles", "8")];
        let job = example("vibrated_slider", &set);
        let summary = Summary::new(&job, &job.run(&()));
        serde_json::to_value(&summary).unwrap()["contacts"]["still"]["fretting"].clone()
    };
    let all = ["1e-5", "1e-6", "1e-8"].map(told);
    for fretting in &all {
        assert_eq!(fretting["regime"], "still", "{fretting}");
        assert_eq!(fretting["cycles"], all[0]["cycles"]);
        let ratios = ["energy_ratio", "slip_ratio", "half_opening_m", "stiffness_after_maximum_N_m"];
        assert!(ratios.iter().all(|ratio| fretting.get(ratio).is_none()), "{fretting}");
    }
}

/// Two sliders in series under a sinusoidal force: the loop between them does not depend on the stepping body. The reference has a thousand
/// rows per cycle.
#[test]
fn a_loop_between_two_sliders_does_not_depend_on_the_body_of_the_figures() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/two_sliders_in_a_row.json");
    let loops = ["b0", "b1", "foot"].map(|body| {
        let job = prepare(&file, &[("figures.body", body), ("figures.steady_motion", "false")]);
        last_cycle(&job, 1)
    });
    let amplitude = |of: &CycleFigures| of.cycle.displacement_amplitude;
    let force = |of: &CycleFigures| of.cycle.force_amplitude;
    for one in &loops {
        near(amplitude(one), amplitude(&loops[2]), 1e-4, "amplitude");
        near(force(one), force(&loops[2]), 1e-4, "force");
    }
    let job = prepare(&file, &[("figures.steady_motion", "false")]);
    let mut trace = stickslip_drive::Trace::new(&job.model);
    let cycle = loops[2].time;
    let every = Some((cycle[1] - cycle[0]) / 997.0);
    let plan = stickslip_drive::Plan { every, ..job.scenario.plan };
    stickslip_drive::run(&job.model, &plan, &mut job.start.clone(), &mut trace).unwrap();
    let column = |name: &str| {
        let place = job.model.channels().iter().position(|channel| channel.name == name).unwrap();
        trace.column(place).collect::<Vec<f64>>()
    };
    let t = column("time_s");
    let half_range = |values: Vec<f64>| {
        let within = values.iter().zip(&t).filter(|(_, t)| (cycle[0]..=cycle[1]).contains(*t));
        let (low, high) =
            within.fold((f64::MAX, f64::MIN), |(low, high), (v, _)| (low.min(*v), high.max(*v)));
        0.5 * (high - low)
    };
    near(half_range(column("c1.u_m")), amplitude(&loops[0]), 1e-3, "amplitude of the rows");
    near(half_range(column("c1.fx_N")), force(&loops[0]), 1e-3, "force of the rows");
}

/// A jump of the waveform moves the contact along a straight path, so the loop equals that of any other flank.
#[test]
fn a_loop_with_a_jump_in_it_is_the_same_loop() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/table_loop.json");
    for waveform in [
        r#"{"sawtooth": {"stroke": "600 nm", "period": "2 s", "flyback": 0}}"#,
        r#"{"trapezoid": {"stroke": "600 nm", "period": "2 s", "rise": 0, "hold": "0.7 s"}}"#,
        r#"{"table": {"points": [[0, 0], [0.5, "600 nm"], [0.5, "100 nm"], [1, 0]], "repeat": true}}"#,
    ] {
        let job = prepare(&file, &[("waveforms.t", waveform)]);
        check_paraboloid(&job, 0, 300e-9, &last_cycle(&job, 0));
    }
}

/// A body held by a spring does not step. Its contact has the same loops whichever body `figures` names, also with fixed time steps.
#[test]
fn loops_of_a_body_on_a_spring_do_not_depend_on_the_body_of_the_figures() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/shaken_block.json");
    let still = ("figures.steady_motion", "false");
    let [block, rig] =
        ["block", "rig"].map(|body| last_cycle(&prepare(&file, &[("figures.body", body), still]), 0).cycle);
    assert_eq!(block, rig);
    // From rows of the run every 20 µs.
    near(block.displacement_amplitude, 2.25475e-7, 1e-5, "amplitude");
    near(block.force_amplitude, 1.50318, 2e-5, "force");
    near(block.half_opening.unwrap(), 6.52789e-8, 1e-5, "opening");
    let constant = [("contacts.ball.normal.force", "5 N"), ("waveforms.w.sine.amplitude", "2 um"), still];
    let [located, fixed] = [r#"{"event": {}}"#, r#"{"rk4": {"step": "2 us"}}"#].map(|stepper| {
        let set: Vec<_> = constant.into_iter().chain([("run.stepper", stepper)]).collect();
        last_cycle(&prepare(&file, &set), 0)
    });
    near(fixed.cycle.half_opening.unwrap(), located.cycle.half_opening.unwrap(), 1e-5, "opening");
    near(fixed.secants[0].unwrap(), located.secants[0].unwrap(), 1e-4, "secant");
}

/// A table with noise of 1 % of its amplitude: cycles extend from maximum to maximum, not between noise peaks.
#[test]
fn noise_on_a_table_makes_no_cycles() {
    let mut seed = 1_u32;
    let mut noise = || {
        seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        f64::from(seed) / f64::from(u32::MAX) - 0.5
    };
    let points: Vec<String> = (0..=2500)
        .map(|k| f64::from(k) / 500.0)
        .map(|t| format!("[{t}, {}]", 300e-9 * ((std::f64::consts::TAU * t).sin() + 0.04 * noise())))
        .collect();
    let table = format!(r#"{{"table": {{"points": [{}]}}}}"#, points.join(","));
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/table_loop.json");
    let job = prepare(&file, &[("waveforms.t", &table), ("run.duration", "5 s")]);
    let smooth = r#"{"sine": {"amplitude": "300 nm", "period": "1 s"}}"#;
    let lost = last_cycle(&prepare(&file, &[("waveforms.t", smooth)]), 0).cycle.dissipated;
    let cycles = job.run(&()).cycles(0).iter().map(|cycle| cycle.figures).collect::<Vec<_>>();
    assert!((3..=5).contains(&cycles.len()), "{}", cycles.len());
    for cycle in cycles {
        assert!((cycle.time[1] - cycle.time[0] - 1.0).abs() < 0.1, "{:?}", cycle.time);
        near(cycle.cycle.dissipated, lost, 0.1, "friction work");
    }
}

/// A slightly damped ball with a large amplitude: the decaying damping force at the onset of slip is no peak beyond the friction limit.
#[test]
fn a_damped_contact_that_slides_pulls_by_its_limit() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/table_loop.json");
    let sine = r#"{"sine": {"amplitude": "100 um", "period": "1 ms"}}"#;
    let set = [("waveforms.t", sine), ("contacts.hertz.damping", "1 ns"), ("run.duration", "3 ms")];
    near(last_cycle(&prepare(&file, &set), 0).cycle.force_amplitude, 5.0, 1e-9, "force");
}

/// Contacts without friction, without load, or open move with their bodies. No event reports this.
#[test]
fn what_never_rubs_moves_all_the_same() {
    let job = prepare(&Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/never_rubs.json"), &[]);
    for c in 0..3 {
        let cycle = last_cycle(&job, c);
        near(cycle.cycle.displacement_amplitude, 600e-9, 1e-9, "amplitude");
        assert!(!cycle.is_still && cycle.cycle.force_amplitude == 0.0 && cycle.cycle.dissipated == 0.0);
    }
}
