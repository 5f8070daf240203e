//! Linear systems with interval coefficients, by a float inverse Y of the middle: J x = c, or (I - Y J) x = x - Y c.

use linkage_runtime::Number;

use crate::Interval;

/// A matrix of floats by its rows or columns.
pub(crate) type Floats = Vec<Vec<f64>>;

/// The rows of the inverse of a matrix given by its columns; `None` if it is singular or not finite.
///
/// Gauss-Jordan elimination; `rows` are the scales of the rows, so that the pivots do not depend on units.
pub(crate) fn inverse(columns: &[&[f64]], rows: &[f64]) -> Option<Floats> {
    let count = columns.len();
    let mut work: Vec<Vec<f64>> = rows
        .iter()
        .enumerate()
        .map(|(row, scale)| {
            let unit = (0..count).map(|other| if other == row { 1.0 } else { 0.0 });
            columns.iter().filter_map(|column| column.get(row)).map(|entry| entry / scale).chain(unit).collect()
        })
        .collect();
    for step in 0..count {
        let pivot = (step..count).max_by(|&one, &other| work[one][step].abs().total_cmp(&work[other][step].abs()))?;
        work.swap(step, pivot);
        let divisor = work[step][step];
        if !divisor.is_finite() || divisor == 0.0 {
            return None;
        }
        work[step].iter_mut().for_each(|entry| *entry /= divisor);
        let leading = work[step].clone();
        for (_, row) in work.iter_mut().enumerate().filter(|&(row, _)| row != step) {
            let factor = row[step];
            row.iter_mut().zip(&leading).for_each(|(entry, leading)| *entry -= factor * leading);
        }
    }
    let inverse: Vec<Vec<f64>> =
        work.iter().map(|row| row[count..].iter().zip(rows).map(|(entry, scale)| entry / scale).collect()).collect();
    inverse.iter().flatten().all(|entry| entry.is_finite()).then_some(inverse)
}

/// Y c for floats.
pub(crate) fn product(y: &[Vec<f64>], c: &[f64]) -> Vec<f64> {
    y.iter().map(|row| row.iter().zip(c).map(|(y, c)| y * c).sum()).collect()
}

/// Y c.
pub(crate) fn times(y: &[Vec<f64>], c: &[Interval]) -> Vec<Interval> {
    y.iter().map(|row| dot(row.iter().map(|&y| Interval::from(y)), c)).collect()
}

/// The sum of the products of two sequences.
pub(crate) fn dot(one: impl IntoIterator<Item = Interval>, other: &[Interval]) -> Interval {
    one.into_iter()
        .zip(other)
        .map(|(one, &other)| one * other)
        .reduce(|sum, part| sum + part)
        .unwrap_or(Interval::zero())
}

/// The rows of I - Y J, where J is given by its columns.
pub(crate) fn defect(y: &[Vec<f64>], columns: &[&[Interval]]) -> Vec<Vec<Interval>> {
    let of_row = |(row, y): (usize, &Vec<f64>)| {
        let of_column = |(column, entries): (usize, &&[Interval])| {
            let unit = if column == row { Interval::one() } else { Interval::zero() };
            unit - dot(y.iter().map(|&y| Interval::from(y)), entries)
        };
        columns.iter().enumerate().map(of_column).collect()
    };
    y.iter().enumerate().map(of_row).collect()
}

/// D x.
pub(crate) fn apply(defect: &[Vec<Interval>], x: &[Interval]) -> Vec<Interval> {
    defect.iter().map(|row| dot(row.iter().copied(), x)).collect()
}

/// An upper bound of max |x_i| / s_i over these intervals.
fn largest(x: &[Interval], scales: &[f64]) -> f64 {
    x.iter().zip(scales).map(|(x, &scale)| (x.abs() / Interval::from(scale)).most()).fold(0.0, f64::max)
}

/// An upper bound of the norm of all D of these intervals: of max |D e|_i / s_i where |e_i| <= s_i.
///
/// Below 1 it proves that I - D is regular.
pub(crate) fn norm(defect: &[Vec<Interval>], scales: &[f64]) -> f64 {
    let whole: Vec<Interval> = scales.iter().map(|&scale| symmetric(scale)).collect();
    largest(&apply(defect, &whole), scales)
}

/// Scales s = (I - |D|)^-1 t, for which |D| s = s - t is below s. They exist if the spectral radius of |D| is below 1, else
/// the result is t.
///
/// The norm of D by s is at most that by t: s <= t / (1 - d) if |D| t <= d t. Source: A. Neumaier, "Interval Methods for
/// Systems of Equations", 1990, section 3.7, on H-matrices.
pub(crate) fn contracting(defect: &[Vec<Interval>], scales: &[f64]) -> Vec<f64> {
    let unit = |one: usize, other: usize| if one == other { 1.0 } else { 0.0 };
    let column = |column: usize| -> Vec<f64> {
        defect.iter().enumerate().map(|(row, d)| unit(row, column) - d[column].magnitude()).collect()
    };
    let columns: Vec<Vec<f64>> = (0..defect.len()).map(column).collect();
    let columns: Vec<&[f64]> = columns.iter().map(Vec::as_slice).collect();
    let solved = inverse(&columns, scales).map(|inverse| product(&inverse, scales));
    solved.filter(|s| s.iter().all(|&s| s.is_finite() && s > 0.0)).unwrap_or_else(|| scales.to_vec())
}

/// The solution e of e = c + D e for all D and c of these intervals; `None` if D is too large.
///
/// In the norm max |e_i| / s_i with d = |D| < 1: |e| <= |c| / (1 - d). Two steps of e = c + D e then give each entry its
/// own bounds. Source: S. M. Rump, "Verification methods", Acta Numerica 19 (2010), section 10.
pub(crate) fn fixed_point(defect: &[Vec<Interval>], c: &[Interval], scales: &[f64]) -> Option<Vec<Interval>> {
    let d = norm(defect, scales);
    if d >= 1.0 {
        return None;
    }
    let bound = Interval::from(largest(c, scales)) / (Interval::one() - Interval::from(d));
    let mut e: Vec<Interval> = scales.iter().map(|&scale| symmetric(scale) * bound).collect();
    for _ in 0..2 {
        let next: Vec<Interval> = apply(defect, &e).iter().zip(c).map(|(&part, &c)| c + part).collect();
        e = e.iter().zip(next).map(|(&old, new)| old.intersection(new)).collect::<Option<_>>()?;
    }
    e.iter().all(|entry| entry.magnitude().is_finite()).then_some(e)
}

/// The solution x of J x = c for all J and c of these intervals, where the rows of `defect` are those of I - Y J; `None` if
/// it has no bounds.
///
/// About a float solution x0: x = x0 + e, e = Y (c - J x0) + D e with D = I - Y J, and Y c - Y J x0 = Y c - x0 + D x0.
pub(crate) fn solution(
    y: &[Vec<f64>],
    defect: &[Vec<Interval>],
    c: &[Interval],
    scales: &[f64],
) -> Option<Vec<Interval>> {
    let right = times(y, c);
    let x0: Vec<f64> = right.iter().map(|x| x.middle()).collect();
    if !x0.iter().all(|x| x.is_finite()) {
        return None;
    }
    let exact: Vec<Interval> = x0.iter().map(|&x| x.into()).collect();
    let parts = right.iter().zip(&exact).zip(apply(defect, &exact));
    let rest: Vec<Interval> = parts.map(|((&right, &x), part)| right - x + part).collect();
    let e = fixed_point(defect, &rest, scales)?;
    Some(exact.iter().zip(e).map(|(&x, e)| x + e).collect())
}

/// The numbers of magnitude up to this radius.
pub(crate) fn symmetric(radius: f64) -> Interval {
    Interval::new(-radius, radius).unwrap_or(Interval::ENTIRE)
}
