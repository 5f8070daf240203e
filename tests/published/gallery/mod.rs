//! The gallery of classic mechanisms, each followed through its whole motion and compared with its known properties:
//! rigid links, straight lines, strokes, ratios and sweeps.

mod cams;
mod complete;
mod course;
mod exactness;
mod five_bars;
mod four_bars;
mod groups;
mod legs;
mod parallelograms;
mod pistons;
mod six_bars;
mod slotted;
mod straight_lines;
