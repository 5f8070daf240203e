//! Position, velocity and acceleration of eight positions at once in closed form as a person writes them: arrays of
//! eight numbers in plain loops, link vectors instead of directions, no checks.

use std::array::from_fn;
use std::ops::{Add, Div, Mul, Neg, Sub};

use crate::mechanisms::{FourBar, Jansen};

/// The number of positions at once.
pub const WIDTH: usize = 8;

/// One number of each position.
#[derive(Clone, Copy)]
pub struct Eight(pub [f64; WIDTH]);

macro_rules! operators {
    ($($Trait:ident $function:ident $operator:tt;)*) => {$(
        impl $Trait for Eight {
            type Output = Self;
            #[inline(always)]
            fn $function(self, other: Self) -> Self {
                Self(from_fn(|lane| self.0[lane] $operator other.0[lane]))
            }
        }
    )*};
}

operators! {
    Add add +;
    Sub sub -;
    Mul mul *;
    Div div /;
}

impl Neg for Eight {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self(self.0.map(|number| -number))
    }
}

impl Eight {
    #[inline(always)]
    fn all(number: f64) -> Self {
        Self([number; WIDTH])
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(self.0.map(f64::sqrt))
    }

    #[inline(always)]
    fn sine_cosine(self) -> [Self; 2] {
        let (mut sines, mut cosines) = ([0.0; WIDTH], [0.0; WIDTH]);
        for lane in 0..WIDTH {
            (sines[lane], cosines[lane]) = linkage::__rt::lane::sine_cosine(self.0[lane]);
        }
        [Self(sines), Self(cosines)]
    }
}

type Vector = [Eight; 2];

/// A link: its vector, its rate and its acceleration.
type Moving = (Vector, Eight, Eight);

#[inline(always)]
fn dot([a, b]: Vector, [c, d]: Vector) -> Eight {
    a * c + b * d
}

#[inline(always)]
fn minus([a, b]: Vector, [c, d]: Vector) -> Vector {
    [a - c, b - d]
}

#[inline(always)]
fn plus([a, b]: Vector, [c, d]: Vector) -> Vector {
    [a + c, b + d]
}

#[inline(always)]
fn times([x, y]: Vector, by: Eight) -> Vector {
    [x * by, y * by]
}

/// A vector with its first and second derivatives.
#[inline(always)]
fn moving((v, rate, acceleration): Moving) -> [Vector; 3] {
    let [x, y] = v;
    let velocity = [-y * rate, x * rate];
    let square = rate * rate;
    [v, velocity, [-y * acceleration - x * square, x * acceleration - y * square]]
}

#[inline(always)]
fn less([a, b, c]: [Vector; 3], [d, e, f]: [Vector; 3]) -> [Vector; 3] {
    [minus(a, d), minus(b, e), minus(c, f)]
}

/// The links p and q between joints, V + W = D, as link vectors with their motion.
#[inline(always)]
fn dyad([d, d_rate, d_acceleration]: [Vector; 3], [p, q]: [f64; 2], side: f64) -> [Moving; 2] {
    let [sum, difference, half] = [p + q, p - q, 0.5].map(Eight::all);
    let square = dot(d, d);
    let chord = Eight::all(side) * ((sum * sum - square) * (square - difference * difference)).sqrt();
    let along = square + sum * difference;
    let over = half / square;
    let first = times([along * d[0] - chord * d[1], along * d[1] + chord * d[0]], over);
    let second = minus(d, first);
    let inverse = Eight::all(-2.0) / chord;
    let solved = |right: Vector| [dot(right, second) * inverse, -dot(right, first) * inverse];
    let [a, b] = solved(d_rate);
    let centripetal = plus(times(first, a * a), times(second, b * b));
    let [a_acceleration, b_acceleration] = solved(plus(d_acceleration, centripetal));
    [(first, a, a_acceleration), (second, b, b_acceleration)]
}

/// A link the other way round.
#[inline(always)]
fn back((v, rate, acceleration): Moving) -> Moving {
    (v.map(Neg::neg), rate, acceleration)
}

/// Inputs and their derivatives.
pub struct Given<'a> {
    pub angles: &'a [f64],
    pub rate: f64,
    pub acceleration: f64,
}

impl Given<'_> {
    #[inline(always)]
    fn blocks(&self) -> impl Iterator<Item = [Eight; 2]> {
        self.angles.as_chunks().0.iter().map(|block| Eight(*block).sine_cosine())
    }

    #[inline(always)]
    fn crank(&self, [sine, cosine]: [Eight; 2], length: f64) -> Moving {
        (times([cosine, sine], Eight::all(length)), Eight::all(self.rate), Eight::all(self.acceleration))
    }
}

/// Stores direction, rate and acceleration of a link of this length from a column on.
#[inline(always)]
fn store(found: &mut [Vec<f64>], at: usize, link: usize, links: usize, (v, rate, acceleration): Moving, inverse: f64) {
    let [x, y] = times(v, Eight::all(inverse));
    let places = [2 * link, 2 * link + 1, 2 * links + link, 3 * links + link];
    for (place, value) in places.into_iter().zip([x, y, rate, acceleration]) {
        found[place][at..at + WIDTH].copy_from_slice(&value.0);
    }
}

#[inline(always)]
fn ground(x: f64, y: f64) -> [Vector; 3] {
    let zero = [Eight::all(0.0); 2];
    [[x, y].map(Eight::all), zero, zero]
}

/// The four-bar.
#[inline(always)]
pub fn four_bar(m: &FourBar, given: &Given, side: f64, found: &mut [Vec<f64>]) {
    let inverses = [1.0 / m.l3, 1.0 / m.l4];
    for (block, direction) in given.blocks().enumerate() {
        let crank = moving(given.crank(direction, m.l2));
        let links = dyad(less(ground(m.l1, 0.0), crank), [m.l3, m.l4], side);
        for (link, (moving, inverse)) in links.into_iter().zip(inverses).enumerate() {
            store(found, block * WIDTH, link, 2, moving, inverse);
        }
    }
}

/// The leg, in the order of its unknowns: b, j, d, e, c, k, f, g, h, i.
#[inline(always)]
pub fn jansen(m: &Jansen, given: &Given, sides: [f64; 5], found: &mut [Vec<f64>]) {
    let inverses = [m.b, m.j, m.d, m.e, m.c, m.k, m.f, m.g, m.h, m.i].map(f64::recip);
    for (block, direction) in given.blocks().enumerate() {
        let crank = moving(given.crank(direction, m.m));
        // pivot + b = crank + j: the second link of each dyad is taken backwards.
        let to_crank = less(crank, ground(-m.a, -m.l));
        let [b, j] = dyad(to_crank, [m.b, m.j], sides[0]);
        let [d, e] = dyad(moving(b), [m.d, m.e], sides[1]);
        let [c, k] = dyad(to_crank, [m.c, m.k], sides[2]);
        let [f, g] = dyad(less(moving(c), moving(d)), [m.f, m.g], sides[3]);
        let [i, h] = dyad(moving(back(g)), [m.i, m.h], sides[4]);
        let links = [b, back(j), d, back(e), c, back(k), f, back(g), back(h), i];
        for (link, (moving, inverse)) in links.into_iter().zip(inverses).enumerate() {
            store(found, block * WIDTH, link, 10, moving, inverse);
        }
    }
}

/// The chain: a, b, c, d of each four-bar.
#[inline(always)]
pub fn chain<const N: usize>(m: &[[f64; 4]; N], given: &Given, side: f64, found: &mut [Vec<f64>]) {
    for (block, direction) in given.blocks().enumerate() {
        let mut input = given.crank(direction, 1.0);
        for (number, &[a, b, c, d]) in m.iter().enumerate() {
            let (v, rate, acceleration) = input;
            let crank = moving((times(v, Eight::all(a)), rate, acceleration));
            let [coupler, rocker] = dyad(less(ground(d, 0.0), crank), [b, c], side);
            store(found, block * WIDTH, 2 * number, 2 * N, coupler, 1.0 / b);
            store(found, block * WIDTH, 2 * number + 1, 2 * N, back(rocker), 1.0 / c);
            let (v, rate, acceleration) = back(rocker);
            input = (times(v, Eight::all(1.0 / c)), rate, acceleration);
        }
    }
}
