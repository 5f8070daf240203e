//! The joints of a dyad of two links, by the names of the points that the user declared there.

use std::collections::BTreeSet;

use crate::graph::{Graph, NodeId, Number, SymbolId};
use crate::model::{Chain, Link, Mechanism};

/// A joint of a dyad.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Joint {
    /// A declared point.
    Point(String),
    /// A position that depends on parameters only.
    Fixed([NodeId; 2]),
    /// A joint that moves and has no name.
    Unnamed,
}

/// The joints of a dyad RRR: the middle one, and the outer ones of the link of each unknown.
#[derive(Debug, Clone)]
pub struct Joints {
    pub middle: Joint,
    pub outer: [Joint; 2],
}

impl Joints {
    /// Their names from one end to the other, if the user has declared points at all of them.
    #[must_use]
    pub fn names(&self) -> Option<[&str; 3]> {
        let [first, last] = &self.outer;
        match [first, &self.middle, last] {
            [Joint::Point(a), Joint::Point(b), Joint::Point(c)] => Some([a, b, c]),
            _ => None,
        }
    }

    /// Finds the joints of the dyad of these two angles in the loop that has them.
    pub fn of(mechanism: &Mechanism, graph: &mut Graph, unknowns: [SymbolId; 2]) -> Option<Self> {
        mechanism.loops.iter().find_map(|sides| {
            let ring = Ring::of(graph, sides)?;
            let [first, second] = runs(graph, &ring.links, unknowns)?;
            // The links of one angle end where those of the other begin.
            let ((middle, one), other) = if first.end == second.start {
                ((first.end, first.start), second.end)
            } else if second.end == first.start {
                ((first.start, first.end), second.start)
            } else {
                return None;
            };
            let joint = |index: usize| ring.joint(mechanism, graph, index);
            Some(Self { middle: joint(middle), outer: [joint(one), joint(other)] })
        })
    }
}

/// The vectors of a loop in a row, and the positions between them. Where the two sides of its equation meet, there are
/// two formulas for the position.
struct Ring {
    links: Vec<Link>,
    joints: Vec<Vec<[NodeId; 2]>>,
}

/// A row of neighbouring links, by the joints at its ends, counted around the ring.
struct Run {
    start: usize,
    end: usize,
}

impl Ring {
    /// None if the loop is not closed: its sides start from different points.
    fn of(graph: &mut Graph, [left, right]: &[Chain; 2]) -> Option<Self> {
        let zero = graph.zero();
        let start = |chain: &Chain| chain.start.unwrap_or([zero; 2]);
        if left.links.is_empty() || start(left) != start(right) {
            return None;
        }
        let mut along = |chain: &Chain| {
            let mut joints = vec![start(chain)];
            for link in &chain.links {
                let sign = if link.is_reversed { Number::MINUS_ONE } else { Number::ONE };
                let [x, y] = joints[joints.len() - 1];
                let [u, v] = link.vector;
                joints.push([graph.sum(&[(Number::ONE, x), (sign, u)]), graph.sum(&[(Number::ONE, y), (sign, v)])]);
            }
            joints
        };
        let (left_joints, mut right_joints) = (along(left), along(right));
        let mut joints: Vec<Vec<[NodeId; 2]>> = left_joints.into_iter().map(|joint| vec![joint]).collect();
        if let (Some(meeting), Some(last)) = (joints.last_mut(), right_joints.pop()) {
            meeting.push(last);
        }
        joints.extend(right_joints.into_iter().rev().map(|joint| vec![joint]));
        if !right.links.is_empty() {
            joints.pop();
        }
        Some(Self { links: left.links.iter().chain(right.links.iter().rev()).copied().collect(), joints })
    }

    fn joint(&self, mechanism: &Mechanism, graph: &Graph, index: usize) -> Joint {
        let here = &self.joints[index % self.links.len()];
        let mut points = mechanism.points.iter();
        if let Some(point) = points.find(|point| here.contains(&[point.x, point.y])) {
            return Joint::Point(point.name.text.clone());
        }
        let coordinates: BTreeSet<SymbolId> = mechanism.coordinates.iter().map(|c| c.symbol).collect();
        let is_fixed = |joint: &&[NodeId; 2]| graph.symbols_of(&joint[..]).iter().all(|s| !coordinates.contains(s));
        here.iter().find(is_fixed).map_or(Joint::Unnamed, |joint| Joint::Fixed(*joint))
    }
}

/// The links of each of two angles, each a row of neighbours. A link that turns with both angles belongs to the one that
/// no link turns with alone.
fn runs(graph: &Graph, links: &[Link], unknowns: [SymbolId; 2]) -> Option<[Run; 2]> {
    let turns_with: Vec<[bool; 2]> = (links.iter())
        .map(|link| {
            let symbols = graph.symbols_of(&link.angle.into_iter().collect::<Vec<_>>());
            unknowns.map(|unknown| symbols.contains(&unknown))
        })
        .collect();
    let is_alone = [[true, false], [false, true]].map(|alone| turns_with.contains(&alone));
    let belongs = |index: usize, which: usize| match turns_with[index] {
        [true, true] => !is_alone[which],
        turns => turns[which],
    };
    let count = links.len();
    let run = |which: usize| {
        let is_in = |index: usize| belongs(index % count, which);
        let mut starts = (0..count).filter(|&index| is_in(index) && !is_in(index + count - 1));
        let start = starts.next().filter(|_| starts.next().is_none())?;
        let end = (start..start + count).find(|&index| !is_in(index))?;
        Some(Run { start, end: end % count })
    };
    Some([run(0)?, run(1)?])
}
