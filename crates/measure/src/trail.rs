//! Path in a plane as a function of time.

/// Distance in x between start and end of a path, relative to the range of x, below which the path counts as closed.
const CLOSED: f64 = 0.01;

/// Path in order of time, such as force versus displacement of a contact, or velocity versus displacement of a body.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Trail {
    /// Times, s.
    pub t: Vec<f64>,
    /// Displacements, m.
    pub x: Vec<f64>,
    /// Second coordinate: forces or velocities.
    pub y: Vec<f64>,
}

impl Trail {
    /// Appends a point.
    pub fn push(&mut self, t: f64, x: f64, y: f64) {
        self.t.push(t);
        self.x.push(x);
        self.y.push(y);
    }

    /// Keeps only the first `length` points.
    pub fn cut(&mut self, length: usize) {
        self.t.truncate(length);
        self.x.truncate(length);
        self.y.truncate(length);
    }

    /// Returns the part of a time interval. Both ends are interpolated linearly.
    pub fn part(&self, (from, to): (f64, f64)) -> Self {
        let mut part = Self::default();
        let end = |time: f64, after: usize, part: &mut Self| {
            let Some(before) = after.checked_sub(1) else { return };
            if after < self.t.len() && self.t[after] > time && self.t[before] < time {
                let share = (time - self.t[before]) / (self.t[after] - self.t[before]);
                let at = |values: &[f64]| values[before] + share * (values[after] - values[before]);
                part.push(time, at(&self.x), at(&self.y));
            }
        };
        let first = self.t.partition_point(|&t| t < from);
        let last = self.t.partition_point(|&t| t <= to);
        end(from, first, &mut part);
        for i in first..last {
            part.push(self.t[i], self.x[i], self.y[i]);
        }
        end(to, last, &mut part);
        part
    }

    /// Returns the points of a time interval, both ends included, without interpolation.
    pub fn within(&self, [from, to]: [f64; 2]) -> Self {
        let mut points = Self::default();
        for ((&t, &x), &y) in self.t.iter().zip(&self.x).zip(&self.y) {
            if (from..=to).contains(&t) {
                points.push(t, x, y);
            }
        }
        points
    }

    /// Returns whether x at the end of the path is close to x at its start.
    pub fn is_closed(&self) -> bool {
        match (self.x.first(), self.x.last()) {
            (Some(first), Some(last)) => (last - first).abs() <= CLOSED * self.stroke(),
            _ => false,
        }
    }

    /// Returns the range of x, m, or 0 if the path has no points.
    pub fn stroke(&self) -> f64 {
        let (low, high) = self.x.iter().fold((f64::MAX, f64::MIN), |(l, h), &x| (l.min(x), h.max(x)));
        (high - low).max(0.0)
    }

    /// Returns the path with the first value of x subtracted from all x.
    pub fn counted_from_start(mut self) -> Self {
        let start = self.x.first().copied().unwrap_or(0.0);
        self.x.iter_mut().for_each(|x| *x -= start);
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_part_has_both_its_ends() {
        let line: Vec<f64> = (0..=10).map(f64::from).collect();
        let path = Trail { t: line.clone(), x: line.clone(), y: line };
        assert_eq!(path.part((2.5, 4.0)).x, [2.5, 3.0, 4.0]);
        assert_eq!(path.part((3.0, 4.25)).y, [3.0, 4.0, 4.25]);
        assert_eq!(path.part((-1.0, 20.0)).t.len(), 11);
        assert!(!path.is_closed());
        assert_eq!(path.part((2.0, 4.0)).counted_from_start().x, [0.0, 1.0, 2.0]);
        assert_eq!((path.part((2.0, 4.5)).stroke(), Trail::default().stroke()), (2.5, 0.0));
    }
}
