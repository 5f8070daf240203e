//! Dry friction and stops against exact motions, and against integrations written by hand.

use linkage::contact::{Contacts, ReducedEquations};
use linkage::integrate::{Action, Crossing, Step, System, Tolerance, dop853};
use linkage::nalgebra::{SVector, vector};
use linkage::{Error, Mode, Scene, linkage};

include!("mechanisms/block.rs");
include!("mechanisms/belt.rs");
include!("mechanisms/yoke.rs");
include!("mechanisms/slider_crank_contacts.rs");
include!("mechanisms/five_bar_contacts.rs");

/// A scene with its contacts as a system for integrators.
struct Moving<'a, S, const C: usize> {
    scene: &'a S,
    contacts: Contacts<f64, C>,
    /// When something happened, with the modes before and after.
    history: Vec<(f64, [Mode; C], [Mode; C])>,
    /// How often the end of a step had to be mended.
    mended: usize,
}

impl<'a, S, const C: usize> Moving<'a, S, C> {
    fn start<const U: usize, const V: usize, const N: usize>(
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
struct Wrapped<'a, S, const U: usize, const V: usize, const C: usize>(Moving<'a, S, C>);

type Event<const N: usize, const C: usize> = (f64, SVector<f64, N>, [Mode; C], [Mode; C]);

/// How a motion ended, and the events on the way: the time, the state at them, the modes before and after.
struct End<const N: usize, const C: usize> {
    y: SVector<f64, N>,
    modes: [Mode; C],
    events: Vec<Event<N, C>>,
}

fn run<S, const U: usize, const V: usize, const N: usize, const C: usize>(
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

fn close(what: &str, found: f64, expected: f64, tolerance: f64) {
    assert!((found - expected).abs() <= tolerance, "{what}: {found} instead of {expected}, off {:e}", found - expected);
}

fn block(x: f64) -> BlockCoordinates {
    BlockCoordinates { x, y: x }
}

/// It stops after v0 / (mu g) at v0^2 / (2 mu g), and stays.
#[test]
fn a_sliding_block_stops() {
    let scene = Sliding::default();
    let (speed, brake) = (1.7, 0.3 * 9.81);
    let start = scene.start(0.0, &block(0.25), &speed.into()).unwrap();
    let power = scene.power(0.0, &block(0.25), -speed).unwrap();
    close("power", power.dissipated, 0.3 * 2.0 * 9.81 * speed, 1e-14);
    assert_eq!(scene.power(0.0, &block(0.25), 0.0).unwrap().dissipated, 0.0);
    let end = run(&scene, start, 5.0);
    assert_eq!(end.events.len(), 1, "{:?}", end.events);
    let (t, _, before, after) = end.events[0];
    close("time", t, speed / brake, 1e-14);
    assert_eq!((before, after), ([Mode::SlipForward], [Mode::Stick]));
    close("place", end.y[1], 0.25 + speed * speed / (2.0 * brake), 1e-14);
    close("y", end.y[0], end.y[1], 1e-15);
    assert_eq!(end.y[2], 0.0);
    let lost = scene.energy(&block(0.25), speed).unwrap().kinetic;
    close("work of friction", lost, 0.3 * 2.0 * 9.81 * (end.y[1] - 0.25), 1e-13);
}

/// A spring against dry friction: each half cycle the amplitude is 2 F / k less, until the spring holds no more.
#[test]
fn an_oscillator_comes_to_rest() {
    let scene = Sprung::default();
    let less = 2.0 * 0.3 * 2.0 * 9.81 / 50.0;
    let end = run(&scene, scene.start(0.0, &block(1.0), &0.0.into()).unwrap(), 6.0);
    let turns = [less - 1.0, 1.0 - 2.0 * less, 3.0 * less - 1.0, 1.0 - 4.0 * less];
    assert_eq!(end.events.len(), 4, "{:?}", end.events);
    for (half, ((t, y, before, after), turn)) in end.events.iter().zip(turns).enumerate() {
        close("time", *t, (half + 1) as f64 * std::f64::consts::PI / 5.0, 1e-11);
        close("turn", y[1], turn, 1e-11);
        let [back, forth] = [Mode::SlipBackward, Mode::SlipForward];
        let (was, next) = if half % 2 == 0 { (back, forth) } else { (forth, back) };
        assert_eq!((before[0], after[0]), (was, if half == 3 { Mode::Stick } else { next }));
    }
    close("rest", end.y[1], turns[3], 1e-11);
    assert_eq!(end.y[2], 0.0);
}

/// Pushed as hard as its friction holds, a block stays, without an event; pushed harder it goes.
#[test]
fn pushed_at_the_limit() {
    let limit = 0.3 * 2.0 * 9.81;
    for (push, moves) in
        [(1.0, false), (1.0 + 2e-16, false), (1.0 - 2e-16, false), (-1.0, false), (1.0 + 1e-9, true), (-1.5, true)]
    {
        let scene = Pushed { push: push * limit, ..Pushed::default() };
        let end = run(&scene, scene.start(0.0, &block(0.0), &0.0.into()).unwrap(), 3.0);
        assert_eq!(end.events, []);
        let expected = if moves { 0.5 * limit * (push.abs() - 1.0) / 2.0 * 9.0 * push.signum() } else { 0.0 };
        close("place", end.y[1], expected, 1e-13 * expected.abs() + if moves { 1e-14 } else { 0.0 });
        assert_eq!(end.y[2] == 0.0, !moves);
    }
}

/// A force that grows with time frees the block when it is as large as its friction.
#[test]
fn a_growing_force_frees_the_block() {
    let scene = Swelling { push: -2.0, ..Swelling::default() };
    let end = run(&scene, scene.start(0.0, &block(0.0), &0.0.into()).unwrap(), 5.0);
    let free = 0.3 * 2.0 * 9.81 / 2.0;
    assert_eq!(end.events.len(), 1);
    close("time", end.events[0].0, free, 2e-12);
    assert_eq!(end.events[0].3, [Mode::SlipBackward]);
    close("place", end.y[1], -2.0 * (5.0_f64 - free).powi(3) / 12.0, 1e-11);
}

/// A ball on a stop: the times of the impacts are a geometric series, after which it rests.
#[test]
fn a_ball_bounces_and_rests() {
    let scene = Bouncing::default();
    let fall = (2.0 * 0.75 / 9.81_f64).sqrt();
    let end = run(&scene, scene.start(0.0, &block(0.25), &0.0.into()).unwrap(), 3.0);
    // 0.4^20 is the first power below 2^-26, the square root of the rounding.
    assert_eq!(end.events.len(), 20, "{:?}", end.events);
    let mut time = fall;
    for (bounce, (t, y, _, after)) in end.events.iter().enumerate() {
        // The rounding of the place, passed at this rate.
        let rate = 9.81 * fall * 0.4_f64.powi(i32::try_from(bounce).unwrap());
        close("time", *t, time, 1e-12 + 1e-15 / rate);
        close("place", y[1], -0.5, 1e-12);
        assert_eq!(*after, [if bounce == 19 { Mode::AtLower } else { Mode::Open }]);
        time += 2.0 * fall * 0.4_f64.powi(i32::try_from(bounce).unwrap() + 1);
    }
    close("rest", end.events[19].0, 7.0 / 3.0 * fall, 1e-7);
    close("place", end.y[1], -0.5, 1e-12);
    assert_eq!(end.y[2], 0.0);
    // Without restitution at once; with all of it for ever.
    let dull = Bouncing { e: 0.0, ..Bouncing::default() };
    let end = run(&dull, dull.start(0.0, &block(0.25), &0.0.into()).unwrap(), 3.0);
    assert_eq!((end.events.len(), end.modes, end.y[2]), (1, [Mode::AtLower], 0.0));
    let elastic = Bouncing { e: 1.0, ..Bouncing::default() };
    let end = run(&elastic, elastic.start(0.0, &block(0.25), &0.0.into()).unwrap(), 9.0 * fall);
    assert_eq!(end.events.len(), 5);
    close("fifth", end.events[4].0, 9.0 * fall, 1e-11);
}

/// It is dragged until it has the speed of the belt, rides until the spring is stronger, and slips back.
#[test]
fn a_block_on_a_belt() {
    let scene = Carried::default();
    let (reach, omega) = (0.3 * 2.0 * 9.81 / 50.0_f64, 5.0);
    let q = BeltCoordinates { slip: 0.0, x: 0.0, z: 0.0 };
    let start = scene.start(0.0, &q, &BeltInputs { x: 0.0, z: 0.5 }).unwrap();
    let stuck = (0.5 / (reach * omega)).asin() / omega;
    let place = reach * (1.0 - (omega * stuck).cos());
    let free = stuck + (reach - place) / 0.5;
    let end = run(&scene, start, free + 0.4);
    assert_eq!(end.events.len(), 2, "{:?}", end.events);
    close("stuck", end.events[0].0, stuck, 1e-12);
    close("there", end.events[0].1[1], place, 1e-12);
    close("free", end.events[1].0, free, 1e-11);
    assert_eq!((end.events[0].3, end.events[1].3), ([Mode::Stick], [Mode::SlipBackward]));
    close("end", end.y[1], reach + 0.5 / omega * (omega * 0.4).sin(), 1e-11);
    close("belt", end.y[2], 0.5 * (free + 0.4), 1e-12);
}

/// The slider by hand: z = r cos phi + sqrt(l^2 - r^2 sin^2 phi), M = j + m z_1^2, Q = t0 - m z_1 z_2 phi'^2 - F z_1,
/// by the classical method of Runge and Kutta from dead centre to dead centre, where the friction changes its sign.
#[test]
fn a_slider_with_friction_by_hand() {
    let scene = Guided::default();
    let (r, l) = (0.1, 0.35_f64);
    let slider = |phi: f64| {
        let root = (l * l - r * r * phi.sin().powi(2)).sqrt();
        let first = -r * phi.sin() - r * r * phi.sin() * phi.cos() / root;
        let second =
            -r * phi.cos() - r * r * (2.0 * phi).cos() / root - (r * r * phi.sin() * phi.cos()).powi(2) / root.powi(3);
        (first, second)
    };
    // By phi instead of t, so that dead centres are ends of steps: t' = 1 / w, w' = w'' / w.
    let rate = |phi: f64, w: f64, sign: f64| {
        let (first, second) = slider(phi);
        let force = 3.0 - 0.8 * first * second * w * w - sign * 0.2 * 40.0 * first;
        [1.0 / w, force / (0.02 + 0.8 * first * first) / w]
    };
    let (mut phi, mut t, mut w) = (0.5_f64, 0.0, 12.0);
    let mut turns = Vec::new();
    for part in 1..=3 {
        let next = f64::from(part) * std::f64::consts::PI;
        let (steps, begun) = (4000, phi);
        let h = (next - begun) / f64::from(steps);
        let sign = slider(0.5 * (phi + next)).0.signum();
        for step in 0..steps {
            phi = begun + h * f64::from(step);
            let a = rate(phi, w, sign);
            let b = rate(phi + h / 2.0, w + h / 2.0 * a[1], sign);
            let c = rate(phi + h / 2.0, w + h / 2.0 * b[1], sign);
            let d = rate(phi + h, w + h * c[1], sign);
            t += h / 6.0 * (a[0] + 2.0 * (b[0] + c[0]) + d[0]);
            w += h / 6.0 * (a[1] + 2.0 * (b[1] + c[1]) + d[1]);
        }
        phi = next;
        turns.push((t, w));
    }
    let psi = std::f64::consts::PI - (r * 0.5_f64.sin() / l).asin();
    let guess = MachineCoordinates { phi: 0.5, psi, z: 0.43 };
    let start = scene.start(0.0, &guess, &12.0.into()).unwrap();
    let end = run(&scene, start, turns[2].0 + 0.01);
    assert_eq!(end.events.len(), 3, "{:?}", end.events);
    for ((time, y, before, after), (t, w)) in end.events.iter().zip(turns) {
        close("time", *time, t, 1e-11);
        close("phi'", y[3], w, 1e-9);
        assert!(before[0] != after[0] && !after[0].is_held());
    }
}

/// A linkage of one input holds while |Q| is not more than the sum of |S| limit over all its joints; with a torque that
/// grows, all let go at that moment.
#[test]
fn joints_hold_together() {
    let scene = Jointed::default();
    let guess = MachineCoordinates { phi: 0.8, psi: 2.9, z: 0.4 };
    let start = scene.start(0.0, &guess, &0.0.into()).unwrap();
    let (q, _) = Jointed::parts(&start);
    let machine = &scene.mechanism;
    let ratios = machine.velocity_ratios(&machine.pose_at(&q)).unwrap();
    let (psi, z) = (ratios[0], ratios[1]);
    let limit = 0.2 * 90.0 * (0.01 + 0.012 * (1.0 - psi).abs() + 0.008 * psi.abs()) + 0.2 * 40.0 * z.abs();
    let end = run(&scene, start, limit / 3.0 + 0.1);
    // At one moment, once for each joint; the first decides for all.
    assert_eq!(end.events.len(), 4, "{:?}", end.events);
    let (t, y, before, after) = end.events[0];
    assert!(end.events[1..].iter().all(|later| (later.0, later.2, later.3) == (t, after, after)), "{:?}", end.events);
    assert_eq!((before, y), ([Mode::Stick; 4], start));
    close("time", t, limit / 3.0, 1e-12);
    let forward = |ratio: f64| if ratio > 0.0 { Mode::SlipForward } else { Mode::SlipBackward };
    assert_eq!(after, [Mode::SlipForward, forward(1.0 - psi), forward(psi), forward(z)]);
    // Forces that hold are within their limits and carry the torque.
    let (moving, _) = Moving::start(&scene, 0.0, &start).unwrap();
    let equations = ReducedEquations::of(&scene, 0.999_999 * limit / 3.0, &start).unwrap();
    let motion = moving.contacts.motion(&equations).unwrap();
    let limits = [0.2 * 90.0 * 0.01, 0.2 * 90.0 * 0.012, 0.2 * 90.0 * 0.008, 0.2 * 40.0];
    let work = motion.forces.dot(&vector![1.0, 1.0 - psi, psi, z]);
    close("torque", -work, 0.999_999 * limit, 1e-14);
    for (force, limit) in motion.forces.iter().zip(limits) {
        assert!(force.abs() <= limit * (1.0 + 1e-12), "{force} {limit}");
    }
    assert_eq!(motion.acceleration[0], 0.0);
}

fn pair(theta1: f64, theta4: f64) -> PairCoordinates {
    PairCoordinates { theta2: 0.4, theta3: 1.9, theta1, theta4 }
}

/// One crank is held by its friction while the other slips: as if it were clamped.
#[test]
fn one_crank_sticks_while_the_other_slips() {
    let scene = Braked::default();
    let start = scene.start(0.0, &pair(1.1, 1.4), &PairInputs { theta1: 0.0, theta4: 0.4 }).unwrap();
    let clamped = Clamped { place: 1.1, ..Clamped::default() };
    let end = run(&scene, start, 0.6);
    let (q, _) = Braked::parts(&start);
    let rate = |t: f64, y: &SVector<f64, 6>| clamped.derivative(t, y);
    let tolerance = Tolerance::new(1e-13, [1.0; 6]).unwrap();
    // The other slips forward first, stops, and goes back.
    let (turn, after) = (end.events[0].0, end.events[0].3);
    assert_eq!((end.events.len(), after), (1, [Mode::Stick, Mode::SlipBackward]), "{:?}", end.events);
    let begin = clamped.start(0.0, &q, &PairInputs { theta1: 0.0, theta4: 0.4 }).unwrap();
    let mut there = dop853(rate, (0.0, begin), turn, tolerance).unwrap();
    there.finish(|_, _| true).unwrap();
    close("turn", there.state()[5], 0.0, 1e-12);
    let back = Clamped { sign: -1.0, ..clamped.clone() };
    let rate = |t: f64, y: &SVector<f64, 6>| back.derivative(t, y);
    let mut back = dop853(rate, (turn, *there.state()), 0.6, tolerance).unwrap();
    back.finish(|_, _| true).unwrap();
    close("y", (end.y - back.state()).amax(), 0.0, 1e-11);
    assert_eq!((end.y[2], end.y[4]), (1.1, 0.0));
}

/// An impact of one crank, free and with the other resting on its stop: Newton's law, impulses that only push, and the
/// energy that is lost.
#[test]
fn impacts_of_a_five_bar() {
    let q = Pair::default().solve(&pair(1.2, 0.5)).unwrap().coordinates;
    let scene = Stopped::default();
    let mass = scene.mass_matrix(&q).unwrap();
    let after = |scene: &Stopped, rates: [f64; 2]| {
        let inputs = PairInputs { theta1: rates[0], theta4: rates[1] };
        let start = scene.start(0.0, &q, &inputs).unwrap();
        let (moving, y) = Moving::start(scene, 0.0, &start).unwrap();
        (moving.contacts.modes, vector![y[4], y[5]])
    };
    // Both leave: nothing happens. One hits: v'+ = v'- - M^-1 S' (1 + e) s' / (S M^-1 S').
    assert_eq!(after(&scene, [-1.0, 2.0]), ([Mode::Open; 3], vector![-1.0, 2.0]));
    let inverse = mass.try_inverse().unwrap();
    let hit = vector![2.0, 3.0] - inverse.column(0) * (1.6 * 2.0 / inverse[(0, 0)]);
    assert!(hit[1] > 0.0);
    let (modes, rates) = after(&scene, [2.0, 3.0]);
    assert_eq!(modes, [Mode::Open; 3]);
    close("v'", (rates - hit).amax(), 0.0, 1e-14);
    // The other rests: on the one side it leaves its stop, on the other it would be pushed through it.
    let alone = vector![2.0, 0.0] - inverse.column(0) * (3.2 / inverse[(0, 0)]);
    assert!(alone[1] > 0.1, "{alone}");
    let (modes, rates) = after(&scene, [2.0, 0.0]);
    close("v'", (rates - alone).amax(), 0.0, 1e-14);
    assert_eq!(modes, [Mode::Open; 3]);
    let below = Stopped { lower4: -9.0, upper4: 0.5, ..scene.clone() };
    let (modes, rates) = after(&below, [2.0, 0.0]);
    close("v'", (rates - vector![-1.2, 0.0]).amax(), 0.0, 1e-14);
    assert_eq!((modes[0], rates[1]), (Mode::Open, 0.0));
    // Both hit.
    let (_, rates) = after(&scene, [2.0, -1.0]);
    let both = vector![-1.2, 0.6];
    let impulse = mass * (both - vector![2.0, -1.0]);
    assert!(impulse[0] < 0.0 && impulse[1] > 0.0, "{impulse}");
    close("v'", (rates - both).amax(), 0.0, 1e-14);
}

/// Elastic stops keep the energy; also one that acts on an output.
#[test]
fn elastic_stops_keep_the_energy() {
    let q = Pair::default().solve(&pair(0.9, 0.9)).unwrap().coordinates;
    let opening = q.theta2 - q.theta3;
    let scene = Narrow { half: 0.05, middle: opening, e1: 1.0, ..Narrow::default() };
    let start = scene.start(0.0, &q, &PairInputs { theta1: 0.7, theta4: -0.9 }).unwrap();
    let energy = |y: &SVector<f64, 6>| {
        let (q, rates) = Narrow::parts(y);
        scene.energy(&q, rates).unwrap().kinetic
    };
    let end = run(&scene, start, 3.0);
    assert!(end.events.len() > 4, "{:?}", end.events);
    for (_, y, _, after) in &end.events {
        close("on a stop", (y[0] - y[1] - opening).abs(), 0.05, 1e-12);
        assert_eq!(after, &[Mode::Open]);
    }
    close("energy", energy(&end.y) / energy(&start), 1.0, 1e-11);
}

/// The scalar of a contact, its derivatives and its quadratic terms, beside the outputs of the mechanism; the
/// equations in one kernel beside those put together.
#[test]
fn contacts_and_equations_as_the_mechanism_says() {
    use linkage::Equations;
    let scene = Jointed::default();
    for (phi, rate, acceleration) in [(0.3, 2.0, -7.0), (1.9, -3.5, 11.0), (4.4, 0.6, 0.3)] {
        let guess = MachineCoordinates { phi, psi: 3.0, z: 0.4 };
        let q = scene.mechanism.solve(&guess).unwrap().coordinates;
        let motion = scene.mechanism.motion(&q, rate, acceleration).unwrap();
        let (velocity, second) = (motion.velocity, motion.acceleration);
        let contacts = scene.contacts(1.5, &q, &velocity).unwrap();
        let joint = motion.outputs.joint;
        let expected = [
            ("friction on phi", phi, rate, acceleration, 0.2 * 0.01 * 90.0),
            ("friction on joint", joint.value, joint.velocity, joint.acceleration, 0.2 * 0.012 * 90.0),
            ("friction on psi", q.psi, velocity.psi, second.psi, 0.2 * 0.008 * 90.0),
            ("friction on z", q.z, velocity.z, second.z, 0.2 * 40.0),
        ];
        for (contact, (name, value, rate, acceleration, limit)) in contacts.iter().zip(expected) {
            let along =
                |u: SVector<f64, 2>, v: SVector<f64, 1>| contact.along.unknowns.dot(&u) + contact.along.inputs.dot(&v);
            assert_eq!(contact.name, name);
            close("s", contact.along.value, value, 1e-15);
            close("s'", along(vector![velocity.psi, velocity.z], vector![velocity.phi]), rate, 1e-15);
            let found = along(vector![second.psi, second.z], vector![second.phi]) + contact.along.bias;
            close("s''", found, acceleration, 1e-13);
            assert!(
                matches!(contact.law, linkage::ContactLaw::Friction { limit: found } if (found - limit).abs() < 1e-15)
            );
        }
        let together = scene.equations(1.5, &q, rate).unwrap();
        let (mass, forces) = (scene.mass_matrix(&q).unwrap(), scene.forces(1.5, &q, rate).unwrap());
        let apart = Equations::at(&scene.mechanism, &q, &vector![rate], mass, forces).unwrap();
        close("M", together.mass[0], apart.mass[0], 1e-15);
        close("Q", together.forces[0], apart.forces[0], 1e-13);
        close("W", (together.ratios - apart.ratios).amax(), 0.0, 1e-14);
        close("u''", (together.bias - apart.bias).amax(), 0.0, 1e-13);
    }
    // The quadratic terms of an output that is curved in the coordinates.
    let pair = Curved::default();
    let q = pair.mechanism.solve(&self::pair(0.7, 1.1)).unwrap().coordinates;
    let motion =
        pair.mechanism.motion(&q, PairInputs { theta1: 2.0, theta4: -3.0 }, PairInputs { theta1: 5.0, theta4: 4.0 });
    let (velocity, second) = motion.map(|motion| (motion.velocity, motion.acceleration)).unwrap();
    let contact = pair.contacts(0.0, &q, &velocity).unwrap()[0];
    close("s", contact.along.value, q.theta1 * q.theta2.sin(), 1e-15);
    let (sine, cosine) = q.theta2.sin_cos();
    let rate = velocity.theta1 * sine + q.theta1 * cosine * velocity.theta2;
    let u = |q: &PairCoordinates| vector![q.theta2, q.theta3];
    let v = |q: &PairCoordinates| vector![q.theta1, q.theta4];
    let along = |q: &PairCoordinates| contact.along.unknowns.dot(&u(q)) + contact.along.inputs.dot(&v(q));
    close("s'", along(&velocity), rate, 1e-14);
    let bent = 2.0 * velocity.theta1 * cosine * velocity.theta2 - q.theta1 * sine * velocity.theta2.powi(2);
    let expected = second.theta1 * sine + q.theta1 * cosine * second.theta2 + bent;
    close("s''", along(&second) + contact.along.bias, expected, 1e-12);
    // A limit that is a law.
    let linkage::ContactLaw::Friction { limit } = contact.law else { panic!("{contact:?}") };
    close("limit", limit, 9.0 * (1.0 + velocity.theta3.powi(2)), 1e-13);
}

/// Any masses, forces and contacts: what is found satisfies the law, and it alone does.
#[test]
fn the_law_holds_for_random_contacts() {
    use linkage::ContactLaw;
    use linkage::contact::ReducedContact;
    use linkage::nalgebra::SMatrix;
    let mut seed = 0x2545_f491_4f6c_dd1d_u64;
    let mut random = move || {
        seed ^= seed << 13;
        seed ^= seed >> 7;
        seed ^= seed << 17;
        (seed >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    };
    fn one<const V: usize>(random: &mut impl FnMut() -> f64, seen: &mut [usize; 6]) {
        let root = SMatrix::<f64, V, V>::from_fn(|_, _| random());
        let mass = root * root.transpose() + SMatrix::<f64, V, V>::identity() * 0.2;
        let forces = SVector::<f64, V>::from_fn(|_, _| 2.0 * random());
        let contacts: [ReducedContact<f64, V>; 5] = std::array::from_fn(|place| {
            let row = SVector::<f64, V>::from_fn(|_, _| random());
            let law = match place {
                0..3 => ContactLaw::Friction { limit: 0.8 * (1.0 + random()) },
                _ => ContactLaw::Stop { lower: 0.0, upper: 1.0, restitution: 0.5 },
            };
            let value = if place == 4 { 1.0 } else { 0.0 };
            ReducedContact { name: "a contact", value, row, drift: 0.0, bias: 0.0, law }
        });
        let coordinates = [""; V];
        let equations =
            ReducedEquations { scene: "random", coordinates, mass, forces, rates: SVector::zeros(), contacts };
        let (state, rates) = Contacts::begin(0.0, &SVector::zeros(), |_| Ok(equations)).unwrap();
        assert_eq!(rates, SVector::<f64, V>::zeros());
        let motion = state.motion(&equations).unwrap();
        // M v'' = Q + S' f.
        let mut left = mass * motion.acceleration - forces;
        for (contact, &force) in contacts.iter().zip(motion.forces.iter()) {
            left -= contact.row * force;
        }
        close("M v'' - Q - S' f", left.amax(), 0.0, 1e-11);
        for ((contact, &force), mode) in contacts.iter().zip(motion.forces.iter()).zip(state.modes) {
            let second = contact.row.dot(&motion.acceleration);
            let limit = match contact.law {
                ContactLaw::Friction { limit } => limit,
                ContactLaw::Stop { .. } => f64::INFINITY,
            };
            let fits = match mode {
                Mode::Stick => second.abs() < 1e-11 && force.abs() <= limit * (1.0 + 1e-12),
                Mode::SlipForward => second > 0.0 && force == -limit,
                Mode::SlipBackward => second < 0.0 && force == limit,
                Mode::AtLower => second.abs() < 1e-11 && force >= 0.0,
                Mode::AtUpper => second.abs() < 1e-11 && force <= 0.0,
                Mode::Open if contact.value == 0.0 => second >= 0.0 && force == 0.0,
                Mode::Open => second <= 0.0 && force == 0.0,
            };
            assert!(fits, "{V} {mode:?} {second} {force} {limit}");
            seen[mode as usize] += 1;
        }
        // The event functions of these modes see nothing; those of everything held see it unless nothing moves.
        assert!(state.events(&equations).unwrap().iter().all(|&value| value >= 0.0));
        let mut all = state;
        all.modes = [Mode::Stick, Mode::Stick, Mode::Stick, Mode::AtLower, Mode::AtUpper];
        let stands = all.events(&equations).unwrap().iter().all(|&left| left >= 0.0);
        assert_eq!(stands, motion.acceleration.amax() < 1e-11, "{V} {:?}", state.modes);
    }
    let mut seen = [0; 6];
    for _ in 0..3000 {
        one::<1>(&mut random, &mut seen);
        one::<2>(&mut random, &mut seen);
        one::<3>(&mut random, &mut seen);
        one::<4>(&mut random, &mut seen);
    }
    assert!(seen.iter().all(|&often| often > 1000), "{seen:?}");
}

/// Errors name the friction or the stop.
#[test]
fn errors_name_the_friction_or_the_stop() {
    let negative = Sliding { mu: -0.1, ..Sliding::default() };
    let named = Error::Negative { scene: "Sliding", quantity: "friction on x", value: -0.1 };
    assert_eq!(negative.check(), Err(named));
    assert_eq!(negative.start(0.0, &block(0.0), &1.0.into()), Err(named));
    let bouncing = |lower: f64, upper: f64, e: f64| Bouncing { lower, upper, e, ..Bouncing::default() };
    assert_eq!(
        bouncing(-1.0, 1.0, 1.5).check(),
        Err(Error::Restitution { scene: "Bouncing", stop: "stop on height", value: 1.5 })
    );
    let none = Error::NoRange { scene: "Bouncing", stop: "stop on height", lower: 1.0, upper: 1.0 };
    assert_eq!(bouncing(1.0, 1.0, 0.5).check(), Err(none));
    let nan = Error::NotFinite { mechanism: "Bouncing", quantity: "stop on height" };
    assert_eq!(bouncing(f64::NAN, 1.0, 0.5).check(), Err(nan));
    let beyond = Error::BeyondStop { scene: "Bouncing", stop: "stop on height", gap: 0.5 };
    let scene = bouncing(-1.0, 1.0, 0.5);
    assert_eq!(scene.start(0.0, &block(0.75), &0.0.into()), Err(beyond));
    assert_eq!(beyond.to_string(), "Bouncing begins beyond the stop on height: by 5.0e-1");
    // Rounding is no reason to refuse.
    assert!(scene.start(0.0, &block(0.5 + 1e-16), &0.0.into()).is_ok());
    let broken = Jointed { r2: f64::INFINITY, ..Jointed::default() };
    let guess = MachineCoordinates { phi: 0.8, psi: 2.9, z: 0.4 };
    let named = Error::NotFinite { mechanism: "Jointed", quantity: "friction on joint" };
    assert_eq!(broken.contacts(0.0, &guess, &guess).map(|_| ()), Err(named));
    // A law that turns negative on the way.
    let curved = Curved { brake1: -1.0, ..Curved::default() };
    assert!(
        matches!(curved.contacts(0.0, &pair(1.0, 1.0), &pair(0.0, 0.0)), Err(Error::Negative { value, .. }) if value < 0.0)
    );
    // A drive through a stop.
    let driven = Driven::default();
    let q = BeltCoordinates { slip: 0.0, x: 0.0, z: 0.0 };
    let start = driven.start(0.0, &q, &BeltInputs { x: 0.0, z: 0.5 }).unwrap();
    let (moving, y) = Moving::start(&driven, 0.0, &start).unwrap();
    let tolerance = Tolerance::new(1e-10, [1.0; 5]).unwrap();
    let mut motion = dop853(Wrapped(moving), (0.0, y), 9.0, tolerance).unwrap();
    let named = Error::NoContactForces { scene: "Driven", contact: "stop on z" };
    assert_eq!(motion.finish(|_, _| true), Err(named));
    close("there", motion.t(), 2.0, 1e-12);
    assert_eq!(named.to_string(), "no forces of frictions and stops agree with the motion of Driven: stop on z");
}

/// At rest at a dead centre a slider has no lever, and what its friction will do shows only when it moves: energy is the
/// work of the torque less that of the friction.
#[test]
fn a_start_at_a_dead_centre() {
    for (centre, t0) in [(0.0, 3.0), (0.0, -3.0), (std::f64::consts::PI, 3.0), (std::f64::consts::PI, -3.0)] {
        let scene = Guided { t0, ..Guided::default() };
        let guess = MachineCoordinates { phi: centre, psi: 3.1, z: 0.35 + 0.1 * f64::cos(centre) };
        let start = scene.start(0.0, &guess, &0.0.into()).unwrap();
        let end = run(&scene, start, 0.12);
        let (q, rates) = Guided::parts(&end.y);
        let kinetic = 0.5 * scene.mass_matrix(&q).unwrap()[0] * rates.phi * rates.phi;
        let turned = (q.phi - centre).abs();
        assert!(turned > 0.5 && turned < 3.0, "{turned}");
        close("energy", kinetic, 3.0 * turned - 8.0 * (guess.z - q.z).abs(), 1e-11);

        let scene = Scotch { torque: t0, ..Scotch::default() };
        let guess = YokeCoordinates { phi: centre, x: 0.1 * f64::cos(centre) };
        let end = run(&scene, scene.start(0.0, &guess, &0.0.into()).unwrap(), 0.12);
        let (q, rates) = Scotch::parts(&end.y);
        let kinetic = 0.5 * scene.mass_matrix(&q).unwrap()[0] * rates.phi * rates.phi;
        close("energy", kinetic, 3.0 * (q.phi - centre).abs() - 8.0 * (guess.x - q.x).abs(), 1e-11);
    }
}

/// Frictions, stops and a force that swings, for a long time: the energy is what was put in less what friction took.
#[test]
fn a_long_motion_keeps_its_accounts() {
    let scene =
        Shaken { brake1: 2.0, brake4: 1.5, upper1: 1.3, lower4: 0.7, e1: 1.0, torque: 6.0, ..Shaken::default() };
    let q = Pair::default().solve(&pair(1.0, 1.0)).unwrap().coordinates;
    let start = scene.start(0.0, &q, &PairInputs { theta1: 0.0, theta4: 0.0 }).unwrap();
    let (moving, y) = Moving::start(&scene, 0.0, &start).unwrap();
    let tolerance = Tolerance::new(1e-10, [1.0; 6]).unwrap();
    let mut motion = dop853(Wrapped(moving), (0.0, y), 30.0, tolerance).unwrap().largest_step(0.02).unwrap();
    let (mut work, mut last) = (0.0, 0.0);
    // By Gauss's rule of three points on each piece between events.
    while let Some(step) = motion.advance().unwrap() {
        let piece = motion.interpolant().unwrap();
        let half = 0.5 * (step.t - last);
        for (place, weight) in [(-0.6_f64.sqrt(), 5.0 / 9.0), (0.0, 8.0 / 9.0), (0.6_f64.sqrt(), 5.0 / 9.0)] {
            let t = last + half * (1.0 + place);
            let (q, rates) = Shaken::parts(&piece.at(t));
            let power = scene.power(t, &q, rates).unwrap();
            work += half * weight * (power.applied - power.dissipated);
        }
        last = step.t;
    }
    let moving = &motion.system().0;
    let (q, rates) = Shaken::parts(motion.state());
    let energy = scene.energy(&q, rates).unwrap();
    let seen = |mode: Mode| moving.history.iter().filter(|(_, _, after)| after.contains(&mode)).count();
    let often = [Mode::Stick, Mode::SlipForward, Mode::SlipBackward].map(seen);
    assert!(often.iter().all(|&often| often > 8) && moving.mended == 0, "{often:?} of {}", moving.history.len());
    close("energy", energy.kinetic, work, 1e-9);
}
