//! The roads to the position that the price list offers: each one's error against 45 digits, its branch, its refusals;
//! asked for by type they are the direct call to the bit. And the list's own verdicts, on prices made up.

use std::borrow::Borrow;
use std::f64::consts::{PI, TAU};

use linkage::accuracy::{ClosedForm, Method, Newton, Reached, Table};
use linkage::nalgebra::SVector;
use linkage::{Assembly, Error, Mechanism, Real, linkage};
use linkage_double::DoubleDouble;

#[path = "../examples/accuracy_cost/frontier.rs"]
mod frontier;
#[path = "../examples/accuracy_cost/oracle.rs"]
mod oracle;

use frontier::{Price, cheapest, dominated, frontier};
use oracle::{Case, poses_of};

include!("mechanisms/double_butterfly.rs");
include!("mechanisms/four_bar.rs");
include!("mechanisms/geared_five_bar.rs");
include!("mechanisms/jansen.rs");

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
                let zero = $Coordinates::from(SVector::from([T::zero(); $U + 1]));
                let unknowns = SVector::from(scalars::<T, $U>(unknowns));
                let all = <$Mechanism<T> as Mechanism<T, $U, 1>>::with_unknowns(&zero, unknowns);
                <$Mechanism<T> as Mechanism<T, $U, 1>>::with_inputs(&all, SVector::from(scalars::<T, 1>(&[input])).into())
            }

            pub fn near<T: Real>(case: &Case) -> Reached<$Coordinates<T>, <$Mechanism<T> as Mechanism<T, $U, 1>>::Pose> {
                Reached::at(&mechanism(case), coordinates(&case.before.1, case.before.0))
            }

            /// The largest errors of u, u' and u'' over the poses of this kind.
            pub fn errors<T: Real, R: Method<$Mechanism<T>, T, $U, 1>>(
                pose: &str,
                start: impl Fn(&Case) -> R::From,
            ) -> Result<[f64; 3], Error> {
                let mut largest = [0.0_f64; 3];
                let poses = poses_of(stringify!($name));
                let poses = poses.iter().filter(|poses| poses.pose == pose && !poses.angles_given);
                for case in poses.flat_map(|poses| &poses.cases) {
                    let m = mechanism::<T>(case);
                    let [input] = scalars::<T, 1>(&[case.input]);
                    let position = R::position(&m, &start(case), SVector::<T, 1>::new(input))?;
                    for (largest, error) in largest.iter_mut().zip(rates(case, &m, position.borrow())?) {
                        *largest = largest.max(error);
                    }
                }
                assert!(largest[0] > 0.0, "there are poses");
                Ok(largest)
            }

            /// The largest errors of u' and u'' where the angles are given.
            pub fn errors_at_angles<T: Real>(pose: &str) -> Result<[f64; 2], Error> {
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
                pose: &<$Mechanism<T> as Mechanism<T, $U, 1>>::Pose,
            ) -> Result<[f64; 3], Error> {
                let unknowns = |q: &$Coordinates<T>| <$Mechanism<T> as Mechanism<T, $U, 1>>::unknowns(q);
                let velocity = m.velocity(pose, T::one())?;
                let acceleration = m.acceleration(pose, &velocity, T::zero())?;
                let position =
                    if case.unknowns.is_empty() { case.error(0, unknowns(&pose.coordinates()).as_slice()) } else { 0.0 };
                Ok([
                    position,
                    case.error(1, unknowns(&velocity).as_slice()),
                    case.error(2, unknowns(&acceleration).as_slice()),
                ])
            }

            pub type Entries<const N: usize> = Table<$Coordinates, f64, $U, N>;

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
    println!("{found:.1e?}");
    for (found, bound) in found.into_iter().zip(bounds) {
        assert!(found <= bound, "{found:e} is more than {bound:e}");
        // A bound that is far off says nothing.
        assert!(found >= 1e-3 * bound, "{found:e} is far less than {bound:e}");
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
    within(four_bar::errors::<f32, ClosedForm>("benign", branch::<f32>).unwrap(), [4e-7, 2e-6, 2e-6]);
    within(four_bar::errors::<f64, ClosedForm>("benign", branch::<f64>).unwrap(), [1e-15, 2e-15, 2e-15]);
    within(four_bar::errors::<DoubleDouble, ClosedForm>("benign", branch::<f64>).unwrap(), [1e-30, 2e-30, 2e-30]);
    within(jansen::errors::<f64, ClosedForm>("benign", leg::<f64>).unwrap(), [4e-15, 2e-14, 2e-14]);
    within(jansen::errors::<DoubleDouble, ClosedForm>("benign", leg::<f64>).unwrap(), [1e-30, 1e-29, 1e-29]);
}
