//! Freudenstein's equation by the tangent of the half angle, t = (-B +- sqrt(B^2 - 4 A C)) / (2 A) (R. L. Norton,
//! "Design of Machinery", eq. 4.10b): where one root passes pi, A passes zero, and the other root loses all digits
//! though it is well conditioned.

use linkage::Elbow;

use linkage_oracle::precise::{Big, Scalar, big};

use linkage_gallery::norton_four_bar::*;

/// Directions of the output link by the half angle, in either precision.
fn half_angle<S: Clone>(
    [a, b, c, d]: [S; 4],
    (sine, cosine): (S, S),
    of: impl Fn(f64) -> S,
    [add, multiply, divide]: [fn(&S, &S) -> S; 3],
    root: fn(&S) -> S,
    atan2: fn(&S, &S) -> S,
) -> [S; 2] {
    let negate = |x: &S| multiply(x, &of(-1.0));
    let square = |x: &S| multiply(x, x);
    let (k1, k2) = (divide(&d, &a), divide(&d, &c));
    let sum = add(&add(&square(&a), &negate(&square(&b))), &add(&square(&c), &square(&d)));
    let k3 = divide(&sum, &multiply(&of(2.0), &multiply(&a, &c)));
    let big_a = add(&add(&cosine, &negate(&k1)), &add(&negate(&multiply(&k2, &cosine)), &k3));
    let big_b = multiply(&of(-2.0), &sine);
    let big_c = add(&add(&k1, &negate(&multiply(&add(&k2, &of(1.0)), &cosine))), &k3);
    let discriminant = add(&square(&big_b), &multiply(&of(-4.0), &multiply(&big_a, &big_c)));
    [1.0, -1.0].map(|sign| {
        let above = add(&negate(&big_b), &multiply(&of(sign), &root(&discriminant)));
        multiply(&of(2.0), &atan2(&above, &multiply(&of(2.0), &big_a)))
    })
}

#[test]
fn the_other_root() {
    let m = NortonFourBar { a: 3.0_f64, b: 3.5, c: 2.5, d: 1.0 };
    let sides = [m.a, m.b, m.c, m.d];
    // Where theta4 = pi on one branch: (a cos + c - d)^2 + (a sin)^2 = b^2.
    let start = ((m.b * m.b - m.a * m.a - (m.c - m.d).powi(2)) / (2.0 * m.a * (m.c - m.d))).acos();
    let (mut worst, mut naive_worst) = (0.0_f64, 0.0_f64);
    for digits in 1..16 {
        let theta2 = start + 10_f64.powi(-digits);
        let angle = big(theta2).sin_cos();
        let operations: [fn(&Big, &Big) -> Big; 3] = [|x, y| x + y, |x, y| x * y, |x, y| x / y];
        let exact = half_angle(sides.map(big), angle, big, operations, |x| x.sqrt(), |y, x| y.atan2(x));
        let operations: [fn(&f64, &f64) -> f64; 3] = [|x, y| x + y, |x, y| x * y, |x, y| x / y];
        // The usual program: the arc tangent of the quotient.
        let naive = half_angle(sides, theta2.sin_cos(), |x| x, operations, |x| x.sqrt(), |y, x| (y / x).atan());
        let difference = |found: f64, exact: &Big| {
            let (sine, cosine) = (big(found) - exact).sin_cos();
            sine.atan2(&cosine).double().abs()
        };
        for (exact, naive) in exact.iter().zip(naive) {
            naive_worst = naive_worst.max(difference(naive, exact));
            let ours = [Elbow::Left, Elbow::Right].map(|theta3_theta4| {
                let pose = m.assemble(theta2, NortonFourBarBranch::new(theta3_theta4)).unwrap();
                difference(pose.coordinates().theta4, exact)
            });
            worst = worst.max(ours[0].min(ours[1]));
        }
    }
    println!("half angle {naive_worst:.1e}, emitted {worst:.1e}");
    assert!(worst <= 4.0 * f64::EPSILON, "{worst:e}");
    assert!(naive_worst >= 1e-3, "{naive_worst:e}");
}
