//! The algorithms of `interpreted` on every mechanism and every scene of the gallery: a part of the outer ring.

#[path = "../algorithms/mod.rs"]
mod algorithms;
#[path = "../drawn.rs"]
mod drawn;
mod every_scene;
mod mechanisms;
mod scenes;
