//! The loops of a group as complex numbers, in units in which no product overflows.

use super::dixon::{Guided, power_of_two};
use super::linearized::System;
use super::loops::{Loops, Unknown};
use super::number::{COLUMNS, Number};
use crate::scalar::to_f64;
use crate::{Name, PositionError, Real, real};

/// The least length of a loop, relative to the largest: a product of six does not underflow.
const TINIEST: f64 = 1e-45;

const ONE: Number = Number { re: 1.0, im: 0.0 };

/// The directions t_j; those beyond the last are zero.
type Directions = [Number; COLUMNS - 1];

/// The loops.
pub struct Numbers<const L: usize> {
    /// k and the factors of the directions, each loop divided by a power of two.
    pub rows: [[Number; COLUMNS]; L],
    /// These powers.
    units: [f64; L],
    /// The number of directions.
    pub directions: usize,
    /// The unknown of each direction.
    places: [usize; COLUMNS - 1],
    /// The equations of the loops with lengths.
    equations: [Guided; L],
    /// The guides of the lengths.
    guides: [Guide; L],
    lengths: usize,
    /// True if the determinant can be computed: no product of lengths underflows, and all guides have a direction.
    pub has_determinant: bool,
}

/// The guide of a length s, which adds s d or s d t_j to its loop.
#[derive(Clone, Copy)]
struct Guide {
    /// The unknown that is s.
    place: usize,
    row: usize,
    /// d, divided by a power of two.
    along: Number,
    /// This power.
    scale: f64,
    /// j.
    with: Option<usize>,
}

impl Guide {
    /// d or d t_j, divided by the power of two.
    fn at(&self, directions: &Directions) -> Number {
        self.along * self.with.and_then(|place| directions.get(place)).copied().unwrap_or(ONE)
    }
}

impl<const L: usize> Numbers<L> {
    /// The loops of a group of this mechanism.
    ///
    /// # Errors
    /// [`PositionError::NotFinite`].
    pub fn new<T: Real, S: Name, const N: usize>(
        mechanism: S,
        loops: &Loops<T, L, N>,
        are: &[Unknown<T>; N],
    ) -> Result<Self, PositionError<S>> {
        let mut numbers = Self {
            rows: [[Number::default(); COLUMNS]; L],
            units: [1.0; L],
            directions: 0,
            places: [0; COLUMNS - 1],
            equations: [Guided { row: 0, factor: ONE, is_turning: false }; L],
            guides: [Guide { place: 0, row: 0, along: ONE, scale: 1.0, with: None }; L],
            lengths: 0,
            has_determinant: true,
        };
        let mut columns = [None; N];
        let angles = are.iter().zip(&mut columns).enumerate().filter(|(_, (unknown, _))| **unknown == Unknown::Angle);
        for ((place, (_, column)), to) in angles.zip(&mut numbers.places) {
            *to = place;
            *column = Some(numbers.directions);
            numbers.directions += 1;
        }
        let of_loops = loops.constants.iter().zip(&loops.factors);
        for ((row, unit), (constant, factors)) in numbers.rows.iter_mut().zip(&mut numbers.units).zip(of_loops) {
            let of_directions = factors.iter().zip(&columns).filter(|(_, column)| column.is_some());
            let all = core::iter::once(constant).chain(of_directions.map(|(factor, _)| factor));
            row.iter_mut().zip(all).for_each(|(to, from)| *to = complex(*from));
            if !row.iter().all(|number| number.re.is_finite() && number.im.is_finite()) {
                return Err(PositionError::NotFinite { mechanism, quantity: S::from_static("a length of the loops") });
            }
            let scale = power_of_two(row.iter().map(size).fold(0.0, f64::max));
            if scale > 0.0 {
                // Not by the reciprocal, which overflows for the smallest numbers.
                row.iter_mut().for_each(|number| *number = Number::new(number.re / scale, number.im / scale));
                *unit = scale;
            }
            numbers.has_determinant &= row.iter().all(|number| *number == Number::default() || size(number) >= TINIEST);
        }
        for (place, unknown) in are.iter().enumerate() {
            let Unknown::Length { in_loop: row, along, with } = *unknown else { continue };
            let along = complex(along);
            if !(along.re.is_finite() && along.im.is_finite()) {
                return Err(PositionError::NotFinite {
                    mechanism,
                    quantity: S::from_static("the direction of a guide"),
                });
            }
            let scale = power_of_two(size(&along));
            numbers.has_determinant &= scale > 0.0;
            let last = numbers.lengths;
            let (Some(equation), Some(guide)) = (numbers.equations.get_mut(last), numbers.guides.get_mut(last)) else {
                break;
            };
            let along = if scale > 0.0 { Number::new(along.re / scale, along.im / scale) } else { Number::default() };
            *equation = Guided { row, factor: along.conj(), is_turning: with.is_some() };
            let with = with.and_then(|place| columns.get(place).copied().flatten());
            *guide = Guide { place, row, along, scale, with };
            numbers.lengths += 1;
        }
        Ok(numbers)
    }

    /// The equations of the loops with lengths.
    pub fn equations(&self) -> &[Guided] {
        self.equations.get(..self.lengths).unwrap_or_default()
    }

    fn guides(&self) -> impl Iterator<Item = &Guide> {
        self.guides.iter().take(self.lengths)
    }

    /// The unit of an unknown length: that of its loop, divided by the size of d.
    pub fn unit(&self, place: usize) -> f64 {
        let guide = self.guides().find(|guide| guide.place == place);
        guide.map_or(1.0, |guide| self.units.get(guide.row).copied().unwrap_or(1.0) / guide.scale)
    }

    /// The direction that must be kept, from 1: the one with which guides turn.
    pub fn turning(&self) -> Option<usize> {
        self.guides().find_map(|guide| guide.with).map(|place| place + 1)
    }

    /// The equations of the loops in the angles of the directions.
    pub fn system(&self) -> System {
        System::new(&self.rows, self.equations(), self.turning().map(|place| place - 1), self.directions)
    }

    /// The angles of these directions, and the lengths with which the loops are closed.
    pub fn values<T: Real, const N: usize>(&self, directions: &Directions) -> [T; N] {
        let mut values = [T::zero(); N];
        for (place, direction) in self.places.iter().zip(directions).take(self.directions) {
            if let Some(value) = values.get_mut(*place) {
                *value = real::<T>(direction.im).arctangent2(real(direction.re));
            }
        }
        for guide in self.guides() {
            if let Some(value) = values.get_mut(guide.place) {
                *value = real(self.length(guide, directions) * self.unit(guide.place));
            }
        }
        values
    }

    /// s of a guide, in its unit: the sum of the other links plus s d is zero, and s is real.
    fn length(&self, guide: &Guide, directions: &Directions) -> f64 {
        let sum = self.rows.get(guide.row).map_or(Number::default(), |row| sum(row, directions));
        let along = guide.at(directions);
        let square = along.norm_sqr();
        if square > 0.0 { -(sum * along.conj()).re / square } else { 0.0 }
    }

    /// The largest residual of a loop at these directions, relative to the sum of its links.
    pub fn residual(&self, directions: &Directions) -> f64 {
        let of_row = |(place, row): (usize, &[Number; COLUMNS])| {
            let terms = row[1..].iter().zip(directions).map(|(factor, direction)| (factor * direction).l1_norm());
            let (total, size) = (sum(row, directions), row[0].l1_norm() + terms.sum::<f64>());
            let slides = self.guides().filter(|guide| guide.row == place);
            let (total, size) = slides.fold((total, size), |(total, size), guide| {
                let part = guide.at(directions) * self.length(guide, directions);
                (total + part, size + part.l1_norm())
            });
            total.l1_norm() / size
        };
        self.rows.iter().enumerate().map(of_row).fold(0.0, f64::max)
    }
}

/// k + sum_j c_j t_j
fn sum(row: &[Number; COLUMNS], directions: &Directions) -> Number {
    row[0] + row[1..].iter().zip(directions).map(|(factor, direction)| factor * direction).sum::<Number>()
}

fn complex<T: Real>([re, im]: [T; 2]) -> Number {
    Number::new(to_f64(re), to_f64(im))
}

fn size(number: &Number) -> f64 {
    number.re.abs().max(number.im.abs())
}
