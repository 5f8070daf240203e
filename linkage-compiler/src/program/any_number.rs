//! The formulas over numbers of any kind: Psi, its derivatives, points and outputs as functions of columns.

use linkage_ir::Intrinsic;

use super::doc::{fenced, lines};
use super::expression::{Expression, Type};
use super::function::{Access, Argument, Body, Function, Kernel, Output, Passed, Shape, Source, results};
use super::names::Order;
use super::plan::{Plan, unnamed};
use super::pose::Given;
use super::signatures::{Family, Signatures, total};
use crate::derivation::{Quantity, Row};
use crate::graph::{Node, NodeId, SymbolId};
use crate::ids::{ColumnId, Id, InputId, RowId, Table, UnknownId};

/// The formulas of a driver over numbers of any kind, and facts about them.
pub struct AnyNumber<B> {
    pub functions: Vec<Function<B>>,
    /// For each group the name of the first user function in its equations.
    pub user_functions: Vec<Option<String>>,
}

impl<B> AnyNumber<B> {
    /// These functions with other bodies.
    pub fn map<C>(self, mut other: impl FnMut(Function<B>) -> Function<C>) -> AnyNumber<C> {
        let Self { functions, user_functions } = self;
        AnyNumber { functions: functions.into_iter().map(&mut other).collect(), user_functions }
    }
}

/// The entries of a matrix that is returned as columns.
type Columns = Vec<Vec<NodeId>>;

impl Plan<'_, '_> {
    pub(super) fn any_number(&mut self) -> AnyNumber<Body> {
        let mut functions = vec![
            self.residual_of_columns(),
            self.jacobian_unknowns_of_columns(),
            self.jacobian_inputs_of_columns(),
            self.gamma_of_columns(),
            self.quantities_of_columns(),
        ];
        functions.extend(self.ranged_of_columns());
        AnyNumber { functions, user_functions: self.user_functions() }
    }

    fn residual_of_columns(&mut self) -> Function<Body> {
        let residual = self.derivation.residual.to_vec();
        let mut doc = lines(["The residual Psi(u, v) of the loop equations and constraints."]);
        doc.extend(self.numbered("Psi", &residual));
        let kernel = self.kernel_of_columns(unnamed(residual), false);
        self.function_of_columns(self.signatures.residual_of_columns(), doc, kernel)
    }

    fn jacobian_unknowns_of_columns(&mut self) -> Function<Body> {
        let (rows, unknowns) = (self.derivation.jacobian_unknowns(), self.derivation.unknowns.ids());
        let columns = self.columns_of::<UnknownId>(&rows, unknowns);
        let doc = lines(["The columns of J = `Psi_u`, with the formulas of the function of this name of a position."]);
        let signature = self.signatures.jacobian_of_columns("jacobian_unknowns", self.signatures.unknowns.len());
        self.matrix_of_columns(signature, doc, columns)
    }

    fn jacobian_inputs_of_columns(&mut self) -> Function<Body> {
        let (rows, inputs) = (self.derivation.jacobian_inputs(), self.derivation.inputs.ids());
        let columns = self.columns_of::<InputId>(&rows, inputs);
        let doc = lines(["The columns of A = `Psi_v`, with the formulas of the function of this name of a position."]);
        let signature = self.signatures.jacobian_of_columns("jacobian_inputs", self.signatures.inputs.len());
        self.matrix_of_columns(signature, doc, columns)
    }

    fn gamma_of_columns(&mut self) -> Function<Body> {
        let gamma = self.derivation.gamma.to_vec();
        let mut doc = lines(["The quadratic velocity term `(Psi_q q')_q q'`."]);
        doc.extend(self.numbered("gamma", &gamma));
        let kernel = self.kernel_of_columns(unnamed(gamma), true);
        self.function_of_columns(self.signatures.gamma_of_columns(), doc, kernel)
    }

    fn quantities_of_columns(&mut self) -> Function<Body> {
        let signatures = &self.signatures;
        let names = [Family::Points, Family::Outputs].into_iter().flat_map(|family| family.components(signatures));
        let quantities = self.derivation.points.iter().chain(&self.derivation.outputs);
        let nodes = quantities.flat_map(|quantity: &Quantity| quantity.value.clone());
        let named: Vec<(NodeId, String)> = nodes.zip(names).collect();
        let mut doc = lines(["The coordinates of the points, x and y of each, then the outputs."]);
        doc.extend(fenced(named.iter().map(|(node, name)| self.law(name, *node))));
        let outputs = named.into_iter().map(|(node, name)| Output::named(node, name)).collect();
        let kernel = self.kernel_of_columns(outputs, false);
        self.function_of_columns(self.signatures.quantities_of_columns(), doc, kernel)
    }

    /// A function that returns the results of a kernel as a column.
    fn function_of_columns(&self, signature: Function<Body>, doc: Vec<String>, kernel: Kernel) -> Function<Body> {
        let value = Expression::sized_vector(results(0..kernel.results.len()));
        Function { doc, body: Some(Body::of(kernel, value)), ..signature }
    }

    /// A function that returns columns of results.
    fn matrix_of_columns(&mut self, signature: Function<Body>, doc: Vec<String>, columns: Columns) -> Function<Body> {
        let rows = columns.first().map_or(0, Vec::len);
        let count = columns.len();
        let kernel = self.kernel_of_columns(unnamed(columns.concat()), false);
        let column = |index: usize| Expression::sized_vector(results(index * rows..(index + 1) * rows));
        let value = Expression::sized_vector((0..count).map(column).collect());
        Function { doc, body: Some(Body::of(kernel, value)), ..signature }
    }

    /// All entries of a matrix, column by column.
    fn columns_of<C: Id + Ord>(&mut self, rows: &Table<RowId, Row<C>>, columns: impl Iterator<Item = C>) -> Columns {
        let zero = self.derivation.graph.zero();
        let entry = |row: &Row<C>, column: C| row.get(&column).copied().unwrap_or(zero);
        columns.map(|column| rows.iter().map(|row| entry(row, column)).collect()).collect()
    }

    /// A kernel with the parameters, the unknowns and the inputs, and their rates if it has them.
    pub(super) fn kernel_of_columns(&mut self, results: Vec<Output>, has_rates: bool) -> Kernel {
        let roots: Vec<NodeId> = results.iter().map(|output| output.node).collect();
        let mut sources = vec![self.parameters()];
        for order in [Order::Value, Order::Rate].into_iter().take(if has_rates { 2 } else { 1 }) {
            let arguments = &self.signatures.arguments;
            let unknowns = if order == Order::Value { &arguments.unknowns } else { &arguments.unknown_rates };
            sources.push(self.column(unknowns, &self.derivation.unknowns, order));
            sources.push(self.column(arguments.of_inputs(order), &self.derivation.inputs, order));
        }
        let (given, of_given) = self.given(&roots);
        sources.extend(of_given);
        Kernel { sources, results, any_number: Some(given), ..Kernel::default() }
    }

    /// The coordinates, or their rates, from an argument that is a column.
    fn column<I>(&self, argument: &str, columns: &Table<I, ColumnId>, order: Order) -> Source {
        let symbols: Vec<SymbolId> =
            columns.iter().map(|&column| order.symbol(&self.derivation.coordinates[column])).collect();
        let list = Type::List(Box::new(Type::Scalar), symbols.len());
        let from = Expression::of_type(list, Intrinsic::From, [Expression::name(argument).dereferenced()]);
        Source { from, shape: Shape::list(&symbols) }
    }

    /// Pi, and the values of user functions, of which nothing is known.
    fn given(&mut self, roots: &[NodeId]) -> (Given, Vec<Source>) {
        let graph = &mut self.derivation.graph;
        let stops = |id: NodeId| matches!(graph.node(id), Node::External(..));
        let reached = graph.sweep(roots, |_| false, stops);
        let (mut given, mut sources) = (Given { is_exact: true, ..Given::default() }, Vec::new());
        for id in reached {
            let (name, function) = match graph.node(id) {
                Node::Pi => ("pi".to_owned(), Intrinsic::Pi),
                Node::External(external, _) => {
                    (graph.external_name(external).unwrap_or("unknown").to_owned(), Intrinsic::Unknown)
                }
                _ => continue,
            };
            let symbol = graph.symbol(name);
            given.values.insert(id, symbol);
            let from = Expression::of_type(Type::Scalar, function, []);
            sources.push(Source { from, shape: Shape::Symbol(symbol) });
        }
        (given, sources)
    }

    /// For each group the name of the first user function in its equations.
    fn user_functions(&self) -> Vec<Option<String>> {
        let (derivation, mechanism) = (&self.derivation, self.mechanism);
        let name = |id: NodeId| match derivation.graph.node(id) {
            Node::External(external, _) => {
                let function = mechanism.externals.iter().find(|function| function.id == external.function)?;
                function.names.first().map(|name| name.text.clone())
            }
            _ => None,
        };
        let of_group = |equations: &[RowId]| {
            let rows: Vec<NodeId> = equations.iter().map(|&row| derivation.residual[row]).collect();
            derivation.graph.reachable(&rows).into_iter().find_map(name)
        };
        derivation.groups.iter().map(|group| of_group(&group.equations)).collect()
    }
}

impl Family {
    /// The names of the components of all points or outputs.
    pub fn components(self, signatures: &Signatures) -> Vec<String> {
        let names = self.names(signatures).into_iter();
        names.flat_map(|name| self.axes().iter().map(move |axis| format!("{name}{axis}"))).collect()
    }
}

impl Signatures {
    /// The functions of the trait `Formulas`, in its order.
    pub fn of_columns(&self) -> Vec<Function<Body>> {
        [
            self.residual_of_columns(),
            self.jacobian_of_columns("jacobian_unknowns", self.unknowns.len()),
            self.jacobian_of_columns("jacobian_inputs", self.inputs.len()),
            self.gamma_of_columns(),
            self.quantities_of_columns(),
        ]
        .into_iter()
        .chain((!self.ranges.is_empty()).then(|| self.ranged_of_columns()))
        .collect()
    }

    /// The number of components of points and outputs.
    pub fn components(&self) -> usize {
        2 * self.points.len() + self.outputs.len()
    }

    fn residual_of_columns(&self) -> Function<Body> {
        self.function_of_columns("residual", Order::Value, column(self.unknowns.len()))
    }

    fn jacobian_of_columns(&self, name: &str, columns: usize) -> Function<Body> {
        let returns = Type::Column(Box::new(column(self.unknowns.len())), columns);
        self.function_of_columns(name, Order::Value, returns)
    }

    fn gamma_of_columns(&self) -> Function<Body> {
        self.function_of_columns("gamma", Order::Rate, column(self.unknowns.len()))
    }

    fn quantities_of_columns(&self) -> Function<Body> {
        self.function_of_columns("quantities", Order::Value, column(self.components()))
    }

    /// A function of the unknowns and the inputs, and of their rates if it has this order.
    pub(super) fn function_of_columns(&self, name: &str, order: Order, returns: Type) -> Function<Body> {
        let (names, u, v) = (&self.arguments, self.unknowns.len(), self.inputs.len());
        let all = [(&names.unknowns, u), (&names.inputs, v), (&names.unknown_rates, u), (&names.input_rates, v)];
        let count = if order == Order::Value { 2 } else { 4 };
        let arguments = all
            .into_iter()
            .take(count)
            .map(|(name, count)| Argument { name: name.clone(), passed: Passed::ByReference(column(count)) });
        Function { access: Access::OfTrait, ..total(name, arguments, returns) }
    }
}

fn column(count: usize) -> Type {
    Type::Column(Box::new(Type::Scalar), count)
}
