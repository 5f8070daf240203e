//! The curve Psi(q) = 0 in nondimensional coordinates: angles in radians, other coordinates and the residuals divided
//! by their scales.

use crate::held::Held;
use crate::jacobian::ulp::{EQUAL_ULPS, ZERO_ULPS};
use crate::jacobian::{
    EliminationOf as Elimination, Iteration, JacobianOf as Jacobian, ScalesOf as Scales, VectorOf as Vector, contract,
};
use crate::scalar::arithmetic::*;
use crate::scalar::{largest, to_f64};
use crate::{D, Mechanism, Name, PathError, PathErrorOf, PerInput, PerUnknown, PositionError, PositionErrorOf, real};

/// The most Newton steps of one correction: each at least halves the distance to the curve, and near it squares it.
const MOST_CORRECTIONS: usize = 12;

/// A mechanism with the scales of its coordinates and residuals.
pub(super) struct Curve<'a, M: Mechanism> {
    pub(super) mechanism: Held<'a, M>,
    scales: Scales<M>,
}

/// Psi and [J A] at a position.
pub(super) struct Linear<M: Mechanism> {
    pub(super) residual: PerUnknown<M>,
    /// The rounding error of each residual.
    pub(super) noise: PerUnknown<M>,
    pub(super) jacobian: Jacobian<M>,
}

/// The residual and the regularity of [J A] at which a step was rejected.
#[derive(Debug, Clone, Copy)]
pub(super) struct Rejection {
    pub(super) residual: f64,
    pub(super) regularity: f64,
}

/// The outcome of a trial step: a result, a rejection, which asks for a shorter step, or an error, which ends the path.
pub(super) type Tried<M, X> = Result<Result<X, Rejection>, PathError<<M as Mechanism>::Name>>;

impl<'a, M: Mechanism<V = D<1>>> Curve<'a, M> {
    pub(super) fn new(mechanism: Held<'a, M>, q: &M::Coordinates) -> Self {
        let scales = Scales::<M>::of(&*mechanism, &mechanism.pose_at(q));
        Self { mechanism, scales }
    }

    /// The numbers of unknowns and inputs.
    pub(super) fn dims(&self) -> (M::U, D<1>) {
        (self.mechanism.dims().0, D)
    }

    /// q + `by`, where `by` is nondimensional.
    pub(super) fn moved(&self, q: &M::Coordinates, by: &Vector<M>) -> M::Coordinates {
        let Vector::<M> { unknowns, inputs } = coordinates::<M>(q) + by.scaled(&self.scales.coordinates);
        M::coordinates(unknowns, inputs)
    }

    pub(super) fn difference(&self, to: &M::Coordinates, from: &M::Coordinates) -> Vector<M> {
        (coordinates::<M>(to) - coordinates::<M>(from)).relative_to(&self.scales.coordinates)
    }

    /// Converts a nondimensional direction to rates of the coordinates.
    pub(super) fn rates(&self, direction: &Vector<M>) -> M::Rates {
        let Vector::<M> { unknowns, inputs } = direction.scaled(&self.scales.coordinates);
        M::rates(unknowns, inputs)
    }

    pub(super) fn direction(&self, rates: &M::Rates) -> Vector<M> {
        let (unknowns, inputs) = M::rate_parts(rates);
        Vector::<M> { unknowns, inputs }.relative_to(&self.scales.coordinates)
    }

    pub(super) fn with_input(q: &M::Coordinates, input: M::Scalar) -> M::Coordinates {
        M::with_inputs(q, PerInput::<M>::from([input]))
    }

    /// q with another value of a coordinate, by its column in [J A].
    pub(super) fn with_coordinate(q: &M::Coordinates, column: usize, value: M::Scalar) -> M::Coordinates {
        let mut vector = coordinates::<M>(q);
        vector.set(column, value);
        M::coordinates(vector.unknowns, vector.inputs)
    }

    pub(super) fn input(q: &M::Coordinates) -> M::Scalar {
        M::inputs(q)[0]
    }

    /// A distance of the input divided by its scale.
    pub(super) fn input_distance(&self, distance: M::Scalar) -> M::Scalar {
        distance / self.scales.coordinates.inputs[0]
    }

    /// The rounding error of the nondimensional coordinates.
    pub(super) fn rounding_error(&self, q: &M::Coordinates) -> M::Scalar {
        (M::Scalar::one() + coordinates::<M>(q).relative_to(&self.scales.coordinates).largest())
            * M::Scalar::default_epsilon()
    }

    /// # Errors
    /// [`PositionError::NotFinite`] if a number is not finite.
    pub(super) fn linear(&self, q: &M::Coordinates) -> Result<Linear<M>, PositionErrorOf<M>> {
        let (mechanism, scales) = (&*self.mechanism, &self.scales.residuals);
        let pose = mechanism.pose_at(q);
        let here = coordinates::<M>(q).relative_to(&self.scales.coordinates);
        let jacobian = self.scales.jacobian(mechanism, &pose);
        let residual = mechanism.residual(&pose).component_div(scales);
        let terms = mechanism.residual_scales(&pose).component_div(scales);
        let noise = (terms + jacobian.abs().along(&here.abs())) * M::Scalar::default_epsilon();
        if here.is_finite() && residual.is_finite() && noise.is_finite() && jacobian.is_finite() {
            Ok(Linear { residual, noise, jacobian })
        } else {
            Err(PositionError::NotFinite { mechanism: self.mechanism.name(), quantity: Name::from_static("the path") })
        }
    }

    /// (Psi_q x)_q x: the second derivative of Psi along a direction.
    pub(super) fn curvature(&self, q: &M::Coordinates, x: &Vector<M>) -> PerUnknown<M> {
        let pose = self.mechanism.pose_at(q);
        self.mechanism.gamma(&pose, &self.rates(x)).component_div(&self.scales.residuals)
    }

    /// Corrects `guess` by Newton's method to the point of the curve in the plane through `guess` with this normal.
    ///
    /// # Errors
    /// Rejected where Newton's method does not contract, or where the curve is nearly parallel to the plane.
    pub(super) fn correct(
        &self,
        guess: M::Coordinates,
        normal: &Vector<M>,
    ) -> Tried<M, (M::Coordinates, Elimination<M>)> {
        let mut rejection = Rejection { residual: f64::NAN, regularity: f64::NAN };
        let found = contract(guess, MOST_CORRECTIONS, |q| -> Result<_, PathErrorOf<M>> {
            let at = self.linear(q)?;
            let elimination = Elimination::<M>::new(at.jacobian);
            let (tangent, part) = (elimination.tangent(), elimination.solve(&-at.residual));
            // [J A; n'] x = -{Psi; n' (q - guess)}: the rounding errors accumulated along n are removed.
            let along = normal.dot(&tangent);
            let drift = normal.dot(&(self.difference(q, &guess) + part));
            let step = part - tangent * (drift / along);
            let size = step.norm();
            if at.is_on_curve() {
                // A last step reduces the residual further. One that is longer than rounding error, where motions come
                // close, is taken if it does: the residual allowed here moves the position by a fiftieth of their bend.
                let moved = self.moved(q, &step);
                if size <= self.rounding_error(q) * real(EQUAL_ULPS) {
                    return Ok(Iteration::Converged((moved, elimination)));
                }
                if elimination.regularity() > M::Scalar::default_epsilon().sqrt() {
                    let after = self.linear(&moved)?;
                    if after.excess() <= at.excess() * real(0.5) {
                        return Ok(Iteration::Converged((moved, Elimination::<M>::new(after.jacobian))));
                    }
                }
                return Ok(Iteration::Converged((*q, elimination)));
            }
            let (residual, regularity) = (to_f64(at.residual.largest()), to_f64(elimination.regularity()));
            rejection = Rejection { residual, regularity };
            let intersects = along.abs() > real(LEAST_SINE);
            Ok(if intersects { Iteration::Step(self.moved(q, &step), size) } else { Iteration::Failed })
        })?;
        Ok(found.ok_or(rejection))
    }
}

/// The sine of the least angle between plane and curve at which the correction continues. A quarter or four times as
/// much changes no path of the tests.
const LEAST_SINE: f64 = 1.0 / 64.0;

impl<M: Mechanism> Linear<M> {
    /// True if every residual is zero to rounding error.
    pub(super) fn is_on_curve(&self) -> bool {
        let enough = real::<M::Scalar>(ZERO_ULPS);
        self.residual.iter().zip(&self.noise).all(|(residual, noise)| residual.abs() <= *noise * enough)
    }

    /// The largest residual, relative to its rounding error.
    fn excess(&self) -> M::Scalar {
        let rows = self.residual.iter().zip(&self.noise).filter(|(_, noise)| !noise.is_zero());
        largest(rows.map(|(residual, noise)| *residual / *noise))
    }
}

fn coordinates<M: Mechanism>(q: &M::Coordinates) -> Vector<M> {
    let (unknowns, inputs) = M::parts(q);
    Vector::<M> { unknowns, inputs }
}
