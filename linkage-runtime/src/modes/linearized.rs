//! The equations of a group in the angles of its directions, with bounds of what their tangents leave out.
//!
//! A loop without a length gives two equations, the parts of k + sum_j c_j t_j. A loop with a length s, which adds s d or
//! s d t_w, gives one: the imaginary part of conj(d) (k + sum_j c_j t_j), divided by t_w if the guide turns. Each is a sum of
//! terms z e^(i psi), where psi is the angle of a direction, or its difference from that of the guide. For |delta| <= h
//!
//! ```text
//! |e^(i delta) - 1 - i delta|           <= h^2 / 2
//! |e^(i delta) - 1 - i delta + h^2 / 4| <= h^2 / 4 + h^3 / 6
//! ```

use super::circle::direction;
use super::dixon::Guided;
use super::number::{COLUMNS, Number};
use crate::Real as _;

/// The most directions, and the most equations.
pub const MOST_ANGLES: usize = COLUMNS - 1;

/// A number for each angle, or for each equation.
pub type PerAngle = [f64; MOST_ANGLES];

/// The rounding error of a sum of terms with sines and cosines, in epsilons of the sum of their sizes: each term has an
/// error below 4 epsilons, and each sum of at most eight of them adds 8.
pub const ROUNDING: f64 = 16.0;

/// A link is hidden if it is shorter than this many epsilons of the links of its loop: a thousand times their rounding error.
const HIDDEN: f64 = 1e3 * ROUNDING;

/// The two sides of an angle about which the second bound is the smaller one.
const CENTRED: f64 = 1.5;

/// A loop.
#[derive(Debug, Clone, Copy)]
struct Row {
    /// k and the factors of the directions.
    numbers: [Number; COLUMNS],
    /// conj(d) of a loop with a length, and the direction of its guide.
    guide: Option<(Number, Option<usize>)>,
}

/// The equations of a group.
#[derive(Debug, Clone)]
pub struct System {
    rows: [Row; 3],
    row_count: usize,
    /// The number of angles.
    pub angles: usize,
    /// The number of equations: that of angles, and one more for each guide without a direction.
    pub equations: usize,
    /// True if a guide has no direction: its length is then in no equation.
    pub has_free_length: bool,
}

/// The equations near the middle of a cell: value + sum slope * delta + remainder.
#[derive(Debug, Clone, Default)]
pub struct Linearized {
    /// The values in the middle.
    pub values: PerAngle,
    /// The middles of the remainders.
    pub shifts: PerAngle,
    /// Bounds of the remainders without their middles, with rounding error.
    pub bounds: PerAngle,
    /// Bounds of the rounding errors.
    pub noise: PerAngle,
    /// The derivatives in the middle, by equation and angle.
    pub slopes: [PerAngle; MOST_ANGLES],
    /// The sums of the sizes of the terms in the derivatives, by angle.
    pub scales: PerAngle,
    /// Bounds of the changes of the derivatives in the cell, by equation and angle.
    pub changes: [PerAngle; MOST_ANGLES],
    /// Bounds of the changes of the values in the cell.
    pub reaches: PerAngle,
    /// The part of each angle in the remainders: the sum over the equations.
    pub parts: PerAngle,
}

/// A term z e^(i psi): its value in the middle, its angles with their senses and their shares of the half width, and the half
/// width of psi.
struct Term {
    value: Number,
    angles: [Option<(usize, f64, f64)>; 2],
    half: f64,
}

impl System {
    /// The equations of these loops.
    pub fn new(rows: &[[Number; COLUMNS]], guides: &[Guided], turning: Option<usize>, angles: usize) -> Self {
        let none = Row { numbers: [Number::default(); COLUMNS], guide: None };
        let mut system =
            Self { rows: [none; 3], row_count: rows.len().min(3), angles, equations: 0, has_free_length: false };
        for (place, (to, from)) in system.rows.iter_mut().zip(rows).enumerate() {
            to.numbers = *from;
            let guide = guides.iter().find(|guide| guide.row == place);
            system.has_free_length |= guide.is_some_and(|guide| guide.factor == Number::default());
            let guide = guide.filter(|guide| guide.factor != Number::default());
            to.guide = guide.map(|guide| (guide.factor, turning.filter(|_| guide.is_turning)));
            system.equations += if guide.is_some() { 1 } else { 2 };
        }
        system
    }

    fn rows(&self) -> &[Row] {
        self.rows.get(..self.row_count).unwrap_or_default()
    }

    /// The equations near the middle of a cell of these half widths.
    pub fn near(&self, middle: &PerAngle, half: &PerAngle) -> Linearized {
        let mut linear = Linearized::default();
        let mut directions = [Number::default(); MOST_ANGLES];
        for (to, angle) in directions.iter_mut().zip(middle).take(self.angles) {
            *to = direction(*angle);
        }
        let mut equation = 0;
        for row in self.rows() {
            let [constant, factors @ ..] = &row.numbers;
            match row.guide {
                None => {
                    linear.add(equation, true, &Term { value: *constant, angles: [None; 2], half: 0.0 });
                    for (place, (factor, direction)) in factors.iter().zip(&directions).enumerate().take(self.angles) {
                        let (value, angles) = (factor * direction, [Some((place, 1.0, 1.0)), None]);
                        linear.add(equation, true, &Term { value, angles, half: half[place] });
                    }
                    equation += 2;
                }
                Some((factor, with)) => {
                    // The imaginary part of z is the real part of -i z.
                    let factor = Number::new(factor.im, -factor.re);
                    let (back, turn) =
                        with.map_or((factor, 0.0), |with| (factor * directions[with].conj(), half[with]));
                    linear.add(
                        equation,
                        false,
                        &Term {
                            value: back * constant,
                            angles: [None, with.map(|with| (with, -1.0, 1.0))],
                            half: turn,
                        },
                    );
                    for (place, (link, direction)) in factors.iter().zip(&directions).enumerate().take(self.angles) {
                        let value = back * link * direction;
                        let term = match with {
                            Some(with) if with == place => Term { value, angles: [None; 2], half: 0.0 },
                            Some(with) => {
                                let width = half[place] + turn;
                                let share = if width > 0.0 { half[place] / width } else { 0.5 };
                                let angles = [Some((place, 1.0, share)), Some((with, -1.0, 1.0 - share))];
                                Term { value, angles, half: width }
                            }
                            None => Term { value, angles: [Some((place, 1.0, 1.0)), None], half: half[place] },
                        };
                        linear.add(equation, false, &term);
                    }
                    equation += 1;
                }
            }
        }
        linear
    }

    /// False if a link is so short that the rounding error of its loop hides where it points.
    pub fn shows_all_links(&self) -> bool {
        self.rows().iter().all(|row| {
            let sizes = row.numbers.map(size);
            let hidden = HIDDEN * f64::EPSILON * sizes.iter().sum::<f64>();
            sizes.iter().skip(1).all(|size| *size == 0.0 || *size > hidden)
        })
    }

    /// The loops without a length: the sums of k and of the links, by loop.
    pub fn loops(&self) -> impl Iterator<Item = &[Number; COLUMNS]> {
        self.rows().iter().filter(|row| row.guide.is_none()).map(|row| &row.numbers)
    }
}

impl Linearized {
    /// Adds the real part of a term to an equation, and its imaginary part to the next if the term is in two.
    fn add(&mut self, equation: usize, is_in_two: bool, term: &Term) {
        let size = size(term.value);
        if size == 0.0 {
            return;
        }
        let square = term.half * term.half;
        let (shift, bound) =
            if term.half < CENTRED { (0.25 * square, square * (0.25 + term.half / 6.0)) } else { (0.0, 0.5 * square) };
        let noise = ROUNDING * f64::EPSILON * size;
        let Number { re, im } = term.value;
        let parts = [(equation, re, -im), (equation + 1, im, re)];
        for (equation, value, slope) in parts.into_iter().take(if is_in_two { 2 } else { 1 }) {
            self.values[equation] += value;
            self.shifts[equation] -= value * shift;
            self.bounds[equation] += size * bound + noise;
            self.noise[equation] += noise;
            self.reaches[equation] += size * term.half.min(2.0) + noise;
            for (angle, sense, share) in term.angles.into_iter().flatten() {
                self.slopes[equation][angle] += sense * slope;
                self.scales[angle] += size;
                self.changes[equation][angle] += size * term.half;
                self.parts[angle] += size * bound * share;
            }
        }
    }
}

/// |z|
pub fn size(number: Number) -> f64 {
    number.re.hypotenuse(number.im)
}
