//! Compiled mechanisms as a file: a version, the mechanisms, and the checks of what is read.

use std::sync::Arc;

use serde::{Deserialize, Deserializer, Serialize, Serializer, de, ser};

use crate::Program;
use crate::code::{Block, Expression, Function, Id, Pattern, Slot, Statement};
use crate::formulas::Counts;
use crate::mechanism::Mechanism;
use crate::program::Driver;

/// The version of the form in which compiled mechanisms are written. It changes with the form.
const VERSION: u32 = 3;

/// The deepest nesting of the expressions of a function, and so of the calls that compute them. The gallery's is 11.
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
    let scenes = driver.scenes.iter().flat_map(|scene| &scene.functions);
    let of_scenes = driver.scenes.iter().filter_map(|scene| scene.implementation.as_ref());
    let of_traits = driver.traits.iter().chain(of_scenes).flat_map(|one| &one.functions);
    let all = driver.functions.iter().chain(&driver.of_pose).chain(&driver.of_branch).chain(scenes);
    all.chain(of_traits).try_for_each(check)?;
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

/// Checks a function.
fn check(function: &Function) -> Result<(), &'static str> {
    if (function.slots as usize) < function.arguments.len() + 1 {
        return Err("an argument has no slot");
    }
    for (place, expression) in function.expressions.iter().enumerate() {
        let mut is_earlier = true;
        each_part(expression, &mut |part| is_earlier &= (part.0 as usize) < place);
        if !is_earlier {
            return Err("an expression refers to a later one");
        }
        match expression {
            Expression::Slot(of) => slot(function, *of)?,
            Expression::Repeated(_, count) if *count > MOST_REPEATED => return Err("a list is too long"),
            Expression::Closure(patterns, block) => {
                patterns.iter().try_for_each(|pattern| pattern_of(function, pattern))?;
                block_of(function, block)?;
            }
            Expression::Block(block) => block_of(function, block)?,
            _ => {}
        }
    }
    if depth(function) > DEEPEST {
        return Err("expressions are nested too deeply");
    }
    statements(function, &function.statements)?;
    let (crate::code::Returned::Plain(value) | crate::code::Returned::Outcome(value)) = function.value;
    expression_of(function, value)
}

fn block_of(function: &Function, block: &Block) -> Result<(), &'static str> {
    statements(function, &block.statements)?;
    expression_of(function, block.value)
}

fn statements(function: &Function, all: &[Statement]) -> Result<(), &'static str> {
    all.iter().try_for_each(|statement| match statement {
        Statement::Let(pattern, value) => {
            pattern_of(function, pattern)?;
            expression_of(function, *value)
        }
        Statement::Do(value) | Statement::Return(value) => expression_of(function, *value),
        Statement::Assign(place, value) => {
            slot(function, place.of)?;
            place.at.iter().chain([value]).try_for_each(|id| expression_of(function, *id))
        }
        Statement::LetElse(pattern, value, otherwise) => {
            pattern_of(function, pattern)?;
            [value, otherwise].into_iter().try_for_each(|id| expression_of(function, *id))
        }
        Statement::Unless(conditions, inside) => {
            conditions.iter().try_for_each(|id| expression_of(function, *id))?;
            statements(function, inside)
        }
    })
}

fn pattern_of(function: &Function, pattern: &Pattern) -> Result<(), &'static str> {
    match pattern {
        Pattern::Bound(of) => slot(function, *of),
        Pattern::Ignored => Ok(()),
        Pattern::Present(inside) => pattern_of(function, inside),
        Pattern::List(all) => all.iter().try_for_each(|pattern| pattern_of(function, pattern)),
        Pattern::Record(fields) => fields.iter().try_for_each(|(_, pattern)| pattern_of(function, pattern)),
    }
}

fn slot(function: &Function, slot: Slot) -> Result<(), &'static str> {
    if slot.0 < function.slots { Ok(()) } else { Err("a slot does not exist") }
}

fn expression_of(function: &Function, id: Id) -> Result<(), &'static str> {
    if (id.0 as usize) < function.expressions.len() { Ok(()) } else { Err("an expression does not exist") }
}

/// The deepest nesting of the expressions of a function, which refer to earlier ones only.
fn depth(function: &Function) -> usize {
    let mut depths: Vec<usize> = Vec::with_capacity(function.expressions.len());
    for expression in &function.expressions {
        let mut inside = 0;
        each_part(expression, &mut |part| inside = inside.max(depths[part.0 as usize]));
        depths.push(inside + 1);
    }
    depths.into_iter().max().unwrap_or(0)
}

/// Visits the expressions that one refers to.
fn each_part(expression: &Expression, visit: &mut dyn FnMut(Id)) {
    let mut all = |ids: &[Id]| ids.iter().copied().for_each(&mut *visit);
    match expression {
        Expression::Slot(_)
        | Expression::Number(_)
        | Expression::Flag(_)
        | Expression::Quantities
        | Expression::Text(_)
        | Expression::OwnName
        | Expression::Count(_)
        | Expression::Absent
        | Expression::OfRuntime(_) => {}
        Expression::Sum(terms) => terms.iter().for_each(|(_, term)| visit(*term)),
        Expression::Product(ids)
        | Expression::Call(_, ids)
        | Expression::All(ids)
        | Expression::List(ids)
        | Expression::Intrinsic(_, ids)
        | Expression::Own(_, ids)
        | Expression::OfType(_, _, ids)
        | Expression::User(_, ids) => all(ids),
        Expression::Quotient(one, other) | Expression::At(one, other) => all(&[*one, *other]),
        Expression::Square(one)
        | Expression::Negative(one)
        | Expression::Field(one, _)
        | Expression::Index(one, _)
        | Expression::Repeated(one, _)
        | Expression::Made(_, one)
        | Expression::Try(one) => all(&[*one]),
        Expression::Record(_, fields, rest) => {
            fields.iter().map(|(_, value)| *value).chain(*rest).for_each(visit);
        }
        Expression::OfMechanism(on, _, ids) => {
            all(ids);
            on.iter().copied().for_each(visit);
        }
        Expression::Closure(_, block) | Expression::Block(block) => each_of_block(block, visit),
    }
}

fn each_of_block(block: &Block, visit: &mut dyn FnMut(Id)) {
    block.statements.iter().for_each(|statement| each_of_statement(statement, visit));
    visit(block.value);
}

fn each_of_statement(statement: &Statement, visit: &mut dyn FnMut(Id)) {
    match statement {
        Statement::Let(_, value) | Statement::Do(value) | Statement::Return(value) => visit(*value),
        Statement::Assign(place, value) => place.at.iter().chain([value]).for_each(|id| visit(*id)),
        Statement::LetElse(_, value, otherwise) => [value, otherwise].into_iter().for_each(|id| visit(*id)),
        Statement::Unless(conditions, inside) => {
            conditions.iter().for_each(|id| visit(*id));
            inside.iter().for_each(|statement| each_of_statement(statement, visit));
        }
    }
}
