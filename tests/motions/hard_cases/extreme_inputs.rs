//! Lengths and inputs of no real mechanism: infinite, NaN, zero, negative, at the ends of the range. A position is an
//! error, or every number of it is finite.
//!
//! `MECHANISM=four_bar cargo test --test motions extreme_inputs` tries one mechanism, by its file or its name.

use std::env;
use std::rc::Rc;
use std::sync::atomic::{AtomicUsize, Ordering};

use linkage::{Elbow, PositionError, Real};
use linkage_gallery::Fixture;
use linkage_gallery::checks::{at, each};
use linkage_gallery::distances::Distances;
use linkage_gallery::four_bar::{FourBar, FourBarBranch};
use linkage_gallery::listed::{Built, Listed, Moving, Posed, all, listed, posed};
use rand::rngs::SmallRng;
use rand::{Rng, SeedableRng};

const EXTREME: [f64; 13] = [
    f64::NAN,
    f64::INFINITY,
    f64::NEG_INFINITY,
    0.0,
    -0.0,
    f64::MAX,
    f64::MIN_POSITIVE,
    5e-324,
    1e-160,
    1e155,
    1e300,
    -1.0,
    -1e308,
];

/// A factor of rates, 2^-250: velocities are proportional to it and accelerations to its square, with the same digits.
const SLOWER: f64 = 5.527_147_875_260_445e-76;

/// Trials of each mechanism.
const TRIALS: usize = 1000;

/// Parameters and inputs of which some are extreme, with rates and accelerations of the inputs.
#[derive(Debug)]
struct Trial {
    parameters: Vec<f64>,
    inputs: Vec<f64>,
    rates: Vec<f64>,
    given: Vec<f64>,
}

impl Trial {
    fn of(of: &dyn Listed<f64>, random: &mut SmallRng) -> Self {
        let (mut parameters, count) = (of.defaults(), of.inputs().len());
        let mut inputs: Vec<f64> = (0..count).map(|_| random.random_range(-3.0..3.0)).collect();
        for _ in 0..random.random_range(1..=3) {
            let place = random.random_range(0..parameters.len() + count);
            // Or a number of any size.
            let bad = match EXTREME.get(random.random_range(0..2 * EXTREME.len())) {
                Some(&bad) => bad,
                None => random.random_range(-2.0..2.0) * 2_f64.powi(random.random_range(-540..540)),
            };
            match parameters.get_mut(place) {
                Some(parameter) => *parameter = bad,
                None => inputs[place - parameters.len()] = bad,
            }
        }
        let mut moving = || -> Vec<f64> {
            let any = |random: &mut SmallRng| match EXTREME.get(random.random_range(0..10 * EXTREME.len())) {
                Some(&bad) => bad,
                None => random.random_range(-2.0..2.0) * 2_f64.powi(random.random_range(-540..540) / 10),
            };
            (0..count).map(|_| any(random)).collect()
        };
        let (rates, given) = (moving(), moving());
        Self { parameters, inputs, rates, given }
    }

    /// True if an acceleration of a length may be near the largest number.
    fn overflows(&self) -> bool {
        let largest = |values: &[f64]| values.iter().fold(1.0, |most: f64, value| most.max(value.abs()));
        largest(&self.parameters) * largest(&self.rates).powi(2) * largest(&self.given) > f64::MAX / 1e9
    }

    /// Checks that `kinematics` and `full_kinematics` return what separate calls return, error for error.
    fn assert_same_kinematics(&self, m: &dyn Built<f64>, q: &[f64], branch: usize) {
        let Self { rates, given, .. } = self;
        let parts = m.moving_by_parts(q, branch, rates, given);
        for full in [false, true] {
            let fused = m.moving(q, branch, rates, given, full);
            match (&fused, &parts) {
                (Ok(fused), Ok(parts)) => {
                    let [ours, theirs] = [fused, parts].map(|moving| {
                        let numbers = [moving.pose.coordinates(), moving.rates.clone(), moving.accelerations.clone()];
                        assert!(numbers.iter().flatten().all(|number| number.is_finite()), "{numbers:?}");
                        numbers
                    });
                    assert_eq!(ours[0].len(), theirs[0].len());
                }
                // Products near the largest number overflow in one order and not in another.
                (Ok(_) | Err(PositionError::NotFinite { .. }), Err(_))
                | (Err(PositionError::NotFinite { .. }), Ok(_))
                    if self.overflows() => {}
                // The separate calls multiply by lengths before they divide by det J, `kinematics` by entries of J^-1.
                // At slower rates nothing overflows: then the separate calls have a result, and the one here is in
                // proportion.
                (Ok(fused), Err(PositionError::NotFinite { .. })) => {
                    let times =
                        |numbers: &[f64], by: f64| numbers.iter().map(|number| number * by).collect::<Vec<f64>>();
                    let (rates, given) = (times(rates, SLOWER), times(given, SLOWER * SLOWER));
                    let parts = m.moving_by_parts(q, branch, &rates, &given);
                    assert!(parts.is_ok(), "{:?}", parts.err());
                    let slower = m.moving(q, branch, &rates, &given, full);
                    let slower = slower.unwrap_or_else(|error| panic!("slower, {error}"));
                    assert_eq!(times(&fused.rates, SLOWER), slower.rates);
                    assert_eq!(times(&fused.accelerations, SLOWER * SLOWER), slower.accelerations);
                }
                (Err(error), Err(expected)) => assert_eq!(format!("{error:?}"), format!("{expected:?}")),
                (Err(PositionError::NotFinite { .. }), Ok(Moving { pose, rates, accelerations, .. })) if full => {
                    let separate = [
                        pose.points(),
                        pose.point_velocities(rates),
                        pose.point_accelerations(rates, accelerations),
                        pose.outputs(),
                        pose.output_rates(rates),
                        pose.output_accelerations(rates, accelerations),
                    ];
                    assert!(separate.iter().any(Result::is_err), "points and outputs are finite");
                }
                (fused, parts) => {
                    let [fused, parts] = [fused, parts].map(|moving| moving.as_ref().map(|all| &all.accelerations));
                    panic!("{fused:?}, by parts {parts:?}")
                }
            }
        }
    }
}

/// Checks that every number that follows from a position is finite.
fn assert_finite<T: Real>(pose: &dyn Posed<T>, context: impl FnOnce() -> String) {
    let numbers = [pose.coordinates(), pose.block_determinants(), pose.points().unwrap_or_default()];
    let is_finite = numbers.iter().flatten().all(|number| number.is_finite());
    assert!(is_finite && pose.is_finite(), "{}: {numbers:?}", context());
}

/// Assembles a mechanism on all its branches. Returns the numbers of positions and of errors.
fn assembles_or_says_why(of: &dyn Listed<f64>, trial: &Trial) -> [usize; 2] {
    let m = of.with_parameters(&trial.parameters);
    let q = of.coordinates(&vec![0.0; of.unknowns().len()], &trial.inputs);
    let mut found = [0; 2];
    for branch in 0..of.branch_count() {
        at(format_args!("branch {branch}"), || {
            trial.assert_same_kinematics(&*m, &q, branch);
            match m.assembled(&q, branch) {
                Ok(pose) => {
                    found[0] += 1;
                    assert_finite(&*pose, || "the position".to_owned());
                }
                Err(
                    PositionError::NotFinite { .. }
                    | PositionError::Unbuildable { .. }
                    | PositionError::Undetermined { .. },
                ) => found[1] += 1,
                Err(error) => panic!("{error}"),
            }
        });
    }
    found
}

#[test]
fn a_position_is_an_error_or_finite() {
    let random = &mut SmallRng::seed_from_u64(linkage_trials::seed(3));
    // For Newton's method on such numbers, see `tests/input/invalid_numbers`.
    let closed: Vec<_> = all().iter().copied().filter(|of| !of.branches().is_empty()).collect();
    let trials: Vec<Vec<Trial>> =
        closed.iter().map(|&of| (0..TRIALS).map(|_| Trial::of(of, random)).collect()).collect();
    let [positions, errors] = [const { AtomicUsize::new(0) }; 2];
    each(&closed, |of| {
        let place = closed.iter().position(|other| other.file() == of.file() && other.name() == of.name());
        for trial in &trials[place.expect("it is listed")] {
            let found = at(format_args!("{trial:?}"), || assembles_or_says_why(of, trial));
            positions.fetch_add(found[0], Ordering::Relaxed);
            errors.fetch_add(found[1], Ordering::Relaxed);
        }
    });
    let (positions, errors) = (positions.into_inner(), errors.into_inner());
    println!("{positions} positions, {errors} errors");
    let is_one = env::var("MECHANISM").is_ok();
    assert!(is_one || positions > 30_000 && errors > 150_000, "{positions} positions, {errors} errors");
}

/// Two groups without a position: the first one names the error, here a rod without end before a negative distance.
#[test]
fn the_first_group_without_a_position_names_the_error() {
    let of = listed("distances", "Distances");
    for rod in [f64::INFINITY, 1e300, f64::MAX] {
        let parameters = Distances { rod, stay: -1e308, post_y: 1e155, ..Distances::default() }.parameters();
        let trial = Trial { parameters, inputs: vec![2.406_767_070_011_212_3], rates: vec![1.0], given: vec![0.5] };
        let q = of.coordinates(&[0.0; 8], &trial.inputs);
        for branch in 0..of.branch_count() {
            trial.assert_same_kinematics(&*of.with_parameters(&trial.parameters), &q, branch);
        }
    }
}

/// Triangles of all shapes and sizes, in both precisions: numbers of a well-conditioned triangle are not checked at run
/// time.
#[test]
fn dyads_of_every_size() {
    let random = &mut SmallRng::seed_from_u64(linkage_trials::seed(5));
    let mut positions = 0;
    for _ in 0..200_000 {
        let most = [3, 30, 70, 300, 540][random.random_range(0..5)];
        let mut length = || random.random_range(1.0..2.0) * 2_f64.powi(random.random_range(-most..=most));
        let (ground, crank, p, gap) = (length(), length(), length(), length());
        // Nearly equal links, so that the line between their joints has any length.
        let m = FourBar::new(ground, crank, p, p + gap);
        let single = m.clone().map(|length| length as f32);
        for branch in [Elbow::Left, Elbow::Right].map(FourBarBranch::new) {
            let theta2 = random.random_range(-3.0..3.0);
            if let Ok(pose) = m.assemble(theta2, branch) {
                positions += 1;
                assert_finite(&*posed(&Rc::new(m.clone()), pose), || format!("{m:?} {theta2}"));
            }
            if let Ok(pose) = single.assemble(theta2 as f32, branch) {
                positions += 1;
                assert_finite(&*posed(&Rc::new(single.clone()), pose), || format!("{single:?} {theta2}"));
            }
        }
    }
    assert!(positions > 100_000, "{positions} positions");
}
