//! A report of a mechanism: its mobility, its modes and circuits, and one motion from end to end.
//!
//! A report is data, in radians and in the unit of the lengths. As text it reads as prose, with angles in degrees; as HTML
//! it is a page that stands alone.
//!
//! ```
//! linkage::linkage! {
//!     /// A crank-rocker.
//!     pub mechanism FourBar {
//!         param ground = 80, crank = 20, coupler = 50, rocker = 70;
//!         input theta;
//!         unknown phi, psi;
//!         loop crank@theta + coupler@phi = ground@0 + rocker@psi;
//!         output swing = psi;
//!     }
//! }
//! use linkage::report::{GrashofClass, Report, ReportOptions};
//!
//! let (m, branch) = (FourBar::default(), FourBarBranch::new(linkage::Elbow::Left));
//! let report = Report::on_branch(&m, FourBar::DERIVATION, branch, [1.0], &ReportOptions::default())?;
//! let motion = report.motion.as_ref().unwrap();
//! assert_eq!(motion.four_bars[0].class, GrashofClass::CrankRocker);
//! let worst = motion.transmission[0].least;
//! assert!((worst.value.to_degrees() - 57.12).abs() < 0.01);
//! println!("{report}");
//! # Ok::<(), linkage::Error>(())
//! ```

mod dwells;
mod dyad;
mod four_bar;
mod local;
mod mobility;
mod modes;
mod motion;
mod options;
mod output_angles;
mod page;
pub(crate) mod prose;
mod strokes;
mod transmission;

use linkage_runtime::circuits::CircuitError;
use linkage_runtime::derivation::{Derivation, Symbol};
use linkage_runtime::range_of_motion::RangeOfMotion;
use linkage_runtime::{Assembly, BorrowedName, Branches, D, Kinematic, Mechanism, PathError};

pub use dwells::Dwell;
use dyad::Dyad;
pub use dyad::DyadKind;
pub use four_bar::{FourBarLoop, GrashofClass};
pub use local::Local;
pub use mobility::{LinksAndJoints, Mobility};
pub use modes::{ListedMode, ListedMotion, MOST_MODES, Modes, SingularInput};
pub use motion::{MotionReport, NearMissInput, QuantityReport};
pub use options::{DwellOptions, ReportOptions};
pub use strokes::Stroke;
pub use transmission::{NoTransmission, Transmission};

/// A report of a mechanism.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Report<N: BorrowedName = &'static str> {
    /// The mechanism, or the driver of one.
    pub mechanism: String,
    /// The inputs.
    pub inputs: Vec<ReportedCoordinate>,
    /// The unknowns.
    pub unknowns: Vec<ReportedCoordinate>,
    /// The links, joints and degrees of freedom.
    pub mobility: Mobility,
    /// The modes and circuits at the input of the start.
    pub modes: ReportedModes<N>,
    /// The loops of four turning joints, of a report of data; those of a motion are with it.
    pub four_bars: Vec<FourBarLoop>,
    /// One motion from end to end; none for a mechanism with several inputs, which has as many motions as paths of its
    /// inputs.
    pub motion: Option<MotionReport<N>>,
    /// The reason why the report follows no motion, where one is known; of a report with one, why it follows none from the
    /// modes before.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub no_motion: Option<String>,
}

/// A coordinate by name.
#[derive(Debug, Clone, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct ReportedCoordinate {
    /// The name in the `linkage!` language.
    pub name: String,
    /// True for an angle.
    pub is_angle: bool,
}

/// The modes of a report, or the reason why it has none.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub enum ReportedModes<N: BorrowedName = &'static str> {
    /// The modes.
    Listed(Modes),
    /// The positions at the start, or the motions through them, cannot be computed.
    Failed(CircuitError<N>),
    /// The mechanism does not implement [`Branches`], or the report was made without.
    NotListed,
    /// There are none, for this reason.
    Missing(String),
}

impl Report {
    /// The report of a mechanism that is known as data, as one that is compiled at run time, without a motion: its mobility, and
    /// modes that are known. With the numbers at each mode it has the classes of four-bar loops and transmission angles.
    pub fn of_data(
        derivation: &Derivation<'_>,
        is_angle: impl Fn(&str) -> bool,
        mut modes: ReportedModes,
        at_modes: &[Local<'_, '_>],
    ) -> Self {
        if let ReportedModes::Listed(modes) = &mut modes {
            for (mode, local) in modes.modes.iter_mut().zip(at_modes) {
                mode.transmission = transmission::at(local);
                mode.unknowns = local.rounded(&mode.unknowns);
            }
        }
        let of_loop = |local: &Local<'_, '_>| {
            Dyad::all(local).iter().filter_map(|(_, dyad)| four_bar::of_dyad(local, dyad)).collect()
        };
        let four_bars = at_modes.first().map(of_loop).unwrap_or_default();
        let named = |symbols: &[Symbol<'_>]| {
            let of = |symbol: &Symbol<'_>| ReportedCoordinate {
                name: symbol.name.to_owned(),
                is_angle: is_angle(symbol.name),
            };
            symbols.iter().map(of).collect()
        };
        Self {
            mechanism: derivation.mechanism.to_owned(),
            inputs: named(derivation.inputs),
            unknowns: named(derivation.unknowns),
            mobility: Mobility::of(derivation),
            modes,
            four_bars,
            motion: None,
            no_motion: None,
        }
    }
}

impl<N: BorrowedName> Report<N> {
    /// The report of a mechanism with one input, of the motion through a position near `start`. `derivation` is the
    /// constant `DERIVATION` of the mechanism.
    ///
    /// # Errors
    /// The reason why the motion cannot be followed from there, as from a dead point.
    pub fn of<M>(
        mechanism: &M,
        derivation: &Derivation<'_>,
        start: &M::Coordinates,
        options: &ReportOptions,
    ) -> Result<Self, PathError<N>>
    where
        M: Kinematic<Scalar = f64, Name = N, V = D<1>> + Branches,
    {
        Self::in_words(mechanism, derivation, start, options, &ToString::to_string)
    }

    /// The report of the motion through a position, which says in these words why it has no motion where a quantity along it
    /// cannot be computed.
    ///
    /// # Errors
    /// Those of [`of`](Self::of).
    pub fn in_words<M>(
        mechanism: &M,
        derivation: &Derivation<'_>,
        start: &M::Coordinates,
        options: &ReportOptions,
        words: &dyn Fn(&PathError<N>) -> String,
    ) -> Result<Self, PathError<N>>
    where
        M: Kinematic<Scalar = f64, Name = N, V = D<1>> + Branches,
    {
        let range = RangeOfMotion::of(mechanism, start, options.range)?;
        Ok(Self::with_modes(&range, derivation, start, options, words))
    }

    /// The report of the motion that these inputs are about: the first that has a position on the branch chooses it.
    ///
    /// # Errors
    /// If there is none, why the first has none; see [`RangeOfMotion::on_branch`].
    pub fn on_branch<M>(
        mechanism: &M,
        derivation: &Derivation<'_>,
        branch: M::Branch,
        inputs: impl IntoIterator<Item = f64>,
        options: &ReportOptions,
    ) -> Result<Self, PathError<N>>
    where
        M: Kinematic<Scalar = f64, Name = N, V = D<1>> + Branches + Assembly,
    {
        let inputs: Vec<f64> = inputs.into_iter().collect();
        let range = RangeOfMotion::on_branch(mechanism, branch, inputs.iter().copied(), options.range)?;
        let mut first = Err(PathError::NoDirection { mechanism: mechanism.name() });
        for input in inputs {
            let report = |start| Self::with_modes(&range, derivation, &start, options, &ToString::to_string);
            match range.at(input).map(report) {
                // Circuits are not followed from a dead point or a change point.
                Ok(report) if !matches!(report.modes, ReportedModes::Failed(_)) => return Ok(report),
                found => first = first.or(found),
            }
        }
        first
    }

    /// The report of a motion that is known, without modes: for mechanisms whose positions cannot be listed.
    ///
    /// # Errors
    /// The reason why a position or a velocity along the motion cannot be computed.
    pub fn of_motion<M>(
        range: &RangeOfMotion<'_, M>,
        derivation: &Derivation<'_>,
        options: &ReportOptions,
    ) -> Result<Self, PathError<N>>
    where
        M: Kinematic<Scalar = f64, Name = N, V = D<1>>,
    {
        let [first, last] = range.inputs();
        let report = Self::without_motion(range.mechanism(), derivation, ReportedModes::NotListed);
        let motion = MotionReport::of(range, derivation, inside(first, last), options)?;
        Ok(Self { motion: Some(motion), ..report })
    }

    /// The report of a mechanism with any number of inputs, without a motion: its mobility, and its modes at the inputs of
    /// a position.
    pub fn at<M>(mechanism: &M, derivation: &Derivation<'_>, start: &M::Coordinates) -> Self
    where
        M: Branches<Scalar = f64, Name = N>,
    {
        let modes = Modes::at(mechanism, start).map_or_else(ReportedModes::Failed, ReportedModes::Listed);
        Self::without_motion(mechanism, derivation, modes)
    }

    /// The report of a mechanism with one input, with its modes and circuits at the input of a position, without a motion.
    pub fn of_circuits<M>(
        mechanism: &M,
        derivation: &Derivation<'_>,
        start: &M::Coordinates,
        options: &ReportOptions,
    ) -> Self
    where
        M: Kinematic<Scalar = f64, Name = N, V = D<1>> + Branches,
    {
        let modes = Modes::of(mechanism, derivation, start, options.circuits);
        let modes = modes.map_or_else(ReportedModes::Failed, ReportedModes::Listed);
        Self::without_motion(mechanism, derivation, modes)
    }

    fn with_modes<M>(
        range: &RangeOfMotion<'_, M>,
        derivation: &Derivation<'_>,
        start: &M::Coordinates,
        options: &ReportOptions,
        words: &dyn Fn(&PathError<N>) -> String,
    ) -> Self
    where
        M: Kinematic<Scalar = f64, Name = N, V = D<1>> + Branches,
    {
        let report = Self::of_circuits(range.mechanism(), derivation, start, options);
        // Its modes and circuits are known where a quantity along the motion is not.
        match MotionReport::of(range, derivation, M::inputs(start)[0], options) {
            Ok(motion) => Self { motion: Some(motion), ..report },
            Err(error) => Self { no_motion: Some(words(&error)), ..report },
        }
    }

    fn without_motion<M>(mechanism: &M, derivation: &Derivation<'_>, modes: ReportedModes<N>) -> Self
    where
        M: Mechanism<Name = N>,
    {
        let named = |(name, is_angle): (N, &bool)| ReportedCoordinate { name: name.to_string(), is_angle: *is_angle };
        let inputs = (0..).map(|place| mechanism.input_name(place)).zip(mechanism.input_angles());
        let unknowns = (0..).map(|place| mechanism.unknown_name(place)).zip(mechanism.unknown_angles());
        Self {
            mechanism: mechanism.name().to_string(),
            inputs: inputs.map(named).collect(),
            unknowns: unknowns.map(named).collect(),
            mobility: Mobility::of(derivation),
            modes,
            four_bars: Vec::new(),
            motion: None,
            no_motion: None,
        }
    }
}

/// A regular input between two: not in the middle, where symmetric mechanisms are singular.
fn inside(first: f64, last: f64) -> f64 {
    first + (last - first) * 0.382
}
