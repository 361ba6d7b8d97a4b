//! The linear equations of a variation.

use super::anchors::{Cut, Held};
use super::parameter::{Moment, Moving, Parameter, edge};
use super::steps::Passed;
use crate::Model;
use crate::contact::{Contact, Mode, Motion};
use crate::equations::{self, Equations};
use crate::model::Measure;
use crate::state::Layout;
use stickslip_contact::Memory;
use stickslip_stepper::{Coefficients, Components, System};

/// How the force of one contact changes at a moment.
#[derive(Debug, Clone, Copy, Default)]
struct Stiffness {
    /// ∂F_x/∂u and ∂F_x/∂d, N/m.
    along: f64,
    across: f64,
    /// ∂F_N/∂d where the bodies press it, N/m.
    normal: f64,
    /// Height below which springs stick, m.
    front: f64,
}

/// Where a contact stands at a moment, as all numbers find it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Stand {
    pub(super) motion: Motion,
    stiffness: Stiffness,
    /// G\*m(d), N/m.
    whole: f64,
    /// F_x where it slips and numbers of the scene ask for it, N.
    pub(super) force: f64,
}

/// How the forces of a contact answer to its bodies, and to what it holds.
pub(super) struct Response<'a> {
    contact: &'a Contact,
    stiffness: Stiffness,
    /// Place of F_x where it is a state.
    slot: Option<usize>,
    held: &'a Held,
    cut: Option<Cut>,
}

/// (δu, δd) of a contact by each number, from the derivatives of the components.
pub(super) fn moved(contact: &Contact, columns: &[f64], layout: Layout) -> Vec<(f64, f64)> {
    let of = |measure: &Measure, column: &[f64]| measure.free.iter().map(|(i, a)| a * column[*i]).sum();
    let each = columns.chunks_exact(layout.dimension());
    each.map(|column| (of(&contact.u, column), contact.coupling().map_or(0.0, |d| of(d, column)))).collect()
}

/// Whether a contact in a mode acts on derivatives: in gross slip at a given depth its force is what it is, unless numbers of the
/// scene `move` it.
pub(super) fn acts(contact: &Contact, mode: &Mode, moves: bool) -> bool {
    match mode {
        Mode::Open => false,
        _ if contact.coupling().is_some() => true,
        Mode::Slip(branch) => (moves || !branch.is_gross()) && !contact.inert,
        Mode::Grow => true,
        Mode::Whole { .. } | Mode::Lull { .. } => false,
    }
}

/// What springs, dampers and actuators make of places and velocities: accelerations, row by row.
pub(super) fn links(model: &Model) -> Vec<f64> {
    let free = model.free.len();
    let mut matrix = vec![0.0; 2 * free * free];
    for link in &model.links {
        for (i, a) in &link.elongation.free {
            let row = &mut matrix[2 * free * i..2 * free * (i + 1)];
            let share = -model.free[*i].mobility * a;
            for (k, b) in &link.elongation.free {
                row[*k] += share * b * link.stiffness;
                row[free + k] += share * b * link.damping;
            }
        }
    }
    matrix
}

impl Stiffness {
    /// Of a contact by its law.
    fn of(contact: &Contact, (memory, mode): (&Memory, &Mode), motion: &Motion) -> Self {
        let law = &contact.interface;
        let normal = match mode {
            Mode::Open => 0.0,
            _ if contact.coupling().is_none() => 0.0,
            _ => law.normal_stiffness(motion.d),
        };
        match mode {
            Mode::Slip(branch) => {
                let front = if branch.is_gross() { 0.0 } else { contact.front(memory, branch, motion) };
                let along = law.stick_stiffness(front);
                let across = match contact.coupling() {
                    Some(_) => branch.sense() * law.stick_slope() * (law.stick_stiffness(motion.d) - along),
                    None => 0.0,
                };
                Self { along, across, normal, front }
            }
            Mode::Open | Mode::Grow | Mode::Whole { .. } | Mode::Lull { .. } => {
                Self { normal, ..Self::default() }
            }
        }
    }
}

impl Response<'_> {
    /// Adds so many times what F_x of one contact makes of places and velocities to a row of the equations.
    pub(super) fn pull(&self, times: f64, row: &mut [f64]) {
        match self.slot {
            Some(slot) => row[slot] += times,
            None => {
                let Stiffness { along, across, .. } = self.stiffness;
                self.contact.u.free.iter().for_each(|(k, b)| row[*k] += times * along * b);
                self.depth().for_each(|(k, b)| row[*k] += times * across * b);
            }
        }
    }

    /// Adds so many times what it is by anchors that are moved, by each number.
    pub(super) fn hold(&self, times: f64, row: Option<&mut [f64]>) {
        if let (Some(cut), Some(row)) = (&self.cut, row) {
            let pull = times * self.contact.interface.tangential_modulus();
            row.iter_mut().enumerate().for_each(|(j, x)| *x -= pull * self.held.sum(cut, j));
        }
    }

    /// Adds so many times what F_N makes of places to a row.
    pub(super) fn press(&self, times: f64, row: &mut [f64]) {
        let press = times * self.stiffness.normal;
        self.depth().for_each(|(k, b)| row[*k] += press * b);
    }

    fn depth(&self) -> impl Iterator<Item = &(usize, f64)> {
        self.contact.coupling().into_iter().flat_map(|d| &d.free)
    }
}

/// m'(d): the contact length grows by twice what the radius does, dg/da = 1/a'.
fn swelling(contact: &Contact, d: f64) -> f64 {
    let profile = contact.interface.profile();
    let slope = profile.depth_slope(profile.radius(d));
    if slope > 0.0 && slope.is_finite() { 2.0 / slope } else { 0.0 }
}

/// The linear equations of an interval.
pub(super) struct Laws<'a> {
    pub(super) eq: Equations<'a>,
    /// What each contact holds, and those that act.
    pub(super) held: &'a [Held],
    pub(super) acting: &'a [usize],
    /// What [`links`] make.
    pub(super) links: &'a [f64],
    pub(super) components: Components,
    /// How many numbers, and those of the scene, which are the last of them.
    pub(super) count: usize,
    pub(super) parameters: &'a [Parameter],
    /// How these move waveforms.
    pub(super) moving: &'a [Moving],
    pub(super) shifts: &'a [f64],
}

impl Laws<'_> {
    /// The equations at a time, s, and where the motion is then; and where each contact that acts stands.
    pub(super) fn lay_out(&self, (t, y): (f64, &[f64]), node: &mut Coefficients, stands: &mut Vec<Stand>) {
        let Components { positions, rates, .. } = self.components;
        let wide = positions + rates;
        node.matrix.clear();
        node.matrix.resize(rates * wide, 0.0);
        if !self.eq.model.links.is_empty() {
            let rows = node.matrix.chunks_exact_mut(wide).zip(self.links.chunks_exact(2 * positions));
            rows.for_each(|(row, links)| row[..2 * positions].copy_from_slice(links));
        }
        node.forcing.clear();
        stands.clear();
        for c in self.acting {
            let contact = &self.eq.model.contacts[*c];
            let stand = self.stand(contact, self.eq.motion(contact, t, |i| y[i]), self.is_touched(*c));
            self.act(contact, &stand, node);
            if let (Some(slot), Mode::Grow) = (contact.slot, self.eq.law(*c).1) {
                self.grow((contact, slot), &stand.motion, &mut node.matrix);
            }
            stands.push(stand);
        }
    }

    /// Adds what numbers of the scene make of the equations where the motion has passed a node.
    pub(super) fn move_by_numbers(&self, passed: &mut Passed, node: &mut Coefficients) {
        node.forcing.resize(self.components.rates * self.count, 0.0);
        let eq = &self.eq;
        if self.parameters.iter().any(Parameter::weighs) {
            passed.slopes.resize(eq.layout.total(), 0.0);
            eq.slopes(passed.t, &passed.y, &mut passed.slopes);
        }
        let (now, t, y, slopes) = (self.moment(passed), passed.t, &passed.y[..], &passed.slopes[..]);
        for (place, (j, parameter)) in self.numbers().enumerate() {
            self.move_by(parameter, (now.by(place), (t, y), slopes), (j, &mut node.forcing));
        }
        for (c, stand) in self.acting.iter().zip(&passed.stands) {
            if self.is_touched(*c) {
                self.move_contact(&eq.model.contacts[*c], (now, stand), &mut node.forcing);
            }
        }
    }

    /// The moment of a node, as waveforms have it.
    pub(super) fn moment<'p>(&'p self, passed: &'p Passed) -> Moment<'p> {
        let Equations { model, pieces, .. } = self.eq;
        Moment { model, pieces, t: passed.now, y: &passed.y, shifts: self.shifts, moving: self.moving }
    }

    /// Whether numbers of the scene move the force of a contact.
    fn is_touched(&self, c: usize) -> bool {
        self.parameters.iter().any(|parameter| parameter.touches(c))
    }

    /// Numbers of the scene, with their columns.
    pub(super) fn numbers(&self) -> impl Iterator<Item = (usize, &Parameter)> {
        (self.count - self.parameters.len()..).zip(self.parameters)
    }

    /// What a number of the scene makes of the rates of column `j` where all stands as it does, but by contacts; `slopes` where a mass
    /// moves.
    fn move_by(
        &self,
        parameter: &Parameter,
        (now, (t, y), slopes): (Moment<'_>, (f64, &[f64]), &[f64]),
        (j, forcing): (usize, &mut [f64]),
    ) {
        let (eq, model) = (&self.eq, self.eq.model);
        let at = equations::Components { t, y: |i: usize| y[i] };
        let mut add = |row: usize, rate: f64| forcing[row * self.count + j] += rate;
        for (i, free) in model.free.iter().enumerate() {
            let [force, mobility] = parameter.coordinate(i);
            add(i, free.mobility * force);
            if mobility != 0.0 {
                add(i, mobility * slopes[eq.layout.velocity(i)]);
            }
        }
        for (l, link) in model.links.iter().enumerate() {
            let (length, stroke) = (eq.read(&link.elongation, &at), eq.stroke(link, &at));
            let stretch = [stroke.value - length.value, stroke.rate - length.rate];
            let force = parameter.link(model, l, stretch, now);
            link.elongation.free.iter().for_each(|(i, a)| add(*i, model.free[*i].mobility * a * force));
            let pull = link.stiffness * stretch[0] + link.damping * stretch[1] + link.preload;
            let levers = &parameter.link_rates(l).levers.free;
            levers.iter().for_each(|(i, longer)| add(*i, model.free[*i].mobility * longer * pull));
        }
        for (l, load) in model.loads.iter().enumerate() {
            let value = eq.sample(load.waveform, t).value;
            add(load.free, model.free[load.free].mobility * parameter.load(model, l, value, now));
        }
    }

    /// What all numbers of the scene make of the rates by way of one contact.
    fn move_contact(&self, contact: &Contact, (now, stand): (Moment<'_>, &Stand), forcing: &mut [f64]) {
        let (model, numbers) = (self.eq.model, self.numbers().enumerate());
        for (place, (j, parameter)) in numbers.filter(|(_, (_, it))| it.touches(contact.place)) {
            let mut add = |row: usize, rate: f64| forcing[row * self.count + j] += rate;
            let [along, across] = self.pulls(contact, parameter, (now.by(place), stand), &mut add);
            let terms = contact.u.free.iter().map(|(i, a)| (*i, a * along));
            let depth = contact.coupling().into_iter().flat_map(|d| &d.free);
            let levers = parameter.levers(contact.place).into_iter().zip(self.forces(contact, stand, now.y));
            let levers = levers.flat_map(|(levers, force)| levers.iter().map(move |(i, a)| (*i, a * force)));
            terms
                .chain(depth.map(|(i, a)| (*i, a * across)))
                .chain(levers)
                .for_each(|(i, force)| add(i, -model.free[i].mobility * contact.count * force));
        }
    }

    /// Where a contact stands, with its force where that is asked for.
    pub(super) fn stand(&self, contact: &Contact, motion: Motion, with_force: bool) -> Stand {
        let law = self.eq.law(contact.place);
        let force = match law.1 {
            Mode::Slip(_) if with_force && !contact.inert => contact.force(law, &motion, || 0.0),
            _ => 0.0,
        };
        let stiffness = Stiffness::of(contact, law, &motion);
        Stand { stiffness, whole: contact.interface.stick_stiffness(motion.d), force, motion }
    }

    /// F_x and F_N of one contact where it stands, N, the latter where its bodies press it.
    pub(super) fn forces(&self, contact: &Contact, stand: &Stand, y: &[f64]) -> [f64; 2] {
        let mode = self.eq.law(contact.place).1;
        let growing = contact.slot.filter(|_| *mode == Mode::Grow);
        let press = match mode {
            Mode::Open => 0.0,
            _ if contact.coupling().is_none() => 0.0,
            _ => contact.interface.normal_force(stand.motion.d),
        };
        [growing.map_or(stand.force, |slot| y[self.eq.layout.force(slot)]), press]
    }

    /// How F_x and F_N of one contact change by a number of the scene, N; of one that grows F_x is a state, whose rate does.
    pub(super) fn pulls(
        &self,
        contact: &Contact,
        parameter: &Parameter,
        (now, stand): (Moment<'_>, &Stand),
        add: &mut impl FnMut(usize, f64),
    ) -> [f64; 2] {
        let (law, shift) = (self.eq.law(contact.place), parameter.shift(contact, now));
        let Stand { motion, whole, force, .. } = stand;
        let Stiffness { along, normal, front, .. } = stand.stiffness;
        let across = match contact.coupling() {
            Some(_) => normal * shift.d + parameter.press(contact, motion.d),
            None => 0.0,
        };
        match (law.1, contact.slot) {
            (Mode::Slip(branch), _) if !contact.inert => {
                let at = edge(contact, branch.sense(), front, motion);
                let moved = along * shift.u + at[2] * (whole - along) * shift.d;
                [moved + parameter.pull(contact, law.0, *force, at), across]
            }
            (Mode::Grow, Some(slot)) => {
                let swell = contact.interface.tangential_modulus() * swelling(contact, motion.d);
                let stiffer = parameter.stick_stiffness(contact, motion.d) + swell * shift.d;
                let row = self.eq.layout.force(slot) - self.components.positions;
                add(row, stiffer * motion.du + whole * shift.du);
                [0.0, across]
            }
            _ => [0.0, across],
        }
    }

    /// How a contact answers at a moment.
    pub(super) fn response<'c>(&'c self, contact: &'c Contact, stand: &Stand) -> Response<'c> {
        let (law, stiffness) = (self.eq.law(contact.place), stand.stiffness);
        let held = &self.held[contact.place];
        let slot = contact.slot.filter(|_| *law.1 == Mode::Grow).map(|slot| self.eq.layout.force(slot));
        let cut = held.at(contact.interface.profile(), stiffness.front);
        Response { contact, stiffness, slot, held, cut }
    }

    /// Adds what a contact does to each number's accelerations.
    fn act(&self, contact: &Contact, stand: &Stand, node: &mut Coefficients) {
        let response = self.response(contact, stand);
        let wide = self.components.positions + self.components.rates;
        if response.cut.is_some() && node.forcing.is_empty() {
            node.forcing.resize(self.components.rates * self.count, 0.0);
        }
        let Coefficients { matrix, forcing } = node;
        let share = |(i, a): &(usize, f64)| -self.eq.model.free[*i].mobility * a * contact.count;
        for term in &contact.u.free {
            let i = term.0;
            response.pull(share(term), &mut matrix[i * wide..(i + 1) * wide]);
            response.hold(share(term), forcing.get_mut(i * self.count..(i + 1) * self.count));
        }
        for term in contact.coupling().into_iter().flat_map(|d| &d.free) {
            response.press(share(term), &mut matrix[term.0 * wide..(term.0 + 1) * wide]);
        }
    }

    /// How the force of a growing contact changes.
    fn grow(&self, (contact, slot): (&Contact, usize), motion: &Motion, matrix: &mut [f64]) {
        let Components { positions, rates, .. } = self.components;
        let (wide, layout, law) = (positions + rates, self.eq.layout, &contact.interface);
        let from = (layout.force(slot) - positions) * wide;
        let row = &mut matrix[from..from + wide];
        let stiffness = law.stick_stiffness(motion.d);
        contact.u.free.iter().for_each(|(k, b)| row[layout.velocity(*k)] += stiffness * b);
        let swell = law.tangential_modulus() * swelling(contact, motion.d) * motion.du;
        let across = contact.coupling().map_or(&[][..], |d| &d.free);
        across.iter().for_each(|(k, b)| row[*k] += swell * b);
    }
}
