//! An equation for each unknown: a maximum matching of the incidence.

/// The unknowns that compete for too few equations.
#[derive(Debug, PartialEq, Eq)]
pub struct StructurallySingular {
    pub unknowns: Vec<usize>,
    pub equations: Vec<usize>,
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
        for unknown in 0..unknowns {
            matching.augment(unknown, &equations_of)?;
        }
        Ok(matching)
    }

    pub(super) fn unknown(&self, equation: usize) -> Option<usize> {
        self.unknown[equation]
    }

    pub(super) fn equation(&self, unknown: usize) -> Option<usize> {
        self.equation[unknown]
    }

    /// Finds an equation for `start` along an alternating path, breadth first.
    fn augment(&mut self, start: usize, equations_of: &[Vec<usize>]) -> Result<(), StructurallySingular> {
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
        Err(StructurallySingular { unknowns: queue, equations: reached_from.into_keys().collect() })
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
        assert_eq!(error, Some(StructurallySingular { unknowns: vec![0, 1], equations: vec![0] }));
    }
}
