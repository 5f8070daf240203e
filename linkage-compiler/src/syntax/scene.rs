//! Bodies and scenes.

use proc_macro2::{Ident, Span, TokenTree};
use syn::ext::IdentExt;
use syn::parse::ParseStream;
use syn::{Attribute, Token};

use super::attributes::{self, Bearer};
use super::expression::{self, ExpressionId, Expressions};
use super::tokens::{end, equals, name};
use crate::diagnostics::{Diagnostics, suggestion};

/// `body NAME { mass m; inertia j; center G; angle phi; }`
pub struct Body {
    pub name: Ident,
    /// The keyword and the value of each property.
    pub properties: Vec<(Ident, ExpressionId)>,
    /// True if it has no syntax error.
    pub is_complete: bool,
}

/// `scene NAME { … }`, or `scene NAME of DRIVER { … }`.
pub struct Scene {
    pub name: Ident,
    pub of: Option<Ident>,
    pub effects: Vec<Effect>,
    /// True if it has no syntax error.
    pub is_complete: bool,
}

/// One effect of a scene.
pub struct Effect {
    pub keyword: Ident,
    pub kind: EffectKind,
}

/// The kind and the content of an effect.
pub enum EffectKind {
    /// The inertia of these bodies, of all if there are none.
    Inertia(Vec<Ident>),
    Gravity {
        field: ExpressionId,
        bodies: Vec<Ident>,
    },
    Spring {
        stiffness: ExpressionId,
        free: Option<ExpressionId>,
        place: Place,
    },
    Damper {
        constant: ExpressionId,
        place: Place,
    },
    Torque {
        law: ExpressionId,
        on: ExpressionId,
    },
    Force {
        law: ExpressionId,
        at: ExpressionId,
    },
    Potential(ExpressionId),
    Friction {
        /// The factors of the largest force.
        factors: Vec<ExpressionId>,
        on: ExpressionId,
    },
    Stop {
        on: ExpressionId,
        range: [ExpressionId; 2],
        restitution: ExpressionId,
    },
    Drive {
        input: Ident,
        law: ExpressionId,
    },
    /// A keyword that adds functions.
    Request,
}

/// The scalar that a spring or damper acts along: an expression, or the distance of two points.
pub enum Place {
    On(ExpressionId),
    Between(ExpressionId, ExpressionId),
}

const EFFECTS: [&str; 14] = [
    "inertia",
    "gravity",
    "spring",
    "damper",
    "torque",
    "force",
    "potential",
    "friction",
    "stop",
    "drive",
    "energy",
    "power",
    "reactions",
    "equilibrium",
];

pub(super) fn body(
    stream: ParseStream,
    expressions: &mut Expressions,
    diagnostics: &mut Diagnostics,
) -> syn::Result<Body> {
    const PROPERTIES: [&str; 4] = ["mass", "inertia", "center", "angle"];
    let name = name(stream)?;
    let property = |stream: ParseStream, expressions: &mut Expressions| {
        let word: Ident = stream.call(Ident::parse_any)?;
        let text = word.to_string();
        if !PROPERTIES.contains(&text.as_str()) {
            let (hint, all) = (suggestion(&text, PROPERTIES), PROPERTIES.join(", "));
            return Err(syn::Error::new(word.span(), format!("a body has no `{text}`{hint}\nproperties: {all}")));
        }
        Ok((word, expression::parse(stream, expressions)?))
    };
    let before = diagnostics.len();
    let properties =
        braces(stream, name.span(), "mass m; inertia j; center G; angle phi;", expressions, diagnostics, property)?;
    Ok(Body { name, properties, is_complete: diagnostics.len() == before })
}

pub(super) fn scene(
    stream: ParseStream,
    expressions: &mut Expressions,
    diagnostics: &mut Diagnostics,
) -> syn::Result<Scene> {
    let scene = name(stream)?;
    let of = if word(stream, "of") { Some(name(stream)?) } else { None };
    let before = diagnostics.len();
    let effects = braces(stream, scene.span(), "inertia; gravity (0, -g);", expressions, diagnostics, effect)?;
    Ok(Scene { name: scene, of, effects, is_complete: diagnostics.len() == before })
}

/// Parses the items in the next braces, each ended by `;`; one with a syntax error is reported and skipped.
fn braces<V>(
    stream: ParseStream,
    before: Span,
    example: &str,
    expressions: &mut Expressions,
    diagnostics: &mut Diagnostics,
    item: impl Fn(ParseStream, &mut Expressions) -> syn::Result<V>,
) -> syn::Result<Vec<V>> {
    if !stream.peek(syn::token::Brace) {
        let found = if stream.is_empty() { before } else { stream.span() };
        return Err(syn::Error::new(found, format!("expected braces: `{{ {example} }}`")));
    }
    let content;
    let braces = syn::braced!(content in stream);
    if content.is_empty() {
        return Err(syn::Error::new(braces.span.join(), format!("empty braces: write for example `{{ {example} }}`")));
    }
    let mut items = Vec::new();
    while !content.is_empty() {
        let length = expressions.len();
        let read = content.call(Attribute::parse_outer).and_then(|attributes| {
            attributes::meant(attributes, Bearer::Part, diagnostics);
            item(&content, expressions)
        });
        let ended = read.is_ok().then(|| {
            let last = expressions.last_region().filter(|_| expressions.len() > length);
            end(&content, Some(last.unwrap_or_else(|| before.into())))
        });
        match (read, ended) {
            (Ok(read), Some(Ok(()))) => items.push(read),
            (Err(error), _) | (_, Some(Err(error))) => {
                diagnostics.push(error);
                expressions.truncate(length);
                skip(&content);
            }
            (Ok(_), None) => {}
        }
    }
    Ok(items)
}

fn skip(stream: ParseStream) {
    while let Ok(token) = stream.parse::<TokenTree>() {
        if matches!(&token, TokenTree::Punct(punct) if punct.as_char() == ';') {
            return;
        }
    }
}

/// Takes the next token if it is this keyword.
fn word(stream: ParseStream, expected: &str) -> bool {
    let is_there = stream.fork().call(Ident::parse_any).is_ok_and(|word| word == expected);
    is_there && stream.call(Ident::parse_any).is_ok()
}

fn effect(stream: ParseStream, expressions: &mut Expressions) -> syn::Result<Effect> {
    let keyword: Ident = stream
        .call(Ident::parse_any)
        .map_err(|error| syn::Error::new(error.span(), format!("expected an effect: {}", EFFECTS.join(", "))))?;
    let expected = |stream: ParseStream, form: &str| {
        let found = if stream.is_empty() { keyword.span() } else { stream.span() };
        syn::Error::new(found, format!("expected `{form}`"))
    };
    let text = keyword.to_string();
    let kind = match text.as_str() {
        "inertia" => EffectKind::Inertia(if stream.peek(Token![;]) { Vec::new() } else { bodies(stream)? }),
        "gravity" => {
            let field = expression::parse(stream, expressions)?;
            let bodies = if word(stream, "on") { bodies(stream)? } else { Vec::new() };
            EffectKind::Gravity { field, bodies }
        }
        "spring" => {
            let stiffness = expression::parse(stream, expressions)?;
            let free = stream.parse::<Option<Token![,]>>()?;
            let free = free.map(|_| expression::parse(stream, expressions)).transpose()?;
            let place = place(stream, expressions)?;
            let place =
                place.ok_or_else(|| expected(stream, "spring k, s0 between P and Q;` or `spring k, phi0 on phi;"))?;
            EffectKind::Spring { stiffness, free, place }
        }
        "damper" => {
            let constant = expression::parse(stream, expressions)?;
            let place = place(stream, expressions)?;
            let place = place.ok_or_else(|| expected(stream, "damper c between P and Q;` or `damper c on phi;"))?;
            EffectKind::Damper { constant, place }
        }
        "torque" => {
            let law = expression::parse(stream, expressions)?;
            if !word(stream, "on") {
                return Err(expected(stream, "torque LAW on phi;"));
            }
            EffectKind::Torque { law, on: expression::parse(stream, expressions)? }
        }
        "force" => {
            let law = expression::parse(stream, expressions)?;
            if !word(stream, "at") {
                return Err(expected(stream, "force (fx, fy) at P;"));
            }
            EffectKind::Force { law, at: expression::parse(stream, expressions)? }
        }
        "potential" => EffectKind::Potential(expression::parse(stream, expressions)?),
        "friction" => {
            let mut factors = vec![expression::parse(stream, expressions)?];
            while factors.len() < 3 && stream.parse::<Option<Token![,]>>()?.is_some() {
                factors.push(expression::parse(stream, expressions)?);
            }
            if !word(stream, "on") {
                return Err(expected(stream, "friction mu, radius, normal on phi;` or `friction mu, normal on s;"));
            }
            EffectKind::Friction { factors, on: expression::parse(stream, expressions)? }
        }
        "stop" => {
            const FORM: &str = "stop phi in lower..upper, restitution e;";
            let on = expression::parse(stream, expressions)?;
            if !word(stream, "in") {
                return Err(expected(stream, FORM));
            }
            let lower = expression::parse(stream, expressions)?;
            if stream.peek(Token![..=]) || stream.parse::<Option<Token![..]>>()?.is_none() {
                return Err(expected(stream, FORM));
            }
            let range = [lower, expression::parse(stream, expressions)?];
            if stream.parse::<Option<Token![,]>>()?.is_none() || !word(stream, "restitution") {
                return Err(expected(stream, FORM));
            }
            EffectKind::Stop { on, range, restitution: expression::parse(stream, expressions)? }
        }
        "drive" => {
            let input = name(stream)?;
            equals(stream)?;
            EffectKind::Drive { input, law: expression::parse(stream, expressions)? }
        }
        "energy" | "power" | "reactions" | "equilibrium" => EffectKind::Request,
        unknown => {
            let (hint, all) = (suggestion(unknown, EFFECTS), EFFECTS.join(", "));
            return Err(syn::Error::new(keyword.span(), format!("unknown effect `{unknown}`{hint}\neffects: {all}")));
        }
    };
    Ok(Effect { keyword, kind })
}

fn bodies(stream: ParseStream) -> syn::Result<Vec<Ident>> {
    let mut bodies = vec![name(stream)?];
    while stream.parse::<Option<Token![,]>>()?.is_some() {
        bodies.push(name(stream)?);
    }
    Ok(bodies)
}

/// Parses `on phi` or `between P and Q`.
fn place(stream: ParseStream, expressions: &mut Expressions) -> syn::Result<Option<Place>> {
    if word(stream, "on") {
        return Ok(Some(Place::On(expression::parse(stream, expressions)?)));
    }
    if !word(stream, "between") {
        return Ok(None);
    }
    let from = expression::parse(stream, expressions)?;
    if !word(stream, "and") {
        return Ok(None);
    }
    Ok(Some(Place::Between(from, expression::parse(stream, expressions)?)))
}
