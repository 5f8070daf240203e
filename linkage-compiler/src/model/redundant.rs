//! Joints whose forces are not determined, because `implied` loops support the links too.
//!
//! An implied row I follows from the rows Psi of the loops: its gradient is `I_q` = C `Psi_q`. If its joints carry forces
//! mu, those of the loops change by -C' mu, and the force of the displacement d of a joint by (`I_d` - C `Psi_d`)' mu.
//! It is determined if this is zero for every mu. There are two cases:
//!
//! - The row is a sum of other rows with constant factors, as the outer one of three loops: C has these factors, and the
//!   row says nothing new.
//! - Otherwise C has entries only in the rows that determine the coordinates of the implied row. Every choice of inputs
//!   leads to the one C: a joint counts as determined if one choice shows it.

use std::collections::{BTreeMap, BTreeSet};

use super::mechanism::Mechanism;
use super::resolver::Resolver;
use crate::graph::{Graph, NodeId, Number, SymbolId};
use crate::ids::{Id, RowId, Table, UnknownId};
use crate::structure::{incidence, order};

/// The most rows among which constant factors are looked for. With more, no factors are found.
const MOST_ROWS: usize = 64;

impl Resolver<'_> {
    /// Marks the joints whose forces are not determined; reports frictions by these forces. Equations that displacements
    /// change do carry forces to the joints.
    pub(super) fn undetermined(&mut self, result: &mut Mechanism) {
        let moved = displacements(&mut self.graph, result);
        let rows = result.constraints.iter().flat_map(|constraint| &constraint.rows).zip(&result.opened.rows);
        let by_points: BTreeSet<NodeId> = rows.filter(|(row, opened)| row != opened).map(|(&row, _)| row).collect();
        for load in &mut result.opened.loads {
            load.left_out.retain(|row| !by_points.contains(row));
            load.is_determined = !load.displacement.iter().any(|symbol| moved.contains(symbol));
        }
        for scene in result.scenes.iter() {
            for (contact, region) in scene.wanted.iter().filter_map(|wanted| wanted.of_friction()) {
                let load = scene.contacts[contact].bearing.map(|load| &result.opened.loads[load]);
                if let Some(load) = load.filter(|load| !load.is_determined) {
                    let message = format!(
                        "{} is not determined: an `implied` loop may carry a part of it; write the normal force instead \
                         of `reaction`, or remove the `implied` loop",
                        load.description()
                    );
                    self.diagnostics.error(region, message);
                }
            }
        }
    }
}

/// The displacements whose forces depend on those of implied rows.
fn displacements(graph: &mut Graph, mechanism: &Mechanism) -> BTreeSet<SymbolId> {
    let rows: Table<RowId, NodeId> = mechanism.constraints.iter().flat_map(|loops| loops.rows.clone()).collect();
    let implied = mechanism.implied.iter().flat_map(|loops| loops.rows.iter().copied());
    let opened = &mechanism.opened;
    let mut moved = BTreeSet::new();
    for (row, &displaced) in implied.zip(&opened.implied) {
        let choices = choices(graph, mechanism, row);
        let of_choices = choices.iter().filter_map(|unknowns| determining(graph, &rows, unknowns, row));
        let of_choices: Vec<Vec<RowId>> = of_choices.collect();
        let Some((first, others)) = of_choices.split_first() else { continue };
        let symbols = match constant_factors(graph, row, &rows, first) {
            Some(factors) => {
                let terms = first.iter().zip(factors).map(|(&row, factor)| (factor.negate(), opened.rows[row.index()]));
                let rest = graph.sum(&terms.chain([(Number::ONE, displaced)]).collect::<Vec<_>>());
                graph.symbols_of(&[rest]).into_iter().collect()
            }
            None => {
                let of = |rows: &[RowId]| -> BTreeSet<SymbolId> {
                    let rows = rows.iter().map(|row| opened.rows[row.index()]);
                    graph.symbols_of(&rows.chain([displaced]).collect::<Vec<_>>()).into_iter().collect()
                };
                others.iter().fold(of(first), |all, rows| &all & &of(rows))
            }
        };
        moved.extend(symbols);
    }
    moved
}

/// The unknowns of the first driver, and those with an unknown of the implied row as an input instead.
fn choices(graph: &Graph, mechanism: &Mechanism, row: NodeId) -> Vec<Table<UnknownId, SymbolId>> {
    let Some(driver) = mechanism.drivers.first() else { return Vec::new() };
    let symbol = |&coordinate| mechanism.coordinates[coordinate].symbol;
    let unknowns: Table<UnknownId, SymbolId> = driver.unknowns.iter().map(symbol).collect();
    let of_row = graph.symbols_of(&[row]);
    let mut choices = vec![unknowns.clone()];
    for (place, _) in unknowns.enumerated().filter(|(_, unknown)| of_row.contains(unknown)) {
        for input in driver.inputs.iter().map(symbol) {
            let mut other = unknowns.clone();
            other[place] = input;
            choices.push(other);
        }
    }
    choices
}

/// The rows that determine the unknowns of an implied row; `None` if they do not determine all unknowns.
fn determining(
    graph: &Graph,
    rows: &Table<RowId, NodeId>,
    unknowns: &Table<UnknownId, SymbolId>,
    row: NodeId,
) -> Option<Vec<RowId>> {
    let groups = order(&incidence(graph, rows, unknowns), unknowns.len()).ok()?;
    let mut needed: BTreeSet<SymbolId> = graph.symbols_of(&[row]).into_iter().collect();
    let mut found = Vec::new();
    for group in groups.iter().rev() {
        if group.unknowns.iter().any(|&unknown| needed.contains(&unknowns[unknown])) {
            needed.extend(graph.symbols_of(&group.equations.iter().map(|&row| rows[row]).collect::<Vec<_>>()));
            found.extend(&group.equations);
        }
    }
    Some(found)
}

/// The constant factors with which rows add up to another, by elimination; `None` if there are none.
fn constant_factors(
    graph: &mut Graph,
    whole: NodeId,
    rows: &Table<RowId, NodeId>,
    among: &[RowId],
) -> Option<Vec<Number>> {
    let count = among.len();
    if count > MOST_ROWS {
        return None;
    }
    // One equation for each term, with its coefficients in the rows and in the whole.
    let mut of_terms: BTreeMap<NodeId, Vec<Number>> = BTreeMap::new();
    for (column, row) in among.iter().map(|&row| rows[row]).chain([whole]).enumerate() {
        for (coefficient, term) in graph.terms(row) {
            of_terms.entry(term).or_insert_with(|| vec![Number::ZERO; count + 1])[column] = coefficient;
        }
    }
    let mut equations: Vec<Vec<Number>> = of_terms.into_values().collect();
    for column in 0..count {
        let place = column + equations.get(column..)?.iter().position(|equation| !equation[column].is_zero())?;
        equations.swap(column, place);
        let inverse = equations[column][column].power(-1);
        let pivot: Vec<Number> = equations[column].iter().map(|number| number.multiply(inverse)).collect();
        for equation in &mut equations {
            let factor = equation[column].negate();
            for (number, &above) in equation.iter_mut().zip(&pivot) {
                *number = number.plus(above.multiply(factor));
            }
        }
        equations[column] = pivot;
    }
    let is_solved = equations[count..].iter().all(|equation| equation[count].is_zero());
    is_solved.then(|| equations[..count].iter().map(|equation| equation[count]).collect())
}
