//! Velocities and accelerations, points and outputs.

use linkage_ir::Name;
use linkage_runtime::kinematic::{
    FullKinematics, FullKinematicsOf, Kinematic, Kinematics, KinematicsOf, Motion, MotionOf, Quantity, Ratios,
};
use linkage_runtime::nalgebra::{Point2, Vector2};
use linkage_runtime::{Build as _, Column, D, Dim, PositionError};

use super::parameters::Parameters;
use super::read::{List, Read, field, matrix};
use super::{AllCoordinates, AtRunTime, BranchAtRunTime, CoordinatesAtRunTime, Count, PoseAtRunTime};
use crate::machine::Value;

/// The result of a call, or the error of the mechanism.
type Found<'p, X> = Result<X, PositionError<&'p str>>;

impl<'p, V: Dim, P: Parameters> AtRunTime<'p, V, P> {
    /// A quantity for each point.
    fn each_point_of<Q: Read>(&self, value: &Value) -> List<Q> {
        self.prepared.each(value, &self.prepared.driver.points, Q::read)
    }

    /// A quantity for each output.
    fn each_output_of<Q: Read>(&self, value: &Value) -> List<Q> {
        self.prepared.each(value, &self.prepared.driver.outputs, Q::read)
    }

    /// A quantity for each point; a mechanism without points has no function for it.
    fn found_points<Q: Read, const N: usize>(&self, function: &str, arguments: [Value; N]) -> Found<'p, List<Q>> {
        match self.prepared.driver.points.is_empty() {
            true => Ok(self.each_point_of(&Value::Absent)),
            false => Ok(self.each_point_of(&self.result(function, arguments)?)),
        }
    }

    /// A quantity for each output, likewise.
    fn found_outputs<Q: Read, const N: usize>(&self, function: &str, arguments: [Value; N]) -> Found<'p, List<Q>> {
        match self.prepared.driver.outputs.is_empty() {
            true => Ok(self.each_output_of(&Value::Absent)),
            false => Ok(self.each_output_of(&self.result(function, arguments)?)),
        }
    }

    /// A matrix for each point or output.
    fn matrices<R: Dim>(
        &self,
        function: &str,
        names: &[Name],
        pose: &PoseAtRunTime<V>,
        rows: R,
    ) -> Found<'p, List<Ratios<Self, R>>> {
        let found = match names.is_empty() {
            true => Value::Absent,
            false => self.result(function, [self.pose_value(pose)])?,
        };
        Ok(self.prepared.each(&found, names, |value| matrix(value, rows, self.inputs)))
    }

    /// The arguments of a position in motion.
    fn moving(
        &self,
        guess: &CoordinatesAtRunTime<V>,
        branch: &BranchAtRunTime<'p>,
        [rates, accelerations]: [&Column<f64, V>; 2],
    ) -> [Value; 4] {
        let moving = [rates, accelerations].map(|column| self.inputs_value(column));
        let [rates, accelerations] = moving;
        [self.coordinates_value(guess), self.branch_value(branch), rates, accelerations]
    }
}

impl<'p, V: Dim, P: Parameters> Kinematic for AtRunTime<'p, V, P> {
    type N = AllCoordinates;
    type P = Count;
    type O = Count;
    type Accelerations = CoordinatesAtRunTime<V>;
    type Points<Q: Quantity> = List<Q>;
    type Outputs<Q: Quantity> = List<Q>;

    const POINTS: &'static [&'static str] = panic!("the names are those of the value");
    const OUTPUTS: &'static [&'static str] = panic!("the names are those of the value");

    fn point_name(&self, place: usize) -> &'p str {
        self.prepared.driver.written.points.get(place).map_or("", String::as_str)
    }
    fn output_name(&self, place: usize) -> &'p str {
        self.prepared.driver.written.outputs.get(place).map_or("", String::as_str)
    }

    // Of a number of inputs that is a value, the list of all coordinates does not tell unknowns from inputs.
    fn accelerations(unknowns: Column<f64, Count>, inputs: Column<f64, V>) -> CoordinatesAtRunTime<V> {
        CoordinatesAtRunTime { unknowns, inputs }
    }
    fn acceleration_parts(accelerations: &CoordinatesAtRunTime<V>) -> (Column<f64, Count>, Column<f64, V>) {
        (accelerations.unknowns, accelerations.inputs)
    }
    fn coordinates_of(pose: &PoseAtRunTime<V>) -> CoordinatesAtRunTime<V> {
        pose.coordinates
    }
    fn velocity(&self, pose: &PoseAtRunTime<V>, rates: Column<f64, V>) -> Found<'p, CoordinatesAtRunTime<V>> {
        let found = self.result("velocity", [self.pose_value(pose), self.inputs_value(&rates)])?;
        Ok(self.read_coordinates(&found))
    }
    fn acceleration(
        &self,
        pose: &PoseAtRunTime<V>,
        rates: &CoordinatesAtRunTime<V>,
        input_accelerations: Column<f64, V>,
    ) -> Found<'p, CoordinatesAtRunTime<V>> {
        let given = [self.pose_value(pose), self.coordinates_value(rates), self.inputs_value(&input_accelerations)];
        Ok(self.read_coordinates(&self.result("acceleration", given)?))
    }
    fn kinematics(
        &self,
        guess: &CoordinatesAtRunTime<V>,
        branch: BranchAtRunTime<'p>,
        rates: Column<f64, V>,
        accelerations: Column<f64, V>,
    ) -> Found<'p, KinematicsOf<Self>> {
        let found = self.result("kinematics", self.moving(guess, &branch, [&rates, &accelerations]))?;
        let of = self.prepared.fields;
        Ok(Kinematics {
            pose: self.read_pose(field(&found, Name::POSE).clone()),
            rates: self.read_coordinates(field(&found, of.rates)),
            accelerations: self.read_coordinates(field(&found, of.accelerations)),
        })
    }
    fn full_kinematics(
        &self,
        guess: &CoordinatesAtRunTime<V>,
        branch: BranchAtRunTime<'p>,
        rates: Column<f64, V>,
        accelerations: Column<f64, V>,
    ) -> Found<'p, FullKinematicsOf<Self>> {
        // A mechanism without points and outputs has `kinematics` only.
        let function = if self.prepared.has("full_kinematics") { "full_kinematics" } else { "kinematics" };
        let found = self.result(function, self.moving(guess, &branch, [&rates, &accelerations]))?;
        let of = self.prepared.fields;
        Ok(FullKinematics {
            pose: self.read_pose(field(&found, Name::POSE).clone()),
            rates: self.read_coordinates(field(&found, of.rates)),
            accelerations: self.read_coordinates(field(&found, of.accelerations)),
            points: self.each_point_of(field(&found, of.points)),
            outputs: self.each_output_of(field(&found, of.outputs)),
        })
    }
    fn motion(
        &self,
        q: &CoordinatesAtRunTime<V>,
        rates: Column<f64, V>,
        accelerations: Column<f64, V>,
    ) -> Found<'p, MotionOf<Self>> {
        let given = [self.coordinates_value(q), self.inputs_value(&rates), self.inputs_value(&accelerations)];
        let found = self.result("motion", given)?;
        let of = self.prepared.fields;
        Ok(Motion {
            position: self.read_coordinates(field(&found, Name::POSITION)),
            rates: self.read_coordinates(field(&found, of.rates)),
            accelerations: self.read_coordinates(field(&found, of.accelerations)),
            points: self.each_point_of(field(&found, of.points)),
            outputs: self.each_output_of(field(&found, of.outputs)),
        })
    }

    fn velocity_ratios(&self, pose: &PoseAtRunTime<V>) -> Found<'p, Ratios<Self, Count>> {
        let (rows, _) = self.prepared.counts();
        if rows.count() == 0 {
            return Ok(rows.zero_matrix(self.inputs));
        }
        Ok(matrix(&self.result("velocity_ratios", [self.pose_value(pose)])?, rows, self.inputs))
    }
    fn points(&self, pose: &PoseAtRunTime<V>) -> Found<'p, List<Point2<f64>>> {
        self.found_points("points", [self.pose_value(pose)])
    }
    fn point_velocities(
        &self,
        pose: &PoseAtRunTime<V>,
        rates: &CoordinatesAtRunTime<V>,
    ) -> Found<'p, List<Vector2<f64>>> {
        self.found_points("point_velocities", [self.pose_value(pose), self.coordinates_value(rates)])
    }
    fn point_accelerations(
        &self,
        pose: &PoseAtRunTime<V>,
        rates: &CoordinatesAtRunTime<V>,
        accelerations: &CoordinatesAtRunTime<V>,
    ) -> Found<'p, List<Vector2<f64>>> {
        let moving = [rates, accelerations].map(|moving| self.coordinates_value(moving));
        let [rates, accelerations] = moving;
        self.found_points("point_accelerations", [self.pose_value(pose), rates, accelerations])
    }
    fn point_ratios(&self, pose: &PoseAtRunTime<V>) -> Found<'p, List<Ratios<Self, D<2>>>> {
        self.matrices("point_ratios", &self.prepared.driver.points, pose, D)
    }
    fn outputs(&self, pose: &PoseAtRunTime<V>) -> Found<'p, List<f64>> {
        self.found_outputs("outputs", [self.pose_value(pose)])
    }
    fn output_rates(&self, pose: &PoseAtRunTime<V>, rates: &CoordinatesAtRunTime<V>) -> Found<'p, List<f64>> {
        self.found_outputs("output_rates", [self.pose_value(pose), self.coordinates_value(rates)])
    }
    fn output_accelerations(
        &self,
        pose: &PoseAtRunTime<V>,
        rates: &CoordinatesAtRunTime<V>,
        accelerations: &CoordinatesAtRunTime<V>,
    ) -> Found<'p, List<f64>> {
        let moving = [rates, accelerations].map(|moving| self.coordinates_value(moving));
        let [rates, accelerations] = moving;
        self.found_outputs("output_accelerations", [self.pose_value(pose), rates, accelerations])
    }
    fn output_ratios(&self, pose: &PoseAtRunTime<V>) -> Found<'p, List<Ratios<Self, D<1>>>> {
        self.matrices("output_ratios", &self.prepared.driver.outputs, pose, D)
    }
}
