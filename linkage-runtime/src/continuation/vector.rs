//! Vectors of q, each coordinate beside its size.

use core::ops::{Add, Mul, Sub};

use nalgebra::SVector;

use super::place::weak;
use crate::Real;
use crate::scalar::{larger, largest};

/// A vector of q: its part along the unknowns, and its part along the input.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Vector<T, const U: usize> {
    pub(super) unknowns: SVector<T, U>,
    pub(super) input: T,
}

impl<T: Real, const U: usize> Vector<T, U> {
    pub(super) fn zero() -> Self {
        Self { unknowns: SVector::zeros(), input: T::zero() }
    }

    /// The unit vector of a coordinate; that at place `U` is the input.
    pub(super) fn unit(place: usize) -> Self {
        let mut vector = Self::zero();
        vector.set(place, T::one());
        vector
    }

    pub(super) fn set(&mut self, place: usize, value: T) {
        match self.unknowns.get_mut(place) {
            Some(entry) => *entry = value,
            None => self.input = value,
        }
    }

    pub(super) fn dot(&self, other: &Self) -> T {
        self.unknowns.dot(&other.unknowns) + self.input * other.input
    }

    pub(super) fn norm(&self) -> T {
        self.dot(self).sqrt()
    }

    pub(super) fn largest(&self) -> T {
        larger(largest(self.unknowns.iter().copied()), self.input.abs())
    }

    pub(super) fn normalized(&self) -> Self {
        *self * self.norm().recip()
    }

    /// What is left of it across a unit vector.
    pub(super) fn across(&self, direction: &Self) -> T {
        (*self - *direction * self.dot(direction)).norm()
    }

    /// Each coordinate times that of another.
    pub(super) fn scaled(&self, by: &Self) -> Self {
        Self { unknowns: self.unknowns.component_mul(&by.unknowns), input: self.input * by.input }
    }

    /// Each coordinate beside that of another.
    pub(super) fn beside(&self, size: &Self) -> Self {
        Self { unknowns: self.unknowns.component_div(&size.unknowns), input: self.input / size.input }
    }

    /// A direction or its opposite: that in which the input keeps its way along another, or if it rests the first of the
    /// unknowns that move along both.
    pub(super) fn like(&self, other: &Self) -> Self {
        let products = core::iter::once(self.input * other.input)
            .chain(self.unknowns.iter().zip(other.unknowns.iter()).map(|(one, two)| *one * *two));
        let mut decisive = products.filter(|product| product.abs() > weak());
        if decisive.next().is_some_and(|product| product < T::zero()) { *self * -T::one() } else { *self }
    }

    pub(super) fn is_finite(&self) -> bool {
        self.unknowns.iter().all(T::is_finite) && self.input.is_finite()
    }
}

impl<T: Real, const U: usize> Add for Vector<T, U> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self { unknowns: self.unknowns + other.unknowns, input: self.input + other.input }
    }
}

impl<T: Real, const U: usize> Sub for Vector<T, U> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self { unknowns: self.unknowns - other.unknowns, input: self.input - other.input }
    }
}

impl<T: Real, const U: usize> Mul<T> for Vector<T, U> {
    type Output = Self;
    fn mul(self, factor: T) -> Self {
        Self { unknowns: self.unknowns * factor, input: self.input * factor }
    }
}
