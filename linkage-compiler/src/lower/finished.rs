//! Statements around a kernel, with the names of its results: checks, and the value that a function returns.

use rustc_hash::FxHashSet;

use super::formulas::{Formulas, is_formula};
use crate::program::{Expression, Pattern, ROUGH, Statement};

/// Replaces indices of results and local values by their expressions and names.
pub(super) struct Finished<'a> {
    pub(super) results: &'a [Expression],
    pub(super) locals: &'a [String],
}

impl Finished<'_> {
    pub(super) fn statement(&self, statement: Statement, formulas: &Formulas, out: &mut Vec<Statement>) {
        match statement {
            Statement::Let(pattern, value) => {
                out.push(Statement::Let(self.pattern(pattern), self.expression(value)));
            }
            Statement::Do(value) => out.push(Statement::Do(self.expression(value))),
            Statement::Assign(place, value) => {
                out.push(Statement::Assign(self.expression(place), self.expression(value)));
            }
            Statement::Check { what, values, detail } => {
                let is_proven = |value: &Expression| match value {
                    Expression::Result(place) => formulas.is_proven.get(*place).copied().unwrap_or_default(),
                    _ => false,
                };
                let unproven = values.into_iter().filter(|value| !is_proven(value)).collect();
                let values = self.expressions(unproven);
                out.extend(check(&what, values, detail));
            }
            Statement::Refine(to, rough, precise) => {
                let (rough, precise) = (self.expression(rough), self.expression(precise));
                let value = formulas.factors.iter().fold(rough, |rough, factors| {
                    let value = Box::new(precise.clone());
                    let arguments = vec![Pattern::Name(ROUGH.to_owned())];
                    let precise = Expression::Closure { arguments, statements: vec![], value, moves: false };
                    Expression::name(factors).method("refined", [rough, precise])
                });
                out.push(Statement::Let(self.pattern(to), value));
            }
            Statement::CheckPosition => self.check_position(formulas, out),
            Statement::CheckKinematics { conditions, otherwise } => {
                self.check_kinematics(conditions, otherwise, formulas, out);
            }
            Statement::LetAccepted(to, checks) => {
                let mut conditions = formulas.flags.clone();
                conditions.extend(self.conditions(checks, formulas));
                self.let_all(to, conditions, formulas, out);
            }
            Statement::LetPassed(to) => self.let_all(to, formulas.flags.clone(), formulas, out),
            Statement::Return(value) => out.push(Statement::Return(self.expression(value))),
            Statement::LetElse(pattern, value, otherwise) => {
                let otherwise = self.expression(otherwise);
                out.push(Statement::LetElse(self.pattern(pattern), self.expression(value), otherwise));
            }
            Statement::Unless(conditions, inside) => {
                let mut lines = Vec::new();
                for statement in inside {
                    self.statement(statement, formulas, &mut lines);
                }
                out.push(Statement::Unless(self.expressions(conditions), lines));
            }
        }
    }

    /// Binds true if all conditions are true. Each has a name, so that none of them is skipped by a branch.
    fn let_all(&self, to: Pattern, conditions: Vec<Expression>, formulas: &Formulas, out: &mut Vec<Statement>) {
        if let [only] = conditions.as_slice() {
            out.push(Statement::Let(self.pattern(to), only.clone()));
            return;
        }
        let mut taken = formulas.taken.clone();
        let names = conditions.into_iter().map(|condition| match condition {
            Expression::Name(_) => condition,
            call => {
                let name = taken.unique(condition_name(&call));
                out.push(Statement::Let(Pattern::Name(name.clone()), call));
                Expression::Name(name)
            }
        });
        let all = names.collect();
        out.push(Statement::Let(self.pattern(to), Expression::All(all)));
    }

    /// Adds the checks of a position; numbers of dyads are checked only if a triangle is not well conditioned.
    fn check_position(&self, formulas: &Formulas, out: &mut Vec<Statement>) {
        let unproven = self.results.iter().zip(&formulas.dyads).zip(&formulas.is_proven);
        let unproven = unproven.filter(|(_, is_proven)| !**is_proven).map(|(value, _)| value);
        let (of_dyads, others): (Vec<_>, Vec<_>) = unproven.partition(|(_, dyad)| dyad.is_some());
        let [of_dyads, others] = [of_dyads, others]
            .map(|values| check("the position", values.into_iter().map(|(value, _)| value.clone()).collect(), None));
        out.extend(others);
        let well_conditioned: Vec<Expression> = formulas.well_conditioned.iter().map(Expression::name).collect();
        if well_conditioned.is_empty() {
            out.extend(of_dyads);
        } else if let Some(of_dyads) = of_dyads {
            out.push(Statement::Unless(well_conditioned, vec![of_dyads]));
        }
    }

    /// Adds the check of a position and its motion. The directions of dyads are finite: their chords are regular.
    fn check_kinematics(
        &self,
        conditions: Vec<Expression>,
        otherwise: Expression,
        formulas: &Formulas,
        out: &mut Vec<Statement>,
    ) {
        let conditions = self.conditions(conditions, formulas);
        if !conditions.is_empty() {
            out.push(Statement::Unless(conditions, vec![Statement::Return(otherwise)]));
        }
    }

    /// These conditions, and that results are finite.
    fn conditions(&self, conditions: Vec<Expression>, formulas: &Formulas) -> Vec<Expression> {
        let mut conditions = self.expressions(conditions);
        let numbers = self.results.iter().zip(&formulas.dyads).zip(&formulas.is_proven);
        let unproven = numbers.filter(|((_, dyad), is_proven)| dyad.is_none() && !**is_proven);
        let numbers = to_check(unproven.map(|((value, _), _)| value.clone()).collect());
        if !numbers.is_empty() {
            conditions.push(Expression::all_finite(numbers));
        }
        conditions
    }

    fn expressions(&self, values: Vec<Expression>) -> Vec<Expression> {
        values.into_iter().map(|value| self.expression(value)).collect()
    }

    pub(super) fn expression(&self, value: Expression) -> Expression {
        use Expression as E;
        match value {
            E::Result(place) => self.results[place].clone(),
            E::Local(place) => E::Name(self.locals[place].clone()),
            E::Sum(terms) => {
                E::Sum(terms.into_iter().map(|(negative, term)| (negative, self.expression(term))).collect())
            }
            E::Product(factors) => E::Product(self.expressions(factors)),
            E::Quotient(parts) => E::Quotient(Box::new(parts.map(|part| self.expression(part)))),
            E::Square(value) => E::Square(Box::new(self.expression(*value))),
            E::Negative(value) => E::Negative(Box::new(self.expression(*value))),
            E::Elementary(function, arguments) => E::Elementary(function, self.expressions(arguments)),
            E::All(conditions) => E::All(self.expressions(conditions)),
            E::Field(value, name) => E::Field(Box::new(self.expression(*value)), name),
            E::Index(value, place) => E::Index(Box::new(self.expression(*value)), place),
            E::At(parts) => E::At(Box::new(parts.map(|part| self.expression(part)))),
            E::List(values) => E::List(self.expressions(values)),
            E::Repeated(value, count) => E::Repeated(Box::new(self.expression(*value)), count),
            E::Tuple(values) => E::Tuple(self.expressions(values)),
            E::Struct(of, members, rest) => {
                let members = members.into_iter().map(|(name, value)| (name, self.expression(value))).collect();
                E::Struct(of, members, rest.map(|rest| Box::new(self.expression(*rest))))
            }
            E::Runtime(name, arguments) => E::Runtime(name, self.expressions(arguments)),
            E::Associated(of, name, arguments) => E::Associated(of, name, self.expressions(arguments)),
            E::Method(value, name, arguments) => {
                E::Method(Box::new(self.expression(*value)), name, self.expressions(arguments))
            }
            E::Try(value) => E::Try(Box::new(self.expression(*value))),
            E::Borrowed(value) => E::Borrowed(Box::new(self.expression(*value))),
            E::MutablyBorrowed(value) => E::MutablyBorrowed(Box::new(self.expression(*value))),
            E::Dereferenced(value) => E::Dereferenced(Box::new(self.expression(*value))),
            E::Closure { arguments, statements, value, moves } => {
                E::Closure { arguments, statements, value: Box::new(self.expression(*value)), moves }
            }
            E::Block(statements, value) => E::Block(statements, Box::new(self.expression(*value))),
            finished @ (E::Name(_)
            | E::Number(_)
            | E::Exact(_)
            | E::Text(_)
            | E::Count(_)
            | E::Constant(_)
            | E::Function(..)) => finished,
        }
    }

    fn pattern(&self, pattern: Pattern) -> Pattern {
        let all = |patterns: Vec<Pattern>| patterns.into_iter().map(|pattern| self.pattern(pattern)).collect();
        match pattern {
            Pattern::Local(place) => Pattern::Name(self.locals[place].clone()),
            Pattern::Mutable(inside) => Pattern::Mutable(Box::new(self.pattern(*inside))),
            Pattern::Case(case, inside) => Pattern::Case(case, Box::new(self.pattern(*inside))),
            Pattern::List(patterns) => Pattern::List(all(patterns)),
            Pattern::Tuple(patterns) => Pattern::Tuple(all(patterns)),
            finished => finished,
        }
    }
}

/// A name for the result of a check.
fn condition_name(call: &Expression) -> &'static str {
    match call {
        Expression::Runtime(function, _) => function.trim_start_matches("lane::"),
        _ => "are_finite",
    }
}

/// Each value once, without zero and one.
fn to_check(values: Vec<Expression>) -> Vec<Expression> {
    let mut seen = FxHashSet::default();
    let values = values.into_iter().filter(|value| match value {
        Expression::Name(name) => seen.insert(name.clone()),
        other => is_formula(other),
    });
    values.collect()
}

/// `finite(NAME, what, [values])?;`; `None` if all values are zero or one.
fn check(what: &str, values: Vec<Expression>, detail: Option<Expression>) -> Option<Statement> {
    let values = to_check(values);
    if values.is_empty() {
        return None;
    }
    let check = [Expression::mechanism(), Expression::text(what), Expression::List(values)];
    let check = Expression::runtime("finite", check);
    let check = match detail {
        Some(detail) => check.method("or_else", [detail]),
        None => check,
    };
    Some(Statement::Do(check.tried()))
}
