//! The branch-free functions give the bits of the checked ones wherever their predicates hold.

use linkage_runtime::{Real, lane};
use num_dual::Dual64;

use crate::pairs::random;

macro_rules! lanes {
    ($name:ident, $float:ident, $bits:ident, $shift:literal) => {
        #[test]
        fn $name() {
            let bits = |value: $float| value.to_bits();
            // Random bits: every magnitude, infinities and NaN; and ordinary numbers.
            let any = random(1).map(|part| $float::from_bits(((part * 2f64.powi(53)) as u64 as $bits) << $shift));
            let plain = random(2).map(|part| (200.0 * part - 100.0) as $float);
            let extreme =
                [0.0, -0.0, $float::MIN_POSITIVE, $float::from_bits(1), $float::MAX, $float::INFINITY, $float::NAN];
            let numbers = any.zip(plain).take(5000).flat_map(|(a, b)| [a, b]).chain(extreme);
            let numbers: Vec<$float> = numbers.collect();
            let mut moderate = 0;
            for pair in numbers.windows(2).chain(numbers.windows(3)) {
                let (x, y) = (pair[0], pair[pair.len() - 1]);
                if lane::is_moderate(x) {
                    moderate += 1;
                    let (sine, cosine) = lane::sine_cosine(x);
                    let expected = x.sine_cosine();
                    assert_eq!([bits(sine), bits(cosine)], [bits(expected.0), bits(expected.1)], "{x:e}");
                    assert_eq!([bits(lane::sine(x)), bits(lane::cosine(x))], [bits(sine), bits(cosine)], "{x:e}");
                }
                if lane::has_arctangent2(y, x) {
                    assert_eq!(bits(lane::arctangent2(y, x)), bits(y.arctangent2(x)), "{y:e}, {x:e}");
                    // Near the library's, and so right.
                    let (found, expected) = (lane::arctangent2(y, x), y.atan2(x));
                    assert!((found - expected).abs() <= $float::EPSILON * expected.abs(), "{y:e}, {x:e}");
                }
                if lane::has_hypotenuse(x, y) {
                    assert_eq!(bits(lane::hypotenuse(x, y)), bits(x.hypotenuse(y)), "{x:e}, {y:e}");
                    let (found, expected) = (lane::hypotenuse(x, y), x.hypot(y));
                    assert!((found - expected).abs() <= 2.0 * $float::EPSILON * expected, "{y:e}, {x:e}");
                }
                if x.abs() <= 100.0 && y.abs() <= 100.0 && x.abs() >= 1e-6 {
                    assert!(lane::is_moderate(x) && lane::has_arctangent2(1.0, x) && lane::has_hypotenuse(x, y));
                    assert!(lane::has_arctangent2(0.0, x) && lane::has_arctangent2(x, -0.0));
                }
            }
            assert!(moderate > 10_000);
        }
    };
}

lanes!(doubles, f64, u64, 11);
lanes!(floats, f32, u32, 0);

/// Other scalars have their own functions, everywhere.
#[test]
fn other_scalars() {
    let (x, y) = (Dual64::new(1e9, 0.5), Dual64::new(0.0, 2.0));
    assert!(lane::is_moderate(x) && lane::has_arctangent2(y, y) && lane::has_hypotenuse(y, y));
    assert_eq!(lane::sine_cosine(x), x.sine_cosine());
    assert_eq!([lane::sine(x), lane::cosine(x)], [x.sine(), x.cosine()]);
    assert_eq!([lane::arctangent2(y, x), lane::hypotenuse(x, y)], [y.arctangent2(x), x.hypotenuse(y)]);
}
