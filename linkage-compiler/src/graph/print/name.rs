//! How names are shown: Greek letters, subscripts, dots.

use super::mathml::escape;
use super::unicode::{Shift, dotted, shifted};
use super::{Formula, Notation};

/// What a symbol stands for, which tells how it is shown. Names are those of the language, such
/// as `theta3` or `z_t`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Name<'a> {
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
    /// The determinant of J, or of the block of J with this number.
    Determinant(Option<usize>),
    /// The inverse of J, or of the block of J with this number.
    Inverse(Option<usize>),
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
struct Split<'a> {
    base: &'a str,
    subscripts: Vec<&'a str>,
}

impl<'a> Split<'a> {
    fn new(name: &'a str) -> Self {
        let name = name.strip_prefix("r#").unwrap_or(name);
        let mut parts = name.split('_').filter(|part| !part.is_empty());
        let first = parts.next().unwrap_or(name);
        let base = first.trim_end_matches(|c: char| c.is_ascii_digit());
        let (base, digits) = if base.is_empty() { (first, "") } else { first.split_at(base.len()) };
        let subscripts = Some(digits).filter(|digits| !digits.is_empty()).into_iter().chain(parts).collect();
        Self { base, subscripts }
    }
}

impl<'a> Name<'a> {
    /// The name that is shown.
    pub(super) fn subject(self) -> &'a str {
        match self {
            Self::Plain(name)
            | Self::Rate(name)
            | Self::Acceleration(name)
            | Self::Ratio { of: name, .. }
            | Self::RatioDerivative { of: name, .. } => name,
            Self::Determinant(_) | Self::Inverse(_) => "J",
        }
    }

    /// The name in every notation.
    #[must_use]
    pub fn formula(self) -> Formula {
        Formula { unicode: self.unicode(), latex: self.latex(), mathml: self.mathml() }
    }

    /// The name in one notation.
    #[must_use]
    pub fn write(self, notation: Notation) -> String {
        match notation {
            Notation::Unicode => self.unicode(),
            Notation::Latex => self.latex(),
            Notation::MathMl => self.mathml(),
        }
    }

    pub(super) fn unicode(self) -> String {
        match self {
            Self::Plain(name) => unicode(name, ""),
            Self::Rate(name) => unicode(name, "\u{307}"),
            Self::Acceleration(name) => unicode(name, "\u{308}"),
            Self::Ratio { of, by } => format!("∂{}/∂{}", unicode(of, ""), unicode(by, "")),
            Self::RatioDerivative { of, by: [first, second] } => {
                let (of, first, second) = (unicode(of, ""), unicode(first, ""), unicode(second, ""));
                if first == second {
                    format!("∂²{of}/∂{first}²")
                } else {
                    format!("∂²{of}/∂{first}∂{second}")
                }
            }
            Self::Determinant(block) => format!("det {}", unicode(&block_name(block), "")),
            Self::Inverse(block) => format!("{}⁻¹", unicode(&block_name(block), "")),
        }
    }

    pub(super) fn latex(self) -> String {
        match self {
            Self::Plain(name) => latex(name, ""),
            Self::Rate(name) => latex(name, "\\dot"),
            Self::Acceleration(name) => latex(name, "\\ddot"),
            Self::Ratio { of, by } => {
                format!("\\frac{{\\partial {}}}{{\\partial {}}}", latex(of, ""), latex(by, ""))
            }
            Self::RatioDerivative { of, by: [first, second] } => {
                let (of, first, second) = (latex(of, ""), latex(first, ""), latex(second, ""));
                let below = if first == second {
                    format!("\\partial {{{first}}}^2")
                } else {
                    format!("\\partial {first} \\partial {second}")
                };
                format!("\\frac{{\\partial^2 {of}}}{{{below}}}")
            }
            Self::Determinant(block) => format!("\\det {}", latex(&block_name(block), "")),
            Self::Inverse(block) => format!("{}^{{-1}}", latex(&block_name(block), "")),
        }
    }

    pub(super) fn mathml(self) -> String {
        match self {
            Self::Plain(name) => mathml(name, ""),
            Self::Rate(name) => mathml(name, "˙"),
            Self::Acceleration(name) => mathml(name, "¨"),
            Self::Ratio { of, by } => {
                let side = |name| format!("<mrow><mo>∂</mo>{}</mrow>", mathml(name, ""));
                format!("<mfrac>{}{}</mfrac>", side(of), side(by))
            }
            Self::RatioDerivative { of, by: [first, second] } => {
                let (of, first, second) = (mathml(of, ""), mathml(first, ""), mathml(second, ""));
                let square = |body: &str| format!("<msup>{body}<mn>2</mn></msup>");
                let below = if first == second {
                    square(&format!("<mrow>{first}</mrow>"))
                } else {
                    format!("{first}<mo>∂</mo>{second}")
                };
                let above = square("<mo>∂</mo>");
                format!("<mfrac><mrow>{above}{of}</mrow><mrow><mo>∂</mo>{below}</mrow></mfrac>")
            }
            Self::Determinant(block) => {
                format!(
                    "<mrow><mi>det</mi><mo rspace=\"0.17em\">\u{2061}</mo>{}</mrow>",
                    mathml(&block_name(block), "")
                )
            }
            Self::Inverse(block) => {
                let name = mathml(&block_name(block), "");
                format!("<msup>{name}<mrow><mo>−</mo><mn>1</mn></mrow></msup>")
            }
        }
    }
}

fn block_name(block: Option<usize>) -> String {
    block.map_or_else(|| "J".to_owned(), |block| format!("J{block}"))
}

/// The Greek letter of this name, or of this letter itself.
fn greek(word: &str) -> Option<(&'static str, char)> {
    if !word.is_ascii() {
        let mut letters = word.chars();
        let (letter, rest) = (letters.next()?, letters.next());
        return GREEK.iter().copied().find(|&(_, sign)| rest.is_none() && sign == letter);
    }
    // No name is a single letter, and most words are.
    (word.len() > 1).then(|| GREEK.iter().copied().find(|&(name, _)| name == word))?
}

fn is_number(word: &str) -> bool {
    word.bytes().all(|byte| byte.is_ascii_digit())
}

fn unicode(name: &str, dots: &str) -> String {
    let Split { base, subscripts } = Split::new(name);
    let word = |word: &str| greek(word).map_or_else(|| word.to_owned(), |(_, letter)| letter.to_string());
    let mut text = dotted(&word(base), dots);
    for (index, subscript) in subscripts.into_iter().enumerate() {
        // Few letters have a form below the line: words stand behind an underscore.
        if index == 0 && is_number(subscript) {
            text += &shifted(subscript, Shift::Down);
        } else {
            text.push('_');
            text += &word(subscript);
        }
    }
    text
}

fn latex(name: &str, accent: &str) -> String {
    let word = |word: &str| match greek(word) {
        Some((name, _)) => match LOOK_LATIN.iter().find(|(other, _)| *other == name) {
            Some((_, letter)) => format!("\\mathrm{{{letter}}}"),
            None => format!("\\{name}"),
        },
        None if is_number(word) || word.chars().count() == 1 => word.to_owned(),
        None => format!("\\mathrm{{{word}}}"),
    };
    let Split { base, subscripts } = Split::new(name);
    let base = if accent.is_empty() { word(base) } else { format!("{accent}{{{}}}", word(base)) };
    match subscripts.as_slice() {
        [] => base,
        [digit] if digit.len() == 1 && is_number(digit) => format!("{base}_{digit}"),
        many => {
            let many: Vec<_> = many.iter().map(|subscript| word(subscript)).collect();
            format!("{base}_{{{}}}", many.join(","))
        }
    }
}

fn mathml(name: &str, accent: &str) -> String {
    let word = |word: &str| match greek(word) {
        Some((_, letter)) => format!("<mi>{letter}</mi>"),
        None if is_number(word) => format!("<mn>{word}</mn>"),
        None => format!("<mi>{}</mi>", escape(word)),
    };
    let Split { base, subscripts } = Split::new(name);
    let base = if accent.is_empty() { word(base) } else { format!("<mover>{}<mo>{accent}</mo></mover>", word(base)) };
    match subscripts.as_slice() {
        [] => base,
        [one] => format!("<msub>{base}{}</msub>", word(one)),
        many => {
            let many: Vec<_> = many.iter().map(|subscript| word(subscript)).collect();
            format!("<msub>{base}<mrow>{}</mrow></msub>", many.join("<mo>,</mo>"))
        }
    }
}
