use linkage::Real;

use super::{Checked, Dyad, Vector, bent, direction, dot, finite, plus, times, turned};
use crate::mechanisms::{
    StephensonIII, StephensonIIIAccelerations, StephensonIIICoordinates, StephensonIIIKinematics, StephensonIIIMotion,
    StephensonIIIPose, StephensonIIIRates,
};

/// The six-bar by its link vectors.
pub struct State {
    /// The direction of the coupler.
    pub coupler: Vector,
    pub dyads: [Dyad; 2],
    pub rates: [Vector; 2],
    pub accelerations: [Vector; 2],
}

#[inline(never)]
pub fn bare(m: &StephensonIII, theta: f64, rate: f64, acceleration: f64, sides: [f64; 2]) -> State {
    state::<false>(m, theta.sine_cosine(), rate, acceleration, sides).expect("no check")
}

#[inline(never)]
pub fn checked(
    m: &StephensonIII,
    theta: f64,
    rate: f64,
    acceleration: f64,
    sides: [f64; 2],
) -> Checked<StephensonIIIKinematics> {
    let (sine, cosine) = theta.sine_cosine();
    let State { coupler, dyads: [first, second], rates, accelerations } =
        state::<true>(m, (sine, cosine), rate, acceleration, sides)?;
    let [[theta3, theta4], [theta5, theta6]] = rates;
    let rates = StephensonIIIRates { theta3, theta4, theta5, theta6, theta: rate };
    let [[theta3, theta4], [theta5, theta6]] = accelerations;
    let accelerations = StephensonIIIAccelerations { theta3, theta4, theta5, theta6, theta: acceleration };
    // Rockers are second links, taken backwards.
    let pose = StephensonIIIPose {
        theta: direction([cosine, sine], 1.0),
        theta3: direction(coupler, 1.0),
        theta4: direction(first.second, -1.0 / m.c),
        theta5: direction(second.first, 1.0 / m.e),
        theta6: direction(second.second, -1.0 / m.f),
        theta_angle: theta,
        determinant_1: first.determinant,
        determinant_2: second.determinant,
    };
    Some(StephensonIIIKinematics { pose, rates, accelerations })
}

#[inline(always)]
fn state<const CHECKED: bool>(
    m: &StephensonIII,
    (sine, cosine): (f64, f64),
    rate: f64,
    acceleration: f64,
    sides: [f64; 2],
) -> Checked<State> {
    // From the joint of the coupler back to the ground, and so on: dyads close these.
    let crank = times([cosine, sine], -m.a);
    let (crank_rate, crank_acceleration) = (turned(crank, rate), bent(crank, rate, acceleration));
    let first = Dyad::new::<CHECKED>(plus([m.d, 0.0], crank), [m.b, m.c], sides[0])?;
    let rates = first.rates(crank_rate);
    let accelerations = first.accelerations(rates, crank_acceleration);
    finite::<CHECKED, _>(accelerations)?;
    let coupler = times(first.first, 1.0 / m.b);
    let arm = arm([-m.px, -m.py], coupler);
    let (arm_rate, arm_acceleration) = (turned(arm, rates[0]), bent(arm, rates[0], accelerations[0]));
    let point = plus(crank, arm);
    let second = Dyad::new::<CHECKED>(plus([m.fx, m.fy], point), [m.e, m.f], sides[1])?;
    let rates = [rates, second.rates(plus(crank_rate, arm_rate))];
    let accelerations = [accelerations, second.accelerations(rates[1], plus(crank_acceleration, arm_acceleration))];
    finite::<CHECKED, _>(accelerations[1])?;
    Some(State { coupler, dyads: [first, second], rates, accelerations })
}

#[inline(never)]
pub fn at(
    m: &StephensonIII,
    q: &StephensonIIICoordinates,
    rate: f64,
    acceleration: f64,
) -> Checked<StephensonIIIMotion> {
    let [crank, coupler, rocker, third, fourth, first_difference, second_difference] =
        f64::sines_cosines([q.theta, q.theta3, q.theta4, q.theta5, q.theta6, q.theta3 - q.theta4, q.theta5 - q.theta6]);
    let (size, links) = (m.b * m.c, [super::at(coupler, m.b), super::at(rocker, -m.c)]);
    let first = Dyad::at::<true>(links, size * first_difference.0, size)?;
    let (size, links) = (m.e * m.f, [super::at(third, m.e), super::at(fourth, -m.f)]);
    let second = Dyad::at::<true>(links, size * second_difference.0, size)?;
    let arm = arm([m.px, m.py], [coupler.1, coupler.0]);
    let crank = super::at(crank, m.a);
    let (rates, accelerations) = moved::<true>(crank, arm, &[first, second], rate, acceleration)?;
    let [[theta3, theta4], [theta5, theta6]] = rates;
    let rates = StephensonIIIRates { theta3, theta4, theta5, theta6, theta: rate };
    let [[theta3, theta4], [theta5, theta6]] = accelerations;
    let accelerations = StephensonIIIAccelerations { theta3, theta4, theta5, theta6, theta: acceleration };
    Some(StephensonIIIMotion { position: *q, rates, accelerations })
}

/// The vector on the coupler from the crank's pin to the joint of the second dyad.
#[inline(always)]
fn arm([x, y]: Vector, coupler: Vector) -> Vector {
    [dot([x, -y], coupler), dot([y, x], coupler)]
}

#[inline(always)]
fn moved<const CHECKED: bool>(
    crank: Vector,
    arm: Vector,
    [first, second]: &[Dyad; 2],
    rate: f64,
    acceleration: f64,
) -> Checked<([Vector; 2], [Vector; 2])> {
    let (crank_rate, crank_acceleration) = (turned(crank, rate), bent(crank, rate, acceleration));
    let rates = first.rates(times(crank_rate, -1.0));
    let accelerations = first.accelerations(rates, times(crank_acceleration, -1.0));
    let (arm_rate, arm_acceleration) = (turned(arm, rates[0]), bent(arm, rates[0], accelerations[0]));
    let point_rate = plus(crank_rate, arm_rate);
    let rates = [rates, second.rates(times(point_rate, -1.0))];
    let point_acceleration = plus(crank_acceleration, arm_acceleration);
    let accelerations = [accelerations, second.accelerations(rates[1], times(point_acceleration, -1.0))];
    let [[a, b], [c, d]] = accelerations;
    finite::<CHECKED, _>([a, b, c, d])?;
    Some((rates, accelerations))
}
