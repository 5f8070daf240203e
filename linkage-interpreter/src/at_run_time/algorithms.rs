//! The algorithms that functions of a mechanism call on the mechanism itself.

use std::sync::Arc;

use linkage_dynamics::__rt::{bearing_loss, drive_forces, reactions};
use linkage_dynamics::MotionError;
use linkage_ir::Name;
use linkage_runtime::limits::{Bound, Limit, Limits, Search, limits};
use linkage_runtime::{PositionError, RangeEnd, UpTo, newton, newton_any_branch};

use super::read::{number, numbers};
use super::{AtRunTime, MOST_INPUTS, NotPrepared, PoseAtRunTime, Prepared, PreparedScene, SceneAtRunTime};
use crate::call_error::CallError;
use crate::error::Error;
use crate::machine::{Algorithms, AroundPosition, Defect, Evaluated, Failure, Load, Moving, Value, Whole};

/// The algorithms of the runtime.
pub(crate) struct OfTheRuntime;

/// The number of inputs as a value.
type Inputs = UpTo<MOST_INPUTS>;

impl From<NotPrepared> for Box<Failure> {
    fn from(reason: NotPrepared) -> Self {
        match reason {
            NotPrepared::TooLarge { of, count, most } => Error::TooLarge { of, count, most }.into(),
            NotPrepared::Defect(defect) => defect.into(),
            other => Defect::new(other.to_string()).into(),
        }
    }
}

/// Runs an algorithm on a mechanism. A failure of a call that is no error of the mechanism comes first.
fn run(
    of: Whole<'_>,
    algorithm: impl for<'a> FnOnce(&AtRunTime<'a, Inputs>) -> Result<Value, PositionError<&'a str>>,
) -> Evaluated<Value> {
    let prepared = Prepared::of(of.driver, of.users, of.own)?;
    let found = algorithm(&prepared.with_inputs()?);
    unless(prepared.failure(), found.map_err(Error::from))
}

/// Runs an algorithm on a scene, likewise.
fn run_scene(
    of: Whole<'_>,
    moving: &Moving<'_>,
    algorithm: impl for<'a> FnOnce(&SceneAtRunTime<'a, Inputs>) -> Result<Value, MotionError<&'a str>>,
) -> Evaluated<Value> {
    let prepared = PreparedScene::of(of.driver, of.users, moving.scene, of.own)?;
    let found = algorithm(&prepared.with_inputs()?);
    unless(prepared.failure(), found.map_err(Error::from))
}

/// The result of an algorithm, unless a call has failed.
fn unless(failure: Option<CallError>, found: Result<Value, Error>) -> Evaluated<Value> {
    match failure {
        None => Ok(found?),
        Some(CallError::Function(error)) => Err(error.into()),
        Some(CallError::Defect(defect)) => Err(defect.into()),
        Some(CallError::Mistake(mistake)) => Err(Defect::new(mistake.to_string()).into()),
    }
}

impl Algorithms for OfTheRuntime {
    fn newton(&self, of: Whole<'_>, guess: &Value, is_on_any_branch: bool) -> Evaluated<Value> {
        run(of, |mechanism| {
            let guess = mechanism.read_coordinates(guess);
            let solution = |coordinates, iterations: usize, residual| {
                [
                    (Name::COORDINATES, mechanism.coordinates_value(coordinates)),
                    (Name::ITERATIONS, Value::Count(iterations as i64)),
                    (Name::RESIDUAL, Value::Number(residual)),
                ]
            };
            Ok(match is_on_any_branch {
                false => {
                    let found = newton(mechanism, &guess)?;
                    Value::record(solution(&found.coordinates, found.iterations, found.residual))
                }
                true => {
                    let found = newton_any_branch(mechanism, &guess)?;
                    let fields = solution(&found.coordinates, found.iterations, found.residual);
                    let same_branch = [(Name::SAME_BRANCH, Value::Flag(found.same_branch))];
                    Value::record(fields.into_iter().chain(same_branch))
                }
            })
        })
    }

    fn limits(&self, of: Whole<'_>, about: &AroundPosition<'_>) -> Evaluated<Value> {
        let &AroundPosition { place, position, bounds, search, assemble } = about;
        run(of, |mechanism| {
            let prepared = mechanism.prepared;
            let bounds = bounds.iter().filter_map(|bound| bound_of(bound, prepared));
            let search = match search {
                Value::Number(reach) => Search::Length(*reach),
                Value::Flag(_) => Search::Turn,
                _ => Search::ClosedFormOnly,
            };
            let assemble = |near: &_| match assemble(mechanism.coordinates_value(near)) {
                Ok(pose) => Ok(mechanism.read_pose(pose)),
                Err(failure) => Err(prepared.error(failure)),
            };
            let position = mechanism.read_pose(position.clone());
            let coordinates = |pose: &PoseAtRunTime<Inputs>| pose.coordinates;
            let found = limits(mechanism, place, &position, bounds, search, assemble, coordinates)?;
            Ok(limits_value(found))
        })
    }

    fn load(&self, of: Whole<'_>, moving: &Moving<'_>, load: Load) -> Evaluated<Value> {
        run_scene(of, moving, |scene| {
            let (mechanism, t) = (scene.mechanism, moving.t);
            let (q, rates) = (mechanism.read_coordinates(moving.q), mechanism.read_inputs(moving.input_rates));
            Ok(match load {
                Load::Joints => reactions(scene, t, &q, rates)?.value(moving.scene),
                Load::Drives => mechanism.inputs_value(&drive_forces(scene, t, &q, rates)?),
                Load::LossOfBearings => Value::Number(bearing_loss(scene, t, &q, rates)?),
            })
        })
    }
}

/// A function that is not negative where a group can be assembled.
fn bound_of<'p>(value: &Value, prepared: &'p Prepared<'_>) -> Option<Bound<f64, &'p str>> {
    let [group, coefficients, rate @ ..] = value.as_list().ok()? else { return None };
    let [place, _] = group.as_list().ok()? else { return None };
    let place = place.as_count().ok()?;
    let group = (place, prepared.groups.get(place)?.name);
    let coefficients = numbers(coefficients).as_slice().try_into().ok()?;
    Some(match rate {
        [] => Bound::Length(group, coefficients),
        [rate, ..] => Bound::Angle(group, coefficients, number(rate)),
    })
}

/// Limits by name, as serde writes them.
fn limits_value(Limits { of, is_angle, lower, upper }: Limits<f64, &str>) -> Value {
    let fields = [
        (Name::OF, text(of)),
        (Name::IS_ANGLE, Value::Flag(is_angle)),
        (Name::LOWER, limit_value(lower)),
        (Name::UPPER, limit_value(upper)),
    ];
    Value::record(fields)
}

fn limit_value(limit: Limit<f64, &str>) -> Value {
    let kind = |name, fields: Vec<(Name, Value)>| Value::record([(name, Value::record(fields))]);
    match limit {
        Limit::Unlimited => text("Unlimited"),
        Limit::Exact { input, group } => {
            kind(Name::EXACT, vec![(Name::INPUT, Value::Number(input)), (Name::GROUP, text(group))])
        }
        Limit::JointRange { input, of, end } => {
            let end = text(if end == RangeEnd::Least { "Least" } else { "Most" });
            kind(Name::JOINT_RANGE, vec![(Name::INPUT, Value::Number(input)), (Name::OF, text(of)), (Name::END, end)])
        }
        Limit::Bracketed { assembled, unbuildable, group } => {
            let [assembled, unbuildable] = [assembled, unbuildable].map(Value::Number);
            let ends = [(Name::ASSEMBLED, assembled), (Name::UNBUILDABLE, unbuildable)];
            kind(Name::BRACKETED, ends.into_iter().chain([(Name::GROUP, text(group))]).collect())
        }
    }
}

fn text(text: &str) -> Value {
    Value::Text(Arc::from(text))
}
