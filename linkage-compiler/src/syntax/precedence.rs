//! Parsers of expressions. Precedence from low to high: `+ -`, `@`, `* /`, unary `-`, `^`.

use proc_macro2::{Ident, Span, TokenTree};
use syn::ext::IdentExt;
use syn::parse::{Parse, ParseStream};
use syn::{Lit, Token};

use super::expression::{Expression, ExpressionId, Expressions, Operator, Suffix, Unit};
use super::foreign;
use super::identifier::plain;
use super::limits::DEEPEST_NESTING;
use super::tokens::take;
use crate::diagnostics::Region;

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
                arena.spoil(before);
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
        let no_field = |error: syn::Error| syn::Error::new(error.span(), foreign::NO_FIELDS);
        let method = plain(stream.call(Ident::parse_any).map_err(no_field)?);
        let Parenthesised { mut items, close, .. } = arguments(stream, arena)?;
        items.insert(0, value);
        let region = arena.region(value).to(close.into());
        value = arena.push(Expression::Call(method, items), region);
    }
    Ok(value)
}

/// Expressions in parentheses.
struct Parenthesised {
    items: Vec<ExpressionId>,
    close: Span,
    /// True if a comma follows the last.
    has_last_comma: bool,
}

fn arguments(stream: ParseStream, arena: &mut Expressions) -> syn::Result<Parenthesised> {
    let was_angle = std::mem::take(&mut arena.is_angle);
    let arguments = listed(stream, arena);
    arena.is_angle = was_angle;
    arguments
}

fn listed(stream: ParseStream, arena: &mut Expressions) -> syn::Result<Parenthesised> {
    let content;
    let parentheses = syn::parenthesized!(content in stream);
    let mut listed = Parenthesised { items: Vec::new(), close: parentheses.span.close(), has_last_comma: false };
    while !content.is_empty() {
        listed.items.push(parse(&content, arena)?);
        listed.has_last_comma = !content.is_empty();
        if content.is_empty() {
            break;
        }
        comma(&content)?;
    }
    Ok(listed)
}

fn comma(stream: ParseStream) -> syn::Result<()> {
    let found = stream.span();
    if stream.parse::<Option<Token![,]>>()?.is_some() {
        return Ok(());
    }
    Err(foreign::sign(stream).unwrap_or_else(|| syn::Error::new(found, "expected `,` or `)`")))
}

fn primary(stream: ParseStream, arena: &mut Expressions) -> syn::Result<ExpressionId> {
    while let Some((region, message)) = SIGNS.iter().find_map(|(sign, message)| Some((take(stream, sign)?, message))) {
        arena.slip(region, message);
    }
    let start = stream.span();
    let missing =
        || syn::Error::new(start, "expected an expression: a number, a name, `r@phi`, `(x, y)` or a function");
    if stream.is_empty() || stream.peek(Token![;]) {
        return Err(missing());
    }
    if let Some(value) = other_notation(stream, arena)? {
        return Ok(value);
    }
    if let Ok(literal) = stream.fork().parse::<Lit>() {
        Lit::parse(stream)?;
        return number(stream, &literal, arena);
    }
    if stream.peek(syn::token::Paren) {
        let Parenthesised { items, close, has_last_comma } = arguments(stream, arena)?;
        let region = Region::from(start).to(close.into());
        return match *items.as_slice() {
            [_] if has_last_comma => {
                arena.slip(region, "a vector has two components: write `(x, y)`, or `(x)` without the comma");
                Ok(arena.push(Expression::Broken, region))
            }
            [inner] => Ok(inner),
            [x, y] => Ok(arena.push(Expression::Vector(x, y), region)),
            _ => Err(syn::Error::new_spanned(region, "expected `(expression)` or a vector `(x, y)`")),
        };
    }
    let name = plain(stream.call(Ident::parse_any).map_err(|_| missing())?);
    name_or_call(stream, name, arena)
}

/// A name, or the call of a function.
fn name_or_call(stream: ParseStream, name: Ident, arena: &mut Expressions) -> syn::Result<ExpressionId> {
    if stream.peek(syn::token::Paren) {
        let Parenthesised { items, close, .. } = arguments(stream, arena)?;
        let region = Region::from(name.span()).to(close.into());
        return Ok(arena.push(Expression::Call(name, items), region));
    }
    let region = name.span().into();
    Ok(arena.push(Expression::Name(name), region))
}

fn number(stream: ParseStream, literal: &Lit, arena: &mut Expressions) -> syn::Result<ExpressionId> {
    let (digits, suffix, text) = match literal {
        Lit::Int(integer) => (integer.base10_digits().to_owned(), integer.suffix().to_owned(), integer.to_string()),
        Lit::Float(float) => (float.base10_digits().to_owned(), float.suffix().to_owned(), float.to_string()),
        other => return Err(foreign::not_a_number(other)),
    };
    let region = Region::from(literal.span());
    // The second point of `2.5.1`.
    if stream.peek(Token![.]) && (stream.peek2(syn::LitInt) || stream.peek2(syn::LitFloat)) {
        stream.parse::<TokenTree>()?;
        let rest: TokenTree = stream.parse()?;
        let region = region.to(rest.span().into());
        return Err(syn::Error::new_spanned(
            region,
            format!("`{text}.{rest}` is not a number: write one decimal point"),
        ));
    }
    let unit = match Unit::ALL.iter().find(|(name, _)| *name == suffix) {
        Some((_, unit)) => *unit,
        None if suffix.is_empty() => Unit::None,
        None => {
            let is_hexadecimal = text.to_lowercase().starts_with("0x");
            let mut word: Ident = syn::parse::Parser::parse_str(Ident::parse_any, &suffix)?;
            word.set_span(literal.span());
            if stream.peek(syn::token::Paren) {
                arena.slip(region, format!("expected an operator: write `{digits}*{word}(…)` for a product"));
                return name_or_call(stream, word, arena);
            }
            return Ok(arena.push_suffixed(digits, Suffix { word, is_hexadecimal }, region));
        }
    };
    Ok(arena.push(Expression::Number { digits, unit }, region))
}

/// Signs before a factor that have no meaning, and what is said of them.
const SIGNS: [(&str, &str); 3] = [
    ("+", "remove this `+`: a term needs no sign `+`"),
    ("&", "remove this `&`: a value has no reference"),
    ("...", "remove this `...`: a statement ends with `;` only"),
];

/// Parses another notation of a factor.
fn other_notation(stream: ParseStream, arena: &mut Expressions) -> syn::Result<Option<ExpressionId>> {
    if stream.peek(syn::token::Bracket) || stream.peek(syn::token::Brace) {
        return group(stream, arena).map(Some);
    }
    if stream.peek(Token![|]) {
        return bars(stream, arena);
    }
    let is_name = stream.peek(Token![match]) && arena.keywords().any(|keyword| keyword == "match");
    if stream.peek(Token![if]) || (stream.peek(Token![match]) && !is_name) {
        return foreign::condition(stream, arena).map(Some);
    }
    foreign::path(stream, arena)
}

/// `[x, y]` and `{x, y}`, read as `(x, y)`.
fn group(stream: ParseStream, arena: &mut Expressions) -> syn::Result<ExpressionId> {
    let TokenTree::Group(group) = stream.parse::<TokenTree>()? else { return Err(stream.error("expected a group")) };
    let parser = |inner: ParseStream| {
        let mut items = Vec::new();
        while !inner.is_empty() {
            items.push(parse(inner, arena)?);
            if inner.parse::<Option<Token![,]>>()?.is_none() {
                break;
            }
        }
        let rest: proc_macro2::TokenStream = inner.parse()?;
        Ok((items, rest.is_empty()))
    };
    let read = syn::parse::Parser::parse2(parser, group.stream());
    let region = Region::from(group.span_open()).to(group.span_close().into());
    match read {
        Ok((items, true)) if items.len() == 1 => {
            arena.slip(region, "write parentheses: `( … )`");
            Ok(items[0])
        }
        Ok((items, true)) if items.len() == 2 => {
            arena.slip(region, "write a vector in parentheses: `(x, y)`");
            Ok(arena.push(Expression::Vector(items[0], items[1]), region))
        }
        _ => Err(syn::Error::new(group.span(), "expected an expression: a vector is written `(x, y)`")),
    }
}

/// `|x|`. Each bar may begin one: they nest no deeper than parentheses.
fn bars(stream: ParseStream, arena: &mut Expressions) -> syn::Result<Option<ExpressionId>> {
    if arena.open_bars == DEEPEST_NESTING {
        return Ok(None);
    }
    let start = Region::from(stream.span());
    let ahead = stream.fork();
    ahead.parse::<Token![|]>()?;
    let before = arena.len();
    arena.open_bars += 1;
    let inner = parse(&ahead, arena);
    arena.open_bars -= 1;
    let end = Region::from(ahead.span());
    if inner.is_err() || !ahead.peek(Token![|]) {
        arena.truncate(before);
        return Ok(None);
    }
    ahead.parse::<Token![|]>()?;
    syn::parse::discouraged::Speculative::advance_to(stream, &ahead);
    let region = start.to(end);
    if foreign::begins_factor(stream) {
        return Err(syn::Error::new_spanned(region, "a function written with bars cannot be part of an expression"));
    }
    arena.slip(region, "write `abs(x)`, or `norm(P)` for a vector");
    Ok(Some(arena.push(Expression::Broken, region)))
}
