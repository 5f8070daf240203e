//! Open chains: mechanisms without a loop. The equations of motion against Lagrange's equations of energies that are
//! written by hand; simulations, drives, stops, frictions, equilibria; and the algorithms for all mechanisms, which meet
//! no unknowns here.

mod energies;
mod lagrange;
mod motion;
mod position;
