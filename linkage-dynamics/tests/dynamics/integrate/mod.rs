//! Compares integrations with exact solutions, published values and the step counts of published codes.

mod accuracy;
mod events;
mod failure;
mod order;
mod shallow;
mod stiffness;
mod systems;
mod tableau;

use linkage_dynamics::MotionError;
use linkage_dynamics::integrate::Tolerance;
use linkage_runtime::nalgebra::SVector;
use linkage_runtime::{Column, D};

type State<const N: usize> = SVector<f64, N>;
type Rate<const N: usize> = Result<State<N>, MotionError>;
/// A state column.
type Entries<const N: usize> = Column<f64, D<N>>;

/// `relative` (1 + |y|).
fn tolerance<const N: usize>(relative: f64) -> Tolerance<f64, D<N>> {
    Tolerance::new(relative, [1.0; N]).unwrap()
}
