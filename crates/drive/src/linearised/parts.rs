//! Linearised equations of motion by independent subsystems.
//!
//! Subsystems that no contact or spring connects have separate matrices. A model of many independent sliders then needs many small matrices
//! instead of a large one.

use super::{Indentations, Linearised, Row, add};
use crate::Model;
use crate::model::Terms;
use nalgebra::{DMatrix, DVector};

/// Number of free coordinates up to which the whole model has one matrix.
// Eigenvalues of subsystems differ in the last bit, and so would runs of small models.
const TOGETHER: usize = 64;

/// Subsystem of each free coordinate, and the coordinate's index there.
struct Division {
    places: Vec<(usize, usize)>,
    /// Coordinates of each subsystem.
    members: Vec<Vec<usize>>,
}

impl Model {
    /// Returns the linearised equations of the whole model at t = 0 in one matrix, with given indentations of the contacts, m.
    pub(super) fn whole(&self, depth: impl Fn(usize) -> f64) -> Linearised {
        self.assemble(&Division::none(self.free.len()), depth).pop().unwrap_or_else(Linearised::nothing)
    }

    /// Returns the linearised equations of each subsystem at the start, with the indentations (m) that `depth` selects.
    pub(super) fn parts(&self, depth: impl Fn(&Indentations) -> f64) -> Vec<Linearised> {
        let picked = |c: usize| {
            let start = self.indentation(&self.contacts[c]);
            self.indentations_from(start, c).map_or(0.0, |d| depth(&d))
        };
        let few = self.free.len() <= TOGETHER;
        self.assemble(&if few { Division::none(self.free.len()) } else { self.divide() }, picked)
    }

    /// Groups the coordinates that springs or contacts connect.
    fn divide(&self) -> Division {
        let mut heads: Vec<usize> = (0..self.free.len()).collect();
        let links = self.links.iter().map(|link| &link.elongation);
        let along = self.contacts.iter().map(|contact| &contact.u);
        let normal = self.contacts.iter().filter_map(|contact| contact.coupling());
        for row in links.chain(along).chain(normal) {
            for pair in row.free.windows(2) {
                let [a, b] = [pair[0].0, pair[1].0].map(|i| head(&mut heads, i));
                heads[a.max(b)] = a.min(b);
            }
        }
        let mut members: Vec<Vec<usize>> = Vec::new();
        let mut places: Vec<(usize, usize)> = Vec::with_capacity(heads.len());
        for i in 0..heads.len() {
            // The first coordinate represents its subsystem.
            let part = match head(&mut heads, i) {
                own if own == i => {
                    members.push(Vec::new());
                    members.len() - 1
                }
                own => places[own].0,
            };
            places.push((part, members[part].len()));
            members[part].push(i);
        }
        Division { places, members }
    }

    fn assemble(&self, division: &Division, depth: impl Fn(usize) -> f64) -> Vec<Linearised> {
        let name =
            |i: &usize| format!("{}.{}", self.bodies[self.free[*i].body].name, self.free[*i].axis.key());
        let part = |members: &Vec<usize>| {
            let n = members.len();
            Linearised {
                coordinates: members.iter().map(name).collect(),
                contacts: Vec::new(),
                mass: DVector::from_iterator(n, members.iter().map(|i| self.free[*i].mass)),
                damping: DMatrix::zeros(n, n),
                stiffness: DMatrix::zeros(n, n),
            }
        };
        let mut parts: Vec<Linearised> = division.members.iter().map(part).collect();
        for link in &self.links {
            let (part, row) = division.row(&link.elongation.free);
            let Some(part) = parts.get_mut(part) else { continue };
            add(&mut part.stiffness, &row, link.stiffness);
            add(&mut part.damping, &row, link.damping);
        }
        for (c, contact) in self.contacts.iter().enumerate() {
            let d = depth(c);
            let (place, row) = division.row(&contact.u.free);
            let Some(part) = parts.get_mut(place) else { continue };
            if !contact.inert {
                let stiffness = contact.count * contact.interface.stick_stiffness(d);
                add(&mut part.stiffness, &row, stiffness);
                add(&mut part.damping, &row, contact.interface.viscosity(stiffness));
            }
            part.contacts.push(row);
            if let Some(normal) = contact.coupling() {
                let (place, row) = division.row(&normal.free);
                let stiffness = contact.count * contact.interface.normal_stiffness(d);
                if let Some(part) = parts.get_mut(place) {
                    add(&mut part.stiffness, &row, stiffness);
                    add(&mut part.damping, &row, contact.normal_damping * stiffness);
                }
            }
        }
        parts
    }
}

impl Division {
    /// Returns a division into one subsystem with all coordinates.
    fn none(free: usize) -> Self {
        Self { places: (0..free).map(|i| (0, i)).collect(), members: vec![(0..free).collect()] }
    }

    /// Returns the subsystem of a linear form, and the form with the indices of that subsystem; the first subsystem for an empty form.
    fn row(&self, terms: &Terms) -> (usize, Row) {
        let part = terms.first().map_or(0, |(i, _)| self.places[*i].0);
        (part, terms.iter().map(|(i, a)| (self.places[*i].1, *a)).collect())
    }
}

impl Linearised {
    /// Returns a system without coordinates.
    fn nothing() -> Self {
        let (mass, damping) = (DVector::zeros(0), DMatrix::zeros(0, 0));
        Self { coordinates: Vec::new(), contacts: Vec::new(), mass, stiffness: damping.clone(), damping }
    }
}

/// Returns the first coordinate of the subsystem of coordinate `i` (union–find with path compression).
fn head(heads: &mut [usize], i: usize) -> usize {
    let mut top = i;
    while heads[top] != top {
        top = heads[top];
    }
    let mut next = i;
    while heads[next] != top {
        next = std::mem::replace(&mut heads[next], top);
    }
    top
}
