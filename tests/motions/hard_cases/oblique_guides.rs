//! Guides that are upright or 0.05 degrees off an axis. Programs of analytic geometry intersect the line y = m x + k
//! with the rod's circle; m is 1.6e16 for an upright guide and amplifies every rounding error of an oblique one.

use linkage::{Slider, linkage};

use linkage_oracle::precise::{Scalar, big};

linkage! {
    /// A slider-crank whose guide is tilted; it passes the crank's pivot at the distance `c`.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism TiltedSliderCrank {
        param a = 40, b = 120, c = -20, tilt = 90deg;
        input theta2;
        unknown theta3, d;

        loop a@theta2 + b@theta3 = d@tilt + c@(tilt + 90deg);

        point Pin = a@theta2;
        point Piston = d@tilt + c@(tilt + 90deg);
    }
}

/// The intersection of circle and line y = m x + k: the larger root as a distance along the line from the foot of the
/// pivot.
fn by_slope(m: &TiltedSliderCrank, theta2: f64) -> f64 {
    let slope = m.tilt.tan();
    let foot = [-m.c * m.tilt.sin(), m.c * m.tilt.cos()];
    let k = foot[1] - slope * foot[0];
    let pin = [m.a * theta2.cos(), m.a * theta2.sin()];
    let (a, half) = (1.0 + slope * slope, slope * (k - pin[1]) - pin[0]);
    let c = pin[0] * pin[0] + (k - pin[1]).powi(2) - m.b * m.b;
    let root = (half * half - a * c).sqrt();
    let along = |x: f64| (x - foot[0]) * m.tilt.cos() + (slope * x + k - foot[1]) * m.tilt.sin();
    along((-half + root) / a).max(along((-half - root) / a))
}

#[test]
fn pistons() {
    for (degrees, least) in
        [(0.0, 0.0), (0.05, 0.0), (-0.05, 0.0), (89.95, 1e-12), (90.0, 1e-2), (-90.0, 1e-2), (90.05, 1e-12)]
    {
        let m = TiltedSliderCrank { tilt: f64::to_radians(degrees), ..TiltedSliderCrank::default() };
        let (mut ours, mut naive) = (0.0_f64, 0.0_f64);
        for step in 0..360 {
            let theta2 = f64::from(step).to_radians();
            let (sine, cosine) = (big(theta2) - big(m.tilt)).sin_cos();
            let across = big(m.a) * sine - big(m.c);
            let expected = big(m.a) * cosine + (big(m.b) * big(m.b) - &across * &across).sqrt();
            let pose = m.assemble(theta2, TiltedSliderCrankBranch { theta3_d: Slider::Far }).unwrap();
            ours = ours.max((big(pose.d) - &expected).double().abs() / (m.a + m.b));
            let slope = by_slope(&m, theta2);
            naive =
                naive.max(if slope.is_finite() { (big(slope) - &expected).double().abs() / (m.a + m.b) } else { 1.0 });
        }
        println!("{degrees} degrees: slope {naive:.1e}, emitted {ours:.1e}");
        assert!(ours <= 2.0 * f64::EPSILON, "{degrees}: {ours:e}");
        assert!(naive >= least, "{degrees}: {naive:e}");
    }
}
