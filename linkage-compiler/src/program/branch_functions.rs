//! The function of a branch that lists all branches.

use linkage_ir::Intrinsic;

use super::branch::{Modes, Position, Side};
use super::expression::{Expression, Pattern, Type};
use super::function::{Body, Function};
use super::implementation::{Implementation, Implemented};
use super::signatures::{Signatures, total};

/// `all`, if the branches can be counted.
pub(super) fn of_branch(signatures: &Signatures, position: &Position) -> Option<Implementation<Body>> {
    let doc = match (position.modes.as_slice(), position.turns.as_slice()) {
        ([], []) => "All branches; some may not exist at a given input.",
        ([], _) => "All branches with turns 0; some may not exist at a given input.",
        _ => {
            "All branches with a number for each group without closed form, numbers fastest; some may not exist at a given \
             input."
        }
    };
    let returns = Type::Iterator { item: Box::new(Type::Itself), is_cloned: true };
    let all = Function {
        doc: vec![doc.to_owned()],
        is_method: false,
        body: Some(Body::plain(all(position))),
        ..total("all", [], returns)
    };
    let implementation = Implementation {
        of: Implemented::Itself,
        on: signatures.types.branch.clone(),
        is_generic: false,
        error: "PositionError",
        types: Vec::new(),
        constants: Vec::new(),
        functions: vec![all],
    };
    position.has_counted_branches().then_some(implementation)
}

/// A branch for each combination of sides and numbers, the last one fastest.
fn all(position: &Position) -> Expression {
    let Position { sides, modes, turns, is_closed, .. } = position;
    let counts = sides.iter().map(|_| 2).chain(modes.iter().map(|group| group.most));
    let counts = Expression::List(counts.map(Expression::Count).collect());
    let sides: Vec<&String> = sides.iter().map(|Side { field, .. }| field).collect();
    let numbers: Vec<&String> = modes.iter().map(|Modes { field, .. }| field).collect();
    let of_side = |field: &String| (field.clone(), Expression::call(Intrinsic::SideAt, [Expression::name(field)]));
    let of_number =
        |field: &String| (field.clone(), Expression::call(Intrinsic::NumberOfMode, [Expression::name(field)]));
    let turns = turns.iter().filter(|_| *is_closed).map(|turn| (turn.field.clone(), Expression::Count(0)));
    let members = sides.iter().copied().map(of_side).chain(numbers.iter().copied().map(of_number)).chain(turns);
    // The first side changes faster than the others.
    let order = sides.iter().rev().chain(&numbers);
    let each = Expression::Closure {
        arguments: vec![Pattern::List(order.map(|field| Pattern::bound((*field).clone())).collect())],
        statements: Vec::new(),
        value: Box::new(Expression::structure(Type::Itself, members)),
        moves: false,
    };
    Expression::call(Intrinsic::Combinations, [counts, each])
}
