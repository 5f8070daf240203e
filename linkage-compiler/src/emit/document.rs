//! `DERIVATION`: the derivation as data, with every formula as Unicode text, LaTeX and MathML.

use std::ops::Deref;

use proc_macro2::{Literal, TokenStream};
use quote::{format_ident, quote};
use rustc_hash::FxHashMap;

use super::names::string;
use super::work::Work;
use crate::derivation::{ClosedForm, Derivation, Inverse, Quantity, QuantityFormulas, RatioDerivatives, Row};
use crate::graph::{NodeId, SymbolId};
use crate::ids::{BlockId, CoordinateId, Id, InputId, Table, UnknownId};
use crate::model::{Driver, Mechanism};
use crate::notation::{Formula, Name, Printer};
use crate::program::{Derived, Operations};

/// The constant `DERIVATION` of a driver.
pub(super) fn constant(
    mechanism: &Mechanism,
    driver: &Driver,
    derivation: &Derivation,
    derived: &Derived,
    kernels: &[Work],
    root: &TokenStream,
) -> TokenStream {
    let Derived { formulas, closed_forms, .. } = derived;
    let (inputs, unknowns) = (texts(mechanism, &driver.inputs), texts(mechanism, &driver.unknowns));
    let names = names(mechanism, derivation, &inputs, &unknowns);
    let graph = &derivation.graph;
    let shown = |symbol: SymbolId| names.get(&symbol).copied().unwrap_or(Name::Plain(graph.symbol_name(symbol)));
    let parameters: Vec<&str> = mechanism.parameters.iter().map(|parameter| parameter.name.text.as_str()).collect();
    let mut document = Document {
        printer: Printer::new(graph, &shown),
        derivation,
        parameters: &parameters,
        inputs: &inputs,
        unknowns: &unknowns,
    };
    let (by_inputs, by_pairs, by_parameters) = (document.by_inputs(), document.by_pairs(), document.by_parameters());

    let residual = document.numbered("Psi", &derivation.residual);
    let implied: Vec<NodeId> = derivation.implied.iter().map(|implied| implied.residual).collect();
    let implied = document.numbered("chi", &implied);
    let by_unknowns = derivation.jacobian_unknowns();
    let jacobian_unknowns = document.matrix(Name::Plain("J"), None, &by_unknowns, unknowns.len());
    let jacobian_inputs = document.matrix(Name::Plain("A"), None, &derivation.jacobian_inputs(), inputs.len());
    let blocks: Vec<_> = formulas
        .inverses
        .enumerated()
        .map(|(number, inverse)| document.block(number, &closed_forms[number], inverse.as_ref()))
        .collect();
    let determinant = option(formulas.determinant.map(|node| document.equation(Name::Determinant(None), node)));
    let ratios = document.derivatives(&unknowns, &by_inputs, &formulas.ratios);
    let is_requested = derivation.ratio_derivatives.is_some();
    let second = option(is_requested.then(|| document.derivatives(&unknowns, &by_pairs, &formulas.ratio_derivatives)));
    let gamma = document.numbered("gamma", &derivation.gamma);
    let jerk = option(derivation.eta.as_ref().map(|eta| document.numbered("eta", eta)));
    let sensitivity = option(derivation.sensitivity.as_ref().map(|first| {
        let jacobian = document.matrix(Name::Plain("Psi_p"), None, &first.jacobian, parameters.len());
        let formulas = nonzero(derivation, &formulas.sensitivities);
        let formulas = document.derivatives(&unknowns, &by_parameters, &formulas);
        quote!(Sensitivity { jacobian: #jacobian, formulas: #formulas })
    }));
    let points: Vec<&str> = mechanism.points.iter().map(|point| point.name.text.as_str()).collect();
    let points = document.quantities(&points, &["x_", "y_"], &derivation.points, &formulas.points);
    let outputs: Vec<&str> = mechanism.outputs.iter().map(|output| output.name.text.as_str()).collect();
    let outputs = document.quantities(&outputs, &[""], &derivation.outputs, &formulas.outputs);
    let conditions = formulas.conditions.iter().map(|&condition| formula(&document.printer.condition(condition)));
    let conditions = list(conditions);
    let [parameters, inputs, unknowns] = [&*parameters, &*inputs, &*unknowns].map(symbols);
    let kernels = kernel_list(kernels);

    let (name, text) = (&driver.name, string(&driver.name.to_string()));
    quote! {
        impl #name {
            /// The derivation as data: every formula as text, `LaTeX` and `MathML`, the order of solution and the
            /// operations of each function. If it is not used, it is not in the program.
            pub const DERIVATION: &'static #root::__rt::derivation::prelude::Derivation = {
                use #root::__rt::derivation::prelude::*;
                &Derivation {
                    mechanism: #text,
                    parameters: #parameters,
                    inputs: #inputs,
                    unknowns: #unknowns,
                    residual: #residual,
                    implied: #implied,
                    jacobian_unknowns: #jacobian_unknowns,
                    jacobian_inputs: #jacobian_inputs,
                    blocks: &[#(#blocks),*],
                    determinant: #determinant,
                    ratios: #ratios,
                    ratio_derivatives: #second,
                    gamma: #gamma,
                    jerk: #jerk,
                    sensitivity: #sensitivity,
                    points: #points,
                    outputs: #outputs,
                    conditions: #conditions,
                    kernels: #kernels,
                }
            };
        }
    }
}

/// The names of coordinates as the user wrote them.
pub(super) fn texts<'a, I>(mechanism: &'a Mechanism, places: &Table<I, CoordinateId>) -> Table<I, &'a str> {
    places.iter().map(|&place| mechanism.coordinates[place].name.text.as_str()).collect()
}

/// The name of each symbol.
pub(super) fn names<'a>(
    mechanism: &'a Mechanism,
    derivation: &Derivation,
    inputs: &Table<InputId, &'a str>,
    unknowns: &Table<UnknownId, &'a str>,
) -> FxHashMap<SymbolId, Name<'a>> {
    let mut names = FxHashMap::default();
    for parameter in &mechanism.parameters {
        names.insert(parameter.symbol, Name::Plain(&parameter.name.text));
    }
    let places = derivation.inputs.iter().zip(inputs).chain(derivation.unknowns.iter().zip(unknowns));
    for (&place, &text) in places {
        let coordinate = &derivation.coordinates[place];
        names.insert(coordinate.value, Name::Plain(text));
        names.insert(coordinate.rate, Name::Rate(text));
        names.insert(coordinate.acceleration, Name::Acceleration(text));
    }
    for (ratios, &by) in derivation.ratios.iter().zip(inputs) {
        names.extend(ratios.iter().zip(unknowns).map(|(&ratio, &of)| (ratio, Name::Ratio { of, by })));
    }
    if let Some(RatioDerivatives { pairs, names: second, .. }) = &derivation.ratio_derivatives {
        for (of_pair, &(j, k)) in second.iter().zip(pairs) {
            let by = [inputs[j], inputs[k]];
            names.extend(of_pair.iter().zip(unknowns).map(|(&name, &of)| (name, Name::RatioDerivative { of, by })));
        }
    }
    for (first, parameter) in derivation.sensitivity.iter().flat_map(|first| &first.names).zip(&mechanism.parameters) {
        let by = parameter.name.text.as_str();
        names.extend(first.iter().zip(unknowns).map(|(&name, &of)| (name, Name::Ratio { of, by })));
    }
    names
}

/// The formulas, `None` for those that are zero.
fn nonzero<F: Copy + Into<Option<NodeId>>>(
    derivation: &Derivation,
    formulas: &[impl Deref<Target = [F]>],
) -> Vec<Vec<Option<NodeId>>> {
    let formula = |&formula: &F| formula.into().filter(|&node| !derivation.graph.is_zero(node));
    formulas.iter().map(|of_one| of_one.iter().map(formula).collect()).collect()
}

/// `&[first, second]`
pub(super) fn list(items: impl IntoIterator<Item = TokenStream>) -> TokenStream {
    let items = items.into_iter();
    quote!(&[#(#items),*])
}

pub(super) fn option(value: Option<TokenStream>) -> TokenStream {
    match value {
        Some(value) => quote!(::core::option::Option::Some(#value)),
        None => quote!(::core::option::Option::None),
    }
}

pub(super) fn formula(Formula { text, latex, mathml }: &Formula) -> TokenStream {
    // MathML is long and contains few characters that need escapes, so it is not searched for raw strings.
    let (text, latex, mathml) = (string(text), string(latex), Literal::string(mathml));
    quote!(Formula { text: #text, latex: #latex, mathml: #mathml })
}

/// `&[Symbol]` of parameters or coordinates with these names.
pub(super) fn symbols(names: &[&str]) -> TokenStream {
    list(names.iter().map(|name| {
        let (text, shown) = (string(name), formula(&Formula::of_name(Name::Plain(name))));
        quote!(Symbol { name: #text, formula: #shown })
    }))
}

/// `&[Kernel]` with the operations of each function.
pub(super) fn kernel_list(kernels: &[Work]) -> TokenStream {
    list(kernels.iter().map(|Work { function, operations, lines }| {
        let Operations { functions, divisions, multiplications, additions } = *operations;
        let [functions, divisions, multiplications, additions] =
            [functions, divisions, multiplications, additions].map(Literal::usize_unsuffixed);
        let [function, lines] = [function, lines].map(|text| string(text));
        quote! {
            Kernel {
                function: #function,
                operations: Operations {
                    functions: #functions,
                    divisions: #divisions,
                    multiplications: #multiplications,
                    additions: #additions,
                },
                lines: #lines,
            }
        }
    }))
}

/// Writes formulas of one derivation as tokens.
pub(super) struct Document<'a> {
    pub(super) printer: Printer<'a>,
    pub(super) derivation: &'a Derivation,
    pub(super) parameters: &'a [&'a str],
    pub(super) inputs: &'a Table<InputId, &'a str>,
    pub(super) unknowns: &'a Table<UnknownId, &'a str>,
}

/// The variables of a first or second derivative.
#[derive(Clone, Copy)]
enum By<'a> {
    One(&'a str),
    Two([&'a str; 2]),
}

impl By<'_> {
    fn name<'n>(&'n self, of: &'n str) -> Name<'n> {
        match *self {
            Self::One(by) => Name::Ratio { of, by },
            Self::Two(by) => Name::RatioDerivative { of, by },
        }
    }
}

impl<'a> Document<'a> {
    fn by_inputs(&self) -> Vec<By<'a>> {
        self.inputs.iter().map(|&by| By::One(by)).collect()
    }

    fn by_pairs(&self) -> Vec<By<'a>> {
        let pairs = self.derivation.ratio_derivatives.iter().flat_map(|second| &second.pairs);
        pairs.map(|&(j, k)| By::Two([self.inputs[j], self.inputs[k]])).collect()
    }

    fn by_parameters(&self) -> Vec<By<'a>> {
        self.parameters.iter().map(|&by| By::One(by)).collect()
    }

    fn formula(&mut self, node: NodeId) -> TokenStream {
        formula(&self.printer.formula(node))
    }

    pub(super) fn equation(&mut self, left: Name, right: NodeId) -> TokenStream {
        let (left, right) = (formula(&Formula::of_name(left)), self.formula(right));
        quote!(Equation { left: #left, right: #right })
    }

    /// name_1 = …, name_2 = …
    fn numbered(&mut self, name: &str, nodes: &[NodeId]) -> TokenStream {
        list(nodes.iter().enumerate().map(|(index, &node)| {
            let name = format!("{name}{}", index + 1);
            self.equation(Name::Plain(&name), node)
        }))
    }

    fn matrix<C: Id>(&mut self, name: Name, factor: Option<NodeId>, rows: &[Row<C>], columns: usize) -> TokenStream {
        let name = formula(&Formula::of_name(name));
        let factor = option(factor.map(|factor| self.formula(factor)));
        let mut entries = Vec::new();
        for (index, row) in rows.iter().enumerate() {
            for (&column, &node) in row {
                let (row, column) = (Literal::usize_unsuffixed(index), Literal::usize_unsuffixed(column.index()));
                let value = self.formula(node);
                entries.push(quote!(Entry { row: #row, column: #column, value: #value }));
            }
        }
        let [rows, columns] = [rows.len(), columns].map(Literal::usize_unsuffixed);
        quote!(FormulaMatrix { name: #name, factor: #factor, rows: #rows, columns: #columns, entries: &[#(#entries),*] })
    }

    fn block(&mut self, id: BlockId, position: &ClosedForm, inverse: Option<&Inverse>) -> TokenStream {
        let block = &self.derivation.blocks[id];
        let number = (self.derivation.blocks.len() > 1).then_some(id.number());
        let unknowns =
            block.unknowns.iter().map(|&place| formula(&Formula::of_name(Name::Plain(self.unknowns[place]))));
        let unknowns = list(unknowns);
        let equations = block.equations.iter().map(|&equation| Literal::usize_unsuffixed(equation.index()));
        let group = string(&block.group.description());
        let method = format_ident!("{}", if block.determinant.is_some() { "ClosedForm" } else { "Factorization" });
        let determinant = block.determinant.as_ref().map(|determinant| determinant.value);
        let determinant = option(determinant.map(|value| self.equation(Name::Determinant(number), value)));
        let inverse = inverse.map(|(factor, rows)| self.matrix(Name::Inverse(number), Some(*factor), rows, rows.len()));
        let inverse = option(inverse);
        let root = option(position.root.map(|(root, choice)| {
            let (root, branches) = (self.formula(root), choice.variants());
            quote!(Root { formula: #root, branches: [#(#branches),*] })
        }));
        let position = list(position.equations.iter().map(|&[left, right]| {
            let [left, right] = [left, right].map(|side| self.formula(side));
            quote!(Equation { left: #left, right: #right })
        }));
        quote! {
            Block {
                unknowns: #unknowns,
                equations: &[#(#equations),*],
                group: #group,
                position: #position,
                root: #root,
                method: BlockMethod::#method,
                determinant: #determinant,
                inverse: #inverse,
            }
        }
    }

    /// The equations of the derivatives of named quantities, in the order of the variables; those without formula are
    /// omitted.
    fn derivatives<F: Copy + Into<Option<NodeId>>>(
        &mut self,
        of: &[impl AsRef<str>],
        by: &[By<'_>],
        formulas: &[impl Deref<Target = [F]>],
    ) -> TokenStream {
        let mut equations = Vec::new();
        for (by, formulas) in by.iter().zip(formulas) {
            for (of, &formula) in of.iter().zip(formulas.iter()) {
                if let Some(node) = formula.into() {
                    equations.push(self.equation(by.name(of.as_ref()), node));
                }
            }
        }
        list(equations)
    }

    /// `&[Quantity]` of points or outputs; the name of a component is a prefix and the name of the quantity.
    fn quantities(
        &mut self,
        names: &[&str],
        prefixes: &[&str],
        quantities: &[Quantity],
        formulas: &[QuantityFormulas],
    ) -> TokenStream {
        let (by_inputs, by_pairs, by_parameters) = (self.by_inputs(), self.by_pairs(), self.by_parameters());
        list(names.iter().zip(quantities).zip(formulas).map(|((name, quantity), formulas)| {
            let components: Vec<String> = prefixes.iter().map(|prefix| format!("{prefix}{name}")).collect();
            let values = components.iter().zip(&quantity.value);
            let value = list(values.map(|(component, &node)| self.equation(Name::Plain(component), node)));
            let ratios = self.derivatives(&components, &by_inputs, &formulas.ratios);
            let second = self.derivatives(&components, &by_pairs, &formulas.ratio_derivatives);
            let first = nonzero(self.derivation, &formulas.sensitivities);
            let first = self.derivatives(&components, &by_parameters, &first);
            let name = string(name);
            quote! {
                Quantity {
                    name: #name,
                    value: #value,
                    ratios: #ratios,
                    ratio_derivatives: #second,
                    sensitivities: #first,
                }
            }
        }))
    }
}
