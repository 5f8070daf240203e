//! Lowering of all functions of a planned program.

use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

use linkage_ir::code::{Called, Callee, Code, Names as FieldNames};

use super::code::Draft;
use super::context::{Context, FunctionIds};
use super::counts::Counts;
use super::function::{Dangling, Lowered, function};
use super::resolve::{self, Places, places};
use super::rounding::{Bound, Roundings};
use crate::derivation::Derivation;
use crate::graph::ExternalId;
use crate::ids::{FunctionId, Table};
use crate::program::{
    Access, AnyNumber, Arguments, Body, Derived, Function, Functions, Program, SceneProgram, call_of,
};

/// The largest rounding errors that functions of a driver can have, by name, as far as they are known.
pub type Bounds = BTreeMap<String, Bound>;

/// Lowers all functions of a driver and of its scenes.
///
/// # Errors
/// If a function refers to something that does not exist: a mistake of the compiler.
pub fn program(planned: Program<Body, Derived>, derivation: &Derivation) -> Result<(Program<Code>, Bounds), Dangling> {
    let Program { signatures, position, functions, implementations, columns, scenes, any_number, derived, .. } =
        planned;
    let names = RefCell::default();
    let of_driver = ids(&functions);
    let reserved = signatures.arguments.reserved();
    let of = Names {
        reserved: &reserved,
        arguments: &signatures.arguments,
        own: &of_driver,
        of_driver: &of_driver,
        names: &names,
    };
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
        let of = Names {
            reserved: &reserved,
            arguments: &signatures.arguments,
            own: &own,
            of_driver: &of_driver,
            names: &names,
        };
        let of = context(derivation, &derived, of);
        let mut lowered = Lowered { counts: counts.clone(), roundings: Roundings::new(&derived.pose) };
        let functions: Functions<Draft> = all(functions, &of, &[Callee::Own], &mut lowered)?.into_iter().collect();
        let implementation = implementation.map(|one| one.try_map(|planned| function(planned, &[], &of, &mut lowered)));
        Ok(SceneProgram { signatures, functions, implementation: implementation.transpose()? })
    });
    let scenes = scenes.collect::<Result<Vec<_>, _>>()?;
    let called = called(&functions, &scenes);
    let order = ordered(without_branches(called, &functions), &functions, &signatures.all(&position));
    let is_listed = |callee| !matches!(callee, Callee::Own(id) if !order.contains(&id));
    let calls_listed = |function: &Function<Draft>| function.body.iter().flat_map(Draft::calls).all(is_listed);
    let implementations = implementations.into_iter().map(|one| one.without_choice(calls_listed));
    let bounds = order.iter().filter_map(|id| {
        let function = &functions[*id];
        Some((function.name.clone(), function.body.as_ref()?.bound.clone()?))
    });
    let bounds: Bounds = bounds.collect();

    let listed = places(&functions, &order);
    let users = signatures.user_functions.iter().enumerate();
    let users = users.map(|(place, of)| {
        let name = call_of(derivation.graph.external_names(of.id));
        (of.id, (ExternalId::new(place), Called { name, is_of_mechanism: false }))
    });
    let users: Rc<BTreeMap<_, _>> = Rc::new(users.collect());
    let own = Places { own: listed.clone(), of_driver: listed.clone(), users: users.clone() };
    let finished = |of: Function<Draft>| resolved(of, &own);
    let scenes = scenes.into_iter().map(|SceneProgram { signatures, functions, implementation }| {
        let functions = functions.into_table();
        let order = ordered(functions.ids().collect(), &functions, &signatures.all());
        let of_scene = Places { own: places(&functions, &order), of_driver: listed.clone(), users: users.clone() };
        let finished = |of: Function<Draft>| resolved(of, &of_scene);
        let functions = in_order(functions, &order).map(finished).collect::<Result<_, _>>()?;
        let implementation = implementation.map(|one| one.try_map(finished)).transpose()?;
        Ok(SceneProgram { signatures, functions, implementation })
    });
    let any_number = any_number.map(|AnyNumber { functions, user_functions }| {
        Ok(AnyNumber { functions: functions.into_iter().map(finished).collect::<Result<_, _>>()?, user_functions })
    });
    let program = Program {
        functions: in_order(functions, &order).map(finished).collect::<Result<_, _>>()?,
        implementations: implementations.map(|one| one.try_map(finished)).collect::<Result<_, _>>()?,
        scenes: scenes.collect::<Result<_, _>>()?,
        any_number: any_number.transpose()?,
        derived: Some(derived),
        names: names.into_inner(),
        signatures,
        position,
        columns,
    };
    Ok((program, bounds))
}

/// The function in its finished form.
fn resolved(of: Function<Draft>, places: &Places) -> Result<Function<Code>, Dangling> {
    let function = of.name.clone();
    resolve::function(of, places).map_err(|what| Dangling { function, what })
}

/// The functions with these ids, in this order.
fn in_order(
    functions: Table<FunctionId, Function<Draft>>,
    order: &[FunctionId],
) -> impl Iterator<Item = Function<Draft>> + use<> {
    let ids = functions.ids();
    let mut all: BTreeMap<FunctionId, Function<Draft>> = ids.zip(functions).collect();
    let listed: Vec<_> = order.iter().filter_map(|id| all.remove(id)).collect();
    listed.into_iter()
}

/// The functions of a driver that are called: from outside, by a scene, or by a later one of these.
fn called(functions: &Table<FunctionId, Function<Draft>>, scenes: &[SceneProgram<Draft>]) -> Vec<FunctionId> {
    let of = |function: &Function<Draft>| {
        let calls = function.body.iter().flat_map(Draft::calls);
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
    functions.by_id().enumerated().map(|(id, function)| (function.name.clone(), id)).collect()
}

/// Lowers the functions of a type, which others call by these.
fn all(
    functions: Functions<Body>,
    of: &Context,
    callees: &[fn(FunctionId) -> Callee],
    lowered: &mut Lowered,
) -> Result<Table<FunctionId, Function<Draft>>, Dangling> {
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
fn without_branches(ids: Vec<FunctionId>, functions: &Table<FunctionId, Function<Draft>>) -> Vec<FunctionId> {
    let is_in_lane = |function: &Function<Draft>| function.access == Access::Lane;
    let has_branches = |function: &Function<Draft>| {
        is_in_lane(function) && function.body.as_ref().is_some_and(|code| !code.is_branch_free)
    };
    let end = functions.iter().position(has_branches).unwrap_or(functions.len());
    ids.into_iter().filter(|id| id.index() < end || !is_in_lane(&functions[*id])).collect()
}

/// Sorts functions from the order of planning (callees first) to the order of their signatures; private ones come last.
fn ordered(
    mut ids: Vec<FunctionId>,
    functions: &Table<FunctionId, Function<Draft>>,
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
    names: &'c RefCell<FieldNames>,
}

fn context<'c>(derivation: &'c Derivation, derived: &'c Derived, names: Names<'c>) -> Context<'c> {
    let Names { reserved, arguments, own, of_driver, names } = names;
    Context {
        derivation,
        pose: &derived.pose,
        named: &derived.named,
        reserved,
        pose_argument: &arguments.pose,
        branch: &arguments.branch,
        turn: &arguments.turn,
        memory: &arguments.memory,
        names,
        own,
        of_driver,
    }
}
