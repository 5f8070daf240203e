//! Functions as data: a name, a description, arguments, named results, and statements.

use std::collections::BTreeMap;

use super::expression::{Expression, Pattern, Statement, Type};
use super::operations::Operations;
use crate::derivation::Step;
use crate::graph::{NodeId, SymbolId};
use crate::ids::BlockId;

/// A function of the emitted program, whose body is planned or lowered.
#[derive(Debug, Clone)]
pub struct Function<B> {
    pub name: String,
    /// The lines of its description.
    pub doc: Vec<String>,
    pub access: Access,
    /// True if it takes `&self`.
    pub is_method: bool,
    /// The other arguments.
    pub arguments: Vec<Argument>,
    pub returns: Type,
    /// True if it returns a `Result`.
    pub is_fallible: bool,
    /// Missing in a stub.
    pub body: Option<B>,
}

/// Who calls a function.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Access {
    Public,
    /// Mostly the library, by its traits: manuals leave it out.
    Hidden,
    /// Other emitted functions, which it may be inlined into.
    Inlined,
    /// The functions of scenes, which it is always inlined into, so that what they do not use costs nothing.
    Layer,
    /// Everybody, and the functions of scenes as a layer.
    PublicLayer,
    /// Other emitted functions, where something went wrong.
    Cold,
}

impl Access {
    pub fn is_public(self) -> bool {
        matches!(self, Self::Public | Self::Hidden | Self::PublicLayer)
    }
}

#[derive(Debug, Clone)]
pub struct Argument {
    pub name: String,
    pub passed: Passed,
}

/// How an argument is passed.
#[derive(Debug, Clone)]
pub enum Passed {
    /// `T`
    ByValue(Type),
    /// `&T`
    ByReference(Type),
    /// `impl Into<T>`
    Converted(Type),
    /// `&impl Turn<T>`, what gives angles their turns.
    Turns,
}

/// What a function does: statements, with one run of formulas among them, and a value.
#[derive(Debug, Clone, Default)]
pub struct Body {
    pub before: Vec<Statement>,
    pub kernel: Option<Kernel>,
    pub after: Vec<Statement>,
    pub value: Value,
    /// The wishes for the names of local values that statements after the kernel give.
    pub locals: Vec<String>,
    /// The functions whose work is part of that of this one.
    pub calls: Vec<String>,
    /// Work besides that of the kernel.
    pub operations: Operations,
}

/// What a function returns.
#[derive(Debug, Clone)]
pub enum Value {
    /// A value, of a fallible function inside `Ok`.
    Plain(Expression),
    /// The `Result` of another function.
    Result(Expression),
}

impl Default for Value {
    fn default() -> Self {
        Self::Plain(Expression::Tuple(Vec::new()))
    }
}

/// Formulas to be computed, in the order of their steps.
#[derive(Debug, Clone, Default)]
pub struct Kernel {
    pub sources: Vec<Source>,
    /// The argument with the name by which errors call the mechanism; without one it is that of the type.
    pub whose: Option<String>,
    /// True if a pose gives sines and cosines.
    pub is_on_pose: bool,
    pub steps: Vec<Step>,
    pub results: Vec<Output>,
    /// The places of the angles whose turns are given.
    pub turns: BTreeMap<SymbolId, usize>,
    /// For each result the dyad, if there is one, whose solution keeps it in the range of the scalar where its triangle
    /// is plain.
    pub dyads: Vec<Option<BlockId>>,
}

/// A result of a kernel.
#[derive(Debug, Clone)]
pub struct Output {
    pub node: NodeId,
    /// The name that it gets if it has none; without one it is written where it is used.
    pub name: Option<String>,
}

/// Where symbols of a kernel come from.
#[derive(Debug, Clone)]
pub struct Source {
    /// What is taken apart.
    pub from: Expression,
    pub shape: Shape,
}

/// The form of what is taken apart.
#[derive(Debug, Clone)]
pub enum Shape {
    Symbol(SymbolId),
    /// Something that is not looked at.
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

    pub fn list(symbols: &[SymbolId]) -> Self {
        Self::List(symbols.iter().copied().map(Self::Symbol).collect())
    }

    /// The columns of a matrix with so many rows.
    pub fn columns(rows: usize, symbols: &[SymbolId]) -> Self {
        Self::List(symbols.chunks(rows).map(Self::list).collect())
    }
}

impl<B> Function<B> {
    /// The same name, arguments and result.
    pub fn without_body<C>(self) -> Function<C> {
        let Self { name, doc, access, is_method, arguments, returns, is_fallible, body: _ } = self;
        Function { name, doc, access, is_method, arguments, returns, is_fallible, body: None }
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
    /// A value without formulas.
    pub fn plain(value: Expression) -> Self {
        Self { value: Value::Plain(value), ..Self::default() }
    }

    /// A kernel, and the value made of its results.
    pub fn of(kernel: Kernel, value: Expression) -> Self {
        Self { kernel: Some(kernel), value: Value::Plain(value), ..Self::default() }
    }

    /// The result of another function.
    pub fn result(value: Expression) -> Self {
        Self { value: Value::Result(value), ..Self::default() }
    }

    /// A check of values, after all other statements.
    #[must_use]
    pub fn checked(mut self, what: &str, values: impl IntoIterator<Item = Expression>) -> Self {
        let values = values.into_iter().collect();
        self.after.push(Statement::Check { what: what.to_owned(), values, blame: None });
        self
    }

    /// A name of its own for a local value.
    pub fn local(&mut self, wish: impl Into<String>) -> Expression {
        self.locals.push(wish.into());
        Expression::Local(self.locals.len() - 1)
    }

    /// Gives a value a name.
    pub fn bound(&mut self, wish: impl Into<String>, value: Expression) -> Expression {
        self.locals.push(wish.into());
        let place = self.locals.len() - 1;
        self.after.push(Statement::Let(Pattern::Local(place), value));
        Expression::Local(place)
    }
}

/// The results of a kernel from one place to another.
pub fn results(places: std::ops::Range<usize>) -> Vec<Expression> {
    places.map(Expression::Result).collect()
}
