//! A design that is ready for algorithms, and calls of its compiled functions.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::fmt;

use linkage_ir::Name;
use linkage_ir::code::Function;
use linkage_runtime::skeleton::{NoDrawing, Part};
use linkage_runtime::{Bounded, Dim, Group, PositionError};

use super::names::Texts;
use super::parameters::OfDesign;
use super::parts;
use super::{AtRunTime, Count, MOST, MOST_INPUTS, MOST_OF_POSE, NotPrepared};
use crate::call_error::CallError;
use crate::error::Error;
use crate::machine::{Defect, Failure, Kind, MOST_UNKNOWNS, Machine, Of, User, Value};
use crate::program::Driver;

/// A design with what its traits need at hand. It borrows the design.
pub struct Prepared<'d> {
    pub(crate) driver: &'d Driver,
    pub(crate) users: &'d [Option<User>],
    /// The mechanism with the parameters of the design.
    pub(crate) own: Value,
    functions: BTreeMap<&'d str, &'d Function>,
    texts: Texts<'d>,
    pub(crate) inputs: Vec<&'d str>,
    pub(crate) groups: Vec<Group<'d, &'d str>>,
    /// The parts of the drawing.
    pub(crate) drawing: Result<Vec<Part<'d>>, NoDrawing>,
    /// The form of a pose.
    pose: Value,
    pub(crate) fields: Fields,
    /// The first failure of a call that is no error of the mechanism: an algorithm sees numbers that are none.
    failed: RefCell<Option<CallError>>,
}

impl fmt::Debug for Prepared<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("Prepared").field(&self.driver.name).finish()
    }
}

/// The fields of results that hold several values.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Fields {
    pub(crate) rates: Name,
    pub(crate) accelerations: Name,
    pub(crate) points: Name,
    pub(crate) outputs: Name,
}

impl Fields {
    fn of(driver: &Driver) -> Self {
        // A name that no function has is that of no field.
        let of = |text| driver.names.find(text).unwrap_or(Name::NAME);
        Self { rates: of("rates"), accelerations: of("accelerations"), points: of("points"), outputs: of("outputs") }
    }
}

impl<'d> Prepared<'d> {
    /// A mechanism with these user functions and values of parameters.
    pub(crate) fn of(driver: &'d Driver, users: &'d [Option<User>], own: Value) -> Result<Self, NotPrepared> {
        let counts = [
            ("unknowns", driver.unknowns.len()),
            ("groups", driver.written.groups.len()),
            ("points", driver.points.len()),
            ("outputs", driver.outputs.len()),
        ];
        let inputs = ("inputs", driver.inputs.len(), MOST_INPUTS);
        let largest_group = driver.written.groups.iter().map(|group| group.unknowns.len()).max().unwrap_or_default();
        let counts = counts.map(|(of, count)| (of, count, MOST)).into_iter();
        let counts = counts.chain([inputs, ("unknowns in a group", largest_group, MOST_UNKNOWNS)]);
        if let Some((of, count, most)) = { counts }.find(|(_, count, most)| count > most) {
            return Err(NotPrepared::TooLarge { of, count, most });
        }
        let of_traits = driver.traits.iter().filter(|one| one.of != "Lanes").flat_map(|one| &one.functions);
        // Those of traits come last and stand for functions of the same name of the type itself.
        let functions = driver.functions.iter().chain(of_traits);
        let groups = driver.written.groups.iter();
        let mut prepared = Prepared {
            driver,
            users,
            own,
            functions: functions.map(|function| (function.name.as_str(), function)).collect(),
            texts: Texts::of(driver),
            inputs: driver.input_texts.iter().map(|name| &**name).collect(),
            groups: groups
                .map(|group| Group {
                    name: group.name.as_str(),
                    equations: &group.equations,
                    unknowns: &group.unknowns,
                })
                .collect(),
            drawing: parts::drawing(driver),
            pose: Value::Absent,
            fields: Fields::of(driver),
            failed: RefCell::new(None),
        };
        let anywhere = driver.coordinates.iter().map(|name| (*name, Value::Number(1.0)));
        let pose = prepared.called(&prepared.own, "pose_at", [Value::record(anywhere)]);
        prepared.pose = pose.map_err(|failure| match CallError::from(failure) {
            CallError::Mistake(mistake) => NotPrepared::Mistake(mistake),
            CallError::Defect(defect) => NotPrepared::Defect(defect),
            CallError::Function(error) => NotPrepared::Defect(Defect::new(error.to_string())),
        })?;
        let mut count = 0;
        prepared.pose.each_leaf(&mut |_| count += 1);
        match count <= MOST_OF_POSE {
            true => Ok(prepared),
            false => Err(NotPrepared::TooLarge { of: "numbers of a pose", count, most: MOST_OF_POSE }),
        }
    }

    /// The mechanism with the number of its inputs as a type: algorithms over motions of one input take `D<1>`.
    ///
    /// # Errors
    /// [`NotPrepared::Inputs`] if it has another number.
    pub fn with_inputs<V: Dim>(&self) -> Result<AtRunTime<'_, V>, NotPrepared> {
        let count = self.driver.inputs.len();
        let inputs = V::new(count).ok_or(NotPrepared::Inputs { count })?;
        Ok(AtRunTime { prepared: self, inputs, parameters: OfDesign })
    }

    /// The first failure of a call that is no error of the mechanism, as of damaged code. Algorithms find numbers that are none
    /// then.
    #[must_use]
    pub fn failure(&self) -> Option<CallError> {
        self.failed.borrow().clone()
    }

    /// True if there is a function of this name.
    pub(crate) fn has(&self, function: &str) -> bool {
        self.functions.contains_key(function)
    }

    /// Calls a function of a mechanism with values of its parameters.
    pub(crate) fn called(
        &self,
        own: &Value,
        function: &str,
        arguments: impl IntoIterator<Item = Value>,
    ) -> Result<Value, Box<Failure>> {
        let called = self.functions.get(function);
        let called = called.ok_or_else(|| Defect::new(format!("no function `{function}`")))?;
        let mut machine = Machine::new(self.driver, None, self.users, Kind::Double);
        let own = if called.is_method { own.clone() } else { Value::Absent };
        machine.call(Of::Driver, called, own, arguments)
    }

    /// Keeps a failure that is no error of the mechanism.
    pub(crate) fn keep(&self, failure: impl Into<CallError>) {
        self.failed.borrow_mut().get_or_insert(failure.into());
    }

    /// Calls a function that cannot fail; nothing if it does.
    pub(crate) fn value(&self, function: &str, arguments: impl IntoIterator<Item = Value>) -> Value {
        self.or_nothing(self.called(&self.own, function, arguments))
    }

    /// The value of a call that cannot fail; nothing if it did.
    pub(crate) fn or_nothing(&self, called: Result<Value, Box<Failure>>) -> Value {
        called.unwrap_or_else(|failure| {
            self.keep(failure);
            Value::Absent
        })
    }

    /// The error of a call with borrowed names.
    pub(crate) fn error(&self, failure: Box<Failure>) -> PositionError<&str> {
        self.error_of(CallError::from(failure))
    }

    /// The error of a call with borrowed names. A failure that is no error of the mechanism is kept, and numbers are none.
    pub(crate) fn error_of(&self, error: CallError) -> PositionError<&str> {
        match error {
            CallError::Function(Error::Position(error)) => {
                error.with_names(self.inputs.as_slice(), |name| self.name_of(&name))
            }
            other => {
                self.keep(other);
                PositionError::NotFinite { mechanism: &self.driver.name, quantity: "the position" }
            }
        }
    }

    /// A name of an error, borrowed.
    pub(crate) fn name_of(&self, name: &str) -> &'d str {
        self.texts.find(name)
    }

    /// The value of a pose with these numbers.
    pub(crate) fn pose(&self, numbers: &Bounded<f64, MOST_OF_POSE>) -> Value {
        let mut numbers = numbers.as_ref().iter();
        self.pose.map_leaves(&mut |_| numbers.next().map_or(Value::Absent, |number| Value::Number(*number)))
    }

    /// True if a guess chooses the turns of angles: emitted code then has a function of the trait for it.
    pub(crate) fn counts_turns(&self) -> bool {
        let of_assembly = self.driver.traits.iter().filter(|one| one.of == "Assembly").flat_map(|one| &one.functions);
        of_assembly.into_iter().any(|function| function.name == "assemble_near")
    }

    /// The number of unknowns, and of groups.
    pub(crate) fn counts(&self) -> (Count, Count) {
        let of = |count| Count::new(count).unwrap_or_else(Count::least);
        (of(self.driver.unknowns.len()), of(self.groups.len()))
    }
}
