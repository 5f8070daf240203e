//! Elementary functions, and all positions of groups.

#[cfg(feature = "std")]
mod arctangent;
#[cfg(feature = "std")]
mod lane;
mod modes;
#[cfg(feature = "std")]
mod pairs;
#[cfg(feature = "std")]
mod sine;
