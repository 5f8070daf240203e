//! The links and joints that the vectors of loops and points show.
//!
//! n links with j joints of one degree of freedom have the mobility 3 (n - 1) - 2 j - e, where e are the conditions between
//! coordinates, such as those of gears: the count of P. L. Chebyshev, M. Grübler ("Getriebelehre", 1917) and K. Kutzbach
//! (1929). Links are kept only if it is the number of inputs, or less where loops are declared as implied.

use std::collections::BTreeSet;

use super::chain::{Chain, Chains};
use super::kind::Kind;
use super::links::{GROUND, Links};
use super::mechanism::Mechanism;
use crate::budget::Budget;
use crate::graph::{Graph, NodeId, SymbolId};
use crate::ids::Table;

/// The links and joints of a linkage.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct KinematicChain {
    /// The ground comes first.
    pub links: Vec<ChainLink>,
    pub joints: Vec<ChainJoint>,
    /// The number of conditions between coordinates.
    pub conditions: usize,
}

/// A rigid link: its name, and the coordinates in its angle.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ChainLink {
    pub name: String,
    pub turns_with: Vec<String>,
    /// Links that turn by one angle have one direction.
    direction: Option<usize>,
}

/// A joint between two links, by index; the coordinate along which it slides if it does not turn.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ChainJoint {
    pub links: [usize; 2],
    pub slides_along: Option<String>,
}

/// The most coordinates of a mechanism whose links are looked for: each angle is compared with all others, 64 of them in
/// less than a thousandth of the budget of an invocation.
const MOST_COORDINATES: usize = 64;

/// The budget of the search; without more, no links are found.
const STEPS: usize = 2_000_000;

impl KinematicChain {
    /// The links of a mechanism with so many inputs; none if its loops do not show them.
    #[must_use]
    pub fn of(mechanism: &Mechanism, inputs: usize) -> Option<Self> {
        if mechanism.loops.is_empty() || mechanism.coordinates.iter().count() > MOST_COORDINATES {
            return None;
        }
        let mut graph = mechanism.graph.copy_within(&Budget::new(STEPS));
        let moving: BTreeSet<SymbolId> = mechanism.coordinates.iter().map(|coordinate| coordinate.symbol).collect();
        let as_written = mechanism.loops.clone();
        // In a@theta + b@phi = c@psi + d@0 the last vector is the ground, from which c@psi begins.
        let ground_first: Vec<[Chain; 2]> =
            as_written.iter().map(|sides| sides.each_ref().map(|side| ground_first(&graph, &moving, side))).collect();
        [as_written, ground_first].into_iter().find_map(|loops| {
            let chain = Self::from_loops(mechanism, &mut graph, &moving, loops, inputs)?;
            let count = chain.mobility();
            let is_overconstrained = count < inputs && !mechanism.implied.is_empty();
            (count == inputs || is_overconstrained).then_some(chain)
        })
    }

    fn from_loops(
        mechanism: &Mechanism,
        graph: &mut Graph,
        moving: &BTreeSet<SymbolId>,
        loops: Vec<[Chain; 2]>,
        inputs: usize,
    ) -> Option<Self> {
        let chains = Chains {
            loops,
            zeros: mechanism.zero_sides.clone(),
            points: mechanism.points.iter().map(|point| point.chain.clone()).collect(),
            ..Chains::default()
        };
        let links = Links::of(graph, moving.clone(), &chains, &Table::default());
        if !links.is_complete || !links.floating.is_empty() || graph.budget().check().is_err() {
            return None;
        }
        let name = |graph: &Graph, symbol: SymbolId| graph.symbol_name(symbol).to_owned();
        let all = links.indices().map(|index| ChainLink {
            name: links.link(index).name.clone(),
            turns_with: links.turns(graph, index).into_iter().map(|symbol| name(graph, symbol)).collect(),
            direction: Some(links.direction(index)),
        });
        let conditions: Vec<NodeId> = mechanism.conditions().collect();
        let mut chain = Self { links: all.collect(), joints: Vec::new(), conditions: conditions.len() };
        // Of k links in one pin, k - 1 turn about the first.
        for of_pin in links.meeting() {
            let Some((&first, others)) = of_pin.split_first() else { continue };
            chain.joints.extend(others.iter().map(|&other| ChainJoint { links: [first, other], slides_along: None }));
        }
        chain.joints.extend(
            links
                .guides
                .iter()
                .map(|guide| ChainJoint { links: guide.links, slides_along: Some(name(graph, guide.coordinate)) }),
        );
        chain.merge_blocks();
        // A coordinate of conditions alone, such as the angle of a gear, moves a link on the ground.
        let of_loops = graph.symbols_of(&mechanism.rows_of_constraints(2));
        for symbol in graph.symbols_of(&conditions).into_iter().filter(|symbol| moving.contains(symbol)) {
            if of_loops.contains(&symbol) {
                continue;
            }
            let is_angle = mechanism.coordinates.iter().any(|one| one.symbol == symbol && one.kind == Kind::Angle);
            let coordinate = name(graph, symbol);
            let turns_with = if is_angle { vec![coordinate.clone()] } else { Vec::new() };
            chain.joints.push(ChainJoint {
                links: [GROUND, chain.links.len()],
                slides_along: (!is_angle).then(|| coordinate.clone()),
            });
            chain.links.push(ChainLink { name: coordinate, turns_with, direction: None });
        }
        while chain.mobility() > inputs && chain.merge_parallel() {}
        chain.drop_unjoined();
        Some(chain)
    }

    /// 3 (n - 1) - 2 j - e.
    fn mobility(&self) -> usize {
        let joined = (0..self.links.len()).filter(|&link| link == GROUND || self.is_joined(link)).count();
        (3 * joined).saturating_sub(3 + 2 * self.joints.len() + self.conditions)
    }

    fn is_joined(&self, link: usize) -> bool {
        self.joints.iter().any(|joint| joint.links.contains(&link))
    }

    /// Merges links that slide on one link along one coordinate.
    fn merge_blocks(&mut self) {
        let key = |joint: &ChainJoint| joint.slides_along.clone().map(|coordinate| (joint.links[0], coordinate));
        let mut place = 0;
        while place < self.joints.len() {
            let first = self.joints[..place].iter().find(|one| {
                let of_place = key(&self.joints[place]);
                of_place.is_some() && key(one) == of_place
            });
            match first.map(|first| first.links[1]) {
                Some(kept) => {
                    let gone = self.joints.remove(place).links[1];
                    self.merge(kept, gone);
                }
                None => place += 1,
            }
        }
    }

    /// Merges two links that turn about the ground by one angle: a loop may be written from another joint than the one
    /// about which its first link turns. False if there are none.
    fn merge_parallel(&mut self) -> bool {
        let on_ground = |joint: &ChainJoint| match joint {
            ChainJoint { links: [GROUND, link] | [link, GROUND], slides_along: None } => Some(*link),
            _ => None,
        };
        let of_ground: Vec<usize> = self.joints.iter().filter_map(on_ground).collect();
        let direction = |link: usize| self.links[link].direction;
        let pairs = of_ground.iter().flat_map(|&one| of_ground.iter().map(move |&other| (one, other)));
        let mut pairs = pairs.filter(|(one, other)| one < other);
        let found = pairs.find(|&(one, other)| direction(one).is_some() && direction(one) == direction(other));
        let Some((kept, gone)) = found else { return false };
        self.joints.retain(|joint| on_ground(joint) != Some(gone));
        self.merge(kept, gone);
        true
    }

    /// Lets a link take the joints of another, which has none then.
    fn merge(&mut self, kept: usize, gone: usize) {
        for link in self.joints.iter_mut().flat_map(|joint| &mut joint.links) {
            if *link == gone {
                *link = kept;
            }
        }
        self.joints.retain(|joint| joint.links[0] != joint.links[1]);
    }

    /// Removes links without joints: those of points that no loop moves, and merged ones.
    fn drop_unjoined(&mut self) {
        for link in (1..self.links.len()).rev().filter(|&link| link != GROUND) {
            if self.is_joined(link) {
                continue;
            }
            self.links.remove(link);
            for other in self.joints.iter_mut().flat_map(|joint| &mut joint.links) {
                *other -= usize::from(*other > link);
            }
        }
    }
}

/// A side of a loop with its constant vectors first.
fn ground_first(graph: &Graph, moving: &BTreeSet<SymbolId>, side: &Chain) -> Chain {
    let moves = |vector: &[NodeId; 2]| graph.symbols_of(vector).iter().any(|symbol| moving.contains(symbol));
    let mut side = side.clone();
    side.links.sort_by_key(|link| moves(&link.vector));
    side
}
