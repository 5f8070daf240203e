//! The planned functions: what a kernel takes, its steps and results as formulas, and the value made of these.
//!
//! A result is `#1`, counted from 0, unless it has a name; a local value that lowering will name is `%1`.

use linkage_compiler::derivation::Step;
use linkage_compiler::graph::{Graph, NodeId, SymbolId};
use linkage_compiler::model::Mechanism;
use linkage_compiler::program::{
    Body, Expression, Function, Kernel, Pattern, Receiver, Shape, Statement, Type, Value, Variable,
};

use super::{Part, each_function, planned};

pub fn functions(mechanism: &Mechanism) -> Result<Vec<Part>, String> {
    let mut parts = Vec::new();
    for driver in mechanism.drivers.iter() {
        let (derivation, program) = planned(mechanism, driver)?;
        each_function(&program, &mut |of, planned| {
            let text = function(planned, &derivation.graph);
            parts.push(Part { of: of.to_owned(), name: planned.name.clone(), text });
        });
    }
    Ok(parts)
}

fn function(function: &Function<Body>, graph: &Graph) -> String {
    let arguments: Vec<&str> = function.arguments.iter().map(|argument| argument.name.as_str()).collect();
    let or_error = if function.is_fallible { " or an error" } else { "" };
    let mut lines = vec![format!("{}({}){or_error}", function.name, arguments.join(", "))];
    if let Some(body) = &function.body {
        lines.extend(body.before.iter().map(statement));
        lines.extend(body.kernel.iter().flat_map(|one| kernel(one, graph)));
        lines.extend(body.after.iter().map(statement));
        let value = match &body.value {
            Value::Stored(stored) => format!("store {}", expression(&stored.literal)),
            value => expression(value.returned()),
        };
        lines.push(format!("return {value}"));
    }
    lines.join("\n    ")
}

fn kernel(kernel: &Kernel, graph: &Graph) -> Vec<String> {
    let sources = kernel.sources.iter();
    let sources =
        sources.map(|source| format!("take {} from {}", shape(&source.shape, graph), expression(&source.from)));
    let steps = kernel.steps.iter().map(|one| step(one, graph));
    let results = kernel.results.iter().enumerate().map(|(index, result)| {
        let name = result.name.as_ref().map_or_else(String::new, |name| format!(" {name}"));
        format!("result #{index}{name} = {}", graph.text(result.node))
    });
    sources.chain(steps).chain(results).collect()
}

/// The symbols that a source gives.
fn shape(shape: &Shape, graph: &Graph) -> String {
    let names: Vec<&str> = shape.symbols().into_iter().map(|symbol| graph.symbol_name(symbol)).collect();
    if names.is_empty() { "nothing".to_owned() } else { names.join(", ") }
}

fn step(step: &Step, graph: &Graph) -> String {
    let of = |node: &NodeId| graph.text(*node);
    let all = |nodes: &[NodeId]| nodes.iter().map(of).collect::<Vec<_>>().join(", ");
    let name = |symbol: &SymbolId| graph.symbol_name(*symbol).to_owned();
    let names = |symbols: &[SymbolId]| symbols.iter().map(name).collect::<Vec<_>>().join(", ");
    let rows =
        |matrix: &[Vec<NodeId>]| matrix.iter().map(|row| format!("[{}]", all(row))).collect::<Vec<_>>().join(", ");
    match step {
        Step::Let { symbol, node } => format!("let {} = {}", name(symbol), of(node)),
        Step::Turn { symbol, principal, range } => {
            let range = range.map_or_else(String::new, |[least, most]| format!(" in {}..{}", of(&least), of(&most)));
            format!("turn {} = {}{range}", name(symbol), of(principal))
        }
        Step::Guard { determinant, scale, .. } => format!("guard {} against {}", of(determinant), of(scale)),
        Step::Factor { matrix, .. } => format!("factor {}", rows(matrix)),
        Step::Solve { targets, right, .. } => format!("solve {} from {}", names(targets), all(right)),
        Step::Chord { symbol, factors: [low, high], .. } => {
            format!("chord {}^2 = ({}) * ({})", name(symbol), of(low), of(high))
        }
        Step::Solvable { determinant, .. } => format!("solvable by {}", of(determinant)),
        Step::Reach { length, .. } => format!("reach {}", of(length)),
        Step::Newton { targets, start, .. } => format!("newton {} from {}", names(targets), all(start)),
        Step::Modes { targets, .. } => format!("modes {}", names(targets)),
        Step::Pivots { symbol, matrix } => format!("pivots {} of {}", name(symbol), rows(matrix)),
    }
}

fn list(all: &[Expression]) -> String {
    all.iter().map(expression).collect::<Vec<_>>().join(", ")
}

fn expression(of: &Expression) -> String {
    match of {
        Expression::Name(name) | Expression::Text(name) => name.clone(),
        Expression::Result(index) => format!("#{index}"),
        Expression::Local(index) => format!("%{index}"),
        Expression::Number(number) => number.to_string(),
        Expression::Sum(terms) => format!("({})", terms.iter().map(expression).collect::<Vec<_>>().join(" + ")),
        Expression::Product(factors) => factors.iter().map(expression).collect::<Vec<_>>().join(" * "),
        Expression::Negative(inside) => format!("-{}", expression(inside)),
        Expression::Elementary(function, arguments) => format!("{}({})", function.name(), list(arguments)),
        Expression::All(conditions) => conditions.iter().map(expression).collect::<Vec<_>>().join(" and "),
        Expression::Count(count) => count.to_string(),
        Expression::Constant(constant) => constant.path().to_owned(),
        Expression::Field(inside, name) => format!("{}.{name}", expression(inside)),
        Expression::Index(inside, index) => format!("{}[{index}]", expression(inside)),
        Expression::At(of) => format!("{}[{}]", expression(&of[0]), expression(&of[1])),
        Expression::List(all) => format!("[{}]", list(all)),
        Expression::Repeated(one, count) => format!("[{}; {count}]", expression(one)),
        Expression::Tuple(all) => format!("({})", list(all)),
        Expression::Struct(of, members, _) => {
            let members = members.iter().map(|(name, value)| format!("{name}: {}", expression(value)));
            format!("{} {{ {} }}", type_of(of), members.collect::<Vec<_>>().join(", "))
        }
        Expression::Intrinsic(function, _, arguments) => format!("{}({})", function.row().name, list(arguments)),
        Expression::Function(function, _) => function.row().name.to_owned(),
        Expression::Own(on, name, arguments) => {
            let on = match &**on {
                Receiver::Itself => "self".to_owned(),
                Receiver::ItsType => "Self".to_owned(),
                Receiver::Value(value) => expression(value),
                Receiver::Type(of) => type_of(of),
            };
            format!("{on}.{name}({})", list(arguments))
        }
        Expression::Try(inside) => format!("{}?", expression(inside)),
        Expression::Borrowed(inside) | Expression::MutablyBorrowed(inside) | Expression::Dereferenced(inside) => {
            expression(inside)
        }
        Expression::Closure { arguments, statements, value, .. } => {
            let arguments: Vec<String> = arguments.iter().map(pattern).collect();
            format!("|{}| {}", arguments.join(", "), block(statements, value))
        }
        Expression::Block(statements, value) => block(statements, value),
    }
}

fn block(statements: &[Statement], value: &Expression) -> String {
    let statements: String = statements.iter().map(|one| format!("{}; ", statement(one))).collect();
    format!("{{ {statements}{} }}", expression(value))
}

fn statement(of: &Statement) -> String {
    match of {
        Statement::Let(to, value) => format!("{} = {}", pattern(to), expression(value)),
        Statement::Do(value) => expression(value),
        Statement::Assign(to, value) => format!("{} := {}", expression(to), expression(value)),
        Statement::LetElse(to, value, otherwise) => {
            format!("{} = {}, else return {}", pattern(to), expression(value), expression(otherwise))
        }
        Statement::ReturnUnless(condition, otherwise) => {
            format!("unless {}: return {}", expression(condition), expression(otherwise))
        }
        Statement::Refine(to, value, precise) => {
            format!("{} = {}, or {} if digits are lost", pattern(to), expression(value), expression(precise))
        }
        Statement::Check { what, values, .. } => format!("check finite {what}: {}", list(values)),
        Statement::CheckPosition => "check finite position".to_owned(),
        Statement::CheckKinematics { conditions, otherwise } => {
            format!("check finite results and {}, else return {}", list(conditions), expression(otherwise))
        }
        Statement::LetAccepted(to, conditions) => format!("{} = accepted({})", pattern(to), list(conditions)),
        Statement::LetPassed(to) => format!("{} = passed()", pattern(to)),
    }
}

fn pattern(of: &Pattern<Variable>) -> String {
    let all = |all: &[Pattern<Variable>]| all.iter().map(pattern).collect::<Vec<_>>().join(", ");
    match of {
        Pattern::Bound(variable) | Pattern::Mutable(variable) | Pattern::Typed(variable, _) => match variable {
            Variable::Name(name) => name.clone(),
            Variable::Local(index) => format!("%{index}"),
        },
        Pattern::Case(_, inside) => pattern(inside),
        Pattern::Ignored => "_".to_owned(),
        Pattern::List(inside) => format!("[{}]", all(inside)),
        Pattern::Tuple(inside) => format!("({})", all(inside)),
        Pattern::Struct { fields, .. } => {
            let fields = fields.iter().map(|(name, inside)| format!("{name}: {}", pattern(inside)));
            format!("{{{}}}", fields.collect::<Vec<_>>().join(", "))
        }
    }
}

/// The name of a type, without its parameters.
fn type_of(of: &Type) -> String {
    match of {
        Type::Own(name) | Type::Wide(name) | Type::Bare(name) | Type::Each(name, _) => name.clone(),
        Type::Runtime(name, _) | Type::Sized(name, _) | Type::Around(name, _) => (*name).to_owned(),
        Type::Itself => "Self".to_owned(),
        _ => "T".to_owned(),
    }
}
