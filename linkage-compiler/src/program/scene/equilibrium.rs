//! `equilibrium` and `balance`: static equilibrium.

use linkage_ir::Intrinsic;

use super::ScenePlan;
use crate::derivation::{Form, needed};
use crate::graph::NodeId;
use crate::ids::InputId;
use crate::program::doc::lines;
use crate::program::expression::{Expression, Pattern, Statement, Type};
use crate::program::function::{Body, Output, Value, results};
use crate::program::names::Arguments;

impl ScenePlan<'_, '_, '_> {
    /// Plans `balance` and `equilibrium`.
    pub(super) fn equilibrium(&mut self) {
        self.balance();
        let Arguments { time, q, guess, .. } = self.signatures.arguments.clone();
        let names = |indices: &[InputId]| -> Vec<String> {
            indices.iter().map(|&at| self.signatures.inputs[at].clone()).collect()
        };
        let (free, driven) = (names(&self.signatures.free), names(&self.signatures.driven));
        let start = free.iter().map(|input| Expression::name(&guess).field(input)).collect();
        let is_open = self.plan.signatures.is_open;
        // In an open chain these are all coordinates, in the order of the fields.
        let given = if is_open { self.plan.fields() } else { [free.as_slice(), &driven].concat() };
        let members = given.into_iter().map(|input| (input.clone(), Expression::name(input)));
        let others = (!is_open).then(|| Box::new(Expression::name(&guess).dereferenced()));
        let coordinates = Type::Bare(self.signatures.types.coordinates.clone());
        let near = Expression::Struct(coordinates, members.collect(), others);
        let found = match is_open {
            true => near,
            false => self.mechanism().driver_call("solve", [near.borrowed()]).tried().field("coordinates"),
        };
        let balance =
            Expression::own_call("balance", [Expression::name(&time), Expression::name(&q).borrowed()]).tried();
        let both = Expression::Tuple(vec![Expression::name(&q), balance]);
        let function = Expression::Closure {
            arguments: vec![Pattern::List(free.into_iter().map(Pattern::bound).collect())],
            statements: vec![Statement::Let(Pattern::bound(q), found)],
            value: Box::new(Expression::call(Intrinsic::Ok, [both])),
            moves: false,
        };
        let search = [Expression::mechanism(), Expression::List(start), function];
        let mut body = Body::result(Expression::call(Intrinsic::Equilibrium, search));
        if !driven.is_empty() {
            let given_by_drives = driven.iter().map(Expression::name).collect();
            let laws = driven.into_iter().map(|input| {
                let fields = vec![("value".to_owned(), Pattern::bound(input.clone()))];
                let of = Type::Runtime("Prescribed", Vec::new());
                (input, Pattern::Struct { of, fields, is_whole: false })
            });
            let of = Type::Bare(self.signatures.drives_type.clone());
            let laws = Pattern::Struct { of, fields: laws.collect(), is_whole: true };
            let drives = Expression::own_call("drives", [Expression::name(&time)]);
            body.before = vec![Statement::Let(laws, drives)];
            // No solution for unknowns finds that a given coordinate is not finite.
            let what = "the law of a drive".to_owned();
            body.before.extend(is_open.then_some(Statement::Check { what, values: given_by_drives, detail: None }));
        }
        let mut doc = lines([
            "The position of static equilibrium near the guess, stable or unstable, by Newton's method: the forces of the free",
            "inputs at rest are zero.",
            "",
            "# Errors",
        ]);
        doc.extend(match is_open {
            true => lines([
                "`PositionError::NotConverged` if none is found, `PositionError::NotFinite` if a number is not finite.",
            ]),
            false => lines([
                "`PositionError::NotConverged` if none is found, `PositionError::OtherBranch` if a position near the guess is on another",
                "branch, `PositionError::NotFinite` if a number is not finite.",
            ]),
        });
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
            "The forces Q of the free inputs at rest, the sums of the magnitudes of their parts, and dQ/dv for these inputs along the",
            "motion of the mechanism, column by column. An equilibrium with one free input is stable if dQ/dv is negative.",
            "",
            "# Errors",
            "`PositionError::Singular` if J is singular, `PositionError::NotFinite` if a number is not finite.",
        ]);
        self.add(self.signatures.balance(), doc, body);
    }
}
