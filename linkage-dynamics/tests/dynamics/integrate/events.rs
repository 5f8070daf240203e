//! Events at known times.

use std::cell::RefCell;

use linkage_dynamics::MotionError;
use linkage_dynamics::integrate::{Action, Crossing, Step, System, dop853, dopri5, watched};
use linkage_runtime::nalgebra::vector;
use linkage_runtime::{Column, D};

use super::systems::{GRAVITY, HORIZONTAL, PERIOD, pendulum};
use super::{Entries, Rate, State, tolerance};

fn falling(_: f64, y: &State<2>) -> Rate<2> {
    Ok(vector![y[1], -GRAVITY])
}

fn ball(restitution: f64) -> impl System<Scalar = f64, Name = &'static str, N = D<2>> {
    watched(
        falling,
        [Crossing::Falling],
        |_, y: &State<2>| Ok([y[0]]),
        move |_, _, y: &State<2>| Ok(Action::Restart(vector![y[0], -restitution * y[1]])),
    )
}

fn events<const N: usize>(steps: impl Iterator<Item = Result<Step<f64, D<N>>, MotionError>>) -> Vec<Step<f64, D<N>>> {
    steps.map(Result::unwrap).filter(|step| step.event.is_some()).collect()
}

/// The impact times of a ball that falls from 1 m: fall + 2 fall (r + r^2 + ...).
fn impacts(restitution: f64) -> impl Iterator<Item = f64> {
    let fall = (2.0 / GRAVITY).sqrt();
    let mut flight = 2.0 * fall;
    std::iter::successors(Some(fall), move |t| {
        flight *= restitution;
        Some(t + flight)
    })
}

#[test]
fn a_bouncing_ball_hits_the_ground_when_the_law_says() {
    // Steps far longer than a flight, with larger rounding errors of dense output, and shorter ones.
    for (parts, largest, bound) in [(1, 100.0, 1e-12), (4, 100.0, 1e-12), (4, 0.05, 2e-14)] {
        let motion = dop853(ball(0.8), (0.0, vector![1.0, 0.0]), 3.5, tolerance(1e-9)).unwrap();
        let motion = motion.event_parts(parts).largest_step(largest).unwrap();
        let found = events(motion);
        let exact: Vec<f64> = impacts(0.8).take_while(|&t| t < 3.5).collect();
        assert_eq!((found.len(), exact.len()), (9, 9), "{parts} parts, steps of {largest}");
        for (step, t) in found.iter().zip(exact) {
            println!("{largest}: {:.1e} {:.1e}", step.t - t, step.state[0]);
            assert!((step.t - t).abs() < bound, "{:e} at {t}", step.t - t);
            assert!(step.state[0].abs() < 1e-14, "{:?}", step.state);
        }
    }
}

#[test]
fn a_ball_that_bounces_without_end_is_an_error() {
    // fall (1 + 2 (r + r^2 + ...)). At small r the rounding error of the place exceeds the height of the rebound.
    for (restitution, flights, bound) in [(0.5, 3.0, 1e-12), (1e-10, 1.0 + 2e-10, 1e-10)] {
        let mut motion = dop853(ball(restitution), (0.0, vector![1.0, 0.0]), 10.0, tolerance(1e-9)).unwrap();
        let error = motion.find_map(Result::err).unwrap();
        let rest = flights * (2.0 / GRAVITY).sqrt();
        let MotionError::EventsWithoutEnd { t, event: 0 } = error else { panic!("{error}") };
        assert!((t - rest).abs() < bound && (motion.t() - rest).abs() < bound, "{t}");
        assert!(motion.next().is_none());
    }
}

#[test]
fn a_pendulum_passes_its_lowest_place_each_half_period() {
    for (crossing, first, between) in
        [(Crossing::Either, 0.25, 0.5), (Crossing::Falling, 0.25, 1.0), (Crossing::Rising, 0.75, 1.0)]
    {
        let system = watched(pendulum, [crossing], |_, y: &State<2>| Ok([y[0].sin()]), |_, _, _| Ok(Action::Record));
        let mut motion = dop853(system, (0.0, HORIZONTAL), 20.0, tolerance(1e-13)).unwrap();
        let found = events(motion.by_ref());
        assert_eq!(found.len(), ((20.0 / PERIOD - first) / between) as usize + 1);
        for (n, step) in found.iter().enumerate() {
            let exact = PERIOD * (first + between * n as f64);
            assert!((step.t - exact).abs() < 2e-11, "{crossing:?} {n}: {:e}", step.t - exact);
        }
        // Recorded events do not change the motion.
        let mut alone = dop853(pendulum, (0.0, HORIZONTAL), 20.0, tolerance(1e-13)).unwrap();
        alone.finish(|_, _| true).unwrap();
        assert_eq!(alone.state(), motion.state());
        // Dense output is used only in steps with an event.
        let more = motion.counts().evaluations - alone.counts().evaluations;
        assert!(more <= 3 * found.len(), "{more} for {}", found.len());
    }
}

#[test]
fn events_of_one_step_come_in_their_order() {
    // y = t: the whole interval is one step or few.
    let times = RefCell::new(vec![]);
    let system = watched(
        |_, _: &State<1>| Ok(vector![1.0]),
        [Crossing::Rising, Crossing::Either, Crossing::Falling, Crossing::Either, Crossing::Rising],
        |_, y: &State<1>| Ok([y[0] - 7.0, y[0] - 0.125, 3.0 - y[0], y[0] - 3.0, 0.5 - y[0]]),
        |event, t, _| {
            times.borrow_mut().push((event, t));
            Ok(Action::Record)
        },
    );
    let mut motion = dopri5(system, (0.0, vector![0.0]), 8.0, tolerance(1e-6)).unwrap();
    let found: Vec<_> = events(motion.by_ref()).iter().map(|step| (step.event.unwrap(), step.t)).collect();
    assert_eq!(*times.borrow(), found);
    assert_eq!(found.iter().map(|f| f.0).collect::<Vec<_>>(), [1, 2, 3, 0]);
    for ((_, t), exact) in found.into_iter().zip([0.125, 3.0, 3.0, 7.0]) {
        assert!((t - exact).abs() <= 4.0 * f64::EPSILON * exact.max(1.0), "{t} and {exact}");
    }
    assert_eq!(motion.t(), 8.0);
}

#[test]
fn a_stop_ends_the_motion_and_its_outputs() {
    let system = watched(falling, [Crossing::Falling], |_, y: &State<2>| Ok([y[0]]), |_, _, _| Ok(Action::Stop));
    let mut motion = dop853(system, (0.0, vector![1.0, 0.0]), 10.0, tolerance(1e-9)).unwrap();
    let states: Vec<_> = motion.at([0.0, 0.2, 0.4, 0.6]).map(Result::unwrap).collect();
    assert_eq!(states.iter().map(|state| state.0).collect::<Vec<_>>(), [0.0, 0.2, 0.4]);
    assert!(states.iter().all(|(t, y)| (y[0] - (1.0 - 0.5 * GRAVITY * t * t)).abs() < 1e-14));
    assert!(motion.is_over() && motion.next().is_none());
    assert!((motion.t() - (2.0 / GRAVITY).sqrt()).abs() < 1e-15);
}

#[test]
fn what_starts_on_zero_has_no_event_there_and_one_at_the_end_counts() {
    let times = |start: f64, end: f64| {
        let record = |_: usize, _: f64, _: &State<1>| Ok(Action::Record);
        let rate = |_: f64, _: &State<1>| Ok(vector![1.0]);
        let values = |_: f64, y: &State<1>| Ok([y[0] * (y[0] - 1.0)]);
        let system = watched(rate, [Crossing::Either], values, record);
        let motion = dop853(system, (start, vector![start]), end, tolerance(1e-9)).unwrap();
        events(motion).iter().map(|step| step.t).collect::<Vec<_>>()
    };
    assert_eq!(times(0.0, 0.5), []);
    for (start, end, exact) in [(0.0, 1.0, 1.0), (0.0, 2.0, 1.0), (1.0, -1.0, 0.0)] {
        let found = times(start, end);
        assert!(found.len() == 1 && (found[0] - exact).abs() < 1e-14, "{start} to {end}: {found:?}");
    }
    // A function that stays zero has no event.
    let system = watched(falling, [Crossing::Either], |_, _: &State<2>| Ok([0.0]), |_, _, _| Ok(Action::Stop));
    assert_eq!(events(dop853(system, (0.0, vector![1.0, 0.0]), 1.0, tolerance(1e-9)).unwrap()), []);
}

/// A block pulled over a rough floor by a spring, whose other end moves at speed 1 from the unstretched state: mass 1,
/// stiffness 1, friction at most 2 at rest and 1 in motion. The state is position and speed of the block.
#[derive(Default)]
struct Block {
    slips: bool,
}

impl System for Block {
    type Scalar = f64;
    type Name = &'static str;
    type N = D<2>;
    type Events = D<2>;
    type Guards = D<0>;

    fn rate(&mut self, t: f64, y: &Entries<2>) -> Result<Entries<2>, MotionError> {
        Ok(if self.slips { [y[1], t - y[0] - 1.0] } else { [0.0, 0.0] }.into())
    }

    /// The block begins to slip; it comes to rest.
    fn events(&mut self, t: f64, y: &Entries<2>) -> Result<Entries<2>, MotionError> {
        Ok(if self.slips { [-1.0, y[1]] } else { [t - y[0] - 2.0, 1.0] }.into())
    }

    fn crossings(&self) -> Column<Crossing, D<2>> {
        [Crossing::Rising, Crossing::Falling].into()
    }

    fn at_event(&mut self, event: usize, _: f64, y: &Entries<2>) -> Result<Action<Entries<2>>, MotionError> {
        self.slips = event == 0;
        Ok(Action::Restart([y[0], 0.0].into()))
    }
}

#[test]
fn a_block_sticks_and_slips_when_the_law_says() {
    // With the stretch z = t - x: z'' = 1 - z from z = 2, z' = 1, so z = 1 + cos s + sin s and x' = 1 + sin s - cos s,
    // zero again at s = 3 pi/2, where z = 0. From there it sticks for 2.
    let slip = 1.5 * std::f64::consts::PI;
    let motion = dop853(Block::default(), (0.0, vector![0.0, 0.0]), 25.0, tolerance(1e-12)).unwrap();
    let found = events(motion);
    assert!(found.len() == 7, "{}", found.len());
    for (n, step) in found.iter().enumerate() {
        let cycles = (n / 2) as f64;
        let exact = 2.0 + cycles * (2.0 + slip) + if n % 2 == 0 { 0.0 } else { slip };
        assert_eq!(step.event, Some(n % 2));
        assert!((step.t - exact).abs() < 1e-10, "{n}: {:e}", step.t - exact);
        let place = exact - if n % 2 == 0 { 2.0 } else { 0.0 };
        assert!((step.state[0] - place).abs() < 1e-10, "{n}: {:?}", step.state);
    }
}

#[test]
fn backwards_events_are_found_as_well() {
    let system = watched(pendulum, [Crossing::Either], |_, y: &State<2>| Ok([y[0]]), |_, _, _| Ok(Action::Record));
    let found = events(dop853(system, (0.0, HORIZONTAL), -3.0, tolerance(1e-13)).unwrap());
    let times: Vec<f64> = found.iter().map(|step| step.t / PERIOD).collect();
    assert!(times.len() == 3, "{times:?}");
    assert!(times.iter().zip([-0.25, -0.75, -1.25]).all(|(t, exact)| (t - exact).abs() < 1e-11), "{times:?}");
}
