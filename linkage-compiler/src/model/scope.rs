//! The names of one mechanism: parameters, coordinates, `let`s and points share one space.

use std::collections::{BTreeMap, BTreeSet};

use proc_macro2::Ident;

use crate::diagnostics::{Diagnostics, suggestion};
use crate::graph::{ExternalId, Function, NodeId, SymbolId};

/// What an expression is worth: `Poison` stands for one already reported.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Value {
    Scalar(NodeId),
    Vector(NodeId, NodeId),
    Poison,
}

#[derive(Debug, Clone, Copy)]
enum Entry {
    Symbol(SymbolId, NodeId),
    Value(Value),
    /// The derivative of this order of a function of the user's.
    Function(ExternalId, usize),
    /// Declared further down.
    Later,
}

#[derive(Debug, Default)]
pub(super) struct Scope {
    entries: BTreeMap<String, Entry>,
    used: BTreeSet<SymbolId>,
    /// The names in statements that could not be read.
    excused: BTreeSet<String>,
    /// The names that nothing declares, each once, and how often they are used.
    undeclared: Vec<(Ident, usize)>,
}

/// Words that are values of the language itself.
const VALUES: [&str; 2] = ["pi", "t"];

/// What the language calls besides the op table.
pub(super) const VECTOR_FUNCTIONS: [(&str, usize); 7] =
    [("x", 1), ("y", 1), ("norm", 1), ("angle", 1), ("dot", 2), ("cross", 2), ("powi", 2)];

impl Scope {
    /// Claims a name; a second claim is reported and refused.
    pub(super) fn claim(&mut self, name: &Ident, diagnostics: &mut Diagnostics) -> bool {
        let text = name.to_string();
        if VALUES.contains(&text.as_str()) {
            diagnostics.error(name.span(), format_args!("`{text}` is a word of the language; choose another name"));
            return false;
        }
        if self.entries.contains_key(&text) {
            diagnostics.error(name.span(), format_args!("`{text}` is already the name of something else here"));
            return false;
        }
        self.entries.insert(text, Entry::Later);
        true
    }

    pub(super) fn define_symbol(&mut self, name: &Ident, symbol: SymbolId, node: NodeId) {
        self.entries.insert(name.to_string(), Entry::Symbol(symbol, node));
    }

    pub(super) fn define(&mut self, name: &Ident, value: Value) {
        // A name that was something else before stays so.
        if let Some(entry @ Entry::Later) = self.entries.get_mut(&name.to_string()) {
            *entry = Entry::Value(value);
        }
    }

    /// A name in a statement that could not be read: what it means is not known, but that is reported.
    pub(super) fn excuse(&mut self, name: &Ident) {
        self.excused.insert(name.to_string());
    }

    /// The names that nothing declares, in the order in which they are used, and how often they are.
    pub(super) fn undeclared(&self) -> &[(Ident, usize)] {
        &self.undeclared
    }

    /// Records the use of a name that nothing declares; true if it is to be reported.
    fn miss(&mut self, name: &Ident) -> bool {
        if let Some((_, uses)) = self.undeclared.iter_mut().find(|(other, _)| other == name) {
            *uses += 1;
            return false;
        }
        self.undeclared.push((name.clone(), 1));
        !self.excused.contains(&name.to_string())
    }

    /// The symbol of a name.
    pub(super) fn symbol(&self, name: &Ident) -> Option<SymbolId> {
        match self.entries.get(&name.to_string()) {
            Some(Entry::Symbol(symbol, _)) => Some(*symbol),
            _ => None,
        }
    }

    /// True if a function of this name may be declared in a statement that could not be read.
    pub(super) fn is_excused(&self, name: &str) -> bool {
        self.excused.contains(name)
    }

    /// Claims the name of a function; that of one of the language is refused.
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
            diagnostics.error(name.span(), format_args!("`{text}` is a function of the language; choose another name"));
        } else if self.claim(name, diagnostics) {
            self.entries.insert(text, Entry::Function(function, order));
        }
    }

    /// A function of the user's and the order of its derivative.
    pub(super) fn function(&self, name: &str) -> Option<(ExternalId, usize)> {
        match self.entries.get(name) {
            Some(Entry::Function(function, order)) => Some((*function, *order)),
            _ => None,
        }
    }

    /// The names of all functions of the user's.
    pub(super) fn functions(&self) -> impl Iterator<Item = &str> {
        self.entries.iter().filter(|(_, entry)| matches!(entry, Entry::Function(..))).map(|(name, _)| name.as_str())
    }

    /// The value of a name; an unknown one is reported where it is used first.
    pub(super) fn look_up(&mut self, name: &Ident, diagnostics: &mut Diagnostics) -> Value {
        let text = name.to_string();
        match self.entries.get(&text) {
            Some(Entry::Symbol(symbol, node)) => {
                self.used.insert(*symbol);
                Value::Scalar(*node)
            }
            Some(Entry::Value(value)) => *value,
            Some(Entry::Function(..)) => {
                diagnostics.error(name.span(), format_args!("`{text}` is a function: write `{text}(…)`"));
                Value::Poison
            }
            Some(Entry::Later) => {
                diagnostics
                    .error(name.span(), format_args!("`{text}` is used before it is defined; move its statement up"));
                Value::Poison
            }
            None if text == "t" => {
                diagnostics.error(name.span(), "`t`, time, has a meaning only in the forces of a scene");
                Value::Poison
            }
            None => {
                if self.miss(name) {
                    let hint = suggestion(&text, self.entries.keys().map(String::as_str));
                    diagnostics.error(name.span(), format_args!("nothing is called `{text}` here{hint}"));
                }
                Value::Poison
            }
        }
    }

    pub(super) fn is_used(&self, symbol: SymbolId) -> bool {
        self.used.contains(&symbol)
    }
}
