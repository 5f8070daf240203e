//! Analysis of a mechanism: declares all names, evaluates the statements, and checks the whole.

use proc_macro2::Ident;
use quote::ToTokens;
use syn::spanned::Spanned;
use syn::{Attribute, Path};

use super::chain::{Chain, Chains};
use super::kind::{Kind, Measure};
use super::links::Links;
use super::mechanism::{Coordinate, Driver, ExternalFunction, JointRange, Mechanism, Output, Parameter, Point};
use super::name::{Name, TypeName};
use super::resolver::Resolver;
use super::scope::Value;
use super::{check, guess, request, scene};
use crate::budget::Budget;
use crate::diagnostics::{Diagnostics, suggestion};
use crate::graph::SymbolId;
use crate::ids::CoordinateId;
use crate::structure::System;
use crate::syntax::{self, Declared, KEYWORD_AS_NAME, StatementKind, Unit};

/// The largest number of expressions of a mechanism; its derivatives have several times as many.
const LARGEST: usize = 25_000;

/// Resolves one mechanism, and returns it with all its mistakes. With mistakes it still returns what it could resolve,
/// so that a stub with the right names can be emitted.
pub fn resolve(tree: syntax::Mechanism, budget: &Budget) -> (Mechanism, Diagnostics) {
    let syntax::Mechanism { attributes, visibility, name, statements, expressions, diagnostics: mut own } = tree;
    // A keyword as a name is one mistake, wherever the name stands.
    own.keep_first(|message| message.contains(KEYWORD_AS_NAME));
    let diagnostics = &mut own;
    const EVERYWHERE: [&str; 5] = ["cfg", "allow", "warn", "deny", "forbid"];
    let is_everywhere = |attribute: &Attribute| EVERYWHERE.iter().any(|word| attribute.path().is_ident(word));
    let (everywhere, attributes) = attributes.into_iter().partition(is_everywhere);
    let mut resolver = Resolver::new(&expressions, budget, diagnostics);
    let has_scenes = statements.iter().any(|statement| matches!(statement.kind, StatementKind::Scene(_)));
    resolver.scope.has_time = has_scenes;
    expressions.keywords().for_each(|keyword| resolver.scope.excuse(keyword));
    let mut result = Mechanism::named(attributes, everywhere, visibility, TypeName::new(&name));
    resolver.name_others(&name, &statements);
    let mut roles = Roles::default();
    resolver.declare(&statements, &mut result, &mut roles);
    if has_scenes {
        resolver.declare_motion(&mut result);
    }
    let reading = resolver.define(&statements, &mut result);
    resolver.drivers(&statements, &mut result, roles);
    resolver.finish_scenes(reading, &mut result);
    result.requests_at = request::resolve(&statements, !result.parameters.is_empty(), resolver.diagnostics);
    result.requests = result.requests_at.keys().copied().collect();
    resolver.report_fault(result.name.span());
    resolver.report_undeclared(&statements);
    resolver.kinds_of_ranges(&result);
    resolver.kinds_of_numbers(&statements);
    resolver.kinds_of_sums(&result);
    // After the messages about kinds, which are about uses.
    let coordinates = result.coordinates.iter().map(|coordinate| coordinate.symbol);
    resolver.kinds.angles_of_equations(&resolver.graph, &result.rows_of_constraints(1), coordinates);
    if resolver.diagnostics.is_empty() {
        resolver.unused_lets(&statements, &result);
        let chains = resolver.chains(&statements);
        resolver.open_joints(&statements, &chains, &mut result);
        (result.loops, result.zero_sides) = (chains.loops, chains.zeros);
        result.points.iter_mut().zip(chains.points).for_each(|(point, chain)| point.chain = chain);
    } else {
        // For the stub.
        let messages = resolver.diagnostics.len();
        let chains = resolver.chains(&statements);
        resolver.open_joints(&statements, &chains, &mut result);
        resolver.diagnostics.truncate(messages);
    }
    let Resolver { graph, scope, kinds, assumed, externals, extreme, diagnostics, .. } = resolver;
    (result.graph, result.extreme) = (graph, extreme);
    result.externals = externals;
    for parameter in result.parameters.iter_mut().chain(result.scene_parameters.iter_mut()) {
        parameter.kind = kinds.of(parameter.symbol);
        parameter.measure = kinds.measure(parameter.symbol, parameter.unit);
    }
    for coordinate in result.coordinates.iter_mut() {
        coordinate.kind = kinds.of(coordinate.symbol);
    }
    if result.graph.len() > LARGEST {
        diagnostics.error(
            result.name.span(),
            format_args!("`{}` has {} expressions, more than {LARGEST}; split it", result.name, result.graph.len()),
        );
    }
    // After mistakes, these checks would report their consequences.
    if diagnostics.is_empty() {
        check::types(&result, diagnostics);
        check::fields(&result, diagnostics);
        // Where equations are missing nearly all names are unused.
        if diagnostics.is_empty() && !lacks_equations(&result) {
            check::usage(&result, &scope, diagnostics);
        }
        let is_idle = !diagnostics.is_empty();
        check::constraints(&mut result, &scope, diagnostics);
        if diagnostics.is_empty() {
            check::open_chain(&result, diagnostics);
            check::sheet(&result, diagnostics);
        }
        if is_idle {
            guess::without_idle(&mut result, &scope);
        }
    }
    if !diagnostics.is_empty() {
        guess::complete(&mut result, &statements, &scope, &assumed);
    }
    (result, own)
}

/// True if the mechanism has unknowns without any equation, or nothing at all.
pub(super) fn lacks_equations(mechanism: &Mechanism) -> bool {
    mechanism.is_empty() || (mechanism.constraints.is_empty() && !mechanism.is_open())
}

/// The coordinates declared as `input`, `unknown` and `coordinate`.
#[derive(Default)]
struct Roles {
    inputs: Vec<CoordinateId>,
    unknowns: Vec<CoordinateId>,
    open: Vec<CoordinateId>,
}

impl Resolver<'_> {
    /// Opens the joints whose forces scenes need.
    fn open_joints(&mut self, statements: &[syntax::Statement], chains: &Chains, result: &mut Mechanism) {
        if result.scenes.iter().all(|scene| scene.wanted.is_empty()) {
            return;
        }
        let moving = result.coordinates.iter().map(|coordinate| coordinate.symbol).collect();
        let mut links = Links::of(&mut self.graph, moving, chains, &result.bodies);
        let loops = statements.iter().filter_map(|statement| match statement.kind {
            StatementKind::Loop { left, .. } => Some(left),
            _ => None,
        });
        for left in loops.enumerate().filter(|(index, _)| links.floating.contains(index)).map(|(_, left)| left) {
            let message = "the forces in joints need the joint from which this loop is written: begin both sides with it, \
                           as `P + …`";
            self.diagnostics.error(self.expressions.region(left), message);
        }
        let joints = self.joints(&mut links, result);
        result.opened.loads = joints.iter().map(|(_, load)| load.clone()).collect();
        if self.diagnostics.is_empty() {
            self.displace(statements, links, &joints, result);
        }
        if self.diagnostics.is_empty() {
            self.undetermined(result);
        }
    }

    /// Declares all names of the mechanism, so that statements may come in any order.
    fn declare(&mut self, statements: &[syntax::Statement], result: &mut Mechanism, roles: &mut Roles) {
        // Coordinates come first in the canonical order of a sum: phi2 - delta, not -(delta - phi2).
        for statement in statements {
            let (all, role) = match &statement.kind {
                StatementKind::Inputs(all) => (all, &mut roles.inputs),
                StatementKind::Unknowns(all) => (all, &mut roles.unknowns),
                StatementKind::Coordinates(all) => (all, &mut roles.open),
                _ => continue,
            };
            for Declared { name, .. } in all {
                if let Some((name, symbol)) = self.new_symbol(name) {
                    let attributes = statement.attributes.clone();
                    let coordinate = Coordinate::new(name, attributes, symbol);
                    role.push(result.coordinates.push(coordinate));
                }
            }
        }
        for statement in statements {
            match &statement.kind {
                StatementKind::Parameters(parameters) => {
                    for (name, _) in parameters {
                        if let Some((name, symbol)) = self.new_symbol(name) {
                            let attributes = statement.attributes.clone();
                            result.parameters.push(Parameter {
                                name,
                                attributes,
                                symbol,
                                default: None,
                                default_text: None,
                                unit: Unit::None,
                                kind: Kind::Number,
                                measure: Measure::Number,
                            });
                        }
                    }
                }
                StatementKind::Let { name, .. }
                | StatementKind::Point { name, .. }
                | StatementKind::Output { name, .. }
                | StatementKind::Quantity { name, .. } => {
                    self.scope.claim(name, self.diagnostics);
                }
                StatementKind::Unread { names, is_extern, .. } => {
                    self.scope.has_unread_functions |= is_extern;
                    for name in names {
                        self.scope.excuse(name.to_string());
                    }
                }
                StatementKind::External { path, arguments, names } => {
                    self.declare_external(path, arguments, names);
                }
                _ => {}
            }
        }
    }

    fn declare_external(&mut self, path: &Path, arguments: &[Ident], names: &[Ident]) {
        let written = |path: &Path| path.to_token_stream().to_string().replace(' ', "");
        if self.externals.iter().any(|other| written(&other.path) == written(path)) {
            let span = path.segments.last().map_or_else(|| path.span(), |segment| segment.ident.span());
            self.diagnostics.error(span, format_args!("the function `{}` is declared twice", written(path)));
        }
        let arguments: Vec<Name> = arguments.iter().map(Name::new).collect();
        for (index, argument) in arguments.iter().enumerate() {
            if arguments[..index].iter().any(|other| other.field == argument.field) {
                self.diagnostics
                    .error(argument.span, format_args!("the argument `{}` is declared twice", argument.text));
            }
        }
        let id = self.graph.external(names.iter().map(|name| Name::new(name).field).collect());
        for (order, name) in names.iter().enumerate() {
            self.scope.claim_function(name, id, order, self.diagnostics);
        }
        self.externals.push(ExternalFunction {
            path: path.clone(),
            id,
            arguments: arguments.into_iter().map(|argument| argument.field).collect(),
            names: names.iter().map(Name::new).collect(),
            calls: Vec::new(),
        });
    }

    fn new_symbol(&mut self, ident: &Ident) -> Option<(Name, SymbolId)> {
        if !self.scope.claim(ident, self.diagnostics) {
            return None;
        }
        let name = Name::new(ident);
        let symbol = self.graph.symbol(name.field.clone());
        let node = self.graph.variable(symbol);
        self.scope.define_symbol(ident, symbol, node);
        Some((name, symbol))
    }

    fn define(&mut self, statements: &[syntax::Statement], result: &mut Mechanism) -> scene::Reading {
        let mut reading = scene::Reading::default();
        for statement in statements {
            let (attributes, before) = (statement.attributes.clone(), self.scope.uses());
            self.scope.begin_statement();
            match &statement.kind {
                StatementKind::Parameters(parameters) => {
                    for (name, default) in parameters {
                        let Some(default) = default else { continue };
                        let (node, text) = (self.default_of(name, *default), name.to_string());
                        if let Some(parameter) = result.parameters.iter_mut().find(|p| p.name.text == text) {
                            parameter.default = node;
                            parameter.default_text = node.map(|node| self.written(*default, node));
                            parameter.unit = self.unit_of(*default);
                        }
                    }
                }
                StatementKind::Loop { left, right, is_implied } => {
                    let constraints = if *is_implied { &mut result.implied } else { &mut result.constraints };
                    self.close_loop(attributes, *left, *right, constraints);
                }
                StatementKind::Equation { left, right, is_implied } => {
                    let constraints = if *is_implied { &mut result.implied } else { &mut result.constraints };
                    self.close_equation(attributes, *left, *right, constraints);
                }
                StatementKind::Let { name, value } => {
                    let value = self.value(*value);
                    let text = Name::new(name).field;
                    match value {
                        Value::Scalar(node) => result.named.push((node, text)),
                        Value::Vector(x, y) => {
                            result.named.push((x, format!("{text}_x")));
                            result.named.push((y, format!("{text}_y")));
                        }
                        Value::Poison => {}
                    }
                    self.scope.define(name, value);
                }
                StatementKind::Point { name, value } => {
                    let vector = self.vector(*value);
                    let (x, y) = vector.unwrap_or_else(|| (self.graph.zero(), self.graph.zero()));
                    self.scope.define(name, vector.map_or(Value::Poison, |(x, y)| Value::Vector(x, y)));
                    result.points.push(Point { name: Name::new(name), attributes, x, y, chain: Chain::default() });
                }
                StatementKind::Output { name, range, value } => {
                    let ends = range.as_ref().map(|range| self.ends(name, range, &result.coordinates));
                    let scalar = self.scalar(*value);
                    self.scope.define(name, scalar.map_or(Value::Poison, Value::Scalar));
                    if let (Some(range), Some(ends), Some(value)) = (range, ends.flatten(), scalar) {
                        self.ranges.insert(value, ends);
                        result.ranges.push(JointRange::new(name, value, ends, range));
                    }
                    let value = scalar.unwrap_or_else(|| self.graph.zero());
                    result.outputs.push(Output { name: Name::new(name), attributes, value });
                }
                StatementKind::Quantity { name, value } => {
                    let read = self.value(*value);
                    self.scope.define(name, read);
                    let (name, zero) = (Name::new(name), self.graph.zero());
                    match read {
                        Value::Scalar(value) => result.outputs.push(Output { name, attributes, value }),
                        Value::Vector(x, y) => {
                            result.points.push(Point { name, attributes, x, y, chain: Chain::default() });
                        }
                        Value::Poison => {
                            let chain = Chain::default();
                            result.points.push(Point { name, attributes, x: zero, y: zero, chain });
                        }
                    }
                }
                StatementKind::Body(body) => self.body(body, result),
                StatementKind::Scene(tree) => self.scene(tree, &attributes, &mut reading),
                StatementKind::Inputs(all) | StatementKind::Unknowns(all) | StatementKind::Coordinates(all) => {
                    for Declared { name, range } in all {
                        let Some(range) = range else { continue };
                        let ends = self.ends(name, range, &result.coordinates);
                        if let (Some(ends), Some(symbol)) = (ends, self.scope.symbol(name)) {
                            let value = self.graph.variable(symbol);
                            self.ranges.insert(value, ends);
                            result.ranges.push(JointRange::new(name, value, ends, range));
                        }
                    }
                }
                StatementKind::External { .. }
                | StatementKind::Drive { .. }
                | StatementKind::Unread { .. }
                | StatementKind::Derive(_) => {}
            }
            let is_of_scenes =
                matches!(statement.kind, StatementKind::Let { .. } | StatementKind::Body(_) | StatementKind::Scene(_));
            if !is_of_scenes {
                self.kinematic.extend(self.scope.used_since(before));
            }
        }
        reading
    }

    fn drivers(&mut self, statements: &[syntax::Statement], result: &mut Mechanism, roles: Roles) {
        let Roles { inputs, unknowns, open } = roles;
        let mut chosen = false;
        for statement in statements {
            let StatementKind::Drive { name, by } = &statement.kind else { continue };
            chosen = true;
            let mut driven = inputs.clone();
            for coordinate in by {
                let text = coordinate.to_string();
                match open.iter().find(|&&index| result.coordinates[index].name.text == text) {
                    Some(index) if driven.contains(index) => {
                        self.diagnostics.error(coordinate.span(), format_args!("`{text}` already drives `{name}`"));
                    }
                    Some(index) => driven.push(*index),
                    None if self.scope.symbol(coordinate).is_none() && open.is_empty() => {
                        self.scope.miss(coordinate, self.diagnostics);
                    }
                    None => {
                        let names = open.iter().map(|&index| result.coordinates[index].name.text.as_str());
                        let hint = suggestion(&text, names);
                        let message = match self.scope.is_declared(coordinate) {
                            true => {
                                format!("`{text}` is not a `coordinate`{hint}: declare what may drive as `coordinate`")
                            }
                            false => format!("unknown `coordinate` `{text}`{hint}"),
                        };
                        self.diagnostics.error(coordinate.span(), message);
                    }
                }
            }
            if driven.is_empty() && !self.diagnostics.is_empty() {
                driven.extend(guess::driven(&result.drivers, &open));
            }
            if result.drivers.iter().any(|driver| driver.name == *name) || result.name == *name {
                self.diagnostics.error(name.span(), format_args!("the type `{name}` is declared twice"));
                continue;
            }
            let unknowns =
                unknowns.iter().chain(open.iter().filter(|index| !driven.contains(index))).copied().collect();
            result.drivers.push(Driver {
                name: TypeName::new(name),
                attributes: statement.attributes.clone(),
                inputs: driven.into(),
                unknowns,
                system: System::default(),
            });
        }
        if !chosen {
            let is_read = statements.iter().all(|statement| !matches!(statement.kind, StatementKind::Unread { .. }));
            if let Some(&first) = open.first().filter(|_| is_read) {
                let name = &result.coordinates[first].name;
                self.diagnostics
                    .error(name.span, format_args!("no driver is declared: add `drive NAME by {};`", name.text));
            }
            let name = result.name.clone();
            let unknowns = unknowns.into_iter().chain(open).collect();
            let (inputs, system) = (inputs.into(), System::default());
            result.drivers.push(Driver { name, attributes: Vec::new(), inputs, unknowns, system });
        }
    }
}
