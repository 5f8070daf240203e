//! The motion in all coordinates with Lagrange multipliers, index 1: plain, with Baumgarte stabilisation, and with
//! projection.
//!
//! With the constraints Psi(q) = 0 and their Jacobian K = [J A],
//!
//! ```text
//! [ M  K' ] [   q''  ]   [                F                 ]
//! [ K  0  ] [ lambda ] = [ -gamma - 2 alpha Psi' - beta^2 Psi ]
//! ```
//!
//! (J. Baumgarte, "Stabilization of constraints and integrals of motion in dynamical systems", Computer Methods in
//! Applied Mechanics and Engineering 1 (1972) 1-16), by Kutta's method with fixed steps.

use std::error::Error;

use linkage::nalgebra::{Const, DimMin, SMatrix, SVector};
use linkage::{Build, Column, D, Dim, Matrix, Mechanism, PositionError, StateParts};

use super::problem::{Emitted, Problem, State};

/// The treatment of the constraints.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Hold {
    /// Acceleration constraints only.
    Accelerations,
    /// Baumgarte stabilisation with alpha = beta, in 1/s.
    Baumgarte(f64),
    /// Orthogonal projection of positions and rates after each step, with angles and lengths weighted equally.
    Projection,
}

/// A number for each coordinate, unknowns and inputs separately.
type All<U, V> = (Column<f64, U>, Column<f64, V>);

/// All coordinates and their rates.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Moving<U: Dim, V: Dim> {
    pub q: All<U, V>,
    pub rates: All<U, V>,
}

impl<U: Dim, V: Dim> Moving<U, V> {
    fn moved(&self, by: &Self, h: f64) -> Self {
        let plus = |(u, v): All<U, V>, (of_u, of_v): All<U, V>| (u + of_u * h, v + of_v * h);
        Self { q: plus(self.q, by.q), rates: plus(self.rates, by.rates) }
    }
}

/// A motion in all coordinates; each linear system has `N` unknowns, accelerations and multipliers.
pub struct Multipliers<'a, S: Emitted, const U: usize, const N: usize> {
    problem: &'a Problem<S>,
    hold: Hold,
    pub state: Moving<S::U, S::V>,
}

const DEPENDENT: &str = "the constraints are not independent";

/// The iteration limit of a projection.
const MOST_ITERATIONS: usize = 8;

impl<'a, S, const U: usize, const N: usize> Multipliers<'a, S, U, N>
where
    S: Emitted<U = D<U>>,
    Const<N>: DimMin<Const<N>, Output = Const<N>>,
{
    pub fn new(problem: &'a Problem<S>, hold: Hold) -> Result<Self, PositionError> {
        const { assert!(N == 2 * U + S::V::CAPACITY) };
        let mechanism = problem.scene.mechanism();
        let StateParts { q, input_rates } = S::parts(&problem.start);
        let (pose, of_inputs) = (mechanism.pose_at(&q), input_rates.into());
        let of_unknowns = mechanism.solve_jacobian(&pose, &-(mechanism.jacobian_inputs(&pose) * of_inputs))?;
        Ok(Self { problem, hold, state: Moving { q: S::Mechanism::parts(&q), rates: (of_unknowns, of_inputs) } })
    }

    /// y = (q, v').
    pub fn y(&self) -> State<S> {
        let Moving { q: (u, v), rates: (_, of_inputs) } = self.state;
        S::state(&S::Mechanism::coordinates(u, v), &of_inputs.into())
    }

    fn slope(
        &self,
        t: f64,
        &Moving { q: (u, v), rates }: &Moving<S::U, S::V>,
    ) -> Result<Moving<S::U, S::V>, Box<dyn Error>> {
        let (q, by_name) = (S::Mechanism::coordinates(u, v), S::Mechanism::rates(rates.0, rates.1));
        let mechanism = self.problem.scene.mechanism();
        let pose = mechanism.pose_at(&q);
        let (j, a) = (mechanism.jacobian_unknowns(&pose), mechanism.jacobian_inputs(&pose));
        let all = self.problem.scene.unreduced(t, &q, &by_name)?;
        let (inputs, multipliers) = (U, U + rates.1.dim().count());
        let mut matrix = SMatrix::<f64, N, N>::zeros();
        place(&mut matrix, (0, 0), &all.unknowns);
        place(&mut matrix, (0, inputs), &all.mixed);
        place(&mut matrix, (inputs, inputs), &all.inputs);
        place(&mut matrix, (multipliers, 0), &j);
        place(&mut matrix, (multipliers, inputs), &a);
        let mut closures = -mechanism.gamma(&pose, &by_name);
        if let Hold::Baumgarte(alpha) = self.hold {
            closures -= (j * rates.0 + a * rates.1) * (2.0 * alpha) + mechanism.residual(&pose) * (alpha * alpha);
        }
        let right = all.unknown_forces.iter().chain(&all.input_forces).chain(&closures).copied();
        let solution = matrix.lu().solve(&SVector::<f64, N>::from_iterator(right)).ok_or(DEPENDENT)?;
        let accelerations =
            (rates.0.dim().column(|row| solution[row]), rates.1.dim().column(|row| solution[inputs + row]));
        Ok(Moving { q: rates, rates: accelerations })
    }

    /// dq = -K' (K K')^-1 Psi until rounding error; then one such step for the rates, K q' = 0.
    fn project(
        &self,
        Moving { q: (mut u, mut v), rates }: Moving<S::U, S::V>,
    ) -> Result<Moving<S::U, S::V>, Box<dyn Error>> {
        let mechanism = self.problem.scene.mechanism();
        let mut last = f64::INFINITY;
        for _ in 0..MOST_ITERATIONS {
            let pose = mechanism.pose_at(&S::Mechanism::coordinates(u, v));
            let (j, a) = (mechanism.jacobian_unknowns(&pose), mechanism.jacobian_inputs(&pose));
            let square = SMatrix::<f64, U, U>::from(j * j.transpose() + a * a.transpose());
            let factors = square.cholesky().ok_or(DEPENDENT)?;
            let shortest = |gap: Column<f64, S::U>| {
                let multipliers = factors.solve(&SVector::from(gap)).into();
                (j.tr_mul(&multipliers), a.tr_mul(&multipliers))
            };
            let step = shortest(mechanism.residual(&pose));
            let size = step.0.largest().max(step.1.largest());
            // Newton steps shrink until they are rounding error.
            if size == 0.0 || size >= last || last < f64::EPSILON.sqrt() {
                let excess = shortest(j * rates.0 + a * rates.1);
                return Ok(Moving { q: (u, v), rates: (rates.0 - excess.0, rates.1 - excess.1) });
            }
            (u, v) = (u - step.0, v - step.1);
            last = size;
        }
        Err("the projection found no position".into())
    }

    /// Takes a step of Kutta's method.
    pub fn step(&mut self, t: f64, h: f64) -> Result<(), Box<dyn Error>> {
        let at = self.state;
        let first = self.slope(t, &at)?;
        let second = self.slope(t + 0.5 * h, &at.moved(&first, 0.5 * h))?;
        let third = self.slope(t + 0.5 * h, &at.moved(&second, 0.5 * h))?;
        let fourth = self.slope(t + h, &at.moved(&third, h))?;
        let slopes = [(&first, 1.0), (&second, 2.0), (&third, 2.0), (&fourth, 1.0)];
        let next = slopes.into_iter().fold(at, |at, (slope, weight)| at.moved(slope, weight * h / 6.0));
        self.state = if self.hold == Hold::Projection { self.project(next)? } else { next };
        Ok(())
    }
}

/// Sets a block of a symmetric matrix and its transpose.
fn place<const N: usize, R: Dim, C: Dim>(
    matrix: &mut SMatrix<f64, N, N>,
    (top, left): (usize, usize),
    block: &Matrix<f64, R, C>,
) {
    for (column, entries) in (left..).zip(block.columns()) {
        for (row, &entry) in (top..).zip(entries) {
            (matrix[(row, column)], matrix[(column, row)]) = (entry, entry);
        }
    }
}
