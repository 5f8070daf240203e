//! The decision procedure for equality: random identities, a table of trigonometry, what it must
//! not answer, and what the compiler relies on.

mod formula;
mod mechanisms;
mod outside;
mod random;
mod table;
