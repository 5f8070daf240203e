//! The joints of a linkage: positions, merged where a loop makes two formulas one joint.

use crate::graph::NodeId;

/// Positions by index; merged ones are the same joint.
#[derive(Debug, Clone, Default)]
pub struct Joints {
    positions: Vec<[NodeId; 2]>,
    /// For each position, itself, or an earlier one of its joint.
    same: Vec<usize>,
}

impl Joints {
    /// The joint at a position that is known.
    #[must_use]
    pub fn known(&self, position: [NodeId; 2]) -> Option<usize> {
        self.positions.iter().position(|other| *other == position).map(|at| self.find(at))
    }

    /// The index of a position, which is added if it is not known.
    pub fn add(&mut self, position: [NodeId; 2]) -> usize {
        if let Some(known) = self.positions.iter().position(|other| *other == position) {
            return known;
        }
        self.positions.push(position);
        self.same.push(self.positions.len() - 1);
        self.positions.len() - 1
    }

    /// The first index of a joint.
    #[must_use]
    pub fn find(&self, mut at: usize) -> usize {
        while self.same[at] != at {
            at = self.same[at];
        }
        at
    }

    /// Makes two positions one joint.
    pub fn merge(&mut self, one: usize, other: usize) {
        let [one, other] = [one, other].map(|at| self.find(at));
        self.same[one.max(other)] = one.min(other);
    }

    /// All formulas of a joint.
    pub fn formulas(&self, joint: usize) -> impl Iterator<Item = [NodeId; 2]> {
        let all = self.positions.iter().enumerate();
        all.filter(move |(at, _)| self.find(*at) == joint).map(|(_, position)| *position)
    }

    #[must_use]
    pub fn len(&self) -> usize {
        self.positions.len()
    }

    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.positions.is_empty()
    }

    #[must_use]
    pub fn position(&self, at: usize) -> [NodeId; 2] {
        self.positions[at]
    }
}
