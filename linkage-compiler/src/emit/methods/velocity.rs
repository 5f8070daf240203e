//! Linear systems in J: velocity ratios and velocities.

use std::borrow::Cow;

use proc_macro2::TokenStream;
use quote::quote;

use super::super::kernel::{Code, Operand, Shape, Source};
use super::super::tokens::Tokens;
use super::{Body, Kernels, Methods, argument_of, bind, check_finite, columns_of, fenced, lines};
use crate::derivation::{Form, Formulas};
use crate::graph::SymbolId;
use crate::lower::Stage;

impl Methods<'_> {
    pub(super) fn velocity(&mut self, mut kernels: Option<&mut Kernels>, formulas: Option<&Formulas>) {
        let (u, v) = (self.driver.unknowns.len(), self.driver.inputs.len());
        let (pose, pose_type) = (self.arguments.pose.clone(), self.types.pose.clone());
        let (rate, right) = (self.arguments.rate.clone(), self.arguments.right.clone());
        let (inputs, coordinates) = (self.types.inputs.clone(), self.types.coordinates.clone());

        let code = kernels.as_deref_mut().map(|kernels| {
            let symbols: Vec<SymbolId> = kernels
                .derivation
                .unknowns
                .clone()
                .iter()
                .map(|&index| {
                    let name = format!("{}_part", kernels.derivation.coordinates[index].name);
                    kernels.derivation.graph.symbol(name)
                })
                .collect();
            let sides: Vec<SymbolId> =
                (0..u).map(|row| kernels.derivation.graph.symbol(format!("right_{}", row + 1))).collect();
            let side = kernels.variables(&sides);
            let mut stages = kernels.derivation.solution(&[(side, symbols.clone())], Form::Factored);
            stages.push(Stage::Return(kernels.variables(&symbols)));
            let fields = sides.iter().map(|&side| (Cow::from(""), side)).collect();
            let source = Source {
                argument: Some(right.clone()),
                from: quote!(#right.data.0).into(),
                of: Shape::Columns(u),
                fields,
            };
            let mut code = self.on_pose(kernels, vec![source], &stages);
            let (bindings, solution) = bound(kernels, &symbols, &mut code);
            let finite = check_finite(&mut code, "the solution", &solution);
            Body::new(code, quote!(#bindings #finite Ok(SVector::from([#(#solution),*]))), [])
        });
        let docs = lines([
            "The x of J x = `right`.",
            "",
            "# Errors",
            "`Singular` where J has no inverse, `NotFinite` if the solution is not finite.",
        ]);
        let [own, right] = [&pose, &right].map(|argument| argument_of(argument, code.as_ref()));
        let signature = {
            let vector = self.words.sized("SVector", [u]);
            let arguments = [self.words.borrowed(&own, &pose_type), Tokens::from(quote!(#right: &#vector))];
            self.words.fallible("solve_jacobian", arguments, vector)
        };
        self.function(&docs, signature, code);

        let code = kernels.as_deref_mut().map(|kernels| {
            let mut stages = kernels.ratio_stages();
            let flat: Vec<SymbolId> = kernels.derivation.ratios.iter().flatten().copied().collect();
            stages.push(Stage::Return(kernels.variables(&flat)));
            let mut code = self.on_pose(kernels, Vec::new(), &stages);
            let (bindings, ratios) = bound(kernels, &flat, &mut code);
            let finite = check_finite(&mut code, "velocity ratios", &ratios);
            let matrix = columns_of(&ratios, u);
            Body::new(code, quote!(#bindings #finite Ok(#matrix)), [])
        });
        let meaning = if v == 1 {
            "The velocity ratios W = -J^-1 A with u' = W v'; for one input they are the transmission ratios."
        } else {
            "The velocity ratios W = -J^-1 A with u' = W v': the rate of each unknown for a unit rate of each input."
        };
        let mut docs = vec![meaning.to_owned()];
        if let Some((kernels, formulas)) = kernels.as_deref().zip(formulas) {
            let derivation = &kernels.derivation;
            let named = derivation.ratios.iter().flatten().zip(formulas.ratios.iter().flatten());
            let lines: Vec<String> = named
                .filter_map(|(&name, formula)| {
                    Some(format!("{} = {}", derivation.graph.symbol_name(name), kernels.text((*formula)?)))
                })
                .collect();
            docs.extend(fenced(lines.into_iter()));
        }
        docs.extend(lines([
            "",
            "# Errors",
            "`Singular` where J has no inverse, `NotFinite` if a ratio is not finite.",
        ]));
        let own = argument_of(&pose, code.as_ref());
        let signature = self.words.fallible(
            "velocity_ratios",
            [self.words.borrowed(&own, &pose_type)],
            self.words.sized("SMatrix", [u, v]),
        );
        self.function(&docs, signature, code);

        let code = kernels.map(|kernels| {
            let (unknowns, all) = (kernels.derivation.unknowns.clone(), (0..u + v).collect::<Vec<_>>());
            let side = kernels.derivation.velocity_side();
            let mut stages = kernels.derivation.solution(&[(side, kernels.rates(&unknowns))], Form::Factored);
            stages.push(Stage::Return(kernels.variables(&kernels.rates(&all))));
            let sources = vec![self.inputs(kernels, &rate, |c| c.rate)];
            let mut code = self.on_pose(kernels, sources, &stages);
            let results = code.results.clone();
            let finite = check_finite(&mut code, "velocity", &kernels.checked(&results));
            let fields = self.coordinate_fields();
            let tail = quote!(#finite Ok(#coordinates { #(#fields: #results),* }));
            Body::new(code, tail, [])
        });
        let docs = lines([
            "The velocity q' at the input rates v'.",
            "",
            "# Errors",
            "`Singular` where J has no inverse, `NotFinite` if a rate is not finite.",
        ]);
        let [pose, rate] = [&pose, &rate].map(|argument| argument_of(argument, code.as_ref()));
        let signature = self.words.fallible(
            "velocity",
            [self.words.borrowed(&pose, &pose_type), self.words.converted(&rate, &inputs)],
            self.words.of(&coordinates),
        );
        self.function(&docs, signature, code);
    }
}

/// The results of a kernel that returns these symbols, each by a name.
fn bound(kernels: &Kernels, symbols: &[SymbolId], code: &mut Code) -> (TokenStream, Vec<Operand>) {
    let graph = &kernels.derivation.graph;
    let wishes: Vec<String> = symbols.iter().map(|&symbol| graph.symbol_name(symbol).to_owned()).collect();
    bind(&code.results, &wishes, &mut code.taken)
}
