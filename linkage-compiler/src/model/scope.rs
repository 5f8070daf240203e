//! The scope of one mechanism: parameters, coordinates, `let`s and points share one namespace.

use std::collections::{BTreeMap, BTreeSet};

use proc_macro2::Ident;

use crate::diagnostics::{Diagnostics, suggestion};
use crate::graph::{ExternalId, Function, NodeId, SymbolId};

/// The value of an expression; `Poison` stands for one with a reported mistake.
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
    /// The derivative of this order of a user function.
    Function(ExternalId, usize),
    /// Declared later.
    Later,
}

#[derive(Debug, Default)]
pub(super) struct Scope {
    entries: BTreeMap<String, Entry>,
    used: BTreeSet<SymbolId>,
    /// Names in statements with syntax errors, which are not reported as undeclared.
    excused: BTreeSet<String>,
    /// The undeclared names, each once, with their number of uses.
    undeclared: Vec<(Ident, usize)>,
}

/// Keywords that are values.
const VALUES: [&str; 2] = ["pi", "t"];

/// The functions of the language besides the operation table, with their number of arguments.
pub(super) const VECTOR_FUNCTIONS: [(&str, usize); 7] =
    [("x", 1), ("y", 1), ("norm", 1), ("angle", 1), ("dot", 2), ("cross", 2), ("powi", 2)];

impl Scope {
    /// Declares a name; returns false and reports an error if it is a keyword or already declared.
    pub(super) fn claim(&mut self, name: &Ident, diagnostics: &mut Diagnostics) -> bool {
        let text = name.to_string();
        if VALUES.contains(&text.as_str()) {
            diagnostics.error(name.span(), format_args!("`{text}` is a keyword of `linkage!`; choose another name"));
            return false;
        }
        if self.entries.contains_key(&text) {
            diagnostics.error(name.span(), format_args!("the name `{text}` is already in use; choose another one"));
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

    /// Records a name in a statement with a syntax error, which may declare it.
    pub(super) fn excuse(&mut self, name: &Ident) {
        self.excused.insert(name.to_string());
    }

    /// The undeclared names in the order of use, with their number of uses.
    pub(super) fn undeclared(&self) -> &[(Ident, usize)] {
        &self.undeclared
    }

    /// Records the use of an undeclared name; returns true if it must be reported.
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
            diagnostics.error(name.span(), format_args!("`{text}` is a function of `linkage!`; choose another name"));
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
                diagnostics.error(name.span(), "`t` (time) can be used only in the laws of a scene");
                Value::Poison
            }
            None => {
                if self.miss(name) {
                    let hint = suggestion(&text, self.entries.keys().map(String::as_str));
                    diagnostics.error(name.span(), format_args!("unknown name `{text}`{hint}"));
                }
                Value::Poison
            }
        }
    }

    pub(super) fn is_used(&self, symbol: SymbolId) -> bool {
        self.used.contains(&symbol)
    }
}
