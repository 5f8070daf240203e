//! Statements, and the values of operations.

use std::rc::Rc;
use std::sync::Arc;

use linkage_ir::code::{Block, Code, Function, Pattern, Receiver, Returned, Statement, Type, Value as Operation};
use linkage_ir::{Constant, FunctionId, Intrinsic, Name, Slot, ValueId};
use linkage_runtime::__rt::Wide;
use smallvec::SmallVec;

use super::defect::Defect;
use super::failure::{Evaluated, Failure};
use super::operations::of_runtime;
use super::scalar::Scalar;
use super::value::{Record, Value};
use super::{Kind, Machine, Of};
use crate::tape::{Flag, Traced};

impl<'c> Machine<'c> {
    /// Runs the statements of a function, and returns its value: that of its success if it is fallible.
    pub(super) fn body(&mut self, code: &'c Code) -> Evaluated<Value> {
        if let Some(value) = self.statements(code, &code.statements)? {
            return Ok(value);
        }
        match code.value {
            Returned::Plain(value) | Returned::Stored { literal: value, .. } => self.value(code, value),
            Returned::Result(value) => self.success(code, value),
        }
    }

    /// Runs statements; a value if one returns.
    fn statements(&mut self, code: &'c Code, all: &'c [Statement]) -> Evaluated<Option<Value>> {
        for statement in all {
            match statement {
                // Most statements of a function.
                Statement::Let(Pattern::Bound(slot), value)
                    if self.kind == Kind::Double && operation(code, *value)?.is_arithmetic() =>
                {
                    let number = self.computed::<f64>(code, *value)?;
                    self.set(*slot, Value::Number(number))?;
                }
                Statement::Let(pattern, value) => {
                    let value = self.value(code, *value)?;
                    if !self.bind(pattern, value)? {
                        return Err(Defect::new("a pattern that does not match").into());
                    }
                }
                Statement::Do(value) => {
                    self.value(code, *value)?;
                }
                Statement::Assign(place, value) => {
                    let value = self.value(code, *value)?;
                    self.assign(code, *place, value)?;
                }
                Statement::Return(value) => return self.returned(code, *value).map(Some),
                Statement::LetElse(pattern, value, otherwise) => {
                    let value = match self.found(code, *value) {
                        Ok(value) => value,
                        Err(failure) => match *failure {
                            Failure::Error(_) => Value::Absent,
                            other => return Err(Box::new(other)),
                        },
                    };
                    if !self.bind(pattern, value)? {
                        return self.returned(code, *otherwise).map(Some);
                    }
                }
                // The literal at the end has these members.
                Statement::Store(_) => {}
                Statement::Unless(conditions, inside) => {
                    let mut are_true = true;
                    for condition in conditions {
                        // As `&&`, the first that is false ends.
                        are_true = are_true && self.value(code, *condition)?.as_flag()?;
                    }
                    if !are_true && let Some(value) = self.statements(code, inside)? {
                        return Ok(Some(value));
                    }
                }
            }
        }
        Ok(None)
    }

    /// The value that a statement returns: that of the success of a fallible function.
    fn returned(&mut self, code: &'c Code, value: ValueId) -> Evaluated<Value> {
        if self.is_fallible { self.success(code, value) } else { self.value(code, value) }
    }

    /// Binds the variables of a pattern; false if the value is absent or an error where it must not be.
    fn bind(&mut self, pattern: &Pattern, value: Value) -> Evaluated<bool> {
        match pattern {
            Pattern::Bound(slot) | Pattern::Mutable(slot) | Pattern::Typed(slot, _) => self.set(*slot, value)?,
            Pattern::Ignored => {}
            Pattern::Case(_, inside) => {
                return match value {
                    Value::Absent => Ok(false),
                    Value::Outcome(outcome) => match &*outcome {
                        Ok(value) => self.bind(inside, value.clone()),
                        Err(_) => Ok(false),
                    },
                    value => self.bind(inside, value),
                };
            }
            Pattern::List(patterns) | Pattern::Tuple(patterns) => {
                let values = value.as_list()?;
                if values.len() != patterns.len() {
                    return Err(value.expected("a list of another length").into());
                }
                for (pattern, value) in patterns.iter().zip(values) {
                    self.bind(pattern, value.clone())?;
                }
            }
            Pattern::Struct { fields, .. } => {
                for (name, pattern) in fields {
                    let field = value.field(*name)?.clone();
                    self.bind(pattern, field)?;
                }
            }
        }
        Ok(true)
    }

    #[inline]
    fn set(&mut self, slot: Slot, value: Value) -> Evaluated<()> {
        let place = self.slots.get_mut(self.base + slot.index());
        *place.ok_or_else(|| Defect::new("a slot that does not exist"))? = value;
        Ok(())
    }

    pub(super) fn slot(&self, slot: Slot) -> Result<&Value, Defect> {
        self.slots.get(self.base + slot.index()).ok_or_else(|| Defect::new("a slot that does not exist"))
    }

    /// Replaces a part of a bound value.
    fn assign(&mut self, code: &'c Code, mut place: ValueId, value: Value) -> Evaluated<()> {
        let mut indices = Vec::new();
        let slot = loop {
            place = match operation(code, place)? {
                Operation::Given(slot) => break *slot,
                Operation::Index(of, index) => {
                    indices.push(*index);
                    *of
                }
                Operation::At(of, index) => {
                    match self.value(code, *index)? {
                        // All lanes at once.
                        Value::Absent => {}
                        index => indices.push(index.as_count()?),
                    }
                    *of
                }
                Operation::Borrowed(of) | Operation::MutablyBorrowed(of) | Operation::Dereferenced(of) => *of,
                _ => return Err(Defect::new("a place that is no part of a bound value").into()),
            };
        };
        let slot = self.slots.get_mut(self.base + slot.index());
        let mut part = slot.ok_or_else(|| Defect::new("a slot that does not exist"))?;
        for index in indices.into_iter().rev() {
            let Value::List(all) = part else { return Err(part.expected("a list").into()) };
            let entry = Rc::make_mut(all).get_mut(index);
            part = entry.ok_or_else(|| Defect::new("an entry that does not exist"))?;
        }
        *part = value;
        Ok(())
    }

    /// The value of an operation.
    pub(super) fn value(&mut self, code: &'c Code, id: ValueId) -> Evaluated<Value> {
        match operation(code, id)? {
            Operation::Given(slot) => Ok(self.slot(*slot)?.clone()),
            Operation::Constant(_)
            | Operation::Turn(..)
            | Operation::Sum(_)
            | Operation::Product(_)
            | Operation::Quotient(..)
            | Operation::Square(_)
            | Operation::Negative(_)
            | Operation::Call(..)
            | Operation::Intrinsic(Intrinsic::Square, ..) => match self.kind {
                Kind::Double => self.computed::<f64>(code, id).map(Scalar::into_value),
                Kind::Wide => self.computed::<Wide>(code, id).map(Scalar::into_value),
                Kind::Traced => self.computed::<Traced>(code, id).map(Scalar::into_value),
            },
            Operation::Exact(_) => Err(Defect::new("a number of any kind in a function of a scalar").into()),
            Operation::All(conditions) => self.all(code, conditions),
            Operation::Text(text) => Ok(Value::Text(Arc::clone(text))),
            Operation::Count(count) => Ok(Value::Count(*count as i64)),
            Operation::Path(Constant::Name) => Ok(Value::Text(Arc::clone(self.own_name()))),
            Operation::Path(Constant::False) => Ok(Value::Flag(false)),
            Operation::Path(Constant::Quantities) => Ok(Value::Flag(self.has_quantities)),
            Operation::Path(constant) => Ok(of_runtime(*constant)?),
            Operation::Field(of, name) => self.part(code, *of, |value| value.field(*name)),
            Operation::Member(of, index) | Operation::Index(of, index) => {
                self.part(code, *of, |value| entry(value, *index))
            }
            Operation::At(of, index) => match self.value(code, *index)? {
                // All lanes at once.
                Value::Absent => self.value(code, *of),
                index => {
                    let index = index.as_count()?;
                    self.part(code, *of, |value| entry(value, index))
                }
            },
            Operation::List(all) | Operation::Tuple(all) => self.list(code, all),
            Operation::Repeated(value, count) => {
                let value = self.value(code, *value)?;
                Ok(Value::list(std::iter::repeat_n(value, *count)))
            }
            Operation::Struct(of, fields, rest) => self.record(code, of, fields, *rest),
            // What takes a function as an argument knows it.
            Operation::Function(..) => Ok(Value::Absent),
            Operation::Closure { .. } => Ok(Value::Closure(id)),
            Operation::Block(block) => self.block(code, block, false),
            Operation::Try(inside) => self.success(code, *inside),
            // Values have no places but those of an assignment, and a matrix is its columns.
            Operation::Borrowed(of)
            | Operation::MutablyBorrowed(of)
            | Operation::Dereferenced(of)
            | Operation::Columns(of) => self.value(code, *of),
            Operation::UserFunction(place, arguments) => self.user(code, place.index(), arguments),
            Operation::Own(..) | Operation::Intrinsic(..) => {
                if !self.is_fallible(code, id)? {
                    return self.found(code, id);
                }
                match self.found(code, id) {
                    Ok(value) => Ok(Value::outcome(Ok(value))),
                    Err(failure) => match *failure {
                        Failure::Error(error) => Ok(Value::outcome(Err(error))),
                        other => Err(Box::new(other)),
                    },
                }
            }
        }
    }

    /// The value of the success of an expression, or its error: `expression?`. A value that is absent is returned.
    pub(super) fn success(&mut self, code: &'c Code, id: ValueId) -> Evaluated<Value> {
        match self.found(code, id)? {
            Value::Outcome(outcome) => match &*outcome {
                Ok(value) => Ok(value.clone()),
                Err(error) => Err(error.clone().into()),
            },
            Value::Absent => Err(Box::new(Failure::Return(Value::Absent))),
            value => Ok(value),
        }
    }

    /// The value of a call that succeeds, or its error; the value of any other operation.
    fn found(&mut self, code: &'c Code, id: ValueId) -> Evaluated<Value> {
        match operation(code, id)? {
            Operation::Own(receiver, place, arguments) => {
                let on = match receiver {
                    Receiver::Itself | Receiver::ItsType => {
                        let function = at(self.own_functions(), *place)?;
                        let arguments = self.values(code, arguments)?;
                        let own = self.slot(Slot::ITSELF)?.clone();
                        return self.call(self.of, function, own, arguments);
                    }
                    Receiver::Value(on) => Some(*on),
                    Receiver::Type(_) => None,
                };
                let function = at(&self.driver.functions, *place)?;
                let own = on.map_or(Ok(Value::Absent), |on| self.value(code, on))?;
                let arguments = self.values(code, arguments)?;
                // A mechanism or a pose in twice the precision has the functions of that scalar.
                let is_wide = std::iter::once(&own).chain(&arguments).any(is_wide);
                let last = self.kind;
                if is_wide {
                    self.kind = Kind::Wide;
                }
                let result = self.call(Of::Driver, function, own, arguments);
                self.kind = last;
                result
            }
            Operation::Intrinsic(of, of_type, arguments) => match self.of_type(*of)? {
                Some((function, of)) => {
                    let mut arguments = self.values(code, arguments)?.into_iter();
                    let own =
                        if function.is_method { arguments.next().unwrap_or(Value::Absent) } else { Value::Absent };
                    self.call(of, function, own, arguments)
                }
                None => self.operation(code, *of, of_type.as_deref(), arguments),
            },
            _ => self.value(code, id),
        }
    }

    /// The function of a pose or of a branch that an intrinsic is.
    fn of_type(&self, of: Intrinsic) -> Result<Option<(&'c Function, Of)>, Defect> {
        let (functions, of, name) = match of {
            Intrinsic::All => (&self.driver.of_branch, Of::Branch, "all"),
            Intrinsic::Coordinates => (&self.driver.of_pose, Of::Pose, "coordinates"),
            _ => return Ok(None),
        };
        let function = functions.iter().find(|function| function.name == name);
        let function = function.ok_or_else(|| Defect::new("a function that does not exist"))?;
        Ok(Some((function, of)))
    }

    /// True for a call of a function that can fail.
    fn is_fallible(&self, code: &'c Code, id: ValueId) -> Evaluated<bool> {
        Ok(match operation(code, id)? {
            Operation::Own(Receiver::Itself | Receiver::ItsType, place, _) => {
                at(self.own_functions(), *place)?.is_fallible
            }
            Operation::Own(_, place, _) => at(&self.driver.functions, *place)?.is_fallible,
            Operation::Intrinsic(of, ..) => match self.of_type(*of)? {
                Some((function, _)) => function.is_fallible,
                None => of.row().fails,
            },
            _ => false,
        })
    }

    pub(super) fn values(&mut self, code: &'c Code, ids: &[ValueId]) -> Evaluated<Values> {
        let mut values = Values::with_capacity(ids.len());
        for id in ids {
            values.push(self.value(code, *id)?);
        }
        Ok(values)
    }

    /// The list of these values. Its length is known, so that memory is taken once.
    fn list(&mut self, code: &'c Code, ids: &[ValueId]) -> Evaluated<Value> {
        let mut failed = None;
        let list = Value::list(ids.iter().map(|id| match failed {
            None => self.value(code, *id).unwrap_or_else(|failure| {
                failed = Some(failure);
                Value::Absent
            }),
            Some(_) => Value::Absent,
        }));
        failed.map_or(Ok(list), Err)
    }

    /// A part of a value, which is not copied if it is bound.
    fn part(
        &mut self,
        code: &'c Code,
        mut of: ValueId,
        part: impl FnOnce(&Value) -> Result<&Value, Defect>,
    ) -> Evaluated<Value> {
        loop {
            of = match operation(code, of)? {
                Operation::Given(slot) => return Ok(part(self.slot(*slot)?)?.clone()),
                Operation::Borrowed(inside) | Operation::Dereferenced(inside) => *inside,
                _ => break,
            };
        }
        let whole = self.value(code, of)?;
        Ok(part(&whole)?.clone())
    }

    fn record(
        &mut self,
        code: &'c Code,
        of: &Type,
        fields: &[(Name, ValueId)],
        rest: Option<ValueId>,
    ) -> Evaluated<Value> {
        let mut all = Vec::with_capacity(fields.len());
        for (name, value) in fields {
            // The mark of a type without numbers stands for its scalar.
            if !matches!(operation(code, *value)?, Operation::Path(Constant::Mark)) {
                all.push((*name, self.value(code, *value)?));
            }
        }
        if let Some(rest) = rest {
            let rest = self.value(code, rest)?;
            let others = rest.as_record()?.fields.iter();
            all.extend(others.filter(|(name, _)| !fields.iter().any(|(own, _)| own == name)).cloned());
        }
        let of = if let Type::Runtime(name, _) = of { name } else { "" };
        Ok(Value::Record(Rc::new(Record { of, fields: all })))
    }

    /// Statements and a value; that of its success if it is fallible.
    fn block(&mut self, code: &'c Code, block: &'c Block, is_fallible: bool) -> Evaluated<Value> {
        if let Some(value) = self.statements(code, &block.statements)? {
            return Err(Box::new(Failure::Return(value)));
        }
        if is_fallible { self.success(code, block.value) } else { self.value(code, block.value) }
    }

    /// Calls a function without a name: its value, or that of its success.
    pub(super) fn closure(
        &mut self,
        code: &'c Code,
        closure: &Value,
        arguments: impl IntoIterator<Item = Value>,
        is_fallible: bool,
    ) -> Evaluated<Value> {
        let Value::Closure(id) = closure else { return Err(closure.expected("a function").into()) };
        let Operation::Closure { arguments: patterns, body: block, .. } = operation(code, *id)? else {
            return Err(closure.expected("a function").into());
        };
        for (pattern, argument) in patterns.iter().zip(arguments) {
            self.bind(pattern, argument)?;
        }
        match self.block(code, block, is_fallible) {
            Err(failure) => match *failure {
                Failure::Return(value) => Ok(value),
                other => Err(Box::new(other)),
            },
            value => value,
        }
    }

    fn all(&mut self, code: &'c Code, conditions: &[ValueId]) -> Evaluated<Value> {
        let mut all = Flag::Constant(true);
        for condition in conditions {
            all = match self.value(code, *condition)? {
                Value::Flag(flag) => all.and(&Flag::Constant(flag)),
                Value::TracedFlag(flag) => all.and(&flag),
                other => return Err(other.expected("a flag").into()),
            };
        }
        Ok(match all {
            Flag::Constant(flag) => Value::Flag(flag),
            register => Value::TracedFlag(register),
        })
    }

    fn user(&mut self, code: &'c Code, place: usize, arguments: &[ValueId]) -> Evaluated<Value> {
        let mut numbers = Vec::with_capacity(arguments.len());
        for argument in arguments {
            numbers.push(self.number::<f64>(code, *argument)?);
        }
        let user = self.users.get(place).and_then(Option::as_ref);
        let user = user.ok_or_else(|| Defect::new("a user function that is not given"))?;
        let values = user(&numbers);
        Ok(match values.as_slice() {
            [only] => Value::Number(*only),
            several => Value::list(several.iter().copied().map(Value::Number)),
        })
    }

    /// The name of the mechanism or scene in errors.
    pub(super) fn own_name(&self) -> &'c Arc<str> {
        match (self.of, self.scene) {
            (Of::Scene, Some(scene)) => &scene.name,
            _ => &self.driver.name,
        }
    }
}

#[cold]
fn no_value() -> Defect {
    Defect::new("a value that does not exist")
}

#[inline(always)]
pub(super) fn operation(code: &Code, id: ValueId) -> Result<&Operation, Defect> {
    code.values.get(id.index()).ok_or_else(no_value)
}

/// Values side by side, few of them without memory of their own.
pub(super) type Values = SmallVec<[Value; 8]>;

fn at(all: &[Function], place: FunctionId) -> Result<&Function, Defect> {
    all.get(place.index()).ok_or_else(|| Defect::new("a function that does not exist"))
}

/// An entry of a list.
fn entry(value: &Value, index: usize) -> Result<&Value, Defect> {
    value.as_list()?.get(index).ok_or_else(|| Defect::new("an entry that does not exist"))
}

/// True if the numbers of a value have twice the precision.
fn is_wide(value: &Value) -> bool {
    let mut is_wide = false;
    value.each_leaf(&mut |leaf| is_wide |= matches!(leaf, Value::Wide(_)));
    is_wide
}
