//! Points and outputs: value, rate, acceleration, jerk and their own velocity ratios.

use linkage_ir::Intrinsic;

use super::doc::{fenced, lines};
use super::expression::Expression;
use super::function::{Body, Output, results};
use super::names::Order;
use super::plan::{ENDINGS, Plan, unnamed};
use super::signatures::Family;
use crate::derivation::{Quantity, QuantityFormulas};
use crate::graph::{NodeId, SymbolId};

impl Plan<'_, '_> {
    pub(super) fn quantities_of(&self, family: Family) -> &[Quantity] {
        match family {
            Family::Points => &self.derivation.points,
            Family::Outputs => &self.derivation.outputs,
        }
    }

    pub(super) fn formulas_of(&self, family: Family) -> &[QuantityFormulas] {
        match family {
            Family::Points => &self.formulas.points,
            Family::Outputs => &self.formulas.outputs,
        }
    }

    /// `name_ending = formula` of each component, for the doc comment.
    pub(super) fn laws(&self, family: Family, name: &str, ending: &str, nodes: &[NodeId]) -> Vec<String> {
        let components = family.axes().iter().zip(nodes);
        components.map(|(axis, &node)| self.law(format_args!("{name}{axis}_{ending}"), node)).collect()
    }

    pub(super) fn quantities(&mut self, family: Family) {
        if !self.signatures.has(family) {
            return;
        }
        for order in 0..self.signatures.orders() {
            self.derived(family, order);
        }
        self.quantity_ratios(family);
    }

    /// The values, or their derivatives with respect to time.
    fn derived(&mut self, family: Family, order: usize) {
        let word = family.word();
        let meaning = match order {
            0 if family == Family::Points => "The positions of the points.".to_owned(),
            0 => "The values of the outputs.".to_owned(),
            1 if family == Family::Points => "The velocities of the points at the rates `q'`.".to_owned(),
            1 => "The rates of the outputs at the rates `q'`.".to_owned(),
            2 => format!("The accelerations of the {word}s at the rates `q'` and the accelerations `q''`."),
            _ => format!("The jerks of the {word}s at the rates `q'`, the accelerations `q''` and the jerks `q'''`."),
        };
        let mut doc = vec![meaning];
        if order == 0 {
            let axes: &[&str] = if family == Family::Points { &[".x", ".y"] } else { &[""] };
            let names = family.names(&self.signatures);
            let formulas = names.iter().zip(self.quantities_of(family)).flat_map(|(name, quantity)| {
                axes.iter().zip(&quantity.value).map(move |(axis, &node)| (format!("{name}{axis}"), node))
            });
            doc.extend(fenced(formulas.map(|(name, node)| self.law(name, node))));
        }
        doc.extend(lines(["", "# Errors", "`PositionError::NotFinite` if a result is not finite."]));
        let part = |quantity: &Quantity| match order {
            0 => quantity.value.clone(),
            1 => quantity.rate.clone(),
            2 => quantity.acceleration.clone(),
            _ => quantity.jerk.clone(),
        };
        let nodes: Vec<NodeId> = self.quantities_of(family).iter().flat_map(part).collect();
        let count = nodes.len();
        let sources = Order::ALL.into_iter().skip(1).take(order).map(|order| self.coordinates(order)).collect();
        let ending = ENDINGS[order];
        let names = family.names(&self.signatures);
        let names = names.iter().flat_map(|name| family.axes().iter().map(move |axis| format!("{name}{axis}{ending}")));
        let outputs = nodes.into_iter().zip(names).map(|(node, name)| Output::named(node, name)).collect();
        let kernel = self.on_pose(sources, Vec::new(), outputs);
        let (finite, sizes): (_, &[usize]) = match (family, order) {
            (Family::Points, 0) => (Intrinsic::FinitePoints, &[2]),
            (Family::Points, _) => (Intrinsic::FiniteVectors, &[2]),
            (Family::Outputs, _) => (Intrinsic::FiniteOutputs, &[]),
        };
        let values = Expression::List(Expression::nested(results(0..count), sizes));
        let name = Expression::text(family.function(order));
        let value = Expression::call(finite, [Expression::mechanism(), name, values]);
        let body = Body { kernel: Some(kernel), ..Body::result(value) };
        self.add(self.signatures.quantities(family, order), doc, body);
    }

    /// `W_l = l_u W + l_v`.
    fn quantity_ratios(&mut self, family: Family) {
        let v = self.signatures.inputs.len();
        let (word, dimension) = (family.word(), family.dimension());
        let mut laws = Vec::new();
        for (name, formulas) in family.names(&self.signatures).iter().zip(self.formulas_of(family)) {
            for (&input, nodes) in self.derivation.inputs.iter().zip(&formulas.ratios) {
                let by = match v {
                    1 => "ratio".to_owned(),
                    _ => format!("by_{}", self.derivation.coordinates[input].name),
                };
                laws.extend(self.laws(family, name, &by, nodes));
            }
        }
        let mut doc = vec![format!("The velocity ratios `W_l` of the {word}s: `l' = W_l v'`.")];
        doc.extend(fenced(laws.into_iter()));
        doc.extend(lines([
            "",
            "# Errors",
            "`PositionError::Singular` if J is singular, `PositionError::NotFinite` if a result is not finite.",
        ]));
        let mut nodes = Vec::new();
        for quantity in self.quantities_of(family).to_vec() {
            for input in self.derivation.inputs.ids() {
                nodes.extend(quantity.jacobian.iter().map(|row| self.derivation.quantity_ratio(row, input)));
            }
        }
        let count = nodes.len();
        let ratios: Vec<SymbolId> = self.derivation.ratios.iter().flatten().copied().collect();
        // The count includes the operations of `velocity_ratios`, which it calls.
        let called = if self.signatures.is_open { None } else { Some("velocity_ratios") };
        let sources = called.iter().map(|function| self.columns(function, &ratios)).collect();
        let kernel = self.on_pose(sources, Vec::new(), unnamed(nodes));
        let values = Expression::List(Expression::nested(results(0..count), &[v, dimension]));
        let value =
            Expression::call(Intrinsic::FiniteMatrices, [Expression::mechanism(), Expression::text(word), values]);
        let body = Body { kernel: Some(kernel), ..Body::result(value) };
        self.add(self.signatures.quantity_ratios(family), doc, body);
    }
}
