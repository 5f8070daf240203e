//! Position by interpolation in a table.

use super::newton::predicted;
use super::{PositionMethod, Reached};
use crate::error::{all_finite, finite};
use crate::jacobian::correction;
use crate::jacobian::ulp::ulps;
use crate::mechanism::{finite_position, other_group};
use crate::scalar::arithmetic::*;
use crate::scalar::{larger, to_f64};
use crate::{
    Build, D, InputError, Mechanism, Name, PerInput, PerUnknown, PositionError, PositionErrorOf, newton_any_branch,
    real,
};

/// Positions of a mechanism with one input at `N` evenly spaced inputs, interpolated by cubic Hermite polynomials whose
/// slopes are the velocity ratios. The table stores 2 `U` `N` numbers.
///
/// The interpolation error is h^4/384 times the fourth derivative for entries h apart: doubling their number divides it
/// by 16. It is measured when the table is built: [`Table::error`].
///
/// ```text
/// u = u0 + t (s0 + t (3 d - 2 s0 - s1 + t (s0 + s1 - 2 d))),   d = u1 - u0, s = h W, t = (v - v0)/h
/// ```
pub struct Table<M: Mechanism, const N: usize> {
    input: M::Scalar,
    step: M::Scalar,
    inverse_step: M::Scalar,
    /// u and h W of each entry.
    entries: [[PerUnknown<M>; 2]; N],
    /// The change of u in one turn of the input, if the table covers a turn.
    advance: Option<PerUnknown<M>>,
    error: M::Scalar,
}

crate::__by_fields!([M: Mechanism, const N: usize] Table<M, N> { input, step, inverse_step, entries, advance, error });

/// The number of positions that are solved for between an entry and the next while the table is built, so that Newton's
/// method starts near its solution.
const PARTS: u32 = 8;

/// The tolerance, in ulps of 1 plus the largest coordinate, for a turn of the input to change each unknown by a
/// multiple of 2 pi.
const WHOLE_TURN_ULPS: f64 = 1e4;

impl<M: Mechanism<V = D<1>>, const N: usize> Table<M, N> {
    /// Tabulates one turn of the input from the position near `start`. Inputs outside this turn are reduced to it.
    ///
    /// # Errors
    /// [`InputError::NotPeriodic`] if the mechanism does not return to its start after a turn; those of
    /// [`Table::between`].
    pub fn turn(mechanism: &M, start: &M::Coordinates) -> Result<Self, PositionErrorOf<M>> {
        let [input] = M::inputs(start).into();
        let mut table = Self::between(mechanism, start, input + M::Scalar::two_pi())?;
        let ends = [0, N - 1].map(|index| table.entries[index][0]);
        let turns = (ends[1] - ends[0]).map(|way| (way / M::Scalar::two_pi()).round() * M::Scalar::two_pi());
        let rest = (ends[1] - ends[0] - turns).largest();
        let size = M::Scalar::one() + larger(ends[0].largest(), ends[1].largest());
        // False for NaN.
        let is_whole = rest <= ulps::<M::Scalar>(WHOLE_TURN_ULPS) * size;
        if !is_whole {
            return Err(InputError::NotPeriodic { mechanism: mechanism.name() }.into());
        }
        table.advance = Some(turns);
        Ok(table)
    }

    /// Tabulates the inputs from that of the position near `start` to `end`.
    ///
    /// # Errors
    /// [`PositionError::OtherBranch`], [`PositionError::Singular`] or [`PositionError::NotConverged`] if there is a
    /// dead point between, [`PositionError::NotFinite`] if a number is not finite.
    pub fn between(mechanism: &M, start: &M::Coordinates, end: M::Scalar) -> Result<Self, PositionErrorOf<M>> {
        const { assert!(N >= 2, "a table needs at least two entries") };
        let [input] = M::inputs(start).into();
        let intervals = real::<M::Scalar>(count(N - 1));
        let step = (end - input) / intervals;
        let mut table = Self {
            input,
            step,
            inverse_step: M::Scalar::one() / step,
            entries: [[mechanism.dims().0.zeros(); 2]; N],
            advance: None,
            error: M::Scalar::zero(),
        };
        let mut here = closed(mechanism, Reached::at(mechanism, *start), input)?;
        for index in 0..N {
            if index > 0 {
                here = table.follow(mechanism, here, index)?;
            }
            let column = mechanism.jacobian_inputs(&here.pose).column(0);
            let slope = -mechanism.solve_jacobian(&here.pose, &column)? * step;
            table.entries[index] = [M::unknowns(&here.coordinates), slope];
        }
        table.error = table.measured(mechanism)?;
        finite(mechanism.name(), Name::from_static("the input"), [table.input, table.step])?;
        all_finite(
            mechanism.name(),
            Name::from_static("velocity ratios"),
            table.entries.as_flattened().iter().flatten(),
        )?;
        Ok(table)
    }

    /// Returns the largest error of an unknown midway between two entries, where the error of a cubic is largest.
    #[must_use]
    pub fn error(&self) -> M::Scalar {
        self.error
    }

    /// Solves for the position of entry `index`, starting from the entry before.
    fn follow(
        &self,
        mechanism: &M,
        mut here: Reached<M::Coordinates, M::Pose>,
        index: usize,
    ) -> Result<Reached<M::Coordinates, M::Pose>, PositionErrorOf<M>> {
        for part in 1..=PARTS {
            let fraction = f64::from(part) / f64::from(PARTS);
            let input = self.input + self.step * real::<M::Scalar>(count(index - 1) + fraction);
            here = closed(mechanism, here, input)?;
        }
        Ok(here)
    }

    /// Measures the interpolation error by the Newton correction midway between entries.
    fn measured(&self, mechanism: &M) -> Result<M::Scalar, PositionErrorOf<M>> {
        (0..N - 1).try_fold(M::Scalar::zero(), |most, index| {
            let unknowns = self.cubic(index, real(0.5));
            let input = self.input + self.step * real::<M::Scalar>(count(index) + 0.5);
            let pose = mechanism.pose_at(&M::coordinates(unknowns, [input].into()));
            Ok(larger(most, correction(mechanism, &pose)?.largest()))
        })
    }

    /// Interpolates u at the fraction `t` between an entry and the next.
    #[inline]
    fn cubic(&self, index: usize, t: M::Scalar) -> PerUnknown<M> {
        let ([u0, s0], [u1, s1]) = (&self.entries[index], &self.entries[index + 1]);
        u0.dim().column(|row| {
            let (way, sum) = (u1[row] - u0[row], s0[row] + s1[row]);
            let cubic = sum - way - way;
            u0[row] + t * (s0[row] + t * ((way - s0[row] - cubic) + t * cubic))
        })
    }
}

impl<M: Mechanism<V = D<1>>, const N: usize> PositionMethod<M> for Table<M, N> {
    type From = Self;
    type Position = Reached<M::Coordinates, M::Pose>;

    /// # Errors
    /// [`InputError::OutOfRange`] if the input is outside the table.
    #[inline]
    fn position(
        mechanism: &M,
        table: &Self,
        inputs: impl Into<M::Inputs>,
    ) -> Result<Self::Position, PositionErrorOf<M>> {
        let [input]: [M::Scalar; 1] = Into::<PerInput<M>>::into(inputs.into()).into();
        let intervals = real::<M::Scalar>(count(N - 1));
        let mut place = (input - table.input) * table.inverse_step;
        let mut advance = None;
        if let Some(of_a_turn) = &table.advance {
            let turns = (place / intervals).floor();
            if !turns.is_zero() {
                place -= turns * intervals;
                advance = Some(*of_a_turn * turns);
            }
        } else if place < M::Scalar::zero() || place > intervals {
            return Err(table.outside(mechanism, input).into());
        }
        // NaN would be converted to index 0.
        let whole = to_f64(place);
        if !whole.is_finite() {
            return Err(PositionError::NotFinite {
                mechanism: mechanism.name(),
                quantity: Name::from_static("the input"),
            });
        }
        let index = (whole as usize).min(N - 2);
        let mut unknowns = table.cubic(index, place - real::<M::Scalar>(count(index)));
        if let Some(advance) = advance {
            unknowns += advance;
        }
        let coordinates = M::coordinates(unknowns, [input].into());
        let reached = Reached::at(mechanism, coordinates);
        finite_position(mechanism, &reached.coordinates, &reached.pose)?;
        Ok(reached)
    }
}

impl<M: Mechanism, const N: usize> Table<M, N> {
    #[cold]
    fn outside(&self, mechanism: &M, input: M::Scalar) -> InputError<M::Name> {
        let [one, other] = [self.input, self.input + self.step * real::<M::Scalar>(count(N - 1))].map(to_f64);
        let (value, least, most) = (to_f64(input), one.min(other), one.max(other));
        InputError::OutOfRange {
            of: Some(mechanism.name()),
            quantity: Name::from_static("the input"),
            value,
            least,
            most,
        }
    }
}

/// Converts an index to a number.
#[inline]
fn count(index: usize) -> f64 {
    index as f64
}

/// Solves for the position at a nearby input, on the same branch.
fn closed<M: Mechanism<V = D<1>>>(
    mechanism: &M,
    from: Reached<M::Coordinates, M::Pose>,
    input: M::Scalar,
) -> Result<Reached<M::Coordinates, M::Pose>, PositionErrorOf<M>> {
    let guess = predicted(mechanism, &from, PerInput::<M>::from([input]).into())?;
    let here = Reached::at(mechanism, newton_any_branch(mechanism, &guess)?.coordinates);
    if mechanism.same_branch(&from.pose, &here.pose) {
        Ok(here)
    } else {
        Err(PositionError::OtherBranch {
            mechanism: mechanism.name(),
            group: other_group(mechanism, &from.pose, &here.pose),
        })
    }
}
