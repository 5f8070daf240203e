//! Quantities at an input of a motion, with their derivatives, also where these do not exist for all.

use super::on_turns::OnTurns;
use super::piece::{Piece, next_to};
use super::{Extreme, MOST_IN_A_STEP, ulp};
use crate::jacobian::{Sample, first_zero, root};
use crate::kinematic::MotionOf;
use crate::range_of_motion::{Driven, RangeOfMotion};
use crate::scalar::arithmetic::*;
use crate::{
    Build, Dim, Kinematic, Mechanism, OutputMotion, PathError, PathErrorOf, PointMotion, PositionError, Real, real,
};

/// The most inputs between two that are known until the turn of an angle is sure.
const MOST_BETWEEN: usize = 64;

/// The search of the extremes of quantities along a motion.
pub(super) struct Search<'a, 'm, M: Mechanism, F> {
    range: &'a RangeOfMotion<'m, M>,
    quantities: F,
    turns: OnTurns<M::Scalar>,
}

impl<'a, 'm, M, F, Q> Search<'a, 'm, M, F>
where
    M: Driven,
    F: FnMut(&MotionOf<M::Of>) -> Q,
    Q: AsRef<[OutputMotion<M::Scalar>]>,
{
    pub(super) fn new(range: &'a RangeOfMotion<'m, M>, quantities: F, jumps: Vec<Option<M::Scalar>>) -> Self {
        Self { range, quantities, turns: OnTurns::new(jumps) }
    }

    /// The quantities at an input, with derivatives by the input.
    pub(super) fn by_input(&mut self, input: M::Scalar) -> Result<Vec<OutputMotion<M::Scalar>>, PathErrorOf<M>> {
        let all = self.of_formulas(input)?;
        Ok(self.turns.turned(input, all))
    }

    /// The quantities at an input beyond those before, on their turns.
    pub(super) fn next(&mut self, input: M::Scalar) -> Result<Vec<OutputMotion<M::Scalar>>, PathErrorOf<M>> {
        let all = self.by_input(input)?;
        self.go_on(input, &all)
    }

    /// The quantities by the arc length at the begin of a part, on their turns.
    pub(super) fn begin(&mut self, input: M::Scalar) -> Result<Vec<OutputMotion<M::Scalar>>, PathErrorOf<M>> {
        let all = self.by_length(input, true)?;
        self.go_on(input, &all)
    }

    /// Keeps the turns of quantities at an input beyond those before. Where an angle moves by more than a quarter of a turn at
    /// once, it is followed in shorter steps.
    fn go_on(
        &mut self,
        input: M::Scalar,
        all: &[OutputMotion<M::Scalar>],
    ) -> Result<Vec<OutputMotion<M::Scalar>>, PathErrorOf<M>> {
        let mut all = all.to_vec();
        for _ in 0..MOST_BETWEEN {
            let Some(last) = self.turns.last().filter(|_| self.turns.is_far(input, &all)) else { break };
            let mut between = (last + input) * real(0.5);
            let mut there = self.by_input(between)?;
            for _ in 0..MOST_BETWEEN {
                if !self.turns.is_far(between, &there) {
                    break;
                }
                between = (last + between) * real(0.5);
                there = self.by_input(between)?;
            }
            if between <= last || between >= input {
                break;
            }
            self.turns.keep(between, &there);
            all = self.turns.turned(input, all);
        }
        self.turns.keep(input, &all);
        Ok(all)
    }

    fn of_formulas(&mut self, input: M::Scalar) -> Result<Vec<OutputMotion<M::Scalar>>, PathErrorOf<M>> {
        match self.range.motion(input, M::Scalar::one(), M::Scalar::zero()) {
            Ok(motion) => Ok((self.quantities)(&motion).as_ref().to_vec()),
            // A kink has no derivative: that is one of both next to it.
            Err(error @ PathError::Position(PositionError::NotFinite { .. })) => {
                let next = next_to(self.range, input);
                let next_motion = |at| self.range.motion(at, M::Scalar::one(), M::Scalar::zero()).ok();
                let motion = next.into_iter().find_map(next_motion).and_then(|motion| self.moved_to(motion, input));
                Ok((self.quantities)(&motion.ok_or(error)?).as_ref().to_vec())
            }
            // Where motions touch the tangent is known still.
            Err(PathError::Position(PositionError::Singular { .. })) => {
                let (motion, input_rate) = self.along_tangent(input, true)?;
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

    /// The quantities at an input, with their first derivatives by the arc length; at a kink those after it, or before it.
    pub(super) fn by_length(
        &mut self,
        input: M::Scalar,
        is_after: bool,
    ) -> Result<Vec<OutputMotion<M::Scalar>>, PathErrorOf<M>> {
        let (motion, _) = self.along_tangent(input, is_after)?;
        let all = (self.quantities)(&motion).as_ref().to_vec();
        Ok(self.turns.turned(input, all))
    }

    fn along_tangent(&self, input: M::Scalar, is_after: bool) -> Result<AlongTangent<M>, PathErrorOf<M>> {
        match along_tangent(self.range, input) {
            Err(error @ PathError::Position(PositionError::NotFinite { .. })) => {
                let [before, after] = next_to(self.range, input);
                let order = if is_after { [after, before] } else { [before, after] };
                let next_motion = |at| along_tangent(self.range, at).ok();
                let found = order.into_iter().find_map(next_motion);
                let found = found.and_then(|(motion, along)| Some((self.moved_to(motion, input)?, along)));
                found.ok_or(error)
            }
            found => found,
        }
    }

    /// The derivatives of a motion with the values of an input next to it.
    fn moved_to(&self, motion: MotionOf<M::Of>, input: M::Scalar) -> Option<MotionOf<M::Of>> {
        let position = self.range.at(input).ok()?;
        let values = M::Of::each_output(self.range.driven().outputs(&self.range.driven().pose_at(&position)).ok()?);
        let outputs = M::Of::each_output(motion.outputs);
        let outputs = outputs.dim().array(|at| OutputMotion { value: values[at], ..outputs[at] }).into();
        Some(MotionOf::<M::Of> { position, outputs, ..motion })
    }

    /// Adds the turning points of a quantity between two places.
    pub(super) fn within_step(
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
            // At a kink it goes on with the derivative after it.
            let [before, after] = next_to(self.range, input);
            let (Ok(before), Ok(after)) = (self.by_input(before), self.by_input(after)) else { continue };
            if is_kink([before[place].rate, after[place].rate], rates) {
                last = piece.slope_at(piece.place(input), &after[place]);
            }
        }
        Ok(())
    }

    /// The turning point of a quantity between an end and an input inside, if its derivative changes its sign.
    pub(super) fn next_to_end(
        &mut self,
        place: usize,
        [end, inside]: [M::Scalar; 2],
        [at_end, at_inside]: [M::Scalar; 2],
    ) -> Result<Option<Extreme<M::Scalar>>, PathErrorOf<M>> {
        if at_end * at_inside >= M::Scalar::zero() {
            return Ok(None);
        }
        let at_inside = self.by_length(inside, true)?[place].rate;
        let (inputs, rates) =
            if end < inside { ([end, inside], [at_end, at_inside]) } else { ([inside, end], [at_inside, at_end]) };
        let rate = |input| self.by_length(input, true).map(|all| Some(all[place].rate));
        let Some(input) = root(inputs, rates, ulp(end, inside), rate)? else { return Ok(None) };
        let value = self.by_length(input, true)?[place].value;
        Ok(Some(Extreme { input, value }))
    }
}

/// True for derivatives on both sides of a place that are not near zero, as those around it are not: they jump there.
fn is_kink<T: Real>([before, after]: [T; 2], around: [T; 2]) -> bool {
    let [from, to] = around.map(|rate| rate.abs() * real(0.5));
    before * after < T::zero() && before.abs() >= from && after.abs() >= to
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
