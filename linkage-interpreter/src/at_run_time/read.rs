//! Between values of the machine and the columns of the runtime.

use linkage_ir::Name;
use linkage_runtime::kinematic::Quantity;
use linkage_runtime::nalgebra::{Point2, Vector2};
use linkage_runtime::{Bounded, Build as _, Column, Dim, Matrix, OutputMotion, PointMotion, Ranged};
use smallvec::SmallVec;

use super::coordinates::column;
use super::parameters::Parameters;
use super::{AtRunTime, BranchAtRunTime, CoordinatesAtRunTime, Count, MOST, MOST_OF_POSE, PoseAtRunTime, Prepared};
use crate::machine::{Defect, Value};

/// A quantity for each point or output.
pub(crate) type List<Q> = Bounded<Q, MOST>;

/// All numbers of a value, in order.
pub(crate) fn numbers(value: &Value) -> SmallVec<[f64; 16]> {
    let mut numbers = SmallVec::new();
    value.each_leaf(&mut |leaf| numbers.push(number(leaf)));
    numbers
}

/// The number that a value is, NaN if it is none.
pub(crate) fn number(value: &Value) -> f64 {
    if let Value::Number(number) = value { *number } else { f64::NAN }
}

/// A field, or nothing.
pub(crate) fn field(value: &Value, name: Name) -> &Value {
    value.field(name).unwrap_or(&Value::Absent)
}

/// All numbers of a pose.
fn pose_numbers(value: &Value) -> Bounded<f64, MOST_OF_POSE> {
    let all = numbers(value);
    let count = linkage_runtime::UpTo::<MOST_OF_POSE>::new(all.len());
    count.unwrap_or_else(Dim::least).array(|place| all[place])
}

/// A quantity of points or outputs.
pub(crate) trait Read: Quantity {
    fn read(value: &Value) -> Self;
}

impl Read for f64 {
    fn read(value: &Value) -> Self {
        number(value)
    }
}

impl Read for Vector2<f64> {
    fn read(value: &Value) -> Self {
        let numbers = numbers(value);
        Self::from_fn(|place, _| numbers.get(place).copied().unwrap_or(f64::NAN))
    }
}

impl Read for Point2<f64> {
    fn read(value: &Value) -> Self {
        Vector2::read(value).into()
    }
}

impl Read for PointMotion<f64> {
    fn read(value: &Value) -> Self {
        Self {
            position: Read::read(field(value, Name::POSITION)),
            velocity: Read::read(field(value, Name::VELOCITY)),
            acceleration: Read::read(field(value, Name::ACCELERATION)),
        }
    }
}

impl Read for OutputMotion<f64> {
    fn read(value: &Value) -> Self {
        Self {
            value: number(field(value, Name::VALUE)),
            rate: number(field(value, Name::RATE)),
            acceleration: number(field(value, Name::ACCELERATION)),
        }
    }
}

/// A matrix of so many rows and columns; a value has the columns one after the other.
pub(crate) fn matrix<R: Dim, C: Dim>(value: &Value, rows: R, columns: C) -> Matrix<f64, R, C> {
    let numbers = numbers(value);
    rows.matrix(columns, |row, column| numbers.get(column * rows.count() + row).copied().unwrap_or(f64::NAN))
}

/// A value with a range.
pub(crate) fn ranged(value: &Value) -> Option<Ranged<f64>> {
    let record = value.as_record().ok()?;
    let of = |name| record.get(name).unwrap_or(&Value::Absent);
    let end = |name| if let Value::Number(end) = of(name) { Some(*end) } else { None };
    let is_direction = matches!(of(Name::IS_DIRECTION), Value::Flag(true));
    Some(Ranged { value: number(of(Name::VALUE)), least: end(Name::LEAST), most: end(Name::MOST), is_direction })
}

impl Prepared<'_> {
    /// A number for each unknown or equation.
    pub(crate) fn column(&self, value: &Value, count: Count) -> Column<f64, Count> {
        let numbers = numbers(value);
        count.column(|place| numbers.get(place).copied().unwrap_or(f64::NAN))
    }

    /// A quantity for each point or output, by name.
    pub(crate) fn each<Q: Quantity>(&self, value: &Value, names: &[Name], read: impl Fn(&Value) -> Q) -> List<Q> {
        let count = Count::new(names.len()).unwrap_or_else(Count::least);
        count.array(|place| read(field(value, names[place])))
    }
}

impl<'p, V: Dim, P: Parameters> AtRunTime<'p, V, P> {
    /// The coordinates, rates or accelerations that a value has by name.
    pub(crate) fn read_coordinates(&self, value: &Value) -> CoordinatesAtRunTime<V> {
        let driver = self.prepared.driver;
        let by_name = |names: &[Name]| -> SmallVec<[f64; MOST]> {
            names.iter().map(|name| number(field(value, *name))).collect()
        };
        CoordinatesAtRunTime { unknowns: column(&by_name(&driver.unknowns)), inputs: column(&by_name(&driver.inputs)) }
    }

    /// The inputs that a value has by name, or their rates.
    pub(crate) fn read_inputs(&self, value: &Value) -> Column<f64, V> {
        let names = self.prepared.driver.inputs.iter();
        let numbers: SmallVec<[f64; MOST]> = names.map(|name| number(field(value, *name))).collect();
        column(&numbers)
    }

    /// The value of coordinates, rates or accelerations.
    pub(crate) fn coordinates_value(&self, q: &CoordinatesAtRunTime<V>) -> Value {
        let driver = self.prepared.driver;
        let names = driver.unknowns.iter().chain(&driver.inputs).copied();
        Value::record(names.zip(q.all().into_iter().map(Value::Number)))
    }

    /// The value of inputs, or of their rates or accelerations.
    pub(crate) fn inputs_value(&self, inputs: &Column<f64, V>) -> Value {
        let driver = self.prepared.driver;
        Value::record(driver.inputs.iter().copied().zip(inputs.iter().copied().map(Value::Number)))
    }

    /// The value of a pose.
    pub(crate) fn pose_value(&self, pose: &PoseAtRunTime<V>) -> Value {
        self.prepared.pose(&pose.numbers)
    }

    /// The pose that a value is, which a function found.
    pub(crate) fn read_pose(&self, value: Value) -> PoseAtRunTime<V> {
        let numbers = pose_numbers(&value);
        let coordinates = self.prepared.value("coordinates_of", [value]);
        PoseAtRunTime { numbers, coordinates: self.read_coordinates(&coordinates) }
    }

    /// The pose that a value is, which was made of these coordinates.
    pub(crate) fn read_pose_at(&self, value: &Value, coordinates: CoordinatesAtRunTime<V>) -> PoseAtRunTime<V> {
        PoseAtRunTime { numbers: pose_numbers(value), coordinates }
    }

    /// The value of a branch.
    pub(crate) fn branch_value(&self, branch: &BranchAtRunTime<'_>) -> Value {
        branch.value()
    }

    /// The branch that a value is.
    pub(crate) fn read_branch(&self, value: &Value) -> BranchAtRunTime<'p> {
        BranchAtRunTime::read(self.prepared.driver, value).unwrap_or_else(|defect: Defect| {
            self.prepared.keep(crate::CallError::Defect(defect));
            BranchAtRunTime::none(self.prepared.driver)
        })
    }
}
