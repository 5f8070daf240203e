//! The functions of a mechanism: one kernel each, in the order in which a mechanic derives them.

mod acceleration;
mod block;
mod closures;
mod motion;
mod position;
mod quantities;
mod velocity;

use std::collections::BTreeSet;

use proc_macro2::{Delimiter, Group, Ident, Literal, TokenStream, TokenTree};
use quote::{ToTokens, TokenStreamExt, quote};

use super::Types;
use super::kernel::{self, Code, Given, Operand, Source};
use super::names::{RUNTIME_FUNCTIONS, ident, unique};
use super::pose::PosePlan;
use super::types::field;
use crate::derivation::{Derivation, Form};
use crate::graph::{NodeId, SymbolId};
use crate::model::{Driver, Mechanism};
use crate::simplify::schedule::{Operations, Stage};

/// The name of an argument, beside which no name of the user's may stand.
pub(super) fn argument(mechanism: &Mechanism, wish: &str) -> String {
    let mut name = wish.to_owned();
    let parameters = mechanism.parameters.iter().map(|parameter| &parameter.name.field);
    let all: Vec<&String> =
        parameters.chain(mechanism.coordinates.iter().map(|coordinate| &coordinate.name.field)).collect();
    while all.contains(&&name) {
        name.push('_');
    }
    name
}

/// The arguments that functions have in common.
struct Arguments {
    pose: Ident,
    q: Ident,
    rate: Ident,
    acceleration: Ident,
    right: Ident,
}

struct Methods<'a> {
    mechanism: &'a Mechanism,
    driver: &'a Driver,
    types: &'a Types,
    arguments: Arguments,
    /// Names that kernels must not give to values of their own.
    reserved: Vec<String>,
    named: Vec<(NodeId, String)>,
    functions: TokenStream,
    /// The identifiers of the functions written so far.
    written: BTreeSet<String>,
}

/// The `impl` blocks of one driver; without a derivation every body is left open.
pub(super) fn of_driver(
    mechanism: &Mechanism,
    driver: &Driver,
    types: &Types,
    plan: Option<&PosePlan>,
    derivation: Option<&mut Derivation>,
    private: &TokenStream,
) -> TokenStream {
    let name = |wish: &str| ident(&argument(mechanism, wish));
    let arguments = Arguments {
        pose: name("pose"),
        q: name("q"),
        rate: name("rate"),
        acceleration: name("acceleration"),
        right: name("right"),
    };
    let reserved = [&arguments.pose, &arguments.q, &arguments.rate, &arguments.acceleration, &arguments.right]
        .map(ToString::to_string)
        .to_vec();
    let mut methods = Methods {
        mechanism,
        driver,
        types,
        arguments,
        reserved,
        named: mechanism.named.clone(),
        functions: TokenStream::new(),
        // The block itself compares signs.
        written: BTreeSet::from(["same_signs".to_owned()]),
    };
    let mut kernels = derivation.zip(plan).map(|(derivation, plan)| Kernels::new(derivation, plan));
    if let Some(kernels) = &kernels {
        methods.name_points(kernels.derivation);
    }
    methods.position(kernels.as_mut());
    methods.closures(kernels.as_mut());
    methods.velocity(kernels.as_mut());
    methods.acceleration(kernels.as_mut());
    methods.quantities(kernels.as_mut(), Family::Points);
    methods.quantities(kernels.as_mut(), Family::Outputs);
    methods.motion(kernels.as_mut());
    methods.block(kernels.as_ref(), private)
}

/// A derivation and the pose planned for it.
struct Kernels<'a> {
    derivation: &'a mut Derivation,
    plan: &'a PosePlan,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Family {
    Points,
    Outputs,
}

impl<'a> Kernels<'a> {
    fn new(derivation: &'a mut Derivation, plan: &'a PosePlan) -> Self {
        Self { derivation, plan }
    }

    fn rates(&self, of: &[usize]) -> Vec<SymbolId> {
        of.iter().map(|&index| self.derivation.coordinates[index].rate).collect()
    }

    fn accelerations(&self, of: &[usize]) -> Vec<SymbolId> {
        of.iter().map(|&index| self.derivation.coordinates[index].acceleration).collect()
    }

    fn variables(&mut self, symbols: &[SymbolId]) -> Vec<NodeId> {
        symbols.iter().map(|&symbol| self.derivation.graph.variable(symbol)).collect()
    }

    /// Names for W, by unknown and input.
    fn ratio_symbols(&mut self) -> Vec<Vec<SymbolId>> {
        let single = self.derivation.inputs.len() == 1;
        let inputs = self.derivation.inputs.clone();
        let unknowns = self.derivation.unknowns.clone();
        let mut columns = Vec::new();
        for input in inputs {
            let mut column = Vec::new();
            for &unknown in &unknowns {
                let (of, by) = (&self.derivation.coordinates[unknown].name, &self.derivation.coordinates[input].name);
                let name = if single { format!("{of}_ratio") } else { format!("{of}_by_{by}") };
                column.push(self.derivation.graph.symbol(name));
            }
            columns.push(column);
        }
        columns
    }

    fn ratio_stages(&mut self) -> (Vec<Stage>, Vec<Vec<SymbolId>>) {
        let symbols = self.ratio_symbols();
        let systems: Vec<_> = symbols
            .iter()
            .enumerate()
            .map(|(input, targets)| (self.derivation.ratio_side(input), targets.clone()))
            .collect();
        (self.derivation.solution(&systems, Form::Factored), symbols)
    }

    fn text(&self, node: NodeId) -> String {
        self.derivation.graph.text(node)
    }
}

impl Methods<'_> {
    /// Partial results are called after the points and outputs that they are.
    fn name_points(&mut self, derivation: &Derivation) {
        let mut name = |nodes: &[NodeId], name: &str, suffix: &str| {
            let axes: &[&str] = if nodes.len() == 2 { &["_x", "_y"] } else { &[""] };
            self.named.extend(nodes.iter().zip(axes).map(|(&node, axis)| (node, format!("{name}{axis}{suffix}"))));
        };
        for (quantity, declared) in derivation.points.iter().zip(self.mechanism.points.iter().map(|p| &p.name.field)) {
            name(&quantity.value, declared, "");
            name(&quantity.rate, declared, "_rate");
            name(&quantity.acceleration, declared, "_acceleration");
        }
        for (quantity, declared) in derivation.outputs.iter().zip(self.mechanism.outputs.iter().map(|o| &o.name.field))
        {
            name(&quantity.value, declared, "");
            name(&quantity.rate, declared, "_rate");
        }
    }

    // Sources of symbols.

    fn parameters(&self) -> Source {
        let fields = self.mechanism.parameters.iter().map(|p| (p.name.field.clone(), p.symbol)).collect();
        Source { from: quote!(*self), of: Some(quote!(Self)), fields }
    }

    fn pose_source(&self, kernels: &Kernels) -> Source {
        let mut fields: Vec<_> =
            kernels.plan.values.iter().map(|(_, field, symbol)| (field.clone(), *symbol)).collect();
        fields.extend(kernels.plan.determinants.iter().map(|(_, field, symbol)| (field.clone(), *symbol)));
        // Directions are fields as well, so that the pattern is never complete.
        fields.extend(kernels.plan.directions.iter().map(|(_, field)| (field.clone(), SymbolId::NONE)));
        let (pose, of) = (&self.arguments.pose, &self.types.pose);
        Source { from: quote!(*#pose), of: Some(quote!(#of)), fields }
    }

    fn coordinates(
        &self,
        kernels: &Kernels,
        from: &TokenStream,
        symbol: fn(&crate::derivation::Coordinate) -> SymbolId,
    ) -> Source {
        let fields = kernels.derivation.coordinates.iter().map(|c| (c.name.clone(), symbol(c))).collect();
        let of = &self.types.coordinates;
        Source { from: from.clone(), of: Some(quote!(#of)), fields }
    }

    fn inputs(
        &self,
        kernels: &Kernels,
        from: &Ident,
        symbol: fn(&crate::derivation::Coordinate) -> SymbolId,
    ) -> Source {
        let fields = kernels
            .derivation
            .inputs
            .iter()
            .map(|&index| &kernels.derivation.coordinates[index])
            .map(|c| (c.name.clone(), symbol(c)))
            .collect();
        let of = &self.types.inputs;
        Source { from: quote!(#from.into()), of: Some(quote!(#of)), fields }
    }

    /// A kernel on a pose and what else it is given.
    fn on_pose(&self, kernels: &Kernels, sources: Vec<Source>, stages: &[Stage]) -> Code {
        let mut all = vec![self.parameters(), self.pose_source(kernels)];
        all.extend(sources);
        let given = Given { sources: all, pose: Some(kernels.plan) };
        kernel::write(kernels.derivation, &given, stages, &self.named, &self.reserved)
    }

    // Functions.

    fn function(
        &mut self,
        docs: &[String],
        operations: Option<Operations>,
        signature: &TokenStream,
        body: Option<TokenStream>,
    ) {
        let mut lines: Vec<String> =
            docs.iter().map(|line| if line.is_empty() { String::new() } else { format!(" {line}") }).collect();
        if let Some(operations) = operations.filter(|operations| *operations != Operations::default()) {
            lines.push(String::new());
            lines.push(format!(" Operations: {}.", count(operations)));
        }
        let body = body.unwrap_or_else(|| quote!(::core::unreachable!()));
        let used = identifiers(&body);
        let signature = without_unused(signature, &used, &self.reserved);
        self.written.extend(used);
        self.written.extend(identifiers(&signature));
        self.functions.extend(quote!(#(#[doc = #lines])* #signature));
        // A body in its braces is one token, however long.
        self.functions.append(Group::new(Delimiter::Brace, body));
    }

    fn coordinate_fields(&self) -> Vec<Ident> {
        let order = self.mechanism.coordinate_order(self.driver);
        order.iter().map(|&index| field(&self.mechanism.coordinates[index].name)).collect()
    }
}

/// What the functions use of the runtime, in the order in which rustfmt sorts it.
fn imports(written: &BTreeSet<String>) -> Vec<Ident> {
    let always = ["Error", "Mechanism", "Real", "SMatrix", "SVector", "Solution"];
    let types = ["Factorization", "OutputMotion", "PointMotion", "Vector2"];
    let mut names: Vec<&str> = always.to_vec();
    names.extend(types.iter().filter(|name| written.contains(**name)));
    names.sort_unstable();
    names.extend(RUNTIME_FUNCTIONS.iter().filter(|name| written.contains(**name)));
    names.into_iter().map(ident).collect()
}

/// A signature whose arguments are marked as unused where they are.
fn without_unused(signature: &TokenStream, used: &BTreeSet<String>, arguments: &[String]) -> TokenStream {
    let tokens = signature.clone().into_iter().map(|token| match token {
        TokenTree::Group(group) if group.delimiter() == Delimiter::Parenthesis => {
            let inside = group.stream().into_iter().map(|token| match token {
                TokenTree::Ident(name) if arguments.iter().any(|a| name == a) && !used.contains(&name.to_string()) => {
                    TokenTree::Ident(ident(&format!("_{name}")))
                }
                token => token,
            });
            TokenTree::Group(Group::new(Delimiter::Parenthesis, inside.collect()))
        }
        token => token,
    });
    tokens.collect()
}

/// Every identifier of emitted code.
fn identifiers(tokens: &TokenStream) -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    let mut streams = vec![tokens.clone()];
    while let Some(stream) = streams.pop() {
        for token in stream {
            match token {
                TokenTree::Group(group) => streams.push(group.stream()),
                TokenTree::Ident(ident) => drop(found.insert(ident.to_string())),
                TokenTree::Punct(_) | TokenTree::Literal(_) => {}
            }
        }
    }
    found
}

/// A size without suffix, as people write it.
fn literal(count: usize) -> Literal {
    Literal::usize_unsuffixed(count)
}

/// `name: value`, or `name` alone if the value is called so.
fn member(name: &Ident, value: &Operand) -> TokenStream {
    match value {
        Operand::Name(value) if value == name => quote!(#name),
        value => quote!(#name: #value),
    }
}

/// A body with its last lines.
fn ending(mut body: TokenStream, tail: TokenStream) -> TokenStream {
    body.extend(tail);
    body
}

fn lines<const N: usize>(lines: [&str; N]) -> Vec<String> {
    lines.map(str::to_owned).to_vec()
}

fn fenced(lines: impl Iterator<Item = String>) -> Vec<String> {
    let mut block = vec![String::new(), "```text".to_owned()];
    block.extend(lines);
    block.push("```".to_owned());
    block
}

fn count(operations: Operations) -> String {
    let Operations { multiplications, additions, divisions, functions } = operations;
    let parts = [
        (functions, "function", "functions"),
        (divisions, "division", "divisions"),
        (multiplications, "multiplication", "multiplications"),
        (additions, "addition", "additions"),
    ];
    let parts: Vec<String> = parts
        .into_iter()
        .filter(|(count, ..)| *count > 0)
        .map(|(count, one, many)| format!("{count} {}", if count == 1 { one } else { many }))
        .collect();
    parts.join(", ")
}

/// A matrix from its entries, column by column.
fn columns_of(entries: &[impl ToTokens], rows: usize) -> TokenStream {
    let columns = entries.chunks(rows).map(|column| quote!([#(#column),*]));
    quote!(SMatrix::from([#(#columns),*]))
}

/// The names of the components of points and outputs, in the order in which kernels return them.
fn component_names(names: &[Ident], dimension: usize, orders: &[&str]) -> Vec<String> {
    let axes: &[&str] = if dimension == 2 { &["_x", "_y"] } else { &[""] };
    let mut all = Vec::new();
    for name in names {
        for order in orders {
            all.extend(axes.iter().map(|axis| format!("{name}{axis}{order}")));
        }
    }
    all
}

/// `finite(NAME, what, [values])?;`, each value once.
fn check_finite(what: &str, values: &[Operand]) -> TokenStream {
    let mut seen = BTreeSet::new();
    let values: Vec<_> = values
        .iter()
        .filter(|value| match value {
            Operand::Name(name) => seen.insert(name),
            Operand::Constant(_) => false,
            Operand::Formula(_) => true,
        })
        .collect();
    if values.is_empty() {
        return TokenStream::new();
    }
    quote!(finite(Self::NAME, #what, [#(#values),*])?;)
}

/// Gives a name to every result that is not one already.
fn bind(results: &[Operand], wishes: &[String], taken: &mut BTreeSet<String>) -> (TokenStream, Vec<Operand>) {
    let mut bindings = TokenStream::new();
    let mut names = Vec::new();
    for (result, wish) in results.iter().zip(wishes) {
        names.push(match result {
            Operand::Formula(formula) => {
                let name = ident(&unique(taken, wish));
                bindings.extend(quote!(let #name = #formula;));
                Operand::Name(name)
            }
            named => named.clone(),
        });
    }
    (bindings, names)
}
