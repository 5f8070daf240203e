//! The dependencies of the formulas of a scene, and M and Q as symbols.

use std::collections::BTreeSet;

use crate::graph::SymbolId;
use crate::ids::{InputId, Table};

/// A dependency of formulas of a scene, in the order in which layers take it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Read {
    Time,
    Q,
    Pose,
    /// W.
    Ratios,
    /// q'.
    Rates,
    /// u'' at v'' = 0.
    Bias,
    /// v'.
    InputRates,
    /// M.
    Inertia,
    /// Q.
    Forces,
}

/// M and Q as symbols of formulas that are made of them, and what they depend on.
#[derive(Debug, Default)]
pub struct Layers {
    /// M by rows; an entry and the one opposite are the same.
    pub inertia: Table<InputId, Table<InputId, SymbolId>>,
    /// Q.
    pub forces: Table<InputId, SymbolId>,
    /// For each part of Q that varies its label and its name.
    pub(super) parts: Vec<(String, SymbolId)>,
    pub(super) inertia_reads: BTreeSet<Read>,
    pub(super) parts_read: BTreeSet<Read>,
}
