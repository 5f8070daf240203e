//! The derivation of a driver.

use linkage_compiler::document::{self, Document};
use linkage_runtime::derivation::{ChainJoint, ChainLink, Derivation, KinematicChain, Sensitivity};

use crate::arena::Arena;
use crate::error::{Unsound, places};
use crate::formulas::Formulas;

pub(crate) fn lent<'a>(arena: &'a Arena, document: &Document) -> Result<Derivation<'a>, Unsound> {
    let formulas = Formulas::of(arena, &document.table)?;
    Ok(Derivation {
        mechanism: arena.text(&document.mechanism),
        parameters: arena.list(&document.parameters, |symbol| formulas.symbol(symbol))?,
        inputs: arena.list(&document.inputs, |symbol| formulas.symbol(symbol))?,
        unknowns: arena.list(&document.unknowns, |symbol| formulas.symbol(symbol))?,
        residual: formulas.equations(&document.residual)?,
        implied: formulas.equations(&document.implied)?,
        jacobian_unknowns: formulas.matrix(&document.jacobian_unknowns)?,
        jacobian_inputs: formulas.matrix(&document.jacobian_inputs)?,
        groups: arena.list(&document.groups, |group| {
            places("equations", &group.equations, document.residual.len())?;
            formulas.group(group)
        })?,
        determinant: document.determinant.map(|equation| formulas.equation(equation)).transpose()?,
        ratios: formulas.equations(&document.ratios)?,
        ratio_derivatives: document.ratio_derivatives.as_deref().map(|all| formulas.equations(all)).transpose()?,
        gamma: formulas.equations(&document.gamma)?,
        jerk: document.jerk.as_deref().map(|all| formulas.equations(all)).transpose()?,
        sensitivity: document
            .sensitivity
            .as_ref()
            .map(|sensitivity| of_parameters(formulas, sensitivity))
            .transpose()?,
        points: arena.list(&document.points, |quantity| formulas.quantity(quantity))?,
        outputs: arena.list(&document.outputs, |quantity| formulas.quantity(quantity))?,
        conditions: formulas.all(&document.conditions)?,
        chain: document.chain.as_ref().map(|chain| chained(arena, chain)).transpose()?,
        kernels: arena.list(&document.kernels, |kernel| formulas.kernel(kernel))?,
    })
}

fn of_parameters<'a>(
    formulas: Formulas<'a>,
    document::Sensitivity { jacobian, formulas: all }: &document::Sensitivity,
) -> Result<Sensitivity<'a>, Unsound> {
    Ok(Sensitivity { jacobian: formulas.matrix(jacobian)?, formulas: formulas.equations(all)? })
}

fn chained<'a>(arena: &'a Arena, chain: &document::Chain) -> Result<KinematicChain<'a>, Unsound> {
    Ok(KinematicChain {
        links: arena.list(&chain.links, |(name, turns_with)| {
            Ok(ChainLink { name: arena.text(name), turns_with: arena.texts(turns_with) })
        })?,
        joints: arena.list(&chain.joints, |(links, slides_along)| {
            places("links", links, chain.links.len())?;
            Ok(ChainJoint { links: *links, slides_along: slides_along.as_deref().map(|name| arena.text(name)) })
        })?,
        conditions: chain.conditions,
    })
}
