//! Factor `κ_n` between a power law and its one-dimensional profile.

/// Returns `κ_n` = √π Γ(n/2+1)/Γ((n+1)/2) of (4.20) for n > 0: f = A rⁿ has g = `κ_n` A |x|ⁿ; κ₁ = π/2, κ₂ = 2, κ₄ = 8/3.
// Products for small integers n, exact to rounding; otherwise a series of the quotient, which is more accurate than logarithms of Γ.
pub(crate) fn kappa(n: f64) -> f64 {
    const LARGEST_BY_RECURSION: f64 = 16.0;
    if n.fract() == 0.0 && n <= LARGEST_BY_RECURSION {
        return kappa_of_integer(n);
    }
    std::f64::consts::PI.sqrt() * gamma_ratio(0.5 * (n + 1.0))
}

/// Returns `κ_n` = κ_{n-2} n/(n-1) from κ₁ = π/2 or κ₂ = 2.
fn kappa_of_integer(n: f64) -> f64 {
    let odd = n % 2.0 == 1.0;
    let (mut k, mut top, mut bottom) = if odd { (1.0, 1.0, 1.0) } else { (2.0, 2.0, 1.0) };
    while k < n {
        k += 2.0;
        top *= k;
        bottom *= k - 1.0;
    }
    let ratio = top / bottom;
    if odd { std::f64::consts::FRAC_PI_2 * ratio } else { ratio }
}

/// Returns Γ(z+½)/Γ(z), z > 0.
///
/// The recurrence Γ(z+1) = zΓ(z) leads to z ≥ 10. For z ≥ 10 the asymptotic series in w = z - ¼ has even powers only (Tricomi and
/// Erdélyi, Pacific J. Math. 1, 1951) and a truncation error below 1e-17.
fn gamma_ratio(z: f64) -> f64 {
    const SERIES: [f64; 8] = [
        1.0,
        1.0 / 64.0,
        -19.0 / 8192.0,
        631.0 / 524_288.0,
        -174_317.0 / 134_217_728.0,
        2.3855575127527117e-3,
        -6.670963462056534e-3,
        2.6412154660064857e-2,
    ];
    let (mut z, mut top, mut bottom) = (z, 1.0, 1.0);
    while z < 10.0 {
        top *= z;
        bottom *= z + 0.5;
        z += 1.0;
    }
    let w = z - 0.25;
    let step = 1.0 / (w * w);
    let series = SERIES.iter().rev().fold(0.0, |sum, c| sum * step + c);
    w.sqrt() * series * (top / bottom)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_has_the_handbooks_values() {
        // mpmath, 60 digits: sqrt(pi)*gamma(n/2+1)/gamma((n+1)/2)
        let table = [
            (0.5, 1.3110287771460598),
            (1.0, std::f64::consts::FRAC_PI_2),
            (1.5, 1.7972103521033884),
            (2.0, 2.0),
            (2.5, 2.1850479619101),
            (3.0, 2.356194490192345),
            (4.0, 8.0 / 3.0),
            (5.0, 2.9452431127404313),
            (6.0, 3.2),
            (7.25, 3.4926748391209403),
            (40.0, 7.97634613789762),
            (1000.5, 39.65308713423167),
        ];
        for (n, expected) in table {
            approx::assert_relative_eq!(kappa(n), expected, max_relative = 1e-15);
        }
    }
}
