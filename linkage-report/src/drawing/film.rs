//! The points of all frames in pixels, and the motion of bodies.

use std::f64::consts::{PI, TAU};

use nalgebra::{Rotation2, Vector2};

use super::DrawingError;
use super::animation::{Animation, Part};
use super::frame::bounds;

/// The size of the picture and its margin, in pixels.
pub(super) const SIZE: Vector2<f64> = Vector2::new(480.0, 360.0);
const MARGIN: f64 = 40.0;

/// Tolerance in pixels: a point that moves less is at rest, and a link whose points deviate less from a rigid motion is
/// rigid.
const UNSEEN: f64 = 0.02;

fn finite(vector: &Vector2<f64>) -> bool {
    vector.iter().all(|value| value.is_finite())
}

/// The points of all frames in pixels.
pub(super) struct Film {
    names: Vec<String>,
    /// One row for each frame.
    frames: Vec<Vec<Vector2<f64>>>,
    pub pixels_per_unit: f64,
    centre: Vector2<f64>,
}

impl Film {
    /// Scales the points so that all parts fit into the picture.
    pub(super) fn of(animation: &Animation) -> Result<Self, DrawingError> {
        let first = animation.frames.first().ok_or(DrawingError::Empty)?;
        let names: Vec<String> = first.iter().map(|(name, _)| name.clone()).collect();
        for (index, name) in names.iter().enumerate() {
            if names[..index].contains(name) {
                return Err(DrawingError::DuplicatePoint(name.clone()));
            }
        }
        let mut film = Self { names, frames: Vec::new(), pixels_per_unit: 1.0, centre: Vector2::zeros() };
        for (index, frame) in animation.frames.iter().enumerate() {
            if !frame.iter().map(|(name, _)| name).eq(&film.names) {
                return Err(DrawingError::OtherPoints(index));
            }
            if let Some((name, _)) = frame.iter().find(|(_, at)| !finite(at)) {
                return Err(DrawingError::NotFinite(format!("the point `{name}`")));
            }
            film.frames.push(frame.iter().map(|(_, at)| *at).collect());
        }
        let shown = film.shown(animation)?;
        if shown.is_empty() {
            return Err(DrawingError::Empty);
        }
        let (centre, size) = bounds(&shown);
        let room = SIZE - Vector2::repeat(2.0 * MARGIN);
        film.pixels_per_unit = (room.x / size.x).min(room.y / size.y);
        film.centre = centre;
        if !(film.pixels_per_unit.is_normal() && finite(&centre)) {
            return Err(DrawingError::NotFinite("the extent of the drawing".to_owned()));
        }
        film.frames = film.frames.iter().map(|frame| frame.iter().map(|at| film.pixel(*at)).collect()).collect();
        Ok(film)
    }

    /// The points that must be in the picture, in the lengths of the mechanism.
    fn shown(&self, animation: &Animation) -> Result<Vec<Vector2<f64>>, DrawingError> {
        let mut shown = Vec::new();
        for part in &animation.parts {
            for name in part.points() {
                shown.extend(self.track(self.index(name)?));
            }
            let (centre, reach) = match part {
                Part::Wheel { centre, radius, .. } => (centre, *radius),
                Part::Plate { centre, outline, .. } => {
                    (centre, outline.iter().map(Vector2::norm).max_by(f64::total_cmp).unwrap_or_default())
                }
                Part::GroundLine(line) => {
                    shown.extend(line);
                    continue;
                }
                _ => continue,
            };
            if !(reach.is_finite() && reach > 0.0) {
                return Err(DrawingError::NotFinite(format!("the radius of the part about `{centre}`")));
            }
            let corners = [-reach, reach].map(Vector2::repeat);
            shown.extend(self.track(self.index(centre)?).iter().flat_map(|at| corners.map(|corner| at + corner)));
        }
        if shown.iter().all(finite) {
            Ok(shown)
        } else {
            Err(DrawingError::NotFinite("a line of the ground".to_owned()))
        }
    }

    /// Converts a point to pixels from the top left corner.
    pub(super) fn pixel(&self, point: Vector2<f64>) -> Vector2<f64> {
        let offset = (point - self.centre) * self.pixels_per_unit;
        SIZE / 2.0 + Vector2::new(offset.x, -offset.y)
    }

    pub(super) fn index(&self, name: &str) -> Result<usize, DrawingError> {
        let found = self.names.iter().position(|other| other == name);
        found.ok_or_else(|| DrawingError::UnknownPoint(name.to_owned()))
    }

    pub(super) fn names(&self) -> &[String] {
        &self.names
    }

    pub(super) fn frames(&self) -> &[Vec<Vector2<f64>>] {
        &self.frames
    }

    /// All points at equal steps of time from the first frame to the last, at most this number of them; between frames they
    /// move evenly, as in the picture.
    pub(super) fn moments(&self, most: usize) -> Vec<Vec<Vector2<f64>>> {
        let last = self.frames.len() - 1;
        let steps = most.min(last).max(1);
        let moment = |step: usize| {
            let (before, part) = (last * step / steps, (last * step % steps) as f64 / steps as f64);
            let after = &self.frames[(before + 1).min(last)];
            self.frames[before].iter().zip(after).map(|(from, to)| from + (to - from) * part).collect()
        };
        (0..=steps.min(last)).map(moment).collect()
    }

    /// The positions of one point in all frames.
    pub(super) fn track(&self, index: usize) -> Vec<Vector2<f64>> {
        self.frames.iter().map(|frame| frame[index]).collect()
    }

    /// The motion of a body with its origin at a point, which turns with the direction from one point to another.
    pub(super) fn body(&self, origin: usize, [from, to]: [usize; 2]) -> Body {
        let mut angles: Vec<f64> = Vec::with_capacity(self.frames.len());
        for frame in &self.frames {
            let along = frame[to] - frame[from];
            let last = angles.last().copied().unwrap_or_default();
            // The shorter of the two rotations from the last angle; the last angle itself if the points coincide.
            let turn = (along.y.atan2(along.x) - last + PI).rem_euclid(TAU) - PI;
            angles.push(if along.amax() < UNSEEN { last } else { last + turn });
        }
        Body { places: self.track(origin), angles }
    }

    /// The motion of a link through points; an error if it is not rigid.
    pub(super) fn link(&self, points: &[usize]) -> Result<Body, DrawingError> {
        if points.is_empty() {
            return Err(DrawingError::Empty);
        }
        let at = |frame: usize, point: usize| self.frames[frame][point];
        let reach = |point: &usize| (at(0, *point) - at(0, points[0])).norm();
        let far = points.iter().copied().max_by(|a, b| reach(a).total_cmp(&reach(b))).unwrap_or(points[0]);
        let body = self.body(points[0], [points[0], far]);
        for frame in 0..self.frames.len() {
            let turn = Rotation2::new(body.angles[frame] - body.angles[0]);
            for &point in points {
                let carried = body.places[frame] + turn * (at(0, point) - body.places[0]);
                if (carried - at(frame, point)).amax() > UNSEEN {
                    let names: Vec<&str> = points.iter().map(|point| self.names[*point].as_str()).collect();
                    return Err(DrawingError::NotRigid(names.join("-")));
                }
            }
        }
        Ok(body)
    }

    /// The ends of the straight line on which a point moves; an error if it rests or leaves the line.
    pub(super) fn guide(&self, point: usize) -> Result<[Vector2<f64>; 2], DrawingError> {
        let track = self.track(point);
        let farthest = |from: Vector2<f64>| {
            let distance = |at: &Vector2<f64>| (at - from).norm_squared();
            track.iter().copied().max_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap_or(from)
        };
        let one = farthest(track[0]);
        let other = farthest(one);
        let along = other - one;
        let off = |at: &Vector2<f64>| along.perp(&(at - one)).abs() > UNSEEN * along.norm();
        if along.amax() < UNSEEN || track.iter().any(off) {
            return Err(DrawingError::NotStraight(self.names[point].clone()));
        }
        // Order: from left to right, or upwards.
        Ok(if along.x > UNSEEN || (along.x > -UNSEEN && along.y < 0.0) { [one, other] } else { [other, one] })
    }

    /// The position of a point at rest; an error if it moves.
    pub(super) fn fixed(&self, point: usize) -> Result<Vector2<f64>, DrawingError> {
        let track = self.track(point);
        if track.iter().any(|at| (at - track[0]).amax() > UNSEEN) {
            return Err(DrawingError::Moves(self.names[point].clone()));
        }
        Ok(track[0])
    }
}

/// The positions of a body's origin, and its angles on the screen, continuous from frame to frame.
pub(super) struct Body {
    pub places: Vec<Vector2<f64>>,
    pub angles: Vec<f64>,
}

impl Body {
    /// A body without rotation.
    pub(super) fn sliding(places: Vec<Vector2<f64>>) -> Self {
        Self { angles: vec![0.0; places.len()], places }
    }

    /// Its direction in the first frame.
    pub(super) fn direction(&self) -> Vector2<f64> {
        Vector2::new(self.angles[0].cos(), self.angles[0].sin())
    }
}
