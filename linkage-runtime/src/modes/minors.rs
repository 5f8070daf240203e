//! The determinants of rows of loops in all sets of their columns, with the sizes of their products.

use super::number::{COLUMNS, Number, ONE, ZERO};

/// The determinants of some rows of c.
#[derive(Clone)]
pub struct Minors {
    /// Their number.
    pub rows: usize,
    /// det c[K] for each set K of as many columns, as a set of bits.
    values: [Number; 1 << COLUMNS],
    /// The sums of the sizes of their products.
    sizes: [f64; 1 << COLUMNS],
}

/// A set of columns of c, as bits.
pub type Columns = usize;

impl Minors {
    /// The determinants of these rows, each with k and then the factors of the directions.
    pub fn of<'a>(rows: impl Iterator<Item = &'a [Number; COLUMNS]>, directions: usize) -> Self {
        let (mut values, mut sizes) = ([ZERO; 1 << COLUMNS], [0.0; 1 << COLUMNS]);
        (values[0], sizes[0]) = (ONE, 1.0);
        let mut count = 0;
        // Expansion by the last row, from small sets to large ones.
        for row in rows {
            count += 1;
            let lengths = row.map(|number| number.l1_norm());
            for set in (1..1usize << (directions + 1)).filter(|set| set.count_ones() as usize == count) {
                let mut sign = -1.0;
                for column in (0..=directions).rev().filter(|column| set >> column & 1 == 1) {
                    sign = -sign;
                    values[set] += row[column] * values[set & !(1 << column)] * sign;
                    sizes[set] += lengths[column] * sizes[set & !(1 << column)];
                }
            }
        }
        Self { rows: count, values, sizes }
    }

    /// det c[set]
    pub fn of_set(&self, set: Columns) -> Sized {
        Sized { value: self.values[set], size: self.sizes[set] }
    }

    /// det c[first, set], where `first` is the first column whatever its number.
    pub fn with_first(&self, first: usize, set: Columns) -> Sized {
        let before = (set & ((1 << first) - 1)).count_ones();
        let Sized { value, size } = self.of_set(set | 1 << first);
        Sized { value: value * alternating(before), size }
    }
}

/// A sum of products, and the sum of their sizes: its rounding error is that of the sizes.
#[derive(Clone, Copy)]
pub struct Sized {
    pub value: Number,
    pub size: f64,
}

impl Sized {
    pub fn conj(self) -> Self {
        Self { value: self.value.conj(), ..self }
    }

    pub fn times(self, other: Self) -> Self {
        Self { value: self.value * other.value, size: self.size * other.size }
    }

    pub fn scaled(self, factor: Number) -> Self {
        Self { value: self.value * factor, size: self.size * factor.l1_norm() }
    }
}

/// (-1)^n
pub fn alternating(exponent: u32) -> f64 {
    if exponent.is_multiple_of(2) { 1.0 } else { -1.0 }
}
