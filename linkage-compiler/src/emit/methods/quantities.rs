//! Points and outputs: value, rate, acceleration and their own velocity ratios.

use proc_macro2::TokenStream;
use quote::quote;

use super::super::kernel::{Operand, Shape, Source};
use super::super::names::ident;
use super::super::types::field;
use super::{
    Body, Family, Kernels, Methods, argument_of, bind, check_finite, columns_of, component_names, fenced, lines,
    literal, member,
};
use crate::derivation::{Formulas, Quantity};
use crate::graph::NodeId;
use crate::simplify::schedule::Stage;

impl Methods<'_> {
    pub(super) fn quantities(&mut self, kernels: Option<&mut Kernels>, formulas: Option<&Formulas>, family: Family) {
        let (names, group, word) = match family {
            Family::Points => (
                self.mechanism.points.iter().map(|p| field(&p.name)).collect::<Vec<_>>(),
                self.types.points.clone(),
                "point",
            ),
            Family::Outputs => {
                (self.mechanism.outputs.iter().map(|o| field(&o.name)).collect(), self.types.outputs.clone(), "output")
            }
        };
        if names.is_empty() {
            return;
        }
        let (pose, pose_type) = (self.arguments.pose.clone(), self.types.pose.clone());
        let (rate, acceleration) = (self.arguments.rate.clone(), self.arguments.acceleration.clone());
        let coordinates = self.types.coordinates.clone();
        let v = self.driver.inputs.len();
        let nv = literal(v);
        let item = if family == Family::Points { quote!(Vector2<T>) } else { quote!(T) };
        let quantities = |kernels: &Kernels| -> Vec<Quantity> {
            match family {
                Family::Points => kernels.derivation.points.clone(),
                Family::Outputs => kernels.derivation.outputs.clone(),
            }
        };
        let dimension = if family == Family::Points { 2 } else { 1 };
        let rows = literal(dimension);
        let build = |results: &[Operand]| -> TokenStream {
            let members = names.iter().zip(results.chunks(dimension)).map(|(name, parts)| match parts {
                [only] => member(name, only),
                parts => quote!(#name: Vector2::new(#(#parts),*)),
            });
            quote!(#group { #(#members),* })
        };
        let what = if family == Family::Points { "positions of the points" } else { "values of the outputs" };
        type Part = fn(&Quantity) -> &Vec<NodeId>;
        let kinds: [(String, String, usize, Part); 3] = [
            (format!("{word}s"), format!("The {what}."), 0, |quantity| &quantity.value),
            (format!("{word}_velocities"), format!("The rates of the {word}s at the velocity q'."), 1, |quantity| {
                &quantity.rate
            }),
            (
                format!("{word}_accelerations"),
                format!("The accelerations of the {word}s at the velocity q' and the acceleration q''."),
                2,
                |quantity| &quantity.acceleration,
            ),
        ];
        for (name, meaning, order, part) in kinds {
            let code = kernels.as_deref().map(|kernels| {
                let nodes: Vec<NodeId> =
                    quantities(kernels).iter().flat_map(|quantity| part(quantity).clone()).collect();
                let mut sources = Vec::new();
                if order > 0 {
                    sources.push(self.coordinates(kernels, &rate, |c| c.rate));
                }
                if order > 1 {
                    sources.push(self.coordinates(kernels, &acceleration, |c| c.acceleration));
                }
                let mut code = self.on_pose(kernels, sources, &[Stage::Return(nodes)]);
                let (bindings, results) = bind(
                    &code.results,
                    &component_names(&names, dimension, &["", "_rate", "_acceleration"][order..=order]),
                    &mut code.taken,
                );
                let (built, verdict) = (build(&results), check_finite(&mut code, &name, &results));
                Body::new(code, quote!(#bindings #verdict Ok(#built)), [])
            });
            let mut docs = vec![meaning];
            if order == 0
                && let Some(kernels) = kernels.as_deref()
            {
                let axes: &[&str] = if dimension == 2 { &[".x", ".y"] } else { &[""] };
                let list = quantities(kernels);
                let formulas = names.iter().zip(&list).flat_map(|(name, quantity)| {
                    axes.iter().zip(&quantity.value).map(move |(axis, &node)| (format!("{name}{axis}"), node))
                });
                docs.extend(fenced(formulas.map(|(name, node)| format!("{name} = {}", kernels.text(node)))));
            }
            docs.extend(lines(["", "# Errors", "`NotFinite` where a formula has no finite value."]));
            let function = ident(&name);
            let [pose, rate, acceleration] =
                [&pose, &rate, &acceleration].map(|argument| argument_of(argument, code.as_ref()));
            let more = [quote!(, #rate: &#coordinates<T>), quote!(, #acceleration: &#coordinates<T>)];
            let more = &more[..order];
            let signature =
                quote!(pub fn #function(&self, #pose: &#pose_type<T> #(#more)*) -> Result<#group<#item>, Error>);
            self.function(&docs, &signature, code);
        }
        let laws = kernels.as_deref().zip(formulas).map(|(kernels, formulas)| {
            let all = if family == Family::Points { &formulas.points } else { &formulas.outputs };
            let axes: &[&str] = if dimension == 2 { &["_x", "_y"] } else { &[""] };
            let mut lines = Vec::new();
            for (name, of_name) in names.iter().zip(all) {
                for (&input, nodes) in kernels.derivation.inputs.iter().zip(of_name) {
                    let by = if v == 1 {
                        "ratio".to_owned()
                    } else {
                        format!("by_{}", kernels.derivation.coordinates[input].name)
                    };
                    lines.extend(
                        axes.iter()
                            .zip(nodes)
                            .map(|(axis, &node)| format!("{name}{axis}_{by} = {}", kernels.text(node))),
                    );
                }
            }
            fenced(lines.into_iter())
        });
        let laws = laws.unwrap_or_default();
        // W_l = l_u W + l_v.
        let code = kernels.map(|kernels| {
            let mut nodes = Vec::new();
            for quantity in quantities(kernels) {
                for input in 0..v {
                    nodes.extend(quantity.jacobian.iter().map(|row| kernels.derivation.quantity_ratio(row, input)));
                }
            }
            let ratios = kernels.derivation.ratios.iter().flatten().map(|&ratio| (String::new(), ratio)).collect();
            let ratios = Source {
                argument: Some(pose.clone()),
                from: quote!(self.velocity_ratios(#pose)?.data.0),
                of: Shape::Columns(self.driver.unknowns.len()),
                fields: ratios,
            };
            let mut code = self.on_pose(kernels, vec![ratios], &[Stage::Return(nodes)]);
            let (mut values, mut bindings, mut flat) = (Vec::new(), TokenStream::new(), Vec::new());
            for (name, parts) in names.iter().zip(code.results.chunks(dimension * v)) {
                let matrix = columns_of(parts, dimension);
                let ratio = ident(&code.taken.unique(&format!("{name}_ratios")));
                bindings.extend(quote!(let #ratio = #matrix;));
                values.push(ratio.clone());
                flat.push(ratio);
            }
            let checks = flat.iter().map(|ratio| quote!(finite_matrix(Self::NAME, #word, &#ratio)?;));
            let tail = quote!(#bindings #(#checks)* Ok(#group { #(#names: #values),* }));
            // A call costs what the ratios cost, too.
            let ratios = self.kernels.iter().find(|(name, _)| name == "velocity_ratios");
            code.operations = ratios.map_or(code.operations, |(_, ratios)| code.operations.plus(*ratios));
            Body::new(code, tail, ["finite_matrix"])
        });
        let name = ident(&format!("{word}_ratios"));
        let mut docs = vec![format!("The velocity ratios `W_l` of the {word}s: l' = `W_l` v'.")];
        docs.extend(laws);
        docs.extend(lines([
            "",
            "# Errors",
            "`Singular` where J has no inverse, `NotFinite` where a formula has no finite value.",
        ]));
        let pose = argument_of(&pose, code.as_ref());
        let signature =
            quote!(pub fn #name(&self, #pose: &#pose_type<T>) -> Result<#group<SMatrix<T, #rows, #nv>>, Error>);
        self.function(&docs, &signature, code);
    }
}
