//! The mathematics of a mechanism Psi(q) = 0: Jacobians, determinants, velocity ratios, the quadratic velocity term,
//! closed-form positions, and the equations of motion.
//!
//! Rates and accelerations of the coordinates are symbols that are never replaced by their formulas, since substitution
//! makes expressions swell.

mod angles;
mod assembly;
mod check;
mod closed_form;
mod contacts;
mod data;
mod derive;
mod distances;
mod equilibrium;
mod formulas;
mod gaps;
mod iteration;
mod jacobian;
mod jerk;
mod joints;
mod kinks;
mod limits;
mod linear;
mod motion;
mod multipliers;
mod plane;
mod position;
mod position_formulas;
mod ratio_derivatives;
mod ratios;
mod reach;
mod reactions;
mod scale;
mod scene;
mod sensitivity;
mod sheet;
mod skeleton;
mod solution;
mod step;
mod systems;
mod unreduced;

pub use assembly::{Assembly, Chord};
pub use check::{LARGEST, check, check_numbers, matrices};
pub use data::{Coordinate, Derivation, Determinant, Group, Implied, Quantity, RatioDerivatives, Sensitivity};
pub use derive::derive;
pub use formulas::{Formulas, Inverse, QuantityFormulas};
pub use joints::{Joint, Joints};
pub use limits::Bound;
pub use linear::{Form, Row, Solutions, System, solve_closed};
pub use position_formulas::ClosedForm;
pub use reach::{Length, Missing, Reach};
pub use scene::{BearingRow, Contact, ContactFormula, Equilibrium, Kink, Multipliers, Prescribed, Reactions, Scene};
pub use sheet::{DriverChoice, PolarVector, Sheet, Turning};
pub use skeleton::{Part, Skeleton};
pub use step::{ChordGeometry, Step, merged, needed, needed_names};
