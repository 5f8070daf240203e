//! How names are shown: Greek letters, subscripts, dots.

/// What a name stands for, which tells how it is shown. Words are those of the language, such
/// as `theta3` or `z_t`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Name<'a> {
    /// The quantity itself: θ₃.
    Plain(&'a str),
    /// Its first derivative with respect to time: θ̇₃.
    Rate(&'a str),
    /// Its second derivative with respect to time: θ̈₃.
    Acceleration(&'a str),
    /// The velocity ratio ∂`of`/∂`by`.
    Ratio { of: &'a str, by: &'a str },
    /// The derivative of a velocity ratio, ∂²`of`/∂`by`∂`by`.
    RatioDerivative { of: &'a str, by: [&'a str; 2] },
    /// The determinant of a matrix.
    Determinant(&'a str),
    /// The inverse of a matrix.
    Inverse(&'a str),
}

/// Greek names, which are LaTeX's commands too, and their letters. Where there are two shapes, the
/// plain name has the letter of running text and `var` the other.
const GREEK: [(&str, char); 55] = [
    ("alpha", 'α'),
    ("beta", 'β'),
    ("gamma", 'γ'),
    ("delta", 'δ'),
    ("epsilon", 'ε'),
    ("zeta", 'ζ'),
    ("eta", 'η'),
    ("theta", 'θ'),
    ("iota", 'ι'),
    ("kappa", 'κ'),
    ("lambda", 'λ'),
    ("mu", 'μ'),
    ("nu", 'ν'),
    ("xi", 'ξ'),
    ("omicron", 'ο'),
    ("pi", 'π'),
    ("rho", 'ρ'),
    ("sigma", 'σ'),
    ("tau", 'τ'),
    ("upsilon", 'υ'),
    ("phi", 'φ'),
    ("chi", 'χ'),
    ("psi", 'ψ'),
    ("omega", 'ω'),
    ("varepsilon", 'ϵ'),
    ("vartheta", 'ϑ'),
    ("varkappa", 'ϰ'),
    ("varpi", 'ϖ'),
    ("varrho", 'ϱ'),
    ("varsigma", 'ς'),
    ("varphi", 'ϕ'),
    ("Alpha", 'Α'),
    ("Beta", 'Β'),
    ("Gamma", 'Γ'),
    ("Delta", 'Δ'),
    ("Epsilon", 'Ε'),
    ("Zeta", 'Ζ'),
    ("Eta", 'Η'),
    ("Theta", 'Θ'),
    ("Iota", 'Ι'),
    ("Kappa", 'Κ'),
    ("Lambda", 'Λ'),
    ("Mu", 'Μ'),
    ("Nu", 'Ν'),
    ("Xi", 'Ξ'),
    ("Omicron", 'Ο'),
    ("Pi", 'Π'),
    ("Rho", 'Ρ'),
    ("Sigma", 'Σ'),
    ("Tau", 'Τ'),
    ("Upsilon", 'Υ'),
    ("Phi", 'Φ'),
    ("Chi", 'Χ'),
    ("Psi", 'Ψ'),
    ("Omega", 'Ω'),
];

/// The Greek letters that LaTeX lacks, as the Latin letters that they look like.
const LOOK_LATIN: [(&str, char); 14] = [
    ("omicron", 'o'),
    ("Alpha", 'A'),
    ("Beta", 'B'),
    ("Epsilon", 'E'),
    ("Zeta", 'Z'),
    ("Eta", 'H'),
    ("Iota", 'I'),
    ("Kappa", 'K'),
    ("Mu", 'M'),
    ("Nu", 'N'),
    ("Omicron", 'O'),
    ("Rho", 'P'),
    ("Tau", 'T'),
    ("Chi", 'X'),
];

/// `theta3_left` in parts: `theta`, `3` and `left`.
#[derive(Debug, Clone, Copy)]
pub(super) struct Word<'a> {
    pub(super) base: &'a str,
    digits: &'a str,
    rest: &'a str,
}

impl<'a> Word<'a> {
    pub(super) fn new(name: &'a str) -> Self {
        let name = name.strip_prefix("r#").unwrap_or(name);
        let start = name.trim_start_matches('_');
        if start.is_empty() {
            return Self { base: name, digits: "", rest: "" };
        }
        let (first, rest) = start.split_once('_').unwrap_or((start, ""));
        let base = first.trim_end_matches(|c: char| c.is_ascii_digit());
        if base.is_empty() {
            return Self { base: first, digits: "", rest };
        }
        Self { base, digits: &first[base.len()..], rest }
    }

    /// The number at its end and the words behind underscores.
    pub(super) fn subscripts(self) -> impl Iterator<Item = &'a str> + Clone {
        core::iter::once(self.digits).chain(self.rest.split('_')).filter(|part| !part.is_empty())
    }
}

impl<'a> Name<'a> {
    /// A name that is a single word, with its dots.
    pub(super) fn word(text: &'a str) -> Self {
        match (text.strip_suffix("''"), text.strip_suffix('\'')) {
            (Some(name), _) => Self::Acceleration(name),
            (_, Some(name)) => Self::Rate(name),
            _ => Self::Plain(text),
        }
    }

    /// ∂(…)
    pub(super) fn derivative(arguments: &'a str) -> Option<Self> {
        let (of, by) = arguments.split_once(", ")?;
        Some(match by.split_once(", ") {
            Some((first, second)) => Self::RatioDerivative { of, by: [first, second] },
            None => Self::Ratio { of, by },
        })
    }
}

/// As many primes, if that many are written.
pub(super) fn primes(order: usize) -> Option<&'static str> {
    ["", "′", "″", "‴"].get(order).copied()
}

/// The Greek letter of this name, or of this letter itself.
pub(super) fn greek(word: &str) -> Option<(&'static str, char)> {
    if !word.is_ascii() {
        let mut letters = word.chars();
        let (letter, rest) = (letters.next()?, letters.next());
        return GREEK.iter().copied().find(|&(_, sign)| rest.is_none() && sign == letter);
    }
    GREEK.iter().copied().find(|&(name, _)| name == word)
}

/// What LaTeX lacks of the Greek letters, by their names.
pub(super) fn latin(greek: &str) -> Option<char> {
    LOOK_LATIN.iter().find(|(name, _)| *name == greek).map(|(_, letter)| *letter)
}

pub(super) fn is_number(word: &str) -> bool {
    word.bytes().all(|byte| byte.is_ascii_digit())
}
