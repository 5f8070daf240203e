//! The rounding error of contact coordinates, from the scales of the coordinates.

use crate::ContactCoordinate;
use crate::contact::sum_tolerance;
use linkage_runtime::__shared::arithmetic::*;
use linkage_runtime::jacobian::ScalesOf;
use linkage_runtime::{Column, Dim, Mechanism, PositionErrorOf};

type Along<M> = ContactCoordinate<<M as Mechanism>::Scalar, <M as Mechanism>::U, <M as Mechanism>::V>;

/// The rounding error of s, from errors of a few ulps of each coordinate's scale or value.
pub(crate) fn resolution<M: Mechanism>(scales: &ScalesOf<M>, q: &M::Coordinates, along: &Along<M>) -> M::Scalar {
    let (unknowns, inputs) = M::parts(q);
    let unknowns = unknowns.abs().zip_map(&scales.coordinates.unknowns, M::Scalar::max);
    let inputs = inputs.abs().zip_map(&scales.coordinates.inputs, M::Scalar::max);
    sum_tolerance(along.unknowns.abs().dot(&unknowns) + along.inputs.abs().dot(&inputs))
}

/// The rounding error of s where the unknowns are solved from given inputs: adds the sensitivity ds/dv to each input.
///
/// # Errors
/// Those of [`Mechanism::solve_jacobian`].
pub(crate) fn resolution_by_inputs<M: Mechanism>(
    mechanism: &M,
    scales: &ScalesOf<M>,
    q: &M::Coordinates,
    along: &Along<M>,
) -> Result<M::Scalar, PositionErrorOf<M>> {
    let pose = mechanism.pose_at(q);
    let by_inputs = mechanism.jacobian_inputs(&pose);
    let inputs: Column<_, M::V> = M::inputs(q).abs().zip_map(&scales.coordinates.inputs, M::Scalar::max);
    let mut size = M::Scalar::zero();
    for input in 0..inputs.dim().count() {
        let unknowns = mechanism.solve_jacobian(&pose, &by_inputs.column(input))?;
        size += (along.inputs[input] - along.unknowns.dot(&unknowns)).abs() * inputs[input];
    }
    Ok(resolution::<M>(scales, q, along) + sum_tolerance(size))
}
