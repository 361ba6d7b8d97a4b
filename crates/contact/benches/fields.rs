//! Benchmarks of stress fields: 200 radii of a contact with three slip fronts in its memory.

use criterion::{Criterion, criterion_group, criterion_main};
use std::hint::black_box;
use stickslip_contact::{Apex, Engine, Fields, FrictionMap, Interface, Memory, Pair, Profile, Segment};

/// Contact after displacements of 0.7, -0.1 and 0.3 of the gross slip displacement.
fn contact(profile: Option<Profile>) -> Option<(Interface, Memory, Apex)> {
    let pair = Pair::from_moduli(2e11, 1.6e11).ok()?;
    let law = Interface::new(pair, profile?, 0.3).ok()?;
    let d = law.indentation(1.0);
    let u_c = law.gross_slip_displacement(d);
    let mut memory = Engine::Curve.memory(&law, Apex { d, u: 0.0 });
    for u in [0.7 * u_c, -0.1 * u_c, 0.3 * u_c] {
        memory.commit(&law, Segment::Straight(Apex { d, u })).ok()?;
    }
    Some((law, memory, Apex { d, u: -0.5 * u_c }))
}

fn fields(criterion: &mut Criterion) {
    let profiles = [
        ("cone", Profile::cone(0.01)),
        ("paraboloid", Profile::paraboloid(1e-3)),
        ("power 4", Profile::power(1e6, 4.0)),
        ("power 2.5", Profile::power(1e6, 2.5)),
        ("sphere", Profile::sphere(1e-3)),
    ];
    for (name, profile) in profiles {
        let Some((law, memory, to)) = contact(profile.ok()) else { continue };
        let a = law.profile().radius(memory.apex().d);
        let radii: Vec<f64> = (0..200).map(|k| 1.5 * a * f64::from(k) / 199.0).collect();
        criterion.bench_function(&format!("fields of 200 radii, {name}"), |bencher| {
            bencher.iter(|| {
                let fields = Fields::of(&law, black_box(&memory))?;
                Some(radii.iter().map(|&r| fields.at(r).shear).sum::<f64>())
            });
        });
        criterion.bench_function(&format!("friction of 200 radii, {name}"), |bencher| {
            let mut map = FrictionMap::new(radii.clone());
            bencher.iter(|| map.follow(&law, &memory, Segment::Straight(black_box(to))));
        });
    }
}

criterion_group!(benches, fields);
criterion_main!(benches);
