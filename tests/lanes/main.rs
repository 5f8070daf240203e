//! Many positions at once: every accepted lane has the bits of the functions for one position, every rejected lane is one for
//! which `kinematics` returns an error, and a number that does not exist is missing in its own column alone.

mod bad_input;
mod by_name;
mod rows;
mod same_bits;
mod same_text;
