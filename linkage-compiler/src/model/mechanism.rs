//! A mechanism after semantic analysis.

use std::collections::{BTreeMap, BTreeSet};

use proc_macro2::{Ident, Span};
use syn::{Attribute, Expr, ExprLit, Lit, Meta, MetaNameValue, Visibility};

use super::chain::Chain;
use super::kind::{Kind, Measure};
use super::name::{Name, TypeName};
use super::opened::Opened;
use super::request::Request;
use super::scene::{Body, Scene};
use crate::diagnostics::Region;
use crate::graph::{ExternalId, Graph, NodeId, SymbolId};
use crate::ids::{
    BodyId, ColumnId, CoordinateId, DriverId, Id, InputId, ParameterId, RowId, SceneId, SceneParameterId, Table,
    UnknownId,
};
use crate::structure::{StructurallySingular, System};
use crate::syntax::{ExpressionId, Range, Unit};

/// A mechanism with resolved names.
pub struct Mechanism {
    /// The attributes of its types.
    pub attributes: Vec<Attribute>,
    /// The attributes of all emitted items: `cfg` and lint levels.
    pub everywhere: Vec<Attribute>,
    pub visibility: Visibility,
    pub name: TypeName,
    pub graph: Graph,
    pub parameters: Table<ParameterId, Parameter>,
    pub coordinates: Table<CoordinateId, Coordinate>,
    pub constraints: Vec<Constraint>,
    /// The vectors of both sides of each `loop`.
    pub loops: Vec<[Chain; 2]>,
    /// The sides of loops that are zero.
    pub zero_sides: Vec<[bool; 2]>,
    /// Loops and equations that follow from the constraints.
    pub implied: Vec<Constraint>,
    pub drivers: Table<DriverId, Driver>,
    pub points: Vec<Point>,
    pub outputs: Vec<Output>,
    /// The ranges of coordinates and outputs, in the order of declaration.
    pub ranges: Vec<JointRange>,
    pub externals: Vec<ExternalFunction>,
    /// Expressions that the user named with `let`.
    pub named: Vec<(NodeId, String)>,
    /// The keywords of its `derive` statements.
    pub requests: BTreeSet<Request>,
    /// The places of these keywords.
    pub requests_at: BTreeMap<Request, Span>,
    pub bodies: Table<BodyId, Body>,
    pub scenes: Table<SceneId, Scene>,
    /// The parameters that only scenes use.
    pub scene_parameters: Table<SceneParameterId, Parameter>,
    /// The symbol t, if there are scenes.
    pub time: Option<SymbolId>,
    /// The joints whose forces scenes need.
    pub opened: Opened,
    /// The literal with the most extreme magnitude.
    pub extreme: Option<Extreme>,
}

/// A literal of extreme magnitude, to which range errors of derivatives are attributed.
#[derive(Debug, Clone, Copy)]
pub struct Extreme {
    pub region: Region,
    /// |log2 of its magnitude|.
    pub powers: f64,
}

/// Geometric or physical data.
pub struct Parameter {
    pub name: Name,
    pub attributes: Vec<Attribute>,
    pub symbol: SymbolId,
    pub default: Option<NodeId>,
    /// The default as written, without spaces.
    pub default_text: Option<String>,
    /// The unit that is written in the default.
    pub unit: Unit,
    pub kind: Kind,
    pub measure: Measure,
}

impl Parameter {
    /// The default with its unit, as an argument can be: `60rpm`, `45deg`, `0.5`.
    #[must_use]
    pub fn default_in_words(&self) -> Option<String> {
        let is_plain = |text: &str| text.trim_start_matches('-').parse::<f64>().is_ok();
        let unit = Unit::ALL.into_iter().find(|(_, unit)| *unit == self.unit).map_or("", |(name, _)| name);
        self.default_text.as_ref().map(|text| if is_plain(text) { format!("{text}{unit}") } else { text.clone() })
    }
}

/// A coordinate of q.
pub struct Coordinate {
    pub name: Name,
    pub attributes: Vec<Attribute>,
    pub symbol: SymbolId,
    /// The symbol of its rate, if there are scenes.
    pub rate: Option<SymbolId>,
    pub kind: Kind,
}

impl Coordinate {
    pub(super) fn new(name: Name, attributes: Vec<Attribute>, symbol: SymbolId) -> Self {
        Self { name, attributes, symbol, rate: None, kind: Kind::Number }
    }
}

/// The lines of a doc comment.
fn documentation(attributes: &[Attribute]) -> Vec<String> {
    let line = |attribute: &Attribute| match &attribute.meta {
        Meta::NameValue(MetaNameValue { path, value: Expr::Lit(ExprLit { lit: Lit::Str(text), .. }), .. })
            if path.is_ident("doc") =>
        {
            Some(text.value().trim().to_owned())
        }
        _ => None,
    };
    attributes.iter().filter_map(line).collect()
}

/// A `loop`, with two rows, or an `equation`, with one row; each row is a residual.
pub struct Constraint {
    pub span: Span,
    pub attributes: Vec<Attribute>,
    pub rows: Vec<NodeId>,
}

impl Constraint {
    /// The user's doc comment, as a paragraph.
    #[must_use]
    pub fn description(&self) -> Vec<String> {
        let mut lines = documentation(&self.attributes);
        if !lines.is_empty() {
            lines.insert(0, String::new());
        }
        lines
    }
}

/// A choice of independent coordinates.
pub struct Driver {
    pub name: TypeName,
    pub attributes: Vec<Attribute>,
    pub inputs: Table<InputId, CoordinateId>,
    pub unknowns: Table<UnknownId, CoordinateId>,
    /// Psi and its groups in the order of solution; empty before the check and in mechanisms with mistakes.
    pub system: System,
}

/// A named point of the plane.
pub struct Point {
    pub name: Name,
    pub attributes: Vec<Attribute>,
    pub x: NodeId,
    pub y: NodeId,
    /// The vectors that lead to it.
    pub chain: Chain,
}

/// A named scalar quantity.
pub struct Output {
    pub name: Name,
    pub attributes: Vec<Attribute>,
    pub value: NodeId,
}

/// A coordinate or an output, and the range that it may have.
pub struct JointRange {
    pub name: String,
    pub value: NodeId,
    /// The least and the largest value; at least one is given.
    pub ends: [Option<NodeId>; 2],
    /// The ends as written.
    pub(super) written: [Option<ExpressionId>; 2],
}

impl JointRange {
    pub(super) fn new(name: &Ident, value: NodeId, ends: [Option<NodeId>; 2], range: &Range) -> Self {
        Self { name: name.to_string(), value, ends, written: range.ends }
    }
}

/// A user function.
pub struct ExternalFunction {
    pub path: syn::Path,
    pub id: ExternalId,
    /// The names of its arguments; derivatives are with respect to the first.
    pub arguments: Vec<String>,
    /// The names of its value and its derivatives, in order.
    pub names: Vec<Name>,
    /// Its calls in expressions.
    pub calls: Vec<Call>,
}

/// A call of a user function in an expression.
pub struct Call {
    pub region: Region,
    /// The order of the derivative: the index of its name.
    pub order: usize,
    pub arguments: Vec<NodeId>,
}

impl Mechanism {
    /// The lines of the doc comment.
    #[must_use]
    pub fn documentation(&self) -> Vec<String> {
        documentation(&self.attributes)
    }

    /// A mechanism without content.
    pub(super) fn named(
        attributes: Vec<Attribute>,
        everywhere: Vec<Attribute>,
        visibility: Visibility,
        name: TypeName,
    ) -> Self {
        Self {
            attributes,
            everywhere,
            visibility,
            name,
            graph: Graph::default(),
            parameters: Table::default(),
            coordinates: Table::default(),
            constraints: Vec::new(),
            loops: Vec::new(),
            zero_sides: Vec::new(),
            implied: Vec::new(),
            drivers: Table::default(),
            points: Vec::new(),
            outputs: Vec::new(),
            ranges: Vec::new(),
            externals: Vec::new(),
            named: Vec::new(),
            requests: BTreeSet::new(),
            requests_at: BTreeMap::new(),
            bodies: Table::default(),
            scenes: Table::default(),
            scene_parameters: Table::default(),
            time: None,
            opened: Opened::default(),
            extreme: None,
        }
    }

    /// True if the mechanism leaves the choice of input to `drive` statements.
    #[must_use]
    pub fn is_driven_by_choice(&self) -> bool {
        !matches!(&*self.drivers, [only] if only.name == self.name)
    }

    /// True for an open chain: no loop or equation, and every coordinate is an input.
    #[must_use]
    pub fn is_open(&self) -> bool {
        self.constraints.is_empty() && self.drivers.iter().all(|driver| driver.unknowns.is_empty())
    }

    /// True if there is nothing to compute from the coordinates.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.constraints.is_empty() && self.points.is_empty() && self.outputs.is_empty() && self.scenes.is_empty()
    }

    /// The place of the statement that a function of a driver comes from.
    #[must_use]
    pub fn span_of(&self, driver: &Driver, function: &str) -> Span {
        let requests = [
            ("jerk", Request::Jerk),
            ("limits", Request::Limits),
            ("sensitivit", Request::Sensitivity),
            ("ratio_derivatives", Request::VelocityRatioDerivatives),
            ("joints", Request::Drawing),
            ("guides", Request::Drawing),
            ("force_places", Request::Drawing),
        ];
        let request = requests.iter().filter(|(word, _)| function.contains(word));
        let request = request.filter_map(|(_, request)| self.requests_at.get(request)).next().copied();
        let point = || self.points.first().filter(|_| function.starts_with("point")).map(|point| point.name.span);
        let output = || self.outputs.first().filter(|_| function.starts_with("output")).map(|output| output.name.span);
        request.or_else(point).or_else(output).unwrap_or_else(|| driver.name.span())
    }

    /// The number of forces in joints that a drawing can show.
    #[must_use]
    pub fn drawn_forces(&self) -> usize {
        let are_drawn = self.requests.contains(&Request::Drawing);
        let is_shown = self.scenes.iter().any(|scene| !scene.loads.is_empty());
        if are_drawn && is_shown { self.opened.loads.len() } else { 0 }
    }

    /// Removes a driver, with its scenes.
    pub fn remove_driver(&mut self, id: DriverId) {
        let drivers = std::mem::take(&mut self.drivers).into_iter().enumerate();
        self.drivers = drivers.filter(|(index, _)| *index != id.index()).map(|(_, driver)| driver).collect();
        let scenes = std::mem::take(&mut self.scenes).into_iter().filter(|scene| scene.driver != id);
        self.scenes = scenes
            .map(|mut scene| {
                let index = scene.driver.index();
                scene.driver = DriverId::new(if index > id.index() { index - 1 } else { index });
                scene
            })
            .collect();
    }

    /// The scenes that a driver drives.
    pub fn scenes_of<'a>(&'a self, driver: &Driver) -> impl Iterator<Item = (SceneId, &'a Scene)> {
        let name = driver.name.to_string();
        self.scenes.enumerated().filter(move |(_, scene)| self.drivers[scene.driver].name == *name)
    }

    /// True if no type has the name `T` of the scalar type parameter.
    #[must_use]
    pub fn is_well_named(&self) -> bool {
        misnamed(self).next().is_none()
    }

    /// The formulas of equations with these rows, points and outputs.
    pub fn kinematic_formulas(&self, rows: &[NodeId]) -> Vec<NodeId> {
        let mut formulas = rows.to_vec();
        formulas.extend(self.implied.iter().flat_map(|implied| &implied.rows));
        formulas.extend(self.points.iter().flat_map(|point| [point.x, point.y]));
        formulas.extend(self.outputs.iter().map(|output| output.value));
        formulas
    }

    /// The loop equations and constraints as written.
    #[must_use]
    pub fn rows(&self) -> Table<RowId, NodeId> {
        self.constraints.iter().flat_map(|constraint| constraint.rows.iter().copied()).collect()
    }

    /// The rows of the constraints that have so many.
    pub(super) fn rows_of_constraints(&self, count: usize) -> Vec<NodeId> {
        let constraints = self.constraints.iter().filter(|constraint| constraint.rows.len() == count);
        constraints.flat_map(|constraint| constraint.rows.iter().copied()).collect()
    }

    /// The rows of `equation`s, which are conditions between coordinates.
    pub(super) fn conditions(&self) -> impl Iterator<Item = NodeId> {
        self.rows_of_constraints(1).into_iter()
    }

    /// Psi of a driver in the form in which it is solved, and its groups.
    ///
    /// # Errors
    /// [`StructurallySingular`] if it is singular for all values of the parameters.
    pub fn ordered(&mut self, driver: DriverId) -> Result<System, StructurallySingular> {
        let (rows, unknowns) = (self.rows(), &self.drivers[driver].unknowns);
        let unknowns = unknowns.iter().map(|&id| self.coordinates[id].symbol).collect();
        let loops = self.rows_of_loops();
        System::new(&mut self.graph, rows, &unknowns, &loops)
    }

    /// The two rows of each `loop`.
    fn rows_of_loops(&self) -> Vec<[RowId; 2]> {
        let mut rows = (0..).map(RowId::new);
        let mut next = |constraint: &Constraint| -> Vec<RowId> { rows.by_ref().take(constraint.rows.len()).collect() };
        self.constraints.iter().filter_map(|constraint| next(constraint).try_into().ok()).collect()
    }

    /// The coordinates in the order of q: as declared if the driver is a choice, else u before v.
    #[must_use]
    pub fn coordinate_order(&self, driver: &Driver) -> Table<ColumnId, CoordinateId> {
        if self.is_driven_by_choice() {
            self.coordinates.ids().collect()
        } else {
            driver.unknowns.iter().chain(&driver.inputs).copied().collect()
        }
    }
}

/// Mechanisms, drivers and scenes that are named `T`, as the scalar type parameter.
pub(super) fn misnamed(mechanism: &Mechanism) -> impl Iterator<Item = &TypeName> {
    let drivers = mechanism.drivers.iter().map(|driver| &driver.name);
    let shared = mechanism.is_driven_by_choice().then_some(&mechanism.name);
    let scenes = mechanism.scenes.iter().map(|scene| &scene.name);
    shared.into_iter().chain(drivers).chain(scenes).filter(|&name| name == "T")
}
