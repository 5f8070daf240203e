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

use nalgebra::Complex;

/// A complex number.
pub type Number = Complex<f64>;

const ZERO: Number = Number { re: 0.0, im: 0.0 };
const ONE: Number = Number { re: 1.0, im: 0.0 };

/// The most columns of c: k and six directions.
const COLUMNS: usize = 7;

/// The coefficients c of L loops, and their determinants.
pub struct Minors {
    loops: usize,
    /// det c[K] for each set K of L columns, as a set of bits.
    values: [Number; 1 << COLUMNS],
}

/// A set of columns of c, as bits.
type Columns = usize;

impl Minors {
    /// The determinants of these rows; each has k and then the factors of 2 L directions.
    pub fn of(rows: &[[Number; COLUMNS]]) -> Self {
        let (loops, columns) = (rows.len(), 2 * rows.len() + 1);
        let mut values = [ZERO; 1 << COLUMNS];
        values[0] = ONE;
        // Expansion by the last row, from small sets to large ones.
        for set in 1..1usize << columns {
            let Some(row) = rows.get(set.count_ones() as usize - 1) else { continue };
            let mut sign = -1.0;
            for column in (0..columns).rev().filter(|column| set >> column & 1 == 1) {
                sign = -sign;
                values[set] += row[column] * values[set & !(1 << column)] * sign;
            }
        }
        Self { loops, values }
    }

    /// det c[first, set], where `first` is the first column whatever its number.
    fn with_first(&self, first: usize, set: Columns) -> Number {
        let before = (set & ((1 << first) - 1)).count_ones();
        self.values[set | 1 << first] * alternating(before)
    }
}

fn alternating(exponent: u32) -> f64 {
    if exponent.is_multiple_of(2) { 1.0 } else { -1.0 }
}

/// W, as C + x X + Y / x, with room for `SIZE` rows.
pub struct Dixon<const SIZE: usize> {
    /// The number of directions.
    directions: usize,
    /// The place of x among them, from 1.
    kept: usize,
    /// The set of directions of each row, those of L first.
    sets: [Columns; SIZE],
    size: usize,
    /// The number of rows with a set of L directions.
    upper: usize,
    constant: [[Number; SIZE]; SIZE],
    /// The diagonal of X in the upper rows, of Y in the lower rows.
    turning: [Number; SIZE],
    /// The factor of each row and column that balances the matrix.
    balance: [f64; SIZE],
}

impl<const SIZE: usize> Dixon<SIZE> {
    /// W with the direction `kept`, from 1, as x. Rows that are zero are left out.
    pub fn new(minors: &Minors, kept: usize) -> Self {
        let directions = 2 * minors.loops;
        let others = ((1 << (directions + 1)) - 2) & !(1 << kept);
        let mut dixon = Self {
            directions,
            kept,
            sets: [0; SIZE],
            size: 0,
            upper: 0,
            constant: [[ZERO; SIZE]; SIZE],
            turning: [ZERO; SIZE],
            balance: [1.0; SIZE],
        };
        for of in [minors.loops, minors.loops - 1] {
            for set in
                (1..1usize << (directions + 1)).filter(|set| set & !others == 0 && set.count_ones() as usize == of)
            {
                dixon.add(minors, set, others & !set);
            }
            if of == minors.loops {
                dixon.upper = dixon.size;
            }
        }
        dixon.drop_zeros();
        dixon.balance();
        dixon
    }

    /// Adds the row of a set and of its complement; a lower row follows the upper rows.
    fn add(&mut self, minors: &Minors, set: Columns, complement: Columns) {
        let row = self.size;
        let is_upper = set.count_ones() as usize == minors.loops;
        let sign = self.sign(minors.loops, is_upper, complement);
        self.sets[row] = set;
        self.size += 1;
        if is_upper {
            let other = minors.values[set].conj() * sign;
            self.constant[row][row] = minors.with_first(0, complement) * other;
            self.turning[row] = minors.with_first(self.kept, complement) * other;
            return;
        }
        let other = minors.values[complement] * sign;
        self.constant[row][row] = minors.with_first(0, set).conj() * other;
        self.turning[row] = minors.with_first(self.kept, set).conj() * other;
        for column in 0..self.upper {
            let added = self.sets[column] & !set;
            if self.sets[column] & set == set && added.count_ones() == 1 {
                let entry = minors.with_first(added.trailing_zeros() as usize, set).conj() * other;
                self.constant[row][column] = entry;
                self.constant[column][row] = entry;
            }
        }
    }

    /// s: the sign of the rows taken in the expansion by the first L columns, of which row 0 is one in an upper row.
    fn sign(&self, loops: usize, is_upper: bool, complement: Columns) -> f64 {
        // The directions other than x are rows 1, 2, ….
        let row = |column: usize| if column > self.kept { column - 1 } else { column };
        let rows: usize = (1..=self.directions).filter(|column| complement >> column & 1 == 1).map(row).sum();
        let columns = loops * (loops - 1) / 2 + if is_upper { loops } else { loops - 1 };
        alternating((rows + columns) as u32)
    }

    fn drop_zeros(&mut self) {
        let size = self.size;
        let is_zero =
            |row: usize| self.turning[row] == ZERO && self.constant[row][..size].iter().all(|entry| *entry == ZERO);
        let mut kept = [0; SIZE];
        let mut count = 0;
        for row in (0..size).filter(|&row| !is_zero(row)) {
            kept[count] = row;
            count += 1;
        }
        let upper = kept[..count].iter().filter(|&&row| row < self.upper).count();
        for (to, &from) in kept[..count].iter().enumerate() {
            self.sets[to] = self.sets[from];
            self.turning[to] = self.turning[from];
            for (column, &other) in kept[..count].iter().enumerate() {
                self.constant[to][column] = self.constant[from][other];
            }
        }
        (self.size, self.upper) = (count, upper);
    }

    /// Powers of two that bring the largest entry of each row near 1: twice by the root of the largest entry.
    fn balance(&mut self) {
        for _ in 0..3 {
            let mut factors = [1.0; SIZE];
            for row in 0..self.size {
                let largest = (0..self.size).map(|column| self.constant[row][column].l1_norm()).fold(0.0, f64::max);
                let largest = largest.max(self.turning[row].l1_norm());
                if largest > 0.0 {
                    factors[row] = power_of_two(1.0 / nalgebra::ComplexField::sqrt(largest));
                }
            }
            for row in 0..self.size {
                for column in 0..self.size {
                    self.constant[row][column] *= factors[row] * factors[column];
                }
                self.turning[row] *= factors[row] * factors[row];
                self.balance[row] *= factors[row];
            }
        }
    }

    /// The degree of det W as a trigonometric polynomial, at most.
    pub fn degree(&self) -> usize {
        self.size.div_ceil(2)
    }

    /// True if det W can be a trigonometric polynomial that is not zero.
    pub fn is_proper(&self) -> bool {
        self.size > 0 && 2 * self.upper == self.size
    }

    /// W at x.
    fn at(&self, x: Number) -> [[Number; SIZE]; SIZE] {
        let mut matrix = self.constant;
        for row in 0..self.size {
            matrix[row][row] += self.turning[row] * if row < self.upper { x } else { x.conj() };
        }
        matrix
    }

    /// det W at x.
    pub fn determinant(&self, x: Number) -> Number {
        let size = self.size;
        let mut matrix = self.at(x);
        let mut determinant = ONE;
        for step in 0..size {
            let pivot =
                (step..size).max_by(|&one, &other| size_of(matrix[one][step]).total_cmp(&size_of(matrix[other][step])));
            let Some(pivot) = pivot else { break };
            if pivot != step {
                matrix.swap(pivot, step);
                determinant = -determinant;
            }
            let top = matrix[step];
            determinant *= top[step];
            if top[step] == ZERO {
                return ZERO;
            }
            let inverse = top[step].inv();
            for row in matrix[step + 1..size].iter_mut().filter(|row| row[step] != ZERO) {
                let factor = row[step] * inverse;
                for (entry, above) in row[step + 1..size].iter_mut().zip(&top[step + 1..size]) {
                    *entry -= factor * above;
                }
            }
        }
        determinant
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
            for upper in 0..self.upper {
                let Some(without) = without(self.sets[upper], place + 1) else { continue };
                let lower = (self.upper..self.size).find(|&row| self.sets[row] == without);
                let Some(lower) = lower else { continue };
                let product = vector[upper] * vector[lower].conj();
                let size = size_of(product);
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
    nalgebra::ComplexField::sqrt(number.norm_sqr())
}

/// The power of two next below a positive number.
pub fn power_of_two(number: f64) -> f64 {
    const EXPONENT: u64 = 0x7ff << 52;
    f64::from_bits(number.to_bits() & EXPONENT)
}
