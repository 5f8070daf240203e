//! Branches: a side, a number or a turn for each choice.

use std::fmt::{self, Debug, Display, Formatter};

use linkage_runtime::{AssemblyMode, Bounded, Build as _, Column, Dim as _};

use super::{Count, MOST};
use crate::machine::{Defect, Value};
use crate::program::Driver;

/// The assembly branch of a mechanism at run time. Its debug text is that of the type of emitted code.
#[derive(Clone, Copy)]
pub struct BranchAtRunTime<'p> {
    driver: &'p Driver,
    /// True for the solution of the positive root.
    sides: Bounded<bool, MOST>,
    modes: Bounded<AssemblyMode, MOST>,
    turns: Bounded<i32, MOST>,
}

impl PartialEq for BranchAtRunTime<'_> {
    fn eq(&self, other: &Self) -> bool {
        (self.sides, self.modes, self.turns) == (other.sides, other.modes, other.turns)
    }
}

impl Eq for BranchAtRunTime<'_> {}

impl Debug for BranchAtRunTime<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Driver { names, types, sides, modes, turns, .. } = self.driver;
        let mut text = f.debug_struct(&types.branch);
        for (side, is_first) in sides.iter().zip(self.sides) {
            let [first, second] = &side.solutions;
            text.field(names.text(side.field), &format_args!("{}", if is_first { first } else { second }));
        }
        for ((name, _), mode) in modes.iter().zip(self.modes) {
            text.field(names.text(*name), &mode);
        }
        for (name, turn) in turns.iter().zip(self.turns) {
            text.field(names.text(*name), &turn);
        }
        text.finish()
    }
}

/// The choices as the program `linkage` takes them, such as `theta3_theta4=left`, without the turns of angles.
impl Display for BranchAtRunTime<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Driver { names, sides, modes, .. } = self.driver;
        let sides = sides.iter().zip(self.sides).map(|(side, is_first)| {
            let word = side.solutions[usize::from(!is_first)].to_string().to_lowercase();
            (names.text(side.field), word)
        });
        let modes = modes.iter().zip(self.modes).map(|((name, _), mode)| match mode {
            AssemblyMode::Number(number) => (names.text(*name), number.to_string()),
            other => (names.text(*name), format!("{other:?}")),
        });
        for (place, (name, choice)) in sides.chain(modes).enumerate() {
            write!(f, "{}{name}={choice}", if place == 0 { "" } else { ", " })?;
        }
        Ok(())
    }
}

/// An entry for each value.
fn entries<X: Copy + Debug>(
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

impl<'p> BranchAtRunTime<'p> {
    /// The branch that a value is.
    pub(crate) fn read(driver: &'p Driver, value: &Value) -> Result<Self, Defect> {
        let field = |name| value.field(name);
        let sides = driver.sides.iter().map(|side| field(side.field)).collect::<Result<Vec<_>, _>>()?;
        let modes = driver.modes.iter().map(|(name, _)| field(*name)).collect::<Result<Vec<_>, _>>()?;
        let turns = driver.turns.iter().map(|name| field(*name)).collect::<Result<Vec<_>, _>>()?;
        let side = |value: &Value| if let Value::Side(is_first) = value { Some(*is_first) } else { None };
        let mode = |value: &Value| if let Value::Mode(mode) = value { Some(*mode) } else { None };
        let turn = |value: &Value| if let Value::Count(turn) = value { i32::try_from(*turn).ok() } else { None };
        Ok(Self {
            driver,
            sides: entries(&sides, true, side)?,
            modes: entries(&modes, AssemblyMode::OfGuess, mode)?,
            turns: entries(&turns, 0, turn)?,
        })
    }

    /// The branch of a mechanism whose code gave none.
    pub(crate) fn none(driver: &'p Driver) -> Self {
        let least = Count::least();
        let modes = least.array(|_| AssemblyMode::OfGuess);
        Self { driver, sides: least.array(|_| true), modes, turns: least.array(|_| 0) }
    }

    /// The value of this branch.
    pub(crate) fn value(&self) -> Value {
        let driver = self.driver;
        let sides = driver.sides.iter().map(|side| side.field).zip(self.sides.into_iter().map(Value::Side));
        let modes = driver.modes.iter().map(|(name, _)| *name).zip(self.modes.into_iter().map(Value::Mode));
        let turns = driver.turns.iter().copied().zip(self.turns.into_iter().map(|turn| Value::Count(turn.into())));
        Value::record(sides.chain(modes).chain(turns))
    }
}
