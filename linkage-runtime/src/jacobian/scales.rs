//! Scales of coordinates and residuals.

use super::Vector;
use crate::scalar::{larger, largest};
use crate::{Build, Column, Dim, Matrix, Mechanism, Real};

/// Divisors that make coordinates, residuals and the entries of [J A] nondimensional, so that no test depends on a
/// unit. The divisor of an angle is 1, that of a length the largest derivative of its loop equation by an angle, which
/// is about the longest link; for a length in no loop equation see [`Mechanism::length_scale`].
///
/// They are computed from the largest values that the entries of [J A] can have at the lengths of the mechanism, not
/// from the entries at one position, and hold for the whole of a motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scales<T: Real, U: Dim, V: Dim> {
    /// The scales of the residuals.
    pub residuals: Column<T, U>,
    /// The scales of the coordinates.
    pub coordinates: Vector<T, U, V>,
}

/// [J A], the derivatives of Psi by the unknowns and by the inputs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Jacobian<T: Real, U: Dim, V: Dim> {
    /// J.
    pub unknowns: Matrix<T, U, U>,
    /// A.
    pub inputs: Matrix<T, U, V>,
}

impl<T: Real, U: Dim, V: Dim> Scales<T, U, V> {
    /// Computes the scales of a mechanism from its lengths at a position.
    pub fn of<M: Mechanism<Scalar = T, U = U, V = V>>(mechanism: &M, pose: &M::Pose) -> Self {
        let by_unknowns = mechanism.jacobian_unknowns_scales(pose);
        let by_inputs = mechanism.jacobian_inputs_scales(pose);
        let terms = mechanism.residual_scales(pose);
        // The scale of a residual is its largest derivative by an angle, or without angles the sum of its terms.
        let residuals = terms.dim().column(|row| {
            let of_unknowns = of_angles(&by_unknowns.row(row), mechanism.unknown_angles());
            let of_angles = larger(of_unknowns, of_angles(&by_inputs.row(row), mechanism.input_angles()));
            scale_or_one(if of_angles.is_zero() { terms.part(row) } else { of_angles })
        });
        let free = scale_or_one(mechanism.length_scale(pose));
        let coordinates = Vector {
            unknowns: of_coordinates(&by_unknowns, &residuals, mechanism.unknown_angles(), T::one()),
            inputs: of_coordinates(&by_inputs, &residuals, mechanism.input_angles(), free),
        };
        Self { residuals, coordinates }
    }

    /// [J A] at a position, nondimensional.
    pub fn jacobian<M: Mechanism<Scalar = T, U = U, V = V>>(&self, mechanism: &M, pose: &M::Pose) -> Jacobian<T, U, V> {
        let (j, a) = (mechanism.jacobian_unknowns(pose), mechanism.jacobian_inputs(pose));
        Jacobian {
            unknowns: relative_to(&j, &self.residuals, &self.coordinates.unknowns),
            inputs: relative_to(&a, &self.residuals, &self.coordinates.inputs),
        }
    }
}

impl<T: Real, U: Dim, V: Dim> Jacobian<T, U, V> {
    /// The rates of the residuals along a vector.
    pub fn along(&self, vector: &Vector<T, U, V>) -> Column<T, U> {
        self.unknowns * vector.unknowns + self.inputs * vector.inputs
    }

    /// The numbers of unknowns and inputs.
    #[inline]
    pub fn dims(&self) -> (U, V) {
        self.inputs.dims()
    }

    /// The magnitudes of the entries.
    pub fn abs(&self) -> Self {
        Self { unknowns: self.unknowns.abs(), inputs: self.inputs.abs() }
    }

    /// An entry; columns from `U` on are inputs.
    pub fn entry(&self, row: usize, column: usize) -> T {
        match column.checked_sub(self.dims().0.count()) {
            None => self.unknowns[(row, column)],
            Some(input) => self.inputs[(row, input)],
        }
    }

    /// Fixes a coordinate: no equation depends on it.
    pub fn fix(&mut self, column: usize) {
        let (u, _) = self.dims();
        for row in 0..u.count() {
            match column.checked_sub(u.count()) {
                None => self.unknowns[(row, column)] = T::zero(),
                Some(input) => self.inputs[(row, input)] = T::zero(),
            }
        }
    }

    /// Replaces an equation by one that holds a coordinate.
    pub fn hold(&mut self, row: usize, held: usize) {
        let (u, v) = self.dims();
        for column in 0..u.count() + v.count() {
            let entry = if column == held { T::one() } else { T::zero() };
            match column.checked_sub(u.count()) {
                None => self.unknowns[(row, column)] = entry,
                Some(input) => self.inputs[(row, input)] = entry,
            }
        }
    }

    /// True if every entry is finite.
    pub fn is_finite(&self) -> bool {
        self.unknowns.is_finite() && self.inputs.is_finite()
    }
}

/// The largest entry of each column, the rows divided by `rows`.
pub fn largest_entries<T: Real, R: Dim, C: Dim>(matrix: &Matrix<T, R, C>, rows: &Column<T, R>) -> Column<T, C> {
    matrix.columns().map(|column| column.component_div(rows).largest())
}

/// A scale as a divisor: 1 if the scale is zero.
pub fn scale_or_one<T: Real>(size: T) -> T {
    if size.is_zero() { T::one() } else { size }
}

fn of_angles<T: Real, C: Dim>(sizes: &Column<T, C>, angles: &[bool]) -> T {
    largest(sizes.iter().zip(angles).filter(|&(_, &is_angle)| is_angle).map(|(&size, _)| size))
}

/// The scales of coordinates; `free` is that of lengths without an entry.
fn of_coordinates<T: Real, U: Dim, C: Dim>(
    sizes: &Matrix<T, U, C>,
    residuals: &Column<T, U>,
    angles: &[bool],
    free: T,
) -> Column<T, C> {
    let entries = largest_entries(sizes, residuals);
    entries.dim().column(|place| match entries.part(place) {
        _ if angles.get(place) == Some(&true) => T::one(),
        none if none.is_zero() => free,
        entry => entry.recip(),
    })
}

fn relative_to<T: Real, U: Dim, C: Dim>(
    matrix: &Matrix<T, U, C>,
    residuals: &Column<T, U>,
    coordinates: &Column<T, C>,
) -> Matrix<T, U, C> {
    residuals
        .dim()
        .matrix(coordinates.dim(), |row, column| matrix[(row, column)] * coordinates[column] / residuals[row])
}
