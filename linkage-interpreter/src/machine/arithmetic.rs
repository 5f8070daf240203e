//! Numbers, in the order of emitted code.

use linkage_ir::code::{Code, Signed, Value as Operation};
use linkage_ir::{Intrinsic, ValueId};

use super::Machine;
use super::defect::Defect;
use super::evaluate::operation;
use super::failure::Evaluated;
use super::scalar::Scalar;

impl<'c> Machine<'c> {
    /// The number that an operation computes, in the order of emitted code.
    #[inline]
    pub(super) fn number<S: Scalar>(&mut self, code: &'c Code, id: ValueId) -> Evaluated<S> {
        // Most operands of an operation.
        if let Some(Operation::Given(slot)) = code.values.get(id.index())
            && let Some(number) = self.slots.get(self.base + slot.index()).and_then(S::of)
        {
            return Ok(number);
        }
        self.computed(code, id)
    }

    pub(super) fn computed<S: Scalar>(&mut self, code: &'c Code, id: ValueId) -> Evaluated<S> {
        Ok(match operation(code, id)? {
            Operation::Given(slot) => {
                let value = self.slot(*slot)?;
                S::of(value).ok_or_else(|| value.expected("a number"))?
            }
            Operation::Constant(number) => S::constant(*number),
            Operation::Turn(_, count, parts) => S::turn(*count, *parts),
            Operation::Sum(terms) => {
                let mut terms = terms.iter();
                let first = terms.next().ok_or_else(|| Defect::new("an operation on nothing"))?;
                let mut sum = self.signed::<S>(code, *first)?;
                for term in terms {
                    let number = self.number::<S>(code, term.value)?;
                    sum = if term.negative { sum.minus(&number) } else { sum.plus(&number) };
                }
                sum
            }
            Operation::Product(factors) => {
                let (first, others) = first(factors)?;
                let product = self.number::<S>(code, first)?;
                self.product(code, product, others)?
            }
            Operation::Quotient(above, below) => {
                let above = self.number::<S>(code, *above)?;
                above.over(&self.number::<S>(code, *below)?)
            }
            Operation::Square(base) => {
                let base = self.number::<S>(code, *base)?;
                base.clone().times(&base)
            }
            Operation::Intrinsic(Intrinsic::Square, _, arguments) => {
                let base = self.number::<S>(code, first(arguments)?.0)?;
                base.clone().times(&base)
            }
            Operation::Negative(inside) => self.negative::<S>(code, *inside)?,
            Operation::Call(function, arguments) => match arguments.as_slice() {
                [only] => S::call(*function, &[self.signed(code, *only)?])?,
                [one, other] => S::call(*function, &[self.signed(code, *one)?, self.signed(code, *other)?])?,
                several => {
                    let several: Vec<S> =
                        several.iter().map(|argument| self.signed(code, *argument)).collect::<Evaluated<_>>()?;
                    S::call(*function, &several)?
                }
            },
            _ => {
                let value = self.value(code, id)?;
                S::of(&value).ok_or_else(|| value.expected("a number"))?
            }
        })
    }

    fn product<S: Scalar>(&mut self, code: &'c Code, first: S, others: &'c [ValueId]) -> Evaluated<S> {
        others.iter().try_fold(first, |product, factor| Ok(product.times(&self.number::<S>(code, *factor)?)))
    }

    #[inline(always)]
    fn signed<S: Scalar>(&mut self, code: &'c Code, signed: Signed) -> Evaluated<S> {
        if signed.negative { self.negative(code, signed.value) } else { self.number(code, signed.value) }
    }

    /// The negative of a number as emitted code computes it: `-a * b` is (-a)*b. In twice the precision a product that is zero
    /// can have another sign than -(a*b).
    fn negative<S: Scalar>(&mut self, code: &'c Code, id: ValueId) -> Evaluated<S> {
        Ok(match operation(code, id)? {
            Operation::Product(factors) => {
                let (first, others) = first(factors)?;
                let product = self.negative::<S>(code, first)?;
                self.product(code, product, others)?
            }
            Operation::Square(base) => {
                let first = self.negative::<S>(code, *base)?;
                first.times(&self.number::<S>(code, *base)?)
            }
            Operation::Quotient(above, below) => {
                let above = self.negative::<S>(code, *above)?;
                above.over(&self.number::<S>(code, *below)?)
            }
            // Two signs are none.
            Operation::Negative(inside) => self.number(code, *inside)?,
            _ => self.number::<S>(code, id)?.negative(),
        })
    }
}

/// The first operand, and the others.
#[inline]
fn first(all: &[ValueId]) -> Result<(ValueId, &[ValueId]), Defect> {
    let (first, others) = all.split_first().ok_or_else(|| Defect::new("an operation on nothing"))?;
    Ok((*first, others))
}
