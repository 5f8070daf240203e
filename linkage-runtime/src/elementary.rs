//! Elementary functions of `f64` and `f32` by the crate `libm` on every target, so that they have the same bits with and
//! without the standard library, whose functions are those of the platform.
//!
//! Sine, cosine, arctangent of two numbers and hypotenuse are this crate's own; here are the others, and the first three
//! where arguments are extreme. `linkage-tests` prints how accurate they are, `cargo bench --bench sine` how fast.

use crate::native::Native;

/// A scalar of `libm`.
pub(crate) trait Elementary: Native {
    fn tangent(self) -> Self;
    fn arcsine(self) -> Self;
    fn arccosine(self) -> Self;
    fn arctangent(self) -> Self;
    fn arctangent2(self, x: Self) -> Self;
    fn exponential(self) -> Self;
    fn logarithm(self) -> Self;
}

macro_rules! by_libm {
    ($($float:ident: $tan:ident $asin:ident $acos:ident $atan:ident $atan2:ident $exp:ident $log:ident;)*) => {$(
        impl Elementary for $float {
            fn tangent(self) -> Self {
                libm::$tan(self)
            }

            fn arcsine(self) -> Self {
                libm::$asin(self)
            }

            fn arccosine(self) -> Self {
                libm::$acos(self)
            }

            fn arctangent(self) -> Self {
                libm::$atan(self)
            }

            fn arctangent2(self, x: Self) -> Self {
                libm::$atan2(self, x)
            }

            fn exponential(self) -> Self {
                libm::$exp(self)
            }

            fn logarithm(self) -> Self {
                libm::$log(self)
            }
        }
    )*};
}

by_libm! {
    f64: tan asin acos atan atan2 exp log;
    f32: tanf asinf acosf atanf atan2f expf logf;
}

pub(crate) fn tangent<F: Elementary>(x: F) -> F {
    x.tangent()
}

pub(crate) fn arcsine<F: Elementary>(x: F) -> F {
    x.arcsine()
}

pub(crate) fn arccosine<F: Elementary>(x: F) -> F {
    x.arccosine()
}

pub(crate) fn arctangent<F: Elementary>(x: F) -> F {
    x.arctangent()
}

/// The angle of (x, y) with the x axis.
pub(crate) fn arctangent2<F: Elementary>((y, x): (F, F)) -> F {
    y.arctangent2(x)
}

pub(crate) fn exponential<F: Elementary>(x: F) -> F {
    x.exponential()
}

pub(crate) fn logarithm<F: Elementary>(x: F) -> F {
    x.logarithm()
}
