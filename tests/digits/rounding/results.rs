//! The results of all emitted functions as lists, in any scalar.

use linkage::nalgebra::DMatrix;
use linkage::{PositionError, Real};
use linkage_gallery::listed::{Listed, ListedWithOrders, Posed};

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
fn at_pose<T: Real>(of: &dyn Listed<T>, pose: &dyn Posed<T>, arguments: &Arguments<T>) -> Results<T> {
    let (v1, v2) = (of.inputs_of(&arguments.rates), of.inputs_of(&arguments.accelerations));
    let velocity = pose.velocity(&v1);
    let rates = velocity.clone().unwrap_or_else(|_| arguments.rates.clone());
    let acceleration = pose.acceleration(&rates, &v2);
    let bent = acceleration.clone().unwrap_or_else(|_| arguments.accelerations.clone());
    vec![
        ("coordinates", Ok(pose.coordinates())),
        ("residual", Ok(pose.residual())),
        ("determinant", Ok(vec![pose.determinant()])),
        ("jacobian", entries(Ok(pose.jacobian()))),
        ("gamma", Ok(pose.gamma(&arguments.rates))),
        ("solve_jacobian", listed(pose.solve_jacobian(&pose.residual()))),
        ("velocity ratios", entries(pose.velocity_ratios())),
        ("velocity", listed(velocity)),
        ("acceleration", listed(acceleration)),
        ("points", listed(pose.points())),
        ("point velocities", listed(pose.point_velocities(&rates))),
        ("point accelerations", listed(pose.point_accelerations(&rates, &bent))),
        ("point ratios", all_entries(pose.point_ratios())),
        ("outputs", listed(pose.outputs())),
        ("output rates", listed(pose.output_rates(&rates))),
        ("output accelerations", listed(pose.output_accelerations(&rates, &bent))),
        ("output ratios", all_entries(pose.output_ratios())),
    ]
}

/// The functions that find a position, and those of the position.
pub fn assembled<T: Real>(of: &dyn Listed<T>, arguments: &Arguments<T>, branch: usize) -> Results<T> {
    let m = of.with_parameters(&arguments.parameters);
    let (v1, v2) = (of.inputs_of(&arguments.rates), of.inputs_of(&arguments.accelerations));
    let moving = m.moving(&arguments.q, branch, &v1, &v2, true).map(|moving| {
        let lists = moving.points.into_iter().chain(moving.outputs).flatten();
        [moving.pose.coordinates(), moving.rates, moving.accelerations].into_iter().chain(lists).flatten().collect()
    });
    let mut all = vec![("full_kinematics", listed(moving))];
    match m.assembled(&arguments.q, branch) {
        Ok(pose) => all.extend(at_pose(of, &*pose, arguments)),
        Err(error) => all.push(("assemble", Err(error.to_string()))),
    }
    all
}

/// The functions at given coordinates.
pub fn given<T: Real>(of: &dyn Listed<T>, arguments: &Arguments<T>) -> Results<T> {
    let m = of.with_parameters(&arguments.parameters);
    let (v1, v2) = (of.inputs_of(&arguments.rates), of.inputs_of(&arguments.accelerations));
    let motion = m.motion(&arguments.q, &v1, &v2);
    let motion = motion.map(|all| [all.coordinates, all.points, all.outputs].into_iter().flatten().flatten().collect());
    let mut all = at_pose(of, &*m.pose(&arguments.q), arguments);
    all.push(("motion", listed(motion)));
    all
}

/// The functions of higher order.
pub fn higher_orders<T: Real>(of: &dyn ListedWithOrders<T>, arguments: &Arguments<T>) -> Results<T> {
    let pose = of.at(&arguments.parameters, &arguments.q);
    let (rates, bent) = (&arguments.rates, &arguments.accelerations);
    let jerk = pose.jerk(rates, bent, &of.inputs_of(rates));
    let of_jerk = jerk.clone().unwrap_or_else(|_| bent.clone());
    vec![
        ("jerk", listed(jerk)),
        ("point jerks", listed(pose.point_jerks([rates, bent, &of_jerk]))),
        ("output jerks", listed(pose.output_jerks([rates, bent, &of_jerk]))),
        ("velocity ratio derivatives", all_entries(pose.velocity_ratio_derivatives())),
        ("point ratio derivatives", all_entries(pose.point_ratio_derivatives())),
        ("output ratio derivatives", all_entries(pose.output_ratio_derivatives())),
        ("sensitivity", entries(pose.sensitivity())),
        ("point sensitivities", all_entries(pose.point_sensitivities())),
        ("output sensitivities", all_entries(pose.output_sensitivities())),
    ]
}
