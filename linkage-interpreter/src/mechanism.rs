//! Mechanisms, their designs and their scenes.

use std::sync::Arc;

use linkage_ir::Name;
use linkage_ir::code::Function;

use crate::at_run_time::{NotPrepared, OfTheRuntime, Prepared, PreparedScene};
use crate::call_error::CallError;
use crate::convert::{to_data, to_value};
use crate::data::Data;
use crate::error::Mistake;
use crate::machine::{Defect, Kind, Machine, Of, User, Value};
use crate::program::{Driver, Scene, UserFunction};
use crate::shape::Argument;

/// A mechanism, or one choice of inputs of a mechanism with several.
#[derive(Clone)]
pub struct Mechanism {
    driver: Arc<Driver>,
    /// The user functions that are given, by their places.
    users: Vec<Option<User>>,
}

impl std::fmt::Debug for Mechanism {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_tuple("Mechanism").field(&self.driver.name).finish()
    }
}

impl Driver {
    /// True if this is the name of a field.
    pub(crate) fn is(&self, name: Name, text: &str) -> bool {
        self.names.text(name) == text
    }
}

impl Mechanism {
    pub(crate) fn new(driver: Arc<Driver>) -> Self {
        let users = vec![None; driver.users.len()];
        Self { driver, users }
    }

    pub(crate) fn driver(&self) -> &Driver {
        &self.driver
    }

    /// Gives a function that is declared by `extern fn`, by the name of its value: the value and its derivatives at these
    /// arguments, in the order of their names.
    ///
    /// # Errors
    /// If there is no such function.
    pub fn with_function(
        mut self,
        name: &str,
        function: impl Fn(&[f64]) -> Vec<f64> + Send + Sync + 'static,
    ) -> Result<Self, Mistake> {
        let value = |of: &UserFunction| of.names.first().cloned().unwrap_or_default();
        let place = self.driver.users.iter().position(|of| value(of) == name);
        let all: Vec<String> = self.driver.users.iter().map(value).collect();
        let place = place.ok_or_else(|| Mistake::unknown(name, all.iter().map(String::as_str)))?;
        self.users[place] = Some(Arc::new(function));
        Ok(self)
    }

    /// Says that a user function is not given.
    fn complete(&self) -> Result<(), Mistake> {
        let missing = self.driver.users.iter().zip(&self.users).find(|(_, given)| given.is_none());
        missing.map_or(Ok(()), |(of, _)| {
            let name = of.names.first().map_or("", String::as_str);
            Err(Mistake::new(format!("`{name}` is declared by `extern fn` and not given: use `with_function`")))
        })
    }

    /// The name.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.driver.name
    }

    /// The names of the parameters.
    pub fn parameters(&self) -> impl Iterator<Item = &str> {
        self.driver.about_parameters.iter().map(|parameter| parameter.text.as_str())
    }

    /// The mechanism that it is a choice of inputs of, or itself.
    #[must_use]
    pub fn of(&self) -> &str {
        &self.driver.mechanism
    }

    /// The names of the inputs.
    pub fn inputs(&self) -> impl Iterator<Item = &str> {
        self.driver.input_texts.iter().map(|name| &**name)
    }

    /// The names of all coordinates, in the order of the fields, and whether each is an angle.
    pub fn coordinates(&self) -> impl Iterator<Item = (&str, bool)> {
        self.driver.about_coordinates.iter().map(|one| (one.text.as_str(), one.is_angle))
    }

    /// The fields of the points.
    pub fn points(&self) -> impl Iterator<Item = &str> {
        self.driver.points.iter().map(|name| self.driver.names.text(*name))
    }

    /// The fields of the outputs.
    pub fn outputs(&self) -> impl Iterator<Item = &str> {
        self.driver.outputs.iter().map(|name| self.driver.names.text(*name))
    }

    /// The names of the scenes.
    pub fn scenes(&self) -> impl Iterator<Item = &str> {
        self.driver.scenes.iter().map(|scene| &*scene.name)
    }

    /// The fields of the branch: of each group with two solutions these, of each group with a list of positions, and of turns.
    pub fn branch_fields(&self) -> [Vec<(&str, Vec<&str>)>; 3] {
        let text = |name| self.driver.names.text(name);
        [
            self.driver
                .sides
                .iter()
                .map(|side| (text(side.field), side.solutions.iter().map(|solution| &**solution).collect()))
                .collect(),
            self.driver.modes.iter().map(|(field, _)| (text(*field), Vec::new())).collect(),
            self.driver.turns.iter().map(|field| (text(*field), Vec::new())).collect(),
        ]
    }

    /// The numbers of coordinates and of inputs.
    #[must_use]
    pub fn sizes(&self) -> [usize; 2] {
        [self.driver.coordinates.len(), self.driver.inputs.len()]
    }

    /// The names of the public functions.
    pub fn functions(&self) -> impl Iterator<Item = &str> {
        let public = self.driver.functions.iter().filter(|function| function.access.is_public());
        public.map(|function| function.name.as_str())
    }

    /// The design with the default values of the parameters, and NaN where there is none.
    #[must_use]
    pub fn design(&self) -> Design {
        let values = self.driver.about_parameters.iter().map(|parameter| parameter.default.unwrap_or(f64::NAN));
        Design { of: self.clone(), parameters: values.collect() }
    }
}

/// A mechanism with values of its parameters.
#[derive(Debug, Clone)]
pub struct Design {
    of: Mechanism,
    parameters: Vec<f64>,
}

impl Design {
    /// The mechanism.
    #[must_use]
    pub fn mechanism(&self) -> &Mechanism {
        &self.of
    }

    /// The values of the parameters, in the order of declaration.
    #[must_use]
    pub fn with_parameters(mut self, parameters: &[f64]) -> Self {
        self.parameters.iter_mut().zip(parameters).for_each(|(to, value)| *to = *value);
        self
    }

    /// The design with another value of a parameter.
    ///
    /// # Errors
    /// If there is no such parameter.
    pub fn with(mut self, parameter: &str, value: f64) -> Result<Self, Mistake> {
        let about = &self.of.driver.about_parameters;
        let place = about.iter().position(|one| one.text == parameter);
        let place = place.ok_or_else(|| Mistake::unknown(parameter, about.iter().map(|one| one.text.as_str())))?;
        self.parameters[place] = value;
        Ok(self)
    }

    /// The parameters by name, as a value that `serde` writes.
    #[must_use]
    pub fn by_name(&self) -> Data {
        Data::fields(self.of.parameters().zip(self.parameters.iter().copied().map(Data::Number)))
    }

    /// The design with these values of parameters by name; others stay.
    ///
    /// # Errors
    /// If there is no such parameter, or a value is no number.
    pub fn with_all(self, parameters: &Data) -> Result<Self, Mistake> {
        let Data::Fields(fields) = parameters else { return Err(Mistake::expected("numbers by name", parameters)) };
        fields.iter().try_fold(self, |design, (name, value)| {
            design.with(name, value.number().ok_or_else(|| Mistake::expected("a number", value))?)
        })
    }

    /// Makes the design ready for the algorithms of the runtime.
    ///
    /// ```
    /// use linkage_interpreter::Program;
    /// use linkage_runtime::continuation::{Direction, Path};
    /// use linkage_runtime::{Branches, D};
    ///
    /// # fn main() -> Result<(), Box<dyn std::error::Error>> {
    /// let text = "
    ///     mechanism FourBar {
    ///         param l1 = 80, l2 = 20, l3 = 50, l4 = 70;
    ///         input theta2;
    ///         unknown theta3, theta4;
    ///         loop l2@theta2 + l3@theta3 + l4@theta4 = l1@0;
    ///     }
    /// ";
    /// let program = Program::compile(text).map_err(|messages| messages[0].clone())?;
    /// let design = program.mechanism("FourBar")?.design();
    /// let prepared = design.prepared()?;
    /// let four_bar = prepared.with_inputs::<D<1>>()?;
    /// let (_, start) = four_bar.all_positions([1.0].into()).map_err(|error| error.to_string())?.next().unwrap();
    /// let mut path = Path::new(&four_bar, &start, Direction::Increasing).map_err(|error| error.to_string())?;
    /// let end = path.advance_to(7.0).map_err(|error| error.to_string())?;
    /// assert_eq!(end.position.inputs[0], 7.0);
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// # Errors
    /// [`NotPrepared`].
    pub fn prepared(&self) -> Result<Prepared<'_>, NotPrepared> {
        let (driver, users) = self.parts()?;
        Prepared::of(driver, users, self.own())
    }

    /// The mechanism, and its user functions.
    pub(crate) fn parts(&self) -> Result<(&Driver, &[Option<User>]), Mistake> {
        self.of.complete()?;
        Ok((&self.of.driver, &self.of.users))
    }

    fn own(&self) -> Value {
        let values = self.parameters.iter().copied().map(Value::Number);
        Value::record(self.of.driver.parameters.iter().copied().zip(values))
    }

    /// The arguments of a function.
    ///
    /// # Errors
    /// If there is no such function.
    pub fn arguments(&self, function: &str) -> Result<Vec<Argument>, Mistake> {
        let driver = &self.of.driver;
        named(&driver.functions, function).map(|function| driver.arguments(function, &driver.name))
    }

    /// A scene with the default values of its parameters, and NaN where there is none.
    ///
    /// # Errors
    /// If there is no such scene.
    pub fn scene(&self, name: &str) -> Result<SceneDesign, Mistake> {
        let scenes = &self.of.driver.scenes;
        let place = scenes.iter().position(|scene| *scene.name == *name);
        let place = place.ok_or_else(|| Mistake::unknown(name, scenes.iter().map(|scene| &*scene.name)))?;
        let about = &self.of.driver.scenes[place].about_parameters;
        let parameters = about.iter().map(|parameter| parameter.default.unwrap_or(f64::NAN)).collect();
        Ok(SceneDesign { of: self.clone(), place, parameters })
    }

    /// The values of the parameters.
    #[must_use]
    pub fn parameters(&self) -> &[f64] {
        &self.parameters
    }

    /// Calls a function.
    ///
    /// # Errors
    /// [`CallError::Mistake`] if there is no such function or an argument is not of its form, otherwise those of the function.
    pub fn call(&self, function: &str, arguments: &[Data]) -> Result<Data, CallError> {
        let driver = &self.of.driver;
        let function = named(&driver.functions, function)?;
        self.of.complete()?;
        let mut machine = Machine::new(driver, None, &self.of.users, Kind::Double).with_algorithms(&OfTheRuntime);
        let arguments = given(driver, function, &driver.name, arguments)?;
        let own = if function.is_method { self.own() } else { Value::Absent };
        let value = machine.call(Of::Driver, function, own, arguments)?;
        Ok(to_data(driver, &value))
    }

    /// The coordinates by name of a pose that a function has returned. An angle that the pose has as a direction alone is
    /// between -pi and pi: its turns change nothing. All others are as the equations have them, with their turns.
    ///
    /// # Errors
    /// [`CallError`] if this is no pose of the mechanism.
    pub fn coordinates(&self, pose: &Data) -> Result<Data, CallError> {
        let driver = &self.of.driver;
        let mut of_traits = driver.traits.iter().flat_map(|one| &one.functions);
        let function = of_traits.find(|function| function.name == "coordinates_of");
        let function = function.ok_or_else(|| CallError::Defect(Defect::new("no function `coordinates_of`")))?;
        let mut machine = Machine::new(driver, None, &self.of.users, Kind::Double);
        let arguments = given(driver, function, &driver.name, std::slice::from_ref(pose))?;
        let value = machine.call(Of::Driver, function, Value::Absent, arguments)?;
        Ok(to_data(driver, &value))
    }
}

fn named<'f>(all: &'f [Function], name: &str) -> Result<&'f Function, Mistake> {
    let public = || all.iter().filter(|function| function.access.is_public());
    let found = public().find(|function| function.name == name);
    found.ok_or_else(|| Mistake::unknown(name, public().map(|function| function.name.as_str())))
}

fn given(driver: &Driver, function: &Function, itself: &str, arguments: &[Data]) -> Result<Vec<Value>, Mistake> {
    if arguments.len() != function.arguments.len() {
        let names: Vec<&str> = function.arguments.iter().map(|argument| argument.name.as_str()).collect();
        return Err(Mistake::new(format!("`{}` takes {}", function.name, names.join(", "))));
    }
    function.arguments.iter().zip(arguments).map(|(of, data)| to_value(driver, data, &of.passed, itself)).collect()
}

/// A scene with values of its parameters, of a design.
#[derive(Debug, Clone)]
pub struct SceneDesign {
    of: Design,
    place: usize,
    parameters: Vec<f64>,
}

impl SceneDesign {
    /// The name.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.scene().name
    }

    fn scene(&self) -> &Scene {
        &self.of.of.driver.scenes[self.place]
    }

    /// The values of the parameters that its mechanism does not have, in the order of declaration; NaN for one without a default.
    #[must_use]
    pub fn parameters(&self) -> &[f64] {
        &self.parameters
    }

    /// The scene with these values of its own parameters, in the order of declaration.
    #[must_use]
    pub fn with_parameters(mut self, parameters: &[f64]) -> Self {
        self.parameters.iter_mut().zip(parameters).for_each(|(to, value)| *to = *value);
        self
    }

    /// The scene with another value of a parameter of its own.
    ///
    /// # Errors
    /// If there is no such parameter.
    pub fn with(mut self, parameter: &str, value: f64) -> Result<Self, Mistake> {
        let about = &self.scene().about_parameters;
        let place = about.iter().position(|one| one.text == parameter);
        let place = place.ok_or_else(|| Mistake::unknown(parameter, about.iter().map(|one| one.text.as_str())))?;
        self.parameters[place] = value;
        Ok(self)
    }

    /// Makes the scene ready for simulations.
    ///
    /// # Errors
    /// [`NotPrepared`].
    pub fn prepared(&self) -> Result<PreparedScene<'_>, NotPrepared> {
        let (driver, users) = self.of.parts()?;
        PreparedScene::of(driver, users, self.scene(), self.own())
    }

    /// The arguments of a function.
    ///
    /// # Errors
    /// If there is no such function.
    pub fn arguments(&self, function: &str) -> Result<Vec<Argument>, Mistake> {
        let scene = self.scene();
        named(&scene.functions, function).map(|function| self.of.of.driver.arguments(function, &scene.name))
    }

    fn own(&self) -> Value {
        let scene = self.scene();
        let values = self.parameters.iter().copied().map(Value::Number);
        let parameters = scene.parameters.iter().copied().zip(values);
        Value::record(std::iter::once((scene.field, self.of.own())).chain(parameters))
    }

    /// Calls a function.
    ///
    /// # Errors
    /// As [`Design::call`].
    pub fn call(&self, function: &str, arguments: &[Data]) -> Result<Data, CallError> {
        let (driver, scene) = (&self.of.of.driver, self.scene());
        let function = named(&scene.functions, function)?;
        self.of.of.complete()?;
        let mut machine =
            Machine::new(driver, Some(scene), &self.of.of.users, Kind::Double).with_algorithms(&OfTheRuntime);
        let arguments = given(driver, function, &self.scene().name, arguments)?;
        let own = if function.is_method { self.own() } else { Value::Absent };
        let value = machine.call(Of::Scene, function, own, arguments)?;
        Ok(to_data(driver, &value))
    }
}
