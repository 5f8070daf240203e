//! The `impl` blocks that hold the functions.

use std::collections::BTreeMap;

use proc_macro2::{Ident, TokenStream};
use quote::quote;

use super::super::Types;
use super::super::names::ident;
use super::super::pose::PosePlan;
use super::super::types::field;
use super::{Kernels, Methods, imports, literal};
use crate::derivation::{Block, Derivation};
use crate::graph::SymbolId;
use crate::model::Kind;

impl Methods<'_> {
    /// The `impl` blocks, in a scope of their own for the names that they use.
    pub(super) fn block(&self, kernels: Option<&Kernels>, private: &TokenStream) -> TokenStream {
        let Types { driver, inputs, unknowns, pose, coordinates, .. } = self.types;
        let text = driver.to_string();
        let (u, v) = (self.driver.unknowns.len(), self.driver.inputs.len());
        let (nu, nv) = (literal(u), literal(v));
        let functions = &self.functions;
        let iterator = self.uses.contains("existing").then(|| {
            quote!(
                use ::core::iter::Iterator;
            )
        });
        let imports = imports(self.mechanism, &self.uses);
        let members: Vec<Ident> =
            self.driver.unknowns.iter().map(|&index| field(&self.mechanism.coordinates[index].name)).collect();
        let rest = members.is_empty().then(|| quote!(..));
        let driving: Vec<Ident> =
            self.driver.inputs.iter().map(|&index| field(&self.mechanism.coordinates[index].name)).collect();
        let no_driver = driving.is_empty().then(|| quote!(..));
        // Where there is nothing else in q, there is nothing to take from it.
        let others = (u > 0).then(|| quote!(..*q));
        let angles = |places: &[usize]| {
            let kinds = places.iter().map(|&index| self.mechanism.coordinates[index].kind == Kind::Angle);
            quote!([#(#kinds),*])
        };
        let (unknown_angles, input_angles) = (angles(&self.driver.unknowns), angles(&self.driver.inputs));
        let names = |indices: &[usize]| -> Vec<&str> {
            indices.iter().map(|&index| self.mechanism.coordinates[index].name.text.as_str()).collect()
        };
        let (unknown_names, input_names) = (names(&self.driver.unknowns), names(&self.driver.inputs));
        let groups = kernels.map(|kernels| groups(kernels.derivation)).unwrap_or_default();
        let group_count = literal(groups.len());
        let assembly = self.assembly(private);
        let pose_coordinates = kernels.map(|kernels| self.pose_coordinates(kernels.derivation, kernels.plan));
        quote! {
            const _: () = {
                use ::core::convert::{From, Into};
                #iterator
                use ::core::result::Result::{self, Ok};
                use #private::{#(#imports),*};
                impl<T: Real> #driver<T> {
                    /// The name of the mechanism, as errors give it.
                    pub const NAME: &'static str = #text;
                    #functions
                }
                #pose_coordinates
                impl<T: Real> Mechanism<T, #nu, #nv> for #driver<T> {
                    const NAME: &'static str = #text;
                    const UNKNOWNS: [&'static str; #nu] = [#(#unknown_names),*];
                    const INPUTS: [&'static str; #nv] = [#(#input_names),*];
                    const UNKNOWN_ANGLES: [bool; #nu] = #unknown_angles;
                    const INPUT_ANGLES: [bool; #nv] = #input_angles;
                    const GROUPS: &'static [Group] = &[#(#groups),*];
                    type Coordinates = #coordinates<T>;
                    type Inputs = #inputs<T>;
                    type Unknowns = #unknowns<T>;
                    type Pose = #pose<T>;
                    type BlockDeterminants = [T; #group_count];
                    fn unknowns(q: &Self::Coordinates) -> SVector<T, #nu> {
                        #unknowns::from(q).into()
                    }
                    fn inputs(q: &Self::Coordinates) -> SVector<T, #nv> {
                        #inputs::from(q).into()
                    }
                    fn with_inputs(q: &Self::Coordinates, inputs: SVector<T, #nv>) -> Self::Coordinates {
                        let #inputs { #(#driving,)* #no_driver } = inputs.into();
                        #coordinates { #(#driving,)* #others }
                    }
                    fn with_unknowns(q: &Self::Coordinates, unknowns: SVector<T, #nu>) -> Self::Coordinates {
                        let #unknowns { #(#members,)* #rest } = unknowns.into();
                        #coordinates { #(#members,)* ..*q }
                    }
                    fn pose_at(&self, q: &Self::Coordinates) -> Self::Pose {
                        self.pose_at(q)
                    }
                    fn residual(&self, pose: &Self::Pose) -> SVector<T, #nu> {
                        self.residual(pose)
                    }
                    fn closure_sizes(&self, pose: &Self::Pose) -> SVector<T, #nu> {
                        self.closure_sizes(pose)
                    }
                    fn jacobian_unknowns(&self, pose: &Self::Pose) -> SMatrix<T, #nu, #nu> {
                        self.jacobian_unknowns(pose)
                    }
                    fn jacobian_inputs(&self, pose: &Self::Pose) -> SMatrix<T, #nu, #nv> {
                        self.jacobian_inputs(pose)
                    }
                    fn jacobian_unknowns_sizes(&self, pose: &Self::Pose) -> SMatrix<T, #nu, #nu> {
                        self.jacobian_unknowns_sizes(pose)
                    }
                    fn jacobian_inputs_sizes(&self, pose: &Self::Pose) -> SMatrix<T, #nu, #nv> {
                        self.jacobian_inputs_sizes(pose)
                    }
                    fn determinant(&self, pose: &Self::Pose) -> T {
                        self.determinant(pose)
                    }
                    fn block_determinants(&self, pose: &Self::Pose) -> Self::BlockDeterminants {
                        self.block_determinants(pose)
                    }
                    fn gamma(&self, pose: &Self::Pose, rate: &Self::Coordinates) -> SVector<T, #nu> {
                        self.gamma(pose, rate)
                    }
                    fn solve_jacobian(&self, pose: &Self::Pose, right: &SVector<T, #nu>) -> Result<SVector<T, #nu>, Error> {
                        self.solve_jacobian(pose, right)
                    }
                }
                #assembly
            };
        }
    }

    /// Position in closed form, for general algorithms.
    fn assembly(&self, private: &TokenStream) -> Option<TokenStream> {
        let Types { driver, branch, .. } = self.types;
        let (nu, nv) = (literal(self.driver.unknowns.len()), literal(self.driver.inputs.len()));
        self.is_assembled.then(|| {
            quote! {
                impl<T: Real> #private::Assembly<T, #nu, #nv> for #driver<T> {
                    type Branch = #branch;
                    fn assemble(&self, inputs: Self::Inputs, branch: Self::Branch) -> Result<Self::Pose, Error> {
                        self.assemble(inputs, branch)
                    }
                    fn branch_of(&self, pose: &Self::Pose) -> Self::Branch {
                        self.branch_of(pose)
                    }
                }
            }
        })
    }

    /// Angles on request: the coordinates of a pose.
    fn pose_coordinates(&self, derivation: &Derivation, plan: &PosePlan) -> TokenStream {
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
        quote! {
            impl<T: Real> #pose<T> {
                #[doc = " The coordinates of this position; an angle that is held as its direction alone comes out"]
                #[doc = " between -pi and pi, at the price of an arc tangent."]
                #[must_use]
                pub fn coordinates(&self) -> #coordinates<T> {
                    #coordinates { #(#fields: #values),* }
                }
            }
        }
    }
}

/// The groups as the trait gives them.
fn groups(derivation: &Derivation) -> Vec<TokenStream> {
    let group = |block: &Block| {
        let name = block.names(derivation);
        let [equations, unknowns] = [&block.equations, &block.unknowns].map(|places| {
            let places = places.iter().map(|&place| literal(place));
            quote!(&[#(#places),*])
        });
        quote!(Group { name: #name, equations: #equations, unknowns: #unknowns })
    };
    derivation.blocks.iter().map(group).collect()
}
