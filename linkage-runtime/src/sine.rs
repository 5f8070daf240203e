//! Sine and cosine of `f64` and `f32`: inlined for one angle, or for several angles by vector instructions.
//!
//! The argument is reduced as in Cody and Waite, *Software Manual for the Elementary Functions* (1980); the error of
//! the reduction enters the polynomials as in fdlibm (Sun Microsystems, 1993). No fused multiply-add is used, so that
//! every target computes the same bits. sin(-x) = -sin x and cos(-x) = cos x to the bit.
//!
//! Largest errors found by `tests/sine.rs`, in ulp:
//!
//! | `f64`, 2e7 arguments, last row 191 000 | sine | cosine |
//! |----------------------------------------|------|--------|
//! | 0 to pi/4, evenly                      | 0.77 | 0.76   |
//! | 0 to 10                                | 0.79 | 0.80   |
//! | 0 to 1000                              | 0.81 | 0.81   |
//! | 0 to 1e5                               | 0.83 | 0.80   |
//! | near every multiple of pi/2            | 0.50 | 0.50   |
//!
//! The reduced argument r - t has a relative error below 2^-60, and below 2^-63 at the doubles next to every multiple of
//! pi/2.
//!
//! No `f64` up to 1e5 has a larger error than 0.89 ulp, or 1.29 2^-53 of the exact value (0.84 ulp and 1.21 2^-53 for the
//! cosine). `linkage-interval/tests/enclosures/kernels` proves that from the rounding to nearest of + - and *:
//!
//! - The error of the reduction is at most k 2^-130, since pi/2 is that accurate, plus the rounding errors of k times its
//!   third part and of `tail`; all else is exact. The quotient with the angle is computed for each k, in integers, at the
//!   doubles next to k pi/2.
//! - The error of each polynomial is the difference of its coefficients from those of the power series, which is bounded
//!   in 200 bits on 96 parts of the range.
//! - `sine_kernel` is run over intervals that cover r, in an arithmetic that bounds each rounding error by half an ulp of
//!   the largest value, and adds what each contributes to the result. So an error that cancels, like that of `rest`,
//!   counts once.
//! - To that is added what the kernel leaves out: t r^4/24 and t^2/2 for the sine, t r^3/6 and t^2/2 for the cosine.
//!
//! Beyond 1e5 the functions are those of `libm` on every target, of which nothing is proved. For `f32` every argument was
//! tried, against doubles. Beyond 1e4 it is reduced in integers: a library's sine of a float computes in doubles, which a
//! small processor has no instructions for.
//!
//! | `f32`, every argument | sine | cosine |
//! |-----------------------|------|--------|
//! | 0 to pi/4             | 0.78 | 0.76   |
//! | pi/4 to 10            | 0.80 | 0.85   |
//! | 10 to 1e4             | 0.84 | 0.83   |
//! | beyond 1e4            | 0.84 | 0.86   |

use num_traits::{One, WrappingAdd, WrappingNeg, Zero};

use crate::native::{Arithmetic, Native};

/// An upper bound of the relative error of sine and cosine of an `f64` up to `LIMIT`, in 2^-53: 1.283 is proved as the
/// module says. Beyond the limit they are `libm`'s, which have no bound here.
pub const SINE_ERROR: f64 = 1.29;

/// pi/2 of `f64` in three parts: the first two of 35 bits, so that k times them is exact for k < 2^18, the third the
/// double nearest to the remainder. Their sum is pi/2 to 2^-130.
pub const HALF_PI: [f64; 3] = [
    f64::from_bits(0x3ff9_21fb_5444_0000),
    f64::from_bits(0x3d86_8c23_4c4c_0000),
    f64::from_bits(0x3b29_8a2e_0370_7345),
];

/// The polynomials of `f64` for |r| <= pi/4, by the Remez algorithm. The largest relative error of sin r is 2^-57.9, the
/// largest error of cos r is 2^-63.9.
pub const SINE_COEFFICIENTS: [[f64; 6]; 2] = [
    [
        0.166_666_666_666_666_3,
        -0.008_333_333_333_321_84,
        0.000_198_412_698_293_585_1,
        -2.755_731_353_849_848_3e-6,
        2.505_073_438_527_633_6e-8,
        -1.589_543_297_362_344_5e-10,
    ],
    [
        -0.041_666_666_666_666_595,
        0.001_388_888_888_887_334_2,
        -2.480_158_728_900_207_6e-5,
        2.755_731_421_703_596e-7,
        -2.087_570_539_529_030_2e-9,
        1.135_874_918_140_979_8e-11,
    ],
];

/// A scalar with a sine and cosine of this module.
pub(crate) trait Angle: Native {
    /// The largest |x| that is reduced by subtraction.
    const LIMIT: Self;

    const HALF: Self;

    /// The number of bits to the left of the lowest two.
    const ABOVE_QUADRANT: usize;

    fn reduced(self) -> Reduced<Self>;

    /// The sine and cosine beyond `LIMIT`.
    fn beyond(self) -> (Self, Self);

    /// (r - sin r) / r^3 and (1 - r^2/2 - cos r) / r^4, where `z` is r^2 and `w` is r^4. Both use the same order of
    /// operations, so that each pair is one vector instruction.
    fn polynomials(z: Self, w: Self) -> [Self; 2];
}

/// x = k pi/2 + head - tail, |head - tail| <= pi/4.
pub(crate) struct Reduced<F: Native> {
    /// k in the lowest bits.
    quadrant: F::Bits,
    head: F,
    tail: F,
}

impl Angle for f64 {
    const LIMIT: Self = 1e5;
    const HALF: Self = 0.5;
    const ABOVE_QUADRANT: usize = 62;

    #[inline(always)]
    fn reduced(self) -> Reduced<Self> {
        /// 3 * 2^51. Added to a double below 2^51, it rounds it to the nearest integer, ties to even, and leaves that
        /// integer in the lowest bits.
        const SHIFT: f64 = 6_755_399_441_055_744.0;
        let shifted = self * core::f64::consts::FRAC_2_PI + SHIFT;
        let k = shifted - SHIFT;
        // `near` and `far` are exact; the rounding error of `head` is in `tail`. If that is zero it is positive, so
        // that sin x keeps the sign of x = -0.
        let [large, middle, small] = HALF_PI;
        let near = self - k * large;
        let far = k * middle;
        let head = near - far;
        let tail = k * small - ((near - head) - far);
        Reduced { quadrant: shifted.to_bits(), head, tail }
    }

    #[inline(always)]
    fn beyond(self) -> (Self, Self) {
        libm::sincos(self)
    }

    #[inline(always)]
    fn polynomials(z: Self, w: Self) -> [Self; 2] {
        sine_polynomials(z, w, SINE_COEFFICIENTS)
    }
}

impl Angle for f32 {
    const LIMIT: Self = 1e4;
    const HALF: Self = 0.5;
    const ABOVE_QUADRANT: usize = 30;

    #[inline(always)]
    fn reduced(self) -> Reduced<Self> {
        /// pi/2 in five parts: the first four of 11 bits, so that k times them is exact for k < 2^13, the fifth the
        /// float nearest to the remainder. Their sum is pi/2 to 2^-78.
        const HALF_PI: [f32; 5] = [
            f32::from_bits(0x3fc9_0000),
            f32::from_bits(0x39fd_a000),
            f32::from_bits(0x33a2_2000),
            f32::from_bits(0x2c34_6000),
            f32::from_bits(0x248d_3132),
        ];
        /// 3 * 2^22, as for doubles.
        const SHIFT: f32 = 12_582_912.0;
        let shifted = self * core::f32::consts::FRAC_2_PI + SHIFT;
        let k = shifted - SHIFT;
        // As for doubles; every difference but those of `middle` and `head` is exact.
        let [first, second, third, fourth, fifth] = HALF_PI;
        let near = (self - k * first) - k * second;
        let (far, farther) = (k * third, k * fourth);
        let middle = near - far;
        let head = middle - farther;
        let tail = k * fifth - (((near - middle) - far) + ((middle - head) - farther));
        Reduced { quadrant: shifted.to_bits(), head, tail }
    }

    #[inline(always)]
    fn beyond(self) -> (Self, Self) {
        if self.is_finite() { turned(reduced_beyond(self)) } else { (Self::NAN, Self::NAN) }
    }

    #[inline(always)]
    fn polynomials(z: Self, w: Self) -> [Self; 2] {
        /// For |r| <= pi/4, by the Remez algorithm; the largest relative error of sin r is 2^-28.0.
        const SINE: [f32; 3] = [0.166_666_55, -0.008_332_191, 0.000_195_185_99];
        /// For |r| <= pi/4, by the Remez algorithm; the largest error of cos r is 2^-30.9.
        const COSINE: [f32; 3] = [-0.041_666_646, 0.001_388_736_4, -2.443_809_2e-5];
        let ([s0, s1, s2], [c0, c1, c2]) = (SINE, COSINE);
        [(s0 + z * s1) + w * s2, (c0 + z * c1) + w * c2]
    }
}

/// The reduction of a float from 2^13 on, in integers, with as many bits of 2/pi as its exponent asks for: M. H. Payne and
/// R. N. Hanek, "Radian reduction for trigonometric functions", SIGNUM Newsletter 18, 1983.
///
/// Let |x| = m 2^e. Bits of 2/pi whose product with |x| is a multiple of four quarters of a turn are left out, and those
/// behind the next 96: the error is below m 2^-94, or 2^-70 quarters. No float is nearer than 2^-30 to a multiple of pi/2.
fn reduced_beyond(x: f32) -> Reduced<f32> {
    /// 32 zeros and the first 224 bits of 2/pi behind the point.
    const TWO_OVER_PI: [u32; 8] =
        [0, 0xa2f9_836e, 0x4e44_1529, 0xfc27_57d1, 0xf534_ddc0, 0xdb62_9599, 0x3c43_9041, 0xfe51_63ab];
    /// pi/2 in 2^-63.
    const HALF_PI: u64 = 0xc90f_daa2_2168_c235;
    let halves = |number: u64| [number >> 32, number & 0xffff_ffff];
    let bits = x.to_bits();
    let mantissa = u64::from(bits & 0x007f_ffff | 0x0080_0000);
    // 32 + e - 2, where e is at least -10.
    let start = (bits >> 23 & 0xff).saturating_sub(120);
    let mut words = TWO_OVER_PI.windows(2).skip((start / 32) as usize).map(|words| {
        let both = words.iter().fold(0, |both, word| both << 32 | u64::from(*word));
        mantissa * (both >> (32 - start % 32) & 0xffff_ffff)
    });
    let [first, second, third] = [(); 3].map(|()| words.next().unwrap_or_default());
    // Quarters in 2^-62: the two bits above are their number.
    let quarters = (first << 32).wrapping_add(second).wrapping_add(third >> 32);
    let quadrant = quarters.wrapping_add(1 << 61) >> 62;
    let rest = (quarters << 2).cast_signed() >> 2;
    // The product with pi/2, in 2^-(61 + zeros): 24 bits of it are exact in a float, and the rest is a float, too.
    let zeros = rest.unsigned_abs().leading_zeros();
    let ([a, b], [c, d]) = (halves(rest.unsigned_abs() << (zeros & 63)), halves(HALF_PI));
    let angle = a * c + ((a * d) >> 32) + ((b * c) >> 32);
    let power = |exponent: u32| f32::from_bits(exponent.wrapping_sub(zeros) << 23);
    let nearest = (angle + (1 << 39)) >> 40;
    let above = (nearest << 40).wrapping_sub(angle).cast_signed();
    let head = nearest as u32 as f32 * power(127 - 21);
    let tail = (above >> 9) as i32 as f32 * power(127 - 52);
    let (head, tail) = if rest.is_negative() == x.is_sign_negative() { (head, tail) } else { (-head, -tail) };
    let quadrant = quadrant as u32;
    Reduced { quadrant: if x.is_sign_negative() { quadrant.wrapping_neg() } else { quadrant }, head, tail }
}

/// True for |x| up to `LIMIT`.
#[inline(always)]
pub(crate) fn is_moderate<F: Angle>(x: F) -> bool {
    x.magnitude() <= F::LIMIT
}

/// sin x and cos x of several angles up to `LIMIT`; bit for bit equal to those of each alone.
#[inline(always)]
pub(crate) fn several<F: Angle, const N: usize>(angles: [F; N]) -> [(F, F); N] {
    let mut values = [(F::ZERO, F::ZERO); N];
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
}

#[inline(always)]
fn columns<F: Angle, const LANES: usize>([sines, cosines]: [[F; LANES]; 2]) -> [(F, F); LANES] {
    let mut values = [(F::ZERO, F::ZERO); LANES];
    for (value, pair) in values.iter_mut().zip(sines.into_iter().zip(cosines)) {
        *value = pair;
    }
    values
}

/// Two angles. It is not inlined, so that the loop is vectorised in every caller; the angles are passed in registers.
#[inline(never)]
fn two<F: Angle>(a: F, b: F) -> [[F; 2]; 2] {
    lanes([a, b])
}

/// Four angles, as in `two`.
#[inline(never)]
fn four<F: Angle>(a: F, b: F, c: F, d: F) -> [[F; 4]; 2] {
    lanes([a, b, c, d])
}

#[inline(always)]
fn lanes<F: Angle, const LANES: usize>(angles: [F; LANES]) -> [[F; LANES]; 2] {
    let (mut sines, mut cosines) = ([F::ZERO; LANES], [F::ZERO; LANES]);
    for ((sine, cosine), angle) in sines.iter_mut().zip(&mut cosines).zip(angles) {
        (*sine, *cosine) = both(angle);
    }
    [sines, cosines]
}

/// sin x and cos x, |x| <= `LIMIT`.
#[inline(always)]
pub(crate) fn both<F: Angle>(x: F) -> (F, F) {
    turned(x.reduced())
}

/// sin x and cos x beyond `LIMIT`.
#[inline(always)]
pub(crate) fn beyond<F: Angle>(x: F) -> (F, F) {
    x.beyond()
}

#[inline(always)]
fn turned<F: Angle>(Reduced { quadrant, head, tail }: Reduced<F>) -> (F, F) {
    let (sine, cosine) = kernel(head, tail);
    // k mod 4: sin, cos; cos, -sin; -sin, -cos; -cos, sin.
    let one = F::Bits::one();
    let swap = (quadrant & one).wrapping_neg() & (sine.bits() ^ cosine.bits());
    let sign = |quadrant: F::Bits| (quadrant & (one + one)) << F::ABOVE_QUADRANT;
    (
        F::of_bits(sine.bits() ^ swap ^ sign(quadrant)),
        F::of_bits(cosine.bits() ^ swap ^ sign(quadrant.wrapping_add(&one))),
    )
}

/// sin x, |x| <= `LIMIT`; bit for bit equal to `both`, by one of the two polynomials.
#[inline(always)]
pub(crate) fn sine<F: Angle>(x: F) -> F {
    let Reduced { quadrant, head, tail } = x.reduced();
    one(quadrant, head, tail)
}

/// cos x, |x| <= `LIMIT`, as `sine`.
#[inline(always)]
pub(crate) fn cosine<F: Angle>(x: F) -> F {
    let Reduced { quadrant, head, tail } = x.reduced();
    one(quadrant.wrapping_add(&F::Bits::one()), head, tail)
}

#[inline(always)]
fn one<F: Angle>(quadrant: F::Bits, head: F, tail: F) -> F {
    let one = F::Bits::one();
    let value = if (quadrant & one).is_zero() { kernel(head, tail).0 } else { kernel(head, tail).1 };
    F::of_bits(value.bits() ^ (quadrant & (one + one)) << F::ABOVE_QUADRANT)
}

/// sin(r - t) and cos(r - t) of a float, where |t| is below an ulp of r or half an ulp of 1/2.
#[inline(always)]
fn kernel<F: Angle>(r: F, t: F) -> (F, F) {
    sine_kernel(r, t, [F::HALF, F::ONE], F::polynomials)
}

/// sin(r - t) and cos(r - t), in the arithmetic of floats or of their rounding errors.
#[inline(always)]
pub fn sine_kernel<T: Arithmetic>(r: T, t: T, [half, one]: [T; 2], polynomials: impl FnOnce(T, T) -> [T; 2]) -> (T, T) {
    let z = r * r;
    let w = z * z;
    let half = half * z;
    let rest = one - half;
    let factors = [r * z, w];
    let corrections = [t * rest, (half - (one - rest)) - r * t];
    let ([sine, cosine], [of_sine, of_cosine], [to_sine, to_cosine]) = (polynomials(z, w), factors, corrections);
    (r - (to_sine + of_sine * sine), rest - (to_cosine + of_cosine * cosine))
}

/// The polynomials of `Angle` for `f64`.
#[inline(always)]
pub fn sine_polynomials<T: Arithmetic>(z: T, w: T, [sine, cosine]: [[T; 6]; 2]) -> [T; 2] {
    let both = |[s, t]: [T; 2], [c, d]: [T; 2]| [s + z * t, c + z * d];
    let ([s0, s1, s2, s3, s4, s5], [c0, c1, c2, c3, c4, c5]) = (sine, cosine);
    let ([a, d], [b, e], [c, f]) = (both([s0, s1], [c0, c1]), both([s2, s3], [c2, c3]), both([s4, s5], [c4, c5]));
    let v = w * w;
    [a + (w * b + v * c), d + (w * e + v * f)]
}
