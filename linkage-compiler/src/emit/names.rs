//! Names of the emitted code: the user's own, and fresh ones beside them.

use std::cell::{Cell, RefCell};
use std::collections::BTreeSet;
use std::rc::Rc;

use proc_macro2::{Ident, Literal, Span};
use rustc_hash::{FxHashMap, FxHashSet};

use crate::graph::{ExternalId, Graph, Number, SymbolId};
use crate::simplify::schedule::{Schedule, Signed, Value, ValueId};

/// The functions of the runtime that emitted code calls, in alphabetical order.
pub(super) const RUNTIME_FUNCTIONS: [&str; 22] = [
    "chord",
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
    "real",
    "reduced",
    "regular",
    "side_of",
    "unit",
];

/// The private function that calls a function of the user's.
pub(super) fn call_of(names: &[String]) -> Ident {
    ident(&format!("extern_{}", names.first().map_or("", String::as_str)))
}

/// A name longer than this says less than a number.
const LONGEST: usize = 36;

/// A name, as text and as a token.
#[derive(Debug, Clone)]
pub(super) struct Name {
    pub(super) text: String,
    pub(super) ident: Ident,
}

/// What the functions of one driver have in common: the names of their arguments and of the runtime's functions,
/// which no value may have, and the identifiers made so far.
#[derive(Debug, Default)]
pub(super) struct Scope {
    reserved: FxHashSet<String>,
    idents: RefCell<FxHashMap<String, Ident>>,
}

impl Scope {
    pub(super) fn new(arguments: impl IntoIterator<Item = String>) -> Self {
        let reserved = arguments.into_iter().chain(RUNTIME_FUNCTIONS.map(str::to_owned)).collect();
        Self { reserved, idents: RefCell::default() }
    }

    pub(super) fn reserve(&mut self, argument: String) {
        self.reserved.insert(argument);
    }

    /// An identifier, which is checked once.
    fn ident(&self, text: &str) -> Ident {
        let mut idents = self.idents.borrow_mut();
        if let Some(ident) = idents.get(text) {
            return ident.clone();
        }
        let new = ident(text);
        idents.insert(text.to_owned(), new.clone());
        new
    }
}

/// The names that are in use.
#[derive(Debug, Clone, Default)]
pub(super) struct Taken {
    scope: Rc<Scope>,
    names: FxHashSet<String>,
    /// The last number given to a stem, so that a thousandth name is found as fast as the second.
    numbers: FxHashMap<String, usize>,
}

impl Taken {
    /// The name wished for, or one like it that is not taken.
    pub(super) fn unique(&mut self, wish: &str) -> String {
        if self.is_new(wish) { wish.to_owned() } else { self.numbered(wish, 2) }
    }

    fn is_new(&mut self, name: &str) -> bool {
        !self.scope.reserved.contains(name) && self.names.insert(name.to_owned())
    }

    /// The stem with the next number, from `first` on.
    fn numbered(&mut self, stem: &str, first: usize) -> String {
        let mut number = self.numbers.get(stem).copied().unwrap_or(first);
        loop {
            let name = format!("{stem}_{number}");
            number += 1;
            if self.is_new(&name) {
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
    values: Vec<Option<Name>>,
    symbols: FxHashMap<SymbolId, Name>,
    /// Whether a number had to be made a scalar.
    numbers_taken: Cell<bool>,
    /// The functions of the user's that are called.
    pub(super) externals: BTreeSet<ExternalId>,
    /// The factorisations, by block.
    pub(super) factors: FxHashMap<usize, String>,
}

impl<'a> Names<'a> {
    pub(super) fn new(graph: &'a Graph, scope: &Rc<Scope>) -> Self {
        let taken = Taken { scope: Rc::clone(scope), ..Taken::default() };
        Self {
            graph,
            taken,
            values: Vec::new(),
            symbols: FxHashMap::default(),
            numbers_taken: Cell::new(false),
            externals: BTreeSet::new(),
            factors: FxHashMap::default(),
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
        }
    }

    /// A name not yet taken.
    pub(super) fn unique(&mut self, wish: &str) -> String {
        self.taken.unique(wish)
    }

    /// The name wished for, or one like it.
    fn name(&mut self, wish: &str) -> Name {
        let text = self.taken.unique(wish);
        Name { ident: self.taken.scope.ident(&text), text }
    }

    pub(super) fn into_taken(self) -> Taken {
        self.taken
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
        self.symbols.get(&symbol).map_or_else(|| ident(self.graph.symbol_name(symbol)), |name| name.ident.clone())
    }

    /// Gives a symbol its own name, or one like it if that is taken.
    pub(super) fn introduce(&mut self, symbol: SymbolId) -> Name {
        let name = self.name(self.graph.symbol_name(symbol));
        self.symbols.insert(symbol, name.clone());
        name
    }

    pub(super) fn set(&mut self, value: ValueId, name: Name) {
        let index = value.index();
        if self.values.len() <= index {
            self.values.resize(index + 1, None);
        }
        self.values[index] = Some(name);
    }

    /// The name of a value that has one.
    pub(super) fn get(&self, schedule: &Schedule, value: ValueId) -> Option<&Name> {
        match schedule.value(value) {
            Value::Symbol(symbol) => self.symbols.get(symbol),
            _ => self.values.get(value.index())?.as_ref(),
        }
    }

    /// A name like this one for a value.
    pub(super) fn give(&mut self, value: ValueId, wish: &str) -> Ident {
        let name = self.name(wish);
        let ident = name.ident.clone();
        self.set(value, name);
        ident
    }

    /// Names a value after what it is made of.
    pub(super) fn invent(&mut self, schedule: &Schedule, value: ValueId) -> Ident {
        let wish = schedule
            .name(value)
            .map(str::to_owned)
            .or_else(|| self.describe(schedule, value))
            .filter(|name| name.len() <= LONGEST)
            .unwrap_or_else(|| match schedule.value(value) {
                Value::Sum(_) => "sum_1".to_owned(),
                Value::Product(_) => "product_1".to_owned(),
                Value::Quotient(..) => "quotient_1".to_owned(),
                Value::Square(_) => "square_1".to_owned(),
                Value::Call(function, _) => format!("{}_1", function.operation().name),
                _ => "value_1".to_owned(),
            });
        let text = match wish.strip_suffix("_1") {
            Some(stem) => self.taken.numbered(stem, 1),
            None => self.unique(&wish),
        };
        let name = Name { ident: self.taken.scope.ident(&text), text };
        let ident = name.ident.clone();
        self.set(value, name);
        ident
    }

    /// A name made of the names of the parts.
    fn describe(&self, schedule: &Schedule, value: ValueId) -> Option<String> {
        match schedule.value(value) {
            Value::Product(factors) => {
                let names: Option<Vec<String>> = factors.iter().map(|&factor| self.part(schedule, factor)).collect();
                Some(names?.join("_"))
            }
            Value::Sum(terms) => match terms.as_slice() {
                &[Signed { value: a, .. }, Signed { negative, value: b }] => {
                    let joint = if negative { "minus" } else { "plus" };
                    Some(format!("{}_{joint}_{}", self.part(schedule, a)?, self.part(schedule, b)?))
                }
                _ => None,
            },
            Value::Quotient(above, below) if is_one(schedule, *above) => {
                Some(format!("inverse_{}", self.text(schedule, *below)?))
            }
            Value::Quotient(above, below) => {
                Some(format!("{}_by_{}", self.part(schedule, *above)?, self.part(schedule, *below)?))
            }
            Value::Square(base) => Some(format!("{}_squared", self.text(schedule, *base)?)),
            Value::Call(function, arguments) => match arguments.as_slice() {
                &[argument] => {
                    let inner = self.text(schedule, argument.value).or_else(|| self.describe(schedule, argument.value));
                    Some(format!("{}_{}", function.operation().name, inner?))
                }
                _ => None,
            },
            Value::External(external, _) => self.graph.external_name(external).map(str::to_owned),
            _ => None,
        }
    }

    /// A part by its name, or by a word for the small things that are written inline.
    fn part(&self, schedule: &Schedule, value: ValueId) -> Option<String> {
        let small = |value: &ValueId| {
            matches!(schedule.value(*value), Value::Symbol(_)) || self.get(schedule, *value).is_some()
        };
        match schedule.value(value) {
            Value::Constant(Number::Ratio(1, 2)) => Some("half".to_owned()),
            Value::Constant(Number::Ratio(2, 1)) => Some("twice".to_owned()),
            Value::Square(base) if small(base) => self.describe(schedule, value),
            Value::Quotient(above, below) if is_one(schedule, *above) && small(below) => self.describe(schedule, value),
            Value::Product(factors) if factors.iter().all(small) => {
                self.text(schedule, value).or_else(|| self.describe(schedule, value))
            }
            _ => self.text(schedule, value),
        }
    }

    fn text(&self, schedule: &Schedule, value: ValueId) -> Option<String> {
        self.get(schedule, value).map(|name| name.text.clone())
    }
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

/// A string literal. It is read rather than built, which spares unoptimised macros the escaping of
/// every character.
pub(super) fn string(text: &str) -> Literal {
    quoted(text).parse().unwrap_or_else(|_| Literal::string(text))
}
