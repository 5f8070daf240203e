//! The positions of a group of loops, as calls of the runtime.

use super::lines::Writer;
use super::schedule::Line;
use super::value::Signed;
use crate::graph::Number;
use crate::ids::BlockId;
use crate::program::{Expression, Pattern, Type};
use crate::structure::Guide;

impl<'a> Writer<'a, '_> {
    /// All positions of a group, and the unknowns of the one whose number the branch has.
    pub(super) fn modes(&mut self, line: &'a Line) {
        let Line::Modes { block, targets, constants, factors, unknowns, guides, system } = line else { return };
        let common = || [self.error_name(), self.group(*block)].into_iter();
        let loops = [
            ("constants", constants.iter().map(|part| self.complex(part)).collect()),
            ("factors", factors.iter().map(|all| list(all.iter().map(|part| self.complex(part)))).collect()),
        ];
        let loops = loops.map(|(field, values)| (field.to_owned(), Expression::List(values)));
        let loops = Expression::structure(Type::Runtime("Loops", Vec::new()), loops);
        let are = guides.iter().any(Option::is_some).then(|| list(guides.iter().map(|guide| self.unknown(guide))));
        let method = if are.is_some() { "modes_with_lengths" } else { "modes" };
        let (find, take) = (common().chain([loops]).chain(are).chain([of_directions(unknowns)]), common());
        let mode = Expression::name(self.branch).field(self.derivation.blocks[*block].branch(self.derivation));
        let (find, take): (Vec<_>, Vec<_>) = (find.collect(), take.chain([mode]).collect());
        let evaluation = self.evaluation(targets, system);
        let memory = self.kept(*block);
        let all = memory.method(method, find.into_iter().chain([evaluation])).tried();
        let name = self.names.taken.unique("modes");
        self.let_pattern(Pattern::Name(name.clone()), all);
        let taken = Expression::name(name).method("take", take).tried();
        let targets = targets.iter().map(|&target| Pattern::Name(self.names.introduce(target))).collect();
        self.let_pattern(Pattern::List(targets), taken);
    }

    /// The place where the positions of a group are kept: the argument, or a part of it if there are several groups.
    fn kept(&self, block: BlockId) -> Expression {
        let blocks = self.schedule.lines.iter().filter_map(|line| match line {
            Line::Modes { block, .. } => Some(*block),
            _ => None,
        });
        let memory = Expression::name(self.memory);
        match blocks.clone().count() {
            1 => memory,
            _ => memory.field(blocks.take_while(|other| *other != block).count().to_string()),
        }
    }

    /// An unknown as a value of the runtime: an angle, or a length along a guide.
    fn unknown(&self, guide: &Option<Guide<Signed>>) -> Expression {
        let Some(Guide { in_loop, along, with }) = guide else { return Expression::Constant("Unknown::Angle") };
        let with =
            with.map_or(Expression::Constant("None"), |place| Expression::runtime("Some", [Expression::Count(place)]));
        let fields = [("in_loop", Expression::Count(*in_loop)), ("along", self.complex(along)), ("with", with)];
        let fields = fields.map(|(field, value)| (field.to_owned(), value));
        Expression::structure(Type::Runtime("Unknown::Length", Vec::new()), fields)
    }

    fn complex(&self, parts: &[Signed; 2]) -> Expression {
        Expression::List(self.all_signed(parts))
    }
}

fn list(values: impl Iterator<Item = Expression>) -> Expression {
    Expression::List(values.collect())
}

/// The function from the directions to the unknowns, each an integer combination of them.
fn of_directions(unknowns: &[Vec<i64>]) -> Expression {
    let is_same = |(place, factors): (usize, &Vec<i64>)| {
        factors.iter().enumerate().all(|(other, factor)| *factor == i64::from(other == place))
    };
    let (argument, value) = if unknowns.iter().enumerate().all(is_same) {
        (Pattern::Name("directions".to_owned()), Expression::name("directions"))
    } else {
        let directions = (0..unknowns.len()).map(|place| Pattern::Name(direction(place)));
        (Pattern::List(directions.collect()), list(unknowns.iter().map(|factors| combination(factors))))
    };
    Expression::Closure { arguments: vec![argument], statements: Vec::new(), value: Box::new(value), moves: false }
}

/// The sum of the directions with these factors.
fn combination(factors: &[i64]) -> Expression {
    let terms = factors.iter().enumerate().filter(|(_, factor)| **factor != 0);
    let mut terms: Vec<(bool, Expression)> = terms.map(|(place, factor)| term(place, *factor)).collect();
    terms.sort_by_key(|(is_negative, _)| *is_negative);
    match terms.as_slice() {
        [(false, only)] => only.clone(),
        [(true, only)] => Expression::Negative(Box::new(only.clone())),
        _ => Expression::Sum(terms),
    }
}

/// True if it is subtracted, and the magnitude.
fn term(place: usize, factor: i64) -> (bool, Expression) {
    let name = Expression::name(direction(place));
    let value = match factor.abs() {
        1 => name,
        times => Expression::Product(vec![Expression::Number(Number::integer(times)), name]),
    };
    (factor < 0, value)
}

fn direction(place: usize) -> String {
    format!("direction_{}", place + 1)
}
