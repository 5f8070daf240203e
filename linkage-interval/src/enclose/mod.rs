//! Velocities, accelerations and sensitivities over boxes: for every position, every rate and all parameters in intervals.
//!
//! [`PoseBox`] is a box of unknowns, inputs and parameters in which J is proved regular. Its functions have the names of
//! those that are emitted for a pose, and return intervals that contain the exact results at every point of the box:
//!
//! | function | encloses |
//! |---|---|
//! | [`velocity_ratios`](PoseBox::velocity_ratios) | W = -J^-1 A |
//! | [`velocity`](PoseBox::velocity) | u' = W v' |
//! | [`acceleration`](PoseBox::acceleration) | `u''` from `J u'' = -(A v'' + gamma)` |
//! | [`sensitivity`](PoseBox::sensitivity) | du/dp = -J^-1 Psi_p |
//!
//! A box across a dead point is an error that says which group may be singular, and how far the proof is from success
//! ([`EncloseError::NotRegular`]). The positions of the box need not close the loops: like the emitted functions these take
//! any. [`Certificate::pose_box`](crate::certify::Certificate::pose_box) has the box about a certified motion.
//!
//! # Method
//!
//! All derivatives of Psi come from Psi itself, by [`Series`](crate::certify::Series): the results depend on the formulas
//! of Psi and on IEEE arithmetic, not on the emitted J, A and gamma. With Y an inverse of the middle of J in floats, J is
//! regular at every point if the norm of I - Y J is below 1 over the box; then J x = c has the solutions x = x0 + e,
//! |e| <= |Y (c - J x0)| / (1 - |I - Y J|), which two steps of e = Y (c - J x0) + (I - Y J) e make narrower. Each result is
//! intersected with its mean-value form x(m) + sum of dx/dz(box) (z - m) in all intervals z, where m is the middle: the
//! excess of its width over the range shrinks with the square of the box.
//!
//! Sources: S. M. Rump, "Verification methods: rigorous results using floating-point arithmetic", Acta Numerica 19 (2010),
//! section 10; A. Neumaier, "Interval Methods for Systems of Equations", 1990, sections 2.3 and 4.1.

mod error;
mod linear;
mod mean_value;
mod pose_box;

pub use error::{EncloseError, EncloseErrorOf};
pub(crate) use linear::Sizes;
pub use pose_box::{IntervalColumns, PoseBox};
