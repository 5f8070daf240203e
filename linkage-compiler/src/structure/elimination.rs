//! Elimination of unknowns that enter linearly, such as the coordinates of a joint between two loops.
//!
//! If a row of a group is c u + r = 0 with a number c and an r free of u, then u = -r / c may be put into the other rows
//! of the group. They then do not contain u, which is solved after them, and the rest may split into smaller groups. The
//! solutions are those of the rows as written: `loop a@phi + b@psi = (x, y); loop (x, y) = d@0 + c@chi;` becomes a dyad
//! of psi and chi.
//!
//! Only groups without a closed form are changed, loops only into parts of which all positions can be listed, and those of
//! two unknowns only if they get one. An unknown that is an angle comes last, and only if it is an integer combination of
//! the other angles of its row, so that no half angle results. Among equals the row with the fewest unknowns is taken:
//! H. M. Markowitz, "The elimination form of the inverse and its application to linear programming", Management Science 3,
//! 1957.

use std::collections::BTreeSet;

use rustc_hash::FxHashMap;

use super::{Class, Group, GroupKind, StructurallySingular, find_slides, order};
use crate::graph::{Graph, NodeId, Number, SymbolId};
use crate::ids::{GroupId, Id, RowId, Table, UnknownId};

/// Psi in the form in which it is solved, and the order of solution.
#[derive(Debug, Clone, Default)]
pub struct System {
    pub rows: Table<RowId, NodeId>,
    pub groups: Table<GroupId, Group>,
    /// The eliminations that lead from the rows as written to these rows, in order.
    pub eliminations: Vec<Elimination>,
}

/// The elimination of one unknown u by the row i: row j becomes row j - m row i up to terms that vanish with row i
/// itself, where m = (d row j / du) / (d row i / du).
#[derive(Debug, Clone)]
pub struct Elimination {
    pub unknown: UnknownId,
    pub pivot: RowId,
    /// j and m.
    pub multiples: Vec<(RowId, NodeId)>,
}

impl System {
    /// Orders these rows, after the elimination of unknowns that enter linearly where it splits a group. `loops` has the
    /// two rows of each loop.
    ///
    /// # Errors
    /// [`StructurallySingular`] if the system is singular for all values of the parameters.
    pub fn new(
        graph: &mut Graph,
        rows: Table<RowId, NodeId>,
        unknowns: &Table<UnknownId, SymbolId>,
        loops: &[[RowId; 2]],
    ) -> Result<Self, StructurallySingular> {
        let groups = order(&incidence(graph, &rows, unknowns), unknowns.len())?;
        let mut reduction = Reduction { graph, unknowns, rows, eliminations: Vec::new() };
        for group in &groups {
            reduction.split(group.clone());
        }
        let mut incidence = incidence(reduction.graph, &reduction.rows, unknowns);
        let mut groups = if reduction.eliminations.is_empty() { groups } else { order(&incidence, unknowns.len())? };
        let joined = reduction.sliders_on_axes(&groups, loops);
        let Reduction { graph, rows, eliminations, .. } = reduction;
        if !joined.is_empty() {
            incidence = self::incidence(graph, &rows, unknowns);
            for (row, unknown) in joined {
                incidence[row].push(unknown);
            }
            groups = order(&incidence, unknowns.len())?;
        }
        find_slides(&mut groups, &incidence, loops, graph, &rows, unknowns);
        Ok(Self { rows, groups, eliminations })
    }
}

/// The unknowns in each row.
/// The unknowns of each row.
pub fn incidence(
    graph: &Graph,
    rows: &Table<RowId, NodeId>,
    unknowns: &Table<UnknownId, SymbolId>,
) -> Table<RowId, Vec<UnknownId>> {
    let indices: FxHashMap<SymbolId, UnknownId> =
        unknowns.enumerated().map(|(index, &symbol)| (symbol, index)).collect();
    rows.iter()
        .map(|&row| {
            let symbols = graph.symbols_of(&[row]);
            let mut found: Vec<UnknownId> = symbols.iter().filter_map(|symbol| indices.get(symbol).copied()).collect();
            found.sort_unstable();
            found
        })
        .collect()
}

/// A row c u + r = 0 of a group, and u.
struct Pivot {
    row: RowId,
    unknown: UnknownId,
    factor: Number,
}

struct Reduction<'a> {
    graph: &'a mut Graph,
    unknowns: &'a Table<UnknownId, SymbolId>,
    rows: Table<RowId, NodeId>,
    eliminations: Vec<Elimination>,
}

impl Reduction<'_> {
    /// Eliminates unknowns of a group, and of the groups into which it falls, until all have a closed form or no unknown
    /// is left that enters linearly.
    fn split(&mut self, group: Group) {
        let mut open = vec![group];
        while let Some(group) = open.pop() {
            match self.kind(&group) {
                kind if kind.is_closed() || self.graph.budget().check().is_err() => {}
                kind if kind.most_modes().is_some() => self.split_loops(&group),
                _ => open.extend(self.parts_after_elimination(&group)),
            }
        }
    }

    /// Splits a group of which all positions can be listed, such as loops with a slider along an axis, if that is so of
    /// all its parts. Such a group is small.
    fn split_loops(&mut self, group: &Group) {
        if self.pivot(group).is_none() {
            return;
        }
        let (rows, eliminations) = (self.rows.clone(), self.eliminations.len());
        if !self.ends(group) {
            self.rows = rows;
            self.eliminations.truncate(eliminations);
        }
    }

    /// Eliminates unknowns, and returns true if all positions of each part can be listed.
    fn ends(&mut self, group: &Group) -> bool {
        let parts = self.parts_after_elimination(group);
        let is_listed = |reduction: &mut Self, part: &Group| match reduction.kind(part) {
            group if group.is_closed() => true,
            kind if kind.most_modes().is_some() => {
                reduction.split_loops(part);
                true
            }
            _ => reduction.ends(part),
        };
        !parts.is_empty() && parts.iter().all(|part| is_listed(self, part))
    }

    /// The groups into which a group falls after the elimination of one unknown; none if nothing is gained.
    fn parts_after_elimination(&mut self, group: &Group) -> Vec<Group> {
        let Some(pivot) = self.pivot(group) else { return Vec::new() };
        let rest = Group {
            equations: group.equations.iter().copied().filter(|&row| row != pivot.row).collect(),
            unknowns: group.unknowns.iter().copied().filter(|&unknown| unknown != pivot.unknown).collect(),
            slide: None,
        };
        let before = self.rows.at(&rest.equations);
        let elimination = self.eliminate(&pivot, &rest.equations);
        let parts = self.parts(&rest).unwrap_or_default();
        // Rows that depend on one another stay as written, and so do two rows that gain nothing.
        let is_better = match parts.as_slice() {
            [] => false,
            [only] if only.unknowns.len() == 1 => self.is_closed(only),
            _ => true,
        };
        if is_better {
            self.eliminations.push(elimination);
            return parts;
        }
        for (&row, node) in rest.equations.iter().zip(before) {
            self.rows[row] = node;
        }
        Vec::new()
    }

    /// Lengths that only one of the two rows of a loop has, along an axis, if all positions of the group can be listed
    /// when they are solved with it: the other rows, each with its length.
    fn sliders_on_axes(&mut self, groups: &Table<GroupId, Group>, loops: &[[RowId; 2]]) -> Vec<(RowId, UnknownId)> {
        let other: FxHashMap<RowId, RowId> = loops.iter().flat_map(|&[x, y]| [(x, y), (y, x)]).collect();
        let single: FxHashMap<RowId, UnknownId> = groups
            .iter()
            .filter_map(|group| match (group.equations.as_slice(), group.unknowns.as_slice()) {
                (&[row], &[unknown]) => Some((row, unknown)),
                _ => None,
            })
            .collect();
        let mut joined = Vec::new();
        for group in groups.iter().filter(|group| group.unknowns.len() > 1) {
            let axes: Vec<(RowId, RowId, UnknownId)> = group
                .equations
                .iter()
                .filter_map(|&row| other.get(&row).and_then(|other| Some((row, *other, *single.get(other)?))))
                .collect();
            if axes.is_empty() || self.kind(group).obstacle().is_none() {
                continue;
            }
            let mut whole = group.clone();
            whole.equations.extend(axes.iter().map(|(_, other, _)| *other));
            whole.unknowns.extend(axes.iter().map(|(.., unknown)| *unknown));
            whole.equations.sort_unstable();
            whole.unknowns.sort_unstable();
            let before = (self.rows.clone(), self.eliminations.clone());
            axes.iter().for_each(|&(_, other, _)| self.follow(other));
            if self.kind(&whole).most_modes().is_some() {
                joined.extend(axes.into_iter().map(|(row, _, unknown)| (row, unknown)));
            } else {
                (self.rows, self.eliminations) = before;
            }
        }
        joined
    }

    /// Puts the values of the eliminated unknowns into a row of another group.
    fn follow(&mut self, row: RowId) {
        for index in 0..self.eliminations.len() {
            let Elimination { unknown, pivot, .. } = self.eliminations[index];
            let symbol = self.unknowns[unknown];
            if pivot != row
                && let Some(factor) = self.factor(self.rows[pivot], symbol)
            {
                let more = self.eliminate(&Pivot { row: pivot, unknown, factor }, &[row]).multiples;
                self.eliminations[index].multiples.extend(more);
            }
        }
    }

    fn symbols(&self, group: &Group) -> Vec<SymbolId> {
        self.unknowns.at(&group.unknowns)
    }

    fn kind(&mut self, group: &Group) -> GroupKind {
        let symbols = self.symbols(group);
        Class::of(self.graph, &self.rows.at(&group.equations), &symbols).kind
    }

    fn is_closed(&mut self, group: &Group) -> bool {
        self.kind(group).is_closed()
    }

    fn pivot(&mut self, group: &Group) -> Option<Pivot> {
        let symbols = self.symbols(group);
        let angles: BTreeSet<SymbolId> =
            self.graph.in_directions(&self.rows.at(&group.equations)).into_iter().collect();
        let mut best: Option<((bool, usize), Pivot)> = None;
        for &row in &group.equations {
            let node = self.rows[row];
            let in_row: BTreeSet<SymbolId> = self.graph.symbols_of(&[node]).into_iter().collect();
            let count = symbols.iter().filter(|symbol| in_row.contains(symbol)).count();
            for (&unknown, &symbol) in group.unknowns.iter().zip(&symbols).filter(|(_, symbol)| in_row.contains(symbol))
            {
                let rank = (angles.contains(&symbol), count);
                if best.as_ref().is_some_and(|(other, _)| *other <= rank) {
                    continue;
                }
                let Some(factor) = self.factor(node, symbol) else { continue };
                let others = symbols.iter().copied().filter(|other| *other != symbol && angles.contains(other));
                if angles.contains(&symbol) && !others.clone().all(|other| self.is_multiple(node, other, factor)) {
                    continue;
                }
                best = Some((rank, Pivot { row, unknown, factor }));
            }
        }
        best.map(|(_, pivot)| pivot)
    }

    /// The derivative of a row with respect to an unknown, if it is a number other than zero.
    fn factor(&mut self, row: NodeId, unknown: SymbolId) -> Option<Number> {
        let slope = self.graph.partial(&[row], unknown)[0];
        self.graph.as_number(slope).filter(|factor| !factor.is_zero())
    }

    /// True if a row contains an integer multiple of `factor` times an angle, and the angle nowhere else.
    fn is_multiple(&mut self, row: NodeId, angle: SymbolId, factor: Number) -> bool {
        let slope = self.graph.partial(&[row], angle)[0];
        let times = self.graph.as_number(slope).map(|slope| slope.multiply(factor.power(-1)));
        times.is_some_and(|times| times.as_integer().is_some())
    }

    fn eliminate(&mut self, pivot: &Pivot, others: &[RowId]) -> Elimination {
        let symbol = self.unknowns[pivot.unknown];
        let variable = self.graph.variable(symbol);
        let part = pivot.factor.power(-1).negate();
        let value = self.graph.sum(&[(Number::ONE, variable), (part, self.rows[pivot.row])]);
        let by = std::iter::once((variable, value)).collect();
        let mut multiples = Vec::new();
        for &row in others {
            let slope = self.graph.partial(&[self.rows[row]], symbol)[0];
            if self.graph.is_zero(slope) {
                continue;
            }
            multiples.push((row, self.graph.scale(pivot.factor.power(-1), slope)));
            self.rows[row] = self.graph.replace(&[self.rows[row]], &by)[0];
        }
        Elimination { unknown: pivot.unknown, pivot: pivot.row, multiples }
    }

    /// The groups of a part of the system.
    fn parts(&self, part: &Group) -> Result<Vec<Group>, StructurallySingular> {
        let rows: Table<RowId, NodeId> = self.rows.at(&part.equations).into();
        let unknowns: Table<UnknownId, SymbolId> = self.symbols(part).into();
        let groups = order(&incidence(self.graph, &rows, &unknowns), unknowns.len())?;
        let named = |group: &Group| Group {
            equations: group.equations.iter().map(|row| part.equations[row.index()]).collect(),
            unknowns: group.unknowns.iter().map(|unknown| part.unknowns[unknown.index()]).collect(),
            slide: None,
        };
        Ok(groups.iter().map(named).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::graph::Function;

    /// A graph with symbols by name, and the vector r@(angle).
    struct Plane {
        graph: Graph,
        names: Vec<(&'static str, SymbolId)>,
    }

    impl Plane {
        fn new(names: &[&'static str]) -> Self {
            let mut graph = Graph::default();
            let names = names.iter().map(|&name| (name, graph.symbol(name))).collect();
            Self { graph, names }
        }

        fn symbol(&self, name: &str) -> SymbolId {
            self.names.iter().find(|(other, _)| *other == name).expect(name).1
        }

        fn variable(&mut self, name: &str) -> NodeId {
            let symbol = self.symbol(name);
            self.graph.variable(symbol)
        }

        fn link(&mut self, length: &str, angle: &str) -> [NodeId; 2] {
            let [length, angle] = [length, angle].map(|name| self.variable(name));
            [Function::Cos, Function::Sin].map(|function| {
                let part = self.graph.call(function, &[angle]);
                self.graph.multiply(length, part)
            })
        }

        fn order(&mut self, rows: Vec<NodeId>, unknowns: &[&str]) -> (System, Vec<GroupKind>) {
            let unknowns: Table<UnknownId, SymbolId> = unknowns.iter().map(|name| self.symbol(name)).collect();
            let system = System::new(&mut self.graph, rows.into(), &unknowns, &[]).unwrap();
            let group = |group: &Group| {
                let (rows, symbols) = (system.rows.at(&group.equations), unknowns.at(&group.unknowns));
                Class::of(&mut self.graph, &rows, &symbols).kind
            };
            let groups = system.groups.iter().map(group).collect();
            (system, groups)
        }
    }

    #[test]
    fn a_joint_between_two_loops() {
        let mut plane = Plane::new(&["x", "y", "a", "b", "c", "phi", "psi", "chi"]);
        let [crank, rod, rocker] = [("a", "phi"), ("b", "psi"), ("c", "chi")].map(|(l, angle)| plane.link(l, angle));
        let joint = ["x", "y"].map(|name| plane.variable(name));
        let g = &mut plane.graph;
        let first = [0, 1].map(|axis| {
            g.sum(&[(Number::ONE, crank[axis]), (Number::ONE, rod[axis]), (Number::MINUS_ONE, joint[axis])])
        });
        let second = [0, 1].map(|axis| g.subtract(joint[axis], rocker[axis]));
        let rows = [first, second].concat();
        let (system, groups) = plane.order(rows.clone(), &["x", "y", "psi", "chi"]);
        assert_eq!(groups, [GroupKind::Rrr, GroupKind::Linear, GroupKind::Linear]);
        // The rows as written are those of the system and multiples of the pivots.
        let mut written = system.rows;
        for elimination in system.eliminations.iter().rev() {
            for &(row, multiple) in &elimination.multiples {
                let part = plane.graph.multiply(multiple, written[elimination.pivot]);
                written[row] = plane.graph.add(written[row], part);
            }
        }
        assert_eq!(*written, *rows);
    }

    #[test]
    fn equal_angles_and_rows_that_depend_on_one_another() {
        let mut plane = Plane::new(&["a", "b", "phi", "psi", "chi", "d"]);
        let [rod, rocker] = [("a", "phi"), ("b", "psi")].map(|(l, angle)| plane.link(l, angle));
        let third = plane.link("d", "chi");
        let [phi, chi, d] = ["phi", "chi", "d"].map(|name| plane.variable(name));
        let g = &mut plane.graph;
        let gear = g.sum(&[(Number::ONE, chi), (Number::integer(-2), phi), (Number::ONE, d)]);
        let rows = [0, 1]
            .map(|axis| g.sum(&[(Number::ONE, rod[axis]), (Number::ONE, rocker[axis]), (Number::ONE, third[axis])]))
            .into_iter()
            .chain([gear])
            .collect();
        // 2 phi has no half: chi is eliminated, not phi.
        let (system, groups) = plane.order(rows, &["phi", "psi", "chi"]);
        assert_eq!(system.eliminations.iter().map(|one| one.unknown.index()).collect::<Vec<_>>(), [2]);
        assert_eq!(groups, [GroupKind::Pair, GroupKind::Linear]);
        // x = d cos(chi), twice.
        let g = &mut plane.graph;
        let row = g.subtract(phi, third[0]);
        let (system, groups) = plane.order(vec![row, row], &["phi", "chi"]);
        assert_eq!((*system.rows).to_vec(), [row, row]);
        assert_eq!(groups, [GroupKind::Pair]);
    }
}
