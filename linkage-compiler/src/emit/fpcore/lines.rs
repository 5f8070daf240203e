//! Operations as formulas: steps, checks and results, in the order of the code.

use linkage_ir::document::FormulaId;
use linkage_ir::{ValueId, code};

use super::name::{ascii, reserved, symbol};
use super::operations::{Check, Operations};
use super::value::{Role, Value};
use crate::document::{Equation, KernelCheck, KernelCode, KernelResult, Node, Table};
use crate::graph;
use crate::model::Mechanism;
use crate::program::{Order, Taken};

/// The formulas that numbers of a value have; empty if none has one.
pub(super) fn code(
    mechanism: &Mechanism,
    operations: &Operations,
    checks: &[Check],
    value: &Value,
    table: &mut Table,
) -> KernelCode {
    let mut results = Vec::new();
    value.each_number("", &mut |path, id| results.push((path.to_owned(), id)));
    // An argument or a constant as a result is exact.
    results.retain(|(_, id)| !operations.is_leaf(*id));
    let uses = Uses::of(operations, checks, &results);
    if results.is_empty() {
        return KernelCode::default();
    }
    let (reserved, count) = (reserved(), uses.counts.len());
    let mut names = Names { operations, table, taken: Taken::new(&reserved), nodes: vec![None; count] };
    names.arguments(mechanism, &uses);
    let mut steps = Vec::new();
    for id in operations.ids().filter(|id| uses.is_used(*id)) {
        let formula = names.formula(id);
        names.nodes[id.index()] = Some(if uses.has_line[id.index()] {
            let name = names.unique(operations.preferred(id).unwrap_or("value"));
            steps.push(Equation { left: name, right: formula });
            name
        } else {
            formula
        });
    }
    KernelCode {
        steps,
        checks: checks.iter().filter_map(|Check { kind, of }| KernelCheck::new(*kind, &names.all(of))).collect(),
        results: results
            .into_iter()
            .map(|(path, id)| KernelResult { place: ascii(&path), value: names.node(id) })
            .collect(),
    }
}

/// The operations that results and checks need.
struct Uses {
    counts: Vec<usize>,
    /// True for an operation with a name or with several uses.
    has_line: Vec<bool>,
}

impl Uses {
    fn of(operations: &Operations, checks: &[Check], results: &[(String, ValueId)]) -> Self {
        let count = operations.count();
        let mut uses = Self { counts: vec![0; count], has_line: vec![false; count] };
        let mut of_checks = vec![false; count];
        for check in checks {
            check.of.iter().for_each(|id| uses.counts[id.index()] += 1);
            // The first decides the results that the check is for: it needs a name.
            check.of.iter().take(1).for_each(|id| of_checks[id.index()] = true);
        }
        let mut is_inner = vec![false; count];
        results.iter().for_each(|(_, id)| uses.counts[id.index()] += 1);
        // Operands come before their operations.
        for id in operations.ids().rev() {
            if uses.is_used(id) {
                operations.each_operand(id, |operand| {
                    uses.counts[operand.index()] += 1;
                    is_inner[operand.index()] = true;
                });
            }
        }
        for id in operations.ids() {
            let at = id.index();
            let is_named = operations.preferred(id).is_some() && is_inner[at];
            let is_line = is_named || uses.counts[at] > 1 || of_checks[at];
            uses.has_line[at] = is_line && !operations.is_leaf(id);
        }
        uses
    }

    fn is_used(&self, id: ValueId) -> bool {
        self.counts[id.index()] > 0
    }
}

/// The names and formulas of operations so far.
struct Names<'a> {
    operations: &'a Operations,
    table: &'a mut Table,
    taken: Taken<'a>,
    nodes: Vec<Option<FormulaId>>,
}

impl Names<'_> {
    /// Names all arguments, before the steps. Parameters and coordinates come first, also those that are not used: an
    /// argument has one name in all functions.
    fn arguments(&mut self, mechanism: &Mechanism, uses: &Uses) {
        let parameters = mechanism.parameters.iter().chain(&mechanism.scene_parameters);
        let parameters = parameters.map(|parameter| (Role::Parameters, &parameter.name.field));
        let coordinates = Order::ALL.into_iter().flat_map(|order| {
            mechanism.coordinates.iter().map(move |coordinate| (Role::Motion(order), &coordinate.name.field))
        });
        for (role, field) in parameters.chain(coordinates) {
            let name = self.unique(&role.name(field));
            if let Some(id) = self.operations.known(&role.key(std::slice::from_ref(field))) {
                self.nodes[id.index()] = Some(name);
            }
        }
        let is_new = |id: &ValueId| uses.is_used(*id) && self.nodes[id.index()].is_none();
        let others: Vec<ValueId> = self.operations.ids().filter(is_new).collect();
        for id in others {
            if matches!(self.operations.operation(id), code::Value::Given(_)) {
                let name = self.unique(self.operations.preferred(id).unwrap_or_default());
                self.nodes[id.index()] = Some(name);
            }
        }
    }

    fn unique(&mut self, preferred: &str) -> FormulaId {
        let name = self.taken.unique(&symbol(preferred));
        self.table.plain(&name)
    }

    /// The formula or name of an operation before; operands come before their operations.
    fn node(&mut self, id: ValueId) -> FormulaId {
        self.nodes[id.index()].unwrap_or_else(|| self.table.decimal(f64::NAN))
    }

    fn all(&mut self, ids: &[ValueId]) -> Vec<FormulaId> {
        ids.iter().map(|id| self.node(*id)).collect()
    }

    /// The formula of an operation whose operands have formulas.
    fn formula(&mut self, id: ValueId) -> FormulaId {
        use code::Value as V;
        let node = match self.operations.operation(id) {
            V::Constant(number) => return self.constant(*number),
            V::Turn(_, count, parts) => return self.turn(*count, *parts),
            V::Sum(terms) => Node::Sum(terms.iter().map(|term| (term.negative, self.node(term.value))).collect()),
            V::Product(factors) => Node::Product(self.all(factors)),
            V::Quotient(above, below) => Node::Quotient(self.node(*above), self.node(*below)),
            V::Square(base) => Node::Power(self.node(*base), 2),
            V::Negative(inside) => Node::Sum(vec![(true, self.node(*inside))]),
            V::Call(function, arguments) => {
                Node::Call(*function, arguments.iter().map(|argument| self.node(argument.value)).collect())
            }
            _ => return self.node(id),
        };
        self.table.add(node)
    }

    /// A multiple of pi as emitted code computes it.
    fn turn(&mut self, count: i32, parts: u32) -> FormulaId {
        let mut multiple = self.table.add(Node::Pi);
        if count != 1 {
            let count = self.table.decimal(count.into());
            multiple = self.table.add(Node::Product(vec![multiple, count]));
        }
        if parts != 1 {
            let parts = self.table.decimal(parts.into());
            multiple = self.table.add(Node::Quotient(multiple, parts));
        }
        multiple
    }

    /// The constant as emitted code computes it.
    fn constant(&mut self, number: graph::Number) -> FormulaId {
        let value = number.to_f64();
        match number {
            graph::Number::Ratio(n, d) if format!("{value}").len() > 8 => {
                let (above, below) = (self.integer(n), self.integer(d));
                self.table.add(Node::Quotient(above, below))
            }
            _ => self.table.decimal(value),
        }
    }

    /// An integer, which a double may not hold.
    fn integer(&mut self, value: i64) -> FormulaId {
        let is_exact = value as f64 as i64 == value;
        match u64::try_from(value) {
            Ok(value) => self.table.add(Node::Integer(value)),
            Err(_) if is_exact => self.table.decimal(value as f64),
            Err(_) => {
                let size = self.table.add(Node::Integer(value.unsigned_abs()));
                self.table.add(Node::Sum(vec![(true, size)]))
            }
        }
    }
}
