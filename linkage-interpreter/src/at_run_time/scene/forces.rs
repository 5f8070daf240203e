//! The forces in the joints that a scene shows.

use std::marker::PhantomData;

use linkage_runtime::{Bounded, Column, Dim, Joint, JointForces, UpTo};

use super::MOST_JOINTS;
use crate::at_run_time::read::numbers;
use crate::at_run_time::{AtRunTime, Count};
use crate::machine::Value;
use crate::program::Scene;

/// The forces in the joints of a scene at run time, whose mechanism has `V` inputs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct JointForcesAtRunTime<'p, V> {
    joints: &'p [Joint<&'p str>],
    /// The two numbers of each force.
    each: Bounded<[f64; 2], MOST_JOINTS>,
    /// The Lagrange multipliers, where the scene asks for them.
    pub multipliers: Column<f64, Count>,
    of: PhantomData<V>,
}

impl<'p, V> JointForcesAtRunTime<'p, V> {
    /// The forces that a value has: those in joints, then the multipliers. Without joints the value has none.
    pub(crate) fn read(joints: &'p [Joint<&'p str>], value: &Value) -> Self {
        let all = numbers(value);
        let (each, multipliers) = all.split_at_checked(2 * joints.len()).unwrap_or_default();
        let count = UpTo::new(joints.len()).unwrap_or_else(UpTo::least);
        let number = |place: usize| each.get(place).copied().unwrap_or(f64::NAN);
        let each = count.array(|place| [number(2 * place), number(2 * place + 1)]);
        Self { joints, each, multipliers: crate::at_run_time::coordinates::column(multipliers), of: PhantomData }
    }

    /// The value of these forces by name.
    pub(crate) fn value(&self, scene: &Scene) -> Value {
        let mut all = self.each.into_iter().flatten().chain(self.multipliers).map(Value::Number);
        let mut next = || all.next().unwrap_or_default();
        let fields = scene.forces.iter().map(|(field, length)| match length {
            None => (*field, next()),
            Some(length) => (*field, Value::list((0..*length).map(|_| next()))),
        });
        Value::record(fields.collect::<Vec<_>>())
    }
}

impl<'p, V: Dim> JointForces<f64, &'p str> for JointForcesAtRunTime<'p, V> {
    type Mechanism = AtRunTime<'p, V>;

    const JOINTS: &'static [Joint] = panic!("the joints are those of the value");

    fn joints(&self) -> impl Iterator<Item = Joint<&'p str>> {
        self.joints.iter().copied()
    }
    fn each(&self) -> impl Iterator<Item = [f64; 2]> {
        self.each.into_iter()
    }
}
