//! Equilibrium by Newton's method on the forces of the inputs.

use core::marker::PhantomData;

use crate::MotionError;
use linkage_runtime::__shared::{Constraints, Factorization, all_finite, hadamard_ratio, product_of_pivots, search};
use linkage_runtime::{Column, D, Matrix, PositionError, Real, real};

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
/// What `evaluate` says of the start, [`PositionError::NotConverged`] if no equilibrium is found,
/// [`PositionError::NotFinite`] if a number is not finite.
pub fn equilibrium<T, Q, const N: usize>(
    scene: &'static str,
    start: [T; N],
    evaluate: impl Fn([T; N]) -> Result<(Q, Balance<T, N>), MotionError>,
) -> Result<Q, MotionError>
where
    T: Real,
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
    let sizes = Column::from(sizes) * real::<T>(COARSER);
    let forces = Forces { scene, sizes, evaluate: &evaluate, position: PhantomData };
    let (found, _) = search(&forces, Column::from(start))?;
    found.point.map(|(q, ..)| q)
}

struct Forces<'a, T: Real, Q, F, const N: usize> {
    scene: &'static str,
    sizes: Column<T, D<N>>,
    evaluate: &'a F,
    position: PhantomData<Q>,
}

impl<T, Q, F, const N: usize> Constraints for Forces<'_, T, Q, F, N>
where
    T: Real,
    F: Fn([T; N]) -> Result<(Q, Balance<T, N>), MotionError>,
{
    type Scalar = T;
    type N = D<N>;
    type Point = Result<(Q, Balance<T, N>), MotionError>;

    fn at(&self, inputs: &Column<T, D<N>>) -> Self::Point {
        (self.evaluate)((*inputs).into())
    }

    fn residual(&self, point: &Self::Point) -> (Column<T, D<N>>, Column<T, D<N>>) {
        // Where the mechanism cannot be closed there is no force, and no step ends there.
        let none = || Column::repeat(T::zero() / T::zero());
        (point.as_ref().map_or_else(|_| none(), |(_, balance)| balance.forces.into()), self.sizes)
    }

    fn solve(&self, point: &Self::Point, right: &Column<T, D<N>>) -> Result<Column<T, D<N>>, PositionError> {
        // No step starts there either.
        let none = PositionError::NotFinite { mechanism: self.scene, quantity: "the forces at rest" };
        let (_, balance) = point.as_ref().map_err(|_| none)?;
        let factors = Factorization::new(self.scene, "the stiffness", balance.slopes, self.sizes.into())?;
        Ok(factors.solve((*right).into()).into())
    }

    fn jacobian(&self, point: &Self::Point) -> Matrix<T, D<N>, D<N>> {
        point.as_ref().map_or_else(|_| Matrix::zeros(), |(_, balance)| balance.slopes.into())
    }

    fn regularity(&self, point: &Self::Point) -> f64 {
        point.as_ref().map_or(0.0, |(_, balance)| {
            hadamard_ratio(product_of_pivots(balance.slopes), &Matrix::from(balance.slopes))
        })
    }

    fn names(&self) -> (&'static str, Option<&'static str>) {
        (self.scene, None)
    }
}
