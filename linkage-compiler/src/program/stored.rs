//! Results that a function stores as they become known: the variable that it returns, and what it assigns to its members.

use super::expression::{Expression, Pattern, Statement, Variable};
use super::function::{Body, Kernel, Stored, Value};
use linkage_ir::{Form, Intrinsic};

impl Body {
    /// Stores the members of its literal as they become known, in a place with this name. Results of a factorisation are
    /// refined at the end: they are not stored before.
    #[must_use]
    pub fn stored_in(mut self, place: &str) -> Self {
        let is_factorised = self.kernel.as_ref().is_some_and(Kernel::is_factorised);
        let literal = match &self.value {
            Value::Plain(literal) if !is_factorised => literal.clone(),
            _ => return self,
        };
        let [result, place] = ["result", place].map(|name| self.local(name));
        let [to_result, to_place] = [2, 1].map(|back| Variable::Local(self.locals.len() - back));
        let to_place = Box::new(Pattern::Bound(to_place));
        // The literal stands here and not in a function: LLVM copies the value that a function returns.
        let start = Expression::call(Intrinsic::Ok, [zeroed(&literal)]);
        self.before.push(Statement::Let(Pattern::Mutable(to_result), start));
        let borrowed = result.clone().mutably_borrowed();
        self.before.push(Statement::LetElse(Pattern::Case(Intrinsic::Ok, to_place), borrowed, result.clone()));
        let mut members = Vec::new();
        assigned(place, &literal, &mut members);
        // Points and outputs are checked, after all else.
        let checked = members.extract_if(.., |(_, value)| matches!(value, Expression::Try(_)));
        self.after.extend(checked.map(|(member, value)| Statement::Assign(member, value)));
        self.value = Value::Stored(Box::new(Stored { result, members, literal }));
        self
    }
}

/// A literal with zero in place of all but arguments.
fn zeroed(value: &Expression) -> Expression {
    match value {
        Expression::Struct(of, members, _) => {
            Expression::structure(of.clone(), members.iter().map(|(name, value)| (name.clone(), zeroed(value))))
        }
        Expression::Intrinsic(of, None, arguments) if of.row().form == Form::Function => {
            Expression::call(*of, arguments.iter().map(zeroed))
        }
        Expression::Try(inside) => zeroed(inside).tried(),
        Expression::List(all) if all.is_empty() => value.clone(),
        Expression::List(all) => {
            let one = all.first().map_or_else(Expression::zero, zeroed);
            Expression::Repeated(Box::new(one), all.len())
        }
        Expression::Constant(constant) => Expression::Constant(*constant),
        argument if argument.stored().is_some() => argument.clone(),
        _ => Expression::zero(),
    }
}

/// The members of a literal that are no arguments, with those of literals in it, and their values.
fn assigned(place: Expression, value: &Expression, all: &mut Vec<(Expression, Expression)>) {
    match value {
        Expression::Struct(_, fields, _) => {
            fields.iter().for_each(|(field, value)| assigned(place.clone().field(field), value, all));
        }
        argument if argument.stored().is_some() => {}
        Expression::List(all) if all.is_empty() => {}
        result => all.push((place, result.clone())),
    }
}
