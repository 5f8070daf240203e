//! Branches: a side, a number or a turn for each choice.

use linkage_runtime::{AssemblyMode, Bounded, Build as _, Column, Dim as _};

use super::{Count, MOST};
use crate::machine::{Defect, Value};
use crate::program::Driver;

/// The assembly branch of a mechanism at run time.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct BranchAtRunTime {
    /// True for the solution of the positive root.
    sides: Bounded<bool, MOST>,
    modes: Bounded<AssemblyMode, MOST>,
    turns: Bounded<i32, MOST>,
}

/// An entry for each value.
fn entries<X: Copy + std::fmt::Debug>(
    values: &[&Value],
    nothing: X,
    read: impl Fn(&Value) -> Option<X>,
) -> Result<Bounded<X, MOST>, Defect> {
    let count = Count::new(values.len()).ok_or_else(|| Defect::new("a branch of too many groups"))?;
    let mut column: Column<X, Count> = count.repeat(nothing);
    for (entry, value) in column.iter_mut().zip(values) {
        *entry = read(value).ok_or_else(|| value.expected("a choice of a branch"))?;
    }
    Ok(count.array(|place| column[place]))
}

impl BranchAtRunTime {
    /// The branch that a value is.
    pub(crate) fn read(driver: &Driver, value: &Value) -> Result<Self, Defect> {
        let field = |name| value.field(name);
        let sides = driver.sides.iter().map(|side| field(side.field)).collect::<Result<Vec<_>, _>>()?;
        let modes = driver.modes.iter().map(|(name, _)| field(*name)).collect::<Result<Vec<_>, _>>()?;
        let turns = driver.turns.iter().map(|name| field(*name)).collect::<Result<Vec<_>, _>>()?;
        let side = |value: &Value| if let Value::Side(is_first) = value { Some(*is_first) } else { None };
        let mode = |value: &Value| if let Value::Mode(mode) = value { Some(*mode) } else { None };
        let turn = |value: &Value| if let Value::Count(turn) = value { i32::try_from(*turn).ok() } else { None };
        Ok(Self {
            sides: entries(&sides, true, side)?,
            modes: entries(&modes, AssemblyMode::OfGuess, mode)?,
            turns: entries(&turns, 0, turn)?,
        })
    }

    /// The branch of a mechanism whose code gave none.
    pub(crate) fn none() -> Self {
        let least = Count::least();
        Self { sides: least.array(|_| true), modes: least.array(|_| AssemblyMode::OfGuess), turns: least.array(|_| 0) }
    }

    /// The value of this branch.
    pub(crate) fn value(&self, driver: &Driver) -> Value {
        let sides = driver.sides.iter().map(|side| side.field).zip(self.sides.into_iter().map(Value::Side));
        let modes = driver.modes.iter().map(|(name, _)| *name).zip(self.modes.into_iter().map(Value::Mode));
        let turns = driver.turns.iter().copied().zip(self.turns.into_iter().map(|turn| Value::Count(turn.into())));
        Value::record(driver.types.branch, sides.chain(modes).chain(turns))
    }
}
