//! Equilibrium: Newton's method on the generalised forces of the inputs.

use core::marker::PhantomData;

use crate::MotionError;
use linkage_runtime::__shared::{Constraints, Factorization, all_finite, hadamard_ratio, product_of_pivots, search};
use linkage_runtime::{Column, D, Matrix, Name, PositionError, Real, real};

/// The factor on the scales of the forces in Newton's convergence test: forces inherit the rounding errors of the
/// positions.
const SCALE_FACTOR: f64 = 64.0;

/// The quantity named in errors.
const REST: &str = "the forces at rest";

/// The generalised forces of the free inputs at a position.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(bound(
        serialize = "T: Copy + core::fmt::Debug + serde::Serialize",
        deserialize = "T: Copy + core::fmt::Debug + serde::Deserialize<'de>"
    ))
)]
pub struct Balance<T, const N: usize> {
    /// The generalised forces: zero in equilibrium.
    #[cfg_attr(feature = "serde", serde(with = "linkage_runtime::__shared::array"))]
    pub forces: [T; N],
    /// The scale of each force: the sum of the magnitudes of its terms.
    #[cfg_attr(feature = "serde", serde(with = "linkage_runtime::__shared::array"))]
    pub scales: [T; N],
    /// The derivatives of the forces with respect to the inputs, column by column.
    #[cfg_attr(feature = "serde", serde(with = "linkage_runtime::__shared::columns"))]
    pub slopes: [[T; N]; N],
}

/// Finds the position where the forces of the free inputs vanish, starting at `start`; `evaluate` assembles the
/// mechanism at values of these inputs. The equilibrium may be unstable.
///
/// # Errors
/// Those of `evaluate` at the start, [`PositionError::NotConverged`] if no equilibrium is found,
/// [`PositionError::NotFinite`] if a number is not finite.
pub fn equilibrium<T, Q, S, const N: usize>(
    scene: S,
    start: [T; N],
    evaluate: impl Fn([T; N]) -> Result<(Q, Balance<T, N>), MotionError<S>>,
) -> Result<Q, MotionError<S>>
where
    T: Real,
    S: Name + Copy,
{
    let (_, Balance { mut scales, slopes, .. }) = evaluate(start)?;
    // The scale includes slope * input: a single spring is slack at its equilibrium, so its own terms vanish there.
    for (column, input) in slopes.into_iter().zip(start) {
        for (scale, slope) in scales.iter_mut().zip(column) {
            *scale += (slope * input).abs();
        }
    }
    // Relative to an infinite scale every force would be zero.
    all_finite(scene, S::from_static(REST), scales.iter())?;
    // The scale stays constant during the search, so that smaller forces always count as better.
    let scales = Column::from(scales) * real::<T>(SCALE_FACTOR);
    let forces = Forces { scene, scales, evaluate: &evaluate, position: PhantomData };
    let (found, _) = search(&forces, Column::from(start))?;
    found.point.map(|(q, ..)| q)
}

struct Forces<'a, T: Real, S, Q, F, const N: usize> {
    scene: S,
    scales: Column<T, D<N>>,
    evaluate: &'a F,
    position: PhantomData<Q>,
}

impl<T, S, Q, F, const N: usize> Constraints for Forces<'_, T, S, Q, F, N>
where
    T: Real,
    S: Name + Copy,
    F: Fn([T; N]) -> Result<(Q, Balance<T, N>), MotionError<S>>,
{
    type Scalar = T;
    type Name = S;
    type N = D<N>;
    type Point = Result<(Q, Balance<T, N>), MotionError<S>>;

    fn at(&self, inputs: &Column<T, D<N>>) -> Self::Point {
        (self.evaluate)((*inputs).into())
    }

    fn residual(&self, point: &Self::Point) -> (Column<T, D<N>>, Column<T, D<N>>) {
        // NaN where the mechanism cannot be assembled: the line search then rejects the step.
        let none = || Column::repeat(T::zero() / T::zero());
        (point.as_ref().map_or_else(|_| none(), |(_, balance)| balance.forces.into()), self.scales)
    }

    fn solve(&self, point: &Self::Point, right: &Column<T, D<N>>) -> Result<Column<T, D<N>>, PositionError<S>> {
        // Not reached: no step starts at such a position.
        let none = PositionError::NotFinite { mechanism: self.scene, quantity: S::from_static(REST) };
        let (_, balance) = point.as_ref().map_err(|_| none)?;
        let factors =
            Factorization::new(self.scene, S::from_static("the stiffness"), balance.slopes, self.scales.into())?;
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

    fn names(&self) -> (S, Option<S>) {
        (self.scene, None)
    }
}
