//! Names as symbols of FPCore, which are ASCII.

use std::collections::BTreeSet;

/// The constants and words of FPCore that a name could be.
const RESERVED: [&str; 62] = [
    "E",
    "LOG2E",
    "LOG10E",
    "LN2",
    "LN10",
    "PI",
    "PI_2",
    "PI_4",
    "M_1_PI",
    "M_2_PI",
    "M_2_SQRTPI",
    "SQRT2",
    "SQRT1_2",
    "INFINITY",
    "NAN",
    "TRUE",
    "FALSE",
    "FPCore",
    "if",
    "let",
    "while",
    "for",
    "tensor",
    "array",
    "cast",
    "fabs",
    "fma",
    "exp",
    "exp2",
    "expm1",
    "log",
    "log10",
    "log2",
    "log1p",
    "pow",
    "sqrt",
    "cbrt",
    "hypot",
    "sin",
    "cos",
    "tan",
    "asin",
    "acos",
    "atan",
    "atan2",
    "sinh",
    "cosh",
    "tanh",
    "erf",
    "erfc",
    "tgamma",
    "lgamma",
    "ceil",
    "floor",
    "fmod",
    "remainder",
    "fmax",
    "fmin",
    "and",
    "or",
    "not",
    "round",
];

/// The names that no symbol may have.
pub(super) fn reserved() -> BTreeSet<String> {
    RESERVED.into_iter().map(str::to_owned).collect()
}

/// A text in ASCII: Greek letters by their names, others by their numbers.
pub(super) fn ascii(text: &str) -> String {
    let mut ascii = String::new();
    for letter in text.chars() {
        match greek_name(letter) {
            _ if letter.is_ascii() => ascii.push(letter),
            Some(name) => ascii += &name,
            None => ascii += &format!("u{:x}", u32::from(letter)),
        }
    }
    ascii
}

/// A name as a symbol of FPCore.
pub(super) fn symbol(name: &str) -> String {
    let mut symbol = ascii(name.trim_start_matches("r#"));
    // A symbol does not begin with a digit.
    if symbol.starts_with(|first: char| first.is_ascii_digit()) || symbol.is_empty() {
        symbol.insert(0, '_');
    }
    symbol
}

/// The Greek letters from α to ω in the order of Unicode.
const GREEK: [&str; 25] = [
    "alpha", "beta", "gamma", "delta", "epsilon", "zeta", "eta", "theta", "iota", "kappa", "lambda", "mu", "nu", "xi",
    "omicron", "pi", "rho", "varsigma", "sigma", "tau", "upsilon", "phi", "chi", "psi", "omega",
];

/// Their second shapes.
const VARIANTS: [(char, &str); 6] =
    [('ϵ', "varepsilon"), ('ϰ', "varkappa"), ('ϕ', "varphi"), ('ϖ', "varpi"), ('ϱ', "varrho"), ('ϑ', "vartheta")];

/// The name of a Greek letter.
fn greek_name(letter: char) -> Option<String> {
    let index =
        |first: char| u32::from(letter).checked_sub(u32::from(first)).and_then(|index| usize::try_from(index).ok());
    let small = index('α').and_then(|index| GREEK.get(index)).map(|name| (*name).to_owned());
    // No capital letter has the place of the final sigma.
    let capital = index('Α').and_then(|index| GREEK.get(index)).filter(|name| **name != "varsigma");
    let capital = capital.map(|name| name[..1].to_uppercase() + &name[1..]);
    let variant = VARIANTS.iter().find(|(sign, _)| *sign == letter).map(|(_, name)| (*name).to_owned());
    small.or(capital).or(variant)
}

#[cfg(test)]
mod tests {
    use super::{ascii, symbol};

    #[test]
    fn greek_letters_have_names() {
        assert_eq!(ascii("Α α Ρ ς Σ σ Ω ω ϑ"), "Alpha alpha Rho varsigma Sigma sigma Omega omega vartheta");
        assert_eq!(ascii("\u{3a2} ά"), "u3a2 u3ac");
    }

    #[test]
    fn symbols_are_ascii() {
        for (name, text) in
            [("theta3", "theta3"), ("θ3", "theta3"), ("länge", "lu e4nge"), ("r#type", "type"), ("data_0", "data_0")]
        {
            assert_eq!(symbol(name), text.replace(' ', ""));
        }
    }
}
