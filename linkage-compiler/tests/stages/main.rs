//! Stages of the compiler, each by what it makes.

mod algebra;
mod bodies_by_hand;
mod closed_forms;
mod dangling;
mod divisors;
mod documentation;
mod exponents;
mod features;
mod limits;
mod loops;
mod names_of_effects;
mod notation;
mod pipeline;
mod stubs;
