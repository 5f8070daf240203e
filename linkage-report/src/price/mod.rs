//! What accuracy costs: errors against numbers of 31 digits and times, of one mechanism over a range of its input, and of
//! one scene by tolerance.
//!
//! A [`MotionPrice`] compares the methods of [`accuracy`](linkage_runtime::accuracy) along one motion; a [`ScenePrice`]
//! simulates one scene by several tolerances. Both are data; as text they are tables, as HTML pages with charts.
//!
//! ```
//! linkage::linkage! {
//!     /// A crank that drives a slotted lever.
//!     #[derive(Clone)]
//!     pub mechanism SlottedLever {
//!         param crank = 50, offset = 120;
//!         input theta;
//!         unknown psi, s;
//!         loop crank@theta = (0, -offset) + s@psi;
//!     }
//! }
//! use linkage::DoubleDouble;
//! use linkage::price::{InOtherScalars, MotionPrice, PriceOptions};
//! use linkage::range_of_motion::{RangeOfMotion, RangeOptions};
//!
//! let m = SlottedLever::default();
//! let start = SlottedLeverCoordinates { theta: 0.0, psi: 1.2, s: 130.0 };
//! let range = RangeOfMotion::of(&m, &m.solve(&start)?.coordinates, RangeOptions::default())?;
//! let others = InOtherScalars { single: m.clone().map(|x| x as f32), double_double: m.clone().map(DoubleDouble::from) };
//! # let options = PriceOptions { samples: 12, rounds: 1, span: 0.0, ..PriceOptions::default() };
//! # let _ = stringify!(
//! let options = PriceOptions::default();
//! # );
//! let price = MotionPrice::of(&range, SlottedLever::DERIVATION, &others, &options)?;
//! // The position, by the closed form in `f64`.
//! let errors = &price.method("f64").unwrap().quantities[0].errors;
//! assert!(errors.iter().all(|error| error.is_ok_and(|error| error < 1e-15)));
//! println!("{price}");
//! # Ok::<(), linkage::Error>(())
//! ```
//!
//! # Times
//!
//! All methods are timed in turn, round after round, and each time is the median of the rounds: a disturbance of the machine
//! meets all of them. [`Time::quartiles`] is the noise: where it is wide, the machine did other work. [`Time::ratio`] is the
//! median of the ratios within rounds, which noise disturbs less than the times: compare methods by it, and times of two
//! runs of a program not at all. Without optimisation all times are long, and not in proportion.

mod effects;
mod error;
mod frontier;
mod methods;
mod motion;
mod page;
mod prediction;
mod reference;
mod scene;
mod text;
mod timing;

pub use effects::EffectPrice;
pub use error::PriceError;
pub use frontier::{Cost, SAME_ERROR, cheapest, frontier};
pub use motion::{Family, Gap, InOtherScalars, MethodPrice, MotionPrice, PriceOptions, QUANTITIES, QuantityPrice};
pub use page::style;
pub use prediction::{Counts, Machine};
pub use scene::{
    Order, PartPrice, RunOutcome, RunPrice, ScenePrice, ScenePriceOptions, StartOf, WithoutPrice,
};
pub use timing::Time;
