//! J over a box, proved regular group by group.

use linkage_runtime::{Build, Certifiable, Column, Dim, Formulas, Group, Name, Number};

use super::{EncloseError, EncloseErrorOf};
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
    pub(super) fn of<M: Certifiable>(
        mechanism: &M,
        numbers: &[Interval],
        sizes: &Sizes,
    ) -> Result<Self, EncloseErrorOf<M>> {
        let column = |place| psi(mechanism, &unit_line(numbers, place)).iter().map(|psi| psi.first).collect();
        let columns: Vec<Vec<Interval>> = (0..mechanism.dims().0.count()).map(column).collect();
        let norm_of =
            |(place, group)| norm_of_group(mechanism, &group, mechanism.user_function(place), &columns, sizes);
        let norms: Vec<f64> = mechanism.groups().enumerate().map(norm_of).collect::<Result<_, _>>()?;
        match Preconditioned::of(&columns, &sizes.rows, &sizes.unknowns) {
            Some(Preconditioned { y, defect, scales, norm }) if norm < 1.0 => Ok(Self { y, defect, scales, norms }),
            // J is block triangular, so that it fails only where the norm of a group is about 1.
            whole => {
                let largest = (0..norms.len()).max_by(|&one, &other| norms[one].total_cmp(&norms[other]));
                let group = largest.and_then(|place| mechanism.group(place));
                let group = group.map_or_else(|| Name::from_static(""), |group| group.name);
                let norm = whole.map_or(f64::INFINITY, |whole| whole.norm);
                Err(EncloseError::NotRegular { mechanism: mechanism.name(), group, norm })
            }
        }
    }

    /// The solutions x of J x = c for all J and c; `derivative` is the name of c.
    pub(super) fn solve<M: Certifiable>(
        &self,
        mechanism: &M,
        c: &[Interval],
        derivative: &'static str,
    ) -> Result<Vec<Interval>, EncloseErrorOf<M>> {
        let infinite = c.iter().position(|c| !c.magnitude().is_finite());
        let overflow = || no_bounds(mechanism, 0, derivative);
        match infinite {
            Some(row) => Err(no_bounds(mechanism, row, derivative)),
            None => solution(&self.y, &self.defect, c, &self.scales).ok_or_else(overflow),
        }
    }
}

/// The norm of I - Y J for the block of a group, where it is below 1.
fn norm_of_group<M: Certifiable>(
    mechanism: &M,
    group: &Group<'_, M::Name>,
    user: Option<M::Name>,
    columns: &[Vec<Interval>],
    sizes: &Sizes,
) -> Result<f64, EncloseErrorOf<M>> {
    let (mechanism, name) = (mechanism.name(), group.name);
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
fn no_bounds<M: Certifiable>(mechanism: &M, row: usize, derivative: &'static str) -> EncloseErrorOf<M> {
    let group = mechanism.groups().find(|group| group.equations.contains(&row));
    let group = group.map_or_else(|| Name::from_static(""), |group| group.name);
    EncloseError::NoBounds { mechanism: mechanism.name(), group, derivative }
}

/// Psi along a curve of its numbers: the unknowns, then the inputs, then the parameters.
pub(super) fn psi<M: Certifiable, N: Number>(mechanism: &M, numbers: &[N]) -> Vec<N> {
    let (u, v, _) = mechanism.dims();
    let formulas = mechanism.over(column(mechanism.parameters().dim(), numbers, u.count() + v.count()));
    formulas.residual(&column(u, numbers, 0), &column(v, numbers, u.count())).iter().copied().collect()
}

/// The column of the numbers from this index on.
pub(super) fn column<N: Number, R: Dim>(rows: R, numbers: &[N], from: usize) -> Column<N, R> {
    rows.column(|place| numbers.get(from + place).copied().unwrap_or_else(N::unknown))
}
