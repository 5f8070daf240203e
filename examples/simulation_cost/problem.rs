//! Motions with known final states.

use linkage::{Column, Dim, Mechanism, Scene};

type Coordinates<S> = <<S as Scene>::Mechanism as Mechanism>::Coordinates;
type Inputs<S> = <<S as Scene>::Mechanism as Mechanism>::Inputs;

/// The state y = (q, v') of a scene.
pub type State<S> = Column<f64, <S as Scene>::State>;

/// A scene of emitted code: its errors are those of functions as systems of equations.
pub trait Emitted: Scene<Scalar = f64, Mechanism: Mechanism<Name = &'static str>> {}

impl<S: Scene<Scalar = f64, Mechanism: Mechanism<Name = &'static str>>> Emitted for S {}

/// A motion with known final state.
pub struct Problem<S: Emitted> {
    pub scene: S,
    pub start: State<S>,
    /// The end time; the start is 0.
    pub end: f64,
    /// All coordinates at the end; the rates are not compared.
    pub expected: State<S>,
}

impl<S: Emitted> Problem<S> {
    /// Creates a problem from the initial position and input rates, and the end time with its position.
    pub fn new(
        scene: S,
        (start, input_rates): (Coordinates<S>, impl Into<Inputs<S>>),
        (end, expected): (f64, Coordinates<S>),
    ) -> Self {
        let input_rates = input_rates.into();
        Self { scene, start: S::state(&start, &input_rates), end, expected: S::state(&expected, &input_rates) }
    }

    /// The largest error of an angle at the end, in radians.
    pub fn error(&self, y: &State<S>) -> f64 {
        let error = (*y - self.expected).abs();
        // `max` would ignore a NaN.
        let largest = |most: f64, &error: &f64| if error.is_nan() { f64::INFINITY } else { most.max(error) };
        error
            .iter()
            .take(self.scene.mechanism().dims().0.count() + self.scene.mechanism().dims().1.count())
            .fold(0.0, largest)
    }

    /// The largest residual of the constraints.
    pub fn gap(&self, y: &State<S>) -> f64 {
        let mechanism = self.scene.mechanism();
        mechanism.residual(&mechanism.pose_at(&S::parts(y).q)).largest()
    }
}
