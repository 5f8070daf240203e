//! Lowering of planned expressions, patterns and statements around a kernel, whose results are known.

use linkage_ir::ValueId;

use super::checks::Checked;
use super::naming::Hint;
use super::value::{Block, Pattern, Signed, Statement, Value};
use super::writer::Writer;
use crate::program::{self, Expression, Intrinsic, ROUGH, Receiver, Variable};

impl Writer<'_> {
    pub(super) fn planned(&mut self, statements: &[program::Statement], checked: &Checked) {
        statements.iter().for_each(|statement| self.planned_statement(statement, checked));
    }

    fn planned_statement(&mut self, statement: &program::Statement, checked: &Checked) {
        use program::Statement as S;
        match statement {
            S::Let(pattern, value) => {
                // A new value that gets a name is what the statement binds.
                let is_new = !matches!(value, Expression::Name(_) | Expression::Result(_) | Expression::Local(_));
                let value = self.expression(value, checked);
                if let program::Pattern::Bound(Variable::Name(name)) = pattern
                    && is_new
                {
                    self.values.bind(value, false);
                    self.hint(value, Hint::Fixed(name.clone()));
                    self.variables.insert(name.clone(), value);
                    self.let_itself(value);
                    return;
                }
                let pattern = self.planned_pattern(pattern);
                self.let_value(pattern, value);
            }
            S::Do(value) => {
                let value = self.expression(value, checked);
                self.statements.push(Statement::Do(value));
            }
            S::Assign(index, value) => {
                let [index, value] = [index, value].map(|part| self.expression(part, checked));
                self.statements.push(Statement::Assign(index, value));
            }
            S::LetElse(pattern, value, otherwise) => {
                let [value, otherwise] = [value, otherwise].map(|part| self.expression(part, checked));
                let pattern = self.planned_pattern(pattern);
                self.statements.push(Statement::LetElse(pattern, value, otherwise));
            }
            S::ReturnUnless(condition, value) => {
                let [condition, value] = [condition, value].map(|part| self.expression(part, checked));
                self.statements.push(Statement::Unless(vec![condition], vec![Statement::Return(value)]));
            }
            S::Refine(to, rough, precise) => {
                let mut value = self.expression(rough, checked);
                for factors in self.factors.values().copied().collect::<Vec<_>>() {
                    let outside = self.variables.clone();
                    let argument = self.fixed(ROUGH);
                    self.variables.insert(ROUGH.to_owned(), argument);
                    let body = Box::new(Block { statements: Vec::new(), value: self.expression(precise, checked) });
                    self.variables = outside;
                    let arguments = vec![Pattern::Bound(argument)];
                    let precise = self.add(Value::Closure { arguments, body, moves: false });
                    value = self.call(Intrinsic::Refined, [factors, value, precise]);
                }
                let to = self.planned_pattern(to);
                self.let_value(to, value);
            }
            S::Check { what, values, detail } => {
                let values = values.iter().filter(|value| !checked.is_proven(value)).collect::<Vec<_>>();
                let values = values.into_iter().map(|value| self.expression(value, checked)).collect();
                let detail = detail.as_ref().map(|detail| self.expression(detail, checked));
                self.check_finite(what, values, detail);
            }
            S::CheckPosition => self.check_position(checked),
            S::CheckKinematics { conditions, otherwise } => {
                let conditions = self.expressions(conditions, checked);
                let conditions = self.conditions(conditions, checked);
                if !conditions.is_empty() {
                    let otherwise = self.expression(otherwise, checked);
                    self.statements.push(Statement::Unless(conditions, vec![Statement::Return(otherwise)]));
                }
            }
            S::LetAccepted(to, conditions) => {
                let conditions = self.expressions(conditions, checked);
                let mut all = self.flags.clone();
                all.extend(self.conditions(conditions, checked));
                self.let_all(to, all);
            }
            S::LetPassed(to) => self.let_all(to, self.flags.clone()),
        }
    }

    pub(super) fn planned_pattern(&mut self, pattern: &program::Pattern<Variable>) -> Pattern {
        let names = self.context.names;
        pattern.clone().map(
            &mut |variable| match variable {
                Variable::Name(name) => {
                    let id = self.fixed(&name);
                    self.variables.insert(name, id);
                    id
                }
                Variable::Local(index) => self.local(index),
            },
            &mut |field| names.borrow_mut().of(&field),
        )
    }

    fn local(&mut self, index: usize) -> ValueId {
        match self.locals.get(index) {
            Some(id) => *id,
            None => self.dangle(|| format!("local value {index}")),
        }
    }

    fn expressions(&mut self, values: &[Expression], checked: &Checked) -> Vec<ValueId> {
        values.iter().map(|value| self.expression(value, checked)).collect()
    }

    pub(super) fn expression(&mut self, value: &Expression, checked: &Checked) -> ValueId {
        use Expression as E;
        let value = match value {
            E::Name(name) => return self.variable(name),
            E::Result(index) => {
                return match checked.results.get(*index) {
                    Some(result) => *result,
                    None => self.dangle(|| format!("result {index} of the kernel")),
                };
            }
            E::Local(index) => return self.local(*index),
            E::Number(number) => Value::Constant(*number),
            E::Sum(terms) => Value::Sum(self.expressions(terms, checked).into_iter().map(Signed::positive).collect()),
            E::Product(factors) => Value::Product(self.expressions(factors, checked)),
            E::Negative(inside) => Value::Negative(self.expression(inside, checked)),
            E::Elementary(function, arguments) => {
                let arguments = self.expressions(arguments, checked).into_iter().map(Signed::positive).collect();
                Value::Call(*function, arguments)
            }
            E::All(conditions) => Value::All(self.expressions(conditions, checked)),
            E::Text(text) => Value::Text(text.as_str().into()),
            E::Count(count) => Value::Count(*count),
            E::Constant(constant) => Value::Path(*constant),
            E::Field(of, name) => return self.planned_field(of, name, checked),
            E::Index(of, index) => Value::Index(self.expression(of, checked), *index),
            E::At(parts) => {
                let [of, index] = [&parts[0], &parts[1]].map(|part| self.expression(part, checked));
                Value::At(of, index)
            }
            E::List(all) => Value::List(self.expressions(all, checked)),
            E::Repeated(value, count) => Value::Repeated(self.expression(value, checked), *count),
            E::Tuple(all) => Value::Tuple(self.expressions(all, checked)),
            E::Struct(of, members, rest) => {
                let members = members
                    .iter()
                    .map(|(field, value)| (self.field_name(field), self.expression(value, checked)))
                    .collect();
                let rest = rest.as_ref().map(|rest| self.expression(rest, checked));
                Value::Struct(Box::new(of.clone()), members, rest)
            }
            E::Intrinsic(of, None, arguments) => {
                let arguments = self.expressions(arguments, checked);
                return self.call(*of, arguments);
            }
            E::Intrinsic(of, of_type, arguments) => {
                Value::Intrinsic(*of, of_type.clone().map(Box::new), self.expressions(arguments, checked))
            }
            E::Function(of, of_type) => Value::Function(*of, of_type.clone().map(Box::new)),
            E::Own(receiver, name, arguments) => return self.own(receiver, name, arguments, checked),
            E::Try(inside) => Value::Try(self.expression(inside, checked)),
            E::Borrowed(inside) => Value::Borrowed(self.expression(inside, checked)),
            E::MutablyBorrowed(inside) => Value::MutablyBorrowed(self.expression(inside, checked)),
            E::Dereferenced(inside) => Value::Dereferenced(self.expression(inside, checked)),
            E::Closure { arguments, statements, value, moves } => {
                let outside = self.variables.clone();
                let arguments = arguments.iter().map(|argument| self.planned_pattern(argument)).collect();
                let body = self.block(statements, value, checked);
                self.variables = outside;
                Value::Closure { arguments, body, moves: *moves }
            }
            E::Block(statements, value) => {
                let outside = self.variables.clone();
                let block = self.block(statements, value, checked);
                self.variables = outside;
                Value::Block(block)
            }
        };
        self.add(value)
    }

    /// A field by its name, an entry of a tuple, or the columns of a matrix.
    fn planned_field(&mut self, of: &Expression, name: &str, checked: &Checked) -> ValueId {
        if let (Expression::Field(matrix, data), "0") = (of, name)
            && data == "data"
        {
            let matrix = self.expression(matrix, checked);
            return self.add(Value::Columns(matrix));
        }
        let of = self.expression(of, checked);
        match name.parse() {
            Ok(place) => self.add(Value::Member(of, place)),
            Err(_) => self.field(of, name),
        }
    }

    fn block(&mut self, statements: &[program::Statement], value: &Expression, checked: &Checked) -> Box<Block> {
        let before = std::mem::take(&mut self.statements);
        self.planned(statements, checked);
        let value = self.expression(value, checked);
        Box::new(Block { statements: std::mem::replace(&mut self.statements, before), value })
    }

    /// A call of a function of the program.
    fn own(
        &mut self,
        receiver: &Receiver<Expression>,
        name: &str,
        arguments: &[Expression],
        checked: &Checked,
    ) -> ValueId {
        let (functions, receiver) = match receiver {
            Receiver::Itself => (self.context.own, Receiver::Itself),
            Receiver::ItsType => (self.context.own, Receiver::ItsType),
            Receiver::Value(of) => (self.context.of_driver, Receiver::Value(self.expression(of, checked))),
            Receiver::Type(of) => (self.context.of_driver, Receiver::Type(of.clone())),
        };
        let arguments = self.expressions(arguments, checked);
        match functions.get(name) {
            Some(function) => self.add(Value::Own(receiver, *function, arguments)),
            None => self.dangle(|| format!("the function `{name}`")),
        }
    }
}
