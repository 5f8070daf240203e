//! Signs: translation moves them out of values, to the sums and results that use these. Here they return to the place
//! where they are written: a - b instead of -(b - a).

use linkage_ir::ValueId;

use super::terms;
use super::value::{Signed, Value};
use super::values::{Numbers, Values};
use crate::program::Intrinsic;

impl Values {
    /// A value as it is written: bound, or computed where it is used. A negative difference, or a negative product with
    /// one, is written with the difference reversed. The sign of a sum that waits for its last term is written where it is
    /// known earlier.
    pub(super) fn signed(&mut self, signed: Signed) -> Signed {
        if !self.is_bound[signed.value.index()] && !self.is_settled[signed.value.index()] {
            self.turn(signed);
            self.settle(signed.value);
        }
        self.at_hand(signed)
    }

    /// The value, or its negative, as an operand of another value than a sum.
    pub(super) fn signed_value(&mut self, signed: Signed) -> ValueId {
        let signed = self.signed(signed);
        self.written(signed)
    }

    /// Computes a value, or its negative, where a statement binds it.
    pub(super) fn define(&mut self, signed: Signed) {
        let id = signed.value;
        let written = self.signed(signed);
        if written.negative {
            let inside = self.all[id.index()].clone();
            let inside = self.add(inside);
            self.all[id.index()] = Value::Negative(inside);
        }
        self.bind(id, signed.negative);
    }

    /// Marks a value that a statement binds, with true if its name stands for the negative.
    pub(super) fn bind(&mut self, id: ValueId, is_negative: bool) {
        self.is_bound[id.index()] = true;
        self.is_settled[id.index()] = true;
        self.is_negative[id.index()] = is_negative;
    }

    /// A value that is bound or settled, with the sign that it has there.
    fn at_hand(&self, Signed { negative, value }: Signed) -> Signed {
        let is_zero = matches!(self.get(value), Value::Constant(number) if number.is_zero());
        Signed { negative: negative != self.is_negative[value.index()] && !is_zero, value: self.itself(value) }
    }

    /// True if a value is written as its negative, with the signs of its factors.
    fn is_written_negative(&self, id: ValueId) -> bool {
        if self.is_bound[id.index()] || self.is_settled[id.index()] {
            return self.is_negative[id.index()];
        }
        let own = self.is_negative[id.index()];
        match self.get(id) {
            Value::Product(factors) => {
                factors.iter().fold(own, |sign, factor| sign != self.is_written_negative(*factor))
            }
            Value::Quotient(above, below) => {
                own != (self.is_written_negative(*above) != self.is_written_negative(*below))
            }
            _ => own,
        }
    }

    /// Reverses a difference in a value that would be written with a minus.
    fn turn(&mut self, Signed { negative, value }: Signed) {
        if negative == self.is_written_negative(value) {
            return;
        }
        match self.get(value) {
            Value::Sum(terms) => {
                let waits = |term: &Signed| self.is_earlier(term.value, value);
                if self.is_difference(terms) || terms.iter().any(waits) {
                    self.reverse(value);
                }
            }
            Value::Product(factors) => self.turn_product(&factors.clone(), value),
            _ => {}
        }
    }

    /// The negative of a product with a difference, or of one that begins with a sum, whose last bound factor takes the sign
    /// if it is known earlier.
    fn turn_product(&mut self, factors: &[ValueId], product: ValueId) {
        let difference = |&&factor: &&ValueId| match self.get(factor) {
            Value::Sum(terms) => self.is_open(factor) && self.is_difference(terms),
            _ => false,
        };
        if let Some(&factor) = factors.iter().find(difference) {
            self.reverse(factor);
            return;
        }
        let Some(&first) = factors.first() else { return };
        let Some(index) = factors.iter().rposition(|factor| self.is_bound[factor.index()]) else { return };
        let is_sum = matches!(self.get(first), Value::Sum(_)) && !self.is_bound[first.index()];
        if !is_sum || !self.is_earlier(factors[index], first) {
            return;
        }
        let is_negative = self.is_negative[factors[index].index()];
        let negative = self.add(Value::Negative(self.itself(factors[index])));
        self.is_negative[negative.index()] = !is_negative;
        if let Value::Product(factors) = &mut self.all[product.index()] {
            factors[index] = negative;
        }
    }

    fn is_open(&self, id: ValueId) -> bool {
        !self.is_bound[id.index()] && !self.is_settled[id.index()]
    }

    /// Replaces a sum by its negative.
    fn reverse(&mut self, sum: ValueId) {
        if let Value::Sum(terms) = &mut self.all[sum.index()] {
            terms.iter_mut().for_each(|term| term.negative = !term.negative);
            self.is_negative[sum.index()] = !self.is_negative[sum.index()];
        }
    }

    fn is_difference(&self, terms: &[Signed]) -> bool {
        terms.iter().any(|term| self.is_taken_away(*term))
    }

    /// True if the term is written with a minus, as far as names tell.
    fn is_taken_away(&self, term: Signed) -> bool {
        term.negative != (self.is_bound[term.value.index()] && self.is_negative[term.value.index()])
    }

    /// Settles the signs in a value that is written where it is used.
    fn settle(&mut self, id: ValueId) {
        if self.is_bound[id.index()] || std::mem::replace(&mut self.is_settled[id.index()], true) {
            return;
        }
        let settled = match self.all[id.index()].clone() {
            Value::Product(factors) => {
                for factor in &factors {
                    self.settle(*factor);
                    self.is_negative[id.index()] ^= self.is_negative[factor.index()];
                }
                Value::Product(factors.into_iter().map(|factor| self.itself(factor)).collect())
            }
            Value::Quotient(above, below) => {
                for part in [above, below] {
                    self.settle(part);
                    self.is_negative[id.index()] ^= self.is_negative[part.index()];
                }
                Value::Quotient(self.itself(above), self.itself(below))
            }
            // (-x)^2 = x^2
            Value::Square(base) => {
                self.settle(base);
                let base = self.itself(base);
                match self.numbers {
                    Numbers::Exact => Value::Intrinsic(Intrinsic::Square, None, vec![base]),
                    _ => Value::Square(base),
                }
            }
            Value::Sum(terms) => Value::Sum(self.settled_terms(terms)),
            Value::Call(function, arguments) => {
                let arguments: Vec<Signed> = arguments.into_iter().map(|argument| self.signed(argument)).collect();
                let in_lane = Intrinsic::in_lane_of(function).filter(|_| self.numbers == Numbers::InLanes);
                match in_lane {
                    Some([form, _]) => {
                        let arguments = arguments.into_iter().map(|argument| self.written(argument)).collect();
                        Value::Intrinsic(form, None, arguments)
                    }
                    None => Value::Call(function, arguments),
                }
            }
            Value::Constant(number) if self.numbers == Numbers::Exact && !number.is_zero() && !number.is_one() => {
                Value::Exact(number)
            }
            other => other,
        };
        self.all[id.index()] = settled;
    }

    /// The terms of a sum, with a positive one first if it has one.
    fn settled_terms(&mut self, mut terms: Vec<Signed>) -> Vec<Signed> {
        terms::sort(&mut terms, |id| self.last_step(id), |term| self.is_taken_away(*term));
        let settled = terms.into_iter().enumerate().map(|(index, term)| match index {
            // The first term may absorb its sign.
            0 => self.signed(term),
            _ => {
                self.settle(term.value);
                self.at_hand(term)
            }
        });
        settled.collect()
    }
}
