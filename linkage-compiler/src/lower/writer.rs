//! Code under construction: values, statements, and what names mean so far.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use linkage_ir::{Name, ValueId};
use rustc_hash::FxHashMap;

use super::context::Context;
use super::naming::{Hint, Hinted};
use super::schedule::Schedule;
use super::value::{Leaf, Pattern, Signed, Statement, Value, with_operands};
use super::values::{Numbers, Values};
use crate::graph::{ExternalId, SymbolId};
use crate::ids::GroupId;
use crate::program::{Constant, Failure, Intrinsic, Kernel};

/// The code of one function so far.
pub(super) struct Writer<'a> {
    pub(super) context: &'a Context<'a>,
    pub(super) kernel: &'a Kernel,
    pub(super) values: Values,
    pub(super) statements: Vec<Statement>,
    /// The preferred names of bound values, in the order in which they are given.
    pub(super) hints: Vec<Hinted>,
    /// The meaning of the names in planned code.
    pub(super) variables: FxHashMap<String, ValueId>,
    pub(super) locals: Vec<ValueId>,
    /// The value of each symbol that is bound so far.
    pub(super) symbols: FxHashMap<SymbolId, ValueId>,
    /// The user functions that are called.
    pub(super) externals: BTreeSet<ExternalId>,
    /// For each dyad, the flag that is true if its triangle is well conditioned.
    pub(super) well_conditioned: BTreeMap<GroupId, ValueId>,
    /// The checks, if a failed one is only flagged.
    pub(super) flags: Vec<ValueId>,
    /// The factorisations, by group.
    pub(super) factors: BTreeMap<GroupId, ValueId>,
    /// The value that is returned where a check of the kernel fails.
    pub(super) otherwise: Option<ValueId>,
    /// The first reference to something that does not exist.
    pub(super) dangling: Option<String>,
}

/// A schedule whose values are among those of the function.
#[derive(Clone, Copy)]
pub(super) struct Absorbed<'s> {
    pub(super) schedule: &'s Schedule,
    first: usize,
}

impl Absorbed<'_> {
    pub(super) fn id(self, value: ValueId) -> ValueId {
        ValueId::new(self.first + value.index())
    }

    pub(super) fn signed(self, signed: Signed) -> Signed {
        Signed { value: self.id(signed.value), ..signed }
    }

    /// The value of a symbol, if a line uses it.
    pub(super) fn symbol(self, symbol: SymbolId) -> Option<ValueId> {
        let is_it =
            |id: &&ValueId| matches!(self.schedule.value(**id), Value::Given(Leaf::Symbol(other)) if *other == symbol);
        self.schedule.used().iter().find(is_it).map(|id| self.id(*id))
    }
}

impl<'a> Writer<'a> {
    pub(super) fn new(context: &'a Context<'a>, kernel: &'a Kernel) -> Self {
        let numbers = match (&kernel.any_number, &kernel.failure) {
            (Some(_), _) => Numbers::Exact,
            (None, Failure::Flag) => Numbers::InLanes,
            _ => Numbers::Plain,
        };
        Self {
            context,
            kernel,
            values: Values::new(numbers),
            statements: Vec::new(),
            hints: Vec::new(),
            variables: FxHashMap::default(),
            locals: Vec::new(),
            symbols: FxHashMap::default(),
            externals: BTreeSet::new(),
            well_conditioned: BTreeMap::new(),
            flags: Vec::new(),
            factors: BTreeMap::new(),
            otherwise: None,
            dangling: None,
        }
    }

    /// True if a failed check is only flagged.
    pub(super) fn is_flagged(&self) -> bool {
        self.values.numbers == Numbers::InLanes
    }

    /// Notes a reference to something that does not exist, in place of which no code stands.
    pub(super) fn dangle(&mut self, what: impl FnOnce() -> String) -> ValueId {
        self.dangling.get_or_insert_with(what);
        self.values.bound()
    }

    /// Adds the values of a schedule. Symbols that are bound outside stand for their values.
    pub(super) fn absorb<'s>(&mut self, schedule: &'s Schedule, inside: &[SymbolId]) -> Absorbed<'s> {
        let first = self.values.all.len();
        let shifted = |value: &Value| with_operands(value.clone(), &mut |id| ValueId::new(first + id.index()));
        self.values.absorb(schedule.values.iter().map(shifted).collect(), schedule.known.clone());
        for &id in schedule.used() {
            let Value::Given(Leaf::Symbol(symbol)) = schedule.value(id) else { continue };
            if inside.contains(symbol) {
                self.symbols.remove(symbol);
            } else if let Some(&known) = self.symbols.get(symbol) {
                self.values.alias(ValueId::new(first + id.index()), known);
            }
        }
        Absorbed { schedule, first }
    }

    /// Binds a symbol and names it by its own name.
    pub(super) fn introduce(&mut self, within: Absorbed<'_>, symbol: SymbolId) -> ValueId {
        let id = within.symbol(symbol).unwrap_or_else(|| self.values.add(Value::Given(Leaf::Symbol(symbol))));
        self.values.bind(id, false);
        self.symbols.insert(symbol, id);
        self.hint(id, Hint::Symbol(symbol));
        id
    }

    pub(super) fn hint(&mut self, id: ValueId, hint: Hint) {
        self.hints.push(Hinted::Value(id, hint));
    }

    /// A new bound value with this preferred name.
    pub(super) fn bound(&mut self, preferred: impl Into<String>) -> ValueId {
        let id = self.values.bound();
        self.hint(id, Hint::Preferred(preferred.into()));
        id
    }

    /// The meaning of a name in planned code.
    pub(super) fn variable(&mut self, name: &str) -> ValueId {
        match self.variables.get(name) {
            Some(id) => *id,
            None => self.dangle(|| format!("the variable `{name}`")),
        }
    }

    pub(super) fn let_value(&mut self, pattern: Pattern, value: ValueId) {
        self.statements.push(Statement::Let(pattern, value));
    }

    /// Adds `let value = …` for a value that gets this name.
    pub(super) fn let_itself(&mut self, value: ValueId) {
        self.let_value(Pattern::Bound(value), value);
    }

    pub(super) fn add(&mut self, value: Value) -> ValueId {
        self.values.add(value)
    }

    pub(super) fn list(&mut self, values: impl IntoIterator<Item = ValueId>) -> ValueId {
        self.add(Value::List(values.into_iter().collect()))
    }

    pub(super) fn text(&mut self, text: impl Into<Arc<str>>) -> ValueId {
        self.add(Value::Text(text.into()))
    }

    pub(super) fn field(&mut self, of: ValueId, name: &str) -> ValueId {
        let name = self.field_name(name);
        self.add(Value::Field(of, name))
    }

    /// The number of a name of a field.
    pub(super) fn field_name(&self, text: &str) -> Name {
        self.context.names.borrow_mut().of(text)
    }

    pub(super) fn tried(&mut self, value: ValueId) -> ValueId {
        self.add(Value::Try(value))
    }

    /// A call of a function of the table, with as many arguments as its row says.
    pub(super) fn call(&mut self, of: Intrinsic, arguments: impl IntoIterator<Item = ValueId>) -> ValueId {
        let arguments: Vec<ValueId> = arguments.into_iter().collect();
        if arguments.len() != of.row().roles.len() {
            return self.dangle(|| format!("{} arguments of `{}`", arguments.len(), of.row().name));
        }
        self.add(Value::Intrinsic(of, None, arguments))
    }

    /// The name of the mechanism in errors.
    pub(super) fn mechanism(&mut self) -> ValueId {
        self.add(Value::Path(Constant::Name))
    }

    /// The name of the mechanism or scene in the errors of a kernel.
    pub(super) fn error_name(&mut self) -> ValueId {
        match &self.kernel.error_name {
            Some(name) => self.variable(name),
            None => self.mechanism(),
        }
    }

    /// The mechanism at its inputs in the errors of a group that cannot be assembled; its name where they are not numbers of the
    /// kernel, or where nothing reads the error.
    pub(super) fn origin(&mut self) -> ValueId {
        let derivation = self.context.derivation;
        let inputs = derivation.inputs.iter().map(|&column| derivation.coordinates[column].value);
        let inputs: Option<Vec<ValueId>> = inputs.map(|input| self.symbols.get(&input).copied()).collect();
        let is_read = self.kernel.error_name.is_none() && !self.is_flagged();
        match inputs.filter(|_| is_read) {
            Some(inputs) => {
                let (own, inputs) = (self.variable("self"), self.list(inputs));
                self.call(Intrinsic::At, [own, inputs])
            }
            None => self.error_name(),
        }
    }

    pub(super) fn group(&mut self, group: GroupId) -> ValueId {
        let title = self.context.derivation.groups[group].title(self.context.derivation);
        self.text(title)
    }
}
