//! The factorisations solve systems whose solutions are known.

use super::{Cholesky, Definite, Lu, Ranked, contraction, solve};
use crate::{Column, D, Matrix};

type Square = Matrix<f64, D<4>, D<4>>;

/// Symmetric and positive definite, without a diagonal order.
fn definite() -> Square {
    let rows = [[7.0, 2.0, -1.0, 3.0], [2.0, 9.0, 4.0, -2.0], [-1.0, 4.0, 8.0, 1.0], [3.0, -2.0, 1.0, 6.0]];
    Square::from_fn(|row, column| rows[row][column])
}

/// Its first column needs an exchange.
fn general() -> Square {
    let rows = [[0.0, 2.0, -1.0, 3.0], [5.0, 1.0, 4.0, -2.0], [-1.0, 4.0, 8.0, 1.0], [3.0, -2.0, 1.0, 6.0]];
    Square::from_fn(|row, column| rows[row][column])
}

const EXPECTED: [f64; 4] = [1.0, -2.0, 3.0, 0.5];

fn product(matrix: &Square, count: usize) -> Column<f64, D<4>> {
    Column::from_fn(|row| (0..count).map(|column| matrix[(row, column)] * EXPECTED[column]).sum())
}

#[track_caller]
fn is_solution(found: &[f64]) {
    for (found, expected) in found.iter().zip(EXPECTED) {
        assert!((found - expected).abs() < 1e-14, "{found} instead of {expected}");
    }
}

#[test]
fn definite_systems() {
    let (matrix, side) = (definite(), product(&definite(), 4));
    is_solution(Cholesky::new(&matrix).unwrap().solve(&side).as_slice());
    is_solution(Definite::new(&matrix, |_, _, _| Ok::<(), ()>(())).unwrap().solve(&side).as_slice());
    let ranked = Ranked::pivoted(&matrix, &Column::from_fn(|row| row), 4, 1e-14);
    let found = ranked.solve(|row| side[row]);
    let mut by_row = [0.0; 4];
    for (place, row) in ranked.order.iter().enumerate() {
        by_row[*row] = found[place];
    }
    is_solution(&by_row);
}

#[test]
fn general_systems() {
    let (matrix, side) = (general(), product(&general(), 4));
    is_solution(solve(matrix, side, 4).unwrap().as_slice());
    is_solution(&solve(matrix, product(&matrix, 3), 3).unwrap().as_slice()[..3]);
    let columns = [0, 1, 2, 3].map(|column| [0, 1, 2, 3].map(|row| matrix[(row, column)]));
    is_solution(&Lu::of(columns).solve(&[0, 1, 2, 3].map(|row| side[row])));
    assert_eq!(solve(Square::zeros(), side, 4), None);
}

/// (I - G) x = b for a spectral radius of G below 1, and for one above.
#[test]
fn contractions() {
    let gain = |scale: f64| Square::from_fn(|row, column| scale * (1.0 + row as f64 + 2.0 * column as f64) / 40.0);
    let without = Square::from_fn(|row, column| f64::from(u8::from(row == column)) - gain(1.0)[(row, column)]);
    is_solution(contraction(&gain(1.0), product(&without, 4), 4).unwrap().as_slice());
    assert_eq!(contraction(&gain(4.0), product(&without, 4), 4), None);
}
