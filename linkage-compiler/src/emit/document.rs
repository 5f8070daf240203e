//! `DERIVATION`: a document as constants of the runtime.

use proc_macro2::{Literal, TokenStream};
use quote::{ToTokens, format_ident, quote};

use super::names::string;
use super::numbers::{separated, separated_integer};
use crate::document::{
    Chain, ContactEffect, Document, DriverChoice, Effect, Equation, Group, JointForce, Kernel, KernelCode, Matrix,
    Method, Node, Number, PointVectors, Quantity, Root, SceneDocument, Sensitivity, SheetDocument, Symbol, Table,
    Turning, Vector,
};
use crate::model::TypeName;
use crate::program::Operations;
use crate::structure::GroupKind;

/// The constant `DERIVATION` of a driver.
pub(super) fn of_driver(name: &TypeName, document: &Document, root: &TokenStream) -> TokenStream {
    let mut lists = Lists::default();
    let mechanism = string(&document.mechanism);
    let [parameters, inputs, unknowns] = [&document.parameters, &document.inputs, &document.unknowns]
        .map(|symbols| lists.symbols(&document.table, symbols));
    let [residual, implied, ratios, gamma] =
        [&document.residual, &document.implied, &document.ratios, &document.gamma].map(|all| lists.equations(all));
    let [jacobian_unknowns, jacobian_inputs] =
        [&document.jacobian_unknowns, &document.jacobian_inputs].map(|matrix| lists.matrix(matrix));
    let groups = list(document.groups.iter().map(|group| lists.group(group)));
    let determinant = option(document.determinant.as_ref().map(equation));
    let second = option(document.ratio_derivatives.as_deref().map(|all| lists.equations(all)));
    let jerk = option(document.jerk.as_deref().map(|all| lists.equations(all)));
    let sensitivity = option(document.sensitivity.as_ref().map(|Sensitivity { jacobian, formulas }| {
        let (jacobian, formulas) = (lists.matrix(jacobian), lists.equations(formulas));
        quote!(Sensitivity { jacobian: #jacobian, formulas: #formulas })
    }));
    let [points, outputs] =
        [&document.points, &document.outputs].map(|all| list(all.iter().map(|one| lists.quantity(one))));
    let conditions = lists.formulas(&document.conditions);
    let chain = option(document.chain.as_ref().map(chain));
    let kernels = list(document.kernels.iter().map(|kernel| lists.kernel(kernel)));
    let table = table(&document.table, &lists);
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
    let mut lists = Lists::default();
    let [scene, mechanism] = [&document.scene, &document.mechanism].map(|name| string(name));
    let [parameters, contacts] =
        [&document.parameters, &document.contacts].map(|symbols| lists.symbols(&document.table, symbols));
    let [mass_matrix, drives] = [&document.mass_matrix, &document.drives].map(|all| lists.equations(all));
    let forces = list(document.forces.iter().map(|Effect { name, forces }| {
        let (name, forces) = (string(name), lists.equations(forces));
        quote!(Effect { name: #name, forces: #forces })
    }));
    let frictions_and_stops = list(document.frictions_and_stops.iter().map(|contact| lists.contact(contact)));
    let potential = option(document.potential.as_ref().map(equation));
    let joints = list(document.joints.iter().map(|JointForce { name, components }| {
        let (name, [first, second]) = (string(name), components.each_ref().map(equation));
        quote!(JointForce { name: #name, components: [#first, #second] })
    }));
    let multipliers = lists.formulas(&document.multipliers);
    let kernels = list(document.kernels.iter().map(|kernel| lists.kernel(kernel)));
    let table = table(&document.table, &lists);
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
    let mut lists = Lists::default();
    let mechanism = string(&document.mechanism);
    let mut matrices = |all: &[Matrix]| {
        let all = all.iter().map(|matrix| lists.matrix(matrix));
        quote!([#(#all),*])
    };
    let [jacobian_rates, jacobians_of_rates] =
        [&document.jacobian_rates, &document.jacobians_of_rates].map(|pair| matrices(pair));
    let [terms, gamma] = [matrices(&document.terms), matrices(&document.gamma)];
    let [first, second] = document.accelerations.each_ref().map(|all| lists.equations(all));
    let choices = list(document.choices.iter().map(|DriverChoice { inputs, determinant }| {
        let (inputs, determinant) = (lists.formulas(inputs), option(determinant.as_ref().map(equation)));
        quote!(DriverChoice { inputs: #inputs, determinant: #determinant })
    }));
    let turning = list(document.turning.iter().map(|Turning { with, rate, acceleration }| {
        let with = with.iter().map(|name| string(name));
        let [rate, acceleration] = [rate, acceleration].map(|matrix| lists.matrix(matrix));
        quote!(Turning { with: &[#(#with),*], rate: #rate, acceleration: #acceleration })
    }));
    let vectors = list(document.vectors.iter().map(|vector| lists.vector(vector)));
    let points = list(document.points.iter().map(|PointVectors { name, vectors, sums }| {
        let (name, vectors) = (string(name), vectors.iter().map(|place| Literal::usize_unsuffixed(*place)));
        let sums = sums.iter().map(equation);
        quote!(PointVectors { name: #name, vectors: &[#(#vectors),*], sums: [#(#sums),*] })
    }));
    let conditions = lists.formulas(&document.conditions);
    let table = table(&document.table, &lists);
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

impl ToTokens for Number {
    fn to_tokens(&self, tokens: &mut TokenStream) {
        Literal::u32_unsuffixed(self.get()).to_tokens(tokens);
    }
}

/// The table of formulas and all lists of formulas, `T`.
fn table(table: &Table, lists: &Lists) -> TokenStream {
    let mut parts = Parts::default();
    let nodes: Vec<TokenStream> = table.nodes().map(|node| self::node(node, &mut parts)).collect();
    let names = parts.names.iter().map(|name| string(name));
    let parts = parts.all.iter().map(|(is_negative, part)| {
        let minus = is_negative.then(|| quote!(-));
        quote!(#minus #part)
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

/// The names, terms, factors and arguments of all nodes.
#[derive(Default)]
struct Parts<'a> {
    names: Vec<&'a str>,
    all: Vec<(bool, Number)>,
}

impl<'a> Parts<'a> {
    /// Adds a name: its place.
    fn name(&mut self, name: &'a str) -> Literal {
        self.names.push(name);
        Literal::usize_unsuffixed(self.names.len() - 1)
    }

    /// Adds parts: the first place and the count.
    fn add(&mut self, parts: impl IntoIterator<Item = (bool, Number)>) -> TokenStream {
        let first = self.all.len();
        self.all.extend(parts);
        let [first, count] = [first, self.all.len() - first].map(Literal::usize_unsuffixed);
        quote!(#first, #count)
    }

    fn unsigned(&mut self, parts: &[Number]) -> TokenStream {
        self.add(parts.iter().map(|part| (false, *part)))
    }
}

fn node<'a>(node: &'a Node, parts: &mut Parts<'a>) -> TokenStream {
    match node {
        Node::Name(name) => {
            let name = parts.name(name);
            quote!(Name(#name))
        }
        Node::Rate(name) => quote!(Rate(#name)),
        Node::Acceleration(name) => quote!(Acceleration(#name)),
        Node::Ratio(of, by) => quote!(Ratio(#of, #by)),
        Node::RatioDerivative(of, [first, second]) => quote!(RatioDerivative(#of, #first, #second)),
        Node::Determinant(matrix) => quote!(Determinant(#matrix)),
        Node::Inverse(matrix) => quote!(Inverse(#matrix)),
        Node::Integer(value) => {
            let value = separated_integer(*value);
            quote!(Integer(#value))
        }
        Node::Decimal(bits) => {
            let value = decimal(f64::from_bits(*bits));
            quote!(Decimal(#value))
        }
        Node::Pi => quote!(Pi),
        Node::Ellipsis => quote!(Ellipsis),
        Node::Sum(terms) => {
            let terms = parts.add(terms.iter().copied());
            quote!(Sum(#terms))
        }
        Node::Product(factors) => {
            let factors = parts.unsigned(factors);
            quote!(Product(#factors))
        }
        Node::Quotient(above, below) => quote!(Quotient(#above, #below)),
        Node::Power(base, exponent) => {
            let exponent = Literal::u32_unsuffixed(*exponent);
            quote!(Power(#base, #exponent))
        }
        Node::Call(function, arguments) => {
            let (function, arguments) = (format_ident!("{function:?}"), parts.unsigned(arguments));
            quote!(Call(#function, #arguments))
        }
        Node::External(name, order, arguments) => {
            let (name, order) = (parts.name(name), Literal::usize_unsuffixed(*order));
            let arguments = parts.unsigned(arguments);
            quote!(External(#name, #order, #arguments))
        }
        Node::Multiple(one, other) => quote!(Multiple(#one, #other)),
        Node::AtMost(all) => {
            let all = parts.unsigned(all);
            quote!(AtMost(#all))
        }
        Node::NonZero(inside) => quote!(NonZero(#inside)),
        Node::Exists(inside) => quote!(Exists(#inside)),
    }
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

fn formula(number: &Number) -> TokenStream {
    quote!(T.formula(#number))
}

fn equation([left, right]: &Equation) -> TokenStream {
    quote!(T.equation(#left, #right))
}

fn chain(Chain { links, joints, conditions }: &Chain) -> TokenStream {
    let links = list(links.iter().map(|(name, turns_with)| {
        let (name, turns_with) = (string(name), turns_with.iter().map(|name| string(name)));
        quote!(ChainLink { name: #name, turns_with: &[#(#turns_with),*] })
    }));
    let joints = list(joints.iter().map(|(of, slides_along)| {
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
    fn formulas(&mut self, all: &[Number]) -> TokenStream {
        added("formulas", &mut self.formulas, all.iter().map(|number| number.get()))
    }

    /// `&[Equation]`.
    fn equations(&mut self, all: &[Equation]) -> TokenStream {
        added("equations", &mut self.equations, all.iter().map(|sides| sides.map(|side| side.get())))
    }

    /// `&[Symbol]`; a name is its own formula, but for forces.
    fn symbols(&mut self, table: &Table, symbols: &[Symbol]) -> TokenStream {
        if symbols.iter().all(|symbol| table.is_name(symbol.formula, &symbol.name)) {
            return added("symbols", &mut self.symbols, symbols.iter().map(|symbol| symbol.formula.get()));
        }
        list(symbols.iter().map(symbol))
    }

    fn matrix(&mut self, Matrix { name, factor, rows, columns, entries }: &Matrix) -> TokenStream {
        let (name, factor) = (formula(name), option(factor.as_ref().map(formula)));
        let [rows, columns] = [*rows, *columns].map(Literal::usize_unsuffixed);
        // A place is less than the number of nodes.
        let numbers = entries.iter().map(|(place, value)| {
            let [row, column] = place.map(|index| u32::try_from(index).unwrap_or(u32::MAX));
            [row, column, value.get()]
        });
        let entries = added("entries", &mut self.entries, numbers);
        quote!(FormulaMatrix { name: #name, factor: #factor, rows: #rows, columns: #columns, entries: #entries })
    }

    fn group(&mut self, group: &Group) -> TokenStream {
        let (unknowns, position) = (self.formulas(&group.unknowns), self.equations(&group.position));
        let kind = string(&group.kind.description());
        let form = match group.kind {
            GroupKind::Rrr => quote!(TwoAngles),
            GroupKind::Rrp => quote!(AngleAndLength),
            GroupKind::Rpr => quote!(AngleAndTurningLength),
            GroupKind::Sliders => quote!(TwoLengths),
            GroupKind::Circles => quote!(TwoDistances),
            GroupKind::LinkToCircle => quote!(AngleAndDistance),
            GroupKind::SliderToCircle => quote!(LengthAndDistance),
            GroupKind::Angle => quote!(OneAngle),
            GroupKind::Linear => quote!(OneLinear),
            GroupKind::Loops(2) => quote!(TwoLoops),
            GroupKind::Loops(_) => quote!(ThreeLoops),
            GroupKind::Scalar | GroupKind::Pair | GroupKind::Irreducible(..) => quote!(Other),
        };
        let of_group = group.equations.iter().map(|equation| Literal::usize_unsuffixed(*equation));
        let root = option(group.root.as_ref().map(|Root { formula, choice }| {
            let (root, branches) = (self::formula(formula), choice.variants());
            quote!(Root { formula: #root, branches: [#(#branches),*] })
        }));
        let method = match group.method {
            Method::ClosedForm => quote!(ClosedForm),
            Method::Factorization => quote!(Factorization),
        };
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
        let checks = list(checks.iter().map(|(kind, of)| {
            let check = format_ident!("{kind:?}");
            let of = of.iter().map(formula);
            quote!(KernelCheck::#check([#(#of),*]))
        }));
        let results = list(results.iter().map(|(place, value)| {
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
