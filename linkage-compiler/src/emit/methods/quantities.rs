//! Points and outputs: value, rate, acceleration and their own velocity ratios.

use std::borrow::Cow;

use proc_macro2::Ident;
use quote::quote;

use super::super::kernel::{Shape, Source};
use super::super::names::{ident, string};
use super::super::tokens::Tokens;
use super::super::types::field;
use super::{Body, Family, Kernels, Methods, argument_of, fenced, in_parts, lines};
use crate::derivation::{Formulas, Quantity};
use crate::graph::NodeId;
use crate::lower::Stage;
use crate::model::Request;

/// The points or the outputs: what they are called and what holds them.
pub(super) struct Members {
    pub names: Vec<Ident>,
    /// The type that holds one of each.
    pub group: Ident,
    /// "point" or "output".
    pub word: &'static str,
    /// 2 of a point, 1 of an output.
    pub dimension: usize,
    /// The type of one.
    pub item: Tokens,
}

impl Members {
    /// The endings of the names of the components.
    pub(super) fn axes(&self) -> &'static [&'static str] {
        if self.dimension == 2 { &["_x", "_y"] } else { &[""] }
    }

    /// `name_ending = formula` of each component, for the documentation.
    pub(super) fn laws(&self, kernels: &Kernels, name: &Ident, ending: &str, nodes: &[NodeId]) -> Vec<String> {
        let components = self.axes().iter().zip(nodes);
        components.map(|(axis, &node)| format!("{name}{axis}_{ending} = {}", kernels.text(node))).collect()
    }
}

impl Kernels<'_> {
    pub(super) fn quantities(&self, family: Family) -> &[Quantity] {
        match family {
            Family::Points => &self.derivation.points,
            Family::Outputs => &self.derivation.outputs,
        }
    }
}

impl Methods<'_> {
    /// None if nothing of this family is declared.
    pub(super) fn members(&self, family: Family) -> Option<Members> {
        let members = match family {
            Family::Points => Members {
                names: self.mechanism.points.iter().map(|p| field(&p.name)).collect(),
                group: self.types.points.clone(),
                word: "point",
                dimension: 2,
                item: self.words.of(&ident("Vector2")),
            },
            Family::Outputs => Members {
                names: self.mechanism.outputs.iter().map(|o| field(&o.name)).collect(),
                group: self.types.outputs.clone(),
                word: "output",
                dimension: 1,
                item: self.words.scalar(),
            },
        };
        (!members.names.is_empty()).then_some(members)
    }

    pub(super) fn quantities(&mut self, kernels: Option<&mut Kernels>, formulas: Option<&Formulas>, family: Family) {
        let Some(members) = self.members(family) else { return };
        let Members { names, group, word, dimension, item } = &members;
        let dimension = *dimension;
        let (pose, pose_type) = (self.arguments.pose.clone(), self.types.pose.clone());
        let (rate, acceleration) = (self.arguments.rate.clone(), self.arguments.acceleration.clone());
        let jerk = self.arguments.jerk.clone();
        let coordinates = self.types.coordinates.clone();
        let v = self.driver.inputs.len();
        let what = if family == Family::Points { "positions of the points" } else { "values of the outputs" };
        type Part = fn(&Quantity) -> &Vec<NodeId>;
        let mut kinds: Vec<(String, String, usize, Part)> = vec![
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
        if self.mechanism.requests.contains(&Request::Jerk) {
            let meaning =
                format!("The jerks of the {word}s at the velocity q', the acceleration q'' and the jerk q'''.");
            kinds.push((format!("{word}_jerks"), meaning, 3, |quantity| &quantity.jerk));
        }
        for (name, meaning, order, part) in kinds {
            let code = kernels.as_deref().map(|kernels| {
                let nodes: Vec<NodeId> =
                    kernels.quantities(family).iter().flat_map(|quantity| part(quantity).clone()).collect();
                let mut sources = Vec::new();
                if order > 0 {
                    sources.push(self.coordinates(kernels, &rate, |c| c.rate));
                }
                if order > 1 {
                    sources.push(self.coordinates(kernels, &acceleration, |c| c.acceleration));
                }
                if order > 2 {
                    sources.push(self.coordinates(kernels, &jerk, |c| c.jerk));
                }
                let mut code = self.on_pose(kernels, sources, &[Stage::Return(nodes)]);
                let (finite, parts): (_, &[usize]) =
                    if family == Family::Points { ("finite_points", &[2]) } else { ("finite_outputs", &[]) };
                let values = in_parts(std::mem::take(&mut code.results), parts);
                let (function, name) = (ident(finite), string(&name));
                Body::new(code, quote!(#function(Self::NAME, #name, [#values])), [finite])
            });
            let mut docs = vec![meaning];
            if order == 0
                && let Some(kernels) = kernels.as_deref()
            {
                let axes: &[&str] = if dimension == 2 { &[".x", ".y"] } else { &[""] };
                let formulas = names.iter().zip(kernels.quantities(family)).flat_map(|(name, quantity)| {
                    axes.iter().zip(&quantity.value).map(move |(axis, &node)| (format!("{name}{axis}"), node))
                });
                docs.extend(fenced(formulas.map(|(name, node)| format!("{name} = {}", kernels.text(node)))));
            }
            docs.extend(lines(["", "# Errors", "`NotFinite` where a formula has no finite value."]));
            let motion = [&rate, &acceleration, &jerk];
            let more = motion[..order].iter().map(|argument| (*argument, &coordinates));
            let arguments = [(&pose, &pose_type)].into_iter().chain(more);
            let arguments =
                arguments.map(|(argument, of)| self.words.borrowed(&argument_of(argument, code.as_ref()), of));
            let signature = self.words.fallible(&name, arguments, Tokens::name(group).of([item.clone()]));
            self.function(&docs, signature, code);
        }
        let laws = kernels.as_deref().zip(formulas).map(|(kernels, formulas)| {
            let mut lines = Vec::new();
            for (name, of_name) in names.iter().zip(formulas.of(family)) {
                for (&input, nodes) in kernels.derivation.inputs.iter().zip(&of_name.ratios) {
                    let by = if v == 1 {
                        "ratio".to_owned()
                    } else {
                        format!("by_{}", kernels.derivation.coordinates[input].name)
                    };
                    lines.extend(members.laws(kernels, name, &by, nodes));
                }
            }
            fenced(lines.into_iter())
        });
        let laws = laws.unwrap_or_default();
        // W_l = l_u W + l_v.
        let code = kernels.map(|kernels| {
            let mut nodes = Vec::new();
            for quantity in kernels.quantities(family).to_vec() {
                for input in 0..v {
                    nodes.extend(quantity.jacobian.iter().map(|row| kernels.derivation.quantity_ratio(row, input)));
                }
            }
            let ratios = kernels.derivation.ratios.iter().flatten().map(|&ratio| (Cow::from(""), ratio)).collect();
            let ratios = Source {
                argument: Some(pose.clone()),
                from: quote!(self.velocity_ratios(#pose)?.data.0).into(),
                of: Shape::Columns(self.driver.unknowns.len()),
                fields: ratios,
            };
            let mut code = self.on_pose(kernels, vec![ratios], &[Stage::Return(nodes)]);
            let values = in_parts(std::mem::take(&mut code.results), &[v, dimension]);
            let kind = string(word);
            let tail = quote!(finite_matrices(Self::NAME, #kind, [#values]));
            // A call costs what the ratios cost, too.
            let ratios = self.kernels.iter().find(|(name, _)| name == "velocity_ratios");
            code.operations = ratios.map_or(code.operations, |(_, ratios)| code.operations.plus(*ratios));
            Body::new(code, tail, ["finite_matrices"])
        });
        let mut docs = vec![format!("The velocity ratios `W_l` of the {word}s: l' = `W_l` v'.")];
        docs.extend(laws);
        docs.extend(lines([
            "",
            "# Errors",
            "`Singular` where J has no inverse, `NotFinite` where a formula has no finite value.",
        ]));
        let pose = argument_of(&pose, code.as_ref());
        let signature = self.words.fallible(
            &format!("{word}_ratios"),
            [self.words.borrowed(&pose, &pose_type)],
            Tokens::name(group).of([self.words.sized("SMatrix", [dimension, v])]),
        );
        self.function(&docs, signature, code);
    }
}
