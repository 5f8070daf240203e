//! Conversion of the lines of a schedule to statements with names.

use std::collections::{BTreeMap, BTreeSet};

use super::names::Names;
use super::schedule::{Circular, Line, Schedule};
use super::value::{Signed, Value, ValueId};
use super::{stretches, terms};
use crate::derivation::Derivation;
use crate::graph::{ExternalId, Function, SymbolId};
use crate::ids::BlockId;
use crate::program::{Expression, Failure, Kernel, Pattern, Statement, Type, call_of};

/// Converts the lines of one schedule.
pub(super) struct Writer<'a, 'n> {
    pub(super) derivation: &'a Derivation,
    pub(super) kernel: &'a Kernel,
    /// The names of the arguments for the branch, the turns, and the positions of groups that are kept.
    pub(super) branch: &'a str,
    pub(super) turn: &'a str,
    pub(super) memory: &'a str,
    pub(super) schedule: &'a Schedule,
    pub(super) names: Names<'n>,
    pub(super) statements: Vec<Statement>,
    /// The user functions that are called.
    pub(super) externals: BTreeSet<ExternalId>,
    /// For each dyad with unproven results, the name of the flag that is true if its triangle is well conditioned.
    pub(super) well_conditioned: BTreeMap<BlockId, Option<String>>,
    /// The checks, if a failed one is only flagged.
    pub(super) flags: Vec<Expression>,
    /// The factorisations, by block.
    pub(super) factors: BTreeMap<BlockId, String>,
}

impl<'a, 'n> Writer<'a, 'n> {
    pub(super) fn new(
        (derivation, kernel): (&'a Derivation, &'a Kernel),
        [branch, turn, memory]: [&'a str; 3],
        schedule: &'a Schedule,
        names: Names<'n>,
    ) -> Self {
        Self {
            derivation,
            kernel,
            branch,
            turn,
            memory,
            schedule,
            names,
            statements: Vec::new(),
            externals: BTreeSet::new(),
            well_conditioned: BTreeMap::new(),
            flags: Vec::new(),
            factors: BTreeMap::new(),
        }
    }

    pub(super) fn write(&mut self) {
        let schedule: &'a Schedule = self.schedule;
        for line in &schedule.lines {
            self.line(line);
        }
        if self.is_flagged() {
            for &id in schedule.used() {
                self.flag_range(schedule.value(id));
            }
        }
    }

    /// True if a failed check is only flagged.
    pub(super) fn is_flagged(&self) -> bool {
        matches!(self.kernel.failure, Failure::Flag)
    }

    /// True if it computes with numbers of any kind.
    fn is_exact(&self) -> bool {
        self.kernel.any_number.is_some()
    }

    /// Flags arguments for which the form of a function without branches has another value.
    fn flag_range(&mut self, value: &'a Value) {
        let Value::Call(function, arguments) = value else { return };
        let check = match function {
            Function::Sin | Function::Cos => "lane::is_moderate",
            Function::Atan2 => "lane::has_arctangent2",
            Function::Hypot => "lane::has_hypotenuse",
            _ => return,
        };
        let check = Expression::runtime(check, self.all_signed(arguments));
        if !self.flags.contains(&check) {
            self.flags.push(check);
        }
    }

    fn line(&mut self, line: &'a Line) {
        match line {
            Line::Let(id) => {
                // The operands are written before the value gets its name.
                match self.schedule.name(*id) {
                    Some((preferred, true)) => {
                        let value = self.signed(Signed { negative: true, value: *id });
                        let name = self.names.give_negative(*id, preferred);
                        self.let_name(name, value);
                    }
                    _ => {
                        let value = self.signed(Signed { negative: false, value: *id });
                        let name = self.names.invent(self.schedule, *id);
                        self.let_name(name, value);
                    }
                }
            }
            Line::SineCosine(one) => {
                let angle = self.signed(one.angle);
                let call = match self.is_flagged() {
                    true => Expression::runtime("lane::sine_cosine", [angle]),
                    false => angle.method("sine_cosine", []),
                };
                let pair = self.pair(one);
                self.let_pattern(pair, call);
            }
            Line::SinesCosines(several) if self.is_flagged() => {
                for one in several {
                    let call = Expression::runtime("lane::sine_cosine", [self.signed(one.angle)]);
                    let pair = self.pair(one);
                    self.let_pattern(pair, call);
                }
            }
            Line::SinesCosines(several) => {
                let angles: Vec<Expression> = several.iter().map(|one| self.signed(one.angle)).collect();
                let pairs = several.iter().map(|one| self.pair(one)).collect();
                let call = Expression::associated(Type::Scalar, "sines_cosines", [Expression::List(angles)]);
                self.let_pattern(Pattern::List(pairs), call);
            }
            Line::External { function, arguments, values } => {
                let arguments = self.all_signed(arguments);
                let call = call_of(self.derivation.graph.external_names(*function));
                let mut patterns: Vec<Pattern> = values.iter().map(|value| self.pattern(*value)).collect();
                let pattern = match (patterns.len(), patterns.pop()) {
                    (1, Some(only)) => only,
                    (_, last) => Pattern::Tuple(patterns.into_iter().chain(last).collect()),
                };
                self.let_pattern(pattern, Expression::associated(Type::Itself, call, arguments));
                self.externals.insert(*function);
            }
            Line::Name { symbol, value } => self.name(*symbol, *value),
            Line::Turn { symbol, principal } => {
                let principal = self.signed(*principal);
                let name = self.names.introduce(*symbol);
                let number = match self.kernel.turns.get(symbol) {
                    Some(&place) => Expression::name(self.turn).method("number", [Expression::Count(place), principal]),
                    None => principal,
                };
                self.let_name(name, number);
            }
            Line::Guard { block, determinant, scale } => {
                let arguments = [self.signed(*determinant), self.signed(*scale)];
                let call = self.group_call("regular", *block, arguments);
                self.statements.push(Statement::Do(call.tried()));
            }
            Line::Factor { block, matrix, row_scales } => {
                let arguments = [self.columns(matrix), Expression::List(self.all_signed(row_scales))];
                let call = [self.error_name(), self.group(*block)].into_iter().chain(arguments);
                let call = Expression::associated(Type::Runtime("Factorization", Vec::new()), "new", call);
                let name = self.names.taken.unique("factors");
                let solves = |line: &Line| matches!(line, Line::Solve { block: other, .. } if other == block);
                let is_used = self.schedule.lines.iter().any(solves);
                match (&self.kernel.failure, is_used) {
                    (Failure::Error | Failure::Flag, true) => self.let_name(name.clone(), call.tried()),
                    (Failure::Error | Failure::Flag, false) => self.statements.push(Statement::Do(call.tried())),
                    (Failure::Return(otherwise), _) => {
                        let pattern = if is_used { Pattern::Name(name.clone()) } else { Pattern::Ignored };
                        let solved = Pattern::Case("Ok", Box::new(pattern));
                        self.statements.push(Statement::LetElse(solved, call, otherwise.clone()));
                    }
                }
                if is_used {
                    self.factors.insert(*block, name);
                }
            }
            Line::Solve { block, targets, right } => {
                let right = Expression::List(self.all_signed(right));
                let targets = targets.iter().map(|target| match self.schedule.uses(*target) {
                    true => Pattern::Name(self.names.introduce(*target)),
                    false => Pattern::Ignored,
                });
                let targets = targets.collect();
                let solution = Expression::name(&self.factors[block]).method("solve", [right]);
                self.let_pattern(Pattern::List(targets), solution);
            }
            Line::Solvable { block, determinant, numerators, scales } => {
                let determinant = self.signed(*determinant);
                if self.is_flagged() {
                    self.flags.push(Expression::runtime("lane::is_solvable", [determinant]));
                    return;
                }
                let [numerators, scales] = [numerators, scales].map(|values| Expression::List(self.all_signed(values)));
                let call = self.group_call("solvable", *block, [determinant, numerators, scales]);
                self.statements.push(Statement::Do(call.tried()));
            }
            Line::Reach { block, length } => {
                let length = self.signed(*length);
                if self.is_flagged() {
                    self.flags.push(Expression::runtime("lane::is_reachable", [length]));
                    return;
                }
                let call = self.group_call("reachable", *block, [length]);
                self.statements.push(Statement::Do(call.tried()));
            }
            Line::Chord { block, symbol, factors, size, of } => self.chord((*block, *symbol), *factors, *size, *of),
            Line::Pivots { symbol, matrix } => {
                let columns = self.columns(matrix);
                let name = self.names.introduce(*symbol);
                self.let_name(name, Expression::runtime("product_of_pivots", [columns]));
            }
            Line::Newton { block, targets, start, system } => {
                let start = Expression::List(self.all_signed(start));
                let evaluation = self.evaluation(targets, system);
                let call = self.group_call("newton_group", *block, [start, evaluation]).tried();
                let targets = targets.iter().map(|&target| Pattern::Name(self.names.introduce(target))).collect();
                self.let_pattern(Pattern::List(targets), call);
            }
            Line::Modes { .. } => self.modes(line),
        }
    }

    /// Binds a value to the name of a symbol.
    fn name(&mut self, symbol: SymbolId, value: Signed) {
        // A value with a name needs no other.
        if !value.negative
            && !self.names.is_negative(value.value)
            && let Some(known) = self.known(value.value)
        {
            self.names.call(symbol, known);
            return;
        }
        let is_number = matches!(self.schedule.value(value.value), Value::Constant(_));
        let is_new = !value.negative && !is_number && self.names.get(self.schedule, value.value).is_none();
        let definition = self.signed(value);
        let name = self.names.introduce(symbol);
        self.let_name(name.clone(), definition);
        if is_new {
            self.names.set(value.value, name);
        }
    }

    /// The name of a symbol, a sine or a cosine, or a name given by the user.
    fn known(&self, value: ValueId) -> Option<String> {
        let is_known = match self.schedule.value(value) {
            Value::Symbol(_) | Value::Call(Function::Sin | Function::Cos, _) => true,
            _ => self.schedule.name(value).is_some(),
        };
        self.names.get(self.schedule, value).filter(|_| is_known).map(str::to_owned)
    }

    /// The function that Newton's method evaluates: the residuals of a block, their scales, and its Jacobian by
    /// columns.
    pub(super) fn evaluation(&mut self, unknowns: &[SymbolId], system: &'a Schedule) -> Expression {
        let context = (self.derivation, self.kernel);
        let mut inner = Writer::new(context, [self.branch, self.turn, self.memory], system, self.names.within());
        let arguments = unknowns.iter().map(|&unknown| Pattern::Name(inner.names.introduce(unknown)));
        let arguments = vec![Pattern::List(arguments.collect())];
        inner.write();
        let results = inner.all_signed(&system.results);
        self.externals.append(&mut inner.externals);
        let count = unknowns.len();
        let (residual, rest) = results.split_at(count);
        let (scales, rows) = rest.split_at(count);
        let column = |column: usize| Expression::List(rows.iter().skip(column).step_by(count).cloned().collect());
        let columns = Expression::List((0..count).map(column).collect());
        let value =
            Expression::Tuple(vec![Expression::List(residual.to_vec()), Expression::List(scales.to_vec()), columns]);
        let mut used = Vec::new();
        value.each_name(&mut |name| used.push(name));
        let statements = stretches::divided(inner.statements, used);
        Expression::Closure { arguments, statements, value: Box::new(value), moves: false }
    }

    /// A call of a runtime function that names the mechanism and the group in its errors.
    pub(super) fn group_call(
        &self,
        function: &'static str,
        block: BlockId,
        arguments: impl IntoIterator<Item = Expression>,
    ) -> Expression {
        let common = [self.error_name(), self.group(block)];
        Expression::runtime(function, common.into_iter().chain(arguments))
    }

    /// The name of the mechanism or scene in errors.
    pub(super) fn error_name(&self) -> Expression {
        self.kernel.error_name.as_ref().map_or_else(Expression::mechanism, Expression::name)
    }

    pub(super) fn group(&self, block: BlockId) -> Expression {
        Expression::text(self.derivation.blocks[block].title(self.derivation))
    }

    fn let_name(&mut self, name: String, value: Expression) {
        self.let_pattern(Pattern::Name(name), value);
    }

    pub(super) fn let_pattern(&mut self, pattern: Pattern, value: Expression) {
        self.statements.push(Statement::Let(pattern, value));
    }

    fn pattern(&mut self, value: Option<ValueId>) -> Pattern {
        value.map_or(Pattern::Ignored, |value| Pattern::Name(self.names.invent(self.schedule, value)))
    }

    fn pair(&mut self, one: &Circular) -> Pattern {
        Pattern::Tuple([one.sine, one.cosine].map(|value| self.pattern(value)).to_vec())
    }

    /// The columns of a matrix given by rows.
    fn columns(&self, matrix: &[Vec<Signed>]) -> Expression {
        let column = |column: usize| Expression::List(matrix.iter().map(|row| self.signed(row[column])).collect());
        Expression::List((0..matrix.len()).map(column).collect())
    }

    pub(super) fn all_signed(&self, values: &[Signed]) -> Vec<Expression> {
        values.iter().map(|value| self.signed(*value)).collect()
    }

    /// A value by its name or inline. A negative difference, or a negative product with one, is written with the difference
    /// reversed. The sign of a sum that waits for its last term is written where it is known earlier.
    pub(super) fn signed(&self, signed: Signed) -> Expression {
        let (is_negative, value) = self.parts(signed);
        if !is_negative {
            return value;
        }
        let turned = match self.schedule.value(signed.value) {
            _ if self.is_named(signed.value) => None,
            Value::Sum(terms) => {
                let waits = |term: &Signed| self.schedule.is_earlier(term.value, signed.value);
                (self.is_difference(terms) || terms.iter().any(waits)).then(|| self.turned(terms))
            }
            Value::Product(factors) => self.turned_product(factors),
            _ => None,
        };
        turned.unwrap_or_else(|| Expression::Negative(Box::new(value)))
    }

    /// The negative of a sum.
    fn turned(&self, terms: &[Signed]) -> Expression {
        let terms: Vec<Signed> = terms.iter().map(|term| Signed { negative: !term.negative, ..*term }).collect();
        self.sum(&terms)
    }

    /// The negative of a product with a difference, or of one that begins with a sum, whose last named factor takes the sign
    /// if it is known earlier.
    fn turned_product(&self, factors: &[ValueId]) -> Option<Expression> {
        let mut expressions: Vec<Expression> = factors.iter().map(|&factor| self.parts_of(factor).1).collect();
        let difference = |&factor: &ValueId| match self.schedule.value(factor) {
            Value::Sum(terms) if !self.is_named(factor) && self.is_difference(terms) => Some(terms),
            _ => None,
        };
        let mut differences = factors.iter().map(difference).enumerate();
        if let Some((place, terms)) = differences.find_map(|(place, terms)| Some((place, terms?))) {
            expressions[place] = self.turned(terms);
            return Some(Expression::Product(expressions));
        }
        let first = *factors.first()?;
        let name = factors.iter().rposition(|&factor| self.is_named(factor))?;
        let is_sum = matches!(self.schedule.value(first), Value::Sum(_)) && !self.is_named(first);
        if !is_sum || !self.schedule.is_earlier(factors[name], first) {
            return None;
        }
        expressions[name] = Expression::Negative(Box::new(expressions[name].clone()));
        Some(Expression::Product(expressions))
    }

    fn is_named(&self, value: ValueId) -> bool {
        self.names.get(self.schedule, value).is_some()
    }

    fn is_difference(&self, terms: &[Signed]) -> bool {
        terms.iter().any(|term| self.is_taken_away(*term))
    }

    /// True if the term is written with a minus.
    fn is_taken_away(&self, term: Signed) -> bool {
        term.negative != self.names.is_negative(term.value)
    }

    /// The sign and the magnitude of a value.
    fn parts(&self, Signed { negative, value }: Signed) -> (bool, Expression) {
        let (is_negative, value) = self.parts_of(value);
        let is_zero = matches!(&value, Expression::Number(number) if number.is_zero());
        (negative != is_negative && !is_zero, value)
    }

    fn parts_of(&self, value: ValueId) -> (bool, Expression) {
        match self.names.get(self.schedule, value) {
            Some(name) => (self.names.is_negative(value), Expression::name(name)),
            None => self.computed(value),
        }
    }

    /// A sum, with a positive term first if it has one.
    fn sum(&self, terms: &[Signed]) -> Expression {
        let mut terms = terms.to_vec();
        terms::sort(&mut terms, &self.schedule.known, |term| self.is_taken_away(*term));
        let term = |(place, term): (usize, &Signed)| match place {
            // The first term may absorb its sign.
            0 => match self.signed(*term) {
                Expression::Negative(inside) => (true, *inside),
                first => (false, first),
            },
            _ => self.parts(*term),
        };
        Expression::Sum(terms.iter().enumerate().map(term).collect())
    }

    /// The sign and the operation of a value, even if it has a name.
    fn computed(&self, value: ValueId) -> (bool, Expression) {
        match self.schedule.value(value) {
            Value::Product(factors) => {
                let parts = factors.iter().map(|&factor| self.parts_of(factor));
                let (signs, factors): (Vec<bool>, Vec<Expression>) = parts.unzip();
                (signs.into_iter().fold(false, |sign, other| sign != other), Expression::Product(factors))
            }
            Value::Quotient(above, below) => {
                let [(above_sign, above), (below_sign, below)] = [above, below].map(|&part| self.parts_of(part));
                (above_sign != below_sign, Expression::Quotient(Box::new([above, below])))
            }
            Value::Square(base) => {
                let base = self.parts_of(*base).1;
                (false, if self.is_exact() { base.method("square", []) } else { Expression::Square(Box::new(base)) })
            }
            Value::Symbol(symbol) => (false, Expression::Name(self.names.symbol(*symbol))),
            Value::Constant(number) if self.is_exact() && !number.is_zero() && !number.is_one() => {
                (false, Expression::Exact(*number))
            }
            Value::Constant(number) => (false, Expression::Number(*number)),
            Value::Sum(terms) => (false, self.sum(terms)),
            Value::Call(function, arguments) => {
                let arguments = self.all_signed(arguments);
                let in_lane = lane_form(*function).filter(|_| self.is_flagged());
                let call = match in_lane {
                    Some(name) => Expression::runtime(name, arguments),
                    None => Expression::Elementary(*function, arguments),
                };
                (false, call)
            }
            // Directions and user functions have lines of their own, which name them.
            Value::Direction(function, _) => (false, Expression::name(function.operation().name)),
            Value::External(external, _) => {
                (false, Expression::name(self.derivation.graph.external_name(external).unwrap_or_default()))
            }
        }
    }
}

/// The form without branches of a function that has one of its own.
fn lane_form(function: Function) -> Option<&'static str> {
    match function {
        Function::Sin => Some("lane::sine"),
        Function::Cos => Some("lane::cosine"),
        Function::Atan2 => Some("lane::arctangent2"),
        Function::Hypot => Some("lane::hypotenuse"),
        _ => None,
    }
}

/// The name of the sine or cosine of a direction.
pub(super) fn direction_name(function: Function, angle: &str) -> String {
    format!("{}_{angle}", function.operation().name)
}
