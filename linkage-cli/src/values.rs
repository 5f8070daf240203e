//! Values in arguments: `l2=25`, `theta2=60deg`, `theta2=pi/3`, `theta3_theta4=left`.

use std::f64::consts::TAU;
use std::str::FromStr;

use linkage_compiler::budget::Budget;
use linkage_compiler::graph::{Graph, Number};
use linkage_compiler::syntax::Unit;
use proc_macro2::{Delimiter, TokenStream, TokenTree};
use syn::Lit;

/// A number as the language writes it: `25`, `-0.5`, `60deg`, `12rpm`, or an expression of numbers, such as `pi/6`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Value {
    pub number: f64,
    /// True if it was written without a unit.
    pub is_plain: bool,
    /// The quantities that its unit measures.
    pub measures: Option<&'static str>,
}

impl Value {
    /// The number as an angle. One without a unit is in radians, and more than a turn is not meant, as in the language.
    pub fn angle(self, name: &str) -> Result<f64, String> {
        let Self { number, is_plain, measures } = self;
        if measures == Some(Unit::TurnsPerMinute.of()) {
            return Err(format!("`{name}` is an angle, and `rpm` is a unit of speeds: write such as `60deg`"));
        }
        let is_meant = !is_plain || number.abs() <= TAU;
        is_meant.then_some(number).ok_or_else(|| {
            format!("`{name}` is an angle, and {number} radians are more than a turn: write `{number}deg`")
        })
    }
}

impl Value {
    /// The number as a length, which has the unit of all lengths.
    pub fn length(self, name: &str) -> Result<f64, String> {
        match self.measures {
            None => Ok(self.number),
            Some(what) => Err(format!("`{name}` is a length, and this is a unit of {what}: write a plain number")),
        }
    }

    /// The number as a parameter that is the rate of an angle, in radians per second without a unit.
    pub fn rate_of_angle(self, name: &str) -> Result<f64, String> {
        match self.measures {
            Some(what) if what == Unit::Degrees.of() => {
                Err(format!("`{name}` is a speed, and this is a unit of {what}: write such as `45rpm`"))
            }
            _ => Ok(self.number),
        }
    }

    /// The number as one that is neither an angle nor a length.
    pub fn plain(self, name: &str) -> Result<f64, String> {
        match self.measures {
            None => Ok(self.number),
            Some(what) => Err(format!("`{name}` is a plain number, and this is a unit of {what}")),
        }
    }

    /// The number as the rate of an angle, or of something that is no angle, such as `a length`.
    pub fn rate(self, of: &str, kind: &str, is_angle: bool) -> Result<f64, String> {
        match self.measures {
            Some(what) if what == Unit::Degrees.of() => {
                Err(format!("--rate is a speed, and this is a unit of {what}: write such as `45rpm`"))
            }
            Some(what) if !is_angle => Err(format!("`{of}` is {kind}, and this is a unit of {what} of rotation")),
            _ => Ok(self.number),
        }
    }
}

/// A name and its number.
#[derive(Debug, Clone, PartialEq)]
pub struct Assignment {
    pub name: String,
    pub value: Value,
}

/// A name and one of the words that it can be.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Choice {
    pub name: String,
    pub word: String,
}

impl FromStr for Value {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let no_number = || not_a_number(text);
        let (is_negative, positive) = text.strip_prefix('-').map_or((false, text), |rest| (true, rest));
        // A literal can have a sign of its own.
        let literal = positive.starts_with(|first: char| first.is_ascii_digit()).then(|| syn::parse_str(positive));
        let (digits, unit) = match literal {
            Some(Ok(Lit::Int(number))) => (number.base10_digits().to_owned(), number.suffix().to_owned()),
            Some(Ok(Lit::Float(number))) => (number.base10_digits().to_owned(), number.suffix().to_owned()),
            _ => return expression(text),
        };
        let is_plain = unit.is_empty();
        let unit = match unit.as_str() {
            "" => Unit::None,
            name => Unit::ALL.into_iter().find(|(unit, _)| *unit == name).ok_or_else(no_number)?.1,
        };
        let number = Number::parse(&digits).ok_or_else(no_number)?;
        // As the compiler reads a default: one rounding error.
        let value = unit.share_of_pi().map_or(Some(number.to_f64()), |share| {
            let mut graph = Graph::default();
            let pi = graph.pi();
            let node = graph.scale(number.multiply(Number::ratio(1, share)), pi);
            graph.as_number(node).map(Number::to_f64).or_else(|| graph.constant_value(node))
        });
        let value = value.filter(|value| value.is_finite()).ok_or_else(|| format!("`{text}` is too large"))?;
        let measures = (!is_plain).then(|| unit.of());
        Ok(Self { number: if is_negative { -value } else { value }, is_plain, measures })
    }
}

fn not_a_number(text: &str) -> String {
    format!("`{text}` is not a number: write one such as `25`, `-0.5`, `60deg`, `12rpm` or `pi/6`")
}

/// The value of an expression, as the compiler reads the default of a parameter.
fn expression(text: &str) -> Result<Value, String> {
    let no_number = || not_a_number(text);
    let tokens: Vec<TokenTree> = text.parse::<TokenStream>().map_err(|_| no_number())?.into_iter().collect();
    let is_first_sign = |token: &TokenTree| matches!(token, TokenTree::Punct(sign) if sign.as_char() == '-');
    let is_allowed = |token: &TokenTree| match token {
        TokenTree::Punct(sign) => "+-*/^.".contains(sign.as_char()),
        TokenTree::Group(group) => group.delimiter() == Delimiter::Parenthesis,
        TokenTree::Ident(_) | TokenTree::Literal(_) => true,
    };
    // A sign has a number after it.
    let begins = match tokens.as_slice() {
        [sign, first, ..] if is_first_sign(sign) => !matches!(first, TokenTree::Punct(_)),
        [first, ..] => !matches!(first, TokenTree::Punct(_)),
        [] => false,
    };
    if !begins || !tokens.iter().all(is_allowed) {
        return Err(no_number());
    }
    let mechanism = format!("mechanism Number {{ param number = {text}; input x; output product = number * x; }}");
    let mechanisms = linkage_compiler::text::read(&mechanism, &Budget::default()).map_err(|_| no_number())?;
    let graph = mechanisms.first().map(|mechanism| &mechanism.graph).ok_or_else(no_number)?;
    let default = mechanisms[0].parameters.iter().find_map(|parameter| parameter.default).ok_or_else(no_number)?;
    let value = graph.as_number(default).map(Number::to_f64).or_else(|| graph.constant_value(default));
    let number = value.filter(|value| value.is_finite()).ok_or_else(no_number)?;
    Ok(Value { number, is_plain: !text.contains(char::is_alphabetic), measures: None })
}

/// The two sides of the first `=`.
fn sides<'t>(text: &'t str, example: &str) -> Result<[&'t str; 2], String> {
    let sides = text.split_once('=').map(|(name, value)| [name, value].map(str::trim));
    let sides = sides.filter(|sides| sides.iter().all(|side| !side.is_empty()));
    sides.ok_or_else(|| format!("write NAME=VALUE, as in `{example}`"))
}

impl FromStr for Assignment {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let [name, value] = sides(text, "l2=25")?;
        Ok(Self { name: name.to_owned(), value: value.parse()? })
    }
}

impl FromStr for Choice {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let [name, word] = sides(text, "theta3_theta4=left")?;
        Ok(Self { name: name.to_owned(), word: word.to_owned() })
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;

    fn value(text: &str) -> Result<f64, String> {
        text.parse().map(|value: Value| value.number)
    }

    /// The bits are those of a default in a text.
    #[test]
    fn numbers_are_read_as_defaults_are() {
        for text in ["25", "0.1", "-0.5", "1e-3", "60deg", "-90deg", "12rpm", "1.5rad", "180deg", "0deg", "7.3deg"] {
            let mechanism = format!("mechanism M {{ param a = {text}; input x; output product = a * x; }}");
            let mechanism = linkage_compiler::read(mechanism.parse().unwrap()).unwrap().remove(0);
            let node = mechanism.parameters.iter().next().and_then(|parameter| parameter.default).unwrap();
            let graph = &mechanism.graph;
            let default = graph.as_number(node).map(Number::to_f64).or_else(|| graph.constant_value(node));
            assert_eq!(value(text).map(f64::to_bits), Ok(default.unwrap().to_bits()), "{text}");
        }
        assert_eq!(value("180deg"), Ok(PI));
    }

    #[test]
    fn plain_angles_are_at_most_a_turn() {
        let angle = |text: &str| text.parse::<Value>().and_then(|value| value.angle("theta"));
        assert_eq!([angle("6"), angle("400deg"), angle("-1.5")].map(|angle| angle.is_ok()), [true; 3]);
        assert_eq!(
            angle("360"),
            Err("`theta` is an angle, and 360 radians are more than a turn: write `360deg`".to_owned())
        );
    }

    /// An expression is that of a default as well.
    #[test]
    fn expressions_are_numbers() {
        for (text, expected) in [
            ("pi/6", PI / 6.0),
            ("2*pi", TAU),
            ("-pi/2", -PI / 2.0),
            ("2*3", 6.0),
            ("(1 + 2)/4", 0.75),
            ("sqrt(4)", 2.0),
        ] {
            assert_eq!(value(text), Ok(expected), "{text}");
        }
        let angle = |text: &str| text.parse::<Value>().and_then(|value| value.angle("theta"));
        assert_eq!([angle("4*pi").is_ok(), angle("4*90deg").is_ok(), angle("4*90").is_ok()], [true, true, false]);
    }

    #[test]
    fn what_is_no_number() {
        for text in [
            "", "-", "x", "25mm", "6O", "nan", "inf", "1;2", "2*", "2*x", "1,2", "2 3", "{2}", "'a'", "--5", "+5",
            "1e999",
        ] {
            assert!(value(text).is_err(), "{text}: {:?}", value(text));
        }
        for text in ["l2", "=", "l2=", "=5", "l2=x"] {
            assert!(text.parse::<Assignment>().is_err(), "{text}");
        }
        let [one, other] = ["l2=25", "l2 = 25"].map(|text| text.parse::<Assignment>());
        assert!(one.is_ok() && one == other);
    }
}
