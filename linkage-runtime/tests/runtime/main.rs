//! Elementary functions, all positions of groups, and what is printed of results.

#[cfg(feature = "std")]
mod arctangent;
#[cfg(feature = "std")]
mod lane;
mod modes;
#[cfg(feature = "std")]
mod pairs;
#[cfg(feature = "std")]
mod shown;
#[cfg(feature = "std")]
mod sine;
