//! The trait of every mechanism.

use linkage_runtime::{Build as _, Column, Dim, Group, Matrix, Mechanism, PositionError, Ranged};

use super::parameters::Parameters;
use super::read::{matrix, number, ranged};
use super::{AtRunTime, BranchAtRunTime, CoordinatesAtRunTime, Count, PoseAtRunTime};
use crate::machine::Value;

impl<V: Dim, P: Parameters> AtRunTime<'_, V, P> {
    /// A column that a function of a pose returns: of a mechanism without equations it has no entries.
    fn column_at(&self, function: &str, pose: &PoseAtRunTime<V>, count: Count) -> Column<f64, Count> {
        if count.count() == 0 {
            return count.zeros();
        }
        self.prepared.column(&self.value(function, [self.pose_value(pose)]), count)
    }

    /// A matrix that a function of a pose returns, likewise.
    fn matrix_at<C: Dim>(&self, function: &str, pose: &PoseAtRunTime<V>, columns: C) -> Matrix<f64, Count, C> {
        let (rows, _) = self.prepared.counts();
        if rows.count() == 0 {
            return rows.zero_matrix(columns);
        }
        matrix(&self.value(function, [self.pose_value(pose)]), rows, columns)
    }
}

impl<'p, V: Dim, P: Parameters> Mechanism for AtRunTime<'p, V, P> {
    type Scalar = f64;
    type Name = &'p str;
    type U = Count;
    type V = V;
    type G = Count;
    type Coordinates = CoordinatesAtRunTime<V>;
    type Rates = CoordinatesAtRunTime<V>;
    type Inputs = Column<f64, V>;
    type Pose = PoseAtRunTime<V>;
    type Branch = BranchAtRunTime<'p>;

    // An algorithm that reads a constant instead of the value does not compile.
    const NAME: &'static str = panic!("the name is one of the value");
    const UNKNOWNS: &'static [&'static str] = panic!("the names are those of the value");
    const INPUTS: &'static [&'static str] = panic!("the names are those of the value");
    const UNKNOWN_ANGLES: &'static [bool] = panic!("the angles are those of the value");
    const INPUT_ANGLES: &'static [bool] = panic!("the angles are those of the value");
    const GROUPS: &'static [Group<'static>] = panic!("the groups are those of the value");
    const RANGES: &'static [&'static str] = panic!("the ranges are those of the value");

    fn name(&self) -> &'p str {
        &self.prepared.driver.name
    }
    fn unknown_name(&self, place: usize) -> &'p str {
        self.prepared.driver.written.unknowns.get(place).map_or("", String::as_str)
    }
    fn input_name(&self, place: usize) -> &'p str {
        self.prepared.inputs.get(place).copied().unwrap_or_default()
    }
    fn unknown_angles(&self) -> &[bool] {
        &self.prepared.driver.written.unknown_angles
    }
    fn input_angles(&self) -> &[bool] {
        &self.prepared.driver.input_angles
    }
    fn group(&self, place: usize) -> Option<Group<'_, &'p str>> {
        self.prepared.groups.get(place).copied()
    }
    fn group_list(&self) -> &'p [Group<'p, &'p str>] {
        &self.prepared.groups
    }
    fn range_name(&self, place: usize) -> Option<&'p str> {
        self.prepared.driver.written.ranges.get(place).map(String::as_str)
    }
    fn dims(&self) -> (Count, V, Count) {
        let (unknowns, groups) = self.prepared.counts();
        (unknowns, self.inputs, groups)
    }

    fn coordinates(unknowns: Column<f64, Count>, inputs: Column<f64, V>) -> CoordinatesAtRunTime<V> {
        CoordinatesAtRunTime { unknowns, inputs }
    }
    fn parts(q: &CoordinatesAtRunTime<V>) -> (Column<f64, Count>, Column<f64, V>) {
        (q.unknowns, q.inputs)
    }
    fn rates(unknowns: Column<f64, Count>, inputs: Column<f64, V>) -> CoordinatesAtRunTime<V> {
        CoordinatesAtRunTime { unknowns, inputs }
    }
    fn rate_parts(rates: &CoordinatesAtRunTime<V>) -> (Column<f64, Count>, Column<f64, V>) {
        (rates.unknowns, rates.inputs)
    }
    fn pose_at(&self, q: &CoordinatesAtRunTime<V>) -> PoseAtRunTime<V> {
        self.read_pose_at(&self.value("pose_at", [self.coordinates_value(q)]), *q)
    }
    fn is_finite(pose: &PoseAtRunTime<V>) -> bool {
        pose.numbers.as_ref().iter().all(|number| number.is_finite())
    }
    fn branch_of(&self, pose: &PoseAtRunTime<V>) -> BranchAtRunTime<'p> {
        self.read_branch(&self.value("branch_of", [self.pose_value(pose)]))
    }

    fn residual(&self, pose: &PoseAtRunTime<V>) -> Column<f64, Count> {
        self.column_at("residual", pose, self.prepared.counts().0)
    }
    fn residual_scales(&self, pose: &PoseAtRunTime<V>) -> Column<f64, Count> {
        self.column_at("residual_scales", pose, self.prepared.counts().0)
    }
    fn jacobian_unknowns(&self, pose: &PoseAtRunTime<V>) -> Matrix<f64, Count, Count> {
        self.matrix_at("jacobian_unknowns", pose, self.prepared.counts().0)
    }
    fn jacobian_inputs(&self, pose: &PoseAtRunTime<V>) -> Matrix<f64, Count, V> {
        self.matrix_at("jacobian_inputs", pose, self.inputs)
    }
    fn jacobian_unknowns_scales(&self, pose: &PoseAtRunTime<V>) -> Matrix<f64, Count, Count> {
        self.matrix_at("jacobian_unknowns_scales", pose, self.prepared.counts().0)
    }
    fn jacobian_inputs_scales(&self, pose: &PoseAtRunTime<V>) -> Matrix<f64, Count, V> {
        self.matrix_at("jacobian_inputs_scales", pose, self.inputs)
    }
    fn determinant(&self, pose: &PoseAtRunTime<V>) -> f64 {
        match self.prepared.counts().0.count() {
            0 => 1.0,
            _ => number(&self.value("determinant", [self.pose_value(pose)])),
        }
    }
    fn block_determinants(&self, pose: &PoseAtRunTime<V>) -> Column<f64, Count> {
        self.column_at("block_determinants", pose, self.prepared.counts().1)
    }
    fn gamma(&self, pose: &PoseAtRunTime<V>, rates: &CoordinatesAtRunTime<V>) -> Column<f64, Count> {
        let (count, _) = self.prepared.counts();
        if count.count() == 0 {
            return count.zeros();
        }
        let found = self.value("gamma", [self.pose_value(pose), self.coordinates_value(rates)]);
        self.prepared.column(&found, count)
    }
    fn solve_jacobian(
        &self,
        pose: &PoseAtRunTime<V>,
        right: &Column<f64, Count>,
    ) -> Result<Column<f64, Count>, PositionError<&'p str>> {
        if right.dim().count() == 0 {
            return Ok(*right);
        }
        let right_side = Value::list(right.iter().copied().map(Value::Number));
        let found = self.result("solve_jacobian", [self.pose_value(pose), right_side])?;
        Ok(self.prepared.column(&found, right.dim()))
    }

    fn length_scale(&self, pose: &PoseAtRunTime<V>) -> f64 {
        match self.prepared.has("length_scale") {
            true => number(&self.value("length_scale", [self.pose_value(pose)])),
            false => 1.0,
        }
    }
    fn check_implied(&self, q: &CoordinatesAtRunTime<V>) -> Result<(), PositionError<&'p str>> {
        match self.prepared.has("check_implied") {
            true => self.result("check_implied", [self.coordinates_value(q)]).map(|_| ()),
            false => Ok(()),
        }
    }
    fn ranged(&self, place: usize, q: &CoordinatesAtRunTime<V>) -> Option<Ranged<f64>> {
        self.range_name(place)?;
        ranged(&self.value("ranged", [Value::Count(place as i64), self.coordinates_value(q)]))
    }
}
