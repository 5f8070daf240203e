//! Drawings from the mechanism itself: its joints and parts are known, see [`Skeleton`].

use std::f64::consts::TAU;

use linkage_runtime::continuation::Options;
use linkage_runtime::range_of_motion::{Driven, MotionByLength, MotionEnd, RangeOfMotion, RangeOptions};
use linkage_runtime::skeleton::Skeleton;
use linkage_runtime::{Assembly, Mechanism, Name, PathError, PathErrorOf};

use super::figure::Figure;
use super::parts::Parts;
use super::{Animation, Drawing, DrawingError};

/// The frames of a turn, and the seconds that it takes.
const FRAMES: u32 = 120;
const SECONDS: f64 = 4.0;

impl Figure {
    /// The joints of a mechanism at these poses, and its parts.
    fn of<'a, M: Skeleton<Scalar = f64>>(mechanism: &M, poses: impl IntoIterator<Item = &'a M::Pose>) -> Self
    where
        M::Pose: 'a,
    {
        if let Err(mistake) = check(mechanism) {
            return Self { frames: vec![Vec::new()], mistake: Some(mistake), ..Self::default() };
        }
        let mut poses = poses.into_iter().peekable();
        let guides: Vec<[f64; 2]> =
            poses.peek().iter().flat_map(|pose| (0..).map_while(|guide| mechanism.guide(pose, guide))).collect();
        let names: Vec<String> = mechanism.joint_names().map(|name| name.to_string()).collect();
        let names: Vec<&str> = names.iter().map(String::as_str).collect();
        let parts = Parts { joints: &names, parts: mechanism.drawn_parts(), guides: &guides };
        let places = |pose| mechanism.joints(pose).as_slice().chunks_exact(2).map(|at| [at[0], at[1]]).collect();
        Self::at(&parts, poses.map(places).collect::<Vec<Vec<[f64; 2]>>>())
    }
}

impl Drawing {
    /// Draws a mechanism with `derive drawing;` at a pose: its joints, links, pivots and points. More can be added.
    pub fn of<M: Skeleton<Scalar = f64>>(mechanism: &M, pose: &M::Pose) -> Self {
        Self { figure: Figure::of(mechanism, [pose]), ..Self::new(mechanism.name().to_string()) }
    }
}

impl Animation {
    /// Animates a mechanism with `derive drawing;` through poses, which take this number of seconds.
    pub fn of<'a, M: Skeleton<Scalar = f64>>(
        mechanism: &M,
        poses: impl IntoIterator<Item = &'a M::Pose>,
        seconds: f64,
    ) -> Self
    where
        M::Pose: 'a,
    {
        Self { figure: Figure::of(mechanism, poses), ..Self::new(mechanism.name().to_string(), seconds) }
    }

    /// Animates a turn of the input of a mechanism with `derive drawing;`: one motion that begins on this branch and passes
    /// change points smoothly. If it ends, the longest such motion forth and back.
    ///
    /// # Errors
    /// [`DrawingError::NoPosition`] if no motion can be followed from 120 steps of a turn.
    pub fn turn<M>(mechanism: &M, branch: M::Branch) -> Result<Self, DrawingError>
    where
        M: Driven<Scalar = f64, Of: Skeleton + Assembly>,
    {
        let mut longest: Option<RangeOfMotion<'_, M>> = None;
        let mut reached: Vec<[f64; 2]> = Vec::new();
        let mut last = PathError::NoDirection { mechanism: mechanism.name() };
        for step in 0..FRAMES {
            let input = TAU * f64::from(step) / f64::from(FRAMES);
            if reached.iter().any(|[least, most]| (least..=most).contains(&&input)) {
                continue;
            }
            match RangeOfMotion::on_branch(mechanism, branch, [input], RangeOptions::through_change_points()) {
                Ok(range) if range.is_closed() => return Self::over(&range),
                Ok(range) => {
                    let [least, most] = range.inputs();
                    reached.extend([[least, most], [least + TAU, most + TAU]]);
                    let length = |[least, most]: [f64; 2]| most - least;
                    if longest.as_ref().is_none_or(|other| length(other.inputs()) < most - least) {
                        longest = Some(range);
                    }
                }
                Err(error) => last = error,
            }
        }
        longest.map_or_else(|| Err(no_position(&last)), |range| Self::over(&range))
    }

    /// Animates one motion of a mechanism with `derive drawing;`: all of its turns if it closes, else forth and back
    /// between its ends.
    ///
    /// # Errors
    /// [`DrawingError::NoPosition`] if a position of the motion is not found.
    pub fn over<M>(range: &RangeOfMotion<'_, M>) -> Result<Self, DrawingError>
    where
        M: Driven<Scalar = f64, Of: Skeleton>,
    {
        let [from, to] = range.inputs();
        match range.ends()[1] {
            MotionEnd::Closed { turns } => {
                let frames = FRAMES.saturating_mul(turns.max(1));
                let input = |step: u32| from + (to - from) * f64::from(step) / f64::from(frames);
                Self::at_inputs(range, (0..=frames).map(input), SECONDS * f64::from(turns.max(1)))
            }
            _ => Self::forth_and_back(range, [from, to]),
        }
    }

    /// Animates a whole motion of a mechanism with `derive drawing;`, through its dead points, at a constant rate of the arc
    /// length: all of a closed motion, else forth and back between its ends.
    ///
    /// # Errors
    /// [`DrawingError::NoPosition`] if a position of the motion is not found.
    pub fn along<M>(motion: &MotionByLength<'_, M>) -> Result<Self, DrawingError>
    where
        M: Driven<Scalar = f64, Of: Skeleton>,
    {
        let length = motion.length();
        // A turn takes as long as one of `turn`: a frame has no more than its share of the arc length.
        let rounds = (length / TAU).ceil().clamp(1.0, f64::from(u16::MAX)) as u32;
        let frames = FRAMES * rounds;
        let share = |step: u32| f64::from(step) / f64::from(frames);
        let poses = (0..=frames).map(|step| {
            let part = if motion.is_closed() { share(step) } else { 1.0 - (2.0 * share(step) - 1.0).abs() };
            motion.at(length * part).map(|q| motion.driven().pose_at(&q))
        });
        let poses: Result<Vec<<M::Of as Mechanism>::Pose>, PathErrorOf<M>> = poses.collect();
        Ok(Self::of(motion.driven(), &poses.map_err(|error| no_position(&error))?, SECONDS * f64::from(rounds)))
    }

    /// Animates a mechanism with `derive drawing;` from one value of its input to another and back: the motion that has this
    /// branch halfway between them. It passes change points smoothly.
    ///
    /// # Errors
    /// [`DrawingError::NoPosition`] if the motion ends before one of these, or if they are equal.
    pub fn between<M>(mechanism: &M, branch: M::Branch, [from, to]: [f64; 2]) -> Result<Self, DrawingError>
    where
        M: Driven<Scalar = f64, Of: Skeleton + Assembly>,
    {
        let of = RangeOptions::through_change_points();
        let path = Options { range: Some([from.min(to), from.max(to)]), ..of.path };
        let starts = [f64::midpoint(from, to), from, to];
        let range = RangeOfMotion::on_branch(mechanism, branch, starts, RangeOptions { path, ..of });
        Self::forth_and_back(&range.map_err(|error| no_position(&error))?, [from, to])
    }

    fn forth_and_back<M>(range: &RangeOfMotion<'_, M>, [from, to]: [f64; 2]) -> Result<Self, DrawingError>
    where
        M: Driven<Scalar = f64, Of: Skeleton>,
    {
        let middle = f64::midpoint(from, to);
        // Exactly `from` and `to` at the ends: the sum below may differ from them in the last digit.
        let input = move |step: u32| match step % FRAMES {
            0 => from,
            half if 2 * half == FRAMES => to,
            step => middle - (to - middle) * (TAU * f64::from(step) / f64::from(FRAMES)).cos(),
        };
        Self::at_inputs(range, (0..=FRAMES).map(input), SECONDS)
    }

    fn at_inputs<M>(
        range: &RangeOfMotion<'_, M>,
        inputs: impl Iterator<Item = f64>,
        seconds: f64,
    ) -> Result<Self, DrawingError>
    where
        M: Driven<Scalar = f64, Of: Skeleton>,
    {
        let pose = |input: f64| range.at(input).map(|q| range.driven().pose_at(&q));
        let poses: Result<Vec<<M::Of as Mechanism>::Pose>, PathErrorOf<M>> = inputs.map(pose).collect();
        Ok(Self::of(range.driven(), &poses.map_err(|error| no_position(&error))?, seconds))
    }
}

/// Checks that a mechanism has a drawing.
pub(super) fn check<M: Skeleton>(mechanism: &M) -> Result<(), DrawingError> {
    let no_drawing = |why| DrawingError::NoDrawing { mechanism: mechanism.name().to_string(), why };
    mechanism.check_drawing().map_err(no_drawing)
}

fn no_position<N: Name>(error: &PathError<N>) -> DrawingError {
    DrawingError::NoPosition(error.to_string())
}
