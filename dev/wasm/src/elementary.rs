//! The elementary functions of `f64`, `f32` and 31 digits at many arguments.

use std::convert::Infallible;

use linkage::{Number, Real};
use linkage_double::DoubleDouble;
use nalgebra::ComplexField;

use crate::checksum::Checksum;

type Of<T> = fn(T) -> T;

/// Functions of one number.
macro_rules! functions {
    ($T:ty) => {{
        let all: [(&str, Of<$T>); COUNT] = [
            ("sine", Real::sine),
            ("cosine", Real::cosine),
            ("tangent", Real::tangent),
            ("arcsine", Real::arcsine),
            ("arccosine", Real::arccosine),
            ("arctangent", Real::arctangent),
            ("exponential", Real::exponential),
            ("logarithm", Real::logarithm),
            ("square root", ComplexField::sqrt),
            ("angle", |x| Real::arctangent2(x, <$T as Number>::near(0.7))),
            ("length", |x| Real::hypotenuse(x, <$T as Number>::near(0.7))),
        ];
        all
    }};
}

/// The number of functions.
pub const COUNT: usize = 11;

/// Arguments of each kind.
const ARGUMENTS: u32 = 3000;

/// Between -1 and 1, between -40 and 40, and magnitudes up to 2^30; a generator by D. E. Knuth.
fn arguments() -> impl Iterator<Item = f64> {
    let mut state = 1_u64;
    let mut part = move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    };
    (0..ARGUMENTS).flat_map(move |place| {
        let power = f64::from(1_u32 << (place % 31));
        [part(), 40.0 * part(), power * part(), part() / power]
    })
}

/// Adds the values of a function; returns its name.
pub fn computed(place: usize, sum: &mut Checksum) -> String {
    let (doubles, floats, pairs) = (functions!(f64), functions!(f32), functions!(DoubleDouble));
    let (name, double) = doubles[place];
    let (single, pair) = (floats[place].1, pairs[place].1);
    for x in arguments() {
        let in_pairs = pair(DoubleDouble::from(x));
        sum.add(&Ok::<_, Infallible>((double(x), single(x as f32), in_pairs.high(), in_pairs.low())));
    }
    name.to_owned()
}
