//! Failing integrations, and the results before the failure.

use std::cell::Cell;

use linkage_dynamics::MotionError;
use linkage_dynamics::integrate::{Action, Crossing, FixedStep, System, Tolerance, dop853, dopri5, watched};
use linkage_runtime::nalgebra::vector;
use linkage_runtime::{Column, D, InputError, InputValues, PositionError};

use super::systems::{HORIZONTAL, pendulum};
use super::{Entries, Rate, State, tolerance};

#[test]
fn tolerances_that_cannot_be_met_are_refused() {
    for relative in [0.0, -1e-9, 2e-15, 1.5, f64::NAN, f64::INFINITY] {
        let error = Tolerance::<f64, D<1>>::new(relative, [1.0]).unwrap_err();
        assert!(matches!(error, InputError::OutOfRange { quantity: "the relative tolerance", .. }), "{error}");
    }
    assert!(Tolerance::<f64, D<1>>::new(2.5e-15, [1.0]).is_ok());
    assert!(Tolerance::<f32, D<1>>::new(1e-7, [1.0]).is_err());
    for scale in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(Tolerance::<f64, D<2>>::new(1e-9, [1.0, scale]).is_err(), "{scale}");
    }
    let text = Tolerance::<f64, D<1>>::new(0.0, [1.0]).unwrap_err().to_string();
    assert_eq!(text, "the relative tolerance is 0.0: it must be between 2.220446049250313e-15 and 1.0");
}

#[test]
fn settings_that_make_no_sense_are_refused() {
    let new = |start: f64, y: State<2>, end: f64| dop853(pendulum, (start, y), end, tolerance(1e-9));
    for (start, end) in [(f64::NAN, 1.0), (0.0, f64::INFINITY)] {
        assert!(matches!(new(start, HORIZONTAL, end), Err(MotionError::Input(InputError::OutOfRange { .. }))));
    }
    assert!(matches!(new(0.0, vector![0.0, f64::NAN], 1.0), Err(MotionError::NotFinite { .. })));
    for length in [0.0, -1.0, f64::NAN] {
        assert!(new(0.0, HORIZONTAL, 1.0).unwrap().first_step(length).is_err());
        assert!(new(0.0, HORIZONTAL, 1.0).unwrap().largest_step(length).is_err());
    }
    assert!(FixedStep::new(pendulum, (0.0, HORIZONTAL), 0.0).is_err());
}

#[test]
fn an_empty_interval_has_its_state_and_no_steps() {
    let asked = Cell::new(0);
    let rate = |t: f64, y: &State<2>| {
        asked.set(asked.get() + 1);
        pendulum(t, y)
    };
    let mut motion = dop853(rate, (3.0, HORIZONTAL), 3.0, tolerance(1e-9)).unwrap();
    assert_eq!(motion.at([3.0, 3.0]).map(Result::unwrap).collect::<Vec<_>>(), [(3.0, HORIZONTAL.into()); 2]);
    assert!(motion.is_over() && motion.next().is_none());
    assert_eq!((asked.get(), motion.progress()), (0, 1.0));
}

#[test]
fn output_times_must_lie_ahead() {
    for times in [[0.5, -0.1, 0.6], [0.5, 1.5, 0.6], [0.9, 0.0, 0.95], [0.5, f64::NAN, 0.6]] {
        let mut motion = dop853(pendulum, (0.0, HORIZONTAL), 1.0, tolerance(1e-9)).unwrap().largest_step(0.2).unwrap();
        let found: Vec<_> = motion.at(times).collect();
        assert_eq!(found.len(), 2, "nothing follows an error");
        assert!(
            found[0].is_ok() && matches!(found[1], Err(MotionError::Input(InputError::OutOfRange { .. }))),
            "{found:?}"
        );
    }
}

/// y' = 1 / sqrt(1 - t), which ends at t = 1 with y = 2; beyond it the rate is NaN or an error.
#[test]
fn a_motion_that_ends_is_followed_to_its_end() {
    let own = MotionError::from(PositionError::Unbuildable {
        mechanism: "Crank",
        group: "theta",
        gap: 0.1,
        inputs: InputValues::default(),
    });
    for (fails, expected) in [(false, None), (true, Some(own))] {
        let rate = move |t: f64, _: &State<1>| match expected {
            Some(error) if t > 1.0 => Err(error),
            _ => Ok(vector![1.0 / (1.0 - t).sqrt()]),
        };
        for end in [2.0, 100.0] {
            let mut motion = dop853(rate, (0.0, vector![0.0]), end, tolerance(1e-9)).unwrap();
            let mut states: Vec<_> = motion.at([0.25, 0.75, 1.5, 1.6]).collect();
            let error = states.pop().unwrap().unwrap_err();
            // The square root itself ends with steps that are too small.
            assert!(
                expected == Some(error)
                    || matches!(error, MotionError::NotFinite { .. } | MotionError::StepTooSmall { .. }),
                "{fails}: {error}"
            );
            for (state, exact) in states.into_iter().zip([1.0 - 0.75f64.sqrt(), 1.0 - 0.25f64.sqrt()]) {
                assert!((state.unwrap().1[0] - 2.0 * exact).abs() < 1e-8);
            }
            assert!((motion.t() - 1.0).abs() < 1e-9, "{:e}", motion.t() - 1.0);
            assert!(motion.is_over());
        }
    }
}

#[test]
fn the_own_error_of_a_rate_comes_back_at_its_place() {
    let own = MotionError::from(PositionError::Unbuildable {
        mechanism: "Crank",
        group: "theta",
        gap: 0.1,
        inputs: InputValues::default(),
    });
    for wrong in [Err(own), Ok(vector![f64::NAN, 0.0]), Ok(vector![0.0, f64::INFINITY])] {
        let rate = move |t: f64, y: &State<2>| if t > 1.0 { wrong } else { pendulum(t, y) };
        let fails = |error: MotionError| {
            wrong.map_or_else(|own| error == own, |_| matches!(error, MotionError::NotFinite { .. }))
        };
        let mut motion = dopri5(rate, (0.0, HORIZONTAL), 3.0, tolerance(1e-9)).unwrap();
        let error = motion.find_map(Result::err).unwrap();
        assert!(fails(error), "{error}");
        assert!(motion.t() <= 1.0 && motion.t() > 1.0 - 1e-14, "{:e}", motion.t() - 1.0);
        assert!(motion.counts().evaluations < 2000, "{:?}", motion.counts());
        // The failed step has no dense output.
        assert_eq!(motion.interpolant().unwrap().interval(), (motion.t(), motion.t()));

        // An error at the first call.
        let start = (2.0, HORIZONTAL);
        let mut motion = dop853(rate, start, 3.0, tolerance(1e-9)).unwrap();
        assert!(fails(motion.next().unwrap().unwrap_err()) && motion.next().is_none());
        assert_eq!((motion.t(), State::from(*motion.state())), start);

        let mut motion = FixedStep::new(rate, (0.0, HORIZONTAL), 0.3).unwrap();
        (0..3).for_each(|_| motion.step().unwrap());
        let before = *motion.state();
        assert!(fails(motion.step().unwrap_err()));
        assert_eq!(*motion.state(), before);
    }
}

#[test]
fn a_pole_needs_steps_too_small() {
    // y' = y^2 from 1: y = 1 / (1 - t).
    let rate = |_: f64, y: &State<1>| Ok(vector![y[0] * y[0]]);
    for relative in [1e-6, 1e-12] {
        let mut motion = dop853(rate, (0.0, vector![1.0]), 2.0, tolerance(relative)).unwrap();
        let error = motion.find_map(Result::err).unwrap();
        let MotionError::StepTooSmall { t, step } = error else { panic!("{error}") };
        assert!((t - 1.0).abs() < 1e-4 && step > 0.0 && step < 1e-14, "{t} {step}");
    }
}

#[test]
fn steps_have_an_end() {
    let mut motion = dop853(pendulum, (0.0, HORIZONTAL), 1e6, tolerance(1e-9)).unwrap().most_steps(50);
    let steps = motion.by_ref().take_while(Result::is_ok).count();
    let counts = motion.counts();
    assert_eq!((counts.accepted, counts.accepted + counts.rejected), (steps, 50));
    assert!(motion.t() > 1.0);
    let error = dop853(pendulum, (0.0, HORIZONTAL), 1e6, tolerance(1e-9)).unwrap().most_steps(50).find_map(Result::err);
    assert!(matches!(error, Some(MotionError::TooManySteps { steps: 50, .. })));
}

#[test]
fn an_event_function_that_is_not_a_number_ends_the_motion() {
    let values = |t: f64, _: &State<2>| Ok([(1.0 - t).sqrt() + 1.0]);
    let system = watched(pendulum, [Crossing::Either], values, |_, _, _| Ok(Action::Stop));
    let error = dop853(system, (0.0, HORIZONTAL), 3.0, tolerance(1e-9)).unwrap().find_map(Result::err).unwrap();
    assert!(matches!(error, MotionError::NotFinite { quantity: "an event function", .. }), "{error}");
}

/// A pendulum of 1 m by an angle from a direction that changes in quarter turns: coordinates with a singularity
/// elsewhere.
#[derive(Default)]
struct Quarters {
    quarter: f64,
    switches: usize,
}

const QUARTER: f64 = std::f64::consts::FRAC_PI_2;

impl System for Quarters {
    type Scalar = f64;
    type Name = &'static str;
    type N = D<2>;
    type Events = D<0>;
    type Guards = D<0>;

    fn rate(&mut self, t: f64, y: &Entries<2>) -> Result<Entries<2>, MotionError> {
        pendulum(t, &vector![y[0] + self.quarter * QUARTER, y[1]]).map(Column::from)
    }

    fn events(&mut self, _: f64, _: &Entries<2>) -> Result<Entries<0>, MotionError> {
        Ok([].into())
    }

    fn before_step(&mut self, _: f64, y: &Entries<2>) -> Result<Option<Entries<2>>, MotionError> {
        let turned = (y[0] / QUARTER).round();
        if turned == 0.0 {
            return Ok(None);
        }
        self.quarter += turned;
        self.switches += 1;
        Ok(Some([y[0] - turned * QUARTER, y[1]].into()))
    }
}

#[test]
fn coordinates_may_be_switched_between_steps() {
    // It goes over the top.
    let start = vector![0.0, 7.0];
    let mut plain = dop853(pendulum, (0.0, start), 5.0, tolerance(1e-11)).unwrap();
    let mut switched = dop853(Quarters::default(), (0.0, start), 5.0, tolerance(1e-11)).unwrap();
    // Outputs within a step are in the coordinates of that step.
    let times: Vec<f64> = (1..=500).map(|i| 0.01 * f64::from(i)).collect();
    for &t in &times {
        let (_, y) = switched.at([t]).next().unwrap().unwrap();
        let angle = y[0] + switched.system().quarter * QUARTER;
        let (_, exact) = plain.at([t]).next().unwrap().unwrap();
        assert!((angle - exact[0]).abs() < 1e-8, "{t}: {:e}", angle - exact[0]);
    }
    assert!(switched.system().switches > 8, "{}", switched.system().switches);
    // One evaluation for each switch, and about as many steps.
    let (plain, switched) = (plain.counts(), switched.counts());
    assert!(switched.accepted.abs_diff(plain.accepted) <= plain.accepted / 5, "{plain:?} {switched:?}");
}

/// y' = y with the state z = y / 4^n, where n grows by one when z passes 2: the state and the rate change.
#[derive(Default)]
struct Rescaled(i32);

impl System for Rescaled {
    type Scalar = f64;
    type Name = &'static str;
    type N = D<1>;
    type Events = D<0>;
    type Guards = D<0>;

    fn rate(&mut self, _: f64, z: &Entries<1>) -> Result<Entries<1>, MotionError> {
        Ok(*z)
    }

    fn events(&mut self, _: f64, _: &Entries<1>) -> Result<Entries<0>, MotionError> {
        Ok([].into())
    }

    fn before_step(&mut self, _: f64, z: &Entries<1>) -> Result<Option<Entries<1>>, MotionError> {
        if z[0] > 2.0 {
            self.0 += 1;
            return Ok(Some(*z / 4.0));
        }
        Ok(None)
    }
}

#[test]
fn a_new_state_has_a_new_rate() {
    let mut motion = dop853(Rescaled::default(), (0.0, vector![1.0]), 30.0, tolerance(1e-12)).unwrap();
    motion.finish(|_, _| true).unwrap();
    let y = motion.state()[0] * 4f64.powi(motion.system().0);
    assert!((y / 30f64.exp() - 1.0).abs() < 1e-10 && motion.system().0 > 10, "{:e}", y / 30f64.exp() - 1.0);
    let mut motion = FixedStep::new(Rescaled::default(), (0.0, vector![1.0]), 1e-3).unwrap();
    (0..10_000).for_each(|_| motion.step().unwrap());
    let y = motion.state()[0] * 4f64.powi(motion.system().0);
    assert!((y / 10f64.exp() - 1.0).abs() < 1e-11 && motion.system().0 > 5, "{:e}", y / 10f64.exp() - 1.0);
}

/// On the unit circle the radius is 1 to the tolerance at the ends of steps; the polynomial of a long step is farther
/// off between them, where this event function has no value.
#[test]
fn an_event_function_without_value_within_a_long_step_shortens_it() {
    let undefined = MotionError::NotFinite { quantity: "the event", t: 0.0 };
    let turning = |_: f64, y: &State<2>| -> Rate<2> { Ok(vector![-y[1], y[0]]) };
    let event = move |_: f64, y: &State<2>| if (y.norm() - 1.0).abs() < 1e-4 { Ok([y[1]]) } else { Err(undefined) };
    let system = watched(turning, [Crossing::Either], event, |_, _, _: &State<2>| Ok(Action::Record));
    let mut motion = dop853(system, (0.0, vector![1.0, 0.0]), 20.0, tolerance(1e-5)).unwrap();
    let mut found = Vec::new();
    while let Some(step) = motion.advance().unwrap() {
        found.extend(step.event.map(|_| step.t / std::f64::consts::PI));
    }
    println!("{found:?} {:?}", motion.counts());
    assert_eq!(found.len(), 6);
    assert!(found.iter().zip(1..).all(|(turns, expected)| (turns - f64::from(expected)).abs() < 1e-3));

    // One that is undefined from a time on ends the motion before it.
    let event = move |t: f64, y: &State<2>| if t < 5.0 { Ok([y[1]]) } else { Err(undefined) };
    let system = watched(turning, [Crossing::Either], event, |_, _, _: &State<2>| Ok(Action::Record));
    let mut motion = dop853(system, (0.0, vector![1.0, 0.0]), 20.0, tolerance(1e-5)).unwrap();
    assert_eq!(motion.finish(|_, _| true).unwrap_err(), undefined);
    assert!(motion.t() < 5.0 && motion.t() > 4.0, "{}", motion.t());
}

/// y' = 1, uncertain by a share of it up to t = 1/2.
struct Uncertain {
    share: f64,
    largest: Option<f64>,
}

impl System for Uncertain {
    type Scalar = f64;
    type Name = &'static str;
    type N = D<1>;
    type Events = D<0>;
    type Guards = D<0>;

    fn rate(&mut self, t: f64, _: &Entries<1>) -> Result<Entries<1>, MotionError> {
        if t < 0.5 {
            self.largest = Some(self.share);
        }
        Ok([1.0].into())
    }

    fn events(&mut self, _: f64, _: &Entries<1>) -> Result<Entries<0>, MotionError> {
        Ok([].into())
    }

    fn uncertainty(&mut self) -> Option<Entries<1>> {
        self.largest.take().map(|error| [error].into())
    }
}

/// The error that a system estimates is part of that of each step: its length times the error is at most the tolerance.
#[test]
fn the_uncertainty_of_a_rate_shortens_steps() {
    let lengths = |share: f64| {
        let system = Uncertain { share, largest: None };
        let mut motion = dop853(system, (0.0, vector![0.0]), 1.0, tolerance(1e-6)).unwrap();
        let (mut before, mut within, mut after) = (0.0, 0.0_f64, 0.0_f64);
        motion
            .finish(|step, _| {
                let length = step.t - before;
                let longest = if before < 0.5 { &mut within } else { &mut after };
                *longest = longest.max(length);
                before = step.t;
                true
            })
            .unwrap();
        (within, after)
    };
    let (within, after) = lengths(1e-4);
    println!("{within:e} {after:e}");
    // At most 1e-6 (1 + |y|) / 1e-4.
    assert!(within < 0.015 && within > 0.002 && after > 0.1, "{within} {after}");
    assert!(lengths(0.0).0 > 0.1);
}
