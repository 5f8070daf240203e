//! Friction by the reaction of its own joint: textbook limits of self-locking, closed forms of sliding, energy.

mod drawer;
mod energy;
mod ladder;
mod toggle;
mod wedge;
