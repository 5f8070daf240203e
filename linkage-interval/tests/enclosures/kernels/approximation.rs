//! The error of a polynomial that approximates a power series.

use std::f64::consts::PI;

use dashu_float::FBig;
use dashu_float::ops::Abs;
use dashu_float::round::mode::HalfEven;
use linkage_interval::Interval;

type Big = FBig<HalfEven, 2>;

/// A double, exactly, for operations of 200 bits.
pub fn big(value: f64) -> Big {
    Big::try_from(value).expect("a finite number").with_precision(200).value()
}

/// Bounds of the error for arguments in parts, those near the ends shorter: there the error varies more.
pub struct Approximation(Vec<(Interval, f64)>);

impl Approximation {
    /// |sum (coefficients - series) z^i| for 0 <= z <= `most`. The terms of the series alternate and decrease, so that the
    /// first omitted one bounds the remainder.
    ///
    /// About the middle m of a part of half length h the difference is a polynomial sum d_i (z - m)^i, which is at most
    /// sum |d_i| h^i: the coefficients cancel at m, in 200 bits, and not in the bounds.
    pub fn new(coefficients: &[f64], series: &[Big], most: f64) -> Self {
        const PARTS: u32 = 96;
        let zeros = std::iter::repeat(&0.0);
        let differences: Vec<Big> =
            coefficients.iter().chain(zeros).zip(series).map(|(&found, exact)| big(found) - exact).collect();
        let (omitted, kept) = differences.split_last().unwrap();
        assert!(kept.len() > coefficients.len());
        let end = |part: u32| 0.5 * most * (1.0 - (PI * f64::from(part) / f64::from(PARTS)).cos());
        let bound = |part: u32| {
            let z = Interval::new(end(part), end(part + 1)).unwrap();
            let [least, most] = [z.least(), z.most()].map(big);
            let half = (&most - &least) / big(2.0);
            let about = shifted(kept.to_vec(), &((&most + &least) / big(2.0)));
            let sum = about.iter().rev().fold(big(0.0), |sum, term| sum * &half + term.clone().abs());
            let remainder = kept.iter().fold(omitted.clone().abs(), |term, _| term * &most);
            // The error of 200 bits is far below this.
            (z, (sum + remainder).to_f64().value() * (1.0 + 1e-12))
        };
        Self((0..PARTS).map(bound).collect())
    }

    /// The bound for these arguments.
    pub fn bound(&self, z: Interval) -> f64 {
        let parts = self.0.iter().filter(|(part, _)| part.intersection(z).is_some());
        assert!(self.0.last().is_some_and(|(part, _)| z.most() <= part.most()));
        parts.map(|&(_, bound)| bound).fold(0.0, f64::max)
    }
}

/// The coefficients of p(z + m), by Horner's scheme.
fn shifted(mut coefficients: Vec<Big>, m: &Big) -> Vec<Big> {
    for first in 0..coefficients.len() {
        for index in (first..coefficients.len() - 1).rev() {
            let above = coefficients[index + 1].clone();
            coefficients[index] = &coefficients[index] + above * m;
        }
    }
    coefficients
}
