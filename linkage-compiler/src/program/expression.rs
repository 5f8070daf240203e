//! Planned code: expressions, statements and patterns, before they are lowered.

use crate::graph::{Function, Number};
use linkage_ir::{Constant, Form, Intrinsic};

/// A planned expression.
#[derive(Debug, Clone, PartialEq)]
pub enum Expression {
    /// `self`, an argument, or a variable of the plan.
    Name(String),
    /// A result of the kernel, by its index.
    Result(usize),
    /// A local value, by its index; lowering gives it a name.
    Local(usize),

    // Arithmetic of results and of values that other functions return.
    Number(Number),
    Sum(Vec<Expression>),
    Product(Vec<Expression>),
    Negative(Box<Expression>),
    Elementary(Function, Vec<Expression>),
    /// All conditions, none of them left out.
    All(Vec<Expression>),

    // Data.
    Text(String),
    Count(usize),
    Constant(Constant),
    Field(Box<Expression>, String),
    Index(Box<Expression>, usize),
    /// The entry of a list at a number that is known when the function runs.
    At(Box<[Expression; 2]>),
    List(Vec<Expression>),
    /// `[value; count]`
    Repeated(Box<Expression>, usize),
    Tuple(Vec<Expression>),
    /// `Type { field: value, ..rest }`
    Struct(Type, Vec<(String, Expression)>, Option<Box<Expression>>),

    // Calls.
    /// A call of a function that the program does not define; an associated one belongs to a type.
    Intrinsic(Intrinsic, Option<Type>, Vec<Expression>),
    /// Such a function as a value.
    Function(Intrinsic, Option<Type>),
    /// A call of a function of the program, by its name.
    Own(Box<Receiver<Expression>>, String, Vec<Expression>),
    /// `value?`
    Try(Box<Expression>),
    /// `&value`
    Borrowed(Box<Expression>),
    /// `&mut value`
    MutablyBorrowed(Box<Expression>),
    /// `*value`
    Dereferenced(Box<Expression>),
    /// `|arguments| { statements value }`, with `move` if `moves`.
    Closure {
        arguments: Vec<Pattern<Variable>>,
        statements: Vec<Statement>,
        value: Box<Expression>,
        moves: bool,
    },
    /// `{ statements value }`
    Block(Vec<Statement>, Box<Expression>),
}

/// The value or type that a function of the program is called on.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub enum Receiver<E> {
    /// `self.f()`
    Itself,
    /// `Self::f()`
    ItsType,
    /// `value.f()`, a function of the driver.
    Value(E),
    /// `Type::f()`, a function of the driver.
    Type(Type),
}

/// A planned statement.
#[derive(Debug, Clone, PartialEq)]
pub enum Statement {
    /// `let pattern = value;`
    Let(Pattern<Variable>, Expression),
    /// `value;`
    Do(Expression),
    /// `place = value;`
    Assign(Expression, Expression),
    /// `let pattern = value else { return otherwise; };`
    LetElse(Pattern<Variable>, Expression, Expression),
    /// Returns the second unless the first is true.
    ReturnUnless(Expression, Expression),
    /// Binds a value, or a precise one if the factorisation of a group loses digits.
    Refine(Pattern<Variable>, Expression, Expression),
    /// Returns an error if a value is not finite; `detail` is a function that finds a more precise error.
    Check { what: String, values: Vec<Expression>, detail: Option<Expression> },
    /// Returns an error if a number of a position is not finite; numbers that a well-conditioned triangle guarantees
    /// finite are not checked.
    CheckPosition,
    /// Returns another value if a condition is false, or a result is not finite.
    CheckKinematics { conditions: Vec<Expression>, otherwise: Expression },
    /// Binds true if these conditions are true, the results are finite, and all checks of the kernel passed.
    LetAccepted(Pattern<Variable>, Vec<Expression>),
    /// Binds true if all checks of the kernel passed.
    LetPassed(Pattern<Variable>),
}

/// A variable of planned code.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub enum Variable {
    /// One with this name.
    Name(String),
    /// A local value, by its index; lowering gives it a name.
    Local(usize),
}

/// A pattern that binds variables.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub enum Pattern<V> {
    Bound(V),
    Mutable(V),
    /// `Some(pattern)` or `Ok(pattern)`
    Case(Intrinsic, Box<Pattern<V>>),
    Typed(V, Type),
    Ignored,
    List(Vec<Pattern<V>>),
    Tuple(Vec<Pattern<V>>),
    /// `Type { field: pattern, .. }`
    Struct {
        of: Type,
        fields: Vec<(String, Pattern<V>)>,
        is_whole: bool,
    },
}

/// A type.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub enum Type {
    /// The scalar `T`.
    Scalar,
    /// `&'static str`
    Text,
    /// `bool`
    Flag,
    /// `usize`
    Count,
    /// One number for each of several lanes: `[T; W]`.
    Lanes,
    /// `Self`
    Itself,
    /// A type of a trait: `Self::Name`.
    OfTrait(&'static str),
    /// A type of the mechanism over the scalar: `Name<T>`.
    Own(String),
    /// A type of the mechanism over the scalar of twice the precision: `Name<Wide>`.
    Wide(String),
    /// A type of the mechanism without a scalar: `Name`.
    Bare(String),
    /// One quantity for each of the points or outputs: `Name<Item>`.
    Each(String, Box<Type>),
    /// A column with its length as a type: `Column<Item, D<2>>`.
    Column(Box<Type>, usize),
    Vector(usize),
    Matrix(usize, usize),
    /// `Point2<T>`
    Point,
    /// `Vector2<T>`
    Plane,
    /// A type of the runtime with const generics: `Name<T, 2>`.
    Runtime(&'static str, Vec<usize>),
    /// A type of the runtime with dimensions as types: `Name<T, D<2>>`.
    Sized(&'static str, Vec<usize>),
    /// A generic type of the runtime: `Name<Item>`.
    Around(&'static str, Box<Type>),
    List(Box<Type>, usize),
    Tuple(Vec<Type>),
    /// `ReducedMotion<Pose, Rates, T, U, V>`: the values that functions of scenes share.
    ReducedMotion {
        pose: String,
        rates: String,
        unknowns: usize,
        inputs: usize,
    },
    /// `StateRates<Rates, Inputs>`: `q'` and `v''`.
    StateRates {
        rates: String,
        inputs: String,
    },
    /// `impl Iterator<Item = Result<(Branch, Pose), PositionError>>`
    Branches {
        branch: String,
        pose: String,
    },
    /// `impl Iterator<Item>`, and `Clone`.
    Iterator {
        item: Box<Type>,
        is_cloned: bool,
    },
}

impl Expression {
    pub fn name(name: impl Into<String>) -> Self {
        Self::Name(name.into())
    }

    pub fn own() -> Self {
        Self::name("self")
    }

    /// The name of the mechanism or scene for errors, `Self::NAME`.
    pub fn mechanism() -> Self {
        Self::Constant(Constant::Name)
    }

    pub fn text(text: impl Into<String>) -> Self {
        Self::Text(text.into())
    }

    #[must_use]
    pub fn field(self, name: impl Into<String>) -> Self {
        Self::Field(Box::new(self), name.into())
    }

    /// `value.into()`
    #[must_use]
    pub fn converted(self) -> Self {
        Self::call(Intrinsic::Into, [self])
    }

    /// True if each value is finite; finite values that overflow when added are.
    pub fn are_finite(values: Vec<Self>) -> Self {
        let all = Self::call(Intrinsic::Iter, [Self::List(values)]);
        Self::call(Intrinsic::AreAll, [all, Self::Function(Intrinsic::IsFinite, Some(Type::Scalar))])
    }

    #[must_use]
    pub fn tried(self) -> Self {
        Self::Try(Box::new(self))
    }

    #[must_use]
    pub fn borrowed(self) -> Self {
        Self::Borrowed(Box::new(self))
    }

    #[must_use]
    pub fn mutably_borrowed(self) -> Self {
        Self::MutablyBorrowed(Box::new(self))
    }

    #[must_use]
    pub fn dereferenced(self) -> Self {
        Self::Dereferenced(Box::new(self))
    }

    /// True if its numbers are results of the kernel and arguments, unchanged.
    pub fn is_of_results(&self) -> bool {
        match self {
            Self::Result(_) | Self::Name(_) | Self::Number(_) | Self::Constant(_) | Self::Text(_) => true,
            Self::List(all) | Self::Tuple(all) => all.iter().all(Self::is_of_results),
            Self::Intrinsic(of, _, all) => of.row().is_unchanged && all.iter().all(Self::is_of_results),
            Self::Struct(_, members, None) => members.iter().all(|(_, value)| value.is_of_results()),
            Self::Dereferenced(inside) | Self::Borrowed(inside) | Self::Try(inside) => inside.is_of_results(),
            _ => false,
        }
    }

    /// The name of the argument that this is, as it is or converted.
    pub fn stored(&self) -> Option<&str> {
        match self {
            Self::Name(name) => Some(name),
            Self::Dereferenced(inside) | Self::Borrowed(inside) => inside.stored(),
            Self::Intrinsic(Intrinsic::Into, _, inside) => inside.first()?.stored(),
            _ => None,
        }
    }

    /// A call of a function of the runtime, or of a method that the program does not define.
    pub fn call(of: Intrinsic, arguments: impl IntoIterator<Item = Self>) -> Self {
        debug_assert_ne!(of.row().form, Form::Associated, "{of:?}");
        Self::Intrinsic(of, None, arguments.into_iter().collect())
    }

    /// A call of an associated function of a type.
    pub fn of_type(of: Type, function: Intrinsic, arguments: impl IntoIterator<Item = Self>) -> Self {
        debug_assert_eq!(function.row().form, Form::Associated, "{function:?}");
        Self::Intrinsic(function, Some(of), arguments.into_iter().collect())
    }

    /// A call of another function of the same type, `self.name()`.
    pub fn own_call(name: impl Into<String>, arguments: impl IntoIterator<Item = Self>) -> Self {
        Self::called_on(Receiver::Itself, name, arguments)
    }

    /// A call of a function of the driver, `self.name()`.
    #[must_use]
    pub fn driver_call(self, name: impl Into<String>, arguments: impl IntoIterator<Item = Self>) -> Self {
        Self::called_on(Receiver::Value(self), name, arguments)
    }

    pub fn called_on(
        receiver: Receiver<Self>,
        name: impl Into<String>,
        arguments: impl IntoIterator<Item = Self>,
    ) -> Self {
        Self::Own(Box::new(receiver), name.into(), arguments.into_iter().collect())
    }

    pub fn structure(of: Type, members: impl IntoIterator<Item = (String, Self)>) -> Self {
        Self::Struct(of, members.into_iter().collect(), None)
    }

    /// `Type::from(value)` for a type of the runtime.
    pub fn made(of: &'static str, from: Self) -> Self {
        Self::of_type(Type::Runtime(of, Vec::new()), Intrinsic::From, [from])
    }

    /// A column vector.
    pub fn vector(entries: Vec<Self>) -> Self {
        Self::made("SVector", Self::List(entries))
    }

    /// A matrix from its entries, column by column.
    pub fn matrix(entries: &[Self], rows: usize) -> Self {
        Self::made("SMatrix", Self::listed(entries, rows))
    }

    /// A column vector with its dimension as a type.
    pub fn sized_vector(entries: Vec<Self>) -> Self {
        Self::made("Column", Self::List(entries))
    }

    /// A matrix with its dimensions as types, from its entries column by column.
    pub fn sized_matrix(entries: &[Self], rows: usize, columns: usize) -> Self {
        match rows {
            0 => Self::zeros("Matrix", [rows, columns]),
            _ => Self::made("Matrix", Self::listed(entries, rows)),
        }
    }

    /// The zero matrix of a type of the runtime, with these numbers of rows and columns.
    pub fn zeros(of: &'static str, sizes: [usize; 2]) -> Self {
        Self::of_type(Type::Runtime(of, sizes.to_vec()), Intrinsic::Zeros, [])
    }

    /// The columns, as lists of `rows` entries each.
    pub fn listed(entries: &[Self], rows: usize) -> Self {
        Self::List(entries.chunks(rows).map(|column| Self::List(column.to_vec())).collect())
    }

    /// The columns of a matrix as arrays, `matrix.data.0`.
    #[must_use]
    pub fn columns(self) -> Self {
        self.field("data").field("0")
    }

    pub fn zero() -> Self {
        Self::Number(Number::ZERO)
    }

    pub fn one() -> Self {
        Self::Number(Number::ONE)
    }

    /// Expressions in nested lists; `sizes` are the lengths of the inner lists, outermost first.
    pub fn nested(values: Vec<Self>, sizes: &[usize]) -> Vec<Self> {
        let Some((_, inner)) = sizes.split_first() else { return values };
        let each = sizes.iter().product::<usize>().max(1);
        let mut lists = Vec::new();
        let mut values = values.into_iter().peekable();
        while values.peek().is_some() {
            lists.push(Self::List(Self::nested(values.by_ref().take(each).collect(), inner)));
        }
        lists
    }
}

impl Pattern<Variable> {
    pub fn name(name: impl Into<String>) -> Self {
        Self::Bound(Variable::Name(name.into()))
    }

    pub fn local(index: usize) -> Self {
        Self::Bound(Variable::Local(index))
    }

    /// `name: Type`
    pub fn typed(name: impl Into<String>, of: Type) -> Self {
        Self::Typed(Variable::Name(name.into()), of)
    }
}

impl<V> Pattern<V> {
    /// Visits every variable that the pattern binds.
    pub fn each<'p>(&'p self, visit: &mut dyn FnMut(&'p V)) {
        match self {
            Self::Bound(variable) | Self::Mutable(variable) | Self::Typed(variable, _) => visit(variable),
            Self::Case(_, inside) => inside.each(visit),
            Self::List(all) | Self::Tuple(all) => all.iter().for_each(|pattern| pattern.each(visit)),
            Self::Struct { fields, .. } => fields.iter().for_each(|(_, pattern)| pattern.each(visit)),
            Self::Ignored => {}
        }
    }

    /// The pattern with other variables.
    pub fn map<W>(self, to: &mut dyn FnMut(V) -> W) -> Pattern<W> {
        match self {
            Self::Bound(variable) => Pattern::Bound(to(variable)),
            Self::Mutable(variable) => Pattern::Mutable(to(variable)),
            Self::Typed(variable, of) => Pattern::Typed(to(variable), of),
            Self::Case(case, inside) => Pattern::Case(case, Box::new(inside.map(to))),
            Self::List(all) => Pattern::List(all.into_iter().map(|pattern| pattern.map(to)).collect()),
            Self::Tuple(all) => Pattern::Tuple(all.into_iter().map(|pattern| pattern.map(to)).collect()),
            Self::Struct { of, fields, is_whole } => {
                let fields = fields.into_iter().map(|(field, pattern)| (field, pattern.map(to))).collect();
                Pattern::Struct { of, fields, is_whole }
            }
            Self::Ignored => Pattern::Ignored,
        }
    }
}
