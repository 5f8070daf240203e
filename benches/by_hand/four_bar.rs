use linkage::Real;

use super::{Checked, Dyad, Vector, bent, direction, finite, minus, times, turned};
use crate::mechanisms::{
    FourBar, FourBarAccelerations, FourBarCoordinates, FourBarKinematics, FourBarMotion, FourBarPose, FourBarRates,
};

/// The four-bar by its link vectors.
pub struct State {
    pub dyad: Dyad,
    pub rates: Vector,
    pub accelerations: Vector,
}

#[inline(never)]
pub fn bare(m: &FourBar, theta: f64, rate: f64, acceleration: f64, side: f64) -> State {
    state::<false>(m, theta.sine_cosine(), rate, acceleration, side).expect("no check")
}

#[inline(never)]
pub fn checked(m: &FourBar, theta: f64, rate: f64, acceleration: f64, side: f64) -> Checked<FourBarKinematics> {
    let (sine, cosine) = theta.sine_cosine();
    let State { dyad, rates: [theta3, theta4], accelerations: [theta3_acceleration, theta4_acceleration] } =
        state::<true>(m, (sine, cosine), rate, acceleration, side)?;
    Some(FourBarKinematics {
        pose: FourBarPose {
            theta: direction([cosine, sine], 1.0),
            theta3: direction(dyad.first, 1.0 / m.l3),
            theta4: direction(dyad.second, 1.0 / m.l4),
            theta_angle: theta,
            determinant: dyad.determinant,
        },
        rates: FourBarRates { theta3, theta4, theta: rate },
        accelerations: FourBarAccelerations {
            theta3: theta3_acceleration,
            theta4: theta4_acceleration,
            theta: acceleration,
        },
    })
}

#[inline(always)]
fn state<const CHECKED: bool>(
    m: &FourBar,
    (sine, cosine): (f64, f64),
    rate: f64,
    acceleration: f64,
    side: f64,
) -> Checked<State> {
    let crank = times([cosine, sine], m.l2);
    let dyad = Dyad::new::<CHECKED>(minus([m.l1, 0.0], crank), [m.l3, m.l4], side)?;
    moved::<CHECKED>(crank, dyad, rate, acceleration)
}

#[inline(never)]
pub fn at(m: &FourBar, q: &FourBarCoordinates, rate: f64, acceleration: f64) -> Checked<FourBarMotion> {
    let [crank, first, second, between] = f64::sines_cosines([q.theta, q.theta3, q.theta4, q.theta4 - q.theta3]);
    let links = [super::at(first, m.l3), super::at(second, m.l4)];
    let size = m.l3 * m.l4;
    let dyad = Dyad::at::<true>(links, size * between.0, size)?;
    let State { rates, accelerations, .. } = moved::<true>(super::at(crank, m.l2), dyad, rate, acceleration)?;
    let ([theta3, theta4], theta) = (rates, rate);
    let rates = FourBarRates { theta3, theta4, theta };
    let ([theta3, theta4], theta) = (accelerations, acceleration);
    Some(FourBarMotion {
        position: *q,
        rates,
        accelerations: FourBarAccelerations { theta3, theta4, theta },
        points: [],
        outputs: [],
    })
}

#[inline(always)]
fn moved<const CHECKED: bool>(crank: Vector, dyad: Dyad, rate: f64, acceleration: f64) -> Checked<State> {
    let back = times(crank, -1.0);
    let rates = dyad.rates(turned(back, rate));
    let accelerations = dyad.accelerations(rates, bent(back, rate, acceleration));
    finite::<CHECKED, _>(accelerations)?;
    Some(State { dyad, rates, accelerations })
}
