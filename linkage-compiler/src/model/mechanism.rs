//! A mechanism as meant, and what can be told of it at once.

use std::collections::{BTreeMap, BTreeSet};

use proc_macro2::{Ident, Span};
use syn::{Attribute, Expr, ExprLit, Lit, Meta, MetaNameValue, Visibility};

use super::kind::Kind;
use super::name::Name;
use super::request::Request;
use super::scene::{Body, Scene};
use crate::diagnostics::Region;
use crate::graph::{ExternalId, Graph, NodeId, SymbolId};
use crate::ids::{
    BlockId, BodyId, ColumnId, CoordinateId, DriverId, InputId, ParameterId, RowId, SceneId, SceneParameterId, Table,
    UnknownId,
};
use crate::structure::Block;

/// A mechanism as meant.
pub struct Mechanism {
    /// Those of its types.
    pub attributes: Vec<Attribute>,
    /// Those of all items that are emitted for it: `cfg`, and levels of lints.
    pub everywhere: Vec<Attribute>,
    pub visibility: Visibility,
    pub name: Ident,
    pub graph: Graph,
    pub parameters: Table<ParameterId, Parameter>,
    pub coordinates: Table<CoordinateId, Coordinate>,
    pub closures: Vec<Closure>,
    pub drivers: Table<DriverId, Driver>,
    pub points: Vec<Point>,
    pub outputs: Vec<Output>,
    pub externals: Vec<ExternalFunction>,
    /// Expressions that the user named with `let`.
    pub named: Vec<(NodeId, String)>,
    /// What is derived beyond what every mechanism has.
    pub requests: BTreeSet<Request>,
    pub bodies: Table<BodyId, Body>,
    pub scenes: Table<SceneId, Scene>,
    /// The parameters that only scenes hold.
    pub scene_parameters: Table<SceneParameterId, Parameter>,
    /// Where there are scenes: t.
    pub time: Option<SymbolId>,
    /// The number in it that is farthest from one.
    pub extreme: Option<Extreme>,
}

/// A number as it was written.
#[derive(Debug, Clone, Copy)]
pub struct Extreme {
    pub region: Region,
    /// How many powers of two it is from one.
    pub powers: f64,
}

/// Geometric or physical data.
pub struct Parameter {
    pub name: Name,
    pub attributes: Vec<Attribute>,
    pub symbol: SymbolId,
    pub default: Option<NodeId>,
    pub kind: Kind,
}

/// A coordinate of q.
pub struct Coordinate {
    pub name: Name,
    pub attributes: Vec<Attribute>,
    pub symbol: SymbolId,
    /// Where there are scenes: the name of its rate.
    pub rate: Option<SymbolId>,
    pub kind: Kind,
}

/// A closure: two rows if a `loop`, one if an `equation`; each row is zero when closed.
pub struct Closure {
    pub span: Span,
    pub attributes: Vec<Attribute>,
    pub rows: Vec<NodeId>,
}

impl Closure {
    /// The user's own description, as a paragraph.
    #[must_use]
    pub fn description(&self) -> Vec<String> {
        let mut lines = Vec::new();
        for attribute in self.attributes.iter().filter(|attribute| attribute.path().is_ident("doc")) {
            if let Meta::NameValue(MetaNameValue { value: Expr::Lit(ExprLit { lit: Lit::Str(text), .. }), .. }) =
                &attribute.meta
            {
                lines.push(text.value().trim().to_owned());
            }
        }
        if !lines.is_empty() {
            lines.insert(0, String::new());
        }
        lines
    }
}

/// A choice of independent coordinates.
pub struct Driver {
    pub name: Ident,
    pub attributes: Vec<Attribute>,
    pub inputs: Table<InputId, CoordinateId>,
    pub unknowns: Table<UnknownId, CoordinateId>,
    /// The order in which the closures are solved, once it is known that they can be.
    pub blocks: Table<BlockId, Block>,
}

/// A named point of the plane.
pub struct Point {
    pub name: Name,
    pub attributes: Vec<Attribute>,
    pub x: NodeId,
    pub y: NodeId,
}

/// A named scalar quantity.
pub struct Output {
    pub name: Name,
    pub attributes: Vec<Attribute>,
    pub value: NodeId,
}

/// A function of the user's.
pub struct ExternalFunction {
    pub path: syn::Path,
    pub attributes: Vec<Attribute>,
    pub id: ExternalId,
    /// What it takes; the derivatives are by the first.
    pub arguments: Vec<String>,
    /// Its value and its derivatives in order.
    pub names: Vec<Name>,
    /// The places where it is called.
    pub calls: Vec<Call>,
}

/// A call of a function of the user's in an expression.
pub struct Call {
    pub region: Region,
    /// The place among the names.
    pub order: usize,
    pub arguments: Vec<NodeId>,
}

impl Mechanism {
    /// True if the mechanism leaves the choice of input to `drive` statements.
    #[must_use]
    pub fn is_driven_by_choice(&self) -> bool {
        !matches!(&*self.drivers, [only] if only.name == self.name)
    }

    /// The scenes that a driver drives.
    pub fn scenes_of<'a>(&'a self, driver: &Driver) -> impl Iterator<Item = &'a Scene> {
        let name = driver.name.to_string();
        self.scenes.iter().filter(move |scene| self.drivers[scene.driver].name == name)
    }

    /// True if its types and those of the emitted code have different names.
    #[must_use]
    pub fn is_well_named(&self) -> bool {
        misnamed(self).next().is_none()
    }

    /// Everything that is said of the mechanism but in its scenes.
    pub fn kinematic_formulas(&self) -> Vec<NodeId> {
        let mut formulas = self.rows().to_vec();
        formulas.extend(self.points.iter().flat_map(|point| [point.x, point.y]));
        formulas.extend(self.outputs.iter().map(|output| output.value));
        formulas
    }

    /// Psi.
    #[must_use]
    pub fn rows(&self) -> Table<RowId, NodeId> {
        self.closures.iter().flat_map(|closure| closure.rows.iter().copied()).collect()
    }

    /// The unknowns of `driver` that each row holds.
    #[must_use]
    pub fn incidence(&self, driver: &Driver) -> Table<RowId, Vec<UnknownId>> {
        let places = driver.unknowns.enumerated().map(|(place, &id)| (self.coordinates[id].symbol, place));
        let places: BTreeMap<SymbolId, UnknownId> = places.collect();
        self.rows().map(|row| {
            let mut unknowns: Vec<UnknownId> =
                self.graph.symbols_of(&[row]).iter().filter_map(|symbol| places.get(symbol).copied()).collect();
            unknowns.sort_unstable();
            unknowns
        })
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

/// Mechanisms, drivers and scenes that are called like the scalar.
pub(super) fn misnamed(mechanism: &Mechanism) -> impl Iterator<Item = &Ident> {
    let drivers = mechanism.drivers.iter().map(|driver| &driver.name);
    let shared = mechanism.is_driven_by_choice().then_some(&mechanism.name);
    let scenes = mechanism.scenes.iter().map(|scene| &scene.name);
    shared.into_iter().chain(drivers).chain(scenes).filter(|&name| name == "T")
}
