//! Modes and circuits at the input at which the motion begins.

use std::f64::consts::TAU;

use linkage_runtime::circuits::{CircuitError, CircuitOptions, Circuits, CurveEnd, CurveEvent, MotionCurve};
use linkage_runtime::derivation::Derivation;
use linkage_runtime::{BorrowedName, Branches, D, Kinematic, Mechanism, PositionError};

use super::local::Local;
use super::transmission;

/// The modes of a mechanism at an input, and how they are connected.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Modes {
    /// The inputs at which the modes are listed.
    pub inputs: Vec<f64>,
    /// The modes: the positions at these inputs in the declared ranges, at most [`MOST_MODES`].
    pub modes: Vec<ListedMode>,
    /// The motions through the modes, at most 16; none with several inputs.
    pub motions: Vec<ListedMotion>,
    /// The motions of each circuit, by index: those that can be reached from each other without taking the mechanism apart.
    pub circuits: Vec<Vec<usize>>,
    /// The mode from which the motion of the report is followed, by index.
    pub followed: Option<usize>,
    /// The number of further modes, which are not listed; the largest that is possible, if they are not counted.
    pub left_out: usize,
    /// Why the motion of a mode is not followed, if one cannot be.
    pub not_followed: Option<String>,
}

/// A position at the inputs of the list.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct ListedMode {
    /// Its branch, as Rust writes it.
    pub branch: String,
    /// The unknowns, in the order of their names.
    pub unknowns: Vec<f64>,
    /// Its motion, by index; none if it is not followed.
    pub motion: Option<usize>,
    /// The transmission angle of each dyad, with the unknowns of the dyad, in a report of a motion or of data.
    pub transmission: Vec<(String, f64)>,
}

/// A motion through modes, with dead points passed.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct ListedMotion {
    /// The least and the largest input.
    pub range: [f64; 2],
    /// Its end.
    pub end: CurveEnd,
    /// The turns of the input until it closes without a dead point; 0 if there is none.
    pub full_turns: i32,
    /// The dead points, where the input reverses.
    pub dead_points: Vec<SingularInput>,
    /// The change points, where motions cross.
    pub change_points: Vec<SingularInput>,
}

/// The input of a singular position.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct SingularInput {
    /// The input.
    pub input: f64,
    /// The unknowns of the groups that are singular.
    pub groups: Vec<String>,
}

/// The most modes that a report lists, and the most motions through them that it follows: a chain of n dyads has 2^n.
pub const MOST_MODES: usize = 64;
const MOST_MOTIONS: usize = 16;

/// The positions of a mechanism in the ranges that it declares, and whether there are more than are listed.
type Listing<M> = (Vec<(<M as Mechanism>::Branch, <M as Mechanism>::Coordinates)>, usize);

impl Modes {
    /// The modes and circuits at the input of a position.
    ///
    /// # Errors
    /// [`CircuitError::Position`].
    pub(super) fn of<M>(
        mechanism: &M,
        derivation: &Derivation<'_>,
        start: &M::Coordinates,
        options: CircuitOptions,
    ) -> Result<Self, CircuitError<M::Name>>
    where
        M: Kinematic<Scalar = f64, V = D<1>> + Branches,
    {
        let (listed, left_out) = listing(mechanism, start)?;
        let (circuits, motions, error) = Circuits::of_some(mechanism, &listed, MOST_MOTIONS, options);
        let followed = nearest(mechanism, listed.iter().map(|(_, position)| *position), start);
        let modes = listed.iter().zip(motions).map(|((branch, position), motion)| {
            let local = Local::of(mechanism, derivation, position);
            ListedMode {
                branch: format!("{branch:?}"),
                unknowns: local.rounded(M::unknowns(position).as_slice()),
                motion,
                transmission: transmission::at(&local),
            }
        });
        let modes = modes.collect();
        let motions = circuits.motions.iter().map(curve).collect();
        Ok(Self {
            inputs: vec![M::inputs(start)[0]],
            modes,
            motions,
            circuits: circuits.circuits,
            followed,
            left_out,
            not_followed: error.map(|error| match error {
                CircuitError::Path { mode, error } => {
                    format!("that of mode {} is not followed, since {error}", mode + 1)
                }
                other => other.to_string(),
            }),
        })
    }

    /// The modes at the inputs of a position, without circuits.
    ///
    /// # Errors
    /// Those of [`Branches::all_positions`].
    pub(super) fn at<M>(mechanism: &M, start: &M::Coordinates) -> Result<Self, CircuitError<M::Name>>
    where
        M: Branches<Scalar = f64>,
    {
        let (all, left_out) = listing(mechanism, start)?;
        let followed = nearest(mechanism, all.iter().map(|(_, position)| *position), start);
        let modes = all.iter().map(|(branch, position)| ListedMode {
            branch: format!("{branch:?}"),
            unknowns: M::unknowns(position).as_slice().to_vec(),
            motion: None,
            transmission: Vec::new(),
        });
        let inputs = M::inputs(start).as_slice().to_vec();
        Ok(Self { modes: modes.collect(), followed, left_out, ..Self::only(inputs, Vec::new()) })
    }

    /// Modes at these inputs, without motions.
    #[must_use]
    pub fn only(inputs: Vec<f64>, modes: Vec<ListedMode>) -> Self {
        Self {
            inputs,
            modes,
            motions: Vec::new(),
            circuits: Vec::new(),
            followed: None,
            left_out: 0,
            not_followed: None,
        }
    }

    /// The circuit of the mode from which the motion is followed, by index.
    #[must_use]
    pub fn followed_circuit(&self) -> Option<usize> {
        let motion = self.modes.get(self.followed?)?.motion?;
        self.circuits.iter().position(|circuit| circuit.contains(&motion))
    }
}

fn curve<Q: Copy, N: BorrowedName>(motion: &MotionCurve<Q, f64, N>) -> ListedMotion {
    let singular = |input: f64, event: Option<CurveEvent<N>>| {
        let group = match event {
            Some(CurveEvent::DeadPoint { group } | CurveEvent::ChangePoint { group }) => vec![group.to_string()],
            _ => Vec::new(),
        };
        SingularInput { input, groups: group }
    };
    ListedMotion {
        range: motion.range().unwrap_or_default(),
        end: motion.end,
        full_turns: motion.full_turns(),
        dead_points: motion.dead_points().map(|at| singular(at.point.input, at.point.event)).collect(),
        change_points: motion.change_points().map(|at| singular(at.point.input, at.point.event)).collect(),
    }
}

/// The first positions at the inputs of another, and how many more there are.
fn listing<M: Branches<Scalar = f64>>(
    mechanism: &M,
    start: &M::Coordinates,
) -> Result<Listing<M>, CircuitError<M::Name>> {
    let (mut listed, mut more) = (Vec::new(), 0);
    for (branch, position) in mechanism.all_positions(M::inputs(start).into())? {
        if !mechanism.is_within_ranges(&position).map_err(PositionError::from)? {
            continue;
        }
        match listed.len() < MOST_MODES {
            true => listed.push((branch, position)),
            false => more += 1,
        }
    }
    Ok((listed, more))
}

/// The position nearest to another, by index, whole turns of angles aside.
fn nearest<M: Mechanism<Scalar = f64>>(
    mechanism: &M,
    positions: impl Iterator<Item = M::Coordinates>,
    to: &M::Coordinates,
) -> Option<usize> {
    let distance = |position: M::Coordinates| {
        let off = M::unknowns(&position) - M::unknowns(to);
        let pairs = off.iter().zip(mechanism.unknown_angles());
        pairs.fold(0.0_f64, |most, (&off, &is_angle)| {
            let off = if is_angle { off - TAU * (off / TAU).round() } else { off };
            most.max(off.abs())
        })
    };
    let distances = positions.map(distance).enumerate();
    distances.min_by(|(_, one), (_, other)| one.total_cmp(other)).map(|(place, _)| place)
}
