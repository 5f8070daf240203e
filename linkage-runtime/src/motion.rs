//! Position, velocity and acceleration of one quantity.

use nalgebra::{Point2, SMatrix, Scalar, Vector2};

use crate::error::all_finite;
use crate::{PositionError, Real};

/// A point in motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PointMotion<T: Scalar = f64> {
    /// Where it is.
    pub position: Point2<T>,
    /// Its velocity.
    pub velocity: Vector2<T>,
    /// Its acceleration.
    pub acceleration: Vector2<T>,
}

/// A scalar quantity in motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OutputMotion<T = f64> {
    /// Its value.
    pub value: T,
    /// Its rate.
    pub velocity: T,
    /// The rate of its rate.
    pub acceleration: T,
}

/// Points by name, from their components in order.
///
/// # Errors
/// [`PositionError::NotFinite`] with these names.
#[inline]
pub fn finite_points<T: Real, G: From<[Point2<T>; N]>, const N: usize>(
    mechanism: &'static str,
    quantity: &'static str,
    points: [[T; 2]; N],
) -> Result<G, PositionError> {
    all_finite(mechanism, quantity, points.as_flattened().iter())?;
    Ok(G::from(points.map(Point2::from)))
}

/// Velocities or accelerations of points by name, from their components in order.
///
/// # Errors
/// [`PositionError::NotFinite`] with these names.
#[inline]
pub fn finite_vectors<T: Real, G: From<[Vector2<T>; N]>, const N: usize>(
    mechanism: &'static str,
    quantity: &'static str,
    vectors: [[T; 2]; N],
) -> Result<G, PositionError> {
    all_finite(mechanism, quantity, vectors.as_flattened().iter())?;
    Ok(G::from(vectors.map(Vector2::from)))
}

/// Outputs or their rates by name, in order.
///
/// # Errors
/// [`PositionError::NotFinite`] with these names.
#[inline]
pub fn finite_outputs<T: Real, G: From<[T; N]>, const N: usize>(
    mechanism: &'static str,
    quantity: &'static str,
    outputs: [T; N],
) -> Result<G, PositionError> {
    all_finite(mechanism, quantity, outputs.iter())?;
    Ok(G::from(outputs))
}

/// Derivatives of points or outputs by name, each a matrix of R rows by its C columns.
///
/// # Errors
/// [`PositionError::NotFinite`] with these names.
#[inline]
pub fn finite_matrices<T: Real, G, const N: usize, const R: usize, const C: usize>(
    mechanism: &'static str,
    quantity: &'static str,
    matrices: [[[T; R]; C]; N],
) -> Result<G, PositionError>
where
    G: From<[SMatrix<T, R, C>; N]>,
{
    all_finite(mechanism, quantity, matrices.as_flattened().as_flattened().iter())?;
    Ok(G::from(matrices.map(SMatrix::from)))
}

/// Points in motion by name: position, velocity and acceleration of each in order.
///
/// # Errors
/// [`PositionError::NotFinite`] with this name.
#[inline]
pub fn point_motions<T: Real, G: From<[PointMotion<T>; N]>, const N: usize>(
    mechanism: &'static str,
    points: [[[T; 2]; 3]; N],
) -> Result<G, PositionError> {
    all_finite(mechanism, "motion", points.as_flattened().as_flattened().iter())?;
    Ok(G::from(points.map(|point| {
        let [position, velocity, acceleration] = point;
        PointMotion { position: position.into(), velocity: velocity.into(), acceleration: acceleration.into() }
    })))
}

/// Outputs in motion by name: value, rate and the rate of the rate of each in order.
///
/// # Errors
/// [`PositionError::NotFinite`] with this name.
#[inline]
pub fn output_motions<T: Real, G: From<[OutputMotion<T>; N]>, const N: usize>(
    mechanism: &'static str,
    outputs: [[T; 3]; N],
) -> Result<G, PositionError> {
    all_finite(mechanism, "motion", outputs.as_flattened().iter())?;
    Ok(G::from(outputs.map(|[value, velocity, acceleration]| OutputMotion { value, velocity, acceleration })))
}
