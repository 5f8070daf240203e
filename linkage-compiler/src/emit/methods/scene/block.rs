//! The block of a scene: its functions and its trait.

use proc_macro2::{Ident, TokenStream};
use quote::quote;

use super::super::{Methods, literal};
use super::Setting;
use crate::emit::Types;
use crate::emit::names::ident;
use crate::model::{Driver, Mechanism, Wish};

impl Methods<'_> {
    pub(super) fn scene_block(&self, place: &Setting, private: &TokenStream) -> TokenStream {
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
