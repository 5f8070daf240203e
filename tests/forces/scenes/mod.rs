//! Scenes: the equations of motion against the principle of virtual work with dual numbers along positions alone,
//! against Lagrange's equations of the emitted mass matrix, against published numbers, and against energy.

mod andrews;
mod energy;
mod errors;
mod forces_at_rest;
mod integrators;
mod machines;
mod meeting_ends;
mod motion;
mod virtual_work;
