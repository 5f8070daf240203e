//! The scalars with functions of this crate: `f64` and `f32`.

use core::any::{Any, TypeId};
use core::ops::{Add, Div, Mul, Neg, Sub};

use num_traits::{PrimInt, WrappingAdd, WrappingNeg};

/// `f64` or `f32`.
pub(crate) trait Native:
    Copy
    + PartialOrd
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + 'static
{
    /// The unsigned integer of the same width.
    type Bits: PrimInt + WrappingAdd + WrappingNeg;

    const ZERO: Self;
    const ONE: Self;

    fn bits(self) -> Self::Bits;
    fn of_bits(bits: Self::Bits) -> Self;
    fn magnitude(self) -> Self;
    fn with_sign_of(self, other: Self) -> Self;
}

macro_rules! floats {
    ($float:ident, $bits:ident) => {
        impl Native for $float {
            type Bits = $bits;

            const ZERO: Self = 0.0;
            const ONE: Self = 1.0;

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

floats!(f64, u64);
floats!(f32, u32);

/// `native!(arguments => function)`: the result of the function for `f64` or `f32`, if the arguments are of that type. The
/// type is known at compile time, so that the tests cost nothing. A macro, since calls of function arguments are not
/// inlined where there are many.
macro_rules! native {
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
