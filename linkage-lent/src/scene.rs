//! The equations of motion of a scene.

use linkage_compiler::document::{self, SceneDocument};
use linkage_runtime::derivation::{ContactEffect, Effect, JointForce, SceneDerivation};

use crate::formulas::Formulas;
use crate::{Lender, Unsound};

pub(crate) fn lent<'a>(lender: &'a Lender, document: &SceneDocument) -> Result<SceneDerivation<'a>, Unsound> {
    let formulas = Formulas::of(lender, &document.table)?;
    Ok(SceneDerivation {
        scene: lender.text(&document.scene),
        mechanism: lender.text(&document.mechanism),
        parameters: lender.list(&document.parameters, |symbol| formulas.symbol(symbol))?,
        mass_matrix: formulas.equations(&document.mass_matrix)?,
        forces: lender.list(&document.forces, |effect| {
            Ok(Effect { name: lender.text(&effect.name), forces: formulas.equations(&effect.forces)? })
        })?,
        frictions_and_stops: lender.list(&document.frictions_and_stops, |contact| contacting(formulas, contact))?,
        drives: formulas.equations(&document.drives)?,
        potential: document.potential.map(|equation| formulas.equation(equation)).transpose()?,
        joints: lender.list(&document.joints, |joint| {
            let [first, second] = joint.components;
            let components = [formulas.equation(first)?, formulas.equation(second)?];
            Ok(JointForce { name: lender.text(&joint.name), components })
        })?,
        multipliers: formulas.all(&document.multipliers)?,
        contacts: lender.list(&document.contacts, |symbol| formulas.symbol(symbol))?,
        kernels: lender.list(&document.kernels, |kernel| formulas.kernel(kernel))?,
    })
}

fn contacting<'a>(formulas: Formulas<'a>, contact: &document::ContactEffect) -> Result<ContactEffect<'a>, Unsound> {
    Ok(ContactEffect {
        name: formulas.lender().text(&contact.name),
        force: formulas.one(contact.force)?,
        along: formulas.equation(contact.along)?,
        bound: formulas.one(contact.bound)?,
        bearing: contact.bearing.as_ref().map(|joint| formulas.symbol(joint)).transpose()?,
        rebound: contact.rebound.map(|factor| formulas.one(factor)).transpose()?,
        forces: formulas.equations(&contact.forces)?,
    })
}
