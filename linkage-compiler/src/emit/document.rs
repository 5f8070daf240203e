//! `DERIVATION`: a document as constants of the runtime.

use std::fmt;

use proc_macro2::{Ident, Literal, TokenStream};
use quote::{ToTokens, format_ident, quote};

use super::names::string;
use super::numbers::{separated, separated_integer};
use crate::document::{
    ChainJoint, ChainLink, ContactEffect, DriverChoice, DriverDocument, Effect, Equation, FormulaId, FormulaNode,
    FormulaNodes, Group, JointForce, Kernel, KernelCheck, KernelCode, KernelResult, KinematicChain, Matrix,
    PointVectors, Quantity, Root, SceneDocument, Sensitivity, SheetDocument, Symbol, Turning, Vector,
};
use crate::model::TypeName;
use crate::program::Operations;

/// The constant `DERIVATION` of a driver.
pub(super) fn of_driver(name: &TypeName, document: &DriverDocument, root: &TokenStream) -> TokenStream {
    let (record, mut lists) = (&document.record, Lists::default());
    let mechanism = string(&record.mechanism);
    let [parameters, inputs, unknowns] =
        [&record.parameters, &record.inputs, &record.unknowns].map(|symbols| lists.symbols(&document.nodes, symbols));
    let [residual, implied, ratios, gamma] =
        [&record.residual, &record.implied, &record.ratios, &record.gamma].map(|all| lists.equations(all));
    let [jacobian_unknowns, jacobian_inputs] =
        [&record.jacobian_unknowns, &record.jacobian_inputs].map(|matrix| lists.matrix(matrix));
    let groups = list(record.groups.iter().map(|group| lists.group(group)));
    let determinant = option(record.determinant.as_ref().map(equation));
    let second = option(record.ratio_derivatives.as_deref().map(|all| lists.equations(all)));
    let jerk = option(record.jerk.as_deref().map(|all| lists.equations(all)));
    let sensitivity = option(record.sensitivity.as_ref().map(|Sensitivity { jacobian, formulas }| {
        let (jacobian, formulas) = (lists.matrix(jacobian), lists.equations(formulas));
        quote!(Sensitivity { jacobian: #jacobian, formulas: #formulas })
    }));
    let [points, outputs] =
        [&record.points, &record.outputs].map(|all| list(all.iter().map(|one| lists.quantity(one))));
    let conditions = lists.formulas(&record.conditions);
    let chain = option(record.chain.as_ref().map(chain));
    let kernels = list(record.kernels.iter().map(|kernel| lists.kernel(kernel)));
    let table = table(&document.nodes, &lists);
    quote! {
        impl #name {
            /// The derivation as data: every formula, the order of solution and the operations of each function. If it
            /// is not used, it is not in the program.
            pub const DERIVATION: &'static #root::__rt::derivation::prelude::Derivation<'static> = {
                use #root::__rt::derivation::prelude::*;
                #table
                &Derivation {
                    mechanism: #mechanism,
                    parameters: #parameters,
                    inputs: #inputs,
                    unknowns: #unknowns,
                    residual: #residual,
                    implied: #implied,
                    jacobian_unknowns: #jacobian_unknowns,
                    jacobian_inputs: #jacobian_inputs,
                    groups: #groups,
                    determinant: #determinant,
                    ratios: #ratios,
                    ratio_derivatives: #second,
                    gamma: #gamma,
                    jerk: #jerk,
                    sensitivity: #sensitivity,
                    points: #points,
                    outputs: #outputs,
                    conditions: #conditions,
                    chain: #chain,
                    kernels: #kernels,
                }
            };
        }
    }
}

/// The constant `DERIVATION` of a scene: its equations of motion.
pub(super) fn of_scene(name: &TypeName, document: &SceneDocument, root: &TokenStream) -> TokenStream {
    let (record, mut lists) = (&document.record, Lists::default());
    let [scene, mechanism] = [&record.scene, &record.mechanism].map(|name| string(name));
    let [parameters, contacts] =
        [&record.parameters, &record.contacts].map(|symbols| lists.symbols(&document.nodes, symbols));
    let [mass_matrix, drives] = [&record.mass_matrix, &record.drives].map(|all| lists.equations(all));
    let forces = list(record.forces.iter().map(|Effect { name, forces }| {
        let (name, forces) = (string(name), lists.equations(forces));
        quote!(Effect { name: #name, forces: #forces })
    }));
    let frictions_and_stops = list(record.frictions_and_stops.iter().map(|contact| lists.contact(contact)));
    let potential = option(record.potential.as_ref().map(equation));
    let joints = list(record.joints.iter().map(|JointForce { name, components }| {
        let (name, [first, second]) = (string(name), components.each_ref().map(equation));
        quote!(JointForce { name: #name, components: [#first, #second] })
    }));
    let multipliers = lists.formulas(&record.multipliers);
    let kernels = list(record.kernels.iter().map(|kernel| lists.kernel(kernel)));
    let table = table(&document.nodes, &lists);
    quote! {
        impl #name {
            /// The equations of motion as data: every formula, and the operations of each function. If it is not used, it
            /// is not in the program.
            pub const DERIVATION: &'static #root::__rt::derivation::prelude::SceneDerivation<'static> = {
                use #root::__rt::derivation::prelude::*;
                #table
                &SceneDerivation {
                    scene: #scene,
                    mechanism: #mechanism,
                    parameters: #parameters,
                    mass_matrix: #mass_matrix,
                    forces: #forces,
                    frictions_and_stops: #frictions_and_stops,
                    drives: #drives,
                    potential: #potential,
                    joints: #joints,
                    multipliers: #multipliers,
                    contacts: #contacts,
                    kernels: #kernels,
                }
            };
        }
    }
}

/// The constant `SHEET` of a driver: its analysis by hand.
pub(super) fn of_sheet(name: &TypeName, document: &SheetDocument, root: &TokenStream) -> TokenStream {
    let (record, mut lists) = (&document.record, Lists::default());
    let mechanism = string(&record.mechanism);
    let mut matrices = |all: &[Matrix]| {
        let all = all.iter().map(|matrix| lists.matrix(matrix));
        quote!([#(#all),*])
    };
    let [jacobian_rates, jacobians_of_rates] =
        [&record.jacobian_rates, &record.jacobians_of_rates].map(|pair| matrices(pair));
    let [terms, gamma] = [matrices(&record.terms), matrices(&record.gamma)];
    let [first, second] = record.accelerations.each_ref().map(|all| lists.equations(all));
    let choices = list(record.choices.iter().map(|DriverChoice { inputs, determinant }| {
        let (inputs, determinant) = (lists.formulas(inputs), option(determinant.as_ref().map(equation)));
        quote!(DriverChoice { inputs: #inputs, determinant: #determinant })
    }));
    let turning = list(record.turning.iter().map(|Turning { with, rate, acceleration }| {
        let with = with.iter().map(|name| string(name));
        let [rate, acceleration] = [rate, acceleration].map(|matrix| lists.matrix(matrix));
        quote!(Turning { with: &[#(#with),*], rate: #rate, acceleration: #acceleration })
    }));
    let vectors = list(record.vectors.iter().map(|vector| lists.vector(vector)));
    let points = list(record.points.iter().map(|PointVectors { name, vectors, sums }| {
        let (name, vectors) = (string(name), vectors.iter().map(|place| Literal::usize_unsuffixed(*place)));
        let sums = sums.iter().map(equation);
        quote!(PointVectors { name: #name, vectors: &[#(#vectors),*], sums: [#(#sums),*] })
    }));
    let conditions = lists.formulas(&record.conditions);
    let table = table(&document.nodes, &lists);
    quote! {
        impl #name {
            /// The analysis by hand as data, line by line. If it is not used, it is not in the program.
            pub const SHEET: &'static #root::__rt::derivation::prelude::SheetDerivation<'static> = {
                use #root::__rt::derivation::prelude::*;
                #table
                &SheetDerivation {
                    mechanism: #mechanism,
                    jacobian_rates: #jacobian_rates,
                    jacobians_of_rates: #jacobians_of_rates,
                    terms: #terms,
                    gamma: #gamma,
                    accelerations: [#first, #second],
                    choices: #choices,
                    turning: #turning,
                    vectors: #vectors,
                    points: #points,
                    conditions: #conditions,
                }
            };
        }
    }
}

/// The table of formulas and all lists of formulas, `T`.
fn table(FormulaNodes { nodes, names, parts }: &FormulaNodes, lists: &Lists) -> TokenStream {
    let nodes = nodes.iter().map(node);
    let names = names.iter().map(|name| string(name));
    let parts = parts.iter().map(|part| {
        let minus = part.is_negative().then(|| quote!(-));
        let number = Literal::u32_unsuffixed(part.unsigned_abs());
        quote!(#minus #number)
    });
    let Lists { formulas, symbols, equations, entries } = lists;
    let counts = [formulas.len(), symbols.len(), equations.len(), entries.len()].map(Literal::usize_unsuffixed);
    let numbers = formulas.iter().chain(symbols).chain(equations.as_flattened()).chain(entries.as_flattened());
    let numbers = numbers.map(|number| Literal::u32_unsuffixed(*number));
    quote! {
        const NODES: &[FormulaNode] = &[#(#nodes),*];
        const NAMES: &[&str] = &[#(#names),*];
        const PARTS: &[i32] = &[#(#parts),*];
        const NUMBERS: &[u32] = &[#(#numbers),*];
        static TABLE: FormulaTable<'static> = table(NODES, NAMES, PARTS);
        static T: FormulaLists<'static, #(#counts),*> = FormulaLists::new(&TABLE, NUMBERS);
    }
}

fn node(node: &FormulaNode) -> TokenStream {
    use FormulaNode as N;
    let (name, numbers): (_, &[u32]) = match *node {
        N::Pi => return quote!(Pi),
        N::Ellipsis => return quote!(Ellipsis),
        N::Integer(value) => {
            let value = separated_integer(value);
            return quote!(Integer(#value));
        }
        N::Decimal(value) => {
            let value = decimal(value);
            return quote!(Decimal(#value));
        }
        N::Call(function, first, count) => {
            let [first, count] = [first, count].map(Literal::u32_unsuffixed);
            let function = variant(&function);
            return quote!(Call(#function, #first, #count));
        }
        N::Name(name) => ("Name", &[name]),
        N::Rate(of) => ("Rate", &[of]),
        N::Acceleration(of) => ("Acceleration", &[of]),
        N::Ratio(of, by) => ("Ratio", &[of, by]),
        N::RatioDerivative(of, one, other) => ("RatioDerivative", &[of, one, other]),
        N::Determinant(matrix) => ("Determinant", &[matrix]),
        N::Inverse(matrix) => ("Inverse", &[matrix]),
        N::Sum(first, count) => ("Sum", &[first, count]),
        N::Product(first, count) => ("Product", &[first, count]),
        N::Quotient(above, below) => ("Quotient", &[above, below]),
        N::Power(base, exponent) => ("Power", &[base, exponent]),
        N::External(name, order, first, count) => ("External", &[name, order, first, count]),
        N::Multiple(one, other) => ("Multiple", &[one, other]),
        N::AtMost(first, count) => ("AtMost", &[first, count]),
        N::NonZero(inside) => ("NonZero", &[inside]),
        N::Exists(inside) => ("Exists", &[inside]),
    };
    let (name, numbers) = (format_ident!("{name}"), numbers.iter().map(|number| Literal::u32_unsuffixed(*number)));
    quote!(#name(#(#numbers),*))
}

fn decimal(value: f64) -> TokenStream {
    match value {
        _ if value.is_nan() => quote!(f64::NAN),
        _ if value.is_infinite() && value < 0.0 => quote!(f64::NEG_INFINITY),
        _ if value.is_infinite() => quote!(f64::INFINITY),
        _ => {
            let (minus, size) = (value.is_sign_negative().then(|| quote!(-)), separated(value.abs()));
            quote!(#minus #size)
        }
    }
}

/// The name of a variant without fields.
fn variant(of: &impl fmt::Debug) -> Ident {
    format_ident!("{}", format!("{of:?}"))
}

/// `&[first, second]`
fn list(items: impl IntoIterator<Item = TokenStream>) -> TokenStream {
    let items = items.into_iter();
    quote!(&[#(#items),*])
}

fn option(value: Option<TokenStream>) -> TokenStream {
    match value {
        Some(value) => quote!(Some(#value)),
        None => quote!(None),
    }
}

fn number(id: FormulaId) -> Literal {
    Literal::u32_unsuffixed(id.get())
}

fn formula(id: &FormulaId) -> TokenStream {
    let number = number(*id);
    quote!(T.formula(#number))
}

fn equation(Equation { left, right }: &Equation) -> TokenStream {
    let [left, right] = [*left, *right].map(number);
    quote!(T.equation(#left, #right))
}

fn chain(KinematicChain { links, joints, conditions }: &KinematicChain) -> TokenStream {
    let links = list(links.iter().map(|ChainLink { name, turns_with }| {
        let (name, turns_with) = (string(name), turns_with.iter().map(|name| string(name)));
        quote!(ChainLink { name: #name, turns_with: &[#(#turns_with),*] })
    }));
    let joints = list(joints.iter().map(|ChainJoint { links: of, slides_along }| {
        let of = of.map(Literal::usize_unsuffixed);
        let slides_along = option(slides_along.as_deref().map(|name| string(name).to_token_stream()));
        quote!(ChainJoint { links: [#(#of),*], slides_along: #slides_along })
    }));
    let conditions = Literal::usize_unsuffixed(*conditions);
    quote!(KinematicChain { links: #links, joints: #joints, conditions: #conditions })
}

fn symbol(symbol: &Symbol) -> TokenStream {
    let (name, formula) = (string(&symbol.name), formula(&symbol.formula));
    quote!(Symbol { name: #name, formula: #formula })
}

/// The numbers of all lists of formulas, one list of a kind after the other.
#[derive(Default)]
struct Lists {
    formulas: Vec<u32>,
    symbols: Vec<u32>,
    equations: Vec<[u32; 2]>,
    entries: Vec<[u32; 3]>,
}

/// A list that is added to all of its kind.
fn added<N>(kind: &str, all: &mut Vec<N>, more: impl IntoIterator<Item = N>) -> TokenStream {
    let first = all.len();
    all.extend(more);
    let count = all.len() - first;
    if count == 0 {
        return quote!(&[]);
    }
    let (kind, [first, count]) = (format_ident!("{kind}"), [first, count].map(Literal::usize_unsuffixed));
    quote!(T.#kind(#first, #count))
}

impl Lists {
    /// `&[Formula]`.
    fn formulas(&mut self, all: &[FormulaId]) -> TokenStream {
        added("formulas", &mut self.formulas, all.iter().map(|number| number.get()))
    }

    /// `&[Equation]`.
    fn equations(&mut self, all: &[Equation]) -> TokenStream {
        added("equations", &mut self.equations, all.iter().map(|Equation { left, right }| [left.get(), right.get()]))
    }

    /// `&[Symbol]`; a name is its own formula, but for forces.
    fn symbols(&mut self, nodes: &FormulaNodes, symbols: &[Symbol]) -> TokenStream {
        if symbols.iter().all(|symbol| nodes.name(symbol.formula) == Some(&symbol.name)) {
            return added("symbols", &mut self.symbols, symbols.iter().map(|symbol| symbol.formula.get()));
        }
        list(symbols.iter().map(symbol))
    }

    fn matrix(&mut self, Matrix { name, factor, rows, columns, entries }: &Matrix) -> TokenStream {
        let (name, factor) = (formula(name), option(factor.as_ref().map(formula)));
        let [rows, columns] = [*rows, *columns].map(Literal::usize_unsuffixed);
        // A place is less than the number of nodes.
        let numbers = entries.iter().map(|entry| {
            let [row, column] = [entry.row, entry.column].map(|index| u32::try_from(index).unwrap_or(u32::MAX));
            [row, column, entry.value.get()]
        });
        let entries = added("entries", &mut self.entries, numbers);
        quote!(FormulaMatrix { name: #name, factor: #factor, rows: #rows, columns: #columns, entries: #entries })
    }

    fn group(&mut self, group: &Group) -> TokenStream {
        let (unknowns, position) = (self.formulas(&group.unknowns), self.equations(&group.position));
        let (kind, form) = (string(&group.kind), variant(&group.form));
        let of_group = group.equations.iter().map(|equation| Literal::usize_unsuffixed(*equation));
        let root = option(group.root.as_ref().map(|Root { formula, branches }| {
            let (root, branches) = (self::formula(formula), branches.iter().map(|branch| string(branch)));
            quote!(Root { formula: #root, branches: [#(#branches),*] })
        }));
        let method = variant(&group.method);
        let determinant = option(group.determinant.as_ref().map(equation));
        let inverse = option(group.inverse.as_ref().map(|matrix| self.matrix(matrix)));
        quote! {
            Group {
                unknowns: #unknowns,
                equations: &[#(#of_group),*],
                kind: #kind,
                form: GroupForm::#form,
                position: #position,
                root: #root,
                method: GroupMethod::#method,
                determinant: #determinant,
                inverse: #inverse,
            }
        }
    }

    fn quantity(&mut self, quantity: &Quantity) -> TokenStream {
        let name = string(&quantity.name);
        let [value, ratios, second, first] =
            [&quantity.value, &quantity.ratios, &quantity.ratio_derivatives, &quantity.sensitivities]
                .map(|all| self.equations(all));
        quote! {
            Quantity { name: #name, value: #value, ratios: #ratios, ratio_derivatives: #second, sensitivities: #first }
        }
    }

    fn vector(&mut self, vector: &Vector) -> TokenStream {
        let Vector { vector, matrix, rates, velocity, acceleration } = vector;
        let [vector, matrix, rates, velocity, acceleration] =
            [vector, matrix, rates, velocity, acceleration].map(|matrix| self.matrix(matrix));
        quote! {
            ChainVector {
                vector: #vector,
                matrix: #matrix,
                rates: #rates,
                velocity: #velocity,
                acceleration: #acceleration,
            }
        }
    }

    fn contact(&mut self, contact: &ContactEffect) -> TokenStream {
        let (name, along, forces) = (string(&contact.name), equation(&contact.along), self.equations(&contact.forces));
        let [force, bound] = [&contact.force, &contact.bound].map(formula);
        let bearing = option(contact.bearing.as_ref().map(symbol));
        let rebound = option(contact.rebound.as_ref().map(formula));
        quote! {
            ContactEffect {
                name: #name,
                force: #force,
                along: #along,
                bound: #bound,
                bearing: #bearing,
                rebound: #rebound,
                forces: #forces,
            }
        }
    }

    /// A function with its operations, and its code if that is requested.
    fn kernel(&mut self, Kernel { function, operations, code }: &Kernel) -> TokenStream {
        let Operations { functions, divisions, multiplications, additions } = *operations;
        let operations = [functions, divisions, multiplications, additions].map(Literal::usize_unsuffixed);
        let (function, KernelCode { steps, checks, results }) = (string(function), code);
        if results.is_empty() {
            return quote!(Kernel::new(#function, [#(#operations),*]));
        }
        let steps = self.equations(steps);
        let checks = list(checks.iter().map(|check| {
            let of = check.of().iter().map(formula);
            let name = match check {
                KernelCheck::Regular(_) => quote!(Regular),
                KernelCheck::Nonzero(_) => quote!(Nonzero),
                KernelCheck::Positive(_) => quote!(Positive),
                KernelCheck::Apart(_) => quote!(Apart),
                KernelCheck::Moderate(_) => quote!(Moderate),
                KernelCheck::Open(_) => quote!(Open),
            };
            quote!(KernelCheck::#name([#(#of),*]))
        }));
        let results = list(results.iter().map(|KernelResult { place, value }| {
            let (place, value) = (string(place), formula(value));
            quote!(KernelResult { place: #place, value: #value })
        }));
        quote! {
            Kernel {
                function: #function,
                operations: Operations::new([#(#operations),*]),
                code: KernelCode { steps: #steps, checks: #checks, results: #results },
            }
        }
    }
}
