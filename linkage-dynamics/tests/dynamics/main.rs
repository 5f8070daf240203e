//! Modes of contacts, frictions by reactions, and integration.

mod choices;
mod integrate;
mod not_finite;
mod reactions;
