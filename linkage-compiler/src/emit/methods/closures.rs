//! Psi and its Jacobians.

use proc_macro2::TokenStream;
use quote::quote;
use syn::{Attribute, Expr, ExprLit, Lit, Meta, MetaNameValue};

use super::super::names::ident;
use super::{Kernels, Methods, columns_of, fenced, literal};
use crate::derivation::Derivation;
use crate::graph::NodeId;
use crate::simplify::schedule::Stage;

impl Methods<'_> {
    pub(super) fn matrix_function(
        &mut self,
        kernels: Option<&Kernels>,
        name: &str,
        docs: &[String],
        of: &TokenStream,
        rows: Option<Vec<Vec<NodeId>>>,
    ) {
        let (pose, pose_type) = (&self.arguments.pose, &self.types.pose);
        let function = ident(name);
        let signature = quote!(#[must_use] pub fn #function(&self, #pose: &#pose_type<T>) -> #of);
        let code = kernels.zip(rows).map(|(kernels, rows)| {
            let columns = rows.first().map_or(0, Vec::len);
            let flat: Vec<NodeId> = (0..columns).flat_map(|column| rows.iter().map(move |row| row[column])).collect();
            let code = self.on_pose(kernels, Vec::new(), &[Stage::Return(flat)]);
            let matrix = columns_of(&code.results, rows.len());
            let body = code.body;
            (quote!(#body #matrix), code.operations)
        });
        let (body, operations) = code.unzip();
        self.function(docs, operations, &signature, body);
    }

    pub(super) fn closures(&mut self, kernels: Option<&mut Kernels>) {
        let kernels = kernels.as_deref();
        let (u, v) = (self.driver.unknowns.len(), self.driver.inputs.len());
        let (nu, nv) = (literal(u), literal(v));
        let nq = literal(u + v);
        let rows = |nodes: Option<&Vec<NodeId>>| nodes.map(|nodes| nodes.iter().map(|&node| vec![node]).collect());
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
        self.matrix_function(kernels, "residual", &docs, &quote!(SVector<T, #nu>), rows(residual));
        let docs =
            ["The sum of the magnitudes of each closure's terms: what makes a residual small or large.".to_owned()];
        self.matrix_function(
            kernels,
            "closure_sizes",
            &docs,
            &quote!(SVector<T, #nu>),
            rows(derivation.map(|d| &d.sizes)),
        );

        let matrix = |kernels: &Kernels, rows: &[Vec<NodeId>], symbol: &str| -> Vec<String> {
            let entries =
                rows.iter().enumerate().flat_map(|(i, row)| row.iter().enumerate().map(move |(j, &node)| (i, j, node)));
            let shown = entries.filter(|(_, _, node)| !kernels.derivation.graph.is_zero(*node));
            fenced(shown.map(|(i, j, node)| format!("{symbol}_{}{} = {}", i + 1, j + 1, kernels.text(node))))
        };
        let list = |indices: &[usize]| -> String {
            let names: Vec<String> =
                indices.iter().map(|&index| format!("`{}`", self.mechanism.coordinates[index].name.text)).collect();
            names.join(", ")
        };
        let order = self.mechanism.coordinate_order(self.driver);
        let (unknowns, inputs, all) = (list(&self.driver.unknowns), list(&self.driver.inputs), list(&order));
        let full = derivation.map(|derivation| derivation.jacobian.clone());
        let j = derivation.map(Derivation::jacobian_unknowns);
        let a = derivation.map(Derivation::jacobian_inputs);
        let mut docs = vec![format!("The constraint Jacobian J = `Psi_u`; its columns are {unknowns}.")];
        docs.extend(kernels.zip(j.as_ref()).map(|(k, rows)| matrix(k, rows, "J")).unwrap_or_default());
        self.matrix_function(kernels, "jacobian_unknowns", &docs, &quote!(SMatrix<T, #nu, #nu>), j.clone());
        let mut docs = vec![format!("The constraint Jacobian of the inputs A = `Psi_v`; its columns are {inputs}.")];
        docs.extend(kernels.zip(a.as_ref()).map(|(k, rows)| matrix(k, rows, "A")).unwrap_or_default());
        self.matrix_function(kernels, "jacobian_inputs", &docs, &quote!(SMatrix<T, #nu, #nv>), a);
        let docs = [format!("The whole constraint Jacobian `Psi_q`; its columns are {all}.")];
        self.matrix_function(kernels, "jacobian", &docs, &quote!(SMatrix<T, #nu, #nq>), full);
        self.determinant(kernels, j);
    }

    pub(super) fn determinant(&mut self, kernels: Option<&Kernels>, jacobian: Option<Vec<Vec<NodeId>>>) {
        let (pose, pose_type) = (self.arguments.pose.clone(), &self.types.pose);
        let signature = quote!(#[must_use] pub fn determinant(&self, #pose: &#pose_type<T>) -> T);
        let mut docs = vec!["det J, zero in the singular configurations.".to_owned()];
        let determinant = kernels.and_then(|kernels| kernels.derivation.determinant.map(|d| kernels.text(d.value)));
        let body = match (determinant, kernels.zip(jacobian)) {
            (Some(text), _) => {
                docs.extend(fenced([format!("det J = {text}")].into_iter()));
                Some(quote!(#pose.determinant))
            }
            (None, Some(_)) => {
                docs.push("Of a block of this size it is the product of the pivots of a factorisation.".to_owned());
                Some(quote!(product_of_pivots(self.jacobian_unknowns(#pose))))
            }
            (None, None) => None,
        };
        self.function(&docs, None, &signature, body);
    }
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
