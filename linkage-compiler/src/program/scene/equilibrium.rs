//! Where the forces vanish at rest.

use super::ScenePlan;
use crate::derivation::{Form, needed};
use crate::graph::NodeId;
use crate::ids::InputId;
use crate::program::doc::lines;
use crate::program::expression::{Expression, Pattern, Statement, Type};
use crate::program::function::{Body, Output, Value, results};
use crate::program::names::Arguments;

impl ScenePlan<'_, '_, '_> {
    /// The forces at rest with their derivatives, and where they vanish.
    pub(super) fn equilibrium(&mut self) {
        self.balance();
        let Arguments { time, q, guess, .. } = self.signatures.arguments.clone();
        let names = |places: &[InputId]| -> Vec<String> {
            places.iter().map(|&at| self.signatures.inputs[at].clone()).collect()
        };
        let (free, driven) = (names(&self.signatures.free), names(&self.signatures.driven));
        let start = free.iter().map(|input| Expression::name(&guess).field(input)).collect();
        let members = free.iter().chain(&driven).map(|input| (input.clone(), Expression::name(input)));
        let near = Expression::Struct(
            Type::Bare(self.signatures.types.coordinates.clone()),
            members.collect(),
            Some(Box::new(Expression::name(&guess).behind())),
        );
        let found = self.mechanism().method("solve", [near.borrowed()]).tried().field("coordinates");
        let balance = Expression::call("balance", [Expression::name(&time), Expression::name(&q).borrowed()]).tried();
        let both = Expression::Tuple(vec![Expression::name(&q), balance]);
        let closure = Expression::Closure {
            arguments: vec![Pattern::List(free.into_iter().map(Pattern::Name).collect())],
            statements: vec![Statement::Let(Pattern::Name(q), found)],
            value: Box::new(Expression::runtime("Ok", [both])),
            moves: false,
        };
        let search = [Expression::mechanism(), Expression::List(start), closure];
        let mut body = Body::result(Expression::runtime("equilibrium", search));
        if !driven.is_empty() {
            let laws = driven.into_iter().map(|input| Pattern::Struct {
                of: Type::Runtime("Prescribed", Vec::new()),
                fields: vec![("value".to_owned(), Pattern::Name(input))],
                is_whole: false,
            });
            let drives = Expression::call("drives", [Expression::name(&time)]);
            body.before = vec![Statement::Let(Pattern::List(laws.collect()), drives)];
        }
        let doc = lines([
            "The position near the guess where the forces of the free inputs vanish at rest, by Newton's method; it may be",
            "stable or not.",
            "",
            "# Errors",
            "`PositionError::NotConverged` if there is none to be found, `PositionError::OtherBranch` if the guess belongs to no",
            "position of its branch, `PositionError::NotFinite` if a number is not finite.",
        ]);
        self.add(self.signatures.equilibrium(), doc, body);
    }

    fn balance(&mut self) {
        let Some(equilibrium) = self.scene.equilibrium.clone() else { return };
        let free = self.signatures.free.clone();
        let inputs = &self.signatures.inputs;
        let mut outputs: Vec<Output> = Vec::new();
        for &at in &free {
            outputs.push(Output::named(equilibrium.forces[at], format!("{}_force", inputs[at])));
        }
        for &at in &free {
            outputs.push(Output::named(equilibrium.sizes[at], format!("{}_force_size", inputs[at])));
        }
        for &column in &free {
            for &row in &free {
                let name = format!("{}_force_by_{}", inputs[row], inputs[column]);
                outputs.push(Output::named(equilibrium.slopes[row][column], name));
            }
        }
        let nodes: Vec<NodeId> = outputs.iter().map(|output| output.node).collect();
        let steps = self.plan.derivation.solution(&equilibrium.systems, Form::Entries);
        let steps = needed(&self.plan.derivation.graph, steps, &nodes);
        let body =
            self.on_coordinates(Vec::new(), steps, outputs).checked("the forces at rest", results(0..nodes.len()));
        let many = free.len();
        let list = |from: usize| Expression::List(results(from..from + many));
        let slopes = Expression::List(Expression::nested(results(2 * many..nodes.len()), &[many]));
        let members = ["forces", "scales", "slopes"].map(str::to_owned).into_iter().zip([list(0), list(many), slopes]);
        let value = Expression::structure(Type::Runtime("Balance", Vec::new()), members);
        let body = Body { value: Value::Plain(value), ..body };
        let doc = lines([
            "The forces of the free inputs at rest, the sums of the magnitudes of their parts, and their derivatives by these",
            "inputs along the closures, column by column: an equilibrium of one input is stable where its slope is negative.",
            "",
            "# Errors",
            "`PositionError::Singular` where J has no inverse, `PositionError::NotFinite` if a force, its size or a derivative is not finite.",
        ]);
        self.add(self.signatures.balance(), doc, body);
    }
}
