//! Bodies and scenes: every effect as a potential, or as a law that acts along a scalar.

use std::collections::{BTreeMap, BTreeSet};

use proc_macro2::{Ident, Span};
use syn::Attribute;

use super::expression::Lowering;
use super::name::Name;
use super::scope::Value;
use super::{Driver, Mechanism};
use crate::diagnostics::suggestion;
use crate::graph::{Function, NodeId, Number, SymbolId};
use crate::syntax::{self, EffectKind, ExpressionId, Place};

/// A rigid body.
pub struct Body {
    pub name: Name,
    /// m and its centre.
    pub mass: Option<(NodeId, [NodeId; 2])>,
    /// The moment of inertia about the centre, and the angle that the body turns by.
    pub inertia: Option<(NodeId, NodeId)>,
}

/// A mechanism with the effects that somebody called for.
pub struct Scene {
    pub name: Ident,
    pub attributes: Vec<Attribute>,
    /// The place of its driver among those of the mechanism.
    pub driver: usize,
    /// The bodies whose inertia counts; nothing accelerates in a scene without.
    pub inertia: Option<Vec<usize>>,
    /// A body and the field that its mass is in.
    pub weights: Vec<(usize, [NodeId; 2])>,
    pub laws: Vec<Law>,
    pub contacts: Vec<Contact>,
    pub drives: Vec<Drive>,
    pub wishes: BTreeSet<Wish>,
    /// Places among [`Mechanism::scene_parameters`].
    pub parameters: Vec<usize>,
}

/// A force along a scalar: its work is `law` times the change of `along`.
pub struct Law {
    /// What errors call it.
    pub label: String,
    /// In terms of parameters, coordinates, rates and time.
    pub law: NodeId,
    pub along: NodeId,
    pub account: Account,
}

/// A dry friction or a stop.
pub struct Contact {
    /// What errors call it.
    pub label: String,
    pub along: NodeId,
    pub law: ContactLaw,
}

/// What a contact does.
pub enum ContactLaw {
    /// The greatest force is the product of these, in terms of parameters, coordinates, rates and time.
    Friction(Vec<NodeId>),
    /// In terms of parameters.
    Stop { range: [NodeId; 2], restitution: NodeId },
}

/// Where the work of a law goes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Account {
    /// From a potential energy.
    Stored(NodeId),
    /// Out of the mechanism.
    Dissipated,
    /// Into the mechanism.
    Applied,
}

/// The motion of an input is given.
pub struct Drive {
    /// An index into [`Mechanism::coordinates`].
    pub input: usize,
    /// In terms of parameters and time.
    pub law: NodeId,
}

/// Functions that a scene has only if they are asked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Wish {
    Energy,
    Power,
    Reactions,
    Equilibrium,
}

/// What the scenes of a mechanism share while they are read.
#[derive(Default)]
pub(super) struct Reading {
    scenes: Vec<(Scene, Option<Ident>, Names)>,
}

/// What a scene names before all bodies and drivers are known.
struct Names {
    inertia: Option<(Span, Vec<Ident>)>,
    /// Where the first contact is named.
    contact: Option<(Span, String)>,
    gravity: Vec<([NodeId; 2], Vec<Ident>)>,
    drives: Vec<(Ident, NodeId)>,
}

impl Lowering<'_> {
    /// Time and the rates of the coordinates, which the laws of scenes may hold.
    pub(super) fn declare_motion(&mut self, result: &mut Mechanism) {
        let mut name = "t".to_owned();
        let fields =
            result.parameters.iter().map(|p| &p.name.field).chain(result.coordinates.iter().map(|c| &c.name.field));
        let fields: BTreeSet<&String> = fields.collect();
        while fields.contains(&name) {
            name.push('_');
        }
        result.time = Some(self.graph.symbol(name));
        for coordinate in &mut result.coordinates {
            let rate = self.graph.symbol(format!("{}_rate", coordinate.name.field));
            coordinate.rate = Some(rate);
            self.rates.insert(coordinate.symbol, self.graph.variable(rate));
        }
        self.time = result.time.map(|time| self.graph.variable(time));
    }

    pub(super) fn body(&mut self, tree: &syntax::Body, result: &mut Mechanism) {
        let mut given: BTreeMap<String, ExpressionId> = BTreeMap::new();
        for (word, value) in &tree.properties {
            if given.insert(word.to_string(), *value).is_some() {
                self.diagnostics.error(word.span(), format_args!("`{word}` of `{}` is given twice", tree.name));
            }
        }
        // In the order in which they were written.
        let (mut scalars, mut center) = (BTreeMap::new(), None);
        for (word, value) in &tree.properties {
            if word == "center" {
                center = self.vector(*value);
            } else if let Some(node) = self.scalar(*value) {
                scalars.insert(word.to_string(), node);
            }
        }
        for word in ["mass", "inertia"] {
            if let (Some(&value), Some(&node)) = (given.get(word), scalars.get(word)) {
                self.positive(value, node, &format!("the {word} of `{}`", tree.name));
            }
        }
        let mut missing = |given_word: &str, needed: &str, example: &str| {
            if given.contains_key(given_word) && !given.contains_key(needed) {
                let message = format!("`{}` has {given_word}, but no {needed}: add `{example}`", tree.name);
                self.diagnostics.error(tree.name.span(), message);
            }
        };
        missing("mass", "center", "center G;");
        missing("inertia", "angle", "angle phi;");
        missing("center", "mass", "mass m;");
        missing("angle", "inertia", "inertia j;");
        if result.bodies.iter().any(|body| tree.name == body.name.text) {
            self.diagnostics.error(tree.name.span(), format_args!("a body is called `{}` already", tree.name));
        }
        result.bodies.push(Body {
            name: Name::new(&tree.name),
            mass: scalars.get("mass").copied().zip(center.map(|(x, y)| [x, y])),
            inertia: scalars.get("inertia").copied().zip(scalars.get("angle").copied()),
        });
    }

    /// Refuses what moves, and a constant less than zero.
    fn positive(&mut self, id: ExpressionId, node: NodeId, what: &str) {
        self.still(id, node, what);
        if self.graph.constant_value(node).is_some_and(|value| value < 0.0) {
            self.diagnostics.error(self.expressions.region(id), format_args!("{what} is negative"));
        }
    }

    /// Refuses what is made of anything but parameters.
    fn still(&mut self, id: ExpressionId, node: NodeId, what: &str) {
        let motion = self.rates.values().chain(&self.time).filter_map(|&node| self.graph.as_symbol(node));
        let motion: BTreeSet<SymbolId> = motion.chain(self.rates.keys().copied()).collect();
        if self.graph.symbols_of(&[node]).iter().any(|symbol| motion.contains(symbol)) {
            let message = format!("{what} must not move: it is made of parameters");
            self.diagnostics.error(self.expressions.region(id), message);
        }
    }

    /// An expression that may hold `t` and `rate(…)`.
    fn law(&mut self, id: ExpressionId) -> Option<NodeId> {
        self.is_law = true;
        let law = self.scalar(id);
        self.is_law = false;
        law
    }

    /// Where a spring or a damper acts, as the scalar it acts along, and its words.
    fn place(&mut self, place: &Place) -> Option<(NodeId, String)> {
        match *place {
            Place::On(on) => Some((self.scalar(on)?, format!(" on {}", self.text(on)?))),
            Place::Between(from, to) => {
                let (from_vector, to_vector) = (self.vector(from), self.vector(to));
                let ((ax, ay), (bx, by)) = (from_vector?, to_vector?);
                let (x, y) = (self.graph.subtract(bx, ax), self.graph.subtract(by, ay));
                let length = self.graph.call(Function::Hypot, &[x, y]);
                let words = self.text(from).zip(self.text(to));
                Some((length, words.map_or_else(String::new, |(from, to)| format!(" between {from} and {to}"))))
            }
        }
    }

    /// An expression by its name, or as a formula that somebody would read.
    fn text(&self, id: ExpressionId) -> Option<String> {
        const LONGEST: usize = 24;
        if let Some(name) = self.expressions.as_name(id) {
            return Some(name.to_string());
        }
        match self.values.get(id.index()) {
            Some(Value::Scalar(node)) => {
                let text = self.graph.text(*node);
                Some(if text.len() <= LONGEST { text } else { "an expression".to_owned() })
            }
            _ => Some("a point".to_owned()),
        }
    }

    pub(super) fn scene(&mut self, tree: &syntax::Scene, attributes: &[Attribute], reading: &mut Reading) {
        let mut scene = Scene {
            name: tree.name.clone(),
            attributes: attributes.to_vec(),
            driver: 0,
            inertia: None,
            weights: Vec::new(),
            laws: Vec::new(),
            contacts: Vec::new(),
            drives: Vec::new(),
            wishes: BTreeSet::new(),
            parameters: Vec::new(),
        };
        let mut names = Names { inertia: None, contact: None, gravity: Vec::new(), drives: Vec::new() };
        for effect in &tree.effects {
            self.effect(effect, &mut scene, &mut names);
        }
        reading.scenes.push((scene, tree.of.clone(), names));
    }

    fn effect(&mut self, effect: &syntax::Effect, scene: &mut Scene, names: &mut Names) {
        let keyword = &effect.keyword;
        match &effect.kind {
            EffectKind::Inertia(bodies) => {
                if names.inertia.replace((keyword.span(), bodies.clone())).is_some() {
                    let message = "`inertia` is said twice; name all bodies at once, or none for all";
                    self.diagnostics.error(keyword.span(), message);
                }
            }
            EffectKind::Gravity { field, bodies } => {
                let Some((x, y)) = self.vector(*field) else { return };
                for part in [x, y] {
                    self.still(*field, part, "the field of gravity");
                }
                names.gravity.push(([x, y], bodies.clone()));
            }
            EffectKind::Spring { stiffness, free, place } => {
                let k = self.scalar(*stiffness);
                let free_length = free.map(|free| self.scalar(free));
                let Some((along, words)) = self.place(place) else { return };
                let (Some(k), false) = (k, free_length == Some(None)) else { return };
                self.still(*stiffness, k, "the stiffness of a spring");
                let mut stretch = along;
                if let (Some(free), Some(Some(node))) = (free, free_length) {
                    self.still(*free, node, "the free length of a spring");
                    stretch = self.graph.subtract(along, node);
                }
                // F = -k (s - s0), V = k (s - s0)^2 / 2
                let pull = self.graph.multiply(k, stretch);
                let energy = self.graph.product(&[(k, 1), (stretch, 2)]);
                let account = Account::Stored(self.graph.scale(Number::ratio(1, 2), energy));
                scene.laws.push(Law { label: format!("spring{words}"), law: self.graph.negate(pull), along, account });
            }
            EffectKind::Damper { constant, place } => {
                let c = self.law(*constant);
                let Some((along, words)) = self.place(place) else { return };
                let Some(c) = c else { return };
                if self.graph.constant_value(c).is_some_and(|value| value < 0.0) {
                    let message = "the constant of a damper is negative: it would drive the mechanism";
                    self.diagnostics.error(self.expressions.region(*constant), message);
                }
                let rate = self.rate_of(along);
                let force = self.graph.multiply(c, rate);
                let law = self.graph.negate(force);
                scene.laws.push(Law { label: format!("damper{words}"), law, along, account: Account::Dissipated });
            }
            EffectKind::Torque { law, on } => {
                let (law, along) = (self.law(*law), self.scalar(*on));
                let (Some(law), Some(along), Some(words)) = (law, along, self.text(*on)) else { return };
                scene.laws.push(Law { label: format!("torque on {words}"), law, along, account: Account::Applied });
            }
            EffectKind::Force { law, at } => {
                self.is_law = true;
                let force = self.vector(*law);
                self.is_law = false;
                let (Some((fx, fy)), Some((x, y)), Some(words)) = (force, self.vector(*at), self.text(*at)) else {
                    return;
                };
                for (law, along) in [(fx, x), (fy, y)] {
                    scene.laws.push(Law { label: format!("force at {words}"), law, along, account: Account::Applied });
                }
            }
            EffectKind::Potential(value) => {
                if let Some(node) = self.scalar(*value) {
                    // F = -dV, by V itself
                    let label = format!("potential {}", self.text(*value).unwrap_or_default());
                    let law = self.graph.number(Number::MINUS_ONE);
                    scene.laws.push(Law { label, law, along: node, account: Account::Stored(node) });
                }
            }
            EffectKind::Friction { .. } | EffectKind::Stop { .. } => {
                names.contact.get_or_insert_with(|| (keyword.span(), keyword.to_string()));
                scene.contacts.extend(self.contact(&effect.kind));
            }
            EffectKind::Drive { input, law } => {
                let Some(node) = self.law(*law) else { return };
                let rates: Vec<_> = self.rates.values().filter_map(|&rate| self.graph.as_symbol(rate)).collect();
                let moves = |symbol: &SymbolId| self.rates.contains_key(symbol) || rates.contains(symbol);
                if self.graph.symbols_of(&[node]).iter().any(moves) {
                    let region = self.expressions.region(*law);
                    self.diagnostics.error(region, "a drive is a law of `t` and parameters alone");
                }
                names.drives.push((input.clone(), node));
            }
            EffectKind::Wish => {
                let wish = match keyword.to_string().as_str() {
                    "energy" => Wish::Energy,
                    "power" => Wish::Power,
                    "equilibrium" => Wish::Equilibrium,
                    _ => Wish::Reactions,
                };
                if !scene.wishes.insert(wish) {
                    self.diagnostics.error(keyword.span(), format_args!("`{keyword}` is asked for twice"));
                }
            }
        }
    }

    /// A friction or a stop. Every expression is read, whatever is wrong with the others.
    fn contact(&mut self, kind: &EffectKind) -> Option<Contact> {
        match kind {
            EffectKind::Friction { factors, on } => {
                let mut nodes = Vec::new();
                for &factor in factors {
                    let node = self.law(factor);
                    if node.and_then(|node| self.graph.constant_value(node)).is_some_and(|value| value < 0.0) {
                        let message = "the limit of a friction is negative: it would drive the mechanism";
                        self.diagnostics.error(self.expressions.region(factor), message);
                    }
                    nodes.push(node);
                }
                let along = self.moving(*on);
                let label = format!("friction on {}", self.text(*on)?);
                Some(Contact {
                    label,
                    along: along?,
                    law: ContactLaw::Friction(nodes.into_iter().collect::<Option<_>>()?),
                })
            }
            EffectKind::Stop { on, range, restitution } => {
                let along = self.moving(*on);
                let mut still = |id: ExpressionId, what: &str| {
                    let node = self.scalar(id)?;
                    self.still(id, node, what);
                    Some(node)
                };
                let ends = range.map(|end| still(end, "the end of a stop"));
                let given = still(*restitution, "the restitution of a stop");
                let label = format!("stop on {}", self.text(*on)?);
                let (range, restitution_node) = ([ends[0]?, ends[1]?], given?);
                let value = |node: NodeId| self.graph.constant_value(node);
                if let [Some(lower), Some(upper)] = range.map(value)
                    && lower >= upper
                {
                    let region = self.expressions.region(*on);
                    self.diagnostics.error(region, format_args!("nothing is left between {lower} and {upper}"));
                }
                if value(restitution_node).is_some_and(|value| !(0.0..=1.0).contains(&value)) {
                    let message = "a restitution is between 0 and 1: the part of the rate that an impact gives back";
                    self.diagnostics.error(self.expressions.region(*restitution), message);
                }
                let law = ContactLaw::Stop { range, restitution: restitution_node };
                Some(Contact { label, along: along?, law })
            }
            _ => None,
        }
    }

    /// A scalar that the mechanism moves.
    fn moving(&mut self, id: ExpressionId) -> Option<NodeId> {
        let node = self.scalar(id)?;
        if !self.graph.symbols_of(&[node]).iter().any(|symbol| self.rates.contains_key(symbol)) {
            let message =
                "nothing moves this: a friction or a stop acts on a coordinate, an output or what is made of them";
            self.diagnostics.error(self.expressions.region(id), message);
            return None;
        }
        Some(node)
    }

    /// The rate of an expression, by the rates of the coordinates.
    pub(super) fn rate_of(&mut self, node: NodeId) -> NodeId {
        self.graph.differentiate(&[node], &self.rates)[0]
    }

    /// What is known of the scenes once all statements are read: their bodies, drivers and parameters.
    pub(super) fn finish_scenes(&mut self, reading: Reading, result: &mut Mechanism) {
        let mut used = BTreeSet::new();
        for (mut scene, of, names) in reading.scenes {
            let Some(driver) = self.driver_of(&scene, of.as_ref(), result) else { continue };
            scene.driver = driver;
            if let Some((span, bodies)) = &names.inertia {
                let all = self.bodies(bodies, result);
                if all.is_empty() {
                    self.diagnostics.error(*span, "there is no `body` whose inertia could count");
                }
                used.extend(all.iter().copied());
                scene.inertia = Some(all);
            }
            if let (Some((span, word)), None) = (&names.contact, &names.inertia) {
                let message = format!("a `{word}` acts on what moves: add `inertia;` to `{}`", scene.name);
                self.diagnostics.error(*span, message);
            }
            for ([x, y], bodies) in &names.gravity {
                let all = self.bodies(bodies, result);
                used.extend(all.iter().copied());
                let heavy = all.into_iter().filter(|&index| result.bodies[index].mass.is_some());
                scene.weights.extend(heavy.map(|index| (index, [*x, *y])));
            }
            let Driver { inputs, name, .. } = &result.drivers[driver];
            for (input, law) in names.drives {
                let text = input.to_string();
                let place = inputs.iter().copied().find(|&index| result.coordinates[index].name.text == text);
                let Some(place) = place else {
                    let of = inputs.iter().map(|&index| result.coordinates[index].name.text.as_str());
                    let hint = suggestion(&text, of);
                    self.diagnostics.error(input.span(), format_args!("`{text}` is no input of `{name}`{hint}"));
                    continue;
                };
                if scene.drives.iter().any(|drive| drive.input == place) {
                    self.diagnostics.error(input.span(), format_args!("`{text}` is driven twice"));
                }
                scene.drives.push(Drive { input: place, law });
            }
            let taken = result.drivers.iter().map(|driver| &driver.name).chain([&result.name]);
            if taken.chain(result.scenes.iter().map(|scene| &scene.name)).any(|name| *name == scene.name) {
                let message = format!("the type `{}` is declared twice", scene.name);
                self.diagnostics.error(scene.name.span(), message);
                continue;
            }
            result.scenes.push(scene);
        }
        // A scene that was not understood would be missed.
        let is_complete = self.diagnostics.is_empty();
        for (index, body) in result.bodies.iter().enumerate().filter(|_| is_complete) {
            if !used.contains(&index) && !body.name.text.starts_with('_') {
                let message = format!("no scene counts the inertia or the weight of `{}`; remove it", body.name.text);
                self.diagnostics.error(body.name.span, message);
            }
        }
        self.part_parameters(result);
    }

    fn driver_of(&mut self, scene: &Scene, of: Option<&Ident>, result: &Mechanism) -> Option<usize> {
        let place = match of {
            Some(name) => result.drivers.iter().position(|driver| driver.name == *name),
            None => (result.drivers.len() == 1).then_some(0),
        };
        if place.is_none() {
            let names: Vec<String> = result.drivers.iter().map(|driver| driver.name.to_string()).collect();
            let (span, message) = match of {
                Some(name) => {
                    let hint = suggestion(&name.to_string(), names.iter().map(String::as_str));
                    (name.span(), format!("no driver is called `{name}`{hint}"))
                }
                None => {
                    let first = names.first().map_or("", String::as_str);
                    (scene.name.span(), format!("which driver? write `scene {} of {first} {{ … }}`", scene.name))
                }
            };
            self.diagnostics.error(span, message);
        }
        place
    }

    /// Bodies by their names; all of them if none is named.
    fn bodies(&mut self, names: &[Ident], result: &Mechanism) -> Vec<usize> {
        if names.is_empty() {
            return (0..result.bodies.len()).collect();
        }
        let mut found = Vec::new();
        for name in names {
            let text = name.to_string();
            match result.bodies.iter().position(|body| body.name.text == text) {
                Some(index) if found.contains(&index) => {
                    self.diagnostics.error(name.span(), format_args!("`{text}` is named twice"));
                }
                Some(index) => found.push(index),
                None => {
                    let hint = suggestion(&text, result.bodies.iter().map(|body| body.name.text.as_str()));
                    self.diagnostics.error(name.span(), format_args!("no body is called `{text}`{hint}"));
                }
            }
        }
        found
    }

    /// A parameter that no closure, point or output holds, but a scene, belongs to the scenes that hold it.
    fn part_parameters(&self, result: &mut Mechanism) {
        let kinematic: BTreeSet<SymbolId> = self.graph.symbols_of(&result.kinematic_formulas()).into_iter().collect();
        let held: Vec<BTreeSet<SymbolId>> = result
            .scenes
            .iter()
            .map(|scene| self.graph.symbols_of(&scene.formulas(&result.bodies)).into_iter().collect())
            .collect();
        let belongs = |symbol: &SymbolId| !kinematic.contains(symbol) && held.iter().any(|held| held.contains(symbol));
        let parameters = std::mem::take(&mut result.parameters);
        (result.scene_parameters, result.parameters) = parameters.into_iter().partition(|p| belongs(&p.symbol));
        for (scene, held) in result.scenes.iter_mut().zip(held) {
            let own = result.scene_parameters.iter().enumerate().filter(|(_, p)| held.contains(&p.symbol));
            scene.parameters = own.map(|(place, _)| place).collect();
        }
    }
}

impl Scene {
    /// Everything that it is made of.
    fn formulas(&self, bodies: &[Body]) -> Vec<NodeId> {
        let mut formulas: Vec<NodeId> = self.laws.iter().flat_map(|law| [law.law, law.along]).collect();
        for (index, field) in &self.weights {
            formulas.extend(field);
            formulas.extend(bodies[*index].mass.iter().flat_map(|(mass, center)| [*mass, center[0], center[1]]));
        }
        for contact in &self.contacts {
            formulas.push(contact.along);
            match &contact.law {
                ContactLaw::Friction(factors) => formulas.extend(factors),
                ContactLaw::Stop { range, restitution } => formulas.extend(range.iter().chain([restitution])),
            }
        }
        formulas.extend(self.drives.iter().map(|drive| drive.law));
        for &index in self.inertia.iter().flatten() {
            let Body { mass, inertia, .. } = &bodies[index];
            formulas.extend(mass.iter().flat_map(|(mass, center)| [*mass, center[0], center[1]]));
            formulas.extend(inertia.iter().flat_map(|(inertia, angle)| [*inertia, *angle]));
        }
        formulas
    }
}
