#![doc = include_str!("../README.md")]
#![cfg_attr(not(feature = "std"), no_std)]
#![warn(missing_docs)]

#[cfg(feature = "drawing")]
pub use linkage_runtime::drawing;
#[cfg(feature = "sheet")]
pub use linkage_runtime::sheet;
pub use linkage_runtime::{
    Elbow, Error, Mechanism, OutputMotion, PointMotion, Real, Slider, Slope, Solution, derivation, integrate, limits,
    nalgebra, position,
};

/// Mechanisms from their closure equations.
///
/// The manual of the language is that of the [procedural macro](__private::linkage).
#[macro_export]
macro_rules! linkage {
    ($($mechanisms:tt)*) => {
        // The crate hands its own path on, so that it may be renamed or re-exported.
        $crate::__private::linkage! { $crate $($mechanisms)* }
    };
}

/// What emitted code refers to; not part of the interface.
#[doc(hidden)]
pub mod __private {
    pub use linkage_macros::linkage;
    pub use linkage_runtime::derivation;
    pub use linkage_runtime::nalgebra::{SMatrix, SVector, UnitComplex, Vector2};
    pub use linkage_runtime::{
        Bound, Elbow, Error, Factorization, Limits, Mechanism, OutputMotion, PointMotion, Real, Search, Slider, Slope,
        Solution, chord, existing, finite, finite_matrix, limits, newton, newton_group, product_of_pivots, real,
        regular, same_signs, side_of, unit,
    };
}
