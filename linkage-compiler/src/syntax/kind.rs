//! The kinds of statements, and the keywords that begin them.

use proc_macro2::Ident;
use syn::ext::IdentExt;
use syn::parse::ParseStream;
use syn::{Path, Token};

use super::expression::ExpressionId;
use super::scene::{self, Body, Scene};
use crate::diagnostics::{Region, nearest};

/// The construct that an attribute belongs to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Bearer {
    /// A mechanism; `cfg` applies to all its items.
    Mechanism,
    /// A part of a mechanism that becomes a type or a parameter field.
    Item,
    /// A field of types that the macro defines.
    Field,
    /// A part that becomes no item or field; it accepts doc comments for readers of the source.
    Part,
}

/// A coordinate that a statement declares.
pub struct Declared {
    pub name: Ident,
    pub range: Option<Range>,
}

/// The least and the largest value of a coordinate or an output; at least one is given.
pub struct Range {
    pub ends: [Option<ExpressionId>; 2],
    /// The tokens after `in`.
    pub region: Region,
}

impl From<Ident> for Declared {
    fn from(name: Ident) -> Self {
        Self { name, range: None }
    }
}

/// The kind and the content of a statement.
pub enum StatementKind {
    Parameters(Vec<(Ident, Option<ExpressionId>)>),
    Inputs(Vec<Declared>),
    Unknowns(Vec<Declared>),
    Coordinates(Vec<Declared>),
    Drive {
        name: Ident,
        by: Vec<Ident>,
    },
    /// `is_implied` if it follows from the other equations.
    Loop {
        left: ExpressionId,
        right: ExpressionId,
        is_implied: bool,
    },
    Equation {
        left: ExpressionId,
        right: ExpressionId,
        is_implied: bool,
    },
    Let {
        name: Ident,
        value: ExpressionId,
    },
    Point {
        name: Ident,
        value: ExpressionId,
    },
    Output {
        name: Ident,
        range: Option<Range>,
        value: ExpressionId,
    },
    /// A user function: its path, its arguments, and the names of its value and derivatives.
    External {
        path: Path,
        arguments: Vec<Ident>,
        names: Vec<Ident>,
    },
    Derive(Vec<Ident>),
    Body(Body),
    Scene(Scene),
    /// A point or an output whose keyword is missing.
    Quantity {
        name: Ident,
        value: ExpressionId,
    },
    /// A statement with a syntax error: its names; `is_list` if it may be a list of coordinates, `is_extern` if it
    /// declares functions.
    Unread {
        names: Vec<Ident>,
        is_list: bool,
        is_extern: bool,
    },
}

impl StatementKind {
    /// The kind of construct that its attributes belong to.
    pub(super) fn bearer(&self) -> Bearer {
        match self {
            Self::Parameters(_) | Self::Drive { .. } | Self::Scene(_) => Bearer::Item,
            Self::Inputs(_) | Self::Unknowns(_) | Self::Coordinates(_) | Self::Point { .. } | Self::Output { .. } => {
                Bearer::Field
            }
            Self::Loop { .. }
            | Self::Equation { .. }
            | Self::Let { .. }
            | Self::External { .. }
            | Self::Derive(_)
            | Self::Quantity { .. }
            | Self::Unread { .. }
            | Self::Body(_) => Bearer::Part,
        }
    }
}

/// The words that begin a statement.
pub const KEYWORDS: [&str; 15] = [
    "param",
    "input",
    "unknown",
    "coordinate",
    "drive",
    "loop",
    "equation",
    "implied",
    "let",
    "point",
    "output",
    "extern",
    "derive",
    "body",
    "scene",
];

/// Words that are written for a keyword.
const SYNONYMS: [(&str, &[&str]); 14] = [
    (
        "param",
        &["parameter", "parameters", "const", "static", "constant", "constants", "length", "lengths", "dimensions"],
    ),
    ("input", &["driver", "drivers", "motor", "actuator", "independent", "dof"]),
    ("unknown", &["variable", "variables", "var", "vars", "dependent", "angle", "angles"]),
    ("coordinate", &["coord", "coords", "variable", "variables", "dofs"]),
    ("drive", &["driver", "drivers", "driven", "drives"]),
    ("loop", &["chain", "close", "vector", "constraint", "constraints"]),
    ("equation", &["constraint", "constraints", "eq", "eqn", "constrain"]),
    ("let", &["def", "define", "set", "where"]),
    ("point", &["joint", "pin", "node", "position", "pt"]),
    ("output", &["out", "result", "return", "measure", "print", "show"]),
    ("extern", &["fn", "function"]),
    ("derive", &["request"]),
    ("body", &["bodies", "link", "mass"]),
    ("scene", &["dynamics", "simulation", "simulate"]),
];

/// The keywords that may be meant by another word, the most similar first.
pub(super) fn meant(word: &str) -> Vec<&'static str> {
    let synonyms = SYNONYMS.iter().filter(|(_, words)| words.contains(&word)).map(|(keyword, _)| *keyword);
    let mut meant: Vec<&'static str> = synonyms.collect();
    if meant.is_empty() {
        meant.extend(nearest(word, KEYWORDS));
    }
    meant
}

/// Words after which an expression ends.
const PREPOSITIONS: [&str; 8] = ["on", "at", "between", "and", "in", "by", "of", "restitution"];

/// True for words that do not begin a factor: a statement, an effect or a property begins, or an expression ends.
pub(super) fn is_reserved(word: &str) -> bool {
    let words = || KEYWORDS.into_iter().chain(scene::EFFECTS).chain(scene::PROPERTIES).chain(PREPOSITIONS);
    words().any(|reserved| reserved == word)
}

/// True before an attribute, and before a keyword that begins a statement.
pub(super) fn at_keyword(stream: ParseStream) -> bool {
    (stream.peek(Token![#]) && stream.peek2(syn::token::Bracket)) || at_word(stream, &KEYWORDS)
}

/// True before one of these words, unless it is a name: a sign that follows a name comes next.
pub(super) fn at_word(stream: ParseStream, words: &[&str]) -> bool {
    let ahead = stream.fork();
    let at_word = ahead.call(Ident::parse_any).is_ok_and(|found| words.iter().any(|word| found == word));
    let goes_on = !(ahead.is_empty() || ahead.peek(Token![;]) || ahead.peek(Token![,]) || ahead.peek(Token![=]));
    at_word && goes_on
}
