//! The half chords of groups with two solutions, as calls of the runtime.

use super::lines::Writer;
use super::value::Signed;
use crate::derivation::ChordGeometry;
use crate::graph::SymbolId;
use crate::ids::{BlockId, Id};
use crate::program::{Expression, Failure, Pattern, Statement, Type};

impl Writer<'_, '_> {
    pub(super) fn chord(
        &mut self,
        (block, symbol): (BlockId, SymbolId),
        factors: [Signed; 2],
        size: Signed,
        of: ChordGeometry<Signed>,
    ) {
        let factors = Expression::List(factors.map(|value| self.signed(value)).to_vec());
        let size = self.signed(size);
        let of = of.map(|value| self.signed(value));
        let side = Expression::name(self.branch).field(self.derivation.blocks[block].branch(self.derivation));
        if self.is_flagged() {
            self.flagged_chord(symbol, factors, size, of, side);
            return;
        }
        let name = Pattern::Name(self.names.introduce(symbol));
        let otherwise = match &self.kernel.failure {
            Failure::Return(otherwise) => Some(otherwise.clone()),
            _ => None,
        };
        let (pattern, call) = match of {
            ChordGeometry::Triangle { links, line, distance_squared, scale } => {
                let triangle = triangle(links, line, scale, size, distance_squared, factors);
                match otherwise {
                    Some(_) => (name, Expression::runtime("regular_elbow_chord", [triangle, side])),
                    None => {
                        let pattern = Pattern::Tuple(vec![name, self.well_conditioned(block)]);
                        (pattern, self.group_call("elbow_chord", block, [triangle, side]))
                    }
                }
            }
            ChordGeometry::Circle { scales, may_cancel } => {
                let chord = if may_cancel { "reach_chord" } else { "chord" };
                (name, self.group_call(chord, block, [factors, size, list(scales), side]))
            }
            ChordGeometry::RegularCircle { scale: None } => {
                (name, Expression::runtime("regular_chord", [factors, size, side]))
            }
            ChordGeometry::RegularCircle { scale: Some(scale) } => {
                (name, Expression::runtime("regular_reach_chord", [factors, size, scale, side]))
            }
        };
        match otherwise {
            Some(otherwise) => {
                let found = Pattern::Case("Some", Box::new(pattern));
                self.statements.push(Statement::LetElse(found, call, otherwise));
            }
            None => self.let_pattern(pattern, call.tried()),
        }
    }

    /// A chord without branches, and the flag that is true if it is regular and needs no other units or extra precision.
    fn flagged_chord(
        &mut self,
        symbol: SymbolId,
        factors: Expression,
        size: Expression,
        of: ChordGeometry<Expression>,
        side: Expression,
    ) {
        let call = match of {
            ChordGeometry::Triangle { links, line, distance_squared, scale } => {
                let triangle = triangle(links, line, scale, size, distance_squared, factors);
                Expression::runtime("lane::elbow_chord", [triangle, side])
            }
            ChordGeometry::RegularCircle { scale: None } | ChordGeometry::Circle { may_cancel: false, .. } => {
                Expression::runtime("lane::chord", [factors, side])
            }
            ChordGeometry::RegularCircle { scale: Some(scale) }
            | ChordGeometry::Circle { scales: [scale, _], may_cancel: true } => {
                Expression::runtime("lane::reach_chord", [factors, size, scale, side])
            }
        };
        let name = self.names.introduce(symbol);
        let flag = self.names.taken.unique(&format!("is_regular_{name}"));
        self.let_pattern(Pattern::Tuple(vec![Pattern::Name(name), Pattern::Name(flag.clone())]), call);
        self.flags.push(Expression::Name(flag));
    }

    /// The pattern of the flag that is true if the triangle of a dyad is well conditioned.
    fn well_conditioned(&mut self, block: BlockId) -> Pattern {
        match self.well_conditioned.get_mut(&block) {
            Some(well_conditioned) => {
                let name = self.names.taken.unique(&format!("is_well_conditioned_{}", block.number()));
                Pattern::Name(well_conditioned.insert(name).clone())
            }
            None => Pattern::Ignored,
        }
    }
}

fn list(values: [Expression; 2]) -> Expression {
    Expression::List(values.to_vec())
}

fn triangle(
    links: [Expression; 2],
    line: [Expression; 2],
    scale: Expression,
    reach_squared: Expression,
    distance_squared: Expression,
    factors: Expression,
) -> Expression {
    let members = [
        ("links", list(links)),
        ("line", list(line)),
        ("scale", scale),
        ("reach_squared", reach_squared),
        ("distance_squared", distance_squared),
        ("factors", factors),
    ];
    let members = members.map(|(name, value)| (name.to_owned(), value));
    Expression::structure(Type::Runtime("Triangle", Vec::new()), members)
}
