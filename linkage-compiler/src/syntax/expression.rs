//! Expressions, in an arena in which operands have smaller ids than the expressions that use them.

use std::collections::{BTreeMap, BTreeSet};

use proc_macro2::{Ident, Span};

use crate::diagnostics::Region;

/// An expression of an [`Expressions`] arena.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ExpressionId(usize);

/// An expression as written.
#[derive(Debug)]
pub enum Expression {
    /// The digits of a literal.
    Number {
        digits: String,
        unit: Unit,
    },
    Name(Ident),
    Vector(ExpressionId, ExpressionId),
    /// `magnitude @ angle`, where the magnitude may be a vector by components.
    At(ExpressionId, ExpressionId),
    Sum(Vec<(Operator, ExpressionId)>),
    Product(Vec<(Operator, ExpressionId)>),
    Negate(ExpressionId),
    Power(ExpressionId, ExpressionId),
    Call(Ident, Vec<ExpressionId>),
    /// A name before a factor without an operator: a function without parentheses, or a product without `*`.
    Adjacent(Ident, ExpressionId),
    /// A reported part without a value.
    Broken,
    /// An expression with a syntax error: its names.
    Unread(Vec<Unread>),
}

impl Expression {
    /// The operands of an expression that is read.
    #[must_use]
    pub fn operands(&self) -> Vec<ExpressionId> {
        match self {
            Self::Vector(first, second) | Self::At(first, second) | Self::Power(first, second) => vec![*first, *second],
            Self::Sum(operands) | Self::Product(operands) => operands.iter().map(|(_, operand)| *operand).collect(),
            Self::Negate(operand) | Self::Adjacent(_, operand) => vec![*operand],
            Self::Call(_, arguments) => arguments.clone(),
            Self::Number { .. } | Self::Name(_) | Self::Broken | Self::Unread(_) => Vec::new(),
        }
    }
}

/// The suffix of a literal that is no unit: another unit, a type, or a name without an operator before it.
#[derive(Debug)]
pub struct Suffix {
    pub word: Ident,
    /// True if the literal is hexadecimal.
    pub is_hexadecimal: bool,
}

/// The unit of a literal.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Unit {
    None,
    /// `deg`.
    Degrees,
    /// `rad`: a plain number that is meant as an angle, however large it is.
    Radians,
    /// `rpm`: turns per minute, in radians per second.
    TurnsPerMinute,
}

impl Unit {
    /// The units by name.
    pub const ALL: [(&str, Self); 3] = [("deg", Self::Degrees), ("rad", Self::Radians), ("rpm", Self::TurnsPerMinute)];

    /// The unit whose name begins a word.
    #[must_use]
    pub fn meant(word: &str) -> Option<(&'static str, Self)> {
        Self::ALL.into_iter().find(|(unit, _)| word.starts_with(unit))
    }

    /// The quantities that it measures, in messages.
    #[must_use]
    pub fn of(self) -> &'static str {
        match self {
            Self::TurnsPerMinute => "speeds",
            Self::None | Self::Degrees | Self::Radians => "angles",
        }
    }

    /// pi divided by the unit in radians or radians per second, if that is not 1.
    #[must_use]
    pub fn share_of_pi(self) -> Option<i128> {
        match self {
            Self::None | Self::Radians => None,
            Self::Degrees => Some(180),
            Self::TurnsPerMinute => Some(30),
        }
    }
}

/// A name in an expression with a syntax error.
#[derive(Debug, Clone)]
pub struct Unread {
    pub name: Ident,
    /// True if it follows an `@`.
    pub is_angle: bool,
    /// True if it precedes an `@`.
    pub is_length: bool,
}

/// The operator before an operand of a sum or product; the first operand has `Direct`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Operator {
    /// `+` or `*`.
    Direct,
    /// `-` or `/`.
    Inverse,
    /// None: reported, and read as a product.
    Missing,
}

/// The expressions of one mechanism.
#[derive(Debug, Default)]
pub struct Expressions {
    nodes: Vec<(Expression, Region)>,
    /// True after `@`: a second `@` belongs to another vector.
    pub(super) is_angle: bool,
    /// The number of `|` before the expression that is being read.
    pub(super) open_bars: usize,
    /// Mistakes that are read as what is meant.
    slips: Vec<syn::Error>,
    /// The suffixes of numbers that are no units.
    suffixes: BTreeMap<usize, Suffix>,
    /// The units that are reported.
    units: BTreeSet<String>,
    /// The keywords of Rust in statements with a syntax error, where they may be meant as names.
    keywords: BTreeSet<String>,
}

impl Expressions {
    pub(super) fn push(&mut self, expression: Expression, region: Region) -> ExpressionId {
        self.nodes.push((expression, region));
        ExpressionId(self.nodes.len() - 1)
    }

    /// Reports a mistake that is read as what is meant.
    pub(super) fn slip(&mut self, at: impl Into<Region>, message: impl std::fmt::Display) {
        self.slips.push(syn::Error::new_spanned(at.into(), message));
    }

    /// Reports a unit at its first use.
    pub(super) fn unit(&mut self, unit: &str, at: Region, digits: &str) {
        if self.units.insert(unit.to_owned()) {
            self.slip(at, unknown_unit(unit, digits));
        }
    }

    /// Adds a number with a suffix that is no unit.
    pub(super) fn push_suffixed(&mut self, digits: String, suffix: Suffix, region: Region) -> ExpressionId {
        self.suffixes.insert(self.nodes.len(), suffix);
        self.push(Expression::Number { digits, unit: Unit::None }, region)
    }

    /// The suffix of a number, if it is no unit.
    #[must_use]
    pub fn suffix(&self, index: usize) -> Option<&Suffix> {
        self.suffixes.get(&index)
    }

    /// Records a keyword of Rust in a statement with a syntax error.
    pub(super) fn add_keyword(&mut self, keyword: &Ident) {
        self.keywords.insert(keyword.to_string());
    }

    /// The keywords of Rust that may be meant as names, each with its message.
    pub fn keywords(&self) -> impl Iterator<Item = &str> {
        self.keywords.iter().map(String::as_str)
    }

    /// True if a unit is reported.
    #[must_use]
    pub fn has_reported(&self, unit: &str) -> bool {
        self.units.contains(unit)
    }

    /// True if the statement has a mistake so far.
    pub(super) fn has_slips(&self) -> bool {
        !self.slips.is_empty()
    }

    /// Takes the mistakes of a statement.
    pub(super) fn take_slips(&mut self) -> Vec<syn::Error> {
        std::mem::take(&mut self.slips)
    }

    /// The digits, if the expression is a plain number.
    pub(super) fn digits(&self, id: ExpressionId) -> Option<&str> {
        match &self.nodes[id.0] {
            (Expression::Number { digits, unit: Unit::None }, _) => Some(digits),
            _ => None,
        }
    }

    #[must_use]
    pub fn len(&self) -> usize {
        self.nodes.len()
    }

    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }

    /// The region of the last expression.
    #[must_use]
    pub fn last_region(&self) -> Option<Region> {
        self.nodes.last().map(|(_, region)| *region)
    }

    /// Adds the number 0.
    pub(super) fn zero(&mut self, at: Span) -> ExpressionId {
        self.push(Expression::Number { digits: "0".to_owned(), unit: Unit::None }, at.into())
    }

    /// Adds an expression with a syntax error.
    pub(super) fn unread(&mut self, names: Vec<Unread>, region: Region) -> ExpressionId {
        self.push(Expression::Unread(names), region)
    }

    /// Replaces an expression by one without a value.
    pub(super) fn spoil(&mut self, id: ExpressionId) {
        self.nodes[id.0].0 = Expression::Broken;
    }

    /// Removes the expressions of a statement with a syntax error.
    pub(super) fn truncate(&mut self, length: usize) {
        self.nodes.truncate(length);
        self.suffixes.split_off(&length);
    }

    /// The expression as written.
    #[must_use]
    pub fn get(&self, id: ExpressionId) -> &Expression {
        &self.nodes[id.0].0
    }

    /// The name, if the expression is only a name.
    #[must_use]
    pub fn as_name(&self, id: ExpressionId) -> Option<&Ident> {
        match &self.nodes[id.0] {
            (Expression::Name(name), _) => Some(name),
            _ => None,
        }
    }

    #[must_use]
    pub fn region(&self, id: ExpressionId) -> Region {
        self.nodes[id.0].1
    }

    /// The id of the expression with this index.
    #[must_use]
    pub fn id(&self, index: usize) -> ExpressionId {
        ExpressionId(index)
    }

    /// The expressions from an index on; operands come before the expressions that use them.
    pub fn from(&self, start: usize) -> impl Iterator<Item = (&Expression, Region)> {
        self.nodes.iter().skip(start).map(|(expression, region)| (expression, *region))
    }
}

impl ExpressionId {
    #[must_use]
    pub fn index(self) -> usize {
        self.0
    }
}

/// The message of a suffix that is not a unit of the language.
pub(crate) fn unknown_unit(suffix: &str, digits: &str) -> String {
    let is_type = ["f16", "f32", "f64", "f128", "i8", "i16", "i32", "i64", "isize", "u8", "u16", "u32", "u64", "usize"];
    if is_type.contains(&suffix) {
        return format!("a number has no type: write `{digits}`");
    }
    match Unit::meant(suffix) {
        Some((unit, _)) => format!("unknown unit `{suffix}`: write `{digits}{unit}`"),
        None => format!(
            "unknown unit `{suffix}`: write `{digits}`, with all numbers in one system of units; an angle may have `deg`, a \
             speed of rotation `rpm`"
        ),
    }
}
