//! The same motion in all coordinates, by Lagrange's multipliers: index 1, alone, with Baumgarte's stabilisation, and
//! projected.
//!
//! With Psi(q) = 0 the closures and K = [J A] their Jacobian,
//!
//! ```text
//! [ M  K' ] [   q''  ]   [                F                 ]
//! [ K  0  ] [ lambda ] = [ -gamma - 2 alpha Psi' - beta^2 Psi ]
//! ```
//!
//! (J. Baumgarte, "Stabilization of constraints and integrals of motion in dynamical systems", Computer Methods in
//! Applied Mechanics and Engineering 1 (1972) 1-16), by Kutta's method with steps of one length.

use std::error::Error;

use linkage::nalgebra::{Const, DimMin, SMatrix, SVector};
use linkage::{Mechanism, Scene};

use super::problem::Problem;

/// What holds the closures.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Hold {
    /// The accelerations alone.
    Accelerations,
    /// Baumgarte's alpha = beta, in 1/s.
    Baumgarte(f64),
    /// After each step positions and rates are put back the shortest way, angles and lengths counted alike.
    Projection,
}

/// All coordinates, the unknowns first, and their rates.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Moving<const C: usize> {
    pub q: SVector<f64, C>,
    pub rate: SVector<f64, C>,
}

impl<const C: usize> Moving<C> {
    fn moved(&self, by: &Self, h: f64) -> Self {
        Self { q: self.q + by.q * h, rate: self.rate + by.rate * h }
    }
}

/// A motion in `C` = `U` + `V` coordinates, with `D` = `C` + `U` unknowns in each system of equations.
pub struct Multipliers<'a, S, const U: usize, const V: usize, const N: usize, const C: usize, const D: usize> {
    problem: &'a Problem<S, U, V, N>,
    hold: Hold,
    pub state: Moving<C>,
}

const DEPENDENT: &str = "the closures are not independent";

/// A projection that takes more steps than this will not end.
const MOST_ITERATIONS: usize = 8;

impl<'a, S, const U: usize, const V: usize, const N: usize, const C: usize, const D: usize>
    Multipliers<'a, S, U, V, N, C, D>
where
    S: Scene<f64, U, V, N, 0>,
    Const<D>: DimMin<Const<D>, Output = Const<D>>,
{
    pub fn new(problem: &'a Problem<S, U, V, N>, hold: Hold) -> Result<Self, linkage::Error> {
        const { assert!(C == U + V && D == C + U) };
        let mechanism = problem.scene.mechanism();
        let (q, rates) = S::parts(&problem.start);
        let (pose, rates) = (mechanism.pose_at(&q), rates.into());
        let of_unknowns = mechanism.solve_jacobian(&pose, &(mechanism.jacobian_inputs(&pose) * -rates))?;
        let (unknowns, inputs) = (S::Mechanism::unknowns(&q), S::Mechanism::inputs(&q));
        let state = Moving { q: joined(&unknowns, &inputs), rate: joined(&of_unknowns, &rates) };
        Ok(Self { problem, hold, state })
    }

    /// By name.
    fn named(&self, all: &SVector<f64, C>) -> <S::Mechanism as Mechanism<f64, U, V>>::Coordinates {
        let (template, _) = S::parts(&self.problem.start);
        let inputs = all.fixed_rows::<V>(U).into_owned();
        S::Mechanism::with_unknowns(&S::Mechanism::with_inputs(&template, inputs), all.fixed_rows::<U>(0).into_owned())
    }

    /// y = (q, v').
    pub fn y(&self) -> SVector<f64, N> {
        S::state(&self.named(&self.state.q), &self.state.rate.fixed_rows::<V>(U).into_owned().into())
    }

    fn slope(&self, t: f64, at: &Moving<C>) -> Result<Moving<C>, Box<dyn Error>> {
        let (q, rate) = (self.named(&at.q), self.named(&at.rate));
        let mechanism = self.problem.scene.mechanism();
        let pose = mechanism.pose_at(&q);
        let k = jacobian::<S, U, V, N, C>(mechanism, &pose);
        let all = self.problem.scene.unreduced(t, &q, &rate)?;
        let mut matrix = SMatrix::<f64, D, D>::zeros();
        matrix.fixed_view_mut::<U, U>(0, 0).copy_from(&all.unknowns);
        matrix.fixed_view_mut::<U, V>(0, U).copy_from(&all.mixed);
        matrix.fixed_view_mut::<V, U>(U, 0).copy_from(&all.mixed.transpose());
        matrix.fixed_view_mut::<V, V>(U, U).copy_from(&all.inputs);
        matrix.fixed_view_mut::<C, U>(0, C).copy_from(&k.transpose());
        matrix.fixed_view_mut::<U, C>(C, 0).copy_from(&k);
        let mut closures = -mechanism.gamma(&pose, &rate);
        if let Hold::Baumgarte(alpha) = self.hold {
            closures -= k * at.rate * (2.0 * alpha) + mechanism.residual(&pose) * (alpha * alpha);
        }
        let forces = joined::<U, V, C>(&all.unknown_forces, &all.input_forces);
        let solution = matrix.lu().solve(&joined::<C, U, D>(&forces, &closures)).ok_or(DEPENDENT)?;
        Ok(Moving { q: at.rate, rate: solution.fixed_rows::<C>(0).into_owned() })
    }

    /// dq = -K' (K K')^-1 Psi until rounding; then the same of the rates, which K q' = 0 gives at once.
    fn project(&self, mut at: Moving<C>) -> Result<Moving<C>, Box<dyn Error>> {
        let mechanism = self.problem.scene.mechanism();
        let mut last = f64::INFINITY;
        for _ in 0..MOST_ITERATIONS {
            let pose = mechanism.pose_at(&self.named(&at.q));
            let k = jacobian::<S, U, V, N, C>(mechanism, &pose);
            let factors = (k * k.transpose()).cholesky().ok_or(DEPENDENT)?;
            let step = k.tr_mul(&factors.solve(&mechanism.residual(&pose)));
            let size = step.amax();
            // The steps of Newton's method fall until they are rounding.
            if size == 0.0 || size >= last || last < f64::EPSILON.sqrt() {
                return Ok(Moving { q: at.q, rate: at.rate - k.tr_mul(&factors.solve(&(k * at.rate))) });
            }
            at.q -= step;
            last = size;
        }
        Err("no position is near".into())
    }

    /// A step of Kutta's method.
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

/// K = [J A].
fn jacobian<S: Scene<f64, U, V, N, 0>, const U: usize, const V: usize, const N: usize, const C: usize>(
    mechanism: &S::Mechanism,
    pose: &<S::Mechanism as Mechanism<f64, U, V>>::Pose,
) -> SMatrix<f64, U, C> {
    let mut k = SMatrix::<f64, U, C>::zeros();
    k.fixed_view_mut::<U, U>(0, 0).copy_from(&mechanism.jacobian_unknowns(pose));
    k.fixed_view_mut::<U, V>(0, U).copy_from(&mechanism.jacobian_inputs(pose));
    k
}

fn joined<const A: usize, const B: usize, const C: usize>(
    first: &SVector<f64, A>,
    second: &SVector<f64, B>,
) -> SVector<f64, C> {
    SVector::from_fn(|row, _| if row < A { first[row] } else { second[row - A] })
}
