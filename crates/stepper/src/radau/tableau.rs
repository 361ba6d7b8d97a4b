//! Coefficients of Radau IIA with five stages.
//!
//! The nodes are the zeros of d⁴/dx⁴ [x⁴ (x-1)⁵]. A integrates the Lagrange polynomials of the nodes up to each node; its last row contains
//! the weights. Coefficients were computed to 50 digits and rounded; tests compare them with the order conditions.
//!
//! Source: E. Hairer, G. Wanner, *Solving Ordinary Differential Equations II*, 2nd ed., Springer 1996, section IV.5 (nodes) and
//! IV.8 (estimate).

/// Number of stages.
pub(super) const STAGES: usize = 5;

/// One number per stage.
pub(super) type Stages = [f64; STAGES];

/// Nodes of the stages, as fractions of the step.
pub(super) const NODES: Stages = [
    0.057_104_196_114_517_68,
    0.276_843_013_638_123_8,
    0.583_590_432_368_916_8,
    0.860_240_135_656_219_5,
    1.0,
];

/// Coefficients aᵢⱼ: stage i is at y + h Σ aᵢⱼ kⱼ.
pub(super) const A: [Stages; STAGES] = [
    [
        0.072_998_864_317_903_32,
        -0.026_735_331_107_945_572,
        0.018_676_929_763_984_355,
        -0.012_879_106_093_306_44,
        0.005_042_839_233_882_015,
    ],
    [
        0.153_775_231_479_182_46,
        0.146_214_867_847_493_5,
        -0.036_444_568_905_128_09,
        0.021_233_063_119_304_72,
        -0.007_935_579_902_728_778,
    ],
    [
        0.140_063_045_684_809_88,
        0.298_967_129_491_283_5,
        0.167_585_070_135_248_97,
        -0.033_969_101_686_617_75,
        0.010_944_288_744_192_252,
    ],
    [
        0.144_894_308_109_534_75,
        0.276_500_068_760_159_24,
        0.325_797_922_910_421,
        0.128_756_753_254_909_76,
        -0.015_708_917_378_805_33,
    ],
    [
        0.143_713_560_791_225_95,
        0.281_356_015_149_462_06,
        0.311_826_522_975_741_25,
        0.223_103_901_083_570_73,
        0.04,
    ],
];

/// A², which gives positions from accelerations.
pub(super) const SQUARE: [Stages; STAGES] = square();

/// Weight of the slopes at the start in the error estimate: the real eigenvalue of A.
pub(super) const FIRST: f64 = 0.159_065_844_427_469_1;

/// Weights of the stages in the error estimate. Together with [`FIRST`] they are the quadrature of order 5 on the start and the nodes,
/// minus the quadrature of the method.
pub(super) const ESTIMATE: Stages = [
    -0.252_343_312_249_546_4,
    0.160_357_122_102_969_94,
    -0.116_273_134_340_962_8,
    0.081_006_648_945_564_01,
    -0.031_813_168_885_493_82,
];

const fn square() -> [Stages; STAGES] {
    let mut square = [[0.0; STAGES]; STAGES];
    let mut place = 0;
    while place < STAGES * STAGES * STAGES {
        let (i, j, k) = (place / (STAGES * STAGES), place / STAGES % STAGES, place % STAGES);
        square[i][j] += A[i][k] * A[k][j];
        place += 1;
    }
    square
}

/// Returns the scalar product of two rows of coefficients.
#[inline]
pub(super) fn dot(row: &Stages, k: &Stages) -> f64 {
    row.iter().zip(k).map(|(a, k)| a * k).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn power_sum(row: &Stages, power: i32) -> f64 {
        row.iter().zip(NODES).map(|(a, c)| a * c.powi(power)).sum()
    }

    /// Conditions B(9) and C(5), which imply order 9 (Hairer, Wanner, theorem IV.5.1).
    #[test]
    fn weights_and_stages_integrate_powers() {
        for power in 0..9_i32 {
            let missed = power_sum(&A[STAGES - 1], power) - f64::from(power + 1).recip();
            assert!(missed.abs() < 1e-15, "{power}: {missed:e}");
        }
        for (row, c) in A.iter().zip(NODES) {
            for power in 0..5_i32 {
                let missed = power_sum(row, power) - c.powi(power + 1) / f64::from(power + 1);
                assert!(missed.abs() < 1e-15, "{c} {power}: {missed:e}");
            }
        }
    }

    /// The estimate is the difference of two quadratures: it is zero for powers up to 4 but not for power 5.
    #[test]
    fn the_estimate_integrates_low_powers_to_nothing() {
        for power in 0..6_i32 {
            let start = if power == 0 { FIRST } else { 0.0 };
            let sum = start + power_sum(&ESTIMATE, power);
            assert_eq!(sum.abs() < 1e-15, power < 5, "{power}: {sum:e}");
        }
    }
}
