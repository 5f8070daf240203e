//! Accepted lanes against `kinematics` and `full_kinematics`, called with the fields of a mechanism.

use std::fmt::Debug;

use linkage::lanes::Lanes;
use linkage::{Dim, Real, real};
use linkage_gallery::{Kinematics, Moving};

/// The scalar of a mechanism.
pub type S<M> = <M as Lanes>::Scalar;

/// Compares an accepted lane with `kinematics` and `full_kinematics`. False if the latter returns an error.
pub fn is_full<M>(given: &[S<M>], in_lane: &[S<M>]) -> bool
where
    M: Lanes + Kinematics<S<M>>,
    S<M>: Bits,
{
    let inputs = M::V::COUNT;
    // A mechanism without closed form starts from all coordinates, and on the branch of these.
    if M::START != inputs {
        return !in_lane.iter().any(|value| value.is_nan());
    }
    let (parameters, rest) = given.split_at(M::PARAMETERS);
    let (start, rest) = rest.split_at(inputs);
    let (rates, accelerations) = rest.split_at(inputs);
    // For each coordinate the number of the input that it is.
    let count = M::U::COUNT + inputs;
    let of_input = |place: usize| {
        let unit: Vec<S<M>> = (0..count).map(|other| real(f64::from(u8::from(other == place)))).collect();
        M::inputs_of(&unit).iter().position(|value| *value == real(1.0))
    };
    let of_input: Vec<Option<usize>> = (0..count).map(of_input).collect();
    let q: Vec<S<M>> = of_input.iter().map(|input| input.map_or(real(0.0), |input| start[input])).collect();
    let machine = M::with_parameters(parameters);
    let moving = machine.moving(&q, 0, rates, accelerations, false).expect("the lane is accepted");
    let derivatives = [&moving.rates, &moving.accelerations];
    let unknown =
        derivatives.into_iter().flat_map(|all| all.iter().zip(&of_input).filter(|(_, input)| input.is_none()));
    let expected: Vec<S<M>> = unknown.map(|(value, _)| *value).collect();
    let found = &in_lane[M::COORDINATES - expected.len()..M::COORDINATES];
    assert!(same_bits(found, &expected), "{}: {found:?}, {expected:?}", <M as Lanes>::NAME);
    let Ok(Moving { points, outputs, .. }) = machine.moving(&q, 0, rates, accelerations, true) else { return false };
    let (points, outputs) = (points.expect("it is full"), outputs.expect("it is full"));
    let of_point = |point: usize| points.iter().flat_map(move |xy| [xy[2 * point], xy[2 * point + 1]]);
    let of_output = |output: usize| outputs.iter().map(move |values| values[output]);
    let of_points = (0..points[0].len() / 2).flat_map(of_point);
    let expected: Vec<S<M>> = of_points.chain((0..outputs[0].len()).flat_map(of_output)).collect();
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
