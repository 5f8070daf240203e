//! Linear systems of a few equations, by elimination with row pivots.

/// The solution of a square system; none if it is singular.
pub fn solve(mut rows: Vec<Vec<f64>>, mut right: Vec<f64>) -> Option<Vec<f64>> {
    let n = right.len();
    for column in 0..n {
        let pivot = (column..n).max_by(|one, other| rows[*one][column].abs().total_cmp(&rows[*other][column].abs()))?;
        if rows[pivot][column] == 0.0 || !rows[pivot][column].is_finite() {
            return None;
        }
        rows.swap(column, pivot);
        right.swap(column, pivot);
        let (above, below) = rows.split_at_mut(column + 1);
        let head = &above[column];
        for (place, row) in below.iter_mut().enumerate() {
            let factor = row[column] / head[column];
            if factor != 0.0 {
                row[column..].iter_mut().zip(&head[column..]).for_each(|(of, head)| *of -= factor * head);
                right[column + 1 + place] -= factor * right[column];
            }
        }
    }
    for column in (0..n).rev() {
        let known: f64 = (column + 1..n).map(|other| rows[column][other] * right[other]).sum();
        right[column] = (right[column] - known) / rows[column][column];
    }
    right.iter().all(|value| value.is_finite()).then_some(right)
}

/// The sign of a determinant.
pub fn sign(mut rows: Vec<Vec<f64>>) -> f64 {
    let mut sign = 1.0;
    for column in 0..rows.len() {
        let size = |row: &usize| rows[*row][column].abs();
        let Some(pivot) = (column..rows.len()).max_by(|one, other| size(one).total_cmp(&size(other))) else { break };
        if rows[pivot][column] == 0.0 {
            return 0.0;
        }
        sign *= if pivot == column { 1.0 } else { -1.0 };
        rows.swap(column, pivot);
        let (above, below) = rows.split_at_mut(column + 1);
        let head = &above[column];
        sign *= head[column].signum();
        for row in below {
            let factor = row[column] / head[column];
            row[column..].iter_mut().zip(&head[column..]).for_each(|(of, head)| *of -= factor * head);
        }
    }
    sign
}

/// The sums of the sizes of each row of the inverse, weighted: bounds of a solution whose right side is bounded so.
pub fn bounds(rows: &[Vec<f64>], right: &[f64]) -> Option<Vec<f64>> {
    let n = right.len();
    let mut all = vec![0.0; n];
    for column in 0..n {
        let mut unit = vec![0.0; n];
        unit[column] = 1.0;
        let solution = solve(rows.to_vec(), unit)?;
        all.iter_mut().zip(solution).for_each(|(sum, part)| *sum += part.abs() * right[column]);
    }
    Some(all)
}

pub fn norm(all: &[f64]) -> f64 {
    all.iter().map(|value| value * value).sum::<f64>().sqrt()
}

pub fn dot(one: &[f64], other: &[f64]) -> f64 {
    one.iter().zip(other).map(|(one, other)| one * other).sum()
}
