//! Position by Newton's method: of a mechanism as a whole, and of one group of it.

use nalgebra::{Const, DimMin, SMatrix, SVector};

use crate::error::all_finite;
use crate::mechanism::finite_coordinates;
use crate::newton::{Closures, Iterate, search};
use crate::scalar::to_f64;
use crate::{Error, Factorization, Mechanism, Real, linear::same_signs, product_of_pivots};

/// A position and how it was found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Solution<Q> {
    /// The position.
    pub coordinates: Q,
    /// Newton steps taken.
    pub iterations: usize,
    /// The largest residual left, beside the sum of the magnitudes of its terms.
    pub residual: f64,
    /// Whether the determinant of each block of J has the sign it had at the guess: if not, the
    /// position belongs to another assembly branch than the guess, or the guess lay beyond a dead point.
    pub same_branch: bool,
}

/// One step of Newton's method without damping: q with u - J^-1 Psi in place of u.
///
/// # Errors
/// [`Error::Singular`] where J has no inverse, [`Error::NotFinite`] if the step is not finite.
pub fn newton_step<T, M, const U: usize, const V: usize>(
    mechanism: &M,
    q: &M::Coordinates,
) -> Result<M::Coordinates, Error>
where
    T: Real,
    M: Mechanism<T, U, V>,
{
    let pose = mechanism.pose_at(q);
    let step = mechanism.solve_jacobian(&pose, &mechanism.residual(&pose))?;
    let next = M::with_unknowns(q, M::unknowns(q) - step);
    finite_coordinates::<M, T, U, V>(&next)?;
    Ok(next)
}

/// The position near `guess` whose inputs are those of `guess`, all unknowns together.
///
/// Steps are halved until the residual falls. The search ends at a residual that rounding explains,
/// after one more step that removes what the last one left.
///
/// # Errors
/// [`Error::NotConverged`] if the residual stays, [`Error::NotFinite`] if a number is not finite.
pub fn newton<T, M, const U: usize, const V: usize>(
    mechanism: &M,
    guess: &M::Coordinates,
) -> Result<Solution<M::Coordinates>, Error>
where
    T: Real,
    M: Mechanism<T, U, V>,
{
    // An input may be in no closure.
    all_finite(M::NAME, "the input", M::inputs(guess).iter())?;
    let (Iterate { unknowns, point, size, .. }, iterations) =
        search(&Whole::<_, _, V> { mechanism, guess }, M::unknowns(guess))?;
    Ok(Solution {
        coordinates: M::with_unknowns(guess, unknowns),
        iterations,
        residual: to_f64(size),
        same_branch: mechanism.same_branch(&mechanism.pose_at(guess), &point),
    })
}

/// The unknowns of one group, by their names in `group`, near `start`; the groups before it are solved.
///
/// `evaluate` gives the closures of the group, the sums of the magnitudes of their terms, and their derivatives
/// by the unknowns, column by column. The search is that of [`newton`].
///
/// # Errors
/// [`Error::NotConverged`] if the residual stays, [`Error::OtherBranch`] if the group is singular somewhere
/// between the start and what was found, [`Error::NotFinite`] if a number is not finite.
pub fn newton_group<T, const N: usize>(
    mechanism: &'static str,
    group: &'static str,
    start: [T; N],
    evaluate: impl Fn([T; N]) -> Evaluated<T, N>,
) -> Result<[T; N], Error>
where
    T: Real,
    Const<N>: DimMin<Const<N>, Output = Const<N>>,
{
    let (_, _, before) = evaluate(start);
    let (Iterate { unknowns, point: (_, _, after), .. }, _) =
        search(&Part { mechanism, group, evaluate }, SVector::from(start))?;
    if same_signs(&[product_of_pivots(before)], &[product_of_pivots(after)]) {
        Ok(unknowns.into())
    } else {
        Err(Error::OtherBranch { mechanism, group })
    }
}

/// Psi, the sizes of its terms, and the columns of J.
type Evaluated<T, const N: usize> = ([T; N], [T; N], [[T; N]; N]);

/// A mechanism whose inputs are those of a guess.
struct Whole<'a, M, Q, const V: usize> {
    mechanism: &'a M,
    guess: &'a Q,
}

impl<T, M, const U: usize, const V: usize> Closures<T, U> for Whole<'_, M, M::Coordinates, V>
where
    T: Real,
    M: Mechanism<T, U, V>,
{
    type Point = M::Pose;

    fn at(&self, unknowns: &SVector<T, U>) -> M::Pose {
        self.mechanism.pose_at(&M::with_unknowns(self.guess, *unknowns))
    }

    fn residual(&self, pose: &M::Pose) -> (SVector<T, U>, SVector<T, U>) {
        (self.mechanism.residual(pose), self.mechanism.closure_sizes(pose))
    }

    fn solve(&self, pose: &M::Pose, right: &SVector<T, U>) -> Result<SVector<T, U>, Error> {
        self.mechanism.solve_jacobian(pose, right)
    }

    fn jacobian(&self, pose: &M::Pose) -> SMatrix<T, U, U> {
        self.mechanism.jacobian_unknowns(pose)
    }

    fn regularity(&self, pose: &M::Pose) -> f64 {
        beside_columns(self.mechanism.determinant(pose), &self.mechanism.jacobian_unknowns(pose))
    }

    fn names(&self) -> (&'static str, Option<&'static str>) {
        (M::NAME, None)
    }
}

/// One group of a mechanism.
struct Part<F> {
    mechanism: &'static str,
    group: &'static str,
    evaluate: F,
}

impl<T, F, const N: usize> Closures<T, N> for Part<F>
where
    T: Real,
    F: Fn([T; N]) -> Evaluated<T, N>,
    Const<N>: DimMin<Const<N>, Output = Const<N>>,
{
    type Point = Evaluated<T, N>;

    fn at(&self, unknowns: &SVector<T, N>) -> Self::Point {
        (self.evaluate)((*unknowns).into())
    }

    fn residual(&self, (residual, sizes, _): &Self::Point) -> (SVector<T, N>, SVector<T, N>) {
        (SVector::from(*residual), SVector::from(*sizes))
    }

    fn solve(&self, (_, sizes, columns): &Self::Point, right: &SVector<T, N>) -> Result<SVector<T, N>, Error> {
        let factors = Factorization::new(self.mechanism, self.group, *columns, *sizes)?;
        Ok(SVector::from(factors.solve((*right).into())))
    }

    fn jacobian(&self, (_, _, columns): &Self::Point) -> SMatrix<T, N, N> {
        SMatrix::from(*columns)
    }

    fn regularity(&self, (_, _, columns): &Self::Point) -> f64 {
        beside_columns(product_of_pivots(*columns), &SMatrix::from(*columns))
    }

    fn names(&self) -> (&'static str, Option<&'static str>) {
        (self.mechanism, Some(self.group))
    }
}

/// |det J| beside the product of the sizes of its columns.
pub fn beside_columns<T: Real, const N: usize>(determinant: T, jacobian: &SMatrix<T, N, N>) -> f64 {
    let product = jacobian.column_iter().fold(T::one(), |product, column| product * column.norm());
    if product > T::zero() { to_f64(determinant.abs() / product) } else { 0.0 }
}
