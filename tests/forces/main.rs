//! Equations of motion, forces in joints and friction by them, against other ways to write mechanics.

mod joint_friction;
mod open_chains;
mod reactions;
mod scenes;
