//! Positions, branches, turns, limits and singular positions.

mod assembled_poses;
mod assembly;
mod external;
mod extremes;
mod limits;
mod modes;
mod position;
mod singularity;
mod turning_guides;
mod turns;
