//! The comparison of positions: equal up to rounding errors and whole turns.
//!
//! Angles are compared modulo whole turns. Where whole turns matter, as with gears, the other unknowns differ, and so do
//! the positions.

use crate::jacobian::ScalesOf as Scales;
use crate::jacobian::ulp::nearly_zero;
use crate::scalar::arithmetic::*;
use crate::scalar::larger;
use crate::{Build, Column, D, Mechanism, PerUnknown, Real, real};

/// Compares positions of a mechanism with one input.
pub(crate) struct SamePosition<M: Mechanism> {
    scales: Scales<M>,
    /// True for each unknown that is an angle.
    unknown_angles: Column<bool, M::U>,
    input_is_angle: bool,
}

impl<M: Mechanism<V = D<1>>> SamePosition<M> {
    /// With the lengths of the loops at a position.
    pub(crate) fn at(mechanism: &M, position: &M::Coordinates) -> Self {
        let is_angle = |place: usize| mechanism.unknown_angles().get(place).copied().unwrap_or_default();
        Self {
            scales: Scales::<M>::of(mechanism, &mechanism.pose_at(position)),
            unknown_angles: mechanism.dims().0.column(is_angle),
            input_is_angle: mechanism.input_angles().first().copied().unwrap_or_default(),
        }
    }

    /// True if two positions are the same up to rounding errors and whole turns, and no dead point is between them.
    pub(crate) fn are_equal(&self, mechanism: &M, one: &M::Coordinates, other: &M::Coordinates) -> bool {
        self.are_near(one, other) && {
            let [one, other] = [one, other].map(|q| mechanism.pose_at(q));
            mechanism.same_branch(&one, &other)
        }
    }

    /// True if two singular positions are the same up to rounding errors and whole turns.
    pub(crate) fn are_near(&self, one: &M::Coordinates, other: &M::Coordinates) -> bool {
        self.distance(one, other) <= nearly_zero()
    }

    /// The largest difference of coordinates, modulo whole turns of angles.
    fn distance(&self, one: &M::Coordinates, other: &M::Coordinates) -> M::Scalar {
        let off = M::unknowns(one) - M::unknowns(other);
        let pairs = off.iter().zip(&self.scales.coordinates.unknowns).zip(&self.unknown_angles);
        let of_unknowns = pairs.map(|((&off, &scale), &is_angle)| modulo_turns(off / scale, is_angle).abs());
        of_unknowns.fold(self.input_gap(M::inputs(one)[0], M::inputs(other)[0]).abs(), larger)
    }

    /// The difference of two inputs, divided by its scale, modulo whole turns.
    pub(crate) fn input_gap(&self, one: M::Scalar, other: M::Scalar) -> M::Scalar {
        modulo_turns(self.input_in_units(one - other), self.input_is_angle)
    }

    /// A function of the input that changes its sign at `start`, of an angle at each whole turn from it, and nowhere else
    /// nearby.
    pub(crate) fn side(&self, input: M::Scalar, start: M::Scalar) -> M::Scalar {
        let off = self.input_in_units(input - start);
        if self.input_is_angle { (off * real(0.5)).sine() } else { off }
    }

    /// A difference or a rate of the input, divided by the scale of the input, that of an angle by one.
    pub(crate) fn input_in_units(&self, of_input: M::Scalar) -> M::Scalar {
        of_input / self.scales.coordinates.inputs[0]
    }

    /// The unit of the input: a radian, or the scale of a length.
    pub(crate) fn parameter_unit(&self) -> M::Scalar {
        self.scales.coordinates.inputs[0]
    }

    /// The largest of first and second derivatives of the unknowns by the input, in units of both.
    pub(crate) fn size_of_slopes(&self, slopes: &[PerUnknown<M>; 2]) -> M::Scalar {
        let unit = self.parameter_unit();
        let [first, second] = slopes.map(|slope| slope.component_div(&self.scales.coordinates.unknowns).largest());
        larger(first * unit, second * unit * unit)
    }

    /// The largest difference of coordinates, with whole turns.
    pub(crate) fn way(&self, one: &M::Coordinates, other: &M::Coordinates) -> M::Scalar {
        let [(u, v), (w, x)] = [one, other].map(M::parts);
        let off = (u - w).component_div(&self.scales.coordinates.unknowns).largest();
        larger(off, self.input_in_units((v - x)[0]).abs())
    }
}

/// True if a value with a range is another after whole turns, though the position is the same.
pub(crate) fn has_counted<M: Mechanism<V = D<1>>>(
    mechanism: &M,
    position: &M::Coordinates,
    start: &M::Coordinates,
) -> bool {
    let whole = |angle: M::Scalar| (angle / M::Scalar::two_pi()).round() * M::Scalar::two_pi();
    let ((unknowns, inputs), (from, first)) = (M::parts(position), M::parts(start));
    let turned = (unknowns.iter().zip(&from).zip(mechanism.unknown_angles()))
        .map(|((to, from), is_angle)| if *is_angle { *from + whole(*to - *from) } else { *from });
    let turned = M::coordinates(from.dim().padded(turned), first + (inputs - first).map(whole));
    (0..mechanism.range_names().count()).any(|place| {
        let [Some(one), Some(other)] = [start, &turned].map(|q| mechanism.ranged(place, q)) else { return false };
        let scale = [Some(one.value), Some(other.value), one.least, one.most].into_iter().flatten();
        let scale = scale.fold(M::Scalar::zero(), |sum, part| sum + part.abs());
        !one.is_direction && (one.value - other.value).abs() > scale * nearly_zero()
    })
}

/// An angle from -pi to pi that differs by whole turns; any other coordinate as it is.
pub(crate) fn modulo_turns<T: Real>(off: T, is_angle: bool) -> T {
    if is_angle { off - T::two_pi() * (off / T::two_pi()).round() } else { off }
}
