//! J over a box, proved regular group by group.

use linkage_runtime::{Certifiable, Column, Dim, Formulas, Group, Number};

use super::EncloseError;
use crate::Interval;
use crate::matrix::{Floats, contracting, defect, inverse, norm, solution};
use crate::series::unit_line;

/// Scales of Psi and of the unknowns. They choose pivots and norms; the bounds hold for any.
pub(crate) struct Sizes {
    pub(crate) rows: Vec<f64>,
    pub(crate) unknowns: Vec<f64>,
}

/// J over a box, multiplied by an inverse of its middle.
pub(super) struct Linear {
    y: Floats,
    /// I - Y J.
    defect: Vec<Vec<Interval>>,
    /// Scales by which the norm of the defect is below 1.
    scales: Vec<f64>,
    /// For each group an upper bound of the norm of I - Y J of its block, below 1.
    pub(super) norms: Vec<f64>,
}

/// A square matrix by its columns, the inverse of its middle, and an upper bound of the norm of I - Y J.
struct Preconditioned {
    y: Floats,
    defect: Vec<Vec<Interval>>,
    scales: Vec<f64>,
    norm: f64,
}

impl Preconditioned {
    /// `None` if the middle is singular.
    fn of(columns: &[Vec<Interval>], rows: &[f64], scales: &[f64]) -> Option<Self> {
        let middle: Vec<Vec<f64>> =
            columns.iter().map(|column| column.iter().map(|entry| entry.middle()).collect()).collect();
        let middle: Vec<&[f64]> = middle.iter().map(Vec::as_slice).collect();
        let y = inverse(&middle, rows)?;
        let columns: Vec<&[Interval]> = columns.iter().map(Vec::as_slice).collect();
        let defect = defect(&y, &columns);
        let scales = contracting(&defect, scales);
        let norm = norm(&defect, &scales);
        Some(Self { y, defect, scales, norm })
    }
}

impl Linear {
    /// J over the box of these numbers.
    pub(super) fn of<M: Certifiable>(numbers: &[Interval], sizes: &Sizes) -> Result<Self, EncloseError> {
        let column = |place| psi::<M, _>(&unit_line(numbers, place)).iter().map(|psi| psi.first).collect();
        let columns: Vec<Vec<Interval>> = (0..M::U::default().count()).map(column).collect();
        let users = M::USER_FUNCTIONS.iter().copied().chain(std::iter::repeat(None));
        let norm_of = |(group, user): (&Group, Option<&'static str>)| norm_of_group::<M>(group, user, &columns, sizes);
        let norms: Vec<f64> = M::GROUPS.iter().zip(users).map(norm_of).collect::<Result<_, _>>()?;
        match Preconditioned::of(&columns, &sizes.rows, &sizes.unknowns) {
            Some(Preconditioned { y, defect, scales, norm }) if norm < 1.0 => Ok(Self { y, defect, scales, norms }),
            // J is block triangular, so that it fails only where the norm of a group is about 1.
            whole => {
                let largest = (0..norms.len()).max_by(|&one, &other| norms[one].total_cmp(&norms[other]));
                let group = largest.and_then(|place| M::GROUPS.get(place)).map_or("", |group| group.name);
                let norm = whole.map_or(f64::INFINITY, |whole| whole.norm);
                Err(EncloseError::NotRegular { mechanism: M::NAME, group, norm })
            }
        }
    }

    /// The solutions x of J x = c for all J and c; `derivative` is the name of c.
    pub(super) fn solve<M: Certifiable>(
        &self,
        c: &[Interval],
        derivative: &'static str,
    ) -> Result<Vec<Interval>, EncloseError> {
        let infinite = c.iter().position(|c| !c.magnitude().is_finite());
        let overflow = || no_bounds::<M>(0, derivative);
        match infinite {
            Some(row) => Err(no_bounds::<M>(row, derivative)),
            None => solution(&self.y, &self.defect, c, &self.scales).ok_or_else(overflow),
        }
    }
}

/// The norm of I - Y J for the block of a group, where it is below 1.
fn norm_of_group<M: Certifiable>(
    group: &Group,
    user: Option<&'static str>,
    columns: &[Vec<Interval>],
    sizes: &Sizes,
) -> Result<f64, EncloseError> {
    let (mechanism, name) = (M::NAME, group.name);
    if let Some(function) = user {
        return Err(EncloseError::UserFunction { mechanism, group: name, function });
    }
    let rows_of = |column: &Vec<Interval>| group.equations.iter().filter_map(|&row| column.get(row).copied()).collect();
    let block: Vec<Vec<Interval>> =
        group.unknowns.iter().filter_map(|&place| columns.get(place)).map(rows_of).collect();
    let all_columns = columns.iter().flat_map(|column| group.equations.iter().filter_map(|&row| column.get(row)));
    if all_columns.into_iter().any(|entry| !entry.magnitude().is_finite()) {
        return Err(EncloseError::NoBounds { mechanism, group: name, derivative: "J" });
    }
    let pick = |from: &[f64], places: &[usize]| -> Vec<f64> {
        places.iter().filter_map(|&place| from.get(place).copied()).collect()
    };
    let (rows, scales) = (pick(&sizes.rows, group.equations), pick(&sizes.unknowns, group.unknowns));
    let norm = Preconditioned::of(&block, &rows, &scales).map_or(f64::INFINITY, |block| block.norm);
    // NaN is not below.
    if norm < 1.0 { Ok(norm) } else { Err(EncloseError::NotRegular { mechanism, group: name, norm }) }
}

/// The error of a derivative that has no bounds in this row of Psi.
fn no_bounds<M: Certifiable>(row: usize, derivative: &'static str) -> EncloseError {
    let group = M::GROUPS.iter().find(|group| group.equations.contains(&row)).map_or("", |group| group.name);
    EncloseError::NoBounds { mechanism: M::NAME, group, derivative }
}

/// Psi along a curve of its numbers: the unknowns, then the inputs, then the parameters.
pub(super) fn psi<M: Certifiable, N: Number>(numbers: &[N]) -> Vec<N> {
    let (unknowns, inputs) = (M::U::default().count(), M::V::default().count());
    let formulas = M::Over::<N>::with_parameters(column(numbers, unknowns + inputs));
    formulas.residual(&column(numbers, 0), &column(numbers, unknowns)).iter().copied().collect()
}

/// The column of the numbers from this index on.
pub(super) fn column<N: Number, R: Dim + Default>(numbers: &[N], from: usize) -> Column<N, R> {
    Column::from_fn(|place| numbers.get(from + place).copied().unwrap_or_else(N::unknown))
}
