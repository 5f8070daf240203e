//! Accepted lanes against `kinematics` and `full_kinematics`, called with the fields of a mechanism.

use std::fmt::Debug;

use linkage::kinematic::{FullKinematics, Kinematics};
use linkage::lanes::Lanes;
use linkage::{Build, Dim, OutputMotion, PointMotion, Real, real};
use linkage_gallery::Fixture;

/// The scalar of a mechanism.
pub type S<M> = <M as Lanes>::Scalar;

/// Compares an accepted lane with `kinematics` and `full_kinematics`. False if the latter returns an error.
pub fn is_full<M>(given: &[S<M>], in_lane: &[S<M>]) -> bool
where
    M: Lanes + Fixture<Scalar = S<M>>,
    S<M>: Bits,
{
    let inputs = M::V::CAPACITY;
    // A mechanism without closed form starts from all coordinates, and on the branch of these.
    if M::START != inputs {
        return !in_lane.iter().any(|value| value.is_nan());
    }
    let (parameters, rest) = given.split_at(M::PARAMETERS);
    let (start, rest) = rest.split_at(inputs);
    let (rates, accelerations) = rest.split_at(inputs);
    let of_inputs = |list: &[S<M>]| M::V::least().column(|index| list[index]);
    let q = M::coordinates(M::U::least().column(|_| real(0.0)), of_inputs(start));
    let (rates, accelerations) = (of_inputs(rates).into(), of_inputs(accelerations).into());
    let (machine, branch) = (<M as Fixture>::with_parameters(parameters), M::branches()[0]);
    let Kinematics { rates: first, accelerations: second, .. } =
        machine.kinematics(&q, branch, rates, accelerations).expect("the lane is accepted");
    let derivatives = [M::rate_parts(&first).0, M::acceleration_parts(&second).0];
    let expected: Vec<S<M>> = derivatives.into_iter().flatten().collect();
    let found = &in_lane[M::COORDINATES - expected.len()..M::COORDINATES];
    assert!(same_bits(found, &expected), "{}: {found:?}, {expected:?}", <M as Lanes>::NAME);
    let Ok(FullKinematics { points, outputs, .. }) = machine.full_kinematics(&q, branch, rates, accelerations) else {
        return false;
    };
    let of_point = |point: PointMotion<S<M>>| {
        [point.position.coords, point.velocity, point.acceleration].into_iter().flat_map(|xy| [xy.x, xy.y])
    };
    let of_output = |output: OutputMotion<S<M>>| [output.value, output.rate, output.acceleration];
    let of_points = M::each_point(points).into_iter().flat_map(of_point);
    let expected: Vec<S<M>> = of_points.chain(M::each_output(outputs).into_iter().flat_map(of_output)).collect();
    let found = &in_lane[in_lane.len() - expected.len()..];
    assert!(same_bits(found, &expected), "{}: {found:?}, {expected:?}", <M as Lanes>::NAME);
    true
}

/// True if all numbers have the same bits, or are not a number.
pub fn same_bits<T: Bits>(one: &[T], other: &[T]) -> bool {
    let is_same = |(one, other): (&T, &T)| one.bits() == other.bits() || one.is_nan() && other.is_nan();
    one.len() == other.len() && one.iter().zip(other).all(is_same)
}

/// The bits of a scalar.
pub trait Bits: Real + Debug {
    fn bits(self) -> u64;
    fn is_nan(self) -> bool;
}

impl Bits for f64 {
    fn bits(self) -> u64 {
        self.to_bits()
    }

    fn is_nan(self) -> bool {
        Self::is_nan(self)
    }
}

impl Bits for f32 {
    fn bits(self) -> u64 {
        self.to_bits().into()
    }

    fn is_nan(self) -> bool {
        Self::is_nan(self)
    }
}
