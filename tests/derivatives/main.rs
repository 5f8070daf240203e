//! Emitted code computes the derived expressions, and these are right: also by other ways to write a mechanism.

mod agreement;
mod any_mechanism;
mod by_hand;
mod implied;
mod orders;
mod three_ways;
mod unreduced;
