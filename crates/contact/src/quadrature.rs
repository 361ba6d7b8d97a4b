//! Numerical quadrature.

/// Five-point Gauss–Legendre rule on [-1, 1]: nodes and half of their weights. The weighted sum is the mean of the function.
///
/// The rule is exact for polynomials up to degree 9.
pub(crate) const GAUSS: [(f64, f64); 5] = [
    (-0.906_179_845_938_664, 0.118_463_442_528_094_54),
    (-0.538_469_310_105_683_1, 0.239_314_335_249_683_24),
    (0.0, 0.284_444_444_444_444_44),
    (0.538_469_310_105_683_1, 0.239_314_335_249_683_24),
    (0.906_179_845_938_664, 0.118_463_442_528_094_54),
];

/// Integrates f over a range with the five-point Gauss–Legendre rule.
pub fn gauss([from, to]: [f64; 2], f: impl Fn(f64) -> f64) -> f64 {
    let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
    (to - from) * GAUSS.iter().map(|(x, weight)| weight * f(middle + half * x)).sum::<f64>()
}

/// Gauss–Kronrod rule with 15 points: nodes on [0, 1), their Kronrod weights and their weights in the 7-point Gauss rule.
// QUADPACK's QK15 (Piessens et al. 1983). The negative nodes are mirror images.
const KRONROD: [(f64, f64, f64); 8] = [
    (0.991_455_371_120_812_6, 0.022_935_322_010_529_224, 0.0),
    (0.949_107_912_342_758_5, 0.063_092_092_629_978_55, 0.129_484_966_168_869_7),
    (0.864_864_423_359_769_1, 0.104_790_010_322_250_18, 0.0),
    (0.741_531_185_599_394_4, 0.140_653_259_715_525_92, 0.279_705_391_489_276_65),
    (0.586_087_235_467_691_1, 0.169_004_726_639_267_9, 0.0),
    (0.405_845_151_377_397_2, 0.190_350_578_064_785_4, 0.381_830_050_505_118_9),
    (0.207_784_955_007_898_47, 0.204_432_940_075_298_9, 0.0),
    (0.0, 0.209_482_141_084_727_83, 0.417_959_183_673_469_4),
];

/// Integrates f over a range with the 15-point Gauss–Kronrod rule. Returns the integral and its difference to the 7-point Gauss rule.
///
/// For a smooth f the difference is much larger than the error.
pub(crate) fn kronrod([from, to]: [f64; 2], f: impl Fn(f64) -> f64) -> (f64, f64) {
    let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
    let (mut fine, mut coarse) = (0.0, 0.0);
    for (node, weight, gauss) in KRONROD {
        let sum = if node == 0.0 { f(middle) } else { f(middle - half * node) + f(middle + half * node) };
        fine += weight * sum;
        coarse += gauss * sum;
    }
    (half * fine, (half * (fine - coarse)).abs())
}

/// Twelve-point Gauss–Legendre rule on [-1, 1]: nodes and half of their weights, exact up to degree 23.
pub(crate) const GAUSS_12: [(f64, f64); 12] = [
    (-0.981_560_634_246_719_2, 0.023_587_668_193_255_914),
    (-0.904_117_256_370_474_9, 0.053_469_662_997_659_21),
    (-0.769_902_674_194_304_7, 0.080_039_164_271_673_11),
    (-0.587_317_954_286_617_5, 0.101_583_713_361_532_96),
    (-0.367_831_498_998_180_2, 0.116_746_268_269_177_4),
    (-0.125_233_408_511_468_9, 0.124_573_522_906_701_39),
    (0.125_233_408_511_468_9, 0.124_573_522_906_701_39),
    (0.367_831_498_998_180_2, 0.116_746_268_269_177_4),
    (0.587_317_954_286_617_5, 0.101_583_713_361_532_96),
    (0.769_902_674_194_304_7, 0.080_039_164_271_673_11),
    (0.904_117_256_370_474_9, 0.053_469_662_997_659_21),
    (0.981_560_634_246_719_2, 0.023_587_668_193_255_914),
];
