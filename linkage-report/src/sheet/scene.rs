//! The equations of motion of a scene on a page.

use linkage_runtime::derivation::{ContactEffect, SceneDerivation, Symbol};

use crate::document::outline;

use super::html::{escape, inline};
use super::page::{Page, list};

impl Page {
    pub(super) fn scene(&mut self, scene: &SceneDerivation<'_>) {
        self.section(&format!("{}: <code>{}</code>", self.words.motion, escape(scene.scene)), |page| {
            if !scene.parameters.is_empty() {
                let given = list(scene.parameters.iter().map(|Symbol { formula, .. }| formula));
                page.push(&format!("<p>{}: {given}</p>", page.words.given));
            }
            page.lead(page.words.lead_motion);
            page.general_equation(&outline::MOTION);
            if !scene.mass_matrix.is_empty() {
                page.lead(page.words.lead_mass_matrix);
                page.equations(scene.mass_matrix);
            }
            page.lead(outline::lead_of_forces(page.words, scene));
            for effect in scene.forces {
                page.push(&format!("<article>\n<h3>{}</h3>", escape(&(page.words.name)(effect.name))));
                page.equations(effect.forces);
                page.push("</article>");
            }
            page.frictions_and_stops(scene.frictions_and_stops);
            if !scene.drives.is_empty() {
                page.lead(page.words.lead_drives);
                page.equations(scene.drives);
            }
            if let Some(potential) = scene.potential {
                page.lead(page.words.potential);
                page.equations(&[potential]);
            }
        });
        if !scene.joints.is_empty() {
            self.joints(scene);
        }
    }

    fn frictions_and_stops(&mut self, all: &[ContactEffect<'_>]) {
        if !all.is_empty() {
            self.lead(self.words.lead_contacts);
        }
        for contact in all {
            self.push(&format!("<article>\n<h3>{}</h3>", escape(&(self.words.name)(contact.name))));
            self.equations(&[contact.along]);
            let joint = contact
                .bearing
                .as_ref()
                .map(|joint| format!(", {} {}", escape(&(self.words.bearing)(joint.name)), inline(&joint.formula)));
            self.push(&format!("<p>{}{}</p>", inline(&contact.bound), joint.unwrap_or_default()));
            if let Some(factor) = &contact.rebound {
                self.push(&format!("<p>{} {}.</p>", self.words.lead_rebound, inline(factor)));
            }
            self.equations(contact.forces);
            self.push("</article>");
        }
    }

    fn joints(&mut self, scene: &SceneDerivation<'_>) {
        self.section(&format!("{}: <code>{}</code>", self.words.joints, escape(scene.scene)), |page| {
            page.lead(page.words.lead_joints);
            if !scene.multipliers.is_empty() {
                page.lead(page.words.lead_multipliers);
                page.general_equation(&outline::MULTIPLIERS);
            }
            for contact in scene.contacts {
                let force = escape(&(page.words.force_along)(contact.name));
                page.push(&format!("<p>{force} {}.</p>", inline(&contact.formula)));
            }
            for joint in scene.joints {
                page.push(&format!("<article>\n<h3>{}</h3>", escape(&(page.words.name)(joint.name))));
                page.equations(&joint.components);
                page.push("</article>");
            }
        });
    }
}
