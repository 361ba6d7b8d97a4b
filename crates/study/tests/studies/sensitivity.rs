//! Sensitivities, compared with closed forms; and errors.

use crate::prepared;
use std::error::Error;
use std::fs;
use std::path::{Path, PathBuf};
use stickslip_study::sensitivity::{
    Asked, Derivative, Missing, Sensitivity, SensitivityError, Slope, Split, Taken, csv, json,
};

type Checked = Result<(), Box<dyn Error>>;

/// Young's modulus, Pa, and Poisson's ratio of steel.
const MODULUS: f64 = 210e9;
const POISSON: f64 = 0.3;

/// Relative accuracy of a slope.
const WITHIN: f64 = 1e-4;

fn example(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios").join(name)
}

fn ask(file: &Path, set: &[(&str, &str)], asked: &Asked) -> Result<Sensitivity, SensitivityError> {
    let set: Vec<(String, String)> = set.iter().map(|(p, v)| ((*p).to_owned(), (*v).to_owned())).collect();
    Sensitivity::new(prepared(file, &set)?, asked, &())
}

fn of(figures: &[&str], paths: &[&str]) -> Asked {
    let names = |names: &[&str]| names.iter().map(|name| (*name).to_owned()).collect();
    Asked { of: names(figures), to: names(paths), ..Asked::default() }
}

/// Returns the derivatives of a scenario.
fn taken(file: &Path, set: &[(&str, &str)], asked: &Asked) -> Result<(Sensitivity, Taken), SensitivityError> {
    let asked = ask(file, set, asked)?;
    let taken = asked.take(2, &());
    Ok((asked, taken))
}

fn known(derivative: &Derivative) -> Result<Slope, String> {
    match derivative {
        Derivative::Known(slope) => Ok(*slope),
        other => Err(format!("{other:?}")),
    }
}

/// Checks a slope, within its own error and within a relative tolerance.
fn is(derivative: &Derivative, wanted: f64, within: f64) -> Checked {
    let slope = known(derivative)?;
    let off = (slope.value - wanted).abs();
    assert!(
        off <= within * wanted.abs(),
        "{:e} instead of {wanted:e}: {:e}",
        slope.value,
        off / wanted.abs()
    );
    assert!(off <= slope.error, "{:e} instead of {wanted:e}: {off:e} in {:e}", slope.value, slope.error);
    Ok(())
}

/// Writes a scenario to a temporary folder.
fn scene(text: &str) -> Result<(tempfile::TempDir, PathBuf), Box<dyn Error>> {
    let folder = tempfile::tempdir()?;
    let file = folder.path().join("scene.json");
    fs::write(&file, text)?;
    Ok((folder, file))
}

/// m ẍ = F - kx from rest: x = (F/k)(1 - cos ωt), ω² = k/m, with analytical derivatives.
#[test]
fn a_linear_oscillator_has_the_derivatives_of_its_closed_form() -> Checked {
    let (m, k, force, t) = (0.02, 3e5_f64, 0.5, 4e-3);
    let (_folder, file) = scene(&format!(
        r#"{{ "stickslip": 1,
            "bodies": {{ "mass": {{ "mass": {m}, "x": "free" }} }},
            "springs": {{ "spring": {{ "between": ["ground", "mass"], "stiffness": {k} }} }},
            "loads": [ {{ "on": "mass", "x": {force} }} ],
            "run": {{ "duration": {t} }}, "output": {{ "every": 1e-3 }} }}"#
    ))?;
    let paths = ["bodies.mass.mass", "springs.spring.stiffness", "loads[0].x"];
    let (asked, taken) = taken(&file, &[], &of(&["mass.x_m", "mass.vx_m_s"], &paths))?;
    let omega = (k / m).sqrt();
    let (x, v) = (force / k * (1.0 - (omega * t).cos()), force / k * omega * (omega * t).sin());
    assert!(
        (asked.figures[0].value / x - 1.0).abs() < 1e-9 && (asked.figures[1].value / v - 1.0).abs() < 1e-9
    );
    // Derivatives with respect to ω at constant F/k.
    let (x_omega, v_omega) =
        (force / k * t * (omega * t).sin(), force / k * ((omega * t).sin() + omega * t * (omega * t).cos()));
    let (by_m, by_k) = (-omega / (2.0 * m), omega / (2.0 * k));
    let wanted = [
        [x_omega * by_m, x_omega * by_k - x / k, x / force],
        [v_omega * by_m, v_omega * by_k - v / k, v / force],
    ];
    for (found, wanted) in taken.derivatives.iter().zip(wanted) {
        for (found, wanted) in found.iter().zip(wanted) {
            is(found, wanted, WITHIN)?;
        }
    }
    Ok(())
}

/// Hertz and Cattaneo–Mindlin in closed form: a ball of 1 mm pressed by 1 N, u forward by 0.7 u_c and back by 0.5 u_c.
/// F_x = μF_N[φ(U₁) - 2φ(W/2)], φ(U) = 1 - (1-U)^(3/2), U = u/u_c, u_c = μ(E*/G*)d, d = (3F_N/4E*√R)^(2/3).
#[test]
fn a_contact_led_through_a_history_has_the_derivatives_of_its_closed_form() -> Checked {
    let (mu, normal, radius) = (0.15, 1.0, 1e-3);
    let (shear, plane) = (MODULUS / (2.0 * (1.0 + POISSON)), MODULUS / (2.0 * (1.0 - POISSON * POISSON)));
    let tangential = shear * 4.0 / (2.0 * (2.0 - POISSON));
    let depth = (3.0 * normal / (4.0 * plane * f64::sqrt(radius))).powf(2.0 / 3.0);
    let natural = mu * plane / tangential * depth;
    let (out, back) = (0.7 * natural, 0.5 * natural);
    let (_folder, file) = scene(&format!(
        r#"{{ "stickslip": 1,
            "materials": {{ "steel": {{ "youngs_modulus": {MODULUS}, "poisson_ratio": {POISSON} }} }},
            "waveforms": {{ "way": {{ "table": {{ "points": [[0, 0], [1, {out:e}], [2, {:e}]] }} }} }},
            "bodies": {{ "foot": {{ "x": {{ "follows": "way" }} }} }},
            "contacts": {{ "ball": {{ "between": ["ground", "foot"], "materials": ["steel", "steel"],
                "profile": {{ "paraboloid": {{ "radius": {radius} }} }}, "friction": {mu}, "normal": {{ "force": {normal} }} }} }},
            "run": {{ "duration": 2 }}, "output": {{ "every": 0.1 }} }}"#,
        out - back
    ))?;
    let paths =
        ["contacts.ball.friction", "contacts.ball.normal.force", "contacts.ball.profile.paraboloid.radius"];
    let (asked, taken) = taken(&file, &[], &of(&["ball.fx_N"], &paths))?;
    let phi = |u: f64| 1.0 - (1.0 - u).powf(1.5);
    let slope = |u: f64| 1.5 * (1.0 - u).sqrt();
    let parts = [(1.0, 0.7), (-2.0, 0.25)];
    let force = parts.iter().map(|(count, u)| count * mu * normal * phi(*u)).sum::<f64>();
    let found = asked.figures[0].value;
    assert!((found.abs() / force.abs() - 1.0).abs() < 1e-9, "{found:e} {force:e}");
    let sense = found.signum() * force.signum();
    // Derivative of μF_N φ(U) with respect to p, where μF_N ~ p^a and u_c ~ p^b: (μF_N/p)[aφ - bUφ'].
    let by = |value: f64, a: f64, b: f64| -> f64 {
        sense
            * parts
                .iter()
                .map(|(count, u)| count * mu * normal / value * (a * phi(*u) - b * u * slope(*u)))
                .sum::<f64>()
    };
    let found = &taken.derivatives[0];
    is(&found[0], by(mu, 1.0, 1.0), WITHIN)?;
    is(&found[1], by(normal, 1.0, 2.0 / 3.0), WITHIN)?;
    is(&found[2], by(radius, 0.0, -1.0 / 3.0), WITHIN)
}

/// The quickstart without load, critically damped, slow and with instantaneous flyback: step = S - S₀ with S₀ = 2u_c[1
/// - ((1-λ)/2)^(2/3)]. λ is the damper force relative to μF_N. The slider approaches this law within about 1e-3 u_c.
#[test]
fn the_step_of_the_ideal_drive_and_its_zero_step_have_the_derivatives_of_their_closed_form() -> Checked {
    let (mu, limit, period, stroke) = (0.2, 0.18, 0.3, 100e-9);
    let damping = 2.0 * 10e-3 * std::f64::consts::TAU * 4151.0;
    let brake = format!(r#"{{"between": ["ground", "slider"], "damping": {damping}}}"#);
    let set = [
        ("loads", "[]"),
        ("springs.brake", brake.as_str()),
        ("waveforms.drive.sawtooth.period", "0.3"),
        ("waveforms.drive.sawtooth.flyback", "0"),
        ("waveforms.drive.sawtooth.stroke", "100e-9"),
        ("run.duration", "0.9"),
    ];
    let paths = ["contacts.ball.friction", "waveforms.drive.sawtooth.stroke"];
    let (asked, taken) = taken(&example("quickstart.json"), &set, &of(&["steady.step_m"], &paths))?;
    // Ruby on steel.
    let star = |e: f64, nu: f64| ((1.0 - nu * nu) / e, (2.0 - nu) * 2.0 * (1.0 + nu) / (4.0 * e));
    let ((a, b), (c, d)) = (star(400e9, 0.27), star(210e9, 0.3));
    let (plane, tangential) = (1.0 / (a + c), 1.0 / (b + d));
    let depth = (3.0 * 0.3 / (4.0 * plane * f64::sqrt(0.5e-3))).powf(2.0 / 3.0);
    let natural = mu * plane / tangential * depth;
    let pull = damping * stroke / period / limit;
    let rest = 0.5 * (1.0 - pull);
    let zero = 2.0 * natural * (1.0 - rest.powf(2.0 / 3.0));
    assert!(
        (asked.figures[0].value - (stroke - zero)).abs() < 1e-3 * natural,
        "{:e}",
        asked.figures[0].value
    );
    // dλ/dμ = -λ/μ and dλ/dS = λ/S.
    let by_pull = 2.0 / 3.0 * natural * rest.powf(-1.0 / 3.0);
    let by_friction = known(&taken.derivatives[0][0])?.value;
    let by_stroke = known(&taken.derivatives[0][1])?.value;
    let wanted = [-(zero - by_pull * pull) / mu, 1.0 - by_pull * pull / stroke];
    assert!((by_friction / wanted[0] - 1.0).abs() < 3e-3, "{by_friction:e} {:e}", wanted[0]);
    assert!((by_stroke / wanted[1] - 1.0).abs() < 3e-3, "{by_stroke:e} {:e}", wanted[1]);
    Ok(())
}

/// With a longer period, an event of the last period is after the end of the run. The periodic orbit is not affected:
/// its step length has one slope, equal to that on both sides of the run's last step.
#[test]
fn events_at_the_end_of_a_run_are_none_of_its_steady_motion() -> Checked {
    let asked = of(&["steady.step_m", "steps.last_m"], &["waveforms.drive.sawtooth.period"]);
    let (_, taken) = taken(&example("quickstart.json"), &[], &asked)?;
    let slope = known(&taken.derivatives[0][0])?;
    let Derivative::Split { below: Ok(below), above: Ok(above), why: Split::Events(_) } =
        &taken.derivatives[1][0]
    else {
        return Err(format!("{:?}", taken.derivatives[1][0]).into());
    };
    for side in [below, above] {
        assert!((side.value - slope.value).abs() < side.error + slope.error, "{side:?}, {slope:?}");
    }
    Ok(())
}

/// The step length does not depend on the choice of units (dimensional analysis). The sum of elasticities, each times
/// the power of a base unit in its parameter, is 0 for mass, 1 for length and 0 for time.
#[test]
fn elasticities_of_a_step_sum_up_as_their_units_do() -> Checked {
    let (asked, taken) = taken(&example("p1.json"), &[], &of(&["steps.last_m"], &[]))?;
    let powers = |unit: &str| match unit {
        "kg" => [1.0, 0.0, 0.0],
        "m" => [0.0, 1.0, 0.0],
        "s" => [0.0, 0.0, 1.0],
        "N" => [1.0, 1.0, -2.0],
        "Pa" => [1.0, -1.0, -2.0],
        _ => [0.0; 3],
    };
    let (mut sums, mut errors) = ([0.0; 3], [0.0; 3]);
    for (q, quantity) in asked.quantities.iter().enumerate() {
        let slope = known(&taken.derivatives[0][q])?;
        let share = |value: f64| Taken::elasticity(&asked, (0, q), value).ok_or("an elasticity");
        for (place, power) in powers(quantity.unit).into_iter().enumerate() {
            sums[place] += power * share(slope.value)?;
            errors[place] += (power * share(slope.error)?).abs();
        }
    }
    for ((sum, wanted), error) in sums.into_iter().zip([0.0, 1.0, 0.0]).zip(errors) {
        assert!((sum - wanted).abs() <= error && error < WITHIN, "{sums:?} {errors:?}");
    }
    Ok(())
}

/// A fast ball slips during the whole impact: ψ₂ = ψ₁ - 4χ, so that ∂ψ₂/∂ψ₁ = 1.
#[test]
fn an_oblique_impact_in_full_slip_gives_back_what_it_got() -> Checked {
    let set = [("bodies.ball.start.vx", "60 mm/s")];
    let asked = of(
        &["ball.vx_m_s", "ball.vpitch_rad_s", "ball.vz_m_s"],
        &["bodies.ball.start.vx", "contacts.foot.friction"],
    );
    let (asked, taken) = taken(&example("oblique_impact.json"), &set, &asked)?;
    is(&taken.derivatives[0][0], 1.0, WITHIN)?;
    for f in [1, 2] {
        let slope = known(&taken.derivatives[f][0])?;
        // Slopes are relative to the ratio of result and velocity.
        let large = (asked.figures[f].value / asked.quantities[0].value).abs();
        assert!(
            slope.value.abs() <= slope.error && slope.error < WITHIN * large.max(1.0),
            "{slope:?} {large}"
        );
    }
    // m Δv_x = ∓ μ m Δv_z, and v_z is reversed without loss: dv_x/dμ = -2·50 mm/s.
    assert!((asked.figures[2].value - 0.05).abs() < 1e-8);
    is(&taken.derivatives[0][1], -0.1, WITHIN)
}

/// The two sides differ if one more period fits into the run, or if a parameter has its largest allowed value.
#[test]
fn where_the_sides_differ_both_are_told() -> Checked {
    // 100 ms contain ten periods of 10 ms, but nine of any longer period: the mean of ten steps becomes that of nine,
    // and the first step is longer.
    let asked = of(&["steps.mean_speed_m_s"], &["waveforms.drive.sawtooth.period"]);
    let (asked, found) = taken(&example("quickstart.json"), &[], &asked)?;
    let Derivative::Split { above, below, why: Split::Jump([by_below, by_above]) } = &found.derivatives[0][0]
    else {
        return Err(format!("{:?}", found.derivatives[0][0]).into());
    };
    assert!(below.is_ok() && above.is_ok(), "{below:?} {above:?}");
    // The last step alone, from a run of the example.
    let ten = asked.figures[0].value * 100e-3;
    let (last, _) = taken(&example("quickstart.json"), &[], &of(&["steps.last_m"], &["bodies.slider.mass"]))?;
    let wanted = (ten - last.figures[0].value) / 90e-3 - ten / 100e-3;
    assert!(
        *by_below == 0.0 && (by_above / wanted - 1.0).abs() < 1e-6,
        "{by_below:e} {by_above:e} {wanted:e}"
    );
    // Poisson's ratio cannot be larger.
    let asked = of(&["steps.last_m"], &["materials.hardened steel.poisson_ratio"]);
    let (_, found) =
        taken(&example("quickstart.json"), &[("materials.hardened steel.poisson_ratio", "0.5")], &asked)?;
    let Derivative::Split { below: Ok(_), above: Err(Missing::Refused(why)), why: Split::OneSided } =
        &found.derivatives[0][0]
    else {
        return Err(format!("{:?}", found.derivatives[0][0]).into());
    };
    assert!(why.contains("poisson_ratio"), "{why}");
    Ok(())
}

/// u just reaches u_c: with slightly less friction the contact slips as a whole, with slightly more it does not.
#[test]
fn an_event_at_the_very_edge_is_told_from_both_sides() -> Checked {
    let (mu, normal, radius) = (0.15, 1.0, 1e-3);
    let (shear, plane) = (MODULUS / (2.0 * (1.0 + POISSON)), MODULUS / (2.0 * (1.0 - POISSON * POISSON)));
    let tangential = shear * 4.0 / (2.0 * (2.0 - POISSON));
    let depth = (3.0 * normal / (4.0 * plane * f64::sqrt(radius))).powf(2.0 / 3.0);
    let natural = mu * plane / tangential * depth;
    let (_folder, file) = scene(&format!(
        r#"{{ "stickslip": 1,
            "materials": {{ "steel": {{ "youngs_modulus": {MODULUS}, "poisson_ratio": {POISSON} }} }},
            "waveforms": {{ "way": {{ "table": {{ "points": [[0, 0], [1, {natural:e}], [2, 0]] }} }} }},
            "bodies": {{ "foot": {{ "x": {{ "follows": "way" }} }} }},
            "contacts": {{ "ball": {{ "between": ["ground", "foot"], "materials": ["steel", "steel"],
                "profile": {{ "paraboloid": {{ "radius": {radius} }} }}, "friction": {mu}, "normal": {{ "force": {normal} }} }} }},
            "run": {{ "duration": 1.5 }}, "output": {{ "every": 0.1 }} }}"#
    ))?;
    let (_, found) = taken(
        &file,
        &[],
        &of(&["ball.fx_N"], &["waveforms.way.table.points[1][1]", "contacts.ball.friction"]),
    )?;
    let Derivative::Split { why: Split::Events(changes), .. } = &found.derivatives[0][1] else {
        return Err(format!("{:?}", found.derivatives[0][1]).into());
    };
    assert!(changes.iter().any(|change| change.contains("ball")), "{changes:?}");
    Ok(())
}

/// Positions of contacts have derivatives, and so have parameters of parts that do not affect the result.
#[test]
fn levers_and_what_rests_have_slopes() -> Checked {
    let levers = of(&["stage.x_m"], &["contacts.front.at.stage.x", "contacts.rear.at.stage.z"]);
    let (_, stage) = taken(&example("three_ball_stage.json"), &[("run.cycles", "1")], &levers)?;
    let moved = of(&["slider.x_m"], &["bodies.slider.mass", "contacts.still.friction"]);
    let (_, beside) = taken(&example("vibrated_slider.json"), &[("run.cycles", "2")], &moved)?;
    for found in [stage, beside].iter().flat_map(|taken| taken.derivatives.iter().flatten()) {
        known(found)?;
    }
    Ok(())
}

#[test]
fn any_number_of_cores_tells_the_same() -> Checked {
    let paths = ["contacts.ball.friction", "bodies.slider.mass", "gravity.incline"];
    let asked = ask(
        &example("quickstart.json"),
        &[("gravity", "{}")],
        &of(&["steps.last_m", "energy.friction_J"], &paths),
    )?;
    let told = [1, 2, 3].map(|cores| {
        let taken = asked.take(cores, &());
        (csv(&asked, &taken), json(&asked, &taken))
    });
    assert_eq!(told[0], told[1]);
    assert_eq!(told[0], told[2]);
    // A parameter that is 0 has an estimated scale, a derivative and no elasticity.
    let row = told[0].0.lines().find(|row| row.contains("gravity.incline")).ok_or("a row")?;
    let cells: Vec<&str> = row.split(',').collect();
    assert!(
        cells[5] == "0e0" && cells[7].parse::<f64>().is_ok_and(|slope| slope < 0.0) && cells[10].is_empty(),
        "{row}"
    );
    Ok(())
}

#[test]
fn quantities_and_figures_by_default_are_what_there_is() -> Checked {
    let asked = ask(&example("p1.json"), &[], &Asked::default())?;
    let paths: Vec<&str> = asked.quantities.iter().map(|quantity| quantity.path.as_str()).collect();
    let wanted = [
        "materials.hardened steel.youngs_modulus",
        "materials.hardened steel.poisson_ratio",
        "waveforms.drive.sawtooth.stroke",
        "waveforms.drive.sawtooth.flyback",
        "waveforms.drive.sawtooth.period",
        "bodies.slider.mass",
        "contacts.ball.profile.paraboloid.radius",
        "contacts.ball.friction",
        "contacts.ball.normal.force",
    ];
    assert!(wanted.iter().all(|path| paths.contains(path)) && paths.len() == wanted.len(), "{paths:?}");
    let names: Vec<&str> = asked.figures.iter().map(|figure| figure.name.as_str()).collect();
    assert!(names.starts_with(&["steps.last_m", "steps.mean_speed_m_s", "energy.friction_J"]), "{names:?}");
    assert_eq!((asked.figures[0].unit, asked.unit((0, 0))), ("m", "m/Pa".to_owned()));
    Ok(())
}

#[test]
fn what_cannot_be_answered_is_refused_with_its_reason() -> Checked {
    let refused = |name: &str, set: &[(&str, &str)], asked: Asked, words: &str| -> Checked {
        let Err(error) = ask(&example(name), set, &asked) else { return Err(words.into()) };
        let told = error.to_string();
        assert!(told.contains(words), "{told}");
        Ok(())
    };
    let step = &["steps.last_m"];
    let friction = &["contacts.ball.friction"];
    refused("p1.json", &[], of(&["steps.lst_m"], friction), "did you mean \"steps.last_m\"?")?;
    refused("p1.json", &[], of(&["contacts.ball.fretting.dissipated_J"], friction), "have no such result")?;
    refused("p1.json", &[], of(&["drivers.stack.peak_current_A"], friction), "have no such result")?;
    refused("p1.json", &[], of(&["steps.periods"], friction), "is a count")?;
    refused("p1.json", &[], of(&["counts.steps"], friction), "describes the execution of the run")?;
    refused("p1.json", &[], of(&["timing.wall_s"], friction), "describes the execution of the run")?;
    refused("p1.json", &[], of(step, &["contacts.bal.friction"]), "did you mean \"ball\"?")?;
    refused("p1.json", &[], of(step, &["contacts.ball.count"]), "is a count")?;
    refused("p1.json", &[], of(step, &["run.cycles"]), "has no effect on the motion")?;
    refused("p1.json", &[], of(step, &["contacts.ball.between[0]"]), "got a text")?;
    refused("p1.json", &[], of(step, &["contacts.ball.damping"]), "has no value in the file")?;
    refused("p1.json", &[], of(step, &["bodies.slider.mass", "bodies.slider.mass"]), "named twice")?;
    refused("p1.json", &[], of(&["steps.last_m", "steps.last_m"], friction), "named twice")?;
    refused("p1.json", &[("contacts.ball.friction", "-1")], of(step, friction), "expected a number between")?;
    refused("p1.json", &[], Asked { tolerance: 1e-3, ..of(step, friction) }, "expected a tolerance")?;
    refused(
        "p1.json",
        &[("run.limits.steps", "100")],
        of(step, friction),
        "the run of the scenario stopped early",
    )?;
    refused("bouncing_ball.json", &[], of(&["steady.step_m"], &[]), "there is no periodic orbit")?;
    Ok(())
}

#[test]
fn materials_that_nothing_names_are_no_quantities_by_themselves() -> Checked {
    let glass = r#"{"youngs_modulus": "70 GPa", "poisson_ratio": 0.2}"#;
    let set = [("materials.glass", glass)];
    let asked = ask(&example("ruby_drive.json"), &set, &of(&["steps.last_m"], &[]))?;
    let paths: Vec<&str> = asked.quantities.iter().map(|quantity| quantity.path.as_str()).collect();
    assert!(
        paths.contains(&"materials.ruby.youngs_modulus")
            && paths.contains(&"materials.hardened steel.poisson_ratio")
    );
    assert!(!paths.iter().any(|path| path.starts_with("materials.glass")), "{paths:?}");
    // Parameters named explicitly are used.
    let named = of(&["steps.last_m"], &["materials.glass.poisson_ratio"]);
    assert_eq!(ask(&example("ruby_drive.json"), &set, &named)?.quantities.len(), 1);
    Ok(())
}

/// Errors of slopes at loose tolerances must cover the deviation from the tightest tolerance: for a slope from periodic
/// orbits and one from runs.
#[test]
fn slopes_by_loose_tolerances_tell_what_these_miss() -> Checked {
    let cases = [
        ("p1.json", "steady.step_m", "waveforms.drive.sawtooth.period"),
        ("quickstart.json", "steps.last_period.contacts.ball.ringing_left", "bodies.slider.mass"),
    ];
    for (file, figure, quantity) in cases {
        let slope = |tolerance: f64| -> Result<Slope, Box<dyn Error>> {
            let asked = Asked { tolerance, ..of(&[figure], &[quantity]) };
            Ok(known(&taken(&example(file), &[], &asked)?.1.derivatives[0][0])?)
        };
        let finest = slope(1e-13)?;
        for tolerance in [1e-6, 1e-7, 1e-9, 1e-10] {
            let found = slope(tolerance)?;
            let off = (found.value - finest.value).abs();
            assert!(off <= found.error + finest.error, "{file} {tolerance:e}: {off:e} in {:e}", found.error);
            // The error must not be too large, either.
            assert!(found.error <= 1e-3 * found.value.abs(), "{file} {tolerance:e}: {found:?}");
        }
    }
    Ok(())
}
