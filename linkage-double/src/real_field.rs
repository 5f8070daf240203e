//! The part of the traits required by nalgebra that all scalars share which are real numbers with one lane.

/// Writes one of these parts:
///
/// - `scalar Type, value, zero, one`: the traits that say that it is a field of real numbers in one lane, where `value` is
///   the field whose zero is that of the number;
/// - `signed`: the signs of `Signed`;
/// - `complex zero`: the functions of `ComplexField` for numbers without an imaginary part, by its operators;
/// - `range`: the ends of the range of doubles, of `RealField`.
#[doc(hidden)]
#[macro_export]
macro_rules! __real_field {
    (scalar $name:ident, $value:ident, $zero:expr, $one:expr) => {
        impl ::num_traits::Zero for $name {
            fn zero() -> Self {
                $zero
            }

            fn is_zero(&self) -> bool {
                self.$value == 0.0
            }
        }

        impl ::num_traits::One for $name {
            fn one() -> Self {
                $one
            }
        }

        /// A SIMD value of one lane.
        impl ::nalgebra::SimdValue for $name {
            const LANES: usize = 1;
            type Element = Self;
            type SimdBool = bool;

            fn splat(value: Self) -> Self {
                value
            }

            fn extract(&self, _: usize) -> Self {
                *self
            }

            #[allow(unsafe_code, reason = "declared so by the trait")]
            unsafe fn extract_unchecked(&self, _: usize) -> Self {
                *self
            }

            fn replace(&mut self, _: usize, value: Self) {
                *self = value;
            }

            #[allow(unsafe_code, reason = "declared so by the trait")]
            unsafe fn replace_unchecked(&mut self, _: usize, value: Self) {
                *self = value;
            }

            fn select(self, condition: bool, other: Self) -> Self {
                if condition { self } else { other }
            }
        }

        impl ::nalgebra::Field for $name {}

        impl ::simba::scalar::SubsetOf<Self> for $name {
            fn to_superset(&self) -> Self {
                *self
            }

            fn from_superset_unchecked(element: &Self) -> Self {
                *element
            }

            fn is_in_subset(_: &Self) -> bool {
                true
            }
        }
    };
    (signed) => {
        fn is_positive(&self) -> bool {
            ::nalgebra::RealField::is_sign_positive(self)
        }

        fn is_negative(&self) -> bool {
            ::nalgebra::RealField::is_sign_negative(self)
        }
    };
    (complex $zero:expr, $one:expr) => {
        #[inline]
        fn from_real(re: Self) -> Self {
            re
        }

        #[inline]
        fn real(self) -> Self {
            self
        }

        #[inline]
        fn imaginary(self) -> Self {
            $zero
        }

        fn modulus(self) -> Self {
            ::num_traits::Signed::abs(&self)
        }

        fn modulus_squared(self) -> Self {
            self * self
        }

        fn norm1(self) -> Self {
            ::num_traits::Signed::abs(&self)
        }

        #[inline]
        fn scale(self, factor: Self) -> Self {
            self * factor
        }

        #[inline]
        fn unscale(self, factor: Self) -> Self {
            self / factor
        }

        fn fract(self) -> Self {
            self - self.trunc()
        }

        #[inline]
        fn abs(self) -> Self {
            ::num_traits::Signed::abs(&self)
        }

        fn recip(self) -> Self {
            $one / self
        }

        #[inline]
        fn conjugate(self) -> Self {
            self
        }

        #[inline]
        fn sqrt(self) -> Self {
            self.root()
        }
    };
    (range) => {
        fn min_value() -> Option<Self> {
            Some(f64::MIN.into())
        }

        fn max_value() -> Option<Self> {
            Some(f64::MAX.into())
        }
    };
}
