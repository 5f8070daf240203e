//! Laws of motion for cams, each with its derivatives by the angle of the cam.

use linkage::Real;
use linkage::nalgebra::convert;

/// A law on the unit interval with its first three derivatives.
type Law<T> = fn(T) -> [T; 4];

/// y = x - sin(2 pi x) / (2 pi).
fn cycloidal<T: Real>(x: T) -> [T; 4] {
    let turn = T::two_pi();
    let (sine, cosine) = (turn * x).sine_cosine();
    [x - sine / turn, T::one() - cosine, turn * sine, turn * turn * cosine]
}

/// y = 10 x^3 - 15 x^4 + 6 x^5.
fn polynomial_345<T: Real>(x: T) -> [T; 4] {
    let [one, two, six, ten, fifteen, thirty, sixty] = [1.0, 2.0, 6.0, 10.0, 15.0, 30.0, 60.0].map(convert::<f64, T>);
    let square = x * (one - x);
    [
        x * x * x * (ten - x * (fifteen - six * x)),
        thirty * square * square,
        sixty * square * (one - two * x),
        sixty * (one - six * square),
    ]
}

/// Rise by `height` while the cam turns by `rise`, dwell up to half a turn, return likewise, dwell.
fn strokes<T: Real>(law: Law<T>, angle: T, height: T, rise: T) -> [T; 4] {
    let (half, turn) = (T::pi(), T::two_pi());
    // Beyond a turn: the same direction between 0 and a turn.
    let direction = || {
        let angle = angle.sine().arctangent2(angle.cosine());
        if angle < T::zero() { angle + turn } else { angle }
    };
    let angle = if angle < T::zero() || angle > turn { direction() } else { angle };
    if angle > half + rise {
        return [T::zero(); 4];
    }
    if angle > rise && angle <= half {
        return [height, T::zero(), T::zero(), T::zero()];
    }
    let (from, stroke, start) = if angle > half { (half, -height, height) } else { (T::zero(), height, T::zero()) };
    let [y, first, second, third] = law((angle - from) / rise);
    let scale = stroke / rise;
    [start + stroke * y, scale * first, scale * second / rise, scale * third / (rise * rise)]
}

/// Strokes of cycloidal motion, with two derivatives.
#[must_use]
pub fn cycloidal_strokes<T: Real>(angle: T, height: T, rise: T) -> (T, T, T) {
    let [lift, first, second, _] = strokes(cycloidal, angle, height, rise);
    (lift, first, second)
}

/// Strokes of the 3-4-5 polynomial, with three derivatives.
#[must_use]
pub fn polynomial_strokes<T: Real>(angle: T, height: T, rise: T) -> (T, T, T, T) {
    strokes(polynomial_345, angle, height, rise).into()
}
