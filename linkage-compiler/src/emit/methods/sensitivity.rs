//! Sensitivities to the parameters, of the unknowns and of points and outputs.

use std::borrow::Cow;

use proc_macro2::TokenStream;
use quote::quote;

use super::super::kernel::{Shape, Source};
use super::super::names::ident;
use super::closures::matrix_of;
use super::quantities::Members;
use super::{Body, Family, Kernels, Methods, argument_of, fenced, lines, literal};
use crate::algebra::simplify;
use crate::derivation::{Form, Formulas};
use crate::graph::{NodeId, SymbolId};
use crate::lower::{Stage, needed};

const ERRORS: [&str; 3] =
    ["", "# Errors", "`Singular` where J has no inverse, `NotFinite` where a formula has no finite value."];

impl Methods<'_> {
    pub(super) fn sensitivity(&mut self, mut kernels: Option<&mut Kernels>, formulas: Option<&Formulas>) {
        let (u, p) = (self.driver.unknowns.len(), self.mechanism.parameters.len());
        let (nu, np) = (literal(u), literal(p));
        let (pose, pose_type) = (self.arguments.pose.clone(), self.types.pose.clone());
        let columns: Vec<String> =
            self.mechanism.parameters.iter().map(|parameter| format!("`{}`", parameter.name.text)).collect();
        let mut docs = vec![
            "The sensitivity du/dp = -J^-1 `Psi_p` of the unknowns to the parameters, at fixed inputs; its columns"
                .to_owned(),
            format!("are {}.", columns.join(", ")),
        ];
        // du/dp by parameter and unknown: names, or zero.
        let mut solved: Vec<Vec<NodeId>> = Vec::new();
        let code = kernels.as_deref_mut().map(|kernels| {
            let systems = kernels.derivation.sensitivity_systems();
            let names = systems.iter().flat_map(|(_, names)| names);
            let formulas = formulas.into_iter().flat_map(|formulas| formulas.sensitivities.iter().flatten());
            let laws: Vec<String> = names
                .zip(formulas)
                .filter_map(|(&name, formula)| Some((name, (*formula)?)))
                .filter(|(_, formula)| !kernels.derivation.graph.is_zero(*formula))
                .map(|(name, formula)| {
                    format!("{} = {}", kernels.derivation.graph.symbol_name(name), kernels.text(formula))
                })
                .collect();
            docs.extend(fenced(laws.into_iter()));
            let mut stages;
            (stages, solved) = kernels.derivation.solve(&systems, Form::Factored);
            // The length of a link turns its own side of J: cos^2 + sin^2 is 1.
            let given = kernels.plan.angles().collect();
            for stage in &mut stages {
                if let Stage::Let { node, .. } = stage {
                    *node = simplify(&mut kernels.derivation.graph, &[*node], &given)[0];
                }
            }
            let places = (0..p).flat_map(|column| (0..u).map(move |row| (row, column)));
            let entries = places.zip(solved.concat());
            let entries: Vec<_> = entries.filter(|(_, node)| !kernels.derivation.graph.is_zero(*node)).collect();
            let returned = Stage::Return(entries.iter().map(|(_, node)| *node).collect());
            let stages = needed(&kernels.derivation.graph, stages.into_iter().chain([returned]).collect());
            let mut code = self.on_pose(kernels, Vec::new(), &stages);
            let values =
                entries.iter().zip(&code.results).map(|(&((row, column), _), value)| (row, column, value.clone()));
            let (lines, matrix) = matrix_of(values, u, p, &mut code.taken);
            let sensitivity = ident(&code.taken.unique("sensitivity"));
            let tail = quote! {
                #lines
                let #sensitivity = #matrix;
                finite_matrix(Self::NAME, "sensitivity", &#sensitivity)?;
                Ok(#sensitivity)
            };
            Body::new(code, tail, ["finite_matrix"])
        });
        docs.extend(lines(ERRORS));
        let pose = argument_of(&pose, code.as_ref());
        let signature = quote!(pub fn sensitivity(&self, #pose: &#pose_type<T>) -> Result<SMatrix<T, #nu, #np>, Error>);
        self.function(&docs, signature, code);
        for family in [Family::Points, Family::Outputs] {
            self.quantity_sensitivities(kernels.as_deref_mut(), formulas, family, &solved);
        }
    }

    fn quantity_sensitivities(
        &mut self,
        kernels: Option<&mut Kernels>,
        formulas: Option<&Formulas>,
        family: Family,
        solved: &[Vec<NodeId>],
    ) {
        let Some(members) = self.members(family) else { return };
        let Members { names, group, word, dimension, .. } = &members;
        let (pose, pose_type) = (self.arguments.pose.clone(), self.types.pose.clone());
        let (rows, np) = (literal(*dimension), literal(self.mechanism.parameters.len()));
        let mut docs = vec![
            format!(
                "The sensitivity of the {word}s to the parameters at fixed inputs, through the unknowns and their own formulas:"
            ),
            "`dl/dp = l_p + l_u du/dp`.".to_owned(),
        ];
        let code = kernels.map(|kernels| {
            let mut laws = Vec::new();
            for (name, formulas) in names.iter().zip(formulas.map_or(&[][..], |formulas| formulas.of(family))) {
                for (parameter, nodes) in self.mechanism.parameters.iter().zip(&formulas.sensitivities) {
                    if nodes.iter().any(|&node| !kernels.derivation.graph.is_zero(node)) {
                        laws.extend(members.laws(kernels, name, &format!("by_{}", parameter.name.field), nodes));
                    }
                }
            }
            docs.extend(fenced(laws.into_iter()));
            let mut nodes = Vec::new();
            for quantity in kernels.quantities(family).to_vec() {
                nodes.extend(kernels.derivation.quantity_sensitivities(&quantity, solved).concat());
            }
            let fields: Vec<(Cow<str>, SymbolId)> = kernels
                .derivation
                .sensitivity
                .iter()
                .flat_map(|first| first.names.iter().flatten().map(|&name| (Cow::from(""), name)))
                .collect();
            let source = Source {
                argument: Some(pose.clone()),
                from: quote!(self.sensitivity(#pose)?.data.0).into(),
                of: Shape::Columns(self.driver.unknowns.len()),
                fields,
            };
            let mut code = self.on_pose(kernels, vec![source], &[Stage::Return(nodes.clone())]);
            let mut bindings = TokenStream::new();
            let mut values = Vec::new();
            let columns = nodes.len() / (names.len() * dimension);
            let results = nodes.iter().zip(&code.results);
            let results: Vec<_> =
                results.map(|(&node, value)| (kernels.derivation.graph.is_zero(node), value)).collect();
            for (name, entries) in names.iter().zip(results.chunks(columns * dimension)) {
                let entries = entries.iter().enumerate().filter(|(_, (zero, _))| !zero);
                let entries =
                    entries.map(|(index, (_, value))| (index % dimension, index / dimension, (*value).clone()));
                let (lines, matrix) = matrix_of(entries, *dimension, columns, &mut code.taken);
                let value = ident(&code.taken.unique(&format!("{name}_sensitivity")));
                bindings.extend(quote! {
                    #lines
                    let #value = #matrix;
                    finite_matrix(Self::NAME, #word, &#value)?;
                });
                values.push(value);
            }
            let tail = quote!(#bindings Ok(#group { #(#names: #values),* }));
            // A call costs what the sensitivity of the unknowns costs, too.
            let inner = self.kernels.iter().find(|(name, _)| name == "sensitivity");
            code.operations = inner.map_or(code.operations, |(_, inner)| code.operations.plus(*inner));
            Body::new(code, tail, ["finite_matrix"])
        });
        docs.extend(lines(ERRORS));
        let name = ident(match family {
            Family::Points => "point_sensitivities",
            Family::Outputs => "output_sensitivities",
        });
        let pose = argument_of(&pose, code.as_ref());
        let signature =
            quote!(pub fn #name(&self, #pose: &#pose_type<T>) -> Result<#group<SMatrix<T, #rows, #np>>, Error>);
        self.function(&docs, signature, code);
    }
}
