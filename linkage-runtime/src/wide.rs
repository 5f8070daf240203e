//! Twice the precision for groups that are nearly singular.
//!
//! With a smallest pivot p the solution of a factorised system has a relative error of about eps / p (N. J. Higham,
//! "Accuracy and Stability of Numerical Algorithms", ch. 9). Most of it comes from the entries of J, rounded before, so that
//! iterative refinement with these entries regains nothing. The emitted functions, generic over their scalar, then compute
//! in [`Wide`] from the angles of the pose as numbers, and round once. Whether J is singular is decided before, in the
//! scalar of the caller.

use linkage_double::DoubleDouble;
use nalgebra::{Point2, SMatrix, SVector, UnitComplex};

use crate::bounded::{has_bound, instead};
use crate::native::is_native;
use crate::scalar::{to_f64, unit};
use crate::{Column, Dim, OutputMotion, PointMotion, Real, real};

/// The scalar of twice the precision: `f32` and `f64` convert to it exactly. One for both, so that a mechanism is compiled
/// for one more scalar only.
pub type Wide = DoubleDouble;

/// The pivot of an equilibrated block, whose entries are at most about 1, below which it is solved in twice the precision.
///
/// Solutions lose up to six bits above it. Of the positions of the double butterfly and of Stephenson II in equal steps
/// along all their motions to dead points, 3 of 19 436 and 9 of 8234 lie below it; twice as many below its double, half
/// as many below its half.
const SMALLEST_PIVOT: f64 = 0.015_625;

/// True if a group with this smallest pivot loses digits that [`Wide`] keeps: for `f32`, `f64` and doubles with a bound,
/// known at compile time.
#[inline]
pub(crate) fn loses_digits<T: Real>(smallest_pivot: T) -> bool {
    (is_native::<T>() || has_bound::<T>()) && smallest_pivot < real(SMALLEST_PIVOT)
}

/// The number in twice the precision.
#[must_use]
pub fn widened<T: Real>(value: T) -> Wide {
    to_f64(value).into()
}

/// The direction in twice the precision, as stored.
#[must_use]
pub fn widened_direction<T: Real>(direction: UnitComplex<T>) -> UnitComplex<Wide> {
    unit(widened(direction.re), widened(direction.im))
}

/// The column in twice the precision.
#[must_use]
pub fn widened_column<T: Real, R: Dim>(column: &Column<T, R>) -> Column<Wide, R> {
    column.map(widened)
}

/// The numbers by name in twice the precision.
#[must_use]
pub fn widened_by_name<T, A, B, const N: usize>(by_name: A) -> B
where
    T: Real,
    SVector<T, N>: From<A>,
    B: From<SVector<Wide, N>>,
{
    SVector::from(by_name).map(widened).into()
}

/// A result in twice the precision that can be rounded to `To`.
pub trait Rounded<To> {
    /// The rounded result; clears the flag if a number is not finite. A scalar with a bound is then off by what it
    /// differs from the `rough` result, and by the bound of that.
    fn rounded(self, rough: To, is_finite: &mut bool) -> To;
}

impl<T: Real> Rounded<T> for Wide {
    fn rounded(self, rough: T, is_finite: &mut bool) -> T {
        let rounded = real::<T>(self.high());
        *is_finite &= rounded.is_finite();
        instead(rounded, rough)
    }
}

impl<T: Real, const R: usize, const C: usize> Rounded<SMatrix<T, R, C>> for SMatrix<Wide, R, C> {
    fn rounded(self, rough: SMatrix<T, R, C>, is_finite: &mut bool) -> SMatrix<T, R, C> {
        self.zip_map(&rough, |entry, rough| entry.rounded(rough, is_finite))
    }
}

impl<T: Real, R: Dim> Rounded<Column<T, R>> for Column<Wide, R> {
    fn rounded(self, rough: Column<T, R>, is_finite: &mut bool) -> Column<T, R> {
        rough.zip_map(&self, |rough, entry| entry.rounded(rough, is_finite))
    }
}

impl<A: Rounded<B>, B, const N: usize> Rounded<[B; N]> for [A; N] {
    fn rounded(self, rough: [B; N], is_finite: &mut bool) -> [B; N] {
        let mut items = self.into_iter();
        // As many items as rough ones.
        rough.map(|rough| match items.next() {
            Some(item) => item.rounded(rough, is_finite),
            None => rough,
        })
    }
}

impl<T: Real> Rounded<PointMotion<T>> for PointMotion<Wide> {
    fn rounded(self, rough: PointMotion<T>, is_finite: &mut bool) -> PointMotion<T> {
        let PointMotion { position, velocity, acceleration } = rough;
        let rough = [position.coords, velocity, acceleration];
        let Self { position, velocity, acceleration } = self;
        let [position, velocity, acceleration] = [position.coords, velocity, acceleration].rounded(rough, is_finite);
        PointMotion { position: Point2::from(position), velocity, acceleration }
    }
}

impl<T: Real> Rounded<OutputMotion<T>> for OutputMotion<Wide> {
    fn rounded(self, rough: OutputMotion<T>, is_finite: &mut bool) -> OutputMotion<T> {
        let OutputMotion { value, rate, acceleration } = rough;
        let rough = [value, rate, acceleration];
        let Self { value, rate, acceleration } = self;
        let [value, rate, acceleration] = [value, rate, acceleration].rounded(rough, is_finite);
        OutputMotion { value, rate, acceleration }
    }
}

/// The matrix or the matrices rounded; `None` if a number is not finite.
#[must_use]
pub fn rounded<A: Rounded<B>, B>(wide: A, rough: B) -> Option<B> {
    let mut is_finite = true;
    let rounded = wide.rounded(rough, &mut is_finite);
    is_finite.then_some(rounded)
}

/// The numbers by name rounded, as [`rounded`].
#[must_use]
pub fn rounded_by_name<T, A, B, const N: usize>(wide: A, rough: B) -> Option<B>
where
    T: Real,
    SVector<Wide, N>: From<A>,
    SVector<T, N>: From<B>,
    B: From<SVector<T, N>>,
{
    rounded(SVector::from(wide), SVector::from(rough)).map(B::from)
}

/// A value for each point or output rounded, as [`rounded`].
#[must_use]
pub fn rounded_each<X, Y, A, B, const N: usize>(wide: A, rough: B) -> Option<B>
where
    X: Rounded<Y>,
    [X; N]: From<A>,
    [Y; N]: From<B>,
    B: From<[Y; N]>,
{
    rounded(<[X; N]>::from(wide), <[Y; N]>::from(rough)).map(B::from)
}
