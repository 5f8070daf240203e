//! Hard cases, one a file, each with the program or the formula that is known to fail there.

mod bad_input;
mod dead_centre;
mod freudenstein_roth;
mod locked_second_group;
mod many_turns;
mod near_change_point;
mod parallelogram_change_point;
mod random_steps;
mod three_joints_in_line;
mod wrong_side;
