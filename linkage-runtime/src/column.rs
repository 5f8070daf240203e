//! Columns whose length is a type.

use core::fmt::{self, Debug, Display};
use core::iter::Sum;
use core::ops::{Add, AddAssign, Div, Index, IndexMut, Mul, MulAssign, Neg, Sub, SubAssign};

use nalgebra::SVector;

use crate::scalar::largest;
use crate::{D, Dim, Real};

/// A column of as many entries as [`R`](Dim) says; a vector if they are numbers.
///
/// It converts to and from nalgebra's [`SVector`] by `into`.
#[derive(Clone, Copy)]
pub struct Column<X: Copy + Debug, R: Dim>(R::Array<X>);

impl<X: Copy + Debug, R: Dim + Default> Column<X, R> {
    /// Builds the column whose entry at index i is `entry(i)`.
    #[inline]
    #[must_use]
    pub fn from_fn(entry: impl FnMut(usize) -> X) -> Self {
        Self(R::default().array(entry))
    }

    /// Builds a column of equal entries.
    #[inline]
    #[must_use]
    pub fn repeat(entry: X) -> Self {
        Self::from_fn(|_| entry)
    }
}

impl<X: Copy + Debug, R: Dim> Column<X, R> {
    /// Builds the column of these entries; `None` if it cannot have so many.
    #[inline]
    #[must_use]
    pub fn from_slice(entries: &[X]) -> Option<Self> {
        R::new(entries.len()).map(|count| Self(count.array(|place| entries[place])))
    }

    /// The number of entries.
    #[inline]
    #[must_use]
    pub fn dim(&self) -> R {
        R::of(&self.0)
    }

    /// The column of these entries.
    #[inline]
    pub(crate) fn of(entries: R::Array<X>) -> Self {
        Self(entries)
    }

    /// The entries as an array.
    #[inline]
    pub(crate) fn into_array(self) -> R::Array<X> {
        self.0
    }

    /// The entries.
    #[inline]
    #[must_use]
    pub fn as_slice(&self) -> &[X] {
        self.0.as_ref()
    }

    /// The entries, mutable.
    #[inline]
    #[must_use]
    pub fn as_mut_slice(&mut self) -> &mut [X] {
        self.0.as_mut()
    }

    /// Iterates over the entries.
    #[inline]
    pub fn iter(&self) -> core::slice::Iter<'_, X> {
        self.as_slice().iter()
    }

    /// Iterates over the entries, mutable.
    #[inline]
    pub fn iter_mut(&mut self) -> core::slice::IterMut<'_, X> {
        self.as_mut_slice().iter_mut()
    }

    /// Applies a function to each entry.
    #[inline]
    #[must_use]
    pub fn map<Y: Copy + Debug>(&self, f: impl FnMut(X) -> Y) -> Column<Y, R> {
        Column(R::map(self.0, f))
    }

    /// Combines two columns entry by entry.
    #[inline]
    #[must_use]
    pub fn zip_map<Y: Copy + Debug>(&self, other: &Column<Y, R>, mut f: impl FnMut(X, Y) -> X) -> Self {
        let mut result = *self;
        for (entry, &other) in result.iter_mut().zip(other) {
            *entry = f(*entry, other);
        }
        result
    }
}

impl<T: Real, R: Dim + Default> Column<T, R> {
    /// Builds the column of these entries, padded with zeros.
    #[inline]
    #[must_use]
    pub fn from_iterator(entries: impl IntoIterator<Item = T>) -> Self {
        let mut column = Self::zeros();
        for (own, entry) in column.iter_mut().zip(entries) {
            *own = entry;
        }
        column
    }

    /// The zero vector.
    #[inline]
    #[must_use]
    pub fn zeros() -> Self {
        Self::repeat(T::zero())
    }

    /// The unit vector with its 1 at this index.
    #[inline]
    #[must_use]
    pub fn unit(at: usize) -> Self {
        Self::from_fn(|place| if place == at { T::one() } else { T::zero() })
    }
}

impl<T: Real, R: Dim> Column<T, R> {
    /// Returns an entry, or zero beyond the end; unlike indexing it cannot panic.
    #[inline]
    #[must_use]
    pub fn part(&self, place: usize) -> T {
        self.as_slice().get(place).copied().unwrap_or_else(T::zero)
    }

    /// The dot product.
    #[inline]
    #[must_use]
    pub fn dot(&self, other: &Self) -> T {
        self.iter().zip(other).fold(T::zero(), |sum, (&one, &other)| sum + one * other)
    }

    /// The Euclidean norm.
    #[inline]
    #[must_use]
    pub fn norm(&self) -> T {
        self.dot(self).sqrt()
    }

    /// The sum of the entries.
    #[inline]
    #[must_use]
    pub fn sum(&self) -> T {
        self.iter().fold(T::zero(), |sum, &entry| sum + entry)
    }

    /// The magnitudes of the entries.
    #[inline]
    #[must_use]
    pub fn abs(&self) -> Self {
        self.map(|entry| entry.abs())
    }

    /// The largest magnitude; NaN if an entry is NaN.
    #[inline]
    #[must_use]
    pub fn largest(&self) -> T {
        largest(self.iter().copied())
    }

    /// The index of the largest magnitude, the first of equal ones.
    #[inline]
    #[must_use]
    pub fn leading(&self) -> usize {
        (0..self.as_slice().len())
            .fold(0, |leading, place| if self[place].abs() > self[leading].abs() { place } else { leading })
    }

    /// The entrywise product.
    #[inline]
    #[must_use]
    pub fn component_mul(&self, other: &Self) -> Self {
        self.zip_map(other, |one, other| one * other)
    }

    /// The entrywise quotient.
    #[inline]
    #[must_use]
    pub fn component_div(&self, other: &Self) -> Self {
        self.zip_map(other, |one, other| one / other)
    }

    /// True if every entry is finite.
    #[inline]
    #[must_use]
    pub fn is_finite(&self) -> bool {
        self.iter().all(T::is_finite)
    }
}

impl<X: Copy + Debug, R: Dim> Debug for Column<X, R> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.as_slice().fmt(f)
    }
}

/// The entries in one line, `[1.5, -2]`, each with the precision asked for.
impl<X: Copy + Debug + Display, R: Dim> Display for Column<X, R> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        in_one_line(f, self)
    }
}

/// Entries in brackets, separated by commas.
pub(crate) fn in_one_line<X: Display>(f: &mut fmt::Formatter<'_>, entries: impl IntoIterator<Item = X>) -> fmt::Result {
    f.write_str("[")?;
    for (place, entry) in entries.into_iter().enumerate() {
        f.write_str(if place == 0 { "" } else { ", " })?;
        entry.fmt(f)?;
    }
    f.write_str("]")
}

impl<X: Copy + Debug + PartialEq, R: Dim> PartialEq for Column<X, R> {
    fn eq(&self, other: &Self) -> bool {
        self.as_slice() == other.as_slice()
    }
}

impl<X: Copy + Debug + Eq, R: Dim> Eq for Column<X, R> {}

impl<X: Copy + Debug + PartialEq, const N: usize> PartialEq<[X; N]> for Column<X, D<N>> {
    fn eq(&self, other: &[X; N]) -> bool {
        self.as_slice() == other
    }
}

impl<X: Copy + Debug, R: Dim> Index<usize> for Column<X, R> {
    type Output = X;

    #[inline]
    fn index(&self, place: usize) -> &X {
        &self.as_slice()[place]
    }
}

impl<X: Copy + Debug, R: Dim> IndexMut<usize> for Column<X, R> {
    #[inline]
    fn index_mut(&mut self, place: usize) -> &mut X {
        &mut self.as_mut_slice()[place]
    }
}

impl<X: Copy + Debug, R: Dim> IntoIterator for Column<X, R> {
    type Item = X;
    type IntoIter = <R::Array<X> as IntoIterator>::IntoIter;

    #[inline]
    fn into_iter(self) -> Self::IntoIter {
        self.0.into_iter()
    }
}

impl<'a, X: Copy + Debug, R: Dim> IntoIterator for &'a Column<X, R> {
    type Item = &'a X;
    type IntoIter = core::slice::Iter<'a, X>;

    #[inline]
    fn into_iter(self) -> Self::IntoIter {
        self.iter()
    }
}

impl<'a, X: Copy + Debug, R: Dim> IntoIterator for &'a mut Column<X, R> {
    type Item = &'a mut X;
    type IntoIter = core::slice::IterMut<'a, X>;

    #[inline]
    fn into_iter(self) -> Self::IntoIter {
        self.iter_mut()
    }
}

impl<X: Copy + Debug, const N: usize> From<[X; N]> for Column<X, D<N>> {
    #[inline]
    fn from(entries: [X; N]) -> Self {
        Self(entries)
    }
}

impl<X: Copy + Debug, const N: usize> From<Column<X, D<N>>> for [X; N] {
    #[inline]
    fn from(column: Column<X, D<N>>) -> Self {
        column.0
    }
}

impl<T: Real, const N: usize> From<SVector<T, N>> for Column<T, D<N>> {
    #[inline]
    fn from(vector: SVector<T, N>) -> Self {
        let [entries] = vector.data.0;
        Self(entries)
    }
}

impl<T: Real, const N: usize> From<Column<T, D<N>>> for SVector<T, N> {
    #[inline]
    fn from(column: Column<T, D<N>>) -> Self {
        Self::from(column.0)
    }
}

impl<T: Real, R: Dim> Add for Column<T, R> {
    type Output = Self;

    #[inline]
    fn add(self, other: Self) -> Self {
        self.zip_map(&other, |one, other| one + other)
    }
}

impl<T: Real, R: Dim> Sub for Column<T, R> {
    type Output = Self;

    #[inline]
    fn sub(self, other: Self) -> Self {
        self.zip_map(&other, |one, other| one - other)
    }
}

impl<T: Real, R: Dim> Neg for Column<T, R> {
    type Output = Self;

    #[inline]
    fn neg(mut self) -> Self {
        self.iter_mut().for_each(|entry| *entry = -*entry);
        self
    }
}

impl<T: Real, R: Dim> Mul<T> for Column<T, R> {
    type Output = Self;

    #[inline]
    fn mul(mut self, factor: T) -> Self {
        self *= factor;
        self
    }
}

impl<T: Real, R: Dim> Div<T> for Column<T, R> {
    type Output = Self;

    #[inline]
    fn div(self, divisor: T) -> Self {
        self.map(|entry| entry / divisor)
    }
}

impl<T: Real, R: Dim> AddAssign for Column<T, R> {
    #[inline]
    fn add_assign(&mut self, other: Self) {
        self.iter_mut().zip(&other).for_each(|(entry, &other)| *entry += other);
    }
}

impl<T: Real, R: Dim> SubAssign for Column<T, R> {
    #[inline]
    fn sub_assign(&mut self, other: Self) {
        self.iter_mut().zip(&other).for_each(|(entry, &other)| *entry -= other);
    }
}

impl<T: Real, R: Dim> MulAssign<T> for Column<T, R> {
    #[inline]
    fn mul_assign(&mut self, factor: T) {
        self.iter_mut().for_each(|entry| *entry *= factor);
    }
}

impl<T: Real, R: Dim + Default> Sum for Column<T, R> {
    fn sum<I: Iterator<Item = Self>>(columns: I) -> Self {
        columns.fold(Self::zeros(), |sum, column| sum + column)
    }
}
