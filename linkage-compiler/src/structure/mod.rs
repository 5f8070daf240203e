//! In what order the closures can be solved: the block-triangular form.
//!
//! Each unknown is given an equation of its own (`matching`). An equation then depends on those that
//! determine its other unknowns; equations that depend on one another must be solved together. These
//! groups are the strong components of the dependencies, and Tarjan's algorithm finds them in the
//! order in which they can be solved (I. S. Duff, J. K. Reid, "An implementation of Tarjan's algorithm
//! for the block triangularization of a matrix", ACM TOMS 4, 1978).

mod group;
mod matching;

pub use group::Group;
use matching::Matching;
pub use matching::StructurallySingular;

use crate::ids::{BlockId, Id, RowId, Table, UnknownId};

/// Unknowns that are solved together, from as many equations, once all blocks before are solved.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Block {
    /// Ascending.
    pub equations: Vec<RowId>,
    /// Ascending.
    pub unknowns: Vec<UnknownId>,
}

/// How the linear systems of a block are solved.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Method {
    /// One or two unknowns, by formula.
    ClosedForm,
    /// More, by a factorisation with partial pivoting.
    Factorization,
}

impl Block {
    #[must_use]
    pub fn method(&self) -> Method {
        if self.unknowns.len() <= 2 { Method::ClosedForm } else { Method::Factorization }
    }
}

/// Orders a system in which `incidence[equation]` lists the unknowns of each equation.
///
/// # Errors
/// [`StructurallySingular`] if for every value of the parameters the system is singular: it names
/// a set of unknowns that together appear in fewer equations than there are unknowns.
pub fn order(
    incidence: &Table<RowId, Vec<UnknownId>>,
    unknowns: usize,
) -> Result<Table<BlockId, Block>, StructurallySingular> {
    let matching = Matching::new(incidence, unknowns)?;
    let depends: Table<RowId, Vec<RowId>> = incidence
        .enumerated()
        .map(|(equation, row)| {
            let others = row.iter().filter_map(|&unknown| matching.equation(unknown));
            others.filter(|&other| other != equation).collect()
        })
        .collect();
    let blocks = strong_components(&depends);
    Ok(blocks
        .into_iter()
        .map(|mut equations| {
            equations.sort_unstable();
            let mut unknowns: Vec<UnknownId> =
                equations.iter().filter_map(|&equation| matching.unknown(equation)).collect();
            unknowns.sort_unstable();
            Block { equations, unknowns }
        })
        .collect())
}

/// The sign of det J beside the product of the determinants of the blocks: that of the two
/// permutations that bring J to its block-triangular form.
#[must_use]
pub fn is_odd(blocks: &Table<BlockId, Block>) -> bool {
    let equations = blocks.iter().flat_map(|block| block.equations.iter().copied()).collect();
    let unknowns = blocks.iter().flat_map(|block| block.unknowns.iter().copied()).collect();
    odd::<RowId>(&equations) != odd::<UnknownId>(&unknowns)
}

/// A cycle of even length is an odd permutation.
fn odd<I: Id>(permutation: &Table<I, I>) -> bool {
    let mut seen = permutation.filled(false);
    let mut odd = false;
    for start in permutation.ids() {
        let mut at = start;
        let mut length = 0;
        while !seen[at] {
            seen[at] = true;
            at = permutation[at];
            length += 1;
        }
        odd ^= length > 0 && length % 2 == 0;
    }
    odd
}

/// R. E. Tarjan, "Depth-first search and linear graph algorithms" (1972), without recursion:
/// a component comes out after all that it depends on.
fn strong_components(depends: &Table<RowId, Vec<RowId>>) -> Vec<Vec<RowId>> {
    let mut index = depends.filled(None);
    let mut low = depends.filled(0);
    let mut waiting = depends.filled(false);
    let (mut stack, mut components, mut next) = (Vec::new(), Vec::new(), 0);
    for root in depends.ids() {
        if index[root].is_some() {
            continue;
        }
        let mut path = vec![(root, 0)];
        while let Some((node, edge)) = path.pop() {
            if edge == 0 {
                index[node] = Some(next);
                low[node] = next;
                next += 1;
                stack.push(node);
                waiting[node] = true;
            } else {
                low[node] = low[node].min(low[depends[node][edge - 1]]);
            }
            // The next edge to a node not seen yet; an edge back to one that waits lowers the mark.
            let mut descend = None;
            for (position, &other) in depends[node].iter().enumerate().skip(edge) {
                let Some(at) = index[other] else {
                    descend = Some((position, other));
                    break;
                };
                if waiting[other] {
                    low[node] = low[node].min(at);
                }
            }
            if let Some((position, other)) = descend {
                path.push((node, position + 1));
                path.push((other, 0));
            } else if index[node] == Some(low[node]) {
                let start = stack.iter().rposition(|&other| other == node).unwrap_or(0);
                let component = stack.split_off(start);
                for &member in &component {
                    waiting[member] = false;
                }
                components.push(component);
            }
        }
    }
    components
}

#[cfg(test)]
mod tests {
    use super::*;

    pub(super) fn ids<I: Id>(places: &[usize]) -> Vec<I> {
        places.iter().map(|&place| I::new(place)).collect()
    }

    pub(super) fn incidence(rows: &[&[usize]]) -> Table<RowId, Vec<UnknownId>> {
        rows.iter().map(|row| ids(row)).collect()
    }

    fn block(equations: &[usize], unknowns: &[usize]) -> Block {
        Block { equations: ids(equations), unknowns: ids(unknowns) }
    }

    fn is_odd_permutation(places: &[usize]) -> bool {
        odd::<RowId>(&ids(places).into())
    }

    #[test]
    fn blocks_come_in_the_order_in_which_they_can_be_solved() {
        // Equations 2 and 3 hold the dyad that 0 and 1 stand on; 4 closes no loop of its own.
        let incidence = incidence(&[&[0, 1, 2], &[0, 1, 2], &[2, 3], &[2, 3], &[4, 0]]);
        let blocks = order(&incidence, 5).unwrap();
        assert_eq!(*blocks, [block(&[2, 3], &[2, 3]), block(&[0, 1], &[0, 1]), block(&[4], &[4])]);
        assert!(!is_odd(&blocks));
    }

    #[test]
    fn a_ring_is_one_block() {
        let ring = (0..6).map(|i| ids(&[i, (i + 1) % 6])).collect();
        assert_eq!(*order(&ring, 6).unwrap(), [block(&[0, 1, 2, 3, 4, 5], &[0, 1, 2, 3, 4, 5])]);
    }

    #[test]
    fn the_sign_is_that_of_the_permutations() {
        // J = [a 1; b 0]: block {1 | 0} before block {0 | 1}, det J = -b.
        let blocks = order(&incidence(&[&[0, 1], &[0]]), 2).unwrap();
        assert_eq!(*blocks, [block(&[1], &[0]), block(&[0], &[1])]);
        assert!(is_odd(&blocks));
        assert!(is_odd_permutation(&[1, 0, 2]) && !is_odd_permutation(&[1, 2, 0]) && is_odd_permutation(&[1, 2, 3, 0]));
    }

    #[test]
    fn a_long_chain_neither_recurses_nor_crawls() {
        let chain = (0..20_000_usize).map(|i| ids(&[i.saturating_sub(1), i])).collect();
        assert_eq!(order(&chain, 20_000).unwrap().len(), 20_000);
        let backwards = (0..20_000).map(|i| ids(&[i, (i + 1).min(19_999)])).collect();
        assert_eq!(order(&backwards, 20_000).unwrap().len(), 20_000);
    }
}
