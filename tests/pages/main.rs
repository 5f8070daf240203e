//! Pictures and pages.

mod animation;
mod charts;
mod door_closer;
mod drawings;
mod engine;
mod example_files;
mod manual;
mod report;
mod sheet;
mod skeleton;
mod tables;
