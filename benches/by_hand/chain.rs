use linkage::Real;

use super::{Checked, Dyad, Vector, bent, finite, times, turned};

/// a, b, c, d of each four-bar.
pub type Lengths<const N: usize> = [[f64; 4]; N];

/// One four-bar of the chain.
#[derive(Clone, Copy, Default)]
pub struct Loop {
    /// The directions of coupler and rocker.
    pub links: [Vector; 2],
    pub determinant: f64,
    pub rates: Vector,
    pub accelerations: Vector,
}

#[inline(never)]
pub fn bare<const N: usize>(m: &Lengths<N>, theta: f64, rate: f64, acceleration: f64, sides: &[f64; N]) -> [Loop; N] {
    loops::<false, N>(m, theta, rate, acceleration, sides).expect("no check")
}

#[inline(never)]
pub fn checked<const N: usize>(
    m: &Lengths<N>,
    theta: f64,
    rate: f64,
    acceleration: f64,
    sides: &[f64; N],
) -> Checked<[Loop; N]> {
    loops::<true, N>(m, theta, rate, acceleration, sides)
}

#[inline(always)]
fn loops<const CHECKED: bool, const N: usize>(
    m: &Lengths<N>,
    theta: f64,
    rate: f64,
    acceleration: f64,
    sides: &[f64; N],
) -> Checked<[Loop; N]> {
    let (sine, cosine) = theta.sine_cosine();
    let mut loops = [Loop::default(); N];
    // The direction of the input link of each four-bar, its rate and its acceleration.
    let (mut input, mut turning, mut speeding) = ([cosine, sine], rate, acceleration);
    for ((&[a, b, c, d], &side), solved) in m.iter().zip(sides).zip(&mut loops) {
        let back = times(input, -a);
        let dyad = Dyad::new::<CHECKED>([back[0] + d, back[1]], [b, c], side)?;
        let rates = dyad.rates(turned(back, turning));
        let accelerations = dyad.accelerations(rates, bent(back, turning, speeding));
        finite::<CHECKED, _>(accelerations)?;
        // The rocker is the second link backwards.
        let rocker = times(dyad.second, -1.0 / c);
        let links = [times(dyad.first, 1.0 / b), rocker];
        *solved = Loop { links, determinant: dyad.determinant, rates, accelerations };
        (input, turning, speeding) = (rocker, rates[1], accelerations[1]);
    }
    Some(loops)
}

/// The rates and accelerations at the angles of couplers and rockers.
#[inline(never)]
pub fn at<const N: usize>(
    m: &Lengths<N>,
    theta: f64,
    angles: &[[f64; 2]; N],
    rate: f64,
    acceleration: f64,
) -> Checked<[[Vector; N]; 2]> {
    let mut motions = [[[0.0; 2]; N]; 2];
    let [all_rates, all_accelerations] = &mut motions;
    let results = all_rates.iter_mut().zip(all_accelerations);
    let (mut input, mut turning, mut speeding) = (theta.sine_cosine(), rate, acceleration);
    for ((&[a, b, c, _], &[coupler, rocker]), (to_rates, to_accelerations)) in m.iter().zip(angles).zip(results) {
        let [first, second, between] = f64::sines_cosines([coupler, rocker, coupler - rocker]);
        let back = super::at(input, -a);
        let links = [super::at(first, b), super::at(second, -c)];
        let dyad = Dyad::at::<true>(links, b * c * between.0, b * c)?;
        let rates = dyad.rates(turned(back, turning));
        let accelerations = dyad.accelerations(rates, bent(back, turning, speeding));
        finite::<true, _>(accelerations)?;
        (*to_rates, *to_accelerations) = (rates, accelerations);
        (input, turning, speeding) = (second, rates[1], accelerations[1]);
    }
    Some(motions)
}
