//! The state of the analysis of one mechanism.

use std::collections::{BTreeMap, BTreeSet};

use super::kind::{Kind, Kinds};
use super::mechanism::{ExternalFunction, Extreme};
use super::scope::{Scope, Value};
use crate::budget::Budget;
use crate::diagnostics::Diagnostics;
use crate::graph::{Graph, NodeId, SymbolId};
use crate::syntax::Expressions;

/// The names, values and kinds of a mechanism so far.
pub(super) struct Resolver<'a> {
    pub(super) graph: Graph,
    pub(super) scope: Scope,
    pub(super) expressions: &'a Expressions,
    /// The value of each expression, by id; expressions are read in ascending order.
    pub(super) values: Vec<Value>,
    pub(super) mode: Mode,
    pub(super) externals: Vec<ExternalFunction>,
    pub(super) kinds: Kinds,
    pub(super) assumed: Assumed,
    pub(super) motion: Motion,
    /// The declared ranges by the values that have them.
    pub(super) ranges: BTreeMap<NodeId, [Option<NodeId>; 2]>,
    /// The symbols that statements outside of scenes mention.
    pub(super) kinematic: BTreeSet<SymbolId>,
    pub(super) reported: Reported,
    /// The literal with the most extreme magnitude so far.
    pub(super) extreme: Option<Extreme>,
    pub(super) diagnostics: &'a mut Diagnostics,
}

/// The statement in which an expression stands, where that matters.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Mode {
    Plain,
    /// In a loop components of vectors are lengths.
    Loop,
    /// The default of a parameter depends on no names.
    Default,
    /// The field of gravity.
    Field,
    /// In the law of a scene `rate` and `t` are allowed.
    Law,
}

impl Mode {
    /// True where a vector is a load: its components are no lengths.
    pub(super) fn is_of_loads(self) -> bool {
        matches!(self, Self::Field | Self::Law)
    }
}

/// The kinds and the symbols of names that may be undeclared, from their use.
#[derive(Debug, Default)]
pub(super) struct Assumed {
    pub(super) kinds: Vec<(String, Kind)>,
    /// They may be coordinates.
    pub(super) symbols: BTreeMap<String, SymbolId>,
}

/// The names of motion; none without scenes.
#[derive(Debug, Default)]
pub(super) struct Motion {
    /// The rate of each coordinate.
    pub(super) rates: BTreeMap<SymbolId, NodeId>,
    pub(super) time: Option<NodeId>,
    /// The expressions of laws, by index.
    pub(super) laws: BTreeSet<usize>,
}

/// Mistakes that are reported once, however often they are made.
#[derive(Debug, Default)]
pub(super) struct Reported {
    /// Names of scalars among vectors.
    pub(super) scalars: BTreeSet<String>,
    /// Suffixes of numbers that are no units.
    pub(super) units: BTreeSet<String>,
}

impl<'a> Resolver<'a> {
    pub(super) fn new(expressions: &'a Expressions, budget: &Budget, diagnostics: &'a mut Diagnostics) -> Self {
        Self {
            graph: Graph::within(budget),
            scope: Scope::within(budget),
            expressions,
            values: Vec::new(),
            mode: Mode::Plain,
            externals: Vec::new(),
            kinds: Kinds::default(),
            assumed: Assumed::default(),
            motion: Motion::default(),
            ranges: BTreeMap::new(),
            kinematic: BTreeSet::new(),
            reported: Reported::default(),
            extreme: None,
            diagnostics,
        }
    }

    /// Reads expressions in a mode.
    pub(super) fn within<R>(&mut self, mode: Mode, read: impl FnOnce(&mut Self) -> R) -> R {
        let before = std::mem::replace(&mut self.mode, mode);
        let result = read(self);
        self.mode = before;
        result
    }
}
