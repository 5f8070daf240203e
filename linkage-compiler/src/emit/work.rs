//! The public functions of a program as a list, with what they cost and compute.

use super::fpcore::Straight;
use crate::lower::Code;
use crate::program::{Functions, Operations};

/// A public function of the program.
pub(super) struct Work {
    pub(super) function: String,
    pub(super) operations: Operations,
    /// Its formulas, line by line; empty unless requested.
    pub(super) lines: String,
}

/// The public functions with their operation counts, without those that compute nothing.
pub(super) fn works(functions: &Functions<Code>, straight: Option<&Straight>) -> Vec<Work> {
    let public = functions.iter().filter(|function| function.access.is_public());
    let works = public.filter_map(|function| Some((function.name.clone(), function.body.as_ref()?.operations)));
    let works = works.filter(|(_, operations)| *operations != Operations::default());
    let works = works.map(|(function, operations)| {
        let lines = straight.map_or_else(String::new, |straight| straight.lines(&function));
        Work { function, operations, lines }
    });
    works.collect()
}
