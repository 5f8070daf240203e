//! Independent coordinates other than the inputs.
//!
//! Elimination of [J A] with complete pivoting selects U columns as dependent coordinates, those with the largest
//! pivots; the other V are independent. Prescribed inputs are held independent.

use crate::Scene;
use linkage_runtime::__shared::smallest;
use linkage_runtime::jacobian::{Elimination, Order, Scales, Vector};
use linkage_runtime::{Build, Column, Dim, Matrix, Mechanism, Real};

/// A step is rejected if a pivot falls below this fraction of the smallest pivot at its start. At half or twice this
/// value all simulation tests pass.
pub(super) const LEAST_PIVOT_RATIO: f64 = 0.2;

/// A choice of independent coordinates, and the elimination order of the others. Coordinates are column indices of
/// [J A]; those from U on are inputs.
#[derive(Debug, Clone, Copy)]
pub(super) struct Independent<T: Real, U: Dim, V: Dim> {
    pub(super) order: Order<U>,
    pub(super) free: Column<usize, V>,
    /// The pivots at the start of the step.
    pub(super) pivots: Column<T, U>,
}

/// [J A] at a position, factored in the pivot order of a choice.
pub(super) struct Factors<T: Real, U: Dim, V: Dim> {
    elimination: Elimination<T, U, V>,
    free: Column<usize, V>,
    scales: Scales<T, U, V>,
}

/// A choice of independent coordinates of a scene.
pub(super) type Choice<S> = Independent<<S as Scene>::Scalar, <S as Scene>::U, <S as Scene>::V>;
/// The factored [J A] of a scene.
pub(super) type FactorsOf<S> = Factors<<S as Scene>::Scalar, <S as Scene>::U, <S as Scene>::V>;

impl<T: Real, U: Dim, V: Dim> Independent<T, U, V> {
    /// Returns the best-conditioned choice in which the `prescribed` inputs stay independent.
    pub(super) fn choose<M: Mechanism<Scalar = T, U = U, V = V>>(
        mechanism: &M,
        pose: &M::Pose,
        scales: &Scales<T, U, V>,
        prescribed: &Column<bool, V>,
    ) -> Self {
        let elimination = Elimination::holding(prescribed, scales.jacobian(mechanism, pose));
        let mut left = elimination.free();
        let free = prescribed.dim().column(|_| left.next().unwrap_or(scales.residuals.dim().count()));
        Self { order: *elimination.order(), free, pivots: elimination.pivots() }
    }

    /// Factors [J A] at another position in the same pivot order.
    pub(super) fn factors<M: Mechanism<Scalar = T, U = U, V = V>>(
        &self,
        mechanism: &M,
        pose: &M::Pose,
        scales: &Scales<T, U, V>,
    ) -> Factors<T, U, V> {
        let elimination = Elimination::in_order(&self.order, scales.jacobian(mechanism, pose));
        Factors { elimination, free: self.free, scales: *scales }
    }

    /// [`factors`](Self::factors) without the pivots up to a tolerance.
    pub(super) fn factors_above<M: Mechanism<Scalar = T, U = U, V = V>>(
        &self,
        tolerance: T,
        mechanism: &M,
        pose: &M::Pose,
        scales: &Scales<T, U, V>,
    ) -> Factors<T, U, V> {
        let elimination = Elimination::in_order_above(tolerance, &self.order, scales.jacobian(mechanism, pose));
        Factors { elimination, free: self.free, scales: *scales }
    }

    /// The place of an input among the independent coordinates.
    pub(super) fn place_of(&self, input: usize) -> Option<usize> {
        let count = self.pivots.dim().count();
        self.free.iter().position(|&free| free == count + input)
    }

    /// Extracts the independent components of coordinates or rates.
    pub(super) fn of(&self, vector: &Vector<T, U, V>) -> Column<T, V> {
        self.free.map(|column| vector.get(column))
    }

    /// The smallest pivot of the nondimensional [J A]: 0 where the constraints do not determine the dependent
    /// coordinates.
    pub(super) fn regularity(&self) -> T {
        smallest(self.pivots)
    }
}

impl<T: Real, U: Dim, V: Dim> Factors<T, U, V> {
    pub(super) fn pivots(&self) -> Column<T, U> {
        self.elimination.pivots()
    }

    /// Returns the change of the dependent coordinates that changes the residual by `right`.
    pub(super) fn solve(&self, right: &Column<T, U>) -> Vector<T, U, V> {
        self.elimination.solve(&right.component_div(&self.scales.residuals)).scaled(&self.scales.coordinates)
    }

    /// The null-space basis N, q' = N z': its rows of the unknowns and of the inputs.
    pub(super) fn basis(&self) -> (Matrix<T, U, V>, Matrix<T, V, V>) {
        let scales = &self.scales.coordinates;
        let columns = self.free.map(|free| {
            let column = self.elimination.null_vector(free).scaled(scales);
            (column.unknowns / scales.get(free), column.inputs / scales.get(free))
        });
        let (u, v) = scales.dims();
        (u.columns(columns.map(|column| column.0)), v.columns(columns.map(|column| column.1)))
    }

    /// q' from z'.
    pub(super) fn rates(&self, free: &Column<T, V>) -> Vector<T, U, V> {
        let (unknowns, inputs) = self.basis();
        Vector { unknowns: unknowns * *free, inputs: inputs * *free }
    }
}
