//! The triangle inequality of a loop, for directions in cells of angles.

use super::cell::{Cell, MARGIN};
use super::circle::direction;
use super::linearized::{MOST_ANGLES, ROUNDING, size};
use super::number::{COLUMNS, Number};
use crate::Real as _;

/// The angle that differs by full turns, from -pi to pi.
pub fn around(angle: f64) -> f64 {
    let turn = core::f64::consts::TAU;
    angle - turn * nalgebra::ComplexField::round(angle / turn)
}

/// Narrows the angles of a loop to those at which it can close; false if it cannot. The ends of a link within an angle are
/// in a circle about the middle of their chord.
pub fn close(row: &[Number; COLUMNS], cell: &mut Cell, angles: usize) -> bool {
    let [constant, factors @ ..] = row;
    let mut middles = [Number::default(); MOST_ANGLES];
    let (mut radii, mut lengths) = ([0.0; MOST_ANGLES], [0.0; MOST_ANGLES]);
    let (mut sum, mut radius) = (*constant, size(*constant) * ROUNDING * f64::EPSILON);
    for (place, factor) in factors.iter().enumerate().take(angles).filter(|(_, factor)| **factor != Number::default()) {
        let length = size(*factor);
        lengths[place] = length;
        let half = cell.half[place];
        radii[place] = length;
        if half < core::f64::consts::FRAC_PI_2 {
            let (sine, cosine) = half.sine_cosine();
            middles[place] = factor * direction(cell.middle[place]) * cosine;
            radii[place] *= sine;
        }
        sum += middles[place];
        radius += radii[place] + length * ROUNDING * f64::EPSILON;
    }
    for place in (0..angles).filter(|place| lengths[*place] > 0.0) {
        let (length, reach) = (lengths[place], radius - radii[place]);
        let rest = middles[place] - sum;
        let distance = size(rest);
        if distance > length + reach || distance < length - reach {
            return false;
        }
        if distance == 0.0 {
            continue;
        }
        // The square of the sine of half the angle in the triangle of these sides, without cancellation.
        let off = distance - length;
        let square = (reach - off) * (reach + off) / (4.0 * length * distance);
        if square >= 1.0 {
            continue;
        }
        let within = 2.0 * nalgebra::ComplexField::sqrt(square.max(0.0)).arcsine() + MARGIN;
        let to = rest * factors[place].conj();
        let (middle, half) = (cell.middle[place], cell.half[place]);
        let away = around(to.im.arctangent2(to.re) - middle);
        // The angles from the middle are away - within ... away + within, and the same a turn further.
        if core::f64::consts::TAU - away.abs() - within < half {
            continue;
        }
        let (low, high) = ((-half).max(away - within), half.min(away + within));
        if low > high {
            return false;
        }
        if high - low < 2.0 * half {
            cell.middle[place] = middle + 0.5 * (low + high);
            cell.half[place] = 0.5 * (high - low) + MARGIN;
        }
    }
    true
}
