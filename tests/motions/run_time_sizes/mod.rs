//! Certificates of mechanisms whose numbers of coordinates and names are known at run time: the texts of those of emitted code.
//! Algorithms without formulas are compared on the interpreter's own mechanisms.

mod certificates;
mod compared;
mod wrapped;
