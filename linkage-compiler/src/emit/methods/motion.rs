//! Everything at once, in one kernel.

use proc_macro2::TokenStream;
use quote::quote;

use super::super::kernel::Operand;
use super::super::{Types, kernel};
use super::{Arguments, Body, Kernels, Methods, argument_of, check_finite, in_parts, lines};
use crate::derivation::{Form, Quantity};
use crate::lower::Stage;

impl Methods<'_> {
    pub(super) fn motion(&mut self, kernels: Option<&mut Kernels>) {
        let Types { coordinates, inputs, motion, .. } = self.types;
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
            let values: Vec<_> = kernels.derivation.coordinates.iter().map(|coordinate| coordinate.value).collect();
            nodes.extend(kernels.variables(&values));
            let quantities: Vec<Quantity> =
                kernels.derivation.points.iter().chain(&kernels.derivation.outputs).cloned().collect();
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
            let given = self.given(sources, None);
            let mut code = kernel::write(kernels.derivation, &given, &stages, &self.named, &self.scope);
            let fields = self.coordinate_fields();
            let count = fields.len();
            let mut results = std::mem::take(&mut code.results).into_iter();
            let mut take = |many: usize| results.by_ref().take(many).collect::<Vec<Operand>>();
            let (rates, accelerations, values) = (take(count), take(count), take(count));
            let (point_parts, output_parts) = (take(6 * self.mechanism.points.len()), take(usize::MAX));
            let mut members = TokenStream::new();
            if !point_parts.is_empty() {
                let values = in_parts(point_parts, &[3, 2]);
                members.extend(quote!(points: point_motions(Self::NAME, [#values])?,));
                code.uses.insert("point_motions");
            }
            if !output_parts.is_empty() {
                let values = in_parts(output_parts, &[3]);
                members.extend(quote!(outputs: output_motions(Self::NAME, [#values])?,));
                code.uses.insert("output_motions");
            }
            // No rate need be other than finite where a coordinate is.
            let checked = [kernels.checked(&rates), kernels.checked(&accelerations), values].concat();
            let verdict = check_finite(&mut code, "motion", &checked);
            code.arguments.push(q.clone());
            Body::new(
                code,
                quote! {
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
        let signature = self.words.fallible(
            "motion",
            [
                self.words.borrowed(&q, coordinates),
                self.words.converted(&rate, inputs),
                self.words.converted(&acceleration, inputs),
            ],
            self.words.of(motion),
        );
        self.function(&docs, signature, code);
    }
}
