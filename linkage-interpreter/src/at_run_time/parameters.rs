//! The values of parameters with which a mechanism at run time is computed.

use std::fmt::Debug;

/// Values of parameters.
pub trait Parameters: Copy + Debug {
    /// Those that stand for the values of the design, in declared order; none if they are the same.
    fn instead(&self) -> Option<&[f64]>;
}

/// The values of a [`Design`](crate::Design).
#[derive(Debug, Clone, Copy)]
pub struct OfDesign;

impl Parameters for OfDesign {
    fn instead(&self) -> Option<&[f64]> {
        None
    }
}
