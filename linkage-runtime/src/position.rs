//! Positions by Newton's method, for a mechanism as a whole and for one of its groups.

use core::fmt::{self, Debug, Display, Formatter};
use core::marker::PhantomData;

use crate::error::all_finite;
use crate::jacobian::Blocks;
use crate::jacobian::correction;
use crate::jacobian::ulp::nearly_zero;
use crate::linear::{Factorization, product_of_pivots, same_signs};
use crate::mechanism::finite_coordinates;
use crate::newton::{Constraints, Iterate, search};
use crate::scalar::to_f64;
use crate::{Column, D, Dim, Matrix, Mechanism, Name, PerUnknown, PositionError, PositionErrorOf, Real};

/// A position on the branch of its guess, with the effort and the residual of the search.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Solution<Q> {
    /// The position.
    pub coordinates: Q,
    /// Newton steps taken.
    pub iterations: usize,
    /// The largest residual, divided by the sum of the magnitudes of its terms.
    pub residual: f64,
}

/// A position on any branch, with the effort and the residual of the search.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct AnyBranch<Q> {
    /// The position.
    pub coordinates: Q,
    /// Newton steps taken.
    pub iterations: usize,
    /// The largest residual, divided by the sum of the magnitudes of its terms.
    pub residual: f64,
    /// True if the determinant of each block of J has the sign it had at the guess: if not, the position belongs to
    /// another assembly branch than the guess, or the guess was beyond a dead point.
    pub same_branch: bool,
}

/// The coordinates, with the names of their type, the effort and the residual, in one line; [`Mechanism::named`] has angles in
/// degrees.
impl<Q: Debug> Display for Solution<Q> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Self { coordinates, iterations, residual } = self;
        found(f, coordinates, *iterations, *residual)
    }
}

/// The line of a [`Solution`], and if it is on another branch than the guess.
impl<Q: Debug> Display for AnyBranch<Q> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Self { coordinates, iterations, residual, same_branch } = self;
        found(f, coordinates, *iterations, *residual)?;
        f.write_str(if *same_branch { "" } else { ", on another branch than the guess" })
    }
}

fn found(f: &mut Formatter<'_>, coordinates: &impl Debug, iterations: usize, residual: f64) -> fmt::Result {
    let decimals = f.precision().unwrap_or(6);
    let steps = if iterations == 1 { "step" } else { "steps" };
    write!(f, "{coordinates:.decimals$?} after {iterations} Newton {steps}, relative residual {residual:.1e}")
}

/// One undamped Newton step: q with u - J^-1 Psi in place of u.
///
/// # Errors
/// [`PositionError::Singular`] if J is singular, [`PositionError::NotFinite`] if the step is not finite.
pub fn newton_step<M: Mechanism>(mechanism: &M, q: &M::Coordinates) -> Result<M::Coordinates, PositionErrorOf<M>> {
    let pose = mechanism.pose_at(q);
    let step = correction(mechanism, &pose)?;
    let next = M::with_unknowns(q, M::unknowns(q) - step);
    finite_coordinates(mechanism, &next)?;
    Ok(next)
}

/// Finds the position near `guess` at the inputs of `guess`, on the branch of `guess`, for all unknowns together.
///
/// Steps are halved until the residual decreases. The search ends at a residual within rounding error, after one more
/// step that reduces it further.
///
/// # Errors
/// [`PositionError::NotConverged`] if the residual does not vanish, [`PositionError::OtherBranch`] if the determinant
/// of a group has another sign than at the guess, [`PositionError::NotFinite`] if a number is not finite. If the
/// regularity of the group is below 16 sqrt(epsilon) at the guess or at the position, the sign is not compared.
/// [`PositionError::NotImplied`] if an implied loop does not close at the position.
pub fn newton<M: Mechanism>(
    mechanism: &M,
    guess: &M::Coordinates,
) -> Result<Solution<M::Coordinates>, PositionErrorOf<M>> {
    let (found, start, end) = searched(mechanism, guess)?;
    let AnyBranch { coordinates, iterations, residual, same_branch } = found;
    match if same_branch { None } else { left_group(mechanism, &start, &end) } {
        None => Ok(Solution { coordinates, iterations, residual }),
        Some(group) => Err(PositionError::OtherBranch { mechanism: mechanism.name(), group }),
    }
}

/// The first group whose determinant has another sign at the end than at the start and is not zero at either: a
/// position at a dead point is accurate to sqrt(epsilon) only.
fn left_group<M: Mechanism>(mechanism: &M, start: &M::Pose, end: &M::Pose) -> Option<M::Name> {
    let ends = [Blocks::of(mechanism, start), Blocks::of(mechanism, end)];
    let [before, after] = ends.each_ref().map(Blocks::determinants);
    let mut signs = before.iter().zip(after).map(|(&before, &after)| same_signs(&[before], &[after])).enumerate();
    let left = signs.find(|&(place, same)| !same && ends.iter().all(|blocks| blocks.regularity(place) > nearly_zero()));
    left.and_then(|(place, _)| mechanism.group(place)).map(|group| group.name)
}

/// Finds the position near `guess` at the inputs of `guess`, on any branch, by the search of [`newton`].
///
/// # Errors
/// [`PositionError::NotConverged`] if the residual does not vanish, [`PositionError::NotImplied`] if an implied loop does
/// not close, [`PositionError::NotFinite`] if a number is not finite.
pub fn newton_any_branch<M: Mechanism>(
    mechanism: &M,
    guess: &M::Coordinates,
) -> Result<AnyBranch<M::Coordinates>, PositionErrorOf<M>> {
    searched(mechanism, guess).map(|(found, ..)| found)
}

/// A position, and the poses of the guess and of the position.
type Searched<M> = (AnyBranch<<M as Mechanism>::Coordinates>, <M as Mechanism>::Pose, <M as Mechanism>::Pose);

fn searched<M: Mechanism>(mechanism: &M, guess: &M::Coordinates) -> Result<Searched<M>, PositionErrorOf<M>> {
    // An input may occur in no constraint.
    all_finite(mechanism.name(), Name::from_static("the input"), M::inputs(guess).iter())?;
    let (Iterate { unknowns, point, size, .. }, iterations) = search(&Whole { mechanism, guess }, M::unknowns(guess))?;
    let start = mechanism.pose_at(guess);
    let found = AnyBranch {
        coordinates: M::with_unknowns(guess, unknowns),
        iterations,
        residual: to_f64(size),
        same_branch: mechanism.same_branch(&start, &point),
    };
    mechanism.check_implied(&found.coordinates)?;
    Ok((found, start, point))
}

/// Solves for the unknowns of one group, named by `group`, near `start`; the groups before it are solved.
///
/// `evaluate` returns the residuals of the group, the sums of the magnitudes of their terms, and their derivatives by
/// the unknowns, column by column. The search is that of [`newton`].
///
/// # Errors
/// [`PositionError::NotConverged`] if the residual does not vanish, [`PositionError::OtherBranch`] if the group is
/// singular between the start and the position found, [`PositionError::NotFinite`] if a number is not finite.
pub fn newton_group<T, S, const N: usize>(
    mechanism: S,
    group: S,
    start: [T; N],
    evaluate: impl Fn([T; N]) -> Evaluated<T, N>,
) -> Result<[T; N], PositionError<S>>
where
    T: Real,
    S: Name + Copy,
{
    let (_, _, before) = evaluate(start);
    let (Iterate { unknowns, point: (_, _, after), .. }, _) =
        search(&Part { mechanism, group, evaluate, scalar: PhantomData }, Column::from(start))?;
    if same_signs(&[product_of_pivots(before)], &[product_of_pivots(after)]) {
        Ok(unknowns.into())
    } else {
        Err(PositionError::OtherBranch { mechanism, group })
    }
}

/// The solution for the unknowns of one group near `start`, on any branch.
///
/// # Errors
/// Those of [`newton_group`] but [`PositionError::OtherBranch`].
pub(crate) fn polished<T: Real, S: Name + Copy, const N: usize>(
    [mechanism, group]: [S; 2],
    start: [T; N],
    evaluate: impl Fn([T; N]) -> Evaluated<T, N>,
) -> Result<[T; N], PositionError<S>> {
    let part = Part { mechanism, group, evaluate, scalar: PhantomData };
    search(&part, Column::from(start)).map(|(found, _)| found.unknowns.into())
}

/// Psi, the sums of the magnitudes of its terms, and the columns of J.
pub(crate) type Evaluated<T, const N: usize> = ([T; N], [T; N], [[T; N]; N]);

/// A mechanism whose inputs are those of a guess.
struct Whole<'a, M: Mechanism> {
    mechanism: &'a M,
    guess: &'a M::Coordinates,
}

impl<M: Mechanism> Constraints for Whole<'_, M> {
    type Scalar = M::Scalar;
    type Name = M::Name;
    type N = M::U;
    type Point = M::Pose;

    fn at(&self, unknowns: &PerUnknown<M>) -> M::Pose {
        self.mechanism.pose_at(&M::with_unknowns(self.guess, *unknowns))
    }

    fn residual(&self, pose: &M::Pose) -> (PerUnknown<M>, PerUnknown<M>) {
        (self.mechanism.residual(pose), self.mechanism.residual_scales(pose))
    }

    fn solve(&self, pose: &M::Pose, right: &PerUnknown<M>) -> Result<PerUnknown<M>, PositionErrorOf<M>> {
        self.mechanism.solve_jacobian(pose, right)
    }

    fn jacobian(&self, pose: &M::Pose) -> Matrix<M::Scalar, M::U, M::U> {
        self.mechanism.jacobian_unknowns(pose)
    }

    fn regularity(&self, pose: &M::Pose) -> f64 {
        hadamard_ratio(self.mechanism.determinant(pose), &self.mechanism.jacobian_unknowns(pose))
    }

    fn names(&self) -> (M::Name, Option<M::Name>) {
        (self.mechanism.name(), None)
    }
}

/// One group of a mechanism.
struct Part<T, S, F, const N: usize> {
    mechanism: S,
    group: S,
    evaluate: F,
    scalar: PhantomData<T>,
}

impl<T, S, F, const N: usize> Constraints for Part<T, S, F, N>
where
    T: Real,
    S: Name + Copy,
    F: Fn([T; N]) -> Evaluated<T, N>,
{
    type Scalar = T;
    type Name = S;
    type N = D<N>;
    type Point = Evaluated<T, N>;

    fn at(&self, unknowns: &Column<T, D<N>>) -> Self::Point {
        (self.evaluate)((*unknowns).into())
    }

    fn residual(&self, (residual, scales, _): &Self::Point) -> (Column<T, D<N>>, Column<T, D<N>>) {
        (Column::from(*residual), Column::from(*scales))
    }

    fn solve(
        &self,
        (_, scales, columns): &Self::Point,
        right: &Column<T, D<N>>,
    ) -> Result<Column<T, D<N>>, PositionError<S>> {
        let factors = Factorization::new(self.mechanism, self.group, *columns, *scales)?;
        Ok(Column::from(factors.solve((*right).into())))
    }

    fn jacobian(&self, (_, _, columns): &Self::Point) -> Matrix<T, D<N>, D<N>> {
        Matrix::from(*columns)
    }

    fn regularity(&self, (_, _, columns): &Self::Point) -> f64 {
        regularity(*columns)
    }

    fn names(&self) -> (S, Option<S>) {
        (self.mechanism, Some(self.group))
    }
}

/// Hadamard's ratio of the columns of J of a group.
pub(crate) fn regularity<T: Real, const N: usize>(columns: [[T; N]; N]) -> f64 {
    hadamard_ratio(product_of_pivots(columns), &Matrix::from(columns))
}

/// |det J| divided by the product of the norms of its columns: Hadamard's ratio.
pub fn hadamard_ratio<T: Real, N: Dim>(determinant: T, jacobian: &Matrix<T, N, N>) -> f64 {
    let product = jacobian.columns().iter().fold(T::one(), |product, column| product * column.norm());
    if product > T::zero() { to_f64(determinant.abs() / product) } else { 0.0 }
}
