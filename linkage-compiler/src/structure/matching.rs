//! A maximum matching of equations and unknowns: each unknown gets an equation that contains it, and no equation is
//! used twice. Without one for all unknowns the Jacobian is singular at every position.

use std::collections::{BTreeMap, BTreeSet};

use crate::ids::{RowId, Table, UnknownId};

/// Unknowns and equations that cannot be matched.
#[derive(Debug, PartialEq, Eq)]
pub struct StructurallySingular {
    /// Unknowns that appear in too few equations.
    pub undetermined: Vec<UnknownId>,
    /// The equations in which they appear, fewer than the unknowns.
    pub too_few: Vec<RowId>,
    /// Equations that contain too few unknowns.
    pub competing: Vec<RowId>,
    /// The unknowns that they contain, fewer than the equations.
    pub contested: Vec<UnknownId>,
}

/// The unknown of each equation, and the equation of each unknown.
pub(super) struct Matching {
    unknown: Table<RowId, Option<UnknownId>>,
    equation: Table<UnknownId, Option<RowId>>,
}

impl Matching {
    /// # Errors
    /// [`StructurallySingular`] if some unknowns appear in fewer equations than there are of them.
    pub(super) fn new(incidence: &Table<RowId, Vec<UnknownId>>, unknowns: usize) -> Result<Self, StructurallySingular> {
        let mut equations_of: Table<UnknownId, Vec<RowId>> = vec![Vec::new(); unknowns].into();
        for (equation, row) in incidence.enumerated() {
            for &unknown in row {
                equations_of[unknown].push(equation);
            }
        }
        let mut matching = Self { unknown: incidence.filled(None), equation: equations_of.filled(None) };
        let mut missing = None;
        for unknown in equations_of.ids() {
            if let Err(stuck) = matching.augment(unknown, &equations_of) {
                missing.get_or_insert(stuck);
            }
        }
        let Some((undetermined, too_few)) = missing else { return Ok(matching) };
        let (competing, contested) = matching.surplus(incidence);
        Err(StructurallySingular { undetermined, too_few, competing, contested })
    }

    /// An unmatched equation, the equations that it competes with for unknowns, and these unknowns.
    fn surplus(&self, incidence: &Table<RowId, Vec<UnknownId>>) -> (Vec<RowId>, Vec<UnknownId>) {
        let unmatched = self.unknown.ids().find(|&equation| self.unknown[equation].is_none());
        let mut equations: Vec<RowId> = unmatched.into_iter().collect();
        let mut unknowns = BTreeSet::new();
        let mut next = 0;
        while next < equations.len() {
            for &unknown in &incidence[equations[next]] {
                if unknowns.insert(unknown) {
                    equations.extend(self.equation[unknown]);
                }
            }
            next += 1;
        }
        equations.sort_unstable();
        (equations, unknowns.into_iter().collect())
    }

    pub(super) fn unknown(&self, equation: RowId) -> Option<UnknownId> {
        self.unknown[equation]
    }

    pub(super) fn equation(&self, unknown: UnknownId) -> Option<RowId> {
        self.equation[unknown]
    }

    /// Finds an equation for `start`, if needed by giving other unknowns other equations (an alternating path), by
    /// breadth-first search. The error holds the unknowns and equations that the search reached: more unknowns than
    /// equations.
    fn augment(
        &mut self,
        start: UnknownId,
        equations_of: &Table<UnknownId, Vec<RowId>>,
    ) -> Result<(), (Vec<UnknownId>, Vec<RowId>)> {
        // An ordered map, so that errors are deterministic.
        let mut reached_from = BTreeMap::new();
        let mut queue = vec![start];
        let mut next = 0;
        while next < queue.len() {
            let unknown = queue[next];
            next += 1;
            for &equation in &equations_of[unknown] {
                if reached_from.contains_key(&equation) {
                    continue;
                }
                reached_from.insert(equation, unknown);
                if let Some(other) = self.unknown[equation] {
                    queue.push(other);
                    continue;
                }
                // Walk back along the path and assign each equation to the unknown that reached it.
                let mut free = Some(equation);
                while let Some(equation) = free {
                    let unknown = reached_from[&equation];
                    free = self.equation[unknown].replace(equation);
                    self.unknown[equation] = Some(unknown);
                }
                return Ok(());
            }
        }
        queue.sort_unstable();
        Err((queue, reached_from.into_keys().collect()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::structure::tests::{ids, incidence};

    #[test]
    fn finds_a_matching_through_alternating_paths() {
        let matching = Matching::new(&incidence(&[&[0, 1], &[0], &[1, 2]]), 3).unwrap();
        assert_eq!(matching.equation.map(Option::unwrap).to_vec(), ids(&[1, 0, 2]));
        assert_eq!(matching.unknown.map(Option::unwrap).to_vec(), ids(&[1, 0, 2]));
    }

    #[test]
    fn names_the_unknowns_that_compete() {
        let error = Matching::new(&incidence(&[&[0, 1], &[2], &[2]]), 3).err();
        let expected = StructurallySingular {
            undetermined: ids(&[0, 1]),
            too_few: ids(&[0]),
            competing: ids(&[1, 2]),
            contested: ids(&[2]),
        };
        assert_eq!(error, Some(expected));
        // Equations 3, 1 and 0 contain only two unknowns.
        let error = Matching::new(&incidence(&[&[0, 1], &[0], &[2], &[1]]), 4).err().unwrap();
        assert_eq!((error.undetermined, error.too_few), (ids(&[3]), ids(&[])));
        assert_eq!((error.competing, error.contested), (ids(&[0, 1, 3]), ids(&[0, 1])));
    }
}
