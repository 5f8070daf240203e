use linkage::Real;

use super::{Checked, Dyad, Vector, bent, direction, finite, minus, times, turned};
use crate::mechanisms::{
    Jansen, JansenAccelerations, JansenCoordinates, JansenKinematics, JansenMotion, JansenPose, JansenRates,
};

/// The leg by its dyads: b and j, d and e, c and k, f and g, i and h. The second link of each is taken backwards.
pub struct State {
    pub dyads: [Moving; 5],
}

/// A dyad with its rates and accelerations.
pub struct Moving {
    pub dyad: Dyad,
    pub rates: Vector,
    pub accelerations: Vector,
}

impl Moving {
    #[inline(always)]
    fn new<const CHECKED: bool>([d, d_rate, d_acceleration]: [Vector; 3], links: Vector, side: f64) -> Checked<Self> {
        let dyad = Dyad::new::<CHECKED>(d, links, side)?;
        let rates = dyad.rates(d_rate);
        let accelerations = dyad.accelerations(rates, d_acceleration);
        Some(Self { dyad, rates, accelerations })
    }

    /// The dyad at these angles and their difference, the second link backwards.
    #[inline(always)]
    fn at(
        [_, d_rate, d_acceleration]: [Vector; 3],
        [p, q]: Vector,
        [first, second, difference]: [(f64, f64); 3],
    ) -> Checked<Self> {
        let links = [super::at(first, p), super::at(second, -q)];
        let dyad = Dyad::at::<true>(links, p * q * difference.0, p * q)?;
        let rates = dyad.rates(d_rate);
        let accelerations = dyad.accelerations(rates, d_acceleration);
        Some(Self { dyad, rates, accelerations })
    }

    /// The first link and its derivatives.
    #[inline(always)]
    fn first(&self) -> [Vector; 3] {
        moving(self.dyad.first, self.rates[0], self.accelerations[0])
    }

    /// The second link backwards and its derivatives.
    #[inline(always)]
    fn second(&self) -> [Vector; 3] {
        moving(times(self.dyad.second, -1.0), self.rates[1], self.accelerations[1])
    }
}

#[inline(always)]
fn moving(v: Vector, rate: f64, acceleration: f64) -> [Vector; 3] {
    [v, turned(v, rate), bent(v, rate, acceleration)]
}

#[inline(always)]
fn less([a, b, c]: [Vector; 3], [d, e, f]: [Vector; 3]) -> [Vector; 3] {
    [minus(a, d), minus(b, e), minus(c, f)]
}

#[inline(never)]
pub fn bare(m: &Jansen, theta: f64, rate: f64, acceleration: f64, sides: [f64; 5]) -> State {
    state::<false>(m, theta.sine_cosine(), rate, acceleration, sides).expect("no check")
}

#[inline(never)]
pub fn checked(m: &Jansen, theta: f64, rate: f64, acceleration: f64, sides: [f64; 5]) -> Checked<JansenKinematics> {
    let (sine, cosine) = theta.sine_cosine();
    let State { dyads: [bj, de, ck, fg, ih] } = state::<true>(m, (sine, cosine), rate, acceleration, sides)?;
    let pose = JansenPose {
        theta: direction([cosine, sine], 1.0),
        angle_b: direction(bj.dyad.first, 1.0 / m.b),
        angle_j: direction(bj.dyad.second, -1.0 / m.j),
        angle_d: direction(de.dyad.first, 1.0 / m.d),
        angle_e: direction(de.dyad.second, -1.0 / m.e),
        angle_c: direction(ck.dyad.first, 1.0 / m.c),
        angle_k: direction(ck.dyad.second, -1.0 / m.k),
        angle_f: direction(fg.dyad.first, 1.0 / m.f),
        angle_g: direction(fg.dyad.second, -1.0 / m.g),
        angle_i: direction(ih.dyad.first, 1.0 / m.i),
        angle_h: direction(ih.dyad.second, -1.0 / m.h),
        theta_angle: theta,
        determinant_1: bj.dyad.determinant,
        determinant_2: de.dyad.determinant,
        determinant_3: ck.dyad.determinant,
        determinant_4: fg.dyad.determinant,
        determinant_5: ih.dyad.determinant,
    };
    let dyads = [bj, de, ck, fg, ih];
    Some(JansenKinematics { pose, rates: rates(&dyads, rate), accelerations: accelerations(&dyads, acceleration) })
}

#[inline(always)]
fn state<const CHECKED: bool>(
    m: &Jansen,
    (sine, cosine): (f64, f64),
    rate: f64,
    acceleration: f64,
    sides: [f64; 5],
) -> Checked<State> {
    let crank = times([cosine, sine], m.m);
    let [_, pin_rate, pin_acceleration] = moving(crank, rate, acceleration);
    // From the pivot to the pin.
    let pin = [[crank[0] + m.a, crank[1] + m.l], pin_rate, pin_acceleration];
    let bj = Moving::new::<CHECKED>(pin, [m.b, m.j], sides[0])?;
    let de = Moving::new::<CHECKED>(bj.first(), [m.d, m.e], sides[1])?;
    let ck = Moving::new::<CHECKED>(pin, [m.c, m.k], sides[2])?;
    let fg = Moving::new::<CHECKED>(less(ck.first(), de.first()), [m.f, m.g], sides[3])?;
    let ih = Moving::new::<CHECKED>(fg.second(), [m.i, m.h], sides[4])?;
    let dyads = [bj, de, ck, fg, ih];
    check::<CHECKED>(&dyads)?;
    Some(State { dyads })
}

#[inline(always)]
fn check<const CHECKED: bool>(dyads: &[Moving; 5]) -> Checked<()> {
    let [[a, b], [c, d], [e, f], [g, h], [i, j]] = dyads.each_ref().map(|moving| moving.accelerations);
    finite::<CHECKED, _>([a, b, c, d, e, f, g, h, i, j])
}

#[inline(never)]
pub fn at(m: &Jansen, q: &JansenCoordinates, rate: f64, acceleration: f64) -> Checked<JansenMotion> {
    let [crank, b, j, d, e, c, k, f, g, i, h, bj, de, ck, fg, ih] = f64::sines_cosines([
        q.theta,
        q.angle_b,
        q.angle_j,
        q.angle_d,
        q.angle_e,
        q.angle_c,
        q.angle_k,
        q.angle_f,
        q.angle_g,
        q.angle_i,
        q.angle_h,
        q.angle_b - q.angle_j,
        q.angle_d - q.angle_e,
        q.angle_c - q.angle_k,
        q.angle_f - q.angle_g,
        q.angle_i - q.angle_h,
    ]);
    let pin = moving(super::at(crank, m.m), rate, acceleration);
    let bj = Moving::at(pin, [m.b, m.j], [b, j, bj])?;
    let de = Moving::at(bj.first(), [m.d, m.e], [d, e, de])?;
    let ck = Moving::at(pin, [m.c, m.k], [c, k, ck])?;
    let fg = Moving::at(less(ck.first(), de.first()), [m.f, m.g], [f, g, fg])?;
    let ih = Moving::at(fg.second(), [m.i, m.h], [i, h, ih])?;
    let dyads = [bj, de, ck, fg, ih];
    check::<true>(&dyads)?;
    Some(JansenMotion {
        position: *q,
        rates: rates(&dyads, rate),
        accelerations: accelerations(&dyads, acceleration),
        points: [],
        outputs: [],
    })
}

#[inline(always)]
fn rates([bj, de, ck, fg, ih]: &[Moving; 5], rate: f64) -> JansenRates {
    JansenRates {
        angle_b: bj.rates[0],
        angle_j: bj.rates[1],
        angle_d: de.rates[0],
        angle_e: de.rates[1],
        angle_c: ck.rates[0],
        angle_k: ck.rates[1],
        angle_f: fg.rates[0],
        angle_g: fg.rates[1],
        angle_i: ih.rates[0],
        angle_h: ih.rates[1],
        theta: rate,
    }
}

#[inline(always)]
fn accelerations([bj, de, ck, fg, ih]: &[Moving; 5], acceleration: f64) -> JansenAccelerations {
    JansenAccelerations {
        angle_b: bj.accelerations[0],
        angle_j: bj.accelerations[1],
        angle_d: de.accelerations[0],
        angle_e: de.accelerations[1],
        angle_c: ck.accelerations[0],
        angle_k: ck.accelerations[1],
        angle_f: fg.accelerations[0],
        angle_g: fg.accelerations[1],
        angle_i: ih.accelerations[0],
        angle_h: ih.accelerations[1],
        theta: acceleration,
    }
}
