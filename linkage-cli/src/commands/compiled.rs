//! The compiled mechanisms of a file, and the one that is meant.

use linkage_compiler::Lowered;
use linkage_compiler::budget::Budget;
use linkage_compiler::text::{self, Compiled};

use crate::arguments::From;
use crate::failure::Failure;
use crate::mistakes::{Mistakes, Source};
use crate::names::place;
use crate::progress;
use crate::source::read;

/// Compiles a text, and applies a function to each driver.
pub fn compiled<R>(source: &Source, f: impl FnMut(Lowered) -> R) -> Result<Vec<Compiled<R>>, Mistakes> {
    let compiled =
        progress::during(format!("deriving {}", source.name), || text::compile(&source.text, &Budget::default(), f));
    compiled.map_err(|messages| Mistakes::of(source, messages))
}

/// The results of a function for the drivers of a file: of the one that is asked for, or of all.
pub fn of_drivers<R>(from: &From, mut f: impl FnMut(Lowered) -> R) -> Result<Vec<(String, R)>, Failure> {
    let source = read(&from.file)?;
    let compiled = compiled(&source, |lowered| (lowered.program.signatures.driver.clone(), f(lowered)))?;
    let mut all: Vec<(String, R)> = compiled.into_iter().flat_map(|compiled| compiled.drivers).collect();
    if let Some(asked) = &from.mechanism {
        let names: Vec<&str> = all.iter().map(|(name, _)| name.as_str()).collect();
        let place = place(&source.name, "mechanism", asked, &names)?;
        return Ok(vec![all.swap_remove(place)]);
    }
    Ok(all)
}
