//! The curve Psi(q) = 0 in pure numbers: angles in radians, other coordinates and the closures beside their size.

use crate::jacobian::rounding::{CLOSED, SAME};
use crate::jacobian::{
    Closing, EliminationOf as Elimination, JacobianOf as Jacobian, ScalesOf as Scales, VectorOf as Vector, contract,
};
use crate::scalar::arithmetic::*;
use crate::scalar::to_f64;
use crate::{D, Mechanism, PathError, PerInput, PerUnknown, PositionError, real};

/// Newton steps of one correction: each at least halves the distance, from a fair prediction it squares it.
const MOST_CORRECTIONS: usize = 12;

/// A mechanism and the sizes of its coordinates and closures.
pub(super) struct Curve<'a, M: Mechanism> {
    pub(super) mechanism: &'a M,
    scales: Scales<M>,
}

impl<M: Mechanism> Clone for Curve<'_, M> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<M: Mechanism> Copy for Curve<'_, M> {}

/// Psi and [J A] at a position.
pub(super) struct Linear<M: Mechanism> {
    pub(super) residual: PerUnknown<M>,
    /// What rounding alone makes of each residual.
    pub(super) noise: PerUnknown<M>,
    pub(super) jacobian: Jacobian<M>,
}

/// Why a step was not taken.
#[derive(Debug, Clone, Copy)]
pub(super) struct Refusal {
    pub(super) residual: f64,
    pub(super) regularity: f64,
}

/// What came of a trial; an error ends all of them.
pub(super) type Tried<X> = Result<Result<X, Refusal>, PathError>;

impl<'a, M: Mechanism<V = D<1>>> Curve<'a, M> {
    pub(super) fn new(mechanism: &'a M, q: &M::Coordinates) -> Self {
        Self { mechanism, scales: Scales::<M>::of(mechanism, &mechanism.pose_at(q)) }
    }

    /// q moved along a vector.
    pub(super) fn moved(&self, q: &M::Coordinates, by: &Vector<M>) -> M::Coordinates {
        let Vector::<M> { unknowns, inputs } = coordinates::<M>(q) + by.scaled(&self.scales.coordinates);
        M::coordinates(unknowns, inputs)
    }

    pub(super) fn difference(&self, to: &M::Coordinates, from: &M::Coordinates) -> Vector<M> {
        (coordinates::<M>(to) - coordinates::<M>(from)).beside(&self.scales.coordinates)
    }

    /// A direction, as rates of the coordinates.
    pub(super) fn rates(&self, direction: &Vector<M>) -> M::Rates {
        let Vector::<M> { unknowns, inputs } = direction.scaled(&self.scales.coordinates);
        M::rates(unknowns, inputs)
    }

    pub(super) fn direction(&self, rates: &M::Rates) -> Vector<M> {
        let (unknowns, inputs) = M::rate_parts(rates);
        Vector::<M> { unknowns, inputs }.beside(&self.scales.coordinates)
    }

    pub(super) fn with_input(q: &M::Coordinates, input: M::Scalar) -> M::Coordinates {
        M::with_inputs(q, PerInput::<M>::from([input]))
    }

    pub(super) fn input(q: &M::Coordinates) -> M::Scalar {
        M::inputs(q)[0]
    }

    /// A distance of the input beside its size.
    pub(super) fn input_distance(&self, distance: M::Scalar) -> M::Scalar {
        distance / self.scales.coordinates.inputs[0]
    }

    /// What rounding makes of the coordinates.
    pub(super) fn rounding(&self, q: &M::Coordinates) -> M::Scalar {
        (M::Scalar::one() + coordinates::<M>(q).beside(&self.scales.coordinates).largest())
            * M::Scalar::default_epsilon()
    }

    /// # Errors
    /// [`PositionError::NotFinite`] if a number is not finite.
    pub(super) fn linear(&self, q: &M::Coordinates) -> Result<Linear<M>, PositionError> {
        let (mechanism, closures) = (self.mechanism, &self.scales.closures);
        let pose = mechanism.pose_at(q);
        let here = coordinates::<M>(q).beside(&self.scales.coordinates);
        let jacobian = self.scales.jacobian(mechanism, &pose);
        let residual = mechanism.residual(&pose).component_div(closures);
        let terms = mechanism.closure_sizes(&pose).component_div(closures);
        let noise = (terms + jacobian.abs().along(&here.abs())) * M::Scalar::default_epsilon();
        if here.is_finite() && residual.is_finite() && noise.is_finite() && jacobian.is_finite() {
            Ok(Linear { residual, noise, jacobian })
        } else {
            Err(PositionError::NotFinite { mechanism: M::NAME, quantity: "the path" })
        }
    }

    /// The second derivative of Psi along a direction, (Psi_q x)_q x.
    pub(super) fn curvature(&self, q: &M::Coordinates, x: &Vector<M>) -> PerUnknown<M> {
        let pose = self.mechanism.pose_at(q);
        self.mechanism.gamma(&pose, &self.rates(x)).component_div(&self.scales.closures)
    }

    /// The point of the curve near `guess` in the plane through it across `normal`.
    ///
    /// # Errors
    /// Refused where Newton's method does not contract, or the curve runs along the plane.
    pub(super) fn correct(&self, guess: M::Coordinates, normal: &Vector<M>) -> Tried<(M::Coordinates, Elimination<M>)> {
        let mut refusal = Refusal { residual: f64::NAN, regularity: f64::NAN };
        let found = contract(guess, MOST_CORRECTIONS, |q| -> Result<_, PathError> {
            let at = self.linear(q)?;
            let elimination = Elimination::<M>::new(at.jacobian);
            let (tangent, part) = (elimination.tangent(), elimination.solve(&-at.residual));
            // [J A; n'] x = -{Psi; n' (q - guess)}, with what has gathered along n by rounding taken off.
            let along = normal.dot(&tangent);
            let drift = normal.dot(&(self.difference(q, &guess) + part));
            let step = part - tangent * (drift / along);
            let size = step.norm();
            if at.is_closed() {
                // One more step removes what the last one left, if rounding has not made it long.
                let is_short = size <= self.rounding(q) * real(SAME);
                return Ok(Closing::Closed((if is_short { self.moved(q, &step) } else { *q }, elimination)));
            }
            let (residual, regularity) = (to_f64(at.residual.largest()), to_f64(elimination.regularity()));
            refusal = Refusal { residual, regularity };
            let cuts = along.abs() > real(LEAST_CROSSING);
            Ok(if cuts { Closing::Step(self.moved(q, &step), size) } else { Closing::Stuck })
        })?;
        Ok(found.ok_or(refusal))
    }
}

/// The sine of the least angle at which a plane may cut the curve; a quarter or four times as much changes no path of the
/// tests.
const LEAST_CROSSING: f64 = 1.0 / 64.0;

impl<M: Mechanism> Linear<M> {
    pub(super) fn is_closed(&self) -> bool {
        let enough = real::<M::Scalar>(CLOSED);
        self.residual.iter().zip(&self.noise).all(|(residual, noise)| residual.abs() <= *noise * enough)
    }
}

fn coordinates<M: Mechanism>(q: &M::Coordinates) -> Vector<M> {
    let (unknowns, inputs) = M::parts(q);
    Vector::<M> { unknowns, inputs }
}
