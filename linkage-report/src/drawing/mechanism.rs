//! Drawings from the mechanism itself: its joints and parts are known, see [`Skeleton`].

use std::f64::consts::TAU;

use linkage_runtime::skeleton::{Part as Known, Skeleton};
use linkage_runtime::{Assembly, Column, PositionError};
use nalgebra::{Point2, Vector2};

use super::animation::Part;
use super::{Animation, Drawing, DrawingError};

/// The frames of a turn, and the seconds that it takes.
const FRAMES: u32 = 120;
const SECONDS: f64 = 4.0;

/// The length of an arm beyond its farthest block.
const BEYOND: f64 = 1.1;

/// The names and positions of the joints.
fn joints<M: Skeleton<Scalar = f64>>(mechanism: &M, pose: &M::Pose) -> Vec<(&'static str, Point2<f64>)> {
    let parts = mechanism.joints(pose);
    let places = parts.as_slice().chunks_exact(2).map(|at| Point2::new(at[0], at[1]));
    M::JOINTS.iter().copied().zip(places).collect()
}

fn name<M: Skeleton>(joint: usize) -> &'static str {
    M::JOINTS.get(joint).copied().unwrap_or_default()
}

impl Drawing {
    /// Draws a mechanism with `derive drawing;` at a pose: its joints, links, pivots and points. More can be added.
    pub fn of<M: Skeleton<Scalar = f64>>(mechanism: &M, pose: &M::Pose) -> Self {
        let mut drawing = Self::new(M::NAME);
        let is_part = |joint: usize, kind: fn(usize) -> Known| M::PARTS.contains(&kind(joint));
        for (place, (name, at)) in joints(mechanism, pose).into_iter().enumerate() {
            if is_part(place, Known::Ground) {
                drawing.ground(name, at);
            } else if is_part(place, Known::Trace) {
                drawing.point(name, at);
            } else {
                drawing.joint(name, at);
            }
        }
        for part in M::PARTS {
            match *part {
                Known::Bar { joints, .. } => {
                    let ends = joints.iter().zip(joints.iter().cycle().skip(1)).take(joints.len().max(2) - 1);
                    for (&from, &to) in ends.chain((joints.len() > 2).then(|| (&joints[joints.len() - 1], &joints[0])))
                    {
                        drawing.bar(name::<M>(from), name::<M>(to));
                    }
                }
                Known::Sleeve { pin, on, .. } => _ = drawing.bar(name::<M>(on), name::<M>(pin)),
                _ => {}
            }
        }
        drawing
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
        let mut animation = Self::new(M::NAME, seconds);
        let mut frames: Vec<Vec<(String, Point2<f64>)>> = (poses.into_iter())
            .map(|pose| joints(mechanism, pose).into_iter().map(|(name, at)| (name.to_owned(), at)).collect())
            .collect();
        for part in M::PARTS {
            match *part {
                Known::Ground(joint) => _ = animation.ground(name::<M>(joint)),
                Known::Slider(joint) => _ = animation.slider(name::<M>(joint)),
                Known::Trace(joint) => _ = animation.trace(name::<M>(joint)),
                Known::Bar { joints, is_driven } => {
                    let names: Vec<&str> = joints.iter().map(|&joint| name::<M>(joint)).collect();
                    _ = if is_driven { animation.crank(&names) } else { animation.link(&names) };
                }
                Known::Sleeve { pin, on, towards } => {
                    let [pin, on] = [pin, on].map(|joint| name::<M>(joint));
                    match towards {
                        Some(end) => _ = animation.sleeve(pin, [on, name::<M>(end)]),
                        None => _ = animation.arm(&mut frames, pin, on),
                    }
                }
                _ => {}
            }
        }
        for frame in frames {
            animation.frame(frame);
        }
        animation
    }

    /// Adds the arm of a sleeve, whose end is no joint: a little longer than the farthest distance of its block.
    fn arm(&mut self, frames: &mut [Vec<(String, Point2<f64>)>], pin: &str, on: &str) -> &mut Self {
        let tip = format!("{on}-{pin}");
        let at = |frame: &[(String, Point2<f64>)], name: &str| {
            frame.iter().find(|(other, _)| other == name).map_or_else(Point2::origin, |(_, at)| *at)
        };
        let along = |frame: &[(String, Point2<f64>)]| at(frame, pin) - at(frame, on);
        let length = BEYOND * frames.iter().map(|frame| along(frame).norm()).fold(0.0, f64::max);
        for frame in frames {
            let direction: Vector2<f64> = along(frame).try_normalize(0.0).unwrap_or_default();
            frame.push((tip.clone(), at(frame, on) + length * direction));
        }
        self.link(&[on, &tip]).sleeve(pin, [on, &tip])
    }

    /// Animates a turn of the input of a mechanism with `derive drawing;`, or the longest stretch of a turn in which it
    /// can be assembled, forth and back.
    ///
    /// # Errors
    /// [`DrawingError::NoPosition`] if the mechanism has several inputs, or no position in 120 steps of a turn.
    pub fn turn<M>(mechanism: &M, branch: M::Branch) -> Result<Self, DrawingError>
    where
        M: Skeleton<Scalar = f64> + Assembly,
    {
        let angle = |step: u32| TAU * f64::from(step) / f64::from(FRAMES);
        let exists = |step: u32| assemble(mechanism, angle(step % FRAMES), branch).is_ok();
        let Some(stop) = (0..FRAMES).find(|&step| !exists(step)) else {
            return Self::over(mechanism, branch, (0..=FRAMES).map(angle));
        };
        // The longest run of steps with a position; runs may pass the zero of the angle.
        let (mut longest, mut run) = ((0, 0), (stop, 0));
        for step in stop..=stop + FRAMES {
            run = if exists(step) { (run.0, run.1 + 1) } else { (step + 1, 0) };
            if run.1 > longest.1 {
                longest = run;
            }
        }
        let (first, count) = longest;
        if count == 0 {
            let error = assemble(mechanism, angle(stop), branch).err();
            return Err(no_position::<M>(error));
        }
        let ends = [(first, -1.0), (first + count - 1, 1.0)].map(|(step, side)| {
            let mut inside = angle(step);
            let mut outside = inside + side * angle(1);
            for _ in 0..f64::MANTISSA_DIGITS {
                let middle = f64::midpoint(inside, outside);
                *(if assemble(mechanism, middle, branch).is_ok() { &mut inside } else { &mut outside }) = middle;
            }
            inside
        });
        Self::between(mechanism, branch, ends)
    }

    /// Animates a mechanism with `derive drawing;` from one value of its input to another and back.
    ///
    /// # Errors
    /// [`DrawingError::NoPosition`] if the mechanism has several inputs, or no position at one between these.
    pub fn between<M>(mechanism: &M, branch: M::Branch, [from, to]: [f64; 2]) -> Result<Self, DrawingError>
    where
        M: Skeleton<Scalar = f64> + Assembly,
    {
        let middle = f64::midpoint(from, to);
        // Exactly `from` and `to` at the ends: the sum below may differ from them in the last digit.
        let input = move |step: u32| match step % FRAMES {
            0 => from,
            half if 2 * half == FRAMES => to,
            step => middle - (to - middle) * (TAU * f64::from(step) / f64::from(FRAMES)).cos(),
        };
        Self::over(mechanism, branch, (0..=FRAMES).map(input))
    }

    fn over<M>(mechanism: &M, branch: M::Branch, inputs: impl Iterator<Item = f64>) -> Result<Self, DrawingError>
    where
        M: Skeleton<Scalar = f64> + Assembly,
    {
        let poses: Result<Vec<M::Pose>, DrawingError> = inputs
            .map(|input| assemble(mechanism, input, branch).map_err(|error| no_position::<M>(Some(error))))
            .collect();
        match M::INPUTS.len() {
            1 => Ok(Self::of(mechanism, &poses?, SECONDS)),
            _ => Err(no_position::<M>(None)),
        }
    }

    /// Removes the parts that connect exactly these points: to draw another one there.
    pub fn without(&mut self, points: &[&str]) -> &mut Self {
        let connects = |part: &Part| {
            let of_part = part.points();
            of_part.len() == points.len() && points.iter().all(|point| of_part.iter().any(|other| other == point))
        };
        self.parts.retain(|part| !connects(part));
        self
    }
}

fn assemble<M: Assembly<Scalar = f64>>(mechanism: &M, input: f64, branch: M::Branch) -> Result<M::Pose, PositionError> {
    mechanism.assemble(Column::repeat(input).into(), branch)
}

fn no_position<M: Assembly>(error: Option<PositionError>) -> DrawingError {
    let several = || format!("{} has {} inputs: give its poses to `Animation::of`", M::NAME, M::INPUTS.len());
    DrawingError::NoPosition(error.map_or_else(several, |error| error.to_string()))
}
