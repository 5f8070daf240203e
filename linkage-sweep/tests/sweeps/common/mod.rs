//! A slider-crank written by hand: crank r, rod l, offset e, angle theta; the slider at s.
#![allow(dead_code, reason = "the test `memory` calls only some of these functions")]

use std::ops::ControlFlow;

use linkage_runtime::lanes::{Found, Given, Lanes};
use linkage_runtime::{D, InputValues, PositionError, Real, real};
use linkage_sweep::{Distribution, Plan, Progress, Sequence, Sweep};

#[derive(Debug, Clone, Copy)]
pub struct Crank<T> {
    pub r: T,
    pub l: T,
    pub e: T,
}

impl<T: Real> Crank<T> {
    /// Theta, s, their rates and accelerations, and the tangent of the rod's angle.
    #[inline(always)]
    fn motion(&self, theta: T, omega: T, alpha: T) -> ([T; 7], T) {
        let Self { r, l, e } = *self;
        let (sine, cosine) = theta.sine_cosine();
        let y = r * sine - e;
        let square = l * l - y * y;
        let q = square.sqrt();
        let dy = r * cosine * omega;
        let ddy = r * cosine * alpha - r * sine * omega * omega;
        let dq = -y * dy / q;
        let ddq = -(dy * dy + y * ddy + dq * dq) / q;
        let s = r * cosine + q;
        let ds = -r * sine * omega + dq;
        let dds = -r * cosine * omega * omega - r * sine * alpha + ddq;
        ([theta, s, omega, ds, alpha, dds, y / q], square)
    }
}

impl<T: Real> Lanes for Crank<T> {
    type Scalar = T;
    type Branch = ();
    type Given = D<6>;
    type Found = D<7>;

    const NAME: &'static str = "Crank";
    const GIVEN: &'static [&'static str] = &["r", "l", "e", "theta", "theta rate", "theta acceleration"];
    const FOUND: &'static [&'static str] =
        &["theta", "s", "theta rate", "s rate", "theta acceleration", "s acceleration", "lean, \"y / q\""];
    const PARAMETERS: usize = 3;
    const COORDINATES: usize = 6;
    const START: usize = 1;

    fn write_parameters(&self, given: &mut Given<Self, T>) {
        [given[0], given[1], given[2]] = [self.r, self.l, self.e];
    }

    #[inline(always)]
    fn design<const W: usize>(given: &Given<Self, [T; W]>, lane: usize) -> Self {
        Self { r: given[0][lane], l: given[1][lane], e: given[2][lane] }
    }

    #[inline(always)]
    fn lane<const W: usize, const QUANTITIES: bool>(
        &self,
        given: &Given<Self, [T; W]>,
        (): (),
        lane: usize,
        found: &mut Found<Self, [T; W]>,
    ) -> bool {
        let (values, square) = self.motion(given[3][lane], given[4][lane], given[5][lane]);
        for (column, value) in found.iter_mut().zip(values) {
            column[lane] = value;
        }
        square > T::zero() && values.into_iter().fold(T::zero(), |sum, value| sum + value).is_finite()
    }

    fn exact<const QUANTITIES: bool>(&self, given: &Given<Self, T>, (): ()) -> Result<Found<Self, T>, PositionError> {
        let (values, square) = self.motion(given[3], given[4], given[5]);
        let (mechanism, group) = (Self::NAME, "s");
        if square < T::zero() {
            let gap = linkage_runtime::nalgebra::try_convert(-square / (self.l * self.l)).unwrap_or(f64::NAN);
            return Err(PositionError::Unbuildable { mechanism, group, gap, inputs: InputValues::default() });
        }
        if square == T::zero() {
            return Err(PositionError::Singular { mechanism, group, regularity: 0.0 });
        }
        if !values.iter().all(|value| value.is_finite()) {
            return Err(PositionError::NotFinite { mechanism, quantity: "a coordinate" });
        }
        Ok(values)
    }
}

/// A crank that turns fully.
pub fn crank<T: Real>() -> Crank<T> {
    Crank { r: real(1.0), l: real(3.0), e: real(0.25) }
}

/// A plan of 7 * 13 * 24 rows, of which some cannot be assembled.
pub fn plan() -> Plan {
    let columns = [
        ("l", Distribution::Uniform { from: 1.0, to: 2.0 }),
        ("e", Distribution::Normal { mean: 0.2, deviation: 0.3 }),
    ];
    Plan::new()
        .grid("r", 0.5, 1.5, 7)
        .sample(columns, 13, Sequence::Random)
        .turn("theta", 24)
        .constant("theta rate", 2.0)
        .seed(42)
}

pub fn sweep<T: Real>() -> Sweep<Crank<T>> {
    Sweep::new(&crank(), (), plan()).unwrap()
}

pub fn go_on(_: Progress) -> ControlFlow<()> {
    ControlFlow::Continue(())
}

/// The bits of numbers, which also compare NaN.
pub fn bits(values: &[f64]) -> Vec<u64> {
    values.iter().map(|value| value.to_bits()).collect()
}
