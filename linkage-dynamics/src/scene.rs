//! Mechanisms with forces: the trait that integrators take, and what the code emitted for scenes calls.

use nalgebra::{SMatrix, SVector};

use crate::contact::within;
use crate::simulation::scales::Scales;
use crate::{Contact, ContactLaw, Equations};
use linkage_runtime::__shared::all_finite;
use linkage_runtime::__shared::finite;
use linkage_runtime::__shared::to_f64;
use linkage_runtime::{Error, Mechanism, Real, newton};

/// Values that the functions of a scene share at a position and rates of the inputs.
#[derive(Debug, Clone, Copy)]
pub struct Kinematics<P, Q, T, const U: usize, const V: usize> {
    /// The position.
    pub pose: P,
    /// W, column by column.
    pub ratios: [[T; U]; V],
    /// q' = (W v', v').
    pub velocity: Q,
    /// u'' where the inputs do not accelerate.
    pub bias: [T; U],
}

/// A mechanism of `U` dependent and `V` independent coordinates with inertia and forces, as a differential
/// equation of `N` = `U` + 2 `V` unknowns, with `C` frictions and stops.
///
/// `linkage!` implements it for every `scene` with `inertia`. The state is y = (q, v'): all coordinates, then
/// the rates of the inputs. Its derivative (W v', v'') needs no position to be solved for, follows angles beyond
/// a turn, and does not leave a branch unnoticed: W has no finite value at a dead point. What rounding and the
/// integrator add to the closures is removed by [`Scene::project`], after each step or now and then. An
/// integrator of plain functions takes
///
/// ```text
/// |t, y| scene.derivative(t, y)
/// ```
pub trait Scene<T: Real, const U: usize, const V: usize, const N: usize, const C: usize> {
    /// The name of the scene, as errors give it.
    const NAME: &'static str;
    /// The kinematics.
    type Mechanism: Mechanism<T, U, V>;

    /// The kinematics.
    fn mechanism(&self) -> &Self::Mechanism;
    /// y = (q, v').
    fn state(q: &Coordinates<Self::Mechanism, T, U, V>, rates: &Inputs<Self::Mechanism, T, U, V>) -> SVector<T, N>;
    /// q and v', taken out of y.
    fn parts(state: &SVector<T, N>) -> (Coordinates<Self::Mechanism, T, U, V>, Inputs<Self::Mechanism, T, U, V>);
    /// Refuses parameters that no mechanism has.
    ///
    /// # Errors
    /// [`Error::Negative`] if a mass, an inertia or a friction is negative, with its name; [`Error::NoRange`] and
    /// [`Error::Restitution`] with that of a stop.
    fn check(&self) -> Result<(), Error>;
    /// y' = (W v', v''), without frictions and stops.
    ///
    /// # Errors
    /// [`Error::Singular`] where J has no inverse, [`Error::NoInertia`] where an input could accelerate without
    /// a force, [`Error::NotFinite`] with the name of the body or the effect that has no finite value.
    fn derivative(&self, t: T, state: &SVector<T, N>) -> Result<SVector<T, N>, Error>;
    /// M, Q, W and u'' at v'' = 0, of which [`derivative`](Self::derivative) is made where no input is prescribed.
    ///
    /// # Errors
    /// [`Error::Singular`] where J has no inverse, [`Error::NotFinite`] with the name of the body or the effect that
    /// has no finite value.
    fn equations(&self, t: T, state: &SVector<T, N>) -> Result<Equations<T, U, V>, Error>;
    /// The frictions and stops as they were declared, in order, at a position and the velocity q'.
    ///
    /// # Errors
    /// [`Error::NotFinite`] with the name of the effect that has no finite value, [`Error::Negative`] with that of
    /// the friction whose limit is negative.
    fn contacts(
        &self,
        t: T,
        q: &Coordinates<Self::Mechanism, T, U, V>,
        velocity: &Coordinates<Self::Mechanism, T, U, V>,
    ) -> Result<[Contact<T, U, V>; C], Error>;
    /// M and F of M q'' + Psi_q' lambda = F in all coordinates, at these rates q' of all of them: what any choice of
    /// independent coordinates takes.
    ///
    /// # Errors
    /// [`Error::NotFinite`] if an entry is not finite.
    fn unreduced(
        &self,
        t: T,
        q: &Coordinates<Self::Mechanism, T, U, V>,
        rate: &Coordinates<Self::Mechanism, T, U, V>,
    ) -> Result<Unreduced<T, U, V>, Error>;
    /// The motion that is prescribed of each input: its value, its rate and its acceleration.
    fn prescribed(&self, t: T) -> [Option<[T; 3]>; V];
    /// The value and the rate of each input, with its name.
    fn inputs(state: &SVector<T, N>) -> [(&'static str, T, T); V];

    /// The state with the closures closed again, the inputs as they are.
    ///
    /// # Errors
    /// [`Error::NotConverged`] if no position is found, [`Error::NotFinite`] if a number is not finite.
    fn project(&self, state: &SVector<T, N>) -> Result<SVector<T, N>, Error> {
        all_finite(Self::NAME, "the state", state.iter())?;
        let (q, rates) = Self::parts(state);
        let closed = newton(self.mechanism(), &q)?;
        Ok(Self::state(&closed.coordinates, &rates))
    }

    /// The state to begin with, at the position near `q` whose inputs are those of `q`.
    ///
    /// # Errors
    /// Those of [`Scene::check`] and [`Scene::project`], [`Error::Inconsistent`] if a driven input or its rate is not
    /// what its law says, and [`Error::BeyondStop`] if a stop is passed already.
    fn start(
        &self,
        t: T,
        q: &Coordinates<Self::Mechanism, T, U, V>,
        rates: &Inputs<Self::Mechanism, T, U, V>,
    ) -> Result<SVector<T, N>, Error> {
        self.check()?;
        let given = Self::state(q, rates);
        for ((coordinate, value, rate), law) in Self::inputs(&given).into_iter().zip(self.prescribed(t)) {
            let Some([position, speed, _]) = law else { continue };
            // An infinite law agrees with everything.
            finite(Self::NAME, "the law of a drive", [position, speed])?;
            for (quantity, given, law) in [("position", value, position), ("rate", rate, speed)] {
                let gap = (given - law).abs();
                // NaN is not consistent either.
                let agrees = gap <= T::default_epsilon().sqrt() * (given.abs() + law.abs());
                if !agrees {
                    let gap = to_f64(gap);
                    return Err(Error::Inconsistent { scene: Self::NAME, coordinate, quantity, gap });
                }
            }
        }
        let state = self.project(&given)?;
        if C > 0 {
            let (q, _) = Self::parts(&state);
            let rest = <Self::Mechanism as Mechanism<T, U, V>>::with_unknowns(&q, SVector::zeros());
            let rest = <Self::Mechanism as Mechanism<T, U, V>>::with_inputs(&rest, SVector::zeros());
            let scales = Scales::of(self.mechanism(), &q);
            for Contact { name, along, law } in self.contacts(t, &q, &rest)? {
                if let ContactLaw::Stop { lower, upper, .. } = law {
                    let resolution = scales.resolution_by_inputs(self.mechanism(), &q, &along)?;
                    within(Self::NAME, name, (along.value, resolution), [lower, upper])?;
                }
            }
        }
        Ok(state)
    }
}

/// The coordinates q of a mechanism by name.
pub type Coordinates<M, T, const U: usize, const V: usize> = <M as Mechanism<T, U, V>>::Coordinates;
/// The inputs v of a mechanism by name.
pub type Inputs<M, T, const U: usize, const V: usize> = <M as Mechanism<T, U, V>>::Inputs;

/// Inertia and forces in all coordinates, M q'' + Psi_q' lambda = F, apart by the unknowns u and the inputs v.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Unreduced<T, const U: usize, const V: usize> {
    /// M_uu.
    pub unknowns: SMatrix<T, U, U>,
    /// M_uv.
    pub mixed: SMatrix<T, U, V>,
    /// M_vv.
    pub inputs: SMatrix<T, V, V>,
    /// F_u, with the quadratic velocity terms of the inertia.
    pub unknown_forces: SVector<T, U>,
    /// F_v, with the quadratic velocity terms of the inertia.
    pub input_forces: SVector<T, V>,
}

/// The energy of a scene.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Energy<T> {
    /// Of the bodies whose inertia counts.
    pub kinetic: T,
    /// Of gravity, springs and potentials.
    pub potential: T,
}

/// The power of a scene: the energy changes by `applied` - `dissipated`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Power<T> {
    /// Of forces, torques and drives.
    pub applied: T,
    /// Of dampers.
    pub dissipated: T,
}

/// Refuses numbers less than zero, and what is not finite.
///
/// # Errors
/// [`Error::Negative`] or [`Error::NotFinite`] with the name of the first.
pub fn not_negative<T: Real, const N: usize>(scene: &'static str, values: [(&'static str, T); N]) -> Result<(), Error> {
    for (quantity, value) in values {
        if !value.is_finite() {
            return Err(Error::NotFinite { mechanism: scene, quantity });
        }
        if value < T::zero() {
            return Err(Error::Negative { scene, quantity, value: to_f64(value) });
        }
    }
    Ok(())
}

/// Refuses the first value that is not finite, by its name.
///
/// # Errors
/// [`Error::NotFinite`] with the name.
pub fn finite_each<T: Real, const N: usize>(scene: &'static str, values: [(&'static str, T); N]) -> Result<(), Error> {
    values
        .into_iter()
        .find(|(_, value)| !value.is_finite())
        .map_or(Ok(()), |(quantity, _)| Err(Error::NotFinite { mechanism: scene, quantity }))
}
