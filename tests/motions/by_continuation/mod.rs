//! Circuits and limits of random linkages against a continuation in small steps, which has its own equations, derivatives
//! and step.

mod circuits;
mod continuation;
mod families;
mod limits;

/// The number of linkages of each family: `LINKAGES=10000` for a larger one.
pub fn count() -> usize {
    linkage_trials::count("LINKAGES", 4, 12)
}
