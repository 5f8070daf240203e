//! The time of the elementary functions of `Real` compared with those of the standard library, timed alternately. Those after
//! the hypotenuse are `libm`'s.
//!
//! `cargo bench --bench sine`

use std::hint::black_box;
use std::time::Instant;

use linkage_runtime::{Real, lane, real};

/// Angles per pass: these and their sines fit into the first-level cache.
const ANGLES: usize = 1024;

/// The number of passes per reading.
const PASSES: usize = 200;

/// The number of readings of each function; the median counts.
const READINGS: usize = 61;

/// Latency: each angle depends on the previous sine and cosine.
#[inline(always)]
fn chain<T: Real>(angles: &[T], sin_cos: impl Fn(T) -> (T, T)) -> T {
    angles.iter().fold(T::zero(), |sum, &angle| {
        let (sine, cosine) = sin_cos(angle + sum);
        sine + cosine
    })
}

/// Throughput: independent angles.
#[inline(always)]
fn independent<T: Real>(angles: &[T], sines: &mut [T], cosines: &mut [T], sin_cos: impl Fn(T) -> (T, T)) {
    for ((&angle, s), c) in angles.iter().zip(sines).zip(cosines) {
        (*s, *c) = sin_cos(angle);
    }
}

/// N angles in one call, as emitted code does for a position.
#[inline(always)]
fn groups<T: Real, const N: usize>(
    angles: &[T],
    sines: &mut [T],
    cosines: &mut [T],
    all: impl Fn([T; N]) -> [(T, T); N],
) {
    let chunks = angles.chunks_exact(N).zip(sines.chunks_exact_mut(N)).zip(cosines.chunks_exact_mut(N));
    for ((angles, s), c) in chunks {
        let values = all(std::array::from_fn(|i| angles[i]));
        for i in 0..N {
            (s[i], c[i]) = values[i];
        }
    }
}

/// The nanoseconds per angle.
fn time(mut pass: impl FnMut()) -> f64 {
    let start = Instant::now();
    (0..PASSES).for_each(|_| pass());
    start.elapsed().as_secs_f64() * 1e9 / (PASSES * ANGLES) as f64
}

fn median(mut readings: Vec<f64>) -> f64 {
    readings.sort_unstable_by(f64::total_cmp);
    readings[readings.len() / 2]
}

fn row(name: &str, mut ours: impl FnMut(), mut library: impl FnMut()) {
    let (left, right): (Vec<_>, Vec<_>) = (0..READINGS).map(|_| (time(&mut ours), time(&mut library))).unzip();
    let ratios = left.iter().zip(&right).map(|(ours, library)| library / ours).collect();
    println!("{name:32}{:9.2}{:9.2}{:9.2}", median(left), median(right), median(ratios));
}

fn angles<T: Real>(range: f64) -> Vec<T> {
    // The fractional parts of multiples of the golden ratio.
    let part = |i: usize| (i as f64 * 0.618_033_988_749_894_9).fract() * 2.0 - 1.0;
    (0..ANGLES).map(|i| real(range * part(i))).collect()
}

fn rows<T: Real>(name: &str, range: f64) {
    let angles = angles::<T>(range);
    let (mut s, mut c) = (vec![T::zero(); ANGLES], vec![T::zero(); ANGLES]);
    let (mut p, mut q) = (s.clone(), c.clone());
    row(
        &format!("{name}, to {range}: chain"),
        || {
            black_box(chain(black_box(&angles), T::sine_cosine));
        },
        || {
            black_box(chain(black_box(&angles), T::sin_cos));
        },
    );
    row(
        &format!("{name}, to {range}: independent"),
        || independent(black_box(&angles), black_box(&mut s), black_box(&mut c), T::sine_cosine),
        || independent(black_box(&angles), black_box(&mut p), black_box(&mut q), T::sin_cos),
    );
}

/// Latency and throughput of a function of two numbers.
fn pair_rows<T: Real>(name: &str, ours: impl Fn(T, T) -> T, library: impl Fn(T, T) -> T) {
    let (a, mut b) = (angles::<T>(7.0), angles::<T>(4.3));
    b.reverse();
    let mut values = vec![T::zero(); ANGLES];
    let mut others = values.clone();
    row(
        &format!("{name}: chain"),
        || {
            black_box(pair_chain(black_box(&a), black_box(&b), &ours));
        },
        || {
            black_box(pair_chain(black_box(&a), black_box(&b), &library));
        },
    );
    row(
        &format!("{name}: independent"),
        || pairs(black_box(&a), black_box(&b), black_box(&mut values), &ours),
        || pairs(black_box(&a), black_box(&b), black_box(&mut others), &library),
    );
}

#[inline(always)]
fn pair_chain<T: Real>(a: &[T], b: &[T], of: impl Fn(T, T) -> T) -> T {
    a.iter().zip(b).fold(T::zero(), |last, (&a, &b)| of(a + last, b))
}

#[inline(always)]
fn pairs<T: Real>(a: &[T], b: &[T], values: &mut [T], of: impl Fn(T, T) -> T) {
    for ((&a, &b), value) in a.iter().zip(b).zip(values) {
        *value = of(a, b);
    }
}

/// Latency and throughput of a function of one number, between `least` and `most`; a chain adds `small` times the last value.
fn single_rows(name: &str, [least, most, small]: [f64; 3], ours: impl Fn(f64) -> f64, library: impl Fn(f64) -> f64) {
    let arguments: Vec<f64> = angles::<f64>(0.5).iter().map(|part| least + (most - least) * (part + 0.5)).collect();
    let mut values = vec![0.0; ANGLES];
    let mut others = values.clone();
    row(
        &format!("{name}: chain"),
        || {
            black_box(single_chain(black_box(&arguments), small, &ours));
        },
        || {
            black_box(single_chain(black_box(&arguments), small, &library));
        },
    );
    row(
        &format!("{name}: independent"),
        || singles(black_box(&arguments), black_box(&mut values), &ours),
        || singles(black_box(&arguments), black_box(&mut others), &library),
    );
}

#[inline(always)]
fn single_chain(arguments: &[f64], small: f64, of: impl Fn(f64) -> f64) -> f64 {
    arguments.iter().fold(0.0, |last, &x| of(x + small * last))
}

#[inline(always)]
fn singles(arguments: &[f64], values: &mut [f64], of: impl Fn(f64) -> f64) {
    for (&x, value) in arguments.iter().zip(values) {
        *value = of(x);
    }
}

fn group_row<const N: usize>(range: f64) {
    let angles = angles::<f64>(range);
    let (mut s, mut c) = (vec![0.0; ANGLES], vec![0.0; ANGLES]);
    let (mut p, mut q) = (s.clone(), c.clone());
    row(
        &format!("f64, to {range}: {N} together"),
        || groups::<f64, N>(black_box(&angles), black_box(&mut s), black_box(&mut c), Real::sines_cosines),
        || groups::<f64, N>(black_box(&angles), black_box(&mut p), black_box(&mut q), |x| x.map(f64::sin_cos)),
    );
}

fn main() {
    println!("ns per angle{:20}{:>9}{:>9}{:>9}", "", "inlined", "library", "ratio");
    for range in [0.7, 7.0, 1000.0, 1e5, 1e6] {
        rows::<f64>("f64", range);
    }
    group_row::<2>(7.0);
    group_row::<3>(7.0);
    group_row::<4>(7.0);
    group_row::<8>(7.0);
    rows::<f32>("f32", 7.0);
    pair_rows::<f64>("f64, atan2", Real::arctangent2, f64::atan2);
    pair_rows::<f64>("f64, atan2, unchecked", lane::arctangent2, f64::atan2);
    pair_rows::<f32>("f32, atan2", Real::arctangent2, f32::atan2);
    pair_rows::<f32>("f32, atan2, unchecked", lane::arctangent2, f32::atan2);
    // Its last result would grow in a chain.
    let halved = |x: f64, y: f64| 0.5 * x.hypotenuse(y);
    pair_rows::<f64>("f64, hypot", halved, |x, y| 0.5 * x.hypot(y));
    let halved = |x: f32, y: f32| 0.5 * x.hypotenuse(y);
    pair_rows::<f32>("f32, hypot", halved, |x, y| 0.5 * x.hypot(y));
    single_rows("f64, tan", [-7.0, 7.0, 1e-9], Real::tangent, f64::tan);
    single_rows("f64, asin", [-0.99, 0.99, 1e-9], Real::arcsine, f64::asin);
    single_rows("f64, acos", [-0.99, 0.99, 1e-9], Real::arccosine, f64::acos);
    single_rows("f64, atan", [-7.0, 7.0, 1e-9], Real::arctangent, f64::atan);
    single_rows("f64, exp", [-7.0, 7.0, 1e-9], Real::exponential, f64::exp);
    single_rows("f64, ln", [0.1, 100.0, 1e-9], Real::logarithm, f64::ln);
    // As in the control of steps.
    let power = |x: f64| (0.17 * x.logarithm()).exponential();
    single_rows("f64, power", [1e-4, 1.0, 1e-9], power, |x| x.powf(0.17));
}
