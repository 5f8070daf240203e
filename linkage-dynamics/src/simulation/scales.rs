//! Sizes of coordinates and closures, so that no unit has a say in a verdict.

use nalgebra::{SMatrix, SVector};

use crate::Along;
use crate::contact::rounding_of;
use linkage_runtime::__shared::{larger, largest};
use linkage_runtime::{Error, Mechanism, Real};

/// What size of a coordinate and of a closure matters: of an angle 1, of a length that of the loops it is in.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Scales<T, const U: usize, const V: usize> {
    pub(super) closures: SVector<T, U>,
    pub(super) unknowns: SVector<T, U>,
    pub(super) inputs: SVector<T, V>,
}

impl<T: Real, const U: usize, const V: usize> Scales<T, U, V> {
    pub(crate) fn of<M: Mechanism<T, U, V>>(mechanism: &M, q: &M::Coordinates) -> Self {
        let pose = mechanism.pose_at(q);
        let (by_unknowns, by_inputs) = mechanism.jacobian_sizes(&pose);
        // A closure is as large as an angle can make it.
        let terms = mechanism.closure_sizes(&pose);
        let closures = SVector::from_fn(|row, _| {
            let of_unknowns = of_angles(&by_unknowns, row, &M::UNKNOWN_ANGLES);
            let of_angles = larger(of_unknowns, of_angles(&by_inputs, row, &M::INPUT_ANGLES));
            usable(if of_angles.is_zero() { terms[row] } else { of_angles })
        });
        Self {
            closures,
            unknowns: coordinates(&by_unknowns, &closures, &M::UNKNOWN_ANGLES),
            inputs: coordinates(&by_inputs, &closures, &M::INPUT_ANGLES),
        }
    }

    /// That of a coordinate by its column in [J A].
    pub(super) fn coordinate(&self, column: usize) -> T {
        if column < U { self.unknowns[column] } else { self.inputs[column - U] }
    }

    /// What rounding may leave of a scalar: a coordinate is known to roundings of its size, or of its value.
    pub(crate) fn resolution<M: Mechanism<T, U, V>>(&self, q: &M::Coordinates, along: &Along<T, U, V>) -> T {
        let unknowns = M::unknowns(q).abs().sup(&self.unknowns);
        let inputs = M::inputs(q).abs().sup(&self.inputs);
        rounding_of(along.unknowns.abs().dot(&unknowns) + along.inputs.abs().dot(&inputs))
    }

    /// The same where the inputs are given and the unknowns follow from them: by s' of each input alone.
    ///
    /// # Errors
    /// Those of [`Mechanism::solve_jacobian`].
    pub(crate) fn resolution_by_inputs<M: Mechanism<T, U, V>>(
        &self,
        mechanism: &M,
        q: &M::Coordinates,
        along: &Along<T, U, V>,
    ) -> Result<T, Error> {
        let pose = mechanism.pose_at(q);
        let (by_inputs, inputs) = (mechanism.jacobian_inputs(&pose), M::inputs(q).abs().sup(&self.inputs));
        let mut size = T::zero();
        for input in 0..V {
            let unknowns = mechanism.solve_jacobian(&pose, &by_inputs.column(input).into_owned())?;
            size += (along.inputs[input] - along.unknowns.dot(&unknowns)).abs() * inputs[input];
        }
        Ok(self.resolution::<M>(q, along) + rounding_of(size))
    }

    /// The size of rates beside the sizes of their coordinates: an angular frequency.
    pub(super) fn speed(&self, unknowns: &SVector<T, U>, inputs: &SVector<T, V>) -> T {
        let (unknowns, inputs) = (unknowns.component_div(&self.unknowns), inputs.component_div(&self.inputs));
        largest(unknowns.iter().chain(inputs.iter()).copied())
    }
}

fn of_angles<T: Real, const U: usize, const C: usize>(sizes: &SMatrix<T, U, C>, row: usize, angles: &[bool; C]) -> T {
    largest((0..C).filter(|&column| angles[column]).map(|column| sizes[(row, column)]))
}

fn coordinates<T: Real, const U: usize, const C: usize>(
    sizes: &SMatrix<T, U, C>,
    closures: &SVector<T, U>,
    angles: &[bool; C],
) -> SVector<T, C> {
    SVector::from_fn(|column, _| {
        if angles[column] {
            return T::one();
        }
        let rows = (0..U).filter(|&row| !sizes[(row, column)].is_zero());
        usable(largest(rows.map(|row| closures[row] / sizes[(row, column)])))
    })
}

/// What is not a size is 1.
fn usable<T: Real>(size: T) -> T {
    if size > T::zero() && size.is_finite() { size } else { T::one() }
}
