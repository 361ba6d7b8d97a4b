//! Memory of a contact under constant load, by Masing's rules. The memory consists of the reversals.
//!
//! In units of u_c and μF_N the force on first loading is φ = σ[1 - z^p] with z = 1 - σu (Mindlin). After a reversal at (uᵣ, φᵣ) the
//! force is φ = φᵣ + 2σ[1 - z^p] with z = 1 - σ(u - uᵣ)/2. The exponent p is 3/2 for a paraboloid and (n+1)/n for |x|ⁿ. A branch ends at
//! the reversal before, or at z = 0, where all springs slip.
//!
//! Source: Mindlin, Deresiewicz, J. Appl. Mech. 20 (1953) 327.

/// Number of reversals for which memory is allocated at the start.
const ROOM: usize = 64;

/// Contact with its displacement and memory.
#[derive(Debug, Clone)]
pub(crate) struct Masing {
    /// Exponent p.
    power: f64,
    /// Displacement u.
    pub(crate) at: f64,
    /// Direction of sliding σ, ±1.
    pub(crate) sense: f64,
    /// Whether the contact is in gross slip, and whether it has never been in gross slip.
    pub(crate) gross: bool,
    virgin: bool,
    /// Reversals (u, φ) of open loops. The first reversal is stored with its opposite point.
    turns: Vec<[f64; 2]>,
    branch: Branch,
}

/// Smooth branch of the force.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Branch {
    /// Scale: 1 on first loading, otherwise 2.
    pub(crate) scale: f64,
    /// uᵣ.
    from: f64,
    /// σφᵣ.
    pub(crate) start: f64,
    /// Force φ at z = 0; σ times the scale; σ divided by the scale.
    top: f64,
    swing: f64,
    lean: f64,
    /// z at the end of the branch.
    pub(crate) end: f64,
}

impl Branch {
    fn new(scale: f64, from: [f64; 2], sense: f64) -> Self {
        let swing = sense * scale;
        Self {
            scale,
            from: from[0],
            start: sense * from[1],
            top: from[1] + swing,
            swing,
            lean: sense / scale,
            end: 0.0,
        }
    }

    /// Returns z, which is negative beyond gross slip.
    #[inline]
    pub(crate) fn height(&self, u: f64) -> f64 {
        1.0 - self.lean * (u - self.from)
    }

    #[inline]
    fn force(&self, height: f64, power: f64) -> f64 {
        self.top - self.swing * raised(height, power)
    }
}

impl Masing {
    /// Returns a contact at u = 0 without loading history.
    pub(crate) fn new(power: f64) -> Self {
        let branch = Branch::new(1.0, [0.0; 2], 1.0);
        let turns = Vec::with_capacity(ROOM);
        Self { power, at: 0.0, sense: 1.0, gross: false, virgin: true, turns, branch }
    }

    /// Returns the current branch.
    pub(crate) fn branch(&self) -> Branch {
        self.branch
    }

    /// Returns the current force φ.
    fn force(&self) -> f64 {
        if self.gross {
            self.sense
        } else {
            self.branch.force(self.branch.height(self.at).max(0.0), self.power)
        }
    }

    /// Returns the force φ at u without a change of the memory.
    #[inline]
    pub(crate) fn look(&self, u: f64) -> f64 {
        if (u - self.at) * self.sense < 0.0 {
            let last = self.turns.last().map_or(-self.at, |turn| turn[0]);
            if !self.gross && (u - last) * self.sense < 0.0 {
                return self.beyond(u);
            }
            let turned = Branch::new(2.0, [self.at, self.force()], -self.sense);
            return turned.force(turned.height(u).max(0.0), self.power);
        }
        if self.gross {
            return self.sense;
        }
        let height = self.branch.height(u);
        if height >= self.branch.end { self.branch.force(height, self.power) } else { self.beyond(u) }
    }

    /// Returns the force beyond the end of the branch.
    #[cold]
    fn beyond(&self, u: f64) -> f64 {
        let mut gone = self.clone();
        gone.slide(u);
        gone.force()
    }

    /// Moves to u and updates the memory.
    #[inline]
    pub(crate) fn slide(&mut self, u: f64) {
        if (u - self.at) * self.sense < 0.0 {
            self.turn();
        }
        while !self.gross && self.branch.height(u) < self.branch.end {
            self.close();
        }
        self.at = u;
    }

    /// Adds a reversal at the current displacement.
    pub(crate) fn turn(&mut self) {
        let force = self.force();
        if self.turns.is_empty() && !self.gross {
            self.turns.push([-self.at, -force]);
        }
        self.turns.push([self.at, force]);
        (self.gross, self.sense) = (false, -self.sense);
        self.follow();
    }

    /// Ends the current branch: the previous branch continues, or gross slip begins.
    pub(crate) fn close(&mut self) {
        let passed = self.turns.len();
        self.turns.truncate(passed.saturating_sub(2));
        // Beyond the outermost loop lies first loading, or the gross slip before the reversal.
        self.gross = passed < 2 || passed == 2 && !self.virgin;
        self.virgin &= !self.gross;
        self.follow();
    }

    /// Sets the branch that follows from the reversals.
    fn follow(&mut self) {
        let (scale, from) = self.turns.last().map_or((1.0, [0.0; 2]), |turn| (2.0, *turn));
        self.branch = Branch::new(scale, from, self.sense);
        if let [.., before, _] = self.turns[..] {
            self.branch.end = self.branch.height(before[0]).max(0.0);
        }
    }
}

/// Returns z^p, by square roots for common exponents.
#[inline]
fn raised(z: f64, p: f64) -> f64 {
    if p == 1.5 {
        z * z.sqrt()
    } else if p == 2.0 {
        z * z
    } else if p == 1.25 {
        z * z.sqrt().sqrt()
    } else {
        math::powf(z, p)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Mindlin's curve, Masing's rules and return-point memory.
    #[test]
    fn turns_are_remembered_until_they_are_passed() {
        let first = |u: f64| 1.0 - (1.0 - u).powf(1.5);
        let mut contact = Masing::new(1.5);
        let near = |contact: &Masing, u: f64, force: f64| {
            assert!((contact.look(u) - force).abs() < 1e-15, "{u}: {} {force}", contact.look(u));
        };
        near(&contact, 0.6, first(0.6));
        contact.slide(0.6);
        // A large loop with a small one inside.
        let back = |u: f64| first(0.6) - 2.0 * first(0.5 * (0.6 - u));
        near(&contact, 0.2, back(0.2));
        contact.slide(-0.1);
        let again = |u: f64| back(-0.1) + 2.0 * first(0.5 * (u + 0.1));
        contact.slide(0.3);
        near(&contact, 0.3, again(0.3));
        // Back beyond the start of the small loop, then beyond the start of the large one.
        near(&contact, -0.2, back(-0.2));
        near(&contact, -0.7, -first(0.7));
        contact.slide(-0.2);
        near(&contact, -0.2, back(-0.2));
        contact.slide(-1.5);
        assert_eq!((contact.gross, contact.look(-2.0)), (true, -1.0));
        near(&contact, -0.5, -1.0 + 2.0 * first(0.5));
        // After gross slip, the opposite gross slip begins at a distance of 2u_c from the reversal.
        contact.slide(0.4);
        near(&contact, 0.5, 1.0);
    }
}
