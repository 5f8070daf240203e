//! Sum, product, quotient and root of doubles, rounded downward and upward.
//!
//! IEEE 754 rounds each to nearest, so that the exact result is between the neighbours of the computed one. The sign of
//! the rounding error says on which side: it is exact by Knuth's TwoSum and Dekker's TwoProduct, and the remainder of a
//! quotient or root is a double (Boldo and Daumas, "Representable correcting terms for possibly underflowing floating
//! point operations", 2003). Where a product of halves could overflow or underflow, both neighbours are taken.

use linkage_double::DoubleDouble;

/// 2^-900 and 2^900: with operands and results of such magnitudes, no step of TwoProduct overflows or underflows.
const EXACT: [f64; 2] = [f64::from_bits(0x07b0_0000_0000_0000), f64::from_bits(0x7830_0000_0000_0000)];

/// A rounded number.
#[derive(Clone, Copy)]
pub(super) struct Rounded {
    value: f64,
    /// It has the sign of the exact number less `value`; NaN if that is not known.
    rest: f64,
}

impl Rounded {
    /// A lower bound of the exact number, which is the largest there is if the rounding error is known. An overflow gives
    /// the largest double.
    pub(super) fn down(self) -> f64 {
        if self.rest >= 0.0 { self.value } else { self.value.next_down() }
    }

    /// An upper bound, as `down`.
    pub(super) fn up(self) -> f64 {
        if self.rest <= 0.0 { self.value } else { self.value.next_up() }
    }
}

fn is_safe(numbers: [f64; 3]) -> bool {
    let [least, most] = EXACT;
    numbers.iter().all(|number| (least..=most).contains(&number.abs()))
}

pub(super) fn sum(a: f64, b: f64) -> Rounded {
    let sum = DoubleDouble::sum(a, b);
    Rounded { value: sum.high(), rest: sum.low() }
}

/// The product of bounds, where 0 times infinity is 0: the other factor takes only finite values.
pub(super) fn product(a: f64, b: f64) -> Rounded {
    if a == 0.0 || b == 0.0 {
        return Rounded { value: 0.0, rest: 0.0 };
    }
    let value = a * b;
    let rest = match value {
        0.0 => a.signum() * b.signum(),
        _ if is_safe([a, b, value]) => DoubleDouble::product(a, b).low(),
        _ => f64::NAN,
    };
    Rounded { value, rest }
}

/// The quotient of bounds, of which at most one is infinite and the second is not zero.
pub(super) fn quotient(a: f64, b: f64) -> Rounded {
    let value = a / b;
    if a == 0.0 || b.is_infinite() {
        return Rounded { value: 0.0, rest: 0.0 };
    }
    let rest = match value {
        0.0 => a.signum() * b.signum(),
        _ if is_safe([a, b, value]) => remainder(a, value, b) * b.signum(),
        _ => f64::NAN,
    };
    Rounded { value, rest }
}

/// The root of a number that is not negative.
pub(super) fn root(a: f64) -> Rounded {
    let value = a.sqrt();
    let rest = match a {
        0.0 => 0.0,
        _ if is_safe([a, value, value]) => remainder(a, value, value),
        _ => f64::NAN,
    };
    Rounded { value, rest }
}

/// a - b c, exactly, where b c is a within the error of a rounded quotient or root.
fn remainder(a: f64, b: f64, c: f64) -> f64 {
    let product = DoubleDouble::product(b, c);
    (a - product.high()) - product.low()
}
