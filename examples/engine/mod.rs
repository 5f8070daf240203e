//! An engine on a brake.

pub mod indicated;
pub mod loads;
pub mod machine;
pub mod run;
