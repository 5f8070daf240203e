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
    /// `u''` at `v'' = 0`.
    Bias,
    /// v'.
    InputRates,
    /// M.
    Inertia,
    /// Q.
    Forces,
}

/// The symbols of M and Q in other formulas, and the dependencies of M and Q.
#[derive(Debug, Default)]
pub struct Layers {
    /// M by rows; both entries of a symmetric pair are one symbol.
    pub inertia: Table<InputId, Table<InputId, SymbolId>>,
    /// Q.
    pub forces: Table<InputId, SymbolId>,
    /// The label and the symbol of each part of Q that is not constant.
    pub(super) parts: Vec<(String, SymbolId)>,
    pub(super) inertia_reads: BTreeSet<Read>,
    pub(super) parts_read: BTreeSet<Read>,
}
