//! Results that are stored as they become known: group by group, not at the end.
//!
//! At the end of a long kernel there are more results than registers: the compiler of the emitted code keeps them in memory
//! until then, and reads and stores them again. `kinematics` of a chain of 16 four-bars takes 0.91 of the time so, and of 4
//! 0.95; `motion` of Stephenson III 0.95, of the Jansen leg 0.99, of a chain of 16 0.97 (`benches/poses`).

use linkage_ir::ValueId;
use rustc_hash::FxHashSet;

use super::code::may_return;
use super::value::{Statement, bound_by};
use super::values::Values;

/// Assigns results to their members, each before the next statement that may return an error instead.
pub(super) fn stored(values: &Values, statements: Vec<Statement>, members: Vec<(ValueId, ValueId)>) -> Vec<Statement> {
    let mut open = members;
    let mut unknown: FxHashSet<ValueId> = statements.iter().flat_map(bound_by).collect();
    let mut all = Vec::new();
    for statement in statements {
        if may_return(&statement, &values.all) {
            let is_open = |(_, value): &(ValueId, ValueId)| values.uses().reads(*value, |id| unknown.contains(&id));
            let (later, known): (Vec<_>, Vec<_>) = open.into_iter().partition(is_open);
            all.extend(known.into_iter().map(|(member, value)| Statement::Assign(member, value)));
            open = later;
        }
        bound_by(&statement).iter().for_each(|bound| {
            unknown.remove(bound);
        });
        all.push(statement);
    }
    all.extend(open.into_iter().map(|(member, value)| Statement::Assign(member, value)));
    all
}
