//! A mechanism with its branches and case columns.

use std::collections::HashSet;
use std::fmt::{self, Debug};
use std::sync::Arc;

use linkage_runtime::lanes::Lanes;
use linkage_sweep::{Block, Case, Column, Sweep, given, names};
use linkage_sweep_arrow::Scalar;

use crate::cases::{Cases, FIRST_ROW};
use crate::chunked::Chunked;
use crate::column::CaseColumn;
use crate::positions::{CASE, Positions, ROW};
use crate::{EngineError, Request, TableKind};

/// The rows per chunk without a request: DataFusion's batches have as many.
const ROWS_PER_CHUNK: usize = 8192;

/// A mechanism as tables: a design, an assembly branch, and numbers of a case.
///
/// ```
/// use linkage::Elbow;
/// use linkage_engine::mechanisms::{FourBar, FourBarBranch};
/// use linkage_engine::{EngineError, Family, Mechanisms};
/// use linkage_sweep::found;
///
/// // The smallest sine of the transmission angle of each design that turns fully.
/// let family = Family::new(FourBar::<f64>::default(), FourBarBranch::new(Elbow::Left))
///     .branch("crossed", FourBarBranch::new(Elbow::Right))
///     .case_column("min_sine", [found("mu")], |case| {
///         let least = |[angles]: [&[f64]; 1]| angles.iter().fold(1.0, |least: f64, mu| least.min(mu.sin().abs()));
///         case.accepted.iter().all(|accepted| *accepted).then(|| least(case.columns))
///     });
/// Mechanisms::default().register("four_bar", family)?;
/// # Ok::<(), EngineError>(())
/// ```
pub struct Family<M: Lanes> {
    base: M,
    branch: M::Branch,
    branches: Vec<(String, M::Branch)>,
    case_columns: Vec<CaseColumn<M>>,
}

impl<M: Lanes> Debug for Family<M> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut family = f.debug_struct("Family");
        family.field("mechanism", &M::NAME).field("branch", &self.branch).field("branches", &self.branches);
        family.field("case_columns", &self.case_columns).finish_non_exhaustive()
    }
}

impl<M: Lanes> Family<M> {
    /// The designs of a mechanism on one assembly branch. Parameters that a plan does not name are those of `base`.
    pub fn new(base: M, branch: M::Branch) -> Self {
        Self { base, branch, branches: Vec::new(), case_columns: Vec::new() }
    }

    /// Adds a branch that requests choose by name.
    #[must_use]
    pub fn branch(mut self, name: impl Into<String>, branch: M::Branch) -> Self {
        self.branches.push((name.into(), branch));
        self
    }

    /// Adds a column of the table function `cases`: a number of each case, computed from these columns of its rows, in which
    /// a number that does not exist is NaN. `None` and NaN become null.
    ///
    /// The number must depend on the case alone: cases are computed in any order, and more than once if a query asks for
    /// that.
    #[must_use]
    pub fn case_column<const N: usize>(
        mut self,
        name: impl Into<String>,
        columns: [Column; N],
        value: impl Fn(&Case<'_, M::Scalar, N>) -> Option<f64> + Send + Sync + 'static,
    ) -> Self {
        let needed = columns.to_vec();
        let values = move |block: &Block<'_, M>| {
            let mut places = [linkage_sweep::Place::Given(0); N];
            for (place, column) in places.iter_mut().zip(&columns) {
                *place = column.place::<M>()?;
            }
            Ok(block.cases(places).map(|case| value(&case).filter(|value| !value.is_nan())).collect())
        };
        self.case_columns.push(CaseColumn { name: name.into(), columns: needed, values: Arc::new(values) });
        self
    }

    /// An error if a name occurs twice, or a case column needs a column that there is not.
    pub(crate) fn check(&self) -> Result<(), EngineError> {
        unique("branch", self.branches.iter().map(|(name, _)| name.clone()))?;
        for column in self.case_columns.iter().flat_map(|column| &column.columns) {
            column.place::<M>()?;
        }
        let given: Vec<Column> = (0..M::GIVEN.len()).map(given).collect();
        let numbers = |numbers: [&str; 2]| numbers.map(str::to_owned).into_iter();
        unique("column", numbers([ROW, CASE]).chain(names::<M>(&Column::all::<M>())?))?;
        let values = self.case_columns.iter().map(|column| column.name.clone());
        unique("column", numbers([CASE, FIRST_ROW]).chain(names::<M>(&given)?).chain(values))
    }

    /// The branch that a request names.
    fn named(&self, mechanism: &str, name: Option<&str>) -> Result<M::Branch, EngineError> {
        let Some(name) = name else { return Ok(self.branch) };
        let found = self.branches.iter().find(|(other, _)| other == name).map(|(_, branch)| *branch);
        found.ok_or_else(|| EngineError::UnknownBranch {
            mechanism: mechanism.to_owned(),
            name: name.to_owned(),
            known: self.branches.iter().map(|(name, _)| name.clone()).collect(),
        })
    }

    /// The sweep of a request. `case_factors` is the number of factors of a case if the request has none.
    fn sweep(&self, mechanism: &str, request: &Request, case_factors: usize) -> Result<Sweep<M>, EngineError> {
        let branch = self.named(mechanism, request.branch.as_deref())?;
        let sweep = Sweep::new(&self.base, branch, request.plan())?;
        let sweep = sweep.with_case(request.case_factors.unwrap_or(case_factors))?;
        Ok(sweep.with_rows_per_chunk(request.rows_per_chunk.unwrap_or(ROWS_PER_CHUNK))?)
    }
}

/// An error if a name occurs twice.
fn unique(kind: &'static str, names: impl Iterator<Item = String>) -> Result<(), EngineError> {
    let mut seen = HashSet::new();
    for name in names {
        if !seen.insert(name.clone()) {
            return Err(EngineError::Registered { kind, name });
        }
    }
    Ok(())
}

/// A mechanism whose type is not known.
pub trait AnyFamily: Debug + Send + Sync {
    /// Opens a table of the mechanism, which is registered under this name.
    fn open(&self, mechanism: &str, kind: TableKind, request: &Request) -> Result<Arc<dyn Chunked>, EngineError>;
}

impl<M> AnyFamily for Family<M>
where
    M: Lanes + Send + Sync + 'static,
    M::Scalar: Scalar,
    M::Branch: Send + Sync,
{
    fn open(&self, mechanism: &str, kind: TableKind, request: &Request) -> Result<Arc<dyn Chunked>, EngineError> {
        Ok(match kind {
            TableKind::Sweep => {
                let sweep = self.sweep(mechanism, request, 0)?;
                Arc::new(Positions::new(sweep, request.case_factors.is_some())?)
            }
            TableKind::Cases => {
                let sweep = self.sweep(mechanism, request, 1)?;
                Arc::new(Cases::new(sweep, self.case_columns.clone())?)
            }
        })
    }
}
