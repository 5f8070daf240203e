//! Mechanisms with changes: statements moved and doubled, names exchanged, parts of expressions replaced by others from
//! a grammar. The grammar follows the language, so that many mutants are still mechanisms.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use proc_macro2::{Delimiter, Group, Span, TokenStream, TokenTree};
use rand::Rng;

/// Numbers at the ends of the range of `f64`, and ordinary ones.
const NUMBERS: [&str; 22] = [
    "0",
    "1",
    "2",
    "3",
    "0.5",
    "1.25",
    "30deg",
    "90deg",
    "180deg",
    "pi",
    "1e-300",
    "1e300",
    "1e154",
    "1e-160",
    "5e-324",
    "1.7e308",
    "1e400",
    "1e-400",
    "9007199254740993",
    "9223372036854775807",
    "123456789012345678901234567890",
    "1e15",
];

const EXPONENTS: [&str; 9] = ["0", "1", "2", "3", "-1", "-2", "17", "64", "2147483647"];

/// The functions of one scalar argument, of two, of one vector, and of two vectors.
const SCALAR: [&str; 10] = ["sin", "cos", "tan", "asin", "acos", "atan", "sqrt", "abs", "exp", "ln"];
const PAIRED: [&str; 2] = ["atan2", "hypot"];
const VECTOR: [&str; 4] = ["x", "y", "norm", "angle"];
const VECTORS: [&str; 2] = ["dot", "cross"];

const REQUESTS: [&str; 4] = ["limits", "jerk", "velocity_ratio_derivatives", "sensitivity"];

/// Mechanisms, statement by statement.
pub struct Mutator<R> {
    random: R,
    corpus: Vec<Vec<TokenTree>>,
}

/// The invocations of the files of the gallery, in the order of their names.
pub fn corpus(root: &Path) -> Vec<TokenStream> {
    let entries = fs::read_dir(root.join("dev/gallery/src/mechanisms")).expect("a folder");
    let mut paths: Vec<_> = entries.map(|entry| entry.expect("a file").path()).collect();
    paths.sort();
    let texts = paths.iter().map(|path| fs::read_to_string(path).expect("text"));
    let items = texts.flat_map(|text| syn::parse_file(&text).expect("Rust").items);
    let invocations = items.filter_map(|item| match item {
        syn::Item::Macro(item) if item.mac.path.is_ident("linkage") => Some(item.mac.tokens),
        _ => None,
    });
    invocations.collect()
}

/// The names that a mechanism declares.
#[derive(Default)]
struct Names {
    parameters: Vec<String>,
    coordinates: Vec<String>,
    vectors: Vec<String>,
    scalars: Vec<String>,
    bodies: Vec<String>,
}

impl<R: Rng> Mutator<R> {
    pub fn new(random: R, corpus: impl IntoIterator<Item = TokenStream>) -> Self {
        Self { random, corpus: corpus.into_iter().map(|tokens| tokens.into_iter().collect()).collect() }
    }

    /// A mechanism of the corpus with one to four changes, most often one.
    pub fn mutant(&mut self) -> TokenStream {
        let place = self.random.random_range(0..self.corpus.len());
        let mut tokens = self.corpus[place].clone();
        let count = 1 + self.random.random_range(0..10_u32).saturating_sub(6);
        for _ in 0..count {
            tokens = self.changed(tokens);
        }
        tokens.into_iter().collect()
    }

    /// One mechanism of the invocation changed.
    fn changed(&mut self, mut tokens: Vec<TokenTree>) -> Vec<TokenTree> {
        let bodies: Vec<usize> = (0..tokens.len()).filter(|&at| is_braces(&tokens[at])).collect();
        let Some(&at) = self.one_of(&bodies) else { return tokens };
        let TokenTree::Group(body) = &tokens[at] else { return tokens };
        let mut statements = statements(body.stream());
        let names = Names::of(&statements);
        match self.random.random_range(0..20) {
            0 => drop(statements.remove(self.index(&statements))),
            1 => {
                let (from, to) = (self.index(&statements), self.index(&statements));
                statements.swap(from, to);
            }
            2 => {
                let (from, to) = (self.index(&statements), self.index(&statements));
                let again = statements[from].clone();
                statements.insert(to, again);
            }
            3 => {
                // A statement of another mechanism.
                let other = self.random.random_range(0..self.corpus.len());
                let braces = self.corpus[other].iter().rev().find(|token| is_braces(token)).cloned();
                if let Some(TokenTree::Group(body)) = braces {
                    let others = self::statements(body.stream());
                    let statement = others[self.index(&others)].clone();
                    statements.push(statement);
                }
            }
            4 => {
                let at = self.index(&statements);
                let statement = std::mem::take(&mut statements[at]);
                statements[at] = self.scrambled(statement);
            }
            5 => self.attribute(&mut statements),
            6..=8 => self.effect(&mut statements, &names),
            9..=11 => self.declaration(&mut statements, &names),
            _ => {
                let at = self.index(&statements);
                let statement = std::mem::take(&mut statements[at]);
                statements[at] = self.rewritten(statement, &names);
            }
        }
        let span = tokens[at].span();
        tokens[at] = braces(statements.concat(), span);
        tokens
    }

    fn index<V>(&mut self, list: &[V]) -> usize {
        self.random.random_range(0..list.len().max(1))
    }

    fn one_of<'a, V>(&mut self, list: &'a [V]) -> Option<&'a V> {
        let at = self.index(list);
        list.get(at)
    }

    /// A token missing, doubled or exchanged, most often a mistake.
    fn scrambled(&mut self, mut tokens: Vec<TokenTree>) -> Vec<TokenTree> {
        let (at, other) = (self.index(&tokens), self.index(&tokens));
        if let (TokenTree::Group(group), true) = (&tokens[at], self.random.random_bool(0.5)) {
            let inside = group.stream().into_iter().collect::<Vec<_>>();
            if !inside.is_empty() {
                let inside = self.scrambled(inside);
                tokens[at] = TokenTree::Group(Group::new(group.delimiter(), inside.into_iter().collect()));
                return tokens;
            }
        }
        match self.random.random_range(0..3) {
            0 => drop(tokens.remove(at)),
            1 => tokens.insert(at, tokens[other].clone()),
            _ => tokens.swap(at, other),
        }
        tokens
    }

    fn attribute(&mut self, statements: &mut Vec<Vec<TokenTree>>) {
        // Input of the macro; none applies to this file.
        const ATTRIBUTES: [&str; 7] = [
            "#[doc = \"said of it\"]",
            "#[doc = \"said\" twice]",
            "#[cfg(all())]",
            "#[deprecated]",
            "#[allow(dead_code)]",
            "#[derive(Clone) nonsense]",
            "#[doc(hidden)]",
        ];
        let text = ATTRIBUTES[self.index(&ATTRIBUTES)];
        let at = self.index(statements);
        statements.insert(at, parse(text));
    }

    /// One more effect in a scene, or a scene with a body.
    fn effect(&mut self, statements: &mut Vec<Vec<TokenTree>>, names: &Names) {
        let scenes: Vec<usize> = (0..statements.len())
            .filter(|&at| matches!(statements[at].first(), Some(TokenTree::Ident(word)) if *word == "scene"))
            .collect();
        let Some(&at) = self.one_of(&scenes) else {
            let (turned, point) = (self.scalar(names, 1), self.vector(names, 1));
            let wish = ["energy;", "power;", "reactions;", "equilibrium;", ""][self.random.random_range(0..5)];
            let inertia = if self.random.random_bool(0.7) { "inertia;" } else { "gravity (0, -9.81);" };
            let body = format!("body added {{ mass 2; center {point}; inertia 1; angle {turned}; }}");
            statements.push(parse(&body));
            statements.push(parse(&format!("scene Added {{ {inertia} {wish} }}")));
            return;
        };
        let (scalar, other) = (self.scalar(names, 2), self.scalar(names, 1));
        let (place, point) = (self.vector(names, 1), self.vector(names, 1));
        let coordinate = self.one_of(&names.coordinates).cloned().unwrap_or_default();
        let effect = match self.random.random_range(0..13) {
            0 => format!("torque {scalar} on {coordinate};"),
            1 => format!("torque sin(3 * t) * {scalar} on {other};"),
            2 => format!("force ({scalar}, {other}) at {point};"),
            3 => format!("spring {scalar}, {other} on {coordinate};"),
            4 => format!("spring 10, 1 between {place} and {point};"),
            5 => format!("damper 0.1 + rate({coordinate})^2 on {scalar};"),
            6 => format!("damper 0.3 between {place} and {point};"),
            7 => format!("potential {scalar};"),
            8 => format!("friction 0.1, {other} on {coordinate};"),
            9 => format!("stop {scalar} in -1..2, restitution 0.5;"),
            10 => format!("drive {coordinate} = sin(2 * t);"),
            11 => format!("gravity ({other}, -9.81);"),
            _ => ["energy;", "power;", "reactions;", "equilibrium;"][self.random.random_range(0..4)].to_owned(),
        };
        let statement = &mut statements[at];
        if let Some(TokenTree::Group(group)) = statement.last() {
            let inside: Vec<TokenTree> = group.stream().into_iter().chain(parse(&effect)).collect();
            let span = group.span();
            statement.pop();
            statement.push(braces(inside, span));
        }
    }

    /// One more statement that uses what is declared.
    fn declaration(&mut self, statements: &mut Vec<Vec<TokenTree>>, names: &Names) {
        let number = statements.len();
        let depth = self.random.random_range(0..4);
        let statement = match self.random.random_range(0..8) {
            0 | 1 => format!("output added_{number} = {};", self.scalar(names, depth)),
            2 | 3 => format!("point Added{number} = {};", self.vector(names, depth)),
            4 => format!("derive {};", REQUESTS[self.index(&REQUESTS)]),
            5 => {
                let (unknown, value) = (format!("more_{number}"), self.scalar(names, depth));
                statements.push(parse(&format!("unknown {unknown};")));
                format!("equation {unknown} = {value};")
            }
            6 => {
                let (a, b) = (format!("one_{number}"), format!("other_{number}"));
                statements.push(parse(&format!("unknown {a}, {b};")));
                format!("loop 3@{a} + 2.5@{b} = {};", self.vector(names, depth))
            }
            _ => {
                // A chain of names, each of which uses the one before twice.
                let mut text = format!("let deep_0 = {};", self.scalar(names, 1));
                let length = self.random.random_range(1..24);
                for link in 1..=length {
                    let before = link - 1;
                    text += &format!("let deep_{link} = deep_{before} * {} + deep_{before};", self.scalar(names, 1));
                }
                format!("{text} output added_{number} = sin(deep_{length});")
            }
        };
        statements.push(parse(&statement));
    }

    /// A number or a name of a statement replaced by an expression, or by another name of its kind.
    fn rewritten(&mut self, tokens: Vec<TokenTree>, names: &Names) -> Vec<TokenTree> {
        let mut places = Vec::new();
        atoms(&tokens, names, &mut Vec::new(), &mut places);
        let Some(path) = self.one_of(&places).cloned() else { return tokens };
        let depth = self.random.random_range(0..4);
        let is_vector =
            matches!(at(&tokens, &path), Some(TokenTree::Ident(word)) if names.vectors.contains(&word.to_string()));
        let text = if is_vector {
            self.vector(names, depth)
        } else {
            let same = at(&tokens, &path).map_or_else(String::new, |token| token.to_string());
            match self.random.random_range(0..6) {
                0 => format!("(-{same})"),
                1 => format!("({same} + {})", self.scalar(names, depth)),
                2 => format!("({same} * {})", self.scalar(names, depth)),
                3 => {
                    let levels = self.random.random_range(1..70);
                    format!("{}{same}{}", "(".repeat(levels), ")".repeat(levels))
                }
                _ => self.scalar(names, depth),
            }
        };
        replaced(tokens, &path, &parse(&text))
    }

    fn scalar(&mut self, names: &Names, depth: usize) -> String {
        let lists = [&names.parameters, &names.coordinates, &names.coordinates, &names.scalars];
        let list = lists[self.random.random_range(0..lists.len())];
        let name = self.one_of(list).cloned().unwrap_or_else(|| "1".to_owned());
        if depth == 0 {
            return match self.random.random_range(0..6) {
                0 => NUMBERS[self.index(&NUMBERS)].to_owned(),
                1 => NUMBERS[self.random.random_range(0..6)].to_owned(),
                _ => name,
            };
        }
        let depth = depth - 1;
        match self.random.random_range(0..13) {
            0 => format!("(-{})", self.scalar(names, depth)),
            1 | 2 => format!("({} + {})", self.scalar(names, depth), self.scalar(names, depth)),
            3 => format!("({} - {})", self.scalar(names, depth), self.scalar(names, depth)),
            4 | 5 => format!("({} * {})", self.scalar(names, depth), self.scalar(names, depth)),
            6 => format!("({} / {})", self.scalar(names, depth), self.scalar(names, depth)),
            7 => format!("({})^{}", self.scalar(names, depth), EXPONENTS[self.index(&EXPONENTS)]),
            8 | 9 => format!("{}({})", SCALAR[self.index(&SCALAR)], self.scalar(names, depth)),
            10 => {
                format!("{}({}, {})", PAIRED[self.index(&PAIRED)], self.scalar(names, depth), self.scalar(names, depth))
            }
            11 => format!("{}({})", VECTOR[self.index(&VECTOR)], self.vector(names, depth)),
            _ => {
                let function = VECTORS[self.index(&VECTORS)];
                format!("{function}({}, {})", self.vector(names, depth), self.vector(names, depth))
            }
        }
    }

    fn vector(&mut self, names: &Names, depth: usize) -> String {
        if depth == 0 {
            let name = self.one_of(&names.vectors).cloned();
            return name.unwrap_or_else(|| format!("({}, {})", self.scalar(names, 0), self.scalar(names, 0)));
        }
        let depth = depth - 1;
        match self.random.random_range(0..6) {
            0 => format!("({}, {})", self.scalar(names, depth), self.scalar(names, depth)),
            1 | 2 => format!("(({})@({}))", self.scalar(names, depth), self.scalar(names, depth)),
            3 => format!("({} + {})", self.vector(names, depth), self.vector(names, depth)),
            4 => format!("({} * {})", self.scalar(names, depth), self.vector(names, depth)),
            _ => self.vector(names, 0),
        }
    }
}

impl Names {
    fn of(statements: &[Vec<TokenTree>]) -> Self {
        let mut names = Self::default();
        let mut functions = BTreeSet::new();
        for statement in statements {
            let words = statement.iter().filter_map(|token| match token {
                TokenTree::Ident(word) => Some(word.to_string()),
                _ => None,
            });
            let words: Vec<String> = words.collect();
            // Attributes stand before the keyword in groups.
            let [keyword, first, ..] = words.as_slice() else { continue };
            let listed = || {
                let mut names = Vec::new();
                let mut follows = false;
                for token in statement {
                    match token {
                        TokenTree::Ident(word) if follows => {
                            names.push(word.to_string());
                            follows = false;
                        }
                        TokenTree::Ident(word) => follows = word == keyword,
                        TokenTree::Punct(punct) => follows = punct.as_char() == ',',
                        _ => follows = false,
                    }
                }
                names
            };
            match keyword.as_str() {
                "param" => names.parameters.extend(listed()),
                "input" | "unknown" | "coordinate" => names.coordinates.extend(listed()),
                "point" => names.vectors.push(first.clone()),
                "output" => names.scalars.push(first.clone()),
                "body" => names.bodies.push(first.clone()),
                "extern" => functions.extend(words),
                _ => {}
            }
        }
        names
    }

    fn holds(&self, word: &str) -> bool {
        [&self.parameters, &self.coordinates, &self.vectors, &self.scalars]
            .iter()
            .any(|names| names.iter().any(|name| name == word))
    }
}

/// The statements between the braces of a mechanism, each with its end.
fn statements(body: TokenStream) -> Vec<Vec<TokenTree>> {
    let (mut statements, mut statement) = (Vec::new(), Vec::new());
    for token in body {
        let ends = is_braces(&token) || matches!(&token, TokenTree::Punct(punct) if punct.as_char() == ';');
        statement.push(token);
        if ends {
            statements.push(std::mem::take(&mut statement));
        }
    }
    if !statement.is_empty() {
        statements.push(statement);
    }
    if statements.is_empty() {
        statements.push(parse("input alone;"));
    }
    statements
}

/// The places of numbers and declared names in a statement, as places of groups in groups; without its declarations.
fn atoms(tokens: &[TokenTree], names: &Names, path: &mut Vec<usize>, found: &mut Vec<Vec<usize>>) {
    let mut declares = path.is_empty();
    for (place, token) in tokens.iter().enumerate() {
        path.push(place);
        match token {
            TokenTree::Group(group) => {
                let inside: Vec<TokenTree> = group.stream().into_iter().collect();
                atoms(&inside, names, path, found);
            }
            TokenTree::Literal(_) => found.push(path.clone()),
            TokenTree::Ident(word) if !declares && names.holds(&word.to_string()) => found.push(path.clone()),
            TokenTree::Ident(word) if declares && (word == "loop" || word == "equation") => declares = false,
            TokenTree::Punct(punct) => match punct.as_char() {
                '=' => declares = false,
                ',' if path.len() == 1 => declares = true,
                _ => {}
            },
            TokenTree::Ident(_) => {}
        }
        path.pop();
    }
}

fn at(tokens: &[TokenTree], path: &[usize]) -> Option<TokenTree> {
    let (first, rest) = path.split_first()?;
    match tokens.get(*first)? {
        token if rest.is_empty() => Some(token.clone()),
        TokenTree::Group(group) => at(&group.stream().into_iter().collect::<Vec<_>>(), rest),
        _ => None,
    }
}

fn replaced(mut tokens: Vec<TokenTree>, path: &[usize], by: &[TokenTree]) -> Vec<TokenTree> {
    let Some((&first, rest)) = path.split_first() else { return tokens };
    if rest.is_empty() {
        tokens.splice(first..=first, by.iter().cloned());
    } else if let TokenTree::Group(group) = &tokens[first] {
        let inside = replaced(group.stream().into_iter().collect(), rest, by);
        tokens[first] = TokenTree::Group(Group::new(group.delimiter(), inside.into_iter().collect()));
    }
    tokens
}

fn is_braces(token: &TokenTree) -> bool {
    matches!(token, TokenTree::Group(group) if group.delimiter() == Delimiter::Brace)
}

fn braces(tokens: Vec<TokenTree>, span: Span) -> TokenTree {
    let mut group = Group::new(Delimiter::Brace, tokens.into_iter().collect());
    group.set_span(span);
    TokenTree::Group(group)
}

fn parse(text: &str) -> Vec<TokenTree> {
    text.parse::<TokenStream>().expect(text).into_iter().collect()
}
