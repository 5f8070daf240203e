//! Completion of scenes after all statements are analysed.

use std::collections::BTreeSet;

use proc_macro2::Ident;

use super::{Body, Draft, Drive, Reading, Scene};
use crate::diagnostics::suggestion;
use crate::graph::SymbolId;
use crate::ids::{BodyId, DriverId};
use crate::model::guess;
use crate::model::mechanism::{Driver, Mechanism};
use crate::model::name::TypeName;
use crate::model::resolver::Resolver;

impl Resolver<'_> {
    /// Resolves the bodies, drivers and parameters of all scenes.
    pub(in crate::model) fn finish_scenes(&mut self, reading: Reading, result: &mut Mechanism) {
        let (mut used, mut mentions) = (BTreeSet::new(), Vec::new());
        for draft in reading.scenes {
            let messages = self.diagnostics.len();
            let Some(driver) = self.driver_of(&draft, result) else { continue };
            let mut scene = Scene {
                name: TypeName::new(&draft.name),
                attributes: draft.attributes,
                driver,
                inertia: None,
                weights: Vec::new(),
                laws: draft.laws,
                contacts: draft.contacts,
                drives: Vec::new(),
                requests: draft.requests,
                parameters: Vec::new(),
                loads: Vec::new(),
                wanted: draft.wanted,
                written: draft.written,
            };
            if let Some((span, bodies)) = &draft.inertia {
                let all = self.bodies(bodies, result);
                if all.is_empty() && bodies.is_empty() {
                    self.diagnostics.error(*span, "`inertia` needs a body: declare one with `body NAME { … }`");
                }
                used.extend(all.iter().copied());
                scene.inertia = Some(all);
            }
            if let (Some((span, word)), None) = (&draft.contact, &draft.inertia) {
                let message = format!("a `{word}` needs inertia: add `inertia;` to `{}`", scene.name);
                self.diagnostics.error(*span, message);
            }
            for ([x, y], bodies) in &draft.gravity {
                let all = self.bodies(bodies, result);
                used.extend(all.iter().copied());
                let heavy = all.into_iter().filter(|&index| result.bodies[index].mass.is_some());
                scene.weights.extend(heavy.map(|index| (index, [*x, *y])));
            }
            let Driver { inputs, name, .. } = &result.drivers[driver];
            let mut lost = None;
            for (input, law) in draft.drives {
                let text = input.to_string();
                let place = inputs.ids().find(|&input| result.coordinates[inputs[input]].name.text == text);
                let Some(place) = place else {
                    let of = inputs.iter().map(|&index| result.coordinates[index].name.text.as_str());
                    let hint = suggestion(&text, of);
                    self.diagnostics.error(input.span(), format_args!("`{text}` is not an input of `{name}`{hint}"));
                    lost = Some(law);
                    continue;
                };
                if scene.drives.iter().any(|drive| drive.input == place) {
                    self.diagnostics.error(input.span(), format_args!("`{text}` is driven twice: remove one `drive`"));
                    continue;
                }
                scene.drives.push(Drive { input: place, law });
            }
            scene.drives.extend(guess::drive(&scene.drives, inputs, lost));
            let taken = result.drivers.iter().map(|driver| &driver.name).chain([&result.name]);
            if taken.chain(result.scenes.iter().map(|scene| &scene.name)).any(|name| *name == scene.name) {
                let message = format!("the type `{}` is declared twice", scene.name);
                self.diagnostics.error(scene.name.span(), message);
                continue;
            }
            if !draft.is_complete || self.diagnostics.len() > messages {
                guess::completed(&mut scene, result);
            }
            mentions.push(draft.mentions);
            result.scenes.push(scene);
        }
        // After mistakes, a scene that uses the body may be missing.
        let is_complete = self.diagnostics.is_empty();
        for (id, body) in result.bodies.enumerated().filter(|_| is_complete) {
            if !used.contains(&id) && !body.name.text.starts_with('_') {
                let message = format!("no scene uses the inertia or the weight of `{}`; remove it", body.name.text);
                self.diagnostics.error(body.name.span, message);
            }
        }
        self.part_parameters(&mentions, result);
    }

    fn driver_of(&mut self, scene: &Draft, result: &Mechanism) -> Option<DriverId> {
        let mut drivers = result.drivers.ids();
        let place = match &scene.of {
            Some(name) => drivers.find(|&id| result.drivers[id].name == *name),
            None => drivers.next().filter(|_| result.drivers.len() == 1),
        };
        if place.is_none() {
            let names: Vec<String> = result.drivers.iter().map(|driver| driver.name.to_string()).collect();
            let (span, message) = match &scene.of {
                Some(name) => {
                    let hint = suggestion(&name.to_string(), names.iter().map(String::as_str));
                    (name.span(), format!("unknown driver `{name}`{hint}"))
                }
                None => {
                    let first = names.first().map_or("", String::as_str);
                    (
                        scene.name.span(),
                        format!("this scene needs a driver: write `scene {} of {first} {{ … }}`", scene.name),
                    )
                }
            };
            self.diagnostics.error(span, message);
        }
        place.or_else(|| guess::driver(result))
    }

    /// The bodies with these names; all bodies if there are no names.
    fn bodies(&mut self, names: &[Ident], result: &Mechanism) -> Vec<BodyId> {
        if names.is_empty() {
            return result.bodies.ids().collect();
        }
        let is_twice = |body: &Body| result.bodies.iter().filter(|other| other.name.text == body.name.text).count() > 1;
        let may_be_misnamed = result.bodies.iter().any(is_twice);
        let mut found = Vec::new();
        for name in names {
            let text = name.to_string();
            match result.bodies.ids().find(|&id| result.bodies[id].name.text == text) {
                Some(index) if found.contains(&index) => {
                    self.diagnostics.error(name.span(), format_args!("`{text}` is named twice; remove one"));
                }
                Some(index) => found.push(index),
                // Each unknown name is one mistake, and none is the name of a body that could not be read.
                None if may_be_misnamed || self.scope.is_excused(&text) => {}
                None => {
                    let names: Vec<&str> = result.bodies.iter().map(|body| body.name.text.as_str()).collect();
                    let message = match self.scope.is_declared(name) && !names.is_empty() {
                        true => format!("`{text}` is not a body: write a name of `{}`", names.join("`, `")),
                        false => format!("unknown body `{text}`{}", suggestion(&text, names)),
                    };
                    self.diagnostics.error(name.span(), message);
                    self.scope.excuse(text);
                }
            }
        }
        found
    }

    /// Moves parameters that only scenes use from the mechanism to these scenes.
    fn part_parameters(&self, mentions: &[BTreeSet<SymbolId>], result: &mut Mechanism) {
        let mut formulas = result.kinematic_formulas(&result.rows());
        formulas.extend(result.ranges.iter().flat_map(|range| range.ends.into_iter().flatten()));
        let mut kinematic: BTreeSet<SymbolId> = self.graph.symbols_of(&formulas).into_iter().collect();
        let mut held: Vec<BTreeSet<SymbolId>> = result
            .scenes
            .iter()
            .map(|scene| self.graph.symbols_of(&scene.formulas(&result.bodies)).into_iter().collect())
            .collect();
        if !self.diagnostics.is_empty() {
            // Formulas with mistakes are missing: the symbols that the statements mention count.
            kinematic.extend(&self.kinematic);
            for ((held, scene), mentions) in held.iter_mut().zip(&result.scenes).zip(mentions) {
                held.extend(mentions);
                for &body in scene.inertia.iter().flatten() {
                    held.extend(&result.bodies[body].mentions);
                }
            }
        }
        let belongs = |symbol: &SymbolId| !kinematic.contains(symbol) && held.iter().any(|held| held.contains(symbol));
        let parameters = std::mem::take(&mut result.parameters);
        let (own, shared): (Vec<_>, Vec<_>) = parameters.into_iter().partition(|p| belongs(&p.symbol));
        (result.scene_parameters, result.parameters) = (own.into(), shared.into());
        for (scene, held) in result.scenes.iter_mut().zip(held) {
            let own = result.scene_parameters.enumerated().filter(|(_, p)| held.contains(&p.symbol));
            scene.parameters = own.map(|(place, _)| place).collect();
        }
    }
}
