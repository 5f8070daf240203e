//! Random motions over change points, with forces, stops and events, against the same motions in coordinates that have
//! no change point: rotors and sliders as open chains, simulated at 1e-13, and a crossed parallelogram by its ratio.
//!
//! The error at the end may be at most a thousand times the change of the reference when its start is moved by the
//! tolerance; at most five motions of a thousand may end in a typed error.
//!
//! ```text
//! STARTS=10000 cargo test --release --all-features --test friction over_change_points -- --nocapture
//! ```

mod comparison;
mod crossed;
mod driven;
mod parallel;
mod slider;
mod tray;
