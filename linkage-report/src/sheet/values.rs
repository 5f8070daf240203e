//! Values of formulas at a position.

use std::collections::BTreeMap;

use linkage_runtime::Mechanism;
use linkage_runtime::analysis::AnalysisOf;
use linkage_runtime::derivation::notation::Name;
use linkage_runtime::derivation::{Derivation, Equation, Formula, FormulaList, FormulaMatrix, FormulaView, value_of};

/// Numbers for the names in the formulas of a mechanism: those of a position, with its rates and accelerations.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Values {
    /// By the order of the derivative.
    of: [BTreeMap<String, f64>; 3],
    ratios: BTreeMap<(String, String), f64>,
    /// Left sides of equations, as text.
    defined: BTreeMap<String, f64>,
}

impl Values {
    /// The numbers of a position with its [`Analysis`](linkage_runtime::analysis::Analysis).
    #[must_use]
    pub fn of<'n, M: Mechanism<Scalar = f64>>(
        derivation: &Derivation<'_>,
        parameters: impl IntoIterator<Item = (&'n str, f64)>,
        q: &M::Coordinates,
        analysis: &AnalysisOf<M>,
    ) -> Self {
        let mut values = Self::default();
        let [plain, rates, accelerations] = &mut values.of;
        plain.extend(parameters.into_iter().map(|(name, value)| (name.to_owned(), value)));
        let (unknowns, inputs) = M::parts(q);
        let names = |symbols: &[linkage_runtime::derivation::Symbol<'_>]| -> Vec<String> {
            symbols.iter().map(|symbol| symbol.name.to_owned()).collect()
        };
        let (of_unknowns, of_inputs) = (names(derivation.unknowns), names(derivation.inputs));
        let [_, second] = &analysis.accelerations;
        for (order, of_unknown, of_input) in [
            (plain, unknowns, inputs),
            (rates, analysis.unknown_rates, analysis.input_rates),
            (accelerations, *second, analysis.input_accelerations),
        ] {
            order.extend(of_unknowns.iter().cloned().zip(of_unknown));
            order.extend(of_inputs.iter().cloned().zip(of_input));
        }
        for (by, column) in of_inputs.iter().zip(analysis.ratios.columns()) {
            values.ratios.extend(of_unknowns.iter().zip(column).map(|(of, ratio)| ((of.clone(), by.clone()), *ratio)));
        }
        values
    }

    /// Sets the value of a parameter or a coordinate; `order` 1 is its rate and 2 its acceleration.
    pub fn set(&mut self, name: &str, order: usize, value: f64) -> &mut Self {
        if let Some(of) = self.of.get_mut(order) {
            of.insert(name.to_owned(), value);
        }
        self
    }

    /// Sets a velocity ratio: the derivative of an unknown by an input.
    pub fn set_ratio(&mut self, of: &str, by: &str, value: f64) -> &mut Self {
        self.ratios.insert((of.to_owned(), by.to_owned()), value);
        self
    }

    /// The value of the right side of an equation, which its left side has from now on.
    pub(crate) fn define(&mut self, equation: &Equation<'_>) -> Option<f64> {
        let value = self.of_unless_number(equation.right)?;
        self.defined.insert(equation.left.to_string(), value);
        Some(value)
    }

    /// The value of a formula; none if it contains a name without a number, a user function, or a part that is left out.
    #[must_use]
    pub fn value(&self, formula: Formula<'_>) -> Option<f64> {
        let all = |list: FormulaList<'_>| list.iter().map(|one| self.value(one)).collect::<Option<Vec<f64>>>();
        let defined = || self.defined.get(&formula.to_string()).copied();
        Some(match formula.view() {
            FormulaView::Name(name) => self.named(name).or_else(defined)?,
            FormulaView::Integer(number) => number as f64,
            FormulaView::Decimal(number) => number,
            FormulaView::Pi => std::f64::consts::PI,
            FormulaView::Sum(terms) => {
                let mut sum = 0.0;
                for (is_subtracted, term) in terms.iter() {
                    let term = self.value(term)?;
                    sum += if is_subtracted { -term } else { term };
                }
                sum
            }
            FormulaView::Product(factors) => all(factors)?.into_iter().product(),
            FormulaView::Multiple(one, other) => self.value(one)? * self.value(other)?,
            FormulaView::Quotient(above, below) => self.value(above)? / self.value(below)?,
            FormulaView::Power(base, exponent) => match self.value(base) {
                Some(base) => base.powi(i32::try_from(exponent).ok()?),
                // A square can be known without its root.
                None => defined()?,
            },
            FormulaView::Call(function, arguments) => value_of(function, &all(arguments)?)?,
            _ => return None,
        })
    }

    /// The sum of columns of two entries.
    pub(crate) fn sum(&self, columns: &[&FormulaMatrix<'_>]) -> Option<[f64; 2]> {
        let mut sum = [0.0; 2];
        for column in columns {
            for (place, sum) in sum.iter_mut().enumerate() {
                *sum += column.entry(place, 0).map_or(Some(0.0), |entry| self.value(entry))?;
            }
        }
        Some(sum)
    }

    /// The value of a formula that is not a number itself.
    pub(crate) fn of_unless_number(&self, formula: Formula<'_>) -> Option<f64> {
        match formula.view() {
            FormulaView::Integer(_) | FormulaView::Decimal(_) => None,
            _ => self.value(formula),
        }
    }

    fn named(&self, name: Name<'_>) -> Option<f64> {
        let [plain, rates, accelerations] = &self.of;
        match name {
            Name::Plain(name) => plain.get(name).copied(),
            Name::Rate(name) => rates.get(name).copied(),
            Name::Acceleration(name) => accelerations.get(name).copied(),
            Name::Ratio { of, by } => self.ratios.get(&(of.to_owned(), by.to_owned())).copied(),
            _ => None,
        }
    }
}
