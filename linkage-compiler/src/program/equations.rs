//! Psi and its Jacobians.

use linkage_ir::Intrinsic;

use super::doc::{fenced, lines, without_result};
use super::expression::{Expression, Pattern, Statement, Type, Variable};
use super::function::{Body, results};
use super::plan::{Plan, unnamed};
use crate::derivation::{Row, Step};
use crate::graph::NodeId;
use crate::ids::{CoordinateId, Id, RowId, Table};

/// Matrices with more entries than this are written entry by entry if most of these are zero.
const LARGEST_DENSE: usize = 16;

impl Plan<'_, '_> {
    pub(super) fn equations(&mut self) {
        self.residual();
        self.jacobians();
        self.jacobian_scales();
        self.determinants();
    }

    fn residual(&mut self) {
        let (residual, scales) = (self.derivation.residual.to_vec(), self.derivation.residual_scales.to_vec());
        let mut doc = lines(["The residual Psi(q) of the loop equations and constraints; Psi(q) = 0 at a position."]);
        let eliminations = &self.driver.system.eliminations;
        if !eliminations.is_empty() {
            let unknowns = &self.driver.unknowns;
            let eliminated: Vec<CoordinateId> = eliminations.iter().map(|one| unknowns[one.unknown]).collect();
            doc.push(format!("Eliminated from the other equations of their groups: {}.", self.list(&eliminated)));
        }
        doc.extend(self.numbered("Psi", &residual));
        for constraint in &self.mechanism.constraints {
            doc.extend(constraint.description());
        }
        let body = self.list_of(residual, Expression::sized_vector);
        self.add(self.signatures.residual(), doc, body);
        let doc = lines(["For each row of Psi, the sum of the magnitudes of its terms: the scale of its residual."]);
        let body = self.list_of(scales, Expression::sized_vector);
        self.add(self.signatures.residual_scales(), doc, body);
    }

    pub(super) fn joints(&mut self) {
        let joints = self.derivation.skeleton.clone().unwrap_or_default().joints;
        let nodes: Vec<NodeId> = joints.iter().flat_map(|(_, at)| *at).collect();
        let mut doc = lines(["x and y of each joint, as in a drawing."]);
        let laws = joints.iter().flat_map(|(name, [x, y])| [(format!("{name}.x"), *x), (format!("{name}.y"), *y)]);
        doc.extend(fenced(laws.map(|(name, node)| self.law(name, node))));
        let body = self.list_of(nodes, Expression::vector);
        self.add(self.signatures.joints(joints.len()), without_result(doc), body);
    }

    /// The directions of the guides of a drawing, if it has some.
    pub(super) fn guides(&mut self) {
        let guides = self.derivation.skeleton.clone().unwrap_or_default().guides;
        if guides.is_empty() {
            return;
        }
        let count = guides.len();
        let kernel = self.on_pose(Vec::new(), Vec::new(), unnamed(guides.into_iter().flatten()));
        let pairs = (0..count).map(|guide| Expression::List(results(2 * guide..2 * guide + 2)));
        let doc = lines(["x and y along the guide of each slider and sleeve, as in a drawing."]);
        let body = Body::of(kernel, Expression::List(pairs.collect()));
        self.add(self.signatures.guides(count), without_result(doc), body);
    }

    /// The places of the forces in joints, in the order of `Load`s, and the directions of their first components; the second
    /// is a quarter turn from it.
    pub(super) fn force_places(&mut self) {
        let count = self.mechanism.drawn_forces();
        if count == 0 {
            return;
        }
        let graph = &mut self.derivation.graph;
        let mut nodes = Vec::new();
        for load in &self.mechanism.opened.loads {
            nodes.extend(load.at);
            nodes.extend(match load.normal {
                Some(normal) => normal,
                None => [graph.one(), graph.zero()],
            });
        }
        let kernel = self.on_pose(Vec::new(), Vec::new(), unnamed(nodes));
        let places = (0..count).map(|place| Expression::List(results(4 * place..4 * place + 4)));
        let doc = lines([
            "For each force in a joint, as in a drawing: x and y of the joint, then those of the direction of the first",
            "component of the force.",
        ]);
        let body = Body::of(kernel, Expression::List(places.collect()));
        self.add(self.signatures.force_places(count), without_result(doc), body);
    }

    /// A function of the pose that returns these nodes in a vector.
    fn list_of(&self, nodes: Vec<NodeId>, vector: fn(Vec<Expression>) -> Expression) -> Body {
        let count = nodes.len();
        Body::of(self.on_pose(Vec::new(), Vec::new(), unnamed(nodes)), vector(results(0..count)))
    }

    fn jacobians(&mut self) {
        let (u, v) = (self.signatures.unknowns.len(), self.signatures.inputs.len());
        let (j, a) = (self.derivation.jacobian_unknowns(), self.derivation.jacobian_inputs());
        let (unknowns, inputs) = (&self.driver.unknowns, &self.driver.inputs);
        let order = self.mechanism.coordinate_order(self.driver);
        let mut doc = vec![format!("The constraint Jacobian J = `Psi_u`; its columns are {}.", self.list(unknowns))];
        doc.extend(self.entries("J", &j));
        let body = self.matrix_function(&entries(&j, unknowns.ids()), u, u);
        let mut doc_of_inputs =
            vec![format!("The constraint Jacobian of the inputs A = `Psi_v`; its columns are {}.", self.list(inputs))];
        doc_of_inputs.extend(self.entries("A", &a));
        let body_of_inputs = self.matrix_function(&entries(&a, inputs.ids()), u, v);
        self.add(self.signatures.jacobian_unknowns(), doc, body);
        self.add(self.signatures.jacobian_inputs(), doc_of_inputs, body_of_inputs);

        let doc =
            vec![format!("The constraint Jacobian `Psi_q` of all coordinates; its columns are {}.", self.list(&order))];
        let pose = &self.signatures.arguments.pose;
        let names = |indices: &[CoordinateId]| -> Vec<String> {
            indices.iter().map(|&index| self.mechanism.coordinates[index].name.field.clone()).collect()
        };
        let part = |indices: &[CoordinateId], function: &str| {
            let columns = Pattern::List(names(indices).into_iter().map(Pattern::bound).collect());
            let column = Type::List(Box::new(Type::Scalar), u);
            let of = Type::List(Box::new(column), indices.len());
            let matrix = Expression::own_call(function, [Expression::name(pose)]);
            Statement::Let(columns, Expression::of_type(of, Intrinsic::From, [matrix]))
        };
        let all = Expression::List(names(&order).into_iter().map(Expression::Name).collect());
        let mut body = Body::plain(Expression::made("SMatrix", all));
        body.before =
            vec![part(&self.driver.unknowns, "jacobian_unknowns"), part(&self.driver.inputs, "jacobian_inputs")];
        self.add(self.signatures.jacobian(), without_result(doc), body);
    }

    fn jacobian_scales(&mut self) {
        let (u, v) = (self.signatures.unknowns.len(), self.signatures.inputs.len());
        let (of_unknowns, of_inputs) = self.derivation.jacobian_scales();
        let (unknowns, inputs) = (self.derivation.unknowns.ids(), self.derivation.inputs.ids());
        let body = self.matrix_function(&entries(&of_unknowns, unknowns), u, u);
        self.add(self.signatures.jacobian_unknowns_scales(), Vec::new(), body);
        let body = self.matrix_function(&entries(&of_inputs, inputs), u, v);
        self.add(self.signatures.jacobian_inputs_scales(), Vec::new(), body);
    }

    fn determinants(&mut self) {
        let mut doc = lines(["det J, zero in the singular configurations."]);
        match self.derivation.determinant() {
            Some(node) => doc.extend(fenced([self.law("det J", node)].into_iter())),
            None => doc.extend(lines(["For groups of more than two unknowns it is the product of the pivots."])),
        }
        let (mut steps, mut factors, mut laws) = (Vec::new(), Vec::new(), Vec::new());
        for (id, group) in self.derivation.groups.clone().enumerated() {
            let names = group.title(self.derivation);
            let Some(determinant) = group.determinant else {
                let symbol = self.derivation.graph.symbol(format!("pivots_{}", id.number()));
                steps.push(Step::Pivots { symbol, matrix: self.derivation.block_matrix(group) });
                factors.push(self.derivation.graph.variable(symbol));
                laws.push(format!("{names} ({}): the product of the pivots", group.kind.description()));
                continue;
            };
            let varies = self.derivation.graph.constant_value(determinant.value).is_none();
            let named = self.derivation.graph.variable(determinant.symbol);
            factors.push(if varies { named } else { determinant.value });
            laws.push(format!("{names} ({}): {}", group.kind.description(), self.text(determinant.value)));
        }
        let graph = &mut self.derivation.graph;
        let one = graph.one();
        let product = factors.iter().fold(one, |product, &factor| graph.multiply(product, factor));
        let product = if self.derivation.is_odd { self.derivation.graph.negate(product) } else { product };
        let kernel = self.on_pose(Vec::new(), steps.clone(), unnamed([product]));
        let body = Body::of(kernel, Expression::Result(0));
        self.add(self.signatures.determinant(), doc, body);

        let mut doc = lines(["The determinants of the blocks of J, in the order in which the groups are solved."]);
        doc.extend(fenced(laws.into_iter()));
        let count = factors.len();
        let kernel = self.on_pose(Vec::new(), steps, unnamed(factors));
        let body = Body::of(kernel, Expression::sized_vector(results(0..count)));
        self.add(self.signatures.block_determinants(count), doc, body);
    }

    /// A function of the pose that returns a matrix of these entries.
    fn matrix_function(&self, entries: &[(usize, usize, NodeId)], rows: usize, columns: usize) -> Body {
        let nodes = entries.iter().map(|(_, _, node)| *node);
        let kernel = self.on_pose(Vec::new(), Vec::new(), unnamed(nodes));
        let mut body = Body { kernel: Some(kernel), ..Body::default() };
        let matrix = body.matrix("Matrix", &as_results(entries, 0), rows, columns);
        Body { value: super::Value::Plain(matrix), ..body }
    }

    /// `name_1 = …` of each row.
    pub(super) fn numbered(&self, name: &str, nodes: &[NodeId]) -> Vec<String> {
        fenced(nodes.iter().enumerate().map(|(row, &node)| self.law(format_args!("{name}_{}", row + 1), node)))
    }

    /// `name_12 = …` of each entry.
    fn entries<C: Id>(&self, name: &str, rows: &Table<RowId, Row<C>>) -> Vec<String> {
        let entries = rows.enumerated().flat_map(|(i, row)| row.iter().map(move |(j, &node)| (i, j, node)));
        fenced(entries.map(|(i, j, node)| self.law(format_args!("{name}_{}{}", i.number(), j.number()), node)))
    }

    /// The names of coordinates as the user wrote them.
    fn list(&self, indices: &[CoordinateId]) -> String {
        let names = indices.iter().map(|&index| &self.mechanism.coordinates[index].name.text);
        names.map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ")
    }
}

/// Row, column and node of each entry, column by column.
fn entries<C: Id + Ord>(rows: &[Row<C>], columns: impl Iterator<Item = C>) -> Vec<(usize, usize, NodeId)> {
    let entry = |r: usize, c: C, row: &Row<C>| Some((r, c.index(), *row.get(&c)?));
    columns.flat_map(|c| rows.iter().enumerate().filter_map(move |(r, row)| entry(r, c, row))).collect()
}

/// Row, column and value of entries, the values being consecutive results of the kernel.
pub(super) fn as_results<N>(entries: &[(usize, usize, N)], from: usize) -> Vec<(usize, usize, Expression)> {
    let indices = entries.iter().enumerate();
    indices.map(|(index, (row, column, _))| (*row, *column, Expression::Result(from + index))).collect()
}

impl Body {
    /// A matrix of the runtime type `of` from its entries in column-major order; other entries are zero. Adds the
    /// statements that it needs.
    pub(super) fn matrix(
        &mut self,
        of: &'static str,
        entries: &[(usize, usize, Expression)],
        rows: usize,
        columns: usize,
    ) -> Expression {
        if rows == 0 {
            return Expression::zeros(of, [rows, columns]);
        }
        if rows * columns <= LARGEST_DENSE || 2 * entries.len() >= rows * columns {
            let mut flat = vec![Expression::zero(); rows * columns];
            for (row, column, value) in entries {
                flat[column * rows + row] = value.clone();
            }
            return Expression::made(of, Expression::listed(&flat, rows));
        }
        if entries.is_empty() {
            return Expression::zeros(of, [rows, columns]);
        }
        let matrix = self.local("matrix");
        let Expression::Local(index) = matrix else { return matrix };
        let zeros = Expression::Repeated(Box::new(Expression::zero()), rows);
        let zeros = Expression::Repeated(Box::new(zeros), columns);
        self.after.push(Statement::Let(Pattern::Mutable(Variable::Local(index)), zeros));
        for (row, column, value) in entries {
            let entry = Expression::Index(Box::new(matrix.clone()), *column);
            let entry = Expression::Index(Box::new(entry), *row);
            self.after.push(Statement::Assign(entry, value.clone()));
        }
        Expression::made(of, matrix)
    }
}
