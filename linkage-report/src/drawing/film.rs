//! The points of all frames in pixels, and the motion of bodies.

use std::f64::consts::{PI, TAU};

use nalgebra::{Rotation2, Vector2};

use super::DrawingError;
use super::figure::Figure;
use super::frame::View;
use super::part::Part;

/// Tolerance in pixels: a point that moves less is at rest, and a link whose points deviate less from a rigid motion is
/// rigid.
const UNSEEN: f64 = 0.02;

/// Tolerance of a direction: on a line as long as a picture its end moves unseen.
const UNSEEN_TURN: f64 = UNSEEN / 500.0;

fn finite(vector: &Vector2<f64>) -> bool {
    vector.iter().all(|value| value.is_finite())
}

/// The points of all frames in pixels.
pub(super) struct Film {
    names: Vec<String>,
    /// One row for each frame.
    frames: Vec<Vec<Vector2<f64>>>,
    pub view: View,
}

impl Film {
    /// The film of a figure in the view that `fit` chooses for the points that must be in the picture.
    pub(super) fn of(
        figure: &Figure,
        fit: impl Fn(&[Vector2<f64>]) -> View,
    ) -> Result<(Self, Vec<Vector2<f64>>), DrawingError> {
        if let Some(mistake) = &figure.mistake {
            return Err(mistake.clone());
        }
        let first = figure.frames.first().ok_or(DrawingError::Empty)?;
        let names: Vec<String> = first.iter().map(|(name, _)| name.clone()).collect();
        for (index, name) in names.iter().enumerate() {
            if names[..index].contains(name) {
                return Err(DrawingError::DuplicatePoint(name.clone()));
            }
        }
        let mut frames: Vec<Vec<Vector2<f64>>> = Vec::with_capacity(figure.frames.len());
        for (index, frame) in figure.frames.iter().enumerate() {
            if !frame.iter().map(|(name, _)| name).eq(&names) {
                return Err(DrawingError::OtherPoints(index));
            }
            if let Some((name, _)) = frame.iter().find(|(_, at)| !finite(at)) {
                return Err(DrawingError::NotFinite(format!("the point `{name}`")));
            }
            frames.push(frame.iter().map(|(_, at)| *at).collect());
        }
        let shown = shown(&figure.parts, &names, &frames)?;
        if shown.is_empty() {
            return Err(DrawingError::Empty);
        }
        let view = fit(&shown);
        if !(view.pixels_per_unit.is_normal() && finite(&view.centre)) {
            return Err(DrawingError::NotFinite("the extent of the drawing".to_owned()));
        }
        let frames = frames.iter().map(|frame| frame.iter().map(|at| view.pixel(*at)).collect()).collect();
        Ok((Self { names, frames, view }, shown))
    }

    pub(super) fn index(&self, name: &str) -> Result<usize, DrawingError> {
        place(&self.names, name)
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

    /// The straight line on which a point moves; an error if it leaves the line, or if it rests and no direction is given.
    pub(super) fn guide(&self, point: usize, along: Option<Vector2<f64>>) -> Result<Guide, DrawingError> {
        let track = self.track(point);
        let farthest = |from: Vector2<f64>| {
            let distance = |at: &Vector2<f64>| (at - from).norm_squared();
            track.iter().copied().max_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap_or(from)
        };
        let one = farthest(track[0]);
        let other = farthest(one);
        let stroke = other - one;
        // On the screen y points down.
        let given = along.map(|along| Vector2::new(along.x, -along.y)).filter(|_| stroke.amax() < UNSEEN);
        let along = given.unwrap_or(stroke).try_normalize(0.0);
        let off = |along: &Vector2<f64>| track.iter().any(|at| along.perp(&(at - one)).abs() > UNSEEN);
        let along = along.filter(|along| (given.is_some() || stroke.amax() >= UNSEEN) && !off(along));
        let along = along.ok_or_else(|| DrawingError::NotStraight(self.names[point].clone()))?;
        // Order: from left to right, or upwards.
        let is_ordered = along.x > UNSEEN_TURN || (along.x > -UNSEEN_TURN && along.y < 0.0);
        let along = if is_ordered { along } else { -along };
        let ends = if along.dot(&stroke) < 0.0 { [other, one] } else { [one, other] };
        Ok(Guide { ends, along })
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

fn place(names: &[String], name: &str) -> Result<usize, DrawingError> {
    let found = names.iter().position(|other| other == name);
    found.ok_or_else(|| DrawingError::UnknownPoint(name.to_owned()))
}

/// The points that must be in the picture, in the lengths of the mechanism.
fn shown(parts: &[Part], names: &[String], frames: &[Vec<Vector2<f64>>]) -> Result<Vec<Vector2<f64>>, DrawingError> {
    let track = |name: &String| place(names, name).map(|point| frames.iter().map(move |frame| frame[point]));
    let mut shown: Vec<Vector2<f64>> = Vec::new();
    for part in parts {
        for name in part.points() {
            shown.extend(track(name)?);
        }
        let (centre, reach) = match part {
            Part::Wheel { centre, radius, .. } => (centre, *radius),
            Part::Plate { centre, outline, .. } => {
                (centre, outline.iter().map(Vector2::norm).max_by(f64::total_cmp).unwrap_or_default())
            }
            Part::GroundLine(line) | Part::Path(line) | Part::Room(line) => {
                let what = if matches!(part, Part::GroundLine(_)) { "a line of the ground" } else { "a path" };
                if !line.iter().all(finite) {
                    return Err(DrawingError::NotFinite(what.to_owned()));
                }
                shown.extend(line);
                continue;
            }
            _ => continue,
        };
        if !(reach.is_finite() && reach > 0.0) {
            return Err(DrawingError::NotFinite(format!("the radius of the part about `{centre}`")));
        }
        let corners = [-reach, reach].map(Vector2::repeat);
        shown.extend(track(centre)?.flat_map(|at| corners.map(|corner| at + corner)));
    }
    Ok(shown)
}

/// The line on which a block slides: the ends of its stroke, and its direction.
pub(super) struct Guide {
    pub ends: [Vector2<f64>; 2],
    pub along: Vector2<f64>,
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
