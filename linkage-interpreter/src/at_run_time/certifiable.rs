//! Formulas over numbers of any kind, and mechanisms whose motions can be certified.

use linkage_runtime::{Build as _, Certifiable, Column, Dim, Formulas as Trait, Number, Ranged, UpTo};

use super::parameters::Parameters;
use super::read::{field, number};
use super::{AtRunTime, Count, MOST, NotPrepared, OfDesign, Prepared};
use crate::formulas::{Formula, Formulas, Given, Register, Registers};

/// The most parameters of a mechanism with certificates.
const MOST_PARAMETERS: usize = 64;

/// The number of parameters.
pub type ParameterCount = UpTo<MOST_PARAMETERS>;

/// The number of quantities: two components of each point, then the outputs.
pub type QuantityCount = UpTo<{ 3 * MOST }>;

/// A mechanism at run time that has formulas over intervals, so that its motions can be certified:
/// [`Prepared::certifiable`] makes it.
pub type CertifiableAtRunTime<'p, V> = AtRunTime<'p, V, WithFormulas<'p>>;

/// Formulas over numbers of any kind, and values of the parameters.
#[derive(Debug, Clone, Copy)]
pub struct WithFormulas<'p> {
    formulas: &'p Formulas,
    values: Column<f64, ParameterCount>,
    /// True if they are those of the design.
    are_of_design: bool,
}

impl Parameters for WithFormulas<'_> {
    fn instead(&self) -> Option<&[f64]> {
        (!self.are_of_design).then_some(self.values.as_slice())
    }
}

impl Prepared<'_> {
    /// The mechanism for certificates, with the number of its inputs as a type. Certificates take one with several inputs, of
    /// which one moves.
    ///
    /// # Errors
    /// [`NotPrepared::NoFormulas`] if the text of the mechanism has no `derive intervals;`, [`NotPrepared::TooLarge`] if it has
    /// more than 64 parameters, [`NotPrepared::Inputs`] if it has another number of inputs.
    pub fn certifiable<V: Dim>(&self) -> Result<CertifiableAtRunTime<'_, V>, NotPrepared> {
        let AtRunTime { prepared, inputs, parameters: OfDesign } = self.with_inputs::<V>()?;
        let name = || NotPrepared::NoFormulas { mechanism: self.driver.name.to_string() };
        let formulas = self.driver.formulas.as_ref().ok_or_else(name)?;
        let values: Vec<f64> = self.driver.parameters.iter().map(|name| number(field(&self.own, *name))).collect();
        let too_large =
            || NotPrepared::TooLarge { of: "parameters", count: values.len(), most: ParameterCount::CAPACITY };
        let values = Column::from_slice(&values).ok_or_else(too_large)?;
        Ok(AtRunTime { prepared, inputs, parameters: WithFormulas { formulas, values, are_of_design: true } })
    }
}

impl<'p, V: Dim> Certifiable for CertifiableAtRunTime<'p, V> {
    type P = ParameterCount;
    type Q = QuantityCount;
    type Over<N: Number> = FormulasAtRunTime<'p, N, V>;

    const PARAMETERS: &'static [&'static str] = panic!("the names are those of the value");
    const QUANTITIES: &'static [&'static str] = panic!("the names are those of the value");
    const USER_FUNCTIONS: &'static [Option<&'static str>] = panic!("the functions are those of the value");

    fn parameter_name(&self, place: usize) -> &'p str {
        self.prepared.driver.about_parameters.get(place).map_or("", |parameter| parameter.text.as_str())
    }
    fn quantity_name(&self, place: usize) -> &'p str {
        self.parameters.formulas.names.get(place).map_or("", String::as_str)
    }
    fn user_function(&self, group: usize) -> Option<&'p str> {
        self.parameters.formulas.user_functions.get(group).and_then(Option::as_deref)
    }
    fn quantity_count(&self) -> QuantityCount {
        let count = self.parameters.formulas.names.len();
        // Of as many points and outputs as a mechanism at run time has at most.
        QuantityCount::new(count).unwrap_or_else(Dim::least)
    }

    fn parameters(&self) -> Column<f64, ParameterCount> {
        self.parameters.values
    }
    fn with(&self, parameters: Column<f64, ParameterCount>) -> Self {
        let given = parameters.as_slice();
        let values = self.parameters.values.dim().column(|place| given.get(place).copied().unwrap_or(f64::NAN));
        Self { parameters: WithFormulas { values, are_of_design: false, ..self.parameters }, ..*self }
    }
    fn over<N: Number>(&self, parameters: Column<N, ParameterCount>) -> FormulasAtRunTime<'p, N, V> {
        FormulasAtRunTime {
            of: self.parameters.formulas,
            parameters: parameters.as_slice().to_vec(),
            parameter_count: self.parameters.values.dim().count(),
            unknowns: self.prepared.counts().0,
            inputs: self.inputs,
            quantities: self.quantity_count(),
        }
    }
}

/// The formulas of a mechanism at run time over one kind of number, with values of its parameters.
#[derive(Debug, Clone)]
pub struct FormulasAtRunTime<'p, N, V> {
    of: &'p Formulas,
    parameters: Vec<N>,
    parameter_count: usize,
    unknowns: Count,
    inputs: V,
    quantities: QuantityCount,
}

/// A column of these results, from a place on.
fn column<N: Number, R: Dim>(found: &Registers<N>, results: &[Register], from: usize, rows: R) -> Column<N, R> {
    rows.column(|row| results.get(from + row).map_or_else(N::unknown, |register| found.at(*register)))
}

impl<N: Number, V: Dim> FormulasAtRunTime<'_, N, V> {
    fn given<'g>(&'g self, unknowns: &'g Column<N, Count>, inputs: &'g Column<N, V>) -> [Given<'g, N>; 3] {
        let [u, v] = [self.unknowns.count(), self.inputs.count()];
        [(&self.parameters, self.parameter_count), (unknowns.as_slice(), u), (inputs.as_slice(), v)]
    }

    /// The results of a formula as columns with a row for each unknown.
    fn columns<C: Dim>(
        &self,
        formula: &Formula<Vec<Register>>,
        given: &[Given<'_, N>],
        columns: C,
    ) -> Column<Column<N, Count>, C> {
        let found = formula.run(given);
        columns.column(|place| column(&found, &formula.results, place * self.unknowns.count(), self.unknowns))
    }
}

impl<N: Number, V: Dim> Trait for FormulasAtRunTime<'_, N, V> {
    type Number = N;
    type U = Count;
    type V = V;
    type Q = QuantityCount;

    fn residual(&self, unknowns: &Column<N, Count>, inputs: &Column<N, V>) -> Column<N, Count> {
        let formula = &self.of.residual;
        column(&formula.run(&self.given(unknowns, inputs)), &formula.results, 0, self.unknowns)
    }
    fn jacobian_unknowns(&self, unknowns: &Column<N, Count>, inputs: &Column<N, V>) -> Column<Column<N, Count>, Count> {
        self.columns(&self.of.jacobian_unknowns, &self.given(unknowns, inputs), self.unknowns)
    }
    fn jacobian_inputs(&self, unknowns: &Column<N, Count>, inputs: &Column<N, V>) -> Column<Column<N, Count>, V> {
        self.columns(&self.of.jacobian_inputs, &self.given(unknowns, inputs), self.inputs)
    }
    fn gamma(
        &self,
        unknowns: &Column<N, Count>,
        inputs: &Column<N, V>,
        unknown_rates: &Column<N, Count>,
        input_rates: &Column<N, V>,
    ) -> Column<N, Count> {
        let [parameters, values @ ..] = self.given(unknowns, inputs);
        let [_, rates @ ..] = self.given(unknown_rates, input_rates);
        let given: Vec<Given<'_, N>> = [parameters].into_iter().chain(values).chain(rates).collect();
        let formula = &self.of.gamma;
        column(&formula.run(&given), &formula.results, 0, self.unknowns)
    }
    fn quantities(&self, unknowns: &Column<N, Count>, inputs: &Column<N, V>) -> Column<N, QuantityCount> {
        let formula = &self.of.quantities;
        column(&formula.run(&self.given(unknowns, inputs)), &formula.results, 0, self.quantities)
    }
    fn ranged(&self, place: usize, unknowns: &Column<N, Count>, inputs: &Column<N, V>) -> Option<Ranged<N>> {
        let formula = &self.of.ranges;
        let range = formula.results.get(place)?;
        let found = formula.run(&self.given(unknowns, inputs));
        let [least, most] = [range.least, range.most].map(|end| end.map(|register| found.at(register)));
        Some(Ranged { value: found.at(range.value), least, most, is_direction: range.is_direction })
    }
}
