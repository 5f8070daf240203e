//! Functions for the limits of inputs.

use linkage_ir::{Constant, Intrinsic};

use super::doc::lines;
use super::expression::{Expression, Pattern, Statement, Type};
use super::function::{Body, Source};
use super::names::{Arguments, Order};
use super::plan::{Plan, unnamed};
use crate::ids::{Id, InputId};
use crate::model::Kind;

impl Plan<'_, '_> {
    /// `limits`, or one function for each of several inputs.
    pub(super) fn limits(&mut self) {
        // A second assembly, because the functions that must not be negative are expressed by its symbols.
        self.assembly = self.derivation.assembly();
        for index in self.derivation.inputs.ids() {
            self.limits_of(index);
        }
    }

    fn limits_of(&mut self, index: InputId) {
        let Arguments { inputs, branch, guess, position: position_name, .. } = self.signatures.arguments.clone();
        let coordinate = &self.mechanism.coordinates[self.driver.inputs[index]];
        let (name, kind) = (coordinate.name.clone(), coordinate.kind);
        let (bounds, is_searched) = self.derivation.bounds(&self.assembly, index);
        let one = self.derivation.graph.one();
        let nodes = bounds.iter().flat_map(|bound| bound.coefficients.into_iter().chain([bound.rate.unwrap_or(one)]));
        let nodes = unnamed(nodes);
        // The pattern borrows the inputs, which the position uses assemble.
        let source = Source { from: Expression::name(&inputs), ..self.inputs(Order::Value) };
        let kernel = self.kernel(vec![source], Vec::new(), nodes);

        let bounds = bounds.iter().enumerate().map(|(number, bound)| {
            let group = Expression::text(self.derivation.groups[bound.group].title(self.derivation));
            let group = Expression::Tuple(vec![Expression::Count(bound.group.index()), group]);
            let result = |index: usize| Expression::Result(4 * number + index);
            let mut arguments = vec![group, Expression::List((0..3).map(result).collect())];
            let kind = if bound.rate.is_some() {
                arguments.push(result(3));
                Intrinsic::LimitOfAngle
            } else {
                Intrinsic::LimitOfLength
            };
            Expression::call(kind, arguments)
        });
        let bounds = Expression::List(bounds.collect());
        let position = || Expression::name(&position_name);
        let search = match kind {
            _ if !is_searched => Expression::Constant(Constant::NoSearch),
            Kind::Angle => Expression::Constant(Constant::SearchTurn),
            _ => {
                let scales = Expression::own_call("residual_scales", [position().borrowed()]);
                let scales = Expression::call(Intrinsic::Sum, [scales]);
                let four = Expression::Number(crate::graph::Number::integer(4));
                Expression::call(Intrinsic::SearchLength, [Expression::Product(vec![four, scales])])
            }
        };
        let branch_argument = Expression::name(&branch);
        let inputs_type = Type::Bare(self.signatures.types.inputs.clone());
        // `assemble_near` starts at the previous position, whose turns it keeps.
        let needs_guess = !self.position.is_closed || !self.position.turns.is_empty();
        let assembled = if needs_guess {
            Expression::own_call("assemble_near", [position(), branch_argument.clone()])
        } else {
            let inputs = Expression::of_type(inputs_type.clone(), Intrinsic::From, [position()]);
            Expression::own_call("assemble", [inputs, branch_argument.clone()])
        };
        let assemble = Expression::Closure {
            arguments: vec![Pattern::bound(position_name.clone())],
            statements: Vec::new(),
            value: Box::new(assembled),
            moves: false,
        };
        let coordinates =
            Expression::Function(Intrinsic::Coordinates, Some(Type::Bare(self.signatures.types.pose.clone())));
        let (start, start_position) = if self.position.is_closed {
            let start = Expression::name(&inputs).converted();
            (start, Expression::own_call("assemble", [Expression::name(&inputs), branch_argument]))
        } else {
            let start = Expression::of_type(inputs_type, Intrinsic::From, [Expression::name(&guess)]);
            (start, Expression::own_call("assemble_near", [Expression::name(&guess), branch_argument]))
        };
        let number = Expression::Count(index.index());
        let arguments = [Expression::own(), number, position().borrowed(), bounds, search, assemble, coordinates];
        let mut body = Body::result(Expression::call(Intrinsic::Limits, arguments));
        body.before = vec![
            Statement::Let(Pattern::bound(inputs), start),
            Statement::Let(Pattern::bound(position_name.clone()), start_position.tried()),
        ];
        body.kernel = Some(kernel);
        let others = if self.signatures.inputs.len() == 1 { "" } else { ", with the other inputs fixed" };
        let doc = lines([
            &format!(
                "The interval of `{}` in which the mechanism can be assembled on a branch, about a position{others}.",
                name.text
            ),
            "Limits of groups that depend on the inputs alone, directly or through linear equations, are in closed form; others",
            "are bracketed by search. Inputs inside the interval at which a group is undetermined are ignored.",
            "",
            "# Errors",
            "Those of the position at the given input, `PositionError::NotFinite` if a number is not finite.",
        ]);
        self.add(self.signatures.limits(&self.position, index), doc, body);
    }
}
