//! The modes at the start inputs.

use std::vec::Vec;

use crate::jacobian::ulp::nearly_zero;
use crate::same_position::SamePosition;
use crate::scalar::arithmetic::*;
use crate::{Branches, D, Mechanism, Name, PerInput, PositionError, PositionErrorOf};

/// The modes at the start inputs.
pub(super) struct Modes<'a, M: Branches> {
    mechanism: &'a M,
    /// The start inputs; of those that differ by whole turns the first only.
    pub(super) inputs: Vec<M::Scalar>,
    pub(super) branches: Vec<M::Branch>,
    pub(super) positions: Vec<M::Coordinates>,
    /// None without a position.
    same: Option<SamePosition<M>>,
}

impl<'a, M: Branches<V = D<1>>> Modes<'a, M> {
    pub(super) fn list(
        mechanism: &'a M,
        inputs: impl IntoIterator<Item = M::Scalar>,
    ) -> Result<Self, PositionErrorOf<M>> {
        let mut modes = Self::none(mechanism);
        for input in inputs {
            if !input.is_finite() {
                return Err(PositionError::NotFinite {
                    mechanism: mechanism.name(),
                    quantity: Name::from_static("the input"),
                });
            }
            for (branch, position) in mechanism.all_positions(PerInput::<M>::from([input]).into())? {
                if !mechanism.is_within_ranges(&position)? {
                    continue;
                }
                modes.same.get_or_insert_with(|| SamePosition::at(mechanism, &position));
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

    fn none(mechanism: &'a M) -> Self {
        Self { mechanism, inputs: Vec::new(), branches: Vec::new(), positions: Vec::new(), same: None }
    }

    /// Positions at one input.
    pub(super) fn of(mechanism: &'a M, positions: &[(M::Branch, M::Coordinates)]) -> Self {
        let mut modes = Self::none(mechanism);
        for (branch, position) in positions {
            modes.same.get_or_insert_with(|| SamePosition::at(mechanism, position));
            modes.branches.push(*branch);
            modes.positions.push(*position);
        }
        modes.inputs.extend(positions.first().map(|(_, position)| <M as Mechanism>::inputs(position)[0]));
        modes
    }

    /// The mode at this position.
    pub(super) fn find(&self, position: &M::Coordinates) -> Option<usize> {
        let same = self.same.as_ref()?;
        self.positions.iter().position(|mode| same.are_equal(self.mechanism, mode, position))
    }

    /// True if two singular positions are the same up to rounding errors and whole turns.
    pub(super) fn are_near(&self, one: &M::Coordinates, other: &M::Coordinates) -> bool {
        self.same.as_ref().is_none_or(|same| same.are_near(one, other))
    }

    /// The difference of two inputs, divided by its scale, modulo whole turns.
    pub(super) fn input_gap(&self, one: M::Scalar, other: M::Scalar) -> M::Scalar {
        match &self.same {
            Some(same) => same.input_gap(one, other),
            None => crate::same_position::modulo_turns(one - other, self.mechanism.input_angles()[0]),
        }
    }

    /// The largest difference of coordinates, with whole turns.
    pub(super) fn way(&self, one: &M::Coordinates, other: &M::Coordinates) -> M::Scalar {
        self.same.as_ref().map_or_else(M::Scalar::zero, |same| same.way(one, other))
    }
}

/// A function that changes its sign at the start inputs, and nowhere else nearby.
pub(super) fn crossing_function<M: Branches<V = D<1>>>(modes: &Modes<'_, M>, q: &M::Coordinates) -> M::Scalar {
    let input = <M as Mechanism>::inputs(q)[0];
    let factor = |start: &M::Scalar| modes.same.as_ref().map_or_else(M::Scalar::one, |same| same.side(input, *start));
    modes.inputs.iter().map(factor).fold(M::Scalar::one(), |product, factor| product * factor)
}
