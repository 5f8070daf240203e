//! `DERIVATION`: the derivation as data, every formula in three notations.

use std::collections::BTreeSet;

use proc_macro2::TokenStream;
use quote::quote;
use rustc_hash::FxHashMap;

use super::names::quoted;
use crate::derivation::{Derivation, Formulas, Inverse, Quantity, QuantityFormulas, RatioDerivatives, Row};
use crate::graph::{Condition, Formula, Name, NodeId, Printer, SymbolId};
use crate::model::{Driver, Mechanism};
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
    let parameters = mechanism.parameters.iter().map(|parameter| parameter.name.text.as_str()).collect();
    let printer = Printer::new(graph, &shown);
    let mut document = Document { printer, parameters, inputs: inputs.clone(), unknowns: unknowns.clone() };

    let title = driver.name.to_string();
    let residual = document.numbered("Psi", &derivation.residual);
    let j = document.matrix(Name::Plain("J"), None, &derivation.jacobian_unknowns(), unknowns.len());
    let a = document.matrix(Name::Plain("A"), None, &derivation.jacobian_inputs(), inputs.len());
    let blocks = formulas.inverses.iter().enumerate();
    let blocks: Vec<_> = blocks.map(|(number, inverse)| document.block(derivation, number, inverse.as_ref())).collect();
    let determinant =
        document.optional(formulas.determinant, |document, node| document.equation(Name::Determinant(None), node));
    let ratios = document.ratios(&formulas.ratios);
    let gamma = document.numbered("gamma", &derivation.gamma);
    let jerk = document.optional(derivation.eta.as_ref(), |document, eta| list(document.numbered("eta", eta)));
    let ratio_derivatives = document.optional(derivation.ratio_derivatives.as_ref(), |document, second| {
        list(document.ratio_derivatives(&second.pairs, &formulas.ratio_derivatives))
    });
    let sensitivity = document.optional(derivation.sensitivity.as_ref(), |document, first| {
        let jacobian = document.matrix(Name::Plain("Psi_p"), None, &first.jacobian, document.parameters.len());
        let equations = list(document.sensitivities(derivation, &formulas.sensitivities));
        format!("derivation::Sensitivity {{ jacobian: {jacobian}, formulas: {equations} }}")
    });
    let points: Vec<&str> = mechanism.points.iter().map(|point| point.name.text.as_str()).collect();
    let points = document.quantities(&points, &["x_", "y_"], derivation, &derivation.points, &formulas.points);
    let outputs: Vec<&str> = mechanism.outputs.iter().map(|output| output.name.text.as_str()).collect();
    let outputs = document.quantities(&outputs, &[""], derivation, &derivation.outputs, &formulas.outputs);
    let conditions = document.conditions(&formulas.conditions);
    let kernels = kernels.iter().map(|(function, operations)| {
        let Operations { functions, divisions, multiplications, additions } = *operations;
        format!("kernel({function:?}, [{functions}, {divisions}, {multiplications}, {additions}])")
    });
    let parameters = mechanism.parameters.iter().map(|parameter| named(&parameter.name.text));
    let fields = [
        ("parameters", list(parameters)),
        ("inputs", list(inputs.into_iter().map(named))),
        ("unknowns", list(unknowns.into_iter().map(named))),
        ("residual", list(residual)),
        ("jacobian_unknowns", j),
        ("jacobian_inputs", a),
        ("blocks", list(blocks)),
        ("determinant", determinant),
        ("ratios", list(ratios)),
        ("ratio_derivatives", ratio_derivatives),
        ("gamma", list(gamma)),
        ("jerk", jerk),
        ("sensitivity", sensitivity),
        ("points", list(points)),
        ("outputs", list(outputs)),
        ("conditions", list(conditions)),
        ("kernels", list(kernels)),
    ];
    let fields: Vec<String> = fields.into_iter().map(|(name, value)| format!("{name}: {value}")).collect();
    // Mostly strings: read as one text, which spares unoptimised macros a token at a time.
    let text = format!("&derivation::Derivation {{ mechanism: {title:?}, {} }}", fields.join(", "));
    let value: TokenStream = text.parse().unwrap_or_default();
    let driver = &driver.name;
    // J stands without a factor before it; a determinant may have no formula.
    let options = if text.contains("Some(") { quote!({None, Some}) } else { quote!(None) };
    quote! {
        const _: () = {
            use ::core::option::Option::#options;
            use #private::derivation::{self, entry, equation, formula, kernel, symbol};
            impl #driver {
                /// The derivation as data: every formula as text, `LaTeX` and `MathML`, the order of solution
                /// and the work of each function. It costs nothing where it is not used.
                pub const DERIVATION: &'static derivation::Derivation = #value;
            }
        };
    }
}

/// `&[…]`
fn list(items: impl IntoIterator<Item = String>) -> String {
    let items: Vec<String> = items.into_iter().collect();
    format!("&[{}]", items.join(", "))
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

fn written(formula: &Formula) -> String {
    let [unicode, latex, mathml] = [&formula.unicode, &formula.latex, &formula.mathml].map(|text| quoted(text));
    format!("formula({unicode}, {latex}, {mathml})")
}

fn named(name: &str) -> String {
    format!("symbol({name:?}, {})", written(&Name::Plain(name).formula()))
}

/// Writes formulas.
struct Document<'a> {
    printer: Printer<'a>,
    parameters: Vec<&'a str>,
    inputs: Vec<&'a str>,
    unknowns: Vec<&'a str>,
}

impl Document<'_> {
    fn formula(&mut self, node: NodeId) -> String {
        written(&self.printer.formula(node))
    }

    fn equation(&mut self, left: Name, right: NodeId) -> String {
        format!("equation({}, {})", written(&left.formula()), self.formula(right))
    }

    /// name_1 = …, name_2 = …
    fn numbered(&mut self, name: &str, nodes: &[NodeId]) -> Vec<String> {
        let numbered = nodes.iter().enumerate();
        numbered.map(|(index, &node)| self.equation(Name::Plain(&format!("{name}{}", index + 1)), node)).collect()
    }

    fn matrix(&mut self, name: Name, factor: Option<NodeId>, rows: &[Row], columns: usize) -> String {
        let name = written(&name.formula());
        let factor = self.optional(factor, |document, node| document.formula(node));
        let mut entries = Vec::new();
        for (index, row) in rows.iter().enumerate() {
            for (&column, &node) in row {
                entries.push(format!("entry({index}, {column}, {})", self.formula(node)));
            }
        }
        let (rows, entries) = (rows.len(), list(entries));
        format!(
            "derivation::Matrix {{ name: {name}, factor: {factor}, rows: {rows}, columns: {columns}, entries: {entries} }}"
        )
    }

    fn optional<V>(&mut self, value: Option<V>, write: impl FnOnce(&mut Self, V) -> String) -> String {
        value.map_or_else(|| "None".to_owned(), |value| format!("Some({})", write(self, value)))
    }

    fn block(&mut self, derivation: &Derivation, number: usize, inverse: Option<&Inverse>) -> String {
        let block = &derivation.blocks[number];
        let number = (derivation.blocks.len() > 1).then_some(number + 1);
        let unknowns = block.unknowns.iter().map(|&place| written(&Name::Plain(self.unknowns[place]).formula()));
        let unknowns = list(unknowns);
        let equations = list(block.equations.iter().map(ToString::to_string));
        let group = block.group.words();
        let method = if block.determinant.is_some() { "ClosedForm" } else { "Factorization" };
        let determinant = self.optional(block.determinant, |document, determinant| {
            document.equation(Name::Determinant(number), determinant.value)
        });
        let inverse = self.optional(inverse, |document, (factor, rows)| {
            document.matrix(Name::Inverse(number), Some(*factor), rows, rows.len())
        });
        format!(
            "derivation::Block {{ unknowns: {unknowns}, equations: {equations}, group: {group:?}, \
             method: derivation::Method::{method}, determinant: {determinant}, inverse: {inverse} }}"
        )
    }

    fn ratios(&mut self, formulas: &[Vec<Option<NodeId>>]) -> Vec<String> {
        let (inputs, unknowns) = (self.inputs.clone(), self.unknowns.clone());
        let mut ratios = Vec::new();
        for (by, of_input) in inputs.into_iter().zip(formulas) {
            for (&of, node) in unknowns.iter().zip(of_input) {
                ratios.extend(node.map(|node| self.equation(Name::Ratio { of, by }, node)));
            }
        }
        ratios
    }

    fn ratio_derivatives(&mut self, pairs: &[(usize, usize)], formulas: &[Vec<Option<NodeId>>]) -> Vec<String> {
        let unknowns = self.unknowns.clone();
        let mut derivatives = Vec::new();
        for (&(j, k), of_pair) in pairs.iter().zip(formulas) {
            let by = [self.inputs[j], self.inputs[k]];
            for (&of, node) in unknowns.iter().zip(of_pair) {
                derivatives.extend(node.map(|node| self.equation(Name::RatioDerivative { of, by }, node)));
            }
        }
        derivatives
    }

    /// Those that are not zero.
    fn sensitivities(&mut self, derivation: &Derivation, formulas: &[Vec<Option<NodeId>>]) -> Vec<String> {
        let (parameters, unknowns) = (self.parameters.clone(), self.unknowns.clone());
        let mut sensitivities = Vec::new();
        for (by, of_parameter) in parameters.into_iter().zip(formulas) {
            for (&of, node) in unknowns.iter().zip(of_parameter) {
                let node = node.filter(|&node| !derivation.graph.is_zero(node));
                sensitivities.extend(node.map(|node| self.equation(Name::Ratio { of, by }, node)));
            }
        }
        sensitivities
    }

    /// Points and outputs, each component called by its prefix and the name.
    fn quantities(
        &mut self,
        names: &[&str],
        prefixes: &[&str],
        derivation: &Derivation,
        quantities: &[Quantity],
        formulas: &[QuantityFormulas],
    ) -> Vec<String> {
        let inputs = self.inputs.clone();
        let mut all = Vec::new();
        for ((name, quantity), formulas) in names.iter().zip(quantities).zip(formulas) {
            let components: Vec<String> = prefixes.iter().map(|prefix| format!("{prefix}{name}")).collect();
            let mut values = Vec::new();
            for (component, &node) in components.iter().zip(&quantity.value) {
                values.push(self.equation(Name::Plain(component), node));
            }
            let mut rates = Vec::new();
            for (by, of_input) in inputs.iter().zip(&formulas.ratios) {
                for (of, &node) in components.iter().zip(of_input) {
                    rates.push(self.equation(Name::Ratio { of, by }, node));
                }
            }
            let mut second = Vec::new();
            let pairs = derivation.ratio_derivatives.iter().flat_map(|second| &second.pairs);
            for (&(j, k), of_pair) in pairs.zip(&formulas.ratio_derivatives) {
                let by = [inputs[j], inputs[k]];
                for (of, &node) in components.iter().zip(of_pair) {
                    second.push(self.equation(Name::RatioDerivative { of, by }, node));
                }
            }
            let mut sensitivities = Vec::new();
            for (by, of_parameter) in self.parameters.clone().into_iter().zip(&formulas.sensitivities) {
                for (of, &node) in components.iter().zip(of_parameter) {
                    if !derivation.graph.is_zero(node) {
                        sensitivities.push(self.equation(Name::Ratio { of, by }, node));
                    }
                }
            }
            let [values, rates, second, sensitivities] = [values, rates, second, sensitivities].map(list);
            all.push(format!(
                "derivation::Quantity {{ name: {name:?}, value: {values}, ratios: {rates}, \
                 ratio_derivatives: {second}, sensitivities: {sensitivities} }}"
            ));
        }
        all
    }

    /// What was taken for granted: x ≠ 0, or that an expression has a value.
    fn conditions(&mut self, conditions: &BTreeSet<Condition>) -> Vec<String> {
        let mut lines = Vec::new();
        for condition in conditions {
            let formula = match *condition {
                Condition::NonZero(node) => {
                    let Formula { unicode, latex, mathml } = self.printer.formula(node);
                    Formula {
                        unicode: format!("{unicode} ≠ 0"),
                        latex: format!("{latex} \\neq 0"),
                        mathml: format!("<mrow>{mathml}<mo>≠</mo><mn>0</mn></mrow>"),
                    }
                }
                Condition::Defined(node) => {
                    let Formula { unicode, latex, mathml } = self.printer.formula(node);
                    Formula {
                        unicode: format!("{unicode} exists"),
                        latex: format!("{latex} \\text{{ exists}}"),
                        mathml: format!("<mrow>{mathml}<mtext> exists</mtext></mrow>"),
                    }
                }
            };
            lines.push(written(&formula));
        }
        lines
    }
}
