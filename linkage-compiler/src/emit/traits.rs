//! Implementations of the runtime's traits for drivers and scenes, by which generic algorithms call emitted functions.

use std::collections::BTreeMap;

use proc_macro2::{Ident, TokenStream};
use quote::quote;

use super::expression::{argument, literal};
use super::names::{ident, string};
use super::types::field;
use crate::derivation::{Block, Derivation, Kink};
use crate::graph::SymbolId;
use crate::ids::{ColumnId, CoordinateId, Id};
use crate::lower::Code;
use crate::model::{Coordinate, Driver, Kind, Mechanism};
use crate::program::{Derived, Program, SceneSignatures, TypeNames};

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
    let branches = program.functions.iter().any(|function| function.name == "branches").then(|| branches(program));
    let by_unknowns = quote!(__rt::Column<T, __rt::D<#u>>);
    let by_inputs = quote!(__rt::Column<T, __rt::D<#v>>);
    let [square, mixed] = [&u, &v].map(|columns| quote!(__rt::Matrix<T, __rt::D<#u>, __rt::D<#columns>>));
    // In the order of the fields.
    let order = mechanism.coordinate_order(driver);
    let fields: Vec<Ident> = order.iter().map(|&place| field(&mechanism.coordinates[place].name)).collect();
    // Conversions between (u, v) and coordinates or rates by name.
    let composed = |function: &str, of: &Ident| {
        let function = ident(function);
        quote! {
            fn #function(unknowns: #by_unknowns, inputs: #by_inputs) -> #of<T> {
                let ([#(#unknown_fields),*], [#(#input_fields),*]): ([T; #u], [T; #v]) =
                    (unknowns.into(), inputs.into());
                #of { #(#fields),* }
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

/// Implements `Scene` if the scene has `inertia`.
pub(super) fn of_scene(
    signatures: &SceneSignatures,
    on: &Driver,
    (fields, kinks): (&[Ident], &[Kink]),
) -> Option<TokenStream> {
    let SceneSignatures { scene, types, field: inner, inputs, driven, unknowns, .. } = signatures;
    scene.inertia.as_ref()?;
    let (name, text) = (&scene.name, scene.name.to_string());
    let TypeNames { driver, inputs: inputs_type, coordinates, rates, .. } = types;
    let [of, inputs_type, coordinates, rates] = [driver, inputs_type, coordinates, rates].map(|n| ident(n));
    let inner = ident(inner);
    let unknowns = *unknowns;
    let [u, v, n, c] = [unknowns, inputs.len(), unknowns + 2 * inputs.len(), scene.contacts.len()].map(literal);
    let names: Vec<Ident> = inputs.iter().map(|input| ident(input)).collect();
    let input_rates: Vec<Ident> = inputs.iter().map(|input| ident(&format!("{input}_rate"))).collect();
    let prescribed = inputs.ids().map(|at| match driven.contains(&at) {
        true => {
            let driven = ident(&inputs[at]);
            quote!(__rt::Some(drives.#driven))
        }
        false => quote!(__rt::None),
    });
    let prescribed: Vec<TokenStream> = prescribed.collect();
    let (time, drives) = match driven.is_empty() {
        true => (quote!(_t), TokenStream::new()),
        false => (quote!(t), quote!(let drives = self.drives(t);)),
    };
    let has_contacts = !scene.contacts.is_empty();
    let equations = match has_contacts {
        false => quote! {
            __rt::Equations::at(
                &self.#inner, &q, input_rates, self.mass_matrix(&q)?, self.forces(t, &q, input_rates)?
            )
        },
        true => quote!(self.equations(t, &q, input_rates)),
    };
    let [of_t, of_q, of_rates] = ["t", "q", "rates"].map(|name| argument(name, has_contacts));
    let contacts = match has_contacts {
        false => quote!(__rt::Ok([].into())),
        true => quote!(__rt::Ok(self.contacts(t, q, rates)?.into())),
    };
    let state = quote!(__rt::Column<T, __rt::D<#n>>);
    let (reactions, joints) = reactions(signatures, on, fields);
    let bearings = bearings(signatures);
    let kinks = of_kinks(signatures, kinks);
    let result = |of: TokenStream| quote!(__rt::Result<#of, __rt::MotionError>);
    let (nothing, derivative) = (result(quote!(())), result(state.clone()));
    let [all_contacts, all_equations, all_unreduced] = [
        quote!(__rt::Column<__rt::Contact<T, __rt::D<#u>, __rt::D<#v>>, __rt::D<#c>>),
        quote!(__rt::Equations<T, __rt::D<#u>, __rt::D<#v>>),
        quote!(__rt::Unreduced<T, __rt::D<#u>, __rt::D<#v>>),
    ]
    .map(result);
    Some(quote! {
        impl<T: __rt::Real> __rt::Scene for #name<T> {
            type Scalar = T;
            type U = __rt::D<#u>;
            type V = __rt::D<#v>;
            type State = __rt::D<#n>;
            type Contacts = __rt::D<#c>;
            type Mechanism = #of<T>;
            type Reactions = #reactions;
            const NAME: &'static str = #text;
            fn mechanism(&self) -> &Self::Mechanism {
                &self.#inner
            }
            fn state(q: &#coordinates<T>, input_rates: &#inputs_type<T>) -> #state {
                [#(q.#fields,)* #(input_rates.#names),*].into()
            }
            fn parts(state: &#state) -> __rt::StateParts<#coordinates<T>, #inputs_type<T>> {
                let [#(#fields,)* #(#input_rates),*]: [T; #n] = (*state).into();
                __rt::StateParts {
                    q: #coordinates { #(#fields),* },
                    input_rates: #inputs_type { #(#names: #input_rates),* },
                }
            }
            fn check(&self) -> #nothing {
                self.check()
            }
            fn derivative(&self, t: T, state: &#state) -> #derivative {
                let __rt::StateParts { q, input_rates } = Self::parts(state);
                let __rt::StateRates { rates, input_accelerations } = self.rates(t, &q, input_rates)?;
                __rt::Ok([#(rates.#fields,)* #(input_accelerations.#names),*].into())
            }
            fn equations(&self, t: T, state: &#state) -> #all_equations {
                let __rt::StateParts { q, input_rates } = Self::parts(state);
                #equations
            }
            fn contacts(&self, #of_t: T, #of_q: &#coordinates<T>, #of_rates: &#rates<T>) -> #all_contacts {
                #contacts
            }
            #joints
            #bearings
            #kinks
            fn unreduced(&self, t: T, q: &#coordinates<T>, rates: &#rates<T>) -> #all_unreduced {
                self.unreduced(t, q, rates)
            }
            fn prescribed(&self, #time: T) -> __rt::Column<__rt::Option<__rt::Prescribed<T>>, __rt::D<#v>> {
                #drives
                [#(#prescribed),*].into()
            }
        }
    })
}

/// The type of the forces in the joints of a scene, and the function of `Scene` that computes them.
fn reactions(signatures: &SceneSignatures, driver: &Driver, fields: &[Ident]) -> (TokenStream, TokenStream) {
    let SceneSignatures { mechanism, scene, types, reactions_type, inputs, unknowns, .. } = signatures;
    let TypeNames { coordinates, rates, accelerations, .. } = types;
    let [name, coordinates, rates, accelerations] =
        [reactions_type, coordinates, rates, accelerations].map(|name| ident(name));
    let [u, v, c] = [*unknowns, inputs.len(), scene.contacts.len()].map(literal);
    let has_reactions = signatures.has_reactions();
    let of = if has_reactions { quote!(#name<T>) } else { quote!(()) };
    let names = ["t", "q", "rates", "accelerations", "contact_forces"];
    let [t, q, of_rates, of_accelerations, forces] =
        names.map(|name| argument(name, has_reactions && (name != "contact_forces" || !scene.contacts.is_empty())));
    let value = if has_reactions {
        let unknowns = Members::of(mechanism, &driver.unknowns).fields;
        let inputs = Members::of(mechanism, &driver.inputs).fields;
        let forces = (!scene.contacts.is_empty()).then(|| quote!(&(*contact_forces).into()));
        quote! {
            let ([#(#unknowns),*], [#(#inputs),*]): ([T; #u], [T; #v]) = (accelerations.unknowns.into(), accelerations.inputs.into());
            self.reactions_of(t, q, rates, &#accelerations { #(#fields),* }, #forces)
        }
    } else {
        quote!(__rt::Ok(()))
    };
    let function = quote! {
        fn reactions(
            &self,
            #t: T,
            #q: &#coordinates<T>,
            #of_rates: &#rates<T>,
            #of_accelerations: &__rt::Vector<T, __rt::D<#u>, __rt::D<#v>>,
            #forces: &__rt::Column<T, __rt::D<#c>>,
        ) -> __rt::Result<Self::Reactions, __rt::MotionError> {
            #value
        }
    };
    (of, function)
}

/// The constant and the function of `Scene` for the kinks of its laws, if there are any.
fn of_kinks(signatures: &SceneSignatures, kinks: &[Kink]) -> Option<TokenStream> {
    let [coordinates, rates] = [&signatures.types.coordinates, &signatures.types.rates].map(|name| ident(name));
    let all = kinks.iter().map(|Kink { label, is_timed, .. }| {
        let effect = string(label);
        quote!(__rt::Kink { effect: #effect, is_timed: #is_timed })
    });
    let all: Vec<TokenStream> = all.collect();
    (!kinks.is_empty()).then(|| {
        quote! {
            const KINKS: &'static [__rt::Kink] = &[#(#all),*];
            fn kink(&self, place: usize, t: T, q: &#coordinates<T>, rates: &#rates<T>) -> T {
                self.kinks(t, q, rates).get(place).copied().unwrap_or(T::one())
            }
        }
    })
}

/// The constant and the function of `Scene` for the reactions that limit frictions, if there are any.
fn bearings(signatures: &SceneSignatures) -> Option<TokenStream> {
    let SceneSignatures { scene, types, inputs, unknowns, .. } = signatures;
    let [coordinates, rates] = [&types.coordinates, &types.rates].map(|name| ident(name));
    let [u, v, c] = [*unknowns, inputs.len(), scene.contacts.len()].map(literal);
    let count = signatures.count_bearings();
    let names: Vec<Ident> = (1..=count).map(|number| ident(&format!("bearing_{number}"))).collect();
    let mut left = names.iter();
    let all = scene.contacts.iter().map(|contact| match contact.bearing.and_then(|_| left.next()) {
        Some(name) => quote!(__rt::Some(#name)),
        None => quote!(__rt::None),
    });
    let all: Vec<TokenStream> = all.collect();
    let bearing = quote!(__rt::Bearing<T, __rt::D<#u>, __rt::D<#v>, __rt::D<#c>>);
    (count > 0).then(|| {
        quote! {
            const BEARINGS: bool = true;
            fn bearings(
                &self,
                t: T,
                q: &#coordinates<T>,
                rates: &#rates<T>,
            ) -> __rt::Result<__rt::Column<__rt::Option<#bearing>, __rt::D<#c>>, __rt::MotionError> {
                let [#(#names),*] = self.bearings(t, q, rates)?;
                __rt::Ok([#(#all),*].into())
            }
        }
    })
}
