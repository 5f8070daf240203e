//! Position, velocity and acceleration of one quantity.

use nalgebra::{Point2, SMatrix, Scalar, Vector2};

use crate::error::all_finite;
use crate::{D, Matrix, Name, PositionError, Real};

/// The motion of a point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct PointMotion<T: Scalar = f64> {
    /// The position.
    pub position: Point2<T>,
    /// The velocity.
    pub velocity: Vector2<T>,
    /// The acceleration.
    pub acceleration: Vector2<T>,
}

/// The motion of a scalar quantity.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct OutputMotion<T = f64> {
    /// The value.
    pub value: T,
    /// The rate.
    pub rate: T,
    /// The second derivative.
    pub acceleration: T,
}

/// Checks points and converts their components, in order, to points by name.
///
/// # Errors
/// [`PositionError::NotFinite`] with these names.
#[inline]
pub fn finite_points<T: Real, S: Name, G: From<[Point2<T>; N]>, const N: usize>(
    mechanism: S,
    quantity: S,
    points: [[T; 2]; N],
) -> Result<G, PositionError<S>> {
    all_finite(mechanism, quantity, points.as_flattened().iter())?;
    Ok(G::from(points.map(Point2::from)))
}

/// Checks velocities or accelerations of points and converts their components, in order, to vectors by name.
///
/// # Errors
/// [`PositionError::NotFinite`] with these names.
#[inline]
pub fn finite_vectors<T: Real, S: Name, G: From<[Vector2<T>; N]>, const N: usize>(
    mechanism: S,
    quantity: S,
    vectors: [[T; 2]; N],
) -> Result<G, PositionError<S>> {
    all_finite(mechanism, quantity, vectors.as_flattened().iter())?;
    Ok(G::from(vectors.map(Vector2::from)))
}

/// Checks outputs or their rates and converts them, in order, to outputs by name.
///
/// # Errors
/// [`PositionError::NotFinite`] with these names.
#[inline]
pub fn finite_outputs<T: Real, S: Name, G: From<[T; N]>, const N: usize>(
    mechanism: S,
    quantity: S,
    outputs: [T; N],
) -> Result<G, PositionError<S>> {
    all_finite(mechanism, quantity, outputs.iter())?;
    Ok(G::from(outputs))
}

/// Checks derivatives of points or outputs and converts them to matrices by name, each of R rows and C columns.
///
/// # Errors
/// [`PositionError::NotFinite`] with these names.
#[inline]
pub fn finite_matrices<T: Real, S: Name, G, const N: usize, const R: usize, const C: usize>(
    mechanism: S,
    quantity: S,
    matrices: [[[T; R]; C]; N],
) -> Result<G, PositionError<S>>
where
    G: From<[SMatrix<T, R, C>; N]>,
{
    all_finite(mechanism, quantity, matrices.as_flattened().as_flattened().iter())?;
    Ok(G::from(matrices.map(SMatrix::from)))
}

/// Checks the motions of points, each position, velocity and acceleration, and converts them to motions by name.
///
/// # Errors
/// [`PositionError::NotFinite`] with this name.
#[inline]
pub fn point_motions<T: Real, S: Name, G: From<[PointMotion<T>; N]>, const N: usize>(
    mechanism: S,
    points: [[[T; 2]; 3]; N],
) -> Result<G, PositionError<S>> {
    all_finite(mechanism, S::from_static("motion"), points.as_flattened().as_flattened().iter())?;
    Ok(G::from(points.map(|point| {
        let [position, velocity, acceleration] = point;
        PointMotion { position: position.into(), velocity: velocity.into(), acceleration: acceleration.into() }
    })))
}

/// Checks the motions of outputs, each value, rate and second derivative, and converts them to motions by name.
///
/// # Errors
/// [`PositionError::NotFinite`] with this name.
#[inline]
pub fn output_motions<T: Real, S: Name, G: From<[OutputMotion<T>; N]>, const N: usize>(
    mechanism: S,
    outputs: [[T; 3]; N],
) -> Result<G, PositionError<S>> {
    all_finite(mechanism, S::from_static("motion"), outputs.as_flattened().iter())?;
    Ok(G::from(outputs.map(|[value, rate, acceleration]| OutputMotion { value, rate, acceleration })))
}

/// Converts matrices by name to matrices with their dimensions as types.
#[inline]
pub fn each_sized<T: Real, A, B, const N: usize, const R: usize, const C: usize>(matrices: A) -> B
where
    [SMatrix<T, R, C>; N]: From<A>,
    B: From<[Matrix<T, D<R>, D<C>>; N]>,
{
    <[SMatrix<T, R, C>; N]>::from(matrices).map(Matrix::from).into()
}
