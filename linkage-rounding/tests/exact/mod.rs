//! Operations in 400 bits.

use dashu_float::FBig;
use dashu_float::round::mode::HalfEven;

pub type Big = FBig<HalfEven, 2>;

const PRECISION: usize = 400;

/// A double, exactly.
pub fn big(value: f64) -> Big {
    Big::try_from(value).expect("a finite number").with_precision(PRECISION).value()
}

pub fn double(value: &Big) -> f64 {
    value.to_f64().value()
}

fn exp(x: &Big) -> Big {
    x.exp()
}

/// None outside the domain.
pub fn evaluate(name: &str, x: &Big, y: &Big) -> Option<Big> {
    let (zero, one, two) = (big(0.0), big(1.0), big(2.0));
    let is_sine = || -one.clone() <= *x && *x <= one;
    Some(match name {
        "add" => x + y,
        "sub" => x - y,
        "mul" => x * y,
        "div" if *y != zero => x / y,
        "rem" if *y != zero => {
            let count = (x / y).trunc();
            x - count * y
        }
        "mul_add" => x * y + x,
        "sqrt" if *x >= zero => x.sqrt(),
        "hypot" => (x * x + y * y).sqrt(),
        "atan2" if *x != zero || *y != zero => x.atan2(y),
        "sin" => x.sin(),
        "cos" => x.cos(),
        "tan" => x.sin() / x.cos(),
        "asin" if is_sine() => x.asin(),
        "acos" if is_sine() => x.acos(),
        "atan" => x.atan(),
        "exp" => exp(x),
        "exp_m1" => exp(x) - one,
        "exp2" => exp(&(x * two.ln())),
        "ln" if *x > zero => x.ln(),
        "ln_1p" if *x > -one.clone() => (x + one).ln(),
        "log2" if *x > zero => x.ln() / two.ln(),
        "log10" if *x > zero => x.ln() / big(10.0).ln(),
        "sinh" => (exp(x) - one / exp(x)) / two,
        "cosh" => (exp(x) + one / exp(x)) / two,
        "tanh" => {
            let square = exp(&(x * two));
            (&square - &one) / (square + one)
        }
        "asinh" => {
            let size = if *x < zero { -x.clone() } else { x.clone() };
            let value = (&size + (&size * &size + one).sqrt()).ln();
            if *x < zero { -value } else { value }
        }
        "atanh" if -one.clone() < *x && *x < one => ((&one + x) / (&one - x)).ln() / two,
        // By the logarithm: 390 bits remain.
        "cbrt" if *x > zero => exp(&(x.ln() / big(3.0))),
        "powf" if *x > zero => exp(&(x.ln() * y)),
        _ => return None,
    })
}
