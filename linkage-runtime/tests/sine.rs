//! The error of `Real::sine_cosine`, `sine` and `cosine`, against a reference in pairs of doubles.
//!
//! `cargo test --release -p linkage-runtime --test sine -- --ignored --nocapture` measures the errors that the
//! documentation of the module lists.

#![cfg(feature = "std")]

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

use linkage_runtime::Real;
use num_dual::{Dual2_64, Dual64};

/// The largest documented error, in units of the last place.
const ULPS: f64 = 0.85;

/// The largest |x| that is not left to the standard library.
const LIMIT: f64 = 1e5;

/// An unevaluated sum, the second below half an ulp of the first.
type Pair = [f64; 2];

/// a + b exactly (Knuth).
fn two_sum(a: f64, b: f64) -> Pair {
    let sum = a + b;
    let part = sum - a;
    [sum, (a - (sum - part)) + (b - part)]
}

/// a b exactly (Dekker, halves by Veltkamp).
fn two_product(a: f64, b: f64) -> Pair {
    let halves = |x: f64| {
        let scaled = 134_217_729.0 * x;
        let high = scaled - (scaled - x);
        [high, x - high]
    };
    let product = a * b;
    let ([a, c], [b, d]) = (halves(a), halves(b));
    [product, c * d - (((product - a * b) - c * b) - a * d)]
}

fn plus([a, low]: Pair, b: f64) -> Pair {
    let [sum, error] = two_sum(a, b);
    two_sum(sum, error + low)
}

fn times([a, c]: Pair, [b, d]: Pair) -> Pair {
    let [product, error] = two_product(a, b);
    two_sum(product, error + (a * d + c * b))
}

fn over([a, c]: Pair, b: f64) -> Pair {
    let quotient = a / b;
    let [product, error] = two_product(quotient, b);
    two_sum(quotient, ((a - product) - error + c) / b)
}

/// The terms of the exponential series from r^n / n!, every other one, with alternating signs: the first omitted one is
/// below 2^-112.
fn series(first: Pair, square: Pair, n: u32) -> Pair {
    let mut terms = vec![first];
    for m in (n..27).step_by(2) {
        let [a, c] = over(times(terms[terms.len() - 1], square), f64::from((m + 1) * (m + 2)));
        terms.push([-a, -c]);
    }
    terms.iter().rev().fold([0.0; 2], |sum, &[a, c]| plus(plus(sum, c), a))
}

/// sin x and cos x for |x| <= 1e5. pi/2 is accurate to 2^-160 and its multiples are exact, so that no rounding error
/// exceeds 2^-140 there, where r is above 2^-61; each of the fourteen terms of the series has a rounding error of
/// 2^-102. The relative error is below 2^-79.
fn reference(x: f64) -> [Pair; 2] {
    let half_pi = [FRAC_PI_2, 6.123_233_995_736_766e-17, -1.497_384_904_859_169_8e-33];
    let k = (x / FRAC_PI_2).round();
    let r = half_pi.iter().flat_map(|&part| two_product(-k, part)).fold([x, 0.0], plus);
    let square = times(r, r);
    let (sine, cosine) = (series(r, square, 1), series([1.0, 0.0], square, 0));
    let minus = |[a, c]: Pair| [-a, -c];
    match k.rem_euclid(4.0) {
        0.0 => [sine, cosine],
        1.0 => [cosine, minus(sine)],
        2.0 => [minus(sine), minus(cosine)],
        _ => [minus(cosine), sine],
    }
}

/// The error in units of the last place of the exact value.
fn ulps(found: f64, [value, rest]: Pair) -> f64 {
    let size = value.abs();
    // Just below a power of two an ulp is half as large.
    let below = size.next_down();
    let place =
        if size.to_bits().trailing_zeros() >= 52 && value * rest < 0.0 { size - below } else { size.next_up() - size };
    ((found - value) - rest).abs() / place
}

/// The largest errors, with the arguments.
#[derive(Default)]
struct Largest([(f64, f64); 2]);

impl Largest {
    fn at(&mut self, x: f64) {
        let (sine, cosine) = x.sine_cosine();
        for ((found, exact), largest) in [sine, cosine].into_iter().zip(reference(x)).zip(&mut self.0) {
            let error = ulps(found, exact);
            assert!(error.is_finite(), "{x:e}: {found:e}");
            if error > largest.0 {
                *largest = (error, x);
            }
        }
        // sin is odd and cos even, alone and together, bit for bit.
        let expected = bits((sine, cosine));
        let (negative, same) = (-x).sine_cosine();
        assert_eq!(bits((-negative, same)), expected, "{x:e}");
        assert_eq!(bits((x.sine(), x.cosine())), expected, "{x:e}");
        assert_eq!(bits((-(-x).sine(), (-x).cosine())), expected, "{x:e}");
    }

    fn check(&self, what: &str) {
        let [(sine, at), (cosine, there)] = self.0;
        println!("{what}: sine {sine:.4} ulp at {at:?}, cosine {cosine:.4} ulp at {there:?}");
        assert!(sine <= ULPS && cosine <= ULPS, "{what}: {sine} and {cosine} ulp");
    }
}

/// Numbers in [0, 1) (Steele, Lea and Flood, SplitMix).
fn random(seed: u64) -> impl Iterator<Item = f64> {
    (1..).map(move |n: u64| {
        let mut bits = seed.wrapping_add(n.wrapping_mul(0x9e37_79b9_7f4a_7c15));
        bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((bits ^ (bits >> 31)) >> 11) as f64 * 2f64.powi(-53)
    })
}

/// Samples evenly over the first eighth of a turn, at random in a few turns and over the whole range, and about every
/// multiple of pi/2 whose number is a multiple of `stride`.
fn sweep(samples: usize, stride: usize) {
    let mut largest = Largest::default();
    for (index, shift) in (0..samples).zip(random(1)) {
        largest.at(FRAC_PI_4 * (index as f64 + shift) / samples as f64);
    }
    largest.check("0 to pi/4");
    for (range, seed) in [(10.0, 2), (1000.0, 3), (LIMIT, 4)] {
        let mut largest = Largest::default();
        random(seed).take(samples).for_each(|part| largest.at(range * part));
        largest.check(&format!("to {range}"));
    }
    let mut largest = Largest::default();
    for k in (0..63662).step_by(stride) {
        let nearest = f64::from(k) * FRAC_PI_2;
        [nearest.next_down(), nearest, nearest.next_up()].into_iter().for_each(|x| largest.at(x));
    }
    // The double nearest of all to a multiple of pi/2, 29 of them, and its doubles: distances 2^-60.5 and so on.
    (0..12).for_each(|power| largest.at(45.553_093_477_052 * 2f64.powi(power)));
    largest.check("about multiples of pi/2");
}

/// Values of forty digits by mpmath, rounded to pairs of doubles.
#[test]
fn reference_is_right() {
    let known = [
        (0.001, [0.0009999998333333417, 5.670638989736153e-21], [0.9999995000000417, -7.831485455398128e-18]),
        (0.5, [0.479425538604203, -5.103969860556013e-18], [0.8775825618903728, -4.2623149864279997e-17]),
        (1.0, [0.8414709848078965, 1.776845092935536e-18], [0.5403023058681398, -4.760954612604417e-17]),
        (-2.0, [-0.9092974268256817, 1.4020906557816256e-17], [-0.4161468365471424, 1.990596398957495e-17]),
        (PI, [1.2246467991473532e-16, -2.99476980971834e-33], [-1.0, 7.498798913309288e-33]),
        (22.0, [-0.008851309290403876, 2.8485303089220057e-19], [-0.9999608263946371, -8.51603380017413e-19]),
        (45.553093477052, [1.0, -1.915685142356643e-37], [-6.189806365883577e-19, 5.558005016244944e-36]),
        (-182.212373908208, [-2.475922546353431e-18, 2.2232020064979776e-35], [1.0, -3.0650962277706286e-36]),
        (355.0, [-3.014435335948845e-05, 1.3012643991046347e-21], [-0.999999999545659, 1.0574612846643521e-17]),
        (10000.0, [-0.30561438888825215, 1.1737169553511932e-17], [-0.9521553682590148, -3.9690952362333257e-17]),
        (
            -91553.86706877741,
            [-0.9999950023464904, -1.3861997470973251e-17],
            [-0.0031615315975970257, -1.0515701202807983e-19],
        ),
        (99999.99999, [0.035758791581686475, 2.5655259402665594e-18], [-0.9993604499001436, -3.068172475080771e-17]),
    ];
    for (x, sine, cosine) in known {
        for (found, [value, rest]) in reference(x).into_iter().zip([sine, cosine]) {
            let error = ((found[0] - value) + (found[1] - rest)).abs();
            assert!(error <= value.abs() * 2f64.powi(-79), "{x}: {found:?}, {value:e} + {rest:e}");
        }
    }
}

/// `SAMPLES=20000000 cargo test --release -p linkage-runtime --test sine` takes so many, and every multiple of pi/2.
#[test]
fn within_the_promise() {
    let samples = std::env::var("SAMPLES").ok().and_then(|samples| samples.parse().ok());
    samples.map_or_else(|| sweep(20_000, 7), |samples| sweep(samples, 1));
}

fn bits((sine, cosine): (f64, f64)) -> [u64; 2] {
    [sine.to_bits(), cosine.to_bits()]
}

/// An angle gives the same bits alone and with others.
#[test]
fn together_as_alone() {
    fn check<const N: usize>(angles: &[f64]) {
        for angles in angles.windows(N) {
            let angles: [f64; N] = angles.try_into().unwrap();
            assert_eq!(f64::sines_cosines(angles).map(bits), angles.map(|x| bits(x.sine_cosine())), "{angles:?}");
        }
    }
    let mut angles: Vec<f64> = random(5).take(500).map(|part| LIMIT * (2.0 * part - 1.0)).collect();
    angles.extend([0.0, -0.0, 1e-300, 45.553_093_477_052, LIMIT]);
    for _ in 0..2 {
        check::<1>(&angles);
        check::<2>(&angles);
        check::<3>(&angles);
        check::<4>(&angles);
        check::<5>(&angles);
        check::<11>(&angles);
        // One of them beyond the limit.
        angles[250] = 2.0 * LIMIT;
    }
}

/// Every other scalar has its own sine and cosine.
#[test]
fn other_scalars() {
    fn check<T: Real>(scalar: impl Fn(f64) -> T) {
        for x in random(6).take(200).chain([2.0]).map(|part| scalar(LIMIT * part)) {
            assert_eq!(x.sine_cosine(), x.sin_cos());
            assert_eq!((x.sine(), x.cosine()), (x.sin(), x.cos()));
            assert_eq!(T::sines_cosines([x, -x]), [x.sin_cos(), (-x).sin_cos()]);
        }
    }
    check(|x| x as f32);
    check(|x| Dual64::new(x, 0.3));
    check(|x| Dual2_64::new(x, 0.3, -0.7));
}

#[test]
fn small() {
    for zero in [0.0f64, -0.0] {
        assert_eq!(zero.sine_cosine().0.to_bits(), zero.to_bits());
        assert_eq!(zero.sine().to_bits(), zero.to_bits());
    }
    for x in [f64::from_bits(1), f64::MIN_POSITIVE / 3.0, f64::MIN_POSITIVE, 1e-300, 1e-160, 1e-20, 7e-9] {
        assert_eq!([x.sine_cosine(), (-x).sine_cosine()], [(x, 1.0), (-x, 1.0)]);
        assert_eq!([x.sine(), (-x).sine(), x.cosine()], [x, -x, 1.0]);
    }
}

#[test]
fn large_and_none() {
    let beyond = [LIMIT.next_up(), 1e9, 2f64.powi(60), 1e300, f64::MAX];
    for x in random(7).take(1000).map(|part| LIMIT * (1.000_001 + part)).chain(beyond) {
        assert_eq!(bits(x.sine_cosine()), bits(x.sin_cos()));
        assert_eq!(bits((-x).sine_cosine()), bits((-x).sin_cos()));
        assert_eq!(bits((x.sine(), x.cosine())), bits(x.sin_cos()));
    }
    for x in [f64::INFINITY, f64::NEG_INFINITY, f64::NAN] {
        let (sine, cosine) = x.sine_cosine();
        assert!(sine.is_nan() && cosine.is_nan());
        assert!(x.sine().is_nan() && x.cosine().is_nan());
    }
    // On either side of the limit the two agree.
    for x in [LIMIT, LIMIT.next_down()] {
        let ((sine, cosine), (s, c)) = (x.sine_cosine(), x.sin_cos());
        assert!((sine - s).abs() <= f64::EPSILON && (cosine - c).abs() <= f64::EPSILON);
    }
}
