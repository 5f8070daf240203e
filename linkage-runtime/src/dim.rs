//! Numbers of coordinates as types.
//!
//! A generic algorithm names how many unknowns and inputs a mechanism has by the types [`Mechanism::U`] and
//! [`Mechanism::V`] and not by constant parameters, so that a struct of it has the mechanism for its only parameter.
//!
//! [`Mechanism::U`]: crate::Mechanism::U
//! [`Mechanism::V`]: crate::Mechanism::V

use core::fmt::Debug;

/// A number of things as a type, and the array of that length.
pub trait Dim: Copy + Debug + Eq + 'static {
    /// The number.
    const COUNT: usize;
    /// `[X; COUNT]`.
    type Array<X: Copy + Debug>: Copy + Debug + AsRef<[X]> + AsMut<[X]> + IntoIterator<Item = X>;

    /// The array of these entries.
    fn array<X: Copy + Debug>(entry: impl FnMut(usize) -> X) -> Self::Array<X>;
    /// A function of each entry of an array: without a place that could be beyond its end.
    fn map<X: Copy + Debug, Y: Copy + Debug>(entries: Self::Array<X>, f: impl FnMut(X) -> Y) -> Self::Array<Y>;
}

/// The number `N` as a type.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct D<const N: usize>;

impl<const N: usize> Dim for D<N> {
    const COUNT: usize = N;
    type Array<X: Copy + Debug> = [X; N];

    #[inline]
    fn array<X: Copy + Debug>(entry: impl FnMut(usize) -> X) -> [X; N] {
        core::array::from_fn(entry)
    }

    #[inline]
    fn map<X: Copy + Debug, Y: Copy + Debug>(entries: [X; N], f: impl FnMut(X) -> Y) -> [Y; N] {
        entries.map(f)
    }
}
