//! The scope of one mechanism: parameters, coordinates, `let`s and points share one namespace.

use std::collections::{BTreeMap, BTreeSet};

use proc_macro2::Ident;

use super::functions::VECTOR_FUNCTIONS;
use crate::budget::Budget;
use crate::diagnostics::{Diagnostics, Region, is_near, nearest};
use crate::graph::{ExternalId, Function, NodeId, SymbolId};

/// The value of an expression; `Poison` stands for one with a reported mistake.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Value {
    Scalar(NodeId),
    Vector(NodeId, NodeId),
    Poison,
}

impl Value {
    pub(super) fn scalar(self) -> Option<NodeId> {
        match self {
            Self::Scalar(node) => Some(node),
            Self::Vector(..) | Self::Poison => None,
        }
    }

    pub(super) fn vector(self) -> Option<[NodeId; 2]> {
        match self {
            Self::Vector(x, y) => Some([x, y]),
            Self::Scalar(_) | Self::Poison => None,
        }
    }
}

#[derive(Debug, Clone, Copy)]
enum Entry {
    Symbol(SymbolId, NodeId),
    Value(Value),
    /// The derivative of this order of a user function.
    Function(ExternalId, usize),
    /// Declared later.
    Later,
}

#[derive(Debug, Default)]
pub(super) struct Scope {
    /// The budget of the invocation: a name is compared with all others to find a similar one.
    budget: Budget,
    entries: BTreeMap<String, Entry>,
    used: BTreeSet<SymbolId>,
    /// The symbols of the names that are looked up, in order.
    uses: Vec<SymbolId>,
    /// Names in statements with syntax errors, which are not reported as undeclared.
    excused: BTreeSet<String>,
    /// True if a statement that declares functions has a syntax error.
    pub(super) has_unread_functions: bool,
    /// The undeclared names, each once.
    undeclared: Vec<Undeclared>,
    /// The place of each undeclared name.
    missed: BTreeMap<String, usize>,
    /// The names that are declared again.
    duplicates: BTreeSet<String>,
    /// The names of values that are looked up.
    values: BTreeSet<String>,
    /// True if `t` is time, since there are scenes.
    pub(super) has_time: bool,
    /// The messages of time and of rates that the statement has.
    reported_motion: BTreeSet<String>,
    /// True in the statement of a body.
    pub(super) is_body: bool,
    /// The names of bodies, drivers and scenes, and the message of their use as a value.
    pub(super) others: BTreeMap<String, String>,
}

/// A name that is used but not declared.
#[derive(Debug)]
pub(super) struct Undeclared {
    pub name: Ident,
    pub uses: usize,
    /// Its message, unless it is excused.
    pub message: Option<usize>,
}

impl Scope {
    /// A scope without names.
    pub(super) fn within(budget: &Budget) -> Self {
        Self { budget: budget.clone(), ..Self::default() }
    }

    /// Declares a name; returns false and reports an error if it is a keyword or already declared.
    pub(super) fn claim(&mut self, name: &Ident, diagnostics: &mut Diagnostics) -> bool {
        let text = name.to_string();
        if text == "pi" {
            diagnostics.error(name.span(), "`pi` is a constant of `linkage!`: choose another name");
            return false;
        }
        if text == "t" && self.has_time && !self.entries.contains_key("t") {
            diagnostics.error(name.span(), "`t` is time in a mechanism with scenes: choose another name");
            self.entries.insert(text, Entry::Later);
            return true;
        }
        if self.entries.contains_key(&text) {
            diagnostics.error(name.span(), format_args!("the name `{text}` is already in use: choose another one"));
            self.duplicates.insert(text);
            return false;
        }
        self.entries.insert(text, Entry::Later);
        true
    }

    pub(super) fn define_symbol(&mut self, name: &Ident, symbol: SymbolId, node: NodeId) {
        self.entries.insert(name.to_string(), Entry::Symbol(symbol, node));
    }

    pub(super) fn define(&mut self, name: &Ident, value: Value) {
        // The first declaration of a name counts.
        if let Some(entry @ Entry::Later) = self.entries.get_mut(&name.to_string()) {
            *entry = Entry::Value(value);
        }
    }

    /// Lets a name have no value, so that its uses are no further mistakes.
    pub(super) fn spoil(&mut self, name: &Ident) {
        self.entries.insert(name.to_string(), Entry::Value(Value::Poison));
    }

    /// Records a name in a statement with a syntax error, which may declare it.
    pub(super) fn excuse(&mut self, name: impl Into<String>) {
        self.excused.insert(name.into());
    }

    /// The undeclared names in the order of use.
    pub(super) fn undeclared(&self) -> &[Undeclared] {
        &self.undeclared
    }

    /// The names of all declarations.
    pub(super) fn names(&self) -> impl Iterator<Item = &str> {
        self.entries.keys().map(String::as_str)
    }

    /// True if a similar name is declared twice: one of the two is meant.
    pub(super) fn may_be_duplicate(&self, name: &str) -> bool {
        self.budget.spend(self.duplicates.len()).is_ok() && self.duplicates.iter().any(|other| is_near(other, name))
    }

    /// True if a value is used.
    pub(super) fn is_value_used(&self, name: &str) -> bool {
        self.values.contains(name)
    }

    /// The declared name that is most similar.
    pub(super) fn nearest(&self, name: &str) -> Option<&str> {
        self.budget.spend(self.entries.len()).ok()?;
        nearest(name, self.names())
    }

    /// The value of a similar name, which may be meant by an undeclared one.
    fn meant(&self, name: &str) -> Value {
        match self.nearest(name).and_then(|near| self.entries.get(near)) {
            Some(Entry::Symbol(_, node)) => Value::Scalar(*node),
            Some(Entry::Value(value)) => *value,
            _ => Value::Poison,
        }
    }

    /// Begins another statement.
    pub(super) fn begin_statement(&mut self) {
        self.reported_motion.clear();
    }

    /// Reports time or a rate where there is no motion, once in a statement.
    pub(super) fn report_motion(&mut self, what: &str, at: impl Into<Region>, diagnostics: &mut Diagnostics) {
        if self.reported_motion.insert(what.to_owned()) {
            let place = if self.is_body {
                "what a body has depends on its position alone"
            } else {
                "write the expression there, as in `torque … on phi;`"
            };
            let message = format!("{what} can be used only in the laws of a scene: {place}");
            diagnostics.error(at, message);
        }
    }

    /// Reports the first use of a name that has no value.
    fn report_other(&mut self, name: &Ident, diagnostics: &mut Diagnostics) {
        if let Some(message) = self.others.get(&name.to_string()).filter(|_| self.excused.insert(name.to_string())) {
            diagnostics.error(name.span(), message);
        }
    }

    /// True for the name of something without a value: a body, a driver, a scene.
    pub(super) fn is_other(&self, name: &Ident) -> bool {
        self.others.contains_key(&name.to_string()) && !self.is_declared(name)
    }

    /// Records the use of an undeclared name, with a message at the first.
    pub(super) fn miss(&mut self, name: &Ident, diagnostics: &mut Diagnostics) {
        let text = name.to_string();
        if let Some(undeclared) = self.missed.get(&text).and_then(|&place| self.undeclared.get_mut(place)) {
            undeclared.uses += 1;
            return;
        }
        let is_excused = self.is_excused(&text) || self.may_be_duplicate(&text);
        let message = (!is_excused).then(|| {
            // It is completed when all names are known.
            diagnostics.error(name.span(), format_args!("unknown name `{name}`"));
            diagnostics.len() - 1
        });
        self.missed.insert(text, self.undeclared.len());
        self.undeclared.push(Undeclared { name: name.clone(), uses: 1, message });
    }

    /// True if a name is declared.
    pub(super) fn is_declared(&self, name: &Ident) -> bool {
        self.is_known(&name.to_string())
    }

    pub(super) fn is_known(&self, name: &str) -> bool {
        self.entries.contains_key(name)
    }

    /// True for the name of a parameter or a coordinate.
    pub(super) fn is_symbol(&self, name: &Ident) -> bool {
        self.symbol(name).is_some()
    }

    /// True for the name of a `let`, a point or an output.
    pub(super) fn is_value(&self, name: &Ident) -> bool {
        matches!(self.entries.get(&name.to_string()), Some(Entry::Value(_)))
    }

    /// The symbol of a name.
    pub(super) fn symbol(&self, name: &Ident) -> Option<SymbolId> {
        self.symbol_of(&name.to_string())
    }

    pub(super) fn symbol_of(&self, name: &str) -> Option<SymbolId> {
        match self.entries.get(name) {
            Some(Entry::Symbol(symbol, _)) => Some(*symbol),
            _ => None,
        }
    }

    /// True if a statement with a syntax error may declare a function of this name.
    pub(super) fn is_excused(&self, name: &str) -> bool {
        self.excused.contains(name)
    }

    /// Declares the name of a user function; reports an error if the language has a function of this name.
    pub(super) fn claim_function(
        &mut self,
        name: &Ident,
        function: ExternalId,
        order: usize,
        diagnostics: &mut Diagnostics,
    ) {
        let text = name.to_string();
        if Function::named(&text).is_some()
            || VECTOR_FUNCTIONS.iter().any(|(other, _)| *other == text)
            || text == "rate"
        {
            diagnostics.error(name.span(), format_args!("`{text}` is a function of `linkage!`: choose another name"));
        } else if self.claim(name, diagnostics) {
            self.entries.insert(text, Entry::Function(function, order));
        }
    }

    /// The user function of this name and the order of its derivative.
    pub(super) fn function(&self, name: &str) -> Option<(ExternalId, usize)> {
        match self.entries.get(name) {
            Some(Entry::Function(function, order)) => Some((*function, *order)),
            _ => None,
        }
    }

    /// The names of all user functions and their derivatives.
    pub(super) fn functions(&self) -> impl Iterator<Item = &str> {
        self.entries.iter().filter(|(_, entry)| matches!(entry, Entry::Function(..))).map(|(name, _)| name.as_str())
    }

    /// The value of a name; an undeclared one is reported at its first use.
    pub(super) fn look_up(&mut self, name: &Ident, diagnostics: &mut Diagnostics) -> Value {
        let text = name.to_string();
        match self.entries.get(&text) {
            Some(Entry::Symbol(symbol, node)) => {
                let (symbol, node) = (*symbol, *node);
                self.mention(symbol);
                Value::Scalar(node)
            }
            Some(Entry::Value(value)) => {
                let value = *value;
                self.values.insert(text);
                value
            }
            Some(Entry::Function(..)) => {
                diagnostics.error(name.span(), format_args!("`{text}` is a function: write `{text}(…)`"));
                Value::Poison
            }
            Some(Entry::Later) => {
                diagnostics
                    .error(name.span(), format_args!("`{text}` is used before it is defined; move its statement up"));
                Value::Poison
            }
            None if text == "t" && self.has_time => {
                self.report_motion("`t` (time)", name.span(), diagnostics);
                Value::Poison
            }
            None if self.others.contains_key(&text) => {
                self.report_other(name, diagnostics);
                Value::Poison
            }
            None => {
                self.miss(name, diagnostics);
                self.meant(&text)
            }
        }
    }

    pub(super) fn is_used(&self, symbol: SymbolId) -> bool {
        self.used.contains(&symbol)
    }

    /// The number of names that were looked up so far.
    pub(super) fn uses(&self) -> usize {
        self.uses.len()
    }

    /// The symbols of the names that were looked up since there were `before` of them.
    pub(super) fn used_since(&self, before: usize) -> BTreeSet<SymbolId> {
        self.uses[before..].iter().copied().collect()
    }

    /// Records the use of a name.
    pub(super) fn mention(&mut self, symbol: SymbolId) {
        self.used.insert(symbol);
        self.uses.push(symbol);
    }
}
