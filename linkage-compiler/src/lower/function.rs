//! Lowering of a planned function: translate, order, write, check, place, name.

use std::collections::BTreeSet;
use std::fmt::{self, Display, Formatter};

use linkage_ir::ValueId;
use linkage_ir::code::{Callee, Returned};
use rustc_hash::FxHashSet;

use super::calls;
use super::checks::Checked;
use super::code::Draft;
use super::context::Context;
use super::counts::{Count, Counts};
use super::naming::{self, Hint};
use super::rounding::{Bound, DIRECTION, Roundings};
use super::schedule::Schedule;
use super::scheduling::schedule;
use super::value::{Leaf, Value};
use super::writer::Writer;
use super::{proven, reads, stored, stretches, unneeded};
use crate::graph::{Function as Elementary, Node, NodeId, SymbolId};
use crate::ids::GroupId;
use crate::program::{self, Access, Body, Failure, Function, Given, Kernel, Output, Source, Taken};

/// The functions lowered so far, as far as later ones need them.
pub(super) struct Lowered {
    /// Their operations.
    pub(super) counts: Counts,
    /// The rounding errors of a pose.
    pub(super) roundings: Roundings,
}

/// A reference of planned code to something that does not exist: a mistake of the compiler.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Dangling {
    pub function: String,
    /// The thing that does not exist.
    pub what: String,
}

impl Display for Dangling {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Self { function, what } = self;
        write!(f, "the code of `{function}` refers to {what}, which does not exist: this is a mistake of the compiler")
    }
}

/// Lowers a function that others call, by these, or one that none calls.
pub(super) fn function(
    planned: Function<Body>,
    callees: &[Callee],
    context: &Context,
    lowered: &mut Lowered,
) -> Result<Function<Draft>, Dangling> {
    let Function { name, doc, access, is_method, arguments, returns, is_fallible, body } = planned;
    let signature = Signature {
        is_layer: matches!(access, Access::Layer | Access::PublicLayer),
        has_bound: access.is_public() && access != Access::Hidden && !doc.is_empty(),
        arguments: arguments.iter().map(|argument| argument.name.as_str()).collect(),
    };
    let code = body.map(|body| {
        let (code, count) = signature.body(body, context, lowered)?;
        // A cold function is called only after an error.
        let count = if access == Access::Cold { Count::default() } else { count };
        let operations = count.total();
        callees.iter().for_each(|callee| lowered.counts.insert(*callee, count.clone()));
        Ok(Draft { operations, ..code })
    });
    let body = code.transpose().map_err(|what| Dangling { function: name.clone(), what })?;
    Ok(Function { name, doc, access, is_method, arguments, returns, is_fallible, body })
}

/// The parts of a signature that lowering a body depends on.
struct Signature<'f> {
    is_layer: bool,
    /// True if its doc comment says how large the rounding errors of its results can be.
    has_bound: bool,
    arguments: Vec<&'f str>,
}

impl Signature<'_> {
    /// The code of a body and its operations; otherwise what the body refers to and does not exist.
    fn body(&self, body: Body, context: &Context, lowered: &mut Lowered) -> Result<(Draft, Count), String> {
        let Body { before, kernel, after, value, locals, operations } = body;
        let schedule = kernel.as_ref().map(|kernel| self.scheduled(kernel, context));
        let bound = kernel.as_ref().zip(schedule.as_ref()).and_then(|(kernel, schedule)| {
            self.has_bound(kernel, &value, lowered).then(|| bound(kernel, schedule, context, lowered)).flatten()
        });
        let none = Kernel::default();
        let mut writer = Writer::new(context, kernel.as_ref().unwrap_or(&none));
        writer.arguments(&self.arguments);
        writer.locals = locals.iter().map(|_| writer.values.bound()).collect();
        writer.planned(&before, &Checked::default());
        let before = std::mem::take(&mut writer.statements);
        let checked = match (&kernel, &schedule) {
            (Some(kernel), Some(schedule)) => writer.kernel(kernel, schedule),
            _ => Checked::default(),
        };
        let computed = std::mem::take(&mut writer.statements);
        for (id, preferred) in writer.locals.clone().into_iter().zip(locals) {
            writer.hint(id, Hint::Preferred(preferred));
        }
        writer.planned(&after, &checked);
        let after = std::mem::take(&mut writer.statements);
        let (value, members) = writer.returned(&value, &checked);
        let Writer { mut values, hints, externals, dangling, .. } = writer;
        if let Some(what) = dangling {
            return Err(what);
        }
        let computed = stored::stored(&values, computed, members);
        let mut later = Vec::new();
        values.uses().value(value.returned(), &mut |id| later.push(id));
        values.uses().statements(&after, &mut |id| later.push(id));
        let computed = stretches::divided(&mut values, computed, &later);
        let mut used: FxHashSet<ValueId> = later.into_iter().collect();
        values.uses().statements(&computed, &mut |id| {
            used.insert(id);
        });
        let before = unneeded::needed(&values, before, &mut used);
        let statements = before.into_iter().chain(computed).chain(after).collect();
        let mut statements = unneeded::taken_apart_at_once(&mut values, statements, value);
        let value = unneeded::unnamed(&mut values, &mut statements, value);
        let uses = used.iter().filter_map(|id| match values.get(*id) {
            Value::Given(Leaf::Argument(index)) => Some(*index),
            _ => None,
        });
        let uses = uses.collect();
        let graph = &context.derivation.graph;
        let names = naming::names(&hints, &values, graph, Taken::new(context.reserved));
        let is_branch_free = schedule.as_ref().is_none_or(Schedule::is_branch_free);
        let values = values.all;
        let calls = calls::always(&values, &statements, value);
        let count = lowered.counts.of_body(schedule.as_ref(), self.is_layer, &calls, operations);
        let operations = count.total();
        Ok((Draft { values, statements, value, operations, uses, externals, is_branch_free, bound, names }, count))
    }

    fn scheduled(&self, kernel: &Kernel, context: &Context) -> Schedule {
        let nothing = Given::default();
        let of_pose = if kernel.is_on_pose { &context.pose.given } else { &nothing };
        let given = kernel.any_number.as_ref().unwrap_or(of_pose);
        let nodes: Vec<NodeId> = kernel.results.iter().map(|output| output.node).collect();
        // Preferred names of values: those of results, then those given by the user.
        let results = kernel.results.iter().filter_map(|output| Some((output.node, output.name.clone()?)));
        let named: Vec<(NodeId, String)> = results.chain(context.named.iter().cloned()).collect();
        schedule(&context.derivation.graph, &kernel.steps, &nodes, given, &named, self.is_layer)
    }

    /// True if the doc comment says how large rounding errors can be, and the arguments of the kernel are stored.
    fn has_bound(&self, kernel: &Kernel, value: &program::Value, lowered: &Lowered) -> bool {
        let is_stored = |source: &Source| match source.from.stored() {
            Some(name) => name == "self" || self.arguments.contains(&name),
            None => source.shape.symbols().iter().all(|symbol| lowered.roundings.knows(*symbol)),
        };
        self.has_bound && kernel.sources.iter().all(is_stored) && value.literal().is_of_results()
    }
}

impl Writer<'_> {
    /// Gives the arguments their meaning.
    fn arguments(&mut self, names: &[&str]) {
        let own = self.values.add(Value::Given(Leaf::Itself));
        self.variables.insert("self".to_owned(), own);
        self.hint(own, Hint::Fixed("self".to_owned()));
        for (index, name) in names.iter().enumerate() {
            let id = self.values.add(Value::Given(Leaf::Argument(index)));
            self.variables.insert((*name).to_owned(), id);
            self.hint(id, Hint::Fixed((*name).to_owned()));
        }
    }

    /// Writes a kernel, and returns its results.
    fn kernel(&mut self, kernel: &Kernel, schedule: &Schedule) -> Checked {
        if let Failure::Return(otherwise) = &kernel.failure {
            self.otherwise = Some(self.expression(otherwise, &Checked::default()));
        }
        let of = self.absorb(schedule, &[]);
        self.sources(of);
        self.write(of);
        let mut results = self.all_signed(of, &schedule.results);
        let is_proven = proven::proven(&self.values, &self.statements, &results, kernel.conclusive.clone());
        let is_needless = |index: usize| kernel.external.contains(&index);
        let is_proven: Vec<bool> =
            is_proven.into_iter().enumerate().map(|(index, is_it)| is_it || is_needless(index)).collect();
        let open = kernel.dyads.iter().zip(&is_proven).filter(|(_, is_proven)| !**is_proven);
        let open: BTreeSet<GroupId> = open.filter_map(|(dyad, _)| *dyad).collect();
        self.keep_conditions(&open);
        reads::parameters_where_used(&self.values, &mut self.statements);
        if self.flags.is_empty() {
            reads::passed_on(&mut self.values, &mut self.statements, &mut results);
        }
        let results = results.into_iter().zip(&kernel.results).map(|(result, output)| self.result(result, output));
        Checked { results: results.collect(), is_proven, dyads: kernel.dyads.clone() }
    }

    /// Binds a result to its name, if it has one and is no variable.
    fn result(&mut self, result: ValueId, output: &Output) -> ValueId {
        let Some(preferred) = output.name.as_ref().filter(|_| self.values.is_formula(result)) else { return result };
        // Numbers are shared: one with a name is a value of its own.
        let result = match self.values.get(result) {
            number @ (Value::Constant(_) | Value::Exact(_)) => self.values.add(number.clone()),
            _ => result,
        };
        self.values.bind(result, false);
        self.hint(result, Hint::Preferred(preferred.clone()));
        self.let_itself(result);
        result
    }

    /// The value that a function returns, and the members that are assigned when they are known.
    fn returned(&mut self, value: &program::Value, checked: &Checked) -> (Returned, Vec<(ValueId, ValueId)>) {
        match value {
            program::Value::Plain(value) => (Returned::Plain(self.expression(value, checked)), Vec::new()),
            program::Value::Result(value) => (Returned::Result(self.expression(value, checked)), Vec::new()),
            program::Value::Stored(stored) => {
                let [result, literal] = [&stored.result, &stored.literal].map(|value| self.expression(value, checked));
                let members = stored.members.iter();
                let members =
                    members.map(|(member, value)| (self.expression(member, checked), self.expression(value, checked)));
                let members = members.collect();
                (Returned::Stored { result, literal }, members)
            }
        }
    }
}

/// The largest rounding errors of a kernel whose arguments are stored.
fn bound(kernel: &Kernel, schedule: &Schedule, context: &Context, lowered: &mut Lowered) -> Option<Bound> {
    let graph = &context.derivation.graph;
    let fields = taken_by_others(kernel, context);
    let results = kernel.results.iter().zip(&schedule.results).enumerate();
    let names = results.map(|(index, (output, result))| {
        let symbol = graph.as_symbol(output.node);
        let symbol = symbol.or_else(|| fields.iter().find(|(other, _)| *other == index).map(|(_, symbol)| *symbol));
        let symbol = symbol.map(|symbol| graph.symbol_name(symbol));
        let is_circular = matches!(graph.node(output.node), Node::Call(Elementary::Sin | Elementary::Cos, _));
        let symbol = if is_circular { Some(DIRECTION) } else { symbol };
        let name = output.name.as_deref().or(symbol).or(schedule.name(result.value).map(|(name, _)| name));
        name.unwrap_or_default().to_owned()
    });
    let names = names.collect::<Vec<_>>();
    lowered.roundings.keep_pose(graph, schedule, &fields);
    lowered.roundings.bound(graph, schedule, &names)
}

/// The results that other functions take, with their symbols: the determinants of a pose, and velocity ratios.
fn taken_by_others(kernel: &Kernel, context: &Context) -> Vec<(usize, SymbolId)> {
    let graph = &context.derivation.graph;
    let ratios: BTreeSet<SymbolId> = context.derivation.ratios.iter().flatten().copied().collect();
    let indices = kernel.results.iter().enumerate();
    let of = |(index, output): (usize, &Output)| {
        let is_it = |(group, ..): &&(GroupId, String, SymbolId)| {
            context.derivation.groups[*group].determinant.is_some_and(|determinant| determinant.value == output.node)
        };
        let determinant = context.pose.determinants.iter().find(is_it).map(|(.., symbol)| *symbol);
        let ratio = graph.as_symbol(output.node).filter(|symbol| ratios.contains(symbol));
        Some((index, determinant.or(ratio)?))
    };
    indices.filter_map(of).collect()
}
