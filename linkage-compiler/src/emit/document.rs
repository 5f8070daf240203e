//! `DERIVATION`: the derivation as data, every formula by its source.

use proc_macro2::{Ident, Literal, TokenStream};
use quote::quote;
use rustc_hash::FxHashMap;

use super::names::{ident, string};
use super::tokens::Tokens;
use crate::derivation::{Derivation, Formulas, Inverse, Quantity, QuantityFormulas, RatioDerivatives, Row, Scene};
use crate::graph::{Condition, Name, NodeId, Printer, SymbolId};
use crate::model::{self, Driver, Mechanism};
use crate::simplify::schedule::Operations;

/// The constant, in a scope of its own for the names that it uses.
pub(super) fn constant(
    mechanism: &Mechanism,
    driver: &Driver,
    derivation: &Derivation,
    formulas: &Formulas,
    kernels: &[(String, Operations)],
    private: &TokenStream,
) -> TokenStream {
    let text = |index: &usize| mechanism.coordinates[*index].name.text.as_str();
    let inputs: Vec<&str> = driver.inputs.iter().map(text).collect();
    let unknowns: Vec<&str> = driver.unknowns.iter().map(text).collect();
    let names = names(mechanism, derivation, &inputs, &unknowns);
    let graph = &derivation.graph;
    let shown = |symbol: SymbolId| names.get(&symbol).copied().unwrap_or(Name::Plain(graph.symbol_name(symbol)));
    let parameters: Vec<&str> = mechanism.parameters.iter().map(|parameter| parameter.name.text.as_str()).collect();
    let mut document = Document {
        words: Words::new(),
        printer: Printer::new(graph, &shown),
        derivation,
        parameters: &parameters,
        inputs: &inputs,
        unknowns: &unknowns,
        has_some: false,
    };

    let title = string(&driver.name.to_string());
    let [named_parameters, named_inputs, named_unknowns] =
        [&parameters, &inputs, &unknowns].map(|names| symbols(names));
    let residual = document.numbered("Psi", &derivation.residual);
    let j = document.matrix(Name::Plain("J"), None, &derivation.jacobian_unknowns(), unknowns.len());
    let a = document.matrix(Name::Plain("A"), None, &derivation.jacobian_inputs(), inputs.len());
    let blocks: Vec<_> = formulas.inverses.iter().enumerate().collect();
    let blocks = list(&blocks, |out, (number, inverse)| out.extend(document.block(*number, inverse.as_ref())));
    let determinant = formulas.determinant.map(|node| document.equation(Name::Determinant(None), node));
    let determinant = document.optional(determinant);
    let (by_inputs, by_pairs, by_parameters) = (document.by_inputs(), document.by_pairs(), document.by_parameters());
    let ratios = document.derivatives(&unknowns, &by_inputs, &formulas.ratios);
    let gamma = document.numbered("gamma", &derivation.gamma);
    let jerk = derivation.eta.as_ref().map(|eta| document.numbered("eta", eta));
    let jerk = document.optional(jerk);
    let asked = derivation.ratio_derivatives.is_some();
    let second = asked.then(|| document.derivatives(&unknowns, &by_pairs, &formulas.ratio_derivatives));
    let second = document.optional(second);
    let sensitivity = derivation.sensitivity.as_ref().map(|first| {
        let jacobian = document.matrix(Name::Plain("Psi_p"), None, &first.jacobian, parameters.len());
        let formulas = nonzero(derivation, &formulas.sensitivities);
        let formulas = document.derivatives(&unknowns, &by_parameters, &formulas);
        quote!(derivation::Sensitivity { jacobian: #jacobian, formulas: #formulas })
    });
    let sensitivity = document.optional(sensitivity);
    let points: Vec<&str> = mechanism.points.iter().map(|point| point.name.text.as_str()).collect();
    let points = document.quantities(&points, &["x_", "y_"], &derivation.points, &formulas.points);
    let outputs: Vec<&str> = mechanism.outputs.iter().map(|output| output.name.text.as_str()).collect();
    let outputs = document.quantities(&outputs, &[""], &derivation.outputs, &formulas.outputs);
    let conditions: Vec<Condition> = formulas.conditions.iter().copied().collect();
    let conditions = list(&conditions, |out, condition| document.condition(out, *condition));
    let kernels = works(kernels);
    let driver = &driver.name;
    // J stands without a factor before it; a determinant may have no formula.
    let options = if document.has_some { quote!({None, Some}) } else { quote!(None) };
    quote! {
        const _: () = {
            use ::core::option::Option::#options;
            use #private::derivation::{self, entry, formula};
            use #private::{__equations, __kernels, __symbols};
            impl #driver {
                /// The derivation as data: every formula, to be written as text, `LaTeX` or `MathML`, the order of
                /// solution and the work of each function. It costs nothing where it is not used.
                pub const DERIVATION: &'static derivation::Derivation = &derivation::Derivation {
                    mechanism: #title,
                    parameters: #named_parameters,
                    inputs: #named_inputs,
                    unknowns: #named_unknowns,
                    residual: #residual,
                    jacobian_unknowns: #j,
                    jacobian_inputs: #a,
                    blocks: #blocks,
                    determinant: #determinant,
                    ratios: #ratios,
                    ratio_derivatives: #second,
                    gamma: #gamma,
                    jerk: #jerk,
                    sensitivity: #sensitivity,
                    points: #points,
                    outputs: #outputs,
                    conditions: #conditions,
                    kernels: #kernels
                };
            }
        };
    }
}

/// The equations of motion of a scene, in a scope of its own likewise.
pub(super) fn of_scene(
    mechanism: &Mechanism,
    (driver, scene): (&Driver, &model::Scene),
    (derivation, derived): (&Derivation, &Scene),
    kernels: &[(String, Operations)],
    private: &TokenStream,
) -> TokenStream {
    let text = |index: &usize| mechanism.coordinates[*index].name.text.as_str();
    let inputs: Vec<&str> = driver.inputs.iter().map(text).collect();
    let unknowns: Vec<&str> = driver.unknowns.iter().map(text).collect();
    let mut names = names(mechanism, derivation, &inputs, &unknowns);
    for parameter in &mechanism.scene_parameters {
        names.insert(parameter.symbol, Name::Plain(&parameter.name.text));
    }
    let graph = &derivation.graph;
    let shown = |symbol: SymbolId| names.get(&symbol).copied().unwrap_or(Name::Plain(graph.symbol_name(symbol)));
    let own = scene.parameters.iter().map(|&place| mechanism.scene_parameters[place].name.text.as_str());
    let own: Vec<&str> = own.collect();
    let mut document = Document {
        words: Words::new(),
        printer: Printer::new(graph, &shown),
        derivation,
        parameters: &own,
        inputs: &inputs,
        unknowns: &unknowns,
        has_some: false,
    };
    let mut mass_matrix = Tokens::default();
    for (row, entries) in derived.mass_matrix.iter().flatten().enumerate() {
        for (column, &entry) in entries.iter().enumerate().skip(row) {
            let name = if inputs.len() == 1 { "M".to_owned() } else { format!("M{}{}", row + 1, column + 1) };
            document.sides(&mut mass_matrix, Name::Plain(&name), entry);
        }
    }
    let mass_matrix = mass_matrix.by_macro("__equations");
    let effects: Vec<TokenStream> = derived
        .parts
        .iter()
        .filter(|(_, forces)| forces.iter().any(|&force| !graph.is_zero(force)))
        .map(|(label, forces)| {
            let mut sides = Tokens::default();
            for (index, &force) in forces.iter().enumerate().filter(|(_, force)| !graph.is_zero(**force)) {
                let name = if forces.len() == 1 { "Q".to_owned() } else { format!("Q{}", index + 1) };
                document.sides(&mut sides, Name::Plain(&name), force);
            }
            let (label, sides) = (string(label), sides.by_macro("__equations"));
            quote!(derivation::Effect { name: #label, forces: #sides })
        })
        .collect();
    let potential = (!graph.is_zero(derived.potential)).then(|| {
        let equation = document.equation(Name::Plain("V"), derived.potential);
        quote!(Some(#equation))
    });
    let options = if potential.is_some() { quote!(Some) } else { quote!(None) };
    let potential = potential.unwrap_or_else(|| quote!(None));
    let (parameters, kernels) = (symbols(&own), works(kernels));
    let (name, title, of) = (&scene.name, scene.name.to_string(), driver.name.to_string());
    quote! {
        const _: () = {
            use ::core::option::Option::#options;
            use #private::{__equations, __kernels, __symbols, derivation};
            impl #name {
                /// The equations of motion as data: every formula, to be written as text, `LaTeX` or `MathML`, and
                /// the work of each function. It costs nothing where it is not used.
                pub const DERIVATION: &'static derivation::Scene = &derivation::Scene {
                    scene: #title,
                    mechanism: #of,
                    parameters: #parameters,
                    mass_matrix: #mass_matrix,
                    forces: &[#(#effects),*],
                    potential: #potential,
                    kernels: #kernels
                };
            }
        };
    }
}

/// What each symbol is called.
fn names<'a>(
    mechanism: &'a Mechanism,
    derivation: &Derivation,
    inputs: &[&'a str],
    unknowns: &[&'a str],
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

/// The formulas but for those that are zero.
fn nonzero<F: Copy + Into<Option<NodeId>>>(derivation: &Derivation, formulas: &[Vec<F>]) -> Vec<Vec<Option<NodeId>>> {
    let formula = |&formula: &F| formula.into().filter(|&node| !derivation.graph.is_zero(node));
    formulas.iter().map(|of_one| of_one.iter().map(formula).collect()).collect()
}

/// `&[…]`
fn list<V>(items: &[V], mut write: impl FnMut(&mut Tokens, &V)) -> TokenStream {
    let mut inside = Tokens::default();
    for item in items {
        write(&mut inside, item);
        inside.punct(',');
    }
    inside.slice()
}

/// The list of these symbols.
fn symbols(names: &[&str]) -> TokenStream {
    let mut inside = Tokens::default();
    for name in names {
        inside.append(string(name));
    }
    inside.by_macro("__symbols")
}

/// The list of what each function does.
fn works(kernels: &[(String, Operations)]) -> TokenStream {
    let mut inside = Tokens::default();
    for (function, operations) in kernels {
        let Operations { functions, divisions, multiplications, additions } = *operations;
        inside.append(string(function));
        for count in [functions, divisions, multiplications, additions] {
            inside.append(Literal::usize_unsuffixed(count));
        }
    }
    inside.by_macro("__kernels")
}

/// The functions that formulas are handed to, made once.
struct Words {
    formula: Ident,
    entry: Ident,
}

impl Words {
    fn new() -> Self {
        let [formula, entry] = ["formula", "entry"].map(ident);
        Self { formula, entry }
    }
}

/// Writes formulas.
struct Document<'a> {
    words: Words,
    printer: Printer<'a>,
    derivation: &'a Derivation,
    parameters: &'a [&'a str],
    inputs: &'a [&'a str],
    unknowns: &'a [&'a str],
    /// Whether anything optional is there.
    has_some: bool,
}

/// What something is derived by.
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
    fn optional(&mut self, value: Option<TokenStream>) -> TokenStream {
        let Some(value) = value else { return quote!(None) };
        self.has_some = true;
        quote!(Some(#value))
    }

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

    fn name(&self, out: &mut Tokens, name: Name) {
        out.call(&self.words.formula, |inside| inside.append(string(&name.source())));
    }

    fn formula(&mut self, node: NodeId) -> TokenStream {
        let mut out = Tokens::default();
        out.call(&self.words.formula, |inside| inside.append(string(self.printer.source(node))));
        out.into()
    }

    /// Both sides of an equation, as lists hold them.
    fn sides(&mut self, out: &mut Tokens, left: Name, right: NodeId) {
        out.append(string(&left.source()));
        out.append(string(self.printer.source(right)));
    }

    fn equation(&mut self, left: Name, right: NodeId) -> TokenStream {
        let (left, right) = (string(&left.source()), string(self.printer.source(right)));
        quote!(derivation::equation(#left, #right))
    }

    /// name_1 = …, name_2 = …
    fn numbered(&mut self, name: &str, nodes: &[NodeId]) -> TokenStream {
        let mut out = Tokens::default();
        for (index, &node) in nodes.iter().enumerate() {
            self.sides(&mut out, Name::Plain(&format!("{name}{}", index + 1)), node);
        }
        out.by_macro("__equations")
    }

    fn matrix(&mut self, name: Name, factor: Option<NodeId>, rows: &[Row], columns: usize) -> TokenStream {
        let mut named = Tokens::default();
        self.name(&mut named, name);
        let name = TokenStream::from(named);
        let factor = factor.map(|node| self.formula(node));
        let factor = self.optional(factor);
        let mut entries = Tokens::default();
        for (index, row) in rows.iter().enumerate() {
            for (&column, &node) in row {
                entries.call(&self.words.entry, |inside| {
                    for place in [index, column] {
                        inside.append(Literal::usize_unsuffixed(place));
                        inside.punct(',');
                    }
                    inside.append(string(self.printer.source(node)));
                });
                entries.punct(',');
            }
        }
        let (rows, columns) = (Literal::usize_unsuffixed(rows.len()), Literal::usize_unsuffixed(columns));
        let entries = entries.slice();
        quote! {
            derivation::Matrix { name: #name, factor: #factor, rows: #rows, columns: #columns, entries: #entries }
        }
    }

    fn block(&mut self, number: usize, inverse: Option<&Inverse>) -> TokenStream {
        let block = &self.derivation.blocks[number];
        let number = (self.derivation.blocks.len() > 1).then_some(number + 1);
        let unknowns = list(&block.unknowns, |out, &place| self.name(out, Name::Plain(self.unknowns[place])));
        let equations = list(&block.equations, |out, &equation| out.append(Literal::usize_unsuffixed(equation)));
        let group = string(&block.group.words());
        let method = ident(if block.determinant.is_some() { "ClosedForm" } else { "Factorization" });
        let determinant =
            block.determinant.map(|determinant| self.equation(Name::Determinant(number), determinant.value));
        let determinant = self.optional(determinant);
        let inverse = inverse.map(|(factor, rows)| self.matrix(Name::Inverse(number), Some(*factor), rows, rows.len()));
        let inverse = self.optional(inverse);
        quote! {
            derivation::Block {
                unknowns: #unknowns,
                equations: #equations,
                group: #group,
                method: derivation::Method::#method,
                determinant: #determinant,
                inverse: #inverse
            }
        }
    }

    /// The derivatives of what is called so, by what it is derived by and then by name, where there is a
    /// formula.
    fn derivatives<N: AsRef<str>, F: Copy + Into<Option<NodeId>>>(
        &mut self,
        of: &[N],
        by: &[By<'_>],
        formulas: &[Vec<F>],
    ) -> TokenStream {
        let mut out = Tokens::default();
        for (by, formulas) in by.iter().zip(formulas) {
            for (of, &formula) in of.iter().zip(formulas) {
                if let Some(node) = formula.into() {
                    self.sides(&mut out, by.name(of.as_ref()), node);
                }
            }
        }
        out.by_macro("__equations")
    }

    /// Points and outputs, each component called by its prefix and the name.
    fn quantities(
        &mut self,
        names: &[&str],
        prefixes: &[&str],
        quantities: &[Quantity],
        formulas: &[QuantityFormulas],
    ) -> TokenStream {
        let (by_inputs, by_pairs, by_parameters) = (self.by_inputs(), self.by_pairs(), self.by_parameters());
        let all: Vec<_> = names.iter().zip(quantities).zip(formulas).collect();
        list(&all, |out, ((name, quantity), formulas)| {
            let components: Vec<String> = prefixes.iter().map(|prefix| format!("{prefix}{name}")).collect();
            let mut values = Tokens::default();
            for (component, &node) in components.iter().zip(&quantity.value) {
                self.sides(&mut values, Name::Plain(component), node);
            }
            let (name, values) = (string(name), values.by_macro("__equations"));
            let ratios = self.derivatives(&components, &by_inputs, &formulas.ratios);
            let second = self.derivatives(&components, &by_pairs, &formulas.ratio_derivatives);
            let first = nonzero(self.derivation, &formulas.sensitivities);
            let first = self.derivatives(&components, &by_parameters, &first);
            out.extend(quote! {
                derivation::Quantity {
                    name: #name,
                    value: #values,
                    ratios: #ratios,
                    ratio_derivatives: #second,
                    sensitivities: #first
                }
            });
        })
    }

    /// What was taken for granted: x ≠ 0, or that an expression has a value.
    fn condition(&mut self, out: &mut Tokens, condition: Condition) {
        let (node, relation) = match condition {
            Condition::NonZero(node) => (node, "!= 0"),
            Condition::Defined(node) => (node, "exists"),
        };
        let text = format!("{} {relation}", self.printer.source(node));
        out.call(&self.words.formula, |inside| inside.append(string(&text)));
    }
}
