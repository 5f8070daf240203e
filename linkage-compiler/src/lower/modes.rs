//! The positions of a group of loops, as calls of the runtime.

use linkage_ir::ValueId;

use super::naming::Hint;
use super::schedule::Line;
use super::value::{Block, Pattern, Signed, Value};
use super::writer::{Absorbed, Writer};
use crate::graph::Number;
use crate::ids::GroupId;
use crate::program::{Constant, Intrinsic, Type};
use crate::structure::Guide;

impl Writer<'_> {
    /// All positions of a group, and the unknowns of the one whose number the branch has.
    pub(super) fn modes(&mut self, of: Absorbed<'_>, line: &Line) {
        let Line::Modes { group, targets, constants, factors, unknowns, guides, system } = line else { return };
        let constants: Vec<ValueId> = constants.iter().map(|part| self.complex(of, part)).collect();
        let constants = self.list(constants);
        let factors: Vec<ValueId> = factors
            .iter()
            .map(|all| {
                let all: Vec<ValueId> = all.iter().map(|part| self.complex(of, part)).collect();
                self.list(all)
            })
            .collect();
        let factors = self.list(factors);
        let loops = self.structure("Loops", [("constants", constants), ("factors", factors)]);
        let mut find = vec![self.kept(of, *group), self.error_name(), self.group(*group), loops];
        let method = if guides.iter().any(Option::is_some) {
            let are: Vec<ValueId> = guides.iter().map(|guide| self.unknown(of, guide)).collect();
            find.push(self.list(are));
            Intrinsic::ModesWithLengths
        } else {
            Intrinsic::Modes
        };
        find.push(self.of_directions(unknowns));
        let take = [self.error_name(), self.group(*group)];
        let branch = self.variable(self.context.branch);
        let mode = self.field(branch, &self.context.derivation.groups[*group].branch(self.context.derivation));
        find.push(self.evaluation(targets, system));
        let all = self.call(method, find);
        let all = self.tried(all);
        let name = self.bound("modes");
        self.let_value(Pattern::Bound(name), all);
        let taken = self.call(Intrinsic::Take, [name].into_iter().chain(take).chain([mode]));
        let taken = self.tried(taken);
        let targets = self.all_introduced(of, targets);
        self.let_value(targets, taken);
    }

    /// The place where the positions of a group are kept: the argument, or a part of it if there are several groups.
    fn kept(&mut self, of: Absorbed<'_>, group: GroupId) -> ValueId {
        let groups = of.schedule.lines.iter().filter_map(|line| match line {
            Line::Modes { group, .. } => Some(*group),
            _ => None,
        });
        let memory = self.variable(self.context.memory);
        match groups.clone().count() {
            1 => memory,
            _ => self.add(Value::Member(memory, groups.take_while(|other| *other != group).count())),
        }
    }

    /// An unknown as a value of the runtime: an angle, or a length along a guide.
    fn unknown(&mut self, of: Absorbed<'_>, guide: &Option<Guide<Signed>>) -> ValueId {
        let Some(Guide { in_loop, along, with }) = guide else { return self.add(Value::Path(Constant::Angle)) };
        let with = match with {
            Some(index) => {
                let index = self.add(Value::Count(*index));
                self.call(Intrinsic::Some, [index])
            }
            None => self.add(Value::Path(Constant::None)),
        };
        let (in_loop, along) = (self.add(Value::Count(*in_loop)), self.complex(of, along));
        self.structure("Unknown::Length", [("in_loop", in_loop), ("along", along), ("with", with)])
    }

    fn complex(&mut self, of: Absorbed<'_>, parts: &[Signed; 2]) -> ValueId {
        let parts = self.all_signed(of, parts);
        self.list(parts)
    }

    /// A struct of the runtime.
    fn structure<const N: usize>(&mut self, of: &'static str, members: [(&str, ValueId); N]) -> ValueId {
        let members = members.map(|(name, value)| (self.field_name(name), value)).to_vec();
        self.add(Value::Struct(Box::new(Type::Runtime(of, Vec::new())), members, None))
    }

    /// The function from the directions to the unknowns, each an integer combination of them.
    fn of_directions(&mut self, unknowns: &[Vec<i64>]) -> ValueId {
        let is_same = |(index, factors): (usize, &Vec<i64>)| {
            factors.iter().enumerate().all(|(other, factor)| *factor == i64::from(other == index))
        };
        let (argument, value) = if unknowns.iter().enumerate().all(is_same) {
            let directions = self.fixed("directions");
            (Pattern::Bound(directions), directions)
        } else {
            let directions: Vec<ValueId> =
                (1..=unknowns.len()).map(|number| self.fixed(&format!("direction_{number}"))).collect();
            let all: Vec<ValueId> = unknowns.iter().map(|factors| self.combination(factors, &directions)).collect();
            (Pattern::List(directions.into_iter().map(Pattern::Bound).collect()), self.list(all))
        };
        let body = Box::new(Block { statements: Vec::new(), value });
        self.add(Value::Closure { arguments: vec![argument], body, moves: false })
    }

    /// A bound value with exactly this name, in a scope of its own.
    pub(super) fn fixed(&mut self, name: &str) -> ValueId {
        let id = self.values.bound();
        self.hint(id, Hint::Fixed(name.to_owned()));
        id
    }

    /// The sum of the directions with these factors.
    fn combination(&mut self, factors: &[i64], directions: &[ValueId]) -> ValueId {
        let terms = factors.iter().zip(directions).filter(|(factor, _)| **factor != 0);
        let mut terms: Vec<Signed> = terms.map(|(factor, direction)| self.multiple(*factor, *direction)).collect();
        terms.sort_by_key(|term| term.negative);
        match terms.as_slice() {
            [only] => self.values.written(*only),
            _ => self.add(Value::Sum(terms)),
        }
    }

    fn multiple(&mut self, factor: i64, direction: ValueId) -> Signed {
        let value = match factor.abs() {
            1 => direction,
            times => {
                let times = self.values.number(Number::integer(times));
                self.add(Value::Product(vec![times, direction]))
            }
        };
        Signed { negative: factor < 0, value }
    }
}
