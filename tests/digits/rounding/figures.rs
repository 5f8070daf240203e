//! The tightness of the bounds: the figures of the manual.

use linkage_double::DoubleDouble;
use linkage_gallery::listed::{listed, same_as};
use linkage_oracle::scalars;
use linkage_rounding::Rounded;
use rand::rngs::SmallRng;
use rand::{Rng, SeedableRng};

use crate::rounding::every_function::{Found, Three, median};
use crate::rounding::poses;
use crate::rounding::results::{Arguments, given};

/// Bounds and errors of a four-bar at given angles of which coupler and rocker are parallel but for this sine.
fn near_dead_point(sine: Option<f64>) -> Found {
    let of = listed("four_bar", "FourBar");
    let mut random = SmallRng::seed_from_u64(1963);
    let mut found = Found::default();
    for _ in 0..poses(300) {
        let theta4: f64 = random.random_range(-3.0..3.0);
        let theta3 = theta4 + sine.unwrap_or_else(|| random.random_range(0.3..1.0)).asin();
        let theta2 = theta4 + random.random_range(0.5..2.5);
        let mut length = || random.random_range(20.0..90.0);
        let plain = Arguments {
            parameters: [(); 4].map(|()| length()).to_vec(),
            // The unknowns, then the input.
            q: vec![theta3, theta4, theta2],
            rates: vec![0.3, -0.4, 1.5],
            accelerations: vec![0.2, 0.9, -0.7],
        };
        let three = Three {
            plain: given(of, &plain),
            rounded: given(same_as(scalars::rounded(), of), &plain.map(Rounded::from)),
            exact: given(same_as(scalars::doubled(), of), &plain.map(DoubleDouble::from)),
        };
        found.compare(&format!("four_bar at {sine:?}"), three);
    }
    found
}

/// The median bound is a small multiple of the median error, however near the dead point.
#[test]
fn bounds_are_tight() {
    for sine in [None, Some(1e-3), Some(1e-6), Some(1e-9)] {
        let found = near_dead_point(sine);
        println!("four-bar, sine {sine:?}");
        found.report(&["velocity", "acceleration"]);
        // In ulps: the bound, and its ratio to the error.
        for (name, bound, ratio) in [("velocity", 6.0, 14.0), ("acceleration", 18.0, 18.0)] {
            // The rate of the input is exact.
            let inexact: Vec<[f64; 2]> = found.ulps[name].iter().copied().filter(|pair| pair[1] > 0.0).collect();
            let [errors, bounds] = [0, 1].map(|kind| median(inexact.iter().map(|pair| pair[kind])));
            println!("    {name}: {errors:.3}, {bounds:.3}, {:.1}", bounds / errors);
            assert!(bounds <= bound, "{name}: {bounds} ulp");
            assert!(bounds <= ratio * errors, "{name}: {bounds} and {errors} ulp");
        }
    }
}
