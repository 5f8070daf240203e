//! The forces that hold the closures closed.

use proc_macro2::TokenStream;
use quote::quote;

use super::super::{Body, Methods, check_finite, lines, literal};
use super::{ERRORS, Parts, Setting};
use crate::emit::kernel::Source;
use crate::emit::names::ident;
use crate::emit::tokens::Tokens;
use crate::lower::Stage;

impl Methods<'_> {
    pub(super) fn reactions(&mut self, place: &Setting, parts: Parts) {
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
}
