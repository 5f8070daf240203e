//! The scalars with functions of this crate: `f64` and `f32`.

use core::any::{Any, TypeId};
use core::ops::{Add, Div, Mul, Neg, Sub};

use num_traits::{One, PrimInt, WrappingAdd, WrappingNeg};

/// The operations of the polynomials: those of floats, or of bounds of their rounding errors.
pub trait Arithmetic: Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Neg<Output = Self> {}

impl<T> Arithmetic for T where
    T: Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Neg<Output = Self>
{
}

/// `f64` or `f32`.
pub(crate) trait Native: Arithmetic + PartialOrd + Div<Output = Self> + 'static {
    /// The unsigned integer of the same width.
    type Bits: PrimInt + WrappingAdd + WrappingNeg;

    const ZERO: Self;
    const ONE: Self;
    /// The least number with all digits.
    const LEAST: Self;
    /// The bits of the exponent.
    const EXPONENT: Self::Bits;

    fn bits(self) -> Self::Bits;
    fn of_bits(bits: Self::Bits) -> Self;
    fn magnitude(self) -> Self;
    fn with_sign_of(self, other: Self) -> Self;
}

macro_rules! floats {
    ($float:ident, $bits:ident, $exponent:literal) => {
        impl Native for $float {
            type Bits = $bits;

            const ZERO: Self = 0.0;
            const ONE: Self = 1.0;
            const LEAST: Self = $float::MIN_POSITIVE;
            const EXPONENT: $bits = $exponent;

            #[inline(always)]
            fn bits(self) -> $bits {
                self.to_bits()
            }

            #[inline(always)]
            fn of_bits(bits: $bits) -> Self {
                Self::from_bits(bits)
            }

            #[inline(always)]
            fn magnitude(self) -> Self {
                self.abs()
            }

            #[inline(always)]
            fn with_sign_of(self, other: Self) -> Self {
                self.copysign(other)
            }
        }
    };
}

floats!(f64, u64, 0x7ff0_0000_0000_0000);
floats!(f32, u32, 0x7f80_0000);

/// `native!(arguments => function)`: the result of the function for `f64` or `f32`, if the arguments are of that type. The
/// type is known at compile time, so that the tests cost nothing. A macro, since calls of function arguments are not
/// inlined where there are many.
///
/// `native!(arguments => function; else value)`: that result, or the value for another type. It is no call of
/// `unwrap_or_else`: where a small program is asked for, that is not inlined, and floats would link the function that
/// only other types call.
macro_rules! native {
    ($arguments:expr => $($function:ident)::+ $(, $count:ident)?; else $other:expr) => {
        match crate::native::native!($arguments => $($function)::+ $(, $count)?) {
            Some(result) => result,
            None => $other,
        }
    };
    ($arguments:expr => $($function:ident)::+ $(, $count:ident)?) => {{
        let arguments = $arguments;
        match crate::native::same(arguments) {
            Some(arguments) => crate::native::same($($function)::+::<f64 $(, $count)?>(arguments)),
            None => match crate::native::same(arguments) {
                Some(arguments) => crate::native::same($($function)::+::<f32 $(, $count)?>(arguments)),
                None => None,
            },
        }
    }};
}
pub(crate) use native;

/// The largest power of two that is not above a value; 1 for a value that is not positive or not finite.
#[inline(always)]
pub(crate) fn power_of_two_below<F: Native>(value: F) -> F {
    let power = F::of_bits(value.bits() & F::EXPONENT);
    let is_normal = value >= F::LEAST && power.bits() != F::EXPONENT;
    if is_normal { power } else { extreme_power(value) }
}

/// The power of a subnormal number is its first bit.
#[cold]
#[inline(never)]
fn extreme_power<F: Native>(value: F) -> F {
    if !(value > F::ZERO && value < F::LEAST) {
        return F::ONE;
    }
    let zeros = value.bits().leading_zeros() as usize;
    F::of_bits(F::Bits::one().rotate_right(1) >> zeros)
}

/// The value as another type, if that is its own.
#[inline(always)]
pub(crate) fn same<A: Copy + 'static, B: Copy + 'static>(value: A) -> Option<B> {
    (&value as &dyn Any).downcast_ref().copied()
}

/// True for `f64` and `f32`, known at compile time.
#[inline(always)]
pub(crate) fn is_native<T: 'static>() -> bool {
    let id = TypeId::of::<T>();
    id == TypeId::of::<f64>() || id == TypeId::of::<f32>()
}

#[cfg(test)]
mod tests {
    use super::power_of_two_below;

    #[test]
    fn powers_of_two() {
        let mut power = f64::from_bits(1);
        while power.is_finite() {
            let below = if power > f64::from_bits(1) { power / 2.0 } else { 1.0 };
            assert_eq!([power, power.next_down()].map(power_of_two_below), [power, below]);
            power += power;
        }
        let mut power = f32::from_bits(1);
        while power.is_finite() {
            let below = if power > f32::from_bits(1) { power / 2.0 } else { 1.0 };
            assert_eq!([power, power.next_down()].map(power_of_two_below), [power, below]);
            power += power;
        }
        for none in [0.0, -0.0, -1.0, -f64::MIN_POSITIVE, f64::INFINITY, f64::NEG_INFINITY, f64::NAN] {
            assert_eq!((power_of_two_below(none), power_of_two_below(none as f32)), (1.0, 1.0));
        }
    }
}
