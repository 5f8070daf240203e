//! The decision procedure: what it proves, what it refutes, and what it leaves open.

mod mechanisms;
mod outside;
mod random;
mod sheet;
mod table;
