//! How much work a kernel is.

use super::{Line, Schedule, Value};
use crate::graph::Function;

/// How much work a kernel is.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Operations {
    pub multiplications: usize,
    pub additions: usize,
    pub divisions: usize,
    /// Roots among them; sine and cosine of one angle count as one, and so do a function of the user's and its
    /// derivatives.
    pub functions: usize,
}

impl Operations {
    /// Both together.
    #[must_use]
    pub fn plus(self, other: Self) -> Self {
        Self {
            multiplications: self.multiplications + other.multiplications,
            additions: self.additions + other.additions,
            divisions: self.divisions + other.divisions,
            functions: self.functions + other.functions,
        }
    }

    /// Whether nothing is done more often than in `limit`.
    #[must_use]
    pub fn within(self, limit: Self) -> bool {
        self.multiplications <= limit.multiplications
            && self.additions <= limit.additions
            && self.divisions <= limit.divisions
            && self.functions <= limit.functions
    }
}

impl Schedule {
    /// The operations of all lines, but for the factorisations.
    #[must_use]
    pub fn operations(&self) -> Operations {
        let mut total = Operations::default();
        for &id in self.used() {
            match &self.values[id.0] {
                Value::Sum(terms) => total.additions += terms.len() - 1,
                Value::Product(factors) => total.multiplications += factors.len() - 1,
                Value::Quotient(..) => total.divisions += 1,
                Value::Square(_) => total.multiplications += 1,
                Value::Call(Function::Abs, _) => {}
                Value::Call(..) | Value::External(..) => total.functions += 1,
                Value::Symbol(_) | Value::Direction(..) | Value::Constant(_) => {}
            }
        }
        let chords = self.lines.iter().filter(|line| matches!(line, Line::Chord { .. })).count();
        total.functions += chords;
        total.multiplications += chords;
        for line in &self.lines {
            total.functions -= match line {
                Line::SineCosine { .. } => 1,
                Line::SinesCosines(several) => {
                    several.iter().filter(|one| one.sine.is_some() && one.cosine.is_some()).count()
                }
                Line::External { values, .. } => values.iter().flatten().count().saturating_sub(1),
                _ => 0,
            };
        }
        total
    }
}
