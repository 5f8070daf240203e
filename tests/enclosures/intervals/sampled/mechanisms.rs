//! Mechanisms with angles, kinks, poles, edges of domains and wheels.

use linkage::linkage;
use rand::Rng;
use rand::rngs::SmallRng;

linkage! {
    /// Outputs of a four-bar that jump, and one with a kink.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism Crank {
        param a, b, c, d, x, y;
        input t;
        unknown p, q;
        loop a@t + b@p = d@0 + c@q;
        output direction = angle(a@t + (x, y)@p);
        output slope = tan(q);
        output level = angle(b@p);
        output gap = abs(cross(a@t, 1@p) - x);
        derive intervals;
    }
}

linkage! {
    /// An equation that jumps where a point passes the negative x axis.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism Pointer {
        param r, w, h;
        input t;
        unknown x;
        let P = (-w, h) + r@t;
        equation x = 2 * angle(P);
        output far = norm(P);
        derive intervals;
    }
}

linkage! {
    /// A slider-crank with wheels of constant ratios.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism Shaft {
        param r, l, e;
        input t;
        unknown p, s, cam, half;
        loop r@t + l@p = (s, e);
        equation cam = 2 * t;
        equation half = cam / 4 - t;
        point Mark = 1@cam + r@half;
        output direction = angle(r@half + (e, 0)@cam);
        derive intervals;
    }
}

linkage! {
    /// A geared five-bar: its second crank turns back at half of the speed.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism FiveBar {
        param a, b, c, d, e;
        input t;
        unknown g, p, q;
        equation g = -t / 2;
        loop a@t + b@p = d@0 + e@g + c@q;
        output at = angle(a@t + b@p - (d, 0));
        output across = abs(cross(1@p, 1@q));
        derive intervals;
    }
}

linkage! {
    /// Wheels by their teeth.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism Train {
        param z1, z2, r;
        input t;
        unknown arm, planet;
        equation z1 * t + z2 * arm = 0;
        equation (z1 + z2) * arm = z1 * t + z2 * planet;
        point Mark = 1@t + r@arm + 1@planet;
        output direction = angle(r@arm + 1@planet);
        derive intervals;
    }
}

linkage! {
    /// A slider-crank with distances that may become zero.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism Near {
        param r, l, u, v;
        input t;
        unknown p, s;
        loop r@t + l@p = s@0;
        output distance = norm(r@t - (u, v));
        output gap = abs(s - u);
        output root = sqrt((s - v)^2);
        derive intervals;
    }
}

linkage! {
    /// A follower that is lifted by a modulus, and a link from it.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism Lifter {
        param a, k, l, h;
        input t;
        unknown s, p, w;
        equation s = abs(a * cos(t) - k);
        loop s@0 + l@p = (w, h);
        output side = angle((s - k, w - h));
        derive intervals;
    }
}

linkage! {
    /// A wheel by the direction of a coupler point.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism Follower {
        param a, b, c, d, x, y;
        input t;
        unknown p, q, u, w;
        loop a@t + b@p = d@0 + c@q;
        equation u = angle(a@t + (x, y)@p);
        equation w = 3 * u - t;
        point Mark = 1@u + 1@w;
        derive intervals;
    }
}

linkage! {
    /// A distance in an equation.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism Rope {
        param a, x, y;
        input t;
        unknown s;
        equation s = hypot(a * cos(t) - x, a * sin(t) - y);
        output other = hypot(s - x, y * sin(t));
        derive intervals;
    }
}

linkage! {
    /// The angle of a universal joint's kind: at k = 1 it has kinks, beyond its domain ends.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism Tilt {
        param k, r;
        input t;
        unknown p, q;
        equation p = asin(k * sin(t));
        equation q = acos(k * cos(t)) - p;
        point Mark = r@p + r@q;
        output far = sqrt(1 - k^2 * sin(t)^2);
        derive intervals;
    }
}

linkage! {
    /// A half chord in an equation: at l = r it has kinks.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism Chord {
        param l, r, e;
        input t;
        unknown s;
        equation s = r * cos(t) + sqrt(l^2 - r^2 * sin(t)^2);
        output angle = atan2(r * sin(t), s - e);
        derive intervals;
    }
}

linkage! {
    /// A swinging block: its slider passes the pivot if a = d.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism Block {
        param a, d, f;
        input t;
        unknown s, q;
        loop a@t = d@0 + s@q;
        output direction = angle(a@t - (d, 0));
        output inverse = 1 / (s - f);
        derive intervals;
    }
}

linkage! {
    /// A logarithm and a tangent of half the angle: poles.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism Poles {
        param k, w;
        input t;
        unknown s, u;
        equation s = ln(1 + k * cos(t));
        equation u = exp(-w * s) + atan(w * tan(t / 2));
        output height = w / (1 - k * sin(t));
        derive intervals;
    }
}

/// A length from 0.5 to 5, a multiple of a half if `round`.
fn length(random: &mut SmallRng, round: bool) -> f64 {
    if round { 0.5 * f64::from(random.random_range(1..11)) } else { random.random_range(0.5..5.0) }
}

/// Parameters of a mechanism: lengths, and differences of them of either sign.
pub fn lengths<const P: usize>(random: &mut SmallRng, signed: [bool; P]) -> [f64; P] {
    let round = random.random_bool(0.5);
    signed.map(|signed| {
        let first = length(random, round);
        if signed { first - length(random, round) } else { first }
    })
}

/// Numbers of teeth.
pub fn teeth<const P: usize>(random: &mut SmallRng) -> [f64; P] {
    std::array::from_fn(|_| f64::from(random.random_range(1..7)))
}

/// A factor near or at 1, and lengths.
pub fn factor<const P: usize>(random: &mut SmallRng) -> [f64; P] {
    let mut all = lengths(random, [false; P]);
    all[0] = [1.0, 0.5, random.random_range(0.1..1.0), random.random_range(0.99..1.01)][random.random_range(0..4)];
    all
}

/// A length that is often another.
pub fn equal<const P: usize>(random: &mut SmallRng) -> [f64; P] {
    let mut all = lengths(random, [false; P]);
    if random.random_bool(0.3) {
        all[0] = all[1];
    } else if random.random_bool(0.5) {
        all[0] = all[1] * random.random_range(1.0..1.02);
    }
    all
}
