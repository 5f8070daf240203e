//! The methods under comparison.

use std::borrow::Borrow;
use std::hint::black_box;
use std::rc::Rc;

use linkage_double::DoubleDouble;
use linkage_runtime::accuracy::{ClosedForm, Newton, PositionMethod, Reached, Table};
use linkage_runtime::derivation::Operations;
use linkage_runtime::{Assembly, D, Kinematic, Mechanism, PerInput, PerUnknown, PositionError, position, real};

use super::data::{Family, MethodPrice, QuantityPrice};
use super::prediction::{Counts, Machine};
use super::reference::{Exact, Reference, in_scalar};

/// A position found as coordinates.
type Near<M> = Reached<<M as Mechanism>::Coordinates, <M as Mechanism>::Pose>;

/// An input of the motion.
pub(super) struct Sample<M: Mechanism> {
    pub(super) input: f64,
    pub(super) position: M::Coordinates,
    /// A position nearby, from which Newton's method starts.
    pub(super) before: M::Coordinates,
    pub(super) reference: Reference,
}

/// The number of inputs that are timed: more do not fit into the caches next to their tables.
const TIMED: usize = 48;

/// Newton's method from the prediction by velocity ratios, until the residual is at rounding error.
struct ToTolerance;

impl<M: Mechanism<Name = &'static str>> PositionMethod<M> for ToTolerance {
    type From = Near<M>;
    type Position = Near<M>;

    fn position(mechanism: &M, from: &Near<M>, inputs: impl Into<M::Inputs>) -> Result<Near<M>, PositionError> {
        let guess = Newton::<0>::position(mechanism, from, inputs)?.coordinates;
        Ok(Reached::at(mechanism, position::newton(mechanism, &guess)?.coordinates))
    }
}

/// One method, to be timed.
pub(super) struct Work<'a> {
    pub(super) price: MethodPrice,
    /// By order of derivative: computes all results once and drops them.
    pub(super) passes: Vec<Box<dyn Fn() + 'a>>,
    /// The number of results of a pass.
    pub(super) evaluations: usize,
}

/// The methods for one mechanism at the same inputs.
pub(super) struct Methods<'a, M: Mechanism> {
    samples: &'a [Sample<M>],
    counts: Counts<'static>,
    machine: Machine,
    pub(super) works: Vec<Work<'a>>,
}

impl<'a, M: Kinematic<Scalar = f64, Name = &'static str, V = D<1>>> Methods<'a, M> {
    pub(super) fn new(samples: &'a [Sample<M>], counts: Counts<'static>) -> Self {
        Self { samples, counts, machine: Machine::measured(), works: Vec::new() }
    }

    /// The closed form in each scalar, that in `f64` first.
    pub(super) fn closed<S, T>(&mut self, m: &'a M, single: &'a S, twice: &'a T)
    where
        M: Assembly,
        S: Assembly + Kinematic<Scalar = f32, Name = &'static str, U = M::U, V = D<1>, Branch = M::Branch>,
        T: Assembly + Kinematic<Scalar = DoubleDouble, Name = &'static str, U = M::U, V = D<1>, Branch = M::Branch>,
    {
        let branches = || self.samples.iter().map(|sample| Ok(m.branch_of(&m.pose_at(&sample.position))));
        let [double, of_single, of_twice]: [Vec<_>; 3] = [0; 3].map(|_| branches().collect());
        let closed = |counts: &Counts<'_>, order| Some(counts.closed(order));
        self.add::<ClosedForm, _, _>(("f64", Family::ClosedForm), m, double, closed);
        self.add::<ClosedForm, _, _>(("f32", Family::ClosedForm), single, of_single, closed);
        self.add::<ClosedForm, _, _>(("double-double", Family::ClosedForm), twice, of_twice, closed);
    }

    /// Newton's method to a tolerance, and in the other scalars by steps, for mechanisms without a closed form.
    pub(super) fn by_number<S, T>(&mut self, m: &'a M, single: &'a S, twice: &'a T)
    where
        S: Kinematic<Scalar = f32, Name = &'static str, U = M::U, V = D<1>>,
        T: Kinematic<Scalar = DoubleDouble, Name = &'static str, U = M::U, V = D<1>>,
    {
        self.until_converged(m);
        let (of_single, of_twice) = (self.near(single), self.near(twice));
        let newton = |steps| move |counts: &Counts<'_>, order| Some(counts.newton(steps, order));
        self.add::<Newton<3>, _, _>(("f32, 3 steps", Family::Newton), single, of_single, newton(3));
        self.add::<Newton<4>, _, _>(("double-double, 4 steps", Family::Newton), twice, of_twice, newton(4));
    }

    pub(super) fn until_converged(&mut self, m: &'a M) {
        let near = self.near(m);
        // The number of its steps is not known beforehand.
        self.add::<ToTolerance, _, _>(("Newton to tolerance", Family::Newton), m, near, |_, _| None);
    }

    /// Newton's method with a fixed number of steps.
    pub(super) fn steps(&mut self, m: &'a M) {
        let newton = |steps| move |counts: &Counts<'_>, order| Some(counts.newton(steps, order));
        let [one, two, three] = [0; 3].map(|_| self.near(m));
        self.add::<Newton<1>, _, _>(("Newton, 1 step", Family::Newton), m, one, newton(1));
        self.add::<Newton<2>, _, _>(("Newton, 2 steps", Family::Newton), m, two, newton(2));
        self.add::<Newton<3>, _, _>(("Newton, 3 steps", Family::Newton), m, three, newton(3));
    }

    /// Interpolation in a table of the whole motion, of a turn where it closes after one.
    pub(super) fn tables(&mut self, m: &'a M, is_turn: bool) {
        self.table::<65>("table of 64", m, is_turn);
        self.table::<1025>("table of 1024", m, is_turn);
    }

    fn table<const N: usize>(&mut self, name: &'static str, m: &'a M, is_turn: bool) {
        let (Some(first), Some(last)) = (self.samples.first(), self.samples.last()) else { return };
        let table = if is_turn {
            Table::<M, N>::turn(m, &first.position)
        } else {
            Table::<M, N>::between(m, &first.position, last.input)
        };
        let shared = table.map(Rc::new);
        let starts = self.samples.iter().map(|_| shared.clone()).collect();
        self.add::<Table<M, N>, _, _>((name, Family::Table), m, starts, |counts, order| Some(counts.table(order)));
    }

    /// The positions nearby in a scalar.
    fn near<X>(&self, m: &X) -> Vec<Result<Near<X>, PositionError>>
    where
        X: Kinematic<Name = &'static str, U = M::U, V = D<1>>,
    {
        self.samples.iter().map(|sample| Ok(Reached::at(m, in_scalar::<M, X>(&sample.before)))).collect()
    }

    /// A method from the start of each sample, followed by the rates.
    fn add<R, X, F>(
        &mut self,
        (name, family): (&'static str, Family),
        m: &'a X,
        starts: Vec<Result<F, PositionError>>,
        operations: impl Fn(&Counts<'_>, usize) -> Option<Operations>,
    ) where
        X: Kinematic<Name = &'static str, V = D<1>>,
        X::Scalar: Exact,
        R: PositionMethod<X> + 'a,
        F: Borrow<R::From> + 'a,
    {
        let starts = starts.into_iter().zip(self.samples).collect::<Vec<_>>();
        let error = |start: &Result<F, PositionError>, sample: &Sample<M>, order| {
            let start = start.as_ref().map_err(|error| *error)?;
            let position = R::position(m, start.borrow(), inputs::<X>(sample.input))?;
            let found = rates(m, position.borrow(), order)?;
            let error = sample.reference.error(order, found.as_slice());
            let silent = PositionError::NotFinite { mechanism: X::NAME, quantity: "a result returned as Ok" };
            if error.is_finite() { Ok(error) } else { Err(silent) }
        };
        let quantities = [0, 1, 2].map(|order| QuantityPrice {
            errors: starts.iter().map(|(start, sample)| error(start, sample, order)).collect(),
            time: None,
            predicted: operations(&self.counts, order).map(|operations| self.machine.time::<X::Scalar>(operations)),
        });
        let timed = starts.into_iter().zip(&quantities[2].errors).filter(|(_, error)| error.is_ok());
        let timed = timed.filter_map(|((start, sample), _)| Some((start.ok()?, real::<X::Scalar>(sample.input))));
        let mut timed: Vec<(F, X::Scalar)> = timed.collect();
        let every = timed.len().div_ceil(TIMED).max(1);
        let mut place = 0;
        timed.retain(|_| {
            place += 1;
            place % every == 0
        });
        let timed = Rc::new(timed);
        let pass = |order: usize| -> Box<dyn Fn() + 'a> {
            let timed = Rc::clone(&timed);
            Box::new(move || {
                for (start, input) in timed.iter() {
                    let inputs = PerInput::<X>::from([black_box(*input)]);
                    let Ok(position) = R::position(m, start.borrow(), inputs) else { continue };
                    if order == 0 {
                        black_box(position);
                    } else {
                        // An error is a result, too.
                        let _ = black_box(rates(m, position.borrow(), order));
                    }
                }
            })
        };
        let passes = vec![pass(0), pass(1), pass(2)];
        let price = MethodPrice { name: name.to_owned(), family, quantities };
        self.works.push(Work { price, passes, evaluations: timed.len() });
    }
}

fn inputs<X: Mechanism<V = D<1>>>(input: f64) -> PerInput<X> {
    PerInput::<X>::from([real(input)])
}

/// u, `u'` or `u''` at a pose.
#[inline]
fn rates<X: Kinematic<Name = &'static str, V = D<1>>>(
    m: &X,
    pose: &X::Pose,
    order: usize,
) -> Result<PerUnknown<X>, PositionError> {
    if order == 0 {
        return Ok(X::unknowns(&X::coordinates_of(pose)));
    }
    let rates = m.velocity(pose, inputs::<X>(1.0).into())?;
    if order == 1 {
        return Ok(X::rate_parts(&rates).0);
    }
    let accelerations = m.acceleration(pose, &rates, inputs::<X>(0.0).into())?;
    Ok(X::acceleration_parts(&accelerations).0)
}
