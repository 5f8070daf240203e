//! The syntax tree: a line for each statement, its expressions with the operator first.

use linkage_compiler::syntax::{
    Attachment, Body, Declared, Effect, EffectKind, Expression, ExpressionId, Expressions, Joint, Mechanism, Operator,
    Range, Scene, Statement, StatementKind, Unit,
};
use proc_macro2::Ident;

pub fn text(mechanism: &Mechanism) -> String {
    let mut text = format!("mechanism {}\n", mechanism.name);
    for Statement { kind, .. } in &mechanism.statements {
        text += &statement(kind, &Printer(&mechanism.expressions));
    }
    mechanism.diagnostics.messages().iter().for_each(|message| text += &format!("  mistake: {message}\n"));
    text
}

fn statement(kind: &StatementKind, of: &Printer) -> String {
    let named = |keyword: &str, name: &Ident, value: &ExpressionId| format!("{keyword} {name} = {}", of.text(*value));
    let sides = |keyword: &str, left: &ExpressionId, right: &ExpressionId, is_implied: &bool| {
        let implied = if *is_implied { "implied " } else { "" };
        format!("{implied}{keyword} {} = {}", of.text(*left), of.text(*right))
    };
    let line = match kind {
        StatementKind::Parameters(all) => {
            let one = |(name, default): &(Ident, Option<ExpressionId>)| match default {
                Some(default) => format!("{name} = {}", of.text(*default)),
                None => name.to_string(),
            };
            format!("param {}", all.iter().map(one).collect::<Vec<_>>().join(", "))
        }
        StatementKind::Inputs(all) => format!("input {}", declared(all, of)),
        StatementKind::Unknowns(all) => format!("unknown {}", declared(all, of)),
        StatementKind::Coordinates(all) => format!("coordinate {}", declared(all, of)),
        StatementKind::Drive { name, by } => format!("drive {name} by {}", list(by)),
        StatementKind::Loop { left, right, is_implied } => sides("loop", left, right, is_implied),
        StatementKind::Equation { left, right, is_implied } => sides("equation", left, right, is_implied),
        StatementKind::Let { name, value } => named("let", name, value),
        StatementKind::Point { name, value } => named("point", name, value),
        StatementKind::Output { name, range, value } => {
            format!("output {name}{} = {}", in_range(range.as_ref(), of), of.text(*value))
        }
        StatementKind::External { path, arguments, names } => {
            let path: Vec<String> = path.segments.iter().map(|segment| segment.ident.to_string()).collect();
            format!("extern {}({}) -> ({})", path.join("::"), list(arguments), list(names))
        }
        StatementKind::Derive(words) => format!("derive {}", list(words)),
        StatementKind::Body(body) => return block(&format!("body {}", body.name), properties(body, of)),
        StatementKind::Scene(scene) => {
            let driver = scene.of.as_ref().map_or_else(String::new, |driver| format!(" of {driver}"));
            return block(&format!("scene {}{driver}", scene.name), effects(scene, of));
        }
        StatementKind::Quantity { name, value } => named("(no keyword)", name, value),
        StatementKind::Unread { names, .. } => format!("(not read) {}", list(names)),
    };
    format!("  {line}\n")
}

fn block(title: &str, lines: impl Iterator<Item = String>) -> String {
    lines.fold(format!("  {title}\n"), |text, line| text + &format!("    {line}\n"))
}

fn properties(body: &Body, of: &Printer) -> impl Iterator<Item = String> {
    body.properties.iter().map(|(keyword, value)| format!("{keyword} {}", of.text(*value)))
}

fn effects(scene: &Scene, of: &Printer) -> impl Iterator<Item = String> {
    scene.effects.iter().map(|Effect { keyword, kind }| {
        let rest = match kind {
            EffectKind::Inertia(bodies) => list(bodies),
            EffectKind::Gravity { field, bodies } => format!("{} on {}", of.text(*field), list(bodies)),
            EffectKind::Spring { stiffness, free, attachment } => {
                let free = free.map_or_else(String::new, |free| format!(", {}", of.text(free)));
                format!("{}{free} {}", of.text(*stiffness), along(attachment, of))
            }
            EffectKind::Damper { constant, attachment } => format!("{} {}", of.text(*constant), along(attachment, of)),
            EffectKind::Torque { law, on } => format!("{} on {}", of.text(*law), of.text(*on)),
            EffectKind::Force { law, at } => format!("{} at {}", of.text(*law), of.text(*at)),
            EffectKind::Potential(energy) => of.text(*energy),
            EffectKind::Friction { factors, reaction, on } => {
                let reaction = match reaction {
                    Some(Some(pin)) => vec![format!("reaction at {}", of.text(*pin))],
                    Some(None) => vec!["reaction".to_owned()],
                    None => Vec::new(),
                };
                let factors: Vec<String> = factors.iter().map(|factor| of.text(*factor)).chain(reaction).collect();
                format!("{} on {}", factors.join(", "), of.text(*on))
            }
            EffectKind::Stop { on, range, restitution } => {
                let range =
                    range.map_or_else(String::new, |[from, to]| format!("in {} to {} ", of.text(from), of.text(to)));
                format!("{} {range}restitution {}", of.text(*on), of.text(*restitution))
            }
            EffectKind::Drive { input, law } => format!("{input} = {}", of.text(*law)),
            EffectKind::Reaction(Joint::At(point)) => format!("at {}", of.text(*point)),
            EffectKind::Reaction(Joint::On(length)) => format!("on {}", of.text(*length)),
            EffectKind::Request => String::new(),
            EffectKind::Unread(names) => format!("(not read) {}", of.text(*names)),
        };
        format!("{keyword} {rest}").trim_end().to_owned()
    })
}

fn along(scalar: &Attachment, of: &Printer) -> String {
    match scalar {
        Attachment::On(scalar) => format!("on {}", of.text(*scalar)),
        Attachment::Between(first, second) => format!("between {} and {}", of.text(*first), of.text(*second)),
    }
}

fn declared(all: &[Declared], of: &Printer) -> String {
    let one = |Declared { name, range }: &Declared| format!("{name}{}", in_range(range.as_ref(), of));
    all.iter().map(one).collect::<Vec<_>>().join(", ")
}

fn in_range(range: Option<&Range>, of: &Printer) -> String {
    let end = |end: Option<ExpressionId>| end.map_or_else(String::new, |end| of.text(end));
    range.map_or_else(String::new, |Range { ends: [least, most], .. }| format!(" in {}..{}", end(*least), end(*most)))
}

fn list(names: &[Ident]) -> String {
    names.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ")
}

/// Prints the expressions of an arena.
struct Printer<'e>(&'e Expressions);

impl Printer<'_> {
    fn text(&self, id: ExpressionId) -> String {
        let operator = match self.0.get(id) {
            Expression::Number { digits, unit } => {
                let units = Unit::ALL.iter().filter(|(_, other)| other == unit).map(|(name, _)| *name);
                return units.fold(digits.clone(), |digits, unit| digits + unit);
            }
            Expression::Name(name) => return name.to_string(),
            Expression::Vector(..) => ",".to_owned(),
            Expression::At(..) => "@".to_owned(),
            Expression::Sum(operands) => return self.operands(operands, ["+", "-"]),
            Expression::Product(operands) => return self.operands(operands, ["*", "/"]),
            Expression::Negate(_) => "-".to_owned(),
            Expression::Power(..) => "^".to_owned(),
            Expression::Call(name, _) | Expression::Adjacent(name, _) => name.to_string(),
            Expression::Broken => return "(no value)".to_owned(),
            Expression::Unread(names) => {
                names.iter().fold("not read:".to_owned(), |all, one| format!("{all} {}", one.name))
            }
        };
        let operands = self.0.get(id).operands();
        format!("({})", operands.into_iter().fold(operator, |all, one| format!("{all} {}", self.text(one))))
    }

    /// A sum or product: the first sign stands before all, an inverse operand has its own.
    fn operands(&self, operands: &[(Operator, ExpressionId)], [direct, inverse]: [&str; 2]) -> String {
        let operand = |(operator, id): &(Operator, ExpressionId)| match operator {
            Operator::Inverse => format!(" ({inverse} {})", self.text(*id)),
            Operator::Direct | Operator::Missing => format!(" {}", self.text(*id)),
        };
        format!("({direct}{})", operands.iter().map(operand).collect::<String>())
    }
}
