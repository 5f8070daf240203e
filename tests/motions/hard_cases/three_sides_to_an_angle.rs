//! Three sides to an angle by the law of cosines: acos((p^2 + q^2 - d^2) / (2 p q)) of a flat or a pointed triangle
//! loses half of the digits, and then all. W. Kahan, "Miscalculating Area and Angles of a Needle-like Triangle"
//! (2014), gives the accurate formula, which here is evaluated as the reference.

use linkage::Elbow;

use super::relative;
use super::triangle::{Triangle, TriangleBranch, TriangleInputs};
use linkage_oracle::precise::{Big, Scalar, big};

/// The angle between sides p and q across d.
fn exact(p: f64, q: f64, d: f64) -> Big {
    let [p, q, d] = [p, q, d].map(big);
    let low = (&p + &q) * (&p + &q) - &d * &d;
    let high = &d * &d - (&p - &q) * (&p - &q);
    // tan(angle / 2) = sqrt(high / low)
    big(2.0) * high.sqrt().atan2(&low.sqrt())
}

/// The angle at the apex from the determinant of the dyad: |V x W| = p q sin, V . W = -p q cos.
fn emitted(p: f64, q: f64, d: f64) -> f64 {
    let m = Triangle { p, q };
    let pose = m.assemble(TriangleInputs { x: d, y: 0.0 }, TriangleBranch { alpha_beta: Elbow::Left }).unwrap();
    (pose.determinant.abs() / (p * q)).atan2(-(pose.alpha.re * pose.beta.re + pose.alpha.im * pose.beta.im))
}

fn law_of_cosines(p: f64, q: f64, d: f64) -> f64 {
    ((p * p + q * q - d * d) / (2.0 * p * q)).acos()
}

#[test]
fn pointed() {
    for (digits, least) in [(4, 1e-10), (6, 1e-6), (8, 0.1)] {
        let d = 10_f64.powi(-digits);
        let expected = exact(1.0, 1.0, d);
        let (ours, naive) =
            (relative(emitted(1.0, 1.0, d), &expected), relative(law_of_cosines(1.0, 1.0, d), &expected));
        println!("1, 1, {d:e}: law of cosines {naive:.1e}, emitted {ours:.1e}");
        assert!(ours <= 4.0 * f64::EPSILON && naive >= least, "{d:e}: {ours:e} {naive:e}");
    }
}

#[test]
fn stretched() {
    for digits in [6, 8, 10, 12, 14] {
        let (p, q) = (3.0, 4.0);
        let d = p + q - 10_f64.powi(-digits);
        let beyond = |angle: f64| std::f64::consts::PI - angle;
        let expected = linkage_oracle::precise::pi() - exact(p, q, d);
        // The difference of the angle from pi, which its double no longer resolves, is in the determinant.
        let m = Triangle { p, q };
        let pose = m.assemble(TriangleInputs { x: d, y: 0.0 }, TriangleBranch { alpha_beta: Elbow::Left }).unwrap();
        let ours = relative((pose.determinant.abs() / (p * q)).asin(), &expected);
        let naive = relative(beyond(law_of_cosines(p, q, d)), &expected);
        println!("3, 4, 7 - 1e-{digits}: law of cosines {naive:.1e}, emitted {ours:.1e}");
        assert!(ours <= 4.0 * f64::EPSILON, "{ours:e}");
        assert!(naive >= 1e-17 * 10_f64.powi(digits), "{naive:e}");
        assert!(expected.double() > 0.0);
    }
}
