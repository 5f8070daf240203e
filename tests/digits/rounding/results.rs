//! The results of all emitted functions as lists, in any scalar.

use linkage::nalgebra::DMatrix;
use linkage::{PositionError, Real};
use linkage_gallery::{HigherOrders, Kinematics};

/// A function and its results, or the message of its error.
pub type Results<T> = Vec<(&'static str, Result<Vec<T>, String>)>;

/// The arguments of the functions.
#[derive(Clone)]
pub struct Arguments<T> {
    pub parameters: Vec<T>,
    pub q: Vec<T>,
    pub rates: Vec<T>,
    pub accelerations: Vec<T>,
}

impl<T: Copy> Arguments<T> {
    pub fn map<U>(&self, f: impl Fn(T) -> U) -> Arguments<U> {
        let all = |list: &[T]| list.iter().copied().map(&f).collect();
        Arguments {
            parameters: all(&self.parameters),
            q: all(&self.q),
            rates: all(&self.rates),
            accelerations: all(&self.accelerations),
        }
    }
}

fn listed<T: Real>(result: Result<Vec<T>, PositionError>) -> Result<Vec<T>, String> {
    result.map_err(|error| error.to_string())
}

fn entries<T: Real>(result: Result<DMatrix<T>, PositionError>) -> Result<Vec<T>, String> {
    listed(result.map(|matrix| matrix.as_slice().to_vec()))
}

fn all_entries<T: Real>(result: Result<Vec<DMatrix<T>>, PositionError>) -> Result<Vec<T>, String> {
    listed(result.map(|all| all.iter().flat_map(|matrix| matrix.as_slice().to_vec()).collect()))
}

/// The functions of a pose.
fn at_pose<T: Real, M: Kinematics<T>>(m: &M, pose: &M::Pose, arguments: &Arguments<T>) -> Results<T> {
    let (v1, v2) = (M::inputs_of(&arguments.rates), M::inputs_of(&arguments.accelerations));
    let velocity = m.velocity(pose, &v1);
    let rates = velocity.clone().unwrap_or_else(|_| arguments.rates.clone());
    let acceleration = m.acceleration(pose, &rates, &v2);
    let bent = acceleration.clone().unwrap_or_else(|_| arguments.accelerations.clone());
    let unknowns = |all: linkage::PerUnknown<M>| all.iter().copied().collect::<Vec<T>>();
    vec![
        ("coordinates", Ok(M::listed(pose))),
        ("residual", Ok(unknowns(m.residual(pose)))),
        ("determinant", Ok(vec![m.determinant(pose)])),
        ("jacobian", entries(Ok(m.jacobian(pose)))),
        ("gamma", Ok(m.gamma_of(pose, &arguments.rates))),
        ("solve_jacobian", listed(m.solve_jacobian(pose, &m.residual(pose)).map(unknowns))),
        ("velocity ratios", entries(m.velocity_ratios(pose))),
        ("velocity", listed(velocity)),
        ("acceleration", listed(acceleration)),
        ("points", listed(m.points(pose))),
        ("point velocities", listed(m.point_velocities(pose, &rates))),
        ("point accelerations", listed(m.point_accelerations(pose, &rates, &bent))),
        ("point ratios", all_entries(m.point_ratios(pose))),
        ("outputs", listed(m.outputs(pose))),
        ("output velocities", listed(m.output_velocities(pose, &rates))),
        ("output accelerations", listed(m.output_accelerations(pose, &rates, &bent))),
        ("output ratios", all_entries(m.output_ratios(pose))),
    ]
}

/// The functions that find a position, and those of the position.
pub fn assembled<T: Real, M: Kinematics<T>>(arguments: &Arguments<T>, branch: usize) -> Results<T> {
    let m = M::with_parameters(&arguments.parameters);
    let (v1, v2) = (M::inputs_of(&arguments.rates), M::inputs_of(&arguments.accelerations));
    let moving = m.moving(&arguments.q, branch, &v1, &v2, true).map(|moving| {
        let lists = moving.points.into_iter().chain(moving.outputs).flatten();
        [M::listed(&moving.pose), moving.rates, moving.accelerations].into_iter().chain(lists).flatten().collect()
    });
    let mut all = vec![("full_kinematics", listed(moving))];
    match m.assembled(&arguments.q, branch) {
        Ok(pose) => all.extend(at_pose(&m, &pose, arguments)),
        Err(error) => all.push(("assemble", Err(error.to_string()))),
    }
    all
}

/// The functions at given coordinates.
pub fn given<T: Real, M: Kinematics<T>>(arguments: &Arguments<T>) -> Results<T> {
    let m = M::with_parameters(&arguments.parameters);
    let (v1, v2) = (M::inputs_of(&arguments.rates), M::inputs_of(&arguments.accelerations));
    let motion = m.motion(&arguments.q, &v1, &v2);
    let motion = motion.map(|all| [all.coordinates, all.points, all.outputs].into_iter().flatten().flatten().collect());
    let mut all = at_pose(&m, &m.pose(&arguments.q), arguments);
    all.push(("motion", listed(motion)));
    all
}

/// The functions of higher order.
pub fn higher_orders<T: Real, M: HigherOrders<T>>(arguments: &Arguments<T>) -> Results<T> {
    let m = M::with_parameters(&arguments.parameters);
    let pose = m.pose(&arguments.q);
    let (rates, bent) = (&arguments.rates, &arguments.accelerations);
    let jerk = m.jerk(&pose, rates, bent, &M::inputs_of(rates));
    let of_jerk = jerk.clone().unwrap_or_else(|_| bent.clone());
    vec![
        ("jerk", listed(jerk)),
        ("point jerks", listed(m.point_jerks(&pose, [rates, bent, &of_jerk]))),
        ("output jerks", listed(m.output_jerks(&pose, [rates, bent, &of_jerk]))),
        ("velocity ratio derivatives", all_entries(m.velocity_ratio_derivatives(&pose))),
        ("point ratio derivatives", all_entries(m.point_ratio_derivatives(&pose))),
        ("output ratio derivatives", all_entries(m.output_ratio_derivatives(&pose))),
        ("sensitivity", entries(m.sensitivity(&pose))),
        ("point sensitivities", all_entries(m.point_sensitivities(&pose))),
        ("output sensitivities", all_entries(m.output_sensitivities(&pose))),
    ]
}
