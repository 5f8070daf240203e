//! Lowering of a planned function to statements.

use std::collections::{BTreeMap, BTreeSet};

use rustc_hash::FxHashSet;

use super::lines::{Writer, direction_name};
use super::names::Names;
use super::schedule::Schedule;
use super::scheduling::schedule;
use super::stretches;
use super::value::{Value, ValueId};
use crate::derivation::Derivation;
use crate::graph::{ExternalId, Function as Elementary, NodeId, SymbolId};
use crate::ids::BlockId;
use crate::program::{
    Access, Body, Expression, Function, Given, Kernel, Operations, Pattern, PosePlan, Shape, Source, Statement, Taken,
    Type, Value as Returned,
};

/// The data that the functions of one driver or scene share.
pub struct Context<'a> {
    pub derivation: &'a Derivation,
    pub pose: &'a PosePlan,
    /// Names that the user gave to expressions.
    pub named: &'a [(NodeId, String)],
    /// Names that no value may have: those of the arguments.
    pub reserved: &'a BTreeSet<String>,
    /// The names of the arguments for the pose, the branch and the turns.
    pub pose_argument: &'a str,
    pub branch: &'a str,
    pub turn: &'a str,
    /// The operation counts of the functions lowered so far.
    pub works: BTreeMap<String, Operations>,
}

/// The lowered body of a function.
#[derive(Debug, Clone)]
pub struct Code {
    pub statements: Vec<Statement>,
    pub value: Returned,
    pub operations: Operations,
    /// The arguments that it uses.
    pub uses: BTreeSet<String>,
    /// The user functions that it calls.
    pub externals: BTreeSet<ExternalId>,
}

/// Lowers a function.
pub fn function(planned: Function<Body>, context: &mut Context) -> Function<Code> {
    let Function { name, doc, access, is_method, arguments, returns, is_fallible, body } = planned;
    let is_layer = matches!(access, Access::Layer | Access::PublicLayer);
    let mut body = body.map(|body| self::body(body, is_layer, context));
    if let (Some(code), Access::Cold) = (&mut body, access) {
        // It is called only after an error.
        code.operations = Operations::default();
    }
    if let Some(code) = &body {
        context.works.insert(name.clone(), code.operations);
    }
    Function { name, doc, access, is_method, arguments, returns, is_fallible, body }
}

fn body(body: Body, is_layer: bool, context: &Context) -> Code {
    let Body { before, kernel, after, value, locals, calls, mut operations } = body;
    for call in calls {
        operations += context.works.get(&call).copied().unwrap_or_default();
    }
    let mut formulas =
        kernel.map_or_else(|| Formulas::none(context), |kernel| Formulas::of(&kernel, is_layer, context));
    operations += formulas.operations;
    let locals: Vec<String> = locals.iter().map(|preferred| formulas.taken.unique(preferred)).collect();
    let computed = std::mem::take(&mut formulas.statements);
    let finished = Finished { results: &formulas.results, locals: &locals };
    let all = |planned: Vec<Statement>| {
        let mut statements = Vec::new();
        planned.into_iter().for_each(|statement| finished.statement(statement, &formulas, &mut statements));
        statements
    };
    let (before, after) = (all(before), all(after));
    let value = match value {
        Returned::Plain(value) => Returned::Plain(finished.expression(value)),
        Returned::Result(value) => Returned::Result(finished.expression(value)),
    };
    let mut uses = BTreeSet::new();
    let mut use_name = |name: &str| uses.extend([name.to_owned()]);
    let (Returned::Plain(last) | Returned::Result(last)) = &value;
    last.each_name(&mut use_name);
    after.iter().for_each(|statement| statement.each_name(&mut use_name));
    let computed = stretches::divided(computed, uses.iter().map(String::as_str));
    computed.iter().for_each(|statement| statement.each_name(&mut |name| uses.extend([name.to_owned()])));
    let before = needed(before, &mut uses);
    let mut statements: Vec<Statement> = before.into_iter().chain(computed).chain(after).collect();
    let value = unnamed(&mut statements, value);
    Code { statements, value, operations, uses, externals: formulas.externals }
}

/// Returns the value of the last `let` instead of its name, if the function returns that name.
fn unnamed(statements: &mut Vec<Statement>, value: Returned) -> Returned {
    let is_named = |statement: &mut Statement| match (statement, &value) {
        (Statement::Let(Pattern::Name(last), _), Returned::Plain(Expression::Name(name))) => last == name,
        _ => false,
    };
    match statements.pop_if(is_named) {
        Some(Statement::Let(_, last)) => Returned::Plain(last),
        _ => value,
    }
}

/// Removes `let`s with unused names, unless they may fail; adds the names that the others use.
fn needed(statements: Vec<Statement>, uses: &mut BTreeSet<String>) -> Vec<Statement> {
    let mut kept = Vec::new();
    for statement in statements.into_iter().rev() {
        let is_unused = match &statement {
            Statement::Let(Pattern::Typed(name, _) | Pattern::Name(name), value) => {
                !matches!(value, Expression::Try(_)) && !uses.contains(name)
            }
            _ => false,
        };
        if !is_unused {
            statement.each_name(&mut |name| uses.extend([name.to_owned()]));
            kept.push(statement);
        }
    }
    kept.reverse();
    kept
}

/// A lowered kernel.
struct Formulas<'a> {
    statements: Vec<Statement>,
    results: Vec<Expression>,
    /// For each result, true if it is finite if the checks before it pass.
    is_proven: Vec<bool>,
    dyads: Vec<Option<BlockId>>,
    /// The names of the flags that are true if the triangle of a dyad is well conditioned.
    well_conditioned: Vec<String>,
    taken: Taken<'a>,
    externals: BTreeSet<ExternalId>,
    operations: Operations,
}

impl<'a> Formulas<'a> {
    /// No formulas, for a function without kernel.
    fn none(context: &Context<'a>) -> Self {
        Self {
            statements: Vec::new(),
            results: Vec::new(),
            is_proven: Vec::new(),
            dyads: Vec::new(),
            well_conditioned: Vec::new(),
            taken: Taken::new(context.reserved),
            externals: BTreeSet::new(),
            operations: Operations::default(),
        }
    }

    fn of(kernel: &Kernel, is_layer: bool, context: &Context<'a>) -> Self {
        let derivation = context.derivation;
        let nothing = Given::default();
        let given = if kernel.is_on_pose { &context.pose.given } else { &nothing };
        let nodes: Vec<NodeId> = kernel.results.iter().map(|output| output.node).collect();
        // Preferred names of values: those of results, then those given by the user.
        let results = kernel.results.iter().filter_map(|output| Some((output.node, output.name.clone()?)));
        let named: Vec<(NodeId, String)> = results.chain(context.named.iter().cloned()).collect();
        let schedule = schedule(&derivation.graph, &kernel.steps, &nodes, given, &named, is_layer);
        let is_proven = schedule.proven(kernel.conclusive.clone());
        let mut names = Names::new(&derivation.graph, context.reserved);
        // The symbols of the user are named first, so that they keep their names.
        let own: BTreeSet<SymbolId> = kernel.steps.iter().flat_map(|step| step.introduced()).collect();
        let symbols: BTreeSet<SymbolId> = schedule.symbols().filter(|symbol| !own.contains(symbol)).collect();
        for &symbol in &symbols {
            names.introduce(symbol);
        }
        let sources = kernel.sources.iter();
        let mut statements: Vec<Statement> =
            sources.filter_map(|source| taken_apart(source, &symbols, &names)).collect();
        if kernel.is_on_pose {
            directions(&mut statements, context, &schedule, &mut names);
        }
        let arguments = (context.branch, context.turn);
        let mut writer = Writer::new((derivation, kernel), arguments, &schedule, names);
        writer.statements = statements;
        let open = kernel.dyads.iter().zip(&is_proven).filter(|(_, is_proven)| !**is_proven);
        writer.well_conditioned = open.filter_map(|(dyad, _)| Some(((*dyad)?, None))).collect();
        writer.write();
        let results = writer.all_signed(&schedule.results);
        let Writer { mut statements, names, externals, well_conditioned, .. } = writer;
        parameters_where_used(&mut statements);
        let mut taken = names.taken;
        let results = kernel.results.iter().zip(results).map(|(output, result)| match &output.name {
            Some(preferred) if is_formula(&result) => {
                let name = taken.unique(preferred);
                statements.push(Statement::Let(Pattern::Name(name.clone()), result));
                Expression::Name(name)
            }
            _ => result,
        });
        let results = results.collect();
        let (dyads, well_conditioned) = (kernel.dyads.clone(), well_conditioned.into_values().flatten().collect());
        let operations = schedule.operations();
        Self { statements, results, is_proven, dyads, well_conditioned, taken, externals, operations }
    }
}

/// Moves the statement that reads the parameters to their first use: what is computed before, such as the sines of the
/// inputs, then has the registers for itself.
fn parameters_where_used(statements: &mut Vec<Statement>) {
    let is_parameters =
        |statement: &Statement| matches!(statement, Statement::Let(Pattern::Struct { of: Type::Itself, .. }, _));
    let Some(place) = statements.iter().position(is_parameters) else { return };
    let parameters = statements.remove(place);
    let mut bound = BTreeSet::new();
    if let Statement::Let(pattern, _) = &parameters {
        pattern.each_name(&mut |name| bound.extend([name.to_owned()]));
    }
    let uses = |statement: &Statement| {
        let mut is_used = false;
        statement.each_name(&mut |name| is_used |= bound.contains(name));
        is_used
    };
    let place = statements.iter().position(uses).unwrap_or(statements.len());
    statements.insert(place, parameters);
}

/// True if a value is neither a name nor zero nor one.
fn is_formula(value: &Expression) -> bool {
    match value {
        Expression::Name(_) => false,
        Expression::Number(number) => !number.is_zero() && !number.is_one(),
        _ => true,
    }
}

/// `let Type { field, other: name, .. } = *value;` with the fields that are used; `None` if no field is used.
fn taken_apart(source: &Source, used: &BTreeSet<SymbolId>, names: &Names) -> Option<Statement> {
    let pattern = match pattern(&source.shape, used, names) {
        Some(pattern) => pattern,
        // A call that may fail is kept.
        None if may_fail(&source.from) => Pattern::Ignored,
        None => return None,
    };
    Some(Statement::Let(pattern, source.from.clone()))
}

fn may_fail(value: &Expression) -> bool {
    match value {
        Expression::Try(_) => true,
        Expression::Field(of, _) => may_fail(of),
        _ => false,
    }
}

/// The pattern of a shape with the symbols that are used; `None` if no symbol is used.
fn pattern(shape: &Shape, used: &BTreeSet<SymbolId>, names: &Names) -> Option<Pattern> {
    let all = |shapes: &[Shape]| {
        let patterns: Vec<_> = shapes.iter().map(|shape| pattern(shape, used, names)).collect();
        let is_used = patterns.iter().any(Option::is_some);
        is_used.then(|| patterns.into_iter().map(|pattern| pattern.unwrap_or(Pattern::Ignored)).collect())
    };
    match shape {
        Shape::Symbol(symbol) => used.contains(symbol).then(|| Pattern::Name(names.symbol(*symbol))),
        Shape::Ignored => None,
        Shape::List(shapes) => all(shapes).map(Pattern::List),
        Shape::Tuple(shapes) => all(shapes).map(Pattern::Tuple),
        Shape::Fields { of, fields, is_whole } => {
            let named = fields.iter().filter_map(|(field, shape)| Some((field.clone(), pattern(shape, used, names)?)));
            let named: Vec<(String, Pattern)> = named.collect();
            let is_whole = *is_whole && named.len() == fields.len();
            (!named.is_empty()).then(|| Pattern::Struct { of: of.clone(), fields: named, is_whole })
        }
    }
}

/// Adds `let (sin_theta, cos_theta) = (pose.theta.im, pose.theta.re);` for the directions that are used.
fn directions(statements: &mut Vec<Statement>, context: &Context, schedule: &Schedule, names: &mut Names) {
    let mut used: Vec<(NodeId, Elementary, ValueId)> = Vec::new();
    for &id in schedule.used() {
        if let Value::Direction(function, angle) = schedule.value(id) {
            used.push((*angle, *function, id));
        }
    }
    used.sort_unstable();
    for parts in used.chunk_by(|one, other| one.0 == other.0) {
        let field = context.pose.direction(parts[0].0);
        let (mut patterns, mut values) = (Vec::new(), Vec::new());
        for &(_, function, id) in parts {
            patterns.push(Pattern::Name(names.give(id, &direction_name(function, field))));
            let part = if function == Elementary::Sin { "im" } else { "re" };
            values.push(Expression::name(context.pose_argument).field(field).field(part));
        }
        let (pattern, value) = match (patterns.pop(), values.pop()) {
            (Some(pattern), Some(value)) if patterns.is_empty() => (pattern, value),
            (pattern, value) => (
                Pattern::Tuple(patterns.into_iter().chain(pattern).collect()),
                Expression::Tuple(values.into_iter().chain(value).collect()),
            ),
        };
        statements.push(Statement::Let(pattern, value));
    }
}

/// Replaces indices of results and local values by their expressions and names.
struct Finished<'a> {
    results: &'a [Expression],
    locals: &'a [String],
}

impl Finished<'_> {
    fn statement(&self, statement: Statement, formulas: &Formulas, out: &mut Vec<Statement>) {
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
            Statement::CheckPosition => self.check_position(formulas, out),
            Statement::CheckKinematics { determinants, otherwise } => {
                self.check_kinematics(determinants, otherwise, formulas, out);
            }
            Statement::Return(value) => out.push(Statement::Return(self.expression(value))),
            Statement::LetElse(pattern, value, otherwise) => {
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
        determinants: Vec<[Expression; 2]>,
        otherwise: Expression,
        formulas: &Formulas,
        out: &mut Vec<Statement>,
    ) {
        let of_determinants =
            determinants.into_iter().map(|pair| Expression::runtime("is_nonzero", self.expressions(pair.to_vec())));
        let mut conditions: Vec<Expression> = of_determinants.collect();
        let numbers = self.results.iter().zip(&formulas.dyads).zip(&formulas.is_proven);
        let unproven = numbers.filter(|((_, dyad), is_proven)| dyad.is_none() && !**is_proven);
        let numbers = to_check(unproven.map(|((value, _), _)| value.clone()).collect());
        if !numbers.is_empty() {
            // A sum is finite only if all its terms are. Where finite terms overflow, `otherwise` finds no error.
            let sum = Expression::Sum(numbers.into_iter().map(|number| (false, number)).collect());
            conditions.push(sum.method("is_finite", []));
        }
        if !conditions.is_empty() {
            out.push(Statement::Unless(conditions, vec![Statement::Return(otherwise)]));
        }
    }

    fn expressions(&self, values: Vec<Expression>) -> Vec<Expression> {
        values.into_iter().map(|value| self.expression(value)).collect()
    }

    fn expression(&self, value: Expression) -> Expression {
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
            E::Field(value, name) => E::Field(Box::new(self.expression(*value)), name),
            E::Index(value, place) => E::Index(Box::new(self.expression(*value)), place),
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
            E::Dereferenced(value) => E::Dereferenced(Box::new(self.expression(*value))),
            E::Closure { arguments, statements, value, moves } => {
                E::Closure { arguments, statements, value: Box::new(self.expression(*value)), moves }
            }
            E::Block(statements, value) => E::Block(statements, Box::new(self.expression(*value))),
            finished @ (E::Name(_) | E::Number(_) | E::Text(_) | E::Count(_) | E::Constant(_)) => finished,
        }
    }

    fn pattern(&self, pattern: Pattern) -> Pattern {
        let all = |patterns: Vec<Pattern>| patterns.into_iter().map(|pattern| self.pattern(pattern)).collect();
        match pattern {
            Pattern::Local(place) => Pattern::Name(self.locals[place].clone()),
            Pattern::Mutable(inside) => Pattern::Mutable(Box::new(self.pattern(*inside))),
            Pattern::List(patterns) => Pattern::List(all(patterns)),
            Pattern::Tuple(patterns) => Pattern::Tuple(all(patterns)),
            finished => finished,
        }
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
