//! Position, velocity and acceleration of one quantity.

use nalgebra::Vector2;

/// A point in motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PointMotion<T = f64> {
    /// Where it is.
    pub position: Vector2<T>,
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
