//! Groups of loops k_i + sum_j c_ij t_j = 0 with planted positions.

use std::f64::consts::{PI, TAU};

use linkage_runtime::PositionError;
use linkage_runtime::modes::{Loops, Memory};
use rand::Rng;
use rand::rngs::SmallRng;

/// A complex number.
pub type Number = [f64; 2];

pub const ZERO: Number = [0.0; 2];

pub fn times(one: Number, other: Number) -> Number {
    [one[0] * other[0] - one[1] * other[1], one[0] * other[1] + one[1] * other[0]]
}

pub fn turned(length: f64, angle: f64) -> Number {
    [length * angle.cos(), length * angle.sin()]
}

/// The loops that these factors close at these angles.
pub fn closed<const L: usize, const N: usize>(factors: [[Number; N]; L], angles: &[f64; N]) -> Loops<f64, L, N> {
    let constant = |row: &[Number; N]| {
        let parts = row.iter().zip(angles).map(|(factor, angle)| times(*factor, turned(1.0, *angle)));
        parts.fold(ZERO, |sum, part| [sum[0] - part[0], sum[1] - part[1]])
    };
    Loops { constants: factors.each_ref().map(constant), factors }
}

/// A platform on three legs, of which the first is in both loops: the triad of Stephenson III, and a planar robot 3-RRR.
pub fn triad(platform: [Number; 2], legs: [f64; 3]) -> [[Number; 4]; 2] {
    let [first, second, third] = legs.map(|length| [length, 0.0]);
    [[platform[0], first, second, ZERO], [platform[1], first, ZERO, third]]
}

/// The links of a double butterfly: coupler, upper, rocker, lower, link, strut.
pub fn butterfly(random: &mut SmallRng) -> [[Number; 6]; 3] {
    let mut link = || turned(random.random_range(0.2..2.0), random.random_range(-PI..PI));
    let coupler = link();
    [
        [coupler, link(), link(), ZERO, ZERO, ZERO],
        [coupler, link(), ZERO, link(), link(), ZERO],
        [ZERO, ZERO, link(), link(), ZERO, link()],
    ]
}

pub fn random_triad(random: &mut SmallRng) -> [[Number; 4]; 2] {
    let mut link = || turned(random.random_range(0.2..2.0), random.random_range(-PI..PI));
    let mut factors = triad([link(), link()], [1.0; 3]);
    let first = link();
    (factors[0][1], factors[1][1], factors[0][2], factors[1][3]) = (first, first, link(), link());
    factors
}

/// Residuals, the sums of the magnitudes of their terms, and the columns of J.
pub fn evaluate<const L: usize, const N: usize>(
    loops: &Loops<f64, L, N>,
    angles: [f64; N],
) -> ([f64; N], [f64; N], [[f64; N]; N]) {
    let (mut residuals, mut scales, mut columns) = ([0.0; N], [0.0; N], [[0.0; N]; N]);
    for (row, (constant, factors)) in loops.constants.iter().zip(&loops.factors).enumerate() {
        for axis in 0..2 {
            (residuals[2 * row + axis], scales[2 * row + axis]) = (constant[axis], constant[axis].abs());
        }
        for ((factor, angle), column) in factors.iter().zip(angles).zip(&mut columns) {
            let [x, y] = times(*factor, turned(1.0, angle));
            (column[2 * row], column[2 * row + 1]) = (-y, x);
            for (axis, part) in [x, y].into_iter().enumerate() {
                residuals[2 * row + axis] += part;
                scales[2 * row + axis] += factor[0].abs() + factor[1].abs();
            }
        }
    }
    (residuals, scales, columns)
}

/// All positions of a group.
pub fn all<const L: usize, const N: usize>(loops: &Loops<f64, L, N>) -> Result<Vec<[f64; N]>, PositionError> {
    let modes = Memory::default().modes("Group", "t", *loops, |angles| angles, |angles| evaluate(loops, angles))?;
    Ok(modes.as_slice().to_vec())
}

/// The largest difference of two positions, in radians.
pub fn distance<const N: usize>(one: &[f64; N], other: &[f64; N]) -> f64 {
    let differences = one.iter().zip(other).map(|(one, other)| one - other);
    differences.map(|turn| (turn - (turn / TAU).round() * TAU).abs()).fold(0.0, f64::max)
}

/// The distance of the nearest of these positions from another.
pub fn nearest<const N: usize>(all: &[[f64; N]], to: &[f64; N]) -> f64 {
    all.iter().map(|one| distance(one, to)).fold(f64::INFINITY, f64::min)
}

/// Angles of any size up to pi.
pub fn angles<const N: usize>(random: &mut SmallRng) -> [f64; N] {
    std::array::from_fn(|_| random.random_range(-PI..PI))
}
