//! Position methods selected by type: the error of each against 45 digits, its branch and its errors; by type they give
//! the bits of the direct call. And the choice of the cheapest methods, from invented prices.

use std::borrow::Borrow;
use std::f64::consts::{PI, TAU};

use linkage::accuracy::{ClosedForm, Newton, PositionMethod, Reached, Table};
use linkage::nalgebra::SVector;
use linkage::price::{Cost, cheapest, frontier};
use linkage::{Build, D, Dim, InputError, Kinematic, Mechanism, PerInput, PositionError, Real};
use linkage_double::DoubleDouble;

use linkage_examples::accuracy_cost::dominance::dominated;
use linkage_examples::accuracy_cost::oracle::{Case, poses_of};

use linkage_gallery::double_butterfly::*;
use linkage_gallery::four_bar::*;
use linkage_gallery::geared_five_bar::*;
use linkage_gallery::jansen::*;
use linkage_gallery::{Fixture, named};

/// A mechanism of the gallery in another scalar.
type In<F, T> = <F as Fixture>::In<T>;

/// A position of a mechanism in another scalar.
type ReachedIn<F, T> = Reached<<In<F, T> as Mechanism>::Coordinates, <In<F, T> as Mechanism>::Pose>;

fn scalar<T: Real>(value: f64) -> T {
    linkage::nalgebra::convert(value)
}

fn inputs<M: Mechanism>(input: f64) -> PerInput<M> {
    M::V::least().column(|_| scalar(input))
}

fn mechanism<F: Fixture, T: Real>(case: &Case) -> In<F, T> {
    let parameters: Vec<T> = case.parameters.iter().copied().map(scalar).collect();
    In::<F, T>::with_parameters(&parameters)
}

fn coordinates<M: Mechanism>(unknowns: &[f64], input: f64) -> M::Coordinates {
    M::coordinates(M::U::least().column(|index| scalar(unknowns[index])), inputs::<M>(input))
}

fn near<F: Fixture, T: Real>(case: &Case) -> ReachedIn<F, T> {
    Reached::at(&mechanism::<F, T>(case), coordinates::<In<F, T>>(&case.before.1, case.before.0))
}

/// The poses of a mechanism of this kind.
fn cases<F: Fixture>(pose: &str, angles_given: bool) -> Vec<Case> {
    let poses = poses_of(F::FILE).into_iter().filter(|poses| poses.pose == pose && poses.angles_given == angles_given);
    let cases: Vec<Case> = poses.flat_map(|poses| poses.cases).collect();
    assert!(!cases.is_empty(), "no poses of {}: {pose}", F::FILE);
    cases
}

/// The largest errors of u, u' and u'' over the poses of this kind.
fn errors<F: Fixture, T: Real, R: PositionMethod<In<F, T>>>(
    pose: &str,
    start: impl Fn(&Case) -> R::From,
) -> Result<[f64; 3], PositionError> {
    let mut largest = [0.0_f64; 3];
    for case in cases::<F>(pose, false) {
        let m = mechanism::<F, T>(&case);
        let position = R::position(&m, &start(&case), inputs::<In<F, T>>(case.input))?;
        let pose = position.borrow();
        let unknowns = In::<F, T>::unknowns(&In::<F, T>::coordinates_of(pose));
        let [velocity, acceleration] = rate_errors(&case, &m, pose)?;
        for (largest, error) in largest.iter_mut().zip([case.error(0, unknowns.as_slice()), velocity, acceleration]) {
            *largest = largest.max(error);
        }
    }
    Ok(largest)
}

/// The largest errors of u, u' and u'' that are found at once at v' = 1, v'' = 0.
fn errors_at_once<F: Fixture, T: Real, const N: usize>(
    pose: &str,
    kinematics: impl Fn(&In<F, T>, &Case) -> Result<[SVector<T, N>; 3], PositionError>,
) -> Result<[f64; 3], PositionError> {
    let mut largest = [0.0_f64; 3];
    for case in cases::<F>(pose, false) {
        let found = kinematics(&mechanism::<F, T>(&case), &case)?;
        for (order, (largest, found)) in largest.iter_mut().zip(&found).enumerate() {
            let unknowns = In::<F, T>::unknowns(&named::<In<F, T>, _>(found.as_slice()));
            *largest = largest.max(case.error(order, unknowns.as_slice()));
        }
    }
    Ok(largest)
}

/// The largest errors of u' and u'' where the angles are given.
fn errors_at_angles<F: Fixture, T: Real>(pose: &str) -> Result<[f64; 2], PositionError> {
    let mut largest = [0.0_f64; 2];
    for case in cases::<F>(pose, true) {
        let m = mechanism::<F, T>(&case);
        let pose = m.pose_at(&coordinates::<In<F, T>>(&case.unknowns, case.input));
        let [velocity, acceleration] = rate_errors(&case, &m, &pose)?;
        largest = [largest[0].max(velocity), largest[1].max(acceleration)];
    }
    Ok(largest)
}

/// The errors of u' and u'' at v' = 1, v'' = 0.
fn rate_errors<M: Kinematic>(case: &Case, m: &M, pose: &M::Pose) -> Result<[f64; 2], PositionError<M::Name>> {
    let rates = m.velocity(pose, inputs::<M>(1.0).into())?;
    let accelerations = m.acceleration(pose, &rates, inputs::<M>(0.0).into())?;
    let (velocity, acceleration) = (M::rate_parts(&rates).0, M::acceleration_parts(&accelerations).0);
    Ok([case.error(1, velocity.as_slice()), case.error(2, acceleration.as_slice())])
}

/// A table of a full turn, and its errors at benign poses.
fn table<F: Fixture<Scalar = f64, V = D<1>, In<f64> = F>, const N: usize>() -> (Table<F, N>, [f64; 3]) {
    let poses = poses_of(F::FILE);
    let first = &poses[0].cases[0];
    let start = coordinates::<F>(&first.before.1, first.before.0);
    let table = Table::<F, N>::turn(&mechanism::<F, f64>(first), &start).unwrap();
    (table, errors::<F, f64, Table<F, N>>("benign", |_| table).unwrap())
}

/// Compares the errors of position, velocity and acceleration with their bounds.
#[track_caller]
fn within<const N: usize>(found: [f64; N], bounds: [f64; N]) {
    println!("{found:?}");
    for (found, bound) in found.into_iter().zip(bounds) {
        assert!(found <= bound, "{found:e} is more than {bound:e}");
        // A bound that is far too large says nothing.
        assert!(found >= 0.05 * bound, "{found:e} is far less than {bound:e}");
    }
}

fn branch<T: Real>(case: &Case) -> FourBarBranch {
    Mechanism::branch_of(&mechanism::<FourBar, T>(case), &near::<FourBar, T>(case).pose)
}

fn leg<T: Real>(case: &Case) -> JansenBranch {
    Mechanism::branch_of(&mechanism::<Jansen, T>(case), &near::<Jansen, T>(case).pose)
}

/// l1^2 + l2^2 - 2 l1 l2 cos theta2 is (l3 - l4)^2 or (l3 + l4)^2 where coupler and rocker are in line.
#[test]
fn dead_points_of_a_range() {
    let poses = poses_of("four_bar").into_iter().find(|poses| poses.pose == "range").unwrap();
    let [l1, l2, l3, l4] = poses.cases[0].parameters[..] else { panic!("four lengths") };
    for (dead, distance) in poses.dead.iter().zip([l3 - l4, l3 + l4]) {
        let cosine: f64 = (l1 * l1 + l2 * l2 - distance * distance) / (2.0 * l1 * l2);
        assert!((dead - cosine.acos()).abs() < 1e-15, "{dead}");
    }
    assert!(poses.cases.iter().all(|case| poses.dead[0] < case.input && case.input < poses.dead[1]));
}

#[test]
fn closed_form_at_benign_poses() {
    within(errors::<FourBar, f32, ClosedForm>("benign", branch::<f32>).unwrap(), [4e-7, 2e-6, 1e-6]);
    within(errors::<FourBar, f64, ClosedForm>("benign", branch::<f64>).unwrap(), [1e-15, 1e-15, 1e-15]);
    within(errors::<FourBar, DoubleDouble, ClosedForm>("benign", branch::<f64>).unwrap(), [1e-31, 1e-31, 1e-31]);
    within(errors::<Jansen, f64, ClosedForm>("benign", leg::<f64>).unwrap(), [4e-15, 8e-15, 1e-14]);
    within(errors::<Jansen, DoubleDouble, ClosedForm>("benign", leg::<f64>).unwrap(), [2e-31, 4e-31, 1e-30]);
}

/// Near a dead point the angles are off by the rounding error of the input divided by the sine, by any method in
/// doubles.
#[test]
fn closed_form_near_a_dead_point() {
    let four_bar = |sine: &str| errors::<FourBar, f64, ClosedForm>(sine, branch::<f64>);
    within(four_bar("1e-3").unwrap(), [2e-13, 2e-10, 3e-7]);
    assert!(matches!(four_bar("1e-9"), Err(PositionError::Singular { group: "theta3, theta4", .. })));
    let exact = |sine: &str| errors::<FourBar, DoubleDouble, ClosedForm>(sine, branch::<f64>).unwrap();
    within(exact("1e-3"), [2e-29, 2e-26, 3e-23]);
    // The rounding error of the squares divided by the cube of the sine: 3.2e-15. The factors of `elbow_chord` are in
    // double-double no more accurate than those of plain squares: of 100 000 triangles as flat, the median error is
    // 0.080 against 0.088 of 2^-104 of the squares, the largest 0.91 against 0.95.
    within(exact("1e-6"), [3e-27, 2e-21, 3.3e-15]);
    within(exact("1e-9"), [3e-25, 3e-16, 2e-7]);
    within(errors::<Jansen, f64, ClosedForm>("1e-3", leg::<f64>).unwrap(), [2e-12, 4e-9, 1e-5]);
    assert!(matches!(
        errors::<Jansen, f64, ClosedForm>("1e-9", leg::<f64>),
        Err(PositionError::Singular { group: "angle_b, angle_j (Pivot-Upper-Pin)", .. })
    ));
}

fn four_bar_at_once<T: Real>(m: &FourBar<T>, case: &Case) -> Result<[SVector<T, 3>; 3], PositionError> {
    let moving = m.kinematics(scalar::<T>(case.input), branch::<T>(case), T::one(), T::zero())?;
    Ok([moving.pose.coordinates().into(), moving.rates.into(), moving.accelerations.into()])
}

fn leg_at_once(m: &Jansen, case: &Case) -> Result<[SVector<f64, 11>; 3], PositionError> {
    let moving = m.kinematics(case.input, leg::<f64>(case), 1.0, 0.0)?;
    Ok([moving.pose.coordinates().into(), moving.rates.into(), moving.accelerations.into()])
}

/// `kinematics` is as accurate as the separate calls. Near a dead point the error is that of the input and of the half
/// chord, the same by both, and both fail at the same one.
#[test]
fn kinematics_near_a_dead_point() {
    let same = |found: [f64; 3], separate: [f64; 3]| {
        println!("{found:?} {separate:?}");
        for (found, separate) in found.into_iter().zip(separate) {
            assert!((found - separate).abs() <= 1e-5 * separate, "{found:e} is not {separate:e}");
        }
    };
    let four_bar = |sine: &str| errors_at_once::<FourBar, f64, 3>(sine, four_bar_at_once);
    let jansen = |sine: &str| errors_at_once::<Jansen, f64, 11>(sine, leg_at_once);
    within(four_bar("benign").unwrap(), [1e-15, 1e-15, 1e-15]);
    within(jansen("benign").unwrap(), [4e-15, 8e-15, 1e-14]);
    for sine in ["1e-3", "1e-6"] {
        same(four_bar(sine).unwrap(), errors::<FourBar, f64, ClosedForm>(sine, branch::<f64>).unwrap());
        same(jansen(sine).unwrap(), errors::<Jansen, f64, ClosedForm>(sine, leg::<f64>).unwrap());
    }
    assert!(matches!(four_bar("1e-9"), Err(PositionError::Singular { group: "theta3, theta4", .. })));
    assert!(matches!(jansen("1e-9"), Err(PositionError::Singular { group: "angle_b, angle_j (Pivot-Upper-Pin)", .. })));
    for sine in ["1e-6", "1e-9"] {
        let separate = errors::<FourBar, DoubleDouble, ClosedForm>(sine, branch::<DoubleDouble>).unwrap();
        same(errors_at_once::<FourBar, DoubleDouble, 3>(sine, four_bar_at_once).unwrap(), separate);
    }
}

/// Determinants are sines of differences and lose no digit, however small they are. That of the butterfly is a product
/// of pivots, which are computed in twice the precision where they are small.
#[test]
fn angles_given() {
    for sine in ["benign", "1e-3", "1e-6", "1e-9"] {
        within(errors_at_angles::<FourBar, f64>(sine).unwrap(), [1e-15, 2e-15]);
        within(errors_at_angles::<Jansen, f64>(sine).unwrap(), [6e-15, 1e-14]);
        within(errors_at_angles::<Jansen, DoubleDouble>(sine).unwrap(), [4e-31, 1.2e-30]);
    }
    // Where the determinant is 1e-3 of what it could be, the smallest pivot is larger. The velocities given to the
    // accelerations are rounded.
    for (sine, size, bounds) in
        [("1e-3", 1e-3, [6e-14, 2e-13]), ("1e-6", 1e-6, [3e-16, 8e-15]), ("1e-9", 1e-9, [3e-16, 8e-15])]
    {
        within(errors_at_angles::<DoubleButterfly, f64>(sine).unwrap(), bounds);
        // Twice the precision itself loses as many digits as the determinant is small.
        let bound = 2e-32 / size;
        within(errors_at_angles::<DoubleButterfly, DoubleDouble>(sine).unwrap(), [bound, 3.0 * bound]);
    }
}

/// Each step squares the error of a prediction one degree away.
#[test]
fn newton_by_steps() {
    within(errors::<FourBar, f64, Newton<0>>("benign", near::<FourBar, _>).unwrap(), [2e-4, 2e-4, 3e-4]);
    within(errors::<FourBar, f64, Newton<1>>("benign", near::<FourBar, _>).unwrap(), [1e-8, 1e-8, 5e-9]);
    within(errors::<FourBar, f64, Newton<2>>("benign", near::<FourBar, _>).unwrap(), [1e-15, 2e-15, 2e-15]);
    within(errors::<Jansen, f64, Newton<1>>("benign", near::<Jansen, _>).unwrap(), [4e-6, 4e-6, 1e-5]);
    within(errors::<Jansen, f64, Newton<2>>("benign", near::<Jansen, _>).unwrap(), [4e-12, 4e-12, 1e-11]);
    within(errors::<Jansen, f64, Newton<3>>("benign", near::<Jansen, _>).unwrap(), [4e-15, 4e-15, 1e-14]);
    let exact = errors::<DoubleButterfly, DoubleDouble, Newton<4>>("benign", near::<DoubleButterfly, _>);
    within(exact.unwrap(), [1e-31, 1e-31, 2e-31]);
}

/// A crank that cannot turn is sent round: no answer is on the other branch.
#[test]
fn newton_keeps_its_branch() {
    let m = FourBar::new(80.0, 50.0, 40.0, 60.0);
    let left = FourBarBranch::new(linkage::Elbow::Left);
    let here = Reached::at(&m, m.assemble(0.9, left).unwrap().coordinates());
    let mut errors = 0;
    for step in 0..60 {
        match Newton::<1>::position(&m, &here, 0.9 + 0.05 * f64::from(step)) {
            Ok(there) => assert_eq!(m.branch_of(&there.pose), left),
            Err(PositionError::OtherBranch { group: "theta3, theta4", .. }) => errors += 1,
            Err(other) => panic!("{other}"),
        }
    }
    assert!(errors > 5, "{errors}");
}

/// Twice as many entries have a sixteenth of the error, and the error is the one that the table measured.
#[test]
fn tables() {
    let (coarse, errors) = table::<FourBar, 65>();
    within(errors, [1e-6, 1e-6, 2e-6]);
    let (fine, _) = table::<FourBar, 129>();
    let ratio = coarse.error() / fine.error();
    assert!((14.0..18.0).contains(&ratio), "{ratio}");
    assert!(errors[0] <= 1.1 * coarse.error() && coarse.error() <= 4.0 * errors[0], "{} {errors:?}", coarse.error());
    within(table::<Jansen, 1025>().1, [2e-9, 4e-9, 1e-8]);
    within(table::<DoubleButterfly, 65>().1, [1e-6, 1e-6, 2e-6]);
}

/// Over many turns, forward and backward, an angle grows by whole turns; lengths and rockers return.
#[test]
fn tables_go_round() {
    let m = FourBar::new(20.0, 80.0, 50.0, 70.0);
    let start = m.assemble(0.3, FourBarBranch::new(linkage::Elbow::Left)).unwrap();
    // A drag link: coupler and rocker turn with the crank.
    let table = Table::<_, 257>::turn(&m, &start.coordinates()).unwrap();
    for (input, turns) in
        [(0.3 + 0.01, 0.0), (0.3 + TAU + 0.01, 1.0), (0.3 - TAU + 0.01, -1.0), (0.3 + 5.0 * TAU + 0.01, 5.0)]
    {
        let found = Table::position(&m, &table, input).unwrap();
        let first = Table::position(&m, &table, 0.3 + 0.01).unwrap().coordinates;
        assert!((found.coordinates.theta4 - first.theta4 - turns * TAU).abs() < 1e-9, "{turns}");
        assert!(m.residual(&found.pose).largest() < 1e-3 && found.coordinates.theta2.to_bits() == input.to_bits());
    }
}

#[test]
fn tables_that_do_not_exist() {
    let m = FourBar::new(80.0, 50.0, 40.0, 60.0);
    let start = m.assemble(0.9, FourBarBranch::new(linkage::Elbow::Left)).unwrap().coordinates();
    // The crank cannot make a full turn, but a part of one.
    Table::<_, 33>::turn(&m, &start).unwrap_err();
    let table = Table::<_, 33>::between(&m, &start, 0.5).unwrap();
    assert!(Table::position(&m, &table, 0.7).is_ok() && Table::position(&m, &table, 0.5).is_ok());
    for outside in [0.45, 0.95] {
        let error = Table::position(&m, &table, outside).unwrap_err();
        assert!(matches!(error, PositionError::Input(InputError::OutOfRange { least, most, .. })
                if (least - 0.5).abs() + (most - 0.9).abs() < 1e-12));
    }
    assert!(matches!(Table::position(&m, &table, f64::NAN), Err(PositionError::NotFinite { .. })));
    // Gears that turn once while the crank turns twice are not in the same position after a turn of the crank.
    let geared = GearedFiveBar { ratio: -0.5, ..GearedFiveBar::default() };
    let guess = GearedFiveBarCoordinates { theta1: 0.9, theta2: 0.3, theta3: 1.2, theta4: -0.45 + geared.phase };
    let start = geared.solve(&guess).unwrap().coordinates;
    let around = Table::<_, 65>::turn(&geared, &start);
    assert!(matches!(around, Err(PositionError::Input(InputError::NotPeriodic { .. }))), "{around:?}");
}

/// A method selected by type is the direct call.
#[test]
fn by_type_is_the_direct_call() {
    let m = FourBar::default();
    let left = FourBarBranch::new(linkage::Elbow::Left);
    for step in 0..200 {
        let input = TAU * f64::from(step) / 200.0 - PI;
        let (ours, direct) = (ClosedForm::position(&m, &left, input).unwrap(), m.assemble(input, left).unwrap());
        let numbers = |pose: &FourBarPose| {
            let directions = [pose.theta2, pose.theta3, pose.theta4].map(|direction| [direction.re, direction.im]);
            let angles = [pose.theta2_angle, pose.theta3_angle, pose.theta4_angle];
            let all: Vec<f64> = directions.into_iter().flatten().chain(angles).chain([pose.determinant]).collect();
            all.into_iter().map(f64::to_bits).collect::<Vec<_>>()
        };
        assert_eq!(numbers(&ours), numbers(&direct));
        let here = Reached::at(&m, direct.coordinates());
        let after = Newton::<2>::position(&m, &here, input + 0.01).unwrap();
        let ratios = m.velocity_ratios(&here.pose).unwrap();
        let predicted = SVector::from([here.coordinates.theta3, here.coordinates.theta4]) + ratios * 0.01;
        let mut q = FourBarCoordinates { theta3: predicted[0], theta4: predicted[1], theta2: input + 0.01 };
        for _ in 0..2 {
            q = linkage::position::newton_step(&m, &q).unwrap();
        }
        assert!(
            (after.coordinates.theta3 - q.theta3).abs() < 1e-15 && (after.coordinates.theta4 - q.theta4).abs() < 1e-15
        );
    }
}

fn price(error: f64, time: f64) -> Option<Cost> {
    Some(Cost { error, time })
}

#[test]
fn dominated_methods() {
    let fast = vec![price(1e-6, 10.0), price(1e-3, 10.0)];
    let exact = vec![price(1e-15, 50.0), price(1e-12, 50.0)];
    let silly = vec![price(1e-6, 60.0), price(1e-3, 60.0)];
    assert_eq!(dominated(&[fast.clone(), exact.clone(), silly.clone()]), [None, None, Some(0)]);
    // A method that is better at one point is not dominated, nor one that has a result where the others have none.
    let mut special = silly.clone();
    special[1] = price(1e-20, 60.0);
    assert_eq!(dominated(&[fast.clone(), exact.clone(), special]), [None; 3]);
    let [mut partial, mut other] = [silly, fast.clone()];
    other[1] = None;
    assert_eq!(dominated(&[other, partial.clone()]), [None; 2]);
    partial[1] = None;
    assert_eq!(dominated(&[fast.clone(), partial]), [None, Some(0)]);
    // Equal methods do not dominate each other.
    let alike = fast.iter().map(|one| one.map(|Cost { error, time }| Cost { error: 2.0 * error, time: 1.05 * time }));
    let alike = alike.collect();
    assert_eq!(dominated(&[fast.clone(), alike]), [None; 2]);
}

#[test]
fn frontier_and_cheapest() {
    let prices =
        [price(1e-7, 20.0), None, price(1e-15, 40.0), price(1e-9, 60.0), price(1e-31, 900.0), price(1e-3, 30.0)];
    assert_eq!(frontier(&prices), [0, 2, 4]);
    assert_eq!(cheapest(&prices, 1e-6), Some((0, None)));
    assert_eq!(cheapest(&prices, 1e-8), Some((2, Some(5))));
    assert_eq!(cheapest(&prices, 1e-40), None);
}
