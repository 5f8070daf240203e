//! Prints a program as plain text, one line for each statement, without types; snapshot tests compare it.

use std::fmt::Write;

use linkage_ir::code::{Code, Names};

use super::printer::{Binding, Member, On, Printer, Style};
use crate::graph::{Function as Elementary, Number};
use crate::program::{Access, Constant, Function, Intrinsic, Operations, Program, Type, count};

/// The functions of a driver and of its scenes.
#[must_use]
pub fn text(program: &Program<Code>) -> String {
    let names = &program.names;
    let mut text = functions(&program.signatures.types.itself, &program.functions, names);
    for implementation in &program.implementations {
        text += &functions(&implementation.title(), &implementation.functions, names);
    }
    for scene in &program.scenes {
        text += &functions(&scene.signatures.types.itself, &scene.functions, names);
        if let Some(implementation) = &scene.implementation {
            text += &functions(&implementation.title(), &implementation.functions, names);
        }
    }
    text
}

fn functions<'f>(of: &str, functions: impl IntoIterator<Item = &'f Function<Code>>, names: &Names) -> String {
    let mut text = format!("{of}\n");
    for function in functions {
        text += &format!("\n{}", function_as_text(function, names));
    }
    text + "\n"
}

/// A function: its signature, its operation counts, how large its rounding errors can be, and its statements.
#[must_use]
pub fn function_as_text(function: &Function<Code>, names: &Names) -> String {
    let mut text = String::new();
    let arguments: Vec<&str> = function.arguments.iter().map(|argument| argument.name.as_str()).collect();
    let access = match function.access {
        Access::Public | Access::PublicInlined | Access::Hidden | Access::PublicLayer => "",
        Access::Inlined | Access::Layer | Access::Lane | Access::LaneAlone => "inlined ",
        Access::Cold => "cold ",
        Access::OfTrait | Access::OfMechanism => "of a trait ",
        Access::Deprecated => "deprecated ",
    };
    let or_error = if function.is_fallible { " or an error" } else { "" };
    let _ = writeln!(text, "{access}{}({}){or_error}", function.name, arguments.join(", "));
    let Some(code) = &function.body else { return text };
    if code.readable.operations != Operations::default() {
        let _ = writeln!(text, "    # {}", count(code.readable.operations));
    }
    if let Some(bound) = &code.readable.accuracy {
        let _ = writeln!(text, "    # {bound}");
    }
    let printer = Printer { code, names, style: Plain };
    let lines = printer.statements(&code.statements).into_iter().chain([printer.value(code.value.returned())]);
    lines.for_each(|line| {
        let _ = writeln!(text, "    {line}");
    });
    text
}

/// Text without types and references.
struct Plain;

impl Style for Plain {
    type Text = String;

    fn brackets(&self, inside: String) -> String {
        format!("({inside})")
    }

    fn name(&self, name: &str) -> String {
        name.to_owned()
    }

    fn number(&self, number: Number) -> String {
        match number {
            Number::Ratio(n, 1) => n.to_string(),
            Number::Ratio(n, d) => format!("({n}/{d})"),
            Number::Float(value) => value.to_string(),
        }
    }

    fn turn(&self, number: Number, _count: i32, _parts: u32) -> String {
        self.number(number)
    }

    fn turn_binding(&self) -> Binding {
        Binding::Atom
    }

    fn exact(&self, number: Number) -> String {
        format!("exactly {number}")
    }

    fn exact_binding(&self, _number: Number) -> Binding {
        Binding::Atom
    }

    fn sum(&self, terms: Vec<(bool, String)>) -> String {
        let terms = terms.into_iter().enumerate().map(|(index, (is_negative, term))| match (index, is_negative) {
            (0, false) => term,
            (0, true) => format!("-{term}"),
            (_, false) => format!(" + {term}"),
            (_, true) => format!(" - {term}"),
        });
        terms.collect()
    }

    fn product(&self, factors: Vec<String>) -> String {
        // Two signs side by side are hard to read.
        let apart = |(index, factor): (usize, String)| match index > 0 && factor.starts_with('-') {
            true => self.brackets(factor),
            false => factor,
        };
        factors.into_iter().enumerate().map(apart).collect::<Vec<_>>().join("*")
    }

    fn quotient(&self, above: String, below: String) -> String {
        format!("{above}/{below}")
    }

    fn square(&self, first: String, _later: String) -> String {
        format!("{first}^2")
    }

    fn square_binding(&self) -> Binding {
        Binding::Atom
    }

    fn negative(&self, inside: String) -> String {
        format!("-{inside}")
    }

    fn argument(&self, _binding: Binding, first: String) -> String {
        first
    }

    fn elementary(&self, function: Elementary, first: Option<String>, others: Vec<String>) -> String {
        let arguments: Vec<String> = first.into_iter().chain(others).collect();
        format!("{}({})", function.name(), arguments.join(", "))
    }

    fn all(&self, conditions: Vec<String>) -> String {
        conditions.join(" and ")
    }

    fn text(&self, text: &str) -> String {
        format!("\"{text}\"")
    }

    fn count(&self, count: usize) -> String {
        count.to_string()
    }

    fn constant(&self, constant: Constant) -> String {
        constant.path().to_owned()
    }

    fn field(&self, of: String, name: &str) -> String {
        format!("{of}.{name}")
    }

    fn index(&self, of: String, index: usize) -> String {
        format!("{of}[{index}]")
    }

    fn entry(&self, of: String, index: String) -> String {
        format!("{of}[{index}]")
    }

    fn list(&self, values: Vec<String>) -> String {
        format!("[{}]", values.join(", "))
    }

    fn repeated(&self, value: String, count: usize) -> String {
        format!("[{value}; {count}]")
    }

    fn tuple(&self, values: Vec<String>) -> String {
        format!("({})", values.join(", "))
    }

    fn structure(&self, of: &Type, members: Vec<Member<String>>, rest: Option<String>) -> String {
        let rest = rest.map(|rest| format!("..{rest}"));
        let members: Vec<String> = members.into_iter().map(member).chain(rest).collect();
        format!("{} {{{}}}", path(of), members.join(", "))
    }

    fn call(&self, on: On<String>, name: &str, arguments: Vec<String>) -> String {
        let arguments = arguments.join(", ");
        match on {
            On::Value(of) | On::Mechanism(of) => format!("{of}.{name}({arguments})"),
            On::Type(of) => format!("{}::{name}({arguments})", path(&of)),
            On::Runtime => format!("{name}({arguments})"),
        }
    }

    fn function(&self, of: Option<&Type>, name: &str) -> String {
        of.map_or_else(|| name.to_owned(), |of| format!("{}::{name}", path(of)))
    }

    fn tried(&self, value: String) -> String {
        format!("{value}?")
    }

    fn borrowed(&self, value: String) -> String {
        value
    }

    fn mutably_borrowed(&self, value: String) -> String {
        value
    }

    fn dereferenced(&self, value: String) -> String {
        value
    }

    fn reference_binding(&self, of: Binding) -> Binding {
        of
    }

    fn closure(&self, arguments: Vec<String>, statements: Vec<String>, value: String, _moves: bool) -> String {
        let statements: String = statements.iter().map(|line| format!("{line}; ")).collect();
        format!("|{}| {statements}{value}", arguments.join(", "))
    }

    fn block(&self, statements: Vec<String>, value: Option<String>) -> String {
        let statements: String = statements.iter().map(|line| format!("{line}; ")).collect();
        format!("{{ {statements}{} }}", value.unwrap_or_else(|| "()".to_owned()))
    }

    fn let_statement(&self, pattern: String, value: String) -> String {
        format!("{pattern} = {value}")
    }

    fn do_statement(&self, value: String) -> String {
        value
    }

    fn assignment(&self, to: String, value: String) -> String {
        format!("{to} := {value}")
    }

    fn return_statement(&self, value: String) -> String {
        format!("return {value}")
    }

    fn let_else(&self, pattern: String, value: String, otherwise: String) -> String {
        format!("{pattern} = {value}, else return {otherwise}")
    }

    fn unless(&self, conditions: Vec<String>, inside: Vec<String>) -> String {
        format!("unless {}: {}", conditions.join(", "), inside.join("; "))
    }

    fn ignored(&self) -> String {
        "_".to_owned()
    }

    fn mutable(&self, name: String) -> String {
        name
    }

    fn case(&self, _case: Intrinsic, inside: String) -> String {
        inside
    }

    fn typed(&self, name: String, _of: &Type) -> String {
        name
    }

    fn struct_pattern(&self, _of: &Type, fields: Vec<Member<String>>, _is_whole: bool) -> String {
        let fields: Vec<String> = fields.into_iter().map(member).collect();
        format!("{{{}}}", fields.join(", "))
    }
}

/// `name: value`, or the name alone.
fn member((name, value): Member<String>) -> String {
    match value {
        Some(value) => format!("{name}: {value}"),
        None => name,
    }
}

/// The name of a type.
fn path(of: &Type) -> String {
    match of {
        Type::Own(name) | Type::Bare(name) | Type::Each(name, _) => name.clone(),
        Type::Runtime(name, _) | Type::Sized(name, _) => (*name).to_owned(),
        Type::Itself => "Self".to_owned(),
        Type::List(..) => "List".to_owned(),
        _ => "T".to_owned(),
    }
}
