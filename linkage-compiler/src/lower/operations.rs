//! Operation counts of a kernel.

use super::schedule::{Line, Schedule};
use super::value::{Leaf, Value};
use crate::graph::Function;
use crate::program::{Intrinsic, Operations};

impl Schedule {
    /// The operations of all lines, without those inside factorisations and Newton's method.
    #[must_use]
    pub fn operations(&self) -> Operations {
        let mut total = Operations::default();
        for &id in self.used() {
            match &self.values[id.index()] {
                Value::Sum(terms) => total.additions += terms.len() - 1,
                Value::Product(factors) => total.multiplications += factors.len() - 1,
                Value::Quotient(..) => total.divisions += 1,
                Value::Square(_) => total.multiplications += 1,
                Value::Call(Function::Abs | Function::IfNonzero, _) => {}
                Value::Call(..) | Value::Given(Leaf::External(..)) => total.functions += 1,
                _ => {}
            }
        }
        for line in &self.lines {
            match line {
                // Sine and cosine of an angle are one function.
                Line::SineCosine(_) => total.functions -= 1,
                Line::SinesCosines(several) => total.functions -= several.iter().filter(|one| one.is_pair()).count(),
                Line::External { values, .. } => total.functions -= values.iter().flatten().count().saturating_sub(1),
                Line::Chord { .. } => total += Intrinsic::Chord.row().cost,
                _ => {}
            }
        }
        total
    }
}
