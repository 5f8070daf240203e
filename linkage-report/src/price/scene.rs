//! The price of accuracy of one scene: error, right-hand sides and time by tolerance.

use std::hint::black_box;

use linkage_double::DoubleDouble;
use linkage_dynamics::integrate::{Counts, Dop853};
use linkage_dynamics::simulation::Start;
use linkage_dynamics::{Coordinates, Inputs, MotionError, MotionErrorOf, Scene, StateColumn};
use linkage_runtime::derivation::SceneDerivation;
use linkage_runtime::{Column, InputError, Mechanism};

use super::PriceError;
use super::effects::{EffectPrice, effects};
use super::frontier::{Cost, cheapest, frontier};
use super::parts::{PartPrice, parts};
use super::prediction::Machine;
use super::runs::{Failed, Order, error, run, run_by, run_to_end, simulate_from};
use super::timing::{Time, Timed, in_turn};

/// The options of a [`ScenePrice`].
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ScenePriceOptions {
    /// The tolerances, by default 1e-3 to 1e-13.
    pub tolerances: Vec<f64>,
    /// The tolerance of the reference in double-double, by default 1e-17.
    pub reference: f64,
    /// The number of times at which the error is measured, in equal distances, by default 32.
    pub samples: usize,
    /// The number of rounds that are timed, by default 15.
    pub rounds: usize,
    /// The least seconds of a run in a round, by default 1e-4; shorter ones are repeated.
    pub span: f64,
    /// The errors for which the fastest run is named, by default 1e-4, 1e-6, 1e-8 and 1e-10.
    pub wanted: Vec<f64>,
}

impl Default for ScenePriceOptions {
    fn default() -> Self {
        Self {
            tolerances: (3..=13).map(|digits| 10_f64.powi(-digits)).collect(),
            reference: 1e-17,
            samples: 32,
            rounds: 15,
            span: 1e-4,
            wanted: vec![1e-4, 1e-6, 1e-8, 1e-10],
        }
    }
}

/// Errors, right-hand sides and times of one scene by tolerance, and what its parts and effects cost.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct ScenePrice {
    /// The scene.
    pub scene: String,
    /// The first and the last time.
    pub times: [f64; 2],
    /// The runs by order 8(5,3), then those by order 5(4), by falling tolerance.
    pub runs: Vec<RunPrice>,
    /// The tolerance of the reference.
    pub reference: f64,
    /// The largest difference of the reference from a run in double-double with ten times its tolerance: about ten times
    /// its error.
    pub reference_error: f64,
    /// The right-hand sides of the reference.
    pub reference_evaluations: usize,
    /// The functions that a step calls.
    pub parts: Vec<PartPrice>,
    /// The bodies and effects, by their formulas.
    pub effects: Vec<EffectPrice>,
    /// Scenes without some of its effects, as measured.
    pub without: Vec<WithoutPrice>,
    /// The errors for which the fastest run is named.
    pub wanted: Vec<f64>,
    /// True if the times are those of optimised code.
    pub is_optimised: bool,
    options: ScenePriceOptions,
}

/// A run by one method and tolerance.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct RunPrice {
    /// The method.
    pub order: Order,
    /// The tolerance.
    pub tolerance: f64,
    /// Its result, or why it has none.
    pub outcome: Result<RunOutcome, MotionError>,
}

/// The result of a run.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct RunOutcome {
    /// The largest error of a coordinate at the sampled times, in radians, of a length divided by that of its loop.
    pub error: f64,
    /// The error at the end alone, which may be small by chance.
    pub error_at_end: f64,
    /// Right-hand sides and steps.
    pub counts: Counts,
    /// The time of the run.
    pub time: Option<Time>,
}

/// A scene without some of its effects.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct WithoutPrice {
    /// The effects that it lacks.
    pub name: String,
    /// The time of `derivative` with the effects and without; the ratio of the second is to the first.
    pub derivative: [Option<Time>; 2],
    /// The time of a run with and without.
    pub run: [Option<Time>; 2],
    /// The right-hand sides of a run with and without.
    pub evaluations: [usize; 2],
}

/// The start of a scene in `f64`.
pub type StartOf<S> = Start<f64, Coordinates<S>, Inputs<S>>;

/// The tolerance of the runs that are compared with those of other scenes.
const TYPICAL: f64 = 1e-9;

impl ScenePrice {
    /// The price of a scene from its start to a time. `double_double` is `scene.clone().map(DoubleDouble::from)`,
    /// `derivation` the constant `DERIVATION` of the scene.
    ///
    /// # Errors
    /// [`PriceError::Input`] for an option that is invalid, [`PriceError::Start`] if the scene does not start,
    /// [`PriceError::EndsEarly`] if its motion ends before, and [`PriceError::FewDigitsOfScene`] if user functions compute
    /// in `f64`. A run that fails by its tolerance alone is no error.
    pub fn of<S, T>(
        scene: &S,
        double_double: &T,
        derivation: &SceneDerivation<'_>,
        start: Start<f64, Coordinates<S>, impl Into<Inputs<S>>>,
        end: f64,
        options: &ScenePriceOptions,
    ) -> Result<Self, PriceError>
    where
        S: Scene<Scalar = f64, Mechanism: Mechanism<Name = &'static str>>,
        T: Scene<
                Scalar = DoubleDouble,
                Mechanism: Mechanism<Name = &'static str>,
                U = S::U,
                V = S::V,
                State = S::State,
            >,
    {
        check::<S>(options, [start.t, end])?;
        let times: Vec<f64> = (1..=options.samples)
            .map(|place| {
                if place == options.samples {
                    end
                } else {
                    start.t + (end - start.t) * (place as f64 / options.samples as f64)
                }
            })
            .collect();
        let y = scene.state_of(&start.q, &start.input_rates.into());
        let ends_early = |Failed { t, error }| PriceError::EndsEarly { scene: S::NAME, t, end, error: Box::new(error) };
        simulate_from(scene, (start.t, &y), end, TYPICAL).map_err(|error| PriceError::Start(Box::new(error)))?;
        // In `f64` first: a motion that ends early is known sooner.
        let rough = run::<S, Dop853>(scene, (start.t, &y), &times, TYPICAL).map_err(ends_early)?;
        let twice = (DoubleDouble::from(start.t), y.map(DoubleDouble::from));
        let step = (end - start.t) / rough.counts.accepted.max(1) as f64;
        check_digits::<S, T>(double_double, &rough.states, &times, step)?;
        let exact_times: Vec<DoubleDouble> = times.iter().copied().map(DoubleDouble::from).collect();
        let exact = |tolerance: f64| {
            run::<T, Dop853>(double_double, (twice.0, &twice.1), &exact_times, tolerance).map_err(ends_early)
        };
        let (reference, looser) = (exact(options.reference)?, exact(10.0 * options.reference)?);
        let rounded: Vec<StateColumn<S>> = reference.states.iter().map(|state| state.map(DoubleDouble::high)).collect();
        let differences = reference.states.iter().zip(&looser.states).zip(&rounded);
        let differences = differences.map(|((one, other), at)| error(scene, &one.zip_map(other, |a, b| a - b), at));
        let reference_error = differences.fold(0.0, f64::max);
        let settings = [Order::Eight, Order::Five].into_iter();
        let settings = settings.flat_map(|order| options.tolerances.iter().map(move |tolerance| (order, *tolerance)));
        let mut runs: Vec<RunPrice> = settings
            .map(|(order, tolerance)| {
                let found = run_by(scene, (start.t, &y), &times, (order, tolerance));
                let outcome = found.map_err(|failed| failed.error).map(|run| {
                    let states = run.states.iter().zip(&reference.states).zip(&rounded);
                    let errors: Vec<f64> = states
                        .map(|((found, exact), at)| {
                            error(scene, &exact.zip_map(&found.map(DoubleDouble::from), |a, b| a - b), at)
                        })
                        .collect();
                    RunOutcome {
                        error: errors.iter().copied().fold(0.0, f64::max),
                        error_at_end: errors.last().copied().unwrap_or_default(),
                        counts: run.counts,
                        time: None,
                    }
                });
                RunPrice { order, tolerance, outcome }
            })
            .collect();
        let from = (start.t, &y);
        let passes: Vec<Box<dyn Fn()>> = runs
            .iter()
            .map(|run| {
                let setting = (run.order, run.tolerance);
                Box::new(move || {
                    // An error is a result, too.
                    let _ = black_box(run_to_end(scene, from, end, setting));
                }) as Box<dyn Fn()>
            })
            .collect();
        let works: Vec<&RunPrice> = runs.iter().collect();
        let timed = works.iter().zip(&passes).map(|(run, pass)| Timed {
            pass: &**pass,
            evaluations: usize::from(run.outcome.is_ok()),
            base: 0,
        });
        let timed = in_turn(&timed.collect::<Vec<_>>(), options.rounds, options.span);
        for (run, time) in runs.iter_mut().zip(timed) {
            if let Ok(outcome) = &mut run.outcome {
                outcome.time = time;
            }
        }
        Ok(Self {
            scene: S::NAME.to_owned(),
            times: [start.t, end],
            runs,
            reference: options.reference,
            reference_error,
            reference_evaluations: reference.counts.evaluations,
            parts: parts(scene, &times, &rough.states, (options.rounds, options.span)),
            effects: effects(derivation, &Machine::measured()),
            without: Vec::new(),
            wanted: options.wanted.clone(),
            is_optimised: !cfg!(debug_assertions),
            options: options.clone(),
        })
    }

    /// Adds the same scene without some of its effects, `other`: both are timed in turn, from their starts to the end.
    ///
    /// # Errors
    /// [`PriceError::EndsEarly`] if a motion ends before, [`PriceError::Start`] if it does not start.
    pub fn without<S, O>(
        &mut self,
        name: impl Into<String>,
        (scene, start): (&S, StartOf<S>),
        (other, other_start): (&O, StartOf<O>),
    ) -> Result<(), PriceError>
    where
        S: Scene<Scalar = f64, Mechanism: Mechanism<Name = &'static str>>,
        O: Scene<Scalar = f64, Mechanism: Mechanism<Name = &'static str>>,
    {
        let options = &self.options;
        let one = measured(scene, start, self.times[1], options.samples)?;
        let two = measured(other, other_start, self.times[1], options.samples)?;
        let works = [(&one.derivative, one.states), (&two.derivative, two.states), (&one.run, 1), (&two.run, 1)];
        let timed = works.iter().enumerate().map(|(place, (pass, evaluations))| Timed {
            pass: &***pass,
            evaluations: *evaluations,
            base: place / 2 * 2,
        });
        let times = in_turn(&timed.collect::<Vec<_>>(), options.rounds, options.span);
        let time = |place: usize| times.get(place).copied().flatten();
        self.without.push(WithoutPrice {
            name: name.into(),
            derivative: [time(0), time(1)],
            run: [time(2), time(3)],
            evaluations: [one.evaluations, two.evaluations],
        });
        Ok(())
    }

    /// The error and the time of each run; none for one that failed.
    #[must_use]
    pub fn costs(&self) -> Vec<Option<Cost>> {
        let cost = |run: &RunPrice| {
            let outcome = run.outcome.as_ref().ok()?;
            Some(Cost { error: outcome.error, time: outcome.time?.median })
        };
        self.runs.iter().map(cost).collect()
    }

    /// The runs that are clearly more accurate than every faster one.
    #[must_use]
    pub fn front(&self) -> Vec<usize> {
        frontier(&self.costs())
    }

    /// The fastest run with at most this error.
    #[must_use]
    pub fn fastest(&self, error: f64) -> Option<&RunPrice> {
        self.runs.get(cheapest(&self.costs(), error)?.0)
    }
}

/// A scene ready to be timed.
struct Measured<'a> {
    derivative: Box<dyn Fn() + 'a>,
    states: usize,
    run: Box<dyn Fn() + 'a>,
    evaluations: usize,
}

fn measured<S: Scene<Scalar = f64, Mechanism: Mechanism<Name = &'static str>>>(
    scene: &S,
    start: StartOf<S>,
    end: f64,
    samples: usize,
) -> Result<Measured<'_>, PriceError> {
    let y = scene.state_of(&start.q, &start.input_rates);
    let times: Vec<f64> =
        (1..=samples).map(|place| start.t + (end - start.t) * (place as f64 / samples as f64)).collect();
    simulate_from(scene, (start.t, &y), end, TYPICAL).map_err(|error| PriceError::Start(Box::new(error)))?;
    let found = run::<S, Dop853>(scene, (start.t, &y), &times, TYPICAL);
    let found = found.map_err(|Failed { t, error }| PriceError::EndsEarly {
        scene: S::NAME,
        t,
        end,
        error: Box::new(error),
    })?;
    let counts = run_to_end(scene, (start.t, &y), end, (Order::Eight, TYPICAL)).unwrap_or(found.counts);
    let states = found.states;
    Ok(Measured {
        states: states.len(),
        derivative: Box::new(move || {
            for (t, state) in times.iter().zip(&states) {
                let _ = black_box(scene.derivative(*t, black_box(state)));
            }
        }),
        run: Box::new(move || {
            let _ = black_box(run_to_end(scene, (start.t, &y), end, (Order::Eight, TYPICAL)));
        }),
        evaluations: counts.evaluations,
    })
}

fn check<S: Scene>(options: &ScenePriceOptions, [start, end]: [f64; 2]) -> Result<(), PriceError> {
    let invalid = |quantity, value, least, most| {
        PriceError::Input(InputError::OutOfRange { of: Some(S::NAME), quantity, value, least, most })
    };
    if options.samples == 0 {
        return Err(invalid("the number of samples", 0.0, 1.0, f64::INFINITY));
    }
    if options.rounds == 0 {
        return Err(invalid("the number of rounds", 0.0, 1.0, f64::INFINITY));
    }
    if !(options.span.is_finite() && options.span >= 0.0) {
        return Err(invalid("the span of a price", options.span, 0.0, f64::INFINITY));
    }
    // Ten times the tolerance of the reference must be well below what `f64` resolves.
    if !(options.reference > 0.0 && options.reference <= 1e-14) {
        return Err(invalid("the tolerance of the reference", options.reference, 0.0, 1e-14));
    }
    if !(start.is_finite() && end.is_finite() && start < end) {
        return Err(invalid("the end of a price", end, start, f64::INFINITY));
    }
    Ok(())
}

/// The parts of a step along the motion in which a difference is taken: below the resolution of `f64`, and far above it.
const TINY: f64 = 1.0 / (1_u128 << 70) as f64;
const SMALL: f64 = 1.0 / (1_u64 << 30) as f64;

/// Returns an error if the accelerations in double-double have fewer digits: their slopes over a tiny and over a small part
/// of a step differ at most of the states. At some they may, next to a kink.
fn check_digits<S, T>(twice: &T, states: &[StateColumn<S>], times: &[f64], step: f64) -> Result<(), PriceError>
where
    S: Scene<Scalar = f64>,
    T: Scene<Scalar = DoubleDouble, State = S::State>,
{
    let slopes = |t: f64, y: &StateColumn<S>| -> Result<bool, MotionErrorOf<T>> {
        let (t, y) = (DoubleDouble::from(t), y.map(DoubleDouble::from));
        let rate = twice.derivative(t, &y)?;
        let slope = |part: f64| -> Result<Column<f64, S::State>, MotionErrorOf<T>> {
            let h = DoubleDouble::from(step * part);
            let moved = twice.derivative(t + h, &(y + rate * h))?;
            Ok((moved - rate).map(|change| change.high() / part))
        };
        let (tiny, small) = (slope(TINY)?, slope(SMALL)?);
        let mut all = tiny.iter().zip(&small).zip(&rate);
        Ok(all.all(|((tiny, small), rate)| {
            (tiny - small).abs() <= 1e-3 * (tiny.abs() + small.abs()) + 1e-6 * rate.high().abs()
        }))
    };
    // A state without accelerations says nothing.
    let compared = times.iter().zip(states).filter_map(|(t, y)| slopes(*t, y).ok());
    let (agree, differ): (Vec<bool>, Vec<bool>) = compared.partition(|agree| *agree);
    if differ.len() > agree.len() { Err(PriceError::FewDigitsOfScene { scene: S::NAME }) } else { Ok(()) }
}
