//! The algorithms of `interpreted` on every mechanism and every scene of the gallery: a part of the outer ring.

#[path = "../algorithms/mod.rs"]
mod algorithms;
#[path = "../../at_run_time.rs"]
mod at_run_time;
mod every_scene;
mod mechanisms;
mod scenes;
