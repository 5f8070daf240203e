//! A scene with its contacts as a system for integrators.

use linkage::contact::{Contacts, ReducedEquations};
use linkage::integrate::{Action, Crossing, Step, System, Tolerance, dop853};
use linkage::nalgebra::SVector;
use linkage::{Error, Mode, Scene};

/// A scene with its contacts as a system for integrators.
pub(super) struct Moving<'a, S, const C: usize> {
    pub(super) scene: &'a S,
    pub(super) contacts: Contacts<f64, C>,
    /// When something happened, with the modes before and after.
    pub(super) history: Vec<(f64, [Mode; C], [Mode; C])>,
    /// How often the end of a step had to be mended.
    pub(super) mended: usize,
}

impl<'a, S, const C: usize> Moving<'a, S, C> {
    pub(super) fn start<const U: usize, const V: usize, const N: usize>(
        scene: &'a S,
        t: f64,
        y: &SVector<f64, N>,
    ) -> Result<(Self, SVector<f64, N>), Error>
    where
        S: Scene<f64, U, V, N, C>,
    {
        let (q, rates) = S::parts(y);
        let rates: SVector<f64, V> = rates.into();
        let (contacts, rates) =
            Contacts::begin(t, &rates, |rates| ReducedEquations::of(scene, t, &S::state(&q, &(*rates).into())))?;
        Ok((Self { scene, contacts, history: Vec::new(), mended: 0 }, S::state(&q, &rates.into())))
    }

    fn settle<const U: usize, const V: usize, const N: usize>(
        &mut self,
        t: f64,
        y: &SVector<f64, N>,
    ) -> Result<SVector<f64, N>, Error>
    where
        S: Scene<f64, U, V, N, C>,
    {
        let scene = self.scene;
        let (q, rates) = S::parts(y);
        let at = |rates: &SVector<f64, V>| ReducedEquations::of(scene, t, &S::state(&q, &(*rates).into()));
        let rates = self.contacts.settle(t, &rates.into(), at)?;
        Ok(S::state(&q, &rates.into()))
    }
}

impl<S, const U: usize, const V: usize, const N: usize, const C: usize> System<f64, N, C> for Wrapped<'_, S, U, V, C>
where
    S: Scene<f64, U, V, N, C>,
{
    fn rate(&mut self, t: f64, y: &SVector<f64, N>) -> Result<SVector<f64, N>, Error> {
        let scene = self.0.scene;
        let equations = ReducedEquations::of(scene, t, y)?;
        let acceleration = self.0.contacts.acceleration(&equations)?;
        let (velocity, _) = S::parts(&scene.derivative(t, y)?);
        Ok(S::state(&velocity, &acceleration.into()))
    }

    fn events(&mut self, t: f64, y: &SVector<f64, N>) -> Result<[f64; C], Error> {
        self.0.contacts.events(&ReducedEquations::of(self.0.scene, t, y)?)
    }

    fn crossings(&self) -> [Crossing; C] {
        Contacts::<f64, C>::crossings()
    }

    fn at_event(&mut self, _: usize, t: f64, y: &SVector<f64, N>) -> Result<Action<f64, N>, Error> {
        let before = self.0.contacts.modes;
        let state = self.0.settle(t, y)?;
        self.0.history.push((t, before, self.0.contacts.modes));
        Ok(Action::Restart(state))
    }

    fn before_step(&mut self, t: f64, y: &SVector<f64, N>) -> Result<Option<SVector<f64, N>>, Error> {
        let equations = ReducedEquations::of(self.0.scene, t, y)?;
        let (rates, holds) = self.0.contacts.review(&equations)?;
        if !holds {
            self.0.mended += 1;
            return self.0.settle(t, y).map(Some);
        }
        if rates == equations.rates {
            return Ok(None);
        }
        let (q, _) = S::parts(y);
        Ok(Some(S::state(&q, &rates.into())))
    }
}

/// With the numbers of its coordinates, which the trait of systems does not name.
pub(super) struct Wrapped<'a, S, const U: usize, const V: usize, const C: usize>(pub(super) Moving<'a, S, C>);

pub(super) type Event<const N: usize, const C: usize> = (f64, SVector<f64, N>, [Mode; C], [Mode; C]);

/// How a motion ended, and the events on the way: the time, the state at them, the modes before and after.
pub(super) struct End<const N: usize, const C: usize> {
    pub(super) y: SVector<f64, N>,
    pub(super) modes: [Mode; C],
    pub(super) events: Vec<Event<N, C>>,
}

pub(super) fn run<S, const U: usize, const V: usize, const N: usize, const C: usize>(
    scene: &S,
    y: SVector<f64, N>,
    end: f64,
) -> End<N, C>
where
    S: Scene<f64, U, V, N, C>,
{
    let (moving, y) = Moving::start(scene, 0.0, &y).unwrap();
    let tolerance = Tolerance::new(1e-13, [1.0; N]).unwrap();
    let mut motion = dop853(Wrapped(moving), (0.0, y), end, tolerance).unwrap();
    let mut states = Vec::new();
    motion
        .finish(|step: &Step<f64, N>, _| {
            states.extend(step.event.map(|_| step.state));
            true
        })
        .unwrap();
    let moving = &motion.system().0;
    assert_eq!(moving.mended, 0, "an event was missed: {:?}", moving.history);
    assert_eq!(states.len(), moving.history.len());
    let events = moving.history.iter().zip(states).map(|(&(t, before, after), y)| (t, y, before, after)).collect();
    End { y: *motion.state(), modes: moving.contacts.modes, events }
}

pub(super) fn close(what: &str, found: f64, expected: f64, tolerance: f64) {
    assert!((found - expected).abs() <= tolerance, "{what}: {found} instead of {expected}, off {:e}", found - expected);
}
