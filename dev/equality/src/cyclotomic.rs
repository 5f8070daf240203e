//! Roots of unity: zeta = exp(2 pi i / N) and its powers in the basis 1, zeta, ... zeta^(phi(N) - 1).
//!
//! The minimal polynomial of zeta is the cyclotomic polynomial `Phi_N`, so the basis is one over
//! the rationals, and two combinations of roots of unity are equal iff their coordinates are.

/// The powers of a root of unity.
#[derive(Debug)]
pub(super) struct Cyclotomic {
    /// Row k: zeta^k as (power, coefficient), powers below phi(N).
    rows: Vec<Vec<(u32, i128)>>,
}

impl Cyclotomic {
    /// Builds the powers; the order is a multiple of four, so that i is among them.
    pub(super) fn new(order: u32) -> Self {
        let minimal = minimal_polynomial(order as usize);
        let degree = minimal.len() - 1;
        let mut power = vec![0; degree];
        power[0] = 1;
        let mut rows = Vec::new();
        for _ in 0..order {
            rows.push((0..).zip(&power).filter(|(_, c)| **c != 0).map(|(k, &c)| (k, c)).collect());
            // zeta^degree = -(the lower terms of the minimal polynomial)
            let lead = power[degree - 1];
            power.rotate_right(1);
            power[0] = 0;
            for (coordinate, term) in power.iter_mut().zip(&minimal) {
                *coordinate -= lead * term;
            }
        }
        Self { rows }
    }

    /// N.
    pub(super) fn order(&self) -> u32 {
        u32::try_from(self.rows.len()).unwrap_or(u32::MAX)
    }

    /// zeta^power in the basis.
    pub(super) fn root(&self, power: u32) -> &[(u32, i128)] {
        &self.rows[power as usize % self.rows.len()]
    }
}

/// `Phi_N`, lowest coefficient first.
///
/// - `Phi_1`(x) = x - 1
/// - `Phi_(m p)`(x) = `Phi_m`(x^p) / `Phi_m`(x) for a prime p that does not divide m
/// - `Phi_N`(x) = `Phi_r`(x^(N/r)), r being the product of the primes of N
fn minimal_polynomial(order: usize) -> Vec<i128> {
    let mut polynomial = vec![-1, 1];
    let mut radical = 1;
    for prime in 2..=order {
        if order.is_multiple_of(prime) && (2..prime).all(|d| !prime.is_multiple_of(d)) {
            polynomial = quotient(spread(&polynomial, prime), &polynomial);
            radical *= prime;
        }
    }
    spread(&polynomial, order / radical)
}

/// p(x^step).
fn spread(polynomial: &[i128], step: usize) -> Vec<i128> {
    let mut result = vec![0; (polynomial.len() - 1) * step + 1];
    for (power, &coefficient) in polynomial.iter().enumerate() {
        result[power * step] = coefficient;
    }
    result
}

/// The quotient by a divisor with leading coefficient 1, which leaves no remainder.
fn quotient(mut dividend: Vec<i128>, divisor: &[i128]) -> Vec<i128> {
    let degree = divisor.len() - 1;
    for top in (degree..dividend.len()).rev() {
        let lead = dividend[top];
        for (power, &coefficient) in divisor[..degree].iter().enumerate() {
            dividend[top - degree + power] -= lead * coefficient;
        }
    }
    dividend.split_off(degree)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cyclotomic_polynomials() {
        assert_eq!(minimal_polynomial(4), [1, 0, 1]);
        assert_eq!(minimal_polynomial(12), [1, 0, -1, 0, 1]);
        assert_eq!(minimal_polynomial(105)[7], -2);
    }

    #[test]
    fn rows_have_the_value_of_the_root() {
        for order in [4, 12, 20, 60, 84, 360] {
            let roots = Cyclotomic::new(order);
            let turn = std::f64::consts::TAU / f64::from(order);
            for power in 0..order {
                let [mut re, mut im] = [0.0, 0.0];
                for &(k, coefficient) in roots.root(power) {
                    let angle = turn * f64::from(k);
                    (re, im) = (re + coefficient as f64 * angle.cos(), im + coefficient as f64 * angle.sin());
                }
                let angle = turn * f64::from(power);
                assert!((re - angle.cos()).abs() + (im - angle.sin()).abs() < 1e-12, "{power} of {order}");
            }
        }
    }
}
