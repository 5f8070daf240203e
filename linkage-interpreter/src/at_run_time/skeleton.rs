//! The joints and parts of the drawing of a text with `derive drawing;`.

use linkage_runtime::skeleton::{NoDrawing, Part, Skeleton};
use linkage_runtime::{Build as _, Column, Dim};

use super::parameters::Parameters;
use super::read::numbers;
use super::{AtRunTime, JointCoordinates, PoseAtRunTime};
use crate::machine::Value;

/// The names of the joints; none without a drawing.
fn joints<'p, V, P>(of: &AtRunTime<'p, V, P>) -> &'p [String] {
    let drawing = of.prepared.driver.written.drawing.as_ref().filter(|_| of.prepared.drawing.is_ok());
    drawing.map_or(&[], |drawing| &drawing.joints)
}

impl<V: Dim, P: Parameters> AtRunTime<'_, V, P> {
    /// The numbers of an entry of a list at a pose; none if the list, which a mechanism has no function for if it is empty, is
    /// shorter.
    fn entry<const N: usize>(&self, function: &str, pose: &PoseAtRunTime<V>, place: usize) -> Option<[f64; N]> {
        if !self.prepared.has(function) {
            return None;
        }
        let found = self.value(function, [self.pose_value(pose), Value::Count(i64::try_from(place).ok()?)]);
        numbers(&found).as_slice().try_into().ok()
    }
}

/// A mechanism that is compiled without `derive drawing;` has no joints, and [`check_drawing`](Skeleton::check_drawing) says so.
impl<'p, V: Dim, P: Parameters> Skeleton for AtRunTime<'p, V, P> {
    type Parts = JointCoordinates;

    const JOINTS: &'static [&'static str] = panic!("the joints are those of the value");
    const PARTS: &'static [Part<'static>] = panic!("the parts are those of the value");

    fn check_drawing(&self) -> Result<(), NoDrawing> {
        self.prepared.drawing.as_ref().map(|_| ()).map_err(|why| *why)
    }
    fn joint_name(&self, place: usize) -> Option<&'p str> {
        joints(self).get(place).map(String::as_str)
    }
    fn drawn_parts(&self) -> &[Part<'_>] {
        self.prepared.drawing.as_deref().unwrap_or_default()
    }
    fn joints(&self, pose: &PoseAtRunTime<V>) -> Column<f64, JointCoordinates> {
        let count = JointCoordinates::new(2 * joints(self).len()).unwrap_or_else(Dim::least);
        if count.count() == 0 {
            return count.zeros();
        }
        let found = numbers(&self.value("joints", [self.pose_value(pose)]));
        count.column(|place| found.get(place).copied().unwrap_or(f64::NAN))
    }
    fn guide(&self, pose: &PoseAtRunTime<V>, place: usize) -> Option<[f64; 2]> {
        self.entry("guide", pose, place)
    }
    fn force_place(&self, pose: &PoseAtRunTime<V>, place: usize) -> Option<[f64; 4]> {
        self.entry("force_place", pose, place)
    }
}
