//! How far an input can go.

use quote::{format_ident, quote};

use super::super::kernel;
use super::super::tokens::Tokens;
use super::super::types::field;
use super::{Body, Kernels, Methods, argument_of, lines};
use crate::derivation::Assembly;
use crate::lower::Stage;
use crate::model::Kind;

impl Methods<'_> {
    /// `limits`, or of several inputs one function each.
    pub(super) fn limits(&mut self, mut kernels: Option<&mut Kernels>) {
        let assembly = kernels.as_mut().map(|kernels| kernels.derivation.assembly());
        for place in 0..self.driver.inputs.len() {
            let body = kernels
                .as_mut()
                .zip(assembly.as_ref())
                .map(|(kernels, assembly)| self.search(kernels, assembly, place));
            self.limits_of(place, body, assembly.as_ref().is_none_or(|assembly| assembly.guesses.is_empty()));
        }
    }

    fn limits_of(&mut self, place: usize, body: Option<Body>, is_closed: bool) {
        let name = &self.mechanism.coordinates[self.driver.inputs[place]].name;
        let (branch, types) = (argument_of(&self.arguments.branch, body.as_ref()), self.types);
        let (branch_type, inputs, coordinates) = (&types.branch, &types.inputs, &types.coordinates);
        let is_single = self.driver.inputs.len() == 1;
        let function = if is_single { format_ident!("limits") } else { format_ident!("limits_of_{}", name.field) };
        let others = if is_single { "" } else { ", the other inputs held" };
        let docs = lines([
            &format!(
                "The `{}` between which the mechanism can be assembled on a branch about a position{others}:",
                name.text
            ),
            "in closed form for groups that depend on the inputs alone, directly or through linear equations, bracketed for",
            "the others. Inputs at which a group is undetermined on the way are passed.",
            "",
            "# Errors",
            "Those of the position asked about, `NotFinite` if a number is not finite.",
        ]);
        let (from, argument) = if is_closed {
            (&self.arguments.inputs, quote!(impl Into<#inputs<T>>))
        } else {
            (&self.arguments.guess, quote!(&#coordinates<T>))
        };
        let signature =
            quote!(pub fn #function(&self, #from: #argument, #branch: #branch_type) -> Result<Limits<T>, Error>);
        self.function(&docs, signature, body);
    }

    fn search(&mut self, kernels: &mut Kernels, assembly: &Assembly, place: usize) -> Body {
        let input = kernels.derivation.inputs[place];
        let (bounds, is_searched) = kernels.derivation.bounds(assembly, input);
        let names: Vec<_> =
            bounds.iter().map(|bound| kernels.derivation.blocks[bound.block].names(kernels.derivation)).collect();
        let one = kernels.derivation.graph.one();
        let results = bounds.iter().flat_map(|bound| bound.coefficients.into_iter().chain([bound.rate.unwrap_or(one)]));
        let results = results.collect();
        let (from, branch) = (self.arguments.inputs.clone(), self.arguments.branch.clone());
        let (guess, coordinates, inputs) = (&self.arguments.guess, &self.types.coordinates, &self.types.inputs);
        let coordinate = &self.mechanism.coordinates[self.driver.inputs[place]];
        let name = field(&coordinate.name);
        let mut source = self.inputs(kernels, &from, |c| c.value);
        // They are taken apart by reference: the position needs them whole.
        source.from = Tokens::name(&from);
        let given = self.given(vec![self.parameters(), source], None);
        let stages = [Stage::Return(results)];
        let mut code = kernel::write(kernels.derivation, &given, &stages, &self.named, &self.scope);
        let bounds = bounds.iter().zip(&names).zip(code.results.chunks(4)).map(|((bound, group), results)| {
            let (coefficients, rate) = results.split_at(3);
            let place = proc_macro2::Literal::usize_unsuffixed(bound.block);
            if bound.rate.is_some() {
                quote!(Bound::Angle((#place, #group), [#(#coefficients),*], #(#rate)*))
            } else {
                quote!(Bound::Length((#place, #group), [#(#coefficients),*]))
            }
        });
        let bounds: Vec<_> = bounds.collect();
        code.uses.extend(["Limits", "Search", "limits"]);
        if !bounds.is_empty() {
            code.uses.insert("Bound");
        }
        let search = match coordinate.kind {
            _ if !is_searched => quote!(Search::Nothing),
            Kind::Angle => quote!(Search::Turn),
            _ => quote!(Search::Length(real::<T>(4.0) * self.closure_sizes(&position).sum())),
        };
        if is_searched && coordinate.kind != Kind::Angle {
            code.uses.insert("real");
        }
        // A single input leaves no other to be taken over.
        let others = (self.driver.inputs.len() > 1).then(|| quote!(, ..#from));
        let (start, position, again) = if assembly.guesses.is_empty() {
            // The position nearest to the last: in the same turn.
            let is_turned = self.branches.as_ref().is_some_and(|branches| !branches.turns.is_empty());
            let again = if is_turned {
                quote!(|position, #name| self.assemble_near(&#coordinates { #name, ..position.coordinates() }, #branch))
            } else {
                quote!(|_, #name| self.assemble(#inputs { #name #others }, #branch))
            };
            (quote!(let #from = #from.into();), quote!(self.assemble(#from, #branch)?), again)
        } else {
            let again = quote!(|position, #name| self.assemble_near(&#coordinates { #name, ..position.coordinates() }, #branch));
            (quote!(let #from = #inputs::from(#guess);), quote!(self.assemble_near(#guess, #branch)?), again)
        };
        let body = std::mem::take(&mut code.body);
        code.body.extend(quote!(#start let position = #position; #body));
        code.arguments.extend([from.clone(), branch.clone(), guess.clone()]);
        let tail = quote!(
            limits(Self::NAME, #from.#name, position, [#(#bounds),*], #search, #again, |position| self.block_determinants(position))
        );
        Body::new(code, tail, [])
    }
}
