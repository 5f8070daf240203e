//! Circuits: the positions of a mechanism with one input that are connected by motion.
//!
//! An *assembly mode* is a position at a given input; a *circuit* is all positions that can be reached from one of them
//! without taking the linkage apart, dead points passed (T. R. Chase and J. A. Mirth, "Circuits and branches of
//! single-degree-of-freedom planar linkages", 1993). The positions near a regular one form a curve, so that a circuit is
//! found by following each mode with [`Path`](crate::continuation::Path): the motion closes when it is at its start
//! again, after several turns perhaps and through other modes. Two motions that cross at a change point are in one
//! circuit.
//!
//! Positions outside of the ranges that the mechanism declares are no modes, and a motion ends where it meets the end of one.
//!
//! A motion that passes none of the start inputs is not found, nor one that crosses a found motion at a change point and
//! passes none of them: [`Circuits::over`] takes several start inputs.
//!
//! ```
//! linkage::linkage! {
//!     pub mechanism FourBar {
//!         param ground = 4, crank = 3, coupler = 2, rocker = 2.5;
//!         input theta;
//!         unknown phi, psi;
//!         loop crank@theta + coupler@phi = ground@0 + rocker@psi;
//!     }
//! }
//! use linkage::circuits::Circuits;
//!
//! // No link of this four-bar can turn fully: its two modes are one circuit, and meet at both dead points of the crank.
//! let circuits = Circuits::of(&FourBar::default(), 0.5, Default::default())?;
//! assert_eq!((circuits.modes.len(), circuits.circuits.len(), circuits.full_turns()), (2, 1, 0));
//! let dead_points: Vec<_> = circuits.motions[0].dead_points().collect();
//! assert_eq!(dead_points.len(), 2);
//! // crank^2 + ground^2 - 2 crank ground cos theta = (coupler + rocker)^2
//! let limit = ((9.0 + 16.0 - 4.5_f64.powi(2)) / 24.0).acos();
//! assert!((dead_points[0].point.input - limit).abs() < 1e-14);
//! assert_eq!(dead_points[0].modes, [Some(0), Some(1)]);
//! # Ok::<(), linkage::Error>(())
//! ```

mod error;
mod follow;
mod join;
mod modes;
mod motion;
mod options;

use std::vec;
use std::vec::Vec;

pub use error::CircuitError;
pub use motion::{CurveEnd, CurveEvent, CurveMeeting, CurvePoint, MotionCurve};
pub use options::CircuitOptions;

use crate::{BorrowedName, Branches, D, Mechanism, Real};
use follow::Follower;
use modes::Modes;

/// A position at a start input, from the list of [`Branches`].
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct CircuitMode<Q, B> {
    /// Its branch: a name at this input only.
    pub branch: B,
    /// The position.
    pub position: Q,
    /// Its motion, by index.
    pub motion: usize,
}

/// The assembly modes at the start inputs, the motions through them, and the circuits that these form.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Circuits<Q, B, T = f64, N = &'static str> {
    /// The modes in the order of the start inputs, at each in the order of the list.
    pub modes: Vec<CircuitMode<Q, B>>,
    /// The motions, in the order of their first modes.
    pub motions: Vec<MotionCurve<Q, T, N>>,
    /// The motions of each circuit, by index. Several motions are one circuit if they cross at change points.
    pub circuits: Vec<Vec<usize>>,
}

/// Motions, that of each mode by index, and why the first mode that cannot be followed is not.
type Motions<M> = (
    Vec<MotionCurve<<M as Mechanism>::Coordinates, <M as Mechanism>::Scalar, <M as Mechanism>::Name>>,
    Vec<Option<usize>>,
    Option<CircuitError<<M as Mechanism>::Name>>,
);

/// The motions through modes, at most so many; modes that cannot be followed are passed over, or end the search.
fn followed<M>(follower: &Follower<'_, M>, modes: usize, most: usize, passes_over: bool) -> Motions<M>
where
    M: Branches<V = D<1>>,
{
    let (mut motions, mut motion_of, mut first) = (Vec::new(), vec![None; modes], None);
    for mode in 0..modes {
        if motion_of[mode].is_some() {
            continue;
        }
        if motions.len() == most {
            break;
        }
        match follower.motion(mode) {
            Ok(motion) => {
                for passed in motion.modes() {
                    motion_of[passed] = Some(motions.len());
                }
                motions.push(motion);
            }
            Err(error) => {
                first.get_or_insert(error);
                if !passes_over {
                    break;
                }
            }
        }
    }
    (motions, motion_of, first)
}

impl<Q: Copy, B: Copy, T: Real, N: BorrowedName> Circuits<Q, B, T, N> {
    /// The circuits through the positions at one input. Choose an input at which no two positions meet.
    ///
    /// # Errors
    /// [`CircuitError::Position`] if the positions cannot be listed, [`CircuitError::Path`] with the mode whose motion
    /// cannot be followed, as from a dead point.
    pub fn of<M>(mechanism: &M, input: T, options: CircuitOptions<T>) -> Result<Self, CircuitError<N>>
    where
        M: Branches<Scalar = T, Name = N, V = D<1>, Coordinates = Q, Branch = B>,
    {
        Self::over(mechanism, [input], options)
    }

    /// The circuits through the positions at several inputs; a motion that passes several of them is found once. Inputs
    /// that differ by whole turns, or less than nearly zero, have the same modes, unless the mechanism is geared so that
    /// a turn changes its positions.
    ///
    /// # Errors
    /// Those of [`of`](Self::of).
    pub fn over<M>(
        mechanism: &M,
        inputs: impl IntoIterator<Item = T>,
        options: CircuitOptions<T>,
    ) -> Result<Self, CircuitError<N>>
    where
        M: Branches<Scalar = T, Name = N, V = D<1>, Coordinates = Q, Branch = B>,
    {
        let modes = Modes::list(mechanism, inputs)?;
        let follower = Follower::new(mechanism, &modes, &options);
        let (motions, motion_of, first) = followed(&follower, modes.positions.len(), usize::MAX, false);
        if let Some(error) = first {
            return Err(error);
        }
        let circuits = join::circuits(&motions, |one, other| modes.are_near(one, other));
        let numbered = modes.branches.iter().zip(&modes.positions).zip(motion_of);
        let modes = numbered
            .map(|((&branch, &position), motion)| CircuitMode { branch, position, motion: motion.unwrap_or_default() })
            .collect();
        Ok(Self { modes, motions, circuits })
    }

    /// The circuits through some of the positions at one input, such as the first of many; they are in the ranges that the
    /// mechanism declares. At most so many motions are followed. With them, the motion of each position, by index, or none if
    /// it is left out or cannot be followed, and the first reason why one cannot.
    pub fn of_some<M>(
        mechanism: &M,
        positions: &[(B, Q)],
        most_motions: usize,
        options: CircuitOptions<T>,
    ) -> (Self, Vec<Option<usize>>, Option<CircuitError<N>>)
    where
        M: Branches<Scalar = T, Name = N, V = D<1>, Coordinates = Q, Branch = B>,
    {
        let modes = Modes::of(mechanism, positions);
        let follower = Follower::new(mechanism, &modes, &options);
        let (motions, motion_of, first) = followed(&follower, positions.len(), most_motions, true);
        let circuits = join::circuits(&motions, |one, other| modes.are_near(one, other));
        let followed = positions.iter().zip(&motion_of);
        let modes = followed
            .filter_map(|(&(branch, position), motion)| Some(CircuitMode { branch, position, motion: (*motion)? }))
            .collect();
        (Self { modes, motions, circuits }, motion_of, first)
    }

    /// The number of motions on which the input turns fully: they close without a dead point.
    #[must_use]
    pub fn full_turns(&self) -> usize {
        self.motions.iter().filter(|motion| motion.turns_fully()).count()
    }

    /// One circuit alone, by index: its modes and motions have other numbers.
    #[must_use]
    pub fn only(&self, circuit: usize) -> Self {
        let motions = self.circuits.get(circuit).cloned().unwrap_or_default();
        let place = |motion: usize| motions.iter().position(|other| *other == motion);
        let kept: Vec<Option<usize>> = self.modes.iter().map(|mode| place(mode.motion)).collect();
        let number = |mode: usize| {
            let before = kept.get(..mode)?.iter().flatten().count();
            kept.get(mode).copied().flatten().map(|_| before)
        };
        let modes = self.modes.iter().zip(&kept);
        let modes = modes.filter_map(|(mode, motion)| Some(CircuitMode { motion: (*motion)?, ..*mode })).collect();
        let of_motion = |motion: &MotionCurve<Q, T, N>| {
            let mut motion = motion.clone();
            for point in &mut motion.points {
                if let Some(CurveEvent::Mode(Some(mode))) = point.event {
                    point.event = Some(CurveEvent::Mode(number(mode)));
                }
            }
            motion
        };
        let all = motions.iter().filter_map(|motion| self.motions.get(*motion)).map(of_motion).collect::<Vec<_>>();
        Self { modes, circuits: vec![(0..all.len()).collect()], motions: all }
    }

    /// The circuit of a motion, by index.
    #[must_use]
    pub fn circuit_of(&self, motion: usize) -> Option<usize> {
        self.circuits.iter().position(|motions| motions.contains(&motion))
    }
}
