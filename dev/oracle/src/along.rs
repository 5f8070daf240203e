//! Points and lines of links, and the scalars of their positions, in 48 digits.

use super::jet::{Jet, Plane};
use super::precise::{Big, big};

/// The index of a link.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Link(pub(super) usize);

/// The link that does not move.
pub const GROUND: Link = Link(0);

/// A point that is fixed in a link, relative to its centre.
#[derive(Debug, Clone)]
pub struct Point {
    pub(super) link: Link,
    pub(super) local: [Big; 2],
}

/// A line that is fixed in a link.
#[derive(Debug, Clone)]
pub struct Line {
    pub(super) from: Point,
    pub(super) direction: [Big; 2],
}

/// A scalar of the positions that a joint keeps or a force acts along.
#[derive(Debug, Clone)]
pub enum Along {
    /// The angle of the first link relative to the second.
    Turn([Link; 2]),
    /// x (0) or y (1) of the first point less that of the second.
    Axis(usize, [Point; 2]),
    /// A point along a line, from its start.
    Slide(Line, Point),
    /// The distance of a point from a line, positive on its left.
    Left(Line, Point),
    Distance([Point; 2]),
}

/// Centre, angle and x axis of a link in motion.
#[derive(Debug, Clone)]
pub(super) struct Frame {
    pub(super) center: Plane,
    pub(super) angle: Jet,
    pub(super) axis: Plane,
}

impl Frame {
    pub(super) fn resting() -> Self {
        let jet = |value| Jet::constant(big(value));
        Self { center: [jet(0.0), jet(0.0)], angle: jet(0.0), axis: [jet(1.0), jet(0.0)] }
    }

    /// The frame at rest.
    pub(super) fn still(&self) -> Self {
        let still = |jet: &Jet| Jet::constant(jet.value.clone());
        let [center, axis] = [&self.center, &self.axis].map(|parts| parts.each_ref().map(still));
        Self { center, angle: still(&self.angle), axis }
    }

    /// The frame with the rate 1 of one of its coordinates.
    pub(super) fn moving(&self, part: usize) -> Self {
        let mut frame = self.still();
        match part {
            0 | 1 => frame.center[part].rate = big(1.0),
            _ => {
                let [cosine, sine] = frame.axis.each_ref().map(|part| part.value.clone());
                frame.angle.rate = big(1.0);
                frame.axis[0].rate = -sine;
                frame.axis[1].rate = cosine;
            }
        }
        frame
    }

    /// A local vector in the directions of the ground.
    fn turned(&self, [u, v]: &[Big; 2]) -> Plane {
        let [cosine, sine] = &self.axis;
        [&cosine.scaled(u) - &sine.scaled(v), &sine.scaled(u) + &cosine.scaled(v)]
    }
}

impl Point {
    pub(super) fn of(&self, frames: &[Frame]) -> Plane {
        let frame = &frames[self.link.0];
        let [x, y] = frame.turned(&self.local);
        [&frame.center[0] + &x, &frame.center[1] + &y]
    }
}

fn difference(points: [&Point; 2], frames: &[Frame]) -> Plane {
    let [[x, y], [x0, y0]] = points.map(|point| point.of(frames));
    [&x - &x0, &y - &y0]
}

impl Along {
    pub(super) fn links(&self) -> [Link; 2] {
        match self {
            Self::Turn(links) => *links,
            Self::Axis(_, points) | Self::Distance(points) => points.each_ref().map(|point| point.link),
            Self::Slide(line, point) | Self::Left(line, point) => [point.link, line.from.link],
        }
    }

    pub(super) fn value(&self, frames: &[Frame]) -> Jet {
        match self {
            Self::Turn([link, from]) => &frames[link.0].angle - &frames[from.0].angle,
            Self::Axis(axis, [point, from]) => difference([point, from], frames)[*axis].clone(),
            Self::Distance([point, from]) => {
                let [x, y] = difference([point, from], frames);
                (&(&x * &x) + &(&y * &y)).sqrt()
            }
            Self::Slide(line, point) => {
                let ([x, y], [cosine, sine]) = (difference([point, &line.from], frames), line.of(frames));
                &(&cosine * &x) + &(&sine * &y)
            }
            Self::Left(line, point) => {
                let ([x, y], [cosine, sine]) = (difference([point, &line.from], frames), line.of(frames));
                &(&cosine * &y) - &(&sine * &x)
            }
        }
    }
}

impl Line {
    fn of(&self, frames: &[Frame]) -> Plane {
        frames[self.from.link.0].turned(&self.direction)
    }
}
