//! Straight-line code: lines that compute values in order.

use linkage_ir::ValueId;

use super::value::{Leaf, Signed, Value};
use crate::derivation::ChordGeometry;
use crate::graph::{ExternalId, Function, SymbolId};
use crate::ids::GroupId;
use crate::structure::Guide;

/// One line of straight-line code.
#[derive(Debug, Clone)]
pub enum Line {
    Let(ValueId),
    /// Sine and cosine of one angle.
    SineCosine(Circular),
    /// The sines and cosines of several angles in one vector operation.
    SinesCosines(Vec<Circular>),
    /// One call of a user function; `values` are its value and derivatives, `None` if not used.
    External {
        function: ExternalId,
        arguments: Vec<Signed>,
        values: Vec<Option<ValueId>>,
    },
    Name {
        symbol: SymbolId,
        value: Signed,
    },
    Turn {
        symbol: SymbolId,
        principal: Signed,
        range: Option<[Signed; 2]>,
    },
    Guard {
        group: GroupId,
        determinant: Signed,
        scale: Signed,
    },
    Factor {
        group: GroupId,
        matrix: Vec<Vec<Signed>>,
        row_scales: Vec<Signed>,
    },
    Solve {
        group: GroupId,
        targets: Vec<SymbolId>,
        right: Vec<Signed>,
    },
    Pivots {
        symbol: SymbolId,
        matrix: Vec<Vec<Signed>>,
    },
    Chord {
        group: GroupId,
        symbol: SymbolId,
        factors: [Signed; 2],
        size: Signed,
        of: ChordGeometry<Signed>,
    },
    Solvable {
        group: GroupId,
        determinant: Signed,
        numerators: Vec<Signed>,
        scales: Vec<Signed>,
    },
    Reach {
        group: GroupId,
        length: Signed,
    },
    Newton {
        group: GroupId,
        targets: Vec<SymbolId>,
        start: Vec<Signed>,
        /// One evaluation of the group.
        system: Box<Schedule>,
    },
    Modes {
        group: GroupId,
        targets: Vec<SymbolId>,
        /// k_i and c_ij, by loop.
        constants: Vec<[Signed; 2]>,
        factors: Vec<Vec<[Signed; 2]>>,
        /// The factor of each direction in each unknown.
        unknowns: Vec<Vec<i64>>,
        /// The guide of each unknown that is a length.
        guides: Vec<Option<Guide<Signed>>>,
        /// One evaluation of the group.
        system: Box<Schedule>,
    },
}

/// An angle with its sine and cosine, if they are used.
#[derive(Debug, Clone, Copy)]
pub struct Circular {
    pub angle: Signed,
    pub sine: Option<ValueId>,
    pub cosine: Option<ValueId>,
}

impl Circular {
    pub(super) fn is_pair(&self) -> bool {
        self.sine.is_some() && self.cosine.is_some()
    }
}

/// A kernel as straight-line code.
#[derive(Debug, Clone)]
pub struct Schedule {
    pub(super) values: Vec<Value>,
    /// The number of the last step that each value depends on.
    pub(super) known: Vec<usize>,
    pub lines: Vec<Line>,
    /// The results.
    pub results: Vec<Signed>,
    /// Preferred names of values, with true for names of the negative of the value.
    pub(super) names: Vec<(ValueId, bool, String)>,
    pub(super) used: Vec<ValueId>,
}

impl Schedule {
    #[must_use]
    pub fn value(&self, id: ValueId) -> &Value {
        &self.values[id.index()]
    }

    /// The preferred name of a value, with true if it is the name of the negative of the value.
    #[must_use]
    pub fn name(&self, id: ValueId) -> Option<(&str, bool)> {
        // The last of several names.
        let after = self.names.partition_point(|(value, ..)| *value <= id);
        let (value, negative, name) = self.names.get(after.checked_sub(1)?)?;
        (*value == id).then_some((name, *negative))
    }

    /// Every value that the lines depend on, ascending.
    #[must_use]
    pub fn used(&self) -> &[ValueId] {
        &self.used
    }

    /// True if a loop over it can be vectorised: no iteration, no pivoting, no function of the user or of a library.
    pub(super) fn is_branch_free(&self) -> bool {
        let is_plain = |line: &Line| {
            !matches!(
                line,
                Line::External { .. }
                    | Line::Factor { .. }
                    | Line::Solve { .. }
                    | Line::Pivots { .. }
                    | Line::Newton { .. }
                    | Line::Modes { .. }
            )
        };
        let is_inlined = |id: &ValueId| match self.value(*id) {
            Value::Call(function, _) => matches!(
                function,
                Function::Sin | Function::Cos | Function::Atan2 | Function::Hypot | Function::Sqrt | Function::Abs
            ),
            Value::Given(Leaf::External(..)) => false,
            _ => true,
        };
        self.lines.iter().all(is_plain) && self.used().iter().all(is_inlined)
    }

    /// The symbols that are used.
    pub(super) fn symbols(&self) -> impl Iterator<Item = SymbolId> {
        self.used().iter().filter_map(|&id| match self.value(id) {
            Value::Given(Leaf::Symbol(symbol)) => Some(*symbol),
            _ => None,
        })
    }

    /// True if some line uses a symbol.
    pub(super) fn uses(&self, symbol: SymbolId) -> bool {
        self.symbols().any(|used| used == symbol)
    }
}
