//! Calls whose results are texts.

use linkage_compiler::program::Code;
use linkage_compiler::program::{Access, Function, Implemented, SceneProgram, Type};
use proc_macro2::TokenStream;
use quote::quote;

use crate::ident;
use crate::values::Values;

impl Values<'_, '_> {
    /// Entries of a list: the driver with its public functions, and each of its scenes.
    pub fn calls(&self) -> Vec<TokenStream> {
        let own = self.own();
        let design = quote!(let m = #own::design(n); let of = &m;);
        let functions = self.program.functions.iter().filter(|function| function.access.is_public());
        let functions = functions.map(|function| self.call(function, &design));
        let implementations = self.program.implementations.iter();
        let of_pose = implementations.filter(|one| one.of == Implemented::Itself && one.on == self.pose_name());
        let of_pose = of_pose.flat_map(|one| &one.functions).map(|function| {
            let (name, text) = (ident(&function.name), format!("pose.{}", function.name));
            quote!((#text, |n| { #design format!("{:?}", #own::pose(n, of).#name()) }))
        });
        let count = self.mechanism.parameters.len();
        let (mechanism, name) = (self.mechanism.name.to_string(), self.driver.name.to_string());
        let file = self.file;
        let mut all = vec![quote! {
            Called {
                file: #file, mechanism: #mechanism, name: #name, scene: None, parameters: #count,
                functions: &[#(#functions),*],
                of_pose: &[#(#of_pose),*],
            }
        }];
        all.extend(self.program.scenes.iter().map(|scene| self.calls_of_scene(scene)));
        all
    }

    fn pose_name(&self) -> &str {
        &self.program.signatures.types.pose
    }

    fn calls_of_scene(&self, scene: &SceneProgram<Code>) -> TokenStream {
        let (own, make, field) = (self.own(), Self::scene_function(scene), ident(&scene.signatures.field));
        let design = quote!(let m = #own::#make(n); let of = &m.#field;);
        let functions = scene.functions.iter().filter(|function| function.access.is_public());
        let functions = functions.map(|function| self.call(function, &design));
        let count = self.mechanism.parameters.len() + scene.signatures.parameters.len();
        let signatures = &self.program.signatures;
        let (mechanism, name, scene) = (&signatures.mechanism, &signatures.driver, &scene.signatures.scene);
        let file = self.file;
        quote! {
            Called {
                file: #file, mechanism: #mechanism, name: #name, scene: Some(#scene), parameters: #count,
                functions: &[#(#functions),*],
                of_pose: &[],
            }
        }
    }

    /// The name of a function and its call.
    fn call(&self, function: &Function<Code>, design: &TokenStream) -> TokenStream {
        let (name, text) = (ident(&function.name), &function.name);
        let arguments = function.arguments.iter().map(|argument| self.argument(argument));
        let (values, uses): (Vec<TokenStream>, Vec<TokenStream>) = arguments.unzip();
        let is_iterator = matches!(function.returns, Type::Branches { .. } | Type::Iterator { .. });
        let listed = is_iterator.then(|| quote!(.map(|found| found.collect::<Vec<_>>())));
        let call = match function.is_method {
            true => quote!(m.#name(#(#uses),*)),
            false => {
                let of = self.path(&self.driver.name.to_string());
                quote!(#of::<f64>::#name(#(#uses),*))
            }
        };
        let is_deprecated = function.access == Access::Deprecated;
        let allowed = is_deprecated.then(|| quote!(#[expect(deprecated)]));
        let kept = function.is_fallible.then(|| self.kept(&function.returns));
        quote! {
            (#text, |n| {
                #design
                let _ = of;
                #(#values)*
                #allowed
                let found = #call #listed;
                #kept
                format!("{found:?}")
            })
        }
    }
}
