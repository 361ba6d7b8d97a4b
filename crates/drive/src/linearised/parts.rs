//! The linearised motions in parts that do not move each other.
//!
//! A row couples what it counts and nothing else: coordinates that no row joins have matrices of their own. Ten thousand sliders
//! are ten thousand matrices of one number and not one of 10⁸, whose eigenvalues would take days.

use super::{Indentations, Linearised, Row, add};
use crate::Model;
use crate::model::Terms;
use nalgebra::{DMatrix, DVector};

/// Up to so many free coordinates one matrix takes no time: it is not parted, for eigenvalues of parts have other last digits
/// than those of the whole, and so would the runs that take their shortest period from them.
// A ball free in the plane, parted into x with pitch and z, had other last digits from its first bounce on. A thousand
// coordinates together take a second, four thousand more than a minute.
const TOGETHER: usize = 64;

/// Which part each free coordinate belongs to, and its place there.
struct Division {
    places: Vec<(usize, usize)>,
    /// Coordinates of each part.
    members: Vec<Vec<usize>>,
}

impl Model {
    /// All motions about the state at t = 0 in one part, with the contacts as deep as said, m.
    pub(super) fn whole(&self, depth: impl Fn(usize) -> f64) -> Linearised {
        self.assemble(&Division::none(self.free.len()), depth).pop().unwrap_or_else(Linearised::nothing)
    }

    /// The same in parts that do not move each other, about the start and with the contacts as deep as `depth` picks.
    pub(super) fn parts(&self, depth: impl Fn(&Indentations) -> f64) -> Vec<Linearised> {
        let picked = |c: usize| {
            let start = self.indentation(&self.contacts[c]);
            self.indentations_from(start, c).map_or(0.0, |d| depth(&d))
        };
        let few = self.free.len() <= TOGETHER;
        self.assemble(&if few { Division::none(self.free.len()) } else { self.divide() }, picked)
    }

    /// Joins what a row of a link, or of a contact that holds along it, counts together.
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
            // The head is the first of its part.
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
                parts.get_mut(place).into_iter().for_each(|part| add(&mut part.stiffness, &row, stiffness));
            }
        }
        parts
    }
}

impl Division {
    /// All coordinates in one part.
    fn none(free: usize) -> Self {
        Self { places: (0..free).map(|i| (0, i)).collect(), members: vec![(0..free).collect()] }
    }

    /// The part that a row counts in, and the row in places of that part; the first part for one that counts nothing.
    fn row(&self, terms: &Terms) -> (usize, Row) {
        let part = terms.first().map_or(0, |(i, _)| self.places[*i].0);
        (part, terms.iter().map(|(i, a)| (self.places[*i].1, *a)).collect())
    }
}

impl Linearised {
    /// No motion at all.
    fn nothing() -> Self {
        let (mass, damping) = (DVector::zeros(0), DMatrix::zeros(0, 0));
        Self { coordinates: Vec::new(), contacts: Vec::new(), mass, stiffness: damping.clone(), damping }
    }
}

/// The first coordinate of the part that one belongs to; on the way all that are asked learn it.
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
