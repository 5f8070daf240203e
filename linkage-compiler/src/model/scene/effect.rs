//! Analysis of scenes and their effects.

use std::collections::BTreeSet;

use proc_macro2::Ident;
use syn::Attribute;

use super::{Account, Draft, Law, Reading, SceneRequest, Wanted};
use crate::graph::{Function, Node, NodeId, Number, SymbolId};
use crate::model::expression::Lowering;
use crate::model::scope::Value;
use crate::syntax::{self, EffectKind, Expression, ExpressionId, Place};

impl Lowering<'_> {
    pub(in crate::model) fn scene(&mut self, tree: &syntax::Scene, attributes: &[Attribute], reading: &mut Reading) {
        let mut scene = Draft {
            name: tree.name.clone(),
            attributes: attributes.to_vec(),
            of: tree.of.clone(),
            laws: Vec::new(),
            contacts: Vec::new(),
            requests: BTreeSet::new(),
            wanted: Vec::new(),
            inertia: None,
            contact: None,
            gravity: Vec::new(),
            drives: Vec::new(),
            mentions: BTreeSet::new(),
            is_complete: tree.is_complete,
        };
        let (before, messages) = (self.scope.uses(), self.diagnostics.len());
        for effect in &tree.effects {
            self.effect(effect, &mut scene);
            self.report_fault(effect.keyword.span());
        }
        scene.mentions = self.scope.used_since(before);
        scene.is_complete &= self.diagnostics.len() == messages;
        if !scene.is_complete {
            // The `inertia` that a contact needs may be in a statement with a mistake.
            scene.contact = None;
        }
        reading.scenes.push(scene);
    }

    fn effect(&mut self, effect: &syntax::Effect, scene: &mut Draft) {
        let keyword = &effect.keyword;
        match &effect.kind {
            EffectKind::Inertia(bodies) => {
                if scene.inertia.replace((keyword.span(), bodies.clone())).is_some() {
                    let message =
                        "`inertia` is written twice; name all bodies in one statement, or none for all bodies";
                    self.diagnostics.error(keyword.span(), message);
                }
            }
            EffectKind::Gravity { field, bodies } => {
                let Some((x, y)) = self.vector(*field) else { return };
                for part in [x, y] {
                    self.still(*field, part, "the field of gravity");
                }
                scene.gravity.push(([x, y], bodies.clone()));
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
                let label = format!("spring{words}");
                if let Some(along) = self.half_square(along).filter(|_| stretch == along) {
                    // F = -k along s^2 / 2: a length s need not have a direction where it is zero
                    let (law, energy) = (self.graph.negate(k), self.graph.multiply(k, along));
                    scene.laws.push(Law { label, law, along, account: Account::Stored(energy) });
                    return;
                }
                // F = -k (s - s0), V = k (s - s0)^2 / 2
                let pull = self.graph.multiply(k, stretch);
                let energy = self.graph.product(&[(k, 1), (stretch, 2)]);
                let account = Account::Stored(self.graph.scale(Number::ratio(1, 2), energy));
                scene.laws.push(Law { label, law: self.graph.negate(pull), along, account });
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
                    // F = -dV: the law -1 along V
                    let label = format!("potential {}", self.text(*value).unwrap_or_default());
                    let law = self.graph.number(Number::MINUS_ONE);
                    scene.laws.push(Law { label, law, along: node, account: Account::Stored(node) });
                }
            }
            EffectKind::Friction { .. } | EffectKind::Stop { .. } => {
                scene.contact.get_or_insert_with(|| (keyword.span(), keyword.to_string()));
                let contact = self.contact(&effect.kind);
                if let (EffectKind::Friction { reaction: Some(pin), on, .. }, Some(contact)) = (&effect.kind, &contact)
                {
                    let region = self.expressions.region(*on);
                    let pin = pin.and_then(|pin| self.vector(pin)).map(|(x, y)| [x, y]);
                    scene.wanted.push(Wanted::friction(region, scene.contacts.len(), (contact.along, pin)));
                }
                scene.contacts.extend(contact);
            }
            EffectKind::Reaction(joint) => scene.wanted.extend(self.joint(*joint)),
            EffectKind::Drive { input, law } => {
                let Some(node) = self.law(*law) else {
                    // For the stub.
                    scene.drives.push((input.clone(), self.graph.zero()));
                    return;
                };
                let rates: Vec<_> = self.rates.values().filter_map(|&rate| self.graph.as_symbol(rate)).collect();
                let moves = |symbol: &SymbolId| self.rates.contains_key(symbol) || rates.contains(symbol);
                if self.graph.symbols_of(&[node]).iter().any(moves) {
                    let region = self.expressions.region(*law);
                    self.diagnostics.error(region, "the law of a drive may depend on `t` and parameters only");
                }
                scene.drives.push((input.clone(), node));
            }
            EffectKind::Unread(names) => {
                self.value(*names);
                let is_coordinate =
                    |name: &&Ident| self.scope.symbol(name).is_some_and(|symbol| self.rates.contains_key(&symbol));
                if keyword == "drive"
                    && let Expression::Unread(names) = self.expressions.get(*names)
                    && let Some(input) = names.iter().map(|unread| &unread.name).find(is_coordinate)
                {
                    scene.drives.push((input.clone(), self.graph.zero()));
                }
            }
            EffectKind::Request => {
                let request = match keyword.to_string().as_str() {
                    "energy" => SceneRequest::Energy,
                    "power" => SceneRequest::Power,
                    "equilibrium" => SceneRequest::Equilibrium,
                    _ => SceneRequest::Reactions,
                };
                if request == SceneRequest::Reactions {
                    scene.wanted.push(Wanted::all(keyword.span()));
                }
                if !scene.requests.insert(request) {
                    self.diagnostics.error(keyword.span(), format_args!("`{keyword};` is written twice; remove one"));
                }
            }
        }
    }

    /// The scalar that a spring or damper acts along, and its text for the label.
    pub(super) fn place(&mut self, place: &Place) -> Option<(NodeId, String)> {
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

    /// s^2 / 2 of a length or another magnitude, also of a constant one: an opened joint may change it.
    fn half_square(&mut self, scalar: NodeId) -> Option<NodeId> {
        let parts = match self.graph.node(scalar).clone() {
            Node::Call(Function::Hypot | Function::Abs, parts) => parts,
            _ if self.graph.constant_value(scalar).is_some() => vec![scalar],
            _ => return None,
        };
        let squares: Vec<_> = parts.into_iter().map(|part| (Number::ratio(1, 2), self.graph.power(part, 2))).collect();
        Some(self.graph.sum(&squares))
    }

    /// The text of an expression for a label: its name, or its formula if that is short.
    pub(super) fn text(&self, id: ExpressionId) -> Option<String> {
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

    /// Evaluates an expression that may contain `t` and `rate(…)`.
    pub(super) fn law(&mut self, id: ExpressionId) -> Option<NodeId> {
        self.is_law = true;
        let law = self.scalar(id);
        self.is_law = false;
        law
    }

    /// Evaluates a scalar that must depend on coordinates.
    pub(super) fn moving(&mut self, id: ExpressionId) -> Option<NodeId> {
        let node = self.scalar(id)?;
        if !self.graph.symbols_of(&[node]).iter().any(|symbol| self.rates.contains_key(symbol)) {
            let message =
                "this is constant: a friction or a stop acts on a coordinate, an output or an expression of these";
            self.diagnostics.error(self.expressions.region(id), message);
            return None;
        }
        Some(node)
    }

    /// The rate of an expression in terms of the rates of the coordinates.
    pub(in crate::model) fn rate_of(&mut self, node: NodeId) -> NodeId {
        self.graph.differentiate(&[node], &self.rates)[0]
    }
}
