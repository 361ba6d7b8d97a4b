//! Generators that are commanded during a run.
//!
//! Each cycle uses the command in force at its start. The runs are compared with tables computed from this rule alone.

use crate::held::finished;
use crate::lottery::Draw;
use crate::parts::{FOOT_SLIDER, contact, event, foot_and_slider, named, plan, wave};
use stickslip_contact::Profile;
use stickslip_drive::scene::{Direction, Scene, Side};
use stickslip_drive::{
    BytesError, Command, CommandError, Cycle, EventKind, Generator, Heading, Model, Plan, Run, Shape, State,
    Stepper, Steps, Timing, Trace, Waveform, WaveformError,
};

const PERIOD: f64 = 1e-3;
const STROKE: f64 = 1e-6;
const FLYBACK: f64 = 20e-6;
const KEY: [u8; 32] = [3; 32];

fn command(steps: Steps) -> Command {
    Command { stroke: STROKE, frequency: PERIOD.recip(), heading: Heading::Forward, steps }
}

fn generator(initial: Command) -> Generator {
    let cycle = Cycle::Sawtooth { flyback: FLYBACK };
    Generator { cycle, initial, strokes: (0.0, STROKE), frequencies: (0.0, 5e3) }
}

/// Slider of P1 on a foot with this waveform.
fn dragged(shape: Shape, timing: Timing) -> Scene {
    let ball = contact(FOOT_SLIDER, Profile::paraboloid(1e-3).unwrap(), 0.15, 1.0);
    foot_and_slider(named("drive", Waveform::new(shape, timing).unwrap()), 0.02, ball)
}

fn commanded(generator: Generator) -> Model {
    Model::new(&dragged(Shape::Generator(generator), Timing::every(1.0))).unwrap()
}

fn begun<'m>(model: &'m Model, plan: &Plan) -> Run<'m> {
    Run::new(model, plan, model.start(plan).unwrap()).unwrap()
}

fn steppers() -> [Stepper; 5] {
    [
        Stepper::Event { tolerance: 1e-8 },
        Stepper::Verlet { step: 1.3e-6 },
        Stepper::Rk4 { step: 3.7e-6 },
        Stepper::Frames { length: 41e-6, accuracy: 1e-3 },
        Stepper::Dopri5 { tolerance: 1e-7 },
    ]
}

/// Position of the foot.
fn value(run: &Run<'_>, model: &Model) -> f64 {
    run.state().body(model, 0).unwrap().0
}

/// Without commands the generator equals a sawtooth with the same parameters: identical rows and events for every stepper, also
/// with a spring, where steps are taken.
#[test]
fn a_generator_left_alone_is_the_sawtooth() {
    let frequency = PERIOD.recip();
    for (cycle, shape) in [
        (Cycle::Sawtooth { flyback: FLYBACK }, Shape::Sawtooth { stroke: STROKE, flyback: FLYBACK }),
        (Cycle::Triangle, Shape::Triangle { stroke: STROKE }),
    ] {
        for sprung in [false, true] {
            let generator = Generator { cycle, ..generator(command(Steps::Endless)) };
            let scenes = [
                dragged(shape.clone(), Timing::every(frequency.recip())),
                dragged(Shape::Generator(generator), Timing::every(1.0)),
            ];
            let models = scenes.map(|mut scene| {
                if sprung {
                    let between = [Side::Ground, Side::Body(1)];
                    let at = [stickslip_drive::scene::Point::default(); 2];
                    let spring = stickslip_drive::scene::Spring {
                        between,
                        at,
                        direction: Direction::X,
                        stiffness: 1e4,
                        damping: 3.0,
                        preload: 0.0,
                    };
                    scene.springs.push(named("spring", spring));
                }
                Model::new(&scene).unwrap()
            });
            for stepper in steppers() {
                let plan = Plan { every: Some(7e-6), ..plan(stepper, 4.3 * PERIOD) };
                let [plain, generated] = models.each_ref().map(|model| {
                    let (mut state, mut trace) = (model.start(&plan).unwrap(), Trace::new(model));
                    stickslip_drive::run(model, &plan, &mut state, &mut trace).unwrap();
                    (state, trace)
                });
                let title = format!("{cycle:?} {stepper:?} {sprung}");
                assert_eq!(plain.1.rows().len(), 616, "{title}");
                assert!(plain.1.rows().eq(generated.1.rows()), "{title}");
                assert!(plain.1.events().eq(generated.1.events()), "{title}");
                assert_eq!(plain.0.counts(), generated.0.counts(), "{title}");
                assert_eq!(plain.0.body(&models[0], 1), generated.0.body(&models[1], 1), "{title}");
            }
        }
    }
}

/// A number of steps, then rest, equals a sawtooth with as many cycles.
#[test]
fn steps_are_counted_and_end_in_rest() {
    let frequency = PERIOD.recip();
    let shape = Shape::Sawtooth { stroke: STROKE, flyback: FLYBACK };
    let plain = Model::new(&dragged(shape, Timing { cycles: Some(3.0), ..Timing::every(frequency.recip()) }));
    let (plain, model) = (plain.unwrap(), commanded(generator(command(Steps::Left(3)))));
    let plan = Plan { every: Some(7e-6), ..event(1e-8, 4.3 * PERIOD) };
    let [a, b] =
        [&plain, &model].map(|model| finished(model, &plan, model.start(&plan).unwrap(), false).unwrap());
    assert!(a.1.rows().eq(b.1.rows()) && a.1.events().eq(b.1.events()));
    let waveform =
        Waveform::new(Shape::Generator(generator(command(Steps::Left(3)))), Timing::every(9.0)).unwrap();
    assert_eq!((waveform.period(), waveform.timing().cycles), (Some(frequency.recip()), Some(3.0)));
    assert_eq!(
        (waveform.range(), waveform.is_straight(), waveform.has_jumps()),
        ((0.0, STROKE), true, false)
    );
    // In frames, for which the number is reported.
    for stepper in &steppers()[..4] {
        let plan = Plan { stepper: *stepper, ..plan };
        let mut run = begun(&model, &plan);
        let mut k = 0_u32;
        while run.state().time() < 4.0 * PERIOD {
            k += 1;
            run.advance(f64::from(k) * 130e-6, &mut ()).unwrap();
            // Completed cycles and the present one.
            let cycles = (130e-6 * f64::from(k) / PERIOD).floor() as u64 + 1;
            let told = run.state().generated(0).unwrap();
            assert_eq!(told.begun, cycles.min(3), "{stepper:?} {k}");
            assert_eq!(told.next.steps, Steps::Left(3 - cycles.min(3)), "{stepper:?} {k}");
            assert_eq!(told.runs, cycles <= 3, "{stepper:?} {k}");
        }
        assert_eq!(value(&run, &model), 0.0);
    }
}

/// Points (time, value) of the table at every corner until `end`, for commands at given times. Equal cycles count from their first one.
fn by_the_rule(
    initial: Command,
    commands: &[(f64, Command)],
    cycle: Cycle,
    end: f64,
) -> (Vec<(f64, f64)>, u64) {
    let mut points = vec![(0.0, 0.0)];
    let (mut t, mut now, mut waiting, mut begun) = (0.0, initial, commands, 0);
    while t <= end {
        while let Some(((_, next), rest)) = waiting.split_first().filter(|((at, _), _)| *at <= t) {
            (now, waiting) = (*next, rest);
        }
        let is_idle = now.steps == Steps::Left(0) || now.stroke == 0.0 || now.frequency == 0.0;
        if is_idle {
            t = waiting.first().map_or(f64::INFINITY, |(at, _)| *at);
            points.push((t.min(2.0 * end), 0.0));
            continue;
        }
        if let Steps::Left(steps) = &mut now.steps {
            *steps -= 1;
        }
        begun += 1;
        let period = 1.0 / now.frequency;
        let top = match (cycle, now.heading) {
            (Cycle::Triangle, _) => 0.5 * period,
            (Cycle::Sawtooth { flyback }, Heading::Forward) => period - flyback,
            (Cycle::Sawtooth { flyback }, Heading::Backward) => flyback,
        };
        points.extend([(t + top, now.stroke), (t + period, 0.0)]);
        t += period;
    }
    points.dedup_by(|b, a| b.0 == a.0);
    (points, begun)
}

fn drawn(draw: &mut Draw) -> Command {
    let steps = match draw.bits() % 4 {
        0 => Steps::Endless,
        steps => Steps::Left(steps - 1),
    };
    let frequency = if draw.bits().is_multiple_of(8) { 0.0 } else { draw.between(1e3, 5e3) };
    let stroke = if draw.bits().is_multiple_of(8) { 0.0 } else { draw.between(0.1, 1.0) * STROKE };
    let heading = if draw.bits().is_multiple_of(2) { Heading::Forward } else { Heading::Backward };
    Command { stroke, frequency, heading, steps }
}

/// Commands at random times agree with the table, for every stepper.
#[test]
fn commands_at_any_moment_are_the_table_of_the_rule() {
    let end = 6.0 * PERIOD;
    // Distances of the event stepper from the table's run, and of fixed steps from the table.
    let (mut worst, mut off_events) = (0.0_f64, [[0.0_f64; 2]; 3]);
    for seed in 0..40 {
        let mut draw = Draw::new(seed);
        let cycle = if seed % 4 == 3 { Cycle::Triangle } else { Cycle::Sawtooth { flyback: FLYBACK } };
        let initial = if seed % 2 == 0 { command(Steps::Left(0)) } else { drawn(&mut draw) };
        let mut at = 0.0;
        let commands: Vec<(f64, Command)> = (0..12)
            .map(|_| {
                at += draw.between(0.05, 0.9) * PERIOD;
                (at, drawn(&mut draw))
            })
            .filter(|(at, _)| *at < end)
            .collect();
        let model = commanded(Generator { cycle, ..generator(initial) });
        let (points, begun_by_rule) = by_the_rule(initial, &commands, cycle, end);
        let table = Model::new(&dragged(Shape::Table { points }, Timing::every(1.0))).unwrap();
        let unit = model.contact_natural(0).unwrap().displacement;
        let mut exact = 0.0;
        for (i, stepper) in steppers()[..4].iter().enumerate() {
            let plan = plan(*stepper, end);
            let (mut run, mut other) = (begun(&model, &plan), begun(&table, &plan));
            for (at, command) in &commands {
                run.advance(*at, &mut ()).unwrap();
                other.advance(*at, &mut ()).unwrap();
                let off = (value(&run, &model) - value(&other, &table)).abs();
                assert!(off < 1e-9 * STROKE, "{seed} {stepper:?} at {at}: {off:e}");
                run.command(0, *command).unwrap();
            }
            run.advance(end, &mut ()).unwrap();
            other.advance(end, &mut ()).unwrap();
            assert_eq!(run.state().generated(0).unwrap().begun, begun_by_rule, "{seed} {stepper:?}");
            let [a, b] = [(&run, &model), (&other, &table)].map(|(r, m)| r.state().body(m, 1).unwrap().0);
            match i.checked_sub(1) {
                None => (exact, worst) = (b, worst.max((a - b).abs() / unit)),
                Some(i) => {
                    for (off, x) in off_events[i].iter_mut().zip([a, b]) {
                        *off += (x - exact).abs() / unit / 40.0;
                    }
                }
            }
        }
    }
    println!("off the table {worst:e} u_c; on average off the events [generated, table]: {off_events:?} u_c");
    assert!(worst < 1e-9, "{worst:e}");
    // Fixed steps end at changes of cycles, but not at corners of the table: both have the same error.
    assert!(off_events.iter().all(|[generated, table]| *generated < 1.2 * table), "{off_events:?}");
}

/// For any commands the value stays in its range without jumps, and every cycle is reported.
#[test]
fn a_hundred_thousand_commands_keep_the_value_in_its_window() {
    for (seed, stepper) in
        [Stepper::Event { tolerance: 1e-3 }, Stepper::Verlet { step: 5e-6 }].into_iter().enumerate()
    {
        let mut draw = Draw::new(77 + seed as u64);
        // Only the foot moves, so steps are cheap.
        let mut scene = dragged(Shape::Generator(generator(command(Steps::Left(0)))), Timing::every(1.0));
        scene.bodies[1].part = stickslip_drive::scene::Body::default();
        let model = Model::new(&scene).unwrap();
        let plan = plan(stepper, 1.0);
        let mut run = begun(&model, &plan);
        let (mut t, mut before, mut begun) = (0.0, 0.0, 0);
        for k in 0..50_000 {
            // Some at the same time as the previous one.
            if k % 5 != 0 {
                t += draw.between(1e-7, 1.5e-5);
                run.advance(t, &mut ()).unwrap();
            }
            let now = value(&run, &model);
            assert!((0.0..=STROKE).contains(&now), "{k} {t}: {now}");
            let told = run.state().generated(0).unwrap();
            // At most the largest possible rate.
            assert!(
                (now - before).abs() <= 1.5e-5 * STROKE / FLYBACK * (1.0 + 1e-9),
                "{k} {t}: {before} {now}"
            );
            assert!(told.begun == begun || told.begun == begun + 1, "{k} {t}: {} {begun}", told.begun);
            assert!(told.runs || now == 0.0, "{k} {t}: {now}");
            (before, begun) = (now, told.begun);
            run.command(0, drawn(&mut draw)).unwrap();
            let commanded = run.state().generated(0).unwrap();
            // The command moves nothing, and at most one cycle has just begun.
            assert_eq!(value(&run, &model), now);
            assert!(commanded.begun.abs_diff(begun) <= 1);
            begun = commanded.begun.min(begun);
        }
        println!("{stepper:?}: {begun} cycles in {t} s");
        assert!(begun > 500);
    }
}

/// Fast forward and slow return: the slider moves in the opposite direction by the same amount.
#[test]
fn backward_cycles_carry_the_slider_back() {
    let [forward, backward] = [Heading::Forward, Heading::Backward].map(|heading| {
        let model = commanded(generator(Command { heading, ..command(Steps::Endless) }));
        let plan = event(1e-9, 20.0 * PERIOD);
        let (state, _) = finished(&model, &plan, model.start(&plan).unwrap(), false).unwrap();
        state.body(&model, 1).unwrap().0
    });
    println!("forward {forward:e} m, backward {backward:e} m in 20 periods");
    assert!(forward > 10.0 * STROKE && backward < -10.0 * STROKE);
    // Except for the first and last cycle.
    assert!((forward + backward).abs() < 2.0 * STROKE, "{forward:e} {backward:e}");
}

/// Without frequency, stroke or steps there are no corners. A command begins at once; one for the next cycle waits.
#[test]
fn rest_costs_nothing_and_ends_at_once() {
    let idle = [
        command(Steps::Left(0)),
        Command { frequency: 0.0, ..command(Steps::Endless) },
        Command { stroke: 0.0, ..command(Steps::Endless) },
    ];
    for idle in idle {
        let model = commanded(generator(idle));
        let plan = event(1e-8, 10.0 * PERIOD);
        let mut run = begun(&model, &plan);
        let mut trace = Trace::new(&model);
        run.advance(0.37 * PERIOD, &mut trace).unwrap();
        assert_eq!((run.state().counts().events, value(&run, &model)), (0, 0.0));
        assert!(!run.state().generated(0).unwrap().runs);
        // A command without motion makes no corner.
        run.command(0, Command { heading: Heading::Backward, ..idle }).unwrap();
        run.command(0, idle).unwrap();
        run.advance(0.5 * PERIOD, &mut trace).unwrap();
        assert!(trace.events().all(|(event, _)| event.kind != EventKind::Corner));
        run.command(0, command(Steps::Left(1))).unwrap();
        run.advance(0.75 * PERIOD, &mut trace).unwrap();
        let expected = 0.25 * PERIOD * STROKE / (PERIOD - FLYBACK);
        assert!((value(&run, &model) - expected).abs() < 1e-12 * STROKE);
        // The present cycle is completed.
        run.command(0, Command { heading: Heading::Backward, ..command(Steps::Left(2)) }).unwrap();
        run.advance(1.5 * PERIOD + 0.5 * FLYBACK, &mut trace).unwrap();
        assert!((value(&run, &model) - 0.5 * STROKE).abs() < 1e-9 * STROKE);
        run.advance(4.0 * PERIOD, &mut trace).unwrap();
        let told = run.state().generated(0).unwrap();
        assert_eq!((told.begun, told.runs, value(&run, &model)), (3, false, 0.0));
        let jumps = trace.events().filter(|(event, _)| event.kind == EventKind::Jump).count();
        let corners = trace.events().filter(|(event, _)| event.kind == EventKind::Corner).count();
        assert_eq!((jumps, corners), (0, 7));
    }
}

/// A command at the start of a cycle applies to that cycle, for every stepper.
#[test]
fn a_command_at_a_corner_is_the_cycle_that_begins_there() {
    let model = commanded(generator(command(Steps::Endless)));
    let back = Command { heading: Heading::Backward, ..command(Steps::Left(1)) };
    for stepper in &steppers()[..4] {
        for same in [false, true] {
            let plan = plan(*stepper, 1.0);
            let mut run = begun(&model, &plan);
            // The exact corner of the generator.
            run.advance(2.0 * PERIOD, &mut ()).unwrap();
            assert_eq!(run.state().generated(0).unwrap().begun, 3);
            // The second of two commands at one time counts.
            run.command(0, if same { command(Steps::Left(2)) } else { command(Steps::Left(0)) }).unwrap();
            run.command(0, if same { command(Steps::Left(1)) } else { back }).unwrap();
            run.advance(2.0 * PERIOD + 0.5 * FLYBACK, &mut ()).unwrap();
            let rise = if same { 0.5 * FLYBACK / (PERIOD - FLYBACK) } else { 0.5 };
            assert!((value(&run, &model) - rise * STROKE).abs() < 1e-9 * STROKE, "{stepper:?} {same}");
            run.advance(5.0 * PERIOD, &mut ()).unwrap();
            let told = run.state().generated(0).unwrap();
            assert_eq!((told.begun, told.runs, value(&run, &model)), (3, false, 0.0), "{stepper:?} {same}");
        }
    }
}

/// Resumed from bytes during a cycle, at rest, or with a waiting command, a run has the same bits.
#[test]
fn bytes_carry_what_is_commanded() {
    let model = commanded(generator(command(Steps::Left(0))));
    for stepper in &steppers()[..4] {
        let plan = plan(*stepper, 1.0);
        let mut draw = Draw::new(5);
        let mut run = begun(&model, &plan);
        let (mut t, mut seen) = (0.0, [0; 3]);
        for _ in 0..300 {
            t += draw.between(0.01, 0.6) * PERIOD;
            run.advance(t, &mut ()).unwrap();
            let waits = draw.bits().is_multiple_of(2);
            if waits {
                run.command(0, drawn(&mut draw)).unwrap();
            }
            let told = run.state().generated(0).unwrap();
            seen[if waits { 2 } else { usize::from(told.runs) }] += 1;
            let bytes = run.state().to_bytes(&model, &KEY);
            let read = State::from_bytes(&model, &KEY, &bytes).unwrap();
            assert!(&read == run.state() && read.to_bytes(&model, &KEY) == bytes);
            let mut other = Run::resume(&model, &plan, read).unwrap();
            t += draw.between(0.1, 2.0) * PERIOD;
            run.advance(t, &mut ()).unwrap();
            other.advance(t, &mut ()).unwrap();
            assert!(other.state() == run.state(), "{stepper:?} at {t}");
        }
        println!("{stepper:?}: {seen:?} at rest, running, commanded");
        assert!(seen.iter().all(|seen| *seen > 20), "{seen:?}");
    }
}

/// Bytes of impossible generator states are refused.
#[test]
fn bytes_of_what_no_generator_does_are_refused() {
    let model = commanded(generator(command(Steps::Left(5))));
    let plan = event(1e-8, 1.0);
    let mut run = begun(&model, &plan);
    run.advance(1.4 * PERIOD, &mut ()).unwrap();
    run.command(0, command(Steps::Left(2))).unwrap();
    let bytes = run.state().to_bytes(&model, &KEY);
    let (mut refused, mut taken) = (0, 0);
    for word in 7..bytes.len() / 8 - 1 {
        for value in
            [f64::NAN, -1.0, 1e300, 0.0, f64::INFINITY].map(f64::to_bits).into_iter().chain([1, 2, u64::MAX])
        {
            let mut other = bytes.clone();
            other[8 * word..8 * word + 8].copy_from_slice(&value.to_le_bytes());
            let end = other.len() - 8;
            let sum = u64::from(crc32fast::hash(&other[..end]));
            other[end..].copy_from_slice(&sum.to_le_bytes());
            match State::from_bytes(&model, &KEY, &other) {
                Ok(state) => {
                    taken += 1;
                    // An accepted state reports its activity at once.
                    assert!(state.generated(0).is_some());
                }
                Err(error) => {
                    assert_eq!(error, BytesError::Unfit);
                    refused += 1;
                }
            }
        }
    }
    println!("{refused} refused, {taken} taken");
    assert!(refused > 100 && taken > 0);
}

#[test]
fn what_a_generator_does_not_take_is_refused() {
    let plan = event(1e-8, PERIOD);
    let model = commanded(generator(command(Steps::Endless)));
    let mut run = begun(&model, &plan);
    let before = run.state().clone();
    let fine = command(Steps::Endless);
    assert_eq!(run.command(1, fine), Err(CommandError::NoGenerator(1)));
    for stroke in [-1e-9, 1.001 * STROKE, f64::NAN, f64::INFINITY] {
        let refused = run.command(0, Command { stroke, ..fine });
        assert!(matches!(refused, Err(CommandError::Stroke { generator: 0, low: 0.0, high: STROKE, .. })));
    }
    for frequency in [-1.0, 5001.0, f64::NAN, f64::INFINITY] {
        let refused = run.command(0, Command { frequency, ..fine });
        assert!(matches!(refused, Err(CommandError::Frequency { generator: 0, low: 0.0, high: 5e3, .. })));
    }
    assert!(run.state() == &before);
    let plain = Model::new(&dragged(Shape::Triangle { stroke: STROKE }, Timing::every(PERIOD))).unwrap();
    assert_eq!(begun(&plain, &plan).command(0, fine), Err(CommandError::NoGenerator(0)));
    assert_eq!(begun(&plain, &plan).state().generated(0), None);
}

#[test]
fn generators_that_make_no_sense_are_refused() {
    let good = generator(command(Steps::Endless));
    let refuse = |generator: Generator| {
        Waveform::new(Shape::Generator(generator), Timing::every(1.0)).expect_err("refused").key()
    };
    assert_eq!(refuse(Generator { cycle: Cycle::Sawtooth { flyback: 0.0 }, ..good }), "flyback");
    assert_eq!(refuse(Generator { cycle: Cycle::Sawtooth { flyback: f64::NAN }, ..good }), "flyback");
    // The period of 5 kHz.
    assert_eq!(refuse(Generator { cycle: Cycle::Sawtooth { flyback: 2e-4 }, ..good }), "flyback");
    assert_eq!(refuse(Generator { strokes: (STROKE, 0.0), ..good }), "stroke");
    assert_eq!(refuse(Generator { strokes: (0.0, 0.5 * STROKE), ..good }), "stroke");
    assert_eq!(refuse(Generator { frequencies: (-1.0, 5e3), ..good }), "frequency");
    assert_eq!(refuse(Generator { frequencies: (0.0, f64::INFINITY), ..good }), "frequency");
    assert_eq!(refuse(Generator { frequencies: (2e3, 5e3), ..good }), "frequency");
    assert_eq!(refuse(Generator { strokes: (0.0, 1e308), ..good }), "range");
    assert_eq!(refuse(Generator { strokes: (-1e308, 1e308), ..good }), "range");
    let of = |timing: Timing| Waveform::new(Shape::Generator(good), timing).map_err(|error| error.key());
    assert_eq!(of(Timing { delay: 1.0, ..Timing::every(1.0) }), Err("delay"));
    assert_eq!(of(Timing { phase: 1.0, ..Timing::every(1.0) }), Err("phase"));
    assert_eq!(of(Timing { cycles: Some(1.0), ..Timing::every(1.0) }), Err("cycles"));
    let error = WaveformError::Room { flyback: 2e-4, frequency: 5e3 };
    assert_eq!(
        error.to_string(),
        "flyback: expected a time below the period of the largest frequency, 5000 Hz, got 0.0002"
    );
    let _ = wave("drive", Shape::Generator(good), 1.0);
}
