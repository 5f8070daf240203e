//! Expressions, in an arena in which operands have smaller ids than the expressions that use them.
//!
//! Precedence from low to high: `+ -`, `@`, `* /`, unary `-`, `^`.

use std::collections::BTreeSet;

use proc_macro2::{Delimiter, Ident, Span};
use syn::ext::IdentExt;
use syn::parse::{Parse, ParseStream};
use syn::{Lit, Token};

use super::foreign;
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

/// The unit of a literal.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Unit {
    None,
    /// `deg`.
    Degrees,
    /// `rad`: a plain number that is meant as an angle, however large it is.
    Radians,
}

impl Unit {
    /// The units by name.
    pub const ALL: [(&str, Self); 2] = [("deg", Self::Degrees), ("rad", Self::Radians)];
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
    /// Mistakes that are read as what is meant.
    slips: Vec<syn::Error>,
    /// The units that are reported.
    units: BTreeSet<String>,
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

    /// Removes the expressions of a statement with a syntax error.
    pub(super) fn truncate(&mut self, length: usize) {
        self.nodes.truncate(length);
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

pub(super) fn parse(stream: ParseStream, arena: &mut Expressions) -> syn::Result<ExpressionId> {
    chain(
        stream,
        arena,
        at,
        |stream, _, _| {
            Ok(if stream.parse::<Option<Token![+]>>()?.is_some() {
                Some(Operator::Direct)
            } else {
                stream.parse::<Option<Token![-]>>()?.map(|_| Operator::Inverse)
            })
        },
        Expression::Sum,
    )
}

fn product(stream: ParseStream, arena: &mut Expressions) -> syn::Result<ExpressionId> {
    chain(
        stream,
        arena,
        signed,
        |stream, last, arena| {
            Ok(if stream.parse::<Option<Token![*]>>()?.is_some() {
                Some(Operator::Direct)
            } else if stream.parse::<Option<Token![/]>>()?.is_some() {
                Some(Operator::Inverse)
            } else {
                foreign::product(stream, last, arena)?
            })
        },
        Expression::Product,
    )
}

type Part = fn(ParseStream, &mut Expressions) -> syn::Result<ExpressionId>;

fn chain(
    stream: ParseStream,
    arena: &mut Expressions,
    part: Part,
    operator: fn(ParseStream, ExpressionId, &mut Expressions) -> syn::Result<Option<Operator>>,
    build: fn(Vec<(Operator, ExpressionId)>) -> Expression,
) -> syn::Result<ExpressionId> {
    let mut first = part(stream, arena)?;
    let mut operands = vec![(Operator::Direct, first)];
    let mut last = first;
    while let Some(operator) = operator(stream, last, arena)? {
        let name = arena.as_name(last).filter(|_| operator == Operator::Missing).cloned();
        let before = last;
        last = part(stream, arena)?;
        match name {
            // `sin phi` or `l2 l3`.
            Some(name) => {
                let region = arena.region(before).to(arena.region(last));
                arena.nodes[before.0].0 = Expression::Broken;
                last = arena.push(Expression::Adjacent(name, last), region);
                operands.pop();
                let operator = operands.last().map_or(Operator::Direct, |_| Operator::Missing);
                operands.push((operator, last));
                if operands.len() == 1 {
                    first = last;
                }
            }
            None => operands.push((operator, last)),
        }
    }
    if operands.len() == 1 {
        return Ok(first);
    }
    let region = arena.region(first).to(arena.region(last));
    Ok(arena.push(build(operands), region))
}

fn at(stream: ParseStream, arena: &mut Expressions) -> syn::Result<ExpressionId> {
    if stream.peek(Token![@]) {
        return Err(stream.error("expected a length before `@`: write `r@phi`"));
    }
    let magnitude = product(stream, arena)?;
    if stream.parse::<Option<Token![@]>>()?.is_none() {
        return Ok(magnitude);
    }
    if stream.peek(Token![+]) {
        return Err(stream.error("expected an angle after `@`: write `r@phi`"));
    }
    let was_angle = std::mem::replace(&mut arena.is_angle, true);
    let angle = product(stream, arena);
    arena.is_angle = was_angle;
    let angle = angle?;
    if stream.peek(Token![@]) {
        return Err(syn::Error::new(stream.span(), "a vector has one angle: write `r@(phi + psi)`"));
    }
    let region = arena.region(magnitude).to(arena.region(angle));
    Ok(arena.push(Expression::At(magnitude, angle), region))
}

fn signed(stream: ParseStream, arena: &mut Expressions) -> syn::Result<ExpressionId> {
    let start = stream.span();
    let mut negative = false;
    while stream.parse::<Option<Token![-]>>()?.is_some() {
        negative = !negative;
    }
    let value = power(stream, arena)?;
    if !negative {
        return Ok(value);
    }
    let region = Region::from(start).to(arena.region(value));
    Ok(arena.push(Expression::Negate(value), region))
}

fn power(stream: ParseStream, arena: &mut Expressions) -> syn::Result<ExpressionId> {
    let base = postfix(stream, arena)?;
    if !foreign::power(stream, arena) && stream.parse::<Option<Token![^]>>()?.is_none() {
        return Ok(base);
    }
    let start = stream.span();
    let negative = stream.parse::<Option<Token![-]>>()?.is_some();
    let mut exponent = postfix(stream, arena)?;
    if negative {
        let region = Region::from(start).to(arena.region(exponent));
        exponent = arena.push(Expression::Negate(exponent), region);
    }
    let region = arena.region(base).to(arena.region(exponent));
    Ok(arena.push(Expression::Power(base, exponent), region))
}

pub(super) fn postfix(stream: ParseStream, arena: &mut Expressions) -> syn::Result<ExpressionId> {
    let mut value = primary(stream, arena)?;
    while let Some(read) = foreign::postfix(stream, value, arena)? {
        value = read;
    }
    while !stream.peek(Token![..]) && stream.parse::<Option<Token![.]>>()?.is_some() {
        let method: Ident = stream.call(Ident::parse_any)?;
        let (mut arguments, close) = arguments(stream, arena)?;
        arguments.insert(0, value);
        let region = arena.region(value).to(close.into());
        value = arena.push(Expression::Call(method, arguments), region);
    }
    Ok(value)
}

fn arguments(stream: ParseStream, arena: &mut Expressions) -> syn::Result<(Vec<ExpressionId>, Span)> {
    let was_angle = std::mem::take(&mut arena.is_angle);
    let arguments = listed(stream, arena);
    arena.is_angle = was_angle;
    arguments
}

fn listed(stream: ParseStream, arena: &mut Expressions) -> syn::Result<(Vec<ExpressionId>, Span)> {
    let content;
    let parentheses = syn::parenthesized!(content in stream);
    let mut arguments = Vec::new();
    while !content.is_empty() {
        arguments.push(parse(&content, arena)?);
        if content.is_empty() {
            break;
        }
        comma(&content)?;
    }
    Ok((arguments, parentheses.span.close()))
}

fn comma(stream: ParseStream) -> syn::Result<()> {
    let found = stream.span();
    if stream.parse::<Option<Token![,]>>()?.is_some() {
        return Ok(());
    }
    Err(foreign::sign(stream).unwrap_or_else(|| syn::Error::new(found, "expected `,` or `)`")))
}

fn primary(stream: ParseStream, arena: &mut Expressions) -> syn::Result<ExpressionId> {
    let start = stream.span();
    let missing =
        || syn::Error::new(start, "expected an expression: a number, a name, `r@phi`, `(x, y)` or a function");
    if stream.is_empty() || stream.peek(Token![;]) {
        return Err(missing());
    }
    if let Some(value) = foreign::primary(stream, arena)? {
        return Ok(value);
    }
    if let Ok(literal) = stream.fork().parse::<Lit>() {
        Lit::parse(stream)?;
        return number(&literal, arena);
    }
    if stream.peek(syn::token::Paren) {
        let (items, close) = arguments(stream, arena)?;
        let region = Region::from(start).to(close.into());
        return match *items.as_slice() {
            [inner] => Ok(inner),
            [x, y] => Ok(arena.push(Expression::Vector(x, y), region)),
            _ => Err(syn::Error::new_spanned(region, "expected `(expression)` or a vector `(x, y)`")),
        };
    }
    // An `$x:expr` from another macro comes in invisible delimiters.
    if let Ok(proc_macro2::TokenTree::Group(group)) = stream.fork().parse()
        && group.delimiter() == Delimiter::None
    {
        stream.parse::<proc_macro2::TokenTree>()?;
        return syn::parse::Parser::parse2(|inner: ParseStream| parse(inner, arena), group.stream());
    }
    let name = stream.call(Ident::parse_any).map_err(|_| missing())?;
    if stream.peek(syn::token::Paren) {
        let (arguments, close) = arguments(stream, arena)?;
        let region = Region::from(name.span()).to(close.into());
        return Ok(arena.push(Expression::Call(name, arguments), region));
    }
    let region = name.span().into();
    Ok(arena.push(Expression::Name(name), region))
}

fn number(literal: &Lit, arena: &mut Expressions) -> syn::Result<ExpressionId> {
    let (digits, suffix) = match literal {
        Lit::Int(integer) => (integer.base10_digits().to_owned(), integer.suffix().to_owned()),
        Lit::Float(float) => (float.base10_digits().to_owned(), float.suffix().to_owned()),
        other => return Err(foreign::not_a_number(other)),
    };
    let unit = match Unit::ALL.iter().find(|(name, _)| *name == suffix) {
        Some((_, unit)) => *unit,
        None if suffix.is_empty() => Unit::None,
        None => {
            arena.unit(&suffix, literal.span().into(), &digits);
            if suffix.starts_with("deg") { Unit::Degrees } else { Unit::None }
        }
    };
    Ok(arena.push(Expression::Number { digits, unit }, literal.span().into()))
}

/// The message of a suffix that is not a unit of the language.
fn unknown_unit(suffix: &str, digits: &str) -> String {
    let is_type = ["f16", "f32", "f64", "f128", "i8", "i16", "i32", "i64", "isize", "u8", "u16", "u32", "u64", "usize"];
    if is_type.contains(&suffix) {
        return format!("a number has no type: write `{digits}`");
    }
    match Unit::ALL.iter().find(|(unit, _)| suffix.starts_with(unit)) {
        Some((unit, _)) => format!("unknown unit `{suffix}`: write `{digits}{unit}`"),
        None => format!(
            "unknown unit `{suffix}`: write `{digits}`, with all numbers in one system of units; an angle may have `deg`"
        ),
    }
}
