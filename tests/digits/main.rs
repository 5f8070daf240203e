//! Results against numbers of 31 and 48 digits, and their errors against the largest that the docs allow.

mod accuracy;
mod forty_digits;
mod fpcore;
mod limits_to_forty_digits;
mod rounding;
mod rounding_bounds;
