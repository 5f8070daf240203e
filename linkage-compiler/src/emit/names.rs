//! Names of the emitted code: the user's own, and fresh ones beside them.

use std::cell::{Cell, RefCell};
use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

use proc_macro2::{Ident, Literal, Span, TokenStream};
use rustc_hash::FxHashMap;

use crate::graph::{ExternalId, Graph, Number, SymbolId};
use crate::lower::{Schedule, Signed, Value, ValueId};
use crate::places::{Hash, Places};

/// The functions of the runtime that emitted code calls, in alphabetical order.
pub(super) const RUNTIME_FUNCTIONS: [&str; 27] = [
    "chord",
    "countable",
    "elbow_chord",
    "equilibrium",
    "existing",
    "finite",
    "finite_each",
    "finite_matrices",
    "finite_matrix",
    "finite_outputs",
    "finite_points",
    "limits",
    "newton",
    "newton_group",
    "not_negative",
    "output_motions",
    "point_motions",
    "product_of_pivots",
    "reach_chord",
    "real",
    "reduced",
    "regular",
    "side_of",
    "solvable",
    "sound",
    "stops",
    "unit",
];

/// The private function that calls a function of the user's.
pub(super) fn call_of(names: &[String]) -> Ident {
    ident(&format!("extern_{}", names.first().map_or("", String::as_str)))
}

/// A name longer than this says less than a number.
const LONGEST: usize = 36;

/// A name, as text and as a token.
#[derive(Debug)]
pub(super) struct Name {
    pub(super) text: String,
    pub(super) ident: Ident,
}

/// What the functions of one driver have in common: the names of their arguments and of the runtime's functions,
/// which no value may have, and every name made so far, each of which is checked once.
#[derive(Debug, Default)]
pub(super) struct Scope {
    words: RefCell<Words>,
    /// So many of the words are reserved.
    reserved: usize,
    /// Numbers as scalars, the few that there are.
    constants: RefCell<Vec<(Number, TokenStream)>>,
}

#[derive(Debug, Default)]
struct Words {
    names: Vec<Rc<Name>>,
    places: Places,
}

impl Scope {
    pub(super) fn new(arguments: impl IntoIterator<Item = String>) -> Self {
        let mut words = Words::default();
        for name in arguments.into_iter().chain(RUNTIME_FUNCTIONS.map(str::to_owned)) {
            words.find(&name);
        }
        Self { reserved: words.names.len(), words: RefCell::new(words), constants: RefCell::default() }
    }
}

impl Words {
    /// The number of a word.
    fn find(&mut self, text: &str) -> usize {
        let hash = Hash::of_text(text);
        let known = self.places.find(hash, |place| self.names[place].text == text);
        known.unwrap_or_else(|| {
            self.places.insert(hash, self.names.len());
            self.names.push(Rc::new(Name { text: text.to_owned(), ident: ident(text) }));
            self.names.len() - 1
        })
    }
}

/// The names that are in use.
#[derive(Debug, Clone, Default)]
pub(super) struct Taken {
    scope: Rc<Scope>,
    /// By the number of the word.
    words: Vec<bool>,
    /// The last number given to a stem, so that a thousandth name is found as fast as the second.
    numbers: FxHashMap<String, usize>,
}

impl Taken {
    /// The name wished for, or one like it that is not taken.
    pub(super) fn unique(&mut self, wish: &str) -> String {
        self.name(wish).text.clone()
    }

    fn name(&mut self, wish: &str) -> Rc<Name> {
        self.claim(wish).unwrap_or_else(|| self.numbered(wish, 2))
    }

    /// The name itself, if it is not taken.
    fn claim(&mut self, name: &str) -> Option<Rc<Name>> {
        let mut words = self.scope.words.borrow_mut();
        let word = words.find(name);
        if self.words.len() <= word {
            // More names follow.
            let mut larger = vec![false; 2 * words.names.len()];
            larger[..self.words.len()].copy_from_slice(&self.words);
            self.words = larger;
        }
        if word < self.scope.reserved || std::mem::replace(&mut self.words[word], true) {
            return None;
        }
        Some(Rc::clone(&words.names[word]))
    }

    /// The stem with the next number, from `first` on.
    fn numbered(&mut self, stem: &str, first: usize) -> Rc<Name> {
        let mut number = self.numbers.get(stem).copied().unwrap_or(first);
        loop {
            let name = self.claim(&format!("{stem}_{number}"));
            number += 1;
            if let Some(name) = name {
                self.numbers.insert(stem.to_owned(), number);
                return name;
            }
        }
    }
}

/// Gives every value of one kernel a name of its own.
pub(super) struct Names<'a> {
    graph: &'a Graph,
    taken: Taken,
    values: Vec<Option<Rc<Name>>>,
    symbols: Vec<Option<Rc<Name>>>,
    /// Whether a number had to be made a scalar.
    numbers_taken: Cell<bool>,
    /// The functions of the user's that are called.
    pub(super) externals: BTreeSet<ExternalId>,
    /// The factorisations, by block.
    pub(super) factors: FxHashMap<usize, String>,
    /// What says of a dyad whether its triangle is plain.
    pub(super) plain: BTreeMap<usize, Ident>,
}

impl<'a> Names<'a> {
    pub(super) fn new(graph: &'a Graph, scope: &Rc<Scope>) -> Self {
        let taken = Taken { scope: Rc::clone(scope), ..Taken::default() };
        Self {
            graph,
            taken,
            values: Vec::new(),
            symbols: Vec::new(),
            numbers_taken: Cell::new(false),
            externals: BTreeSet::new(),
            factors: FxHashMap::default(),
            plain: BTreeMap::new(),
        }
    }

    /// Names of a scope within this one.
    pub(super) fn within(&self) -> Self {
        Self {
            graph: self.graph,
            taken: self.taken.clone(),
            values: Vec::new(),
            symbols: self.symbols.clone(),
            numbers_taken: Cell::new(false),
            factors: FxHashMap::default(),
            externals: BTreeSet::new(),
            plain: BTreeMap::new(),
        }
    }

    /// A name not yet taken.
    pub(super) fn unique(&mut self, wish: &str) -> String {
        self.taken.unique(wish)
    }

    pub(super) fn into_taken(self) -> Taken {
        self.taken
    }

    /// A number as a scalar, by `write` if it is new.
    pub(super) fn constant(&self, number: Number, write: impl FnOnce(Number) -> TokenStream) -> TokenStream {
        let mut constants = self.taken.scope.constants.borrow_mut();
        if let Some((_, tokens)) = constants.iter().find(|(other, _)| *other == number) {
            return tokens.clone();
        }
        let tokens = write(number);
        constants.push((number, tokens.clone()));
        tokens
    }

    /// Says that a number had to be made a scalar.
    pub(super) fn take_number(&self) {
        self.numbers_taken.set(true);
    }

    pub(super) fn takes_numbers(&self) -> bool {
        self.numbers_taken.get()
    }

    /// The local name of a symbol.
    pub(super) fn symbol(&self, symbol: SymbolId) -> Ident {
        match self.symbols.get(symbol.index()) {
            Some(Some(name)) => name.ident.clone(),
            _ => ident(self.graph.symbol_name(symbol)),
        }
    }

    /// Gives a symbol its own name, or one like it if that is taken.
    pub(super) fn introduce(&mut self, symbol: SymbolId) -> Rc<Name> {
        let name = self.taken.name(self.graph.symbol_name(symbol));
        put(&mut self.symbols, symbol.index(), Rc::clone(&name));
        name
    }

    pub(super) fn set(&mut self, value: ValueId, name: Rc<Name>) {
        put(&mut self.values, value.index(), name);
    }

    /// The name of a value that has one.
    pub(super) fn get(&self, schedule: &Schedule, value: ValueId) -> Option<&Name> {
        match schedule.value(value) {
            Value::Symbol(symbol) => self.symbols.get(symbol.index())?.as_deref(),
            _ => self.values.get(value.index())?.as_deref(),
        }
    }

    /// A name like this one for a value.
    pub(super) fn give(&mut self, value: ValueId, wish: &str) -> Ident {
        let name = self.taken.name(wish);
        let ident = name.ident.clone();
        self.set(value, name);
        ident
    }

    /// Names a value after what it is made of.
    pub(super) fn invent(&mut self, schedule: &Schedule, value: ValueId) -> Ident {
        let mut wish = String::with_capacity(LONGEST);
        match schedule.name(value) {
            Some(name) => wish.push_str(name),
            None if self.describe(&mut wish, schedule, value).is_some() => {}
            None => wish.clear(),
        }
        if wish.is_empty() || wish.len() > LONGEST {
            wish.clear();
            wish.push_str(match schedule.value(value) {
                Value::Sum(_) => "sum",
                Value::Product(_) => "product",
                Value::Quotient(..) => "quotient",
                Value::Square(_) => "square",
                Value::Call(function, _) => function.operation().name,
                _ => "value",
            });
            wish.push_str("_1");
        }
        let name = match wish.strip_suffix("_1") {
            Some(stem) => self.taken.numbered(stem, 1),
            None => self.taken.name(&wish),
        };
        let ident = name.ident.clone();
        self.set(value, name);
        ident
    }

    /// Writes a name made of the names of the parts, if all have one.
    fn describe(&self, out: &mut String, schedule: &Schedule, value: ValueId) -> Option<()> {
        match schedule.value(value) {
            Value::Product(factors) => {
                for (place, &factor) in factors.iter().enumerate() {
                    if place > 0 {
                        out.push('_');
                    }
                    self.part(out, schedule, factor)?;
                }
                Some(())
            }
            Value::Sum(terms) => {
                let &[Signed { value: a, .. }, Signed { negative, value: b }] = terms.as_slice() else { return None };
                self.part(out, schedule, a)?;
                out.push_str(if negative { "_minus_" } else { "_plus_" });
                self.part(out, schedule, b)
            }
            Value::Quotient(above, below) if is_one(schedule, *above) => {
                out.push_str("inverse_");
                self.text(out, schedule, *below)
            }
            Value::Quotient(above, below) => {
                self.part(out, schedule, *above)?;
                out.push_str("_by_");
                self.part(out, schedule, *below)
            }
            Value::Square(base) => {
                self.text(out, schedule, *base)?;
                out.push_str("_squared");
                Some(())
            }
            Value::Call(function, arguments) => {
                let &[argument] = arguments.as_slice() else { return None };
                out.push_str(function.operation().name);
                out.push('_');
                self.text(out, schedule, argument.value).or_else(|| self.describe(out, schedule, argument.value))
            }
            Value::External(external, _) => {
                out.push_str(self.graph.external_name(external)?);
                Some(())
            }
            _ => None,
        }
    }

    /// Writes a part by its name, or by a word for the small things that are written inline.
    fn part(&self, out: &mut String, schedule: &Schedule, value: ValueId) -> Option<()> {
        let small = |value: &ValueId| {
            matches!(schedule.value(*value), Value::Symbol(_)) || self.get(schedule, *value).is_some()
        };
        match schedule.value(value) {
            Value::Constant(Number::Ratio(1, 2)) => out.push_str("half"),
            Value::Constant(Number::Ratio(2, 1)) => out.push_str("twice"),
            Value::Square(base) if small(base) => self.describe(out, schedule, value)?,
            Value::Quotient(above, below) if is_one(schedule, *above) && small(below) => {
                self.describe(out, schedule, value)?;
            }
            Value::Product(factors) if factors.iter().all(small) => {
                self.text(out, schedule, value).or_else(|| self.describe(out, schedule, value))?;
            }
            _ => self.text(out, schedule, value)?,
        }
        Some(())
    }

    fn text(&self, out: &mut String, schedule: &Schedule, value: ValueId) -> Option<()> {
        out.push_str(&self.get(schedule, value)?.text);
        Some(())
    }
}

fn put(names: &mut Vec<Option<Rc<Name>>>, index: usize, name: Rc<Name>) {
    if names.len() <= index {
        // More follow, mostly in this order.
        names.resize_with(2 * index + 1, || None);
    }
    names[index] = Some(name);
}

fn is_one(schedule: &Schedule, value: ValueId) -> bool {
    matches!(schedule.value(value), Value::Constant(number) if number.is_one())
}

/// What to call the direction of an angle: after the coordinate, or after a short sum such as
/// `phi2 - delta`.
pub(super) fn angle_name(text: &str) -> String {
    let mut name = String::new();
    let mut separate = false;
    for letter in text.chars() {
        let word = match letter {
            '-' => "minus",
            '+' => "plus",
            '*' => "times",
            '/' => "over",
            letter if letter.is_alphanumeric() || letter == '_' => {
                if separate && !name.is_empty() {
                    name.push('_');
                }
                separate = false;
                name.push(letter);
                continue;
            }
            _ => {
                separate = true;
                continue;
            }
        };
        if !name.is_empty() {
            name.push('_');
        }
        name.push_str(word);
        separate = true;
    }
    let starts_well = name.chars().next().is_some_and(|first| first.is_alphabetic() || first == '_');
    if starts_well && name.len() <= LONGEST { name } else { "angle".to_owned() }
}

pub(super) fn ident(name: &str) -> Ident {
    Ident::new(name, Span::call_site())
}

/// A text as a string literal, as people write it: raw where it holds what would need an escape.
pub(super) fn quoted(text: &str) -> String {
    match (text.contains('"'), text.contains('\\')) {
        (false, false) => format!("\"{text}\""),
        (false, true) => format!("r\"{text}\""),
        (true, _) if text.contains("\"#") => format!("{text:?}"),
        (true, _) => format!("r#\"{text}\"#"),
    }
}

/// The text of a doc comment as a literal: raw, as the compiler itself writes what stands behind `///`.
pub(super) fn comment(text: &str) -> Literal {
    let plain = !text.contains('"');
    let raw = plain.then(|| format!("r\"{text}\"").parse().ok()).flatten();
    raw.unwrap_or_else(|| string(text))
}

/// A string literal. It is read rather than built, which spares unoptimised macros the escaping of
/// every character.
pub(super) fn string(text: &str) -> Literal {
    quoted(text).parse().unwrap_or_else(|_| Literal::string(text))
}
