//! The roads to the position that the price list offers: each one's error against 45 digits, its branch, its refusals;
//! asked for by type they are the direct call to the bit. And the list's own verdicts, on prices made up.

use std::borrow::Borrow;
use std::f64::consts::{PI, TAU};

use linkage::accuracy::{ClosedForm, Newton, PositionMethod, Reached, Table};
use linkage::nalgebra::SVector;
use linkage::{Assembly, Column, InputError, Mechanism, PositionError, Real};
use linkage_double::DoubleDouble;

#[path = "../examples/accuracy_cost/dominance.rs"]
mod dominance;
#[path = "../examples/price/frontier.rs"]
mod frontier;
#[path = "../examples/accuracy_cost/oracle.rs"]
mod oracle;

use dominance::dominated;
use frontier::{Price, cheapest, frontier};
use oracle::{Case, poses_of};

use linkage_gallery::double_butterfly::*;
use linkage_gallery::four_bar::*;
use linkage_gallery::geared_five_bar::*;
use linkage_gallery::jansen::*;

fn scalars<T: Real, const N: usize>(values: &[f64]) -> [T; N] {
    std::array::from_fn(|index| linkage::nalgebra::convert(values[index]))
}

/// Of every mechanism with one input.
macro_rules! errors {
    ($name:ident, $Mechanism:ident, $Coordinates:ident, $U:literal) => {
        mod $name {
            use super::*;

            pub fn mechanism<T: Real>(case: &Case) -> $Mechanism<T> {
                $Mechanism::from(scalars(&case.parameters))
            }

            pub fn coordinates<T: Real>(unknowns: &[f64], input: f64) -> $Coordinates<T> {
                let (unknowns, inputs) = (scalars::<T, $U>(unknowns), scalars::<T, 1>(&[input]));
                <$Mechanism<T> as Mechanism>::coordinates(unknowns.into(), inputs.into())
            }

            pub fn near<T: Real>(case: &Case) -> Reached<$Coordinates<T>, <$Mechanism<T> as Mechanism>::Pose> {
                Reached::at(&mechanism(case), coordinates(&case.before.1, case.before.0))
            }

            /// The largest errors of u, u' and u'' over the poses of this kind.
            pub fn errors<T: Real, R: PositionMethod<$Mechanism<T>>>(
                pose: &str,
                start: impl Fn(&Case) -> R::From,
            ) -> Result<[f64; 3], PositionError> {
                let mut largest = [0.0_f64; 3];
                let poses = poses_of(stringify!($name));
                let poses = poses.iter().filter(|poses| poses.pose == pose && !poses.angles_given);
                for case in poses.flat_map(|poses| &poses.cases) {
                    let m = mechanism::<T>(case);
                    let [input] = scalars::<T, 1>(&[case.input]);
                    let inputs = <$Mechanism<T> as Mechanism>::Inputs::from(Column::from([input]));
                    let position = R::position(&m, &start(case), inputs)?;
                    for (largest, error) in largest.iter_mut().zip(rates(case, &m, position.borrow())?) {
                        *largest = largest.max(error);
                    }
                }
                assert!(largest[0] > 0.0, "there are poses");
                Ok(largest)
            }

            /// The largest errors of u' and u'' where the angles are given.
            pub fn errors_at_angles<T: Real>(pose: &str) -> Result<[f64; 2], PositionError> {
                let mut largest = [0.0_f64; 2];
                let poses = poses_of(stringify!($name));
                let poses = poses.iter().filter(|poses| poses.pose == pose && poses.angles_given);
                for case in poses.flat_map(|poses| &poses.cases) {
                    let m = mechanism::<T>(case);
                    let pose = m.pose_at(&coordinates(&case.unknowns, case.input));
                    let [_, velocity, acceleration] = rates(case, &m, &pose)?;
                    largest = [largest[0].max(velocity), largest[1].max(acceleration)];
                }
                assert!(largest[0] > 0.0, "there are poses");
                Ok(largest)
            }

            fn rates<T: Real>(
                case: &Case,
                m: &$Mechanism<T>,
                pose: &<$Mechanism<T> as Mechanism>::Pose,
            ) -> Result<[f64; 3], PositionError> {
                let velocity = m.velocity(pose, T::one())?;
                let acceleration: SVector<T, { $U + 1 }> = m.acceleration(pose, &velocity, T::zero())?.into();
                let position = if case.unknowns.is_empty() {
                    case.error(0, <$Mechanism<T>>::unknowns(&pose.coordinates()).as_slice())
                } else {
                    0.0
                };
                Ok([
                    position,
                    case.error(1, <$Mechanism<T>>::rate_parts(&velocity).0.as_slice()),
                    case.error(2, &acceleration.as_slice()[..$U]),
                ])
            }

            pub type Entries<const N: usize> = Table<$Mechanism, N>;

            /// Over a turn, at benign poses.
            pub fn table<const N: usize>() -> (Entries<N>, [f64; 3]) {
                let poses = poses_of(stringify!($name));
                let first = &poses[0].cases[0];
                let start = coordinates(&first.before.1, first.before.0);
                let table = Entries::<N>::turn(&mechanism(first), &start).unwrap();
                (table, errors::<f64, Entries<N>>("benign", |_| table).unwrap())
            }
        }
    };
}

errors!(four_bar, FourBar, FourBarCoordinates, 2);
errors!(jansen, Jansen, JansenCoordinates, 10);
errors!(double_butterfly, DoubleButterfly, DoubleButterflyCoordinates, 6);

/// Of the position, the velocity, the acceleration.
#[track_caller]
fn within<const N: usize>(found: [f64; N], bounds: [f64; N]) {
    println!("{found:?}");
    for (found, bound) in found.into_iter().zip(bounds) {
        assert!(found <= bound, "{found:e} is more than {bound:e}");
        // A bound that is far off says nothing.
        assert!(found >= 0.05 * bound, "{found:e} is far less than {bound:e}");
    }
}

fn branch<T: Real>(case: &Case) -> FourBarBranch {
    Assembly::branch_of(&four_bar::mechanism::<T>(case), &four_bar::near::<T>(case).pose)
}

fn leg<T: Real>(case: &Case) -> JansenBranch {
    Assembly::branch_of(&jansen::mechanism::<T>(case), &jansen::near::<T>(case).pose)
}

#[test]
fn closed_form_at_benign_poses() {
    within(four_bar::errors::<f32, ClosedForm>("benign", branch::<f32>).unwrap(), [4e-7, 2e-6, 1e-6]);
    within(four_bar::errors::<f64, ClosedForm>("benign", branch::<f64>).unwrap(), [1e-15, 1e-15, 1e-15]);
    within(four_bar::errors::<DoubleDouble, ClosedForm>("benign", branch::<f64>).unwrap(), [1e-31, 1e-31, 1e-31]);
    within(jansen::errors::<f64, ClosedForm>("benign", leg::<f64>).unwrap(), [4e-15, 8e-15, 1e-14]);
    within(jansen::errors::<DoubleDouble, ClosedForm>("benign", leg::<f64>).unwrap(), [2e-31, 4e-31, 1e-30]);
}

/// What the input leaves of the angles near a dead point: a rounding over the sine, from any road in doubles.
#[test]
fn closed_form_near_a_dead_point() {
    let four_bar = |sine: &str| four_bar::errors::<f64, ClosedForm>(sine, branch::<f64>);
    within(four_bar("1e-3").unwrap(), [2e-13, 2e-10, 3e-7]);
    assert!(matches!(four_bar("1e-9"), Err(PositionError::Singular { group: "theta3, theta4", .. })));
    let exact = |sine: &str| four_bar::errors::<DoubleDouble, ClosedForm>(sine, branch::<f64>).unwrap();
    within(exact("1e-3"), [2e-29, 2e-26, 3e-23]);
    // A rounding of the squares over the cube of the sine: 3.2e-15. `elbow_chord`'s factors are in double-double as right
    // as those of plain squares and no more: of 100 000 triangles as flat, off by 0.080 and 0.088 of 2^-104 of the
    // squares in the median, by 0.91 and 0.95 at worst.
    within(exact("1e-6"), [3e-27, 2e-21, 3.3e-15]);
    within(exact("1e-9"), [3e-25, 3e-16, 2e-7]);
    within(jansen::errors::<f64, ClosedForm>("1e-3", leg::<f64>).unwrap(), [2e-12, 4e-9, 1e-5]);
    assert!(matches!(
        jansen::errors::<f64, ClosedForm>("1e-9", leg::<f64>),
        Err(PositionError::Singular { group: "angle_b, angle_j", .. })
    ));
}

/// Determinants are sines of differences: no digit is lost, however small they are. The butterfly's is a product of
/// pivots, which loses what its size says.
#[test]
fn angles_given() {
    for sine in ["benign", "1e-3", "1e-6", "1e-9"] {
        within(four_bar::errors_at_angles::<f64>(sine).unwrap(), [1e-15, 2e-15]);
        within(jansen::errors_at_angles::<f64>(sine).unwrap(), [6e-15, 1e-14]);
        within(jansen::errors_at_angles::<DoubleDouble>(sine).unwrap(), [4e-31, 1.2e-30]);
    }
    for (sine, size) in [("1e-3", 1e-3), ("1e-6", 1e-6), ("1e-9", 1e-9)] {
        let bound = 4e-16 / size;
        within(double_butterfly::errors_at_angles::<f64>(sine).unwrap(), [bound, 3.0 * bound]);
    }
}

/// Each step squares the error of a prediction one degree away.
#[test]
fn newton_by_steps() {
    within(four_bar::errors::<f64, Newton<0>>("benign", four_bar::near).unwrap(), [2e-4, 2e-4, 3e-4]);
    within(four_bar::errors::<f64, Newton<1>>("benign", four_bar::near).unwrap(), [1e-8, 1e-8, 5e-9]);
    within(four_bar::errors::<f64, Newton<2>>("benign", four_bar::near).unwrap(), [1e-15, 2e-15, 2e-15]);
    within(jansen::errors::<f64, Newton<1>>("benign", jansen::near).unwrap(), [4e-6, 4e-6, 1e-5]);
    within(jansen::errors::<f64, Newton<2>>("benign", jansen::near).unwrap(), [4e-12, 4e-12, 1e-11]);
    within(jansen::errors::<f64, Newton<3>>("benign", jansen::near).unwrap(), [4e-15, 4e-15, 1e-14]);
    let exact = double_butterfly::errors::<DoubleDouble, Newton<4>>("benign", double_butterfly::near);
    within(exact.unwrap(), [1e-31, 1e-31, 2e-31]);
}

/// A crank that cannot turn, asked to: no answer is on the other branch.
#[test]
fn newton_keeps_its_branch() {
    let m = FourBar::new(80.0, 50.0, 40.0, 60.0);
    let left = FourBarBranch::new(linkage::Elbow::Left);
    let here = Reached::at(&m, m.assemble(0.9, left).unwrap().coordinates());
    let mut refused = 0;
    for step in 0..60 {
        match Newton::<1>::position(&m, &here, 0.9 + 0.05 * f64::from(step)) {
            Ok(there) => assert_eq!(m.branch_of(&there.pose), left),
            Err(PositionError::OtherBranch { group: "theta3, theta4", .. }) => refused += 1,
            Err(other) => panic!("{other}"),
        }
    }
    assert!(refused > 5, "{refused}");
}

/// A sixteenth of the error for twice as many entries, and what the table itself measured.
#[test]
fn tables() {
    let (coarse, errors) = four_bar::table::<65>();
    within(errors, [1e-6, 1e-6, 2e-6]);
    let (fine, _) = four_bar::table::<129>();
    let ratio = coarse.error() / fine.error();
    assert!((14.0..18.0).contains(&ratio), "{ratio}");
    assert!(errors[0] <= 1.1 * coarse.error() && coarse.error() <= 4.0 * errors[0], "{} {errors:?}", coarse.error());
    within(jansen::table::<1025>().1, [2e-9, 4e-9, 1e-8]);
    within(double_butterfly::table::<65>().1, [1e-6, 1e-6, 2e-6]);
}

/// Turn after turn, forward and backward, an angle goes on by whole turns; lengths and rockers come back.
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
        assert!(m.residual(&found.pose).amax() < 1e-3 && found.coordinates.theta2.to_bits() == input.to_bits());
    }
}

#[test]
fn tables_refuse() {
    let m = FourBar::new(80.0, 50.0, 40.0, 60.0);
    let start = m.assemble(0.9, FourBarBranch::new(linkage::Elbow::Left)).unwrap().coordinates();
    // Its crank cannot turn; a part of the way it can.
    Table::<_, 33>::turn(&m, &start).unwrap_err();
    let table = Table::<_, 33>::between(&m, &start, 0.5).unwrap();
    assert!(Table::position(&m, &table, 0.7).is_ok() && Table::position(&m, &table, 0.5).is_ok());
    for outside in [0.45, 0.95] {
        let error = Table::position(&m, &table, outside).unwrap_err();
        assert!(matches!(error, PositionError::Input(InputError::OutOfRange { least, most, .. })
                if (least - 0.5).abs() + (most - 0.9).abs() < 1e-12));
    }
    assert!(matches!(Table::position(&m, &table, f64::NAN), Err(PositionError::NotFinite { .. })));
    // Gears that turn once while the crank turns twice are somewhere else after a turn.
    let geared = GearedFiveBar { ratio: -0.5, ..GearedFiveBar::default() };
    let guess = GearedFiveBarCoordinates { theta1: 0.9, theta2: 0.3, theta3: 1.2, theta4: -0.45 + geared.phase };
    let start = geared.solve(&guess).unwrap().coordinates;
    let around = Table::<_, 65>::turn(&geared, &start);
    assert!(matches!(around, Err(PositionError::Input(InputError::NotPeriodic { .. }))), "{around:?}");
}

/// Asked for by type, it is the direct call.
#[test]
fn by_type_is_the_direct_call() {
    let m = FourBar::default();
    let left = FourBarBranch::new(linkage::Elbow::Left);
    for step in 0..200 {
        let input = TAU * f64::from(step) / 200.0 - PI;
        let (ours, direct) = (ClosedForm::position(&m, &left, input).unwrap(), m.assemble(input, left).unwrap());
        assert_eq!(format!("{ours:?}"), format!("{direct:?}"));
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

fn price(error: f64, time: f64) -> Option<Price> {
    Some(Price { error, time })
}

#[test]
fn dominated_methods() {
    let fast = vec![price(1e-6, 10.0), price(1e-3, 10.0)];
    let exact = vec![price(1e-15, 50.0), price(1e-12, 50.0)];
    let silly = vec![price(1e-6, 60.0), price(1e-3, 60.0)];
    assert_eq!(dominated(&[fast.clone(), exact.clone(), silly.clone()]), [None, None, Some(0)]);
    // Better at one point keeps it, and so does a result where the others have none.
    let mut special = silly.clone();
    special[1] = price(1e-20, 60.0);
    assert_eq!(dominated(&[fast.clone(), exact.clone(), special]), [None; 3]);
    let [mut partial, mut other] = [silly, fast.clone()];
    other[1] = None;
    assert_eq!(dominated(&[other, partial.clone()]), [None; 2]);
    partial[1] = None;
    assert_eq!(dominated(&[fast.clone(), partial]), [None, Some(0)]);
    // What is alike dominates nothing.
    let alike = fast.iter().map(|one| one.map(|Price { error, time }| Price { error: 2.0 * error, time: 1.05 * time }));
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
