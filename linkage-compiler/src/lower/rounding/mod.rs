//! Bounds of the rounding errors of emitted functions in `f64`, derived to first order in u = 2^-53.
//!
//! Operations round relatively (N. J. Higham, *Accuracy and Stability of Numerical Algorithms*, 2nd ed., section 2.2), so
//! that relative errors add in products and quotients (`tracked`). A sum spreads the errors of its terms over their
//! magnitudes (section 3.1), which `monomial` bounds; a sum that is a sine or cosine of two stored angles by the addition
//! theorem is known by that sine. Along the schedule of a kernel this is one pass (`follow`), and `bound` is the law that a
//! reader gets.
//!
//! Arguments are exact: parameters, coordinates, rates. A pose is that of `pose_at`. Unknown are the errors of Newton's
//! method, of half chords, of pivoting, and of functions without a proven bound: those of the user and of the platform.

mod angle;
mod bound;
mod count;
mod follow;
mod monomial;
mod sentence;
mod tracked;

pub use bound::Bound;

use rustc_hash::FxHashMap;

use crate::graph::SymbolId;
use crate::program::PosePlan;
use angle::Angles;
use tracked::Tracked;

/// The name of a sine or cosine among the results of `pose_at`.
pub(super) const DIRECTION: &str = "directions";

/// The angles, and the errors of the determinants of a pose, from the functions lowered before.
#[derive(Debug)]
pub struct Roundings {
    angles: Angles,
    /// Determinants and velocity ratios.
    pose: FxHashMap<SymbolId, Option<Tracked>>,
}

impl Roundings {
    /// The fields of a pose, unknown until `pose_at` is lowered.
    pub fn new(pose: &PosePlan) -> Self {
        let determinants = pose.determinants.iter().map(|(.., symbol)| *symbol);
        let unknown = determinants.chain(pose.externals.iter().map(|(.., symbol)| *symbol));
        Self { angles: Angles::default(), pose: unknown.map(|symbol| (symbol, None)).collect() }
    }

    /// True for a result of a function before, with a known error.
    pub fn knows(&self, symbol: SymbolId) -> bool {
        matches!(self.pose.get(&symbol), Some(Some(_)))
    }
}
