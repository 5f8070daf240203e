//! Vectors in the space of the coordinates q.

use core::ops::{Add, Mul, Neg, Sub};

use super::ulp::nearly_zero;
use crate::scalar::{larger, largest};
use crate::{Build, Column, Dim, Real};

/// A vector in the space of q, with its components along the unknowns and along the inputs.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(bound(
        serialize = "T: serde::Serialize",
        deserialize = "T: serde::Deserialize<'de>, U: Default, V: Default"
    ))
)]
pub struct Vector<T: Real, U: Dim, V: Dim> {
    /// The components along the unknowns.
    pub unknowns: Column<T, U>,
    /// The components along the inputs.
    pub inputs: Column<T, V>,
}

impl<T: Real, U: Dim, V: Dim> Vector<T, U, V> {
    /// The zero vector, with so many unknowns and inputs.
    #[must_use]
    pub fn zero((u, v): (U, V)) -> Self {
        Self { unknowns: u.zeros(), inputs: v.zeros() }
    }

    /// The unit vector of a coordinate, by its column in [J A]; columns from the number of unknowns on are inputs.
    #[must_use]
    pub fn unit(dims: (U, V), column: usize) -> Self {
        let mut vector = Self::zero(dims);
        vector.set(column, T::one());
        vector
    }

    /// The numbers of unknowns and inputs.
    #[inline]
    #[must_use]
    pub fn dims(&self) -> (U, V) {
        (self.unknowns.dim(), self.inputs.dim())
    }

    /// Returns a coordinate, by its column in [J A].
    #[must_use]
    pub fn get(&self, column: usize) -> T {
        match column.checked_sub(self.unknowns.dim().count()) {
            None => self.unknowns[column],
            Some(input) => self.inputs[input],
        }
    }

    /// Sets a coordinate, by its column in [J A].
    pub fn set(&mut self, column: usize, value: T) {
        match column.checked_sub(self.unknowns.dim().count()) {
            None => self.unknowns[column] = value,
            Some(input) => self.inputs[input] = value,
        }
    }

    /// The dot product.
    #[must_use]
    pub fn dot(&self, other: &Self) -> T {
        self.unknowns.dot(&other.unknowns) + self.inputs.dot(&other.inputs)
    }

    /// The Euclidean norm.
    #[must_use]
    pub fn norm(&self) -> T {
        self.dot(self).sqrt()
    }

    /// The largest magnitude; NaN if a coordinate is NaN.
    #[must_use]
    pub fn largest(&self) -> T {
        larger(largest(self.unknowns), largest(self.inputs))
    }

    /// The unit vector in this direction.
    #[must_use]
    pub fn normalized(&self) -> Self {
        *self * self.norm().recip()
    }

    /// The length of the component orthogonal to a unit vector.
    #[must_use]
    pub fn across(&self, direction: &Self) -> T {
        (*self - *direction * self.dot(direction)).norm()
    }

    /// The magnitudes of the coordinates.
    #[must_use]
    pub fn abs(&self) -> Self {
        Self { unknowns: self.unknowns.abs(), inputs: self.inputs.abs() }
    }

    /// The entrywise product.
    #[must_use]
    pub fn scaled(&self, by: &Self) -> Self {
        Self { unknowns: self.unknowns.component_mul(&by.unknowns), inputs: self.inputs.component_mul(&by.inputs) }
    }

    /// The entrywise quotient, by scales.
    #[must_use]
    pub fn relative_to(&self, scales: &Self) -> Self {
        Self {
            unknowns: self.unknowns.component_div(&scales.unknowns),
            inputs: self.inputs.component_div(&scales.inputs),
        }
    }

    /// Returns this vector or its opposite, so that the first input that moves in both has the same sign as in `other`;
    /// if none does, the first unknown that moves in both.
    #[must_use]
    pub fn like(&self, other: &Self) -> Self {
        let inputs = self.inputs.iter().zip(&other.inputs);
        let products = inputs.chain(self.unknowns.iter().zip(&other.unknowns)).map(|(one, two)| *one * *two);
        let mut decisive = products.filter(|product| product.abs() > nearly_zero());
        if decisive.next().is_some_and(|product| product < T::zero()) { -*self } else { *self }
    }

    /// True if every coordinate is finite.
    #[must_use]
    pub fn is_finite(&self) -> bool {
        self.unknowns.is_finite() && self.inputs.is_finite()
    }
}

impl<T: Real, U: Dim, V: Dim> Add for Vector<T, U, V> {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self { unknowns: self.unknowns + other.unknowns, inputs: self.inputs + other.inputs }
    }
}

impl<T: Real, U: Dim, V: Dim> Sub for Vector<T, U, V> {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        Self { unknowns: self.unknowns - other.unknowns, inputs: self.inputs - other.inputs }
    }
}

impl<T: Real, U: Dim, V: Dim> Neg for Vector<T, U, V> {
    type Output = Self;

    fn neg(self) -> Self {
        Self { unknowns: -self.unknowns, inputs: -self.inputs }
    }
}

impl<T: Real, U: Dim, V: Dim> Mul<T> for Vector<T, U, V> {
    type Output = Self;

    fn mul(self, factor: T) -> Self {
        Self { unknowns: self.unknowns * factor, inputs: self.inputs * factor }
    }
}
