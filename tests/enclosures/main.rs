//! Formulas, velocities and motions over intervals.

mod certificates;
mod certified_ranges;
mod intervals;
