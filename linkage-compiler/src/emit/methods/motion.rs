//! Everything at once, in one kernel.

use proc_macro2::{Ident, TokenStream};
use quote::quote;

use super::super::kernel::{Given, Operand};
use super::super::types::field;
use super::super::{Types, kernel};
use super::{Arguments, Body, Kernels, Methods, argument_of, bind, check_finite, component_names, lines};
use crate::derivation::{Form, Quantity};
use crate::simplify::schedule::Stage;

impl Methods<'_> {
    pub(super) fn motion(&mut self, kernels: Option<&mut Kernels>) {
        let Types { coordinates, inputs, motion, points, outputs, .. } = self.types;
        let Arguments { q, rate, acceleration, .. } = &self.arguments;
        let code = kernels.map(|kernels| {
            let unknowns = kernels.derivation.unknowns.clone();
            let all: Vec<usize> = (0..kernels.derivation.coordinates.len()).collect();
            let sides = [
                (kernels.derivation.velocity_side(), kernels.rates(&unknowns)),
                (kernels.derivation.acceleration_side(), kernels.accelerations(&unknowns)),
            ];
            let mut stages = kernels.derivation.solution(&sides, Form::Entries);
            stages = kernels.with_determinants(stages);
            let mut nodes = kernels.variables(&kernels.rates(&all));
            nodes.extend(kernels.variables(&kernels.accelerations(&all)));
            let quantities: Vec<Quantity> = kernels.derivation.points.iter().chain(&kernels.derivation.outputs).cloned().collect();
            for quantity in &quantities {
                nodes.extend(quantity.value.iter().chain(&quantity.rate).chain(&quantity.acceleration));
            }
            stages.push(Stage::Return(nodes));
            let sources = vec![
                self.parameters(),
                self.coordinates(kernels, q, |c| c.value),
                self.inputs(kernels, rate, |c| c.rate),
                self.inputs(kernels, acceleration, |c| c.acceleration),
            ];
            let given = Given { sources, pose: None, branch: &self.arguments.branch };
            let mut code = kernel::write(kernels.derivation, &given, &stages, &self.named, &self.reserved);
            let fields = self.coordinate_fields();
            let count = fields.len();
            let results = std::mem::take(&mut code.results);
            let (rates, rest) = results.split_at(count);
            let (accelerations, rest) = rest.split_at(count);
            let (point_parts, output_parts) = rest.split_at(6 * self.mechanism.points.len());
            let names: Vec<Ident> = self.mechanism.points.iter().map(|p| field(&p.name)).collect();
            let (mut bindings, mut checked) = (TokenStream::new(), Vec::new());
            let mut members = TokenStream::new();
            if !names.is_empty() {
                let wishes = component_names(&names, 2, &["", "_rate", "_acceleration"]);
                let (tokens, parts) = bind(point_parts, &wishes, &mut code.taken);
                bindings.extend(tokens);
                let values = parts.chunks(6).map(|p| {
                    let [x, y, u, v, a, b] = [0, 1, 2, 3, 4, 5].map(|index| &p[index]);
                    quote!(PointMotion { position: Vector2::new(#x, #y), velocity: Vector2::new(#u, #v), acceleration: Vector2::new(#a, #b) })
                });
                members.extend(quote!(points: #points { #(#names: #values),* },));
                code.uses.insert("PointMotion");
                checked.extend(parts.iter().cloned());
            }
            let names: Vec<Ident> = self.mechanism.outputs.iter().map(|o| field(&o.name)).collect();
            if !names.is_empty() {
                let wishes = component_names(&names, 1, &["", "_rate", "_acceleration"]);
                let (tokens, parts) = bind(output_parts, &wishes, &mut code.taken);
                bindings.extend(tokens);
                let values = parts.chunks(3).map(|p| {
                    let [value, rate, acceleration] = [0, 1, 2].map(|index| &p[index]);
                    quote!(OutputMotion { value: #value, velocity: #rate, acceleration: #acceleration })
                });
                members.extend(quote!(outputs: #outputs { #(#names: #values),* },));
                code.uses.insert("OutputMotion");
                checked.extend(parts.iter().cloned());
            }
            let mut finite: Vec<Operand> = unknowns.iter().flat_map(|&index| [rates[index].clone(), accelerations[index].clone()]).collect();
            finite.extend(checked);
            let verdict = check_finite(&mut code, "motion", &finite);
            code.arguments.push(q.clone());
            Body::new(
                code,
                quote! {
                    #bindings
                    #verdict
                    Ok(#motion {
                        position: *#q,
                        velocity: #coordinates { #(#fields: #rates),* },
                        acceleration: #coordinates { #(#fields: #accelerations),* },
                        #members
                    })
                },
                [],
            )
        });
        let docs = lines([
            "Everything at once at coordinates that close the mechanism: velocity, acceleration, points and outputs,",
            "every shared subexpression computed once.",
            "",
            "# Errors",
            "`Singular` where J has no inverse, `NotFinite` where a formula has no finite value.",
        ]);
        let [q, rate, acceleration] = [q, rate, acceleration].map(|argument| argument_of(argument, code.as_ref()));
        let signature = quote!(pub fn motion(&self, #q: &#coordinates<T>, #rate: impl Into<#inputs<T>>, #acceleration: impl Into<#inputs<T>>) -> Result<#motion<T>, Error>);
        self.function(&docs, &signature, code);
    }
}
