//! The rounding error of one operation, exactly.
//!
//! The error of a sum and of a product of two doubles is a double, and so is the remainder of a quotient and of a square
//! root: T. J. Dekker, "A floating-point technique for extending the available precision" (1971). Where the numbers are
//! so small or so large that such a step would underflow or overflow, the error is at most half an ulp of the result.

/// 2^-53: the largest relative error of an operation in doubles.
pub(crate) const UNIT: f64 = f64::EPSILON / 2.0;

/// 2^-1074: the smallest positive double, twice the largest error of an operation that underflows.
pub(crate) const TINY: f64 = f64::from_bits(1);

/// 2^-960 and 2^990: between them Dekker's steps neither underflow nor overflow. The smallest digit of a product is at
/// least 2^-106 times the product, and the factor 2^27 + 1 of `halves` is below 2^28.
const RANGE: [f64; 2] = [f64::from_bits(0x03f0_0000_0000_0000), f64::from_bits(0x7dd0_0000_0000_0000)];

/// True if all magnitudes are in the range of Dekker's steps.
#[inline]
fn are_moderate<const N: usize>(numbers: [f64; N]) -> bool {
    numbers.iter().fold(true, |all, number| all & (number.abs() >= RANGE[0]) & (number.abs() <= RANGE[1]))
}

/// Half an ulp of a result, or what it may lose by underflow; infinite or NaN if the result is.
#[inline]
pub(crate) fn half_ulp(result: f64) -> f64 {
    UNIT * result.abs() + TINY
}

/// |a + b - sum|: D. E. Knuth. NaN if the sum overflows.
#[inline]
pub(crate) fn of_sum(a: f64, b: f64, sum: f64) -> f64 {
    let part = sum - a;
    ((a - (sum - part)) + (b - part)).abs()
}

/// Splits a double into its upper 26 bits and the rest, by a product with 2^27 + 1: products of such halves are exact.
#[inline]
fn halves(a: f64) -> (f64, f64) {
    let scaled = 134_217_729.0 * a;
    let high = scaled - (scaled - a);
    (high, a - high)
}

/// a b - product, exactly, in the range.
#[inline]
fn rest(a: f64, b: f64, product: f64) -> f64 {
    let ((a, c), (b, d)) = (halves(a), halves(b));
    ((a * b - product) + a * d + c * b) + c * d
}

/// |a b - product|.
#[inline]
pub(crate) fn of_product(a: f64, b: f64, product: f64) -> f64 {
    if are_moderate([a, b, product]) {
        rest(a, b, product).abs()
    } else if a == 0.0 || b == 0.0 {
        // Zero, or NaN times infinity.
        product.abs()
    } else {
        half_ulp(product)
    }
}

/// |a - quotient b|.
#[inline]
pub(crate) fn of_quotient(a: f64, b: f64, quotient: f64) -> f64 {
    let product = quotient * b;
    if are_moderate([a, b, quotient, product]) {
        // The difference of numbers an ulp apart is exact, and so is the remainder.
        ((a - product) - rest(quotient, b, product)).abs()
    } else if a == 0.0 {
        product.abs()
    } else {
        half_ulp(quotient) * b.abs() + TINY
    }
}

/// a + b and its rounding error: D. E. Knuth.
#[inline]
fn two_sum(a: f64, b: f64) -> [f64; 2] {
    let sum = a + b;
    let part = sum - a;
    [sum, (a - (sum - part)) + (b - part)]
}

/// |x^2 + y^2 - length^2|; `None` out of the range.
///
/// The three squares and the two sums have five rounding errors, each at most u length^2 but for its factor near one; their
/// sum has four of at most 5 u^2 length^2, and the last sum one of itself.
#[inline]
pub(crate) fn of_length(x: f64, y: f64, length: f64) -> Option<f64> {
    let square = |number: f64| [number * number, rest(number, number, number * number)];
    let [[x2, a], [y2, b], [z2, c]] = [x, y, length].map(square);
    let (large, small) = if x2 < y2 { (y2, x2) } else { (x2, y2) };
    let [first, d] = two_sum(large, -z2);
    let [second, e] = two_sum(first, small);
    let residual = (second + ((a + b - c) + (d + e))).abs();
    let slack = 32.0 * UNIT * UNIT * z2;
    are_moderate([x, y, length, x2, y2, z2]).then_some(residual * (1.0 + 4.0 * UNIT) + slack)
}

/// |a - root^2|.
#[inline]
pub(crate) fn of_root(a: f64, root: f64) -> f64 {
    let square = root * root;
    if are_moderate([a, root, square]) {
        ((a - square) - rest(root, root, square)).abs()
    } else {
        // |a - root^2| = |sqrt(a) - root| (sqrt(a) + root), and the factors are at most an ulp of the root and 2.5 root.
        2.5 * UNIT * a + TINY
    }
}
