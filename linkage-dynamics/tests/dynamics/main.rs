//! Modes of contacts, frictions by reactions, integration, and names that are not static.

mod choices;
mod integrate;
mod names;
mod not_finite;
mod reactions;
