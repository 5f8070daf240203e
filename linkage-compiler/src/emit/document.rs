//! `DERIVATION`: the derivation as data, every formula by its source.

use proc_macro2::{Delimiter, Ident, Literal, TokenStream};
use quote::quote;
use rustc_hash::FxHashMap;

use super::names::string;
use super::tokens::Tokens;
use crate::derivation::{Derivation, Formulas, Inverse, Quantity, QuantityFormulas, RatioDerivatives, Row, Scene};
use crate::graph::{Condition, Name, NodeId, Printer, SymbolId};
use crate::program::Operations;
use crate::model::{self, Driver, Mechanism};

/// The constant, in a scope of its own for the names that it uses.
pub(super) fn constant(
    mechanism: &Mechanism,
    driver: &Driver,
    derivation: &Derivation,
    formulas: &Formulas,
    kernels: &[(String, Operations)],
    private: &TokenStream,
) -> TokenStream {
    let [inputs, unknowns] = [&driver.inputs, &driver.unknowns].map(|places| texts(mechanism, places));
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

    let mut sections = Sections::of([&driver.name], [driver.name.to_string()]);
    for (name, symbols) in [("parameters", &parameters), ("inputs", &inputs), ("unknowns", &unknowns)] {
        sections.write(name, Some(symbols_of(symbols)));
    }
    sections.write("residual", Some(document.numbered("Psi", &derivation.residual)));
    let j = document.matrix(Name::Plain("J"), None, &derivation.jacobian_unknowns(), unknowns.len());
    sections.write("jacobian_unknowns", Some(j));
    let a = document.matrix(Name::Plain("A"), None, &derivation.jacobian_inputs(), inputs.len());
    sections.write("jacobian_inputs", Some(a));
    let mut blocks = Tokens::default();
    for (number, inverse) in formulas.inverses.iter().enumerate() {
        blocks.group(Delimiter::Bracket, document.block(number, inverse.as_ref()));
    }
    sections.write("blocks", Some(blocks));
    let determinant = formulas.determinant.map(|node| document.equation(Name::Determinant(None), node));
    sections.write("determinant", determinant);
    let (by_inputs, by_pairs, by_parameters) = (document.by_inputs(), document.by_pairs(), document.by_parameters());
    sections.write("ratios", Some(document.derivatives(&unknowns, &by_inputs, &formulas.ratios)));
    let asked = derivation.ratio_derivatives.is_some();
    let second = asked.then(|| document.derivatives(&unknowns, &by_pairs, &formulas.ratio_derivatives));
    sections.write("ratio_derivatives", second);
    sections.write("gamma", Some(document.numbered("gamma", &derivation.gamma)));
    let jerk = derivation.eta.as_ref().map(|eta| document.numbered("eta", eta));
    sections.write("jerk", jerk);
    let sensitivity = derivation.sensitivity.as_ref().map(|first| {
        let formulas = nonzero(derivation, &formulas.sensitivities);
        let mut both = Tokens::default();
        let jacobian = document.matrix(Name::Plain("Psi_p"), None, &first.jacobian, parameters.len());
        both.group(Delimiter::Bracket, jacobian);
        both.group(Delimiter::Bracket, document.derivatives(&unknowns, &by_parameters, &formulas));
        both
    });
    sections.write("sensitivity", sensitivity);
    let points: Vec<&str> = mechanism.points.iter().map(|point| point.name.text.as_str()).collect();
    let points = document.quantities(&points, &["x_", "y_"], &derivation.points, &formulas.points);
    sections.write("points", Some(points));
    let outputs: Vec<&str> = mechanism.outputs.iter().map(|output| output.name.text.as_str()).collect();
    let outputs = document.quantities(&outputs, &[""], &derivation.outputs, &formulas.outputs);
    sections.write("outputs", Some(outputs));
    let mut conditions = Tokens::default();
    for condition in &formulas.conditions {
        document.condition(&mut conditions, *condition);
    }
    sections.write("conditions", Some(conditions));
    sections.write("kernels", Some(works(kernels)));
    let sections = sections.0;
    quote!(#private::__derivation! { #sections })
}

/// The equations of motion of a scene, in a scope of its own likewise.
pub(super) fn of_scene(
    mechanism: &Mechanism,
    (driver, scene): (&Driver, &model::Scene),
    (derivation, derived): (&Derivation, &Scene),
    kernels: &[(String, Operations)],
    private: &TokenStream,
) -> TokenStream {
    let [inputs, unknowns] = [&driver.inputs, &driver.unknowns].map(|places| texts(mechanism, places));
    let mut names = names(mechanism, derivation, &inputs, &unknowns);
    for parameter in &mechanism.scene_parameters {
        names.insert(parameter.symbol, Name::Plain(&parameter.name.text));
    }
    let graph = &derivation.graph;
    let shown = |symbol: SymbolId| names.get(&symbol).copied().unwrap_or(Name::Plain(graph.symbol_name(symbol)));
    let own = scene.parameters.iter().map(|&place| mechanism.scene_parameters[place].name.text.as_str());
    let own: Vec<&str> = own.collect();
    let mut document = Document {
        printer: Printer::new(graph, &shown),
        derivation,
        parameters: &own,
        inputs: &inputs,
        unknowns: &unknowns,
    };
    let mut mass_matrix = Tokens::default();
    for (row, entries) in derived.mass_matrix.iter().flatten().enumerate() {
        for (column, &entry) in entries.iter().enumerate().skip(row) {
            let name = if inputs.len() == 1 { "M".to_owned() } else { format!("M{}{}", row + 1, column + 1) };
            document.sides(&mut mass_matrix, Name::Plain(&name), entry);
        }
    }
    let mut effects = Tokens::default();
    for (label, forces) in &derived.parts {
        if forces.iter().all(|&force| graph.is_zero(force)) {
            continue;
        }
        let mut sides = Tokens::default();
        for (index, &force) in forces.iter().enumerate().filter(|(_, force)| !graph.is_zero(**force)) {
            let name = if forces.len() == 1 { "Q".to_owned() } else { format!("Q{}", index + 1) };
            document.sides(&mut sides, Name::Plain(&name), force);
        }
        effects.append(string(label));
        effects.group(Delimiter::Bracket, sides);
    }
    let potential = !graph.is_zero(derived.potential);
    let potential = potential.then(|| document.equation(Name::Plain("V"), derived.potential));
    let mut sections = Sections::of([&scene.name], [scene.name.to_string(), driver.name.to_string()]);
    sections.write("parameters", Some(symbols_of(&own)));
    sections.write("mass_matrix", Some(mass_matrix));
    sections.write("forces", Some(effects));
    sections.write("potential", potential);
    sections.write("kernels", Some(works(kernels)));
    let sections = sections.0;
    quote!(#private::__scene_derivation! { #sections })
}

/// What the user calls these coordinates.
fn texts<'a>(mechanism: &'a Mechanism, places: &[usize]) -> Vec<&'a str> {
    places.iter().map(|&place| mechanism.coordinates[place].name.text.as_str()).collect()
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

/// The list of these symbols.
fn symbols_of(names: &[&str]) -> Tokens {
    let mut inside = Tokens::default();
    for name in names {
        inside.append(string(name));
    }
    inside
}

/// The list of what each function does.
fn works(kernels: &[(String, Operations)]) -> Tokens {
    let mut inside = Tokens::default();
    for (function, operations) in kernels {
        let Operations { functions, divisions, multiplications, additions } = *operations;
        inside.append(string(function));
        for count in [functions, divisions, multiplications, additions] {
            inside.append(Literal::usize_unsuffixed(count));
        }
    }
    inside
}

/// What a macro of the runtime is given: a type with its names, then lists by what they are called.
struct Sections(Tokens);

impl Sections {
    fn of<const N: usize, const M: usize>(types: [&Ident; N], names: [String; M]) -> Self {
        let mut tokens = Tokens::default();
        for name in types {
            tokens.ident(name);
        }
        for name in names {
            tokens.append(string(&name));
        }
        tokens.punct(',');
        Self(tokens)
    }

    /// `name [list]`, or the name alone.
    fn write(&mut self, name: &str, list: Option<Tokens>) {
        self.0.word(name);
        if let Some(list) = list {
            self.0.group(Delimiter::Bracket, list);
        }
    }
}

/// Writes formulas.
struct Document<'a> {
    printer: Printer<'a>,
    derivation: &'a Derivation,
    parameters: &'a [&'a str],
    inputs: &'a [&'a str],
    unknowns: &'a [&'a str],
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

    /// Both sides of an equation, as lists hold them.
    fn sides(&mut self, out: &mut Tokens, left: Name, right: NodeId) {
        out.append(string(&left.source()));
        out.append(string(self.printer.source(right)));
    }

    fn equation(&mut self, left: Name, right: NodeId) -> Tokens {
        let mut out = Tokens::default();
        self.sides(&mut out, left, right);
        out
    }

    /// name_1 = …, name_2 = …
    fn numbered(&mut self, name: &str, nodes: &[NodeId]) -> Tokens {
        let mut out = Tokens::default();
        for (index, &node) in nodes.iter().enumerate() {
            self.sides(&mut out, Name::Plain(&format!("{name}{}", index + 1)), node);
        }
        out
    }

    /// `name * factor rows columns [row column entry …]`
    fn matrix(&mut self, name: Name, factor: Option<NodeId>, rows: &[Row], columns: usize) -> Tokens {
        let mut out = Tokens::default();
        out.append(string(&name.source()));
        if let Some(factor) = factor {
            out.punct('*');
            out.append(string(self.printer.source(factor)));
        }
        out.append(Literal::usize_unsuffixed(rows.len()));
        out.append(Literal::usize_unsuffixed(columns));
        let mut entries = Tokens::default();
        for (index, row) in rows.iter().enumerate() {
            for (&column, &node) in row {
                entries.append(Literal::usize_unsuffixed(index));
                entries.append(Literal::usize_unsuffixed(column));
                entries.append(string(self.printer.source(node)));
            }
        }
        out.group(Delimiter::Bracket, entries);
        out
    }

    /// `unknowns; equations; "group" Method; [determinant]; [inverse]`
    fn block(&mut self, number: usize, inverse: Option<&Inverse>) -> Tokens {
        let block = &self.derivation.blocks[number];
        let number = (self.derivation.blocks.len() > 1).then_some(number + 1);
        let mut out = Tokens::default();
        for &place in &block.unknowns {
            out.append(string(&Name::Plain(self.unknowns[place]).source()));
        }
        out.punct(';');
        for &equation in &block.equations {
            out.append(Literal::usize_unsuffixed(equation));
        }
        out.punct(';');
        out.append(string(&block.group.words()));
        out.word(if block.determinant.is_some() { "ClosedForm" } else { "Factorization" });
        out.punct(';');
        if let Some(determinant) = block.determinant {
            out.group(Delimiter::Bracket, self.equation(Name::Determinant(number), determinant.value));
        }
        out.punct(';');
        if let Some((factor, rows)) = inverse {
            out.group(Delimiter::Bracket, self.matrix(Name::Inverse(number), Some(*factor), rows, rows.len()));
        }
        out
    }

    /// The derivatives of what is called so, by what it is derived by and then by name, where there is a
    /// formula.
    fn derivatives<N: AsRef<str>, F: Copy + Into<Option<NodeId>>>(
        &mut self,
        of: &[N],
        by: &[By<'_>],
        formulas: &[Vec<F>],
    ) -> Tokens {
        let mut out = Tokens::default();
        for (by, formulas) in by.iter().zip(formulas) {
            for (of, &formula) in of.iter().zip(formulas) {
                if let Some(node) = formula.into() {
                    self.sides(&mut out, by.name(of.as_ref()), node);
                }
            }
        }
        out
    }

    /// Points and outputs, each component called by its prefix and the name.
    fn quantities(
        &mut self,
        names: &[&str],
        prefixes: &[&str],
        quantities: &[Quantity],
        formulas: &[QuantityFormulas],
    ) -> Tokens {
        let (by_inputs, by_pairs, by_parameters) = (self.by_inputs(), self.by_pairs(), self.by_parameters());
        let mut out = Tokens::default();
        for ((name, quantity), formulas) in names.iter().zip(quantities).zip(formulas) {
            let components: Vec<String> = prefixes.iter().map(|prefix| format!("{prefix}{name}")).collect();
            let mut values = Tokens::default();
            for (component, &node) in components.iter().zip(&quantity.value) {
                self.sides(&mut values, Name::Plain(component), node);
            }
            let first = nonzero(self.derivation, &formulas.sensitivities);
            out.append(string(name));
            for list in [
                values,
                self.derivatives(&components, &by_inputs, &formulas.ratios),
                self.derivatives(&components, &by_pairs, &formulas.ratio_derivatives),
                self.derivatives(&components, &by_parameters, &first),
            ] {
                out.group(Delimiter::Bracket, list);
            }
        }
        out
    }

    /// What was taken for granted: x ≠ 0, or that an expression has a value.
    fn condition(&mut self, out: &mut Tokens, condition: Condition) {
        let (node, relation) = match condition {
            Condition::NonZero(node) => (node, "!= 0"),
            Condition::Defined(node) => (node, "exists"),
        };
        out.append(string(&format!("{} {relation}", self.printer.source(node))));
    }
}
