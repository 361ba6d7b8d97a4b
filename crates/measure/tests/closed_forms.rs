//! Loops computed from the closed-form branches of a power-law profile f ~ rⁿ with p = (n+1)/n at constant normal force.
//!
//! Source: Popov, Heß, Willert, Handbook of Contact Mechanics, section 4.4.
//!
//! Sampling error: the slope of a branch decreases monotonically from `pμF_N/u_c`. The area between a branch and its chords of width h is
//! at most h²/8 times the change of slope. For both branches of a loop it is at most h²/4 · `pμF_N/u_c`. The tests of the loop energy use
//! this bound. Tolerances of ratios, crossings and slopes follow from h by the estimates given there.

use approx::{assert_abs_diff_eq, assert_relative_eq};
use proptest::prelude::*;
use stickslip_measure::{Cut, Cycle, Regime, Thresholds, split_cycles};

/// A contact: exponent p, friction limit `μF_N`, N, gross slip displacement `u_c`, m.
#[derive(Clone, Copy)]
struct Contact {
    p: f64,
    limit: f64,
    u_c: f64,
}

impl Contact {
    fn of_profile(n: f64) -> Self {
        Self { p: (n + 1.0) / n, limit: 0.06, u_c: 40e-9 }
    }

    /// Returns the force change at a displacement after a reversal. `folds` is 1 for the first loading and 2 for later branches.
    fn branch(self, way: f64, folds: f64) -> f64 {
        let rest = (1.0 - way / (folds * self.u_c)).max(0.0);
        folds * self.limit * (1.0 - rest.powf(self.p))
    }

    /// Returns the steady loop of amplitude U with `cells` cells per branch. The last sample closes it.
    fn steady_loop(self, amplitude: f64, cells: usize) -> (Vec<f64>, Vec<f64>) {
        let top = self.branch(amplitude, 1.0);
        let way = |i: usize| 2.0 * amplitude * i as f64 / cells as f64;
        let down = (0..cells).map(|i| (amplitude - way(i), top - self.branch(way(i), 2.0)));
        let up = (0..=cells).map(|i| (way(i) - amplitude, self.branch(way(i), 2.0) - top));
        down.chain(up).unzip()
    }

    /// Returns the loop energy, J, from its closed forms.
    fn loop_energy(self, amplitude: f64) -> f64 {
        let (p, ratio) = (self.p, amplitude / self.u_c);
        if ratio > 1.0 {
            return 4.0 * self.limit * (amplitude - 2.0 * self.u_c / (p + 1.0));
        }
        let rest = 1.0 - ratio;
        let braces = ratio + ratio * rest.powf(p) - 2.0 / (p + 1.0) * (1.0 - rest.powf(p + 1.0));
        4.0 * self.limit * self.u_c * braces
    }

    /// Returns the bound of the area between chords and branches.
    fn sampling_error(self, amplitude: f64, cells: usize) -> f64 {
        let h = 2.0 * amplitude / cells as f64;
        h * h / 4.0 * self.p * self.limit / self.u_c
    }
}

const EXPONENTS: [f64; 4] = [1.0, 2.0, 4.0, 6.0];

#[test]
fn the_loop_energy_is_the_closed_form_below_and_above_gross_slip() {
    for n in EXPONENTS {
        let contact = Contact::of_profile(n);
        for ratio in [0.1, 0.3, 0.7, 0.95, 1.0, 1.2, 2.0, 5.0] {
            let amplitude = ratio * contact.u_c;
            let (u, q) = contact.steady_loop(amplitude, 4000);
            let cycle = Cycle::of_loop(&u, &q).unwrap();
            let bound = contact.sampling_error(amplitude, 4000) + 1e-14 * cycle.enclosing_energy();
            assert_abs_diff_eq!(cycle.dissipated, contact.loop_energy(amplitude), epsilon = bound);
            // Chords cut the corners of the loop and never add area.
            assert!(cycle.dissipated <= contact.loop_energy(amplitude) + 1e-14 * cycle.enclosing_energy());
        }
    }
}

#[test]
fn a_small_amplitude_keeps_the_cubic_law() {
    // (2/3)p(p-1)μF_N u_c Ũ³, next term of relative order Ũ. At Ũ = 1e-4 the loop is 1e-5 of its enclosure.
    let contact = Contact::of_profile(2.0);
    let (p, ratio, cells) = (contact.p, 1e-4, 2000);
    let (u, q) = contact.steady_loop(ratio * contact.u_c, cells);
    let area = Cycle::of_loop(&u, &q).unwrap().dissipated;
    let cubic = 2.0 / 3.0 * p * (p - 1.0) * contact.limit * contact.u_c * ratio.powi(3);
    // The chords of a parabola of N cells enclose 1 - 1/N² of it; here 2.5e-7.
    assert_relative_eq!(area, cubic, max_relative = ratio);
}

#[test]
fn at_the_limit_the_ratios_are_the_thresholds() {
    for n in EXPONENTS {
        let contact = Contact::of_profile(n);
        let (u, q) = contact.steady_loop(contact.u_c, 20_000);
        let cycle = Cycle::of_loop(&u, &q).unwrap();
        assert_relative_eq!(cycle.displacement_amplitude, contact.u_c, max_relative = 1e-15);
        assert_relative_eq!(cycle.force_amplitude, contact.limit, max_relative = 1e-14);
        // Area: sampling_error/E_t = h²p/(16u_c²) = p/16 · 1e-8. δ₀: the branch departs from its chord by at most
        // h/8 times the change of slope in the cell, near Q = 0 less than h²p²/u_c² of u_c: 1e-8 again.
        let energy = 1.0 / (2.0 * n + 1.0);
        let slip = 2.0_f64.powf(1.0 / (n + 1.0)) - 1.0;
        assert_abs_diff_eq!(cycle.energy_ratio().unwrap(), energy, epsilon = 2e-9);
        assert_abs_diff_eq!(cycle.slip_ratio().unwrap(), slip, epsilon = 1e-8);
        assert_abs_diff_eq!(cycle.system_free_ratio().unwrap(), energy / slip, epsilon = 1e-7);
    }
    // Published, sphere.
    let contact = Contact::of_profile(2.0);
    let (u, q) = contact.steady_loop(contact.u_c, 20_000);
    let cycle = Cycle::of_loop(&u, &q).unwrap();
    assert_abs_diff_eq!(cycle.energy_ratio().unwrap(), 0.2, epsilon = 5e-5);
    assert_abs_diff_eq!(cycle.slip_ratio().unwrap(), 0.2599, epsilon = 5e-5);
    assert_abs_diff_eq!(cycle.system_free_ratio().unwrap(), 0.7695, epsilon = 5e-5);
}

#[test]
fn a_compliant_rig_lowers_the_ratios_as_its_thresholds_say() {
    let contact = Contact::of_profile(2.0);
    for factor in [0.5, 2.0] {
        let compliance = factor * contact.u_c / contact.limit;
        let seen = |ratio: f64| {
            let (u, q) = contact.steady_loop(ratio * contact.u_c, 4000);
            let total: Vec<f64> = u.iter().zip(&q).map(|(u, q)| u + compliance * q).collect();
            Cycle::of_loop(&total, &q).unwrap()
        };
        let limits = Thresholds::with_rig(2.0, factor).unwrap();
        let at_limit = seen(1.0);
        // h/u_c is 5e-4: chords cost the ratios no more than (h/u_c)² p² = 6e-7.
        assert_abs_diff_eq!(at_limit.energy_ratio().unwrap(), limits.energy_ratio.unwrap(), epsilon = 1e-6);
        assert_abs_diff_eq!(at_limit.slip_ratio().unwrap(), limits.slip_ratio.unwrap(), epsilon = 1e-6);
        assert_abs_diff_eq!(
            at_limit.system_free_ratio().unwrap(),
            limits.system_free_ratio.unwrap(),
            epsilon = 1e-6
        );
        assert_eq!(limits.regime(&seen(0.9)), Regime::Partial);
        assert_eq!(limits.regime(&seen(1.1)), Regime::Gross);
        // Compared with the thresholds of a rigid rig, A and D classify the gross loop as partial slip. B is independent of the rig.
        let rigid = Thresholds::of_profile(2.0).unwrap();
        assert_eq!(rigid.regime(&seen(1.1)), Regime::Mixed);
        assert_eq!(Thresholds::with_unknown_rig(2.0).unwrap().regime(&seen(1.1)), Regime::Gross);
    }
}

#[test]
fn regimes_follow_the_amplitude() {
    for n in EXPONENTS {
        let contact = Contact::of_profile(n);
        let limits = Thresholds::of_profile(n).unwrap();
        let cycle = |ratio: f64| {
            let (u, q) = contact.steady_loop(ratio * contact.u_c, 4000);
            Cycle::of_loop(&u, &q).unwrap()
        };
        assert_eq!(limits.regime(&cycle(1e-4)), Regime::Stick);
        assert_eq!(limits.regime(&cycle(0.5)), Regime::Partial);
        assert_eq!(limits.regime(&cycle(0.99)), Regime::Partial);
        assert_eq!(limits.regime(&cycle(1.01)), Regime::Gross);
        assert_eq!(limits.regime_of_run(&[cycle(1e-4), cycle(0.5)]), Some(Regime::Partial));
        assert_eq!(limits.regime_of_run(&[cycle(1.5), cycle(0.5)]), Some(Regime::Mixed));
        assert_eq!(limits.regime_of_run(&[]), None);
    }
}

#[test]
fn the_energy_coefficient_of_friction_is_the_closed_form() {
    // U > u_c: Q = 0 at U - 2u_c(1 - 2^{-1/p}) on the way down; μ_e → μ for U → ∞.
    let contact = Contact::of_profile(2.0);
    let (normal_force, friction) = (0.3, 0.2);
    for ratio in [1.5, 10.0, 1000.0] {
        let amplitude = ratio * contact.u_c;
        let opening = amplitude - 2.0 * contact.u_c * (1.0 - 2.0_f64.powf(-1.0 / contact.p));
        let (u, q) = contact.steady_loop(amplitude, 40_000);
        let cycle = Cycle::of_loop(&u, &q).unwrap();
        let expected = contact.loop_energy(amplitude) / (4.0 * normal_force * opening);
        // h/u_c is 0.05 at the largest: chords of δ₀ and area to h²p²/u_c² of u_c, 6e-3 of u_c in 1000u_c.
        assert_relative_eq!(cycle.half_opening.unwrap(), opening, max_relative = 6e-6);
        assert_relative_eq!(cycle.friction_coefficient(normal_force).unwrap(), expected, max_relative = 6e-6);
    }
    let (u, q) = contact.steady_loop(1000.0 * contact.u_c, 40_000);
    let mu = Cycle::of_loop(&u, &q).unwrap().friction_coefficient(normal_force).unwrap();
    assert_relative_eq!(mu, friction, max_relative = 1e-3);
}

#[test]
fn the_stiffness_after_reversal_is_the_fitted_line_of_the_law() {
    // Least squares of 2μF_N(1-(1-s/2u_c)^p) over 0 ≤ s ≤ w in closed form: slope = (12/w³)∫(s-w/2)F ds.
    let contact = Contact::of_profile(2.0);
    for ratio in [0.01, 0.5, 1.0, 3.0] {
        let amplitude = ratio * contact.u_c;
        let (w, c, p) = (0.2 * amplitude, 2.0 * contact.u_c, contact.p);
        let rest = 1.0 - w / c;
        let zeroth = c / (p + 1.0) * (1.0 - rest.powf(p + 1.0));
        let first = c * c / ((p + 1.0) * (p + 2.0)) * (1.0 - rest.powf(p + 2.0))
            - w * c / (p + 1.0) * rest.powf(p + 1.0);
        let slope = -12.0 / w.powi(3) * 2.0 * contact.limit * (first - w / 2.0 * zeroth);
        let (u, q) = contact.steady_loop(amplitude, 20_000);
        let cycle = Cycle::of_loop(&u, &q).unwrap();
        // 2 000 evenly spaced samples against the integral: the end samples weigh twice too much, an error of
        // order 1/2000 of the curvature's share w/c of the slope; the closed form cancels to 1e-16·(c/w)³.
        let cancellation = 1e-15 * (c / w).powi(3);
        for fitted in [cycle.stiffness_after_maximum, cycle.stiffness_after_minimum] {
            assert_relative_eq!(fitted.unwrap(), slope, max_relative = w / c / 2000.0 + cancellation);
        }
    }
}

#[test]
fn a_long_record_splits_into_loops_of_the_same_energy() {
    let contact = Contact::of_profile(2.0);
    let amplitude = 0.8 * contact.u_c;
    let cells = 1000;
    let (u_loop, q_loop) = contact.steady_loop(amplitude, cells);
    let period = 2 * cells;
    let at = |i: usize| i % period;
    let count = 5 * period + 700;
    let t: Vec<f64> = (0..count).map(|i| i as f64 * 1e-5).collect();
    let u: Vec<f64> = (0..count).map(|i| u_loop[at(i)]).collect();
    let q: Vec<f64> = (0..count).map(|i| q_loop[at(i)]).collect();
    let by_reversal = split_cycles(&t, &u, &q, Cut::Reversals { least: 0.05 * amplitude }).unwrap();
    let by_period =
        split_cycles(&t, &u, &q, Cut::Period { start: 0.003, period: period as f64 * 1e-5 }).unwrap();
    assert_eq!((by_reversal.len(), by_period.len()), (4, 5));
    for range in by_reversal.into_iter().chain(by_period) {
        let cycle = Cycle::of_loop(&u[range.clone()], &q[range]).unwrap();
        let bound = contact.sampling_error(amplitude, cells) + 1e-14 * cycle.enclosing_energy();
        assert_abs_diff_eq!(cycle.dissipated, contact.loop_energy(amplitude), epsilon = bound);
    }
}

proptest! {
    #[test]
    fn no_series_makes_it_panic(
        series in proptest::collection::vec((proptest::num::f64::ANY, proptest::num::f64::ANY), 0..40),
        period in proptest::num::f64::ANY,
    ) {
        let (u, q): (Vec<f64>, Vec<f64>) = series.into_iter().unzip();
        let _ = Cycle::of_loop(&u, &q).map(|c| (c.energy_ratio(), Thresholds::of_profile(2.0).map(|t| t.regime(&c))));
        let mut t = u.clone();
        t.sort_by(f64::total_cmp);
        let _ = split_cycles(&t, &u, &q, Cut::Reversals { least: period });
        let _ = split_cycles(&t, &u, &q, Cut::Period { start: 0.0, period });
        let bounds = stickslip_measure::Bounds { least: 0.0, most: f64::INFINITY, error: 0.0 };
        let _ = stickslip_measure::Steps::of_record(&t, &q, period, bounds);
    }

    #[test]
    fn shifts_and_turns_of_a_loop_keep_its_numbers(shift in -1e3..1e3_f64, start in 0..4000_usize, ratio in 0.05..3.0_f64) {
        // Wherever the origin of u lies and whichever sample comes first: round-off of the shift alone, 1e3·u_c·ε.
        let contact = Contact::of_profile(2.0);
        let (mut u, mut q) = contact.steady_loop(ratio * contact.u_c, 2000);
        u.pop();
        q.pop();
        let plain = Cycle::of_loop(&u, &q).unwrap();
        u.rotate_left(start);
        q.rotate_left(start);
        let moved: Vec<f64> = u.iter().map(|u| u + shift * contact.u_c).collect();
        let moved = Cycle::of_loop(&moved, &q).unwrap();
        let round_off = 1e3 * contact.u_c * f64::EPSILON;
        prop_assert!((moved.half_opening.unwrap() - plain.half_opening.unwrap()).abs() < 4.0 * round_off);
        prop_assert!((moved.dissipated - plain.dissipated).abs() < 8.0 * contact.limit * round_off);
    }
}
