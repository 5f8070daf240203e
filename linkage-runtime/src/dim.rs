//! Numbers of coordinates.
//!
//! Generic algorithms take the numbers of unknowns and inputs from the types [`Mechanism::U`] and [`Mechanism::V`]
//! instead of const parameters, so that the mechanism is the only parameter of their structs. The number itself is a
//! value of that type: of [`D<N>`](D) there is one value, which takes no memory, so that emitted code is that of arrays;
//! an [`UpTo<N>`](UpTo) holds the number of a mechanism that is read while the program runs.
//!
//! [`Mechanism::U`]: crate::Mechanism::U
//! [`Mechanism::V`]: crate::Mechanism::V

use core::fmt::{self, Debug, Formatter};
use core::iter::{Flatten, Take};

use nalgebra::SVector;

use crate::Real;

/// A number of coordinates, with the array type and the vector type of that length.
#[diagnostic::on_unimplemented(message = "`{Self}` is not a dimension", note = "write `D<N>` with a number `N`")]
pub trait Dim: Copy + Debug + Eq + 'static {
    /// The largest number that a value of this type can be.
    const CAPACITY: usize;
    /// An array of that length.
    type Array<X: Copy + Debug>: Copy + Debug + AsRef<[X]> + AsMut<[X]> + IntoIterator<Item = X>;
    /// A vector of that length, of nalgebra if the number is a constant.
    type Vector<T: Real>: Copy + Debug + From<Self::Array<T>> + Into<Self::Array<T>>;

    /// The dimension with this number; `None` if a value of this type cannot be it.
    fn new(count: usize) -> Option<Self>;
    /// The smallest number that a value of this type can be.
    fn least() -> Self;
    /// The number.
    fn count(self) -> usize;
    /// Builds the array whose entry at index i is `entry(i)`.
    fn array<X: Copy + Debug>(self, entry: impl FnMut(usize) -> X) -> Self::Array<X>;
    /// The length of an array.
    fn of<X: Copy + Debug>(array: &Self::Array<X>) -> Self;
    /// Applies a function to each entry, without bounds checks.
    fn map<X: Copy + Debug, Y: Copy + Debug>(entries: Self::Array<X>, f: impl FnMut(X) -> Y) -> Self::Array<Y>;
}

/// The number `N`, a constant.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq)]
pub struct D<const N: usize>;

impl<const N: usize> Dim for D<N> {
    const CAPACITY: usize = N;
    type Array<X: Copy + Debug> = [X; N];
    type Vector<T: Real> = SVector<T, N>;

    #[inline]
    fn new(count: usize) -> Option<Self> {
        (count == N).then_some(Self)
    }

    #[inline]
    fn least() -> Self {
        Self
    }

    #[inline]
    fn count(self) -> usize {
        N
    }

    #[inline]
    fn array<X: Copy + Debug>(self, mut entry: impl FnMut(usize) -> X) -> [X; N] {
        if const { N == 0 || is_large::<X>() } {
            return core::array::from_fn(entry);
        }
        let mut entries = [entry(0); N];
        let mut place = 1;
        while place < N {
            entries[place] = entry(place);
            place += 1;
        }
        entries
    }

    #[inline]
    fn of<X: Copy + Debug>(_: &[X; N]) -> Self {
        Self
    }

    #[inline]
    fn map<X: Copy + Debug, Y: Copy + Debug>(entries: [X; N], mut f: impl FnMut(X) -> Y) -> [Y; N] {
        if const { N == 0 || is_large::<X>() || is_large::<Y>() } {
            return entries.map(f);
        }
        let mut mapped = [f(entries[0]); N];
        let mut place = 1;
        while place < N {
            mapped[place] = f(entries[place]);
            place += 1;
        }
        mapped
    }
}

/// True if an array of such entries is not made by a loop. rustc makes ten functions of each call of `from_fn` and `map`, and none of
/// a loop; where the choice is a constant it makes one of the two. But it keeps a loop over lanes, from 32 bytes on: 8 lanes of a
/// long mechanism took 39 % more instructions.
const fn is_large<X>() -> bool {
    size_of::<X>() >= 32
}

/// A number up to `N`, which is known while the program runs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct UpTo<const N: usize>(usize);

impl<const N: usize> Dim for UpTo<N> {
    const CAPACITY: usize = N;
    type Array<X: Copy + Debug> = Bounded<X, N>;
    type Vector<T: Real> = Bounded<T, N>;

    fn new(count: usize) -> Option<Self> {
        (count <= N).then_some(Self(count))
    }

    fn least() -> Self {
        Self(0)
    }

    fn count(self) -> usize {
        self.0
    }

    fn array<X: Copy + Debug>(self, mut entry: impl FnMut(usize) -> X) -> Bounded<X, N> {
        if self.0 == 0 {
            return Bounded { entries: None, count: 0 };
        }
        // The places beyond the last entry repeat the first: no entry is computed for them.
        let first = entry(0);
        let entries = core::array::from_fn(|place| if (1..self.0).contains(&place) { entry(place) } else { first });
        Bounded { entries: Some(entries), count: self.0 }
    }

    fn of<X: Copy + Debug>(array: &Bounded<X, N>) -> Self {
        Self(array.count)
    }

    fn map<X: Copy + Debug, Y: Copy + Debug>(entries: Bounded<X, N>, mut f: impl FnMut(X) -> Y) -> Bounded<Y, N> {
        let own = entries.as_ref();
        // `array` asks for places of its own length only.
        Self(entries.count).array(|place| f(own[place]))
    }
}

/// An array of up to `N` entries.
#[derive(Clone, Copy)]
pub struct Bounded<X, const N: usize> {
    /// None without entries, since there is then no value to fill the array with.
    entries: Option<[X; N]>,
    count: usize,
}

impl<X, const N: usize> AsRef<[X]> for Bounded<X, N> {
    fn as_ref(&self) -> &[X] {
        self.entries.as_ref().and_then(|entries| entries.get(..self.count)).unwrap_or_default()
    }
}

impl<X, const N: usize> AsMut<[X]> for Bounded<X, N> {
    fn as_mut(&mut self) -> &mut [X] {
        self.entries.as_mut().and_then(|entries| entries.get_mut(..self.count)).unwrap_or_default()
    }
}

impl<X: PartialEq, const N: usize> PartialEq for Bounded<X, N> {
    fn eq(&self, other: &Self) -> bool {
        self.as_ref() == other.as_ref()
    }
}

impl<X: Eq, const N: usize> Eq for Bounded<X, N> {}

impl<X: Debug, const N: usize> Debug for Bounded<X, N> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        self.as_ref().fmt(f)
    }
}

impl<X, const N: usize> IntoIterator for Bounded<X, N> {
    type Item = X;
    type IntoIter = Take<Flatten<core::option::IntoIter<[X; N]>>>;

    fn into_iter(self) -> Self::IntoIter {
        self.entries.into_iter().flatten().take(self.count)
    }
}
