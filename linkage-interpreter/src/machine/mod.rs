//! The machine that runs compiled functions: expressions in the order of emitted code, functions of the runtime by
//! themselves.

mod algorithms;
mod arithmetic;
mod defect;
mod evaluate;
mod failure;
mod groups;
mod operations;
mod scalar;
mod turns;
mod value;

pub(crate) use algorithms::{Algorithms, AroundPosition, Load, Moving, Whole};
use linkage_ir::code::Function;

use crate::program::{Driver, Scene};
use crate::tape::Flag;

pub use defect::Defect;
pub(crate) use failure::{Evaluated, Failure};
pub(crate) use groups::MOST_UNKNOWNS;
pub(crate) use scalar::Scalar;
pub(crate) use value::Value;

/// The scalar of the function that runs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Kind {
    Double,
    Wide,
    /// A number of lanes that is recorded.
    Traced,
}

/// The type whose function runs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Of {
    Driver,
    Scene,
    Pose,
    Branch,
}

/// A function of the user: its value and its derivatives at these arguments.
pub(crate) type User = std::sync::Arc<dyn Fn(&[f64]) -> Vec<f64> + Send + Sync>;

/// The most calls within each other; mechanisms and scenes have less than 10.
const DEEPEST: usize = 24;

/// The most calls of functions of the program within one call: all branches are far fewer.
const MOST_CALLS: usize = 10_000_000;

/// A running call: the bound values of all functions in it.
pub(crate) struct Machine<'c> {
    pub(crate) driver: &'c Driver,
    pub(crate) scene: Option<&'c Scene>,
    pub(crate) users: &'c [Option<User>],
    /// True if angles, points and outputs of lanes are wanted.
    pub(crate) has_quantities: bool,
    /// The algorithms over a whole mechanism, for functions that callers name.
    algorithms: Option<&'c dyn Algorithms>,
    slots: Vec<Value>,
    /// The slots of the function that runs begin here.
    base: usize,
    kind: Kind,
    of: Of,
    /// True if the function that runs can fail.
    is_fallible: bool,
    /// The calls within each other, and all calls.
    depth: usize,
    calls: usize,
}

impl<'c> Machine<'c> {
    pub(crate) fn new(driver: &'c Driver, scene: Option<&'c Scene>, users: &'c [Option<User>], kind: Kind) -> Self {
        let of = if scene.is_some() { Of::Scene } else { Of::Driver };
        let (slots, has_quantities, algorithms) = (Vec::new(), false, None);
        Self {
            driver,
            scene,
            users,
            has_quantities,
            algorithms,
            slots,
            base: 0,
            kind,
            of,
            is_fallible: false,
            depth: 0,
            calls: 0,
        }
    }

    pub(crate) fn with_algorithms(mut self, algorithms: &'c dyn Algorithms) -> Self {
        self.algorithms = Some(algorithms);
        self
    }

    pub(crate) fn set_kind(&mut self, kind: Kind) {
        self.kind = kind;
    }

    /// The functions of the type whose function runs.
    fn own_functions(&self) -> &'c [Function] {
        match (self.of, self.scene) {
            (Of::Driver, _) | (Of::Scene, None) => &self.driver.functions,
            (Of::Scene, Some(scene)) => &scene.functions,
            (Of::Pose, _) => &self.driver.of_pose,
            (Of::Branch, _) => &self.driver.of_branch,
        }
    }

    /// Calls a function of a type: the value of its success, or its value.
    pub(crate) fn call(
        &mut self,
        of: Of,
        function: &'c Function,
        own: Value,
        arguments: impl IntoIterator<Item = Value>,
    ) -> Evaluated<Value> {
        self.call_and(of, function, own, arguments, |_| ())
    }

    /// Records a function over lanes: which of them are accepted, and the found columns.
    pub(crate) fn lanes(
        &mut self,
        function: &'c Function,
        own: Value,
        [given, branch]: [Value; 2],
        found: usize,
    ) -> Evaluated<(Flag, Vec<Value>)> {
        /// The slot of the argument that is written to.
        const FOUND: usize = 4;
        let nothing = Value::list(std::iter::repeat_n(Value::Absent, found));
        let mut columns = Value::Absent;
        // The lane is absent: all at once.
        let arguments = [given, branch, Value::Absent, nothing];
        let accepted = self.call_and(Of::Driver, function, own, arguments, |slots| {
            columns = slots.get_mut(FOUND).map(std::mem::take).unwrap_or_default();
        })?;
        let accepted = match accepted {
            Value::Flag(flag) => Flag::Constant(flag),
            Value::TracedFlag(flag) => flag,
            other => return Err(other.expected("a flag").into()),
        };
        Ok((accepted, columns.as_list()?.to_vec()))
    }

    fn call_and(
        &mut self,
        of: Of,
        function: &'c Function,
        own: Value,
        arguments: impl IntoIterator<Item = Value>,
        read: impl FnOnce(&mut [Value]),
    ) -> Evaluated<Value> {
        // Calls from outside are counted each for itself.
        self.calls = if self.depth == 0 { 1 } else { self.calls + 1 };
        if self.depth == DEEPEST || self.calls > MOST_CALLS {
            return Err(Defect::new(format!("calls of {} do not end", function.name)).into());
        }
        let code = function.body.as_ref().ok_or_else(|| Defect::new(format!("no body of {}", function.name)))?;
        self.depth += 1;
        let from = self.slots.len();
        let (base, last) = (std::mem::replace(&mut self.base, from), std::mem::replace(&mut self.of, of));
        let is_fallible = std::mem::replace(&mut self.is_fallible, function.is_fallible);
        self.slots.push(own);
        self.slots.extend(arguments);
        let end = from + code.slots as usize;
        let result = if self.slots.len() > end {
            Err(Defect::new(format!("too many arguments of {}", function.name)).into())
        } else {
            self.slots.resize(end, Value::Absent);
            self.body(code)
        };
        read(self.slots.get_mut(from..).unwrap_or_default());
        self.slots.truncate(from);
        (self.base, self.of, self.is_fallible) = (base, last, is_fallible);
        self.depth -= 1;
        match result {
            Ok(value) => Ok(value),
            Err(failure) => match *failure {
                Failure::Return(value) => Ok(value),
                // As the `?` of emitted code converts it.
                Failure::Error(error) if of == Of::Scene => Err(error.of_scene().into()),
                other => Err(Box::new(other)),
            },
        }
    }
}
