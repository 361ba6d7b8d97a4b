//! Tests of the reduction of a full memory: constant cost per move, and recorded errors.

use stickslip_contact::{Apex, Curve, Engine, Interface, Memory, Move, Pair, Profile, Segment, Words};

const G: f64 = 0.95e11;
/// Radius of the paraboloid, m.
const RADIUS: f64 = 1e-3;
/// Largest indentation, m.
pub(super) const DEPTH: f64 = 1e-6;

pub(super) fn paraboloid() -> Interface {
    let profile = Profile::paraboloid(RADIUS).unwrap();
    Interface::new(Pair::from_moduli(1.15e11, G).unwrap(), profile, 0.3).unwrap()
}

/// Growth along u = βd₁(x + εx²/2), x = d/d₁.
///
/// With ν = d₁^{3/2} and m = 2√(Rd), F_x = G\*∫u'm dd = 2G\*β√R ν (2x^{3/2}/3 + 2εx^{5/2}/5). The energy is E = ∫F_x u' dd.
pub(super) struct Path {
    pub(super) beta: f64,
    pub(super) bend: f64,
}

impl Path {
    pub(super) fn u(&self, x: f64) -> f64 {
        self.beta * DEPTH * (x + 0.5 * self.bend * x * x)
    }

    fn force(&self, x: f64) -> f64 {
        let unit = 2.0 * G * self.beta * RADIUS.sqrt() * DEPTH.powf(1.5);
        unit * (2.0 / 3.0 * x.powf(1.5) + 0.4 * self.bend * x.powf(2.5))
    }

    /// Energy ∫F_x u̇ dt = unit·βd₁ ∫(2x^{3/2}/3 + 2εx^{5/2}/5)(1 + εx) dx.
    fn energy(&self, x: f64) -> f64 {
        let unit = 2.0 * G * self.beta * RADIUS.sqrt() * DEPTH.powf(1.5) * self.beta * DEPTH;
        let e = self.bend;
        unit * (4.0 / 15.0 * x.powf(2.5)
            + e * (2.0 / 3.0 + 0.4) * x.powf(3.5) / 3.5
            + 0.4 * e * e * x.powf(4.5) / 4.5)
    }

    fn segment(&self, x: f64) -> Segment {
        let to = Apex { d: DEPTH * x, u: self.u(x) };
        Segment::Grown { to, force: self.force(x), energy: self.energy(x), joins: x > 0.0 }
    }
}

/// Curve that has grown in equal pieces, and the number of reductions during the growth.
pub(super) fn grown(law: &Interface, path: &Path, pieces: u32, capacity: usize) -> (Curve, u32) {
    let mut curve = Curve::with_capacity(law, Apex::default(), capacity);
    let mut looks = 0;
    for k in 1..=pieces {
        let before = curve.merged().knots;
        curve.commit(law, path.segment(f64::from(k) / f64::from(pieces))).unwrap();
        looks += u32::from(curve.merged().knots > before);
        assert!(curve.knot_count() <= capacity);
    }
    (curve, looks)
}

/// The number of reductions is small compared with the number of moves.
#[test]
fn a_full_memory_is_looked_through_once_in_many_moves() {
    let law = paraboloid();
    let path = Path { beta: 0.4 * law.stick_slope(), bend: 0.8 };
    for capacity in [256, 1024, 16_384] {
        let moves = 4 * u32::try_from(capacity).unwrap();
        // One knot per move; a reduction removes a sixteenth of the stack, or half of that if neighbours must stay.
        let most = 32 * moves / u32::try_from(capacity).unwrap();
        let (_, looks) = grown(&law, &path, moves, capacity);
        println!("growth, {capacity} knots: {looks} looks in {moves} moves");
        assert!(looks > 0 && looks <= most, "growth, {capacity} knots: {looks} looks in {moves} moves");

        let mut curve = Curve::with_capacity(&law, Apex { d: DEPTH, u: 0.0 }, capacity);
        let u_c = law.gross_slip_displacement(DEPTH);
        let mut looks = 0;
        for k in 0..moves {
            let swing = 0.9 * u_c * (1.0 - f64::from(k) / f64::from(moves));
            let u = if k % 2 == 0 { swing } else { -swing };
            let before = curve.merged().knots;
            curve.commit(&law, Segment::Straight(Apex { d: DEPTH, u })).unwrap();
            looks += u32::from(curve.merged().knots > before);
        }
        println!("decay, {capacity} knots: {looks} looks in {moves} moves");
        assert!(looks > 0 && looks <= most, "decay, {capacity} knots: {looks} looks in {moves} moves");
    }
}

/// Force and energy at the apex remain those that were integrated. For any later slip front the error is below the recorded one.
#[test]
fn what_a_full_memory_forgets_of_growth_is_booked() {
    let law = paraboloid();
    let (u_c, limit) = (law.gross_slip_displacement(DEPTH), law.friction() * law.normal_force(DEPTH));
    for bend in [1e-6, 1e-3, 0.8, -0.8] {
        let path = Path { beta: 0.4 * law.stick_slope(), bend };
        let (small, _) = grown(&law, &path, 20_000, 512);
        let (large, _) = grown(&law, &path, 20_000, 30_000);
        assert!(large.merged().knots == 0 && small.merged().knots > 19_000);
        let close = |a: f64, b: f64| (a - b).abs() <= 1e-14 * b.abs();
        assert!(close(small.force(&law), path.force(1.0)) && close(small.elastic(&law), path.energy(1.0)));

        let booked = small.merged();
        let mut worst = [0.0_f64; 3];
        let slack = 1e-12 * limit;
        for k in 1..1000 {
            let x = f64::from(k) / 1000.0;
            // Back along its own path, and by either limit line at this indentation.
            let back = Apex { d: DEPTH * x, u: path.u(x) };
            let off = (small.preview(&law, back).force - path.force(x)).abs();
            assert!(off <= booked.force + slack, "{bend:e}, {x}: {off:e} of {booked:?}");
            worst[0] = worst[0].max(off);
            for sense in [1.0, -1.0] {
                let to = Apex { d: DEPTH, u: path.u(1.0) + sense * 1.5 * u_c * x };
                let off = |at: Apex| {
                    let (small, large) = (small.preview(&law, at), large.preview(&law, at));
                    [(small.force - large.force).abs(), (small.elastic - large.elastic).abs()]
                };
                let [force, energy] = off(to);
                assert!(force <= booked.force + slack, "{bend:e}, {x}, {sense}: {force:e} of {booked:?}");
                assert!(energy <= (booked.force + slack) * 2.0 * u_c, "{bend:e}, {x}: {energy:e}");
                worst = [worst[0], worst[1].max(force), worst[2].max(energy)];
            }
        }
        let [path, edges, energy] = [worst[0] / limit, worst[1] / limit, worst[2] / (limit * u_c)];
        println!(
            "{bend:e}: {path:.1e}, {edges:.1e}, energy {energy:.1e} off, booked {:.1e}",
            booked.force / limit
        );
        assert!(booked.force <= 1e-6 * bend.abs() * limit + 1e-13 * limit, "{bend:e}: {booked:?}");
    }
}

/// Corners between growth paths with the smallest effect are removed, and the integrals above change accordingly.
#[test]
fn a_full_memory_of_zigzags_is_off_by_less_than_is_booked() {
    let law = paraboloid();
    let (u_c, limit) = (law.gross_slip_displacement(DEPTH), law.friction() * law.normal_force(DEPTH));
    let mut small = Curve::with_capacity(&law, Apex::default(), 128);
    let mut large = Curve::with_capacity(&law, Apex::default(), 30_000);
    let mut u = 0.0;
    for k in 0..10_000_u32 {
        let slope = 0.3 * f64::from(k * 7 % 11) / 5.0 - 0.3;
        u += slope * law.stick_slope() * 1e-4 * DEPTH;
        for curve in [&mut small, &mut large] {
            curve.commit(&law, Segment::Straight(Apex { d: DEPTH * f64::from(k + 1) * 1e-4, u })).unwrap();
        }
        let (force, elastic) =
            (small.force(&law) - large.force(&law), small.elastic(&law) - large.elastic(&law));
        let booked = small.merged();
        assert!(force.abs() <= booked.force + 1e-12 * limit, "move {k}: {force:e} of {booked:?}");
        assert!(elastic.abs() <= (booked.force + 1e-12 * limit) * u_c, "move {k}: {elastic:e} of {booked:?}");
        assert!(small.knot_count() <= 128);
    }
    let booked = small.merged();
    for k in 0..2000 {
        let to = Apex { d: DEPTH, u: u + u_c * (f64::from(k) / 1000.0 - 1.0) };
        let probe = |curve: &Curve| curve.trial(&law, Move::Chord(to)).force;
        let off = (probe(&small) - probe(&large)).abs();
        assert!(off <= booked.force + 1e-12 * limit, "{k}: {off:e} of {booked:?}");
    }
    println!("booked {:.1e} of the limit for {} knots", booked.force / limit, booked.knots);
    assert!(large.merged().knots == 0 && booked.knots > 5_000 && booked.force < 0.02 * limit, "{booked:?}");
}

/// Serialization of a full memory, in the middle of filling the stack and during the following reductions.
#[test]
fn a_full_memory_read_from_its_words_goes_on_to_the_same_bits() {
    let law = paraboloid();
    let path = Path { beta: 0.4 * law.stick_slope(), bend: 0.8 };
    let written = |memory: &Memory| {
        let mut words = Vec::new();
        memory.write(&mut words);
        words
    };
    for pieces in [300, 1000, 1017] {
        let (curve, _) = grown(&law, &path, pieces, 256);
        assert!(curve.merged().knots > 0);
        let mut memory = Memory::Curve(curve);
        let words = written(&memory);
        let mut read = Memory::read(&law, &Engine::Curve, &mut Words::new(&words)).unwrap();
        assert!(read == memory && written(&read) == words);
        for k in 1..=300 {
            let to = Apex {
                d: DEPTH * (1.0 + 0.001 * f64::from(k)),
                u: path.u(1.0) + 1e-11 * f64::from(k * k % 17),
            };
            for memory in [&mut memory, &mut read] {
                memory.commit(&law, Segment::Straight(to)).unwrap();
            }
        }
        assert_eq!(written(&read), written(&memory));
    }
}

/// A million steps of smooth oblique loading, as straight paths and as growth segments. The force agrees with the closed form, and
/// merge errors are recorded.
#[test]
fn a_million_steps_of_oblique_loading_stay_within_the_capacity() {
    let law = paraboloid();
    let path = Path { beta: 0.1, bend: 0.6 };
    let limit = law.friction() * law.normal_force(DEPTH);
    let (grown, _) = grown(&law, &path, 1_000_000, Curve::DEFAULT_CAPACITY);
    assert!((grown.force(&law) - path.force(1.0)).abs() < 1e-12 * limit);
    let mut chords = Curve::new(&law, Apex::default());
    for k in 1..=1_000_000 {
        let x = f64::from(k) * 1e-6;
        let to = Apex { d: DEPTH * x, u: path.u(x) };
        assert_eq!(chords.commit(&law, Segment::Straight(to)).unwrap(), 0.0);
        assert!(chords.knot_count() <= Curve::DEFAULT_CAPACITY);
    }
    let off = (chords.force(&law) - path.force(1.0)).abs() / limit;
    for (what, curve) in [("grown", &grown), ("chords", &chords)] {
        let merged = curve.merged();
        println!("{what}: {} knots merged, {:.1e} of the limit booked", merged.knots, merged.force / limit);
        assert!(merged.knots > 900_000 && merged.force < 1e-9 * limit, "{what}: {merged:?}");
    }
    println!("chords: off by {off:.1e} of the limit");
    assert!(off < 1e-9, "{off:e}");
}

#[test]
fn a_million_random_corners_stay_within_the_capacity() {
    let law = paraboloid();
    let (limit, u_c) = (law.friction() * law.normal_force(DEPTH), law.gross_slip_displacement(DEPTH));
    let mut random = 0x5EED_u64;
    let mut unit = || {
        // Marsaglia's xorshift.
        random ^= random << 13;
        random ^= random >> 7;
        random ^= random << 17;
        (random >> 11) as f64 / (1_u64 << 53) as f64
    };
    let mut curve = Curve::with_capacity(&law, Apex { d: DEPTH, u: 0.0 }, 10);
    let mut whole = Curve::new(&law, Apex { d: DEPTH, u: 0.0 });
    let mut worst: f64 = 0.0;
    for k in 0..1_000_000_u32 {
        // Repeated oscillations of decreasing amplitude: reversals are stored and erased.
        let swing = u_c * (1.0 - f64::from(k % 500) / 500.0);
        let to = Apex { d: DEPTH * (0.8 + 0.2 * unit()), u: swing * (2.0 * unit() - 1.0) };
        curve.commit(&law, Segment::Straight(to)).unwrap();
        whole.commit(&law, Segment::Straight(to)).unwrap();
        assert!(curve.knot_count() <= 10 && whole.knot_count() <= Curve::DEFAULT_CAPACITY);
        worst = worst.max((curve.force(&law) - whole.force(&law)).abs());
    }
    let merged = curve.merged();
    println!(
        "{} knots merged: off by {:.1e}, {:.1e} booked",
        merged.knots,
        worst / limit,
        merged.force / limit
    );
    assert!(merged.knots > 1000 && whole.merged().knots == 0);
    assert!(worst <= merged.force.max(1e-12 * limit), "{worst:e} {merged:?}");
}
