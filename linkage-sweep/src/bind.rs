//! A plan for one mechanism: the source of each given column.

use linkage_runtime::lanes::{Given, Lanes};
use linkage_runtime::nalgebra::ComplexField;
use linkage_runtime::{Dim, real};

use crate::column::index;
use crate::random::{Quasi, Stream};
use crate::source::{Numbers, Series, Source};
use crate::{Distribution, Factor, Place, Plan, Sequence, SweepError};

/// The sources of all given columns, the number of rows, and the product of the last factors for each number of them.
#[derive(Debug, Clone)]
pub struct Bound<T> {
    pub sources: Vec<Source<T>>,
    pub rows: u64,
    pub strides: Vec<u64>,
}

/// Checks a plan and finds the source of each given column.
pub fn bind<M: Lanes>(base: &M, plan: &Plan) -> Result<Bound<M::Scalar>, SweepError> {
    if plan.factors.is_empty() {
        return Err(SweepError::EmptyPlan);
    }
    let strides = strides(plan)?;
    let mut sources: Vec<Option<Source<M::Scalar>>> = vec![None; M::GIVEN.len()];
    let mut set = |name: &str, source: &mut dyn FnMut(usize) -> Source<M::Scalar>| {
        let column = index::<M>(name, "given", M::GIVEN)?;
        match sources.get_mut(column) {
            Some(place @ None) => *place = Some(source(column)),
            _ => return Err(SweepError::Twice { column: name.to_owned() }),
        }
        Ok(())
    };
    for (name, value) in &plan.constants {
        set(name, &mut |_| Source::Constant(real(*value)))?;
        finite::<M>(name, "constant", *value)?;
    }
    for (factor, &stride) in plan.factors.iter().zip(strides.iter().skip(1).rev().skip(1).chain([&1])) {
        let count = factor.count();
        let numbers = |series| Source::Factor(Numbers { series, count, stride });
        match factor {
            Factor::Grid { column, from, to, .. } => {
                set(column, &mut |_| numbers(Series::Grid { from: *from, to: *to }))?;
                range::<M>(column, *from, *to)?;
            }
            Factor::Turn { column, .. } => set(column, &mut |_| numbers(Series::Turn))?,
            Factor::Sample { columns, sequence, .. } => {
                for (dimension, (name, distribution)) in columns.iter().enumerate() {
                    let distribution = *distribution;
                    set(name, &mut |column| {
                        numbers(match sequence {
                            Sequence::Random => Series::Random(distribution, Stream::random(plan.seed, column)),
                            Sequence::QuasiRandom => {
                                let quasi = Quasi::new(plan.seed, column, dimension, columns.len());
                                Series::Quasi(distribution, quasi)
                            }
                        })
                    })?;
                    distribution.check::<M>(name)?;
                }
            }
        }
    }
    let mut parameters: Given<M, M::Scalar> = M::Given::default().array(|_| real(0.0));
    base.write_parameters(&mut parameters);
    let sources = sources.into_iter().zip(parameters).enumerate().map(|(column, (source, parameter))| match source {
        Some(source) => Ok(source),
        None if column < M::PARAMETERS => Ok(Source::Constant(parameter)),
        None if is_rate::<M>(column) => Ok(Source::Constant(real(0.0))),
        None => Err(SweepError::MissingInput { mechanism: M::NAME, input: Place::Given(column).name::<M>() }),
    });
    let sources = sources.collect::<Result<_, _>>()?;
    Ok(Bound { sources, rows: strides.last().copied().unwrap_or(1), strides })
}

/// The product of the last n factors at index n.
fn strides(plan: &Plan) -> Result<Vec<u64>, SweepError> {
    let mut strides = vec![1_u64];
    let mut rows = 1_u64;
    for factor in plan.factors.iter().rev() {
        if factor.columns().next().is_none() {
            return Err(SweepError::EmptySample);
        }
        if factor.count() == 0 {
            let column = factor.columns().next().map(str::to_owned);
            return Err(SweepError::Zero { quantity: "rows", column });
        }
        rows = rows.checked_mul(factor.count()).ok_or(SweepError::TooManyRows)?;
        strides.push(rows);
    }
    Ok(strides)
}

/// True if a given column is a rate or an acceleration of an input.
fn is_rate<M: Lanes>(column: usize) -> bool {
    column >= M::PARAMETERS + M::START
}

/// An error if a number is not finite as a scalar of the mechanism.
pub fn finite<M: Lanes>(column: &str, quantity: &'static str, value: f64) -> Result<(), SweepError> {
    if value.is_finite() && real::<M::Scalar>(value).is_finite() {
        Ok(())
    } else {
        Err(SweepError::NotFinite { column: column.to_owned(), quantity, value })
    }
}

/// An error if a number between two ends may not be finite.
pub fn range<M: Lanes>(column: &str, from: f64, to: f64) -> Result<(), SweepError> {
    finite::<M>(column, "first end", from)?;
    finite::<M>(column, "second end", to)?;
    finite::<M>(column, "range", to - from)
}

impl Distribution {
    /// An error if a number may not be finite.
    fn check<M: Lanes>(self, column: &str) -> Result<(), SweepError> {
        match self {
            Self::Uniform { from, to } => range::<M>(column, from, to),
            Self::Normal { mean, deviation } => {
                finite::<M>(column, "mean", mean)?;
                finite::<M>(column, "standard deviation", deviation)?;
                if deviation < 0.0 {
                    return Err(SweepError::NegativeDeviation { column: column.to_owned(), value: deviation });
                }
                // No number is farther than ten deviations from the mean.
                finite::<M>(column, "largest number", mean + 10.0 * deviation)?;
                finite::<M>(column, "smallest number", mean - 10.0 * deviation)
            }
        }
    }
}
