#![doc = include_str!("../README.md")]
#![cfg_attr(not(feature = "std"), no_std)]
// docs.rs says which feature an item needs.
#![cfg_attr(docsrs, feature(doc_cfg))]
#![warn(missing_docs)]

#[cfg(not(any(feature = "std", feature = "libm")))]
compile_error!("enable the feature `std` of `linkage`, or `libm` where there is no standard library");

#[cfg(any(feature = "std", feature = "libm"))]
mod error;
#[cfg(all(any(doc, doctest), feature = "std", feature = "dynamics", feature = "drawing", feature = "sheet"))]
pub mod manual;

#[cfg(any(feature = "std", feature = "libm"))]
pub use error::Error;
#[cfg(all(feature = "double-double", any(feature = "std", feature = "libm")))]
pub use linkage_double::DoubleDouble;
#[cfg(all(feature = "dynamics", any(feature = "std", feature = "libm")))]
pub use linkage_dynamics::{
    Accelerations, Balance, Bearing, Contact, ContactCoordinate, ContactLaw, Coordinates, Energy, Equations, Inputs,
    Kink, Mode, MotionError, MotionErrorOf, NameOf, Power, Prescribed, Rates, ReactionRow, Scene, StateColumn,
    StateParts, StateRates, Unreduced, contact, simulation,
};
#[cfg(feature = "interval")]
pub use linkage_interval::{Interval, certify, enclose};
#[cfg(feature = "drawing")]
pub use linkage_report::drawing;
#[cfg(all(feature = "sheet", feature = "double-double"))]
pub use linkage_report::price;
#[cfg(feature = "sheet")]
pub use linkage_report::{Document, FpCore, Notation, Table, chart, report, sheet, table};
/// A four-bar near a dead point, where coupler and rocker are parallel to within 1e-6 rad: the velocity at stored angles
/// keeps its digits, but not if the angles themselves are measured, to 1e-9 rad.
///
/// ```
/// use linkage::Rounded;
///
/// linkage::linkage! {
///     #[derive(Clone)]
///     mechanism FourBar {
///         param l1 = 80, l2 = 20, l3 = 50, l4 = 70;
///         input theta2;
///         unknown theta3, theta4;
///         loop l2@theta2 + l3@theta3 + l4@theta4 = l1@0;
///     }
/// }
/// let four_bar = FourBar::default().map(Rounded::from);
/// let ulps = |[theta2, theta3, theta4]: [Rounded; 3]| {
///     let pose = four_bar.pose_at(&FourBarCoordinates { theta2, theta3, theta4 });
///     let velocity = four_bar.velocity(&pose, Rounded::from(1.0))?;
///     println!("theta3' = {}, within {:.1} ulp", velocity.theta3, velocity.theta3.ulps());
///     Ok::<f64, linkage::Error>(velocity.theta3.ulps())
/// };
/// let angles = [1.0, -0.4, -0.4 + 1e-6];
/// // theta3' = 394179.82401894196 ± 2.5e-10, within 4.3 ulp
/// assert!(ulps(angles.map(Rounded::from))? < 4.4);
/// // theta3' = 394179.82401894196 ± 7.9e2, within 13571069105146.1 ulp
/// assert!(ulps(angles.map(|angle| Rounded::with_error(angle, 1e-9)))? > 1e13);
/// # Ok::<(), linkage::Error>(())
/// ```
#[cfg(all(feature = "rounding", any(feature = "std", feature = "libm")))]
pub use linkage_rounding::Rounded;
#[cfg(any(feature = "std", feature = "libm"))]
pub use linkage_runtime::{
    AnyBranch, Assembled, Assembly, AssemblyMode, BorrowedName, Bounded, Branches, Build, Certifiable, Column, D, Dim,
    Elbow, Formulas, Group, InputError, InputValues, Joint, JointForces, Kinematic, Limits, Matrix, Mechanism, Name,
    Named, Number, OutputMotion, PathError, PerInput, PerUnknown, PointMotion, PositionError, RangeEnd, Ranged, Real,
    Slider, Slope, Solution, UpTo, accuracy, analysis, continuation, derivation, extremes, held, kinematic, lanes,
    limits, nalgebra, position, real, singularity, skeleton,
};
#[cfg(feature = "std")]
pub use linkage_runtime::{circuits, range_of_motion};

/// An example without a `scene`, a crank and slider: the rate function solves for the position, with the last
/// position as the guess. With a `scene` the macro emits the equations of motion.
///
/// ```
/// use linkage::integrate::{Tolerance, dop853};
/// use linkage::nalgebra::{SVector, vector};
///
/// linkage::linkage! {
///     /// Crank and slider, in metres.
///     mechanism SliderCrank {
///         param r = 0.1, l = 0.3;
///         input phi;
///         unknown beta, s;
///         loop r@phi + l@beta = s@0;
///         point Piston = s@0;
///     }
/// }
/// let slider_crank = SliderCrank::default();
/// let (inertia, mass) = (0.01, 0.5); // of the crank, kg m^2; of the piston, kg
///
/// let mut q = slider_crank.solve(&SliderCrankCoordinates { phi: 1.0, beta: -0.3, s: 0.34 })?.coordinates;
/// // (I + m w^2) phi'' = -m w b, with the velocity ratio w = ds/dphi, and b = s'' without acceleration of the crank.
/// let rate = |_t: f64, y: &SVector<f64, 2>| {
///     q.phi = y[0];
///     q = slider_crank.solve(&q)?.coordinates;
///     let ratio = slider_crank.motion(&q, 1.0, 0.0)?.points.piston.velocity.x;
///     let bias = slider_crank.motion(&q, y[1], 0.0)?.points.piston.acceleration.x;
///     Ok(vector![y[1], -mass * ratio * bias / (inertia + mass * ratio * ratio)])
/// };
/// let start = (0.0, vector![1.0, 20.0]); // s; rad, rad/s
/// let mut motion = dop853(rate, start, 1.0, Tolerance::new(1e-10, [1.0, 20.0])?)?;
/// motion.finish(|_, _| true)?;
/// assert!(motion.state()[0] > 10.0);
/// # Ok::<(), linkage::Error>(())
/// ```
#[cfg(all(feature = "dynamics", any(feature = "std", feature = "libm")))]
pub use linkage_dynamics::integrate;

#[doc = include_str!("manual/language.md")]
#[macro_export]
macro_rules! linkage {
    ($($mechanisms:tt)*) => {
        // The path of the crate is an argument, so that the crate may be renamed or re-exported.
        $crate::__private::linkage! { $crate $($mechanisms)* }
    };
}

/// The macro behind [`linkage!`]; not part of the interface.
#[doc(hidden)]
#[cfg(any(feature = "std", feature = "libm"))]
pub mod __private {
    pub use linkage_macros::linkage;
}

/// The names used by emitted code; not part of the interface.
#[doc(hidden)]
#[cfg(any(feature = "std", feature = "libm"))]
pub mod __rt {
    #[cfg(feature = "dynamics")]
    pub use linkage_dynamics::__rt::*;
    pub use linkage_runtime::__rt::*;
}
