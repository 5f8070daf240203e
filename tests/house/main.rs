//! The project itself: packages, imports, the manual.

mod circles;
mod commands;
mod constructs;
mod packages;
