//! From a driver as the compiler lowered it to one that is run.

use std::sync::Arc;

use linkage_compiler::program::{self, ConstantValue, Implemented, MULTIPLIERS, Program, SceneProgram};
use linkage_compiler::{Lowered, derivation};
use linkage_ir::Name;
use linkage_ir::code::{Code, Function, Names, Readable};

use crate::formulas::{Untranslated, formulas};
use crate::program::{
    Coordinate, Driver, Group, Implementation, Joint, Kink, Lanes, Parameter, Part, Scene, Side, UserFunction, Written,
};

/// The driver with its scenes.
pub(crate) fn driver(lowered: &Lowered) -> Result<Driver, Untranslated> {
    let Program { signatures, position, functions, implementations, scenes, names, .. } = &lowered.program;
    let types = &signatures.types;
    let mut names = names.clone();
    let own = |on: &str| {
        let of = implementations.iter().find(|one| one.of == Implemented::Itself && one.on == on);
        of.map(|one| all(&one.functions)).unwrap_or_default()
    };
    let traits = implementations.iter().filter(|one| one.of != Implemented::Itself).map(implemented).collect();
    let scenes = scenes.iter().map(|one| scene(one, &mut names)).collect();
    let mut numbers =
        |of: &mut dyn Iterator<Item = &program::Name>| of.map(|name| names.of(&name.field)).collect::<Vec<Name>>();
    Ok(Driver {
        mechanism: signatures.mechanism.clone(),
        name: signatures.driver.as_str().into(),
        parameters: numbers(&mut signatures.parameters.iter().map(|parameter| &parameter.name)),
        about_parameters: signatures.parameters.iter().map(parameter).collect(),
        about_coordinates: signatures
            .coordinates
            .iter()
            .map(|of| Coordinate { text: of.name.text.clone(), is_angle: of.is_angle })
            .collect(),
        input_texts: signatures.inputs.iter().map(|of| of.name.text.as_str().into()).collect(),
        input_angles: signatures.inputs.iter().map(|of| of.is_angle).collect(),
        coordinates: numbers(&mut signatures.coordinates.iter().map(|of| &of.name)),
        unknowns: numbers(&mut signatures.unknowns.iter().map(|of| &of.name)),
        inputs: numbers(&mut signatures.inputs.iter().map(|of| &of.name)),
        points: numbers(&mut signatures.points.iter()),
        outputs: numbers(&mut signatures.outputs.iter()),
        turns: position.turns_of_branch().iter().map(|turn| names.of(&turn.field)).collect(),
        sides: position
            .sides
            .iter()
            .map(|side| Side {
                field: names.of(&side.field),
                solutions: side.choice.variants().map(Arc::from),
                meaning: side.meaning.clone(),
            })
            .collect(),
        modes: position.modes.iter().map(|modes| (names.of(&modes.field), modes.most)).collect(),
        users: signatures
            .user_functions
            .iter()
            .map(|of| UserFunction { names: of.names.clone(), arguments: of.arguments })
            .collect(),
        types: types.clone(),
        functions: all(functions),
        of_pose: own(&types.pose),
        of_branch: own(&types.branch),
        traits,
        scenes,
        lanes: lanes(implementations),
        written: written(implementations),
        formulas: formulas(lowered)?,
        names,
    })
}

fn parameter(of: &program::Parameter) -> Parameter {
    Parameter { text: of.name.text.clone(), default: of.default }
}

/// The columns of many positions.
fn lanes(implementations: &[program::Implementation<Code>]) -> Lanes {
    let mut lanes = Lanes::default();
    let of = implementations.iter().filter(|one| one.of == Implemented::Lanes);
    for (name, value) in of.flat_map(|one| &one.constants) {
        match (*name, value) {
            ("GIVEN", ConstantValue::Texts(names)) => lanes.given.clone_from(names),
            ("FOUND", ConstantValue::Texts(names)) => lanes.found.clone_from(names),
            ("START", ConstantValue::Count(count)) => lanes.start = *count,
            ("COORDINATES", ConstantValue::Count(count)) => lanes.coordinates = *count,
            _ => {}
        }
    }
    lanes
}

/// A joint whose force is shown.
fn joint(of: &program::Joint) -> Joint {
    Joint { name: of.name.clone(), at: of.at.clone(), on: of.on.clone(), place: of.place }
}

/// The names as written, the groups, and the drawing.
fn written(implementations: &[program::Implementation<Code>]) -> Written {
    let mut written = Written::default();
    let of = implementations
        .iter()
        .filter(|one| matches!(one.of, Implemented::Mechanism | Implemented::Kinematic | Implemented::Skeleton));
    for (name, value) in of.flat_map(|one| &one.constants) {
        match (*name, value) {
            ("UNKNOWNS", ConstantValue::Texts(names)) => written.unknowns.clone_from(names),
            ("UNKNOWN_ANGLES", ConstantValue::Flags(flags)) => written.unknown_angles.clone_from(flags),
            ("RANGES", ConstantValue::Texts(names)) => written.ranges.clone_from(names),
            ("POINTS", ConstantValue::Texts(names)) => written.points.clone_from(names),
            ("OUTPUTS", ConstantValue::Texts(names)) => written.outputs.clone_from(names),
            ("GROUPS", ConstantValue::Groups(groups)) => {
                let group = |of: &program::Group| Group {
                    name: of.name.clone(),
                    equations: of.equations.clone(),
                    unknowns: of.unknowns.clone(),
                };
                written.groups = groups.iter().map(group).collect();
            }
            ("JOINTS", ConstantValue::Texts(names)) => written.drawing.get_or_insert_default().joints.clone_from(names),
            ("PARTS", ConstantValue::Parts(parts)) => {
                written.drawing.get_or_insert_default().parts = parts.iter().map(part).collect();
            }
            _ => {}
        }
    }
    written
}

fn part(of: &derivation::Part) -> Part {
    match *of {
        derivation::Part::Ground(joint) => Part::Ground(joint),
        derivation::Part::Bar { ref joints, is_driven } => Part::Bar { joints: joints.clone(), is_driven },
        derivation::Part::Slider(joint) => Part::Slider(joint),
        derivation::Part::Sleeve { pin, on, towards } => Part::Sleeve { pin, on, towards },
        derivation::Part::Trace(joint) => Part::Trace(joint),
    }
}

/// These functions without what only those who read them need.
fn all<'f>(functions: impl IntoIterator<Item = &'f Function>) -> Vec<Function> {
    let code = |of: &Code| {
        let Code { slots, values, statements, value, readable: _ } = of;
        let (values, statements) = (values.clone(), statements.clone());
        Code { slots: *slots, values, statements, value: *value, readable: Readable::default() }
    };
    let run = |of: &Function| {
        let Function { name, doc: _, access, is_method, arguments, returns, is_fallible, body } = of;
        let (name, arguments, returns) = (name.clone(), arguments.clone(), returns.clone());
        let (doc, body) = (Vec::new(), body.as_ref().map(code));
        Function {
            name,
            doc,
            access: *access,
            is_method: *is_method,
            arguments,
            returns,
            is_fallible: *is_fallible,
            body,
        }
    };
    functions.into_iter().map(run).collect()
}

fn implemented(of: &program::Implementation<Code>) -> Implementation {
    Implementation { of: of.of.name().unwrap_or_default().to_owned(), functions: all(&of.functions) }
}

fn scene(of: &SceneProgram<Code>, names: &mut Names) -> Scene {
    let SceneProgram { signatures, functions, implementation } = of;
    let constants = implementation.iter().flat_map(|one| &one.constants);
    let kinks =
        constants.clone().find_map(|(_, value)| if let ConstantValue::Kinks(all) = value { Some(all) } else { None });
    let kink = |of: &program::Kink| Kink { effect: of.effect.clone(), is_timed: of.is_timed };
    let mut forces: Vec<(Name, Option<usize>)> = Vec::new();
    for joint in &signatures.joints {
        let length = joint.at.as_ref().map(|_| 2);
        forces.extend(joint.fields.iter().map(|field| (names.of(field), length)));
    }
    if signatures.has_multipliers() {
        forces.push((names.of(MULTIPLIERS), Some(signatures.dependent.len())));
    }
    Scene {
        name: signatures.scene.as_str().into(),
        field: names.of(&signatures.field),
        parameters: signatures.parameters.iter().map(|parameter| names.of(&parameter.name.field)).collect(),
        about_parameters: signatures.parameters.iter().map(parameter).collect(),
        functions: all(functions),
        implementation: implementation.as_ref().map(implemented),
        contacts: signatures.contacts.len(),
        has_bearings: signatures.count_bearings() > 0,
        kinks: kinks.into_iter().flatten().map(kink).collect(),
        joints: signatures.joints.iter().map(joint).collect(),
        forces,
    }
}
