//! Formulas, velocities and motions over intervals.

mod certificates;
mod intervals;
