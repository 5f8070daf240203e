//! From a driver as the compiler lowered it to one that is run.

use std::sync::Arc;

use linkage_compiler::Lowered;
use linkage_compiler::derivation;
use linkage_compiler::ids::{FunctionId, Table};
use linkage_compiler::lower::Code;
use linkage_compiler::program::{
    self, ConstantValue, Family, Implemented, MULTIPLIERS, Program, SceneProgram, TypeNames,
};

use crate::code::{Function, Name, Names};
use crate::program::{
    Coordinate, Driver, Group, Implementation, Joint, Kink, Lanes, Parameter, Part, Scene, SceneTypes, Side, Types,
    UserFunction, Written,
};
use crate::translate::{Context, Untranslated, formulas};

/// The driver with its scenes.
pub(crate) fn driver(lowered: &Lowered) -> Result<Driver, Untranslated> {
    let Program { signatures, position, functions, implementations, scenes, .. } = &lowered.program;
    let types = &signatures.types;
    let mut names = Names::default();
    let implementation = |of: Implemented, on: &str| {
        implementations.iter().find(move |one| one.of == of && one.on == on).map(|one| one.functions.as_slice())
    };
    let of_pose = implementation(Implemented::Itself, &types.pose).unwrap_or_default();
    let of_branch = implementation(Implemented::Itself, &types.branch).unwrap_or_default();
    let listed = places(functions);
    let context = Context {
        types,
        points: Family::Points.names(signatures),
        outputs: Family::Outputs.names(signatures),
        own: listed.clone(),
        of_driver: listed,
        of_pose: of_pose.iter().map(|function| function.name.clone()).collect(),
        of_branch: of_branch.iter().map(|function| function.name.clone()).collect(),
        users: signatures.user_functions.iter().enumerate().map(|(place, function)| (function.id, place)).collect(),
    };
    let traits = implementations.iter().filter(|one| one.of != Implemented::Itself);
    let traits = traits.map(|one| implemented(one, &context, &mut names)).collect::<Result<_, _>>()?;
    let all = |functions: &[program::Function<Code>], names: &mut Names| -> Result<Vec<Function>, Untranslated> {
        functions.iter().map(|function| context.function(function, names)).collect()
    };
    let (of_pose, of_branch) = (all(of_pose, &mut names)?, all(of_branch, &mut names)?);
    let own = listed_functions(functions, &context, &mut names)?;
    let scenes = scenes.iter().map(|one| scene(one, &context, &mut names)).collect::<Result<_, _>>()?;
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
        types: type_names(types, &mut names),
        functions: own,
        of_pose,
        of_branch,
        traits,
        scenes,
        lanes: lanes(implementations),
        written: written(implementations),
        formulas: formulas(lowered)?,
        names,
    })
}

fn type_names(types: &TypeNames, names: &mut Names) -> Types {
    Types {
        mechanism: names.of(&types.driver),
        inputs: names.of(&types.inputs),
        coordinates: names.of(&types.coordinates),
        points: names.of(&types.points),
        outputs: names.of(&types.outputs),
        branch: names.of(&types.branch),
        point_motion: names.of("PointMotion"),
        output_motion: names.of("OutputMotion"),
        assembled: names.of("Assembled"),
    }
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

/// The places of the functions that are emitted, by their ids.
fn places(functions: &program::Functions<Code>) -> Vec<Option<usize>> {
    let by_id: &Table<FunctionId, program::Function<Code>> = functions.by_id();
    let place = |of: &program::Function<Code>| functions.iter().position(|other| std::ptr::eq(of, other));
    by_id.iter().map(place).collect()
}

fn listed_functions(
    functions: &program::Functions<Code>,
    context: &Context,
    names: &mut Names,
) -> Result<Vec<Function>, Untranslated> {
    functions.iter().map(|function| context.function(function, names)).collect()
}

fn implemented(
    of: &program::Implementation<Code>,
    context: &Context,
    names: &mut Names,
) -> Result<Implementation, Untranslated> {
    let functions = of.functions.iter().map(|function| context.function(function, names));
    let of = of.of.name().unwrap_or_default().to_owned();
    Ok(Implementation { of, functions: functions.collect::<Result<_, _>>()? })
}

fn scene(of: &SceneProgram<Code>, driver: &Context, names: &mut Names) -> Result<Scene, Untranslated> {
    let SceneProgram { signatures, functions, implementation } = of;
    let context = Context {
        types: &signatures.types,
        points: driver.points.clone(),
        outputs: driver.outputs.clone(),
        own: places(functions),
        of_driver: driver.of_driver.clone(),
        of_pose: driver.of_pose.clone(),
        of_branch: driver.of_branch.clone(),
        users: driver.users.clone(),
    };
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
    Ok(Scene {
        name: signatures.scene.as_str().into(),
        types: SceneTypes { scene: names.of(&signatures.types.itself), state: names.of("StateParts") },
        field: names.of(&signatures.field),
        parameters: signatures.parameters.iter().map(|parameter| names.of(&parameter.name.field)).collect(),
        about_parameters: signatures.parameters.iter().map(parameter).collect(),
        functions: listed_functions(functions, &context, names)?,
        implementation: implementation.as_ref().map(|one| implemented(one, &context, names)).transpose()?,
        contacts: signatures.contacts.len(),
        has_bearings: signatures.count_bearings() > 0,
        kinks: kinks.into_iter().flatten().map(kink).collect(),
        joints: signatures.joints.iter().map(joint).collect(),
        forces,
    })
}
