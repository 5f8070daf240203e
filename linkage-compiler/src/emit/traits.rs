//! The traits of a driver and of a scene, by which general algorithms call the emitted functions.

use std::collections::BTreeMap;

use proc_macro2::{Ident, TokenStream};
use quote::quote;

use super::expression::literal;
use super::names::{ident, string};
use super::types::field;
use crate::derivation::{Block, Derivation};
use crate::graph::SymbolId;
use crate::ids::{ColumnId, CoordinateId, Id};
use crate::lower::Code;
use crate::model::{Coordinate, Kind, Mechanism};
use crate::program::{Derived, Program, SceneSignatures, TypeNames};

/// `is_finite` of a pose, and angles on request: its coordinates.
pub(super) fn of_pose(program: &Program<Code>, derivation: Option<&Derivation>) -> TokenStream {
    let TypeNames { pose, coordinates, .. } = &program.signatures.types;
    let (pose, coordinates) = (ident(pose), ident(coordinates));
    let (is_finite, values) = match program.derived.as_ref().zip(derivation) {
        Some((derived, derivation)) => {
            let (numbers, values) = (numbers_of(&derived.pose), coordinates_of(derived, derivation));
            let fields = derivation.coordinates.iter().map(|coordinate| ident(&coordinate.name));
            (quote!([#(#numbers),*].iter().all(T::is_finite)), quote!(#coordinates { #(#fields: #values),* }))
        }
        None => (quote!(::core::unreachable!()), quote!(::core::unreachable!())),
    };
    quote! {
        impl<T: __rt::Real> #pose<T> {
            #[doc = " Whether every number of this position is finite."]
            #[must_use]
            pub fn is_finite(&self) -> bool {
                #is_finite
            }
            #[doc = " The coordinates of this position; an angle that is held as its direction alone comes out"]
            #[doc = " between -pi and pi, at the price of an arc tangent. It never fails: where a number is not"]
            #[doc = " finite, the result is not finite, or has no meaning."]
            #[must_use]
            pub fn coordinates(&self) -> #coordinates<T> {
                #values
            }
        }
    }
}

/// Every number that a pose holds.
fn numbers_of(pose: &crate::program::PosePlan) -> Vec<TokenStream> {
    let directions = pose.directions.values().map(|field| ident(field));
    let parts = directions.flat_map(|field| [quote!(self.#field.re), quote!(self.#field.im)]);
    let values = pose.values.iter().map(|(_, field, _)| field);
    let values = values.chain(pose.determinants.iter().map(|(_, field, _)| field));
    let values = values.chain(pose.externals.iter().map(|(_, field, _)| field));
    let values = values.map(|field| {
        let field = ident(field);
        quote!(self.#field)
    });
    parts.chain(values).collect()
}

/// The coordinates by the fields of a pose.
fn coordinates_of(derived: &Derived, derivation: &Derivation) -> Vec<TokenStream> {
    let directions = derived.pose.directions.iter();
    let angles = directions.filter_map(|(angle, field)| Some((derivation.graph.as_symbol(*angle)?, field)));
    let angles: BTreeMap<SymbolId, &String> = angles.collect();
    let numbers: BTreeMap<ColumnId, &String> =
        derived.pose.values.iter().map(|(index, field, _)| (*index, field)).collect();
    let coordinates = derivation.coordinates.enumerated();
    coordinates
        .filter_map(|(index, coordinate)| {
            if let Some(field) = numbers.get(&index) {
                let field = ident(field);
                return Some(quote!(self.#field));
            }
            let field = ident(angles.get(&coordinate.value)?);
            Some(quote!(self.#field.angle()))
        })
        .collect()
}

/// The mechanism for general algorithms, with its position in closed form if it has one.
pub(super) fn of_driver(program: &Program<Code>, derivation: Option<&Derivation>) -> TokenStream {
    let (mechanism, driver) = (program.signatures.mechanism, program.signatures.driver);
    let TypeNames { inputs, unknowns, pose, coordinates, branch, .. } = &program.signatures.types;
    // No coordinate is called so.
    let (name, q) = (&driver.name, ident(&program.signatures.arguments.q));
    let [inputs, unknowns, pose, coordinates, branch] = [inputs, unknowns, pose, coordinates, branch].map(|n| ident(n));
    let of_unknowns = Members::of(mechanism, &driver.unknowns);
    let of_inputs = Members::of(mechanism, &driver.inputs);
    let Members { fields: unknown_fields, texts: unknown_texts, are_angles: unknown_angles } = &of_unknowns;
    let Members { fields: input_fields, texts: input_texts, are_angles: input_angles } = &of_inputs;
    let (u, v) = (literal(driver.unknowns.len()), literal(driver.inputs.len()));
    let groups = derivation.map(groups).unwrap_or_default();
    let blocks = literal(program.position.blocks);
    let assembly = program.position.is_closed.then(|| {
        let near = (!program.position.turns.is_empty()).then(|| {
            quote! {
                fn assemble_near(
                    &self,
                    guess: &Self::Coordinates,
                    branch: Self::Branch,
                ) -> __rt::Result<Self::Pose, __rt::Error> {
                    self.assemble_near(guess, branch)
                }
            }
        });
        quote! {
            impl<T: __rt::Real> __rt::Assembly<T, #u, #v> for #name<T> {
                type Branch = #branch;
                fn assemble(&self, inputs: Self::Inputs, branch: Self::Branch) -> __rt::Result<Self::Pose, __rt::Error> {
                    self.assemble(inputs, branch)
                }
                #near
                fn branch_of(&self, pose: &Self::Pose) -> Self::Branch {
                    self.branch_of(pose)
                }
            }
        }
    });
    quote! {
        impl<T: __rt::Real> __rt::Mechanism<T, #u, #v> for #name<T> {
            const NAME: &'static str = Self::NAME;
            const UNKNOWNS: [&'static str; #u] = [#(#unknown_texts),*];
            const INPUTS: [&'static str; #v] = [#(#input_texts),*];
            const UNKNOWN_ANGLES: [bool; #u] = [#(#unknown_angles),*];
            const INPUT_ANGLES: [bool; #v] = [#(#input_angles),*];
            const GROUPS: &'static [__rt::Group] = &[#(#groups),*];
            type Coordinates = #coordinates<T>;
            type Inputs = #inputs<T>;
            type Unknowns = #unknowns<T>;
            type Pose = #pose<T>;
            type BlockDeterminants = [T; #blocks];
            fn unknowns(q: &Self::Coordinates) -> __rt::SVector<T, #u> {
                __rt::SVector::from([#(q.#unknown_fields),*])
            }
            fn inputs(q: &Self::Coordinates) -> __rt::SVector<T, #v> {
                __rt::SVector::from([#(q.#input_fields),*])
            }
            fn with_inputs(#q: &Self::Coordinates, inputs: __rt::SVector<T, #v>) -> Self::Coordinates {
                let [[#(#input_fields),*]] = inputs.data.0;
                #coordinates { #(#input_fields,)* ..*#q }
            }
            fn with_unknowns(#q: &Self::Coordinates, unknowns: __rt::SVector<T, #u>) -> Self::Coordinates {
                let [[#(#unknown_fields),*]] = unknowns.data.0;
                #coordinates { #(#unknown_fields,)* ..*#q }
            }
            fn pose_at(&self, q: &Self::Coordinates) -> Self::Pose {
                self.pose_at(q)
            }
            fn is_finite(pose: &Self::Pose) -> bool {
                pose.is_finite()
            }
            fn residual(&self, pose: &Self::Pose) -> __rt::SVector<T, #u> {
                self.residual(pose)
            }
            fn closure_sizes(&self, pose: &Self::Pose) -> __rt::SVector<T, #u> {
                self.closure_sizes(pose)
            }
            fn jacobian_unknowns(&self, pose: &Self::Pose) -> __rt::SMatrix<T, #u, #u> {
                self.jacobian_unknowns(pose)
            }
            fn jacobian_inputs(&self, pose: &Self::Pose) -> __rt::SMatrix<T, #u, #v> {
                self.jacobian_inputs(pose)
            }
            fn jacobian_sizes(&self, pose: &Self::Pose) -> (__rt::SMatrix<T, #u, #u>, __rt::SMatrix<T, #u, #v>) {
                self.jacobian_sizes(pose)
            }
            fn determinant(&self, pose: &Self::Pose) -> T {
                self.determinant(pose)
            }
            fn block_determinants(&self, pose: &Self::Pose) -> Self::BlockDeterminants {
                self.block_determinants(pose)
            }
            fn gamma(&self, pose: &Self::Pose, rate: &Self::Coordinates) -> __rt::SVector<T, #u> {
                self.gamma(pose, rate)
            }
            fn solve_jacobian(
                &self,
                pose: &Self::Pose,
                right: &__rt::SVector<T, #u>,
            ) -> __rt::Result<__rt::SVector<T, #u>, __rt::Error> {
                self.solve_jacobian(pose, right)
            }
        }
        #assembly
    }
}

/// Some coordinates: their fields, what they are called, and which are angles.
struct Members<'a> {
    fields: Vec<Ident>,
    texts: Vec<&'a str>,
    are_angles: Vec<bool>,
}

impl<'a> Members<'a> {
    fn of(mechanism: &'a Mechanism, places: &[CoordinateId]) -> Self {
        let coordinates = || places.iter().map(|&place| &mechanism.coordinates[place]);
        let is_angle = |coordinate: &Coordinate| coordinate.kind == Kind::Angle;
        Self {
            fields: coordinates().map(|coordinate| field(&coordinate.name)).collect(),
            texts: coordinates().map(|coordinate| coordinate.name.text.as_str()).collect(),
            are_angles: coordinates().map(is_angle).collect(),
        }
    }
}

/// The groups: the name of each, its equations and its unknowns.
fn groups(derivation: &Derivation) -> Vec<TokenStream> {
    let group = |block: &Block| {
        let name = string(&block.names(derivation));
        let equations = block.equations.iter().map(|equation| literal(equation.index()));
        let unknowns = block.unknowns.iter().map(|unknown| literal(unknown.index()));
        quote!(__rt::Group { name: #name, equations: &[#(#equations),*], unknowns: &[#(#unknowns),*] })
    };
    derivation.blocks.iter().map(group).collect()
}

/// The scene for integrators, if anything in it has inertia.
pub(super) fn of_scene(signatures: &SceneSignatures, unknowns: usize, fields: &[Ident]) -> Option<TokenStream> {
    let SceneSignatures { mechanism, scene, types, field: inner, inputs, driven, .. } = signatures;
    scene.inertia.as_ref()?;
    let (name, text) = (&scene.name, scene.name.to_string());
    let [of, inputs_type, coordinates] = [&types.driver, &types.inputs, &types.coordinates].map(|n| ident(n));
    let inner = ident(inner);
    let (u, v, n) = (literal(unknowns), literal(inputs.len()), literal(unknowns + 2 * inputs.len()));
    let count = literal(scene.contacts.len());
    let names: Vec<Ident> = inputs.iter().map(|input| ident(input)).collect();
    let rates: Vec<Ident> = inputs.iter().map(|input| ident(&format!("{input}_rate"))).collect();
    let places = &mechanism.drivers[scene.driver].inputs;
    let texts = places.iter().map(|&place| mechanism.coordinates[place].name.text.as_str());
    let laws: Vec<Ident> = driven.iter().map(|&at| ident(&format!("{}_law", inputs[at]))).collect();
    let prescribed = inputs.ids().map(|at| match driven.iter().position(|&other| other == at) {
        Some(place) => {
            let law = &laws[place];
            quote!(__rt::Some(#law))
        }
        None => quote!(__rt::None),
    });
    let prescribed: Vec<TokenStream> = prescribed.collect();
    let (time, drives) = match laws.as_slice() {
        [] => (quote!(_t), TokenStream::new()),
        _ => (quote!(t), quote!(let [#(#laws),*] = self.drives(t);)),
    };
    let (equations, contacts) = match scene.contacts.as_slice() {
        [] => (
            quote! {
                let (mass, forces) = (self.mass_matrix(&q)?, self.forces(t, &q, rates)?);
                __rt::Equations::at(&self.#inner, &q, &rates.into(), mass, forces)
            },
            quote! {
                fn contacts(
                    &self,
                    _t: T,
                    _q: &#coordinates<T>,
                    _velocity: &#coordinates<T>,
                ) -> __rt::Result<[__rt::Contact<T, #u, #v>; #count], __rt::Error> {
                    __rt::Ok([])
                }
            },
        ),
        _ => (
            quote!(self.equations(t, &q, rates)),
            quote! {
                fn contacts(
                    &self,
                    t: T,
                    q: &#coordinates<T>,
                    velocity: &#coordinates<T>,
                ) -> __rt::Result<[__rt::Contact<T, #u, #v>; #count], __rt::Error> {
                    self.contacts(t, q, velocity)
                }
            },
        ),
    };
    Some(quote! {
        impl<T: __rt::Real> __rt::Scene<T, #u, #v, #n, #count> for #name<T> {
            const NAME: &'static str = #text;
            type Mechanism = #of<T>;
            fn mechanism(&self) -> &Self::Mechanism {
                &self.#inner
            }
            fn state(q: &#coordinates<T>, rates: &#inputs_type<T>) -> __rt::SVector<T, #n> {
                __rt::SVector::from([#(q.#fields,)* #(rates.#names),*])
            }
            fn parts(state: &__rt::SVector<T, #n>) -> (#coordinates<T>, #inputs_type<T>) {
                let [[#(#fields,)* #(#rates),*]] = state.data.0;
                (#coordinates { #(#fields),* }, #inputs_type { #(#names: #rates),* })
            }
            fn check(&self) -> __rt::Result<(), __rt::Error> {
                self.check()
            }
            fn derivative(&self, t: T, state: &__rt::SVector<T, #n>) -> __rt::Result<__rt::SVector<T, #n>, __rt::Error> {
                let (q, rates) = Self::parts(state);
                let (velocity, acceleration) = self.rates(t, &q, rates)?;
                __rt::Ok(Self::state(&velocity, &acceleration))
            }
            fn equations(
                &self,
                t: T,
                state: &__rt::SVector<T, #n>,
            ) -> __rt::Result<__rt::Equations<T, #u, #v>, __rt::Error> {
                let (q, rates) = Self::parts(state);
                #equations
            }
            #contacts
            fn unreduced(
                &self,
                t: T,
                q: &#coordinates<T>,
                rate: &#coordinates<T>,
            ) -> __rt::Result<__rt::Unreduced<T, #u, #v>, __rt::Error> {
                self.unreduced(t, q, rate)
            }
            fn prescribed(&self, #time: T) -> [__rt::Option<[T; 3]>; #v] {
                #drives
                [#(#prescribed),*]
            }
            fn inputs(state: &__rt::SVector<T, #n>) -> [(&'static str, T, T); #v] {
                let (q, rates) = Self::parts(state);
                [#((#texts, q.#names, rates.#names)),*]
            }
        }
    })
}
