//! The functions of a scene: mass matrix, forces, accelerations, drives, energy and power.

use std::borrow::Cow;
use std::cell::Cell;

use proc_macro2::{Ident, TokenStream};
use quote::quote;

use super::super::kernel::{self, Code, Given, Operand, Shape, Source};
use super::super::names::{ident, string};
use super::super::pose::PosePlan;
use super::super::scene::mechanism_field;
use super::super::tokens::Tokens;
use super::super::types::field;
use super::super::{Emitted, Types, document};
use super::{Body, Kernels, Methods, argument_of, bind, check_finite, columns_of, fenced, lines, literal};
use crate::derivation::{ContactFormula, Derivation, Form, Prescribed, Scene};
use crate::graph::{NodeId, Number, SymbolId};
use crate::model::{self, Driver, Mechanism, Wish};
use crate::simplify::schedule::{Operations, Stage, needed};

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
        let given = Given { sources, pose: None, branch: &self.arguments.branch };
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

    fn mass_matrix(&mut self, place: &Setting, parts: Parts) {
        let v = place.inputs.len();
        let nv = literal(v);
        let mut docs =
            lines(["The mass matrix reduced to the inputs, M = sum m `W_G`' `W_G` + j w' w: M v'' = `forces`."]);
        let code = parts.map(|(kernels, scene)| {
            let entries: Vec<NodeId> = scene.mass_matrix.iter().flatten().flatten().copied().collect();
            docs.extend(fenced(self.entries("M", v, &entries, kernels).into_iter()));
            let mut code = self.on_motion(place, kernels, scene, entries);
            let wishes = self.pair_names(place, "inertia");
            let (bindings, entries) = bind(&code.results, &wishes, &mut code.taken);
            let verdict = check_finite(&mut code, "the mass matrix", &entries);
            let matrix = columns_of(&entries, v);
            Body::new(code, quote!(#bindings #verdict Ok(#matrix)), [])
        });
        docs.extend(lines([
            "",
            "# Errors",
            "`Singular` where J has no inverse, `NotFinite` if an entry is not finite.",
        ]));
        let (q, coordinates) = (argument_of(&self.arguments.q, code.as_ref()), &self.types.coordinates);
        let signature = quote!(pub fn mass_matrix(&self, #q: &#coordinates<T>) -> Result<SMatrix<T, #nv, #nv>, Error>);
        self.function(&docs, signature, code);
    }

    fn entries(&self, name: &str, columns: usize, nodes: &[NodeId], kernels: &Kernels) -> Vec<String> {
        let entries = nodes.iter().enumerate().filter(|(index, _)| index / columns <= index % columns);
        entries
            .map(|(index, &node)| {
                let place = if columns == 1 {
                    String::new()
                } else {
                    format!("_{}{}", index / columns + 1, index % columns + 1)
                };
                format!("{name}{place} = {}", kernels.text(node))
            })
            .collect()
    }

    /// `theta1_theta4_inertia`
    pub(super) fn pair_names(&self, place: &Setting, what: &str) -> Vec<String> {
        let names = &place.inputs;
        let pair = |a: &Ident, b: &Ident| if a == b { format!("{a}_{what}") } else { format!("{a}_{b}_{what}") };
        names.iter().flat_map(|a| names.iter().map(move |b| pair(a, b))).collect()
    }

    fn forces(&mut self, place: &Setting, parts: Parts) {
        let nv = literal(place.inputs.len());
        let mut docs = lines(["The generalised forces Q of the inputs"]);
        let quadratic =
            if place.scene.inertia.is_some() { ", with the quadratic velocity terms: M v'' = Q." } else { "." };
        docs[0] += quadratic;
        let code = parts.map(|(kernels, scene)| {
            let laws = place.inputs.iter().zip(&scene.forces);
            docs.extend(fenced(laws.map(|(input, &force)| format!("Q_{input} = {}", kernels.text(force)))));
            let mut code = self.on_motion(place, kernels, scene, scene.forces.clone());
            let wishes: Vec<String> = place.inputs.iter().map(|input| format!("{input}_force")).collect();
            let (bindings, forces) = bind(&code.results, &wishes, &mut code.taken);
            let verdict = self.blamed(place, &mut code, "the forces", &forces);
            self.with_rates(Body::new(code, quote!(#bindings #verdict Ok(SVector::from([#(#forces),*]))), []))
        });
        docs.extend(lines(ERRORS));
        let arguments = self.state_arguments(place, code.as_ref());
        let signature = quote!(pub fn forces(#arguments) -> Result<SVector<T, #nv>, Error>);
        self.function(&docs, signature, code);
    }

    /// M of some rows and columns.
    fn minor(scene: &Scene, rows: &[usize], columns: &[usize]) -> Vec<NodeId> {
        let matrix = scene.mass_matrix.as_deref().unwrap_or_default();
        rows.iter().flat_map(|&row| columns.iter().map(move |&column| matrix[row][column])).collect()
    }

    /// `Q - M_d a_d` of some inputs, with the accelerations of the driven ones.
    fn right_sides(place: &Setting, kernels: &mut Kernels, scene: &Scene, rows: &[usize]) -> Vec<NodeId> {
        let graph = &mut kernels.derivation.graph;
        let mut sides = Vec::new();
        for &row in rows {
            let mut terms = vec![(Number::ONE, scene.forces[row])];
            for (column, law) in scene.mass_matrix.iter().flat_map(|_| &scene.drives) {
                let entry = scene.mass_matrix.as_ref().map(|matrix| matrix[row][*column]);
                terms.extend(entry.map(|entry| (Number::MINUS_ONE, graph.multiply(entry, law.acceleration))));
            }
            sides.push(graph.sum(&terms));
        }
        debug_assert_eq!(place.driven.len(), scene.drives.len());
        sides
    }

    /// Lines that solve for the accelerations of the free inputs, and their names.
    fn solve_free(
        place: &Setting,
        code: &mut Code,
        entries: &[Operand],
        sides: &[Operand],
    ) -> (TokenStream, Vec<Ident>) {
        let names: Vec<Ident> = place
            .free
            .iter()
            .map(|&at| ident(&code.taken.unique(&format!("{}_acceleration", place.inputs[at]))))
            .collect();
        if names.is_empty() {
            return (TokenStream::new(), names);
        }
        let count = names.len();
        let texts = place.free.iter().map(|&at| place.inputs[at].to_string());
        let columns = entries.chunks(count).map(|column| quote!([#(#column),*]));
        // One division a pivot, and the two triangles.
        code.operations.divisions += count * (count + 1) / 2;
        let pairs = count * (count - 1) / 2;
        let inner = (0..count).map(|left| left * (left + 1) / 2 * 2).sum::<usize>() / 2 * 2;
        code.operations.multiplications += inner + 2 * pairs;
        code.operations.additions += inner + 2 * pairs;
        code.uses.insert("reduced");
        let tokens = quote!(let [#(#names),*] = reduced(Self::NAME, [#(#texts),*], [#(#columns),*], [#(#sides),*])?;);
        (tokens, names)
    }

    /// q' and v'' in one kernel, and v'' alone by the same.
    fn rates(&mut self, place: &Setting, parts: Parts) {
        let (coordinates, inputs) = (self.types.coordinates.clone(), self.types.inputs.clone());
        let code = parts.map(|(kernels, scene)| {
            let all: Vec<usize> = (0..kernels.derivation.coordinates.len()).collect();
            let rates = kernels.rates(&all);
            let mut returned = kernels.variables(&rates);
            returned.extend(Self::minor(scene, &place.free, &place.free));
            returned.extend(Self::right_sides(place, kernels, scene, &place.free));
            returned.extend(scene.drives.values().map(|law| law.acceleration));
            let mut code = self.on_motion(place, kernels, scene, returned);
            let results = std::mem::take(&mut code.results);
            let (rates, rest) = results.split_at(all.len());
            let (entries, rest) = rest.split_at(place.free.len().pow(2));
            let (sides, laws) = rest.split_at(place.free.len());
            let wishes: Vec<String> =
                place.driven.iter().map(|&at| format!("{}_acceleration", place.inputs[at])).collect();
            let (bindings, laws) = bind(laws, &wishes, &mut code.taken);
            let (solve, free) = Self::solve_free(place, &mut code, entries, sides);
            let mut accelerations: Vec<(usize, Operand)> =
                place.free.iter().copied().zip(free.into_iter().map(Operand::Name)).collect();
            accelerations.extend(place.driven.iter().copied().zip(laws));
            accelerations.sort_by_key(|(at, _)| *at);
            let accelerations: Vec<Operand> = accelerations.into_iter().map(|(_, value)| value).collect();
            let mut checked = accelerations.clone();
            checked.extend(kernels.derivation.unknowns.iter().map(|&index| rates[index].clone()));
            let verdict = self.blamed(place, &mut code, "the acceleration", &checked);
            let (fields, names) = (self.coordinate_fields(), &place.inputs);
            let members = fields.iter().zip(rates).map(|(field, rate)| super::member(field, rate));
            let values = names.iter().zip(&accelerations).map(|(name, value)| super::member(name, value));
            let tail = quote!(#bindings #solve #verdict Ok((#coordinates { #(#members),* }, #inputs { #(#values),* })));
            self.with_rates(Body::new(code, tail, []))
        });
        let mut docs = lines([
            "The velocity q' = (W v', v') and the input accelerations v'' of M v'' = Q: what an integrator takes.",
        ]);
        let mut errors = lines(ERRORS);
        errors.push("`NoInertia` where an input could accelerate without a force.".to_owned());
        docs.extend(errors.clone());
        let arguments = self.state_arguments(place, code.as_ref());
        let signature = quote!(pub fn rates(#arguments) -> Result<(#coordinates<T>, #inputs<T>), Error>);
        self.function(&docs, signature, code);
        let (time, q, rate) = (&place.time, &self.arguments.q, &self.arguments.rate);
        let mut docs = lines(["The accelerations v'' of the inputs: M v'' = Q, and the laws of what is driven."]);
        docs.extend(errors);
        let body = Body::plain(quote!(Ok(self.rates(#time, #q, #rate)?.1)), [time, q, rate], []);
        let arguments = self.state_arguments(place, Some(&body));
        let signature = quote!(pub fn acceleration(#arguments) -> Result<#inputs<T>, Error>);
        self.function(&docs, signature, Some(body));
    }

    /// The laws of the driven inputs with their derivatives.
    fn drives(&mut self, place: &Setting, parts: Parts) {
        let count = literal(place.driven.len());
        let list: Vec<String> = place.driven.iter().map(|&at| format!("`{}`", place.inputs[at])).collect();
        let docs =
            vec![format!("The value, the rate and the acceleration that are prescribed of {}.", list.join(", "))];
        let code = parts.map(|(kernels, scene)| {
            let laws = scene.drives.values();
            let nodes = laws.flat_map(|Prescribed { value, rate, acceleration }| [*value, *rate, *acceleration]);
            let code = self.on_state(place, kernels, &[Stage::Return(nodes.collect())]);
            let rows = code.results.chunks(3).map(|row| quote!([#(#row),*]));
            let tail = quote!([#(#rows),*]);
            Body::new(code, tail, [])
        });
        let time = argument_of(&place.time, code.as_ref());
        let signature = quote!(#[must_use] pub fn drives(&self, #time: T) -> [[T; 3]; #count]);
        self.function(&docs, signature, code);
    }

    /// Inverse dynamics: `M_d v'' - Q_d`.
    fn drive_forces(&mut self, place: &Setting, parts: Parts) {
        let count = literal(place.driven.len());
        let list: Vec<String> = place.driven.iter().map(|&at| format!("`{}`", place.inputs[at])).collect();
        let mut docs = vec![
            format!(
                "The forces, of angles the torques, that drive {} by inverse dynamics: M v'' - Q,",
                list.join(", ")
            ),
            "at this position and these rates of the inputs.".to_owned(),
        ];
        if !place.scene.contacts.is_empty() {
            docs[1] = "at this position and these rates of the inputs, without frictions and stops.".to_owned();
        }
        docs.extend(lines(ERRORS));
        let code = parts.map(|(kernels, scene)| {
            let free = if scene.mass_matrix.is_some() { place.free.clone() } else { Vec::new() };
            let mut returned = Self::minor(scene, &free, &free);
            returned.extend(Self::right_sides(place, kernels, scene, &free));
            returned.extend(Self::minor(scene, &place.driven, &free));
            let sides = Self::right_sides(place, kernels, scene, &place.driven);
            returned.extend(sides.into_iter().map(|side| kernels.derivation.graph.negate(side)));
            let mut code = self.on_motion(place, kernels, scene, returned);
            let results = std::mem::take(&mut code.results);
            let (entries, rest) = results.split_at(free.len().pow(2));
            let (sides, rest) = rest.split_at(free.len());
            let (coupling, forces) = rest.split_at(free.len() * place.driven.len());
            let (solve, names) = if free.is_empty() {
                (TokenStream::new(), Vec::new())
            } else {
                Self::solve_free(place, &mut code, entries, sides)
            };
            let forces = forces.iter().enumerate().map(|(row, force)| {
                let row = coupling.iter().skip(row * free.len()).zip(&names);
                let terms = row.map(|(entry, acceleration)| quote!(+ (#entry) * #acceleration));
                let formula = quote!(#force #(#terms)*);
                if names.is_empty() { force.clone() } else { Operand::Formula(formula.into()) }
            });
            code.operations.multiplications += coupling.len();
            code.operations.additions += coupling.len();
            let forces: Vec<Operand> = forces.collect();
            let wishes: Vec<String> = place.driven.iter().map(|&at| format!("{}_drive", place.inputs[at])).collect();
            let (bindings, forces) = bind(&forces, &wishes, &mut code.taken);
            let verdict = self.blamed(place, &mut code, "the driving force", &forces);
            self.with_rates(Body::new(code, quote!(#solve #bindings #verdict Ok([#(#forces),*])), []))
        });
        let arguments = self.state_arguments(place, code.as_ref());
        let signature = quote!(pub fn drive_forces(#arguments) -> Result<[T; #count], Error>);
        self.function(&docs, signature, code);
    }

    fn energy(&mut self, place: &Setting, parts: Parts) {
        let code = parts.map(|(kernels, scene)| {
            let mut code = self.on_motion(place, kernels, scene, vec![scene.kinetic, scene.potential]);
            let wishes = ["kinetic", "potential"].map(str::to_owned);
            let (bindings, values) = bind(&code.results, &wishes, &mut code.taken);
            let verdict = check_finite(&mut code, "the energy", &values);
            let members = ["kinetic", "potential"]
                .into_iter()
                .zip(&values)
                .map(|(name, value)| super::member(&ident(name), value));
            self.with_rates(Body::new(code, quote!(#bindings #verdict Ok(Energy { #(#members),* })), ["Energy"]))
        });
        let mut docs = lines(["The kinetic energy, and the potential energy of gravity, springs and potentials."]);
        docs.extend(lines(["", "# Errors", "`Singular` where J has no inverse, `NotFinite` if it is not finite."]));
        let (coordinates, inputs) = (&self.types.coordinates, &self.types.inputs);
        let [q, rate] = [&self.arguments.q, &self.arguments.rate].map(|argument| argument_of(argument, code.as_ref()));
        let signature = quote!(pub fn energy(&self, #q: &#coordinates<T>, #rate: impl Into<#inputs<T>>) -> Result<Energy<T>, Error>);
        self.uses.insert("Energy");
        self.function(&docs, signature, code);
    }

    fn power(&mut self, place: &Setting, parts: Parts) {
        let (time, q, rate) = (place.time.clone(), self.arguments.q.clone(), self.arguments.rate.clone());
        let code = parts.map(|(kernels, scene)| {
            let mut returned = vec![scene.applied, scene.dissipated];
            let inputs = kernels.derivation.inputs.clone();
            let known = if scene.contacts.is_empty() { place.driven.as_slice() } else { &[] };
            let rates: Vec<usize> = known.iter().map(|&at| inputs[at]).collect();
            let rates = kernels.rates(&rates);
            returned.extend(kernels.variables(&rates));
            let mut code = self.on_motion(place, kernels, scene, returned);
            let results = std::mem::take(&mut code.results);
            let (values, speeds) = results.split_at(2);
            let drives = (!speeds.is_empty()).then(|| {
                let names: Vec<Ident> = speeds
                    .iter()
                    .map(|speed| ident(&code.taken.unique(&format!("{}_drive", quote!(#speed)))))
                    .collect();
                (quote!(let [#(#names),*] = self.drive_forces(#time, #q, #rate)?;), names)
            });
            let (calls, names) = drives.unwrap_or_default();
            if !names.is_empty() {
                code.arguments.extend([time.clone(), q.clone(), rate.clone()]);
                let inner = self.kernels.iter().find(|(name, _)| name == "drive_forces");
                code.operations = inner.map_or(code.operations, |(_, inner)| code.operations.plus(*inner));
            }
            let driven = names.iter().zip(speeds).map(|(force, speed)| quote!(#force * #speed));
            let applied = match (&values[0], names.is_empty()) {
                (value, true) => value.clone(),
                (Operand::Constant(_), false) => Operand::Formula(quote!(#(#driven)+*).into()),
                (value, false) => Operand::Formula(quote!(#value #(+ #driven)*).into()),
            };
            let wishes = ["applied", "dissipated"].map(str::to_owned);
            let (bindings, values) = bind(&[applied, values[1].clone()], &wishes, &mut code.taken);
            let verdict = self.blamed(place, &mut code, "the power", &values);
            let members = ["applied", "dissipated"]
                .into_iter()
                .zip(&values)
                .map(|(name, value)| super::member(&ident(name), value));
            self.with_rates(Body::new(code, quote!(#calls #bindings #verdict Ok(Power { #(#members),* })), ["Power"]))
        });
        let mut docs = match (place.scene.contacts.is_empty(), place.driven.is_empty()) {
            (true, _) => lines([
                "The power of forces, torques and drives, and that of dampers: the energy changes by their difference.",
            ]),
            (false, true) => lines([
                "The power of forces and torques, and that of dampers and frictions, which take limit |s'|: between",
                "impacts the energy changes by their difference.",
            ]),
            (false, false) => lines([
                "The power of forces and torques, and that of dampers and frictions, which take limit |s'|. That of the",
                "drives depends on what sticks, and is not among them.",
            ]),
        };
        docs.extend(lines(ERRORS));
        let arguments = self.state_arguments(place, code.as_ref());
        let signature = quote!(pub fn power(#arguments) -> Result<Power<T>, Error>);
        self.uses.insert("Power");
        self.function(&docs, signature, code);
    }

    fn reactions(&mut self, place: &Setting, parts: Parts) {
        let (time, q, rate) = (place.time.clone(), self.arguments.q.clone(), self.arguments.rate.clone());
        let acceleration = self.arguments.acceleration.clone();
        let code = parts.map(|(kernels, scene)| {
            let Some(reactions) = &scene.reactions else { return Body::plain(TokenStream::new(), [], []) };
            let mut stages = kernels.derivation.transposed_solution(reactions);
            stages.push(Stage::Return(kernels.variables(&reactions.names)));
            let stages = kernels.with_determinants(stages);
            let sources = vec![
                self.coordinates(kernels, &q, |c| c.value),
                Source { from: Tokens::name(&rate), ..self.coordinates(kernels, &rate, |c| c.rate) },
                Source {
                    from: Tokens::name(&acceleration),
                    ..self.coordinates(kernels, &acceleration, |c| c.acceleration)
                },
            ];
            let mut code = self.on(place, kernels, sources, &stages);
            let lambda = code.results.clone();
            let verdict = check_finite(&mut code, "the reactions", &lambda);
            // The kernel takes the whole of q' and q'', which other kernels give.
            let inner = &place.field;
            let pose = ident(&code.taken.unique(&self.arguments.pose.to_string()));
            let [takes_rate, takes_acceleration] = [&rate, &acceleration].map(|name| code.arguments.contains(name));
            let motion = match (takes_rate, takes_acceleration) {
                (false, false) => TokenStream::new(),
                (_, true) => quote! {
                    let (#rate, #acceleration) = self.rates(#time, #q, #rate)?;
                    let #pose = self.#inner.pose_at(#q);
                    let #acceleration = self.#inner.acceleration(&#pose, &#rate, #acceleration)?;
                },
                (true, false) => quote! {
                    let #pose = self.#inner.pose_at(#q);
                    let #rate = self.#inner.velocity(&#pose, #rate)?;
                },
            };
            if takes_acceleration {
                code.arguments.extend([time.clone(), q.clone(), rate.clone()]);
            } else if takes_rate {
                code.arguments.push(q.clone());
            }
            let body = Body::new(code, quote!(#verdict Ok(SVector::from([#(#lambda),*]))), []);
            Body {
                tokens: {
                    let tokens = &body.tokens;
                    quote!(#motion #tokens).into()
                },
                ..body
            }
        });
        let nu = literal(self.driver.unknowns.len());
        let mut docs = lines([
            "The reactions lambda of the closures in the motion that the scene gives, two for each `loop` and one for",
            "each `equation`: `M q'' + Psi_q' lambda = F`. A loop is cut where its two sides meet, and lambda is the force",
            "with which the left side pulls there at the right side.",
        ]);
        docs.extend(lines(ERRORS));
        let arguments = self.state_arguments(place, code.as_ref());
        let signature = quote!(pub fn reactions(#arguments) -> Result<SVector<T, #nu>, Error>);
        self.function(&docs, signature, code);
    }

    /// The forces at rest with their derivatives, and where they vanish.
    fn equilibrium(&mut self, place: &Setting, parts: Parts) {
        let (time, q) = (place.time.clone(), self.arguments.q.clone());
        let (coordinates, count) = (self.types.coordinates.clone(), literal(place.free.len()));
        let code = parts.map(|(kernels, scene)| {
            let Some(equilibrium) = &scene.equilibrium else { return Body::plain(TokenStream::new(), [], []) };
            let (free, many) = (&place.free, place.free.len());
            let mut returned: Vec<NodeId> = free.iter().map(|&at| equilibrium.forces[at]).collect();
            returned.extend(free.iter().map(|&at| equilibrium.sizes[at]));
            returned
                .extend(free.iter().flat_map(|&column| free.iter().map(move |&row| equilibrium.slopes[row][column])));
            let mut stages = kernels.derivation.solution(&equilibrium.systems, Form::Entries);
            stages.push(Stage::Return(returned));
            let stages = needed(&kernels.derivation.graph, kernels.with_determinants(stages));
            let code = self.on_state(place, kernels, &stages);
            let (forces, rest) = code.results.split_at(many);
            let (sizes, slopes) = rest.split_at(many);
            let columns = slopes.chunks(many).map(|column| quote!([#(#column),*]));
            let balance = quote!(forces: [#(#forces),*], sizes: [#(#sizes),*], slopes: [#(#columns),*]);
            Body::new(code, quote!(Ok(Balance { #balance })), [])
        });
        let docs = lines([
            "The forces of the free inputs at rest, the sums of the magnitudes of their parts, and their derivatives by these",
            "inputs along the closures, column by column: an equilibrium of one input is stable where its slope is negative.",
            "",
            "# Errors",
            "`Singular` where J has no inverse.",
        ]);
        let [own_time, own] = [&time, &q].map(|argument| argument_of(argument, code.as_ref()));
        let signature = quote!(pub fn balance(&self, #own_time: T, #own: &#coordinates<T>)
            -> Result<Balance<T, #count>, Error>);
        self.function(&docs, signature, code);
        let names: Vec<&Ident> = place.free.iter().map(|&at| &place.inputs[at]).collect();
        let inner = &place.field;
        let driven: Vec<&Ident> = place.driven.iter().map(|&at| &place.inputs[at]).collect();
        let drives = (!driven.is_empty()).then(|| {
            let laws = driven.iter().map(|input| quote!([#input, ..]));
            quote!(let [#(#laws),*] = self.drives(#time);)
        });
        let guess = &self.arguments.guess;
        let tokens = quote! {
            #drives
            equilibrium(Self::NAME, [#(#guess.#names),*], |[#(#names),*]| {
                let #q = newton(&self.#inner, &#coordinates { #(#names,)* #(#driven,)* ..*#guess })?;
                if !#q.same_branch {
                    return Err(Error::OtherBranch { mechanism: Self::NAME, group: "a loop" });
                }
                Ok((#q.coordinates, self.balance(#time, &#q.coordinates)?))
            })
        };
        let docs = lines([
            "The position near the guess where the forces of the free inputs vanish at rest, by Newton's method; it may be",
            "stable or not.",
            "",
            "# Errors",
            "`NotConverged` if there is none to be found, `OtherBranch` if the guess belongs to no position of its branch,",
            "`NotFinite` if a number is not finite.",
        ]);
        let body = Body::plain(tokens, [&time, guess], ["Balance", "equilibrium", "newton"]);
        let signature =
            quote!(pub fn equilibrium(&self, #time: T, #guess: &#coordinates<T>) -> Result<#coordinates<T>, Error>);
        self.function(&docs, signature, Some(body));
    }

    fn check(&mut self, place: &Setting, parts: Parts) {
        let code = parts.map(|(kernels, scene)| {
            let mut nodes: Vec<NodeId> = scene.masses.iter().map(|(_, node)| *node).collect();
            let mut stops = Vec::new();
            for contact in &scene.contacts {
                if let ContactFormula::Stop { range, restitution } = contact.law {
                    stops.push(string(&contact.label));
                    nodes.extend(range);
                    nodes.push(restitution);
                }
            }
            let code = self.on_state(place, kernels, &[Stage::Return(nodes)]);
            let (masses, ends) = code.results.split_at(scene.masses.len());
            let pairs = scene.masses.iter().zip(masses).map(|((label, _), value)| {
                let label = string(label);
                quote!((#label, #value))
            });
            let masses = quote!(not_negative::<T, _>(Self::NAME, [#(#pairs),*]));
            if stops.is_empty() {
                return Body::new(code, masses, ["not_negative"]);
            }
            let ends = stops.iter().zip(ends.chunks(3)).map(|(label, values)| quote!((#label, #(#values),*)));
            let tail = quote!(#masses?; stops(Self::NAME, [#(#ends),*]));
            Body::new(code, tail, ["not_negative", "stops"])
        });
        let docs = if place.scene.contacts.is_empty() {
            lines([
                "Refuses parameters that no body has.",
                "",
                "# Errors",
                "`Negative` if a mass or an inertia is negative, `NotFinite` if it is not finite, with its name.",
            ])
        } else {
            lines([
                "Refuses parameters that no body, no friction and no stop has.",
                "",
                "# Errors",
                "With its name: `Negative` if a mass, an inertia or a friction is negative, `NoRange` if nothing is left between",
                "stops, `Restitution` if one is not between 0 and 1, `NotFinite` if a number is not finite.",
            ])
        };
        self.function(&docs, quote!(pub fn check(&self) -> Result<(), Error>), code);
    }

    /// Which body or effect has no finite value.
    fn blame(&mut self, place: &Setting, parts: Parts) {
        let (coordinates, inputs) = (self.types.coordinates.clone(), self.types.inputs.clone());
        let code = parts.map(|(kernels, scene)| {
            let mut labels = Vec::new();
            let mut nodes = Vec::new();
            for (label, parts) in &scene.parts {
                let label = string(label);
                for &part in parts.iter().filter(|&&part| kernels.derivation.graph.constant_value(part).is_none()) {
                    labels.push(label.clone());
                    nodes.push(part);
                }
            }
            let mut code = self.on_motion(place, kernels, scene, nodes);
            // It is not called where all is well.
            code.operations = Operations::default();
            let results = &code.results;
            let tail = quote!(finite_each::<T, _>(Self::NAME, [#((#labels, #results)),*]));
            Body::new(code, tail, ["finite_each"])
        });
        let [time, q, rate] =
            [&place.time, &self.arguments.q, &self.arguments.rate].map(|argument| argument_of(argument, code.as_ref()));
        let signature =
            quote!(#[cold] fn blame(&self, #time: T, #q: &#coordinates<T>, #rate: #inputs<T>) -> Result<(), Error>);
        let docs = lines(["Refuses the body or the effect that has no finite value, by its name."]);
        self.function(&docs, signature, code);
    }

    fn scene_block(&self, place: &Setting, private: &TokenStream) -> TokenStream {
        let Types { driver: scene, inputs, coordinates, .. } = self.types;
        let (of, inner, text) = (&self.driver.name, &place.field, scene.to_string());
        let (u, v) = (self.driver.unknowns.len(), self.driver.inputs.len());
        let (nu, nv, n) = (literal(u), literal(v), literal(u + 2 * v));
        let functions = &self.functions;
        let mut imports: Vec<&str> = self.uses.iter().copied().chain(["Error", "Real", "SVector"]).collect();
        let has_inertia = place.scene.inertia.is_some();
        if has_inertia {
            imports.extend(["Contact", "Equations", "SMatrix", "Scene", "Unreduced"]);
        }
        imports.sort_unstable();
        imports.dedup();
        let imports = imports.into_iter().map(ident);
        let refuses = place.blames.get() || place.scene.wishes.contains(&Wish::Equilibrium);
        let refusal = refuses.then(|| quote!(Err,));
        let fields = self.coordinate_fields();
        let names = &place.inputs;
        let rates: Vec<Ident> = names.iter().map(|name| ident(&format!("{name}_rate"))).collect();
        let texts = place.scene_inputs(self.mechanism, self.driver);
        let laws: Vec<Ident> = place.driven.iter().map(|&at| ident(&format!("{}_law", names[at]))).collect();
        let mut of_driven = laws.iter();
        let prescribed = (0..v).map(|at| {
            let law = if place.driven.contains(&at) { of_driven.next() } else { None };
            law.map_or_else(|| quote!(::core::option::Option::None), |law| quote!(::core::option::Option::Some(#law)))
        });
        let prescribed: Vec<TokenStream> = prescribed.collect();
        let (time, drives) = if laws.is_empty() {
            (quote!(_t), TokenStream::new())
        } else {
            (quote!(t), quote!(let [#(#laws),*] = self.drives(t);))
        };
        let count = literal(place.scene.contacts.len());
        let equations = if place.scene.contacts.is_empty() {
            quote! {
                fn equations(&self, t: T, state: &SVector<T, #n>) -> Result<Equations<T, #nu, #nv>, Error> {
                    let (q, rates) = Self::parts(state);
                    let (mass, forces) = (self.mass_matrix(&q)?, self.forces(t, &q, rates)?);
                    Equations::at(&self.#inner, &q, &rates.into(), mass, forces)
                }
                fn contacts(
                    &self,
                    _t: T,
                    _q: &#coordinates<T>,
                    _velocity: &#coordinates<T>,
                ) -> Result<[Contact<T, #nu, #nv>; #count], Error> {
                    Ok([])
                }
            }
        } else {
            quote! {
                fn equations(&self, t: T, state: &SVector<T, #n>) -> Result<Equations<T, #nu, #nv>, Error> {
                    let (q, rates) = Self::parts(state);
                    self.equations(t, &q, rates)
                }
                fn contacts(
                    &self,
                    t: T,
                    q: &#coordinates<T>,
                    velocity: &#coordinates<T>,
                ) -> Result<[Contact<T, #nu, #nv>; #count], Error> {
                    self.contacts(t, q, velocity)
                }
            }
        };
        let implementation = has_inertia.then(|| {
            quote! {
                impl<T: Real> Scene<T, #nu, #nv, #n, #count> for #scene<T> {
                    const NAME: &'static str = #text;
                    type Mechanism = #of<T>;
                    fn mechanism(&self) -> &Self::Mechanism {
                        &self.#inner
                    }
                    fn state(q: &#coordinates<T>, rates: &#inputs<T>) -> SVector<T, #n> {
                        SVector::from([#(q.#fields,)* #(rates.#names),*])
                    }
                    fn parts(state: &SVector<T, #n>) -> (#coordinates<T>, #inputs<T>) {
                        let [[#(#fields,)* #(#rates),*]] = state.data.0;
                        (#coordinates { #(#fields),* }, #inputs { #(#names: #rates),* })
                    }
                    fn check(&self) -> Result<(), Error> {
                        self.check()
                    }
                    fn derivative(&self, t: T, state: &SVector<T, #n>) -> Result<SVector<T, #n>, Error> {
                        let (q, rates) = Self::parts(state);
                        let (velocity, acceleration) = self.rates(t, &q, rates)?;
                        Ok(Self::state(&velocity, &acceleration))
                    }
                    #equations
                    fn unreduced(
                        &self,
                        t: T,
                        q: &#coordinates<T>,
                        rate: &#coordinates<T>,
                    ) -> Result<Unreduced<T, #nu, #nv>, Error> {
                        self.unreduced(t, q, rate)
                    }
                    fn prescribed(&self, #time: T) -> [::core::option::Option<[T; 3]>; #nv] {
                        #drives
                        [#(#prescribed),*]
                    }
                    fn inputs(state: &SVector<T, #n>) -> [(&'static str, T, T); #nv] {
                        let (q, rates) = Self::parts(state);
                        [#((#texts, q.#names, rates.#names)),*]
                    }
                }
            }
        });
        quote! {
            const _: () = {
                use ::core::convert::{From, Into};
                use ::core::result::Result::{self, #refusal Ok};
                use #private::{#(#imports),*};
                impl<T: Real> #scene<T> {
                    /// The name of the scene, as errors give it.
                    pub const NAME: &'static str = #text;
                    #functions
                }
                #implementation
            };
        }
    }
}

impl Setting<'_> {
    /// The inputs as they were written.
    fn scene_inputs<'a>(&self, mechanism: &'a Mechanism, driver: &Driver) -> Vec<&'a str> {
        driver.inputs.iter().map(|&index| mechanism.coordinates[index].name.text.as_str()).collect()
    }
}
