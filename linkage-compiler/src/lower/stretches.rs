//! Division of long functions into blocks (stretches) that return only the values that later statements use.
//!
//! Every `let` opens a scope inside that of the previous `let`, and rustc recurses through these scopes when it writes
//! debug information: more than about 3000 overflow its stack. With blocks, the depth is the length of a stretch plus
//! the number of stretches.

use std::collections::BTreeSet;

use linkage_ir::ValueId;
use rustc_hash::{FxHashMap, FxHashSet};

use super::value::{Block, Pattern, Statement, Value, bound_by};
use super::values::Values;

/// The largest number of `let`s that are not divided. The longest function of the mechanisms under test has 150
/// (the sensitivities of Jansen's leg); one of 3050 statements compiles, one of 3240 does not. With half the limit,
/// functions would be divided needlessly, and division repeats names; with twice the limit, such a function inlined
/// into another would overflow.
const MOST_LETS: usize = 1024;

/// The nominal number of statements of a stretch. With half of it there are twice as many blocks, which return more
/// values in total; with twice as many the scopes are twice as deep.
const STRETCH: usize = 256;

/// A stretch ends up to this number of statements before or after its nominal end: where the fewest values are live,
/// that is computed before and used after.
const LEEWAY: usize = STRETCH / 4;

/// The largest number of names that a statement in a stretch binds. One with more, such as an unpacking of arguments,
/// is placed between stretches, since nearly all of its names are used later.
const MOST_NAMES: usize = 16;

/// Divides statements into stretches if more than [`MOST_LETS`] of them are `let`s; `later` are the values used after them.
pub(super) fn divided(values: &mut Values, mut statements: Vec<Statement>, later: &[ValueId]) -> Vec<Statement> {
    if lets(&statements) <= MOST_LETS {
        return statements;
    }
    let mut used: FxHashSet<ValueId> = FxHashSet::default();
    for value in later {
        values.uses().value(*value, &mut |id| {
            used.insert(id);
        });
    }
    statements = read_late(values, statements);
    while lets(&statements) > MOST_LETS {
        let before = statements.len();
        statements = divided_once(values, statements, &used);
        // Statements between stretches are not divided further.
        if statements.len() == before {
            break;
        }
    }
    statements
}

/// The number of statements that open a scope.
fn lets(statements: &[Statement]) -> usize {
    statements.iter().filter(|statement| statement.pattern().is_some()).count()
}

/// Moves `let`s that only read fields to their first use, so that their values cross fewer stretches.
fn read_late(values: &Values, statements: Vec<Statement>) -> Vec<Statement> {
    let mut reads: Vec<Option<Statement>> = Vec::new();
    let mut indices: FxHashMap<ValueId, usize> = FxHashMap::default();
    let mut late = Vec::new();
    for statement in statements {
        let mut used: BTreeSet<usize> = BTreeSet::new();
        values.uses().statement(&statement, &mut |id| used.extend(indices.get(&id)));
        match &statement {
            Statement::Let(pattern, value) if used.is_empty() && is_read(values, *value) => {
                pattern.each(&mut |bound| {
                    indices.insert(*bound, reads.len());
                });
                reads.push(Some(statement));
            }
            _ => {
                late.extend(used.into_iter().filter_map(|index| reads[index].take()));
                late.push(statement);
            }
        }
    }
    late.extend(reads.into_iter().flatten());
    late
}

/// True if a value is a field or a tuple of fields.
fn is_read(values: &Values, id: ValueId) -> bool {
    match values.get(id) {
        Value::Field(of, _) | Value::Member(of, _) | Value::Columns(of) => {
            values.is_bound[of.index()] || is_read(values, *of)
        }
        Value::Tuple(all) => !all.is_empty() && all.iter().all(|one| is_read(values, *one)),
        _ => false,
    }
}

/// Divides statements into stretches once; long sequences of stretches may be divided again.
fn divided_once(values: &mut Values, statements: Vec<Statement>, later: &FxHashSet<ValueId>) -> Vec<Statement> {
    let liveness = Liveness::of(values, &statements, later);
    let mut divided = Vec::new();
    let mut statements = statements.into_iter();
    let mut index = 0;
    while index < liveness.bound.len() {
        let end = liveness.end(index);
        let inside = statements.by_ref().take(end - index);
        // A few statements between separate ones need no block.
        if end - index < STRETCH - LEEWAY {
            divided.extend(inside);
        } else {
            divided.push(stretch(values, inside.collect(), liveness.crossing(index..end)));
        }
        index = end;
    }
    divided
}

/// A statement that binds these values to those that a block of statements returns.
fn stretch(values: &mut Values, statements: Vec<Statement>, crossing: Vec<ValueId>) -> Statement {
    let value = match crossing.as_slice() {
        &[only] => only,
        all => values.add(Value::Tuple(all.to_vec())),
    };
    let block = values.add(Value::Block(Box::new(Block { statements, value })));
    match crossing.as_slice() {
        [] => Statement::Do(block),
        &[only] => Statement::Let(Pattern::Bound(only), block),
        _ => Statement::Let(Pattern::Tuple(crossing.into_iter().map(Pattern::Bound).collect()), block),
    }
}

/// The liveness of values: where statements bind them, and where they are used last.
struct Liveness {
    /// For each statement, the values that it binds.
    bound: Vec<Vec<ValueId>>,
    /// For each statement, the values of which it is the last use.
    used_last: Vec<Vec<ValueId>>,
    /// The last statement that uses each value; `usize::MAX` for those used after all of them.
    last: FxHashMap<ValueId, usize>,
    /// True for statements that are placed between stretches.
    is_separate: Vec<bool>,
}

impl Liveness {
    fn of(values: &Values, statements: &[Statement], later: &FxHashSet<ValueId>) -> Self {
        let mut last: FxHashMap<ValueId, usize> = FxHashMap::default();
        for (index, statement) in statements.iter().enumerate() {
            values.uses().statement(statement, &mut |id| {
                last.insert(id, index);
            });
        }
        last.extend(later.iter().map(|id| (*id, usize::MAX)));
        let mut used_last = vec![Vec::new(); statements.len()];
        for (id, &index) in &last {
            if let Some(used_last) = used_last.get_mut(index) {
                used_last.push(*id);
            }
        }
        let bound: Vec<Vec<ValueId>> = statements.iter().map(bound_by).collect();
        let is_separate = bound.iter().map(|bound| bound.len() > MOST_NAMES).collect();
        Self { bound, used_last, last, is_separate }
    }

    /// The end of the stretch that begins at `start`.
    fn end(&self, start: usize) -> usize {
        let length =
            self.is_separate[start..].iter().take(STRETCH + LEEWAY).take_while(|is_separate| !**is_separate).count();
        if length < STRETCH + LEEWAY {
            return start + length.max(1);
        }
        let mut alive: FxHashSet<ValueId> = FxHashSet::default();
        let mut best = (usize::MAX, start + STRETCH);
        for index in start..start + length {
            alive.extend(self.bound[index].iter().filter(|id| self.is_used_after(**id, index)));
            for id in &self.used_last[index] {
                alive.remove(id);
            }
            if index + 1 >= start + STRETCH - LEEWAY {
                best = best.min((alive.len(), index + 1));
            }
        }
        best.1
    }

    fn is_used_after(&self, id: ValueId, index: usize) -> bool {
        self.last.get(&id).is_some_and(|&last| last > index)
    }

    /// The values of a stretch that are used after it.
    fn crossing(&self, stretch: std::ops::Range<usize>) -> Vec<ValueId> {
        let end = stretch.end;
        let bound = self.bound[stretch].iter().flatten();
        bound.filter(|id| self.is_used_after(**id, end - 1)).copied().collect()
    }
}
