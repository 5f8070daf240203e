//! Agreement with the literature: textbooks, benchmarks, and the known properties of classic mechanisms.

mod classic_numbers;
mod gallery;
mod literature;
mod maple_sheet;
mod n_four_bar;
mod slider_crank;
