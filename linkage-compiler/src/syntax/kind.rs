//! The kinds of statements, and the keywords that begin them.

use proc_macro2::Ident;
use syn::Path;

use super::attributes::Bearer;
use super::expression::ExpressionId;
use super::scene::{Body, Scene};

/// The kind and the content of a statement.
pub enum StatementKind {
    Parameters(Vec<(Ident, Option<ExpressionId>)>),
    Inputs(Vec<Ident>),
    Unknowns(Vec<Ident>),
    Coordinates(Vec<Ident>),
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
    /// A statement with a syntax error: its names; `is_list` if it may be a list of coordinates.
    Unread {
        names: Vec<Ident>,
        is_list: bool,
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

pub(super) const KEYWORDS: [&str; 15] = [
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
