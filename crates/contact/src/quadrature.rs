//! Numerical quadrature.

/// Five nodes of Gauss and Legendre on [-1, 1] and half their weights, exact for polynomials up to degree 9: the mean of
/// a function is the weighted sum of its values.
// √h over a strip of 1/16 of its height: three nodes are 5e-13 off, four and five as little as rounding; over a quarter of it
// four are 1.4e-11 off and five 5e-14.
pub(crate) const GAUSS: [(f64, f64); 5] = [
    (-0.906_179_845_938_664, 0.118_463_442_528_094_54),
    (-0.538_469_310_105_683_1, 0.239_314_335_249_683_24),
    (0.0, 0.284_444_444_444_444_44),
    (0.538_469_310_105_683_1, 0.239_314_335_249_683_24),
    (0.906_179_845_938_664, 0.118_463_442_528_094_54),
];
