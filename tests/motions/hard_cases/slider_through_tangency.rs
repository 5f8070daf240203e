//! A slider on a turning guide where the pin comes as near to the pivot as the guide passes it: the guide is tangent,
//! and both positions of the slider meet. sqrt(d^2 - c^2) loses all digits there; and where the guide goes through the
//! pivot itself, the angle as atan2 of the line jumps by pi when the slider passes the pivot.

use std::f64::consts::FRAC_PI_2;

use linkage::Slider;

use super::relative;
use linkage_oracle::precise::big;

use linkage_gallery::inverted_slider_crank::*;

fn branch(theta4_b: Slider) -> InvertedSliderCrankBranch {
    InvertedSliderCrankBranch::new(theta4_b)
}

/// The pin at the distance c + gap from the pivot.
#[test]
fn tangent() {
    let mut naive_worst = 0.0_f64;
    for digits in [2, 6, 10, 13] {
        let gap = 10_f64.powi(-digits);
        let m = InvertedSliderCrank { a: 60.0, c: 40.0, d: 100.0 + gap, gamma: FRAC_PI_2 };
        let distance = big(m.d) - big(m.a);
        // gamma is pi/2 as a double, and its cosine is not zero.
        let (sine, cosine) = big(m.gamma).sin_cos();
        let across = big(m.c) * sine;
        let expected = (&distance * &distance - &across * &across).sqrt() - big(m.c) * cosine;
        let rounded = ((m.d - m.a).powi(2) - m.c.powi(2)).sqrt();
        let pose = [Slider::Far, Slider::Near].map(|slider| m.assemble(0.0, branch(slider)).unwrap());
        let (ours, naive) = (relative(pose[0].b, &expected), relative(rounded, &expected));
        println!("gap 1e-{digits}: naive {naive:.1e}, emitted {ours:.1e}");
        assert!(ours <= 4.0 * f64::EPSILON, "{ours:e}");
        naive_worst = naive_worst.max(naive);
        // Both sides of the tangency: one direction of the guide to the angle between them, 2 b / c.
        assert!((pose[0].b + pose[1].b).abs() <= 2e-14);
        let angle = pose[0].theta4.angle_to(&pose[1].theta4);
        assert!((angle.abs() - 2.0 * (pose[0].b / m.c).atan()).abs() <= 1e-15, "{angle:e}");
    }
    assert!(naive_worst >= 1e-10, "{naive_worst:e}");
    // At the tangency itself there is one position; the branch determines the way on.
    let m = InvertedSliderCrank { a: 60.0, c: 40.0, d: 100.0, gamma: FRAC_PI_2 };
    for slider in [Slider::Far, Slider::Near] {
        let pose = m.assemble(0.0, branch(slider)).unwrap();
        assert_eq!(m.branch_of(&pose), branch(slider));
        assert!(pose.b.abs() <= 1e-14 && (pose.theta4.re + 1.0).abs() <= 1e-15, "{pose:?}");
        assert!(m.velocity_ratios(&pose).is_err());
    }
    // Nearer there is no position.
    assert!(InvertedSliderCrank { c: 40.0 + 1e-9, ..m }.assemble(0.0, branch(Slider::Far)).is_err());
}

/// The slider passes the pivot: with the side changed the guide's direction stays, and the modulus changes its sign.
#[test]
fn through_the_pivot() {
    let m = InvertedSliderCrank { a: 60.0_f64, c: 0.0, d: 60.0, gamma: 0.0 };
    let before = m.assemble(-1e-3, branch(Slider::Far)).unwrap();
    let after = m.assemble(1e-3, branch(Slider::Near)).unwrap();
    assert!(before.b > 0.0 && after.b < 0.0);
    assert!(before.theta4.angle_to(&after.theta4).abs() <= 2e-3);
    let naive = |theta2: f64| (m.a * theta2.sin()).atan2(m.a * theta2.cos() - m.d);
    let jump = (naive(1e-3) - naive(-1e-3)).abs();
    println!(
        "the arc tangent jumps by {jump:.3}, the emitted direction turns by {:.1e}",
        before.theta4.angle_to(&after.theta4)
    );
    assert!(jump > 3.0);
}
