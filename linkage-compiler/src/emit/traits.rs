//! Implementations of the runtime's traits for drivers, by which generic algorithms call emitted functions.

use std::collections::BTreeMap;

use proc_macro2::{Ident, TokenStream};
use quote::quote;

use super::names::{ident, string};
use super::rust::{argument, literal};
use super::types::{field, mark};
use crate::derivation::{Block, Derivation};
use crate::graph::SymbolId;
use crate::ids::{ColumnId, CoordinateId, Id};
use crate::lower::Code;
use crate::model::{Coordinate, Kind, Mechanism};
use crate::program::{Access, Derived, Function, Program, TypeNames};

/// `is_finite` and `coordinates` of a pose.
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
            #[doc = " Returns true if every number of this position is finite."]
            #[must_use]
            pub fn is_finite(&self) -> bool {
                #is_finite
            }
            #[doc = " The coordinates of this position. An angle that is stored as a direction costs an arc tangent"]
            #[doc = " and is returned between -pi and pi. It does not fail: if a number is not finite, the result"]
            #[doc = " is not finite or meaningless."]
            #[must_use]
            pub fn coordinates(&self) -> #coordinates<T> {
                #values
            }
        }
    }
}

/// Expressions for every number of a pose.
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

/// Expressions for the coordinates, from the fields of a pose.
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
            Some(quote!(self.#field.im.arctangent2(self.#field.re)))
        })
        .collect()
}

/// Implements `Mechanism`, `Assembly` if the position has a closed form, and `Branches` if all positions are listed.
pub(super) fn of_driver(program: &Program<Code>, derivation: Option<&Derivation>) -> TokenStream {
    let (mechanism, driver) = (program.signatures.mechanism, program.signatures.driver);
    let TypeNames { inputs, pose, coordinates, rates, .. } = &program.signatures.types;
    let (name, [inputs, pose, coordinates, rates]) =
        (&driver.name, [inputs, pose, coordinates, rates].map(|n| ident(n)));
    let Members { fields: unknown_fields, texts: unknown_texts, are_angles: unknown_angles } =
        Members::of(mechanism, &driver.unknowns);
    let Members { fields: input_fields, texts: input_texts, are_angles: input_angles } =
        Members::of(mechanism, &driver.inputs);
    let (u, v) = (driver.unknowns.len(), driver.inputs.len());
    let [u, v, g] = [u, v, program.position.blocks].map(literal);
    let groups = derivation.map(groups).unwrap_or_default();
    let assembly = program.position.is_closed.then(|| assembly(program));
    let is_list = |function: &Function<Code>| function.name == "branches" && function.access != Access::Deprecated;
    let branches = program.functions.iter().any(is_list).then(|| branches(program));
    let by_unknowns = quote!(__rt::Column<T, __rt::D<#u>>);
    let by_inputs = quote!(__rt::Column<T, __rt::D<#v>>);
    let [square, mixed] = [&u, &v].map(|columns| quote!(__rt::Matrix<T, __rt::D<#u>, __rt::D<#columns>>));
    // In the order of the fields.
    let order = mechanism.coordinate_order(driver);
    let fields: Vec<Ident> = order.iter().map(|&place| field(&mechanism.coordinates[place].name)).collect();
    let of_none = mark(&fields);
    // Conversions between (u, v) and coordinates or rates by name.
    let composed = |function: &str, of: &Ident| {
        let function = ident(function);
        quote! {
            fn #function(unknowns: #by_unknowns, inputs: #by_inputs) -> #of<T> {
                let ([#(#unknown_fields),*], [#(#input_fields),*]): ([T; #u], [T; #v]) =
                    (unknowns.into(), inputs.into());
                #of { #(#fields,)* #of_none }
            }
        }
    };
    let divided = |function: &str, argument: &str, of: &Ident| {
        let (function, argument) = (ident(function), ident(argument));
        quote! {
            fn #function(#argument: &#of<T>) -> (#by_unknowns, #by_inputs) {
                ([#(#argument.#unknown_fields),*].into(), [#(#argument.#input_fields),*].into())
            }
        }
    };
    let of_parts = [composed("coordinates", &coordinates), composed("rates", &rates)];
    let parts = [divided("parts", "q", &coordinates), divided("rate_parts", "rates", &rates)];
    let is_open = program.signatures.is_open();
    let [vector, matrix] = [quote!(__rt::Column), quote!(__rt::Matrix)];
    let of_pose = [
        ("residual", &by_unknowns, &vector),
        ("residual_scales", &by_unknowns, &vector),
        ("jacobian_unknowns", &square, &matrix),
        ("jacobian_inputs", &mixed, &matrix),
        ("jacobian_unknowns_scales", &square, &matrix),
        ("jacobian_inputs_scales", &mixed, &matrix),
        ("block_determinants", &quote!(__rt::Column<T, __rt::D<#g>>), &vector),
    ];
    // An open chain has no equations: all of these are empty.
    let of_pose = of_pose.map(|(function, of, kind)| {
        let (function, pose) = (ident(function), argument("pose", !is_open));
        let value = if is_open { quote!(#kind::zeros()) } else { quote!(self.#function(pose).into()) };
        quote! {
            fn #function(&self, #pose: &Self::Pose) -> #of {
                #value
            }
        }
    });
    let [pose_argument, rates_argument] = ["pose", "rates"].map(|name| argument(name, !is_open));
    let (determinant, gamma, solution) = match is_open {
        true => (quote!(T::one()), quote!(__rt::Column::zeros()), quote!(*right)),
        false => (
            quote!(self.determinant(pose)),
            quote!(self.gamma(pose, rates).into()),
            quote!(self.solve_jacobian(pose, &(*right).into())?.into()),
        ),
    };
    let has_scale = program.functions.iter().any(|function| function.name == "length_scale");
    let length_scale = has_scale.then(|| {
        quote! {
            fn length_scale(&self, pose: &Self::Pose) -> T {
                self.length_scale(pose)
            }
        }
    });
    let implied = (!mechanism.implied.is_empty()).then(|| {
        quote! {
            fn check_implied(&self, q: &Self::Coordinates) -> __rt::Result<(), __rt::PositionError> {
                self.check_implied(&self.pose_at(q))
            }
        }
    });
    quote! {
        impl<T: __rt::Real> __rt::Mechanism for #name<T> {
            type Scalar = T;
            type U = __rt::D<#u>;
            type V = __rt::D<#v>;
            type G = __rt::D<#g>;
            type Coordinates = #coordinates<T>;
            type Rates = #rates<T>;
            type Inputs = #inputs<T>;
            type Pose = #pose<T>;
            const NAME: &'static str = Self::NAME;
            const UNKNOWNS: &'static [&'static str] = &[#(#unknown_texts),*];
            const INPUTS: &'static [&'static str] = &[#(#input_texts),*];
            const UNKNOWN_ANGLES: &'static [bool] = &[#(#unknown_angles),*];
            const INPUT_ANGLES: &'static [bool] = &[#(#input_angles),*];
            const GROUPS: &'static [__rt::Group] = &[#(#groups),*];
            #(#of_parts)*
            #(#parts)*
            fn pose_at(&self, q: &Self::Coordinates) -> Self::Pose {
                self.pose_at(q)
            }
            fn is_finite(pose: &Self::Pose) -> bool {
                pose.is_finite()
            }
            #(#of_pose)*
            fn determinant(&self, #pose_argument: &Self::Pose) -> T {
                #determinant
            }
            fn gamma(&self, #pose_argument: &Self::Pose, #rates_argument: &Self::Rates) -> #by_unknowns {
                #gamma
            }
            fn solve_jacobian(
                &self,
                #pose_argument: &Self::Pose,
                right: &#by_unknowns,
            ) -> __rt::Result<#by_unknowns, __rt::PositionError> {
                __rt::Ok(#solution)
            }
            #length_scale
            #implied
        }
        #assembly
        #branches
    }
}

/// Implements `Branches`.
fn branches(program: &Program<Code>) -> TokenStream {
    let (name, branch) = (&program.signatures.driver.name, ident(&program.signatures.types.branch));
    quote! {
        impl<T: __rt::Real> __rt::Branches for #name<T> {
            type Branch = #branch;
            fn all_positions(
                &self,
                inputs: Self::Inputs,
            ) -> __rt::Result<impl __rt::Iterator<Item = (Self::Branch, Self::Coordinates)>, __rt::PositionError> {
                __rt::Ok(self.branches(inputs)?.map(|found| (found.branch, found.pose.coordinates())))
            }
        }
    }
}

/// Implements `Assembly`.
fn assembly(program: &Program<Code>) -> TokenStream {
    let (name, branch) = (&program.signatures.driver.name, ident(&program.signatures.types.branch));
    let is_open = program.signatures.is_open();
    let (pose, of_pose) = (
        argument("pose", !is_open),
        match is_open {
            true => quote!(#branch::new()),
            false => quote!(self.branch_of(pose)),
        },
    );
    let near = (!program.position.turns.is_empty()).then(|| {
        quote! {
            fn assemble_near(
                &self,
                guess: &Self::Coordinates,
                branch: Self::Branch,
            ) -> __rt::Result<Self::Pose, __rt::PositionError> {
                self.assemble_near(guess, branch)
            }
        }
    });
    quote! {
        impl<T: __rt::Real> __rt::Assembly for #name<T> {
            type Branch = #branch;
            fn assemble(
                &self,
                inputs: Self::Inputs,
                branch: Self::Branch,
            ) -> __rt::Result<Self::Pose, __rt::PositionError> {
                self.assemble(inputs, branch)
            }
            #near
            fn branch_of(&self, #pose: &Self::Pose) -> Self::Branch {
                #of_pose
            }
        }
    }
}

/// Some coordinates: field names, declared names, and true for angles.
pub(super) struct Members<'a> {
    pub(super) fields: Vec<Ident>,
    texts: Vec<&'a str>,
    are_angles: Vec<bool>,
}

impl<'a> Members<'a> {
    pub(super) fn of(mechanism: &'a Mechanism, places: &[CoordinateId]) -> Self {
        let coordinates = || places.iter().map(|&place| &mechanism.coordinates[place]);
        let is_angle = |coordinate: &Coordinate| coordinate.kind == Kind::Angle;
        Self {
            fields: coordinates().map(|coordinate| field(&coordinate.name)).collect(),
            texts: coordinates().map(|coordinate| coordinate.name.text.as_str()).collect(),
            are_angles: coordinates().map(is_angle).collect(),
        }
    }
}

/// `Group` values: the name of each group, its equations and its unknowns.
fn groups(derivation: &Derivation) -> Vec<TokenStream> {
    let group = |block: &Block| {
        let name = string(&block.title(derivation));
        let equations = block.equations.iter().map(|equation| literal(equation.index()));
        let unknowns = block.unknowns.iter().map(|unknown| literal(unknown.index()));
        quote!(__rt::Group { name: #name, equations: &[#(#equations),*], unknowns: &[#(#unknowns),*] })
    };
    derivation.blocks.iter().map(group).collect()
}
