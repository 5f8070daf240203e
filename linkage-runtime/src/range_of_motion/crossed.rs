//! Rates at a change point.
//!
//! J is singular there, but along one motion the unknowns are smooth functions u(t) of the parameter. From the rates at
//! t - h and t + h the cubic through both with their slopes (Hermite) has
//!
//! ```text
//! u'  = (u'+ + u'-) / 2 - h (u''+ - u''-) / 4
//! u'' = 3 (u'+ - u'-) / (4 h) - (u''+ + u''-) / 4
//! ```
//!
//! The errors are even powers of h from the fourth on, which extrapolation to h = 0 removes one after the other
//! (Richardson).

use super::Driven;
use crate::kinematic::{Motion, MotionOf};
use crate::same_position::SamePosition;
use crate::scalar::arithmetic::*;
use crate::scalar::larger;
use crate::{Dim, Kinematic, OutputMotion, PerUnknown, PointMotion, PositionErrorOf, real};

/// The first and second derivatives of the unknowns by the parameter.
pub(super) type Slopes<M> = [PerUnknown<M>; 2];

/// The first widths, in units of the parameter: a shorter one where another singular position is near.
const WIDTHS: [f64; 3] = [1.0 / 8.0, 1.0 / 64.0, 1.0 / 512.0];

/// The halvings of a width.
const LEVELS: usize = 6;

/// The largest error of a rate, in units of the coordinates and of the parameter, and as a part of larger rates.
const ERROR: f64 = 1e-9;

/// The slopes at a parameter from those at others nearby; none where they do not converge.
pub(super) fn slopes<M: Driven>(
    same: &SamePosition<M>,
    parameter: M::Scalar,
    at: impl Fn(M::Scalar) -> Option<Slopes<M>>,
) -> Option<Slopes<M>> {
    let unit = same.parameter_unit();
    WIDTHS.into_iter().find_map(|width| {
        let (slopes, error) = extrapolated(same, unit * real(width), |h| {
            let [[before, bend_before], [after, bend_after]] = [at(parameter - h)?, at(parameter + h)?];
            let [half, quarter, three_quarters] = [0.5, 0.25, 0.75].map(real::<M::Scalar>);
            let first = (after + before) * half - (bend_after - bend_before) * (h * quarter);
            let second = (after - before) * (three_quarters / h) - (bend_after + bend_before) * quarter;
            Some([first, second])
        })?;
        let size = larger(same.size_of_slopes(&slopes), M::Scalar::one());
        (error <= size * real(ERROR)).then_some(slopes)
    })
}

/// The limit of slopes whose errors are h^4, h^6 and so on, and the difference of the best two estimates.
fn extrapolated<M: Driven>(
    same: &SamePosition<M>,
    width: M::Scalar,
    at: impl Fn(M::Scalar) -> Option<Slopes<M>>,
) -> Option<(Slopes<M>, M::Scalar)> {
    let minus = |one: &Slopes<M>, other: &Slopes<M>| [one[0] - other[0], one[1] - other[1]];
    let mut row = [at(width)?; LEVELS];
    let mut best: Option<(Slopes<M>, M::Scalar)> = None;
    let mut h = width;
    for level in 1..LEVELS {
        h *= real(0.5);
        let (last, mut estimate, mut ratio) = (row, at(h)?, real::<M::Scalar>(16.0));
        row[0] = estimate;
        for column in 1..=level {
            let off = minus(&estimate, &last[column - 1]);
            let factor = M::Scalar::one() / (ratio - M::Scalar::one());
            estimate = [estimate[0] + off[0] * factor, estimate[1] + off[1] * factor];
            row[column] = estimate;
            ratio *= real(4.0);
        }
        let error = same.size_of_slopes(&minus(&estimate, &last[level - 1]));
        if best.is_none_or(|(_, least)| error < least) {
            best = Some((estimate, error));
        }
    }
    best
}

/// The motion of points and outputs at given rates and accelerations.
pub(super) fn motion_at<M: Kinematic>(
    m: &M,
    q: &M::Coordinates,
    rates: M::Rates,
    accelerations: M::Accelerations,
) -> Result<MotionOf<M>, PositionErrorOf<M>> {
    let pose = m.pose_at(q);
    let (points, outputs) = (M::each_point(m.points(&pose)?), M::each_output(m.outputs(&pose)?));
    let velocities = M::each_point(m.point_velocities(&pose, &rates)?);
    let point_accelerations = M::each_point(m.point_accelerations(&pose, &rates, &accelerations)?);
    let output_rates = M::each_output(m.output_rates(&pose, &rates)?);
    let output_accelerations = M::each_output(m.output_accelerations(&pose, &rates, &accelerations)?);
    let point = |place: usize| PointMotion {
        position: points[place],
        velocity: velocities[place],
        acceleration: point_accelerations[place],
    };
    let output = |place: usize| OutputMotion {
        value: outputs[place],
        rate: output_rates[place],
        acceleration: output_accelerations[place],
    };
    let (points, outputs) = (points.dim().array(point).into(), outputs.dim().array(output).into());
    Ok(Motion { position: *q, rates, accelerations, points, outputs })
}
