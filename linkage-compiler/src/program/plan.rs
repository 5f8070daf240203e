//! The plan of a driver: its pose and its functions, and helpers that build their kernels.

use std::cell::RefCell;

use super::branch::Position;
use super::doc::without_singular;
use super::expression::{Expression, Type};
use super::function::{Body, Function, Kernel, Output, Shape, Source, results};
use super::names::Order;
use super::pose::PosePlan;
use super::signatures::{Family, Signatures};
use crate::derivation::{Assembly, Derivation, Form, Formulas, Step};
use crate::graph::{NodeId, SymbolId, Texts};
use crate::ids::{ColumnId, Id, InputId, Table};
use crate::model::{Driver, Mechanism, Request};

/// The endings of the names of quantities and of their derivatives with respect to time.
pub const ENDINGS: [&str; 4] = ["", "_rate", "_acceleration", "_jerk"];

/// A driver whose functions are planned one by one.
pub struct Plan<'d, 'a> {
    pub mechanism: &'a Mechanism,
    pub driver: &'a Driver,
    pub signatures: Signatures,
    pub derivation: &'d mut Derivation,
    pub formulas: Formulas,
    pub pose: PosePlan,
    pub assembly: Assembly,
    pub position: Position,
    /// Named expressions: `let`s of the user, points, outputs and their rates.
    pub named: Vec<(NodeId, String)>,
    pub functions: Vec<Function<Body>>,
    /// A cache of printed formulas.
    texts: RefCell<Texts>,
}

impl<'d, 'a> Plan<'d, 'a> {
    /// Plans the functions of a driver.
    pub fn of(mechanism: &'a Mechanism, driver: &'a Driver, derivation: &'d mut Derivation) -> Self {
        let mut plan = Plan::new(mechanism, driver, derivation);
        let wants = |request| mechanism.requests.contains(&request);
        plan.position();
        plan.ranges();
        if wants(Request::Limits) {
            plan.limits();
        }
        match plan.signatures.is_open {
            true => plan.length_scale(),
            false => plan.equations(),
        }
        plan.velocity();
        plan.acceleration();
        if wants(Request::Jerk) {
            plan.jerk();
        }
        plan.quantities(Family::Points);
        plan.quantities(Family::Outputs);
        plan.motion();
        plan.kinematics();
        if wants(Request::Lanes) {
            plan.lanes();
        }
        if wants(Request::Drawing) {
            plan.joints();
            plan.guides();
            plan.force_places();
        }
        if wants(Request::VelocityRatioDerivatives) {
            plan.ratio_derivatives();
        }
        if wants(Request::Sensitivity) {
            plan.sensitivity();
        }
        if !plan.derivation.scenes.is_empty() {
            plan.layers();
        }
        plan
    }
}

impl<'d, 'a> Plan<'d, 'a> {
    fn new(mechanism: &'a Mechanism, driver: &'a Driver, derivation: &'d mut Derivation) -> Self {
        let pose = PosePlan::new(derivation);
        let formulas = Formulas::new(derivation);
        let mut plan = Self {
            mechanism,
            driver,
            signatures: Signatures::new(mechanism, driver),
            named: mechanism.named.clone(),
            derivation,
            formulas,
            pose,
            assembly: Assembly::default(),
            position: Position::default(),
            functions: Vec::new(),
            texts: RefCell::default(),
        };
        plan.name_quantities();
        plan
    }

    /// Names subexpressions that equal a point, an output or a derivative of one.
    fn name_quantities(&mut self) {
        for family in [Family::Points, Family::Outputs] {
            let names = family.names(&self.signatures);
            for (quantity, name) in self.quantities_of(family).to_vec().iter().zip(names) {
                let orders = [&quantity.value, &quantity.rate, &quantity.acceleration, &quantity.jerk];
                // Accelerations of outputs seldom occur in other formulas.
                let orders = orders.into_iter().zip(ENDINGS).take(if family == Family::Points { 4 } else { 2 });
                for (nodes, ending) in orders {
                    let axes = family.axes().iter().zip(nodes);
                    self.named.extend(axes.map(|(axis, &node)| (node, format!("{name}{axis}{ending}"))));
                }
            }
        }
    }

    /// Adds a function with its doc comment and its body.
    pub(super) fn add(&mut self, signature: Function<Body>, doc: Vec<String>, body: Body) {
        let doc = if self.signatures.is_open { without_singular(doc) } else { doc };
        let body = self.refined(&signature, body);
        self.functions.push(Function { doc, body: Some(body), ..signature });
    }

    // Formulas.

    pub(super) fn text(&self, node: NodeId) -> String {
        self.texts.borrow_mut().of(&self.derivation.graph, node).to_owned()
    }

    /// `name = formula`
    pub(super) fn law(&self, name: impl std::fmt::Display, node: NodeId) -> String {
        format!("{name} = {}", self.text(node))
    }

    pub(super) fn rates<I>(&self, of: &Table<I, ColumnId>) -> Table<I, SymbolId> {
        of.iter().map(|&index| self.derivation.coordinates[index].rate).collect()
    }

    pub(super) fn accelerations<I>(&self, of: &Table<I, ColumnId>) -> Table<I, SymbolId> {
        of.iter().map(|&index| self.derivation.coordinates[index].acceleration).collect()
    }

    pub(super) fn variables(&mut self, symbols: &[SymbolId]) -> Vec<NodeId> {
        symbols.iter().map(|&symbol| self.derivation.graph.variable(symbol)).collect()
    }

    /// Symbols as results, with their names as preferred names.
    pub(super) fn outputs(&mut self, symbols: &[SymbolId]) -> Vec<Output> {
        let nodes = self.variables(symbols);
        let name = |symbol: &SymbolId| self.derivation.graph.symbol_name(*symbol);
        nodes.into_iter().zip(symbols).map(|(node, symbol)| Output::named(node, name(symbol))).collect()
    }

    /// The steps that compute W.
    pub(super) fn ratio_steps(&mut self, form: Form) -> Vec<Step> {
        let systems = self.derivation.ratio_systems();
        self.derivation.solution(&systems, form)
    }

    /// Adds the computation of determinants before their checks, for kernels without a pose.
    pub(super) fn with_determinants(&self, steps: Vec<Step>) -> Vec<Step> {
        let with = |step: Step| {
            let group = if let Step::Guard { group, .. } = step { Some(group) } else { None };
            let determinant = group.and_then(|group| self.derivation.groups[group].determinant);
            let named = determinant.map(|d| Step::Let { symbol: d.symbol, node: d.value });
            named.into_iter().chain([step])
        };
        steps.into_iter().flat_map(with).collect()
    }

    /// The coordinates whose rates must be checked where the input rates are arguments: the unknowns, and the inputs
    /// that no loop equation contains. A rate of another input that is not finite makes the rate of an unknown not
    /// finite.
    pub(super) fn to_check(&self) -> Vec<ColumnId> {
        let (derivation, rows) = (&self.derivation, self.derivation.jacobian_inputs());
        let is_idle = |place: InputId| {
            let mut entries = rows.iter().filter_map(|row| row.get(&place));
            entries.all(|&entry| derivation.graph.is_zero(entry))
        };
        let idle = derivation.inputs.enumerated().filter(|(place, _)| is_idle(*place));
        derivation.unknowns.iter().chain(idle.map(|(_, index)| index)).copied().collect()
    }

    /// The results to check, where the results from `from` on are derivatives of the coordinates in order.
    pub(super) fn checked(&self, from: usize) -> Vec<Expression> {
        self.to_check().into_iter().map(|column| Expression::Result(from + column.index())).collect()
    }

    // Sources of symbols.

    pub(super) fn parameters(&self) -> Source {
        let fields = self.mechanism.parameters.iter();
        let fields = fields.map(|parameter| (parameter.name.field.clone(), parameter.symbol));
        Source { from: Expression::own().dereferenced(), shape: Shape::fields(Type::Itself, fields, true) }
    }

    pub(super) fn pose_source(&self) -> Source {
        let values = self.pose.values.iter().map(|(_, field, symbol)| (field.clone(), *symbol));
        let determinants = self.pose.determinants.iter().map(|(_, field, symbol)| (field.clone(), *symbol));
        let externals = self.pose.externals.iter().map(|(_, field, symbol)| (field.clone(), *symbol));
        let fields = values.chain(determinants).chain(externals);
        let argument = self.signatures.arguments.pose.clone();
        Source {
            from: Expression::name(&argument).dereferenced(),
            shape: Shape::fields(self.signatures.pose_type(), fields, self.pose.directions.is_empty()),
        }
    }

    /// The determinants and the values of user functions of a pose.
    pub(super) fn computed(&self) -> Source {
        let determinants = self.pose.determinants.iter().map(|(_, field, symbol)| (field.clone(), *symbol));
        let externals = self.pose.externals.iter().map(|(_, field, symbol)| (field.clone(), *symbol));
        let fields = determinants.chain(externals);
        let (of, pose) = (Type::Bare(self.signatures.types.pose.clone()), &self.signatures.arguments.pose);
        let shape = Shape::fields(of, fields, false);
        Source { from: Expression::name(pose), shape }
    }

    /// All coordinates, or their derivatives with respect to time, from an argument that is a reference.
    pub(super) fn coordinates(&self, order: Order) -> Source {
        let fields = self.derivation.coordinates.iter().map(|c| (c.name.clone(), order.symbol(c)));
        Source {
            from: Expression::name(self.signatures.arguments.of(order)).dereferenced(),
            shape: Shape::fields(self.signatures.coordinates_type(order), fields, true),
        }
    }

    /// The inputs, or their derivatives with respect to time, from an argument of type `impl Into`.
    pub(super) fn inputs(&self, order: Order) -> Source {
        let coordinates = self.derivation.inputs.iter().map(|&index| &self.derivation.coordinates[index]);
        let fields = coordinates.map(|c| (c.name.clone(), order.symbol(c)));
        Source {
            from: Expression::name(self.signatures.arguments.of_inputs(order)).converted(),
            shape: Shape::fields(Type::Own(self.signatures.types.inputs.clone()), fields, true),
        }
    }

    /// The columns of a matrix that another function returns for the pose.
    pub(super) fn columns(&self, function: &str, symbols: &[SymbolId]) -> Source {
        let pose = &self.signatures.arguments.pose;
        Source {
            from: Expression::own_call(function, [Expression::name(pose)]).tried().columns(),
            shape: Shape::columns(self.signatures.unknowns.len(), symbols),
        }
    }

    // Kernels.

    /// A kernel with the parameters and other sources.
    pub(super) fn kernel(&self, sources: Vec<Source>, steps: Vec<Step>, results: Vec<Output>) -> Kernel {
        let sources = std::iter::once(self.parameters()).chain(sources).collect();
        Kernel { sources, steps, results, ..Kernel::default() }
    }

    /// A kernel with the parameters, a pose and other sources.
    pub(super) fn on_pose(&self, sources: Vec<Source>, steps: Vec<Step>, results: Vec<Output>) -> Kernel {
        let sources = std::iter::once(self.pose_source()).chain(sources).collect();
        Kernel { is_on_pose: true, ..self.kernel(sources, steps, results) }
    }

    // Values.

    /// The field names of the coordinates, in order.
    pub(super) fn fields(&self) -> Vec<String> {
        self.derivation.coordinates.iter().map(|coordinate| coordinate.name.clone()).collect()
    }

    /// The coordinates, or their derivatives, from consecutive results.
    pub(super) fn coordinates_of(&self, order: Order, from: usize) -> Expression {
        let fields = self.fields();
        let values = results(from..from + fields.len());
        Expression::structure(self.signatures.coordinates_type(order), fields.into_iter().zip(values))
    }
}

/// The formulas as results without names.
pub(super) fn unnamed(nodes: impl IntoIterator<Item = NodeId>) -> Vec<Output> {
    nodes.into_iter().map(Output::from).collect()
}
