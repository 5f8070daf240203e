//! Scenes in motion against exact laws, published figures and the same motion in other coordinates.

mod andrews;
mod backward;
mod change_points;
mod contacts;
mod contacts_of_linkages;
mod contacts_over_change_points;
mod dead_points;
mod doors;
mod extremes;
mod failures;
mod loads;
mod long_runs;
mod no_load;
mod rig;
mod shallow_contacts;
mod stiffness;
mod windows;
