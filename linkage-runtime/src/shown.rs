//! Numbers as people read them, with angles in degrees.

use core::fmt::{self, Display, Formatter, Write};

/// The significant digits of a number without a precision.
const DIGITS: usize = 7;

/// A value, an angle in degrees: `60°`, `28.95502°`, `0.25`. With a precision, as in `{:.2}`, it has that many decimals, else
/// seven digits without zeros at the end.
#[derive(Debug, Clone, Copy)]
pub struct Shown {
    /// The value, an angle in radians.
    pub value: f64,
    /// True for an angle.
    pub is_angle: bool,
}

impl Display for Shown {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let (value, unit) = if self.is_angle { (self.value.to_degrees(), "°") } else { (self.value, "") };
        match f.precision() {
            Some(decimals) => write!(f, "{value:.decimals$}{unit}"),
            None => write!(f, "{}{unit}", Digits(value)),
        }
    }
}

/// A number with seven digits, without zeros at the end.
struct Digits(f64);

impl Display for Digits {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Self(value) = *self;
        if value == 0.0 || !value.is_finite() {
            // No sign of a zero.
            return write!(f, "{}", value + 0.0);
        }
        let scientific = Text::of(format_args!("{value:.*e}", DIGITS - 1))?;
        let (mantissa, exponent) = scientific.as_str().split_once('e').unwrap_or_default();
        match exponent.parse::<isize>() {
            Ok(exponent @ -4..=8) => {
                let decimals = (DIGITS as isize - 1 - exponent).max(0).unsigned_abs();
                f.write_str(trimmed(Text::of(format_args!("{value:.decimals$}"))?.as_str()))
            }
            _ => write!(f, "{}e{exponent}", trimmed(mantissa)),
        }
    }
}

/// A number without the zeros at the end of its decimals.
fn trimmed(number: &str) -> &str {
    if number.contains('.') { number.trim_end_matches('0').trim_end_matches('.') } else { number }
}

/// A text of a few characters.
struct Text {
    bytes: [u8; 24],
    length: usize,
}

impl Text {
    fn of(arguments: fmt::Arguments<'_>) -> Result<Self, fmt::Error> {
        let mut text = Self { bytes: [0; 24], length: 0 };
        text.write_fmt(arguments)?;
        Ok(text)
    }

    fn as_str(&self) -> &str {
        self.bytes.get(..self.length).and_then(|written| str::from_utf8(written).ok()).unwrap_or_default()
    }
}

impl Write for Text {
    fn write_str(&mut self, part: &str) -> fmt::Result {
        let end = self.length + part.len();
        self.bytes.get_mut(self.length..end).ok_or(fmt::Error)?.copy_from_slice(part.as_bytes());
        self.length = end;
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::Shown;

    #[test]
    fn seven_digits_of_each_number() {
        let numbers = [
            (0.0, "0"),
            (-0.0, "0"),
            (80.0, "80"),
            (-0.349_065_850_4, "-0.3490659"),
            (0.1 + 0.2, "0.3"),
            (9.999_999_96, "10"),
            (99_999_999.6, "100000000"),
            (123_456_789.0, "123456789"),
            (1.5e-7, "1.5e-7"),
            (-2e300, "-2e300"),
            (0.000_123_456_789, "0.0001234568"),
            (f64::MIN_POSITIVE, "2.225074e-308"),
            (f64::NAN, "NaN"),
            (f64::NEG_INFINITY, "-inf"),
        ];
        for (value, expected) in numbers {
            assert_eq!(Shown { value, is_angle: false }.to_string(), expected);
        }
        let angle = Shown { value: core::f64::consts::FRAC_PI_3, is_angle: true };
        assert_eq!([angle.to_string(), format!("{angle:.2}")], ["60°", "60.00°"]);
    }
}
