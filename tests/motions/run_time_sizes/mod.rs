//! Pictures and reports of mechanisms whose numbers of coordinates and names are known at run time: the texts of those of emitted
//! code. Algorithms without pictures are compared on the interpreter's own mechanisms.

mod compared;
mod pictures;
mod wrapped;
