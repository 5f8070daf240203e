//! The price of accuracy: errors against numbers of 31 digits and times, of one mechanism over a range of its input, and of
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
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! A scene, its error against the simulation in double-double, and what its effects cost:
//!
//! ```
//! linkage::linkage! {
//!     #[derive(Clone)]
//!     pub mechanism Wheel {
//!         param j = 0.5, k = 2;
//!         input theta;
//!         body wheel { inertia j; angle theta; }
//!         scene Sprung { inertia; spring k, 0 on theta; }
//!         scene Free { inertia; }
//!     }
//! }
//! use linkage::DoubleDouble;
//! use linkage::price::{ScenePrice, ScenePriceOptions};
//! use linkage::simulation::Start;
//!
//! let scene = Sprung::default();
//! let start = Start { t: 0.0, q: WheelCoordinates { theta: 1.0 }, input_rates: WheelInputs { theta: 0.0 } };
//! let twice = scene.clone().map(DoubleDouble::from);
//! # let options = ScenePriceOptions { tolerances: vec![1e-6], rounds: 1, span: 0.0, ..ScenePriceOptions::default() };
//! # let _ = stringify!(
//! let options = ScenePriceOptions::default();
//! # );
//! let mut price = ScenePrice::of(&scene, &twice, Sprung::<f64>::DERIVATION, start, 3.0, &options)?;
//! assert!(price.runs[0].outcome.is_ok_and(|outcome| outcome.error < 1e-4));
//! // As measured, not by formulas: the same scene without the spring.
//! price.without("the spring", (&scene, start), (&Free::default(), start))?;
//! println!("{price}");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Times
//!
//! All methods are timed in turn, round after round, and each time is the median of the rounds: a disturbance of the machine
//! meets all of them. [`Time::quartiles`] is the noise: where it is wide, the machine did other work. [`Time::ratio`] is the
//! median of the ratios within rounds, which noise disturbs less than the times: compare methods by it, and times of two
//! runs of a program not at all. Without optimisation all times are long, and not in proportion.

mod data;
mod effects;
mod error;
mod frontier;
mod methods;
mod motion;
mod motion_page;
mod motion_text;
mod page;
mod parts;
mod prediction;
mod reference;
mod runs;
mod scene;
mod scene_page;
mod scene_text;
mod text;
mod timing;

pub use data::{Family, MethodPrice, QUANTITIES, QuantityPrice};
pub use effects::EffectPrice;
pub use error::PriceError;
pub use frontier::{Cost, SAME_ERROR, cheapest, frontier};
pub use motion::{Gap, InOtherScalars, LeftOut, MotionPrice, PriceOptions};
pub use page::style;
pub use parts::PartPrice;
pub use prediction::{Counts, Machine};
pub use runs::Order;
pub use scene::{RunOutcome, RunPrice, ScenePrice, ScenePriceOptions, StartOf, WithoutPrice};
pub use timing::Time;
