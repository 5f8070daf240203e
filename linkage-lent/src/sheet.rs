//! The analysis by hand of a mechanism.

use linkage_compiler::document::{self, SheetDocument};
use linkage_runtime::derivation::{ChainVector, DriverChoice, FormulaMatrix, PointVectors, SheetDerivation, Turning};

use crate::arena::Arena;
use crate::error::{Unsound, places};
use crate::formulas::Formulas;

pub(crate) fn lent<'a>(arena: &'a Arena, document: &SheetDocument) -> Result<SheetDerivation<'a>, Unsound> {
    let formulas = Formulas::of(arena, &document.table)?;
    let [by_ratios, by_rates] = &document.accelerations;
    Ok(SheetDerivation {
        mechanism: arena.text(&document.mechanism),
        jacobian_rates: matrices(formulas, &document.jacobian_rates)?,
        jacobians_of_rates: matrices(formulas, &document.jacobians_of_rates)?,
        terms: matrices(formulas, &document.terms)?,
        gamma: matrices(formulas, &document.gamma)?,
        accelerations: [formulas.equations(by_ratios)?, formulas.equations(by_rates)?],
        choices: arena.list(&document.choices, |choice| {
            let determinant = choice.determinant.map(|equation| formulas.equation(equation)).transpose()?;
            Ok(DriverChoice { inputs: formulas.all(&choice.inputs)?, determinant })
        })?,
        turning: arena.list(&document.turning, |turning| {
            let [rate, acceleration] = [&turning.rate, &turning.acceleration].map(|matrix| formulas.matrix(matrix));
            Ok(Turning { with: arena.texts(&turning.with), rate: rate?, acceleration: acceleration? })
        })?,
        vectors: arena.list(&document.vectors, |vector| chained(formulas, vector))?,
        points: arena.list(&document.points, |point| {
            places("vectors", &point.vectors, document.vectors.len())?;
            let [position, velocity, acceleration] = point.sums.map(|equation| formulas.equation(equation));
            let sums = [position?, velocity?, acceleration?];
            Ok(PointVectors { name: arena.text(&point.name), vectors: arena.copied(&point.vectors), sums })
        })?,
        conditions: formulas.all(&document.conditions)?,
    })
}

fn matrices<'a, const N: usize>(
    formulas: Formulas<'a>,
    all: &[document::Matrix; N],
) -> Result<[FormulaMatrix<'a>; N], Unsound> {
    let lent = all.iter().map(|matrix| formulas.matrix(matrix)).collect::<Result<Vec<_>, _>>()?;
    // As many as there were.
    lent.try_into().map_err(|_| Unsound::Table)
}

fn chained<'a>(formulas: Formulas<'a>, vector: &document::Vector) -> Result<ChainVector<'a>, Unsound> {
    Ok(ChainVector {
        vector: formulas.matrix(&vector.vector)?,
        matrix: formulas.matrix(&vector.matrix)?,
        rates: formulas.matrix(&vector.rates)?,
        velocity: formulas.matrix(&vector.velocity)?,
        acceleration: formulas.matrix(&vector.acceleration)?,
    })
}
