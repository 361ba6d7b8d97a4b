//! Parts that feel nothing of each other, run side by side: each must be what it is alone, to the last bit, and a scene alone
//! knows nothing of parts. What is written of the whole is what each alone tells of the same moments.

use crate::lottery::{Draw, deal};
use crate::parts::{Looker, channel, contact, event, foot_and_slider, free, named, p1, wave};
use crate::soak::pressed;
use std::ops::Range;
use stickslip_contact::{Memory, Profile, Segment};
use stickslip_drive::scene::{Body, Coordinate, Freedom, Gravity, Named, Normal, Scene, Side, Varying};
use stickslip_drive::{
    Event, EventKind, Extent, Limits, Model, Moments, Plan, Record, Run, RunError, Shape, Source, State,
    Stepper, UntilSteady, run,
};

const PERIOD: f64 = 1e-3;
const KEY: [u8; 32] = [3; 32];

/// Two scenes side by side under names of their own.
fn beside(a: &Scene, b: &Scene) -> Scene {
    let mut both = renamed(a, "a", 0, 0);
    let other = renamed(b, "b", a.waveforms.len(), a.bodies.len());
    both.waveforms.extend(other.waveforms);
    both.bodies.extend(other.bodies);
    both.contacts.extend(other.contacts);
    both.springs.extend(other.springs);
    both.actuators.extend(other.actuators);
    both.loads.extend(other.loads);
    both
}

/// A scene whose waveforms and bodies stand further on in their lists.
fn renamed(scene: &Scene, mark: &str, waveforms: usize, bodies: usize) -> Scene {
    fn all<T: Clone>(list: &[Named<T>], mark: &str, change: impl Fn(&mut T)) -> Vec<Named<T>> {
        let moved = |item: &Named<T>| {
            let mut part = item.part.clone();
            change(&mut part);
            named(&format!("{mark}_{}", item.name), part)
        };
        list.iter().map(moved).collect()
    }
    let varies = |value: &mut Varying| {
        if let Varying::Follows(w) = value {
            *w += waveforms;
        }
    };
    let follows = |coordinate: &mut Coordinate| {
        if let Freedom::Follows(w) = &mut coordinate.freedom {
            *w += waveforms;
        }
    };
    let sides = |between: &mut [Side; 2]| {
        between.iter_mut().for_each(|side| {
            if let Side::Body(body) = side {
                *body += bodies;
            }
        });
    };
    let mut moved = scene.clone();
    moved.waveforms = all(&scene.waveforms, mark, |_| {});
    moved.bodies = all(&scene.bodies, mark, |body: &mut Body| {
        [&mut body.x, &mut body.z, &mut body.pitch].into_iter().for_each(follows);
    });
    moved.contacts = all(&scene.contacts, mark, |contact| {
        sides(&mut contact.between);
        if let Normal::Force(v) | Normal::Indentation(v) | Normal::Radius(v) = &mut contact.normal {
            varies(v);
        }
    });
    moved.springs = all(&scene.springs, mark, |spring| sides(&mut spring.between));
    moved.actuators = all(&scene.actuators, mark, |actuator| {
        sides(&mut actuator.between);
        varies(&mut actuator.stroke);
    });
    for load in &mut moved.loads {
        load.on += bodies;
        [&mut load.x, &mut load.z, &mut load.pitch].into_iter().for_each(varies);
    }
    moved
}

/// Keeps all that a run tells, and asks for looks and marks.
#[derive(Default)]
struct Diary {
    looks: Vec<f64>,
    marks: Vec<f64>,
    watched: Option<usize>,
    follows: bool,
    without_events: bool,
    /// Times that it was asked whether to go on, where it interrupts every other time.
    interrupts: Option<u32>,
    asked: (usize, usize),
    rows: Vec<Vec<f64>>,
    events: Vec<(Event, Vec<f64>)>,
    seen: Vec<(f64, Vec<Memory>)>,
    read: Vec<Vec<f64>>,
    extents: Vec<Extent>,
    paths: Vec<(usize, Segment)>,
    /// Time of what was told last, s, and whether rows or events ever went back.
    last: f64,
    disordered: bool,
}

impl Diary {
    fn tells(&mut self, t: f64) {
        self.disordered |= t < self.last;
        self.last = t;
    }
}

impl Record for Diary {
    fn row(&mut self, values: &[f64]) {
        self.tells(values[0]);
        self.rows.push(values.to_vec());
    }
    fn event(&mut self, event: &Event, values: &[f64]) {
        self.tells(event.t);
        assert_eq!(event.t, values[0]);
        self.events.push((*event, values.to_vec()));
    }
    fn next_look(&mut self) -> Option<f64> {
        self.asked.0 += 1;
        self.looks.get(self.asked.0 - 1).copied()
    }
    fn look(&mut self, t: f64, memories: &[Memory]) {
        self.seen.push((t, memories.to_vec()));
    }
    fn next_mark(&mut self) -> Option<f64> {
        self.asked.1 += 1;
        self.marks.get(self.asked.1 - 1).copied()
    }
    fn mark(&mut self, values: &[f64]) {
        self.read.push(values.to_vec());
    }
    fn watched(&self) -> [Option<usize>; 2] {
        [self.watched, None]
    }
    fn extents(&mut self, [body, none]: [Extent; 2]) {
        assert!(none.is_none());
        self.extents.push(body);
    }
    fn goes_on(&mut self, _: f64) -> bool {
        self.interrupts.as_mut().is_none_or(|asked| {
            *asked += 1;
            *asked % 2 == 0
        })
    }
    fn follows(&self) -> bool {
        self.follows
    }
    fn wants_events(&self) -> bool {
        !self.without_events
    }
    fn path(&mut self, c: usize, segment: Segment) {
        self.paths.push((c, segment));
    }
}

/// Drawn scenes, as they come out of both lots, with their periods, s; all without gravity.
fn drawn() -> Vec<(Scene, f64, String)> {
    let dealt = (0..24).map(|seed| {
        let drawn = deal(seed);
        (drawn.scene, drawn.period, drawn.title)
    });
    let begun = (0..24).map(|seed| {
        let (scene, period) = pressed(seed);
        (scene, period, format!("pressed {seed}"))
    });
    dealt
        .chain(begun)
        .filter(|(scene, ..)| scene.gravity == Gravity::default() && Model::new(scene).is_ok())
        .collect()
}

/// Pairs of them, one after the other.
fn pairs() -> Vec<(Scene, Scene, f64, String)> {
    let all = drawn();
    let step = all.len() / 2;
    let pair = |i: usize| {
        let ((a, ta, na), (b, tb, nb)) = (&all[i], &all[i + step]);
        (a.clone(), b.clone(), 1.3 * ta.max(*tb), format!("{na} beside {nb}"))
    };
    (0..step).map(pair).collect()
}

fn told(scene: &Scene, plan: &Plan, mut diary: Diary) -> (Model, State, Diary, Result<(), RunError>) {
    let model = Model::new(scene).unwrap();
    let mut state = model.start(plan).unwrap();
    let outcome = run(&model, plan, &mut state, &mut diary);
    (model, state, diary, outcome)
}

/// Places of the channels of a scene in the row of two, its own names marked; energies and time left out.
fn columns(alone: &Model, both: &Model, mark: &str) -> Vec<(usize, usize)> {
    let names = alone.channels().into_iter().enumerate();
    let own = names.filter(|(_, c)| c.name != "time_s" && !c.name.starts_with("energy."));
    own.map(|(i, c)| (i, channel(both, &format!("{mark}_{}", c.name)))).collect()
}

fn same(alone: &[f64], both: &[f64], columns: &[(usize, usize)]) -> bool {
    alone[0] == both[0] && columns.iter().all(|(own, whole)| alone[*own].to_bits() == both[*whole].to_bits())
}

/// One of two scenes side by side: what it is alone, and where it lies in both.
struct Own<'s> {
    scene: &'s Scene,
    diary: &'s Diary,
    columns: Vec<(usize, usize)>,
    waveforms: Range<usize>,
    contacts: Range<usize>,
}

impl Own<'_> {
    /// An event of both, as it is counted alone.
    fn event(&self, event: &Event) -> Option<Event> {
        let inside = |range: &Range<usize>, i: usize| range.contains(&i).then(|| i - range.start);
        let source = match event.source {
            Source::Contact(c) => Source::Contact(inside(&self.contacts, c)?),
            Source::Waveform(w) => Source::Waveform(inside(&self.waveforms, w)?),
            Source::Block(_) => return None,
        };
        Some(Event { source, ..*event })
    }

    /// Rows, events, looks and paths are those of it alone; gives how many events there are.
    fn is_told_by(&self, both: &Diary) -> usize {
        let Self { diary: alone, columns, contacts, .. } = self;
        assert_eq!(both.rows.len(), alone.rows.len());
        assert!(both.rows.iter().zip(&alone.rows).all(|(both, row)| same(row, both, columns)));
        let told: Vec<_> = both.events.iter().filter_map(|(e, row)| Some((self.event(e)?, row))).collect();
        assert_eq!(told.len(), alone.events.len());
        for ((event, both), (known, row)) in told.iter().zip(&alone.events) {
            assert_eq!(event, known);
            assert!(same(row, both, columns), "{event:?}");
        }
        assert_eq!(both.seen.len(), alone.seen.len());
        for ((t, seen), (at, memories)) in both.seen.iter().zip(&alone.seen) {
            assert!(t == at && seen[contacts.clone()] == memories[..], "a look at {t}");
        }
        let paths = both.paths.iter().filter(|(c, _)| contacts.contains(c));
        assert!(paths.map(|(c, path)| (c - contacts.start, *path)).eq(alone.paths.iter().copied()));
        told.len()
    }

    /// At the events of the other it is read as it reads itself, were it asked; gives how often.
    fn is_read_amid(&self, plan: &Plan, both: &Diary, other: &Diary) -> usize {
        let mut marks: Vec<f64> = other.events.iter().map(|(event, _)| event.t).collect();
        marks.dedup();
        let (.., alone, _) = told(self.scene, plan, Diary { marks, ..Diary::default() });
        // Where both have events at one moment the order of these decides.
        let is_own = |t: f64| alone.events.iter().any(|(event, _)| (event.t - t).abs() <= 1e-14 * t);
        let mut count = 0;
        for row in alone.read.iter().filter(|row| !is_own(row[0])) {
            // A moment within four last places of the end of a step is that end, for both.
            for (event, both) in both.events.iter().filter(|(event, _)| event.t == row[0]) {
                assert!(same(row, both, &self.columns), "{event:?}");
                count += 1;
            }
        }
        count
    }
}

/// Rows, events with the rows of all that was happening elsewhere, looks, paths and counts: those of each scene alone.
#[test]
fn each_part_is_what_it_is_alone() {
    let (mut rows, mut events, mut amid) = (0, 0, 0);
    for (a, b, duration, title) in pairs() {
        println!("{title}");
        let plan = Plan { every: Some(0.0371 * duration), ..event(1e-7, duration) };
        let looks: Vec<f64> = (0..7).map(|i| 0.15 * f64::from(i) * duration).collect();
        let diary = || Diary { looks: looks.clone(), follows: true, ..Diary::default() };
        let (model, state, both, outcome) = told(&beside(&a, &b), &plan, diary());
        assert!(model.divides(&plan) && model.part_count() >= 2);
        let [first, second] = [&a, &b].map(|scene| told(scene, &plan, diary()));
        if first.3.is_err() || second.3.is_err() {
            assert!(outcome.is_err());
            continue;
        }
        outcome.unwrap();
        assert!(!both.disordered);
        let (w, c) = (a.waveforms.len(), a.contacts.len());
        let (waveforms, contacts) = (w..w + b.waveforms.len(), c..c + b.contacts.len());
        let [x, y] = [(&first, "a"), (&second, "b")].map(|(told, mark)| columns(&told.0, &model, mark));
        let one = Own { scene: &a, diary: &first.2, columns: x, waveforms: 0..w, contacts: 0..c };
        let other = Own { scene: &b, diary: &second.2, columns: y, waveforms, contacts };
        events += one.is_told_by(&both) + other.is_told_by(&both);
        amid += one.is_read_amid(&plan, &both, other.diary) + other.is_read_amid(&plan, &both, one.diary);
        rows += both.rows.len();
        let memories: Vec<_> = [&first, &second].into_iter().flat_map(|told| told.1.memories()).collect();
        assert!(state.memories().iter().eq(memories));
        let [whole, x, y] = [&state, &first.1, &second.1].map(|state| {
            let counts = state.counts();
            [counts.steps, counts.rejected, counts.evaluations, counts.events, counts.detours]
        });
        assert!((0..5).all(|i| whole[i] == x[i] + y[i]), "{whole:?} {x:?} {y:?}");
    }
    println!("{rows} rows, {events} events and {amid} readings of the others compared");
    assert!(rows > 250 && events > 10_000 && amid > 10_000);
}

/// Sliders of several masses on one foot: each as by itself, and a corner of their common drive is one event.
fn sliders(masses: &[f64]) -> Scene {
    let mut scene = p1();
    scene.bodies[1].part.mass = Some(masses[0]);
    for (i, mass) in masses.iter().enumerate().skip(1) {
        scene.bodies.push(named(&format!("slider {i}"), free(*mass)));
        let mut ball = scene.contacts[0].part.clone();
        ball.between = [Side::Body(0), Side::Body(i + 1)];
        scene.contacts.push(named(&format!("ball {i}"), ball));
    }
    scene
}

#[test]
fn a_corner_of_a_common_drive_is_one_event() {
    let masses = [0.02, 0.021, 0.02, 0.035];
    let plan = Plan { every: Some(17e-6), ..event(1e-8, 5.0 * PERIOD) };
    let (model, state, whole, outcome) = told(&sliders(&masses), &plan, Diary::default());
    outcome.unwrap();
    assert_eq!(model.part_count(), 4);
    assert!(!whole.disordered);
    assert_eq!(state.counts().events, whole.events.len() as u64);
    let corners = |diary: &Diary| -> Vec<(Event, Vec<f64>)> {
        let is_corner = |(event, _): &&(Event, Vec<f64>)| event.kind == EventKind::Corner;
        diary.events.iter().filter(is_corner).cloned().collect()
    };
    for (i, mass) in masses.into_iter().enumerate() {
        let (own, end, alone, _) = told(&sliders(&[mass]), &plan, Diary::default());
        let name = |name: &str| match i {
            0 => name.to_owned(),
            _ => name.replace("slider", &format!("slider {i}")).replace("ball", &format!("ball {i}")),
        };
        let names = own.channels().into_iter().enumerate();
        let names = names.filter(|(_, c)| c.name != "time_s" && !c.name.starts_with("energy."));
        let columns: Vec<_> = names.map(|(k, c)| (k, channel(&model, &name(&c.name)))).collect();
        assert!(whole.rows.len() == alone.rows.len());
        assert!(whole.rows.iter().zip(&alone.rows).all(|(w, o)| same(o, w, &columns)));
        let (told, own) = (corners(&whole), corners(&alone));
        assert_eq!(told.len(), own.len());
        // After the corner, for all of them.
        assert!(told.iter().zip(&own).all(|(w, o)| w.0.t == o.0.t && same(&o.1, &w.1, &columns)));
        assert_eq!(state.body(&model, i + 1), end.body(&Model::new(&sliders(&[mass])).unwrap(), 1));
    }
}

/// What is booked of the whole closes: energies of the parts add up.
#[test]
fn the_books_of_the_whole_close() {
    let plan = Plan { every: Some(0.1 * PERIOD), ..event(1e-11, 10.0 * PERIOD) };
    let (model, _, whole, outcome) = told(&sliders(&[0.02, 0.021, 0.05]), &plan, Diary::default());
    outcome.unwrap();
    let [input, error] = ["energy.input_J", "energy.error_J"].map(|name| channel(&model, name));
    let most = whole.rows.iter().map(|row| row[error].abs()).fold(0.0, f64::max);
    let put_in = whole.rows.last().unwrap()[input];
    println!("books of {put_in:e} J close to {most:e} J");
    assert!(most < 1e-9 * put_in);
}

/// After any number of steps: put down as bytes, taken up, and joined to what one run writes.
#[test]
fn a_whole_taken_up_anywhere_goes_on_to_the_same_bits() {
    let (mut taken, mut unlevel) = (0, 0);
    for (a, b, duration, title) in pairs().into_iter().step_by(2) {
        let model = Model::new(&beside(&a, &b)).unwrap();
        let plan = Plan { every: Some(0.0371 * duration), ..event(1e-6, duration) };
        let start = model.start(&plan).unwrap();
        let (mut end, mut whole) = (start.clone(), Diary::default());
        if run(&model, &plan, &mut end, &mut whole).is_err() {
            continue;
        }
        let bytes = end.to_bytes(&model, &KEY);
        assert!(State::from_bytes(&model, &KEY, &bytes).unwrap() == end, "{title}");
        let mut draw = Draw::new(taken);
        for kind in 0..4 {
            let steps = 1 + draw.bits() % (end.counts().steps + end.counts().rejected).max(2);
            let share = draw.between(0.1, 0.95);
            let short = match kind {
                0 | 1 => Plan { limits: Limits { steps, ..plan.limits }, ..plan },
                _ => Plan { duration: share * duration, ..plan },
            };
            let (mut first, mut before) =
                (Run::new(&model, &short, start.clone()).unwrap(), Diary::default());
            let outcome = first.approach(&mut before);
            assert!(outcome.is_ok() || matches!(outcome, Err(RunError::TooManySteps { .. })), "{title}");
            let bytes = first.state().to_bytes(&model, &KEY);
            let state = State::from_bytes(&model, &KEY, &bytes).unwrap();
            assert!(&state == first.state(), "{title} {kind}");
            let (mut second, mut after) = (Run::resume(&model, &plan, state).unwrap(), Diary::default());
            second.finish(&mut after).unwrap();
            let other = second.into_state();
            assert!(other == end, "{title} {kind} {steps} {share}\n{:?}\n{:?}", other.counts(), end.counts());
            unlevel += u32::from(first.state().time() > 0.0);
            before.rows.extend(after.rows);
            before.events.extend(after.events);
            assert!(before.rows == whole.rows, "{title} {kind}: rows");
            assert!(before.events == whole.events, "{title} {kind}: events");
            taken += 1;
        }
    }
    println!("{taken} runs taken up, {unlevel} of them after a stretch");
    assert!(taken > 20 && unlevel > 20);
}

/// Interrupted again and again, in this process or taken up in another, a run comes to the same end and writes the same.
#[test]
fn interruptions_change_no_bit() {
    let masses: Vec<f64> = (0..12).map(|i| 0.02 + 0.003 * f64::from(i)).collect();
    let model = Model::new(&sliders(&masses)).unwrap();
    let plan = Plan { every: Some(PERIOD), ..event(1e-7, 120.0 * PERIOD) };
    let (mut end, mut whole) = (model.start(&plan).unwrap(), Diary::default());
    run(&model, &plan, &mut end, &mut whole).unwrap();
    let mut first = Run::new(&model, &plan, model.start(&plan).unwrap()).unwrap();
    let (mut diary, mut interrupted) = (Diary { interrupts: Some(0), ..Diary::default() }, 0);
    while let Err(error) = first.approach(&mut diary) {
        assert!(matches!(error, RunError::Interrupted { .. }), "{error}");
        interrupted += 1;
        if interrupted % 2 == 0 {
            let bytes = first.state().to_bytes(&model, &KEY);
            first = Run::resume(&model, &plan, State::from_bytes(&model, &KEY, &bytes).unwrap()).unwrap();
        }
    }
    diary.interrupts = None;
    first.finish(&mut diary).unwrap();
    println!("{interrupted} interruptions");
    assert!(interrupted >= 2);
    assert_eq!(first.state().counts(), end.counts());
    assert!(*first.state() == end);
    assert!(diary.rows == whole.rows && diary.events == whole.events);
}

/// A run of 2T is that of T, and on.
#[test]
fn no_number_depends_on_the_end() {
    let model = Model::new(&sliders(&[0.02, 0.031])).unwrap();
    let every = Some(13e-6);
    let [half, whole] = [3.3, 6.6].map(|periods| Plan { every, ..event(1e-8, periods * PERIOD) });
    let rows = |plan: &Plan| {
        let (mut state, mut diary) = (model.start(plan).unwrap(), Diary::default());
        run(&model, plan, &mut state, &mut diary).unwrap();
        diary.rows
    };
    let (short, long) = (rows(&half), rows(&whole));
    let shared = short.len() - 1;
    assert!(shared > 200 && short[..shared] == long[..shared]);
}

/// Frames of an advance cut nothing where motion has a closed form, and allocate nothing.
#[test]
fn frames_are_the_whole_run() {
    let model = Model::new(&sliders(&[0.02, 0.031])).unwrap();
    let plan = event(1e-8, 5.0 * PERIOD);
    let mut once = model.start(&plan).unwrap();
    run(&model, &plan, &mut once, &mut ()).unwrap();
    let mut frames = Run::new(&model, &plan, model.start(&plan).unwrap()).unwrap();
    let mut k = 0.0_f64;
    while frames.state().time() < 5.0 * PERIOD {
        k += 1.0;
        frames.advance((k * 17e-6).min(5.0 * PERIOD), &mut ()).unwrap();
        if k % 50.0 == 0.0 {
            let state = frames.state().clone();
            assert!(State::from_bytes(&model, &KEY, &state.to_bytes(&model, &KEY)).unwrap() == state);
            frames = Run::resume(&model, &plan, state).unwrap();
        }
    }
    for body in [1, 2] {
        assert_eq!(frames.state().body(&model, body), once.body(&model, body));
    }
    assert_eq!(frames.state().counts().events, once.counts().events);
}

/// Each call may bring a record of its own: events are told to whoever wants them then.
#[test]
fn a_later_record_has_its_events() {
    let model = Model::new(&sliders(&[0.02, 0.031])).unwrap();
    let plan = event(1e-8, 5.0 * PERIOD);
    let mut whole = Diary::default();
    run(&model, &plan, &mut model.start(&plan).unwrap(), &mut whole).unwrap();
    let mut held = Run::new(&model, &plan, model.start(&plan).unwrap()).unwrap();
    held.advance(1.7 * PERIOD, &mut ()).unwrap();
    let mut diary = Diary::default();
    held.advance(3.1 * PERIOD, &mut diary).unwrap();
    held.advance(3.9 * PERIOD, &mut ()).unwrap();
    held.finish(&mut diary).unwrap();
    let within = |t: f64| t > 1.7 * PERIOD && t <= 3.1 * PERIOD || t > 3.9 * PERIOD;
    let times = |diary: &Diary| diary.events.iter().map(|(event, _)| event.t).collect::<Vec<_>>();
    let known: Vec<f64> = times(&whole).into_iter().filter(|t| within(*t)).collect();
    assert!(known.len() > 10);
    assert_eq!(times(&diary), known);
}

/// Periods longer than a stretch: the part whose steps may end the run is looked ahead in the middle of its leaps.
#[test]
fn steps_longer_than_a_stretch_are_those_of_each_alone() {
    let slow = |mut scene: Scene| {
        let sawtooth = Shape::Sawtooth { stroke: 0.5e-6, flyback: 0.1e-3 };
        scene.waveforms[0] = wave("drive", sawtooth, 60e-3);
        scene
    };
    let steady = Some(UntilSteady { waveform: 0, body: 1, change: 1e-4 });
    let plan = Plan { until_steady: steady, every: Some(1e-3), ..event(1e-8, 0.8) };
    let (own, alone, rows, _) = told(&slow(sliders(&[0.02])), &plan, Diary::default());
    let (model, state, whole, outcome) = told(&slow(sliders(&[0.02, 0.031])), &plan, Diary::default());
    outcome.unwrap();
    assert_eq!((state.time(), state.body(&model, 1)), (alone.time(), alone.body(&own, 1)));
    assert!(whole.events.len() > rows.events.len() && rows.rows.len() > 200);
    let x = |model: &Model| channel(model, "slider.x_m");
    let of = |diary: &Diary, place: usize| diary.rows.iter().map(|row| row[place]).collect::<Vec<_>>();
    assert_eq!(of(&whole, x(&model)), of(&rows, x(&own)));
}

/// The steps of one part end the run of all: where they are constant, as alone.
#[test]
fn the_steady_end_of_one_part_ends_all() {
    let scene = sliders(&[0.02, 0.031]);
    let steady = Some(UntilSteady { waveform: 0, body: 1, change: 1e-4 });
    let plan = Plan { until_steady: steady, every: Some(0.3 * PERIOD), ..event(1e-8, 1000.0 * PERIOD) };
    let (_, alone, _, _) = told(&p1(), &plan, Diary::default());
    let (model, state, whole, outcome) = told(&scene, &plan, Diary::default());
    outcome.unwrap();
    assert_eq!(state.time(), alone.time());
    assert!(state.time() < 100.0 * PERIOD);
    assert_eq!(whole.rows.last().unwrap()[0], state.time());
    // The other one up to there.
    let (own, end, _, _) = told(&sliders(&[0.031]), &event(1e-8, state.time()), Diary::default());
    assert_eq!(state.body(&model, 2), end.body(&own, 1));
    assert_eq!(state.body(&model, 1), alone.body(&Model::new(&p1()).unwrap(), 1));
    // Put down before, taken up again.
    let mut first = Run::new(&model, &plan, model.start(&plan).unwrap()).unwrap();
    first.approach(&mut ()).unwrap();
    assert!(first.state().time() < state.time());
    let mut second = Run::resume(&model, &plan, first.into_state()).unwrap();
    second.finish(&mut ()).unwrap();
    assert!(second.state() == &state);
}

/// Where one part fails, all stand at that time, and what is written ends there.
#[test]
fn a_part_that_fails_stops_all_at_its_time() {
    // A row of springs under a growing load is outgrown.
    let mut outgrown = contact([Side::Body(0), Side::Body(1)], Profile::paraboloid(1e-3).unwrap(), 0.15, 1.0);
    outgrown.normal = Normal::Coupled;
    outgrown.engine = stickslip_drive::scene::EngineChoice::Springs { count: 50, span: Some(20e-6) };
    let mut pounding =
        foot_and_slider(wave("drive", Shape::Triangle { stroke: 1e-9 }, PERIOD), 0.02, outgrown);
    pounding.waveforms.push(wave("pound", Shape::Sine { amplitude: 2e-6, phase: 0.0, offset: 0.0 }, PERIOD));
    pounding.bodies[0].part.z = Coordinate::follows(1);
    let plan = Plan { every: Some(7e-6), ..event(1e-8, 2.0 * PERIOD) };
    let (_, stopped, alone, reason) = told(&pounding, &plan, Diary::default());
    let reason = reason.unwrap_err();
    let both = beside(&p1(), &pounding);
    let (model, state, whole, outcome) = told(&both, &plan, Diary::default());
    let named = |error: &RunError| format!("{error}").replace("b_", "");
    assert_eq!(named(&outcome.unwrap_err()), named(&reason));
    assert!(state.time() == stopped.time() && state.time() > 0.0);
    assert_eq!(whole.rows.len(), alone.rows.len());
    assert_eq!(whole.rows.last().unwrap()[0], state.time());
    // The other one stands there, as near as its tolerance is.
    let (own, end, _, _) = told(&p1(), &event(1e-8, state.time()), Diary::default());
    let (x, known) = (state.body(&model, 1).unwrap().0, end.body(&own, 1).unwrap().0);
    assert!((x - known).abs() < 1e-12, "{x:e} {known:e}");
    let last = whole.rows.last().unwrap()[channel(&model, "a_slider.x_m")];
    assert_eq!(last, x);
}

/// Marks, and the way of a body between them, are those of the body alone.
#[test]
fn marks_and_ranges_are_those_of_the_body_alone() {
    let plan = event(1e-8, 4.0 * PERIOD);
    let marks: Vec<f64> = (0..40).map(|i| 1e-4 * f64::from(i)).collect();
    // Events of the other are read on the way, which makes more of it known.
    for without_events in [true, false] {
        let diary =
            |body| Diary { marks: marks.clone(), watched: Some(body), without_events, ..Diary::default() };
        let (model, _, whole, outcome) = told(&sliders(&[0.02, 0.031]), &plan, diary(2));
        outcome.unwrap();
        let (own, _, alone, _) = told(&sliders(&[0.031]), &plan, diary(1));
        agree(&model, &whole, (&own, &alone), if without_events { 1e-12 } else { 1e-3 });
    }
}

fn agree(model: &Model, whole: &Diary, (own, alone): (&Model, &Diary), share: f64) {
    let (x, place) = (channel(own, "slider.x_m"), channel(model, "slider 1.x_m"));
    assert_eq!(whole.read.len(), 40);
    assert!(whole.read.iter().zip(&alone.read).all(|(w, o)| same(o, w, &[(x, place)])));
    assert_eq!(whole.extents.len(), alone.extents.len());
    for (told, own) in whole.extents.iter().zip(&alone.extents) {
        let numbers = |extent: &Extent| [extent.least[0], extent.most[0], extent.fall, extent.rise];
        let off = |(a, b): (&f64, &f64)| (a - b).abs() <= share * own.width();
        assert!(numbers(told).iter().zip(&numbers(own)).all(off), "{told:?} {own:?}");
    }
}

/// A state put down between steps goes on by a stepper that knows no parts.
#[test]
fn another_stepper_goes_on_with_all_parts_at_one_time() {
    let scene = sliders(&[0.02, 0.031]);
    let model = Model::new(&scene).unwrap();
    let plan = event(1e-9, 2.0 * PERIOD);
    let mut first = Run::new(&model, &plan, model.start(&plan).unwrap()).unwrap();
    first.approach(&mut ()).unwrap();
    let fixed = Plan { stepper: Stepper::Rk4 { step: 1e-7 }, ..plan };
    let t = first.state().time();
    let mut second = Run::resume(&model, &fixed, first.into_state()).unwrap();
    second.advance(t, &mut ()).unwrap();
    let mut known = model.start(&plan).unwrap();
    run(&model, &Plan { duration: t, ..plan }, &mut known, &mut ()).unwrap();
    for body in [1, 2] {
        let [(x, v), (other, w)] = [second.state(), &known].map(|state| state.body(&model, body).unwrap());
        assert!((x - other).abs() < 1e-14 * x.abs() && (v - w).abs() < 1e-14 * v.abs(), "{x:e} {other:e}");
    }
    second.finish(&mut ()).unwrap();
}

/// A look takes the memories of all contacts, in the scene's order.
#[test]
fn looks_are_those_of_each_alone() {
    let plan = event(1e-8, 2.0 * PERIOD);
    let look = |scene: &Scene| crate::parts::look(scene, &plan, Moments::Every(0.0171 * PERIOD)).2;
    let whole: Looker = look(&sliders(&[0.02, 0.031]));
    for (c, mass) in [0.02, 0.031].into_iter().enumerate() {
        let alone = look(&sliders(&[mass]));
        assert_eq!(whole.seen.len(), alone.seen.len());
        let both = whole.seen.iter().zip(&alone.seen);
        assert!(both.into_iter().all(|((t, all), (at, own))| t == at && all[c] == own[0]));
    }
}
