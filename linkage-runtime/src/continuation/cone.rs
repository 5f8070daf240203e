//! Common zeros of quadratic forms: the tangents of the curves that cross at a change point.
//!
//! A form that is a product of two linear forms vanishes where either does; a form that is a sum of squares vanishes
//! where all of its linear forms do. Both restrict the search to a smaller space with fewer forms. Two forms of three
//! coordinates have a combination that is such a product (a pencil of conics has a degenerate one, whose parameter is a
//! root of a cubic). This covers two groups that are singular at once, and more if the form of each has few
//! coordinates, as in chains of dyads.

use core::convert::Infallible;

use super::tangents::MOST_TANGENTS;
use crate::jacobian::ulp::nearly_zero;
use crate::jacobian::{Cholesky, root};
use crate::{Column, D, Matrix, Real, real};

/// The largest dimension of a null space whose tangents are computed: that of seven groups singular at once.
pub(super) const DIMENSIONS: usize = 8;

/// The most spaces visited: eight forms that all are products lead to 2^8 smallest spaces.
const MOST_SPACES: usize = 512;

/// Passes of the equilibration; each at least halves the logarithms of the largest entries, which are to become 1.
const SCALINGS: usize = 5;

/// If the forms vanish in a whole space, the projection of the followed direction on it is returned as a tangent,
/// provided that its length is more than this fraction of that of the direction.
const NEAR: f64 = 0.5;

/// A quadratic form in the leading coordinates.
pub(super) type Form<T> = Matrix<T, D<DIMENSIONS>, D<DIMENSIONS>>;
type Coordinates<T> = Column<T, D<DIMENSIONS>>;

/// The lines on which all forms vanish.
pub(super) struct Cone<T: Real> {
    lines: [Coordinates<T>; MOST_TANGENTS],
    count: usize,
    /// True if no other zeros exist.
    is_complete: bool,
    /// The number of spaces searched.
    spaces: usize,
}

/// A space to search for zeros, with the remaining forms restricted to it.
struct Space<T: Real> {
    /// The basis, in the first columns.
    basis: Form<T>,
    size: usize,
    forms: [Form<T>; DIMENSIONS],
    count: usize,
}

/// A form as a sum of squares of linear forms, each with a sign.
struct Squares<T: Real> {
    linear: [Coordinates<T>; DIMENSIONS],
    is_negative: [bool; DIMENSIONS],
    rank: usize,
}

impl<T: Real> Cone<T> {
    /// Finds the common zeros of forms in the first `size` coordinates. `direction` is that of the followed motion: of
    /// a continuous family of zeros the one nearest to it is returned.
    pub(super) fn of(forms: &[Form<T>], size: usize, direction: &Coordinates<T>) -> Self {
        let mut cone = Self { lines: [Coordinates::zeros(); MOST_TANGENTS], count: 0, is_complete: true, spaces: 0 };
        let mut space = Space { basis: Form::identity(), size, forms: [Form::zeros(); DIMENSIONS], count: 0 };
        for form in forms {
            let most = form.largest();
            if most > T::zero() {
                space.forms[space.count] = *form * most.recip();
                space.count += 1;
            }
        }
        space.equilibrate();
        cone.search(space, direction);
        cone
    }

    pub(super) fn lines(&self) -> &[Coordinates<T>] {
        &self.lines[..self.count]
    }

    pub(super) fn is_complete(&self) -> bool {
        self.is_complete
    }

    fn search(&mut self, mut space: Space<T>, direction: &Coordinates<T>) {
        self.spaces += 1;
        if self.spaces > MOST_SPACES {
            self.is_complete = false;
            return;
        }
        space.drop_zeros();
        if space.size == 0 || (space.size == 1 && space.count > 0) {
            return;
        }
        if space.count == 0 {
            self.record(&space, direction);
            return;
        }
        let mut product = None;
        for form in &space.forms[..space.count] {
            let squares = Squares::of(form, space.size);
            let signs = &squares.is_negative[..squares.rank];
            if signs.iter().all(|&sign| sign == signs[0]) {
                self.search(space.without(&squares.linear[..squares.rank]), direction);
                return;
            }
            if squares.rank == 2 && product.is_none() {
                product = Some([squares.linear[0] + squares.linear[1], squares.linear[0] - squares.linear[1]]);
            }
        }
        if let Some(factors) = product {
            for factor in factors {
                self.search(space.without(&[factor]), direction);
            }
        } else if space.size == 3 && space.count > 1 && space.degenerate() {
            self.search(space, direction);
        } else {
            self.is_complete = false;
        }
    }

    /// Records a space in which all forms vanish: a line, or the direction nearest to the followed motion.
    fn record(&mut self, space: &Space<T>, direction: &Coordinates<T>) {
        if space.size == 1 {
            self.push(&space.basis.column(0));
            return;
        }
        self.is_complete = false;
        // The projection of the direction on the space.
        let basis = &space.basis;
        let mut normal = basis.tr_mul_matrix(basis);
        for unused in space.size..DIMENSIONS {
            normal[(unused, unused)] = T::one();
        }
        let Some(cholesky) = Cholesky::new(&normal) else { return };
        let nearest = *basis * cholesky.solve(&basis.tr_mul(direction));
        if nearest.norm() > direction.norm() * real(NEAR) {
            self.push(&nearest);
        }
    }

    fn push(&mut self, line: &Coordinates<T>) {
        let line = *line * line.norm().recip();
        let is_known = |known: &Coordinates<T>| (*known * known.dot(&line) - line).norm() <= nearly_zero();
        if self.lines().iter().any(is_known) {
            return;
        }
        match self.lines.get_mut(self.count) {
            Some(place) => {
                *place = line;
                self.count += 1;
            }
            None => self.is_complete = false,
        }
    }
}

impl<T: Real> Space<T> {
    /// Scales the coordinates so that each has an entry near to 1 in some form (D. Ruiz, "A scaling algorithm to
    /// equilibrate both rows and columns norms in matrices", 2001): an entry that is small because of its unit is then
    /// not taken for zero.
    fn equilibrate(&mut self) {
        for _ in 0..SCALINGS {
            for place in 0..self.size {
                let most =
                    self.forms[..self.count].iter().fold(T::zero(), |most, form| most.max(form.row(place).largest()));
                if most > T::zero() {
                    let factor = most.sqrt().recip();
                    self.basis.scale_column(place, factor);
                    for form in &mut self.forms[..self.count] {
                        form.scale_row(place, factor);
                        form.scale_column(place, factor);
                    }
                }
            }
        }
    }

    fn drop_zeros(&mut self) {
        let mut kept = 0;
        for place in 0..self.count {
            if self.forms[place].largest() > nearly_zero() {
                self.forms.swap(kept, place);
                kept += 1;
            }
        }
        self.count = kept;
    }

    /// The subspace in which linear forms vanish.
    fn without(&self, linear: &[Coordinates<T>]) -> Self {
        let mut part = Self { basis: self.basis, size: self.size, forms: self.forms, count: self.count };
        // The remaining linear forms, in the coordinates of the subspace.
        let mut rest = [Coordinates::zeros(); DIMENSIONS];
        rest[..linear.len()].copy_from_slice(linear);
        for place in 0..linear.len() {
            let form = rest[place];
            let pivot = form.leading();
            if form[pivot].is_zero() {
                continue;
            }
            // x_pivot is expressed by the others; the last coordinate takes its index.
            let last = part.size - 1;
            let mut change = Form::<T>::zeros();
            for column in 0..last {
                let from = if column == pivot { last } else { column };
                change[(from, column)] = T::one();
                change[(pivot, column)] = -form[from] / form[pivot];
            }
            part.size = last;
            part.basis = part.basis * change;
            for form in &mut part.forms[..part.count] {
                *form = change.tr_mul_matrix(form) * change;
            }
            for later in &mut rest[place + 1..] {
                *later = change.tr_mul(later);
            }
        }
        part
    }

    /// Replaces one of the first two forms, in three coordinates, by a degenerate combination of both.
    fn degenerate(&mut self) -> bool {
        let [one, two] = [self.forms[0], self.forms[1]];
        let combination = |angle: T| one * angle.cosine() + two * angle.sine();
        let determinant = |angle: T| of_three(&combination(angle));
        // The determinant changes its sign over half a turn.
        let interval = [T::zero(), T::pi()];
        let ends = [determinant(T::zero()), -determinant(T::zero())];
        let found: Result<_, Infallible> =
            root(interval, ends, T::default_epsilon(), |angle| Ok(Some(determinant(angle))));
        let Ok(Some(angle)) = found else { return false };
        let form = combination(angle);
        self.forms[usize::from(angle.sine().abs() > angle.cosine().abs())] = form;
        let squares = Squares::of(&form, self.size);
        squares.rank <= 2
    }
}

impl<T: Real> Squares<T> {
    fn of(form: &Form<T>, size: usize) -> Self {
        let mut squares =
            Self { linear: [Coordinates::zeros(); DIMENSIONS], is_negative: [false; DIMENSIONS], rank: 0 };
        let mut rest = *form;
        while squares.rank < size {
            // The coordinate or the sum or difference of two along which the form is largest.
            let (mut along, mut most) = (Coordinates::zeros(), T::zero());
            for i in 0..size {
                for j in 0..=i {
                    let mut trial = Coordinates::zeros();
                    (trial[i], trial[j]) = (T::one(), T::one());
                    if i != j {
                        let is_opposed = (rest[(i, i)] + rest[(j, j)]) * rest[(i, j)] < T::zero();
                        trial[j] = if is_opposed { -T::one() } else { T::one() };
                    }
                    let value = trial.dot(&(rest * trial)) / trial.dot(&trial);
                    if value.abs() > most.abs() {
                        (along, most) = (trial, value);
                    }
                }
            }
            if most.abs() <= nearly_zero() {
                break;
            }
            let image = rest * along;
            let value = along.dot(&image);
            rest = rest - Matrix::from_fn(|row, column| image[row] * image[column] / value);
            squares.linear[squares.rank] = image * value.abs().sqrt().recip();
            squares.is_negative[squares.rank] = value < T::zero();
            squares.rank += 1;
        }
        squares
    }
}

/// The determinant of the leading three rows and columns.
fn of_three<T: Real>(form: &Form<T>) -> T {
    let minor = |i: usize, j: usize| form[(1, i)] * form[(2, j)] - form[(1, j)] * form[(2, i)];
    form[(0, 0)] * minor(1, 2) - form[(0, 1)] * minor(0, 2) + form[(0, 2)] * minor(0, 1)
}
