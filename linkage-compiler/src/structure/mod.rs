//! In what order the closures can be solved.
//!
//! All closures are one block here; what is checked is that the block can be regular at all:
//! a maximum matching gives each unknown an equation of its own.

/// How the linear systems of a block are solved.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Method {
    /// One or two unknowns, by formula.
    ClosedForm,
    /// More, by a factorisation with partial pivoting.
    Factorization,
}

/// The unknowns that are solved together.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Block {
    pub size: usize,
    pub method: Method,
}

/// The unknowns that compete for too few equations.
#[derive(Debug, PartialEq, Eq)]
pub struct StructurallySingular {
    pub unknowns: Vec<usize>,
    pub equations: Vec<usize>,
}

/// Orders a system in which `incidence[equation]` lists the unknowns of each equation.
///
/// # Errors
/// [`StructurallySingular`] if for every value of the parameters the system is singular: it names
/// a set of unknowns that together appear in fewer equations than there are unknowns.
pub fn order(incidence: &[Vec<usize>], unknowns: usize) -> Result<Block, StructurallySingular> {
    let mut equations_of: Vec<Vec<usize>> = vec![Vec::new(); unknowns];
    for (equation, row) in incidence.iter().enumerate() {
        for &unknown in row {
            equations_of[unknown].push(equation);
        }
    }
    let mut owner: Vec<Option<usize>> = vec![None; incidence.len()];
    for unknown in 0..unknowns {
        augment(unknown, &equations_of, &mut owner)?;
    }
    let method = if unknowns <= 2 { Method::ClosedForm } else { Method::Factorization };
    Ok(Block { size: unknowns, method })
}

/// Finds an equation for `start` along an alternating path, breadth first.
fn augment(start: usize, equations_of: &[Vec<usize>], owner: &mut [Option<usize>]) -> Result<(), StructurallySingular> {
    let mut reached_from: Vec<Option<usize>> = vec![None; owner.len()];
    let mut queue = vec![start];
    let mut next = 0;
    while next < queue.len() {
        let unknown = queue[next];
        next += 1;
        for &equation in &equations_of[unknown] {
            if reached_from[equation].is_some() {
                continue;
            }
            reached_from[equation] = Some(unknown);
            match owner[equation] {
                Some(other) => queue.push(other),
                None => {
                    let mut equation = equation;
                    // Walk back, handing each equation to the unknown that reached it.
                    while let Some(unknown) = reached_from[equation] {
                        let previous = owner.iter().position(|owner| *owner == Some(unknown));
                        owner[equation] = Some(unknown);
                        match previous {
                            Some(previous) if unknown != start => equation = previous,
                            _ => return Ok(()),
                        }
                    }
                    return Ok(());
                }
            }
        }
    }
    let equations = (0..owner.len()).filter(|&equation| reached_from[equation].is_some()).collect();
    queue.sort_unstable();
    Err(StructurallySingular { unknowns: queue, equations })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_a_matching_through_alternating_paths() {
        let block = order(&[vec![0, 1], vec![0], vec![1, 2]], 3);
        assert_eq!(block, Ok(Block { size: 3, method: Method::Factorization }));
    }

    #[test]
    fn names_the_unknowns_that_compete() {
        let error = order(&[vec![0, 1], vec![2], vec![2]], 3);
        assert_eq!(error, Err(StructurallySingular { unknowns: vec![0, 1], equations: vec![0] }));
    }
}
