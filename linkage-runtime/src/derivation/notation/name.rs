//! The names of symbols: Greek letters, subscripts, dots.

/// A symbol with its role, which decides how it is printed. Names are those of the `linkage!` language, such as
/// `theta3` or `z_t`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Name<'a> {
    /// The quantity itself: θ₃.
    Plain(&'a str),
    /// Its first derivative with respect to time: θ̇₃.
    Rate(&'a str),
    /// Its second derivative with respect to time: θ̈₃.
    Acceleration(&'a str),
    /// The velocity ratio ∂`of`/∂`by`.
    Ratio {
        /// The quantity.
        of: &'a str,
        /// The variable.
        by: &'a str,
    },
    /// The derivative of a velocity ratio, ∂²`of`/∂`by`∂`by`.
    RatioDerivative {
        /// The quantity.
        of: &'a str,
        /// The variables.
        by: [&'a str; 2],
    },
    /// The determinant of the matrix with this name: det J.
    Determinant(&'a str),
    /// The inverse of the matrix with this name: J⁻¹.
    Inverse(&'a str),
}

impl Name<'_> {
    /// True if it is printed as a fraction of differentials.
    #[must_use]
    pub fn is_derivative(self) -> bool {
        matches!(self, Self::Ratio { .. } | Self::RatioDerivative { .. })
    }
}

/// Greek names, which are also LaTeX commands, and their letters, sorted by name. Where a letter has two shapes, the
/// plain name has that of running text and `var…` the other.
const GREEK: [(&str, char); 55] = [
    ("Alpha", 'Α'),
    ("Beta", 'Β'),
    ("Chi", 'Χ'),
    ("Delta", 'Δ'),
    ("Epsilon", 'Ε'),
    ("Eta", 'Η'),
    ("Gamma", 'Γ'),
    ("Iota", 'Ι'),
    ("Kappa", 'Κ'),
    ("Lambda", 'Λ'),
    ("Mu", 'Μ'),
    ("Nu", 'Ν'),
    ("Omega", 'Ω'),
    ("Omicron", 'Ο'),
    ("Phi", 'Φ'),
    ("Pi", 'Π'),
    ("Psi", 'Ψ'),
    ("Rho", 'Ρ'),
    ("Sigma", 'Σ'),
    ("Tau", 'Τ'),
    ("Theta", 'Θ'),
    ("Upsilon", 'Υ'),
    ("Xi", 'Ξ'),
    ("Zeta", 'Ζ'),
    ("alpha", 'α'),
    ("beta", 'β'),
    ("chi", 'χ'),
    ("delta", 'δ'),
    ("epsilon", 'ε'),
    ("eta", 'η'),
    ("gamma", 'γ'),
    ("iota", 'ι'),
    ("kappa", 'κ'),
    ("lambda", 'λ'),
    ("mu", 'μ'),
    ("nu", 'ν'),
    ("omega", 'ω'),
    ("omicron", 'ο'),
    ("phi", 'φ'),
    ("pi", 'π'),
    ("psi", 'ψ'),
    ("rho", 'ρ'),
    ("sigma", 'σ'),
    ("tau", 'τ'),
    ("theta", 'θ'),
    ("upsilon", 'υ'),
    ("varepsilon", 'ϵ'),
    ("varkappa", 'ϰ'),
    ("varphi", 'ϕ'),
    ("varpi", 'ϖ'),
    ("varrho", 'ϱ'),
    ("varsigma", 'ς'),
    ("vartheta", 'ϑ'),
    ("xi", 'ξ'),
    ("zeta", 'ζ'),
];

/// The Greek letters without a LaTeX command, and the Latin letters of the same shape.
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

/// The parts of a name: `theta3_left` is `theta`, `3` and `left`.
#[derive(Debug, Clone, Copy)]
pub struct Word<'a> {
    /// The letters: `theta`.
    pub base: &'a str,
    digits: &'a str,
    rest: &'a str,
}

impl<'a> Word<'a> {
    /// Divides a name.
    #[must_use]
    pub fn new(name: &'a str) -> Self {
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

    /// The number at the end of the base, and the parts after underscores.
    pub fn subscripts(self) -> impl Iterator<Item = &'a str> + Clone {
        core::iter::once(self.digits).chain(self.rest.split('_')).filter(|part| !part.is_empty())
    }
}

/// The primes of a derivative of this order, up to three.
#[must_use]
pub fn primes(order: u32) -> Option<&'static str> {
    ["", "′", "″", "‴"].get(order as usize).copied()
}

/// The Greek letter of this name, or of this letter itself.
#[must_use]
pub fn greek(word: &str) -> Option<(&'static str, char)> {
    if !word.is_ascii() {
        let mut letters = word.chars();
        let (letter, rest) = (letters.next()?, letters.next());
        return GREEK.iter().copied().find(|&(_, sign)| rest.is_none() && sign == letter);
    }
    GREEK.binary_search_by_key(&word, |&(name, _)| name).ok().map(|place| GREEK[place])
}

/// A Greek letter with a number, such as `theta3`, as its name and its number.
#[must_use]
pub fn numbered_greek(word: &str) -> Option<(&str, &str)> {
    let name = word.trim_end_matches(|c: char| c.is_ascii_digit());
    (name.len() < word.len() && greek(name).is_some()).then(|| word.split_at(name.len()))
}

/// The Latin letter for a Greek letter without a LaTeX command.
#[must_use]
pub fn latin(greek: &str) -> Option<char> {
    LOOK_LATIN.iter().find(|(name, _)| *name == greek).map(|(_, letter)| *letter)
}

/// True for digits.
#[must_use]
pub fn is_number(word: &str) -> bool {
    word.bytes().all(|byte| byte.is_ascii_digit())
}
