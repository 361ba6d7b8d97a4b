//! Damped contact: every spring carries G\*(s + βu̇), limited to its friction limit ±μE\*(d-h).
//!
//! The elastic part G\*s alone determines slip, so that the slip memory remains exact. The limited force is the elastic force of the
//! contact after a further displacement βu̇ at constant indentation, which is not committed: a spring that would slip on this lead
//! carries its limit, another one G\*(s + βu̇). Coulomb's law therefore holds for every spring, and the force is continuous.

use super::Curve;
use super::cut::{Drag, Edge};
use crate::{Apex, Interface, Motion};

/// Path of a contact since the committed apex.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Since {
    /// Straight path.
    Chord,
    /// Any path on which the limit line of a direction (+1 or -1) slips.
    Slip(f64),
    /// Growth in full stick, with its force F_x at the end, N.
    Growth(f64),
}

impl Curve {
    /// Returns the force F_x of a contact with damping, N, for the motion at the end of a path.
    ///
    /// `lead` is βu̇, m. On growth in full stick the path is approximated by a parabola u(d), which is tangent to the motion at its end.
    pub fn ahead(&self, law: &Interface, since: Since, at: &Motion, lead: f64) -> f64 {
        if at.d <= 0.0 {
            return 0.0;
        }
        let to = at.apex();
        let touch;
        let knots = match &self.knots[..] {
            [] => {
                touch = [self.touching(to)];
                &touch[..]
            }
            knots => knots,
        };
        let since = match since {
            Since::Chord => match Drag::of(law, knots, to) {
                Drag::Slip(edge) => Since::Slip(edge.sense),
                Drag::Stick => Since::Growth(self.force_at(law, to)),
                Drag::Open | Drag::Rest => Since::Slip(lead.signum()),
            },
            since => since,
        };
        let goal = Apex { u: to.u + lead, ..to };
        let (sense, slope, profile) = (lead.signum(), law.stick_slope(), law.profile());
        // Nothing of the path since the committed apex remains where the lead slips past it.
        let passed = || Edge::find(law, knots, sense, goal).shear(law, knots, goal);
        let shear = match since {
            Since::Slip(slip) if slip == sense => passed(),
            Since::Slip(slip) => {
                let edge = Edge::find(law, knots, slip, to);
                let height = to.d - lead.abs() / (2.0 * slope);
                // The lead turns back on the limit line, or beyond the slip front on older memory.
                if height >= if edge.is_gross() { 0.0 } else { edge.height } {
                    let turned = profile.reduced_force(to.d) - profile.reduced_force(height);
                    edge.shear(law, knots, to) + 2.0 * sense * slope * turned
                } else if edge.is_gross() {
                    sense * slope * profile.reduced_force(to.d)
                } else {
                    passed()
                }
            }
            Since::Growth(force) => {
                let growth = Growth::of(law, knots[knots.len() - 1].apex(), at);
                let width = growth.width(sense, slope, lead.abs());
                if width < growth.rise {
                    let top = knots[knots.len() - 1];
                    growth.shear(law, [top.shear, force / law.tangential_modulus()], sense * slope, width)
                } else {
                    passed()
                }
            }
            // Replaced above.
            Since::Chord => 0.0,
        };
        law.tangential_modulus() * shear
    }
}

/// Growth in full stick as a parabola p = u - ky + cy², y = d - h.
struct Growth {
    /// Indentation d at the end, m.
    d: f64,
    /// Growth of the indentation since the committed apex, m.
    rise: f64,
    /// Slope k = u̇/ḋ at the end.
    slope: f64,
    /// Curvature c, 1/m.
    bend: f64,
}

impl Growth {
    fn of(law: &Interface, from: Apex, at: &Motion) -> Self {
        let (rise, mean) = (at.d - from.d, (at.u - from.u) / (at.d - from.d));
        let limit = law.stick_slope();
        let slope = if at.dd > 0.0 { (at.du / at.dd).clamp(-limit, limit) } else { mean };
        Self { d: at.d, rise, slope, bend: (slope - mean) / rise }
    }

    /// Returns the width of the edge that slips on a lead, m.
    fn width(&self, sense: f64, slope: f64, lead: f64) -> f64 {
        let (a, c) = (slope - sense * self.slope, sense * self.bend);
        let root = a * a + 4.0 * c * lead;
        if root < 0.0 { f64::INFINITY } else { 2.0 * lead / (a + root.sqrt()) }
    }

    /// Returns the force over G\*, m², if an edge of a width slips with a slope. `sums` are those of the committed apex and of the path.
    fn shear(&self, law: &Interface, sums: [f64; 2], edge: f64, width: f64) -> f64 {
        let profile = law.profile();
        let low = self.d - self.rise;
        let [begin, all, inner] = [low, self.d, self.d - width].map(|h| profile.reduced_sums(h));
        // ∫p'm dh = kΔM - 2c∫ym dh, and ∫ym dh = ΔN - yM from a width y to the edge.
        let moment = |from: [f64; 2], y: f64| (all[1] - from[1]) - y * from[0];
        let path =
            |from: [f64; 2], y: f64| self.slope * (all[0] - from[0]) - 2.0 * self.bend * moment(from, y);
        let (whole, outer) = (path(begin, self.rise), path(inner, width));
        // The parabola misses the integrated force a little, in proportion to M.
        let missed = sums[1] - sums[0] - whole;
        let share = if all[0] > begin[0] { (inner[0] - begin[0]) / (all[0] - begin[0]) } else { 0.0 };
        sums[0] + (whole - outer) + missed * share + edge * (all[0] - inner[0])
    }
}
