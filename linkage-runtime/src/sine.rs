//! Sine and cosine of doubles: inlined for one angle, or for several angles by vector instructions.
//!
//! The argument is reduced as in Cody and Waite, *Software Manual for the Elementary Functions* (1980); the error of
//! the reduction enters the polynomials as in fdlibm (Sun Microsystems, 1993). No fused multiply-add is used, so that
//! every target computes the same bits. sin(-x) = -sin x and cos(-x) = cos x to the bit.
//!
//! Largest errors found by `tests/sine.rs`, in ulp:
//!
//! | 2e7 arguments, last row 191 000 | sine | cosine |
//! |---------------------------------|------|--------|
//! | 0 to pi/4, evenly               | 0.77 | 0.76   |
//! | 0 to 10                         | 0.79 | 0.80   |
//! | 0 to 1000                       | 0.81 | 0.81   |
//! | 0 to 1e5                        | 0.83 | 0.80   |
//! | near every multiple of pi/2     | 0.50 | 0.50   |
//!
//! The reduced argument r - t has a relative error below 2^-63 at the doubles next to every multiple of pi/2.

/// The largest |x| that is computed here; the standard library computes the others.
const LIMIT: f64 = 1e5;

/// pi/2 in three parts: the first two of 35 bits, so that k times them is exact for k < 2^18, the third the double
/// nearest to the remainder. Their sum is pi/2 to 2^-130.
const HALF_PI: [f64; 3] = [
    f64::from_bits(0x3ff9_21fb_5444_0000),
    f64::from_bits(0x3d86_8c23_4c4c_0000),
    f64::from_bits(0x3b29_8a2e_0370_7345),
];

/// 3 * 2^51. Added to a double below 2^51, it rounds it to the nearest integer, ties to even, and leaves that integer
/// in the lowest bits.
const SHIFT: f64 = 6_755_399_441_055_744.0;

/// (r - sin r) / r^3 in powers of r^2 for |r| <= pi/4, by the Remez algorithm; the largest relative error of sin r is
/// 2^-57.9.
const SINE: [f64; 6] = [
    0.166_666_666_666_666_3,
    -0.008_333_333_333_321_84,
    0.000_198_412_698_293_585_1,
    -2.755_731_353_849_848_3e-6,
    2.505_073_438_527_633_6e-8,
    -1.589_543_297_362_344_5e-10,
];

/// (1 - r^2/2 - cos r) / r^4 in powers of r^2 for |r| <= pi/4, by the Remez algorithm; the largest error is 2^-63.9.
const COSINE: [f64; 6] = [
    -0.041_666_666_666_666_595,
    0.001_388_888_888_887_334_2,
    -2.480_158_728_900_207_6e-5,
    2.755_731_421_703_596e-7,
    -2.087_570_539_529_030_2e-9,
    1.135_874_918_140_979_8e-11,
];

/// sin x and cos x, for |x| up to `LIMIT`.
#[inline(always)]
pub(crate) fn sin_cos(x: f64) -> Option<(f64, f64)> {
    (x.abs() <= LIMIT).then(|| both(x))
}

/// sin x, for |x| up to `LIMIT`.
#[inline(always)]
pub(crate) fn sin(x: f64) -> Option<f64> {
    (x.abs() <= LIMIT).then(|| one(x, 0))
}

/// cos x, for |x| up to `LIMIT`.
#[inline(always)]
pub(crate) fn cos(x: f64) -> Option<f64> {
    (x.abs() <= LIMIT).then(|| one(x, 1))
}

/// sin x and cos x of several angles, if all are up to `LIMIT`; bit for bit equal to those of each alone.
#[inline(always)]
pub(crate) fn sines_cosines<const N: usize>(angles: &[f64; N]) -> Option<[(f64, f64); N]> {
    angles.iter().fold(true, |within, x| within & (x.abs() <= LIMIT)).then(|| {
        let mut values = [(0.0, 0.0); N];
        let (fours, rest) = angles.as_chunks::<4>();
        let (values_of_fours, values_of_rest) = values.as_chunks_mut::<4>();
        for (&[a, b, c, d], values) in fours.iter().zip(values_of_fours) {
            *values = columns(four(a, b, c, d));
        }
        match (rest, values_of_rest) {
            (&[a], [first]) => *first = both(a),
            (&[a, b], [first, second]) => [*first, *second] = columns(two(a, b)),
            (&[a, b, c], [first, second, third]) => [*first, *second, *third, _] = columns(four(a, b, c, c)),
            _ => {}
        }
        values
    })
}

#[inline(always)]
fn columns<const LANES: usize>([sines, cosines]: [[f64; LANES]; 2]) -> [(f64, f64); LANES] {
    let mut values = [(0.0, 0.0); LANES];
    for (value, pair) in values.iter_mut().zip(sines.into_iter().zip(cosines)) {
        *value = pair;
    }
    values
}

/// Two angles. It is not inlined, so that the loop is vectorised in every caller; the angles are passed in registers.
#[inline(never)]
fn two(a: f64, b: f64) -> [[f64; 2]; 2] {
    lanes([a, b])
}

/// Four angles, as in `two`.
#[inline(never)]
fn four(a: f64, b: f64, c: f64, d: f64) -> [[f64; 4]; 2] {
    lanes([a, b, c, d])
}

#[inline(always)]
fn lanes<const LANES: usize>(angles: [f64; LANES]) -> [[f64; LANES]; 2] {
    let (mut sines, mut cosines) = ([0.0; LANES], [0.0; LANES]);
    for ((sine, cosine), angle) in sines.iter_mut().zip(&mut cosines).zip(angles) {
        (*sine, *cosine) = both(angle);
    }
    [sines, cosines]
}

/// sin x and cos x, |x| <= `LIMIT`.
#[inline(always)]
fn both(x: f64) -> (f64, f64) {
    let Reduced { quadrant, head, tail } = Reduced::new(x);
    let (sine, cosine) = kernel(head, tail);
    // k mod 4: sin, cos; cos, -sin; -sin, -cos; -cos, sin.
    let swap = (quadrant & 1).wrapping_neg() & (sine.to_bits() ^ cosine.to_bits());
    let sine_sign = (quadrant & 2) << 62;
    let cosine_sign = (quadrant.wrapping_add(1) & 2) << 62;
    (f64::from_bits(sine.to_bits() ^ swap ^ sine_sign), f64::from_bits(cosine.to_bits() ^ swap ^ cosine_sign))
}

/// sin(x + n pi/2), |x| <= `LIMIT`; bit for bit equal to `both`, by one of the two polynomials.
#[inline(always)]
fn one(x: f64, n: u64) -> f64 {
    let Reduced { quadrant, head, tail } = Reduced::new(x);
    let quadrant = quadrant.wrapping_add(n);
    let value = if quadrant & 1 == 0 { kernel(head, tail).0 } else { kernel(head, tail).1 };
    f64::from_bits(value.to_bits() ^ (quadrant & 2) << 62)
}

/// x = k pi/2 + head - tail, |head - tail| <= pi/4.
struct Reduced {
    /// k in the lowest bits.
    quadrant: u64,
    head: f64,
    tail: f64,
}

impl Reduced {
    #[inline(always)]
    fn new(x: f64) -> Self {
        let shifted = x * core::f64::consts::FRAC_2_PI + SHIFT;
        let k = shifted - SHIFT;
        // `near` and `far` are exact; the rounding error of `head` is in `tail`. If that is zero it is positive, so
        // that sin x keeps the sign of x = -0.
        let [large, middle, small] = HALF_PI;
        let near = x - k * large;
        let far = k * middle;
        let head = near - far;
        let tail = k * small - ((near - head) - far);
        Self { quadrant: shifted.to_bits(), head, tail }
    }
}

/// sin(r - t) and cos(r - t), where |t| is below an ulp of r or 2^-54.
#[inline(always)]
fn kernel(r: f64, t: f64) -> (f64, f64) {
    let z = r * r;
    let w = z * z;
    let half = 0.5 * z;
    let rest = 1.0 - half;
    // Both polynomials use the same order of operations, so that each pair is one vector instruction.
    let both = |[s, t]: [f64; 2], [c, d]: [f64; 2]| [s + z * t, c + z * d];
    let ([s0, s1, s2, s3, s4, s5], [c0, c1, c2, c3, c4, c5]) = (SINE, COSINE);
    let ([a, d], [b, e], [c, f]) = (both([s0, s1], [c0, c1]), both([s2, s3], [c2, c3]), both([s4, s5], [c4, c5]));
    let v = w * w;
    let polynomials = [a + (w * b + v * c), d + (w * e + v * f)];
    let factors = [r * z, w];
    let corrections = [t * rest, (half - (1.0 - rest)) - r * t];
    let ([sine, cosine], [of_sine, of_cosine], [to_sine, to_cosine]) = (polynomials, factors, corrections);
    (r - (to_sine + of_sine * sine), rest - (to_cosine + of_cosine * cosine))
}
