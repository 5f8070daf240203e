#![doc = include_str!("../README.md")]
#![cfg_attr(not(feature = "std"), no_std)]
#![warn(missing_docs)]

#[cfg(feature = "double-double")]
pub use linkage_double::DoubleDouble;
#[cfg(feature = "drawing")]
pub use linkage_runtime::drawing;
#[cfg(feature = "sheet")]
pub use linkage_runtime::sheet;
pub use linkage_runtime::{
    Assembly, Balance, Elbow, Energy, Error, Group, Mechanism, OutputMotion, PointMotion, Power, Real, Scene, Slider,
    Slope, Solution, accuracy, continuation, derivation, limits, nalgebra, position, singularity,
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
        Assembly, Balance, Bound, Elbow, Energy, Error, Factorization, Group, Limits, Mechanism, OutputMotion,
        PointMotion, Power, Real, Scene, Search, Slider, Slope, Solution, chord, elbow_chord, equilibrium, existing,
        finite, finite_each, finite_matrix, limits, newton, newton_group, not_negative, product_of_pivots, real,
        reduced, regular, side_of, unit,
    };
}
