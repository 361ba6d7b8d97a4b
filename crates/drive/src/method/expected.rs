//! Prediction of the integration methods of a run.
//!
//! The functions that choose methods in a run are called for artificial states. In these states, contacts are in partial slip, in gross
//! slip, growing or open, and waveforms are on linear or curved pieces. Intervals that the model cannot have, such as flight of a contact
//! that is always pressed, are omitted.

use super::{IntervalTraits, Method, SceneTraits, Treatment, Why, choice, stepping, treatment};
use crate::contact::{Contact, Motion};
use crate::equations::Equations;
use crate::interval::{Followed, Interval, PhasePoint, Swing};
use crate::model::Model;
use crate::state::State;
use crate::{Accuracy, Stepper, Waveform};
use stickslip_contact::{Apex, Course, Law, Memory, Segment};

/// Integration methods and treatments of contacts that may occur in a run, each with its reason.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Expected {
    /// Integration methods, by decreasing share of the computing time.
    pub methods: Vec<(Method, Why)>,
    /// Possible treatments of each contact in intervals between events.
    pub contacts: Vec<Vec<(Treatment, Why)>>,
}

/// Number of first pieces of a waveform that are searched for a linear and a curved one.
const PIECES: u32 = 8;

/// Artificial state of all contacts, for the prediction.
#[derive(Clone, Copy)]
struct Phase {
    /// Displacement of contacts with constant load, in u_c: partial slip below 1, else gross slip.
    dragged: f64,
    /// Direction of motion of contacts with varying normal load.
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
    /// Returns whether an integration method may occur in the run.
    pub fn takes(&self, method: Method) -> bool {
        self.methods.iter().any(|(known, _)| *known == method)
    }

    /// Returns the reason for a treatment of a contact, given by its index; `None` if the treatment cannot occur.
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
    /// Returns the methods and treatments that may occur in a run from `start` with a stepper, the most frequent first. One interval of
    /// each possible kind is examined by the functions that a run calls.
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
        // Implicit steps are always even.
        if !scene.stiff && self.contacts.iter().any(Contact::ends_singularly) {
            expected.add((Method::Graded, Why::SingularMoment));
        }
        expected
    }

    /// Adds the integration method and the treatments of an interval that begins in a given state.
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

    /// Returns the initial state with all contacts in an artificial phase and waveforms on pieces of one kind, where possible.
    fn state_in(&self, start: &State, phase: Phase, straight: bool) -> State {
        let mut state = start.clone();
        state.pieces = self.waveforms.iter().map(|waveform| piece(waveform, straight)).collect();
        for (c, contact) in self.contacts.iter().enumerate() {
            let constant = contact.is_constant();
            // A slider moved forward drags a contact of which it is the second body backward.
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
            state.modes[c] = Law::of(contact, &memory, (course, &at), 0.0, 0.0);
            state.memories[c] = memory;
        }
        state
    }

    /// Returns whether contact `c` can be open.
    fn can_part(&self, start: &State, c: usize) -> bool {
        self.indentations(start, c).is_none_or(|d| d.least <= 0.0)
    }

    /// Returns the slip memory of a contact after a displacement `by`, in u_c, to its present position.
    fn dragged(&self, contact: &Contact, state: &State, by: f64) -> Memory {
        let (d, way) = (contact.natural.depth, by * contact.natural.displacement);
        let equations = Equations::on(self, state, self.layout());
        let u = equations.motion(contact, state.t, |i| state.y[i]).u;
        let mut memory = contact.engine.memory(&contact.interface, Apex { d, u: u - way });
        // If this is impossible, the memory stays in its initial state.
        let _ = memory.commit(&contact.interface, Segment::Straight(Apex { d, u }));
        memory
    }
}

impl Contact {
    /// Returns whether the contact's force can vary with the power 3/2 of time (singular moment): at a touch, or where gross slip begins.
    fn ends_singularly(&self) -> bool {
        !self.is_never_pressed() && (self.coupling().is_some() || !self.inert && self.engine.branches())
    }
}

/// Returns the first linear or curved piece of a waveform, as requested; the waveform's first piece if there is no such piece.
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
