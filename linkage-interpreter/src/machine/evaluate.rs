//! Statements and expressions.

use std::rc::Rc;
use std::sync::Arc;

use super::defect::Defect;
use super::failure::{Evaluated, Failure};
use super::operations::of_runtime;
use super::scalar::Scalar;
use super::value::Value;
use super::{Kind, Machine, Of};
use crate::code::{Block, Expression, Function, Id, Pattern, Place, Returned, Slot, Statement};
use crate::tape::{Flag, Traced};
use linkage_runtime::__rt::Wide;
use smallvec::SmallVec;

impl<'c> Machine<'c> {
    /// Runs the statements of a function, and returns its value: that of its success if it is fallible.
    pub(super) fn body(&mut self, code: &'c Function) -> Evaluated<Value> {
        if let Some(value) = self.statements(code, &code.statements)? {
            return Ok(value);
        }
        match code.value {
            Returned::Plain(value) => self.value(code, value),
            Returned::Outcome(value) => self.success(code, value),
        }
    }

    /// Runs statements; a value if one returns.
    fn statements(&mut self, code: &'c Function, all: &'c [Statement]) -> Evaluated<Option<Value>> {
        for statement in all {
            match statement {
                // Most statements of a function.
                Statement::Let(Pattern::Bound(slot), value)
                    if self.kind == Kind::Double && Self::expression(code, *value)?.is_arithmetic() =>
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
                    self.assign(code, place, value)?;
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
    fn returned(&mut self, code: &'c Function, value: Id) -> Evaluated<Value> {
        if code.is_fallible { self.success(code, value) } else { self.value(code, value) }
    }

    /// Binds the variables of a pattern; false if the value is absent or an error where it must not be.
    fn bind(&mut self, pattern: &Pattern, value: Value) -> Evaluated<bool> {
        match pattern {
            Pattern::Bound(slot) => self.set(*slot, value)?,
            Pattern::Ignored => {}
            Pattern::Present(inside) => {
                return match value {
                    Value::Absent => Ok(false),
                    Value::Outcome(outcome) => match &*outcome {
                        Ok(value) => self.bind(inside, value.clone()),
                        Err(_) => Ok(false),
                    },
                    value => self.bind(inside, value),
                };
            }
            Pattern::List(patterns) => {
                let values = value.as_list()?;
                if values.len() != patterns.len() {
                    return Err(value.expected("a list of another length").into());
                }
                for (pattern, value) in patterns.iter().zip(values) {
                    self.bind(pattern, value.clone())?;
                }
            }
            Pattern::Record(fields) => {
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
        let place = self.slots.get_mut(self.base + slot.0 as usize);
        *place.ok_or_else(|| Defect::new("a slot that does not exist"))? = value;
        Ok(())
    }

    fn slot(&self, slot: Slot) -> Result<&Value, Defect> {
        self.slots.get(self.base + slot.0 as usize).ok_or_else(|| Defect::new("a slot that does not exist"))
    }

    /// Replaces a part of a bound value.
    fn assign(&mut self, code: &'c Function, place: &'c Place, value: Value) -> Evaluated<()> {
        let mut indices = Vec::with_capacity(place.at.len());
        for index in &place.at {
            match self.value(code, *index)? {
                // All lanes at once.
                Value::Absent => {}
                index => indices.push(index.as_count()?),
            }
        }
        let base = self.base;
        let slot = self.slots.get_mut(base + place.of.0 as usize);
        let mut part = slot.ok_or_else(|| Defect::new("a slot that does not exist"))?;
        for index in indices {
            let Value::List(all) = part else { return Err(part.expected("a list").into()) };
            let entry = Rc::make_mut(all).get_mut(index);
            part = entry.ok_or_else(|| Defect::new("an entry that does not exist"))?;
        }
        *part = value;
        Ok(())
    }

    fn expression(code: &'c Function, id: Id) -> Result<&'c Expression, Defect> {
        code.expressions.get(id.0 as usize).ok_or_else(|| Defect::new("an expression that does not exist"))
    }

    /// The value of an expression.
    pub(super) fn value(&mut self, code: &'c Function, id: Id) -> Evaluated<Value> {
        match Self::expression(code, id)? {
            Expression::Slot(slot) => Ok(self.slot(*slot)?.clone()),
            Expression::Number(_)
            | Expression::Sum(_)
            | Expression::Product(_)
            | Expression::Quotient(..)
            | Expression::Square(_)
            | Expression::Negative(_)
            | Expression::Call(..) => match self.kind {
                Kind::Double => self.number::<f64>(code, id).map(Scalar::into_value),
                Kind::Wide => self.number::<Wide>(code, id).map(Scalar::into_value),
                Kind::Traced => self.number::<Traced>(code, id).map(Scalar::into_value),
            },
            Expression::All(conditions) => self.all(code, conditions),
            Expression::Flag(flag) => Ok(Value::Flag(*flag)),
            Expression::Quantities => Ok(Value::Flag(self.has_quantities)),
            Expression::Text(text) => Ok(Value::Text(Arc::clone(text))),
            Expression::OwnName => Ok(Value::Text(Arc::clone(self.own_name()))),
            Expression::Count(count) => Ok(Value::Count(*count as i64)),
            Expression::Absent => Ok(Value::Absent),
            Expression::Field(of, name) => self.part(code, *of, |value| value.field(*name)),
            Expression::Index(of, index) => self.part(code, *of, |value| entry(value, *index)),
            Expression::At(of, index) => match self.value(code, *index)? {
                // All lanes at once.
                Value::Absent => self.value(code, *of),
                index => {
                    let index = index.as_count()?;
                    self.part(code, *of, |value| entry(value, index))
                }
            },
            Expression::List(all) => self.list(code, all),
            Expression::Repeated(value, count) => {
                let value = self.value(code, *value)?;
                Ok(Value::list(std::iter::repeat_n(value, *count)))
            }
            Expression::Record(of, fields, rest) => self.record(code, *of, fields, *rest),
            Expression::Closure(..) => Ok(Value::Closure(id)),
            Expression::Block(block) => self.block(code, block, false),
            Expression::Try(inside) => self.success(code, *inside),
            Expression::Intrinsic(of, _) if !of.row().fails => self.found(code, id),
            Expression::OfRuntime(constant) => Ok(of_runtime(*constant)?),
            Expression::Made(of, value) => {
                let value = self.value(code, *value)?;
                Ok(self.made(*of, &value)?)
            }
            Expression::User(place, arguments) => self.user(code, *place, arguments),
            Expression::Own(..) | Expression::OfMechanism(..) | Expression::OfType(..) | Expression::Intrinsic(..) => {
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
    pub(super) fn success(&mut self, code: &'c Function, id: Id) -> Evaluated<Value> {
        match self.found(code, id)? {
            Value::Outcome(outcome) => match &*outcome {
                Ok(value) => Ok(value.clone()),
                Err(error) => Err(error.clone().into()),
            },
            Value::Absent => Err(Box::new(Failure::Return(Value::Absent))),
            value => Ok(value),
        }
    }

    /// The value of a call that succeeds, or its error; the value of any other expression.
    fn found(&mut self, code: &'c Function, id: Id) -> Evaluated<Value> {
        match Self::expression(code, id)? {
            Expression::Own(place, arguments) => {
                let function = at(self.own_functions(), *place)?;
                let arguments = self.values(code, arguments)?;
                let own = self.slot(Slot(0))?.clone();
                self.call(self.of, function, own, arguments)
            }
            Expression::OfMechanism(on, place, arguments) => {
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
            Expression::OfType(of, place, arguments) => {
                let (functions, of) = self.of_type(*of);
                let function = at(functions, *place)?;
                let mut arguments = self.values(code, arguments)?.into_iter();
                let own = if function.is_method { arguments.next().unwrap_or(Value::Absent) } else { Value::Absent };
                self.call(of, function, own, arguments)
            }
            Expression::Intrinsic(of, arguments) => self.operation(code, *of, arguments),
            _ => self.value(code, id),
        }
    }

    /// True for a call of a function that can fail.
    fn is_fallible(&self, code: &'c Function, id: Id) -> Evaluated<bool> {
        Ok(match Self::expression(code, id)? {
            Expression::Own(place, _) => at(self.own_functions(), *place)?.is_fallible,
            Expression::OfMechanism(_, place, _) => at(&self.driver.functions, *place)?.is_fallible,
            Expression::OfType(of, place, _) => at(self.of_type(*of).0, *place)?.is_fallible,
            Expression::Intrinsic(of, _) => of.row().fails,
            _ => false,
        })
    }

    pub(super) fn values(&mut self, code: &'c Function, ids: &[Id]) -> Evaluated<Values> {
        let mut values = Values::with_capacity(ids.len());
        for id in ids {
            values.push(self.value(code, *id)?);
        }
        Ok(values)
    }

    /// The list of these values. Its length is known, so that memory is taken once.
    fn list(&mut self, code: &'c Function, ids: &[Id]) -> Evaluated<Value> {
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
        code: &'c Function,
        of: Id,
        part: impl FnOnce(&Value) -> Result<&Value, Defect>,
    ) -> Evaluated<Value> {
        if let Expression::Slot(slot) = Self::expression(code, of)? {
            return Ok(part(self.slot(*slot)?)?.clone());
        }
        let whole = self.value(code, of)?;
        Ok(part(&whole)?.clone())
    }

    fn record(
        &mut self,
        code: &'c Function,
        of: crate::code::Name,
        fields: &[(crate::code::Name, Id)],
        rest: Option<Id>,
    ) -> Evaluated<Value> {
        let mut all = Vec::with_capacity(fields.len());
        for (name, value) in fields {
            all.push((*name, self.value(code, *value)?));
        }
        if let Some(rest) = rest {
            let rest = self.value(code, rest)?;
            let others = rest.as_record()?.fields.iter();
            all.extend(others.filter(|(name, _)| !fields.iter().any(|(own, _)| own == name)).cloned());
        }
        Ok(Value::record(of, all))
    }

    /// Statements and a value; that of its success if it is fallible.
    fn block(&mut self, code: &'c Function, block: &'c Block, is_fallible: bool) -> Evaluated<Value> {
        if let Some(value) = self.statements(code, &block.statements)? {
            return Err(Box::new(Failure::Return(value)));
        }
        if is_fallible { self.success(code, block.value) } else { self.value(code, block.value) }
    }

    /// Calls a function without a name: its value, or that of its success.
    pub(super) fn closure(
        &mut self,
        code: &'c Function,
        closure: &Value,
        arguments: impl IntoIterator<Item = Value>,
        is_fallible: bool,
    ) -> Evaluated<Value> {
        let Value::Closure(id) = closure else { return Err(closure.expected("a function").into()) };
        let Expression::Closure(patterns, block) = Self::expression(code, *id)? else {
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

    fn all(&mut self, code: &'c Function, conditions: &[Id]) -> Evaluated<Value> {
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

    fn user(&mut self, code: &'c Function, place: usize, arguments: &[Id]) -> Evaluated<Value> {
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

    /// The number that an expression computes, in the order of emitted code.
    #[inline]
    pub(super) fn number<S: Scalar>(&mut self, code: &'c Function, id: Id) -> Evaluated<S> {
        // Most operands of an operation.
        if let Some(Expression::Slot(slot)) = code.expressions.get(id.0 as usize)
            && let Some(number) = self.slots.get(self.base + slot.0 as usize).and_then(S::of)
        {
            return Ok(number);
        }
        self.computed(code, id)
    }

    fn computed<S: Scalar>(&mut self, code: &'c Function, id: Id) -> Evaluated<S> {
        let first = |all: &'c [Id]| all.split_first().ok_or_else(|| Defect::new("an operation on nothing"));
        Ok(match Self::expression(code, id)? {
            Expression::Slot(slot) => {
                let value = self.slot(*slot)?;
                S::of(value).ok_or_else(|| value.expected("a number"))?
            }
            Expression::Number(constant) => S::constant(*constant),
            Expression::Sum(terms) => {
                let mut terms = terms.iter();
                let (is_negative, first) = terms.next().ok_or_else(|| Defect::new("an operation on nothing"))?;
                let first = self.number::<S>(code, *first)?;
                let mut sum = if *is_negative { first.negative() } else { first };
                for (is_negative, term) in terms {
                    let term = self.number::<S>(code, *term)?;
                    sum = if *is_negative { sum.minus(&term) } else { sum.plus(&term) };
                }
                sum
            }
            Expression::Product(factors) => {
                let (first, others) = first(factors)?;
                let mut product = self.number::<S>(code, *first)?;
                for factor in others {
                    product = product.times(&self.number::<S>(code, *factor)?);
                }
                product
            }
            Expression::Quotient(above, below) => {
                let above = self.number::<S>(code, *above)?;
                above.over(&self.number::<S>(code, *below)?)
            }
            Expression::Square(base) => {
                let base = self.number::<S>(code, *base)?;
                base.clone().times(&base)
            }
            Expression::Negative(inside) => self.number::<S>(code, *inside)?.negative(),
            Expression::Call(function, arguments) => match arguments.as_slice() {
                [only] => S::call(*function, &[self.number(code, *only)?])?,
                [one, other] => S::call(*function, &[self.number(code, *one)?, self.number(code, *other)?])?,
                several => {
                    let several: Vec<S> =
                        several.iter().map(|argument| self.number(code, *argument)).collect::<Evaluated<_>>()?;
                    S::call(*function, &several)?
                }
            },
            _ => {
                let value = self.value(code, id)?;
                S::of(&value).ok_or_else(|| value.expected("a number"))?
            }
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

/// Values side by side, few of them without memory of their own.
pub(super) type Values = SmallVec<[Value; 8]>;

fn at<T>(all: &[T], place: usize) -> Result<&T, Defect> {
    all.get(place).ok_or_else(|| Defect::new("a function that does not exist"))
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
