//! The equations of motion of a scene.

use linkage_compiler::document::{self, SceneDocument};
use linkage_runtime::derivation::{ContactEffect, Effect, JointForce, SceneDerivation};

use crate::arena::Arena;
use crate::error::Unsound;
use crate::formulas::Formulas;

pub(crate) fn lent<'a>(arena: &'a Arena, document: &SceneDocument) -> Result<SceneDerivation<'a>, Unsound> {
    let formulas = Formulas::of(arena, &document.table)?;
    Ok(SceneDerivation {
        scene: arena.text(&document.scene),
        mechanism: arena.text(&document.mechanism),
        parameters: arena.list(&document.parameters, |symbol| formulas.symbol(symbol))?,
        mass_matrix: formulas.equations(&document.mass_matrix)?,
        forces: arena.list(&document.forces, |effect| {
            Ok(Effect { name: arena.text(&effect.name), forces: formulas.equations(&effect.forces)? })
        })?,
        frictions_and_stops: arena.list(&document.frictions_and_stops, |contact| contacting(formulas, contact))?,
        drives: formulas.equations(&document.drives)?,
        potential: document.potential.map(|equation| formulas.equation(equation)).transpose()?,
        joints: arena.list(&document.joints, |joint| {
            let [first, second] = joint.components;
            let components = [formulas.equation(first)?, formulas.equation(second)?];
            Ok(JointForce { name: arena.text(&joint.name), components })
        })?,
        multipliers: formulas.all(&document.multipliers)?,
        contacts: arena.list(&document.contacts, |symbol| formulas.symbol(symbol))?,
        kernels: arena.list(&document.kernels, |kernel| formulas.kernel(kernel))?,
    })
}

fn contacting<'a>(formulas: Formulas<'a>, contact: &document::ContactEffect) -> Result<ContactEffect<'a>, Unsound> {
    Ok(ContactEffect {
        name: formulas.arena().text(&contact.name),
        force: formulas.one(contact.force)?,
        along: formulas.equation(contact.along)?,
        bound: formulas.one(contact.bound)?,
        bearing: contact.bearing.as_ref().map(|joint| formulas.symbol(joint)).transpose()?,
        rebound: contact.rebound.map(|factor| formulas.one(factor)).transpose()?,
        forces: formulas.equations(&contact.forces)?,
    })
}
