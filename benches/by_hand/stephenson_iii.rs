use linkage::Real;

use super::{Checked, Dyad, Vector, bent, direction, dot, finite, plus, times, turned};
use crate::mechanisms::{
    StephensonIII, StephensonIIIAccelerations, StephensonIIICoordinates, StephensonIIIKinematics, StephensonIIIMotion,
    StephensonIIIPose, StephensonIIIRates,
};

/// The solution of a dyad.
#[derive(Clone, Copy)]
pub struct Group {
    pub dyad: Dyad,
    pub rates: Vector,
    pub accelerations: Vector,
}

/// The motion of a point.
#[derive(Clone, Copy)]
struct Moving {
    position: Vector,
    rate: Vector,
    acceleration: Vector,
}

impl Moving {
    /// The end of a link with this vector, rate and acceleration.
    #[inline(always)]
    fn end(link: Vector, rate: f64, acceleration: f64) -> Self {
        Self { position: link, rate: turned(link, rate), acceleration: bent(link, rate, acceleration) }
    }

    #[inline(always)]
    fn plus(self, other: Self) -> Self {
        Self {
            position: plus(self.position, other.position),
            rate: plus(self.rate, other.rate),
            acceleration: plus(self.acceleration, other.acceleration),
        }
    }
}

/// The direction of the coupler, and the dyads.
#[inline(never)]
pub fn bare(m: &StephensonIII, theta: f64, rate: f64, acceleration: f64, sides: [f64; 2]) -> (Vector, [Group; 2]) {
    let crank = crank(m, theta.sine_cosine(), rate, acceleration);
    let first = group::<false>([m.d, 0.0], crank, [m.b, m.c], sides[0]).expect("no check");
    let coupler = times(first.dyad.first, 1.0 / m.b);
    let point = point(m, crank, coupler, &first);
    let second = group::<false>([m.fx, m.fy], point, [m.e, m.f], sides[1]).expect("no check");
    (coupler, [first, second])
}

#[inline(never)]
pub fn checked(
    m: &StephensonIII,
    theta: f64,
    rate: f64,
    acceleration: f64,
    sides: [f64; 2],
) -> Checked<StephensonIIIKinematics> {
    // Results are stored as they become known: there are more than registers.
    let mut result = Some(zero());
    let Some(StephensonIIIKinematics { pose, rates, accelerations }) = &mut result else { return None };
    let (sine, cosine) = theta.sine_cosine();
    (pose.theta, pose.theta_angle) = (direction([cosine, sine], 1.0), theta);
    (rates.theta, accelerations.theta) = (rate, acceleration);
    let crank = crank(m, (sine, cosine), rate, acceleration);
    let first = group::<true>([m.d, 0.0], crank, [m.b, m.c], sides[0])?;
    let coupler = times(first.dyad.first, 1.0 / m.b);
    // Rockers are second links, taken backwards.
    pose.determinant_1 = first.dyad.determinant;
    pose.theta3 = direction(coupler, 1.0);
    pose.theta4 = direction(first.dyad.second, -1.0 / m.c);
    [rates.theta3, rates.theta4] = first.rates;
    [accelerations.theta3, accelerations.theta4] = first.accelerations;
    let point = point(m, crank, coupler, &first);
    let second = group::<true>([m.fx, m.fy], point, [m.e, m.f], sides[1])?;
    pose.determinant_2 = second.dyad.determinant;
    pose.theta5 = direction(second.dyad.first, 1.0 / m.e);
    pose.theta6 = direction(second.dyad.second, -1.0 / m.f);
    [rates.theta5, rates.theta6] = second.rates;
    [accelerations.theta5, accelerations.theta6] = second.accelerations;
    // The acceleration of the coupler is a part of those of the second dyad.
    finite::<true, _>([first.accelerations[1], second.accelerations[0], second.accelerations[1]])?;
    result
}

#[inline(always)]
fn zero() -> StephensonIIIKinematics {
    let none = direction([0.0; 2], 1.0);
    StephensonIIIKinematics {
        pose: StephensonIIIPose {
            theta: none,
            theta3: none,
            theta4: none,
            theta5: none,
            theta6: none,
            theta_angle: 0.0,
            determinant_1: 0.0,
            determinant_2: 0.0,
        },
        rates: StephensonIIIRates { theta3: 0.0, theta4: 0.0, theta5: 0.0, theta6: 0.0, theta: 0.0 },
        accelerations: StephensonIIIAccelerations { theta3: 0.0, theta4: 0.0, theta5: 0.0, theta6: 0.0, theta: 0.0 },
    }
}

/// From the joint of the coupler back to the ground, and so on: dyads close these.
#[inline(always)]
fn crank(m: &StephensonIII, (sine, cosine): (f64, f64), rate: f64, acceleration: f64) -> Moving {
    Moving::end(times([cosine, sine], -m.a), rate, acceleration)
}

#[inline(always)]
fn point(m: &StephensonIII, crank: Moving, coupler: Vector, first: &Group) -> Moving {
    crank.plus(Moving::end(arm([-m.px, -m.py], coupler), first.rates[0], first.accelerations[0]))
}

#[inline(always)]
fn group<const CHECKED: bool>(ground: Vector, from: Moving, links: Vector, side: f64) -> Checked<Group> {
    let dyad = Dyad::new::<CHECKED>(plus(ground, from.position), links, side)?;
    let rates = dyad.rates(from.rate);
    let accelerations = dyad.accelerations(rates, from.acceleration);
    Some(Group { dyad, rates, accelerations })
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
    Some(StephensonIIIMotion { position: *q, rates, accelerations, points: [], outputs: [] })
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
