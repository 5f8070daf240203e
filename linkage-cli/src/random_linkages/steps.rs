//! The motion through a position by small steps: Newton's method across the tangent, and no step that turns it much.

use std::f64::consts::TAU;

use super::algebra::{bounds, dot, norm, sign, solve};
use super::linkage::{Form, Linkage, Output};

/// The longest and the shortest step, of angles in radians and lengths.
const LONGEST: f64 = 0.05;
const SHORTEST: f64 = 1e-9;
/// Motions that cross, and those that come nearer to each other than this, are followed to the other side.
const CROSSED: f64 = 1e-7;
/// The most steps of a motion one way.
const MOST: usize = 20_000;
/// Two computations of a residual differ by so many units in the last place of the sum of its terms.
pub const UNITS: f64 = 32.0;

/// A position of the motion, with its direction.
#[derive(Debug, Clone)]
pub struct Node {
    pub q: Vec<f64>,
    pub tangent: Vec<f64>,
}

/// The reason of an end.
#[derive(Debug, Clone, PartialEq)]
pub enum Why {
    DeadPoint,
    /// The name of what reaches an end of its range, and whether the end is the largest value.
    Range(String, bool),
    /// At the start again, after these turns of the input.
    Closed(i64),
    /// It goes on too far.
    Long,
}

/// A part of a motion, from its start on.
#[derive(Debug, Clone)]
pub struct Part {
    pub nodes: Vec<Node>,
    pub why: Why,
}

/// The motion through dead points.
pub struct Curve {
    pub nodes: Vec<Node>,
    pub why: Why,
    pub has_dead_points: bool,
}

/// A linkage whose inputs but one are held.
pub struct Stepped<'l> {
    pub linkage: &'l Linkage,
    pub moving: usize,
}

impl<'l> Stepped<'l> {
    /// The unknowns, then the moving input.
    fn free(&self) -> Vec<usize> {
        (0..self.linkage.unknowns).chain([self.moving]).collect()
    }

    fn jacobian(&self, q: &[f64]) -> Vec<Vec<f64>> {
        let free = self.free();
        self.linkage.jacobian(q).into_iter().map(|row| free.iter().map(|place| row[*place]).collect()).collect()
    }

    fn moved(&self, q: &[f64], by: &[f64], length: f64) -> Vec<f64> {
        let mut moved = q.to_vec();
        self.free().into_iter().zip(by).for_each(|(place, by)| moved[place] += length * by);
        moved
    }

    fn with(&self, q: &[f64], last: &[f64]) -> Vec<Vec<f64>> {
        let mut rows = self.jacobian(q);
        rows.push(last.to_vec());
        rows
    }

    /// The direction of the motion nearest to another one.
    pub fn tangent(&self, q: &[f64], last: &[f64]) -> Option<Vec<f64>> {
        let mut right = vec![0.0; last.len()];
        *right.last_mut()? = 1.0;
        let tangent = solve(self.with(q, last), right)?;
        let length = norm(&tangent);
        Some(tangent.into_iter().map(|of| of / length).collect())
    }

    /// The sign of the determinant of the equations and the direction: along one motion it stays, also at a dead point, and it
    /// changes where another motion is crossed, or where a step goes over to one that is near.
    fn side(&self, at: &Node) -> f64 {
        sign(self.with(&at.q, &at.tangent))
    }

    /// The position on the plane across a direction, near a point of it, with the length of the first correction.
    fn corrected(&self, mut q: Vec<f64>, across: &[f64]) -> Option<(Vec<f64>, f64)> {
        let mut first = None;
        let mut last = f64::INFINITY;
        for _ in 0..12 {
            let mut right: Vec<f64> = self.linkage.residual(&q).iter().map(|of| -of).collect();
            right.push(0.0);
            let step = solve(self.with(&q, across), right)?;
            let length = norm(&step);
            first.get_or_insert(length);
            q = self.moved(&q, &step, 1.0);
            if length >= 0.5 * last || length == 0.0 {
                // Rounding errors are left.
                return (length < 1e-9).then_some((q, first?));
            }
            last = length;
        }
        None
    }

    /// The position at a value of the moving input, near another one.
    pub fn at(&self, near: &[f64], value: f64) -> Option<Vec<f64>> {
        let mut q = near.to_vec();
        q[self.moving] = value;
        let mut across = vec![0.0; self.linkage.unknowns + 1];
        *across.last_mut()? = 1.0;
        self.corrected(q, &across).map(|(q, _)| q)
    }

    /// A step of this length, or none if it turns too much.
    fn step(&self, from: &Node, length: f64) -> Option<Node> {
        let (q, first) = self.corrected(self.moved(&from.q, &from.tangent, length), &from.tangent)?;
        let tangent = self.tangent(&q, &from.tangent)?;
        (first <= 0.1 * length.abs() && dot(&tangent, &from.tangent) >= 0.99).then_some(Node { q, tangent })
    }

    /// The quantities with declared ranges: how far they are inside of each end.
    fn inside(&self, q: &[f64]) -> Vec<(String, bool, f64)> {
        let linkage = self.linkage;
        let of_coordinates = linkage.coordinates.iter().zip(q).map(|(of, value)| (&of.name, of.range, *value));
        let of_outputs = linkage.outputs.iter().map(|of| (&of.name, of.range, of.form.at(q)));
        let all = of_coordinates.chain(of_outputs).filter_map(|(name, range, value)| Some((name, range?, value)));
        all.flat_map(|(name, [least, most], value)| {
            [(name.clone(), false, value - least), (name.clone(), true, most - value)]
        })
        .collect()
    }

    pub fn is_within(&self, q: &[f64]) -> bool {
        self.inside(q).iter().all(|(_, _, inside)| *inside >= 0.0)
    }

    /// The first node of a motion along which the input grows, or falls.
    pub fn begin(&self, q: &[f64], sign: f64) -> Option<Node> {
        let mut last = vec![0.0; self.linkage.unknowns + 1];
        *last.last_mut()? = sign;
        Some(Node { q: q.to_vec(), tangent: self.tangent(q, &last)? })
    }

    /// The motion from a node until it is at its start again, at an end of a range, or, unless it goes through them, at a dead point.
    pub fn follow(&self, start: Node, through_dead_points: bool) -> Option<Part> {
        let last = self.linkage.unknowns;
        let mut nodes = vec![start.clone()];
        let mut length = 1e-3;
        let mut from = start.clone();
        // The first step that went over to another motion and was not taken.
        let mut over: Option<(Node, Node, f64)> = None;
        while nodes.len() < MOST {
            let next = match self.step(&from, length) {
                Some(next) if self.side(&from) * self.side(&next) >= 0.0 => {
                    over = over.filter(|(.., by)| length < *by);
                    next
                }
                found => {
                    if let (None, Some(next)) = (&over, found) {
                        over = Some((from.clone(), next, length));
                    }
                    length *= 0.5;
                    if length >= if over.is_some() { CROSSED } else { SHORTEST } {
                        continue;
                    }
                    let next;
                    (from, next, length) = over.take()?;
                    next
                }
            };
            if let Some((name, is_most, _)) = self.inside(&next.q).into_iter().find(|(_, _, inside)| *inside < 0.0) {
                // The first of all ends, where the step is cut to the one that is reached first.
                let (end, which) = self.cut(&from, length, (name, is_most))?;
                if through_dead_points || end.tangent[last] * start.tangent[last] > 0.0 {
                    nodes.push(end);
                    return Some(Part { nodes, why: Why::Range(which.0, which.1) });
                }
            }
            if !through_dead_points && next.tangent[last] * start.tangent[last] <= 0.0 {
                let end = self.bisected(&from, length, |node| node.tangent[last] * start.tangent[last])?;
                nodes.push(end);
                return Some(Part { nodes, why: Why::DeadPoint });
            }
            nodes.push(next.clone());
            if nodes.len() > 10
                && let Some(turns) = self.closes(&start, &from, &next)
            {
                nodes.pop();
                let mut end = start.clone();
                // At the start again, on other turns.
                for (place, of) in end.q.iter_mut().enumerate() {
                    if self.linkage.coordinates[place].is_angle {
                        *of += ((next.q[place] - *of) / TAU).round() * TAU;
                    }
                }
                nodes.push(end);
                return Some(Part { nodes, why: Why::Closed(turns) });
            }
            from = next;
            length = (1.3 * length).min(LONGEST);
        }
        Some(Part { nodes, why: Why::Long })
    }

    /// The motion through dead points.
    pub fn curve(&self, q: &[f64]) -> Option<Curve> {
        let mut upper = self.follow(self.begin(q, 1.0)?, true)?;
        let mut nodes = Vec::new();
        match upper.why {
            Why::Long => return None,
            Why::Range(..) => {
                // The other way from the start, with directions along the curve.
                let lower = self.follow(self.begin(q, -1.0)?, true)?;
                nodes.extend(lower.nodes.into_iter().rev().map(|mut node| {
                    node.tangent.iter_mut().for_each(|of| *of = -*of);
                    node
                }));
                upper.nodes.remove(0);
            }
            _ => {}
        }
        nodes.append(&mut upper.nodes);
        let last = self.linkage.unknowns;
        let has_dead_points = nodes.windows(2).any(|two| two[0].tangent[last] * two[1].tangent[last] < 0.0);
        Some(Curve { nodes, why: upper.why, has_dead_points })
    }

    /// The node within a step at which a function is zero, which is positive at its start.
    fn bisected(&self, from: &Node, length: f64, of: impl Fn(&Node) -> f64) -> Option<Node> {
        let (mut low, mut high) = (0.0, length);
        let mut found = from.clone();
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            let node = self.step(from, middle).or_else(|| (middle < 1e-7).then(|| from.clone()))?;
            if of(&node) > 0.0 {
                low = middle;
            } else {
                high = middle;
            }
            found = node;
        }
        Some(found)
    }

    /// The first end of a range within a step.
    fn cut(&self, from: &Node, length: f64, which: (String, bool)) -> Option<(Node, (String, bool))> {
        let of = |node: &Node| {
            let all = self.inside(&node.q);
            all.into_iter().min_by(|(.., one), (.., other)| one.total_cmp(other)).map_or(1.0, |(.., least)| least)
        };
        let node = self.bisected(from, length, of)?;
        let first = self.inside(&node.q).into_iter().min_by(|(.., one), (.., other)| one.total_cmp(other));
        Some((node, first.map_or(which, |(name, is_most, _)| (name, is_most))))
    }

    /// True for an angle that means the same after a turn; one with a range is a number, as in an output with a range.
    fn is_direction(&self, place: usize) -> bool {
        let of = &self.linkage.coordinates[place];
        let is_in = |output: &Output| match &output.form {
            Form::Linear(form) => output.range.is_some() && form.terms.iter().any(|(_, of)| *of == place),
            Form::Angle(_) => false,
        };
        of.is_angle && of.range.is_none() && !self.linkage.outputs.iter().any(is_in)
    }

    /// The turns of the input if the start lies between two nodes.
    fn closes(&self, start: &Node, from: &Node, next: &Node) -> Option<i64> {
        let free = self.free();
        let difference = |node: &Node| -> Vec<f64> {
            let each = free.iter().map(|place| {
                let by = node.q[*place] - start.q[*place];
                if self.is_direction(*place) { by - (by / TAU).round() * TAU } else { by }
            });
            each.collect()
        };
        let (before, after) = (difference(from), difference(next));
        let is_near = norm(&before) <= 4.0 * LONGEST && norm(&after) <= 4.0 * LONGEST;
        if !is_near || dot(&before, &start.tangent) > 0.0 || dot(&after, &start.tangent) <= 0.0 {
            return None;
        }
        // The motion passes the start itself, and not a place next to it.
        let part = dot(&before, &start.tangent) / (dot(&before, &start.tangent) - dot(&after, &start.tangent));
        let between = from.q.iter().zip(&next.q).map(|(from, next)| from + part * (next - from)).collect();
        let (q, _) = self.corrected(between, &start.tangent)?;
        let tangent = self.tangent(&q, &next.tangent)?;
        let is_start =
            norm(&difference(&Node { q, tangent: tangent.clone() })) <= 1e-6 && dot(&tangent, &start.tangent) >= 0.9;
        is_start.then(|| ((next.q[self.moving] - start.q[self.moving]) / TAU).round() as i64)
    }

    /// The largest error of each unknown where each equation is right but for rounding errors.
    pub fn errors(&self, q: &[f64]) -> Option<Vec<f64>> {
        let n = self.linkage.unknowns;
        let rows: Vec<Vec<f64>> = self.jacobian(q).into_iter().map(|row| row[..n].to_vec()).collect();
        let sizes: Vec<f64> = self.linkage.sizes(q).iter().map(|size| UNITS * f64::EPSILON * size).collect();
        let errors = bounds(&rows, &sizes)?;
        // The solution itself is rounded.
        Some(errors.iter().zip(q).map(|(error, value)| error + UNITS * f64::EPSILON * value.abs()).collect())
    }

    /// The largest error of the input at a dead point: the unknowns take what they can of an error of the equations.
    pub fn error_of_input(&self, end: &Node) -> Option<f64> {
        // Without the column of the coordinate that moves most, the Jacobian is regular there.
        let n = self.linkage.unknowns;
        let most = (0..=n).max_by(|one, other| end.tangent[*one].abs().total_cmp(&end.tangent[*other].abs()))?;
        let rows: Vec<Vec<f64>> = self
            .jacobian(&end.q)
            .into_iter()
            .map(|row| (0..=n).filter(|place| *place != most).map(|place| row[place]).collect())
            .collect();
        let sizes: Vec<f64> = self.linkage.sizes(&end.q).iter().map(|size| UNITS * f64::EPSILON * size).collect();
        let errors = bounds(&rows, &sizes)?;
        Some(errors.last()? + UNITS * f64::EPSILON * end.q[self.moving].abs())
    }

    /// The velocity of each coordinate where the moving input has the velocity 1.
    pub fn ratios(&self, q: &[f64]) -> Option<Vec<f64>> {
        let n = self.linkage.unknowns;
        let all = self.jacobian(q);
        let rows = all.iter().map(|row| row[..n].to_vec()).collect();
        let mut ratios = solve(rows, all.iter().map(|row| -row[n]).collect())?;
        ratios.resize(q.len(), 0.0);
        ratios[self.moving] = 1.0;
        Some(ratios)
    }
}
