//! The Prandtl–Ishlinskii law: a sum of play operators.

/// y = w₀ v + Σ wᵢ pᵢ, where pᵢ is dragged by the input v as by a pin in a slot of half width rᵢ: |v - pᵢ| ≤ rᵢ always, and pᵢ
/// moves only when it must.
///
/// Between two reversals the input takes up one play after the other, in the order of their thresholds, and y is a straight
/// line in v with the slope w₀ + Σ wᵢ over those taken up. The state is the list of pᵢ. Started from the untouched state
/// pᵢ = 0, y follows the initial curve φ(v) = w₀ v + Σ wᵢ max(v - rᵢ, 0); from a reversal at v₁ on, it goes by 2φ(|v - v₁|/2)
/// (Masing). Equal minor loops are equal wherever they lie (congruency), and a loop that is left is forgotten (wiping out).
///
/// Thresholds have the unit of the input, weights that of the output over it.
///
/// Source: A. Visintin, *Differential Models of Hysteresis* (1994), chapter III; K. Kuhnen, European Journal of Control 9 (2003)
/// 407, for piezo stacks and the inverse.
#[derive(Debug, Clone, PartialEq)]
pub struct Plays {
    /// r, ascending, all above 0.
    thresholds: Vec<f64>,
    weights: Vec<f64>,
    /// Slope with the first i plays taken up: w₀ + w₁ + … + wᵢ.
    slopes: Vec<f64>,
    /// w₁r₁ + … + wᵢrᵢ.
    backs: Vec<f64>,
}

/// Why a law cannot be.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum PlaysError {
    /// As many thresholds as weights.
    #[error("expected a weight for each of {thresholds} thresholds, got {weights}")]
    Lengths {
        /// Of them.
        thresholds: usize,
        /// Of those.
        weights: usize,
    },
    /// Thresholds ascend from above 0.
    #[error("expected thresholds that ascend from above 0, got {value} at place {place}")]
    Threshold {
        /// Counted from 0.
        place: usize,
        /// As given.
        value: f64,
    },
    /// A slope with some plays taken up is not above 0.
    #[error(
        "expected weights whose sums, one after the other, stay above 0, got {slope} with the first {taken_up} plays"
    )]
    Slope {
        /// How many plays are taken up.
        taken_up: usize,
        /// w₀ + w₁ + …
        slope: f64,
    },
    /// A loop that no rule makes.
    #[error("expected a loop wider than 0 and narrower than half of the stroke, got {0} of it")]
    Width(f64),
    /// Operators out of range.
    #[error("expected 1 to {most} operators, got {0}", most = Plays::MOST)]
    Count(usize),
    /// A stroke that is none.
    #[error("expected a stroke above 0, got {0}")]
    Stroke(f64),
}

impl Plays {
    /// Most operators: each is an event on each way.
    pub const MOST: usize = 64;

    /// With the weight w₀ of the input itself, and (rᵢ, wᵢ).
    ///
    /// # Errors
    ///
    /// Where there are more than [`Plays::MOST`] thresholds or these do not ascend from above 0, or where the slope is not above
    /// 0 with any number of plays taken up: the law would not be monotone, and have no inverse.
    pub fn new(direct: f64, thresholds: Vec<f64>, weights: Vec<f64>) -> Result<Self, PlaysError> {
        if thresholds.len() != weights.len() {
            return Err(PlaysError::Lengths { thresholds: thresholds.len(), weights: weights.len() });
        }
        if thresholds.len() > Self::MOST {
            return Err(PlaysError::Count(thresholds.len()));
        }
        let mut last = 0.0;
        for (place, &value) in thresholds.iter().enumerate() {
            if !(value > last && value < f64::INFINITY) {
                return Err(PlaysError::Threshold { place, value });
            }
            last = value;
        }
        let (mut slopes, mut backs) = (vec![direct], vec![0.0]);
        for (i, (r, w)) in thresholds.iter().zip(&weights).enumerate() {
            slopes.push(slopes[i] + w);
            backs.push(backs[i] + w * r);
        }
        match slopes.iter().position(|slope| !(*slope > 0.0 && *slope < f64::INFINITY)) {
            Some(taken_up) => Err(PlaysError::Slope { taken_up, slope: slopes[taken_up] }),
            None => Ok(Self { thresholds, weights, slopes, backs }),
        }
    }

    /// From one number: `width` is the greatest width of the loop, between two ends a nominal `stroke` S apart, over that stroke,
    /// which the law keeps: y goes up and down by S where v does.
    ///
    /// n plays of equal weight w lie in the middles of n equal parts of (0, R), R = S/2: a constant density, by which the width
    /// of a smaller loop shrinks with the square of its amplitude (Rayleigh). A loop between ends X apart is 2φ(X/2) - 4φ(X/4)
    /// wide in its middle, where it is widest. From 2φ(R) = S and 1 - 2φ(R/2)/φ(R) = width, with a = Σ(1 - rᵢ/R) = n/2 and
    /// b = Σ max(½ - rᵢ/R, 0),
    ///
    /// ```text
    /// w = width/(a - 2b),  w₀ = 1 - w a;   n even: b = n/8, w = 4 width/n, w₀ = 1 - 2 width
    /// ```
    ///
    /// Beyond the nominal stroke all plays are taken up, and the slope stays at w₀ + nw.
    ///
    /// # Errors
    ///
    /// Where the width is not above 0 and w₀ above 0 (just below ½), or the stroke or the count cannot be.
    pub fn of_loop(width: f64, stroke: f64, count: usize) -> Result<Self, PlaysError> {
        if !(1..=Self::MOST).contains(&count) {
            return Err(PlaysError::Count(count));
        }
        if !(stroke > 0.0 && stroke < f64::INFINITY) {
            return Err(PlaysError::Stroke(stroke));
        }
        let n = count as f64;
        let place = |i: usize| (i as f64 + 0.5) / n;
        let a: f64 = (0..count).map(|i| 1.0 - place(i)).sum();
        let b: f64 = (0..count).map(|i| (0.5 - place(i)).max(0.0)).sum();
        let weight = width / (a - 2.0 * b);
        let direct = 1.0 - weight * a;
        if !(width > 0.0 && direct > 0.0) {
            return Err(PlaysError::Width(width));
        }
        Self::new(direct, (0..count).map(|i| 0.5 * stroke * place(i)).collect(), vec![weight; count])
    }

    /// The exact inverse, which is of the same kind: thresholds φ(rᵢ), slopes 1/(w₀ + … + wᵢ).
    ///
    /// Led through the inverse and then through the law, every input comes out as it went in, if both start alike.
    #[must_use]
    pub fn inverse(&self) -> Self {
        let thresholds: Vec<f64> = self.thresholds.iter().map(|r| self.initial(*r)).collect();
        let slopes: Vec<f64> = self.slopes.iter().map(|slope| slope.recip()).collect();
        let weights: Vec<f64> = slopes.windows(2).map(|pair| pair[1] - pair[0]).collect();
        let mut backs = vec![0.0];
        for (i, (r, w)) in thresholds.iter().zip(&weights).enumerate() {
            backs.push(backs[i] + w * r);
        }
        Self { thresholds, weights, slopes, backs }
    }

    /// Number of plays.
    pub fn count(&self) -> usize {
        self.thresholds.len()
    }

    /// rᵢ.
    pub fn thresholds(&self) -> &[f64] {
        &self.thresholds
    }

    /// wᵢ.
    pub fn weights(&self) -> &[f64] {
        &self.weights
    }

    /// w₀.
    pub fn direct(&self) -> f64 {
        self.slopes[0]
    }

    /// φ(v) for v ≥ 0.
    pub fn initial(&self, v: f64) -> f64 {
        let taken_up = self.thresholds.partition_point(|r| *r < v);
        self.slopes[taken_up] * v - self.backs[taken_up]
    }

    /// Area of the loop between two ends of the input that lie `stroke` X apart: Σ 2wᵢrᵢ(X - 2rᵢ) over the plays that it takes
    /// up; unit of the output times that of the input.
    pub fn area(&self, stroke: f64) -> f64 {
        let taken_up = self.thresholds.iter().zip(&self.weights).filter(|(r, _)| 2.0 * **r < stroke);
        taken_up.map(|(r, w)| 2.0 * w * r * (stroke - 2.0 * r)).sum()
    }

    /// Greatest width of that loop, in the unit of the output: 2φ(X/2) - 4φ(X/4), in its middle.
    pub fn width(&self, stroke: f64) -> f64 {
        2.0 * self.initial(0.5 * stroke) - 4.0 * self.initial(0.25 * stroke)
    }

    /// Stroke of the output between two such ends: 2φ(X/2).
    pub fn stroke(&self, stroke: f64) -> f64 {
        2.0 * self.initial(0.5 * stroke)
    }

    /// The pᵢ after the input has gone straight from 0 to v.
    pub fn start(&self, v: f64) -> Vec<f64> {
        let mut places = vec![0.0; self.count()];
        self.drag(&mut places, v);
        places
    }

    /// Drags the pᵢ to where the input, on a way without a turn, has come.
    pub fn drag(&self, places: &mut [f64], v: f64) {
        for (place, r) in places.iter_mut().zip(&self.thresholds) {
            *place = place.clamp(v - r, v + r);
        }
    }

    /// How many plays an input at v has taken up that goes on in a sense, 1 or -1.
    ///
    /// pᵢ and pᵢ₊₁ never differ by more than their thresholds: those taken up are the first so many. Within `slack` of its end a
    /// play counts as taken up.
    pub fn taken_up(&self, places: &[f64], (v, sense): (f64, f64), slack: f64) -> usize {
        self.thresholds.iter().zip(places).take_while(|(r, p)| sense * (v - *p) >= *r - slack).count()
    }

    /// How far the input at v still goes in a sense before it has taken up play `i`; ∞ where there is none.
    pub fn left(&self, places: &[f64], (v, sense): (f64, f64), i: usize) -> f64 {
        match (self.thresholds.get(i), places.get(i)) {
            (Some(r), Some(p)) => r - sense * (v - p),
            _ => f64::INFINITY,
        }
    }

    /// Output and slope at v with the first `taken_up` plays dragged in a sense and the others where they are.
    pub fn output(&self, places: &[f64], (v, sense): (f64, f64), taken_up: usize) -> (f64, f64) {
        let slope = self.slopes[taken_up];
        let held: f64 = self.weights[taken_up..].iter().zip(&places[taken_up..]).map(|(w, p)| w * p).sum();
        (slope * v - sense * self.backs[taken_up] + held, slope)
    }

    /// Smallest and largest output for inputs in a range that holds 0, from the start on. The end that is farther from 0 is reached
    /// on the initial curve, whatever was before; the other one so, or from there back by 2φ(½(high - low)), which leads
    /// further where weights are negative, as those of an inverse.
    pub fn range(&self, (low, high): (f64, f64)) -> (f64, f64) {
        let (down, up) = (-self.initial((-low).max(0.0)), self.initial(high.max(0.0)));
        let way = self.stroke(high - low);
        if high >= -low { (down.min(up - way), up) } else { (down, up.max(down + way)) }
    }
}

#[cfg(test)]
mod tests;
