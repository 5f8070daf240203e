//! The turns of angles: given, or nearest to a guess.

use std::cell::RefCell;

use linkage_runtime::__rt::{NearestTurns, Turn as _, Turns};

use super::defect::Defect;
use super::failure::Evaluated;
use super::scalar::Scalar as _;
use super::value::{Nearest, Turning, Value};
use crate::tape::Traced;

impl Turning {
    pub(crate) fn given(turns: &Value) -> Result<Self, Defect> {
        let turn = |value: &Value| match value {
            Value::Count(count) => i32::try_from(*count).map_err(|_| value.expected("a turn")),
            other => Err(other.expected("a turn")),
        };
        turns.as_list()?.iter().map(turn).collect::<Result<_, _>>().map(Self::Given)
    }

    pub(crate) fn nearest(guesses: &Value) -> Result<Self, Defect> {
        let near = |value: &Value| match value {
            Value::Number(number) => Ok(RefCell::new(Nearest::One(NearestTurns::new([*number])))),
            Value::Traced(guess) => Ok(RefCell::new(Nearest::Traced(guess.clone()))),
            other => Err(other.expected("a number")),
        };
        guesses.as_list()?.iter().map(near).collect::<Result<_, _>>().map(Self::Nearest)
    }

    /// The number of an angle: its principal value and whole turns.
    pub(crate) fn number(&self, place: usize, principal: &Value) -> Evaluated<Value> {
        let none = || Defect::new("a turn that does not exist");
        let is_number = |value: &Value| value.expected("a number");
        Ok(match self {
            Self::Given(turns) => {
                let turn = *turns.get(place).ok_or_else(none)?;
                let turns = Turns([turn]);
                match principal {
                    Value::Number(principal) => Value::Number(turns.number(0, *principal)),
                    Value::Wide(principal) => Value::Wide(turns.number(0, *principal)),
                    Value::Traced(principal) => principal.turned(turn).into_value(),
                    other => return Err(is_number(other).into()),
                }
            }
            Self::Nearest(all) => match (&*all.get(place).ok_or_else(none)?.borrow(), principal) {
                (Nearest::One(nearest), Value::Number(principal)) => Value::Number(nearest.number(0, *principal)),
                (near, principal) => {
                    let Nearest::Traced(near) = near else { return Err(is_number(principal).into()) };
                    let principal = Traced::of(principal).ok_or_else(|| is_number(principal))?;
                    near.nearest_turn(&principal).into_value()
                }
            },
        })
    }

    /// The turns that were found.
    pub(crate) fn found(&self) -> Result<Value, Defect> {
        let turn = |turn: i32| Value::Count(turn.into());
        match self {
            Self::Given(turns) => Ok(Value::list(turns.iter().copied().map(turn))),
            Self::Nearest(all) => {
                let found = all.iter().map(|nearest| match &*nearest.borrow() {
                    Nearest::One(nearest) => Ok(turn(nearest.turns()[0])),
                    Nearest::Traced(_) => Err(Defect::new("the turns of lanes")),
                });
                found.collect::<Result<Vec<_>, _>>().map(Value::list)
            }
        }
    }
}
