//! Two circles that nearly touch: the half chord sqrt(r1^2 - a^2) with a = (r1^2 - r2^2 + d^2) / (2 d), as in P. Bourke
//! ("Circles and spheres", 1997) and most programs, loses half of the digits, and then all.

use linkage::Elbow;

use super::relative;
use super::triangle::{Triangle, TriangleBranch, TriangleInputs};
use linkage_oracle::precise::{Scalar, big};

const BRANCH: TriangleBranch = TriangleBranch { alpha_beta: Elbow::Left };

/// The distance of the intersection from the line of the centres; the centres along x, along y and across both.
#[test]
fn half_chords() {
    let (p, q) = (1.5, 0.75);
    let mut naive_worst = 0.0_f64;
    for inside in [false, true] {
        for digits in [2, 4, 6, 8, 10, 12, 14] {
            let gap = 10_f64.powi(-digits);
            let d = if inside { p - q + gap } else { p + q - gap };
            let turned = [[d, 0.0], [0.0, d], [0.6 * d, 0.8 * d], [-0.8 * d, 0.6 * d]];
            for [x, y] in turned {
                let [bp, bq, bx, by] = [p, q, x, y].map(big);
                let square = &bx * &bx + &by * &by;
                let twice = ((&bp + &bq) * (&bp + &bq) - &square) * (&square - (&bp - &bq) * (&bp - &bq));
                let expected = twice.sqrt() / (big(2.0) * square.sqrt());
                let d = x.hypot(y);
                let a = (p * p - q * q + d * d) / (2.0 * d);
                let naive = relative((p * p - a * a).sqrt(), &expected);
                let pose = Triangle { p, q }.assemble(TriangleInputs { x, y }, BRANCH).unwrap();
                let ours = relative(pose.determinant.abs() / d, &expected);
                println!("gap 1e-{digits} at ({x:.3}, {y:.3}): naive {naive:.1e}, emitted {ours:.1e}");
                assert!(ours <= 4.0 * f64::EPSILON, "{ours:e}");
                // Along an axis, where d is the given number.
                if x == 0.0 || y == 0.0 {
                    naive_worst = naive_worst.max(naive);
                }
                assert!(expected.double() > 0.0);
            }
        }
    }
    assert!(naive_worst >= 1e-3, "{naive_worst:e}");
}
