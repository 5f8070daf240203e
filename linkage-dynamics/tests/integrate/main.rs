//! Integrations against exact solutions, published figures and the counts of the published codes.

mod accuracy;
mod events;
mod failure;
mod order;
mod shallow;
mod systems;
mod tableau;

use linkage_dynamics::integrate::Tolerance;
use linkage_runtime::Error;
use linkage_runtime::nalgebra::SVector;

type State<const N: usize> = SVector<f64, N>;
type Rate<const N: usize> = Result<State<N>, Error>;

/// `relative` (1 + |y|).
fn tolerance<const N: usize>(relative: f64) -> Tolerance<f64, N> {
    Tolerance::new(relative, [1.0; N]).unwrap()
}
