//! The emitted program as data: which functions a mechanism gets, before they are lowered and printed.
//!
//! [`plan`] makes the functions of a driver and of its scenes: name, arguments, return type, the steps and formulas of
//! the kernel, and the value made of their results. [`Implementation`] has those of poses and branches, and those of the
//! traits of the runtime. [`stub`] makes those of a mechanism with mistakes.

mod any_number;
mod branch;
mod branch_functions;
mod doc;
mod equations;
mod expression;
mod function;
mod functions;
mod implementation;
mod implementations;
mod implied;
mod kinematics;
mod lane_columns;
mod lane_functions;
mod lanes;
mod length_scale;
mod limits;
mod names;
mod plan;
mod pose;
mod pose_fields;
mod pose_functions;
mod position;
mod precise;
mod quantities;
mod ranges;
mod rates;
mod ratio_derivatives;
mod scene;
mod sensitivity;
mod signatures;
mod stored;

use crate::budget::Spent;
use crate::derivation::{ClosedForm, Derivation, Formulas, Skeleton};
use crate::graph::NodeId;
use crate::ids::{GroupId, Table};
use crate::model::{Driver, Mechanism, Request};
use plan::Plan;
use scene::ScenePlan;

pub use crate::derivation::Part;
pub use any_number::AnyNumber;
pub use branch::{AngleTurn, Modes, Position, Side};
pub use doc::count;
pub use expression::{Expression, Pattern, Receiver, Statement, Type, Variable};
pub use function::{Access, Argument, Body, Failure, Function, Kernel, Output, Passed, Shape, Source, Stored, Value};
pub use functions::Functions;
pub use implementation::{Associated, ConstantValue, Group, Implementation, Implemented, Kink};
pub use lane_columns::Column;
pub use linkage_ir::code::{Code, Names};
pub use linkage_ir::{
    CheckKind, Constant, Entry, Finite, Form, InLane, Intrinsic, LaneResult, Meaning, Operations, Role, Row,
};
pub use names::{Arguments, LONGEST_NAME, Order, Taken, TypeNames, call_of, emitted_types, type_names};
pub use pose::{Given, PosePlan};
pub use pose_fields::{Held, PoseField};
pub use precise::ROUGH;
pub use scene::{Joint, MULTIPLIERS, SceneProgram, SceneSignatures};
pub use signatures::{Coordinate, Family, Name, Parameter, Signatures, UserFunction};

/// The program of one driver of a mechanism; `B` is the body of a function, planned or lowered, `D` the derived data,
/// which a stub lacks.
pub struct Program<B, D = Option<Derived>> {
    pub signatures: Signatures,
    pub position: Position,
    pub functions: Functions<B>,
    /// The functions of its pose, and the traits that it implements.
    pub implementations: Vec<Implementation<B>>,
    /// The columns that `Lanes` finds, if it is requested.
    pub columns: Vec<Column>,
    pub scenes: Vec<SceneProgram<B>>,
    /// The formulas over numbers of any kind, on request.
    pub any_number: Option<AnyNumber<B>>,
    pub derived: D,
    /// The names of fields in lowered code.
    pub names: Names,
}

/// The derived data that bodies of functions and types are made of.
pub struct Derived {
    pub pose: PosePlan,
    pub formulas: Formulas,
    /// The closed form of the position of each group.
    pub closed_forms: Table<GroupId, ClosedForm>,
    /// The expressions that have names.
    pub named: Vec<(NodeId, String)>,
    /// The fields of the pose, and those that hold each coordinate.
    pub fields: Vec<PoseField>,
    pub held: Vec<(String, Held)>,
    pub groups: Vec<Group>,
    /// The drawing, on request.
    pub skeleton: Skeleton,
}

/// Plans the functions of a driver and of its scenes.
///
/// # Errors
/// [`Spent`] if the budget of the invocation is.
pub fn plan(
    mechanism: &Mechanism,
    driver: &Driver,
    derivation: &mut Derivation,
) -> Result<Program<Body, Derived>, Spent> {
    let mut plan = Plan::of(mechanism, driver, derivation);
    let mut scenes = Vec::new();
    for (number, (scene, _)) in mechanism.scenes_of(driver).enumerate() {
        mechanism.graph.budget().check()?;
        scenes.extend(ScenePlan::of(&mut plan, scene, number).map(ScenePlan::into_program));
    }
    let any_number = mechanism.requests.contains(&Request::Intervals).then(|| plan.any_number());
    let closed_forms = plan.derivation.closed_forms(&plan.assembly);
    let Plan { signatures, position, functions, pose, formulas, named, derivation, .. } = plan;
    let functions: Functions<Body> = functions.into_iter().collect();
    let derived = Derived {
        fields: pose.fields(derivation),
        held: pose.held(derivation),
        groups: derivation.groups.iter().map(|group| Group::of(group, derivation)).collect(),
        skeleton: derivation.skeleton.clone().unwrap_or_default(),
        pose,
        formulas,
        closed_forms,
        named,
    };
    let (implementations, columns) = implementations::of_driver(&signatures, &position, &functions, Some(&derived));
    let names = Names::default();
    Ok(Program { signatures, position, functions, implementations, columns, scenes, any_number, derived, names })
}

/// The program of a mechanism with mistakes: functions without bodies.
pub fn stub<B>(mechanism: &Mechanism, driver: &Driver) -> Program<B> {
    let (signatures, position) = (Signatures::new(mechanism, driver), Position::guessed(mechanism, driver));
    let functions: Functions<B> = signatures.all(&position).into_iter().map(Function::without_body).collect();
    let (implementations, columns) = implementations::of_driver(&signatures, &position, &functions, None);
    let implementations = implementations.into_iter().map(|of| of.without_choice(|_| true).without_bodies()).collect();
    let scenes = mechanism.scenes_of(driver).map(|(scene, _)| {
        let signatures = SceneSignatures::new(mechanism, driver, scene);
        let functions = signatures.all().into_iter().map(Function::without_body).collect();
        let implementation = scene::implementation(&signatures, Vec::new(), &[]);
        SceneProgram { implementation: implementation.map(Implementation::without_bodies), signatures, functions }
    });
    let scenes = scenes.collect();
    let any_number = mechanism.requests.contains(&Request::Intervals).then(|| AnyNumber {
        functions: signatures.of_columns().into_iter().map(Function::without_body).collect(),
        user_functions: Vec::new(),
    });
    let names = Names::default();
    Program { signatures, position, functions, implementations, columns, scenes, any_number, derived: None, names }
}
