//! Coefficients of the Runge–Kutta–Nyström pair RKN8(6)9.
//!
//! Source: J. R. Dormand, M. E. A. El-Mikkawy, P. J. Prince, *High-order embedded Runge–Kutta–Nyström formulae*, IMA Journal of
//! Numerical Analysis 7 (1987) 423–430.
//!
//! Stage i has the position x + c_i h v + h² Σ a_ij k_j, with the accelerations k_j. The end of the step is x + h v + h² Σ b_j k_j and v +
//! h Σ b'_j k_j. The last stage is at the end of the step, with the weights b as its row; the next step reuses its acceleration. Fractions
//! are those of the paper.

/// Number of stages; the last stage is the first one of the next step.
pub(super) const STAGES: usize = 9;
/// Index of the stage at the end of the step.
pub(super) const END: usize = 8;

/// Nodes c.
pub(super) const NODES: [f64; STAGES] = [0.0, 0.05, 0.1, 0.3, 0.5, 0.7, 0.9, 1.0, 1.0];

/// Coefficients of the stage positions: x(c) = x + c h v + h² Σ a k.
pub(super) const POSITIONS: [[f64; 8]; STAGES] = [
    [0.0; 8],
    [1.0 / 800.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    [1.0 / 600.0, 1.0 / 300.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    [9.0 / 200.0, -9.0 / 100.0, 9.0 / 100.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    [-66701.0 / 197352.0, 28325.0 / 32892.0, -2665.0 / 5482.0, 2170.0 / 24669.0, 0.0, 0.0, 0.0, 0.0],
    [
        227015747.0 / 304251000.0,
        -54897451.0 / 30425100.0,
        12942349.0 / 10141700.0,
        -9499.0 / 304251.0,
        539.0 / 9250.0,
        0.0,
        0.0,
        0.0,
    ],
    [
        -1131891597.0 / 901789000.0,
        41964921.0 / 12882700.0,
        -6663147.0 / 3220675.0,
        270954.0 / 644135.0,
        -108.0 / 5875.0,
        114.0 / 1645.0,
        0.0,
        0.0,
    ],
    [
        13836959.0 / 3667458.0,
        -17731450.0 / 1833729.0,
        1063919505.0 / 156478208.0,
        -33213845.0 / 39119552.0,
        13335.0 / 28544.0,
        -705.0 / 14272.0,
        1645.0 / 57088.0,
        0.0,
    ],
    [
        223.0 / 7938.0,
        0.0,
        1175.0 / 8064.0,
        925.0 / 6048.0,
        41.0 / 448.0,
        925.0 / 14112.0,
        1175.0 / 72576.0,
        0.0,
    ],
];

/// Weights of the velocity at the end of the step, order 8: v + h Σ b' k.
pub(super) const VELOCITY: [f64; STAGES] = [
    223.0 / 7938.0,
    0.0,
    5875.0 / 36288.0,
    4625.0 / 21168.0,
    41.0 / 224.0,
    4625.0 / 21168.0,
    5875.0 / 36288.0,
    223.0 / 7938.0,
    0.0,
];

/// Weights of the position of order 8 minus weights of order 6.
pub(super) const POSITION_ERROR: [f64; STAGES] = [
    -544307.0 / 12215700.0,
    0.0,
    544307.0 / 4963840.0,
    -544307.0 / 3722880.0,
    1632921.0 / 12409600.0,
    -544307.0 / 8686720.0,
    544307.0 / 44674560.0,
    0.0,
    0.0,
];

/// Weights of the velocity of order 8 minus weights of order 6.
pub(super) const VELOCITY_ERROR: [f64; STAGES] = [
    -544307.0 / 12215700.0,
    0.0,
    544307.0 / 4467456.0,
    -544307.0 / 2606016.0,
    1632921.0 / 6204800.0,
    -544307.0 / 2606016.0,
    544307.0 / 4467456.0,
    322012.0 / 3053925.0,
    -3.0 / 20.0,
];

/// Number of nodes of the dense output, whose acceleration is a polynomial of degree 6.
pub(super) const SAMPLES: usize = 7;
/// Stages at the nodes 0, 0.1, 0.3, 0.5, 0.7, 0.9 and 1 of the dense output.
pub(super) const SAMPLED: [usize; SAMPLES] = [0, 2, 3, 4, 5, 6, END];
/// Samples at which accelerations are evaluated again, because the stages there have only order 4.
pub(super) const REFINED: std::ops::Range<usize> = 2..6;

/// Monomial coefficients of the polynomial through the samples, given by the inverse Vandermonde matrix of the nodes.
// Monomials have simple integrals. The coefficients are exact fractions; their size costs three digits of the highest power.
const MONOMIALS: [[f64; SAMPLES]; SAMPLES] = [
    [1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    [-1189.0 / 63.0, 875.0 / 32.0, -125.0 / 8.0, 189.0 / 16.0, -375.0 / 56.0, 875.0 / 288.0, -1.0],
    [
        22378.0 / 189.0,
        -69875.0 / 288.0,
        122375.0 / 504.0,
        -3189.0 / 16.0,
        19625.0 / 168.0,
        -46625.0 / 864.0,
        1126.0 / 63.0,
    ],
    [
        -65000.0 / 189.0,
        87625.0 / 108.0,
        -131125.0 / 126.0,
        1000.0,
        -78875.0 / 126.0,
        32375.0 / 108.0,
        -19000.0 / 189.0,
    ],
    [
        32000.0 / 63.0,
        -139375.0 / 108.0,
        40000.0 / 21.0,
        -4125.0 / 2.0,
        88750.0 / 63.0,
        -25625.0 / 36.0,
        46000.0 / 189.0,
    ],
    [
        -10000.0 / 27.0,
        53125.0 / 54.0,
        -100000.0 / 63.0,
        1875.0,
        -12500.0 / 9.0,
        40625.0 / 54.0,
        -50000.0 / 189.0,
    ],
    [
        20000.0 / 189.0,
        -15625.0 / 54.0,
        31250.0 / 63.0,
        -625.0,
        31250.0 / 63.0,
        -15625.0 / 54.0,
        20000.0 / 189.0,
    ],
];

/// Coefficients of the integral up to θ of the polynomial through the samples, divided by θ. Each sample has one row.
pub(super) const INTEGRALS: [[f64; SAMPLES]; SAMPLES] = {
    let mut columns = [[0.0; SAMPLES]; SAMPLES];
    let mut j = 0;
    while j < SAMPLES {
        let mut sample = 0;
        while sample < SAMPLES {
            columns[sample][j] = MONOMIALS[j][sample] / (j + 1) as f64;
            sample += 1;
        }
        j += 1;
    }
    columns
};

/// Coefficients of the double integral, divided by θ², at the refined nodes: x(θ) = x + θh(v + θh Σ w k).
pub(super) const REFINED_POSITIONS: [[f64; SAMPLES]; REFINED.end - REFINED.start] = {
    let mut rows = [[0.0; SAMPLES]; REFINED.end - REFINED.start];
    let mut r = 0;
    while r < rows.len() {
        let node = NODES[SAMPLED[REFINED.start + r]];
        let mut sample = 0;
        while sample < SAMPLES {
            let mut sum = 0.0;
            let mut j = SAMPLES;
            while j > 0 {
                j -= 1;
                sum = sum * node + INTEGRALS[sample][j] / (j + 2) as f64;
            }
            rows[r][sample] = sum;
            sample += 1;
        }
        r += 1;
    }
    rows
};
