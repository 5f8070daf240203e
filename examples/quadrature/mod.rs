//! Gauss quadrature.

/// Nodes and weights of 8-point Gauss quadrature on [-1, 1]: the positive half.
const GAUSS: [[f64; 2]; 4] = [
    [0.183_434_642_495_649_8, 0.362_683_783_378_362],
    [0.525_532_409_916_329, 0.313_706_645_877_887_29],
    [0.796_666_477_413_626_7, 0.222_381_034_453_374_47],
    [0.960_289_856_497_536_2, 0.101_228_536_290_376_26],
];

/// The nodes and weights on an interval, in order.
pub fn nodes([from, to]: [f64; 2]) -> [[f64; 2]; 8] {
    let (middle, half) = (f64::midpoint(from, to), (to - from) / 2.0);
    core::array::from_fn(|k| {
        let ([node, weight], side) = if k < 4 { (GAUSS[3 - k], -1.0) } else { (GAUSS[k - 4], 1.0) };
        [middle + side * half * node, half * weight]
    })
}
