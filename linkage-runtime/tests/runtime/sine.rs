//! The error of `Real::sine_cosine`, `sine` and `cosine`, against a reference in pairs of doubles.
//!
//! `cargo test --release -p linkage-runtime --test runtime sine -- --ignored --nocapture` measures the errors that the
//! documentation of the module lists.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

use linkage_runtime::Real;
use num_dual::{Dual2_64, Dual64};

use crate::pairs::{float_ulps, random, reference, ulps};

/// A little more than the largest error found, in units of the last place; the proved bound is 0.89.
const ULPS: f64 = 0.85;

/// The largest |x| that is not left to `libm`.
const LIMIT: f64 = 1e5;

/// A little more than the largest error of floats beyond `FLOAT_LIMIT`, of which every one was tried.
const ULPS_BEYOND: f64 = 0.86;

/// The largest |x| of floats that is reduced by multiples of pi/2, the others by bits of 2/pi.
const FLOAT_LIMIT: f32 = 1e4;

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

/// `SAMPLES=20000000 cargo test --release -p linkage-runtime --test runtime sine` takes so many, and every multiple of pi/2.
#[test]
fn within_the_promise() {
    let samples = linkage_trials::count("SAMPLES", 20_000, 20_000);
    sweep(samples, if samples > 20_000 { 1 } else { 7 });
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

/// The largest errors of floats, against the library's doubles.
fn sweep_floats(bits: impl Iterator<Item = u32>) -> [(f32, f32); 2] {
    let mut largest = [(0.0, 0.0); 2];
    for x in bits.map(f32::from_bits) {
        let (sine, cosine) = x.sine_cosine();
        let (s, c) = f64::from(x).sin_cos();
        for ((found, exact), (error, at)) in [(sine, s), (cosine, c)].into_iter().zip(&mut largest) {
            let here = float_ulps(found, exact);
            if here > *error {
                (*error, *at) = (here, x);
            }
        }
        let expected = [sine.to_bits(), cosine.to_bits()];
        let (negative, same) = (-x).sine_cosine();
        assert_eq!([(-negative).to_bits(), same.to_bits()], expected, "{x:e}");
        assert_eq!([x.sine().to_bits(), x.cosine().to_bits()], expected, "{x:e}");
    }
    largest
}

/// The largest error of floats up to one.
fn promised(most: f32) -> f64 {
    if most > FLOAT_LIMIT { ULPS_BEYOND } else { ULPS }
}

/// Floats by their bits, from 0 to `most`.
fn floats(most: f32, stride: usize) -> impl Iterator<Item = u32> {
    (0..=most.to_bits()).step_by(stride)
}

#[test]
fn floats_within_the_promise() {
    for most in [std::f32::consts::FRAC_PI_4, FLOAT_LIMIT, f32::MAX] {
        let largest = sweep_floats(floats(most, 4001));
        println!("to {most}: {largest:?}");
        assert!(largest.iter().all(|(error, _)| f64::from(*error) <= promised(most)), "{most}: {largest:?}");
    }
    // Next to multiples of pi/2.
    let near = (0..6366).map(|k| (f64::from(k) * FRAC_PI_2) as f32);
    let largest = sweep_floats(near.flat_map(|x| [x, x.next_up(), x.next_down().max(0.0)]).map(f32::to_bits));
    println!("about multiples of pi/2: {largest:?}");
    assert!(largest.iter().all(|(error, _)| f64::from(*error) <= ULPS), "{largest:?}");
}

#[test]
#[cfg_attr(debug_assertions, ignore = "every float: four minutes in release")]
fn every_float() {
    let bounds = [0.0, std::f32::consts::FRAC_PI_4, 10.0, FLOAT_LIMIT, f32::MAX];
    for (&least, &most) in bounds.iter().zip(&bounds[1..]) {
        let largest = sweep_floats(f32::to_bits(least)..=most.to_bits());
        println!("{least} to {most}: {largest:?}");
        assert!(largest.iter().all(|(error, _)| f64::from(*error) <= promised(most)), "{largest:?}");
    }
}

#[test]
fn floats_together_and_at_the_limits() {
    let bits = |(sine, cosine): (f32, f32)| [sine.to_bits(), cosine.to_bits()];
    let mut angles: Vec<f32> = random(8).take(400).map(|part| (1e4 * (2.0 * part - 1.0)) as f32).collect();
    angles.extend([0.0, -0.0, 1e-30, FLOAT_LIMIT, -FLOAT_LIMIT]);
    for _ in 0..2 {
        for angles in angles.windows(7) {
            let angles: [f32; 7] = angles.try_into().unwrap();
            assert_eq!(f32::sines_cosines(angles).map(bits), angles.map(|x| bits(x.sine_cosine())), "{angles:?}");
        }
        // One of them beyond the limit.
        angles[200] = 2.0 * FLOAT_LIMIT;
    }
    // On either side of the limit, and far from it.
    for x in [FLOAT_LIMIT, FLOAT_LIMIT.next_up(), 1e9, f32::MAX] {
        let (sine, cosine) = f64::from(x).sin_cos();
        let errors = [float_ulps(x.sine(), sine), float_ulps(x.cosine(), cosine)];
        assert!(errors.iter().all(|error| f64::from(*error) <= promised(x)), "{x:e}: {errors:?}");
    }
    for x in [f32::INFINITY, f32::NEG_INFINITY, f32::NAN] {
        assert!(x.sine_cosine().0.is_nan() && x.sine().is_nan() && x.cosine().is_nan());
    }
    for zero in [0.0f32, -0.0] {
        assert_eq!([zero.sine_cosine().0.to_bits(), zero.sine().to_bits()], [zero.to_bits(); 2]);
    }
    for x in [f32::from_bits(1), f32::MIN_POSITIVE, 1e-20, 1e-5] {
        assert_eq!([x.sine_cosine(), (-x).sine_cosine()], [(x, 1.0), (-x, 1.0)]);
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
        assert_eq!(bits(x.sine_cosine()), bits(libm::sincos(x)));
        assert_eq!(bits((-x).sine_cosine()), bits(libm::sincos(-x)));
        assert_eq!(bits((x.sine(), x.cosine())), bits(libm::sincos(x)));
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
