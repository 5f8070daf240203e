//! Many positions at once: every accepted lane has the bits of the function for one position, and every rejected lane is
//! one for which that function returns an error.

mod bad_input;
mod same_bits;
