//! The verdict on a Jacobian, and the factorisation of blocks of more than two unknowns.

use nalgebra::{Const, DimMin, LU, SMatrix, SVector};

use crate::scalar::{smallest, to_f64};
use crate::{Error, Real, real};

/// A determinant below this many roundings of the largest value that its formula could take is no
/// better than the rounding of the stored angles it is made from (pi itself is off by half a
/// rounding, a difference of two angles by two).
const ROUNDINGS: f64 = 4.0;

/// Refuses the determinant of a group of unknowns that is zero beside `size`, the largest value that
/// its formula could take, whose sign does not matter.
///
/// # Errors
/// [`Error::Singular`], or [`Error::NotFinite`] if either is not a finite number.
#[inline]
pub fn regular<T: Real>(mechanism: &'static str, group: &'static str, determinant: T, size: T) -> Result<(), Error> {
    if determinant.abs() > real::<T>(ROUNDINGS) * T::default_epsilon() * size.abs() && determinant.is_finite() {
        return Ok(());
    }
    Err(singular(mechanism, group, determinant, size))
}

/// Whether numbers have the same signs, one by one; zero counts as positive.
#[inline]
pub fn same_signs<T: Real>(these: &[T], those: &[T]) -> bool {
    these.iter().zip(those).all(|(this, that)| (*this >= T::zero()) == (*that >= T::zero()))
}

#[cold]
fn singular<T: Real>(mechanism: &'static str, group: &'static str, determinant: T, size: T) -> Error {
    if determinant.is_finite() && size.is_finite() {
        // A formula that vanishes with its own size is singular through and through.
        let regularity = if size.is_zero() { 0.0 } else { to_f64((determinant / size).abs()) };
        Error::Singular { mechanism, group, regularity }
    } else {
        Error::NotFinite { mechanism, quantity: "the Jacobian" }
    }
}

/// J of a block of `N` unknowns, equilibrated and factorised with partial pivoting.
#[derive(Debug, Clone)]
pub struct Factorization<T: Real, const N: usize>
where
    Const<N>: DimMin<Const<N>, Output = Const<N>>,
{
    factors: LU<T, Const<N>, Const<N>>,
    rows: [T; N],
    columns: [T; N],
}

impl<T: Real, const N: usize> Factorization<T, N>
where
    Const<N>: DimMin<Const<N>, Output = Const<N>>,
{
    /// Factorises the matrix of these columns, whose rows are of these sizes.
    ///
    /// Rows are divided by the sizes of their closures and columns by their largest entry, so that
    /// neither the unit of a closure nor that of an unknown has a say in the pivots or the verdict.
    ///
    /// # Errors
    /// [`Error::Singular`] if the smallest pivot is no larger than its rounding error,
    /// [`Error::NotFinite`] if an entry is not a finite number.
    pub fn new(
        mechanism: &'static str,
        group: &'static str,
        columns: [[T; N]; N],
        sizes: [T; N],
    ) -> Result<Self, Error> {
        let mut matrix = SMatrix::<T, N, N>::from(columns);
        let mut row_factors = [T::one(); N];
        for (row, (factor, size)) in row_factors.iter_mut().zip(sizes).enumerate() {
            if size > T::zero() {
                *factor = power_of_two_below(size).recip();
            }
            matrix.row_mut(row).scale_mut(*factor);
        }
        let mut column_factors = [T::one(); N];
        for (column, factor) in column_factors.iter_mut().enumerate() {
            let largest = matrix.column(column).amax();
            if largest > T::zero() {
                *factor = power_of_two_below(largest).recip();
            }
            matrix.column_mut(column).scale_mut(*factor);
        }
        if !matrix.iter().all(T::is_finite) {
            return Err(Error::NotFinite { mechanism, quantity: "the Jacobian" });
        }
        let factors = matrix.lu();
        let smallest = smallest_pivot(&factors);
        let roundings = ROUNDINGS * real_count(N);
        if smallest > real::<T>(roundings) * T::default_epsilon() {
            Ok(Self { factors, rows: row_factors, columns: column_factors })
        } else {
            Err(Error::Singular { mechanism, group, regularity: to_f64(smallest) })
        }
    }

    /// The x of J x = `right`.
    #[must_use]
    pub fn solve(&self, right: [T; N]) -> [T; N] {
        let mut x = SVector::<T, N>::from(right);
        for (entry, factor) in x.iter_mut().zip(self.rows) {
            *entry *= factor;
        }
        // No pivot is zero, or there would be no factorisation.
        self.factors.solve_mut(&mut x);
        for (entry, factor) in x.iter_mut().zip(self.columns) {
            *entry *= factor;
        }
        let [solution] = x.data.0;
        solution
    }
}

fn real_count(count: usize) -> f64 {
    u32::try_from(count).map_or(f64::MAX, f64::from)
}

/// A power of two near `value`: scaling by it rounds nothing.
pub(crate) fn power_of_two_below<T: Real>(value: T) -> T {
    let two = real::<T>(2.0);
    let exponent = value.log2().floor();
    let power = two.powf(exponent);
    if power.is_finite() && power > T::zero() { power } else { T::one() }
}

fn smallest_pivot<T: Real, const N: usize>(factors: &LU<T, Const<N>, Const<N>>) -> T
where
    Const<N>: DimMin<Const<N>, Output = Const<N>>,
{
    let packed = factors.lu_internal();
    smallest((0..N).map(|index| packed[(index, index)]))
}

/// The determinant of a block of more than two unknowns, given by columns.
#[must_use]
pub fn product_of_pivots<T: Real, const N: usize>(columns: [[T; N]; N]) -> T
where
    Const<N>: DimMin<Const<N>, Output = Const<N>>,
{
    SMatrix::<T, N, N>::from(columns).lu().determinant()
}
