//! Numbers to seven significant digits.

/// The significant digits with which a number is printed.
const DIGITS: i32 = 7;

/// A number to seven significant digits.
pub(crate) fn number(value: f64) -> String {
    if !value.is_finite() {
        let text = if value.is_nan() { "not a number" } else { "∞" };
        return format!("{}{text}", if value < 0.0 { "−" } else { "" });
    }
    let (sign, digits, exponent) = digits(value);
    let sign = if sign { "−" } else { "" };
    let power = |exponent: i32| format!("·10{}", exponent.to_string().chars().map(superscript).collect::<String>());
    format!("{sign}{digits}{}", exponent.map_or_else(String::new, power))
}

/// A number to seven significant digits as LaTeX.
pub(crate) fn latex(value: f64) -> String {
    if !value.is_finite() {
        let text = if value.is_nan() { "\\text{not a number}" } else { "\\infty" };
        return format!("{}{text}", if value < 0.0 { "-" } else { "" });
    }
    let (sign, digits, exponent) = digits(value);
    let power = exponent.map_or_else(String::new, |exponent| format!(" \\cdot 10^{{{exponent}}}"));
    format!("{}{digits}{power}", if sign { "-" } else { "" })
}

/// True for a negative number, its digits with the point, and the power of ten by which these are multiplied.
fn digits(value: f64) -> (bool, String, Option<i32>) {
    if value == 0.0 {
        return (false, "0".to_owned(), None);
    }
    let scientific = format!("{:.*e}", (DIGITS - 1) as usize, value.abs());
    let (mantissa, exponent) = scientific.split_once('e').unwrap_or((&scientific, "0"));
    let exponent: i32 = exponent.parse().unwrap_or(0);
    let trim = |text: &str| {
        if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text.to_owned() }
    };
    if (-4..DIGITS + 2).contains(&exponent) {
        let places = (DIGITS - 1 - exponent).max(0) as usize;
        (value < 0.0, trim(&format!("{:.places$}", value.abs())), None)
    } else {
        (value < 0.0, trim(mantissa), Some(exponent))
    }
}

/// A digit or a minus as a superscript.
fn superscript(c: char) -> char {
    const DIGITS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    c.to_digit(10).map_or('⁻', |digit| DIGITS[digit as usize])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_seven_digits() {
        let shown =
            [80.0, -0.349_065_850_4, 0.0, 123_456_789.0, 1.5e-7, -2e300, f64::NAN, f64::NEG_INFINITY, 0.1 + 0.2];
        let expected = ["80", "−0.3490659", "0", "123456789", "1.5·10⁻⁷", "−2·10³⁰⁰", "not a number", "−∞", "0.3"];
        assert_eq!(shown.map(number), expected);
        assert_eq!([-1.5e-7, 80.25, f64::INFINITY].map(latex), ["-1.5 \\cdot 10^{-7}", "80.25", "\\infty"]);
    }
}
