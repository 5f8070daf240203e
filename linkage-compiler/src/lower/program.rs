//! Lowering of all functions of a planned program.

use std::collections::BTreeSet;

use super::code::Code;
use super::function::{Context, Dangling, FunctionIds, Lowered, function};
use super::rounding::Roundings;
use super::works::Works;
use crate::derivation::Derivation;
use crate::ids::{FunctionId, Table};
use crate::program::{Access, AnyNumber, Arguments, Body, Derived, Function, Functions, Program, SceneProgram};

/// Lowers all functions of a driver and of its scenes.
///
/// # Errors
/// If a function refers to something that does not exist: a mistake of the compiler.
pub fn program<'a>(
    planned: Program<'a, Body, Derived>,
    derivation: &Derivation,
) -> Result<Program<'a, Code>, Dangling> {
    let Program { signatures, position, functions, implementations, columns, scenes, any_number, derived } = planned;
    let of_driver = ids(&functions);
    let reserved = signatures.arguments.reserved();
    let of = Names { reserved: &reserved, arguments: &signatures.arguments, own: &of_driver, of_driver: &of_driver };
    let of = context(derivation, &derived, of);
    let mut lowered = Lowered { works: Works::default(), roundings: Roundings::new(&derived.pose) };
    let functions = all(functions, &of, &mut lowered)?;
    let order = ordered(without_branches(&functions), &functions, &signatures.all(&position));
    let functions = Functions::listed(functions, order);
    let works = lowered.works.renamed(|name| signatures.types.function(name));
    let implementations = implementations.into_iter().map(|one| one.without_choice(|name| functions.has(name)));
    let implementations = implementations.map(|one| one.try_map(|planned| function(planned, &of, &mut lowered)));
    let implementations = implementations.collect::<Result<_, _>>()?;
    let any_number = any_number.map(|AnyNumber { functions, user_functions }| {
        let functions = functions.into_iter().map(|planned| function(planned, &of, &mut lowered));
        Ok(AnyNumber { functions: functions.collect::<Result<_, _>>()?, user_functions })
    });
    let any_number = any_number.transpose()?;
    let scenes = scenes.into_iter().map(|SceneProgram { signatures, functions, implementation }| {
        let mut reserved = signatures.arguments.reserved();
        reserved.insert(signatures.field.clone());
        let own = ids(&functions);
        let of = Names { reserved: &reserved, arguments: &signatures.arguments, own: &own, of_driver: &of_driver };
        let of = context(derivation, &derived, of);
        let mut lowered = Lowered { works: works.clone(), roundings: Roundings::new(&derived.pose) };
        let functions = all(functions, &of, &mut lowered)?;
        let order = ordered(functions.ids().collect(), &functions, &signatures.all());
        let functions = Functions::listed(functions, order);
        let implementation = implementation.map(|one| one.try_map(|planned| function(planned, &of, &mut lowered)));
        Ok(SceneProgram { signatures, functions, implementation: implementation.transpose()? })
    });
    let scenes = scenes.collect::<Result<_, _>>()?;
    let derived = Some(derived);
    Ok(Program { signatures, position, functions, implementations, columns, scenes, any_number, derived })
}

/// The functions by name.
fn ids(functions: &Functions<Body>) -> FunctionIds {
    functions.by_id().enumerated().map(|(id, function)| (function.name.clone(), id)).collect()
}

fn all(
    functions: Functions<Body>,
    of: &Context,
    lowered: &mut Lowered,
) -> Result<Table<FunctionId, Function<Code>>, Dangling> {
    functions.into_table().into_iter().map(|planned| function(planned, of, lowered)).collect()
}

/// All functions but those for a lane that have branches, and those for a lane after them: lanes are then computed one by
/// one.
fn without_branches(functions: &Table<FunctionId, Function<Code>>) -> Vec<FunctionId> {
    let is_in_lane = |function: &Function<Code>| function.access == Access::Lane;
    let has_branches = |function: &Function<Code>| {
        is_in_lane(function) && function.body.as_ref().is_some_and(|code| !code.is_branch_free)
    };
    let end = functions.iter().position(has_branches).unwrap_or(functions.len());
    let kept =
        functions.enumerated().enumerate().filter(|(place, (_, function))| *place < end || !is_in_lane(function));
    kept.map(|(_, (id, _))| id).collect()
}

/// Sorts functions from the order of planning (callees first) to the order of their signatures; private ones come last.
fn ordered(
    mut ids: Vec<FunctionId>,
    functions: &Table<FunctionId, Function<Code>>,
    order: &[Function<Body>],
) -> Vec<FunctionId> {
    let place = |id: &FunctionId| order.iter().position(|other| other.name == functions[*id].name);
    ids.sort_by_key(|id| place(id).unwrap_or(order.len()));
    ids
}

/// The names that the functions of a type have in common.
struct Names<'c> {
    reserved: &'c BTreeSet<String>,
    arguments: &'c Arguments,
    own: &'c FunctionIds,
    of_driver: &'c FunctionIds,
}

fn context<'c>(derivation: &'c Derivation, derived: &'c Derived, names: Names<'c>) -> Context<'c> {
    let Names { reserved, arguments, own, of_driver } = names;
    Context {
        derivation,
        pose: &derived.pose,
        named: &derived.named,
        reserved,
        pose_argument: &arguments.pose,
        branch: &arguments.branch,
        turn: &arguments.turn,
        memory: &arguments.memory,
        own,
        of_driver,
    }
}
