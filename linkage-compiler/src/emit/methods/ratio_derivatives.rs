//! The derivatives of the velocity ratios, of the unknowns and of points and outputs.

use proc_macro2::TokenStream;
use quote::quote;

use super::super::kernel::Operand;
use super::super::names::ident;
use super::quantities::Members;
use super::{Body, Family, Kernels, Methods, argument_of, bind, check_finite, columns_of, fenced, lines, literal};
use crate::derivation::{Form, Formulas};
use crate::graph::NodeId;
use crate::lower::{Stage, needed};

impl Kernels<'_> {
    /// Stages that name W and L, and L by pair of inputs and unknown.
    fn ratio_derivative_stages(&mut self) -> (Vec<Stage>, Vec<Vec<NodeId>>) {
        let systems = self.derivation.ratio_derivative_systems();
        let (stages, mut solved) = self.derivation.solve(&systems, Form::Entries);
        let derivatives = solved.split_off(self.derivation.inputs.len());
        (stages, derivatives)
    }

    /// A symmetric matrix from its entries by pair, each of which is a name.
    fn symmetric(&self, entries: &[Operand]) -> TokenStream {
        let count = self.derivation.inputs.len();
        let Some(derivatives) = &self.derivation.ratio_derivatives else { return TokenStream::new() };
        let place = |k: usize, j: usize| entries[derivatives.place(j, k)].clone();
        let columns: Vec<Operand> = (0..count).flat_map(|k| (0..count).map(move |j| place(k, j))).collect();
        columns_of(&columns, count)
    }
}

const ERRORS: [&str; 3] =
    ["", "# Errors", "`Singular` where J has no inverse, `NotFinite` where a formula has no finite value."];

impl Methods<'_> {
    pub(super) fn ratio_derivatives(&mut self, mut kernels: Option<&mut Kernels>, formulas: Option<&Formulas>) {
        let (u, v) = (self.driver.unknowns.len(), self.driver.inputs.len());
        let (nu, nv) = (literal(u), literal(v));
        let (pose, pose_type) = (self.arguments.pose.clone(), self.types.pose.clone());
        let mut docs = lines([
            "The derivatives of the velocity ratios, d2u/dv dv: of each unknown a symmetric matrix `L` with",
            "u'' = W v'' + v' . `L` v'; from `J L_jk = -(Psi_q w_j)_q w_k`, where `w_j = (W_j, e_j)`.",
        ]);
        let code = kernels.as_deref_mut().map(|kernels| {
            let names = kernels.derivation.ratio_derivatives.iter().flat_map(|second| second.names.iter().flatten());
            let names: Vec<_> = names.copied().collect();
            let formulas = formulas.into_iter().flat_map(|formulas| formulas.ratio_derivatives.iter().flatten());
            let laws: Vec<String> = names
                .iter()
                .zip(formulas)
                .filter_map(|(&name, formula)| {
                    Some(format!("{} = {}", kernels.derivation.graph.symbol_name(name), kernels.text((*formula)?)))
                })
                .collect();
            docs.extend(fenced(laws.into_iter()));
            let (mut stages, solved) = kernels.ratio_derivative_stages();
            stages.push(Stage::Return(solved.concat()));
            let stages = needed(&kernels.derivation.graph, stages);
            let mut code = self.on_pose(kernels, Vec::new(), &stages);
            let wishes: Vec<String> =
                names.iter().map(|&name| kernels.derivation.graph.symbol_name(name).to_owned()).collect();
            let (bindings, results) = bind(&code.results, &wishes, &mut code.taken);
            let finite = check_finite(&mut code, "velocity ratio derivatives", &results);
            let matrices = (0..u).map(|unknown| {
                let entries: Vec<Operand> = results.iter().skip(unknown).step_by(u).cloned().collect();
                kernels.symmetric(&entries)
            });
            let tail = quote!(#bindings #finite Ok([#(#matrices),*]));
            Body::new(code, tail, [])
        });
        docs.extend(lines(ERRORS));
        let pose = argument_of(&pose, code.as_ref());
        let signature = quote!(pub fn velocity_ratio_derivatives(&self, #pose: &#pose_type<T>) -> Result<[SMatrix<T, #nv, #nv>; #nu], Error>);
        self.function(&docs, signature, code);
        for family in [Family::Points, Family::Outputs] {
            self.quantity_ratio_derivatives(kernels.as_deref_mut(), formulas, family);
        }
    }

    fn quantity_ratio_derivatives(
        &mut self,
        kernels: Option<&mut Kernels>,
        formulas: Option<&Formulas>,
        family: Family,
    ) {
        let Some(members) = self.members(family) else { return };
        let Members { names, group, word, dimension, .. } = &members;
        let nv = literal(self.driver.inputs.len());
        let (pose, pose_type) = (self.arguments.pose.clone(), self.types.pose.clone());
        let mut docs = lines([match family {
            Family::Points => "The second derivatives of the points by the inputs: of x and of y a symmetric matrix.",
            Family::Outputs => "The second derivatives of the outputs by the inputs: of each a symmetric matrix.",
        }]);
        let code = kernels.map(|kernels| {
            let second = kernels.derivation.ratio_derivatives.as_ref();
            let endings = second.map(|second| second.endings.clone()).unwrap_or_default();
            let mut laws = Vec::new();
            for (name, formulas) in names.iter().zip(formulas.map_or(&[][..], |formulas| formulas.of(family))) {
                for (ending, nodes) in endings.iter().zip(&formulas.ratio_derivatives) {
                    laws.extend(members.laws(kernels, name, ending, nodes));
                }
            }
            docs.extend(fenced(laws.into_iter()));
            let (mut stages, solved) = kernels.ratio_derivative_stages();
            let (mut nodes, mut wishes) = (Vec::new(), Vec::new());
            for (name, quantity) in names.iter().zip(kernels.quantities(family).to_vec()) {
                for (ending, components) in
                    endings.iter().zip(kernels.derivation.quantity_ratio_derivatives(&quantity, &solved))
                {
                    nodes.extend(components);
                    wishes.extend(members.axes().iter().map(|axis| format!("{name}{axis}_{ending}")));
                }
            }
            stages.push(Stage::Return(nodes));
            let stages = needed(&kernels.derivation.graph, stages);
            let mut code = self.on_pose(kernels, Vec::new(), &stages);
            let (bindings, results) = bind(&code.results, &wishes, &mut code.taken);
            let finite = check_finite(&mut code, &format!("{word} ratio derivatives"), &results);
            let of_each = results.chunks(endings.len() * dimension).map(|entries| {
                let component = |axis: usize| {
                    let entries: Vec<Operand> = entries.iter().skip(axis).step_by(*dimension).cloned().collect();
                    kernels.symmetric(&entries)
                };
                let components: Vec<TokenStream> = (0..*dimension).map(component).collect();
                match components.as_slice() {
                    [only] => only.clone(),
                    several => quote!([#(#several),*]),
                }
            });
            let tail = quote!(#bindings #finite Ok(#group { #(#names: #of_each),* }));
            Body::new(code, tail, [])
        });
        docs.extend(lines(ERRORS));
        let name = ident(&format!("{word}_ratio_derivatives"));
        let pose = argument_of(&pose, code.as_ref());
        let item = match family {
            Family::Points => quote!([SMatrix<T, #nv, #nv>; 2]),
            Family::Outputs => quote!(SMatrix<T, #nv, #nv>),
        };
        let signature = quote!(pub fn #name(&self, #pose: &#pose_type<T>) -> Result<#group<#item>, Error>);
        self.function(&docs, signature, code);
    }
}
