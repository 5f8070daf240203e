//! Numbers of coordinates as types.
//!
//! Generic algorithms take the numbers of unknowns and inputs from the types [`Mechanism::U`] and [`Mechanism::V`]
//! instead of const parameters, so that the mechanism is the only parameter of their structs.
//!
//! [`Mechanism::U`]: crate::Mechanism::U
//! [`Mechanism::V`]: crate::Mechanism::V

use core::fmt::Debug;

use nalgebra::SVector;

use crate::Real;

/// A number as a type, with the array type and the vector type of that length.
#[diagnostic::on_unimplemented(message = "`{Self}` is not a dimension", note = "write `D<N>` with a number `N`")]
pub trait Dim: Copy + Debug + Eq + 'static {
    /// The number.
    const COUNT: usize;
    /// `[X; COUNT]`.
    type Array<X: Copy + Debug>: Copy + Debug + AsRef<[X]> + AsMut<[X]> + IntoIterator<Item = X>;
    /// nalgebra's vector of that length.
    type Vector<T: Real>: Copy + Debug + From<Self::Array<T>> + Into<Self::Array<T>>;

    /// Builds the array whose entry at index i is `entry(i)`.
    fn array<X: Copy + Debug>(entry: impl FnMut(usize) -> X) -> Self::Array<X>;
    /// Builds the array of these entries; `None` if their number is not [`COUNT`](Self::COUNT).
    fn from_slice<X: Copy + Debug>(entries: &[X]) -> Option<Self::Array<X>>;
    /// Applies a function to each entry, without bounds checks.
    fn map<X: Copy + Debug, Y: Copy + Debug>(entries: Self::Array<X>, f: impl FnMut(X) -> Y) -> Self::Array<Y>;
}

/// The number `N` as a type.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct D<const N: usize>;

impl<const N: usize> Dim for D<N> {
    const COUNT: usize = N;
    type Array<X: Copy + Debug> = [X; N];
    type Vector<T: Real> = SVector<T, N>;

    #[inline]
    fn array<X: Copy + Debug>(entry: impl FnMut(usize) -> X) -> [X; N] {
        core::array::from_fn(entry)
    }

    fn from_slice<X: Copy + Debug>(entries: &[X]) -> Option<[X; N]> {
        entries.try_into().ok()
    }

    #[inline]
    fn map<X: Copy + Debug, Y: Copy + Debug>(entries: [X; N], f: impl FnMut(X) -> Y) -> [Y; N] {
        entries.map(f)
    }
}
