//! The extremes along one motion, from one end to the other.
//!
//! At a dead point the derivative by the input is infinite, and at a change point that of the mechanism is ambiguous; the
//! derivative by the arc length of the motion is neither. So the motion is searched between its ends and its change
//! points in a parameter s, input = low + (high - low) sin^2(pi s / 2), by which a quantity has a finite derivative up to
//! a dead point. Next to an end, the sign of the derivative at the end itself is that along the tangent of the motion.

use core::cmp::Ordering::Equal;
use std::vec::Vec;

use super::{Extreme, Extremes, MOST_IN_A_STEP, STEPS, ulp};
use crate::jacobian::{Sample, first_zero, root};
use crate::kinematic::MotionOf;
use crate::range_of_motion::{Driven, RangeOfMotion};
use crate::scalar::arithmetic::*;
use crate::scalar::to_f64;
use crate::{
    Build, Dim, Kinematic, Mechanism, OutputMotion, PathError, PathErrorOf, PointMotion, PositionError, Real, real,
};

/// The most turns that are searched with 360 steps each; a longer range has longer steps.
const MOST_TURNS: f64 = 64.0;

/// The extremes of a quantity along a motion, ends included, each input to an ulp.
///
/// `quantity` takes the motion at an input with the rate 1 and the acceleration 0, as [`RangeOfMotion::motion`] returns
/// it, so that rates are derivatives by the input. Change points between the ends may be extremes too. Where the second
/// derivative is not known it may be NaN: then of two extremes within a step both are missed. There are 360 steps, shorter
/// towards the ends, in each part between change points, and in each turn of a longer part; limitations are those of
/// [`over_range`](super::over_range).
///
/// ```
/// linkage::linkage! {
///     pub mechanism FourBar {
///         param ground = 4, crank = 3, coupler = 2, rocker = 2.5;
///         input theta;
///         unknown phi, psi;
///         loop crank@theta + coupler@phi = ground@0 + rocker@psi;
///         output swing = psi;
///     }
/// }
/// use linkage::extremes;
/// use linkage::range_of_motion::{RangeOfMotion, RangeOptions};
///
/// // This crank goes to and fro between two dead points.
/// let (m, branch) = (FourBar::default(), FourBarBranch::new(linkage::Elbow::Left));
/// let range = RangeOfMotion::on_branch(&m, branch, [0.5], RangeOptions::default())?;
/// let swing = extremes::over(&range, |motion| motion.outputs.swing)?;
/// assert!([swing.least.input, swing.largest.input].iter().any(|input| range.inputs().contains(input)));
/// # Ok::<(), linkage::Error>(())
/// ```
///
/// # Errors
/// The reason why the motion has no position, or no velocity, at an input between its ends.
pub fn over<M>(
    range: &RangeOfMotion<'_, M>,
    mut quantity: impl FnMut(&MotionOf<M::Of>) -> OutputMotion<M::Scalar>,
) -> Result<Extremes<M::Scalar>, PathErrorOf<M>>
where
    M: Driven,
{
    let found = courses(range, |motion| [quantity(motion)])?;
    // There is one quantity.
    Ok(found.first().map_or(Extremes::only(M::Scalar::zero(), M::Scalar::zero()), |course| course.extremes))
}

/// A quantity along a motion.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Course<T = f64> {
    /// The least and the largest value, ends included.
    pub extremes: Extremes<T>,
    /// The places at which it turns: its derivative changes its sign. They are in the order of the input, with that at
    /// which a closed motion begins, without other ends.
    pub turning_points: Vec<Extreme<T>>,
    /// True if it does not move: what its samples differ by are rounding errors, which its derivative does not explain.
    pub is_constant: bool,
    /// The values at both ends.
    pub ends: [Extreme<T>; 2],
    /// The values between them, in the order of the input, with derivatives by the input.
    pub samples: Vec<(T, OutputMotion<T>)>,
}

/// Several quantities along a motion, which is followed once for all of them; see [`over`]. `quantities` returns as
/// many at each input.
///
/// # Panics
/// If it does not.
///
/// # Errors
/// Those of [`over`].
pub fn courses<M, Q>(
    range: &RangeOfMotion<'_, M>,
    quantities: impl FnMut(&MotionOf<M::Of>) -> Q,
) -> Result<Vec<Course<M::Scalar>>, PathErrorOf<M>>
where
    M: Driven,
    Q: AsRef<[OutputMotion<M::Scalar>]>,
{
    let mut search = Search { range, quantities };
    let mut courses: Vec<Course<M::Scalar>> = Vec::new();
    // The signs of the derivatives next to the ends of each piece, and whether they change in between.
    let mut signs: Vec<Vec<[M::Scalar; 2]>> = Vec::new();
    let pieces = Piece::all(range);
    for piece in &pieces {
        let ends = [(piece.low, search.by_length(piece.low)?), (piece.high, search.by_length(piece.high)?)];
        let mut samples = Vec::new();
        for s in piece.places() {
            samples.push((s, search.by_input(piece.input(s))?));
        }
        let mut of_piece = Vec::new();
        for place in 0..ends[0].1.len() {
            let at_ends = ends.each_ref().map(|(input, all)| Extreme { input: *input, value: all[place].value });
            if courses.len() == place {
                courses.push(Course::only(at_ends[0]));
            }
            let course = &mut courses[place];
            course.ends[1] = at_ends[1];
            let slopes = samples.iter().map(|(s, all)| (all[place].value, piece.slope_at(*s, &all[place])));
            let is_constant = is_noise(&slopes.collect::<Vec<_>>());
            course.is_constant &= is_constant;
            course.samples.extend(samples.iter().map(|(s, all)| (piece.input(*s), all[place])));
            let before = course.turning_points.len();
            let mut next_to = [M::Scalar::zero(); 2];
            if is_constant {
                of_piece.push(next_to);
                continue;
            }
            for (at, inside) in [samples.first(), samples.last()].into_iter().enumerate() {
                let ((end, at_end), Some((s, all))) = (&ends[at], inside) else { continue };
                let rates = [at_end[place].rate, all[place].rate];
                let turning = search.next_to_end(place, [*end, piece.input(*s)], rates)?;
                next_to[at] = if turning.is_some() { -rates[1] } else { rates[1] };
                course.turning_points.extend(turning);
            }
            for pair in samples.windows(2) {
                let [from, to] = [&pair[0], &pair[1]].map(|(s, all)| piece.slope_at(*s, &all[place]));
                search.within_step(piece, place, [from, to], &mut course.turning_points)?;
            }
            course.turning_points[before..].sort_by(|one, other| one.input.partial_cmp(&other.input).unwrap_or(Equal));
            of_piece.push(next_to);
        }
        signs.push(of_piece);
    }
    for (place, course) in courses.iter_mut().enumerate() {
        // Where two pieces meet, and where a closed motion begins again.
        let next = |at: usize| if at + 1 < pieces.len() { Some(at + 1) } else { range.is_closed().then_some(0) };
        for (at, piece) in pieces.iter().enumerate() {
            let Some(next) = next(at) else { continue };
            if signs[at][place][1] * signs[next][place][0] < M::Scalar::zero() {
                let input = if next == 0 { pieces[0].low } else { piece.high };
                let value = search.by_length(input)?[place].value;
                course.turning_points.push(Extreme { input, value });
            }
        }
        course.turning_points.sort_by(|one, other| one.input.partial_cmp(&other.input).unwrap_or(Equal));
        let sampled = course.samples.iter().map(|&(input, motion)| Extreme { input, value: motion.value });
        let all = course.ends.iter().chain(&course.turning_points).copied().chain(sampled);
        course.extremes = all.fold(course.extremes, |mut extremes, here| {
            extremes.include(here.input, here.value);
            extremes
        });
    }
    Ok(courses)
}

impl<T: Real> Course<T> {
    fn only(at: Extreme<T>) -> Self {
        let extremes = Extremes::only(at.input, at.value);
        Self { extremes, turning_points: Vec::new(), is_constant: true, ends: [at; 2], samples: Vec::new() }
    }
}

/// True if the differences of values are not those that their derivatives give by the trapezoidal rule: the sum of what
/// they are off is at least half of their own sum.
fn is_noise<T: Real>(samples: &[(T, Sample<T>)]) -> bool {
    let (mut moved, mut off) = (T::zero(), T::zero());
    for pair in samples.windows(2) {
        let [(before, from), (after, to)] = [pair[0], pair[1]];
        let (difference, expected) = (after - before, (from.value + to.value) * (to.at - from.at) * real(0.5));
        moved += difference.abs();
        off += (difference - expected).abs();
    }
    off + off >= moved
}

/// A part of a motion without change points between its ends.
struct Piece<T> {
    low: T,
    high: T,
    steps: u32,
}

impl<T: Real> Piece<T> {
    fn all<M: Driven<Scalar = T>>(range: &RangeOfMotion<'_, M>) -> Vec<Self> {
        let [first, last] = range.inputs();
        let mut bounds = Vec::from([first]);
        let crossings = range.crossings().map(|crossing| crossing.input);
        bounds.extend(crossings.filter(|&input| input > first && input < last));
        bounds.push(last);
        let pairs = bounds.windows(2).map(|pair| (pair[0], pair[1]));
        let piece = |(low, high): (T, T)| {
            let turns = if range.mechanism().input_angles()[0] { to_f64((high - low) / T::two_pi()) } else { 1.0 };
            // At most 64 times 360.
            Self { low, high, steps: (f64::from(STEPS) * turns.clamp(1.0, MOST_TURNS)) as u32 }
        };
        pairs.map(piece).collect()
    }

    /// The middles of equal steps of s.
    fn places(&self) -> impl Iterator<Item = T> {
        let steps = f64::from(self.steps);
        (0..self.steps).map(move |step| real((f64::from(step) + 0.5) / steps))
    }

    /// low + (high - low) sin^2(pi s / 2), from the nearer end.
    fn input(&self, s: T) -> T {
        let (sine, cosine) = (T::frac_pi_2() * s).sine_cosine();
        let length = self.high - self.low;
        if sine < cosine { self.low + length * sine * sine } else { self.high - length * cosine * cosine }
    }

    /// The place s of an input.
    fn place(&self, input: T) -> T {
        let [below, above] = [input - self.low, self.high - input].map(|part| part.max(T::zero()).sqrt());
        below.arctangent2(above) / T::frac_pi_2()
    }

    /// The derivative by s of a quantity with its own: its rate and acceleration are by the input.
    fn slope_at(&self, s: T, motion: &OutputMotion<T>) -> Sample<T> {
        let (sine, cosine) = (T::pi() * s).sine_cosine();
        let half = (self.high - self.low) * real(0.5);
        let (first, second) = (half * T::pi() * sine, half * T::pi() * T::pi() * cosine);
        let slope = motion.acceleration * first * first + motion.rate * second;
        Sample { at: s, value: motion.rate * first, slope }
    }
}

/// The search of the extremes of quantities along a motion.
struct Search<'a, 'm, M: Mechanism, F> {
    range: &'a RangeOfMotion<'m, M>,
    quantities: F,
}

impl<M, F, Q> Search<'_, '_, M, F>
where
    M: Driven,
    F: FnMut(&MotionOf<M::Of>) -> Q,
    Q: AsRef<[OutputMotion<M::Scalar>]>,
{
    /// The quantities at an input, with derivatives by the input.
    fn by_input(&mut self, input: M::Scalar) -> Result<Vec<OutputMotion<M::Scalar>>, PathErrorOf<M>> {
        match self.range.motion(input, M::Scalar::one(), M::Scalar::zero()) {
            Ok(motion) => Ok((self.quantities)(&motion).as_ref().to_vec()),
            // Where motions touch the tangent is known still.
            Err(PathError::Position(PositionError::Singular { .. })) => {
                let (motion, input_rate) = along_tangent(self.range, input)?;
                let all = (self.quantities)(&motion);
                let unknown = M::Scalar::zero() / M::Scalar::zero();
                let by_input = |all: &OutputMotion<M::Scalar>| OutputMotion {
                    rate: all.rate / input_rate,
                    acceleration: unknown,
                    ..*all
                };
                Ok(all.as_ref().iter().map(by_input).collect())
            }
            Err(error) => Err(error),
        }
    }

    /// The quantities at an input, with their first derivatives by the arc length.
    fn by_length(&mut self, input: M::Scalar) -> Result<Vec<OutputMotion<M::Scalar>>, PathErrorOf<M>> {
        let (motion, _) = along_tangent(self.range, input)?;
        Ok((self.quantities)(&motion).as_ref().to_vec())
    }

    /// Adds the turning points of a quantity between two places.
    fn within_step(
        &mut self,
        piece: &Piece<M::Scalar>,
        place: usize,
        [mut last, end]: [Sample<M::Scalar>; 2],
        turning_points: &mut Vec<Extreme<M::Scalar>>,
    ) -> Result<(), PathErrorOf<M>> {
        for _ in 0..MOST_IN_A_STEP {
            let around = first_zero([last, end], M::Scalar::default_epsilon(), |s| {
                self.by_input(piece.input(s)).map(|all| piece.slope_at(s, &all[place]))
            })?;
            let Some(around) = around else { break };
            let inputs = around.map(|sample| piece.input(sample.at));
            let rates = [self.by_input(inputs[0])?[place].rate, self.by_input(inputs[1])?[place].rate];
            let rate = |input| self.by_input(input).map(|all| Some(all[place].rate));
            let zero = root(inputs, rates, ulp(inputs[0], inputs[1]), rate)?;
            let input = zero.unwrap_or(inputs[1]);
            let there = self.by_input(input)?[place];
            turning_points.push(Extreme { input, value: there.value });
            last = Sample { value: M::Scalar::zero(), ..piece.slope_at(piece.place(input), &there) };
        }
        Ok(())
    }

    /// The turning point of a quantity between an end and an input inside, if its derivative changes its sign.
    fn next_to_end(
        &mut self,
        place: usize,
        [end, inside]: [M::Scalar; 2],
        [at_end, at_inside]: [M::Scalar; 2],
    ) -> Result<Option<Extreme<M::Scalar>>, PathErrorOf<M>> {
        if at_end * at_inside >= M::Scalar::zero() {
            return Ok(None);
        }
        let at_inside = self.by_length(inside)?[place].rate;
        let (inputs, rates) =
            if end < inside { ([end, inside], [at_end, at_inside]) } else { ([inside, end], [at_inside, at_end]) };
        let rate = |input| self.by_length(input).map(|all| Some(all[place].rate));
        let Some(input) = root(inputs, rates, ulp(end, inside), rate)? else { return Ok(None) };
        let value = self.by_length(input)?[place].value;
        Ok(Some(Extreme { input, value }))
    }
}

/// A motion by the arc length, and the derivative of the input.
type AlongTangent<M> = (MotionOf<<M as Driven>::Of>, <M as Mechanism>::Scalar);

/// The position at an input with derivatives by the arc length, accelerations zero, and that of the input.
fn along_tangent<M: Driven>(range: &RangeOfMotion<'_, M>, input: M::Scalar) -> Result<AlongTangent<M>, PathErrorOf<M>> {
    let (near, rates) = range.near(input)?;
    let (unknown_rates, along) = M::rate_parts(&rates);
    let [_, slope, _] = range.mechanism().inputs_at(input);
    let (m, position) = (range.driven(), range.mechanism().position_of(&near));
    let (pose, rates) = (m.pose_at(&position), M::Of::rates(unknown_rates, slope * along[0]));
    let accelerations = M::Of::accelerations(unknown_rates.dim().zeros(), slope.dim().zeros());
    let points = M::Of::each_point(m.points(&pose)?);
    let velocities = M::Of::each_point(m.point_velocities(&pose, &rates)?);
    let centripetal = M::Of::each_point(m.point_accelerations(&pose, &rates, &accelerations)?);
    let points = velocities.dim().array(|at| PointMotion {
        position: points[at],
        velocity: velocities[at],
        acceleration: centripetal[at],
    });
    let values = M::Of::each_output(m.outputs(&pose)?);
    let output_rates = M::Of::each_output(m.output_rates(&pose, &rates)?);
    let bends = M::Of::each_output(m.output_accelerations(&pose, &rates, &accelerations)?);
    let outputs =
        values.dim().array(|at| OutputMotion { value: values[at], rate: output_rates[at], acceleration: bends[at] });
    let (points, outputs) = (points.into(), outputs.into());
    Ok((MotionOf::<M::Of> { position, rates, accelerations, points, outputs }, along[0]))
}
