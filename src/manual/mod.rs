//! The manual: pages to read, without items.
//!
//! | page | contents |
//! |---|---|
//! | [`first_mechanism`] | from a drawing to numbers |
//! | [`at_run_time`] | mechanisms from text in a program that runs, by the library `linkage-interpreter` |
//! | [`without_rust`] | a mechanism in a file of its own, and the program `linkage` |
//! | [`first_picture`] | a picture and an animation in three lines |
//! | [`first_sheet`] | the derivation as a document |
//! | [`the_sheet`] | the sheet, line by line: two courses, and where each of their formulas is |
//! | [`first_report`] | mobility, limits, transmission angles, strokes and dwells in one call |
//! | [`first_simulation`] | bodies, forces and a motion in time |
//! | [`torque`] | torque and forces over a turn: tables, CSV, charts |
//! | [`linkage!`](crate::linkage!) | the language |
//! | [`emitted`] | the types and functions of a mechanism |
//! | [`velocity_ratios`] | the matrix W, its properties, and transmission ratios |
//! | [`assur_groups`] | the groups in which a mechanism is solved, by their names in textbooks |
//! | [`two_inputs`] | a mechanism with two degrees of freedom |
//! | [`cam_laws`] | your own functions |
//! | [`scenes`] | all effects of a scene; dry friction and stops |
//! | [`dead_points`], [`change_points`] | motions through positions where the input cannot drive, and where motions cross |
//! | [`circuits`] | all positions at one input, and which of them are connected by motion |
//! | [`recipes`] | inverse kinematics, a motor between links, compliant joints, a suspension, a gripper |
//! | [`many_designs`] | thousands of designs at once |
//! | [`microcontrollers`] | without the standard library, in `f32`: flags and sizes |
//! | [`units`] | units that fit, rpm and degrees |
//! | [`certificates`] | proofs that a motion has no jump, and enclosures of its extremes |
//! | [`errors`] | messages of the macro, errors at run time |
//! | [`speed`], [`accuracy`], [`stability`] | times, errors and hard cases, as measured |
//! | [`examples`] | the examples of the repository, with what they measure |
//! | [`crates`] | the crates of the workspace, their features, tests and fuzzing |

/// From a drawing to numbers: a four-bar.
///
#[doc = include_str!("four_bar.svg")]
///
#[doc = include_str!("first_mechanism.md")]
pub mod first_mechanism {}

/// Mechanisms from text in a program that runs: the library `linkage-interpreter`.
///
#[doc = include_str!("at_run_time.md")]
pub mod at_run_time {}

/// The program `linkage`: sheets, checks and code of a mechanism in a file, without a Rust project.
///
#[doc = include_str!("without_rust.md")]
pub mod without_rust {}

/// A picture, an animation, and how to change what they guess.
///
#[doc = include_str!("coupler_curve.svg")]
///
#[doc = include_str!("first_picture.md")]
pub mod first_picture {}

/// The derivation as a document: formulas, numbers and a picture in one file.
///
#[doc = include_str!("first_sheet.md")]
pub mod first_sheet {}

/// The sheet, line by line: all that two courses write out, with its place and its test.
///
#[doc = include_str!("the_sheet.md")]
pub mod the_sheet {}

/// The first questions about a mechanism, answered in one call.
///
#[doc = include_str!("first_report.svg")]
///
#[doc = include_str!("first_report.md")]
pub mod first_report {}

/// Bodies, forces, and a motion in time.
///
#[doc = include_str!("first_simulation.svg")]
///
#[doc = include_str!("first_simulation.md")]
pub mod first_simulation {}

/// Torque and forces over a turn, as a table, as CSV and as charts.
///
#[doc = include_str!("torque.svg")]
///
#[doc = include_str!("torque.md")]
pub mod torque {}

/// The types and functions that `mechanism FourBar { .. }` becomes.
///
#[doc = include_str!("emitted.md")]
pub mod emitted {}

/// The matrix W of velocity ratios: its six properties, and transmission ratios.
///
#[doc = include_str!("velocity_ratios.svg")]
///
#[doc = include_str!("velocity_ratios.md")]
pub mod velocity_ratios {}

/// The groups in which a mechanism is solved: RRR, RRP, RPR, PRP and RPP.
///
#[doc = include_str!("assur_groups.svg")]
///
#[doc = include_str!("assur_groups.md")]
pub mod assur_groups {}

/// A mechanism with two degrees of freedom.
///
#[doc = include_str!("two_inputs.svg")]
///
#[doc = include_str!("two_inputs.md")]
pub mod two_inputs {}

/// Your own functions: cam laws, tables, errors of gears, with their derivatives.
///
#[doc = include_str!("cam_laws.svg")]
///
#[doc = include_str!("cam_laws.md")]
pub mod cam_laws {}

/// Inertia and forces: a scene, its functions, its simulation, dry friction and stops.
///
#[doc = include_str!("scenes.md")]
pub mod scenes {}

/// Motions through dead points, where the input cannot drive.
///
#[doc = include_str!("dead_points.svg")]
///
#[doc = include_str!("dead_points.md")]
pub mod dead_points {}

/// Motions through change points, where motions cross.
///
#[doc = include_str!("parallelogram.svg")]
///
#[doc = include_str!("change_points.md")]
pub mod change_points {}

/// All positions at one input, and which of them are connected by motion.
///
#[doc = include_str!("circuits.svg")]
///
#[doc = include_str!("circuits.md")]
pub mod circuits {}

/// Recipes that need no function of their own.
///
#[doc = include_str!("recipes.svg")]
///
#[doc = include_str!("recipes.md")]
pub mod recipes {}

/// Thousands of designs at once.
///
#[doc = include_str!("many_designs.md")]
pub mod many_designs {}

/// On a microcontroller: without the standard library, in `f32`.
///
#[doc = include_str!("microcontrollers.md")]
pub mod microcontrollers {}

/// Units that fit together, speeds and angles.
///
#[doc = include_str!("units.md")]
pub mod units {}

/// Proofs that a motion has no jump, no gap and no dead point, and enclosures of its extremes.
///
#[doc = include_str!("certificates.md")]
pub mod certificates {}

/// Mistakes while compiling, and results that do not exist.
///
#[doc = include_str!("errors.md")]
pub mod errors {}

/// Times of positions, motions, effects and the macro itself, each printed by a bench of the repository.
///
#[doc = include_str!("speed.md")]
pub mod speed {}

/// Errors against arithmetic of 45 digits, and what accuracy costs.
///
#[doc = include_str!("accuracy.md")]
pub mod accuracy {}

/// Positions in which a group has no position, infinitely many, or nearly none.
///
#[doc = include_str!("stability.md")]
pub mod stability {}

/// The crates of the workspace, and their features.
///
#[doc = include_str!("crates.md")]
pub mod crates {}

/// The examples of the repository, with what they measure.
///
#[doc = include_str!("examples.md")]
pub mod examples {}
