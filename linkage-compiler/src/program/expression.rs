//! Planned code: expressions, statements and patterns, before they are lowered.

use linkage_ir::{Constant, Form, Intrinsic, code};

use crate::graph::{Function, Number};

pub use linkage_ir::code::{Receiver, Type};

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

impl From<String> for Variable {
    fn from(name: String) -> Self {
        Self::Name(name)
    }
}

impl From<&str> for Variable {
    fn from(name: &str) -> Self {
        Self::Name(name.to_owned())
    }
}

/// A local value by its index.
impl From<usize> for Variable {
    fn from(index: usize) -> Self {
        Self::Local(index)
    }
}

/// A variable of planned code.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub enum Variable {
    /// One with this name.
    Name(String),
    /// A local value, by its index; lowering gives it a name.
    Local(usize),
}

/// A pattern of planned code.
pub type Pattern<V> = code::Pattern<V, String>;

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
