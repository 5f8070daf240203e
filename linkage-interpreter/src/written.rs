//! Compiled mechanisms as a file: a version, the mechanisms, and the checks of what is read.

use std::sync::Arc;

use linkage_ir::code::{Block, Code, Function, Pattern, Receiver, Statement, Type, Value};
use linkage_ir::{Intrinsic, Name, Slot, ValueId};
use serde::{Deserialize, Deserializer, Serialize, Serializer, de, ser};

use crate::Program;
use crate::formulas::Counts;
use crate::mechanism::Mechanism;
use crate::program::Driver;

/// The version of the form in which compiled mechanisms are written. It changes with the form.
const VERSION: u32 = 3;

/// The deepest nesting of the values of a function, and so of the calls that compute them. The gallery's is 11.
const DEEPEST: usize = 200;

/// The most entries of a list that repeats one value.
const MOST_REPEATED: usize = 1 << 12;

#[derive(Serialize)]
struct Written<'w> {
    version: u32,
    mechanisms: Vec<&'w Driver>,
}

#[derive(Deserialize)]
struct Version {
    version: u32,
    mechanisms: Vec<Driver>,
}

/// User functions are not written.
impl Serialize for Program {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mechanisms = self.mechanisms().iter().map(Mechanism::driver).collect();
        ser::Serialize::serialize(&Written { version: VERSION, mechanisms }, serializer)
    }
}

/// Mechanisms written by another version, and damaged ones, are errors.
impl<'de> Deserialize<'de> for Program {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let Version { version, mechanisms } = Version::deserialize(deserializer)?;
        if version != VERSION {
            return Err(de::Error::custom(format_args!(
                "these mechanisms were compiled by version {version} of the form, this library reads version {VERSION}: \
                 compile them again"
            )));
        }
        for driver in &mechanisms {
            checked(driver).map_err(|what| {
                de::Error::custom(format_args!("the compiled mechanism `{}` is damaged: {what}", driver.name))
            })?;
        }
        Ok(Self::of(mechanisms.into_iter().map(|driver| Mechanism::new(Arc::new(driver))).collect()))
    }
}

/// Checks that everything that functions refer to exists. Calls that do not end are found when they run: a function of a
/// mechanism may call itself in twice the precision.
pub(crate) fn checked(driver: &Driver) -> Result<(), &'static str> {
    let of_traits = driver.traits.iter().flat_map(|one| &one.functions);
    let of_driver = driver.functions.iter().chain(of_traits);
    of_driver.clone().try_for_each(|function| check(function, driver, &driver.functions))?;
    for own in [&driver.of_pose, &driver.of_branch] {
        own.iter().try_for_each(|function| check(function, driver, own))?;
    }
    for scene in &driver.scenes {
        let of_trait = scene.implementation.iter().flat_map(|one| &one.functions);
        scene.functions.iter().chain(of_trait).try_for_each(|function| check(function, driver, &scene.functions))?;
    }
    if driver.parameters.len() != driver.about_parameters.len()
        || driver.coordinates.len() != driver.about_coordinates.len()
        || driver.inputs.len() != driver.input_texts.len()
        || driver.inputs.len() != driver.input_angles.len()
        || driver.unknowns.len() != driver.written.unknowns.len()
        || driver.unknowns.len() != driver.written.unknown_angles.len()
        || driver.points.len() != driver.written.points.len()
        || driver.outputs.len() != driver.written.outputs.len()
        || driver.scenes.iter().any(|scene| scene.parameters.len() != scene.about_parameters.len())
    {
        return Err("names are missing");
    }
    let is_unknown = |place: &usize| *place < driver.unknowns.len();
    if !driver.written.groups.iter().flat_map(|group| group.equations.iter().chain(&group.unknowns)).all(is_unknown) {
        return Err("an unknown of a group does not exist");
    }
    let drawing = driver.written.drawing.iter();
    let joints = drawing.flat_map(|drawing| drawing.parts.iter().map(|part| (drawing.joints.len(), part)));
    if !{ joints }.all(|(count, part)| part.joints().iter().all(|joint| *joint < count)) {
        return Err("a joint of a part does not exist");
    }
    let counts = Counts {
        parameters: driver.parameters.len(),
        unknowns: driver.unknowns.len(),
        inputs: driver.inputs.len(),
        groups: driver.written.groups.len(),
        quantities: 2 * driver.points.len() + driver.outputs.len(),
        ranges: driver.written.ranges.len(),
    };
    driver.formulas.as_ref().map_or(Ok(()), |formulas| formulas.check(counts))
}

/// Checks a function, which calls these functions of its own type.
fn check(function: &Function, driver: &Driver, own: &[Function]) -> Result<(), &'static str> {
    let has_names = |names: &[(Name, ValueId)]| names.iter().all(|(name, _)| driver.names.has(*name));
    let Some(code) = &function.body else { return Err("a function has no body") };
    if (code.slots as usize) < function.arguments.len() + 1 {
        return Err("an argument has no slot");
    }
    for (place, value) in code.values.iter().enumerate() {
        let mut is_earlier = true;
        each_part(value, &mut |part| is_earlier &= part.index() < place);
        if !is_earlier {
            return Err("a value refers to a later one");
        }
        match value {
            Value::Given(of) => slot(code, *of)?,
            Value::Own(receiver, of, _) => {
                let is_own = matches!(receiver, Receiver::Itself | Receiver::ItsType);
                if of.index() >= if is_own { own.len() } else { driver.functions.len() } {
                    return Err("a function does not exist");
                }
            }
            Value::UserFunction(of, _) if of.index() >= driver.users.len() => {
                return Err("a user function does not exist");
            }
            Value::Field(_, name) if !driver.names.has(*name) => return Err("a name does not exist"),
            Value::Struct(_, fields, _) if !has_names(fields) => return Err("a name does not exist"),
            Value::Repeated(_, count) if *count > MOST_REPEATED => return Err("a list is too long"),
            Value::Intrinsic(Intrinsic::Zeros, Some(of), _) => match &**of {
                Type::Runtime(_, sizes) if sizes.iter().all(|size| *size <= MOST_REPEATED) => {}
                _ => return Err("a list is too long"),
            },
            Value::Closure { arguments, body, .. } => {
                arguments.iter().try_for_each(|pattern| pattern_of(code, pattern))?;
                block_of(code, body)?;
            }
            Value::Block(block) => block_of(code, block)?,
            _ => {}
        }
    }
    if depth(code) > DEEPEST {
        return Err("values are nested too deeply");
    }
    statements(code, &code.statements)?;
    [code.value.returned(), code.value.literal()].into_iter().try_for_each(|value| value_of(code, value))
}

fn block_of(code: &Code, block: &Block) -> Result<(), &'static str> {
    statements(code, &block.statements)?;
    value_of(code, block.value)
}

fn statements(code: &Code, all: &[Statement]) -> Result<(), &'static str> {
    all.iter().try_for_each(|statement| {
        if let Some(pattern) = statement.pattern() {
            pattern_of(code, pattern)?;
        }
        match statement {
            Statement::Store(inside) => statements(code, std::slice::from_ref(inside)),
            Statement::Unless(conditions, inside) => {
                conditions.iter().try_for_each(|id| value_of(code, *id))?;
                statements(code, inside)
            }
            Statement::Let(_, value) | Statement::Do(value) | Statement::Return(value) => value_of(code, *value),
            Statement::Assign(one, other) | Statement::LetElse(_, one, other) => {
                [one, other].into_iter().try_for_each(|id| value_of(code, *id))
            }
        }
    })
}

fn pattern_of(code: &Code, pattern: &Pattern) -> Result<(), &'static str> {
    let mut checked = Ok(());
    pattern.each(&mut |of| checked = checked.and_then(|()| slot(code, *of)));
    checked
}

fn slot(code: &Code, slot: Slot) -> Result<(), &'static str> {
    if slot.index() < code.slots as usize { Ok(()) } else { Err("a slot does not exist") }
}

fn value_of(code: &Code, id: ValueId) -> Result<(), &'static str> {
    if id.index() < code.values.len() { Ok(()) } else { Err("a value does not exist") }
}

/// The deepest nesting of the values of a function, which refer to earlier ones only.
fn depth(code: &Code) -> usize {
    let mut depths: Vec<usize> = Vec::with_capacity(code.values.len());
    for value in &code.values {
        let mut inside = 0;
        each_part(value, &mut |part| inside = inside.max(depths[part.index()]));
        depths.push(inside + 1);
    }
    depths.into_iter().max().unwrap_or(0)
}

/// Visits the values that one refers to, also within statements.
fn each_part(value: &Value, visit: &mut dyn FnMut(ValueId)) {
    match value {
        Value::Closure { body, .. } | Value::Block(body) => body.each_value(visit),
        other => other.each_part(visit),
    }
}
