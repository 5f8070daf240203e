//! Lowering of all functions of a planned program.

use std::collections::BTreeSet;

use super::code::{Callee, Code};
use super::context::{Context, FunctionIds, Known};
use super::counts::Counts;
use super::function::{Dangling, Lowered, function};
use super::rounding::Roundings;
use crate::derivation::Derivation;
use crate::ids::{FunctionId, Id, Table};
use crate::program::{Access, AnyNumber, Arguments, Body, Derived, Function, Functions, Program, SceneProgram};

/// Lowers all functions of a driver and of its scenes.
///
/// # Errors
/// If a function refers to something that does not exist: a mistake of the compiler.
pub fn program(planned: Program<Body, Derived>, derivation: &Derivation) -> Result<Program<Code>, Dangling> {
    let Program { signatures, position, functions, implementations, columns, scenes, any_number, derived } = planned;
    let of_driver = ids(&functions);
    let reserved = signatures.arguments.reserved();
    let of = Names { reserved: &reserved, arguments: &signatures.arguments, own: &of_driver, of_driver: &of_driver };
    let of = context(derivation, &derived, of);
    let mut lowered = Lowered { counts: Counts::default(), roundings: Roundings::new(&derived.pose) };
    let functions = all(functions, &of, &[Callee::Own, Callee::OfDriver], &mut lowered)?;
    let counts = lowered.counts.of_driver();
    let mut alone = |planned| function(planned, &[], &of, &mut lowered);
    let implementations = implementations.into_iter().map(|one| one.try_map(&mut alone));
    let implementations = implementations.collect::<Result<Vec<_>, _>>()?;
    let any_number = any_number.map(|AnyNumber { functions, user_functions }| {
        Ok(AnyNumber { functions: functions.into_iter().map(alone).collect::<Result<_, _>>()?, user_functions })
    });
    let any_number = any_number.transpose()?;
    let scenes = scenes.into_iter().map(|SceneProgram { signatures, functions, implementation }| {
        let mut reserved = signatures.arguments.reserved();
        reserved.insert(signatures.field.clone());
        let own = ids(&functions);
        let of = Names { reserved: &reserved, arguments: &signatures.arguments, own: &own, of_driver: &of_driver };
        let of = context(derivation, &derived, of);
        let mut lowered = Lowered { counts: counts.clone(), roundings: Roundings::new(&derived.pose) };
        let functions = all(functions, &of, &[Callee::Own], &mut lowered)?;
        let order = ordered(functions.ids().collect(), &functions, &signatures.all());
        let functions = Functions::listed(functions, order);
        let implementation = implementation.map(|one| one.try_map(|planned| function(planned, &[], &of, &mut lowered)));
        Ok(SceneProgram { signatures, functions, implementation: implementation.transpose()? })
    });
    let scenes = scenes.collect::<Result<Vec<_>, _>>()?;
    let called = called(&functions, &scenes);
    let order = ordered(without_branches(called, &functions), &functions, &signatures.all(&position));
    let is_listed = |callee| !matches!(callee, Callee::Own(id) if !order.contains(&id));
    let calls_listed = |function: &Function<Code>| function.body.iter().flat_map(Code::calls).all(is_listed);
    let implementations = implementations.into_iter().map(|one| one.without_choice(calls_listed)).collect();
    let functions = Functions::listed(functions, order);
    let derived = Some(derived);
    Ok(Program { signatures, position, functions, implementations, columns, scenes, any_number, derived })
}

/// The functions of a driver that are called: from outside, by a scene, or by a later one of these.
fn called(functions: &Table<FunctionId, Function<Code>>, scenes: &[SceneProgram<Code>]) -> Vec<FunctionId> {
    let of = |function: &Function<Code>| {
        let calls = function.body.iter().flat_map(Code::calls);
        calls
            .filter_map(|callee| match callee {
                Callee::Own(id) | Callee::OfDriver(id) => Some((callee, id)),
                Callee::User(_) => None,
            })
            .collect::<Vec<_>>()
    };
    let by_scenes = scenes.iter().flat_map(|scene| scene.functions.iter().flat_map(of));
    let by_scenes = by_scenes.filter(|(callee, _)| matches!(callee, Callee::OfDriver(_)));
    let mut called: BTreeSet<FunctionId> = by_scenes.map(|(_, id)| id).collect();
    for (id, function) in functions.enumerated().collect::<Vec<_>>().into_iter().rev() {
        if function.access.is_called_from_outside() || called.contains(&id) {
            called.insert(id);
            called.extend(of(function).into_iter().map(|(_, id)| id));
        }
    }
    called.into_iter().collect()
}

/// The functions by name.
fn ids(functions: &Functions<Body>) -> FunctionIds {
    let known = |(id, function): (FunctionId, &Function<Body>)| {
        (function.name.clone(), Known { id, is_of_mechanism: function.access == Access::OfMechanism })
    };
    functions.by_id().enumerated().map(known).collect()
}

/// Lowers the functions of a type, which others call by these.
fn all(
    functions: Functions<Body>,
    of: &Context,
    callees: &[fn(FunctionId) -> Callee],
    lowered: &mut Lowered,
) -> Result<Table<FunctionId, Function<Code>>, Dangling> {
    let functions = functions.into_table();
    let ids = functions.ids();
    let one = |(id, planned)| {
        let callees: Vec<Callee> = callees.iter().map(|callee| callee(id)).collect();
        function(planned, &callees, of, lowered)
    };
    ids.zip(functions).map(one).collect()
}

/// These functions but those for a lane that have branches, and those for a lane after them: lanes are then computed one by
/// one.
fn without_branches(ids: Vec<FunctionId>, functions: &Table<FunctionId, Function<Code>>) -> Vec<FunctionId> {
    let is_in_lane = |function: &Function<Code>| function.access == Access::Lane;
    let has_branches = |function: &Function<Code>| {
        is_in_lane(function) && function.body.as_ref().is_some_and(|code| !code.is_branch_free)
    };
    let end = functions.iter().position(has_branches).unwrap_or(functions.len());
    ids.into_iter().filter(|id| id.index() < end || !is_in_lane(&functions[*id])).collect()
}

/// Sorts functions from the order of planning (callees first) to the order of their signatures; private ones come last.
fn ordered(
    mut ids: Vec<FunctionId>,
    functions: &Table<FunctionId, Function<Code>>,
    order: &[Function<Body>],
) -> Vec<FunctionId> {
    let index = |id: &FunctionId| order.iter().position(|other| other.name == functions[*id].name);
    ids.sort_by_key(|id| index(id).unwrap_or(order.len()));
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
