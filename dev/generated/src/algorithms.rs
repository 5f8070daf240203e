//! Runs of the algorithms for any mechanism and for any scene, which a module `harness` has.

use linkage_compiler::program::Implemented;
use proc_macro2::TokenStream;
use quote::quote;

use crate::values::Values;

impl Values<'_, '_> {
    /// Pairs of a name and a function of a tally and of a source of numbers; the values are those of a module `called`.
    pub fn algorithms(&self) -> Vec<TokenStream> {
        let (own, name) = (self.own(), self.driver.name.to_string());
        let driven = (self.driver.inputs.len() == 1).then(|| quote!(crate::harness::driven(t, s, &m, &mut positions);));
        let title = format!("{}: {name}", self.file);
        let mut all = vec![quote! {
            (#title, |t, s| {
                let (m, mut positions) = (crate::called::#own::design(s), crate::harness::Pool::default());
                crate::harness::mechanism(t, s, &m, &mut positions, crate::called::#own::pose);
                #driven
            })
        }];
        let is_moving = |scene: &&linkage_compiler::program::SceneProgram<_>| {
            scene.implementation.as_ref().is_some_and(|one| one.of == Implemented::Scene)
        };
        all.extend(self.program.scenes.iter().filter(is_moving).map(|scene| {
            let make = Self::scene_function(scene);
            let title = format!("{}: {}", self.file, scene.signatures.scene);
            quote! {
                (#title, |t, s| {
                    let m = crate::called::#own::#make(s);
                    crate::harness::scene(t, s, &m);
                })
            }
        }));
        all
    }
}
