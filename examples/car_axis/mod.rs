//! The car axis of the Test Set for IVP Solvers: its cost by method and tolerance, and its ride.

pub mod elsewhere;
pub mod ride;
pub mod runs;
