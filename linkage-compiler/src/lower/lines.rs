//! Conversion of the lines of a schedule to statements.

use linkage_ir::ValueId;

use super::naming::{Hint, Hinted};
use super::schedule::{Circular, Line, Schedule};
use super::stretches;
use super::value::{Block, Leaf, Pattern, Signed, Statement, Value};
use super::writer::{Absorbed, Writer};
use crate::graph::{Function, SymbolId};
use crate::ids::GroupId;
use crate::program::{Intrinsic, LaneResult, Type};

impl Writer<'_> {
    /// Adds the lines of a schedule whose values are absorbed.
    pub(super) fn write(&mut self, of: Absorbed<'_>) {
        for line in &of.schedule.lines {
            self.line(of, line);
        }
        if self.is_flagged() {
            self.flag_ranges(of);
        }
    }

    /// Flags arguments for which the form of a function without branches has another value.
    fn flag_ranges(&mut self, of: Absorbed<'_>) {
        let mut flagged: Vec<(Intrinsic, Vec<Signed>)> = Vec::new();
        for &id in of.schedule.used() {
            let Value::Call(function, arguments) = of.schedule.value(id) else { continue };
            let Some([_, check]) = Intrinsic::in_lane_of(*function) else { continue };
            let arguments = arguments.iter().map(|argument| self.values.signed(of.signed(*argument))).collect();
            let flag = (check, arguments);
            if !flagged.contains(&flag) {
                flagged.push(flag);
            }
        }
        for (check, arguments) in flagged {
            let arguments: Vec<ValueId> = arguments.into_iter().map(|argument| self.values.written(argument)).collect();
            let flag = self.call(check, arguments);
            self.flags.push(flag);
        }
    }

    fn line(&mut self, of: Absorbed<'_>, line: &Line) {
        match line {
            Line::Let(id) => {
                // The name of a negative does not serve for the value.
                let negative = matches!(of.schedule.name(*id), Some((_, true)));
                self.values.define(of.signed(Signed { negative, value: *id }));
                match of.schedule.name(*id) {
                    Some((preferred, true)) => self.hint(of.id(*id), Hint::Preferred(preferred.to_owned())),
                    _ => self.invent(of, *id),
                }
                self.let_itself(of.id(*id));
            }
            Line::SineCosine(one) => self.sine_cosine(of, one),
            Line::SinesCosines(several) if self.is_flagged() => {
                several.iter().for_each(|one| self.sine_cosine(of, one));
            }
            Line::SinesCosines(several) => {
                let angles: Vec<Signed> = several.iter().map(|one| one.angle).collect();
                let angles = self.all_signed(of, &angles);
                let angles = self.list(angles);
                let pairs = several.iter().map(|one| self.pair(of, one)).collect();
                let call = Value::Intrinsic(Intrinsic::SinesCosines, Some(Box::new(Type::Scalar)), vec![angles]);
                let call = self.add(call);
                self.let_value(Pattern::List(pairs), call);
            }
            Line::External { function, arguments, values } => {
                let arguments = self.all_signed(of, arguments);
                let mut patterns: Vec<Pattern> = values.iter().map(|value| self.pattern(of, *value)).collect();
                let pattern = match (patterns.len(), patterns.pop()) {
                    (1, Some(only)) => only,
                    (_, last) => Pattern::Tuple(patterns.into_iter().chain(last).collect()),
                };
                let call = self.add(Value::UserFunction(*function, arguments));
                self.let_value(pattern, call);
                self.externals.insert(*function);
            }
            Line::Name { symbol, value } => self.name(of, *symbol, *value),
            Line::Turn { symbol, principal, range } => {
                let principal = match range {
                    Some([least, most]) => {
                        let arguments = self.all_signed(of, &[*principal, *least, *most]);
                        self.call(Intrinsic::InRange, arguments)
                    }
                    None => self.signed(of, *principal),
                };
                let number = match self.kernel.turns.get(symbol) {
                    Some(&index) => {
                        let (turn, index) = (self.variable(self.context.turn), self.add(Value::Count(index)));
                        self.call(Intrinsic::InTurn, [turn, index, principal])
                    }
                    None => principal,
                };
                let name = self.introduce(of, *symbol);
                self.let_value(Pattern::Bound(name), number);
            }
            Line::Guard { group, determinant, scale } => {
                let arguments = self.all_signed(of, &[*determinant, *scale]);
                self.check(Intrinsic::Regular, *group, arguments);
            }
            Line::Factor { group, matrix, row_scales } => self.factor(of, *group, matrix, row_scales),
            Line::Solve { group, targets, right } => {
                let right = self.all_signed(of, right);
                let right = self.list(right);
                let targets = targets.iter().map(|target| match of.schedule.uses(*target) {
                    true => Pattern::Bound(self.introduce(of, *target)),
                    false => Pattern::Ignored,
                });
                let targets = targets.collect();
                let factors = match self.factors.get(group) {
                    Some(factors) => *factors,
                    None => self.dangle(|| format!("the factorisation of group {group:?}")),
                };
                let solution = self.call(Intrinsic::Solve, [factors, right]);
                self.let_value(Pattern::List(targets), solution);
            }
            Line::Solvable { group, determinant, numerators, scales } => {
                let determinant = self.signed(of, *determinant);
                let lists = [numerators, scales].map(|values| {
                    let values = self.all_signed(of, values);
                    self.list(values)
                });
                self.check(Intrinsic::Solvable, *group, [determinant].into_iter().chain(lists));
            }
            Line::Reach { group, length } => {
                let length = self.signed(of, *length);
                self.check(Intrinsic::Reachable, *group, [length]);
            }
            Line::Chord { .. } => self.chord(of, line),
            Line::Pivots { symbol, matrix } => {
                let columns = self.columns(of, matrix);
                let product = self.call(Intrinsic::ProductOfPivots, [columns]);
                let name = self.introduce(of, *symbol);
                self.let_value(Pattern::Bound(name), product);
            }
            Line::Newton { group, targets, start, system } => {
                let start = self.all_signed(of, start);
                let start = self.list(start);
                let evaluation = self.evaluation(targets, system);
                let call = self.group_call(Intrinsic::NewtonGroup, *group, [start, evaluation]);
                let call = self.tried(call);
                let targets = self.all_introduced(of, targets);
                self.let_value(targets, call);
            }
            Line::Modes { .. } => self.modes(of, line),
        }
    }

    fn sine_cosine(&mut self, of: Absorbed<'_>, one: &Circular) {
        let angle = self.signed(of, one.angle);
        let pair = self.pair(of, one);
        let call = match Intrinsic::SineCosine.row().in_lane.filter(|_| self.is_flagged()) {
            Some(form) => self.call(form.function, [angle]),
            None => self.call(Intrinsic::SineCosine, [angle]),
        };
        self.let_value(pair, call);
    }

    /// Adds a call that checks a group, or the flag of its form over lanes.
    fn check(&mut self, of: Intrinsic, group: GroupId, arguments: impl IntoIterator<Item = ValueId>) {
        let origin = if of == Intrinsic::Regular { self.error_name() } else { self.origin() };
        let common = [origin, self.group(group)];
        let arguments: Vec<ValueId> = common.into_iter().chain(arguments).collect();
        if self.is_flagged()
            && let Some(form) = of.row().in_lane
        {
            debug_assert_eq!(form.result, LaneResult::Flag);
            let flag = self.call(form.function, form.takes.iter().map(|&index| arguments[index]));
            self.flags.push(flag);
            return;
        }
        let call = self.call(of, arguments);
        let call = self.tried(call);
        self.statements.push(Statement::Do(call));
    }

    /// Factorises the matrix of a group.
    fn factor(&mut self, of: Absorbed<'_>, group: GroupId, matrix: &[Vec<Signed>], row_scales: &[Signed]) {
        let columns = self.columns(of, matrix);
        let scales = self.all_signed(of, row_scales);
        let scales = self.list(scales);
        let arguments = vec![self.error_name(), self.group(group), columns, scales];
        let of_runtime = Type::Runtime("Factorization", Vec::new());
        let call = self.add(Value::Intrinsic(Intrinsic::Factorization, Some(Box::new(of_runtime)), arguments));
        let name = self.bound("factors");
        let solves = |line: &Line| matches!(line, Line::Solve { group: other, .. } if *other == group);
        let is_used = of.schedule.lines.iter().any(solves);
        let pattern = if is_used { Pattern::Bound(name) } else { Pattern::Ignored };
        let statement = match self.otherwise {
            Some(otherwise) => Statement::LetElse(Pattern::Case(Intrinsic::Ok, Box::new(pattern)), call, otherwise),
            None => {
                let call = self.tried(call);
                if is_used { Statement::Let(pattern, call) } else { Statement::Do(call) }
            }
        };
        self.statements.push(statement);
        if is_used {
            self.factors.insert(group, name);
        }
    }

    /// Binds a value to the name of a symbol.
    fn name(&mut self, of: Absorbed<'_>, symbol: SymbolId, value: Signed) {
        let id = of.id(value.value);
        let is_bound = self.values.is_bound[id.index()];
        let is_named = |writer: &Self| {
            let is_known = match of.schedule.value(value.value) {
                Value::Given(Leaf::Symbol(_)) | Value::Call(Function::Sin | Function::Cos, _) => true,
                _ => of.schedule.name(value.value).is_some(),
            };
            is_known && !writer.values.is_negative[id.index()]
        };
        // A value with a name needs no other.
        if is_bound && !value.negative && is_named(self) {
            self.call_symbol(of, symbol, self.values.itself(id));
            return;
        }
        let is_number = matches!(of.schedule.value(value.value), Value::Constant(_));
        let is_new = !value.negative && !is_number && !is_bound;
        if is_new {
            self.values.define(of.signed(value));
            self.call_symbol(of, symbol, id);
            self.hint(id, Hint::Symbol(symbol));
            self.let_itself(id);
            return;
        }
        let definition = self.signed(of, value);
        let name = self.introduce(of, symbol);
        self.let_value(Pattern::Bound(name), definition);
    }

    /// Lets a symbol stand for a bound value.
    fn call_symbol(&mut self, of: Absorbed<'_>, symbol: SymbolId, value: ValueId) {
        if let Some(own) = of.symbol(symbol) {
            self.values.alias(own, value);
        }
        self.symbols.insert(symbol, value);
    }

    /// The function that Newton's method evaluates: the residuals of a group, their scales, and its Jacobian by
    /// columns.
    pub(super) fn evaluation(&mut self, unknowns: &[SymbolId], system: &Schedule) -> ValueId {
        let outside = self.symbols.clone();
        let (statements, hints) = (std::mem::take(&mut self.statements), std::mem::take(&mut self.hints));
        let of = self.absorb(system, unknowns);
        let arguments = vec![self.all_introduced(of, unknowns)];
        self.write(of);
        let results = self.all_signed(of, &system.results);
        let count = unknowns.len();
        let (residual, rest) = results.split_at(count);
        let (scales, rows) = rest.split_at(count);
        let columns: Vec<ValueId> =
            (0..count).map(|column| self.list(rows.iter().skip(column).step_by(count).copied())).collect();
        let parts = [self.list(residual.iter().copied()), self.list(scales.iter().copied()), self.list(columns)];
        let value = self.add(Value::Tuple(parts.to_vec()));
        let inside = std::mem::replace(&mut self.statements, statements);
        let inside_hints = std::mem::replace(&mut self.hints, hints);
        self.hints.push(Hinted::Within(inside_hints));
        self.symbols = outside;
        let statements = stretches::divided(&mut self.values, inside, &[value]);
        self.add(Value::Closure { arguments, body: Box::new(Block { statements, value }), moves: false })
    }

    /// A call of a runtime function that names the mechanism and the group in its errors.
    pub(super) fn group_call(
        &mut self,
        function: Intrinsic,
        group: GroupId,
        arguments: impl IntoIterator<Item = ValueId>,
    ) -> ValueId {
        let common = [self.error_name(), self.group(group)];
        self.call(function, common.into_iter().chain(arguments))
    }

    /// The pattern that binds a list of symbols.
    pub(super) fn all_introduced(&mut self, of: Absorbed<'_>, symbols: &[SymbolId]) -> Pattern {
        Pattern::List(symbols.iter().map(|&symbol| Pattern::Bound(self.introduce(of, symbol))).collect())
    }

    fn invent(&mut self, of: Absorbed<'_>, value: ValueId) {
        let preferred = of.schedule.name(value).filter(|(_, is_negative)| !is_negative);
        let preferred = preferred.map(|(name, _)| name.to_owned());
        self.hint(of.id(value), Hint::Described(preferred));
    }

    fn pattern(&mut self, of: Absorbed<'_>, value: Option<ValueId>) -> Pattern {
        let Some(value) = value else { return Pattern::Ignored };
        self.invent(of, value);
        self.values.bind(of.id(value), false);
        Pattern::Bound(of.id(value))
    }

    fn pair(&mut self, of: Absorbed<'_>, one: &Circular) -> Pattern {
        Pattern::Tuple([one.sine, one.cosine].map(|value| self.pattern(of, value)).to_vec())
    }

    /// The columns of a matrix given by rows.
    fn columns(&mut self, of: Absorbed<'_>, matrix: &[Vec<Signed>]) -> ValueId {
        let rows: Vec<Vec<ValueId>> = matrix.iter().map(|row| self.all_signed(of, row)).collect();
        let column = |writer: &mut Self, column: usize| writer.list(rows.iter().map(|row| row[column]));
        let columns: Vec<ValueId> = (0..matrix.len()).map(|number| column(self, number)).collect();
        self.list(columns)
    }

    pub(super) fn signed(&mut self, of: Absorbed<'_>, value: Signed) -> ValueId {
        self.values.signed_value(of.signed(value))
    }

    pub(super) fn all_signed(&mut self, of: Absorbed<'_>, values: &[Signed]) -> Vec<ValueId> {
        values.iter().map(|value| self.signed(of, *value)).collect()
    }
}
