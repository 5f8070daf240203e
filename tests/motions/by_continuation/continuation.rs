//! A curve of positions in small steps of its length.

use std::f64::consts::TAU;

use nalgebra::{SMatrix, SVector};

/// The input, and four unknowns.
pub type Position = SVector<f64, 5>;

/// A part of a loop: a vector in the frame of a link, whose angle is the coordinate of this number; or along the x axis, a
/// coordinate that is a length; or a constant.
#[derive(Debug, Clone, Copy)]
pub enum Part {
    Link(usize, f64, f64),
    Slide(usize, f64),
    Ground(f64, f64),
}

/// The equations of a linkage: in each of its two loops the parts add up to zero.
#[derive(Debug, Clone)]
pub struct Equations {
    pub loops: [Vec<Part>; 2],
    /// True for coordinates that are angles.
    pub angles: [bool; 5],
    /// True if the first loop alone determines two unknowns, and the second one the others.
    pub are_groups: bool,
}

/// A place that a curve passes.
#[derive(Debug, Clone, Copy)]
pub enum Passed {
    /// The input is the start input, or differs by whole turns.
    Start(Position),
    /// The input reverses.
    DeadPoint(Position),
    /// The end of a step.
    Step(Position),
}

/// The end of a curve.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum End {
    Closed,
    /// The length of the curve or the number of steps is spent.
    Spent,
    /// The corrector failed at the smallest step.
    Lost,
}

/// The longest step.
const STEP: f64 = 0.02;

/// The longest step where the direction of the curve is within 1 / 20 of a reversal of the input.
const NEAR_REVERSAL: f64 = 0.001;

/// The most steps of a curve.
const MOST_STEPS: usize = 300_000;

/// The point at a distance beyond the last of some points, on the parabola through three of them that are a step apart.
fn extrapolated(points: &[Position], distance: f64) -> Option<Position> {
    let third = points.last()?;
    let away = |from: &Position, least: f64| points.iter().rev().find(|point| (*point - from).norm() >= least);
    let second = away(third, STEP)?;
    let first = away(second, STEP)?;
    let lengths = [(second - first).norm(), (third - second).norm()];
    let [at, other] = [lengths[0], lengths[0] + lengths[1]];
    let to = other + distance;
    Some(
        first * ((to - at) * (to - other) / (at * other)) - second * (to * (to - other) / (at * (other - at)))
            + third * (to * (to - at) / (other * (other - at))),
    )
}

impl Equations {
    fn residual(&self, y: &Position) -> (SVector<f64, 4>, SMatrix<f64, 4, 5>) {
        let (mut value, mut slope) = (SVector::zeros(), SMatrix::zeros());
        for (number, parts) in self.loops.iter().enumerate() {
            let row = 2 * number;
            for part in parts {
                match *part {
                    Part::Link(angle, along, across) => {
                        let (sine, cosine) = y[angle].sin_cos();
                        let (east, north) = (along * cosine - across * sine, along * sine + across * cosine);
                        value[row] += east;
                        value[row + 1] += north;
                        slope[(row, angle)] -= north;
                        slope[(row + 1, angle)] += east;
                    }
                    Part::Slide(length, sign) => {
                        value[row] += sign * y[length];
                        slope[(row, length)] += sign;
                    }
                    Part::Ground(east, north) => {
                        value[row] += east;
                        value[row + 1] += north;
                    }
                }
            }
        }
        (value, slope)
    }

    /// The least singular value of the derivatives: zero where motions cross.
    pub fn regularity(&self, y: &Position) -> f64 {
        self.residual(y).1.svd(false, false).singular_values.min()
    }

    /// The signs of the determinants of the groups: a motion keeps them between its dead points and change points.
    pub fn signs(&self, y: &Position) -> [bool; 2] {
        let (_, slope) = self.residual(y);
        if self.are_groups {
            [0, 2].map(|row| slope.fixed_view::<2, 2>(row, row + 1).determinant() > 0.0)
        } else {
            [slope.fixed_view::<4, 4>(0, 1).determinant() > 0.0; 2]
        }
    }

    /// The unit tangent nearest to a direction.
    fn tangent(&self, y: &Position, near: &Position) -> Option<Position> {
        let (_, slope) = self.residual(y);
        let mut bordered = SMatrix::<f64, 5, 5>::zeros();
        bordered.fixed_rows_mut::<4>(0).copy_from(&slope);
        bordered.row_mut(4).copy_from(&near.transpose());
        let mut right = Position::zeros();
        right[4] = 1.0;
        bordered.lu().solve(&right).map(|tangent| tangent.normalize()).filter(|tangent| tangent[0].is_finite())
    }

    /// The position in the plane through `guess` with this normal.
    fn correct(&self, guess: &Position, normal: &Position) -> Option<Position> {
        let mut y = *guess;
        for iteration in 0..8 {
            let (value, slope) = self.residual(&y);
            let mut bordered = SMatrix::<f64, 5, 5>::zeros();
            bordered.fixed_rows_mut::<4>(0).copy_from(&slope);
            bordered.row_mut(4).copy_from(&normal.transpose());
            let mut right = Position::zeros();
            right.fixed_rows_mut::<4>(0).copy_from(&-value);
            right[4] = normal.dot(&(guess - y));
            let move_ = bordered.lu().solve(&right)?;
            y += move_;
            let size = move_.norm();
            if !size.is_finite() || iteration >= 1 && size > 0.1 * STEP {
                return None;
            }
            if size < 1e-13 * (1.0 + y.norm()) {
                return Some(y);
            }
        }
        None
    }

    /// The position at an input, near another one.
    fn at_input(&self, near: &Position, input: f64) -> Option<Position> {
        let mut guess = *near;
        guess[0] = input;
        self.correct(&guess, &Position::x())
    }

    /// Two positions are one, angles modulo whole turns.
    pub fn are_one(&self, one: &Position, other: &Position) -> bool {
        (0..5).all(|place| {
            let off = one[place] - other[place];
            let off = if self.angles[place] { off - TAU * (off / TAU).round() } else { off };
            off.abs() < 1e-7 * (1.0 + one.norm())
        })
    }

    /// The number of whole turns of the input from a start; of a length, only its side.
    fn turns(&self, from: f64, input: f64) -> f64 {
        if self.angles[0] { ((input - from) / TAU).floor() } else { f64::from(input >= from) - 1.0 }
    }

    /// Follows the curve from a position, the input increasing or decreasing at first, until it is closed or `stop` says so.
    pub fn follow(&self, start: &Position, sign: f64, mut stop: impl FnMut(Passed) -> bool) -> End {
        let Some(mut tangent) = self.tangent(start, &(Position::x() * sign)) else { return End::Lost };
        let (mut y, mut step) = (*start, 0.5 * NEAR_REVERSAL);
        let mut before = Vec::new();
        for _ in 0..MOST_STEPS {
            before.push(y);
            step = (2.0_f64 * step).min(if tangent[0].abs() < 0.05 { NEAR_REVERSAL } else { STEP });
            let turned = |guess: Position, normal: Position| {
                let next = self.correct(&guess, &normal)?;
                let turned = self.tangent(&next, &normal)?;
                (turned.dot(&normal) > 0.999).then_some((next, turned))
            };
            let lengths = (0..7).map(|halvings| step * 0.5_f64.powi(halvings));
            let along = lengths.into_iter().find_map(|step| Some((step, turned(y + tangent * step, tangent)?)));
            // Where motions cross or touch short steps fail: a longer one passes, to the parabola through points before.
            let beyond = || {
                let lengths = [0.5, 1.0, 1.5, 2.0, 3.0].map(|part| part * STEP);
                lengths.into_iter().find_map(|step| {
                    let guess = extrapolated(&before, step)?;
                    Some((step, turned(guess, (guess - y).normalize())?))
                })
            };
            let Some((tried, (next, next_tangent))) = along.or_else(beyond) else { return End::Lost };
            step = tried;
            let reversal = (next_tangent[0] * tangent[0] < 0.0).then(|| {
                let (mut low, mut high) = (0.0, step);
                for _ in 0..50 {
                    let middle = 0.5 * (low + high);
                    let at = self.correct(&(y + tangent * middle), &tangent);
                    let at = at.and_then(|at| self.tangent(&at, &tangent));
                    let is_before = at.is_none_or(|at| at[0] * tangent[0] > 0.0);
                    *(if is_before { &mut low } else { &mut high }) = middle;
                }
                // Where motions touch it may not be found: it is near.
                self.correct(&(y + tangent * low), &tangent).unwrap_or(y)
            });
            // Between its ends and a reversal the input goes one way.
            let ends: Vec<Position> = [Some(y), reversal, Some(next)].into_iter().flatten().collect();
            let mut events = Vec::new();
            for (number, pair) in ends.windows(2).enumerate() {
                let turns = [pair[0], pair[1]].map(|end| self.turns(start[0], end[0]));
                if turns[0] != turns[1] && !(number == 0 && y == *start) {
                    let whole = if self.angles[0] { TAU * turns[0].max(turns[1]) } else { 0.0 };
                    let input = start[0] + whole;
                    let share = (input - pair[0][0]) / (pair[1][0] - pair[0][0]);
                    let Some(at) = self.at_input(&(pair[0] + (pair[1] - pair[0]) * share), input) else {
                        return End::Lost;
                    };
                    let goes_up = pair[1][0] > pair[0][0];
                    if self.are_one(&at, start) && goes_up == (sign > 0.0) {
                        return End::Closed;
                    }
                    events.push(Passed::Start(at));
                }
                if number == 0 {
                    events.extend(reversal.map(Passed::DeadPoint));
                }
            }
            events.push(Passed::Step(next));
            if events.into_iter().any(&mut stop) {
                return End::Spent;
            }
            (y, tangent) = (next, next_tangent);
        }
        End::Spent
    }
}
