//! The functions of a scene: mass matrix, forces, accelerations, drives, energy and power.

mod block;
mod drives;
mod energy;
mod equilibrium;
mod motion;
mod reactions;
mod verdicts;

use std::borrow::Cow;
use std::cell::Cell;

use proc_macro2::{Ident, TokenStream};
use quote::quote;

use super::super::kernel::{self, Code, Operand, Shape, Source};
use super::super::names::ident;
use super::super::pose::PosePlan;
use super::super::scene::mechanism_field;
use super::super::tokens::Tokens;
use super::super::types::field;
use super::super::{Emitted, Types, document};
use super::{Body, Kernels, Methods, argument_of, check_finite};
use crate::derivation::{Derivation, Form, Scene};
use crate::graph::{NodeId, Number, SymbolId};
use crate::lower::{Operations, Stage, needed};
use crate::model::{self, Driver, Mechanism, Wish};

const ERRORS: [&str; 4] = [
    "",
    "# Errors",
    "`Singular` where J has no inverse, `NotFinite` with the name of the body or the effect that has no finite",
    "value.",
];

/// What the functions of one scene are written from.
pub(super) struct Setting<'a> {
    pub(super) scene: &'a model::Scene,
    /// Its own type, the field of the mechanism, and the argument that holds time.
    field: Ident,
    pub(super) time: Ident,
    /// The inputs by name, and those that are driven, by place.
    pub(super) inputs: Vec<Ident>,
    driven: Vec<usize>,
    free: Vec<usize>,
    /// Whether there is an effect that could have no finite value, and whether some function asks which.
    is_blamable: bool,
    blames: Cell<bool>,
}

/// The functions of a scene, which is the one of this number among those of its driver.
pub(in crate::emit) fn of_scene(
    mechanism: &Mechanism,
    (driver, scene, number): (&Driver, &model::Scene, usize),
    types: &Types,
    derived: Option<(&PosePlan, &mut Derivation)>,
    private: &TokenStream,
) -> Emitted {
    let inner = mechanism_field(mechanism);
    let mut methods = Methods::new(mechanism, driver, types, Some(&inner));
    let time = mechanism.time.map_or("t", |time| mechanism.graph.symbol_name(time));
    let is_driven = |place: &usize| scene.drives.iter().any(|drive| drive.input == driver.inputs[*place]);
    let (driven, free) = (0..driver.inputs.len()).partition(is_driven);
    let mut derived = derived.and_then(|(plan, derivation)| {
        let scene = derivation.scenes.get(number)?.clone();
        Some((Kernels::new(derivation, plan), scene))
    });
    let place = Setting {
        scene,
        field: inner.clone(),
        time: ident(time),
        inputs: driver.inputs.iter().map(|&index| field(&mechanism.coordinates[index].name)).collect(),
        driven,
        free,
        is_blamable: derived.as_ref().is_some_and(|(kernels, scene)| {
            let mut parts = scene.parts.iter().flat_map(|(_, parts)| parts);
            parts.any(|&part| kernels.derivation.graph.constant_value(part).is_none())
        }),
        blames: Cell::new(false),
    };
    if scene.inertia.is_some() {
        methods.mass_matrix(&place, parts_of(&mut derived));
    }
    methods.forces(&place, parts_of(&mut derived));
    if scene.inertia.is_some() {
        methods.rates(&place, parts_of(&mut derived));
        methods.unreduced(&place, parts_of(&mut derived));
    }
    if !place.driven.is_empty() {
        methods.drives(&place, parts_of(&mut derived));
        methods.drive_forces(&place, parts_of(&mut derived));
    }
    if scene.wishes.contains(&Wish::Energy) {
        methods.energy(&place, parts_of(&mut derived));
    }
    if scene.wishes.contains(&Wish::Power) {
        methods.power(&place, parts_of(&mut derived));
    }
    if scene.wishes.contains(&Wish::Reactions) {
        methods.reactions(&place, parts_of(&mut derived));
    }
    if scene.wishes.contains(&Wish::Equilibrium) {
        methods.equilibrium(&place, parts_of(&mut derived));
    }
    if !scene.contacts.is_empty() {
        methods.contacts(&place, parts_of(&mut derived));
        methods.equations(&place, parts_of(&mut derived));
    }
    methods.check(&place, parts_of(&mut derived));
    if place.blames.get() {
        methods.blame(&place, parts_of(&mut derived));
    }
    let mut tokens = methods.scene_block(&place, private);
    tokens.extend(methods.calls(private));
    if let Some((kernels, derived)) = &derived {
        let derived = (&*kernels.derivation, derived);
        tokens.extend(document::of_scene(mechanism, (driver, scene), derived, &methods.kernels, private));
    }
    let operations = methods.kernels.iter().fold(Operations::default(), |sum, (_, kernel)| sum.plus(*kernel));
    Emitted { tokens, operations }
}

pub(super) type Parts<'a, 'b> = Option<(&'a mut Kernels<'b>, &'a Scene)>;

fn parts_of<'a, 'b>(derived: &'a mut Option<(Kernels<'b>, Scene)>) -> Parts<'a, 'b> {
    derived.as_mut().map(|(kernels, scene)| (kernels, &*scene))
}

impl Kernels<'_> {
    /// W, then u' = W v', then u'' at v'' = 0, block by block, and what is returned; without what nobody needs.
    fn motion_stages(&mut self, scene: &Scene, returned: Vec<NodeId>) -> Vec<Stage> {
        let names = self.derivation.ratios.clone();
        let mut systems: Vec<_> =
            names.iter().enumerate().map(|(input, names)| (self.derivation.ratio_side(input), names.clone())).collect();
        systems.push((self.derivation.bias_side(), scene.bias.clone()));
        let (stages, solved) = self.derivation.solve(&systems, Form::Entries);
        let inputs = self.rates(&self.derivation.inputs.clone());
        let inputs = self.variables(&inputs);
        let unknowns = self.rates(&self.derivation.unknowns.clone());
        let mut all = Vec::new();
        for stage in stages {
            let last = names.last().and_then(|last| {
                let introduced = stage.introduced();
                let found = introduced.iter().filter_map(|symbol| last.iter().position(|name| name == symbol));
                Some(found.collect::<Vec<_>>()).filter(|found| !found.is_empty())
            });
            all.push(stage);
            for unknown in last.into_iter().flatten() {
                let terms = solved.iter().zip(&inputs).map(|(of_input, &rate)| (of_input[unknown], rate));
                let graph = &mut self.derivation.graph;
                let terms: Vec<_> = terms.map(|(ratio, rate)| (Number::ONE, graph.multiply(ratio, rate))).collect();
                all.push(Stage::Let { symbol: unknowns[unknown], node: graph.sum(&terms) });
            }
        }
        all.push(Stage::Return(returned));
        let all = self.with_determinants(all);
        needed(&self.derivation.graph, all)
    }
}
impl Methods<'_> {
    /// A kernel on coordinates, the rates of the inputs, and time.
    pub(super) fn on_motion(
        &self,
        place: &Setting,
        kernels: &mut Kernels,
        scene: &Scene,
        returned: Vec<NodeId>,
    ) -> Code {
        let stages = kernels.motion_stages(scene, returned);
        self.on_state(place, kernels, &stages)
    }

    fn on_state(&self, place: &Setting, kernels: &Kernels, stages: &[Stage]) -> Code {
        let rate = &self.arguments.rate;
        let inputs = Source { from: Tokens::name(rate), ..self.inputs(kernels, rate, |c| c.rate) };
        self.on(place, kernels, vec![self.coordinates(kernels, &self.arguments.q, |c| c.value), inputs], stages)
    }

    /// A kernel on parameters, time, and what else it is given.
    pub(super) fn on(&self, place: &Setting, kernels: &Kernels, motion: Vec<Source<'_>>, stages: &[Stage]) -> Code {
        let (mechanism, inner) = (self.mechanism, &place.field);
        fn of(parameter: &model::Parameter) -> (Cow<'_, str>, SymbolId) {
            (Cow::from(&parameter.name.field), parameter.symbol)
        }
        let mut fields: Vec<_> = place.scene.parameters.iter().map(|&at| of(&mechanism.scene_parameters[at])).collect();
        // The mechanism is a field as well, so that the pattern is never complete.
        fields.push((Cow::from(inner.to_string()), SymbolId::NONE));
        let driver = &self.driver.name;
        let mut sources = vec![
            Source {
                argument: None,
                from: quote!(self.#inner).into(),
                of: Shape::Fields(Tokens::name(driver)),
                fields: mechanism.parameters.iter().map(of).collect(),
            },
            Source {
                argument: None,
                from: Tokens::behind(&self.words.own),
                of: Shape::Fields(Tokens::name(&self.words.own_type)),
                fields,
            },
            Source {
                argument: Some(place.time.clone()),
                from: Tokens::default(),
                of: Shape::Argument,
                fields: mechanism.time.map(|time| (Cow::from(""), time)).into_iter().collect(),
            },
        ];
        sources.splice(2..2, motion);
        let given = self.given(sources, None);
        kernel::write(kernels.derivation, &given, stages, &self.named, &self.scope)
    }

    /// A verdict that is made more precise only where it is bad.
    pub(super) fn blamed(&self, place: &Setting, code: &mut Code, what: &str, values: &[Operand]) -> TokenStream {
        let verdict = check_finite(code, what, values);
        if verdict.is_empty() || !place.is_blamable {
            return verdict;
        }
        place.blames.set(true);
        let (time, q, rate) = (&place.time, &self.arguments.q, &self.arguments.rate);
        for argument in [time, q, rate] {
            if !code.arguments.contains(argument) {
                code.arguments.push(argument.clone());
            }
        }
        let values: Vec<&Operand> = values.iter().filter(|value| !matches!(value, Operand::Constant(_))).collect();
        quote!(finite(Self::NAME, #what, [#(#values),*]).or_else(|error| self.blame(#time, #q, #rate).and(Err(error)))?;)
    }

    /// `t, &q, v'` as the arguments of a function that ignores what its body does not use.
    pub(super) fn state_arguments(&self, place: &Setting, body: Option<&Body>) -> TokenStream {
        let (coordinates, inputs) = (&self.types.coordinates, &self.types.inputs);
        let [time, q, rate] =
            [&place.time, &self.arguments.q, &self.arguments.rate].map(|argument| argument_of(argument, body));
        quote!(&self, #time: T, #q: &#coordinates<T>, #rate: impl Into<#inputs<T>>)
    }

    /// The rates by their name, which a body may use more than once.
    pub(super) fn with_rates(&self, mut body: Body) -> Body {
        let rate = &self.arguments.rate;
        if body.arguments.contains(rate) {
            let (inputs, tokens) = (&self.types.inputs, body.tokens);
            body.tokens = quote!(let #rate: #inputs<T> = #rate.into(); #tokens).into();
        }
        body
    }
}
