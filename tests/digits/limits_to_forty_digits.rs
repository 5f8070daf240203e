//! Limits against 48-digit arithmetic: the zero of the radicand, found by Newton's method in dashu's floats. An error
//! is measured in ulp times the condition number: the change of the zero for a relative change of each length, and the
//! zero itself.
//!
//! The cancellation in a closed form costs 5 to 10 such units in random mechanisms, and millions where links are nearly
//! equal, if it is not corrected.
//!
//! ```text
//! LIMITS=20000 cargo test --release --all-features --test digits limits_to_forty_digits -- --nocapture
//! ```

use linkage::limits::Limit;
use linkage::{Elbow, linkage};
use rand::rngs::SmallRng;
use rand::{Rng, SeedableRng};

use linkage_oracle::precise::{Big, Scalar, big, direction};

/// Error bounds, in ulp times condition number.
const EXACT: f64 = 2.0;
const BRACKETED: f64 = 3.0;

linkage! {
    #[derive(Debug, Clone, PartialEq)]
    mechanism FourBar {
        param ground, crank, coupler, rocker;
        input theta;
        unknown alpha, beta;
        loop crank@theta + coupler@alpha + rocker@beta = ground@0;
        derive limits;
    }

    /// A crank that a pair of wheels turns.
    #[derive(Debug, Clone, PartialEq)]
    mechanism Geared {
        param ground, crank, coupler, rocker, ratio;
        input theta;
        unknown wheel, alpha, beta;
        equation wheel = ratio * theta + 0.25;
        loop crank@wheel + coupler@alpha + rocker@beta = ground@0;
        derive limits;
    }

    /// A dyad between a fixed joint and one that a rack moves along x.
    #[derive(Debug, Clone, PartialEq)]
    mechanism Rack {
        param radius, x, y, p, q;
        input theta;
        unknown rack, alpha, beta;
        equation rack = radius * theta;
        loop p@alpha + q@beta = (x + rack, y);
        derive limits;
    }

    /// A rocker driven by a pin on a planet wheel: the triangle depends on two angles.
    #[derive(Debug, Clone, PartialEq)]
    mechanism Planet {
        param ground, carrier, coupler, rocker, pin, ratio;
        input theta;
        unknown planet, alpha, beta;
        equation planet = ratio * theta;
        loop carrier@theta + pin@planet + coupler@alpha + rocker@beta = ground@0;
        derive limits;
    }
}

/// The factors of the radicand: (p + q)^2 - D^2 and D^2 - (p - q)^2.
fn factors([x, y]: [Big; 2], p: &Big, q: &Big) -> [Big; 2] {
    let distance = &x * &x + &y * &y;
    let (sum, difference) = (p + q, p - q);
    [&sum * &sum - &distance, &distance - &difference * &difference]
}

fn four_bar(p: &[Big], theta: &Big) -> [Big; 2] {
    let (c, s) = direction(theta);
    factors([&p[0] - &p[1] * c, -(&p[1] * s)], &p[2], &p[3])
}

fn geared(p: &[Big], theta: &Big) -> [Big; 2] {
    four_bar(p, &(&p[4] * theta + big(0.25)))
}

fn rack(p: &[Big], theta: &Big) -> [Big; 2] {
    factors([&p[1] + &p[0] * theta, p[2].clone()], &p[3], &p[4])
}

fn planet(p: &[Big], theta: &Big) -> [Big; 2] {
    let ((c, s), (e, f)) = (direction(theta), direction(&(&p[5] * theta)));
    factors([&p[0] - &p[1] * c - &p[4] * e, -(&p[1] * s + &p[4] * f)], &p[2], &p[3])
}

/// The factors of the radicand for parameters and an input.
type Factors = fn(&[Big], &Big) -> [Big; 2];

/// The zero of the factor that is nearest to one, and its condition number times its value; none at a double zero.
fn zero(of: Factors, parameters: &[f64], near: f64) -> Option<(Big, f64)> {
    let parameters: Vec<Big> = parameters.iter().map(|&value| big(value)).collect();
    let [low, high] = of(&parameters, &big(near)).map(|factor| factor.double().abs());
    let which = usize::from(high < low);
    let at = |parameters: &[Big], v: &Big| of(parameters, v)[which].clone();
    let small = big(2_f64.powi(-70));
    let slope = |v: &Big| (at(&parameters, &(v + &small)) - at(&parameters, &(v - &small))) / (big(2.0) * &small);
    let mut v = big(near);
    let mut last = f64::INFINITY;
    for _ in 0..40 {
        let step = at(&parameters, &v) / slope(&v);
        v -= &step;
        last = step.double().abs();
    }
    // Near a double zero the two zeros cannot be distinguished.
    let distance = (&v - big(near)).double().abs();
    (last < 1e-30 && distance < 1e-6).then_some(())?;
    let slope = slope(&v).double();
    let by = |place: usize| {
        let mut changed = parameters.clone();
        changed[place] = &parameters[place] * (big(1.0) + &small);
        ((at(&changed, &v) - at(&parameters, &v)) / &small).double().abs()
    };
    let sum: f64 = (0..parameters.len()).map(by).sum();
    Some((v.clone(), sum / slope.abs() + v.double().abs()))
}

/// The largest error of some limits, and where.
#[derive(Default)]
struct Worst {
    count: usize,
    error: f64,
    place: String,
}

impl Worst {
    fn note(&mut self, of: Factors, parameters: &[f64], input: f64) {
        let Some((zero, condition)) = zero(of, parameters, input) else { return };
        self.count += 1;
        let error = (big(input) - zero).double().abs() / (f64::EPSILON * condition);
        if error > self.error {
            (self.error, self.place) = (error, format!("{parameters:?}: {input:?}"));
        }
    }
}

/// Limits of each kind; the environment variable asks for the full number.
fn times() -> usize {
    linkage_trials::count("LIMITS", 100, 400)
}

/// Random mechanisms at random inputs: limits in closed form, at which each can be assembled, and both ends of
/// brackets.
macro_rules! sweep {
    ($M:ident, $Branch:ident, $of:expr, |$length:ident| $parameters:expr) => {{
        let random = &mut SmallRng::seed_from_u64(11);
        let (mut exact, mut bracketed) = (Worst::default(), Worst::default());
        while exact.count + bracketed.count < times() {
            let mut $length = |low: f64, high: f64| random.random_range(low..high);
            let parameters = $parameters;
            let start = random.random_range(-4.0..4.0);
            let m = $M::from(parameters);
            let branch = $Branch { alpha_beta: Elbow::Left };
            let Ok(found) = m.limits(start, branch) else { continue };
            for limit in [found.lower, found.upper] {
                match limit {
                    Limit::Unlimited => {}
                    Limit::Exact { input, .. } => {
                        exact.note($of, &parameters, input);
                        assert!(m.assemble(input, branch).is_ok(), "{m:?}: {limit:?}");
                    }
                    Limit::Bracketed { assembled, unbuildable, .. } => {
                        assert!(m.assemble(assembled, branch).is_ok() && m.assemble(unbuildable, branch).is_err());
                        bracketed.note($of, &parameters, assembled);
                        bracketed.note($of, &parameters, unbuildable);
                    }
                    Limit::JointRange { .. } => panic!("{m:?} has no ranges: {limit:?}"),
                }
            }
        }
        for (kind, Worst { count, error, place }) in [("exact", &exact), ("bracketed", &bracketed)] {
            println!("{} {count} {kind}: {error:.2} ulp x condition, {place}", stringify!($M));
        }
        [exact.error, bracketed.error]
    }};
}

#[test]
fn of_four_bars() {
    let [exact, _] = sweep!(FourBar, FourBarBranch, four_bar, |length| std::array::from_fn(|_| length(0.05, 1.0)));
    assert!(exact <= EXACT, "{exact}");
}

/// Four-bars for which the coefficients of the closed form cancel.
#[test]
fn of_four_bars_with_links_that_are_nearly_equal() {
    let [exact, _] = sweep!(FourBar, FourBarBranch, four_bar, |length| {
        let (ground, coupler) = (length(0.05, 1.0), length(0.05, 1.0));
        let mut nearly = |value: f64| value * (1.0 + length(-1.0, 1.0) * 10_f64.powf(length(-7.0, -1.0)));
        [ground, nearly(ground), coupler, nearly(coupler)]
    });
    assert!(exact <= EXACT, "{exact}");
}

#[test]
fn behind_wheels() {
    let [exact, _] = sweep!(Geared, GearedBranch, geared, |length| {
        [length(0.05, 1.0), length(0.05, 1.0), length(0.05, 1.0), length(0.05, 1.0), length(-5.0, 5.0)]
    });
    assert!(exact <= EXACT, "{exact}");
}

#[test]
fn behind_racks() {
    let [exact, _] = sweep!(Rack, RackBranch, rack, |length| {
        [length(0.05, 1.0), length(-2.0, 2.0), length(-0.5, 0.5), length(0.05, 1.0), length(0.05, 1.0)]
    });
    assert!(exact <= EXACT, "{exact}");
}

/// By search: the ends of a bracket are neighbours and contain the zero, but for links that touch to rounding error.
#[test]
fn of_rockers_on_planet_wheels() {
    let [_, bracketed] = sweep!(Planet, PlanetBranch, planet, |length| {
        let [ground, carrier, coupler, rocker] = std::array::from_fn(|_| length(0.05, 1.0));
        [ground, carrier, coupler, rocker, length(0.05, 0.5), length(-5.0, 5.0)]
    });
    assert!(bracketed > 0.0 && bracketed <= BRACKETED, "{bracketed}");
}
