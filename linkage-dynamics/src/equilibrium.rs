//! Equilibrium by Newton's method on the forces of the inputs.

use nalgebra::{Const, DimMin, SMatrix, SVector};

use linkage_runtime::__shared::all_finite;
use linkage_runtime::__shared::beside_columns;
use linkage_runtime::__shared::{Closures, search};
use linkage_runtime::__shared::{Factorization, product_of_pivots};
use linkage_runtime::{Error, Real, Solution, real};

/// Positions close to rounding only, and forces are no better than positions: a sum of forces is zero beside this
/// many times the sum of their magnitudes.
const COARSER: f64 = 64.0;

/// The forces of the free inputs at a position.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Balance<T, const N: usize> {
    /// What is zero in equilibrium.
    pub forces: [T; N],
    /// The sums of the magnitudes of what each is made of.
    pub sizes: [T; N],
    /// Their derivatives by the inputs, column by column.
    pub slopes: [[T; N]; N],
}

/// The position where the forces of the free inputs vanish, from `start` on; `evaluate` closes the mechanism at
/// values of these inputs. Stable or not is not asked.
///
/// # Errors
/// What `evaluate` says of the start, [`Error::NotConverged`] if no equilibrium is found, [`Error::NotFinite`] if a
/// number is not finite.
pub fn equilibrium<T, Q, const N: usize>(
    scene: &'static str,
    start: [T; N],
    evaluate: impl Fn([T; N]) -> Result<(Q, Balance<T, N>), Error>,
) -> Result<Q, Error>
where
    T: Real,
    Const<N>: DimMin<Const<N>, Output = Const<N>>,
{
    let (_, Balance { mut sizes, slopes, .. }) = evaluate(start)?;
    // What the forces change by over the whole of an input is a size, too: a single spring is slack where it rests.
    for (column, input) in slopes.into_iter().zip(start) {
        for (size, slope) in sizes.iter_mut().zip(column) {
            *size += (slope * input).abs();
        }
    }
    // Relative to an infinite size every force would be zero.
    all_finite(scene, "the forces at rest", sizes.iter())?;
    // The measure stays as it is, so that smaller forces are better.
    let sizes = SVector::from(sizes) * real::<T>(COARSER);
    let (found, _) = search(&Forces { scene, sizes, evaluate: &evaluate }, SVector::from(start))?;
    found.point.map(|(q, ..)| q)
}

/// The coordinates of a position that is on the branch of its guess.
///
/// # Errors
/// [`Error::OtherBranch`] if it is not.
pub fn on_branch<Q>(scene: &'static str, found: Solution<Q>) -> Result<Q, Error> {
    if found.same_branch {
        Ok(found.coordinates)
    } else {
        Err(Error::OtherBranch { mechanism: scene, group: "a loop" })
    }
}

struct Forces<'a, T, F, const N: usize> {
    scene: &'static str,
    sizes: SVector<T, N>,
    evaluate: &'a F,
}

impl<T, Q, F, const N: usize> Closures<T, N> for Forces<'_, T, F, N>
where
    T: Real,
    F: Fn([T; N]) -> Result<(Q, Balance<T, N>), Error>,
    Const<N>: DimMin<Const<N>, Output = Const<N>>,
{
    type Point = Result<(Q, Balance<T, N>), Error>;

    fn at(&self, inputs: &SVector<T, N>) -> Self::Point {
        (self.evaluate)((*inputs).into())
    }

    fn residual(&self, point: &Self::Point) -> (SVector<T, N>, SVector<T, N>) {
        // Where the mechanism cannot be closed there is no force, and no step ends there.
        let none = || SVector::repeat(T::zero() / T::zero());
        (point.as_ref().map_or_else(|_| none(), |(_, balance)| SVector::from(balance.forces)), self.sizes)
    }

    fn solve(&self, point: &Self::Point, right: &SVector<T, N>) -> Result<SVector<T, N>, Error> {
        let (_, balance) = point.as_ref().map_err(|error| *error)?;
        let factors = Factorization::new(self.scene, "the stiffness", balance.slopes, self.sizes.into())?;
        Ok(SVector::from(factors.solve((*right).into())))
    }

    fn jacobian(&self, point: &Self::Point) -> SMatrix<T, N, N> {
        point.as_ref().map_or_else(|_| SMatrix::zeros(), |(_, balance)| SMatrix::from(balance.slopes))
    }

    fn regularity(&self, point: &Self::Point) -> f64 {
        point.as_ref().map_or(0.0, |(_, balance)| {
            beside_columns(product_of_pivots(balance.slopes), &SMatrix::from(balance.slopes))
        })
    }

    fn names(&self) -> (&'static str, Option<&'static str>) {
        (self.scene, None)
    }
}
