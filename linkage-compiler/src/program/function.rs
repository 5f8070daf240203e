//! Functions as data: a name, a doc comment, arguments, named results, and statements.

use std::collections::BTreeMap;
use std::ops::Range;

use linkage_ir::Operations;

use super::expression::{Expression, Pattern, Statement, Type};
use super::pose::Given;
use crate::derivation::Step;
use crate::graph::{NodeId, SymbolId};
use crate::ids::GroupId;

pub use linkage_ir::code::{Access, Argument, Function, Passed};

/// The body of a function: statements, at most one kernel among them, and a value.
#[derive(Debug, Clone, Default)]
pub struct Body {
    pub before: Vec<Statement>,
    pub kernel: Option<Kernel>,
    pub after: Vec<Statement>,
    pub value: Value,
    /// The preferred names of local values that statements after the kernel define.
    pub locals: Vec<String>,
    /// Operations besides those of the kernel.
    pub operations: Operations,
}

/// The value that a function returns.
#[derive(Debug, Clone)]
pub enum Value {
    /// A value; in a fallible function it is wrapped in `Ok`.
    Plain(Expression),
    /// The `Result` of another function.
    Result(Expression),
    /// The `Result` in a variable that holds a literal.
    Stored(Box<Stored>),
}

/// A literal in the `Ok` of a variable, with zero in place of each result of the kernel. Lowering assigns a result to its
/// member as soon as it is known.
#[derive(Debug, Clone)]
pub struct Stored {
    /// The variable.
    pub result: Expression,
    /// The members that are results, each with its value.
    pub members: Vec<(Expression, Expression)>,
    pub literal: Expression,
}

impl Value {
    /// The expression that the function returns.
    pub fn returned(&self) -> &Expression {
        match self {
            Self::Plain(value) | Self::Result(value) => value,
            Self::Stored(stored) => &stored.result,
        }
    }

    /// The value by its members.
    pub fn literal(&self) -> &Expression {
        match self {
            Self::Plain(value) | Self::Result(value) => value,
            Self::Stored(stored) => &stored.literal,
        }
    }
}

impl Default for Value {
    fn default() -> Self {
        Self::Plain(Expression::Tuple(Vec::new()))
    }
}

/// Formulas that a function evaluates, in the order of their steps.
#[derive(Debug, Clone, Default)]
pub struct Kernel {
    pub sources: Vec<Source>,
    /// The argument with the name of the mechanism in errors; `None` stands for `Self::NAME`.
    pub error_name: Option<String>,
    /// True if sines and cosines come from a pose.
    pub is_on_pose: bool,
    /// For a kernel over numbers of any kind: pi and the user functions, which are given.
    pub any_number: Option<Given>,
    pub steps: Vec<Step>,
    pub results: Vec<Output>,
    /// The index of each angle with a given turn, in the list of turns.
    pub turns: BTreeMap<SymbolId, usize>,
    pub failure: Failure,
    /// Results that are checked, and are finite only if everything that they are computed from is: that needs no check.
    pub conclusive: Range<usize>,
    /// Results that may be not finite: the values of user functions, for a lane alone. A coordinate, a rate or an
    /// acceleration that needs one is then not finite either, and a quantity that needs one is missing in its column.
    pub external: Range<usize>,
    /// For each result the RRR dyad, if any, whose well-conditioned triangle guarantees that it is finite.
    pub dyads: Vec<Option<GroupId>>,
}

/// The consequence of a failed check in a kernel.
#[derive(Debug, Clone, Default)]
pub enum Failure {
    /// It returns the error.
    #[default]
    Error,
    /// It returns this value: a call that finds the error, or the results in another way.
    Return(Expression),
    /// It computes all the same, without branches, and says at the end whether all checks passed.
    Flag,
}

/// A result of a kernel.
#[derive(Debug, Clone)]
pub struct Output {
    pub node: NodeId,
    /// Its name; a result without name is written inline where it is used.
    pub name: Option<String>,
}

/// A source of symbols of a kernel: an expression that a pattern takes apart.
#[derive(Debug, Clone)]
pub struct Source {
    /// The expression.
    pub from: Expression,
    pub shape: Shape,
}

/// The pattern that takes a source apart.
#[derive(Debug, Clone)]
pub enum Shape {
    Symbol(SymbolId),
    /// `_`
    Ignored,
    /// The fields of a type; `is_whole` if these are all.
    Fields {
        of: Type,
        fields: Vec<(String, Shape)>,
        is_whole: bool,
    },
    List(Vec<Shape>),
    Tuple(Vec<Shape>),
}

impl Shape {
    pub fn fields(of: Type, fields: impl IntoIterator<Item = (String, SymbolId)>, is_whole: bool) -> Self {
        let fields = fields.into_iter().map(|(field, symbol)| (field, Self::Symbol(symbol)));
        Self::Fields { of, fields: fields.collect(), is_whole }
    }

    /// The symbols that it takes out of the source.
    pub fn symbols(&self) -> Vec<SymbolId> {
        match self {
            Self::Symbol(symbol) => vec![*symbol],
            Self::Ignored => Vec::new(),
            Self::Fields { fields, .. } => fields.iter().flat_map(|(_, shape)| shape.symbols()).collect(),
            Self::List(shapes) | Self::Tuple(shapes) => shapes.iter().flat_map(Self::symbols).collect(),
        }
    }

    pub fn list(symbols: &[SymbolId]) -> Self {
        Self::List(symbols.iter().copied().map(Self::Symbol).collect())
    }

    /// The columns of a matrix with this number of rows.
    pub fn columns(rows: usize, symbols: &[SymbolId]) -> Self {
        Self::List(symbols.chunks(rows.max(1)).map(Self::list).collect())
    }
}

impl From<NodeId> for Output {
    fn from(node: NodeId) -> Self {
        Self { node, name: None }
    }
}

impl Output {
    pub fn named(node: NodeId, name: impl Into<String>) -> Self {
        Self { node, name: Some(name.into()) }
    }
}

impl Body {
    /// A body that only returns a value.
    pub fn plain(value: Expression) -> Self {
        Self { value: Value::Plain(value), ..Self::default() }
    }

    /// A body with a kernel and the value made of its results.
    pub fn of(kernel: Kernel, value: Expression) -> Self {
        Self { kernel: Some(kernel), value: Value::Plain(value), ..Self::default() }
    }

    /// A body that returns the `Result` of another function.
    pub fn result(value: Expression) -> Self {
        Self { value: Value::Result(value), ..Self::default() }
    }

    /// Adds a check that values are finite, after all other statements.
    #[must_use]
    pub fn checked(mut self, what: &str, values: impl IntoIterator<Item = Expression>) -> Self {
        let values = values.into_iter().collect();
        self.after.push(Statement::Check { what: what.to_owned(), values, detail: None });
        self
    }

    /// A new local value with this preferred name.
    pub fn local(&mut self, preferred: impl Into<String>) -> Expression {
        self.locals.push(preferred.into());
        Expression::Local(self.locals.len() - 1)
    }

    /// Binds a value to a new local name.
    pub fn bound(&mut self, preferred: impl Into<String>, value: Expression) -> Expression {
        self.locals.push(preferred.into());
        let index = self.locals.len() - 1;
        self.after.push(Statement::Let(Pattern::bound(index), value));
        Expression::Local(index)
    }
}

/// The results of a kernel in a range.
pub fn results(indices: std::ops::Range<usize>) -> Vec<Expression> {
    indices.map(Expression::Result).collect()
}
