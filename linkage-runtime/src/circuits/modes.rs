//! The modes at the start inputs, and the comparison of positions.
//!
//! Angles are compared modulo whole turns. Where whole turns matter, as with gears, the other unknowns differ, and so do
//! the positions.

use std::vec::Vec;

use crate::jacobian::ScalesOf as Scales;
use crate::jacobian::ulp::nearly_zero;
use crate::scalar::arithmetic::*;
use crate::scalar::larger;
use crate::{Branches, D, Mechanism, PerInput, PositionError, Real};

/// The modes at the start inputs.
pub(super) struct Modes<'a, M: Branches> {
    mechanism: &'a M,
    /// The start inputs; of those that differ by whole turns the first only.
    pub(super) inputs: Vec<M::Scalar>,
    pub(super) branches: Vec<M::Branch>,
    pub(super) positions: Vec<M::Coordinates>,
    /// None without a position.
    scales: Option<Scales<M>>,
}

impl<'a, M: Branches<V = D<1>>> Modes<'a, M> {
    pub(super) fn list(mechanism: &'a M, inputs: impl IntoIterator<Item = M::Scalar>) -> Result<Self, PositionError> {
        let mut modes =
            Self { mechanism, inputs: Vec::new(), branches: Vec::new(), positions: Vec::new(), scales: None };
        for input in inputs {
            if !input.is_finite() {
                return Err(PositionError::NotFinite { mechanism: M::NAME, quantity: "the input" });
            }
            for (branch, position) in mechanism.all_positions(PerInput::<M>::from([input]).into())? {
                modes.scales.get_or_insert_with(|| Scales::<M>::of(mechanism, &mechanism.pose_at(&position)));
                if modes.find(&position).is_none() {
                    modes.branches.push(branch);
                    modes.positions.push(position);
                }
            }
            let gap = |other: &M::Scalar| modes.input_gap(input, *other).abs();
            if !modes.inputs.iter().any(|other| gap(other) <= nearly_zero()) {
                modes.inputs.push(input);
            }
        }
        Ok(modes)
    }

    /// The mode at this position.
    pub(super) fn find(&self, position: &M::Coordinates) -> Option<usize> {
        self.positions.iter().position(|mode| self.are_equal(mode, position))
    }

    /// True if two positions are the same up to rounding errors and whole turns, and no dead point is between them.
    pub(super) fn are_equal(&self, one: &M::Coordinates, other: &M::Coordinates) -> bool {
        self.distance(one, other) <= nearly_zero() && {
            let [one, other] = [one, other].map(|q| self.mechanism.pose_at(q));
            self.mechanism.same_branch(&one, &other)
        }
    }

    /// True if two singular positions are the same up to rounding errors and whole turns.
    pub(super) fn are_near(&self, one: &M::Coordinates, other: &M::Coordinates) -> bool {
        self.distance(one, other) <= nearly_zero()
    }

    /// The largest difference of coordinates, modulo whole turns of angles.
    fn distance(&self, one: &M::Coordinates, other: &M::Coordinates) -> M::Scalar {
        let Some(scales) = &self.scales else { return M::Scalar::zero() };
        let off = M::unknowns(one) - M::unknowns(other);
        let pairs = off.iter().zip(&scales.coordinates.unknowns).zip(M::UNKNOWN_ANGLES);
        let of_unknowns = pairs.map(|((&off, &scale), &is_angle)| modulo_turns(off / scale, is_angle).abs());
        of_unknowns.fold(self.input_gap(M::inputs(one)[0], M::inputs(other)[0]).abs(), larger)
    }

    /// The difference of two inputs, divided by its scale, modulo whole turns.
    pub(super) fn input_gap(&self, one: M::Scalar, other: M::Scalar) -> M::Scalar {
        modulo_turns((one - other) / self.input_scale(), M::INPUT_ANGLES[0])
    }

    fn input_scale(&self) -> M::Scalar {
        self.scales.as_ref().map_or_else(M::Scalar::one, |scales| scales.coordinates.inputs[0])
    }

    /// The largest difference of coordinates, with whole turns.
    pub(super) fn way(&self, one: &M::Coordinates, other: &M::Coordinates) -> M::Scalar {
        let Some(scales) = &self.scales else { return M::Scalar::zero() };
        let [(u, v), (w, x)] = [one, other].map(M::parts);
        let off = (u - w).component_div(&scales.coordinates.unknowns).largest();
        larger(off, ((v - x)[0] / self.input_scale()).abs())
    }
}

/// An angle from -pi to pi that differs by whole turns; any other coordinate as it is.
fn modulo_turns<T: Real>(off: T, is_angle: bool) -> T {
    if is_angle { off - T::two_pi() * (off / T::two_pi()).round() } else { off }
}

/// A function that changes its sign at the start inputs, and nowhere else nearby.
pub(super) fn crossing_function<M: Branches<V = D<1>>>(modes: &Modes<'_, M>, q: &M::Coordinates) -> M::Scalar {
    let input = <M as Mechanism>::inputs(q)[0];
    let factor = |start: &M::Scalar| {
        let off = (input - *start) / modes.input_scale();
        // sin changes its sign at each whole turn of the difference.
        if M::INPUT_ANGLES[0] { (off * crate::real(0.5)).sine() } else { off }
    };
    modes.inputs.iter().map(factor).fold(M::Scalar::one(), |product, factor| product * factor)
}
