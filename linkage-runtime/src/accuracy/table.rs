//! Position from a table.

use nalgebra::{ComplexField, SVector};

use super::newton::predicted;
use super::{Method, Reached};
use crate::error::all_finite;
use crate::mechanism::{finite_position, other_group};
use crate::scalar::{larger, largest, to_f64};
use crate::{Error, Mechanism, Real, finite, newton, real};

/// Positions of a mechanism with one input at `N` of its values, evenly spaced, and between them the cubics that have
/// its velocity ratios as slopes (Hermite); no memory but its own 2 `U` `N` numbers.
///
/// Between two entries h apart a cubic is off by h^4/384 times the fourth derivative: twice as many entries, a
/// sixteenth of the error. What it is, is measured when the table is made: [`Table::error`].
///
/// ```text
/// u = u0 + t (s0 + t (3 d - 2 s0 - s1 + t (s0 + s1 - 2 d))),   d = u1 - u0, s = h W, t = (v - v0)/h
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Table<Q, T, const U: usize, const N: usize> {
    first: Q,
    input: T,
    step: T,
    inverse_step: T,
    /// u and h W.
    entries: [[SVector<T, U>; 2]; N],
    /// What a turn adds to u, if the table is one.
    advance: Option<SVector<T, U>>,
    error: T,
}

/// Parts into which the way from entry to entry is divided when it is followed.
const PARTS: u32 = 8;

/// A turn adds whole turns to each angle and nothing to a length, to this many roundings of what is added.
const ROUNDINGS: f64 = 1e4;

impl<Q: Copy, T: Real, const U: usize, const N: usize> Table<Q, T, U, N> {
    /// Over a whole turn of the input, from these coordinates, which close the mechanism; outside it the turn repeats.
    ///
    /// # Errors
    /// [`Error::NotPeriodic`] if a turn does not lead back; those of [`Table::between`].
    pub fn turn<M: Mechanism<T, U, 1, Coordinates = Q>>(mechanism: &M, start: &Q) -> Result<Self, Error> {
        let [input]: [T; 1] = M::inputs(start).into();
        let mut table = Self::between(mechanism, start, input + T::two_pi())?;
        let ends = [0, N - 1].map(|index| table.entries[index][0]);
        let turns = (ends[1] - ends[0]).map(|way| (way / T::two_pi()).round() * T::two_pi());
        let rest = largest((ends[1] - ends[0] - turns).iter().copied());
        let size = T::one() + largest(ends[0].iter().chain(ends[1].iter()).copied());
        // What is not a number is no whole turn.
        let is_whole = rest <= real::<T>(ROUNDINGS) * T::default_epsilon() * size;
        if !is_whole {
            return Err(Error::NotPeriodic { mechanism: M::NAME });
        }
        table.advance = Some(turns);
        Ok(table)
    }

    /// From these coordinates, which close the mechanism, to another value of the input.
    ///
    /// # Errors
    /// [`Error::OtherBranch`], [`Error::Singular`] or [`Error::NotConverged`] if there is a dead point on the way,
    /// [`Error::NotFinite`] if a number is not finite.
    pub fn between<M: Mechanism<T, U, 1, Coordinates = Q>>(mechanism: &M, start: &Q, end: T) -> Result<Self, Error> {
        const { assert!(N >= 2, "a table has two entries at least") };
        let [input]: [T; 1] = M::inputs(start).into();
        let intervals = real::<T>(count(N - 1));
        let step = (end - input) / intervals;
        let mut table = Self {
            first: *start,
            input,
            step,
            inverse_step: T::one() / step,
            entries: [[SVector::zeros(); 2]; N],
            advance: None,
            error: T::zero(),
        };
        let mut here = closed(mechanism, Reached::at(mechanism, *start), input)?;
        for index in 0..N {
            if index > 0 {
                here = table.follow(mechanism, here, index)?;
            }
            let column = mechanism.jacobian_inputs(&here.pose).column(0).into_owned();
            let slope = -mechanism.solve_jacobian(&here.pose, &column)? * step;
            table.entries[index] = [M::unknowns(&here.coordinates), slope];
        }
        table.error = table.measured(mechanism)?;
        finite(M::NAME, "the input", [table.input, table.step])?;
        all_finite(M::NAME, "velocity ratios", table.entries.as_flattened().iter().flatten())?;
        Ok(table)
    }

    /// The largest error of an unknown half way between two entries, where that of a cubic is largest.
    #[must_use]
    pub fn error(&self) -> T {
        self.error
    }

    /// From the entry before `index` to that one.
    fn follow<M: Mechanism<T, U, 1, Coordinates = Q>>(
        &self,
        mechanism: &M,
        mut here: Reached<Q, M::Pose>,
        index: usize,
    ) -> Result<Reached<Q, M::Pose>, Error> {
        for part in 1..=PARTS {
            let fraction = f64::from(part) / f64::from(PARTS);
            let input = self.input + self.step * real::<T>(count(index - 1) + fraction);
            here = closed(mechanism, here, input)?;
        }
        Ok(here)
    }

    /// As much as a Newton step corrects half way between entries.
    fn measured<M: Mechanism<T, U, 1, Coordinates = Q>>(&self, mechanism: &M) -> Result<T, Error> {
        (0..N - 1).try_fold(T::zero(), |most, index| {
            let unknowns = self.cubic(index, real(0.5));
            let input = self.input + self.step * real::<T>(count(index) + 0.5);
            let pose = mechanism.pose_at(&self.coordinates::<M>(unknowns, input));
            let correction = mechanism.solve_jacobian(&pose, &mechanism.residual(&pose))?;
            Ok(larger(most, largest(correction.iter().copied())))
        })
    }

    #[inline]
    fn coordinates<M: Mechanism<T, U, 1, Coordinates = Q>>(&self, unknowns: SVector<T, U>, input: T) -> Q {
        M::with_inputs(&M::with_unknowns(&self.first, unknowns), SVector::<T, 1>::new(input))
    }

    /// u at the fraction `t` of the way from an entry to the next.
    #[inline]
    fn cubic(&self, index: usize, t: T) -> SVector<T, U> {
        let ([u0, s0], [u1, s1]) = (&self.entries[index], &self.entries[index + 1]);
        SVector::from_fn(|row, _| {
            let (way, sum) = (u1[row] - u0[row], s0[row] + s1[row]);
            let cubic = sum - way - way;
            u0[row] + t * (s0[row] + t * ((way - s0[row] - cubic) + t * cubic))
        })
    }
}

impl<M, T, Q, const U: usize, const N: usize> Method<M, T, U, 1> for Table<Q, T, U, N>
where
    M: Mechanism<T, U, 1, Coordinates = Q>,
    T: Real,
    Q: Copy,
{
    type From = Self;
    type Position = Reached<Q, M::Pose>;

    /// # Errors
    /// [`Error::OutsideTable`] if the table does not go as far as this input.
    #[inline]
    fn position(mechanism: &M, table: &Self, inputs: impl Into<M::Inputs>) -> Result<Self::Position, Error> {
        let [input]: [T; 1] = inputs.into().into().into();
        let intervals = real::<T>(count(N - 1));
        let mut place = (input - table.input) * table.inverse_step;
        let mut advance = None;
        if let Some(of_a_turn) = &table.advance {
            let turns = (place / intervals).floor();
            if !turns.is_zero() {
                place -= turns * intervals;
                advance = Some(of_a_turn * turns);
            }
        } else if place < T::zero() || place > intervals {
            return Err(table.outside(M::NAME, input));
        }
        // What is not a number is found before it is an index.
        let whole = to_f64(place);
        if !ComplexField::is_finite(&whole) {
            return Err(Error::NotFinite { mechanism: M::NAME, quantity: "the input" });
        }
        let index = (whole as usize).min(N - 2);
        let mut unknowns = table.cubic(index, place - real::<T>(count(index)));
        if let Some(advance) = advance {
            unknowns += advance;
        }
        let coordinates = table.coordinates::<M>(unknowns, input);
        let reached = Reached::at(mechanism, coordinates);
        finite_position::<M, T, U, 1>(&reached.coordinates, &reached.pose)?;
        Ok(reached)
    }
}

impl<Q, T: Real, const U: usize, const N: usize> Table<Q, T, U, N> {
    #[cold]
    fn outside(&self, mechanism: &'static str, input: T) -> Error {
        let ends = [self.input, self.input + self.step * real::<T>(count(N - 1))].map(to_f64);
        Error::OutsideTable { mechanism, input: to_f64(input), range: [ends[0].min(ends[1]), ends[0].max(ends[1])] }
    }
}

/// An index as a number.
#[inline]
fn count(index: usize) -> f64 {
    index as f64
}

/// The closed position at another input, near one.
fn closed<M, T, const U: usize>(
    mechanism: &M,
    from: Reached<M::Coordinates, M::Pose>,
    input: T,
) -> Result<Reached<M::Coordinates, M::Pose>, Error>
where
    M: Mechanism<T, U, 1>,
    T: Real,
{
    let guess = predicted(mechanism, &from, SVector::<T, 1>::new(input).into())?;
    let here = Reached::at(mechanism, newton(mechanism, &guess)?.coordinates);
    if mechanism.same_branch(&from.pose, &here.pose) {
        Ok(here)
    } else {
        Err(Error::OtherBranch { mechanism: M::NAME, group: other_group(mechanism, &from.pose, &here.pose) })
    }
}
