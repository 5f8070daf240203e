//! Sweeps: all positions of many designs, on all cores.
//!
//! You want to know which of a million designs assemble over a whole turn, how large a force becomes at most, or the
//! ten best lengths. You describe the rows by a [`Plan`], make a [`Sweep`] of it with a design, and then
//!
//! - [`reduce`](Sweep::reduce) it to counts, [extremes](Extremes), [histograms](Histogram), the [best cases](Best) and
//!   [Pareto fronts](Front);
//! - [write](Sweep::write_csv) it as CSV;
//! - take [all chunks](Sweep::for_each_chunk) in order;
//! - or compute [single chunks](Sweep::chunk), on this machine or on others.
//!
//! A chunk is a pure function of design, plan and chunk number. Thus no result depends on the number of threads, and
//! that of a [reducer](Reducer) does not depend on the rows per chunk either: it has the same bits.
//!
//! A row is accepted if its position, its rates and its accelerations exist; it does not depend on the columns asked for. A
//! point or an output that does not exist in an accepted row is missing in its own column, and nowhere else.
//!
//! Rows are positions on one branch, each for itself; where that branch jumps to another motion,
//! [`off_motion`](Sweep::off_motion) says which rows of a case are not on the first one.
//!
//! A sweep needs a mechanism with `derive lanes;`, which implements [`Lanes`](linkage_runtime::lanes::Lanes).
//!
//! ```
//! use std::ops::ControlFlow;
//!
//! use linkage::linkage;
//! use linkage_sweep::{Best, Case, Distribution, Extremes, Plan, Rejected, Sequence, Sweep, found, given};
//!
//! linkage! {
//!     /// Slider-crank with an offset.
//!     pub mechanism SliderCrank {
//!         param crank = 1, rod = 3, offset = 0.25;
//!         input theta;
//!         unknown phi, s;
//!
//!         loop crank@theta + rod@phi = (s, offset);
//!
//!         derive lanes;
//!     }
//! }
//!
//! // A thousand designs, each over a turn of the crank in steps of 5 degrees.
//! let columns = [
//!     ("rod", Distribution::Uniform { from: 1.0, to: 3.0 }),
//!     ("offset", Distribution::Normal { mean: 0.25, deviation: 0.1 }),
//! ];
//! let plan = Plan::new().sample(columns, 1000, Sequence::QuasiRandom).turn("theta", 72).constant("theta_rate", 10.0);
//! let branch = SliderCrankBranch::all().next().expect("two branches");
//! // The last factor, the turn, is one case.
//! let sweep = Sweep::new(&SliderCrank::default(), branch, plan)?.with_case(1)?;
//!
//! // The designs whose slider has the lowest top speed relative to the rod; none of those that do not turn fully.
//! let score = |case: &Case<'_, f64, 2>| {
//!     let [speed, rod] = case.columns;
//!     let top = speed.iter().fold(0.0, |top: f64, speed| top.max(speed.abs()));
//!     case.accepted.iter().all(|accepted| *accepted).then(|| -top / rod[0])
//! };
//! let reducers = (Rejected, Extremes::of(found("s")), Best::new(10, [found("s_rate"), given("rod")], score));
//! // A callback that returns `ControlFlow::Break(())` cancels the sweep.
//! let (rejections, range, best) = sweep.reduce(&reducers, |progress| {
//!     assert!(progress.rows_done <= progress.rows);
//!     ControlFlow::Continue(())
//! })?;
//!
//! assert!(rejections.total() > 0 && rejections.total() < sweep.rows());
//! for kind in &rejections.kinds {
//!     println!("{}: {} rows, the first is {}", kind.kind, kind.count, kind.first_row);
//! }
//! println!("the slider moves from {:?} to {:?}", range.least, range.most);
//! for design in &best {
//!     println!("{:.3}: {:?}", -design.score, sweep.row(design.first_row)?);
//! }
//! assert_eq!(best.len(), 10);
//! # Ok::<(), linkage_sweep::SweepError>(())
//! ```
//!
//! Memory is bounded by the rows of a chunk, the threads and the columns asked for, not by the rows of the sweep.

#![warn(missing_docs)]

mod bind;
mod block;
mod chunk;
mod column;
mod count;
mod deliver;
mod error;
mod file;
mod motion;
mod names;
mod plan;
mod progress;
mod random;
mod reduce;
mod source;
mod sweep;
mod threads;
mod write;

pub use block::{Block, Case};
pub use chunk::Chunk;
pub use column::{Column, Key, Place, found, given};
pub use error::SweepError;
// For other formats of files.
#[doc(hidden)]
pub use file::{remove_unfinished, write_whole};
pub use motion::OffMotion;
#[doc(hidden)]
pub use names::names;
pub use plan::{Distribution, Factor, Plan, Sequence};
pub use progress::Progress;
pub use reduce::{
    Best, Bins, Bounds, Extreme, Extremes, Front, Histogram, Kind, Ranked, Reducer, Rejected, RejectedKind, Rejections,
    Unbeaten,
};
pub use sweep::Sweep;
