//! Judges a sample of random scenarios. The command `stickslip-lab soak` judges more.

use std::collections::BTreeSet;
use stickslip_bench::soak::{Kind, Seeds, Verdict, hostile, scenario, soak};
use stickslip_scenario::Scenario;

/// Number of seeds of the sample.
const SAMPLE: u64 = 160;

/// Seeds of the sample with known faults. Their energy balance errors exceed the limit of a hundred tolerances by a factor of 1 to 3. The
/// contacts grow along paths that are approximated by straight segments.
const KNOWN: [u64; 3] = [90, 120, 149];

#[test]
fn a_sample_of_drawn_scenes_runs_to_its_end_and_is_right() {
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    let findings = soak(&Seeds { seeds: (0..SAMPLE).collect(), rows: 4, threads }, &());
    assert_eq!(findings.len() as u64, SAMPLE);
    let faults: Vec<_> = findings.iter().filter(|finding| finding.verdict.is_fault()).collect();
    let new: Vec<_> = faults.iter().filter(|finding| !KNOWN.contains(&finding.seed)).collect();
    assert!(new.is_empty(), "{new:#?}");
    // A fault that is fixed must be removed from the list.
    let gone: Vec<_> =
        KNOWN.iter().filter(|seed| faults.iter().all(|finding| finding.seed != **seed)).collect();
    assert!(gone.is_empty(), "no fault any more: {gone:?}");
    let right = findings.iter().filter(|finding| finding.verdict <= Verdict::Warned).count();
    let compared = findings.iter().filter(|finding| !finding.row[0].is_nan()).count();
    println!("{right} right or warned, {} faults, {compared} against a row", faults.len());
    assert!(compared > 0);
}

/// Checks that the generator draws all kinds, and that its files are readable and reproducible.
#[test]
fn everything_is_drawn() {
    let mut met = BTreeSet::new();
    for seed in 0..400 {
        let (kind, text) = scenario(seed);
        assert_eq!(scenario(seed), (kind, text.clone()), "seed {seed}");
        let read = Scenario::from_str_alone(&text, "drawn").unwrap();
        met.insert(kind.name().to_owned());
        let bodies = read.scene.bodies.iter().filter(|body| body.part.is_free()).count();
        assert!(bodies <= 4, "seed {seed}");
        let keys = [
            "flat",
            "cone",
            "paraboloid",
            "sphere",
            "power",
            "foundation",
            "springs",
            "count",
            "damping",
            "force",
            "indentation",
            "radius",
            "coupled",
            "sawtooth",
            "triangle",
            "sine",
            "harmonics",
            "cycloid",
            "table",
            "phase",
            "delay",
            "cycles",
            "offset",
            "equilibrium",
            "given",
            "actuators",
            "incline",
            "preload",
            "vx",
            "vz",
            "z",
            "pitch",
            "gap",
            "displacement",
        ];
        met.extend(
            keys.iter().filter(|key| text.contains(&format!("\"{key}\""))).map(|key| (*key).to_owned()),
        );
        met.insert(format!("{bodies} free"));
    }
    let missing: Vec<_> = Kind::ALL.iter().filter(|kind| !met.contains(kind.name())).collect();
    assert!(missing.is_empty(), "{missing:?}");
    assert_eq!(met.len(), Kind::ALL.len() + 34 + 4, "{met:?}");
}

/// Every 41st cell of the matrix in docs/stability.md.
#[test]
fn a_sample_of_hostile_scenes_ends_right_or_in_an_error_that_helps() {
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    let cells: Vec<u64> = (3..hostile::size() as u64).step_by(41).collect();
    let findings = hostile::matrix(cells.clone(), threads, &());
    assert_eq!(findings.len(), cells.len());
    let faults: Vec<_> = findings.iter().filter(|finding| finding.verdict.is_fault()).collect();
    assert!(faults.is_empty(), "{faults:#?}");
    let families: BTreeSet<_> = findings.iter().map(|finding| finding.kind).collect();
    assert_eq!(families.len(), 17);
    assert!(findings.iter().filter(|finding| finding.verdict == Verdict::Right).count() > cells.len() / 2);
}
