//! The reason why a part of a motion has no certificate.

use linkage_runtime::{Certifiable, Group, Name};

use super::error::{CertifyError, CertifyErrorOf};
use super::system::{Dimensions, System};
use crate::Interval;
use crate::matrix::{defect, norm, symmetric};

/// The regularity below which a group is called singular or nearly so. Where no step can be certified it was at most 2e-5
/// before dead points, and 1e-9 before change points; elsewhere it is that of the linkage.
const NEARLY_SINGULAR: f64 = 1e-3;

/// The distance of a cut, a kink or a pole from the shortest step, relative to the scales: before a pole bounds grow, and
/// steps end 1.7e-8 before that of a tangent.
const NEAR: f64 = 1.0 / (1_u64 << 24) as f64;

/// The error of a part of a motion in a box that has no certificate; `q` is a position next to it.
pub(super) fn reason<M: Certifiable>(system: &System<M>, q: &[f64], within: &[Interval]) -> CertifyErrorOf<M> {
    let (mechanism, input) = (system.mechanism.name(), within.last().copied().unwrap_or(Interval::ENTIRE));
    let wider = |(&x, scale): (&Interval, &f64)| x + symmetric(NEAR * scale);
    let around: Vec<Interval> = within.iter().zip(&system.scales).map(wider).collect();
    if let Some(error) = no_bounds(system, within).or_else(|| no_bounds(system, &around)) {
        return error;
    }
    match nearest(system, q) {
        Some((group, regularity)) if regularity < NEARLY_SINGULAR || may_be_singular(system, &group, q, within) => {
            CertifyError::Singular { mechanism, group: group.name, input }
        }
        _ => CertifyError::Undecided { mechanism, input },
    }
}

/// True if the tolerances may make a group singular in a box.
fn may_be_singular<M: Certifiable>(
    system: &System<M>,
    group: &Group<'_, M::Name>,
    q: &[f64],
    within: &[Interval],
) -> bool {
    system.has_tolerances() && !is_regular(system, group, q, within)
}

/// True if a group is singular nowhere in a box: |I - Y J| < 1 with the inverse Y at a point.
fn is_regular<M: Certifiable>(system: &System<M>, group: &Group<'_, M::Name>, q: &[f64], within: &[Interval]) -> bool {
    let over = system.jacobian(Dimensions::All, within);
    let entry = |column: usize, row: usize| Some(*over.get(column)?.get(row)? * scale_of(system, column).into());
    let column = |&column: &usize| group.equations.iter().filter_map(|&row| entry(column, row)).collect();
    let block: Vec<Vec<Interval>> = group.unknowns.iter().map(column).collect();
    let columns: Vec<&[Interval]> = block.iter().map(Vec::as_slice).collect();
    let (inverse, _) = inverse_of(system, group, &system.float_jacobian(q));
    let scales = vec![1.0; group.unknowns.len()];
    inverse.is_some_and(|inverse| norm(&defect(&inverse, &columns), &scales) < 1.0)
}

/// The error of a start that has no certificate.
pub(super) fn no_position<M: Certifiable>(system: &System<M>, guess: &[f64]) -> CertifyErrorOf<M> {
    let point: Vec<Interval> = guess.iter().map(|&x| x.into()).collect();
    let otherwise =
        || CertifyError::NoPosition { mechanism: system.mechanism.name(), group: nearest_group(system, guess) };
    no_bounds(system, &point).unwrap_or_else(otherwise)
}

/// The error of a group whose equations have no bounded derivative in a box.
fn no_bounds<M: Certifiable>(system: &System<M>, within: &[Interval]) -> Option<CertifyErrorOf<M>> {
    let columns = system.jacobian(Dimensions::All, within);
    let has_bounds =
        |row: usize| columns.iter().filter_map(|column| column.get(row)).all(|x| x.magnitude().is_finite());
    let group = system.mechanism.groups().find(|group| !group.equations.iter().all(|&row| has_bounds(row)))?;
    let input = within.last().copied().unwrap_or(Interval::ENTIRE);
    Some(CertifyError::NoBounds { mechanism: system.mechanism.name(), group: group.name, input })
}

/// The name of the group whose block of J is nearest to a singularity at a point.
pub(super) fn nearest_group<M: Certifiable>(system: &System<M>, q: &[f64]) -> M::Name {
    nearest(system, q).map_or_else(|| Name::from_static(""), |(group, _)| group.name)
}

/// The group whose block of J is nearest to a singularity at a point, and the regularity of it: 1 divided by the largest
/// entry of the inverse, relative to the scales of rows and columns. A group that is singular nowhere, as a wheel on another
/// one, comes last.
fn nearest<'a, M: Certifiable>(system: &'a System<M>, q: &[f64]) -> Option<(Group<'a, M::Name>, f64)> {
    let columns = system.float_jacobian(q);
    let regularity = |group: &Group<'_, M::Name>| {
        let (inverse, rows) = inverse_of(system, group, &columns);
        let largest = inverse.map(|inverse| {
            let entries = inverse.iter().flat_map(|row| row.iter().zip(&rows).map(|(entry, row)| (entry * row).abs()));
            entries.fold(0.0, f64::max)
        });
        largest.map_or(0.0, |largest| 1.0 / largest)
    };
    let everywhere = vec![Interval::ENTIRE; q.len()];
    let by_regularity = |one: &(_, f64), other: &(_, f64)| one.1.total_cmp(&other.1);
    let all = || system.mechanism.groups().map(|group| (group, regularity(&group)));
    let singular = all().filter(|(group, _)| !is_regular(system, group, q, &everywhere));
    singular.min_by(by_regularity).or_else(|| all().min_by(by_regularity))
}

/// The inverse of the block of a group, with the columns relative to the scales of its unknowns, and the scales of its
/// rows.
fn inverse_of<M: Certifiable>(
    system: &System<M>,
    group: &Group<'_, M::Name>,
    columns: &[Vec<f64>],
) -> (Option<Vec<Vec<f64>>>, Vec<f64>) {
    let entry = |column: usize, row: usize| Some(columns.get(column)?.get(row)? * scale_of(system, column));
    let column = |&column: &usize| group.equations.iter().filter_map(|&row| entry(column, row)).collect();
    let block: Vec<Vec<f64>> = group.unknowns.iter().map(column).collect();
    let rows: Vec<f64> = group.equations.iter().filter_map(|&row| system.rows.get(row).copied()).collect();
    let square: Vec<&[f64]> = block.iter().map(Vec::as_slice).collect();
    (crate::matrix::inverse(&square, &rows), rows)
}

fn scale_of<M: Certifiable>(system: &System<M>, column: usize) -> f64 {
    system.scales.get(column).copied().unwrap_or(1.0)
}
