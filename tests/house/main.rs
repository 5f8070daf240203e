//! The project itself: packages, imports, the manual.

mod circles;
mod constructs;
mod packages;
