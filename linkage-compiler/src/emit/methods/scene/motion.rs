//! M, Q and the accelerations of a scene.

use proc_macro2::{Ident, TokenStream};
use quote::quote;

use super::super::{Body, Kernels, Methods, argument_of, bind, check_finite, columns_of, fenced, lines, literal};
use super::{ERRORS, Parts, Setting};
use crate::derivation::Scene;
use crate::emit::kernel::{Code, Operand};
use crate::emit::names::ident;
use crate::graph::{NodeId, Number};

impl Methods<'_> {
    pub(super) fn mass_matrix(&mut self, place: &Setting, parts: Parts) {
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

    pub(super) fn entries(&self, name: &str, columns: usize, nodes: &[NodeId], kernels: &Kernels) -> Vec<String> {
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
    pub(in crate::emit::methods) fn pair_names(&self, place: &Setting, what: &str) -> Vec<String> {
        let names = &place.inputs;
        let pair = |a: &Ident, b: &Ident| if a == b { format!("{a}_{what}") } else { format!("{a}_{b}_{what}") };
        names.iter().flat_map(|a| names.iter().map(move |b| pair(a, b))).collect()
    }

    pub(super) fn forces(&mut self, place: &Setting, parts: Parts) {
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
    pub(super) fn minor(scene: &Scene, rows: &[usize], columns: &[usize]) -> Vec<NodeId> {
        let matrix = scene.mass_matrix.as_deref().unwrap_or_default();
        rows.iter().flat_map(|&row| columns.iter().map(move |&column| matrix[row][column])).collect()
    }

    /// `Q - M_d a_d` of some inputs, with the accelerations of the driven ones.
    pub(super) fn right_sides(place: &Setting, kernels: &mut Kernels, scene: &Scene, rows: &[usize]) -> Vec<NodeId> {
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
    pub(super) fn solve_free(
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
    pub(super) fn rates(&mut self, place: &Setting, parts: Parts) {
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
            let checked = [accelerations.clone(), kernels.checked(rates)].concat();
            let verdict = self.blamed(place, &mut code, "the acceleration", &checked);
            let (fields, names) = (self.coordinate_fields(), &place.inputs);
            let members = fields.iter().zip(rates).map(|(field, rate)| super::super::member(field, rate));
            let values = names.iter().zip(&accelerations).map(|(name, value)| super::super::member(name, value));
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
}
