//! A scene with its contacts as a system for integrators.

use linkage::contact::{ContactReview, Contacts, ReducedEquations};
use linkage::integrate::{Action, Crossing, System, Tolerance, dop853};
use linkage::{Build, Column, D, Mode, MotionErrorOf, NameOf, Scene, StateParts};

type State<S> = Column<f64, <S as Scene>::State>;
type Modes<S> = Column<Mode, <S as Scene>::Contacts>;

/// A scene with its contacts as a system for integrators.
pub(super) struct Moving<'a, S: Scene<Scalar = f64>> {
    pub(super) scene: &'a S,
    pub(super) contacts: Contacts<f64, S::Contacts>,
    /// The time of a change, with the modes before and after.
    pub(super) history: Vec<(f64, Modes<S>, Modes<S>)>,
    /// The number of ends of steps that had to be corrected.
    pub(super) mended: usize,
}

impl<'a, S: Scene<Scalar = f64>> Moving<'a, S> {
    pub(super) fn start(scene: &'a S, t: f64, y: &State<S>) -> Result<(Self, State<S>), MotionErrorOf<S>> {
        let StateParts { q, input_rates: rates } = S::parts(y);
        let (contacts, rates) =
            Contacts::begin(t, &rates.into(), |rates| ReducedEquations::of(scene, t, &S::state(&q, &(*rates).into())))?;
        Ok((Self { scene, contacts, history: Vec::new(), mended: 0 }, S::state(&q, &rates.into())))
    }

    fn settle(&mut self, t: f64, y: &State<S>) -> Result<State<S>, MotionErrorOf<S>> {
        let scene = self.scene;
        let StateParts { q, input_rates: rates } = S::parts(y);
        let at = |rates: &Column<f64, S::V>| ReducedEquations::of(scene, t, &S::state(&q, &(*rates).into()));
        let rates = self.contacts.settle(t, &rates.into(), at)?;
        Ok(S::state(&q, &rates.into()))
    }
}

impl<S: Scene<Scalar = f64>> System for Moving<'_, S> {
    type Scalar = f64;
    type Name = NameOf<S>;
    type N = S::State;
    type Events = S::Contacts;
    type Guards = D<0>;

    fn rate(&mut self, t: f64, y: &State<S>) -> Result<State<S>, MotionErrorOf<S>> {
        let equations = ReducedEquations::of(self.scene, t, y)?;
        let acceleration = self.contacts.acceleration(&equations)?;
        let rates = S::parts(&self.scene.derivative(t, y)?).q;
        Ok(S::state(&rates, &acceleration.into()))
    }

    fn events(&mut self, t: f64, y: &State<S>) -> Result<Column<f64, S::Contacts>, MotionErrorOf<S>> {
        self.contacts.events(&ReducedEquations::of(self.scene, t, y)?)
    }

    fn crossings(&self) -> Column<Crossing, S::Contacts> {
        self.contacts.crossings()
    }

    fn at_event(&mut self, _: usize, t: f64, y: &State<S>) -> Result<Action<State<S>>, MotionErrorOf<S>> {
        let before = self.contacts.modes;
        let state = self.settle(t, y)?;
        self.history.push((t, before, self.contacts.modes));
        Ok(Action::Restart(state))
    }

    fn before_step(&mut self, t: f64, y: &State<S>) -> Result<Option<State<S>>, MotionErrorOf<S>> {
        let equations = ReducedEquations::of(self.scene, t, y)?;
        let ContactReview { rates, modes_hold } = self.contacts.review(&equations)?;
        if !modes_hold {
            self.mended += 1;
            return self.settle(t, y).map(Some);
        }
        if rates == equations.rates {
            return Ok(None);
        }
        let q = S::parts(y).q;
        Ok(Some(S::state(&q, &rates.into())))
    }
}

/// The time, the state, the modes before and after.
type Event<S> = (f64, State<S>, Modes<S>, Modes<S>);

/// The end of a motion, and its events.
pub(super) struct End<S: Scene<Scalar = f64>> {
    pub(super) y: State<S>,
    pub(super) modes: Modes<S>,
    pub(super) events: Vec<Event<S>>,
}

pub(super) fn run<S: Scene<Scalar = f64>>(scene: &S, y: State<S>, end: f64) -> End<S> {
    let (moving, y) = Moving::start(scene, 0.0, &y).unwrap();
    let tolerance = Tolerance::new(1e-13, y.dim().repeat(1.0)).unwrap();
    let mut motion = dop853(moving, (0.0, y), end, tolerance).unwrap();
    let mut states = Vec::new();
    motion
        .finish(|step, _| {
            states.extend(step.event.map(|_| step.state));
            true
        })
        .unwrap();
    let moving = motion.system();
    assert_eq!(moving.mended, 0, "an event was missed: {:?}", moving.history);
    assert_eq!(states.len(), moving.history.len());
    let events = moving.history.iter().zip(states).map(|(&(t, before, after), y)| (t, y, before, after)).collect();
    End { y: *motion.state(), modes: moving.contacts.modes, events }
}
