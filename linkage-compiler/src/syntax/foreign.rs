//! Notation of other languages in expressions: reported, and read as it is meant, so that the rest is still checked.

use proc_macro2::{Delimiter, Ident, TokenTree};
use syn::ext::IdentExt;
use syn::parse::ParseStream;
use syn::{Lit, Token};

use super::expression::{Expression, ExpressionId, Expressions, Operator, Unit};
use super::kind::is_reserved;
use super::tokens::take;
use crate::diagnostics::Region;

/// Units that may stand apart from their number. Those of one letter may be names.
const UNITS: [&str; 16] = [
    "deg", "degree", "degrees", "rad", "radian", "radians", "mm", "cm", "km", "inch", "kg", "kN", "Nm", "rpm", "Hz",
    "kPa",
];

pub(super) const NO_FIELDS: &str = "a value has no fields: write `x(P)` or `y(P)` for a coordinate of a point";

/// Words for a product in other languages.
const TIMES: [&str; 3] = ["x", "X", "times"];

/// True if a number, a name or a parenthesis comes next: an operator is missing before it.
pub(super) fn begins_factor(stream: ParseStream) -> bool {
    let ahead = stream.fork();
    match ahead.parse::<TokenTree>() {
        // A name with `=` is the next of a list.
        Ok(TokenTree::Ident(word)) => {
            !is_reserved(&word.to_string())
                && syn::parse_str::<Ident>(&word.to_string()).is_ok()
                && !ahead.peek(Token![=])
        }
        Ok(TokenTree::Literal(_)) => true,
        Ok(TokenTree::Group(group)) => group.delimiter() == Delimiter::Parenthesis,
        _ => false,
    }
}

/// A factor without an operator before it: `2 l3` and `2 x l3` are read as products.
pub(super) fn product(
    stream: ParseStream,
    last: ExpressionId,
    arena: &mut Expressions,
) -> syn::Result<Option<Operator>> {
    // Before a vector, `=` is missing.
    if !begins_factor(stream) || (arena.is_angle && stream.peek2(Token![@])) {
        return Ok(None);
    }
    let ahead = stream.fork();
    if let Ok(word) = ahead.parse::<Ident>()
        && TIMES.iter().any(|times| word == times)
        && begins_factor(&ahead)
    {
        stream.parse::<TokenTree>()?;
        arena.slip(word.span(), "write `*` for a product");
        return Ok(Some(Operator::Direct));
    }
    // The name of a function before its argument is found later.
    if arena.as_name(last).is_none() {
        let next: TokenTree = stream.fork().parse()?;
        arena.slip(next.span(), "expected an operator before this: write `*` for a product");
    }
    Ok(Some(Operator::Missing))
}

/// `x**n`, read as `x^n`.
pub(super) fn power(stream: ParseStream, arena: &mut Expressions) -> bool {
    let Some(region) = take(stream, "**") else { return false };
    arena.slip(region, "write `^` for a power, as in `x^2`");
    true
}

/// `if` and `match`, with all that belongs to them.
pub(super) fn condition(stream: ParseStream, arena: &mut Expressions) -> syn::Result<ExpressionId> {
    let start = Region::from(stream.span());
    let word: Ident = stream.call(Ident::parse_any)?;
    let region = loop {
        let token: TokenTree = stream.parse()?;
        let closes = matches!(&token, TokenTree::Group(group) if group.delimiter() == Delimiter::Brace);
        if (closes && !stream.peek(Token![else])) || stream.is_empty() || stream.peek(Token![;]) {
            break start.to(token.span().into());
        }
    };
    let message = format!("`{word}` cannot be part of an expression: put the cases into a user function, `extern fn`");
    arena.slip(region, message);
    Ok(arena.push(Expression::Broken, region))
}

/// The path of a constant, a function or a macro of Rust.
pub(super) fn path(stream: ParseStream, arena: &mut Expressions) -> syn::Result<Option<ExpressionId>> {
    let ahead = stream.fork();
    let Ok(first) = ahead.call(Ident::parse_any) else { return Ok(None) };
    let mut last = first.clone();
    while ahead.parse::<Option<Token![::]>>()?.is_some() {
        last = ahead.call(Ident::parse_any)?;
    }
    let is_macro = ahead.peek(Token![!]) && ahead.peek2(syn::token::Paren);
    if first == last && !is_macro {
        return Ok(None);
    }
    let mut region = Region { first: first.span(), last: last.span() };
    let is_call = is_macro || ahead.peek(syn::token::Paren);
    if is_macro {
        ahead.parse::<TokenTree>()?;
        if let TokenTree::Group(group) = ahead.parse()? {
            region.last = group.span_close();
        }
    } else if is_call {
        ahead.parse::<TokenTree>()?;
    }
    syn::parse::discouraged::Speculative::advance_to(stream, &ahead);
    let message = match last.to_string().as_str() {
        _ if is_macro => "a Rust macro cannot be part of an expression".to_owned(),
        _ if is_call => "a Rust function needs a declaration: `extern fn path::to(x) -> (f, df, ddf);`".to_owned(),
        constant => match constant_of_rust(constant) {
            Some(value) => format!("a Rust constant cannot be used here: write `{value}`"),
            None => "a Rust constant cannot be used here: write its value, or a `param`".to_owned(),
        },
    };
    arena.slip(region, message);
    Ok(Some(arena.push(Expression::Broken, region)))
}

/// The spelling of a constant of `std::f64::consts`.
pub(crate) fn constant_of_rust(name: &str) -> Option<&'static str> {
    Some(match name {
        "PI" | "Pi" | "M_PI" => "pi",
        "TAU" | "tau" | "two_pi" => "2*pi",
        "FRAC_PI_2" => "pi/2",
        "FRAC_PI_3" => "pi/3",
        "FRAC_PI_4" => "pi/4",
        "FRAC_PI_6" => "pi/6",
        "FRAC_PI_8" => "pi/8",
        "SQRT_2" => "sqrt(2)",
        "FRAC_1_SQRT_2" => "sqrt(1/2)",
        "E" => "exp(1)",
        _ => return None,
    })
}

/// Parses another notation after a value: `P.x`, `P[0]`, `20 deg`.
pub(super) fn postfix(
    stream: ParseStream,
    value: ExpressionId,
    arena: &mut Expressions,
) -> syn::Result<Option<ExpressionId>> {
    let region = arena.region(value);
    if stream.peek(Token![.]) && !stream.peek(Token![..]) && !stream.peek3(syn::token::Paren) {
        let ahead = stream.fork();
        ahead.parse::<Token![.]>()?;
        if let Ok(field) = ahead.call(Ident::parse_any) {
            syn::parse::discouraged::Speculative::advance_to(stream, &ahead);
            let region = region.to(field.span().into());
            let of = arena.as_name(value).map_or_else(|| "P".to_owned(), ToString::to_string);
            return Ok(Some(match field.to_string().to_lowercase().as_str() {
                axis @ ("x" | "y") => {
                    arena.slip(region, format!("write `{axis}({of})`"));
                    arena.push(Expression::Call(Ident::new(axis, field.span()), vec![value]), region)
                }
                _ => {
                    arena.slip(region, NO_FIELDS);
                    arena.push(Expression::Broken, region)
                }
            }));
        }
    }
    if stream.peek(syn::token::Bracket) {
        let TokenTree::Group(group) = stream.parse()? else { return Ok(None) };
        let of = Region::from(group.span_open()).to(group.span_close().into());
        arena.slip(of, "a value has no index: write `x(P)` or `y(P)` for a coordinate of a point");
        return Ok(Some(arena.push(Expression::Broken, region.to(of))));
    }
    let ahead = stream.fork();
    if let Ok(word) = ahead.parse::<Ident>()
        && UNITS.iter().any(|unit| word == unit)
        && !ahead.peek(Token![=])
    {
        syn::parse::discouraged::Speculative::advance_to(stream, &ahead);
        let digits = arena.digits(value).map(str::to_owned);
        return Ok(Some(apart(&word, digits.as_deref(), value, arena)));
    }
    Ok(None)
}

/// A value followed by a unit.
fn apart(word: &Ident, digits: Option<&str>, value: ExpressionId, arena: &mut Expressions) -> ExpressionId {
    let text = word.to_string();
    let Some(digits) = digits else {
        let message = format!("a unit follows a number, as in `20deg`: remove `{text}`; angles are in radians");
        arena.slip(word.span(), message);
        return value;
    };
    if let Some((name, unit)) = Unit::meant(&text) {
        arena.slip(word.span(), format!("write `{digits}{name}`, without a space"));
        return arena.push(Expression::Number { digits: digits.to_owned(), unit }, arena.region(value));
    }
    arena.unit(&text, word.span().into(), digits);
    value
}

/// The message of a sign that is not part of an expression.
pub(super) fn sign(stream: ParseStream) -> Option<syn::Error> {
    const SIGNS: [(&str, &str); 16] = [
        ("..=", "a range is written `lower..upper`, in a `stop`"),
        (",", "expected `;`, found `,`"),
        ("==", "expected `;`, found `==`: a statement has one `=`"),
        ("=", "expected `;`, found `=`: a statement has one `=`"),
        (
            "<",
            "an expression has no comparison: a limit is a range, as in `unknown s in 0..1;`, or a `stop` in a scene",
        ),
        (
            ">",
            "an expression has no comparison: a limit is a range, as in `unknown s in 0..1;`, or a `stop` in a scene",
        ),
        ("%", "`%` is not an operator: the operators are `+ - * / ^ @`; a comment begins with `//`"),
        ("?", "`?` is not an operator: put cases into a user function, `extern fn`"),
        ("!", "`!` is not an operator: the operators are `+ - * / ^ @`"),
        ("&", "`&` is not an operator: the operators are `+ - * / ^ @`"),
        ("|", "`|` is not an operator: write `abs(x)`, or `norm(P)` for a vector"),
        ("#", "`#` is not an operator: a vector is `r@phi`; a comment begins with `//`"),
        (
            "..",
            "a range can be used only after the name of a coordinate or an output, as in `unknown s in 0..1;`, or in a `stop`",
        ),
        ("->", "`->` can be used only after `extern fn`"),
        (":", "expected `;`, found `:`"),
        ("~", "`~` is not an operator: the operators are `+ - * / ^ @`"),
    ];
    if stream.peek(Token![as]) {
        return Some(stream.error("a number has no type: remove `as` and the type"));
    }
    let ahead = stream.fork();
    SIGNS.iter().find_map(|(sign, message)| Some(syn::Error::new_spanned(take(&ahead, sign)?, message)))
}

/// A literal that is not a number.
pub(super) fn not_a_number(literal: &Lit) -> syn::Error {
    let message = match literal {
        Lit::Str(_) => "expected a number, found a text: write it without quotation marks",
        _ => "expected a number",
    };
    syn::Error::new(literal.span(), message)
}
