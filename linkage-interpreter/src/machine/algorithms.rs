//! Algorithms over a mechanism as a whole, which call its functions. The machine runs functions only: it is given them.

use std::cell::RefCell;

use linkage_ir::ValueId;
use linkage_ir::code::Code;

use super::defect::Defect;
use super::failure::Evaluated;
use super::value::Value;
use super::{Machine, User};
use crate::program::{Driver, Scene};

/// A mechanism with its user functions and its parameters.
pub(crate) struct Whole<'w> {
    pub(crate) driver: &'w Driver,
    pub(crate) users: &'w [Option<User>],
    /// The mechanism, or the scene with it.
    pub(crate) own: Value,
}

/// A position, and how positions near it are found.
pub(crate) struct AroundPosition<'p> {
    /// The index of the input.
    pub(crate) place: usize,
    /// A pose.
    pub(crate) position: &'p Value,
    /// For each group that has one the function that is not negative where it can be assembled.
    pub(crate) bounds: &'p [Value],
    /// The search for others: none, a turn, or a length.
    pub(crate) search: &'p Value,
    /// The position at the inputs of coordinates nearby.
    pub(crate) assemble: &'p dyn Fn(Value) -> Evaluated<Value>,
}

/// The motion of a scene that starts at a position with these rates of the inputs.
pub(crate) struct Moving<'m> {
    pub(crate) scene: &'m Scene,
    pub(crate) t: f64,
    pub(crate) q: &'m Value,
    pub(crate) input_rates: &'m Value,
}

/// A load of a motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Load {
    /// The forces in joints.
    Joints,
    /// The forces of drives.
    Drives,
    /// The power that frictions by reaction dissipate.
    LossOfBearings,
}

/// The algorithms.
pub(crate) trait Algorithms {
    /// The position near a guess by Newton's method, on its branch or on any.
    fn newton(&self, of: Whole<'_>, guess: &Value, is_on_any_branch: bool) -> Evaluated<Value>;
    /// The limits of an input about a position.
    fn limits(&self, of: Whole<'_>, about: &AroundPosition<'_>) -> Evaluated<Value>;
    /// A load of the motion of a scene; the value is that of the scene.
    fn load(&self, of: Whole<'_>, moving: &Moving<'_>, load: Load) -> Evaluated<Value>;
}

impl<'c> Machine<'c> {
    fn algorithms(&self) -> Result<&'c dyn Algorithms, Defect> {
        self.algorithms.ok_or_else(|| Defect::new("an algorithm within another"))
    }

    fn whole(&self, own: Value) -> Whole<'c> {
        Whole { driver: self.driver, users: self.users, own }
    }

    pub(super) fn newton(&self, own: &Value, guess: &Value, is_on_any_branch: bool) -> Evaluated<Value> {
        self.algorithms()?.newton(self.whole(own.clone()), guess, is_on_any_branch)
    }

    /// A load of the scene: the arguments are the scene, t, q and v'.
    pub(super) fn load(&self, arguments: &[Value], load: Load) -> Evaluated<Value> {
        let ([own, Value::Number(t), q, input_rates], Some(scene)) = (arguments, self.scene) else {
            return Err(Defect::new("a motion without a scene").into());
        };
        self.algorithms()?.load(self.whole(own.clone()), &Moving { scene, t: *t, q, input_rates }, load)
    }

    /// The limits of an input; the last argument of emitted code, the function that finds the coordinates of a pose, is known.
    pub(super) fn limits(&mut self, code: &'c Code, arguments: &'c [ValueId]) -> Evaluated<Value> {
        let algorithms = self.algorithms()?;
        let values = self.values(code, arguments)?;
        let [own, place, position, bounds, search, assemble] = values.as_slice() else {
            return Err(Defect::new("limits of something else").into());
        };
        let (whole, place, bounds) = (self.whole(own.clone()), place.as_count()?, bounds.as_list()?);
        let machine = RefCell::new(self);
        let assemble = |near: Value| machine.borrow_mut().closure(code, assemble, [near], true);
        algorithms.limits(whole, &AroundPosition { place, position, bounds, search, assemble: &assemble })
    }
}
