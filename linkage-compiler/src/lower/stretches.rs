//! Long sequences of statements in stretches: blocks that keep to themselves what nothing after them uses.
//!
//! Every `let` opens a scope within that of the `let` before it, and the compiler that writes the debug information of
//! these scopes goes down into them by recursion: more than 3000 of them overflow its stack. A block closes its scopes, so
//! that their depth is that of one stretch and the number of stretches.

use std::collections::BTreeSet;

use rustc_hash::{FxHashMap, FxHashSet};

use crate::program::{Expression, Pattern, Statement};

/// The most statements that stay as they are. The longest function of the mechanisms under test has 150 (the
/// sensitivities of Jansen's leg); one of 3050 statements compiles, one of 3240 does not. With half as many, functions
/// would be divided that need not be, and division writes names twice; with twice as many, one such function inlined
/// into another would overflow.
const MOST_STATEMENTS: usize = 1024;

/// The statements of a stretch, but for the choice of its end. With half as many there are twice as many blocks, which
/// give more values in all; with twice as many the scopes are twice as deep.
const STRETCH: usize = 256;

/// The end of a stretch is where the fewest values cross it, so far before and after the regular place.
const LEEWAY: usize = STRETCH / 4;

/// The most names that a statement of a stretch gives. One that gives more stands between stretches: nearly all of its
/// names would leave its stretch again.
const MOST_NAMES: usize = 16;

/// Statements divided into stretches, if they are many; `later` are the names that are used after them.
pub(super) fn divided<'e>(mut statements: Vec<Statement>, later: impl IntoIterator<Item = &'e str>) -> Vec<Statement> {
    if statements.len() <= MOST_STATEMENTS {
        return statements;
    }
    let later: FxHashSet<String> = later.into_iter().map(str::to_owned).collect();
    statements = read_late(statements);
    while statements.len() > MOST_STATEMENTS {
        let before = statements.len();
        statements = once(statements, &later);
        // What stands between stretches is not divided.
        if statements.len() == before {
            break;
        }
    }
    statements
}

/// Fields get their names where these are used first, so that they need not cross many stretches.
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

/// True if a value is a field, or several.
fn is_read(value: &Expression) -> bool {
    match value {
        Expression::Field(of, _) => matches!(**of, Expression::Name(_)) || is_read(of),
        Expression::Tuple(values) => !values.is_empty() && values.iter().all(is_read),
        _ => false,
    }
}

/// Statements as stretches, and what stands between these.
fn once(statements: Vec<Statement>, later: &FxHashSet<String>) -> Vec<Statement> {
    let lives = Lives::of(&statements, later);
    let mut divided = Vec::new();
    let mut statements = statements.into_iter();
    let mut place = 0;
    while place < lives.given.len() {
        let end = lives.end(place);
        let inside = statements.by_ref().take(end - place);
        // A few statements before or after one that stands apart need no block.
        if end - place < STRETCH - LEEWAY {
            divided.extend(inside);
        } else {
            divided.push(stretch(inside.collect(), lives.crossing(place..end)));
        }
        place = end;
    }
    divided
}

/// A block that gives these names.
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

/// The names that statements give, and how long they are used.
struct Lives {
    /// For each statement the names that it gives.
    given: Vec<Vec<String>>,
    /// For each statement the names that no statement after it uses.
    ended: Vec<Vec<String>>,
    /// The last statement that uses a name; none that is used after all of them.
    last: FxHashMap<String, usize>,
    /// What stands between stretches.
    is_apart: Vec<bool>,
}

impl Lives {
    fn of(statements: &[Statement], later: &FxHashSet<String>) -> Self {
        let mut last: FxHashMap<String, usize> = FxHashMap::default();
        for (place, statement) in statements.iter().enumerate() {
            statement.each_name(&mut |name| {
                last.insert(name.to_owned(), place);
            });
        }
        last.extend(later.iter().map(|name| (name.clone(), usize::MAX)));
        let mut ended = vec![Vec::new(); statements.len()];
        for (name, &place) in &last {
            if let Some(ended) = ended.get_mut(place) {
                ended.push(name.clone());
            }
        }
        let given: Vec<Vec<String>> = statements.iter().map(given).collect();
        let is_apart = given.iter().map(|names| names.len() > MOST_NAMES).collect();
        Self { given, ended, last, is_apart }
    }

    /// The end of the stretch that begins here.
    fn end(&self, start: usize) -> usize {
        let length = self.is_apart[start..].iter().take(STRETCH + LEEWAY).take_while(|is_apart| !**is_apart).count();
        if length < STRETCH + LEEWAY {
            return start + length.max(1);
        }
        let mut alive: FxHashSet<&str> = FxHashSet::default();
        let mut best = (usize::MAX, start + STRETCH);
        for place in start..start + length {
            alive.extend(self.given[place].iter().filter(|name| self.is_used_after(name, place)).map(String::as_str));
            for name in &self.ended[place] {
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

    /// The names that a stretch gives.
    fn crossing(&self, stretch: std::ops::Range<usize>) -> Vec<String> {
        let end = stretch.end;
        let names = self.given[stretch].iter().flatten();
        names.filter(|name| self.is_used_after(name, end - 1)).cloned().collect()
    }
}

/// The names that a statement gives to those after it.
fn given(statement: &Statement) -> Vec<String> {
    let mut names = Vec::new();
    if let Statement::Let(pattern, _) = statement {
        pattern.each_name(&mut |name| names.push(name.to_owned()));
    }
    names
}
