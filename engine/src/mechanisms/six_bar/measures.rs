//! The numbers of a six-bar over a turn of its crank.

use linkage::nalgebra::Complex;
use linkage_sweep::{Case, Column, found};

use super::curve::FootPath;
use super::fit::Fit;

/// The x and y columns of the foot, then those of the joints.
pub const POINTS: [&str; 16] = [
    "foot_x", "foot_y", "a_x", "a_y", "b_x", "b_y", "c_x", "c_y", "d_x", "d_y", "p_x", "p_y", "q_x", "q_y", "f_x",
    "f_y",
];

/// The columns of the foot.
pub fn foot() -> [Column; 2] {
    ["foot_x", "foot_y"].map(found)
}

/// The columns of all points.
pub fn points() -> [Column; 16] {
    POINTS.map(found)
}

/// The columns of the sines of the transmission angles.
pub fn sines() -> [Column; 2] {
    ["sine_c", "sine_q"].map(found)
}

/// The least transmission angle, in radians: that between two lines, so that it is at most a right angle, and zero at a
/// dead point. None if the six-bar does not assemble in all positions.
pub fn least_transmission(case: &Case<'_, f64, 2>) -> Option<f64> {
    let sines = case.columns.into_iter().flatten();
    assembles(case).then(|| sines.fold(1.0_f64, |least, sine| least.min(sine.abs())).asin())
}

/// The best fit of the path of the foot to a curve; none if the six-bar does not assemble in all positions, or the curve is
/// not known at them.
pub fn fit<const N: usize>(curve: &FootPath, case: &Case<'_, f64, N>) -> Option<Fit> {
    let (Some(x), Some(y), true) = (case.columns.first(), case.columns.get(1), assembles(case)) else { return None };
    Fit::new(&complex(x, y), &curve.at(x.len())?)
}

/// The box around all points of a moved path of all positions, as its lower left and its upper right corner: that of the
/// foot and the joints, or without the foot.
pub fn bounds(fit: &Fit, case: &Case<'_, f64, 16>, with_foot: bool) -> [Complex<f64>; 2] {
    let columns = case.columns.chunks_exact(2).skip(usize::from(!with_foot));
    let points = columns.flat_map(|point| complex(point[0], point[1]));
    let empty = [Complex::new(f64::INFINITY, f64::INFINITY), Complex::new(f64::NEG_INFINITY, f64::NEG_INFINITY)];
    points.map(|point| fit.place(point)).fold(empty, |[low, high], point| {
        [
            Complex::new(low.re.min(point.re), low.im.min(point.im)),
            Complex::new(high.re.max(point.re), high.im.max(point.im)),
        ]
    })
}

/// The larger side of the box around foot and joints in all positions, relative to the width of a step.
pub fn size(curve: &FootPath, case: &Case<'_, f64, 16>) -> Option<f64> {
    let [low, high] = bounds(&fit(curve, case)?, case, true);
    Some((high.re - low.re).max(high.im - low.im))
}

/// The height of the lowest joint in all positions above the lowest point of the curve, relative to the width of a step.
pub fn clearance(curve: &FootPath, case: &Case<'_, f64, 16>) -> Option<f64> {
    let [low, _] = bounds(&fit(curve, case)?, case, false);
    Some(low.im)
}

fn assembles<const N: usize>(case: &Case<'_, f64, N>) -> bool {
    case.is_complete()
}

fn complex(x: &[f64], y: &[f64]) -> Vec<Complex<f64>> {
    x.iter().zip(y).map(|(x, y)| Complex::new(*x, *y)).collect()
}
