//! Prandtl–Ishlinskii model of hysteresis: a weighted sum of play operators.

/// Prandtl–Ishlinskii hysteresis y = w₀ v + Σ wᵢ pᵢ with play operators pᵢ of the input v.
///
/// Each play satisfies |v - pᵢ| ≤ rᵢ, where rᵢ is its threshold. A play moves only when the input forces it to move; such a play is
/// engaged. Between two reversals the input engages one play after the other, in the order of their thresholds. The slope of y is w₀ + Σ wᵢ
/// over the engaged plays.
///
/// Properties:
///
/// * Initial curve from pᵢ = 0: φ(v) = w₀ v + Σ wᵢ max(v - rᵢ, 0).
/// * Masing's rule: from a reversal at v₁, y changes by 2φ(|v - v₁|/2).
/// * Congruency: minor loops of equal input range have equal shape.
/// * Wiping-out: a closed minor loop is erased from the memory.
///
/// Thresholds have the unit of the input. Weights have the unit of the output divided by the unit of the input.
///
/// Source: Visintin, *Differential Models of Hysteresis* (1994), chapter III; for piezo stacks and the inverse: Kuhnen, European Journal of
/// Control 9 (2003) 407.
#[derive(Debug, Clone, PartialEq)]
pub struct Plays {
    /// Thresholds rᵢ, ascending and above 0.
    thresholds: Vec<f64>,
    weights: Vec<f64>,
    /// Slopes with the first i plays engaged: w₀ + w₁ + … + wᵢ.
    slopes: Vec<f64>,
    /// Sums w₁r₁ + … + wᵢrᵢ over the first i plays.
    backs: Vec<f64>,
}

/// Reason why parameters of the Prandtl–Ishlinskii model are invalid.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum PlaysError {
    /// The numbers of thresholds and weights differ.
    #[error("expected a weight for each of {thresholds} thresholds, got {weights}")]
    Lengths {
        /// Number of thresholds.
        thresholds: usize,
        /// Number of weights.
        weights: usize,
    },
    /// The thresholds are not above 0 or not in ascending order.
    #[error("expected ascending thresholds above 0, got {value} at index {place}")]
    Threshold {
        /// Index of the threshold, from 0.
        place: usize,
        /// Value of the threshold.
        value: f64,
    },
    /// The slope with some number of engaged plays is not above 0.
    #[error("expected weights whose partial sums are above 0, got {slope} for the first {taken_up} plays")]
    Slope {
        /// Number of engaged plays.
        taken_up: usize,
        /// Slope w₀ + w₁ + … with these plays engaged.
        slope: f64,
    },
    /// The width of the loop is not between 0 and half of the stroke.
    #[error("expected a relative width of the loop above 0 and below 0.5, got {0}")]
    Width(f64),
    /// The number of operators is out of range.
    #[error("expected 1 to {most} operators, got {0}", most = Plays::MOST)]
    Count(usize),
    /// The stroke is not above 0 or not finite.
    #[error("expected a stroke above 0, got {0}")]
    Stroke(f64),
}

impl Plays {
    /// Largest number of play operators.
    pub const MOST: usize = 64;

    /// Creates the model from the weight w₀ of the input and the pairs (rᵢ, wᵢ).
    ///
    /// # Errors
    ///
    /// Fails if there are more than [`Plays::MOST`] thresholds or they are not ascending and above 0. Also fails if the slope is not above
    /// 0 for some number of engaged plays, because the model would have no inverse.
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

    /// Creates the model from the width of its hysteresis loop.
    ///
    /// `width` is the greatest width of the loop whose input range is the nominal `stroke` S, relative to S. The output of the model has
    /// the same range: y changes by S if v changes by S.
    ///
    /// The `count` n plays have equal weights w and thresholds in the middles of n equal parts of (0, R), R = S/2. The width of a
    /// smaller loop is about proportional to the square of its amplitude (Rayleigh's law). A loop of input range X has the width
    /// 2φ(X/2) - 4φ(X/4) in its middle, where it is widest. The conditions are 2φ(R) = S and 1 - 2φ(R/2)/φ(R) = width. With a = Σ(1 -
    /// rᵢ/R) = n/2 and b = Σ max(½ - rᵢ/R, 0) they give
    ///
    /// ```text
    /// w = width/(a - 2b),  w₀ = 1 - w a;   n even: b = n/8, w = 4 width/n, w₀ = 1 - 2 width
    /// ```
    ///
    /// Beyond the nominal stroke all plays are engaged, and the slope of the output is w₀ + nw.
    ///
    /// # Errors
    ///
    /// Fails if the width is not above 0 or not below about ½, where w₀ becomes 0. Also fails if the stroke or the count is out of range.
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

    /// Returns the exact inverse, a model of the same kind with thresholds φ(rᵢ) and slopes 1/(w₀ + … + wᵢ).
    ///
    /// Inverse and model in series return the input, if both models start from the same state.
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

    /// Returns the number of plays.
    pub fn count(&self) -> usize {
        self.thresholds.len()
    }

    /// Returns the thresholds rᵢ.
    pub fn thresholds(&self) -> &[f64] {
        &self.thresholds
    }

    /// Returns the weights wᵢ.
    pub fn weights(&self) -> &[f64] {
        &self.weights
    }

    /// Returns the weight w₀ of the input.
    pub fn direct(&self) -> f64 {
        self.slopes[0]
    }

    /// Returns the initial curve φ(v) for v ≥ 0.
    pub fn initial(&self, v: f64) -> f64 {
        let taken_up = self.thresholds.partition_point(|r| *r < v);
        self.slopes[taken_up] * v - self.backs[taken_up]
    }

    /// Returns the area of the loop with the input range `stroke` X: Σ 2wᵢrᵢ(X - 2rᵢ) over the plays with 2rᵢ < X.
    ///
    /// The unit of the area is the unit of the output times the unit of the input.
    pub fn area(&self, stroke: f64) -> f64 {
        let taken_up = self.thresholds.iter().zip(&self.weights).filter(|(r, _)| 2.0 * **r < stroke);
        taken_up.map(|(r, w)| 2.0 * w * r * (stroke - 2.0 * r)).sum()
    }

    /// Returns the greatest width of the loop with the input range `stroke` X: 2φ(X/2) - 4φ(X/4), in the unit of the output.
    pub fn width(&self, stroke: f64) -> f64 {
        2.0 * self.initial(0.5 * stroke) - 4.0 * self.initial(0.25 * stroke)
    }

    /// Returns the output range of the loop with the input range `stroke` X: 2φ(X/2).
    pub fn stroke(&self, stroke: f64) -> f64 {
        2.0 * self.initial(0.5 * stroke)
    }

    /// Returns the positions pᵢ after a monotone change of the input from 0 to v.
    pub fn start(&self, v: f64) -> Vec<f64> {
        let mut places = vec![0.0; self.count()];
        self.drag(&mut places, v);
        places
    }

    /// Moves the positions pᵢ of the plays after a monotone change of the input to v.
    pub fn drag(&self, places: &mut [f64], v: f64) {
        for (place, r) in places.iter_mut().zip(&self.thresholds) {
            *place = place.clamp(v - r, v + r);
        }
    }

    /// Returns the number of plays that are engaged by an input at v moving in direction `sense`, 1 or -1.
    ///
    /// Neighbouring plays differ by at most the difference of their thresholds, so the engaged plays are the first ones. A play
    /// within `slack` of its end counts as engaged.
    pub fn taken_up(&self, places: &[f64], (v, sense): (f64, f64), slack: f64) -> usize {
        self.thresholds.iter().zip(places).take_while(|(r, p)| sense * (v - *p) >= *r - slack).count()
    }

    /// Returns the distance from v to the input that engages play `i` in direction `sense`; ∞ if the model has no play `i`.
    pub fn left(&self, places: &[f64], (v, sense): (f64, f64), i: usize) -> f64 {
        match (self.thresholds.get(i), places.get(i)) {
            (Some(r), Some(p)) => r - sense * (v - p),
            _ => f64::INFINITY,
        }
    }

    /// Returns output and slope for an input v, with the first `taken_up` plays engaged in direction `sense` and all other plays at rest.
    pub fn output(&self, places: &[f64], (v, sense): (f64, f64), taken_up: usize) -> (f64, f64) {
        let slope = self.slopes[taken_up];
        let held: f64 = self.weights[taken_up..].iter().zip(&places[taken_up..]).map(|(w, p)| w * p).sum();
        (slope * v - sense * self.backs[taken_up] + held, slope)
    }

    /// Returns the smallest and largest output for inputs within a range that contains 0.
    ///
    /// The end of the range with the larger magnitude is reached on the initial curve. The other end is reached on the initial curve or
    /// from the first end by a change of 2φ(½(high - low)). This change may be the larger one if weights are negative, as of an inverse.
    pub fn range(&self, (low, high): (f64, f64)) -> (f64, f64) {
        let (down, up) = (-self.initial((-low).max(0.0)), self.initial(high.max(0.0)));
        let way = self.stroke(high - low);
        if high >= -low { (down.min(up - way), up) } else { (down, up.max(down + way)) }
    }
}

#[cfg(test)]
mod tests;
