//! How energies change with numbers of a scene, against differences of the books of runs and against closed forms.

use crate::lottery::{Draw, deal};
use crate::parts::{channel, event};
use crate::variations_by_parameters::{NUMBERS, built, parameter};
use stickslip_drive::scene::Scene;
use stickslip_drive::{EnergyRates, Model, Parameter, Plan, Run, Trace, VariationError, run};

const NAMES: [&str; 5] = ["input", "kinetic", "elastic", "friction", "damping"];

fn listed(rates: EnergyRates) -> [f64; 5] {
    let EnergyRates { input, kinetic, elastic, friction, damping } = rates;
    [input, kinetic, elastic, friction, damping]
}

/// Derivatives of the energies at a time by numbers, as shares of their values; none where they are not told.
fn varied(
    (model, plan): (&Model, &Plan),
    parameters: &[Parameter],
    until: f64,
) -> Result<Vec<Option<[f64; 5]>>, VariationError> {
    let start = model.start(plan).unwrap();
    let mut variation = model.variation((plan, &start), parameters)?.with_energies();
    let mut run = Run::new(model, plan, start).unwrap();
    run.advance(until, &mut variation).unwrap();
    let rates: Vec<_> =
        (0..parameters.len()).map(|j| variation.energies(run.state(), j).map(listed)).collect();
    run.stop(&mut ());
    variation.finish(run.state())?;
    Ok(rates)
}

/// The energies of a run at its end.
fn books(scene: &Scene, until: f64) -> [f64; 5] {
    let model = built(scene);
    let plan = Plan { every: Some(until), ..event(1e-13, until) };
    let mut state = model.start(&plan).unwrap();
    let mut trace = Trace::new(&model);
    run(&model, &plan, &mut state, &mut trace).unwrap();
    let all = NAMES.map(|name| channel(&model, &format!("energy.{name}_J")));
    all.map(|place| trace.column(place).last().unwrap())
}

/// Differences of the books over h and h/2 on both sides, extrapolated, and by how much the shorter ones were mended.
fn differences(of: &dyn Fn(f64) -> Scene, until: f64, h: f64) -> [[f64; 5]; 2] {
    let central = |h: f64| {
        let [above, below] = [h, -h].map(|by| books(&of(1.0 + by), until));
        std::array::from_fn(|i| (above[i] - below[i]) / (2.0 * h))
    };
    let [coarse, fine]: [[f64; 5]; 2] = [central(h), central(0.5 * h)];
    let mended: [f64; 5] = std::array::from_fn(|i| (fine[i] - coarse[i]) / 3.0);
    [std::array::from_fn(|i| fine[i] + mended[i]), mended]
}

/// The largest of some numbers, in units of a natural energy or of the largest slope: what friction takes is what the others leave.
fn size(of: [f64; 5], slopes: [f64; 5], natural: f64) -> f64 {
    let largest = |of: [f64; 5]| of.into_iter().map(f64::abs).fold(0.0, f64::max);
    largest(of) / natural.max(largest(slopes))
}

/// How far energies by the variation are off from differences of the books, and these from themselves, in units of the largest slope or
/// of μF_N u_c; none where they are not told.
pub(crate) fn apart(of: &dyn Fn(f64) -> Scene, until: f64) -> Option<(f64, f64)> {
    let (model, tight) = (built(&of(1.0)), event(1e-13, f64::MAX));
    let scale = model.contact_natural(0).unwrap();
    let natural = scale.force * scale.displacement;
    let led = parameter(of, &model).and_then(|number| varied((&model, &tight), &[number], until));
    let rates = led.ok().and_then(|rates| rates[0])?;
    let known = [1e-3, 2e-4, 4e-5].map(|h| differences(of, until, h));
    let known = known.map(|[slopes, mended]| (size(mended, slopes, natural), slopes));
    let (doubt, slopes) = known.into_iter().min_by(|a, b| a.0.total_cmp(&b.0)).unwrap();
    let off = size(std::array::from_fn(|i| rates[i] - slopes[i]), slopes, natural);
    if doubt < 1e-8 && off > 1e-7 {
        println!("    {rates:?}\n    {slopes:?}");
    }
    Some((off, doubt))
}

/// Thirty random drives by every number that they have: energies vary as differences of the books say, to 1e-7 of the largest slope or of
/// μF_N u_c where those are good to 1e-8. The books tell friction by what was swept, and nothing of a balance.
#[test]
#[ignore = "takes long: .ci/full"]
fn energies_of_random_drives_vary_as_their_books_say() {
    let (mut told, mut sharp, mut worst) = (0, 0, 0.0_f64);
    for seed in 0..30 {
        let drawn = deal(seed);
        let mut draw = Draw::new(3_000 + seed);
        let until = draw.between(0.5, 2.5) * drawn.period;
        for (name, change) in NUMBERS {
            if !change(&mut drawn.scene.clone(), 1.0) {
                continue;
            }
            let of = |by: f64| {
                let mut scene = drawn.scene.clone();
                change(&mut scene, by);
                scene
            };
            let Some((off, doubt)) = apart(&of, until) else { continue };
            told += 1;
            println!("{}: {name}: off by {off:.1e}, differences by {doubt:.1e}", drawn.title);
            if doubt < 1e-8 {
                sharp += 1;
                worst = worst.max(off);
            }
        }
    }
    println!("{sharp} of {told}, {worst:e}");
    assert!(sharp > 80 && worst < 1e-7, "{sharp} of {told}: {worst:e}");
}
