//! Static and kinetic friction: the textbook's mass on a belt against the rigid closed form, and random drives against rows of
//! springs by velocity Verlet.

use crate::lottery::{Drawn, deal, on_rows};
use crate::parts::{channel, contact, event, follower, free, named, of_pair, plan, trace};
use stickslip_contact::{Growth, Interface, Material, Pair, Profile};
use stickslip_drive::scene::{Body, Contact, Direction, Freedom, Named, Point, Scene, Side, Spring};
use stickslip_drive::{EventKind, Part, Plan, Shape, Stepper, Timing, Waveform};

fn with_kinetic(contact: &Contact, share: f64) -> Contact {
    let kinetic = share * contact.interface.friction();
    Contact {
        interface: contact.interface.clone().with_kinetic_friction(kinetic).unwrap(),
        ..contact.clone()
    }
}

/// Returns a contact whose static coefficient grows at rest from `from`. The kinetic coefficient stays.
fn with_growth(contact: &Contact, from: f64, growth: Growth) -> Contact {
    let old = &contact.interface;
    let interface =
        Interface::new(old.pair(), old.profile().clone(), from).unwrap().with_damping(old.damping());
    let interface =
        interface.with_growth(growth).unwrap().with_kinetic_friction(old.kinetic_friction()).unwrap();
    Contact { interface, ..contact.clone() }
}

/// A mass of 1 kg on a spring of 1 N/m and on a belt of 0.1 m/s, with the limits 1 and 0.6 N. It starts with the belt.
/// The gross slip displacement is `u_c` (m).
fn belt(u_c: f64) -> Scene {
    let (friction, normal, radius) = (0.5_f64, 2.0_f64, 0.01_f64);
    // u_c = μ(E*/G*)d, E*/G* = (2-ν)/(2(1-ν)), F_N = (4/3)E*√R d^{3/2}, E* = E/(2(1-ν²)).
    let nu = 0.3;
    let depth = u_c / (friction * (2.0 - nu) / (2.0 * (1.0 - nu)));
    let effective = 0.75 * normal / (radius.sqrt() * depth.powf(1.5));
    let material = Material::new(2.0 * (1.0 - nu * nu) * effective, nu).unwrap();
    let moving =
        Waveform::new(Shape::Table { points: vec![(0.0, 0.0), (100.0, 10.0)] }, Timing::every(100.0))
            .unwrap();
    let pad = contact([Side::Body(0), Side::Body(1)], Profile::paraboloid(radius).unwrap(), friction, normal);
    let pad = with_kinetic(&of_pair(Pair::new(material, material), &pad), 0.6);
    let spring = Spring {
        between: [Side::Ground, Side::Body(1)],
        at: [Point::default(); 2],
        direction: Direction::X,
        stiffness: 1.0,
        damping: 0.0,
        preload: 0.0,
    };
    let mut block: Named<Body> = named("block", free(1.0));
    block.part.x.velocity = 0.1;
    Scene {
        waveforms: vec![named("belt", moving)],
        bodies: vec![named("belt", follower(0)), block],
        contacts: vec![named("pad", pad)],
        springs: vec![named("spring", spring)],
        ..Scene::default()
    }
}

/// Times of slip and stick in the third cycle, s, and the largest displacement from then on, m.
fn third_cycle(scene: &Scene, plan: &Plan) -> [f64; 3] {
    let (model, _, rows) = trace(scene, plan, 0.01);
    let of = |wanted: EventKind| -> Vec<f64> {
        rows.events().filter(|(event, _)| event.kind == wanted).map(|(event, _)| event.t).collect()
    };
    let (breaks, sticks) = (of(EventKind::BreaksLoose), of(EventKind::SticksAgain));
    let (t, x) = (channel(&model, "time_s"), channel(&model, "block.x_m"));
    let later = rows.rows().filter(|row| row[t] > sticks[1]).map(|row| row[x].abs());
    [sticks[2] - breaks[2], breaks[3] - sticks[2], later.fold(0.0, f64::max)]
}

/// Rigid contact: slip (2/ω)[π - atan((F_s-F_k)ω/(kv))], stick 2(F_s-F_k)/(kv), x_max = F_k/k + √(((F_s-F_k)/k)² + (v/ω)²).
/// A compliant contact deviates by u_c^{2/5}; its values are those of rows of 8000 springs with a step of their own.
#[test]
fn a_mass_on_a_belt_sticks_and_slips() {
    let rigid = [3.631_549_979_8, 8.0, 1.012_310_562_6];
    for (u_c, known) in [(1e-4, [3.6304, 8.0178, 1.01314]), (1e-6, [3.63135, 8.0034, 1.01247])] {
        let found = third_cycle(&belt(u_c), &event(1e-8, 60.0));
        println!("{u_c:e}: {found:?}");
        for ((found, known), rigid) in found.iter().zip(known).zip(rigid) {
            assert!((found - known).abs() < 1e-4, "{found} {known}");
            assert!((found - rigid).abs() < f64::powf(u_c, 0.4), "{found} {rigid}");
        }
    }
}

/// Rigid contact: in the steady cycle it breaks at F_s(T) after the stick time T = 2(F_s(T) - F_k)/(kv), and slips for
/// (2/ω)[π - atan((F_s-F_k)ω/(kv))]. Stairs of the growth and a compliant contact change that by less than 1 %.
#[test]
fn static_friction_grows_at_rest() {
    let normal = 2.0;
    for growth in
        [Growth::Exponential { rise: 0.15, time: 4.0 }, Growth::Logarithmic { rise: 0.05, time: 0.5 }]
    {
        let limit = |t: f64| {
            let more = match growth {
                Growth::Exponential { rise, time } => rise * (1.0 - (-t / time).exp()),
                Growth::Logarithmic { rise, time } => rise * (1.0 + t / time).ln(),
            };
            normal * (0.35 + more)
        };
        let (mut stick, kinetic, speed) = (4.0, 0.6, 0.1);
        for _ in 0..200 {
            stick = 2.0 * (limit(stick) - kinetic) / speed;
        }
        let slip = 2.0 * (std::f64::consts::PI - ((limit(stick) - kinetic) / speed).atan());
        let mut scene = belt(1e-6);
        scene.contacts[0].part = with_growth(&scene.contacts[0].part, 0.35, growth);
        let [found_slip, found_stick, _] = third_cycle(&scene, &event(1e-8, 60.0));
        println!("{growth:?}: slip {found_slip} {slip}, stick {found_stick} {stick}");
        assert!((found_slip - slip).abs() < 4e-3 && (found_stick / stick - 1.0).abs() < 1e-2);
        // The other engine at fixed steps, and the same stairs.
        let rows = on_rows(&scene, 4000);
        let [row_slip, row_stick, _] = third_cycle(&rows, &plan(Stepper::Verlet { step: 2e-4 }, 60.0));
        println!("row {row_slip} {row_stick}");
        assert!((found_slip - row_slip).abs() < 4e-3 && (found_stick - row_stick).abs() < 4e-3);
    }
}

/// After a rest t before the start μ_s = μ + b ln(1 + t/τ), from below by at most a stair of b/1024.
#[test]
fn a_rest_before_the_start_counts() {
    for rest in [0.0, 1.0, 1e3] {
        let (mut scene, time) = (belt(1e-6), 1e4);
        let growth = Growth::Logarithmic { rise: 100.0, time };
        scene.contacts[0].part = with_growth(&scene.contacts[0].part, 0.35, growth);
        scene.contacts[0].part.start = stickslip_drive::scene::ContactStart::Rest(rest);
        let model = stickslip_drive::Model::new(&scene).unwrap();
        let state = model.start(&event(1e-6, 1.0)).unwrap();
        let law = model.contacts().next().unwrap().1;
        let exact = 0.35 + 100.0 * (rest / time).ln_1p();
        let found = state.memories()[0].law(law).friction();
        assert!(found <= exact && exact - found <= 100.0 / 1024.0, "{found} {exact}");
    }
}

/// Positions of the free bodies at a number of times, and the number of breaks.
fn ends(scene: &Scene, plan: &Plan) -> (Vec<f64>, usize) {
    let (model, _, rows) = trace(scene, plan, plan.duration / 16.0);
    let free = scene.bodies.iter().filter(|b| b.part.x.freedom == Freedom::Free);
    let columns: Vec<usize> = free.map(|b| channel(&model, &format!("{}.x_m", b.name))).collect();
    let breaks = rows.events().filter(|(event, _)| event.kind == EventKind::BreaksLoose).count();
    (rows.rows().flat_map(|row| columns.iter().map(|c| row[*c])).collect(), breaks)
}

/// Random drives with random kinetic coefficients: the memory curve with event location, against velocity Verlet on rows of springs.
fn agree(seeds: std::ops::Range<u64>) {
    let mut all = 0;
    for seed in seeds {
        let Drawn { mut scene, period, stroke, title, .. } = deal(seed);
        for (c, contact) in scene.contacts.iter_mut().enumerate() {
            contact.part = with_kinetic(&contact.part, 0.5 + 0.04 * ((seed + 3 * c as u64) % 11) as f64);
            if seed % 2 == 1 {
                let (most, least) =
                    (contact.part.interface.friction(), contact.part.interface.kinetic_friction());
                let growth = Growth::Exponential { rise: 0.5 * (most - least), time: 0.3 * period };
                contact.part = with_growth(&contact.part, 0.5 * (most + least), growth);
            }
        }
        let duration = 3.0 * period;
        let far = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        let (exact, breaks) = ends(&scene, &event(1e-9, duration));
        let scale = exact.iter().map(|x| x.abs()).fold(stroke, f64::max);
        let off = |springs: usize, steps: f64| {
            let rows = on_rows(&scene, springs);
            let (other, _) = ends(&rows, &plan(Stepper::Verlet { step: period / steps }, duration));
            far(&exact, &other) / scale
        };
        // Verlet is of first order here, because it does not locate the jump of the force. A row breaks loose where its lowest spring slips,
        // which is a little above the centre. Where these errors are larger, they must fall with steps and springs.
        let coarse = off(1024, 16e3);
        let fine = if coarse < 1e-3 { coarse } else { off(16_384, 64e3) };
        println!("{title}: {breaks} breaks, off by {coarse:.1e}, {fine:.1e}");
        assert!(fine < 1e-3, "{title}: {coarse:e} {fine:e}");
        all += breaks;
    }
    assert!(all > 20, "{all}");
}

#[test]
fn random_drives_break_loose_as_rows_at_fixed_steps() {
    agree(0..11);
}

#[test]
#[ignore = "takes long: .ci/full"]
fn random_drives_break_loose_as_rows_at_fixed_steps_further_seeds() {
    agree(11..200);
}

/// A quasi-static coordinate would jump at a break.
#[test]
fn a_balanced_coordinate_is_refused() {
    let mut scene = belt(1e-4);
    scene.bodies[1].part.x.freedom = Freedom::Balanced;
    (scene.bodies[1].part.x.velocity, scene.bodies[1].part.mass) = (0.0, None);
    let error = stickslip_drive::Model::new(&scene).unwrap_err();
    assert_eq!(error.part, Part::Contact(0));
    assert!(error.to_string().contains("breaks loose"), "{error}");
}
