//! The document of a driver.

use std::ops::Deref;

use linkage_ir::document::{Entry, FormulaId, GroupForm, GroupMethod};

use super::data::{
    self, ChainJoint, ChainLink, DriverDocument, Equation, Group, Kernel, KinematicChain, Matrix, Quantity, Root,
    Sensitivity, Symbol, with,
};
use super::layout::Layout;
use super::name::{Name, names, texts};
use super::table::Table;
use crate::derivation::{self, ClosedForm, Derivation, Inverse, QuantityFormulas, Row};
use crate::graph::{NodeId, SymbolId};
use crate::ids::{self, GroupId, Id, InputId, UnknownId};
use crate::model::{self, Driver, Mechanism};
use crate::program::Derived;
use crate::structure::GroupKind;

/// The document of a driver; `kernels` adds its functions.
#[must_use]
pub fn of_driver(
    mechanism: &Mechanism,
    driver: &Driver,
    derivation: &Derivation,
    derived: &Derived,
    kernels: &dyn Fn(&mut Table) -> Vec<Kernel>,
) -> DriverDocument {
    let Derived { formulas, closed_forms, .. } = derived;
    let (inputs, unknowns) = (texts(mechanism, &driver.inputs), texts(mechanism, &driver.unknowns));
    let names = names(mechanism, derivation, &inputs, &unknowns);
    let graph = &derivation.graph;
    let shown = |symbol: SymbolId| names.get(&symbol).copied().unwrap_or(Name::Plain(graph.symbol_name(symbol)));
    let parameters: Vec<&str> = mechanism.parameters.iter().map(|parameter| parameter.name.text.as_str()).collect();
    let mut writer = Writer {
        layout: Layout::new(graph, &shown),
        derivation,
        parameters: &parameters,
        inputs: &inputs,
        unknowns: &unknowns,
    };
    let (by_inputs, by_pairs, by_parameters) = (writer.by_inputs(), writer.by_pairs(), writer.by_parameters());
    let implied: Vec<NodeId> = derivation.implied.iter().map(|implied| implied.residual).collect();
    let groups = formulas.inverses.enumerated();
    let points: Vec<&str> = mechanism.points.iter().map(|point| point.name.text.as_str()).collect();
    let outputs: Vec<&str> = mechanism.outputs.iter().map(|output| output.name.text.as_str()).collect();
    let record = data::Derivation {
        mechanism: driver.name.to_string(),
        parameters: writer.symbols(&parameters),
        inputs: writer.symbols(&inputs),
        unknowns: writer.symbols(&unknowns),
        residual: writer.numbered("Psi", &derivation.residual),
        implied: writer.numbered("chi", &implied),
        jacobian_unknowns: writer.matrix(Name::Plain("J"), None, &derivation.jacobian_unknowns(), unknowns.len()),
        jacobian_inputs: writer.matrix(Name::Plain("A"), None, &derivation.jacobian_inputs(), inputs.len()),
        groups: groups.map(|(number, inverse)| writer.group(number, &closed_forms[number], inverse.as_ref())).collect(),
        determinant: formulas.determinant.map(|node| writer.equation(Name::Determinant(None), node)),
        ratios: writer.derivatives(&unknowns, &by_inputs, &formulas.ratios),
        ratio_derivatives: derivation
            .ratio_derivatives
            .is_some()
            .then(|| writer.derivatives(&unknowns, &by_pairs, &formulas.ratio_derivatives)),
        gamma: writer.numbered("gamma", &derivation.gamma),
        jerk: derivation.eta.as_ref().map(|eta| writer.numbered("eta", eta)),
        sensitivity: derivation.sensitivity.as_ref().map(|first| Sensitivity {
            jacobian: writer.matrix(Name::Plain("Psi_p"), None, &first.jacobian, parameters.len()),
            formulas: {
                let formulas = nonzero(derivation, &formulas.sensitivities);
                writer.derivatives(&unknowns, &by_parameters, &formulas)
            },
        }),
        points: writer.quantities(&points, &["x_", "y_"], &derivation.points, &formulas.points),
        outputs: writer.quantities(&outputs, &[""], &derivation.outputs, &formulas.outputs),
        conditions: formulas.conditions.iter().map(|&condition| writer.layout.condition(condition)).collect(),
        chain: model::KinematicChain::of(mechanism, inputs.len()).map(chain),
        kernels: kernels(&mut writer.layout.table),
    };
    with(record, writer.layout.table)
}

fn chain(model::KinematicChain { links, joints, conditions }: model::KinematicChain) -> KinematicChain {
    let link = |model::ChainLink { name, turns_with, .. }| ChainLink { name, turns_with };
    let joint = |model::ChainJoint { links, slides_along }| ChainJoint { links, slides_along };
    KinematicChain {
        links: links.into_iter().map(link).collect(),
        joints: joints.into_iter().map(joint).collect(),
        conditions,
    }
}

/// The form of a kind of group as documents have it.
fn form(kind: GroupKind) -> GroupForm {
    match kind {
        GroupKind::Rrr => GroupForm::TwoAngles,
        GroupKind::Rrp => GroupForm::AngleAndLength,
        GroupKind::Rpr => GroupForm::AngleAndTurningLength,
        GroupKind::Sliders => GroupForm::TwoLengths,
        GroupKind::Circles => GroupForm::TwoDistances,
        GroupKind::LinkToCircle => GroupForm::AngleAndDistance,
        GroupKind::SliderToCircle => GroupForm::LengthAndDistance,
        GroupKind::Angle => GroupForm::OneAngle,
        GroupKind::Linear => GroupForm::OneLinear,
        GroupKind::Loops(2) => GroupForm::TwoLoops,
        GroupKind::Loops(_) => GroupForm::ThreeLoops,
        GroupKind::Scalar | GroupKind::Pair | GroupKind::Irreducible(..) => GroupForm::Other,
    }
}

/// The formulas, `None` for those that are zero.
fn nonzero<F: Copy + Into<Option<NodeId>>>(
    derivation: &Derivation,
    formulas: &[impl Deref<Target = [F]>],
) -> Vec<Vec<Option<NodeId>>> {
    let formula = |&formula: &F| formula.into().filter(|&node| !derivation.graph.is_zero(node));
    formulas.iter().map(|of_one| of_one.iter().map(formula).collect()).collect()
}

/// Lays out the formulas of one derivation.
pub(super) struct Writer<'a> {
    pub(super) layout: Layout<'a>,
    pub(super) derivation: &'a Derivation,
    pub(super) parameters: &'a [&'a str],
    pub(super) inputs: &'a ids::Table<InputId, &'a str>,
    pub(super) unknowns: &'a ids::Table<UnknownId, &'a str>,
}

/// The variables of a first or second derivative.
#[derive(Clone, Copy)]
enum By<'a> {
    One(&'a str),
    Two([&'a str; 2]),
}

impl By<'_> {
    fn name<'n>(&'n self, of: &'n str) -> Name<'n> {
        match *self {
            Self::One(by) => Name::Ratio { of, by },
            Self::Two(by) => Name::RatioDerivative { of, by },
        }
    }
}

impl<'a> Writer<'a> {
    fn by_inputs(&self) -> Vec<By<'a>> {
        self.inputs.iter().map(|&by| By::One(by)).collect()
    }

    fn by_pairs(&self) -> Vec<By<'a>> {
        let pairs = self.derivation.ratio_derivatives.iter().flat_map(|second| &second.pairs);
        pairs.map(|&(j, k)| By::Two([self.inputs[j], self.inputs[k]])).collect()
    }

    fn by_parameters(&self) -> Vec<By<'a>> {
        self.parameters.iter().map(|&by| By::One(by)).collect()
    }

    pub(super) fn plain(&mut self, name: &str) -> FormulaId {
        self.layout.table.plain(name)
    }

    pub(super) fn formula(&mut self, node: NodeId) -> FormulaId {
        self.layout.formula(node)
    }

    /// Parameters or coordinates with these names.
    pub(super) fn symbols(&mut self, names: &[&str]) -> Vec<Symbol> {
        names.iter().map(|&name| Symbol { name: name.to_owned(), formula: self.plain(name) }).collect()
    }

    pub(super) fn equation(&mut self, left: Name, right: NodeId) -> Equation {
        Equation { left: self.layout.table.name(left), right: self.formula(right) }
    }

    /// name_1 = …, name_2 = …
    fn numbered(&mut self, name: &str, nodes: &[NodeId]) -> Vec<Equation> {
        let mut numbered = |(index, &node)| self.equation(Name::Plain(&format!("{name}{}", index + 1)), node);
        nodes.iter().enumerate().map(&mut numbered).collect()
    }

    pub(super) fn matrix<C: Id>(
        &mut self,
        name: Name,
        factor: Option<NodeId>,
        rows: &[Row<C>],
        columns: usize,
    ) -> Matrix {
        let name = self.layout.table.name(name);
        let factor = factor.map(|factor| self.formula(factor));
        let mut entries = Vec::new();
        for (row, of_row) in rows.iter().enumerate() {
            let entry =
                |(&column, &node): (&C, &NodeId)| Entry { row, column: column.index(), value: self.formula(node) };
            entries.extend(of_row.iter().map(entry));
        }
        Matrix { name, factor, rows: rows.len(), columns, entries }
    }

    fn group(&mut self, id: GroupId, position: &ClosedForm, inverse: Option<&Inverse>) -> Group {
        let group = &self.derivation.groups[id];
        let number = (self.derivation.groups.len() > 1).then_some(id.number());
        let determinant = group.determinant.as_ref().map(|determinant| determinant.value);
        Group {
            unknowns: group.unknowns.iter().map(|&index| self.plain(self.unknowns[index])).collect(),
            equations: group.equations.iter().map(|&equation| equation.index()).collect(),
            kind: group.kind.description(),
            form: form(group.kind),
            method: if determinant.is_some() { GroupMethod::ClosedForm } else { GroupMethod::Factorization },
            determinant: determinant.map(|value| self.equation(Name::Determinant(number), value)),
            inverse: inverse.map(|(factor, rows)| self.matrix(Name::Inverse(number), Some(*factor), rows, rows.len())),
            root: position.root.map(|(root, choice)| Root {
                formula: self.formula(root),
                branches: choice.variants().map(str::to_owned),
            }),
            position: position
                .equations
                .iter()
                .map(|&[left, right]| Equation { left: self.formula(left), right: self.formula(right) })
                .collect(),
        }
    }

    /// The equations of the derivatives of named quantities, in the order of the variables; those without formula are
    /// omitted.
    fn derivatives<F: Copy + Into<Option<NodeId>>>(
        &mut self,
        of: &[impl AsRef<str>],
        by: &[By<'_>],
        formulas: &[impl Deref<Target = [F]>],
    ) -> Vec<Equation> {
        let mut equations = Vec::new();
        for (by, formulas) in by.iter().zip(formulas) {
            for (of, &formula) in of.iter().zip(formulas.iter()) {
                if let Some(node) = formula.into() {
                    equations.push(self.equation(by.name(of.as_ref()), node));
                }
            }
        }
        equations
    }

    /// Points or outputs; the name of a component is a prefix and the name of the quantity.
    fn quantities(
        &mut self,
        names: &[&str],
        prefixes: &[&str],
        quantities: &[derivation::Quantity],
        formulas: &[QuantityFormulas],
    ) -> Vec<Quantity> {
        let (by_inputs, by_pairs, by_parameters) = (self.by_inputs(), self.by_pairs(), self.by_parameters());
        let quantities = names.iter().zip(quantities).zip(formulas).map(|((name, quantity), formulas)| {
            let components: Vec<String> = prefixes.iter().map(|prefix| format!("{prefix}{name}")).collect();
            let values = components.iter().zip(&quantity.value);
            Quantity {
                name: (*name).to_owned(),
                value: values.map(|(component, &node)| self.equation(Name::Plain(component), node)).collect(),
                ratios: self.derivatives(&components, &by_inputs, &formulas.ratios),
                ratio_derivatives: self.derivatives(&components, &by_pairs, &formulas.ratio_derivatives),
                sensitivities: {
                    let first = nonzero(self.derivation, &formulas.sensitivities);
                    self.derivatives(&components, &by_parameters, &first)
                },
            }
        });
        quantities.collect()
    }
}
