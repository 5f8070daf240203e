//! The reduction of an angle by multiples of pi/2, over all of them.
//!
//! x = k pi/2 + rho. For k = 0 nothing is rounded. For other k, `near` and `far` are exact: the parts of pi/2 have 35
//! bits, k has 16, and `near` is a multiple of the ulp of x that is below 1. `head` is their difference rounded, and
//! `tail` contains its rounding error exactly, since `near` is a multiple of the ulp of `far`. What is rounded besides
//! is k times the third part of pi/2, and its difference with that error; and pi/2 is its three parts to 2^-130:
//!
//! |head - tail - rho| <= k 2^-130 + u k small + u |tail|, |tail| <= half an ulp of head + (1 + u) k small.

use std::f64::consts::FRAC_PI_2;

use linkage_runtime::__shared::HALF_PI;

use crate::kernels::approximation::big;

/// The largest k: 1e5 / (pi/2) is 63661.98.
const LAST: u32 = 63662;

/// Bits after the point of a sum in `i128`: 1e5 takes 17 and the sign one.
const BITS: i32 = 110;

/// The largest quotients over all k and all x up to 1e5.
pub struct Reduction {
    /// |head - tail - rho| / |rho|
    pub error: f64,
    /// k times the third part of pi/2 over |rho|
    pub tail: f64,
    /// k times the third part of pi/2
    pub largest_tail: f64,
}

/// A double of at least 2^-40, exactly.
fn fixed(x: f64) -> i128 {
    let bits = x.to_bits();
    let exponent = i32::try_from(bits >> 52).unwrap() - 1075;
    i128::from(bits & 0x000f_ffff_ffff_ffff | 0x0010_0000_0000_0000) << (exponent + BITS)
}

impl Reduction {
    pub fn new() -> Self {
        let half_pi = big(0.0).atan2(&big(-1.0)) / big(2.0);
        let parts = HALF_PI.iter().fold(big(0.0), |sum, &part| sum + big(part));
        assert!((&half_pi - parts).to_f64().value().abs() <= 2f64.powi(-130));
        // pi/2 in fixed point: its upper part exactly, and the rest, which a double holds to 2^-92.
        let rest = (&half_pi - big(FRAC_PI_2)).to_f64().value();
        let half_pi = fixed(FRAC_PI_2) + (rest * 2f64.powi(BITS)).round() as i128;
        let small = HALF_PI[2];
        let unit = 0.5 * f64::EPSILON;
        let mut most = Self { error: 0.0, tail: 0.0, largest_tail: f64::from(LAST) * small };
        for k in 1..=LAST {
            let multiple = i128::from(k) * half_pi;
            let nearest = f64::from(k) * FRAC_PI_2;
            // The double next to the multiple is one of these.
            let near = [nearest.next_down().next_down(), nearest.next_down(), nearest, nearest.next_up()];
            let distances = near.map(|x| (fixed(x) - multiple).unsigned_abs());
            let least = distances.into_iter().min().unwrap();
            assert!(distances[0] != least && distances[3].min(distances[2]) < distances[0]);
            // The fixed point is right to 2^-93.
            let distance = least as f64 * 2f64.powi(-BITS) - 2f64.powi(-92);
            let (k, tail) = (f64::from(k), f64::from(k) * small);
            // Half an ulp of head is at most u |head|.
            let error = k * 2f64.powi(-130) / distance + unit * (2.1 * tail / distance + 1.1 * unit);
            most.error = most.error.max(error);
            most.tail = most.tail.max(tail / distance);
        }
        most
    }
}

/// The documentation of the runtime promises 2^-60.
#[test]
fn relative_error() {
    let found = Reduction::new();
    println!("2^{:.2}, tail 2^{:.2} of the angle", found.error.log2(), found.tail.log2());
    assert!(found.error <= 2f64.powi(-60));
    assert!(found.tail <= 2f64.powi(-8));
}
