//! Lowering of a planned function to statements.

use std::collections::{BTreeMap, BTreeSet};

use super::finished::Finished;
use super::formulas::{Formulas, is_formula};
use super::lines::{Writer, direction_name};
use super::names::Names;
use super::rounding::{Bound, DIRECTION, Roundings};
use super::schedule::Schedule;
use super::scheduling::schedule;
use super::value::{Value, ValueId};
use super::works::{Work, Works};
use super::{stored, stretches};
use crate::derivation::Derivation;
use crate::graph::{ExternalId, Function as Elementary, Node, NodeId, SymbolId};
use crate::ids::BlockId;
use crate::program::{
    Access, Body, Expression, Function, Given, Kernel, Operations, Output, Pattern, PosePlan, Shape, Source, Statement,
    Stored, Type, Value as Returned,
};

/// The data that the functions of one driver or scene share.
pub struct Context<'a> {
    pub derivation: &'a Derivation,
    pub pose: &'a PosePlan,
    /// Names that the user gave to expressions.
    pub named: &'a [(NodeId, String)],
    /// Names that no value may have: those of the arguments.
    pub reserved: &'a BTreeSet<String>,
    /// The names of the arguments for the pose, the branch, the turns, and the positions of groups that are kept.
    pub pose_argument: &'a str,
    pub branch: &'a str,
    pub turn: &'a str,
    pub memory: &'a str,
    /// The operations of the functions lowered so far.
    pub(super) works: Works,
    /// The rounding errors of a pose.
    pub roundings: Roundings,
}

/// The lowered body of a function.
#[derive(Debug, Clone)]
pub struct Code {
    pub statements: Vec<Statement>,
    pub value: Returned,
    pub operations: Operations,
    /// The arguments that it uses.
    pub uses: BTreeSet<String>,
    /// The user functions that it calls.
    pub externals: BTreeSet<ExternalId>,
    /// True if its formulas need no iteration, no pivoting and no function of the user or of a library.
    pub is_branch_free: bool,
    /// The largest rounding errors that its results can have, if they are known.
    pub bound: Option<Bound>,
}

/// Lowers a function.
pub fn function(planned: Function<Body>, context: &mut Context) -> Function<Code> {
    let Function { name, doc, access, is_method, arguments, returns, is_fallible, body } = planned;
    let is_layer = matches!(access, Access::Layer | Access::PublicLayer);
    let is_stored = |source: &Source| match source.from.stored() {
        Some(name) => name == "self" || arguments.iter().any(|of| of.name == name),
        None => source.shape.symbols().iter().all(|symbol| context.roundings.knows(*symbol)),
    };
    let has_bound = access.is_public()
        && access != Access::Hidden
        && body.as_ref().is_some_and(|body| match (&body.kernel, &body.value) {
            (Some(kernel), value) => kernel.sources.iter().all(is_stored) && value.literal().is_of_results(),
            _ => false,
        });
    let body = body.map(|body| {
        let (code, work) = self::body(body, (is_layer, has_bound), context);
        // A cold function is called only after an error.
        let work = if access == Access::Cold { Work::default() } else { work };
        let operations = work.total();
        context.works.insert(name.clone(), work);
        Code { operations, ..code }
    });
    Function { name, doc, access, is_method, arguments, returns, is_fallible, body }
}

fn body(body: Body, (is_layer, has_bound): (bool, bool), context: &mut Context) -> (Code, Work) {
    let Body { before, kernel, after, value, locals, calls, operations } = body;
    let mut formulas = match kernel {
        Some(kernel) => Formulas::of(&kernel, (is_layer, has_bound), context),
        None => Formulas::none(context.reserved),
    };
    let work = context.works.work(formulas.schedule.as_ref(), is_layer, &calls, operations);
    let locals: Vec<String> = locals.iter().map(|preferred| formulas.taken.unique(preferred)).collect();
    let computed = std::mem::take(&mut formulas.statements);
    let finished = Finished { results: &formulas.results, locals: &locals };
    let all = |planned: Vec<Statement>| {
        let mut statements = Vec::new();
        planned.into_iter().for_each(|statement| finished.statement(statement, &formulas, &mut statements));
        statements
    };
    let (before, after) = (all(before), all(after));
    let value = match value {
        Returned::Plain(value) => Returned::Plain(finished.expression(value)),
        Returned::Result(value) => Returned::Result(finished.expression(value)),
        Returned::Stored(stored) => {
            let Stored { result, members, literal } = *stored;
            let [result, literal] = [result, literal].map(|value| finished.expression(value));
            let finish = |(member, value)| (finished.expression(member), finished.expression(value));
            let members = members.into_iter().map(finish);
            Returned::Stored(Box::new(Stored { result, members: members.collect(), literal }))
        }
    };
    let computed = match &value {
        Returned::Stored(stored) => stored::stored(computed, stored.members.clone()),
        _ => computed,
    };
    let mut uses = BTreeSet::new();
    let mut use_name = |name: &str| uses.extend([name.to_owned()]);
    value.returned().each_name(&mut use_name);
    after.iter().for_each(|statement| statement.each_name(&mut use_name));
    let computed = stretches::divided(computed, uses.iter().map(String::as_str));
    computed.iter().for_each(|statement| statement.each_name(&mut |name| uses.extend([name.to_owned()])));
    let before = needed(before, &mut uses);
    let statements = before.into_iter().chain(computed).chain(after).collect();
    let mut statements = taken_apart_at_once(statements, &value);
    let value = unnamed(&mut statements, value);
    let Formulas { externals, is_branch_free, bound, .. } = formulas;
    let operations = work.total();
    (Code { statements, value, operations, uses, externals, is_branch_free, bound }, work)
}

/// Returns the value of the last `let` instead of its name, if the function returns that name.
fn unnamed(statements: &mut Vec<Statement>, value: Returned) -> Returned {
    let is_named = |statement: &mut Statement| match (statement, &value) {
        (Statement::Let(Pattern::Name(last), _), Returned::Plain(Expression::Name(name))) => last == name,
        _ => false,
    };
    match statements.pop_if(is_named) {
        Some(Statement::Let(_, last)) => Returned::Plain(last),
        _ => value,
    }
}

/// Takes the value of a call apart where it is computed, if nothing else uses its name:
/// `let Rates { theta3, .. } = coordinate_rates(…);`.
fn taken_apart_at_once(statements: Vec<Statement>, value: &Returned) -> Vec<Statement> {
    let mut uses: BTreeMap<&str, usize> = BTreeMap::new();
    let mut count = |name| *uses.entry(name).or_default() += 1;
    value.returned().each_name(&mut count);
    statements.iter().for_each(|statement| statement.each_name(&mut count));
    let apart = statements.iter().filter_map(|statement| match statement {
        Statement::Let(
            pattern @ (Pattern::Struct { .. } | Pattern::List(_) | Pattern::Tuple(_)),
            Expression::Name(name),
        ) if uses[name.as_str()] == 1 => Some((name.clone(), pattern.clone())),
        _ => None,
    });
    let mut apart: BTreeMap<String, Pattern> = apart.collect();
    // Arguments are taken apart in a statement of their own.
    let bound = statements.iter().filter_map(|statement| match statement {
        Statement::Let(Pattern::Name(name), _) => Some(name.as_str()),
        _ => None,
    });
    let bound: BTreeSet<&str> = bound.collect();
    apart.retain(|name, _| bound.contains(name.as_str()));
    let statements = statements.into_iter().filter_map(|statement| match statement {
        Statement::Let(Pattern::Name(name), value) => {
            Some(Statement::Let(apart.get(&name).cloned().unwrap_or(Pattern::Name(name)), value))
        }
        Statement::Let(_, Expression::Name(name)) if apart.contains_key(&name) => None,
        statement => Some(statement),
    });
    statements.collect()
}

/// Removes `let`s with unused names, unless they may fail; adds the names that the others use.
fn needed(statements: Vec<Statement>, uses: &mut BTreeSet<String>) -> Vec<Statement> {
    let mut kept = Vec::new();
    for statement in statements.into_iter().rev() {
        let is_unused = match &statement {
            Statement::Let(Pattern::Typed(name, _) | Pattern::Name(name), value) => {
                !matches!(value, Expression::Try(_)) && !uses.contains(name)
            }
            _ => false,
        };
        if !is_unused {
            statement.each_name(&mut |name| uses.extend([name.to_owned()]));
            kept.push(statement);
        }
    }
    kept.reverse();
    kept
}

impl<'a> Formulas<'a> {
    fn of(kernel: &Kernel, (is_layer, has_bound): (bool, bool), context: &mut Context<'a>) -> Self {
        let derivation = context.derivation;
        let nothing = Given::default();
        let of_pose = if kernel.is_on_pose { &context.pose.given } else { &nothing };
        let given = kernel.any_number.as_ref().unwrap_or(of_pose);
        let nodes: Vec<NodeId> = kernel.results.iter().map(|output| output.node).collect();
        // Preferred names of values: those of results, then those given by the user.
        let results = kernel.results.iter().filter_map(|output| Some((output.node, output.name.clone()?)));
        let named: Vec<(NodeId, String)> = results.chain(context.named.iter().cloned()).collect();
        let schedule = schedule(&derivation.graph, &kernel.steps, &nodes, given, &named, is_layer);
        let bound = has_bound.then(|| self::bound(kernel, &schedule, context)).flatten();
        let mut is_proven = schedule.proven(kernel.conclusive.clone());
        is_proven
            .iter_mut()
            .skip(kernel.external.start)
            .take(kernel.external.len())
            .for_each(|is_proven| *is_proven = true);
        let mut names = Names::new(&derivation.graph, context.reserved);
        // The symbols of the user are named first, so that they keep their names.
        let own: BTreeSet<SymbolId> = kernel.steps.iter().flat_map(|step| step.introduced()).collect();
        let symbols: BTreeSet<SymbolId> = schedule.symbols().filter(|symbol| !own.contains(symbol)).collect();
        for &symbol in &symbols {
            names.introduce(symbol);
        }
        let sources = kernel.sources.iter();
        let mut statements: Vec<Statement> =
            sources.filter_map(|source| taken_apart(source, &symbols, &names)).collect();
        if kernel.is_on_pose {
            directions(&mut statements, context, &schedule, &mut names);
        }
        let arguments = [context.branch, context.turn, context.memory];
        let mut writer = Writer::new((derivation, kernel), arguments, &schedule, names);
        writer.statements = statements;
        let open = kernel.dyads.iter().zip(&is_proven).filter(|(_, is_proven)| !**is_proven);
        writer.well_conditioned = open.filter_map(|(dyad, _)| Some(((*dyad)?, None))).collect();
        writer.write();
        let mut results = writer.all_signed(&schedule.results);
        let Writer { mut statements, names, externals, well_conditioned, flags, factors, .. } = writer;
        parameters_where_used(&mut statements);
        if flags.is_empty() {
            passed_on(&mut statements, &mut results);
        }
        let mut taken = names.taken;
        let results = kernel.results.iter().zip(results).map(|(output, result)| match &output.name {
            Some(preferred) if is_formula(&result) => {
                let name = taken.unique(preferred);
                statements.push(Statement::Let(Pattern::Name(name.clone()), result));
                Expression::Name(name)
            }
            _ => result,
        });
        let results = results.collect();
        let (dyads, well_conditioned) = (kernel.dyads.clone(), well_conditioned.into_values().flatten().collect());
        let is_branch_free = schedule.is_branch_free();
        Self {
            statements,
            results,
            is_proven,
            dyads,
            well_conditioned,
            factors: factors.into_values().collect(),
            flags,
            is_branch_free,
            bound,
            taken,
            externals,
            schedule: Some(schedule),
        }
    }
}

/// The largest rounding errors of a kernel whose arguments are stored.
fn bound(kernel: &Kernel, schedule: &Schedule, context: &mut Context) -> Option<Bound> {
    let graph = &context.derivation.graph;
    let fields = taken_by_others(kernel, context);
    let results = kernel.results.iter().zip(&schedule.results).enumerate();
    let names = results.map(|(place, (output, result))| {
        let symbol = graph.as_symbol(output.node);
        let symbol = symbol.or_else(|| fields.iter().find(|(other, _)| *other == place).map(|(_, symbol)| *symbol));
        let symbol = symbol.map(|symbol| graph.symbol_name(symbol));
        let is_circular = matches!(graph.node(output.node), Node::Call(Elementary::Sin | Elementary::Cos, _));
        let symbol = if is_circular { Some(DIRECTION) } else { symbol };
        let name = output.name.as_deref().or(symbol).or(schedule.name(result.value).map(|(name, _)| name));
        name.unwrap_or_default().to_owned()
    });
    let names = names.collect::<Vec<_>>();
    context.roundings.keep_pose(graph, schedule, &fields);
    context.roundings.bound(graph, schedule, &names)
}

/// The results that other functions take, with their symbols: the determinants of a pose, and velocity ratios.
fn taken_by_others(kernel: &Kernel, context: &Context) -> Vec<(usize, SymbolId)> {
    let graph = &context.derivation.graph;
    let ratios: BTreeSet<SymbolId> = context.derivation.ratios.iter().flatten().copied().collect();
    let places = kernel.results.iter().enumerate();
    let of = |(place, output): (usize, &Output)| {
        let is_it = |(block, ..): &&(BlockId, String, SymbolId)| {
            context.derivation.blocks[*block].determinant.is_some_and(|determinant| determinant.value == output.node)
        };
        let determinant = context.pose.determinants.iter().find(is_it).map(|(.., symbol)| *symbol);
        let ratio = graph.as_symbol(output.node).filter(|symbol| ratios.contains(symbol));
        Some((place, determinant.or(ratio)?))
    };
    places.filter_map(of).collect()
}

/// Reads a field that is only passed on, such as the position of a slider, where it is passed on: `q.s`.
fn passed_on(statements: &mut Vec<Statement>, results: &mut [Expression]) {
    let mut used = BTreeSet::new();
    let mut uses = |name: &str| used.extend([name.to_owned()]);
    statements.iter().for_each(|statement| statement.each_name(&mut uses));
    let formulas = results.iter().filter(|result| is_formula(result));
    formulas.for_each(|result| result.each_name(&mut uses));
    statements.retain_mut(|statement| {
        let Statement::Let(Pattern::Struct { fields, is_whole, .. }, Expression::Dereferenced(of)) = statement else {
            return true;
        };
        let count = fields.len();
        fields.retain(|(field, pattern)| {
            let Pattern::Name(name) = pattern else { return true };
            let is_used = used.contains(name);
            if !is_used {
                let passed =
                    results.iter_mut().filter(|result| matches!(result, Expression::Name(other) if other == name));
                passed.for_each(|result| *result = of.clone().field(field));
            }
            is_used
        });
        *is_whole &= fields.len() == count;
        !fields.is_empty()
    });
}

/// Moves the statement that reads the parameters to their first use: what is computed before, such as the sines of the
/// inputs, then has the registers for itself.
fn parameters_where_used(statements: &mut Vec<Statement>) {
    let is_parameters =
        |statement: &Statement| matches!(statement, Statement::Let(Pattern::Struct { of: Type::Itself, .. }, _));
    let Some(place) = statements.iter().position(is_parameters) else { return };
    let parameters = statements.remove(place);
    let mut bound = BTreeSet::new();
    if let Statement::Let(pattern, _) = &parameters {
        pattern.each_name(&mut |name| bound.extend([name.to_owned()]));
    }
    let uses = |statement: &Statement| {
        let mut is_used = false;
        statement.each_name(&mut |name| is_used |= bound.contains(name));
        is_used
    };
    let place = statements.iter().position(uses).unwrap_or(statements.len());
    statements.insert(place, parameters);
}

/// `let Type { field, other: name, .. } = *value;` with the fields that are used; `None` if no field is used.
fn taken_apart(source: &Source, used: &BTreeSet<SymbolId>, names: &Names) -> Option<Statement> {
    let pattern = match pattern(&source.shape, used, names) {
        Some(pattern) => pattern,
        // A call that may fail is kept.
        None if may_fail(&source.from) => Pattern::Ignored,
        None => return None,
    };
    Some(Statement::Let(pattern, source.from.clone()))
}

fn may_fail(value: &Expression) -> bool {
    match value {
        Expression::Try(_) => true,
        Expression::Field(of, _) => may_fail(of),
        _ => false,
    }
}

/// The pattern of a shape with the symbols that are used; `None` if no symbol is used.
fn pattern(shape: &Shape, used: &BTreeSet<SymbolId>, names: &Names) -> Option<Pattern> {
    let all = |shapes: &[Shape]| {
        let patterns: Vec<_> = shapes.iter().map(|shape| pattern(shape, used, names)).collect();
        let is_used = patterns.iter().any(Option::is_some);
        is_used.then(|| patterns.into_iter().map(|pattern| pattern.unwrap_or(Pattern::Ignored)).collect())
    };
    match shape {
        Shape::Symbol(symbol) => used.contains(symbol).then(|| Pattern::Name(names.symbol(*symbol))),
        Shape::Ignored => None,
        Shape::List(shapes) => all(shapes).map(Pattern::List),
        Shape::Tuple(shapes) => all(shapes).map(Pattern::Tuple),
        Shape::Fields { of, fields, is_whole } => {
            let named = fields.iter().filter_map(|(field, shape)| Some((field.clone(), pattern(shape, used, names)?)));
            let named: Vec<(String, Pattern)> = named.collect();
            let is_whole = *is_whole && named.len() == fields.len();
            (!named.is_empty()).then(|| Pattern::Struct { of: of.clone(), fields: named, is_whole })
        }
    }
}

/// Adds `let (sin_theta, cos_theta) = (pose.theta.im, pose.theta.re);` for the directions that are used.
fn directions(statements: &mut Vec<Statement>, context: &Context, schedule: &Schedule, names: &mut Names) {
    let mut used: Vec<(NodeId, Elementary, ValueId)> = Vec::new();
    for &id in schedule.used() {
        if let Value::Direction(function, angle) = schedule.value(id) {
            used.push((*angle, *function, id));
        }
    }
    used.sort_unstable();
    for parts in used.chunk_by(|one, other| one.0 == other.0) {
        let field = context.pose.direction(parts[0].0);
        let (mut patterns, mut values) = (Vec::new(), Vec::new());
        for &(_, function, id) in parts {
            patterns.push(Pattern::Name(names.give(id, &direction_name(function, field))));
            let part = if function == Elementary::Sin { "im" } else { "re" };
            values.push(Expression::name(context.pose_argument).field(field).field(part));
        }
        let (pattern, value) = match (patterns.pop(), values.pop()) {
            (Some(pattern), Some(value)) if patterns.is_empty() => (pattern, value),
            (pattern, value) => (
                Pattern::Tuple(patterns.into_iter().chain(pattern).collect()),
                Expression::Tuple(values.into_iter().chain(value).collect()),
            ),
        };
        statements.push(Statement::Let(pattern, value));
    }
}
