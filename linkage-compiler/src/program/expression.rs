//! Expressions, patterns and types of the emitted program.

use crate::graph::{Function, Number};

/// An expression.
#[derive(Debug, Clone, PartialEq)]
pub enum Expression {
    /// `self`, an argument, or a local value.
    Name(String),
    /// A result of the kernel, by its index.
    Result(usize),
    /// A local value, by its index; lowering gives it a name.
    Local(usize),

    // Arithmetic.
    Number(Number),
    /// A number of any kind, to which no double is close enough.
    Exact(Number),
    /// The terms, each with true if it is subtracted.
    Sum(Vec<(bool, Expression)>),
    Product(Vec<Expression>),
    Quotient(Box<[Expression; 2]>),
    Square(Box<Expression>),
    Negative(Box<Expression>),
    Elementary(Function, Vec<Expression>),
    /// `a & b`: all conditions, none of them left out.
    All(Vec<Expression>),

    // Data.
    Text(String),
    Count(usize),
    /// A constant of the program, such as `Self::NAME`.
    Constant(&'static str),
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
    /// A call of a function of the runtime.
    Runtime(&'static str, Vec<Expression>),
    /// A call of an associated function of a type.
    Associated(Type, String, Vec<Expression>),
    /// A function of a type as a value.
    Function(Type, &'static str),
    /// A method call.
    Method(Box<Expression>, String, Vec<Expression>),
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
        arguments: Vec<Pattern>,
        statements: Vec<Statement>,
        value: Box<Expression>,
        moves: bool,
    },
    /// `{ statements value }`
    Block(Vec<Statement>, Box<Expression>),
}

#[derive(Debug, Clone, PartialEq)]
pub enum Statement {
    /// `let pattern = value;`
    Let(Pattern, Expression),
    /// `value;`
    Do(Expression),
    /// `place = value;`
    Assign(Expression, Expression),
    /// `return value;`
    Return(Expression),
    /// `let pattern = value else { return otherwise; };`
    LetElse(Pattern, Expression, Expression),
    /// `if !(all conditions) { … }`
    Unless(Vec<Expression>, Vec<Statement>),
    /// Binds a value, or a precise one if the factorisation of a group loses digits.
    Refine(Pattern, Expression, Expression),
    /// Returns an error if a value is not finite; `detail` is a function that finds a more precise error.
    Check { what: String, values: Vec<Expression>, detail: Option<Expression> },
    /// Returns an error if a number of a position is not finite; numbers that a well-conditioned triangle guarantees
    /// finite are not checked.
    CheckPosition,
    /// Returns another value if a condition is false, or a result is not finite.
    CheckKinematics { conditions: Vec<Expression>, otherwise: Expression },
    /// Binds true if these conditions are true, the results are finite, and all checks of the kernel passed.
    LetAccepted(Pattern, Vec<Expression>),
    /// Binds true if all checks of the kernel passed.
    LetPassed(Pattern),
}

#[derive(Debug, Clone, PartialEq)]
pub enum Pattern {
    Name(String),
    Local(usize),
    Mutable(Box<Pattern>),
    /// `Some(pattern)` or `Ok(pattern)`
    Case(&'static str, Box<Pattern>),
    Typed(String, Type),
    Ignored,
    List(Vec<Pattern>),
    Tuple(Vec<Pattern>),
    /// `Type { field: pattern, .. }`
    Struct {
        of: Type,
        fields: Vec<(String, Pattern)>,
        is_whole: bool,
    },
}

/// A type.
#[derive(Debug, Clone, PartialEq)]
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
    /// `Kinematics<Pose, Rates, T, U, V>`: the values that functions of scenes share.
    Kinematics {
        pose: String,
        rates: String,
        unknowns: usize,
        inputs: usize,
    },
    /// `StateRates<Rates, Inputs>`: q' and v''.
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
        Self::Constant("Self::NAME")
    }

    pub fn text(text: impl Into<String>) -> Self {
        Self::Text(text.into())
    }

    #[must_use]
    pub fn field(self, name: impl Into<String>) -> Self {
        Self::Field(Box::new(self), name.into())
    }

    #[must_use]
    pub fn method(self, name: impl Into<String>, arguments: impl IntoIterator<Item = Self>) -> Self {
        Self::Method(Box::new(self), name.into(), arguments.into_iter().collect())
    }

    /// True if all values are finite: a sum is finite only if all its terms are. Where finite terms overflow, it is false.
    pub fn all_finite(values: Vec<Self>) -> Self {
        Self::Sum(values.into_iter().map(|value| (false, value)).collect()).method("is_finite", [])
    }

    /// True if each value is finite; finite values that overflow when added are.
    pub fn are_finite(values: Vec<Self>) -> Self {
        Self::List(values).method("iter", []).method("all", [Self::Function(Type::Scalar, "is_finite")])
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
        const UNCHANGED: [&str; 7] = [
            "unit",
            "finite_points",
            "finite_vectors",
            "finite_outputs",
            "finite_matrices",
            "point_motions",
            "output_motions",
        ];
        match self {
            Self::Result(_) | Self::Name(_) | Self::Number(_) | Self::Constant(_) | Self::Text(_) => true,
            Self::List(all) | Self::Tuple(all) => all.iter().all(Self::is_of_results),
            Self::Associated(_, name, all) => name == "from" && all.iter().all(Self::is_of_results),
            Self::Runtime(name, all) => UNCHANGED.contains(name) && all.iter().all(Self::is_of_results),
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
            Self::Method(inside, name, arguments) if name == "into" && arguments.is_empty() => inside.stored(),
            _ => None,
        }
    }

    pub fn runtime(name: &'static str, arguments: impl IntoIterator<Item = Self>) -> Self {
        Self::Runtime(name, arguments.into_iter().collect())
    }

    /// A call of an associated function.
    pub fn associated(of: Type, name: impl Into<String>, arguments: impl IntoIterator<Item = Self>) -> Self {
        Self::Associated(of, name.into(), arguments.into_iter().collect())
    }

    /// A call of another function of the same type.
    pub fn call(name: impl Into<String>, arguments: impl IntoIterator<Item = Self>) -> Self {
        Self::own().method(name, arguments)
    }

    pub fn structure(of: Type, members: impl IntoIterator<Item = (String, Self)>) -> Self {
        Self::Struct(of, members.into_iter().collect(), None)
    }

    /// `Type::from(value)` for a type of the runtime.
    pub fn made(of: &'static str, from: Self) -> Self {
        Self::associated(Type::Runtime(of, Vec::new()), "from", [from])
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
    pub fn sized_matrix(entries: &[Self], rows: usize) -> Self {
        if rows == 0 { Self::zeros("Matrix") } else { Self::made("Matrix", Self::listed(entries, rows)) }
    }

    /// The zero matrix of a type of the runtime.
    pub fn zeros(of: &'static str) -> Self {
        Self::associated(Type::Runtime(of, Vec::new()), "zeros", [])
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

    /// Visits every name that is used.
    pub fn each_name<'e>(&'e self, visit: &mut dyn FnMut(&'e str)) {
        match self {
            Self::Name(name) => visit(name),
            Self::Sum(terms) => terms.iter().for_each(|(_, term)| term.each_name(visit)),
            Self::Product(all)
            | Self::Elementary(_, all)
            | Self::All(all)
            | Self::List(all)
            | Self::Tuple(all)
            | Self::Runtime(_, all)
            | Self::Associated(_, _, all) => all.iter().for_each(|value| value.each_name(visit)),
            Self::Quotient(parts) | Self::At(parts) => parts.iter().for_each(|part| part.each_name(visit)),
            Self::Square(inside)
            | Self::Negative(inside)
            | Self::Field(inside, _)
            | Self::Index(inside, _)
            | Self::Repeated(inside, _)
            | Self::Try(inside)
            | Self::Borrowed(inside)
            | Self::MutablyBorrowed(inside)
            | Self::Dereferenced(inside) => {
                inside.each_name(visit);
            }
            Self::Struct(_, members, rest) => {
                members.iter().for_each(|(_, value)| value.each_name(visit));
                rest.iter().for_each(|rest| rest.each_name(visit));
            }
            Self::Method(of, _, arguments) => {
                of.each_name(visit);
                arguments.iter().for_each(|argument| argument.each_name(visit));
            }
            Self::Closure { statements, value, .. } | Self::Block(statements, value) => {
                statements.iter().for_each(|statement| statement.each_name(visit));
                value.each_name(visit);
            }
            Self::Result(_)
            | Self::Local(_)
            | Self::Number(_)
            | Self::Exact(_)
            | Self::Text(_)
            | Self::Count(_)
            | Self::Constant(_)
            | Self::Function(..) => {}
        }
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

impl Pattern {
    /// Visits every name that the pattern binds.
    pub fn each_name<'p>(&'p self, visit: &mut dyn FnMut(&'p str)) {
        match self {
            Self::Name(name) | Self::Typed(name, _) => visit(name),
            Self::Mutable(inside) | Self::Case(_, inside) => inside.each_name(visit),
            Self::List(all) | Self::Tuple(all) => all.iter().for_each(|pattern| pattern.each_name(visit)),
            Self::Struct { fields, .. } => fields.iter().for_each(|(_, pattern)| pattern.each_name(visit)),
            Self::Local(_) | Self::Ignored => {}
        }
    }
}

impl Statement {
    /// Visits every name that is used.
    pub fn each_name<'e>(&'e self, visit: &mut dyn FnMut(&'e str)) {
        match self {
            Self::Let(_, value) | Self::Do(value) | Self::Return(value) => value.each_name(visit),
            Self::LetElse(_, value, otherwise) | Self::Refine(_, value, otherwise) => {
                value.each_name(visit);
                otherwise.each_name(visit);
            }
            Self::Assign(place, value) => {
                place.each_name(visit);
                value.each_name(visit);
            }
            Self::Unless(conditions, inside) => {
                conditions.iter().for_each(|condition| condition.each_name(visit));
                inside.iter().for_each(|statement| statement.each_name(visit));
            }
            Self::Check { values, detail, .. } => {
                values.iter().chain(detail).for_each(|value| value.each_name(visit));
            }
            Self::CheckKinematics { conditions, otherwise } => {
                conditions.iter().for_each(|value| value.each_name(visit));
                otherwise.each_name(visit);
            }
            Self::LetAccepted(_, conditions) => {
                conditions.iter().for_each(|value| value.each_name(visit));
            }
            Self::CheckPosition | Self::LetPassed(_) => {}
        }
    }
}
