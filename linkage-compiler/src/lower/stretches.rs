//! Division of long functions into blocks (stretches) that return only the values that later statements use.
//!
//! Every `let` opens a scope inside that of the previous `let`, and rustc recurses through these scopes when it writes
//! debug information: more than about 3000 overflow its stack. With blocks, the depth is the length of a stretch plus
//! the number of stretches.

use std::collections::BTreeSet;

use rustc_hash::{FxHashMap, FxHashSet};

use crate::program::{Expression, Pattern, Statement};

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

/// Divides statements into stretches if more than [`MOST_LETS`] of them are `let`s; `later` are the names used after them.
pub(super) fn divided<'e>(mut statements: Vec<Statement>, later: impl IntoIterator<Item = &'e str>) -> Vec<Statement> {
    if lets(&statements) <= MOST_LETS {
        return statements;
    }
    let later: FxHashSet<String> = later.into_iter().map(str::to_owned).collect();
    statements = read_late(statements);
    while lets(&statements) > MOST_LETS {
        let before = statements.len();
        statements = divided_once(statements, &later);
        // Statements between stretches are not divided further.
        if statements.len() == before {
            break;
        }
    }
    statements
}

/// The number of statements that open a scope.
fn lets(statements: &[Statement]) -> usize {
    statements.iter().filter(|statement| matches!(statement, Statement::Let(..) | Statement::LetElse(..))).count()
}

/// Moves `let`s that only read fields to their first use, so that their names cross fewer stretches.
fn read_late(statements: Vec<Statement>) -> Vec<Statement> {
    let mut reads: Vec<Option<Statement>> = Vec::new();
    let mut places: FxHashMap<String, usize> = FxHashMap::default();
    let mut late = Vec::new();
    for statement in statements {
        let mut used: BTreeSet<usize> = BTreeSet::new();
        statement.each_name(&mut |name| used.extend(places.get(name)));
        match &statement {
            Statement::Let(pattern, value) if used.is_empty() && is_read(value) => {
                pattern.each_name(&mut |name| {
                    places.insert(name.to_owned(), reads.len());
                });
                reads.push(Some(statement));
            }
            _ => {
                late.extend(used.into_iter().filter_map(|place| reads[place].take()));
                late.push(statement);
            }
        }
    }
    late.extend(reads.into_iter().flatten());
    late
}

/// True if a value is a field or a tuple of fields.
fn is_read(value: &Expression) -> bool {
    match value {
        Expression::Field(of, _) => matches!(**of, Expression::Name(_)) || is_read(of),
        Expression::Tuple(values) => !values.is_empty() && values.iter().all(is_read),
        _ => false,
    }
}

/// Divides statements into stretches once; long sequences of stretches may be divided again.
fn divided_once(statements: Vec<Statement>, later: &FxHashSet<String>) -> Vec<Statement> {
    let liveness = Liveness::of(&statements, later);
    let mut divided = Vec::new();
    let mut statements = statements.into_iter();
    let mut place = 0;
    while place < liveness.bound.len() {
        let end = liveness.end(place);
        let inside = statements.by_ref().take(end - place);
        // A few statements between separate ones need no block.
        if end - place < STRETCH - LEEWAY {
            divided.extend(inside);
        } else {
            divided.push(stretch(inside.collect(), liveness.crossing(place..end)));
        }
        place = end;
    }
    divided
}

/// A statement that binds these names to the values that a block of statements returns.
fn stretch(inside: Vec<Statement>, names: Vec<String>) -> Statement {
    let block = |value| Expression::Block(inside, Box::new(value));
    match names.as_slice() {
        [] => Statement::Do(block(Expression::Tuple(Vec::new()))),
        [only] => Statement::Let(Pattern::Name(only.clone()), block(Expression::name(only))),
        _ => {
            let pattern = Pattern::Tuple(names.iter().cloned().map(Pattern::Name).collect());
            Statement::Let(pattern, block(Expression::Tuple(names.into_iter().map(Expression::Name).collect())))
        }
    }
}

/// The liveness of names: where statements bind them, and where they are used last.
struct Liveness {
    /// For each statement, the names that it binds.
    bound: Vec<Vec<String>>,
    /// For each statement, the names of which it is the last use.
    used_last: Vec<Vec<String>>,
    /// The last statement that uses each name; `usize::MAX` for names used after all of them.
    last: FxHashMap<String, usize>,
    /// True for statements that are placed between stretches.
    is_separate: Vec<bool>,
}

impl Liveness {
    fn of(statements: &[Statement], later: &FxHashSet<String>) -> Self {
        let mut last: FxHashMap<String, usize> = FxHashMap::default();
        for (place, statement) in statements.iter().enumerate() {
            statement.each_name(&mut |name| {
                last.insert(name.to_owned(), place);
            });
        }
        last.extend(later.iter().map(|name| (name.clone(), usize::MAX)));
        let mut used_last = vec![Vec::new(); statements.len()];
        for (name, &place) in &last {
            if let Some(used_last) = used_last.get_mut(place) {
                used_last.push(name.clone());
            }
        }
        let bound: Vec<Vec<String>> = statements.iter().map(bound_names).collect();
        let is_separate = bound.iter().map(|names| names.len() > MOST_NAMES).collect();
        Self { bound, used_last, last, is_separate }
    }

    /// The end of the stretch that begins at `start`.
    fn end(&self, start: usize) -> usize {
        let length =
            self.is_separate[start..].iter().take(STRETCH + LEEWAY).take_while(|is_separate| !**is_separate).count();
        if length < STRETCH + LEEWAY {
            return start + length.max(1);
        }
        let mut alive: FxHashSet<&str> = FxHashSet::default();
        let mut best = (usize::MAX, start + STRETCH);
        for place in start..start + length {
            alive.extend(self.bound[place].iter().filter(|name| self.is_used_after(name, place)).map(String::as_str));
            for name in &self.used_last[place] {
                alive.remove(name.as_str());
            }
            if place + 1 >= start + STRETCH - LEEWAY {
                best = best.min((alive.len(), place + 1));
            }
        }
        best.1
    }

    fn is_used_after(&self, name: &str, place: usize) -> bool {
        self.last.get(name).is_some_and(|&last| last > place)
    }

    /// The names of a stretch that are used after it.
    fn crossing(&self, stretch: std::ops::Range<usize>) -> Vec<String> {
        let end = stretch.end;
        let names = self.bound[stretch].iter().flatten();
        names.filter(|name| self.is_used_after(name, end - 1)).cloned().collect()
    }
}

/// The names that a statement binds.
fn bound_names(statement: &Statement) -> Vec<String> {
    let mut names = Vec::new();
    if let Statement::Let(pattern, _) | Statement::LetElse(pattern, ..) = statement {
        pattern.each_name(&mut |name| names.push(name.to_owned()));
    }
    names
}
