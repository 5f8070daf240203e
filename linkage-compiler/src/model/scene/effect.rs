//! Analysis of scenes and their effects.

use std::collections::{BTreeMap, BTreeSet};

use proc_macro2::Ident;
use rustc_hash::FxHashMap;
use syn::Attribute;

use super::along::{self, Along, Written};
use super::{Account, Draft, Law, Reading, SceneRequest, Wanted};
use crate::graph::{Function, Node, NodeId, Number, SymbolId};
use crate::model::resolver::{Mode, Resolver};
use crate::model::scope::Value;
use crate::syntax::{self, Attachment, EffectKind, Expression, ExpressionId};

impl Draft {
    /// Numbers the effects with equal names: `stop 1 on an expression`, `stop 2 on an expression`. `begins` has the first law
    /// and the first contact of each effect.
    fn number_labels(&mut self, begins: &[[usize; 2]]) {
        let effect_of = |axis: usize, index: usize| begins.partition_point(|begin| begin[axis] <= index);
        let laws = self.laws.iter_mut().enumerate().map(|(index, law)| (effect_of(0, index), &mut law.label));
        let contacts = self.contacts.iter_mut().enumerate();
        let contacts = contacts.map(|(index, contact)| (effect_of(1, index), &mut contact.label));
        let labels: Vec<(usize, &mut String)> = laws.chain(contacts).collect();
        let mut effects: BTreeMap<String, BTreeSet<usize>> = BTreeMap::new();
        for (effect, label) in &labels {
            effects.entry((*label).clone()).or_default().insert(*effect);
        }
        for (effect, label) in labels {
            let same = &effects[label.as_str()];
            if same.len() > 1 {
                let number = same.range(..=effect).count();
                let (word, rest) = label.split_once(' ').unwrap_or((label.as_str(), ""));
                *label = format!("{word} {number} {rest}").trim_end().to_owned();
            }
        }
    }
}

impl Resolver<'_> {
    pub(in crate::model) fn scene(&mut self, tree: &syntax::Scene, attributes: &[Attribute], reading: &mut Reading) {
        let mut scene = Draft {
            name: tree.name.clone(),
            attributes: attributes.to_vec(),
            of: tree.of.clone(),
            laws: Vec::new(),
            contacts: Vec::new(),
            requests: BTreeSet::new(),
            wanted: Vec::new(),
            written: Written::default(),
            inertia: None,
            contact: None,
            gravity: Vec::new(),
            drives: Vec::new(),
            mentions: BTreeSet::new(),
            is_complete: tree.is_complete,
        };
        let (before, messages) = (self.scope.uses(), self.diagnostics.len());
        let mut begins = Vec::new();
        for effect in &tree.effects {
            begins.push([scene.laws.len(), scene.contacts.len()]);
            self.scope.begin_statement();
            self.effect(effect, &mut scene);
            self.report_fault(effect.keyword.span());
        }
        scene.number_labels(&begins);
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
                let field_vector = self.within(Mode::Field, |resolver| resolver.vector(*field));
                let Some((x, y)) = field_vector else { return };
                for part in [x, y] {
                    self.still(*field, part, "the field of gravity");
                }
                scene.gravity.push(([x, y], bodies.clone()));
            }
            EffectKind::Spring { stiffness, free, attachment } => {
                let k = self.scalar(*stiffness);
                let free_length = free.map(|free| self.scalar(free));
                let Some((along, words)) = self.attachment(*attachment) else { return };
                let (Some(k), false) = (k, free_length == Some(None)) else { return };
                self.still(*stiffness, k, "the stiffness of a spring");
                let mut free_node = self.graph.zero();
                if let (Some(free), Some(Some(node))) = (free, free_length) {
                    self.still(*free, node, "the free length of a spring");
                    free_node = node;
                }
                // F = -k (s - s0), V = k (s - s0)^2 / 2
                let stretch = self.graph.subtract(along, free_node);
                let pull = self.graph.multiply(k, stretch);
                let double = self.graph.multiply(pull, stretch);
                let mut energy = self.graph.scale(Number::ratio(1, 2), double);
                let (pull, along) = match self.half_square(along) {
                    Some(half_square) if stretch == along => {
                        energy = self.graph.multiply(k, half_square);
                        (k, half_square)
                    }
                    // F = -k (s - s0) / s along s^2 / 2
                    Some(half_square) => {
                        let push = self.graph.multiply(k, free_node);
                        (self.by_length(pull, along, push, k), half_square)
                    }
                    None => (pull, along),
                };
                let (law, account) = (self.graph.negate(pull), Account::Stored(energy));
                scene.laws.push(Law { label: format!("spring{words}"), law, along, account });
                scene.written.laws.push(Along::Spring(*attachment));
            }
            EffectKind::Damper { constant, attachment } => {
                let c = self.law(*constant);
                let Some((along, words)) = self.attachment(*attachment) else { return };
                let Some(c) = c else { return };
                if self.graph.constant_value(c).is_some_and(|value| value < 0.0) {
                    let message = "the constant of a damper is negative: it would drive the mechanism";
                    self.diagnostics.error(self.expressions.region(*constant), message);
                }
                let along = self.signed(along);
                let (along, per_rate) = match self.half_square(along) {
                    // F = -c s' / s = -(c / s^2) (s^2 / 2)' along s^2 / 2
                    Some(half_square) => {
                        let (square, zero) = (self.graph.power(along, 2), self.graph.zero());
                        (half_square, self.by_length(c, square, c, zero))
                    }
                    None => (along, c),
                };
                let rate = self.rate_of(along);
                let force = self.graph.multiply(per_rate, rate);
                let law = self.graph.negate(force);
                scene.laws.push(Law { label: format!("damper{words}"), law, along, account: Account::Dissipated });
                scene.written.laws.push(Along::Damper(*attachment));
            }
            &EffectKind::Torque { law, on } => {
                let (law, along) = (self.law(law), self.scalar(on));
                let (Some(law), Some(along), Some(words)) = (law, along, self.text(on)) else { return };
                let (law, along) = match self.half_square(along) {
                    Some(half_square) => {
                        let zero = self.graph.zero();
                        (self.by_length(law, along, law, zero), half_square)
                    }
                    None => (law, along),
                };
                scene.laws.push(Law { label: format!("torque on {words}"), law, along, account: Account::Applied });
                scene.written.laws.push(Along::Spring(Attachment::On(on)));
            }
            EffectKind::Force { law, at } => {
                let force = self.within(Mode::Law, |resolver| resolver.vector(*law));
                let (Some((fx, fy)), Some((x, y)), Some(words)) = (force, self.vector(*at), self.text(*at)) else {
                    return;
                };
                for (law, along) in [(fx, x), (fy, y)] {
                    scene.laws.push(Law { label: format!("force at {words}"), law, along, account: Account::Applied });
                }
                scene.written.laws.push(Along::Point(*at));
            }
            EffectKind::Potential(value) => {
                if let Some(node) = self.scalar(*value) {
                    let label = format!("potential {}", self.text(*value).unwrap_or_default());
                    let laws = self.potential(node).into_iter();
                    scene.laws.extend(laws.map(|(law, along, energy)| Law {
                        label: label.clone(),
                        law,
                        along,
                        account: Account::Stored(energy),
                    }));
                    scene.written.laws.push(Along::Potential(*value));
                }
            }
            EffectKind::Friction { .. } | EffectKind::Stop { .. } => {
                scene.contact.get_or_insert_with(|| (keyword.span(), keyword.to_string()));
                let contact = self.contact(&effect.kind);
                if let (EffectKind::Friction { reaction: Some(pin), on, .. }, Some((contact, _))) =
                    (&effect.kind, &contact)
                {
                    let region = self.expressions.region(*on);
                    let pin = pin.and_then(|pin| self.vector(pin)).map(|(x, y)| [x, y]);
                    scene.wanted.push(Wanted::friction(region, scene.contacts.len(), (contact.along, pin)));
                }
                if let Some((contact, written)) = contact {
                    scene.contacts.push(contact);
                    scene.written.contacts.push(written);
                }
            }
            EffectKind::Reaction(joint) => scene.wanted.extend(self.joint(*joint)),
            EffectKind::Drive { input, law } => {
                let Some(node) = self.law(*law) else {
                    // For the stub.
                    scene.drives.push((input.clone(), self.graph.zero()));
                    return;
                };
                let rates: Vec<_> = self.motion.rates.values().filter_map(|&rate| self.graph.as_symbol(rate)).collect();
                let moves = |symbol: &SymbolId| self.motion.rates.contains_key(symbol) || rates.contains(symbol);
                if self.graph.symbols_of(&[node]).iter().any(moves) {
                    let region = self.expressions.region(*law);
                    self.diagnostics.error(region, "the law of a drive may depend on `t` and parameters only");
                }
                scene.drives.push((input.clone(), node));
            }
            EffectKind::Unread(names) => {
                self.value(*names);
                let is_coordinate = |name: &&Ident| {
                    self.scope.symbol(name).is_some_and(|symbol| self.motion.rates.contains_key(&symbol))
                };
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
    fn attachment(&mut self, attachment: Attachment) -> Option<(NodeId, String)> {
        let words = match attachment {
            Attachment::On(on) => {
                self.scalar(on)?;
                format!(" on {}", self.text(on)?)
            }
            Attachment::Between(from, to) => {
                let (from_vector, to_vector) = (self.vector(from), self.vector(to));
                from_vector.and(to_vector)?;
                let words = self.text(from).zip(self.text(to));
                words.map_or_else(String::new, |(from, to)| format!(" between {from} and {to}"))
            }
        };
        let values = &self.values;
        Some((along::length(&mut self.graph, attachment, &|id| values[id.index()])?, words))
    }

    /// Laws, scalars and energies with F = -dV: -dV/ds / s along s^2 / 2 for the terms of V that are functions of one length s, and -1 along the others.
    pub(super) fn potential(&mut self, value: NodeId) -> Vec<(NodeId, NodeId, NodeId)> {
        let mut laws = Vec::new();
        let mut others = Vec::new();
        for (coefficient, term) in self.graph.terms(value) {
            let energy = self.graph.scale(coefficient, term);
            match self.along_one_length(energy) {
                Some((law, along)) => laws.push((law, along, energy)),
                None => others.push((Number::ONE, energy)),
            }
        }
        if laws.is_empty() || !others.is_empty() {
            let (law, along) = (self.graph.number(Number::MINUS_ONE), self.graph.sum(&others));
            laws.push((law, along, along));
        }
        laws
    }

    /// -dV/ds / s and s^2 / 2, if V moves with one length s only, and not only with powers from s^2 on, which need no
    /// direction of it.
    fn along_one_length(&mut self, potential: NodeId) -> Option<(NodeId, NodeId)> {
        let reachable = self.graph.reachable(&[potential]);
        let length = reachable.iter().copied().rfind(|&node| self.graph.is_length(node) && self.moves(node))?;
        let needs_direction = reachable.iter().any(|&node| match self.graph.node(node) {
            Node::Sum { terms, .. } => terms.iter().any(|(_, term)| *term == length),
            Node::Product { factors, .. } => factors.iter().any(|&(base, exponent)| base == length && exponent < 2),
            Node::Call(_, arguments) | Node::External(_, arguments) => arguments.contains(&length),
            Node::Constant(_) | Node::Pi | Node::Symbol(_) => false,
        });
        let symbol = self.graph.symbol("length");
        let variable = self.graph.variable(symbol);
        let of_variable = self.graph.replace(&[potential], &FxHashMap::from_iter([(length, variable)]))[0];
        if self.moves(of_variable) || !needs_direction && length != potential {
            return None;
        }
        let slope = self.graph.partial(&[of_variable], symbol)[0];
        // A user function may have no second derivative.
        let is_external = |&node: &NodeId| matches!(self.graph.node(node), Node::External(..));
        let is_given = self.graph.reachable(&[slope]).iter().any(is_external);
        let stiffness = if is_given { variable } else { self.graph.partial(&[slope], symbol)[0] };
        let half_square = self.half_square(length)?;
        let at = |attachment| FxHashMap::from_iter([(variable, attachment)]);
        let zero = self.graph.zero();
        let here = self.graph.replace(&[slope], &at(length))[0];
        let law = if self.graph.symbols_of(&[stiffness]).contains(&symbol) {
            self.by_length(here, length, here, zero)
        } else {
            // dV/ds = c + k s
            let c = self.graph.replace(&[slope], &at(zero))[0];
            self.by_length(here, length, c, stiffness)
        };
        Some((self.graph.negate(law), half_square))
    }

    /// `force` / `length`, and its limit where `part`, the force at length zero, is zero: without a force its direction does
    /// not matter.
    fn by_length(&mut self, force: NodeId, length: NodeId, part: NodeId, limit: NodeId) -> NodeId {
        let quotient = self.graph.divide(force, length);
        self.graph.call(Function::IfNonzero, &[part, quotient, limit])
    }

    /// s^2 / 2 of a length or another magnitude, also of a constant one: an opened joint may change it. A force along it need
    /// not have a direction where the length is zero.
    pub(super) fn half_square(&mut self, scalar: NodeId) -> Option<NodeId> {
        let parts = match self.graph.node(scalar).clone() {
            Node::Call(Function::Hypot | Function::Abs, parts) => parts,
            Node::Call(Function::Sqrt, square) => return Some(self.graph.scale(Number::ratio(1, 2), square[0])),
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
        self.within(Mode::Law, |resolver| resolver.scalar(id))
    }

    /// Evaluates a scalar that must depend on coordinates.
    pub(super) fn moving(&mut self, id: ExpressionId) -> Option<NodeId> {
        let node = self.scalar(id)?;
        if !self.moves(node) {
            let message =
                "this is constant: a friction or a stop acts on a coordinate, an output or an expression of these";
            self.diagnostics.error(self.expressions.region(id), message);
            return None;
        }
        Some(node)
    }

    /// True if an expression depends on a coordinate.
    fn moves(&self, node: NodeId) -> bool {
        self.graph.symbols_of(&[node]).iter().any(|symbol| self.motion.rates.contains_key(symbol))
    }

    /// The rate of an expression in terms of the rates of the coordinates.
    pub(in crate::model) fn rate_of(&mut self, node: NodeId) -> NodeId {
        self.graph.differentiate(&[node], &self.motion.rates)[0]
    }
}
