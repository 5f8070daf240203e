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
        "exp" => x.exp(),
        "exp_m1" => x.exp_m1(),
        "exp2" => (x * two.ln()).exp(),
        "ln" if *x > zero => x.ln(),
        "ln_1p" if *x > -one.clone() => x.ln_1p(),
        "log2" if *x > zero => x.ln() / two.ln(),
        "powf" if *x > zero => (x.ln() * y).exp(),
        _ => return None,
    })
}
