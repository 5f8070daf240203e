//! Vectors of q.

use core::ops::{Add, Mul, Neg, Sub};

use super::rounding::weak;
use crate::scalar::{larger, largest};
use crate::{Column, Dim, Real};

/// A vector of q: its part along the unknowns, and its part along the inputs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Vector<T: Real, U: Dim, V: Dim> {
    /// Along the unknowns.
    pub unknowns: Column<T, U>,
    /// Along the inputs.
    pub inputs: Column<T, V>,
}

impl<T: Real, U: Dim, V: Dim> Vector<T, U, V> {
    /// Zero.
    #[must_use]
    pub fn zero() -> Self {
        Self { unknowns: Column::zeros(), inputs: Column::zeros() }
    }

    /// The unit vector of a coordinate, by its column in [J A]: from `U` on they are inputs.
    #[must_use]
    pub fn unit(column: usize) -> Self {
        let mut vector = Self::zero();
        vector.set(column, T::one());
        vector
    }

    /// A coordinate, by its column in [J A].
    #[must_use]
    pub fn get(&self, column: usize) -> T {
        if column < U::COUNT { self.unknowns[column] } else { self.inputs[column - U::COUNT] }
    }

    /// Gives a coordinate another value, by its column in [J A].
    pub fn set(&mut self, column: usize, value: T) {
        if column < U::COUNT {
            self.unknowns[column] = value;
        } else {
            self.inputs[column - U::COUNT] = value;
        }
    }

    /// The sum of the products of the coordinates.
    #[must_use]
    pub fn dot(&self, other: &Self) -> T {
        self.unknowns.dot(&other.unknowns) + self.inputs.dot(&other.inputs)
    }

    /// The root of the sum of the squares.
    #[must_use]
    pub fn norm(&self) -> T {
        self.dot(self).sqrt()
    }

    /// The largest magnitude; not a number if a coordinate is none.
    #[must_use]
    pub fn largest(&self) -> T {
        larger(largest(self.unknowns), largest(self.inputs))
    }

    /// The same way, of length 1.
    #[must_use]
    pub fn normalized(&self) -> Self {
        *self * self.norm().recip()
    }

    /// What is left of it across a unit vector.
    #[must_use]
    pub fn across(&self, direction: &Self) -> T {
        (*self - *direction * self.dot(direction)).norm()
    }

    /// The magnitudes.
    #[must_use]
    pub fn abs(&self) -> Self {
        Self { unknowns: self.unknowns.abs(), inputs: self.inputs.abs() }
    }

    /// Each coordinate times that of another.
    #[must_use]
    pub fn scaled(&self, by: &Self) -> Self {
        Self { unknowns: self.unknowns.component_mul(&by.unknowns), inputs: self.inputs.component_mul(&by.inputs) }
    }

    /// Each coordinate beside that of another.
    #[must_use]
    pub fn beside(&self, size: &Self) -> Self {
        Self { unknowns: self.unknowns.component_div(&size.unknowns), inputs: self.inputs.component_div(&size.inputs) }
    }

    /// A direction or its opposite: that in which the inputs keep their way along another, or if they rest the first of
    /// the unknowns that move along both.
    #[must_use]
    pub fn like(&self, other: &Self) -> Self {
        let inputs = self.inputs.iter().zip(&other.inputs);
        let products = inputs.chain(self.unknowns.iter().zip(&other.unknowns)).map(|(one, two)| *one * *two);
        let mut decisive = products.filter(|product| product.abs() > weak());
        if decisive.next().is_some_and(|product| product < T::zero()) { -*self } else { *self }
    }

    /// Whether every coordinate is finite.
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
