//! Expressions, in an arena in which operands have smaller ids than the expressions that use them.
//!
//! Precedence from low to high: `+ -`, `@`, `* /`, unary `-`, `^`.

use proc_macro2::{Delimiter, Ident, Span};
use syn::ext::IdentExt;
use syn::parse::{Parse, ParseStream};
use syn::{Lit, Token};

use crate::diagnostics::Region;

/// An expression of an [`Expressions`] arena.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ExpressionId(usize);

/// An expression as written.
#[derive(Debug)]
pub enum Expression {
    /// The digits of a literal; `degrees` if the suffix is `deg`.
    Number {
        digits: String,
        degrees: bool,
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
    /// An expression with a syntax error: its names.
    Unread(Vec<Unread>),
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
}

/// The expressions of one mechanism.
#[derive(Debug, Default)]
pub struct Expressions {
    nodes: Vec<(Expression, Region)>,
}

impl Expressions {
    fn push(&mut self, expression: Expression, region: Region) -> ExpressionId {
        self.nodes.push((expression, region));
        ExpressionId(self.nodes.len() - 1)
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

    /// Adds an expression with a syntax error.
    pub(super) fn unread(&mut self, names: Vec<Unread>, region: Region) -> ExpressionId {
        self.push(Expression::Unread(names), region)
    }

    /// Removes the expressions of a statement with a syntax error.
    pub(super) fn truncate(&mut self, length: usize) {
        self.nodes.truncate(length);
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
    pub fn get(&self, id: ExpressionId) -> &Expression {
        &self.nodes[id.0].0
    }

    #[must_use]
    pub fn region(&self, id: ExpressionId) -> Region {
        self.nodes[id.0].1
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
        |stream| {
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
        |stream| {
            Ok(if stream.parse::<Option<Token![*]>>()?.is_some() {
                Some(Operator::Direct)
            } else {
                stream.parse::<Option<Token![/]>>()?.map(|_| Operator::Inverse)
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
    operator: fn(ParseStream) -> syn::Result<Option<Operator>>,
    build: fn(Vec<(Operator, ExpressionId)>) -> Expression,
) -> syn::Result<ExpressionId> {
    let first = part(stream, arena)?;
    let mut operands = vec![(Operator::Direct, first)];
    let mut last = first;
    while let Some(operator) = operator(stream)? {
        last = part(stream, arena)?;
        operands.push((operator, last));
    }
    if operands.len() == 1 {
        return Ok(first);
    }
    let region = arena.region(first).to(arena.region(last));
    Ok(arena.push(build(operands), region))
}

fn at(stream: ParseStream, arena: &mut Expressions) -> syn::Result<ExpressionId> {
    let magnitude = product(stream, arena)?;
    if stream.parse::<Option<Token![@]>>()?.is_none() {
        return Ok(magnitude);
    }
    let angle = product(stream, arena)?;
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
    if stream.parse::<Option<Token![^]>>()?.is_none() {
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

fn postfix(stream: ParseStream, arena: &mut Expressions) -> syn::Result<ExpressionId> {
    let mut value = primary(stream, arena)?;
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
    stream.parse::<Token![,]>().map(drop).map_err(|_| syn::Error::new(found, "expected `,` or `)`"))
}

fn primary(stream: ParseStream, arena: &mut Expressions) -> syn::Result<ExpressionId> {
    let start = stream.span();
    let missing = || syn::Error::new(start, "expected an expression");
    if stream.is_empty() || stream.peek(Token![;]) {
        return Err(missing());
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
        other => return Err(syn::Error::new(other.span(), "expected a number")),
    };
    let degrees = match suffix.as_str() {
        "" => false,
        "deg" => true,
        other => {
            let message = format!("unknown unit `{other}`: write a plain number, or `deg` for degrees");
            return Err(syn::Error::new(literal.span(), message));
        }
    };
    Ok(arena.push(Expression::Number { digits, degrees }, literal.span().into()))
}
