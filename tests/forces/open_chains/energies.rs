//! The energies of the open chains of the gallery, written by hand for any scalar.

use linkage::{Real, real};
use linkage_gallery::cart_pendulum::CartPendulum;
use linkage_gallery::double_pendulum::DoublePendulum;
use linkage_gallery::three_link_arm::ThreeLinkArm;

/// The masses and lengths of a double pendulum.
#[derive(Clone)]
pub(super) struct Double {
    pub(super) of: DoublePendulum,
    pub(super) m: [f64; 2],
    pub(super) j: [f64; 2],
    pub(super) g: f64,
}

/// Those of an arm with a load at its end.
#[derive(Clone)]
pub(super) struct Arm {
    pub(super) of: ThreeLinkArm,
    pub(super) m: [f64; 3],
    pub(super) j: [f64; 3],
    pub(super) load: f64,
    pub(super) g: f64,
}

/// Those of a pendulum on a cart.
#[derive(Clone)]
pub(super) struct Cart {
    pub(super) of: CartPendulum,
    pub(super) mc: f64,
    pub(super) m: f64,
    pub(super) j: f64,
    pub(super) g: f64,
}

/// A system by its energies: T(q, v) and V(q).
pub(super) trait Energies<const V: usize> {
    fn kinetic<T: Real>(&self, q: [T; V], v: [T; V]) -> T;
    fn potential<T: Real>(&self, q: [T; V]) -> T;
}

impl Energies<2> for Double {
    /// The speed of the lower centre is that of the joint plus that of the centre about the joint; `s2` is along the
    /// rod, `h2` across it.
    fn kinetic<T: Real>(&self, [a, b]: [T; 2], [u, v]: [T; 2]) -> T {
        let [l1, s1, s2, h2] = [self.of.l1, self.of.s1, self.of.s2, self.of.h2].map(real::<T>);
        let ([m1, m2], [j1, j2]) = (self.m.map(real::<T>), self.j.map(real::<T>));
        let (cosine, sine) = ((b - a).cos(), (b - a).sin());
        let upper = (m1 * s1 * s1 + j1 + m2 * l1 * l1) * u * u;
        let lower = (m2 * (s2 * s2 + h2 * h2) + j2) * v * v;
        (upper + lower) * real(0.5) + m2 * l1 * u * v * (s2 * cosine - h2 * sine)
    }

    fn potential<T: Real>(&self, [a, b]: [T; 2]) -> T {
        let [l1, s1, s2, h2] = [self.of.l1, self.of.s1, self.of.s2, self.of.h2].map(real::<T>);
        let ([m1, m2], g) = (self.m.map(real::<T>), real::<T>(self.g));
        (m1 * s1 + m2 * l1) * g * a.sin() + m2 * g * (s2 * b.sin() + h2 * b.cos())
    }
}

impl Energies<3> for Arm {
    /// By the velocities of the joints; the angles are from link to link.
    fn kinetic<T: Real>(&self, [p, q, r]: [T; 3], [u, v, w]: [T; 3]) -> T {
        let [a, b, c] = [self.of.a, self.of.b, self.of.c].map(real::<T>);
        let ([m1, m2, m3], [j1, j2, j3]) = (self.m.map(real::<T>), self.j.map(real::<T>));
        let (load, half) = (real::<T>(self.load), real::<T>(0.5));
        let (second, third) = (p + q, p + q + r);
        let (of_second, of_third) = (u + v, u + v + w);
        let turned = |length: T, angle: T, rate: T| [-length * rate * angle.sin(), length * rate * angle.cos()];
        let plus = |[x, y]: [T; 2], [z, w]: [T; 2]| [x + z, y + w];
        let square = |[x, y]: [T; 2]| x * x + y * y;
        let elbow = turned(a, p, u);
        let wrist = plus(elbow, turned(b, second, of_second));
        let moving = m1 * square(turned(a * half, p, u))
            + m2 * square(plus(elbow, turned(b * half, second, of_second)))
            + m3 * square(plus(wrist, turned(c * half, third, of_third)))
            + load * square(plus(wrist, turned(c, third, of_third)));
        (moving + j1 * u * u + j2 * of_second * of_second + j3 * of_third * of_third) * half
    }

    fn potential<T: Real>(&self, [p, q, r]: [T; 3]) -> T {
        let [a, b, c] = [self.of.a, self.of.b, self.of.c].map(real::<T>);
        let ([m1, m2, m3], load, half) = (self.m.map(real::<T>), real::<T>(self.load), real::<T>(0.5));
        let (second, third) = (p + q, p + q + r);
        let first = a * p.sin() * (m1 * half + m2 + m3 + load);
        let middle = b * second.sin() * (m2 * half + m3 + load);
        (first + middle + c * third.sin() * (m3 * half + load)) * real(self.g)
    }
}

impl Energies<2> for Cart {
    fn kinetic<T: Real>(&self, [_, phi]: [T; 2], [u, v]: [T; 2]) -> T {
        let [l, mc, m, j] = [self.of.l, self.mc, self.m, self.j].map(real::<T>);
        ((mc + m) * u * u + (m * l * l + j) * v * v) * real(0.5) - m * l * u * v * phi.sin()
    }

    fn potential<T: Real>(&self, [_, phi]: [T; 2]) -> T {
        real::<T>(self.m * self.g * self.of.l) * phi.sin()
    }
}
