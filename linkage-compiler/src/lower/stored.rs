//! Results that are stored as they become known: group by group, not at the end.
//!
//! At the end of a long kernel there are more results than registers: the compiler of the emitted code keeps them in memory
//! until then, and reads and stores them again. `kinematics` of a chain of 16 four-bars takes 0.91 of the time so, and of 4
//! 0.95; `motion` of Stephenson III 0.95, of the Jansen leg 0.99, of a chain of 16 0.97 (`benches/poses`).

use std::collections::BTreeSet;

use crate::program::{Expression, Pattern, Statement};

/// Assigns results to their members, each before the next statement that may return an error instead.
pub(super) fn stored(statements: Vec<Statement>, members: Vec<(Expression, Expression)>) -> Vec<Statement> {
    let mut open = members;
    let mut unknown = BTreeSet::new();
    statements.iter().for_each(|statement| {
        bound(statement).for_each(|pattern| pattern.each_name(&mut |name| unknown.extend([name.to_owned()])));
    });
    let mut all = Vec::new();
    for statement in statements {
        if may_return(&statement) {
            let is_open = |(_, value): &(Expression, Expression)| {
                let mut is_open = false;
                value.each_name(&mut |name| is_open |= unknown.contains(name));
                is_open
            };
            let (later, known): (Vec<_>, Vec<_>) = open.into_iter().partition(is_open);
            all.extend(known.into_iter().map(|(member, value)| Statement::Assign(member, value)));
            open = later;
        }
        bound(&statement).for_each(|pattern| {
            pattern.each_name(&mut |name| {
                unknown.remove(name);
            })
        });
        all.push(statement);
    }
    all.extend(open.into_iter().map(|(member, value)| Statement::Assign(member, value)));
    all
}

/// The pattern that a statement binds.
fn bound(statement: &Statement) -> impl Iterator<Item = &Pattern> {
    let pattern = match statement {
        Statement::Let(pattern, _) | Statement::LetElse(pattern, ..) => Some(pattern),
        _ => None,
    };
    pattern.into_iter()
}

fn may_return(statement: &Statement) -> bool {
    match statement {
        Statement::Let(_, value) | Statement::Do(value) => matches!(value, Expression::Try(_)),
        Statement::LetElse(..) | Statement::Unless(..) | Statement::Return(_) => true,
        _ => false,
    }
}
