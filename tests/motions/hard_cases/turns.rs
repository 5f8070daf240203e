//! A crank after a million turns: an angle reduced by the remainder of 2 pi as a double is wrong by a million times the
//! rounding error of 2 pi.

use std::f64::consts::TAU;

use linkage::Elbow;

use linkage_oracle::precise::{Big, Scalar, big};

use linkage_gallery::four_bar::*;

/// The direction of l3 on the left: V . D and D x V from two circles.
fn exact(m: &FourBar, theta2: f64) -> Big {
    let (sine, cosine) = big(theta2).sin_cos();
    let d = [big(m.l1) - big(m.l2) * cosine, -(big(m.l2) * sine)];
    let square = &d[0] * &d[0] + &d[1] * &d[1];
    let [p, q] = [big(m.l3), big(m.l4)];
    let low = (&p + &q) * (&p + &q) - &square;
    let high = &square - (&p - &q) * (&p - &q);
    let across = (low * high).sqrt();
    let along = &square + &p * &p - &q * &q;
    across.atan2(&along) + d[1].atan2(&d[0])
}

#[test]
fn positions_after_many_turns() {
    let m = FourBar::default();
    let branch = FourBarBranch::new(Elbow::Left);
    let (mut ours, mut naive) = (0.0_f64, 0.0_f64);
    for turns in [0.0, 1.0, 15_900.0, 16_000.0, 1e6, 1e9] {
        for step in 0..100 {
            let theta2 = f64::from(step) / 100.0 * TAU + turns * TAU;
            let expected = exact(&m, theta2);
            let error = |theta2: f64| {
                let found = m.assemble(theta2, branch).unwrap().theta3;
                let (sine, cosine) = expected.sin_cos();
                (sine * big(found.re) - cosine * big(found.im)).double().abs()
            };
            ours = ours.max(error(theta2));
            if turns <= 1e6 {
                naive = naive.max(error(theta2 % TAU));
            }
        }
    }
    println!("remainder {naive:.1e}, emitted {ours:.1e}");
    assert!(ours <= 8.0 * f64::EPSILON, "{ours:e}");
    assert!(naive >= 1e-11, "{naive:e}");
}
