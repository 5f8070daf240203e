//! The differential equations of a scene in the coordinates that are independent for the time being.
//!
//! q' = N z' and M_r z'' = Q_r with M_r = N' M N and Q_r = N' (F - M b), where N spans what [J A] leaves free and b is
//! q'' at z'' = 0. With the inputs for z these are the equations that are emitted.

use nalgebra::{SMatrix, SVector};

use super::independent::{Factors, Independent};
use super::scales::Scales;
use super::state::{State, Touch};
use super::watch::{Unwatched, Watch};
use crate::contact::{Contacts, ReducedContact, ReducedEquations};
use crate::integrate::{Crossing, Interpolant, System};
use crate::scene::{Coordinates, Inputs};
use crate::{Error, Mechanism, Mode, Real, Scene, finite, newton, real};

/// By which coordinates the motion is followed.
#[derive(Debug, Clone, Copy)]
pub(super) enum Road<T: Real, const U: usize, const V: usize, const N: usize> {
    /// The inputs, by the emitted equations.
    Inputs,
    /// Others.
    Others(Independent<T, U, V>),
    /// The polynomial over a change point, in other coordinates than the inputs, also where it goes on after the end.
    Over(Independent<T, U, V>, Interpolant<T, N>),
}

/// A pivot may fall to this part of the smallest one within a step.
const LEAST_PART: f64 = 0.2;

/// Newton steps that close the closures again from where an integrator has left them.
const MOST_ITERATIONS: usize = 8;

/// A step of Newton's method of this many roots of roundings leaves less than a rounding.
const ENOUGH: f64 = 1e-3;

/// A scene in motion, as an integrator takes it.
#[derive(Debug, Clone)]
pub struct Motion<'a, S, W, T: Real, const U: usize, const V: usize, const N: usize, const C: usize> {
    pub(super) scene: &'a S,
    pub(super) watch: W,
    pub(super) scales: Scales<T, U, V>,
    pub(super) road: Road<T, U, V, N>,
    pub(super) contacts: Contacts<T, C>,
    pub(super) names: [&'static str; C],
}

type Position<S, T, const U: usize, const V: usize, const N: usize, const C: usize> =
    Coordinates<<S as Scene<T, U, V, N, C>>::Mechanism, T, U, V>;

impl<'a, S, T, const U: usize, const V: usize, const N: usize, const C: usize> Motion<'a, S, Unwatched, T, U, V, N, C>
where
    S: Scene<T, U, V, N, C>,
    T: Real,
{
    /// In the inputs, with no contact acting.
    pub(super) fn new(scene: &'a S, scales: Scales<T, U, V>) -> Self {
        Self { scene, watch: Unwatched, scales, road: Road::Inputs, contacts: Contacts::open(), names: [""; C] }
    }
}

impl<'a, S, W, T, const U: usize, const V: usize, const N: usize, const C: usize> Motion<'a, S, W, T, U, V, N, C>
where
    S: Scene<T, U, V, N, C>,
    T: Real,
{
    /// The same with other events.
    pub(super) fn watched<W2>(self, watch: W2) -> Motion<'a, S, W2, T, U, V, N, C> {
        let Self { scene, scales, road, contacts, names, .. } = self;
        Motion { scene, watch, scales, road, contacts, names }
    }

    /// y of a position and the rates of the independent coordinates.
    pub(super) fn pack(q: &Position<S, T, U, V, N, C>, rates: &SVector<T, V>) -> SVector<T, N> {
        S::state(q, &Inputs::<S::Mechanism, T, U, V>::from(*rates))
    }

    pub(super) fn unpack(y: &SVector<T, N>) -> (Position<S, T, U, V, N, C>, SVector<T, V>) {
        let (q, rates) = S::parts(y);
        (q, rates.into())
    }

    pub(super) fn joined(
        q: &Position<S, T, U, V, N, C>,
        (unknowns, inputs): (SVector<T, U>, SVector<T, V>),
    ) -> Position<S, T, U, V, N, C> {
        S::Mechanism::with_unknowns(&S::Mechanism::with_inputs(q, inputs), unknowns)
    }

    /// Which inputs are prescribed.
    pub(super) fn held(&self, t: T) -> [bool; V] {
        self.scene.prescribed(t).map(|law| law.is_some())
    }

    pub(super) fn factors(
        &self,
        independent: &Independent<T, U, V>,
        q: &Position<S, T, U, V, N, C>,
    ) -> Factors<T, U, V> {
        let mechanism = self.scene.mechanism();
        independent.factors(mechanism, &mechanism.pose_at(q), &self.scales)
    }

    /// The factors if the position is apart from a change point that is passed.
    pub(super) fn regular(
        &self,
        independent: &Independent<T, U, V>,
        q: &Position<S, T, U, V, N, C>,
    ) -> Option<Factors<T, U, V>> {
        let factors = self.factors(independent, q);
        (factors.pivots().amin() > independent.regularity() * real(LEAST_PART)).then_some(factors)
    }

    /// u' and v'.
    pub(super) fn velocity(&self, t: T, y: &SVector<T, N>) -> Result<(SVector<T, U>, SVector<T, V>), Error> {
        let (q, rates) = Self::unpack(y);
        let mechanism = self.scene.mechanism();
        match &self.road {
            Road::Inputs => {
                let pose = mechanism.pose_at(&q);
                let right = mechanism.jacobian_inputs(&pose) * -rates;
                Ok((mechanism.solve_jacobian(&pose, &right)?, rates))
            }
            Road::Others(independent) => {
                Ok(independent.apart(&(self.factors(independent, &q).basis() * rates), &rates))
            }
            Road::Over(independent, step) => {
                if let Some(factors) = self.regular(independent, &q) {
                    return Ok(independent.apart(&(factors.basis() * rates), &rates));
                }
                // Near the change point [J A] does not tell.
                let (rate, _) = Self::unpack(&step.slope_at(t));
                Ok((S::Mechanism::unknowns(&rate), S::Mechanism::inputs(&rate)))
            }
        }
    }

    /// y of a position and the rates of the inputs.
    pub(super) fn with_rates(
        &self,
        q: &Position<S, T, U, V, N, C>,
        rates: &SVector<T, V>,
    ) -> Result<SVector<T, N>, Error> {
        let (Road::Others(independent) | Road::Over(independent, _)) = &self.road else {
            return Ok(Self::pack(q, rates));
        };
        let mechanism = self.scene.mechanism();
        let pose = mechanism.pose_at(q);
        let right = mechanism.jacobian_inputs(&pose) * -rates;
        Ok(Self::pack(q, &independent.of(&mechanism.solve_jacobian(&pose, &right)?, rates)))
    }

    pub(super) fn state(&self, t: T, y: &SVector<T, N>) -> Result<State<T, Position<S, T, U, V, N, C>, C>, Error> {
        let (q, _) = Self::unpack(y);
        let rate = Self::joined(&q, self.velocity(t, y)?);
        let touch = |place: usize| Touch { name: self.names[place], mode: self.contacts.modes[place], change: None };
        Ok(State { t, q, rate, event: None, contacts: core::array::from_fn(touch) })
    }

    /// y with the closures closed again and prescribed inputs where their laws say.
    pub(super) fn closed(&self, t: T, y: &SVector<T, N>) -> Result<SVector<T, N>, Error> {
        let (mut q, mut rates) = Self::unpack(y);
        let laws = self.scene.prescribed(t);
        let mut inputs = S::Mechanism::inputs(&q);
        for (input, law) in laws.iter().enumerate() {
            if let Some([position, speed, _]) = *law {
                inputs[input] = position;
                let at = match &self.road {
                    Road::Inputs => Some(input),
                    Road::Others(independent) | Road::Over(independent, _) => {
                        independent.free.iter().position(|&free| free == U + input)
                    }
                };
                if let Some(at) = at {
                    rates[at] = speed;
                }
            }
        }
        if laws.iter().any(Option::is_some) {
            q = S::Mechanism::with_inputs(&q, inputs);
        }
        let q = match &self.road {
            Road::Inputs => self.closed_in_inputs(&q)?,
            Road::Others(independent) => self.closed_by(independent, &q)?,
            Road::Over(independent, _) if self.regular(independent, &q).is_none() => q,
            Road::Over(independent, _) => self.closed_by(independent, &q)?,
        };
        Ok(Self::pack(&q, &rates))
    }

    /// The position near `q` with the same inputs. Where an integrator has left it, one step of Newton's method is
    /// mostly so small that the next would be less than rounding.
    fn closed_in_inputs(&self, q: &Position<S, T, U, V, N, C>) -> Result<Position<S, T, U, V, N, C>, Error> {
        let mechanism = self.scene.mechanism();
        let mut q = *q;
        let mut last = None;
        let enough = T::default_epsilon().sqrt() * real(ENOUGH);
        for _ in 0..MOST_ITERATIONS {
            let pose = mechanism.pose_at(&q);
            let step = mechanism.solve_jacobian(&pose, &mechanism.residual(&pose))?;
            let size = self.scales.speed(&step, &SVector::zeros());
            if !size.is_finite() {
                return Err(Error::NotFinite { mechanism: S::Mechanism::NAME, quantity: "the position" });
            }
            if size.is_zero() || last.is_some_and(|last| size >= last) {
                break;
            }
            q = S::Mechanism::with_unknowns(&q, S::Mechanism::unknowns(&q) - step);
            last = Some(size);
            if size <= enough {
                break;
            }
        }
        if last.is_none_or(|last| last < T::default_epsilon().sqrt()) {
            return Ok(q);
        }
        // No position near: the search says why.
        Ok(newton(mechanism, &q)?.coordinates)
    }

    /// The position near `q` with the same independent coordinates.
    pub(super) fn closed_by(
        &self,
        independent: &Independent<T, U, V>,
        q: &Position<S, T, U, V, N, C>,
    ) -> Result<Position<S, T, U, V, N, C>, Error> {
        let mechanism = self.scene.mechanism();
        let mut q = *q;
        let mut last = None;
        for _ in 0..MOST_ITERATIONS {
            let pose = mechanism.pose_at(&q);
            let step = independent.factors(mechanism, &pose, &self.scales).solve(&mechanism.residual(&pose));
            let (unknowns, inputs) = independent.apart(&-step, &SVector::zeros());
            let size = self.scales.speed(&unknowns, &inputs);
            if !size.is_finite() {
                return Err(Error::NotFinite { mechanism: S::Mechanism::NAME, quantity: "the position" });
            }
            // Steps of Newton's method fall until they are rounding.
            if size.is_zero() || last.is_some_and(|last| size >= last) {
                break;
            }
            q = Self::joined(&q, (S::Mechanism::unknowns(&q) + unknowns, S::Mechanism::inputs(&q) + inputs));
            last = Some(size);
        }
        if last.is_none_or(|last| last < T::default_epsilon().sqrt()) {
            return Ok(q);
        }
        Err(self.change_point(&q))
    }

    /// The name of the group whose determinant is smallest beside its size.
    pub(super) fn change_point(&self, q: &Position<S, T, U, V, N, C>) -> Error {
        let mechanism = self.scene.mechanism();
        let (_, group) = weakest(mechanism, &mechanism.pose_at(q));
        Error::ChangePoint { mechanism: S::Mechanism::NAME, group }
    }

    /// Why no coordinates are left: what is prescribed comes to a dead point, or two motions cross.
    pub(super) fn cannot_go_on(&self, t: T, q: &Position<S, T, U, V, N, C>) -> Error {
        let mechanism = self.scene.mechanism();
        let is_driven = self.held(t).contains(&true);
        let freely = Independent::choose(mechanism, &mechanism.pose_at(q), &self.scales, &[false; V]);
        let is_regular = freely.regularity() > T::default_epsilon().sqrt() * real(64.0);
        if is_driven && is_regular { self.singular(q) } else { self.change_point(q) }
    }

    pub(super) fn singular(&self, q: &Position<S, T, U, V, N, C>) -> Error {
        let mechanism = self.scene.mechanism();
        let (regularity, group) = weakest(mechanism, &mechanism.pose_at(q));
        let regularity = crate::scalar::to_f64(regularity);
        Error::Singular { mechanism: S::Mechanism::NAME, group, regularity }
    }

    /// y' in the coordinates of a choice.
    pub(super) fn rate_by(
        &self,
        independent: &Independent<T, U, V>,
        factors: &Factors<T, U, V>,
        (t, y): (T, &SVector<T, N>),
    ) -> Result<SVector<T, N>, Error> {
        self.rate_of(&self.equations_by(independent, factors, (t, y))?)
    }

    /// y' from the equations and the velocity.
    fn rate_of(
        &self,
        (equations, velocity): &(ReducedEquations<T, V, C>, Position<S, T, U, V, N, C>),
    ) -> Result<SVector<T, N>, Error> {
        let accelerations = self.contacts.acceleration(equations)?;
        finite(S::NAME, "the acceleration", accelerations.data.0[0])?;
        Ok(Self::pack(velocity, &accelerations))
    }

    /// M_r, Q_r and the contacts in the coordinates of a choice, and q'.
    pub(super) fn equations_by(
        &self,
        independent: &Independent<T, U, V>,
        factors: &Factors<T, U, V>,
        (t, y): (T, &SVector<T, N>),
    ) -> Result<(ReducedEquations<T, V, C>, Position<S, T, U, V, N, C>), Error> {
        let (mut equations, velocity) = self.unprescribed_by(independent, factors, (t, y))?;
        // What is prescribed moves as its law says, whatever the forces.
        for (input, law) in self.scene.prescribed(t).iter().enumerate() {
            let Some([_, _, acceleration]) = *law else { continue };
            if let Some(at) = independent.free.iter().position(|&free| free == U + input) {
                equations.prescribe(at, acceleration);
            }
        }
        Ok((equations, velocity))
    }

    /// The same where no input is prescribed yet.
    pub(super) fn unprescribed_by(
        &self,
        independent: &Independent<T, U, V>,
        factors: &Factors<T, U, V>,
        (t, y): (T, &SVector<T, N>),
    ) -> Result<(ReducedEquations<T, V, C>, Position<S, T, U, V, N, C>), Error> {
        let mechanism = self.scene.mechanism();
        let (q, rates) = Self::unpack(y);
        let basis = factors.basis();
        let velocity = Self::joined(&q, independent.apart(&(basis * rates), &rates));
        let gamma = mechanism.gamma(&mechanism.pose_at(&q), &velocity);
        let (of_unknowns, of_inputs) = independent.apart(&-factors.solve(&gamma), &SVector::zeros());
        let mut unknowns = SMatrix::<T, U, V>::zeros();
        let mut inputs = SMatrix::<T, V, V>::zeros();
        for column in 0..V {
            let unit = SVector::from_fn(|k, _| if k == column { T::one() } else { T::zero() });
            let (of_unknowns, of_inputs) = independent.apart(&basis.column(column).into_owned(), &unit);
            unknowns.set_column(column, &of_unknowns);
            inputs.set_column(column, &of_inputs);
        }
        let all = self.scene.unreduced(t, &q, &velocity)?;
        let moved = all.unknowns * unknowns + all.mixed * inputs;
        let mass = unknowns.tr_mul(&moved) + inputs.tr_mul(&(all.mixed.tr_mul(&unknowns) + all.inputs * inputs));
        let left_unknowns = all.unknown_forces - all.unknowns * of_unknowns - all.mixed * of_inputs;
        let left_inputs = all.input_forces - all.mixed.tr_mul(&of_unknowns) - all.inputs * of_inputs;
        let forces = unknowns.tr_mul(&left_unknowns) + inputs.tr_mul(&left_inputs);
        let contacts = self
            .scene
            .contacts(t, &q, &velocity)?
            .map(|contact| ReducedContact::new(&contact, (&unknowns, &inputs), (&of_unknowns, &of_inputs)));
        let name = |column: usize| {
            if column < U { S::Mechanism::UNKNOWNS[column] } else { S::Mechanism::INPUTS[column - U] }
        };
        let coordinates = independent.free.map(name);
        Ok((ReducedEquations { scene: S::NAME, coordinates, mass, forces, rates, contacts }, velocity))
    }
}

impl<S, W, T, const U: usize, const V: usize, const N: usize, const K: usize, const C: usize> System<T, N, K, C>
    for Motion<'_, S, W, T, U, V, N, C>
where
    S: Scene<T, U, V, N, C>,
    W: Watch<T, Position<S, T, U, V, N, C>, Inputs<S::Mechanism, T, U, V>, K, C>,
    T: Real,
{
    #[inline]
    fn rate(&mut self, t: T, y: &SVector<T, N>) -> Result<SVector<T, N>, Error> {
        let (Road::Others(independent) | Road::Over(independent, _)) = &self.road else {
            if self.contacts.modes.iter().all(|&mode| mode == Mode::Open) {
                return self.scene.derivative(t, y);
            }
            return self.rate_of(&ReducedEquations::with_velocity(self.scene, t, y)?);
        };
        let (q, _) = Self::unpack(y);
        let factors = self.factors(independent, &q);
        // No step goes over a singularity of the choice, or near it, unnoticed.
        let least = independent.regularity() * real(LEAST_PART);
        let mut pivots = factors.pivots();
        pivots.zip_apply(&independent.pivots, |pivot, start| {
            *pivot *= if start < T::zero() { -T::one() } else { T::one() }
        });
        if !pivots.iter().all(|&pivot| pivot >= least) {
            return Err(self.singular(&q));
        }
        self.rate_by(independent, &factors, (t, y))
    }

    fn events(&mut self, t: T, y: &SVector<T, N>) -> Result<[T; K], Error> {
        let state = self.state(t, y)?;
        self.watch.values(&state)
    }

    fn crossings(&self) -> [Crossing; K] {
        self.watch.crossings()
    }

    fn guards(&mut self, t: T, y: &SVector<T, N>) -> Result<[T; C], Error> {
        self.margins(t, y)
    }
}

/// How regular the group is that is nearest to a singularity, and its name: its determinant beside the product of the
/// largest sizes of its columns, of n unknowns to the power 1 / (n - 1). Of two links it is half the sine of the angle
/// between them.
pub(super) fn weakest<M, T, const U: usize, const V: usize>(mechanism: &M, pose: &M::Pose) -> (T, &'static str)
where
    M: Mechanism<T, U, V>,
    T: Real,
{
    let (sizes, _) = mechanism.jacobian_sizes(pose);
    let determinants = mechanism.block_determinants(pose);
    let mut least = (T::one(), "");
    for (determinant, group) in determinants.as_ref().iter().zip(M::GROUPS) {
        let square = |column: usize| {
            group.equations.iter().fold(T::zero(), |sum, &row| sum + sizes[(row, column)] * sizes[(row, column)])
        };
        let product = group.unknowns.iter().fold(T::one(), |product, &column| product * square(column)).sqrt();
        let mut part = determinant.abs() / product;
        if group.unknowns.len() > 2 {
            part = part.powf(real::<T>(1.0 / (group.unknowns.len() - 1) as f64));
        }
        // NaN is not regular either.
        let is_better = part >= least.0;
        if !is_better {
            least = (part, group.name);
        }
    }
    least
}
