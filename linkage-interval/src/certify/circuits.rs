//! Certificates of circuits that were found by path following.

use linkage_runtime::circuits::{CircuitMode, Circuits, MotionCurve};
use linkage_runtime::{Certifiable, D};

use super::error::{CertifyError, CertifyErrorOf};
use super::{Certify, Curve};

/// The largest difference of a dead point of a path from the certified one, relative to the size of the input: a path
/// finds it to rounding error, but that grows where the input changes little.
const AGREEMENT: f64 = 1.0 / (1_u64 << 30) as f64;

impl<M: Certifiable<V = D<1>>> Certify<'_, M> {
    /// Certifies each motion of circuits, in their order: that it is one smooth curve, passes the modes that the path
    /// found and no other one, and turns back at the dead points that the path found and nowhere else.
    ///
    /// A motion that crosses another one at a change point has no certificate, nor one that ends at limits.
    pub fn circuits<B: Copy>(
        &self,
        circuits: &Circuits<M::Coordinates, B, f64, M::Name>,
    ) -> Vec<Result<Curve<M>, CertifyErrorOf<M>>> {
        let certify = |(place, motion)| self.motion(circuits, place, motion);
        circuits.motions.iter().enumerate().map(certify).collect()
    }

    fn motion<B: Copy>(
        &self,
        circuits: &Circuits<M::Coordinates, B, f64, M::Name>,
        place: usize,
        motion: &MotionCurve<M::Coordinates, f64, M::Name>,
    ) -> Result<Curve<M>, CertifyErrorOf<M>> {
        let differs = |what| CertifyError::OtherMotion { mechanism: self.mechanism.name(), what };
        let start = motion.points.first().ok_or_else(|| self.invalid("the motion"))?;
        let curve = self.curve(&start.position)?;
        let is_right = |mode: &CircuitMode<M::Coordinates, B>| curve.passes(&mode.position) == (mode.motion == place);
        if !circuits.modes.iter().all(is_right) {
            return Err(differs("modes"));
        }
        let mut limits: Vec<_> = curve.dead_points().iter().map(|dead_point| dead_point.input).collect();
        for found in motion.dead_points() {
            let input = found.point.input;
            let margin = AGREEMENT * input.abs().max(curve.input_scale());
            let near = |limit: &crate::Interval| (limit.middle() - input).abs() <= margin + limit.width();
            let place = limits.iter().position(near).ok_or_else(|| differs("dead points"))?;
            limits.swap_remove(place);
        }
        if limits.is_empty() { Ok(curve) } else { Err(differs("dead points")) }
    }
}
