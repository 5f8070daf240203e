//! Motions whose ends are known.

use linkage::nalgebra::SVector;
use linkage::{Mechanism, Scene};

/// A motion whose end is known, as the state y = (q, v') of its scene.
pub struct Problem<S, const U: usize, const V: usize, const N: usize> {
    pub scene: S,
    pub start: SVector<f64, N>,
    /// From 0 to here.
    pub end: f64,
    /// All coordinates there; the rates are not looked at.
    pub expected: SVector<f64, N>,
}

type Coordinates<S, const U: usize, const V: usize, const N: usize> =
    <<S as Scene<f64, U, V, N, 0>>::Mechanism as Mechanism<f64, U, V>>::Coordinates;

impl<S: Scene<f64, U, V, N, 0>, const U: usize, const V: usize, const N: usize> Problem<S, U, V, N> {
    /// From a position and the rates of the inputs to a time and the position then.
    pub fn new(
        scene: S,
        (start, rates): (Coordinates<S, U, V, N>, [f64; V]),
        (end, expected): (f64, Coordinates<S, U, V, N>),
    ) -> Self {
        let rates = SVector::from(rates).into();
        Self { scene, start: S::state(&start, &rates), end, expected: S::state(&expected, &rates) }
    }

    /// How far the coordinates are off at the end: the largest error of an angle, in radians.
    pub fn error(&self, y: &SVector<f64, N>) -> f64 {
        let errors = (0..U + V).map(|coordinate| (y[coordinate] - self.expected[coordinate]).abs());
        // What is not a number must not be lost in a maximum.
        errors.fold(0.0, |most, error| if error.is_nan() { f64::INFINITY } else { most.max(error) })
    }

    /// The largest residual of a closure.
    pub fn gap(&self, y: &SVector<f64, N>) -> f64 {
        let (mechanism, (q, _)) = (self.scene.mechanism(), S::parts(y));
        mechanism.residual(&mechanism.pose_at(&q)).amax()
    }
}
