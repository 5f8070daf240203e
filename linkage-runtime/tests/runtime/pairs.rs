//! Arithmetic with pairs of doubles, and a reference for elementary functions.

use std::f64::consts::FRAC_PI_2;

/// An unevaluated sum, the second below half an ulp of the first.
pub type Pair = [f64; 2];

/// a + b exactly (Knuth).
pub fn two_sum(a: f64, b: f64) -> Pair {
    let sum = a + b;
    let part = sum - a;
    [sum, (a - (sum - part)) + (b - part)]
}

/// a b exactly (Dekker, halves by Veltkamp).
pub fn two_product(a: f64, b: f64) -> Pair {
    let halves = |x: f64| {
        let scaled = 134_217_729.0 * x;
        let high = scaled - (scaled - x);
        [high, x - high]
    };
    let product = a * b;
    let ([a, c], [b, d]) = (halves(a), halves(b));
    [product, c * d - (((product - a * b) - c * b) - a * d)]
}

pub fn plus([a, low]: Pair, b: f64) -> Pair {
    let [sum, error] = two_sum(a, b);
    two_sum(sum, error + low)
}

pub fn times([a, c]: Pair, [b, d]: Pair) -> Pair {
    let [product, error] = two_product(a, b);
    two_sum(product, error + (a * d + c * b))
}

pub fn over([a, c]: Pair, b: f64) -> Pair {
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
pub fn reference(x: f64) -> [Pair; 2] {
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
pub fn ulps(found: f64, [value, rest]: Pair) -> f64 {
    let size = value.abs();
    // Just below a power of two an ulp is half as large.
    let below = size.next_down();
    let place =
        if size.to_bits().trailing_zeros() >= 52 && value * rest < 0.0 { size - below } else { size.next_up() - size };
    ((found - value) - rest).abs() / place
}

/// The error of a float in units of the last place of the exact value.
pub fn float_ulps(found: f32, exact: f64) -> f32 {
    // A double has 29 digits more; its exponent is that of the float, but for subnormal floats.
    let exponent = i32::try_from(exact.to_bits() >> 52 & 0x7ff).unwrap_or_default() - 1023;
    let place = 2f64.powi(exponent.max(-126) - 23);
    ((f64::from(found) - exact).abs() / place) as f32
}

/// Numbers in [0, 1) (Steele, Lea and Flood, SplitMix).
pub fn random(seed: u64) -> impl Iterator<Item = f64> {
    (1..).map(move |n: u64| {
        let mut bits = seed.wrapping_add(n.wrapping_mul(0x9e37_79b9_7f4a_7c15));
        bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((bits ^ (bits >> 31)) >> 11) as f64 * 2f64.powi(-53)
    })
}
