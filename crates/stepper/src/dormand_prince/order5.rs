//! Coefficients of the explicit Runge–Kutta method DOPRI5, order 5(4), by Dormand and Prince.
//!
//! Source: J. R. Dormand, P. J. Prince, *J. Comput. Appl. Math.* 6 (1980) 19. Dense output of order 4 and decimal values: E. Hairer, S. P.
//! Nørsett, G. Wanner, *Solving Ordinary Differential Equations I*, 2nd ed., Springer 1993, sections II.4 and II.6. Ratios are rounded to
//! the nearest double. Stage 7 is the slope at the end of the step.

use super::tableau::rows;

/// Index of the slope at the end of the step (k₇).
pub(super) const END: usize = 6;

/// Nodes c of the stages, as fractions of the step.
pub(super) const NODES: [f64; 7] = [0.0, 0.2, 0.3, 0.8, 0.888_888_888_888_888_8, 1.0, 1.0];

rows! {
    /// Coefficients a₂ⱼ of stage 2.
    Stage2 {
        newest 0 => 0.2
    }
    /// Coefficients a₃ⱼ of stage 3.
    Stage3 {
        0 => 0.075,
        newest 1 => 0.225
    }
    /// Coefficients a₄ⱼ of stage 4.
    Stage4 {
        0 => 0.9777777777777777,
        1 => -3.7333333333333334,
        newest 2 => 3.5555555555555554
    }
    /// Coefficients a₅ⱼ of stage 5.
    Stage5 {
        0 => 2.9525986892242035,
        1 => -11.595793324188385,
        2 => 9.822892851699436,
        newest 3 => -0.2908093278463649
    }
    /// Coefficients a₆ⱼ of stage 6.
    Stage6 {
        0 => 2.8462752525252526,
        1 => -10.757575757575758,
        2 => 8.906422717743473,
        3 => 0.2784090909090909,
        newest 4 => -0.2735313036020583
    }
    /// Weights of the solution of order 5.
    Weights {
        0 => 0.09114583333333333,
        2 => 0.44923629829290207,
        3 => 0.6510416666666666,
        4 => -0.322376179245283,
        newest 5 => 0.13095238095238096
    }
    /// Differences of the weights of the solution of order 5 and of the embedded solution of order 4.
    Error4 {
        0 => 0.0012326388888888888,
        2 => -0.0042527702905061394,
        3 => 0.03697916666666667,
        4 => -0.05086379716981132,
        5 => 0.0419047619047619,
        newest 6 => -0.025
    }
    /// Weights of coefficient 5 of the dense output.
    Dense5 {
        0 => -1.1270175653862835,
        2 => 2.675424484351598,
        3 => -5.685526961588504,
        4 => 3.5219323679207912,
        5 => -1.7672812570757455,
        newest 6 => 2.382468931778144
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dormand_prince::tableau::Row;

    /// Coefficients of the stages 2 to 7 as a dense matrix.
    fn stages() -> [[f64; 7]; 7] {
        let mut a = [[0.0; 7]; 7];
        let rows =
            [Stage2::TERMS, Stage3::TERMS, Stage4::TERMS, Stage5::TERMS, Stage6::TERMS, Weights::TERMS];
        for (row, terms) in a[1..].iter_mut().zip(rows) {
            terms.iter().for_each(|(j, value)| row[*j] = *value);
        }
        a
    }

    fn apply(v: [f64; 7]) -> [f64; 7] {
        stages().map(|row| row.iter().zip(v).map(|(a, v)| a * v).sum())
    }

    fn weigh(v: [f64; 7]) -> f64 {
        stages()[6].iter().zip(v).map(|(b, v)| b * v).sum()
    }

    fn product(a: [f64; 7], b: [f64; 7]) -> [f64; 7] {
        std::array::from_fn(|i| a[i] * b[i])
    }

    #[test]
    fn all_seventeen_conditions_of_order_5_hold_and_one_of_order_6_does_not() {
        // Hairer, Nørsett, Wanner, table II.2.2: Φ(t) = 1/γ(t) for every rooted tree of up to five nodes.
        let (one, c) = ([1.0; 7], NODES);
        let (c2, c3) = (product(c, c), product(c, product(c, c)));
        let (ac, ac2, ac3, aac) = (apply(c), apply(c2), apply(c3), apply(apply(c)));
        let conditions = [
            (one, 1.0),
            (c, 2.0),
            (c2, 3.0),
            (ac, 6.0),
            (c3, 4.0),
            (product(c, ac), 8.0),
            (ac2, 12.0),
            (aac, 24.0),
            (product(c3, c), 5.0),
            (product(c2, ac), 10.0),
            (product(ac, ac), 20.0),
            (product(c, ac2), 15.0),
            (ac3, 20.0),
            (product(c, aac), 30.0),
            (apply(product(c, ac)), 40.0),
            (apply(ac2), 60.0),
            (apply(aac), 120.0),
        ];
        for (k, (tree, order)) in conditions.into_iter().enumerate() {
            assert!((weigh(tree) * order - 1.0).abs() < 1e-13, "{k}: {}", weigh(tree) * order);
        }
        assert!((weigh(product(c3, c2)) * 6.0 - 1.0).abs() > 1e-4);
        // Rows sum to their nodes, differences to zero.
        for (row, node) in stages().into_iter().zip(NODES) {
            assert!((row.iter().sum::<f64>() - node).abs() < 1e-14, "{node}");
        }
        for terms in [Error4::TERMS, Dense5::TERMS] {
            assert!(terms.iter().map(|(_, a)| a).sum::<f64>().abs() < 1e-14);
        }
    }
}
