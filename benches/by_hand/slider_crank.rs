use linkage::Real;

use super::{Checked, SMALLEST, Vector, bent, direction, finite, times};
use crate::mechanisms::{
    SliderCrank, SliderCrankAccelerations, SliderCrankCoordinates, SliderCrankKinematics, SliderCrankMotion,
    SliderCrankPose, SliderCrankRates,
};

/// The slider-crank by its link vectors.
pub struct State {
    pub rod: Vector,
    pub slider: f64,
    /// Those of the rod's angle and of the slider.
    pub rates: Vector,
    pub accelerations: Vector,
}

#[inline(never)]
pub fn bare(m: &SliderCrank, theta: f64, rate: f64, acceleration: f64, side: f64) -> State {
    state::<false>(m, theta.sine_cosine(), rate, acceleration, side).expect("no check")
}

#[inline(never)]
pub fn checked(m: &SliderCrank, theta: f64, rate: f64, acceleration: f64, side: f64) -> Checked<SliderCrankKinematics> {
    let (sine, cosine) = theta.sine_cosine();
    let State { rod, slider, rates: [phi, s], accelerations: [phi_acceleration, s_acceleration] } =
        state::<true>(m, (sine, cosine), rate, acceleration, side)?;
    Some(SliderCrankKinematics {
        pose: SliderCrankPose {
            theta: direction([cosine, sine], 1.0),
            phi: direction(rod, 1.0 / m.rod),
            s: slider,
            theta_angle: theta,
            determinant: rod[0],
        },
        rates: SliderCrankRates { phi, s, theta: rate },
        accelerations: SliderCrankAccelerations { phi: phi_acceleration, s: s_acceleration, theta: acceleration },
    })
}

#[inline(always)]
fn state<const CHECKED: bool>(
    m: &SliderCrank,
    (sine, cosine): (f64, f64),
    rate: f64,
    acceleration: f64,
    side: f64,
) -> Checked<State> {
    let crank = times([cosine, sine], m.crank);
    let y = m.offset - crank[1];
    let product = (m.rod - y) * (m.rod + y);
    if CHECKED && !(product > SMALLEST && product < 1.0 / SMALLEST) {
        return None;
    }
    let rod = [side * product.sqrt(), y];
    moved::<CHECKED>(m, crank, rod, rate, acceleration)
}

#[inline(never)]
pub fn at(m: &SliderCrank, q: &SliderCrankCoordinates, rate: f64, acceleration: f64) -> Checked<SliderCrankMotion> {
    let [crank, rod] = f64::sines_cosines([q.theta, q.phi]);
    let (crank, rod) = (super::at(crank, m.crank), super::at(rod, m.rod));
    finite::<true, _>([rod[0]])?;
    let State { rates, accelerations, .. } = moved::<true>(m, crank, rod, rate, acceleration)?;
    finite::<true, _>([q.s])?;
    let ([phi, s], theta) = (rates, rate);
    let rates = SliderCrankRates { phi, s, theta };
    let ([phi, s], theta) = (accelerations, acceleration);
    Some(SliderCrankMotion {
        position: *q,
        rates,
        accelerations: SliderCrankAccelerations { phi, s, theta },
        points: [],
        outputs: [],
    })
}

#[inline(always)]
fn moved<const CHECKED: bool>(
    m: &SliderCrank,
    crank: Vector,
    rod: Vector,
    rate: f64,
    acceleration: f64,
) -> Checked<State> {
    let [x, y] = rod;
    if CHECKED && x.abs() <= 8.0 * f64::EPSILON * m.rod.abs() {
        return None;
    }
    let inverse = 1.0 / x;
    // The rod turns so that its end stays on the guide.
    let phi = -crank[0] * rate * inverse;
    let [pin_x, pin_y] = bent(crank, rate, acceleration);
    let squared = phi * phi;
    let phi_acceleration = (y * squared - pin_y) * inverse;
    let s_acceleration = pin_x - x * squared - y * phi_acceleration;
    let s = -(crank[1] * rate + y * phi);
    // The acceleration of the rod is a part of that of the slider.
    finite::<CHECKED, _>([s, s_acceleration])?;
    Some(State { rod, slider: crank[0] + x, rates: [phi, s], accelerations: [phi_acceleration, s_acceleration] })
}
