//! Lengths and inputs of no real mechanism: infinite, NaN, zero, negative, at the ends of the range. A position is an
//! error, or every number of it is finite.

use linkage::{Dim, Elbow, PerInput, PositionError};
use linkage_gallery::distances::Distances;
use linkage_gallery::four_bar::{FourBar, FourBarBranch};
use linkage_gallery::{ClosedForm, Fixture, Kinematics, Moving, all_mechanisms};
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

/// The counts of positions and of errors.
#[derive(Default)]
struct Found {
    positions: usize,
    errors: usize,
}

/// Checks that `kinematics` and `full_kinematics` return what separate calls return, error for error.
fn assert_same_kinematics<F: Fixture + std::fmt::Debug>(m: &F, q: &[f64], branch: usize, moving: [&[f64]; 2]) {
    let [rates, given] = moving;
    let parts = m.moving_by_parts(q, branch, rates, given);
    for full in [false, true] {
        let fused = m.moving(q, branch, rates, given, full);
        let at = || format!("{m:?} {q:?} {branch} {rates:?} {given:?}");
        match (&fused, &parts) {
            (Ok(fused), Ok(parts)) => {
                let [ours, theirs] = [fused, parts].map(|moving| {
                    let numbers = [F::listed(&moving.pose), moving.rates.clone(), moving.accelerations.clone()];
                    assert!(
                        numbers.iter().flatten().all(|number| number.is_finite()),
                        "{} {}: {numbers:?}",
                        F::NAME,
                        at()
                    );
                    numbers
                });
                assert_eq!(ours[0].len(), theirs[0].len());
            }
            // Products near the largest number overflow in one order and not in another.
            (Ok(_) | Err(PositionError::NotFinite { .. }), Err(_)) | (Err(PositionError::NotFinite { .. }), Ok(_))
                if overflows(m, moving) => {}
            // The separate calls multiply by lengths before they divide by det J, `kinematics` by entries of J^-1. At slower
            // rates nothing overflows: then the separate calls have a result, and the one here is in proportion.
            (Ok(fused), Err(PositionError::NotFinite { .. })) => {
                let times = |numbers: &[f64], by: f64| numbers.iter().map(|number| number * by).collect::<Vec<f64>>();
                let (rates, given) = (times(rates, SLOWER), times(given, SLOWER * SLOWER));
                let parts = m.moving_by_parts(q, branch, &rates, &given);
                assert!(parts.is_ok(), "{} {}: {:?}", F::NAME, at(), parts.err());
                let slower = m.moving(q, branch, &rates, &given, full);
                let slower = slower.unwrap_or_else(|error| panic!("{} {}: {error}", F::NAME, at()));
                assert_eq!(times(&fused.rates, SLOWER), slower.rates, "{} {}", F::NAME, at());
                let accelerations = times(&fused.accelerations, SLOWER * SLOWER);
                assert_eq!(accelerations, slower.accelerations, "{} {}", F::NAME, at());
            }
            (Err(error), Err(expected)) => {
                assert_eq!(format!("{error:?}"), format!("{expected:?}"), "{} {}", F::NAME, at());
            }
            (Err(PositionError::NotFinite { .. }), Ok(Moving { pose, rates, accelerations, .. })) if full => {
                let separate = [
                    m.points(pose),
                    m.point_velocities(pose, rates),
                    m.point_accelerations(pose, rates, accelerations),
                    m.outputs(pose),
                    m.output_velocities(pose, rates),
                    m.output_accelerations(pose, rates, accelerations),
                ];
                assert!(separate.iter().any(Result::is_err), "{} {}", F::NAME, at());
            }
            (fused, parts) => panic!(
                "{} {}: {:?}, by parts {:?}",
                F::NAME,
                at(),
                fused.as_ref().map(|moving| &moving.accelerations),
                parts.as_ref().map(|moving| &moving.accelerations)
            ),
        }
    }
}

/// True if an acceleration of a length may be near the largest number.
fn overflows<F: Fixture>(m: &F, [rates, given]: [&[f64]; 2]) -> bool {
    let largest = |values: &[f64]| values.iter().fold(1.0, |most: f64, value| most.max(value.abs()));
    largest(&m.parameters()) * largest(rates).powi(2) * largest(given) > f64::MAX / 1e9
}

/// Checks that every number that follows from a position is finite.
fn assert_finite<M: Kinematics<T>, T: linkage::Real + std::fmt::Debug>(
    m: &M,
    pose: &M::Pose,
    at: &impl std::fmt::Debug,
) {
    let numbers =
        [M::listed(pose), m.block_determinants(pose).iter().copied().collect(), m.points(pose).unwrap_or_default()];
    let is_finite = numbers.iter().flatten().all(|number| number.is_finite());
    assert!(is_finite && M::is_finite(pose), "{} {at:?}: {numbers:?}", M::NAME);
}

/// Assembles a mechanism of which some parameters and inputs are extreme.
fn assembles_or_says_why<M: ClosedForm<Scalar = f64> + Fixture + std::fmt::Debug>(
    random: &mut SmallRng,
    found: &mut Found,
) {
    let defaults = M::default().parameters();
    for _ in 0..TRIALS {
        let mut parameters = defaults.clone();
        let mut inputs = PerInput::<M>::from_fn(|_| random.random_range(-3.0..3.0));
        for _ in 0..random.random_range(1..=3) {
            let place = random.random_range(0..parameters.len() + M::V::COUNT);
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
        let m = M::with_parameters(&parameters);
        let mut moving = || -> Vec<f64> {
            let any = |random: &mut SmallRng| match EXTREME.get(random.random_range(0..10 * EXTREME.len())) {
                Some(&bad) => bad,
                None => random.random_range(-2.0..2.0) * 2_f64.powi(random.random_range(-540..540) / 10),
            };
            (0..M::V::COUNT).map(|_| any(random)).collect()
        };
        let (rates, given) = (moving(), moving());
        let mut q = vec![0.0; M::U::COUNT];
        q.extend(inputs.iter());
        for (place, branch) in M::all_branches().into_iter().enumerate() {
            assert_same_kinematics(&m, &q, place, [&rates, &given]);
            match m.assemble(inputs.into(), branch) {
                Ok(pose) => {
                    found.positions += 1;
                    assert_finite(&m, &pose, &(&parameters, &inputs));
                }
                Err(
                    PositionError::NotFinite { .. }
                    | PositionError::Unbuildable { .. }
                    | PositionError::Undetermined { .. },
                ) => {
                    found.errors += 1;
                }
                Err(error) => panic!("{parameters:?} {inputs:?}: {error}"),
            }
        }
    }
}

/// Two groups without a position: the first one names the error, here a rod without end before a negative distance.
#[test]
fn the_first_group_without_a_position_names_the_error() {
    let lengths = [f64::INFINITY, 1e300, f64::MAX];
    for rod in lengths {
        let m = Distances { rod, stay: -1e308, post_y: 1e155, ..Distances::default() };
        let q = [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 2.406_767_070_011_212_3];
        for branch in 0..Distances::<f64>::all_branches().len() {
            assert_same_kinematics(&m, &q, branch, [&[1.0], &[0.5]]);
        }
    }
}

/// Triangles of all shapes and sizes, in both precisions: numbers of a well-conditioned triangle are not checked at run
/// time.
#[test]
fn dyads_of_every_size() {
    let random = &mut SmallRng::seed_from_u64(5);
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
                assert_finite(&m, &pose, &(&m, theta2));
            }
            if let Ok(pose) = single.assemble(theta2 as f32, branch) {
                positions += 1;
                assert_finite(&single, &pose, &(&single, theta2));
            }
        }
    }
    assert!(positions > 100_000, "{positions} positions");
}

macro_rules! of_method {
    (closed $Mechanism:ty, $random:ident, $found:ident) => {
        assembles_or_says_why::<$Mechanism>($random, $found);
    };
    (open $Mechanism:ty, $random:ident, $found:ident) => {
        assembles_or_says_why::<$Mechanism>($random, $found);
    };
    // For Newton's method on such numbers, see `tests/input/invalid_numbers`.
    (newton $Mechanism:ty, $random:ident, $found:ident) => {};
}

macro_rules! all {
    ($($file:ident: $($Mechanism:ident $method:ident)+ $(, $orders:ident)?;)*) => {
        fn all(random: &mut SmallRng, found: &mut Found) {
            $($(of_method!($method linkage_gallery::$file::$Mechanism, random, found);)+)*
        }
    };
}

all_mechanisms!(all);

#[test]
fn a_position_is_an_error_or_finite() {
    let (random, mut found) = (&mut SmallRng::seed_from_u64(3), Found::default());
    all(random, &mut found);
    let Found { positions, errors } = found;
    println!("{positions} positions, {errors} errors");
    assert!(positions > 30_000 && errors > 150_000, "{positions} positions, {errors} errors");
}
