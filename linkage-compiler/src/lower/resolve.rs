//! The last pass: each bound value gets a slot, each operand comes before what it is an operand of, and what nothing reads is
//! left out. Functions are known by their places among those that are emitted.

use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

use linkage_ir::code::{self, Access, Called, Callee, Code, Function, Readable, Returned, Signed};
use linkage_ir::{ExternalId, FunctionId, Slot, ValueId};
use rustc_hash::FxHashMap;

use super::code::Draft;
use super::turn::parts_of_pi;
use super::value::{Block, Leaf, Pattern, Statement, Value};
use crate::ids::Table;

/// The functions that code refers to: their new ids, and their names.
pub(super) struct Places {
    /// Those of the type itself, and those of the driver.
    pub(super) own: Rc<BTreeMap<FunctionId, (FunctionId, Called)>>,
    pub(super) of_driver: Rc<BTreeMap<FunctionId, (FunctionId, Called)>>,
    pub(super) users: Rc<BTreeMap<ExternalId, (ExternalId, Called)>>,
}

/// The functions with these ids, in this order.
pub(super) fn places(
    functions: &Table<FunctionId, Function<Draft>>,
    order: &[FunctionId],
) -> Rc<BTreeMap<FunctionId, (FunctionId, Called)>> {
    let of = |(place, id): (usize, &FunctionId)| {
        let Function { name, access, .. } = &functions[*id];
        let called = Called { name: name.clone(), is_of_mechanism: access == &Access::OfMechanism };
        (*id, (FunctionId::new(place), called))
    };
    Rc::new(order.iter().enumerate().map(of).collect())
}

/// A function whose body has slots; otherwise what it refers to and does not exist.
pub(super) fn function(of: Function<Draft>, places: &Places) -> Result<Function<Code>, String> {
    let arguments = of.arguments.len();
    of.try_map(|draft| code(draft, arguments, places))
}

fn code(draft: Draft, arguments: usize, places: &Places) -> Result<Code, String> {
    let names = vec![String::new(); 1 + arguments];
    let mut pass = Pass {
        called: BTreeMap::new(),
        draft: &draft,
        places,
        names,
        slots: FxHashMap::default(),
        done: FxHashMap::default(),
        values: Vec::new(),
    };
    let stored = match draft.value {
        Returned::Stored { result, .. } => Some(result),
        Returned::Plain(_) | Returned::Result(_) => None,
    };
    let statements = draft.statements.iter().map(|statement| {
        let is_store = is_store(&draft, statement, stored);
        let statement = pass.statement(statement)?;
        Ok(if is_store { code::Statement::Store(Box::new(statement)) } else { statement })
    });
    let statements = statements.collect::<Result<Vec<_>, String>>()?;
    let value = match draft.value {
        Returned::Plain(value) => Returned::Plain(pass.value(value)?),
        Returned::Result(value) => Returned::Result(pass.value(value)?),
        Returned::Stored { result, literal } => {
            Returned::Stored { result: pass.value(result)?, literal: pass.value(literal)? }
        }
    };
    let Pass { called: functions, names, values, .. } = pass;
    let Draft { operations, uses, externals, bound, .. } = draft;
    let accuracy = bound.as_ref().and_then(super::Bound::sentence);
    let externals: BTreeSet<ExternalId> =
        externals.iter().filter_map(|id| places.users.get(id)).map(|(place, _)| *place).collect();
    let readable = Readable { slots: names, functions, operations, accuracy, uses, externals };
    Ok(Code { slots: readable.slots.len() as u32, values, statements, value, readable })
}

struct Pass<'d> {
    draft: &'d Draft,
    places: &'d Places,
    /// The functions that are called so far.
    called: BTreeMap<Callee, Called>,
    /// The name of each slot so far.
    names: Vec<String>,
    slots: FxHashMap<ValueId, Slot>,
    /// The new values of operations, and of bound values that are read.
    done: FxHashMap<ValueId, ValueId>,
    values: Vec<code::Value>,
}

type Resolved<T> = Result<T, String>;

impl Pass<'_> {
    fn statements(&mut self, all: &[Statement]) -> Resolved<Vec<code::Statement>> {
        all.iter().map(|statement| self.statement(statement)).collect()
    }

    fn statement(&mut self, statement: &Statement) -> Resolved<code::Statement> {
        Ok(match statement {
            Statement::Let(pattern, value) => {
                let value = match pattern {
                    // The pattern gives the value its name.
                    Pattern::Bound(bound) if bound == value => self.computed(*value)?,
                    _ => self.value(*value)?,
                };
                code::Statement::Let(self.pattern(pattern), value)
            }
            Statement::Do(value) => code::Statement::Do(self.value(*value)?),
            Statement::Assign(to, value) => code::Statement::Assign(self.value(*to)?, self.value(*value)?),
            Statement::Return(value) => code::Statement::Return(self.value(*value)?),
            Statement::LetElse(pattern, value, otherwise) => {
                let (value, otherwise) = (self.value(*value)?, self.value(*otherwise)?);
                code::Statement::LetElse(self.pattern(pattern), value, otherwise)
            }
            Statement::Unless(conditions, inside) => {
                code::Statement::Unless(self.all(conditions)?, self.statements(inside)?)
            }
            Statement::Store(inside) => code::Statement::Store(Box::new(self.statement(inside)?)),
        })
    }

    fn block(&mut self, block: &Block) -> Resolved<code::Block> {
        Ok(code::Block { statements: self.statements(&block.statements)?, value: self.value(block.value)? })
    }

    fn pattern(&mut self, pattern: &Pattern) -> code::Pattern {
        pattern.clone().map(&mut |bound| self.slot(bound), &mut |field| field)
    }

    /// The slot of a value with a name: an argument, or what a statement binds.
    fn slot(&mut self, id: ValueId) -> Slot {
        let (known, name) = (self.slots.get(&id), self.draft.name(id).unwrap_or_default());
        if let Some(known) = known {
            return *known;
        }
        let slot = match self.draft.operation(id) {
            Value::Given(Leaf::Itself) => Slot::ITSELF,
            Value::Given(Leaf::Argument(place)) => Slot::of_argument(*place),
            _ => {
                self.names.push(String::new());
                Slot::new(self.names.len() - 1)
            }
        };
        name.clone_into(&mut self.names[slot.index()]);
        self.slots.insert(id, slot);
        slot
    }

    fn add(&mut self, value: code::Value) -> ValueId {
        self.values.push(value);
        ValueId::new(self.values.len() - 1)
    }

    fn all(&mut self, ids: &[ValueId]) -> Resolved<Vec<ValueId>> {
        ids.iter().map(|id| self.value(*id)).collect()
    }

    fn signed(&mut self, all: &[Signed]) -> Resolved<Vec<Signed>> {
        all.iter().map(|one| Ok(Signed { value: self.value(one.value)?, ..*one })).collect()
    }

    /// A value by its slot, or computed where it is used.
    fn value(&mut self, id: ValueId) -> Resolved<ValueId> {
        if self.draft.name(id).is_some() {
            let slot = self.slot(id);
            return Ok(self.add(code::Value::Given(slot)));
        }
        self.computed(id)
    }

    /// The operation of a value.
    fn computed(&mut self, id: ValueId) -> Resolved<ValueId> {
        if let Some(done) = self.done.get(&id) {
            return Ok(*done);
        }
        let value = self.operation(id)?;
        let done = self.add(value);
        self.done.insert(id, done);
        Ok(done)
    }

    fn operation(&mut self, id: ValueId) -> Resolved<code::Value> {
        use code::Value as New;
        let draft = self.draft;
        Ok(match draft.operation(id) {
            Value::Given(leaf) => return Err(format!("{leaf:?}, which nothing binds")),
            Value::Constant(number) => match parts_of_pi(*number) {
                Some((count, parts)) => New::Turn(*number, count, parts),
                None => New::Constant(*number),
            },
            Value::Turn(number, count, parts) => New::Turn(*number, *count, *parts),
            Value::Exact(number) => New::Exact(*number),
            Value::Sum(terms) => New::Sum(self.signed(terms)?),
            Value::Product(factors) => New::Product(self.all(factors)?),
            Value::Quotient(above, below) => New::Quotient(self.value(*above)?, self.value(*below)?),
            Value::Square(base) => New::Square(self.value(*base)?),
            Value::Negative(inside) => New::Negative(self.value(*inside)?),
            Value::Call(function, arguments) => New::Call(*function, self.signed(arguments)?),
            Value::All(conditions) => New::All(self.all(conditions)?),
            Value::Text(text) => New::Text(text.clone()),
            Value::Count(count) => New::Count(*count),
            Value::Path(constant) => New::Path(*constant),
            Value::Field(of, name) => New::Field(self.value(*of)?, *name),
            Value::Member(of, place) => New::Member(self.value(*of)?, *place),
            Value::Columns(of) => New::Columns(self.value(*of)?),
            Value::Index(of, index) => New::Index(self.value(*of)?, *index),
            Value::At(of, index) => New::At(self.value(*of)?, self.value(*index)?),
            Value::List(all) => New::List(self.all(all)?),
            Value::Repeated(value, count) => New::Repeated(self.value(*value)?, *count),
            Value::Tuple(all) => New::Tuple(self.all(all)?),
            Value::Struct(of, members, rest) => {
                let members = members.iter().map(|(field, value)| Ok((*field, self.value(*value)?)));
                let members = members.collect::<Resolved<_>>()?;
                New::Struct(of.clone(), members, rest.map(|rest| self.value(rest)).transpose()?)
            }
            Value::Intrinsic(of, of_type, arguments) => New::Intrinsic(*of, of_type.clone(), self.all(arguments)?),
            Value::Function(of, of_type) => New::Function(*of, of_type.clone()),
            Value::Own(receiver, function, arguments) => {
                let missing = || format!("the function {}, which is not emitted", function.index());
                let places = self.places;
                let (places, receiver) = match receiver {
                    code::Receiver::Itself => (&places.own, code::Receiver::Itself),
                    code::Receiver::ItsType => (&places.own, code::Receiver::ItsType),
                    code::Receiver::Value(of) => (&places.of_driver, code::Receiver::Value(self.value(*of)?)),
                    code::Receiver::Type(of) => (&places.of_driver, code::Receiver::Type(of.clone())),
                };
                let (place, called) = places.get(function).ok_or_else(missing)?;
                let place = *place;
                self.called.entry(receiver.callee(place)).or_insert_with(|| called.clone());
                New::Own(receiver, place, self.all(arguments)?)
            }
            Value::UserFunction(function, arguments) => {
                let place = self.places.users.get(function);
                let (place, called) = place.ok_or_else(|| format!("the user function {}", function.index()))?;
                let place = *place;
                self.called.entry(Callee::User(place)).or_insert_with(|| called.clone());
                New::UserFunction(place, self.all(arguments)?)
            }
            Value::Try(of) => New::Try(self.value(*of)?),
            Value::Borrowed(of) => New::Borrowed(self.value(*of)?),
            Value::MutablyBorrowed(of) => New::MutablyBorrowed(self.value(*of)?),
            Value::Dereferenced(of) => New::Dereferenced(self.value(*of)?),
            Value::Closure { arguments, body, moves } => {
                let arguments = arguments.iter().map(|argument| self.pattern(argument)).collect();
                New::Closure { arguments, body: Box::new(self.block(body)?), moves: *moves }
            }
            Value::Block(block) => New::Block(Box::new(self.block(block)?)),
        })
    }
}

/// True for the statements that store members of the returned literal as they become known.
fn is_store(draft: &Draft, statement: &Statement, stored: Option<ValueId>) -> bool {
    let Some(result) = stored else { return false };
    match statement {
        Statement::Let(Pattern::Mutable(bound), _) => *bound == result,
        Statement::LetElse(_, value, otherwise) => {
            *otherwise == result && matches!(draft.operation(*value), Value::MutablyBorrowed(of) if *of == result)
        }
        Statement::Assign(..) => true,
        _ => false,
    }
}
