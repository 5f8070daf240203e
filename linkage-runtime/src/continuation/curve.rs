//! The curve Psi(q) = 0 in pure numbers: angles in radians, other coordinates beside their size, closures beside the
//! sum of the magnitudes of their terms.

use nalgebra::{SMatrix, SVector};

use super::tangent::Elimination;
use super::vector::Vector;
use crate::scalar::to_f64;
use crate::{Error, Mechanism, Real, real};

/// A residual of this many roundings of its terms is zero.
const ROUNDINGS: f64 = 4.0;

/// Newton steps of one correction: each at least halves the distance, from a fair prediction it squares it.
const MOST_CORRECTIONS: usize = 12;

/// A mechanism and the sizes of its coordinates.
#[derive(Debug)]
pub(super) struct Curve<'a, M, T, const U: usize> {
    pub(super) mechanism: &'a M,
    sizes: Vector<T, U>,
}

impl<M, T: Copy, const U: usize> Clone for Curve<'_, M, T, U> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<M, T: Copy, const U: usize> Copy for Curve<'_, M, T, U> {}

/// Psi and [J A] at a position.
pub(super) struct Linear<T, const U: usize> {
    pub(super) residual: SVector<T, U>,
    /// What rounding alone makes of each residual.
    pub(super) noise: SVector<T, U>,
    pub(super) unknowns: SMatrix<T, U, U>,
    pub(super) input: SVector<T, U>,
    rows: SVector<T, U>,
}

/// Why a step was not taken.
#[derive(Debug, Clone, Copy)]
pub(super) struct Refusal {
    pub(super) residual: f64,
    pub(super) regularity: f64,
}

/// What came of a trial; an error ends all of them.
pub(super) type Tried<X> = Result<Result<X, Refusal>, Error>;

impl<'a, M, T, const U: usize> Curve<'a, M, T, U>
where
    T: Real,
    M: Mechanism<T, U, 1>,
{
    pub(super) fn new(mechanism: &'a M, q: &M::Coordinates) -> Self {
        let pose = mechanism.pose_at(q);
        let (sums, here) = (mechanism.closure_sizes(&pose), coordinates::<M, T, U>(q));
        // A length as long as the terms of the closures that it stands in.
        let size = |column: &SVector<T, U>, value: T| {
            let reach = column.iter().zip(sums.iter()).filter(|(slope, _)| !slope.is_zero());
            let reach = reach.map(|(slope, sum)| *sum / slope.abs()).filter(|size| *size > T::zero());
            let least = reach.fold(None, |least, size| Some(least.map_or(size, |least: T| least.min(size))));
            match least.filter(T::is_finite) {
                Some(size) => size,
                None if value.is_zero() => T::one(),
                None => value.abs(),
            }
        };
        let (j, a) = (mechanism.jacobian_unknowns(&pose), mechanism.jacobian_inputs(&pose));
        let mut sizes = Vector { unknowns: SVector::from_element(T::one()), input: T::one() };
        for (place, is_angle) in M::UNKNOWN_ANGLES.into_iter().enumerate() {
            if !is_angle {
                sizes.unknowns[place] = size(&j.column(place).into_owned(), here.unknowns[place]);
            }
        }
        if M::INPUT_ANGLES != [true] {
            sizes.input = size(&a.column(0).into_owned(), here.input);
        }
        Self { mechanism, sizes }
    }

    /// q moved along a vector.
    pub(super) fn moved(&self, q: &M::Coordinates, by: &Vector<T, U>) -> M::Coordinates {
        of_vector::<M, T, U>(q, &(coordinates::<M, T, U>(q) + by.scaled(&self.sizes)))
    }

    pub(super) fn difference(&self, to: &M::Coordinates, from: &M::Coordinates) -> Vector<T, U> {
        (coordinates::<M, T, U>(to) - coordinates::<M, T, U>(from)).beside(&self.sizes)
    }

    /// A direction, as rates of the coordinates.
    pub(super) fn rates(&self, q: &M::Coordinates, direction: &Vector<T, U>) -> M::Coordinates {
        of_vector::<M, T, U>(q, &direction.scaled(&self.sizes))
    }

    pub(super) fn direction(&self, rates: &M::Coordinates) -> Vector<T, U> {
        coordinates::<M, T, U>(rates).beside(&self.sizes)
    }

    pub(super) fn with_input(q: &M::Coordinates, input: T) -> M::Coordinates {
        M::with_inputs(q, SVector::<T, 1>::from([input]))
    }

    pub(super) fn input(q: &M::Coordinates) -> T {
        M::inputs(q)[0]
    }

    /// A distance of the input beside its size.
    pub(super) fn input_distance(&self, distance: T) -> T {
        distance / self.sizes.input
    }

    /// What rounding makes of the coordinates.
    pub(super) fn rounding(&self, q: &M::Coordinates) -> T {
        (T::one() + coordinates::<M, T, U>(q).beside(&self.sizes).largest()) * T::default_epsilon()
    }

    /// # Errors
    /// [`Error::NotFinite`] if a number is not finite.
    pub(super) fn linear(&self, q: &M::Coordinates) -> Result<Linear<T, U>, Error> {
        let pose = self.mechanism.pose_at(q);
        let mut residual = self.mechanism.residual(&pose);
        let sums = self.mechanism.closure_sizes(&pose);
        let mut unknowns = self.mechanism.jacobian_unknowns(&pose);
        let mut input = self.mechanism.jacobian_inputs(&pose).column(0).into_owned();
        for (mut column, size) in unknowns.column_iter_mut().zip(self.sizes.unknowns.iter()) {
            column *= *size;
        }
        input *= self.sizes.input;
        let here = coordinates::<M, T, U>(q).beside(&self.sizes);
        let (mut noise, mut rows) = (SVector::<T, U>::zeros(), SVector::<T, U>::zeros());
        for place in 0..U {
            let (mut slopes, mut rounded) = (input[place].abs(), (input[place] * here.input).abs());
            for (slope, value) in unknowns.row(place).iter().zip(here.unknowns.iter()) {
                slopes += slope.abs();
                rounded += (*slope * *value).abs();
            }
            let row = sums[place] + slopes;
            rows[place] = if row > T::zero() { row.recip() } else { T::one() };
            unknowns.row_mut(place).scale_mut(rows[place]);
            input[place] *= rows[place];
            residual[place] *= rows[place];
            noise[place] = (sums[place] + rounded) * rows[place] * T::default_epsilon();
        }
        let is_finite = here.is_finite()
            && residual.iter().chain(noise.iter()).chain(input.iter()).chain(unknowns.iter()).all(T::is_finite);
        if is_finite {
            Ok(Linear { residual, noise, unknowns, input, rows })
        } else {
            Err(Error::NotFinite { mechanism: M::NAME, quantity: "the path" })
        }
    }

    /// The second derivative of Psi along a direction, (Psi_q x)_q x.
    pub(super) fn curvature(&self, q: &M::Coordinates, at: &Linear<T, U>, x: &Vector<T, U>) -> SVector<T, U> {
        let pose = self.mechanism.pose_at(q);
        self.mechanism.gamma(&pose, &self.rates(q, x)).component_mul(&at.rows)
    }

    /// The point of the curve near `guess` in the plane through it across `normal`.
    ///
    /// # Errors
    /// Refused where Newton's method does not contract, or the curve runs along the plane.
    pub(super) fn correct(
        &self,
        guess: M::Coordinates,
        normal: &Vector<T, U>,
    ) -> Tried<(M::Coordinates, Elimination<T, U>)> {
        let (mut q, mut last) = (guess, None::<T>);
        for _ in 0..MOST_CORRECTIONS {
            let at = self.linear(&q)?;
            let elimination = Elimination::new(at.unknowns, at.input);
            let (tangent, part) = (elimination.tangent(), elimination.solve(&-at.residual));
            // [J A; n'] x = -{Psi; n' (q - guess)}, with what has gathered along n by rounding taken off.
            let along = normal.dot(&tangent);
            let drift = normal.dot(&(self.difference(&q, &guess) + part));
            let step = part - tangent * (drift / along);
            let size = step.norm();
            if at.is_closed() {
                // One more step removes what the last one left, if rounding has not made it long.
                let is_short = size <= self.rounding(&q) * real(LAST_STEP);
                return Ok(Ok((if is_short { self.moved(&q, &step) } else { q }, elimination)));
            }
            let contracts = last.is_none_or(|last| size <= last * real(0.5));
            if !(step.is_finite() && contracts && along.abs() > real(LEAST_CROSSING)) {
                let residual = to_f64(at.residual.amax());
                return Ok(Err(Refusal { residual, regularity: to_f64(elimination.regularity()) }));
            }
            q = self.moved(&q, &step);
            last = Some(size);
        }
        Ok(Err(Refusal { residual: f64::NAN, regularity: f64::NAN }))
    }
}

/// The longest last step, in roundings of the coordinates.
const LAST_STEP: f64 = 256.0;

/// The sine of the least angle at which a plane may cut the curve.
const LEAST_CROSSING: f64 = 1.0 / 64.0;

impl<T: Real, const U: usize> Linear<T, U> {
    pub(super) fn is_closed(&self) -> bool {
        let enough = real::<T>(ROUNDINGS);
        self.residual.iter().zip(self.noise.iter()).all(|(residual, noise)| residual.abs() <= *noise * enough)
    }
}

fn coordinates<M: Mechanism<T, U, 1>, T: Real, const U: usize>(q: &M::Coordinates) -> Vector<T, U> {
    Vector { unknowns: M::unknowns(q), input: M::inputs(q)[0] }
}

fn of_vector<M: Mechanism<T, U, 1>, T: Real, const U: usize>(
    q: &M::Coordinates,
    vector: &Vector<T, U>,
) -> M::Coordinates {
    M::with_unknowns(&M::with_inputs(q, SVector::<T, 1>::from([vector.input])), vector.unknowns)
}
