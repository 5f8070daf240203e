//! Constants that are no exact ratios, and their values.

/// Exponents of e up to this magnitude keep the digits that `MARGIN` of the independence relies on.
const LARGEST_EXPONENT: f64 = 1e3;

/// A variable that depends on no symbol.
pub(super) enum Constant {
    Pi,
    /// e^exponent.
    Exponential {
        exponent: Complex,
        algebraic: bool,
    },
}

impl Constant {
    pub(super) fn power(&self, exponent: f64) -> Complex {
        match self {
            Self::Pi => Complex { re: std::f64::consts::PI.powf(exponent), im: 0.0 },
            Self::Exponential { exponent: inner, .. } => inner.times(Complex { re: exponent, im: 0.0 }).exponential(),
        }
    }
}

/// A complex number in floats.
#[derive(Clone, Copy)]
pub(super) struct Complex {
    pub(super) re: f64,
    pub(super) im: f64,
}

impl Complex {
    pub(super) const ONE: Self = Self { re: 1.0, im: 0.0 };
    pub(super) const I: Self = Self { re: 0.0, im: 1.0 };

    /// exp(2 pi i power / order).
    pub(super) fn root(power: u32, order: u32) -> Self {
        let (im, re) = (std::f64::consts::TAU * f64::from(power) / f64::from(order)).sin_cos();
        Self { re, im }
    }

    pub(super) fn times(self, other: Self) -> Self {
        Self { re: self.re * other.re - self.im * other.im, im: self.re * other.im + self.im * other.re }
    }

    fn exponential(self) -> Self {
        if self.re.abs().max(self.im.abs()) > LARGEST_EXPONENT {
            return Self { re: f64::NAN, im: f64::NAN };
        }
        let (sine, cosine) = self.im.sin_cos();
        Self { re: self.re.exp() * cosine, im: self.re.exp() * sine }
    }
}
