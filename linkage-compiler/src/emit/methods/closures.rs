//! Psi and its Jacobians.

use proc_macro2::{Ident, Punct, Spacing, TokenStream};
use quote::{TokenStreamExt, quote};
use syn::{Attribute, Expr, ExprLit, Lit, Meta, MetaNameValue};

use super::super::kernel::Operand;
use super::super::names::{Taken, ident};
use super::super::tokens::Tokens;
use super::super::types::field;
use super::{Body, Kernels, Methods, argument_of, columns_of, fenced, literal, without_result};
use crate::derivation::{Derivation, Row};
use crate::graph::NodeId;
use crate::lower::Stage;

impl Methods<'_> {
    pub(super) fn matrix_function(
        &mut self,
        kernels: Option<&Kernels>,
        name: &str,
        docs: &[String],
        of: Tokens,
        matrix: Option<(Vec<Row>, usize)>,
    ) {
        let pose_type = self.types.pose.clone();
        let code = kernels.zip(matrix).map(|(kernels, (rows, columns))| {
            let entries = entries(&rows, columns);
            let nodes = entries.iter().map(|(_, _, node)| *node).collect();
            let mut code = self.on_pose(kernels, Vec::new(), &[Stage::Return(nodes)]);
            let values = entries.into_iter().zip(std::mem::take(&mut code.results));
            let values = values.map(|((row, column, _), value)| (row, column, value));
            let (lines, matrix) = matrix_of(values, rows.len(), columns, &mut code.taken);
            Body::new(code, quote!(#lines #matrix), [])
        });
        let pose = argument_of(&self.arguments.pose, code.as_ref());
        let signature = self.words.total(name, [self.words.borrowed(&pose, &pose_type)], of);
        self.function(&without_result(docs.to_vec()), signature, code);
    }

    pub(super) fn closures(&mut self, kernels: Option<&mut Kernels>) {
        let mut kernels = kernels;
        self.jacobians(kernels.as_deref());
        self.jacobian_sizes(kernels.as_deref_mut());
        self.determinant(kernels);
    }

    fn jacobians(&mut self, kernels: Option<&Kernels>) {
        let (u, v) = (self.driver.unknowns.len(), self.driver.inputs.len());
        let column = |nodes: Option<&Vec<NodeId>>| {
            nodes.map(|nodes| (nodes.iter().map(|&node| Row::from([(0, node)])).collect(), 1))
        };
        let formula = |nodes: Option<&Vec<NodeId>>, symbol: &str| -> Vec<String> {
            let (Some(kernels), Some(nodes)) = (kernels, nodes) else { return Vec::new() };
            let lines =
                nodes.iter().enumerate().map(|(row, &node)| format!("{symbol}_{} = {}", row + 1, kernels.text(node)));
            fenced(lines)
        };
        let derivation = kernels.map(|kernels| &*kernels.derivation);
        let residual = derivation.map(|derivation| &derivation.residual);
        let mut docs = vec!["The closures Psi(q), zero where the mechanism is closed.".to_owned()];
        docs.extend(formula(residual, "Psi"));
        for closure in &self.mechanism.closures {
            docs.extend(words(&closure.attributes));
        }
        self.matrix_function(kernels, "residual", &docs, self.words.sized("SVector", [u]), column(residual));
        let docs =
            ["The sum of the magnitudes of each closure's terms: what makes a residual small or large.".to_owned()];
        self.matrix_function(
            kernels,
            "closure_sizes",
            &docs,
            self.words.sized("SVector", [u]),
            column(derivation.map(|d| &d.sizes)),
        );

        let matrix = |kernels: &Kernels, rows: &[Row], symbol: &str| -> Vec<String> {
            let entries = rows.iter().enumerate().flat_map(|(i, row)| row.iter().map(move |(j, &node)| (i, j, node)));
            fenced(entries.map(|(i, j, node)| format!("{symbol}_{}{} = {}", i + 1, j + 1, kernels.text(node))))
        };
        let list = |indices: &[usize]| -> String {
            let names: Vec<String> =
                indices.iter().map(|&index| format!("`{}`", self.mechanism.coordinates[index].name.text)).collect();
            names.join(", ")
        };
        let order = self.mechanism.coordinate_order(self.driver);
        let (unknowns, inputs, all) = (list(&self.driver.unknowns), list(&self.driver.inputs), list(&order));
        let j = derivation.map(Derivation::jacobian_unknowns);
        let a = derivation.map(Derivation::jacobian_inputs);
        let mut docs = vec![format!("The constraint Jacobian J = `Psi_u`; its columns are {unknowns}.")];
        docs.extend(kernels.zip(j.as_ref()).map(|(k, rows)| matrix(k, rows, "J")).unwrap_or_default());
        self.matrix_function(
            kernels,
            "jacobian_unknowns",
            &docs,
            self.words.sized("SMatrix", [u, u]),
            j.map(|rows| (rows, u)),
        );
        let mut docs = vec![format!("The constraint Jacobian of the inputs A = `Psi_v`; its columns are {inputs}.")];
        docs.extend(kernels.zip(a.as_ref()).map(|(k, rows)| matrix(k, rows, "A")).unwrap_or_default());
        self.matrix_function(
            kernels,
            "jacobian_inputs",
            &docs,
            self.words.sized("SMatrix", [u, v]),
            a.map(|rows| (rows, v)),
        );
        let docs = [format!("The whole constraint Jacobian `Psi_q`; its columns are {all}.")];
        let names = |indices: &[usize]| -> Vec<Ident> {
            indices.iter().map(|&index| field(&self.mechanism.coordinates[index].name)).collect()
        };
        let (unknowns, inputs, all) = (names(&self.driver.unknowns), names(&self.driver.inputs), names(&order));
        let pose = self.arguments.pose.clone();
        let body = kernels.map(|_| {
            let columns = quote! {
                let [#(#unknowns),*] = self.jacobian_unknowns(#pose).data.0;
                let [#(#inputs),*] = self.jacobian_inputs(#pose).data.0;
                SMatrix::from([#(#all),*])
            };
            Body::plain(columns, [&pose], [])
        });
        let pose_type = self.types.pose.clone();
        let pose = argument_of(&pose, body.as_ref());
        let signature = self.words.total(
            "jacobian",
            [self.words.borrowed(&pose, &pose_type)],
            self.words.sized("SMatrix", [u, u + v]),
        );
        self.function(&without_result(docs.to_vec()), signature, body);
    }

    fn jacobian_sizes(&mut self, kernels: Option<&mut Kernels>) {
        let (u, v) = (self.driver.unknowns.len(), self.driver.inputs.len());
        let pose_type = self.types.pose.clone();
        let code = kernels.map(|kernels| {
            let sizes = kernels.derivation.jacobian_sizes();
            let sizes = [(entries(&sizes[0], u), u), (entries(&sizes[1], v), v)];
            let nodes = sizes.iter().flat_map(|(entries, _)| entries.iter().map(|(_, _, node)| *node)).collect();
            let mut code = self.on_pose(kernels, Vec::new(), &[Stage::Return(nodes)]);
            let mut results = std::mem::take(&mut code.results).into_iter();
            let [(lines_u, of_u), (lines_v, of_v)] = sizes.map(|(entries, columns)| {
                let values = entries.into_iter().zip(results.by_ref());
                let values = values.map(|((row, column, _), value)| (row, column, value));
                matrix_of(values, u, columns, &mut code.taken)
            });
            Body::new(code, quote!(#lines_u #lines_v (#of_u, #of_v)), [])
        });
        let pose = argument_of(&self.arguments.pose, code.as_ref());
        let docs = ["The largest magnitude that each entry of J and of A could have at these lengths.".to_owned()];
        let signature = {
            let [of_u, of_v] = [u, v].map(|columns| self.words.sized("SMatrix", [u, columns]));
            self.words.total("jacobian_sizes", [self.words.borrowed(&pose, &pose_type)], quote!((#of_u, #of_v)).into())
        };
        self.function(&without_result(docs.to_vec()), signature, code);
    }

    fn determinant(&mut self, kernels: Option<&mut Kernels>) {
        let (pose, pose_type) = (self.arguments.pose.clone(), self.types.pose.clone());
        let mut docs = vec!["det J, zero in the singular configurations.".to_owned()];
        let mut blocks_docs =
            vec!["The determinants of the blocks of J, in the order in which the blocks are solved.".to_owned()];
        let (mut whole, mut parts, mut count) = (None, None, 0);
        if let Some(kernels) = kernels {
            let formula = kernels.derivation.determinant();
            match formula {
                Some(node) => docs.extend(fenced([format!("det J = {}", kernels.text(node))].into_iter())),
                None => docs.push("Of blocks of more than two unknowns it is the product of the pivots.".to_owned()),
            }
            let (mut stages, mut factors) = (Vec::new(), Vec::new());
            let mut lines = Vec::new();
            for (number, block) in kernels.derivation.blocks.clone().iter().enumerate() {
                let names = block.names(kernels.derivation);
                let Some(determinant) = block.determinant else {
                    let symbol = kernels.derivation.graph.symbol(format!("pivots_{}", number + 1));
                    stages.push(Stage::Pivots { symbol, matrix: kernels.derivation.block_matrix(block) });
                    factors.push(kernels.derivation.graph.variable(symbol));
                    lines.push(format!("{names} ({}): the product of the pivots", block.group.words()));
                    continue;
                };
                let varies = kernels.derivation.graph.constant_value(determinant.value).is_none();
                let named = kernels.derivation.graph.variable(determinant.symbol);
                factors.push(if varies { named } else { determinant.value });
                lines.push(format!("{names} ({}): {}", block.group.words(), kernels.text(determinant.value)));
            }
            blocks_docs.extend(fenced(lines.into_iter()));
            count = factors.len();
            let minus = kernels.derivation.is_odd.then(|| quote!(-));
            let names: Vec<Ident> = match count {
                1 => vec![ident("determinant")],
                _ => (1..=count).map(|number| ident(&format!("determinant_{number}"))).collect(),
            };
            let mut product = quote!(let [#(#names),*] = self.block_determinants(#pose); #minus);
            for (index, name) in names.into_iter().enumerate() {
                if index > 0 {
                    product.append(Punct::new('*', Spacing::Alone));
                }
                product.append(name);
            }
            whole = Some(Body::plain(product, [&pose], []));
            stages.push(Stage::Return(factors));
            let code = self.on_pose(kernels, Vec::new(), &stages);
            let results = &code.results;
            let tail = quote!([#(#results),*]);
            parts = Some(Body::new(code, tail, []));
        }
        let own = argument_of(&pose, whole.as_ref());
        let signature = self.words.total("determinant", [self.words.borrowed(&own, &pose_type)], self.words.scalar());
        self.function(&without_result(docs), signature, whole);
        let pose = argument_of(&pose, parts.as_ref());
        let count = literal(count);
        let of = quote!([T; #count]).into();
        let signature = self.words.total("block_determinants", [self.words.borrowed(&pose, &pose_type)], of);
        self.function(&without_result(blocks_docs), signature, parts);
    }
}

/// Row, column and node of each entry, column by column.
fn entries(rows: &[Row], columns: usize) -> Vec<(usize, usize, NodeId)> {
    let column = |c: usize| rows.iter().enumerate().filter_map(move |(r, row)| Some((r, c, *row.get(&c)?)));
    (0..columns).flat_map(column).collect()
}

/// A matrix larger than this is written entry by entry if most entries are zero.
const LARGEST_DENSE: usize = 16;

/// A matrix from its entries, which come column by column, as an expression after the lines that it needs;
/// those not named are zero.
pub(super) fn matrix_of(
    entries: impl Iterator<Item = (usize, usize, Operand)>,
    rows: usize,
    columns: usize,
    taken: &mut Taken,
) -> (TokenStream, TokenStream) {
    let entries: Vec<_> = entries.collect();
    if entries.is_empty() && rows * columns > LARGEST_DENSE {
        return (TokenStream::new(), quote!(SMatrix::zeros()));
    }
    if rows * columns > LARGEST_DENSE && 2 * entries.len() < rows * columns {
        let matrix = ident(&taken.unique("matrix"));
        let lines = entries.iter().map(|(row, column, value)| {
            let (row, column) = (literal(*row), literal(*column));
            quote!(#matrix[#column][#row] = #value;)
        });
        let (rows, columns) = (literal(rows), literal(columns));
        let lines = quote!(let mut #matrix = [[T::zero(); #rows]; #columns]; #(#lines)*);
        return (lines, quote!(SMatrix::from(#matrix)));
    }
    let mut flat = vec![Operand::Constant(quote!(T::zero()).into()); rows * columns];
    for (row, column, value) in entries {
        flat[column * rows + row] = value;
    }
    (TokenStream::new(), columns_of(&flat, rows))
}

/// What the user said of a closure, as a paragraph.
fn words(attributes: &[Attribute]) -> Vec<String> {
    let mut lines = Vec::new();
    for attribute in attributes.iter().filter(|attribute| attribute.path().is_ident("doc")) {
        if let Meta::NameValue(MetaNameValue { value: Expr::Lit(ExprLit { lit: Lit::Str(text), .. }), .. }) =
            &attribute.meta
        {
            lines.push(text.value().trim().to_owned());
        }
    }
    if !lines.is_empty() {
        lines.insert(0, String::new());
    }
    lines
}
