//! The operations of straight-line code, in the order of computation.

use std::collections::BTreeMap;

use crate::graph::Number;

/// An operation and its result.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Place(usize);

#[derive(Debug)]
pub(super) enum Operation {
    Argument,
    Number(Number),
    /// The terms, from left to right, each with true if it is subtracted.
    Sum(Vec<(bool, Place)>),
    /// The factors, from left to right.
    Product(Vec<Place>),
    Quotient([Place; 2]),
    Square(Place),
    Negative(Place),
    /// A function by its name in FPCore.
    Call(&'static str, Vec<Place>),
}

/// A condition of the code on numbers, by its word.
#[derive(Debug)]
pub(super) struct Check {
    pub(super) word: &'static str,
    /// It holds for the results that depend on the first.
    pub(super) of: Vec<Place>,
}

#[derive(Debug, Default)]
pub(super) struct Operations {
    all: Vec<(Operation, Option<String>)>,
    /// The arguments by role and name.
    arguments: BTreeMap<(usize, String), Place>,
}

impl Operations {
    pub(super) fn add(&mut self, operation: Operation) -> Place {
        self.all.push((operation, None));
        Place(self.all.len() - 1)
    }

    /// The argument of a role with this key, which gets this name if it is new.
    pub(super) fn argument(&mut self, key: (usize, String), name: &str) -> Place {
        if let Some(place) = self.arguments.get(&key) {
            return *place;
        }
        let place = self.add(Operation::Argument);
        self.all[place.0].1 = Some(name.to_owned());
        self.arguments.insert(key, place);
        place
    }

    /// The argument with this key, if the code uses it.
    pub(super) fn known(&self, key: &(usize, String)) -> Option<Place> {
        self.arguments.get(key).copied()
    }

    /// Gives a result its name in the code, unless it has one.
    pub(super) fn name(&mut self, place: Place, name: &str) {
        self.all[place.0].1.get_or_insert_with(|| name.to_owned());
    }

    pub(super) fn operation(&self, place: Place) -> &Operation {
        &self.all[place.0].0
    }

    pub(super) fn preferred(&self, place: Place) -> Option<&str> {
        self.all[place.0].1.as_deref()
    }

    /// All places, in the order of computation.
    pub(super) fn places(&self) -> impl DoubleEndedIterator<Item = Place> + use<> {
        (0..self.all.len()).map(Place)
    }
}

impl Place {
    pub(super) fn index(self) -> usize {
        self.0
    }
}

impl Operation {
    /// True for an argument or a number, which is no operation.
    pub(super) fn is_leaf(&self) -> bool {
        matches!(self, Self::Argument | Self::Number(_))
    }

    /// Visits the operands, each as often as it is written.
    pub(super) fn each_operand(&self, mut visit: impl FnMut(Place)) {
        match self {
            Self::Argument | Self::Number(_) => {}
            Self::Sum(terms) => terms.iter().for_each(|(_, term)| visit(*term)),
            Self::Product(all) | Self::Call(_, all) => all.iter().copied().for_each(visit),
            Self::Quotient(parts) => parts.iter().copied().for_each(visit),
            Self::Square(base) => [*base, *base].into_iter().for_each(visit),
            Self::Negative(inside) => visit(*inside),
        }
    }
}
