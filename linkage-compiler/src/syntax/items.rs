//! Parsers of bodies and scenes, item by item.

use proc_macro2::{Ident, TokenTree};
use syn::Token;
use syn::ext::IdentExt;
use syn::parse::ParseStream;
use syn::parse::discouraged::Speculative;

use super::expression::{ExpressionId, Expressions};
use super::kind::{Bearer, KEYWORDS, at_word};
use super::list::names;
use super::punctuation::{end, equals};
use super::scene::{Attachment, Body, EFFECTS, Effect, EffectKind, Joint, PROPERTIES, Scene};
use super::tokens::{self, name, take};
use super::{attributes, precedence, recovery};
use crate::diagnostics::{Diagnostics, nearest};

/// The forms of a friction, with the meaning of its factors.
const FRICTION: &str = "friction mu, normal on s;` or `friction mu, radius, normal on phi;`\nthe product of the factors is \
    the largest force along a length `s`, or the largest torque about an angle `phi`; `reaction` instead of `normal` is \
    the force in the joint of `s` or `phi`, as in `friction mu, reaction on s;";

/// Words that are written for an effect or a property.
const SYNONYMS: [(&str, &str); 21] = [
    ("weight", "gravity"),
    ("gravitation", "gravity"),
    ("motor", "drive"),
    ("motion", "drive"),
    ("moment", "torque"),
    ("load", "force"),
    ("limit", "stop"),
    ("limits", "stop"),
    ("bumper", "stop"),
    ("damping", "damper"),
    ("dashpot", "damper"),
    ("masses", "inertia"),
    ("cog", "center"),
    ("com", "center"),
    ("cg", "center"),
    ("centroid", "center"),
    ("position", "center"),
    ("moment", "inertia"),
    ("moi", "inertia"),
    ("orientation", "angle"),
    ("rotation", "angle"),
];

/// The keyword that a word stands for: itself, or after a message a similar one.
fn meant(
    word: &Ident,
    keywords: &[&'static str],
    what: &str,
    expressions: &mut Expressions,
) -> syn::Result<&'static str> {
    let text = word.to_string();
    if let Some(keyword) = keywords.iter().find(|keyword| **keyword == text) {
        return Ok(keyword);
    }
    let lower = text.to_lowercase();
    let synonym = SYNONYMS.iter().find(|(other, keyword)| *other == lower && keywords.contains(keyword));
    let synonym = synonym.and_then(|(_, keyword)| keywords.iter().find(|other| *other == keyword));
    if let Some(keyword) = synonym.copied().or_else(|| nearest(&text, keywords.iter().copied())) {
        expressions.slip(word.span(), format!("unknown {what} `{text}`, did you mean `{keyword}`?"));
        return Ok(keyword);
    }
    let message = match KEYWORDS.contains(&text.as_str()) {
        true => format!("`{text}` is a statement of a mechanism: write it before this `scene` or `body`"),
        false => format!("unknown {what} `{text}`\nthere are: {}", keywords.join(", ")),
    };
    Err(syn::Error::new(word.span(), message))
}

pub(super) fn body(
    stream: ParseStream,
    expressions: &mut Expressions,
    diagnostics: &mut Diagnostics,
) -> syn::Result<Body> {
    let name = name_of(stream, "body")?;
    let before = diagnostics.len();
    let of = Items {
        name: &name,
        example: "mass m; inertia j; center G; angle phi;",
        keywords: &PROPERTIES,
        read: property,
        unread: |keyword, value| (keyword, value),
    };
    let properties = of.braces(stream, expressions, diagnostics)?;
    Ok(Body { name, properties, is_complete: diagnostics.len() == before })
}

/// Parses the name of a body or a scene.
fn name_of(stream: ParseStream, what: &str) -> syn::Result<Ident> {
    if stream.peek(syn::token::Brace) {
        return Err(stream.error(format!("expected a name: `{what} NAME {{ … }}`")));
    }
    name(stream)
}

/// Parses one property of a body.
fn property(stream: ParseStream, expressions: &mut Expressions) -> syn::Result<(Ident, ExpressionId)> {
    let word: Ident = stream.call(Ident::parse_any)?;
    let keyword = meant(&word, &PROPERTIES, "property", expressions)?;
    let found = stream.span();
    if let Some(sign) = ["=", ":"].into_iter().find(|sign| take(stream, sign).is_some()) {
        expressions.slip(found, format!("remove this `{sign}`: write `{keyword} …;`"));
    }
    Ok((Ident::new(keyword, word.span()), precedence::parse(stream, expressions)?))
}

pub(super) fn scene(
    stream: ParseStream,
    expressions: &mut Expressions,
    diagnostics: &mut Diagnostics,
) -> syn::Result<Scene> {
    let name = name_of(stream, "scene")?;
    let of = if tokens::word(stream, "of") { Some(self::name(stream)?) } else { None };
    let before = diagnostics.len();
    let effects = Items {
        name: &name,
        example: "inertia; gravity (0, -g);",
        keywords: &EFFECTS,
        read: effect,
        unread: |keyword, value| Effect { keyword, kind: EffectKind::Unread(value) },
    };
    let effects = effects.braces(stream, expressions, diagnostics)?;
    Ok(Scene { name, of, effects, is_complete: diagnostics.len() == before })
}

/// The items in the braces of a body or a scene.
struct Items<'a, V> {
    name: &'a Ident,
    example: &'a str,
    keywords: &'a [&'static str],
    read: fn(ParseStream, &mut Expressions) -> syn::Result<V>,
    /// An item with a syntax error: its keyword and its names.
    unread: fn(Ident, ExpressionId) -> V,
}

impl<V> Items<'_, V> {
    /// Parses the items in the next braces, each ended by `;`; of one with a syntax error the names are kept.
    fn braces(
        &self,
        stream: ParseStream,
        expressions: &mut Expressions,
        diagnostics: &mut Diagnostics,
    ) -> syn::Result<Vec<V>> {
        let example = self.example;
        let missing = |span| syn::Error::new(span, format!("expected braces: `{{ {example} }}`"));
        if !stream.peek(syn::token::Brace) {
            let found = if stream.is_empty() { self.name.span() } else { stream.span() };
            // One token too many.
            if !stream.peek2(syn::token::Brace) {
                return Err(missing(found));
            }
            diagnostics.push(missing(found));
            stream.parse::<TokenTree>()?;
        }
        let content;
        let braces = syn::braced!(content in stream);
        if content.is_empty() {
            let message = format!("empty braces: write for example `{{ {example} }}`");
            diagnostics.push(syn::Error::new(braces.span.join(), message));
        }
        let mut items = Vec::new();
        while !content.is_empty() {
            items.extend(self.item(&content, expressions, diagnostics));
        }
        Ok(items)
    }

    fn item(&self, stream: ParseStream, expressions: &mut Expressions, diagnostics: &mut Diagnostics) -> Option<V> {
        let attributes = attributes::read(stream, diagnostics);
        attributes::meant(attributes, Bearer::Part, diagnostics);
        let (length, ahead) = (expressions.len(), stream.fork());
        let read = (self.read)(&ahead, expressions).and_then(|read| {
            let last = expressions.last_region().filter(|_| expressions.len() > length);
            match end(&ahead, Some(last.unwrap_or_else(|| self.name.span().into()))) {
                Err(error) if !ahead.is_empty() && !at_word(&ahead, self.keywords) => Err(error),
                ended => {
                    // Only the `;` is missing.
                    diagnostics.extend(ended.err());
                    Ok(read)
                }
            }
        });
        diagnostics.extend(expressions.take_slips());
        match read {
            Ok(read) => {
                stream.advance_to(&ahead);
                Some(read)
            }
            Err(error) => {
                diagnostics.push(error);
                expressions.truncate(length);
                let tokens = self.tokens(stream);
                let Some(TokenTree::Ident(word)) = tokens.first() else { return None };
                let keyword = nearest(&word.to_string(), self.keywords.iter().copied())?;
                let value = recovery::unread_value(&tokens[1..], word.span(), expressions);
                Some((self.unread)(Ident::new(keyword, word.span()), value))
            }
        }
    }

    /// Takes the tokens up to the end of an item.
    fn tokens(&self, stream: ParseStream) -> Vec<TokenTree> {
        let mut tokens = Vec::new();
        while !stream.is_empty() && (tokens.is_empty() || !at_word(stream, self.keywords)) {
            match stream.parse::<TokenTree>() {
                Ok(TokenTree::Punct(punct)) if punct.as_char() == ';' => break,
                Ok(token) => tokens.push(token),
                Err(_) => break,
            }
        }
        tokens
    }
}

fn effect(stream: ParseStream, expressions: &mut Expressions) -> syn::Result<Effect> {
    let word: Ident = stream
        .call(Ident::parse_any)
        .map_err(|error| syn::Error::new(error.span(), format!("expected an effect: {}", EFFECTS.join(", "))))?;
    let text = meant(&word, &EFFECTS, "effect", expressions)?;
    let keyword = Ident::new(text, word.span());
    let found = stream.span();
    if take(stream, "=").is_some() {
        expressions.slip(found, format!("remove this `=`: write `{keyword} …;`"));
    }
    let expected = |stream: ParseStream, form: &str| {
        let found = if stream.is_empty() { keyword.span() } else { stream.span() };
        syn::Error::new(found, format!("expected `{form}`"))
    };
    let kind = match text {
        "inertia" => {
            let is_of_all = stream.is_empty() || stream.peek(Token![;]) || at_word(stream, &EFFECTS);
            EffectKind::Inertia(if is_of_all { Vec::new() } else { names(stream, expressions, text)? })
        }
        "gravity" => {
            let field = precedence::parse(stream, expressions)?;
            if stream.peek(Token![,]) {
                let region = expressions.region(field);
                return Err(syn::Error::new_spanned(region, "write the field as a vector: `gravity (x, y);`"));
            }
            let bodies = if tokens::word(stream, "on") { names(stream, expressions, "on")? } else { Vec::new() };
            EffectKind::Gravity { field, bodies }
        }
        "spring" => {
            let stiffness = precedence::parse(stream, expressions)?;
            let free = stream.parse::<Option<Token![,]>>()?;
            let free = free.map(|_| precedence::parse(stream, expressions)).transpose()?;
            let attachment = attachment(stream, expressions)?;
            const FORM: &str = "spring k, s0 between P and Q;` or `spring k, phi0 on phi;";
            let attachment = attachment.ok_or_else(|| expected(stream, FORM))?;
            if stream.peek(Token![,]) {
                return Err(expected(stream, FORM));
            }
            EffectKind::Spring { stiffness, free, attachment }
        }
        "damper" => {
            let constant = precedence::parse(stream, expressions)?;
            let attachment = attachment(stream, expressions)?;
            let attachment =
                attachment.ok_or_else(|| expected(stream, "damper c between P and Q;` or `damper c on phi;"))?;
            EffectKind::Damper { constant, attachment }
        }
        "torque" => {
            let law = precedence::parse(stream, expressions)?;
            if !tokens::word(stream, "on") {
                return Err(expected(stream, "torque LAW on phi;"));
            }
            EffectKind::Torque { law, on: precedence::parse(stream, expressions)? }
        }
        "force" => {
            let law = precedence::parse(stream, expressions)?;
            if !tokens::word(stream, "at") {
                return Err(expected(stream, "force (fx, fy) at P;"));
            }
            EffectKind::Force { law, at: precedence::parse(stream, expressions)? }
        }
        "potential" => EffectKind::Potential(precedence::parse(stream, expressions)?),
        "friction" => {
            if names_reaction(stream) {
                return Err(expected(stream, FRICTION));
            }
            let mut factors = vec![precedence::parse(stream, expressions)?];
            let mut reaction = None;
            while factors.len() < 3 && stream.parse::<Option<Token![,]>>()?.is_some() {
                if names_reaction(stream) {
                    stream.parse::<Ident>()?;
                    let pin = tokens::word(stream, "at").then(|| precedence::parse(stream, expressions));
                    reaction = Some(pin.transpose()?);
                    break;
                }
                factors.push(precedence::parse(stream, expressions)?);
            }
            if !tokens::word(stream, "on") {
                return Err(expected(stream, FRICTION));
            }
            EffectKind::Friction { factors, reaction, on: precedence::parse(stream, expressions)? }
        }
        "reaction" => {
            let joint = match tokens::word(stream, "at") {
                true => Joint::At(precedence::parse(stream, expressions)?),
                false if tokens::word(stream, "on") => Joint::On(precedence::parse(stream, expressions)?),
                false => {
                    let message =
                        "write `reaction at P;` for a pin, `reaction on s;` for a guide, or `reactions;` for all";
                    return Err(syn::Error::new(keyword.span(), message));
                }
            };
            EffectKind::Reaction(joint)
        }
        "stop" => {
            const FORM: &str = "stop phi in lower..upper, restitution e;";
            let on = precedence::parse(stream, expressions)?;
            let range = if tokens::word(stream, "in") {
                if stream.peek(syn::token::Bracket) || stream.peek(syn::token::Paren) && stream.peek2(Token![,]) {
                    return Err(expected(stream, FORM));
                }
                let lower = precedence::parse(stream, expressions)?;
                if let Some(region) = take(stream, "..=") {
                    return Err(syn::Error::new_spanned(region, format!("expected `{FORM}`")));
                }
                if stream.parse::<Option<Token![..]>>()?.is_none() {
                    return Err(expected(stream, FORM));
                }
                Some([lower, precedence::parse(stream, expressions)?])
            } else if stream.peek(Token![,]) {
                None
            } else {
                return Err(expected(stream, FORM));
            };
            if stream.parse::<Option<Token![,]>>()?.is_none() || !tokens::word(stream, "restitution") {
                return Err(expected(stream, FORM));
            }
            EffectKind::Stop { on, range, restitution: precedence::parse(stream, expressions)? }
        }
        "drive" => {
            let input = name(stream)?;
            equals(stream, expressions, "drive v = LAW;")?;
            EffectKind::Drive { input, law: precedence::parse(stream, expressions)? }
        }
        "energy" | "power" | "reactions" | "equilibrium" => EffectKind::Request,
        _ => return Err(syn::Error::new(keyword.span(), "unknown effect")),
    };
    Ok(Effect { keyword, kind })
}

/// True before `reaction on` and `reaction at`: the force in the joint, not a name.
fn names_reaction(stream: ParseStream) -> bool {
    let ahead = stream.fork();
    tokens::word(&ahead, "reaction") && (tokens::word(&ahead, "on") || tokens::word(&ahead, "at"))
}

/// Parses `on phi` or `between P and Q`.
fn attachment(stream: ParseStream, expressions: &mut Expressions) -> syn::Result<Option<Attachment>> {
    if tokens::word(stream, "on") {
        return Ok(Some(Attachment::On(precedence::parse(stream, expressions)?)));
    }
    if !tokens::word(stream, "between") {
        return Ok(None);
    }
    let from = precedence::parse(stream, expressions)?;
    if !tokens::word(stream, "and") {
        return Ok(None);
    }
    Ok(Some(Attachment::Between(from, precedence::parse(stream, expressions)?)))
}
