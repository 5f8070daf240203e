//! Elementary functions, all positions of groups, what is printed of results, and names that are not static.

#[cfg(feature = "std")]
mod arctangent;
#[cfg(feature = "std")]
mod elementary;
#[cfg(feature = "std")]
mod lane;
mod modes;
#[cfg(feature = "std")]
mod names;
#[cfg(feature = "std")]
mod pairs;
#[cfg(feature = "std")]
mod shown;
#[cfg(feature = "std")]
mod sine;
