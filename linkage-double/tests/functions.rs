//! Every function against 60-digit arithmetic, to 2 ulp; and what nalgebra builds on them.

use std::collections::BTreeMap;

use linkage_double::DoubleDouble;
use nalgebra::{ComplexField, RealField};

/// By `functions.py`.
const VALUES: &str = include_str!("functions.txt");

/// The largest relative error allowed, in 2^-104.
const ALLOWED: f64 = 2.0;

fn evaluate(name: &str, x: DoubleDouble, y: DoubleDouble) -> DoubleDouble {
    match name {
        "add" => x + y,
        "mul" => x * y,
        "div" => x / y,
        "powf" => x.powf(y),
        "atan2" => x.atan2(y),
        "hypot" => x.hypot(y),
        "sqrt" => x.sqrt(),
        "cbrt" => x.cbrt(),
        "sin" => x.sin(),
        "cos" => x.cos(),
        "tan" => x.tan(),
        "asin" => x.asin(),
        "acos" => x.acos(),
        "exp" => x.exp(),
        "exp_m1" => x.exp_m1(),
        "ln" => x.ln(),
        "ln_1p" => x.ln_1p(),
        "sinh" => x.sinh(),
        "cosh" => x.cosh(),
        "tanh" => x.tanh(),
        "asinh" => x.asinh(),
        "acosh" => x.acosh(),
        "atanh" => x.atanh(),
        other => panic!("{other}"),
    }
}

#[test]
fn functions_have_their_digits() {
    let mut worst = BTreeMap::<&str, f64>::new();
    for line in VALUES.lines() {
        let mut words = line.split(' ');
        let name = words.next().unwrap();
        let numbers: Vec<f64> = words.map(|word| word.parse().unwrap()).collect();
        let (arguments, value) = numbers.split_at(numbers.len() - 3);
        let argument =
            |i: usize| arguments.get(i..i + 2).map_or(DoubleDouble::from(0.0), |p| DoubleDouble::sum(p[0], p[1]));
        let found = evaluate(name, argument(0), argument(2));
        let error = found - DoubleDouble::sum(value[0], value[1]) - DoubleDouble::from(value[2]);
        let relative = (error.high() / value[0]).abs() / DoubleDouble::EPSILON.high();
        let largest = worst.entry(name).or_default();
        // A value that is not a number is worst of all.
        *largest = if relative.is_nan() { f64::INFINITY } else { largest.max(relative) };
    }
    println!("{worst:?}");
    for (name, relative) in worst {
        assert!(relative <= ALLOWED, "{name}: {relative} of 2^-104");
    }
}

#[test]
fn constants_are_those_of_the_functions() {
    let one = DoubleDouble::from(1.0);
    let close =
        |a: DoubleDouble, b: DoubleDouble| assert!((a - b).abs() <= DoubleDouble::EPSILON * 8.0.into(), "{a} {b}");
    close(DoubleDouble::pi(), one.atan() * 4.0.into());
    close(DoubleDouble::e(), one.exp());
    close(DoubleDouble::ln_2(), DoubleDouble::from(2.0).ln());
    close(DoubleDouble::ln_10(), DoubleDouble::from(10.0).ln());
    close(DoubleDouble::frac_2_pi() * DoubleDouble::frac_pi_2(), one);
    close(DoubleDouble::frac_2_sqrt_pi() * DoubleDouble::pi().sqrt(), 2.0.into());
    close(DoubleDouble::log2_e() * DoubleDouble::ln_2(), one);
    close(DoubleDouble::frac_pi_3().cos(), 0.5.into());
    close(DoubleDouble::frac_pi_6().sin(), 0.5.into());
}

#[test]
fn what_has_no_value_is_no_finite_number() {
    let (zero, one) = (DoubleDouble::from(0.0), DoubleDouble::from(1.0));
    let huge = DoubleDouble::from(1e300);
    for value in [
        one / zero,
        zero / zero,
        (-one).sqrt(),
        huge * huge,
        (-one).ln(),
        zero.ln(),
        huge.exp(),
        huge.sin(),
        f64::NAN.into(),
    ] {
        assert!(!value.is_finite(), "{value}");
    }
    assert_eq!(DoubleDouble::from(-1e4).exp(), zero);
    assert!((-zero).is_sign_negative() && (-zero).atan2(-one) == -DoubleDouble::pi());
}

#[test]
fn integers_and_rounding() {
    let number = |high: f64, low: f64| DoubleDouble::sum(high, low);
    assert_eq!(number(3.0, -1e-20).floor(), 2.0.into());
    assert_eq!(number(3.0, 1e-20).ceil(), 4.0.into());
    assert_eq!(number(-2.5, 0.0).round(), (-3.0).into());
    assert_eq!(number(2.5, -1e-20).round(), 2.0.into());
    assert_eq!(number(7.25, 1e-20).fract(), number(0.25, 1e-20));
    assert_eq!(number(7.5, 0.0) % 2.0.into(), 1.5.into());
    assert_eq!(DoubleDouble::from(2.0).powi(-40).high(), 2.0_f64.powi(-40));
    let odd: DoubleDouble = nalgebra::convert::<f64, DoubleDouble>(0.1) * 3.0.into();
    assert_eq!(odd.to_string(), "0.30000000000000004 -2.7755575615628914e-17");
    assert_eq!(
        <DoubleDouble as num_traits::FromPrimitive>::from_i64(i64::MAX).unwrap(),
        number(2.0_f64.powi(63), -1.0)
    );
}
