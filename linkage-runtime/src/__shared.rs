//! Internal functions that `linkage-dynamics` uses. Not part of the interface.

pub use crate::arctangent::{
    ARCTANGENT_COEFFICIENTS, ARCTANGENT_ERROR, QUARTER_PI, arctangent_polynomial, arctangent_rest, turned,
};
pub use crate::chord::{CANCELLATION, COINCIDENT_ULPS, smallest_product};
pub use crate::dense::{Definite, Ranked, contraction, reduce_rows, solve};
pub use crate::error::{all_finite, finite};
pub use crate::hypotenuse::HYPOTENUSE_ERROR;
pub use crate::jacobian::ulp::ZERO_ULPS;
pub use crate::linear::{Factorization, product_of_pivots, same_signs};
pub use crate::newton::{Constraints, search};
pub use crate::position::hadamard_ratio;
pub use crate::scalar::{arithmetic, greatest, larger, largest, smallest, to_f64};
#[cfg(feature = "serde")]
pub use crate::serialised::{array, columns};
pub use crate::shown::Shown;
pub use crate::sine::{HALF_PI, SINE_COEFFICIENTS, SINE_ERROR, sine_kernel, sine_polynomials};

/// Implements `Clone`, `Copy`, `PartialEq` and `Debug` field by field for a struct whose fields have associated types
/// of its parameter: `derive` would require the traits of the parameter itself.
#[doc(hidden)]
#[macro_export]
macro_rules! __by_fields {
    ([$($parameters:tt)*] $name:ident<$($arguments:ident),*> { $($field:ident),* }) => {
        impl<$($parameters)*> ::core::clone::Clone for $name<$($arguments),*> {
            fn clone(&self) -> Self {
                *self
            }
        }

        impl<$($parameters)*> ::core::marker::Copy for $name<$($arguments),*> {}

        impl<$($parameters)*> ::core::cmp::PartialEq for $name<$($arguments),*> {
            fn eq(&self, other: &Self) -> bool {
                $(self.$field == other.$field)&&*
            }
        }

        impl<$($parameters)*> ::core::fmt::Debug for $name<$($arguments),*> {
            fn fmt(&self, f: &mut ::core::fmt::Formatter<'_>) -> ::core::fmt::Result {
                f.debug_struct(::core::stringify!($name))$(.field(::core::stringify!($field), &self.$field))*.finish()
            }
        }
    };
}
