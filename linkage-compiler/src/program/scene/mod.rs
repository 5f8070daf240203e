//! The functions of a scene: mass matrix, forces, accelerations, drives, energy and power.

mod contacts;
mod drives;
mod energy;
mod equilibrium;
mod gaps;
mod implementation;
mod kinks;
mod layers;
mod motion;
mod reactions;
mod reads;
mod signatures;
mod unreduced;
mod validity;

use linkage_ir::Intrinsic;

use super::doc::without_singular;
use super::expression::{Expression, Pattern, Receiver, Statement, Type};
use super::function::{Body, Function, Kernel, Output, Shape, Source};
use super::functions::Functions;
use super::implementation::{Implementation, Kink};
use super::names::Order;
use super::plan::Plan;
use crate::derivation::{self, Scene, Step};
use crate::graph::NodeId;
use crate::ids::SceneId;
use crate::model::{self, SceneRequest};
use reads::{Layers, Read};

pub(super) use implementation::of_scene as implementation;
pub use reactions::MULTIPLIERS;
pub use signatures::{Joint, SceneSignatures};

const ERRORS: [&str; 4] = [
    "",
    "# Errors",
    "`PositionError::Singular` if J is singular, `PositionError::NotFinite` with the name of the body or effect if its force is not",
    "finite.",
];

/// The program of one scene.
pub struct SceneProgram<B> {
    pub signatures: SceneSignatures,
    pub functions: Functions<B>,
    /// The trait for simulations, if the scene has inertia.
    pub implementation: Option<Implementation<B>>,
}

/// A scene whose functions are planned one by one.
pub struct ScenePlan<'p, 'd, 'a> {
    plan: &'p mut Plan<'d, 'a>,
    pub signatures: SceneSignatures,
    pub scene: Scene,
    pub functions: Vec<Function<Body>>,
    layers: Layers,
    /// True if the force of some body or effect is not a constant.
    has_varying_effects: bool,
    calls_check_effects: bool,
}

impl<'p, 'd, 'a> ScenePlan<'p, 'd, 'a> {
    /// Plans the functions of a scene; `number` is its index among the scenes of the driver.
    pub fn of(plan: &'p mut Plan<'d, 'a>, id: SceneId, number: usize) -> Option<Self> {
        let derived = plan.derivation.scenes.get(number)?.clone();
        let mut parts = derived.parts.iter().flat_map(|(_, parts)| parts);
        let has_varying_effects = parts.any(|&part| plan.derivation.graph.constant_value(part).is_none());
        let signatures = SceneSignatures::new(plan.mechanism, plan.driver, id);
        let mut planned = ScenePlan {
            plan,
            signatures,
            scene: derived,
            functions: Vec::new(),
            layers: Layers::default(),
            has_varying_effects,
            calls_check_effects: false,
        };
        planned.reduced_inertia();
        planned.effects();
        planned.reduced_forces();
        let has_inertia = planned.signatures.has_inertia;
        if has_inertia {
            planned.mass_matrix();
        }
        planned.forces();
        if has_inertia {
            planned.rates();
            planned.unreduced();
        }
        if !planned.signatures.driven.is_empty() {
            planned.drives();
            planned.drive_forces();
        }
        let requests = [SceneRequest::Energy, SceneRequest::Power, SceneRequest::Reactions, SceneRequest::Equilibrium];
        let requests: Vec<SceneRequest> =
            requests.into_iter().filter(|request| planned.signatures.requests.contains(request)).collect();
        for request in requests {
            match request {
                SceneRequest::Energy => planned.energy(),
                SceneRequest::Power => planned.power(),
                SceneRequest::Reactions => {}
                SceneRequest::Equilibrium => planned.equilibrium(),
            }
        }
        planned.reactions();
        if !planned.signatures.contacts.is_empty() {
            planned.contacts();
            planned.bearings();
            planned.equations();
        }
        planned.kinks();
        planned.gap_changes();
        planned.check();
        if planned.calls_check_effects {
            planned.check_effects();
        }
        Some(planned)
    }

    pub fn into_program(self) -> SceneProgram<Body> {
        let kink = |kink: &derivation::Kink| Kink { effect: kink.label.clone(), is_timed: kink.is_timed };
        let kinks = self.scene.kinks.iter().map(kink).collect();
        let has_change: Vec<bool> = self.scene.gap_changes.iter().map(|change| change.is_some()).collect();
        let implementation = implementation(&self.signatures, kinks, &has_change);
        SceneProgram { signatures: self.signatures, functions: self.functions.into_iter().collect(), implementation }
    }
}

impl ScenePlan<'_, '_, '_> {
    fn add(&mut self, signature: Function<Body>, doc: Vec<String>, body: Body) {
        let doc = if self.plan.signatures.is_open { without_singular(doc) } else { doc };
        self.functions.push(Function { doc, body: Some(body), ..signature });
    }

    /// The field that holds the mechanism.
    fn mechanism(&self) -> Expression {
        Expression::own().field(&self.signatures.field)
    }

    // Sources of symbols.

    /// The parameters of the mechanism and of the scene, and time.
    fn given(&self) -> Source {
        let of = |parameter: &model::Parameter| (parameter.name.field.clone(), parameter.symbol);
        let (mechanism, SceneSignatures { id, types, field, .. }) = (self.plan.mechanism, &self.signatures);
        let driver = Type::Bare(types.driver.clone());
        let kinematics = Shape::fields(driver, mechanism.parameters.iter().map(of), true);
        let own = mechanism.scenes[*id].parameters.iter().map(|&at| of(&mechanism.scene_parameters[at]));
        let own = own.map(|(field, symbol)| (field, Shape::Symbol(symbol)));
        let fields = std::iter::once((field.clone(), kinematics)).chain(own).collect();
        let shape = Shape::Fields { of: Type::Itself, fields, is_whole: true };
        Source { from: Expression::own().dereferenced(), shape }
    }

    /// A kernel on parameters and time.
    fn on_parameters(&self, results: Vec<Output>) -> Kernel {
        Kernel { sources: vec![self.given()], results, ..Kernel::default() }
    }

    /// The pose at q, under the name of the argument that holds one.
    fn pose_at(&self, body: &mut Body) {
        let (q, pose) = (&self.signatures.arguments.q, &self.signatures.arguments.pose);
        let call = self.mechanism().driver_call("pose_at", [Expression::name(q)]);
        body.before.push(Statement::Let(Pattern::bound(pose.clone()), call));
    }

    /// The name of a function of the driver in call lists.
    /// A body with parameters, coordinates and other sources. It computes only the sines that it needs, fewer than
    /// those of a pose.
    fn on_coordinates(&self, sources: Vec<Source>, steps: Vec<Step>, results: Vec<Output>) -> Body {
        let coordinates = self.plan.coordinates(Order::Value);
        let sources = [self.given(), coordinates].into_iter().chain(sources).collect();
        let steps = self.plan.with_determinants(steps);
        Body { kernel: Some(Kernel { sources, steps, results, ..Kernel::default() }), ..Body::default() }
    }

    /// A body with parameters, coordinates, the pose at these and other sources.
    fn on_pose(&self, sources: Vec<Source>, steps: Vec<Step>, results: Vec<Output>) -> Body {
        let mut body = Body::default();
        let nodes: Vec<NodeId> = results.iter().map(|output| output.node).collect();
        if !steps.is_empty() || self.reads(&nodes).contains(&Read::Pose) {
            self.pose_at(&mut body);
        }
        let sources = self.still().into_iter().chain(sources).collect();
        body.kernel = Some(Kernel { sources, steps, results, is_on_pose: true, ..Kernel::default() });
        body
    }

    /// The parameters, the coordinates, and the determinants and user function values of a pose.
    fn still(&self) -> [Source; 3] {
        let coordinates = self.plan.coordinates(Order::Value);
        [self.given(), coordinates, self.plan.computed()]
    }

    /// A call of a private function of the driver, with the name of the scene for its errors if it can fail.
    fn driver_call(&self, function: &str, mut on: Vec<Expression>) -> Expression {
        let layer = self.plan.functions.iter().find(|layer| layer.name == function);
        let (is_method, is_fallible) = layer.map_or((true, true), |layer| (layer.is_method, layer.is_fallible));
        on.extend(is_fallible.then(Expression::mechanism));
        let call = if is_method {
            self.mechanism().driver_call(function, on)
        } else {
            Expression::called_on(
                Receiver::Type(Box::new(Type::Bare(self.signatures.types.driver.clone()))),
                function,
                on,
            )
        };
        if is_fallible { call.tried() } else { call }
    }

    /// Adds a check that values are finite; if it fails, `check_effects` finds the body or effect to name.
    fn checked_with_effects(&mut self, mut body: Body, what: &str, values: Vec<Expression>) -> Body {
        let arguments = &self.signatures.arguments;
        let is_formula = |value: &Expression| match value {
            Expression::Result(index) => {
                let graph = &self.plan.derivation.graph;
                let node = body.kernel.as_ref().map(|kernel| kernel.results[*index].node);
                node.is_none_or(|node| graph.as_number(node).is_none_or(|number| !number.is_zero() && !number.is_one()))
            }
            _ => true,
        };
        let check_effects = (self.has_varying_effects && values.iter().any(is_formula)).then(|| {
            let time = self.effects_depend_on_time().then_some(&arguments.time);
            let state = time.into_iter().chain([&arguments.q, &arguments.input_rates]);
            let check_effects = Expression::own_call("check_effects", state.map(Expression::name));
            let error = Expression::call(Intrinsic::Err, [Expression::name("error").converted()]);
            Expression::Closure {
                arguments: vec![Pattern::bound("error".to_owned())],
                statements: Vec::new(),
                value: Box::new(Expression::call(Intrinsic::And, [check_effects, error])),
                moves: false,
            }
        });
        self.calls_check_effects |= check_effects.is_some();
        body.after.push(Statement::Check { what: what.to_owned(), values, detail: check_effects });
        body
    }

    /// Converts the input rates once, at the start of a body.
    fn with_rates(&self, mut body: Body) -> Body {
        let input_rates = &self.signatures.arguments.input_rates;
        let inputs = Type::Own(self.signatures.types.inputs.clone());
        let converted = Expression::name(input_rates).converted();
        body.before.insert(0, Statement::Let(Pattern::typed(input_rates.clone(), inputs), converted));
        body
    }
}
