//! The angles of directions, sines, cosines and tangents.
//!
//! The angles of corners are those of the runtime, whose relative error has the proven bound `ARCTANGENT_ERROR`. They
//! are monotone along the sides of a box that neither contains the origin nor crosses the negative x axis.

use std::f64::consts::{FRAC_PI_2, PI};

use linkage_runtime::__shared::ARCTANGENT_ERROR;
use linkage_runtime::Real;

use super::Interval;
use super::rounding::quotient;

/// pi/2, which the double FRAC_PI_2 is below.
const RIGHT: Interval = Interval { least: FRAC_PI_2, most: FRAC_PI_2.next_up() };
/// pi, which the double PI is below.
const STRAIGHT: Interval = Interval { least: PI, most: PI.next_up() };

/// 2^-800: an angle with a smaller tangent is that tangent, less a third of its cube.
const TINY: f64 = f64::from_bits(0x0df0_0000_0000_0000);
/// 2^-50 and 2^500, the range of the larger coordinate of a point; with 2^600 and 2^-400 the others are brought there, or
/// to where the runtime's function is regular too.
const LARGER: [f64; 2] = [f64::from_bits(0x3cd0_0000_0000_0000), f64::from_bits(0x5f30_0000_0000_0000)];
const SCALES: [f64; 2] = [f64::from_bits(0x6570_0000_0000_0000), f64::from_bits(0x26f0_0000_0000_0000)];

impl Interval {
    /// The angle of (x, y), y = `self`: from -pi to pi if the box contains the origin or crosses the negative x axis, of
    /// which the angle is pi.
    pub(super) fn angle(self, x: Self) -> Self {
        let y = self;
        let has_origin = y.contains(0.0) && x.contains(0.0);
        if has_origin || (x.least < 0.0 && y.least < 0.0 && y.most >= 0.0) {
            return Self { least: -STRAIGHT.most, most: STRAIGHT.most };
        }
        if y.least >= 0.0 {
            let first = if x.most > 0.0 { y.least } else { y.most };
            let last = if x.least >= 0.0 { y.most } else { y.least };
            return Self { least: corner(first, x.most).least, most: corner(last, x.least).most };
        }
        if y.most <= 0.0 {
            return -(-y).angle(x);
        }
        Self { least: corner(y.least, x.least).least, most: corner(y.most, x.least).most }
    }

    /// The angle of (x, y), y = `self`, on one turn: in a box that crosses the negative x axis from pi/2 to 3 pi/2. All real
    /// numbers if the box contains the origin.
    pub(crate) fn angle_on_one_turn(self, x: Self) -> Self {
        let y = self;
        match (y.contains(0.0), x.contains(0.0)) {
            (true, true) => Self::ENTIRE,
            (true, false) if x.most < 0.0 => STRAIGHT + (-y).angle(-x),
            _ => y.angle(x),
        }
    }

    pub(super) fn arctangent(self) -> Self {
        Self { least: corner(self.least, 1.0).least, most: corner(self.most, 1.0).most }
    }

    /// All real numbers if there are others in the interval than sines.
    pub(super) fn arcsine(self) -> Self {
        if self.magnitude() > 1.0 {
            return Self::ENTIRE;
        }
        let of = |sine: f64| Self::from(sine).angle(leg(sine));
        Self { least: of(self.least).least, most: of(self.most).most }
    }

    /// All real numbers if there are others in the interval than cosines.
    pub(super) fn arccosine(self) -> Self {
        if self.magnitude() > 1.0 {
            return Self::ENTIRE;
        }
        let of = |cosine: f64| leg(cosine).angle(cosine.into());
        Self { least: of(self.most).least, most: of(self.least).most }
    }
}

/// The other leg of a right triangle with hypotenuse 1.
fn leg(leg: f64) -> Interval {
    let [one, leg] = [1.0, leg].map(Interval::from);
    ((one - leg) * (one + leg)).root()
}

/// The angle of a point other than the origin, with at most one infinite coordinate: of that it is the limit.
fn corner(y: f64, x: f64) -> Interval {
    if y < 0.0 {
        return -corner(-y, x);
    }
    let (small, large) = if y > x.abs() { (x.abs(), y) } else { (y, x.abs()) };
    // Zero may have a sign, which would choose the other side of the cut.
    if small < TINY * large || large.is_infinite() || small == 0.0 {
        return match () {
            () if y > x.abs() => RIGHT,
            () if x < 0.0 => STRAIGHT,
            () => tiny(y, x),
        };
    }
    let scale = match large {
        _ if large < LARGER[0] => SCALES[0],
        _ if large > LARGER[1] => SCALES[1],
        _ => 1.0,
    };
    Interval::near_result((y * scale).arctangent2(x * scale), ARCTANGENT_ERROR)
}

/// An angle with a tangent below `TINY`.
fn tiny(y: f64, x: f64) -> Interval {
    let tangent = quotient(y, x);
    let least = if y == 0.0 { 0.0 } else { tangent.down().next_down().max(0.0) };
    Interval { least, most: tangent.up() }
}
