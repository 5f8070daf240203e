//! Sliders on a guide along an axis.
//!
//! With its guide along x or y, a dyad RRP falls apart into two groups: one row of its loop has only the angle, the
//! other then gives the length. Its two solutions are named as those of a dyad along any other line: by the length.

use super::{Class, Group, GroupKind};
use crate::graph::{Graph, NodeId, SymbolId};
use crate::ids::{GroupId, Id, RowId, Table, UnknownId};

/// The length of a slider, for the group of the angle of its link.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Slide {
    pub length: UnknownId,
    /// True if the larger length belongs to the angle at which the row of the group increases with the angle.
    pub is_far_rising: bool,
}

/// Finds the slider of each group that is the angle of a dyad RRP. `loops` has the two rows of each loop.
pub fn find_slides(
    groups: &mut Table<GroupId, Group>,
    incidence: &Table<RowId, Vec<UnknownId>>,
    loops: &[[RowId; 2]],
    graph: &mut Graph,
    rows: &Table<RowId, NodeId>,
    symbols: &Table<UnknownId, SymbolId>,
) {
    let mut solved_in: Table<UnknownId, usize> = symbols.filled(0);
    let mut used_in = rows.filled(0);
    for (index, group) in groups.iter().enumerate() {
        group.unknowns.iter().for_each(|&unknown| solved_in[unknown] = index);
        group.equations.iter().for_each(|&row| used_in[row] = index);
    }
    let singles = |group: &Group| match group.unknowns.as_slice() {
        &[unknown] => Some(unknown),
        _ => None,
    };
    let alone: Vec<Option<UnknownId>> = groups.iter().map(singles).collect();
    for &[x, y] in loops {
        let (row, other) = if used_in[x] < used_in[y] { (x, y) } else { (y, x) };
        let [index, later] = [row, other].map(|row| used_in[row]);
        let (Some(angle), Some(length)) = (alone[index], alone[later]) else { continue };
        let is_known = |&unknown: &UnknownId| solved_in[unknown] <= index || unknown == length;
        let [phi, s] = [angle, length].map(|unknown| symbols[unknown]);
        if !incidence[other].iter().all(is_known) {
            continue;
        }
        let class = Class::of(graph, &[rows[x], rows[y]], &[phi, s]);
        if class.kind != GroupKind::Rrp {
            continue;
        }
        // With V the link and E the direction of the guide, V + s E = D and dV/dphi = i V: for a guide along x,
        // s = (D_x - V_x) / E_x and dV_y/dphi = V_x; along y, s = (D_y - V_y) / E_y and dV_x/dphi = -V_y. A mirrored angle
        // turns the other way.
        let slope = graph.partial(&[rows[other]], s)[0];
        let Some(slope) = graph.as_number(slope) else { continue };
        let is_far_rising = ((slope.to_f64() > 0.0) == (row == x)) != class.mirrored.contains(&phi);
        groups[GroupId::new(index)].slide = Some(Slide { length, is_far_rising });
    }
}
