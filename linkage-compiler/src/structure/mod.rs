//! The order of solution of the equations: block-triangular form.
//!
//! A maximum matching assigns an equation to each unknown. An equation depends on the equations assigned to its other
//! unknowns; equations that depend on one another must be solved together. These groups are the strongly connected
//! components of the dependency graph, which Tarjan's algorithm finds in the order of solution (I. S. Duff, J. K. Reid,
//! "An implementation of Tarjan's algorithm for the block triangularization of a matrix", ACM TOMS 4, 1978).

mod choice;
mod directions;
mod distance;
mod elimination;
mod kind;
mod loops;
mod matching;
mod obstacle;
mod slide;

pub use choice::Choice;
pub use distance::Distance;
pub use elimination::{Elimination, System, incidence};
pub use kind::{Circles, Class, GroupKind, mirror};
pub use loops::{Guide, Loops};
use matching::Matching;
pub use matching::StructurallySingular;
pub use obstacle::Obstacle;
pub use slide::{Slide, find_slides};

use crate::ids::{GroupId, Id, RowId, Table, UnknownId};

/// Unknowns that are solved together from as many equations, after all earlier groups.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Group {
    /// In ascending order.
    pub equations: Vec<RowId>,
    /// In ascending order.
    pub unknowns: Vec<UnknownId>,
    /// The slider, if it is the angle of a dyad whose length another group has.
    pub slide: Option<Slide>,
}

/// The solution method for the linear systems of a group.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Method {
    /// One or two unknowns, by formula.
    ClosedForm,
    /// More unknowns, by LU factorisation with partial pivoting.
    Factorization,
}

impl Group {
    #[must_use]
    pub fn method(&self) -> Method {
        if self.unknowns.len() <= 2 { Method::ClosedForm } else { Method::Factorization }
    }
}

/// Orders a system in which `incidence[equation]` lists the unknowns of each equation.
///
/// # Errors
/// [`StructurallySingular`] if the system is singular for all values of the parameters: a set of unknowns that
/// appear in fewer equations than there are unknowns in the set.
pub fn order(
    incidence: &Table<RowId, Vec<UnknownId>>,
    unknowns: usize,
) -> Result<Table<GroupId, Group>, StructurallySingular> {
    let matching = Matching::new(incidence, unknowns)?;
    let depends: Table<RowId, Vec<RowId>> = incidence
        .enumerated()
        .map(|(equation, row)| {
            let others = row.iter().filter_map(|&unknown| matching.equation(unknown));
            others.filter(|&other| other != equation).collect()
        })
        .collect();
    let groups = strong_components(&depends);
    Ok(groups
        .into_iter()
        .map(|mut equations| {
            equations.sort_unstable();
            let mut unknowns: Vec<UnknownId> =
                equations.iter().filter_map(|&equation| matching.unknown(equation)).collect();
            unknowns.sort_unstable();
            Group { equations, unknowns, slide: None }
        })
        .collect())
}

/// True if det J is minus the product of the determinants of the groups: the permutations of rows and columns to
/// block-triangular form have different parity.
#[must_use]
pub fn is_odd(groups: &Table<GroupId, Group>) -> bool {
    let equations = groups.iter().flat_map(|group| group.equations.iter().copied()).collect();
    let unknowns = groups.iter().flat_map(|group| group.unknowns.iter().copied()).collect();
    odd::<RowId>(&equations) != odd::<UnknownId>(&unknowns)
}

/// The parity of a permutation: each cycle of even length is odd.
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

/// The strongly connected components, each after those that it depends on, without recursion (R. E. Tarjan,
/// "Depth-first search and linear graph algorithms", 1972).
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
            // Find the next edge to a new node; an edge to a node on the stack lowers `low`.
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

    pub(super) fn ids<I: Id>(indices: &[usize]) -> Vec<I> {
        indices.iter().map(|&index| I::new(index)).collect()
    }

    pub(super) fn incidence(rows: &[&[usize]]) -> Table<RowId, Vec<UnknownId>> {
        rows.iter().map(|row| ids(row)).collect()
    }

    fn group(equations: &[usize], unknowns: &[usize]) -> Group {
        Group { equations: ids(equations), unknowns: ids(unknowns), slide: None }
    }

    fn is_odd_permutation(indices: &[usize]) -> bool {
        odd::<RowId>(&ids(indices).into())
    }

    #[test]
    fn groups_come_in_the_order_in_which_they_can_be_solved() {
        // Equations 2 and 3 form a dyad; that of 0 and 1 depends on it, and 4 depends on 0.
        let incidence = incidence(&[&[0, 1, 2], &[0, 1, 2], &[2, 3], &[2, 3], &[4, 0]]);
        let groups = order(&incidence, 5).unwrap();
        assert_eq!(*groups, [group(&[2, 3], &[2, 3]), group(&[0, 1], &[0, 1]), group(&[4], &[4])]);
        assert!(!is_odd(&groups));
    }

    #[test]
    fn a_ring_is_one_group() {
        let ring = (0..6).map(|i| ids(&[i, (i + 1) % 6])).collect();
        assert_eq!(*order(&ring, 6).unwrap(), [group(&[0, 1, 2, 3, 4, 5], &[0, 1, 2, 3, 4, 5])]);
    }

    #[test]
    fn the_sign_is_that_of_the_permutations() {
        // J = [a 1; b 0]: group {1 | 0} before group {0 | 1}, det J = -b.
        let groups = order(&incidence(&[&[0, 1], &[0]]), 2).unwrap();
        assert_eq!(*groups, [group(&[1], &[0]), group(&[0], &[1])]);
        assert!(is_odd(&groups));
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
