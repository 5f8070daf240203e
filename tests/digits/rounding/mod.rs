//! Emitted functions in `Rounded`: the values are those of `f64`, bit for bit, and each exact result is within its bound.
//!
//! The exact results are those of the functions themselves in `DoubleDouble`, of 31 digits, at poses that are given and
//! at poses that are assembled. `forty_digits/bounds.rs` compares with the constraints solved in 48 digits.
//!
//! ```text
//! POSES=1000 cargo test --release --all-features --test digits rounding -- --nocapture    this many poses of each mechanism
//! MECHANISM=four_bar cargo test --all-features --test digits rounding                     one mechanism, by its file or its name
//! ```

mod dead_points;
mod every_function;
mod figures;
mod in_line;
mod limits;
mod newton;
mod results;
mod user_functions;

/// Poses of each mechanism.
fn poses(usual: usize) -> usize {
    linkage_trials::count("POSES", usual, usual)
}
