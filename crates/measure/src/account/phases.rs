//! Directions of a waveform: the intervals of a period in which it rises, falls or is constant.

use stickslip_drive::{Piece, Waveform};

/// Number of parts into which a smooth piece of a waveform is divided in the search for turning points.
const PARTS: usize = 64;
/// Number of parts for a piece that covers more than half of the period.
const PARTS_OF_ALL: usize = 2048;
/// Maximum numbers of pieces and turning points of a period.
const MOST_PIECES: usize = 4096;
const MOST_TURNS: usize = 16;
/// Time difference below which two times are equal, in periods.
const SAME: f64 = 1e-9;
/// Number of bisections that locate a sign change of the rate of the waveform to full precision.
const HALVINGS: u32 = 64;

/// Direction of a waveform.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sense {
    /// The value increases.
    Rising,
    /// The value decreases.
    Falling,
    /// The value is constant.
    Resting,
}

/// Directions of a waveform in the intervals of its period.
#[derive(Debug, Clone, PartialEq)]
pub struct Phases {
    /// Start of the analysed period and length of the period, s.
    start: f64,
    length: f64,
    /// Intervals of constant direction, in order: start, s after the start of the period, and direction of the waveform.
    stretches: Vec<(f64, Sense)>,
    /// Total rise and total fall of the waveform in a period, in its unit.
    ways: [f64; 2],
}

impl Sense {
    fn of(rate: f64) -> Self {
        if rate > 0.0 {
            Self::Rising
        } else if rate < 0.0 {
            Self::Falling
        } else {
            Self::Resting
        }
    }
}

impl Phases {
    /// Returns the directions of a waveform in its second period, or in its first period if the waveform stops earlier.
    ///
    /// The second period is used because a delayed flyback may be missing in the first period. Returns `None` if the waveform is not
    /// periodic or has more than 16 turning points per period.
    pub fn of(waveform: &Waveform) -> Option<Self> {
        let (length, delay) = (waveform.period()?, waveform.timing().delay);
        let is_repeated = waveform.window().1 >= delay + 2.0 * length;
        let start = if is_repeated { delay + length } else { delay };
        let mut phases = Self { start, length, stretches: Vec::new(), ways: [0.0; 2] };
        let end = start + length;
        let mut piece = waveform.piece_at(start);
        for _ in 0..MOST_PIECES {
            let until = piece.end.min(end);
            let from = piece.start.max(start);
            // A piece with more waves than this has more turning points than allowed.
            if (until - from) > MOST_TURNS as f64 * 4.0 * waveform.resolution() {
                return None;
            }
            phases.take(waveform, &piece, [from, until]);
            // The end times of pieces have rounding errors.
            if until >= end - SAME * length {
                let enough = phases.stretches.len() <= MOST_TURNS;
                return enough.then_some(phases);
            }
            phases.leap(waveform.jump_after(&piece));
            piece = waveform.after(&piece);
        }
        None
    }

    /// Adds the directions and changes of a piece of the waveform between two times, s.
    fn take(&mut self, waveform: &Waveform, piece: &Piece, [from, to]: [f64; 2]) {
        let is_all = to - from > 0.5 * self.length;
        let parts = if is_all { PARTS_OF_ALL } else { PARTS };
        let at = |t: f64| waveform.sample(piece, t);
        let (mut before, mut told) = (from, from);
        for i in 1..=parts {
            let t = if i == parts { to } else { from + (to - from) * (i as f64 / parts as f64) };
            // The direction is taken at the middle, because the ends of a part may be turning points.
            let sense = Sense::of(at(0.5 * (before + t)).rate);
            if self.stretches.last().is_none_or(|(_, last)| *last != sense) {
                let turn = self.turn(|t| at(t).rate, [before, t], [from, to], sense);
                self.stretches.push((turn - self.start, sense));
                self.leap(at(turn).value - at(told).value);
                told = turn;
            }
            before = t;
        }
        self.leap(at(to).value - at(told).value);
    }

    /// Returns the turning point at which the direction becomes `sense`, by bisection, s.
    ///
    /// The direction differs between the middle of `part` and the middle of the part before it.
    fn turn(&self, rate: impl Fn(f64) -> f64, part: [f64; 2], whole: [f64; 2], sense: Sense) -> f64 {
        let width = part[1] - part[0];
        let (mut low, mut high) = (part[0] - 0.5 * width, part[0] + 0.5 * width);
        if self.stretches.is_empty() || low < whole[0] {
            return part[0];
        }
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            let side = if Sense::of(rate(middle)) == sense { &mut high } else { &mut low };
            *side = middle;
        }
        high
    }

    /// Adds a change of the value to the total rise or fall.
    fn leap(&mut self, way: f64) {
        let [rise, fall] = &mut self.ways;
        if way > 0.0 { *rise += way } else { *fall -= way }
    }

    /// Returns the direction just after time t, s, and the time until which it is valid, s, slightly before the next turning point.
    pub fn sense_after(&self, t: f64) -> (Sense, f64) {
        let (within, same) = ((t - self.start).rem_euclid(self.length), SAME * self.length);
        // Times close to the end of a period belong to the next period.
        let within = if self.length - within <= same { 0.0 } else { within };
        let after = self.stretches.partition_point(|(begin, _)| *begin <= within + same);
        let sense = after.checked_sub(1).and_then(|k| self.stretches.get(k));
        let turn = self.stretches.get(after).map_or(self.length, |(begin, _)| *begin);
        (sense.map_or(Sense::Resting, |(_, sense)| *sense), t + (turn - within) - 2.0 * same)
    }

    /// Iterates over the turning points of a period, s after its start, without the start itself.
    pub fn turns(&self) -> impl Iterator<Item = f64> {
        self.stretches.iter().skip(1).map(|(begin, _)| *begin)
    }

    /// Returns the total rise and the total fall in a period, in the unit of the waveform.
    pub fn ways(&self) -> [f64; 2] {
        self.ways
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;
    use stickslip_drive::{Harmonic, Shape, Timing};

    fn phases(shape: Shape, timing: Timing) -> Phases {
        Phases::of(&Waveform::new(shape, timing).unwrap()).unwrap()
    }

    #[test]
    fn a_sawtooth_rises_and_flies_back() {
        let shape = Shape::Sawtooth { stroke: 2e-7, flyback: 1e-5 };
        let phases = phases(shape, Timing { delay: 0.5, ..Timing::every(1e-2) });
        assert_eq!(
            phases.stretches.iter().map(|it| it.1).collect::<Vec<_>>(),
            [Sense::Rising, Sense::Falling]
        );
        assert_relative_eq!(phases.turns().next().unwrap(), 9.99e-3, max_relative = 1e-12);
        assert_relative_eq!(phases.ways()[0], 2e-7, max_relative = 1e-12);
        assert_relative_eq!(phases.ways()[1], 2e-7, max_relative = 1e-12);
        // In the seventh period; the next one starts at its end.
        let at = |within: f64| phases.sense_after(0.5 + 7.0 * 1e-2 + within).0;
        assert_eq!(
            [at(0.0), at(9.9e-3), at(9.995e-3), at(1e-2)],
            [Sense::Rising, Sense::Rising, Sense::Falling, Sense::Rising]
        );
    }

    #[test]
    fn sines_turn_where_their_rate_vanishes() {
        // x = sin ωt + ¼ sin 2ωt: the rate ω(cos φ + ½ cos 2φ) vanishes where 2c² + 2c - 1 = 0... with c = cos φ = (√3 - 1)/2.
        let term = |amplitude, order| Harmonic { amplitude, order, phase: 0.0 };
        let shape = Shape::Harmonics { terms: vec![term(1.0, 1.0), term(0.25, 2.0)] };
        let phases = phases(shape, Timing::every(2.0));
        let turn = ((3.0_f64.sqrt() - 1.0) / 2.0).acos() / std::f64::consts::PI;
        let turns: Vec<f64> = phases.turns().collect();
        assert_eq!(turns.len(), 2);
        assert_relative_eq!(turns[0], turn, max_relative = 1e-12);
        assert_relative_eq!(turns[1], 2.0 - turn, max_relative = 1e-12);
        let peak = |phi: f64| phi.sin() + 0.25 * (2.0 * phi).sin();
        let way = 2.0 * peak(turn * std::f64::consts::PI);
        assert_relative_eq!(phases.ways()[0], way, max_relative = 1e-9);
        assert_relative_eq!(phases.ways()[1], way, max_relative = 1e-9);
    }
}
