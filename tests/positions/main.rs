//! Positions, branches, turns, limits and singular positions.

mod assembled_poses;
mod assembly;
mod external;
mod extremes;
mod extremes_along;
mod limits;
mod modes;
mod position;
mod ranges;
mod singularity;
mod turning_guides;
mod turns;
