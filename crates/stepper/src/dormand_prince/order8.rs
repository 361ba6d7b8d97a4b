//! Coefficients of the explicit Runge–Kutta method DOP853.
//!
//! Source: E. Hairer, S. P. Nørsett, G. Wanner, *Solving Ordinary Differential Equations I*, 2nd ed., Springer 1993, section II.5
//! (method of order 8 by Dormand and Prince with 12 stages), section II.6 (dense output of order 7) and section II.10 (estimators of order
//! 5 and 3). The numbers are those of the authors' program DOP853, rounded to the nearest double.
//!
//! Stage i has the state y + h Σ a_ij k_j at the time t + c_i h; the end of the step is y + h Σ b_i k_i. Stages 1 to 12 give the step. k₁₃
//! is the slope at the end of the step; stages 14 to 16 serve the dense output. Tests compare the rows with order conditions: Σ_j a_ij =
//! c_i, Σ b_i c_i^{q-1} = 1/q, and conditions of taller trees.

use super::tableau::rows;

/// Index of the slope at the end of the step (k₁₃).
pub(super) const END: usize = 12;

/// Nodes c of all stages, as fractions of the step.
// The crate `ode_solvers` 0.6.2 has 0 as the twelfth node: that method has no order where slopes depend on time.
pub(super) const NODES: [f64; 16] = [
    0.0,
    0.05260015195876773,
    0.0789002279381516,
    0.1183503419072274,
    0.2816496580927726,
    0.3333333333333333,
    0.25,
    0.3076923076923077,
    0.6512820512820513,
    0.6,
    0.8571428571428571,
    1.0,
    1.0,
    0.1,
    0.2,
    0.7777777777777778,
];

rows! {
    /// Coefficients a₂ⱼ of stage 2.
    Stage2 {
        newest 0 => 0.05260015195876773
    }
    /// Coefficients a₃ⱼ of stage 3.
    Stage3 {
        0 => 0.0197250569845379,
        newest 1 => 0.0591751709536137
    }
    /// Coefficients a₄ⱼ of stage 4.
    Stage4 {
        0 => 0.02958758547680685,
        newest 2 => 0.08876275643042054
    }
    /// Coefficients a₅ⱼ of stage 5.
    Stage5 {
        0 => 0.2413651341592667,
        2 => -0.8845494793282861,
        newest 3 => 0.924834003261792
    }
    /// Coefficients a₆ⱼ of stage 6.
    Stage6 {
        0 => 0.037037037037037035,
        3 => 0.17082860872947386,
        newest 4 => 0.12546768756682242
    }
    /// Coefficients a₇ⱼ of stage 7.
    Stage7 {
        0 => 0.037109375,
        3 => 0.17025221101954405,
        4 => 0.06021653898045596,
        newest 5 => -0.017578125
    }
    /// Coefficients a₈ⱼ of stage 8.
    Stage8 {
        0 => 0.03709200011850479,
        3 => 0.17038392571223998,
        4 => 0.10726203044637328,
        5 => -0.015319437748624402,
        newest 6 => 0.008273789163814023
    }
    /// Coefficients a₉ⱼ of stage 9.
    Stage9 {
        0 => 0.6241109587160757,
        3 => -3.3608926294469414,
        4 => -0.868219346841726,
        5 => 27.59209969944671,
        6 => 20.154067550477894,
        newest 7 => -43.48988418106996
    }
    /// Coefficients of stage 10.
    Stage10 {
        0 => 0.47766253643826434,
        3 => -2.4881146199716677,
        4 => -0.590290826836843,
        5 => 21.230051448181193,
        6 => 15.279233632882423,
        7 => -33.28821096898486,
        newest 8 => -0.020331201708508627
    }
    /// Coefficients of stage 11.
    Stage11 {
        0 => -0.9371424300859873,
        3 => 5.186372428844064,
        4 => 1.0914373489967295,
        5 => -8.149787010746927,
        6 => -18.52006565999696,
        7 => 22.739487099350505,
        8 => 2.4936055526796523,
        newest 9 => -3.0467644718982196
    }
    /// Coefficients of stage 12.
    Stage12 {
        0 => 2.273310147516538,
        3 => -10.53449546673725,
        4 => -2.0008720582248625,
        5 => -17.9589318631188,
        6 => 27.94888452941996,
        7 => -2.8589982771350235,
        8 => -8.87285693353063,
        9 => 12.360567175794303,
        newest 10 => 0.6433927460157636
    }
    /// Weights of the solution of order 8.
    Weights {
        0 => 0.054293734116568765,
        5 => 4.450312892752409,
        6 => 1.8915178993145003,
        7 => -5.801203960010585,
        8 => 0.3111643669578199,
        9 => -0.1521609496625161,
        10 => 0.20136540080403034,
        newest 11 => 0.04471061572777259
    }
    /// Differences of the weights of the solution of order 8 and of the embedded solution of order 5.
    Error5 {
        0 => 0.01312004499419488,
        5 => -1.2251564463762044,
        6 => -0.4957589496572502,
        7 => 1.6643771824549864,
        8 => -0.35032884874997366,
        9 => 0.3341791187130175,
        10 => 0.08192320648511571,
        newest 11 => -0.022355307863886294
    }
    /// Differences of the weights of the solution of order 8 and of the embedded solution of order 3.
    Error3 {
        0 => -0.18980075407240762,
        5 => 4.450312892752409,
        6 => 1.8915178993145003,
        7 => -5.801203960010585,
        8 => -0.4226823213237919,
        9 => -0.1521609496625161,
        10 => 0.20136540080403034,
        newest 11 => 0.02265179219836082
    }
    /// Coefficients of stage 14, for the dense output only.
    Stage14 {
        0 => 0.056167502283047954,
        6 => 0.25350021021662483,
        7 => -0.2462390374708025,
        8 => -0.12419142326381637,
        9 => 0.15329179827876568,
        10 => 0.00820105229563469,
        11 => 0.007567897660545699,
        newest 12 => -0.008298
    }
    /// Coefficients of stage 15, for the dense output only.
    Stage15 {
        0 => 0.03183464816350214,
        5 => 0.028300909672366776,
        6 => 0.053541988307438566,
        7 => -0.05492374857139099,
        10 => -0.00010834732869724932,
        11 => 0.0003825710908356584,
        12 => -0.00034046500868740456,
        newest 13 => 0.1413124436746325
    }
    /// Coefficients of stage 16, for the dense output only.
    Stage16 {
        0 => -0.42889630158379194,
        5 => -4.697621415361164,
        6 => 7.683421196062599,
        7 => 4.06898981839711,
        8 => 0.3567271874552811,
        12 => -0.0013990241651590145,
        13 => 2.9475147891527724,
        newest 14 => -9.15095847217987
    }
    /// Weights of coefficient 5 of the dense output.
    Dense5 {
        0 => -8.428938276109013,
        5 => 0.5667149535193777,
        6 => -3.0689499459498917,
        7 => 2.38466765651207,
        8 => 2.117034582445028,
        9 => -0.871391583777973,
        10 => 2.2404374302607883,
        11 => 0.6315787787694688,
        12 => -0.08899033645133331,
        13 => 18.148505520854727,
        14 => -9.194632392478356,
        newest 15 => -4.436036387594894
    }
    /// Weights of coefficient 6 of the dense output.
    Dense6 {
        0 => 10.427508642579134,
        5 => 242.28349177525817,
        6 => 165.20045171727028,
        7 => -374.5467547226902,
        8 => -22.113666853125306,
        9 => 7.733432668472264,
        10 => -30.674084731089398,
        11 => -9.332130526430229,
        12 => 15.697238121770845,
        13 => -31.139403219565178,
        14 => -9.35292435884448,
        newest 15 => 35.81684148639408
    }
    /// Weights of coefficient 7 of the dense output.
    Dense7 {
        0 => 19.985053242002433,
        5 => -387.0373087493518,
        6 => -189.17813819516758,
        7 => 527.8081592054236,
        8 => -11.57390253995963,
        9 => 6.8812326946963,
        10 => -1.0006050966910838,
        11 => 0.7777137798053443,
        12 => -2.778205752353508,
        13 => -60.19669523126412,
        14 => 84.32040550667716,
        newest 15 => 11.99229113618279
    }
    /// Weights of coefficient 8 of the dense output.
    Dense8 {
        0 => -25.69393346270375,
        5 => -154.18974869023643,
        6 => -231.5293791760455,
        7 => 357.6391179106141,
        8 => 93.40532418362432,
        9 => -37.45832313645163,
        10 => 104.0996495089623,
        11 => 29.8402934266605,
        12 => -43.53345659001114,
        13 => 96.32455395918828,
        14 => -39.17726167561544,
        newest 15 => -149.72683625798564
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dormand_prince::tableau::Row;

    fn sum<R: Row>() -> f64 {
        R::TERMS.iter().map(|term| term.1).sum()
    }

    /// Coefficients of the stages 2 to 12 as a dense matrix.
    fn stages() -> [[f64; 12]; 12] {
        let mut a = [[0.0; 12]; 12];
        let rows: [&[(usize, f64)]; 11] = [
            Stage2::TERMS,
            Stage3::TERMS,
            Stage4::TERMS,
            Stage5::TERMS,
            Stage6::TERMS,
            Stage7::TERMS,
            Stage8::TERMS,
            Stage9::TERMS,
            Stage10::TERMS,
            Stage11::TERMS,
            Stage12::TERMS,
        ];
        for (row, terms) in a[1..].iter_mut().zip(rows) {
            for (j, value) in terms {
                row[*j] = *value;
            }
        }
        a
    }

    fn weights() -> [f64; 12] {
        let mut b = [0.0; 12];
        for (j, value) in Weights::TERMS {
            b[*j] = *value;
        }
        b
    }

    #[test]
    fn rows_sum_to_their_nodes() {
        let a = stages();
        for (row, node) in a.iter().zip(NODES) {
            // Coefficients rounded to doubles leave half an ulp each, their sum as much again.
            let size: f64 = row.iter().map(|a| a.abs()).sum();
            let rounding = 2.0 * f64::EPSILON * size.max(1.0);
            assert!((row.iter().sum::<f64>() - node).abs() <= rounding, "{node}");
        }
        for (sum, node) in
            [sum::<Stage14>(), sum::<Stage15>(), sum::<Stage16>()].into_iter().zip(&NODES[13..])
        {
            assert!((sum - node).abs() < 2e-15);
        }
        // The twelfth node, which another implementation has as 0.
        assert_eq!(NODES[11], 1.0);
        for difference in [sum::<Error5>(), sum::<Error3>(), sum::<Dense5>(), sum::<Dense8>()] {
            assert!(difference.abs() < 1e-13, "{difference}");
        }
    }

    #[test]
    fn quadrature_conditions_up_to_order_8() {
        // Σ b_i c_i^(q-1) = 1/q for q ≤ 8; not for 9.
        let moment = |q: i32| weights().iter().zip(NODES).map(|(b, c)| b * c.powi(q - 1)).sum::<f64>();
        for q in 1..=8 {
            assert!((moment(q) * f64::from(q) - 1.0).abs() < 2e-14, "{q}");
        }
        assert!((moment(9) * 9.0 - 1.0).abs() > 1e-6);
    }

    #[test]
    fn tree_conditions_up_to_order_8() {
        // The tall trees b A^(q-1) 1 = 1/q!, and Σ b_i c_i^p (A c^m)_i = 1/((m+1)(p+m+2)) for p + m + 2 ≤ 8.
        let (a, b) = (stages(), weights());
        let apply = |v: [f64; 12]| a.map(|row| row.iter().zip(v).map(|(a, v)| a * v).sum::<f64>());
        let dot = |v: [f64; 12]| b.iter().zip(v).map(|(b, v)| b * v).sum::<f64>();
        let (mut tall, mut factorial) = ([1.0; 12], 1.0);
        for q in 1..=8 {
            factorial *= f64::from(q);
            assert!((dot(tall) * factorial - 1.0).abs() < 1e-11, "{q}");
            tall = apply(tall);
        }
        for m in 1..=6 {
            let mut power = [0.0; 12];
            power.iter_mut().zip(NODES).for_each(|(v, c)| *v = c.powi(m));
            let inner = apply(power);
            for p in 0..=(6 - m) {
                let mut v = inner;
                v.iter_mut().zip(NODES).for_each(|(v, c)| *v *= c.powi(p));
                let exact = 1.0 / f64::from((m + 1) * (p + m + 2));
                assert!((dot(v) - exact).abs() < 1e-13, "m {m} p {p}");
            }
        }
    }
}
