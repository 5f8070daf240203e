//! An equation for each unknown: a maximum matching of the incidence.

use std::collections::{BTreeMap, BTreeSet};

use crate::ids::{RowId, Table, UnknownId};

/// What is left over on either side.
#[derive(Debug, PartialEq, Eq)]
pub struct StructurallySingular {
    /// Unknowns of which one is determined by nothing.
    pub undetermined: Vec<UnknownId>,
    /// The fewer equations in which they appear.
    pub too_few: Vec<RowId>,
    /// Equations that compete, more of them than unknowns that they hold.
    pub competing: Vec<RowId>,
    /// The unknowns that they hold.
    pub contested: Vec<UnknownId>,
}

/// Which unknown each equation is given to, and the other way round.
pub(super) struct Matching {
    unknown: Table<RowId, Option<UnknownId>>,
    equation: Table<UnknownId, Option<RowId>>,
}

impl Matching {
    /// # Errors
    /// [`StructurallySingular`] if some unknowns together appear in fewer equations than they are.
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

    /// An equation that is left over, with all that compete with it for the same unknowns.
    fn surplus(&self, incidence: &Table<RowId, Vec<UnknownId>>) -> (Vec<RowId>, Vec<UnknownId>) {
        let left_over = self.unknown.ids().find(|&equation| self.unknown[equation].is_none());
        let mut equations: Vec<RowId> = left_over.into_iter().collect();
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

    /// Finds an equation for `start` along an alternating path, breadth first; else the unknowns and the
    /// equations that the search came to.
    fn augment(
        &mut self,
        start: UnknownId,
        equations_of: &Table<UnknownId, Vec<RowId>>,
    ) -> Result<(), (Vec<UnknownId>, Vec<RowId>)> {
        // Ordered, so that what an error names does not depend on chance.
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
                // Walk back, handing each equation to the unknown that reached it.
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
        // The chain 3 - 1 - 0 holds two unknowns, whatever stands beside it.
        let error = Matching::new(&incidence(&[&[0, 1], &[0], &[2], &[1]]), 4).err().unwrap();
        assert_eq!((error.undetermined, error.too_few), (ids(&[3]), ids(&[])));
        assert_eq!((error.competing, error.contested), (ids(&[0, 1, 3]), ids(&[0, 1])));
    }
}
