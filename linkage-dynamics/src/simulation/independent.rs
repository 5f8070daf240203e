//! Independent coordinates other than the inputs.
//!
//! Elimination with complete pivoting of the scaled [J A] takes the U coordinates that the closures determine best;
//! the V that are left over are independent (R. A. Wehage and E. J. Haug, "Generalized coordinate partitioning for
//! dimension reduction in analysis of constrained dynamic systems", J. Mech. Des. 104, 1982).

use nalgebra::{SMatrix, SVector};

use super::scales::Scales;
use linkage_runtime::__shared::smallest;
use linkage_runtime::{Mechanism, Real};

/// A choice of independent coordinates, and the order in which the others are eliminated. Coordinates are columns of
/// [J A]: from U on they are inputs.
#[derive(Debug, Clone, Copy)]
pub(super) struct Independent<T, const U: usize, const V: usize> {
    rows: [usize; U],
    dependent: [usize; U],
    pub(super) free: [usize; V],
    /// The pivots where the step starts.
    pub(super) pivots: SVector<T, U>,
}

/// [J A] at a position, its dependent part in triangles.
pub(super) struct Factors<T, const U: usize, const V: usize> {
    independent: Independent<T, U, V>,
    scales: Scales<T, U, V>,
    triangles: SMatrix<T, U, U>,
    /// The columns of the independent coordinates.
    others: SMatrix<T, U, V>,
}

impl<T: Real, const U: usize, const V: usize> Independent<T, U, V> {
    /// The best choice in which what is `held` stays independent.
    pub(super) fn choose<M: Mechanism<T, U, V>>(
        mechanism: &M,
        pose: &M::Pose,
        scales: &Scales<T, U, V>,
        held: &[bool; V],
    ) -> Self {
        let mut j = mechanism.jacobian_unknowns(pose);
        let mut a = mechanism.jacobian_inputs(pose);
        for row in 0..U {
            for column in 0..U {
                j[(row, column)] *= scales.unknowns[column] / scales.closures[row];
            }
            for column in 0..V {
                a[(row, column)] *= scales.inputs[column] / scales.closures[row];
            }
        }
        let entry = |j: &SMatrix<T, U, U>, a: &SMatrix<T, U, V>, row: usize, column: usize| {
            if column < U { j[(row, column)] } else { a[(row, column - U)] }
        };
        let (mut is_used, mut rows, mut dependent) = ([false; U], [0; U], [0; U]);
        let (mut of_unknowns, mut of_inputs) = ([false; U], *held);
        let mut pivots = SVector::zeros();
        for step in 0..U {
            let (mut place, mut largest) = ((0, 0), -T::one());
            for row in (0..U).filter(|&row| !is_used[row]) {
                let open = (0..U + V).filter(|&c| if c < U { !of_unknowns[c] } else { !of_inputs[c - U] });
                for column in open {
                    let size = entry(&j, &a, row, column).abs();
                    if size > largest {
                        (place, largest) = ((row, column), size);
                    }
                }
            }
            let (row, column) = place;
            let pivot = entry(&j, &a, row, column);
            (is_used[row], rows[step], dependent[step], pivots[step]) = (true, row, column, pivot);
            if column < U {
                of_unknowns[column] = true;
            } else {
                of_inputs[column - U] = true;
            }
            if pivot.is_zero() {
                continue;
            }
            for other in (0..U).filter(|&other| !is_used[other]) {
                let factor = entry(&j, &a, other, column) / pivot;
                if factor.is_zero() {
                    continue;
                }
                for k in 0..U {
                    let above = j[(row, k)];
                    j[(other, k)] -= factor * above;
                }
                for k in 0..V {
                    let above = a[(row, k)];
                    a[(other, k)] -= factor * above;
                }
            }
        }
        let mut left = (0..U + V).filter(|column| !dependent.contains(column));
        let free = core::array::from_fn(|_| left.next().unwrap_or(U));
        Self { rows, dependent, free, pivots }
    }

    /// [J A] at another position, eliminated in the same order.
    pub(super) fn factors<M: Mechanism<T, U, V>>(
        &self,
        mechanism: &M,
        pose: &M::Pose,
        scales: &Scales<T, U, V>,
    ) -> Factors<T, U, V> {
        self.factors_above(mechanism, pose, scales, T::zero())
    }

    /// The same without elimination by pivots up to `weak`.
    pub(super) fn factors_above<M: Mechanism<T, U, V>>(
        &self,
        mechanism: &M,
        pose: &M::Pose,
        scales: &Scales<T, U, V>,
        weak: T,
    ) -> Factors<T, U, V> {
        let (j, a) = (mechanism.jacobian_unknowns(pose), mechanism.jacobian_inputs(pose));
        let entry = |step: usize, column: usize| {
            let row = self.rows[step];
            let value = if column < U { j[(row, column)] } else { a[(row, column - U)] };
            value * scales.coordinate(column) / scales.closures[row]
        };
        let mut triangles = SMatrix::<T, U, U>::from_fn(|row, k| entry(row, self.dependent[k]));
        let others = SMatrix::from_fn(|row, k| entry(row, self.free[k]));
        for k in 0..U {
            let pivot = triangles[(k, k)];
            for row in k + 1..U {
                if triangles[(row, k)].is_zero() || pivot.abs() <= weak {
                    triangles[(row, k)] = T::zero();
                    continue;
                }
                let factor = triangles[(row, k)] / pivot;
                triangles[(row, k)] = factor;
                for column in k + 1..U {
                    let above = triangles[(k, column)];
                    triangles[(row, column)] -= factor * above;
                }
            }
        }
        Factors { independent: *self, scales: *scales, triangles, others }
    }

    /// u and v, or their rates, from those of the dependent and the independent coordinates.
    pub(super) fn apart(&self, dependent: &SVector<T, U>, free: &SVector<T, V>) -> (SVector<T, U>, SVector<T, V>) {
        let (mut unknowns, mut inputs) = (SVector::zeros(), SVector::zeros());
        let dependent = self.dependent.iter().zip(dependent.iter());
        for (&column, &value) in dependent.chain(self.free.iter().zip(free.iter())) {
            if column < U {
                unknowns[column] = value;
            } else {
                inputs[column - U] = value;
            }
        }
        (unknowns, inputs)
    }

    /// Of u and v, or of their rates, the independent ones.
    pub(super) fn of(&self, unknowns: &SVector<T, U>, inputs: &SVector<T, V>) -> SVector<T, V> {
        SVector::from_fn(|k, _| if self.free[k] < U { unknowns[self.free[k]] } else { inputs[self.free[k] - U] })
    }

    /// The smallest pivot: 0 where the closures do not determine the dependent coordinates.
    pub(super) fn regularity(&self) -> T {
        smallest(self.pivots.iter().copied())
    }
}

impl<T: Real, const U: usize, const V: usize> Factors<T, U, V> {
    pub(super) fn pivots(&self) -> SVector<T, U> {
        self.triangles.diagonal()
    }

    /// L^-1 of scaled closures: in the rows of small pivots what is left of them there.
    pub(super) fn reduce(&self, right: &SVector<T, U>) -> SVector<T, U> {
        let rows = &self.independent.rows;
        let mut x = SVector::from_fn(|k, _| right[rows[k]] / self.scales.closures[rows[k]]);
        for k in 0..U {
            let value = x[k];
            for row in k + 1..U {
                x[row] -= self.triangles[(row, k)] * value;
            }
        }
        x
    }

    /// The changes of the dependent coordinates that change the closures by `right`.
    pub(super) fn solve(&self, right: &SVector<T, U>) -> SVector<T, U> {
        let x = self.reduce(right);
        self.back(x)
    }

    fn back(&self, mut x: SVector<T, U>) -> SVector<T, U> {
        for k in (0..U).rev() {
            x[k] /= self.triangles[(k, k)];
            let value = x[k];
            for row in 0..k {
                x[row] -= self.triangles[(row, k)] * value;
            }
        }
        for (value, &column) in x.iter_mut().zip(&self.independent.dependent) {
            *value *= self.scales.coordinate(column);
        }
        x
    }

    /// The basis N of the motions that the closures allow, q' = N z': the dependent rates by the independent ones.
    pub(super) fn basis(&self) -> SMatrix<T, U, V> {
        let mut basis = SMatrix::<T, U, V>::zeros();
        for (k, &free) in self.independent.free.iter().enumerate() {
            let mut x = self.others.column(k) * -(T::one() / self.scales.coordinate(free));
            for step in 0..U {
                let value = x[step];
                for row in step + 1..U {
                    x[row] -= self.triangles[(row, step)] * value;
                }
            }
            basis.set_column(k, &self.back(x));
        }
        basis
    }
}
