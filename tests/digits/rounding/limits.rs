//! Limits of an input in closed form: that of the given lengths is within the bound, and the value has the bits of `f64`.

use std::f64::consts::TAU;

use linkage::limits::Limit;
use linkage::{Elbow, linkage};
use linkage_oracle::precise::{Scalar, big};
use linkage_rounding::Rounded;
use rand::rngs::SmallRng;
use rand::{Rng, SeedableRng};

use crate::rounding::every_function::median;

linkage! {
    mechanism Rocking {
        param a, b, c, d;
        input v;
        unknown p, r;
        loop a@v + b@p = d@0 + c@r;
        derive limits;
    }
}

/// Four-bars of decimal lengths, from any position and from one whose links are in line within rounding error.
#[test]
fn limits_of_decimal_four_bars() {
    let mut random = SmallRng::seed_from_u64(12);
    let mut ratios = Vec::new();
    while ratios.len() < 2000 {
        let lengths = [0; 4].map(|_| f64::from(random.random_range(1..60)) / 10.0);
        let [a, b, c, d] = lengths;
        let v = if random.random_bool(0.5) { random.random_range(-3.0..3.0) } else { 0.0 };
        let (plain, rounded) = (Rocking::<f64>::from(lengths), Rocking::<Rounded>::from(lengths.map(Rounded::from)));
        let branch = RockingBranch::new(Elbow::Left);
        let Ok(of_doubles) = plain.limits(v, branch) else { continue };
        let found = rounded.limits(Rounded::from(v), branch).unwrap();
        for (found, of_doubles) in [(found.lower, of_doubles.lower), (found.upper, of_doubles.upper)] {
            let (Limit::Exact { input: found, .. }, Limit::Exact { input: of_doubles, .. }) = (found, of_doubles)
            else {
                assert_eq!(found.input().is_none(), of_doubles.input().is_none());
                continue;
            };
            assert_eq!(found.value().to_bits(), of_doubles.to_bits(), "{lengths:?} at {v}");
            // D^2 = a^2 + d^2 - 2 a d cos v is (b + c)^2 or (b - c)^2.
            let [a, b, c, d] = [a, b, c, d].map(big);
            let offs = [&b + &c, &b - &c].map(|reach| {
                let cosine = (&a * &a + &d * &d - &reach * &reach) / (big(2.0) * &a * &d);
                let sine = big(1.0) - &cosine * &cosine;
                let sine = if sine > big(0.0) { sine.sqrt() } else { big(0.0) };
                let (x, y) = linkage_oracle::precise::direction(&big(found.value()));
                // The angle to the nearer of the two inputs of this cosine.
                let off = |sine| (&cosine * &y - &sine * &x, &cosine * &x + &sine * &y);
                let angles = [off(sine.clone()), off(-sine)].map(|(y, x)| y.double().atan2(x.double()).abs() % TAU);
                angles[0].min(angles[1])
            });
            let off = offs[0].min(offs[1]);
            assert!(off <= found.error() * (1.0 + 1e-12) + 1e-24, "{found:?} is off by {off:e}: {lengths:?} at {v}");
            if off > 0.0 {
                ratios.push(found.error() / off);
            }
        }
    }
    let ratio = median(ratios.iter().copied());
    println!("{} limits, median of bound / error {ratio:.1}", ratios.len());
    assert!(ratio < 100.0, "{ratio}");
}
