//! Random and quasi-random numbers by index.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};
use statrs::function::erf::erfc_inv;

use crate::Distribution;

/// A stream of ChaCha.
#[derive(Debug, Clone, Copy)]
pub struct Stream {
    seed: u64,
    number: u64,
}

/// Random numbers of a stream, whose position is the number of the point.
#[derive(Debug)]
pub struct Random {
    generator: ChaCha8Rng,
    next: u64,
}

impl Random {
    /// The numbers of a stream.
    pub fn new(stream: Stream) -> Self {
        Self { generator: stream.generator(), next: 0 }
    }

    /// The number of a point. It is fastest if points come in order.
    pub fn bits(&mut self, point: u64) -> u64 {
        if self.next != point {
            // A position is one of 32 bits, of which a number takes two.
            self.generator.set_word_pos(2 * u128::from(point));
        }
        self.next = point.wrapping_add(1);
        self.generator.next_u64()
    }
}

/// The quasi-random numbers of one column: an additive recurrence.
#[derive(Debug, Clone, Copy)]
pub struct Quasi {
    step: u64,
    shift: u64,
}

impl Quasi {
    /// The numbers of a column, which is one of several `dimensions`.
    pub fn new(seed: u64, column: usize, dimension: usize, dimensions: usize) -> Self {
        let root = inverse_root(dimensions);
        // An odd step gives each number once in 2^64.
        let step = power(root, dimension + 1) | 1;
        Self { step, shift: Stream::shift(seed, column).generator().next_u64() }
    }

    /// The number of a point.
    pub fn bits(self, point: u64) -> u64 {
        self.shift.wrapping_add(self.step.wrapping_mul(point))
    }
}

impl Stream {
    /// The stream of the random numbers of a column.
    pub fn random(seed: u64, column: usize) -> Self {
        Self { seed, number: 2 * column as u64 }
    }

    /// The stream of the shift of a column's quasi-random numbers.
    fn shift(seed: u64, column: usize) -> Self {
        Self { seed, number: 2 * column as u64 + 1 }
    }

    /// The generator. Its seed is padded with zeros, so that no version of a library changes it.
    fn generator(self) -> ChaCha8Rng {
        let mut bytes = [0; 32];
        bytes[..8].copy_from_slice(&self.seed.to_le_bytes());
        let mut generator = ChaCha8Rng::from_seed(bytes);
        generator.set_stream(self.number);
        generator
    }
}

/// The positive root g of g^d + g^(d + 1) = 1 times 2^64, by bisection in integers: 1 / g is the root of
/// x^(d + 1) = x + 1, which M. Roberts names phi_d ("The unreasonable effectiveness of quasirandom sequences", 2018).
fn inverse_root(dimensions: usize) -> u64 {
    let is_below = |root: u64| power(root, dimensions).checked_add(power(root, dimensions + 1)).is_some();
    // The sum grows with the root: bit by bit the largest one whose sum is less than 1.
    (0..u64::BITS).rev().fold(0, |root, bit| if is_below(root | 1 << bit) { root | 1 << bit } else { root })
}

/// A power of a number divided by 2^64.
fn power(base: u64, exponent: usize) -> u64 {
    let times = |value: u64| ((u128::from(value) * u128::from(base)) >> 64) as u64;
    (1..exponent).fold(base, |value, _| times(value))
}

impl Distribution {
    /// The number that belongs to 64 random bits: the inverse of the distribution function.
    pub(crate) fn value(self, bits: u64) -> f64 {
        match self {
            Self::Uniform { from, to } => from + (to - from) * unit(bits),
            Self::Normal { mean, deviation } => mean + deviation * normal(bits),
        }
    }
}

/// A number from 0 on and less than 1.
fn unit(bits: u64) -> f64 {
    const UNIT: f64 = 1.0 / (1_u64 << 53) as f64;
    (bits >> 11) as f64 * UNIT
}

/// A number of the standard normal distribution, at most about 9.1 in magnitude.
fn normal(bits: u64) -> f64 {
    const HALF: u64 = 1 << 63;
    // The two halves are mirrored, so that both tails have all digits.
    let (rank, sign) = if bits < HALF { (bits, -1.0) } else { (!bits, 1.0) };
    let twice = (rank as f64 + 0.5) / HALF as f64;
    sign * std::f64::consts::SQRT_2 * erfc_inv(twice)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_root_of_one_dimension_is_the_golden_ratio() {
        // 2^64 divided by the golden ratio.
        assert!(inverse_root(1).abs_diff(0x9E37_79B9_7F4A_7C15) <= 2);
    }

    #[test]
    fn the_roots_of_more_dimensions_are_those_of_the_article() {
        // 2^64 divided by the plastic number.
        assert!(inverse_root(2).abs_diff(0xC13F_A9A9_02A6_328F) <= 2);
        for (dimensions, phi) in [(2, 1.324_717_957_244_746), (3, 1.220_744_084_605_759_6)] {
            let root = inverse_root(dimensions) as f64 / 2.0_f64.powi(64);
            assert!((root * phi - 1.0).abs() < 4.0 * f64::EPSILON, "{dimensions}: {root}");
        }
    }

    #[test]
    fn normal_numbers_mirror_and_are_finite() {
        assert!((normal(0) + 9.0).abs() < 0.2 && normal(u64::MAX) == -normal(0));
        assert!(normal(1 << 63).abs() < 1e-15);
        // The quantile of 0.975 is 1.959963984540054.
        let rank = (0.975 * 2.0_f64.powi(64)) as u64;
        assert!((normal(rank) / 1.959_963_984_540_054 - 1.0).abs() < 1e-14, "{}", normal(rank));
    }

    #[test]
    fn random_numbers_do_not_depend_on_the_order() {
        let mut forward = Random::new(Stream::random(3, 1));
        let all: Vec<u64> = (0..100).map(|point| forward.bits(point)).collect();
        let mut backward = Random::new(Stream::random(3, 1));
        assert!((0..100).rev().all(|point| backward.bits(point) == all[point as usize]));
    }
}
