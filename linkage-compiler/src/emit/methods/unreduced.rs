//! Mass matrix and forces in all coordinates.

use std::collections::BTreeMap;

use quote::quote;

use super::super::kernel::{Operand, Source};
use super::super::tokens::Tokens;
use super::closures::matrix_of;
use super::scene::{Parts, Setting};
use super::{Body, Methods, argument_of, bind, check_finite, lines, literal};
use crate::lower::Stage;

impl Methods<'_> {
    pub(super) fn unreduced(&mut self, place: &Setting, parts: Parts) {
        let (q, rate, coordinates) =
            (self.arguments.q.clone(), self.arguments.rate.clone(), self.types.coordinates.clone());
        let (u, v) = (self.driver.unknowns.len(), self.driver.inputs.len());
        let code = parts.map(|(kernels, scene)| {
            let Some(unreduced) = &scene.unreduced else { return Body::plain(quote!(), [], []) };
            let mut nodes: Vec<_> = unreduced.mass_matrix.values().copied().collect();
            nodes.extend(&unreduced.forces);
            let sources = vec![
                self.coordinates(kernels, &q, |c| c.value),
                Source { from: Tokens::behind(&rate), ..self.coordinates(kernels, &rate, |c| c.rate) },
            ];
            let mut code = self.on(place, kernels, sources, &[Stage::Return(nodes)]);
            let derivation = &*kernels.derivation;
            let name = |at: usize| derivation.coordinates[at].name.as_str();
            let mut wishes = Vec::new();
            for &(row, column) in unreduced.mass_matrix.keys() {
                let one = (row == column).then(|| format!("{}_inertia", name(row)));
                wishes.push(one.unwrap_or_else(|| format!("{}_{}_inertia", name(row), name(column))));
            }
            wishes.extend((0..unreduced.forces.len()).map(|at| format!("{}_force", name(at))));
            let (bindings, values) = bind(&code.results, &wishes, &mut code.taken);
            let verdict = check_finite(&mut code, "the equations of motion", &values);
            let (entries, forces) = values.split_at(unreduced.mass_matrix.len());
            let entries: BTreeMap<_, _> = unreduced.mass_matrix.keys().copied().zip(entries).collect();
            // Each entry above the diagonal stands below it as well.
            let of_pair =
                |row: usize, column: usize| entries.get(&(row.min(column), row.max(column))).copied().cloned();
            let block = |rows: &[usize], columns: &[usize]| -> Vec<(usize, usize, Operand)> {
                let pairs = rows
                    .iter()
                    .enumerate()
                    .flat_map(|(i, &row)| columns.iter().enumerate().map(move |(j, &column)| ((i, row), (j, column))));
                pairs.filter_map(|((i, row), (j, column))| Some((i, j, of_pair(row, column)?))).collect()
            };
            let (unknowns, inputs) = (&derivation.unknowns, &derivation.inputs);
            let (first, of_unknowns) = matrix_of(block(unknowns, unknowns).into_iter(), u, u, &mut code.taken);
            let (second, mixed) = matrix_of(block(unknowns, inputs).into_iter(), u, v, &mut code.taken);
            let (third, of_inputs) = matrix_of(block(inputs, inputs).into_iter(), v, v, &mut code.taken);
            let [unknown_forces, input_forces] =
                [unknowns, inputs].map(|places| places.iter().map(|&at| &forces[at]).collect::<Vec<_>>());
            let tail = quote! {
                #bindings #verdict #first #second #third
                Ok(Unreduced {
                    unknowns: #of_unknowns,
                    mixed: #mixed,
                    inputs: #of_inputs,
                    unknown_forces: SVector::from([#(#unknown_forces),*]),
                    input_forces: SVector::from([#(#input_forces),*]),
                })
            };
            Body::new(code, tail, ["Unreduced"])
        });
        let docs = lines([
            "The inertia and the forces in all coordinates, at the rates of all coordinates: `M q'' + Psi_q' lambda = F`.",
            "",
            "# Errors",
            "`NotFinite` if an entry is not finite.",
        ]);
        let [time, q, rate] = [&place.time, &q, &rate].map(|argument| argument_of(argument, code.as_ref()));
        let (nu, nv) = (literal(u), literal(v));
        let signature = quote!(pub fn unreduced(&self, #time: T, #q: &#coordinates<T>, #rate: &#coordinates<T>)
            -> Result<Unreduced<T, #nu, #nv>, Error>);
        self.function(&docs, signature, code);
    }
}
