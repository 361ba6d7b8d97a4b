//! What a run will do, known beforehand.
//!
//! No rule is written twice: states are made in which the contacts are in partial or in gross slip, grow or are apart, with
//! waveforms on straight pieces or on curved ones, and the run's own functions are asked what they would do there. Kinds of
//! intervals that a scene cannot come to, such as a flight of a contact that is always pressed, are left out.

use super::{IntervalTraits, Method, SceneTraits, Treatment, Why, choice, stepping, treatment};
use crate::contact::{Contact, Mode, Motion};
use crate::equations::Equations;
use crate::interval::{Followed, Interval, PhasePoint, Swing};
use crate::model::Model;
use crate::state::State;
use crate::{Accuracy, Stepper, Waveform};
use stickslip_contact::{Apex, Course, Memory, Segment};

/// The methods and treatments that the intervals of a run can come to, each with its reason.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Expected {
    /// In the order of their share of the work.
    pub methods: Vec<(Method, Why)>,
    /// By contact.
    pub contacts: Vec<Vec<(Treatment, Why)>>,
}

/// Pieces of a waveform that are looked through for one of each kind.
const PIECES: u32 = 8;

/// What all contacts may be doing at once.
#[derive(Clone, Copy)]
struct Phase {
    /// How far those that a load presses have been dragged, in u_c: partial or gross slip.
    dragged: f64,
    /// The course of those that bodies or waveforms press.
    pressed: Course,
}

const PHASES: [Phase; 8] = {
    const fn phase(dragged: f64, pressed: Course) -> Phase {
        Phase { dragged, pressed }
    }
    [
        phase(0.5, Course::Forward),
        phase(0.5, Course::Open),
        phase(0.5, Course::Grow),
        phase(2.0, Course::Forward),
        phase(2.0, Course::Open),
        phase(2.0, Course::Grow),
        phase(0.5, Course::Backward),
        phase(2.0, Course::Backward),
    ]
};

impl Expected {
    /// Whether a method is among them.
    pub fn takes(&self, method: Method) -> bool {
        self.methods.iter().any(|(known, _)| *known == method)
    }

    /// Why a contact, by its place in the scene, is treated so, if it can be.
    pub fn treats(&self, contact: usize, treatment: Treatment) -> Option<Why> {
        let known = self.contacts.get(contact)?.iter().find(|(known, _)| *known == treatment)?;
        Some(known.1)
    }

    fn add(&mut self, choice: (Method, Why)) {
        if !self.takes(choice.0) {
            self.methods.push(choice);
        }
    }

    fn treat(&mut self, contact: usize, choice: (Treatment, Why)) {
        if self.treats(contact, choice.0).is_none() {
            self.contacts[contact].push(choice);
        }
    }
}

impl Model {
    /// What a run from `start` by a stepper will do: every method that it may take and every treatment that a contact may get,
    /// the one that is asked for most first. Asked are the functions that the run asks, of one interval of each kind
    /// that the scene can come to: its contacts in partial and in gross slip, growing and apart, its waveforms on straight
    /// pieces and on curved ones.
    pub fn expected(&self, start: &State, stepper: Stepper) -> Expected {
        let mut expected =
            Expected { contacts: vec![Vec::new(); self.contacts.len()], ..Expected::default() };
        if !self.effective(stepper).locates_events() {
            expected.add((Method::AskedFor, Why::AskedFor));
            return expected;
        }
        let scene = SceneTraits::of(self);
        let mut swing = Swing::of(self, 1e-8);
        for straight in [true, false] {
            for phase in PHASES {
                let state = self.state_in(start, phase, straight);
                self.ask(&scene, &state, &mut swing, &mut expected);
            }
        }
        if expected.takes(Method::Swing) || expected.takes(Method::Parabola) {
            let (method, why) = stepping(&scene);
            expected.add((method, if expected.takes(Method::Swing) { Why::AtRest } else { why }));
        }
        if !self.free.is_empty() && self.contacts.iter().any(|contact| contact.interface.damping() > 0.0) {
            expected.add((Method::Whole, Why::Turns));
        }
        let tolerance = match self.effective(stepper).accuracy() {
            Accuracy::Tolerance(tolerance) => tolerance,
            Accuracy::Step(_) | Accuracy::Frame { .. } => 0.0,
        };
        let (method, _) = stepping(&scene);
        if let Some(brief) = method.brief(self, tolerance)
            && expected.takes(method)
        {
            expected.add((brief, Why::NearEvent));
        }
        // Implicit steps are all even.
        if !scene.stiff && self.contacts.iter().any(Contact::ends_singularly) {
            expected.add((Method::Graded, Why::SingularMoment));
        }
        expected
    }

    /// Asks what is done in an interval that begins in a state.
    fn ask<'a>(&'a self, scene: &SceneTraits, state: &State, swing: &mut Swing<'a>, expected: &mut Expected) {
        let mut interval = Interval::of(self);
        interval.begin(self, state);
        let mut traits = interval.traits;
        if let [slider] = &self.free[..]
            && traits.leaps(scene)
        {
            let start = PhasePoint { t: state.t, x: state.y[0], v: state.y[1] };
            traits = IntervalTraits { asked: !swing.begin(&interval, slider, start), ..traits };
        }
        expected.add(choice(scene, &traits));
        for (c, contact) in self.contacts.iter().enumerate() {
            let followed = || Followed::of(&contact.u, self, state).is_some();
            expected.treat(c, treatment(contact, &state.modes[c], followed));
        }
    }

    /// The start with all contacts in a phase and all waveforms on pieces of one kind, as far as they have any.
    fn state_in(&self, start: &State, phase: Phase, straight: bool) -> State {
        let mut state = start.clone();
        state.pieces = self.waveforms.iter().map(|waveform| piece(waveform, straight)).collect();
        for (c, contact) in self.contacts.iter().enumerate() {
            let constant = contact.is_constant();
            // A slider dragged forward drags a contact whose second body it is backward.
            let lean = contact.u.free.first().map_or(1.0, |(_, a)| a.signum());
            let course = match phase.pressed {
                Course::Open if !constant && !self.can_part(start, c) => Course::Forward,
                pressed if !constant => pressed,
                _ if lean < 0.0 => Course::Backward,
                _ => Course::Forward,
            };
            let memory = self.dragged(contact, &state, lean * phase.dragged);
            let apex = memory.apex();
            let at = Motion { d: apex.d, u: apex.u, dd: 0.0, du: course.sense() };
            state.modes[c] = Mode::of(contact, &memory, (course, &at), 0.0, 0.0);
            state.memories[c] = memory;
        }
        state
    }

    /// Whether contact `c` can be apart.
    fn can_part(&self, start: &State, c: usize) -> bool {
        self.indentations(start, c).is_none_or(|d| d.least <= 0.0)
    }

    /// The memory of a contact that has been dragged so far, in u_c, to where it stands.
    fn dragged(&self, contact: &Contact, state: &State, by: f64) -> Memory {
        let (d, way) = (contact.natural.depth, by * contact.natural.displacement);
        let equations = Equations::on(self, state, self.layout(), false);
        let u = equations.motion(contact, state.t, |i| state.y[i]).u;
        let mut memory = contact.engine.memory(&contact.interface, Apex { d, u: u - way });
        // Where that is not to be had the contact stays as it was made.
        let _ = memory.commit(&contact.interface, Segment::Straight(Apex { d, u }));
        memory
    }
}

impl Contact {
    /// Whether its force can end or begin with the power 3/2 of the time: at a touch, or where the last springs slip.
    fn ends_singularly(&self) -> bool {
        !self.is_never_pressed() && (self.coupling().is_some() || !self.inert && self.engine.branches())
    }
}

/// One of a waveform's first pieces that is straight, or curved; its first one where it has none such.
fn piece(waveform: &Waveform, straight: bool) -> crate::Piece {
    let first = waveform.piece_at(0.0);
    let mut piece = first;
    for _ in 0..PIECES {
        if piece.line().is_some() == straight {
            return piece;
        }
        if piece.end == f64::INFINITY {
            break;
        }
        piece = waveform.after(&piece);
    }
    first
}
