//! Groups that are solved by factorisation, by Newton's method, or by a list of their positions. The functions of the
//! runtime have the number of unknowns in their types: here it is a number within a capacity.

use std::cell::RefCell;
use std::rc::Rc;
use std::sync::Arc;

use linkage_ir::Name;
use linkage_ir::code::Code;
use linkage_runtime::__rt::{Factorization, Loops, Memory, Unknown, newton_group, product_of_pivots};
use linkage_runtime::AssemblyMode;

use super::Machine;
use super::defect::Defect;
use super::failure::{Evaluated, Failure};
use super::scalar::Single;
use super::value::{Factors, Found, Kept, Value};
use crate::error::Error;

/// The most unknowns of a group that is factorised.
pub(crate) const MOST_UNKNOWNS: usize = 16;

/// Runs an expression with a count as a constant.
macro_rules! sized {
    ($count:expr, $N:ident => $body:expr) => {
        sized!(@ $count, $N => $body, 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16)
    };
    (@ $count:expr, $N:ident => $body:expr, $($size:literal)*) => {
        match $count {
            $($size => { const $N: usize = $size; $body })*
            count => Err($crate::machine::groups::too_many(count)),
        }
    };
}
pub(crate) use sized;

#[cold]
pub(crate) fn too_many(count: usize) -> Box<Failure> {
    Error::TooLarge { of: "unknowns in a group", count, most: MOST_UNKNOWNS }.into()
}

/// The numbers of a list.
pub(crate) fn numbers<S: Single, const N: usize>(value: &Value) -> Result<[S; N], Defect> {
    let all = value.as_list()?;
    if all.len() != N {
        return Err(value.expected("a list of another length"));
    }
    each(all)
}

/// The numbers of values, as many as there are.
pub(crate) fn each<S: Single, const N: usize>(values: &[Value]) -> Result<[S; N], Defect> {
    let mut numbers = [S::zero(); N];
    for (number, value) in numbers.iter_mut().zip(values) {
        *number = S::of(value).ok_or_else(|| value.expected("a number"))?;
    }
    Ok(numbers)
}

/// The columns of a matrix.
pub(crate) fn columns<S: Single, const R: usize, const C: usize>(value: &Value) -> Result<[[S; R]; C], Defect> {
    let all = value.as_list()?;
    if all.len() != C {
        return Err(value.expected("a list of another length"));
    }
    let mut columns = [[S::zero(); R]; C];
    for (column, value) in columns.iter_mut().zip(all) {
        *column = numbers(value)?;
    }
    Ok(columns)
}

pub(crate) fn list<S: Single, const N: usize>(numbers: [S; N]) -> Value {
    Value::list(numbers.map(S::into_value))
}

impl<S: Single, const N: usize> Factors for Factorization<S, N> {
    fn solve(&self, right: &Value) -> Result<Value, Defect> {
        Ok(list(Self::solve(self, numbers(right)?)))
    }

    fn loses_digits(&self) -> bool {
        let mut asks = false;
        self.refined((), |()| {
            asks = true;
            None
        });
        asks
    }
}

/// Factorises a matrix.
pub(crate) fn factorised<S: Single + 'static>(
    [mechanism, group]: [&Arc<str>; 2],
    matrix: &Value,
    scales: &Value,
) -> Evaluated<Value> {
    sized!(matrix.as_list()?.len(), N => {
        let (matrix, scales) = (columns::<S, N, N>(matrix)?, numbers(scales)?);
        let factors = Factorization::<S, N>::new(&**mechanism, &**group, matrix, scales);
        Ok(Value::Factors(Rc::new(factors.map_err(Error::from)?)))
    })
}

/// The product of the pivots of a matrix.
pub(crate) fn pivots<S: Single>(matrix: &Value) -> Evaluated<Value> {
    sized!(matrix.as_list()?.len(), N => Ok(product_of_pivots(columns::<S, N, N>(matrix)?).into_value()))
}

impl<const N: usize> Found for linkage_runtime::modes::Modes<f64, N> {
    fn take(&self, [mechanism, group]: [&Arc<str>; 2], mode: AssemblyMode) -> Result<Value, Error> {
        Ok(list(Self::take(self, &**mechanism, &**group, mode)?))
    }
}

impl<'c> Machine<'c> {
    /// The evaluation of a group at values of its unknowns: residuals, scales, and the columns of J. What fails in it is
    /// kept, and the numbers are none.
    fn evaluated<const N: usize>(
        &mut self,
        code: &'c Code,
        evaluation: &Value,
        at: [f64; N],
        failed: &mut Option<Box<Failure>>,
    ) -> ([f64; N], [f64; N], [[f64; N]; N]) {
        let mut evaluate = || {
            let value = self.closure(code, evaluation, [list(at)], false)?;
            match value.as_list()? {
                [residual, scales, matrix] => Ok((numbers(residual)?, numbers(scales)?, columns(matrix)?)),
                _ => Err(value.expected("three lists").into()),
            }
        };
        evaluate().unwrap_or_else(|failure| {
            *failed = Some(failure);
            ([f64::NAN; N], [f64::NAN; N], [[f64::NAN; N]; N])
        })
    }

    /// The unknowns of a group near a start, by Newton's method.
    pub(super) fn newton_group(
        &mut self,
        code: &'c Code,
        [mechanism, group]: [&Arc<str>; 2],
        start: &Value,
        evaluation: &Value,
    ) -> Evaluated<Value> {
        sized!(start.as_list()?.len(), N => {
            let start = numbers::<f64, N>(start)?;
            let (machine, failed) = (RefCell::new(self), RefCell::new(None));
            let evaluate = |at| machine.borrow_mut().evaluated(code, evaluation, at, &mut failed.borrow_mut());
            let found = newton_group(&**mechanism, &**group, start, evaluate);
            match failed.into_inner() {
                Some(failure) => Err(failure),
                None => Ok(list(found.map_err(Error::from)?)),
            }
        })
    }

    /// All positions of a group, those found last if it is the same group.
    pub(super) fn modes(
        &mut self,
        code: &'c Code,
        memory: &Value,
        names: [&Arc<str>; 2],
        loops: &Value,
        unknowns_are: Option<&Value>,
        functions: [&Value; 2],
    ) -> Evaluated<Value> {
        let Value::Memory(memory) = memory else { return Err(memory.expected("a memory").into()) };
        let mut kept = memory.borrow_mut();
        let count = loops.field(Name::CONSTANTS)?.as_list()?.len();
        match (count, &*kept) {
            (2, None | Some(Kept::Three(_))) => *kept = Some(Kept::Two(Box::default())),
            (3, None | Some(Kept::Two(_))) => *kept = Some(Kept::Three(Box::default())),
            (2 | 3, _) => {}
            _ => return Err(loops.expected("two or three loops").into()),
        }
        match &mut *kept {
            Some(Kept::Two(memory)) => self.modes_of(code, memory, names, loops, unknowns_are, functions),
            Some(Kept::Three(memory)) => self.modes_of(code, memory, names, loops, unknowns_are, functions),
            None => Err(Defect::new("a memory that is empty").into()),
        }
    }

    fn modes_of<const L: usize, const N: usize>(
        &mut self,
        code: &'c Code,
        memory: &mut Memory<f64, L, N>,
        [mechanism, group]: [&Arc<str>; 2],
        loops: &Value,
        unknowns_are: Option<&Value>,
        [unknowns, evaluation]: [&Value; 2],
    ) -> Evaluated<Value> {
        let mut factors = [[[0.0; 2]; N]; L];
        for (factors, value) in factors.iter_mut().zip(loops.field(Name::FACTORS)?.as_list()?) {
            *factors = columns(value)?;
        }
        let loops = Loops { constants: columns(loops.field(Name::CONSTANTS)?)?, factors };
        let mut are = [Unknown::Angle; N];
        if let Some(values) = unknowns_are {
            for (is, value) in are.iter_mut().zip(values.as_list()?) {
                *is = unknown(value)?;
            }
        }
        let (machine, failed) = (RefCell::new(self), RefCell::new(None));
        let evaluate = |at| machine.borrow_mut().evaluated(code, evaluation, at, &mut failed.borrow_mut());
        let of_directions = |directions| {
            let value = machine.borrow_mut().closure(code, unknowns, [list::<f64, N>(directions)], false);
            value.and_then(|value| Ok(numbers(&value)?)).unwrap_or_else(|failure| {
                *failed.borrow_mut() = Some(failure);
                [f64::NAN; N]
            })
        };
        let found = memory.modes_with_lengths(&**mechanism, &**group, loops, are, of_directions, evaluate);
        match failed.into_inner() {
            Some(failure) => Err(failure),
            None => Ok(Value::Modes(Rc::new(found.map_err(Error::from)?))),
        }
    }
}

/// An unknown of a group with lengths; an angle is no record.
fn unknown(value: &Value) -> Result<Unknown<f64>, Defect> {
    let Value::Record(length) = value else { return Ok(Unknown::Angle) };
    let field = |name| length.get(name).ok_or_else(|| value.expected("a field"));
    let with = match field(Name::WITH)? {
        Value::Absent => None,
        index => Some(index.as_count()?),
    };
    Ok(Unknown::Length { in_loop: field(Name::IN_LOOP)?.as_count()?, along: numbers(field(Name::ALONG)?)?, with })
}
