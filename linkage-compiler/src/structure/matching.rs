//! An equation for each unknown: a maximum matching of the incidence.

/// What is left over on either side.
#[derive(Debug, PartialEq, Eq)]
pub struct StructurallySingular {
    /// Unknowns of which one is determined by nothing.
    pub undetermined: Vec<usize>,
    /// The fewer equations in which they appear.
    pub too_few: Vec<usize>,
    /// Equations that compete, more of them than unknowns that they hold.
    pub competing: Vec<usize>,
    /// The unknowns that they hold.
    pub contested: Vec<usize>,
}

/// Which unknown each equation is given to, and the other way round.
pub(super) struct Matching {
    /// By equation.
    unknown: Vec<Option<usize>>,
    /// By unknown.
    equation: Vec<Option<usize>>,
}

impl Matching {
    /// # Errors
    /// [`StructurallySingular`] if some unknowns together appear in fewer equations than they are.
    pub(super) fn new(incidence: &[Vec<usize>], unknowns: usize) -> Result<Self, StructurallySingular> {
        let mut equations_of: Vec<Vec<usize>> = vec![Vec::new(); unknowns];
        for (equation, row) in incidence.iter().enumerate() {
            for &unknown in row {
                equations_of[unknown].push(equation);
            }
        }
        let mut matching = Self { unknown: vec![None; incidence.len()], equation: vec![None; unknowns] };
        let mut missing = None;
        for unknown in 0..unknowns {
            if let Err(stuck) = matching.augment(unknown, &equations_of) {
                missing.get_or_insert(stuck);
            }
        }
        let Some((undetermined, too_few)) = missing else { return Ok(matching) };
        let (competing, contested) = matching.surplus(incidence);
        Err(StructurallySingular { undetermined, too_few, competing, contested })
    }

    /// An equation that is left over, with all that compete with it for the same unknowns.
    fn surplus(&self, incidence: &[Vec<usize>]) -> (Vec<usize>, Vec<usize>) {
        let mut equations: Vec<usize> = self.unknown.iter().position(Option::is_none).into_iter().collect();
        let mut unknowns = std::collections::BTreeSet::new();
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

    pub(super) fn unknown(&self, equation: usize) -> Option<usize> {
        self.unknown[equation]
    }

    pub(super) fn equation(&self, unknown: usize) -> Option<usize> {
        self.equation[unknown]
    }

    /// Finds an equation for `start` along an alternating path, breadth first; else the unknowns and the
    /// equations that the search came to.
    fn augment(&mut self, start: usize, equations_of: &[Vec<usize>]) -> Result<(), (Vec<usize>, Vec<usize>)> {
        // Ordered, so that what an error names does not depend on chance.
        let mut reached_from = std::collections::BTreeMap::new();
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

    #[test]
    fn finds_a_matching_through_alternating_paths() {
        let matching = Matching::new(&[vec![0, 1], vec![0], vec![1, 2]], 3).unwrap();
        assert_eq!(matching.equation, [Some(1), Some(0), Some(2)]);
        assert_eq!(matching.unknown, [Some(1), Some(0), Some(2)]);
    }

    #[test]
    fn names_the_unknowns_that_compete() {
        let error = Matching::new(&[vec![0, 1], vec![2], vec![2]], 3).err();
        let expected = StructurallySingular {
            undetermined: vec![0, 1],
            too_few: vec![0],
            competing: vec![1, 2],
            contested: vec![2],
        };
        assert_eq!(error, Some(expected));
        // The chain 3 - 1 - 0 holds two unknowns, whatever stands beside it.
        let error = Matching::new(&[vec![0, 1], vec![0], vec![2], vec![1]], 4).err().unwrap();
        assert_eq!((error.undetermined, error.too_few), (vec![3], vec![]));
        assert_eq!((error.competing, error.contested), (vec![0, 1, 3], vec![0, 1]));
    }
}
