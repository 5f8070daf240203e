//! A scene of a mechanism: the names of its parameters, and the one that is meant.

use linkage_compiler::Lowered;
use linkage_compiler::model::{Measure, Parameter, SceneRequest};
use linkage_compiler::program::Code;
use linkage_compiler::program::SceneProgram;

use crate::failure::Failure;
use crate::names::{listed, place};

/// The names of a scene, and what it has.
pub struct AboutScene {
    pub name: String,
    /// Its parameters that the mechanism does not have, with what they measure.
    pub parameters: Vec<(String, Measure)>,
    /// The default of each with its unit.
    pub defaults: Vec<Option<String>>,
    pub has_inertia: bool,
    pub has_equilibrium: bool,
}

impl AboutScene {
    /// The scenes of a driver.
    pub fn all(lowered: &Lowered<'_>) -> Vec<Self> {
        let of = |scene: &SceneProgram<Code>| {
            let mechanism = lowered.declared.mechanism;
            let scene = &mechanism.scenes[scene.signatures.id];
            let parameters = || scene.parameters.iter().map(|id| &mechanism.scene_parameters[*id]);
            Self {
                name: scene.name.to_string(),
                parameters: parameters().map(|one| (one.name.text.clone(), one.measure)).collect(),
                defaults: parameters().map(Parameter::default_in_words).collect(),
                has_inertia: scene.inertia.is_some(),
                has_equilibrium: scene.requests.contains(&SceneRequest::Equilibrium),
            }
        };
        lowered.program.scenes.iter().map(of).collect()
    }
}

/// The use of a scene: that it has what is needed, and the statement that gives it.
pub struct Need {
    pub is_met: fn(&AboutScene) -> bool,
    pub statement: &'static str,
}

/// The place of the scene of a mechanism with a name, or of the only one that has what is needed.
pub fn chosen(mechanism: &str, all: &[AboutScene], asked: Option<&str>, need: &Need) -> Result<usize, Failure> {
    let wrong = |message: String| Err(Failure::Argument(message));
    if all.is_empty() {
        return wrong(format!("`{}` has no scene: write one into its text", mechanism));
    }
    let names: Vec<&str> = all.iter().map(|scene| scene.name.as_str()).collect();
    let lacks = |what: String| format!("{what} has no `{}`", need.statement);
    if let Some(asked) = asked {
        let place = place(mechanism, "scene", asked, &names)?;
        return if (need.is_met)(&all[place]) { Ok(place) } else { wrong(lacks(format!("the scene `{asked}`"))) };
    }
    let able: Vec<usize> = (0..all.len()).filter(|place| (need.is_met)(&all[*place])).collect();
    match able.as_slice() {
        [only] => Ok(*only),
        [] if names.len() == 1 => wrong(lacks(format!("the scene `{}`", names[0]))),
        [] => wrong(lacks(format!("each of the scenes {}", listed(&names)))),
        several => {
            let of: Vec<&str> = several.iter().map(|place| names[*place]).collect();
            wrong(format!("`{}` has the scenes {}: write --scene NAME", mechanism, listed(&of)))
        }
    }
}
