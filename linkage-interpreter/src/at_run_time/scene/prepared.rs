//! A scene that is ready for simulations, and calls of its compiled functions.

use std::collections::BTreeMap;
use std::fmt;

use linkage_dynamics::MotionError;
use linkage_ir::Name;
use linkage_ir::code::Function;
use linkage_runtime::{Dim, Joint};

use super::{MOST_CONTACTS, MOST_JOINTS, SceneAtRunTime};
use crate::at_run_time::{NotPrepared, Prepared};
use crate::call_error::CallError;
use crate::error::Error;
use crate::machine::{Algorithms, Defect, Failure, Kind, Machine, Of, User, Value};
use crate::program::{Driver, Scene};

/// A scene with what its trait needs at hand. It borrows the design.
pub struct PreparedScene<'d> {
    pub(crate) mechanism: Prepared<'d>,
    pub(crate) scene: &'d Scene,
    own: Value,
    functions: BTreeMap<&'d str, &'d Function>,
    pub(crate) joints: Vec<Joint<&'d str>>,
    pub(crate) fields: Fields,
}

impl fmt::Debug for PreparedScene<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("PreparedScene").field(&self.scene.name).finish()
    }
}

/// The fields of arguments and results.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Fields {
    pub(crate) unknowns: Name,
    pub(crate) inputs: Name,
    pub(crate) mass: Name,
    pub(crate) ratios: Name,
    pub(crate) mixed: Name,
    pub(crate) unknown_forces: Name,
    pub(crate) input_forces: Name,
    pub(crate) components: Name,
    pub(crate) constant: Name,
    pub(crate) rows: Name,
    pub(crate) contacts: Name,
    pub(crate) applied: Name,
    pub(crate) dissipated: Name,
    pub(crate) kinetic: Name,
    pub(crate) potential: Name,
}

impl Fields {
    fn of(driver: &Driver) -> Self {
        // A name that no function has is that of no field.
        let of = |text| driver.names.find(text).unwrap_or(Name::NAME);
        Self {
            unknowns: of("unknowns"),
            inputs: of("inputs"),
            mass: of("mass"),
            ratios: of("ratios"),
            mixed: of("mixed"),
            unknown_forces: of("unknown_forces"),
            input_forces: of("input_forces"),
            components: of("components"),
            constant: of("constant"),
            rows: of("rows"),
            contacts: of("contacts"),
            applied: of("applied"),
            dissipated: of("dissipated"),
            kinetic: of("kinetic"),
            potential: of("potential"),
        }
    }
}

/// The forces in joints as names of a scene.
fn joint(of: &crate::program::Joint) -> Joint<&str> {
    let (name, on, place) = (of.name.as_str(), of.on.as_str(), of.place);
    match &of.at {
        Some(at) => Joint::Pin { name, at, on, place },
        None => Joint::Guide { name, on, place },
    }
}

impl<'d> PreparedScene<'d> {
    /// A scene with these user functions and values of parameters; its mechanism is a part of it.
    pub(crate) fn of(
        driver: &'d Driver,
        users: &'d [Option<User>],
        scene: &'d Scene,
        own: Value,
    ) -> Result<Self, NotPrepared> {
        let counts =
            [("frictions and stops", scene.contacts, MOST_CONTACTS), ("joints", scene.joints.len(), MOST_JOINTS)];
        if let Some((of, count, most)) = counts.into_iter().find(|(_, count, most)| count > most) {
            return Err(NotPrepared::TooLarge { of, count, most });
        }
        let Some(implementation) = &scene.implementation else {
            return Err(NotPrepared::NoInertia { scene: scene.name.to_string() });
        };
        let mechanism = own.field(scene.field).map_err(NotPrepared::Defect)?.clone();
        // Those of the trait come last and stand for functions of the same name of the type itself.
        let functions = scene.functions.iter().chain(&implementation.functions);
        Ok(Self {
            mechanism: Prepared::of(driver, users, mechanism)?,
            scene,
            own,
            functions: functions.map(|function| (function.name.as_str(), function)).collect(),
            joints: scene.joints.iter().map(joint).collect(),
            fields: Fields::of(driver),
        })
    }

    /// The scene with the number of the inputs of its mechanism as a type.
    ///
    /// # Errors
    /// [`NotPrepared::Inputs`] if it has another number.
    pub fn with_inputs<V: Dim>(&self) -> Result<SceneAtRunTime<'_, V>, NotPrepared> {
        Ok(SceneAtRunTime { prepared: self, mechanism: self.mechanism.with_inputs()? })
    }

    /// The first failure of a call that is no error of the scene or the mechanism, as of damaged code. Simulations find numbers
    /// that are none then.
    #[must_use]
    pub fn failure(&self) -> Option<CallError> {
        self.mechanism.failure()
    }

    fn called(
        &self,
        function: &str,
        arguments: impl IntoIterator<Item = Value>,
        algorithms: Option<&dyn Algorithms>,
    ) -> Result<Value, Box<Failure>> {
        let called = self.functions.get(function);
        let called = called.ok_or_else(|| Defect::new(format!("no function `{function}` of a scene")))?;
        let machine = Machine::new(self.mechanism.driver, Some(self.scene), self.mechanism.users, Kind::Double);
        let mut machine = match algorithms {
            Some(algorithms) => machine.with_algorithms(algorithms),
            None => machine,
        };
        let own = if called.is_method { self.own.clone() } else { Value::Absent };
        machine.call(Of::Scene, called, own, arguments)
    }

    /// True if there is a function of this name.
    pub(crate) fn has(&self, function: &str) -> bool {
        self.functions.contains_key(function)
    }

    /// Calls a function that cannot fail; nothing if it does.
    pub(crate) fn value(&self, function: &str, arguments: impl IntoIterator<Item = Value>) -> Value {
        self.called(function, arguments, None).unwrap_or_else(|failure| {
            self.mechanism.keep(failure);
            Value::Absent
        })
    }

    /// Calls a function that can fail.
    pub(crate) fn result(
        &self,
        function: &str,
        arguments: impl IntoIterator<Item = Value>,
    ) -> Result<Value, MotionError<&str>> {
        self.result_by(function, arguments, None)
    }

    /// Calls a function that can fail, and that may call algorithms.
    pub(crate) fn result_by(
        &self,
        function: &str,
        arguments: impl IntoIterator<Item = Value>,
        algorithms: Option<&dyn Algorithms>,
    ) -> Result<Value, MotionError<&str>> {
        self.called(function, arguments, algorithms).map_err(|failure| match CallError::from(failure) {
            CallError::Function(Error::Motion(error)) => {
                error.with_names(self.mechanism.inputs.as_slice(), |name| self.mechanism.name_of(&name))
            }
            other => self.mechanism.error_of(other).into(),
        })
    }
}
