//! Tables of simulations.
