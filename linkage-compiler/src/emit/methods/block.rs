//! The `impl` blocks that hold the functions.

use std::collections::{BTreeMap, BTreeSet};

use proc_macro2::{Delimiter, Group, Ident, TokenStream};
use quote::quote;

use super::super::Types;
use super::super::names::{ident, string};
use super::super::pose::PosePlan;
use super::super::tokens::Tokens;
use super::super::types::field;
use super::{Kernels, Methods, literal};
use crate::derivation::{Block, Derivation};
use crate::graph::SymbolId;
use crate::model::{Kind, Mechanism};

impl Methods<'_> {
    /// The `impl` blocks, in a scope of their own for the names that they use.
    pub(super) fn block(&mut self, kernels: Option<&Kernels>, private: &TokenStream) -> TokenStream {
        let driver = &self.types.driver;
        let text = string(&driver.to_string());
        let mut members = Tokens::from(quote! {
            /// The name of the mechanism, as errors give it.
            pub const NAME: &'static str = #text;
        });
        members.join(std::mem::take(&mut self.functions));
        let members = Group::new(Delimiter::Brace, members.into());
        let iterator = self.uses.contains("existing").then(|| {
            quote!(
                use ::core::iter::Iterator;
            )
        });
        let imports = imports(self.mechanism, &self.uses);
        let mechanism = self.for_general_algorithms(kernels, private);
        let of_pose = match kernels {
            Some(kernels) => self.of_pose(kernels.derivation, kernels.plan),
            None => self.of_pose_stub(),
        };
        quote! {
            const _: () = {
                use ::core::convert::{From, Into};
                #iterator
                use ::core::result::Result::{self, Ok};
                use #private::{#(#imports),*};
                impl<T: Real> #driver<T> #members
                #of_pose
                #mechanism
            };
        }
    }

    /// The mechanism for general algorithms, with its position in closed form if it has one.
    fn for_general_algorithms(&self, kernels: Option<&Kernels>, private: &TokenStream) -> TokenStream {
        let Types { driver, inputs, unknowns, pose, coordinates, branch, .. } = self.types;
        let members = |places: &[usize]| {
            let mut members = Tokens::default();
            for &place in places {
                let coordinate = &self.mechanism.coordinates[place];
                members.ident(&field(&coordinate.name));
                members.append(string(&coordinate.name.text));
                members.word(if coordinate.kind == Kind::Angle { "true" } else { "false" });
            }
            TokenStream::from(members)
        };
        let (of_unknowns, of_inputs) = (members(&self.driver.unknowns), members(&self.driver.inputs));
        let (u, v) = (literal(self.driver.unknowns.len()), literal(self.driver.inputs.len()));
        let groups = kernels.map(|kernels| groups(kernels.derivation)).unwrap_or_default();
        let count = literal(groups.len());
        let is_turned = self.branches.as_ref().is_some_and(|branches| !branches.turns.is_empty());
        let near = is_turned.then(|| ident("assemble_near"));
        let branch = self.is_assembled.then(|| quote!(, branch #branch #near));
        quote! {
            #private::__mechanism! {
                #driver #coordinates #pose,
                unknowns #unknowns [#of_unknowns] #u,
                inputs #inputs [#of_inputs] #v,
                groups [#(#groups)*] #count
                #branch
            }
        }
    }

    /// Angles on request: the coordinates of a pose.
    fn of_pose(&self, derivation: &Derivation, plan: &PosePlan) -> TokenStream {
        let Types { pose, coordinates, .. } = self.types;
        let fields = self.coordinate_fields();
        let angles: BTreeMap<SymbolId, &String> = plan
            .directions
            .iter()
            .filter_map(|(angle, field)| Some((derivation.graph.as_symbol(*angle)?, field)))
            .collect();
        let bare: BTreeMap<usize, &String> = plan.values.iter().map(|(index, field, _)| (*index, field)).collect();
        let values = derivation.coordinates.iter().enumerate().map(|(index, coordinate)| {
            if let Some(field) = bare.get(&index) {
                let field = ident(field);
                return quote!(self.#field);
            }
            let field = ident(angles.get(&coordinate.value).map_or("", |field| field.as_str()));
            quote!(self.#field.angle())
        });
        let values: Vec<_> = values.collect();
        let directions = plan.directions.values().map(|field| ident(field));
        let parts: Vec<_> = directions.flat_map(|field| [quote!(self.#field.re), quote!(self.#field.im)]).collect();
        let numbers = plan.values.iter().map(|(_, field, _)| field);
        let numbers = numbers.chain(plan.determinants.iter().map(|(_, field, _)| field));
        let numbers = numbers.chain(plan.externals.iter().map(|(_, field, _)| field)).map(|field| ident(field));
        quote! {
            impl<T: Real> #pose<T> {
                #[doc = " Whether every number of this position is finite."]
                #[must_use]
                pub fn is_finite(&self) -> bool {
                    [#(#parts,)* #(self.#numbers),*].iter().all(T::is_finite)
                }
                #[doc = " The coordinates of this position; an angle that is held as its direction alone comes out"]
                #[doc = " between -pi and pi, at the price of an arc tangent. Nothing is refused: results of numbers"]
                #[doc = " that are not finite are not finite either, or mean nothing."]
                #[must_use]
                pub fn coordinates(&self) -> #coordinates<T> {
                    #coordinates { #(#fields: #values),* }
                }
            }
        }
    }
}

impl Methods<'_> {
    fn of_pose_stub(&self) -> TokenStream {
        let Types { pose, coordinates, .. } = self.types;
        quote! {
            impl<T: Real> #pose<T> {
                pub fn is_finite(&self) -> bool {
                    ::core::unreachable!()
                }
                pub fn coordinates(&self) -> #coordinates<T> {
                    ::core::unreachable!()
                }
            }
        }
    }
}

/// The groups: the name of each, its equations and its unknowns.
fn groups(derivation: &Derivation) -> Vec<TokenStream> {
    let group = |block: &Block| {
        let name = string(&block.names(derivation));
        let [equations, unknowns] = [&block.equations, &block.unknowns].map(|places| {
            let places = places.iter().map(|&place| literal(place));
            quote!([#(#places),*])
        });
        quote!(#name #equations #unknowns)
    };
    derivation.blocks.iter().map(group).collect()
}

/// What the functions use of the runtime, in the order in which rustfmt sorts it.
fn imports(mechanism: &Mechanism, used: &BTreeSet<&'static str>) -> Vec<Ident> {
    let mut types = vec!["Error", "Real", "SMatrix", "SVector", "Solution"];
    if !mechanism.points.is_empty() {
        types.push("Vector2");
    }
    let (others, functions): (Vec<&str>, Vec<&str>) =
        used.iter().partition(|name| name.starts_with(char::is_uppercase));
    types.extend(others);
    types.sort_unstable();
    types.into_iter().chain(functions).map(ident).collect()
}
