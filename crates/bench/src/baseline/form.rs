//! Relative displacements as linear forms of free and prescribed coordinates.

use stickslip_drive::Scene;
use stickslip_drive::scene::{Axis, Contact, Direction, Freedom, Side};

/// Linear form: constant + Σ free · coordinate + Σ driven · prescribed quantity, m.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Form {
    pub(super) constant: f64,
    /// Coefficients of the free coordinates.
    pub(super) free: Vec<f64>,
    /// Prescribed quantities with their coefficients.
    pub(super) driven: Vec<(usize, f64)>,
}

impl Form {
    /// Returns the displacement of a contact's first body relative to its second, at the contact point along a direction. `places` are
    /// the free coordinates. A point at (X, Z) moves by x - Zθ and z + Xθ.
    pub(super) fn new(
        scene: &Scene,
        places: &[(usize, Axis)],
        contact: &Contact,
        direction: Direction,
    ) -> Self {
        let mut form = Self { constant: 0.0, free: vec![0.0; places.len()], driven: Vec::new() };
        for ((side, at), sign) in contact.between.into_iter().zip(contact.at).zip([1.0, -1.0]) {
            let Side::Body(body) = side else { continue };
            let (axis, arm) = match direction {
                Direction::X => (Axis::X, -at.z),
                Direction::Z => (Axis::Z, at.x),
            };
            form.add(scene, places, (body, axis), sign);
            form.add(scene, places, (body, Axis::Pitch), sign * arm);
        }
        form
    }

    /// Returns a form that follows one prescribed quantity.
    pub(super) fn follow(track: usize, free: usize) -> Self {
        Self { constant: 0.0, free: vec![0.0; free], driven: vec![(track, 1.0)] }
    }

    /// Subtracts a length, m.
    pub(super) fn less(mut self, length: f64) -> Self {
        self.constant -= length;
        self
    }

    fn add(&mut self, scene: &Scene, places: &[(usize, Axis)], (body, axis): (usize, Axis), factor: f64) {
        let coordinates = scene.bodies[body].part.coordinates();
        let Some((_, coordinate)) = coordinates.into_iter().find(|(own, _)| *own == axis) else { return };
        match coordinate.freedom {
            Freedom::Fixed => self.constant += factor * coordinate.position,
            // Models with balanced coordinates have no free ones and are not benchmarked.
            Freedom::Balanced => {}
            Freedom::Follows(waveform) => self.driven.push((waveform, factor)),
            Freedom::Free => {
                if let Some(place) = places.iter().position(|place| *place == (body, axis)) {
                    self.free[place] += factor;
                }
            }
        }
    }
}
