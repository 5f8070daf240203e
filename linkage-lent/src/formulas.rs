//! The formulas of one table, and what is made of them.

use linkage_compiler::document::{self, Number};
use linkage_compiler::program::{self, CheckKind};
use linkage_compiler::structure::GroupKind;
use linkage_runtime::derivation::{
    Entry, Equation, Formula, FormulaMatrix, FormulaTable, Group, GroupForm, GroupMethod, Kernel, KernelCheck,
    KernelCode, KernelResult, Operations, Quantity, Root, Symbol,
};

use crate::arena::Arena;
use crate::error::{Unsound, places};
use crate::nodes;

/// The formulas of a table, by their numbers.
#[derive(Clone, Copy)]
pub(crate) struct Formulas<'a> {
    arena: &'a Arena,
    table: &'a FormulaTable<'a>,
}

impl<'a> Formulas<'a> {
    pub(crate) fn of(arena: &'a Arena, table: &document::Table) -> Result<Self, Unsound> {
        Ok(Self { arena, table: nodes::lent(arena, table)? })
    }

    pub(crate) fn arena(self) -> &'a Arena {
        self.arena
    }

    pub(crate) fn one(self, number: Number) -> Result<Formula<'a>, Unsound> {
        self.table.get(number.get()).ok_or(Unsound::Formula(number.get()))
    }

    pub(crate) fn all(self, numbers: &[Number]) -> Result<&'a [Formula<'a>], Unsound> {
        self.arena.list(numbers, |number| self.one(*number))
    }

    pub(crate) fn equation(self, [left, right]: document::Equation) -> Result<Equation<'a>, Unsound> {
        Ok(Equation { left: self.one(left)?, right: self.one(right)? })
    }

    pub(crate) fn equations(self, all: &[document::Equation]) -> Result<&'a [Equation<'a>], Unsound> {
        self.arena.list(all, |equation| self.equation(*equation))
    }

    pub(crate) fn symbol(self, symbol: &document::Symbol) -> Result<Symbol<'a>, Unsound> {
        Ok(Symbol { name: self.arena.text(&symbol.name), formula: self.one(symbol.formula)? })
    }

    pub(crate) fn matrix(self, matrix: &document::Matrix) -> Result<FormulaMatrix<'a>, Unsound> {
        matrix.entries.iter().try_for_each(|([row, column], _)| {
            places("rows", &[*row], matrix.rows)?;
            places("columns", &[*column], matrix.columns)
        })?;
        Ok(FormulaMatrix {
            name: self.one(matrix.name)?,
            factor: matrix.factor.map(|factor| self.one(factor)).transpose()?,
            rows: matrix.rows,
            columns: matrix.columns,
            entries: self
                .arena
                .list(&matrix.entries, |&([row, column], value)| Ok(Entry { row, column, value: self.one(value)? }))?,
        })
    }

    pub(crate) fn group(self, group: &document::Group) -> Result<Group<'a>, Unsound> {
        let root = group
            .root
            .as_ref()
            .map(|root| Ok(Root { formula: self.one(root.formula)?, branches: root.choice.variants() }));
        Ok(Group {
            unknowns: self.all(&group.unknowns)?,
            equations: self.arena.copied(&group.equations),
            kind: self.arena.text(&group.kind.description()),
            form: form(&group.kind),
            position: self.equations(&group.position)?,
            root: root.transpose()?,
            method: match group.method {
                document::Method::ClosedForm => GroupMethod::ClosedForm,
                document::Method::Factorization => GroupMethod::Factorization,
            },
            determinant: group.determinant.map(|equation| self.equation(equation)).transpose()?,
            inverse: group.inverse.as_ref().map(|inverse| self.matrix(inverse)).transpose()?,
        })
    }

    pub(crate) fn quantity(self, quantity: &document::Quantity) -> Result<Quantity<'a>, Unsound> {
        Ok(Quantity {
            name: self.arena.text(&quantity.name),
            value: self.equations(&quantity.value)?,
            ratios: self.equations(&quantity.ratios)?,
            ratio_derivatives: self.equations(&quantity.ratio_derivatives)?,
            sensitivities: self.equations(&quantity.sensitivities)?,
        })
    }

    pub(crate) fn kernel(self, kernel: &document::Kernel) -> Result<Kernel<'a>, Unsound> {
        let document::Kernel { function, operations, code } = kernel;
        let program::Operations { functions, divisions, multiplications, additions } = *operations;
        Ok(Kernel {
            function: self.arena.text(function),
            operations: Operations { functions, divisions, multiplications, additions },
            code: KernelCode {
                steps: self.equations(&code.steps)?,
                checks: self.arena.list(&code.checks, |(kind, of)| self.check(*kind, of))?,
                results: self.arena.list(&code.results, |(place, value)| {
                    Ok(KernelResult { place: self.arena.text(place), value: self.one(*value)? })
                })?,
            },
        })
    }

    fn check(self, kind: CheckKind, of: &[Number]) -> Result<KernelCheck<'a>, Unsound> {
        let of = self.all(of)?;
        let check = match kind {
            CheckKind::Regular => of.try_into().map(KernelCheck::Regular).ok(),
            CheckKind::Nonzero => of.try_into().map(KernelCheck::Nonzero).ok(),
            CheckKind::Positive => of.try_into().map(KernelCheck::Positive).ok(),
            CheckKind::Apart => of.try_into().map(KernelCheck::Apart).ok(),
            CheckKind::Moderate => of.try_into().map(KernelCheck::Moderate).ok(),
            CheckKind::Open => of.try_into().map(KernelCheck::Open).ok(),
        };
        check.ok_or(Unsound::Check(kind))
    }
}

fn form(kind: &GroupKind) -> GroupForm {
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
