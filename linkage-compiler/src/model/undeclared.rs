//! The messages of undeclared names, when all declarations are known: a line of declarations that is missing is one
//! mistake.

use std::collections::BTreeSet;

use super::kind::Kind;
use super::resolver::Resolver;
use super::scope::{Scope, Undeclared};
use crate::diagnostics::did_you_mean;
use crate::syntax::{Statement, StatementKind, constant_of_rust};

impl Resolver<'_> {
    /// Completes the messages of undeclared names.
    pub(super) fn report_undeclared(&mut self, statements: &[Statement]) {
        let angles = self.assumed.kinds.iter().filter(|(_, kind)| *kind == Kind::Angle);
        let angles: BTreeSet<&str> = angles.map(|(name, _)| name.as_str()).collect();
        let is_angle = |name: &str| angles.contains(name);
        let reported: Vec<&Undeclared> =
            self.scope.undeclared().iter().filter(|undeclared| undeclared.message.is_some()).collect();
        let (mut messages, mut removed) = (Vec::new(), BTreeSet::new());
        let mut single = |undeclared: &Undeclared| {
            let name = undeclared.name.to_string();
            let advice = advice(&name, &self.scope, is_angle(&name));
            messages.push((undeclared.message, undeclared.name.span(), format!("unknown name `{name}`{advice}")));
        };
        let is_similar = |undeclared: &&Undeclared| {
            let name = undeclared.name.to_string();
            name == "t" || constant_of_rust(&name).is_some() || similar(&name, &self.scope).is_some()
        };
        let lines = Lines::of(statements);
        let (similar, new): (Vec<&Undeclared>, Vec<&Undeclared>) = reported.into_iter().partition(is_similar);
        similar.into_iter().for_each(&mut single);
        let (own, other): (Vec<&Undeclared>, Vec<&Undeclared>) =
            new.into_iter().partition(|undeclared| lines.may_hold(is_angle(&undeclared.name.to_string())));
        other.into_iter().for_each(&mut single);
        if let [first, rest @ ..] = own.as_slice() {
            let names: Vec<String> = own.iter().map(|undeclared| undeclared.name.to_string()).collect();
            messages.push((first.message, first.name.span(), lines.message(&names, &is_angle)));
            removed.extend(rest.iter().filter_map(|undeclared| undeclared.message));
        }
        for (index, at, message) in messages {
            if let Some(index) = index {
                self.diagnostics.replace(index, at, message);
            }
        }
        self.diagnostics.remove(&removed);
    }
}

/// The advice for one undeclared name.
fn advice(name: &str, scope: &Scope, is_angle: bool) -> String {
    if let Some(constant) = constant_of_rust(name) {
        return format!(": write `{constant}`");
    }
    if name == "t" {
        return ": declare it with `input`, `unknown` or `param`; time is `t` in the laws of a scene".to_owned();
    }
    if name == "time" {
        return ": time is `t`, in the laws of a scene".to_owned();
    }
    if let Some(of) = of_rate(name).filter(|of| scope.is_known(of)).min() {
        return format!(": write `rate({of})`, in the laws of a scene");
    }
    match similar(name, scope) {
        Some(near) => did_you_mean(near),
        None if is_angle => ": declare it with `input`, `unknown` or `param`".to_owned(),
        None => ": declare it with `param`, `input`, `unknown` or `let`".to_owned(),
    }
}

/// The most similar name, or the only one that is this name and a number: `G3` for `G`.
fn similar<'a>(name: &str, scope: &'a Scope) -> Option<&'a str> {
    scope.nearest(name).or_else(|| {
        let is_numbered = |other: &&str| {
            let number = other.strip_prefix(name);
            number.is_some_and(|number| !number.is_empty() && number.chars().all(|digit| digit.is_ascii_digit()))
        };
        let mut numbered = scope.names().filter(is_numbered);
        numbered.next().filter(|_| numbered.next().is_none())
    })
}

/// The names of coordinates whose rate may have a name.
fn of_rate(name: &str) -> impl Iterator<Item = &str> {
    let ends = ["_dot", "dot", "_rate", "_velocity", "_p"];
    ends.into_iter().map(|end| name.strip_suffix(end)).chain([name.strip_prefix('d')]).flatten()
}

/// The lines of declarations that a mechanism lacks.
struct Lines {
    param: bool,
    input: bool,
    unknown: bool,
    coordinate: bool,
    /// The number of scalar equations.
    rows: usize,
}

impl Lines {
    fn of(statements: &[Statement]) -> Self {
        let has = |is_it: fn(&StatementKind) -> bool| statements.iter().any(|statement| is_it(&statement.kind));
        let is_open = has(|kind| matches!(kind, StatementKind::Coordinates(_) | StatementKind::Unread { .. }));
        let is_driven = has(|kind| matches!(kind, StatementKind::Drive { .. }));
        let rows = statements.iter().map(|statement| match statement.kind {
            StatementKind::Loop { .. } => 2,
            StatementKind::Equation { .. } => 1,
            _ => 0,
        });
        Self {
            param: !has(|kind| matches!(kind, StatementKind::Parameters(_) | StatementKind::Unread { .. })),
            input: !is_driven && !is_open && !has(|kind| matches!(kind, StatementKind::Inputs(_))),
            unknown: !is_driven && !is_open && !has(|kind| matches!(kind, StatementKind::Unknowns(_))),
            coordinate: is_driven && !is_open,
            rows: rows.sum(),
        }
    }

    /// True if a missing line may declare a name.
    fn may_hold(&self, is_angle: bool) -> bool {
        match is_angle {
            true => self.input || self.unknown || self.coordinate,
            false => self.param || self.input || self.unknown || self.coordinate,
        }
    }

    fn message(&self, names: &[String], is_angle: &dyn Fn(&str) -> bool) -> String {
        let all = names.iter().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ");
        let plural = if names.len() == 1 { "" } else { "s" };
        let (coordinates, parameters): (Vec<&String>, Vec<&String>) =
            names.iter().partition(|name| !self.param || is_angle(name));
        let inputs = match (self.input, self.unknown) {
            (true, true) => coordinates.len().saturating_sub(self.rows),
            (true, false) => coordinates.len(),
            _ => 0,
        };
        let (inputs, unknowns) = coordinates.split_at(inputs);
        let lists = [
            ("param", parameters),
            ("input", inputs.to_vec()),
            (if self.coordinate { "coordinate" } else { "unknown" }, unknowns.to_vec()),
        ];
        let lists = lists.into_iter().filter(|(_, names)| !names.is_empty());
        let (missing, written): (Vec<String>, Vec<String>) = lists
            .map(|(word, names)| {
                let names = names.into_iter().map(String::as_str).collect::<Vec<_>>().join(", ");
                (format!("`{word}`"), format!("`{word} {names};`"))
            })
            .unzip();
        let (missing, written) = (missing.join(" and no "), written.join(" and "));
        format!("unknown name{plural} {all}: this mechanism has no {missing}; write {written}")
    }
}
