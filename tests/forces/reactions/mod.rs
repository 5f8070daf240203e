//! The forces in the joints of scenes: against the laws of Newton and Euler for each link, in 48 digits
//! (`linkage_oracle::newton_euler`), with the links and joints of each machine written here by hand.

/// A struct of the data of the bodies, which are fields of each scene, with the acceleration of gravity; and the macro
/// `masses_of!` that reads it from a scene. The first token is `$`.
macro_rules! masses {
    ($dollar:tt; $($field:ident),+) => {
        struct Masses {
            $($field: f64),+
        }

        macro_rules! masses_of {
            ($dollar scene:expr) => {
                Masses { $($field: $dollar scene.$field),+ }
            };
        }
    };
}

mod at_rest;
mod excavator;
mod five_bar;
mod jansen;
mod laws;
mod left_out;
mod listed;
mod members;
mod redundant;
mod several_ways;
mod slider_crank;
mod whitworth;

use std::cell::RefCell;

use linkage::Mechanism;
use linkage_oracle::close;
use rand::rngs::SmallRng;
use rand::{Rng, SeedableRng};

/// Forces agree to this, relative to the largest force in the machine; moments relative to it times a length of it. The
/// largest difference found is 1.4e-14.
const TOLERANCE: f64 = 1e-13;

/// The states of each machine.
const STATES: usize = 24;

/// The states of each machine in tests without 48 digits.
const OFTEN: usize = 400;

/// The force of a joint by its name: found and expected.
type Compared = (&'static str, [f64; 2], [f64; 2]);

/// The names and the values of fields.
macro_rules! pins {
    ($found:ident; $($field:ident),+) => {
        [$((stringify!($field), <[f64; 2]>::from($found.$field))),+]
    };
}
use pins;

/// The normal force of a guide, and its moment divided by a length.
fn guide([normal, moment]: [f64; 2], length: f64) -> [f64; 2] {
    [normal, moment / length]
}

/// Asserts that all forces agree.
fn compare(state: &str, forces: &[Compared]) {
    let all = forces.iter().flat_map(|(_, _, expected)| expected);
    let scale = all.fold(0.0_f64, |scale, force| scale.max(force.abs()));
    for (name, found, expected) in forces {
        for (&found, &expected) in found.iter().zip(expected) {
            close(format_args!("{state}, {name}"), found, expected, TOLERANCE * scale);
        }
    }
}

/// Random numbers from a seed.
struct Random(RefCell<SmallRng>);

impl Random {
    fn new(seed: u64) -> Self {
        Self(RefCell::new(SmallRng::seed_from_u64(seed)))
    }

    /// A number of either sign.
    fn either(&self, size: f64) -> f64 {
        self.0.borrow_mut().random_range(-size..size)
    }

    /// A factor of a parameter.
    fn factor(&self) -> f64 {
        self.0.borrow_mut().random_range(0.8..1.25)
    }
}

/// True if |det J| is at least a hundredth of the product of the norms of its columns.
fn is_regular<M: Mechanism<Scalar = f64>>(m: &M, pose: &M::Pose) -> bool {
    let columns = m.jacobian_unknowns(pose);
    let product: f64 = columns.columns().iter().map(|column| column.norm()).product();
    m.determinant(pose).abs() > 0.01 * product
}
