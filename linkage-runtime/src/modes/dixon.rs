//! The Dixon determinant of a group of L loops of 2 L links whose directions are unknown.
//!
//! The loops are k_i + sum_j c_ij t_j = 0 with unit complex numbers t_j, so that their conjugates are
//! conj(k_i) + sum_j conj(c_ij) / t_j = 0. One direction x is kept. With W(x) below, W t = 0 at every position, where the
//! entries of t are the products of 1 / t_j over the sets of L and of L - 1 of the other 2 L - 1 directions:
//!
//! ```text
//! W = [ D0 + x D1      B^T     ]      D, E diagonal; W is symmetric, of size C(2 L, L) = 6, 20
//!     [     B       E0 + E1/x  ]
//!
//! D0[K] = s det c[0, K'] det conj c[K]         D1[K] = s det c[x, K'] det conj c[K]         K of L directions
//! E0[K] = s det c[K'] det conj c[0, K]         E1[K] = s det c[K'] det conj c[x, K]         K of L - 1 directions
//! B[K, K + j] = s det c[K'] det conj c[j, K]   j in K'
//! ```
//!
//! K' is the complement of K, column 0 of c is k, and s is the sign of the Laplace expansion. On the unit circle det W
//! is a real trigonometric polynomial up to a factor 1, i, -1 or -i.
//!
//! C. W. Wampler, "Solving the kinematics of planar mechanisms by Dixon determinant and a complex-plane formulation",
//! Journal of Mechanical Design 123, 2001.

use super::minors::{Columns, Minors, Sized, alternating};
use super::number::{COLUMNS, Number, ONE, ZERO};

/// The holomorphic and the antiholomorphic columns of one choice.
struct Columnwise {
    holomorphic: Minors,
    /// The determinants of the conjugates of the antiholomorphic columns.
    conjugate: Minors,
    /// The product of the factors of the equations with a length, with the sign of the order of their columns.
    factor: Number,
    /// The power of x in it.
    power: i32,
}

impl Columnwise {
    /// The columns of a choice: bit i is set if the part of the equation i with a length is holomorphic.
    fn of(rows: &[[Number; COLUMNS]], guided: &[Guided], directions: usize, choice: usize) -> Self {
        let plain =
            || rows.iter().enumerate().filter(|(row, _)| guided.iter().all(|one| one.row != *row)).map(|(_, row)| row);
        let chosen = |is_holomorphic: bool| {
            let of_choice = move |(place, _): &(usize, &Guided)| (choice >> place & 1 == 1) == is_holomorphic;
            guided.iter().enumerate().filter(of_choice).filter_map(|(_, one)| rows.get(one.row))
        };
        let (mut factor, mut power, mut conjugates) = (ONE, 0, 0);
        for (place, one) in guided.iter().enumerate() {
            let turn = i32::from(one.is_turning);
            if choice >> place & 1 == 1 {
                // It passes the antiholomorphic columns before it.
                factor *= one.factor * alternating(conjugates);
                power -= turn;
            } else {
                factor *= -one.factor.conj();
                power += turn;
                conjugates += 1;
            }
        }
        let holomorphic = Minors::of(plain().chain(chosen(true)), directions);
        let conjugate = match guided {
            [] => holomorphic.clone(),
            _ => Minors::of(chosen(false).chain(plain()), directions),
        };
        Self { holomorphic, conjugate, factor, power }
    }

    /// The sign of the Laplace expansion by the holomorphic columns with these rows, and of the antiholomorphic columns
    /// with this many rows of the other directions; times the factor.
    fn sign(&self, rows: usize, others: usize) -> Number {
        let columns = self.holomorphic.rows * self.holomorphic.rows.saturating_sub(1) / 2;
        self.factor * alternating((rows + columns + others) as u32)
    }
}

/// An equation with a length s along d, h L - conj(h L) with h = conj d: L without its term s d, where s is real.
#[derive(Debug, Clone, Copy)]
pub struct Guided {
    /// The loop, from 0.
    pub row: usize,
    /// h.
    pub factor: Number,
    /// True if the guide turns with x: h is then divided by x.
    pub is_turning: bool,
}

/// A term of W: a number times a power of x.
#[derive(Debug, Clone, Copy)]
struct Term {
    row: usize,
    column: usize,
    power: i32,
    value: Number,
    /// The sum of the sizes of the products in it.
    size: f64,
}

impl Term {
    /// Adds the term and its mirror image.
    fn add_to<const SIZE: usize>(&self, matrix: &mut [[Number; SIZE]; SIZE], power: Number) {
        let part = self.value * power;
        matrix[self.row][self.column] += part;
        if self.row != self.column {
            matrix[self.column][self.row] += part;
        }
    }
}

/// The most terms of W: 70 of three loops without lengths.
const TERMS: usize = 96;

/// The largest power of x: of three loops whose guides all turn, 3 and one more.
const MOST_POWER: usize = 4;

/// W, with room for `SIZE` rows.
pub struct Dixon<const SIZE: usize> {
    /// The number of directions.
    directions: usize,
    /// The place of x among them, from 1.
    kept: usize,
    /// The set of directions of each row.
    sets: [Columns; SIZE],
    size: usize,
    /// The terms, those off the diagonal once.
    terms: [Term; TERMS],
    count: usize,
    /// The sum of the terms without x.
    constant: [[Number; SIZE]; SIZE],
    /// The factor of each row and column that balances the matrix.
    balance: [f64; SIZE],
    /// The sum of the sizes of the terms of each row.
    sizes: [f64; SIZE],
}

impl<const SIZE: usize> Dixon<SIZE> {
    /// W of loops of this many directions, with the direction `kept`, from 1, as x; `None` if it has too many terms.
    ///
    /// A loop with a length gives one equation instead of two, the sum of a holomorphic and an antiholomorphic column.
    /// The determinant is the sum over the choices of one of both in each.
    pub fn new(rows: &[[Number; COLUMNS]], guided: &[Guided], directions: usize, kept: usize) -> Option<Self> {
        let none = Term { row: 0, column: 0, power: 0, value: ZERO, size: 0.0 };
        let mut dixon = Self {
            directions,
            kept,
            sets: [0; SIZE],
            size: 0,
            terms: [none; TERMS],
            count: 0,
            constant: [[ZERO; SIZE]; SIZE],
            balance: [1.0; SIZE],
            sizes: [0.0; SIZE],
        };
        for choice in 0..1usize << guided.len() {
            dixon.add(&Columnwise::of(rows, guided, directions, choice))?;
        }
        dixon.drop_zeros();
        dixon.balance();
        let mut constant = [[ZERO; SIZE]; SIZE];
        dixon.terms().iter().filter(|term| term.power == 0).for_each(|term| term.add_to(&mut constant, ONE));
        dixon.constant = constant;
        let mut sizes = [0.0; SIZE];
        for term in dixon.terms() {
            sizes[term.row] += term.size;
            if term.row != term.column {
                sizes[term.column] += term.size;
            }
        }
        dixon.sizes = sizes;
        Some(dixon)
    }

    /// Adds the terms of one choice.
    fn add(&mut self, columns: &Columnwise) -> Option<()> {
        let others = ((1 << (self.directions + 1)) - 2) & !(1 << self.kept);
        let [holomorphic, conjugate] = [&columns.holomorphic, &columns.conjugate];
        let all = 0..1usize << (self.directions + 1);
        let of_size =
            |count: usize| all.clone().filter(move |set| set & !others == 0 && set.count_ones() as usize == count);
        for set in of_size(conjugate.rows) {
            let complement = others & !set;
            let sign = columns.sign(self.row_sum(complement), conjugate.rows);
            let factor = conjugate.of_set(set).conj().scaled(sign);
            let row = self.row(set)?;
            self.push(row, row, columns.power, holomorphic.with_first(0, complement).times(factor))?;
            self.push(row, row, columns.power + 1, holomorphic.with_first(self.kept, complement).times(factor))?;
        }
        let Some(fewer) = conjugate.rows.checked_sub(1) else { return Some(()) };
        for set in of_size(fewer) {
            let complement = others & !set;
            let factor = holomorphic.of_set(complement).scaled(columns.sign(self.row_sum(complement), fewer));
            let row = self.row(set)?;
            self.push(row, row, columns.power, conjugate.with_first(0, set).conj().times(factor))?;
            self.push(row, row, columns.power - 1, conjugate.with_first(self.kept, set).conj().times(factor))?;
            for added in (1..=self.directions).filter(|column| complement >> column & 1 == 1) {
                let column = self.row(set | 1 << added)?;
                self.push(row, column, columns.power, conjugate.with_first(added, set).conj().times(factor))?;
            }
        }
        Some(())
    }

    /// The sum of the numbers of the rows of a set: the directions other than x are rows 1, 2, ….
    fn row_sum(&self, set: Columns) -> usize {
        let row = |column: usize| if column > self.kept { column - 1 } else { column };
        (1..=self.directions).filter(|column| set >> column & 1 == 1).map(row).sum()
    }

    /// The row of a set.
    fn row(&mut self, set: Columns) -> Option<usize> {
        let known = self.sets.iter().take(self.size).position(|other| *other == set);
        if known.is_none() {
            *self.sets.get_mut(self.size)? = set;
            self.size += 1;
        }
        Some(known.unwrap_or(self.size - 1))
    }

    fn push(&mut self, row: usize, column: usize, power: i32, Sized { value, size }: Sized) -> Option<()> {
        if value != ZERO {
            *self.terms.get_mut(self.count)? = Term { row, column, power, value, size };
            self.count += 1;
        }
        Some(())
    }

    fn terms(&self) -> &[Term] {
        &self.terms[..self.count]
    }

    /// Leaves out the rows that are zero.
    fn drop_zeros(&mut self) {
        let mut places = [None; SIZE];
        let mut kept = 0;
        for (row, place) in places.iter_mut().enumerate().take(self.size) {
            if self.terms().iter().any(|term| term.row == row || term.column == row) {
                *place = Some(kept);
                self.sets[kept] = self.sets[row];
                kept += 1;
            }
        }
        self.size = kept;
        for term in &mut self.terms[..self.count] {
            let [row, column] = [term.row, term.column].map(|place| places[place].unwrap_or_default());
            (term.row, term.column) = (row, column);
        }
    }

    /// Powers of two that bring the largest entry of each row near 1: twice by the root of the largest.
    fn balance(&mut self) {
        for _ in 0..2 {
            let mut largest = [0.0_f64; SIZE];
            for term in self.terms() {
                for place in [term.row, term.column] {
                    largest[place] = largest[place].max(term.value.l1_norm());
                }
            }
            let factors = largest.map(|largest| if largest > 0.0 { power_of_two(1.0 / root_of(largest)) } else { 1.0 });
            for term in &mut self.terms[..self.count] {
                let factor = factors[term.row] * factors[term.column];
                term.value *= factor;
                term.size *= factor;
            }
            for (balance, factor) in self.balance.iter_mut().zip(factors) {
                *balance *= factor;
            }
        }
    }

    /// The degree of det W as a trigonometric polynomial, at most: the sum over the rows of the highest power of x. No
    /// rows if no direction enters any loop.
    pub fn degree(&self) -> Option<usize> {
        let mut highest = [i32::MIN; SIZE];
        for term in self.terms() {
            for place in [term.row, term.column] {
                highest[place] = highest[place].max(term.power);
            }
        }
        let sum: i32 = highest.iter().take(self.size).sum();
        usize::try_from(sum).ok().filter(|_| self.size > 0)
    }

    /// W at x, on the unit circle.
    fn at(&self, x: Number) -> [[Number; SIZE]; SIZE] {
        let mut matrix = self.constant;
        let square = x * x;
        let powers = [ONE, x, square, square * x, square * square];
        for term in self.terms().iter().filter(|term| term.power != 0) {
            let power = powers[(term.power.unsigned_abs() as usize).min(MOST_POWER)];
            term.add_to(&mut matrix, if term.power < 0 { power.conj() } else { power });
        }
        matrix
    }

    /// det W at x, and a bound of its rounding error if `BOUND` is true, else zero: the error of each pivot is an epsilon of
    /// the size of the terms of its row.
    pub fn determinant<const BOUND: bool>(&self, x: Number) -> (Number, f64) {
        let size = self.size;
        let (mut matrix, mut sizes) = (self.at(x), self.sizes);
        let mut determinant = ONE;
        // The product of the pivots with their errors, and that without.
        let (mut most, mut product) = (1.0, 1.0);
        for step in 0..size {
            let size_at = |row: usize| matrix[row][step].l1_norm();
            let pivot = (step..size).max_by(|&one, &other| size_at(one).total_cmp(&size_at(other)));
            let Some(pivot) = pivot else { break };
            if pivot != step {
                matrix.swap(pivot, step);
                sizes.swap(pivot, step);
                determinant = -determinant;
            }
            let top = matrix[step];
            determinant *= top[step];
            if BOUND {
                let pivot = top[step].l1_norm();
                most *= pivot + sizes[step] * f64::EPSILON;
                product *= pivot;
            }
            if top[step] == ZERO {
                let rest: f64 = sizes[step + 1..size].iter().product();
                return (ZERO, if BOUND { most * rest } else { 0.0 });
            }
            let (inverse, of_top) = (top[step].inv(), sizes[step]);
            let rows = matrix[step + 1..size].iter_mut().zip(&mut sizes[step + 1..size]);
            for (row, of_row) in rows.filter(|(row, _)| row[step] != ZERO) {
                let factor = row[step] * inverse;
                if BOUND {
                    *of_row += factor.l1_norm() * of_top;
                }
                for (entry, above) in row[step + 1..size].iter_mut().zip(&top[step + 1..size]) {
                    *entry -= factor * above;
                }
            }
        }
        (determinant, most - product)
    }

    /// The directions at a root x of det W, x among them; `None` if they do not follow from W.
    pub fn directions(&self, x: Number) -> Option<[Number; COLUMNS - 1]> {
        let vector = self.null_vector(x)?;
        let mut found = [ZERO; COLUMNS - 1];
        for (place, direction) in found.iter_mut().enumerate().take(self.directions) {
            if place + 1 == self.kept {
                *direction = x;
                continue;
            }
            // 1 / t_j is the quotient of the entries of K + j and K; the largest entries are the most accurate.
            let mut best = (0.0, ONE);
            for upper in 0..self.size {
                let Some(without) = without(self.sets[upper], place + 1) else { continue };
                let lower = self.sets.iter().take(self.size).position(|set| *set == without);
                let Some(lower) = lower else { continue };
                let product = vector[upper] * vector[lower].conj();
                let size = product.l1_norm();
                if size > best.0 {
                    best = (size, product.conj());
                }
            }
            if best.0 == 0.0 {
                return None;
            }
            *direction = best.1 / size_of(best.1);
        }
        Some(found)
    }

    /// The vector t of W t = 0, by elimination with complete pivoting.
    fn null_vector(&self, x: Number) -> Option<[Number; SIZE]> {
        let size = self.size;
        let mut matrix = self.at(x);
        let mut order: [usize; SIZE] = core::array::from_fn(|place| place);
        for step in 0..size.checked_sub(1)? {
            let (mut row, mut column, mut largest) = (step, step, -1.0);
            for (i, entries) in matrix.iter().enumerate().take(size).skip(step) {
                for (j, entry) in entries.iter().enumerate().take(size).skip(step) {
                    if entry.l1_norm() > largest {
                        (row, column, largest) = (i, j, entry.l1_norm());
                    }
                }
            }
            if largest <= 0.0 {
                return None;
            }
            matrix.swap(step, row);
            order.swap(step, column);
            for entries in &mut matrix[..size] {
                entries.swap(step, column);
            }
            let top = matrix[step];
            let inverse = top[step].inv();
            for row in matrix[step + 1..size].iter_mut().filter(|row| row[step] != ZERO) {
                let factor = row[step] * inverse;
                for (entry, above) in row[step + 1..size].iter_mut().zip(&top[step + 1..size]) {
                    *entry -= factor * above;
                }
            }
        }
        let mut solution = [ZERO; SIZE];
        solution[size - 1] = ONE;
        for step in (0..size - 1).rev() {
            let sum: Number = (step + 1..size).map(|column| matrix[step][column] * solution[column]).sum();
            solution[step] = -sum / matrix[step][step];
        }
        let mut vector = [ZERO; SIZE];
        for (place, &row) in order[..size].iter().enumerate() {
            vector[row] = solution[place] * self.balance[row];
        }
        Some(vector)
    }
}

/// A set without one of its columns; `None` if it does not have it.
fn without(set: Columns, column: usize) -> Option<Columns> {
    (set >> column & 1 == 1).then(|| set & !(1 << column))
}

/// |z|, for numbers that are neither tiny nor huge.
fn size_of(number: Number) -> f64 {
    root_of(number.norm_sqr())
}

fn root_of(number: f64) -> f64 {
    nalgebra::ComplexField::sqrt(number)
}

/// The power of two next below a positive number.
pub fn power_of_two(number: f64) -> f64 {
    const EXPONENT: u64 = 0x7ff << 52;
    f64::from_bits(number.to_bits() & EXPONENT)
}
