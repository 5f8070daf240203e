//! Many positions at once, as columns of numbers: lane by lane, several lanes in one vector instruction.
//!
//! A mechanism with `derive lanes;` computes each position by a function without branches, in a loop that the compiler
//! vectorises. The function also says whether its results are those of the function for one position; if not, that
//! function computes the lane.
//!
//! Inputs may be in any order: each position is that of the branch, for itself. At a change point the branch may jump to
//! another motion; a `RangeOfMotion` stays on one.
//!
//! A lane is accepted if its position, its rates and its accelerations exist, with any columns asked for. It then has the
//! bits of `kinematics`. A rejected lane is one for which `kinematics` returns an error, which [`Batch::lane`] returns;
//! all its found columns are NaN.
//!
//! A point, an output or a derivative of one that does not exist in an accepted lane, as the square root of a negative
//! number, is NaN in its own column and in no other. All other numbers of accepted lanes are finite and have the bits of
//! `full_kinematics`.

use core::fmt::Debug;

use num_traits::Zero;

use crate::{Dim, InputError, PositionError, Real, real};

/// One number for each lane.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Values<'a, T> {
    /// One number for all lanes.
    Same(T),
    /// One for each lane.
    Each(&'a [T]),
}

impl<T> From<T> for Values<'_, T> {
    fn from(value: T) -> Self {
        Self::Same(value)
    }
}

impl<'a, T> From<&'a [T]> for Values<'a, T> {
    fn from(values: &'a [T]) -> Self {
        Self::Each(values)
    }
}

/// An array with an entry for each given column.
pub type Given<M, X> = <<M as Lanes>::Given as Dim>::Array<X>;

/// An array with an entry for each found column.
pub type Found<M, X> = <<M as Lanes>::Found as Dim>::Array<X>;

/// A mechanism that computes many positions at once. `linkage!` implements it for `derive lanes;`.
///
/// The given columns are the parameters; the inputs, or all coordinates of a guess if a group has no closed form; the
/// rates of the inputs; their accelerations. The found columns are the directions of unknown angles, the other unknowns,
/// the rates and the accelerations of all; then, computed only if one of them is asked for, the angles themselves, and
/// the points and outputs with their derivatives.
#[diagnostic::on_unimplemented(
    message = "`{Self}` does not compute many positions at once",
    note = "add `derive lanes;` to its mechanism"
)]
pub trait Lanes: Sized {
    /// The type of lengths and angles.
    type Scalar: Real;
    /// The assembly branch.
    type Branch: Copy + Debug;
    /// The number of given columns.
    type Given: Dim + Default;
    /// The number of found columns.
    type Found: Dim + Default;

    /// The name of the mechanism, as in error messages.
    const NAME: &'static str;
    /// The names of the given columns.
    const GIVEN: &'static [&'static str];
    /// The names of the found columns.
    const FOUND: &'static [&'static str];
    /// The number of parameters, which are the first given columns.
    const PARAMETERS: usize;
    /// The number of inputs, or of coordinates of a guess, which are the next given columns.
    const START: usize;
    /// The number of found columns before those of angles, points and outputs.
    const COORDINATES: usize;

    /// Writes the parameters to the first given columns.
    fn write_parameters(&self, given: &mut Given<Self, Self::Scalar>);
    /// The parameters of one lane of a block.
    fn design<const W: usize>(given: &Given<Self, [Self::Scalar; W]>, lane: usize) -> Self;
    /// Computes one lane of a block without branches, with angles, points and outputs if `QUANTITIES`. False if
    /// [`exact`](Self::exact) has to compute it: always, if a formula needs iteration or a function of a library. A point or
    /// an output that is not finite is no reason for it.
    fn lane<const W: usize, const QUANTITIES: bool>(
        &self,
        given: &Given<Self, [Self::Scalar; W]>,
        branch: Self::Branch,
        lane: usize,
        found: &mut Found<Self, [Self::Scalar; W]>,
    ) -> bool;
    /// Computes one lane by the functions for one position: `kinematics`, and if `QUANTITIES` those of angles, points and
    /// outputs, which are zero otherwise. A point or an output that is not finite is no error.
    ///
    /// # Errors
    /// Those of `kinematics`.
    fn exact<const QUANTITIES: bool>(
        &self,
        given: &Given<Self, Self::Scalar>,
        branch: Self::Branch,
    ) -> Result<Found<Self, Self::Scalar>, PositionError>;
}

/// Positions to compute at once: the given columns and the branch.
#[derive(Debug)]
pub struct Batch<'a, M: Lanes> {
    given: Given<M, Values<'a, M::Scalar>>,
    branch: M::Branch,
    count: usize,
}

impl<M: Lanes> Clone for Batch<'_, M> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<M: Lanes> Copy for Batch<'_, M> {}

impl<'a, M: Lanes> Batch<'a, M> {
    /// Takes the given columns, in the order of [`Lanes::GIVEN`]. If each has the same number for all lanes, there is
    /// one lane.
    ///
    /// # Errors
    /// [`InputError::ColumnLength`] if two columns differ in length.
    pub fn new(given: Given<M, Values<'a, M::Scalar>>, branch: M::Branch) -> Result<Self, InputError> {
        let mut count = None;
        for (values, column) in given.as_ref().iter().zip(M::GIVEN) {
            if let Values::Each(values) = values {
                let expected = *count.get_or_insert(values.len());
                same_length::<M>(column, values.len(), expected)?;
            }
        }
        Ok(Self { given, branch, count: count.unwrap_or(1) })
    }

    /// The number of lanes.
    #[must_use]
    pub fn count(&self) -> usize {
        self.count
    }

    /// Computes all lanes and returns the number of rejected ones.
    ///
    /// `found` is in the order of [`Lanes::FOUND`]; columns that are `None` are not stored, and if no column of a point
    /// or an output is asked for, these are not computed. `accepted` gets false for each lane without a position with
    /// finite rates and accelerations; the found columns of such a lane are NaN. [`lane`](Self::lane) returns its error.
    /// In an accepted lane a column is NaN only where its own number is not finite. So neither the mask nor a column
    /// depends on the other columns asked for.
    ///
    /// # Errors
    /// [`InputError::ColumnLength`] if a column differs in length from the given ones, or if `found` has not one entry
    /// for each of [`Lanes::FOUND`].
    pub fn run(&self, found: &mut [Option<&mut [M::Scalar]>], accepted: &mut [bool]) -> Result<usize, InputError> {
        // 64 bytes, an integer number of registers on every machine.
        match size_of::<M::Scalar>() {
            4 => self.run_by::<16>(found, accepted),
            _ => self.run_by::<8>(found, accepted),
        }
    }

    /// Computes all lanes, as [`run`](Self::run), in blocks of `W` lanes.
    ///
    /// # Errors
    /// Those of [`run`](Self::run).
    pub fn run_by<const W: usize>(
        &self,
        found: &mut [Option<&mut [M::Scalar]>],
        accepted: &mut [bool],
    ) -> Result<usize, InputError> {
        same_length::<M>("found columns", found.len(), M::FOUND.len())?;
        same_length::<M>("accepted", accepted.len(), self.count)?;
        for (values, column) in found.iter().zip(M::FOUND) {
            if let Some(values) = values {
                same_length::<M>(column, values.len(), self.count)?;
            }
        }
        let mut parameters = self.given.as_ref().iter().take(M::PARAMETERS);
        let is_one_design = parameters.all(|values| matches!(values, Values::Same(_)));
        let has_quantities = found.iter().skip(M::COORDINATES).any(Option::is_some);
        // A copy, which nothing else can change: the compiler then sees that the lanes are independent.
        let batch = *self;
        Ok(match (is_one_design, has_quantities) {
            (true, false) => vectorised(
                #[inline(always)]
                move || batch.all::<W, true, false>(found, accepted),
            ),
            (true, true) => vectorised(
                #[inline(always)]
                move || batch.all::<W, true, true>(found, accepted),
            ),
            (false, false) => vectorised(
                #[inline(always)]
                move || batch.all::<W, false, false>(found, accepted),
            ),
            (false, true) => vectorised(
                #[inline(always)]
                move || batch.all::<W, false, true>(found, accepted),
            ),
        })
    }

    /// Computes one lane by the functions for one position, with angles, points and outputs, in the order of
    /// [`Lanes::FOUND`]. A point or an output that does not exist is NaN.
    ///
    /// # Errors
    /// [`PositionError`], the reason for which a lane is rejected. [`InputError::OutOfRange`] if there is no such lane.
    pub fn lane(&self, lane: usize) -> Result<Found<M, M::Scalar>, PositionError> {
        self.alone::<true>(lane)
    }

    /// Computes one lane as [`lane`](Self::lane), without angles, points and outputs, which are zero.
    ///
    /// # Errors
    /// Those of `lane`.
    pub fn lane_of_coordinates(&self, lane: usize) -> Result<Found<M, M::Scalar>, PositionError> {
        self.alone::<false>(lane)
    }

    fn alone<const QUANTITIES: bool>(&self, lane: usize) -> Result<Found<M, M::Scalar>, PositionError> {
        if lane >= self.count {
            let (value, most) = (lane as f64, self.count as f64 - 1.0);
            return Err(
                InputError::OutOfRange { of: Some(M::NAME), quantity: "the lane", value, least: 0.0, most }.into()
            );
        }
        exact::<M, QUANTITIES>(self.block::<1>(lane), self.branch)
    }

    /// The given numbers of `W` lanes from one on; where there is no such lane, those of another.
    #[inline(always)]
    fn block<const W: usize>(&self, from: usize) -> Given<M, [M::Scalar; W]> {
        let mut given = <M::Given as Dim>::map(self.given, |values| match values {
            Values::Same(value) => [value; W],
            Values::Each(values) => [values.first().copied().unwrap_or_else(M::Scalar::zero); W],
        });
        self.next_block(from, &mut given);
        given
    }

    /// Replaces the numbers that differ from lane to lane by those of the lanes from one on, as [`block`](Self::block).
    #[inline(always)]
    fn next_block<const W: usize>(&self, from: usize, given: &mut Given<M, [M::Scalar; W]>) {
        for (values, block) in self.given.as_ref().iter().zip(given.as_mut()) {
            if let Values::Each(values) = values {
                match values.get(from..).and_then(<[M::Scalar]>::first_chunk) {
                    Some(next) => *block = *next,
                    None => {
                        let rest = values.get(from..).unwrap_or_default();
                        block.iter_mut().zip(rest).for_each(|(place, value)| *place = *value);
                    }
                }
            }
        }
    }

    /// Computes all lanes block by block.
    #[inline(always)]
    fn all<const W: usize, const IS_ONE_DESIGN: bool, const QUANTITIES: bool>(
        &self,
        found: &mut [Option<&mut [M::Scalar]>],
        accepted: &mut [bool],
    ) -> usize {
        // Local copies, for the same reason.
        let (branch, first) = (self.branch, self.block::<1>(0));
        let mut given = self.block::<W>(0);
        let mut values = M::Found::default().array(|_| [M::Scalar::zero(); W]);
        let mut rejected = 0;
        for (number, accepted) in accepted.chunks_mut(W).enumerate() {
            let from = number * W;
            self.next_block(from, &mut given);
            let mut is_found = [false; W];
            // The compiler vectorises this loop.
            for (lane, is_found) in is_found.iter_mut().enumerate() {
                let design = if IS_ONE_DESIGN { M::design(&first, 0) } else { M::design(&given, lane) };
                *is_found = design.lane::<W, QUANTITIES>(&given, branch, lane, &mut values);
            }
            if is_found != [true; W] {
                let missing = is_found.iter_mut().enumerate().take(accepted.len()).filter(|(_, is_found)| !**is_found);
                for (lane, is_found) in missing {
                    *is_found = self.computed_alone::<W, QUANTITIES>(&given, lane, &mut values);
                    rejected += usize::from(!*is_found);
                }
            }
            accepted.iter_mut().zip(is_found).for_each(|(accepted, is_found)| *accepted = is_found);
            for (number, (column, values)) in found.iter_mut().zip(values.as_ref()).enumerate() {
                if let Some(column) = column.as_mut().and_then(|column| column.get_mut(from..)) {
                    // The coordinates of an accepted lane are finite.
                    let values = if number < M::COORDINATES { *values } else { values.map(existing) };
                    match column.first_chunk_mut::<W>() {
                        Some(column) => *column = values,
                        None => column.iter_mut().zip(values).for_each(|(place, value)| *place = value),
                    }
                }
            }
        }
        rejected
    }

    /// Computes one lane of a block by the function for one position; NaN and false if it returns an error.
    #[cold]
    #[inline(never)]
    fn computed_alone<const W: usize, const QUANTITIES: bool>(
        &self,
        given: &Given<M, [M::Scalar; W]>,
        lane: usize,
        values: &mut Found<M, [M::Scalar; W]>,
    ) -> bool {
        let alone = <M::Given as Dim>::map(*given, |block| [block.get(lane).copied().unwrap_or_else(M::Scalar::zero)]);
        let found = exact::<M, QUANTITIES>(alone, self.branch);
        let is_found = found.is_ok();
        let found = found.unwrap_or_else(|_| M::Found::default().array(|_| real(f64::NAN)));
        for (column, value) in values.as_mut().iter_mut().zip(found) {
            if let Some(place) = column.get_mut(lane) {
                *place = value;
            }
        }
        is_found
    }
}

/// One lane by the functions for one position.
fn exact<M: Lanes, const QUANTITIES: bool>(
    given: Given<M, [M::Scalar; 1]>,
    branch: M::Branch,
) -> Result<Found<M, M::Scalar>, PositionError> {
    let design = M::design(&given, 0);
    let found = design.exact::<QUANTITIES>(&<M::Given as Dim>::map(given, |[value]| value), branch)?;
    Ok(<M::Found as Dim>::map(found, existing))
}

/// A number, or NaN if it is not finite: what does not exist is the same in all columns.
#[inline(always)]
fn existing<T: Real>(value: T) -> T {
    if value.is_finite() { value } else { real(f64::NAN) }
}

/// Runs a loop with the vector instructions that the machine has.
#[inline(always)]
fn vectorised<R>(run: impl FnOnce() -> R) -> R {
    #[cfg(all(feature = "simd", any(target_arch = "x86", target_arch = "x86_64")))]
    {
        use fearless_simd::Simd;
        let level = fearless_simd::Level::new();
        if let Some(avx512) = level.as_avx512() {
            return avx512.vectorize(run);
        }
        if let Some(avx2) = level.as_avx2() {
            return avx2.vectorize(run);
        }
    }
    // Every other machine has the instructions of its target only.
    run()
}

/// Returns an error if a column has another length than expected.
fn same_length<M: Lanes>(column: &'static str, length: usize, expected: usize) -> Result<(), InputError> {
    if length == expected {
        Ok(())
    } else {
        Err(InputError::ColumnLength { mechanism: M::NAME, column, length, expected })
    }
}
