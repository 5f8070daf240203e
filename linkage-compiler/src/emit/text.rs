//! Prints a program as plain text, one line for each statement, without types; snapshot tests compare it.

use std::fmt::Write;

use crate::graph::Number;
use crate::lower::{Bound, Code};
use crate::program::{Access, Expression, Function, Operations, Pattern, Program, Statement, Type, count};

/// The functions of a driver and of its scenes.
#[must_use]
pub fn text(program: &Program<Code>) -> String {
    let mut text = functions(&program.signatures.types.itself, &program.functions);
    for implementation in &program.implementations {
        text += &functions(&implementation.title(), &implementation.functions);
    }
    for scene in &program.scenes {
        text += &functions(&scene.signatures.types.itself, &scene.functions);
        if let Some(implementation) = &scene.implementation {
            text += &functions(&implementation.title(), &implementation.functions);
        }
    }
    text
}

fn functions(of: &str, functions: &[Function<Code>]) -> String {
    let mut text = format!("{of}\n");
    for function in functions {
        let arguments: Vec<&str> = function.arguments.iter().map(|argument| argument.name.as_str()).collect();
        let access = match function.access {
            Access::Public | Access::PublicInlined | Access::Hidden | Access::PublicLayer => "",
            Access::Inlined | Access::Layer | Access::Lane | Access::LaneAlone => "inlined ",
            Access::Cold => "cold ",
            Access::OfTrait => "of a trait ",
            Access::Deprecated => "deprecated ",
        };
        let or_error = if function.is_fallible { " or an error" } else { "" };
        let _ = writeln!(text, "\n{access}{}({}){or_error}", function.name, arguments.join(", "));
        let Some(code) = &function.body else { continue };
        if code.operations != Operations::default() {
            let _ = writeln!(text, "    # {}", count(code.operations));
        }
        if let Some(bound) = code.bound.as_ref().and_then(Bound::sentence) {
            let _ = writeln!(text, "    # {bound}");
        }
        for statement in &code.statements {
            let _ = writeln!(text, "    {}", self::statement(statement));
        }
        let value = code.value.returned();
        let _ = writeln!(text, "    {}", expression(value));
    }
    text + "\n"
}

fn statement(statement: &Statement) -> String {
    match statement {
        Statement::Let(pattern, value) => format!("{} = {}", self::pattern(pattern), expression(value)),
        Statement::Do(value) => expression(value),
        Statement::Assign(place, value) => format!("{} := {}", expression(place), expression(value)),
        Statement::Return(value) => format!("return {}", expression(value)),
        Statement::LetElse(pattern, value, otherwise) => {
            format!("{} = {}, else return {}", self::pattern(pattern), expression(value), expression(otherwise))
        }
        Statement::Unless(conditions, inside) => {
            let inside: Vec<String> = inside.iter().map(self::statement).collect();
            format!("unless {}: {}", expressions(conditions), inside.join("; "))
        }
        Statement::Check { what, values, .. } => format!("check {what}: {}", expressions(values)),
        Statement::Refine(to, rough, precise) => {
            format!("{} = {}, or {}", pattern(to), expression(rough), expression(precise))
        }
        Statement::CheckPosition => "check the position".to_owned(),
        Statement::LetAccepted(to, _) | Statement::LetPassed(to) => format!("{} = all checks", pattern(to)),
        Statement::CheckKinematics { otherwise, .. } => format!("check all, else return {}", expression(otherwise)),
    }
}

fn pattern(pattern: &Pattern) -> String {
    let all = |patterns: &[Pattern]| patterns.iter().map(self::pattern).collect::<Vec<_>>().join(", ");
    match pattern {
        Pattern::Name(name) | Pattern::Typed(name, _) => name.clone(),
        Pattern::Mutable(inside) | Pattern::Case(_, inside) => self::pattern(inside),
        Pattern::Ignored | Pattern::Local(_) => "_".to_owned(),
        Pattern::List(patterns) => format!("[{}]", all(patterns)),
        Pattern::Tuple(patterns) => format!("({})", all(patterns)),
        Pattern::Struct { fields, .. } => {
            let field = |(field, pattern): &(String, Pattern)| match pattern {
                Pattern::Name(name) if name == field => field.clone(),
                pattern => format!("{field}: {}", self::pattern(pattern)),
            };
            format!("{{{}}}", fields.iter().map(field).collect::<Vec<_>>().join(", "))
        }
    }
}

fn expressions(values: &[Expression]) -> String {
    values.iter().map(expression).collect::<Vec<_>>().join(", ")
}

/// An operand: sums, quotients and negatives in brackets.
fn part(value: &Expression) -> String {
    match value {
        Expression::Sum(_) | Expression::Quotient(_) | Expression::Negative(_) => format!("({})", expression(value)),
        _ => expression(value),
    }
}

fn expression(value: &Expression) -> String {
    match value {
        Expression::Name(name) => name.clone(),
        Expression::Number(Number::Ratio(n, 1)) => n.to_string(),
        Expression::Number(Number::Ratio(n, d)) => format!("({n}/{d})"),
        Expression::Number(Number::Float(value)) => value.to_string(),
        Expression::Exact(number) => format!("exactly {number}"),
        Expression::Sum(terms) => {
            let mut text = String::new();
            for (place, (is_negative, term)) in terms.iter().enumerate() {
                text += match (place, is_negative) {
                    (0, false) => "",
                    (0, true) => "-",
                    (_, false) => " + ",
                    (_, true) => " - ",
                };
                text += &part(term);
            }
            text
        }
        Expression::Product(factors) => factors.iter().map(part).collect::<Vec<_>>().join("*"),
        Expression::Quotient(parts) => format!("{}/{}", part(&parts[0]), part(&parts[1])),
        Expression::Square(base) => format!("{}^2", part(base)),
        Expression::Negative(inside) => format!("-{}", part(inside)),
        Expression::Elementary(function, arguments) => {
            format!("{}({})", function.operation().name, expressions(arguments))
        }
        Expression::All(conditions) => conditions.iter().map(expression).collect::<Vec<_>>().join(" and "),
        Expression::Text(text) => format!("\"{text}\""),
        Expression::Count(count) => count.to_string(),
        Expression::Constant(path) => (*path).to_owned(),
        Expression::Field(of, name) => format!("{}.{name}", expression(of)),
        Expression::Index(of, place) => format!("{}[{place}]", expression(of)),
        Expression::At(parts) => format!("{}[{}]", expression(&parts[0]), expression(&parts[1])),
        Expression::List(values) => format!("[{}]", expressions(values)),
        Expression::Repeated(value, count) => format!("[{}; {count}]", expression(value)),
        Expression::Tuple(values) => format!("({})", expressions(values)),
        Expression::Struct(of, members, rest) => {
            let member = |(field, value): &(String, Expression)| match value {
                Expression::Name(name) if name == field => field.clone(),
                value => format!("{field}: {}", expression(value)),
            };
            let mut members: Vec<String> = members.iter().map(member).collect();
            members.extend(rest.iter().map(|rest| format!("..{}", expression(rest))));
            format!("{} {{{}}}", path(of), members.join(", "))
        }
        Expression::Runtime(name, arguments) => format!("{name}({})", expressions(arguments)),
        Expression::Associated(of, name, arguments) => format!("{}::{name}({})", path(of), expressions(arguments)),
        Expression::Function(of, name) => format!("{}::{name}", path(of)),
        Expression::Method(of, name, arguments) => format!("{}.{name}({})", part(of), expressions(arguments)),
        Expression::Try(value) => format!("{}?", expression(value)),
        Expression::Borrowed(value) | Expression::MutablyBorrowed(value) | Expression::Dereferenced(value) => {
            expression(value)
        }
        Expression::Closure { arguments, statements, value, .. } => {
            let arguments = arguments.iter().map(pattern).collect::<Vec<_>>().join(", ");
            let statements: String = statements.iter().map(|line| format!("{}; ", statement(line))).collect();
            format!("|{arguments}| {statements}{}", expression(value))
        }
        Expression::Block(statements, value) => {
            let statements: String = statements.iter().map(|line| format!("{}; ", statement(line))).collect();
            format!("{{ {statements}{} }}", expression(value))
        }
        Expression::Result(place) | Expression::Local(place) => format!("_{place}"),
    }
}

/// The name of a type.
fn path(of: &Type) -> String {
    match of {
        Type::Own(name) | Type::Bare(name) | Type::Each(name, _) => name.clone(),
        Type::Runtime(name, _) | Type::Sized(name, _) => (*name).to_owned(),
        Type::Itself => "Self".to_owned(),
        _ => "T".to_owned(),
    }
}
