//! The nodes of formulas.

#[cfg(feature = "code")]
use alloc::string::String;
#[cfg(all(feature = "code", feature = "serde"))]
use alloc::vec;
#[cfg(feature = "code")]
use alloc::vec::Vec;

use crate::ElementaryFunction;

/// A node of a formula. It refers to nodes before it by their numbers, which count from 1, and to several by a
/// place in the list of parts and a count.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum FormulaNode {
    /// A quantity by the place of its name in the `linkage!` language: `theta3`.
    Name(u32),
    /// The first derivative of a name with respect to time.
    Rate(u32),
    /// The second derivative of a name with respect to time.
    Acceleration(u32),
    /// The derivative of the first name with respect to the second.
    Ratio(u32, u32),
    /// The second derivative of the first name with respect to the others.
    RatioDerivative(u32, u32, u32),
    /// The determinant of a matrix by its name.
    Determinant(u32),
    /// The inverse of a matrix by its name.
    Inverse(u32),
    /// A whole number.
    Integer(u64),
    /// A number.
    Decimal(#[cfg_attr(feature = "serde", serde(with = "bits"))] f64),
    /// π.
    Pi,
    /// The place of a part that is too long to be printed.
    Ellipsis,
    /// Terms from left to right; the number of a term that is subtracted has a minus sign.
    Sum(u32, u32),
    /// Factors from left to right.
    Product(u32, u32),
    /// A numerator and a denominator.
    Quotient(u32, u32),
    /// A power of the first with the second, a number by itself, as the exponent.
    Power(u32, u32),
    /// An elementary function and its arguments.
    Call(ElementaryFunction, u32, u32),
    /// A user function by the place of its name, the order of its derivative, and its arguments.
    External(u32, u32, u32, u32),
    /// A product of two with a sign between them in every notation.
    Multiple(u32, u32),
    /// a ≤ b ≤ ….
    AtMost(u32, u32),
    /// a ≠ 0.
    NonZero(u32),
    /// The statement that a formula has a value.
    Exists(u32),
}

/// The number of a node in its table, from 1.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct FormulaId(u32);

impl FormulaId {
    /// The node at an index, which counts from 0.
    #[must_use]
    pub const fn new(index: usize) -> Self {
        // A longer table is an error where it is checked.
        Self(if index < u32::MAX as usize { index as u32 + 1 } else { u32::MAX })
    }

    /// The number.
    #[must_use]
    pub const fn get(self) -> u32 {
        self.0
    }

    /// The index of the node, from 0; none for the number 0, which a damaged file can have.
    #[must_use]
    pub const fn index(self) -> Option<usize> {
        (self.0 as usize).checked_sub(1)
    }
}

/// The nodes of the formulas of one document, and what they refer to by place.
#[cfg(feature = "code")]
#[derive(Debug, Clone, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct FormulaNodes {
    /// The nodes.
    pub nodes: Vec<FormulaNode>,
    /// The names of quantities and of user functions.
    pub names: Vec<String>,
    /// The numbers of terms, factors and arguments, negative for a term that is subtracted.
    pub parts: Vec<i32>,
}

#[cfg(feature = "code")]
impl FormulaNodes {
    /// The name that a formula is; none if it is another formula.
    #[must_use]
    pub fn name(&self, id: FormulaId) -> Option<&String> {
        match self.nodes.get(id.index()?)? {
            FormulaNode::Name(place) => self.names.get(*place as usize),
            _ => None,
        }
    }
}

/// The largest length of a formula that is read, in nodes and in bytes of its names; the longest of the gallery has 2359 bytes.
#[cfg(all(feature = "code", feature = "serde"))]
const LONGEST: usize = 1 << 14;

/// The largest number of nodes within nodes of a formula that is read; the deepest of the gallery has 13.
#[cfg(all(feature = "code", feature = "serde"))]
const DEEPEST: usize = 256;

#[cfg(all(feature = "code", feature = "serde"))]
impl FormulaNodes {
    /// True if each node refers to nodes before it, and is not too large to be written: a short file can have a formula without
    /// end.
    fn can_be_written(&self) -> bool {
        // Of each node how deep it is, and how long, with a power as that many factors.
        let mut sizes: Vec<[usize; 2]> = Vec::with_capacity(self.nodes.len());
        for node in &self.nodes {
            let Some((own, parts)) = self.size(*node) else { return false };
            let (mut depth, mut length) = (0, own);
            for part in parts {
                let Some(&[deep, long]) = (part as usize).checked_sub(1).and_then(|index| sizes.get(index)) else {
                    return false;
                };
                (depth, length) = (depth.max(deep + 1), length.saturating_add(long));
            }
            if let FormulaNode::Power(_, exponent) = node {
                length = length.saturating_mul(usize::try_from(*exponent).unwrap_or(usize::MAX).max(1));
            }
            if depth > DEEPEST || length > LONGEST {
                return false;
            }
            sizes.push([depth, length]);
        }
        true
    }

    /// The length of a node without its parts, and the numbers of these; none if it has no such name or parts.
    fn size(&self, node: FormulaNode) -> Option<(usize, Vec<u32>)> {
        use FormulaNode as N;
        let name = |place: u32| self.names.get(place as usize).map(|name| name.len() + 1);
        let list = |first: u32, count: u32| -> Option<Vec<u32>> {
            let parts = self.parts.get(first as usize..)?.get(..count as usize)?;
            Some(parts.iter().map(|part| part.unsigned_abs()).collect())
        };
        Some(match node {
            N::Name(place) => (name(place)?, Vec::new()),
            N::Integer(_) | N::Decimal(_) | N::Pi | N::Ellipsis => (1, Vec::new()),
            N::Rate(one) | N::Acceleration(one) | N::Determinant(one) | N::Inverse(one) => (1, vec![one]),
            N::Power(one, _) | N::NonZero(one) | N::Exists(one) => (1, vec![one]),
            N::Ratio(one, two) | N::Quotient(one, two) | N::Multiple(one, two) => (1, vec![one, two]),
            N::RatioDerivative(one, two, three) => (1, vec![one, two, three]),
            N::Sum(first, count) | N::Product(first, count) | N::Call(_, first, count) | N::AtMost(first, count) => {
                (1, list(first, count)?)
            }
            N::External(place, order, first, count) => {
                (name(place)?.saturating_add(order as usize), list(first, count)?)
            }
        })
    }
}

/// An error for a formula that refers to one that is not before it, and for one that is longer or deeper than any that the
/// compiler makes.
#[cfg(all(feature = "code", feature = "serde"))]
impl<'de> serde::Deserialize<'de> for FormulaNodes {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        #[derive(serde::Deserialize)]
        struct Fields {
            nodes: Vec<FormulaNode>,
            names: Vec<String>,
            parts: Vec<i32>,
        }

        let Fields { nodes, names, parts } = Fields::deserialize(deserializer)?;
        let all = Self { nodes, names, parts };
        let message = "a formula refers to one that is not before it, or is too large";
        if all.can_be_written() { Ok(all) } else { Err(serde::de::Error::custom(message)) }
    }
}

/// A number by its bits: files such as JSON have no infinity.
#[cfg(feature = "serde")]
mod bits {
    use serde::Deserialize as _;

    pub(super) fn serialize<S: serde::Serializer>(value: &f64, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_u64(value.to_bits())
    }

    pub(super) fn deserialize<'de, D: serde::Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
        u64::deserialize(deserializer).map(f64::from_bits)
    }
}
